//! What tells where a motion is that could as well be elsewhere: turned about an axis, or moved.

use super::Condition;
use super::phase::{PhaseAlong, unknown_start};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::model::direction;
use crate::motion::DualVector;
use nalgebra::{Vector3, Vector6};
use std::sync::Arc;

/// The motion is not turned about an axis, or moved in a direction, from that which the solve
/// starts from: in the mean over the period and all nodes. For mechanisms that nothing holds
/// against that.
#[derive(Debug, Clone)]
pub struct RigidPhase {
    is_translation: bool,
    /// The motion, a twist about the origin, resolved in space.
    twist: Vector6<f64>,
}

impl RigidPhase {
    /// Not turned about the axis through `point`.
    ///
    /// # Errors
    /// If an argument has no finite values, or `axis` has no direction.
    pub fn rotation(axis: &Vector3<f64>, point: &Vector3<f64>) -> Result<Self> {
        require_finite("point", point.as_slice())?;
        let twist = DualVector::of_turn(&direction("axis", axis)?.normalize(), point);
        Ok(RigidPhase {
            is_translation: false,
            twist: twist.to_twist(),
        })
    }

    /// Not moved in this direction.
    ///
    /// # Errors
    /// If it has no finite values, or no direction.
    pub fn translation(along: &Vector3<f64>) -> Result<Self> {
        let twist = DualVector {
            primal: Vector3::zeros(),
            dual: direction("direction", along)?.normalize(),
        };
        Ok(RigidPhase {
            is_translation: true,
            twist: twist.to_twist(),
        })
    }
}

impl Condition for RigidPhase {
    fn name(&self) -> String {
        match self.is_translation {
            true => "the phase of the translation".into(),
            false => "the phase of the rotation".into(),
        }
    }

    fn scale(&self, _: &Collocation) -> f64 {
        1.0
    }

    fn value(&self, _: &Collocation, _: &GridState) -> Result<f64> {
        Err(unknown_start(self))
    }

    fn gradient(&self, _: &Collocation, _: &GridState, _: &mut [f64]) -> Result<()> {
        Err(unknown_start(self))
    }

    fn at_start(
        &self,
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Option<Arc<dyn Condition>>> {
        let twist = match self.is_translation {
            true => self.twist * equations.system().scales().length,
            false => self.twist,
        };
        let motions = state.motions.iter();
        let course: Vec<f64> = motions
            .flat_map(|motion| (motion.inverse().adjoint() * twist).data.0[0])
            .collect();
        let along = PhaseAlong::new(equations, state, &self.name(), &course);
        let along = along.ok_or_else(|| {
            let message = format!("{}: no node moves by it", self.name());
            Error::new(ErrorKind::Value, message)
        })?;
        Ok(Some(Arc::new(along)))
    }
}
