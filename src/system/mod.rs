//! One instant of the whole mechanism: its elements, unknowns, signals and characteristic scales.

mod check;
mod constraints;
mod driven;
mod mass_properties;
mod partition;
mod repetition;
mod scales;
mod spectra;
mod summary;
mod turning;
mod warnings;

pub use check::{TangentCheck, check_tangents};
pub use constraints::{ConstraintLoop, Dependency, name_all, name_constraints};
pub use driven::Driven;
pub use mass_properties::MassProperties;
pub use repetition::{require_periodic_forces, require_reproducible_forces};
pub use scales::Scales;
pub use summary::Summary;

use crate::elements::{ActedCoordinate, Coordinate, CoordinateForce, JointKind, Law};
use crate::elements::{Contribution, Element, Instant, Joint, NodalLoad, NodeState, Prescribed};
use crate::elements::{Measure, Unknown, Viscoelastic};
use crate::elements::{UserForce, ViscousDamper};
use crate::error::{Error, ErrorKind, Result};
use crate::model::{BoundSignal, ForceDefinition, JointCoordinate, Model, Signal};
use crate::motion::Motion;
use crate::workers::{Workers, no_threads_unasked};
use driven::Drive;
use nalgebra::{DVector, Vector3, Vector6};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

/// What an element stands for, to name it in messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementRole {
    /// Inertia of a body or a beam element.
    Inertia,
    /// Beam element of this index.
    Beam(usize),
    /// Joint of this index.
    Joint(usize),
    /// Prescribed coordinate of this index.
    Prescribed(usize),
    /// Force of this index.
    Force(usize),
    /// Load.
    Load,
}

/// An element with the place of its multipliers.
#[derive(Debug, Clone)]
pub struct Placed {
    /// The element.
    pub element: Arc<dyn Element>,
    /// What it stands for.
    pub role: ElementRole,
    /// Index of its first multiplier among all multipliers of an instant.
    pub first_multiplier: usize,
    /// Whether its own unknowns are internal states.
    pub has_states: bool,
    /// Its stations with stress resultants, among those of all elements.
    pub stations: Range<usize>,
    /// Its scratch among those of a [`Workspace`].
    shape: usize,
}

/// A coordinate whose whole turns are followed.
#[derive(Debug, Clone)]
struct Tracked {
    joint: Joint,
    at: JointCoordinate,
}

/// A signal, and the value it grows from when loads are raised in steps.
#[derive(Debug, Clone)]
struct DrivenSignal {
    signal: BoundSignal,
    start: f64,
    /// What it drives, for messages.
    place: String,
}

/// A time at which everything stands still, in a frame that may turn steadily.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Standstill {
    /// The time: signals keep the values that they have then.
    pub time: f64,
    /// Period that harmonics of signals refer to. It may be left out if no harmonics matter: at time
    /// zero, or if there are none.
    pub period: Option<f64>,
    /// Angular velocity of the frame, in which positions, directions and the ground are described.
    pub angular_velocity: Vector3<f64>,
    /// A point of the axis it turns about.
    pub axis_point: Vector3<f64>,
}

impl Default for Standstill {
    fn default() -> Self {
        Standstill {
            time: 0.0,
            period: None,
            angular_velocity: Vector3::zeros(),
            axis_point: Vector3::zeros(),
        }
    }
}

impl Standstill {
    /// The period, 1 where none matters.
    pub fn period(&self) -> f64 {
        self.period.unwrap_or(1.0)
    }
}

/// What is known of a march in time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Transient {
    /// Period that harmonics of signals refer to; it may be left out if there are none.
    pub period: Option<f64>,
    /// How long the march is.
    pub duration: f64,
    /// Length of its steps.
    pub step: f64,
}

impl Transient {
    /// Checks that all of it are positive numbers.
    pub(crate) fn validate(&self) -> Result<()> {
        let period = self.period.unwrap_or(1.0);
        for (name, x) in [
            ("period", period),
            ("duration", self.duration),
            ("step", self.step),
        ] {
            if !(x.is_finite() && x > 0.0) {
                return Err(Error::value(name, "a positive, finite number", x));
            }
        }
        Ok(())
    }
}

/// A model made ready for a given period.
#[derive(Debug, Clone)]
pub struct System {
    /// Reference motions of the nodes.
    reference: Vec<Motion>,
    elements: Vec<Placed>,
    /// `(nodes, multipliers)` of each kind of scratch.
    shapes: Vec<(usize, usize)>,
    multipliers: usize,
    signals: Vec<DrivenSignal>,
    gravity: Option<[usize; 3]>,
    /// Where set, all signals are constant.
    standstill: Option<Standstill>,
    joints: Vec<Joint>,
    /// Signals that prescribe angles whose whole turns matter, as they turn a screw.
    counted_turns: Vec<usize>,
    /// Whether the system is marched in time: nothing needs to repeat itself.
    transient: Option<Transient>,
    /// Signals of the frame's angular velocity, if it turns.
    turning: Option<[usize; 3]>,
    /// Prescribed angles whose whole turns are open.
    drives: Vec<Drive>,
    /// Coordinates that forces act on, force by force, then all other angles whose whole turns are open.
    tracked: Vec<Tracked>,
    /// How many of them forces act on.
    acted_on: usize,
    /// What each own unknown of the elements is.
    unknowns: Vec<Unknown>,
    /// Loops of constraints, where some may depend on others.
    loops: Vec<ConstraintLoop>,
    dependencies: Vec<Dependency>,
    /// Whether forces come from functions of the user.
    calls_functions: bool,
    scales: Scales,
    period: f64,
}

/// Scratch for evaluating elements: one contribution for each size of element.
#[derive(Debug, Clone)]
pub struct Workspace {
    contributions: Vec<Contribution>,
    states: Vec<NodeState>,
}

impl System {
    /// Makes `model` ready for `period`.
    ///
    /// # Errors
    /// If the model has no nodes, or a prescribed motion or load does not repeat after one period.
    pub fn new(model: &Model, period: f64) -> Result<Self> {
        Self::build(model, period, None, None)
    }

    /// Makes `model` ready for a march in time.
    ///
    /// # Errors
    /// If the model has no nodes, or the period is needed and not given.
    pub fn in_transient(model: &Model, transient: &Transient) -> Result<Self> {
        let period = transient.period.unwrap_or(transient.duration);
        Self::build(model, period, None, Some(*transient))
    }

    /// Makes `model` ready as it is at one time.
    ///
    /// # Errors
    /// If the model has no nodes, the period is needed and not given, or gravity is across the axis
    /// of a turning frame.
    pub fn at_standstill(model: &Model, standstill: &Standstill) -> Result<Self> {
        Self::build(model, standstill.period(), Some(*standstill), None)
    }

    fn build(
        model: &Model,
        period: f64,
        standstill: Option<Standstill>,
        transient: Option<Transient>,
    ) -> Result<Self> {
        no_threads_unasked();
        if model.nodes.is_empty() {
            let message = "model: expected at least one node, got none";
            return Err(Error::new(ErrorKind::Model, message));
        }
        if !(period.is_finite() && period > 0.0) {
            return Err(Error::value("period", "a positive, finite number", period));
        }
        let mut system = System {
            reference: model.nodes.clone(),
            elements: Vec::new(),
            shapes: Vec::new(),
            multipliers: 0,
            signals: Vec::new(),
            gravity: None,
            standstill,
            joints: model.joints.clone(),
            counted_turns: Vec::new(),
            transient,
            turning: None,
            drives: Vec::new(),
            tracked: Vec::new(),
            acted_on: 0,
            unknowns: Vec::new(),
            loops: Vec::new(),
            dependencies: Vec::new(),
            calls_functions: model.forces.iter().any(ForceDefinition::calls_function),
            scales: Scales::default(),
            period,
        };
        for inertia in &model.inertias {
            system.place(Arc::new(inertia.clone()), ElementRole::Inertia);
        }
        for (index, beam) in model.beams.iter().enumerate() {
            system.place(Arc::new(beam.clone()), ElementRole::Beam(index));
        }
        for (index, joint) in model.joints.iter().enumerate() {
            system.place(Arc::new(joint.clone()), ElementRole::Joint(index));
        }
        let is_screw = |joint: &Joint| matches!(joint.kind(), JointKind::Screw { .. });
        let has_screw = model.joints.iter().any(is_screw);
        for (index, (at, signal)) in model.prescribed.iter().enumerate() {
            let place = format!("prescribed {} of joint {}", at.coordinate, at.joint);
            let start = model.reference_coordinate(at.joint, at.coordinate);
            let bound = signal.bind(period);
            let joint = &model.joints[at.joint];
            // An angle may gain whole turns.
            let turns = joint.kind().leaves_turns_open(at.coordinate);
            let unit = if turns { TAU } else { 0.0 };
            let signal = system.add_signal(bound, start, unit, place)?;
            if turns && has_screw {
                system.counted_turns.push(signal);
            }
            if turns {
                system.drives.push(Drive {
                    joint: at.joint,
                    coordinate: at.coordinate,
                    signal,
                });
            }
            let element = Prescribed::new(joint, at.coordinate, signal);
            system.place(Arc::new(element), ElementRole::Prescribed(index));
        }
        // Of inertias, beams and joints, which give it; forces only need its order.
        let length = Scales::of(&system)?.length;
        for (index, force) in model.forces.iter().enumerate() {
            let element = system.force(model, index, force, length)?;
            system.place(element, ElementRole::Force(index));
        }
        system.acted_on = system.tracked.len();
        system.track_other_angles(model);
        for load in &model.loads {
            let place = format!("load on node {}", load.node);
            let numbers = system.add_components(&load.components, &place)?;
            let element = NodalLoad::new(load.node, load.frame, numbers);
            system.place(Arc::new(element), ElementRole::Load);
        }
        // All those of a beam element together.
        let mut along = BTreeMap::new();
        for load in &model.distributed_loads {
            let place = format!("load along beam elements {:?}", load.range());
            let numbers = system.add_components(&load.components, &place)?;
            load.add_to(&mut along, &model.beams, numbers)?;
        }
        for element in along.into_values().filter(|load| !load.is_empty()) {
            system.place(Arc::new(element), ElementRole::Load);
        }
        if let Some(gravity) = &model.gravity {
            let mut numbers = [0; 3];
            for (number, signal) in numbers.iter_mut().zip(gravity) {
                let bound = signal.bind(period);
                *number = system.add_signal(bound, 0.0, 0.0, "gravity".into())?;
            }
            system.gravity = Some(numbers);
        }
        system.add_turning()?;
        system.scales = Scales::of(&system)?;
        let Scales { length, force, .. } = system.scales;
        if !(length.is_finite() && force.is_finite() && force * length < f64::MAX) {
            return Err(Error::new(
                ErrorKind::Model,
                "model: its sizes, stiffnesses and masses are too far apart to compute with",
            ));
        }
        system.find_dependencies()?;
        Ok(system)
    }

    /// The element of a force. Motions are of the order of `length`.
    fn force(
        &mut self,
        model: &Model,
        index: usize,
        force: &ForceDefinition,
        length: f64,
    ) -> Result<Arc<dyn Element>> {
        let frequency = TAU / self.period;
        // Signals of prescribed coordinates are the first, in their order.
        let turns_of = |at: &JointCoordinate| model.prescribed_index(at);
        let (at, law) = match force {
            ForceDefinition::SpringDamper {
                at,
                stiffness,
                damping,
                rest,
            } => {
                let (stiffness, damping) = (stiffness.clone(), damping.clone());
                let law = Law::Polynomial {
                    stiffness,
                    damping,
                    rest: *rest,
                };
                (at, law)
            }
            ForceDefinition::Actuator { at, signal } => {
                let place = format!("force {index}");
                let signal = self.add_signal(signal.bind(self.period), 0.0, 0.0, place)?;
                (at, Law::Actuator { signal })
            }
            ForceDefinition::CoordinateLaw { at, law } => {
                let law = Law::Function {
                    law: law.clone(),
                    scales: coordinate_scales(at.coordinate, length, frequency),
                };
                (at, law)
            }
            ForceDefinition::Viscoelastic {
                at,
                stiffness,
                rest,
                branches,
            } => {
                let tracked = self.track_coordinate(model, at);
                let joint = &model.joints[at.joint];
                let coordinate = at.coordinate;
                let branches = branches.clone();
                let acted = ActedCoordinate::new(joint, coordinate, tracked, turns_of(at));
                let element = Viscoelastic::new(acted, *stiffness, *rest, branches);
                return Ok(Arc::new(element));
            }
            ForceDefinition::ViscousDamper {
                first,
                second,
                matrix,
            } => return Ok(Arc::new(ViscousDamper::new(*first, *second, **matrix))),
            ForceDefinition::NodeForces { nodes, law } => {
                let (nodes, law) = (nodes.clone(), law.clone());
                return Ok(Arc::new(UserForce::new(nodes, law, length, frequency)));
            }
        };
        let tracked = self.track_coordinate(model, at);
        let joint = &model.joints[at.joint];
        let acted = ActedCoordinate::new(joint, at.coordinate, tracked, turns_of(at));
        Ok(Arc::new(CoordinateForce::new(acted, law)))
    }

    /// Follows the whole turns of a joint coordinate; its place among the tracked ones.
    fn track_coordinate(&mut self, model: &Model, at: &JointCoordinate) -> usize {
        self.tracked.push(Tracked {
            joint: model.joints[at.joint].clone(),
            at: *at,
        });
        self.tracked.len() - 1
    }

    /// Follows the angles that no force acts on; those of prescribed ones are told by their signals.
    fn track_other_angles(&mut self, model: &Model) {
        for (joint, definition) in model.joints.iter().enumerate() {
            let kind = definition.kind();
            for &coordinate in kind.coordinates() {
                let at = JointCoordinate { joint, coordinate };
                if kind.leaves_turns_open(coordinate)
                    && model.prescribed_index(&at).is_none()
                    && self.tracked_place(&at).is_none()
                {
                    self.track_coordinate(model, &at);
                }
            }
        }
    }

    /// Place of a joint coordinate among those whose turns are followed.
    pub fn tracked_place(&self, at: &JointCoordinate) -> Option<usize> {
        self.tracked.iter().position(|tracked| tracked.at == *at)
    }

    /// Adds a signal that repeats itself, or gains whole multiples of `unit` in a period.
    fn add_signal(
        &mut self,
        signal: BoundSignal,
        start: f64,
        unit: f64,
        place: String,
    ) -> Result<usize> {
        let signal = match &self.standstill {
            Some(standstill) => constant(&signal, standstill, &place)?,
            None => signal,
        };
        match &self.transient {
            Some(transient) if transient.period.is_none() && signal.has_harmonics() => {
                let expected = format!("the period of the harmonics of the signal of {place}");
                return Err(Error::value("options.period", expected, "none"));
            }
            Some(_) => {}
            None => require_periodic(&signal, unit).map_err(|e| e.within(&place))?,
        }
        self.signals.push(DrivenSignal {
            signal,
            start,
            place,
        });
        Ok(self.signals.len() - 1)
    }

    /// Adds the signals of a load's components.
    fn add_components(
        &mut self,
        components: &[Option<Signal>; 6],
        place: &str,
    ) -> Result<[Option<usize>; 6]> {
        let mut numbers = [None; 6];
        for (number, component) in numbers.iter_mut().zip(components) {
            if let Some(signal) = component {
                let bound = signal.bind(self.period);
                *number = Some(self.add_signal(bound, 0.0, 0.0, place.into())?);
            }
        }
        Ok(numbers)
    }

    fn place(&mut self, element: Arc<dyn Element>, role: ElementRole) {
        let size = (element.nodes().len(), element.multipliers());
        self.unknowns
            .extend((0..size.1).map(|i| element.unknown(i)));
        let shape = self
            .shapes
            .iter()
            .position(|s| *s == size)
            .unwrap_or_else(|| {
                self.shapes.push(size);
                self.shapes.len() - 1
            });
        let first_station = self.stations();
        self.elements.push(Placed {
            has_states: element.has_states(),
            stations: first_station..first_station + element.stress_laws().len(),
            element,
            role,
            first_multiplier: self.multipliers,
            shape,
        });
        self.multipliers += size.1;
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
    pub fn multipliers(&self) -> usize {
        self.multipliers
    }

    /// The joints.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Number of signals.
    pub fn signals(&self) -> usize {
        self.signals.len()
    }

    /// Number of coordinates whose turns are followed.
    pub fn tracked(&self) -> usize {
        self.tracked.len()
    }

    /// Number of those that forces act on: the first.
    pub fn acted_on(&self) -> usize {
        self.acted_on
    }

    /// The elements.
    pub fn elements(&self) -> &[Placed] {
        &self.elements
    }

    /// What own unknown `index` of all elements is.
    pub fn unknown(&self, index: usize) -> Unknown {
        self.unknowns[index]
    }

    /// What is known of the march, of a system in one.
    pub fn transient(&self) -> Option<&Transient> {
        self.transient.as_ref()
    }

    /// Those of `workers` that may evaluate elements: functions of the user are called on the thread of the caller.
    pub(crate) fn element_workers(&self, workers: &Workers) -> Workers {
        if self.calls_functions {
            workers.alone()
        } else {
            workers.clone()
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

    /// Frequency that inertial forces are characterised by: that of the period or, of a march, of a step.
    pub(super) fn characteristic_frequency(&self) -> f64 {
        match &self.transient {
            Some(transient) => 1.0 / transient.step,
            None => TAU / self.period,
        }
    }

    /// The period.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Scratch for [`System::evaluate`].
    pub fn workspace(&self, with_tangents: bool) -> Workspace {
        Workspace {
            contributions: self
                .shapes
                .iter()
                .map(|&(nodes, multipliers)| Contribution::new(nodes, multipliers, with_tangents))
                .collect(),
            states: Vec::new(),
        }
    }

    /// The same for tangents with those of stress resultants apart.
    pub fn workspace_with_resultants_apart(&self) -> Workspace {
        let mut workspace = self.workspace(true);
        for contribution in &mut workspace.contributions {
            contribution.with_resultants_apart = true;
        }
        workspace
    }

    /// Values of all signals at `time`, with loads and prescribed motions carried the fraction
    /// `load_factor` of the way from the reference configuration.
    pub fn signal_values(&self, time: f64, load_factor: f64, values: &mut [f64]) -> Result<()> {
        for (value, driven) in values.iter_mut().zip(&self.signals) {
            let full = driven
                .signal
                .value(time)
                .map_err(|e| e.within(&driven.place))?;
            *value = if load_factor == 1.0 {
                full
            } else {
                driven.start + load_factor * (full - driven.start)
            };
        }
        Ok(())
    }

    /// Largest change of a prescribed angle whose whole turns matter, between two conditions
    /// `(time, load factor)`.
    pub fn turn_between(&self, from: (f64, f64), to: (f64, f64)) -> Result<f64> {
        if self.counted_turns.is_empty() {
            return Ok(0.0);
        }
        let mut values = [vec![0.0; self.signals()], vec![0.0; self.signals()]];
        for (values, (time, load_factor)) in values.iter_mut().zip([from, to]) {
            self.signal_values(time, load_factor, values)?;
        }
        let change = |&signal: &usize| (values[1][signal] - values[0][signal]).abs();
        Ok(self.counted_turns.iter().map(change).fold(0.0, f64::max))
    }

    /// Values, first and second derivatives of all signals at `time`, see [`BoundSignal::derivatives`].
    pub fn signal_derivatives(&self, time: f64, step: f64) -> Result<[Vec<f64>; 3]> {
        let mut all = [(); 3].map(|()| Vec::with_capacity(self.signals.len()));
        for driven in &self.signals {
            let found = driven.signal.derivatives(time, step);
            let found = found.map_err(|e| e.within(&driven.place))?;
            all.iter_mut().zip(found).for_each(|(list, x)| list.push(x));
        }
        Ok(all)
    }

    /// Measures of the prescribed coordinates: their signals are the first.
    pub fn prescribed_measures(&self) -> impl Iterator<Item = Measure> {
        let prescribed = |placed: &&Placed| matches!(placed.role, ElementRole::Prescribed(_));
        let placed = self.elements.iter().filter(prescribed);
        placed.map(|placed| match placed.element.unknown(0) {
            Unknown::Multiplier(measure) | Unknown::State { measure, .. } => measure,
        })
    }

    /// Acceleration of gravity, given the values of all signals.
    pub fn gravity(&self, signals: &[f64]) -> Vector3<f64> {
        self.gravity.map_or(Vector3::zeros(), |[x, y, z]| {
            Vector3::new(signals[x], signals[y], signals[z])
        })
    }

    /// What an element sees whose nodes are at `states`.
    fn instant<'a>(
        &self,
        states: &'a [NodeState],
        conditions: &Conditions<'a>,
        own: OwnValues<'a>,
    ) -> Instant<'a> {
        Instant {
            time: self.standstill.map_or(conditions.time, |s| s.time),
            nodes: states,
            multipliers: own.values,
            multiplier_rates: own.rates,
            resultants: own.resultants,
            signals: conditions.signals,
            coordinates: conditions.coordinates,
            gravity: self.gravity(conditions.signals),
            inertia_factor: conditions.inertia_factor,
        }
    }

    /// Twist of the frame that motions are described in, if it turns and the element knows of it.
    fn frame_seen_by(&self, placed: &Placed, signals: &[f64]) -> Option<Vector6<f64>> {
        match placed.element.knows_inertial_frame() {
            true => self.frame_twist(signals),
            false => None,
        }
    }

    /// Evaluates one element for node states given by index, and returns its contribution.
    pub fn evaluate<'w>(
        &self,
        placed: &Placed,
        state: impl Fn(usize) -> NodeState,
        conditions: &Conditions,
        own: OwnValues,
        workspace: &'w mut Workspace,
    ) -> Result<&'w Contribution> {
        let frame = self.frame_seen_by(placed, conditions.signals);
        workspace.states.clear();
        workspace
            .states
            .extend(placed.element.nodes().iter().map(|&n| match &frame {
                Some(frame) => turning::inertial(&state(n), frame),
                None => state(n),
            }));
        let out = &mut workspace.contributions[placed.shape];
        out.clear();
        let instant = self.instant(&workspace.states, conditions, own);
        placed
            .element
            .evaluate(&instant, out)
            .map_err(|e| match placed.role {
                ElementRole::Beam(index) => e.within(format!("beam element {index}")),
                ElementRole::Force(index) => e.within(format!("force {index}")),
                _ => e,
            })?;
        if let Some(frame) = &frame
            && out.with_tangents
        {
            for (b, &node) in placed.element.nodes().iter().enumerate() {
                turning::add_variation(&state(node), frame, b, out);
            }
        }
        Ok(out)
    }

    /// Forces that one element exerts on its nodes, in their own axes, and its outputs.
    pub fn outputs(
        &self,
        placed: &Placed,
        states: &[NodeState],
        conditions: &Conditions,
        own: OwnValues,
    ) -> Result<(DVector<f64>, Vec<f64>)> {
        let seen: Vec<NodeState> = match self.frame_seen_by(placed, conditions.signals) {
            Some(frame) => {
                let inertial = |state| turning::inertial(state, &frame);
                states.iter().map(inertial).collect()
            }
            None => states.to_vec(),
        };
        let instant = self.instant(&seen, conditions, own);
        let mut contribution = Contribution::new(states.len(), own.values.len(), false);
        placed.element.evaluate(&instant, &mut contribution)?;
        let mut outputs = Vec::new();
        placed.element.outputs(&instant, &mut outputs)?;
        // Forces count on the left-hand side of the equations.
        Ok((-contribution.force, outputs))
    }

    /// Follows the tracked coordinates from their last values to those of the given states.
    pub fn track(&self, state: impl Fn(usize) -> NodeState, coordinates: &mut [f64]) {
        for (tracked, last) in self.tracked.iter().zip(coordinates) {
            let mut states = [NodeState::at_rest(Motion::identity()); 2];
            for (place, &node) in states.iter_mut().zip(tracked.joint.nodes()) {
                *place = state(node);
            }
            let z = tracked.joint.relative_motion(&states);
            let kind: JointKind = tracked.joint.kind();
            let value = kind.coordinate_value(tracked.at.coordinate, &z);
            *last = kind.follow(tracked.at.coordinate, value, *last);
        }
    }

    /// Moves the tracked coordinates on by what velocities and accelerations at `state` make of them in `time`, so
    /// that they may then be followed through more than half a turn.
    pub fn foresee(&self, state: impl Fn(usize) -> NodeState, time: f64, coordinates: &mut [f64]) {
        for (tracked, last) in self.tracked.iter().zip(coordinates) {
            let states: Vec<NodeState> = tracked.joint.nodes().iter().map(|&n| state(n)).collect();
            let [_, rate, acceleration] = tracked
                .joint
                .coordinate_derivatives(tracked.at.coordinate, &states);
            let change = time * (rate + 0.5 * time * acceleration);
            if change.is_finite() {
                *last += change;
            }
        }
    }
}

/// What a joint coordinate and its rate are of the order of, in a mechanism of this length and
/// circular frequency.
fn coordinate_scales(coordinate: Coordinate, length: f64, frequency: f64) -> [f64; 2] {
    let size = match coordinate.measure() {
        Measure::Angle => 1.0,
        Measure::Length => length,
    };
    [size, size * frequency]
}

/// An element's own unknowns at one instant.
#[derive(Debug, Clone, Copy)]
pub struct OwnValues<'a> {
    /// Multipliers or internal states.
    pub values: &'a [f64],
    /// Rates of internal states; zero for multipliers.
    pub rates: &'a [f64],
    /// Stress resultants for the geometric stiffness; those of the strains if empty.
    pub resultants: &'a [Vector6<f64>],
}

/// What is the same for all elements at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Conditions<'a> {
    /// Time.
    pub time: f64,
    /// Values of all signals.
    pub signals: &'a [f64],
    /// Last values of the tracked coordinates.
    pub coordinates: &'a [f64],
    /// Factor of the inertial forces.
    pub inertia_factor: f64,
}

/// A signal that keeps the value it has at the time of `standstill`.
fn constant(signal: &BoundSignal, standstill: &Standstill, place: &str) -> Result<BoundSignal> {
    let time = standstill.time;
    if standstill.period.is_none() && time != 0.0 && signal.has_harmonics() {
        return Err(Error::value(
            "options.period",
            format_args!(
                "the period of the harmonics of the signal of {place}, as options.time is not zero"
            ),
            "none",
        ));
    }
    let value = signal.value(time).map_err(|e| e.within(place))?;
    Ok(BoundSignal::constant(value))
}

/// Checks that a signal returns to itself, or gains whole multiples of `unit` (if not zero).
fn require_periodic(signal: &BoundSignal, unit: f64) -> Result<()> {
    let (first, again) = (signal.value(0.0)?, signal.value(0.0)?);
    if first != again {
        return Err(Error::new(
            ErrorKind::NotPeriodic,
            format!(
                "the function gives different values at the same time: {first}, then {again} at t = 0"
            ),
        ));
    }
    let growth = signal.growth()?;
    let rest = if unit > 0.0 {
        growth - unit * (growth / unit).round()
    } else {
        growth
    };
    // Compared with the signal's size over the period, as it may be zero at the start.
    const PARTS: usize = 8;
    let mut size = growth.abs().max(unit);
    for k in 0..PARTS {
        let time = signal.period() * k as f64 / PARTS as f64;
        size = size.max(signal.value(time)?.abs());
    }
    if rest.abs() <= 1e-9 * size {
        return Ok(());
    }
    let expected = if unit > 0.0 {
        "a whole number of turns"
    } else {
        "the value it started from"
    };
    Err(Error::new(
        ErrorKind::NotPeriodic,
        format!("the signal grows by {growth} in one period; expected {expected}"),
    ))
}
