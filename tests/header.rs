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
    "memory",
    "section",
    "signal",
    "id",
    "model",
    "joint",
    "relation",
    "line",
    "beam",
    "load",
    "turning_frame",
    "spin",
    "rotor_symmetry",
    "surface",
    "shell",
    "rigid_edge",
    "force",
    "bushing",
    "user_force",
    "controller",
    "surface_force",
    "bind",
    "change",
    "label",
    "solution",
    "quantity",
    "filter",
    "periodic",
    "linear_solver",
    "equations",
    "parameter",
    "contents",
    "load_contents",
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

/// Constants of the header, but for the version, statuses and what is no choice: names and values.
fn constants(header: &str) -> Vec<(&str, i32)> {
    let line = |line: &'_ str| {
        let (name, value) = line.strip_prefix("#define ")?.split_once(' ')?;
        Some((name.to_owned(), value.parse::<i32>().ok()?))
    };
    let is_choice = |name: &str| {
        let others = ["PDN_VERSION_", "PDN_ERR_", "PDN_OK", "PDN_LABEL_LENGTH"];
        name.starts_with("PDN_") && !others.iter().any(|other| name.starts_with(other))
    };
    let found = header.lines().filter_map(|text| {
        let (name, value) = line(text)?;
        let start = text.find(&name)?;
        is_choice(&name).then_some((&text[start..start + name.len()], value))
    });
    found.collect()
}

/// So that a constant of one role where another belongs, or an id, is refused.
#[test]
fn constants_of_different_roles_have_ranges_of_their_own() {
    let header = std::fs::read_to_string(root().join("include/periodyn.h")).unwrap();
    let all = constants(&header);
    assert!(all.len() > 150);
    let values: BTreeSet<i32> = all.iter().map(|(_, value)| *value).collect();
    assert_eq!(values.len(), all.len(), "two constants have the same value");
    // What stands for none or all is negative; ids begin far beyond constants.
    let small = all.iter().filter(|(_, value)| (0..100).contains(value));
    assert_eq!(small.count(), 0);
    // A hundred has one run of values.
    let hundreds: BTreeSet<i32> = values.range(0..).map(|value| value / 100).collect();
    for hundred in hundreds {
        let of: Vec<i32> = values
            .range(100 * hundred..100 * (hundred + 1))
            .copied()
            .collect();
        let run: Vec<i32> = (100 * hundred..).take(of.len()).collect();
        assert_eq!(of, run);
    }
}

/// `tests/c/constants.h` has all constants, for calls that must refuse those of other roles.
#[test]
fn the_list_of_constants_for_tests_is_whole() {
    let header = std::fs::read_to_string(root().join("include/periodyn.h")).unwrap();
    let names = constants(&header)
        .into_iter()
        .filter(|(_, value)| *value >= 0);
    let names: Vec<String> = names.map(|(name, _)| format!("    {name},\n")).collect();
    let text = format!(
        "/* All constants that choose something; tests/header.rs writes it. */\n\
         #ifndef PDN_TEST_CONSTANTS_H\n#define PDN_TEST_CONSTANTS_H\n\n\
         #include \"periodyn.h\"\n\nstatic const int32_t all_constants[] = {{\n{}}};\n\n#endif\n",
        names.concat()
    );
    let path = root().join("tests/c/constants.h");
    if std::env::var_os("PDN_BLESS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let found = std::fs::read_to_string(&path).unwrap();
    assert!(
        found == text,
        "PDN_BLESS=1 cargo test --test header rewrites it"
    );
}
