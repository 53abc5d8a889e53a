//! What tests of the linear solvers share.

use crate::collocation::{Collocation, GridState, Pattern, Tangent};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::Condition;
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

    /// Checks the gradient of a condition by motions, at a state where everything has moved,
    /// against differences of the fourth order.
    pub fn check_gradient(&mut self, condition: &dyn Condition) {
        let size = self.equations.size();
        let equations = &mut self.equations;
        let system = equations.system().clone();
        let wave: Vec<f64> = (0..size).map(|i| 0.02 * (0.9 * i as f64).sin()).collect();
        let state = self.state.incremented(&system, &wave, 1.0);
        equations.update_kinematics(&state);
        let mut row = vec![0.0; size];
        condition.gradient(equations, &state, &mut row).unwrap();
        let scale = row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for i in equations.layout().motions().step_by(7) {
            let mut increment = vec![0.0; size];
            increment[i] = 1.0;
            let mut value = |h: f64| {
                let beside = state.incremented(&system, &increment, h);
                equations.update_kinematics(&beside);
                condition.value(equations, &beside).unwrap()
            };
            let h = 1e-3;
            let far = value(2.0 * h) - value(-2.0 * h);
            let slope = (8.0 * (value(h) - value(-h)) - far) / (12.0 * h);
            let error = (slope - row[i]).abs() / scale;
            assert!(error < 1e-8, "{i}: {slope} {}", row[i]);
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
