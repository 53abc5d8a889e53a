//! Which changes are tried: of all that there are, those that a seed puts first.

use crate::find::{self, Mutant};
use std::collections::HashSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What is changed.
const PARTS: [&str; 5] = [
    "elements",
    "collocation",
    "motion",
    "fourier",
    "solve/newton",
];

fn sources(folder: &Path, all: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            sources(&path, all)?;
        } else if path.extension().is_some_and(|end| end == "rs") {
            all.push(path);
        }
    }
    Ok(())
}

/// All changes of the tree at `root`, in the order of its files.
pub fn all(root: &Path) -> io::Result<Vec<Mutant>> {
    let mut paths = Vec::new();
    for part in PARTS {
        sources(&root.join("src").join(part), &mut paths)?;
    }
    paths.sort();
    let (mut mutants, mut tests) = (Vec::new(), HashSet::new());
    for path in &paths {
        let source = fs::read_to_string(path)?;
        let bad = |e: syn::Error| io::Error::other(format!("{}: {e}", path.display()));
        for module in find::test_modules(&source).map_err(bad)? {
            tests.insert(path.with_file_name(format!("{module}.rs")));
        }
        let file = path.strip_prefix(root).map_err(io::Error::other)?;
        mutants.extend(find::mutants(&file.to_string_lossy(), &source).map_err(bad)?);
    }
    mutants.retain(|mutant| !tests.contains(&root.join(&mutant.file)));
    Ok(mutants)
}

/// A number that depends on the seed and the name alone.
fn lot(seed: u64, name: &str) -> u64 {
    let mut x = seed;
    // FNV-1a, then SplitMix64's last steps.
    for byte in name.bytes() {
        x = (x ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// All of these in the order of the seed.
pub fn in_order_of(seed: u64, mut mutants: Vec<Mutant>) -> Vec<Mutant> {
    let seed = seed ^ 0xcbf2_9ce4_8422_2325;
    mutants.sort_by_cached_key(|mutant| (lot(seed, &mutant.name), mutant.name.clone()));
    mutants
}
