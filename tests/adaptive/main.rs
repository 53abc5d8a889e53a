//! Adaptive grids: the tolerance is met without naming a grid, and the estimate is honest.

#[path = "../common/mod.rs"]
mod common;
mod examples;

use common::*;
use examples::*;
use periodyn::collocation::DecayKind;
use periodyn::output::Solution;
use periodyn::solve::*;

/// Points of the reference, whose own error is below 5e-12 on all smooth examples.
const REFERENCE: usize = 81;

fn adaptive(example: &Example, error_tolerance: f64, largest: usize) -> Solution {
    let options = PeriodicOptions {
        grid_points: GridPoints::Adaptive(Adaptation {
            error_tolerance,
            largest,
        }),
        ..PeriodicOptions::default()
    };
    Solution::solve(&example.model, example.period, &options, &mut |_, _| true).unwrap()
}

/// Error of the motions at all points of the grid of `exact`, in the measure of the estimate.
fn true_error(solution: &Solution, exact: &Solution) -> f64 {
    let system = &exact.details().system;
    let there = solution.prolonged(exact.grid()).unwrap();
    there.distance(&exact.details().state, system.scales().length)
}

#[test]
fn the_tolerance_is_met_and_the_estimate_honest_on_all_smooth_examples() {
    let tolerance = 1e-8;
    println!(
        "{:24} {:>5} {:>9} {:>9} {:>7}",
        "", "N", "estimate", "error", "ratio"
    );
    let mut failures = Vec::new();
    for example in smooth() {
        let exact = solve(&example.model, example.period, REFERENCE);
        let found = adaptive(&example, tolerance, 255);
        assert_eq!(found.outcome(), Outcome::Converged, "{}", found.report());
        let grids = &found.details().grids;
        // Each grid alone, and as one of the sequence.
        for tried in grids {
            let alone = solve(&example.model, example.period, tried.points);
            let error = true_error(&alone, &exact);
            let own = alone.diagnostics().error_estimate;
            let [ratio, ratio_alone] = [tried.error_estimate, own].map(|x| x / error);
            println!(
                "{:24} {:5} {:9.1e} {error:9.1e} {ratio:7.2}   alone {ratio_alone:7.2}   {} iterations",
                example.name, tried.points, tried.error_estimate, tried.iterations
            );
            if !(0.1..10.0).contains(&ratio) || !(0.1..10.0).contains(&ratio_alone) {
                failures.push(format!("{} N = {}", example.name, tried.points));
            }
        }
        let error = true_error(&found, &exact);
        if error > tolerance {
            failures.push(format!("{}: {error:e}", example.name));
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn rounding_ends_the_adaptation() {
    for example in [
        slider_crank(false, 120.0),
        scotch_yoke(),
        forced_cantilever(),
    ] {
        let found = adaptive(&example, 1e-17, 2001);
        println!("{}", found.report());
        assert_eq!(found.outcome(), Outcome::ToleranceNotMet);
        assert_eq!(found.diagnostics().decay, DecayKind::Rounding);
        assert!(found.grid().points() < 150);
        assert!(found.diagnostics().error_estimate < 1e-13);
        let explanation = &found.details().report.explanation;
        assert!(explanation.contains("rounding"), "{explanation}");
    }
}

#[test]
fn narrow_peaks_end_at_the_largest_grid_and_are_named() {
    let example = planar_four_bar();
    let found = adaptive(&example, 1e-6, 81);
    println!("{}", found.report());
    assert_eq!(found.outcome(), Outcome::ToleranceNotMet);
    assert_eq!(found.grid().points(), 81);
    let explanation = &found.details().report.explanation;
    for words in ["81 grid points", "1.0e-6", "no more than 81", "narrow peak"] {
        assert!(explanation.contains(words), "no {words} in: {explanation}");
    }
    let diagnostics = found.diagnostics();
    assert_eq!(diagnostics.decay, DecayKind::Slow);
    // All bars lie in a line at T/4 and 3T/4.
    let turn = diagnostics.least_resolved_time / example.period;
    assert!((turn % 0.5 - 0.25).abs() < 0.02, "{turn}");
    assert!(diagnostics.error_estimate > 1e-3 && diagnostics.error_estimate < 0.3);
}
