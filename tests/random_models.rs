//! A share of the random machines that `script/zoo` solves: by default options they converge, and
//! to what is right.

mod common;
#[path = "models/machines/mod.rs"]
mod machines;

use common::mass_on_a_slide;
use machines::judge::{self, Checked, Verdict};
use machines::{FAMILIES, Machine, machine};
use nalgebra::Vector3;
use periodyn::model::{Signal, SpringDefinition};
use periodyn::output::Solution;
use periodyn::solve::{Outcome, PeriodicOptions};
use std::f64::consts::TAU;

const SEED: u64 = 20;
/// Machines of each family.
const SHARE: usize = 5;
/// Nodes of a machine that is small enough.
const MOST_NODES: usize = 14;
/// Least number that converge, of all.
const LEAST: usize = 48;
/// Iterations after which a solve is given up, those of all attempts together.
const MOST_ITERATIONS: usize = 3000;

/// `script/zoo` has larger ones, and those with pulses, too.
fn share(family: usize) -> impl Iterator<Item = (usize, Machine)> {
    machines::small(SEED, family, MOST_NODES).take(SHARE)
}

#[test]
fn beams_a_hundred_million_times_as_stiff_in_tension_as_in_bending_are_regular() {
    // A spatial four-bar and a rotor on flap and lag hinges: growth of their factors is that of
    // singular ones.
    for (family, index) in [(2, 4), (5, 9)] {
        let machine = machine(94990742, family, index);
        assert!(machine.what.contains("e8"), "{}", machine.what);
        let solution = judge::solve(&machine).unwrap();
        let what = format!("{}: {}", machine.what, solution.report());
        assert_eq!(solution.outcome(), Outcome::Converged, "{what}");
        let checked = Checked {
            error: judge::check(&machine, &solution),
            ..Checked::default()
        };
        let estimate = solution.diagnostics().error_estimate;
        assert_eq!(checked.verdict(estimate), Verdict::Right, "{what}");
    }
}

#[test]
fn random_machines_converge_and_none_falsely() {
    let mut converged = 0;
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        for (index, machine) in share(family) {
            let place = || format!("{}:{index} ({name}: {})", family + 1, machine.what);
            let mut iterations = 0;
            let solved = judge::solve_watched(&machine, &mut |_, _| {
                iterations += 1;
                iterations < MOST_ITERATIONS
            });
            let solution = solved.unwrap_or_else(|error| panic!("{}: {error}", place()));
            if solution.outcome() != Outcome::Converged {
                println!("{}: {:?}", place(), solution.outcome());
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

/// A mass on a spring, of natural frequency 1, with a force `cos jΩt`.
fn shaken(speed: f64, damping: f64, harmonic: usize) -> Machine {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::z());
    model
        .add_spring_damper(SpringDefinition {
            at,
            stiffness: 1.0,
            damping,
            rest: 0.0,
        })
        .unwrap();
    let mut cosines = vec![0.0; harmonic];
    cosines[harmonic - 1] = 1.0;
    let sines = vec![0.0; harmonic];
    let force = Signal::harmonics(0.0, 0.0, &cosines, &sines).unwrap();
    model.add_actuator(at, &force).unwrap();
    Machine {
        model,
        period: TAU / speed,
        what: String::new(),
        undamped: damping == 0.0,
    }
}

#[test]
fn undamped_machines_grow_at_resonance_alone() {
    assert!(judge::grows(&shaken(1.0, 0.0, 1)));
    assert!(judge::grows(&shaken(0.5, 0.0, 2)));
    assert!(!judge::grows(&shaken(1.0, 0.01, 1)));
    assert!(!judge::grows(&shaken(0.7, 0.0, 1)));
    assert!(!judge::grows(&shaken(1.1, 0.0, 1)));
}

#[test]
fn false_solutions_are_found_out() {
    // Eleven points take the twelfth harmonic for the first.
    let machine = shaken(0.2, 0.1, 12);
    let options = PeriodicOptions::with_grid_points(11);
    let alias = Solution::solve(&machine.model, machine.period, &options, &mut |_, _| true);
    let alias = alias.unwrap();
    let by_grid = Checked {
        error: judge::check(&machine, &alias),
        ..Checked::default()
    };
    assert_eq!(by_grid.verdict(1e-9), Verdict::False, "{by_grid:?}");
    let by_march = Checked {
        march: judge::march(&machine, &alias),
        ..Checked::default()
    };
    assert_eq!(by_march.verdict(1e-9), Verdict::False, "{by_march:?}");
    // The right one passes both.
    let right = judge::solve(&shaken(0.2, 0.1, 2)).unwrap();
    let machine = shaken(0.2, 0.1, 2);
    let both = Checked {
        error: judge::check(&machine, &right),
        march: judge::march(&machine, &right),
        ..Checked::default()
    };
    assert_eq!(both.verdict(1e-9), Verdict::Right, "{both:?}");
}

#[test]
fn machines_are_drawn_from_seed_and_index() {
    let what = |seed, index| machine(seed, 0, index).what;
    assert_eq!(what(1, 5), what(1, 5));
    assert_ne!(what(1, 5), what(2, 5));
    assert_ne!(what(1, 5), what(1, 6));
}
