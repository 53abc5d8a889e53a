//! Errors of a sharp motion against the number of grid points, equispaced and mapped.

mod common;

use common::converged;
use common::models::sharp::{Sharp, end_stop};
use periodyn::model::Model;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;

fn on(sharp: &Sharp, points: usize, mapped: bool) -> Solution {
    let options = PeriodicOptions {
        time_map: match mapped {
            true => TimeMapping::Events(sharp.events.clone()),
            false => TimeMapping::Equispaced,
        },
        work_limit: 0.0,
        threads: 2,
        ..PeriodicOptions::with_grid_points(points)
    };
    let solution = Solution::solve(&sharp.model, sharp.period, &options, &mut |_, _| true).unwrap();
    converged(solution)
}

/// Positions of all nodes at many times, in lengths of the model.
fn positions(model: &Model, period: f64, solution: &Solution) -> Vec<f64> {
    let times: Vec<f64> = (0..401).map(|k| period * f64::from(k) / 401.0).collect();
    let of = |node: usize| solution.node(node, NodeQuantity::Position, &times).unwrap();
    (0..model.node_count()).step_by(3).flat_map(of).collect()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()))
}

/// Digits gained with each grid point, by the errors that are no rounding.
fn rate(points: &[usize], errors: &[f64]) -> f64 {
    let known = points
        .iter()
        .zip(errors)
        .filter(|(_, error)| **error > 1e-11);
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    for (n, error) in known {
        xs.push(*n as f64);
        ys.push(-error.ln());
    }
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    let (x, y) = (mean(&xs), mean(&ys));
    let products = xs.iter().zip(&ys).map(|(a, b)| (a - x) * (b - y));
    products.sum::<f64>() / xs.iter().map(|a| (a - x) * (a - x)).sum::<f64>()
}

#[test]
fn sharp_motions_converge_faster_on_mapped_grids() {
    let sharp = end_stop();
    let exact = positions(&sharp.model, sharp.period, &on(&sharp, 201, true));
    let points = [31, 51, 75, 101];
    let errors = [false, true].map(|mapped| {
        points.map(|n| {
            let found = positions(&sharp.model, sharp.period, &on(&sharp, n, mapped));
            apart(&found, &exact)
        })
    });
    let rates = [0, 1].map(|i| rate(&points, &errors[i]));
    // 2.4 was measured on 31 to 135 points.
    assert!(rates[1] > 2.0 * rates[0], "{errors:?} {rates:?}");
    assert!(errors[1][3] < 0.05 * errors[0][3], "{errors:?}");
}
