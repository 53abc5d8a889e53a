//! The transposed equations by iteration, preconditioned by the transpose of what preconditions the
//! equations (docs/theory.md, section 13.9).
//!
//! From the right, where the equations are preconditioned from the left: what is iterated on is the
//! transpose of `P⁻¹ A`, which is near identity, and not that of `A P⁻¹`, in which stiff directions
//! drown soft ones. What is left then is an error of the gradients, which is the error of a
//! derivative for a change of the motion of size 1.

use super::factors::Factors;
use super::interface::Bounds;
use super::operator::is_solved;
use super::{GmresOptions, Iterative, KEPT, Parts, Preconditioned, Preconditioner, RESTART, gmres};
use crate::collocation::{Collocation, Tangent};
use crate::error::Result;
use crate::solve::report::{Timings, timed};
use crate::work::PRODUCT;

/// `Aᵀ P⁻ᵀ`.
struct Operator<'a> {
    equations: &'a Collocation,
    tangent: &'a Tangent,
    factors: &'a mut Factors,
    preconditioned: Vec<f64>,
}

impl Preconditioned for Operator<'_> {
    fn product(&mut self, x: &[f64], y: &mut [f64]) {
        let numbers = self.equations.layout().motions().len() as f64;
        self.equations.workers().work().spend(PRODUCT * numbers);
        self.preconditioned.copy_from_slice(x);
        self.factors
            .apply(&mut self.preconditioned, self.equations.size());
        self.tangent
            .apply_transposed(self.equations, &self.preconditioned, y);
    }

    fn precondition(&mut self, _: &mut [f64]) {}
}

impl Iterative {
    /// Factors the transpose of the preconditioner in use, or of one of those after it. Gives the
    /// products that a solve may take with it; none if that cannot be done.
    fn prepare_transposed(&mut self, equations: &Collocation) -> Result<Option<usize>> {
        while let Some(&(preconditioner, most)) = self.candidates.get(self.transposed_with) {
            if self.transposed.is_some() || self.factor_transposed(equations, preconditioner)? {
                return Ok(Some(most));
            }
            self.transposed_with += 1;
        }
        Ok(None)
    }

    /// `false` if that cannot be done.
    fn factor_transposed(
        &mut self,
        equations: &Collocation,
        preconditioner: Preconditioner,
    ) -> Result<bool> {
        let bounds = Bounds {
            most_work: f64::INFINITY,
            any_band: true,
            left_out: self.left_out,
        };
        // That of the equations, which the factors are told as they solve.
        let scale = self.tangent.resultant_scale();
        self.tangent.set_resultant_scale(1.0);
        let factors = Factors::new(equations, &self.tangent, preconditioner, (bounds, true));
        self.tangent.set_resultant_scale(scale);
        self.transposed = factors?;
        self.record.factorisations += usize::from(self.transposed.is_some());
        Ok(self.transposed.is_some())
    }

    /// Solves the transposed equations in place.
    pub(super) fn iterate_transposed(
        &mut self,
        equations: &Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let first = self.transposed_with;
        while let Some(most) = timed(&mut timings.preconditioner, || {
            self.prepare_transposed(equations)
        })? {
            if self.iterate_with_transposed(equations, (rhs, most), accuracy, timings)? {
                return Ok(true);
            }
            (self.transposed, self.transposed_with) = (None, self.transposed_with + 1);
        }
        // Another right side may be solved for.
        self.transposed_with = first;
        Ok(false)
    }

    /// The same with the preconditioner that there is, if it takes no more than `most` products;
    /// otherwise the right side stays.
    fn iterate_with_transposed(
        &mut self,
        equations: &Collocation,
        (rhs, most): (&mut [f64], usize),
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool> {
        let Some(factors) = &mut self.transposed else {
            return Ok(false);
        };
        let size = equations.size();
        let resultants = match factors {
            Factors::Body(_) => self.tangent.resultants(),
            Factors::Local(_) => 0,
        };
        let mut unknowns = rhs.to_vec();
        unknowns.resize(size + resultants, 0.0);
        factors.set_resultant_scale(self.tangent.resultant_scale());
        let options = GmresOptions {
            tolerance: accuracy,
            leading: equations.layout().motions().end,
            iteration_limit: most,
            essential: unknowns.len(),
            parts: Parts::AsTheyAre,
            restart: (KEPT / size_of_val(&unknowns[..])).clamp(RESTART, most.max(RESTART)),
            // Who asks for it refines it by the residual.
            is_verified: false,
        };
        let mut operator = Operator {
            equations,
            tangent: &self.tangent,
            factors,
            preconditioned: vec![0.0; unknowns.len()],
        };
        let (workers, workspace) = (equations.workers(), &mut self.workspace);
        let end = timed(&mut timings.substitution, || {
            gmres(&mut operator, &mut unknowns, &options, workers, workspace)
        });
        let end = end?;
        factors.apply(&mut unknowns, size);
        self.record.products.push(end.iterations);
        self.count_bytes(end.iterations.min(options.restart), unknowns.len());
        equations.workers().pulse()?;
        let found = &unknowns[..size];
        let solved = is_solved(&end, accuracy, equations) && found.iter().all(|x| x.is_finite());
        if solved {
            rhs.copy_from_slice(found);
        }
        Ok(solved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::linear::solver::LinearSolver;
    use crate::solve::{Outcome, PeriodicOptions, solve_periodic};
    use crate::test_models::small::{crank_rocker, one_blade};

    /// `yᵀ A x`, with `A x = b` and `Aᵀ y = c`, is `yᵀ b` and `cᵀ x`.
    #[test]
    fn transposed_equations_take_about_as_many_products_as_the_equations() {
        for (model, period) in [one_blade(4), crank_rocker(2, 2, 3.0)] {
            for points in [15, 31] {
                let options = PeriodicOptions::with_grid_points(points);
                let solve = solve_periodic(&model, period, &options, &mut |_, _| true).unwrap();
                assert_eq!(solve.report.outcome, Outcome::Converged);
                let mut equations = Collocation::new(solve.system.clone(), solve.grid).unwrap();
                let wanted = Some(Preconditioner::BodyCirculant);
                let mut iterative = Iterative::new(&equations, wanted);
                let timings = &mut Timings::default();
                let state = &solve.state;
                assert!(iterative.linearise(&mut equations, state, timings).unwrap());
                let noise = |factor: f64| -> Vec<f64> {
                    (0..equations.size())
                        .map(|i| (factor * i as f64).sin())
                        .collect()
                };
                let (b, c) = (noise(0.7), noise(1.3));
                let (mut x, mut y) = (b.clone(), c.clone());
                assert!(
                    iterative
                        .solve(&mut equations, &mut x, 1e-9, timings)
                        .unwrap()
                );
                assert!(
                    iterative
                        .solve_transposed(&mut equations, &mut y, 1e-9, timings)
                        .unwrap()
                );
                let [plain, transposed] = iterative.record.products[..] else {
                    panic!("{:?}", iterative.record.products);
                };
                assert!(transposed <= plain + plain / 2, "{plain} {transposed}");
                let sum = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
                let size = (sum(&y, &y) * sum(&b, &b)).sqrt();
                let (found, expected) = (sum(&y, &b), sum(&c, &x));
                assert!(
                    (found - expected).abs() < 1e-7 * size,
                    "{found} {expected} {size}"
                );
            }
        }
    }
}
