//! GMRES with a preconditioner from the left, so that errors are measured by what they mean for the
//! unknowns, not by residuals, in which stiff directions drown soft ones. See docs/theory.md,
//! section 8.3.

use crate::error::Result;
use crate::memory;
use crate::solve::linear::dense::probe;
use crate::work::PROJECTION;
use crate::workers::Workers;
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use std::ops::Range;

/// A cycle that leaves more than this of the residual is the last.
const STAGNATION: f64 = 0.9;

/// Products after which it shows whether a solve comes to an end.
const TELLING: usize = 30;
/// It does not if it would take this many times the products that are allowed, at the rate so far:
/// convergence becomes faster on the way.
const HOPELESS: f64 = 1.5;

/// A part that is smaller than this may be nothing but rounding.
const SMALLEST_SHARE: f64 = 1e-8;
/// Error relative to the whole solution that is not undercut.
const FINEST: f64 = 1e-10;

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GmresOptions {
    /// Estimated error, relative to the smaller part of the solution.
    pub tolerance: f64,
    /// Entries of the first of its two parts, motions: the others, multipliers, may be of quite
    /// another size.
    pub leading: usize,
    /// Entries of both parts; what comes behind them is not asked for.
    pub essential: usize,
    /// Whether the second part is not asked for either.
    pub leading_alone: bool,
    /// Most products.
    pub iteration_limit: usize,
    /// Products between restarts, for which vectors are kept.
    pub restart: usize,
}

/// How it ended.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GmresEnd {
    /// Products taken.
    pub iterations: usize,
    /// Estimated error, relative to the smaller part of the solution: the preconditioned residual,
    /// amplified as much as the preconditioned operator may amplify it.
    pub error: f64,
    /// Whether a cycle has brought no more: rounding may allow no less.
    pub stagnated: bool,
}

/// Memory for long vectors, kept from one solve to the next, as taking it takes time.
#[derive(Default)]
pub(crate) struct GmresWorkspace {
    /// Orthonormal vectors, one behind the other.
    basis: Vec<f64>,
    /// The right-hand side.
    b: Vec<f64>,
    /// What is left of it, preconditioned.
    rest: Vec<f64>,
}

/// Vectors that are kept at least, where memory is short.
const LEAST_KEPT: usize = 20;

impl GmresWorkspace {
    /// Takes the memory of a solve for a right side of so many entries, which keeps fewer vectors
    /// where there is not enough.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::OutOfMemory`].
    pub fn take(&mut self, options: &mut GmresOptions, entries: usize) -> Result<()> {
        options.restart = options.restart.min(options.iteration_limit);
        while self.basis.len() < (options.restart + 1) * entries {
            let bytes = (options.restart + 3).saturating_mul(entries * size_of::<f64>());
            match memory::require("vectors of the iteration", bytes) {
                // What is not written to is not taken.
                Ok(()) => self.basis = vec![0.0; (options.restart + 1) * entries],
                Err(_) if options.restart > LEAST_KEPT => {
                    // That of the solves before first.
                    self.basis = Vec::new();
                    options.restart = (options.restart / 2).max(LEAST_KEPT);
                }
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}

/// A preconditioned operator: what is asked of it are `P⁻¹ A x` and `P⁻¹ b`, in place.
pub(crate) trait Preconditioned {
    /// `y = A x`.
    fn product(&mut self, x: &[f64], y: &mut [f64]);
    /// `y = P⁻¹ y`.
    fn precondition(&mut self, y: &mut [f64]);
}

/// Solves `A x = b` from `x = 0`: `rhs` is `b` before and `x` after. What `workspace` holds does
/// not matter.
pub(crate) fn gmres(
    operator: &mut impl Preconditioned,
    rhs: &mut [f64],
    options: &GmresOptions,
    workers: &Workers,
    workspace: &mut GmresWorkspace,
) -> Result<GmresEnd> {
    let mut options = *options;
    workspace.take(&mut options, rhs.len())?;
    let options = &options;
    let mut vectors = Vectors {
        workers,
        ends: [options.leading, options.essential],
        weights: [1.0, 1.0],
    };
    for copy in [&mut workspace.b, &mut workspace.rest] {
        copy.clear();
        copy.extend_from_slice(rhs);
    }
    operator.precondition(&mut workspace.rest);
    // The solution's two parts are about as large as those of this.
    let sizes = vectors.sizes(&mut workspace.rest);
    let larger = sizes[0].max(sizes[1]);
    if larger.is_finite() && larger > 0.0 && !options.leading_alone {
        let least = SMALLEST_SHARE.max(FINEST / options.tolerance).min(1.0);
        vectors.weights = sizes.map(|size| 1.0 / (size / larger).clamp(least, 1.0));
    }
    let start = vectors.norm(&mut workspace.rest);
    rhs.fill(0.0);
    let end = GmresEnd {
        iterations: 0,
        error: if start == 0.0 { 0.0 } else { 1.0 },
        stagnated: false,
    };
    if start == 0.0 || !start.is_finite() {
        return Ok(end);
    }
    let mut run = Run {
        operator,
        vectors,
        options,
        workspace,
        share: None,
        is_hopeless: false,
        end,
    };
    while run.end.error > options.tolerance && run.end.iterations < options.iteration_limit {
        let before = run.vectors.norm(&mut run.workspace.rest);
        let progress = (run.cycle(rhs, before)).is_some_and(|left| left < STAGNATION * before);
        if run.is_hopeless {
            break;
        }
        if !progress {
            run.end.stagnated = run.end.error > options.tolerance;
            break;
        }
    }
    Ok(run.end)
}

/// A solve on its way.
struct Run<'a, P> {
    operator: &'a mut P,
    vectors: Vectors<'a>,
    options: &'a GmresOptions,
    workspace: &'a mut GmresWorkspace,
    /// What the smaller part is of the solution, once that is known.
    share: Option<f64>,
    is_hopeless: bool,
    end: GmresEnd,
}

impl<P: Preconditioned> Run<'_, P> {
    /// Improves `x` by a cycle, from a residual of size `before`; returns the size of what is left.
    /// `None` if work is to end.
    fn cycle(&mut self, x: &mut [f64], before: f64) -> Option<f64> {
        let Run {
            operator,
            vectors,
            options,
            ..
        } = self;
        let GmresWorkspace { basis, b, rest } = &mut *self.workspace;
        let (size, found) = (x.len(), vectors.norm(x));
        let products = (options.restart).min(options.iteration_limit - self.end.iterations);
        vectors.sums(&mut basis[..size], 1, |first, v, _| {
            let rest = &rest[first..][..v.len()];
            v.iter_mut().zip(rest).for_each(|(v, r)| *v = r / before);
        });
        let mut least = LeastSquares::new(before);
        for j in 0..products {
            let (known, new) = basis.split_at_mut((j + 1) * size);
            let w = &mut new[..size];
            operator.product(&known[j * size..], w);
            operator.precondition(w);
            self.end.iterations += 1;
            if vectors.workers.pulse().is_err() {
                self.end.error = f64::INFINITY;
                return None;
            }
            let (column, length) = vectors.project_out(known, w);
            if length > 0.0 {
                vectors.scale(w, 1.0 / length);
            }
            if !least.push(column, length) {
                // A direction that the operator does not know.
                break;
            }
            let error = least.rest() * least.triangle.inverse_size();
            let y = least.solve();
            let whole = small_norm(&y).max(found);
            self.end.error = error / (self.share.unwrap_or(1.0) * whole);
            if self.end.error <= options.tolerance && self.share.is_none() {
                // Only now, as it takes a pass over all vectors.
                let share = vectors.smaller_share(x, basis, &y, options);
                let [first, second] = vectors.weights;
                let share = share.max(FINEST * first.max(second) / options.tolerance);
                self.share = Some(share);
                self.end.error = error / (share * whole);
            }
            if self.end.error <= options.tolerance || length == 0.0 {
                break;
            }
            // The error goes with the residual, and this falls by so much in each product.
            let rate = (before / least.rest()).ln() / (j + 1) as f64;
            let left = (self.end.error / options.tolerance).ln() / rate;
            let most = HOPELESS * options.iteration_limit as f64;
            self.is_hopeless = j >= TELLING && self.end.iterations as f64 + left > most;
            if self.is_hopeless {
                break;
            }
        }
        vectors.add(x, basis, &least.solve());
        // What rounding in the preconditioner leaves, nearly singular as it may be, shows in the
        // residual only.
        operator.product(x, rest);
        vectors.sums(rest, 1, |first, r, _| {
            let b = &b[first..][..r.len()];
            r.iter_mut().zip(b).for_each(|(r, b)| *r = b - *r);
        });
        operator.precondition(rest);
        // Written so that NaN ends it too.
        let (left, size) = (vectors.norm(rest), vectors.norm(x));
        self.end.error = if size > 0.0 {
            left * least.triangle.inverse_size() / (self.share.unwrap_or(1.0) * size)
        } else {
            1.0
        };
        Some(left)
    }
}

/// What is to be as small as it can be in a cycle: a right side of one entry, less the Hessenberg
/// matrix times what is sought.
struct LeastSquares {
    triangle: Triangle,
    rotations: Vec<(f64, f64)>,
    /// The right side, rotated.
    rotated: Vec<f64>,
}

impl LeastSquares {
    fn new(right_side: f64) -> Self {
        LeastSquares {
            triangle: Triangle::default(),
            rotations: Vec::new(),
            rotated: vec![right_side],
        }
    }

    /// Adds a column of the matrix, and its entry `below` the diagonal. `false` if that is zero,
    /// and nothing to be added.
    fn push(&mut self, mut column: Vec<f64>, below: f64) -> bool {
        for (i, (c, s)) in self.rotations.iter().enumerate() {
            let (upper, lower) = (column[i], column[i + 1]);
            column[i] = c * upper + s * lower;
            column[i + 1] = c * lower - s * upper;
        }
        let j = self.rotations.len();
        let diagonal = column[j].hypot(below);
        if diagonal == 0.0 {
            return false;
        }
        let (c, s) = (column[j] / diagonal, below / diagonal);
        column[j] = diagonal;
        self.rotations.push((c, s));
        self.triangle.columns.push(column);
        let last = self.rotated[j];
        self.rotated[j] = c * last;
        self.rotated.push(-s * last);
        true
    }

    /// What is sought.
    fn solve(&self) -> Vec<f64> {
        self.triangle.solve(&self.rotated)
    }

    /// Size of what is left of the right side.
    fn rest(&self) -> f64 {
        self.rotated[self.rotations.len()].abs()
    }
}

/// Upper triangle that rotations make of the Hessenberg matrix, column by column.
#[derive(Default)]
struct Triangle {
    columns: Vec<Vec<f64>>,
}

impl Triangle {
    /// Solves `R y = x` for the first entries of `x`.
    fn solve(&self, x: &[f64]) -> Vec<f64> {
        let mut y = x[..self.columns.len()].to_vec();
        for i in (0..y.len()).rev() {
            let (head, tail) = y.split_at_mut(i);
            tail[0] /= self.columns[i][i];
            add(head, &self.columns[i][..i], -tail[0]);
        }
        y
    }

    /// Solves `Rᵀ y = x`.
    fn solve_transposed(&self, x: &[f64]) -> Vec<f64> {
        let mut y: Vec<f64> = Vec::with_capacity(x.len());
        for (column, x) in self.columns.iter().zip(x) {
            let known = dot(&column[..y.len()], &y);
            y.push((x - known) / column[y.len()]);
        }
        y
    }

    /// Size of `R⁻¹`, by a few steps of the power method.
    fn inverse_size(&self) -> f64 {
        let mut x = probe(self.columns.len());
        let mut size = 0.0;
        for _ in 0..3 {
            let length = small_norm(&x);
            x.iter_mut().for_each(|x| *x /= length);
            x = self.solve(&self.solve_transposed(&x));
            size = small_norm(&x).sqrt();
        }
        size
    }
}

/// Long vectors, worked on by several threads. The smaller of their two parts counts more in
/// products of two, so that neither drowns in the other.
struct Vectors<'a> {
    workers: &'a Workers,
    /// Where the two parts end.
    ends: [usize; 2],
    /// Of their entries.
    weights: [f64; 2],
}

/// Entries that are worked on in one piece: they stay in the cache meanwhile.
const PIECE: usize = 1 << 12;

impl Vectors<'_> {
    /// Works on pieces of a vector, each with where it starts, and sums `count` sums of each,
    /// whatever the number of threads.
    fn sums(
        &self,
        x: &mut [f64],
        count: usize,
        work: impl Fn(usize, &mut [f64], &mut [f64]) + Sync,
    ) -> Vec<f64> {
        let mut sums = vec![0.0; x.len().div_ceil(PIECE) * count];
        let of_pieces = sums.chunks_mut(count.max(1));
        let mut pieces: Vec<_> = x.chunks_mut(PIECE).zip(of_pieces).collect();
        let item = |piece: usize, x: &mut [f64], sums: &mut [f64]| work(piece * PIECE, x, sums);
        self.workers
            .each(&mut pieces, |i, (x, sums)| item(i, x, sums));
        let mut total = vec![0.0; count];
        for of_piece in sums.chunks(count.max(1)) {
            add(&mut total, of_piece, 1.0);
        }
        total
    }

    /// `x += V y`, for as many of the vectors as `y` has entries.
    fn add(&self, x: &mut [f64], basis: &[f64], y: &[f64]) {
        let basis = Columns::new(basis, x.len(), y.len());
        self.sums(x, 1, |first, x, _| basis.add(first, x, y, 1.0));
    }

    fn scale(&self, x: &mut [f64], factor: f64) {
        self.sums(x, 1, |_, x, _| x.iter_mut().for_each(|x| *x *= factor));
    }

    /// The two parts, and what is behind them, of a piece of `count` entries that starts at
    /// `first`, each with the weight of its squares.
    fn parts(&self, first: usize, count: usize) -> [(Range<usize>, f64); 3] {
        let [one, two] = self.ends.map(|end| end.saturating_sub(first).min(count));
        let [first, second] = self.weights.map(|weight| weight * weight);
        [(0..one, first), (one..two, second), (two..count, 1.0)]
    }

    /// Square of the size of a piece.
    fn square(&self, first: usize, x: &[f64]) -> f64 {
        let parts = self.parts(first, x.len()).into_iter();
        parts
            .map(|(part, weight)| weight * dot(&x[part.clone()], &x[part]))
            .sum()
    }

    fn norm(&self, x: &mut [f64]) -> f64 {
        self.sums(x, 1, |first, x, sum| sum[0] = self.square(first, x))[0].sqrt()
    }

    /// Sizes of the two parts.
    fn sizes(&self, x: &mut [f64]) -> [f64; 2] {
        let squares = self.sums(x, 2, |first, x, sums| {
            for (sum, (part, weight)) in sums.iter_mut().zip(self.parts(first, x.len())) {
                *sum = weight * dot(&x[part.clone()], &x[part]);
            }
        });
        [squares[0].sqrt(), squares[1].sqrt()]
    }

    /// Size of the smaller of the two parts of `x + V y`, relative to the whole.
    fn smaller_share(&self, x: &[f64], basis: &[f64], y: &[f64], options: &GmresOptions) -> f64 {
        let mut sum = x.to_vec();
        self.add(&mut sum, basis, y);
        let whole = self.norm(&mut sum);
        let sizes = self.sizes(&mut sum);
        let asked = if options.leading_alone { 1 } else { 2 };
        let shares = sizes[..asked].iter().map(|size| size / whole);
        // Of nothing nothing more can be asked than that the rest is right.
        let counts = shares.filter(|share| *share > SMALLEST_SHARE);
        counts.fold(1.0, f64::min)
    }

    /// Takes from `w` its parts along orthonormal `basis` vectors, twice so that rounding leaves
    /// none; returns these parts, and the length of what is left.
    fn project_out(&self, basis: &[f64], w: &mut [f64]) -> (Vec<f64>, f64) {
        let count = basis.len() / w.len();
        self.workers.work().spend(PROJECTION * basis.len() as f64);
        let basis = Columns::new(basis, w.len(), count);
        let along = |first: usize, w: &[f64], sums: &mut [f64]| {
            for (part, weight) in self.parts(first, w.len()) {
                basis.along(first + part.start, &w[part], weight, sums);
            }
        };
        let mut parts = self.sums(w, count, |first, w, sums| along(first, w, sums));
        let rest = self.sums(w, count, |first, w, sums| {
            basis.add(first, w, &parts, -1.0);
            along(first, w, sums);
        });
        let length = self.sums(w, 1, |first, w, sum| {
            basis.add(first, w, &rest, -1.0);
            sum[0] = self.square(first, w);
        });
        add(&mut parts, &rest, 1.0);
        (parts, length[0].sqrt())
    }
}

/// Vectors of one size, one behind the other.
#[derive(Clone, Copy)]
struct Columns<'a> {
    values: &'a [f64],
    size: usize,
    count: usize,
}

impl<'a> Columns<'a> {
    fn new(values: &'a [f64], size: usize, count: usize) -> Self {
        Columns {
            values,
            size,
            count,
        }
    }

    /// So many rows from `first` on.
    fn rows(&self, first: usize, rows: usize) -> MatRef<'a, f64> {
        let values = &self.values[first..(self.count - 1) * self.size + first + rows];
        MatRef::from_column_major_slice_with_stride(values, rows, self.count, self.size)
    }

    /// `sums += weight Vᵀ w`, for a piece of `w` that starts at `first`.
    fn along(&self, first: usize, w: &[f64], weight: f64, sums: &mut [f64]) {
        if w.is_empty() {
            return;
        }
        let to = MatMut::from_column_major_slice_mut(sums, self.count, 1);
        let w = MatRef::from_column_major_slice(w, w.len(), 1);
        let rows = self.rows(first, w.nrows()).transpose();
        matmul(to, Accum::Add, rows, w, weight, Par::Seq);
    }

    /// `w += factor V y`, for a piece of `w` that starts at `first`.
    fn add(&self, first: usize, w: &mut [f64], y: &[f64], factor: f64) {
        if self.count == 0 {
            return;
        }
        let rows = self.rows(first, w.len());
        let y = MatRef::from_column_major_slice(y, self.count, 1);
        let to = MatMut::from_column_major_slice_mut(w, rows.nrows(), 1);
        matmul(to, Accum::Add, rows, y, factor, Par::Seq);
    }
}

/// `y += factor x`.
fn add(y: &mut [f64], x: &[f64], factor: f64) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

fn small_norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Sums in eight parts side by side, in an order that does not depend on anything but the length.
fn dot(x: &[f64], y: &[f64]) -> f64 {
    let mut parts = [0.0; 8];
    let (x_chunks, y_chunks) = (x.chunks_exact(8), y.chunks_exact(8));
    let rest: f64 = x_chunks
        .remainder()
        .iter()
        .zip(y_chunks.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in x_chunks.zip(y_chunks) {
        for i in 0..8 {
            parts[i] += x[i] * y[i];
        }
    }
    parts.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with a diagonal from 1 to 2 and a rotation, and no preconditioner.
    struct Plain(usize);

    impl Preconditioned for Plain {
        fn product(&mut self, x: &[f64], y: &mut [f64]) {
            let n = self.0;
            for i in 0..n {
                let shear = 0.3 * x[(i + 1) % n] - 0.3 * x[(i + n - 1) % n];
                y[i] = (1.0 + i as f64 / n as f64) * x[i] + shear;
            }
        }

        fn precondition(&mut self, _: &mut [f64]) {}
    }

    #[test]
    fn solves_to_the_tolerance_also_with_restarts() {
        for restart in [4, 50] {
            let mut operator = Plain(40);
            let exact: Vec<f64> = (0..40).map(|i| (i as f64).cos()).collect();
            let mut x = vec![0.0; 40];
            operator.product(&exact, &mut x);
            let options = GmresOptions {
                tolerance: 1e-10,
                leading: 40,
                essential: 40,
                leading_alone: false,
                iteration_limit: 200,
                restart,
            };
            let end = gmres(
                &mut operator,
                &mut x,
                &options,
                &Workers::default(),
                &mut GmresWorkspace::default(),
            )
            .unwrap();
            assert!(end.error <= 1e-10, "{end:?}");
            let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs());
            assert!(error.fold(0.0, f64::max) < 1e-9);
        }
    }

    #[test]
    fn both_parts_are_as_accurate_as_asked_however_small_one_is() {
        // The second part is a millionth of the first.
        let exact: Vec<f64> = (0..40)
            .map(|i| (i as f64).cos() * if i < 20 { 1.0 } else { 1e-6 })
            .collect();
        // What serves the first alone does not serve the second, of another size.
        struct Apart;
        impl Preconditioned for Apart {
            fn product(&mut self, x: &[f64], y: &mut [f64]) {
                Plain(20).product(&x[..20], &mut y[..20]);
                Plain(20).product(&x[20..], &mut y[20..]);
                y[20..].iter_mut().for_each(|y| *y *= 4.0);
            }
            fn precondition(&mut self, _: &mut [f64]) {}
        }
        let solve = |leading_alone: bool| {
            let mut x = vec![0.0; 40];
            Apart.product(&exact, &mut x);
            let options = GmresOptions {
                tolerance: 1e-3,
                leading: 20,
                essential: 40,
                leading_alone,
                iteration_limit: 40,
                restart: 40,
            };
            let (workers, mut workspace) = (Workers::default(), GmresWorkspace::default());
            let end = gmres(&mut Apart, &mut x, &options, &workers, &mut workspace).unwrap();
            let error = |part: Range<usize>| {
                let of = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>().sqrt();
                let left = of(&mut part.clone().map(|i| x[i] - exact[i]));
                left / of(&mut part.map(|i| exact[i]))
            };
            (end, error(0..20), error(20..40))
        };
        let (end, first, second) = solve(false);
        // An estimate, which counts amplification, and no more than ten times too large.
        assert!(first <= 1e-3 && second <= 1e-3, "{first:e} {second:e}");
        assert!(
            end.error <= 1e-3 && end.error <= 10.0 * first.max(second),
            "{end:?}"
        );
        let (alone, first, second) = solve(true);
        assert!(first <= 1e-3 && second > 1e-2, "{first:e} {second:e}");
        assert!(alone.iterations <= end.iterations);
    }

    #[test]
    fn a_singular_system_ends() {
        struct Zero;
        impl Preconditioned for Zero {
            fn product(&mut self, _: &[f64], y: &mut [f64]) {
                y.fill(0.0);
            }
            fn precondition(&mut self, _: &mut [f64]) {}
        }
        let options = GmresOptions {
            tolerance: 1e-10,
            leading: 1,
            essential: 2,
            leading_alone: false,
            iteration_limit: 20,
            restart: 20,
        };
        let mut x = vec![1.0, 2.0];
        let end = gmres(
            &mut Zero,
            &mut x,
            &options,
            &Workers::default(),
            &mut GmresWorkspace::default(),
        )
        .unwrap();
        assert!(end.error > 0.5 && x.iter().all(|x| x.is_finite()));
    }

    #[test]
    fn what_would_take_too_long_is_left() {
        /// Of its 300 vectors none helps before the last.
        struct Shift;
        impl Preconditioned for Shift {
            fn product(&mut self, x: &[f64], y: &mut [f64]) {
                y[1..].copy_from_slice(&x[..x.len() - 1]);
                y[0] = x[x.len() - 1];
            }
            fn precondition(&mut self, _: &mut [f64]) {}
        }
        let options = GmresOptions {
            tolerance: 1e-6,
            leading: 300,
            essential: 300,
            leading_alone: false,
            iteration_limit: 200,
            restart: 200,
        };
        let mut x = vec![0.0; 300];
        x[0] = 1.0;
        let end = gmres(
            &mut Shift,
            &mut x,
            &options,
            &Workers::default(),
            &mut GmresWorkspace::default(),
        )
        .unwrap();
        assert!(end.error > 0.5 && !end.stagnated, "{end:?}");
        assert!(end.iterations < TELLING + 5, "{end:?}");
    }
}
