#![no_main]

use std::sync::LazyLock;
use tempfile::TempDir;

static DIRECTORY: LazyLock<TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());
const ORIGINAL: &[u8] = include_bytes!("../../tests/data/solution_v2.pdn");

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    periodyn_fuzz::files::run(ORIGINAL, data, &DIRECTORY.path().join("file"));
});
