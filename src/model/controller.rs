//! Controllers: laws of the user that read joint coordinates, have states, and act on coordinates.

use super::{JointCoordinate, Model, UserFunction};
use crate::elements::{ControllerLaw, ControllerState};
use crate::error::{Error, Result, require_finite};
use serde::{Deserialize, Serialize};

/// Efforts on joint coordinates, towards growth, by a law of joint coordinates, their rates, and
/// states of its own.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ControllerDefinition {
    /// The coordinates that it reads.
    pub inputs: Vec<JointCoordinate>,
    /// Those that it acts on.
    pub outputs: Vec<JointCoordinate>,
    /// Its states.
    pub states: Vec<ControllerState>,
    /// The law.
    pub law: UserFunction<ControllerLaw>,
    /// Cycles of the phase that it is told in a period; 0 if it is told the time.
    pub cycles: usize,
}

impl ControllerDefinition {
    pub(super) fn require_valid(&self, model: &Model) -> Result<()> {
        require_valid(model, [&self.inputs, &self.outputs], &self.states)
    }
}

/// Checks what a controller would be made of.
///
/// # Errors
/// As [`Model::add_controller`].
pub(super) fn require_valid(
    model: &Model,
    lists: [&[JointCoordinate]; 2],
    states: &[ControllerState],
) -> Result<()> {
    for (name, list) in ["input", "output"].into_iter().zip(lists) {
        for (i, at) in list.iter().enumerate() {
            let checked = model.require_coordinate(at);
            checked.map_err(|e| e.within(format!("{name}[{i}]")))?;
            if list[..i].contains(at) {
                let got = format!("{} of joint {} again", at.coordinate, at.joint);
                let expected = "each coordinate at most once";
                return Err(Error::value(&format!("{name}s"), expected, got));
            }
        }
    }
    if lists[1].is_empty() {
        return Err(Error::size("output_count", "at least 1 coordinate", 0));
    }
    for (k, state) in states.iter().enumerate() {
        require_finite(&format!("initial[{k}]"), &[state.initial])?;
        let name = format!("sizes[{k}]");
        require_finite(&name, &[state.size])?;
        if state.size <= 0.0 {
            return Err(Error::value(&name, "a positive number", state.size));
        }
        if !(state.initial / state.size).is_finite() {
            let expected = "a state of comparable size";
            return Err(Error::value(&name, expected, state.size));
        }
    }
    Ok(())
}
