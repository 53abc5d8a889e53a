//! One instant of the whole mechanism: its elements, unknowns, signals and characteristic scales.

mod build;
mod check;
mod constraints;
mod driven;
mod evaluation;
mod extents;
mod layout;
mod mass_properties;
mod part;
mod partition;
mod regime;
mod relations;
mod repetition;
mod rotor_symmetry;
mod scales;
mod shell_overlaps;
mod shell_seams;
mod shell_warnings;
mod signals;
mod summary;
mod tracking;
mod turning;
mod user_laws;
mod warnings;

pub use check::{TangentCheck, check_tangents};
pub use constraints::{ConstraintLoop, ConstraintNames, Dependency, name_all};
pub use driven::Driven;
pub use evaluation::{Conditions, Exerted, OwnValues, Workspace};
pub use layout::Layout;
pub use mass_properties::MassProperties;
pub use regime::{Regime, Standstill, Transient};
pub use relations::PlacedRelation;
pub use repetition::{require_periodic_forces, require_reproducible_forces};
pub use rotor_symmetry::Symmetry;
pub(crate) use rotor_symmetry::{describe as describe_role, refused as not_alike};
pub use scales::Scales;
pub use summary::Summary;

use crate::elements::{Beam, Element, Inertia, Joint, Shape, Shell, Unknown};
use crate::model::JointCoordinate;
use crate::motion::Motion;
use crate::workers::Workers;
use driven::Drive;
use signals::DrivenSignal;
use std::ops::Range;
use std::sync::Arc;

/// What an element stands for, to name it in messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementRole {
    /// Inertia of a body, or of a beam or shell element.
    Inertia,
    /// Beam element of this index.
    Beam(usize),
    /// Shell element of this index.
    Shell(usize),
    /// Joint of this index.
    Joint(usize),
    /// Prescribed coordinate of this index.
    Prescribed(usize),
    /// Force of this index.
    Force(usize),
    /// Relation between joint coordinates of this index.
    Relation(usize),
    /// Load.
    Load,
    /// Damping in proportion to mass.
    MassDamping,
}

/// An element with the place of its own unknowns.
#[derive(Debug, Clone)]
pub struct Placed {
    /// The element.
    pub element: Arc<dyn Element>,
    /// What it stands for.
    pub role: ElementRole,
    /// Index of its first own unknown among those of all elements at an instant.
    pub first_own: usize,
    /// Whether its own unknowns are internal states.
    pub has_states: bool,
    /// Whether these act otherwise than by the transposed gradient, see
    /// [`Element::has_feedback`].
    pub has_feedback: bool,
    /// Its stations with stress resultants, among those of all elements.
    pub stations: Range<usize>,
    /// Its scratch among those of a [`Workspace`].
    shape: usize,
}

/// A model made ready for a period, for one time or for a march.
#[derive(Debug, Clone)]
pub struct System {
    regime: Regime,
    /// Reference motions of the nodes.
    reference: Vec<Motion>,
    elements: Vec<Placed>,
    /// Of each kind of scratch.
    shapes: Vec<Shape>,
    /// What each own unknown of the elements is.
    own_unknowns: Vec<Unknown>,
    signals: Vec<DrivenSignal>,
    gravity: Option<[usize; 3]>,
    inertias: Vec<Arc<Inertia>>,
    beams: Vec<Arc<Beam>>,
    shells: Vec<Arc<Shell>>,
    joints: Vec<Joint>,
    /// Signals that prescribe angles whose whole turns matter, as they turn a screw or gears.
    counted_turns: Vec<usize>,
    /// The frame that motions are described in, if it turns.
    turning: Option<turning::Turning>,
    /// Which nodes and elements follow which, of like blades, where motions are periodic.
    symmetry: Option<Arc<Symmetry>>,
    /// Prescribed coordinates, in the order of their signals, which are the first.
    prescribed: Vec<JointCoordinate>,
    /// Relations between joint coordinates.
    relations: Vec<PlacedRelation>,
    /// Prescribed angles whose whole turns are open.
    drives: Vec<Drive>,
    /// Coordinates that forces act on, force by force, those of relations, then all other angles
    /// whose whole turns are open.
    tracked: Vec<JointCoordinate>,
    /// How many of them forces and relations act on.
    acted_on: usize,
    /// Loops of constraints, where some may depend on others.
    loops: Vec<ConstraintLoop>,
    dependencies: Vec<Dependency>,
    /// Whether forces come from functions of the user.
    calls_functions: bool,
    /// Whether functions of the user are absent, so that nothing can be evaluated.
    lacks_functions: bool,
    scales: Scales,
    /// Of a part of a system: where each node of the whole is, if it is there.
    places: Option<Vec<Option<usize>>>,
}

impl System {
    /// What it is made ready for.
    pub fn regime(&self) -> &Regime {
        &self.regime
    }

    /// Where all signals are constant: the time and the frame.
    pub fn standstill(&self) -> Option<&Standstill> {
        self.regime.standstill()
    }

    /// The period.
    pub fn period(&self) -> f64 {
        self.regime.period()
    }

    /// Which nodes and elements follow which, of like blades, where motions are periodic.
    pub fn symmetry(&self) -> Option<&Arc<Symmetry>> {
        self.symmetry.as_ref()
    }

    /// Number of stations with stress resultants.
    pub fn stations(&self) -> usize {
        self.elements.last().map_or(0, |placed| placed.stations.end)
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.reference.len()
    }

    /// Reference motions of the nodes.
    pub fn reference(&self) -> &[Motion] {
        &self.reference
    }

    /// Number of own unknowns of all elements at an instant.
    pub fn own_unknowns(&self) -> usize {
        self.own_unknowns.len()
    }

    /// The inertias of bodies, beams and shells.
    pub fn inertias(&self) -> &[Arc<Inertia>] {
        &self.inertias
    }

    /// The beam elements.
    pub fn beams(&self) -> &[Arc<Beam>] {
        &self.beams
    }

    /// The shell elements.
    pub fn shells(&self) -> &[Arc<Shell>] {
        &self.shells
    }

    /// The joints.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Number of the signal that prescribes a joint coordinate.
    pub fn prescribed_place(&self, at: &JointCoordinate) -> Option<usize> {
        self.prescribed.iter().position(|other| other == at)
    }

    /// Number of signals.
    pub fn signals(&self) -> usize {
        self.signals.len()
    }

    /// The elements.
    pub fn elements(&self) -> &[Placed] {
        &self.elements
    }

    /// What own unknown `index` of all elements is.
    pub fn unknown(&self, index: usize) -> Unknown {
        self.own_unknowns[index]
    }

    /// Those of `workers` that may evaluate elements: functions of the user are called on the
    /// thread of the caller.
    pub(crate) fn element_workers(&self, workers: &Workers) -> Workers {
        if self.calls_functions {
            workers.alone()
        } else {
            workers.clone()
        }
    }

    /// Those of `workers` that may look at different times at once: signals too may be functions of
    /// the user.
    pub(crate) fn time_workers(&self, workers: &Workers) -> Workers {
        match self.signals.iter().any(DrivenSignal::is_function) {
            true => workers.alone(),
            false => self.element_workers(workers),
        }
    }

    /// Whether forces come from functions of the user.
    pub fn calls_functions(&self) -> bool {
        self.calls_functions
    }

    /// Characteristic length, mass, time and force.
    pub fn scales(&self) -> &Scales {
        &self.scales
    }
}
