//! Newton's method with the exact tangent and a line search that does not depend on scaling.
//! See docs/theory.md, section 7.1.

pub(crate) mod assembly;
pub(crate) mod branch;
pub(crate) mod on_grid;

use crate::collocation::{Collocation, GridState, ResultantPath, TimeRule};
use crate::error::{ErrorKind, Result};
use crate::solve::linear::assembled::Assembled;
use crate::solve::linear::dense::largest;
use crate::solve::linear::diagnosis::{Singularity, describe_inconsistency, describe_open_joint};
use crate::solve::linear::solver::LinearSolver;
use crate::solve::newton::assembly::describe_turned_over;
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome, Timings, timed};
use nalgebra::Vector6;

/// Shortest step of the line search.
const SHORTEST_STEP: f64 = 1.0 / 256.0;
/// A step shorter than this is far from a solution.
const SHORT_STEP: f64 = 0.1;
/// Largest turn of a node in one step; beyond it the linearisation means little.
const LARGEST_TURN: f64 = 1.0;
/// Full steps in spite of the line search go on while increments are shorter than the first by this
/// factor for each,
const LEAP_CONTRACTION: f64 = 0.25;
/// but for this one: what held the first back may let go, as stress resultants do that were those
/// of stretching.
const LEAP_GROWTH: f64 = 8.0;
/// The same matrix is used again while it is expected to end the iteration within so many steps.
const CHORD_STEPS: i32 = 3;
/// Largest contraction, from one increment to the next with the same matrix, that is worth another.
const CHORD_CONTRACTION: f64 = 0.2;
/// Error that the last step may leave in multipliers, and in motions after steps with the same
/// matrix, relative to the tolerance.
const ERROR_LEFT: f64 = 1e-3;
/// Largest contraction, from one increment to the next with the same matrix, that leaves its
/// determinant as it is.
const FAITHFUL: f64 = 0.05;
/// Accuracy of linear solves, relative to the increment: far from the solution and of simplified
/// increments.
const COARSE: f64 = 1e-4;
/// Of those that estimate errors.
pub(crate) const ESTIMATE: f64 = 1e-2;
/// The finest that is asked for.
const FINEST: f64 = 1e-8;
/// Accuracy relative to the last increment, so that convergence stays quadratic.
const FORCING: f64 = 0.1;
/// Growth that means a singular matrix.
pub(crate) const SINGULAR_GROWTH: f64 = 1e15;
/// Growth that does so where Newton's method stalls: off the constraints by rounding, a freedom is
/// resisted by as much.
const STALLED_GROWTH: f64 = 1e13;

/// Violation of constraints (relative to the size of the mechanism, or in radians) that rounding of
/// the user's geometry excuses, where constraints depend on each other.
const VIOLATION: f64 = 1e-8;

/// Full steps that the line search refused, one after the other (docs/theory.md, section 7.3).
struct Leap {
    /// Where they began.
    start: GridState,
    residual: Vec<f64>,
    resultants: Vec<Vector6<f64>>,
    /// The next increment is to be shorter than this.
    bound: f64,
}

impl Leap {
    /// Goes back to where the steps began.
    fn undo(self, equations: &mut Collocation, state: &mut GridState, residual: &mut Vec<f64>) {
        (*state, *residual) = (self.start, self.residual);
        equations.set_resultants(self.resultants);
    }
}

/// Newton solver for one system and grid; keeps everything that can be used again.
#[derive(Debug)]
pub(crate) struct Newton<L = Assembled> {
    /// The equations.
    pub equations: Collocation,
    /// What solves them, linearised.
    pub linear: L,
    /// What the second increment with the same Jacobian was relative to the first, if it is known.
    contraction: Option<f64>,
    /// Short steps after which it is given up, if there are other ways.
    pub patience: Option<usize>,
    /// Iterations since this object was made.
    pub iterations: usize,
    /// Time spent since this object was made.
    pub timings: Timings,
}

impl Newton {
    /// A solver for `equations` that assembles and factors their Jacobian.
    pub fn new(equations: Collocation) -> Self {
        let mut timings = Timings::default();
        let linear = timed(&mut timings.analysis, || Assembled::new(&equations));
        Newton {
            linear,
            contraction: None,
            patience: None,
            iterations: 0,
            equations,
            timings,
        }
    }

    /// Sign of the Jacobian's determinant at `state`, where the last solve ended, and logarithm of
    /// its size; none if it is singular.
    pub fn determinant(&mut self, state: &GridState) -> Result<Option<(f64, f64)>> {
        if self.contraction.is_some_and(|c| c <= FAITHFUL) {
            return Ok(Some(self.linear.determinant()));
        }
        let regular = self
            .linear
            .linearise(&mut self.equations, state, &mut self.timings)?;
        Ok(regular.then(|| self.linear.determinant()))
    }

    /// Largest increment of a motion that the equations with the rates of another rule ask for,
    /// with the Jacobian of the present one; none if that is singular.
    pub fn displacement_at(
        &mut self,
        state: &GridState,
        rates: Box<dyn TimeRule>,
    ) -> Result<Option<f64>> {
        let regular = self
            .linear
            .linearise(&mut self.equations, state, &mut self.timings)?;
        let mut increment = vec![0.0; self.equations.size()];
        let rule = self.equations.set_rule(rates);
        let residual = self.equations.residual(state, &mut increment);
        self.equations.set_rule(rule);
        residual?;
        let solved = regular && self.solve_linear(&mut increment, COARSE)?;
        Ok(solved.then(|| self.motion_norm(&increment)))
    }

    /// Linearises the equations at `state`. `false` if they are singular.
    pub fn linearise(&mut self, state: &GridState) -> Result<bool> {
        self.linear
            .linearise(&mut self.equations, state, &mut self.timings)
    }

    /// Growth of the factored Jacobian, see [`LinearSolver::growth`].
    pub fn growth(&mut self) -> f64 {
        self.linear.growth(&mut self.equations)
    }
}

impl<L: LinearSolver> Newton<L> {
    /// A solver for `equations` by `linear`.
    pub fn with(equations: Collocation, linear: L) -> Self {
        Newton {
            linear,
            contraction: None,
            patience: None,
            iterations: 0,
            equations,
            timings: Timings::default(),
        }
    }

    /// Turns scaled forces and constraints into the increment of the scaled unknowns that they
    /// cause, with the Jacobian of the last linearisation, and gives its largest motion; none if
    /// that is singular.
    pub fn response(&mut self, scaled: &mut [f64]) -> Result<Option<f64>> {
        let solved = self.solve_linear(scaled, ESTIMATE)?;
        let largest = self.motion_norm(scaled);
        Ok((solved && largest.is_finite()).then_some(largest))
    }

    /// The same for a wave about a state at rest, which has no mean: that of the solution is
    /// rounding, of which what nothing but rotation holds up would make much.
    pub fn response_of_wave(&mut self, scaled: &mut [f64]) -> Result<Option<f64>> {
        let solved = self.solve_linear(scaled, ESTIMATE)?;
        let points = self.equations.grid().points();
        let motions = 6 * self.equations.system().nodes() * points;
        for node in scaled[..motions].chunks_exact_mut(6 * points) {
            for component in 0..6 {
                let values = node[component..].iter().step_by(6);
                let mean = values.sum::<f64>() / points as f64;
                let values = node[component..].iter_mut().step_by(6);
                values.for_each(|x| *x -= mean);
            }
        }
        let largest = self.motion_norm(scaled);
        Ok((solved && largest.is_finite()).then_some(largest))
    }

    /// Largest motion increment in scaled unknowns.
    fn motion_norm(&self, scaled: &[f64]) -> f64 {
        let motions = 6 * self.equations.system().nodes() * self.equations.grid().points();
        largest(&scaled[..motions])
    }

    /// Largest increment of a multiplier in scaled unknowns, relative to the largest multiplier.
    fn multiplier_change(&self, scaled: &[f64], state: &GridState) -> f64 {
        let first = scaled.len() - state.multipliers.len();
        let scales = &self.equations.column_scale()[first..];
        let change = largest(&scaled[first..]);
        let values = state.multipliers.iter().zip(scales);
        let largest = values.fold(0.0, |m: f64, (x, s)| m.max((x / s).abs()));
        if change == 0.0 {
            0.0
        } else {
            change / largest.max(change)
        }
    }

    fn largest_turn(&self, scaled: &[f64]) -> f64 {
        let motions = 6 * self.equations.system().nodes() * self.equations.grid().points();
        scaled[..motions]
            .chunks_exact(6)
            .flat_map(|u| &u[3..])
            .fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// Solves from `state`, which becomes the solution or the last iterate.
    ///
    /// `observe` sees each iteration and returns `false` to cancel.
    ///
    /// # Errors
    /// If the equations cannot be evaluated at the start, or memory runs out.
    pub fn solve(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<NewtonReport> {
        self.find(state, options, true, observe)
    }

    /// As [`Newton::solve`], but whether the multipliers have converged with the motions does not
    /// matter.
    pub(crate) fn solve_motions(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<NewtonReport> {
        self.find(state, options, false, observe)
    }

    fn find(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        with_multipliers: bool,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<NewtonReport> {
        let mut report = NewtonReport {
            outcome: Outcome::IterationLimit,
            iterations: Vec::new(),
            explanation: String::new(),
        };
        let end = self.iterate(state, options, with_multipliers, &mut report, observe);
        self.equations.set_resultants(Vec::new());
        match end {
            Err(_) if self.equations.workers().is_stopped() => report.outcome = Outcome::Cancelled,
            end => end?,
        }
        self.iterations += report.iterations.len();
        // Some are singular where they are turned over.
        if matches!(report.outcome, Outcome::Converged | Outcome::Singular)
            && let Some(why) = describe_turned_over(self.equations.system(), state)
        {
            report.outcome = Outcome::WrongAssembly;
            report.explanation = why;
        }
        Ok(report)
    }

    /// Solves with the factored Jacobian.
    ///
    /// Where constraints have a compliance, takes back what that lets them open: motions are then
    /// those of the exact Jacobian, and the line search, which looks at motions only, does not take
    /// compliance for distance.
    fn solve_linear(&mut self, rhs: &mut [f64], accuracy: f64) -> Result<bool> {
        let (equations, timings) = (&mut self.equations, &mut self.timings);
        let solved = self.linear.solve(equations, rhs, accuracy, timings)?;
        equations.workers().pulse()?;
        if !solved {
            return Ok(false);
        }
        if equations.is_regularised() && self.linear.has_compliance() {
            let mut rest = vec![0.0; rhs.len()];
            equations.compliance_of(rhs, &mut rest);
            let solved = (self.linear).solve(equations, &mut rest, accuracy, timings)?;
            equations.workers().pulse()?;
            if !solved {
                return Ok(false);
            }
            rhs.iter_mut().zip(&rest).for_each(|(x, d)| *x += d);
        }
        Ok(true)
    }

    /// Replaces the residual of a trial by the simplified increment, and gives its largest motion;
    /// infinite if there is none.
    fn simplified(&mut self, residual: &mut [f64]) -> Result<f64> {
        let solved = self.solve_linear(residual, COARSE)?;
        Ok(match self.motion_norm(residual) {
            norm if solved => norm,
            _ => f64::INFINITY,
        })
    }

    /// Whether the Jacobian, by which equations were solved, is singular after all: if it grows by
    /// this, see [`LinearSolver::growth`].
    fn is_singular(&mut self, growth: f64) -> bool {
        let (linear, equations) = (&mut self.linear, &mut self.equations);
        timed(&mut self.timings.substitution, || {
            linear.growth(equations) > growth && !linear.is_resisted(equations)
        })
    }

    /// Why the Jacobian is singular.
    fn explain(&mut self, state: &GridState) -> Singularity {
        timed(&mut self.timings.estimates, || {
            self.linear.explain(&mut self.equations, state)
        })
    }

    fn iterate(
        &mut self,
        state: &mut GridState,
        options: &NewtonOptions,
        with_multipliers: bool,
        report: &mut NewtonReport,
        observe: &mut dyn FnMut(&Iteration) -> bool,
    ) -> Result<()> {
        let size = self.equations.size();
        let mut residual = vec![0.0; size];
        let mut trial_residual = vec![0.0; size];
        let mut step_vector = vec![0.0; size];
        timed(&mut self.timings.assembly, || {
            self.equations.residual(state, &mut residual)
        })?;
        let mut accuracy = COARSE;
        let mut short_steps = 0;
        let has_resultants = self.equations.has_stations();
        let mut may_leap = has_resultants;
        let mut leap: Option<Leap> = None;
        // What stretching made of the last simplified increment, over the square of the increment.
        let mut stretching = 0.0;
        while report.iterations.len() < options.iteration_limit {
            let number = report.iterations.len() + 1;
            self.contraction = None;
            let factored = self
                .linear
                .linearise(&mut self.equations, state, &mut self.timings)?;
            step_vector
                .iter_mut()
                .zip(&residual)
                .for_each(|(s, r)| *s = -r);
            let solved = factored && self.solve_linear(&mut step_vector, accuracy)?;
            let increment = self.motion_norm(&step_vector);
            if let Some(failed) = leap.take_if(|leap| !solved || increment > leap.bound) {
                failed.undo(&mut self.equations, state, &mut residual);
                may_leap = false;
                continue;
            }
            if !solved || (number == 1 && self.is_singular(SINGULAR_GROWTH)) {
                match self.explain(state) {
                    Singularity::Redundant(_) if !self.equations.is_regularised() => {
                        self.equations.regularise();
                        continue;
                    }
                    Singularity::Free(why) | Singularity::Redundant(why) => {
                        report.outcome = Outcome::Singular;
                        report.explanation = why;
                        return Ok(());
                    }
                    Singularity::Unsolved(why) => {
                        report.outcome = Outcome::Stalled;
                        report.explanation = why;
                        return Ok(());
                    }
                }
            }
            accuracy = (FORCING * increment).clamp(FINEST, COARSE);
            let mut iteration = Iteration {
                number,
                residual: largest(&residual),
                increment,
                step: 1.0,
            };
            let unscaled: Vec<f64> = step_vector
                .iter()
                .zip(self.equations.column_scale())
                .map(|(x, s)| x * s)
                .collect();
            let system = self.equations.system().clone();
            let settled = increment <= options.tolerance;
            // Forces that are still to change much are off by as much as the motions are.
            let converged = settled
                && (!with_multipliers
                    || increment * self.multiplier_change(&step_vector, state)
                        <= ERROR_LEFT * options.tolerance);
            // Multipliers that have no effect grow without bound, and nothing else moves.
            if settled && self.is_contradicted(&residual, options) {
                report.outcome = Outcome::Inconsistent;
                report.explanation = describe_inconsistency(&self.equations, &residual);
                return Ok(());
            }

            // Accept the longest step whose simplified Newton increment (same matrix, new residual)
            // is shorter: natural monotonicity, blind to how the equations are scaled. Beams that
            // turn much stretch by terms of second order, and that hides the progress of a step:
            // what counts then are increments with stress resultants as unknowns of their own.
            let turn = self.largest_turn(&step_vector);
            let mut step = if turn > LARGEST_TURN {
                LARGEST_TURN / turn
            } else {
                1.0
            };
            let mut path: Option<ResultantPath> = None;
            let (mut parted, mut leaping) = (false, false);
            let accepted = loop {
                let trial = state.incremented(&system, &unscaled, step);
                let evaluated = timed(&mut self.timings.assembly, || {
                    self.equations.residual(&trial, &mut trial_residual)
                });
                // A failing callback ends the solve; what is distorted only shortens the step.
                if let Err(error) = &evaluated
                    && error.kind() == ErrorKind::Callback
                {
                    return Err(error.clone());
                }
                if evaluated.is_ok() && trial_residual.iter().all(|x| x.is_finite()) {
                    if converged {
                        break Some(trial);
                    }
                    let bound = ((1.0 - 0.25 * step) * increment).max(options.tolerance);
                    if !has_resultants || step == 1.0 && stretching * increment < 1.0 {
                        step_vector.copy_from_slice(&trial_residual);
                        let found = self.simplified(&mut step_vector)?;
                        if found <= bound {
                            break Some(trial);
                        }
                        stretching = found / (increment * increment);
                    }
                    if has_resultants {
                        step_vector.copy_from_slice(&trial_residual);
                        let (at, equations) = ((&*state, &unscaled[..]), &mut self.equations);
                        let to = (&trial, step);
                        let (room, timings) = (&mut step_vector, &mut self.timings.assembly);
                        let evaluated = timed(timings, || {
                            equations.part_resultants(&mut path, at, to, room)
                        });
                        parted = evaluated.is_ok() && self.simplified(&mut step_vector)? <= bound;
                        leaping = evaluated.is_ok() && !parted && may_leap && step == 1.0;
                        parted |= leaping;
                        if parted {
                            break Some(trial);
                        }
                    }
                }
                step *= 0.5;
                if step < SHORTEST_STEP {
                    break None;
                }
            };
            if accepted.is_none()
                && let Some(failed) = leap.take()
            {
                failed.undo(&mut self.equations, state, &mut residual);
                may_leap = false;
                continue;
            }
            if accepted.is_none() && self.equations.has_resultants() {
                self.equations.set_resultants(Vec::new());
                continue;
            }
            leap = leaping.then(|| match leap.take() {
                Some(before) => Leap {
                    bound: LEAP_CONTRACTION * before.bound,
                    ..before
                },
                None => Leap {
                    start: state.clone(),
                    residual: residual.clone(),
                    resultants: self.equations.resultants().to_vec(),
                    bound: LEAP_GROWTH * increment,
                },
            });
            match &path {
                Some(path) if parted => self.equations.set_resultants(path.at(step)),
                _ => self.equations.set_resultants(Vec::new()),
            }
            iteration.step = if accepted.is_some() { step } else { 0.0 };
            report.iterations.push(iteration);
            let keep_going = observe(&iteration);
            let Some(trial) = accepted else {
                if self.is_singular(STALLED_GROWTH) {
                    match self.explain(state) {
                        Singularity::Redundant(_) if !self.equations.is_regularised() => {
                            self.equations.regularise();
                            continue;
                        }
                        Singularity::Free(why) | Singularity::Redundant(why) => {
                            report.outcome = Outcome::Singular;
                            report.explanation = why;
                            return Ok(());
                        }
                        Singularity::Unsolved(_) => {}
                    }
                }
                if self.is_contradicted(&residual, options) {
                    report.outcome = Outcome::Inconsistent;
                    report.explanation = describe_inconsistency(&self.equations, &residual);
                    return Ok(());
                }
                report.outcome = Outcome::Stalled;
                report.explanation = format!(
                    "no step along the Newton direction brings progress; the last increment is \
                     {increment:.3e}{}",
                    describe_open_joint(&self.equations, &residual)
                );
                return Ok(());
            };
            *state = trial;
            residual.copy_from_slice(&trial_residual);
            if converged {
                report.outcome = Outcome::Converged;
                return Ok(());
            }
            if !keep_going {
                report.outcome = Outcome::Cancelled;
                return Ok(());
            }
            short_steps += usize::from(step < SHORT_STEP);
            if self.patience.is_some_and(|most| short_steps >= most) {
                report.outcome = Outcome::Stalled;
                report.explanation = format!("{short_steps} short steps led nowhere near");
                return Ok(());
            }
            if step < 1.0 || parted {
                continue;
            }
            // After a full step the simplified increment is the next one, up to a part of the order
            // of the last increment: if what that leaves is small enough, there is no need to
            // factor again.
            let mut before = increment;
            let mut simplified = self.motion_norm(&step_vector);
            self.contraction = Some(simplified / before);
            if report.iterations.len() == options.iteration_limit {
                break;
            }
            let mut chord = Iteration {
                number: report.iterations.len() + 1,
                residual: largest(&residual),
                increment: 0.0,
                step: 0.0,
            };
            let mut ends = false;
            while !ends && !self.is_contradicted(&residual, options) {
                let change = if with_multipliers {
                    self.multiplier_change(&step_vector, state)
                } else {
                    0.0
                };
                let contraction = simplified / before;
                let contracts = contraction <= CHORD_CONTRACTION;
                let left = simplified.max(change) * contraction;
                ends = simplified.max(increment * change) <= options.tolerance
                    && (!with_multipliers || !contracts || left <= ERROR_LEFT * options.tolerance);
                let expected = simplified * contraction.powi(CHORD_STEPS);
                if !ends && (!contracts || expected > options.tolerance) {
                    break;
                }
                let length = simplified;
                let scales = self.equations.column_scale();
                let change: Vec<f64> = step_vector
                    .iter()
                    .zip(scales)
                    .map(|(x, s)| -x * s)
                    .collect();
                let trial = state.incremented(&system, &change, 1.0);
                if !ends {
                    let evaluated = timed(&mut self.timings.assembly, || {
                        self.equations.residual(&trial, &mut trial_residual)
                    });
                    if let Err(error) = &evaluated
                        && error.kind() == ErrorKind::Callback
                    {
                        return Err(error.clone());
                    }
                    step_vector.copy_from_slice(&trial_residual);
                    let solved =
                        evaluated.is_ok() && self.solve_linear(&mut step_vector, COARSE)?;
                    before = length;
                    simplified = self.motion_norm(&step_vector);
                    // Written so that NaN ends it too.
                    let nearer = solved && simplified < before;
                    if !nearer {
                        break;
                    }
                    residual.copy_from_slice(&trial_residual);
                }
                *state = trial;
                (chord.increment, chord.step) = (length, 1.0);
            }
            if chord.step == 0.0 {
                continue;
            }
            report.iterations.push(chord);
            let keep_going = observe(&chord);
            if ends || !keep_going {
                report.outcome = if ends {
                    Outcome::Converged
                } else {
                    Outcome::Cancelled
                };
                return Ok(());
            }
        }
        if self.is_contradicted(&residual, options) {
            report.outcome = Outcome::Inconsistent;
            report.explanation = describe_inconsistency(&self.equations, &residual);
            return Ok(());
        }
        report.explanation = format!(
            "not converged after {} iterations{}",
            options.iteration_limit,
            describe_open_joint(&self.equations, &residual)
        );
        Ok(())
    }

    /// Whether constraints that depend on each other are left open.
    fn is_contradicted(&self, residual: &[f64], options: &NewtonOptions) -> bool {
        self.equations.is_regularised()
            && self.equations.violation(residual) > options.tolerance.max(VIOLATION)
    }
}
