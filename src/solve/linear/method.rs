//! How Newton's linear equations are solved: directly or by iteration, as costs less.
//! See docs/theory.md, section 8.7.

use crate::collocation::{Collocation, GridState, LikeBlades, Tangent};
use crate::error::{Error, ErrorKind, Result};
use crate::solve::linear::assembled::Assembled;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::cost::{AFFORDABLE, DirectCost, iteration_bytes, tangent_bytes};
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::freedoms::FreedomSolver;
use crate::solve::linear::iterative::{Iterative, IterativeRecord, Preconditioner};
use crate::solve::linear::like_blades::{OfLikeBlades, Whole};
pub use crate::solve::linear::plan::LinearMethod;
use crate::solve::linear::plan::{
    Choice, DELAYED, LARGE, Plan, SMALL, may_serve_in_parts, serve_along_branch,
};
use crate::solve::linear::slender::SLENDER;
use crate::solve::linear::solver::{ESTIMATE, LinearSolver, Side};
use crate::solve::report::{Timings, timed};

/// Factors of the whole that take so many times what is affordable are not tried of one blade.
const DEAR: f64 = 4.0;

enum Active {
    Direct(Box<Assembled>),
    LikeBlades(Box<OfLikeBlades>),
    Iterative(Box<Iterative>),
}

impl Active {
    fn solver(&self) -> &dyn LinearSolver {
        match self {
            Active::Direct(direct) => &**direct,
            Active::LikeBlades(blades) => &**blades,
            Active::Iterative(iterative) => &**iterative,
        }
    }

    fn solver_mut(&mut self) -> &mut dyn LinearSolver {
        match self {
            Active::Direct(direct) => &mut **direct,
            Active::LikeBlades(blades) => &mut **blades,
            Active::Iterative(iterative) => &mut **iterative,
        }
    }
}

/// The solver in use.
pub(crate) struct Linear {
    active: Active,
    /// Whether factors may be tried where iteration fails.
    falls_back: bool,
    /// Whether iteration may be tried where factors do not fit in memory.
    may_iterate: bool,
    /// Where the equations were linearised last.
    last: Option<GridState>,
    /// Products since then.
    products: usize,
    /// Products that take as long as factors do.
    most_products: usize,
    /// What iteration took until it was given up.
    given_up: Option<IterativeRecord>,
}

impl Plan {
    /// The same, by what is left of one blade where all are alike and that costs less; `cost` is
    /// that of factors of the whole Jacobian.
    pub fn of_symmetric(
        equations: &Collocation,
        method: LinearMethod,
        (most_bytes, cost): (f64, DirectCost),
    ) -> Self {
        let plan = Self::of_cost(equations, method, (most_bytes, cost));
        let slender = equations.system().slenderness() > SLENDER;
        // Other preconditioners do not know one blade.
        let others = match method {
            LinearMethod::Iterative(Some(named)) => named != Preconditioner::BodyCirculant,
            _ => false,
        };
        if slender || others || FreedomSolver::work(equations).is_some() {
            return plan;
        }
        let Some(left) = LikeBlades::of(equations) else {
            return plan;
        };
        let (system, points) = (equations.system(), equations.grid().points());
        let tangent = tangent_bytes(system, points);
        let numbers = left.motions() as f64;
        let whole = || -> Whole {
            Box::new(move |equations: &Collocation| Box::new(Linear::new(equations, method)))
        };
        // Of what is left they take about as much for each number as of the whole.
        let of_whole = equations.layout().motions().len() as f64;
        let dear = plan.cost.work > DEAR * AFFORDABLE * of_whole;
        // If they take no more than so much for each number.
        let by_factors = |most_work: f64| {
            let blades = OfLikeBlades::by_factors(equations, left.clone(), whole());
            let cost = blades.cost().unwrap_or(DirectCost::NONE);
            let fits = cost.bytes < LARGE.min(most_bytes) && cost.work < most_work * numbers;
            let serves = method == LinearMethod::Direct || fits;
            serves.then_some((blades, tangent + DELAYED * cost.bytes))
        };
        let by_iteration = || {
            let iterated = iteration_bytes(system, points, plan.cost);
            let blades = OfLikeBlades::by_iteration(equations, left.clone(), whole())?;
            // No more than by iteration on all blades.
            Some((blades, iterated))
        };
        let found = match method {
            LinearMethod::Direct => by_factors(f64::INFINITY),
            LinearMethod::Iterative(_) => by_iteration(),
            LinearMethod::Automatic => {
                let cheap = (!dear).then(|| by_factors(AFFORDABLE)).flatten();
                let small = || (numbers < SMALL).then(|| by_factors(f64::INFINITY));
                cheap.or_else(by_iteration).or_else(|| small().flatten())
            }
        };
        match found {
            Some((blades, bytes)) => Plan {
                bytes,
                choice: Choice::LikeBlades(Box::new(blades)),
                falls_back: false,
                ..plan
            },
            None => plan,
        }
    }
}

impl Linear {
    /// For `equations`, as `method` says.
    pub fn new(equations: &Collocation, method: LinearMethod) -> Self {
        Self::planned(equations, Plan::of(equations, method, f64::INFINITY))
    }

    /// The same at one point of a branch after the other.
    pub fn along_branch(equations: &Collocation, method: LinearMethod) -> Self {
        let plan = Plan::of(equations, method, f64::INFINITY);
        Self::planned(equations, plan.along_branch())
    }

    /// Takes factors for all that follows along a branch if they take no longer than iteration
    /// where what does not act on each other at this state is taken apart.
    ///
    /// # Errors
    /// If the equations cannot be evaluated there.
    pub fn look_for_parts(&mut self, equations: &mut Collocation, state: &GridState) -> Result<()> {
        let iterates = matches!(self.active, Active::Iterative(_)) && self.falls_back;
        if !iterates || !may_serve_in_parts(self.most_products) {
            return Ok(());
        }
        let mut direct = Assembled::new(equations);
        if let Some(cost) = direct.cost_at(equations, state)?
            && serve_along_branch(equations, cost)
        {
            self.active = Active::Direct(Box::new(direct));
        }
        Ok(())
    }

    /// For `equations`, as planned.
    pub fn planned(equations: &Collocation, plan: Plan) -> Self {
        let iterative = |preconditioner| Iterative::new(equations, preconditioner);
        let active = match plan.choice {
            Choice::Direct => Active::Direct(Box::new(Assembled::new(equations))),
            Choice::LikeBlades(blades) => Active::LikeBlades(blades),
            Choice::Iterative(preconditioner) => {
                Active::Iterative(Box::new(iterative(preconditioner)))
            }
            Choice::IterativeFirst { work, limit } => {
                let first = iterative(None).or_directly(work, limit);
                Active::Iterative(Box::new(first))
            }
        };
        Linear {
            active,
            falls_back: plan.falls_back,
            may_iterate: plan.method == LinearMethod::Automatic,
            last: None,
            products: 0,
            most_products: plan.most_products,
            given_up: None,
        }
    }

    /// Takes what the solver of the same equations on a coarser grid has found out.
    pub fn learn_from(&mut self, coarse: &Linear) {
        if let (Active::Iterative(next), Active::Iterative(last)) =
            (&mut self.active, &coarse.active)
        {
            next.fails_locally = last.fails_locally;
            next.left_out = last.left_out;
        }
    }

    /// Whether equations are solved by factors.
    pub fn is_direct(&self) -> bool {
        match &self.active {
            Active::Direct(_) => true,
            Active::LikeBlades(blades) => blades.cost().is_some(),
            Active::Iterative(_) => false,
        }
    }

    /// What iteration took, if any was tried.
    pub fn record(&self) -> Option<&IterativeRecord> {
        match &self.active {
            Active::Iterative(iterative) => Some(&iterative.record),
            Active::LikeBlades(blades) => blades.record(),
            Active::Direct(_) => self.given_up.as_ref(),
        }
    }

    /// Whether factors were refused memory, and iteration may do without.
    fn refused<T>(&self, factored: &Result<T>) -> bool {
        let is_refused = |error: &Error| error.kind() == ErrorKind::OutOfMemory;
        self.may_iterate && factored.as_ref().is_err_and(is_refused)
    }

    /// Gives factors up for iteration.
    fn give_up_factors(&mut self, equations: &Collocation) {
        self.falls_back = false;
        self.may_iterate = false;
        self.active = Active::Iterative(Box::new(Iterative::new(equations, None)));
    }

    /// Gives iteration up for factors where it has taken as long as they do: short steps take many
    /// solutions. An estimate is the last.
    fn limit_products(
        &mut self,
        equations: &mut Collocation,
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<()> {
        let is_last = accuracy >= ESTIMATE;
        if self.falls_back && !is_last && self.products > self.most_products {
            self.falls_back = self.fall_back(equations, timings)?;
        }
        Ok(())
    }

    /// Linearises, for iteration as `iterate` does.
    fn linearise_with(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
        iterate: impl Fn(&mut Iterative, &mut Collocation, &mut Timings) -> Result<bool>,
    ) -> Result<bool> {
        if self.falls_back {
            self.last = Some(state.clone());
            self.products = 0;
        }
        if !matches!(self.active, Active::Iterative(_)) {
            let regular = self
                .active
                .solver_mut()
                .linearise(equations, state, timings);
            if !self.refused(&regular) {
                return regular;
            }
            self.give_up_factors(equations);
        }
        let (done, suspect) = match &mut self.active {
            Active::Direct(_) | Active::LikeBlades(_) => return Ok(false),
            Active::Iterative(iterative) => (
                iterate(iterative, equations, timings)?,
                // Factors will tell whether it is singular.
                self.falls_back && iterative.growth(equations) > iterative.suspect,
            ),
        };
        if done && !suspect {
            return Ok(true);
        }
        let regular = self.fall_back(equations, timings)?;
        Ok(if self.is_direct() { regular } else { done })
    }

    /// Gives iteration up for factors.
    fn fall_back(&mut self, equations: &mut Collocation, timings: &mut Timings) -> Result<bool> {
        let (Active::Iterative(iterative), Some(state), true) =
            (&self.active, &self.last, self.falls_back)
        else {
            return Ok(false);
        };
        self.given_up = Some(IterativeRecord {
            preconditioner: None,
            ..iterative.record.clone()
        });
        let mut direct = timed(&mut timings.analysis, || Assembled::new(equations));
        let regular = direct.linearise(equations, state, timings);
        if matches!(&regular, Err(e) if e.kind() == ErrorKind::OutOfMemory) {
            return Ok(false);
        }
        self.active = Active::Direct(Box::new(direct));
        self.may_iterate = false;
        regular
    }
}

impl LinearSolver for Linear {
    fn prepare(&self, equations: &mut Collocation, state: &mut GridState) {
        self.active.solver().prepare(equations, state);
    }

    fn is_negligible(
        &mut self,
        equations: &Collocation,
        left: &[f64],
        tolerance: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let solver = self.active.solver_mut();
        solver.is_negligible(equations, left, tolerance, timings)
    }

    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.linearise_with(equations, state, timings, |solver, equations, timings| {
            solver.linearise(equations, state, timings)
        })
    }

    fn move_to(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.linearise_with(equations, state, timings, |solver, equations, timings| {
            solver.move_to(equations, state, timings)
        })
    }

    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.limit_products(equations, accuracy, timings)?;
        let Active::Iterative(iterative) = &mut self.active else {
            let factors = self.active.solver_mut();
            return factors.solve(equations, rhs, accuracy, timings);
        };
        let done = iterative.solve(equations, rhs, accuracy, timings)?;
        self.products += iterative.record.products.last().copied().unwrap_or(0);
        if done || !self.fall_back(equations, timings)? || !self.is_direct() {
            return Ok(done);
        }
        let factors = self.active.solver_mut();
        factors.solve(equations, rhs, accuracy, timings)
    }

    fn preconditions_at(&self, accuracy: f64) -> f64 {
        self.active.solver().preconditions_at(accuracy)
    }

    fn tangent(&mut self) -> Option<&mut Tangent> {
        self.active.solver_mut().tangent()
    }

    fn solve_bordered(
        &mut self,
        equations: &mut Collocation,
        borders: &Borders,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        self.limit_products(equations, accuracy, timings)?;
        let Active::Iterative(iterative) = &mut self.active else {
            let factors = self.active.solver_mut();
            return factors.solve_bordered(equations, borders, rhs, accuracy, timings);
        };
        let done = iterative.solve_bordered(equations, borders, rhs, accuracy, timings)?;
        self.products += iterative.record.products.last().copied().unwrap_or(0);
        Ok(done)
    }

    fn error_of(&self, accuracy: f64) -> f64 {
        self.active.solver().error_of(accuracy)
    }

    fn solve_transposed(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let given = match (&self.active, self.falls_back) {
            (Active::Iterative(_), true) => rhs.to_vec(),
            _ => Vec::new(),
        };
        let solver = self.active.solver_mut();
        let done = solver.solve_transposed(equations, rhs, accuracy, timings)?;
        if done || given.is_empty() || !self.fall_back(equations, timings)? {
            return Ok(done);
        }
        rhs.copy_from_slice(&given);
        let solver = self.active.solver_mut();
        solver.solve_transposed(equations, rhs, accuracy, timings)
    }

    fn iteration(&self) -> Option<&IterativeRecord> {
        self.record()
    }

    fn release(&mut self) {
        if let Active::Iterative(iterative) = &mut self.active {
            iterative.release();
        }
    }

    fn has_compliance(&self) -> bool {
        self.active.solver().has_compliance()
    }

    fn factors_borders(&self) -> bool {
        self.active.solver().factors_borders()
    }

    fn insist_on_borders(&mut self, equations: &Collocation) {
        self.active.solver_mut().insist_on_borders(equations);
    }

    fn linearise_bordered(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        borders: &mut Borders,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        let solver = self.active.solver_mut();
        let factored = solver.linearise_bordered(equations, state, borders, timings);
        if self.refused(&factored) {
            self.give_up_factors(equations);
            return Ok(None);
        }
        factored
    }

    fn substitute_bordered(
        &mut self,
        rhs: &mut [f64],
        side: Side,
        timings: &mut Timings,
    ) -> Option<bool> {
        let solver = self.active.solver_mut();
        solver.substitute_bordered(rhs, side, timings)
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        self.active.solver_mut().growth(equations)
    }

    fn is_resisted(&mut self, equations: &mut Collocation) -> bool {
        self.active.solver_mut().is_resisted(equations)
    }

    fn explain(&mut self, equations: &mut Collocation, state: &GridState) -> Singularity {
        self.active.solver_mut().explain(equations, state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::TimeGrid;
    use crate::system::System;
    use crate::test_models::small::one_blade;
    use std::sync::Arc;

    #[test]
    fn iteration_solves_what_factors_get_no_memory_for() {
        let (model, period) = one_blade(2);
        let system = Arc::new(System::new(&model, period).unwrap());
        let grid = TimeGrid::new(9, period).unwrap();
        let state = GridState::reference(&system, grid);
        let mut equations = Collocation::new(system, grid).unwrap();
        let refused: Result<bool> = Err(Error::new(ErrorKind::OutOfMemory, "a dense block"));
        let mut linear = Linear::new(&equations, LinearMethod::Automatic);
        let chosen = Linear::new(&equations, LinearMethod::Direct);
        assert!(linear.refused(&refused) && !chosen.refused(&refused));
        assert!(!linear.refused(&Ok(true)));

        let wave = |i: usize| (0.37 * i as f64).sin();
        let rhs: Vec<f64> = (0..equations.size()).map(|i| 1e-3 * wave(i)).collect();
        let mut timings = Timings::default();
        let mut solve = |linear: &mut Linear, equations: &mut Collocation| {
            assert!(linear.linearise(equations, &state, &mut timings).unwrap());
            let mut x = rhs.clone();
            assert!(linear.solve(equations, &mut x, 1e-8, &mut timings).unwrap());
            x
        };
        let by_factors = solve(&mut linear, &mut equations);
        assert!(linear.record().is_none());
        linear.give_up_factors(&equations);
        let by_iteration = solve(&mut linear, &mut equations);
        assert!(linear.record().is_some());
        let motions = equations.layout().motions();
        let largest = by_factors[motions.clone()]
            .iter()
            .fold(0.0f64, |m, x| m.max(x.abs()));
        for (a, b) in by_factors[motions].iter().zip(&by_iteration) {
            // A hundred times the accuracy that was asked for.
            assert!((a - b).abs() < 1e-6 * largest, "{a} {b} of {largest}");
        }
    }
}
