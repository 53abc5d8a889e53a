//! The matrix `[M Cᵀ; C 0]` at a state, factored.

use super::Initial;
use crate::collocation::{GivenRates, MotionState};
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::marching::{Stop, Tried};
use crate::solve::newton::SINGULAR_GROWTH;
use crate::solve::report::Outcome;
use nalgebra::Vector6;

/// Times that a linear solve is repeated with its residual.
const REFINEMENTS: usize = 3;
/// Inertia lent to nodes that have none, relative to the total mass: it decides on nothing but how
/// they start.
const LENT_MASS: f64 = 1e-3;

impl Initial<'_> {
    pub(super) fn give(&mut self, at: &MotionState) {
        self.newton.equations.set_rule(Box::new(GivenRates {
            twist: at.twist.clone(),
            twist_rate: at.twist_rate.clone(),
            rates: at.rates.clone(),
            weight: self.weight(),
            elastic: self.elastic,
        }));
    }

    /// Accelerations in units of it are of the order of displacements.
    pub(super) fn weight(&self) -> f64 {
        1.0 / (self.step * self.step)
    }

    /// Factors the matrix at a state; says why if it is singular.
    pub(super) fn factor(&mut self, at: &MotionState) -> Tried<()> {
        loop {
            self.give(at);
            let newton = &mut *self.newton;
            newton.linear.assemble(&mut newton.equations, &at.state)?;
            self.lend_mass();
            let newton = &mut *self.newton;
            let factored = newton.linear.factor_all(&newton.equations)?;
            if factored && newton.growth() < SINGULAR_GROWTH {
                return Ok(());
            }
            match newton.linear.explain(&mut newton.equations, &at.state) {
                Singularity::Redundant(_) if !newton.equations.is_regularised() => {
                    newton.equations.regularise();
                }
                Singularity::Free(_) if self.added_mass == 0.0 => {
                    let mass = newton.equations.system().scales().mass;
                    self.added_mass = if mass > 0.0 { LENT_MASS * mass } else { 1.0 };
                }
                Singularity::Free(why)
                | Singularity::Redundant(why)
                | Singularity::Unsolved(why) => {
                    return Err(Stop::Refused((Outcome::Singular, why)));
                }
            }
        }
    }

    /// Adds inertia to each node where some have none, that the matrix be regular.
    fn lend_mass(&mut self) {
        let (mass, motions) = (self.added_mass * self.weight(), self.motions());
        if mass == 0.0 {
            return;
        }
        let newton = &mut *self.newton;
        let length = newton.equations.system().scales().length;
        let scales = (newton.equations.row_scale().iter()).zip(newton.equations.column_scale());
        let inertia = scales.enumerate().map(|(i, (row, column))| match i % 6 {
            0..3 => mass * row * column,
            _ => mass * length * length * row * column,
        });
        let pattern = newton.linear.pattern(&newton.equations);
        let places: Vec<usize> = (0..motions).map(|i| pattern.diagonal(i)).collect();
        for (place, inertia) in places.into_iter().zip(inertia) {
            newton.linear.values[place] += inertia;
        }
    }

    /// Solves with the factored matrix, without what regularises it.
    pub(super) fn solve(&self, rhs: &[f64]) -> Option<Vec<f64>> {
        let newton = &*self.newton;
        let mut solution = vec![0.0; rhs.len()];
        let mut rest = rhs.to_vec();
        for _ in 0..REFINEMENTS {
            if !newton.linear.substitute(&mut rest) {
                return None;
            }
            solution.iter_mut().zip(&rest).for_each(|(x, r)| *x += r);
            rest.copy_from_slice(rhs);
            let pattern = newton.linear.pattern(&newton.equations);
            let columns = pattern.column_pointers().windows(2);
            for (range, x) in columns.zip(&solution) {
                for at in range[0]..range[1] {
                    rest[pattern.row_indices()[at]] -= newton.linear.values[at] * x;
                }
            }
            let regularisation = newton.equations.regularisation();
            if regularisation != 0.0 {
                for i in self.motions()..rest.len() {
                    if !self.is_state(i - self.motions()) {
                        rest[i] -= regularisation * solution[i];
                    }
                }
            }
        }
        Some(solution)
    }

    /// Increments of the nodes in a scaled solution, times `factor`.
    pub(super) fn node_increments(&self, solution: &[f64], factor: f64) -> Vec<Vector6<f64>> {
        let scales = self.newton.equations.column_scale();
        let nodes = solution[..self.motions()].chunks_exact(6);
        nodes
            .zip(scales.chunks_exact(6))
            .map(|(x, scale)| Vector6::from_fn(|i, _| factor * scale[i] * x[i]))
            .collect()
    }
}
