//! The periodic solve from model to solution.
//! See docs/theory.md, section 9.

use super::adaptive::{Adaptation, GridTried};
use super::estimate::{Assessment, assess, mesh_error};
use super::guess::Guess;
use super::iterative::Projected;
use super::loads::Loads;
use super::method::{Linear, LinearMethod};
use super::newton::{Iteration, Newton, NewtonOptions, NewtonReport, Outcome, Timings};
use super::result::{Kind, PeriodicRecord, Solved};
use super::starts::{Attempt, Start};
use super::watch::{Watch, Watching};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result, require_positive_number};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::system::{Driven, System, require_periodic_forces};
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
    /// Looking for modes about an equilibrium.
    Modes,
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
    /// Threads that share the work, 0 for as many as there are processors. Results do not depend on
    /// it but for rounding. The user's functions are called on the calling thread alone.
    pub threads: usize,
    /// The equations are sampled at this many times as many points, or one more, where motions and
    /// own unknowns are interpolated: forces are to do no virtual work on their changes,
    /// constraints to have none of the grid's harmonics. 1 for the grid points alone: collocation,
    /// where higher harmonics of the equations count as the lower ones that they alias onto.
    pub oversampling: usize,
    /// Whether the error by the mesh of beams is estimated, too, which takes about as long as an
    /// iteration.
    pub estimate_mesh: bool,
    /// Who is told how the solve goes on, and may cancel it.
    pub watch: Watch,
}

/// The largest factor of oversampling: sixteen times the points leave no alias of products of
/// thirty-one.
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
            estimate_mesh: false,
            watch: Watch::default(),
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
        require_positive_number("options.tolerance", self.tolerance)?;
        if self.iteration_limit == 0 {
            return Err(Error::value("options.iteration_limit", "at least 1", 0));
        }
        Ok(())
    }
}

/// Grids of more than this many times the points that a first guess takes start from a solution on
/// fewer.
const COARSER: usize = 2;
/// Estimated error of such a solution that leaves it nearer than the quasi-static motion: this, or
/// so many times what inertial forces displace that by.
const RESOLVED: f64 = 1e-4;
const NEARER: f64 = 0.1;
/// Tolerance of such a solution: the error after the last increment goes with its square.
const ENOUGH: f64 = 1e-3;
/// Inertial displacement, in scaled unknowns, of a quasi-static motion from which Newton's method
/// takes more than a few iterations.
const FAR: f64 = 0.001;
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
    /// Time spent on grids before the present one, and iterations there.
    timings: Timings,
    iterations: usize,
    pub(super) watching: Watching,
    /// Where Newton's method ended last, and how.
    last: Option<(TimeGrid, GridState, NewtonReport)>,
    pub(super) grids: Vec<GridTried>,
    pub(super) loads: Loads,
    /// The largest estimated error that ends an adaptive solve; zero on a grid that is given.
    pub(super) accepted: f64,
    /// Of the last solution that was assessed, on this grid.
    pub(super) assessed: Option<(TimeGrid, Assessment)>,
    coarse_start: Option<GridTried>,
}

/// Finds the periodic response of `model` with period `period`.
///
/// On an adaptive grid, each solution starts from that on the grid before; the last is given.
///
/// Without a given start, Newton begins at the quasi-static motion, in steady rotation of what
/// hangs on drives, or, on a large grid or where inertial forces would displace that much, at a
/// solution on a smaller grid if that resolves the motion. Where that does not lead to a solution,
/// other starts are tried, see [`Start`].
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
) -> Result<Solved> {
    let began = Instant::now();
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
    require_periodic_forces(model, system.scales().length, period)?;
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
    let watching = options.watch.begin(Stage::InitialGuess, grid.points());
    let workers = Workers::new(options.threads)?.telling(watching.pulse());
    let mut observe_all = |stage: Stage, iteration: &Iteration| {
        let goes_on = watching.iteration(stage, iteration);
        observe(stage, iteration) && goes_on
    };
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
        observe: &mut observe_all,
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
        iterations: 0,
        watching: watching.clone(),
        last: None,
        grids: Vec::new(),
        loads,
        assessed: None,
        accepted: match &options.grid_points {
            GridPoints::Fixed(_) => 0.0,
            GridPoints::Adaptive(adaptation) => adaptation.error_tolerance,
        },
        coarse_start: None,
    };
    let given = match &options.guess {
        InitialGuess::State(state) => Some(state.clone()),
        InitialGuess::Default | InitialGuess::By(_) => None,
    };
    // All that came before: the system, the loads, the first pattern.
    attempts.timings.analysis = began.elapsed() - attempts.newton.timings.analysis;
    let (mut state, mut report) = match attempts.solve(&options.grid_points, given, wanted) {
        Err(error) if watching.cancels(&error) => attempts.cancelled()?,
        end => end?,
    };
    let estimating = Instant::now();
    let sampled = options.oversampling == 1;
    let wanted = options.estimate_mesh || model.beams.is_empty();
    let mesh_error = if wanted && sampled && report.outcome.is_solution() {
        match mesh_error(model, &mut attempts.newton, &state) {
            Err(error) if watching.cancels(&error) => f64::INFINITY,
            found => found?,
        }
    } else {
        f64::INFINITY
    };
    attempts.timings.estimates += estimating.elapsed();
    let finishing = Instant::now();
    attempts.newton.equations.update_kinematics(&state);
    report.outcome = watching.outcome(report.outcome);
    let assessment = attempts
        .assessed
        .take_if(|(grid, _)| *grid == attempts.grid && report.outcome.is_solution());
    // Between grid points, too, what has no effect at them may have some.
    let reduced = assessment.is_some() || report.outcome == Outcome::Cancelled;
    if options.oversampling == 1 && !reduced {
        attempts.newton.equations.reduce_to_least_norm(&mut state)?;
    }
    attempts.timings.assembly += finishing.elapsed();
    Ok(Solved {
        system,
        grid: attempts.grid,
        node_states: attempts.newton.equations.node_states().to_vec(),
        state,
        report,
        guess_iterations: attempts.guess_iterations,
        guess_time: attempts.guess_time,
        timings: attempts.timings + attempts.newton.timings,
        total_time: began.elapsed(),
        total_iterations: attempts.iterations + attempts.newton.iterations,
        kind: Kind::Periodic(PeriodicRecord {
            iterative: attempts.newton.linear.sampled().record().cloned(),
            grids: attempts.grids,
            coarse_start: attempts.coarse_start,
            attempts: attempts.tried,
            threads: options.threads,
            assessment: assessment.map(|(_, assessment)| assessment),
            mesh_error,
        }),
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
    fn solve(
        &mut self,
        grid_points: &GridPoints,
        given: Option<GridState>,
        wanted: TimeGrid,
    ) -> Result<(GridState, NewtonReport)> {
        let (mut state, mut report) = match (grid_points, given) {
            (GridPoints::Adaptive(adaptation), given) => return self.refine(adaptation, given),
            (GridPoints::Fixed(_), Some(state)) => self.newton(state)?,
            (GridPoints::Fixed(_), None) => self.find_on(wanted)?,
        };
        if report.outcome == Outcome::Converged {
            self.assess(&mut state, &report)?;
            report.explanation = self.describe_unheld().unwrap_or_default();
        }
        Ok((state, report))
    }

    /// What there is when the solve is cancelled where Newton's method does not see it.
    fn cancelled(&mut self) -> Result<(GridState, NewtonReport)> {
        let (state, iterations) = match self.last.take() {
            Some((grid, state, report)) => {
                self.move_to(grid)?;
                (state, report.iterations)
            }
            None => (GridState::reference(&self.system, self.grid), Vec::new()),
        };
        let report = NewtonReport {
            outcome: Outcome::Cancelled,
            iterations,
            explanation: String::new(),
        };
        Ok((state, report))
    }

    pub(super) fn newton(&mut self, state: GridState) -> Result<(GridState, NewtonReport)> {
        let options = self.options;
        self.newton_to(state, &options)
    }

    fn newton_to(
        &mut self,
        mut state: GridState,
        options: &NewtonOptions,
    ) -> Result<(GridState, NewtonReport)> {
        self.watching.stage(Stage::Newton);
        let observe = &mut *self.observe;
        let mut observe = |iteration: &Iteration| observe(Stage::Newton, iteration);
        match self.newton.solve(&mut state, options, &mut observe) {
            Ok(report) => {
                self.last = Some((self.grid, state.clone(), report.clone()));
                Ok((state, report))
            }
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
        self.watching.stage(Stage::InitialGuess);
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
        self.watching.grid(grid.points());
        self.begin_again()
    }

    /// Forgets what has been found about the equations, which the present grid may not share.
    pub(super) fn begin_again(&mut self) -> Result<()> {
        let (method, oversampling) = (self.linear, self.oversampling);
        let next = newton(&self.system, self.grid, method, oversampling, &self.workers)?;
        let last = std::mem::replace(&mut self.newton, next);
        self.timings = self.timings + last.timings;
        self.iterations += last.iterations;
        Ok(())
    }

    /// Goes on with another grid, from a solution on the present one; none if that is too coarse to
    /// tell.
    ///
    /// The first tangent there is of stress resultants that are carried, too: those of strains
    /// between grid points know too much of stretching by turns that are a little off.
    pub(super) fn carry_to(
        &mut self,
        grid: TimeGrid,
        state: &GridState,
    ) -> Result<Option<GridState>> {
        let from = self.grid;
        let began = Instant::now();
        let equations = &mut self.newton.equations;
        equations.update_kinematics(state);
        let resultants = equations.resampled_resultants(0.0, grid)?;
        self.guess_time += began.elapsed();
        self.move_to(grid)?;
        let start = self.carried(state, from)?;
        if start.is_some() {
            self.newton.equations.set_resultants(resultants);
        }
        Ok(start)
    }

    /// A state on the grid `from`, at the points of the present one; none if `from` is too coarse
    /// to tell.
    pub(super) fn carried(
        &mut self,
        state: &GridState,
        from: TimeGrid,
    ) -> Result<Option<GridState>> {
        let began = Instant::now();
        let carried = state.resampled(&self.system, from, 0.0, self.grid, &self.workers);
        self.guess_time += began.elapsed();
        match carried {
            Ok(state) => Ok(Some(state)),
            Err(e) if e.kind() == ErrorKind::GridTooCoarse => Ok(None),
            Err(e) => Err(e),
        }
    }

    /// On a grid that may be finer than the present one, from the library's own start.
    fn find_on(&mut self, grid: TimeGrid) -> Result<(GridState, NewtonReport)> {
        // No coarse solution from the quasi-static motion where another start was asked for.
        if !matches!(
            self.chosen,
            None | Some(Start::QuasiStatic | Start::SteadyRotation)
        ) {
            self.move_to(grid)?;
            self.guess_on(grid)?;
            return self.find();
        }
        let coarser = grid.of_half_the_harmonics();
        let is_first = self.grid == grid;
        if is_first && coarser.points() < LEAST_COARSE {
            return self.find();
        }
        self.watching.attempt(0, Some(self.first_start()));
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

    /// From a solution on the present grid, which is coarse, if `most` iterations find one with an
    /// error that is small beside the `distance` of the quasi-static motion; as
    /// [`find`](Self::find) otherwise.
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
                    // As a start it is as good as its harmonics fall: stretching between points,
                    // which is a part of the error, is taken out by the stress resultants that are
                    // carried.
                    let began = Instant::now();
                    let (found, _) = assess(&self.system, coarse, &state, &self.workers)?;
                    self.timings.estimates += began.elapsed();
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
