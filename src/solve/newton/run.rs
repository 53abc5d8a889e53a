//! One solve in progress: from one linearisation to the next.

use super::norms::{change_of_own, largest_turn};
use super::verdict::{Ending, Left, SINGULAR_GROWTH, STALLED_GROWTH, Verdict};
use super::watchdog::Watchdog;
use super::{ERROR_LEFT, FINEST, FORCING, Newton, Waypoint};
use crate::collocation::{GridState, ResultantPath};
use crate::error::{ErrorKind, Result};
use crate::solve::linear::dense::largest;
use crate::solve::linear::solver::{COARSE, LinearSolver};
use crate::solve::report::{Iteration, NewtonOptions, Outcome, timed};
use crate::work::RESIDUAL;
use nalgebra::Vector6;
use std::ops::ControlFlow;

/// Roughest accuracy of a simplified increment that may be the last, and of one that is not.
const ROUGHEST: f64 = 5e-3;
const NOT_LAST: f64 = 2e-2;
/// A step shorter than this is far from a solution.
const SHORT_STEP: f64 = 0.1;

/// One solve.
pub(super) struct Run<'a, L> {
    pub newton: &'a mut Newton<L>,
    pub state: &'a mut GridState,
    pub options: &'a NewtonOptions,
    /// Whether multipliers are to converge with the motions.
    pub with_multipliers: bool,
    /// An increment that is no longer is the last.
    enough: f64,
    /// Whether the last increment is so long that stress resultants have to go along with it.
    pub leaves_resultants: bool,
    pub iterations: &'a mut Vec<Iteration>,
    observe: &'a mut dyn FnMut(&Iteration) -> bool,
    /// At the state.
    pub residual: Vec<f64>,
    /// At the state after a step that was tried last.
    pub trial_residual: Vec<f64>,
    /// An increment, or the simplified one after it.
    pub increment: Vec<f64>,
    accuracy: f64,
    pub watchdog: Watchdog<Start>,
    /// What stretching made of the last simplified increment, over the square of the increment.
    pub stretching: f64,
    short_steps: usize,
}

/// Where forced steps began.
pub(super) struct Start {
    state: GridState,
    residual: Vec<f64>,
    resultants: Vec<Vector6<f64>>,
}

/// What a step was accepted by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Test {
    /// The simplified increment after it.
    Increment,
    /// The same with stress resultants as unknowns of their own.
    IncrementWithResultants,
    /// Nothing: the watchdog forces it.
    None,
}

/// The increment along which a step is sought.
pub(super) struct Line<'a> {
    /// Not scaled.
    pub increment: &'a [f64],
    /// Its largest motion.
    pub size: f64,
    /// Its largest turn of a node.
    pub turn: f64,
    /// Whether it is so small that the full step is the last.
    pub is_last: bool,
}

/// A full step.
pub(super) struct Step {
    /// Largest motion of its increment.
    pub size: f64,
    /// Its increment, not scaled.
    pub increment: Vec<f64>,
    /// Stress resultants along it, if its simplified increment is that with these as unknowns of
    /// their own.
    pub path: Option<ResultantPath>,
}

/// A step that is accepted.
pub(super) struct Trial {
    pub state: GridState,
    pub step: f64,
    pub test: Test,
}

impl<'a, L: LinearSolver> Run<'a, L> {
    /// At `state`.
    pub fn new(
        newton: &'a mut Newton<L>,
        state: &'a mut GridState,
        options: &'a NewtonOptions,
        iterations: &'a mut Vec<Iteration>,
        observe: &'a mut dyn FnMut(&Iteration) -> bool,
    ) -> Self {
        let size = newton.equations.layout().size();
        let is_near = newton.trusts && !newton.stretches;
        Run {
            watchdog: Watchdog::new(newton.equations.has_stations()),
            newton,
            state,
            options,
            with_multipliers: true,
            enough: options.tolerance,
            leaves_resultants: false,
            iterations,
            observe,
            residual: vec![0.0; size],
            trial_residual: vec![0.0; size],
            increment: vec![0.0; size],
            accuracy: match is_near {
                true => NOT_LAST,
                false => COARSE,
            },
            stretching: 0.0,
            short_steps: 0,
        }
    }

    /// Goes no farther than to a point on the way.
    pub fn approach(&mut self, waypoint: Option<Waypoint>) {
        let Some(waypoint) = waypoint else { return };
        let equations = &mut self.newton.equations;
        self.with_multipliers = false;
        self.enough = waypoint.enough;
        let is_rough = waypoint.enough > self.options.tolerance;
        self.leaves_resultants = is_rough && equations.has_stations();
        equations.set_resultants(waypoint.resultants);
    }

    /// Goes on to the end.
    pub fn iterate(&mut self) -> Result<Ending> {
        while self.iterations.len() < self.options.iteration_limit {
            if let ControlFlow::Break(ending) = self.advance()? {
                return Ok(ending);
            }
        }
        Ok(self.left().exhausted())
    }

    /// Goes on from a solution of equations of which all that blades share was found from one of
    /// them, if others are left; none if they are not.
    pub fn complete(&mut self) -> Result<Option<Ending>> {
        let Newton {
            equations,
            linear,
            timings,
            alike,
            ..
        } = &mut *self.newton;
        let Some(leaders) = alike else {
            return Ok(None);
        };
        timed(&mut timings.assembly, || {
            equations.unlike(leaders, self.state, &mut self.increment)
        })?;
        let tolerance = self.options.tolerance;
        if linear.is_negligible(equations, &self.increment, tolerance, timings)? {
            return Ok(None);
        }
        *alike = None;
        timed(&mut timings.assembly, || {
            equations.residual(self.state, &mut self.residual)
        })?;
        self.iterate().map(Some)
    }

    /// Linearises, takes a step, and those with the same matrix after it.
    fn advance(&mut self) -> Result<ControlFlow<Ending>> {
        self.newton.equations.workers().pulse()?;
        let keeps_matrix = std::mem::take(&mut self.newton.keeps_matrix);
        let found = self.find_increment(keeps_matrix)?;
        if let Some(start) = self.watchdog.judge(found) {
            return Ok(self.go_back(start));
        }
        let is_first = self.iterations.is_empty();
        let asks = is_first && !self.newton.trusts && !keeps_matrix;
        let regular = found.filter(|_| !asks || !self.newton.is_singular(SINGULAR_GROWTH));
        let Some(size) = regular else {
            return Ok(match self.newton.judge_singular(self.state) {
                Verdict::Regularise => ControlFlow::Continue(()),
                Verdict::End(ending) => ControlFlow::Break(ending),
                Verdict::Unknown(why) => ControlFlow::Break(Ending::new(Outcome::Stalled, why)),
            });
        };
        self.accuracy = (FORCING * size).clamp(FINEST, COARSE);
        let settled = size <= self.enough;
        // Multipliers that have no effect grow without bound, and nothing else moves.
        if size <= self.options.tolerance
            && let Some(ending) = self.left().contradiction()
        {
            return Ok(ControlFlow::Break(ending));
        }
        // Forces that are still to change much are off by as much as the motions are.
        let own_settled = || size * self.change_of_own() <= ERROR_LEFT * self.options.tolerance;
        let is_last = settled && (!self.with_multipliers || own_settled());
        let increment = self.newton.equations.unscaled(&self.increment, 1.0);
        let line = Line {
            increment: &increment,
            turn: largest_turn(self.newton.equations.layout(), &self.increment),
            size,
            is_last,
        };
        let residual = largest(&self.residual);
        let (found, path) = self.search(&line)?;
        if found.is_none() {
            if let Some(start) = self.watchdog.give_up() {
                return Ok(self.go_back(start));
            }
            if self.newton.equations.has_resultants() {
                self.newton.equations.set_resultants(Vec::new());
                return Ok(ControlFlow::Continue(()));
            }
        }
        self.keep_resultants(found.as_ref(), path.as_ref(), size);
        let goes_on = self.record(Iteration {
            number: self.iterations.len() + 1,
            residual,
            increment: size,
            step: found.as_ref().map_or(0.0, |trial| trial.step),
        });
        match found {
            Some(trial) => {
                let path = path.filter(|_| trial.test == Test::IncrementWithResultants);
                let step = Step {
                    size,
                    increment,
                    path,
                };
                self.take(trial, step, (is_last, goes_on))
            }
            None => Ok(self.explain_stall(size)),
        }
    }

    /// Writes the increment at the state, and gives its largest motion; none if the Jacobian is
    /// singular.
    fn find_increment(&mut self, keeps_matrix: bool) -> Result<Option<f64>> {
        self.newton.contraction = None;
        let is_first = self.iterations.is_empty();
        if is_first {
            self.newton.equations.apply_scalars(self.state)?;
        }
        let factored = keeps_matrix || self.newton.linearise(self.state)?;
        if is_first {
            let (newton, state) = (&mut *self.newton, &*self.state);
            timed(&mut newton.timings.assembly, || {
                let equations = &mut newton.equations;
                equations.residual_where_linearised(state, &mut self.residual)
            })?;
        }
        let rows = self.increment.iter_mut().zip(&self.residual);
        rows.for_each(|(x, r)| *x = -r);
        let solved = factored
            && self
                .newton
                .solve_linear(&mut self.increment, self.accuracy)?;
        Ok(solved.then(|| self.newton.norm(&self.increment)))
    }

    /// Writes the residual at a trial. `false` if it cannot be evaluated there.
    pub fn evaluate(&mut self, trial: &GridState) -> Result<bool> {
        self.newton.count_evaluation(RESIDUAL);
        self.newton.equations.workers().pulse()?;
        let (equations, out) = (&mut self.newton.equations, &mut self.trial_residual);
        let evaluated = timed(&mut self.newton.timings.assembly, || {
            equations.residual(trial, out)
        });
        match evaluated {
            // A failing callback ends the solve; what is distorted only shortens the step.
            Err(error) if error.kind() == ErrorKind::Callback => Err(error),
            Err(_) => Ok(false),
            Ok(()) => Ok(self.trial_residual.iter().all(|x| x.is_finite())),
        }
    }

    /// Accuracy to which the simplified increment after an increment of this size is found: what
    /// its error leaves is little beside the tolerance.
    pub fn accuracy_of_simplified(&self, size: f64) -> f64 {
        self.accuracy_after(size * size.max(COARSE))
    }

    /// Accuracy to which one that is expected to be so large is found: as the last if it may be
    /// that, else as what another one corrects.
    pub fn accuracy_after(&self, expected: f64) -> f64 {
        let as_last = ERROR_LEFT * self.options.tolerance / expected;
        // Written so that NaN is not the last.
        if as_last >= COARSE {
            return as_last.min(ROUGHEST);
        }
        // Far from a solution, and where stretching makes much of errors.
        if !self.newton.trusts || self.newton.stretches {
            return COARSE;
        }
        let steps = f64::from(self.newton.chords);
        let worth_a_step = (self.options.tolerance / expected).powf(1.0 / steps);
        (0.5 * worth_a_step).clamp(COARSE, NOT_LAST)
    }

    /// Largest change of own unknowns by `increment`, relative to the largest of them.
    pub fn change_of_own(&self) -> f64 {
        let equations = &self.newton.equations;
        let (layout, scales) = (equations.layout(), equations.column_scale());
        change_of_own(layout, &self.increment, scales, &self.state.multipliers)
    }

    /// Whether solutions to this accuracy are known to be better.
    pub fn is_accurate(&self, accuracy: f64) -> bool {
        self.newton.linear.error_of(accuracy) < accuracy
    }

    /// What is left of the equations.
    pub fn left(&self) -> Left<'_> {
        Left {
            equations: &self.newton.equations,
            residual: &self.residual,
            options: self.options,
        }
    }

    /// Keeps an iteration, and shows it. `false` if the solve is to end.
    pub fn record(&mut self, iteration: Iteration) -> bool {
        self.iterations.push(iteration);
        (self.observe)(&iteration)
    }

    /// Returns to where forced steps began.
    fn go_back(&mut self, start: Start) -> ControlFlow<Ending> {
        (*self.state, self.residual) = (start.state, start.residual);
        self.newton.equations.set_resultants(start.resultants);
        ControlFlow::Continue(())
    }

    /// Chooses the stress resultants of the next geometric stiffness, and where to go back to.
    fn keep_resultants(&mut self, found: Option<&Trial>, path: Option<&ResultantPath>, size: f64) {
        let forced = found.is_some_and(|trial| trial.test == Test::None);
        let equations = &mut self.newton.equations;
        self.watchdog.step(forced, size, || Start {
            state: self.state.clone(),
            residual: self.residual.clone(),
            resultants: equations.resultants().to_vec(),
        });
        let resultants = match (found, path) {
            (Some(trial), Some(path)) if trial.test != Test::Increment => path.at(trial.step),
            _ => Vec::new(),
        };
        equations.set_resultants(resultants);
    }

    /// Moves to a trial.
    fn take(
        &mut self,
        trial: Trial,
        step: Step,
        (is_last, goes_on): (bool, bool),
    ) -> Result<ControlFlow<Ending>> {
        let size = step.size;
        let start = std::mem::replace(self.state, trial.state);
        self.residual.copy_from_slice(&self.trial_residual);
        if is_last {
            self.newton.contraction = Some(size);
            return Ok(ControlFlow::Break(Ending::plain(Outcome::Converged)));
        }
        if !goes_on {
            return Ok(ControlFlow::Break(Ending::plain(Outcome::Cancelled)));
        }
        self.short_steps += usize::from(trial.step < SHORT_STEP);
        let short_steps = self.short_steps;
        if self.newton.patience.is_some_and(|most| short_steps >= most) {
            let why = format!("{short_steps} short steps led nowhere near");
            return Ok(ControlFlow::Break(Ending::new(Outcome::Stalled, why)));
        }
        if trial.step < 1.0 || trial.test == Test::None {
            return Ok(ControlFlow::Continue(()));
        }
        self.chord_steps(start, step)
    }

    /// What to do where no step by an increment of this size is accepted.
    fn explain_stall(&mut self, size: f64) -> ControlFlow<Ending> {
        if self.newton.is_singular(STALLED_GROWTH) {
            match self.newton.judge_singular(self.state) {
                Verdict::Regularise => return ControlFlow::Continue(()),
                Verdict::End(ending) => return ControlFlow::Break(ending),
                Verdict::Unknown(_) => {}
            }
        }
        ControlFlow::Break(self.left().stalled(size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::Conditions;
    use crate::fourier::TimeGrid;
    use crate::model::{Model, SectionInput, Signal};
    use crate::motion::{Motion, rotation_from_vector};
    use crate::system::System;
    use crate::test_models::parts::{clamp, push};
    use crate::workers::Workers;
    use nalgebra::Vector3;
    use std::sync::Arc;

    const OPTIONS: NewtonOptions = NewtonOptions {
        tolerance: 1e-9,
        iteration_limit: 10,
    };

    /// The end of one element turned by half a turn: nothing is halfway.
    #[test]
    fn a_trial_that_is_too_distorted_is_none_and_no_error() {
        let mut model = Model::new();
        let section = SectionInput::diagonal(&[1.0; 6], &[1.0; 4]).unwrap();
        let (start, end) = (Vector3::zeros(), Vector3::x());
        let beam = model.add_straight_beam(&start, &end, &Vector3::y(), &section, 1, 1);
        let system = Arc::new(System::new(&model, 1.0).unwrap());
        let mut newton = Newton::at_instant(&system, &Workers::default()).unwrap();
        let mut state = GridState::reference(&system, newton.equations.grid());
        let mut trial = state.clone();
        let (mut iterations, options) = (Vec::new(), OPTIONS);
        let observe = &mut |_: &Iteration| true;
        let mut run = Run::new(&mut newton, &mut state, &options, &mut iterations, observe);
        assert!(run.evaluate(&trial).unwrap());
        let half = rotation_from_vector(&(Vector3::z() * std::f64::consts::PI));
        let node = &mut trial.motions[beam.unwrap().last_node];
        *node = Motion::new(half * node.rotation, node.position);
        assert!(!run.evaluate(&trial).unwrap());
    }

    /// A slender cantilever that a force bends by most of its length.
    #[test]
    fn a_waypoint_reached_by_a_long_increment_is_left_with_resultants_in_equilibrium() {
        let stiffness = [1e8, 1e8, 1e8, 100.0, 100.0, 100.0];
        let section = SectionInput::diagonal(&stiffness, &[1.0; 4]).unwrap();
        let mut model = Model::new();
        let (start, end, force) = (Vector3::zeros(), Vector3::x() * 10.0, 5.0);
        let beam = model.add_straight_beam(&start, &end, &Vector3::y(), &section, 4, 2);
        let beam = beam.unwrap();
        clamp(&mut model, beam.first_node);
        let load = Signal::constant(force).unwrap();
        push(&mut model, beam.last_node, 2, load);
        let system = Arc::new(System::new(&model, 1.0).unwrap());
        let mut newton = Newton::at_instant(&system, &Workers::default()).unwrap();
        let mut reach = |state: &mut GridState, load_factor, enough, resultants| {
            let conditions = Conditions {
                load_factor,
                ..Conditions::at(0.0)
            };
            newton.equations.set_conditions(conditions).unwrap();
            let waypoint = Waypoint { enough, resultants };
            let reached = newton.approach(state, &OPTIONS, waypoint, &mut |_| true);
            let (report, resultants) = reached.unwrap();
            newton.equations.update_kinematics(state);
            let of_strains = newton.equations.resultants_of_strains().unwrap();
            let sizes: Vec<f64> = report.iterations.iter().map(|i| i.increment).collect();
            (report.outcome, sizes, [resultants, of_strains])
        };
        let reference = GridState::reference(&system, TimeGrid::new(1, 1.0).unwrap());
        let (_, sizes, [none, _]) = reach(&mut reference.clone(), 0.5, 1e-9, Vec::new());
        let enough = *sizes.iter().find(|size| **size < 0.1).unwrap();
        assert!(enough > 1e-3 && none.is_empty(), "{sizes:?}");

        let mut there = reference;
        let (outcome, sizes, [carried, of_strains]) =
            reach(&mut there, 0.5, 1.0001 * enough, Vec::new());
        assert_eq!(outcome, Outcome::Converged);
        assert!((sizes.last().unwrap() / enough - 1.0).abs() < 1e-9);
        let axial = |all: &[Vector6<f64>]| all.iter().fold(0.0f64, |m, s| m.max(s[0].abs()));
        let (carried_axial, stretching) = (axial(&carried), axial(&of_strains));
        println!("{carried_axial} {stretching}");
        // The load is all that there is to carry.
        assert!(carried_axial < force, "{carried_axial}");
        assert!(stretching > 1e3 * force, "{stretching}");

        // Twice the load from there: in 5 iterations, with the stretching not in 50.
        let [with, without] = [carried, Vec::new()]
            .map(|resultants| reach(&mut there.clone(), 1.0, 1e-9, resultants));
        assert_eq!(with.0, Outcome::Converged, "{:?}", with.1);
        assert!(with.1.len() <= 6 && with.1.len() < without.1.len());
    }
}
