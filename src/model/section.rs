//! Cross-sections as the user gives them.

use super::validation::{require_positive, smallest_scaled_eigenvalue};
use crate::elements::Section;
use crate::error::{Error, Result, require_finite};
use nalgebra::{Matrix6, Vector6};

/// Cross-section matrices as the user gives them, to be checked.
#[derive(Debug, Clone, Copy)]
pub struct SectionInput {
    /// Stiffness, symmetric and positive definite.
    pub stiffness: Matrix6<f64>,
    /// Mass, symmetric and positive semi-definite.
    pub mass: Matrix6<f64>,
    /// Damping, whose symmetric part is positive semi-definite.
    pub damping: Matrix6<f64>,
}

/// Checks a damping matrix, which may be unsymmetric (as stiffness times a matrix of times is for
/// coupled sections): whatever the rates, it must not add energy.
fn require_dissipating(name: &str, m: &Matrix6<f64>) -> Result<Matrix6<f64>> {
    require_finite(name, m.as_slice())?;
    let symmetric = 0.5 * (m + m.transpose());
    let smallest = smallest_scaled_eigenvalue(&symmetric);
    if smallest < -1e-9 {
        return Err(Error::value(
            name,
            "a matrix whose symmetric part is positive semi-definite, so that no motion gains \
             energy",
            format!("one whose symmetric part has the scaled eigenvalue {smallest:.3e}"),
        ));
    }
    Ok(*m)
}

impl SectionInput {
    /// A section without couplings or damping: the six stiffnesses in their order, mass per length,
    /// and moments of inertia per length about axes 1, 2, 3.
    pub fn diagonal(stiffness: &[f64; 6], mass: &[f64; 4]) -> Result<Self> {
        require_finite("stiffness", stiffness)?;
        require_finite("mass", mass)?;
        if let Some(i) = stiffness.iter().position(|&k| k <= 0.0) {
            let name = format!("stiffness[{i}]");
            return Err(Error::value(&name, "a positive number", stiffness[i]));
        }
        if let Some(i) = mass.iter().position(|&m| m < 0.0) {
            let name = format!("mass[{i}]");
            return Err(Error::value(&name, "zero or more", mass[i]));
        }
        let [m, m11, m22, m33] = *mass;
        Ok(SectionInput {
            stiffness: Matrix6::from_diagonal(&Vector6::from(*stiffness)),
            mass: Matrix6::from_diagonal(&Vector6::new(m, m, m, m11, m22, m33)),
            damping: Matrix6::zeros(),
        })
    }

    /// Makes the damping `seconds` times the stiffness, which must have been set.
    pub fn damp_proportionally(&mut self, seconds: f64) -> Result<()> {
        require_finite("seconds", &[seconds])?;
        if seconds < 0.0 {
            return Err(Error::value("seconds", "zero or more", seconds));
        }
        self.damping = require_positive("section stiffness", &self.stiffness, true)? * seconds;
        Ok(())
    }

    /// Makes the damping `diag(seconds) 𝒦`, with one time for each resultant, as BeamDyn has it;
    /// the stiffness must have been set.
    ///
    /// # Errors
    /// If times are negative, or so different that a coupled section would gain energy in some
    /// motion.
    pub fn damp_by_component(&mut self, seconds: &[f64; 6]) -> Result<()> {
        require_finite("seconds", seconds)?;
        if let Some(i) = seconds.iter().position(|&time| time < 0.0) {
            let name = format!("seconds[{i}]");
            return Err(Error::value(&name, "zero or more", seconds[i]));
        }
        let stiffness = require_positive("section stiffness", &self.stiffness, true)?;
        let times = Matrix6::from_diagonal(&Vector6::from(*seconds));
        self.damping = require_dissipating("section damping", &(times * stiffness))?;
        Ok(())
    }

    pub(super) fn validated(&self) -> Result<Section> {
        Ok(Section {
            stiffness: require_positive("section stiffness", &self.stiffness, true)?,
            mass: require_positive("section mass", &self.mass, false)?,
            damping: require_dissipating("section damping", &self.damping)?,
        })
    }
}
