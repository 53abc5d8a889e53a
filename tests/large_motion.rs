//! Motions as large as the beams themselves: Newton's method takes full steps, with extrapolated
//! stress resultants where the beams stretch by terms of second order, and ends where short steps
//! end.

mod models;

use models::beams::{damped_strip, shaken_rod};
use models::four_bar::{FOUR_BAR_PERIOD, spatial_four_bar};
use periodyn::output::Solution;
use periodyn::solve::{InitialGuess, Iteration, Outcome, PeriodicOptions, Stage};

/// Grid points.
const POINTS: usize = 15;
/// On each of two grids. The guess is tens of degrees off. Line search alone took 13 iterations for
/// 12 N, and 90 for 20 N.
const ITERATIONS: usize = 6;

/// The solution, and Newton's iterations on all grids.
fn solve(force: f64, guess: InitialGuess) -> (Solution, Vec<Iteration>) {
    let (model, period) = shaken_rod(force, 4, 2);
    let mut options = PeriodicOptions {
        guess,
        ..PeriodicOptions::with_grid_points(POINTS)
    };
    options.newton.tolerance = 1e-11;
    let mut iterations = Vec::new();
    let solution = Solution::solve(&model, period, &options, &mut |stage, iteration| {
        if stage == Stage::Newton {
            iterations.push(*iteration);
        }
        true
    })
    .unwrap();
    let report = solution.report();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{force} N: {report}"
    );
    (solution, iterations)
}

#[test]
fn large_bending_takes_few_full_steps_and_ends_where_small_ones_end() {
    let (mut small_steps, _) = solve(4.0, InitialGuess::Default);
    for force in 5..=20 {
        let state = small_steps.details().state.clone();
        (small_steps, _) = solve(f64::from(force), InitialGuess::State(state));
        if ![12, 20].contains(&force) {
            continue;
        }
        let (at_once, iterations) = solve(f64::from(force), InitialGuess::Default);
        println!("{force} N: {iterations:#?}");
        assert!(iterations[0].increment > 0.3);
        assert!(
            iterations
                .iter()
                .all(|i| i.number <= ITERATIONS && i.step == 1.0)
        );
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
        let (solution, iterations) = solve(force, InitialGuess::Default);
        let taken = solution.details().report.iterations.len();
        assert!(taken <= ITERATIONS, "{force} N: {taken}");
        // The coarse grid may not hold such motions, but does not try for long.
        assert!(iterations.len() <= ITERATIONS + 8);
    }
}

#[test]
fn far_solutions_are_found_on_a_coarse_grid_first() {
    let (solution, iterations) = solve(12.0, InitialGuess::Default);
    let coarse = solution.details().periodic().unwrap().coarse_start.unwrap();
    let fine = &solution.details().report.iterations;
    assert_eq!(coarse.points, 9);
    assert_eq!(coarse.iterations + fine.len(), iterations.len());
    // Stress resultants are carried, too: without them the second increment is a seventh of the
    // first.
    assert!(fine[0].increment < 1e-3 && fine[1].increment < 1e-3 * fine[0].increment);
    let report = solution.report();
    assert!(
        report.contains("start: a solution on 9 grid points"),
        "{report}"
    );

    // The quasi-static motion of the four-bar is near.
    let options = PeriodicOptions::with_grid_points(15);
    let model = spatial_four_bar(2, 1);
    let near = Solution::solve(&model, FOUR_BAR_PERIOD, &options, &mut |_, _| true).unwrap();
    assert_eq!(near.outcome(), Outcome::Converged);
    assert!(near.details().periodic().unwrap().coarse_start.is_none());
}

#[test]
fn cancelled_on_the_coarse_grid_what_was_reached_is_given_on_the_fine_one() {
    let (model, period) = shaken_rod(12.0, 4, 2);
    let options = PeriodicOptions::with_grid_points(POINTS);
    let mut seen = 0;
    let solution = Solution::solve(&model, period, &options, &mut |stage, _| {
        seen += usize::from(stage == Stage::Newton);
        seen < 3
    })
    .unwrap();
    assert_eq!(solution.outcome(), Outcome::Cancelled);
    assert_eq!((seen, solution.details().report.iterations.len()), (3, 3));
    let reached = &solution.details().state;
    assert_eq!(reached.points(), POINTS);
    let (found, _) = solve(12.0, InitialGuess::Default);
    let length = found.details().system.scales().length;
    // The third increment was that small.
    assert!(reached.distance(&found.details().state, length) < 1e-2);
}

#[test]
fn damping_of_all_strains_costs_no_iterations() {
    // Stretching of second order, times axial damping, made this 30 to 100 iterations.
    for (seconds, axial) in [
        (2e-3, 2.1e7),
        (1e-2, 2.1e5),
        (1e-2, 2.1e7),
        (1e-2, 2.1e9),
        (5e-2, 2.1e7),
    ] {
        let (model, period) = damped_strip(seconds, axial, 6, 3);
        let mut total = 0;
        let options = PeriodicOptions::with_grid_points(21);
        let solution = Solution::solve(&model, period, &options, &mut |stage, _| {
            total += usize::from(stage == Stage::Newton);
            true
        });
        let solution = solution.unwrap();
        let report = solution.report();
        assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
        assert!(
            total <= 10,
            "{seconds} s, {axial:e} N: {total} iterations\n{report}"
        );
        // What is damped away is the motion, not the equations: no step was shortened.
        let iterations = &solution.details().report.iterations;
        assert!(iterations.iter().all(|i| i.step == 1.0), "{report}");
    }
}
