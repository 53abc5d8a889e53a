//! Where a march starts.

use crate::collocation::{GridState, MotionState};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::marching::marcher::Marcher;
use crate::solve::marching::options::{MarchOptions, MarchStart};
use crate::solve::marching::refused;
use crate::solve::marching::trajectory::{Kept, finish};
use crate::solve::report::Outcome;
use crate::solve::result::{MarchRecord, Solved};
use crate::system::System;
use crate::workers::Workers;
use std::sync::Arc;

/// Part of a step over which rates of drives are differenced.
const SHORT: f64 = 1e-3;

/// The reference configuration at rest, but for what hangs on drives that turn, if the joints let
/// it turn with them as one rigid body: that is where they are, and has their velocity.
fn rigid_rotation(
    system: &System,
    time: f64,
    short: f64,
    reference: GridState,
) -> Result<MotionState> {
    let driven = system.driven_at(time, short)?;
    let Some(driven) = driven.filter(|driven| driven.is_rigid()) else {
        return Ok(MotionState::at_rest(time, reference));
    };
    let mut signals = vec![0.0; system.signals()];
    system.signal_values(time, 1.0, &mut signals)?;
    let mut state = reference;
    for (node, motion) in state.motions.iter_mut().enumerate() {
        *motion = driven.carried(node, motion, &signals);
    }
    state.track(system);
    let mut at = MotionState::at_rest(time, state);
    for (node, twist) in at.twist.iter_mut().enumerate() {
        *twist = at.state.motions[node].inverse().adjoint() * driven.twist(node);
    }
    Ok(at)
}

/// Motions and velocities to start from, and whether internal states are given with them.
fn given_or_rigid(
    system: &System,
    options: &MarchOptions,
    step: f64,
) -> Result<(MotionState, bool)> {
    let mut state = GridState::reference(system, TimeGrid::new(1, system.period())?);
    let given = match &options.start {
        MarchStart::Reference => {
            let at = rigid_rotation(system, options.start_time, SHORT * step, state)?;
            return Ok((at, false));
        }
        MarchStart::State(given) => given,
    };
    state.motions.copy_from_slice(&given.motions);
    if let Some((own, tracked)) = &given.internal {
        state.multipliers.copy_from_slice(own);
        state.coordinates.copy_from_slice(tracked);
    }
    state.track(system);
    let mut at = MotionState::at_rest(options.start_time, state);
    if !given.twists.is_empty() {
        let given = given.motions.iter().zip(&given.twists);
        for (twist, (motion, given)) in at.twist.iter_mut().zip(given) {
            *twist = given + system.at_inertial_rest(motion).twist;
        }
    }
    Ok((at, given.internal.is_some()))
}

/// A march in steps of `step` that is about to begin; if its start is refused, what a solve gives
/// that ends there.
pub(super) fn begin(
    system: &Arc<System>,
    options: &MarchOptions,
    step: f64,
    workers: &Workers,
) -> Result<std::result::Result<Marcher, Solved>> {
    let (mut at, states_given) = given_or_rigid(system, options, step)?;
    let begun = Marcher::new(system, options, step, (&mut at, states_given), workers);
    let refusal = match refused(begun) {
        Err(_) if workers.is_stopped() => (Outcome::Cancelled, String::new()),
        begun => match begun? {
            Ok(marcher) => return Ok(Ok(marcher)),
            Err(refusal) => refusal,
        },
    };
    let record = MarchRecord::new();
    Ok(Err(finish(
        system,
        record,
        vec![Kept::of(&at)],
        Some(refusal),
    )?))
}
