//! Large dense factorisations and products, in blocks of little work each, so that it can be told
//! between them that work goes on.

use crate::error::Result;
use crate::memory;
use crate::workers::Workers;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
    solve_upper_triangular_in_place,
};
use faer::{Accum, Mat, MatMut, MatRef, Par};

/// Multiply-adds of a block: about 0.1 s of a slow processor.
const BLOCK: usize = 200_000_000;
/// Columns of a block at least.
const LEAST: usize = 32;
/// Columns of a panel of a factorisation.
const PANEL: usize = 256;
/// Matrices up to this size are factored in one piece.
const WHOLE: usize = 1024;

/// Takes memory for a matrix.
pub(crate) fn reserve(matrix: &mut Mat<f64>, rows: usize, columns: usize) -> Result<()> {
    matrix.try_reserve(rows, columns).map_err(|_| {
        let bytes = rows
            .saturating_mul(columns)
            .saturating_mul(size_of::<f64>());
        memory::lacking(&format!("a dense block of {rows} × {columns}"), bytes)
    })
}

/// Columns of a block, where each takes so many multiply-adds.
fn block(work: usize) -> usize {
    (BLOCK / work.max(1)).max(LEAST)
}

/// Works on the columns of a matrix, block by block.
fn by_columns(
    matrix: MatMut<f64>,
    work: usize,
    workers: &Workers,
    mut each: impl FnMut(usize, MatMut<f64>),
) -> Result<()> {
    let (columns, width) = (matrix.ncols(), block(work));
    let mut rest = matrix;
    for first in (0..columns).step_by(width) {
        let (now, others) = rest.split_at_col_mut(width.min(columns - first));
        each(first, now);
        rest = others;
        workers.pulse()?;
    }
    Ok(())
}

/// `C -= A B`.
///
/// # Errors
/// If work is to end, as of all functions here.
pub(crate) fn subtract_matmul(
    c: MatMut<f64>,
    a: MatRef<f64>,
    b: MatRef<f64>,
    par: Par,
    workers: &Workers,
) -> Result<()> {
    by_columns(c, a.nrows() * a.ncols(), workers, |first, c| {
        let b = b.subcols(first, c.ncols());
        matmul(c, Accum::Add, a, b, -1.0, par);
    })
}

/// The diagonal of a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Diagonal {
    /// That of the matrix.
    Own,
    /// Ones instead.
    Ones,
}

/// `X = L⁻¹ X` with the lower triangle of `l`.
pub(crate) fn solve_lower(
    (l, diagonal): (MatRef<f64>, Diagonal),
    x: MatMut<f64>,
    par: Par,
    workers: &Workers,
) -> Result<()> {
    let solve = match diagonal {
        Diagonal::Own => solve_lower_triangular_in_place,
        Diagonal::Ones => solve_unit_lower_triangular_in_place,
    };
    by_columns(x, l.nrows() * l.nrows() / 2, workers, |_, x| {
        solve(l, x, par)
    })
}

/// `X = U⁻¹ X` with the upper triangle of `u`.
pub(crate) fn solve_upper(
    u: MatRef<f64>,
    x: MatMut<f64>,
    par: Par,
    workers: &Workers,
) -> Result<()> {
    by_columns(x, u.nrows() * u.nrows() / 2, workers, |_, x| {
        solve_upper_triangular_in_place(u, x, par)
    })
}

/// Factors a square matrix in its place: row `i` of `L U` is row `permutation[i]` of it.
pub(crate) fn lu(
    mut matrix: MatMut<f64>,
    permutation: &mut [usize],
    inverse: &mut [usize],
    par: Par,
    memory: &mut MemBuffer,
    workers: &Workers,
) -> Result<()> {
    let size = matrix.nrows();
    if size <= WHOLE {
        let memory = MemStack::new(memory);
        lu_in_place(
            matrix,
            permutation,
            inverse,
            par,
            memory,
            Default::default(),
        );
        return workers.pulse();
    }
    permutation.iter_mut().enumerate().for_each(|(i, p)| *p = i);
    let need = lu_in_place_scratch::<usize, f64>(size, PANEL, par, Default::default());
    let mut memory = MemBuffer::new(need);
    let (mut order, mut reverse) = (vec![0; size], vec![0; size]);
    for first in (0..size).step_by(PANEL) {
        let (width, left) = (PANEL.min(size - first), size - first);
        let order = &mut order[..left];
        lu_in_place(
            matrix.as_mut().submatrix_mut(first, first, left, width),
            order,
            &mut reverse[..left],
            par,
            MemStack::new(&mut memory),
            Default::default(),
        );
        workers.pulse()?;
        // Few rows change their places.
        let moved: Vec<(usize, usize)> = (order.iter().enumerate())
            .filter(|(to, from)| to != *from)
            .map(|(to, &from)| (first + to, first + from))
            .collect();
        let rows: Vec<usize> = moved.iter().map(|&(_, from)| permutation[from]).collect();
        for (&(to, _), row) in moved.iter().zip(rows) {
            permutation[to] = row;
        }
        let mut values = Vec::with_capacity(moved.len());
        for j in (0..first).chain(first + width..size) {
            let mut column = matrix.as_mut().col_mut(j);
            values.clear();
            values.extend(moved.iter().map(|&(_, from)| column[from]));
            for (&(to, _), value) in moved.iter().zip(&values) {
                column[to] = *value;
            }
        }
        workers.pulse()?;
        let (done, right) = matrix.as_mut().split_at_col_mut(first + width);
        let done = done.as_ref().subcols(first, width);
        let (_, right) = right.split_at_row_mut(first);
        let (mut upper, rest) = right.split_at_row_mut(width);
        let below = done.subrows(first + width, left - width);
        let lower = (done.subrows(first, width), Diagonal::Ones);
        solve_lower(lower, upper.as_mut(), par, workers)?;
        subtract_matmul(rest, below, upper.as_ref(), par, workers)?;
    }
    for (i, &row) in permutation.iter().enumerate() {
        inverse[row] = i;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    #[test]
    fn factors_in_panels_are_those_of_the_whole() {
        // Three panels and a part of one behind the last whole one.
        let size = WHOLE + PANEL / 2;
        let noise = |i: usize, j: usize| (4e4 * (1.7 * i as f64 + 0.3 * j as f64).sin()).fract();
        let original = Mat::from_fn(size, size, noise);
        let mut matrix = original.clone();
        let (mut permutation, mut inverse) = (vec![0; size], vec![0; size]);
        let workers = Workers::default();
        let mut memory = MemBuffer::new(faer::dyn_stack::StackReq::EMPTY);
        let (p, q) = (&mut permutation[..], &mut inverse[..]);
        lu(matrix.as_mut(), p, q, Par::Seq, &mut memory, &workers).unwrap();
        assert!((0..size).all(|i| inverse[permutation[i]] == i));
        let lower = Mat::from_fn(size, size, |i, j| match i.cmp(&j) {
            std::cmp::Ordering::Greater => matrix[(i, j)],
            std::cmp::Ordering::Equal => 1.0,
            std::cmp::Ordering::Less => 0.0,
        });
        let upper = Mat::from_fn(size, size, |i, j| if i <= j { matrix[(i, j)] } else { 0.0 });
        // Pivots were the largest.
        let largest = |m: &Mat<f64>| m.col_iter().fold(0.0f64, |x, c| x.max(c.norm_max()));
        assert!(largest(&lower) <= 1.0);
        let product = &lower * &upper;
        let difference = Mat::from_fn(size, size, |i, j| {
            product[(i, j)] - original[(permutation[i], j)]
        });
        // A thousand times the rounding of the largest entry of the factors.
        let bound = 1e3 * f64::EPSILON * largest(&upper);
        assert!(largest(&difference) < bound, "{:e}", largest(&difference));
    }
}
