//! The default initial guess: quasi-static equilibrium, followed once around the period (section 8).

use super::newton::{Iteration, Newton, NewtonOptions, Outcome};
use crate::collocation::{Collocation, GridState};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::system::System;
use std::sync::Arc;

/// Largest increment of a quasi-static solve: its square is the error left.
const TOLERANCE: f64 = 1e-4;
/// A step that needs more iterations than this is halved.
const ITERATION_LIMIT: usize = 12;
/// A step that needs fewer is doubled.
const EASY_ITERATIONS: usize = 5;
/// Steps taken over a period at least: an angle of a turn a period moves 15 degrees.
const LEAST_STEPS: usize = 24;
/// Smallest fraction of a step before giving up.
const SMALLEST_FRACTION: f64 = 1.0 / 1024.0;

/// How the guess ended.
pub(super) struct Guess {
    /// State at the grid points, complete only if `outcome` is [`Outcome::Converged`].
    pub state: GridState,
    /// Whether the guess was found.
    pub outcome: Outcome,
    /// Why not, otherwise.
    pub explanation: String,
}

/// Static equilibrium at one time, tracked from one set of conditions to the next.
struct Tracker<'a> {
    newton: Newton,
    state: GridState,
    observe: &'a mut dyn FnMut(&Iteration) -> bool,
    failure: Option<(Outcome, String)>,
}

impl Tracker<'_> {
    /// Goes from parameter 0 to 1 in adaptive steps, with conditions `(time, load factor)` at each.
    fn follow(&mut self, conditions: impl Fn(f64) -> (f64, f64)) -> Result<bool> {
        let (mut reached, mut step) = (0.0, 1.0f64);
        while reached < 1.0 {
            let next = (reached + step).min(1.0);
            let (time, load_factor) = conditions(next);
            self.newton.equations.set_conditions(time, load_factor)?;
            let mut trial = self.state.clone();
            let options = NewtonOptions {
                tolerance: TOLERANCE,
                iteration_limit: ITERATION_LIMIT,
            };
            let report = self.newton.solve(&mut trial, &options, self.observe);
            let (outcome, taken, explanation) = match report {
                Ok(report) => (report.outcome, report.iterations.len(), report.explanation),
                Err(error) => (Outcome::Stalled, ITERATION_LIMIT, error.to_string()),
            };
            match outcome {
                Outcome::Converged => {
                    self.state = trial;
                    reached = next;
                    if taken <= EASY_ITERATIONS {
                        step *= 2.0;
                    }
                }
                Outcome::Cancelled => {
                    self.failure = Some((outcome, explanation));
                    return Ok(false);
                }
                _ => {
                    step = 0.5 * (next - reached);
                    if step < SMALLEST_FRACTION
                        || (outcome == Outcome::Singular && reached == 0.0 && step < 0.1)
                    {
                        self.failure = Some((outcome, explanation));
                        return Ok(false);
                    }
                }
            }
        }
        Ok(true)
    }
}

/// Quasi-static states at all points of `grid`.
pub(super) fn quasi_static(
    system: &Arc<System>,
    grid: TimeGrid,
    observe: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<Guess> {
    let instant = TimeGrid::new(1, grid.period())?;
    let mut tracker = Tracker {
        newton: Newton::new(Collocation::new(system.clone(), instant)?)?,
        state: GridState::reference(system, instant),
        observe,
        failure: None,
    };
    let mut state = GridState::reference(system, grid);

    // From the unloaded reference configuration to time zero, then from grid point to grid point.
    let mut complete = tracker.follow(|fraction| (0.0, fraction))?;
    let parts = LEAST_STEPS.div_ceil(grid.points());
    for k in 0..grid.points() {
        if !complete {
            break;
        }
        state.copy_point(system, k, &tracker.state, 0);
        let interval = grid.period() / grid.points() as f64;
        for part in 0..if k + 1 < grid.points() { parts } else { 0 } {
            let start = grid.time(k) + interval * part as f64 / parts as f64;
            let length = interval / parts as f64;
            complete = complete && tracker.follow(|fraction| (start + fraction * length, 1.0))?;
        }
    }
    let (outcome, explanation) = tracker
        .failure
        .take()
        .unwrap_or((Outcome::Converged, String::new()));
    Ok(Guess {
        state,
        outcome,
        explanation,
    })
}
