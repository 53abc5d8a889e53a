//! Substitution of several right sides at a time, by dense products of the factors with all of
//! them.

use super::DirectSolver;
use crate::error::Result;
use crate::solve::linear::block::{column, column_mut};
use crate::solve::linear::blocks::{Diagonal, solve_lower, solve_upper, subtract_matmul};
use crate::solve::linear::front::Front;
use faer::{Mat, MatMut, Par};

/// Memory for substitutions of several right sides.
#[derive(Debug)]
pub struct Columns {
    /// What each front's equations come to, one front after the other.
    reduced: Mat<f64>,
    /// Those of a front's boundary.
    boundary: Mat<f64>,
    /// A right side in the order of elimination.
    ordered: Vec<f64>,
}

impl Default for Columns {
    fn default() -> Self {
        Columns {
            reduced: Mat::new(),
            boundary: Mat::new(),
            ordered: Vec::new(),
        }
    }
}

impl Columns {
    fn resize(&mut self, rows: usize, boundary: usize, columns: usize) {
        let grow = |matrix: &mut Mat<f64>, rows: usize| {
            if matrix.nrows() < rows || matrix.ncols() < columns {
                *matrix = Mat::zeros(rows, columns);
            }
        };
        grow(&mut self.reduced, rows);
        grow(&mut self.boundary, boundary);
    }
}

impl DirectSolver {
    /// As [`DirectSolver::solve`], for each column.
    ///
    /// # Errors
    /// If work is to end.
    pub fn solve_columns(&self, mut rhs: MatMut<f64>, memory: &mut Columns) -> Result<bool> {
        if !self.factored {
            return Ok(false);
        }
        let (size, count) = (rhs.nrows(), rhs.ncols());
        let Columns { ordered, .. } = memory;
        for j in 0..count {
            self.put_in_order(column_mut(&mut rhs, j), ordered);
        }
        let beyond = self.fronts.iter().map(Front::left_over);
        memory.resize(size, beyond.max().unwrap_or(0), count);
        let (mut reduced, mut boundary) = (
            memory.reduced.as_mut().subcols_mut(0, count),
            memory.boundary.as_mut().subcols_mut(0, count),
        );
        let plans = self.analysis.plans.iter().map(|plan| &plan.boundary[..]);
        let mut first = 0;
        for (groups, front) in plans.clone().zip(&self.fronts) {
            let own = front.rows.len();
            let mut y = reduced.as_mut().subrows_mut(first, own);
            self.gather_columns(&front.rows, &[], rhs.as_mut(), y.as_mut());
            let (square, delayed) = front.upper().as_ref().subcols(0, own).split_at_row(own);
            let square = (square, Diagonal::Ones);
            solve_lower(square, y.as_mut(), Par::Seq, &self.workers)?;
            let mut local = boundary.as_mut().subrows_mut(0, front.left_over());
            self.gather_columns(&front.delayed_rows, groups, rhs.as_mut(), local.as_mut());
            let (above, below) = local.as_mut().split_at_row_mut(delayed.nrows());
            let lower = front.lower().as_ref().subcols(0, own);
            for (part, factors) in [(above, delayed), (below, lower)] {
                subtract_matmul(part, factors, y.as_ref(), Par::Seq, &self.workers)?;
            }
            self.scatter_columns(&front.delayed_rows, groups, local, rhs.as_mut());
            first += own;
        }
        for (groups, front) in plans.zip(&self.fronts).rev() {
            let own = front.rows.len();
            first -= own;
            let mut y = reduced.as_mut().subrows_mut(first, own);
            let mut local = boundary.as_mut().subrows_mut(0, front.left_over());
            self.gather_columns(&front.delayed_columns, groups, rhs.as_mut(), local.as_mut());
            let upper = front.upper().as_ref().subrows(0, own);
            let (factors, beyond) = upper.split_at_col(own);
            subtract_matmul(y.as_mut(), beyond, local.as_ref(), Par::Seq, &self.workers)?;
            solve_upper(factors, y.as_mut(), Par::Seq, &self.workers)?;
            self.scatter_columns(&front.columns, &[], y, rhs.as_mut());
        }
        let Columns { ordered, .. } = memory;
        for j in 0..count {
            self.put_back(column_mut(&mut rhs, j), ordered);
        }
        let is_finite = |j: usize| rhs.as_ref().col(j).iter().all(|x| x.is_finite());
        Ok((0..count).all(is_finite))
    }

    /// Rows at some places, and those of some groups.
    fn gather_columns(
        &self,
        places: &[usize],
        groups: &[usize],
        from: MatMut<f64>,
        mut to: MatMut<f64>,
    ) {
        for j in 0..to.ncols() {
            let (from, to) = (column(from.as_ref(), j), column_mut(&mut to, j));
            self.gather_to(places, groups, from, to);
        }
    }

    /// The reverse.
    fn scatter_columns(
        &self,
        places: &[usize],
        groups: &[usize],
        from: MatMut<f64>,
        mut to: MatMut<f64>,
    ) {
        for j in 0..to.ncols() {
            let (from, to) = (column(from.as_ref(), j), column_mut(&mut to, j));
            self.scatter(places, groups, from, to);
        }
    }
}
