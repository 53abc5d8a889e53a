//! Element kernels: forces, constraints and their exact tangents at one instant.
//!
//! An element knows nothing of the period or of other elements. Adding one takes a file here and
//! an entry in the test that every element passes (`tangent_test`).
//! See docs/theory.md, section 5.1.

mod beam;
mod bushing;
mod contribution;
mod controller;
mod coordinate_force;
mod damper;
mod distributed_load;
mod inertia;
mod joint;
mod line_station;
mod load;
mod mass_damping;
mod raised;
mod relation;
mod relative;
mod renumbered;
mod scalar_function;
mod section;
mod shape;
mod shell;
#[cfg(test)]
mod shell_test;
mod surface_force;
mod surface_force_law;
#[cfg(test)]
mod surface_force_test;
#[cfg(test)]
mod tangent_test;
mod user_force;
mod viscoelastic;

pub use beam::Beam;
pub use bushing::{Bushing, BushingAngles};
pub use contribution::{Contribution, Shape};
pub use controller::{
    Controller, ControllerCall, ControllerFunction, ControllerInput, ControllerLaw,
    ControllerOutput, ControllerState,
};
pub use coordinate_force::{
    ActedCoordinate, CoordinateForce, CoordinateFunction, CoordinateLaw, CoordinateState, Effort,
    Law,
};
pub use damper::ViscousDamper;
pub use distributed_load::{BeamLoadFrame, DistributedLoad};
pub use inertia::{Inertia, rigid_body_inertia};
pub use joint::{Attachment, Joint, Prescribed};
pub use load::{LoadFrame, NodalLoad};
pub use mass_damping::MassDamping;
pub use raised::Raised;
pub use relation::Relation;
pub(crate) use relative::nearest_turn;
pub use relative::{Coordinate, JointKind};
pub use renumbered::Renumbered;
pub use scalar_function::{RelativeMotion, ScalarFunction};
pub use section::{Section, SectionLine};
pub use shape::{gauss_legendre, lobatto_points, shape_functions};
pub use shell::{
    IsotropicShell, Matrix12, NodeGrid, Shell, ShellFrames, ShellLoadPlace, ShellPoint,
    ShellSection, ShellSide, Vector12, element_frames, surface_stress,
};
pub use surface_force::{PointTangents, SurfaceForce};
pub use surface_force_law::{
    ForcePlace, SurfaceForceFunction, SurfaceForceInput, SurfaceForceLaw, SurfaceForceOutput,
};
pub use user_force::{
    NodeForceFunction, NodeForceInput, NodeForceLaw, NodeForceOutput, Tangent, TangentPairs,
    UserForce,
};
pub use viscoelastic::{MaxwellBranch, Viscoelastic};

use crate::error::Result;
pub use crate::motion::NodeState;

use crate::motion::DualMatrix;
use nalgebra::{Matrix6, Vector3, Vector6};
/// What elements of each kind that need it work with.
#[derive(Debug, Clone, Default)]
struct Scratch {
    beam: beam::Scratch,
    shell: shell::Scratch,
    load: distributed_load::Scratch,
    user_force: user_force::Scratch,
    surface_force: surface_force::Scratch,
    controller: controller::Scratch,
}

/// What an element sees of the system at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a> {
    /// Time.
    pub time: f64,
    /// The element's nodes, in its own order.
    pub nodes: &'a [NodeState],
    /// The element's own unknowns: Lagrange multipliers or internal states.
    pub multipliers: &'a [f64],
    /// Rates of internal states; zero for multipliers.
    pub multiplier_rates: &'a [f64],
    /// Stress resultants that the geometric stiffness is to be of, station by station; of the
    /// strains if empty.
    pub resultants: &'a [Vector6<f64>],
    /// Values of all the model's signals at this time.
    pub signals: &'a [f64],
    /// Last known values of the tracked joint coordinates: they tell the turn an angle is in.
    pub coordinates: &'a [f64],
    /// Acceleration of gravity, in the inertial frame.
    pub gravity: Vector3<f64>,
    /// How inertia counts.
    pub inertial: InertialForces,
}

/// Forces that inertia makes: as they are, or others on the way to a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InertialForces {
    /// Factor of the inertial forces.
    pub factor: f64,
    /// Forces against the momenta, per unit of these: added damping, in 1/time.
    pub damping: f64,
}

impl InertialForces {
    /// As they are.
    pub const FULL: Self = InertialForces {
        factor: 1.0,
        damping: 0.0,
    };
}

/// What a quantity measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// A length, conjugate to a force.
    Length,
    /// An angle, conjugate to a moment.
    Angle,
}

/// What an element's own unknown is, and with it its equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Lagrange multiplier: a force that constrains a length, or a moment that constrains an angle.
    Multiplier(Measure),
    /// Internal state with a rate: an elongation or a turn, determined by a balance of the forces
    /// or moments conjugate to it.
    State {
        /// Of the state itself.
        measure: Measure,
        /// Place of the tracked coordinate that an angle gains whole turns with.
        tracked: usize,
    },
    /// Internal state of a law of the user, in units of its size; its equation is that of its rate.
    UserState,
}

impl Unknown {
    /// Whether it is an internal state.
    pub fn is_state(self) -> bool {
        !matches!(self, Unknown::Multiplier(_))
    }
}

/// Stress resultants at a station of an element, integrated with its weight: `f = S e + D ė` of its
/// strains `e`, and likewise of those at other stations of the element.
#[derive(Debug, Clone, PartialEq)]
pub struct StressLaw {
    /// `S`.
    pub stiffness: Matrix6<f64>,
    /// `D`.
    pub damping: Matrix6<f64>,
    /// The other stations, if any matter.
    pub others: Vec<OtherStation>,
}

/// Another station of the same element, whose strains a [`StressLaw`] depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherStation {
    /// So many stations further.
    pub offset: isize,
    /// `S`.
    pub stiffness: Matrix6<f64>,
    /// `D`.
    pub damping: Matrix6<f64>,
}

/// What a node's increment does to the strains of a station: `Δe = B Δu` and `Δė = B ΔV + R Δu`.
/// The resultants' force on the node is `Bᵀ f`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainTangent {
    /// `B`, that acts on twists.
    pub strain: DualMatrix,
    /// `R`, that acts on twists; zero without damping.
    pub rate: DualMatrix,
}

impl Default for StrainTangent {
    fn default() -> Self {
        StrainTangent {
            strain: DualMatrix::zeros(),
            rate: DualMatrix::zeros(),
        }
    }
}

/// What an output of an element varies by.
#[derive(Debug, Clone)]
pub struct OutputVariation {
    /// Of each node, the factors of the increments of its motion and its velocity.
    pub nodes: Vec<[Vector6<f64>; 2]>,
    /// Factors of the increments of own unknowns.
    pub own: Vec<f64>,
}

impl OutputVariation {
    /// Zero, of an element with so many nodes and own unknowns.
    pub fn new(nodes: usize, own_unknowns: usize) -> Self {
        OutputVariation {
            nodes: vec![[Vector6::zeros(); 2]; nodes],
            own: vec![0.0; own_unknowns],
        }
    }
}

/// An element: forces, constraints and exact tangents at one instant.
pub trait Element: Send + Sync + std::fmt::Debug {
    /// Indices of the nodes, in the element's order; the ground is not among them.
    fn nodes(&self) -> &[usize];

    /// Number of own unknowns: Lagrange multipliers or internal states.
    fn own_unknowns(&self) -> usize {
        0
    }

    /// What own unknown `index` is.
    fn unknown(&self, _index: usize) -> Unknown {
        Unknown::Multiplier(Measure::Length)
    }

    /// Whether the own unknowns are internal states.
    fn has_states(&self) -> bool {
        (0..self.own_unknowns()).any(|i| self.unknown(i).is_state())
    }

    /// Whether its own unknowns, which are internal states then, act on its nodes otherwise than by
    /// the transpose of their equations' gradient, and these depend on velocities. Its forces do,
    /// too.
    fn has_feedback(&self) -> bool {
        false
    }

    /// Whether the force on a node depends on the motions of others. If not, it has no own
    /// unknowns.
    fn couples_nodes(&self) -> bool {
        true
    }

    /// The value of an internal state that marches begin with, where it is not to be at rest.
    fn initial_state(&self, _index: usize) -> f64 {
        0.0
    }

    /// Adds the element's forces, constraints and, if wanted, tangents to `out`, which was cleared.
    ///
    /// # Errors
    /// If the element is too distorted for its strains to be defined.
    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()>;

    /// Energy that the element has at these motions, whose derivatives are its forces at rest; none
    /// if it has none that is known. `scratch` is scratch.
    ///
    /// # Errors
    /// As [`Element::evaluate`].
    fn potential(&self, _instant: &Instant, _scratch: &mut Contribution) -> Result<Option<f64>> {
        Ok(None)
    }

    /// Appends what can be read of the element besides its forces, such as its effort.
    ///
    /// # Errors
    /// As [`Element::evaluate`].
    fn outputs(&self, _instant: &Instant, _out: &mut Vec<f64>) -> Result<()> {
        Ok(())
    }

    /// What the joint coordinate measures that it acts on, if it acts on one.
    fn acted_measure(&self) -> Option<Measure> {
        None
    }

    /// The controller that it is, if it is one.
    fn as_controller(&self) -> Option<&Controller> {
        None
    }

    /// Whether its outputs are the six efforts of a bushing.
    fn is_bushing(&self) -> bool {
        false
    }

    /// Adds what output `index` varies by to `out`, which is zero.
    ///
    /// # Errors
    /// As [`Element::evaluate`].
    fn vary_output(
        &self,
        _instant: &Instant,
        _index: usize,
        _out: &mut OutputVariation,
    ) -> Result<()> {
        Ok(())
    }

    /// Laws of the stress resultants that [`Element::evaluate`] keeps apart if asked to.
    fn stress_laws(&self) -> Vec<StressLaw> {
        Vec::new()
    }

    /// Writes the stress resultants at each station that has a [`StressLaw`], for nodes at `nodes`;
    /// `scratch` is scratch.
    ///
    /// # Errors
    /// As [`Element::evaluate`].
    fn stress_resultants(
        &self,
        _nodes: &[NodeState],
        _scratch: &mut Contribution,
        _out: &mut [Vector6<f64>],
    ) -> Result<()> {
        Ok(())
    }

    /// The same for strains and strain rates that change in proportion to increments of the nodes
    /// and of their velocities.
    ///
    /// # Errors
    /// As [`Element::evaluate`].
    fn extrapolate_resultants(
        &self,
        _nodes: &[NodeState],
        _increments: &[[Vector6<f64>; 2]],
        _scratch: &mut Contribution,
        _out: &mut [Vector6<f64>],
    ) -> Result<()> {
        Ok(())
    }

    /// Adds the forces on the nodes, which are at `nodes`, of stress resultants at each station
    /// that has a [`StressLaw`].
    ///
    /// # Errors
    /// As [`Element::evaluate`].
    fn add_forces_of_resultants(
        &self,
        _nodes: &[NodeState],
        _resultants: &[Vector6<f64>],
        _out: &mut Contribution,
    ) -> Result<()> {
        Ok(())
    }

    /// Whether the forces depend on the acceleration.
    fn has_mass(&self) -> bool {
        false
    }

    /// Whether velocities relative to the inertial frame matter; to all others the ground may turn.
    fn knows_inertial_frame(&self) -> bool {
        self.has_mass()
    }

    /// Whether the forces depend on the velocity.
    fn has_damping(&self) -> bool {
        false
    }
}
