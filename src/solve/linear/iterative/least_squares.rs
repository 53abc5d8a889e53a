//! The small least-squares problem of an iteration, one column longer in each step.

use super::long_vectors::{add, dot, small_norm};
use crate::solve::linear::dense::probe;

/// What is to be as small as it can be in a cycle: a right side of one entry, less the Hessenberg
/// matrix times what is sought.
pub(super) struct LeastSquares {
    pub triangle: Triangle,
    rotations: Vec<(f64, f64)>,
    /// The right side, rotated.
    rotated: Vec<f64>,
}

impl LeastSquares {
    pub fn new(right_side: f64) -> Self {
        LeastSquares {
            triangle: Triangle::default(),
            rotations: Vec::new(),
            rotated: vec![right_side],
        }
    }

    /// Adds a column of the matrix, and its entry `below` the diagonal. `false` if that is zero,
    /// and nothing to be added.
    pub fn push(&mut self, mut column: Vec<f64>, below: f64) -> bool {
        self.rotate(&mut column);
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

    /// Columns so far.
    pub fn products(&self) -> usize {
        self.rotations.len()
    }

    /// `x = Qᵀ x`, of the rotations that make the triangle.
    pub fn rotate(&self, x: &mut [f64]) {
        for (i, (c, s)) in self.rotations.iter().enumerate() {
            let (upper, lower) = (x[i], x[i + 1]);
            (x[i], x[i + 1]) = (c * upper + s * lower, c * lower - s * upper);
        }
    }

    /// `x = Q x`.
    pub fn rotate_back(&self, x: &mut [f64]) {
        for (i, (c, s)) in self.rotations.iter().enumerate().rev() {
            let (upper, lower) = (x[i], x[i + 1]);
            (x[i], x[i + 1]) = (c * upper - s * lower, s * upper + c * lower);
        }
    }

    /// What is sought.
    pub fn solve(&self) -> Vec<f64> {
        self.triangle.solve(&self.rotated)
    }

    /// Size of what is left of the right side.
    pub fn rest(&self) -> f64 {
        self.rotated[self.rotations.len()].abs()
    }
}

/// Upper triangle that rotations make of the Hessenberg matrix, column by column.
#[derive(Default)]
pub(super) struct Triangle {
    columns: Vec<Vec<f64>>,
}

impl Triangle {
    /// Solves `R y = x` for the first entries of `x`.
    pub fn solve(&self, x: &[f64]) -> Vec<f64> {
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
    pub fn inverse_size(&self) -> f64 {
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
