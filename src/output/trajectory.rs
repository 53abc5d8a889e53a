//! Marched solutions between their steps, and as starts of other solves.

use super::solution::Solution;
use crate::collocation::GridState;
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::motion::inverse_tangent;
use crate::solve::{
    Iteration, MarchOptions, ShootingOptions, Stage, StartState, march, solve_shooting,
};
use nalgebra::Vector6;

/// Times beyond the ends by this part of the trajectory are taken for the ends.
const ROUNDING: f64 = 1e-9;

/// A place between two steps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Between {
    /// The step before.
    pub before: usize,
    /// The step after; the same at a single time.
    pub after: usize,
    /// From 0 to 1.
    fraction: f64,
    /// Length of the step.
    length: f64,
}

impl Between {
    /// Linear interpolation.
    pub fn linear(&self, values: &[f64]) -> f64 {
        let (a, b) = (values[self.before], values[self.after]);
        a + (b - a) * self.fraction
    }

    /// Weights of the values and rates at both ends in Hermite's cubic.
    fn cubic(&self) -> [f64; 4] {
        let (x, h) = (self.fraction, self.length);
        let rest = 1.0 - x;
        [
            rest * rest * (1.0 + 2.0 * x),
            h * x * rest * rest,
            x * x * (3.0 - 2.0 * x),
            -h * x * x * rest,
        ]
    }

    /// Hermite's cubic through values and rates.
    pub fn hermite(&self, values: &[f64], rates: &[f64]) -> f64 {
        let w = self.cubic();
        w[0] * values[self.before]
            + w[1] * rates[self.before]
            + w[2] * values[self.after]
            + w[3] * rates[self.after]
    }
}

/// State between two: motion and velocity by Hermite's cubic (the former of the logarithm of the
/// motion from the first), acceleration linearly.
fn interpolate(place: &Between, a: &NodeState, b: &NodeState) -> NodeState {
    let w = place.cubic();
    let whole = a.motion.relative(&b.motion).logarithm();
    let end_rate = inverse_tangent(&whole).to_twist_matrix() * b.twist;
    let increment: Vector6<f64> = a.twist * w[1] + whole * w[2] + end_rate * w[3];
    NodeState {
        motion: a.motion.increment(&increment),
        twist: a.twist * w[0] + a.twist_rate * w[1] + b.twist * w[2] + b.twist_rate * w[3],
        twist_rate: a.twist_rate + (b.twist_rate - a.twist_rate) * place.fraction,
    }
}

impl Solution {
    /// Marches `model` in time, see [`march`].
    pub fn march(
        model: &Model,
        options: &MarchOptions,
        observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
    ) -> Result<Self> {
        Self::of(model, march(model, options, observe)?)
    }

    /// Finds the periodic motion of `model` by shooting, see [`solve_shooting`]: a trajectory over
    /// one period.
    pub fn solve_shooting(
        model: &Model,
        period: f64,
        options: &ShootingOptions,
        observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
    ) -> Result<Self> {
        Self::of(model, solve_shooting(model, period, options, observe)?)
    }

    /// Whether this is a trajectory, which knows a stretch of time only and has no harmonics.
    pub fn is_trajectory(&self) -> bool {
        self.solve.march().is_some()
    }

    /// The times of its states: grid points or steps.
    pub fn times(&self) -> Vec<f64> {
        self.solve.times()
    }

    /// Checks that there are harmonics.
    ///
    /// # Errors
    /// [`ErrorKind::NotAvailable`] of a trajectory.
    pub fn require_harmonics(&self) -> Result<()> {
        if self.is_trajectory() {
            let message = "a trajectory has no harmonics; solve for the periodic response from it";
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        Ok(())
    }

    /// The place of `time` between the steps.
    fn between(&self, times: &[f64], time: f64) -> Result<Between> {
        let (first, last) = (times[0], times[times.len() - 1]);
        let rounding = ROUNDING * (last - first).max(first.abs().max(last.abs()) * 1e-3);
        if !(first - rounding..=last + rounding).contains(&time) {
            return Err(Error::value(
                "times",
                format_args!("times of the trajectory, from {first} to {last}"),
                time,
            ));
        }
        let after = times
            .partition_point(|t| *t < time)
            .clamp(1, (times.len() - 1).max(1));
        if times.len() == 1 {
            return Ok(Between {
                before: 0,
                after: 0,
                fraction: 0.0,
                length: 0.0,
            });
        }
        let length = times[after] - times[after - 1];
        Ok(Between {
            before: after - 1,
            after,
            fraction: ((time - times[after - 1]) / length).clamp(0.0, 1.0),
            length,
        })
    }

    /// Places of `times` between the steps of a trajectory.
    pub(super) fn places(&self, times: &[f64]) -> Result<Vec<Between>> {
        let steps = self.solve.times();
        times.iter().map(|&t| self.between(&steps, t)).collect()
    }

    /// State of `node` at a place between steps.
    pub(super) fn state_between(&self, node: usize, place: &Between) -> NodeState {
        let states = self.solve.states_of(node);
        interpolate(place, &states[place.before], &states[place.after])
    }

    /// Motions, velocities and internal states at `time`: where a march may start.
    ///
    /// # Errors
    /// [`ErrorKind::GridTooCoarse`] if a motion cannot be interpolated, or a time that is not the
    /// trajectory's.
    pub fn start_state(&self, time: f64) -> Result<StartState> {
        let system = &self.solve.system;
        let mut start = StartState {
            motions: Vec::new(),
            twists: Vec::new(),
            internal: None,
        };
        for node in 0..system.nodes() {
            self.each_node_state(node, &[time], |state| {
                // In a frame that turns, velocities are those in the inertial one all the same.
                let state = system.inertial_state(state);
                start.motions.push(state.motion);
                start.twists.push(state.twist);
            })?;
        }
        let instant = TimeGrid::new(1, self.solve.grid.period())?;
        let mut state = self.prolonged_from(time, instant)?;
        state.track(system);
        start.internal = Some((state.multipliers, state.coordinates));
        Ok(start)
    }

    /// Motions and own unknowns of all elements between the steps of a trajectory.
    pub(super) fn between_steps(&self, time: f64) -> Result<GridState> {
        let system = &self.solve.system;
        let place = self.places(&[time])?[0];
        let mut state = GridState::at_points(system, 1);
        for (node, motion) in state.motions.iter_mut().enumerate() {
            *motion = self.state_between(node, &place).motion;
        }
        let from = &self.solve.state;
        for placed in system.elements() {
            let (before, after) = (
                from.own_of(placed, place.before),
                from.own_of(placed, place.after),
            );
            let values = state.own_of_mut(placed, 0);
            for (i, value) in values.iter_mut().enumerate() {
                *value = before[i] + (after[i] - before[i]) * place.fraction;
            }
        }
        let tracked = from.tracked(system, place.before);
        let ends = tracked.iter().zip(from.tracked(system, place.after));
        for (coordinate, (before, after)) in state.coordinates.iter_mut().zip(ends) {
            *coordinate = before + (after - before) * place.fraction;
        }
        state.track(system);
        Ok(state)
    }

    /// The last period of a trajectory at the points of `grid`, each at a time of the same phase.
    pub(super) fn last_period(&self, grid: TimeGrid) -> Result<GridState> {
        let system = &self.solve.system;
        let steps = self.solve.times();
        let (first, last) = (steps[0], steps[steps.len() - 1]);
        let period = grid.period();
        if last - first < period * (1.0 - ROUNDING) {
            return Err(Error::value(
                "options.initial",
                format_args!("a trajectory of at least one period, {period}"),
                format_args!("one of {}", last - first),
            ));
        }
        let mut state = GridState::at_points(system, grid.points());
        for (k, phase) in grid.times().enumerate() {
            let periods = ((last - phase) / period * (1.0 + 1e-12)).floor();
            let time = (phase + periods * period).clamp(first, last);
            state.copy_point(system, k, &self.between_steps(time)?, 0);
        }
        // Turns gained are those from the start of this period on, not of the time the trajectory
        // was at.
        state.track(system);
        Ok(state)
    }
}
