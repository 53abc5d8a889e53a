//! Newton's equations of a rotor of like blades, by factors of those that are left of one blade,
//! hub and supports (docs/theory.md, section 9.6).
//!
//! Right sides that are not alike at all blades, as a load on one of them makes, are not left out:
//! they are solved for with the whole Jacobian.

use crate::collocation::{Collocation, GridState, LikeBlades, LikeBladesPattern, Tangent};
use crate::error::Result;
use crate::solve::linear::dense::{largest, probe};
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::direct::DirectSolver;
use crate::solve::linear::method::{DirectCost, Linear, LinearMethod};
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::{Timings, timed};

/// Right sides that differ by less, relative to them, are alike.
const ALIKE: f64 = 1e-6;
/// Solutions for what tells right sides apart, relative to theirs, that are that of rounding or of
/// constraints that are not met yet; and scaled ones that are that of rounding.
const LITTLE: f64 = 0.5;
const ROUNDING: f64 = 1e-9;

/// The Jacobian of what is left, and its factors.
pub(crate) struct OfLikeBlades {
    left: LikeBlades,
    tangent: Tangent,
    pattern: LikeBladesPattern,
    values: Vec<f64>,
    solver: DirectSolver,
    /// Where the equations were linearised last.
    last: Option<GridState>,
    /// How equations are solved that are not alike at all blades, and what did so there.
    method: LinearMethod,
    whole: Option<Box<Linear>>,
}

impl OfLikeBlades {
    /// For the Jacobians of `equations`.
    pub(crate) fn new(equations: &Collocation, left: LikeBlades, method: LinearMethod) -> Self {
        let system = equations.system();
        let wanted = left.wanted(system);
        let tangent = Tangent::at_points(system, equations.grid().points(), wanted);
        let pattern = LikeBladesPattern::new(system, &tangent, &left);
        let groups = pattern.groups().to_vec();
        let panels = pattern.panels().to_vec();
        let mut solver = DirectSolver::of_panels(groups, pattern.node_groups(), panels);
        solver.set_workers(equations.workers().clone());
        OfLikeBlades {
            left,
            tangent,
            values: Vec::new(),
            solver,
            pattern,
            last: None,
            method,
            whole: None,
        }
    }

    /// What factors of what is left take, as planned.
    pub(crate) fn cost(&self) -> DirectCost {
        self.solver.cost()
    }

    /// Solves with the whole Jacobian.
    fn solve_whole(
        &mut self,
        equations: &mut Collocation,
        timings: &mut Timings,
        solve: impl FnOnce(&mut Linear, &mut Collocation, &mut Timings) -> Result<bool>,
    ) -> Result<bool> {
        let Some(state) = &self.last else {
            return Ok(false);
        };
        let whole = match &mut self.whole {
            Some(whole) => whole,
            None => {
                let mut whole = Box::new(Linear::new(equations, self.method));
                if !whole.linearise(equations, state, timings)? {
                    return Ok(false);
                }
                self.whole.insert(whole)
            }
        };
        solve(whole, equations, timings)
    }

    /// Solves what is left in place. None if the right side is not alike at all blades; `false` if
    /// it cannot be solved.
    fn solve_left(
        &mut self,
        equations: &Collocation,
        rhs: &mut [f64],
        accuracy: f64,
    ) -> Result<Option<bool>> {
        let (system, layout) = (equations.system(), equations.layout());
        let mut x = self.left.gathered(system, layout, rhs);
        let mut apart = self.left.disparity(system, layout, rhs);
        let motions = self.left.motions();
        let is_apart = largest(&apart) > ALIKE * largest(&x);
        let mut solve = |x: &mut [f64]| {
            self.solver
                .solve_refined(&self.values, x, (motions, accuracy))
        };
        if !solve(&mut x)? {
            return Ok(Some(false));
        }
        if is_apart {
            // What it takes to move the leaders by as much tells whether it matters.
            if !solve(&mut apart)? {
                return Ok(Some(false));
            }
            let little = LITTLE * largest(&x[..motions]) + ROUNDING;
            // Written so that NaN is not little.
            let is_little = largest(&apart[..motions]) <= little;
            if !is_little {
                return Ok(None);
            }
        }
        self.left.scatter(system, layout, &x, rhs);
        Ok(Some(true))
    }
}

impl LinearSolver for OfLikeBlades {
    fn prepare(&self, equations: &Collocation, state: &mut GridState) {
        let scale = equations.column_scale();
        self.left.make_alike(equations.system(), scale, state);
    }

    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.whole = None;
        self.last = Some(state.clone());
        timed(&mut timings.assembly, || {
            self.values.resize(self.pattern.entries(), 0.0);
            self.tangent.evaluate(equations, state)?;
            let (left, pattern) = (&self.left, &self.pattern);
            (self.tangent).assemble_like_blades(equations, left, pattern, &mut self.values)
        })?;
        timed(&mut timings.factorisation, || {
            self.solver.factor(&self.values)
        })
    }

    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let solved = timed(&mut timings.substitution, || {
            self.solve_left(equations, rhs, accuracy)
        })?;
        match solved {
            Some(solved) => Ok(solved),
            None => self.solve_whole(equations, timings, |whole, equations, timings| {
                whole.solve(equations, rhs, accuracy, timings)
            }),
        }
    }

    fn error_of(&self, accuracy: f64) -> f64 {
        self.solver.error().min(accuracy)
    }

    fn solve_transposed(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.solve_whole(equations, timings, |whole, equations, timings| {
            whole.solve_transposed(equations, rhs, accuracy, timings)
        })
    }

    fn release(&mut self) {
        self.whole = None;
    }

    fn growth(&mut self, _: &mut Collocation) -> f64 {
        let mut probe = probe(self.left.size());
        match self.solver.solve(&mut probe) {
            true => largest(&probe) * largest(&self.values),
            false => f64::INFINITY,
        }
    }

    fn explain(&mut self, equations: &mut Collocation, state: &GridState) -> Singularity {
        let mut whole = Linear::new(equations, self.method);
        match whole.linearise(equations, state, &mut Timings::default()) {
            Ok(_) => whole.explain(equations, state),
            Err(error) => Singularity::Unsolved(error.to_string()),
        }
    }
}
