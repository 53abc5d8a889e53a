//! Numbers of a series: mean, harmonics, the value at a time.

use crate::error::{Error, Result, require_finite};
use crate::fourier::{CardinalWeights, PeriodicSeries, TimeGrid, shares_of_product};
use std::f64::consts::TAU;
use std::fmt;

/// A number of a quantity over the period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Feature {
    /// Its mean, without what it gains.
    Mean,
    /// Coefficient of the cosine of this harmonic, from 1.
    Cosine(usize),
    /// Coefficient of the sine of this harmonic, from 1.
    Sine(usize),
    /// Its value at a time, by its series.
    At(f64),
}

impl Feature {
    /// Checks that series on a grid have it.
    ///
    /// # Errors
    /// If the harmonic is none of the grid, or the time no number.
    pub fn require_on(self, grid: TimeGrid) -> Result<()> {
        match self {
            Feature::Mean => Ok(()),
            Feature::Cosine(j) | Feature::Sine(j) => {
                let highest = grid.harmonics();
                if (1..=highest).contains(&j) {
                    return Ok(());
                }
                let expected = format!("one of the harmonics 1 to {highest} of the grid");
                Err(Error::value("harmonic", expected, j))
            }
            Feature::At(time) => require_finite("time", &[time]),
        }
    }

    /// Of a series that has it.
    pub fn of(self, series: &PeriodicSeries) -> f64 {
        let coefficient = |all: &[f64], j: usize| all.get(j.wrapping_sub(1)).copied();
        match self {
            Feature::Mean => series.mean,
            Feature::Cosine(j) => coefficient(&series.cosines, j).unwrap_or(0.0),
            Feature::Sine(j) => coefficient(&series.sines, j).unwrap_or(0.0),
            Feature::At(time) => series.value(time),
        }
    }

    /// Its derivatives by the values at the points of a grid, of which the series' derivative of
    /// this order has it.
    ///
    /// # Errors
    /// If the grid is none.
    pub(super) fn weights(self, grid: TimeGrid, order: u32) -> Result<Vec<f64>> {
        if !grid.map().is_identity() {
            return self.weights_in_pseudo_time(grid, order);
        }
        let (points, harmonics) = (grid.points(), grid.harmonics());
        let omega = TAU / grid.period();
        // By the mean, and by the cosines and sines, of the derivative.
        let mut mean = match self {
            Feature::Mean | Feature::At(_) => 1.0,
            Feature::Cosine(_) | Feature::Sine(_) => 0.0,
        };
        let (mut cosines, mut sines) = (vec![0.0; harmonics], vec![0.0; harmonics]);
        match self {
            Feature::Mean => {}
            Feature::Cosine(j) => cosines[j - 1] = 1.0,
            Feature::Sine(j) => sines[j - 1] = 1.0,
            Feature::At(time) => {
                let turns = time / grid.period();
                let phase = TAU * (turns - turns.floor());
                for (j, (c, s)) in cosines.iter_mut().zip(&mut sines).enumerate() {
                    (*s, *c) = ((j + 1) as f64 * phase).sin_cos();
                }
            }
        }
        // By those of what is differentiated: its mean has no part in it.
        for _ in 0..order {
            mean = 0.0;
            for (j, (c, s)) in cosines.iter_mut().zip(&mut sines).enumerate() {
                let rate = (j + 1) as f64 * omega;
                (*c, *s) = (-rate * *s, rate * *c);
            }
        }
        let n = points as f64;
        let twice = |all: Vec<f64>| {
            let both = |(j, x)| 2.0 * grid.part_of_harmonic(j) * x / n;
            (1..).zip(all).map(both).collect()
        };
        let weights =
            PeriodicSeries::new(grid.period(), mean / n, 0.0, twice(cosines), twice(sines));
        Ok(grid.times().map(|time| weights.value(time)).collect())
    }

    /// The same on a mapped grid, whose series is one in pseudo-time.
    fn weights_in_pseudo_time(self, grid: TimeGrid, order: u32) -> Result<Vec<f64>> {
        let rate = |j: usize| (j as f64 * grid.frequency()).powi(order as i32);
        // Of the cosine, the sine and the harmonic of a derivative, by those of what it is one of.
        let turned = |quarters: u32| [1.0, 0.0, -1.0, 0.0][(quarters % 4) as usize];
        Ok(match self {
            Feature::Mean if order > 0 => vec![0.0; grid.points()],
            Feature::Mean => shares_of_product(grid, |_| 1.0)?,
            Feature::Cosine(j) | Feature::Sine(j) => {
                let is_sine = matches!(self, Feature::Sine(_));
                // A derivative takes the harmonic a quarter of a turn further, as a sine is.
                let quarters = order + u32::from(is_sine);
                let (by_cosine, by_sine) = (turned(quarters), turned(quarters + 3));
                shares_of_product(grid, |turns| {
                    let (sine, cosine) = (TAU * (j as f64 * turns).fract()).sin_cos();
                    2.0 * rate(j) * (by_cosine * cosine + by_sine * sine)
                })?
            }
            Feature::At(time) => {
                let mut weights = CardinalWeights::new(grid);
                weights.move_to(time);
                match order {
                    0 => weights.value,
                    1 => weights.first,
                    _ => weights.second,
                }
            }
        })
    }
}

impl fmt::Display for Feature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Feature::Mean => write!(f, "mean"),
            Feature::Cosine(j) => write!(f, "cosine {j}"),
            Feature::Sine(j) => write!(f, "sine {j}"),
            Feature::At(time) => write!(f, "value at {time}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::{SharpEvent, TimeMap};

    #[test]
    fn weights_are_derivatives_of_features() {
        let event = SharpEvent {
            time: 0.4,
            width: 0.1,
            share: 1.0,
        };
        let map = TimeMap::new(&[event], 1.3).unwrap();
        let grid = TimeGrid::new(7, 1.3).unwrap();
        let even = TimeGrid::even_or_odd(6, 1.3).unwrap();
        for grid in [grid, grid.mapped(map), even] {
            weights_are_derivatives_on(grid);
        }
    }

    fn weights_are_derivatives_on(grid: TimeGrid) {
        let features = [
            Feature::Mean,
            Feature::Cosine(1),
            Feature::Cosine(3),
            Feature::Sine(2),
            Feature::At(0.4),
            Feature::At(-7.1),
        ];
        let value = |feature: Feature, order: u32, values: &[f64]| {
            let series = PeriodicSeries::interpolate(grid, values, 0.0);
            feature.of(&(0..order).fold(series, |series, _| series.differentiated()))
        };
        for (feature, order) in features.iter().flat_map(|f| [(*f, 0), (*f, 1), (*f, 2)]) {
            let weights = feature.weights(grid, order).unwrap();
            for (k, weight) in weights.iter().enumerate() {
                // Features are linear.
                let mut unit = vec![0.0; grid.points()];
                unit[k] = 1.0;
                let error = value(feature, order, &unit) - weight;
                let size = (3.0 * TAU / 1.3f64).powi(order as i32);
                assert!(
                    error.abs() < 1e-14 * size,
                    "{feature} {order} {k}: {error:e}"
                );
            }
        }
    }

    #[test]
    fn harmonics_that_the_grid_does_not_have_are_refused() {
        let grid = TimeGrid::new(7, 1.3).unwrap();
        for j in [0, 4] {
            let error = Feature::Sine(j).require_on(grid).unwrap_err().to_string();
            assert!(error.contains("1 to 3"), "{error}");
        }
        assert!(Feature::At(f64::NAN).require_on(grid).is_err());
        assert!(Feature::Cosine(3).require_on(grid).is_ok());
    }
}
