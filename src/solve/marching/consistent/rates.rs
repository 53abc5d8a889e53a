//! What constraints ask of velocities and accelerations.

use super::Initial;
use crate::collocation::MotionState;
use crate::elements::Measure;
use crate::error::Result;

/// Largest motion of a difference stencil, relative to the characteristic length or in radians:
/// sixth powers of it are as small as rounding over its square.
const STENCIL: f64 = 0.02;
/// Weights of a first and second derivative by central differences, at −3 … 3.
const FIRST: [f64; 7] = [-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0];
const SECOND: [f64; 7] = [2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0];
/// What the weights are divided by.
const FIRST_UNIT: f64 = 60.0;
const SECOND_UNIT: f64 = 180.0;

/// Derivatives of constraints along a motion, at their rows of a residual.
pub(super) struct ConstraintRates {
    pub first: Vec<f64>,
    pub second: Vec<f64>,
}

impl Initial<'_> {
    /// Derivatives of the constraints along the motion of `at`, with the signals `values`, their
    /// rates and second derivatives.
    pub(super) fn constraint_rates(
        &mut self,
        at: &MotionState,
        signals: &[Vec<f64>; 3],
    ) -> Result<ConstraintRates> {
        let length = self.newton.equations.system().scales().length;
        let mut speed = self.largest_size(&at.twist);
        let mut acceleration = self.largest_size(&at.twist_rate);
        let measures = self.newton.equations.system().prescribed_measures();
        for (i, measure) in measures.enumerate() {
            let unit = match measure {
                Measure::Length => length,
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
}
