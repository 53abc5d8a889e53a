//! Direct solution of the Jacobian by blocks: multifrontal LU over the graph of nodes and
//! multipliers, with the N grid points of each kept together, so that all work is done by faer's
//! dense kernels. See docs/theory.md, section 8.1.

use crate::collocation::{Panel, Pattern};
use crate::error::Result;
use crate::solve::linear::dense::{largest, solve_unit_lower, solve_upper, subtract_product};
use crate::solve::linear::front::{Front, FrontWorkspace, LARGE_FRONT, make_zero};
use crate::solve::linear::ordering::{FrontPlan, plan};
use crate::workers::{Spare, Workers, parts};
use faer::{Mat, Par};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::collections::BTreeSet;
use std::iter::once;
use std::ops::Range;

/// A pivot smaller than this, relative to its column, waits for constraints to be eliminated with.
const SMALLEST_PIVOT: f64 = 1e-9;
/// The same, once a solve was not accurate enough: more waits, and larger fronts are factored.
const SMALLEST_SAFE_PIVOT: f64 = 1e-5;
/// Residual of a solve, relative to its right-hand side, that needs no refinement.
const ACCURATE: f64 = 1e-10;
/// Residual of a refined solve that calls for safer pivots, relative to the right-hand side or, if
/// that is more, to the largest number that the product may add up.
const INACCURATE: f64 = 1e-9;
/// Most forks of the tree of fronts, one above the other, where threads part: each takes memory on
/// the stack.
const MOST_FORKS: usize = 32;
/// Most refinements of a solve.
const REFINEMENTS: usize = 4;

/// What does not depend on the values of a matrix.
#[derive(Debug)]
struct Analysis {
    groups: Vec<Range<usize>>,
    plans: Vec<FrontPlan>,
    /// Entries of the matrix that enter each front.
    panels: Vec<Vec<Panel>>,
    /// Of each front with all those that lead to it, which come just before it: multiply-adds, and
    /// their number.
    subtrees: Vec<(f64, usize)>,
}

/// Direct solver for matrices of one pattern.
#[derive(Debug)]
pub struct DirectSolver {
    analysis: Analysis,
    fronts: Vec<Front>,
    factored: bool,
    /// Largest entry of the matrix.
    largest_entry: f64,
    /// Whether solves with the present factors are known to need no refinement.
    accurate: bool,
    smallest_pivot: f64,
    workers: Workers,
}

/// What a factorisation is of, and how.
struct Factorisation<'a> {
    analysis: &'a Analysis,
    values: &'a [f64],
    smallest_pivot: f64,
    workspaces: Spare<FrontWorkspace>,
    workers: &'a Workers,
}

impl Analysis {
    fn new(groups: Vec<Range<usize>>, node_groups: usize, all_panels: Vec<Panel>) -> Self {
        let mut coupled = vec![BTreeSet::new(); groups.len()];
        for panel in &all_panels {
            coupled[panel.row.0].insert(panel.column.0);
            coupled[panel.column.0].insert(panel.row.0);
        }
        let sizes: Vec<usize> = groups.iter().map(ExactSizeIterator::len).collect();
        let plans = plan(&sizes, &coupled, node_groups);
        let mut front_of = vec![0; groups.len()];
        for (f, front) in plans.iter().enumerate() {
            for &g in &front.own {
                front_of[g] = f;
            }
        }
        // An entry enters the front that is first to eliminate its row or column.
        let mut panels = vec![Vec::new(); plans.len()];
        for panel in all_panels {
            panels[front_of[panel.row.0].min(front_of[panel.column.0])].push(panel);
        }
        let size = |groups: &[usize]| groups.iter().map(|&g| sizes[g]).sum::<usize>();
        let mut subtrees: Vec<(f64, usize)> = Vec::with_capacity(plans.len());
        for front in &plans {
            let own = elimination_work(size(&front.own), size(&front.boundary));
            let children = front.children.iter().map(|&child| subtrees[child]);
            subtrees.push(children.fold((own, 1), |sum, child| (sum.0 + child.0, sum.1 + child.1)));
        }
        Analysis {
            groups,
            plans,
            panels,
            subtrees,
        }
    }

    /// The fronts that have no parents.
    fn roots(&self) -> Vec<usize> {
        let all = 0..self.plans.len();
        all.filter(|&f| self.plans[f].parent.is_none()).collect()
    }

    /// Multiply-adds of a factorisation, as planned.
    fn work(&self) -> f64 {
        self.roots().iter().map(|&root| self.subtrees[root].0).sum()
    }

    /// The subtrees that end with these fronts, which are in order, from `fronts` that begin with
    /// their first.
    fn split<'f>(&self, roots: &[usize], fronts: &'f mut [Front]) -> Vec<(usize, &'f mut [Front])> {
        let counts = roots.iter().map(|&root| self.subtrees[root].1);
        roots.iter().copied().zip(parts(fronts, counts)).collect()
    }

    fn size_of(&self, groups: &[usize]) -> usize {
        groups.iter().map(|&g| self.groups[g].len()).sum()
    }
}

impl Factorisation<'_> {
    /// Factors subtrees, each with its fronts, in parallel. `false` if a singular front has no
    /// parent.
    fn factor_all(
        &self,
        subtrees: Vec<(usize, &mut [Front])>,
        forks: usize,
        parallelism: Par,
    ) -> Result<bool> {
        let results = subtrees
            .into_par_iter()
            .map(|(root, fronts)| self.factor_subtree(root, fronts, forks, parallelism));
        results.reduce(|| Ok(true), |a, b| Ok(a? && b?))
    }

    /// Factors a subtree; where it divides, in parallel, for so many forks one above the other.
    fn factor_subtree(
        &self,
        root: usize,
        fronts: &mut [Front],
        forks: usize,
        parallelism: Par,
    ) -> Result<bool> {
        let analysis = self.analysis;
        let first = root + 1 - fronts.len();
        let mut fork = root;
        while let [child] = analysis.plans[fork].children[..] {
            fork = child;
        }
        let mut next = first;
        if forks > 0 && analysis.subtrees[fork].0 > LARGE_FRONT {
            let before = &mut fronts[..fork - first];
            let subtrees = analysis.split(&analysis.plans[fork].children, before);
            if !self.factor_all(subtrees, forks - 1, parallelism)? {
                return Ok(false);
            }
            next = fork;
        }
        self.factor_in_order(next..root + 1, (first, fronts), parallelism)
    }

    /// Factors some of `fronts`, of which front `first` is the first, one after the other; what
    /// leads to them has been factored.
    fn factor_in_order(
        &self,
        some: Range<usize>,
        (first, fronts): (usize, &mut [Front]),
        parallelism: Par,
    ) -> Result<bool> {
        let mut workspace = self
            .workspaces
            .take(|| FrontWorkspace::new(self.analysis.groups.len(), self.workers));
        for f in some {
            self.workers.pulse()?;
            if !self.factor(f, (first, fronts), &mut workspace, parallelism)? {
                return Ok(false);
            }
        }
        self.workspaces.give(workspace);
        Ok(true)
    }

    /// Factors front `f`, one of `fronts`, of which front `first` is the first. `false` if it is
    /// singular and has no parent.
    fn factor(
        &self,
        f: usize,
        (first, fronts): (usize, &mut [Front]),
        workspace: &mut FrontWorkspace,
        parallelism: Par,
    ) -> Result<bool> {
        let analysis = self.analysis;
        let plan = &analysis.plans[f];
        let (before, front) = fronts.split_at_mut(f - first);
        let front = &mut front[0];
        front.rows.clear();
        for &g in &plan.own {
            workspace.place[g] = front.rows.len();
            front.rows.extend(analysis.groups[g].clone());
        }
        front.columns.clone_from(&front.rows);
        workspace.sizes.clear();
        workspace.sizes.resize(front.rows.len(), 0.0);
        for &child in &plan.children {
            let child = &before[child - first];
            front.rows.extend(&child.delayed_rows);
            front.columns.extend(&child.delayed_columns);
            workspace.sizes.extend(&child.delayed_sizes);
        }
        let mut size = front.rows.len();
        for &g in &plan.boundary {
            workspace.place[g] = size;
            size += analysis.groups[g].len();
        }
        let assemble = |front: &mut Front, place: &[usize]| {
            self.assemble(f, (first, &*before), place, (front, size))
        };
        let smallest_pivot = plan.parent.map(|_| self.smallest_pivot);
        if !front.eliminate(assemble, smallest_pivot, workspace, parallelism)? {
            return Ok(false);
        }
        for &child in &plan.children {
            before[child - first].remainder = Mat::new();
        }
        // Where the entries have just been read.
        front.largest_entry = 0.0;
        for panel in &analysis.panels[f] {
            for column in 0..panel.columns {
                let entries = &self.values[panel.value + column * panel.stride..][..panel.rows];
                front.largest_entry = front.largest_entry.max(largest(entries));
            }
        }
        Ok(true)
    }

    /// Sums up front `f` of `size` unknowns from the matrix and what is left of the fronts that
    /// lead to it, which are among `fronts` from front `first` on. Group `g` begins at `place[g]`.
    fn assemble(
        &self,
        f: usize,
        (first, fronts): (usize, &[Front]),
        place: &[usize],
        (front, size): (&mut Front, usize),
    ) -> Result<()> {
        let analysis = self.analysis;
        let plan = &analysis.plans[f];
        let count = front.rows.len();
        let rest = size - count;
        make_zero(&mut front.upper, count, size)?;
        make_zero(&mut front.lower, rest, count)?;
        make_zero(&mut front.remainder, rest, rest)?;
        // Part of a column, of rows that belong together.
        let mut part =
            |row: usize, column: usize, length: usize, work: &mut dyn FnMut(&mut [f64])| {
                let whole = if row < count {
                    &mut front.upper.col_as_slice_mut(column)[row..]
                } else if column < count {
                    &mut front.lower.col_as_slice_mut(column)[row - count..]
                } else {
                    &mut front.remainder.col_as_slice_mut(column - count)[row - count..]
                };
                work(&mut whole[..length]);
            };
        for panel in &analysis.panels[f] {
            let row = place[panel.row.0] + panel.row.1;
            let first = place[panel.column.0] + panel.column.1;
            for column in 0..panel.columns {
                let entries = &self.values[panel.value + column * panel.stride..][..panel.rows];
                part(row, first + column, panel.rows, &mut |to| {
                    to.copy_from_slice(entries);
                });
            }
        }
        // Behind the own groups comes what the fronts that lead here have delayed.
        let mut delayed_place = analysis.size_of(&plan.own);
        for &child in &plan.children {
            let delayed = fronts[child - first].delayed_rows.len();
            let groups = &analysis.plans[child].boundary;
            let groups = groups.iter().map(|&g| (place[g], analysis.groups[g].len()));
            let parts: Vec<(usize, usize)> = once((delayed_place, delayed)).chain(groups).collect();
            delayed_place += delayed;
            let remainder = &fronts[child - first].remainder;
            let columns = parts
                .iter()
                .flat_map(|&(place, length)| place..place + length);
            for (source_column, column) in columns.enumerate() {
                let mut source = remainder.col_as_slice(source_column);
                for &(row, length) in &parts {
                    let (entries, others) = source.split_at(length);
                    source = others;
                    part(row, column, length, &mut |to| {
                        to.iter_mut().zip(entries).for_each(|(t, s)| *t += s);
                    });
                }
            }
        }
        Ok(())
    }
}

impl DirectSolver {
    /// Orders and analyses matrices of `pattern`.
    pub fn new(pattern: &Pattern) -> Self {
        Self::with_panels(pattern.groups(), pattern.node_groups(), pattern.panels())
    }

    /// The same for matrices with the entries of `panels`, whose unknowns are kept together in
    /// `groups`; the first `node_groups` of them are those of nodes.
    pub fn with_panels(
        groups: Vec<Range<usize>>,
        node_groups: usize,
        panels: impl IntoIterator<Item = Panel>,
    ) -> Self {
        let analysis = Analysis::new(groups, node_groups, panels.into_iter().collect());
        DirectSolver {
            fronts: analysis.plans.iter().map(|_| Front::empty()).collect(),
            analysis,
            workers: Workers::default(),
            factored: false,
            largest_entry: 0.0,
            accurate: false,
            smallest_pivot: SMALLEST_PIVOT,
        }
    }

    /// Shares the work of factorisations among these threads.
    pub fn set_workers(&mut self, workers: Workers) {
        self.workers = workers;
    }

    /// Factors the matrix with these values. `false` if it is singular.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn factor(&mut self, values: &[f64]) -> Result<bool> {
        self.accurate = false;
        self.factored = false;
        let regular = self.factor_fronts(values);
        for front in &mut self.fronts {
            front.remainder = Mat::new();
        }
        self.factored = regular?;
        let entries = self.fronts.iter().map(|front| front.largest_entry);
        self.largest_entry = entries.fold(0.0, f64::max);
        Ok(self.factored)
    }

    fn factor_fronts(&mut self, values: &[f64]) -> Result<bool> {
        let analysis = &self.analysis;
        let workers = self.workers.for_work(analysis.work() as usize);
        let factorisation = Factorisation {
            analysis,
            values,
            smallest_pivot: self.smallest_pivot,
            workspaces: Spare::default(),
            workers: &workers,
        };
        let fronts = &mut self.fronts[..];
        workers.dense(|parallelism| match parallelism {
            Par::Seq => factorisation.factor_in_order(0..fronts.len(), (0, fronts), parallelism),
            Par::Rayon(_) => {
                let subtrees = analysis.split(&analysis.roots(), fronts);
                factorisation.factor_all(subtrees, MOST_FORKS, parallelism)
            }
        })
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
                let pivot = front.upper[(j, j)];
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

    /// Solves in place. `false` if there are no factors or the result is not finite.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        if !self.factored {
            return false;
        }
        // What each front's equations come to, one front after the other.
        let mut reduced = Vec::with_capacity(rhs.len());
        let mut local = Vec::new();
        for (plan, front) in self.analysis.plans.iter().zip(&self.fronts) {
            // Whether work is to end is asked where it may fail.
            let _ = self.workers.pulse();
            let first = reduced.len();
            reduced.extend(front.rows.iter().map(|&row| rhs[row]));
            let y = &mut reduced[first..];
            solve_unit_lower(|j| front.upper.col_as_slice(j), y);
            self.gather(&front.delayed_rows, &plan.boundary, rhs, &mut local);
            subtract_product(&mut local, |j| front.lower.col_as_slice(j), y);
            self.scatter(&front.delayed_rows, &plan.boundary, &local, rhs);
        }
        for (plan, front) in self.analysis.plans.iter().zip(&self.fronts).rev() {
            let _ = self.workers.pulse();
            let count = front.rows.len();
            let y = &mut reduced[..];
            let (_, y) = y.split_at_mut(y.len() - count);
            self.gather(&front.delayed_columns, &plan.boundary, rhs, &mut local);
            subtract_product(y, |j| front.upper.col_as_slice(count + j), &local);
            solve_upper(|j| front.upper.col_as_slice(j), y);
            for (&column, x) in front.columns.iter().zip(&*y) {
                rhs[column] = *x;
            }
            reduced.truncate(reduced.len() - count);
        }
        rhs.iter().all(|x| x.is_finite())
    }

    /// Numbers that the factors take.
    #[cfg(test)]
    fn size_of_factors(&self) -> usize {
        let sizes = self.fronts.iter().map(|front| {
            let (upper, lower) = (&front.upper, &front.lower);
            upper.nrows() * upper.ncols() + lower.nrows() * lower.ncols()
        });
        sizes.sum()
    }

    /// As [`DirectSolver::solve`], for the `values` of the matrix that was factored: refines the
    /// result by its residual, unless an earlier one with the same factors was accurate. Pivots are
    /// sought within a front only: where that has cost too many digits, the matrix is factored
    /// again with more of them waiting.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn solve_refined(&mut self, values: &[f64], rhs: &mut [f64]) -> Result<bool> {
        if self.accurate {
            return Ok(self.solve(rhs));
        }
        let wanted = rhs.to_vec();
        if !self.solve(rhs) {
            return Ok(false);
        }
        let left = self.refine(values, &wanted, rhs);
        // What rounding of the product leaves, of a small right side much, is none of the factors'
        // fault.
        let size = largest(&wanted).max(self.largest_entry() * largest(rhs));
        if left > INACCURATE * size && self.smallest_pivot < SMALLEST_SAFE_PIVOT {
            self.smallest_pivot = SMALLEST_SAFE_PIVOT;
            rhs.copy_from_slice(&wanted);
            if !self.factor(values)? || !self.solve(rhs) {
                return Ok(false);
            }
            self.refine(values, &wanted, rhs);
        }
        Ok(true)
    }

    /// Refines the solution `x` of `A x = b`; returns the largest residual that is left.
    fn refine(&mut self, values: &[f64], b: &[f64], x: &mut [f64]) -> f64 {
        let mut rest = self.residual(values, b, x);
        let enough = ACCURATE * largest(b);
        self.accurate = largest(&rest) <= enough;
        for _ in 0..REFINEMENTS {
            if largest(&rest) <= enough {
                break;
            }
            let mut better = rest.clone();
            if !self.solve(&mut better) {
                break;
            }
            better.iter_mut().zip(&*x).for_each(|(b, x)| *b += x);
            let left = self.residual(values, b, &better);
            // Written so that NaN ends it too.
            let improved = largest(&left) < largest(&rest);
            if !improved {
                break;
            }
            x.copy_from_slice(&better);
            rest = left;
        }
        largest(&rest)
    }

    /// `b − A x`.
    fn residual(&self, values: &[f64], b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut rest = b.to_vec();
        for panel in self.analysis.panels.iter().flatten() {
            let row = self.analysis.groups[panel.row.0].start + panel.row.1;
            let column = self.analysis.groups[panel.column.0].start + panel.column.1;
            subtract_product(
                &mut rest[row..][..panel.rows],
                |j| &values[panel.value + j * panel.stride..][..panel.rows],
                &x[column..][..panel.columns],
            );
        }
        rest
    }

    /// Entries of the vector `from` at some places, and those of some groups.
    fn gather(&self, places: &[usize], groups: &[usize], from: &[f64], to: &mut Vec<f64>) {
        to.clear();
        to.extend(places.iter().map(|&place| from[place]));
        for &g in groups {
            to.extend_from_slice(&from[self.analysis.groups[g].clone()]);
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

/// Multiply-adds of the elimination of so many unknowns, with so many others in their rows and
/// columns.
pub(crate) fn elimination_work(count: usize, rest: usize) -> f64 {
    let (own, rest) = (count as f64, rest as f64);
    own * own * own / 3.0 + own * own * rest + own * rest * rest
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
            let mut solver = DirectSolver::new(&pattern);
            assert!(solver.factor(&values).unwrap());
            let count = pattern.size();
            let exact: Vec<f64> = (0..count).map(|i| (0.7 * i as f64).sin()).collect();
            let minus = solver.residual(&values, &vec![0.0; count], &exact);
            let wanted: Vec<f64> = minus.iter().map(|b| -b).collect();
            let mut found = wanted.clone();
            assert!(solver.solve_refined(&values, &mut found).unwrap());
            let left = largest(&solver.residual(&values, &wanted, &found));
            // What refinement leaves at most.
            assert!(left <= ACCURATE * largest(&wanted), "{left:e}");
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
            let mut solver = DirectSolver::new(&pattern);
            solver.set_workers(Workers::new(threads).unwrap());
            assert!(solver.factor(&values).unwrap());
            assert!(
                solver.fronts.iter().any(|f| !f.delayed_rows.is_empty()),
                "nothing had to wait"
            );
            let mut found = rhs.col_as_slice(0).to_vec();
            assert!(solver.solve(&mut found));
            let reference = dense.partial_piv_lu().solve(&rhs);
            let error = |x: &dyn Fn(usize) -> f64| {
                (0..size).fold(0.0, |m: f64, i| m.max((x(i) - exact[(i, 0)]).abs()))
            };
            // As accurate as partial pivoting over the whole matrix, but for a small factor.
            let (ours, theirs) = (error(&|i| found[i]), error(&|i| reference[(i, 0)]));
            assert!(
                ours < 100.0 * theirs.max(1e-13),
                "{points}: {ours:e} against {theirs:e}"
            );
        }
    }
}
