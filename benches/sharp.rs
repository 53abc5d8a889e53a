//! Sharp motions: errors against the number of grid points, equispaced and closer together about
//! events. Leaves `sharp.csv` beside the other tables.
//!
//! `EVENTS` replaces the events of a `CASE` by others: `time,width,share;...`, in periods.

mod common;

use common::models::sharp::{Sharp, end_stop, pulsed_strip};
use common::table::Table;
use common::timing::processor_time;
use periodyn::fourier::SharpEvent;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;
use std::env::var;
use std::time::Duration;

/// Grids, and the mapped one that counts as exact.
const POINTS: [usize; 9] = [21, 31, 41, 51, 61, 75, 91, 111, 135];
const EXACT: usize = 201;
/// Errors below are rounding.
const ROUNDING: f64 = 1e-10;

fn on(sharp: &Sharp, points: usize, mapped: bool) -> (Duration, Solution) {
    let options = PeriodicOptions {
        time_map: match mapped {
            true => TimeMapping::Events(sharp.events.clone()),
            false => TimeMapping::Equispaced,
        },
        work_limit: 0.0,
        ..PeriodicOptions::with_grid_points(points)
    };
    let (time, solution) = processor_time(|| {
        Solution::solve(&sharp.model, sharp.period, &options, &mut |_, _| true).unwrap()
    });
    assert_eq!(solution.outcome(), Outcome::Converged);
    (time, solution)
}

/// Positions of the nodes at many times.
fn positions(sharp: &Sharp, solution: &Solution) -> Vec<f64> {
    let times: Vec<f64> = (0..1009)
        .map(|k| sharp.period * f64::from(k) / 1009.0)
        .collect();
    let of = |node: usize| solution.node(node, NodeQuantity::Position, &times).unwrap();
    (0..sharp.model.node_count()).flat_map(of).collect()
}

/// Digits, of base e, that a grid point adds.
fn rate(errors: &[(usize, f64)]) -> f64 {
    let known = errors.iter().filter(|(_, error)| *error > ROUNDING);
    let pairs: Vec<[f64; 2]> = known.map(|(n, error)| [*n as f64, -error.ln()]).collect();
    let mean = |i: usize| pairs.iter().map(|pair| pair[i]).sum::<f64>() / pairs.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let products = pairs.iter().map(|[a, b]| (a - x) * (b - y)).sum::<f64>();
    products / pairs.iter().map(|[a, _]| (a - x) * (a - x)).sum::<f64>()
}

fn main() {
    let mut table = Table::new("sharp", &["model", "grid", "N", "error", "ms"]);
    let case: Option<usize> = var("CASE").ok().and_then(|case| case.parse().ok());
    for (i, mut sharp) in [end_stop(), pulsed_strip()].into_iter().enumerate() {
        if case.is_some_and(|case| case != i) {
            continue;
        }
        let exact = positions(&sharp, &on(&sharp, EXACT, true).1);
        if let Ok(events) = var("EVENTS") {
            let event = |text: &str| {
                let x: Vec<f64> = text.split(',').map(|x| x.parse().unwrap()).collect();
                let [time, width] = [x[0], x[1]].map(|part| part * sharp.period);
                SharpEvent {
                    time,
                    width,
                    share: x[2],
                }
            };
            sharp.events = events.split(';').map(event).collect();
        }
        let mut rates = [0.0; 2];
        for (mapped, rate_of) in [false, true].into_iter().zip(&mut rates) {
            let mut errors = Vec::new();
            for points in POINTS {
                let (time, solution) = on(&sharp, points, mapped);
                let found = positions(&sharp, &solution);
                let both = found.iter().zip(&exact);
                let error = both.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
                errors.push((points, error));
                let grid = if mapped { "mapped" } else { "equispaced" };
                let error = format!("{error:.1e}");
                table.row(cells![
                    sharp.name,
                    grid,
                    points,
                    error,
                    format!("{:.1}", 1e3 * time.as_secs_f64())
                ]);
            }
            *rate_of = rate(&errors);
        }
        println!(
            "{}: rates {rates:.3?}, ratio {:.1}",
            sharp.name,
            rates[1] / rates[0]
        );
    }
}
