//! Values of quantities at the times of a motion, and series through them.

use super::history::History;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{PeriodicSeries, SpectralFilter, TimeGrid};

/// Values at the points of a grid, or at the steps of a trajectory.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    /// Of each component.
    pub columns: Vec<Vec<f64>>,
    /// Growth of all of them in a unit of time, over a grid.
    pub rate: f64,
    /// What is asked for is the derivative of this order of the series through them, over a grid.
    pub order: u32,
    /// Derivatives in time of the only component at the steps of a trajectory, where they are known
    /// as well.
    pub slopes: Option<Vec<f64>>,
}

impl Samples {
    /// What `values` appends at each time.
    ///
    /// # Errors
    /// Those of `values`, or if one is not a number.
    pub fn at_each(
        history: &History,
        components: usize,
        mut values: impl FnMut(usize, &mut Vec<f64>) -> Result<()>,
    ) -> Result<Self> {
        let mut columns = vec![Vec::new(); components];
        let mut row = Vec::with_capacity(components);
        for k in 0..history.points() {
            row.clear();
            values(k, &mut row)?;
            require_numbers("samples", &row)?;
            for (column, x) in columns.iter_mut().zip(&row) {
                column.push(*x);
            }
        }
        Ok(Samples {
            columns,
            ..Samples::default()
        })
    }

    /// Of one component.
    pub fn of_one(values: Vec<f64>) -> Self {
        Samples {
            columns: vec![values],
            ..Samples::default()
        }
    }

    /// A component alone.
    pub fn component(mut self, component: usize) -> Self {
        Samples {
            columns: vec![self.columns.swap_remove(component)],
            ..self
        }
    }

    /// Fourier series of each component, seen through a filter.
    pub fn series(&self, grid: TimeGrid, filter: Option<&SpectralFilter>) -> Vec<PeriodicSeries> {
        let columns = self.columns.iter();
        columns
            .map(|values| {
                let series = PeriodicSeries::interpolate(grid, values, self.rate);
                let series = match filter {
                    Some(filter) => series.filtered(filter),
                    None => series,
                };
                (0..self.order).fold(series, |series, _| series.differentiated())
            })
            .collect()
    }
}

/// Passes values that are numbers: absurd models may converge, yet strain beyond any.
///
/// # Errors
/// [`ErrorKind::Overflow`].
pub(crate) fn require_numbers(what: &str, values: &[f64]) -> Result<()> {
    if values.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    let message = format!("{what}: the result is too large to be a number");
    Err(Error::new(ErrorKind::Overflow, message))
}
