//! The equation of an event: [`Singular`], or [`Turning`] for folds under conditions.

use super::Event;
use super::singular::Singular;
use super::turning::Turning;
use super::walk::Walk;
use crate::collocation::GridState;
use crate::error::Result;
use crate::solve::modes::pencil::C64;

/// What is zero at an event, and complex at torus points.
pub(super) enum EventEquation {
    Singular(Box<Singular>),
    Turning(Box<Turning>),
}

impl EventEquation {
    /// That of an event near `state`, where the equations of `walk` have its free parameters; none
    /// if they cannot be factored there.
    pub fn new(
        event: Event,
        frequency: f64,
        walk: &Walk,
        state: &GridState,
    ) -> Result<Option<Self>> {
        let equations = &walk.newton.equations;
        if event == Event::Fold && !walk.options.conditions.is_empty() {
            return Ok(Some(Self::Turning(Box::new(Turning::new(equations)))));
        }
        let singular = Singular::new(event, frequency, equations, state)?;
        Ok(singular.map(|singular| Self::Singular(Box::new(singular))))
    }

    pub fn event(&self) -> Event {
        match self {
            Self::Singular(singular) => singular.event,
            Self::Turning(_) => Event::Fold,
        }
    }

    /// `ω` of [`Singular`].
    pub fn frequency(&self) -> f64 {
        match self {
            Self::Singular(singular) => singular.frequency,
            Self::Turning(_) => 0.0,
        }
    }

    pub fn set_frequency(&mut self, frequency: f64) {
        if let Self::Singular(singular) = self {
            singular.frequency = frequency;
        }
    }

    /// Takes what it has found to tell it better apart at points nearby. `false` if that is none.
    pub fn renew(&mut self) -> Result<bool> {
        match self {
            Self::Singular(singular) => singular.renew(),
            Self::Turning(_) => Ok(true),
        }
    }

    /// Its value at `state`, where the equations of `walk` are linearised along these directions of
    /// solutions; none if it cannot be found.
    pub fn value(
        &mut self,
        walk: &Walk,
        state: &GridState,
        directions: &[Vec<f64>],
    ) -> Result<Option<C64>> {
        match self {
            Self::Singular(singular) => singular.value(state),
            Self::Turning(turning) => Ok(Some(C64::from(turning.value(walk, directions)))),
        }
    }

    /// Derivative of that in a direction of all unknowns, not scaled and of the length `size`.
    pub fn along(
        &mut self,
        walk: &mut Walk,
        state: &GridState,
        (direction, size): (&[f64], f64),
    ) -> Result<Option<C64>> {
        match self {
            Self::Singular(singular) => singular.along(state, direction, size).map(Some),
            Self::Turning(turning) => {
                let found = turning.along(walk, state, (direction, size))?;
                Ok(found.map(C64::from))
            }
        }
    }

    /// Derivative of that by `ω`, where that is unknown, too.
    pub fn by_frequency(&self) -> Option<C64> {
        match self {
            Self::Singular(singular) if singular.is_complex() => Some(singular.by_frequency()),
            _ => None,
        }
    }

    /// The direction of motions that meets no resistance, not scaled, if it is known.
    pub fn direction(&self) -> Option<Vec<f64>> {
        match self {
            Self::Singular(singular) => Some(singular.direction()),
            Self::Turning(_) => None,
        }
    }
}
