//! The periodic solve from model to solution.

use super::guess::quasi_static;
use super::march::march_to_periodic;
use super::newton::{Iteration, Newton, NewtonOptions, NewtonReport, Outcome, Timings};
use super::trajectory::MarchRecord;
use crate::collocation::{Collocation, GridState};
use crate::elements::NodeState;
use crate::error::{Error, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::system::System;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What the solver is doing, as told to the progress callback.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Finding the initial guess.
    InitialGuess,
    /// Newton iterations of the periodic problem.
    Newton,
    /// Marching in time, each step, which ends at this time.
    March {
        /// End of the step.
        time: f64,
    },
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

impl PeriodicOptions {
    /// The defaults, on a grid of this many points.
    pub fn with_grid_points(grid_points: usize) -> Self {
        PeriodicOptions {
            grid_points,
            newton: NewtonOptions {
                tolerance: 1e-9,
                iteration_limit: 30,
            },
            guess: InitialGuess::Default,
        }
    }
}

impl NewtonOptions {
    pub(super) fn validate(&self) -> Result<()> {
        if !(self.tolerance.is_finite() && self.tolerance > 0.0) {
            let expected = "a positive, finite number";
            return Err(Error::value("options.tolerance", expected, self.tolerance));
        }
        if self.iteration_limit == 0 {
            return Err(Error::value("options.iteration_limit", "at least 1", 0));
        }
        Ok(())
    }
}

/// Result of a periodic or static solve, or of a march: the last state, converged or not, and how it was
/// reached.
#[derive(Debug, Clone)]
pub struct PeriodicSolve {
    /// The system.
    pub system: Arc<System>,
    /// The grid; of one point for an equilibrium or a march.
    pub grid: TimeGrid,
    /// States at the grid points or, of a march, at its times.
    pub state: GridState,
    /// Motions with their velocities and accelerations at these, node by node.
    pub node_states: Vec<NodeState>,
    /// Outcome and history of the last Newton solve of the periodic problem.
    pub report: NewtonReport,
    /// Newton iterations spent on the initial guess, each at a single instant.
    pub guess_iterations: usize,
    /// Time spent on the initial guess.
    pub guess_time: Duration,
    /// Time spent on the periodic problem, by kind of work.
    pub timings: Timings,
    /// Of a march: its times, and how it went.
    pub march: Option<MarchRecord>,
}

impl PeriodicSolve {
    /// The times of the states.
    pub fn times(&self) -> Vec<f64> {
        match &self.march {
            Some(record) => record.times.clone(),
            None => self.grid.times().collect(),
        }
    }
}

/// Smallest step of the continuation in the inertia factor.
const SMALLEST_INERTIA_STEP: f64 = 1.0 / 64.0;

/// One solve on its way through the attempts.
struct Attempts<'a> {
    system: Arc<System>,
    grid: TimeGrid,
    options: NewtonOptions,
    newton: Newton,
    observe: &'a mut dyn FnMut(Stage, &Iteration) -> bool,
    guess_iterations: usize,
    guess_time: Duration,
}

/// Finds the periodic response of `model` with period `period`.
///
/// Without a given start, Newton begins at the quasi-static motion. Where that does not lead to a
/// solution, it continues from there in a factor of the inertial forces, and then begins at the end of
/// a march in time.
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
    options.newton.validate()?;
    let grid = TimeGrid::new(options.grid_points, period)?;
    let system = Arc::new(System::new(model, period)?);
    let mut attempts = Attempts {
        newton: Newton::new(Collocation::new(system.clone(), grid)?)?,
        system: system.clone(),
        grid,
        options: options.newton,
        observe,
        guess_iterations: 0,
        guess_time: Duration::ZERO,
    };
    let (mut state, report) = match &options.guess {
        InitialGuess::State(state) => attempts.newton(state.clone())?,
        InitialGuess::Default => attempts.find()?,
    };
    attempts.newton.equations.update_kinematics(&state);
    attempts.newton.equations.reduce_to_least_norm(&mut state)?;
    Ok(PeriodicSolve {
        system,
        grid,
        node_states: attempts.newton.equations.node_states().to_vec(),
        state,
        report,
        guess_iterations: attempts.guess_iterations,
        guess_time: attempts.guess_time,
        timings: attempts.newton.timings,
        march: None,
    })
}

/// Sees each iteration and returns `false` to cancel.
type Observer<'a> = dyn FnMut(&Iteration) -> bool + 'a;

/// Whether an outcome leaves no reason to try something else.
fn is_final(outcome: Outcome) -> bool {
    matches!(
        outcome,
        Outcome::Converged | Outcome::Cancelled | Outcome::Inconsistent
    )
}

impl Attempts<'_> {
    fn newton(&mut self, mut state: GridState) -> Result<(GridState, NewtonReport)> {
        let observe = &mut *self.observe;
        let mut observe = |iteration: &Iteration| observe(Stage::Newton, iteration);
        let report = self.newton.solve(&mut state, &self.options, &mut observe)?;
        Ok((state, report))
    }

    /// Looks for a start by `find`, and keeps count of its cost.
    fn guess<G>(
        &mut self,
        find: impl FnOnce(&Arc<System>, TimeGrid, &mut Observer) -> Result<G>,
    ) -> Result<G> {
        let start = Instant::now();
        let (observe, count) = (&mut *self.observe, &mut self.guess_iterations);
        let guess = find(&self.system, self.grid, &mut |iteration| {
            *count += 1;
            observe(Stage::InitialGuess, iteration)
        });
        self.guess_time += start.elapsed();
        guess
    }

    /// From the library's own start.
    fn find(&mut self) -> Result<(GridState, NewtonReport)> {
        let guess = self.guess(|system, grid, observe| quasi_static(system, grid, observe))?;

        let first = if guess.outcome == Outcome::Converged {
            let first = self.newton(guess.state.clone())?;
            if is_final(first.1.outcome) {
                return Ok(first);
            }
            if let Some(solved) = self.through_inertia(guess.state)? {
                return Ok(solved);
            }
            first
        } else {
            let outcome = match guess.outcome {
                Outcome::Cancelled
                | Outcome::Singular
                | Outcome::Inconsistent
                | Outcome::WrongAssembly => guess.outcome,
                _ => Outcome::NoInitialGuess,
            };
            let report = NewtonReport {
                outcome,
                iterations: Vec::new(),
                explanation: guess.explanation,
            };
            if matches!(outcome, Outcome::Cancelled | Outcome::Inconsistent) {
                return Ok((guess.state, report));
            }
            (guess.state, report)
        };
        Ok(self.through_march()?.unwrap_or(first))
    }

    /// Raises the inertial forces in steps, from a solution without them.
    fn through_inertia(
        &mut self,
        mut state: GridState,
    ) -> Result<Option<(GridState, NewtonReport)>> {
        let (mut reached, mut step) = (0.0, 0.25f64);
        let mut outcome = None;
        while reached < 1.0 {
            let next = (reached + step).min(1.0);
            self.newton.equations.set_inertia_factor(next);
            let (trial, report) = self.newton(state.clone())?;
            match report.outcome {
                Outcome::Converged => {
                    state = trial;
                    reached = next;
                    step *= 1.5;
                    outcome = Some((state.clone(), report));
                }
                Outcome::Cancelled => {
                    outcome = Some((trial, report));
                    break;
                }
                _ if step <= SMALLEST_INERTIA_STEP => {
                    outcome = None;
                    break;
                }
                _ => step *= 0.5,
            }
        }
        self.newton.equations.set_inertia_factor(1.0);
        Ok(outcome)
    }

    /// Starts from the end of a march in time. `None` if that leads nowhere either.
    fn through_march(&mut self) -> Result<Option<(GridState, NewtonReport)>> {
        let march = self.guess(|system, grid, observe| march_to_periodic(system, grid, observe))?;
        match march {
            Ok(state) => self.newton(state).map(Some),
            Err((Outcome::Cancelled, explanation)) => {
                let report = NewtonReport {
                    outcome: Outcome::Cancelled,
                    iterations: Vec::new(),
                    explanation,
                };
                Ok(Some((
                    GridState::reference(&self.system, self.grid),
                    report,
                )))
            }
            Err(_) => Ok(None),
        }
    }
}
