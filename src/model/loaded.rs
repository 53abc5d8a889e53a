//! Models that come from a file: nothing in them is trusted.

use super::Model;
use super::build::require_two_bodies;
use super::force::ForceDefinition;
use crate::elements::{Attachment, Element, JointKind};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::motion::{Motion, is_rotation};

/// How far `RᵀR` may be from the identity: all rotations were clean when they were saved.
const ROTATION_TOLERANCE: f64 = 1e-9;

fn require_motion(name: &str, motion: &Motion) -> Result<()> {
    require_finite(name, motion.position.as_slice())?;
    require_finite(name, motion.rotation.as_slice())?;
    if is_rotation(&motion.rotation, ROTATION_TOLERANCE) {
        return Ok(());
    }
    let message = format!("{name}: its matrix is no rotation");
    Err(Error::new(ErrorKind::Value, message))
}

impl Model {
    /// Builds the model anew, with all the checks of building. Unlike the calls of the user, none
    /// of it changes a number.
    pub(crate) fn checked(self) -> Result<Model> {
        let mut model = Model {
            nodes: self.nodes,
            gravity: self.gravity,
            ..Model::new()
        };
        for (id, node) in model.nodes.iter().enumerate() {
            require_motion(&format!("node {id}"), node)?;
        }
        for beam in self.beams {
            model.require_distinct_nodes(beam.nodes())?;
            model.beams.push(beam);
        }
        for inertia in self.inertias {
            model.require_distinct_nodes(inertia.nodes())?;
            model.inertias.push(inertia);
        }
        for joint in self.joints {
            let (first, second) = joint.attachments();
            model.require_attachments(&first, &second)?;
            if let JointKind::Screw { pitch } = joint.kind()
                && (!pitch.is_finite() || pitch == 0.0)
            {
                return Err(Error::value("pitch", "a number other than zero", pitch));
            }
            model.joints.push(joint);
        }
        for force in self.forces {
            model.add_checked_force(force)?;
        }
        for (at, signal) in self.prescribed {
            model.prescribe(at, &signal)?;
        }
        for load in self.loads {
            model.add_load(load.node, load.frame, load.components)?;
        }
        for load in self.distributed_loads {
            model.add_distributed_load(load)?;
        }
        Ok(model)
    }

    fn require_attachments(&self, first: &Attachment, second: &Attachment) -> Result<()> {
        require_two_bodies(first.node, second.node)?;
        for attachment in [first, second] {
            if let Some(node) = attachment.node {
                self.require_node("joint", node)?;
            }
            require_motion("frame", &attachment.offset)?;
        }
        Ok(())
    }

    fn add_checked_force(&mut self, force: ForceDefinition) -> Result<usize> {
        match force {
            ForceDefinition::SpringDamper {
                at,
                stiffness,
                damping,
                rest,
            } => self.add_polynomial_spring_damper(at, &stiffness, &damping, rest),
            ForceDefinition::Actuator { at, signal } => self.add_actuator(at, &signal),
            ForceDefinition::CoordinateLaw { at, law } => self.add_coordinate_law(at, law),
            ForceDefinition::Viscoelastic {
                at,
                stiffness,
                rest,
                branches,
            } => self.add_viscoelastic(at, stiffness, rest, &branches),
            ForceDefinition::NodeForces { nodes, law } => self.add_node_forces(&nodes, law),
            ForceDefinition::ViscousDamper {
                first,
                second,
                matrix,
            } => {
                self.require_attachments(&first, &second)?;
                require_finite("matrix", matrix.as_slice())?;
                Ok(self.add_force(ForceDefinition::ViscousDamper {
                    first,
                    second,
                    matrix,
                }))
            }
        }
    }
}
