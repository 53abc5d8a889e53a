//! A parameter that is given.

use super::Condition;
use crate::collocation::{Collocation, GridState};
use crate::error::Result;

/// A free parameter has this value.
#[derive(Debug, Clone)]
pub struct Given {
    /// Place among the free parameters.
    pub free: usize,
    /// The value.
    pub value: f64,
}

impl Condition for Given {
    fn name(&self) -> String {
        format!("the value {} that is given", self.value)
    }

    fn scale(&self, equations: &Collocation) -> f64 {
        equations.column_scale()[equations.layout().scalars().start + self.free]
    }

    fn value(&self, _: &Collocation, state: &GridState) -> Result<f64> {
        Ok(state.scalars[self.free] - self.value)
    }

    fn gradient(&self, equations: &Collocation, _: &GridState, row: &mut [f64]) -> Result<()> {
        row[equations.layout().scalars().start + self.free] += 1.0;
        Ok(())
    }
}
