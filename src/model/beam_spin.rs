//! Beams whose material spins about their axis in the frames of their nodes.

use super::spin::{asymmetry, is_symmetric};
use super::validation::require_elements;
use super::{BeamDefinition, Model};
use crate::error::{Error, ErrorKind, Result, require_finite};
use nalgebra::Vector3;

/// How far a beam may be from a straight one: as nodes that are given with 9 digits.
const STRAIGHT: f64 = 1e-8;

impl Model {
    /// Lets the material of beam elements spin about their axis, axis 1 of their sections, at a
    /// constant `rate` relative to their nodes, which do not spin along. Damping then acts on the
    /// rates of strains that the material sees.
    ///
    /// # Errors
    /// If there are no such elements, one is not straight, or has a section that is not symmetric
    /// about the axis, or if `rate` is not finite.
    pub fn set_beam_spin(
        &mut self,
        first_element: usize,
        elements: usize,
        rate: f64,
    ) -> Result<()> {
        let count = self.beams.len();
        require_elements("beam element", count, (first_element, elements))?;
        require_finite("rate", &[rate])?;
        let range = first_element..first_element + elements;
        for element in range.clone().filter(|_| rate != 0.0) {
            let spinning = BeamDefinition {
                spin: rate,
                ..self.beams[element].clone()
            };
            self.require_can_spin(&spinning)
                .map_err(|e| e.within(format!("beam element {element}")))?;
        }
        for beam in &mut self.beams[range] {
            beam.spin = rate;
        }
        Ok(())
    }

    /// Checks that the material of a beam element can spin as it is said to, if it is.
    pub(super) fn require_beam_can_spin(&self, element: usize) -> Result<()> {
        let beam = &self.beams[element];
        match beam.spin == 0.0 {
            true => Ok(()),
            false => self.require_can_spin(beam),
        }
    }

    /// The same of any beam over the nodes, whether it spins or not.
    pub(super) fn require_can_spin(&self, beam: &BeamDefinition) -> Result<()> {
        let refuse = |expected: &str, off: f64| {
            let message = format!("expected {expected}, as it spins; it is off by {off:.3e}");
            Err(Error::new(ErrorKind::Value, message))
        };
        let element = self.element_of(beam)?;
        let off = element.curvedness();
        if off > STRAIGHT {
            return refuse("a straight beam with axis 1 of its nodes along it", off);
        }
        let sections = beam.sections.all();
        for part in sections.flat_map(|section| [section.stiffness, section.mass, section.damping])
        {
            let off = asymmetry(&part, &Vector3::x(), &part);
            if !is_symmetric(off) {
                return refuse("sections that are symmetric about axis 1", off);
            }
        }
        if element.has_mass() {
            element.inertia()?.require_finite()?;
        }
        element.require_finite()
    }
}
