//! A plate that flaps through large angles: its periodic motion by the direct solver.

mod models;

use models::shells::flapping_plate;
use periodyn::output::Solution;
use periodyn::solve::*;

const POINTS: usize = 21;

#[test]
fn a_plate_that_flaps_through_large_angles_converges_quadratically() {
    let (model, period) = flapping_plate(0.6, [2, 1], 4);
    let mut options = PeriodicOptions {
        linear: LinearMethod::Direct,
        ..PeriodicOptions::with_grid_points(POINTS)
    };
    options.newton.tolerance = 1e-10;
    let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
    let report = solution.report();
    println!("{report}");
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    let iterations = &solution.details().report.iterations;
    println!("{iterations:#?}");
    assert!(iterations.iter().all(|i| i.step == 1.0));
    // The last increments: each at most the square of the one before, but for rounding.
    let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
    for pair in increments.windows(2).rev().take(2) {
        assert!(pair[1] <= pair[0] * pair[0] + 1e-11, "{increments:?}");
    }
}
