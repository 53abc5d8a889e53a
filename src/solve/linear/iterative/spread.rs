//! Preconditioners spread over ranks: each rank has whole time histories of its nodes, but solves
//! for all nodes at some of the grid points (`spread_time`), or in some of the harmonics
//! (`spread_harmonics`). What is known at its nodes is transposed for that.

use super::constraints::count_free;
use super::{Preconditioner, Tangent};
use crate::collocation::{Collocation, GridState, Item, Partition, RankPart};
use crate::error::Result;
use crate::motion::Motion;
use crate::ranks::Ranks;
use crate::system::System;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Numbers of a complex one.
pub(super) const COMPLEX: usize = 2;

/// What a rank knows.
#[derive(Clone, Copy)]
pub(crate) struct Spread<'a> {
    pub ranks: &'a Arc<dyn Ranks>,
    /// The whole system.
    pub whole: &'a Arc<System>,
    pub partition: &'a Partition,
    pub part: &'a RankPart,
    /// Those of the part.
    pub equations: &'a Collocation,
    pub tangent: &'a Tangent,
    pub state: &'a GridState,
    /// Tracked coordinates of the whole at a state near by.
    pub coordinates: &'a [f64],
}

/// A component of something that has unknowns, over the grid.
pub(super) type Series = (Item, usize);

impl<'a> Spread<'a> {
    /// Motions of a rank's nodes, and own unknowns of those of its elements that `count`.
    pub(super) fn series_of(&self, rank: usize, counts: impl Fn(usize) -> bool) -> Vec<Series> {
        let owners = self.partition.owners().iter().enumerate();
        let nodes = owners.filter(|(_, owner)| **owner == rank);
        let motions = nodes.flat_map(|(node, _)| (0..6).map(move |i| (Item::Node(node), i)));
        let elements = self.whole.elements().iter().enumerate();
        let elements = elements
            .filter(|(index, placed)| counts(*index) && self.partition.of_element(placed) == rank);
        let own = elements.flat_map(|(index, placed)| {
            let count = placed.element.own_unknowns();
            (0..count).map(move |i| (Item::Element(index), i))
        });
        motions.chain(own).collect()
    }

    /// Place of a series of the part at the first grid point, and from one grid point to the next.
    pub(super) fn local_place(&self, (item, component): Series) -> (usize, usize) {
        let layout = self.equations.layout();
        match item {
            Item::Node(node) => {
                let local = self.part.nodes.partition_point(|n| *n < node);
                (layout.motion(local, 0).start + component, 6)
            }
            Item::Element(index) => {
                let local = self.part.elements.partition_point(|e| *e < index);
                let placed = &self.part.system.elements()[local];
                let count = placed.element.own_unknowns();
                (layout.element_at(placed, 0).start + component, count)
            }
        }
    }

    /// The elements with own unknowns, with all their nodes, as every rank has them.
    ///
    /// # Errors
    /// If numbers cannot be told, or an element cannot be evaluated.
    pub(super) fn with_own_unknowns(&self) -> Result<OwnPart> {
        let all = self.whole.elements().iter().enumerate();
        let with_own = all.filter(|(_, placed)| placed.element.own_unknowns() > 0);
        let elements: Vec<usize> = with_own.map(|(index, _)| index).collect();
        let nodes: BTreeSet<usize> = elements
            .iter()
            .flat_map(|&index| self.whole.elements()[index].element.nodes().iter().copied())
            .collect();
        let nodes: Vec<usize> = nodes.into_iter().collect();
        let system = Arc::new(self.whole.part(&nodes, &elements));
        let grid = self.equations.grid();
        let mut state = GridState::at_points(&system, grid.points());
        self.gather_state(&nodes, &elements, &mut state)?;
        state.coordinates.copy_from_slice(self.coordinates);
        state.track(&system);
        // Signals may fail on one rank.
        let mut equations = self.ranks.agreed(Collocation::new(system.clone(), grid))?;
        if self.equations.is_regularised() {
            equations.regularise();
        }
        let mut tangent = Tangent::new(&system, grid.points());
        self.ranks
            .agreed(tangent.evaluate(&mut equations, &state))?;
        Ok(OwnPart {
            nodes,
            elements,
            equations,
            tangent,
        })
    }

    /// Writes motions of these nodes and own unknowns of these elements, whoever has them, to the
    /// state of a system that they are.
    fn gather_state(
        &self,
        nodes: &[usize],
        elements: &[usize],
        state: &mut GridState,
    ) -> Result<()> {
        let points = state.points();
        let mut own = Vec::new();
        for node in nodes {
            if self.partition.owners()[*node] == self.ranks.rank() {
                let local = self.part.nodes.partition_point(|n| n < node);
                let motions = self.state.node(local).iter();
                motions.for_each(|motion| own.extend(numbers_of(motion)));
            }
        }
        for index in elements {
            let placed = &self.whole.elements()[*index];
            if self.partition.of_element(placed) == self.ranks.rank() {
                let local = self.part.elements.partition_point(|e| e < index);
                let over = self.part.system.elements()[local].own_over(points);
                own.extend_from_slice(&self.state.multipliers[over]);
            }
        }
        let (all, counts) = self.ranks.gathered_any(&own)?;
        let mut rest: Vec<&[f64]> = Vec::with_capacity(counts.len());
        let mut first = 0;
        for count in counts {
            rest.push(&all[first..first + count]);
            first += count;
        }
        let mut take = |rank: usize, count: usize| {
            let (taken, left) = rest[rank].split_at(count);
            rest[rank] = left;
            taken
        };
        for (place, &node) in nodes.iter().enumerate() {
            let motions = &mut state.motions[place * points..][..points];
            let numbers = take(self.partition.owners()[node], 12 * points).chunks_exact(12);
            motions
                .iter_mut()
                .zip(numbers)
                .for_each(|(m, x)| *m = motion_of(x));
        }
        let mut first = 0;
        for &index in elements {
            let placed = &self.whole.elements()[index];
            let count = placed.element.own_unknowns() * points;
            let values = take(self.partition.of_element(placed), count);
            state.multipliers[first..first + count].copy_from_slice(values);
            first += count;
        }
        Ok(())
    }
}

/// The elements with own unknowns as a system of their own.
pub(super) struct OwnPart {
    /// Its nodes and elements in the whole.
    pub nodes: Vec<usize>,
    pub elements: Vec<usize>,
    pub equations: Collocation,
    pub tangent: Tangent,
}

/// Position and rotation matrix, column by column.
pub(crate) fn numbers_of(motion: &Motion) -> [f64; 12] {
    let mut numbers = [0.0; 12];
    numbers[..3].copy_from_slice(motion.position.as_slice());
    numbers[3..].copy_from_slice(motion.rotation.as_slice());
    numbers
}

/// The motion of these.
pub(crate) fn motion_of(numbers: &[f64]) -> Motion {
    let position = nalgebra::Vector3::from_column_slice(&numbers[..3]);
    Motion::new(
        nalgebra::Matrix3::from_column_slice(&numbers[3..12]),
        position,
    )
}

/// What suits a motion: whether joints turn in it. By all ranks.
///
/// # Errors
/// If numbers cannot be told, or elements cannot be evaluated.
pub(crate) fn suitable(spread: Spread) -> Result<Preconditioner> {
    let own = spread.with_own_unknowns()?;
    Ok(match count_free(&own.equations, &own.tangent) {
        Some(_) => Preconditioner::TimeLocal,
        None => Preconditioner::BodyCirculant,
    })
}
