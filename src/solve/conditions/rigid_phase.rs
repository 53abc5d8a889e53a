//! What tells where a motion is that could as well be elsewhere: turned about an axis, or moved.

use super::phase::{PhaseAlong, unknown_start};
use super::{Condition, RigidMotion};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result};
use std::sync::Arc;

/// The motion is not moved in this way from that which the solve starts from: in the mean over the
/// period and all nodes. For mechanisms that nothing holds against it.
#[derive(Debug, Clone)]
pub struct RigidPhase(pub RigidMotion);

impl Condition for RigidPhase {
    fn name(&self) -> String {
        match self.0.is_translation {
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
        let twist = match self.0.is_translation {
            true => self.0.twist * equations.system().scales().length,
            false => self.0.twist,
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
