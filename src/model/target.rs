//! What parameters move, and what is said where the model does not have it.

use crate::error::{Error, ErrorKind};
use serde::{Deserialize, Serialize};

/// A signal of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SignalPlace {
    /// Of an actuator, a force.
    Actuator(usize),
    /// Of a prescribed coordinate, in the order in which they were prescribed.
    Prescribed(usize),
    /// Of a component of a load at a point, in the order in which these were added.
    Load(usize, usize),
    /// Of a component of a load along beams, in the order in which these were added.
    DistributedLoad(usize, usize),
    /// Of a component of a load on shells, in the order in which these were added.
    ShellLoad(usize, usize),
    /// Of a component of gravity.
    Gravity(usize),
    /// Of a relation between joint coordinates.
    Relation(usize),
}

/// A number of a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SignalPart {
    /// The mean that is added to its shape.
    Mean,
    /// Growth in a unit of time.
    Rate,
    /// Factor of its shape: harmonics, samples or function.
    Amplitude,
    /// Phase, in radians, by which its shape is ahead.
    Phase,
}

/// What a parameter moves: one number of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Target {
    /// A number of a signal.
    Signal(SignalPlace, SignalPart),
    /// The coefficient of a power, from 1, of the growth of a spring-damper; with power 1 the
    /// long-term stiffness of a viscoelastic force, and a factor of the stiffness of a bushing.
    Stiffness(usize, usize),
    /// The coefficient of a power, from 1, of the rate of a spring-damper; with power 1 a factor of
    /// the damping of a bushing.
    Damping(usize, usize),
    /// The coordinate at which a spring-damper or a viscoelastic force is free of effort.
    Rest(usize),
    /// Factor of an inertia, in the order in which bodies, masses and inertias were given, without
    /// those of beams.
    Inertia(usize),
    /// Angle in a unit of time that an inertia spins, see
    /// [`Model::set_spin`](super::Model::set_spin); numbered as for [`Target::Inertia`].
    Spin(usize),
    /// Factor of the sections' stiffness along a beam element.
    BeamStiffness(usize),
    /// Factor of the sections' mass along a beam element.
    BeamMass(usize),
    /// Factor of the sections' damping along a beam element.
    BeamDamping(usize),
    /// Angle in a unit of time that the material of a beam element spins, see
    /// [`Model::set_beam_spin`](super::Model::set_beam_spin).
    BeamSpin(usize),
    /// Factor of the stiffness of a shell element.
    ShellStiffness(usize),
    /// Factor of the mass of a shell element.
    ShellMass(usize),
    /// Factor of the damping of a shell element.
    ShellDamping(usize),
    /// Factor of the thickness of a shell element, which moves stiffness, mass and damping, see
    /// [`ShellSection::thickened`](crate::elements::ShellSection::thickened); more than zero.
    ShellThickness(usize),
    /// Damping in proportion to mass, see
    /// [`Model::set_mass_damping`](super::Model::set_mass_damping).
    MassDamping,
    /// Angle in a unit of time of the frame that everything is described in, see
    /// [`Model::set_turning_frame`](super::Model::set_turning_frame).
    FrameRate,
    /// Speed of that frame along its axis, see
    /// [`Model::set_frame_advance`](super::Model::set_frame_advance).
    FrameAdvance,
}

impl Target {
    /// Whether forces and constraints are linear in it.
    pub(super) fn is_linear(&self) -> bool {
        match self {
            Target::Signal(SignalPlace::Prescribed(_) | SignalPlace::Relation(_), _)
            | Target::Rest(_)
            | Target::FrameRate
            | Target::FrameAdvance
            | Target::ShellThickness(_) => false,
            Target::Signal(_, part) => *part != SignalPart::Phase,
            _ => true,
        }
    }

    /// Whether it changes bodies, beams or shells.
    pub(super) fn is_of_bodies(&self) -> bool {
        matches!(
            self,
            Target::Inertia(_)
                | Target::Spin(_)
                | Target::BeamStiffness(_)
                | Target::BeamMass(_)
                | Target::BeamDamping(_)
                | Target::BeamSpin(_)
                | Target::ShellStiffness(_)
                | Target::ShellMass(_)
                | Target::ShellDamping(_)
                | Target::ShellThickness(_)
        )
    }
}

/// The error of a target that the model does not have.
pub(super) fn no_such(target: Target) -> Error {
    let (expected, got) = match target {
        Target::Signal(place, _) => ("what has a signal", describe(place)),
        Target::Stiffness(force, 1) => (
            "a spring-damper with linear stiffness, a viscoelastic force or a bushing",
            format!("force {force}"),
        ),
        Target::Stiffness(force, power) => (
            "a spring-damper with a coefficient of that power of its growth",
            format!("power {power} of force {force}"),
        ),
        Target::Damping(force, 1) => (
            "a spring-damper with linear damping, or a bushing",
            format!("force {force}"),
        ),
        Target::Damping(force, power) => (
            "a spring-damper with a coefficient of that power of its rate",
            format!("power {power} of force {force}"),
        ),
        Target::Rest(force) => (
            "a spring-damper or a viscoelastic force",
            format!("force {force}"),
        ),
        Target::Inertia(inertia) => ("an inertia that was given", format!("inertia {inertia}")),
        Target::Spin(inertia) => (
            "an inertia that was given a spin",
            format!("inertia {inertia}"),
        ),
        Target::BeamStiffness(element)
        | Target::BeamMass(element)
        | Target::BeamDamping(element)
        | Target::BeamSpin(element) => {
            ("a beam element that is there", format!("element {element}"))
        }
        Target::ShellStiffness(element)
        | Target::ShellMass(element)
        | Target::ShellDamping(element)
        | Target::ShellThickness(element) => (
            "a shell element that is there",
            format!("element {element}"),
        ),
        Target::MassDamping => ("damping by mass", "none".into()),
        Target::FrameRate | Target::FrameAdvance => (
            "a model that is described in a turning frame",
            "one without such a frame".into(),
        ),
    };
    let message = format!("target: expected {expected}, got {got}");
    Error::new(ErrorKind::Identifier, message)
}

/// The error of a place without a signal.
pub(super) fn no_such_signal(place: SignalPlace) -> Error {
    let component = match place {
        SignalPlace::Load(_, c)
        | SignalPlace::DistributedLoad(_, c)
        | SignalPlace::ShellLoad(_, c)
        | SignalPlace::Gravity(c) => format!(", component {}", c + 1),
        _ => String::new(),
    };
    let what = describe(place);
    let message = format!("id: expected what has a signal there, got {what}{component}");
    Error::new(ErrorKind::NotAvailable, message)
}

/// What has a signal, for messages.
pub(super) fn describe(place: SignalPlace) -> String {
    match place {
        SignalPlace::Actuator(force) => format!("force {force}"),
        SignalPlace::Prescribed(index) => format!("prescribed coordinate {index}"),
        SignalPlace::Load(load, _) => format!("load {load}"),
        SignalPlace::DistributedLoad(load, _) => format!("beam load {load}"),
        SignalPlace::ShellLoad(load, _) => format!("shell load {load}"),
        SignalPlace::Gravity(_) => "gravity".into(),
        SignalPlace::Relation(index) => format!("relation {index}"),
    }
}
