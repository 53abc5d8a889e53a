//! Whether the user's forces are the same at the same state, and repeat with the period.

use super::check::Probe;
use super::scales::coordinate_scales;
use crate::elements::{CoordinateState, Element, NodeState, UserForce};
use crate::error::{Error, ErrorKind, Result};
use crate::model::{ForceDefinition, Model};
use nalgebra::Vector6;
use std::f64::consts::TAU;

/// Relative differences of two calls that are none: a function that iterates leaves as much.
const SAME: f64 = 1e-9;
/// Relative differences from one period to the next that are none: a period of six digits leaves
/// as much.
const REPEATED: f64 = 1e-6;
/// Times that a function is looked at, as parts of the period. It has to change at both: one that
/// is written for a single period may do so at one of them.
const TIMES: [f64; 2] = [0.0, 0.37];

/// Refuses forces whose functions give different values at the same motion and `time`.
///
/// # Errors
/// [`ErrorKind::NotPeriodic`].
pub fn require_reproducible_forces(
    model: &Model,
    length: f64,
    period: f64,
    time: f64,
) -> Result<()> {
    require_repeating_forces(model, length, TAU / period, &[time], None)
}

/// Refuses those, too, that give other values at the same motion one period later.
///
/// # Errors
/// [`ErrorKind::NotPeriodic`].
pub fn require_periodic_forces(model: &Model, length: f64, period: f64) -> Result<()> {
    let times = TIMES.map(|part| part * period);
    require_repeating_forces(model, length, TAU / period, &times, Some(period))
}

fn require_repeating_forces(
    model: &Model,
    length: f64,
    frequency: f64,
    times: &[f64],
    period: Option<f64>,
) -> Result<()> {
    for (index, force) in model.forces.iter().enumerate() {
        let mut probe = Probe::new(length, frequency);
        match force {
            ForceDefinition::CoordinateLaw { at, law, cycles } => {
                let law = law.get()?;
                let scales = coordinate_scales(at.coordinate, length, frequency);
                let reference = model.reference_coordinate(at);
                let state = probe.coordinate(reference, scales);
                let unit = unit_of_time(*cycles, frequency);
                let effort = |time: f64| {
                    let time = time * unit;
                    let state = CoordinateState { time, ..state };
                    Ok(vec![law.call(&state)?.value])
                };
                require_repeating(effort, times, period)
                    .map_err(|e| e.within(format!("force {index} on joint {}", at.joint)))?;
            }
            ForceDefinition::NodeForces {
                nodes,
                law,
                cycles,
                apart,
            } => {
                let law = law.get()?;
                let states = probe.nodes(model, nodes);
                let element = UserForce::new(nodes.clone(), law.clone(), length, frequency);
                let unit = unit_of_time(*cycles, frequency);
                let forces = |time: f64| {
                    let forces = element.forces(time * unit, &states)?;
                    Ok(forces.iter().flatten().copied().collect())
                };
                let within = |e: Error| e.within(format!("force {index}"));
                require_repeating(forces, times, period).map_err(within)?;
                if *apart && let Some(time) = times.first() {
                    let others = probe.nodes(model, nodes);
                    let at = |states: &[NodeState]| element.forces(time * unit, states);
                    require_apart(at, nodes, [&states, &others]).map_err(within)?;
                }
            }
            ForceDefinition::Controller(controller) => {
                let law = controller.law.get()?;
                let call = probe.controller(model, controller);
                let unit = unit_of_time(controller.cycles, frequency);
                let results = |time: f64| {
                    let mut call = call.clone();
                    law.evaluate(time * unit, controller.outputs.len(), &mut call, false)?;
                    Ok(call.results)
                };
                require_repeating(results, times, period)
                    .map_err(|e| e.within(format!("force {index}")))?;
            }
            ForceDefinition::SurfaceForces {
                element,
                place,
                law,
                cycles,
            } => {
                let sizes = [length, frequency];
                let element = model.surface_force((*element, *place), law.get()?, sizes)?;
                let states = probe.nodes(model, element.nodes());
                let unit = unit_of_time(*cycles, frequency);
                let forces = |time: f64| {
                    let forces = element.forces(time * unit, &states)?;
                    Ok(forces.iter().flatten().copied().collect())
                };
                require_repeating(forces, times, period)
                    .map_err(|e| e.within(format!("force {index}")))?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// Refuses forces on nodes that are said to depend on their own motions alone where they change
/// with those of every second node of theirs.
fn require_apart(
    forces: impl Fn(&[NodeState]) -> Result<Vec<Vector6<f64>>>,
    nodes: &[usize],
    [states, others]: [&[NodeState]; 2],
) -> Result<()> {
    let mixed: Vec<NodeState> = (states.iter().zip(others).enumerate())
        .map(|(place, (state, other))| if place % 2 == 0 { *state } else { *other })
        .collect();
    // As above, the solve tells of what the function refuses.
    let (Ok(at_states), Ok(at_others), Ok(at_mixed)) =
        (forces(states), forces(others), forces(&mixed))
    else {
        return Ok(());
    };
    let all = at_states.iter().zip(&at_others).zip(&at_mixed).enumerate();
    for (place, ((state, other), found)) in all {
        let expected = if place % 2 == 0 { state } else { other };
        if different(expected.as_slice(), found.as_slice(), SAME).is_some() {
            let message = format!(
                "its nodes were declared apart, but the force on node {} changes with the motions \
                 of others",
                nodes[place]
            );
            return Err(Error::new(ErrorKind::Model, message));
        }
    }
    Ok(())
}

/// What a function is told of a unit of time.
fn unit_of_time(cycles: usize, frequency: f64) -> f64 {
    match cycles {
        0 => 1.0,
        cycles => cycles as f64 * frequency,
    }
}

/// Compares the values at times with those of the same time again and, if there is one, a period
/// later.
fn require_repeating(
    values: impl Fn(f64) -> Result<Vec<f64>>,
    times: &[f64],
    period: Option<f64>,
) -> Result<()> {
    let mut changes = None;
    for &time in times {
        // A motion that was made up may be one that the function refuses: the solve tells of its
        // own.
        let (Ok(first), Ok(again)) = (values(time), values(time)) else {
            return Ok(());
        };
        if let Some((a, b)) = different(&first, &again, SAME) {
            let message = format!(
                "the function gives different values at the same time and motion: {a}, then {b} \
                 at t = {time}"
            );
            return Err(Error::new(ErrorKind::NotPeriodic, message));
        }
        let Some(period) = period else { continue };
        let Ok(later) = values(time + period) else {
            return Ok(());
        };
        match different(&first, &later, REPEATED) {
            Some((a, b)) => {
                changes = Some(format!(
                    "the function does not repeat with the period {period}: at the same motion it \
                     gives {a} at t = {time}, and {b} at t = {}",
                    time + period
                ));
            }
            None => return Ok(()),
        }
    }
    match changes {
        Some(message) => Err(Error::new(ErrorKind::NotPeriodic, message)),
        None => Ok(()),
    }
}

/// The values that differ most, if that is more than a part of the largest.
fn different(first: &[f64], second: &[f64], part: f64) -> Option<(f64, f64)> {
    let size = first
        .iter()
        .chain(second)
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    let pairs = first.iter().copied().zip(second.iter().copied());
    let worst = pairs.max_by(|(a, b), (c, d)| (a - b).abs().total_cmp(&(c - d).abs()))?;
    ((worst.0 - worst.1).abs() > part * size).then_some(worst)
}
