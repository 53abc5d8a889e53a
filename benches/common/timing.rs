//! Times of whole solves, and of the machine's own matrix product to compare them with.

use faer::{Accum, Mat, Par, linalg::matmul::matmul};
use periodyn::model::Model;
use periodyn::solve::{Outcome, PeriodicOptions, solve_periodic};
use rustix::time::{ClockId, clock_gettime};
use std::time::{Duration, Instant};

/// Time of 10⁹ double-precision multiply-adds in faer's matrix product on one core.
pub fn product_time() -> Duration {
    let n = 1000;
    let a = Mat::from_fn(n, n, |i, j| ((i * 7 + j) % 13) as f64);
    let b = a.clone();
    let mut c = Mat::zeros(n, n);
    median((0..5).map(|_| {
        let start = Instant::now();
        let (left, right) = (a.as_ref(), b.as_ref());
        matmul(c.as_mut(), Accum::Replace, left, right, 1.0, Par::Seq);
        start.elapsed()
    }))
}

/// Bytes that the machine reads and writes in a second on one core: sums of two vectors far larger
/// than its caches.
pub fn bandwidth() -> f64 {
    let count = 16_000_000;
    let (a, b) = (vec![1.0f64; count], vec![2.0f64; count]);
    let mut sum = vec![0.0f64; count];
    let shortest = (0..6)
        .map(|_| {
            let start = Instant::now();
            for ((sum, a), b) in sum.iter_mut().zip(&a).zip(&b) {
                *sum = a + 3.0 * b;
            }
            std::hint::black_box(&mut sum);
            start.elapsed()
        })
        .min();
    // Counted as is usual: what is written is not read first.
    (3 * count * size_of::<f64>()) as f64 / shortest.unwrap().as_secs_f64()
}

/// Processor time of `work` on all threads, and what it gave.
pub fn processor_time<T>(work: impl FnOnce() -> T) -> (Duration, T) {
    let now = || {
        let time = clock_gettime(ClockId::ProcessCPUTime);
        Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
    };
    let start = now();
    let given = work();
    (now() - start, given)
}

/// The one in the middle.
pub fn median(times: impl Iterator<Item = Duration>) -> Duration {
    let mut times: Vec<Duration> = times.collect();
    times.sort();
    times[times.len() / 2]
}

/// Titles of the columns of [`solve_and_print`].
pub const TITLES: &str =
    "  N unknowns   total   guess assembly analysis factorisation substitution  total/product";

/// Solves nine times for each number of grid points, and prints medians in milliseconds.
pub fn solve_and_print(
    name: &str,
    model: &Model,
    period: f64,
    grid_points: &[usize],
    product: Duration,
) {
    for &points in grid_points {
        let options = PeriodicOptions::with_grid_points(points);
        let runs: Vec<_> = (0..9)
            .map(|_| {
                let start = Instant::now();
                let solve = solve_periodic(model, period, &options, &mut |_, _| true).unwrap();
                let total = start.elapsed();
                assert_eq!(solve.report.outcome, Outcome::Converged);
                (total, solve)
            })
            .collect();
        let total = median(runs.iter().map(|r| r.0));
        let solve = &runs[0].1;
        let unknowns = (6 * solve.system.nodes() + solve.system.own_unknowns()) * points;
        print!(
            "{name:32} {points:3} {unknowns:8} {:7.2}",
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
            "  {:.2}  ({} + {} iterations)",
            total.as_secs_f64() / product.as_secs_f64(),
            solve.guess_iterations,
            solve.report.iterations.len()
        );
    }
}
