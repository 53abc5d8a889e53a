//! Signals: scalar functions of time that drive loads and prescribed motions.

use super::UserFunction;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::PeriodicSeries;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::fmt;
use std::sync::Arc;

/// A user's function of time, or of the phase.
pub type SignalFunction = Arc<dyn Fn(f64) -> Result<f64> + Send + Sync>;

#[derive(Clone, Serialize, Deserialize)]
enum Shape {
    Harmonics {
        cosines: Vec<f64>,
        sines: Vec<f64>,
    },
    Samples(Vec<f64>),
    Function(UserFunction<SignalFunction>),
    /// Of the phase, in radians.
    OfPhase(UserFunction<SignalFunction>),
}

/// A scalar function of time: mean, secular rate, and a shape: harmonics of the period, samples
/// over the period, or a function.
#[derive(Clone, Serialize, Deserialize)]
#[serde(try_from = "SignalRecord")]
pub struct Signal {
    pub(super) mean: f64,
    pub(super) rate: f64,
    /// Factor of the shape.
    pub(super) amplitude: f64,
    /// Phase by which the shape is ahead.
    pub(super) phase: f64,
    /// How often the shape, but for a function of time, repeats itself in a period.
    cycles: usize,
    shape: Shape,
}

/// A signal as a file has it, which may be anything.
#[derive(Deserialize)]
struct SignalRecord {
    mean: f64,
    rate: f64,
    #[serde(default = "one")]
    amplitude: f64,
    #[serde(default)]
    phase: f64,
    #[serde(default = "once")]
    cycles: usize,
    shape: Shape,
}

fn one() -> f64 {
    1.0
}

fn once() -> usize {
    1
}

/// Most cycles of a shape in a period.
const MOST_CYCLES: usize = 1 << 16;

impl TryFrom<SignalRecord> for Signal {
    type Error = Error;

    fn try_from(record: SignalRecord) -> Result<Self> {
        let SignalRecord {
            mean,
            rate,
            amplitude,
            phase,
            cycles,
            shape,
        } = record;
        require_finite("signal", &[amplitude, phase])?;
        if !(1..=MOST_CYCLES).contains(&cycles) {
            let expected = format!("from 1 to {MOST_CYCLES}");
            return Err(Error::value("cycles", expected, cycles));
        }
        match &shape {
            Shape::Harmonics { cosines, sines } => {
                Signal::harmonics(mean, rate, cosines, sines)?;
            }
            Shape::Samples(samples) => {
                require_finite("mean", &[mean])?;
                Signal::samples(rate, samples)?;
            }
            Shape::Function(_) | Shape::OfPhase(_) => require_finite("signal", &[mean, rate])?,
        }
        Ok(Signal {
            mean,
            rate,
            amplitude,
            phase,
            cycles,
            shape,
        })
    }
}

impl fmt::Debug for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shape = match &self.shape {
            Shape::Harmonics { cosines, .. } => format!("{} harmonics", cosines.len()),
            Shape::Samples(samples) => format!("{} samples", samples.len()),
            Shape::Function(_) | Shape::OfPhase(_) => "a function".into(),
        };
        write!(f, "Signal({} + {} t, {shape})", self.mean, self.rate)
    }
}

impl Signal {
    fn of(mean: f64, rate: f64, shape: Shape) -> Self {
        Signal {
            mean,
            rate,
            amplitude: 1.0,
            phase: 0.0,
            cycles: 1,
            shape,
        }
    }

    /// `mean + rate t + Σ_j (cosines[j−1] cos jΩt + sines[j−1] sin jΩt)`, with `Ω` of the solve's
    /// period.
    pub fn harmonics(mean: f64, rate: f64, cosines: &[f64], sines: &[f64]) -> Result<Self> {
        require_finite("mean", &[mean])?;
        require_finite("rate", &[rate])?;
        require_finite("cosines", cosines)?;
        require_finite("sines", sines)?;
        if cosines.len() != sines.len() {
            let expected = format!("as many as cosines ({})", cosines.len());
            return Err(Error::size("sines", expected, sines.len()));
        }
        let shape = Shape::Harmonics {
            cosines: cosines.to_vec(),
            sines: sines.to_vec(),
        };
        Ok(Signal::of(mean, rate, shape))
    }

    /// A constant.
    pub fn constant(value: f64) -> Result<Self> {
        Self::harmonics(value, 0.0, &[], &[])
    }

    /// Whether it is zero at all times, so far as that is known without calling a function.
    pub(crate) fn is_zero(&self) -> bool {
        let zero = |values: &[f64]| values.iter().all(|&x| x == 0.0);
        zero(&[self.mean, self.rate])
            && match &self.shape {
                Shape::Harmonics { cosines, sines } => zero(cosines) && zero(sines),
                Shape::Samples(samples) => zero(samples),
                Shape::Function(_) | Shape::OfPhase(_) => false,
            }
    }

    /// `rate t` plus the trigonometric interpolation of `samples[k]` at `t = k T / n`.
    pub fn samples(rate: f64, samples: &[f64]) -> Result<Self> {
        require_finite("rate", &[rate])?;
        require_finite("samples", samples)?;
        if samples.is_empty() {
            return Err(Error::size("samples", "at least one sample", 0));
        }
        Ok(Signal::of(0.0, rate, Shape::Samples(samples.to_vec())))
    }

    /// A function of time, called with times within one period or, in a march, with its times.
    pub fn function(function: SignalFunction) -> Self {
        Signal::of(0.0, 0.0, Shape::Function(UserFunction::new(function)))
    }

    /// A function of the phase `Ωt`, in radians, for periods of any length.
    pub fn function_of_phase(function: SignalFunction) -> Self {
        Signal::of(0.0, 0.0, Shape::OfPhase(UserFunction::new(function)))
    }

    /// The signal over a given period.
    pub fn bind(&self, period: f64) -> BoundSignal {
        let rate = self.rate;
        let of_function = |function: &UserFunction<SignalFunction>, of_phase: bool| {
            BoundSignal::Function(BoundFunction {
                function: function.clone(),
                period,
                of_phase,
                cycles: self.cycles as f64,
                ahead: self.phase / TAU * period / self.cycles as f64,
                amplitude: self.amplitude,
                mean: self.mean,
                rate,
            })
        };
        match &self.shape {
            Shape::Harmonics { cosines, sines } => {
                let (cosines, sines) = self.shaped(cosines.clone(), sines.clone());
                let series = PeriodicSeries::new(period, self.mean, rate, cosines, sines);
                BoundSignal::Series(series)
            }
            Shape::Samples(samples) => {
                let mut series = PeriodicSeries::from_samples(period, samples, rate);
                series.mean = self.mean + self.amplitude * series.mean;
                (series.cosines, series.sines) = self.shaped(series.cosines, series.sines);
                BoundSignal::Series(series)
            }
            Shape::Function(function) => of_function(function, false),
            Shape::OfPhase(function) => of_function(function, true),
        }
    }

    /// Harmonics with the amplitude and the phase of this signal.
    fn shaped(&self, mut cosines: Vec<f64>, mut sines: Vec<f64>) -> (Vec<f64>, Vec<f64>) {
        if (self.amplitude, self.phase) != (1.0, 0.0) {
            for (j, (c, s)) in cosines.iter_mut().zip(&mut sines).enumerate() {
                let (sin, cos) = ((j + 1) as f64 * self.phase).sin_cos();
                (*c, *s) = (
                    self.amplitude * (*c * cos + *s * sin),
                    self.amplitude * (*s * cos - *c * sin),
                );
            }
        }
        (self.spread(cosines), self.spread(sines))
    }

    /// Harmonics of a shape as those of the period.
    fn spread(&self, harmonics: Vec<f64>) -> Vec<f64> {
        if self.cycles == 1 {
            return harmonics;
        }
        let mut spread = vec![0.0; harmonics.len() * self.cycles];
        let places = spread.iter_mut().skip(self.cycles - 1).step_by(self.cycles);
        places.zip(harmonics).for_each(|(x, h)| *x = h);
        spread
    }

    /// The same over a period that is so many times as long, and rates as they are.
    pub(super) fn repeat(&mut self, times: usize) {
        self.cycles = self.cycles.saturating_mul(times);
    }

    /// The same over a period `ratio` times as long as the one that its rate is of.
    pub(super) fn stretch(&mut self, ratio: f64) {
        self.rate /= ratio;
    }

    /// Whether it is a function of time, which knows of one period alone.
    pub(crate) fn has_own_time(&self) -> bool {
        matches!(self.shape, Shape::Function(_))
    }

    /// Whether it was a function of the user in a model that was loaded from a file.
    pub(crate) fn is_absent(&self) -> bool {
        match &self.shape {
            Shape::Function(function) | Shape::OfPhase(function) => function.is_absent(),
            Shape::Harmonics { .. } | Shape::Samples(_) => false,
        }
    }
}

/// A signal over a given period.
#[derive(Clone)]
pub enum BoundSignal {
    /// Secular rate and harmonics.
    Series(PeriodicSeries),
    /// A user's function.
    Function(BoundFunction),
}

/// A user's function over a given period.
#[derive(Clone)]
pub struct BoundFunction {
    function: UserFunction<SignalFunction>,
    period: f64,
    /// Whether the function is told the phase, not the time.
    of_phase: bool,
    /// Of that phase in a period.
    cycles: f64,
    /// Time by which it is ahead.
    ahead: f64,
    amplitude: f64,
    mean: f64,
    rate: f64,
}

impl BoundFunction {
    fn value(&self, time: f64) -> Result<f64> {
        let unit = match self.of_phase {
            true => TAU * self.cycles / self.period,
            false => 1.0,
        };
        let value = self.function.get()?((time + self.ahead) * unit)?;
        if value.is_finite() {
            return Ok(self.mean + self.rate * time + self.amplitude * value);
        }
        let message =
            format!("signal callback: expected a finite number at t = {time}, got {value}");
        Err(Error::new(ErrorKind::Callback, message))
    }
}

impl fmt::Debug for BoundSignal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BoundSignal::Series(series) => series.fmt(f),
            BoundSignal::Function(_) => f.write_str("a function"),
        }
    }
}

impl BoundSignal {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        BoundSignal::Series(PeriodicSeries::new(1.0, value, 0.0, Vec::new(), Vec::new()))
    }

    /// Whether the value depends on the period.
    pub fn has_harmonics(&self) -> bool {
        match self {
            BoundSignal::Series(series) => series
                .cosines
                .iter()
                .chain(&series.sines)
                .any(|c| *c != 0.0),
            BoundSignal::Function(function) => function.of_phase,
        }
    }

    /// Value at `time`.
    pub fn value(&self, time: f64) -> Result<f64> {
        match self {
            BoundSignal::Series(series) => Ok(series.value(time)),
            BoundSignal::Function(function) => function.value(time),
        }
    }

    /// Value, first and second derivative at `time`; those of a function by differences of its
    /// values at `time` and later times, `step` apart.
    pub fn derivatives(&self, time: f64, step: f64) -> Result<[f64; 3]> {
        match self {
            BoundSignal::Series(series) => {
                Ok([0, 1, 2].map(|order| series.derivative(time, order)))
            }
            BoundSignal::Function(_) => {
                // Of the fourth and third order in the step.
                const FIRST: [f64; 5] = [-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25];
                const SECOND: [f64; 5] = [35.0 / 12.0, -26.0 / 3.0, 9.5, -14.0 / 3.0, 11.0 / 12.0];
                let (mut value, mut sums) = (0.0, [0.0; 2]);
                for (k, (first, second)) in FIRST.iter().zip(SECOND).enumerate() {
                    let sample = self.value(time + step * k as f64)?;
                    if k == 0 {
                        value = sample;
                    }
                    // Relative to the first, so that a constant has no derivatives.
                    sums[0] += first * (sample - value);
                    sums[1] += second * (sample - value);
                }
                Ok([value, sums[0] / step, sums[1] / (step * step)])
            }
        }
    }

    /// Period that the signal is bound to.
    pub fn period(&self) -> f64 {
        match self {
            BoundSignal::Series(series) => series.period(),
            BoundSignal::Function(function) => function.period,
        }
    }

    /// Growth over one period.
    pub fn growth(&self) -> Result<f64> {
        match self {
            BoundSignal::Series(series) => Ok(series.rate * series.period()),
            BoundSignal::Function(function) => Ok(self.value(function.period)? - self.value(0.0)?),
        }
    }
}
