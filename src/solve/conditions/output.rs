//! What comes out: the mean, a harmonic, or the value at a time, of any output.

use super::{Condition, add_by_parameters};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, Result};
use crate::quantity::{Dependence, Feature, History, Measurement, Selection};

/// A feature of an output has this value: trim.
#[derive(Debug, Clone, Copy)]
pub struct OutputIs {
    /// A component of a quantity, or one that has a single component.
    pub output: Selection,
    /// What is taken of it.
    pub feature: Feature,
    /// Its value.
    pub value: f64,
    /// What counts as 1 in it, a positive number; by default what does in such quantities of the
    /// mechanism.
    pub scale: Option<f64>,
}

impl OutputIs {
    fn measurement(&self, equations: &Collocation) -> Result<Measurement> {
        let component = match self.output.component {
            Some(component) => component,
            None if self.output.components() == 1 => 0,
            None => {
                let expected = "a component of a quantity that has several";
                return Err(Error::value("condition", expected, "all of them"));
            }
        };
        let system = equations.system();
        Measurement::new(self.output.quantity, component, self.feature, system)
    }
}

impl Condition for OutputIs {
    fn name(&self) -> String {
        let Selection {
            quantity,
            component,
        } = self.output;
        let name = quantity.describe(component.unwrap_or(0));
        format!("the {} of {name}", self.feature)
    }

    fn scale(&self, equations: &Collocation) -> f64 {
        let component = self.output.component.unwrap_or(0);
        let scale = self.scale.filter(|x| x.is_finite() && *x > 0.0);
        scale.unwrap_or_else(|| self.output.quantity.scale(component, equations.system()))
    }

    fn value(&self, equations: &Collocation, state: &GridState) -> Result<f64> {
        let history = History::of(equations, state);
        Ok(self.measurement(equations)?.value(&history)? - self.value)
    }

    fn gradient(&self, equations: &Collocation, state: &GridState, row: &mut [f64]) -> Result<()> {
        let measurement = self.measurement(equations)?;
        measurement.add_gradient(equations, state, row)?;
        if measurement.dependence() == Dependence::Nothing {
            return Ok(());
        }
        add_by_parameters(self, equations, state, row)
    }
}
