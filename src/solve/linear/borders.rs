//! Scalar equations and what scalar unknowns do to those of the grid (docs/theory.md, section 8.8).

use crate::collocation::{Collocation, GridState, Tangent};
use crate::error::Result;
use crate::solve::linear::dense::largest;
use nalgebra::{DMatrix, DVector};

/// Pivot of the Schur complement, relative to others, that is rounding.
pub(crate) const NO_PIVOT: f64 = 1e-11;

/// What stands beside and below `J`, and the Schur complement.
#[derive(Debug, Clone, Default)]
pub(crate) struct Borders {
    /// `B`, column by column.
    pub columns: Vec<Vec<f64>>,
    /// Length of these.
    pub size: usize,
    /// `[C D]`, row by row.
    pub rows: Vec<Vec<f64>>,
    /// `J⁻¹ B`.
    pub eliminated: Vec<Vec<f64>>,
    /// `(D − C J⁻¹ B)⁻¹`.
    pub inverse: DMatrix<f64>,
    /// Equation and unknown that it leaves undetermined.
    pub undetermined: Option<[usize; 2]>,
}

impl Borders {
    /// Those of `equations` at `state`, but for the columns of the frequency, which
    /// [`Borders::complete`] makes.
    pub fn at(equations: &mut Collocation, state: &GridState) -> Result<Self> {
        let all = 0..equations.layout().scalars().len();
        let column = |i: usize| match equations.moves_frequency(state, i) {
            Some(_) => Ok(Vec::new()),
            None => equations.by_scalar(state, i),
        };
        let columns = all.clone().map(column).collect::<Result<_>>()?;
        equations.apply_scalars(state)?;
        equations.update_kinematics(state);
        Ok(Borders {
            columns,
            size: equations.size(),
            rows: all
                .map(|i| equations.of_scalar_equation(state, i))
                .collect::<Result<_>>()?,
            ..Borders::default()
        })
    }

    /// Makes the columns of the frequency by the tangents at `state`.
    pub fn complete(&mut self, equations: &Collocation, state: &GridState, tangent: &mut Tangent) {
        for (i, column) in self.columns.iter_mut().enumerate() {
            if column.is_empty()
                && let Some(factor) = equations.moves_frequency(state, i)
            {
                column.resize(equations.size(), 0.0);
                tangent.by_log_frequency(equations, column);
                column.iter_mut().for_each(|x| *x *= factor);
            }
        }
    }

    /// Finds the Schur complement, by what solves with `J`. `false` if that cannot be done, or if
    /// equations do not feel any of the unknowns: that, where `motions` ends in the equations of
    /// the grid, is told by what follows an unknown in motions and in all else.
    pub fn eliminate(
        &mut self,
        motions: Option<usize>,
        mut solve: impl FnMut(&mut [f64]) -> Result<bool>,
    ) -> Result<bool> {
        self.undetermined = None;
        self.eliminated.clone_from(&self.columns);
        for column in &mut self.eliminated {
            if !solve(column)? {
                return Ok(false);
            }
        }
        let mut complement = self.complement(&self.eliminated);
        if let Some(motions) = motions {
            self.drop_rounding(&mut complement, motions);
        }
        self.undetermined = smallest_pivot(&complement);
        if self.undetermined.is_some() {
            return Ok(false);
        }
        let inverse = complement.try_inverse();
        let found = inverse.filter(|inverse| inverse.iter().all(|x| x.is_finite()));
        Ok(found.map(|inverse| self.inverse = inverse).is_some())
    }

    /// Makes zeros of entries that are rounding beside what equations would feel of motions, which
    /// end at `motions`, and of all else, if these were where they are the most.
    fn drop_rounding(&self, complement: &mut DMatrix<f64>, motions: usize) {
        let largest_of = |x: &Vec<f64>| [0..motions, motions..self.size].map(|p| largest(&x[p]));
        let columns: Vec<[f64; 2]> = self.eliminated.iter().map(largest_of).collect();
        for (i, row) in self.rows.iter().enumerate() {
            let felt = largest_of(row);
            for (j, column) in columns.iter().enumerate() {
                let own = row.get(self.size + j).unwrap_or(&0.0).abs();
                let most = felt[0] * column[0] + felt[1] * column[1] + own;
                if complement[(i, j)].abs() <= NO_PIVOT * most {
                    complement[(i, j)] = 0.0;
                }
            }
        }
    }

    /// `D − C X`, with the columns `X` first in `eliminated`.
    pub fn complement(&self, eliminated: &[Vec<f64>]) -> DMatrix<f64> {
        let (count, size) = (self.count(), self.size);
        DMatrix::from_fn(count, count, |i, j| {
            let row = &self.rows[i];
            row[size + j] - dot(&row[..size], &eliminated[j])
        })
    }

    /// Sizes of the column of an unknown and of the equation of its number, multiplied; of what is
    /// zero, 1.
    pub fn size_of(&self, index: usize) -> f64 {
        let sizes = [&self.columns[index], &self.rows[index]].map(|x| largest(x));
        sizes.iter().filter(|size| **size > 0.0).product()
    }

    /// Number of scalars.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// Forgets the Schur complement, which was that of another `J`.
    pub fn forget_elimination(&mut self) {
        self.inverse = DMatrix::zeros(0, 0);
    }

    /// Whether the Schur complement is known.
    pub fn is_eliminated(&self) -> bool {
        self.inverse.nrows() == self.rows.len()
    }

    /// Adds `B p`, and writes `C x + D p` to the end; between may stand what is not of the grid.
    pub fn product(&self, x: &[f64], y: &mut [f64]) {
        let first = y.len() - self.rows.len();
        let (y, out) = y.split_at_mut(first);
        let (x, p) = x.split_at(first);
        for (column, p) in self.columns.iter().zip(p) {
            y.iter_mut().zip(column).for_each(|(y, b)| *y += b * p);
        }
        for (out, row) in out.iter_mut().zip(&self.rows) {
            let (of_grid, of_scalars) = row.split_at(row.len() - p.len());
            *out = dot(of_grid, x) + dot(of_scalars, p);
        }
    }

    /// As [`Borders::product`], of the transposed equations.
    pub fn transposed_product(&self, x: &[f64], y: &mut [f64]) {
        let size = y.len() - self.rows.len();
        let (of_grid, scalars) = x.split_at(size);
        let (y, out) = y.split_at_mut(size);
        for (out, column) in out.iter_mut().zip(&self.columns) {
            *out = dot(column, of_grid);
        }
        for (row, x) in self.rows.iter().zip(scalars) {
            y.iter_mut().zip(row).for_each(|(y, c)| *y += c * x);
            let of_scalars = out.iter_mut().zip(&row[size..]);
            of_scalars.for_each(|(out, d)| *out += d * x);
        }
    }

    /// Makes of `[f; g]` on the right of the transposed equations `[Jᵀ x; p]`.
    pub fn reduce_transposed(&self, y: &mut [f64]) {
        let (f, g) = y.split_at_mut(y.len() - self.rows.len());
        let pairs = g.iter().zip(&self.eliminated);
        let rest = pairs.map(|(g, e)| g - dot(e, f));
        let found = self
            .inverse
            .tr_mul(&DVector::from_iterator(self.eliminated.len(), rest));
        for (row, p) in self.rows.iter().zip(&found) {
            f.iter_mut().zip(row).for_each(|(f, c)| *f -= c * p);
        }
        g.copy_from_slice(found.as_slice());
    }

    /// Makes of `[J⁻¹ f; g]` the solution.
    pub fn substitute(&self, y: &mut [f64]) {
        self.substitute_with(&self.eliminated, &self.inverse, y);
    }

    /// The same by other columns in place of `J⁻¹ B`, which may go on with what is not of the grid,
    /// and the inverse of their complement.
    pub fn substitute_with(&self, eliminated: &[Vec<f64>], inverse: &DMatrix<f64>, y: &mut [f64]) {
        let (x, p) = y.split_at_mut(y.len() - self.rows.len());
        let of_grid = |row: &Vec<f64>| row.len() - self.rows.len();
        let rows = p.iter().zip(&self.rows);
        let rest = rows.map(|(g, row)| g - dot(&row[..of_grid(row)], x));
        let found = inverse * DVector::from_iterator(eliminated.len(), rest);
        for (column, p) in eliminated.iter().zip(&found) {
            x.iter_mut().zip(column).for_each(|(x, e)| *x -= e * p);
        }
        p.copy_from_slice(found.as_slice());
    }
}

/// Row and column of a pivot that is none beside the others, where rows and columns are of equal
/// size.
fn smallest_pivot(matrix: &DMatrix<f64>) -> Option<[usize; 2]> {
    let mut left = matrix.clone();
    for mut column in left.column_iter_mut() {
        let size = column.amax();
        column /= if size > 0.0 { size } else { 1.0 };
    }
    for mut row in left.row_iter_mut() {
        let size = row.amax();
        row /= if size > 0.0 { size } else { 1.0 };
    }
    let (mut rows, mut columns): (Vec<_>, Vec<_>) = (0..matrix.nrows()).map(|i| (i, i)).unzip();
    while !rows.is_empty() {
        let places = rows
            .iter()
            .flat_map(|&i| columns.iter().map(move |&j| [i, j]));
        let size = |at: &[usize; 2]| left[(at[0], at[1])].abs();
        let [i, j] = places.max_by(|a, b| size(a).total_cmp(&size(b)))?;
        // Written so that NaN is none.
        let is_pivot = left[(i, j)].abs() > NO_PIVOT;
        if !is_pivot {
            return Some([i, j]);
        }
        rows.retain(|&other| other != i);
        columns.retain(|&other| other != j);
        for &row in &rows {
            let factor = left[(row, j)] / left[(i, j)];
            for &column in &columns {
                left[(row, column)] -= factor * left[(i, column)];
            }
        }
    }
    None
}

/// `Σ a b`, as far as both go.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
