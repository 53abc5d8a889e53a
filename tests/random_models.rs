//! A share of the random machines that `script/zoo` solves: by default options they converge, and to what is right.

mod common;
mod machines;

use machines::judge::{self, Checked, Verdict};
use machines::{FAMILIES, machine};
use periodyn::solve::Outcome;

const SEED: u64 = 20;
/// Machines of each family.
const SHARE: usize = 6;
/// Least number that converge, of all.
const LEAST: usize = 54;

#[test]
fn random_machines_converge_and_none_falsely() {
    let mut converged = 0;
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        for index in 0..SHARE {
            let machine = machine(SEED, family, index);
            let place = || format!("{}:{index} ({name}: {})", family + 1, machine.what);
            let solution =
                judge::solve(&machine).unwrap_or_else(|error| panic!("{}: {error}", place()));
            if solution.outcome() != Outcome::Converged {
                println!("{}: {}", place(), solution.report());
                continue;
            }
            converged += 1;
            let mut checked = Checked {
                error: judge::check(&machine, &solution),
                ..Checked::default()
            };
            let estimate = solution.diagnostics().error_estimate;
            if checked.verdict(estimate) == Verdict::Unchecked {
                checked.march = judge::march(&machine, &solution);
            }
            assert!(
                checked.verdict(estimate) != Verdict::False,
                "{}: estimated error {estimate:.1e}, {checked:?}",
                place()
            );
        }
    }
    assert!(
        converged >= LEAST,
        "{converged} machines of {}",
        SHARE * FAMILIES.len()
    );
}

#[test]
fn machines_are_drawn_from_seed_and_index() {
    let what = |seed, index| machine(seed, 0, index).what;
    assert_eq!(what(1, 5), what(1, 5));
    assert_ne!(what(1, 5), what(2, 5));
    assert_ne!(what(1, 5), what(1, 6));
}
