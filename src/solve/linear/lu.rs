//! Dense LU factorisation with pivots in rows, in panels: while threads reduce what is to the right
//! of a panel, one of them factors the next. See docs/theory.md, section 8.1.

use crate::error::Result;
use crate::solve::linear::blocks::strips;
use crate::workers::{Workers, join};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};

/// Columns of a panel.
const PANEL: usize = 64;
/// Columns that are eliminated one by one.
const NARROW: usize = 8;
/// Columns of a strip to the right of a panel at most.
const STRIP: usize = 128;

/// A panel that is factored.
struct Panel<'a> {
    /// From its first row on.
    factors: MatRef<'a, f64>,
    /// How far down the row is that each of its rows was exchanged with.
    exchanges: &'a [usize],
}

/// Factors the first columns of `matrix`, as many as it has rows, and reduces those to their right:
/// row `i` of `L U`, or of `L⁻¹` times these, is row `order[i]` of it. `accepts` is told place and
/// size of each pivot: `false`, and no more is done, where it refuses one.
///
/// # Errors
/// If work is to end.
pub(crate) fn factor(
    matrix: MatMut<f64>,
    order: &mut [usize],
    accepts: impl Fn(usize, f64) -> bool,
    (par, workers): (Par, &Workers),
) -> Result<bool> {
    let size = matrix.nrows();
    let mut exchanges = vec![0; size];
    let mut done: Vec<MatMut<f64>> = Vec::with_capacity(size.div_ceil(PANEL));
    let (mut first, mut width) = (0, PANEL.min(size));
    let (mut own, mut right) = matrix.split_at_col_mut(width);
    factor_panel(own.as_mut(), &mut exchanges[..width]);
    while width > 0 {
        let accepted = |j: usize| accepts(first + j, own[(first + j, j)].abs());
        if !(0..width).all(accepted) {
            return Ok(false);
        }
        workers.pulse()?;
        let left = size - first;
        let next_width = PANEL.min(left - width);
        let (mut next, mut others) = right.split_at_col_mut(next_width);
        let (now, later) = exchanges[first..].split_at_mut(width);
        let panel = Panel {
            factors: own.as_ref().subrows(first, left),
            exchanges: now,
        };
        let mut prepare = || {
            let mut next = next.as_mut().subrows_mut(first, left);
            panel.reduce(next.as_mut());
            let next = next.subrows_mut(width, left - width);
            factor_panel(next, &mut later[..next_width]);
        };
        let mut reduce = || {
            let others = others.as_mut().subrows_mut(first, left);
            strips(others, STRIP, (par, workers), &|_, strip| {
                panel.reduce(strip);
                Ok(())
            })
        };
        match par {
            Par::Seq => {
                prepare();
                reduce()?;
            }
            Par::Rayon(_) => join(prepare, reduce).1?,
        }
        done.push(own);
        (own, right) = (next, others);
        (first, width) = (first + width, next_width);
    }
    order.iter_mut().enumerate().for_each(|(i, row)| *row = i);
    for (i, down) in exchanges.iter().enumerate() {
        order.swap(i, i + down);
    }
    // Rows of a panel are exchanged with those of all that follow.
    let mut first = 0;
    for panel in done {
        first += panel.ncols();
        exchange(panel.subrows_mut(first, size - first), &exchanges[first..]);
    }
    Ok(true)
}

/// Exchanges rows, the first with that so far down, then the second, and so on.
fn exchange(matrix: MatMut<f64>, exchanges: &[usize]) {
    for column in matrix.col_iter_mut() {
        let Some(column) = column.try_as_col_major_mut() else {
            continue;
        };
        let column = column.as_slice_mut();
        for (i, down) in exchanges.iter().enumerate() {
            column.swap(i, i + down);
        }
    }
}

impl Panel<'_> {
    /// Reduces columns to its right, from its first row on.
    fn reduce(&self, mut columns: MatMut<f64>) {
        if columns.ncols() == 0 {
            return;
        }
        exchange(columns.as_mut(), self.exchanges);
        let (square, below) = self.factors.split_at_row(self.factors.ncols());
        let (mut upper, rest) = columns.split_at_row_mut(square.nrows());
        solve_unit_lower_triangular_in_place(square, upper.as_mut(), Par::Seq);
        matmul(rest, Accum::Add, below, upper.as_ref(), -1.0, Par::Seq);
    }
}

/// Factors a matrix of no more columns than rows, by halves of the columns.
fn factor_panel(mut matrix: MatMut<f64>, exchanges: &mut [usize]) {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    if columns <= NARROW {
        return factor_narrow(matrix, exchanges);
    }
    let half = (columns / 2).next_multiple_of(NARROW);
    let (first, second) = exchanges.split_at_mut(half);
    let (mut left, mut right) = matrix.as_mut().split_at_col_mut(half);
    factor_panel(left.as_mut(), first);
    let done = Panel {
        factors: left.as_ref(),
        exchanges: first,
    };
    done.reduce(right.as_mut());
    factor_panel(right.subrows_mut(half, rows - half), second);
    exchange(left.subrows_mut(half, rows - half), second);
}

/// The same, column by column.
fn factor_narrow(matrix: MatMut<f64>, exchanges: &mut [usize]) {
    let count = matrix.ncols();
    let columns = matrix.col_iter_mut();
    let mut columns =
        columns.filter_map(|column| Some(column.try_as_col_major_mut()?.as_slice_mut()));
    let mut columns: [&mut [f64]; NARROW] =
        std::array::from_fn(|_| columns.next().unwrap_or_default());
    let columns = &mut columns[..count];
    for k in 0..count {
        let (mut pivot, mut size) = (k, 0.0);
        for (i, x) in columns[k].iter().enumerate().skip(k) {
            if x.abs() > size {
                (pivot, size) = (i, x.abs());
            }
        }
        exchanges[k] = pivot - k;
        if pivot != k {
            columns.iter_mut().for_each(|column| column.swap(k, pivot));
        }
        let (done, others) = columns.split_at_mut(k + 1);
        let Some((head, multipliers)) = done[k][k..].split_first_mut() else {
            continue;
        };
        let inverse = 1.0 / *head;
        multipliers.iter_mut().for_each(|x| *x *= inverse);
        for column in others {
            if let Some((&mut u, column)) = column[k..].split_first_mut() {
                let entries = column.iter_mut().zip(&*multipliers);
                entries.for_each(|(x, l)| *x -= l * u);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    fn noise(i: usize, j: usize) -> f64 {
        (4e4 * (1.7 * i as f64 + 0.3 * j as f64).sin()).fract()
    }

    /// Factors by so many threads, and the order of rows.
    fn factored(original: &Mat<f64>, threads: usize) -> (Mat<f64>, Vec<usize>) {
        let (mut matrix, mut order) = (original.clone(), vec![0; original.nrows()]);
        let workers = Workers::new(threads).unwrap();
        let all = |_: usize, _: f64| true;
        let done = workers.dense(|par| factor(matrix.as_mut(), &mut order, all, (par, &workers)));
        assert!(done.unwrap());
        (matrix, order)
    }

    #[test]
    fn factors_give_the_matrix_and_are_the_same_by_several_threads() {
        for (size, more) in [
            (0, 3),
            (1, 0),
            (5, 9),
            (64, 0),
            (65, 200),
            (200, 131),
            (333, 500),
        ] {
            let original = Mat::from_fn(size, size + more, noise);
            let (matrix, order) = factored(&original, 1);
            for threads in [2, 3] {
                let (other, other_order) = factored(&original, threads);
                assert!(other == matrix && other_order == order, "{size}");
            }
            let lower = Mat::from_fn(size, size, |i, j| match i.cmp(&j) {
                std::cmp::Ordering::Greater => matrix[(i, j)],
                std::cmp::Ordering::Equal => 1.0,
                std::cmp::Ordering::Less => 0.0,
            });
            let upper = Mat::from_fn(size, size + more, |i, j| match i <= j {
                true => matrix[(i, j)],
                false => 0.0,
            });
            // Pivots were the largest.
            let largest = |m: &Mat<f64>| m.col_iter().fold(0.0f64, |x, c| x.max(c.norm_max()));
            assert!(largest(&lower) <= 1.0);
            let product = &lower * &upper;
            let difference = Mat::from_fn(size, size + more, |i, j| {
                product[(i, j)] - original[(order[i], j)]
            });
            // A thousand times the rounding of the largest entry of the factors.
            let bound = 1e3 * f64::EPSILON * largest(&upper);
            assert!(largest(&difference) <= bound, "{:e}", largest(&difference));
        }
    }

    #[test]
    fn it_ends_at_the_first_pivot_that_is_refused() {
        let mut matrix = Mat::from_fn(150, 150, noise);
        let copied = matrix.col(70).to_owned();
        matrix.col_mut(90).copy_from(&copied);
        let accepts = |_: usize, size: f64| size > 1e-10;
        let mut order = vec![0; 150];
        let alone = (Par::Seq, &Workers::default());
        assert!(!factor(matrix.as_mut(), &mut order, accepts, alone).unwrap());
    }
}
