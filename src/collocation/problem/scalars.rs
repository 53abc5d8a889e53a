//! Unknowns that belong to no grid point, such as a period or the size of a load, and the equations
//! that determine them.

use super::Collocation;
use crate::collocation::state::GridState;
use crate::error::{Error, Result};
use std::fmt::Debug;
use std::sync::Arc;

/// Step of differences by a scalar unknown, relative to its scale.
const STEP: f64 = 1e-5;

/// Scalar unknowns, and as many equations.
pub trait ScalarEquations: Debug + Send + Sync {
    /// What counts as 1 in each of the unknowns.
    fn scales(&self) -> Vec<f64>;

    /// Gives `equations` these values of the unknowns.
    ///
    /// # Errors
    /// If a value is impossible.
    fn apply(&self, values: &[f64], equations: &mut Collocation) -> Result<()>;

    /// Writes what is left of the scalar equations at `state`, in numbers of the order of scaled
    /// motions. Kinematics of `equations` are those of the state.
    fn residual(&self, equations: &Collocation, state: &GridState, out: &mut [f64]);

    /// Writes the derivatives of scalar equation `index` by all scaled unknowns into `row`, which
    /// is zero, at the places of [`Collocation::layout`].
    fn gradient(&self, equations: &Collocation, state: &GridState, index: usize, row: &mut [f64]);
}

impl Collocation {
    /// From now on has these scalar unknowns and equations behind those of the grid.
    pub fn set_scalars(&mut self, scalars: Arc<dyn ScalarEquations>) {
        let (grid, scales) = (self.size(), scalars.scales());
        self.row_scale.truncate(grid);
        self.row_scale.resize(grid + scales.len(), 1.0);
        self.column_scale.truncate(grid);
        self.layout = self.layout.with_scalars(scales.len());
        self.column_scale.extend(scales);
        self.scalars = Some(scalars);
    }

    /// Gives the equations of the grid the scalar unknowns of `state`.
    pub fn apply_scalars(&mut self, state: &GridState) -> Result<()> {
        let Some(scalars) = self.scalars.clone() else {
            return Ok(());
        };
        let count = self.layout.scalars().len();
        if state.scalars.len() != count {
            return Err(Error::size("state.scalars", count, state.scalars.len()));
        }
        scalars.apply(&state.scalars, self)
    }

    /// Writes what is left of the scalar equations behind the residual of the grid.
    pub(super) fn scalar_residual(&self, state: &GridState, out: &mut [f64]) {
        if let Some(scalars) = &self.scalars {
            scalars.residual(self, state, &mut out[self.layout.scalars()]);
        }
    }

    /// Derivatives of the scaled residual of the grid by the scaled scalar unknown `index`.
    ///
    /// # Errors
    /// Those of the residual.
    pub fn by_scalar(&mut self, state: &GridState, index: usize) -> Result<Vec<f64>> {
        let size = self.layout.size();
        let step = STEP * self.column_scale[self.layout.scalars().start + index];
        let mut beside = state.clone();
        let mut sides = [vec![0.0; size], vec![0.0; size]];
        for (side, sign) in sides.iter_mut().zip([1.0, -1.0]) {
            beside.scalars[index] = state.scalars[index] + sign * step;
            self.residual(&beside, side)?;
        }
        let [mut column, other] = sides;
        column.truncate(self.size());
        let pairs = column.iter_mut().zip(&other);
        pairs.for_each(|(x, y)| *x = (*x - y) / (2.0 * STEP));
        Ok(column)
    }

    /// Derivatives of the scalar equation `index` by all scaled unknowns.
    pub fn of_scalar_equation(&self, state: &GridState, index: usize) -> Vec<f64> {
        let mut row = vec![0.0; self.layout.size()];
        if let Some(scalars) = &self.scalars {
            scalars.gradient(self, state, index, &mut row);
        }
        row
    }
}
