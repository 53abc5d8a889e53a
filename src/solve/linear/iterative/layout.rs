//! Where nodes and own unknowns of elements stand in the block rows of a preconditioner.

use super::block_lu::BlockStructure;
use super::chunks::Chunks;
use super::constraints::{Class, turning_nodes};
use crate::collocation::{Collocation, Tangent};
use crate::system::System;
use std::collections::BTreeSet;

/// Unknowns of a block row from which on constraints stand with one node where they can.
const LARGE_ROW: usize = 60;
/// Condition of a gradient that determines its node.
const DETERMINED: f64 = 1e4;

/// What stands together in a block row.
#[derive(Debug, Clone, Copy)]
enum Member {
    Node(usize),
    /// Own unknowns of an element.
    Own(usize),
}

/// A block row, and the first unknown of what stands there.
pub(super) type Position = (usize, usize);

/// Block rows of one harmonic, or of one grid point.
pub(super) struct Layout {
    pub structure: BlockStructure,
    /// The same without supports, of harmonics that they do not have, if there are such
    /// (docs/theory.md, section 8.10).
    pub without_supports: Option<BlockStructure>,
    /// Where each node stands.
    pub node_at: Vec<Position>,
    /// And the own unknowns of each element, if they are not left out.
    pub own_at: Vec<Position>,
    /// Of each unknown: its place at the first grid point, and from one grid point to the next.
    pub places: Vec<(usize, usize)>,
    /// The unknowns where they stand among all.
    pub regions: Vec<Region>,
}

/// Unknowns of a node, or own unknowns of an element, that stand together among all: those of the
/// first grid point, then those of the second, and so on.
pub(super) struct Region {
    /// Place of the first among all.
    first: usize,
    points: usize,
    /// The unknowns at a grid point.
    pub unknowns: std::ops::Range<usize>,
}

impl Region {
    /// Splits a vector of all unknowns, in the order of the regions.
    pub fn split<'x>(regions: &[Region], mut x: &'x mut [f64]) -> Vec<&'x mut [f64]> {
        let mut before = 0;
        let mut parts = Vec::with_capacity(regions.len());
        for region in regions {
            let (_, rest) = x.split_at_mut(region.first - before);
            let (part, rest) = rest.split_at_mut(region.len());
            parts.push(part);
            x = rest;
            before = region.first + region.len();
        }
        parts
    }

    /// The unknowns at all grid points in a vector of all.
    pub fn of<'x>(&self, x: &'x [f64]) -> &'x [f64] {
        &x[self.first..][..self.len()]
    }

    fn len(&self) -> usize {
        self.unknowns.len() * self.points
    }
}

impl Layout {
    /// Constraints stand together with all nodes that they constrain, as their own diagonal is
    /// zero, or where these are many with one that they determine; all else stands alone.
    /// Constraints that `classes` keep exact are left out, rows with nodes that they constrain are
    /// kept.
    ///
    /// `kept_alone`: nodes that stand alone although they are constrained, as long as another node
    /// of the constraint does not.
    pub fn new(
        equations: &Collocation,
        tangent: &Tangent,
        classes: &[Class],
        kept_alone: &[bool],
    ) -> Self {
        let system = equations.system();
        let rows = block_rows(system, classes, kept_alone);
        let mut node_at = vec![(0, 0); system.nodes()];
        let mut own_at = vec![(0, 0); system.elements().len()];
        let mut sizes = Vec::with_capacity(rows.len());
        for (row, members) in rows.iter().enumerate() {
            let mut first = 0;
            for &member in members {
                match member {
                    Member::Node(node) => node_at[node] = (row, first),
                    Member::Own(index) => own_at[index] = (row, first),
                }
                first += size_of(system, member);
            }
            sizes.push(first);
        }
        let coupled = coupled(system, tangent, classes, (&node_at, &own_at), rows.len());
        let mut kept = vec![false; rows.len()];
        for (node, turns) in turning_nodes(system, classes).into_iter().enumerate() {
            kept[node_at[node].0] |= turns;
        }
        let is_left_out = |(members, kept): (&Vec<Member>, &bool)| {
            !kept
                && members
                    .iter()
                    .all(|&member| stands_still(equations, member))
        };
        let left_out: Vec<bool> = rows.iter().zip(&kept).map(is_left_out).collect();
        let without_supports = (left_out.contains(&true))
            .then(|| BlockStructure::without(sizes.clone(), coupled.clone(), &kept, &left_out));
        let structure = BlockStructure::new(sizes, coupled, &kept);
        let regions = regions(equations, classes, &structure, (&node_at, &own_at));
        let mut places = vec![(0, 0); structure.unknowns()];
        for region in &regions {
            for (i, unknown) in region.unknowns.clone().enumerate() {
                places[unknown] = (region.first + i, region.unknowns.len());
            }
        }
        Layout {
            without_supports: without_supports.flatten(),
            regions,
            structure,
            node_at,
            own_at,
            places,
        }
    }

    /// That of harmonics in which everything moves, or of others.
    pub fn structure_of(&self, is_whole: bool) -> &BlockStructure {
        match &self.without_supports {
            Some(structure) if !is_whole => structure,
            _ => &self.structure,
        }
    }

    /// So many harmonics, from 0 on, in the order in which they are worked on.
    pub fn chunks(&self, equations: &Collocation, harmonics: usize) -> Chunks {
        match (&self.without_supports, equations.alike()) {
            (Some(_), Some(alike)) => Chunks::of_one_blade(harmonics, alike.blades()),
            _ => Chunks::of_all(0..harmonics),
        }
    }

    /// Unknowns that are not eliminated, in ascending order.
    pub fn kept(&self) -> impl Iterator<Item = usize> {
        let diagonal = self
            .structure
            .kept()
            .iter()
            .filter(|(row, column, _)| row == column);
        diagonal.flat_map(|&(row, ..)| {
            let first = self.structure.first(row);
            first..first + self.structure.size(row)
        })
    }

    /// Unknowns of the largest block row.
    pub fn largest_block(&self) -> usize {
        (0..self.structure.rows())
            .map(|row| self.structure.size(row))
            .max()
            .unwrap_or(0)
    }
}

/// Whether unknowns are the same in all parts of the period, of one blade of several.
fn stands_still(equations: &Collocation, member: Member) -> bool {
    let Some(alike) = equations.alike() else {
        return false;
    };
    match member {
        Member::Node(node) => alike.is_still(node),
        Member::Own(index) => {
            let placed = &equations.system().elements()[index];
            let mut nodes = placed.element.nodes().iter();
            nodes.all(|&node| alike.is_still(node))
        }
    }
}

/// Block rows that are coupled with each.
fn coupled(
    system: &System,
    tangent: &Tangent,
    classes: &[Class],
    (node_at, own_at): (&[Position], &[Position]),
    rows: usize,
) -> Vec<BTreeSet<usize>> {
    let mut coupled = vec![BTreeSet::new(); rows];
    let mut couple = |(a, _): Position, (b, _): Position| {
        coupled[a].insert(b);
        coupled[b].insert(a);
    };
    for coupling in tangent.couplings() {
        couple(node_at[coupling.row], node_at[coupling.column]);
    }
    for (index, (class, placed)) in classes.iter().zip(system.elements()).enumerate() {
        if matches!(class, Class::Averaged(_)) {
            for &node in placed.element.nodes() {
                couple(own_at[index], node_at[node]);
            }
        }
    }
    coupled
}

fn regions(
    equations: &Collocation,
    classes: &[Class],
    structure: &BlockStructure,
    (node_at, own_at): (&[Position], &[Position]),
) -> Vec<Region> {
    let (elements, all) = (equations.system().elements(), equations.layout());
    let points = equations.grid().points();
    let nodes = node_at.iter().enumerate();
    let nodes = nodes.map(|(node, &at)| (all.motion(node, 0), at));
    let own = classes.iter().enumerate().filter_map(|(index, class)| {
        let averaged = matches!(class, Class::Averaged(_));
        averaged.then(|| (all.element_at(&elements[index], 0), own_at[index]))
    });
    let all = nodes.chain(own).map(|(place, (row, first))| {
        let first = structure.first(row) + first;
        Region {
            first: place.start,
            points,
            unknowns: first..first + place.len(),
        }
    });
    all.collect()
}

fn size_of(system: &System, member: Member) -> usize {
    match member {
        Member::Node(_) => 6,
        Member::Own(index) => system.elements()[index].element.own_unknowns(),
    }
}

/// Nodes and own unknowns in rows, with constraints where the nodes are that they constrain.
fn block_rows(system: &System, classes: &[Class], kept_alone: &[bool]) -> Vec<Vec<Member>> {
    let joined = Joined::new(system, classes, kept_alone);
    let together = joined.rows(&vec![None; classes.len()]);
    let size = |row: &Vec<Member>| row.iter().map(|&m| size_of(system, m)).sum::<usize>();
    if together.iter().all(|row| size(row) <= LARGE_ROW) {
        return together;
    }
    // Of the constraints in large rows: the node that each can stand with alone.
    let mut bearers = vec![None; classes.len()];
    for row in together.iter().filter(|row| size(row) > LARGE_ROW) {
        for &member in row {
            if let Member::Own(index) = member {
                bearers[index] = joined.bearer(index);
            }
        }
    }
    joined.rows(&bearers)
}

/// Constraints and the nodes that they stand with.
struct Joined<'a> {
    system: &'a System,
    classes: &'a [Class],
    /// Of each element: the nodes that it constrains, but for those that stand alone while others
    /// do not; none if it does not constrain.
    nodes: Vec<Vec<usize>>,
    /// Constraints of each node.
    held: Vec<usize>,
}

impl<'a> Joined<'a> {
    fn new(system: &'a System, classes: &'a [Class], kept_alone: &[bool]) -> Self {
        let all = classes.iter().zip(system.elements());
        let nodes: Vec<Vec<usize>> = all
            .map(|(class, placed)| {
                if placed.has_states || !matches!(class, Class::Averaged(_)) {
                    return Vec::new();
                }
                let nodes = placed.element.nodes();
                let others: Vec<_> = nodes.iter().copied().filter(|&n| !kept_alone[n]).collect();
                if others.is_empty() {
                    nodes.to_vec()
                } else {
                    others
                }
            })
            .collect();
        let mut held = vec![0; system.nodes()];
        nodes.iter().flatten().for_each(|&node| held[node] += 1);
        Joined {
            system,
            classes,
            nodes,
            held,
        }
    }

    /// A node that nothing else holds and that this constraint determines: together they can be
    /// eliminated whatever else there is, and the other nodes stand alone.
    fn bearer(&self, index: usize) -> Option<usize> {
        let Class::Averaged(average) = &self.classes[index] else {
            return None;
        };
        let all = self.system.elements()[index].element.nodes();
        let determines = |node: usize| {
            let Some(local) = all.iter().position(|&n| n == node) else {
                return false;
            };
            let gradient = average.gradient.view((0, 6 * local), (6, 6));
            let inverse = gradient.into_owned().try_inverse();
            inverse.is_some_and(|inverse| inverse.norm() * gradient.norm() < DETERMINED)
        };
        let nodes = self.nodes[index].iter().copied();
        let mut free = nodes.filter(|&node| average.gradient.nrows() == 6 && self.held[node] == 1);
        free.find(|&node| determines(node))
    }

    /// Rows, in which constraints with a bearer stand with it, and others with all their nodes.
    fn rows(&self, bearers: &[Option<usize>]) -> Vec<Vec<Member>> {
        let mut group: Vec<usize> = (0..self.system.nodes()).collect();
        for (nodes, bearer) in self.nodes.iter().zip(bearers) {
            if let (&[first, ..], None) = (&nodes[..], bearer) {
                for &node in nodes {
                    let (a, b) = (root(&group, first), root(&group, node));
                    group[a.max(b)] = a.min(b);
                }
            }
        }
        let mut rows: Vec<Vec<Member>> = vec![Vec::new(); self.system.nodes()];
        for node in 0..self.system.nodes() {
            rows[root(&group, node)].push(Member::Node(node));
        }
        for (index, (nodes, bearer)) in self.nodes.iter().zip(bearers).enumerate() {
            if let Some(node) = bearer.or(nodes.first().copied()) {
                rows[root(&group, node)].push(Member::Own(index));
            } else if let Class::Averaged(_) = self.classes[index] {
                rows.push(vec![Member::Own(index)]);
            }
        }
        rows.retain(|members| !members.is_empty());
        rows
    }
}

/// What a node's group is known by.
fn root(group: &[usize], mut node: usize) -> usize {
    while group[node] != node {
        node = group[node];
    }
    node
}

#[cfg(test)]
mod tests {
    use super::super::constraints::{Joints, classify};
    use super::*;
    use crate::collocation::GridState;
    use crate::fourier::TimeGrid;
    use crate::test_models::shells::flapping_plate;
    use std::sync::Arc;

    /// Of a plate with 25 nodes welded to a shaft.
    #[test]
    fn nodes_of_a_clamped_edge_stand_alone() {
        let (model, period) = flapping_plate(0.3, [2, 8], 4);
        let system = Arc::new(System::new(&model, period).unwrap());
        let grid = TimeGrid::new(5, period).unwrap();
        let state = GridState::reference(&system, grid);
        let mut equations = Collocation::new(system, grid).unwrap();
        let mut tangent = Tangent::with_resultants_apart(equations.system(), 5);
        tangent.evaluate(&mut equations, &state).unwrap();
        let classes = classify(&equations, &tangent, Joints::Exact);
        let nodes = equations.system().nodes();
        let layout = Layout::new(&equations, &tangent, &classes, &vec![false; nodes]);
        // A node and its weld, or the shaft and its joint with its drive.
        assert_eq!(layout.largest_block(), 12);
        let of_welds = layout.own_at.iter().filter(|at| at.1 == 6).count();
        assert!(of_welds >= 25, "{of_welds}");
        for (node, &(row, first)) in layout.node_at.iter().enumerate() {
            assert_eq!(first, 0, "{node} stands with others in {row}");
        }
    }
}
