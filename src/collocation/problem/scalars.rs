//! Unknowns that belong to no grid point, such as a period or the size of a load, and the equations
//! that determine them.

use super::Collocation;
use crate::collocation::state::GridState;
use crate::error::{Error, Result};
use nalgebra::DVector;
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

    /// Derivative of the logarithm of the frequency by the scaled unknown `index` at `state`, where
    /// it moves that alone; what others move is differenced.
    fn moves_frequency(&self, state: &GridState, index: usize) -> Option<f64> {
        let _ = (state, index);
        None
    }

    /// Writes what is left of the scalar equations at `state`, in numbers of the order of scaled
    /// motions. Kinematics of `equations` are those of the state.
    ///
    /// # Errors
    /// If one cannot be evaluated there.
    fn residual(&self, equations: &Collocation, state: &GridState, out: &mut [f64]) -> Result<()>;

    /// Writes the derivatives of scalar equation `index` by all scaled unknowns into `row`, which
    /// is zero, at the places of [`Collocation::layout`].
    ///
    /// # Errors
    /// If it cannot be evaluated there.
    fn gradient(
        &self,
        equations: &Collocation,
        state: &GridState,
        index: usize,
        row: &mut [f64],
    ) -> Result<()>;

    /// What an unknown is called in messages.
    fn describe_unknown(&self, index: usize) -> String {
        format!("scalar unknown {index}")
    }

    /// What an equation is called in messages.
    fn describe_equation(&self, index: usize) -> String {
        format!("scalar equation {index}")
    }
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
        self.applied.clear();
    }

    /// The scalar unknowns and equations.
    pub fn scalars(&self) -> Option<&Arc<dyn ScalarEquations>> {
        self.scalars.as_ref()
    }

    /// Values of the scalar unknowns that the equations have; none before the first.
    pub fn applied_scalars(&self) -> &[f64] {
        &self.applied
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
        if self.applied != state.scalars {
            scalars.apply(&state.scalars, self)?;
            self.applied.clone_from(&state.scalars);
        }
        Ok(())
    }

    /// Writes what is left of the scalar equations behind the residual of the grid.
    pub(super) fn scalar_residual(&self, state: &GridState, out: &mut [f64]) -> Result<()> {
        match &self.scalars {
            Some(scalars) => scalars.residual(self, state, &mut out[self.layout.scalars()]),
            None => Ok(()),
        }
    }

    /// Derivatives of the scaled residual of the grid by the scaled scalar unknown `index`.
    ///
    /// # Errors
    /// Those of the residual.
    pub fn by_scalar(&mut self, state: &GridState, index: usize) -> Result<Vec<f64>> {
        if let Some(factor) = self.moves_frequency(state, index) {
            self.apply_scalars(state)?;
            let mut column = self.by_log_frequency(state)?;
            column.iter_mut().for_each(|x| *x *= factor);
            return Ok(column);
        }
        let size = self.size();
        let step = STEP * self.column_scale[self.layout.scalars().start + index];
        let mut beside = state.clone();
        let mut sides = [vec![0.0; size], vec![0.0; size]];
        for (side, sign) in sides.iter_mut().zip([1.0, -1.0]) {
            beside.scalars[index] = state.scalars[index] + sign * step;
            self.apply_scalars(&beside)?;
            self.residual_of_grid(&beside, side)?;
        }
        let [mut column, other] = sides;
        let pairs = column.iter_mut().zip(&other);
        pairs.for_each(|(x, y)| *x = (*x - y) / (2.0 * STEP));
        Ok(column)
    }

    /// Derivative of the logarithm of the frequency by the scaled scalar unknown `index`, if it
    /// moves that alone.
    pub fn moves_frequency(&self, state: &GridState, index: usize) -> Option<f64> {
        let scalars = self.scalars.as_ref()?;
        scalars.moves_frequency(state, index)
    }

    /// Derivatives of the scalar equation `index` by all scaled unknowns.
    ///
    /// # Errors
    /// If it cannot be evaluated there.
    pub fn of_scalar_equation(&self, state: &GridState, index: usize) -> Result<Vec<f64>> {
        let mut row = vec![0.0; self.layout.size()];
        if let Some(scalars) = &self.scalars {
            scalars.gradient(self, state, index, &mut row)?;
        }
        Ok(row)
    }

    /// Derivatives of the scaled residual of the grid by the logarithm of the frequency: rates are
    /// in proportion to it, accelerations to its square. Signals keep their values at the grid
    /// points.
    ///
    /// # Errors
    /// Those of the residual.
    pub fn by_log_frequency(&mut self, state: &GridState) -> Result<Vec<f64>> {
        self.update_kinematics(state);
        let mut out = vec![0.0; self.size()];
        let points = self.grid.points();
        for placed in self.system.elements() {
            let nodes = placed.element.nodes();
            for k in 0..points {
                let workspace = &mut self.with_tangents;
                let tangents = self.instants.evaluate(placed, k, state, workspace)?;
                let mut rates = DVector::zeros(6 * nodes.len());
                let mut accelerations = rates.clone();
                for (b, &node) in nodes.iter().enumerate() {
                    let at = &self.instants.states[node * points + k];
                    rates.fixed_rows_mut::<6>(6 * b).copy_from(&at.twist);
                    let mut rows = accelerations.fixed_rows_mut::<6>(6 * b);
                    rows.copy_from(&at.twist_rate);
                }
                let forces = &tangents.damping * &rates + &tangents.mass * accelerations * 2.0;
                for (force, &node) in forces.as_slice().chunks_exact(6).zip(nodes) {
                    let rows = &mut out[self.layout.motion(node, k)];
                    rows.iter_mut().zip(force).for_each(|(row, f)| *row += f);
                }
                if placed.has_states {
                    let own = &self.instants.rates[placed.own_at(points, k)];
                    let mut own = &tangents.own_rate * DVector::from_column_slice(own);
                    if placed.has_feedback {
                        own += &tangents.gradient_rate * &rates;
                    }
                    out[self.layout.element_at(placed, k)].copy_from_slice(own.as_slice());
                }
            }
        }
        let scaled = out.iter_mut().zip(&self.row_scale);
        scaled.for_each(|(x, scale)| *x *= scale);
        Ok(out)
    }
}
