//! Newton's equations of a rotor of like blades, by those that are left of one blade, hub and
//! supports (docs/theory.md, section 8.10): by factors, or by iteration.
//!
//! Right sides that are not alike at all blades, as a load on one of them makes, are not left out:
//! they are solved for with the whole Jacobian.

mod iteration;

use crate::collocation::{Collocation, GridState, Leaders, LikeBlades, LikeBladesPattern, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::cost::DirectCost;
use crate::solve::linear::dense::{largest, probe};
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::direct::{DirectSolver, Structure};
use crate::solve::linear::iterative::IterativeRecord;
use crate::solve::linear::solver::{ESTIMATE, LinearSolver, Side};
use crate::solve::report::{Timings, timed};
use iteration::Iteration;
use std::sync::Arc;

/// Right sides that differ by less, relative to them, are alike.
const ALIKE: f64 = 1e-6;
/// Solutions for what tells right sides apart, relative to theirs, that are that of rounding or of
/// constraints that are not met yet; and scaled ones that are that of rounding.
const LITTLE: f64 = 0.5;
const ROUNDING: f64 = 1e-9;

/// Makes what solves equations that are not alike at all blades.
pub(crate) type Whole = Box<dyn Fn(&Collocation) -> Box<dyn LinearSolver>>;

/// What solves the equations that are left.
enum By {
    /// Factors of their Jacobian.
    Factors(Box<Factors>),
    /// Iteration on those of one blade over the whole period.
    Iteration(Box<Iteration>),
}

/// The Jacobian of what is left, and its factors.
struct Factors {
    tangent: Tangent,
    pattern: LikeBladesPattern,
    values: Vec<f64>,
    solver: DirectSolver,
}

/// Newton's equations by those that are left.
pub(crate) struct OfLikeBlades {
    left: LikeBlades,
    leaders: Arc<Leaders>,
    by: By,
    /// Where the equations were linearised last.
    last: Option<GridState>,
    /// Makes what solves equations that are not alike at all blades, and what did so there.
    new_whole: Whole,
    whole: Option<Box<dyn LinearSolver>>,
    /// Whether what is left could not be solved, so that all are.
    gave_up: bool,
    /// Whether blades have turned out to differ, as parameters may make them.
    differ: bool,
}

impl Factors {
    fn new(equations: &Collocation, left: &LikeBlades) -> Self {
        let system = equations.system();
        let tangent = Tangent::at_points(system, equations.grid().points(), left.wanted(system));
        let mut pattern = LikeBladesPattern::new(system, &tangent, left);
        let groups = pattern.groups().to_vec();
        let panels = pattern.take_panels();
        let structure = Structure::new(groups, pattern.node_groups(), panels);
        let solver = DirectSolver::of_structure(structure, equations.workers().clone());
        Factors {
            tangent,
            values: Vec::new(),
            solver,
            pattern,
        }
    }

    fn linearise(
        &mut self,
        equations: &mut Collocation,
        left: &LikeBlades,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        timed(&mut timings.assembly, || {
            self.values.resize(self.pattern.entries(), 0.0);
            // Couplings with followers take their motions, too.
            let leaders = equations.set_leaders(None);
            let evaluated = self.tangent.evaluate(equations, state);
            equations.set_leaders(leaders);
            evaluated?;
            equations.complete_linearised_residual();
            let pattern = &self.pattern;
            (self.tangent).assemble_like_blades(equations, left, pattern, &mut self.values)
        })?;
        timed(&mut timings.factorisation, || {
            self.solver.factor(&self.values)
        })
    }
}

impl OfLikeBlades {
    /// By factors.
    pub(crate) fn by_factors(equations: &Collocation, left: LikeBlades, new_whole: Whole) -> Self {
        let factors = Factors::new(equations, &left);
        Self::by(By::Factors(Box::new(factors)), equations, left, new_whole)
    }

    /// By iteration; none if an element acts on two blades.
    pub(crate) fn by_iteration(
        equations: &Collocation,
        left: LikeBlades,
        new_whole: Whole,
    ) -> Option<Self> {
        let iteration = Iteration::new(equations, &left)?;
        let by = By::Iteration(Box::new(iteration));
        Some(Self::by(by, equations, left, new_whole))
    }

    fn by(by: By, equations: &Collocation, left: LikeBlades, new_whole: Whole) -> Self {
        OfLikeBlades {
            leaders: Arc::new(Leaders::new(equations.system(), &left)),
            left,
            by,
            last: None,
            new_whole,
            whole: None,
            gave_up: false,
            differ: false,
        }
    }

    /// What factors take, as planned; none of iteration.
    pub(crate) fn cost(&self) -> Option<DirectCost> {
        match &self.by {
            By::Factors(factors) => Some(factors.solver.cost()),
            By::Iteration(_) => None,
        }
    }

    /// What iteration took.
    pub(crate) fn record(&self) -> Option<&IterativeRecord> {
        match (&self.by, &self.whole) {
            (_, Some(whole)) if self.gave_up => whole.iteration(),
            (By::Iteration(iteration), _) => Some(&iteration.iterative.record),
            (By::Factors(_), _) => None,
        }
    }

    /// Solves with the whole Jacobian.
    fn solve_whole(
        &mut self,
        equations: &mut Collocation,
        timings: &mut Timings,
        solve: impl FnOnce(&mut dyn LinearSolver, &mut Collocation, &mut Timings) -> Result<bool>,
    ) -> Result<bool> {
        let Some(state) = &self.last else {
            return Ok(false);
        };
        equations.set_leaders(None);
        let whole = match &mut self.whole {
            Some(whole) => whole,
            None => {
                let mut whole = (self.new_whole)(equations);
                if !whole.linearise(equations, state, timings)? {
                    return Ok(false);
                }
                self.whole.insert(whole)
            }
        };
        solve(&mut **whole, equations, timings)
    }

    /// Solves in place for the unknowns that are left.
    fn solve_for(&mut self, x: &mut [f64], accuracy: f64, timings: &mut Timings) -> Result<bool> {
        match &mut self.by {
            By::Iteration(iteration) => iteration.solve(&self.left, x, accuracy, timings),
            By::Factors(factors) => timed(&mut timings.substitution, || {
                let motions = self.left.motions();
                let Factors { solver, values, .. } = &mut **factors;
                solver.solve_refined(values, x, (motions, accuracy))
            }),
        }
    }

    /// About what the unknowns that are left respond to a right side, in place.
    fn respond(&mut self, x: &mut [f64], timings: &mut Timings) -> Result<bool> {
        let By::Iteration(iteration) = &mut self.by else {
            return self.solve_for(x, ESTIMATE, timings);
        };
        let Iteration {
            blade, iterative, ..
        } = &mut **iteration;
        let mut own = blade.rows(&self.left, x);
        let known = iterative.respond(blade.equations.size(), &mut own);
        blade.unknowns(&self.left, &own, x);
        Ok(known)
    }

    /// Solves what is left. None if the right side is not alike at all blades; `false` if it cannot
    /// be solved.
    fn solve_left(
        &mut self,
        equations: &Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        let (system, layout) = (equations.system(), equations.layout());
        let [mut x, mut apart] = self.left.gathered(system, layout, rhs);
        let is_apart = largest(&apart) > ALIKE * largest(&x);
        if !self.solve_for(&mut x, accuracy, timings)? {
            return Ok(Some(false));
        }
        if is_apart {
            // What it moves the leaders by tells whether it matters.
            if !self.respond(&mut apart, timings)? {
                return Ok(Some(false));
            }
            let motions = self.left.motions();
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

/// Goes on with all blades. Stress resultants may be those of what leads alone.
fn leave_leaders(equations: &mut Collocation) {
    if equations.set_leaders(None).is_some() {
        equations.set_resultants(Vec::new());
    }
}

impl LinearSolver for OfLikeBlades {
    fn prepare(&self, equations: &mut Collocation, state: &mut GridState) {
        let system = equations.system().clone();
        self.left
            .make_alike(&system, equations.column_scale(), state);
        let gains = system.elements().iter().any(|placed| {
            let rows = 0..placed.element.own_unknowns();
            rows.into_iter()
                .any(|row| state.gain(&system, placed, row) != 0.0)
        });
        // Scalars may tell blades apart.
        let is_plain = equations.layout().scalars().is_empty() && !gains;
        if is_plain && !self.gave_up && !self.differ {
            equations.set_leaders(Some(self.leaders.clone()));
        }
    }

    fn is_negligible(
        &mut self,
        equations: &Collocation,
        left: &[f64],
        tolerance: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let (system, layout) = (equations.system(), equations.layout());
        let motions = self.left.motions();
        let mut is_negligible = true;
        for mut rows in self.left.gathered(system, layout, left) {
            let known = self.respond(&mut rows, timings)?;
            // Written so that NaN is not negligible.
            is_negligible &= known && largest(&rows[..motions]) <= tolerance;
        }
        self.differ |= !is_negligible;
        Ok(is_negligible)
    }

    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.whole = None;
        self.last = Some(state.clone());
        if !self.gave_up {
            match &mut self.by {
                By::Factors(factors) => {
                    return factors.linearise(equations, &self.left, state, timings);
                }
                // Its share of what is added, or of compliance, is not that of the whole.
                By::Iteration(_) if equations.grounding() != 0.0 || equations.is_regularised() => {}
                By::Iteration(iteration) => {
                    if iteration.linearise(equations, &self.left, state, timings)? {
                        iteration.blade.tell_residual(equations);
                        return Ok(true);
                    }
                }
            }
        }
        self.gave_up = true;
        leave_leaders(equations);
        let mut whole = (self.new_whole)(equations);
        let done = whole.linearise(equations, state, timings)?;
        self.whole = Some(whole);
        Ok(done)
    }

    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        if !self.gave_up {
            let solved = self.solve_left(equations, rhs, accuracy, timings)?;
            if solved == Some(true) {
                return Ok(true);
            }
            self.gave_up |= solved == Some(false) && matches!(self.by, By::Iteration(_));
            if solved == Some(false) && !self.gave_up {
                return Ok(false);
            }
        }
        self.solve_whole(equations, timings, |whole, equations, timings| {
            whole.solve(equations, rhs, accuracy, timings)
        })
    }

    fn error_of(&self, accuracy: f64) -> f64 {
        match (&self.by, &self.whole) {
            (By::Factors(factors), None) => factors.solver.error().min(accuracy),
            _ => accuracy,
        }
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

    fn has_compliance(&self) -> bool {
        match &self.whole {
            Some(whole) if self.gave_up => whole.has_compliance(),
            _ => true,
        }
    }

    fn factors_borders(&self) -> bool {
        let whole = self.whole.as_ref().filter(|_| self.gave_up);
        whole.is_some_and(|whole| whole.factors_borders())
    }

    fn insist_on_borders(&mut self, equations: &Collocation) {
        self.gave_up = true;
        let whole = (self.whole).get_or_insert_with(|| (self.new_whole)(equations));
        whole.insist_on_borders(equations);
    }

    fn linearise_bordered(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        borders: &mut Borders,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        let Some(whole) = self.whole.as_mut().filter(|_| self.gave_up) else {
            return Ok(None);
        };
        leave_leaders(equations);
        self.last = Some(state.clone());
        whole.linearise_bordered(equations, state, borders, timings)
    }

    fn substitute_bordered(
        &mut self,
        rhs: &mut [f64],
        side: Side,
        timings: &mut Timings,
    ) -> Option<bool> {
        let whole = self.whole.as_mut().filter(|_| self.gave_up)?;
        whole.substitute_bordered(rhs, side, timings)
    }

    fn solve_bordered(
        &mut self,
        equations: &mut Collocation,
        borders: &Borders,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        match self.whole.as_mut().filter(|_| self.gave_up) {
            Some(whole) => whole.solve_bordered(equations, borders, rhs, accuracy, timings),
            None => Ok(None),
        }
    }

    fn release(&mut self) {
        if let By::Iteration(iteration) = &mut self.by {
            iteration.iterative.release();
        }
        if !self.gave_up {
            self.whole = None;
        }
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        match (&mut self.by, &mut self.whole) {
            (_, Some(whole)) if self.gave_up => whole.growth(equations),
            (By::Iteration(iteration), _) => iteration.growth,
            (By::Factors(factors), _) => {
                let mut probe = probe(self.left.size());
                match factors.solver.solve(&mut probe) {
                    true => largest(&probe) * largest(&factors.values),
                    false => f64::INFINITY,
                }
            }
        }
    }

    fn is_resisted(&mut self, equations: &mut Collocation) -> bool {
        match &mut self.whole {
            Some(whole) if self.gave_up => whole.is_resisted(equations),
            _ => false,
        }
    }

    fn explain(&mut self, equations: &mut Collocation, state: &GridState) -> Singularity {
        let mut whole = (self.new_whole)(equations);
        match whole.linearise(equations, state, &mut Timings::default()) {
            Ok(_) => whole.explain(equations, state),
            Err(error) => Singularity::Unsolved(error.to_string()),
        }
    }
}
