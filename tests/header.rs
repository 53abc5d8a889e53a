//! `include/periodyn.h` is what cbindgen writes from `src/capi`. `PDN_BLESS=1` rewrites it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The files that declare something for C, in the order of the header.
const FILES: &[&str] = &[
    "version",
    "status",
    "last_error",
    "callback",
    "guard",
    "section",
    "signal",
    "model",
    "joint",
    "relation",
    "line",
    "beam",
    "load",
    "surface",
    "shell",
    "rigid_edge",
    "force",
    "bushing",
    "user_force",
    "surface_force",
    "label",
    "solution",
    "quantity",
    "force_solution",
    "filter",
    "periodic",
    "linear_solver",
    "equations",
    "parameter",
    "contents",
    "condition",
    "sensitivity",
    "branch",
    "statics",
    "modes",
    "march",
    "shooting",
    "stability",
    "motion",
    "summary",
    "table",
    "files",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn source(name: &str) -> PathBuf {
    root().join(format!("src/capi/{name}.rs"))
}

fn generated() -> String {
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    // File by file, not by crate: constants of the core are none of C's business.
    let builder = FILES
        .iter()
        .fold(cbindgen::Builder::new(), |builder, file| {
            builder.with_src(source(file))
        });
    let mut text = Vec::new();
    builder
        .with_config(config)
        .generate()
        .unwrap()
        .write(&mut text);
    String::from_utf8(text).unwrap()
}

#[test]
fn header_is_what_the_source_says() {
    let path = root().join("include/periodyn.h");
    let header = generated();
    if std::env::var_os("PDN_BLESS").is_some() {
        std::fs::write(&path, &header).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    if committed != header {
        let first = committed
            .lines()
            .zip(header.lines())
            .position(|(a, b)| a != b);
        panic!(
            "include/periodyn.h is out of date (from line {:?}); \
             run PDN_BLESS=1 cargo test --test header",
            first.map(|line| line + 1)
        );
    }
}

#[test]
fn no_file_that_exports_is_left_out() {
    let exporting: BTreeSet<String> = std::fs::read_dir(root().join("src/capi"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            let exports =
                |line: &str| line == "#[unsafe(no_mangle)]" || line.starts_with("pub const PDN_");
            text.lines().any(exports)
        })
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    let listed: BTreeSet<String> = FILES.iter().map(|&file| file.to_owned()).collect();
    assert_eq!(exporting, listed, "files of src/capi and FILES");
}
