//! Krylov products per Newton step, to 1e-8, of the three preconditioners on all kinds of systems,
//! and the memory traffic of products against the machine's bandwidth.
//!
//! The Jacobian is that at the periodic solution. Counted are the products of a Newton step to it
//! from where a tenth of the inertial forces is missing and, for the quicker of the first two
//! preconditioners, of a solve for noise, in which all harmonics count alike.

mod common;

use common::models::beams::{planar_four_bar, rotor, slider_crank};
use common::models::four_bar::{FOUR_BAR_PERIOD, spatial_four_bar};
use common::table::Table;
use common::timing::{bandwidth, product_time};
use periodyn::fourier::TimeGrid;
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::{
    InitialGuess, LinearTrial, Outcome, PeriodicOptions, Preconditioner, try_linear_solve,
};
use std::f64::consts::{PI, TAU};

const TOLERANCE: f64 = 1e-8;
const POINTS: [usize; 5] = [15, 31, 63, 127, 255];
const ELEMENTS: [usize; 4] = [8, 16, 32, 64];
/// First bending frequency of the slider-crank's hinged coupler, in radians a second.
fn coupler_frequency() -> f64 {
    (PI / 0.3).powi(2) * (13.2f64 / 0.222).sqrt()
}

fn slow_crank(elements: usize, part: f64) -> (Model, f64) {
    let period = TAU / (part * coupler_frequency());
    (slider_crank(elements, 1, period), period)
}

type Make = fn(usize) -> (Model, f64);

/// Two-node elements throughout, to each blade or bar.
const MODELS: [(&str, Make); 5] = [
    ("rotor", rotor),
    ("spatial four-bar", |elements| {
        (spatial_four_bar(elements, 1), FOUR_BAR_PERIOD)
    }),
    ("planar four-bar", |elements| {
        planar_four_bar(elements, 1, 1e-3)
    }),
    ("slider-crank, 1/16", |elements| {
        slow_crank(elements, 1.0 / 16.0)
    }),
    ("slider-crank, 1/10", |elements| {
        slow_crank(elements, 1.0 / 10.0)
    }),
];

fn count(products: Option<usize>) -> String {
    match products {
        Some(products) => products.to_string(),
        None => "-".into(),
    }
}

fn main() {
    println!("Products of a linear solve to {TOLERANCE:e}; - more than 150, or not available.");
    let bandwidth = bandwidth();
    let floor = product_time().as_secs_f64();
    println!(
        "memory bandwidth {:.1} GB/s; 1e9 multiply-adds {:.1} ms",
        1e-9 * bandwidth,
        1e3 * floor
    );
    let mut table = Table::new(
        "krylov",
        &[
            "model",
            "elements",
            "N",
            "unknowns",
            "body-circulant",
            "time-local",
            "circulant",
            "noise",
            "interface",
            "solve ms",
            "product ms",
            "tangents MB",
            "of bandwidth",
        ],
    );
    let only: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .collect();
    for (name, make) in MODELS {
        if !only.is_empty() && !only.iter().any(|o| name.contains(o.as_str())) {
            continue;
        }
        for elements in ELEMENTS {
            let (model, period) = make(elements);
            let mut last: Option<Solution> = None;
            for points in POINTS {
                let mut options = PeriodicOptions::with_grid_points(points);
                let grid = TimeGrid::new(points, period).unwrap();
                if let Some(state) = last.as_ref().and_then(|s| s.prolonged(grid).ok()) {
                    options.guess = InitialGuess::State(state);
                }
                let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
                if solution.outcome() != Outcome::Converged {
                    println!(
                        "{name}, {elements} elements, N = {points}: {}",
                        solution.report()
                    );
                    continue;
                }
                let [body, local, circulant] = [
                    Preconditioner::BodyCirculant,
                    Preconditioner::TimeLocal,
                    Preconditioner::Circulant,
                ]
                .map(|p| try_linear_solve(solution.details(), p, TOLERANCE).unwrap());
                // The quicker one of those that a solve chooses from.
                let seconds = |t: &LinearTrial| match t.products {
                    Some(_) => (t.preparation + t.solution).as_secs_f64(),
                    None => f64::INFINITY,
                };
                let quickest = if seconds(&local) < seconds(&body) {
                    &local
                } else {
                    &body
                };
                let product = body.product.min(local.product).min(circulant.product);
                table.row(cells![
                    name,
                    elements,
                    points,
                    body.unknowns,
                    count(body.products),
                    count(local.products),
                    count(circulant.products),
                    count(quickest.products_of_noise),
                    body.interface,
                    format!("{:.1}", 1e3 * seconds(quickest)),
                    format!("{:.3}", 1e3 * product.as_secs_f64()),
                    format!("{:.1}", 1e-6 * body.tangent_bytes as f64),
                    format!(
                        "{:.2}",
                        body.tangent_bytes as f64 / product.as_secs_f64() / bandwidth
                    ),
                ]);
                last = Some(solution);
            }
        }
    }
}
