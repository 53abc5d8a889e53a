//! What harmonics of hub and supports may be, in the averaged matrices of one blade of several
//! (docs/theory.md, section 8.10).

use super::block_lu::{BlockLanes, BlockPlace};
use super::constraints::{Average, Class};
use super::lanes::{ComplexLanes, Lanes};
use super::mean::Averages;
use crate::collocation::AlikeMotions;
use crate::system::Placed;
use nalgebra::{Complex, DMatrix};

/// How stiffly what motions may not do is held, relative to the largest entry of all.
const HELD: f64 = 1.0;

impl Averages<'_> {
    /// Leaves of hub and supports the motions and constraints that a harmonic may have, `Πᴴ A Π`,
    /// and holds the others, by `1 − Π`.
    pub(super) fn project(
        &self,
        alike: &AlikeMotions,
        lanes: &mut BlockLanes<ComplexLanes>,
        lane: usize,
        harmonic: usize,
    ) {
        let of_node = |node: usize| {
            let step = alike.of_node(node)?.forth.as_slice();
            let step = DMatrix::from_column_slice(6, 6, step);
            Some(alike.projection(&step, harmonic))
        };
        let structure = &self.layout.structure;
        let mut largest = 1.0f64;
        for coupling in self.couplings {
            let place = self.place(coupling);
            let entries = (0..36).map(|i| lanes.at(place.entry(i / 6, i % 6)).get(lane).norm());
            largest = entries.fold(largest, f64::max);
        }
        let held = HELD * largest;
        for coupling in self.couplings {
            let sides = [of_node(coupling.row), of_node(coupling.column)];
            let holds = (coupling.row == coupling.column).then_some(held);
            let block = (self.place(coupling), [6, 6]);
            project_block(lanes, lane, block, &sides, holds);
        }
        for (index, (class, placed)) in self.classes.iter().zip(self.system.elements()).enumerate()
        {
            let Class::Averaged(average) = class else {
                continue;
            };
            let nodes = placed.element.nodes();
            let of_nodes: Vec<_> = nodes.iter().map(|&node| of_node(node)).collect();
            let of_own = own_projection(alike, (average, placed), harmonic);
            let (own, count) = (self.layout.own_at[index], placed.element.own_unknowns());
            for (&node, of_node) in nodes.iter().zip(of_nodes) {
                let at = self.layout.node_at[node];
                let below = (structure.block_at(own, at), [count, 6]);
                let sides = [of_own.clone(), of_node.clone()];
                project_block(lanes, lane, below, &sides, None);
                let beside = (structure.block_at(at, own), [6, count]);
                project_block(lanes, lane, beside, &[of_node, of_own.clone()], None);
            }
            let block = (structure.block_at(own, own), [count, count]);
            project_block(lanes, lane, block, &[of_own.clone(), of_own], Some(1.0));
        }
    }
}

/// What an element's own unknowns may be in a harmonic, if it acts on hub and supports alone:
/// multipliers what their forces on the nodes may be.
fn own_projection(
    alike: &AlikeMotions,
    (average, placed): (&Average, &Placed),
    harmonic: usize,
) -> Option<DMatrix<Complex<f64>>> {
    let steps: Option<Vec<_>> = (placed.element.nodes().iter())
        .map(|&node| alike.of_node(node))
        .collect();
    let (steps, g) = (steps?, &average.gradient);
    let step = match placed.has_states {
        true => DMatrix::identity(g.nrows(), g.nrows()),
        false => {
            // Gᵀ λ(t) = T⁻ᵀ Gᵀ λ(t + T/B)
            let mut carried = g.clone();
            for (local, step) in steps.iter().enumerate() {
                let columns = g.columns(6 * local, 6) * step.back;
                carried.columns_mut(6 * local, 6).copy_from(&columns);
            }
            (g * g.transpose()).try_inverse()? * g * carried.transpose()
        }
    };
    Some(alike.projection(&step, harmonic))
}

/// `Πᴴ A Π` of a block, with what its rows and columns may be, and `1 − Π` added, times a
/// stiffness, if it holds what they may not.
fn project_block(
    lanes: &mut BlockLanes<ComplexLanes>,
    lane: usize,
    (place, [rows, columns]): (BlockPlace, [usize; 2]),
    sides: &[Option<DMatrix<Complex<f64>>>; 2],
    holds: Option<f64>,
) {
    if sides.iter().all(Option::is_none) {
        return;
    }
    let mut block = DMatrix::from_fn(rows, columns, |i, j| lanes.at(place.entry(i, j)).get(lane));
    if let Some(of_rows) = &sides[0] {
        block = of_rows.adjoint() * block;
    }
    if let Some(of_columns) = &sides[1] {
        block *= of_columns;
        if let Some(stiffness) = holds {
            let held = DMatrix::identity(columns, columns) - of_columns;
            block += held * Complex::from(stiffness);
        }
    }
    for j in 0..columns {
        for i in 0..rows {
            lanes.at(place.entry(i, j)).set(lane, block[(i, j)]);
        }
    }
}
