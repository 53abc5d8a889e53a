//! Free parameters and conditions, as scalar unknowns and equations of the grid.

use super::Condition;
use crate::collocation::{Collocation, GridState, ScalarEquations};
use crate::error::{Error, ErrorKind, Result, require_positive_number};
use crate::model::Model;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A parameter that is free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Free {
    /// The circular frequency `Ω = 2π/T`.
    Frequency,
    /// A parameter of the model.
    Parameter(usize),
}

impl Free {
    /// What it is called in messages.
    pub fn name(self, model: &Model) -> String {
        match self {
            Free::Frequency => "the frequency".into(),
            Free::Parameter(id) => match model.parameters().get(id) {
                Some(parameter) => format!("the parameter \"{}\"", parameter.name),
                None => format!("parameter {id}"),
            },
        }
    }

    /// Its value in a model of this period.
    pub fn value(self, model: &Model, period: f64) -> Result<f64> {
        match self {
            Free::Frequency => Ok(TAU / period),
            Free::Parameter(id) => Ok(model.require_parameter(id)?.value),
        }
    }
}

/// Free parameters of a model and as many conditions.
#[derive(Debug, Clone)]
pub(crate) struct Conditioned {
    /// With the values of the parameters that are not free, for the period of the system.
    model: Arc<Model>,
    free: Arc<[Free]>,
    scales: Arc<[f64]>,
    conditions: Vec<Arc<dyn Condition>>,
}

impl Conditioned {
    /// Of a model on a period.
    ///
    /// # Errors
    /// If a free parameter is none, is named twice or moves nothing, or if the frequency is free
    /// and the model is one for a single period.
    pub fn new(model: &Model, period: f64, free: &[Free]) -> Result<Self> {
        let mut scales = Vec::new();
        for (i, one) in free.iter().enumerate() {
            if free[..i].contains(one) {
                let got = format!("{} twice", one.name(model));
                return Err(Error::value("free", "different parameters", got));
            }
            scales.push(match *one {
                Free::Frequency => {
                    model.require_functions_of_phase()?;
                    TAU / period
                }
                Free::Parameter(id) => {
                    let parameter = model.require_parameter(id)?;
                    if parameter.targets().is_empty() {
                        let message = format!("free: {} moves nothing", one.name(model));
                        return Err(Error::new(ErrorKind::Value, message));
                    }
                    parameter.scale
                }
            });
        }
        Ok(Conditioned {
            model: Arc::new(model.clone()),
            free: free.into(),
            scales: scales.into(),
            conditions: Vec::new(),
        })
    }

    /// The same with these conditions for a solve from `state`, whose kinematics `equations` has.
    ///
    /// # Errors
    /// If they are not as many as the free parameters, or cannot be met from there.
    pub fn under(
        &self,
        conditions: &[Arc<dyn Condition>],
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Self> {
        if conditions.len() != self.free.len() {
            let expected = format!("as many as there are free parameters ({})", self.free.len());
            return Err(Error::size("conditions", expected, conditions.len()));
        }
        let started = conditions.iter().map(|condition| {
            let other = condition.at_start(equations, state)?;
            Ok(other.unwrap_or_else(|| condition.clone()))
        });
        Ok(Conditioned {
            conditions: started.collect::<Result<_>>()?,
            ..self.clone()
        })
    }

    /// Values of the free parameters before a solve.
    pub fn values(&self, period: f64) -> Result<Vec<f64>> {
        let values = self.free.iter().map(|free| free.value(&self.model, period));
        values.collect()
    }

    /// The free parameters.
    pub fn free(&self) -> &[Free] {
        &self.free
    }

    /// The model, with the values that it began with.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// What the free parameters are called in messages.
    pub fn unknown_names(&self) -> Vec<String> {
        self.free
            .iter()
            .map(|free| free.name(&self.model))
            .collect()
    }

    /// What they are called in tables.
    pub fn short_names(&self) -> Vec<String> {
        let short = |free: &Free| match *free {
            Free::Frequency => "frequency".to_string(),
            Free::Parameter(id) => self.model.parameters()[id].name.clone(),
        };
        self.free.iter().map(short).collect()
    }

    /// The period with these values of the free parameters, where that of the system is `period`.
    pub fn period_at(&self, values: &[f64], period: f64) -> f64 {
        let mut all = self.free.iter().zip(values);
        let frequency = all.find(|(free, _)| **free == Free::Frequency);
        frequency.map_or(period, |(_, frequency)| TAU / frequency)
    }

    /// The model and the period with these values of the free parameters, where those of the
    /// system are of `period`.
    ///
    /// # Errors
    /// If a value is impossible.
    pub fn model_at(&self, values: &[f64], period: f64) -> Result<(Model, f64)> {
        let mut found = ((*self.model).clone(), period);
        for (free, &value) in self.free.iter().zip(values) {
            match *free {
                Free::Frequency => {
                    let other = TAU / require_frequency(value)?;
                    found = (found.0.stretched(other / found.1)?, other);
                }
                Free::Parameter(id) => found.0.set_parameter(id, value)?,
            }
        }
        Ok(found)
    }
}

fn require_frequency(value: f64) -> Result<f64> {
    require_positive_number("frequency", value)?;
    Ok(value)
}

impl ScalarEquations for Conditioned {
    fn scales(&self) -> Vec<f64> {
        self.scales.to_vec()
    }

    fn apply(&self, values: &[f64], equations: &mut Collocation) -> Result<()> {
        let is_new = |i: usize| equations.applied_scalars().get(i) != Some(&values[i]);
        let is_parameter = |i: &usize| matches!(self.free[*i], Free::Parameter(_));
        let moves = (0..values.len()).filter(is_parameter).any(is_new);
        let frequency = self.free.iter().position(|free| *free == Free::Frequency);
        if let Some(i) = frequency.filter(|&i| is_new(i)) {
            equations.set_period(TAU / require_frequency(values[i])?)?;
        }
        if moves {
            let mut model = (*self.model).clone();
            for (free, &value) in self.free.iter().zip(values) {
                if let Free::Parameter(id) = *free {
                    model.set_parameter(id, value)?;
                }
            }
            let system = equations.system().with_values_of(&model)?;
            equations.set_system(Arc::new(system))?;
        }
        Ok(())
    }

    fn moves_frequency(&self, state: &GridState, index: usize) -> Option<f64> {
        let is_frequency = self.free[index] == Free::Frequency;
        is_frequency.then(|| self.scales[index] / state.scalars[index])
    }

    fn residual(&self, equations: &Collocation, state: &GridState, out: &mut [f64]) -> Result<()> {
        for (out, condition) in out.iter_mut().zip(&self.conditions) {
            let value = condition.value(equations, state);
            let value = value.map_err(|e| e.within(condition.name()))?;
            *out = value / condition.scale(equations);
        }
        Ok(())
    }

    fn gradient(
        &self,
        equations: &Collocation,
        state: &GridState,
        index: usize,
        row: &mut [f64],
    ) -> Result<()> {
        let condition = &self.conditions[index];
        let found = condition.gradient(equations, state, row);
        found.map_err(|e| e.within(condition.name()))?;
        let scale = condition.scale(equations);
        let scaled = row.iter_mut().zip(equations.column_scale());
        scaled.for_each(|(x, unit)| *x *= unit / scale);
        Ok(())
    }

    fn describe_unknown(&self, index: usize) -> String {
        self.free[index].name(&self.model)
    }

    fn describe_equation(&self, index: usize) -> String {
        self.conditions[index].name()
    }
}
