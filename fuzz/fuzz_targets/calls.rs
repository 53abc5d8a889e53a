#![no_main]

use std::sync::LazyLock;
use tempfile::TempDir;

static DIRECTORY: LazyLock<TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    periodyn_fuzz::calls::run(data, &DIRECTORY.path().join("file"));
});
