//! Direct solution of the Jacobian by blocks: multifrontal LU over the graph of nodes and multipliers, with
//! the N grid points of each kept together, so that all work is done by faer's dense kernels.

use super::ordering::{FrontPlan, plan};
use crate::collocation::Pattern;
use crate::error::{Error, ErrorKind, Result};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
};
use faer::{Accum, Mat, Par};
use std::collections::BTreeSet;
use std::ops::Range;

/// A pivot smaller than this, relative to its column, waits for constraints to be eliminated with.
const SMALLEST_PIVOT: f64 = 1e-9;
/// The same, once a solve was not accurate enough: more waits, and larger fronts are factored.
const SMALLEST_SAFE_PIVOT: f64 = 1e-5;
/// Residual of a solve, relative to its right-hand side, that needs no refinement.
const ACCURATE: f64 = 1e-10;
/// Residual of a refined solve that calls for safer pivots.
const INACCURATE: f64 = 1e-9;
/// Most refinements of a solve.
const REFINEMENTS: usize = 4;

/// Consecutive entries of one column within one block.
#[derive(Debug, Clone)]
struct Run {
    value: usize,
    length: usize,
    row: (usize, usize),
    column: (usize, usize),
}

/// Factors of one front: `P F₁₁ = L U`, `U₁₂`, `L₂₁`.
#[derive(Debug)]
struct FrontFactors {
    pivots: Vec<usize>,
    permutation: Vec<usize>,
    /// `L`, `U` and, to their right, `U₁₂`.
    upper: Mat<f64>,
    /// `L₂₁`.
    lower: Mat<f64>,
}

/// What a front leaves to its parent.
struct Remainder {
    groups: Vec<usize>,
    /// How many of the groups were to be eliminated, but must wait.
    delayed: usize,
    schur: Mat<f64>,
}

/// Direct solver for matrices of one pattern.
#[derive(Debug)]
pub struct DirectSolver {
    groups: Vec<Range<usize>>,
    fronts: Vec<FrontPlan>,
    runs: Vec<Vec<Run>>,
    factors: Vec<FrontFactors>,
    smallest_pivot: f64,
}

impl DirectSolver {
    /// Orders and analyses matrices of `pattern`.
    pub fn new(pattern: &Pattern) -> Self {
        let structure = (pattern.column_pointers(), pattern.row_indices());
        Self::with_structure(pattern.groups(), pattern.node_groups(), structure)
    }

    /// The same for matrices with these column pointers and row indices, whose unknowns are kept together
    /// in `groups`; the first `node_groups` of them are those of nodes.
    pub fn with_structure(
        groups: Vec<Range<usize>>,
        node_groups: usize,
        (column_pointers, row_indices): (&[usize], &[usize]),
    ) -> Self {
        let mut group_of = vec![0; column_pointers.len() - 1];
        for (g, range) in groups.iter().enumerate() {
            group_of[range.clone()].fill(g);
        }
        let runs = all_runs(column_pointers, row_indices, &groups, &group_of);
        let mut coupled = vec![BTreeSet::new(); groups.len()];
        for run in &runs {
            coupled[run.row.0].insert(run.column.0);
            coupled[run.column.0].insert(run.row.0);
        }
        let sizes: Vec<usize> = groups.iter().map(ExactSizeIterator::len).collect();
        let fronts = plan(&sizes, &coupled, node_groups);
        let mut front_of = vec![0; groups.len()];
        for (f, front) in fronts.iter().enumerate() {
            for &g in &front.own {
                front_of[g] = f;
            }
        }
        // An entry enters the front that is first to eliminate its row or column.
        let mut runs_of = vec![Vec::new(); fronts.len()];
        for run in runs {
            runs_of[front_of[run.row.0].min(front_of[run.column.0])].push(run);
        }
        DirectSolver {
            groups,
            fronts,
            runs: runs_of,
            factors: Vec::new(),
            smallest_pivot: SMALLEST_PIVOT,
        }
    }

    fn size_of(&self, groups: &[usize]) -> usize {
        groups.iter().map(|&g| self.groups[g].len()).sum()
    }

    /// Factors the matrix with these values. `false` if it is singular.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn factor(&mut self, values: &[f64]) -> Result<bool> {
        self.factors.clear();
        let mut remainders: Vec<Option<Remainder>> = Vec::with_capacity(self.fronts.len());
        let mut place = vec![usize::MAX; self.groups.len()];
        for f in 0..self.fronts.len() {
            let plan = &self.fronts[f];
            let mut pivots = plan.own.clone();
            for &child in &plan.children {
                if let Some(r) = &remainders[child] {
                    pivots.extend(&r.groups[..r.delayed]);
                }
            }
            let mut size = 0;
            for &g in pivots.iter().chain(&plan.boundary) {
                place[g] = size;
                size += self.groups[g].len();
            }
            let mut front = zeros(size, size)?;
            for run in &self.runs[f] {
                let row = place[run.row.0] + run.row.1;
                let column = place[run.column.0] + run.column.1;
                let target = &mut front.col_as_slice_mut(column)[row..row + run.length];
                target.copy_from_slice(&values[run.value..run.value + run.length]);
            }
            for &child in &plan.children {
                if let Some(remainder) = remainders[child].take() {
                    self.add_remainder(&remainder, &place, &mut front);
                }
            }
            let boundary = plan.boundary.clone();
            let is_root = plan.parent.is_none();
            let count = self.size_of(&pivots);
            let smallest_pivot = if is_root { 0.0 } else { self.smallest_pivot };
            match eliminate(&front, count, smallest_pivot)? {
                Some((factors, schur)) => {
                    self.factors.push(FrontFactors { pivots, ..factors });
                    remainders.push(Some(Remainder {
                        groups: boundary,
                        delayed: 0,
                        schur,
                    }));
                }
                None if is_root => {
                    self.factors.clear();
                    return Ok(false);
                }
                None => {
                    // All of them wait; the factors are those of nothing.
                    let delayed = pivots.len();
                    let groups = pivots.into_iter().chain(boundary).collect();
                    self.factors.push(FrontFactors {
                        pivots: Vec::new(),
                        permutation: Vec::new(),
                        upper: Mat::new(),
                        lower: Mat::new(),
                    });
                    remainders.push(Some(Remainder {
                        groups,
                        delayed,
                        schur: front,
                    }));
                }
            }
        }
        Ok(true)
    }

    /// Adds a child's Schur complement to its parent's front.
    fn add_remainder(&self, remainder: &Remainder, place: &[usize], front: &mut Mat<f64>) {
        let mut source_column = 0;
        for &column_group in &remainder.groups {
            for offset in 0..self.groups[column_group].len() {
                let source = remainder.schur.col_as_slice(source_column);
                let target = front.col_as_slice_mut(place[column_group] + offset);
                let mut row = 0;
                for &row_group in &remainder.groups {
                    let length = self.groups[row_group].len();
                    let to = &mut target[place[row_group]..][..length];
                    for (t, s) in to.iter_mut().zip(&source[row..row + length]) {
                        *t += s;
                    }
                    row += length;
                }
                source_column += 1;
            }
        }
    }

    /// Sign and logarithm of the size of the determinant of the matrix that was factored.
    pub fn determinant(&self) -> (f64, f64) {
        let (mut sign, mut logarithm) = (1.0, 0.0);
        for front in &self.factors {
            for j in 0..front.permutation.len() {
                let pivot = front.upper[(j, j)];
                sign *= pivot.signum();
                logarithm += pivot.abs().ln();
            }
            if is_odd(&front.permutation) {
                sign = -sign;
            }
        }
        (sign, logarithm)
    }

    /// Solves in place. `false` if there are no factors or the result is not finite.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        if self.factors.is_empty() {
            return false;
        }
        let mut local = Vec::new();
        for (plan, front) in self.fronts.iter().zip(&self.factors) {
            let count = front.permutation.len();
            if count == 0 {
                continue;
            }
            self.gather(&front.pivots, rhs, &mut local);
            let mut y: Vec<f64> = front.permutation.iter().map(|&i| local[i]).collect();
            for j in 0..count {
                let column = &front.upper.col_as_slice(j)[j + 1..count];
                let pivot = y[j];
                subtract(&mut y[j + 1..], column, pivot);
            }
            self.gather(&plan.boundary, rhs, &mut local);
            for (j, pivot) in y.iter().enumerate() {
                subtract(&mut local, front.lower.col_as_slice(j), *pivot);
            }
            self.scatter(&plan.boundary, &local, rhs);
            self.scatter(&front.pivots, &y, rhs);
        }
        for (plan, front) in self.fronts.iter().zip(&self.factors).rev() {
            let count = front.permutation.len();
            if count == 0 {
                continue;
            }
            self.gather(&plan.boundary, rhs, &mut local);
            let beyond = local.clone();
            self.gather(&front.pivots, rhs, &mut local);
            for (j, x) in beyond.iter().enumerate() {
                subtract(&mut local, front.upper.col_as_slice(count + j), *x);
            }
            for j in (0..count).rev() {
                let column = front.upper.col_as_slice(j);
                let x = local[j] / column[j];
                local[j] = x;
                subtract(&mut local[..j], &column[..j], x);
            }
            self.scatter(&front.pivots, &local, rhs);
        }
        rhs.iter().all(|x| x.is_finite())
    }

    /// As [`DirectSolver::solve`], and refines the result by its residual, for the `values` of the matrix that
    /// was factored. Pivots are sought within a front only: where that has cost too many digits, the matrix is
    /// factored again with more of them waiting.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn solve_refined(&mut self, values: &[f64], rhs: &mut [f64]) -> Result<bool> {
        let wanted = rhs.to_vec();
        if !self.solve(rhs) {
            return Ok(false);
        }
        let left = self.refine(values, &wanted, rhs);
        if left > INACCURATE * largest(&wanted) && self.smallest_pivot < SMALLEST_SAFE_PIVOT {
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
    fn refine(&self, values: &[f64], b: &[f64], x: &mut [f64]) -> f64 {
        let mut rest = self.residual(values, b, x);
        for _ in 0..REFINEMENTS {
            if largest(&rest) <= ACCURATE * largest(b) {
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
        for run in self.runs.iter().flatten() {
            let (row, column) = (
                self.groups[run.row.0].start + run.row.1,
                self.groups[run.column.0].start + run.column.1,
            );
            let entries = &values[run.value..][..run.length];
            subtract(&mut rest[row..][..run.length], entries, x[column]);
        }
        rest
    }

    fn gather(&self, groups: &[usize], from: &[f64], to: &mut Vec<f64>) {
        to.clear();
        for &g in groups {
            to.extend_from_slice(&from[self.groups[g].clone()]);
        }
    }

    fn scatter(&self, groups: &[usize], from: &[f64], to: &mut [f64]) {
        let mut first = 0;
        for &g in groups {
            let length = self.groups[g].len();
            to[self.groups[g].clone()].copy_from_slice(&from[first..first + length]);
            first += length;
        }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// `y −= a x`, entry by entry.
fn subtract(y: &mut [f64], x: &[f64], a: f64) {
    for (y, x) in y.iter_mut().zip(x) {
        *y -= a * x;
    }
}

/// Whether a permutation takes an odd number of exchanges.
fn is_odd(permutation: &[usize]) -> bool {
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

fn zeros(rows: usize, columns: usize) -> Result<Mat<f64>> {
    let mut matrix = Mat::new();
    matrix.try_reserve(rows, columns).map_err(|_| {
        let message = format!("a dense block of {rows} × {columns} does not fit in memory");
        Error::new(ErrorKind::OutOfMemory, message)
    })?;
    matrix.resize_with(rows, columns, |_, _| 0.0);
    Ok(matrix)
}

/// All entries of the matrix as runs.
fn all_runs(
    column_pointers: &[usize],
    rows: &[usize],
    groups: &[Range<usize>],
    group_of: &[usize],
) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (column, range) in column_pointers.windows(2).enumerate() {
        let column_group = group_of[column];
        let mut start = range[0];
        while start < range[1] {
            let group = group_of[rows[start]];
            let mut end = start + 1;
            while end < range[1] && rows[end] == rows[end - 1] + 1 && group_of[rows[end]] == group {
                end += 1;
            }
            runs.push(Run {
                value: start,
                length: end - start,
                row: (group, rows[start] - groups[group].start),
                column: (column_group, column - groups[column_group].start),
            });
            start = end;
        }
    }
    runs
}

/// Eliminates the first `count` unknowns of a front: its factors, and the Schur complement of the rest.
///
/// `None` if the leading block is singular, or has a pivot below `smallest_pivot`, relative to its column.
fn eliminate(
    front: &Mat<f64>,
    count: usize,
    smallest_pivot: f64,
) -> Result<Option<(FrontFactors, Mat<f64>)>> {
    let size = front.nrows();
    let rest = size - count;
    let mut upper = zeros(count, size)?;
    upper
        .as_mut()
        .subcols_mut(0, count)
        .copy_from(front.as_ref().submatrix(0, 0, count, count));
    let column_size: Vec<f64> = (0..count)
        .map(|j| {
            upper
                .col_as_slice(j)
                .iter()
                .fold(0.0, |m: f64, x| m.max(x.abs()))
        })
        .collect();
    let mut permutation = vec![0usize; count];
    let mut inverse = vec![0usize; count];
    let mut memory = MemBuffer::new(lu_in_place_scratch::<usize, f64>(
        count,
        count,
        Par::Seq,
        Default::default(),
    ));
    lu_in_place(
        upper.as_mut().subcols_mut(0, count),
        &mut permutation,
        &mut inverse,
        Par::Seq,
        MemStack::new(&mut memory),
        Default::default(),
    );
    for (j, size) in column_size.iter().enumerate() {
        let pivot = upper[(j, j)].abs();
        // Written so that NaN fails too.
        let good = pivot > smallest_pivot * size && pivot.is_finite();
        if !good {
            return Ok(None);
        }
    }
    for j in count..size {
        let source = front.col_as_slice(j);
        for (to, &from) in upper.col_as_slice_mut(j).iter_mut().zip(&permutation) {
            *to = source[from];
        }
    }
    let mut lower = zeros(rest, count)?;
    lower.copy_from(front.as_ref().submatrix(count, 0, rest, count));
    let mut schur = zeros(rest, rest)?;
    schur.copy_from(front.as_ref().submatrix(count, count, rest, rest));
    {
        let (factors, beyond) = upper.as_mut().split_at_col_mut(count);
        let factors = factors.as_ref();
        solve_unit_lower_triangular_in_place(factors, beyond, Par::Seq);
        // L₂₁ U = F₂₁, transposed: Uᵀ L₂₁ᵀ = F₂₁ᵀ.
        let transposed = lower.as_mut().transpose_mut();
        solve_lower_triangular_in_place(factors.transpose(), transposed, Par::Seq);
    }
    let beyond = upper.as_ref().subcols(count, rest);
    matmul(
        schur.as_mut(),
        Accum::Add,
        lower.as_ref(),
        beyond,
        -1.0,
        Par::Seq,
    );
    let factors = FrontFactors {
        pivots: Vec::new(),
        permutation,
        upper,
        lower,
    };
    Ok(Some((factors, schur)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::{Collocation, GridState, TangentBlocks};
    use crate::elements::{Coordinate, JointKind};
    use crate::fourier::TimeGrid;
    use crate::model::{JointCoordinate, Model, SectionInput, Signal, SpringDefinition};
    use crate::system::System;
    use faer::linalg::solvers::Solve;
    use nalgebra::{Matrix3, Vector3};
    use std::sync::Arc;

    /// A turning rigid crank, a rigid link with a spring, and a beam: diagonal blocks of the rigid bodies
    /// are singular, so that they must wait for their joints.
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

    #[test]
    fn solves_what_a_dense_factorisation_solves() {
        for points in [1, 3, 7] {
            let period = std::f64::consts::TAU / 3.0;
            let system = Arc::new(System::new(&mechanism(), period).unwrap());
            let grid = TimeGrid::new(points, period).unwrap();
            let state = GridState::reference(&system, grid);
            let mut equations = Collocation::new(system.clone(), grid).unwrap();
            let pattern = Pattern::new(&system, points);
            let mut values = vec![0.0; pattern.entries()];
            let mut blocks = TangentBlocks::default();
            equations
                .jacobian(&state, &pattern, &mut blocks, &mut values)
                .unwrap();

            let size = pattern.size();
            let mut dense = Mat::<f64>::zeros(size, size);
            for (column, range) in pattern.column_pointers().windows(2).enumerate() {
                for at in range[0]..range[1] {
                    dense[(pattern.row_indices()[at], column)] = values[at];
                }
            }
            let exact = Mat::from_fn(size, 1, |i, _| (0.7 * i as f64).sin());
            let rhs = &dense * &exact;
            let mut solver = DirectSolver::new(&pattern);
            assert!(solver.factor(&values).unwrap());
            assert!(
                solver.factors.iter().any(|f| f.pivots.is_empty()),
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
