//! Rigid mechanisms from model to solution on one thread: processor time, on fixed grids and by
//! default options.
//!
//! Arguments are names of mechanisms, or parts of them: only these are solved.

mod common;

use common::models::linkages::{
    planar_linkage, rigid_slider_crank, spatial_linkage, sprung_double_pendulum,
};
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::{Outcome, PeriodicOptions};
use rustix::time::{ClockId, clock_gettime};

/// Solves of each case; the shortest time counts.
const ROUNDS: usize = 60;

fn processor_milliseconds() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    1e3 * now.tv_sec as f64 + 1e-6 * now.tv_nsec as f64
}

/// The solution, and the shortest time that it took.
fn solve(model: &Model, period: f64, options: &PeriodicOptions) -> (Solution, f64) {
    let timed = || {
        let start = processor_milliseconds();
        let solution = Solution::solve(model, period, options, &mut |_, _| true);
        let time = processor_milliseconds() - start;
        let solution = solution.expect("a valid model");
        assert_eq!(solution.outcome(), Outcome::Converged);
        (solution, time)
    };
    let (solution, first) = timed();
    let best = (1..ROUNDS).fold(first, |best, _| best.min(timed().1));
    (solution, best)
}

fn main() {
    // Cargo itself gives an option.
    let names = std::env::args().skip(1).filter(|a| !a.starts_with('-'));
    let names: Vec<String> = names.collect();
    println!(
        "| mechanism | N = 15 | N = 25 | by default options | grid points | estimated error |"
    );
    println!("|---|---:|---:|---:|---|---:|");
    for (name, (model, period)) in [
        ("slider-crank", rigid_slider_crank()),
        ("double pendulum", sprung_double_pendulum()),
        ("planar four-bar", planar_linkage()),
        ("spatial four-bar", spatial_linkage()),
    ] {
        if !names.is_empty() && !names.iter().any(|part| name.contains(part)) {
            continue;
        }
        let fixed = [15, 25].map(|points| {
            let options = PeriodicOptions::with_grid_points(points);
            solve(&model, period, &options).1
        });
        let (solution, adaptive) = solve(&model, period, &PeriodicOptions::default());
        let grids = &solution.details().periodic().unwrap().grids;
        let points: Vec<String> = grids.iter().map(|grid| grid.points.to_string()).collect();
        println!(
            "| {name} | {:.1} ms | {:.1} ms | {adaptive:.1} ms | {} | {:.1e} |",
            fixed[0],
            fixed[1],
            points.join(", "),
            grids.last().map_or(0.0, |grid| grid.error_estimate)
        );
    }
}
