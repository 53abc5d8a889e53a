//! Bushings and bearings between two bodies.

use super::validation::require_two_bodies;
use crate::elements::{Attachment, Bushing, BushingAngles};
use crate::error::{Error, Result, require_finite};
use nalgebra::Matrix6;
use serde::{Deserialize, Serialize};

/// Efforts `K e + C ė` against the deformation `e` between two frames, see
/// [`crate::elements::Bushing`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct BushingDefinition {
    /// The frame on the first body, along whose axes it measures.
    pub first: Attachment,
    /// The frame on the second.
    pub second: Attachment,
    /// `K`.
    pub stiffness: Matrix6<f64>,
    /// `C`.
    pub damping: Matrix6<f64>,
    /// How it measures rotations.
    pub angles: BushingAngles,
    /// Factors of stiffness and damping.
    pub factors: [f64; 2],
}

impl BushingDefinition {
    /// The element.
    pub(crate) fn element(&self) -> Bushing {
        Bushing::new(self.first, self.second, self.scaled(), self.angles)
    }

    /// The matrices times their factors.
    pub(super) fn scaled(&self) -> [Matrix6<f64>; 2] {
        let [stiffness, damping] = self.factors;
        [self.stiffness * stiffness, self.damping * damping]
    }

    pub(super) fn require_valid(&self) -> Result<()> {
        require_two_bodies(self.first.node, self.second.node)?;
        require_finite("stiffness", self.stiffness.as_slice())?;
        require_finite("damping", self.damping.as_slice())?;
        self.require_scaled()?;
        let spin = self.stiffness.column(5);
        if self.angles == BushingAngles::TiltAndSpin && spin.iter().any(|&k| k != 0.0) {
            let expected = "zeros in the last column, as the spin itself does not count";
            return Err(Error::value("stiffness", expected, spin.amax()));
        }
        Ok(())
    }

    /// Checks that the matrices times their factors are numbers.
    pub(super) fn require_scaled(&self) -> Result<()> {
        let [stiffness, damping] = self.scaled();
        require_finite("stiffness times its factor", stiffness.as_slice())?;
        require_finite("damping times its factor", damping.as_slice())
    }
}
