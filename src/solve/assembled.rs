//! The Jacobian assembled and factored: for systems and grids that are not too large.

use super::dense::{largest, probe};
use super::diagnosis::{Singularity, diagnose};
use super::direct::DirectSolver;
use super::freedoms::FreedomSolver;
use super::linear::LinearSolver;
use super::newton::{Timings, timed};
use crate::collocation::{Collocation, GridState, Pattern, TangentBlocks};
use crate::error::Result;
use crate::workers::Workers;

/// The Jacobian's values, and their factors.
#[derive(Debug)]
pub(super) struct Assembled {
    pub(super) pattern: Pattern,
    /// For all Jacobians, made at first use.
    solver: Option<DirectSolver>,
    /// For those of mechanisms with few freedoms.
    freedoms: Option<FreedomSolver>,
    /// Whether the present factors are those of the freedoms.
    by_freedoms: bool,
    /// Scaled compliance of constraints in the values.
    regularisation: f64,
    workers: Workers,
    pub(super) blocks: TangentBlocks,
    pub(super) values: Vec<f64>,
}

impl Assembled {
    /// Orders and analyses the Jacobian of `equations`.
    pub(super) fn new(equations: &Collocation) -> Self {
        let pattern = Pattern::new(equations.system(), equations.grid().points());
        let freedoms = FreedomSolver::new(equations, &pattern);
        Assembled {
            solver: None,
            freedoms,
            by_freedoms: false,
            regularisation: 0.0,
            workers: equations.workers().clone(),
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
        self.regularisation = equations.regularisation();
        equations.jacobian(state, &self.pattern, &mut self.blocks, &mut self.values)
    }

    /// Factors it as is cheapest. `false` if it is singular.
    pub(super) fn factor(&mut self) -> Result<bool> {
        let (pattern, regularised) = (&self.pattern, self.regularisation != 0.0);
        if let Some(freedoms) = &mut self.freedoms {
            self.by_freedoms =
                freedoms.factor(pattern, &self.values, regularised, &self.workers)?;
            if self.by_freedoms {
                return Ok(true);
            }
        }
        self.factor_all()
    }

    /// Factors the whole of it. `false` if it is singular.
    pub(super) fn factor_all(&mut self) -> Result<bool> {
        self.by_freedoms = false;
        let (pattern, workers) = (&self.pattern, &self.workers);
        let solver = self.solver.get_or_insert_with(|| {
            let mut solver = DirectSolver::new(pattern);
            solver.set_workers(workers.clone());
            solver
        });
        solver.factor(&self.values)
    }

    /// Solves in place with the factors of the whole. `false` if there are none or the result is
    /// not finite.
    pub(super) fn substitute(&self, rhs: &mut [f64]) -> bool {
        self.solver.as_ref().is_some_and(|solver| solver.solve(rhs))
    }

    /// Sign of the determinant of the factored Jacobian, and logarithm of its size.
    pub(super) fn determinant(&self) -> (f64, f64) {
        match (&self.freedoms, &self.solver) {
            (Some(freedoms), _) if self.by_freedoms => freedoms.determinant(self.regularisation),
            (_, Some(solver)) => solver.determinant(),
            _ => (1.0, f64::NEG_INFINITY),
        }
    }

    fn solve_refined(&mut self, rhs: &mut [f64]) -> Result<bool> {
        if let (Some(freedoms), true) = (&mut self.freedoms, self.by_freedoms) {
            let wanted = rhs.to_vec();
            if freedoms.solve(&self.values, rhs) {
                return Ok(true);
            }
            rhs.copy_from_slice(&wanted);
            if !self.factor_all()? {
                return Ok(false);
            }
        }
        match &mut self.solver {
            Some(solver) => solver.solve_refined(&self.values, rhs),
            None => Ok(false),
        }
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
        timed(&mut timings.substitution, || self.solve_refined(rhs))
    }

    fn has_compliance(&self) -> bool {
        !self.by_freedoms
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        let mut probe = probe(equations.size());
        let solved = match (&mut self.freedoms, &self.solver) {
            (Some(freedoms), _) if self.by_freedoms => freedoms.respond(&self.values, &mut probe),
            (_, Some(solver)) => solver.solve(&mut probe),
            _ => false,
        };
        if !solved {
            return f64::INFINITY;
        }
        largest(&probe) * largest(&self.values)
    }

    fn explain(&mut self, equations: &Collocation, state: &GridState) -> Singularity {
        diagnose(equations, &self.pattern, &self.values, state)
    }
}
