//! Products and triangular solves with one vector, by the vector instructions that the processor
//! has: bound by memory, so several columns are read at a time.

use faer::traits::pulp::{Arch, Simd, WithSimd};
use std::array::from_fn;
use std::marker::PhantomData;

/// Columns that are taken together, and of those that are left.
const TOGETHER: usize = 8;
const FEW: usize = 4;

/// `y −= A x`, for the matrix with these columns.
pub(crate) fn subtract_product<'a>(y: &mut [f64], column: impl Fn(usize) -> &'a [f64], x: &[f64]) {
    run::<Product>(y, &column, x);
}

/// `y ← L⁻¹ y`, for the unit lower triangle below the diagonal of the matrix with these columns.
pub(crate) fn solve_unit_lower<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    run::<Lower>(y, &column, &[]);
}

/// `y ← U⁻¹ y`, for the upper triangle of the matrix with these columns.
pub(crate) fn solve_upper<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    run::<Upper>(y, &column, &[]);
}

/// `y −= Aᵀ x`, for the matrix with these columns, one for each entry of `y`.
pub(crate) fn subtract_transposed<'a>(
    y: &mut [f64],
    column: impl Fn(usize) -> &'a [f64],
    x: &[f64],
) {
    run::<TransposedProduct>(y, &column, x);
}

/// `y ← L⁻ᵀ y`, for the unit lower triangle below the diagonal of the matrix with these columns.
pub(crate) fn solve_unit_lower_transposed<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    run::<TransposedLower>(y, &column, &[]);
}

/// `y ← U⁻ᵀ y`, for the upper triangle of the matrix with these columns.
pub(crate) fn solve_upper_transposed<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    run::<TransposedUpper>(y, &column, &[]);
}

/// What is done to `y` with a matrix and `x`.
trait Kernel {
    fn run<'a, S: Simd>(simd: S, y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], x: &[f64]);
}

struct Run<'v, F, K> {
    y: &'v mut [f64],
    column: &'v F,
    x: &'v [f64],
    kernel: PhantomData<K>,
}

impl<'a, F: Fn(usize) -> &'a [f64], K: Kernel> WithSimd for Run<'_, F, K> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        K::run(simd, self.y, self.column, self.x);
    }
}

fn run<'a, K: Kernel>(y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], x: &[f64]) {
    let kernel = PhantomData::<K>;
    Arch::new().dispatch(Run {
        y,
        column,
        x,
        kernel,
    });
}

struct Product;

impl Kernel for Product {
    #[inline(always)]
    fn run<'a, S: Simd>(simd: S, y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], x: &[f64]) {
        let together = x.len() / TOGETHER * TOGETHER;
        let few = x.len() / FEW * FEW;
        for first in (0..together).step_by(TOGETHER) {
            subtract::<S, TOGETHER>(simd, y, column, (first, &x[first..]));
        }
        for first in (together..few).step_by(FEW) {
            subtract::<S, FEW>(simd, y, column, (first, &x[first..]));
        }
        for first in few..x.len() {
            subtract::<S, 1>(simd, y, column, (first, &x[first..]));
        }
    }
}

/// `y −= A x` for `N` columns from the first on and as many entries of `x`. Each row is summed up
/// in the same order, wherever it stands.
#[inline(always)]
fn subtract<'a, S: Simd, const N: usize>(
    simd: S,
    y: &mut [f64],
    column: &impl Fn(usize) -> &'a [f64],
    (first, x): (usize, &[f64]),
) {
    let rows = y.len();
    let columns: [_; N] = from_fn(|j| S::as_simd_f64s(&column(first + j)[..rows]));
    let factors: [_; N] = from_fn(|j| simd.splat_f64s(-x[j]));
    let (y, end) = S::as_mut_simd_f64s(y);
    let whole = columns.map(|(whole, _)| &whole[..y.len()]);
    for (i, y) in y.iter_mut().enumerate() {
        for j in 0..N {
            *y = simd.mul_add_e_f64s(factors[j], whole[j][i], *y);
        }
    }
    if !end.is_empty() {
        let mut sum = simd.partial_load_f64s(end);
        for j in 0..N {
            let part = simd.partial_load_f64s(columns[j].1);
            sum = simd.mul_add_e_f64s(factors[j], part, sum);
        }
        simd.partial_store_f64s(end, sum);
    }
}

struct Lower;

impl Kernel for Lower {
    #[inline(always)]
    fn run<'a, S: Simd>(simd: S, y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], _: &[f64]) {
        for (start, end) in groups(y.len()) {
            for j in start..end {
                let (column, known) = (&column(j)[..end], y[j]);
                for i in j + 1..end {
                    y[i] -= column[i] * known;
                }
            }
            let (found, rest) = y.split_at_mut(end);
            let below = |j: usize| &column(start + j)[end..];
            Product::run(simd, rest, &below, &found[start..]);
        }
    }
}

struct Upper;

impl Kernel for Upper {
    #[inline(always)]
    fn run<'a, S: Simd>(simd: S, y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], _: &[f64]) {
        for (start, end) in groups(y.len()).rev() {
            // Divided beforehand, as no quotient has to wait for another.
            let mut inverses = [0.0; TOGETHER];
            for (inverse, j) in inverses.iter_mut().zip(start..end) {
                *inverse = 1.0 / column(j)[j];
            }
            for j in (start..end).rev() {
                y[j] *= inverses[j - start];
                let (column, known) = (&column(j)[..j], y[j]);
                for i in start..j {
                    y[i] -= column[i] * known;
                }
            }
            let (rest, found) = y.split_at_mut(start);
            let above = |j: usize| column(start + j);
            Product::run(simd, rest, &above, &found[..end - start]);
        }
    }
}

struct TransposedProduct;

impl Kernel for TransposedProduct {
    #[inline(always)]
    fn run<'a, S: Simd>(simd: S, y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], x: &[f64]) {
        let few = y.len() / FEW * FEW;
        for first in (0..few).step_by(FEW) {
            subtract_sums::<S, FEW>(simd, &mut y[first..], column, (first, x));
        }
        for first in few..y.len() {
            subtract_sums::<S, 1>(simd, &mut y[first..], column, (first, x));
        }
    }
}

/// `y −= Aᵀ x` for `N` columns from the first on and as many entries of `y`.
#[inline(always)]
fn subtract_sums<'a, S: Simd, const N: usize>(
    simd: S,
    y: &mut [f64],
    column: &impl Fn(usize) -> &'a [f64],
    (first, x): (usize, &[f64]),
) {
    let columns: [_; N] = from_fn(|j| S::as_simd_f64s(&column(first + j)[..x.len()]));
    let (x, end) = S::as_simd_f64s(x);
    let whole = columns.map(|(whole, _)| &whole[..x.len()]);
    let mut sums = [simd.splat_f64s(0.0); N];
    for (i, x) in x.iter().enumerate() {
        for j in 0..N {
            sums[j] = simd.mul_add_e_f64s(whole[j][i], *x, sums[j]);
        }
    }
    let end = simd.partial_load_f64s(end);
    for j in 0..N {
        let part = simd.partial_load_f64s(columns[j].1);
        y[j] -= simd.reduce_sum_f64s(simd.mul_add_e_f64s(part, end, sums[j]));
    }
}

struct TransposedLower;

impl Kernel for TransposedLower {
    #[inline(always)]
    fn run<'a, S: Simd>(simd: S, y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], _: &[f64]) {
        for (start, end) in groups(y.len()).rev() {
            let (head, found) = y.split_at_mut(end);
            let own = &mut head[start..];
            let below = |j: usize| &column(start + j)[end..];
            TransposedProduct::run(simd, own, &below, found);
            for j in (start..end).rev() {
                let column = &column(j)[..end];
                for i in j + 1..end {
                    own[j - start] -= column[i] * own[i - start];
                }
            }
        }
    }
}

struct TransposedUpper;

impl Kernel for TransposedUpper {
    #[inline(always)]
    fn run<'a, S: Simd>(simd: S, y: &mut [f64], column: &impl Fn(usize) -> &'a [f64], _: &[f64]) {
        for (start, end) in groups(y.len()) {
            let (found, rest) = y.split_at_mut(start);
            let own = &mut rest[..end - start];
            let above = |j: usize| column(start + j);
            TransposedProduct::run(simd, own, &above, found);
            for j in start..end {
                let column = &column(j)[..=j];
                for i in start..j {
                    own[j - start] -= column[i] * own[i - start];
                }
                own[j - start] /= column[j];
            }
        }
    }
}

/// Where groups of columns begin and end.
#[inline(always)]
fn groups(count: usize) -> impl DoubleEndedIterator<Item = (usize, usize)> {
    let starts = (0..count).step_by(TOGETHER);
    starts.map(move |start| (start, (start + TOGETHER).min(count)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_undo_their_products() {
        for count in [0, 1, 3, 4, 7, 18] {
            let entry = |i: usize, j: usize| {
                (1.3 * i as f64 - 0.7 * j as f64).cos() + 3.0 * f64::from(i == j)
            };
            let columns: Vec<Vec<f64>> = (0..count)
                .map(|j| (0..count).map(|i| entry(i, j)).collect())
                .collect();
            let exact: Vec<f64> = (0..count).map(|i| (0.3 * i as f64).sin() + 0.5).collect();
            let lower = |i: usize, j: usize| if i == j { 1.0 } else { entry(i, j) };
            let mut y: Vec<f64> = (0..count)
                .map(|i| (0..=i).map(|j| lower(i, j) * exact[j]).sum())
                .collect();
            solve_unit_lower(|j| &columns[j], &mut y);
            let mut z: Vec<f64> = (0..count)
                .map(|i| (i..count).map(|j| entry(i, j) * exact[j]).sum())
                .collect();
            solve_upper(|j| &columns[j], &mut z);
            let mut s: Vec<f64> = (0..count)
                .map(|j| (j..count).map(|i| lower(i, j) * exact[i]).sum())
                .collect();
            solve_unit_lower_transposed(|j| &columns[j], &mut s);
            let mut t: Vec<f64> = (0..count)
                .map(|j| (0..=j).map(|i| entry(i, j) * exact[i]).sum())
                .collect();
            solve_upper_transposed(|j| &columns[j], &mut t);
            for (i, exact) in exact.iter().enumerate() {
                // Rounding grows with the inverse of the unit triangle.
                for y in [y[i], s[i]] {
                    assert!((y - exact).abs() < 1e-9, "{count}: {y} {exact}");
                }
                for z in [z[i], t[i]] {
                    assert!((z - exact).abs() < 1e-12, "{count}: {z} {exact}");
                }
            }
        }
    }
}
