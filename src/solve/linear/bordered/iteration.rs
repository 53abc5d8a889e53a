//! Iteration with exact products of all equations, around what solves similar ones.

use super::{Bordered, ITERATION_LIMIT, without_help};
use crate::collocation::{Collocation, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::iterative::{GmresOptions, Outer, Parts, solve_around};
use crate::solve::linear::solver::{LinearSolver, Side};
use crate::solve::report::Timings;

impl<L: LinearSolver> Bordered<L> {
    /// Solves by iteration with exact products, preconditioned by the factors that there are.
    pub(super) fn iterate(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let options = GmresOptions {
            tolerance: accuracy,
            leading: equations.layout().motions().end,
            essential: rhs.len(),
            parts: Parts::AsTheyAre,
            iteration_limit: ITERATION_LIMIT,
            restart: ITERATION_LIMIT,
            // Factors with borders are regular: their rounding does not count.
            is_verified: !self.with_borders,
        };
        let mut whole = Whole {
            tangent: &mut self.tangent,
            borders: &self.borders,
            with_borders: self.with_borders,
        };
        let of_grid = (equations, &mut self.inner);
        let workspace = &mut self.workspace;
        let (inner, end) = solve_around(of_grid, &mut whole, rhs, &options, timings, workspace)?;
        // Written so that NaN fails too.
        let accurate = end.error <= accuracy;
        Ok(inner && accurate && rhs.iter().all(|x| x.is_finite()))
    }
}

/// The whole equations, without the ground.
struct Whole<'a> {
    tangent: &'a mut Tangent,
    borders: &'a Borders,
    /// Whether factors are those of `J` with borders.
    with_borders: bool,
}

impl<L: LinearSolver> Outer<L> for Whole<'_> {
    fn product(&mut self, equations: &Collocation, inner: &L, x: &[f64], y: &mut [f64]) {
        let size = equations.size();
        let of_grid = &x[..size];
        self.tangent.apply(equations, of_grid, &mut y[..size]);
        without_help(equations, inner, of_grid, &mut y[..size]);
        self.borders.product(x, y);
    }

    fn precondition(
        &self,
        (equations, inner): (&mut Collocation, &mut L),
        y: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        if self.with_borders {
            let substituted = inner.substitute_bordered(y, Side::Plain, timings);
            return Ok(substituted == Some(true));
        }
        let of_grid = &mut y[..equations.size()];
        let solved = inner.solve(equations, of_grid, accuracy, timings)?;
        self.borders.substitute(y);
        Ok(solved)
    }
}
