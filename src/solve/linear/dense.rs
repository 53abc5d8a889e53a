//! What dense vectors and matrices are asked for here and there.

use nalgebra::{DMatrix, Dyn, SVD};

/// Terms of a sum that are taken together.
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
    fn the_largest_entry_is_found_at_any_place() {
        for count in [0, 1, 3, 4, 7, 18] {
            let values: Vec<f64> = (0..count).map(|i| (0.3 * i as f64).sin() + 0.5).collect();
            assert_eq!(
                largest(&values),
                values.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
            );
        }
    }
}
