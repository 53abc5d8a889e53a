//! Periodic motions with free parameters, and as many conditions. See docs/theory.md, section 13.2.

use super::adaptive::Adaptation;
use super::estimate::assess;
use super::loads::Loads;
use super::options::{GridPoints, PeriodicOptions};
use super::solve_periodic;
use crate::collocation::{Collocation, GridState, require_like_blades};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::conditions::{Condition, Conditioned, Free};
use crate::solve::linear::cost::DirectCost;
use crate::solve::linear::method::Linear;
use crate::solve::linear::plan::Plan;
use crate::solve::newton::Newton;
use crate::solve::report::{Iteration, NewtonReport, Outcome, Timings};
use crate::solve::result::{GridTried, Kind, PeriodicRecord, Solved};
use crate::solve::start::InitialGuess;
use crate::solve::watch::Stage;
use crate::system::System;
use crate::workers::Workers;
use std::sync::Arc;
use std::time::Instant;

/// Finds a periodic response of `model` under conditions, and the values of as many free
/// parameters: gives the model with these, on whose period the solution is, and that. `period` is
/// the period, or a guess of it where the frequency is free.
///
/// Newton's method begins at a given state or, without one, at a solution with the parameters as
/// they are in the model. Where the frequency is free, signals and forces are functions of the
/// phase: harmonics and samples are, rates are for whole turns a period, and functions of the user
/// must be declared such.
///
/// # Errors
/// If options or model are not valid, free parameters are not different ones that move something,
/// conditions are not as many or cannot be met from the start; if the frequency is free and a
/// signal or a force has a frequency of its own. Not converging is an outcome, not an error.
pub fn solve_conditioned(
    model: &Model,
    period: f64,
    (free, conditions): (&[Free], &[Arc<dyn Condition>]),
    options: &PeriodicOptions,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<(Model, Solved)> {
    let began = Instant::now();
    options.validate()?;
    if options.oversampling > 1 {
        let (expected, got) = ("1 where parameters are free", options.oversampling);
        return Err(Error::value("options.oversampling", expected, got));
    }
    if conditions.len() != free.len() {
        let expected = format!("as many as there are free parameters ({})", free.len());
        return Err(Error::size("conditions", expected, conditions.len()));
    }
    Conditioned::new(model, period, free)?;
    let (start, before) = match &options.guess {
        InitialGuess::State(state) => (state.clone(), None),
        _ => {
            let held = solve_periodic(model, period, options, observe)?;
            if !held.report.outcome.is_solution() {
                return Ok((model.clone(), held));
            }
            (held.state.clone(), Some(held))
        }
    };
    let grid = match &before {
        Some(held) => held.grid,
        None => {
            TimeGrid::even_or_odd(start.points(), period)?.mapped(options.time_map.given(period)?)
        }
    };
    if let GridPoints::Fixed(points) = options.grid_points
        && points != grid.points()
    {
        let expected = format!("a state on {points} grid points");
        return Err(Error::size("options.guess", expected, grid.points()));
    }
    let system = Arc::new(System::new(model, period)?);
    require_like_blades(&system)?;
    let watching = options.watch.begin(Stage::Newton, grid.points());
    let mut observe = watching.with(observe);
    let mut solve = ConditionedSolve {
        free,
        conditions,
        options,
        workers: Workers::new(options.threads)?.telling(watching.pulse()),
        found: Found {
            model: model.clone(),
            system,
            grid,
            state: start,
        },
        timings: Timings::default(),
        iterations: 0,
        grids: Vec::new(),
    };
    let mut observe = |iteration: &Iteration| observe(Stage::Newton, iteration);
    let end = solve.on_all_grids(&mut observe);
    let mut report = match watching.unless_cancelled(end)? {
        Some(report) => report,
        None => NewtonReport::ended(Outcome::Cancelled, String::new()),
    };
    report.outcome = watching.outcome(report.outcome);
    let (model, mut solved) = solve.finish(report)?;
    if let Some(held) = before {
        solved.guess_iterations = held.guess_iterations + held.total_iterations;
        solved.guess_time = held.total_time;
    }
    solved.total_time = began.elapsed();
    Ok((model, solved))
}

struct ConditionedSolve<'a> {
    free: &'a [Free],
    conditions: &'a [Arc<dyn Condition>],
    options: &'a PeriodicOptions,
    workers: Workers,
    found: Found,
    timings: Timings,
    iterations: usize,
    grids: Vec<GridTried>,
}

/// The model with the values found so far, and the motion.
struct Found {
    model: Model,
    /// Of the model, for the period of the grid.
    system: Arc<System>,
    grid: TimeGrid,
    state: GridState,
}

impl ConditionedSolve<'_> {
    /// Solves on the first grid, and on finer ones if that is asked for.
    fn on_all_grids(
        &mut self,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<NewtonReport> {
        loop {
            let mut report = self.on_grid(observe)?;
            let GridPoints::Adaptive(adaptation) = self.options.grid_points else {
                return Ok(report);
            };
            if report.outcome != Outcome::Converged {
                return Ok(report);
            }
            let Some(next) = self.refined(&adaptation, &mut report)? else {
                return Ok(report);
            };
            let found = &mut self.found;
            let (system, grid) = (&found.system, found.grid);
            let next = system.shared_points(next, adaptation.largest);
            let finer = grid.with_points(next)?;
            match (found.state).resampled(system, grid, 0.0, finer, &self.workers) {
                Ok(resampled) => (found.grid, found.state) = (finer, resampled),
                Err(e) if e.kind() == ErrorKind::GridTooCoarse => {
                    report.outcome = Outcome::ToleranceNotMet;
                    report.explanation = e.to_string();
                    return Ok(report);
                }
                Err(e) => return Err(e),
            }
        }
    }

    fn on_grid(&mut self, observe: &mut dyn FnMut(&Iteration) -> bool) -> Result<NewtonReport> {
        let Found {
            model,
            system,
            grid,
            state,
        } = &mut self.found;
        let mut equations = Collocation::new(system.clone(), *grid)?;
        equations.set_workers(self.workers.clone());
        equations.update_kinematics(state);
        let conditioned = Conditioned::new(model, grid.period(), self.free)?;
        let conditioned = conditioned.under(self.conditions, &equations, state)?;
        state.scalars = conditioned.values(grid.period())?;
        equations.set_scalars(Arc::new(conditioned.clone()));
        let cost = DirectCost::of(system, grid.points());
        let plan = Plan::of_symmetric(&equations, self.options.linear, (f64::INFINITY, cost));
        let linear = Linear::planned(&equations, plan);
        let mut newton = Newton::bordered(equations, linear);
        let solved = newton.solve(state, &self.options.newton, observe);
        self.timings = self.timings + newton.timings;
        self.iterations += newton.iterations;
        let mut report = solved?;
        if report.outcome.is_solution() {
            newton.equations.update_kinematics(state);
            newton.equations.reduce_to_least_norm(state)?;
        }
        match conditioned.model_at(&state.scalars, grid.period()) {
            Ok((found, period)) => {
                *system = Arc::new(System::new(&found, period)?);
                *model = found;
                *grid = grid.with_period(period)?;
            }
            // Only an iterate that is none.
            Err(error) => {
                report.outcome = Outcome::Stalled;
                report.explanation = error.to_string();
            }
        }
        state.scalars.clear();
        Ok(report)
    }

    /// The points of the next grid, if the estimated error on this one is too large.
    fn refined(
        &mut self,
        adaptation: &Adaptation,
        report: &mut NewtonReport,
    ) -> Result<Option<usize>> {
        let Found {
            system,
            grid,
            state,
            ..
        } = &self.found;
        let loads = Loads::of(system, adaptation.largest)?;
        let (found, _) = assess(system, *grid, (state, None), &self.workers)?;
        let points = grid.points();
        self.grids.push(GridTried {
            points,
            iterations: report.iterations.len(),
            error_estimate: found.error,
        });
        if found.error <= adaptation.error_tolerance {
            return Ok(None);
        }
        let next = adaptation.next(points, &found, &loads);
        if next > points {
            return Ok(Some(next));
        }
        report.outcome = Outcome::ToleranceNotMet;
        report.explanation = format!(
            "the estimated error of the motions is {:.1e} on {points} grid points, and the \
             tolerance {:.1e}: no more are allowed",
            found.error, adaptation.error_tolerance
        );
        Ok(None)
    }

    fn finish(self, report: NewtonReport) -> Result<(Model, Solved)> {
        let Found {
            model,
            system,
            grid,
            state,
        } = self.found;
        let threads = self.options.threads;
        let solved = known(&system, (grid, state), report, threads, self.grids)?;
        let solved = Solved {
            timings: self.timings,
            total_iterations: self.iterations,
            ..solved
        };
        Ok((model, solved))
    }
}

/// A periodic motion of a system that was found somehow.
pub(crate) fn known(
    system: &Arc<System>,
    (grid, mut state): (TimeGrid, GridState),
    report: NewtonReport,
    threads: usize,
    grids: Vec<GridTried>,
) -> Result<Solved> {
    let mut equations = Collocation::new(system.clone(), grid)?;
    state.scalars.clear();
    equations.update_kinematics(&state);
    let node_states = equations.node_states().to_vec();
    let record = PeriodicRecord {
        grids,
        coarse_start: None,
        attempts: Vec::new(),
        iterative: None,
        threads,
        assessment: None,
        mesh_error: f64::INFINITY,
    };
    Ok(Solved::known(
        system,
        grid,
        (state, node_states),
        report,
        Kind::Periodic(record),
    ))
}
