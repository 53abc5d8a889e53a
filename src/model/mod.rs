//! What the user describes: nodes, bodies, beams, joints, springs, loads and signals.
//!
//! Everything is described in its reference configuration, in the inertial frame. Each call
//! validates its arguments and leaves the model as it was if they are refused.

mod beam;
mod build;
mod force;
mod line;
mod load;
mod loaded;
mod raised;
mod signal;
#[cfg(test)]
pub(crate) mod test_models;

pub use beam::{BeamIds, SectionStation};
pub use build::SectionInput;
pub use force::{ForceDefinition, SpringDefinition};
pub use line::{circular_arc, smooth_curve, straight_line};
pub use load::{DistributedLoadDefinition, LoadPlace};
pub use signal::{BoundSignal, Signal};

use crate::elements::{Beam, Coordinate, Inertia, Joint, LoadFrame};
use crate::motion::Motion;
use serde::{Deserialize, Serialize};

/// A joint coordinate of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct JointCoordinate {
    /// Index of the joint.
    pub joint: usize,
    /// Which of its coordinates.
    pub coordinate: Coordinate,
}

/// Force and moment on a node.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct LoadDefinition {
    /// Node.
    pub node: usize,
    /// How the components are directed.
    pub frame: LoadFrame,
    /// Components `[force; moment]`.
    pub components: [Option<Signal>; 6],
}

/// A mechanism in its reference configuration.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Model {
    pub(crate) nodes: Vec<Motion>,
    pub(crate) beams: Vec<Beam>,
    pub(crate) inertias: Vec<Inertia>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) forces: Vec<ForceDefinition>,
    pub(crate) prescribed: Vec<(JointCoordinate, Signal)>,
    pub(crate) loads: Vec<LoadDefinition>,
    pub(crate) distributed_loads: Vec<DistributedLoadDefinition>,
    pub(crate) gravity: Option<[Signal; 3]>,
}

impl Model {
    /// An empty model.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Number of joints.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// Number of beam elements.
    pub fn beam_element_count(&self) -> usize {
        self.beams.len()
    }

    /// Reference motions of all nodes.
    pub fn reference_motions(&self) -> &[Motion] {
        &self.nodes
    }

    /// Reference motion of a node.
    pub fn node(&self, node: usize) -> Option<&Motion> {
        self.nodes.get(node)
    }
}
