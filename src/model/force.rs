//! Forces that attach to joint coordinates and nodes; each has an id, in the order they are added.

use super::validation::{require_motion, require_positive, require_two_bodies};
use super::{
    BushingDefinition, ControllerDefinition, JointCoordinate, Model, Signal, UserFunction,
};
use crate::elements::{
    Attachment, BushingAngles, ControllerLaw, ControllerState, CoordinateLaw, JointKind,
    MaxwellBranch, NodeForceLaw, ShellLoadPlace, SurfaceForceLaw,
};
use crate::error::{Error, ErrorKind, Result, require_finite, require_id};
use crate::motion::Motion;
use nalgebra::{Matrix3, Matrix6, Vector3};
use serde::{Deserialize, Serialize};

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
    },
    /// A law of the user that reads joint coordinates, has states, and acts on joint coordinates.
    Controller(Box<ControllerDefinition>),
    /// A user's forces on a shell element.
    SurfaceForces {
        /// The element.
        element: usize,
        /// Where on it.
        place: ShellLoadPlace,
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
        if let Some(at) = force.at() {
            self.require_coordinate(&at)?;
        }
        match &force {
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
                self.require_shell_place((*element, 1), *place)?;
            }
        }
        self.forces.push(force);
        Ok(self.forces.len() - 1)
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
        })
    }

    /// Adds forces that a user's function computes at points of the surface, or an edge, of shell
    /// elements: a force for each of `elements` from `first_element` on. Returns the id of the
    /// first; the others follow.
    ///
    /// # Errors
    /// If the elements or the edge do not exist.
    pub fn add_surface_forces(
        &mut self,
        first_element: usize,
        elements: usize,
        place: ShellLoadPlace,
        law: SurfaceForceLaw,
    ) -> Result<usize> {
        self.require_shell_place((first_element, elements), place)?;
        let first = self.forces.len();
        for element in first_element..first_element + elements {
            self.forces.push(ForceDefinition::SurfaceForces {
                element,
                place,
                law: UserFunction::new(law.clone()),
                cycles: 0,
            });
        }
        Ok(first)
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

impl Model {
    /// Adds a controller: efforts on the joint coordinates `outputs`, towards growth, by a law of
    /// time, of the coordinates `inputs` and their rates, and of states that it gives the rates of.
    /// Without states it is a law that reads other coordinates. Returns the force's id.
    ///
    /// # Errors
    /// If a coordinate is none of its joint or in a list twice, if there is no output, or if the
    /// size of a state is not positive.
    pub fn add_controller(
        &mut self,
        inputs: &[JointCoordinate],
        outputs: &[JointCoordinate],
        states: &[ControllerState],
        law: ControllerLaw,
    ) -> Result<usize> {
        self.add_force(ForceDefinition::Controller(Box::new(
            ControllerDefinition {
                inputs: inputs.to_vec(),
                outputs: outputs.to_vec(),
                states: states.to_vec(),
                law: UserFunction::new(law),
                cycles: 0,
            },
        )))
    }

    /// Checks what a controller would be made of.
    ///
    /// # Errors
    /// As [`Model::add_controller`].
    pub(crate) fn require_controller_of(
        &self,
        inputs: &[JointCoordinate],
        outputs: &[JointCoordinate],
        states: &[ControllerState],
    ) -> Result<()> {
        super::controller::require_valid(self, [inputs, outputs], states)
    }

    /// Gives a controller its law, or another: that of a model that was loaded is not in the file.
    ///
    /// # Errors
    /// If the force is no controller.
    pub fn bind_controller(&mut self, force: usize, law: ControllerLaw) -> Result<()> {
        self.require_controller(force)?;
        if let ForceDefinition::Controller(controller) = &mut self.forces[force] {
            controller.law = UserFunction::new(law);
        }
        Ok(())
    }

    /// The controller of this id.
    ///
    /// # Errors
    /// If there is no such force, or it is no controller.
    pub fn require_controller(&self, force: usize) -> Result<&ControllerDefinition> {
        match self.require_force("force", force)? {
            ForceDefinition::Controller(controller) => Ok(controller),
            _ => {
                let message = format!("force: {force} is no controller");
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
