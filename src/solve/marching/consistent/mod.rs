//! Initial values that satisfy the constraints and their derivatives: projected motions and
//! velocities, accelerations, multipliers and rates of internal states.
//!
//! All follow from one matrix, `[M Cᵀ; C 0]`. What the constraints demand of velocities and
//! accelerations is had by differences of sixth order of their violations along
//! `M exp(s v + ½ s² v̇)`. See docs/theory.md, section 12.2.

mod matrix;
mod rates;

use crate::collocation::{Conditions, GeneralizedAlpha, MotionState};
use crate::elements::Unknown;
use crate::error::Result;
use crate::solve::linear::dense::largest;
use crate::solve::linear::diagnosis::describe_open_joint;
use crate::solve::marching::{Stop, Tried, refused};
use crate::solve::newton::Newton;
use crate::solve::newton::assembly::describe_turned_over;
use crate::solve::report::Outcome;
use nalgebra::Vector6;

/// Violation of constraints that is left, scaled.
const CLOSED: f64 = 1e-13;
/// Iterations that close them; dependent constraints converge linearly.
const MOST_ITERATIONS: usize = 30;
/// Part of a step over which `v̈` is differenced, so short that no stiffness shows.
const SHORT: f64 = 1e-3;
/// Accelerations that move nodes further than this in a step belong to vibrations that it does not
/// resolve.
const RESOLVED: f64 = 0.1;

/// Solves for initial values at one time.
pub(super) struct Initial<'a> {
    newton: &'a mut Newton,
    /// Length of the steps that will follow.
    step: f64,
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

    /// With what steps cannot resolve moving as it does quasi-statically.
    fn elastically<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        self.elastic = true;
        let result = work(self);
        self.elastic = false;
        result
    }

    /// Sets the time; returns the signals then, their rates and second derivatives.
    fn set_time(&mut self, time: f64) -> Result<[Vec<f64>; 3]> {
        let equations = &mut self.newton.equations;
        equations.set_conditions(Conditions::at(time))?;
        equations.system().signal_derivatives(time, self.step)
    }

    fn motions(&self) -> usize {
        self.newton.equations.layout().motions().end
    }

    fn is_state(&self, place: usize) -> bool {
        self.newton.equations.system().unknown(place).is_state()
    }

    /// Largest displacement, relative to the characteristic length, or turn by these.
    fn largest_size(&self, values: &[Vector6<f64>]) -> f64 {
        let scales = self.newton.equations.system().scales();
        let sizes = values.iter().map(|v| scales.size_of(v));
        sizes.fold(0.0, f64::max)
    }

    /// Moves nodes, the heavier and stiffer the less, until the constraints hold. The largest move
    /// is returned.
    ///
    /// With the stiffness of a step: light nodes of a stiff part would be left behind by inertia
    /// alone, and the part kinked where it is held.
    fn close(&mut self, at: &mut MotionState) -> Tried<f64> {
        let rows = self.newton.equations.size();
        let mut violations = vec![0.0; rows];
        let start = at.state.clone();
        let length = self.newton.equations.system().scales().length;
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            self.give(at);
            let equations = &mut self.newton.equations;
            equations.constraints(&at.state, &mut violations)?;
            let open = largest(&violations);
            // Rounding of large models may leave more than the goal.
            if open <= CLOSED || (open <= 100.0 * CLOSED && open >= 0.5 * last) {
                return match describe_turned_over(equations.system(), &at.state) {
                    Some(why) => Err(Stop::Refused((Outcome::Inconsistent, why))),
                    None => Ok(at.state.distance(&start, length)),
                };
            }
            last = open;
            self.elastically(|initial| initial.factor(at))?;
            violations.iter_mut().for_each(|x| *x = -*x);
            let Some(solution) = self.solve(&violations) else {
                break;
            };
            let moves = self.node_increments(&solution, 1.0);
            // Beyond a radian or the size of the mechanism the linearisation means little.
            let divisor = largest(&solution[..self.motions()]).max(1.0);
            for (motion, u) in at.state.motions.iter_mut().zip(&moves) {
                *motion = motion.increment(&(u / divisor)).renormalised();
            }
        }
        let equations = &mut self.newton.equations;
        equations.constraints(&at.state, &mut violations)?;
        let open = describe_open_joint(equations, &violations);
        let why = format!("the constraints cannot be closed at t = {}{open}", at.time);
        Err(Stop::Refused((Outcome::Inconsistent, why)))
    }

    /// Internal states at which nothing flows; those of the user's are given with the model.
    fn relax(&mut self, at: &mut MotionState) -> Result<()> {
        let system = self.newton.equations.system().clone();
        let relaxes = |i: usize| matches!(system.unknown(i), Unknown::State { .. });
        if !(0..at.rates.len()).any(relaxes) {
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
        let states: Vec<usize> = (0..units.len()).filter(|&i| relaxes(i)).collect();
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
    fn project_velocities(&mut self, at: &mut MotionState, signals: &[Vec<f64>; 3]) -> Tried<f64> {
        let mut correction = 0.0f64;
        at.twist_rate.fill(Vector6::zeros());
        self.elastically(|initial| initial.factor(at))?;
        // Once more, as the stencil is better with velocities that are right.
        for _ in 0..2 {
            let rates = self.constraint_rates(at, signals)?;
            let rhs: Vec<f64> = rates.first.iter().map(|x| -x).collect();
            let solution = self.solve(&rhs).ok_or_else(singular)?;
            correction += largest(&solution[..self.motions()]);
            let changes = self.node_increments(&solution, 1.0);
            at.twist.iter_mut().zip(changes).for_each(|(v, u)| *v += u);
        }
        Ok(correction)
    }

    /// Accelerations, multipliers and rates of internal states at given motions and velocities.
    fn accelerate(&mut self, at: &mut MotionState, signals: &[Vec<f64>; 3]) -> Tried<()> {
        self.factor(at)?;
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
            let solution = self.solve(&residual).ok_or_else(singular)?;
            let changes = self.node_increments(&solution, weight);
            at.twist_rate
                .iter_mut()
                .zip(changes)
                .for_each(|(v, u)| *v += u);
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
        Ok(())
    }

    /// Makes everything at `at` consistent with its motions and velocities, which are projected.
    /// Without given internal states these are relaxed. Returns the largest moves of motions and of
    /// velocities.
    pub fn make_consistent(
        &mut self,
        at: &mut MotionState,
        states_given: bool,
        method: &GeneralizedAlpha,
    ) -> Tried<(f64, f64)> {
        let signals = self.set_time(at.time)?;
        let moved = self.close(at)?;
        let system = self.newton.equations.system().clone();
        at.state.track(&system);
        if !states_given {
            self.relax(at)?;
        }
        let corrected = self.project_velocities(at, &signals)?;
        self.accelerate(at, &signals)?;
        if self.largest_size(&at.twist_rate) * self.step * self.step <= RESOLVED {
            self.shift(at, method)?;
        } else {
            // Light parts that stiff ones pull at: what they do within a step, and no more.
            self.elastically(|initial| initial.accelerate(at, &signals))?;
            at.averaged.clone_from(&at.twist_rate);
            at.averaged_rates.clone_from(&at.rates);
        }
        Ok((moved, corrected))
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
        let signals = self.set_time(later.time)?;
        let accelerated = self.accelerate(&mut later, &signals);
        self.newton
            .equations
            .set_conditions(Conditions::at(at.time))?;
        at.averaged.clone_from(&at.twist_rate);
        at.averaged_rates.clone_from(&at.rates);
        if refused(accelerated)?.is_err() {
            return Ok(());
        }
        let part = method.shift() * self.step / short;
        let largest = self.largest_size(&at.twist_rate);
        let changes: Vec<Vector6<f64>> = (later.twist_rate.iter().zip(&at.twist_rate))
            .map(|(later, now)| (later - now) * part)
            .collect();
        let change = self.largest_size(&changes);
        if change.is_finite() && change > 0.0 {
            let factor = (largest / change).min(1.0);
            for (a, change) in at.averaged.iter_mut().zip(&changes) {
                *a += change * factor;
            }
        }
        Ok(())
    }
}

fn singular() -> Stop {
    Stop::Refused((Outcome::Singular, String::new()))
}
