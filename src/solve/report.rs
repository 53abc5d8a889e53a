//! How Newton's method went: outcome, iterations, and the time that they took.

use crate::error::{Error, Result, require_positive_number};
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// How a solve ended. Only [`Outcome::Converged`] and [`Outcome::ToleranceNotMet`] are solutions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    /// The last increment is below the tolerance.
    Converged,
    /// The iteration limit was reached.
    IterationLimit,
    /// No step along the Newton direction brings progress.
    Stalled,
    /// The Jacobian is singular: something is free to move.
    Singular,
    /// The progress callback asked to stop.
    Cancelled,
    /// No initial guess could be found.
    NoInitialGuess,
    /// Constraints that depend on each other contradict each other: the mechanism is locked.
    Inconsistent,
    /// A joint has closed turned over, its axes against each other.
    WrongAssembly,
    /// All work was done that options allow.
    WorkLimit,
    /// Newton's method has converged on the last grid, but the estimated error misses the
    /// tolerance.
    ToleranceNotMet,
}

impl Outcome {
    /// Whether the equations are satisfied at the grid points.
    pub fn is_solution(self) -> bool {
        matches!(self, Outcome::Converged | Outcome::ToleranceNotMet)
    }

    /// Whether it leaves no reason to try something else.
    pub(crate) fn is_final(self) -> bool {
        matches!(self, Outcome::Converged | Outcome::Inconsistent) || self.is_stopped()
    }

    /// Whether work has ended before its end.
    pub(crate) fn is_stopped(self) -> bool {
        matches!(self, Outcome::Cancelled | Outcome::WorkLimit)
    }
}

/// One iteration, as reported to the progress callback and kept in the history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Iteration {
    /// Number of the iteration, from 1.
    pub number: usize,
    /// Largest residual before the step: forces relative to the characteristic force, constraints
    /// to the characteristic length.
    pub residual: f64,
    /// Largest increment of a motion: displacements relative to the characteristic length, turns in
    /// radians. An iteration that uses the Jacobian of the one before takes several; this is the
    /// last.
    pub increment: f64,
    /// Fraction of the increment that was taken.
    pub step: f64,
}

impl Iteration {
    /// None at all.
    pub(crate) fn none() -> Self {
        Iteration {
            number: 0,
            residual: 0.0,
            increment: 0.0,
            step: 1.0,
        }
    }
}

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub struct NewtonOptions {
    /// Largest increment of a converged solution.
    pub tolerance: f64,
    /// Most iterations.
    pub iteration_limit: usize,
}

impl NewtonOptions {
    pub(crate) fn validate(&self) -> Result<()> {
        require_positive_number("options.tolerance", self.tolerance)?;
        if self.iteration_limit == 0 {
            return Err(Error::value("options.iteration_limit", "at least 1", 0));
        }
        Ok(())
    }
}

/// Time spent, by kind of work.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Timings {
    /// Elements and assembly: residuals and Jacobians.
    pub assembly: Duration,
    /// Symbolic analysis.
    pub analysis: Duration,
    /// Numeric factorisation of whole Jacobians.
    pub factorisation: Duration,
    /// Preconditioners, without the system of joints that turn.
    #[serde(default)]
    pub preconditioner: Duration,
    /// That system, assembled and factored.
    #[serde(default)]
    pub interface: Duration,
    /// Forward and backward substitution, or iteration.
    pub substitution: Duration,
    /// Error estimates, and why a Jacobian is singular.
    #[serde(default)]
    pub estimates: Duration,
}

impl Timings {
    /// All of it.
    pub fn sum(&self) -> Duration {
        self.assembly
            + self.analysis
            + self.factorisation
            + self.preconditioner
            + self.interface
            + self.substitution
            + self.estimates
    }
}

impl std::ops::Add for Timings {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Timings {
            assembly: self.assembly + other.assembly,
            analysis: self.analysis + other.analysis,
            factorisation: self.factorisation + other.factorisation,
            preconditioner: self.preconditioner + other.preconditioner,
            interface: self.interface + other.interface,
            substitution: self.substitution + other.substitution,
            estimates: self.estimates + other.estimates,
        }
    }
}

/// Outcome and history of a Newton solve.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct NewtonReport {
    /// How it ended.
    pub outcome: Outcome,
    /// All iterations.
    pub iterations: Vec<Iteration>,
    /// Why it ended so, where there is more to say.
    pub explanation: String,
}

impl NewtonReport {
    /// Of a solve that has ended before its first iteration.
    pub(crate) fn ended(outcome: Outcome, explanation: String) -> Self {
        NewtonReport {
            outcome,
            iterations: Vec::new(),
            explanation,
        }
    }

    /// How it ended and why.
    pub(crate) fn describe(&self) -> String {
        format!("{}; {}", self.outcome.describe(), self.explanation)
    }
}

/// Adds the time of `work` to `total`.
pub(crate) fn timed<T>(total: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *total += start.elapsed();
    result
}
