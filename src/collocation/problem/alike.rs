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

    /// Writes what the last linearisation found left of the equations of the whole, not scaled, of
    /// which what leads is there; forgets it where all else does not follow.
    pub(crate) fn complete_linearised_residual(&mut self) {
        let mut rows = std::mem::take(&mut self.linearised_residual);
        let Some(leaders) = self.leaders.clone().filter(|l| l.knows_own(&self.system)) else {
            return;
        };
        if rows.len() == self.size() {
            let (layout, elements) = (self.layout, self.system.elements());
            leaders.repeat_forces(|node, k| layout.motion(node, k).start, &mut rows);
            leaders.repeat_own(|e, k| layout.element_at(&elements[e], k).start, &mut rows);
            self.linearised_residual = rows;
        }
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

    /// The state after the fraction `step` of an increment of all unknowns; where states are taken
    /// for alike, that of what leads tells it.
    pub(crate) fn stepped(&self, state: &GridState, increment: &[f64], step: f64) -> GridState {
        let (here, change) = ((&*self.system, self.workers()), (increment, step));
        let Some(leaders) = &self.leaders else {
            return state.incremented_some(here, change, &|_| state.points(), |_| ());
        };
        let points_of = |node: usize| leaders.points_of(node, state.points());
        state.incremented_some(here, change, &points_of, |motions| {
            leaders.repeat_motions(motions);
        })
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
    /// Of what is a matter of motions alone, what tells followers apart shows at some times as it
    /// does at others: each is looked at at its share of the grid points there.
    pub(crate) fn unlike(
        &mut self,
        leaders: &Arc<Leaders>,
        state: &GridState,
        out: &mut [f64],
    ) -> Result<()> {
        self.ensure_kinematics(Some(leaders.clone()), state);
        let (system, layout) = (self.system.clone(), self.layout);
        let looks_at_all = system.calls_functions() || !self.instants.is_gravity_constant();
        let is_by_motions = |element: usize| !looks_at_all && leaders.is_by_motions(element);
        let (elements, size) = (system.elements(), self.size());
        let place = |node: usize, k: usize| layout.motion(node, k).start;
        let (mut rows, mut alike) = (vec![0.0; size], vec![0.0; size]);
        self.forces_where(state, &mut rows, &|element, _| !is_by_motions(element))?;
        alike.copy_from_slice(&rows);
        leaders.repeat_forces(place, &mut alike);
        leaders.repeat_own(|e, k| layout.element_at(&elements[e], k).start, &mut alike);
        out.fill(0.0);
        let all = out.iter_mut().zip(&rows).zip(&alike);
        all.for_each(|((out, row), alike)| *out = row - alike);
        if !looks_at_all {
            self.forces_where(state, &mut rows, &|element, k| {
                let mut nodes = elements[element].element.nodes().iter();
                is_by_motions(element) && nodes.any(|&node| leaders.stands_for(node, k) > 0)
            })?;
            alike.copy_from_slice(&rows);
            leaders.repeat_forces(place, &mut alike);
            for node in 0..system.nodes() {
                for k in 0..layout.points() {
                    let count = leaders.stands_for(node, k) as f64;
                    for i in layout.motion(node, k) {
                        out[i] += count * (rows[i] - alike[i]);
                    }
                }
            }
        }
        let scaled = out.iter_mut().zip(&self.row_scale);
        scaled.for_each(|(out, scale)| *out *= scale);
        Ok(())
    }

    /// Takes from unknowns what is not alike, if motions have to be.
    pub fn project(&self, unknowns: &mut [f64]) {
        if let Some(alike) = &self.alike {
            alike.project(self.layout, self.system.elements(), unknowns);
        }
    }

    /// Lets unknowns of hub and supports be what the first part of the period says, if motions have
    /// to be alike.
    pub(crate) fn repeat_unknowns(&self, unknowns: &mut [f64]) {
        if let Some(alike) = &self.alike {
            alike.repeat_unknowns(self.layout, self.system.elements(), unknowns);
        }
    }

    /// The same of the equations.
    pub(crate) fn repeat_equations(&self, rows: &mut [f64]) {
        if let Some(alike) = &self.alike {
            alike.repeat_equations(self.layout, self.system.elements(), rows);
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
