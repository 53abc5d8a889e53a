//! Iteration around another solver: GMRES with exact products, preconditioned by what solves
//! similar equations of the grid.

use super::gmres::{GmresEnd, GmresOptions, GmresWorkspace, Preconditioned, gmres};
use crate::collocation::Collocation;
use crate::error::Result;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::Timings;
use std::time::Instant;

/// Accuracy of the inner solver, relative to that of the solution, and the finest.
const SHARPER: f64 = 0.1;
pub(crate) const SHARPEST: f64 = 1e-9;

/// The exact equations, and how a solution of the inner ones becomes one of all.
pub(crate) trait Outer<L> {
    /// Writes the product with `x`.
    fn product(&mut self, equations: &Collocation, inner: &L, x: &[f64], y: &mut [f64]);

    /// Preconditions `y`, by what `inner` solves to this accuracy. `false` if it does not.
    ///
    /// # Errors
    /// Those of the inner solver.
    fn precondition(
        &self,
        inner: (&mut Collocation, &mut L),
        y: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool>;
}

struct Operator<'a, L, O> {
    equations: &'a mut Collocation,
    inner: &'a mut L,
    outer: &'a mut O,
    accuracy: f64,
    timings: &'a mut Timings,
    /// What went wrong: no solution, or an error.
    end: Result<bool>,
}

impl<L: LinearSolver, O: Outer<L>> Preconditioned for Operator<'_, L, O> {
    fn product(&mut self, x: &[f64], y: &mut [f64]) {
        self.outer.product(self.equations, self.inner, x, y);
    }

    fn precondition(&mut self, y: &mut [f64]) {
        if matches!(self.end, Ok(true)) {
            let inner = (&mut *self.equations, &mut *self.inner);
            let (accuracy, timings) = (self.accuracy, &mut *self.timings);
            self.end = self.outer.precondition(inner, y, accuracy, timings);
        }
        if !matches!(self.end, Ok(true)) {
            // Which ends the iteration.
            y.fill(0.0);
        }
    }
}

/// Solves in place. Gives whether the inner solver did, and how the iteration ended.
///
/// # Errors
/// Those of the inner solver; if the solve is to end.
pub(crate) fn solve_around<L: LinearSolver, O: Outer<L>>(
    (equations, inner): (&mut Collocation, &mut L),
    outer: &mut O,
    rhs: &mut [f64],
    options: &GmresOptions,
    timings: &mut Timings,
    workspace: &mut GmresWorkspace,
) -> Result<(bool, GmresEnd)> {
    let workers = equations.workers().clone();
    let (began, before) = (Instant::now(), timings.sum());
    let accuracy = inner.preconditions_at((SHARPER * options.tolerance).max(SHARPEST));
    let mut operator = Operator {
        equations,
        inner,
        outer,
        accuracy,
        timings,
        end: Ok(true),
    };
    let end = gmres(&mut operator, rhs, options, &workers, workspace)?;
    let inner = operator.end;
    // What the inner solver has not booked.
    let booked = timings.sum() - before;
    timings.substitution += began.elapsed().saturating_sub(booked);
    workers.pulse()?;
    Ok((inner?, end))
}
