//! Sharp motions: errors against the number of grid points, equispaced and closer together about
//! events. Leaves `sharp.csv` and `sharp_rates.csv` beside the other tables.
//!
//! `DRAWN` says how many machines of each family are drawn from `SEED` (20) instead, and solved to
//! a tolerance on equispaced grids and with maps that the solve finds: leaves `sharp_drawn.csv`.

mod common;
#[path = "../tests/models/drawn_sharp.rs"]
mod drawn_sharp;

use common::models::sharp::{Sharp, end_stop, pulsed_strip, snapping_four_bar};
use common::table::Table;
use common::timing::processor_time;
use drawn_sharp::{FAMILIES, drawn};
use periodyn::fourier::{SharpEvent, TimeGrid, TimeMap};
use periodyn::model::Model;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;
use std::env::var;
use std::time::Duration;

/// Errors below are rounding.
const ROUNDING: f64 = 1e-11;
/// Of machines that are drawn.
const TOLERANCE: f64 = 1e-5;

/// A motion, the grid that counts as exact, and those that are compared with it: equispaced and
/// mapped.
struct Case {
    sharp: Sharp,
    exact: (usize, bool),
    points: [&'static [usize]; 2],
}

fn cases() -> [Case; 3] {
    let mapped = &[41, 51, 61, 75, 91, 111, 135];
    [
        Case {
            sharp: end_stop(),
            exact: (751, false),
            points: [&[31, 61, 91, 135, 201, 271, 341, 421, 501], mapped],
        },
        Case {
            sharp: pulsed_strip(),
            exact: (751, false),
            points: [&[31, 61, 91, 135, 201, 271, 341, 421, 501], mapped],
        },
        Case {
            sharp: snapping_four_bar(5, 1e-3),
            exact: (601, true),
            points: [
                &[101, 151, 201, 301, 401, 601, 801],
                &[151, 201, 251, 301, 351, 401],
            ],
        },
    ]
}

fn grid(sharp: &Sharp, points: usize, mapped: bool) -> TimeGrid {
    let events: &[SharpEvent] = if mapped { &sharp.events } else { &[] };
    let map = TimeMap::new(events, sharp.period).unwrap();
    TimeGrid::new(points, sharp.period).unwrap().mapped(map)
}

/// On a grid; from a solution, if there is one, as what errors a grid leaves is asked here, not
/// what a solution takes.
fn on(sharp: &Sharp, points: usize, mapped: bool, from: Option<&Solution>) -> Option<Solution> {
    let start = |from: &Solution| from.prolonged(grid(sharp, points, mapped)).unwrap();
    let options = PeriodicOptions {
        time_map: match mapped {
            true => TimeMapping::Events(sharp.events.clone()),
            false => TimeMapping::Equispaced,
        },
        guess: from.map_or(InitialGuess::Default, |from| {
            InitialGuess::State(start(from))
        }),
        work_limit: 0.0,
        ..PeriodicOptions::with_grid_points(points)
    };
    let observe = &mut |_, _: &_| true;
    let solution = Solution::solve(&sharp.model, sharp.period, &options, observe).unwrap();
    (solution.outcome() == Outcome::Converged).then_some(solution)
}

/// Positions of the nodes at many times.
fn positions(model: &Model, solution: &Solution) -> Vec<f64> {
    let period = solution.grid().period();
    let times: Vec<f64> = (0..2003).map(|k| period * f64::from(k) / 2003.0).collect();
    let of = |node: usize| solution.node(node, NodeQuantity::Position, &times).unwrap();
    (0..model.node_count()).flat_map(of).collect()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    let both = a.iter().zip(b);
    both.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
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

fn compare_grids() {
    let mut table = Table::new("sharp", &["model", "grid", "N", "error"]);
    let mut fitted = Vec::new();
    for Case {
        sharp,
        exact,
        points,
    } in cases()
    {
        let model = &sharp.model;
        let finest = on(&sharp, exact.0, exact.1, None).unwrap();
        let exact = positions(model, &finest);
        let mut rates = [0.0; 2];
        for (mapped, rate_of) in [false, true].into_iter().zip(&mut rates) {
            let grid = ["equispaced", "mapped"][usize::from(mapped)];
            let mut errors = Vec::new();
            for &points in points[usize::from(mapped)] {
                let Some(solution) = on(&sharp, points, mapped, Some(&finest)) else {
                    table.row(cells![sharp.name, grid, points, "not converged"]);
                    continue;
                };
                let error = apart(&positions(model, &solution), &exact);
                errors.push((points, error));
                table.row(cells![sharp.name, grid, points, format!("{error:.1e}")]);
            }
            *rate_of = rate(&errors);
        }
        fitted.push((sharp.name, rates));
    }
    let mut table = Table::new("sharp_rates", &["model", "grid", "rate", "times"]);
    for (name, rates) in fitted {
        for (grid, rate) in ["equispaced", "mapped"].into_iter().zip(rates) {
            let times = format!("{:.1}", rate / rates[0]);
            table.row(cells![name, grid, format!("{rate:.4}"), times]);
        }
    }
}

fn to_tolerance(model: &Model, period: f64, time_map: TimeMapping) -> (Duration, Solution) {
    let options = PeriodicOptions {
        time_map,
        grid_points: GridPoints::Adaptive(Adaptation {
            error_tolerance: TOLERANCE,
            ..Adaptation::default()
        }),
        ..PeriodicOptions::default()
    };
    processor_time(|| Solution::solve(model, period, &options, &mut |_, _| true).unwrap())
}

fn solve_drawn(seed: u64, count: u64) {
    let titles = [
        "family",
        "number",
        "grid",
        "outcome",
        "N",
        "events",
        "estimated error",
        "apart",
        "ms",
    ];
    let mut table = Table::new("sharp_drawn", &titles);
    for (family, name) in FAMILIES.iter().enumerate() {
        for number in 0..count {
            let (model, period) = drawn(family, seed, number);
            let mut before: Option<Vec<f64>> = None;
            for (grid, map) in [
                ("equispaced", TimeMapping::Equispaced),
                ("by itself", TimeMapping::Automatic),
            ] {
                let (time, solution) = to_tolerance(&model, period, map);
                let found = positions(&model, &solution);
                let off = before.as_ref().map_or(0.0, |before| apart(before, &found));
                table.row(cells![
                    name,
                    number,
                    grid,
                    format!("{:?}", solution.outcome()),
                    solution.grid().points(),
                    solution.grid().map().events(1.0).len(),
                    format!("{:.1e}", solution.diagnostics().error_estimate),
                    format!("{off:.1e}"),
                    format!("{:.0}", 1e3 * time.as_secs_f64())
                ]);
                before = Some(found);
            }
        }
    }
}

fn main() {
    let number = |name: &str| var(name).ok().and_then(|text| text.parse().ok());
    match number("DRAWN") {
        Some(count) => solve_drawn(number("SEED").unwrap_or(20), count),
        None => compare_grids(),
    }
}
