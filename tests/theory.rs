//! `docs/theory.md`: the sections that comments cite are there, and so are the files that it names.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const CITED: &str = "docs/theory.md, section ";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn theory() -> String {
    fs::read_to_string(root().join("docs/theory.md")).unwrap()
}

/// Numbers of the headings.
fn sections(text: &str) -> BTreeSet<&str> {
    let headings = text.lines().filter(|line| line.starts_with("##"));
    headings
        .filter_map(|line| number(line.trim_start_matches(['#', ' '])))
        .collect()
}

/// The number of a section that a text begins with.
fn number(text: &str) -> Option<&str> {
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let number = text[..end].trim_end_matches('.');
    (!number.is_empty()).then_some(number)
}

fn rust_files(directory: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// All comments of a file, one after the other, without what marks them and their lines.
fn comments(text: &str) -> String {
    let lines = text.lines().map(str::trim_start);
    let lines = lines.filter(|line| line.starts_with("//"));
    let words = lines.flat_map(|line| line.trim_start_matches(['/', '!']).split_whitespace());
    words.collect::<Vec<_>>().join(" ")
}

/// What is wrong with the sections that a text cites: of this library's theory those that are not
/// there, of other texts those that do not say which.
fn dangling(text: &str, sections: &BTreeSet<&str>) -> Vec<String> {
    let mut found = Vec::new();
    for (at, word) in text.match_indices("section ") {
        let rest = &text[at + word.len()..];
        let Some(number) = number(rest) else {
            continue;
        };
        let is_ours = text[..at + word.len()].ends_with(CITED);
        let behind = &rest[number.len()..];
        let is_papers = [" of the paper", " of Han"]
            .iter()
            .any(|of| behind.starts_with(of));
        if is_ours && !sections.contains(number) || !is_ours && !is_papers {
            found.push(format!("section {number}"));
        }
    }
    found
}

#[test]
fn sections_that_are_cited_exist() {
    let theory = theory();
    let sections = sections(&theory);
    let mut files = Vec::new();
    rust_files(&root().join("src"), &mut files);
    let mut cited = 0;
    for path in files {
        let text = comments(&fs::read_to_string(&path).unwrap());
        cited += text.matches(CITED).count();
        let wrong = dangling(&text, &sections);
        assert!(wrong.is_empty(), "{} cites {wrong:?}", path.display());
    }
    assert!(cited > 20, "{cited}");
}

#[test]
fn sections_that_do_not_exist_are_found() {
    let headings = "# T\n## 1. One\ntext 9.9\n### 1.2 Two\n";
    let sections = sections(headings);
    assert_eq!(sections, BTreeSet::from(["1", "1.2"]));
    let source = "/// As (docs/theory.md,\n    /// section 1.2).\nfn f() {} // section 7\n";
    assert!(dangling(&comments(source), &sections).is_empty());
    for (text, wrong) in [
        ("docs/theory.md, section 1.3", "section 1.3"),
        ("docs/theory.md, section 2.", "section 2"),
        ("(section 1.2)", "section 1.2"),
        ("section 4 of the formulation", "section 4"),
    ] {
        assert_eq!(dangling(text, &sections), [wrong]);
    }
    assert!(dangling("section 4 of the paper, a section of it", &sections).is_empty());
}

#[test]
fn sections_of_the_theory_refer_to_each_other() {
    let theory = theory();
    let sections = sections(&theory);
    for (at, word) in theory.match_indices("ection ") {
        if let Some(number) = number(&theory[at + word.len()..]) {
            assert!(sections.contains(number), "section {number}");
        }
    }
}

#[test]
fn files_that_the_theory_names_exist() {
    let theory = theory();
    let named: BTreeSet<&str> = theory.split('`').skip(1).step_by(2).collect();
    let files = named.iter().filter(|name| name.contains('/'));
    for file in files.clone() {
        assert!(root().join(file).is_file(), "{file}");
    }
    // All that computes anything is described.
    let mut sources = Vec::new();
    for directory in ["motion", "fourier", "elements", "collocation", "solve"] {
        rust_files(&root().join("src").join(directory), &mut sources);
    }
    let plain = [
        "mod.rs",
        "absent.rs",
        "_test.rs",
        "tests.rs",
        "division.rs",
        "test_models.rs",
        "watch.rs",
        "dense.rs",
    ];
    for path in sources {
        let file = path.strip_prefix(root()).unwrap().to_str().unwrap();
        let is_plain = plain.iter().any(|name| file.ends_with(name));
        assert!(
            is_plain || files.clone().any(|name| *name == file),
            "{file}"
        );
    }
}
