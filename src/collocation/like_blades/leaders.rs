//! What is evaluated of states in which blades move alike, and what follows from it
//! (docs/theory.md, section 8.10).

use super::LikeBlades;
use crate::elements::NodeState;
use crate::fourier::TimeGrid;
use crate::motion::Motion;
use crate::system::System;
use nalgebra::{Matrix6, Vector6};

/// Where elements matter to the leaders: all else has forces and motions that follow from theirs.
#[derive(Debug, Clone)]
pub struct Leaders {
    left: LikeBlades,
    /// Grid points, from the first on, at which each element is evaluated.
    of_elements: Vec<usize>,
    /// Of each node: for each part of the period what carries twists from the leader, if anything.
    carries: Vec<Vec<Option<Carried>>>,
}

/// What carries the motion of a leader to a follower, and twists.
#[derive(Debug, Clone, Copy)]
struct Carried {
    motion: Motion,
    /// `Ad(Z⁻¹)` of twists; forces of the follower are `Ad(Z)ᵀ` times those of the leader.
    twist: Matrix6<f64>,
    force: Matrix6<f64>,
}

impl Leaders {
    /// Of what is left of a system.
    pub fn new(system: &System, left: &LikeBlades) -> Self {
        let points = left.blades * left.part;
        let mut of_elements = left.wanted(system);
        for (wanted, placed) in of_elements.iter_mut().zip(system.elements()) {
            // Own equations of followers are not made of those of leaders.
            if placed.element.own_unknowns() > 0 {
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
        Leaders {
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

    /// Writes increments, and those of velocities, of other nodes from those of nodes that lead, at
    /// the same places as states.
    pub(in crate::collocation) fn repeat_changes(&self, changes: &mut [[Vector6<f64>; 2]]) {
        self.repeat(changes, |carried, there| {
            there.map(|twist| carried.twist * twist)
        });
    }

    /// Writes the states of other nodes from those of nodes that lead: node `a` at time `k` of the
    /// grid, or as long after its points, at `a N + k`.
    pub(in crate::collocation) fn repeat_states(&self, states: &mut [NodeState]) {
        self.repeat(states, |carried, there| NodeState {
            motion: there.motion.compose(&carried.motion),
            twist: carried.twist * there.twist,
            twist_rate: carried.twist * there.twist_rate,
        });
    }

    /// Writes what other nodes have from what those have that lead.
    fn repeat<T: Copy>(&self, all: &mut [T], carry: impl Fn(&Carried, T) -> T) {
        let points = self.left.blades * self.left.part;
        for node in 0..self.left.nodes.len() {
            if self.leads(node) {
                continue;
            }
            for k in 0..points {
                let (leader, from, carried) = self.before(node, k);
                let there = all[leader * points + from];
                all[node * points + k] = carried.map_or(there, |carried| carry(carried, there));
            }
        }
    }
}
