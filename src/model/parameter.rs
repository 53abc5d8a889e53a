//! Parameters: named numbers that move parts of a model.
//!
//! What a parameter moves is a number of a definition, its target: it is set to a factor times the
//! parameter's value. A new target is a line of [`Target`] and one of `Model::number`.

use super::target::{SignalPart, SignalPlace, Target, describe, no_such};
use super::{BeamDefinition, ForceDefinition, InertiaDefinition, Model, Signal};
use crate::error::{Error, ErrorKind, Result, require_finite, require_id, require_positive_number};
use serde::{Deserialize, Serialize};

/// A named number that moves parts of the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// What it is called in messages.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// What counts as 1 in it: its range, about.
    pub scale: f64,
    /// What it moves, each with what that is for a unit of the value.
    pub(super) targets: Vec<(Target, f64)>,
}

impl Parameter {
    /// What it moves, each with what that is for a unit of the value.
    pub fn targets(&self) -> &[(Target, f64)] {
        &self.targets
    }

    /// Whether forces and constraints are linear in all that it moves: of the second degree in it
    /// at most, where it moves factors of one product.
    pub(crate) fn is_linear(&self) -> bool {
        let moves = |which: fn(&Target) -> bool| self.targets.iter().any(|(t, _)| which(t));
        // Damping by mass is a product of three factors where something spins.
        let spins = moves(|t| matches!(t, Target::Spin(_) | Target::BeamSpin(_)));
        let damps = moves(|t| *t == Target::MassDamping);
        let linear = self.targets.iter().all(|(target, _)| target.is_linear());
        linear && !(spins && damps)
    }

    /// Whether it changes bodies, beams or shells.
    pub(crate) fn moves_bodies(&self) -> bool {
        self.targets.iter().any(|(target, _)| target.is_of_bodies())
    }
}

impl Model {
    /// Adds a parameter that moves nothing yet; returns its id. `scale` is what counts as 1 in it:
    /// its range, about.
    pub fn add_parameter(&mut self, name: &str, value: f64, scale: f64) -> Result<usize> {
        require_finite("value", &[value])?;
        require_positive_number("scale", scale)?;
        if name.is_empty() || self.parameters.iter().any(|p| p.name == name) {
            let expected = "a name that no other parameter has";
            return Err(Error::value("name", expected, format!("\"{name}\"")));
        }
        self.parameters.push(Parameter {
            name: name.to_string(),
            value,
            scale,
            targets: Vec::new(),
        });
        Ok(self.parameters.len() - 1)
    }

    /// Lets a parameter move a number of the model, which becomes `factor` times its value, now and
    /// whenever that is set.
    ///
    /// # Errors
    /// If there is no such number, or a parameter moves it already.
    pub fn move_by_parameter(
        &mut self,
        parameter: usize,
        target: Target,
        factor: f64,
    ) -> Result<()> {
        let value = self.require_parameter(parameter)?.value;
        require_finite("factor", &[factor])?;
        if factor == 0.0 {
            return Err(Error::value("factor", "a number other than zero", factor));
        }
        let moves = |p: &&Parameter| p.targets.iter().any(|(other, _)| *other == target);
        if let Some(other) = self.parameters.iter().find(moves) {
            let message = format!(
                "target: the parameter \"{}\" moves the same already",
                other.name
            );
            return Err(Error::new(ErrorKind::Value, message));
        }
        self.move_target(target, factor * value)?;
        self.parameters[parameter].targets.push((target, factor));
        Ok(())
    }

    /// Gives a parameter another value, and what it moves.
    pub fn set_parameter(&mut self, parameter: usize, value: f64) -> Result<()> {
        require_finite("value", &[value])?;
        let Parameter {
            value: before,
            targets,
            ..
        } = self.require_parameter(parameter)?.clone();
        for (i, (target, factor)) in targets.iter().enumerate() {
            if let Err(error) = self.move_target(*target, factor * value) {
                for (target, factor) in &targets[..i] {
                    self.move_target(*target, factor * before)?;
                }
                return Err(error);
            }
        }
        self.parameters[parameter].value = value;
        Ok(())
    }

    /// Gives a target a number, if it and what it is a factor of are numbers then.
    fn move_target(&mut self, target: Target, number: f64) -> Result<()> {
        require_finite("factor times the value", &[number])?;
        let place = self.number(target).ok_or_else(|| no_such(target))?;
        let before = std::mem::replace(place, number);
        let checked = self.require_scaled(target);
        if checked.is_err()
            && let Some(place) = self.number(target)
        {
            *place = before;
        }
        checked
    }

    /// Gives parts of a signal that parameters move the parameters' values again.
    pub(super) fn move_signal_again(&mut self, place: SignalPlace) -> Result<()> {
        let parameters = self.parameters.iter();
        let all = parameters.flat_map(|p| p.targets.iter().map(|(t, f)| (*t, f * p.value)));
        let of_signal = |(target, _): &(Target, f64)| match target {
            Target::Signal(other, _) => *other == place,
            _ => false,
        };
        let moved: Vec<_> = all.filter(of_signal).collect();
        let mut again = moved.into_iter();
        again.try_for_each(|(target, number)| self.move_target(target, number))
    }

    /// Checks that what a target is a factor of has finite entries.
    fn require_scaled(&self, target: Target) -> Result<()> {
        match target {
            Target::Inertia(body) => {
                let bodies = self.inertias.iter().filter_map(InertiaDefinition::of_body);
                bodies.skip(body).take(1).try_for_each(|matrix| {
                    require_finite("inertia times its factor", matrix.as_slice())
                })?;
                self.require_scaled(Target::Spin(body))
            }
            Target::Spin(body) => {
                let mut bodies = self.inertias.iter().filter(|it| it.of_body().is_some());
                bodies
                    .nth(body)
                    .map_or(Ok(()), InertiaDefinition::require_spin)
            }
            Target::BeamStiffness(element)
            | Target::BeamMass(element)
            | Target::BeamDamping(element) => {
                let BeamDefinition {
                    sections, factors, ..
                } = &self.beams[element];
                sections.scaled(factors).validate()?;
                self.require_finite_inertia(target)?;
                self.require_beam_can_spin(element)
            }
            Target::BeamSpin(element) => self.require_beam_can_spin(element),
            Target::ShellStiffness(element)
            | Target::ShellMass(element)
            | Target::ShellDamping(element)
            | Target::ShellThickness(element) => {
                self.shells[element].require_finite()?;
                self.require_finite_inertia(target)
            }
            Target::Stiffness(force, _) | Target::Damping(force, _) => match &self.forces[force] {
                ForceDefinition::Bushing(bushing) => bushing.require_scaled(),
                _ => Ok(()),
            },
            Target::FrameRate => self
                .turning_frame
                .map_or(Ok(()), |frame| frame.require_finite()),
            _ => Ok(()),
        }
    }

    /// Checks the inertia of an element whose mass is the target, which may be too large where its
    /// section's entries are not.
    fn require_finite_inertia(&self, target: Target) -> Result<()> {
        match target {
            Target::BeamMass(element) => self.beam_element(element)?.inertia().map(drop),
            Target::ShellMass(element) => {
                let shell = self.shell_of(&self.shells[element])?;
                shell.inertia().map(drop)
            }
            _ => Ok(()),
        }
    }

    /// The parameters, in the order of their ids.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The parameter of this id.
    pub fn require_parameter(&self, parameter: usize) -> Result<&Parameter> {
        require_id("parameter", "parameter", self.parameters.len(), parameter)?;
        Ok(&self.parameters[parameter])
    }

    /// Whether something other than zero damps in proportion to mass, or may come to do so.
    pub(crate) fn has_mass_damping(&self) -> bool {
        let moves = |p: &Parameter| p.targets.iter().any(|(t, _)| *t == Target::MassDamping);
        self.mass_damping != 0.0 || self.parameters.iter().any(moves)
    }

    /// The same model for a period `ratio` times as long, of which loads and prescribed motions are
    /// the same functions of the phase.
    ///
    /// # Errors
    /// [`ErrorKind::NotPeriodic`], naming it, if a function of the user is one of time, which has a
    /// frequency of its own, or if a parameter is a rate.
    pub(crate) fn stretched(&self, ratio: f64) -> Result<Model> {
        let mut model = self.clone();
        model.require_functions_of_phase()?;
        for place in self.signal_places() {
            if let Some(signal) = model.signal_mut(place) {
                signal.stretch(ratio);
            }
        }
        Ok(model)
    }

    /// The same model over so many of its periods.
    pub(crate) fn repeated(&self, times: usize) -> Model {
        let mut model = self.clone();
        for place in self.signal_places() {
            if let Some(signal) = model.signal_mut(place) {
                signal.repeat(times);
            }
        }
        for force in &mut model.forces {
            if let Some(cycles) = force.cycles_mut() {
                *cycles = cycles.saturating_mul(times);
            }
        }
        model
    }

    /// Checks that the model is one for any period.
    pub(crate) fn require_functions_of_phase(&self) -> Result<()> {
        let refuse = |what: String| {
            let message = format!(
                "{what} has a frequency of its own, where the period is unknown: declare it a \
                 function of the phase"
            );
            Err(Error::new(ErrorKind::NotPeriodic, message))
        };
        for place in self.signal_places() {
            if self.signal(place).is_some_and(Signal::has_own_time) {
                return refuse(format!("the function of {}", describe(place)));
            }
        }
        for (index, force) in self.forces.iter().enumerate() {
            if force.cycles() == Some(0) {
                return refuse(format!("the function of force {index}"));
            }
        }
        let is_rate = |target: &Target| matches!(target, Target::Signal(_, SignalPart::Rate));
        let moves_rate = |p: &&Parameter| p.targets.iter().any(|(t, _)| is_rate(t));
        if let Some(parameter) = self.parameters.iter().find(moves_rate) {
            return refuse(format!("the parameter \"{}\", a rate,", parameter.name));
        }
        Ok(())
    }

    /// Takes a parameter of a file, with all the checks of building.
    pub(super) fn take_parameter(&mut self, parameter: Parameter) -> Result<()> {
        let id = self.add_parameter(&parameter.name, parameter.value, parameter.scale)?;
        for (target, factor) in parameter.targets {
            self.move_by_parameter(id, target, factor)?;
        }
        Ok(())
    }

    /// The places of all signals.
    fn signal_places(&self) -> Vec<SignalPlace> {
        let components = |count: usize| (0..count).flat_map(|load| (0..6).map(move |c| (load, c)));
        let actuators = (0..self.forces.len()).map(SignalPlace::Actuator);
        let prescribed = (0..self.prescribed.len()).map(SignalPlace::Prescribed);
        let loads = components(self.loads.len()).map(|(l, c)| SignalPlace::Load(l, c));
        let along = components(self.distributed_loads.len());
        let along = along.map(|(l, c)| SignalPlace::DistributedLoad(l, c));
        let on_shells = components(self.shell_loads.len());
        let on_shells = on_shells.map(|(l, c)| SignalPlace::ShellLoad(l, c));
        let relations = (0..self.relations.len()).map(SignalPlace::Relation);
        let gravity = (0..3).map(SignalPlace::Gravity).chain(relations);
        let loads = loads.chain(along).chain(on_shells);
        let all = actuators.chain(prescribed).chain(loads);
        all.chain(gravity).collect()
    }

    pub(super) fn signal(&self, place: SignalPlace) -> Option<&Signal> {
        match place {
            SignalPlace::Actuator(force) => match self.forces.get(force)? {
                ForceDefinition::Actuator { signal, .. } => Some(signal),
                _ => None,
            },
            SignalPlace::Prescribed(index) => self.prescribed.get(index).map(|(_, signal)| signal),
            SignalPlace::Load(load, c) => self.loads.get(load)?.components.get(c)?.as_ref(),
            SignalPlace::DistributedLoad(load, c) => {
                let load = self.distributed_loads.get(load)?;
                load.components.get(c)?.as_ref()
            }
            SignalPlace::ShellLoad(load, c) => {
                self.shell_loads.get(load)?.components.get(c)?.as_ref()
            }
            SignalPlace::Gravity(c) => self.gravity.as_ref()?.get(c),
            SignalPlace::Relation(index) => self.relations.get(index).map(|it| &it.signal),
        }
    }

    pub(super) fn signal_mut(&mut self, place: SignalPlace) -> Option<&mut Signal> {
        match place {
            SignalPlace::Actuator(force) => match self.forces.get_mut(force)? {
                ForceDefinition::Actuator { signal, .. } => Some(signal),
                _ => None,
            },
            SignalPlace::Prescribed(index) => {
                self.prescribed.get_mut(index).map(|(_, signal)| signal)
            }
            SignalPlace::Load(load, c) => self.loads.get_mut(load)?.components.get_mut(c)?.as_mut(),
            SignalPlace::DistributedLoad(load, c) => {
                let load = self.distributed_loads.get_mut(load)?;
                load.components.get_mut(c)?.as_mut()
            }
            SignalPlace::ShellLoad(load, c) => {
                let load = self.shell_loads.get_mut(load)?;
                load.components.get_mut(c)?.as_mut()
            }
            SignalPlace::Gravity(c) => self.gravity.as_mut()?.get_mut(c),
            SignalPlace::Relation(index) => self.relations.get_mut(index).map(|it| &mut it.signal),
        }
    }

    /// The number that a target is, if there is one.
    fn number(&mut self, target: Target) -> Option<&mut f64> {
        match target {
            Target::Signal(place, part) => {
                let signal = self.signal_mut(place)?;
                Some(match part {
                    SignalPart::Mean => &mut signal.mean,
                    SignalPart::Rate => &mut signal.rate,
                    SignalPart::Amplitude => &mut signal.amplitude,
                    SignalPart::Phase => &mut signal.phase,
                })
            }
            Target::Stiffness(force, power) => match self.forces.get_mut(force)? {
                ForceDefinition::SpringDamper { stiffness, .. } => {
                    stiffness.get_mut(power.checked_sub(1)?)
                }
                ForceDefinition::Viscoelastic { stiffness, .. } if power == 1 => Some(stiffness),
                ForceDefinition::Bushing(bushing) if power == 1 => Some(&mut bushing.factors[0]),
                _ => None,
            },
            Target::Damping(force, power) => match self.forces.get_mut(force)? {
                ForceDefinition::SpringDamper { damping, .. } => {
                    damping.get_mut(power.checked_sub(1)?)
                }
                ForceDefinition::Bushing(bushing) if power == 1 => Some(&mut bushing.factors[1]),
                _ => None,
            },
            Target::Rest(force) => match self.forces.get_mut(force)? {
                ForceDefinition::SpringDamper { rest, .. }
                | ForceDefinition::Viscoelastic { rest, .. } => Some(rest),
                _ => None,
            },
            Target::Inertia(body) => match self.body_mut(body)? {
                InertiaDefinition::Body { factor, .. } => Some(factor),
                _ => None,
            },
            Target::Spin(body) => match self.body_mut(body)? {
                InertiaDefinition::Body { spin, .. } => Some(&mut spin.as_mut()?.rate),
                _ => None,
            },
            Target::BeamStiffness(element) => Some(&mut self.beams.get_mut(element)?.factors[0]),
            Target::BeamMass(element) => Some(&mut self.beams.get_mut(element)?.factors[1]),
            Target::BeamDamping(element) => Some(&mut self.beams.get_mut(element)?.factors[2]),
            Target::BeamSpin(element) => Some(&mut self.beams.get_mut(element)?.spin),
            Target::ShellStiffness(element) => Some(&mut self.shells.get_mut(element)?.factors[0]),
            Target::ShellMass(element) => Some(&mut self.shells.get_mut(element)?.factors[1]),
            Target::ShellDamping(element) => Some(&mut self.shells.get_mut(element)?.factors[2]),
            Target::ShellThickness(element) => Some(&mut self.shells.get_mut(element)?.thickness),
            Target::MassDamping => Some(&mut self.mass_damping),
            Target::FrameRate => Some(&mut self.turning_frame.as_mut()?.rate),
            Target::FrameAdvance => Some(&mut self.turning_frame.as_mut()?.advance),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Vector3};
    use std::sync::Arc;

    #[test]
    fn what_moves_nothing_or_the_same_twice_is_refused() {
        let mut model = Model::new();
        let body = model.add_rigid_body(1.0, &Vector3::zeros(), &Matrix3::identity());
        body.unwrap();
        let mass = model.add_parameter("mass", 2.0, 1.0).unwrap();
        model
            .move_by_parameter(mass, Target::Inertia(0), 1.5)
            .unwrap();
        assert_eq!(model.mass_and_moment().unwrap().0, 3.0);
        model.set_parameter(mass, 4.0).unwrap();
        assert_eq!(model.mass_and_moment().unwrap().0, 6.0);
        let other = model.add_parameter("other", 1.0, 1.0).unwrap();
        let refuse = |model: &mut Model, target, why: &str| {
            let error = model.move_by_parameter(other, target, 1.0).unwrap_err();
            assert!(error.to_string().contains(why), "{error}");
        };
        refuse(&mut model, Target::Inertia(0), "\"mass\" moves the same");
        refuse(&mut model, Target::Inertia(1), "given, got inertia 1");
        let expected = "a viscoelastic force or a bushing, got force 0";
        refuse(&mut model, Target::Stiffness(0, 1), expected);
        let expected = "target: expected a model that is described in a turning frame, got one";
        refuse(&mut model, Target::FrameRate, expected);
        assert!(model.add_parameter("mass", 0.0, 1.0).is_err());
        assert!(model.add_parameter("scale", 0.0, 0.0).is_err());
        assert!(model.set_parameter(7, 0.0).is_err());
    }

    #[test]
    fn amplitude_and_phase_move_signals_of_any_shape_alike() {
        let function = Arc::new(|tau: f64| Ok(0.5 + tau.cos() + 0.3 * (2.0 * tau).sin()));
        let samples: Vec<f64> = (0..7)
            .map(|k| function(std::f64::consts::TAU * f64::from(k) / 7.0).unwrap())
            .collect();
        let harmonics = Signal::harmonics(0.0, 0.0, &[1.0, 0.0], &[0.0, 0.3]).unwrap();
        let mut all = [
            (harmonics, 0.5),
            (Signal::samples(0.0, &samples).unwrap(), 0.0),
            (Signal::function_of_phase(function), 0.0),
        ];
        let (period, time) = (3.0, 0.7);
        let values = all.each_mut().map(|(signal, mean)| {
            (signal.amplitude, signal.phase) = (2.0, 0.4);
            signal.mean = 2.0 * *mean + 0.25;
            signal.bind(period).value(time).unwrap()
        });
        let tau = std::f64::consts::TAU * time / period + 0.4;
        let exact = 0.25 + 2.0 * (0.5 + tau.cos() + 0.3 * (2.0 * tau).sin());
        for value in values {
            assert!((value - exact).abs() < 1e-14, "{value} {exact}");
        }
    }
}
