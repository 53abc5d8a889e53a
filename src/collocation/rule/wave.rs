//! Waves about what stands still (docs/theory.md, section 10.3).

use super::TimeRule;
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::DualMatrix;
use crate::workers::Workers;

/// On a grid of two points, at both of which everything is the same and stands still: increments at
/// the first are cosines of a wave, those at the second its sines, `cos ωt Δu₀ + sin ωt Δu₁`.
#[derive(Debug, Clone, Copy)]
pub struct Wave {
    frequency: f64,
}

impl Wave {
    /// Of a harmonic of this period.
    pub fn new(frequency: f64) -> Self {
        Wave { frequency }
    }

    /// `D = ω [0 1; −1 0]`.
    fn first(&self, l: usize, k: usize) -> f64 {
        match (l, k) {
            (0, 1) => self.frequency,
            (1, 0) => -self.frequency,
            _ => 0.0,
        }
    }
}

impl TimeRule for Wave {
    fn evaluate(&mut self, state: &GridState, _: &Workers, nodes: &mut [NodeState]) {
        for (out, motion) in nodes.iter_mut().zip(&state.motions) {
            *out = NodeState::at_rest(*motion);
        }
    }

    fn rates(&mut self, _: usize, _: &[f64], _: f64, rates: &mut [f64]) {
        rates.fill(0.0);
    }

    /// `D + μ`, and `D² + 2 μ D + μ²` with `D² = −ω²`.
    fn tangent(&self, _: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2] {
        let (d, one) = (self.first(l, k), f64::from(l == k));
        let factors = match power {
            0 => [d, -self.frequency.powi(2) * one],
            1 => [one, 2.0 * d],
            _ => [0.0, one],
        };
        factors.map(|factor| DualMatrix::identity() * factor)
    }

    fn rate_weight(&self, power: usize, l: usize, k: usize) -> f64 {
        match power {
            0 => self.first(l, k),
            1 => f64::from(l == k),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{RuleWorkspace, over};
    use super::*;
    use crate::fourier::TimeGrid;
    use crate::motion::Motion;
    use crate::system::System;
    use crate::test_models::small::whirled_beam;
    use nalgebra::Vector6;
    use std::f64::consts::TAU;

    /// Cosines and sines are what three points of the wave's period have of it.
    #[test]
    fn derivatives_are_those_on_three_points_of_its_period() {
        let (model, period) = whirled_beam();
        let system = System::new(&model, period).unwrap();
        let grid = TimeGrid::new(3, 0.7).unwrap();
        let mut three = over(grid, system.nodes());
        let state = GridState::reference(&system, grid);
        let mut nodes = vec![NodeState::at_rest(Motion::identity()); 3 * system.nodes()];
        three.evaluate(&state, &Workers::default(), &mut nodes);
        let parts = [0, 1].map(|part| Vector6::from_fn(|i, _| (3 * i + part) as f64 - 7.0));
        let at = |of: &dyn Fn(usize) -> Vector6<f64>, point: usize| {
            let (sine, cosine) = (TAU * point as f64 / 3.0).sin_cos();
            of(0) * cosine + of(1) * sine
        };
        let workspace = &mut RuleWorkspace::default();
        let sampled: Vec<f64> = (0..3)
            .flat_map(|point| at(&|part| parts[part], point).as_slice().to_vec())
            .collect();
        let mut expected = vec![[Vector6::zeros(); 2]; 3];
        three.vary(1, &sampled, workspace, &mut expected);
        let wave = Wave::new(grid.frequency());
        let mut rates = vec![[Vector6::zeros(); 2]; 2];
        let both = [parts[0].as_slice(), parts[1].as_slice()].concat();
        wave.vary(1, &both, workspace, &mut rates);
        for (point, expected) in expected.iter().enumerate() {
            for (order, expected) in expected.iter().enumerate() {
                let off = at(&|part| rates[part][order], point) - expected;
                assert!(off.amax() < 1e-12 * expected.amax(), "{off}");
            }
        }
    }
}
