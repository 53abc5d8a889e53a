//! Smallest and largest values.

use crate::fourier::PeriodicSeries;

/// Smallest and largest value of a component, and when it has them first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremes {
    /// The smallest value.
    pub smallest: f64,
    /// Its time.
    pub time_of_smallest: f64,
    /// The largest value.
    pub largest: f64,
    /// Its time.
    pub time_of_largest: f64,
}

/// Intervals for each harmonic, in which a derivative is taken to vanish once at most.
const INTERVALS: usize = 16;
/// Halvings of an interval: to rounding.
const HALVINGS: usize = 60;

impl Extremes {
    /// Of a value at a time, and of `others` at theirs.
    pub fn among((time, value): (f64, f64), others: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let first = Extremes {
            smallest: value,
            time_of_smallest: time,
            largest: value,
            time_of_largest: time,
        };
        others.into_iter().fold(first, |mut found, (time, value)| {
            if value < found.smallest {
                (found.smallest, found.time_of_smallest) = (value, time);
            }
            if value > found.largest {
                (found.largest, found.time_of_largest) = (value, time);
            }
            found
        })
    }

    /// Of a series, over its first period; of one that grows, its ends are looked at, too.
    pub fn of(series: &PeriodicSeries) -> Self {
        let mut times = stationary(series);
        if series.rate != 0.0 {
            times.push(series.period());
        }
        let at = |time: f64| (time, series.value(time));
        Self::among(at(0.0), times.into_iter().map(at))
    }
}

/// Times in the first period at which the derivative of a series changes its sign.
pub(super) fn stationary(series: &PeriodicSeries) -> Vec<f64> {
    let count = INTERVALS * series.cosines.len();
    let slope = |time: f64| series.derivative(time, 1);
    let mut times = Vec::new();
    let mut before = (0.0, slope(0.0));
    for i in 1..=count {
        let here = series.time_at(i as f64 / count as f64);
        let now = (here, slope(here));
        if (before.1 < 0.0) != (now.1 < 0.0) {
            times.push(root(slope, before, now));
        }
        before = now;
    }
    times
}

/// Where a function that changes its sign in an interval vanishes.
fn root(function: impl Fn(f64) -> f64, from: (f64, f64), to: (f64, f64)) -> f64 {
    let (mut low, mut high) = (from.0, to.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if (function(middle) < 0.0) == (from.1 < 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    #[test]
    fn extremes_of_waves() {
        // 1 + cos t + cos 2t / 2: least where cos t = −1/2.
        let wave = PeriodicSeries::new(TAU, 1.0, 0.0, vec![1.0, 0.5], vec![0.0, 0.0]);
        let found = Extremes::of(&wave);
        assert!((found.largest - 2.5).abs() < 1e-14 && found.time_of_largest.abs() < 1e-12);
        assert!((found.smallest - 0.25).abs() < 1e-14);
        assert!((found.time_of_smallest - 2.0 * PI / 3.0).abs() < 1e-7);
        let sine = PeriodicSeries::new(TAU, 0.0, 0.0, vec![0.0], vec![-2.0]);
        let found = Extremes::of(&sine);
        assert!((found.smallest + 2.0).abs() < 1e-14);
        assert!((found.time_of_smallest - FRAC_PI_2).abs() < 1e-7);
        // What grows steadily.
        let angle = PeriodicSeries::new(TAU, 0.1, 2.0, vec![0.0], vec![0.5]);
        let found = Extremes::of(&angle);
        assert_eq!((found.smallest, found.time_of_smallest), (0.1, 0.0));
        assert!((found.largest - 0.1 - 2.0 * TAU).abs() < 1e-13);
        assert_eq!(found.time_of_largest, TAU);
        let constant = PeriodicSeries::new(TAU, 0.3, 0.0, Vec::new(), Vec::new());
        let found = Extremes::of(&constant);
        assert_eq!((found.smallest, found.largest), (0.3, 0.3));
    }
}
