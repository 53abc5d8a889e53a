//! What harmonics of hub and supports may be, in the averaged matrices of one blade of several
//! (docs/theory.md, section 8.10).

use super::block_lu::{BlockLanes, BlockPlace, BlockStructure};
use super::constraints::{Average, Class};
use super::lanes::{ComplexLanes, LANES, Lanes};
use super::mean::Averages;
use crate::collocation::AlikeMotions;
use crate::system::Placed;
use nalgebra::{Complex, DMatrix};

/// How stiffly what motions may not do is held, relative to the largest entry of all.
const HELD: f64 = 1.0;

/// What unknowns of a node or element may be in a harmonic.
#[derive(Debug, Clone)]
enum Allowed {
    /// Anything.
    All,
    /// Nothing: what stands still is the same in all parts of the period.
    Nothing,
    /// What `Π` leaves.
    Some(DMatrix<Complex<f64>>),
}

/// The same of all nodes and elements in harmonics that leave this remainder when divided by the
/// number of blades, of which it is a matter.
#[derive(Debug)]
struct Remainder {
    nodes: Vec<Allowed>,
    /// Own unknowns.
    own: Vec<Allowed>,
}

/// What harmonics may be, of one remainder after the other.
#[derive(Debug)]
pub(super) struct Projections(Vec<Remainder>);

impl Projections {
    fn of(&self, harmonic: usize) -> &Remainder {
        &self.0[harmonic % self.0.len()]
    }
}

impl Averages<'_> {
    /// What harmonics may be, if these are averages of one blade of several.
    pub(super) fn projections(&self) -> Option<Projections> {
        let alike = self.alike?;
        let elements = || self.classes.iter().zip(self.system.elements());
        let steps: Vec<_> = elements()
            .map(|(class, placed)| match class {
                Class::Averaged(average) => own_step(alike, (average, placed)),
                _ => None,
            })
            .collect();
        let remainder = |harmonic: usize| {
            let of_node = |node: usize| match alike.of_node(node) {
                None => Allowed::All,
                Some(_) if alike.is_still(node) => still(harmonic),
                Some(step) => {
                    let step = DMatrix::from_column_slice(6, 6, step.forth.as_slice());
                    Allowed::Some(alike.projection(&step, harmonic))
                }
            };
            let of_own = |step: &Option<OwnStep>| match step {
                None => Allowed::All,
                Some(OwnStep::Still) => still(harmonic),
                Some(OwnStep::Turned(step)) => Allowed::Some(alike.projection(step, harmonic)),
            };
            Remainder {
                nodes: (0..self.system.nodes()).map(of_node).collect(),
                own: steps.iter().map(of_own).collect(),
            }
        };
        Some(Projections((0..alike.blades()).map(remainder).collect()))
    }

    /// Leaves of hub and supports the motions and constraints that the harmonic of each lane may
    /// have, `Πᴴ A Π`, and holds the others, by `1 − Π`.
    pub(super) fn project(
        &self,
        projections: &Projections,
        (structure, lanes): (&BlockStructure, &mut BlockLanes<ComplexLanes>),
        harmonics: &[usize; LANES],
    ) {
        let remainders = harmonics.map(|harmonic| projections.of(harmonic));
        let mut largest = [1.0f64; LANES];
        for coupling in self.couplings {
            let Some(place) = self.place(structure, coupling) else {
                continue;
            };
            for entry in 0..36 {
                let entry = lanes.at(place.entry(entry / 6, entry % 6));
                for (lane, largest) in largest.iter_mut().enumerate() {
                    *largest = largest.max(entry.get(lane).norm_sqr());
                }
            }
        }
        let held = largest.map(|largest| HELD * largest.sqrt());
        for coupling in self.couplings {
            let holds = coupling.row == coupling.column;
            let Some(place) = self.place(structure, coupling) else {
                continue;
            };
            let block = (place, [6, 6]);
            for (lane, of) in remainders.iter().enumerate() {
                let sides = [coupling.row, coupling.column].map(|node| &of.nodes[node]);
                let holds = holds.then_some(held[lane]);
                project_block(lanes, lane, block, sides, holds);
            }
        }
        for (index, (class, placed)) in self.classes.iter().zip(self.system.elements()).enumerate()
        {
            let count = placed.element.own_unknowns();
            let own = self.layout.own_at[index];
            let is_averaged = matches!(class, Class::Averaged(_));
            if count == 0 || !is_averaged || structure.leaves_out(own.0) {
                continue;
            }
            for &node in placed.element.nodes() {
                let at = self.layout.node_at[node];
                let places = structure.find(own, at).zip(structure.find(at, own));
                let Some((below, beside)) = places else {
                    continue;
                };
                let (below, beside) = ((below, [count, 6]), (beside, [6, count]));
                for (lane, of) in remainders.iter().enumerate() {
                    let (of_node, of_own) = (&of.nodes[node], &of.own[index]);
                    project_block(lanes, lane, below, [of_own, of_node], None);
                    project_block(lanes, lane, beside, [of_node, of_own], None);
                }
            }
            let block = (structure.block_at(own, own), [count, count]);
            for (lane, of) in remainders.iter().enumerate() {
                project_block(lanes, lane, block, [&of.own[index]; 2], Some(1.0));
            }
        }
    }
}

/// What is the same in all parts of the period has harmonics of their number alone.
fn still(remainder: usize) -> Allowed {
    match remainder {
        0 => Allowed::All,
        _ => Allowed::Nothing,
    }
}

/// What a part of the period makes of own unknowns.
enum OwnStep {
    Still,
    Turned(DMatrix<f64>),
}

/// What it makes of an element's, if that acts on hub and supports alone: of multipliers what it
/// makes of their forces on the nodes. None if they may be any.
fn own_step(alike: &AlikeMotions, (average, placed): (&Average, &Placed)) -> Option<OwnStep> {
    let steps: Option<Vec<_>> = (placed.element.nodes().iter())
        .map(|&node| alike.of_node(node))
        .collect();
    let (steps, g) = (steps?, &average.gradient);
    let are_still = placed.element.nodes().iter().all(|&n| alike.is_still(n));
    if placed.has_states || are_still {
        return Some(OwnStep::Still);
    }
    // Gᵀ λ(t) = T⁻ᵀ Gᵀ λ(t + T/B)
    let mut carried = g.clone();
    for (local, step) in steps.iter().enumerate() {
        let columns = g.columns(6 * local, 6) * step.back;
        carried.columns_mut(6 * local, 6).copy_from(&columns);
    }
    let step = (g * g.transpose()).try_inverse()? * g * carried.transpose();
    Some(OwnStep::Turned(step))
}

/// `Πᴴ A Π` of a block, with what its rows and columns may be, and `1 − Π` added, times a
/// stiffness, if it holds what they may not.
fn project_block(
    lanes: &mut BlockLanes<ComplexLanes>,
    lane: usize,
    (place, [rows, columns]): (BlockPlace, [usize; 2]),
    sides: [&Allowed; 2],
    holds: Option<f64>,
) {
    let mut block = match sides {
        [Allowed::All, Allowed::All] => return,
        [Allowed::Nothing, _] | [_, Allowed::Nothing] => DMatrix::zeros(rows, columns),
        _ => DMatrix::from_fn(rows, columns, |i, j| lanes.at(place.entry(i, j)).get(lane)),
    };
    if let [Allowed::Some(of_rows), Allowed::All | Allowed::Some(_)] = sides {
        block = of_rows.adjoint() * block;
    }
    if let [Allowed::All | Allowed::Some(_), Allowed::Some(of_columns)] = sides {
        block *= of_columns;
    }
    let held = match sides[1] {
        Allowed::Some(of_columns) => Some(DMatrix::identity(columns, columns) - of_columns),
        Allowed::Nothing => Some(DMatrix::identity(columns, columns)),
        Allowed::All => None,
    };
    if let (Some(stiffness), Some(held)) = (holds, held) {
        block += held * Complex::from(stiffness);
    }
    for j in 0..columns {
        for i in 0..rows {
            lanes.at(place.entry(i, j)).set(lane, block[(i, j)]);
        }
    }
}
