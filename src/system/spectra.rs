//! Harmonics of the signals that drive a system.

use super::System;
use crate::error::Result;
use crate::fourier::{PeriodicSeries, TimeGrid};
use crate::model::BoundSignal;

impl System {
    /// The harmonics of all signals: those of functions, of their values at `points` (odd) times.
    ///
    /// # Errors
    /// Those of functions.
    pub fn spectra(&self, points: usize) -> Result<Vec<PeriodicSeries>> {
        let grid = TimeGrid::new(points, self.period)?;
        let spectrum = |signal: &BoundSignal| -> Result<PeriodicSeries> {
            match signal {
                BoundSignal::Series(series) => Ok(series.clone()),
                BoundSignal::Function { .. } => {
                    let values = grid.times().map(|time| signal.value(time));
                    let rate = signal.growth()? / self.period;
                    let values = values.collect::<Result<Vec<f64>>>()?;
                    Ok(PeriodicSeries::interpolate(grid, &values, rate))
                }
            }
        };
        let found = self
            .signals
            .iter()
            .map(|driven| spectrum(&driven.signal).map_err(|e| e.within(&driven.place)));
        found.collect()
    }

    /// What a signal drives, for messages.
    pub fn signal_place(&self, signal: usize) -> &str {
        &self.signals[signal].place
    }
}
