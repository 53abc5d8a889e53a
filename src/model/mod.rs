//! What the user describes: nodes, bodies, beams, joints, springs, loads and signals.
//!
//! Everything is described in its reference configuration, in the inertial frame. Each call
//! validates its arguments and leaves the model as it was if they are refused.

mod beam;
mod beam_spin;
mod bound;
mod bushing;
mod change;
mod contents;
mod controller;
mod force;
mod force_definition;
mod inertia;
mod joint;
mod label;
mod line;
mod load;
mod loaded;
mod object;
mod parameter;
mod raised;
mod relation;
mod rigid_edge;
mod rotor_symmetry;
mod section;
mod shell;
mod shell_load;
mod shell_mesh;
mod shell_quadrilaterals;
mod signal;
mod spin;
mod stations;
mod surface;
mod surface_force;
mod target;
mod turning_frame;
mod user_function;
mod validation;

pub use beam::{BeamDefinition, BeamIds};
pub use bushing::BushingDefinition;
pub use contents::ForceNumber;
pub use force::SpringDefinition;
pub use force_definition::{ControllerDefinition, ForceDefinition};
pub use inertia::InertiaDefinition;
pub use joint::{JointCoordinate, JointDefinition};
pub use label::{LONGEST_LABEL, Labels};
pub use line::{circular_arc, smooth_curve, straight_line};
pub use load::{DistributedLoadDefinition, LoadDefinition, LoadPlace, LoadPoint};
pub use object::ObjectKind;
pub use parameter::Parameter;
pub use relation::RelationDefinition;
pub use rotor_symmetry::RotorSymmetry;
pub use section::SectionInput;
pub use shell::{ShellDefinition, ShellPlacement};
pub use shell_load::ShellLoadDefinition;
pub use shell_mesh::{PatchEdge, ShellMesh, ShellPatch};
pub use shell_quadrilaterals::QuadrilateralMesh;
pub use signal::{BoundSignal, Signal};
pub use spin::Spin;
pub use stations::SectionStation;
pub use surface::{annulus_sector, cylinder, rectangle};
pub use target::{SignalPart, SignalPlace, Target};
pub use turning_frame::TurningFrame;
pub use user_function::UserFunction;
pub(crate) use user_function::absent;
pub(crate) use validation::direction;

use crate::error::{Result, require_finite};
use crate::motion::Motion;
use serde::{Deserialize, Serialize};
use validation::require_rotation;

/// A mechanism in its reference configuration.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Model {
    pub(crate) nodes: Vec<Motion>,
    pub(crate) beams: Vec<BeamDefinition>,
    #[serde(default)]
    pub(crate) shells: Vec<ShellDefinition>,
    /// In the order in which they were described.
    #[serde(deserialize_with = "inertia::saved")]
    pub(crate) inertias: Vec<InertiaDefinition>,
    pub(crate) joints: Vec<JointDefinition>,
    pub(crate) forces: Vec<ForceDefinition>,
    pub(crate) prescribed: Vec<(JointCoordinate, Signal)>,
    #[serde(default)]
    pub(crate) relations: Vec<RelationDefinition>,
    pub(crate) loads: Vec<LoadDefinition>,
    pub(crate) distributed_loads: Vec<DistributedLoadDefinition>,
    #[serde(default)]
    pub(crate) shell_loads: Vec<ShellLoadDefinition>,
    pub(crate) gravity: Option<[Signal; 3]>,
    #[serde(default)]
    pub(crate) turning_frame: Option<TurningFrame>,
    #[serde(default)]
    pub(crate) rotor_symmetry: Option<RotorSymmetry>,
    /// Force against motion for a unit of momentum.
    #[serde(default)]
    pub(crate) mass_damping: f64,
    #[serde(default)]
    pub(crate) parameters: Vec<Parameter>,
    #[serde(default)]
    pub(crate) labels: Labels,
}

impl Model {
    /// An empty model.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a node at a reference motion; returns its id.
    pub fn add_node(&mut self, reference: &Motion) -> Result<usize> {
        require_finite("position", reference.position.as_slice())?;
        let rotation = require_rotation("rotation", &reference.rotation)?;
        self.nodes.push(Motion::new(rotation, reference.position));
        Ok(self.nodes.len() - 1)
    }

    /// Sets the acceleration of gravity, in the inertial frame.
    pub fn set_gravity(&mut self, acceleration: [Signal; 3]) {
        self.gravity = Some(acceleration);
    }

    /// Gives everything with mass a force `factor · M V` against its motion, relative to the
    /// inertial frame: a damping in proportion to mass, or an excitation where it is negative.
    pub fn set_mass_damping(&mut self, factor: f64) -> Result<()> {
        require_finite("factor", &[factor])?;
        self.mass_damping = factor;
        Ok(())
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
