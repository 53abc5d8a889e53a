//! Linear fields over the period: secular growth plus harmonics.

use super::filter::SpectralFilter;
use super::grid::TimeGrid;
use super::transform::Analysis;
use std::f64::consts::TAU;

/// A scalar function `rate·t + mean + Σ_j (c_j cos jΩt + s_j sin jΩt)`.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicSeries {
    period: f64,
    /// Mean of the periodic part.
    pub mean: f64,
    /// Growth per unit of time.
    pub rate: f64,
    /// Cosine coefficients of harmonics 1, 2, ….
    pub cosines: Vec<f64>,
    /// Sine coefficients of harmonics 1, 2, ….
    pub sines: Vec<f64>,
}

impl PeriodicSeries {
    /// A series with the given coefficients; `cosines` and `sines` have the same length.
    pub fn new(period: f64, mean: f64, rate: f64, cosines: Vec<f64>, sines: Vec<f64>) -> Self {
        debug_assert_eq!(cosines.len(), sines.len());
        PeriodicSeries {
            period,
            mean,
            rate,
            cosines,
            sines,
        }
    }

    /// Interpolates values at the points of `grid`, after taking the secular part `rate·t` out.
    pub fn interpolate(grid: TimeGrid, values: &[f64], rate: f64) -> Self {
        let periodic: Vec<f64> = values
            .iter()
            .zip(grid.times())
            .map(|(x, t)| x - rate * t)
            .collect();
        Self::from_samples(grid.period(), &periodic, rate)
    }

    /// Interpolates any number of equispaced samples of the periodic part over one period.
    ///
    /// For an even number of samples the highest harmonic is a cosine.
    pub fn from_samples(period: f64, samples: &[f64], rate: f64) -> Self {
        let n = samples.len();
        let mut analysis = Analysis::new(n.max(1));
        analysis.read(samples.iter().copied());
        let spectrum = &analysis.spectrum;
        // Each harmonic stands for itself and its mirror image, but for the highest of an even
        // number.
        let scale = |j: usize| if 2 * j == n { 1.0 } else { 2.0 } / n as f64;
        let harmonics = || spectrum.iter().enumerate().skip(1);
        let cosines = harmonics().map(|(j, c)| scale(j) * c.re).collect();
        let sines = harmonics()
            .map(|(j, c)| if 2 * j == n { 0.0 } else { -scale(j) * c.im })
            .collect();
        let mean = spectrum[0].re / n.max(1) as f64;
        PeriodicSeries::new(period, mean, rate, cosines, sines)
    }

    /// The series with its harmonics weakened by a filter.
    pub fn filtered(mut self, filter: &SpectralFilter) -> Self {
        let count = self.cosines.len();
        for (j, (c, s)) in self.cosines.iter_mut().zip(&mut self.sines).enumerate() {
            let factor = filter.factor(j + 1, count);
            *c *= factor;
            *s *= factor;
        }
        self
    }

    /// The derivative in time, as a series.
    pub fn differentiated(&self) -> Self {
        let omega = TAU / self.period;
        let times_rate = |(j, x): (usize, &f64)| (j + 1) as f64 * omega * x;
        PeriodicSeries {
            period: self.period,
            mean: self.rate,
            rate: 0.0,
            cosines: self.sines.iter().enumerate().map(times_rate).collect(),
            sines: self
                .cosines
                .iter()
                .enumerate()
                .map(|x| -times_rate(x))
                .collect(),
        }
    }

    /// Period of the harmonics.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Value at `time`.
    pub fn value(&self, time: f64) -> f64 {
        self.derivative(time, 0)
    }

    /// Derivative of the given order (0 for the value) at `time`.
    pub fn derivative(&self, time: f64, order: u32) -> f64 {
        let omega = TAU / self.period;
        let turns = time / self.period;
        let phase = TAU * (turns - turns.floor());
        let mut sum = match order {
            0 => self.mean + self.rate * time,
            1 => self.rate,
            _ => 0.0,
        };
        for (j, (c, s)) in self.cosines.iter().zip(&self.sines).enumerate() {
            let h = (j + 1) as f64;
            let (sin, cos) = (h * phase).sin_cos();
            let rate = (h * omega).powi(order as i32);
            sum += rate
                * match order % 4 {
                    0 => c * cos + s * sin,
                    1 => s * cos - c * sin,
                    2 => -c * cos - s * sin,
                    _ => c * sin - s * cos,
                };
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolates_values_and_derivatives() {
        let grid = TimeGrid::new(9, 2.0).unwrap();
        let series = PeriodicSeries::new(2.0, 0.3, 1.5, vec![1.0, 0.0, 0.2], vec![0.0, -0.7, 0.1]);
        let values: Vec<f64> = grid.times().map(|t| series.value(t)).collect();
        let found = PeriodicSeries::interpolate(grid, &values, 1.5);
        for time in [-0.3, 0.0, 0.77, 3.1] {
            for (order, tolerance) in [(0, 1e-14), (1, 1e-13), (2, 1e-12), (3, 1e-11)] {
                let error = found.derivative(time, order) - series.derivative(time, order);
                assert!(error.abs() < tolerance, "{order}: {error}");
            }
            let rates = found.differentiated().value(time) - series.derivative(time, 1);
            assert!(rates.abs() < 1e-13);
            let h = 1e-5;
            let slope = (series.value(time + h) - series.value(time - h)) / (2.0 * h);
            assert!((slope - series.derivative(time, 1)).abs() < 1e-7);
        }
    }

    #[test]
    fn an_even_number_of_samples_is_reproduced() {
        let samples = [1.0, -0.5, 0.25, 2.0, 0.1, 0.0];
        let series = PeriodicSeries::from_samples(3.0, &samples, 0.0);
        for (k, x) in samples.iter().enumerate() {
            assert!((series.value(0.5 * k as f64) - x).abs() < 1e-14);
        }
    }
}
