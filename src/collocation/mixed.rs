//! Stress resultants as unknowns of their own along a step of Newton's method
//! (docs/theory.md, section 7.3).

use super::problem::Collocation;
use super::state::GridState;
use crate::elements::NodeState;
use crate::error::Result;
use nalgebra::Vector6;

/// Stress resultants that go linearly along an increment of the motions, as its linearised
/// equations have them.
#[derive(Debug)]
pub struct ResultantPath {
    /// At its start, at all stations of grid point 0, then of grid point 1 and so on.
    start: Vec<Vector6<f64>>,
    end: Vec<Vector6<f64>>,
    /// The nodes at its start.
    nodes: Vec<NodeState>,
}

impl ResultantPath {
    /// At this part of the increment.
    pub fn at(&self, part: f64) -> Vec<Vector6<f64>> {
        let ends = self.start.iter().zip(&self.end);
        ends.map(|(start, end)| start + (end - start) * part)
            .collect()
    }
}

impl Collocation {
    /// Whether stress resultants of beams may be unknowns of their own.
    pub fn has_stations(&self) -> bool {
        self.system().stations() > 0 && self.oversampled().is_none()
    }

    /// Stress resultants along an unscaled increment from `state`, that begin with those of the
    /// geometric stiffness there.
    fn resultants_along(&mut self, state: &GridState, increment: &[f64]) -> Result<ResultantPath> {
        let end = self.extrapolated_resultants(state, increment)?;
        let start = match self.has_resultants() {
            true => self.instants.resultants.clone(),
            false => self.extrapolated_resultants(state, &vec![0.0; self.size()])?,
        };
        Ok(ResultantPath {
            start,
            end,
            nodes: self.node_states().to_vec(),
        })
    }

    /// Makes of the scaled residual at `trial`, after this part of the increment, the one with
    /// stress resultants as unknowns of their own, without what their equations leave:
    /// with strains `e` that miss the resultants `σ` by `K e - σ`, forces `B₁ᵀ K e` become
    /// `B₁ᵀ σ + B₀ᵀ (K e - σ)`, where `B₀` is of the start and `B₁` of the trial. The path is that
    /// from the start by the increment, and found at the first call.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn part_resultants(
        &mut self,
        path: &mut Option<ResultantPath>,
        (start, increment): (&GridState, &[f64]),
        (trial, part): (&GridState, f64),
        residual: &mut [f64],
    ) -> Result<()> {
        let path = match path {
            Some(path) => path,
            None => path.insert(self.resultants_along(start, increment)?),
        };
        let (points, stations) = (self.grid().points(), self.system().stations());
        let mut excess = self.extrapolated_resultants(trial, &vec![0.0; self.size()])?;
        let ends = path.start.iter().zip(&path.end);
        for (excess, (start, end)) in excess.iter_mut().zip(ends) {
            *excess -= start + (end - start) * part;
        }
        let system = self.system().clone();
        let mut workspace = system.workspace(false);
        for (k, excess) in excess.chunks_exact(stations).enumerate() {
            for placed in system.elements() {
                let excess = &excess[placed.stations.clone()];
                if excess.is_empty() {
                    continue;
                }
                for (nodes, sign) in [(self.node_states(), -1.0), (&path.nodes[..], 1.0)] {
                    let seen = |node: usize| nodes[node * points + k];
                    let out = system.forces_of_resultants(placed, seen, excess, &mut workspace)?;
                    let forces = out.force.as_slice().chunks_exact(6);
                    for (&node, force) in placed.element.nodes().iter().zip(forces) {
                        let rows = self.layout().motion(node, k);
                        let scales = &self.row_scale[rows.clone()];
                        let rows = residual[rows].iter_mut().zip(scales);
                        for ((row, scale), f) in rows.zip(force) {
                            *row += sign * scale * f;
                        }
                    }
                }
            }
        }
        Ok(())
    }
}
