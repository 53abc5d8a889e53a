//! Changes of what a model holds.

use super::inertia::InertiaDefinition;
use super::target::no_such_signal;
use super::validation::{require_elements, require_positive};
use super::{ForceDefinition, ForceNumber, Model, SectionInput, Signal, SignalPlace, Target};
use crate::elements::{BeamLoadFrame, LoadFrame, ShellSection};
use crate::error::{Error, ErrorKind, Result, require_id};
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
            | (Target::Damping(other, _), ForceNumber::Damping)
            | (Target::Rest(other), ForceNumber::Rest) => *other == force,
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

    /// Gives a load at a point another frame.
    ///
    /// # Errors
    /// If there is no such load.
    pub fn set_load_frame(&mut self, load: usize, frame: LoadFrame) -> Result<()> {
        require_id("load", "load", self.loads.len(), load)?;
        self.loads[load].frame = frame;
        Ok(())
    }

    /// Gives a load along beam elements another frame.
    ///
    /// # Errors
    /// If there is no such load, or its frame cannot be.
    pub fn set_beam_load_frame(&mut self, load: usize, frame: BeamLoadFrame) -> Result<()> {
        require_id("load", "beam load", self.distributed_loads.len(), load)?;
        let mut changed = self.distributed_loads[load].clone();
        changed.frame = frame;
        self.require_load(&changed)?;
        self.distributed_loads[load] = changed;
        Ok(())
    }

    /// Gives a load on shell elements another frame.
    ///
    /// # Errors
    /// If there is no such load.
    pub fn set_shell_load_frame(&mut self, load: usize, frame: LoadFrame) -> Result<()> {
        require_id("load", "shell load", self.shell_loads.len(), load)?;
        self.shell_loads[load].frame = frame;
        Ok(())
    }

    /// Gives beam elements another section, the same all along them; their twist stays.
    ///
    /// # Errors
    /// If there are no such elements, the section cannot be, or has mass where theirs has none, or
    /// none where theirs has, or is not symmetric about the axis that theirs spins about.
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
            require_as_massive(element, had_mass, made.has_mass())?;
            if had_mass {
                made.inertia()?;
            }
            if beam.spin != 0.0 {
                self.require_can_spin(&beam)?;
            }
            Ok(beam)
        });
        let changed = changed.collect::<Result<Vec<_>>>()?;
        for (beam, changed) in self.beams[first_element..].iter_mut().zip(changed) {
            *beam = changed;
        }
        Ok(())
    }

    /// Gives shell elements another section; their frames, and the direction of its axes, stay.
    ///
    /// # Errors
    /// If there are no such elements, the section cannot be, or has mass where theirs has none, or
    /// none where theirs has.
    pub fn set_shell_section(
        &mut self,
        first_element: usize,
        elements: usize,
        section: &ShellSection,
    ) -> Result<()> {
        let count = self.shells.len();
        require_elements("shell element", count, (first_element, elements))?;
        let section = section.validated()?;
        let has_mass = |section: &ShellSection| section.mass != Matrix6::zeros();
        let changed = (first_element..first_element + elements).map(|element| {
            let mut shell = self.shells[element].clone();
            require_as_massive(element, has_mass(&shell.section), has_mass(&section))?;
            shell.section = section;
            let made = self.shell_of(&shell)?;
            if has_mass(&section) {
                made.inertia()?;
            }
            Ok(shell)
        });
        let changed = changed.collect::<Result<Vec<_>>>()?;
        for (shell, changed) in self.shells[first_element..].iter_mut().zip(changed) {
            *shell = changed;
        }
        Ok(())
    }

    /// Gives a body, mass or inertia another 6×6 inertia about its node, along its axes; the factor
    /// of a parameter stays.
    ///
    /// # Errors
    /// If there is no such inertia, the matrix is none of a body, or the body spins about an axis
    /// that it would not be symmetric about.
    pub fn set_inertia(&mut self, inertia: usize, matrix: &Matrix6<f64>) -> Result<()> {
        require_id("inertia", "inertia", self.inertia_count(), inertia)?;
        let changed = require_positive("matrix", matrix, false)?;
        if let Some(InertiaDefinition::Body {
            matrix,
            factor,
            spin,
            ..
        }) = self.body_mut(inertia)
        {
            if let Some(spin) = spin {
                spin.require_fits(&changed, *factor)?;
            }
            **matrix = changed;
        }
        Ok(())
    }
}

/// Whether there is mass is the same as before.
fn require_as_massive(element: usize, had_mass: bool, has_mass: bool) -> Result<()> {
    if had_mass == has_mass {
        return Ok(());
    }
    let name = |it| if it { "with mass" } else { "without mass" };
    let expected = format!("a section {}, as that of element {element}", name(had_mass));
    Err(Error::value(
        "section",
        expected,
        format!("one {}", name(has_mass)),
    ))
}

impl ForceDefinition {
    /// Sets as many numbers of a sort as it has.
    fn set_numbers(&mut self, which: ForceNumber, values: &[f64]) {
        use ForceNumber::{Damping, RelaxationTime, Rest, Stiffness};
        let matrix = || Matrix6::from_column_slice(values);
        match (self, which) {
            (ForceDefinition::SpringDamper { stiffness, .. }, Stiffness) => {
                stiffness.copy_from_slice(values);
            }
            (ForceDefinition::SpringDamper { damping, .. }, Damping) => {
                damping.copy_from_slice(values);
            }
            (
                ForceDefinition::SpringDamper { rest, .. }
                | ForceDefinition::Viscoelastic { rest, .. },
                Rest,
            ) => values.iter().for_each(|value| *rest = *value),
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
