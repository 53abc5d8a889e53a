//! How far to trust a solution: decay of its harmonics, and the equations between grid points.

use crate::collocation::{DecayKind, ResidualBetween};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::quantity::require_numbers;
use crate::solve::{Outcome, Solved};
use serde::{Deserialize, Serialize};

/// Error estimates of a solution. Those that cannot be had are infinite; of a march none can.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Diagnostics {
    /// Largest amplitude of each harmonic, from 0, over all nodes: positions relative to the
    /// characteristic length, entries of rotation matrices.
    pub harmonics: Vec<f64>,
    /// Estimated error of the motions at all times, in the same measure: from the decay of
    /// `harmonics`, the violation of constraints between grid points and, if several grids were
    /// tried, the difference to the grid before.
    pub error_estimate: f64,
    /// Estimated error of the motions of nodes by the mesh of beams, at the grid points, in the
    /// same measure: what elements of a higher degree would make of the forces between them. Zero
    /// without beams, infinite unless asked for.
    #[serde(default = "unknown")]
    pub mesh_error: f64,
    /// Residuals between grid points.
    pub between: ResidualBetween,
    /// How the upper half of the harmonics falls.
    #[serde(default)]
    pub decay: DecayKind,
    /// Exponent `p` of that, if it falls as `j⁻ᵖ`.
    #[serde(default)]
    pub decay_order: f64,
    /// Time at which the upper half of the harmonics adds up to most: where a kink or narrow peak
    /// is.
    #[serde(default)]
    pub least_resolved_time: f64,
}

/// What was saved before there was an estimate.
fn unknown() -> f64 {
    f64::INFINITY
}

impl Diagnostics {
    /// Checks what a file says: estimates may be infinite, but not without any value.
    pub(super) fn require_told(&self) -> Result<()> {
        require_finite("harmonics", &self.harmonics)?;
        require_finite("least resolved time", &[self.least_resolved_time])?;
        let ResidualBetween {
            force,
            constraint,
            time,
        } = self.between;
        require_finite("time between grid points", &[time])?;
        let (error, order) = (self.error_estimate, self.decay_order);
        let estimates = [error, self.mesh_error, force, constraint, order];
        if estimates.iter().any(|x| x.is_nan()) {
            let message = "error estimates: one is not a number";
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
        Ok(())
    }

    /// Diagnostics of a solve.
    pub(super) fn of(solve: &Solved) -> Result<Self> {
        let none = |harmonics: usize| Diagnostics {
            harmonics: vec![0.0; harmonics],
            error_estimate: f64::INFINITY,
            mesh_error: f64::INFINITY,
            between: ResidualBetween::unknown(),
            decay: DecayKind::Unknown,
            decay_order: 0.0,
            least_resolved_time: 0.0,
        };
        if solve.march().is_some() {
            return Ok(none(0));
        }
        if solve.report.outcome == Outcome::NoInitialGuess {
            return Ok(none(solve.grid.harmonics() + 1));
        }
        let found = solve.assess()?;
        let known = solve.report.outcome.is_solution();
        match require_numbers("harmonics of the motions", &found.decay.amplitudes) {
            Err(_) if !known => return Ok(none(solve.grid.harmonics() + 1)),
            numbers => numbers?,
        }
        Ok(Diagnostics {
            harmonics: found.decay.amplitudes,
            error_estimate: found.error,
            mesh_error: solve.mesh_error(),
            between: found.between,
            decay: if known {
                found.decay.kind
            } else {
                DecayKind::Unknown
            },
            decay_order: if known { found.decay.order } else { 0.0 },
            least_resolved_time: found.decay.least_resolved,
        })
    }
}
