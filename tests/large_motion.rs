//! Motions as large as the beams themselves: Newton's method takes full steps, with extrapolated stress resultants where
//! the beams stretch by terms of second order, and ends where short steps end.

#[allow(unused_macros)]
#[path = "../benches/common/mod.rs"]
mod models;

use models::shaken_rod;
use periodyn::output::Solution;
use periodyn::solve::{InitialGuess, Outcome, PeriodicOptions};

/// Grid points.
const POINTS: usize = 15;
/// The guess is tens of degrees off. Line search alone took 13 iterations for 12 N, and 90 for 20 N.
const ITERATIONS: usize = 6;

fn solve(force: f64, guess: InitialGuess) -> Solution {
    let (model, period) = shaken_rod(force, 4, 2);
    let mut options = PeriodicOptions {
        guess,
        ..PeriodicOptions::with_grid_points(POINTS)
    };
    options.newton.tolerance = 1e-11;
    let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
    let report = solution.report();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{force} N: {report}"
    );
    solution
}

#[test]
fn large_bending_takes_few_full_steps_and_ends_where_small_ones_end() {
    let mut small_steps = solve(4.0, InitialGuess::Default);
    for force in 5..=20 {
        let state = small_steps.details().state.clone();
        small_steps = solve(f64::from(force), InitialGuess::State(state));
        if ![12, 20].contains(&force) {
            continue;
        }
        let at_once = solve(f64::from(force), InitialGuess::Default);
        let iterations = &at_once.details().report.iterations;
        println!("{force} N: {iterations:#?}");
        assert!(iterations[0].increment > 0.3);
        assert!(iterations.len() <= ITERATIONS && iterations.iter().all(|i| i.step == 1.0));
        let system = &at_once.details().system;
        let (a, b) = (&at_once.details().state, &small_steps.details().state);
        // Ten times the increments at which both end.
        assert!(a.distance(b, system.scales().length) < 1e-10);
    }
}

#[test]
fn far_larger_ones_are_found_as_fast() {
    // Up to eight times the force that bends the rod by half its length.
    for force in [45.0, 100.0] {
        let solution = solve(force, InitialGuess::Default);
        let taken = solution.details().report.iterations.len();
        assert!(taken <= ITERATIONS, "{force} N: {taken}");
    }
}
