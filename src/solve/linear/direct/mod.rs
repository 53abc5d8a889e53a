//! Direct solution of the Jacobian by blocks: multifrontal LU over the graph of nodes and
//! multipliers, with the N grid points of each kept together, so that all work is done by faer's
//! dense kernels. See docs/theory.md, section 8.1.

mod analysis;
mod columns;
mod factorisation;
mod parts;
mod structure;
mod substitution;
mod sum;
mod with_borders;

pub use columns::Columns;
pub(crate) use structure::Structure;
pub(crate) use with_borders::WithBorders;

use crate::collocation::Pattern;
use crate::error::Result;
use crate::solve::linear::block::SpareBlocks;
use crate::solve::linear::cost::DirectCost;
use crate::solve::linear::dense::largest;
use crate::solve::linear::direct::analysis::Analysis;
use crate::solve::linear::direct::factorisation::Factorisation;
use crate::solve::linear::front::{Front, LARGE_FRONT};
use crate::solve::linear::solver::COARSE;
use crate::solve::linear::triangles::{
    solve_unit_lower_transposed, solve_upper_transposed, subtract_transposed,
};
use crate::work::{OF_FACTORS, SUBSTITUTION};
use crate::workers::Workers;
use std::sync::{Arc, OnceLock};
use substitution::Division;

/// A pivot smaller than this, relative to its column, waits for constraints to be eliminated with.
const SMALLEST_PIVOT: f64 = 1e-9;
/// The same, once a solve was not accurate enough: more waits, and larger fronts are factored.
const SMALLEST_SAFE_PIVOT: f64 = 1e-5;
/// Residual of a solve, relative to its right-hand side, that needs no refinement.
const ACCURATE: f64 = 1e-10;
/// Residual of a refined solve that calls for safer pivots, relative to the right-hand side or, if
/// that is more, to the largest number that the product may add up.
const INACCURATE: f64 = 1e-9;
/// Change by an earlier refinement, relative to the accuracy that is asked for, that leaves none to
/// be made.
const UNREFINED: f64 = 0.1;
/// Accuracy, relative to what is coarse, that still is.
const FINER: f64 = 0.1;
/// Most refinements of a solve.
const REFINEMENTS: usize = 8;
/// A refinement that leaves more than this part of the residual is the last: what is left is mostly
/// rounding of large solutions.
const STANDS: f64 = 0.5;

/// Direct solver for matrices of one pattern.
#[derive(Debug)]
pub struct DirectSolver {
    structure: Arc<Structure>,
    analysis: Arc<Analysis>,
    fronts: Vec<Front>,
    /// Memory for what fronts leave to others.
    remainders: SpareBlocks,
    factored: bool,
    /// How several threads divide them, once that was asked for.
    division: OnceLock<Division>,
    /// Largest entry of the matrix.
    largest_entry: f64,
    /// Whether solves with the present factors are known to need no refinement.
    accurate: bool,
    /// Change of motions by the first refinement with these factors, relative to these.
    correction: f64,
    smallest_pivot: f64,
    workers: Workers,
}

impl DirectSolver {
    /// Orders and analyses matrices of `pattern`, for these threads, which share the work of
    /// factorisations and substitutions.
    pub fn new(pattern: &Pattern, workers: Workers) -> Self {
        Self::of_structure(Structure::of(pattern), workers)
    }

    /// The same for matrices of this structure.
    pub(crate) fn of_structure(structure: Structure, workers: Workers) -> Self {
        let analysis = Analysis::new(&structure, workers.threads());
        Self::with((Arc::new(structure), Arc::new(analysis)), workers)
    }

    /// What a factorisation takes, as planned.
    pub(crate) fn cost(&self) -> DirectCost {
        let fronts = self.analysis.plans.iter().map(|plan| {
            let own = self.analysis.size_of(&plan.own);
            (own, self.analysis.size_of(&plan.boundary))
        });
        DirectCost::of_fronts(fronts)
    }

    /// Another one for matrices of the same pattern, which is told what acts on what.
    pub fn another(&self) -> Self {
        let analysed = (self.structure.clone(), self.analysis.clone());
        Self::with(analysed, self.workers.clone())
    }

    fn with((structure, analysis): (Arc<Structure>, Arc<Analysis>), workers: Workers) -> Self {
        DirectSolver {
            structure,
            fronts: analysis.plans.iter().map(|_| Front::empty()).collect(),
            analysis,
            remainders: SpareBlocks::default(),
            workers,
            factored: false,
            division: OnceLock::new(),
            largest_entry: 0.0,
            accurate: false,
            correction: f64::INFINITY,
            smallest_pivot: SMALLEST_PIVOT,
        }
    }

    /// Factors the matrix with these values. `false` if it is singular.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn factor(&mut self, values: &[f64]) -> Result<bool> {
        self.accurate = false;
        self.correction = f64::INFINITY;
        self.factored = false;
        self.division = OnceLock::new();
        let regular = self.factor_fronts(values);
        for front in &mut self.fronts {
            front.release(&self.remainders);
        }
        self.factored = regular?;
        let entries = self.fronts.iter().map(|front| front.largest_entry);
        self.largest_entry = entries.fold(0.0, f64::max);
        Ok(self.factored)
    }

    fn factor_fronts(&mut self, values: &[f64]) -> Result<bool> {
        if self.analysis.is_undivided() {
            self.divide(values);
        }
        let mut regular = self.factor_parts(values)?;
        if regular != Some(true) && self.analysis.places.is_some() {
            // What one is singular without may be further on.
            self.divide(values);
            regular = self.factor_parts(values)?;
        }
        if regular == Some(true) && self.size_of_factors() > self.analysis.most_numbers {
            // Too much has waited for pivots.
            self.take(Analysis::whole(&self.structure, self.workers.threads()));
            regular = self.factor_parts(values)?;
        }
        Ok(regular == Some(true))
    }

    /// Divides groups into parts that this matrix, and those before, do not couple.
    pub(crate) fn divide(&mut self, values: &[f64]) {
        let threads = self.workers.threads();
        if let Some(analysis) = self.analysis.coupled(&self.structure, values, threads) {
            self.take(analysis);
        }
    }

    fn take(&mut self, analysis: Analysis) {
        self.fronts = analysis.plans.iter().map(|_| Front::empty()).collect();
        self.analysis = Arc::new(analysis);
    }

    /// Factors all parts; none if the matrix couples them.
    fn factor_parts(&mut self, values: &[f64]) -> Result<Option<bool>> {
        let analysis = &self.analysis;
        self.workers.work().spend(OF_FACTORS * analysis.work());
        let workers = match analysis.work() < LARGE_FRONT {
            true => self.workers.alone(),
            false => self.workers.clone(),
        };
        let shared = (&self.remainders, &workers);
        let factorisation = Factorisation::new(analysis, values, self.smallest_pivot, shared);
        let regular = factorisation.run(&mut self.fronts)?;
        Ok((!factorisation.is_coupled()).then_some(regular))
    }

    /// Size of the largest entry of the matrix that was factored.
    pub fn largest_entry(&self) -> f64 {
        self.largest_entry
    }

    /// Sign and logarithm of the size of the determinant of the matrix that was factored.
    pub fn determinant(&self) -> (f64, f64) {
        let (mut sign, mut logarithm) = (1.0, 0.0);
        for front in &self.fronts {
            for j in 0..front.rows.len() {
                let pivot = front.upper().column(j)[j];
                sign *= pivot.signum();
                logarithm += pivot.abs().ln();
            }
        }
        let order = |indices: fn(&Front) -> &[usize]| -> Vec<usize> {
            self.fronts.iter().flat_map(indices).copied().collect()
        };
        if is_odd(&order(|front| &front.rows)) != is_odd(&order(|front| &front.columns)) {
            sign = -sign;
        }
        (sign, logarithm)
    }

    /// Solves the transposed equations in place. `false` if there are no factors or the result is
    /// not finite.
    pub fn solve_transposed(&self, rhs: &mut [f64]) -> bool {
        self.factored && self.in_order(rhs, |rhs| self.substitute_transposed(rhs))
    }

    /// The same for unknowns in the order of the groups that are eliminated.
    fn substitute_transposed(&self, rhs: &mut [f64]) -> bool {
        let mut reduced = Vec::with_capacity(rhs.len());
        let mut local = Vec::new();
        for (plan, front) in self.analysis.plans.iter().zip(&self.fronts) {
            let _ = self.workers.pulse();
            let (first, count) = (reduced.len(), front.rows.len());
            reduced.extend(front.columns.iter().map(|&column| rhs[column]));
            let y = &mut reduced[first..];
            let upper = front.upper().each_column();
            solve_upper_transposed(upper, y);
            self.gather(&front.delayed_columns, &plan.boundary, rhs, &mut local);
            subtract_transposed(&mut local, |j| upper(count + j), y);
            self.scatter(&front.delayed_columns, &plan.boundary, &local, rhs);
        }
        for (plan, front) in self.analysis.plans.iter().zip(&self.fronts).rev() {
            let _ = self.workers.pulse();
            let first = reduced.len() - front.rows.len();
            let y = &mut reduced[first..];
            self.gather(&front.delayed_rows, &plan.boundary, rhs, &mut local);
            let (delayed, boundary) = local.split_at(front.delayed_rows.len());
            let (upper, lower) = (front.upper().each_column(), front.lower().each_column());
            subtract_transposed(y, |j| &upper(j)[front.rows.len()..], delayed);
            subtract_transposed(y, lower, boundary);
            solve_unit_lower_transposed(upper, y);
            for (&row, x) in front.rows.iter().zip(&*y) {
                rhs[row] = *x;
            }
            reduced.truncate(first);
        }
        rhs.iter().all(|x| x.is_finite())
    }

    /// Numbers that the factors take.
    pub fn size_of_factors(&self) -> usize {
        self.fronts.iter().map(Front::numbers).sum()
    }

    /// Errors of motions without refinement, relative to the largest, as far as is known.
    pub fn error(&self) -> f64 {
        match self.accurate {
            true => 0.0,
            false if self.correction.is_nan() => f64::INFINITY,
            false => self.correction,
        }
    }

    /// As [`DirectSolver::solve`], for the `values` of the matrix that was factored: refines the
    /// result by its residual, unless an earlier one with the same factors was accurate. Pivots are
    /// sought within a front only: where that has cost too many digits, the matrix is factored
    /// again with more of them waiting.
    ///
    /// Relative errors of the first unknowns, as many as `motions`, may be of the order of
    /// `accuracy`: where that is coarse, and an earlier refinement changed them by far less, there
    /// is none.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn solve_refined(
        &mut self,
        values: &[f64],
        rhs: &mut [f64],
        (motions, accuracy): (usize, f64),
    ) -> Result<bool> {
        // The finer are those of solvers around this one.
        let is_enough = accuracy >= FINER * COARSE && self.correction <= UNREFINED * accuracy;
        if self.accurate || is_enough {
            return Ok(self.solve(rhs));
        }
        let wanted = rhs.to_vec();
        if !self.solve(rhs) {
            return Ok(false);
        }
        let left = self.refine(values, &wanted, rhs, (motions, accuracy));
        if left > INACCURATE * self.size(&wanted, rhs) && self.smallest_pivot < SMALLEST_SAFE_PIVOT
        {
            self.smallest_pivot = SMALLEST_SAFE_PIVOT;
            rhs.copy_from_slice(&wanted);
            if !self.factor(values)? || !self.solve(rhs) {
                return Ok(false);
            }
            self.refine(values, &wanted, rhs, (motions, accuracy));
        }
        Ok(true)
    }

    /// What a residual of `A x = b` is large or small beside: what rounding of the product leaves,
    /// of a small right side much, is none of the factors' fault.
    fn size(&self, b: &[f64], x: &[f64]) -> f64 {
        largest(b).max(self.largest_entry() * largest(x))
    }

    /// Refines the solution `x` of `A x = b`; returns the largest residual that is left.
    fn refine(
        &mut self,
        values: &[f64],
        b: &[f64],
        x: &mut [f64],
        (motions, accuracy): (usize, f64),
    ) -> f64 {
        let mut rest = self.residual(values, b, x);
        let enough = ACCURATE * largest(b);
        self.accurate = largest(&rest) <= enough;
        for refinement in 0..REFINEMENTS {
            if largest(&rest) <= enough {
                break;
            }
            let mut better = rest.clone();
            if !self.solve(&mut better) {
                break;
            }
            if refinement == 0 {
                self.correction = largest(&better[..motions]) / largest(&x[..motions]);
            }
            better.iter_mut().zip(&*x).for_each(|(b, x)| *b += x);
            let left = self.residual(values, b, &better);
            // Written so that NaN ends it too.
            let (before, after) = (largest(&rest), largest(&left));
            let improved = after < before;
            if !improved {
                break;
            }
            x.copy_from_slice(&better);
            rest = left;
            // The next one changes motions by the square of what the first has.
            let is_enough = accuracy >= FINER * COARSE
                && self.correction * self.correction <= UNREFINED * accuracy
                && after <= INACCURATE * self.size(b, x);
            if is_enough || after > STANDS * before {
                break;
            }
        }
        largest(&rest)
    }

    /// `b − A x`.
    fn residual(&self, values: &[f64], b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut rest = b.to_vec();
        self.workers
            .work()
            .spend(SUBSTITUTION * values.len() as f64);
        self.subtract_panels(values, x, &mut rest);
        rest
    }

    /// Changes a vector in the order of the groups that are eliminated.
    fn in_order(&self, x: &mut [f64], change: impl FnOnce(&mut [f64]) -> bool) -> bool {
        let mut ordered = Vec::new();
        self.put_in_order(x, &mut ordered);
        let changed = change(x);
        self.put_back(x, &mut ordered);
        changed
    }

    /// Puts a vector in the order of the groups that are eliminated.
    fn put_in_order(&self, x: &mut [f64], ordered: &mut Vec<f64>) {
        if let Some(places) = &self.analysis.places {
            ordered.resize(x.len(), 0.0);
            for (&place, x) in places.iter().zip(&*x) {
                ordered[place] = *x;
            }
            x.copy_from_slice(ordered);
        }
    }

    /// The reverse.
    fn put_back(&self, x: &mut [f64], ordered: &mut Vec<f64>) {
        if let Some(places) = &self.analysis.places {
            ordered.clear();
            ordered.extend_from_slice(x);
            for (&place, x) in places.iter().zip(x) {
                *x = ordered[place];
            }
        }
    }

    /// Entries of the vector `from` at some places, and those of some groups.
    fn gather(&self, places: &[usize], groups: &[usize], from: &[f64], to: &mut Vec<f64>) {
        to.resize(places.len() + self.analysis.size_of(groups), 0.0);
        self.gather_to(places, groups, from, to);
    }

    /// The same, to as many numbers.
    fn gather_to(&self, places: &[usize], groups: &[usize], from: &[f64], to: &mut [f64]) {
        let (single, mut to) = to.split_at_mut(places.len());
        for (to, &place) in single.iter_mut().zip(places) {
            *to = from[place];
        }
        for &g in groups {
            let from = &from[self.analysis.groups[g].clone()];
            let (part, others) = to.split_at_mut(from.len());
            part.copy_from_slice(from);
            to = others;
        }
    }

    /// The reverse.
    fn scatter(&self, places: &[usize], groups: &[usize], from: &[f64], to: &mut [f64]) {
        let (single, mut from) = from.split_at(places.len());
        for (&place, x) in places.iter().zip(single) {
            to[place] = *x;
        }
        for &g in groups {
            let (part, others) = from.split_at(self.analysis.groups[g].len());
            to[self.analysis.groups[g].clone()].copy_from_slice(part);
            from = others;
        }
    }
}

/// Whether a permutation takes an odd number of exchanges.
pub(crate) fn is_odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        // A cycle of length l takes l - 1 exchanges.
        let mut next = start;
        let mut length = 0;
        while !seen[next] {
            seen[next] = true;
            next = permutation[next];
            length += 1;
        }
        odd ^= length > 0 && length % 2 == 0;
    }
    odd
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::{Coordinate, JointKind};
    use crate::model::{JointCoordinate, Model, SectionInput, Signal, SpringDefinition};
    use crate::solve::test_models::Linearised;
    use faer::Mat;
    use faer::linalg::solvers::Solve;
    use nalgebra::{Matrix3, Vector3};

    /// A turning rigid crank, a rigid link with a spring, and a beam: diagonal blocks of the rigid
    /// bodies are singular, so that they must wait for their joints.
    fn mechanism() -> Model {
        let mut model = Model::new();
        let at = |x: f64| Vector3::new(x, 0.0, 0.0);
        let ball = Matrix3::identity() * 0.1;
        let crank = model.add_rigid_body(2.0, &at(0.5), &ball).unwrap();
        let link = model.add_rigid_body(1.0, &at(1.5), &ball).unwrap();
        let section = SectionInput::diagonal(&[1e4, 4e3, 4e3, 50.0, 80.0, 80.0], &[1.0; 4]);
        let beam = model
            .add_straight_beam(&at(2.0), &at(3.0), &Vector3::y(), &section.unwrap(), 3, 2)
            .unwrap();
        let hinge = |x: f64| Model::frame_at("axis", &at(x), &Vector3::z()).unwrap();
        let mut join = |first, second, x| {
            model
                .add_joint(JointKind::Revolute, first, second, &hinge(x), &hinge(x))
                .unwrap()
        };
        let shaft = join(None, Some(crank), 0.0);
        let knee = join(Some(crank), Some(link), 1.0);
        let root = join(Some(link), Some(beam.first_node), 2.0);
        let coordinate = Coordinate::Rotation1;
        let turn = Signal::harmonics(0.0, 3.0, &[], &[]).unwrap();
        model
            .prescribe(
                JointCoordinate {
                    joint: shaft,
                    coordinate,
                },
                &turn,
            )
            .unwrap();
        for (joint, stiffness) in [(knee, 30.0), (root, 20.0)] {
            let spring = SpringDefinition {
                at: JointCoordinate { joint, coordinate },
                stiffness,
                damping: 1.0,
                rest: 0.0,
            };
            model.add_spring_damper(spring).unwrap();
        }
        model
    }

    /// How a shaft is held.
    #[derive(Clone, Copy)]
    enum Support {
        Hinge,
        Springs,
    }

    /// A turning shaft of `count` beams in a row, which rigid joints join, each `throw` beside the
    /// one before, there and back.
    fn shaft(count: usize, throw: f64, support: Support) -> Model {
        let mut model = Model::new();
        let at = |i: usize, y: usize| Vector3::new(0.1 * i as f64, throw * (y % 2) as f64, 0.0);
        let stiffness = [5e8, 2e8, 2e8, 7e4, 9e4, 9e4];
        let section = SectionInput::diagonal(&stiffness, &[18.0, 7e-3, 3.5e-3, 3.5e-3]).unwrap();
        let mut ends: Vec<(usize, usize)> = Vec::new();
        for i in 0..count {
            let beam = model
                .add_straight_beam(&at(i, i), &at(i + 1, i), &Vector3::z(), &section, 1, 2)
                .unwrap();
            if let Some(&(_, last)) = ends.last() {
                let middle = (at(i, i - 1) + at(i, i)) / 2.0;
                let frame = Model::frame_at("joint", &middle, &Vector3::x()).unwrap();
                let (kind, first, second) = (JointKind::Rigid, last, beam.first_node);
                model
                    .add_joint(kind, Some(first), Some(second), &frame, &frame)
                    .unwrap();
            }
            ends.push((beam.first_node, beam.last_node));
        }
        let mut hold = |kind, i: usize| {
            let frame = Model::frame_at("support", &at(i, i), &Vector3::x()).unwrap();
            let node = Some(ends[i].0);
            model.add_joint(kind, None, node, &frame, &frame).unwrap()
        };
        // A turn about the shaft.
        let (joint, coordinate, bearings) = match support {
            Support::Hinge => (
                hold(JointKind::Revolute, 0),
                Coordinate::Rotation1,
                Vec::new(),
            ),
            Support::Springs => {
                let places = [0, count / 2, count - 1];
                let bearings = places.map(|i| hold(JointKind::Free, i));
                (bearings[0], Coordinate::Rotation3, bearings.to_vec())
            }
        };
        for joint in bearings {
            for coordinate in [
                Coordinate::Displacement1,
                Coordinate::Displacement2,
                Coordinate::Displacement3,
            ] {
                let spring = SpringDefinition {
                    at: JointCoordinate { joint, coordinate },
                    stiffness: 1e8,
                    damping: 1e4,
                    rest: 0.0,
                };
                model.add_spring_damper(spring).unwrap();
            }
        }
        let turn = Signal::harmonics(0.0, 3.0, &[], &[]).unwrap();
        model
            .prescribe(JointCoordinate { joint, coordinate }, &turn)
            .unwrap();
        model
    }

    #[test]
    fn factors_of_a_shaft_on_springs_are_as_small_as_with_a_hinge() {
        let points = 5;
        let period = std::f64::consts::TAU / 3.0;
        let size = |model: &Model| {
            let Linearised {
                pattern, values, ..
            } = Linearised::new(model, period, points, |_| 0.0);
            // Whatever acts on what.
            let (groups, nodes) = (pattern.groups(), pattern.node_groups());
            let structure = Structure::new(groups, nodes, pattern.panels());
            let mut solver = DirectSolver::of_structure(structure, Workers::default());
            assert!(solver.factor(&values).unwrap());
            let count = pattern.size();
            let exact: Vec<f64> = (0..count).map(|i| (0.7 * i as f64).sin()).collect();
            let minus = solver.residual(&values, &vec![0.0; count], &exact);
            let wanted: Vec<f64> = minus.iter().map(|b| -b).collect();
            let mut found = wanted.clone();
            let all = |accuracy| (count, accuracy);
            assert!(
                solver
                    .solve_refined(&values, &mut found, all(1e-8))
                    .unwrap()
            );
            let left = largest(&solver.residual(&values, &wanted, &found));
            // What refinement leaves at most.
            assert!(left <= ACCURATE * largest(&wanted), "{left:e}");
            // Another one, to few digits.
            let mut roughly = wanted.clone();
            assert!(
                solver
                    .solve_refined(&values, &mut roughly, all(COARSE))
                    .unwrap()
            );
            let errors = roughly.iter().zip(&found).map(|(a, b)| a - b);
            let errors: Vec<f64> = errors.collect();
            assert!(largest(&errors) <= COARSE * largest(&found));
            solver.size_of_factors()
        };
        for throw in [0.0, 0.05] {
            let sizes = [10, 20, 40].map(|count| {
                let hinge = size(&shaft(count, throw, Support::Hinge));
                let springs = size(&shaft(count, throw, Support::Springs));
                // Each beam leaves 6 of its 90 unknowns, its motions as a whole, until it is joined
                // to what is held.
                assert!(
                    springs as f64 <= 1.2 * hinge as f64,
                    "{count} beams: {springs} numbers instead of {hinge}"
                );
                springs as f64
            });
            // In proportion to the beams.
            for pair in sizes.windows(2) {
                assert!(pair[1] < 2.2 * pair[0], "{sizes:?}");
            }
        }
    }

    #[test]
    fn solves_what_a_dense_factorisation_solves() {
        for (points, threads) in [(1, 1), (3, 1), (7, 1), (7, 3), (21, 3)] {
            let period = std::f64::consts::TAU / 3.0;
            let linearised = Linearised::new(&mechanism(), period, points, |_| 0.0);
            let dense = linearised.dense();
            let Linearised {
                pattern, values, ..
            } = linearised;
            let size = pattern.size();
            let exact = Mat::from_fn(size, 1, |i, _| (0.7 * i as f64).sin());
            let rhs = &dense * &exact;
            let mut solver = DirectSolver::new(&pattern, Workers::new(threads).unwrap());
            assert!(solver.factor(&values).unwrap());
            assert!(
                solver.fronts.iter().any(|f| !f.delayed_rows.is_empty()),
                "nothing had to wait"
            );
            let mut found = rhs.col_as_slice(0).to_vec();
            assert!(solver.solve(&mut found));
            // By several threads, however little there is to do.
            let mut shared = rhs.col_as_slice(0).to_vec();
            let three = Workers::new(3).unwrap();
            solver.in_order(&mut shared, |rhs| {
                solver.solve_shared(rhs, &solver.divided(&three), &three);
                true
            });
            let reference = dense.partial_piv_lu().solve(&rhs);
            let error = |x: &dyn Fn(usize) -> f64| {
                (0..size).fold(0.0, |m: f64, i| m.max((x(i) - exact[(i, 0)]).abs()))
            };
            // As accurate as partial pivoting over the whole matrix, but for a small factor.
            let (ours, theirs) = (error(&|i| found[i]), error(&|i| reference[(i, 0)]));
            let mut transposed = (dense.transpose() * &exact).col_as_slice(0).to_vec();
            assert!(solver.solve_transposed(&mut transposed));
            // Together with one of another size and sign.
            let mut several = Mat::from_fn(size, 2, |i, j| [-2.0, 1.0][j] * rhs[(i, 0)]);
            let mut memory = Columns::default();
            assert!(solver.solve_columns(several.as_mut(), &mut memory).unwrap());
            for ours in [
                ours,
                error(&|i| shared[i]),
                error(&|i| transposed[i]),
                error(&|i| -0.5 * several[(i, 0)]),
                error(&|i| several[(i, 1)]),
            ] {
                assert!(
                    ours < 100.0 * theirs.max(1e-13),
                    "{points}: {ours:e} against {theirs:e}"
                );
            }
        }
    }
}
