//! Equilibrium at one time, at rest or turning steadily: collocation on a grid of one point.
//! See docs/theory.md, section 11.1.
//!
//! Load steps are those of `starts/tracker`, in no time; `settle` creeps downhill where they
//! lead nowhere.

mod settle;

use crate::collocation::Conditions;
use crate::error::{Error, Result, require_finite, require_positive_number};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::memory::{MemoryLimit, bytes_of_modes};
use crate::solve::newton::{Newton, bytes_at_instant};
use crate::solve::periodic::estimate::mesh_error;
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome, Timings};
use crate::solve::result::{Kind, Solved};
use crate::solve::start::InitialGuess;
use crate::solve::starts::tracker::Tracker;
use crate::solve::watch::{Stage, Watch, Watching};
use crate::system::{Regime, Standstill, System, require_reproducible_forces};
use crate::workers::Workers;
use std::sync::Arc;
use std::time::Instant;

/// Largest relative residual of a state that is taken for an equilibrium although it may drift.
const INDIFFERENT: f64 = 1e-9;

/// Options of a static solve.
#[derive(Debug, Clone)]
pub struct StaticOptions {
    /// When, and in which frame, everything stands still.
    pub standstill: Standstill,
    /// Load steps taken at least, from the unloaded reference configuration. Steps that do not
    /// converge are halved.
    pub least_load_steps: usize,
    /// When to stop.
    pub newton: NewtonOptions,
    /// Where to start: by default in the reference configuration, with load steps.
    pub guess: InitialGuess,
    /// Bytes that it may take, by an estimate; no limit if zero.
    pub memory_limit: usize,
    /// Who is told how the solve goes on, and may cancel it.
    pub watch: Watch,
}

impl Default for StaticOptions {
    fn default() -> Self {
        StaticOptions {
            standstill: Standstill::default(),
            least_load_steps: 1,
            newton: NewtonOptions {
                tolerance: 1e-9,
                iteration_limit: 30,
            },
            guess: InitialGuess::Default,
            memory_limit: 0,
            watch: Watch::default(),
        }
    }
}

impl StaticOptions {
    /// Checks the options.
    pub(crate) fn validate(&self) -> Result<()> {
        self.newton.validate()?;
        let Standstill {
            time,
            period,
            angular_velocity,
            axis_point,
        } = &self.standstill;
        require_finite("options.time", &[*time])?;
        require_positive_number("options.period", period.unwrap_or(1.0))?;
        require_finite("options.angular_velocity", angular_velocity.as_slice())?;
        require_finite("options.axis_point", axis_point.as_slice())?;
        const MOST: usize = 1_000_000;
        if !(1..=MOST).contains(&self.least_load_steps) {
            let expected = format!("1 to {MOST}");
            let name = "options.load_steps";
            return Err(Error::value(name, expected, self.least_load_steps));
        }
        Ok(())
    }
}

/// What an equilibrium is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// The position: one that a free motion may carry off is not determined.
    Position,
    /// At most so many modes about it, which tell of free motions.
    Modes(usize),
}

impl Purpose {
    /// Checks that the memory that this takes of a system may be taken, and is to be had.
    fn require(self, system: &System, limit: MemoryLimit) -> Result<()> {
        let instant = bytes_at_instant(system);
        match self {
            Purpose::Position => limit.require("the equilibrium", instant),
            Purpose::Modes(count) => {
                let bytes = instant.saturating_add(bytes_of_modes(system, count));
                limit.require("a search for modes", bytes)
            }
        }
    }
}

/// Finds an equilibrium of `model` at one time, at rest or in steady rotation.
///
/// The state is followed from the unloaded reference configuration by load steps. Where that leads
/// nowhere, and for mechanisms, which nothing but the loads holds, the masses creep downhill under
/// the full loads. The solve that is returned has a grid of one point.
///
/// `observe` sees each iteration and returns `false` to cancel.
///
/// # Errors
/// If options or model are not valid. Not converging is an outcome, not an error.
pub fn solve_static(
    model: &Model,
    options: &StaticOptions,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Solved> {
    let watching = options.watch.begin(Stage::InitialGuess, 1);
    find_equilibrium(model, options, Purpose::Position, &watching, observe)
}

/// Looks for an equilibrium from the reference configuration.
fn find_start(tracker: &mut Tracker, system: &System, least_load_steps: usize) -> Result<bool> {
    // Where nothing holds the unloaded mechanism, small loads move it far, and load steps lead
    // nowhere.
    let held = tracker.is_held()?;
    if !held && tracker.settle(system)? {
        return Ok(true);
    }
    if tracker.was_cancelled() {
        return Ok(false);
    }
    let largest_step = 1.0 / least_load_steps as f64;
    if tracker.follow(largest_step, |fraction| (0.0, fraction))? {
        return Ok(true);
    }
    Ok(held && tracker.settle(system)?)
}

/// Goes to where the solve begins; why not, if that is nowhere.
fn begin(
    tracker: &mut Tracker,
    system: &System,
    options: &StaticOptions,
    watching: &Watching,
) -> Result<Option<(Outcome, String)>> {
    if let InitialGuess::State(state) = &options.guess {
        tracker.state = state.clone();
        return Ok(None);
    }
    let found = find_start(tracker, system, options.least_load_steps);
    Ok(match watching.unless_cancelled(found)? {
        Some(true) => None,
        Some(false) => tracker.failure.take(),
        None => Some((Outcome::Cancelled, String::new())),
    })
}

pub(crate) fn find_equilibrium(
    model: &Model,
    options: &StaticOptions,
    purpose: Purpose,
    watching: &Watching,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Solved> {
    options.validate()?;
    let start = Instant::now();
    let system = Arc::new(System::in_regime(
        model,
        Regime::Standstill(options.standstill),
    )?);
    purpose.require(&system, MemoryLimit(options.memory_limit))?;
    let (length, period) = (system.scales().length, options.standstill.period());
    require_reproducible_forces(model, length, period, options.standstill.time)?;
    let grid = TimeGrid::new(1, period)?;
    let workers = Workers::default().telling(watching.pulse());
    let mut observe = watching.with(observe);
    let mut guess_iterations = 0;
    let mut observe_steps = |iteration: &Iteration| {
        guess_iterations += 1;
        observe(Stage::InitialGuess, iteration)
    };
    let mut tracker = Tracker::new(&system, &workers, &mut observe_steps)?;
    let failure = begin(&mut tracker, &system, options, watching)?;
    let Tracker {
        mut newton,
        mut state,
        reached,
        ..
    } = tracker;
    let guess_time = start.elapsed();
    newton.timings = Timings::default();
    let report = match failure {
        Some((outcome, explanation)) => no_start(outcome, &explanation, reached),
        None => {
            let mut observe_newton = |iteration: &Iteration| observe(Stage::Newton, iteration);
            watching.stage(Stage::Newton);
            newton.solve(&mut state, &options.newton, &mut observe_newton)?
        }
    };
    let kind = Kind::Equilibrium {
        mesh_error: f64::INFINITY,
    };
    let mut solve = Solved {
        guess_iterations,
        guess_time,
        // Those of load steps are the guess.
        timings: newton.timings,
        total_time: start.elapsed(),
        ..Solved::known(&system, grid, (state, Vec::new()), report, kind)
    };
    if purpose != Purpose::Position {
        accept_indifferent(&mut newton, &mut solve)?;
    } else if solve.report.outcome.is_solution() {
        if solve.report.iterations.is_empty() {
            newton.linearise(&solve.state)?;
        }
        let estimate = mesh_error(model, &mut newton, &solve.state);
        let mesh_error = watching.unless_cancelled(estimate)?;
        solve.kind = Kind::Equilibrium {
            mesh_error: mesh_error.unwrap_or(f64::INFINITY),
        };
    }
    newton.equations.update_kinematics(&solve.state);
    solve.node_states = newton.equations.node_states().to_vec();
    solve.report.outcome = watching.outcome(solve.report.outcome);
    Ok(solve)
}

/// Of a solve without a start.
fn no_start(outcome: Outcome, explanation: &str, reached: f64) -> NewtonReport {
    let outcome = match outcome {
        Outcome::IterationLimit => Outcome::Stalled,
        other => other,
    };
    let explanation = format!(
        "load steps ended at the fraction {reached:.4} of loads and prescribed motions: \
         {explanation}"
    );
    NewtonReport::ended(outcome, explanation)
}

/// Takes a state for an equilibrium that a free motion may carry off.
fn accept_indifferent(newton: &mut Newton, solve: &mut Solved) -> Result<()> {
    if solve.report.outcome != Outcome::Singular {
        return Ok(());
    }
    newton.equations.set_conditions(Conditions::at(0.0))?;
    let mut residual = vec![0.0; newton.equations.size()];
    newton.equations.residual(&solve.state, &mut residual)?;
    // Written so that NaN fails too.
    if residual.iter().all(|r| r.abs() <= INDIFFERENT) {
        solve.report.outcome = Outcome::Converged;
    }
    Ok(())
}
