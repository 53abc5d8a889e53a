//! A short run of the fuzz targets from seeds, and of their corpus; `script/fuzz` has long ones.
//! PDN_FUZZ_SEED and PDN_FUZZ_RUNS choose others.

#[path = "../fuzz/src/lib.rs"]
#[allow(dead_code)]
mod fuzz;

use fuzz::{calls, files, models, promises, signals};
use std::collections::BTreeMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name)
        .ok()
        .map_or(default, |text| text.parse().unwrap())
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    fn bytes(&mut self) -> Vec<u8> {
        let length = self.next() % 1200;
        (0..length).map(|_| self.next() as u8).collect()
    }
}

/// Bytes made up from each of so many seeds, and those of the corpus.
fn inputs(target: &str, runs: u64) -> impl Iterator<Item = (String, Vec<u8>)> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("fuzz/corpus")
        .join(target);
    let mut paths: Vec<PathBuf> = fs::read_dir(corpus)
        .map(|all| all.map(|entry| entry.unwrap().path()).collect())
        .unwrap_or_default();
    paths.sort();
    let kept = paths.into_iter().map(|path| {
        let bytes = fs::read(&path).unwrap();
        (path.display().to_string(), bytes)
    });
    let first = setting("PDN_FUZZ_SEED", 1);
    let runs = setting("PDN_FUZZ_RUNS", runs);
    kept.chain((first..first + runs).map(|seed| (format!("seed {seed}"), Random(seed).bytes())))
}

/// Runs a target on all inputs; tells each way in which it fails, and the first input that does.
fn run(target: &str, runs: u64, one: impl Fn(&[u8], &Path)) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("file");
    let mut failures = BTreeMap::new();
    for (name, bytes) in inputs(target, runs) {
        let Err(panic) = catch_unwind(AssertUnwindSafe(|| one(&bytes, &path))) else {
            continue;
        };
        let why = match panic.downcast::<String>() {
            Ok(text) => *text,
            Err(_) => "a panic".into(),
        };
        // Numbers tell apart what is alike.
        let alike: String = why
            .chars()
            .filter(|c| !c.is_ascii_digit())
            .take(90)
            .collect();
        failures.entry(alike).or_insert(format!("{name}: {why}"));
    }
    let failures: Vec<String> = failures.into_values().collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn calls_keep_their_promises() {
    run("calls", 500, calls::run);
    // Calls that are all refused would try nothing.
    assert_eq!(promises::always_refused(), Vec::<String>::new());
}

#[test]
fn damaged_files_do_no_harm() {
    for name in ["solution_v1.pdn", "solution_v2.pdn"] {
        let original = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/data")
            .join(name);
        let original = fs::read(original).unwrap();
        run("files", 1000, |bytes, path| {
            files::run(&original, bytes, path)
        });
    }
}

#[test]
fn signals_and_sections_are_what_was_given() {
    run("signals", 20000, |bytes, _| signals::run(bytes));
}

#[test]
fn small_models_have_the_solutions_that_are_told() {
    run("models", 150, |bytes, _| models::run(bytes));
}
