//! Rigid mechanisms from model to solution on one thread: processor time, on fixed grids and by
//! default options.

mod common;

use common::mechanisms::{double_pendulum, planar_linkage, slider_crank, spatial_linkage};
use periodyn::output::Solution;
use periodyn::solve::{Outcome, PeriodicOptions};
use rustix::time::{ClockId, clock_gettime};

/// Solves of each case; the shortest time counts.
const ROUNDS: usize = 60;

fn processor_milliseconds() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    1e3 * now.tv_sec as f64 + 1e-6 * now.tv_nsec as f64
}

fn main() {
    println!(
        "| mechanism | N = 15 | N = 25 | by default options | grid points | estimated error |"
    );
    println!("|---|---:|---:|---:|---|---:|");
    for (name, (model, period)) in [
        ("slider-crank", slider_crank()),
        ("double pendulum", double_pendulum()),
        ("planar four-bar", planar_linkage()),
        ("spatial four-bar", spatial_linkage()),
    ] {
        let [fifteen, more] = [15, 25].map(PeriodicOptions::with_grid_points);
        let options = [fifteen, more, PeriodicOptions::default()];
        let mut row = format!("| {name}");
        for (number, options) in options.iter().enumerate() {
            let mut best = f64::INFINITY;
            let mut last = None;
            for _ in 0..ROUNDS {
                let start = processor_milliseconds();
                let solution = Solution::solve(&model, period, options, &mut |_, _| true);
                best = best.min(processor_milliseconds() - start);
                last = Some(solution.expect("a valid model"));
            }
            let Some(solution) = last else { continue };
            assert_eq!(solution.details().report.outcome, Outcome::Converged);
            row += &format!(" | {best:.2} ms");
            if number == 2 {
                let grids = solution.details().grids.iter();
                let grids: Vec<String> = grids.map(|grid| grid.points.to_string()).collect();
                let error = solution
                    .details()
                    .grids
                    .last()
                    .map_or(0.0, |g| g.error_estimate);
                row += &format!(" | {} | {error:.1e}", grids.join(", "));
            }
        }
        println!("{row} |");
    }
}
