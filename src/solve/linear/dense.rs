//! Products and triangular solves with one vector: bound by memory, so four columns are read at a
//! time.

use nalgebra::{DMatrix, Dyn, SVD};

/// Columns that are taken together.
const TOGETHER: usize = 4;

/// Size of the largest entry; NaN counts for nothing.
pub(crate) fn largest(values: &[f64]) -> f64 {
    // Several at a time, for the compiler to see that their order does not matter.
    let mut lanes = [0.0f64; 8];
    let chunks = values.chunks_exact(lanes.len());
    let mut most = 0.0;
    for x in chunks.remainder() {
        most = f64::max(most, x.abs());
    }
    for chunk in chunks {
        for (lane, x) in lanes.iter_mut().zip(chunk) {
            let size = x.abs();
            *lane = if size > *lane { size } else { *lane };
        }
    }
    lanes.into_iter().fold(most, f64::max)
}

/// The singular value decomposition of what consists of numbers: of others it does not end. They
/// may be as large as numbers go, and squares of them need not be numbers.
pub(crate) fn decomposed(mut matrix: DMatrix<f64>) -> Option<SVD<f64, Dyn, Dyn>> {
    if !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    // A power of two, which rounds nothing.
    let size = largest(matrix.as_slice());
    let unit = match size > 0.0 {
        true => size.log2().floor().exp2(),
        false => 1.0,
    };
    matrix.apply(|x| *x /= unit);
    let mut found = matrix.svd(true, true);
    found.singular_values *= unit;
    Some(found)
}

/// A vector without structure, which has a part along any null space.
pub(crate) fn probe(size: usize) -> Vec<f64> {
    (0..size)
        .map(|i| 0.5 + (i as f64 * 0.618_033_988_75).fract())
        .collect()
}

/// `y −= A x`, for the matrix with these columns.
pub(crate) fn subtract_product<'a>(y: &mut [f64], column: impl Fn(usize) -> &'a [f64], x: &[f64]) {
    let rows = y.len();
    let mut groups = x.chunks_exact(TOGETHER);
    let mut first = 0;
    for group in &mut groups {
        let [a, b, c, d] = [0, 1, 2, 3].map(|j| &column(first + j)[..rows]);
        for (i, y) in y.iter_mut().enumerate() {
            *y -= (a[i] * group[0] + b[i] * group[1]) + (c[i] * group[2] + d[i] * group[3]);
        }
        first += TOGETHER;
    }
    for (j, x) in groups.remainder().iter().enumerate() {
        for (y, a) in y.iter_mut().zip(column(first + j)) {
            *y -= a * x;
        }
    }
}

/// `y ← L⁻¹ y`, for the unit lower triangle below the diagonal of the matrix with these columns.
pub(crate) fn solve_unit_lower<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    let count = y.len();
    for start in (0..count).step_by(TOGETHER) {
        let end = (start + TOGETHER).min(count);
        for j in start..end {
            for i in j + 1..end {
                y[i] -= column(j)[i] * y[j];
            }
        }
        let (found, rest) = y.split_at_mut(end);
        subtract_product(rest, |j| &column(start + j)[end..count], &found[start..]);
    }
}

/// `y ← U⁻¹ y`, for the upper triangle of the matrix with these columns.
pub(crate) fn solve_upper<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    let mut end = y.len();
    while end > 0 {
        let start = end.saturating_sub(TOGETHER);
        // Divided beforehand, as no quotient has to wait for another.
        let mut inverses = [0.0; TOGETHER];
        for (inverse, j) in inverses.iter_mut().zip(start..end) {
            *inverse = 1.0 / column(j)[j];
        }
        for j in (start..end).rev() {
            y[j] *= inverses[j - start];
            for i in start..j {
                y[i] -= column(j)[i] * y[j];
            }
        }
        let (rest, found) = y.split_at_mut(start);
        subtract_product(rest, |j| &column(start + j)[..start], &found[..end - start]);
        end = start;
    }
}

/// `y −= Aᵀ x`, for the matrix with these columns, one for each entry of `y`.
pub(crate) fn subtract_transposed<'a>(
    y: &mut [f64],
    column: impl Fn(usize) -> &'a [f64],
    x: &[f64],
) {
    for (j, y) in y.iter_mut().enumerate() {
        *y -= dot(&column(j)[..x.len()], x);
    }
}

/// `y ← L⁻ᵀ y`, for the unit lower triangle below the diagonal of the matrix with these columns.
pub(crate) fn solve_unit_lower_transposed<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    let count = y.len();
    for j in (0..count).rev() {
        let (head, found) = y.split_at_mut(j + 1);
        head[j] -= dot(&column(j)[j + 1..count], found);
    }
}

/// `y ← U⁻ᵀ y`, for the upper triangle of the matrix with these columns.
pub(crate) fn solve_upper_transposed<'a>(column: impl Fn(usize) -> &'a [f64], y: &mut [f64]) {
    for j in 0..y.len() {
        let (found, rest) = y.split_at_mut(j);
        let column = column(j);
        rest[0] = (rest[0] - dot(&column[..j], found)) / column[j];
    }
}

/// `Σ a b`, four terms at a time.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (left, right) = (a.chunks_exact(TOGETHER), b.chunks_exact(TOGETHER));
    let rest = left.remainder().iter().zip(right.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    let mut lanes = [0.0f64; TOGETHER];
    for (a, b) in left.zip(right) {
        for (lane, (a, b)) in lanes.iter_mut().zip(a.iter().zip(b)) {
            *lane += a * b;
        }
    }
    lanes.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_numbers_are_decomposed() {
        let numbers = DMatrix::from_fn(4, 4, |i, j| (0.37 * (3 * i + 7 * j) as f64).sin());
        for (value, serves) in [(f64::NAN, false), (f64::INFINITY, false), (1e300, true)] {
            let mut matrix = numbers.clone();
            matrix[(0, 1)] = value;
            assert_eq!(decomposed(matrix).is_some(), serves, "{value}");
        }
    }

    #[test]
    fn decompositions_of_large_and_small_numbers_are_those_of_others() {
        let numbers = DMatrix::from_fn(4, 4, |i, j| (0.37 * (3 * i * j + 7 * j) as f64).sin());
        let of = |unit: f64| decomposed(&numbers * unit).unwrap().singular_values / unit;
        for unit in [1.0, 1e300, 1e-290] {
            // Rounding of a few sums.
            assert!((of(unit) - of(2.0)).amax() < 1e-14, "{unit}");
        }
        let none = decomposed(DMatrix::zeros(3, 3)).unwrap();
        assert_eq!(none.singular_values.amax(), 0.0);
    }

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
            assert_eq!(
                largest(&exact),
                exact.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
            );
        }
    }
}
