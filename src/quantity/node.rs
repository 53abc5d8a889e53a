//! Motions, velocities and accelerations of nodes.

use super::history::History;
use super::samples::Samples;
use super::variation::Variation;
use super::{Dependence, Probe};
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result, require_id};
use crate::motion::{halves, joined, quaternion_from_rotation};
use crate::system::System;
use nalgebra::{Vector3, Vector6};

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

    pub(super) fn probe(self, system: &System, node: usize) -> Result<Box<dyn Probe>> {
        require_id("node", "node", system.nodes(), node)?;
        Ok(Box::new(NodeProbe {
            node,
            quantity: self,
        }))
    }

    /// Appends the components for a node's state in the inertial frame. `last` keeps the sign of
    /// quaternions continuous.
    pub fn push(self, state: &NodeState, last: &mut Option<[f64; 4]>, out: &mut Vec<f64>) {
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

    /// What a component varies by with the motion, velocity and acceleration of the node.
    fn variation(self, component: usize, state: &NodeState, values: &[f64]) -> [Vector6<f64>; 3] {
        let zero = Vector3::zeros();
        let r = &state.motion.rotation;
        let (v, w) = halves(&state.twist);
        let (dv, dw) = halves(&state.twist_rate);
        let (angular, axis) = (component >= 3, component % 3);
        // Of the axis that the component is along, in the node's frame.
        let along = r.row(axis).transpose();
        let unit = Vector6::ith(component.min(5), 1.0);
        let part = |x: &Vector3<f64>| match angular {
            true => joined(&zero, x),
            false => joined(x, &zero),
        };
        // Δ(R a) = R (Δa + ψ × a).
        let turned = |a: &Vector3<f64>| joined(&zero, &a.cross(&along));
        let mut rows = [Vector6::zeros(); 3];
        match self {
            NodeQuantity::Position => rows[0] = joined(&along, &zero),
            NodeQuantity::RotationMatrix => {
                let column = Vector3::ith(component / 3, 1.0);
                rows[0] = joined(&zero, &column.cross(&along));
            }
            NodeQuantity::Quaternion => {
                // Δq = q ∘ (0, ψ/2).
                let vector = Vector3::new(values[1], values[2], values[3]);
                let row = match component {
                    0 => -vector,
                    i => {
                        let e = Vector3::ith(i - 1, 1.0);
                        e * values[0] + e.cross(&vector)
                    }
                };
                rows[0] = joined(&zero, &(row * 0.5));
            }
            NodeQuantity::Velocity => {
                rows[0] = turned(if angular { &w } else { &v });
                rows[1] = part(&along);
            }
            NodeQuantity::Acceleration if angular => {
                rows[0] = turned(&dw);
                rows[2] = part(&along);
            }
            NodeQuantity::Acceleration => {
                rows[0] = turned(&(dv + w.cross(&v)));
                rows[1] = joined(&along.cross(&w), &v.cross(&along));
                rows[2] = part(&along);
            }
            NodeQuantity::MaterialVelocity => rows[1] = unit,
            NodeQuantity::MaterialAcceleration => rows[2] = unit,
        }
        rows
    }
}

/// A quantity of a node.
#[derive(Debug)]
struct NodeProbe {
    node: usize,
    quantity: NodeQuantity,
}

impl Probe for NodeProbe {
    fn dependence(&self) -> Dependence {
        match self.quantity {
            NodeQuantity::Position | NodeQuantity::RotationMatrix | NodeQuantity::Quaternion => {
                Dependence::Nothing
            }
            _ => Dependence::Period,
        }
    }

    fn samples(&self, history: &History) -> Result<Samples> {
        let mut last = None;
        let samples = Samples::at_each(history, self.quantity.components(), |k, row| {
            let state = history.system.inertial_state(history.node(self.node, k));
            self.quantity.push(&state, &mut last, row);
            Ok(())
        })?;
        if self.quantity == NodeQuantity::Quaternion && history.grid.is_some() {
            require_closed(self.node, &samples)?;
        }
        Ok(samples)
    }

    fn vary(
        &self,
        history: &History,
        (component, k): (usize, usize),
        samples: &Samples,
        weight: f64,
        out: &mut Variation,
    ) -> Result<()> {
        let state = history.node(self.node, k);
        let values: Vec<f64> = samples.columns.iter().map(|column| column[k]).collect();
        let inertial = history.system.inertial_state(state);
        let mut rows = self.quantity.variation(component, &inertial, &values);
        history.system.vary_in_frame(state, &mut rows);
        out.add(self.node, k, &rows.map(|row| row * weight));
        Ok(())
    }
}

/// Checks that a quaternion comes back to itself at the end of the period.
///
/// # Errors
/// If it changes sign.
pub(crate) fn require_closed(node: usize, samples: &Samples) -> Result<()> {
    let columns = samples.columns.iter();
    let closing: f64 = columns
        .map(|x| x.first().zip(x.last()).map_or(0.0, |(a, b)| a * b))
        .sum();
    if closing >= 0.0 {
        return Ok(());
    }
    let message = format!(
        "the quaternion of node {node} changes sign over the period, as its node makes an odd \
         number of turns; ask for the rotation matrix"
    );
    Err(Error::new(ErrorKind::NotAvailable, message))
}
