//! What is evaluated of states in which blades move alike, and what follows from it
//! (docs/theory.md, section 8.10).

use super::LikeBlades;
use crate::elements::NodeState;
use crate::fourier::TimeGrid;
use crate::motion::Motion;
use crate::system::{ElementRole, System};
use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

/// Where elements matter to the leaders: all else has forces and motions that follow from theirs.
#[derive(Debug, Clone)]
pub struct Leaders {
    left: LikeBlades,
    /// Grid points, from the first on, at which each element is evaluated.
    of_elements: Vec<usize>,
    /// Of each node: whether an element acts on it that is evaluated.
    is_acted_on: Vec<bool>,
    /// Of each node: for each part of the period what carries twists from the leader, if anything.
    carries: Vec<Vec<Option<Carried>>>,
    /// Of each element: whether it acts within one blade, or on hub and supports alone, and what it
    /// does is a matter of motions alone.
    by_motions: Vec<bool>,
    /// Of each element with own unknowns whose equations are known from those of its leader: for
    /// each part of the period what carries these there; none where they are the same.
    own: Vec<Option<OwnCarries>>,
}

/// The number of own unknowns of an element, and what carries their equations.
type OwnCarries = (usize, Vec<Option<DMatrix<f64>>>);

/// What carries the motion of a leader to a follower, and twists.
#[derive(Debug, Clone, Copy)]
struct Carried {
    motion: Motion,
    /// `Ad(Z⁻¹)` of twists; forces of the follower are `Ad(Z)ᵀ` times those of the leader.
    twist: Matrix6<f64>,
    force: Matrix6<f64>,
}

impl Carried {
    /// What a follower does where its leader does this.
    fn state(&self, there: NodeState) -> NodeState {
        NodeState {
            motion: there.motion.compose(&self.motion),
            twist: self.twist * there.twist,
            twist_rate: self.twist * there.twist_rate,
        }
    }
}

impl Leaders {
    /// Of what is left of a system.
    pub fn new(system: &System, left: &LikeBlades) -> Self {
        let points = left.blades * left.part;
        let mut of_elements = left.wanted(system);
        let own = (0..of_elements.len()).map(|element| own_carries(system, left, element));
        let own: Vec<_> = own.collect();
        for ((wanted, placed), own) in of_elements.iter_mut().zip(system.elements()).zip(&own) {
            if placed.element.own_unknowns() > 0 && own.is_none() {
                *wanted = points;
            }
        }
        let carries = left.nodes.iter().map(|follower| {
            let parts = follower.parts.iter();
            let carried = parts.map(|(_, carry)| {
                carry.as_ref().map(|carry| Carried {
                    motion: carry.motion,
                    twist: carry.motion.inverse().adjoint(),
                    force: carry.motion.adjoint().transpose(),
                })
            });
            carried.collect()
        });
        let by_motions = system.elements().iter().map(|placed| {
            let is_by_motions = match placed.role {
                ElementRole::Inertia | ElementRole::Beam(_) | ElementRole::Shell(_) => {
                    placed.element.own_unknowns() == 0
                }
                ElementRole::MassDamping => true,
                _ => false,
            };
            let nodes = placed.element.nodes();
            let blades = nodes.iter().map(|&node| left.blade(node));
            is_by_motions
                && nodes
                    .first()
                    .is_some_and(|&first| blades.eq(nodes.iter().map(|_| left.blade(first))))
        });
        let mut is_acted_on = vec![false; system.nodes()];
        for (placed, points) in system.elements().iter().zip(&of_elements) {
            let nodes = placed.element.nodes().iter().filter(|_| *points > 0);
            nodes.for_each(|&node| is_acted_on[node] = true);
        }
        Leaders {
            own,
            is_acted_on,
            by_motions: by_motions.collect(),
            of_elements,
            carries: carries.collect(),
            left: left.clone(),
        }
    }

    /// On a grid; none if blades are not alike, or do not share its points.
    pub fn on(system: &System, grid: TimeGrid) -> Option<Self> {
        Some(Self::new(system, &LikeBlades::on(system, grid)?))
    }

    /// Grid points, from the first on, at which each element is evaluated.
    pub fn of_elements(&self) -> &[usize] {
        &self.of_elements
    }

    /// Grid points of a part of the period.
    pub fn part(&self) -> usize {
        self.left.part
    }

    /// Whether a node leads.
    pub fn leads(&self, node: usize) -> bool {
        self.left.nodes[node].leader == node
    }

    /// Whether a node does the same as its leader at another time, in the same frame.
    pub fn is_copied(&self, node: usize) -> bool {
        !self.leads(node) && self.carries[node].iter().all(Option::is_none)
    }

    /// Whether what an element does is a matter of motions alone, and of constant gravity, of one
    /// blade or of hub and supports.
    pub fn is_by_motions(&self, element: usize) -> bool {
        self.by_motions[element]
    }

    /// How many grid points one stands for where it is to be seen whether such elements do to a
    /// node what follows from its leader: none if it is not looked at. What tells blades apart
    /// there shows wherever they move: each is looked at where its leader is at every `B − 1`-th
    /// point, hub and supports in their second part of the period.
    pub fn stands_for(&self, node: usize, k: usize) -> usize {
        let followers = self.left.blades - 1;
        let (_, from, _) = self.before(node, k);
        let is_seen = match self.left.blade(node) {
            None => k < 2 * self.left.part,
            Some(_) => from % followers == 0,
        };
        if is_seen { followers } else { 0 }
    }

    /// Whether a node leads, and not only follows itself, at a grid point.
    pub fn leads_at(&self, node: usize, k: usize) -> bool {
        let (leader, from, _) = self.before(node, k);
        (leader, from) == (node, k)
    }

    /// The leader of a node, the grid point where that is what the node is at `k`, and what carries
    /// it there.
    fn before(&self, node: usize, k: usize) -> (usize, usize, Option<&Carried>) {
        let (part, within) = (k / self.left.part, k % self.left.part);
        let follower = &self.left.nodes[node];
        let from = follower.parts[part].0 * self.left.part + within;
        (follower.leader, from, self.carries[node][part].as_ref())
    }

    /// Writes forces on all that follows from those on the leaders, not scaled; `place` tells the
    /// first of a node at a grid point.
    pub(in crate::collocation) fn repeat_forces(
        &self,
        place: impl Fn(usize, usize) -> usize,
        rows: &mut [f64],
    ) {
        for node in 0..self.left.nodes.len() {
            for k in 0..self.left.blades * self.left.part {
                let (leader, from, carried) = self.before(node, k);
                if (leader, from) == (node, k) {
                    continue;
                }
                let first = place(leader, from);
                let there = Vector6::from_column_slice(&rows[first..][..6]);
                let here = carried.map_or(there, |carried| carried.force * there);
                rows[place(node, k)..][..6].copy_from_slice(here.as_slice());
            }
        }
    }

    /// Writes the equations of own unknowns of all that follows from those of what leads, not
    /// scaled; `place` tells the first of an element at a grid point.
    pub(in crate::collocation) fn repeat_own(
        &self,
        place: impl Fn(usize, usize) -> usize,
        rows: &mut [f64],
    ) {
        let part = self.left.part;
        for (element, own) in self.own.iter().enumerate() {
            let Some((count, own)) = own else {
                continue;
            };
            let (count, follower) = (*count, &self.left.elements[element]);
            for k in 0..self.left.blades * part {
                let from = follower.parts[k / part].0 * part + k % part;
                if (follower.leader, from) == (element, k) {
                    continue;
                }
                let (there, here) = (place(follower.leader, from), place(element, k));
                match &own[k / part] {
                    None => rows.copy_within(there..there + count, here),
                    Some(carry) => {
                        for i in 0..count {
                            let row = (0..count).map(|j| carry[(i, j)] * rows[there + j]);
                            rows[here + i] = row.sum();
                        }
                    }
                }
            }
        }
    }

    /// Writes increments, and those of velocities, of other nodes from those of nodes that lead, at
    /// the same places as states.
    pub(in crate::collocation) fn repeat_changes(&self, changes: &mut [[Vector6<f64>; 2]]) {
        self.repeat(
            changes,
            |_| true,
            |carried, there| there.map(|twist| carried.twist * twist),
        );
    }

    /// Of so many grid points, or times as far from each other, those at which a node leads: from
    /// the first on.
    pub fn points_of(&self, node: usize, points: usize) -> usize {
        match (self.leads(node), self.left.blade(node)) {
            (false, _) => 0,
            (true, None) => points / self.left.blades,
            (true, Some(_)) => points,
        }
    }

    /// Whether the equations of own unknowns of all elements are known from those of their leaders.
    pub(in crate::collocation) fn knows_own(&self, system: &System) -> bool {
        let all = self.own.iter().zip(system.elements());
        all.into_iter()
            .all(|(own, placed)| own.is_some() || placed.element.own_unknowns() == 0)
    }

    /// Writes the states of other nodes from those of nodes that lead: node `a` at time `k` of the
    /// grid, or as long after its points, at `a N + k`.
    pub(in crate::collocation) fn repeat_states(&self, states: &mut [NodeState]) {
        self.repeat(states, |_| true, Carried::state);
    }

    /// The same of the nodes alone on which elements act that are evaluated.
    pub(in crate::collocation) fn repeat_states_acted_on(&self, states: &mut [NodeState]) {
        self.repeat(states, |node| self.is_acted_on[node], Carried::state);
    }

    /// Writes the motions of other nodes, likewise.
    pub(in crate::collocation) fn repeat_motions(&self, motions: &mut [Motion]) {
        self.repeat(
            motions,
            |_| true,
            |carried, there: Motion| there.compose(&carried.motion),
        );
    }

    /// Writes what other nodes, those that are wanted, have from what those have that lead.
    fn repeat<T: Copy>(
        &self,
        all: &mut [T],
        wanted: impl Fn(usize) -> bool,
        carry: impl Fn(&Carried, T) -> T,
    ) {
        let points = self.left.blades * self.left.part;
        for node in (0..self.left.nodes.len()).filter(|&node| wanted(node)) {
            if self.leads(node) && self.left.blade(node).is_some() {
                continue;
            }
            for k in 0..points {
                let (leader, from, carried) = self.before(node, k);
                if (leader, from) == (node, k) {
                    continue;
                }
                let there = all[leader * points + from];
                all[node * points + k] = carried.map_or(there, |carried| carry(carried, there));
            }
        }
    }
}

/// What carries the equations of own unknowns of the leader of an element to its own, not scaled,
/// for each part of the period. None if it has none, or that is not known.
fn own_carries(system: &System, left: &LikeBlades, element: usize) -> Option<OwnCarries> {
    let placed = &system.elements()[element];
    let count = placed.element.own_unknowns();
    if count == 0 {
        return None;
    }
    // Work of equations and unknowns is the same: with those of the leader times `C`, equations are
    // those of the leader times `C⁻ᵀ`.
    let scales = DVector::from_fn(count, |i, _| system.own_scales(placed.first_own + i)[0]);
    let carried = |carry: &Option<DMatrix<f64>>| match carry {
        None => Some(None),
        Some(carry) => {
            let inverse = carry.clone().try_inverse()?.transpose();
            let unscaled = inverse.map_with_location(|i, j, x| x * scales[j] / scales[i]);
            Some(Some(unscaled))
        }
    };
    let parts = left.elements[element].parts.iter();
    let all: Option<Vec<_>> = parts.map(|(_, carry)| carried(carry)).collect();
    Some((count, all?))
}
