//! Linear fields over the period: secular growth plus harmonics.

use super::filter::SpectralFilter;
use super::grid::TimeGrid;
use super::time_map::TimeMap;
use super::transform::{Analysis, Complex};
use std::f64::consts::TAU;

/// A scalar function `rate·t + mean + Σ_j (c_j cos jΩt + s_j sin jΩt)`.
///
/// Through values on a mapped grid it has more harmonics than those of its coefficients, as many as
/// the grid has points for: values and derivatives are of all of them.
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
    mapped: Option<Box<Mapped>>,
}

/// A derivative by time of a series in pseudo-time.
#[derive(Debug, Clone, PartialEq)]
struct Mapped {
    map: TimeMap,
    /// In pseudo-time, without growth.
    series: PeriodicSeries,
    order: u32,
}

impl Mapped {
    /// Derivatives of this order of what the series stands for, at a time.
    fn derivative(&self, time: f64, order: u32) -> f64 {
        let turns = time / self.series.period;
        let pseudo = self.series.period * self.map.pseudo(turns);
        let by = |order: u32| self.series.derivative(pseudo, order);
        let period = self.series.period;
        let [a, b, c] = self.map.pseudo_derivatives(turns);
        let (b, c) = (b / period, c / (period * period));
        match self.order + order {
            0 => by(0),
            1 => by(1) * a,
            2 => by(2) * a * a + by(1) * b,
            _ => by(3) * a * a * a + 3.0 * by(2) * a * b + by(1) * c,
        }
    }

    /// Mean and harmonics in time, as many as in pseudo-time, of the derivative: integrals over
    /// pseudo-time, by equispaced points that leave rounding.
    fn in_time(&self) -> PeriodicSeries {
        let (period, count) = (self.series.period, self.series.cosines.len());
        let points = self.map.resolving(count);
        let mut mean = 0.0;
        let mut harmonics = vec![Complex::<f64>::default(); count];
        for m in 0..points {
            let pseudo = m as f64 / points as f64;
            let turns = self.map.time(pseudo);
            let weight = self.map.time_derivatives(turns)[0] / points as f64;
            let value = self.series.value(period * pseudo) * weight;
            mean += value;
            let step = Complex::cis(-TAU * turns);
            let mut wave = Complex::from(2.0 * value);
            for harmonic in &mut harmonics {
                wave *= step;
                *harmonic += wave;
            }
        }
        let cosines = harmonics.iter().map(|c| c.re).collect();
        let sines = harmonics.iter().map(|c| -c.im).collect();
        let series = PeriodicSeries::new(period, mean, 0.0, cosines, sines);
        (0..self.order).fold(series, |series, _| series.differentiated())
    }
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
            mapped: None,
        }
    }

    /// Interpolates values at the points of `grid`, after taking the secular part `rate·t` out.
    pub fn interpolate(grid: TimeGrid, values: &[f64], rate: f64) -> Self {
        let periodic: Vec<f64> = values
            .iter()
            .zip(grid.times())
            .map(|(x, t)| x - rate * t)
            .collect();
        if grid.map().is_identity() {
            return Self::from_samples(grid.period(), &periodic, rate);
        }
        let mapped = Mapped {
            map: *grid.map(),
            series: Self::from_samples(grid.period(), &periodic, 0.0),
            order: 0,
        };
        Self::of_mapped(mapped, rate)
    }

    fn of_mapped(mapped: Mapped, rate: f64) -> Self {
        PeriodicSeries {
            rate,
            ..mapped.in_time()
        }
        .known_by(mapped)
    }

    fn known_by(mut self, mapped: Mapped) -> Self {
        self.mapped = Some(Box::new(mapped));
        self
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

    /// The series with its harmonics, in pseudo-time on a mapped grid, weakened by a filter.
    pub fn filtered(mut self, filter: &SpectralFilter) -> Self {
        if let Some(mut mapped) = self.mapped.take() {
            mapped.series = mapped.series.filtered(filter);
            return Self::of_mapped(*mapped, self.rate);
        }
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
            mapped: self.mapped.clone().map(|mut mapped| {
                mapped.order += 1;
                mapped
            }),
        }
    }

    /// The time at a pseudo-time, both from 0 to 1 over the period, in which its values change as
    /// evenly as its grid is dense.
    pub fn time_at(&self, pseudo: f64) -> f64 {
        let mapped = self.mapped.as_deref();
        self.period * mapped.map_or(pseudo, |mapped| mapped.map.time(pseudo))
    }

    /// Period of the harmonics.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Value at `time`.
    pub fn value(&self, time: f64) -> f64 {
        self.derivative(time, 0)
    }

    /// Derivative of the given order (0 for the value) at `time`; on a mapped grid up to the third
    /// of what was interpolated.
    pub fn derivative(&self, time: f64, order: u32) -> f64 {
        if let Some(mapped) = &self.mapped {
            let grown = match order {
                0 => self.rate * time + if mapped.order == 1 { self.mean } else { 0.0 },
                1 => self.rate,
                _ => 0.0,
            };
            return grown + mapped.derivative(time, order);
        }
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

    #[test]
    fn on_a_mapped_grid_values_and_harmonics_are_those_in_time() {
        let event = super::super::SharpEvent {
            time: 0.7,
            width: 0.03,
            share: 1.5,
        };
        let map = TimeMap::new(&[event], 2.0).unwrap();
        // A narrow pulse, whose harmonics are known, and a steady turn.
        let (decay, rate) = (0.06 * TAU / 2.0, 1.5);
        let ratio = (-decay).exp();
        let pulse = |t: f64| {
            let phase = TAU * (t - 0.7) / 2.0;
            decay.sinh() / (decay.cosh() - phase.cos())
        };
        let grid = TimeGrid::new(101, 2.0).unwrap().mapped(map);
        let values: Vec<f64> = grid.times().map(|t| pulse(t) + rate * t).collect();
        let series = PeriodicSeries::interpolate(grid, &values, rate);
        for t in [0.0, 0.3, 0.66, 0.7, 0.74, 1.9, -0.4, 3.1] {
            let h = 1e-3;
            let at = |i: i32| pulse(t + h * f64::from(i)) + rate * (t + h * f64::from(i));
            let error = (series.value(t) - at(0)).abs();
            assert!(error < 1e-8, "{t}: {error:e}");
            let first = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
            let slopes = [series.derivative(t, 1), series.differentiated().value(t)];
            // Differences of fourth order, over a thirtieth of the pulse's width.
            for slope in slopes {
                assert!((slope - first).abs() < 1e-4, "{t}: {slope} {first}");
            }
            let second =
                (16.0 * (at(1) + at(-1)) - (at(2) + at(-2)) - 30.0 * at(0)) / (12.0 * h * h);
            let twice = series.differentiated().differentiated().value(t);
            assert!((twice - second).abs() < 1e-2, "{t}: {twice} {second}");
            let rates = series.differentiated();
            let slope = (rates.value(t + h) - rates.value(t - h)) / (2.0 * h);
            assert!((rates.derivative(t, 1) - slope).abs() < 50.0);
        }
        // Poisson's kernel has harmonics 2 rʲ; mean and rate are not among its derivatives'.
        assert!((series.mean - 1.0).abs() < 1e-9 && series.rate == rate);
        let rates = series.differentiated();
        assert!((rates.mean - rate).abs() < 1e-15 && rates.rate == 0.0);
        for j in [1, 2, 10, 50] {
            let exact = 2.0 * ratio.powi(j);
            let (sine, cosine) = (TAU * f64::from(j) * 0.35).sin_cos();
            let (c, s) = (series.cosines[j as usize - 1], series.sines[j as usize - 1]);
            assert!((c - exact * cosine).abs() < 1e-9 && (s - exact * sine).abs() < 1e-9);
            let rate = f64::from(j) * TAU / 2.0;
            assert!((rates.cosines[j as usize - 1] - rate * s).abs() < 1e-12 * rate);
        }
        // The series itself is filtered where its grid is equispaced.
        let filter = SpectralFilter::new(crate::fourier::FilterKind::Exponential, 8).unwrap();
        let filtered = series.clone().filtered(&filter);
        assert!((filtered.mean - 1.0).abs() < 1e-3 && filtered != series);
    }
}
