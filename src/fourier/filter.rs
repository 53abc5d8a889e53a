//! Spectral filters: harmonics near the grid's limit are weakened, so that a kink or a narrow peak
//! does not ring through the whole period (Gibbs). See docs/theory.md, section 2.3.

use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Shape of a spectral filter, with `η = j / (H + 1)` for harmonic `j` of `H`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum FilterKind {
    /// Lanczos' factors `(sin πη / πη)ᵖ`: of order 1, running means over two grid intervals.
    Lanczos,
    /// `exp(−36 ηᵖ)`: the last harmonic vanishes, and a high order spares the low ones.
    Exponential,
}

/// A spectral filter. The mean is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SpectralFilter {
    kind: FilterKind,
    order: u32,
}

/// Exponent at which a harmonic is below rounding.
const VANISHING: f64 = 36.0;

impl SpectralFilter {
    /// Highest order there is.
    pub const HIGHEST_ORDER: u32 = 32;

    /// A filter of an order from 1 to [`Self::HIGHEST_ORDER`].
    pub fn new(kind: FilterKind, order: u32) -> Result<Self> {
        if !(1..=Self::HIGHEST_ORDER).contains(&order) {
            let expected = format!("an order from 1 to {}", Self::HIGHEST_ORDER);
            return Err(Error::value("order", expected, order));
        }
        Ok(SpectralFilter { kind, order })
    }

    /// Factor of a harmonic of a grid that has `harmonics`.
    pub fn factor(&self, harmonic: usize, harmonics: usize) -> f64 {
        let place = harmonic as f64 / (harmonics + 1) as f64;
        match self.kind {
            _ if harmonic == 0 => 1.0,
            FilterKind::Lanczos => ((PI * place).sin() / (PI * place)).powi(self.order as i32),
            FilterKind::Exponential => (-VANISHING * place.powi(self.order as i32)).exp(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_fall_from_one_to_nearly_nothing() {
        for (kind, order) in [
            (FilterKind::Lanczos, 1),
            (FilterKind::Lanczos, 3),
            (FilterKind::Exponential, 2),
            (FilterKind::Exponential, 8),
        ] {
            let filter = SpectralFilter::new(kind, order).unwrap();
            let factors: Vec<f64> = (0..=50).map(|j| filter.factor(j, 50)).collect();
            assert_eq!(factors[0], 1.0);
            assert!(factors.windows(2).all(|pair| pair[1] <= pair[0]));
            assert!(factors[1] > 0.98 && factors[50] < 0.03);
        }
        // Of order 1, running means over two grid intervals.
        let filter = SpectralFilter::new(FilterKind::Lanczos, 1).unwrap();
        let half = PI / 51.0;
        for j in 1..=50 {
            let mean = (j as f64 * half).sin() / (j as f64 * half);
            assert!((filter.factor(j, 50) - mean).abs() < 1e-15);
        }
        for order in [0, 33] {
            let refused = SpectralFilter::new(FilterKind::Lanczos, order).unwrap_err();
            assert!(refused.to_string().starts_with("order: "), "{refused}");
        }
    }
}
