//! What steps resolve: Radau's method for `u' = iω u`.

use crate::collocation::{RadauWeights, STAGES};
use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};
use nalgebra::Complex;
use std::f64::consts::TAU;

/// Angles of a mode in one step that are looked at.
const FINENESS: f64 = 0.05;
const LARGEST: f64 = 4.0;

/// Error of a mode that turns by `angle` in a step.
fn error(angle: f64) -> f64 {
    let weights = RadauWeights::new(1.0);
    let own = Complex::new(0.0, angle);
    let matrix = Mat::from_fn(STAGES, STAGES, |i, j| {
        let diagonal = if i == j { own } else { Complex::default() };
        Complex::from(weights.first[i][j]) - diagonal
    });
    let rhs = Mat::from_fn(STAGES, 1, |i, _| Complex::from(-weights.start[i]));
    let values = PartialPivLu::new(matrix.as_ref()).solve(&rhs);
    (values[(STAGES - 1, 0)] - own.exp()).norm()
}

/// Largest angle of a mode in a step that leaves no more than `tolerance` in so many steps.
fn largest_angle(steps: usize, tolerance: f64) -> f64 {
    let angles = (1..).map(|i| FINENESS * f64::from(i));
    angles
        .take_while(|&angle| angle < LARGEST && steps as f64 * error(angle) <= tolerance)
        .last()
        .unwrap_or(FINENESS)
}

/// Angle of modes in a period that so many steps resolve.
pub(super) fn resolved_frequency(steps: usize, tolerance: f64) -> f64 {
    steps as f64 * largest_angle(steps, tolerance)
}

/// Steps that resolve a mode of this angle in a period.
pub(super) fn steps_for(angle: f64, tolerance: f64) -> usize {
    let mut steps = 3.0 * (angle / TAU).max(1.0);
    while steps < 1e6 && resolved_frequency(steps as usize, tolerance) < angle {
        steps *= 1.1;
    }
    steps as usize
}
