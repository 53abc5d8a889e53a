//! Static equilibrium followed from one set of conditions to the next (docs/theory.md, section
//! 9.1).

use crate::collocation::{Conditions, GridState, Steady};
use crate::error::{ErrorKind, Result};
use crate::solve::newton::branch::Branch;
use crate::solve::newton::{Newton, Waypoint};
use crate::solve::report::{Iteration, NewtonOptions, Outcome};
use crate::solve::step_length::StepLength;
use crate::system::{Driven, System};
use crate::workers::Workers;
use nalgebra::Vector6;
use std::sync::Arc;

/// Largest increment of a quasi-static solve: its square is the error left.
const TOLERANCE: f64 = 1e-3;
/// What that error stretches slender beams by is to be no more geometric stiffness than this part
/// of their bending stiffness.
const SPURIOUS: f64 = 0.5;
/// Largest increment on the way to the loads, from where it goes on with stress resultants that do
/// not know of that stretching: its square, the error left, is about the tolerance.
const ON_THE_WAY: f64 = 0.03;
/// A step that needs more iterations than this has failed; one in time is halved.
const ITERATION_LIMIT: usize = 12;
/// A load step along which Newton's method goes on by so many short ones has failed,
const PATIENCE: usize = 1;
/// and this part of it is tried: what turns too far at once seldom does not by half the load.
const LOADS_KEPT: f64 = 0.25;
/// A step that needs fewer is doubled.
const EASY_ITERATIONS: usize = 5;
/// A prescribed angle that turns a screw moves by no more in a step, so that no turn is lost.
const LARGEST_TURN: f64 = 1.0;
/// Smallest fraction of a step before giving up.
const SMALLEST_FRACTION: f64 = 1.0 / 1024.0;

/// Why there is no equilibrium.
pub(crate) type Failure = (Outcome, String);

/// An equilibrium.
struct Found {
    state: GridState,
    /// With which a way of loads goes on from there; those of the strains if there are none.
    resultants: Vec<Vector6<f64>>,
    iterations: usize,
}

/// What an equilibrium is looked for at.
struct Stop {
    time: f64,
    load_factor: f64,
    /// Time from the present state on; before it, if negative.
    passed: f64,
    keeps_branch: bool,
    /// Whether loads are still to grow.
    on_the_way: bool,
}

/// Static equilibrium at one time, tracked from one set of conditions to the next.
pub(crate) struct Tracker<'a> {
    pub newton: Newton,
    pub state: GridState,
    /// At the state, on the way to the loads; none if those of the strains.
    resultants: Vec<Vector6<f64>>,
    pub observe: &'a mut dyn FnMut(&Iteration) -> bool,
    /// Why the last way was not followed to its end.
    pub failure: Option<Failure>,
    /// How far the last way was followed, from 0 to 1.
    pub reached: f64,
    /// The branch that is followed.
    branch: Branch,
    /// States on the way to the present one, latest first, and from each the time to the next.
    before: Vec<(GridState, f64)>,
    tolerance: f64,
    /// What turns steadily.
    pub driven: Option<Driven>,
}

impl<'a> Tracker<'a> {
    /// At rest in the reference configuration.
    pub fn new(
        system: &Arc<System>,
        workers: &Workers,
        observe: &'a mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<Self> {
        let newton = Newton::at_instant(system, workers)?;
        Ok(Tracker {
            state: GridState::reference(system, newton.equations.grid()),
            newton,
            resultants: Vec::new(),
            observe,
            failure: None,
            reached: 0.0,
            branch: Branch::default(),
            before: Vec::new(),
            tolerance: TOLERANCE.min((SPURIOUS / system.slenderness()).sqrt()),
            driven: None,
        })
    }

    /// Sets time and load factor, which steady rotation follows.
    fn set_conditions(&mut self, time: f64, load_factor: f64) -> Result<()> {
        let equations = &mut self.newton.equations;
        equations.set_conditions(Conditions {
            load_factor,
            ..Conditions::at(time)
        })?;
        if let Some(driven) = &self.driven {
            equations.set_rule(Box::new(Steady::new(driven.twists(load_factor))));
        }
        Ok(())
    }

    /// Where the present state is expected after this time.
    fn expected(&self, system: &System, passed: f64) -> GridState {
        let mut past = self.before.iter().map(|(state, since)| (state, *since));
        match (past.next(), &self.driven) {
            (Some(before), _) if passed != 0.0 => {
                self.state.extrapolated(system, before, past.next(), passed)
            }
            (None, Some(driven)) if passed != 0.0 => {
                let mut state = self.state.clone();
                for (node, motion) in state.motions.iter_mut().enumerate() {
                    *motion = driven.moved(node, motion, passed);
                }
                state.track(system);
                state
            }
            _ => self.state.clone(),
        }
    }

    /// Goes from parameter 0 to 1 in adaptive steps of at most `largest_step`, with conditions
    /// `(time, load factor)` at each.
    ///
    /// In time, forwards or backwards, it keeps to its branch of equilibria; where that ends, it
    /// snaps to what Newton's method finds beyond.
    pub fn follow(
        &mut self,
        largest_step: f64,
        conditions: impl Fn(f64) -> (f64, f64),
    ) -> Result<bool> {
        let start = self.state.clone();
        let span = conditions(1.0).0 - conditions(0.0).0;
        if span == 0.0 {
            return self.advance(largest_step, &conditions, false);
        }
        if self.advance(largest_step, &conditions, true)? {
            return Ok(true);
        }
        if self.was_cancelled() {
            return Ok(false);
        }
        self.failure = None;
        self.state = start;
        self.branch = Branch::default();
        self.before.clear();
        self.advance(largest_step, &conditions, false)
    }

    /// Goes as [`follow`](Self::follow) does, with or without regard to the branch.
    fn advance(
        &mut self,
        largest_step: f64,
        conditions: &impl Fn(f64) -> (f64, f64),
        keeps_branch: bool,
    ) -> Result<bool> {
        let system = self.newton.equations.system().clone();
        let span = conditions(1.0).0 - conditions(0.0).0;
        let mut reached = 0.0;
        let range = SMALLEST_FRACTION..=largest_step;
        let retreat = if span == 0.0 { LOADS_KEPT } else { 0.5 };
        let mut step = StepLength::shortened(largest_step, range, retreat);
        while reached < 1.0 {
            self.reached = reached;
            let safe = (self.branch.longest_step() / span.abs()).max(SMALLEST_FRACTION);
            // Equal steps over what is left; the last is no rounding short.
            let left = ((1.0 - reached) / step.get().min(safe) - 1e-9).ceil();
            let next = if left > 1.0 {
                reached + (1.0 - reached) / left
            } else {
                1.0
            };
            let turn = system.turn_between(conditions(reached), conditions(next))?;
            let next = if turn > LARGEST_TURN {
                reached + (next - reached) * (LARGEST_TURN / turn).max(SMALLEST_FRACTION)
            } else {
                next
            };
            let (time, load_factor) = conditions(next);
            let passed = span * (next - reached);
            let stop = Stop {
                time,
                load_factor,
                passed,
                keeps_branch,
                on_the_way: span == 0.0 && next < 1.0,
            };
            match self.find(&system, &stop)? {
                Ok(found) => {
                    self.go_to(found.state, keeps_branch.then_some(passed));
                    self.resultants = found.resultants;
                    reached = next;
                    if found.iterations <= EASY_ITERATIONS {
                        step.grow(step.get(), 2.0);
                    }
                }
                Err((outcome, explanation)) => {
                    let is_first = reached == 0.0 && outcome == Outcome::Singular;
                    let goes_on = !outcome.is_stopped()
                        && step.shrink(next - reached)
                        && !(is_first && step.get() < 0.1);
                    if !goes_on {
                        self.failure = Some((outcome, explanation));
                        return Ok(false);
                    }
                }
            }
        }
        self.reached = reached;
        Ok(true)
    }

    /// Looks for equilibrium; why there is none, otherwise.
    fn find(
        &mut self,
        system: &System,
        stop: &Stop,
    ) -> Result<std::result::Result<Found, Failure>> {
        self.set_conditions(stop.time, stop.load_factor)?;
        let mut state = self.expected(system, stop.passed);
        let options = NewtonOptions {
            tolerance: self.tolerance,
            iteration_limit: ITERATION_LIMIT,
        };
        let has_stations = self.newton.equations.has_stations();
        let waypoint = Waypoint {
            enough: match stop.on_the_way && has_stations {
                true => ON_THE_WAY,
                false => self.tolerance,
            },
            resultants: self.resultants.clone(),
        };
        self.newton.patience = (stop.passed == 0.0).then_some(PATIENCE);
        let report = (self.newton).approach(&mut state, &options, waypoint, self.observe);
        self.newton.patience = None;
        let (iterations, resultants) = match report {
            Ok((report, resultants)) if report.outcome == Outcome::Converged => {
                (report.iterations.len(), resultants)
            }
            Ok((report, _)) => return Ok(Err((report.outcome, report.explanation))),
            Err(error) if error.kind() == ErrorKind::Callback => return Err(error),
            Err(error) => return Ok(Err((Outcome::Stalled, error.to_string()))),
        };
        if stop.keeps_branch {
            match self.newton.determinant(&state)? {
                Some(determinant) if self.branch.continues(determinant) => {
                    self.branch.advance(stop.passed.abs(), determinant);
                }
                _ => {
                    let why = "the equilibrium that was followed ends".into();
                    return Ok(Err((Outcome::Stalled, why)));
                }
            }
        }
        Ok(Ok(Found {
            state,
            resultants,
            iterations,
        }))
    }

    /// Goes on from `state`. If its branch is kept, what has been before tells what comes next,
    /// `passed` after it.
    fn go_to(&mut self, state: GridState, passed: Option<f64>) {
        let before = std::mem::replace(&mut self.state, state);
        match passed {
            Some(passed) if passed != 0.0 => {
                self.before.insert(0, (before, passed));
                self.before.truncate(2);
            }
            _ => self.before.clear(),
        }
    }
}
