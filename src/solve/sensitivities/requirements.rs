//! What sensitivities are asked of: a motion that was found, of this model, and parameters of it.

use super::explicit::Explicit;
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result};
use crate::model::Model;
use crate::solve::conditions::Free;
use crate::solve::result::Solved;

/// Residuals that differ by no more are those of the same equations.
const SAME: f64 = 1e-10;

/// Checks that a solve has found a periodic motion.
pub(super) fn require_solution(solve: &Solved) -> Result<()> {
    let wanted = "sensitivities are those of a periodic solution";
    if solve.periodic().is_none() {
        let message = format!("solution: {wanted}; this is none");
        return Err(Error::new(ErrorKind::NotAvailable, message));
    }
    if !solve.report.outcome.is_solution() {
        let message = format!("solution: {wanted}; this {}", solve.report.describe());
        return Err(Error::new(ErrorKind::NotAvailable, message));
    }
    Ok(())
}

/// Checks that the equations are the same with the values of the parameters in the model.
pub(super) fn require_same(
    equations: &mut Collocation,
    state: &GridState,
    explicit: &mut Explicit,
) -> Result<()> {
    let mut residual = vec![0.0; equations.layout().size()];
    equations.residual(state, &mut residual)?;
    let pairs = residual.iter().zip(explicit.residual()?);
    if pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) <= SAME {
        return Ok(());
    }
    let message = "model: expected the one that was solved, with the values of its parameters";
    Err(Error::new(ErrorKind::Value, message))
}

/// Checks that parameters are different ones that are not free.
pub(super) fn require_parameters(model: &Model, free: &[Free], parameters: &[Free]) -> Result<()> {
    for (i, parameter) in parameters.iter().enumerate() {
        match *parameter {
            Free::Frequency => model.require_functions_of_phase()?,
            Free::Parameter(id) => {
                model.require_parameter(id)?;
            }
        }
        let got = |what: &str| format!("{}, which is {what}", parameter.name(model));
        if free.contains(parameter) {
            return Err(Error::value("parameters", "what is not free", got("free")));
        }
        if parameters[..i].contains(parameter) {
            let expected = "different parameters";
            return Err(Error::value("parameters", expected, got("there twice")));
        }
    }
    Ok(())
}
