//! How the tests solve and compare, and the models that most of them use.

// Each test binary uses its own part of this module.
#![allow(dead_code, unused_imports)]

#[path = "../models/mod.rs"]
pub mod models;
mod random;

pub use models::four_bar::*;
pub use models::parts::*;
pub use models::pendulums::*;
pub use random::Random;

use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::GridState;
use periodyn::elements::Coordinate;
use periodyn::fourier::TimeGrid;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{JointQuantity, NodeQuantity, Solution};
use periodyn::solve::*;
use periodyn::system::System;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Options with the tolerance of all tests: the square of such an increment is below rounding, so
/// that what Newton leaves is rounding alone.
pub fn options(grid_points: usize) -> PeriodicOptions {
    PeriodicOptions {
        newton: NewtonOptions {
            tolerance: 1e-9,
            iteration_limit: 30,
        },
        ..PeriodicOptions::with_grid_points(grid_points)
    }
}

/// A solution, which must have converged.
pub fn converged(solution: Solution) -> Solution {
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    solution
}

/// A solve that must converge.
pub fn solve(model: &Model, period: f64, grid_points: usize) -> Solution {
    let solution = try_solve(model, period, grid_points).unwrap();
    let report = &solution.details().report;
    assert_eq!(solution.outcome(), Outcome::Converged, "{report:#?}");
    solution
}

/// The equilibrium of a model by default options.
pub fn statics(model: &Model) -> Solution {
    let solution = Solution::solve_static(model, &StaticOptions::default(), &mut |_, _| true);
    let solution = solution.unwrap();
    converged(solution)
}

/// A solve from the default guess.
pub fn try_solve(
    model: &Model,
    period: f64,
    grid_points: usize,
) -> periodyn::error::Result<Solution> {
    Solution::solve(model, period, &options(grid_points), &mut |_, _| true)
}

/// A solve under conditions that must converge.
pub fn solve_for(
    model: &Model,
    period: f64,
    free: &[Free],
    conditions: &[Arc<dyn Condition>],
    options: &PeriodicOptions,
) -> Solution {
    let lists = (free, conditions);
    let solution = Solution::solve_conditioned(model, period, lists, options, &mut |_, _| true);
    let solution = solution.unwrap();
    let report = &solution.details().report;
    assert_eq!(solution.outcome(), Outcome::Converged, "{report:#?}");
    solution
}

/// These options, to start at motions that a function of the phase gives to node 0.
pub fn starting_at(
    options: PeriodicOptions,
    (model, points, period): (&Model, usize, f64),
    motion: impl Fn(f64) -> Motion,
) -> PeriodicOptions {
    let grid = TimeGrid::new(points, period).unwrap();
    let mut state = GridState::reference(&System::new(model, period).unwrap(), grid);
    for (k, at) in state.motions.iter_mut().enumerate().take(points) {
        *at = motion(TAU * k as f64 / points as f64);
    }
    PeriodicOptions {
        guess: InitialGuess::State(state),
        ..options
    }
}

/// Moved along x.
pub fn displaced(x: f64) -> Motion {
    Motion::new(Matrix3::identity(), Vector3::x() * x)
}

/// Numbers of points of the grids that an adaptive solve has tried, in order.
pub fn grids_tried(solution: &Solution) -> Vec<usize> {
    let grids = &solution.details().periodic().unwrap().grids;
    grids.iter().map(|grid| grid.points).collect()
}

/// `count` uniform times from 0 to `period`, both included.
pub fn times(period: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| period * i as f64 / (count - 1) as f64)
        .collect()
}

/// Component `i` of quantities with `components` components, at all times.
pub fn column(values: &[f64], components: usize, i: usize) -> Vec<f64> {
    values.iter().skip(i).step_by(components).copied().collect()
}

pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    largest(a.iter().zip(b).map(|(x, y)| x - y))
}

/// Largest difference relative to the range of `reference`.
pub fn relative_to_range(a: &[f64], reference: &[f64]) -> f64 {
    let low = reference.iter().copied().fold(f64::INFINITY, f64::min);
    let high = reference.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    largest_difference(a, reference) / (high - low)
}

/// Slope and correlation of the straight line through points `(x, ln y)`.
pub fn exponential_fit(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let mean_y = points.iter().map(|p| p.1.ln()).sum::<f64>() / n;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (x, y) in points {
        let (dx, dy) = (x - mean_x, y.ln() - mean_y);
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    (xy / xx, xy / (xx * yy).sqrt())
}

impl FourBarModel {
    pub fn solve(&self, grid_points: usize) -> Solution {
        solve(&self.model, self.period, grid_points)
    }

    /// Curves of figures 8 to 10: `x₃` and `v₃` of B, and the driving torque at D.
    pub fn curves(&self, solution: &Solution, times: &[f64]) -> [Vec<f64>; 3] {
        let position = solution.node(self.b, NodeQuantity::Position, times);
        let velocity = solution.node(self.b, NodeQuantity::Velocity, times);
        let effort = JointQuantity::DrivingEffort(Coordinate::Rotation1);
        [
            column(&position.unwrap(), 3, 2),
            column(&velocity.unwrap(), 6, 2),
            solution.joint(self.joints[3], effort, times).unwrap(),
        ]
    }
}
