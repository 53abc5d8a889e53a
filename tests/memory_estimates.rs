//! What a solve tells to take of memory before it takes it.

mod common;

use common::models::beams::{forced_cantilever, rotor_blade};
use common::models::shells::flapping_plate;
use periodyn::error::ErrorKind;
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::{LinearMethod, Outcome, PeriodicOptions};

/// The bytes that a refusal names.
fn estimate(model: &Model, period: f64, options: &PeriodicOptions) -> f64 {
    // The first is that of the states alone.
    let mut limit = 1;
    loop {
        let options = PeriodicOptions {
            memory_limit: limit,
            ..options.clone()
        };
        let error = match Solution::solve(model, period, &options, &mut |_, _| false) {
            Err(error) if error.kind() == ErrorKind::OutOfMemory => error.to_string(),
            _ => return limit as f64,
        };
        let words: Vec<&str> = error.split_whitespace().collect();
        let at = words.iter().position(|word| *word == "bytes").unwrap();
        limit = words[at - 1].parse().unwrap();
    }
}

#[test]
fn estimates_are_at_least_what_linear_equations_take_and_at_most_three_times_as_much() {
    for (name, (model, period), points) in [
        ("plate", flapping_plate(0.4, [6, 3], 3), 15),
        (
            "plate of two nodes a side",
            flapping_plate(0.4, [10, 5], 2),
            15,
        ),
        (
            "plate of five nodes a side",
            flapping_plate(0.4, [2, 1], 5),
            15,
        ),
        ("cantilever", forced_cantilever(60, 3), 31),
        (
            "cantilever of linear elements",
            forced_cantilever(150, 1),
            31,
        ),
        ("blade", rotor_blade(40, 3), 31),
    ] {
        let options = PeriodicOptions {
            linear: LinearMethod::Iterative(None),
            work_limit: 0.0,
            ..PeriodicOptions::with_grid_points(points)
        };
        let told = estimate(&model, period, &options);
        let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(solution.outcome(), Outcome::Converged);
        let record = solution.details().periodic().unwrap();
        let taken = record.iterative.as_ref().unwrap().bytes as f64;
        println!(
            "{name}: {told:e} told, {taken:e} taken, {:.2}",
            told / taken
        );
        assert!(told >= taken && told <= 3.0 * taken);
    }
}
