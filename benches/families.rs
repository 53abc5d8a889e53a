//! Families of solutions by the solves that they cost: points of branches with their stability,
//! and multipliers. With arguments only the tables whose names contain one of them.

mod common;

use common::models::beams::{forced_cantilever, rotor_blade, shaken_rod};
use common::table::Table;
use common::timing::{median, processor_time};
use periodyn::model::Model;
use periodyn::solve::{
    BranchOptions, Free, Outcome, PeriodicOptions, Solved, StabilityOptions, follow_branch,
    solve_periodic, solve_stability,
};
use std::f64::consts::TAU;
use std::time::Duration;

const REPETITIONS: usize = 3;

fn main() {
    let asked: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    for (name, measure) in [("multipliers", multipliers as fn()), ("branches", branches)] {
        if asked.is_empty() || asked.iter().any(|a| name.contains(&a[..])) {
            measure();
        }
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1}", 1e3 * time.as_secs_f64())
}

/// A cold solve and its processor time, in the middle of several.
fn cold(model: &Model, period: f64, points: usize) -> (Duration, Solved) {
    let options = PeriodicOptions::with_grid_points(points);
    let solve = || {
        let solve = solve_periodic(model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(solve.report.outcome, Outcome::Converged);
        solve
    };
    let time = median((0..REPETITIONS).map(|_| processor_time(solve).0));
    (time, solve())
}

fn multipliers() {
    let titles = [
        "model",
        "N",
        "solve ms",
        "multipliers ms",
        "number",
        "steps",
        "solves",
    ];
    let mut table = Table::new("multipliers", &titles);
    for (name, (model, period), points) in [
        ("rotor blade, 16 × 1", rotor_blade(16, 1), 31),
        ("rotor blade, 16 × 4", rotor_blade(16, 4), 31),
        ("forced cantilever, 4 × 2", forced_cantilever(4, 2), 31),
        ("forced cantilever, 4 × 4", forced_cantilever(4, 4), 41),
    ] {
        let (solve_time, solve) = cold(&model, period, points);
        let analyse = || solve_stability(&solve, &StabilityOptions::default()).unwrap();
        let time = median((0..REPETITIONS).map(|_| processor_time(analyse).0));
        let found = analyse();
        assert_eq!(found.outcome, Outcome::Converged);
        table.row(cells![
            name,
            points,
            milliseconds(solve_time),
            milliseconds(time),
            found.multipliers.len(),
            found.steps,
            format!("{:.2}", time.as_secs_f64() / solve_time.as_secs_f64()),
        ]);
    }
}

fn branches() {
    let titles = [
        "model",
        "N",
        "points",
        "solve ms",
        "point ms",
        "with stability ms",
        "solves",
    ];
    let mut table = Table::new("branches", &titles);
    for (name, (model, period), points) in [
        ("forced cantilever, 4 × 2", forced_cantilever(4, 2), 31),
        ("forced cantilever, 4 × 4", forced_cantilever(4, 4), 41),
        ("the same, 3 N", shaken_rod(3.0, 4, 4), 41),
    ] {
        let (solve_time, _) = cold(&model, period, points);
        let each = |stability: Option<StabilityOptions>| {
            let options = BranchOptions {
                periodic: PeriodicOptions::with_grid_points(points),
                range: [TAU / period, 1.2 * TAU / period],
                stability,
                ..BranchOptions::default()
            };
            let follow = || {
                follow_branch(&model, period, Free::Frequency, &options, &mut |_, _| true).unwrap()
            };
            let count = follow().points.len();
            let times = (0..REPETITIONS).map(|_| processor_time(follow).0);
            (count, median(times) / count as u32)
        };
        let (_, without) = each(None);
        let (count, with) = each(Some(StabilityOptions::default()));
        table.row(cells![
            name,
            points,
            count,
            milliseconds(solve_time),
            milliseconds(without),
            milliseconds(with),
            format!("{:.2}", with.as_secs_f64() / solve_time.as_secs_f64()),
        ]);
    }
}
