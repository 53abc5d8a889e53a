//! What residual, conditions and dependents change with a parameter at fixed unknowns.

use super::Column;
use super::dependents::Found;
use crate::collocation::{Collocation, GridState};
use crate::error::Result;
use crate::model::Model;
use crate::quantity::History;
use crate::solve::conditions::{Conditioned, Free};
use std::sync::Arc;

/// Step of differences, relative to what counts as 1 in a parameter.
const STEP: f64 = 1e-5;
/// The same for the frequency: conditions on values at a time see it as often as this has turned.
const FREQUENCY_STEP: f64 = 2e-6;
/// The same where differences are exact, and only rounding grows with shorter steps.
const LONG_STEP: f64 = 1.0 / 64.0;

/// The equations with all parameters as scalar unknowns: those that are free, and those that are
/// given.
pub(super) struct Explicit {
    equations: Collocation,
    state: GridState,
    residual: Vec<f64>,
    /// Of the motion.
    period: f64,
    /// Equations of the grid, and conditions that hold what is free.
    count: usize,
}

impl Explicit {
    /// At a state, with these values of the parameters, of which so many are free.
    pub fn new(
        mut equations: Collocation,
        (free, parameters): (usize, Conditioned),
        state: &GridState,
        values: &[f64],
    ) -> Result<Self> {
        equations.set_scalars(Arc::new(parameters));
        let mut state = state.clone();
        state.scalars = values.to_vec();
        Ok(Explicit {
            residual: vec![0.0; equations.layout().size()],
            period: equations.grid().period(),
            count: equations.size() + free,
            equations,
            state,
        })
    }

    /// The equations with all parameters as unknowns, and the motion with their values.
    pub fn at(&self) -> (&Collocation, &GridState) {
        (&self.equations, &self.state)
    }

    /// The scaled residual, and that of the conditions behind it.
    pub fn residual(&mut self) -> Result<&[f64]> {
        self.equations.residual(&self.state, &mut self.residual)?;
        Ok(&self.residual[..self.count])
    }

    /// What parameter `index` changes, for what counts as 1 in it.
    pub fn column(
        &mut self,
        model: &Model,
        (index, parameter): (usize, Free),
        found: &Found,
    ) -> Result<Column> {
        let long = match parameter {
            Free::Frequency => false,
            Free::Parameter(id) => model.require_parameter(id)?.is_linear(),
        };
        let scalars = self.equations.layout().scalars();
        let scale = self.equations.column_scale()[scalars.start + index];
        let at = (index, parameter);
        // A long step may lead to impossible values, such as negative masses.
        let longest = match long {
            true => self.differences(at, LONG_STEP, found).ok(),
            false => None,
        };
        let (mut residual, dependents) = match longest {
            Some(found) => found,
            None => self.differences(at, short_step(parameter), found)?,
        };
        if parameter == Free::Frequency {
            self.equations.apply_scalars(&self.state)?;
            let exact = self.equations.by_log_frequency(&self.state)?;
            residual[..exact.len()].copy_from_slice(&exact);
        }
        Ok(Column {
            residual,
            dependents,
            scale,
        })
    }

    /// What free parameter `index` changes of the dependents, for what counts as 1 in it.
    pub fn of_dependents(
        &mut self,
        (index, parameter): (usize, Free),
        found: &Found,
    ) -> Result<Vec<f64>> {
        if !found.depend_on(parameter) {
            return Ok(vec![0.0; found.len()]);
        }
        let step = short_step(parameter);
        Ok(self.differences((index, parameter), step, found)?.1)
    }

    /// Central differences of residual and dependents, for what counts as 1.
    fn differences(
        &mut self,
        (index, parameter): (usize, Free),
        step: f64,
        found: &Found,
    ) -> Result<(Vec<f64>, Vec<f64>)> {
        let scalars = self.equations.layout().scalars();
        let scale = self.equations.column_scale()[scalars.start + index];
        let value = self.state.scalars[index];
        let sides = [1.0, -1.0].map(|sign| {
            self.state.scalars[index] = value + sign * step * scale;
            let residual = self.residual()?.to_vec();
            let history = History::of(&self.equations, &self.state);
            Ok((residual, found.explicit(parameter, &history, self.period)?))
        });
        self.state.scalars[index] = value;
        let [right, left] = sides;
        let (right, left) = (right?, left?);
        let slope = |(a, b): (&f64, &f64)| (a - b) / (2.0 * step);
        let residual = right.0.iter().zip(&left.0).map(slope).collect();
        let mut dependents: Vec<f64> = right.1.iter().zip(&left.1).map(slope).collect();
        if parameter == Free::Frequency {
            self.residual()?;
            let by_phase = found.by_phase(&History::of(&self.equations, &self.state))?;
            dependents
                .iter_mut()
                .zip(&by_phase)
                .for_each(|(x, d)| *x += d);
        }
        Ok((residual, dependents))
    }
}

/// Step of differences where they are not exact.
fn short_step(parameter: Free) -> f64 {
    match parameter {
        Free::Frequency => FREQUENCY_STEP,
        Free::Parameter(_) => STEP,
    }
}
