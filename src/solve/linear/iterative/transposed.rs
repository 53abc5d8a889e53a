//! The transposed equations by iteration, preconditioned by the transpose of what preconditions the
//! equations (docs/theory.md, section 13.9).

use super::factors::Factors;
use super::interface::Bounds;
use super::{GmresOptions, Iterative, KEPT, Parts, Preconditioned, RESTART, gmres, is_enough};
use crate::collocation::{Collocation, Tangent};
use crate::error::Result;
use crate::solve::report::{Timings, timed};
use crate::work::PRODUCT;

/// What preconditions the transposed equations, and the size of stress resultants in them, once
/// that is known.
pub(super) struct Transposed {
    factors: Factors,
    scale: Option<f64>,
}

struct Operator<'a> {
    equations: &'a Collocation,
    tangent: &'a Tangent,
    factors: &'a mut Factors,
}

impl Preconditioned for Operator<'_> {
    fn product(&mut self, x: &[f64], y: &mut [f64]) {
        let numbers = self.equations.layout().motions().len() as f64;
        self.equations.workers().work().spend(PRODUCT * numbers);
        self.tangent.apply_transposed(self.equations, x, y);
    }

    fn precondition(&mut self, y: &mut [f64]) {
        self.factors.apply(y, self.equations.size());
    }
}

impl Iterative {
    /// Factors the transpose of the preconditioner in use. `false` if that cannot be done.
    fn prepare_transposed(&mut self, equations: &Collocation) -> Result<bool> {
        if self.transposed.is_some() {
            return Ok(true);
        }
        let Some(&(preconditioner, _)) = self.candidates.first() else {
            return Ok(false);
        };
        let bounds = Bounds {
            most_work: f64::INFINITY,
            any_band: true,
            left_out: self.left_out,
        };
        let factors = Factors::new(equations, &self.tangent, preconditioner, (bounds, true))?;
        self.record.factorisations += usize::from(factors.is_some());
        self.transposed = factors.map(|factors| Transposed {
            factors,
            scale: None,
        });
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
        let prepared = timed(&mut timings.preconditioner, || {
            self.prepare_transposed(equations)
        })?;
        let (true, Some(transposed)) = (prepared, &mut self.transposed) else {
            return Ok(false);
        };
        let size = equations.size();
        let resultants = match &transposed.factors {
            Factors::Body(_) => self.tangent.resultants(),
            Factors::Local(_) => 0,
        };
        let mut unknowns = rhs.to_vec();
        unknowns.resize(size + resultants, 0.0);
        // That of the equations themselves, which comes back.
        let plain = self.tangent.resultant_scale();
        match transposed.scale {
            Some(scale) => self.tangent.set_resultant_scale(scale),
            None => {
                self.tangent.set_resultant_scale(1.0);
                let factors = &mut transposed.factors;
                factors.scale_resultants(&mut self.tangent, &unknowns, size);
                transposed.scale = Some(self.tangent.resultant_scale());
            }
        }
        let options = GmresOptions {
            tolerance: accuracy,
            leading: equations.layout().motions().end,
            iteration_limit: self.limit,
            essential: size,
            parts: Parts::of(self.slenderness, accuracy),
            restart: (KEPT / size_of_val(&unknowns[..])).clamp(RESTART, self.limit.max(RESTART)),
        };
        let mut operator = Operator {
            equations,
            tangent: &self.tangent,
            factors: &mut transposed.factors,
        };
        let (workers, workspace) = (equations.workers(), &mut self.workspace);
        let end = timed(&mut timings.substitution, || {
            gmres(&mut operator, &mut unknowns, &options, workers, workspace)
        });
        self.tangent.set_resultant_scale(plain);
        let end = end?;
        self.record.products.push(end.iterations);
        self.count_bytes(end.iterations.min(options.restart), unknowns.len());
        equations.workers().pulse()?;
        rhs.copy_from_slice(&unknowns[..size]);
        let solved = end.error <= accuracy || end.stagnated && is_enough(equations, end.error);
        Ok(solved && rhs.iter().all(|x| x.is_finite()))
    }
}
