//! From model to solution: the spatial four-bar on one thread, and where the time goes.
//!
//! Times are medians; beside them stands the time of 10⁹ multiply-adds of the machine's own matrix
//! product on one core, measured in the same run, so that machines can be compared.

mod common;

use common::{PERIOD, spatial_four_bar};
use faer::{Accum, Mat, Par, linalg::matmul::matmul};
use periodyn::solve::{Outcome, PeriodicOptions, solve_periodic};
use std::time::{Duration, Instant};

/// Time of 10⁹ double-precision multiply-adds in faer's matrix product.
fn gemm_time() -> Duration {
    let n = 1000;
    let a = Mat::from_fn(n, n, |i, j| ((i * 7 + j) % 13) as f64);
    let b = a.clone();
    let mut c = Mat::zeros(n, n);
    median((0..5).map(|_| {
        let start = Instant::now();
        matmul(
            c.as_mut(),
            Accum::Replace,
            a.as_ref(),
            b.as_ref(),
            1.0,
            Par::Seq,
        );
        start.elapsed()
    }))
}

fn median(times: impl Iterator<Item = Duration>) -> Duration {
    let mut times: Vec<Duration> = times.collect();
    times.sort();
    times[times.len() / 2]
}

fn main() {
    let gemm = gemm_time();
    println!(
        "10⁹ multiply-adds of a matrix product: {:.1} ms",
        1e3 * gemm.as_secs_f64()
    );
    println!("Spatial four-bar, two-node elements, times in ms:");
    println!(
        "elements   N unknowns   total   guess assembly analysis factorisation substitution  total/product"
    );
    for (elements, points) in [(8, 11), (8, 21), (8, 41), (32, 21)] {
        let model = spatial_four_bar(elements, 1);
        let options = PeriodicOptions::with_grid_points(points);
        let runs: Vec<_> = (0..9)
            .map(|_| {
                let start = Instant::now();
                let solve = solve_periodic(&model, PERIOD, &options, &mut |_, _| true).unwrap();
                let total = start.elapsed();
                assert_eq!(solve.report.outcome, Outcome::Converged);
                (total, solve)
            })
            .collect();
        let total = median(runs.iter().map(|r| r.0));
        let solve = &runs[0].1;
        let unknowns = (6 * solve.system.nodes() + solve.system.multipliers()) * points;
        print!(
            "{elements:8} {points:3} {unknowns:8} {:7.2}",
            1e3 * total.as_secs_f64()
        );
        for part in [
            median(runs.iter().map(|r| r.1.guess_time)),
            median(runs.iter().map(|r| r.1.timings.assembly)),
            median(runs.iter().map(|r| r.1.timings.analysis)),
            median(runs.iter().map(|r| r.1.timings.factorisation)),
            median(runs.iter().map(|r| r.1.timings.substitution)),
        ] {
            print!(" {:8.2}", 1e3 * part.as_secs_f64());
        }
        println!(
            "  {:.1}  ({} + {} iterations)",
            total.as_secs_f64() / gemm.as_secs_f64(),
            solve.guess_iterations,
            solve.report.iterations.len()
        );
    }
}
