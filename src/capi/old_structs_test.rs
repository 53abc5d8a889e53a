//! Structs of programs that were compiled with an older header: of each size that a release had,
//! no more is read or written, and what they do not know has its default.

use super::beam::pdn_stations;
use super::branch::{pdn_branch_options, pdn_branch_point};
use super::contents::{pdn_force_info, pdn_joint_info};
use super::equations::{pdn_equations_options, pdn_equations_sizes};
use super::guard::init;
use super::line::pdn_line;
use super::march::{pdn_march_diagnostics, pdn_march_options};
use super::modes::{pdn_mode, pdn_modes_options};
use super::options::{Options, out_struct, read};
use super::periodic::pdn_periodic_options;
use super::quantity::pdn_quantity;
use super::section::pdn_section;
use super::sensitivity::pdn_sensitivity_options;
use super::shell::{pdn_shell_placement, pdn_shell_section};
use super::shooting::pdn_shooting_options;
use super::signal::pdn_signal;
use super::solution::pdn_diagnostics;
use super::stability::{pdn_multiplier, pdn_stability_options};
use super::statics::pdn_static_options;
use super::summary::pdn_summary;
use super::surface::pdn_surface;
use super::user_force::pdn_tangent_check;
use std::collections::BTreeSet;

const WORD: usize = size_of::<u64>();
const CANARY: u64 = 0xdead_beef_dead_beef;

fn words<T>(value: &T) -> Vec<u64> {
    let count = size_of::<T>() / WORD;
    let words = std::ptr::from_ref(value).cast::<u64>();
    // SAFETY: structs of options have no padding, and are aligned as words.
    unsafe { std::slice::from_raw_parts(words, count) }.to_vec()
}

/// `kept`: the sizes that releases had; new ones come after them.
fn check<T: Options>(name: &str, kept: &[usize]) {
    assert!(T::SIZES.starts_with(kept), "{name}: {:?}", T::SIZES);
    assert_eq!(T::SIZES.last(), Some(&size_of::<T>()), "{name}");
    assert!(T::SIZES.is_sorted(), "{name}: {:?}", T::SIZES);
    let defaults = words(&T::defaults());
    for &size in T::SIZES {
        assert_eq!(size % WORD, 0, "{name}");
        let known = size / WORD;
        // The caller's struct, and what follows it in memory.
        let mut memory = vec![CANARY; known + 1];
        init(memory.as_mut_ptr().cast::<T>(), size, name);
        assert_eq!(memory[0], size as u64, "{name}");
        assert_eq!(
            memory[1..known],
            defaults[1..known],
            "{name} of {size} bytes"
        );
        assert_eq!(memory[known], CANARY, "{name} of {size} bytes");
        let given = words(&read(memory.as_ptr().cast::<T>(), name).unwrap());
        assert_eq!(given[1..], defaults[1..], "{name} of {size} bytes");
        // What is given is what the caller knows of it, and no more.
        let pattern: Vec<u64> = (0..size_of::<T>() / WORD).map(|i| i as u64 + 1).collect();
        // SAFETY: any bits are valid.
        let value: T = unsafe { pattern.as_ptr().cast::<T>().read() };
        out_struct(memory.as_mut_ptr().cast::<T>(), name)
            .unwrap()
            .set(value);
        assert_eq!(memory[0], size as u64, "{name}");
        assert_eq!(
            memory[1..known],
            pattern[1..known],
            "{name} of {size} bytes"
        );
        assert_eq!(memory[known], CANARY, "{name} of {size} bytes");
        let given = words(&read(memory.as_ptr().cast::<T>(), name).unwrap());
        assert_eq!(given[1..known], pattern[1..known], "{name} of {size} bytes");
        assert_eq!(given[known..], defaults[known..], "{name} of {size} bytes");
    }
}

macro_rules! check_all {
    ($($type:ident: $sizes:expr;)*) => {{
        $(check::<$type>(stringify!($type), &$sizes);)*
        BTreeSet::from([$(stringify!($type).to_string()),*])
    }};
}

#[test]
fn structs_of_old_programs_are_read_and_written_as_far_as_they_go() {
    let checked = check_all! {
        pdn_branch_options: [120];
        pdn_branch_point: [88];
        pdn_diagnostics: [112, 136, 160, 208];
        pdn_equations_options: [80];
        pdn_equations_sizes: [72];
        pdn_force_info: [248, 256, 264];
        pdn_joint_info: [224];
        pdn_line: [128];
        pdn_march_diagnostics: [88];
        pdn_march_options: [152, 160];
        pdn_mode: [56];
        pdn_modes_options: [32];
        pdn_multiplier: [64];
        pdn_periodic_options: [80, 96, 104, 112, 120, 136, 152];
        pdn_quantity: [40, 72];
        pdn_section: [872];
        pdn_sensitivity_options: [24];
        pdn_shell_placement: [48];
        pdn_shell_section: [2600];
        pdn_shooting_options: [72, 80];
        pdn_signal: [88];
        pdn_stability_options: [40];
        pdn_static_options: [120, 128];
        pdn_stations: [40];
        pdn_summary: [88];
        pdn_surface: [128];
        pdn_tangent_check: [64];
    };
    // None is left out.
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/capi");
    let mut all = BTreeSet::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let text = std::fs::read_to_string(entry.unwrap().path()).unwrap();
        let found = text.split("\nunsafe impl Options for pdn_").skip(1);
        let names = found.filter_map(|rest| rest.split_whitespace().next());
        all.extend(names.map(|name| format!("pdn_{name}")));
    }
    assert_eq!(all, checked);
}
