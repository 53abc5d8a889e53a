//! Springs, dampers, actuators and laws of the user on a joint coordinate.
//! See docs/theory.md, section 6.10.

use super::joint::{FramePair, Joint, RelativeState};
use super::relative::{Coordinate, JointKind};
use super::scalar_function::ScalarFunction;
use super::{Contribution, Element, Instant, Measure, OutputVariation, Unknown};
use crate::error::{Error, ErrorKind, Result};
use crate::motion::transposed_product;
use nalgebra::{RowVector6, Vector6};
use std::fmt;
use std::sync::Arc;

/// A joint coordinate that something acts on, and its whole turns.
#[derive(Debug, Clone)]
pub struct ActedCoordinate {
    pair: FramePair,
    kind: JointKind,
    coordinate: Coordinate,
    /// Place among the tracked coordinates.
    tracked: usize,
    /// Number of the signal that prescribes it, if one does, and so tells its whole turns.
    prescribed: Option<usize>,
    /// Its value in the reference configuration.
    reference: f64,
}

/// The coordinate at one instant.
#[derive(Debug, Clone)]
pub(super) struct ActedState {
    pub relative: RelativeState,
    /// Value with its whole turns, gradient, and the gradient's variation.
    pub q: ScalarFunction,
    /// `q̇`.
    pub rate: f64,
}

impl ActedCoordinate {
    /// `coordinate` of `joint`, which is tracked coordinate number `tracked` and, maybe,
    /// `prescribed` by the signal of that number, with its value in the `reference` configuration.
    pub fn new(
        joint: &Joint,
        coordinate: Coordinate,
        tracked: usize,
        prescribed: Option<usize>,
        reference: f64,
    ) -> Self {
        ActedCoordinate {
            pair: joint.pair.clone(),
            kind: joint.kind(),
            coordinate,
            tracked,
            prescribed,
            reference,
        }
    }

    /// The same coordinate in an element on these nodes, which those of its joint are among.
    pub(super) fn among(mut self, nodes: &[usize]) -> Self {
        self.pair = self.pair.among(nodes);
        self
    }

    pub(super) fn nodes(&self) -> &[usize] {
        self.pair.nodes()
    }

    pub(super) fn measure(&self) -> Measure {
        self.coordinate.measure()
    }

    /// An internal state that measures what the coordinate does.
    pub(super) fn internal_state(&self) -> Unknown {
        Unknown::State {
            measure: self.measure(),
            tracked: self.tracked,
        }
    }

    pub(super) fn state(&self, instant: &Instant) -> Result<ActedState> {
        let relative = self.pair.state(instant.nodes);
        let mut q = self.kind.coordinate(self.coordinate, &relative.z);
        let near = match self.prescribed {
            Some(signal) => instant.signals[signal],
            None => instant.coordinates[self.tracked],
        };
        q.value = self.kind.follow(self.coordinate, q.value, near);
        // A length of the order of what a solve leaves is none.
        let extent = || self.pair.extent(instant.nodes).max(self.reference);
        if self.kind == JointKind::Strut && q.value <= 1e-8 * extent() {
            let message = "the points of its strut coincide: its force has no direction";
            return Err(Error::new(ErrorKind::Model, message));
        }
        let rate = q.gradient.dot(&relative.rate);
        Ok(ActedState { relative, q, rate })
    }
}

impl ActedState {
    /// What the rate varies by with the relative motion.
    fn rate_by_motion(&self) -> RowVector6<f64> {
        let ActedState { relative, q, .. } = self;
        q.gradient.transpose() * relative.rate_variation() + relative.rate.transpose() * q.hessian
    }

    /// Gives, of each node, what coordinate and rate vary by with its motion. With its velocity the
    /// rate varies as the coordinate does with its motion.
    pub fn vary(&self, mut add: impl FnMut(usize, [&Vector6<f64>; 2])) {
        let by_motion = self.rate_by_motion().transpose();
        for (local, jacobian) in self.relative.local_jacobians() {
            let coordinate = transposed_product(jacobian, &self.q.gradient);
            let rate = transposed_product(jacobian, &by_motion);
            add(local, [&coordinate, &rate]);
        }
    }

    /// What an effort varies by with the relative motion.
    fn by_motion(&self, effort: &Effort) -> RowVector6<f64> {
        self.q.gradient.transpose() * effort.by_coordinate + self.rate_by_motion() * effort.by_rate
    }

    /// Adds what an effort varies by with the motions and velocities of the nodes.
    pub fn vary_effort(&self, effort: &Effort, out: &mut OutputVariation) {
        let by_motion = self.by_motion(effort).transpose();
        let by_velocity = self.q.gradient * effort.by_rate;
        for (local, jacobian) in self.relative.local_jacobians() {
            let [motion, velocity] = &mut out.nodes[local];
            *motion += transposed_product(jacobian, &by_motion);
            *velocity += transposed_product(jacobian, &by_velocity);
        }
    }

    /// Adds an effort against the coordinate's growth, with its derivatives.
    pub fn add_effort(&self, effort: &Effort, out: &mut Contribution) {
        let ActedState { relative, q, .. } = self;
        let variation = q.hessian * effort.value + q.gradient * self.by_motion(effort);
        let damping = q.gradient * q.gradient.transpose() * effort.by_rate;
        let wrench = q.gradient * effort.value;
        relative.add_wrench(&wrench, &variation, Some(&damping), out);
    }
}

/// An effort on a joint coordinate (force on a displacement, moment on an angle), and its
/// derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Effort {
    /// The effort.
    pub value: f64,
    /// `∂/∂q`.
    pub by_coordinate: f64,
    /// `∂/∂q̇`.
    pub by_rate: f64,
}

/// What a law of effort may depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoordinateState {
    /// Time.
    pub time: f64,
    /// The coordinate, an angle with its whole turns.
    pub value: f64,
    /// Its rate.
    pub rate: f64,
}

/// A user's law: effort against the coordinate's growth and, if it gives any, its derivatives.
pub type CoordinateFunction = Arc<dyn Fn(&CoordinateState) -> Result<Effort> + Send + Sync>;

/// A user's law, and how its derivatives are had.
#[derive(Clone)]
pub struct CoordinateLaw {
    /// The function.
    pub function: CoordinateFunction,
    /// Whether it gives derivatives; otherwise they are differenced.
    pub gives_derivatives: bool,
}

impl fmt::Debug for CoordinateLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CoordinateLaw")
            .field("gives_derivatives", &self.gives_derivatives)
            .finish_non_exhaustive()
    }
}

/// Steps of differences: the cube root of the rounding, where a central difference is most
/// accurate, of what the arguments are of the order of.
pub(super) fn difference_step(size: f64) -> f64 {
    f64::EPSILON.cbrt() * size
}

impl CoordinateLaw {
    /// Effort at a state, with derivatives if the law gives any; all are numbers.
    pub fn call(&self, at: &CoordinateState) -> Result<Effort> {
        let effort = (self.function)(at)?;
        let check = |name: &str, x: f64| {
            if x.is_finite() {
                return Ok(());
            }
            let CoordinateState { time, value, rate } = at;
            Err(Error::new(
                ErrorKind::Callback,
                format!(
                    "callback: expected a finite {name} at t = {time}, coordinate {value}, rate \
                     {rate}, got {x}"
                ),
            ))
        };
        check("effort", effort.value)?;
        if self.gives_derivatives {
            check("derivative by the coordinate", effort.by_coordinate)?;
            check("derivative by the rate", effort.by_rate)?;
        }
        Ok(effort)
    }

    /// Derivatives by central differences with `steps` of coordinate and rate.
    pub fn differenced(&self, at: &CoordinateState, steps: [f64; 2]) -> Result<[f64; 2]> {
        let slope = |h: [f64; 2]| -> Result<f64> {
            let [q, v] = h;
            let up = CoordinateState {
                value: at.value + q,
                rate: at.rate + v,
                ..*at
            };
            let down = CoordinateState {
                value: at.value - q,
                rate: at.rate - v,
                ..*at
            };
            // The step that was really made, after rounding.
            let width = (up.value - down.value) + (up.rate - down.rate);
            Ok((self.call(&up)?.value - self.call(&down)?.value) / width)
        };
        Ok([slope([steps[0], 0.0])?, slope([0.0, steps[1]])?])
    }

    /// Steps for differences at a state, of a coordinate and a rate of the order of `scales`.
    pub fn steps(at: &CoordinateState, scales: [f64; 2]) -> [f64; 2] {
        [
            difference_step(scales[0]),
            difference_step(scales[1].max(at.rate.abs())),
        ]
    }
}

/// How the effort of a [`CoordinateForce`] is found.
#[derive(Debug, Clone)]
pub enum Law {
    /// `Σ stiffness[i−1] (q − rest)ⁱ + Σ damping[i−1] q̇ⁱ`, against growth.
    Polynomial {
        /// Coefficients of the powers of `q − rest`, from the first.
        stiffness: Vec<f64>,
        /// Coefficients of the powers of `q̇`, from the first.
        damping: Vec<f64>,
        /// Coordinate free of effort.
        rest: f64,
    },
    /// The value of a signal, towards growth.
    Actuator {
        /// Number of the signal.
        signal: usize,
    },
    /// A user's law, against growth.
    Function {
        /// The law.
        law: CoordinateLaw,
        /// What coordinate and rate are of the order of.
        scales: [f64; 2],
    },
}

/// `Σ c[i−1] xⁱ` and its derivative.
fn polynomial(coefficients: &[f64], x: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for c in coefficients.iter().rev() {
        slope = slope * x + value + c;
        value = (value + c) * x;
    }
    (value, slope)
}

impl Law {
    /// Effort against growth.
    fn effort(
        &self,
        at: &CoordinateState,
        signals: &[f64],
        with_derivatives: bool,
    ) -> Result<Effort> {
        match self {
            Law::Polynomial {
                stiffness,
                damping,
                rest,
            } => {
                let (elastic, by_coordinate) = polynomial(stiffness, at.value - rest);
                let (viscous, by_rate) = polynomial(damping, at.rate);
                Ok(Effort {
                    value: elastic + viscous,
                    by_coordinate,
                    by_rate,
                })
            }
            Law::Actuator { signal } => Ok(Effort {
                value: -signals[*signal],
                ..Effort::default()
            }),
            Law::Function { law, scales } => {
                let mut effort = law.call(at)?;
                if with_derivatives && !law.gives_derivatives {
                    let steps = CoordinateLaw::steps(at, *scales);
                    [effort.by_coordinate, effort.by_rate] = law.differenced(at, steps)?;
                }
                Ok(effort)
            }
        }
    }

    fn depends_on_rate(&self) -> bool {
        match self {
            Law::Polynomial { damping, .. } => damping.iter().any(|&c| c != 0.0),
            Law::Actuator { .. } => false,
            Law::Function { .. } => true,
        }
    }
}

/// An effort on a joint coordinate that depends on it, its rate and time.
#[derive(Debug, Clone)]
pub struct CoordinateForce {
    at: ActedCoordinate,
    law: Law,
}

impl CoordinateForce {
    /// On this coordinate.
    pub fn new(at: ActedCoordinate, law: Law) -> Self {
        CoordinateForce { at, law }
    }

    fn effort(
        &self,
        state: &ActedState,
        instant: &Instant,
        with_derivatives: bool,
    ) -> Result<Effort> {
        let at = CoordinateState {
            time: instant.time,
            value: state.q.value,
            rate: state.rate,
        };
        self.law.effort(&at, instant.signals, with_derivatives)
    }
}

impl Element for CoordinateForce {
    fn nodes(&self) -> &[usize] {
        self.at.nodes()
    }

    fn has_damping(&self) -> bool {
        self.law.depends_on_rate()
    }

    /// Of springs.
    fn potential(&self, instant: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        let Law::Polynomial {
            stiffness, rest, ..
        } = &self.law
        else {
            return Ok(None);
        };
        let growth = self.at.state(instant)?.q.value - rest;
        let terms = stiffness.iter().enumerate();
        let terms = terms.map(|(i, k)| k * growth.powi(i as i32 + 2) / (i + 2) as f64);
        Ok(Some(terms.sum()))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let state = self.at.state(instant)?;
        let effort = self.effort(&state, instant, out.with_tangents)?;
        state.add_effort(&effort, out);
        Ok(())
    }

    fn outputs(&self, instant: &Instant, out: &mut Vec<f64>) -> Result<()> {
        let state = self.at.state(instant)?;
        let effort = self.effort(&state, instant, false)?.value;
        out.push(match self.law {
            Law::Actuator { .. } => -effort,
            _ => effort,
        });
        Ok(())
    }

    fn acted_measure(&self) -> Option<Measure> {
        Some(self.at.measure())
    }

    fn vary_output(&self, instant: &Instant, _: usize, out: &mut OutputVariation) -> Result<()> {
        let state = self.at.state(instant)?;
        // An actuator's does not vary.
        state.vary_effort(&self.effort(&state, instant, true)?, out);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_and_their_slopes() {
        let c = [3.0, -0.5, 2.0];
        let x = -1.7f64;
        let (value, slope) = polynomial(&c, x);
        assert!((value - (3.0 * x - 0.5 * x * x + 2.0 * x.powi(3))).abs() < 1e-14);
        assert!((slope - (3.0 - x + 6.0 * x * x)).abs() < 1e-14);
        assert_eq!(polynomial(&[], x), (0.0, 0.0));
    }

    #[test]
    fn a_law_without_derivatives_is_differenced_and_what_is_no_number_refused() {
        let law = CoordinateLaw {
            function: Arc::new(|s| {
                Ok(Effort {
                    value: s.value.sin() * s.rate.powi(3) / (1.0 - s.time),
                    ..Effort::default()
                })
            }),
            gives_derivatives: false,
        };
        let scales = [1.0, 2.0];
        let function = Law::Function {
            law: law.clone(),
            scales,
        };
        let at = CoordinateState {
            time: 0.5,
            value: 0.4,
            rate: 1.3,
        };
        let effort = function.effort(&at, &[], true).unwrap();
        let exact = [
            2.0 * at.value.cos() * at.rate.powi(3),
            6.0 * at.value.sin() * at.rate.powi(2),
        ];
        assert!((effort.by_coordinate - exact[0]).abs() < 1e-9 * exact[0].abs());
        assert!((effort.by_rate - exact[1]).abs() < 1e-9 * exact[1].abs());
        let bad = CoordinateState { time: 1.0, ..at };
        let error = law.call(&bad).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Callback);
        assert!(
            error
                .to_string()
                .contains("t = 1, coordinate 0.4, rate 1.3, got inf"),
            "{error}"
        );
    }
}
