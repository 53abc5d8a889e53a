//! Strongly dissipative marching by backward differences (Houbolt's rule, spectral radius zero at
//! infinity), from rest until the motion nearly repeats. It serves as an initial guess only.

use super::newton::{Iteration, Newton, NewtonOptions, Outcome};
use crate::collocation::{BackwardRule, Collocation, GridState};
use crate::error::{ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::system::System;
use std::collections::VecDeque;
use std::sync::Arc;

/// Steps over a period at least.
const LEAST_STEPS: usize = 96;
/// Times that the number of steps is doubled before giving up.
const REFINEMENTS: usize = 3;
/// Most periods.
const MOST_PERIODS: usize = 24;
/// Two periods alike to this (relative to the characteristic length, or in radians) end the march.
const REPEATED: f64 = 1e-3;

const NEWTON: NewtonOptions = NewtonOptions {
    tolerance: 1e-6,
    iteration_limit: 20,
};

/// Houbolt's weights for steps of `h`: cubic through four motions.
fn houbolt(h: f64) -> BackwardRule {
    let scaled = |weights: [f64; 4], by: f64| weights.map(|w| w / by);
    BackwardRule {
        first: scaled([11.0 / 6.0, -3.0, 1.5, -1.0 / 3.0], h),
        second: scaled([2.0, -5.0, 4.0, -1.0], h * h),
    }
}

/// How a march ended: states over the last period, or why there are none.
pub(super) type March = std::result::Result<GridState, (Outcome, String)>;

/// Marches from rest in the reference configuration and returns the states at the grid points of the
/// last period.
pub(super) fn march_to_periodic(
    system: &Arc<System>,
    grid: TimeGrid,
    observe: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<March> {
    let mut parts = LEAST_STEPS.div_ceil(grid.points());
    let mut last = march(system, grid, parts, observe)?;
    for _ in 0..REFINEMENTS {
        match &last {
            Err((Outcome::Stalled | Outcome::IterationLimit | Outcome::WrongAssembly, _)) => {
                parts *= 2
            }
            _ => break,
        }
        last = march(system, grid, parts, observe)?;
    }
    Ok(last)
}

/// One march, with `parts` steps to a grid interval.
fn march(
    system: &Arc<System>,
    grid: TimeGrid,
    parts: usize,
    observe: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<March> {
    let instant = TimeGrid::new(1, grid.period())?;
    let mut newton = Newton::new(Collocation::new(system.clone(), instant)?);
    let rest = GridState::reference(system, instant);
    let mut past: VecDeque<GridState> = std::iter::repeat_n(rest, 3).collect();
    let step = grid.period() / (grid.points() * parts) as f64;
    let rule = houbolt(step);
    let mut before: Option<GridState> = None;
    for _ in 0..MOST_PERIODS {
        let mut state = GridState::reference(system, grid);
        for k in 0..grid.points() {
            for part in 0..parts {
                newton
                    .equations
                    .set_conditions(grid.time(k) + step * part as f64, 1.0)?;
                newton
                    .equations
                    .set_past(rule, past.iter().cloned().collect());
                let mut next = past[0].clone();
                let report = match newton.solve(&mut next, &NEWTON, observe) {
                    Ok(report) => report,
                    Err(error) if error.kind() == ErrorKind::Callback => return Err(error),
                    Err(error) => return Ok(Err((Outcome::Stalled, error.to_string()))),
                };
                if report.outcome != Outcome::Converged {
                    return Ok(Err((report.outcome, report.explanation)));
                }
                past.pop_back();
                past.push_front(next);
                if part == 0 {
                    state.copy_point(system, k, &past[0], 0);
                }
            }
        }
        let repeats = before.is_some_and(|b| b.distance(&state, system.scales().length) < REPEATED);
        if repeats {
            return Ok(Ok(state));
        }
        before = Some(state);
    }
    // Not periodic yet, as for light damping: still the best that there is.
    Ok(before.ok_or((Outcome::Stalled, String::new())))
}
