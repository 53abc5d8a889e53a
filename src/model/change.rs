//! Changes of what a model holds.

use super::target::no_such_signal;
use super::validation::{require_elements, require_positive};
use super::{ForceDefinition, ForceNumber, Model, SectionInput, Signal, SignalPlace, Target};
use crate::error::{Error, ErrorKind, Result};
use nalgebra::Matrix6;

impl Model {
    /// Gives a place of the model that has a signal another one. Parts of it that parameters move
    /// have the parameters' values again.
    ///
    /// # Errors
    /// If there is no such signal.
    pub fn set_signal(&mut self, place: SignalPlace, signal: &Signal) -> Result<()> {
        let old = self
            .signal_mut(place)
            .ok_or_else(|| no_such_signal(place))?;
        *old = signal.clone();
        self.move_signal_again(place)
    }

    /// Gives the numbers of a sort of a force other values, as many as it has.
    ///
    /// # Errors
    /// If there are not as many, a parameter moves one of them, or such a force cannot be.
    pub fn set_force_numbers(
        &mut self,
        force: usize,
        which: ForceNumber,
        values: &[f64],
    ) -> Result<()> {
        let count = self.require_force("force", force)?.numbers(which).len();
        if values.len() != count || count == 0 {
            let expected = format!("{count}, which the force has");
            return Err(Error::size("count", expected, values.len()));
        }
        self.require_not_moved(force, which)?;
        let mut changed = self.forces[force].clone();
        changed.set_numbers(which, values);
        if let ForceDefinition::ViscousDamper { matrix, .. } = &mut changed {
            **matrix = require_positive("values", matrix, false)?;
        }
        self.require_force_definition(&changed)?;
        self.forces[force] = changed;
        Ok(())
    }

    fn require_not_moved(&self, force: usize, which: ForceNumber) -> Result<()> {
        let moves = |target: &Target| match (target, which) {
            (Target::Stiffness(other, _), ForceNumber::Stiffness)
            | (Target::Damping(other, _), ForceNumber::Damping) => *other == force,
            _ => false,
        };
        let mut parameters = self.parameters.iter();
        match parameters.find(|p| p.targets.iter().any(|(target, _)| moves(target))) {
            None => Ok(()),
            Some(parameter) => {
                let message = format!(
                    "number: the parameter \"{}\" moves such a number of the force: set that",
                    parameter.name
                );
                Err(Error::new(ErrorKind::Value, message))
            }
        }
    }

    /// Gives beam elements another section, the same all along them; their twist stays.
    ///
    /// # Errors
    /// If there are no such elements, the section cannot be, or has mass where theirs has none, or
    /// none where theirs has.
    pub fn set_beam_section(
        &mut self,
        first_element: usize,
        elements: usize,
        section: &SectionInput,
    ) -> Result<()> {
        let count = self.beams.len();
        require_elements("beam element", count, (first_element, elements))?;
        let section = section.validated()?;
        let changed = (first_element..first_element + elements).map(|element| {
            let mut beam = self.beams[element].clone();
            let had_mass = self.element_of(&beam)?.has_mass();
            beam.sections = beam.sections.with_section(section);
            beam.sections.scaled(&beam.factors).validate()?;
            let made = self.element_of(&beam)?;
            if made.has_mass() != had_mass {
                let [with, without] = ["with mass", "without mass"];
                let (expected, got) = if had_mass {
                    (with, without)
                } else {
                    (without, with)
                };
                let expected = format!("a section {expected}, as that of element {element}");
                return Err(Error::value("section", expected, format!("one {got}")));
            }
            if had_mass {
                made.inertia()?;
            }
            Ok(beam)
        });
        let changed = changed.collect::<Result<Vec<_>>>()?;
        for (beam, changed) in self.beams[first_element..].iter_mut().zip(changed) {
            *beam = changed;
        }
        Ok(())
    }
}

impl ForceDefinition {
    /// Sets as many numbers of a sort as it has.
    fn set_numbers(&mut self, which: ForceNumber, values: &[f64]) {
        use ForceNumber::{Damping, RelaxationTime, Stiffness};
        let matrix = || Matrix6::from_column_slice(values);
        match (self, which) {
            (ForceDefinition::SpringDamper { stiffness, .. }, Stiffness) => {
                stiffness.copy_from_slice(values);
            }
            (ForceDefinition::SpringDamper { damping, .. }, Damping) => {
                damping.copy_from_slice(values);
            }
            (
                ForceDefinition::Viscoelastic {
                    stiffness,
                    branches,
                    ..
                },
                Stiffness,
            ) => {
                let all = std::iter::once(stiffness);
                let all = all.chain(branches.iter_mut().map(|branch| &mut branch.stiffness));
                all.zip(values).for_each(|(number, value)| *number = *value);
            }
            (ForceDefinition::Viscoelastic { branches, .. }, RelaxationTime) => {
                let all = branches.iter_mut().zip(values);
                all.for_each(|(branch, value)| branch.relaxation_time = *value);
            }
            (ForceDefinition::ViscousDamper { matrix: old, .. }, Damping) => **old = matrix(),
            (ForceDefinition::Bushing(bushing), Stiffness) => bushing.stiffness = matrix(),
            (ForceDefinition::Bushing(bushing), Damping) => bushing.damping = matrix(),
            _ => {}
        }
    }
}
