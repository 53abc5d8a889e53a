//! A point of a branch, and the next one (docs/theory.md, section 13.3).

use super::BranchOptions;
use super::course::{Course, Resultants};
use super::determinants::Determinants;
use super::step::Shown;
use crate::collocation::{Collocation, Decay, GridState};
use crate::error::{ErrorKind, Result};
use crate::fourier::{Resampling, TimeGrid};
use crate::model::Model;
use crate::solve::conditions::{Condition, Conditioned, Free, Given, InnerProduct};
use crate::solve::linear::bordered::Bordered;
use crate::solve::linear::method::Linear;
use crate::solve::newton::Newton;
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome};
use crate::solve::stability::Experience;
use crate::solve::watch::{Stage, Watching};
use crate::system::System;
use crate::workers::Workers;
use std::sync::Arc;

/// Most Newton iterations of a step.
const ITERATION_LIMIT: usize = 8;
/// Steps with the same matrix that are worth no other one: that takes borders, too.
const CHORDS: i32 = 6;

/// A solution and the direction in which the branch goes on.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// With all free parameters as its scalars, that which is followed last.
    pub state: GridState,
    /// Of unit length; not scaled.
    pub tangent: Vec<f64>,
    /// How the branch bends, if it is known.
    pub course: Option<Course>,
    /// Stress resultants, if they are known.
    pub resultants: Option<Resultants>,
}

impl Place {
    /// Where nothing is known of how the branch bends.
    pub fn new(state: GridState, tangent: Vec<f64>) -> Self {
        Place {
            state,
            tangent,
            course: None,
            resultants: None,
        }
    }
}

/// A step that led to a solution.
pub(super) struct Stepped {
    pub to: Place,
    pub shown: Shown,
    pub iterations: usize,
}

/// What goes with a grid.
pub(super) struct Before {
    newton: Newton<Bordered<Linear>>,
    determinants: Option<Determinants>,
}

/// Goes from one point to the next.
pub(super) struct Walk<'a> {
    pub options: &'a BranchOptions,
    pub conditioned: Conditioned,
    pub newton: Newton<Bordered<Linear>>,
    /// What counts as 1 in the free parameters, for lengths along the branch.
    pub scales: Vec<f64>,
    pub workers: Workers,
    pub watching: Watching,
    pub product: InnerProduct,
    pub determinants: Option<Determinants>,
    /// Newton iterations on earlier grids.
    before: usize,
    /// Whether the equations were linearised last near the end of a solve.
    pub near: bool,
    /// What was added to the last tangent that was guessed, relative to it.
    pub added: f64,
    /// What the last multipliers have taken.
    pub experience: Option<Experience>,
    /// Whether it was seen on this grid what acts on what.
    looked: bool,
}

impl<'a> Walk<'a> {
    pub fn new(
        model: &Model,
        grid: TimeGrid,
        free: &[Free],
        (options, workers, watching): (&'a BranchOptions, Workers, Watching),
    ) -> Result<Self> {
        let conditioned = Conditioned::new(model, grid.period(), free)?;
        let system = Arc::new(System::new(model, grid.period())?);
        let newton = solver(&system, grid, &conditioned, options, &workers)?;
        let equations = &newton.equations;
        let mut scales = equations.column_scale()[equations.layout().scalars()].to_vec();
        let [low, high] = options.range;
        *scales.last_mut().unwrap_or(&mut 1.0) = high - low;
        Ok(Walk {
            product: InnerProduct::new(equations, options.motion_scale),
            determinants: Determinants::wanted(options, equations),
            options,
            conditioned,
            newton,
            scales,
            workers,
            watching,
            before: 0,
            near: false,
            added: 1.0,
            experience: None,
            looked: false,
        })
    }

    /// Newton iterations on all grids.
    pub fn iterations(&self) -> usize {
        self.before + self.newton.iterations
    }

    /// The value of the parameter that is followed.
    pub fn parameter(&self, state: &GridState) -> f64 {
        state.scalars[self.scales.len() - 1]
    }

    /// Derivative of that by the arc length, over its scale.
    pub fn slope(&self, place: &Place) -> f64 {
        let last = place.tangent.len() - 1;
        place.tangent[last] / self.scales[self.scales.len() - 1]
    }

    /// Takes `last` for the condition on the parameter that is followed, in a solve from `state`.
    fn set_condition(&mut self, last: Arc<dyn Condition>, state: &GridState) -> Result<()> {
        self.set_conditions(vec![last], state)
    }

    /// Takes these conditions beside those of the options, in a solve from `state`.
    pub fn set_conditions(
        &mut self,
        last: Vec<Arc<dyn Condition>>,
        state: &GridState,
    ) -> Result<()> {
        let equations = &mut self.newton.equations;
        equations.apply_scalars(state)?;
        equations.update_kinematics(state);
        let mut conditions = self.options.conditions.clone();
        conditions.extend(last);
        let conditioned = self.conditioned.under(&conditions, equations, state)?;
        equations.set_scalars(Arc::new(conditioned));
        if self.options.conditions.is_empty() {
            // Near a fold alone it is singular.
            equations.ground(0.0);
        }
        Ok(())
    }

    /// Solves from `state`; what cannot be evaluated there is no solution.
    fn solve(&mut self, state: &mut GridState, limit: usize) -> Result<NewtonReport> {
        let options = NewtonOptions {
            iteration_limit: limit.min(self.options.periodic.newton.iteration_limit),
            ..self.options.periodic.newton
        };
        self.look_for_parts(state)?;
        let watching = self.watching.clone();
        let mut observe = |iteration: &Iteration| watching.iteration(Stage::Newton, iteration);
        let solved = self.newton.solve(state, &options, &mut observe);
        let converged = |report: &NewtonReport| report.outcome == Outcome::Converged;
        self.near = solved.as_ref().is_ok_and(converged) && self.newton.contracts();
        match solved {
            Err(e) if self.watching.cancels(&e) => {
                Ok(NewtonReport::ended(Outcome::Cancelled, String::new()))
            }
            Err(e) if !matches!(e.kind(), ErrorKind::Callback | ErrorKind::OutOfMemory) => {
                Ok(NewtonReport::ended(Outcome::Stalled, e.to_string()))
            }
            end => end,
        }
    }

    /// Has what solves linear equations look at the first state on a grid.
    fn look_for_parts(&mut self, state: &GridState) -> Result<()> {
        if std::mem::replace(&mut self.looked, true) {
            return Ok(());
        }
        let Newton {
            equations, linear, ..
        } = &mut self.newton;
        equations.apply_scalars(state)?;
        let seen = linear.inner.look_for_parts(equations, state);
        // What cannot be evaluated is no solution, as the solve will tell.
        found_or_none(seen.map(Some)).map(|_| ())
    }

    /// The solution at a value of the parameter, near `state`.
    pub fn at_parameter(
        &mut self,
        mut state: GridState,
        value: f64,
    ) -> Result<(GridState, NewtonReport)> {
        let free = self.scales.len() - 1;
        self.set_condition(Arc::new(Given { free, value }), &state)?;
        state.scalars[free] = value;
        let report = self.solve(&mut state, ITERATION_LIMIT)?;
        Ok((state, report))
    }

    /// The solution at a value of the parameter between two places, near the second of them.
    pub fn between(
        &mut self,
        from: &Place,
        to: &Place,
        value: f64,
    ) -> Result<(GridState, NewtonReport)> {
        let free = self.scales.len() - 1;
        self.set_condition(Arc::new(Given { free, value }), &to.state)?;
        let (course, arc) = self.course(from, to);
        let change = value - self.parameter(&to.state);
        let back = course.back_to(to.tangent.len() - 1, &to.tangent, change, arc);
        let increment = course.increment(&to.tangent, back);
        let system = self.newton.equations.system().clone();
        let mut state = to.state.incremented(&system, &increment, 1.0);
        state.scalars[free] = value;
        self.predict_resultants(&increment);
        let report = self.solve(&mut state, ITERATION_LIMIT)?;
        Ok((state, report))
    }

    /// The solution that is `length` away from `from` in a direction of motions, where the free
    /// parameters are near `values`.
    pub fn aside(
        &mut self,
        mut from: GridState,
        values: Vec<f64>,
        (mut direction, length): (Vec<f64>, f64),
    ) -> Result<(GridState, NewtonReport)> {
        from.scalars = values;
        let layout = self.newton.equations.layout();
        direction.resize(layout.size(), 0.0);
        let size = self.product.of(layout, &direction, &direction).sqrt();
        direction.iter_mut().for_each(|x| *x /= size);
        let system = self.newton.equations.system().clone();
        let mut state = from.incremented(&system, &direction, length);
        let aside = self.arc(&from, &direction, length);
        self.set_condition(Arc::new(aside), &from)?;
        let report = self.solve(&mut state, usize::MAX)?;
        Ok((state, report))
    }

    /// `⟨a, b⟩` of motions and free parameters.
    pub fn inner(&self, a: &[f64], b: &[f64]) -> f64 {
        let layout = self.newton.equations.layout();
        let scalars = a[layout.scalars()].iter().zip(&b[layout.scalars()]);
        let scalars = scalars.zip(&self.scales);
        let scalars: f64 = scalars.map(|((a, b), s)| a * b / (s * s)).sum();
        self.product.of(layout, a, b) + scalars
    }

    /// What a state is away from another, on the same grid.
    pub fn away(&self, from: &GridState, to: &GridState) -> Vec<f64> {
        let layout = self.newton.equations.layout();
        let mut away = vec![0.0; layout.size()];
        InnerProduct::write_difference(from, to, &mut away[layout.motions()]);
        let scalars = to.scalars.iter().zip(&from.scalars);
        for (x, (to, from)) in away[layout.scalars()].iter_mut().zip(scalars) {
            *x = to - from;
        }
        away
    }

    /// The point at `length` along the branch from a place; none, and why, where there is no
    /// solution.
    pub fn step(
        &mut self,
        from: &Place,
        length: f64,
    ) -> Result<std::result::Result<Stepped, NewtonReport>> {
        self.step_near(from, length, (from, 0.0))
    }

    /// The same, starting at a point `near` that, which is so far along the branch from the first.
    pub fn step_near(
        &mut self,
        from: &Place,
        length: f64,
        (near, passed): (&Place, f64),
    ) -> Result<std::result::Result<Stepped, NewtonReport>> {
        let arc = self.arc(&from.state, &from.tangent, length);
        self.set_condition(Arc::new(arc), &from.state)?;
        let system = self.newton.equations.system().clone();
        let predicted = from.state.incremented(&system, &from.tangent, length);
        let ahead = (length - passed) / self.inner(&near.tangent, &from.tangent);
        let (increment, rate, resultants) = match &near.course {
            None => {
                let straight = near.tangent.iter().map(|x| ahead * x);
                (straight.collect(), None, Vec::new())
            }
            Some(course) => {
                // As far as the step is to lead along the first tangent.
                let along = |x: &[f64]| self.inner(x, &from.tangent);
                let ahead = course.reaching(length - passed, &near.tangent, along);
                let rate = course.rate(&near.tangent, ahead);
                let increment = course.increment(&near.tangent, ahead);
                (increment, Some(rate), course.resultants(ahead))
            }
        };
        let mut state = near.state.incremented(&system, &increment, 1.0);
        if ahead != 0.0 && resultants.is_empty() {
            if passed != 0.0 {
                self.newton.equations.apply_scalars(&near.state)?;
                self.newton.equations.update_kinematics(&near.state);
            }
            let straight: Vec<f64> = near.tangent.iter().map(|x| ahead * x).collect();
            self.predict_resultants(&straight);
        } else if !resultants.is_empty() {
            self.newton.equations.set_resultants(resultants);
        }
        let report = self.solve(&mut state, ITERATION_LIMIT)?;
        if report.outcome != Outcome::Converged {
            self.newton.trusts = false;
            return Ok(Err(report));
        }
        self.newton.trusts = true;
        let found = self.tangent(&state, Some(&from.tangent), rate.as_deref())?;
        let Some(tangent) = found else {
            let why = "no tangent of the branch could be found".to_string();
            return Ok(Err(NewtonReport::ended(Outcome::Singular, why)));
        };
        let error = self.away(&predicted, &state);
        let cosine = self.inner(&tangent, &from.tangent).clamp(-1.0, 1.0);
        let angle = cosine.acos();
        let mut to = Place::new(state, tangent);
        to.resultants = found_or_none(self.resultants_at(&to))?;
        if length >= self.options.smallest_step {
            let (mut course, arc) = self.course(from, &to);
            if let (Some(before), Some(now)) = (&from.resultants, &to.resultants) {
                course.carry(before, now, arc);
            }
            to.course = Some(course.damped());
        }
        Ok(Ok(Stepped {
            shown: Shown {
                angle,
                prediction: self.inner(&error, &error).sqrt() / length.abs(),
            },
            to,
            iterations: report.iterations.len(),
        }))
    }

    /// Goes on with another number of grid points; none where the motion cannot be interpolated, is
    /// no longer a solution, or leaves out more than `tolerance`.
    pub fn refine(
        &mut self,
        place: &Place,
        points: usize,
        tolerance: Option<f64>,
    ) -> Result<Option<Place>> {
        let Some((place, before)) = self.take_grid(place, points)? else {
            return Ok(None);
        };
        if let Ok(found) = self.step(&place, 0.0)? {
            let equations = &self.newton.equations;
            let decay = Decay::of(equations.system(), equations.grid(), &found.to.state);
            if tolerance.is_none_or(|tolerance| decay.tail <= tolerance) {
                return Ok(Some(found.to));
            }
        }
        self.give_back(before);
        Ok(None)
    }

    /// Takes another grid, and a place prolonged to it; none if its motion cannot be interpolated.
    pub fn take_grid(&mut self, place: &Place, points: usize) -> Result<Option<(Place, Before)>> {
        let equations = &self.newton.equations;
        let (system, grid) = (equations.system().clone(), equations.grid());
        let other = TimeGrid::even_or_odd(points, grid.period())?;
        let state = match place
            .state
            .resampled(&system, grid, 0.0, other, &self.workers)
        {
            Ok(state) => state,
            Err(e) if e.kind() == ErrorKind::GridTooCoarse => return Ok(None),
            Err(e) => return Err(e),
        };
        let tangent = self.resampled(&place.tangent, grid, points);
        let nominal = TimeGrid::even_or_odd(points, system.period())?;
        let next = solver(
            &system,
            nominal,
            &self.conditioned,
            self.options,
            &self.workers,
        )?;
        let newton = std::mem::replace(&mut self.newton, next);
        (self.near, self.looked) = (false, false);
        let determinants = Determinants::wanted(self.options, &self.newton.equations);
        let determinants = std::mem::replace(&mut self.determinants, determinants);
        self.before += newton.iterations;
        let before = Before {
            newton,
            determinants,
        };
        Ok(Some((Place::new(state, tangent), before)))
    }

    /// Takes the grid back that there was before.
    pub fn give_back(&mut self, before: Before) {
        self.before += self.newton.iterations;
        self.newton = before.newton;
        (self.near, self.looked) = (false, true);
        self.determinants = before.determinants;
        self.before -= self.newton.iterations;
    }

    /// An increment on another grid.
    pub fn resampled(&self, increment: &[f64], grid: TimeGrid, points: usize) -> Vec<f64> {
        let system = self.newton.equations.system();
        resampled(increment, system, grid, points, self.scales.len())
    }
}

/// What was found, or nothing where it could not be evaluated; errors that are not those of a place
/// stay.
pub(super) fn found_or_none<T>(found: Result<Option<T>>) -> Result<Option<T>> {
    match found {
        Err(e) if !matches!(e.kind(), ErrorKind::Callback | ErrorKind::OutOfMemory) => Ok(None),
        found => found,
    }
}

/// Newton's method with free parameters.
fn solver(
    system: &Arc<System>,
    grid: TimeGrid,
    conditioned: &Conditioned,
    options: &BranchOptions,
    workers: &Workers,
) -> Result<Newton<Bordered<Linear>>> {
    let mut equations = Collocation::new(system.clone(), grid)?;
    equations.set_workers(workers.clone());
    equations.set_scalars(Arc::new(conditioned.clone()));
    // Blades that move alike are no premise here: a branch may leave them.
    let linear = Linear::along_branch(&equations, options.periodic.linear);
    let mut newton = Newton::bordered(equations, linear);
    newton.chords = CHORDS;
    Ok(newton)
}

/// An increment on another grid.
fn resampled(
    increment: &[f64],
    system: &System,
    grid: TimeGrid,
    points: usize,
    scalars: usize,
) -> Vec<f64> {
    let from = system.layout(grid.points()).with_scalars(scalars);
    let to = system.layout(points).with_scalars(scalars);
    let mut result = vec![0.0; to.size()];
    let mut resampling = Resampling::new(grid, 0.0, points);
    let mut values = vec![0.0; points];
    let mut carry = |read: &dyn Fn(usize) -> usize, write: &dyn Fn(usize) -> usize| {
        resampling.read((0..grid.points()).map(|k| increment[read(k)]));
        resampling.write(0, 0, &mut values);
        for (k, value) in values.iter().enumerate() {
            result[write(k)] = *value;
        }
    };
    for node in 0..system.nodes() {
        for i in 0..6 {
            let read = |k: usize| from.motion(node, k).start + i;
            carry(&read, &|k| to.motion(node, k).start + i);
        }
    }
    for placed in system.elements() {
        for row in 0..placed.element.own_unknowns() {
            let read = |k: usize| from.element_at(placed, k).start + row;
            carry(&read, &|k| to.element_at(placed, k).start + row);
        }
    }
    result[to.scalars()].copy_from_slice(&increment[from.scalars()]);
    result
}
