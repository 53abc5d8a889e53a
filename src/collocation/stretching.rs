//! Stretching between grid points.
//!
//! Slender beams that bend from one grid point to the next are stretched in between, by terms of
//! second order, and what axial stiffness makes of that is much larger than all else that is left
//! of the equations there. Tiny motions along the beams undo it. At the grid points, where the
//! beams lie otherwise, the same forces would bend them; so it is stress resultants that are
//! carried there.

use super::between::{Defect, PART};
use super::problem::Collocation;
use super::state::GridState;
use crate::elements::NodeState;
use crate::error::Result;
use nalgebra::Vector6;

impl Defect {
    /// Lets what stress resultants are more than those interpolated act on the beams as they are at
    /// the grid points before. Kinematics of `equations` become those of `state`.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn carry_resultants(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
    ) -> Result<()> {
        let (grid, system) = (equations.grid(), equations.system().clone());
        let (points, stations) = (grid.points(), system.stations());
        let start = PART / points as f64;
        let mut excess = equations.resampled_resultants(state, start, grid)?;
        if excess.is_empty() {
            return Ok(());
        }
        let (between, at) = (&self.nodes.states, equations.node_states());
        let mut instants: Vec<(&mut [f64], &mut [Vector6<f64>])> = self
            .rows
            .chunks_exact_mut(self.count)
            .zip(excess.chunks_exact_mut(stations))
            .collect();
        let workers = equations.workers();
        workers.try_for_each(
            &mut instants,
            &mut Vec::new(),
            || (system.workspace(false), Vec::new(), Vec::new()),
            |(workspace, nodes, still), k, (rows, excess)| {
                for placed in system.elements() {
                    let excess = &mut excess[placed.stations.clone()];
                    if excess.is_empty() {
                        continue;
                    }
                    let state = |states: &[NodeState], node: usize| states[node * points + k];
                    nodes.clear();
                    nodes.extend(placed.element.nodes().iter().map(|&a| state(between, a)));
                    still.clear();
                    still.resize(nodes.len(), [Vector6::zeros(); 2]);
                    let mut found = vec![Vector6::zeros(); excess.len()];
                    placed
                        .element
                        .extrapolate_resultants(nodes, still, &mut found)?;
                    for (excess, found) in excess.iter_mut().zip(found) {
                        *excess = found - *excess;
                    }
                    for (states, sign) in [(between.as_slice(), -1.0), (at, 1.0)] {
                        let seen = |node: usize| state(states, node);
                        let out = system.forces_of_resultants(placed, seen, excess, workspace)?;
                        let forces = out.force.as_slice().chunks_exact(6);
                        for (&node, force) in placed.element.nodes().iter().zip(forces) {
                            for (row, f) in rows[6 * node..][..6].iter_mut().zip(force) {
                                *row += sign * f;
                            }
                        }
                    }
                }
                Ok(())
            },
        )
    }
}
