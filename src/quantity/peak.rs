//! When a quantity is largest or smallest, where that is one time: what its peaks vary by is what
//! the value at that time does.

use super::extremes::stationary;
use super::{Feature, History, Measurement, Quantity};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::PeriodicSeries;

/// Two values are equal that differ by this part of the range, or by less.
const EQUAL: f64 = 1e-8;
/// A range below this part of the size is rounding.
const CONSTANT: f64 = 1e-12;
/// Times so near each other, in periods, are the same.
const SAME: f64 = 1e-6;

/// A peak of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Peak {
    /// Its largest value over the period.
    Largest,
    /// Its smallest.
    Smallest,
}

impl Peak {
    /// For messages.
    pub fn name(self) -> &'static str {
        match self {
            Peak::Largest => "largest value",
            Peak::Smallest => "smallest value",
        }
    }

    /// The value of a component of a quantity at the time of this peak.
    ///
    /// # Errors
    /// [`ErrorKind::NotAvailable`] if the quantity grows, hardly changes, or has the peak at two
    /// times: the peak is then no differentiable function of anything.
    pub fn of(
        self,
        quantity: Quantity,
        component: usize,
        history: &History,
    ) -> Result<Measurement> {
        let mean = Measurement::new(quantity, component, Feature::Mean, history.system)?;
        let time = self.time(&mean.series(history)?).map_err(|why| {
            let name = quantity.describe(component);
            let message = format!("the {} of {name}: {why}", self.name());
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        Measurement::new(quantity, component, Feature::At(time), history.system)
    }

    /// When a series has it; else why that is not one time.
    fn time(self, series: &PeriodicSeries) -> std::result::Result<f64, String> {
        if series.rate != 0.0 {
            return Err("it grows from period to period".into());
        }
        let sign = match self {
            Peak::Largest => 1.0,
            Peak::Smallest => -1.0,
        };
        let period = series.period();
        let times = stationary(series);
        let values: Vec<f64> = times
            .iter()
            .map(|&time| sign * series.value(time))
            .collect();
        let most = values.iter().fold(f64::NEG_INFINITY, |m, x| m.max(*x));
        let least = values.iter().fold(f64::INFINITY, |m, x| m.min(*x));
        let range = most - least;
        // Written so that none at all is constant, too.
        let changes = range > CONSTANT * most.abs().max(least.abs());
        if !changes {
            return Err("it is constant, so that any change makes a peak of its own".into());
        }
        let pairs = times.iter().zip(&values);
        let peaks = pairs.filter(|(_, value)| most - *value <= EQUAL * range);
        let peaks: Vec<f64> = peaks.map(|(time, _)| *time).collect();
        let apart = |a: f64, b: f64| {
            let turns = (a - b).abs() / period;
            (turns - turns.round()).abs() > SAME
        };
        match peaks.iter().find(|&&other| apart(peaks[0], other)) {
            None => Ok(peaks[0]),
            Some(other) => Err(format!(
                "it is the same at the times {} and {other}, so that either may become the peak: \
                 it has no derivative; ask for the values at these times",
                peaks[0]
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_peak_is_at_one_time_or_none() {
        let series = |mean: f64, cosines: &[f64], sines: &[f64]| {
            PeriodicSeries::new(TAU, mean, 0.0, cosines.to_vec(), sines.to_vec())
        };
        let wave = series(1.0, &[1.0, 0.5], &[0.0, 0.0]);
        let time = Peak::Largest.time(&wave).unwrap();
        assert!((time / TAU - (time / TAU).round()).abs() < 1e-9, "{time}");
        // Smallest where cos t = −1/2, twice.
        let why = Peak::Smallest.time(&wave).unwrap_err();
        assert!(
            why.contains("2.094395") && why.contains("4.188790"),
            "{why}"
        );
        // One of them lower.
        let tilted = series(1.0, &[1.0, 0.5], &[0.0, 1e-5]);
        assert!((Peak::Smallest.time(&tilted).unwrap() - TAU / 3.0).abs() < 1e-3);
        let constant = series(2.0, &[1e-16], &[0.0]);
        assert!(
            Peak::Largest
                .time(&constant)
                .unwrap_err()
                .contains("constant")
        );
        let nothing = series(2.0, &[], &[]);
        assert!(Peak::Largest.time(&nothing).is_err());
        let growing = PeriodicSeries::new(TAU, 0.0, 1.0, vec![0.5], vec![0.0]);
        assert!(Peak::Largest.time(&growing).unwrap_err().contains("grows"));
    }
}
