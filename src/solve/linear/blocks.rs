//! Large dense factorisations and products, in blocks of little work each, so that it can be told
//! between them that work goes on.

use crate::error::Result;
use crate::workers::{Workers, join};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
    solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par};
use std::ops::Range;

/// Rows and columns of a tile of a product.
const TILE: Range<usize> = 128..256;
/// Right sides that a triangle is solved for together,
const SIDES: Range<usize> = 64..256;
/// and multiply-adds of that: about 0.1 s of a slow processor.
const SOLVE: usize = 200_000_000;
/// Parts that rows, or columns, are divided into if they are many.
const PARTS: usize = 8;
/// Widths of strips are multiples of this, for kernels.
const EVEN: usize = 8;

/// Rows or columns of a part, of so many in all, within bounds.
fn part(all: usize, bounds: Range<usize>) -> usize {
    (all / PARTS).clamp(bounds.start, bounds.end)
}

/// Something of several columns.
pub(crate) trait Columns: Send + Sized {
    /// Number of columns.
    fn columns(&self) -> usize;
    /// The first columns, so many, and the others.
    fn split(self, first: usize) -> (Self, Self);
}

impl Columns for MatMut<'_, f64> {
    fn columns(&self) -> usize {
        self.ncols()
    }

    fn split(self, first: usize) -> (Self, Self) {
        self.split_at_col_mut(first)
    }
}

/// As many columns of two.
impl<A: Columns, B: Columns> Columns for (A, B) {
    fn columns(&self) -> usize {
        self.0.columns()
    }

    fn split(self, first: usize) -> (Self, Self) {
        let ((a, b), (c, d)) = (self.0.split(first), self.1.split(first));
        ((a, c), (b, d))
    }
}

/// Works on strips of columns no wider than `most`, which are the same for any number of threads:
/// side by side if there are several. `work` is told where each begins.
///
/// # Errors
/// Those of `work`, and if it is to end, as of all functions here.
pub(crate) fn strips<T: Columns>(
    all: T,
    most: usize,
    shared: (Par, &Workers),
    work: &(impl Fn(usize, T) -> Result<()> + Sync),
) -> Result<()> {
    strips_from(0, all, most, shared, work)
}

fn strips_from<T: Columns>(
    first: usize,
    all: T,
    most: usize,
    (par, workers): (Par, &Workers),
    work: &(impl Fn(usize, T) -> Result<()> + Sync),
) -> Result<()> {
    let columns = all.columns();
    let count = columns.div_ceil(most);
    if count < 2 {
        workers.pulse()?;
        return work(first, all);
    }
    let width = columns.div_ceil(count).next_multiple_of(EVEN).min(most);
    let half = count / 2 * width;
    let (left, right) = all.split(half);
    let each = |first, some| strips_from(first, some, most, (par, workers), work);
    let (left, right) = match par {
        Par::Seq => (each(first, left), each(first + half, right)),
        Par::Rayon(_) => join(|| each(first, left), || each(first + half, right)),
    };
    left.and(right)
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
    let (height, width) = (part(c.nrows(), TILE), part(c.ncols(), TILE));
    let all = (par, workers);
    strips(c, width, all, &|column, c| {
        let b = b.subcols(column, c.ncols());
        strips(c.transpose_mut(), height, all, &|row, c| {
            let a = a.subrows(row, c.ncols());
            matmul(c.transpose_mut(), Accum::Add, a, b, -1.0, Par::Seq);
            Ok(())
        })
    })
}

/// Right sides, of so many in all, that a triangle of this size is solved for together.
fn sides(size: usize, all: usize) -> usize {
    let most = 2 * SOLVE / (size * size).max(1);
    part(all, SIDES).min(most.max(SIDES.start / 2))
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
    let sides = sides(l.nrows(), x.ncols());
    strips(x, sides, (par, workers), &|_, x| {
        solve(l, x, Par::Seq);
        Ok(())
    })
}

/// `X = U⁻¹ X` with the upper triangle of `u`.
pub(crate) fn solve_upper(
    u: MatRef<f64>,
    x: MatMut<f64>,
    par: Par,
    workers: &Workers,
) -> Result<()> {
    let sides = sides(u.nrows(), x.ncols());
    strips(x, sides, (par, workers), &|_, x| {
        solve_upper_triangular_in_place(u, x, Par::Seq);
        Ok(())
    })
}
