//! Controllers: laws of the user that read joint coordinates, have states, and act on coordinates.

use super::{ControllerDefinition, ForceDefinition, JointCoordinate, Model, UserFunction};
use crate::elements::{ControllerLaw, ControllerState};
use crate::error::{Error, ErrorKind, Result, require_finite};

impl ControllerDefinition {
    pub(super) fn require_valid(&self, model: &Model) -> Result<()> {
        require_valid(model, [&self.inputs, &self.outputs], &self.states)
    }
}

impl Model {
    /// Adds a controller: efforts on the joint coordinates `outputs`, towards growth, by a law of
    /// time, of the coordinates `inputs` and their rates, and of states that it gives the rates of.
    /// Without states it is a law that reads other coordinates. Returns the force's id.
    ///
    /// # Errors
    /// If a coordinate is none of its joint or in a list twice, if there is no output, or if the
    /// size of a state is not positive.
    pub fn add_controller(
        &mut self,
        inputs: &[JointCoordinate],
        outputs: &[JointCoordinate],
        states: &[ControllerState],
        law: ControllerLaw,
    ) -> Result<usize> {
        self.add_force(ForceDefinition::Controller(Box::new(
            ControllerDefinition {
                inputs: inputs.to_vec(),
                outputs: outputs.to_vec(),
                states: states.to_vec(),
                law: UserFunction::new(law),
                cycles: 0,
            },
        )))
    }

    /// Checks what a controller would be made of.
    ///
    /// # Errors
    /// As [`Model::add_controller`].
    pub(crate) fn require_controller_of(
        &self,
        inputs: &[JointCoordinate],
        outputs: &[JointCoordinate],
        states: &[ControllerState],
    ) -> Result<()> {
        require_valid(self, [inputs, outputs], states)
    }

    /// The controller of this id.
    ///
    /// # Errors
    /// If there is no such force, or it is no controller.
    pub fn require_controller(&self, force: usize) -> Result<&ControllerDefinition> {
        match self.require_force("force", force)? {
            ForceDefinition::Controller(controller) => Ok(controller),
            _ => {
                let message = format!("force: {force} is no controller");
                Err(Error::new(ErrorKind::NotAvailable, message))
            }
        }
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
