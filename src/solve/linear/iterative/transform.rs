//! The discrete Fourier transform over the grid and its inverse, with one array for both.

use crate::fourier::{Analysis, Synthesis};

/// Both ways over the grid.
#[derive(Clone)]
pub(super) struct Transform {
    pub analysis: Analysis,
    pub synthesis: Synthesis,
}

impl Transform {
    pub fn new(points: usize) -> Self {
        Transform {
            analysis: Analysis::new(points),
            synthesis: Synthesis::new(points),
        }
    }

    /// Back to samples, times their number.
    pub fn backward(&mut self) -> &[f64] {
        self.synthesis.write(&mut self.analysis.samples);
        &self.analysis.samples
    }
}
