//! What is differentiated: features and peaks of quantities, and free parameters.

use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result};
use crate::quantity::{Dependence, Feature, History, Measurement, Peak, Selection};
use crate::solve::conditions::Free;
use crate::solve::linear::dense::largest;

/// Part of a gradient by multipliers that is rounding.
const ROUNDING: f64 = 1e-9;

/// What depends on parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Dependent {
    /// A feature of a component of a quantity, or of one that has a single component.
    Feature(Selection, Feature),
    /// A peak of the same.
    Peak(Selection, Peak),
    /// The value of a free parameter.
    Free(Free),
}

/// A dependent, found in a system.
#[derive(Debug)]
enum Place {
    Measurement(Measurement),
    /// Number among the free parameters.
    Free(usize),
}

/// All dependents, and what they change with the free parameters at fixed motions.
#[derive(Debug)]
pub(super) struct Found {
    places: Vec<Place>,
    values: Vec<f64>,
    /// By what counts as 1 in each of the free parameters.
    columns: Vec<Vec<f64>>,
}

impl Found {
    /// At a state whose kinematics `equations` have.
    pub fn new(
        dependents: &[Dependent],
        free: &[Free],
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Self> {
        let history = History::of(equations, state);
        let (mut places, mut values) = (Vec::new(), Vec::new());
        for dependent in dependents {
            let measurement = match *dependent {
                Dependent::Feature(of, feature) => {
                    Measurement::new(of.quantity, single(of)?, feature, history.system)?
                }
                Dependent::Peak(of, peak) => peak.of(of.quantity, single(of)?, &history)?,
                Dependent::Free(parameter) => {
                    let number = free.iter().position(|free| *free == parameter);
                    let number = number.ok_or_else(|| {
                        let got = "one that is given";
                        Error::value("dependents", "a parameter that is free", got)
                    })?;
                    places.push(Place::Free(number));
                    values.push(f64::NAN);
                    continue;
                }
            };
            values.push(measurement.value(&history)?);
            places.push(Place::Measurement(measurement));
        }
        Ok(Found {
            places,
            values,
            columns: Vec::new(),
        })
    }

    /// Values of the dependents, of which those of free parameters are given.
    pub fn values(&self, of_free: &[f64]) -> Vec<f64> {
        let all = self.places.iter().zip(&self.values);
        let value = |(place, value): (&Place, &f64)| match *place {
            Place::Measurement(_) => *value,
            Place::Free(number) => of_free[number],
        };
        all.map(value).collect()
    }

    /// Number of the dependents.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Takes what the dependents change with the next of the free parameters.
    pub fn add_column(&mut self, column: Vec<f64>) {
        self.columns.push(column);
    }

    /// Whether any depends on more than the unknowns of the grid, directly.
    pub fn depend_on(&self, parameter: Free) -> bool {
        self.places.iter().any(|place| match place {
            Place::Measurement(measurement) => depends_on(measurement, parameter),
            Place::Free(_) => false,
        })
    }

    /// Values at fixed unknowns, of those that depend on a parameter directly, of others zero;
    /// times are phases of this period.
    pub fn explicit(&self, parameter: Free, history: &History, period: f64) -> Result<Vec<f64>> {
        let values = self.places.iter().map(|place| match place {
            Place::Measurement(measurement) if depends_on(measurement, parameter) => {
                measurement.value_at_phase(history, period)
            }
            _ => Ok(0.0),
        });
        values.collect()
    }

    /// What they vary by with the logarithm of the frequency as times are other phases then.
    pub fn by_phase(&self, history: &History) -> Result<Vec<f64>> {
        let values = self.places.iter().map(|place| match place {
            Place::Measurement(measurement) => measurement.by_phase(history),
            Place::Free(_) => Ok(0.0),
        });
        values.collect()
    }

    /// Gradients by all scaled unknowns, free parameters behind those of the grid; kinematics of
    /// `equations` are those of `state`.
    ///
    /// # Errors
    /// [`ErrorKind::NotAvailable`] of one that depends on how constraints that depend on each other
    /// share what they bear.
    pub fn rows(&self, equations: &Collocation, state: &GridState) -> Result<Vec<Vec<f64>>> {
        let layout = equations.layout();
        let scalars = layout.scalars();
        let row = |(index, place): (usize, &Place)| {
            let mut row = vec![0.0; layout.size()];
            match place {
                Place::Free(number) => {
                    let place = scalars.start + number;
                    row[place] = equations.column_scale()[place];
                }
                Place::Measurement(measurement) => {
                    measurement.add_gradient(equations, state, &mut row)?;
                    let scaled = row.iter_mut().zip(equations.column_scale());
                    scaled.for_each(|(x, scale)| *x *= scale);
                    require_determined(measurement, &row, equations, state)?;
                    for (place, column) in scalars.clone().zip(&self.columns) {
                        row[place] = column[index];
                    }
                }
            }
            Ok(row)
        };
        self.places.iter().enumerate().map(row).collect()
    }
}

/// The only component of what is selected.
fn single(of: Selection) -> Result<usize> {
    match of.component {
        Some(component) => Ok(component),
        None if of.quantity.components() == 1 => Ok(0),
        None => {
            let expected = "a component of a quantity that has several";
            Err(Error::value("dependents", expected, "all of them"))
        }
    }
}

fn depends_on(measurement: &Measurement, parameter: Free) -> bool {
    match measurement.dependence() {
        Dependence::Nothing => false,
        Dependence::Period => parameter == Free::Frequency,
        Dependence::Parameters => true,
    }
}

/// Checks that what is left open by constraints that depend on each other has no part in a scaled
/// gradient.
fn require_determined(
    measurement: &Measurement,
    row: &[f64],
    equations: &Collocation,
    state: &GridState,
) -> Result<()> {
    if !equations.is_regularised() {
        return Ok(());
    }
    let own = equations.layout().own();
    // As if they were multipliers, which are divided by their units to be compared.
    let units = &equations.column_scale()[own.clone()];
    let with_units = row[own].iter().zip(units);
    let gradient: Vec<f64> = with_units.map(|(x, unit)| x * unit).collect();
    let mut determined = state.clone();
    determined.multipliers.clone_from(&gradient);
    let mut equations = equations.clone();
    equations.reduce_to_least_norm(&mut determined)?;
    let pairs = gradient.iter().zip(&determined.multipliers).zip(units);
    let left: Vec<f64> = pairs.map(|((x, y), unit)| (x - y) / unit).collect();
    if largest(&left) <= ROUNDING * largest(row) {
        return Ok(());
    }
    let message = format!(
        "the {measurement} depends on how constraints that depend on each other share what they \
         bear, which the equations leave open: it has no sensitivities"
    );
    Err(Error::new(ErrorKind::NotAvailable, message))
}
