//! Shapes of loads and prescribed motions over a period.

use crate::common::Random;
use periodyn::model::Signal;
use std::f64::consts::{PI, TAU};

/// A periodic function of size 1 or so, of mean zero if it is made of harmonics.
#[derive(Clone)]
pub struct Wave {
    mean: f64,
    cosines: Vec<f64>,
    sines: Vec<f64>,
    samples: Option<Vec<f64>>,
    pub what: String,
}

/// How much a lightly damped oscillation is allowed to grow in the estimate, so that loads are not
/// absurdly small.
const LEAST_RATIO: f64 = 5e-3;
/// Uncertainty of natural frequencies.
const DETUNING: f64 = 0.02;

/// Amplitude of an oscillator over its static displacement, at a frequency `x` times its own that
/// is known to some per cent; of what vibrates in more ways than one, whose other frequencies are
/// above that, not much less.
pub fn gain(x: f64, ratio: f64) -> f64 {
    let ratio = ratio.max(LEAST_RATIO);
    let at = |x: f64| 1.0 / (1.0 - x * x).hypot(2.0 * ratio * x);
    let nearest = 1f64.clamp(x * (1.0 - DETUNING), x * (1.0 + DETUNING));
    at(nearest).max(3.0f64.min(0.5 / ratio) / (1.0 + x * x))
}

impl Wave {
    /// One to twenty harmonics, or a pulse of 2 to 30 % of the period, at half its height.
    pub fn random(random: &mut Random) -> Self {
        match random.below(10) {
            0..=3 => Self::harmonics(random, 1),
            4..=6 => {
                let count = random.decades(2.0, 20.99) as usize;
                Self::harmonics(random, count)
            }
            _ => Self::pulse(random, 0.02, 2),
        }
    }

    /// The same as a motion: pulses are wider and have no jumps of acceleration, as every cam's.
    pub fn random_motion(random: &mut Random) -> Self {
        match random.below(10) {
            0..=4 => Self::harmonics(random, 1),
            5..=7 => {
                let count = random.decades(2.0, 20.99) as usize;
                Self::harmonics(random, count)
            }
            _ => Self::pulse(random, 0.06, 4),
        }
    }

    /// This number of harmonics, each half as large as the one before or larger.
    pub fn harmonics(random: &mut Random, count: usize) -> Self {
        let fall = random.between(1.0, 2.0);
        let (mut cosines, mut sines) = (Vec::new(), Vec::new());
        for j in 1..=count {
            let size = random.between(0.5, 1.0) * (j as f64).powf(-fall);
            let (sine, cosine) = (TAU * random.number()).sin_cos();
            cosines.push(size * cosine);
            sines.push(size * sine);
        }
        Wave {
            mean: 0.0,
            cosines,
            sines,
            samples: None,
            what: format!("{count} harmonics"),
        }
    }

    /// A smooth pulse, a power of a cosine, as if measured or tabulated.
    fn pulse(random: &mut Random, least: f64, order: i32) -> Self {
        let width = random.decades(least, 0.3);
        // At half its height it is as wide as told.
        let reach = 0.25 * PI * width / 0.5f64.powf(1.0 / f64::from(order)).acos();
        let count = random.pick(&[180, 360, 720]);
        let centre = random.between(0.0, 1.0);
        let samples: Vec<f64> = (0..count)
            .map(|k| {
                let from = k as f64 / count as f64 - centre;
                let from = from - from.round();
                match from.abs() {
                    away if away < reach => (0.5 * PI * away / reach).cos().powi(order),
                    _ => 0.0,
                }
            })
            .collect();
        let coefficient = |j: usize, f: fn(f64) -> f64| {
            let terms = samples.iter().enumerate();
            let sum: f64 = terms
                .map(|(k, x)| x * f(TAU * (j * k) as f64 / count as f64))
                .sum();
            2.0 * sum / count as f64
        };
        let most = count / 2 - 1;
        Wave {
            mean: 0.0,
            cosines: (1..=most).map(|j| coefficient(j, f64::cos)).collect(),
            sines: (1..=most).map(|j| coefficient(j, f64::sin)).collect(),
            what: format!("pulse of {:.1} % by {count} samples", 100.0 * width),
            samples: Some(samples),
        }
    }

    /// What a swash plate prescribes for a blade at this part of a turn.
    pub fn swash(collective: f64, cyclic: f64, azimuth: f64) -> Self {
        let (sine, cosine) = (TAU * azimuth).sin_cos();
        Wave {
            mean: collective,
            cosines: vec![cyclic * cosine],
            sines: vec![-cyclic * sine],
            samples: None,
            what: String::new(),
        }
    }

    /// The same, later by this part of the period.
    pub fn later(&self, part: f64) -> Self {
        let mut later = self.clone();
        if let Some(samples) = &mut later.samples {
            let by = (part * samples.len() as f64).round() as usize % samples.len();
            samples.rotate_right(by);
        }
        for (j, (a, b)) in later.cosines.iter_mut().zip(&mut later.sines).enumerate() {
            let (sine, cosine) = (TAU * part * (j + 1) as f64).sin_cos();
            (*a, *b) = (*a * cosine - *b * sine, *a * sine + *b * cosine);
        }
        later
    }

    fn amplitudes(&self) -> impl Iterator<Item = (f64, f64)> {
        let pairs = self.cosines.iter().zip(&self.sines).enumerate();
        pairs.map(|(j, (a, b))| ((j + 1) as f64, a.hypot(*b)))
    }

    /// Displacement that a force of this shape causes, over what a constant force of size 1 causes,
    /// where the first harmonic has `speed` times the first natural frequency.
    pub fn response(&self, speed: f64, ratio: f64) -> f64 {
        let parts = self.amplitudes().map(|(j, a)| a * gain(j * speed, ratio));
        parts.sum::<f64>().max(0.1)
    }

    /// Motion relative to a base that moves so, over the size of the base's motion, or the base's
    /// if that is larger.
    pub fn base_response(&self, speed: f64, ratio: f64) -> f64 {
        let parts = self.amplitudes().map(|(j, a)| {
            let x = j * speed;
            a * x * x * gain(x, ratio)
        });
        parts.sum::<f64>().max(1.0)
    }

    /// `mean + rate t + amplitude × wave`.
    pub fn signal(&self, mean: f64, rate: f64, amplitude: f64) -> Signal {
        let mean = mean + amplitude * self.mean;
        let scaled = |values: &[f64]| values.iter().map(|x| amplitude * x).collect::<Vec<_>>();
        match &self.samples {
            Some(samples) => {
                let values: Vec<f64> = samples.iter().map(|x| mean + amplitude * x).collect();
                Signal::samples(rate, &values)
            }
            None => Signal::harmonics(mean, rate, &scaled(&self.cosines), &scaled(&self.sines)),
        }
        .unwrap()
    }
}
