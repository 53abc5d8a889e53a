//! Given rates at one instant (docs/theory.md, section 12.2).

use super::TimeRule;
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::DualMatrix;
use crate::workers::Workers;
use nalgebra::Vector6;

/// An instant whose velocities and accelerations are given; the unknowns are those of equations
/// that are linear in accelerations (or in velocities): what the Jacobian holds is the inertia,
/// constraint gradients and what balances rates of internal states.
#[derive(Debug, Clone)]
pub struct GivenRates {
    /// `v` of each node.
    pub twist: Vec<Vector6<f64>>,
    /// `v̇` of each node.
    pub twist_rate: Vec<Vector6<f64>>,
    /// Rates of internal states, in the order of the multipliers.
    pub rates: Vec<f64>,
    /// Factor of the inertia in the Jacobian: accelerations are it times the unknowns.
    pub weight: f64,
    /// Whether the Jacobian has damping and stiffness beside the inertia, as that of a step has:
    /// those of elements without mass.
    pub elastic: bool,
}

impl TimeRule for GivenRates {
    fn evaluate(&mut self, state: &GridState, _: &Workers, nodes: &mut [NodeState]) {
        let rates = self.twist.iter().zip(&self.twist_rate);
        for ((out, motion), (twist, twist_rate)) in nodes.iter_mut().zip(&state.motions).zip(rates)
        {
            *out = NodeState {
                motion: *motion,
                twist: *twist,
                twist_rate: *twist_rate,
            };
        }
    }

    fn rates(&mut self, place: usize, _: &[f64], _: f64, rates: &mut [f64]) {
        rates[0] = self.rates[place];
    }

    fn tangent(&self, _: usize, power: usize, _: usize, _: usize) -> [DualMatrix; 2] {
        let multiple = |factor: f64| DualMatrix::identity() * factor;
        match power {
            0 if self.elastic => [multiple(self.weight.sqrt()), multiple(self.weight)],
            0 => [DualMatrix::zeros(), multiple(self.weight)],
            _ => [DualMatrix::zeros(); 2],
        }
    }

    fn rate_weight(&self, power: usize, _: usize, _: usize) -> f64 {
        match power {
            0 => self.weight,
            _ => 0.0,
        }
    }

    fn is_elastic(&self, with_mass: bool) -> bool {
        self.elastic && !with_mass
    }

    fn holds_states(&self) -> bool {
        true
    }
}
