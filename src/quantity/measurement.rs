//! Numbers that a motion has: features of one component of a quantity.

use super::{Dependence, Feature, History, Probe, Quantity, Variation};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{PeriodicSeries, TimeGrid};
use crate::system::System;
use std::fmt;

/// A feature of one component of a quantity, found in a system.
#[derive(Debug)]
pub struct Measurement {
    quantity: Quantity,
    component: usize,
    feature: Feature,
    probe: Box<dyn Probe>,
}

impl Measurement {
    /// Of a quantity in a system.
    ///
    /// # Errors
    /// If it is not there, or has no such component.
    pub fn new(
        quantity: Quantity,
        component: usize,
        feature: Feature,
        system: &System,
    ) -> Result<Self> {
        quantity.require_component(component)?;
        Ok(Measurement {
            quantity,
            component,
            feature,
            probe: quantity.probe(system)?,
        })
    }

    /// What it depends on besides the unknowns of the grid.
    pub fn dependence(&self) -> Dependence {
        let of_quantity = self.probe.dependence();
        match (of_quantity, self.feature) {
            // A time is another phase of another period, but the start.
            (Dependence::Nothing, Feature::At(time)) if time != 0.0 => Dependence::Period,
            _ => of_quantity,
        }
    }

    /// Its value.
    ///
    /// # Errors
    /// If it cannot be evaluated there, or of a trajectory.
    pub fn value(&self, history: &History) -> Result<f64> {
        Ok(self.feature.of(&self.series(history)?))
    }

    /// Its value where a time means the phase that it is in another period.
    ///
    /// # Errors
    /// As [`Measurement::value`].
    pub fn value_at_phase(&self, history: &History, period: f64) -> Result<f64> {
        let series = self.series(history)?;
        let feature = match self.feature {
            Feature::At(time) => Feature::At(time * series.period() / period),
            feature => feature,
        };
        Ok(feature.of(&series))
    }

    /// What it varies by with the logarithm of the frequency as its time is another phase then.
    ///
    /// # Errors
    /// As [`Measurement::value`].
    pub fn by_phase(&self, history: &History) -> Result<f64> {
        match self.feature {
            Feature::At(time) => Ok(time * self.series(history)?.derivative(time, 1)),
            _ => Ok(0.0),
        }
    }

    /// The series that it is a feature of.
    ///
    /// # Errors
    /// As [`Measurement::value`].
    pub fn series(&self, history: &History) -> Result<PeriodicSeries> {
        let grid = self.grid(history)?;
        let samples = self.probe.samples(history)?.component(self.component);
        let series = samples.series(grid, None).pop();
        series.ok_or_else(|| Error::value("component", "one of the quantity", self.component))
    }

    /// Adds `factor` times what it varies by.
    ///
    /// # Errors
    /// As [`Measurement::value`].
    pub fn vary(&self, history: &History, factor: f64, out: &mut Variation) -> Result<()> {
        let grid = self.grid(history)?;
        let samples = self.probe.samples(history)?;
        let weights = self.feature.weights(grid, samples.order)?;
        for (k, weight) in weights.into_iter().enumerate().filter(|(_, w)| *w != 0.0) {
            let at = (self.component, k);
            self.probe
                .vary(history, at, &samples, factor * weight, out)?;
        }
        Ok(())
    }

    /// Adds its derivatives by the unknowns of the grid, which are not scaled, to the row of an
    /// equation, at a state whose kinematics `equations` have evaluated last.
    ///
    /// # Errors
    /// As [`Measurement::value`].
    pub fn add_gradient(
        &self,
        equations: &Collocation,
        state: &GridState,
        row: &mut [f64],
    ) -> Result<()> {
        let mut variation = Variation::new(equations.system(), state.points());
        self.vary(&History::of(equations, state), 1.0, &mut variation)?;
        variation.add_to_row(equations, row);
        Ok(())
    }

    fn grid(&self, history: &History) -> Result<TimeGrid> {
        let grid = history.grid.ok_or_else(|| {
            let message = "a trajectory has no harmonics; solve for the periodic response from it";
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        self.feature.require_on(grid)?;
        Ok(grid)
    }
}

impl fmt::Display for Measurement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.quantity.describe(self.component);
        write!(f, "{} of {name}", self.feature)
    }
}
