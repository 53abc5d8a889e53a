//! Ways from equations that are easily solved to those that are asked for, in steps.
//! See docs/theory.md, section 9.5.

use crate::collocation::{Conditions, GridState};
use crate::elements::InertialForces;
use crate::error::Result;
use crate::solve::linear::cost::DirectCost;
use crate::solve::newton::on_grid::{Found, OnGrid};
use crate::solve::report::{NewtonReport, Outcome};
use crate::solve::step_length::StepLength;
use std::f64::consts::TAU;

/// Lengths of the first step and the shortest, of a way of length 1.
const FIRST: f64 = 0.25;
const SHORTEST: f64 = 1.0 / 16.0;
/// The next step after one that succeeded.
const GROWTH: f64 = 1.5;
/// Least and largest number of Newton iterations that a way may take, and multiply-adds of their
/// factorisations.
const ITERATIONS: [usize; 2] = [12, 40];
const WORK: f64 = 2e10;
/// Added damping at the start: what oscillates as often in a period hardly does so any more.
const OSCILLATIONS: f64 = 4.0;
/// Part of it that is taken away at last.
const LAST_DAMPING: f64 = 1e-3;

/// Newton iterations on the present grid that are little work.
fn affordable(on: &OnGrid) -> usize {
    (WORK / DirectCost::of(&on.system, on.grid.points()).work) as usize
}

/// Whether the fewest iterations of one more way to start on the present grid are little work.
pub(crate) fn affords_more(on: &OnGrid) -> bool {
    affordable(on) >= ITERATIONS[0]
}

/// Raises the inertial forces, from a solution without them.
pub(super) fn raised_inertia(on: &mut OnGrid, state: GridState) -> Result<Option<Found>> {
    let conditions = |reached| Conditions {
        inertial: InertialForces {
            factor: reached,
            damping: 0.0,
        },
        ..Conditions::at(0.0)
    };
    in_steps(on, state, FIRST, "of inertial forces", &conditions)
}

/// Takes added damping away, from a solution without inertial forces.
pub(super) fn lowered_damping(on: &mut OnGrid, state: GridState) -> Result<Option<Found>> {
    let most = OSCILLATIONS * TAU / on.grid.period();
    let conditions = |reached: f64| Conditions {
        inertial: InertialForces {
            factor: 1.0,
            damping: if reached < 1.0 {
                most * LAST_DAMPING.powf(reached)
            } else {
                0.0
            },
        },
        ..Conditions::at(0.0)
    };
    in_steps(on, state, 0.0, "of taking away added damping", &conditions)
}

/// Raises loads and prescribed motions, from the reference configuration; `None` where prescribed
/// motions gain something in a period: in part they would not repeat themselves.
pub(super) fn raised_loads(on: &mut OnGrid) -> Result<Option<Found>> {
    if on.system.gains_turns()? {
        return Ok(None);
    }
    let state = GridState::reference(&on.system, on.grid);
    let conditions = |reached| Conditions {
        load_factor: reached,
        ..Conditions::at(0.0)
    };
    in_steps(on, state, FIRST, "of loads", &conditions)
}

/// Solves the equations under conditions that become those asked for as their argument becomes 1;
/// at first it is `first`. What is left undone is told of as a fraction of `what`.
fn in_steps(
    on: &mut OnGrid,
    mut state: GridState,
    first: f64,
    what: &str,
    conditions: &dyn Fn(f64) -> Conditions,
) -> Result<Option<Found>> {
    let mut reached = None;
    let mut step = StepLength::halved(FIRST, SHORTEST..=1.0);
    let before = on.newton.iterations;
    let most = affordable(on).clamp(ITERATIONS[0], ITERATIONS[1]);
    let mut found = None;
    while reached != Some(1.0) {
        let next = match reached {
            Some(reached) => f64::min(reached + step.get(), 1.0),
            None => first.min(step.get()),
        };
        let mut goes_on = true;
        on.newton.equations.set_conditions(conditions(next))?;
        let (trial, report) = on.solve(state.clone())?;
        match report.outcome {
            Outcome::Converged => {
                state = trial;
                if next > 0.0 {
                    step.grow(step.get(), GROWTH);
                }
                reached = Some(next);
                found = Some((state.clone(), report));
            }
            outcome if outcome.is_stopped() => {
                found = Some((trial, report));
                break;
            }
            _ => goes_on = next > 0.0 && step.shrink(step.get()),
        }
        let spent = on.newton.iterations - before;
        if reached != Some(1.0) && (!goes_on || spent > most) {
            let why = format!("ended at the fraction {:.3} {what}", reached.unwrap_or(0.0));
            let report = NewtonReport::ended(Outcome::Stalled, why);
            found = Some((state, report));
            break;
        }
    }
    on.newton.equations.set_conditions(Conditions::at(0.0))?;
    Ok(found)
}
