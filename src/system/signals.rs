//! Signals: values that drive the system in time.

use super::{ElementRole, Placed, Regime, Standstill, System};
use crate::elements::{Measure, Unknown};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{PeriodicSeries, TimeGrid};
use crate::model::{BoundSignal, absent};
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// A signal, and the value it grows from when loads are raised in steps.
#[derive(Debug, Clone)]
pub(super) struct DrivenSignal {
    pub signal: BoundSignal,
    pub start: f64,
    /// Whether it must stay within a quarter turn, as a middle angle does.
    within_quarter: bool,
    /// What it drives, for messages.
    place: String,
}

impl DrivenSignal {
    /// Whether a function of the user gives it.
    pub fn is_function(&self) -> bool {
        matches!(self.signal, BoundSignal::Function(_))
    }

    /// Its value under all loads.
    fn value(&self, time: f64) -> Result<f64> {
        let value = (self.signal.value(time)).map_err(|e| e.within(&self.place))?;
        if self.within_quarter && value.abs() >= FRAC_PI_2 {
            let message = format!(
                "{}: expected an angle within a quarter turn (1.5708), as it is the middle one of \
                 three, got {value:.6} at t = {time}: turn about axis 1 or 3 of the joint's first \
                 frame",
                self.place
            );
            return Err(Error::new(ErrorKind::Model, message));
        }
        Ok(value)
    }
}

impl System {
    /// Adds a signal of a middle angle of a joint, which must stay within a quarter turn.
    ///
    /// # Errors
    /// As [`System::add_signal`], and where it does not.
    pub(super) fn add_middle_angle(
        &mut self,
        signal: BoundSignal,
        start: f64,
        place: String,
    ) -> Result<usize> {
        let driven = DrivenSignal {
            signal,
            start,
            within_quarter: true,
            place,
        };
        if let Regime::Periodic(period) = self.regime {
            const TIMES: usize = 32;
            for k in 0..=TIMES {
                driven.value(period * (k as f64 / TIMES as f64))?;
            }
        }
        let number = self.add_signal(driven.signal, start, 0.0, driven.place)?;
        self.signals[number].within_quarter = true;
        Ok(number)
    }

    /// Adds a signal that repeats itself, or gains whole multiples of `unit` in a period.
    pub(super) fn add_signal(
        &mut self,
        signal: BoundSignal,
        start: f64,
        unit: f64,
        place: String,
    ) -> Result<usize> {
        let signal = match &self.regime {
            Regime::Standstill(standstill) => constant(&signal, standstill, &place)?,
            Regime::Periodic(_) => {
                require_periodic(&signal, unit).map_err(|e| e.within(&place))?;
                signal
            }
            Regime::March(_) if !self.regime.knows_period() && signal.has_harmonics() => {
                let expected = format!("the period of the harmonics of the signal of {place}");
                return Err(Error::value("options.period", expected, "none"));
            }
            Regime::March(_) => signal,
        };
        self.signals.push(DrivenSignal {
            signal,
            start,
            within_quarter: false,
            place,
        });
        Ok(self.signals.len() - 1)
    }

    /// Values of all signals at `time`, with loads and prescribed motions carried the fraction
    /// `load_factor` of the way from the reference configuration.
    ///
    /// # Errors
    /// Those of functions of the user.
    pub fn signal_values(&self, time: f64, load_factor: f64, values: &mut [f64]) -> Result<()> {
        if self.lacks_functions {
            return Err(absent());
        }
        for (value, driven) in values.iter_mut().zip(&self.signals) {
            let full = driven.value(time)?;
            *value = if load_factor == 1.0 {
                full
            } else {
                driven.start + load_factor * (full - driven.start)
            };
        }
        Ok(())
    }

    /// Whether equilibrium depends on whole turns, of prescribed angles or of internal states: one
    /// at the end of a period may be none at its start then.
    pub(crate) fn counts_turns(&self) -> bool {
        let counts = |unknown: &Unknown| {
            matches!(
                unknown,
                Unknown::State {
                    measure: Measure::Angle,
                    ..
                }
            )
        };
        !self.counted_turns.is_empty() || self.own_unknowns.iter().any(counts)
    }

    /// Largest change of an angle whose whole turns matter by what prescribes it, or others that
    /// it is geared to, between two conditions `(time, load factor)`.
    pub fn turn_between(&self, from: (f64, f64), to: (f64, f64)) -> Result<f64> {
        if self.counted_turns.is_empty() {
            return Ok(0.0);
        }
        let mut values = [vec![0.0; self.signals()], vec![0.0; self.signals()]];
        for (values, (time, load_factor)) in values.iter_mut().zip([from, to]) {
            self.signal_values(time, load_factor, values)?;
        }
        let change = |&signal: &usize| (values[1][signal] - values[0][signal]).abs();
        let largest = self.counted_turns.iter().map(change).fold(0.0, f64::max);
        Ok(largest * self.largest_ratio())
    }

    /// Values, first and second derivatives of all signals at `time`, see
    /// [`BoundSignal::derivatives`].
    pub fn signal_derivatives(&self, time: f64, step: f64) -> Result<[Vec<f64>; 3]> {
        let mut all = [(); 3].map(|()| Vec::with_capacity(self.signals.len()));
        for driven in &self.signals {
            let found = driven.signal.derivatives(time, step);
            let found = found.map_err(|e| e.within(&driven.place))?;
            all.iter_mut().zip(found).for_each(|(list, x)| list.push(x));
        }
        Ok(all)
    }

    /// Measures of the prescribed coordinates: their signals are the first.
    pub fn prescribed_measures(&self) -> impl Iterator<Item = Measure> {
        let prescribed = |placed: &&Placed| matches!(placed.role, ElementRole::Prescribed(_));
        let placed = self.elements.iter().filter(prescribed);
        placed.filter_map(|placed| match placed.element.unknown(0) {
            Unknown::Multiplier(measure) | Unknown::State { measure, .. } => Some(measure),
            Unknown::UserState => None,
        })
    }

    /// Acceleration of gravity, given the values of all signals.
    pub fn gravity(&self, signals: &[f64]) -> Vector3<f64> {
        self.gravity.map_or(Vector3::zeros(), |[x, y, z]| {
            Vector3::new(signals[x], signals[y], signals[z])
        })
    }

    /// Acceleration of gravity at `time`, under all loads.
    ///
    /// # Errors
    /// Those of functions of the user.
    pub(super) fn gravity_at(&self, time: f64) -> Result<Vector3<f64>> {
        let mut gravity = Vector3::zeros();
        for (component, &number) in gravity.iter_mut().zip(self.gravity.iter().flatten()) {
            *component = self.signals[number].value(time)?;
        }
        Ok(gravity)
    }

    /// The harmonics of all signals: those of functions, of their values at `points` (odd) times.
    ///
    /// # Errors
    /// Those of functions.
    pub fn spectra(&self, points: usize) -> Result<Vec<PeriodicSeries>> {
        let grid = TimeGrid::new(points, self.period())?;
        let spectrum = |signal: &BoundSignal| -> Result<PeriodicSeries> {
            match signal {
                BoundSignal::Series(series) => Ok(series.clone()),
                BoundSignal::Function(_) => {
                    let values = grid.times().map(|time| signal.value(time));
                    let rate = signal.growth()? / self.period();
                    let values = values.collect::<Result<Vec<f64>>>()?;
                    Ok(PeriodicSeries::interpolate(grid, &values, rate))
                }
            }
        };
        let found = self
            .signals
            .iter()
            .map(|driven| spectrum(&driven.signal).map_err(|e| e.within(&driven.place)));
        found.collect()
    }

    /// Number of signals that are functions of the user.
    pub fn function_signals(&self) -> usize {
        let is_function = |signal: &BoundSignal| matches!(signal, BoundSignal::Function(_));
        let signals = self.signals.iter().map(|driven| &driven.signal);
        signals.filter(|signal| is_function(signal)).count()
    }

    /// What a signal drives, for messages.
    pub fn signal_place(&self, signal: usize) -> &str {
        &self.signals[signal].place
    }
}

/// A signal that keeps the value it has at the time of `standstill`.
fn constant(signal: &BoundSignal, standstill: &Standstill, place: &str) -> Result<BoundSignal> {
    let time = standstill.time;
    if standstill.period.is_none() && time != 0.0 && signal.has_harmonics() {
        return Err(Error::value(
            "options.period",
            format_args!(
                "the period of the harmonics of the signal of {place}, as options.time is not zero"
            ),
            "none",
        ));
    }
    let value = signal.value(time).map_err(|e| e.within(place))?;
    Ok(BoundSignal::constant(value))
}

/// Checks that a signal returns to itself, or gains whole multiples of `unit` (if not zero).
fn require_periodic(signal: &BoundSignal, unit: f64) -> Result<()> {
    let (first, again) = (signal.value(0.0)?, signal.value(0.0)?);
    if first != again {
        return Err(Error::new(
            ErrorKind::NotPeriodic,
            format!(
                "the function gives different values at the same time: {first}, then {again} at t \
                 = 0"
            ),
        ));
    }
    let growth = signal.growth()?;
    let rest = if unit > 0.0 {
        growth - unit * (growth / unit).round()
    } else {
        growth
    };
    // Compared with the signal's size over the period, as it may be zero at the start.
    const PARTS: usize = 8;
    let mut size = growth.abs().max(unit);
    for k in 0..PARTS {
        let time = signal.period() * (k as f64 / PARTS as f64);
        size = size.max(signal.value(time)?.abs());
    }
    if rest.abs() <= 1e-9 * size {
        return Ok(());
    }
    let expected = if unit > 0.0 {
        "a whole number of turns"
    } else {
        "the value it started from"
    };
    Err(Error::new(
        ErrorKind::NotPeriodic,
        format!("the signal grows by {growth} in one period; expected {expected}"),
    ))
}
