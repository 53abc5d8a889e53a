//! Steady rotation on a grid of one point (docs/theory.md, section 4.4).

use super::TimeRule;
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::{DualMatrix, DualVector};
use crate::workers::Workers;
use nalgebra::Vector6;

/// Each node turns steadily: `V = Ad(M⁻¹) W`, `V̇ = 0`. Internal states are at rest.
#[derive(Debug, Clone)]
pub struct Steady {
    /// `W`: twist of each node about the origin, resolved in space.
    twists: Vec<Vector6<f64>>,
    /// `Ṽ` of each node, as of the last evaluation.
    skews: Vec<DualMatrix>,
}

impl Steady {
    /// With these twists about the origin, resolved in space.
    pub fn new(twists: Vec<Vector6<f64>>) -> Self {
        Steady {
            skews: vec![DualMatrix::zeros(); twists.len()],
            twists,
        }
    }
}

impl TimeRule for Steady {
    fn evaluate(&mut self, state: &GridState, _: &Workers, nodes: &mut [NodeState]) {
        let all = nodes.iter_mut().zip(&state.motions);
        for ((out, motion), (twist, skew)) in all.zip(self.twists.iter().zip(&mut self.skews)) {
            *out = NodeState {
                twist: motion.inverse().adjoint() * twist,
                ..NodeState::at_rest(*motion)
            };
            *skew = DualVector::from_twist(&out.twist).skew();
        }
    }

    fn rates(&mut self, _: usize, _: &[f64], _: f64, rates: &mut [f64]) {
        rates.fill(0.0);
    }

    /// `Δ(Ad(M⁻¹) W) = Ṽ Δu`; modulated, `ΔV = Δu̇ + Ṽ Δu` and `ΔV̇ = Δü + Ṽ Δu̇`.
    fn tangent(&self, node: usize, power: usize, _: usize, _: usize) -> [DualMatrix; 2] {
        let (zero, one) = (DualMatrix::zeros(), DualMatrix::identity());
        match power {
            0 => [self.skews[node], zero],
            1 => [one, self.skews[node]],
            _ => [zero, one],
        }
    }

    fn rate_weight(&self, power: usize, _: usize, _: usize) -> f64 {
        f64::from(power == 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn internal_states_are_at_rest() {
        let mut rates = [1.0, f64::NAN];
        Steady::new(vec![Vector6::repeat(1.0)]).rates(0, &[3.0, 4.0], 2.0, &mut rates);
        assert_eq!(rates, [0.0; 2]);
    }
}
