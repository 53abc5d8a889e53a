//! Newton's method for equations with scalar unknowns.

use super::Newton;
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, Result};
use crate::solve::linear::bordered::Bordered;
use crate::solve::linear::method::{Linear, LinearMethod};
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport};

/// Solves equations that have scalar unknowns, such as a period or the size of a load, and scalar
/// equations ([`Collocation::set_scalars`]), from `state`, which becomes the solution or the last
/// iterate.
///
/// # Errors
/// If the equations are oversampled, or cannot be evaluated at the start, or memory runs out.
pub fn solve_with_scalars(
    equations: Collocation,
    state: &mut GridState,
    method: LinearMethod,
    options: &NewtonOptions,
    observe: &mut dyn FnMut(&Iteration) -> bool,
) -> Result<NewtonReport> {
    options.validate()?;
    if equations.oversampled().is_some() {
        let expected = "no oversampling where there are scalar unknowns";
        return Err(Error::value("equations", expected, "oversampled ones"));
    }
    let linear = Linear::new(&equations, method);
    Newton::bordered(equations, linear).solve(state, options, observe)
}

impl Newton<Bordered<Linear>> {
    /// A solver for equations that have scalar unknowns; `linear` solves those of the grid.
    pub(crate) fn bordered(equations: Collocation, linear: Linear) -> Self {
        let linear = Bordered::new(&equations, linear);
        Newton::with(equations, linear)
    }
}
