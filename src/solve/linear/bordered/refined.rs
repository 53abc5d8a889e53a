//! Solutions to rounding, of the equations and of the transposed ones, for sensitivities: refined
//! by the residual of exact products, with what solves similar equations.

use super::{Bordered, ITERATION_LIMIT};
use crate::collocation::{Collocation, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::dense::largest;
use crate::solve::linear::iterative::{
    GmresOptions, GmresWorkspace, Parts, Preconditioned, SHARPEST, gmres,
};
use crate::solve::linear::solver::{LinearSolver, Side};
use crate::solve::report::Timings;

/// Most refinements.
const REFINEMENTS: usize = 6;
/// Correction, relative to the solution, that is rounding.
const ROUNDING: f64 = 1e-12;
/// What is enough where rounding leaves no less.
const ENOUGH: f64 = 1e-9;
/// Own unknowns so small beside motions are rounding.
const NOTHING: f64 = 1e-14;
/// Accuracy of the corrections of a solution, relative to what makes it rounding, and the coarsest.
const LEFT: f64 = 0.1;
const COARSEST: f64 = 1e-2;
/// What shrinks no more than by this factor stands.
const STANDS: f64 = 0.5;
/// What is left of the right side, relative to it, that is rounding, and what is where it no longer
/// shrinks: of motions that do not follow that makes all there is, which does not contract, and
/// which no iteration finds.
const NOTHING_LEFT: f64 = 1e-14;
const LITTLE_LEFT: f64 = 1e-12;
/// Contraction of corrections above which an iteration takes fewer products.
const SLOW: f64 = 1e-2;
/// Accuracy of that iteration.
const ITERATED: f64 = 1e-9;

struct Operator<'a, L> {
    equations: &'a mut Collocation,
    inner: &'a mut L,
    tangent: &'a mut Tangent,
    borders: &'a Borders,
    /// Whether factors are those of all.
    with_borders: bool,
    side: Side,
    /// Of what solves similar equations.
    accuracy: f64,
    timings: &'a mut Timings,
    /// What went wrong: no solution, or an error.
    end: Result<bool>,
}

impl<L: LinearSolver> Operator<'_, L> {
    fn solve_similar(&mut self, y: &mut [f64]) -> Result<bool> {
        let size = self.equations.size();
        let (equations, timings) = (&mut *self.equations, &mut *self.timings);
        if self.with_borders {
            let substituted = self.inner.substitute_bordered(y, self.side, timings);
            return Ok(substituted == Some(true));
        }
        match self.side {
            Side::Plain => {
                let of_grid = &mut y[..size];
                let solved = self
                    .inner
                    .solve(equations, of_grid, self.accuracy, timings)?;
                self.borders.substitute(y);
                Ok(solved)
            }
            Side::Transposed => {
                self.borders.reduce_transposed(y);
                let of_grid = &mut y[..size];
                let accuracy = self.accuracy;
                (self.inner).solve_transposed(equations, of_grid, accuracy, timings)
            }
        }
    }
}

impl<L: LinearSolver> Preconditioned for Operator<'_, L> {
    fn product(&mut self, x: &[f64], y: &mut [f64]) {
        let (equations, size) = (&*self.equations, self.equations.size());
        let (of_grid, product) = (&x[..size], &mut y[..size]);
        match self.side {
            Side::Plain => self.tangent.apply(equations, of_grid, product),
            Side::Transposed => self.tangent.apply_transposed(equations, of_grid, product),
        }
        super::without_help(equations, self.inner, of_grid, product);
        match self.side {
            Side::Plain => self.borders.product(x, y),
            Side::Transposed => self.borders.transposed_product(x, y),
        }
    }

    fn precondition(&mut self, y: &mut [f64]) {
        if matches!(self.end, Ok(true)) {
            self.end = self.solve_similar(y);
        }
        if !matches!(self.end, Ok(true)) {
            // Which ends the iteration.
            y.fill(0.0);
        }
    }
}

impl<L: LinearSolver> Operator<'_, L> {
    /// Solves in place with what solves similar equations, or by iteration with it where that is
    /// `slow`. `false` if there is no solution.
    fn correct(&mut self, y: &mut [f64], slow: bool, memory: &mut GmresWorkspace) -> Result<bool> {
        let workers = self.equations.workers().clone();
        if slow {
            let motions = self.equations.layout().motions().end;
            gmres(self, y, &iterated(motions, y.len()), &workers, memory)?;
        } else {
            self.precondition(y);
        }
        workers.pulse()?;
        std::mem::replace(&mut self.end, Ok(true))
    }
}

impl<L: LinearSolver> Bordered<L> {
    /// Solves in place, to rounding. `false` if that cannot be done.
    ///
    /// # Errors
    /// If memory runs out, or the solve is to end.
    pub fn solve_to_rounding(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        side: Side,
        timings: &mut Timings,
    ) -> Result<bool> {
        if self.with_borders {
            self.evaluate(equations, timings)?;
        } else if !self.prepare_elimination(equations, SHARPEST, timings)? {
            return Ok(false);
        }
        let own = equations.layout().motions().end..equations.size();
        let mut operator = Operator {
            equations,
            inner: &mut self.inner,
            tangent: &mut self.tangent,
            borders: &self.borders,
            with_borders: self.with_borders,
            side,
            accuracy: SHARPEST,
            timings,
            end: Ok(true),
        };
        let wanted = rhs.to_vec();
        let mut left = largest(&wanted);
        let [nothing, little] = [NOTHING_LEFT, LITTLE_LEFT].map(|part| part * left);
        let mut rest = wanted.clone();
        let (mut product, mut correction) = (vec![0.0; rhs.len()], vec![0.0; rhs.len()]);
        rhs.fill(0.0);
        // Grounded, factors are those of other equations.
        let (mut before, mut slow) = (f64::INFINITY, operator.equations.grounding() > 0.0);
        for _ in 0..REFINEMENTS {
            correction.copy_from_slice(&rest);
            // What is left of a solution to this accuracy is to be found to what makes it rounding.
            operator.accuracy = match slow || before.is_infinite() {
                true => SHARPEST,
                false => {
                    let rest = operator.accuracy * before;
                    (LEFT * ROUNDING / rest).clamp(SHARPEST, COARSEST)
                }
            };
            let solved = operator.correct(&mut correction, slow, &mut self.workspace)?;
            let last = std::mem::replace(&mut left, largest(&rest));
            let is_rounding = left <= nothing || left <= little && left > STANDS * last;
            if !solved {
                return Ok(is_rounding);
            }
            rhs.iter_mut().zip(&correction).for_each(|(x, c)| *x += c);
            let changed = change(&correction, rhs, own.clone());
            if !changed.is_finite() {
                return Ok(is_rounding);
            }
            let stands_still = before <= ENOUGH && changed > STANDS * before;
            let is_noise = is_rounding && changed > STANDS;
            // What the next correction would be, as far as the last one has contracted.
            let next = match slow {
                true => changed,
                false => changed * (changed / before).max(operator.accuracy),
            };
            if changed.min(next) <= ROUNDING || stands_still || is_noise {
                return Ok(true);
            }
            slow |= before.is_finite() && changed > SLOW * before;
            before = changed;
            operator.product(rhs, &mut product);
            let pairs = rest.iter_mut().zip(wanted.iter().zip(&product));
            pairs.for_each(|(rest, (wanted, product))| *rest = wanted - product);
        }
        // Of motions that follow by nothing there is no change that is small beside them.
        Ok(before <= ENOUGH || largest(&rest) <= little)
    }
}

/// How a correction is iterated on, of so many unknowns of motions and so many in all.
fn iterated(motions: usize, unknowns: usize) -> GmresOptions {
    GmresOptions {
        tolerance: ITERATED,
        leading: motions,
        essential: unknowns,
        parts: Parts::AsTheyAre,
        iteration_limit: ITERATION_LIMIT,
        restart: ITERATION_LIMIT,
        is_verified: true,
    }
}

/// Size of a correction, relative to that of the solution; own unknowns by themselves, as they may
/// be of quite another size.
fn change(correction: &[f64], solution: &[f64], own: std::ops::Range<usize>) -> f64 {
    let of_motions = |x: &[f64]| largest(&x[..own.start]).max(largest(&x[own.end..]));
    let part = |change: f64, size: f64| if change == 0.0 { 0.0 } else { change / size };
    let size = of_motions(solution);
    let motions = part(of_motions(correction), size);
    let own_change = largest(&correction[own.clone()]);
    if own_change <= NOTHING * size {
        return motions;
    }
    motions.max(part(own_change, largest(&solution[own])))
}
