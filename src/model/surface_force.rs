//! Forces by functions of the user on the surfaces and edges of shells, and along beams.

use super::{ForceDefinition, Model, UserFunction};
use crate::elements::{ForcePlace, SurfaceForce, SurfaceForceLaw};
use crate::error::Result;

impl Model {
    /// Adds forces that a user's function computes at points of the surface, or an edge, of shell
    /// elements, or of the line of beam elements: a force for each of `elements` from
    /// `first_element` on. Returns the id of the first; the others follow.
    ///
    /// # Errors
    /// If the elements or the edge do not exist; if the direction of an untwisted beam is along it
    /// somewhere.
    pub fn add_surface_forces(
        &mut self,
        first_element: usize,
        elements: usize,
        place: impl Into<ForcePlace>,
        law: SurfaceForceLaw,
    ) -> Result<usize> {
        let place = place.into();
        self.require_force_place((first_element, elements), place)?;
        let first = self.forces.len();
        for element in first_element..first_element + elements {
            self.forces.push(ForceDefinition::SurfaceForces {
                element,
                place,
                law: UserFunction::new(law.clone()),
                cycles: 0,
            });
        }
        Ok(first)
    }

    /// Checks that there are so many elements, from the first on, with such a place.
    pub(crate) fn require_force_place(
        &self,
        elements: (usize, usize),
        place: ForcePlace,
    ) -> Result<()> {
        match place.on_shell() {
            Some(place) => self.require_shell_place(elements, place),
            None => self.require_beam_axes(elements, place.axes_on_beam()),
        }
    }

    /// The element of a user's forces on an element; motions are of the order of a length, at a
    /// circular frequency.
    pub(crate) fn surface_force(
        &self,
        (element, place): (usize, ForcePlace),
        law: &SurfaceForceLaw,
        sizes: [f64; 2],
    ) -> Result<SurfaceForce> {
        let law = law.clone();
        match place.on_shell() {
            Some(place) => {
                let shell = self.shell_of(&self.shells[element])?;
                SurfaceForce::on_shell((element, &shell), place, law, sizes)
            }
            None => {
                let beam = self.beam_element(element)?;
                SurfaceForce::along_beam((element, &beam), place, law, sizes)
            }
        }
    }
}
