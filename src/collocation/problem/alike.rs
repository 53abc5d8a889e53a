//! Equations of one blade of several: hub and supports may only move alike (docs/theory.md, section
//! 8.10).

use super::Collocation;
use crate::collocation::like_blades::{AlikeMotions, Leaders};
use crate::collocation::state::GridState;
use crate::error::Result;
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

    /// Grid points, from the first on, that tell what acts between these nodes, and what it counts
    /// there: on supports those of a part of the period, for all parts.
    pub(crate) fn told(&self, nodes: &[usize]) -> (usize, f64) {
        let points = self.layout.points();
        let alike = self.alike.as_ref();
        alike.map_or((points, 1.0), |alike| alike.told(nodes, points))
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

    /// Evaluates velocities and accelerations at a state, of all nodes from these leaders.
    pub(crate) fn update_kinematics_by(
        &mut self,
        leaders: Option<Arc<Leaders>>,
        state: &GridState,
    ) {
        let before = self.set_leaders(leaders);
        self.update_kinematics(state);
        self.set_leaders(before);
    }

    /// Writes by how much the scaled equations differ from those that follow from what leads, in a
    /// state in which blades move alike.
    ///
    /// Where nothing but their motions acts on followers, what tells them apart shows at some times
    /// as it does at others: each is looked at at its share of the grid points there.
    pub(crate) fn unlike(
        &mut self,
        leaders: &Arc<Leaders>,
        state: &GridState,
        out: &mut [f64],
    ) -> Result<()> {
        self.update_kinematics_by(Some(leaders.clone()), state);
        let (system, layout) = (self.system.clone(), self.layout);
        let looks_at_all = system.calls_functions() || !self.instants.is_gravity_constant();
        let stands_for = |node: usize, k: usize| match looks_at_all {
            true => 1,
            false => leaders.stands_for(node, k),
        };
        let mut rows = vec![0.0; self.size()];
        self.forces_where(state, &mut rows, &|element, k| {
            let element = &system.elements()[element].element;
            let mut nodes = element.nodes().iter();
            element.own_unknowns() > 0 || nodes.any(|&node| stands_for(node, k) > 0)
        })?;
        let elements = system.elements();
        out.fill(0.0);
        let out = &mut out[..rows.len()];
        out.copy_from_slice(&rows);
        leaders.repeat_forces(|node, k| layout.motion(node, k).start, out);
        leaders.repeat_own(|e, k| layout.element_at(&elements[e], k).start, out);
        let all = out.iter_mut().zip(&rows).zip(&self.row_scale);
        all.for_each(|((out, row), scale)| *out = (row - *out) * scale);
        for node in 0..system.nodes() {
            for k in 0..layout.points() {
                let count = stands_for(node, k) as f64;
                let rows = &mut out[layout.motion(node, k)];
                rows.iter_mut().for_each(|row| *row *= count);
            }
        }
        Ok(())
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
