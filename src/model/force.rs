//! Forces that attach to joint coordinates and nodes; each has an id, in the order they are added.

use super::validation::{require_motion, require_positive, require_two_bodies};
use super::{BushingDefinition, ForceDefinition, JointCoordinate, Model, Signal, UserFunction};
use crate::elements::{
    Attachment, BushingAngles, CoordinateLaw, JointKind, MaxwellBranch, NodeForceLaw,
};
use crate::error::{Error, ErrorKind, Result, require_finite, require_id};
use crate::motion::Motion;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// Linear spring-damper on a joint coordinate: effort `stiffness (q − rest) + damping q̇` against
/// growth.
#[derive(Debug, Clone, Copy)]
pub struct SpringDefinition {
    /// Where it acts.
    pub at: JointCoordinate,
    /// Effort for a unit of the coordinate.
    pub stiffness: f64,
    /// Effort for a unit rate of the coordinate.
    pub damping: f64,
    /// Coordinate at which the spring is free of effort.
    pub rest: f64,
}

impl Model {
    /// Number of forces: springs, dampers, actuators and user's forces, but not loads.
    pub fn force_count(&self) -> usize {
        self.forces.len()
    }

    pub(crate) fn require_force(&self, name: &str, force: usize) -> Result<&ForceDefinition> {
        require_id(name, "force", self.forces.len(), force)?;
        Ok(&self.forces[force])
    }

    /// Adds a force, if it is valid; returns its id.
    pub(super) fn add_force(&mut self, force: ForceDefinition) -> Result<usize> {
        self.require_force_definition(&force)?;
        self.forces.push(force);
        Ok(self.forces.len() - 1)
    }

    pub(super) fn require_force_definition(&self, force: &ForceDefinition) -> Result<()> {
        if let Some(at) = force.at() {
            self.require_coordinate(&at)?;
        }
        match force {
            ForceDefinition::SpringDamper {
                stiffness,
                damping,
                rest,
                ..
            } => {
                require_finite("stiffness", stiffness)?;
                require_finite("damping", damping)?;
                require_finite("rest", &[*rest])?;
            }
            ForceDefinition::Actuator { .. } | ForceDefinition::CoordinateLaw { .. } => {}
            ForceDefinition::Viscoelastic {
                stiffness,
                rest,
                branches,
                ..
            } => {
                require_finite("stiffness", &[*stiffness])?;
                require_finite("rest", &[*rest])?;
                branches.iter().enumerate().try_for_each(require_branch)?;
            }
            ForceDefinition::ViscousDamper {
                first,
                second,
                matrix,
            } => {
                require_two_bodies(first.node, second.node)?;
                require_finite("matrix", matrix.as_slice())?;
            }
            ForceDefinition::Bushing(bushing) => bushing.require_valid()?,
            ForceDefinition::NodeForces { nodes, .. } => self.require_distinct_nodes(nodes)?,
            ForceDefinition::Controller(controller) => controller.require_valid(self)?,
            ForceDefinition::SurfaceForces { element, place, .. } => {
                self.require_force_place((*element, 1), *place)?;
            }
        }
        Ok(())
    }

    /// Adds a strut: the line between a point of each of two bodies (`None` is the ground), given
    /// in the reference configuration. It is a joint that constrains nothing, with the distance of
    /// the points as its coordinate [`Coordinate::Displacement1`](crate::elements::Coordinate);
    /// springs, dampers and actuators act along it. Returns the joint's id.
    pub fn add_strut(
        &mut self,
        first: Option<usize>,
        second: Option<usize>,
        first_point: &Vector3<f64>,
        second_point: &Vector3<f64>,
    ) -> Result<usize> {
        require_finite("first_point", first_point.as_slice())?;
        require_finite("second_point", second_point.as_slice())?;
        let size = first_point.amax().max(second_point.amax());
        if (second_point - first_point).amax() <= 1e-12 * size {
            let expected = "a point away from first_point";
            return Err(Error::value("second_point", expected, "the same point"));
        }
        let frame = |point: &Vector3<f64>| Motion::new(Matrix3::identity(), *point);
        let frames = (frame(first_point), frame(second_point));
        self.add_joint(JointKind::Strut, first, second, &frames.0, &frames.1)
    }

    /// Adds a linear spring-damper on a joint coordinate; returns the force's id.
    pub fn add_spring_damper(&mut self, spring: SpringDefinition) -> Result<usize> {
        require_finite("stiffness", &[spring.stiffness])?;
        require_finite("damping", &[spring.damping])?;
        let (stiffness, damping) = ([spring.stiffness], [spring.damping]);
        self.add_polynomial_spring_damper(spring.at, &stiffness, &damping, spring.rest)
    }

    /// Adds a nonlinear spring-damper on a joint coordinate `q`: effort
    /// `Σ stiffness[i−1] (q − rest)ⁱ + Σ damping[i−1] q̇ⁱ` against growth. Returns the force's id.
    pub fn add_polynomial_spring_damper(
        &mut self,
        at: JointCoordinate,
        stiffness: &[f64],
        damping: &[f64],
        rest: f64,
    ) -> Result<usize> {
        self.add_force(ForceDefinition::SpringDamper {
            at,
            stiffness: stiffness.to_vec(),
            damping: damping.to_vec(),
            rest,
        })
    }

    /// Adds a force or torque on a joint coordinate that follows a signal and is positive towards
    /// growth; returns the force's id.
    pub fn add_actuator(&mut self, at: JointCoordinate, signal: &Signal) -> Result<usize> {
        let signal = signal.clone();
        self.add_force(ForceDefinition::Actuator { at, signal })
    }

    /// Adds a user's law for the effort on a joint coordinate, against growth; returns the force's
    /// id.
    pub fn add_coordinate_law(&mut self, at: JointCoordinate, law: CoordinateLaw) -> Result<usize> {
        let law = UserFunction::new(law);
        self.add_force(ForceDefinition::CoordinateLaw { at, law, cycles: 0 })
    }

    /// Adds a generalised Maxwell model on a joint coordinate `q`, against growth: effort
    /// `K∞ (q − rest) + Σ K_b α_b`, `τ_b α̇_b + α_b = τ_b q̇`. Stiffnesses of the branches and
    /// relaxation times are positive. One branch makes it a Zener element. Returns the force's id.
    pub fn add_viscoelastic(
        &mut self,
        at: JointCoordinate,
        stiffness: f64,
        rest: f64,
        branches: &[MaxwellBranch],
    ) -> Result<usize> {
        self.add_force(ForceDefinition::Viscoelastic {
            at,
            stiffness,
            rest,
            branches: branches.to_vec(),
        })
    }

    /// Adds a viscous damper between two bodies (`None` is the ground): the wrench on the second is
    /// `−C ż`, with the twist `ż` of the second relative to the first. Both are about and resolved
    /// in a frame that is fixed to the second body and given where it is in the reference
    /// configuration (`None`: the second node's own, or the inertial frame). `matrix` is symmetric
    /// and positive semi-definite. Returns the force's id.
    pub fn add_viscous_damper(
        &mut self,
        first: Option<usize>,
        second: Option<usize>,
        frame: Option<&Motion>,
        matrix: &Matrix6<f64>,
    ) -> Result<usize> {
        if let Some(node) = second {
            self.require_node("second", node)?;
        }
        require_two_bodies(first, second)?;
        let place = |node: Option<usize>| node.map_or(Motion::identity(), |n| self.nodes[n]);
        let frame = match frame {
            None => place(second),
            Some(frame) => require_motion("frame", frame)?,
        };
        let first = self.attachment("first", first, frame)?;
        let second = self.attachment("second", second, frame)?;
        let matrix = require_positive("matrix", matrix, false)?;
        self.add_force(ForceDefinition::ViscousDamper {
            first,
            second,
            matrix: Box::new(matrix),
        })
    }

    /// Adds a bushing between frames on two bodies (`None` is the ground), which are given where
    /// they are in the reference configuration. With the deformation `e`, `[displacement; angles]`
    /// of the second frame relative to the first along the axes of the first, the efforts against
    /// it are `K e + C ė`: any matrices, unsymmetric ones included. Returns the force's id.
    ///
    /// # Errors
    /// If a body or frame is none, the bodies are the same, or a number is not finite; with
    /// [`BushingAngles::TiltAndSpin`] if the last column of the stiffness is not zero.
    pub fn add_bushing(
        &mut self,
        [first, second]: [Option<usize>; 2],
        [first_frame, second_frame]: [&Motion; 2],
        [stiffness, damping]: [&Matrix6<f64>; 2],
        angles: BushingAngles,
    ) -> Result<usize> {
        let attach = |name: &str, node: Option<usize>, frame: &Motion| -> Result<Attachment> {
            let frame = require_motion(&format!("{name}_frame"), frame)?;
            self.attachment(name, node, frame)
        };
        let bushing = BushingDefinition {
            first: attach("first", first, first_frame)?,
            second: attach("second", second, second_frame)?,
            stiffness: *stiffness,
            damping: *damping,
            angles,
            factors: [1.0; 2],
        };
        self.add_force(ForceDefinition::Bushing(Box::new(bushing)))
    }

    /// Adds forces on nodes that a user's function computes; returns the force's id.
    pub fn add_node_forces(&mut self, nodes: &[usize], law: NodeForceLaw) -> Result<usize> {
        let (nodes, law) = (nodes.to_vec(), UserFunction::new(law));
        self.add_force(ForceDefinition::NodeForces {
            nodes,
            law,
            cycles: 0,
            apart: false,
        })
    }

    /// Declares that the force on each node of a user's function depends on time and on the motion
    /// of this node alone: then the force couples no nodes, and its tangents are those of each.
    ///
    /// # Errors
    /// If there is no such force, or it is none of a function on nodes.
    pub fn declare_nodes_apart(&mut self, force: usize) -> Result<()> {
        self.require_force("force", force)?;
        match &mut self.forces[force] {
            ForceDefinition::NodeForces { apart, .. } => {
                *apart = true;
                Ok(())
            }
            _ => {
                let message = format!("force: {force} is no function's force on nodes");
                Err(Error::new(ErrorKind::NotAvailable, message))
            }
        }
    }

    /// Declares the function of a force one of the phase `Ωt`, which it is then told, in radians,
    /// in place of the time; so it is one for any period, as that of a force that does not depend
    /// on time is, too.
    pub fn declare_of_phase(&mut self, force: usize) -> Result<()> {
        self.require_force("force", force)?;
        match self.forces[force].cycles_mut() {
            Some(cycles) => {
                *cycles = 1;
                Ok(())
            }
            None => {
                let message = format!("force: {force} has no function");
                Err(Error::new(ErrorKind::NotAvailable, message))
            }
        }
    }
}

fn require_branch((b, branch): (usize, &MaxwellBranch)) -> Result<()> {
    for (name, value) in [
        ("branch_stiffness", branch.stiffness),
        ("relaxation_times", branch.relaxation_time),
    ] {
        let name = format!("{name}[{b}]");
        require_finite(&name, &[value])?;
        if value <= 0.0 {
            return Err(Error::value(&name, "a positive number", value));
        }
    }
    Ok(())
}
