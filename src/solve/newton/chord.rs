//! Further steps with the same matrix (docs/theory.md, section 7.4).
//!
//! After a full step the simplified increment is the next one, up to a part of the order of the
//! last increment: if what that leaves is small enough, there is no need to factor again.

use super::run::{Run, Step};
use super::verdict::Ending;
use crate::collocation::{CarriedResultants, GridState};
use crate::error::Result;
use crate::solve::linear::dense::largest;
use crate::solve::linear::solver::{COARSE, LinearSolver};
use crate::solve::newton::ERROR_LEFT;
use crate::solve::report::{Iteration, Outcome, timed};
use std::ops::ControlFlow;

/// The same matrix is used again while it is expected to end the iteration within so many steps.
pub(super) const STEPS: i32 = 3;
/// Largest contraction, from one increment to the next with the same matrix, that is worth another.
const CONTRACTION: f64 = 0.4;
/// Changes of own unknowns that shrink no more than by this factor, once they are small, are
/// rounding.
const STANDS: f64 = 0.5;
/// What is small.
const SMALL: f64 = 1e-5;

/// What to do with a simplified increment.
#[derive(Debug, PartialEq, Eq)]
enum Next {
    /// Take it, and see what the next one is.
    Step,
    /// Take it; what it leaves is small enough.
    Last,
    /// Factor again.
    Factor,
}

/// What a simplified increment is judged by.
struct Judge {
    tolerance: f64,
    /// Steps within which it is to end.
    steps: i32,
    /// Size of the increment that the matrix was factored for.
    first: f64,
    /// Whether own unknowns are to converge, too.
    with_own: bool,
    /// Error of simplified increments, relative to their size.
    accuracy: f64,
}

impl Judge {
    /// Whether steps that contract by the size of the first increment would end.
    fn hopes(&self) -> bool {
        self.first.powi(self.steps + 2) <= self.tolerance
    }

    /// Of a simplified increment after another, each with its size and the change of own unknowns,
    /// relative to them.
    fn next(&self, (before, changed): (f64, f64), (size, change): (f64, f64)) -> Next {
        let contraction = size / before;
        let contracts = contraction <= CONTRACTION;
        let part = contraction.max(self.accuracy);
        let most = ERROR_LEFT * self.tolerance;
        let is_rounding = changed <= SMALL && change > STANDS * changed;
        let leaves_little = part * size <= most && (part * change <= most || is_rounding);
        let ends = size.max(self.first * change) <= self.tolerance
            && (!self.with_own || !contracts || leaves_little);
        if ends {
            return Next::Last;
        }
        let expected = size * contraction.powi(self.steps);
        // Written so that NaN does not go on.
        match contracts && expected <= self.tolerance {
            true => Next::Step,
            false => Next::Factor,
        }
    }
}

impl<L: LinearSolver> Run<'_, L> {
    /// Takes steps by the simplified increments that follow the full step from `start`, whose own
    /// simplified one is in `increment`. Together they count as an iteration.
    pub fn chord_steps(&mut self, start: GridState, step: Step) -> Result<ControlFlow<Ending>> {
        let first = step.size;
        let mut judge = Judge {
            tolerance: self.options.tolerance,
            steps: self.newton.chords,
            with_own: self.with_multipliers,
            first,
            accuracy: self
                .newton
                .linear
                .error_of(self.accuracy_of_simplified(first)),
        };
        let is_with_resultants = step.path.is_some();
        let mut carried = self.carried(&judge, start, step)?;
        if is_with_resultants && carried.is_none() {
            return Ok(ControlFlow::Continue(()));
        }
        let (mut before, mut size) = (first, self.newton.norm(&self.increment));
        let mut changed = f64::INFINITY;
        self.newton.contraction = Some(size / before);
        if self.iterations.len() == self.options.iteration_limit {
            return Ok(ControlFlow::Continue(()));
        }
        let residual = largest(&self.residual);
        let (mut taken, mut ends) = (None, false);
        while !ends && !self.left().is_contradicted() {
            let change = self.change_that_counts();
            ends = match judge.next((before, changed), (size, change)) {
                Next::Factor => {
                    // Stretching may be what hides progress.
                    self.newton.stretches |= self.may_stretch(&judge);
                    break;
                }
                next => next == Next::Last,
            };
            changed = change;
            let change = self.newton.equations.unscaled(&self.increment, -1.0);
            let trial = self.newton.equations.stepped(self.state, &change, 1.0);
            let expected = size * size / before;
            before = size;
            if !ends {
                let accuracy = self.accuracy_after(expected);
                judge.accuracy = self.newton.linear.error_of(accuracy);
                if !self.simplify_after(&trial, &change, &mut carried, accuracy)? {
                    break;
                }
                size = self.newton.norm(&self.increment);
                // Written so that NaN ends it too.
                let nearer = size < before;
                if !nearer {
                    self.newton.stretches |= self.may_stretch(&judge);
                    break;
                }
                self.residual.copy_from_slice(&self.trial_residual);
                if let Some(carried) = &carried {
                    let resultants = carried.resultants().to_vec();
                    self.newton.equations.set_resultants(resultants);
                }
            }
            *self.state = trial;
            taken = Some(before);
        }
        let Some(increment) = taken else {
            return Ok(ControlFlow::Continue(()));
        };
        let goes_on = self.record(Iteration {
            number: self.iterations.len() + 1,
            residual,
            increment,
            step: 1.0,
        });
        Ok(match (ends, goes_on) {
            (true, _) => ControlFlow::Break(Ending::plain(Outcome::Converged)),
            (false, true) => ControlFlow::Continue(()),
            (false, false) => ControlFlow::Break(Ending::plain(Outcome::Cancelled)),
        })
    }

    /// Change of own unknowns by the increment, if they are to converge.
    fn change_that_counts(&self) -> f64 {
        match self.with_multipliers {
            true => self.change_of_own(),
            false => 0.0,
        }
    }

    /// Whether it may be stretching that hides progress, next to where the last solve ended.
    fn may_stretch(&self, judge: &Judge) -> bool {
        self.newton.trusts && self.newton.equations.has_stations() && judge.hopes()
    }

    /// Whether stress resultants may be unknowns of their own, to some purpose: by solutions that
    /// are not accurate they are off by more than motions, as axial stiffness is large.
    fn may_carry(&self, judge: &Judge) -> bool {
        self.may_stretch(judge) && self.is_accurate(COARSE)
    }

    /// Stress resultants as unknowns of their own, where the simplified increment is that with
    /// them, or where only that one is worth a step: then it takes the place of the other.
    fn carried(
        &mut self,
        judge: &Judge,
        start: GridState,
        step: Step,
    ) -> Result<Option<CarriedResultants>> {
        let Step {
            size: first,
            increment,
            path,
        } = step;
        let is_found = path.is_some();
        if !self.may_carry(judge) {
            return Ok(None);
        }
        if !is_found {
            let simplified = (self.newton.norm(&self.increment), self.change_that_counts());
            if judge.next((first, f64::INFINITY), simplified) != Next::Factor {
                return Ok(None);
            }
        }
        let equations = &mut self.newton.equations;
        let way = (&start, increment, &*self.state);
        let Ok(mut carried) = equations.carry_resultants(path, way) else {
            return Ok(None);
        };
        let mut rows = self.residual.clone();
        if equations.part_carried(&mut carried, &mut rows).is_err() {
            return Ok(None);
        }
        if !is_found {
            let accuracy = self.accuracy_of_simplified(first);
            if !self.newton.solve_linear(&mut rows, accuracy)? {
                return Ok(None);
            }
            self.newton.stretches = true;
            self.increment = rows;
        }
        Ok(Some(carried))
    }

    /// Writes the simplified increment at `trial`, after another one that is not scaled. `false` if
    /// there is none.
    fn simplify_after(
        &mut self,
        trial: &GridState,
        change: &[f64],
        carried: &mut Option<CarriedResultants>,
        accuracy: f64,
    ) -> Result<bool> {
        if !self.evaluate(trial)? {
            return Ok(false);
        }
        self.increment.copy_from_slice(&self.trial_residual);
        if let Some(carried) = carried {
            let (equations, rows) = (&mut self.newton.equations, &mut self.increment);
            let parted = timed(&mut self.newton.timings.assembly, || {
                equations.step_carried(carried, change)?;
                equations.part_carried(carried, rows)
            });
            if parted.is_err() {
                return Ok(false);
            }
        }
        self.newton.solve_linear(&mut self.increment, accuracy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const JUDGE: Judge = Judge {
        tolerance: 1e-8,
        steps: STEPS,
        first: 1e-2,
        with_own: true,
        accuracy: 1e-4,
    };

    /// Of an increment after one that changed own unknowns much.
    fn of(before: f64, size: f64, change: f64) -> Next {
        JUDGE.next((before, 1.0), (size, change))
    }

    #[test]
    fn steps_go_on_while_they_are_expected_to_end_soon() {
        assert_eq!(of(1e-2, 1e-3, 0.0), Next::Factor);
        assert_eq!(of(1e-2, 1e-4, 0.0), Next::Step);
        assert_eq!(of(1e-4, 1e-6, 0.0), Next::Step);
        // 4e-8 · 0.45³ is less than the tolerance, but increments hardly shrink.
        assert_eq!(of(9e-8, 4e-8, 0.0), Next::Factor);
    }

    #[test]
    fn the_last_leaves_little_of_motions_and_of_own_unknowns() {
        assert_eq!(of(1e-6, 1e-10, 0.0), Next::Last);
        // What a small increment leaves counts, too, where the next is to be much smaller,
        assert_eq!(of(1e-7, 9e-9, 0.0), Next::Step);
        // and what it changes in own unknowns, which motions of the first increment turn.
        assert_eq!(of(1e-6, 1e-10, 1e-3), Next::Step);
        // and what inaccurate linear solutions leave, however well they contract.
        assert_eq!(of(1.0, 5e-9, 2e-7), Next::Step);
        assert_eq!(of(1.0, 5e-9, 5e-8), Next::Last);
        // What no longer shrinks is rounding, but not where it is much.
        assert_eq!(JUDGE.next((1.0, 3e-7), (5e-9, 2e-7)), Next::Last);
        assert_eq!(JUDGE.next((1e-6, 3e-4), (1e-10, 2e-4)), Next::Step);
        let motions = Judge {
            with_own: false,
            ..JUDGE
        };
        assert_eq!(motions.next((1e-7, 1.0), (9e-9, 0.0)), Next::Last);
    }

    #[test]
    fn simplified_steps_contract_by_the_size_of_the_first_increment() {
        // √2 by x² = 2, from so far off that the first increment is 0.01.
        let f = |x: f64| x * x - 2.0;
        let mut x = 2.0f64.sqrt() + 0.01;
        let slope = 2.0 * x;
        let first = f(x) / slope;
        x -= first;
        let (mut before, mut steps) = (first, 0);
        loop {
            let size = (f(x) / slope).abs();
            // Curvature over slope is about a half.
            let bound = 1.1 * first * before * 0.71 + 1e-15;
            assert!(size <= bound, "{size:e} {bound:e}");
            let next = of(before, size, 0.0);
            assert_ne!(next, Next::Factor);
            (x, before, steps) = (x - f(x) / slope, size, steps + 1);
            if next == Next::Last {
                break;
            }
        }
        // One more than what reaches the tolerance: the last leaves a thousandth of it.
        assert!(steps <= STEPS + 1 && (x - 2.0f64.sqrt()).abs() < 1e-10);
    }
}
