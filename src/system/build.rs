//! A system made from a model: elements, signals and unknowns, each in its place.

use super::driven::Drive;
use super::scales::coordinate_scales;
use super::{ElementRole, Placed, PlacedRelation, Regime, Scales, Symmetry, System};
use crate::elements::{
    ActedCoordinate, CoordinateForce, Element, JointKind, Law, MassDamping, Prescribed, Relation,
    Shape, Viscoelastic, ViscousDamper,
};
use crate::error::{Error, ErrorKind, Result, require_positive_number};
use crate::memory;
use crate::model::{
    BoundSignal, ForceDefinition, JointCoordinate, JointDefinition, LoadPoint, Model, Parameter,
    RotorSymmetry, Signal,
};
use crate::workers::no_threads_unasked;
use nalgebra::Matrix6;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

impl System {
    /// Makes `model` ready for `period`.
    ///
    /// # Errors
    /// If the model has no nodes, or a prescribed motion or load does not repeat after one period.
    pub fn new(model: &Model, period: f64) -> Result<Self> {
        Self::in_regime(model, Regime::Periodic(period))
    }

    /// Makes `model` ready for a period, for one time or for a march.
    ///
    /// # Errors
    /// If the model has no nodes, or lacks functions of the user; if a prescribed motion or load
    /// does not repeat after one period; at one time and in a march, if the period is needed and
    /// not given; if gravity is across the axis of a turning frame.
    pub fn in_regime(model: &Model, regime: Regime) -> Result<Self> {
        Builder::new(model, regime, false, None)?.build(None)
    }

    /// The same for a model whose parameters have other values. What those do not touch is shared;
    /// characteristic scales stay as they are, so that equations of both are of the same size.
    ///
    /// # Errors
    /// As [`System::in_regime`].
    pub fn with_values_of(&self, model: &Model) -> Result<Self> {
        Builder::new(model, self.regime, false, Some(self))?.build(Some(self))
    }

    /// The system of a solution that is known. Functions of the user may be absent; then nothing
    /// can be evaluated.
    ///
    /// # Errors
    /// As [`System::in_regime`].
    pub(crate) fn of_known_solution(model: &Model, regime: Regime) -> Result<Self> {
        Builder::new(model, regime, true, None)?.build(None)
    }
}

/// 6×6 matrices that an element takes for each pair of its nodes, at most: of its inertia, its
/// stiffness and damping, and those that it takes however many nodes it has.
const MATRICES_OF_PAIR: usize = 4;

/// Checks that the elements of `model` are to be had.
fn require_elements(model: &Model) -> Result<()> {
    let beams = model.beams.iter().map(|beam| beam.nodes.len());
    let shells = model.shells.iter().map(|shell| shell.nodes.len());
    let bodies = model.inertias.iter().map(|_| 1);
    let of_nodes = |count: usize| MATRICES_OF_PAIR * count * count * size_of::<Matrix6<f64>>();
    let bytes = beams.chain(shells).chain(bodies).map(of_nodes).sum();
    memory::require("the elements of the model", bytes)
}

/// A system on its way.
pub(super) struct Builder<'a> {
    model: &'a Model,
    /// Whether functions that are absent count as zero.
    pub(super) known: bool,
    /// Whether any did.
    pub(super) lacks_functions: bool,
    pub(super) system: System,
}

impl<'a> Builder<'a> {
    /// Begins, maybe with bodies and beams `like` those of another system of the same model.
    fn new(model: &'a Model, regime: Regime, known: bool, like: Option<&System>) -> Result<Self> {
        no_threads_unasked();
        if model.nodes.is_empty() {
            let message = "model: expected at least one node, got none";
            return Err(Error::new(ErrorKind::Model, message));
        }
        require_positive_number("period", regime.period())?;
        let moved = model.parameters().iter().any(Parameter::moves_bodies);
        let (beams, shells, inertias) = match like.filter(|_| !moved) {
            Some(like) => (
                like.beams.clone(),
                like.shells.clone(),
                like.inertias.clone(),
            ),
            None => {
                require_elements(model)?;
                let beams = model.beam_elements()?;
                let shells = model.shell_elements()?;
                let inertias = model.inertia_elements(&beams, &shells)?;
                let inertias = inertias.into_iter().map(Arc::new).collect();
                (beams, shells, inertias)
            }
        };
        let system = System {
            regime,
            reference: model.nodes.clone(),
            elements: Vec::new(),
            shapes: Vec::new(),
            own_unknowns: Vec::new(),
            signals: Vec::new(),
            gravity: None,
            inertias,
            beams,
            shells,
            joints: model.joints.iter().map(JointDefinition::element).collect(),
            counted_turns: Vec::new(),
            turning: None,
            symmetry: None,
            drives: Vec::new(),
            prescribed: model.prescribed.iter().map(|(at, _)| *at).collect(),
            relations: Vec::new(),
            tracked: Vec::new(),
            acted_on: 0,
            loops: Vec::new(),
            dependencies: Vec::new(),
            calls_functions: model.forces.iter().any(ForceDefinition::calls_function),
            lacks_functions: false,
            scales: Scales::default(),
            places: None,
        };
        Ok(Builder {
            model,
            known,
            lacks_functions: false,
            system,
        })
    }

    /// Goes on to the end. Scales, and constraints that depend on others, are those of a system
    /// `like` this, if there is one.
    fn build(mut self, like: Option<&System>) -> Result<System> {
        self.place_bodies_and_joints();
        self.place_prescribed()?;
        // Of inertias, beams and joints, which give it; forces only need its order.
        let length = match like {
            Some(like) => like.scales.length,
            None if self.system.extent() > 0.0 => self.system.extent(),
            None => Scales::of(&self.system, &[])?.length,
        };
        for (index, force) in self.model.forces.iter().enumerate() {
            let element = self.force(index, force, length)?;
            self.system.place(element, ElementRole::Force(index));
        }
        self.place_relations()?;
        self.system.acted_on = self.system.tracked.len();
        self.track_other_angles();
        self.place_loads()?;
        self.add_gravity()?;
        self.add_mass_damping();
        let (mut system, lacks_functions) = (self.system, self.lacks_functions);
        system.add_turning(self.model.turning_frame())?;
        if let Some(like) = like {
            system.scales = like.scales;
            system.loops.clone_from(&like.loops);
            system.dependencies.clone_from(&like.dependencies);
            system.symmetry.clone_from(&like.symmetry);
            return Ok(system);
        }
        let rotor = match system.regime {
            Regime::Periodic(_) => self.model.rotor_symmetry(),
            _ => None,
        };
        system.scales = Scales::of(&system, rotor.map_or(&[], RotorSymmetry::blades))?;
        let Scales { length, force, .. } = system.scales;
        if !(length.is_finite() && force.is_finite() && force * length < f64::MAX) {
            return Err(Error::new(
                ErrorKind::Model,
                "model: its sizes, stiffnesses and masses are too far apart to compute with",
            ));
        }
        system.find_dependencies()?;
        system.lacks_functions = lacks_functions;
        if let Some(rotor) = rotor {
            system.symmetry = Some(Arc::new(Symmetry::new(&system, rotor)?));
        }
        Ok(system)
    }

    fn place_bodies_and_joints(&mut self) {
        let system = &mut self.system;
        for inertia in system.inertias.clone() {
            system.place(inertia, ElementRole::Inertia);
        }
        for (index, beam) in system.beams.clone().into_iter().enumerate() {
            system.place(beam, ElementRole::Beam(index));
        }
        for (index, shell) in system.shells.clone().into_iter().enumerate() {
            system.place(shell, ElementRole::Shell(index));
        }
        for (index, joint) in system.joints.clone().into_iter().enumerate() {
            system.place(Arc::new(joint), ElementRole::Joint(index));
        }
    }

    fn place_prescribed(&mut self) -> Result<()> {
        let is_screw = |joint: &JointDefinition| matches!(joint.kind, JointKind::Screw { .. });
        let counts = self.model.joints.iter().any(is_screw) || !self.model.relations.is_empty();
        for (index, (at, signal)) in self.model.prescribed.iter().enumerate() {
            let place = format!("prescribed {} of joint {}", at.coordinate, at.joint);
            let start = self.model.reference_coordinate(at);
            let bound = self.bind(signal);
            let system = &mut self.system;
            // An angle may gain whole turns.
            let turns = system.joints[at.joint]
                .kind()
                .leaves_turns_open(at.coordinate);
            let unit = if turns { TAU } else { 0.0 };
            let signal = match system.joints[at.joint]
                .kind()
                .is_middle_angle(at.coordinate)
            {
                true => system.add_middle_angle(bound, start, place)?,
                false => system.add_signal(bound, start, unit, place)?,
            };
            if turns && counts {
                system.counted_turns.push(signal);
            }
            if turns {
                system.drives.push(Drive {
                    coordinate: at.coordinate,
                    signal,
                });
            }
            let element = Prescribed::new(&system.joints[at.joint], at.coordinate, signal);
            system.place(Arc::new(element), ElementRole::Prescribed(index));
        }
        Ok(())
    }

    fn place_relations(&mut self) -> Result<()> {
        for (index, relation) in self.model.relations.iter().enumerate() {
            let (measure, unit) = relation.unit();
            let of_reference =
                |(at, a): &(JointCoordinate, f64)| a * self.model.reference_coordinate(at);
            let start = relation.terms.iter().map(of_reference).sum();
            let (bound, place) = (self.bind(&relation.signal), format!("relation {index}"));
            let signal = self.system.add_signal(bound, start, 0.0, place)?;
            let terms: Vec<_> = relation
                .terms
                .iter()
                .map(|(at, a)| (*at, a / unit))
                .collect();
            let acted = terms
                .iter()
                .map(|(at, b)| (self.acted_on(at), *b))
                .collect();
            let element = Relation::new(acted, (signal, 1.0 / unit), measure);
            let factor = 1.0 / unit;
            self.system.relations.push(PlacedRelation {
                terms,
                factor,
                signal,
            });
            self.system
                .place(Arc::new(element), ElementRole::Relation(index));
        }
        self.system.require_whole_turns()
    }

    fn place_loads(&mut self) -> Result<()> {
        for (index, load) in self.model.loads.iter().enumerate() {
            let place = match load.at {
                LoadPoint::Node(node) => format!("load {index} on node {node}"),
                LoadPoint::Beam { .. } => format!("load {index}"),
            };
            let numbers = self.add_components(&load.components, &place)?;
            let element = load.element(&self.system.beams, numbers)?;
            self.system.place(element, ElementRole::Load);
        }
        // All those of a beam element together.
        let mut along = BTreeMap::new();
        for (index, load) in self.model.distributed_loads.iter().enumerate() {
            let place = format!("beam load {index}");
            let numbers = self.add_components(&load.components, &place)?;
            load.add_to(&mut along, &self.system.beams, numbers)?;
        }
        for (index, load) in self.model.shell_loads.iter().enumerate() {
            let place = format!("shell load {index}");
            let numbers = self.add_components(&load.components, &place)?;
            for shell in &self.system.shells.clone()[load.range()] {
                let element = shell.load(load.place, load.frame, numbers)?;
                self.system.place(Arc::new(element), ElementRole::Load);
            }
        }
        for element in along.into_values().filter(|load| !load.is_empty()) {
            self.system.place(Arc::new(element), ElementRole::Load);
        }
        Ok(())
    }

    fn add_gravity(&mut self) -> Result<()> {
        let Some(gravity) = &self.model.gravity else {
            return Ok(());
        };
        let mut numbers = [0; 3];
        for (number, signal) in numbers.iter_mut().zip(gravity) {
            let bound = self.bind(signal);
            *number = (self.system).add_signal(bound, 0.0, 0.0, "gravity".into())?;
        }
        self.system.gravity = Some(numbers);
        Ok(())
    }

    fn add_mass_damping(&mut self) {
        if !self.model.has_mass_damping() {
            return;
        }
        for inertia in self.system.inertias.clone() {
            let element = MassDamping::new(inertia, self.model.mass_damping);
            let role = ElementRole::MassDamping;
            self.system.place(Arc::new(element), role);
        }
    }

    /// A signal over the period.
    fn bind(&mut self, signal: &Signal) -> BoundSignal {
        if self.known && signal.is_absent() {
            self.lacks_functions = true;
            return BoundSignal::constant(0.0);
        }
        signal.bind(self.system.period())
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
                let bound = self.bind(signal);
                *number = Some(self.system.add_signal(bound, 0.0, 0.0, place.into())?);
            }
        }
        Ok(numbers)
    }

    /// The element of a force. Motions are of the order of `length`.
    fn force(
        &mut self,
        index: usize,
        force: &ForceDefinition,
        length: f64,
    ) -> Result<Arc<dyn Element>> {
        let frequency = TAU / self.system.period();
        let within = |e: Error| e.within(format!("force {index}"));
        Ok(match force {
            ForceDefinition::SpringDamper {
                at,
                stiffness,
                damping,
                rest,
            } => {
                let law = Law::Polynomial {
                    stiffness: stiffness.clone(),
                    damping: damping.clone(),
                    rest: *rest,
                };
                Arc::new(CoordinateForce::new(self.acted_on(at), law))
            }
            ForceDefinition::Actuator { at, signal } => {
                let (bound, place) = (self.bind(signal), format!("force {index}"));
                let signal = self.system.add_signal(bound, 0.0, 0.0, place)?;
                let law = Law::Actuator { signal };
                Arc::new(CoordinateForce::new(self.acted_on(at), law))
            }
            ForceDefinition::CoordinateLaw { at, law, cycles } => {
                let law = Law::Function {
                    law: self.coordinate_law(law, *cycles).map_err(within)?,
                    scales: coordinate_scales(at.coordinate, length, frequency),
                };
                Arc::new(CoordinateForce::new(self.acted_on(at), law))
            }
            ForceDefinition::Viscoelastic {
                at,
                stiffness,
                rest,
                branches,
            } => {
                let acted = self.acted_on(at);
                Arc::new(Viscoelastic::new(
                    acted,
                    *stiffness,
                    *rest,
                    branches.clone(),
                ))
            }
            ForceDefinition::ViscousDamper {
                first,
                second,
                matrix,
            } => Arc::new(ViscousDamper::new(*first, *second, **matrix)),
            ForceDefinition::Bushing(bushing) => Arc::new(bushing.element()),
            ForceDefinition::NodeForces {
                nodes,
                law,
                cycles,
                apart,
            } => {
                let made = self.node_forces((nodes, *apart), (law, *cycles), length);
                Arc::new(made.map_err(within)?)
            }
            ForceDefinition::Controller(controller) => {
                let made = self.controller(controller, length);
                Arc::new(made.map_err(within)?)
            }
            ForceDefinition::SurfaceForces {
                element,
                place,
                law,
                cycles,
            } => {
                let on = (*element, *place);
                let made = self.surface_force(on, (law, *cycles), length);
                Arc::new(made.map_err(within)?)
            }
        })
    }

    /// A joint coordinate that a force acts on, whose whole turns are followed.
    pub(super) fn acted_on(&mut self, at: &JointCoordinate) -> ActedCoordinate {
        let joint = &self.system.joints[at.joint];
        // Signals of prescribed coordinates are the first, in their order.
        let prescribed = self.model.prescribed_index(at);
        let tracked = self.system.tracked.len();
        self.system.tracked.push(*at);
        let reference = self.model.reference_coordinate(at);
        ActedCoordinate::new(joint, at.coordinate, tracked, prescribed, reference)
    }

    /// Follows the angles that no force acts on; those of prescribed ones are told by their
    /// signals.
    fn track_other_angles(&mut self) {
        for (joint, definition) in self.model.joints.iter().enumerate() {
            let kind = definition.kind;
            for &coordinate in kind.coordinates() {
                let at = JointCoordinate { joint, coordinate };
                // Middle angles have no turns to follow, but a place in the files of solutions.
                let has_place =
                    kind.leaves_turns_open(coordinate) || kind.is_middle_angle(coordinate);
                if has_place
                    && self.model.prescribed_index(&at).is_none()
                    && self.system.tracked_place(&at).is_none()
                {
                    self.system.tracked.push(at);
                }
            }
        }
    }
}

impl System {
    pub(super) fn place(&mut self, element: Arc<dyn Element>, role: ElementRole) {
        let has_feedback = element.has_feedback();
        let size = Shape::of(&*element);
        let first_own = self.own_unknowns.len();
        self.own_unknowns
            .extend((0..element.own_unknowns()).map(|i| element.unknown(i)));
        let known = self.shapes.iter().position(|s| *s == size);
        let shape = known.unwrap_or_else(|| {
            self.shapes.push(size);
            self.shapes.len() - 1
        });
        let first_station = self.stations();
        self.elements.push(Placed {
            has_states: element.has_states(),
            has_feedback,
            stations: first_station..first_station + element.stress_laws().len(),
            element,
            role,
            first_own,
            shape,
        });
    }
}
