//! Processor time of the forces and tangents of bent elements: of shells by turns with the products
//! of matrices that their tangents consist of, and of beams.
//!
//!     cargo bench --bench tangents
//!
//! Two revisions are compared by running the programs of both by turns.

mod common;

use common::elements::{bent_beam, bent_shell, evaluate};
use common::table::Table;
use common::timing::{median, processor_time};
use periodyn::elements::Contribution;
use std::hint::black_box;
use std::time::Duration;

const REPETITIONS: usize = 400;

/// Evaluations of a beam that are timed together.
const BEAMS: u32 = 20;

/// Columns and number of the products for the geometric stiffness, and for the material one.
fn products(side: usize) -> [(usize, usize); 2] {
    [(24 * side * (side - 1), 3), (6 * side * side, 6)]
}

/// Times of tangents and of products alone, by turns.
fn times_of_shell(side: usize) -> [Vec<Duration>; 2] {
    let (shell, rows) = (bent_shell(side), 3 * side * side);
    let mut out = Contribution::new(side * side, 0, true);
    let mut sum = faer::Mat::<f64>::zeros(rows, rows);
    let factors = products(side).map(|(columns, times)| {
        let factor = faer::Mat::from_fn(rows, columns, |i, j| (i + 3 * j) as f64 * 1e-3);
        (factor, times)
    });
    let mut multiply = || {
        for (factor, times) in black_box(&factors) {
            for _ in 0..*times {
                let (accumulate, sequential) = (faer::Accum::Add, faer::Par::Seq);
                let (left, right) = (factor.as_ref(), factor.transpose());
                faer::linalg::matmul::matmul(&mut sum, accumulate, left, right, 1.0, sequential);
            }
        }
    };
    let both = (0..REPETITIONS).map(|_| {
        let tangents = processor_time(|| evaluate(&shell, &mut out)).0;
        (tangents, processor_time(&mut multiply).0)
    });
    let (tangents, products) = both.unzip();
    [tangents, products]
}

fn main() {
    let titles = [
        "nodes a side",
        "tangents, µs",
        "products, µs",
        "products' rate, Gflop/s",
    ];
    let mut shells = Table::new("shell_elements", &titles);
    for side in 2..=6 {
        let [tangents, alone] = times_of_shell(side).map(|times| median(times.into_iter()));
        let rows = 3 * side * side;
        let each = products(side).map(|(columns, times)| 2 * rows * rows * columns * times);
        let rate = each.iter().sum::<usize>() as f64 / alone.as_secs_f64();
        let micro = |time: Duration| format!("{:.1}", 1e6 * time.as_secs_f64());
        shells.row(cells![
            side,
            micro(tangents),
            micro(alone),
            format!("{:.1}", 1e-9 * rate)
        ]);
    }
    let mut beams = Table::new("beam_elements", &["nodes", "tangents, µs"]);
    for count in [2, 3, 5, 7] {
        let (beam, mut out) = (bent_beam(count), Contribution::new(count, 0, true));
        let times = (0..REPETITIONS).map(|_| {
            let all = || (0..BEAMS).for_each(|_| evaluate(&beam, &mut out));
            processor_time(all).0 / BEAMS
        });
        let time = median(times);
        beams.row(cells![count, format!("{:.2}", 1e6 * time.as_secs_f64())]);
    }
}
