//! The circulant differentiation matrices `D` and `T`, applied densely or by FFT (docs/theory.md,
//! section 2.2).

use super::grid::TimeGrid;
use super::transform::{Analysis, Complex, Synthesis};
use std::f64::consts::PI;

/// Above this many grid points the FFT is used: where it was measured to overtake the dense
/// product.
const DENSE_LIMIT: usize = 8;

/// First and second derivatives in time of grid functions.
#[derive(Debug, Clone)]
pub struct Differentiation {
    grid: TimeGrid,
    /// First column of `D`: `D_ℓk = first[(ℓ − k) mod N]`.
    first: Vec<f64>,
    /// First column of `T`.
    second: Vec<f64>,
    /// A grid function and its derivatives.
    series: [Vec<f64>; 3],
    analysis: Analysis,
    synthesis: Synthesis,
}

impl Differentiation {
    /// Operators for `grid`.
    pub fn new(grid: TimeGrid) -> Self {
        let n = grid.points();
        let omega = grid.frequency();
        let size = n as f64;
        let mut first = vec![0.0; n];
        let mut second = vec![omega * omega * (1.0 - size * size) / 12.0; n];
        for m in 1..n {
            let (sin, cos) = (PI * m as f64 / size).sin_cos();
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            first[m] = omega * sign / (2.0 * sin);
            second[m] = -omega * omega * sign * cos / (2.0 * sin * sin);
        }
        Differentiation {
            grid,
            series: Default::default(),
            first,
            second,
            analysis: Analysis::new(n),
            synthesis: Synthesis::new(n),
        }
    }

    /// The grid.
    pub fn grid(&self) -> TimeGrid {
        self.grid
    }

    /// Entry `D_ℓk`.
    #[inline]
    pub fn first(&self, row: usize, column: usize) -> f64 {
        self.first[self.shift(row, column)]
    }

    /// Entry `T_ℓk`.
    #[inline]
    pub fn second(&self, row: usize, column: usize) -> f64 {
        self.second[self.shift(row, column)]
    }

    #[inline]
    fn shift(&self, row: usize, column: usize) -> usize {
        if row >= column {
            row - column
        } else {
            row + self.grid.points() - column
        }
    }

    /// Writes `D x` and `T x`; all three slices have one entry for each grid point.
    pub fn apply(&mut self, x: &[f64], d_x: &mut [f64], t_x: &mut [f64]) {
        if self.grid.points() <= DENSE_LIMIT {
            self.apply_dense(x, d_x, t_x);
        } else {
            self.apply_fft(x, d_x, t_x);
        }
    }

    /// Writes `D X` and then `T X` of grid functions that have `count` values together at each grid
    /// point, one point after the other.
    pub fn apply_to_many(&mut self, count: usize, x: &[f64], derivatives: &mut [f64]) {
        let n = self.grid.points();
        let mut series = std::mem::take(&mut self.series);
        series.iter_mut().for_each(|values| values.resize(n, 0.0));
        let [values, d_x, t_x] = &mut series;
        let (first, second) = derivatives.split_at_mut(count * n);
        for function in 0..count {
            let samples = x[function..].iter().step_by(count);
            values.iter_mut().zip(samples).for_each(|(to, x)| *to = *x);
            self.apply(values, d_x, t_x);
            for (out, values) in [(&mut *first, &*d_x), (&mut *second, &*t_x)] {
                let out = out[function..].iter_mut().step_by(count);
                out.zip(values).for_each(|(to, x)| *to = *x);
            }
        }
        self.series = series;
    }

    fn apply_dense(&self, x: &[f64], d_x: &mut [f64], t_x: &mut [f64]) {
        d_x.fill(0.0);
        t_x.fill(0.0);
        // Columns are the first one, moved round.
        for (column, value) in x.iter().enumerate() {
            let wrapped = x.len() - column;
            for (out, first) in [(&mut *d_x, &self.first), (&mut *t_x, &self.second)] {
                let (above, below) = out.split_at_mut(column);
                for (y, entry) in below.iter_mut().zip(first) {
                    *y += entry * value;
                }
                for (y, entry) in above.iter_mut().zip(&first[wrapped..]) {
                    *y += entry * value;
                }
            }
        }
    }

    fn apply_fft(&mut self, x: &[f64], d_x: &mut [f64], t_x: &mut [f64]) {
        self.analysis.read(x.iter().copied());
        let omega = self.grid.frequency();
        let scale = 1.0 / x.len() as f64;
        for (order, out) in [(1, d_x), (2, t_x)] {
            for (j, (target, source)) in self
                .synthesis
                .spectrum
                .iter_mut()
                .zip(&self.analysis.spectrum)
                .enumerate()
            {
                let rate = j as f64 * omega;
                *target = match order {
                    1 => Complex::new(-source.im, source.re) * (rate * scale),
                    _ => -source * (rate * rate * scale),
                };
            }
            self.synthesis.write(out);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_resolved_harmonics_are_exact_densely_and_by_fft() {
        for points in [3, 9, 21, 65, 201] {
            let grid = TimeGrid::new(points, 1.7).unwrap();
            let mut operators = Differentiation::new(grid);
            let omega = grid.frequency();
            for j in [0, 1, grid.harmonics()] {
                let rate = j as f64 * omega;
                let x: Vec<f64> = grid.times().map(|t| (rate * t + 0.4).sin()).collect();
                let mut buffers = [(); 4].map(|()| vec![0.0; points]);
                let [d, t, d_fft, t_fft] = &mut buffers;
                operators.apply_dense(&x, d, t);
                operators.apply_fft(&x, d_fft, t_fft);
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
    fn many_functions_have_the_derivatives_of_each() {
        let count = 3;
        for points in [3, 7, 9, 21] {
            let grid = TimeGrid::new(points, 1.7).unwrap();
            let mut operators = Differentiation::new(grid);
            let wave = |i: usize| (0.37 * i as f64).sin() + (0.05 * (i * i) as f64).cos();
            let x: Vec<f64> = (0..count * points).map(wave).collect();
            let mut together = vec![0.0; 2 * count * points];
            operators.apply_to_many(count, &x, &mut together);
            let mut derivatives = [(); 2].map(|()| vec![0.0; points]);
            let [d, t] = &mut derivatives;
            let harmonic = grid.harmonics() as f64 * grid.frequency();
            // As that of the derivatives above.
            let tolerance = 1e-14 * points as f64 * harmonic;
            for function in 0..count {
                let of_one = |all: &[f64]| -> Vec<f64> {
                    all[function..].iter().copied().step_by(count).collect()
                };
                operators.apply_dense(&of_one(&x), d, t);
                let (first, second) = together.split_at(count * points);
                for k in 0..points {
                    assert!((of_one(first)[k] - d[k]).abs() < tolerance);
                    assert!((of_one(second)[k] - t[k]).abs() < tolerance * harmonic);
                }
            }
        }
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
