//! Solutions, models and branches saved in files, and loaded from them.
//!
//! A file is a header and a body. The header has 24 bytes: a signature, the version of the format,
//! a CRC-32 of all that follows it and of the version, and the length of the body; integers are
//! little-endian. The body is the [`Content`] of a solution, a [`Model`], or the
//! [`BranchContent`] of a branch, in MessagePack, with the names of all fields.
//!
//! A field that is added later gets a default, so that older files can be read; one that changes
//! its meaning, or goes, takes a new version:
//!
//! 1. Beams with the motions of their nodes, and the inertia of each written out; functions of the
//!    user with what belongs to them. It can still be read. Of solutions only.
//! 2. Definitions alone.
//! 3. With relations, shells, bushings, controllers, bodies that spin, or loads at points that are
//!    no nodes, which readers of version 2 may not know and would leave out. A file without these
//!    is of version 2.

use super::saved::Content;
use super::saved_branch::BranchContent;
use super::solution::Solution;
use super::version::{Saved, VERSION};
use super::write::{refused, write_file};
use crate::error::{Error, ErrorKind, Result};
use crate::memory;
use crate::model::Model;
use crate::solve::Branch;
use serde::de::DeserializeOwned;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// What a file is of.
struct Format {
    /// A byte beyond ASCII and line ends, so that a transfer as text is noticed.
    signature: [u8; 8],
    /// In messages.
    what: &'static str,
}

const SOLUTION: Format = Format {
    signature: *b"\x93PDN\r\n\x1a\n",
    what: "solution",
};
const MODEL: Format = Format {
    signature: *b"\x93PDM\r\n\x1a\n",
    what: "model",
};
const BRANCH: Format = Format {
    signature: *b"\x93PDB\r\n\x1a\n",
    what: "branch",
};
const HEADER: usize = 24;
/// Room for the probe by which reading notices the end of a file.
const MARGIN: usize = 64;
/// A saved number takes 9 bytes, a field its name: values of a file have at least so many bytes on
/// average. One of a byte each would be read into many times its size.
const BYTES_OF_A_VALUE: usize = 4;
/// Values within values: more than any saved one has, and no more than a small stack bears.
const DEPTH: usize = 64;
/// So many values may be as short as they like.
const SHORT_VALUES: usize = 1 << 16;
/// Memory for what a byte of a file is read into: a number of 9 bytes takes 8, in lists that grow
/// to twice their length.
const BYTES_PER_BYTE: usize = 2;

impl Solution {
    /// Saves the solution with its model, whether it has converged or not.
    ///
    /// Functions of the user, in signals and forces, cannot be saved: see [`Solution::load`].
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; a file that was there stays as it was.
    pub fn save(&self, path: &Path) -> Result<()> {
        SOLUTION.save(&Content::of(self), path)
    }

    /// Loads a solution. It gives what the saved one gave, to the last bit, and a solve may start
    /// from it.
    ///
    /// If its model had functions of the user, its quantities are there all the same; but a solve
    /// of the loaded model fails with [`ErrorKind::Callback`], since the functions are not.
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; [`ErrorKind::Format`] if the file is no solution, damaged, or of a newer
    /// version.
    pub fn load(path: &Path) -> Result<Self> {
        SOLUTION.load(path, Content::into_solution)
    }
}

impl Model {
    /// Saves the model. Functions of the user, in signals and forces, cannot be saved: see
    /// [`Model::load`].
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; a file that was there stays as it was.
    pub fn save(&self, path: &Path) -> Result<()> {
        MODEL.save(self, path)
    }

    /// Loads a model that was saved. If it had functions of the user, a solve of it fails with
    /// [`ErrorKind::Callback`], since they are not there.
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; [`ErrorKind::Format`] if the file is no model, damaged, or of a newer
    /// version.
    pub fn load(path: &Path) -> Result<Self> {
        MODEL.load(path, Model::checked)
    }
}

impl Branch {
    /// Saves the branch with its model and all its points.
    ///
    /// Functions of the user, in signals and forces, cannot be saved: see [`Branch::load`].
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; a file that was there stays as it was.
    pub fn save(&self, path: &Path) -> Result<()> {
        BRANCH.save(&BranchContent::of(self), path)
    }

    /// Loads a branch. Its points are what they were, and it can be continued.
    ///
    /// If its model had functions of the user, what needs these fails with [`ErrorKind::Callback`]:
    /// the solutions of its points, and what follows from them.
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; [`ErrorKind::Format`] if the file is no branch, damaged, or of a newer
    /// version.
    pub fn load(path: &Path) -> Result<Self> {
        BRANCH.load(path, BranchContent::into_branch)
    }
}

impl Format {
    fn save(&self, content: &impl Saved, path: &Path) -> Result<()> {
        let body = rmp_serde::to_vec_named(content)
            .map_err(|e| refused("write", path, &io::Error::other(e)))?;
        let header = self.header(content.version(), &body);
        write_file(path, |file| {
            file.write_all(&header)?;
            file.write_all(&body)
        })
    }

    /// `build` makes it of what the file holds, with all checks.
    fn load<C: DeserializeOwned, T>(
        &self,
        path: &Path,
        build: impl FnOnce(C) -> Result<T>,
    ) -> Result<T> {
        let mut file = File::open(path).map_err(|e| refused("read", path, &e))?;
        let file_of = |what: String| {
            let message = format!("path: \"{}\" {what}", path.display());
            Error::new(ErrorKind::Format, message)
        };
        let mut header = Vec::new();
        let head = Read::by_ref(&mut file)
            .take(HEADER as u64)
            .read_to_end(&mut header);
        head.map_err(|e| refused("read", path, &e))?;
        let (checksum, length) = self.read_header(&header).map_err(file_of)?;
        // As long as the file is, whatever its header says.
        let there = file
            .metadata()
            .map_or(0, |it| it.len())
            .saturating_sub(HEADER as u64);
        let expected = usize::try_from(there.min(length)).unwrap_or(usize::MAX);
        // What is read grows once more where the file goes on.
        let mut body = memory::room("the file", expected.saturating_add(MARGIN))?;
        let rest = file.take(length.saturating_add(1)).read_to_end(&mut body);
        rest.map_err(|e| refused("read", path, &e))?;
        let found = body.len() as u64;
        if found < length {
            let what = format!("is cut off: {found} of {length} bytes after its header are there");
            return Err(file_of(what));
        }
        if found > length {
            return Err(file_of("is damaged: it goes on after its end".into()));
        }
        if checksum != checksum_of(&header, &body) {
            return Err(file_of("is damaged: its checksum is wrong".into()));
        }
        require_substance(&body).map_err(file_of)?;
        memory::require_items("what the file holds", body.len(), BYTES_PER_BYTE)?;
        let mut reader = rmp_serde::Deserializer::from_read_ref(&body[..]);
        reader.set_max_depth(DEPTH);
        let content = C::deserialize(&mut reader)
            .map_err(|e| file_of(format!("is no {} that can be read: {e}", self.what)))?;
        build(content).map_err(|e| file_of(format!("is no valid {}: {e}", self.what)))
    }

    fn header(&self, version: u32, body: &[u8]) -> Vec<u8> {
        let mut header = self.signature.to_vec();
        header.extend(version.to_le_bytes());
        header.extend([0; 4]);
        header.extend((body.len() as u64).to_le_bytes());
        let checksum = checksum_of(&header, body);
        header[12..16].copy_from_slice(&checksum.to_le_bytes());
        header
    }

    /// Checksum and length of the body, or what is wrong with the file.
    fn read_header(&self, header: &[u8]) -> std::result::Result<(u32, u64), String> {
        let shared = header.len().min(self.signature.len());
        if header.is_empty() || header[..shared] != self.signature[..shared] {
            return Err(format!("is not a saved {}", self.what));
        }
        let (Some(version), Some(checksum), Some(length)) = (
            bytes_at(header, 8),
            bytes_at(header, 12),
            bytes_at(header, 16),
        ) else {
            return Err("is cut off: it ends in its header".into());
        };
        match u32::from_le_bytes(version) {
            1..=VERSION => Ok((u32::from_le_bytes(checksum), u64::from_le_bytes(length))),
            newer if newer > VERSION => Err(format!(
                "is of version {newer} of the format; this library reads up to {VERSION}: use a \
                 newer one"
            )),
            unknown => Err(format!(
                "names version {unknown} of the format, which never was"
            )),
        }
    }
}

/// Checks that a body's values have as many bytes as saved ones have.
fn require_substance(body: &[u8]) -> std::result::Result<(), String> {
    let most = SHORT_VALUES + body.len() / BYTES_OF_A_VALUE;
    let mut rest = body;
    for _ in 0..=most {
        let Some((&marker, after)) = rest.split_first() else {
            return Ok(());
        };
        // What is not well formed is told where it is read.
        let Some(next) = payload(marker, after).and_then(|length| after.get(length..)) else {
            return Ok(());
        };
        rest = next;
    }
    Err(format!(
        "holds more than {most} values, too many for its {} bytes",
        body.len()
    ))
}

/// Bytes that belong to a value of MessagePack after its marker, but for items of arrays and maps,
/// which are values of their own.
fn payload(marker: u8, after: &[u8]) -> Option<usize> {
    let number = |count: usize| -> Option<usize> {
        let bytes = after.get(..count)?;
        Some(
            bytes
                .iter()
                .fold(0, |sum, &byte| sum << 8 | usize::from(byte)),
        )
    };
    Some(match marker {
        // Small numbers, small maps and arrays; nil and truth values.
        0x00..=0x9f | 0xc0..=0xc3 | 0xe0..=0xff => 0,
        0xa0..=0xbf => usize::from(marker & 0x1f),
        // Text and bytes, and what is of a type of its own, after their length.
        0xc4 | 0xd9 => 1 + number(1)?,
        0xc5 | 0xda => 2 + number(2)?,
        0xc6 | 0xdb => 4 + number(4)?,
        0xc7 => 2 + number(1)?,
        0xc8 => 3 + number(2)?,
        0xc9 => 5 + number(4)?,
        // Numbers.
        0xcc | 0xd0 => 1,
        0xcd | 0xd1 => 2,
        0xca | 0xce | 0xd2 => 4,
        0xcb | 0xcf | 0xd3 => 8,
        0xd4..=0xd8 => 1 + (1 << (marker - 0xd4)),
        // Larger arrays and maps: their length.
        0xdc | 0xde => 2,
        0xdd | 0xdf => 4,
    })
}

/// CRC-32 of the version, the length and the body.
fn checksum_of(header: &[u8], body: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&header[8..12]);
    hasher.update(&header[16..HEADER]);
    hasher.update(body);
    hasher.finalize()
}

fn bytes_at<const N: usize>(bytes: &[u8], start: usize) -> Option<[u8; N]> {
    bytes.get(start..start + N)?.try_into().ok()
}
