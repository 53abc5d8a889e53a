//! Errors of a sharp motion against the number of grid points, equispaced and mapped.

mod common;
#[path = "models/machines/mod.rs"]
mod machines;

use common::converged;
use common::models::beams::slider_crank;
use common::models::sharp::{Sharp, end_stop, snapping_four_bar};
use periodyn::model::Model;
use periodyn::output::{BeamQuantity, NodeQuantity, Solution};
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

fn by_itself(model: &Model, period: f64, error_tolerance: f64) -> Solution {
    let options = PeriodicOptions {
        threads: 2,
        grid_points: GridPoints::Adaptive(Adaptation {
            error_tolerance,
            largest: 401,
            ..Adaptation::default()
        }),
        ..PeriodicOptions::default()
    };
    converged(Solution::solve(model, period, &options, &mut |_, _| true).unwrap())
}

#[test]
fn narrow_peaks_are_found_and_resolved_without_being_named() {
    let elements = 5;
    let sharp = snapping_four_bar(elements, 1e-3);
    let solution = by_itself(&sharp.model, sharp.period, 1e-4);
    let events = solution.grid().map().events(1.0);
    // Both peaks, by 601 points about the events that suit the model.
    for (at, exact) in [(0.25, -5483.80), (0.75, -5953.18)] {
        assert!(
            events.iter().any(|e| (e.time - at).abs() < 0.01),
            "{events:?}"
        );
        let near: Vec<f64> = (-2000..=2000)
            .map(|i| sharp.period * (at + 1e-5 * f64::from(i)))
            .collect();
        let force = solution.beam(elements / 2, 0.0, BeamQuantity::Force, &near);
        let peak = force
            .unwrap()
            .iter()
            .step_by(6)
            .copied()
            .fold(0.0, f64::min);
        println!("{at} {peak} on {} points", solution.grid().points());
        assert!((peak / exact - 1.0).abs() < 1e-3, "{at}: {peak}");
    }
}

#[test]
fn grids_of_smooth_motions_are_left_as_they_are() {
    let period = 0.1;
    let model = slider_crank(2, 2, period);
    let solution = by_itself(&model, period, 1e-8);
    assert!(solution.grid().map().is_identity(), "{}", solution.report());
}

/// A planar four-bar whose mapped grid takes all work that is allowed.
#[test]
fn where_a_map_leads_nowhere_the_solve_goes_on_without_it() {
    let machine = machines::machine(11, 1, 0);
    let options = PeriodicOptions {
        grid_points: GridPoints::Adaptive(Adaptation {
            error_tolerance: 1e-5,
            response_tolerance: 1e-3,
            largest: 401,
        }),
        threads: 2,
        ..PeriodicOptions::default()
    };
    let solution = Solution::solve(&machine.model, machine.period, &options, &mut |_, _| true);
    let solution = converged(solution.unwrap());
    assert!(solution.grid().map().is_identity());
}
