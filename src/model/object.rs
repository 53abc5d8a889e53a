//! What a model has several of: kinds, what messages call them, and how many there are.

use super::Model;
use crate::error::{Result, require_id};
use serde::{Deserialize, Serialize};
use std::fmt;

/// What a model has several of, numbered from 0 in the order in which they were added.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum ObjectKind {
    /// A node, or a rigid body, which is one.
    Node,
    /// A joint.
    Joint,
    /// A beam element.
    BeamElement,
    /// A shell element.
    ShellElement,
    /// A force: spring, damper, actuator, bushing, user's force.
    Force,
    /// A relation between joint coordinates.
    Relation,
    /// A parameter.
    Parameter,
    /// A load at a point: on a node or a beam.
    Load,
    /// A load along beam elements.
    BeamLoad,
    /// A load on shell elements.
    ShellLoad,
    /// The inertia of a rigid body, or a mass or inertia on a node.
    Inertia,
    /// A prescribed coordinate.
    Prescribed,
}

impl ObjectKind {
    /// All kinds.
    pub const ALL: [ObjectKind; 12] = [
        ObjectKind::Node,
        ObjectKind::Joint,
        ObjectKind::BeamElement,
        ObjectKind::ShellElement,
        ObjectKind::Force,
        ObjectKind::Relation,
        ObjectKind::Parameter,
        ObjectKind::Load,
        ObjectKind::BeamLoad,
        ObjectKind::ShellLoad,
        ObjectKind::Inertia,
        ObjectKind::Prescribed,
    ];

    /// What messages call it.
    pub fn noun(self) -> &'static str {
        match self {
            ObjectKind::Node => "node",
            ObjectKind::Joint => "joint",
            ObjectKind::BeamElement => "beam element",
            ObjectKind::ShellElement => "shell element",
            ObjectKind::Force => "force",
            ObjectKind::Relation => "relation",
            ObjectKind::Parameter => "parameter",
            ObjectKind::Load => "load",
            ObjectKind::BeamLoad => "beam load",
            ObjectKind::ShellLoad => "shell load",
            ObjectKind::Inertia => "inertia",
            ObjectKind::Prescribed => "prescribed coordinate",
        }
    }
}

impl fmt::Display for ObjectKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.noun())
    }
}

impl Model {
    /// Number of things of a kind.
    pub fn object_count(&self, kind: ObjectKind) -> usize {
        match kind {
            ObjectKind::Node => self.nodes.len(),
            ObjectKind::Joint => self.joints.len(),
            ObjectKind::BeamElement => self.beams.len(),
            ObjectKind::ShellElement => self.shells.len(),
            ObjectKind::Force => self.forces.len(),
            ObjectKind::Relation => self.relations.len(),
            ObjectKind::Parameter => self.parameters.len(),
            ObjectKind::Load => self.loads.len(),
            ObjectKind::BeamLoad => self.distributed_loads.len(),
            ObjectKind::ShellLoad => self.shell_loads.len(),
            ObjectKind::Inertia => self.inertia_count(),
            ObjectKind::Prescribed => self.prescribed.len(),
        }
    }

    pub(crate) fn require_object(&self, kind: ObjectKind, id: usize) -> Result<()> {
        require_id("id", kind.noun(), self.object_count(kind), id)
    }
}
