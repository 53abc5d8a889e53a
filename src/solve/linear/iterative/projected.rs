//! Linear equations whose residual is sampled on a finer grid and projected: iteration on the exact
//! Jacobian, with that of the grid's own points for a preconditioner.

use super::gmres::{GmresOptions, GmresWorkspace};
use super::long_vectors::Parts;
use super::outer::{Outer, solve_around};
use crate::collocation::{Collocation, GridState, OversampledTangent};
use crate::error::Result;
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::{Timings, timed};

/// Most products of a linear solve, and vectors that are kept.
const ITERATION_LIMIT: usize = 200;

/// Solves projected equations; those of the grid's own points as `sampled` does.
pub(crate) struct Projected<L> {
    sampled: L,
    /// Where the equations are oversampled.
    tangent: Option<Box<OversampledTangent>>,
    /// Whether the last solve was given up.
    failed: bool,
    workspace: GmresWorkspace,
    /// Products of each linear solve.
    #[cfg(test)]
    products: Vec<usize>,
}

impl<L: LinearSolver> Outer<L> for OversampledTangent {
    fn product(&mut self, _: &Collocation, _: &L, x: &[f64], y: &mut [f64]) {
        self.apply(x, y);
    }

    fn precondition(
        &self,
        (equations, sampled): (&mut Collocation, &mut L),
        y: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        sampled.solve(equations, y, accuracy, timings)
    }
}

impl<L: LinearSolver> Projected<L> {
    /// For `equations`, oversampled or not.
    pub fn new(equations: &Collocation, sampled: L) -> Self {
        let tangent = equations.oversampled().map(OversampledTangent::new);
        Projected {
            sampled,
            tangent: tangent.map(Box::new),
            failed: false,
            workspace: GmresWorkspace::default(),
            #[cfg(test)]
            products: Vec::new(),
        }
    }

    /// The solver of the equations at the grid's own points.
    pub fn sampled(&self) -> &L {
        &self.sampled
    }

    /// The same.
    pub fn sampled_mut(&mut self) -> &mut L {
        &mut self.sampled
    }
}

impl<L: LinearSolver> LinearSolver for Projected<L> {
    fn prepare(&self, equations: &mut Collocation, state: &mut GridState) {
        self.sampled.prepare(equations, state);
    }

    fn is_negligible(
        &mut self,
        equations: &Collocation,
        left: &[f64],
        tolerance: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.sampled
            .is_negligible(equations, left, tolerance, timings)
    }

    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.failed = false;
        self.release();
        if !self.sampled.linearise(equations, state, timings)? {
            return Ok(false);
        }
        if let (Some(tangent), Some(oversampled)) = (&mut self.tangent, equations.oversampled()) {
            timed(&mut timings.assembly, || {
                tangent.evaluate(oversampled, state)
            })?;
        }
        Ok(true)
    }

    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let Some(tangent) = &mut self.tangent else {
            return self.sampled.solve(equations, rhs, accuracy, timings);
        };
        let options = GmresOptions {
            tolerance: accuracy,
            leading: rhs.len(),
            essential: rhs.len(),
            parts: Parts::AsTheyAre,
            iteration_limit: ITERATION_LIMIT,
            restart: ITERATION_LIMIT,
            is_verified: true,
        };
        let of_grid = (equations, &mut self.sampled);
        let workspace = &mut self.workspace;
        let (sampled, end) =
            solve_around(of_grid, &mut **tangent, rhs, &options, timings, workspace)?;
        #[cfg(test)]
        self.products.push(end.iterations);
        // Written so that NaN fails too.
        let accurate = end.error <= accuracy;
        self.failed = sampled && !accurate;
        Ok(sampled && !self.failed && rhs.iter().all(|x| x.is_finite()))
    }

    fn error_of(&self, accuracy: f64) -> f64 {
        match self.tangent {
            Some(_) => accuracy,
            None => self.sampled.error_of(accuracy),
        }
    }

    fn release(&mut self) {
        self.workspace = GmresWorkspace::default();
        self.sampled.release();
    }

    fn has_compliance(&self) -> bool {
        self.sampled.has_compliance()
    }

    fn growth(&mut self, equations: &mut Collocation) -> f64 {
        self.sampled.growth(equations)
    }

    fn is_resisted(&mut self, equations: &mut Collocation) -> bool {
        self.sampled.is_resisted(equations)
    }

    fn explain(&mut self, equations: &mut Collocation, state: &GridState) -> Singularity {
        if self.failed {
            return Singularity::Unsolved(
                "the linear equations of the oversampled residual could not be solved by \
                 iteration with those of \
                 the grid points: the grid may be too coarse for the motion; use more grid points"
                    .to_string(),
            );
        }
        self.sampled.explain(equations, state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::TimeGrid;
    use crate::solve::linear::method::{Linear, LinearMethod};
    use crate::solve::newton::Newton;
    use crate::solve::{PeriodicOptions, solve_periodic};
    use crate::test_models::small::{crank_rocker, one_blade, whirled_beam};

    #[test]
    fn collocation_preconditions_and_convergence_is_quadratic() {
        // Clamped, in a turning frame; mechanisms that turn at 1/260, 1/43 and 1/13 of the
        // coupler's first bending frequency.
        let kinds = [
            (whirled_beam(), 30),
            (one_blade(2), 30),
            (crank_rocker(1, 2, 0.5), 150),
            (crank_rocker(2, 2, 3.0), 180),
            (crank_rocker(1, 2, 10.0), 150),
        ];
        for ((model, period), most) in kinds {
            for points in [9, 15] {
                let options = PeriodicOptions::with_grid_points(points);
                let plain = solve_periodic(&model, period, &options, &mut |_, _| true).unwrap();
                let grid = TimeGrid::new(points, period).unwrap();
                for method in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
                    let mut equations = Collocation::new(plain.system.clone(), grid).unwrap();
                    equations.oversample(2).unwrap();
                    let linear = Projected::new(&equations, Linear::new(&equations, method));
                    let mut newton = Newton::with(equations, linear);
                    let mut state = plain.state.clone();
                    let mut increments: Vec<f64> = Vec::new();
                    for _ in 0..5 {
                        let Newton {
                            equations, linear, ..
                        } = &mut newton;
                        let mut x = vec![0.0; equations.size()];
                        equations.residual(&state, &mut x).unwrap();
                        linear
                            .linearise(equations, &state, &mut Timings::default())
                            .unwrap();
                        let timings = &mut Timings::default();
                        assert!(linear.solve(equations, &mut x, 1e-8, timings).unwrap());
                        let motions = equations.layout().motions();
                        increments.push(x[motions].iter().fold(0.0, |m, x| m.max(x.abs())));
                        if increments.last().is_some_and(|last| *last < 1e-10) {
                            break;
                        }
                        let scaled = x.iter().zip(equations.column_scale());
                        let change: Vec<f64> = scaled.map(|(x, s)| -x * s).collect();
                        state = state.incremented(&plain.system, &change, 1.0);
                    }
                    let products = &newton.linear.products;
                    println!("{points} points, {method:?}: {products:?}, {increments:?}");
                    assert!(products.iter().all(|p| p <= &most), "{products:?}");
                    for pair in increments.windows(2) {
                        // Curvature measured: up to 45. Linear solves leave some 1e-8 of the
                        // increment, and rounding.
                        let bound = 200.0 * pair[0] * pair[0] + 1e-6 * pair[0] + 1e-11;
                        assert!(pair[1] < bound, "{increments:?}");
                    }
                }
            }
        }
    }
}
