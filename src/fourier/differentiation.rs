//! The circulant differentiation matrices `D` and `T`, applied densely or by FFT (docs/theory.md,
//! section 2.2).

use super::grid::TimeGrid;
use super::transform::{Complex, Plan};
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
    forward: Plan,
    backward: Plan,
    /// `jΩ / N` and `−(jΩ)² / N` of harmonics 0, 1, and so on up to −1.
    factors: Vec<[f64; 2]>,
    /// Functions that are not zero everywhere.
    active: Vec<usize>,
    /// Pairs of functions as complex ones, and derivatives of these.
    pairs: [Vec<Complex<f64>>; 2],
}

impl Differentiation {
    /// Operators for `grid`.
    pub fn new(grid: TimeGrid) -> Self {
        let n = grid.points();
        let omega = grid.frequency();
        let size = n as f64;
        let mut first = vec![0.0; n];
        let is_even = n.is_multiple_of(2);
        let own = if is_even { -2.0 } else { 1.0 };
        let mut second = vec![omega * omega * (own - size * size) / 12.0; n];
        for m in 1..n {
            let (sin, cos) = (PI * m as f64 / size).sin_cos();
            let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
            // Of an even number of points by those of an odd one, see `CardinalWeights`.
            let (first_by, second_by) = if is_even { (cos, 1.0) } else { (1.0, cos) };
            first[m] = omega * sign * first_by / (2.0 * sin);
            second[m] = -omega * omega * sign * second_by / (2.0 * sin * sin);
        }
        let rate = |m: usize| match m <= grid.harmonics() {
            true => m as f64 * omega,
            false => -((n - m) as f64) * omega,
        };
        // What has a cosine alone has no slope at the points.
        let has_slope = |m: usize| f64::from(2 * m != n);
        let factors = (0..n).map(|m| [has_slope(m) * rate(m) / size, -rate(m) * rate(m) / size]);
        Differentiation {
            grid,
            first,
            second,
            forward: Plan::forward(n),
            backward: Plan::backward(n),
            factors: factors.collect(),
            active: Vec::new(),
            pairs: Default::default(),
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
        self.differentiate(1, x, [d_x, t_x]);
    }

    /// Writes `D X` and then `T X` of grid functions that have `count` values together at each grid
    /// point, one point after the other. They should be of one size, as they share rounding.
    pub fn apply_to_many(&mut self, count: usize, x: &[f64], derivatives: &mut [f64]) {
        let (first, second) = derivatives.split_at_mut(count * self.grid.points());
        self.differentiate(count, x, [first, second]);
    }

    fn differentiate(&mut self, count: usize, x: &[f64], out: [&mut [f64]; 2]) {
        if self.grid.points() <= DENSE_LIMIT {
            self.apply_dense(count, x, out);
        } else {
            self.apply_fft(count, x, out);
        }
    }

    fn apply_dense(&self, count: usize, x: &[f64], out: [&mut [f64]; 2]) {
        for (out, column) in out.into_iter().zip([&self.first, &self.second]) {
            for (row, out) in out.chunks_exact_mut(count).enumerate() {
                out.fill(0.0);
                for (k, x) in x.chunks_exact(count).enumerate() {
                    let entry = column[self.shift(row, k)];
                    out.iter_mut().zip(x).for_each(|(y, x)| *y += entry * x);
                }
            }
        }
    }

    /// Two real functions at a time, as real and imaginary part of a complex one: `D` and `T` are
    /// real. What is zero everywhere stays so.
    fn apply_fft(&mut self, count: usize, x: &[f64], out: [&mut [f64]; 2]) {
        let n = self.grid.points();
        let is_active = |function: &usize| {
            let mut values = x[*function..].iter().step_by(count);
            values.any(|x| *x != 0.0)
        };
        self.active.clear();
        self.active.extend((0..count).filter(is_active));
        let length = n * self.active.len().div_ceil(2);
        let [values, products] = &mut self.pairs;
        values.resize(length, Complex::default());
        products.resize(length, Complex::default());
        let columns = values.chunks_exact_mut(n);
        for (pair, column) in self.active.chunks(2).zip(columns) {
            let points = column.iter_mut().zip(x.chunks_exact(count));
            match *pair {
                [a, b] => points.for_each(|(z, x)| *z = Complex::new(x[a], x[b])),
                _ => points.for_each(|(z, x)| *z = Complex::new(x[pair[0]], 0.0)),
            }
        }
        self.forward.transform(values);
        let columns = products.chunks_exact_mut(n).zip(values.chunks_exact_mut(n));
        for (firsts, seconds) in columns {
            let harmonics = firsts.iter_mut().zip(seconds).zip(&self.factors);
            for ((first, second), factors) in harmonics {
                *first = Complex::new(-second.im, second.re) * factors[0];
                *second *= factors[1];
            }
        }
        for (out, values) in out.into_iter().zip([products, values]) {
            self.backward.transform(values);
            if self.active.len() < count {
                out.fill(0.0);
            }
            for (pair, column) in self.active.chunks(2).zip(values.chunks_exact(n)) {
                let points = out.chunks_exact_mut(count).zip(column);
                match *pair {
                    [a, b] => points.for_each(|(y, z)| (y[a], y[b]) = (z.re, z.im)),
                    _ => points.for_each(|(y, z)| y[pair[0]] = z.re),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_resolved_harmonics_are_exact_densely_and_by_fft() {
        for points in [3, 4, 9, 12, 21, 65, 200, 201] {
            let grid = TimeGrid::even_or_odd(points, 1.7).unwrap();
            let mut operators = Differentiation::new(grid);
            let omega = grid.frequency();
            for j in [0, 1, (points - 1) / 2] {
                let rate = j as f64 * omega;
                let x: Vec<f64> = grid.times().map(|t| (rate * t + 0.4).sin()).collect();
                let mut buffers = [(); 4].map(|()| vec![0.0; points]);
                let [d, t, d_fft, t_fft] = &mut buffers;
                operators.apply_dense(1, &x, [d, t]);
                operators.apply_fft(1, &x, [d_fft, t_fft]);
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
        for (points, count) in [(3, 3), (7, 4), (8, 4), (9, 4), (20, 3), (21, 5), (21, 1)] {
            let grid = TimeGrid::even_or_odd(points, 1.7).unwrap();
            let mut operators = Differentiation::new(grid);
            let wave = |i: usize| match i % count {
                1 => 0.0,
                _ => (0.37 * i as f64).sin() + (0.05 * (i * i) as f64).cos(),
            };
            let x: Vec<f64> = (0..count * points).map(wave).collect();
            let mut together = vec![f64::NAN; 2 * count * points];
            operators.apply_to_many(count, &x, &mut together);
            let harmonic = grid.harmonics() as f64 * grid.frequency();
            // As that of the derivatives above.
            let tolerance = 1e-14 * points as f64 * harmonic;
            let entries = [Differentiation::first, Differentiation::second];
            for (order, entry) in entries.into_iter().enumerate() {
                for (i, found) in together[order * count * points..][..count * points]
                    .iter()
                    .enumerate()
                {
                    let (row, function) = (i / count, i % count);
                    let terms =
                        (0..points).map(|k| (entry(&operators, row, k), x[k * count + function]));
                    let exact: f64 = terms.map(|(entry, x)| entry * x).sum();
                    let error = (found - exact).abs();
                    assert!(
                        error < tolerance * harmonic.powi(order as i32),
                        "{points} {i}"
                    );
                    assert!(function != 1 || *found == 0.0);
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
