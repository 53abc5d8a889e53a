//! Products and inverses of small dense blocks of several matrices side by side.

use super::lanes::{LANES, Lanes};

/// A pivot smaller than this, relative to its block, is none.
const SINGULAR: f64 = 1e-14;

/// A part that is read and another one that is written, each `(first, length)`.
#[inline(always)]
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

/// Inverts the `size × size` blocks of all lanes, by Gauss and Jordan with pivots sought in the
/// columns of each lane; `false` if one is singular.
#[inline(always)]
pub(super) fn invert<T: Lanes>(
    block: &mut [T],
    size: usize,
    exchanged: &mut Vec<[usize; LANES]>,
) -> bool {
    let mut largest = [0.0f64; LANES];
    for entry in &*block {
        let sizes = largest.iter_mut().zip(entry.squares());
        sizes.for_each(|(largest, size)| *largest = largest.max(size));
    }
    exchanged.clear();
    for column in 0..size {
        let Some(pivots) = pivots(block, (column, size), &largest) else {
            return false;
        };
        exchanged.push(pivots);
        for (lane, &pivot) in pivots.iter().enumerate() {
            let rows = (0..size).map(|j| (pivot * size + j, column * size + j));
            exchange(block, lane, rows.filter(|_| pivot != column));
        }
        let inverse = block[column * size + column].reciprocal();
        block[column * size + column] = T::one();
        for entry in &mut block[column * size..][..size] {
            let mut scaled = T::zero();
            scaled.add_product(entry, &inverse);
            *entry = scaled;
        }
        for row in (0..size).filter(|row| *row != column) {
            let (pivot, others) = two(block, (column * size, size), (row * size, size));
            let factor = std::mem::replace(&mut others[column], T::zero());
            for (entry, pivot) in others.iter_mut().zip(pivot) {
                entry.subtract_product(&factor, pivot);
            }
        }
    }
    for (column, pivots) in exchanged.iter().enumerate().rev() {
        for (lane, &pivot) in pivots.iter().enumerate() {
            let columns = (0..size).map(|i| (i * size + column, i * size + pivot));
            exchange(block, lane, columns.filter(|_| pivot != column));
        }
    }
    true
}

/// The row of the largest entry of a column, from its diagonal on, in each lane; none if that is
/// tiny beside the squared size of a lane's block.
#[inline(always)]
fn pivots<T: Lanes>(
    block: &[T],
    (column, size): (usize, usize),
    largest: &[f64; LANES],
) -> Option<[usize; LANES]> {
    let (mut pivots, mut found) = ([column; LANES], [0.0; LANES]);
    for row in column..size {
        let candidates = block[row * size + column].squares();
        for lane in 0..LANES {
            if candidates[lane] > found[lane] {
                (pivots[lane], found[lane]) = (row, candidates[lane]);
            }
        }
    }
    // Written so that NaN fails too.
    let regular = |(found, largest): (&f64, &f64)| {
        *found > SINGULAR * SINGULAR * largest && found.is_finite()
    };
    found.iter().zip(largest).all(regular).then_some(pivots)
}

/// Exchanges entries of one lane.
#[inline(always)]
fn exchange<T: Lanes>(block: &mut [T], lane: usize, places: impl Iterator<Item = (usize, usize)>) {
    for (a, b) in places {
        let (first, second) = (block[a].get(lane), block[b].get(lane));
        block[a].set(lane, second);
        block[b].set(lane, first);
    }
}
