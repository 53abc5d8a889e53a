//! What steps resolve: Radau's method for `u' = iω u`.

use crate::collocation::{RadauWeights, STAGES};
use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};
use nalgebra::Complex;

/// Angles of a mode in one step that are looked at: multiples of this up to the largest.
const FINENESS: f64 = 0.05;
const LARGEST: f64 = 10.0;
/// Growth of the number of steps that is tried.
const GROWTH: f64 = 1.05;

/// Errors of a mode in one step, by the angle that it turns by.
pub(super) struct Resolution(Vec<f64>);

impl Resolution {
    pub fn new() -> Self {
        let weights = RadauWeights::new(1.0);
        let rhs = Mat::from_fn(STAGES, 1, |i, _| Complex::from(-weights.start[i]));
        let error = |angle: f64| {
            let own = Complex::new(0.0, angle);
            let matrix = Mat::from_fn(STAGES, STAGES, |i, j| {
                let diagonal = if i == j { own } else { Complex::default() };
                Complex::from(weights.first[i][j]) - diagonal
            });
            let values = PartialPivLu::new(matrix.as_ref()).solve(&rhs);
            (values[(STAGES - 1, 0)] - own.exp()).norm()
        };
        let count = (LARGEST / FINENESS) as usize;
        Resolution((1..=count).map(|i| error(FINENESS * i as f64)).collect())
    }

    /// Angle of modes in a period that so many steps resolve, to `tolerance` over all of them.
    pub fn angle(&self, steps: usize, tolerance: f64) -> f64 {
        let resolved = |error: &&f64| steps as f64 * **error <= tolerance;
        let count = self.0.iter().take_while(resolved).count().max(1);
        (steps * count) as f64 * FINENESS
    }

    /// Steps that resolve a mode of this angle in a period.
    pub fn steps(&self, angle: f64, tolerance: f64) -> usize {
        let mut steps = (angle / LARGEST).max(1.0);
        while steps < 1e6 && self.angle(steps as usize, tolerance) < angle {
            steps *= GROWTH;
        }
        steps as usize + 1
    }
}
