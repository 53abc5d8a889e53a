//! LU factorisation of as much of a matrix as has good pivots.

use crate::error::Result;
use crate::solve::linear::block::column_mut;
use crate::solve::linear::blocks::{Diagonal, solve_lower, subtract_matmul};
use crate::workers::Workers;
use faer::perm::swap_cols_idx;
use faer::{MatMut, Par};

/// Columns that are factored together, before those to their right are reduced.
const PANEL: usize = 32;

/// A matrix that is factored in part.
struct PartialLu<'a> {
    matrix: MatMut<'a, f64>,
    /// Number of pivots found.
    count: usize,
    rows: &'a mut [usize],
    columns: &'a mut [usize],
    sizes: &'a mut [f64],
    smallest_pivot: f64,
    /// Exchanges of rows in the present panel.
    exchanges: Vec<(usize, usize)>,
    multipliers: Vec<f64>,
}

/// Factors the first columns of `matrix`, as many as it has rows: `P A Q = L U` as far as there are
/// pivots larger than `smallest_pivot`, relative to the `sizes` of these columns; those where there
/// is none come last.
///
/// Returns the number of pivots, or an error if work is to end. Of the other rows and columns,
/// those to the right of the square among them, what remains is left in their place. `rows`,
/// `columns` and `sizes` are exchanged with those of the square.
pub(crate) fn factor_partially(
    matrix: MatMut<f64>,
    rows: &mut [usize],
    columns: &mut [usize],
    sizes: &mut [f64],
    smallest_pivot: f64,
    (parallelism, workers): (Par, &Workers),
) -> Result<usize> {
    let mut factors = PartialLu {
        matrix,
        count: 0,
        rows,
        columns,
        sizes,
        smallest_pivot,
        exchanges: Vec::with_capacity(PANEL),
        multipliers: Vec::new(),
    };
    // Columns from here on have no pivots.
    let mut end = factors.rows.len();
    while factors.count < end {
        let first = factors.count;
        let panel_end = end.min(first + PANEL);
        factors.factor_panel(panel_end);
        factors.reduce_others((first, panel_end), (parallelism, workers))?;
        let (refused, untried) = (panel_end - factors.count, end - panel_end);
        for i in 0..refused.min(untried) {
            factors.exchange_columns(factors.count + i, end - 1 - i);
        }
        end -= refused;
    }
    Ok(factors.count)
}

impl PartialLu<'_> {
    /// Factors the columns from the next to `panel_end`; those without pivots come last among them.
    fn factor_panel(&mut self, panel_end: usize) {
        let first = self.count;
        let mut end = panel_end;
        self.exchanges.clear();
        while self.count < end {
            let k = self.count;
            let column = &*column_mut(&mut self.matrix, k);
            let (mut pivot_row, mut size) = (k, 0.0);
            for (i, x) in column.iter().enumerate().skip(k) {
                if x.abs() > size {
                    (pivot_row, size) = (i, x.abs());
                }
            }
            let pivot = column[pivot_row];
            if size <= self.smallest_pivot * self.sizes[k] || !size.is_finite() {
                end -= 1;
                self.exchange_columns(k, end);
                continue;
            }
            self.exchanges.push((k, pivot_row));
            self.rows.swap(k, pivot_row);
            for j in first..panel_end {
                column_mut(&mut self.matrix, j).swap(k, pivot_row);
            }
            let column = &mut column_mut(&mut self.matrix, k)[k + 1..];
            column.iter_mut().for_each(|x| *x /= pivot);
            self.multipliers.clear();
            self.multipliers.extend_from_slice(column);
            for j in k + 1..panel_end {
                let column = &mut column_mut(&mut self.matrix, j)[k..];
                if let Some((&mut u, column)) = column.split_first_mut() {
                    let entries = column.iter_mut().zip(&self.multipliers);
                    entries.for_each(|(x, l)| *x -= l * u);
                }
            }
            self.count += 1;
        }
    }

    /// Exchanges rows outside the panel as in it, and reduces the columns to its right.
    fn reduce_others(
        &mut self,
        (first, panel_end): (usize, usize),
        (parallelism, workers): (Par, &Workers),
    ) -> Result<()> {
        let all = self.matrix.ncols();
        for j in (0..first).chain(panel_end..all) {
            let column = column_mut(&mut self.matrix, j);
            self.exchanges.iter().for_each(|&(a, b)| column.swap(a, b));
        }
        let count = self.count - first;
        let (panel, right) = self.matrix.as_mut().split_at_col_mut(panel_end);
        let panel = panel.as_ref().subcols(first, count);
        let (_, right) = right.split_at_row_mut(first);
        let (mut upper, rest) = right.split_at_row_mut(count);
        let lower = (panel.subrows(first, count), Diagonal::Ones);
        solve_lower(lower, upper.as_mut(), parallelism, workers)?;
        let below = panel.subrows(self.count, panel.nrows() - self.count);
        subtract_matmul(rest, below, upper.as_ref(), parallelism, workers)
    }

    fn exchange_columns(&mut self, a: usize, b: usize) {
        swap_cols_idx(self.matrix.as_mut(), a, b);
        self.columns.swap(a, b);
        self.sizes.swap(a, b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    /// A matrix of rank `rank` and `size` rows, with `more` columns to the right of its square.
    fn matrix_of_rank(rank: usize, size: usize, more: usize) -> Mat<f64> {
        let noise = |i: usize, j: usize| (4e4 * (1.7 * i as f64 + 0.3 * j as f64).sin()).fract();
        let left = Mat::from_fn(size, rank, noise);
        let right = Mat::from_fn(rank, size + more, |i, j| noise(j, i + 200));
        &left * &right
    }

    #[test]
    fn a_matrix_is_factored_up_to_its_rank() {
        for (rank, size) in [(0, 3), (5, 5), (37, 40), (64, 71), (90, 90), (60, 130)] {
            let original = matrix_of_rank(rank, size, 7);
            let mut matrix = original.clone();
            let mut rows: Vec<usize> = (0..size).collect();
            let mut columns = rows.clone();
            let mut sizes = vec![1.0; size];
            let count = factor_partially(
                matrix.as_mut(),
                &mut rows,
                &mut columns,
                &mut sizes,
                1e-9,
                (Par::Seq, &Workers::default()),
            )
            .unwrap();
            assert_eq!(count, rank, "of {size}");
            columns.extend(size..size + 7);
            let mut worst: f64 = 0.0;
            for i in 0..size {
                for j in 0..size + 7 {
                    // L U and, beyond the pivots, what remains: 0 within rounding, as the rank
                    // says.
                    let inner = i.min(j).min(count);
                    let mut sum: f64 = (0..inner).map(|k| matrix[(i, k)] * matrix[(k, j)]).sum();
                    if i < count && i <= j {
                        sum += matrix[(i, j)];
                    } else if j < count {
                        sum += matrix[(i, j)] * matrix[(j, j)];
                    } else {
                        worst = worst.max(matrix[(i, j)].abs());
                    }
                    worst = worst.max((sum - original[(rows[i], columns[j])]).abs());
                }
            }
            // A few hundred times the rounding of entries of the size of the rank.
            assert!(worst < 1e-11, "{size}: {worst:e}");
        }
    }
}
