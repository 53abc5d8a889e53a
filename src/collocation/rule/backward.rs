//! Backward differences on a grid of one point (docs/theory.md, section 4.4).

use super::TimeRule;
use super::kinematics::{BackwardWeights, NodeKinematics};
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::DualMatrix;
use crate::workers::Workers;

/// Backward differences with past states.
#[derive(Debug, Clone)]
pub struct Backward {
    weights: BackwardWeights,
    /// Latest first.
    past: Vec<GridState>,
    nodes: Vec<NodeKinematics>,
}

impl Backward {
    /// From past states, latest first.
    pub fn new(weights: BackwardWeights, past: Vec<GridState>) -> Self {
        let nodes = past.first().map_or(0, |state| state.motions.len());
        Backward {
            weights,
            past,
            nodes: vec![NodeKinematics::default(); nodes],
        }
    }
}

impl TimeRule for Backward {
    fn evaluate(&mut self, state: &GridState, _: &Workers, nodes: &mut [NodeState]) {
        for (node, (kinematics, out)) in self.nodes.iter_mut().zip(nodes).enumerate() {
            let motions = state.node(node);
            let past = self.past.iter().map(|state| &state.motions[node]);
            kinematics.evaluate_backward(&self.weights, &motions[0], past);
            kinematics.write_states(motions, std::slice::from_mut(out));
        }
    }

    fn rates(&mut self, place: usize, values: &[f64], _: f64, rates: &mut [f64]) {
        rates[0] = self.weights.first[0] * values[0];
        for (weight, past) in self.weights.first[1..].iter().zip(&self.past) {
            rates[0] += weight * past.multipliers[place];
        }
    }

    fn tangent(&self, node: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2] {
        match power {
            0 => {
                let weights = (self.weights.first[0], self.weights.second[0]);
                self.nodes[node].tangent(weights, l, k)
            }
            _ => [DualMatrix::zeros(); 2],
        }
    }

    fn rate_weight(&self, power: usize, _: usize, _: usize) -> f64 {
        match power {
            0 => self.weights.first[0],
            _ => 0.0,
        }
    }
}
