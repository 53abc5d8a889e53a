//! The tests: their programs, how long each takes, and which places it reaches.

use crate::copy::Folders;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Write};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Instant;

/// A test program.
pub struct Binary {
    pub name: String,
    pub path: PathBuf,
}

/// A test, as it is without any mutant.
#[derive(Clone)]
pub struct Test {
    pub binary: String,
    pub name: String,
    /// Of the sources that it is made of: what was found with others does not hold.
    pub digest: u32,
    /// Without bound if it takes too long.
    pub seconds: f64,
    pub reached: BTreeSet<usize>,
}

impl Test {
    /// The same for the same test of the same program.
    pub fn key(&self) -> String {
        key(&self.binary, &self.name, self.digest)
    }
}

fn key(binary: &str, name: &str, digest: u32) -> String {
    format!("{binary}\t{name}\t{digest:08x}")
}

/// Builds the tests: those of the library, and if asked for all others.
pub fn build(folders: &Folders, only_library: bool) -> io::Result<Vec<Binary>> {
    let mut arguments = vec!["test", "--no-run", "--lib"];
    if !only_library {
        arguments.extend(["--test", "all_of_them"]);
    }
    let output = folders.cargo(&arguments).output()?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        return Err(io::Error::other(format!(
            "the tests are not built: {errors}"
        )));
    }
    let mut binaries = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(message) = serde_json::from_str::<Value>(line) else {
            continue;
        };
        let Some(path) = message["executable"].as_str() else {
            continue;
        };
        binaries.push(Binary {
            name: message["target"]["name"]
                .as_str()
                .unwrap_or_default()
                .into(),
            path: path.into(),
        });
    }
    Ok(binaries)
}

fn digest_of(path: &Path, so_far: &mut crc32fast::Hasher) -> io::Result<()> {
    if !path.is_dir() {
        so_far.update(path.to_string_lossy().as_bytes());
        so_far.update(&fs::read(path)?);
        return Ok(());
    }
    let entries = fs::read_dir(path)?.map(|entry| entry.map(|entry| entry.path()));
    let mut paths = entries.collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    paths.iter().try_for_each(|path| digest_of(path, so_far))
}

/// Of the library with its mutants, what tests share, and the file of a test.
fn digest(folders: &Folders, test: &str) -> io::Result<u32> {
    let (mut hasher, tree) = (crc32fast::Hasher::new(), folders.tree());
    for part in ["src", "tests/common", "tests/models"] {
        digest_of(&tree.join(part), &mut hasher)?;
    }
    let module = test.split("::").next().unwrap_or_default();
    let file = tree.join("tests").join(format!("{module}.rs"));
    if file.is_file() {
        digest_of(&file, &mut hasher)?;
    }
    Ok(hasher.finalize())
}

/// How a test program is run, with so many seconds of the processor.
pub fn command(folders: &Folders, binary: &Path, seconds: u64) -> Command {
    let mut command = Command::new("sh");
    // A mutant may allocate without end, too.
    let limits = format!("ulimit -t {seconds}; ulimit -v 12000000; exec \"$@\"");
    command.args(["-c", &limits, "sh"]).arg(binary);
    command.args(["--test-threads", "1", "--exact"]);
    command.current_dir(folders.tree());
    command.env("CARGO_MANIFEST_DIR", folders.tree());
    command.env("RUST_BACKTRACE", "0");
    command
}

fn names(binary: &Binary) -> io::Result<Vec<String>> {
    let mut list = Command::new(&binary.path);
    let output = list.args(["--list", "--format", "terse"]).output()?;
    let mut ignored = Command::new(&binary.path);
    let ignored = ignored
        .args(["--list", "--format", "terse", "--ignored"])
        .output()?;
    let read = |output: &Output| -> BTreeSet<String> {
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let tests = text.lines().filter_map(|line| line.strip_suffix(": test"));
        tests.map(str::to_string).collect()
    };
    Ok(read(&output).difference(&read(&ignored)).cloned().collect())
}

/// Tests that were run before, by key.
fn noted(path: &Path) -> BTreeMap<String, Test> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let mut tests = BTreeMap::new();
    for line in text.lines() {
        let fields: Vec<&str> = line.split('\t').collect();
        let [binary, name, digest, seconds, reached] = fields[..] else {
            continue;
        };
        let numbers = reached.split(',').filter_map(|number| number.parse().ok());
        let test = Test {
            binary: binary.into(),
            name: name.into(),
            digest: u32::from_str_radix(digest, 16).unwrap_or(0),
            seconds: seconds.parse().unwrap_or(0.0),
            reached: numbers.collect(),
        };
        tests.insert(test.key(), test);
    }
    tests
}

/// Runs a test by itself without a mutant.
///
/// # Errors
/// If it fails: nothing could be told from it.
fn alone(
    folders: &Folders,
    binary: &Binary,
    name: &str,
    slowest: u64,
) -> io::Result<(f64, String)> {
    let reached = folders.work.join("reached");
    fs::write(&reached, "")?;
    let start = Instant::now();
    let output = command(folders, &binary.path, slowest)
        .arg(name)
        .env("PDN_MUTANT", "reached")
        .env("PDN_MUTANT_REACHED", &reached)
        .output()?;
    let seconds = start.elapsed().as_secs_f64();
    if output.status.success() {
        return Ok((seconds, fs::read_to_string(&reached)?));
    }
    let text = String::from_utf8_lossy(&output.stdout);
    // Ended by its limit, which counts the seconds of all threads.
    let is_slow = output.status.signal().is_some() && !text.contains("FAILED");
    if !is_slow {
        let message = format!("{}: {name} fails without a mutant:\n{text}", binary.name);
        return Err(io::Error::other(message));
    }
    Ok((f64::INFINITY, String::new()))
}

/// Runs each test by itself without a mutant, those apart of which it is known how they went;
/// quick ones first in what it gives. Those that take more seconds than `slowest` are left out.
pub fn baseline(folders: &Folders, binaries: &[Binary], slowest: u64) -> io::Result<Vec<Test>> {
    let path = folders.work.join("baseline.tsv");
    let known = noted(&path);
    let mut file = File::options().append(true).create(true).open(&path)?;
    let mut tests = Vec::new();
    for binary in binaries {
        for name in names(binary)? {
            let digest = digest(folders, &name)?;
            if let Some(test) = known.get(&key(&binary.name, &name, digest)) {
                tests.push(test.clone());
                continue;
            }
            let (seconds, reached) = alone(folders, binary, &name, slowest)?;
            let test = Test {
                binary: binary.name.clone(),
                name,
                digest,
                seconds,
                reached: reached
                    .lines()
                    .filter_map(|line| line.parse().ok())
                    .collect(),
            };
            let numbers: Vec<String> = test.reached.iter().map(usize::to_string).collect();
            writeln!(file, "{}\t{seconds:.4}\t{}", test.key(), numbers.join(","))?;
            tests.push(test);
        }
    }
    tests.retain(|test| test.seconds <= slowest as f64);
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    Ok(tests)
}
