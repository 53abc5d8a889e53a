//! Where Newton's method may begin, and what came of it.

use super::report::Outcome;
use crate::collocation::GridState;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::time::Duration;

/// A way to start Newton's method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Start {
    /// Equilibrium at each time, without velocities.
    QuasiStatic,
    /// Equilibrium at each time of what turns steadily with its drives, with its centrifugal and
    /// gyroscopic forces.
    SteadyRotation,
    /// All that hangs on drives turned with them, undeformed.
    RigidRotation,
    /// The quasi-static motion, and inertial forces that are raised in steps.
    RaisedInertia,
    /// A march in time, from the quasi-static motion or rigid rotation, with strong numerical
    /// dissipation.
    March,
    /// The quasi-static motion, and damping of all momenta that is taken away in steps.
    LoweredDamping,
    /// The reference configuration, and loads and prescribed motions that are raised in steps.
    RaisedLoads,
}

impl Start {
    /// Whether it is one state, from which Newton's method is tried.
    pub(crate) fn is_quick(&self) -> bool {
        match self {
            Start::QuasiStatic | Start::SteadyRotation | Start::RigidRotation => true,
            Start::RaisedInertia | Start::March | Start::LoweredDamping | Start::RaisedLoads => {
                false
            }
        }
    }

    /// What it is, for people.
    pub fn describe(self) -> &'static str {
        match self {
            Start::QuasiStatic => "the quasi-static motion",
            Start::SteadyRotation => "the quasi-static motion in steady rotation",
            Start::RigidRotation => "rigid rotation",
            Start::RaisedInertia => "raising inertial forces from the quasi-static motion",
            Start::March => "a dissipative march in time",
            Start::LoweredDamping => "added damping that is taken away in steps",
            Start::RaisedLoads => "raising loads from the reference configuration",
        }
    }
}

/// What came of a way to start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// The way.
    pub start: Start,
    /// Number of grid points.
    pub points: usize,
    /// Newton iterations at single instants, to find the start.
    pub guess_iterations: usize,
    /// Newton iterations on the grid.
    pub iterations: usize,
    /// Time that it took.
    pub time: Duration,
    /// How it ended.
    pub outcome: Outcome,
    /// Why it was left.
    pub explanation: String,
}

impl fmt::Display for Attempt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} on {} points, {} and {} iterations, {:.3} s: {}",
            self.start.describe(),
            self.points,
            self.guess_iterations,
            self.iterations,
            self.time.as_secs_f64(),
            self.outcome.describe()
        )?;
        if self.outcome.is_solution() || self.explanation.is_empty() {
            return Ok(());
        }
        write!(f, " ({})", self.explanation)
    }
}

/// Where Newton starts.
#[derive(Debug, Clone, Default)]
pub enum InitialGuess {
    /// Found by the library.
    #[default]
    Default,
    /// Found in this way alone.
    By(Start),
    /// These states at the points of the grid; of the first, if grids are adapted.
    State(GridState),
}
