//! How far the motions of a periodic solution are from those that any finer grid would give.

use super::newton::Outcome;
use super::periodic::PeriodicSolve;
use crate::collocation::{Decay, GridState, ResidualBetween, residual_between};
use crate::error::{ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::system::System;
use crate::workers::Workers;

/// What a solution on one grid tells of its error.
#[derive(Debug, Clone, PartialEq)]
pub struct Assessment {
    /// Fall of the harmonics.
    pub decay: Decay,
    /// Residuals half-way between grid points.
    pub between: ResidualBetween,
    /// Estimated error of the motions, positions relative to the characteristic length and entries of rotation
    /// matrices: the larger of the harmonics left out and of the violation of constraints between grid
    /// points.
    pub error: f64,
}

/// Assesses a converged solution on a grid.
///
/// # Errors
/// That of a callback.
pub fn assess(
    system: &System,
    grid: TimeGrid,
    state: &GridState,
    workers: &Workers,
) -> Result<Assessment> {
    let decay = Decay::of(system, grid, state);
    let between = match residual_between(system, grid, state, workers) {
        Ok(between) => between,
        // What cannot be interpolated, or is distorted between points, is no failure of the call.
        Err(e) if matches!(e.kind(), ErrorKind::GridTooCoarse | ErrorKind::Model) => {
            ResidualBetween::unknown()
        }
        Err(e) => return Err(e),
    };
    // A static solution tells nothing of what is driven in time.
    let error = if grid.points() > 1 {
        decay.tail.max(between.constraint)
    } else if varies(system, grid)? {
        f64::INFINITY
    } else {
        0.0
    };
    Ok(Assessment {
        decay,
        between,
        error,
    })
}

impl PeriodicSolve {
    /// Assesses the state where the solve ended: of the best estimate that there is.
    ///
    /// # Errors
    /// That of a callback.
    pub fn assess(&self) -> Result<Assessment> {
        // Without more threads than one it takes longer: no reason to lose the solution.
        let workers = Workers::new(self.threads).unwrap_or_default();
        let mut assessment = assess(&self.system, self.grid, &self.state, &workers)?;
        assessment.error = match (self.report.outcome, self.grids.last()) {
            (Outcome::Converged | Outcome::ToleranceNotMet, Some(tried)) => tried.error_estimate,
            (Outcome::Converged, None) => assessment.error,
            _ => f64::INFINITY,
        };
        Ok(assessment)
    }
}

/// Whether anything drives the system in time.
fn varies(system: &System, grid: TimeGrid) -> Result<bool> {
    if system.calls_functions() {
        // Which may depend on time.
        return Ok(true);
    }
    const SAMPLES: usize = 8;
    let values = |k: usize| -> Result<Vec<f64>> {
        let time = grid.period() * k as f64 / SAMPLES as f64;
        let mut values = vec![0.0; system.signals()];
        system.signal_values(time, 1.0, &mut values)?;
        Ok(values)
    };
    let start = values(0)?;
    for k in 1..SAMPLES {
        if values(k)? != start {
            return Ok(true);
        }
    }
    Ok(false)
}
