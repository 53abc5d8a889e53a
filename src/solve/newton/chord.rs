//! Further steps with the same matrix (docs/theory.md, section 7.4).
//!
//! After a full step the simplified increment is the next one, up to a part of the order of the
//! last increment: if what that leaves is small enough, there is no need to factor again.

use super::run::Run;
use super::verdict::Ending;
use crate::error::Result;
use crate::solve::linear::dense::largest;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::newton::ERROR_LEFT;
use crate::solve::report::{Iteration, Outcome};
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
    /// Takes steps by the simplified increments that follow the full step by an increment of size
    /// `first`, whose own simplified one is in `increment`. Together they count as an iteration.
    pub fn chord_steps(&mut self, first: f64) -> Result<ControlFlow<Ending>> {
        let accuracy = self.accuracy_of_simplified(first);
        let judge = Judge {
            tolerance: self.options.tolerance,
            steps: self.newton.chords,
            with_own: self.with_multipliers,
            first,
            accuracy: self.newton.linear.error_of(accuracy),
        };
        let (mut before, mut size) = (first, self.newton.norm(&self.increment));
        let mut changed = f64::INFINITY;
        self.newton.contraction = Some(size / before);
        if self.iterations.len() == self.options.iteration_limit {
            return Ok(ControlFlow::Continue(()));
        }
        let residual = largest(&self.residual);
        let (mut taken, mut ends) = (None, false);
        while !ends && !self.left().is_contradicted() {
            let change = match self.with_multipliers {
                true => self.change_of_own(),
                false => 0.0,
            };
            ends = match judge.next((before, changed), (size, change)) {
                Next::Factor => break,
                next => next == Next::Last,
            };
            changed = change;
            let change = self.newton.equations.unscaled(&self.increment, -1.0);
            let trial = self.newton.equations.stepped(self.state, &change, 1.0);
            before = size;
            if !ends {
                if !self.evaluate(&trial)? {
                    break;
                }
                self.increment.copy_from_slice(&self.trial_residual);
                let solved = self.newton.solve_linear(&mut self.increment, accuracy)?;
                size = self.newton.norm(&self.increment);
                // Written so that NaN ends it too.
                let nearer = solved && size < before;
                if !nearer {
                    break;
                }
                self.residual.copy_from_slice(&self.trial_residual);
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
