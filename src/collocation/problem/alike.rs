//! Equations of one blade of several: hub and supports may only move alike (docs/theory.md, section
//! 8.10).

use super::Collocation;
use crate::collocation::like_blades::AlikeMotions;

impl Collocation {
    /// Lets some nodes move alike only.
    pub(in crate::collocation) fn set_alike(&mut self, alike: AlikeMotions) {
        self.alike = Some(alike);
    }

    /// How the nodes of hub and supports have to move, if these are equations of one blade.
    pub fn alike(&self) -> Option<&AlikeMotions> {
        self.alike.as_ref()
    }

    /// Takes from the forces on nodes what does no work on motions that are alike, if they have to
    /// be.
    pub fn average(&self, forces: &mut [f64]) {
        if let Some(alike) = &self.alike {
            alike.average(self.layout, forces);
        }
    }
}
