//! A preconditioner for slow mechanisms, and for heavily constrained ones: equilibrium at each grid point by
//! itself, without inertia.

use super::block_lu::BlockLanes;
use super::constraints::{Class, classify_at};
use super::lanes::{LANES, Lanes, RealLanes};
use super::layout::Layout;
use crate::collocation::{Collocation, Tangent};

/// The preconditioner, factored.
pub(super) struct TimeLocal {
    points: usize,
    layout: Layout,
    factors: Vec<BlockLanes<RealLanes>>,
    lanes: Vec<RealLanes>,
    scratch: Vec<RealLanes>,
}

impl TimeLocal {
    /// Factors the static part of the Jacobian `tangent`. None if it is singular.
    pub fn new(equations: &Collocation, tangent: &Tangent) -> Option<Self> {
        let points = equations.grid().points();
        let layout = Layout::new(equations, tangent, &classify_at(equations, tangent, 0));
        let mut factors = Vec::new();
        for first in (0..points).step_by(LANES) {
            let mut lanes = BlockLanes::<RealLanes>::new(&layout.structure);
            for lane in 0..LANES {
                let k = (first + lane).min(points - 1);
                fill(&mut lanes, lane, &layout, equations, tangent, k);
            }
            if !lanes.factor(&layout.structure) {
                return None;
            }
            factors.push(lanes);
        }
        Some(TimeLocal {
            points,
            lanes: vec![RealLanes::zero(); layout.structure.unknowns()],
            scratch: Vec::new(),
            layout,
            factors,
        })
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        size_of::<RealLanes>() * self.layout.structure.entries() * self.factors.len()
    }

    /// `x = P⁻¹ x`.
    pub fn apply(&mut self, x: &mut [f64]) {
        for (chunk, factors) in self.factors.iter().enumerate() {
            let at = |lane: usize| (LANES * chunk + lane).min(self.points - 1);
            for (lanes, &(first, stride)) in self.lanes.iter_mut().zip(&self.layout.places) {
                (0..LANES).for_each(|lane| lanes.set(lane, x[first + stride * at(lane)]));
            }
            factors.forward(&self.layout.structure, &mut self.lanes);
            factors.backward(&self.layout.structure, &mut self.lanes, &mut self.scratch);
            for (lanes, &(first, stride)) in self.lanes.iter().zip(&self.layout.places) {
                for lane in 0..LANES.min(self.points - LANES * chunk) {
                    x[first + stride * at(lane)] = lanes.get(lane);
                }
            }
        }
    }
}

/// Writes the matrix of grid point `k`.
fn fill(
    lanes: &mut BlockLanes<RealLanes>,
    lane: usize,
    layout: &Layout,
    equations: &Collocation,
    tangent: &Tangent,
    k: usize,
) {
    let system = equations.system();
    let points = equations.grid().points();
    let mut add = |at: ((usize, usize), (usize, usize)), (i, j), value: f64| {
        let ((row, first_row), (column, first_column)) = at;
        let place = (first_row + i, first_column + j);
        let entry = lanes.at(layout.structure.entry((row, column), place));
        entry.set(lane, entry.get(lane) + value);
    };
    for (pair, coupling) in tangent.couplings().iter().enumerate() {
        let stiffness = &tangent.pair(pair, k).stiffness;
        let row_scale = &equations.row_scale()[6 * points * coupling.row..];
        let column_scale = &equations.column_scale()[6 * points * coupling.column..];
        let at = (
            layout.node_at[coupling.row],
            layout.node_at[coupling.column],
        );
        for i in 0..6 {
            for j in 0..6 {
                add(
                    at,
                    (i, j),
                    stiffness[(i, j)] * row_scale[i] * column_scale[j],
                );
            }
        }
    }
    for (index, class) in classify_at(equations, tangent, k).iter().enumerate() {
        let Class::Averaged(own) = class else {
            continue;
        };
        let placed = &system.elements()[index];
        let at = layout.own_at[index];
        for (local, &node) in placed.element.nodes().iter().enumerate() {
            for row in 0..own.gradient.nrows() {
                for component in 0..6 {
                    let g = own.gradient[(row, 6 * local + component)];
                    add((at, layout.node_at[node]), (row, component), g);
                    add((layout.node_at[node], at), (component, row), g);
                }
            }
        }
        let count = own.gradient.nrows();
        if placed.has_states {
            let first = super::layout::own_first(equations, index);
            let (stiffness, _) = tangent.own(system, index, k);
            for column in 0..count {
                for row in 0..count {
                    let scale = equations.row_scale()[first + row]
                        * equations.column_scale()[first + column];
                    add(
                        (at, at),
                        (row, column),
                        stiffness[column * count + row] * scale,
                    );
                }
            }
        } else {
            (0..count).for_each(|i| add((at, at), (i, i), -equations.regularisation()));
        }
    }
}
