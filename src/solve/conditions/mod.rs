//! Free parameters, and as many conditions that determine them. See docs/theory.md, section 13.2.
//!
//! A condition is a scalar equation of the motion over the period and of the parameters. A new one
//! is a file here that implements [`Condition`].

mod arc_length;
mod energy;
mod equations;
mod given;
mod inner_product;
mod joint_coordinate;
mod momentum;
mod output;
mod phase;
mod rigid_motion;
mod rigid_phase;

pub(crate) use arc_length::ArcLength;
pub use energy::Energy;
pub(crate) use equations::Conditioned;
pub use equations::Free;
pub use given::Given;
pub(crate) use inner_product::InnerProduct;
pub use joint_coordinate::JointCoordinateIs;
pub use momentum::Momentum;
pub use output::OutputIs;
pub use phase::Phase;
pub use rigid_motion::RigidMotion;
pub use rigid_phase::RigidPhase;

use crate::collocation::{Collocation, GridState};
use crate::error::Result;
use std::fmt::Debug;
use std::sync::Arc;

/// Step of differences by a free parameter, relative to its scale.
const STEP: f64 = 1e-5;

/// A scalar equation that takes the place of what a free parameter leaves open.
///
/// It looks at the motions, multipliers and internal states of `state` at all grid points, at the
/// free parameters, which are its `scalars`, and at what `equations` knows of them: the kinematics
/// of the nodes ([`Collocation::node_states`]) are those of the state, the system is that of the
/// parameters.
pub trait Condition: Debug + Send + Sync {
    /// What it is called in messages: "the mean of ...".
    fn name(&self) -> String;

    /// What counts as 1 in its value, a positive number.
    fn scale(&self, equations: &Collocation) -> f64;

    /// What is left of it: zero where it is met.
    ///
    /// # Errors
    /// If it cannot be evaluated there.
    fn value(&self, equations: &Collocation, state: &GridState) -> Result<f64>;

    /// Adds the derivatives of the value by all unknowns to `row`, at the places of
    /// [`Collocation::layout`]: by material increments `[Δr; Δψ]` of motions, own unknowns and free
    /// parameters, none of them scaled.
    ///
    /// # Errors
    /// If it cannot be evaluated there.
    fn gradient(&self, equations: &Collocation, state: &GridState, row: &mut [f64]) -> Result<()>;

    /// What takes its place in a solve that starts at `state`, if that depends on it.
    ///
    /// # Errors
    /// If it cannot be met from there.
    fn at_start(
        &self,
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Option<Arc<dyn Condition>>> {
        let _ = (equations, state);
        Ok(None)
    }
}

/// Adds the derivatives of a condition's value by the free parameters to `row`, by differences,
/// where motions alone do not tell it: velocities follow a frequency, internal forces a stiffness.
fn add_by_parameters(
    condition: &dyn Condition,
    equations: &Collocation,
    state: &GridState,
    row: &mut [f64],
) -> Result<()> {
    let (mut equations, mut beside) = (equations.clone(), state.clone());
    for (index, place) in equations.layout().scalars().enumerate() {
        let step = STEP * equations.column_scale()[place];
        for sign in [1.0, -1.0] {
            beside.scalars[index] = state.scalars[index] + sign * step;
            equations.apply_scalars(&beside)?;
            equations.update_kinematics(&beside);
            row[place] += sign * condition.value(&equations, &beside)? / (2.0 * step);
        }
        beside.scalars[index] = state.scalars[index];
    }
    Ok(())
}
