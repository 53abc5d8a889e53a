//! A branch from its first point to its end (docs/theory.md, section 13.3).

use super::events::Tests;
use super::grid::Grids;
use super::walk::{Place, Stepped, Walk};
use super::{Branch, BranchEnd, BranchOptions, BranchPoint, PointStability, no_first_point};
use crate::collocation::GridState;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::conditions::{Conditioned, Free};
use crate::solve::periodic::conditioned::solve_conditioned;
use crate::solve::periodic::options::{PeriodicOptions, TimeMapping};
use crate::solve::watch::Stage;
use crate::workers::Workers;

/// Fewest points before the first is looked for.
const LEAST_LOOP: usize = 4;
/// Distance of the first point from a step that passes it, over the step.
const CLOSED: f64 = 0.2;
/// Distance of ends of a range that are one, over the range.
const SAME_END: f64 = 1e-6;
/// Distance from the first point of what is the same.
const SAME: f64 = 1e-4;

/// Follows periodic motions of `model` along a parameter, from the solution at its value in the
/// model, which is the first point: a tangent predicts the next point, Newton's method with the
/// condition of a length along the branch finds it.
///
/// `observe` is told of each point and returns `false` to cancel: what there is then is kept, as it
/// is where the branch can go on no further, or an error occurs.
///
/// # Errors
/// As [`solve_conditioned`], before the first point; if the parameter is outside its range at the
/// start.
pub fn follow_branch(
    model: &Model,
    period: f64,
    parameter: Free,
    options: &BranchOptions,
    observe: &mut dyn FnMut(usize, &BranchPoint) -> bool,
) -> Result<Branch> {
    options.validate()?;
    let mut free = options.free.clone();
    options.require_conditions(free.len())?;
    free.push(parameter);
    let conditioned = Conditioned::new(model, period, &free)?;
    options.require_within(model, period, parameter)?;
    let given = (&options.free[..], &options.conditions[..]);
    let first = PeriodicOptions {
        time_map: TimeMapping::Equispaced,
        ..options.periodic.clone()
    };
    let (found, solved) = solve_conditioned(model, period, given, &first, &mut |_, _| true)?;
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
    let walk = Walk::new(model, grid, free, (options, workers, watching))?;
    let mut follow = Follow::new(walk, branch, observe);
    let went = follow.from(state);
    follow.end(went)
}

/// What is found at an end of the range: a place, if any, and the iterations that it took.
struct Bound(Option<(Place, usize)>);

/// The first point, come back to.
struct Closing {
    stepped: Stepped,
    /// Of the step.
    length: f64,
}

/// A branch, as far as it has come.
pub(super) struct Follow<'a, 'o> {
    pub walk: Walk<'a>,
    pub branch: Branch,
    /// Points that there were before.
    before: usize,
    observe: &'o mut dyn FnMut(usize, &BranchPoint) -> bool,
}

impl<'a, 'o> Follow<'a, 'o> {
    pub fn new(
        walk: Walk<'a>,
        branch: Branch,
        observe: &'o mut dyn FnMut(usize, &BranchPoint) -> bool,
    ) -> Self {
        Follow {
            walk,
            before: branch.points.len(),
            branch,
            observe,
        }
    }

    /// The branch, with all iterations. An error after its first point leaves it those it has.
    pub fn end(mut self, went: Result<()>) -> Result<Branch> {
        match went {
            Ok(()) => {}
            Err(e) if self.walk.watching.cancels(&e) => self.ends(BranchEnd::Cancelled, ""),
            Err(e) if self.branch.points.len() == self.before => return Err(e),
            Err(e) => self.ends(BranchEnd::Failed, e.to_string()),
        }
        self.branch.iterations += self.walk.iterations();
        Ok(self.branch)
    }
}

impl Follow<'_, '_> {
    pub fn ends(&mut self, end: BranchEnd, why: impl Into<String>) {
        (self.branch.end, self.branch.explanation) = (end, why.into());
    }

    /// Keeps a point, and how the step to it went: its length, its angle, and its iterations.
    /// `false` if the branch is to end there.
    fn keep(
        &mut self,
        place: &Place,
        stability: Option<PointStability>,
        ([step, angle], iterations): ([f64; 2], usize),
    ) -> bool {
        match self.point(place, stability, ([step, angle], iterations)) {
            Some(point) => self.push(point),
            None => false,
        }
    }

    /// The point at a place; none if it has no period.
    pub fn point(
        &mut self,
        place: &Place,
        stability: Option<PointStability>,
        ([step, angle], iterations): ([f64; 2], usize),
    ) -> Option<BranchPoint> {
        let mut state = place.state.clone();
        let scalars = std::mem::take(&mut state.scalars);
        // The equations may be at another point.
        let nominal = self.walk.newton.equations.system().period();
        let period = self.walk.conditioned.period_at(&scalars, nominal);
        let Ok(grid) = TimeGrid::even_or_odd(state.points(), period) else {
            self.ends(BranchEnd::SmallestStep, "the period is none");
            return None;
        };
        let last = scalars.len() - 1;
        let mut values = vec![scalars[last]];
        values.extend_from_slice(&scalars[..last]);
        Some(BranchPoint {
            values,
            slope: self.walk.slope(place),
            grid,
            state,
            step,
            angle,
            iterations,
            event: None,
            increments: Vec::new(),
            second_frequency: None,
            stability,
        })
    }

    pub fn push(&mut self, point: BranchPoint) -> bool {
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
        let Some(place) = self.walk.first_tangent(state)? else {
            let why = "the branch has no tangent along the parameter where it starts, as at a fold";
            self.ends(BranchEnd::NoStart, why);
            return Ok(());
        };
        let tests = self.walk.tests(&place)?;
        if !self.keep(&place, tests.stability(), ([0.0; 2], iterations)) {
            return Ok(());
        }
        let first = place.clone();
        self.go_on((place, tests), &first)
    }

    /// Goes on from a point that is kept, on a branch with this first point.
    pub fn go_on(&mut self, from: (Place, Tests), first: &Place) -> Result<()> {
        let (mut place, mut tests) = from;
        let mut grids = Grids::of(&self.walk)?;
        let mut step = self.walk.options.first_step;
        loop {
            let length = step;
            let Some((taken, stepped)) = self.step_from(&place, length)? else {
                return Ok(());
            };
            if let Some(end) = self.beyond(&place, &stepped.to)? {
                return self.ends_at((&place, &tests), end);
            }
            if let Some(end) = self.closing(first, &place, &stepped.to, taken)? {
                let (length, angle) = (end.length, end.stepped.shown.angle);
                let to = (&end.stepped.to, length);
                if let Some(there) = self.keep_between((&place, &tests), to)? {
                    let step = ([length, angle], end.stepped.iterations);
                    if self.keep(to.0, there.stability(), step) {
                        self.ends(BranchEnd::Closed, "");
                    }
                }
                return Ok(());
            }
            let between = self.keep_between((&place, &tests), (&stepped.to, taken))?;
            let Some(there) = between else {
                return Ok(());
            };
            let shown = stepped.shown;
            let how = ([taken, shown.angle], stepped.iterations);
            if !self.keep(&stepped.to, there.stability(), how) {
                return Ok(());
            }
            step = shown.next(taken, self.walk.options);
            let points = stepped.to.state.points();
            place = grids.go_on(&mut self.walk, stepped.to)?;
            tests = match place.state.points() == points {
                true => there,
                false => self.walk.tests(&place)?,
            };
        }
    }

    /// Ends at the end of the range, if there is a point.
    fn ends_at(&mut self, (place, tests): (&Place, &Tests), Bound(end): Bound) -> Result<()> {
        if let Some((end, iterations)) = end {
            let away = self.walk.away(&place.state, &end.state);
            let length = self.walk.inner(&away, &place.tangent);
            let Some(there) = self.keep_between((place, tests), (&end, length))? else {
                return Ok(());
            };
            let step = [length, self.angle(place, &end)];
            self.keep(&end, there.stability(), (step, iterations));
        }
        self.ends(BranchEnd::Range, self.came_back());
        Ok(())
    }

    /// What there is to say where the branch has turned, and ends where it began.
    fn came_back(&self) -> String {
        let [low, high] = self.walk.options.range;
        let values = || self.branch.points.iter().map(|point| point.values[0]);
        let (Some(first), Some(last)) = (values().next(), values().next_back()) else {
            return String::new();
        };
        if (first - last).abs() > SAME_END * (high - low) {
            return String::new();
        }
        let (turned, other) = match last < 0.5 * (low + high) {
            true => (values().fold(last, f64::max), high),
            false => (values().fold(last, f64::min), low),
        };
        format!(
            "it turned back at {turned}, to where it began; what there is at {other} is on another \
             branch, as far as the range goes: follow one from there, too"
        )
    }

    pub fn angle(&self, from: &Place, to: &Place) -> f64 {
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

    /// The end of the range that a place is beyond.
    pub fn bound_beyond(&self, place: &Place) -> Option<f64> {
        let [low, high] = self.walk.options.range;
        match self.walk.parameter(&place.state) {
            value if value > high => Some(high),
            value if value < low => Some(low),
            _ => None,
        }
    }

    /// Where a step leads out of the range: the solution at its end, if it is found.
    fn beyond(&mut self, from: &Place, to: &Place) -> Result<Option<Bound>> {
        let Some(bound) = self.bound_beyond(to) else {
            return Ok(None);
        };
        let (state, report) = self.walk.between(from, to, bound)?;
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
        for found in self.walk.events(from, (to, &there, length))? {
            let step = [found.at - before, found.stepped.shown.angle];
            let place = &found.stepped.to;
            let stability = self.walk.stability(place)?;
            let Some(point) = self.point(place, stability, (step, found.stepped.iterations)) else {
                return Ok(None);
            };
            let goes_on = self.push(BranchPoint {
                event: Some(found.event),
                increments: found.increments,
                second_frequency: found.second_frequency,
                ..point
            });
            if !goes_on {
                return Ok(None);
            }
            before = found.at;
        }
        Ok(Some(there))
    }

    /// The first point once more, if a step passes it in the same direction.
    fn closing(
        &mut self,
        first: &Place,
        from: &Place,
        to: &Place,
        length: f64,
    ) -> Result<Option<Closing>> {
        if self.branch.points.len() < LEAST_LOOP {
            return Ok(None);
        }
        let Some(first) = self.walk.on_present_grid(first)? else {
            return Ok(None);
        };
        let away = self.walk.away(&from.state, &first.state);
        let along = self.walk.inner(&away, &from.tangent);
        let aside = self.walk.inner(&away, &away) - along * along;
        let forwards = self.walk.inner(&to.tangent, &first.tangent) > 0.0;
        let passes = (0.0..=length).contains(&along) && aside < (CLOSED * length).powi(2);
        if !forwards || !passes {
            return Ok(None);
        }
        let Ok(stepped) = self.walk.step(from, along)? else {
            return Ok(None);
        };
        let away = self.walk.away(&stepped.to.state, &first.state);
        let is_first = self.walk.inner(&away, &away).sqrt() < SAME;
        let length = along;
        Ok(is_first.then_some(Closing { stepped, length }))
    }
}
