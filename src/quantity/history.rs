//! A motion at a number of times, which quantities are taken of.

use super::record::ForceRecord;
use crate::collocation::{Collocation, GridState};
use crate::elements::{Element, NodeState};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::system::{Placed, System};

/// A motion at the points of a grid, or at the steps of a trajectory.
#[derive(Debug)]
pub struct History<'a> {
    /// The system.
    pub system: &'a System,
    /// Motions and own unknowns.
    pub state: &'a GridState,
    /// Motions with their velocities and accelerations: node `a` at time `k` at `a N + k`.
    pub nodes: &'a [NodeState],
    /// The times.
    pub times: Vec<f64>,
    /// The grid, but of a trajectory.
    pub grid: Option<TimeGrid>,
    /// Values of the prescribed coordinates at the first time, with their whole turns; at least of
    /// these.
    pub start: &'a [f64],
    /// Where forces are known from.
    pub forces: Forces<'a>,
}

/// Where it is known from what forces do.
#[derive(Debug, Clone, Copy)]
pub enum Forces<'a> {
    /// From records: functions of the user are not called any more.
    Recorded(&'a [Result<ForceRecord>]),
    /// From their elements, with these values of all signals, time by time.
    Evaluated(&'a [f64]),
}

impl<'a> History<'a> {
    /// Of a state whose kinematics `equations` have evaluated last.
    pub fn of(equations: &'a Collocation, state: &'a GridState) -> Self {
        History {
            system: equations.system(),
            state,
            nodes: equations.node_states(),
            times: equations.times().to_vec(),
            grid: Some(equations.grid()),
            start: equations.signals(),
            forces: Forces::Evaluated(equations.signals()),
        }
    }

    /// Number of times.
    pub fn points(&self) -> usize {
        self.state.points()
    }

    /// A node at time `k`.
    pub fn node(&self, node: usize, k: usize) -> &NodeState {
        &self.nodes[node * self.points() + k]
    }

    /// The nodes of an element at time `k`.
    pub fn nodes_of(&self, element: &dyn Element, k: usize) -> Vec<NodeState> {
        let nodes = element.nodes().iter();
        nodes.map(|&node| *self.node(node, k)).collect()
    }

    /// Own unknowns of an element at time `k`.
    pub fn own_of(&self, placed: &Placed, k: usize) -> &[f64] {
        self.state.own_of(placed, k)
    }
}
