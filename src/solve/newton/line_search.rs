//! The longest step along an increment that brings progress (docs/theory.md, section 7.2).

use super::run::{Line, Run, Test, Trial};
use crate::collocation::{GridState, ResultantPath};
use crate::error::Result;
use crate::solve::linear::solver::{COARSE, LinearSolver};
use crate::solve::report::timed;

/// Shortest step.
const SHORTEST_STEP: f64 = 1.0 / 256.0;
/// Largest turn of a node in one step; beyond it the linearisation means little.
const LARGEST_TURN: f64 = 1.0;

/// The longest step that `accept` gives something for, of one that turns nodes by `turn` at most
/// and its half, quarter and so on; none if all are refused.
fn backtrack<T>(
    turn: f64,
    mut accept: impl FnMut(f64) -> Result<Option<T>>,
) -> Result<Option<(f64, T)>> {
    let mut step = if turn > LARGEST_TURN {
        LARGEST_TURN / turn
    } else {
        1.0
    };
    loop {
        if let Some(accepted) = accept(step)? {
            return Ok(Some((step, accepted)));
        }
        step *= 0.5;
        if step < SHORTEST_STEP {
            return Ok(None);
        }
    }
}

/// Natural monotonicity: the simplified increment after a step (same matrix, new residual) is
/// shorter than the increment. Blind to how equations are scaled.
fn is_monotone(simplified: f64, step: f64, size: f64, tolerance: f64) -> bool {
    simplified <= ((1.0 - 0.25 * step) * size).max(tolerance)
}

impl<L: LinearSolver> Run<'_, L> {
    /// Finds the longest step that is accepted, and the stress resultants along the line if they
    /// were looked at. What remains of the equations there is left in `trial_residual`, and the
    /// last simplified increment in `increment`.
    pub fn search(&mut self, line: &Line) -> Result<(Option<Trial>, Option<ResultantPath>)> {
        let mut path = None;
        let found = backtrack(line.turn, |step| self.attempt(line, step, &mut path))?;
        let trial = found.map(|(step, (state, test))| Trial { state, step, test });
        Ok((trial, path))
    }

    /// Gives the state after a step if it is accepted.
    ///
    /// Beams that turn much stretch by terms of second order, and that hides the progress of a
    /// step: what counts then are increments with stress resultants as unknowns of their own.
    fn attempt(
        &mut self,
        line: &Line,
        step: f64,
        path: &mut Option<ResultantPath>,
    ) -> Result<Option<(GridState, Test)>> {
        let equations = &self.newton.equations;
        let has_stations = equations.has_stations();
        let trial = equations.stepped(self.state, line.increment, step);
        if line.is_last && self.leaves_resultants && path.is_none() {
            let equations = &mut self.newton.equations;
            *path = Some(equations.resultants_along(self.state, line.increment)?);
        }
        if !self.evaluate(&trial)? {
            return Ok(None);
        }
        if line.is_last {
            let test = match path {
                Some(_) => Test::IncrementWithResultants,
                None => Test::Increment,
            };
            return Ok(Some((trial, test)));
        }
        let tolerance = self.options.tolerance;
        let accepts = |found: f64| is_monotone(found, step, line.size, tolerance);
        let carries = has_stations && self.newton.stretches && self.is_accurate(COARSE);
        if !has_stations || !carries && step == 1.0 && self.stretching * line.size < 1.0 {
            self.increment.copy_from_slice(&self.trial_residual);
            let found = self.simplify(line.size)?;
            if accepts(found) {
                return Ok(Some((trial, Test::Increment)));
            }
            self.stretching = found / (line.size * line.size);
        }
        if !has_stations {
            return Ok(None);
        }
        self.increment.copy_from_slice(&self.trial_residual);
        let start = (&*self.state, line.increment);
        let (equations, rows) = (&mut self.newton.equations, &mut self.increment);
        let parted = timed(&mut self.newton.timings.assembly, || {
            equations.part_resultants(path, start, (&trial, step), rows)
        });
        if parted.is_err() {
            return Ok(None);
        }
        if accepts(self.simplify(line.size)?) {
            return Ok(Some((trial, Test::IncrementWithResultants)));
        }
        let forced = step == 1.0 && self.watchdog.allows();
        Ok(forced.then_some((trial, Test::None)))
    }

    /// Replaces the residual in `increment` by the simplified increment after one of this size, and
    /// gives its largest motion; infinite if there is none.
    fn simplify(&mut self, after: f64) -> Result<f64> {
        let accuracy = self.accuracy_of_simplified(after);
        let solved = self.newton.solve_linear(&mut self.increment, accuracy)?;
        Ok(match self.newton.norm(&self.increment) {
            size if solved => size,
            _ => f64::INFINITY,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Newton's method with the line search for `f` of one unknown, and its steps.
    fn solve(f: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64, mut x: f64) -> (f64, Vec<f64>) {
        let mut steps = Vec::new();
        for _ in 0..50 {
            let (increment, slope) = (-f(x) / slope(x), slope(x));
            let size = increment.abs();
            let found = backtrack(0.0, |step| {
                let simplified = (f(x + step * increment) / slope).abs();
                Ok(is_monotone(simplified, step, size, 1e-12).then_some(x + step * increment))
            });
            let (step, next) = found.unwrap().unwrap();
            (x, steps) = (next, [&steps[..], &[step]].concat());
            if size < 1e-12 {
                return (x, steps);
            }
        }
        panic!("{steps:?}");
    }

    #[test]
    fn steps_are_short_far_from_the_solution_and_full_near_it() {
        // Full steps diverge from 1.4 on; equations a billion times as stiff take the same steps.
        let (x, steps) = solve(f64::atan, |x| 1.0 / (1.0 + x * x), 20.0);
        let stiff = solve(|x| 1e9 * x.atan(), |x| 1e9 / (1.0 + x * x), 20.0);
        assert!(x.abs() < 1e-12);
        assert!(steps[0] < 0.1 && steps[1..].iter().all(|step| *step == 1.0));
        assert_eq!(steps, stiff.1);
    }

    #[test]
    fn no_step_turns_a_node_far_and_none_is_too_short() {
        let mut tried = Vec::new();
        let found = backtrack(4.0, |step| {
            tried.push(step);
            Ok((step < 0.1).then_some(()))
        });
        assert_eq!(found.unwrap(), Some((0.0625, ())));
        assert_eq!(tried, [0.25, 0.125, 0.0625]);
        let mut count = 0;
        let refused = backtrack(0.0, |_| {
            count += 1;
            Ok(None::<()>)
        });
        assert_eq!((refused.unwrap(), count), (None, 9));
        // Some step is tried even where the shortest turns a node too far.
        assert_eq!(
            backtrack(1e4, |step| Ok(Some(step))).unwrap(),
            Some((1e-4, 1e-4))
        );
    }
}
