//! Initial values that satisfy the constraints and their derivatives: projected motions and
//! velocities, accelerations, multipliers and rates of internal states.
//!
//! All follow from one matrix, `[M Cᵀ; C 0]`. What the constraints demand of velocities and
//! accelerations is had by differences of sixth order of their violations along
//! `M exp(s v + ½ s² v̇)`. See docs/theory.md, section 12.2.

use crate::collocation::{Conditions, GeneralizedAlpha, GivenRates, MotionState};
use crate::elements::{Measure, Unknown};
use crate::error::Result;
use crate::solve::linear::diagnosis::{Singularity, describe_open_joint};
use crate::solve::linear::solver::LinearSolver;
use crate::solve::newton::assembly::describe_turned_over;
use crate::solve::newton::{Newton, SINGULAR_GROWTH};
use crate::solve::report::Outcome;
use nalgebra::Vector6;

/// Violation of constraints that is left, scaled.
const CLOSED: f64 = 1e-13;
/// Iterations that close them; dependent constraints converge linearly.
const MOST_ITERATIONS: usize = 30;
/// Largest motion of a difference stencil, relative to the characteristic length or in radians:
/// sixth powers of it are as small as rounding over its square.
const STENCIL: f64 = 0.02;
/// Weights of a first and second derivative by central differences, at −3 … 3.
const FIRST: [f64; 7] = [-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0];
const SECOND: [f64; 7] = [2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0];
/// What the weights are divided by.
const FIRST_UNIT: f64 = 60.0;
const SECOND_UNIT: f64 = 180.0;
/// Times that a linear solve is repeated with its residual.
const REFINEMENTS: usize = 3;
/// Part of a step over which `v̈` is differenced, so short that no stiffness shows.
const SHORT: f64 = 1e-3;
/// Accelerations that move nodes further than this in a step belong to vibrations that it does not
/// resolve.
const RESOLVED: f64 = 0.1;
/// Inertia lent to nodes that have none, relative to the total mass: it decides on nothing but how
/// they start.
const LENT_MASS: f64 = 1e-3;

/// Why there are no consistent initial values.
pub(crate) type Refusal = (Outcome, String);

/// Derivatives of constraints along a motion, at their rows of a residual.
struct ConstraintRates {
    first: Vec<f64>,
    second: Vec<f64>,
}

/// Solves for initial values at one time.
pub(crate) struct Initial<'a> {
    pub newton: &'a mut Newton,
    /// Length of the steps that will follow.
    pub step: f64,
    added_mass: f64,
    /// Whether what steps cannot resolve moves as it does quasi-statically.
    elastic: bool,
}

impl<'a> Initial<'a> {
    pub fn new(newton: &'a mut Newton, step: f64) -> Self {
        Initial {
            newton,
            step,
            added_mass: 0.0,
            elastic: false,
        }
    }

    fn motions(&self) -> usize {
        self.newton.equations.layout().motions().end
    }

    fn is_state(&self, place: usize) -> bool {
        let unknown = self.newton.equations.system().unknown(place);
        matches!(unknown, Unknown::State { .. })
    }

    fn give(&mut self, at: &MotionState) {
        self.newton.equations.set_rule(Box::new(GivenRates {
            twist: at.twist.clone(),
            twist_rate: at.twist_rate.clone(),
            rates: at.rates.clone(),
            weight: self.weight(),
            elastic: self.elastic,
        }));
    }

    /// Accelerations in units of it are of the order of displacements.
    fn weight(&self) -> f64 {
        1.0 / (self.step * self.step)
    }

    /// Factors the matrix at a state; says why if it is singular.
    fn factor(&mut self, at: &MotionState) -> Result<Option<Refusal>> {
        loop {
            self.give(at);
            let newton = &mut *self.newton;
            newton.linear.assemble(&mut newton.equations, &at.state)?;
            self.lend_mass();
            let newton = &mut *self.newton;
            let regular =
                newton.linear.factor_all(&newton.equations)? && newton.growth() < SINGULAR_GROWTH;
            if regular {
                return Ok(None);
            }
            let newton = &mut *self.newton;
            match newton.linear.explain(&mut newton.equations, &at.state) {
                Singularity::Redundant(_) if !newton.equations.is_regularised() => {
                    newton.equations.regularise();
                }
                Singularity::Free(_) if self.added_mass == 0.0 => {
                    let mass = newton.equations.system().scales().mass;
                    self.added_mass = if mass > 0.0 { LENT_MASS * mass } else { 1.0 };
                }
                Singularity::Free(why)
                | Singularity::Redundant(why)
                | Singularity::Unsolved(why) => {
                    return Ok(Some((Outcome::Singular, why)));
                }
            }
        }
    }

    /// Adds inertia to each node where some have none, that the matrix be regular.
    fn lend_mass(&mut self) {
        let (mass, motions) = (self.added_mass * self.weight(), self.motions());
        if mass == 0.0 {
            return;
        }
        let newton = &mut *self.newton;
        let length = newton.equations.system().scales().length;
        let scales = (newton.equations.row_scale().iter()).zip(newton.equations.column_scale());
        let inertia = scales.enumerate().map(|(i, (row, column))| match i % 6 {
            0..3 => mass * row * column,
            _ => mass * length * length * row * column,
        });
        let pattern = newton.linear.pattern(&newton.equations);
        let places: Vec<usize> = (0..motions).map(|i| pattern.diagonal(i)).collect();
        for (place, inertia) in places.into_iter().zip(inertia) {
            newton.linear.values[place] += inertia;
        }
    }

    /// Solves with the factored matrix, without what regularises it.
    fn solve(&self, rhs: &[f64]) -> Option<Vec<f64>> {
        let newton = &*self.newton;
        let mut solution = vec![0.0; rhs.len()];
        let mut rest = rhs.to_vec();
        for _ in 0..REFINEMENTS {
            if !newton.linear.substitute(&mut rest) {
                return None;
            }
            solution.iter_mut().zip(&rest).for_each(|(x, r)| *x += r);
            rest.copy_from_slice(rhs);
            let pattern = newton.linear.pattern(&newton.equations);
            let columns = pattern.column_pointers().windows(2);
            for (range, x) in columns.zip(&solution) {
                for at in range[0]..range[1] {
                    rest[pattern.row_indices()[at]] -= newton.linear.values[at] * x;
                }
            }
            let regularisation = newton.equations.regularisation();
            if regularisation != 0.0 {
                for i in self.motions()..rest.len() {
                    if !self.is_state(i - self.motions()) {
                        rest[i] -= regularisation * solution[i];
                    }
                }
            }
        }
        Some(solution)
    }

    /// Increments of the nodes in a scaled solution, times `factor`.
    fn node_increments(&self, solution: &[f64], factor: f64) -> Vec<Vector6<f64>> {
        let scales = self.newton.equations.column_scale();
        solution[..self.motions()]
            .chunks_exact(6)
            .zip(scales.chunks_exact(6))
            .map(|(x, scale)| Vector6::from_fn(|i, _| factor * scale[i] * x[i]))
            .collect()
    }

    /// Derivatives of the constraints along the motion of `at`, with the signals `values`, their
    /// rates and second derivatives.
    fn constraint_rates(
        &mut self,
        at: &MotionState,
        signals: &[Vec<f64>; 3],
    ) -> Result<ConstraintRates> {
        let scales = *self.newton.equations.system().scales();
        let largest = |values: &[Vector6<f64>]| {
            let sizes = values.iter().map(|v| scales.size_of(v));
            sizes.fold(0.0, f64::max)
        };
        let (mut speed, mut acceleration) = (largest(&at.twist), largest(&at.twist_rate));
        let measures = self.newton.equations.system().prescribed_measures();
        for (i, measure) in measures.enumerate() {
            let unit = match measure {
                Measure::Length => scales.length,
                Measure::Angle => 1.0,
            };
            speed = speed.max(signals[1][i].abs() / unit);
            acceleration = acceleration.max(signals[2][i].abs() / unit);
        }
        let h = (STENCIL / speed)
            .min((2.0 * STENCIL / acceleration).sqrt())
            .min(1e3 * self.step);
        let rows = self.newton.equations.size();
        let mut rates = ConstraintRates {
            first: vec![0.0; rows],
            second: vec![0.0; rows],
        };
        self.give(at);
        let mut violations = vec![0.0; rows];
        let mut moved = at.state.clone();
        let mut values = signals[0].clone();
        for (k, (first, second)) in FIRST.iter().zip(SECOND).enumerate() {
            let s = h * (k as f64 - 3.0);
            for (node, motion) in moved.motions.iter_mut().enumerate() {
                let increment = at.twist[node] * s + at.twist_rate[node] * (0.5 * s * s);
                *motion = at.state.motions[node].increment(&increment);
            }
            for (i, value) in values.iter_mut().enumerate() {
                *value = signals[0][i] + s * (signals[1][i] + 0.5 * s * signals[2][i]);
            }
            let equations = &mut self.newton.equations;
            equations.set_signals(&values);
            equations.constraints(&moved, &mut violations)?;
            for (i, violation) in violations.iter().enumerate() {
                rates.first[i] += first * violation / (FIRST_UNIT * h);
                rates.second[i] += second * violation / (SECOND_UNIT * h * h);
            }
        }
        self.newton.equations.set_signals(&signals[0]);
        Ok(rates)
    }

    /// Moves nodes, the heavier the less, until the constraints hold. The largest move is returned.
    fn close(&mut self, at: &mut MotionState) -> Result<std::result::Result<f64, Refusal>> {
        let rows = self.newton.equations.size();
        let mut violations = vec![0.0; rows];
        let start = at.state.clone();
        let length = self.newton.equations.system().scales().length;
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            self.give(at);
            self.newton
                .equations
                .constraints(&at.state, &mut violations)?;
            let largest = violations.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            // Rounding of large models may leave more than the goal.
            if largest <= CLOSED || (largest <= 100.0 * CLOSED && largest >= 0.5 * last) {
                let system = self.newton.equations.system();
                return Ok(match describe_turned_over(system, &at.state) {
                    Some(why) => Err((Outcome::Inconsistent, why)),
                    None => Ok(at.state.distance(&start, length)),
                });
            }
            last = largest;
            if let Some(refusal) = self.factor(at)? {
                return Ok(Err(refusal));
            }
            violations.iter_mut().for_each(|x| *x = -*x);
            let Some(solution) = self.solve(&violations) else {
                break;
            };
            let moves = self.node_increments(&solution, 1.0);
            // Beyond a radian or the size of the mechanism the linearisation means little.
            let largest = solution[..self.motions()]
                .iter()
                .fold(1.0f64, |m, x| m.max(x.abs()));
            for (motion, u) in at.state.motions.iter_mut().zip(&moves) {
                *motion = motion.increment(&(u / largest)).renormalised();
            }
        }
        self.newton
            .equations
            .constraints(&at.state, &mut violations)?;
        let open = describe_open_joint(&self.newton.equations, &violations);
        let why = format!("the constraints cannot be closed at t = {}{open}", at.time);
        Ok(Err((Outcome::Inconsistent, why)))
    }

    /// Internal states at which nothing flows.
    fn relax(&mut self, at: &mut MotionState) -> Result<()> {
        if !(0..at.rates.len()).any(|i| self.is_state(i)) {
            return Ok(());
        }
        at.state.track(self.newton.equations.system());
        let mut residual = vec![0.0; self.newton.equations.size()];
        self.give(at);
        self.newton.equations.residual(&at.state, &mut residual)?;
        // Linear in the states: one step with the derivatives by a unit difference of all at once.
        let first = self.motions();
        let (before, scales) = (residual.clone(), self.newton.equations.column_scale());
        let units: Vec<f64> = scales[first..].to_vec();
        let states: Vec<usize> = (0..units.len()).filter(|&i| self.is_state(i)).collect();
        let mut moved = at.state.clone();
        for &i in &states {
            moved.multipliers[i] += units[i];
        }
        self.newton.equations.residual(&moved, &mut residual)?;
        for &i in &states {
            let slope = residual[first + i] - before[first + i];
            if slope != 0.0 {
                at.state.multipliers[i] -= units[i] * before[first + i] / slope;
            }
        }
        Ok(())
    }

    /// Velocities nearest to the given ones that the constraints allow: by kinetic energy, and by
    /// what it takes to move on with them for a step. So a shock does not leave stiff parts behind
    /// that vibrate faster than the steps resolve. How far they were off is returned, relative to
    /// the characteristic length, or in radians, in a unit of time.
    fn project_velocities(
        &mut self,
        at: &mut MotionState,
        signals: &[Vec<f64>; 3],
    ) -> Result<std::result::Result<f64, Refusal>> {
        let mut correction = 0.0f64;
        at.twist_rate.fill(Vector6::zeros());
        self.elastic = true;
        let refusal = self.factor(at);
        self.elastic = false;
        if let Some(refusal) = refusal? {
            return Ok(Err(refusal));
        }
        // Once more, as the stencil is better with velocities that are right.
        for _ in 0..2 {
            let rates = self.constraint_rates(at, signals)?;
            let rhs: Vec<f64> = rates.first.iter().map(|x| -x).collect();
            let Some(solution) = self.solve(&rhs) else {
                return Ok(Err((Outcome::Singular, String::new())));
            };
            let change = solution[..self.motions()].iter();
            correction += change.fold(0.0f64, |m, x| m.max(x.abs()));
            for (v, change) in at
                .twist
                .iter_mut()
                .zip(self.node_increments(&solution, 1.0))
            {
                *v += change;
            }
        }
        Ok(Ok(correction))
    }

    /// Accelerations, multipliers and rates of internal states at given motions and velocities.
    fn accelerate(
        &mut self,
        at: &mut MotionState,
        signals: &[Vec<f64>; 3],
    ) -> Result<Option<Refusal>> {
        if let Some(refusal) = self.factor(at)? {
            return Ok(Some(refusal));
        }
        at.twist_rate.fill(Vector6::zeros());
        let first = self.motions();
        for place in 0..at.rates.len() {
            at.rates[place] = 0.0;
            if !self.is_state(place) {
                at.state.multipliers[place] = 0.0;
            }
        }
        let weight = self.weight();
        let mut residual = vec![0.0; self.newton.equations.size()];
        // The first time from zero, then with what rounding and the stencil left.
        for _ in 0..2 {
            let rates = self.constraint_rates(at, signals)?;
            self.give(at);
            self.newton.equations.residual(&at.state, &mut residual)?;
            for place in 0..at.rates.len() {
                if !self.is_state(place) {
                    residual[first + place] = rates.second[first + place] / weight;
                }
            }
            residual.iter_mut().for_each(|x| *x = -*x);
            let Some(solution) = self.solve(&residual) else {
                return Ok(Some((Outcome::Singular, String::new())));
            };
            for (rate, change) in at
                .twist_rate
                .iter_mut()
                .zip(self.node_increments(&solution, weight))
            {
                *rate += change;
            }
            for place in 0..at.rates.len() {
                let scale = self.newton.equations.column_scale()[first + place];
                let change = scale * solution[first + place];
                if self.is_state(place) {
                    at.rates[place] += weight * change;
                } else {
                    at.state.multipliers[place] += change;
                }
            }
        }
        Ok(None)
    }

    /// Makes everything at `at` consistent with its motions and velocities, which are projected.
    /// Without given internal states these are relaxed. Returns the largest moves of motions and of
    /// velocities.
    pub fn make_consistent(
        &mut self,
        at: &mut MotionState,
        states_given: bool,
        method: &GeneralizedAlpha,
    ) -> Result<std::result::Result<(f64, f64), Refusal>> {
        let system = self.newton.equations.system().clone();
        self.newton
            .equations
            .set_conditions(Conditions::at(at.time))?;
        let signals = system.signal_derivatives(at.time, self.step)?;
        let moved = match self.close(at)? {
            Ok(moved) => moved,
            Err(refusal) => return Ok(Err(refusal)),
        };
        at.state.track(&system);
        if !states_given {
            self.relax(at)?;
        }
        let corrected = match self.project_velocities(at, &signals)? {
            Ok(corrected) => corrected,
            Err(refusal) => return Ok(Err(refusal)),
        };
        if let Some(refusal) = self.accelerate(at, &signals)? {
            return Ok(Err(refusal));
        }
        if self.displacement_in_a_step(at) <= RESOLVED {
            self.shift(at, method)?;
            return Ok(Ok((moved, corrected)));
        }
        // Light parts that stiff ones pull at: what they do within a step, and no more.
        self.elastic = true;
        let refusal = self.accelerate(at, &signals);
        self.elastic = false;
        at.averaged.clone_from(&at.twist_rate);
        at.averaged_rates.clone_from(&at.rates);
        Ok(match refusal? {
            Some(refusal) => Err(refusal),
            None => Ok((moved, corrected)),
        })
    }

    /// Largest displacement, relative to the characteristic length, or turn in a step by the
    /// accelerations.
    fn displacement_in_a_step(&self, at: &MotionState) -> f64 {
        let scales = self.newton.equations.system().scales();
        let sizes = at.twist_rate.iter().map(|v| scales.size_of(v));
        sizes.fold(0.0, f64::max) * self.step * self.step
    }

    /// `a = v̇ + (α_m − α_f) h v̈`, with `v̈` by differences: without it multipliers start with an
    /// error of the first order. Where `v̈` is that of unresolved vibrations it is cut off.
    fn shift(&mut self, at: &mut MotionState, method: &GeneralizedAlpha) -> Result<()> {
        let system = self.newton.equations.system().clone();
        let short = SHORT * self.step;
        let mut later = at.clone();
        later.time += short;
        for (node, motion) in later.state.motions.iter_mut().enumerate() {
            let (v, rate) = (&at.twist[node], &at.twist_rate[node]);
            *motion = motion.increment(&(v * short + rate * (0.5 * short * short)));
            later.twist[node] = v + rate * short;
        }
        for (value, rate) in later.state.multipliers.iter_mut().zip(&at.rates) {
            *value += short * rate;
        }
        later.state.track(&system);
        self.newton
            .equations
            .set_conditions(Conditions::at(later.time))?;
        let signals = system.signal_derivatives(later.time, self.step)?;
        let refusal = self.accelerate(&mut later, &signals)?;
        self.newton
            .equations
            .set_conditions(Conditions::at(at.time))?;
        at.averaged.clone_from(&at.twist_rate);
        at.averaged_rates.clone_from(&at.rates);
        if refusal.is_some() {
            return Ok(());
        }
        let size = |v: &Vector6<f64>| system.scales().size_of(v);
        let part = method.shift() * self.step / short;
        let largest = at.twist_rate.iter().fold(0.0f64, |m, v| m.max(size(v)));
        let changes: Vec<Vector6<f64>> = (later.twist_rate.iter().zip(&at.twist_rate))
            .map(|(later, now)| (later - now) * part)
            .collect();
        let change = changes.iter().fold(0.0f64, |m, v| m.max(size(v)));
        if change.is_finite() && change > 0.0 {
            let factor = (largest / change).min(1.0);
            for (a, change) in at.averaged.iter_mut().zip(&changes) {
                *a += change * factor;
            }
        }
        Ok(())
    }
}
