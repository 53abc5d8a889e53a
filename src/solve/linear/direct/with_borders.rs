//! Factors of a matrix between borders, of which the last unknowns are eliminated last
//! (docs/theory.md, section 8.8).

use super::DirectSolver;
use super::structure::Structure;
use crate::collocation::{Panel, Pattern};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::dense::largest;
use crate::solve::linear::solver::Side;
use crate::workers::Workers;

/// Factors of matrices of one pattern, with as many rows and columns beside it.
#[derive(Debug)]
pub(crate) struct WithBorders {
    solver: DirectSolver,
    /// Number of unknowns of the pattern, and of its values, which those of borders follow.
    size: usize,
    first: usize,
    /// Factors that bring rows and columns of borders to the size of others.
    rows: Vec<f64>,
    columns: Vec<f64>,
}

impl WithBorders {
    /// For matrices of `pattern` between borders of `count` rows and columns.
    pub fn new(pattern: &Pattern, count: usize, workers: Workers) -> Self {
        let (size, first) = (pattern.size(), pattern.entries());
        let structure = Structure::of(pattern);
        let groups = &structure.groups;
        let (last, long) = (groups.len(), size + count);
        let of_rows = first + long * count;
        let panel = |[row, column]: [usize; 2], [rows, columns]: [usize; 2], value, stride| Panel {
            row: (row, 0),
            column: (column, 0),
            rows,
            columns,
            value,
            stride,
        };
        let mut between = Vec::with_capacity(2 * last + 1);
        for (g, group) in groups.iter().enumerate() {
            let (beside, below) = (first + group.start, of_rows + group.start * count);
            between.push(panel([g, last], [group.len(), count], beside, long));
            between.push(panel([last, g], [count, group.len()], below, count));
        }
        between.push(panel([last; 2], [count; 2], first + size, long));
        let structure = structure.bordered(size..long, between);
        let solver = DirectSolver::of_structure(structure, workers);
        WithBorders {
            solver,
            size,
            first,
            rows: vec![1.0; count],
            columns: vec![1.0; count],
        }
    }

    /// Number of rows beside the pattern.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// Number of values, with those of borders.
    pub fn entries(&self) -> usize {
        let count = self.count();
        self.first + (2 * self.size + count) * count
    }

    /// Writes `borders` behind the values of the pattern, and factors all. `false` if that is
    /// singular.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn factor(&mut self, values: &mut [f64], borders: &Borders) -> Result<bool> {
        let (size, count) = (self.size, self.count());
        for (factor, column) in self.columns.iter_mut().zip(&borders.columns) {
            *factor = to_one(largest(column));
        }
        for (factor, row) in self.rows.iter_mut().zip(&borders.rows) {
            let own = row[size..].iter().zip(&self.columns);
            let own = own.fold(0.0, |most: f64, (d, scale)| most.max((d * scale).abs()));
            *factor = to_one(largest(&row[..size]).max(own));
        }
        let (columns, rows) = values[self.first..].split_at_mut((size + count) * count);
        let all = columns
            .chunks_exact_mut((size + count).max(1))
            .zip(&borders.columns);
        for (j, (to, column)) in all.enumerate() {
            let scale = self.columns[j];
            let (beside, corner) = to.split_at_mut(size);
            let entries = beside.iter_mut().zip(column);
            entries.for_each(|(to, b)| *to = scale * b);
            let entries = corner.iter_mut().zip(self.rows.iter().zip(&borders.rows));
            entries.for_each(|(to, (factor, row))| *to = factor * scale * row[size + j]);
        }
        for (j, to) in rows.chunks_exact_mut(count.max(1)).enumerate() {
            let entries = to.iter_mut().zip(self.rows.iter().zip(&borders.rows));
            entries.for_each(|(to, (factor, row))| *to = factor * row[j]);
        }
        self.solver.factor(values)
    }

    /// As [`DirectSolver::solve_refined`].
    ///
    /// # Errors
    /// If memory runs out.
    pub fn solve_refined(
        &mut self,
        values: &[f64],
        rhs: &mut [f64],
        accuracy: (usize, f64),
    ) -> Result<bool> {
        multiply(&mut rhs[self.size..], &self.rows);
        let solved = self.solver.solve_refined(values, rhs, accuracy)?;
        multiply(&mut rhs[self.size..], &self.columns);
        Ok(solved)
    }

    /// Solves in place, without refinement. `false` if there are no factors or the result is not
    /// finite.
    pub fn solve(&self, rhs: &mut [f64], side: Side) -> bool {
        let (before, after) = match side {
            Side::Plain => (&self.rows, &self.columns),
            Side::Transposed => (&self.columns, &self.rows),
        };
        multiply(&mut rhs[self.size..], before);
        let solved = match side {
            Side::Plain => self.solver.solve(rhs),
            Side::Transposed => self.solver.solve_transposed(rhs),
        };
        multiply(&mut rhs[self.size..], after);
        solved
    }

    /// As [`DirectSolver::error`].
    pub fn error(&self) -> f64 {
        self.solver.error()
    }
}

fn multiply(x: &mut [f64], factors: &[f64]) {
    x.iter_mut()
        .zip(factors)
        .for_each(|(x, factor)| *x *= factor);
}

/// A power of two that brings a size to about 1.
fn to_one(size: f64) -> f64 {
    match size > 0.0 && size.is_finite() {
        true => (-size.log2().floor()).exp2(),
        false => 1.0,
    }
}
