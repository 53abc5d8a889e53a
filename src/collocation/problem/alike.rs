//! Equations of one blade of several: hub and supports may only move alike (docs/theory.md, section
//! 8.10).

use super::Collocation;
use crate::collocation::like_blades::{AlikeMotions, Leaders};
use std::sync::Arc;

impl Collocation {
    /// Lets some nodes move alike only.
    pub(in crate::collocation) fn set_alike(&mut self, alike: AlikeMotions) {
        self.alike = Some(alike);
    }

    /// How the nodes of hub and supports have to move, if these are equations of one blade.
    pub fn alike(&self) -> Option<&AlikeMotions> {
        self.alike.as_ref()
    }

    /// From now on takes states for alike at all blades: residuals are found from what leads. Gives
    /// what was said before.
    pub(crate) fn set_leaders(&mut self, leaders: Option<Arc<Leaders>>) -> Option<Arc<Leaders>> {
        std::mem::replace(&mut self.leaders, leaders)
    }

    /// What leads, where states are taken for alike.
    pub(in crate::collocation) fn leaders(&self) -> Option<&Arc<Leaders>> {
        self.leaders.as_ref()
    }

    /// Writes by how much a scaled residual differs from one in which all forces follow from those
    /// on what leads.
    pub(crate) fn unlike(&self, leaders: &Leaders, residual: &[f64], out: &mut [f64]) {
        let pairs = out.iter_mut().zip(residual).zip(&self.row_scale);
        pairs.for_each(|((out, row), scale)| *out = row / scale);
        leaders.repeat_forces(|node, k| self.layout.motion(node, k).start, out);
        let pairs = out.iter_mut().zip(residual).zip(&self.row_scale);
        pairs.for_each(|((out, row), scale)| *out = row - *out * scale);
    }

    /// Takes from unknowns what is not alike, if motions have to be.
    pub fn project(&self, unknowns: &mut [f64]) {
        if let Some(alike) = &self.alike {
            alike.project(self.layout, self.system.elements(), unknowns);
        }
    }

    /// Takes from the forces on nodes what does no work on motions that are alike, if they have to
    /// be.
    pub fn average(&self, forces: &mut [f64]) {
        if let Some(alike) = &self.alike {
            alike.average(self.layout, forces);
        }
    }
}
