//! Discrete Fourier transforms of real samples (docs/theory.md, section 2.2).

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::fmt;
use std::sync::Arc;

pub use realfft::num_complex::Complex;

/// From samples over a period to their harmonics, from 0, not scaled.
#[derive(Clone)]
pub struct Analysis {
    plan: Arc<dyn RealToComplex<f64>>,
    /// Spoilt by the transform.
    pub samples: Vec<f64>,
    /// Harmonics.
    pub spectrum: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

/// From harmonics to samples.
#[derive(Clone)]
pub struct Synthesis {
    plan: Arc<dyn ComplexToReal<f64>>,
    /// Harmonics, spoilt by the transform.
    pub spectrum: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

impl Analysis {
    /// Of this many samples, at least one.
    pub fn new(points: usize) -> Self {
        let plan = RealFftPlanner::new().plan_fft_forward(points);
        Analysis {
            samples: plan.make_input_vec(),
            spectrum: plan.make_output_vec(),
            scratch: plan.make_scratch_vec(),
            plan,
        }
    }

    /// Writes `spectrum` from `samples`.
    pub fn transform(&mut self) {
        // The lengths are this object's own, so it cannot fail.
        let _ = self.plan.process_with_scratch(
            &mut self.samples,
            &mut self.spectrum,
            &mut self.scratch,
        );
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
        let plan = RealFftPlanner::new().plan_fft_inverse(points);
        Synthesis {
            spectrum: plan.make_input_vec(),
            scratch: plan.make_scratch_vec(),
            plan,
        }
    }

    /// Writes the samples of `spectrum` to `out`, which has as many places; what [`Analysis`] gave
    /// comes back times the number of points.
    pub fn write(&mut self, out: &mut [f64]) {
        self.spectrum[0].im = 0.0;
        let _ = self
            .plan
            .process_with_scratch(&mut self.spectrum, out, &mut self.scratch);
    }
}

impl fmt::Debug for Analysis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Analysis({})", self.samples.len())
    }
}

impl fmt::Debug for Synthesis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Synthesis({} harmonics)", self.spectrum.len())
    }
}
