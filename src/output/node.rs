//! Motions, velocities and accelerations of nodes.

use super::solution::Solution;
use crate::collocation::too_coarse;
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{CardinalWeights, PeriodicSeries};
use crate::motion::{PeriodicMotion, halves, quaternion_from_rotation};
use nalgebra::Vector3;

/// What can be asked of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NodeQuantity {
    /// Position, inertial frame; 3 components.
    Position,
    /// Rotation matrix, column by column (the node's axes in the inertial frame); 9 components.
    RotationMatrix,
    /// Unit quaternion `(w, x, y, z)`, of continuous sign; 4 components.
    Quaternion,
    /// Velocity of the origin and angular velocity, inertial frame; 6 components.
    Velocity,
    /// Acceleration of the origin and angular acceleration, inertial frame; 6 components.
    Acceleration,
    /// Material velocity `(Rᵀṙ, ω)`; 6 components.
    MaterialVelocity,
    /// Time derivative of the material velocity; 6 components.
    MaterialAcceleration,
}

impl NodeQuantity {
    /// Number of components.
    pub fn components(self) -> usize {
        match self {
            NodeQuantity::Position => 3,
            NodeQuantity::Quaternion => 4,
            NodeQuantity::RotationMatrix => 9,
            _ => 6,
        }
    }

    /// Appends the components for a node's state. `last` keeps the sign of quaternions continuous.
    fn push(self, state: &NodeState, last: &mut Option<[f64; 4]>, out: &mut Vec<f64>) {
        let r = &state.motion.rotation;
        let mut both = |linear: Vector3<f64>, angular: Vector3<f64>| {
            out.extend(linear.iter());
            out.extend(angular.iter());
        };
        let (v, w) = halves(&state.twist);
        let (dv, dw) = halves(&state.twist_rate);
        match self {
            NodeQuantity::Position => out.extend(state.motion.position.iter()),
            NodeQuantity::RotationMatrix => out.extend(r.iter()),
            NodeQuantity::Quaternion => {
                let mut q = quaternion_from_rotation(r);
                let along: f64 = last.iter().flatten().zip(&q).map(|(a, b)| a * b).sum();
                if along < 0.0 {
                    q = q.map(|x| -x);
                }
                *last = Some(q);
                out.extend(q);
            }
            NodeQuantity::Velocity => both(r * v, r * w),
            // r̈ = R (v̇ + ω × v), and the angular acceleration is R ω̇.
            NodeQuantity::Acceleration => both(r * (dv + w.cross(&v)), r * dw),
            NodeQuantity::MaterialVelocity => both(v, w),
            NodeQuantity::MaterialAcceleration => both(dv, dw),
        }
    }
}

impl Solution {
    /// Calls `visit` with the state of `node` at each of `times`, anywhere, without any filter.
    pub(super) fn each_node_state(
        &self,
        node: usize,
        times: &[f64],
        visit: impl FnMut(&NodeState),
    ) -> Result<()> {
        let interpolation = PeriodicMotion::new(self.solve.state.node(node));
        self.each_state_of(node, &interpolation, times, visit)
    }

    fn each_state_of(
        &self,
        node: usize,
        interpolation: &PeriodicMotion,
        times: &[f64],
        mut visit: impl FnMut(&NodeState),
    ) -> Result<()> {
        if self.is_trajectory() {
            for place in self.places(times)? {
                visit(&self.state_between(node, &place));
            }
            return Ok(());
        }
        let grid = self.grid();
        let mut weights = CardinalWeights::new(grid);
        for &time in times {
            weights.move_to(time);
            let state = interpolation
                .at(&weights)
                .ok_or_else(|| too_coarse(node, time, grid.points()))?;
            visit(&state);
        }
        Ok(())
    }

    /// A quantity of a node at `times`; components of each time together.
    ///
    /// # Errors
    /// An unknown node, or [`ErrorKind::GridTooCoarse`] if its motion cannot be interpolated.
    pub fn node(&self, node: usize, quantity: NodeQuantity, times: &[f64]) -> Result<Vec<f64>> {
        self.model.require_node("node", node)?;
        let mut out = Vec::with_capacity(times.len() * quantity.components());
        let mut last = None;
        let mut interpolation = PeriodicMotion::new(self.solve.state.node(node));
        if let Some(filter) = &self.filter {
            interpolation = interpolation.filtered(self.grid(), filter);
        }
        self.each_state_of(node, &interpolation, times, |state| {
            let state = self.solve.system.inertial_state(state);
            quantity.push(&state, &mut last, &mut out)
        })?;
        Self::finite("node", out)
    }

    /// Fourier series of each component of a quantity of a node, through its values on the grid.
    ///
    /// # Errors
    /// An unknown node, or a quaternion that changes sign over the period.
    pub fn node_series(&self, node: usize, quantity: NodeQuantity) -> Result<Vec<PeriodicSeries>> {
        self.require_harmonics()?;
        self.model.require_node("node", node)?;
        let points = self.grid().points();
        let rows: Vec<Vec<f64>> = if self.filter.is_some() {
            // Of the filtered motion, which is not filtered once more.
            let times: Vec<f64> = self.grid().times().collect();
            let values = self.node(node, quantity, &times)?;
            values
                .chunks_exact(quantity.components())
                .map(<[f64]>::to_vec)
                .collect()
        } else {
            let mut last = None;
            let states = self.solve.states_of(node);
            let row = |state: &NodeState| {
                let mut row = Vec::new();
                let state = self.solve.system.inertial_state(state);
                quantity.push(&state, &mut last, &mut row);
                row
            };
            states.iter().map(row).collect()
        };
        if quantity == NodeQuantity::Quaternion {
            let closing: f64 = rows[0]
                .iter()
                .zip(&rows[points - 1])
                .map(|(a, b)| a * b)
                .sum();
            if closing < 0.0 {
                return Err(Error::new(
                    ErrorKind::NotAvailable,
                    format!(
                        "the quaternion of node {node} changes sign over the period, as its node \
                         makes an odd \
                         number of turns; ask for the rotation matrix"
                    ),
                ));
            }
        }
        let samples = self.samples_of(quantity.components(), |k| Ok(rows[k].clone()))?;
        let columns = samples.columns.iter();
        Ok(columns
            .map(|values| PeriodicSeries::interpolate(self.grid(), values, 0.0))
            .collect())
    }
}
