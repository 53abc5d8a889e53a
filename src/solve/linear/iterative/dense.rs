//! Dense LU, in place.

use crate::error::Result;
use crate::solve::linear::{blocks, lu};
use crate::workers::Workers;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::solve;
use faer::perm::PermRef;
use faer::{Mat, MatMut, Par};

/// Columns that are made at a time.
const PIECE: usize = 256;

/// A zero matrix.
///
/// # Errors
/// If memory runs out, or work is to end.
pub(super) fn zeros(rows: usize, columns: usize, workers: &Workers) -> Result<Mat<f64>> {
    let mut matrix = Mat::new();
    blocks::reserve(&mut matrix, rows, columns)?;
    for end in (PIECE..columns).step_by(PIECE).chain([columns]) {
        matrix.resize_with(rows, end, |_, _| 0.0);
        workers.pulse()?;
    }
    Ok(matrix)
}

/// Factors of a square matrix.
pub(super) struct DenseLu {
    factors: Mat<f64>,
    permutation: Vec<usize>,
    inverse: Vec<usize>,
    memory: MemBuffer,
}

impl DenseLu {
    /// Factors `matrix` in its own memory; none if it is singular.
    ///
    /// # Errors
    /// If work is to end.
    pub fn new(mut matrix: Mat<f64>, workers: &Workers) -> Result<Option<Self>> {
        let size = matrix.nrows();
        let mut permutation = vec![0usize; size];
        let regular = |_: usize, pivot: f64| pivot > 0.0 && pivot.is_finite();
        let regular = workers
            .dense(|par| lu::factor(matrix.as_mut(), &mut permutation, regular, (par, workers)))?;
        let mut inverse = vec![0usize; size];
        let rows = permutation.iter().enumerate();
        rows.for_each(|(i, &row)| inverse[row] = i);
        let scratch = solve::solve_in_place_scratch::<usize, f64>(size, 1, Par::Seq);
        Ok(regular.then(|| DenseLu {
            factors: matrix,
            permutation,
            inverse,
            memory: MemBuffer::new(scratch),
        }))
    }

    /// Solves in place.
    pub fn solve(&mut self, x: &mut [f64]) {
        let size = x.len();
        solve::solve_in_place(
            self.factors.as_ref(),
            self.factors.as_ref(),
            PermRef::new_checked(&self.permutation, &self.inverse, size),
            MatMut::from_column_major_slice_mut(x, size, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }
}
