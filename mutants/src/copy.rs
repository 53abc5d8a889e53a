//! The copy of the tree that is built: with switches, and without what does not compile.

use crate::find::Mutant;
use crate::schemata::{self, MODULE, Numbered, Place};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// All integration tests as one program: it is built in less time than one for each.
pub const ALL_TESTS: &str = "tests/all_of_them.rs";

/// Where the tree is, and where it is built.
pub struct Folders {
    pub root: PathBuf,
    pub work: PathBuf,
    /// Files of integration tests that are built; all if there are none.
    pub tests: Vec<String>,
}

impl Folders {
    pub fn tree(&self) -> PathBuf {
        self.work.join("tree")
    }

    /// Cargo in the copy.
    pub fn cargo(&self, arguments: &[&str]) -> Command {
        let mut cargo = Command::new("cargo");
        cargo
            .args(arguments)
            .args(["--locked", "--jobs", "1", "--message-format", "json"])
            .current_dir(self.tree())
            .env("CARGO_TARGET_DIR", self.work.join("target"))
            .stdout(Stdio::piped());
        cargo
    }
}

/// Writes what differs, so that what does not is not built again.
fn put(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if fs::read(path).is_ok_and(|present| present == bytes) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, bytes)
}

/// Files of the tree, those that are not committed yet too.
fn files(root: &Path) -> io::Result<Vec<String>> {
    let listed = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(root)
        .output()?;
    let names = String::from_utf8_lossy(&listed.stdout);
    let names = names.lines().filter(|name| root.join(name).is_file());
    Ok(names.map(str::to_string).collect())
}

/// Writes the copy with these switches; gives their places, by file.
fn write(folders: &Folders, mutants: &[Numbered]) -> io::Result<BTreeMap<String, Vec<Place>>> {
    let mut of_file: BTreeMap<&str, Vec<Numbered>> = BTreeMap::new();
    for &(number, mutant) in mutants {
        of_file
            .entry(&mutant.file)
            .or_default()
            .push((number, mutant));
    }
    // What tests have in common is there once.
    let mut tests = String::from("mod common;\n");
    let count = mutants
        .iter()
        .map(|(number, _)| number + 1)
        .max()
        .unwrap_or(1);
    let mut places = BTreeMap::new();
    for name in files(&folders.root)? {
        let mut bytes = fs::read(folders.root.join(&name))?;
        if let Some(mutants) = of_file.get(name.as_str()) {
            let source = String::from_utf8_lossy(&bytes).into_owned();
            let (text, found) = schemata::write(&source, mutants);
            places.insert(name.clone(), found);
            bytes = text.into_bytes();
        }
        if name == "src/lib.rs" {
            bytes.extend_from_slice(b"\nmod mutant;\n");
        }
        let test = name
            .strip_prefix("tests/")
            .and_then(|name| name.strip_suffix(".rs"));
        let is_built = |test: &str| {
            let is_asked = folders.tests.is_empty() || folders.tests.iter().any(|one| one == test);
            !test.contains('/') && is_asked
        };
        if let Some(test) = test.filter(|test| is_built(test)) {
            tests += &format!("#[path = \"{test}.rs\"]\nmod {test};\n");
            let text = String::from_utf8_lossy(&bytes).into_owned();
            bytes = text
                .replace("\nmod common;\n", "\nuse crate::common;\n")
                .into_bytes();
        }
        put(&folders.tree().join(name), &bytes)?;
    }
    put(&folders.tree().join(ALL_TESTS), tests.as_bytes())?;
    let module = format!("{MODULE}\nconst COUNT: usize = {count};\n");
    put(&folders.tree().join("src/mutant.rs"), module.as_bytes())?;
    Ok(places)
}

/// All files and bytes that a message of the compiler points to.
fn spans(message: &Value, all: &mut Vec<(String, usize, usize)>) {
    let entries = message["spans"].as_array().into_iter().flatten();
    for span in entries {
        let at = |key: &str| span[key].as_u64().unwrap_or(0) as usize;
        let file = span["file_name"].as_str().unwrap_or_default();
        all.push((file.into(), at("byte_start"), at("byte_end")));
    }
    for child in message["children"].as_array().into_iter().flatten() {
        spans(child, all);
    }
}

/// Whose fault an error is: those whose own text it points to, or else that around or nearest.
fn culprits(message: &Value, places: &BTreeMap<String, Vec<Place>>) -> BTreeSet<usize> {
    let mut pointed = Vec::new();
    spans(message, &mut pointed);
    let mut found = BTreeSet::new();
    for (file, start, end) in &pointed {
        let of_file = places.get(file).into_iter().flatten();
        let own = of_file.filter(|place| place.own.start <= *start && *end <= place.own.end);
        found.extend(own.map(|place| place.number));
    }
    if found.is_empty() {
        let Some((file, start, _)) = pointed.first() else {
            return found;
        };
        let distance = |place: &&Place| {
            let outside =
                place.whole.start.saturating_sub(*start) + start.saturating_sub(place.whole.end);
            (outside, place.whole.len())
        };
        let of_file = places.get(file).into_iter().flatten();
        found.extend(of_file.min_by_key(distance).map(|place| place.number));
    }
    found
}

/// Writes a copy with the first `count` of these that compile together with the rest, by number;
/// the others' numbers are noted in a file, for the next time.
pub fn make(folders: &Folders, mutants: &[Mutant], count: usize) -> io::Result<Vec<usize>> {
    let list = folders.work.join("unviable");
    let noted = fs::read_to_string(&list).unwrap_or_default();
    let mut unviable: BTreeSet<String> = noted.lines().map(str::to_string).collect();
    loop {
        let viable = mutants.iter().enumerate();
        let viable = viable.filter(|(_, mutant)| !unviable.contains(&mutant.name));
        let numbered: Vec<Numbered> = viable.take(count).collect();
        let places = write(folders, &numbered)?;
        println!("checking {} mutants", numbered.len());
        let output = folders.cargo(&["check", "--lib"]).output()?;
        if output.status.success() {
            let total = numbered.last().map_or(0, |(number, _)| number + 1);
            println!("{} of {total} compile", numbered.len());
            return Ok(numbered.iter().map(|(number, _)| *number).collect());
        }
        let mut found = BTreeSet::new();
        for line in String::from_utf8_lossy(&output.stdout).lines() {
            let Ok(message) = serde_json::from_str::<Value>(line) else {
                continue;
            };
            let message = &message["message"];
            if message["level"] == "error" {
                found.extend(culprits(message, &places));
            }
        }
        if found.is_empty() {
            let errors = String::from_utf8_lossy(&output.stderr);
            return Err(io::Error::other(format!("no mutant is to blame: {errors}")));
        }
        unviable.extend(found.iter().map(|&number| mutants[number].name.clone()));
        let lines: Vec<&str> = unviable.iter().map(String::as_str).collect();
        fs::write(&list, lines.join("\n") + "\n")?;
    }
}
