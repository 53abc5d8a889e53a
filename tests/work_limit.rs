//! The work of a solve is bounded, and what ends for that says so.

#[path = "common/mod.rs"]
mod common;
#[path = "adaptive/examples.rs"]
#[allow(dead_code)]
mod examples;

use examples::{Example, planar_four_bar, rigid_slider_crank};
use periodyn::output::Solution;
use periodyn::solve::{Adaptation, GridPoints, Outcome, PeriodicOptions};

fn solve(example: &Example, work_limit: f64, threads: usize) -> Solution {
    let options = PeriodicOptions {
        work_limit,
        threads,
        grid_points: GridPoints::Adaptive(Adaptation {
            largest: 63,
            ..Adaptation::default()
        }),
        ..PeriodicOptions::default()
    };
    Solution::solve(&example.model, example.period, &options, &mut |_, _| true).unwrap()
}

#[test]
fn work_that_is_not_allowed_ends_a_solve_which_says_so() {
    let example = rigid_slider_crank(120.0);
    let found = solve(&example, 1e-9, 1);
    assert_eq!(found.outcome(), Outcome::WorkLimit);
    let report = found.report();
    println!("{report}");
    for words in ["all work was done", "options.work_limit allows"] {
        assert!(report.contains(words), "no {words} in: {report}");
    }
    // Without bound, and with that of the defaults, it is the same solution.
    let unbounded = solve(&example, 0.0, 1);
    let default = solve(&example, PeriodicOptions::default().work_limit, 1);
    assert_eq!(unbounded.outcome(), Outcome::Converged);
    assert_eq!(default.outcome(), Outcome::Converged);
    assert_eq!(unbounded.details().state, default.details().state);
}

#[test]
fn the_same_bound_ends_a_solve_at_the_same_place_on_any_number_of_threads() {
    let example = planar_four_bar();
    let mut outcomes = Vec::new();
    let mut limit = 1e-5;
    while limit < 2.0 {
        let [one, two] = [1, 2].map(|threads| solve(&example, limit, threads));
        assert_eq!(one.outcome(), two.outcome());
        assert_eq!(one.grid().points(), two.grid().points());
        let iterations = |s: &Solution| s.details().total_iterations;
        assert_eq!(iterations(&one), iterations(&two));
        if one.outcome() == Outcome::ToleranceNotMet && one.grid().points() < 63 {
            let why = &one.details().report.explanation;
            assert!(why.contains("all work was done"), "{why}");
        }
        println!("{limit:.1e}: {:?} {}", one.outcome(), one.grid().points());
        outcomes.push((one.outcome(), one.grid().points()));
        limit *= 2.0;
    }
    assert_eq!(outcomes[0].0, Outcome::WorkLimit);
    assert_eq!(outcomes.last(), Some(&(Outcome::ToleranceNotMet, 63)));
    // What is allowed more is not worse.
    let rank = |outcome: Outcome| usize::from(outcome.is_solution());
    assert!(
        outcomes.is_sorted_by_key(|(outcome, points)| (rank(*outcome), rank(*outcome) * points))
    );
}
