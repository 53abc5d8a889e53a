//! A branch from its first point to its end (docs/theory.md, section 13.3).

use super::events::Tests;
use super::walk::{Place, Stepped, Walk};
use super::{Branch, BranchEnd, BranchOptions, BranchPoint, Event, no_first_point};
use crate::collocation::{Decay, DecayKind, GridState};
use crate::error::{Error, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::conditions::{Conditioned, Free};
use crate::solve::periodic::conditioned::solve_conditioned;
use crate::solve::periodic::options::GridPoints;
use crate::solve::watch::Stage;
use crate::workers::Workers;

/// Fewest points before the first is looked for.
const LEAST_LOOP: usize = 4;
/// Distance of a closed loop from its first point, over the step.
const CLOSED: f64 = 0.2;

/// Follows periodic motions of `model` along a parameter, from the solution at its value in the
/// model, which is the first point: a tangent predicts the next point, Newton's method with the
/// condition of a length along the branch finds it.
///
/// `observe` is told of each point and returns `false` to cancel: what there is then is kept, as it
/// is where the branch can go on no further.
///
/// # Errors
/// As [`solve_conditioned`]; if the parameter is outside its range at the start.
pub fn follow_branch(
    model: &Model,
    period: f64,
    parameter: Free,
    options: &BranchOptions,
    observe: &mut dyn FnMut(usize, &BranchPoint) -> bool,
) -> Result<Branch> {
    options.validate()?;
    let mut free = options.free.clone();
    free.push(parameter);
    if options.conditions.len() + 1 != free.len() {
        let expected = format!("as many as there are free parameters ({})", free.len() - 1);
        let got = options.conditions.len();
        return Err(Error::size("options.conditions", expected, got));
    }
    let conditioned = Conditioned::new(model, period, &free)?;
    let [low, high] = options.range;
    let start = parameter.value(model, period)?;
    // A frequency is that of a period that was given.
    let slack = 1e-12 * (high - low).max(start.abs());
    if !(low - slack..=high + slack).contains(&start) {
        let expected = format!("{} between {low} and {high}", parameter.name(model));
        return Err(Error::value("options.range", expected, start));
    }
    let given = (&options.free[..], &options.conditions[..]);
    let first = &options.periodic;
    let (found, solved) = solve_conditioned(model, period, given, first, &mut |_, _| true)?;
    if !solved.report.outcome.is_solution() {
        let mut branch = Branch::without_points(conditioned, period, &solved.report);
        branch.iterations = solved.total_iterations;
        return Ok(branch);
    }
    let motion = (solved.grid, solved.state);
    let mut branch = follow_from(&found, motion, &free, options, observe)?;
    branch.iterations += solved.total_iterations;
    Ok(branch)
}

/// Follows a branch from a solution of `model`, where the last of the free parameters is followed.
pub(super) fn follow_from(
    model: &Model,
    (grid, mut state): (TimeGrid, GridState),
    free: &[Free],
    options: &BranchOptions,
    observe: &mut dyn FnMut(usize, &BranchPoint) -> bool,
) -> Result<Branch> {
    let conditioned = Conditioned::new(model, grid.period(), free)?;
    state.scalars = conditioned.values(grid.period())?;
    let branch = Branch {
        threads: options.periodic.threads,
        ..Branch::empty(conditioned, grid.period())
    };
    let watching = options.periodic.watch.begin(Stage::Newton, grid.points());
    let workers = Workers::new(options.periodic.threads)?.telling(watching.pulse());
    let mut follow = Follow {
        walk: Walk::new(model, grid, free, (options, workers, watching))?,
        branch,
        observe,
    };
    follow.from(state)?;
    follow.branch.iterations += follow.walk.iterations();
    Ok(follow.branch)
}

/// What is found at an end of the range: a place, if any, and the iterations that it took.
struct Bound(Option<(Place, usize)>);

struct Follow<'a, 'o> {
    walk: Walk<'a>,
    branch: Branch,
    observe: &'o mut dyn FnMut(usize, &BranchPoint) -> bool,
}

impl Follow<'_, '_> {
    fn ends(&mut self, end: BranchEnd, why: impl Into<String>) {
        (self.branch.end, self.branch.explanation) = (end, why.into());
    }

    /// Keeps a point. `false` if the branch is to end there.
    fn keep(
        &mut self,
        (place, event): (&Place, Option<Event>),
        [step, angle]: [f64; 2],
        iterations: usize,
    ) -> bool {
        let mut state = place.state.clone();
        let scalars = std::mem::take(&mut state.scalars);
        // The equations may be at another point.
        let nominal = self.walk.newton.equations.system().period();
        let period = self.walk.conditioned.period_at(&scalars, nominal);
        let Ok(grid) = TimeGrid::new(state.points(), period) else {
            self.ends(BranchEnd::SmallestStep, "the period is none");
            return false;
        };
        let last = scalars.len() - 1;
        let mut values = vec![scalars[last]];
        values.extend_from_slice(&scalars[..last]);
        let point = BranchPoint {
            values,
            slope: self.walk.slope(place),
            grid,
            state,
            step,
            angle,
            iterations,
            event,
        };
        self.branch.points.push(point);
        let (number, point) = (self.branch.points.len(), self.branch.points.last());
        let goes_on = point.is_none_or(|point| (self.observe)(number, point));
        if !goes_on || self.walk.watching.is_stopped() {
            self.ends(BranchEnd::Cancelled, "");
            return false;
        }
        if number >= self.walk.options.point_limit {
            self.ends(BranchEnd::PointLimit, "");
            return false;
        }
        true
    }

    /// Follows the branch from a solution.
    fn from(&mut self, state: GridState) -> Result<()> {
        let value = self.walk.parameter(&state);
        let (state, report) = self.walk.at_parameter(state, value)?;
        if !report.outcome.is_solution() {
            self.ends(BranchEnd::NoStart, no_first_point(&report));
            return Ok(());
        }
        let iterations = report.iterations.len();
        let Some(mut place) = self.walk.first_tangent(state)? else {
            let why = "the branch has no tangent along the parameter where it starts, as at a fold";
            self.ends(BranchEnd::NoStart, why);
            return Ok(());
        };
        let first = place.clone();
        if !self.keep((&place, None), [0.0; 2], iterations) {
            return Ok(());
        }
        let mut tests = self.walk.tests(&place)?;
        let mut step = self.walk.options.first_step;
        loop {
            let length = step;
            let Some((taken, stepped)) = self.step_from(&place, length)? else {
                return Ok(());
            };
            if let Some(Bound(at_end)) = self.beyond(&place, &stepped.to)? {
                if let Some((end, iterations)) = at_end {
                    let away = self.walk.away(&place.state, &end.state);
                    let length = self.walk.inner(&away, &place.tangent);
                    if self
                        .keep_between((&place, &tests), (&end, length))?
                        .is_none()
                    {
                        return Ok(());
                    }
                    let angle = self.angle(&place, &end);
                    self.keep((&end, None), [length, angle], iterations);
                }
                self.ends(BranchEnd::Range, "");
                return Ok(());
            }
            let between = self.keep_between((&place, &tests), (&stepped.to, taken))?;
            let Some(there) = between else {
                return Ok(());
            };
            let closed = self.closes(&first, &place, &stepped.to, taken);
            let shown = stepped.shown;
            let (goes_on, last) = (
                self.keep(
                    (&stepped.to, None),
                    [taken, shown.angle],
                    stepped.iterations,
                ),
                stepped.to,
            );
            if !goes_on {
                return Ok(());
            }
            if closed {
                self.ends(BranchEnd::Closed, "");
                return Ok(());
            }
            step = shown.next(taken, self.walk.options);
            let points = last.state.points();
            place = self.on_fine_enough_grid(last)?;
            tests = match place.state.points() == points {
                true => there,
                false => self.walk.tests(&place)?,
            };
        }
    }

    fn angle(&self, from: &Place, to: &Place) -> f64 {
        let cosine = self.walk.inner(&from.tangent, &to.tangent);
        cosine.clamp(-1.0, 1.0).acos()
    }

    /// The next point, and the length of the step to it; none where the branch ends.
    fn step_from(&mut self, place: &Place, first: f64) -> Result<Option<(f64, Stepped)>> {
        let mut length = first;
        loop {
            let why = match self.walk.step(place, length)? {
                Ok(stepped) if !stepped.shown.is_too_far(self.walk.options) => {
                    return Ok(Some((length, stepped)));
                }
                Ok(_) => "the branch turns too sharply".to_string(),
                Err(report) if self.walk.watching.is_stopped() => {
                    self.ends(BranchEnd::Cancelled, report.explanation);
                    return Ok(None);
                }
                Err(report) => report.describe(),
            };
            self.branch.rejected += 1;
            length *= 0.5;
            if length < self.walk.options.smallest_step {
                let value = self.walk.parameter(&place.state);
                let why = format!(
                    "no step of {:.1e} or more leads on from {value}: {why}",
                    self.walk.options.smallest_step
                );
                self.ends(BranchEnd::SmallestStep, why);
                return Ok(None);
            }
        }
    }

    /// Where a step leads out of the range: the solution at its end, if it is found.
    fn beyond(&mut self, from: &Place, to: &Place) -> Result<Option<Bound>> {
        let [low, high] = self.walk.options.range;
        let (here, there) = (
            self.walk.parameter(&from.state),
            self.walk.parameter(&to.state),
        );
        let bound = match there {
            there if there > high => high,
            there if there < low => low,
            _ => return Ok(None),
        };
        let share = ((bound - here) / (there - here)).clamp(0.0, 1.0);
        let away = self.walk.away(&from.state, &to.state);
        let system = self.walk.newton.equations.system().clone();
        let start = from.state.incremented(&system, &away, share);
        let (state, report) = self.walk.at_parameter(start, bound)?;
        if !report.outcome.is_solution() {
            return Ok(Some(Bound(None)));
        }
        let mut place = match self.walk.first_tangent(state)? {
            Some(place) => place,
            None => return Ok(Some(Bound(None))),
        };
        if self.walk.inner(&place.tangent, &from.tangent) < 0.0 {
            place.tangent.iter_mut().for_each(|x| *x = -*x);
        }
        Ok(Some(Bound(Some((place, report.iterations.len())))))
    }

    /// Keeps what happens between a point and the next, and gives what tells of events there; none
    /// if the branch is to end there.
    fn keep_between(
        &mut self,
        from: (&Place, &Tests),
        (to, length): (&Place, f64),
    ) -> Result<Option<Tests>> {
        let there = self.walk.tests(to)?;
        let mut before = 0.0;
        for (event, stepped, at) in self.walk.events(from, (&there, length))? {
            let step = [at - before, stepped.shown.angle];
            let event = (&stepped.to, Some(event));
            if !self.keep(event, step, stepped.iterations) {
                return Ok(None);
            }
            before = at;
        }
        Ok(Some(there))
    }

    /// Whether a step passes by the first point.
    fn closes(&self, first: &Place, from: &Place, to: &Place, length: f64) -> bool {
        if self.branch.points.len() < LEAST_LOOP || first.state.points() != from.state.points() {
            return false;
        }
        let away = self.walk.away(&from.state, &first.state);
        let along = self.walk.inner(&away, &from.tangent);
        let aside = self.walk.inner(&away, &away) - along * along;
        let forwards = self.walk.inner(&to.tangent, &first.tangent) > 0.0;
        forwards && (0.0..=length).contains(&along) && aside < (CLOSED * length).powi(2)
    }

    /// Goes on with more grid points where the estimated error asks for it.
    fn on_fine_enough_grid(&mut self, place: Place) -> Result<Place> {
        let GridPoints::Adaptive(adaptation) = self.walk.options.periodic.grid_points else {
            return Ok(place);
        };
        let equations = &self.walk.newton.equations;
        let (system, grid) = (equations.system(), equations.grid());
        let decay = Decay::of(system, grid, &place.state);
        if decay.tail <= adaptation.error_tolerance || decay.kind == DecayKind::Rounding {
            return Ok(place);
        }
        let next = adaptation.next_by_decay(grid.points(), &decay);
        if next <= grid.points() {
            return Ok(place);
        }
        Ok(self.walk.refine(&place, next)?.unwrap_or(place))
    }
}
