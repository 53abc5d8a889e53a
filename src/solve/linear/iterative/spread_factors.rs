//! Preconditioners spread over ranks, factored.

use super::Preconditioner;
use super::constraints::Joints;
use super::spread::Spread;
use super::spread_harmonics::SpreadHarmonics;
use super::spread_time::SpreadTime;
use crate::collocation::Halo;
use crate::error::Result;

/// A preconditioner spread over ranks.
pub(crate) enum SpreadFactors {
    Time(Box<SpreadTime>),
    Harmonics(Box<SpreadHarmonics>),
}

impl SpreadFactors {
    /// Factors this one; none if it is singular, or cannot be had of this system. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told, or elements cannot be evaluated.
    pub fn new(spread: Spread, which: Preconditioner) -> Result<Option<Self>> {
        let joints = match which {
            Preconditioner::TimeLocal => {
                let factors = SpreadTime::new(spread)?;
                return Ok(factors.map(|f| SpreadFactors::Time(Box::new(f))));
            }
            Preconditioner::BodyCirculant => Joints::Exact,
            Preconditioner::Circulant => Joints::Averaged,
        };
        let factors = SpreadHarmonics::new(spread, joints)?;
        Ok(factors.map(|f| SpreadFactors::Harmonics(Box::new(f))))
    }

    /// Whether stress resultants are unknowns of their own.
    pub fn keeps_resultants(which: Preconditioner) -> bool {
        which != Preconditioner::TimeLocal
    }

    /// `x = P⁻¹ x`, where `x` is a vector of the part with stress resultants, if any, behind. By
    /// all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told.
    pub fn apply(&mut self, x: &mut [f64], halo: &mut Halo) -> Result<()> {
        match self {
            SpreadFactors::Time(factors) => factors.apply(x),
            SpreadFactors::Harmonics(factors) => factors.apply(x, halo),
        }
    }

    /// Sets the size of stress resultants.
    pub fn set_resultant_scale(&mut self, scale: f64) {
        if let SpreadFactors::Harmonics(factors) = self {
            factors.set_resultant_scale(scale);
        }
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        match self {
            SpreadFactors::Time(factors) => factors.bytes(),
            SpreadFactors::Harmonics(factors) => factors.bytes(),
        }
    }
}
