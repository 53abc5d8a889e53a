//! Strains and internal forces of beams.

use super::solution::{Samples, Solution};
use crate::elements::Beam;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::PeriodicSeries;

/// What can be asked of a beam element at a station; components along the section's axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamQuantity {
    /// `[axial, shear 2, shear 3]` strains and `[torsion, bending 2, bending 3]` curvatures.
    Strain,
    /// `[axial, shear 2, shear 3]` forces and `[torsion, bending 2, bending 3]` moments.
    Force,
}

impl Solution {
    pub(super) fn beam_definition(&self, element: usize, station: f64) -> Result<&Beam> {
        require_finite("station", &[station])?;
        if !(-1.0..=1.0).contains(&station) {
            return Err(Error::value("station", "a number from −1 to 1", station));
        }
        self.model.beams.get(element).ok_or_else(|| {
            let count = self.model.beams.len();
            let message =
                format!("element: expected a beam element id below {count}, got {element}");
            Error::new(ErrorKind::Identifier, message)
        })
    }

    /// A quantity at `station` in `[−1, 1]` of a beam element, at `times`; six components of each
    /// time together.
    ///
    /// # Errors
    /// An unknown element, or a station outside it.
    pub fn beam(
        &self,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
        times: &[f64],
    ) -> Result<Vec<f64>> {
        let samples = self.beam_samples(element, station, quantity)?;
        Self::finite("beam", self.sample(&samples, times)?)
    }

    /// Fourier series of the six components of a quantity at a station of a beam element.
    ///
    /// # Errors
    /// An unknown element, or a station outside it.
    pub fn beam_series(
        &self,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
    ) -> Result<Vec<PeriodicSeries>> {
        self.series(&self.beam_samples(element, station, quantity)?)
    }

    fn beam_samples(
        &self,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
    ) -> Result<Samples> {
        let beam = self.beam_definition(element, station)?;
        self.samples_of(6, |k| {
            let states = self.states_of(beam, k);
            let motions: Vec<_> = states.iter().map(|s| s.motion).collect();
            let twists: Vec<_> = states.iter().map(|s| s.twist).collect();
            let (strain, force) = beam.strain_and_stress(station, &motions, &twists)?;
            Ok(match quantity {
                BeamQuantity::Strain => strain.as_slice().to_vec(),
                BeamQuantity::Force => force.as_slice().to_vec(),
            })
        })
    }
}
