//! What a model keeps of each of its forces.

use super::{BushingDefinition, JointCoordinate, Signal, UserFunction};
use crate::elements::{
    Attachment, ControllerLaw, ControllerState, CoordinateLaw, ForcePlace, MaxwellBranch,
    NodeForceLaw, SurfaceForceLaw,
};
use nalgebra::Matrix6;
use serde::{Deserialize, Serialize};

/// A force of the model.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum ForceDefinition {
    /// Effort `Σ stiffness[i−1] (q − rest)ⁱ + Σ damping[i−1] q̇ⁱ` on a joint coordinate, against
    /// growth.
    SpringDamper {
        /// Where it acts.
        at: JointCoordinate,
        /// Coefficients of the powers of `q − rest`, from the first.
        stiffness: Vec<f64>,
        /// Coefficients of the powers of `q̇`, from the first.
        damping: Vec<f64>,
        /// Coordinate at which the springs are free of effort.
        rest: f64,
    },
    /// Effort on a joint coordinate that follows a signal, towards growth.
    Actuator {
        /// Where it acts.
        at: JointCoordinate,
        /// The effort.
        signal: Signal,
    },
    /// Effort of a user's law on a joint coordinate, against growth.
    CoordinateLaw {
        /// Where it acts.
        at: JointCoordinate,
        /// The law.
        law: UserFunction<CoordinateLaw>,
        /// Cycles of the phase that it is told in a period; 0 if it is told the time.
        #[serde(default)]
        cycles: usize,
    },
    /// Generalised Maxwell model on a joint coordinate, see [`crate::elements::Viscoelastic`].
    Viscoelastic {
        /// Where it acts.
        at: JointCoordinate,
        /// Long-term stiffness `K∞`.
        stiffness: f64,
        /// Coordinate at which the long-term spring is free of effort.
        rest: f64,
        /// The branches.
        branches: Vec<MaxwellBranch>,
    },
    /// Wrench `−C ż` between two bodies.
    ViscousDamper {
        /// First body; where its frame is does not matter.
        first: Attachment,
        /// Second body, and the frame that twist, wrench and matrix are about and resolved in.
        second: Attachment,
        /// The coefficients.
        matrix: Box<Matrix6<f64>>,
    },
    /// Efforts of full matrices between two frames.
    Bushing(Box<BushingDefinition>),
    /// A user's forces on nodes.
    NodeForces {
        /// The nodes.
        nodes: Vec<usize>,
        /// The law.
        law: UserFunction<NodeForceLaw>,
        /// Cycles of the phase that it is told in a period; 0 if it is told the time.
        #[serde(default)]
        cycles: usize,
        /// Whether the force on each node depends on its own motion alone.
        #[serde(default)]
        apart: bool,
    },
    /// A law of the user that reads joint coordinates, has states, and acts on joint coordinates.
    Controller(Box<ControllerDefinition>),
    /// A user's forces on a shell or beam element.
    SurfaceForces {
        /// The element, of beams if it acts on the line of one.
        element: usize,
        /// Where on it.
        place: ForcePlace,
        /// The law.
        law: UserFunction<SurfaceForceLaw>,
        /// Cycles of the phase that it is told in a period; 0 if it is told the time.
        #[serde(default)]
        cycles: usize,
    },
}

impl ForceDefinition {
    /// The joint coordinate it acts on, if it does on one.
    pub fn at(&self) -> Option<JointCoordinate> {
        match self {
            ForceDefinition::SpringDamper { at, .. }
            | ForceDefinition::Actuator { at, .. }
            | ForceDefinition::CoordinateLaw { at, .. }
            | ForceDefinition::Viscoelastic { at, .. } => Some(*at),
            ForceDefinition::ViscousDamper { .. }
            | ForceDefinition::Bushing(_)
            | ForceDefinition::NodeForces { .. }
            | ForceDefinition::SurfaceForces { .. }
            | ForceDefinition::Controller(_) => None,
        }
    }

    /// All joint coordinates that it depends on or acts on.
    pub fn coordinates(&self) -> Vec<JointCoordinate> {
        match self {
            ForceDefinition::Controller(controller) => {
                [&controller.inputs[..], &controller.outputs].concat()
            }
            _ => self.at().into_iter().collect(),
        }
    }

    /// Number of its internal states.
    pub fn states(&self) -> usize {
        match self {
            ForceDefinition::Viscoelastic { branches, .. } => branches.len(),
            ForceDefinition::Controller(controller) => controller.states.len(),
            _ => 0,
        }
    }

    /// Whether it is a function of the user.
    pub fn calls_function(&self) -> bool {
        self.cycles().is_some()
    }

    /// Cycles of the phase that its function is told in a period; none if it has no function.
    pub fn cycles(&self) -> Option<usize> {
        match self {
            ForceDefinition::CoordinateLaw { cycles, .. }
            | ForceDefinition::NodeForces { cycles, .. }
            | ForceDefinition::SurfaceForces { cycles, .. } => Some(*cycles),
            ForceDefinition::Controller(controller) => Some(controller.cycles),
            _ => None,
        }
    }

    pub(super) fn cycles_mut(&mut self) -> Option<&mut usize> {
        match self {
            ForceDefinition::CoordinateLaw { cycles, .. }
            | ForceDefinition::NodeForces { cycles, .. }
            | ForceDefinition::SurfaceForces { cycles, .. } => Some(cycles),
            ForceDefinition::Controller(controller) => Some(&mut controller.cycles),
            _ => None,
        }
    }
}

/// Efforts on joint coordinates, towards growth, by a law of joint coordinates, their rates, and
/// states of its own.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ControllerDefinition {
    /// The coordinates that it reads.
    pub inputs: Vec<JointCoordinate>,
    /// Those that it acts on.
    pub outputs: Vec<JointCoordinate>,
    /// Its states.
    pub states: Vec<ControllerState>,
    /// The law.
    pub law: UserFunction<ControllerLaw>,
    /// Cycles of the phase that it is told in a period; 0 if it is told the time.
    pub cycles: usize,
}
