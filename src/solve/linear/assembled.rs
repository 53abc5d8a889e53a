//! The Jacobian assembled and factored: for systems and grids that are not too large.

use crate::collocation::{Collocation, GridState, Pattern, Tangent};
use crate::error::Result;
use crate::numbers::Numbers;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::cost::DirectCost;
use crate::solve::linear::dense::{largest, probe};
use crate::solve::linear::diagnosis::{Singularity, diagnose};
use crate::solve::linear::direct::{Columns, DirectSolver, WithBorders};
use crate::solve::linear::freedoms::FreedomSolver;
use crate::solve::linear::slender::Slender;
use crate::solve::linear::solver::{LinearSolver, Side};
use crate::solve::report::{Timings, timed};
use crate::workers::Workers;
use faer::MatMut;
use std::cell::OnceCell;

/// Accuracy of solutions that precondition an iteration: better ones spare it little.
const PRECONDITIONS: f64 = 1e-2;

/// The Jacobian's values, and their factors.
pub(crate) struct Assembled {
    /// Of the values, found at first use.
    pattern: OnceCell<Pattern>,
    /// For all Jacobians, made at first use.
    solver: Option<DirectSolver>,
    /// For those of mechanisms with few freedoms.
    freedoms: Option<FreedomSolver>,
    /// For those of very slender beams.
    slender: Option<Box<Slender>>,
    /// Whether the present factors are those of the freedoms.
    by_freedoms: bool,
    /// For the Jacobian between borders, and these.
    bordered: Option<(WithBorders, Borders)>,
    /// Whether the present factors are those of both.
    with_borders: bool,
    /// Whether factors of both are made even where there are those of freedoms.
    insists: bool,
    /// Where the equations were linearised last, if their Jacobian was not formed.
    unformed: Option<GridState>,
    /// Scaled compliance of constraints in the values.
    regularisation: f64,
    workers: Workers,
    pub(crate) tangent: Tangent,
    pub(crate) values: Numbers,
}

impl Assembled {
    /// For the Jacobians of `equations`.
    pub(crate) fn new(equations: &Collocation) -> Self {
        let pattern = OnceCell::new();
        let freedoms = FreedomSolver::new(equations, || pattern_of(&pattern, equations));
        if freedoms.is_none() {
            pattern_of(&pattern, equations);
        }
        Assembled {
            solver: None,
            freedoms,
            slender: Slender::new(equations).map(Box::new),
            by_freedoms: false,
            bordered: None,
            with_borders: false,
            insists: false,
            unformed: None,
            regularisation: 0.0,
            workers: equations.workers().clone(),
            values: Numbers::default(),
            tangent: Tangent::new(equations.system(), equations.grid().points()),
            pattern,
        }
    }

    /// Places of the values.
    pub(crate) fn pattern(&self, equations: &Collocation) -> &Pattern {
        pattern_of(&self.pattern, equations)
    }

    /// Assembles the Jacobian.
    pub(crate) fn assemble(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
    ) -> Result<()> {
        self.unformed = None;
        self.regularisation = equations.regularisation();
        let pattern = pattern_of(&self.pattern, equations);
        let bordered = self.bordered.as_ref().map(|(factors, _)| factors.entries());
        let entries = pattern.entries();
        let wanted = bordered.unwrap_or(entries);
        if self.values.len() != wanted {
            self.values = Numbers::default();
            self.values = Numbers::room("the Jacobian", wanted)?;
        }
        let values = &mut self.values[..entries];
        equations.jacobian(state, pattern, &mut self.tangent, values)
    }

    /// What factors of the Jacobian at a state take, of parts that do not act on each other there;
    /// none if those of freedoms serve.
    pub(crate) fn cost_at(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
    ) -> Result<Option<DirectCost>> {
        if self.freedoms.is_some() {
            return Ok(None);
        }
        self.assemble(equations, state)?;
        let (pattern, workers) = (pattern_of(&self.pattern, equations), &self.workers);
        let mut solver = DirectSolver::new(pattern, workers.clone());
        solver.divide(&self.values);
        Ok(Some(solver.cost()))
    }

    /// Assembles the Jacobian that was not formed, if it was not.
    fn complete(&mut self, equations: &mut Collocation) -> Result<()> {
        match self.unformed.take() {
            Some(state) => self.assemble(equations, &state),
            None => Ok(()),
        }
    }

    /// Factors it as is cheapest. `false` if it is singular.
    pub(crate) fn factor(&mut self, equations: &mut Collocation) -> Result<bool> {
        if let Some(freedoms) = &mut self.freedoms {
            self.with_borders = false;
            self.by_freedoms = freedoms.factor(equations, &self.values, &self.workers)?;
            if self.by_freedoms {
                return Ok(true);
            }
        }
        self.complete(equations)?;
        self.factor_all(equations)
    }

    /// Factors the whole of it, which was assembled. `false` if it is singular.
    pub(crate) fn factor_all(&mut self, equations: &Collocation) -> Result<bool> {
        (self.by_freedoms, self.with_borders) = (false, false);
        let (pattern, workers) = (pattern_of(&self.pattern, equations), &self.workers);
        let solver = self
            .solver
            .get_or_insert_with(|| DirectSolver::new(pattern, workers.clone()));
        solver.factor(&self.values)
    }

    /// Solves in place with the factors of the whole. `false` if there are none or the result is
    /// not finite.
    pub(crate) fn substitute(&self, rhs: &mut [f64]) -> bool {
        self.solver.as_ref().is_some_and(|solver| solver.solve(rhs))
    }

    /// The same for several right sides.
    ///
    /// # Errors
    /// If work is to end.
    pub(crate) fn substitute_columns(
        &self,
        rhs: MatMut<f64>,
        memory: &mut Columns,
    ) -> Result<bool> {
        match &self.solver {
            Some(solver) => solver.solve_columns(rhs, memory),
            None => Ok(false),
        }
    }

    /// Sign of the determinant of the factored Jacobian, and logarithm of its size.
    pub(crate) fn determinant(&self) -> (f64, f64) {
        match (&self.freedoms, &self.solver) {
            (Some(freedoms), _) if self.by_freedoms => freedoms.determinant(self.regularisation),
            (_, Some(solver)) => solver.determinant(),
            _ => (1.0, f64::NEG_INFINITY),
        }
    }

    fn solve_refined(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
    ) -> Result<bool> {
        if let (Some(slender), Some(solver)) = (&mut self.slender, &self.solver) {
            let wanted = rhs.to_vec();
            let substitute = |x: &mut [f64]| solver.solve(x);
            if slender.solve((equations, None), rhs, accuracy, substitute) {
                return Ok(true);
            }
            rhs.copy_from_slice(&wanted);
        }
        if let (Some(freedoms), true) = (&mut self.freedoms, self.by_freedoms) {
            let wanted = rhs.to_vec();
            if freedoms.solve(&self.values, rhs) {
                return Ok(true);
            }
            rhs.copy_from_slice(&wanted);
            self.complete(equations)?;
            if !self.factor_all(equations)? {
                return Ok(false);
            }
        }
        match &mut self.solver {
            Some(solver) => {
                let motions = equations.layout().motions().end;
                solver.solve_refined(&self.values, rhs, (motions, accuracy))
            }
            None => Ok(false),
        }
    }

    /// Makes room for the factors between borders, and forgets those that there are.
    fn take_borders(&mut self, equations: &Collocation, borders: &Borders) {
        let count = borders.count();
        let factors = match self.bordered.take() {
            Some((factors, _)) if factors.count() == count => factors,
            _ => {
                let pattern = pattern_of(&self.pattern, equations);
                WithBorders::new(pattern, count, self.workers.clone())
            }
        };
        self.bordered = Some((factors, Borders::default()));
        (self.by_freedoms, self.with_borders) = (false, false);
    }
}

impl LinearSolver for Assembled {
    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        timed(&mut timings.assembly, || {
            self.regularisation = equations.regularisation();
            if let Some(slender) = &mut self.slender {
                slender.linearise(equations, state)?;
            }
            let unformed = match &mut self.freedoms {
                Some(freedoms) => freedoms.evaluate(equations, state)?,
                None => false,
            };
            if !unformed {
                return self.assemble(equations, state);
            }
            self.unformed = Some(state.clone());
            Ok(())
        })?;
        timed(&mut timings.factorisation, || self.factor(equations))
    }

    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        timed(&mut timings.substitution, || {
            self.solve_refined(equations, rhs, accuracy)
        })
    }

    fn preconditions_at(&self, accuracy: f64) -> f64 {
        match self.slender {
            // Found by iteration.
            Some(_) => accuracy,
            None => accuracy.max(PRECONDITIONS),
        }
    }

    fn error_of(&self, accuracy: f64) -> f64 {
        if let (Some((factors, _)), true) = (&self.bordered, self.with_borders) {
            return factors.error().min(accuracy);
        }
        match (&self.solver, self.by_freedoms) {
            (Some(solver), false) => solver.error().min(accuracy),
            _ => accuracy,
        }
    }

    fn solve_transposed(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        _: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        if self.by_freedoms {
            timed(&mut timings.assembly, || self.complete(equations))?;
            if !timed(&mut timings.factorisation, || self.factor_all(equations))? {
                return Ok(false);
            }
        }
        let solver = self.solver.as_ref();
        Ok(timed(&mut timings.substitution, || {
            solver.is_some_and(|solver| solver.solve_transposed(rhs))
        }))
    }

    fn has_compliance(&self) -> bool {
        !self.by_freedoms
    }

    fn factors_borders(&self) -> bool {
        self.insists || self.freedoms.is_none()
    }

    fn insist_on_borders(&mut self, _: &Collocation) {
        self.insists = true;
    }

    fn linearise_bordered(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        borders: &mut Borders,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        if !self.factors_borders() {
            return Ok(None);
        }
        timed(&mut timings.analysis, || {
            self.take_borders(equations, borders)
        });
        timed(&mut timings.assembly, || {
            if let Some(slender) = &mut self.slender {
                slender.linearise(equations, state)?;
            }
            self.assemble(equations, state)?;
            borders.complete(equations, state, &mut self.tangent);
            Ok(())
        })?;
        let Some((factors, of_factors)) = &mut self.bordered else {
            return Ok(None);
        };
        of_factors.clone_from(borders);
        let values = &mut self.values;
        self.with_borders = timed(&mut timings.factorisation, || {
            factors.factor(values, borders)
        })?;
        Ok(Some(self.with_borders))
    }

    fn substitute_bordered(
        &mut self,
        rhs: &mut [f64],
        side: Side,
        timings: &mut Timings,
    ) -> Option<bool> {
        let (factors, _) = self.bordered.as_ref().filter(|_| self.with_borders)?;
        Some(timed(&mut timings.substitution, || {
            factors.solve(rhs, side)
        }))
    }

    fn solve_bordered(
        &mut self,
        equations: &mut Collocation,
        _: &Borders,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        let Some((factors, borders)) = self.bordered.as_mut().filter(|_| self.with_borders) else {
            return Ok(None);
        };
        timed(&mut timings.substitution, || {
            if let Some(slender) = &mut self.slender {
                let wanted = rhs.to_vec();
                let substitute = |x: &mut [f64]| factors.solve(x, Side::Plain);
                if slender.solve((equations, Some(borders)), rhs, accuracy, substitute) {
                    return Ok(Some(true));
                }
                rhs.copy_from_slice(&wanted);
            }
            let motions = equations.layout().motions().end;
            let solved = factors.solve_refined(&self.values, rhs, (motions, accuracy))?;
            Ok(Some(solved))
        })
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        if let (Some((factors, _)), true) = (&self.bordered, self.with_borders) {
            let mut probe = probe(equations.layout().size());
            return match factors.solve(&mut probe, Side::Plain) {
                true => largest(&probe[..equations.size()]) * largest(&self.values),
                false => f64::INFINITY,
            };
        }
        let mut probe = probe(equations.size());
        let solved = match (&mut self.freedoms, &self.solver) {
            (Some(freedoms), _) if self.by_freedoms => freedoms.respond(&self.values, &mut probe),
            (_, Some(solver)) => solver.solve(&mut probe),
            _ => false,
        };
        if !solved {
            return f64::INFINITY;
        }
        let size = match (&self.freedoms, &self.unformed) {
            (Some(freedoms), Some(_)) => freedoms.largest(&self.values).max(1.0),
            _ => match (&self.solver, self.by_freedoms) {
                (Some(solver), false) => solver.largest_entry(),
                _ => largest(&self.values),
            },
        };
        largest(&probe) * size
    }

    fn is_resisted(&mut self, equations: &mut Collocation) -> bool {
        let Some(slender) = &mut self.slender else {
            return false;
        };
        if let (Some((factors, borders)), true) = (&self.bordered, self.with_borders) {
            let substitute = |x: &mut [f64]| factors.solve(x, Side::Plain);
            return slender.is_resisted((equations, Some(borders)), substitute);
        }
        let Some(solver) = &self.solver else {
            return false;
        };
        slender.is_resisted((equations, None), |x| solver.solve(x))
    }

    fn explain(&mut self, equations: &mut Collocation, state: &GridState) -> Singularity {
        if let Err(error) = self.complete(equations) {
            return Singularity::Unsolved(error.to_string());
        }
        diagnose(equations, self.pattern(equations), &self.values, state)
    }
}

fn pattern_of<'p>(pattern: &'p OnceCell<Pattern>, equations: &Collocation) -> &'p Pattern {
    pattern.get_or_init(|| Pattern::new(equations.system(), equations.grid().points()))
}
