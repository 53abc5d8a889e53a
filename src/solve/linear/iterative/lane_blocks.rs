//! Products and inverses of small dense blocks of several matrices side by side.

use super::lanes::{LANES, Lanes};
use nalgebra::ComplexField;

/// A pivot smaller than this, relative to its block, is none.
const SINGULAR: f64 = 1e-14;

/// A part that is read and another one that is written, each `(first, length)`.
pub(super) fn two<T>(
    values: &mut [T],
    (read, read_length): (usize, usize),
    (write, write_length): (usize, usize),
) -> (&[T], &mut [T]) {
    if read < write {
        let (low, high) = values.split_at_mut(write);
        (&low[read..read + read_length], &mut high[..write_length])
    } else {
        let (low, high) = values.split_at_mut(read);
        (&high[..read_length], &mut low[write..write + write_length])
    }
}

/// `c += a b`, or `c −= a b`, for row-major blocks of `m × k` and `k × n`.
#[inline(always)]
pub(super) fn add_block_product<T: Lanes, const MINUS: bool>(
    c: &mut [T],
    a: &[T],
    b: &[T],
    (m, k, n): (usize, usize, usize),
) {
    for i in 0..m {
        let row = &a[i * k..][..k];
        for j in 0..n {
            let mut sum = c[i * n + j];
            for (l, a) in row.iter().enumerate() {
                let b = &b[l * n + j];
                if MINUS {
                    sum.subtract_product(a, b);
                } else {
                    sum.add_product(a, b);
                }
            }
            c[i * n + j] = sum;
        }
    }
}

/// Inverts the `size × size` blocks of all lanes, by Gauss and Jordan with pivots sought in
/// columns; `false` if one is singular.
pub(super) fn invert<T: Lanes>(block: &mut [T], size: usize) -> bool {
    let mut a = vec![T::Number::default(); size * size];
    let mut pivots = vec![0; size];
    for lane in 0..LANES {
        let mut largest = 0.0f64;
        for (number, entry) in a.iter_mut().zip(&*block) {
            *number = entry.get(lane);
            largest = largest.max(number.modulus());
        }
        for column in 0..size {
            let (mut pivot, mut found) = (column, 0.0);
            for row in column..size {
                let candidate = a[row * size + column].modulus();
                if candidate > found {
                    (pivot, found) = (row, candidate);
                }
            }
            // Written so that NaN fails too.
            let regular = found > SINGULAR * largest && found.is_finite();
            if !regular {
                return false;
            }
            pivots[column] = pivot;
            for j in 0..size {
                a.swap(pivot * size + j, column * size + j);
            }
            let inverse = T::Number::from_real(1.0) / a[column * size + column];
            a[column * size + column] = T::Number::from_real(1.0);
            for j in 0..size {
                a[column * size + j] *= inverse;
            }
            for row in 0..size {
                if row == column {
                    continue;
                }
                let factor = a[row * size + column];
                a[row * size + column] = T::Number::default();
                for j in 0..size {
                    let product = factor * a[column * size + j];
                    a[row * size + j] -= product;
                }
            }
        }
        for column in (0..size).rev() {
            if pivots[column] != column {
                for i in 0..size {
                    a.swap(i * size + column, i * size + pivots[column]);
                }
            }
        }
        for (number, entry) in a.iter().zip(&mut *block) {
            entry.set(lane, *number);
        }
    }
    true
}
