//! States of a march, kept and put together.

use crate::collocation::{GridState, MotionState};
use crate::elements::NodeState;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::memory;
use crate::motion::Motion;
use crate::solve::marching::Refusal;
use crate::solve::report::{NewtonReport, Outcome};
use crate::solve::result::{Kind, MarchRecord, Solved};
use crate::system::System;
use std::sync::Arc;

/// One time's states.
#[derive(Debug, Clone)]
pub(super) struct Kept {
    pub time: f64,
    state: GridState,
    node_states: Vec<NodeState>,
}

impl Kept {
    pub fn of(at: &MotionState) -> Self {
        Kept {
            time: at.time,
            node_states: (0..at.twist.len()).map(|node| at.node(node)).collect(),
            state: at.state.clone(),
        }
    }
}

/// Bytes that so many steps take, kept and put together.
pub(super) fn of_steps(system: &System, steps: usize) -> usize {
    let node = size_of::<Motion>() + size_of::<NodeState>();
    let own = size_of::<f64>() * (system.own_unknowns() + system.tracked());
    let step = system.nodes().saturating_mul(node) + own + size_of::<Kept>();
    steps.saturating_mul(2 * step)
}

/// Checks that so many steps are to be had.
///
/// # Errors
/// [`crate::error::ErrorKind::OutOfMemory`].
pub(super) fn require_steps(system: &System, steps: usize) -> Result<()> {
    memory::require("steps of the march", of_steps(system, steps))
}

/// Puts the states of all times together.
pub(super) fn finish(
    system: &Arc<System>,
    mut record: MarchRecord,
    kept: Vec<Kept>,
    refusal: Option<Refusal>,
) -> Result<Solved> {
    let points = kept.len();
    require_steps(system, points / 2)?;
    let mut state = GridState::at_points(system, points);
    let mut node_states = vec![NodeState::at_rest(Motion::identity()); points * system.nodes()];
    for (k, kept) in kept.iter().enumerate() {
        state.copy_point(system, k, &kept.state, 0);
        for (node, at) in kept.node_states.iter().enumerate() {
            node_states[node * points + k] = *at;
        }
    }
    record.times = kept.iter().map(|kept| kept.time).collect();
    let (outcome, explanation) = refusal.unwrap_or((Outcome::Converged, String::new()));
    let report = NewtonReport::ended(outcome, explanation);
    Ok(Solved {
        total_iterations: record.iterations,
        ..Solved::known(
            system,
            TimeGrid::new(1, system.period())?,
            (state, node_states),
            report,
            Kind::March(record),
        )
    })
}
