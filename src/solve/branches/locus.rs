//! Points where an event happens, along a second parameter (docs/theory.md, section 13.8).

use super::augmented::Located;
use super::event_equation::EventEquation;
use super::follow::Follow;
use super::step::Shown;
use super::walk::{Place, Walk, found_or_none};
use super::{Branch, BranchEnd, BranchOptions, BranchPoint, Event};
use crate::collocation::GridState;
use crate::error::{Error, ErrorKind, Result};
use crate::solve::conditions::{Condition, Conditioned, Free, Given};
use crate::solve::linear::dense::probe;
use crate::solve::watch::Stage;
use crate::workers::Workers;
use std::sync::Arc;

/// Follows the folds, period doublings or torus points of which `branch` has one at `index`, along
/// a `second` parameter, from its value in the model on: the parameter of the branch is free beside
/// it. The grid gets finer along it, unless a number of points is given.
///
/// The range of the options is that of the second parameter, and their conditions are those of the
/// branch. Of the points of what is returned [`BranchPoint::values`] are the second parameter, and
/// then those that are free beside it, that of the branch last.
///
/// # Errors
/// [`ErrorKind::NotAvailable`] if there is no such event, or if it is a branch point; else as
/// [`follow_branch`](super::follow_branch).
pub fn follow_locus(
    branch: &Branch,
    index: usize,
    second: Free,
    options: &BranchOptions,
    observe: &mut dyn FnMut(usize, &BranchPoint) -> bool,
) -> Result<Branch> {
    options.validate()?;
    let (model, solved) = branch.solved(index)?;
    let point = &branch.points[index];
    let event = event_at(point, index)?;
    let mut free = branch.conditioned.free().to_vec();
    free.push(second);
    options.require_conditions(free.len() - 2)?;
    let (grid, mut state) = (solved.grid, solved.state);
    let conditioned = Conditioned::new(&model, grid.period(), &free)?;
    state.scalars = conditioned.values(grid.period())?;
    options.require_within(&model, grid.period(), second)?;
    let watching = options.periodic.watch.begin(Stage::Newton, grid.points());
    let workers = Workers::new(options.periodic.threads)?.telling(watching.pulse());
    let locus = Branch {
        threads: options.periodic.threads,
        locus: Some(event),
        ..Branch::empty(conditioned, grid.period())
    };
    let walk = Walk::new(&model, grid, &free, (options, workers, watching))?;
    let mut follow = Follow::new(walk, locus, observe);
    let frequency = point.second_frequency.unwrap_or(0.0);
    let beside = beside(branch, index, &follow.walk);
    let went = follow.along_locus(state, (event, frequency), beside);
    follow.end(went)
}

/// The event at a point of a branch that can be followed.
fn event_at(point: &BranchPoint, index: usize) -> Result<Event> {
    let none = |why: &str| {
        let message = format!("point: {why} point {index}");
        Err(Error::new(ErrorKind::NotAvailable, message))
    };
    match point.event {
        Some(event @ (Event::Fold | Event::PeriodDoubling | Event::Torus)) => Ok(event),
        Some(Event::BranchPoint) => none("branch points cannot be followed, as that at"),
        None => none("nothing happens at"),
    }
}

/// The direction of a branch at a point, about: from one neighbour to another on the same grid.
/// None if there are no such.
fn beside(branch: &Branch, index: usize, walk: &Walk) -> Option<Vec<f64>> {
    let grid = branch.points[index].grid.points();
    let [first, last] = [index.saturating_sub(1), index + 1].map(|i| branch.points.get(i));
    let [first, last] = [first?, last?];
    if [first, last].iter().any(|p| p.grid.points() != grid) {
        return None;
    }
    let [from, to] = [first, last].map(|point| {
        let mut state = point.state.clone();
        // The second parameter is the same at both.
        state.scalars = point.values[1..].to_vec();
        state.scalars.extend([point.values[0], 0.0]);
        state
    });
    Some(walk.away(&from, &to))
}

/// A point of a locus.
struct OnLocus {
    place: Place,
    located: Located,
    frequency: f64,
}

/// A step along a locus.
struct Step {
    to: OnLocus,
    shown: Shown,
    length: f64,
}

impl Follow<'_, '_> {
    fn along_locus(
        &mut self,
        state: GridState,
        (event, frequency): (Event, f64),
        beside: Option<Vec<f64>>,
    ) -> Result<()> {
        let own = EventEquation::new(event, frequency, &self.walk, &state)?;
        let Some(mut own) = own else {
            self.ends(
                BranchEnd::NoStart,
                "the equations could not be factored there",
            );
            return Ok(());
        };
        let (basis, free) = (
            self.first_directions(&own, beside),
            self.walk.scales.len() - 1,
        );
        let value = self.walk.parameter(&state);
        let given: Arc<dyn Condition> = Arc::new(Given { free, value });
        let first = self.located(&state, &mut own, (&basis, given), None)?;
        let Some(mut here) = first else {
            self.ends(
                BranchEnd::NoStart,
                "the event was not found by its own equation",
            );
            return Ok(());
        };
        let wanted = if self.walk.options.downwards {
            -1.0
        } else {
            1.0
        };
        if self.walk.slope(&here.place) * wanted < 0.0 {
            here.place.tangent.iter_mut().for_each(|x| *x = -*x);
        }
        if !self.keep_on_locus(&here, [0.0; 2])? {
            return Ok(());
        }
        let mut step = self.walk.options.first_step;
        loop {
            if !own.renew()? {
                self.ends(
                    BranchEnd::SmallestStep,
                    "the equations could not be factored",
                );
                return Ok(());
            }
            let Some(taken) = self.step_on_locus(&here, &mut own, step)? else {
                return Ok(());
            };
            if let Some(bound) = self.bound_beyond(&taken.to.place) {
                let Some(last) = self.at_bound(&here, &taken, bound, &mut own)? else {
                    // Nearer to the end it is found.
                    step = 0.5 * taken.length;
                    self.branch.rejected += 1;
                    if step < self.walk.options.smallest_step {
                        self.ends(BranchEnd::Range, "");
                        return Ok(());
                    }
                    continue;
                };
                let away = self.walk.away(&here.place.state, &last.place.state);
                let length = self.walk.inner(&away, &here.place.tangent);
                let angle = self.angle(&here.place, &last.place);
                if self.keep_on_locus(&last, [length, angle])? {
                    self.ends(BranchEnd::Range, "");
                }
                return Ok(());
            }
            if !self.keep_on_locus(&taken.to, [taken.length, taken.shown.angle])? {
                return Ok(());
            }
            step = taken.shown.next(taken.length, self.walk.options);
            here = self.on_fine_enough_grid(taken.to, &mut own)?;
        }
    }

    /// Goes on with more grid points where the estimated error asks for it.
    fn on_fine_enough_grid(&mut self, here: OnLocus, own: &mut EventEquation) -> Result<OnLocus> {
        let Some(points) = self.walk.finer(&here.place) else {
            return Ok(here);
        };
        let grid = self.walk.newton.equations.grid();
        let Some((place, before)) = self.walk.take_grid(&here.place, points)? else {
            return Ok(here);
        };
        let tangents = here.located.tangents.iter();
        let basis = tangents.map(|tangent| self.walk.resampled(tangent, grid, points));
        let basis: Vec<Vec<f64>> = basis.collect();
        let state = &place.state;
        let found = EventEquation::new(own.event(), here.frequency, &self.walk, state)?;
        if let Some(mut finer) = found {
            let still: Arc<dyn Condition> = Arc::new(self.walk.arc(state, &place.tangent, 0.0));
            let basis = (&basis[..], still);
            if let Some(there) = self.located(state, &mut finer, basis, Some(&place.tangent))? {
                *own = finer;
                return Ok(there);
            }
        }
        self.walk.give_back(before);
        Ok(here)
    }

    /// Directions that solutions without the event's equation have: in which nothing resists, or
    /// along the parameter of the branch; and along the second parameter.
    fn first_directions(&self, own: &EventEquation, beside: Option<Vec<f64>>) -> Vec<Vec<f64>> {
        let layout = self.walk.newton.equations.layout();
        let scales = &self.walk.scales;
        let along = |parameter: usize| {
            let mut unit = vec![0.0; layout.size()];
            unit[layout.scalars().start + parameter] = scales[parameter];
            unit
        };
        let mut first = along(scales.len() - 2);
        if own.event() == Event::Fold {
            // Any direction of motions has a part along the branch but by chance.
            first = own.direction().or(beside).unwrap_or_else(|| {
                let mut any = probe(layout.motions().end);
                let scaled = any
                    .iter_mut()
                    .zip(self.walk.newton.equations.column_scale());
                scaled.for_each(|(x, scale)| *x *= scale);
                any
            });
            first.resize(layout.size(), 0.0);
            let size = self.walk.length(&first);
            first.iter_mut().for_each(|x| *x /= size);
        }
        vec![first, along(scales.len() - 1)]
    }

    /// The point near a state that meets one more condition; none where there is none.
    fn located(
        &mut self,
        state: &GridState,
        own: &mut EventEquation,
        (basis, last): (&[Vec<f64>], Arc<dyn Condition>),
        before: Option<&[f64]>,
    ) -> Result<Option<OnLocus>> {
        let frequency = own.frequency();
        let walk = &mut self.walk;
        let found = walk.locate_from(state.clone(), own, basis.to_vec(), Some(last));
        let Some(located) = found_or_none(found)? else {
            own.set_frequency(frequency);
            return Ok(None);
        };
        self.branch.iterations += located.increments.len();
        let place = walk.locus_tangent(&located, own, before)?;
        Ok(place.map(|place| OnLocus {
            place,
            located,
            frequency: own.frequency(),
        }))
    }

    /// The next point; none where the locus ends.
    fn step_on_locus(
        &mut self,
        here: &OnLocus,
        own: &mut EventEquation,
        first: f64,
    ) -> Result<Option<Step>> {
        let mut length = first;
        let system = self.walk.newton.equations.system().clone();
        while length >= self.walk.options.smallest_step {
            own.set_frequency(here.frequency);
            let Place { state, tangent, .. } = &here.place;
            let predicted = state.incremented(&system, tangent, length);
            let arc: Arc<dyn Condition> = Arc::new(self.walk.arc(state, tangent, length));
            let basis = (&here.located.tangents[..], arc);
            if let Some(to) = self.located(&predicted, own, basis, Some(tangent))? {
                let error = self.walk.away(&predicted, &to.place.state);
                let shown = Shown {
                    angle: self.angle(&here.place, &to.place),
                    prediction: self.walk.length(&error) / length,
                };
                if !shown.is_too_far(self.walk.options) {
                    return Ok(Some(Step { to, shown, length }));
                }
            }
            if self.walk.watching.is_stopped() {
                self.ends(BranchEnd::Cancelled, "");
                return Ok(None);
            }
            self.branch.rejected += 1;
            length *= 0.5;
        }
        let least = self.walk.options.smallest_step;
        let value = self.walk.parameter(&here.place.state);
        let why = format!("no step of {least:.1e} or more leads on from {value}");
        self.ends(BranchEnd::SmallestStep, why);
        Ok(None)
    }

    /// The point at an end of the range that a step passes.
    fn at_bound(
        &mut self,
        here: &OnLocus,
        taken: &Step,
        bound: f64,
        own: &mut EventEquation,
    ) -> Result<Option<OnLocus>> {
        let [from, to] = [&here.place.state, &taken.to.place.state];
        let [before, after] = [from, to].map(|state| self.walk.parameter(state));
        let share = ((bound - before) / (after - before)).clamp(0.0, 1.0);
        let away = self.walk.away(from, to);
        let system = self.walk.newton.equations.system().clone();
        let start = from.incremented(&system, &away, share);
        let free = self.walk.scales.len() - 1;
        let given: Arc<dyn Condition> = Arc::new(Given { free, value: bound });
        let basis = (&taken.to.located.tangents[..], given);
        self.located(&start, own, basis, Some(&here.place.tangent))
    }

    fn keep_on_locus(&mut self, here: &OnLocus, step: [f64; 2]) -> Result<bool> {
        let stability = self.walk.stability(&here.place)?;
        let iterations = here.located.increments.len();
        let Some(point) = self.point(&here.place, stability, (step, iterations)) else {
            return Ok(false);
        };
        let frequency = Some(here.frequency);
        Ok(self.push(BranchPoint {
            increments: here.located.increments.clone(),
            second_frequency: frequency.filter(|_| self.branch.locus == Some(Event::Torus)),
            ..point
        }))
    }
}
