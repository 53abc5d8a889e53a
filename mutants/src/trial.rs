//! Tests with one mutant switched on, until one fails.

use crate::binaries::{self, Binary, Test};
use crate::copy::Folders;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs::{self, File};
use std::io::{self, Write};
use std::time::Instant;

/// Seconds that tests of one process take together, unless one takes more.
const TOGETHER: f64 = 1.0;
/// Seconds of the processor that a test may take more than it does, and how many times as many.
const GRACE: (f64, f64) = (20.0, 8.0);

/// What is known of the mutants, by their names.
pub struct Results {
    file: File,
    /// What failed.
    pub caught: HashMap<String, String>,
    /// Keys of tests that passed.
    passed: HashMap<String, HashSet<String>>,
}

impl Results {
    pub fn open(folders: &Folders) -> io::Result<Results> {
        let path = folders.work.join("results.tsv");
        let text = fs::read_to_string(&path).unwrap_or_default();
        let mut results = Results {
            file: File::options().append(true).create(true).open(&path)?,
            caught: HashMap::new(),
            passed: HashMap::new(),
        };
        for line in text.lines() {
            let fields: Vec<&str> = line.splitn(3, '\t').collect();
            match fields[..] {
                [name, "caught", by] => {
                    results.caught.insert(name.into(), by.into());
                }
                [name, "passed", test] => {
                    let passed = results.passed.entry(name.into()).or_default();
                    passed.insert(test.into());
                }
                _ => {}
            }
        }
        Ok(results)
    }

    fn note(&mut self, name: &str, what: &str, detail: &str) -> io::Result<()> {
        writeln!(self.file, "{name}\t{what}\t{detail}")?;
        match what {
            "caught" => {
                self.caught.insert(name.into(), detail.into());
            }
            _ => {
                let passed = self.passed.entry(name.into()).or_default();
                passed.insert(detail.into());
            }
        }
        Ok(())
    }

    fn has_passed(&self, name: &str, test: &Test) -> bool {
        let passed = self.passed.get(name);
        passed.is_some_and(|passed| passed.contains(&test.key()))
    }

    /// Tests that reach the place of a mutant and have not been run with it.
    pub fn left<'a>(&self, name: &str, number: usize, tests: &'a [Test]) -> Vec<&'a Test> {
        let reaching = tests.iter().filter(|test| test.reached.contains(&number));
        reaching
            .filter(|test| !self.has_passed(name, test))
            .collect()
    }
}

/// The first tests of these that are run in one process each: of one program.
fn together<'a>(tests: &[&'a Test]) -> (usize, BTreeMap<&'a str, Vec<&'a Test>>) {
    let (mut count, mut seconds) = (0, 0.0);
    let mut of_binary: BTreeMap<&str, Vec<&Test>> = BTreeMap::new();
    for test in tests {
        seconds += test.seconds;
        if count > 0 && seconds > TOGETHER {
            break;
        }
        of_binary.entry(&test.binary).or_default().push(test);
        count += 1;
    }
    (count, of_binary)
}

/// Runs tests with a mutant; what failed, if anything.
fn run(
    folders: &Folders,
    binary: &Binary,
    tests: &[&Test],
    number: usize,
) -> io::Result<Option<String>> {
    let seconds: f64 = tests.iter().map(|test| test.seconds).sum();
    let limit = (GRACE.0 + GRACE.1 * seconds).ceil() as u64;
    let output = binaries::command(folders, &binary.path, limit)
        .args(tests.iter().map(|test| &test.name))
        .env("PDN_MUTANT", number.to_string())
        .output()?;
    if output.status.success() {
        return Ok(None);
    }
    let text = String::from_utf8_lossy(&output.stdout);
    let failed = |line: &str| -> Option<String> {
        let name = line.strip_prefix("test ")?.strip_suffix(" ... FAILED")?;
        Some(name.to_string())
    };
    let how = match text.lines().find_map(failed) {
        Some(test) => test,
        // Ended by the limit, a signal, or a process without memory.
        None => format!("{} ({})", tests[0].name, output.status),
    };
    Ok(Some(format!("{}: {how}", binary.name)))
}

/// Runs the tests that reach a mutant's place, quick ones first, until one fails or so many seconds
/// of tests have passed.
pub fn attempt(
    folders: &Folders,
    binaries: &[Binary],
    tests: &[Test],
    (number, name): (usize, &str),
    most: f64,
    results: &mut Results,
) -> io::Result<()> {
    let (mut left, start) = (results.left(name, number, tests), Instant::now());
    while !left.is_empty() && start.elapsed().as_secs_f64() < most {
        let (count, of_binary) = together(&left);
        for (binary, tests) in of_binary {
            let binary = binaries.iter().find(|one| one.name == binary);
            let binary = binary.ok_or_else(|| io::Error::other("a program that is gone"))?;
            if let Some(failure) = run(folders, binary, &tests, number)? {
                return results.note(name, "caught", &failure);
            }
            for test in tests {
                results.note(name, "passed", &test.key())?;
            }
        }
        left.drain(..count);
    }
    Ok(())
}
