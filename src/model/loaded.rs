//! Models that come from a file: nothing in them is trusted.

use super::{ForceDefinition, InertiaDefinition, LoadDefinition, Model};
use crate::elements::Attachment;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::motion::{Motion, is_rotation};

/// How far `RᵀR` may be from the identity: all rotations were clean when they were saved.
const ROTATION_TOLERANCE: f64 = 1e-9;

pub(super) fn require_clean_motion(name: &str, motion: &Motion) -> Result<()> {
    require_finite(name, motion.position.as_slice())?;
    require_finite(name, motion.rotation.as_slice())?;
    if is_rotation(&motion.rotation, ROTATION_TOLERANCE) {
        return Ok(());
    }
    let message = format!("{name}: its matrix is no rotation");
    Err(Error::new(ErrorKind::Value, message))
}

impl Model {
    /// Whether it holds what readers of files of version 2 may not know.
    pub(crate) fn has_newer_parts(&self) -> bool {
        let is_newer = |force: &ForceDefinition| {
            matches!(
                force,
                ForceDefinition::Bushing(_)
                    | ForceDefinition::Controller(_)
                    | ForceDefinition::SurfaceForces { .. }
                    | ForceDefinition::NodeForces { apart: true, .. }
            )
        };
        !self.relations.is_empty()
            || !self.shells.is_empty()
            || !self.shell_loads.is_empty()
            || self.turning_frame.is_some()
            || self.rotor_symmetry.is_some()
            || self.inertias.iter().any(InertiaDefinition::spins)
            || self.beams.iter().any(|beam| beam.spin != 0.0)
            || self.loads.iter().any(LoadDefinition::is_newer)
            || self.forces.iter().any(is_newer)
    }

    /// Builds the model anew, with all the checks of building. Unlike the calls of the user, none
    /// of it changes a number.
    pub(crate) fn checked(self) -> Result<Model> {
        let mut model = Model {
            nodes: self.nodes,
            gravity: self.gravity,
            mass_damping: self.mass_damping,
            ..Model::new()
        };
        if let Some(frame) = self.turning_frame {
            model.set_turning_frame(&frame.axis(), frame.rate(), &frame.point())?;
            model.set_frame_advance(frame.advance())?;
        }
        if let Some(rotor) = self.rotor_symmetry {
            let (axis, point) = (rotor.axis(), rotor.point());
            model.set_rotor_symmetry(&axis, &point, rotor.hub(), rotor.blades())?;
        }
        for (id, node) in model.nodes.iter().enumerate() {
            require_clean_motion(&format!("node {id}"), node)?;
        }
        for beam in self.beams {
            Self::require_element_size("nodes", beam.nodes.len())?;
            model.require_distinct_nodes(&beam.nodes)?;
            beam.sections.validate()?;
            require_finite("factors", &beam.factors)?;
            model.element_of(&beam)?;
            model.beams.push(beam);
            model.require_beam_can_spin(model.beams.len() - 1)?;
        }
        for shell in self.shells {
            model.take_shell(shell)?;
        }
        for inertia in self.inertias {
            if let InertiaDefinition::Body { node, .. } = &inertia {
                model.require_node("inertia", *node)?;
            }
            inertia.require_clean()?;
            model.inertias.push(inertia);
        }
        for joint in self.joints {
            model.require_attachments([&joint.first, &joint.second])?;
            model.place_joint(joint)?;
        }
        for force in self.forces {
            match &force {
                ForceDefinition::ViscousDamper { first, second, .. } => {
                    model.require_attachments([first, second])?;
                }
                ForceDefinition::Bushing(bushing) => {
                    model.require_attachments([&bushing.first, &bushing.second])?;
                }
                _ => {}
            }
            model.add_force(force)?;
        }
        for (at, signal) in self.prescribed {
            model.prescribe(at, &signal)?;
        }
        for relation in self.relations {
            model.take_relation(relation)?;
        }
        for load in self.loads {
            model.add_point_load(load)?;
        }
        for load in self.distributed_loads {
            model.add_distributed_load(load)?;
        }
        for load in self.shell_loads {
            model.add_shell_load(load)?;
        }
        require_finite("mass_damping", &[model.mass_damping])?;
        for parameter in self.parameters {
            model.take_parameter(parameter)?;
        }
        model.take_labels(self.labels)?;
        Ok(model)
    }

    fn require_attachments(&self, attachments: [&Attachment; 2]) -> Result<()> {
        for attachment in attachments {
            if let Some(node) = attachment.node {
                self.require_node("joint", node)?;
            }
            require_clean_motion("frame", &attachment.offset)?;
        }
        Ok(())
    }
}
