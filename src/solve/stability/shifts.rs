//! Modes that are motions of the solution in time or of all nodes in space, of multiplier 1.
//! See docs/theory.md, section 12.4.

use crate::error::Result;
use crate::memory;
use crate::solve::linear::dense::decomposed;
use crate::solve::result::Solved;
use crate::solve::stability::period_map::PeriodMap;
use nalgebra::{Complex, DMatrix, Vector6};

/// Share of a mode outside such motions of one that is such a motion.
const OUTSIDE: f64 = 1e-4;
/// Size of a direction that is none.
const FLAT: f64 = 1e-9;

/// Motions of the solution in time and of all nodes in space.
pub(super) struct Shifts {
    /// Orthonormal columns that velocities, three displacements and three turns are made of; of all
    /// nodes at the ends of all steps.
    directions: DMatrix<f64>,
    nodes: usize,
}

impl Shifts {
    pub(super) fn new(map: &PeriodMap, solve: &Solved) -> Result<Self> {
        let (nodes, steps) = (solve.system.nodes(), map.steps());
        let length = solve.system.scales().length;
        let scaled =
            |u: &Vector6<f64>| Vector6::from_fn(|i, _| u[i] / if i < 3 { length } else { 1.0 });
        // The basis, its decomposition, and modes beside it.
        let entries = (3 * 7 + 2) * 6 * nodes * steps;
        memory::require_items("modes over the period", entries, size_of::<f64>())?;
        let mut basis = DMatrix::zeros(6 * nodes * steps, 7);
        for step in 0..steps {
            for node in 0..nodes {
                let state = map.end(step, node);
                let row = 6 * (step * nodes + node);
                let velocity = scaled(&state.twist);
                basis.fixed_view_mut::<6, 1>(row, 0).copy_from(&velocity);
                let carried = state.motion.inverse().adjoint();
                for component in 0..6 {
                    let unit = if component < 3 { length } else { 1.0 };
                    let moved = scaled(&(carried.column(component) * unit));
                    basis
                        .fixed_view_mut::<6, 1>(row, 1 + component)
                        .copy_from(&moved);
                }
            }
        }
        for mut column in basis.column_iter_mut() {
            let size = column.norm();
            if size > 0.0 {
                column /= size;
            }
        }
        let none = DMatrix::zeros(basis.nrows(), 0);
        let directions = decomposed(basis).and_then(|found| {
            let sizes = found.singular_values.iter().enumerate();
            let kept: Vec<usize> = sizes.filter(|s| *s.1 > FLAT).map(|s| s.0).collect();
            Some(found.u?.select_columns(&kept))
        });
        Ok(Shifts {
            directions: directions.unwrap_or(none),
            nodes,
        })
    }

    /// Whether a mode, given by its disturbances at the ends of all steps, is such a motion.
    pub(super) fn contain(&self, disturbances: impl Iterator<Item = Vec<Complex<f64>>>) -> bool {
        let rows = 6 * self.nodes;
        let mut mode = DMatrix::zeros(self.directions.nrows(), 2);
        for (step, all) in disturbances.enumerate() {
            for (i, x) in all.iter().enumerate() {
                mode[(step * rows + i, 0)] = x.re;
                mode[(step * rows + i, 1)] = x.im;
            }
        }
        let size = mode.norm();
        let parts = self.directions.tr_mul(&mode);
        mode -= &self.directions * parts;
        mode.norm() / size < OUTSIDE
    }
}
