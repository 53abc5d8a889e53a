//! Discrete Fourier transforms of real samples (docs/theory.md, section 2.2).

use rustfft::{Fft, FftDirection, FftPlanner};
use std::fmt;
use std::sync::Arc;

pub use rustfft::num_complex::Complex;

/// The transform of complex functions on a grid, one way, not scaled.
#[derive(Clone)]
pub(super) struct Plan {
    plan: Arc<dyn Fft<f64>>,
    scratch: Vec<Complex<f64>>,
}

/// From samples over a period to their harmonics, from 0, not scaled.
#[derive(Debug, Clone)]
pub struct Analysis {
    plan: Plan,
    values: Vec<Complex<f64>>,
    /// What is transformed.
    pub samples: Vec<f64>,
    /// Harmonics.
    pub spectrum: Vec<Complex<f64>>,
}

/// From harmonics to samples.
#[derive(Debug, Clone)]
pub struct Synthesis {
    plan: Plan,
    values: Vec<Complex<f64>>,
    /// Harmonics.
    pub spectrum: Vec<Complex<f64>>,
}

impl Plan {
    /// From samples at so many points, at least one, to harmonics 0, 1, and so on up to −1.
    pub fn forward(points: usize) -> Self {
        Self::new(points, FftDirection::Forward)
    }

    /// From these harmonics to samples.
    pub fn backward(points: usize) -> Self {
        Self::new(points, FftDirection::Inverse)
    }

    fn new(points: usize, direction: FftDirection) -> Self {
        let plan = FftPlanner::new().plan_fft(points, direction);
        Plan {
            scratch: vec![Complex::default(); plan.get_inplace_scratch_len()],
            plan,
        }
    }

    /// Transforms functions that follow each other, in place.
    pub fn transform(&mut self, values: &mut [Complex<f64>]) {
        if !values.is_empty() {
            self.plan.process_with_scratch(values, &mut self.scratch);
        }
    }
}

impl Analysis {
    /// Of this many samples, at least one.
    pub fn new(points: usize) -> Self {
        Analysis {
            plan: Plan::forward(points),
            values: vec![Complex::default(); points],
            samples: vec![0.0; points],
            spectrum: vec![Complex::default(); points / 2 + 1],
        }
    }

    /// Writes `spectrum` from `samples`.
    pub fn transform(&mut self) {
        for (value, sample) in self.values.iter_mut().zip(&self.samples) {
            *value = Complex::new(*sample, 0.0);
        }
        self.plan.transform(&mut self.values);
        let harmonics = self.spectrum.len();
        self.spectrum.copy_from_slice(&self.values[..harmonics]);
    }

    /// The same of these samples.
    pub fn read(&mut self, samples: impl Iterator<Item = f64>) {
        let places = self.samples.iter_mut().zip(samples);
        places.for_each(|(place, sample)| *place = sample);
        self.transform();
    }
}

impl Synthesis {
    /// Of this many samples, at least one.
    pub fn new(points: usize) -> Self {
        Synthesis {
            plan: Plan::backward(points),
            values: vec![Complex::default(); points],
            spectrum: vec![Complex::default(); points / 2 + 1],
        }
    }

    /// Writes the samples of `spectrum` to `out`, which has as many places; what [`Analysis`] gave
    /// comes back times the number of points.
    pub fn write(&mut self, out: &mut [f64]) {
        let points = self.values.len();
        self.values[0] = Complex::new(self.spectrum[0].re, 0.0);
        for (j, harmonic) in self.spectrum.iter().enumerate().skip(1) {
            self.values[j] = *harmonic;
            self.values[points - j] = harmonic.conj();
        }
        self.plan.transform(&mut self.values);
        out.iter_mut()
            .zip(&self.values)
            .for_each(|(out, value)| *out = value.re);
    }
}

impl fmt::Debug for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} points", self.plan.len())
    }
}
