//! Vectors of all unknowns: sums, products and projections by several threads.

use crate::solve::linear::solver::ESTIMATE;
use crate::work::PROJECTION;
use crate::workers::Workers;
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use std::ops::Range;

/// How the two parts of a solution count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Parts {
    /// Only the first is asked for.
    LeadingAlone,
    /// By their entries, until the smaller is accurate, too.
    AsTheyAre,
    /// The smaller weighs as much as the larger.
    Balanced,
}

/// Beams that are so much stiffer in tension than in bending feel errors of motions that are none
/// for others: the smaller part asks more of the whole there.
const STRETCHING: f64 = 1e6;

impl Parts {
    /// How motions and multipliers count in a solve this accurate, of a system this slender.
    pub fn of(slenderness: f64, accuracy: f64) -> Self {
        if accuracy >= ESTIMATE {
            // Estimates are of motions alone.
            Parts::LeadingAlone
        } else if slenderness < STRETCHING {
            Parts::Balanced
        } else {
            Parts::AsTheyAre
        }
    }
}

/// A part that is smaller than this may be nothing but rounding.
pub(super) const SMALLEST_SHARE: f64 = 1e-8;

/// Long vectors, worked on by several threads. The smaller of their two parts counts more in
/// products of two, so that neither drowns in the other.
pub(super) struct Vectors<'a> {
    pub workers: &'a Workers,
    /// Where the two parts end.
    pub ends: [usize; 2],
    /// Of their entries.
    pub weights: [f64; 2],
}

/// Entries that are worked on in one piece: they stay in the cache meanwhile,
const PIECE: usize = 1 << 12;
/// and so do those of all basis vectors, as far as pieces of this length allow it.
const SHORTEST_PIECE: usize = 1 << 8;
const CACHED: usize = 1 << 15;
/// What a vector may keep along others that it is orthogonal to, relative to its length.
const ORTHOGONAL: f64 = 1e-6;

impl Vectors<'_> {
    /// Works on pieces of a vector, each with where it starts, and sums `count` sums of each,
    /// whatever the number of threads.
    pub fn sums(
        &self,
        x: &mut [f64],
        count: usize,
        work: impl Fn(usize, &mut [f64], &mut [f64]) + Sync,
    ) -> Vec<f64> {
        let length = (CACHED / count.max(1)).clamp(SHORTEST_PIECE, PIECE);
        let mut sums = vec![0.0; x.len().div_ceil(length) * count];
        let of_pieces = sums.chunks_mut(count.max(1));
        let mut pieces: Vec<_> = x.chunks_mut(length).zip(of_pieces).collect();
        let item = |piece: usize, x: &mut [f64], sums: &mut [f64]| work(piece * length, x, sums);
        self.workers
            .each(&mut pieces, |i, (x, sums)| item(i, x, sums));
        let mut total = vec![0.0; count];
        for of_piece in sums.chunks(count.max(1)) {
            add(&mut total, of_piece, 1.0);
        }
        total
    }

    /// `x += V y`, for as many of the vectors as `y` has entries.
    pub fn add(&self, x: &mut [f64], basis: &[f64], y: &[f64]) {
        let basis = Columns::new(basis, x.len(), y.len());
        self.sums(x, 1, |first, x, _| basis.add(first, x, y, 1.0));
    }

    pub fn scale(&self, x: &mut [f64], factor: f64) {
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

    pub fn norm(&self, x: &mut [f64]) -> f64 {
        self.sums(x, 1, |first, x, sum| sum[0] = self.square(first, x))[0].sqrt()
    }

    /// Sizes of the two parts.
    pub fn sizes(&self, x: &mut [f64]) -> [f64; 2] {
        let squares = self.sums(x, 2, |first, x, sums| {
            for (sum, (part, weight)) in sums.iter_mut().zip(self.parts(first, x.len())) {
                *sum = weight * dot(&x[part.clone()], &x[part]);
            }
        });
        [squares[0].sqrt(), squares[1].sqrt()]
    }

    /// Size of the smaller of the two parts of `x + V y`, relative to the whole. `sum` is room for
    /// that.
    pub fn smaller_share(
        &self,
        (x, basis, y): (&[f64], &[f64], &[f64]),
        sum: &mut [f64],
        parts: Parts,
    ) -> f64 {
        sum.copy_from_slice(x);
        self.add(sum, basis, y);
        let whole = self.norm(sum);
        let sizes = self.sizes(sum);
        let asked = if parts == Parts::LeadingAlone { 1 } else { 2 };
        let shares = sizes[..asked].iter().map(|size| size / whole);
        // Of nothing nothing more can be asked than that the rest is right.
        let counts = shares.filter(|share| *share > SMALLEST_SHARE);
        counts.fold(1.0, f64::min)
    }

    /// Parts of `w` along orthonormal `basis` vectors.
    pub fn along(&self, basis: &[f64], w: &mut [f64]) -> Vec<f64> {
        let count = basis.len() / w.len();
        self.workers.work().spend(PROJECTION * basis.len() as f64);
        let basis = Columns::new(basis, w.len(), count);
        self.sums(w, count, |first, w, sums| {
            self.along_piece(basis, first, w, sums)
        })
    }

    /// The same of a piece that starts at `first`.
    fn along_piece(&self, basis: Columns, first: usize, w: &[f64], sums: &mut [f64]) {
        for (part, weight) in self.parts(first, w.len()) {
            basis.along(first + part.start, &w[part], weight, sums);
        }
    }

    /// Takes from `w` its parts along orthonormal `basis` vectors, once more where rounding leaves
    /// much of them; returns these parts, and the length of what is left.
    pub fn project_out(&self, basis: &[f64], w: &mut [f64]) -> (Vec<f64>, f64) {
        let mut parts = self.along(basis, w);
        let count = parts.len();
        let basis = Columns::new(basis, w.len(), count);
        let mut rest = self.sums(w, count + 1, |first, w, sums| {
            basis.add(first, w, &parts, -1.0);
            let (rest, length) = sums.split_at_mut(count);
            self.along_piece(basis, first, w, rest);
            length[0] = self.square(first, w);
        });
        let length = rest.pop().unwrap_or(0.0).sqrt();
        // Written so that NaN is seen.
        if small_norm(&rest) <= ORTHOGONAL * length {
            return (parts, length);
        }
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
pub(super) fn add(y: &mut [f64], x: &[f64], factor: f64) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

pub(super) fn small_norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Sums in eight parts side by side, in an order that does not depend on anything but the length.
pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
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
