//! Files that come whole or not at all.

use crate::error::{Error, ErrorKind, Result};
use std::fs::{self, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Links that lead to links, at most.
const MOST_LINKS: usize = 40;

/// The system refused something that was tried with `path`.
pub(super) fn refused(what: &str, path: &Path, error: &io::Error) -> Error {
    // In the same words, whether the system says so or what was asked before it.
    let reason = match error.kind() {
        io::ErrorKind::NotFound => "there is no such file or directory".into(),
        io::ErrorKind::PermissionDenied => "permission is denied".into(),
        io::ErrorKind::IsADirectory => "it is a directory".into(),
        io::ErrorKind::NotADirectory => "it is beyond what is no directory".into(),
        _ => error.to_string(),
    };
    let kind = match error.kind() {
        io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
        _ => ErrorKind::Io,
    };
    let message = format!("path: cannot {what} \"{}\": {reason}", path.display());
    Error::new(kind, message)
}

/// Writes a file by `write`, which sees a buffer. A file that is there already is replaced when all
/// is written, and stays as it is if that fails; what is no file (a terminal, a pipe) is written to
/// directly.
///
/// # Errors
/// [`ErrorKind::Io`] with the path and the system's reason.
pub(super) fn write_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    attempt(path, write).map_err(|e| refused("write", path, &e))
}

fn attempt(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let existing = fs::metadata(path);
    if existing.as_ref().is_ok_and(fs::Metadata::is_dir) {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if existing.as_ref().is_ok_and(|it| !it.is_file()) {
        let mut buffer = BufWriter::new(OpenOptions::new().write(true).open(path)?);
        write(&mut buffer)?;
        return buffer.flush();
    }
    let target = followed(path)?;
    let temporary = temporary_beside(&target)?;
    if let Ok(existing) = existing {
        // Whoever may not write the file may not replace it either.
        OpenOptions::new().append(true).open(&target)?;
        fs::set_permissions(temporary.path(), existing.permissions())?;
    }
    let mut buffer = BufWriter::new(temporary);
    write(&mut buffer)?;
    let temporary = buffer
        .into_inner()
        .map_err(io::IntoInnerError::into_error)?;
    temporary.as_file().sync_all()?;
    temporary.persist(target).map_err(|e| e.error)?;
    Ok(())
}

/// What is replaced or made: that which a link leads to, whether it is there or not.
fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&target) {
            Ok(leads_to) => target = directory_of(&target).join(leads_to),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("it is one of too many links"))
}

/// Directory that `path` is in.
pub(super) fn directory_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    if path.file_name().is_none() {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it names no file",
        ));
    }
    let mut builder = Builder::new();
    // Not of the file's own name, which may be as long as names can be.
    builder.prefix(".periodyn.");
    // With the permissions that a new file has; that of temporary files is less.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(directory_of(path)).map_err(plain)
}

/// The system's reason alone, without the name of a temporary file.
pub(super) fn plain(error: io::Error) -> io::Error {
    match error.raw_os_error() {
        Some(code) => io::Error::from_raw_os_error(code),
        None => error.kind().into(),
    }
}
