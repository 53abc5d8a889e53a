//! What Newton's method asks of a solver of its linear equations.

use crate::collocation::{Collocation, GridState, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::diagnosis::Singularity;
use crate::solve::linear::iterative::IterativeRecord;
use crate::solve::report::Timings;

/// Accuracy of linear solves, relative to the increment: far from the solution and of simplified
/// increments.
pub(crate) const COARSE: f64 = 1e-4;
/// Of those that estimate errors.
pub(crate) const ESTIMATE: f64 = 1e-2;

/// Which equations are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// The equations.
    Plain,
    /// The transposed ones.
    Transposed,
}

/// Solver of the linearised equations.
pub(crate) trait LinearSolver {
    /// Makes a state one that a solve can begin at.
    fn prepare(&self, _: &mut Collocation, _: &mut GridState) {}

    /// Whether what is left of the equations at a solution, and was not looked at when that was
    /// found, moves nothing by more than `tolerance`. Where it does, the linear equations are from
    /// now on solved with regard to all of it.
    ///
    /// # Errors
    /// If memory runs out.
    fn is_negligible(
        &mut self,
        _: &Collocation,
        _: &[f64],
        _: f64,
        _: &mut Timings,
    ) -> Result<bool> {
        Ok(true)
    }

    /// Linearises the equations at `state`. `false` if they are singular.
    ///
    /// # Errors
    /// If the equations cannot be evaluated, or memory runs out.
    fn linearise(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool>;

    /// As [`LinearSolver::linearise`], near to where they were linearised last: what only
    /// preconditions an iteration may be kept.
    ///
    /// # Errors
    /// As there.
    fn move_to(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
        timings: &mut Timings,
    ) -> Result<bool> {
        self.linearise(equations, state, timings)
    }

    /// Solves the scaled equations in place; errors relative to the solution may be of the order of
    /// `accuracy`. `false` if that cannot be done.
    ///
    /// # Errors
    /// If memory runs out.
    fn solve(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        accuracy: f64,
        timings: &mut Timings,
    ) -> Result<bool>;

    /// Error of a solution that was to be so accurate, relative to it, as far as is known.
    fn error_of(&self, accuracy: f64) -> f64 {
        accuracy
    }

    /// Accuracy to which solutions precondition an iteration with exact products that would else
    /// take this one: as rough as spares it nothing, or little, if all of them are found alike.
    fn preconditions_at(&self, accuracy: f64) -> f64 {
        accuracy
    }

    /// As [`LinearSolver::solve`], the transposed equations; factors do as far as they can. `false`
    /// also if there is no way to.
    ///
    /// # Errors
    /// If memory runs out.
    fn solve_transposed(
        &mut self,
        _: &mut Collocation,
        _: &mut [f64],
        _: f64,
        _: &mut Timings,
    ) -> Result<bool> {
        Ok(false)
    }

    /// The equations where they were linearised last, if they are kept to be multiplied with.
    fn tangent(&mut self) -> Option<&mut Tangent> {
        None
    }

    /// As [`LinearSolver::solve`], the equations between borders, which stand for those of the last
    /// linearisation, by iteration on all at once, or by factors of all. None if the equations are
    /// not solved so.
    ///
    /// # Errors
    /// If memory runs out.
    fn solve_bordered(
        &mut self,
        _: &mut Collocation,
        _: &Borders,
        _: &mut [f64],
        _: f64,
        _: &mut Timings,
    ) -> Result<Option<bool>> {
        Ok(None)
    }

    /// Whether the compliance of constraints that may depend on each other is in the solutions of
    /// the last linearisation.
    fn has_compliance(&self) -> bool {
        true
    }

    /// Whether [`LinearSolver::linearise_bordered`] makes factors of the equations with their
    /// borders.
    fn factors_borders(&self) -> bool {
        false
    }

    /// From now on makes these, if it can, even where factors of fewer unknowns serve equations
    /// without borders.
    fn insist_on_borders(&mut self, _: &Collocation) {}

    /// As [`LinearSolver::linearise`], with the borders, of which it makes the columns of the
    /// frequency. None if there are no factors of both.
    ///
    /// # Errors
    /// As there.
    fn linearise_bordered(
        &mut self,
        _: &mut Collocation,
        _: &GridState,
        _: &mut Borders,
        _: &mut Timings,
    ) -> Result<Option<bool>> {
        Ok(None)
    }

    /// Substitutes in place by factors with borders of the last linearisation. None if there are
    /// none; `false` if the result is not finite.
    fn substitute_bordered(&mut self, _: &mut [f64], _: Side, _: &mut Timings) -> Option<bool> {
        None
    }

    /// What iteration took, if any was tried.
    fn iteration(&self) -> Option<&IterativeRecord> {
        None
    }

    /// Gives back memory that is only kept to spare taking it again.
    fn release(&mut self) {}

    /// Size of the inverse of the Jacobian, relative to the Jacobian: about the inverse of the
    /// rounding if it is singular.
    fn growth(&mut self, equations: &mut Collocation) -> f64;

    /// Whether the Jacobian, by which equations were solved, is regular though its growth is that
    /// of a singular one: axial stiffness of slender beams may be all that is so large.
    fn is_resisted(&mut self, _: &mut Collocation) -> bool {
        false
    }

    /// Why the Jacobian at `state`, where it was linearised last, is singular.
    fn explain(&mut self, equations: &mut Collocation, state: &GridState) -> Singularity;
}
