//! What tests of the linear solvers share.

use crate::collocation::{Collocation, GridState, Pattern, Tangent};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::system::System;
use faer::Mat;
use std::sync::Arc;

/// The equations of a model, and their Jacobian, assembled.
pub(crate) struct Linearised {
    pub equations: Collocation,
    pub state: GridState,
    pub pattern: Pattern,
    pub values: Vec<f64>,
}

impl Linearised {
    /// In the reference configuration, with these multipliers.
    pub fn new(
        model: &Model,
        period: f64,
        points: usize,
        multiplier: impl Fn(usize) -> f64,
    ) -> Self {
        let system = Arc::new(System::new(model, period).unwrap());
        let grid = TimeGrid::new(points, period).unwrap();
        let mut state = GridState::reference(&system, grid);
        for (i, value) in state.multipliers.iter_mut().enumerate() {
            *value = multiplier(i);
        }
        let mut equations = Collocation::new(system.clone(), grid).unwrap();
        let pattern = Pattern::new(&system, points);
        let mut values = vec![0.0; pattern.entries()];
        let mut tangent = Tangent::new(&system, points);
        equations
            .jacobian(&state, &pattern, &mut tangent, &mut values)
            .unwrap();
        Linearised {
            equations,
            state,
            pattern,
            values,
        }
    }

    /// The whole Jacobian.
    pub fn dense(&self) -> Mat<f64> {
        let mut matrix = Mat::zeros(self.pattern.size(), self.pattern.size());
        for (column, range) in self.pattern.column_pointers().windows(2).enumerate() {
            for at in range[0]..range[1] {
                matrix[(self.pattern.row_indices()[at], column)] = self.values[at];
            }
        }
        matrix
    }
}
