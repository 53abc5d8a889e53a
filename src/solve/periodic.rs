//! The periodic solve from model to solution.

use super::adaptive::{Adaptation, GridTried};
use super::estimate::{Assessment, assess, mesh_error};
use super::guess::Guess;
use super::iterative::{IterativeRecord, Projected};
use super::loads::Loads;
use super::method::{Linear, LinearMethod};
use super::newton::{Iteration, Newton, NewtonOptions, NewtonReport, Outcome, Timings};
use super::starts::{Attempt, Start};
use super::trajectory::MarchRecord;
use crate::collocation::{Collocation, GridState};
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::system::{Driven, System};
use crate::workers::Workers;
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
    /// Found in this way alone.
    By(Start),
    /// These states at the points of the grid; of the first, if grids are adapted.
    State(GridState),
}

/// How many grid points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GridPoints {
    /// This odd number.
    Fixed(usize),
    /// Few at first, then more until the estimated error meets a tolerance.
    Adaptive(Adaptation),
}

/// Options of a periodic solve.
#[derive(Debug, Clone)]
pub struct PeriodicOptions {
    /// Number of grid points.
    pub grid_points: GridPoints,
    /// When to stop on each grid.
    pub newton: NewtonOptions,
    /// Where to start.
    pub guess: InitialGuess,
    /// How linear equations are solved.
    pub linear: LinearMethod,
    /// Threads that share the work, 0 for as many as there are processors. Results do not depend on it but for
    /// rounding. The user's functions are called on the calling thread alone.
    pub threads: usize,
    /// The equations are sampled at this many times as many points, or one more, where motions and own unknowns are
    /// interpolated: forces are to do no virtual work on their changes, constraints to have none of the grid's
    /// harmonics. 1 for the grid points alone: collocation, where higher harmonics of the equations count as
    /// the lower ones that they alias onto.
    pub oversampling: usize,
}

/// The largest factor of oversampling: sixteen times the points leave no alias of products of thirty-one.
const MOST_OVERSAMPLING: usize = 16;

impl Default for PeriodicOptions {
    fn default() -> Self {
        PeriodicOptions {
            grid_points: GridPoints::Adaptive(Adaptation::default()),
            newton: NewtonOptions {
                tolerance: 1e-9,
                iteration_limit: 30,
            },
            guess: InitialGuess::Default,
            linear: LinearMethod::Automatic,
            threads: 1,
            oversampling: 1,
        }
    }
}

impl PeriodicOptions {
    /// The defaults, on a grid of this many points.
    pub fn with_grid_points(points: usize) -> Self {
        PeriodicOptions {
            grid_points: GridPoints::Fixed(points),
            ..PeriodicOptions::default()
        }
    }

    /// The defaults, with grid points added until the estimated error is below this.
    pub fn with_error_tolerance(error_tolerance: f64) -> Self {
        PeriodicOptions {
            grid_points: GridPoints::Adaptive(Adaptation {
                error_tolerance,
                ..Adaptation::default()
            }),
            ..PeriodicOptions::default()
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
    /// The grids that an adaptive solve has tried, coarsest first.
    pub grids: Vec<GridTried>,
    /// The coarser grid whose solution Newton's method began at, if the library chose to.
    pub coarse_start: Option<GridTried>,
    /// Where the library began, in the order in which it tried; empty where a start was given.
    pub attempts: Vec<Attempt>,
    /// What iterative solution of linear equations took on the last grid, where it was used.
    pub iterative: Option<IterativeRecord>,
    /// Threads that shared the work, 0 for as many as there are processors.
    pub threads: usize,
    /// Of a periodic solution: what it tells of its error.
    pub assessment: Option<Assessment>,
    /// Estimated error of the motions by the mesh of beams: positions relative to the characteristic length, and angles. Infinite where
    /// none can be had.
    pub mesh_error: f64,
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

/// Grids of more than this many times the points that a first guess takes start from a solution on fewer.
const COARSER: usize = 2;
/// Estimated error of such a solution that leaves it nearer than the quasi-static motion: this, or so many times what inertial
/// forces displace that by.
const RESOLVED: f64 = 1e-4;
const NEARER: f64 = 0.1;
/// Tolerance of such a solution: the error after the last increment goes with its square.
const ENOUGH: f64 = 1e-3;
/// Inertial displacement, in scaled unknowns, of a quasi-static motion from which Newton's method takes more than a few iterations.
const FAR: f64 = 0.01;
/// Fewest points of a grid with half the harmonics that may serve as a start.
const LEAST_COARSE: usize = 7;
/// Most iterations on it: more would take longer than those it is to spare.
const MOST_COARSE: usize = 8;

/// One solve on its way through the attempts.
pub(super) struct Attempts<'a> {
    pub(super) system: Arc<System>,
    pub(super) grid: TimeGrid,
    pub(super) options: NewtonOptions,
    linear: LinearMethod,
    pub(super) workers: Workers,
    oversampling: usize,
    pub(super) newton: Newton<Projected<Linear>>,
    observe: &'a mut dyn FnMut(Stage, &Iteration) -> bool,
    /// Where the quasi-static start is found, and the start once it is.
    pub(super) guess_grid: TimeGrid,
    /// The quasi-static motions that were found, or not.
    pub(super) guesses: Vec<(Start, Guess)>,
    /// What turns with drives.
    pub(super) driven: Option<Driven>,
    /// What was tried.
    pub(super) tried: Vec<Attempt>,
    /// Where to start, if the user says so.
    pub(super) chosen: Option<Start>,
    pub(super) guess_iterations: usize,
    guess_time: Duration,
    /// Time spent on grids before the present one.
    timings: Timings,
    pub(super) grids: Vec<GridTried>,
    pub(super) loads: Loads,
    /// Of the last solution that was assessed, on this grid.
    pub(super) assessed: Option<(TimeGrid, Assessment)>,
    coarse_start: Option<GridTried>,
}

/// Finds the periodic response of `model` with period `period`.
///
/// On an adaptive grid, each solution starts from that on the grid before; the last is given.
///
/// Without a given start, Newton begins at the quasi-static motion, in steady rotation of what hangs on drives, or, on a large
/// grid or where inertial forces would displace that much, at a solution on a smaller grid if that resolves the motion.
/// Where that does not lead to a solution, other starts are tried, see [`Start`].
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
    if !(1..=MOST_OVERSAMPLING).contains(&options.oversampling) {
        let expected = format!("a number from 1 to {MOST_OVERSAMPLING}");
        let name = "options.oversampling";
        return Err(Error::value(name, expected, options.oversampling));
    }
    // What is wrong with the grid is said first.
    let points = match options.grid_points {
        GridPoints::Fixed(points) => points,
        GridPoints::Adaptive(adaptation) => {
            adaptation.validate()?;
            1
        }
    };
    TimeGrid::new(points, period)?;
    let system = Arc::new(System::new(model, period)?);
    let largest = match options.grid_points {
        GridPoints::Fixed(points) => points,
        GridPoints::Adaptive(adaptation) => adaptation.largest,
    };
    let loads = Loads::of(&system, largest)?;
    let points = match (&options.guess, &options.grid_points) {
        (_, GridPoints::Fixed(points)) => *points,
        (InitialGuess::State(state), _) => state.points(),
        (_, GridPoints::Adaptive(adaptation)) => adaptation.first(&loads),
    };
    let wanted = TimeGrid::new(points, period)?;
    let guess_points = match (&options.guess, &options.grid_points) {
        (InitialGuess::State(_), GridPoints::Fixed(_)) => points,
        (_, GridPoints::Fixed(_)) => {
            let coarse = Adaptation::default();
            let coarse = coarse.guess(coarse.first(&loads));
            if points > COARSER * coarse {
                coarse
            } else {
                points
            }
        }
        (_, GridPoints::Adaptive(adaptation)) => adaptation.guess(points),
    };
    let guess_grid = TimeGrid::new(guess_points, period)?;
    // The first grid.
    let grid = match options.grid_points {
        GridPoints::Fixed(_) => guess_grid,
        GridPoints::Adaptive(_) => wanted,
    };
    let workers = Workers::new(options.threads)?;
    let mut attempts = Attempts {
        newton: newton(
            &system,
            grid,
            options.linear,
            options.oversampling,
            &workers,
        )?,
        linear: options.linear,
        workers,
        oversampling: options.oversampling,
        system: system.clone(),
        grid,
        options: options.newton,
        observe,
        guess_grid,
        guesses: Vec::new(),
        driven: system.driven()?,
        tried: Vec::new(),
        chosen: match options.guess {
            InitialGuess::By(start) => Some(start),
            _ => None,
        },
        guess_iterations: 0,
        guess_time: Duration::ZERO,
        timings: Timings::default(),
        grids: Vec::new(),
        loads,
        assessed: None,
        coarse_start: None,
    };
    let given = match &options.guess {
        InitialGuess::State(state) => Some(state.clone()),
        InitialGuess::Default | InitialGuess::By(_) => None,
    };
    let (mut state, mut report) = match (&options.grid_points, given) {
        (GridPoints::Adaptive(adaptation), given) => attempts.refine(adaptation, given)?,
        (GridPoints::Fixed(_), Some(state)) => attempts.newton(state)?,
        (GridPoints::Fixed(_), None) => attempts.find_on(wanted)?,
    };
    if let (GridPoints::Fixed(_), Outcome::Converged) = (options.grid_points, report.outcome) {
        attempts.assess(&mut state, &report)?;
        report.explanation = attempts.describe_unheld().unwrap_or_default();
    }
    let mesh_error = if report.outcome.is_solution() && options.oversampling == 1 {
        mesh_error(model, &mut attempts.newton, &state)?
    } else {
        f64::INFINITY
    };
    attempts.newton.equations.update_kinematics(&state);
    // Between grid points, too, what has no effect at them may have some.
    if options.oversampling == 1 {
        attempts.newton.equations.reduce_to_least_norm(&mut state)?;
    }
    let assessment = attempts
        .assessed
        .take_if(|(grid, _)| *grid == attempts.grid && report.outcome.is_solution());
    Ok(PeriodicSolve {
        system,
        grid: attempts.grid,
        node_states: attempts.newton.equations.node_states().to_vec(),
        state,
        report,
        guess_iterations: attempts.guess_iterations,
        guess_time: attempts.guess_time,
        timings: attempts.timings + attempts.newton.timings,
        iterative: attempts.newton.linear.sampled().record().cloned(),
        grids: attempts.grids,
        coarse_start: attempts.coarse_start,
        attempts: attempts.tried,
        threads: options.threads,
        assessment: assessment.map(|(_, assessment)| assessment),
        mesh_error,
        march: None,
    })
}

/// Newton's method on a grid.
fn newton(
    system: &Arc<System>,
    grid: TimeGrid,
    method: LinearMethod,
    oversampling: usize,
    workers: &Workers,
) -> Result<Newton<Projected<Linear>>> {
    let start = Instant::now();
    let mut equations = Collocation::new(system.clone(), grid)?;
    equations.set_workers(workers.clone());
    if oversampling > 1 {
        equations.oversample(oversampling)?;
    }
    let linear = Projected::new(&equations, Linear::new(&equations, method));
    let mut newton = Newton::with(equations, linear);
    newton.timings.analysis = start.elapsed();
    Ok(newton)
}

/// Sees each iteration and returns `false` to cancel.
pub(super) type Observer<'a> = dyn FnMut(&Iteration) -> bool + 'a;

/// Whether an outcome leaves no reason to try something else.
pub(super) fn is_final(outcome: Outcome) -> bool {
    matches!(
        outcome,
        Outcome::Converged | Outcome::Cancelled | Outcome::Inconsistent
    )
}

impl Attempts<'_> {
    pub(super) fn newton(&mut self, state: GridState) -> Result<(GridState, NewtonReport)> {
        let options = self.options;
        self.newton_to(state, &options)
    }

    fn newton_to(
        &mut self,
        mut state: GridState,
        options: &NewtonOptions,
    ) -> Result<(GridState, NewtonReport)> {
        let observe = &mut *self.observe;
        let mut observe = |iteration: &Iteration| observe(Stage::Newton, iteration);
        match self.newton.solve(&mut state, options, &mut observe) {
            Ok(report) => Ok((state, report)),
            // Where the start cannot be interpolated there is no residual to begin with.
            Err(e) if e.kind() == ErrorKind::GridTooCoarse && self.oversampling > 1 => {
                let report = NewtonReport {
                    outcome: Outcome::Stalled,
                    iterations: Vec::new(),
                    explanation: e.to_string(),
                };
                Ok((state, report))
            }
            Err(e) => Err(e),
        }
    }

    /// Looks for a start by `find`, and keeps count of its cost.
    pub(super) fn guess<G>(
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

    /// Goes on with another grid.
    pub(super) fn move_to(&mut self, grid: TimeGrid) -> Result<()> {
        if grid == self.grid {
            return Ok(());
        }
        self.grid = grid;
        self.begin_again()
    }

    /// Forgets what has been found about the equations, which the present grid may not share.
    pub(super) fn begin_again(&mut self) -> Result<()> {
        let (method, oversampling) = (self.linear, self.oversampling);
        let next = newton(&self.system, self.grid, method, oversampling, &self.workers)?;
        let last = std::mem::replace(&mut self.newton, next);
        self.timings = self.timings + last.timings;
        Ok(())
    }

    /// Goes on with another grid, from a solution on the present one; none if that is too coarse to tell.
    ///
    /// The first tangent there is of stress resultants that are carried, too: those of strains between grid points know too much
    /// of stretching by turns that are a little off.
    pub(super) fn carry_to(
        &mut self,
        grid: TimeGrid,
        state: &GridState,
    ) -> Result<Option<GridState>> {
        let from = self.grid;
        let resultants = self.newton.equations.resampled_resultants(state, grid)?;
        self.move_to(grid)?;
        let start = self.carried(state, from)?;
        if start.is_some() {
            self.newton.equations.set_resultants(resultants);
        }
        Ok(start)
    }

    /// A state on the grid `from`, at the points of the present one; none if `from` is too coarse to tell.
    pub(super) fn carried(&self, state: &GridState, from: TimeGrid) -> Result<Option<GridState>> {
        match state.resampled(&self.system, from, 0.0, self.grid, &self.workers) {
            Ok(state) => Ok(Some(state)),
            Err(e) if e.kind() == ErrorKind::GridTooCoarse => Ok(None),
            Err(e) => Err(e),
        }
    }

    /// On a grid that may be finer than the present one, from the library's own start.
    fn find_on(&mut self, grid: TimeGrid) -> Result<(GridState, NewtonReport)> {
        let coarser = grid.of_half_the_harmonics();
        let is_first = self.grid == grid;
        if is_first && coarser.points() < LEAST_COARSE {
            return self.find();
        }
        let distance = self.inertial_displacement()?;
        let mut most = self.options.iteration_limit;
        if is_first {
            if distance <= FAR {
                return self.find();
            }
            self.move_to(coarser)?;
            most = most.min(MOST_COARSE);
        }
        self.find_from_coarse(grid, distance, most)
    }

    /// From a solution on the present grid, which is coarse, if `most` iterations find one with an error that is small beside
    /// the `distance` of the quasi-static motion; as [`find`](Self::find) otherwise.
    fn find_from_coarse(
        &mut self,
        grid: TimeGrid,
        distance: f64,
        most: usize,
    ) -> Result<(GridState, NewtonReport)> {
        let coarse = self.grid;
        let enough = NewtonOptions {
            tolerance: self.options.tolerance.max(ENOUGH),
            iteration_limit: most,
        };
        let mut start = None;
        if let Some(state) = self.start()? {
            let (state, report) = self.newton_to(state, &enough)?;
            match report.outcome {
                Outcome::Converged => {
                    // As a start it is as good as its harmonics fall: stretching between points, which is a part of the
                    // error, is taken out by the stress resultants that are carried.
                    let (found, _) = assess(&self.system, coarse, &state, &self.workers)?;
                    let error = found.error;
                    if error < RESOLVED.max(NEARER * distance) {
                        start = self.carry_to(grid, &state)?;
                        self.coarse_start = start.is_some().then_some(GridTried {
                            points: coarse.points(),
                            iterations: report.iterations.len(),
                            error_estimate: error,
                        });
                    }
                }
                Outcome::Cancelled => {
                    self.move_to(grid)?;
                    let reached = self.carried(&state, coarse)?;
                    let state = reached.unwrap_or_else(|| GridState::reference(&self.system, grid));
                    return Ok((state, report));
                }
                _ => {}
            }
        }
        self.move_to(grid)?;
        if let Some(start) = start {
            let found = self.newton(start)?;
            // What is prolonged may miss constraints that depend on each other.
            if matches!(found.1.outcome, Outcome::Converged | Outcome::Cancelled) {
                return Ok(found);
            }
            self.coarse_start = None;
            self.begin_again()?;
        }
        self.guess_on(grid)?;
        self.find()
    }
}
