//! Linear equations with scalar unknowns and scalar equations beside those of the grid,
//!
//! ```text
//! [J B; C D] [x; p] = [f; g]
//! ```
//!
//! by factors of all of them, of which the scalars are the last to be eliminated; or by iteration
//! on all, where those of `J` are solved so. Where `J` is solved by factors of fewer unknowns, as
//! of the freedoms of a mechanism, these serve block elimination, as long as `J` is regular: at
//! each limit cycle, and wherever else an equation takes the place of what the grid's own leave
//! open, it is not, and the whole is. Where iteration on all fails, and `J` may be singular, the
//! nodes get a small stiffness against the ground, which makes factors of a preconditioner exist.
//! See docs/theory.md, section 8.8.

mod determined;
mod iteration;
mod refined;

use crate::collocation::{Collocation, GridState, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::dense::{largest, probe};
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::iterative::{GmresWorkspace, SHARPEST};
use crate::solve::linear::solver::{COARSE, LinearSolver};
use crate::solve::report::{Timings, timed};

/// Scaled stiffness of the nodes against the ground.
pub(crate) const GROUNDING: f64 = 1e-7;
/// Growth of `J` that asks for it.
const SUSPECT: f64 = 1e12;
/// Most products of a linear solve, and vectors that are kept.
const ITERATION_LIMIT: usize = 60;
/// Accuracy where only the size of the solution matters.
const ROUGH: f64 = 1e-2;
/// Accuracy of solutions with `J`, relative to that of all.
const SHARPER: f64 = 0.1;
/// How many times as large they may be.
const CANCELS: f64 = 10.0;

/// Solves bordered equations; those of the grid as `inner` does.
pub(crate) struct Bordered<L> {
    pub(crate) inner: L,
    /// Where the equations were linearised last.
    at: Option<GridState>,
    /// The equations there, where `inner` does not keep them.
    tangent: Tangent,
    /// Whether these are those.
    is_evaluated: bool,
    borders: Borders,
    /// Whether the last factors are of `J` with borders, and whether both are those of a state
    /// nearby.
    with_borders: bool,
    is_near: bool,
    /// Whether `J` and its borders determine all unknowns, as far as is known.
    determined: bool,
    /// Whether elimination alone is accurate, as far as is known.
    eliminates: bool,
    workspace: GmresWorkspace,
}

impl<L: LinearSolver> Bordered<L> {
    /// For `equations` with scalars.
    pub fn new(equations: &Collocation, inner: L) -> Self {
        let (system, points) = (equations.system(), equations.grid().points());
        Bordered {
            inner,
            at: None,
            tangent: Tangent::with_resultants_apart(system, points),
            is_evaluated: false,
            borders: Borders::default(),
            with_borders: false,
            is_near: false,
            determined: true,
            eliminates: false,
            workspace: GmresWorkspace::default(),
        }
    }

    /// Takes the equations at `state`, which is near that where they were linearised, with factors
    /// of those there if there are any. `false` if these do not serve.
    pub fn move_to(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.borders = timed(&mut timings.assembly, || Borders::at(equations, state))?;
        let has_none = self.inner.factors_borders() && !self.with_borders;
        if self.inner.tangent().is_some() || has_none {
            return self.factor(equations, state, timings, true);
        }
        self.eliminates = false;
        self.is_near = true;
        self.at = Some(state.clone());
        self.is_evaluated = false;
        match self.with_borders {
            true => self.evaluate(equations, timings).map(|()| true),
            false => self.prepare_elimination(equations, COARSE, timings),
        }
    }

    /// Whether products with all equations are to be had without further ado.
    pub fn multiplies(&mut self) -> bool {
        self.is_near && self.with_borders && self.is_evaluated || self.inner.tangent().is_some()
    }

    /// Writes the product of all equations and `x`, where they are to be had.
    pub fn product(&mut self, equations: &Collocation, x: &[f64], y: &mut [f64]) {
        let size = equations.size();
        let tangent = self.inner.tangent().unwrap_or(&mut self.tangent);
        tangent.apply(equations, &x[..size], &mut y[..size]);
        without_help(equations, &self.inner, &x[..size], &mut y[..size]);
        self.borders.product(x, y);
    }

    /// Factors at `state`, between the present borders; if that is `near` to where the equations
    /// were linearised last, as far as that is needed.
    fn factor(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
        near: bool,
    ) -> Result<bool> {
        self.at = Some(state.clone());
        if let Some(regular) = self.factor_with_borders(equations, state, timings)? {
            return Ok(regular);
        }
        let regular = self.factor_alone(equations, state, timings, near)?;
        // Iteration may have been given up for factors.
        let factored = self.factor_with_borders(equations, state, timings)?;
        Ok(factored.unwrap_or(regular))
    }

    /// Factors `J` with the borders; none if it is factored without them.
    fn factor_with_borders(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<Option<bool>> {
        self.with_borders = false;
        if !self.inner.factors_borders() {
            return Ok(None);
        }
        equations.ground(0.0);
        self.forget();
        let (inner, borders) = (&mut self.inner, &mut self.borders);
        let factored = inner.linearise_bordered(equations, state, borders, timings)?;
        self.with_borders = factored.is_some();
        self.determined = true;
        Ok(factored)
    }

    /// Forgets what has been found of the equations where they were before.
    fn forget(&mut self) {
        (self.is_evaluated, self.is_near) = (false, false);
        self.borders.forget_elimination();
    }

    /// Factors `J` alone, or prepares iteration.
    fn factor_alone(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
        mut near: bool,
    ) -> Result<bool> {
        loop {
            // The ground is in them.
            self.forget();
            let inner = &mut self.inner;
            let regular = match near {
                true => inner.move_to(equations, state, timings)?,
                false => inner.linearise(equations, state, timings)?,
            };
            // Written so that NaN is singular.
            let certain = regular && inner.growth(equations) <= SUSPECT;
            let may_help = equations.grounding() == 0.0 && self.borders.count() > 0;
            if may_help && !certain {
                inner.insist_on_borders(equations);
                if inner.factors_borders() {
                    return Ok(regular);
                }
                equations.ground(GROUNDING);
                near = false;
                continue;
            }
            self.determined = regular;
            self.eliminates = equations.grounding() == 0.0;
            let tangent = inner.tangent();
            let iterates = tangent.is_some();
            if let Some(tangent) = tangent {
                timed(&mut timings.assembly, || {
                    self.borders.complete(equations, state, tangent)
                });
            }
            if regular && !iterates && !self.inner.factors_borders() {
                self.determined = self.prepare_elimination(equations, SHARPEST, timings)?;
            }
            return Ok(regular && self.determined);
        }
    }

    /// Evaluates the equations where they were linearised last, or near that.
    fn evaluate(&mut self, equations: &mut Collocation, timings: &mut Timings) -> Result<()> {
        if let (false, Some(state)) = (self.is_evaluated, &self.at) {
            equations.apply_scalars(state)?;
            timed(&mut timings.assembly, || {
                self.tangent.evaluate(equations, state)
            })?;
            self.is_evaluated = true;
            (self.borders).complete(equations, state, &mut self.tangent);
        }
        Ok(())
    }

    /// Makes what elimination needs, to this accuracy. `false` if there is no solution.
    fn prepare_elimination(
        &mut self,
        equations: &mut Collocation,
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.evaluate(equations, timings)?;
        if self.borders.is_eliminated() {
            return Ok(true);
        }
        let inner = &mut self.inner;
        // Beside motions that only the ground holds all others are small.
        let is_held = equations.grounding() == 0.0;
        let motions = is_held.then(|| equations.layout().motions().end);
        let solve = |x: &mut [f64]| inner.solve(equations, x, accuracy, timings);
        self.determined = self.borders.eliminate(motions, solve)?;
        Ok(self.determined)
    }
}

impl<L: LinearSolver> Bordered<L> {
    /// Solves by elimination alone, from the right side `wanted` in `rhs`. `false`, with that as it
    /// was, where that leaves a small difference of large solutions, as near folds, or `J` is that
    /// of other equations.
    fn eliminate(
        &mut self,
        equations: &mut Collocation,
        (rhs, wanted): (&mut [f64], &[f64]),
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let of_grid = &rhs[..equations.size()];
        // Finer than that only multiples of the columns, which are known, can be told.
        let is_known = of_grid.iter().all(|x| *x == 0.0);
        if !self.eliminates || accuracy < SHARPEST / SHARPER && !is_known {
            return Ok(false);
        }
        let of_grid = &mut rhs[..equations.size()];
        let sharper = (SHARPER * accuracy).max(SHARPEST);
        let solved = is_known || self.inner.solve(equations, of_grid, sharper, timings)?;
        let motions = equations.layout().motions();
        let before = largest(&rhs[motions.clone()]);
        self.borders.substitute(rhs);
        // Written so that NaN does not serve.
        self.eliminates = solved && before <= CANCELS * largest(&rhs[motions]);
        if !self.eliminates {
            rhs.copy_from_slice(wanted);
        }
        Ok(self.eliminates)
    }

    /// Solves by elimination, or by iteration around it, from the right side `wanted` in `rhs`.
    fn solve_by_elimination(
        &mut self,
        equations: &mut Collocation,
        (rhs, wanted): (&mut [f64], &[f64]),
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        if !self.prepare_elimination(equations, SHARPEST, timings)? {
            return Ok(false);
        }
        if self.eliminate(equations, (rhs, wanted), accuracy, timings)? {
            return Ok(rhs.iter().all(|x| x.is_finite()));
        }
        self.iterate(equations, rhs, accuracy, timings)
    }

    /// Solves by factors with borders, or by iteration with them where they are those of a state
    /// nearby.
    fn solve_by_factors(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        if self.is_near {
            return self.iterate(equations, rhs, accuracy, timings);
        }
        let (inner, borders) = (&mut self.inner, &self.borders);
        let solved = inner.solve_bordered(equations, borders, rhs, accuracy, timings)?;
        Ok(solved == Some(true) && rhs.iter().all(|x| x.is_finite()))
    }
}

/// Takes from the product with `x`, or from the transposed one, what only makes factors exist: the
/// ground, and compliance that the solutions of `inner` do not have.
fn without_help<L: LinearSolver>(equations: &Collocation, inner: &L, x: &[f64], y: &mut [f64]) {
    equations.subtract_ground(x, y);
    if equations.is_regularised() && !inner.has_compliance() {
        let mut compliance = vec![0.0; x.len()];
        equations.compliance_of(x, &mut compliance);
        y.iter_mut().zip(&compliance).for_each(|(y, c)| *y -= c);
    }
}

impl<L: LinearSolver> LinearSolver for Bordered<L> {
    fn prepare(&self, equations: &mut Collocation, state: &mut GridState) {
        self.inner.prepare(equations, state);
    }

    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.borders = timed(&mut timings.assembly, || Borders::at(equations, state))?;
        self.factor(equations, state, timings, false)
    }

    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        if self.with_borders {
            return self.solve_by_factors(equations, rhs, accuracy, timings);
        }
        let wanted = rhs.to_vec();
        let borders = &self.borders;
        let at_once = (self.inner).solve_bordered(equations, borders, rhs, accuracy, timings)?;
        if at_once == Some(true) {
            return Ok(true);
        }
        if at_once.is_some() {
            rhs.copy_from_slice(&wanted);
        }
        if !self.inner.factors_borders() {
            if self.solve_by_elimination(equations, (rhs, &wanted), accuracy, timings)? {
                return Ok(true);
            }
            rhs.copy_from_slice(&wanted);
            if at_once.is_none() && self.borders.count() > 0 {
                // Growth does not tell of each singular matrix.
                self.inner.insist_on_borders(equations);
            }
        }
        let Some(state) = self.at.clone() else {
            return Ok(false);
        };
        // What iteration was given up for, too.
        if self.factor_with_borders(equations, &state, timings)? != Some(true) {
            return Ok(false);
        }
        self.solve_by_factors(equations, rhs, accuracy, timings)
    }

    fn error_of(&self, accuracy: f64) -> f64 {
        match self.with_borders && !self.is_near {
            true => self.inner.error_of(accuracy),
            false => accuracy,
        }
    }

    fn has_compliance(&self) -> bool {
        self.inner.has_compliance()
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        if self.with_borders {
            return match self.are_felt(equations) {
                true => self.inner.growth(equations),
                false => f64::INFINITY,
            };
        }
        let mut probe = probe(equations.layout().size());
        let mut product = vec![0.0; equations.size()];
        let of_grid = &probe[..product.len()];
        match self.inner.tangent() {
            Some(tangent) => tangent.apply(equations, of_grid, &mut product),
            None => match self.prepare_elimination(equations, SHARPEST, &mut Timings::default()) {
                Ok(true) => self.tangent.apply(equations, of_grid, &mut product),
                _ => return f64::INFINITY,
            },
        }
        let found = self.solve(equations, &mut probe, ROUGH, &mut Timings::default());
        match found {
            Ok(true) => largest(&probe) * largest(&product),
            _ => f64::INFINITY,
        }
    }

    fn is_resisted(&mut self, equations: &mut Collocation) -> bool {
        // Without factors of both, linearisation ends where the scalars are not determined.
        let determined = !self.with_borders || self.are_felt(equations);
        determined && equations.grounding() == 0.0 && self.inner.is_resisted(equations)
    }

    fn explain(&mut self, equations: &mut Collocation, state: &GridState) -> Singularity {
        if self.with_borders {
            match self.undetermined(equations, state) {
                Ok(found) => self.borders.undetermined = found,
                Err(error) => return Singularity::Unsolved(error.to_string()),
            }
            self.determined = self.borders.undetermined.is_none();
        }
        if self.determined {
            return self.inner.explain(equations, state);
        }
        let why = match (self.borders.undetermined, equations.scalars()) {
            (Some([equation, unknown]), Some(scalars)) => format!(
                "the conditions do not determine all that is free: {} does not respond to what is \
                 left, as {}, or is redundant with other conditions",
                scalars.describe_equation(equation),
                scalars.describe_unknown(unknown)
            ),
            _ => "the scalar equations do not determine the scalar unknowns".to_string(),
        };
        Singularity::Unsolved(why)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::ScalarEquations;
    use crate::elements::JointKind;
    use crate::model::{Model, SectionInput};
    use crate::solve::linear::method::{Linear, LinearMethod};
    use crate::solve::linear::solver::Side;
    use crate::solve::test_models::Linearised;
    use crate::test_models::parts::{rotation1, spring};
    use crate::test_models::small::{crank_rocker, one_blade};
    use faer::Mat;
    use faer::linalg::solvers::Solve;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::TAU;
    use std::sync::Arc;

    /// Errors of each number in the equations that a solution may amount to: some ten roundings.
    const ROUNDING: f64 = 2e-15;
    const METHODS: [LinearMethod; 2] = [LinearMethod::Direct, LinearMethod::Iterative(None)];

    /// So many unknowns that have no effect, and no equations: borders are given.
    #[derive(Debug)]
    struct Given(usize);

    impl ScalarEquations for Given {
        fn scales(&self) -> Vec<f64> {
            vec![1.0; self.0]
        }

        fn apply(&self, _: &[f64], _: &mut Collocation) -> Result<()> {
            Ok(())
        }

        fn residual(&self, _: &Collocation, _: &GridState, _: &mut [f64]) -> Result<()> {
            Ok(())
        }

        fn gradient(&self, _: &Collocation, _: &GridState, _: usize, _: &mut [f64]) -> Result<()> {
            Ok(())
        }
    }

    fn wave(seed: usize) -> impl Fn(usize) -> f64 {
        move |i| ((i * i + 31 * seed + 7 * i) as f64 * 0.618_033_988_75).fract() - 0.5
    }

    /// Borders without structure; motions only have a part in the scalar equations.
    fn borders(equations: &Collocation, count: usize) -> Borders {
        let layout = equations.layout();
        let column = |j: usize| (0..equations.size()).map(wave(j + 1)).collect();
        let row = |j: usize| {
            let within = |i: &usize| layout.motions().contains(i) || layout.scalars().contains(i);
            let entry = |i: usize| if within(&i) { wave(j + 50)(i) } else { 0.0 };
            (0..layout.size()).map(entry).collect()
        };
        Borders {
            size: equations.size(),
            columns: (0..count).map(column).collect(),
            rows: (0..count).map(row).collect(),
            ..Borders::default()
        }
    }

    /// `b - A x`, in twice the precision.
    fn residual(matrix: &Mat<f64>, b: &[f64], x: &[f64]) -> Vec<f64> {
        let of_row = |i: usize| {
            let (mut sum, mut lost) = (b[i], 0.0);
            for (j, x) in x.iter().enumerate() {
                let term = -matrix[(i, j)] * x;
                let next = sum + term;
                let added = next - sum;
                lost += (sum - (next - added)) + (term - added);
                lost += (-matrix[(i, j)]).mul_add(*x, -term);
                sum = next;
            }
            sum + lost
        };
        (0..b.len()).map(of_row).collect()
    }

    /// The solution to the last digits, which factors alone do not give; and by how much each
    /// unknown may change, relative to a change of each number in the equations by itself.
    fn exact(matrix: &Mat<f64>, b: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let size = b.len();
        let factors = matrix.full_piv_lu();
        let (mut x, mut changed) = (vec![0.0; size], f64::INFINITY);
        for _ in 0..5 {
            let rest = residual(matrix, b, &x);
            let change = factors.solve(&Mat::from_fn(size, 1, |i, _| rest[i]));
            let change = change.col_as_slice(0);
            x.iter_mut().zip(change).for_each(|(x, d)| *x += d);
            changed = largest(change) / largest(&x);
        }
        assert!(changed < 1e-15, "{changed:e}");
        let inverse = factors.solve(&Mat::<f64>::identity(size, size));
        let sum = |of: &dyn Fn(usize) -> f64| (0..size).map(|j| of(j).abs()).sum::<f64>();
        let numbers = |i: usize| b[i].abs() + sum(&|j| matrix[(i, j)] * x[j]);
        let numbers: Vec<f64> = (0..size).map(numbers).collect();
        let change = |i: usize| sum(&|j| inverse[(i, j)] * numbers[j]);
        let changes = (0..size).map(change).collect();
        (x, changes)
    }

    /// A solution with borders beside that of the dense matrix.
    #[derive(Debug)]
    struct Compared {
        /// Errors of motions and of all else, relative to these; and by factors, of transposed
        /// equations.
        errors: Vec<f64>,
        /// What they may be, relative to errors of each number in the equations.
        conditions: Vec<f64>,
        /// Whether factors are those of other equations, which are grounded.
        grounded: bool,
    }

    impl Compared {
        fn add(&mut self, found: &[f64], (exact, changes): (&[f64], &[f64])) {
            let errors: Vec<f64> = found.iter().zip(exact).map(|(x, y)| x - y).collect();
            self.errors.push(largest(&errors) / largest(exact));
            self.conditions.push(largest(changes) / largest(exact));
        }
    }

    fn compare(model: &Model, period: f64, count: usize, method: LinearMethod) -> Compared {
        let mut at = Linearised::new(model, period, 5, |i| (0.9 * i as f64).sin());
        at.equations.set_scalars(Arc::new(Given(count)));
        at.state.scalars = vec![0.0; count];
        let (size, all) = (at.equations.size(), at.equations.layout().size());
        let borders = borders(&at.equations, count);
        let jacobian = at.dense();
        let matrix = Mat::from_fn(all, all, |i, j| match (i < size, j < size) {
            (true, true) => jacobian[(i, j)],
            (true, false) => borders.columns[j - size][i],
            (false, _) => borders.rows[i - size][j],
        });

        let linear = Linear::new(&at.equations, method);
        let mut bordered = Bordered::new(&at.equations, linear);
        bordered.borders = borders;
        let timings = &mut Timings::default();
        let equations = &mut at.equations;
        let regular = bordered.factor(equations, &at.state, timings, false);
        assert!(regular.unwrap());
        let rhs: Vec<f64> = (0..all).map(wave(99)).collect();
        let mut found = rhs.clone();
        let solved = bordered.solve(equations, &mut found, 1e-9, timings);
        assert!(solved.unwrap());
        let mut compared = Compared {
            errors: Vec::new(),
            conditions: Vec::new(),
            grounded: equations.grounding() > 0.0,
        };
        let (wanted, changes) = exact(&matrix, &rhs);
        let motions = equations.layout().motions();
        for part in [motions.clone(), motions.end..all] {
            let of_exact = (&wanted[part.clone()], &changes[part.clone()]);
            compared.add(&found[part], of_exact);
        }
        if method == LinearMethod::Direct {
            let rhs: Vec<f64> = (0..all).map(wave(98)).collect();
            let (wanted, changes) = exact(&matrix.transpose().to_owned(), &rhs);
            let mut found = rhs;
            let side = Side::Transposed;
            let solved = bordered.solve_to_rounding(equations, &mut found, side, timings);
            assert!(solved.unwrap());
            compared.add(&found, (&wanted, &changes));
        }
        compared
    }

    /// A body on a hinge, and one that hangs on it by another: both turn freely.
    fn free_chain(hinges: usize) -> Model {
        let mut model = Model::new();
        let mut before = None;
        for i in 0..hinges {
            let place = Vector3::x() * i as f64;
            let ball = Matrix3::identity() * 0.1;
            let body = model.add_rigid_body(1.0, &(place + Vector3::x() * 0.5), &ball);
            let body = Some(body.unwrap());
            let frame = Model::frame_at("axis", &place, &Vector3::z()).unwrap();
            let joint = model.add_joint(JointKind::Revolute, before, body, &frame, &frame);
            joint.unwrap();
            before = body;
        }
        model
    }

    #[test]
    fn regular_equations_have_the_solution_of_the_dense_matrix() {
        for (model, period) in [one_blade(2), crank_rocker(1, 2, 3.0)] {
            for count in [1, 3] {
                for method in METHODS {
                    let found = compare(&model, period, count, method);
                    println!("{count} {method:?}: {found:?}");
                    // By factors, rounding of stiff beams; by iteration, a hundred times the
                    // accuracy that was asked for.
                    let most = match method {
                        LinearMethod::Direct => 1e-9,
                        _ => 1e-7,
                    };
                    assert!(!found.grounded, "{found:?}");
                    assert!(found.errors.iter().all(|e| *e < most), "{found:?}");
                }
            }
        }
    }

    #[test]
    fn singular_equations_have_it_too_if_the_borders_make_them_regular() {
        // A body and a chain that turn freely, about one axis and about two.
        for hinges in [1, 2] {
            for method in METHODS {
                let found = compare(&free_chain(hinges), TAU, hinges, method);
                println!("{hinges} {method:?}: {found:?}");
                // Factors of both need no others in place of `J`.
                assert_eq!(found.grounded, method != LinearMethod::Direct);
                assert!(found.errors.iter().all(|e| *e < 1e-9), "{found:?}");
            }
        }
    }

    /// Bodies and beams in a row, on hinges of which some are free: these are counted.
    fn random_chain(random: &mut impl FnMut() -> f64) -> (Model, usize) {
        let mut model = Model::new();
        let (mut before, mut place, mut free) = (None, Vector3::zeros(), 0);
        let members = 1 + (3.0 * random()) as usize;
        for _ in 0..members {
            let axis = Vector3::from_fn(|_, _| random() - 0.5).normalize();
            let along = Vector3::from_fn(|_, _| random() - 0.5).normalize();
            let end = place + along;
            let ends = match random() < 0.5 {
                true => {
                    let bending = 10f64.powf(4.0 * random());
                    let stiffness = [1e2, 4e1, 4e1, 0.8, 1.0, 1.0].map(|x| x * bending);
                    let section = SectionInput::diagonal(&stiffness, &[1.0, 0.1, 0.1, 0.1]);
                    let across = along.cross(&axis);
                    let section = section.unwrap();
                    let beam = model.add_straight_beam(&place, &end, &across, &section, 1, 2);
                    let beam = beam.unwrap();
                    [beam.first_node, beam.last_node]
                }
                false => {
                    let ball = Matrix3::identity() * 0.1;
                    let centre = (place + end) / 2.0;
                    [model.add_rigid_body(1.0, &centre, &ball).unwrap(); 2]
                }
            };
            let frame = Model::frame_at("axis", &place, &axis).unwrap();
            let kind = JointKind::Revolute;
            let joint = model.add_joint(kind, before, Some(ends[0]), &frame, &frame);
            match random() < 0.5 {
                true => free += 1,
                false => spring(&mut model, rotation1(joint.unwrap()), 1.0 + random(), 0.1),
            }
            (before, place) = (Some(ends[1]), end);
        }
        (model, free)
    }

    /// Borders that hold all that is free, and some more.
    #[test]
    fn random_equations_have_the_solution_of_the_dense_matrix() {
        let mut last = 7u64;
        let mut random = || {
            last = last
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (last >> 11) as f64 / (1u64 << 53) as f64
        };
        let (mut singular, mut failed) = (0, Vec::new());
        for case in 0..40 {
            let (model, free) = random_chain(&mut random);
            let count = free + (3.0 * random()) as usize;
            if count == 0 {
                continue;
            }
            singular += usize::from(free > 0);
            let found = compare(&model, TAU, count, LinearMethod::Direct);
            println!("{case} {free} {count}: {found:?}");
            let mut pairs = found.errors.iter().zip(&found.conditions);
            let accurate = pairs.all(|(error, condition)| *error <= ROUNDING * condition);
            if found.grounded || !accurate {
                failed.push((case, found));
            }
        }
        assert!(singular > 20, "{singular}");
        assert!(failed.is_empty(), "{failed:?}");
    }

    #[test]
    fn what_the_borders_leave_open_is_not_solved() {
        let mut at = Linearised::new(&free_chain(2), TAU, 5, |_| 0.0);
        at.equations.set_scalars(Arc::new(Given(1)));
        at.state.scalars = vec![0.0];
        let linear = Linear::new(&at.equations, LinearMethod::Direct);
        let mut bordered = Bordered::new(&at.equations, linear);
        bordered.borders = borders(&at.equations, 1);
        let (equations, timings) = (&mut at.equations, &mut Timings::default());
        bordered
            .factor(equations, &at.state, timings, false)
            .unwrap();
        assert!(bordered.growth(equations) > 1e13);
        assert!(matches!(
            bordered.explain(equations, &at.state),
            Singularity::Free(_)
        ));

        // No effect at all.
        let borders = &mut bordered.borders;
        borders.columns[0].fill(0.0);
        borders.rows[0].fill(0.0);
        assert!(
            !bordered
                .factor(equations, &at.state, timings, false)
                .unwrap()
        );
        assert!(matches!(
            bordered.explain(equations, &at.state),
            Singularity::Unsolved(_)
        ));
    }
}
