//! What forces do at the grid points or steps, kept as a user's function is not called any more.

use crate::elements::NodeState;
use crate::error::Result;
use crate::solve::Solved;
use crate::system::{Conditions, ElementRole, OwnValues, Placed};
use nalgebra::DVector;
use serde::{Deserialize, Serialize};

/// A force at the grid points.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct ForceRecord {
    pub(super) nodes: Vec<usize>,
    /// Forces on the nodes, in their own axes.
    pub(super) on_nodes: Vec<Vec<f64>>,
    /// The element's outputs.
    pub(super) outputs: Vec<Vec<f64>>,
    /// What its internal states gain in a period.
    pub(super) gain: f64,
}

impl ForceRecord {
    /// Whether its values are as many as a grid of `points` needs.
    pub(super) fn fits(&self, points: usize) -> bool {
        let outputs = self.outputs.first().map_or(0, Vec::len);
        self.on_nodes.len() == points
            && self.outputs.len() == points
            && self
                .on_nodes
                .iter()
                .all(|x| x.len() / 6 == self.nodes.len())
            && self.outputs.iter().all(|x| x.len() == outputs)
    }
}

/// What the internal states of an element gain in a period.
pub(super) fn gain_of(solve: &Solved, placed: &Placed) -> f64 {
    if placed.has_states && solve.march().is_none() {
        solve.state.gain(&solve.system, placed, 0)
    } else {
        0.0
    }
}

/// Values of all signals at each grid point.
pub(super) fn signals_of(solve: &Solved) -> Result<Vec<Vec<f64>>> {
    let times = solve.times().into_iter();
    times
        .map(|time| {
            let mut values = vec![0.0; solve.system.signals()];
            solve.system.signal_values(time, 1.0, &mut values)?;
            Ok(values)
        })
        .collect()
}

/// What an element exerts on its nodes at grid point `k` and `time`, for these coordinates, signals
/// and own unknowns, and its outputs.
pub(super) fn exerted(
    solve: &Solved,
    placed: &Placed,
    (k, time): (usize, f64),
    coordinates: &[f64],
    signals: &[f64],
    values: &[f64],
) -> Result<(DVector<f64>, Vec<f64>)> {
    let conditions = Conditions {
        time,
        signals,
        coordinates,
        inertia_factor: 1.0,
    };
    let own = OwnValues {
        values,
        // What is read does not depend on them.
        rates: &vec![0.0; values.len()],
        resultants: &[],
    };
    let nodes = placed.element.nodes().iter();
    let states: Vec<NodeState> = nodes.map(|&n| solve.states_of(n)[k]).collect();
    solve.system.outputs(placed, &states, &conditions, own)
}

/// All forces of a solve; those that cannot be evaluated where it ended tell why.
pub(super) fn record_forces(solve: &Solved) -> Result<Vec<Result<ForceRecord>>> {
    let signals = signals_of(solve)?;
    let record = |placed: &Placed| -> Result<ForceRecord> {
        let mut record = ForceRecord {
            nodes: placed.element.nodes().to_vec(),
            on_nodes: Vec::new(),
            outputs: Vec::new(),
            gain: gain_of(solve, placed),
        };
        for (k, time) in solve.times().into_iter().enumerate() {
            let coordinates = solve.state.tracked(&solve.system, k);
            let values = solve.state.own_of(placed, k);
            let at = (k, time);
            let (on_nodes, outputs) = exerted(solve, placed, at, coordinates, &signals[k], values)?;
            record.on_nodes.push(on_nodes.as_slice().to_vec());
            record.outputs.push(outputs);
        }
        Ok(record)
    };
    let elements = solve.system.elements().iter();
    Ok(elements
        .filter(|placed| matches!(placed.role, ElementRole::Force(_)))
        .map(record)
        .collect())
}
