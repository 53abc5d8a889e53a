//! Dense LU, in place.

use crate::error::Result;
use crate::solve::linear::block::Block;
use crate::solve::linear::lu;
use crate::workers::Workers;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};

/// Rows that are known before others are reduced by them, and rows that are reduced in one piece.
const KNOWN: usize = 256;
const REDUCED: usize = 128;

/// Factors of a square matrix.
pub(super) struct DenseLu {
    factors: Block,
    /// Where each row of the factors stood.
    order: Vec<usize>,
    ordered: Vec<f64>,
    workers: Workers,
}

impl DenseLu {
    /// Factors `matrix` in its own memory; none if it is singular.
    ///
    /// # Errors
    /// If work is to end.
    pub fn new(mut matrix: Block, workers: &Workers) -> Result<Option<Self>> {
        let size = matrix.rows();
        let mut order = vec![0usize; size];
        let regular = |_: usize, pivot: f64| pivot > 0.0 && pivot.is_finite();
        let regular = workers
            .dense(|par| lu::factor(matrix.as_mut(), &mut order, regular, (par, workers)))?;
        Ok(regular.then(|| DenseLu {
            factors: matrix,
            order,
            ordered: vec![0.0; size],
            workers: workers.for_work(size * size),
        }))
    }

    /// Solves in place.
    pub fn solve(&mut self, x: &mut [f64]) {
        let size = x.len();
        let rows = self.order.iter().map(|&row| x[row]);
        self.ordered.iter_mut().zip(rows).for_each(|(y, x)| *y = x);
        let (y, factors) = (&mut self.ordered[..], self.factors.as_ref());
        for first in (0..size).step_by(KNOWN) {
            let (known, below) = y[first..].split_at_mut(KNOWN.min(size - first));
            let count = known.len();
            let of = |row, rows| factors.submatrix(row, first, rows, count);
            let unknowns = MatMut::from_column_major_slice_mut(known, count, 1);
            solve_unit_lower_triangular_in_place(of(first, count), unknowns, Par::Seq);
            let next = first + count;
            reduce(
                below,
                known,
                |row, rows| of(next + row, rows),
                &self.workers,
            );
        }
        for first in (0..size).step_by(KNOWN).rev() {
            let (above, known) = y.split_at_mut(first);
            let count = KNOWN.min(size - first);
            let known = &mut known[..count];
            let of = |row, rows| factors.submatrix(row, first, rows, count);
            let unknowns = MatMut::from_column_major_slice_mut(known, count, 1);
            solve_upper_triangular_in_place(of(first, count), unknowns, Par::Seq);
            reduce(above, known, of, &self.workers);
        }
        x.copy_from_slice(y);
    }
}

/// `y -= A x` piece by piece, where `block` gives so many rows of `A` from one on.
fn reduce<'a>(
    y: &mut [f64],
    x: &[f64],
    block: impl Fn(usize, usize) -> MatRef<'a, f64> + Sync,
    workers: &Workers,
) {
    let x = MatRef::from_column_major_slice(x, x.len(), 1);
    let mut pieces: Vec<_> = y.chunks_mut(REDUCED).collect();
    workers.each(&mut pieces, |i, y| {
        let rows = y.len();
        let y = MatMut::from_column_major_slice_mut(y, rows, 1);
        matmul(y, Accum::Add, block(i * REDUCED, rows), x, -1.0, Par::Seq);
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    #[test]
    fn solutions_are_those_of_the_matrix_by_any_number_of_threads() {
        let noise = |i: usize, j: usize| (4e4 * (1.7 * i as f64 + 0.3 * j as f64).sin()).fract();
        for size in [1, 7, 256, 257, 700] {
            let matrix = Mat::from_fn(size, size, |i, j| noise(i + 1, j));
            let exact: Vec<f64> = (0..size).map(|i| noise(i, size)).collect();
            let product = &matrix * MatRef::from_column_major_slice(&exact, size, 1);
            let solve = |threads: usize| {
                let workers = Workers::new(threads).unwrap();
                let mut block = Block::zeros(size, size).unwrap();
                block.as_mut().copy_from(&matrix);
                let mut lu = DenseLu::new(block, &workers).unwrap().unwrap();
                let mut x = product.col_as_slice(0).to_vec();
                lu.solve(&mut x);
                x
            };
            let x = solve(1);
            assert!(solve(2) == x && solve(3) == x);
            let error = x.iter().zip(&exact).map(|(x, e)| (x - e).abs());
            // A hundred times what a condition of a thousand makes of rounding.
            assert!(error.fold(0.0, f64::max) < 1e-11 * size as f64, "{size}");
        }
    }
}
