//! From the points of one grid to those of another of the same period, by FFT.
//! See docs/theory.md, section 2.3.

use super::filter::SpectralFilter;
use super::grid::TimeGrid;
use super::transform::{Analysis, Complex, Synthesis};
use crate::error::Result;
use std::f64::consts::TAU;

/// Points at which series are summed together: one sum waits for its last multiplication.
const TOGETHER: usize = 8;

/// The trigonometric polynomial through values on a grid, and its derivatives, at the points of
/// another grid, which may begin later. All is in the pseudo-time of the grid where that is mapped.
#[derive(Debug, Clone)]
pub struct Resampling {
    grid: TimeGrid,
    /// `exp(i j Ω start) / N`, times the part of the harmonic that the grid has.
    shift: Vec<Complex<f64>>,
    analysis: Analysis,
    synthesis: Synthesis,
    /// Pseudo-time of the first point of the other grid, in periods, and the number of its points.
    start: f64,
    points: usize,
    /// Pseudo-times of these where they are not equispaced.
    apart: Option<Vec<f64>>,
}

impl Resampling {
    /// From `grid` to `points` equispaced times of a period, the first of them `start`
    /// periods later.
    pub fn new(grid: TimeGrid, start: f64, points: usize) -> Self {
        let phase = start - start.floor();
        let scale = 1.0 / grid.points() as f64;
        let shift = (0..=grid.harmonics())
            .map(|j| {
                let scale = scale * grid.part_of_harmonic(j);
                Complex::from_polar(scale, TAU * ((j as f64 * phase) % 1.0))
            })
            .collect();
        Resampling {
            grid,
            shift,
            analysis: Analysis::new(grid.points()),
            synthesis: Synthesis::new(points),
            start,
            points,
            apart: None,
        }
    }

    /// From `grid` to the points of `other`, of which the period is taken for the same, the first
    /// of them `start` periods later.
    pub fn between(grid: TimeGrid, start: f64, other: TimeGrid) -> Self {
        let points = other.points();
        if grid.is_shifted(start, other) {
            return Resampling::new(grid, start, points);
        }
        let place = |k: usize| {
            let time = other.map().time(k as f64 / points as f64);
            grid.map().pseudo(start + time)
        };
        Resampling {
            apart: Some((0..points).map(place).collect()),
            points,
            ..Resampling::new(grid, 0.0, 1)
        }
    }

    /// The grid that values are given on.
    pub fn grid(&self) -> TimeGrid {
        self.grid
    }

    /// Number of points of the other grid.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Pseudo-time at one of these, in periods of the grid that values are given on.
    pub fn pseudo(&self, k: usize) -> f64 {
        match &self.apart {
            Some(places) => places[k],
            None => self.start + k as f64 / self.points as f64,
        }
    }

    /// Takes the values at the points of the grid.
    pub fn read(&mut self, samples: impl Iterator<Item = f64>) {
        self.analysis.read(samples);
    }

    /// Weakens the harmonics of the values read.
    pub fn filter(&mut self, filter: &SpectralFilter) {
        let last = self.grid.harmonics();
        for (j, c) in self.analysis.spectrum.iter_mut().enumerate() {
            *c *= filter.factor(j, last);
        }
    }

    /// Keeps the harmonics of the values read up to `last` only.
    pub fn truncate(&mut self, last: usize) {
        self.analysis
            .spectrum
            .iter_mut()
            .skip(last + 1)
            .for_each(|c| *c = Complex::default());
    }

    /// Amplitude of each harmonic of the values read, from 0.
    pub fn amplitudes(&self) -> impl Iterator<Item = f64> + '_ {
        let scale = 1.0 / self.grid.points() as f64;
        let both = move |(j, c): (usize, &Complex<f64>)| {
            let both = 2.0 * self.grid.part_of_harmonic(j);
            (if j == 0 { scale } else { both * scale }) * c.norm()
        };
        self.analysis.spectrum.iter().enumerate().map(both)
    }

    /// Writes the derivative of the given order (0 for the values), of the harmonics from `first`
    /// on, at the points of the other grid.
    pub fn write(&mut self, order: u32, first: usize, out: &mut [f64]) {
        if let Some(apart) = &self.apart {
            return self.write_apart(apart, order, first, out);
        }
        let points = out.len();
        let half = points / 2;
        let folded = &mut self.synthesis.spectrum;
        folded.fill(Complex::default());
        // Harmonics beyond those of the other grid are there what they alias onto.
        for (j, (c, shift)) in self
            .analysis
            .spectrum
            .iter()
            .zip(&self.shift)
            .enumerate()
            .skip(first)
        {
            let rate = j as f64 * self.grid.frequency();
            let c = c
                * shift
                * match order {
                    0 => Complex::new(1.0, 0.0),
                    1 => Complex::new(0.0, rate),
                    _ => Complex::new(-rate * rate, 0.0),
                };
            let place = j % points;
            if place <= half {
                folded[place] += c;
            }
            let mirrored = (points - place) % points;
            if j > 0 && mirrored <= half {
                folded[mirrored] += c.conj();
            }
        }
        self.synthesis.write(out);
    }

    /// The same by sums of the harmonics, at points that are not equispaced.
    fn write_apart(&self, apart: &[f64], order: u32, first: usize, out: &mut [f64]) {
        let factor = |j: usize| {
            let rate = j as f64 * self.grid.frequency();
            let twice = if j == 0 { 1.0 } else { 2.0 };
            self.shift[j]
                * twice
                * match order {
                    0 => Complex::new(1.0, 0.0),
                    1 => Complex::new(0.0, rate),
                    _ => Complex::new(-rate * rate, 0.0),
                }
        };
        let harmonics = first..self.shift.len();
        let spectrum = &self.analysis.spectrum;
        let coefficients: Vec<_> = harmonics.map(|j| spectrum[j] * factor(j)).collect();
        for (out, places) in out.chunks_mut(TOGETHER).zip(apart.chunks(TOGETHER)) {
            let mut z = [Complex::default(); TOGETHER];
            for (z, place) in z.iter_mut().zip(places) {
                *z = Complex::cis(TAU * (place - place.floor()));
            }
            let mut sums = [Complex::<f64>::default(); TOGETHER];
            for c in coefficients.iter().rev() {
                for (sum, z) in sums.iter_mut().zip(&z) {
                    *sum = *sum * z + c;
                }
            }
            for ((out, sum), z) in out.iter_mut().zip(sums).zip(z) {
                *out = (sum * z.powu(first as u32)).re;
            }
        }
    }
}

/// What values at the points of a mapped grid contribute to the mean over the period of the product
/// of their series in pseudo-time with a function of the phase, counted in periods.
pub fn shares_of_product(grid: TimeGrid, factor: impl Fn(f64) -> f64) -> Result<Vec<f64>> {
    let (map, points) = (grid.map(), grid.points());
    let fine = TimeGrid::new(map.resolving(grid.harmonics()), grid.period())?;
    let mut projection = Resampling::new(fine, 0.0, points);
    projection.read(map.times(fine.points()).into_iter().map(|turns| {
        let weight = map.time_derivatives(turns)[0] / points as f64;
        factor(turns) * weight
    }));
    projection.truncate(grid.harmonics());
    let mut shares = vec![0.0; points];
    projection.write(0, 0, &mut shares);
    Ok(shares)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::PeriodicSeries;

    #[test]
    fn values_and_derivatives_are_those_of_the_series_on_finer_coarser_and_later_grids() {
        for points in [1, 3, 8, 9, 12, 45] {
            let grid = TimeGrid::even_or_odd(points, 1.7).unwrap();
            let values: Vec<f64> = (0..points).map(|k| (k as f64 * 1.3).sin() + 0.2).collect();
            let series = PeriodicSeries::interpolate(grid, &values, 0.0);
            for (start, others) in [
                (0.0, 27),
                (0.1, 16),
                (0.5 / points as f64, points),
                (-0.3, 7),
                (2.7, 1),
            ] {
                let mut resampling = Resampling::new(grid, start, others);
                resampling.read(values.iter().copied());
                let mut out = vec![0.0; others];
                for order in 0..=2 {
                    resampling.write(order, 0, &mut out);
                    let size =
                        (grid.harmonics().max(1) as f64 * grid.frequency()).powi(order as i32);
                    for (k, found) in out.iter().enumerate() {
                        let time = 1.7 * (start + k as f64 / others as f64);
                        let exact = series.derivative(time, order);
                        assert!((found - exact).abs() < 1e-13 * points as f64 * size);
                    }
                }
                let cosines = series
                    .cosines
                    .iter()
                    .zip(&series.sines)
                    .map(|(c, s)| c.hypot(*s));
                for (found, exact) in resampling.amplitudes().skip(1).zip(cosines) {
                    assert!((found - exact).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn points_of_another_map_have_the_values_and_derivatives_of_the_series() {
        let event = |time: f64| crate::fourier::SharpEvent {
            time,
            width: 0.05,
            share: 0.5,
        };
        let map = |time: f64| crate::fourier::TimeMap::new(&[event(time)], 1.7).unwrap();
        let uniform = TimeGrid::new(21, 1.7).unwrap();
        let values: Vec<f64> = (0..21).map(|k| (k as f64 * 1.3).sin() + 0.2).collect();
        let grids = [uniform, uniform.mapped(map(0.4)), uniform.mapped(map(1.1))];
        for (from, to) in [(0, 1), (1, 0), (1, 2), (1, 1)] {
            let (from, to) = (grids[from], grids[to].with_points(33).unwrap());
            for start in [0.0, 0.31, -1.2] {
                let mut resampling = Resampling::between(from, start, to);
                resampling.read(values.iter().copied());
                let mut weights = crate::fourier::CardinalWeights::new(uniform);
                let mut out = vec![0.0; 33];
                for order in 0..=2 {
                    resampling.write(order, 0, &mut out);
                    for (k, found) in out.iter().enumerate() {
                        // The series of pseudo-time.
                        weights.move_to(1.7 * from.pseudo(to.time(k) + 1.7 * start));
                        let all = [&weights.value, &weights.first, &weights.second];
                        let terms = all[order as usize].iter().zip(&values);
                        let exact: f64 = terms.map(|(w, x)| w * x).sum();
                        let size = 40.0f64.powi(order as i32);
                        assert!((found - exact).abs() < 1e-12 * size, "{found} {exact}");
                    }
                }
                resampling.write(0, 4, &mut out);
                let high = out.clone();
                resampling.truncate(3);
                let mut low = vec![0.0; 33];
                resampling.write(0, 0, &mut low);
                resampling.read(values.iter().copied());
                resampling.write(0, 0, &mut out);
                for (k, all) in out.iter().enumerate() {
                    assert!((high[k] + low[k] - all).abs() < 1e-13);
                }
            }
        }
    }

    #[test]
    fn high_harmonics_can_be_left_out() {
        let grid = TimeGrid::new(15, 2.0).unwrap();
        let slow = |t: f64| 5.0 + (2.0 * grid.frequency() * t).sin();
        let wave = |t: f64| (3.0 * grid.frequency() * t).cos();
        let mut resampling = Resampling::new(grid, 0.0, 5);
        resampling.read(grid.times().map(|t| wave(t) + slow(t)));
        resampling.truncate(2);
        let mut out = [0.0; 5];
        resampling.write(0, 0, &mut out);
        for (k, found) in out.iter().enumerate() {
            assert!((found - slow(2.0 * k as f64 / 5.0)).abs() < 1e-14);
        }
    }

    #[test]
    fn low_harmonics_can_be_left_out() {
        let grid = TimeGrid::new(9, 2.0).unwrap();
        let wave = |t: f64| (3.0 * grid.frequency() * t).cos();
        let slow = |t: f64| 5.0 + (grid.frequency() * t).sin();
        let mut resampling = Resampling::new(grid, 0.0, 15);
        resampling.read(grid.times().map(|t| wave(t) + slow(t)));
        let mut out = [0.0; 15];
        resampling.write(0, 2, &mut out);
        for (k, found) in out.iter().enumerate() {
            assert!((found - wave(2.0 * k as f64 / 15.0)).abs() < 1e-14);
        }
    }
}
