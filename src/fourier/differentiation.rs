//! The circulant differentiation matrices `D` and `T`, as dense matrices or by FFT (docs/theory.md,
//! section 2.2).

mod by_fft;

use super::grid::TimeGrid;
use by_fft::ByFft;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::f64::consts::PI;
use std::sync::Arc;

/// First and second derivatives in time of grid functions.
#[derive(Debug, Clone)]
pub struct Differentiation {
    grid: TimeGrid,
    entries: Arc<Entries>,
    way: Way,
}

/// First columns of the matrices: `D_ℓk = first[(ℓ − k) mod N]`, and likewise `T`.
#[derive(Debug)]
struct Entries {
    first: Vec<f64>,
    second: Vec<f64>,
}

/// How they are applied.
#[derive(Debug, Clone)]
enum Way {
    /// By `Dᵀ` and `Tᵀ`, side by side.
    Dense(Arc<Mat<f64>>),
    Fourier(Box<ByFft>),
}

/// Most grid points of dense matrices.
const MOST_DENSE: usize = 160;
/// Dense matrices are faster on fewer points than so many times the sum of their prime factors.
const DENSE: usize = 4;

/// Whether the FFT takes longer than dense matrices, as it goes with the sum of the prime factors
/// of the number of points, and these with that number.
fn is_dense(points: usize) -> bool {
    if points > MOST_DENSE {
        return false;
    }
    let (mut rest, mut sum) = (points, 0);
    let mut factor = 2;
    while rest > 1 {
        match rest.is_multiple_of(factor) {
            true => (rest, sum) = (rest / factor, sum + factor),
            false => factor += 1,
        }
    }
    points <= DENSE * sum.max(1)
}

impl Entries {
    fn new(grid: TimeGrid) -> Self {
        let n = grid.points();
        let omega = grid.frequency();
        let size = n as f64;
        let mut first = vec![0.0; n];
        let is_even = n.is_multiple_of(2);
        let own = if is_even { -2.0 } else { 1.0 };
        let mut second = vec![omega * omega * (own - size * size) / 12.0; n];
        // Of the smaller of two angles that add up to π: its rounding is as small as it is.
        for m in 1..=n / 2 {
            let (sin, cos) = (PI * m as f64 / size).sin_cos();
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            // Of an even number of points by those of an odd one, see `CardinalWeights`.
            let (first_by, second_by) = if is_even { (cos, 1.0) } else { (1.0, cos) };
            let slope = omega * sign * first_by / (2.0 * sin);
            let curvature = -omega * omega * sign * second_by / (2.0 * sin * sin);
            (first[n - m], first[m]) = (-slope, slope);
            (second[n - m], second[m]) = (curvature, curvature);
        }
        Entries { first, second }
    }

    fn dense(&self) -> Mat<f64> {
        let n = self.first.len();
        Mat::from_fn(n, 2 * n, |k, l| match l < n {
            true => self.first[shift(n, l, k)],
            false => self.second[shift(n, l - n, k)],
        })
    }
}

#[inline]
fn shift(points: usize, row: usize, column: usize) -> usize {
    match row >= column {
        true => row - column,
        false => row + points - column,
    }
}

impl Differentiation {
    /// Operators for `grid`.
    pub fn new(grid: TimeGrid) -> Self {
        let entries = Entries::new(grid);
        let way = match is_dense(grid.points()) {
            true => Way::Dense(Arc::new(entries.dense())),
            false => Way::Fourier(Box::new(ByFft::new(grid))),
        };
        let entries = Arc::new(entries);
        Differentiation { grid, entries, way }
    }

    /// The grid.
    pub fn grid(&self) -> TimeGrid {
        self.grid
    }

    /// Entry `D_ℓk`.
    #[inline]
    pub fn first(&self, row: usize, column: usize) -> f64 {
        self.entries.first[shift(self.grid.points(), row, column)]
    }

    /// Entry `T_ℓk`.
    #[inline]
    pub fn second(&self, row: usize, column: usize) -> f64 {
        self.entries.second[shift(self.grid.points(), row, column)]
    }

    /// Writes `D x` and `T x`; all three slices have one entry for each grid point.
    pub fn apply(&mut self, x: &[f64], d_x: &mut [f64], t_x: &mut [f64]) {
        match &mut self.way {
            Way::Dense(matrix) => {
                let n = self.grid.points();
                for (out, first) in [(d_x, 0), (t_x, n)] {
                    multiply(
                        [1, n],
                        x,
                        matrix.subcols(first, n),
                        (1.0, Accum::Replace),
                        out,
                    );
                }
            }
            Way::Fourier(by_fft) => by_fft.apply([1, 1], x, [d_x, t_x]),
        }
    }

    /// Writes `D X` and then `T X` of grid functions in `groups` of `count`, whose values are
    /// together at each grid point, one point after the other. Those of a group should be of one
    /// size, as they share rounding.
    pub fn apply_to_many(
        &mut self,
        [groups, count]: [usize; 2],
        x: &[f64],
        derivatives: &mut [f64],
    ) {
        let n = self.grid.points();
        let all = groups * count;
        match &mut self.way {
            Way::Dense(matrix) => {
                let once = (1.0, Accum::Replace);
                multiply([all, n], x, Mat::as_ref(matrix), once, derivatives);
            }
            Way::Fourier(by_fft) => {
                let (first, second) = derivatives.split_at_mut(all * n);
                by_fft.apply([groups, count], x, [first, second]);
            }
        }
    }

    /// Writes `Dᵀ X + Tᵀ Y = T Y − D X` of such functions.
    pub fn apply_transposed(
        &mut self,
        [groups, count]: [usize; 2],
        [x, y]: [&[f64]; 2],
        sum: &mut [f64],
    ) {
        let (n, all) = (self.grid.points(), groups * count);
        match &mut self.way {
            Way::Dense(matrix) => {
                let (first, second) = matrix.split_at_col(n);
                multiply([all, n], y, second, (1.0, Accum::Replace), sum);
                multiply([all, n], x, first, (-1.0, Accum::Add), sum);
            }
            Way::Fourier(by_fft) => by_fft.apply_transposed([groups, count], [x, y], sum),
        }
    }
}

/// Multiplies functions, point by point, by a matrix for each of their `points` from the right.
fn multiply(
    [functions, points]: [usize; 2],
    x: &[f64],
    matrix: MatRef<'_, f64>,
    (factor, accum): (f64, Accum),
    out: &mut [f64],
) {
    let columns = matrix.ncols();
    let x = MatRef::from_column_major_slice(x, functions, points);
    let out = MatMut::from_column_major_slice_mut(out, functions, columns);
    matmul(out, accum, x, matrix, factor, Par::Seq);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn both_ways(grid: TimeGrid) -> [Differentiation; 2] {
        let entries = Arc::new(Entries::new(grid));
        let dense = Way::Dense(Arc::new(entries.dense()));
        [dense, Way::Fourier(Box::new(ByFft::new(grid)))].map(|way| Differentiation {
            grid,
            entries: entries.clone(),
            way,
        })
    }

    #[test]
    fn derivatives_of_resolved_harmonics_are_exact_densely_and_by_fft() {
        for points in [3, 4, 9, 12, 21, 65, 200, 201] {
            let grid = TimeGrid::even_or_odd(points, 1.7).unwrap();
            let [mut dense, mut by_fft] = both_ways(grid);
            let omega = grid.frequency();
            for j in [0, 1, (points - 1) / 2] {
                let rate = j as f64 * omega;
                let x: Vec<f64> = grid.times().map(|t| (rate * t + 0.4).sin()).collect();
                let mut buffers = [(); 4].map(|()| vec![0.0; points]);
                let [d, t, d_fft, t_fft] = &mut buffers;
                dense.apply(&x, d, t);
                by_fft.apply(&x, d_fft, t_fft);
                let largest = grid.harmonics().max(1) as f64 * omega;
                for (k, time) in grid.times().enumerate() {
                    let (sin, cos) = (rate * time + 0.4).sin_cos();
                    let tolerance = 1e-14 * points as f64;
                    assert!((d[k] - rate * cos).abs() < tolerance * largest);
                    assert!((t[k] + rate * rate * sin).abs() < tolerance * largest * largest);
                    assert!((d_fft[k] - rate * cos).abs() < tolerance * largest);
                    assert!((t_fft[k] + rate * rate * sin).abs() < tolerance * largest * largest);
                }
            }
        }
    }

    #[test]
    fn many_functions_have_the_derivatives_of_each_and_zeros_those_of_zeros() {
        for (points, groups, count) in [
            (3, 1, 3),
            (7, 1, 4),
            (8, 2, 4),
            (9, 1, 4),
            (20, 2, 3),
            (21, 3, 5),
            (21, 1, 1),
        ] {
            let grid = TimeGrid::even_or_odd(points, 1.7).unwrap();
            let all = groups * count;
            let wave = |i: usize| match i % all {
                1 => 0.0,
                _ => (0.37 * i as f64).sin() + (0.05 * (i * i) as f64).cos(),
            };
            let x: Vec<f64> = (0..all * points).map(wave).collect();
            let y: Vec<f64> = (0..all * points)
                .map(|i| wave(i) * 0.3 - wave(i / 2))
                .collect();
            let harmonic = grid.harmonics() as f64 * grid.frequency();
            // As that of the derivatives above.
            let tolerance = 1e-14 * points as f64 * harmonic;
            for mut operators in both_ways(grid) {
                let mut together = vec![f64::NAN; 2 * all * points];
                operators.apply_to_many([groups, count], &x, &mut together);
                let mut transposed = vec![f64::NAN; all * points];
                operators.apply_transposed([groups, count], [&x, &y], &mut transposed);
                for i in 0..all * points {
                    let (row, function) = (i / all, i % all);
                    let sum = |of: &[f64], entry: &dyn Fn(usize) -> f64| -> f64 {
                        (0..points).map(|k| entry(k) * of[k * all + function]).sum()
                    };
                    let first = sum(&x, &|k| operators.first(row, k));
                    let second = sum(&x, &|k| operators.second(row, k));
                    let sums = sum(&x, &|k| operators.first(k, row))
                        + sum(&y, &|k| operators.second(k, row));
                    let errors = [
                        together[i] - first,
                        (together[all * points + i] - second) / harmonic,
                        (transposed[i] - sums) / harmonic,
                    ];
                    for error in errors {
                        assert!(error.abs() < tolerance, "{points} {i} {error:e}");
                    }
                    assert!(function != 1 || together[i] == 0.0);
                }
            }
        }
    }

    #[test]
    fn dense_products_are_as_accurate_as_transforms() {
        for points in [31, 61, 127, 128] {
            let grid = TimeGrid::even_or_odd(points, TAU).unwrap();
            let worst = both_ways(grid).map(|mut operators| {
                let mut worst = [0.0f64; 2];
                for phase in 0..50 {
                    let phase = 0.13 * f64::from(phase);
                    let x: Vec<f64> = grid.times().map(|t| (t + phase).sin()).collect();
                    let (mut d, mut t) = (vec![0.0; points], vec![0.0; points]);
                    operators.apply(&x, &mut d, &mut t);
                    for (k, time) in grid.times().enumerate() {
                        let errors = [d[k] - (time + phase).cos(), t[k] + x[k]];
                        for (worst, error) in worst.iter_mut().zip(errors) {
                            *worst = worst.max(error.abs());
                        }
                    }
                }
                worst
            });
            let [dense, by_fft] = worst;
            println!("{points}: {dense:?} {by_fft:?}");
            assert!((0..2).all(|i| dense[i] < 2.0 * by_fft[i]), "{points}");
        }
    }

    #[test]
    fn few_points_and_large_primes_are_dense() {
        let dense = |points: &usize| is_dense(*points);
        assert!([1, 3, 9, 21, 31, 41, 61, 127].iter().all(dense));
        assert!(![45, 64, 81, 135, 225, 251, 1023].iter().any(dense));
    }

    #[test]
    fn second_derivative_is_the_first_applied_twice() {
        let operators = Differentiation::new(TimeGrid::new(9, 3.0).unwrap());
        for row in 0..9 {
            for column in 0..9 {
                let product: f64 = (0..9)
                    .map(|m| operators.first(row, m) * operators.first(m, column))
                    .sum();
                assert!((product - operators.second(row, column)).abs() < 1e-12);
            }
        }
    }
}
