//! The Jacobian assembled and factored: for systems and grids that are not too large.

use super::dense::{largest, probe};
use super::diagnosis::{Singularity, diagnose};
use super::direct::DirectSolver;
use super::linear::LinearSolver;
use super::newton::{Timings, timed};
use crate::collocation::{Collocation, GridState, Pattern, TangentBlocks};
use crate::error::Result;

/// The Jacobian's values, and their factors.
#[derive(Debug)]
pub(super) struct Assembled {
    pub(super) pattern: Pattern,
    pub(super) solver: DirectSolver,
    pub(super) blocks: TangentBlocks,
    pub(super) values: Vec<f64>,
}

impl Assembled {
    /// Orders and analyses the Jacobian of `equations`.
    pub(super) fn new(equations: &Collocation) -> Self {
        let pattern = Pattern::new(equations.system(), equations.grid().points());
        let mut solver = DirectSolver::new(&pattern);
        solver.set_workers(equations.workers().clone());
        Assembled {
            solver,
            values: vec![0.0; pattern.entries()],
            blocks: TangentBlocks::default(),
            pattern,
        }
    }

    /// Assembles the Jacobian.
    pub(super) fn assemble(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
    ) -> Result<()> {
        equations.jacobian(state, &self.pattern, &mut self.blocks, &mut self.values)
    }

    /// Factors it. `false` if it is singular.
    pub(super) fn factor(&mut self) -> Result<bool> {
        self.solver.factor(&self.values)
    }

    /// Sign of the determinant of the factored Jacobian, and logarithm of its size.
    pub(super) fn determinant(&self) -> (f64, f64) {
        self.solver.determinant()
    }
}

impl LinearSolver for Assembled {
    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        timed(&mut timings.assembly, || self.assemble(equations, state))?;
        timed(&mut timings.factorisation, || self.factor())
    }

    fn solve(
        &mut self,
        _: &mut Collocation,
        rhs: &mut [f64],
        _: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        timed(&mut timings.substitution, || {
            self.solver.solve_refined(&self.values, rhs)
        })
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        let mut probe = probe(equations.size());
        if !self.solver.solve(&mut probe) {
            return f64::INFINITY;
        }
        largest(&probe) * self.solver.largest_entry()
    }

    fn explain(&mut self, equations: &Collocation, state: &GridState) -> Singularity {
        diagnose(equations, &self.pattern, &self.values, state)
    }
}
