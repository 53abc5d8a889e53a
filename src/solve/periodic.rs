//! The periodic solve from model to solution.

use super::guess::quasi_static;
use super::newton::{Iteration, Newton, NewtonOptions, NewtonReport, Outcome, Timings};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::system::System;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What the solver is doing, as told to the progress callback.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Finding the initial guess.
    InitialGuess,
    /// Newton iterations of the periodic problem.
    Newton,
}

/// Where Newton starts.
#[derive(Debug, Clone, Default)]
pub enum InitialGuess {
    /// Found by the library.
    #[default]
    Default,
    /// These states at the grid points.
    State(GridState),
}

/// Options of a periodic solve.
#[derive(Debug, Clone)]
pub struct PeriodicOptions {
    /// Number of grid points, odd.
    pub grid_points: usize,
    /// When to stop.
    pub newton: NewtonOptions,
    /// Where to start.
    pub guess: InitialGuess,
}

/// Result of a periodic solve: the last state, converged or not, and how it was reached.
#[derive(Debug, Clone)]
pub struct PeriodicSolve {
    /// The system.
    pub system: Arc<System>,
    /// The grid.
    pub grid: TimeGrid,
    /// States at the grid points.
    pub state: GridState,
    /// Outcome and history.
    pub report: NewtonReport,
    /// Newton iterations spent on the initial guess, each at a single instant.
    pub guess_iterations: usize,
    /// Time spent on the initial guess.
    pub guess_time: Duration,
    /// Time spent on the periodic problem, by kind of work.
    pub timings: Timings,
}

/// Finds the periodic response of `model` with period `period`.
///
/// `observe` sees each iteration and returns `false` to cancel.
///
/// # Errors
/// If options or model are not valid. Not converging is an outcome, not an error.
pub fn solve_periodic(
    model: &Model,
    period: f64,
    options: &PeriodicOptions,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<PeriodicSolve> {
    if !(options.newton.tolerance.is_finite() && options.newton.tolerance > 0.0) {
        let got = options.newton.tolerance;
        return Err(Error::value(
            "options.tolerance",
            "a positive, finite number",
            got,
        ));
    }
    if options.newton.iteration_limit == 0 {
        return Err(Error::value("options.iteration_limit", "at least 1", 0));
    }
    let grid = TimeGrid::new(options.grid_points, period)?;
    let system = Arc::new(System::new(model, period)?);

    let start = Instant::now();
    let mut guess_iterations = 0;
    let mut failure = None;
    let mut state = match &options.guess {
        InitialGuess::State(state) => state.clone(),
        InitialGuess::Default => {
            let mut observe = |iteration: &Iteration| observe(Stage::InitialGuess, iteration);
            let guess = quasi_static(&system, grid, &mut observe)?;
            guess_iterations = guess.iterations;
            if guess.outcome != Outcome::Converged {
                failure = Some((guess.outcome, guess.explanation));
            }
            guess.state
        }
    };
    let guess_time = start.elapsed();
    let solve = |state, report, timings| PeriodicSolve {
        system: system.clone(),
        grid,
        state,
        report,
        guess_iterations,
        guess_time,
        timings,
    };
    if let Some((outcome, explanation)) = failure {
        let report = NewtonReport {
            outcome: match outcome {
                Outcome::Cancelled => Outcome::Cancelled,
                Outcome::Singular => Outcome::Singular,
                _ => Outcome::NoInitialGuess,
            },
            iterations: Vec::new(),
            explanation,
        };
        return Ok(solve(state, report, Timings::default()));
    }

    let mut newton = Newton::new(Collocation::new(system.clone(), grid)?)?;
    let mut observe = |iteration: &Iteration| observe(Stage::Newton, iteration);
    let report = newton.solve(&mut state, &options.newton, &mut observe)?;
    Ok(solve(state, report, newton.timings))
}
