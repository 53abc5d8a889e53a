//! Newton's method for the periodic motion on one grid after the other.

use super::Newton;
use crate::collocation::{Collocation, GridState, Leaders, LikeBlades};
use crate::error::{ErrorKind, Result};
use crate::fourier::{Resampling, TimeGrid};
use crate::solve::linear::cost::{DirectCost, easy_iteration};
use crate::solve::linear::iterative::Projected;
use crate::solve::linear::method::{Linear, LinearMethod};
use crate::solve::linear::plan::Plan;
use crate::solve::memory::{MemoryLimit, of_grid};
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome, Timings};
use crate::solve::watch::{Stage, Watching};
use crate::system::System;
use crate::workers::Workers;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What is added to the work of an easy iteration, in multiply-adds: on small models more may be
/// tried.
const LEAST_ITERATION: f64 = 1.6e9;
/// On a given grid this many times as much.
const GIVEN: f64 = 2.0;

/// How equations are solved, on whatever grid.
pub(crate) struct Means {
    /// When to stop.
    pub newton: NewtonOptions,
    /// How linear equations are solved.
    pub linear: LinearMethod,
    /// Equations are sampled at this many times as many points.
    pub oversampling: usize,
    /// Who shares the work.
    pub workers: Workers,
    /// Most work, relative to that of an easy iteration on the finest grid; zero without bound.
    pub work_limit: f64,
    /// Whether the grid is given: then nothing coarser is the result where work is not enough.
    pub is_given: bool,
    /// What it may take of memory.
    pub memory: MemoryLimit,
}

impl Means {
    /// Allows the work that goes with a grid, on which factors of the whole Jacobian take so much,
    /// if that is more than with those before.
    pub fn allow(&self, system: &System, grid: TimeGrid, factors: DirectCost) {
        if self.work_limit > 0.0 {
            let unit = LEAST_ITERATION + easy_iteration(system, grid.points(), factors);
            let share = if self.is_given { GIVEN } else { 1.0 };
            self.workers
                .work()
                .allow_more(share * self.work_limit * unit);
        }
    }

    /// Newton's method on a grid.
    fn on(&self, system: &Arc<System>, grid: TimeGrid) -> Result<Newton<Projected<Linear>>> {
        let start = Instant::now();
        let cost = DirectCost::of(system, grid.points());
        self.allow(system, grid, cost);
        let sampled = grid.points().saturating_mul(self.oversampling);
        self.memory.require_grid(system, sampled)?;
        let mut equations = Collocation::new(system.clone(), grid)?;
        equations.set_workers(self.workers.clone());
        if self.oversampling > 1 {
            equations.oversample(self.oversampling)?;
        }
        let states = of_grid(system, sampled) as f64;
        let most = self.memory.bytes() - states;
        let plan = Plan::of_symmetric(&equations, self.linear, (most, cost));
        let what = format!("a solve on a grid of {} points", grid.points());
        self.memory.require(&what, (states + plan.bytes) as usize)?;
        let linear = Linear::planned(&equations, plan);
        let linear = Projected::new(&equations, linear);
        let mut newton = Newton::with(equations, linear);
        newton.timings.analysis = start.elapsed();
        Ok(newton)
    }
}

/// Sees each iteration and returns `false` to cancel.
pub(crate) type Observer<'a> = dyn FnMut(&Iteration) -> bool + 'a;

/// Sees each iteration and at which stage it is, and returns `false` to cancel.
pub(crate) type StageObserver<'a> = dyn FnMut(Stage, &Iteration) -> bool + 'a;

/// State and report of a Newton solve.
pub(crate) type Found = (GridState, NewtonReport);

/// A periodic problem on its present grid.
pub(crate) struct OnGrid<'a> {
    pub system: Arc<System>,
    pub grid: TimeGrid,
    pub means: Means,
    pub newton: Newton<Projected<Linear>>,
    /// Whether anything was done with it, and what was made for another grid before that.
    is_used: bool,
    unused: Option<(TimeGrid, Newton<Projected<Linear>>)>,
    pub watching: Watching,
    observe: &'a mut StageObserver<'a>,
    /// Newton iterations at single instants, to find starts, and the time that starts took.
    pub start_iterations: usize,
    pub start_time: Duration,
    /// Time spent on grids before the present one, and iterations there.
    pub timings: Timings,
    iterations: usize,
    /// Where Newton's method ended last, and how.
    last: Option<(TimeGrid, Found)>,
}

impl<'a> OnGrid<'a> {
    pub fn new(
        system: &Arc<System>,
        grid: TimeGrid,
        means: Means,
        watching: Watching,
        observe: &'a mut StageObserver<'a>,
    ) -> Result<Self> {
        Ok(OnGrid {
            newton: means.on(system, grid)?,
            is_used: false,
            unused: None,
            system: system.clone(),
            grid,
            means,
            watching,
            observe,
            start_iterations: 0,
            start_time: Duration::ZERO,
            timings: Timings::default(),
            iterations: 0,
            last: None,
        })
    }

    /// Time spent on all grids.
    pub fn all_timings(&self) -> Timings {
        self.timings + self.newton.timings
    }

    /// Newton iterations on all grids.
    pub fn all_iterations(&self) -> usize {
        self.iterations + self.newton.iterations
    }

    /// From `state`.
    pub fn solve(&mut self, state: GridState) -> Result<Found> {
        let options = self.means.newton;
        self.solve_to(state, &options)
    }

    /// From `state`, to another tolerance.
    pub fn solve_to(&mut self, mut state: GridState, options: &NewtonOptions) -> Result<Found> {
        self.is_used = true;
        self.watching.stage(Stage::Newton);
        let observe = &mut *self.observe;
        let mut observe = |iteration: &Iteration| observe(Stage::Newton, iteration);
        match self.newton.solve(&mut state, options, &mut observe) {
            Ok(report) => {
                let found = (state, report);
                self.last = Some((self.grid, found.clone()));
                Ok(found)
            }
            // Where the start cannot be interpolated there is no residual to begin with.
            Err(e) if e.kind() == ErrorKind::GridTooCoarse && self.means.oversampling > 1 => {
                Ok((state, NewtonReport::ended(Outcome::Stalled, e.to_string())))
            }
            Err(e) => Err(e),
        }
    }

    /// Goes on from a solution to the tolerance that is asked for.
    pub fn complete(&mut self, (mut state, mut report): Found) -> Result<Found> {
        let is_last = self.is_used && self.last.as_ref().is_some_and(|(of, _)| *of == self.grid);
        self.is_used = true;
        self.watching.stage(Stage::Newton);
        let (before, options) = (report.iterations.len(), self.means.newton);
        let observe = &mut *self.observe;
        let mut observe = |iteration: &Iteration| {
            let number = before + iteration.number;
            let iteration = Iteration {
                number,
                ..*iteration
            };
            report.iterations.push(iteration);
            observe(Stage::Newton, &iteration)
        };
        let found = match is_last {
            true => self.newton.go_on(&mut state, &options, &mut observe)?,
            false => self.newton.solve(&mut state, &options, &mut observe)?,
        };
        if !found.outcome.is_solution() {
            (report.outcome, report.explanation) = (found.outcome, found.explanation);
        }
        Ok((state, report))
    }

    /// What there is when the solve is cancelled where Newton's method does not see it.
    pub fn cancelled(&mut self) -> Result<Found> {
        let Some((grid, (state, report))) = self.last.take() else {
            let report = NewtonReport::ended(Outcome::Cancelled, String::new());
            return Ok((GridState::reference(&self.system, self.grid), report));
        };
        self.move_to(grid)?;
        let report = NewtonReport {
            iterations: report.iterations,
            ..NewtonReport::ended(Outcome::Cancelled, String::new())
        };
        Ok((state, report))
    }

    /// Looks for a start by `find`, and keeps count of its cost.
    pub fn look_for_start<G>(
        &mut self,
        find: impl FnOnce(&Arc<System>, &mut Observer) -> Result<G>,
    ) -> Result<G> {
        let began = Instant::now();
        self.watching.stage(Stage::InitialGuess);
        let (observe, count) = (&mut *self.observe, &mut self.start_iterations);
        let start = find(&self.system, &mut |iteration| {
            *count += 1;
            observe(Stage::InitialGuess, iteration)
        });
        self.start_time += began.elapsed();
        start
    }

    /// Goes on with another grid.
    pub fn move_to(&mut self, grid: TimeGrid) -> Result<()> {
        if grid == self.grid {
            return Ok(());
        }
        let made = self.unused.take().filter(|(of, _)| *of == grid);
        let mut next = match made {
            Some((_, made)) => made,
            None => self.means.on(&self.system, grid)?,
        };
        let last = self.newton.linear.sampled();
        next.linear.sampled_mut().learn_from(last);
        let last = (self.grid, self.replace_solver(next));
        self.unused = (!self.is_used).then_some(last);
        self.is_used = false;
        self.grid = grid;
        self.watching.grid(grid.points());
        Ok(())
    }

    /// Whether an outcome leaves no reason to try another start: what nothing holds is free from
    /// any of them.
    pub fn is_final(&self, outcome: Outcome) -> bool {
        outcome.is_final() || outcome == Outcome::Singular && self.system.has_floating_nodes()
    }

    /// Forgets what has been found about the equations, which the present grid may not share.
    pub fn begin_again(&mut self) -> Result<()> {
        let next = self.means.on(&self.system, self.grid)?;
        self.replace_solver(next);
        self.is_used = false;
        Ok(())
    }

    /// Gives the former one, of which time and iterations are counted.
    fn replace_solver(&mut self, next: Newton<Projected<Linear>>) -> Newton<Projected<Linear>> {
        let mut last = std::mem::replace(&mut self.newton, next);
        self.timings = self.timings + std::mem::take(&mut last.timings);
        self.iterations += last.iterations;
        last
    }

    /// Goes on with another grid, from a solution on the present one; none if that is too coarse to
    /// tell.
    ///
    /// The first tangent there is of stress resultants that are carried, too: those of strains
    /// between grid points know too much of stretching by turns that are a little off.
    pub fn carry_to(&mut self, grid: TimeGrid, state: &GridState) -> Result<Option<GridState>> {
        let (from, began) = (self.grid, Instant::now());
        self.means
            .memory
            .require_grid(&self.system, grid.points())?;
        let alike = self.newton.alike.clone();
        self.newton.update_kinematics(state);
        let equations = &mut self.newton.equations;
        let resampling = Resampling::between(from, 0.0, grid);
        let resultants = equations.resampled_resultants(resampling, alike.as_deref())?;
        self.start_time += began.elapsed();
        self.move_to(grid)?;
        let leaders = alike.and_then(|_| Leaders::on(&self.system, grid));
        let start = self.resampled_alike(state, from, (grid, leaders.as_ref()))?;
        if start.is_some() {
            self.is_used = true;
            self.newton.equations.set_resultants(resultants);
        }
        Ok(start)
    }

    /// A state on the grid `from`, at the points of the present one; none if `from` is too coarse
    /// to tell.
    pub fn carried(&mut self, state: &GridState, from: TimeGrid) -> Result<Option<GridState>> {
        self.resampled(state, from, self.grid)
    }

    /// The same of a quasi-static motion: like blades move alike in it.
    pub fn carried_alike(
        &mut self,
        state: &GridState,
        from: TimeGrid,
    ) -> Result<Option<GridState>> {
        let to = self.grid;
        let alike = LikeBlades::on(&self.system, from);
        let leaders = alike.and_then(|_| Leaders::on(&self.system, to));
        self.resampled_alike(state, from, (to, leaders.as_ref()))
    }

    /// The same at the points of any grid.
    pub fn resampled(
        &mut self,
        state: &GridState,
        from: TimeGrid,
        to: TimeGrid,
    ) -> Result<Option<GridState>> {
        self.resampled_alike(state, from, (to, None))
    }

    /// The same of a state in which blades move alike, from what leads on the other grid.
    fn resampled_alike(
        &mut self,
        state: &GridState,
        from: TimeGrid,
        (to, leaders): (TimeGrid, Option<&Leaders>),
    ) -> Result<Option<GridState>> {
        if from == to {
            return Ok(Some(state.clone()));
        }
        let began = Instant::now();
        let (system, workers) = (&self.system, &self.means.workers);
        let resampling = Resampling::between(from, 0.0, to);
        let carried = state.resampled_alike(system, &resampling, (to, leaders), workers);
        self.start_time += began.elapsed();
        match carried {
            Ok(state) => Ok(Some(state)),
            Err(e) if e.kind() == ErrorKind::GridTooCoarse => Ok(None),
            Err(e) => Err(e),
        }
    }
}
