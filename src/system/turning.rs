//! A frame that turns steadily, and may advance along its axis, in which motions are described and
//! the ground is at rest.
//!
//! With `W` the twist of the frame and `M` a motion in it, the material velocity is `V = v + U`,
//! `U = Ad(M⁻¹) W`, where `v` is that of `M`. So `V̇ = v̇ + Ũ v`, and a material increment `Δu` of
//! `M` causes `ΔV = Δv + Ũ Δu`, `ΔV̇ = Δv̇ + Ũ Δv − ṽ Ũ Δu`. See docs/theory.md, section 11.2.

use super::System;
use crate::elements::{Contribution, NodeState};
use crate::error::{Error, ErrorKind, Result};
use crate::model::{BoundSignal, TurningFrame};
use crate::motion::{DualVector, Motion, tilde};
use nalgebra::{Matrix6, Vector3, Vector6};

/// How far gravity may be off the axis: components written with 9 digits pass.
const PARALLEL: f64 = 1e-8;
/// Times in a period at which gravity is looked at.
const TIMES: usize = 7;

/// A state in the inertial frame, from one in a frame with the twist `frame`.
pub(super) fn inertial(state: &NodeState, frame: &Vector6<f64>) -> NodeState {
    let carried = state.motion.inverse().adjoint() * frame;
    NodeState {
        motion: state.motion,
        twist: state.twist + carried,
        twist_rate: state.twist_rate + tilde(&carried) * state.twist,
    }
}

/// Makes tangents with respect to inertial velocities and accelerations those with respect to the
/// velocities and accelerations in the frame: the columns of node `b`, which is at `state` in it.
pub(super) fn add_variation(
    state: &NodeState,
    frame: &Vector6<f64>,
    b: usize,
    out: &mut Contribution,
) {
    let carried = tilde(&(state.motion.inverse().adjoint() * frame));
    let twist = tilde(&state.twist);
    for a in 0..out.force.len() / 6 {
        let Some(at) = out.place(a, b) else { continue };
        let mass: Matrix6<f64> = out.mass.fixed_view::<6, 6>(at.0, at.1).into_owned();
        let damping: Matrix6<f64> = out.damping.fixed_view::<6, 6>(at.0, at.1).into_owned();
        let mut view = out.damping.fixed_view_mut::<6, 6>(at.0, at.1);
        view += mass * carried;
        let mut view = out.stiffness.fixed_view_mut::<6, 6>(at.0, at.1);
        view += (damping - mass * twist) * carried;
    }
}

/// The same of what a single number varies by: factors of the increments of motion, velocity and
/// acceleration of a node.
fn vary_in_frame(state: &NodeState, frame: &Vector6<f64>, factors: &mut [Vector6<f64>; 3]) {
    let carried = tilde(&(state.motion.inverse().adjoint() * frame));
    let [motion, velocity, acceleration] = factors;
    let by_velocity = *velocity - tilde(&state.twist).tr_mul(acceleration);
    *motion += carried.tr_mul(&by_velocity);
    *velocity += carried.tr_mul(acceleration);
}

/// A frame that turns steadily.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turning {
    /// Signals of its angular velocity, which grows with the loads.
    signals: [usize; 3],
    /// Its angular velocity.
    angular: Vector3<f64>,
    /// A point of its axis.
    point: Vector3<f64>,
    /// Signal of the part of its velocity along the axis that is there, as that grows with the
    /// loads, and this velocity.
    advance: (usize, Vector3<f64>),
}

impl Turning {
    /// Twist of a frame at the origin that turns with `angular` about the axis, and moves with a
    /// part of its velocity along that.
    fn twist(&self, angular: &Vector3<f64>, part: f64) -> Vector6<f64> {
        let mut twist = DualVector::of_turn(angular, &self.point).to_twist();
        let mut linear = twist.fixed_rows_mut::<3>(0);
        linear += self.advance.1 * part;
        twist
    }
}

impl System {
    /// Adds the angular velocity of the frame: that of the model, or of a standstill.
    ///
    /// # Errors
    /// If both turn, or if gravity is not along the axis.
    pub(super) fn add_turning(&mut self, frame: Option<&TurningFrame>) -> Result<()> {
        let standstill = self
            .standstill()
            .map(|s| (s.angular_velocity, s.axis_point));
        let standstill = standstill.filter(|(angular, _)| *angular != Vector3::zeros());
        let (angular, point) = match (frame, standstill) {
            (None, None) => return Ok(()),
            (Some(frame), None) => (frame.angular_velocity(), frame.point()),
            (None, Some(standstill)) => standstill,
            (Some(_), Some((w, _))) => {
                let expected = "zero, as the model has a turning frame of its own";
                let got = format!("({}, {}, {})", w.x, w.y, w.z);
                return Err(Error::value("options.angular_velocity", expected, got));
            }
        };
        let axis = frame.map_or_else(|| angular.normalize(), TurningFrame::axis);
        if angular != Vector3::zeros() {
            self.require_gravity_along(&axis)?;
        }
        let mut signals = [0; 3];
        for (number, component) in signals.iter_mut().zip(angular.iter()) {
            let place = "angular velocity".into();
            *number = self.add_signal(BoundSignal::constant(*component), 0.0, 0.0, place)?;
        }
        let along = axis * frame.map_or(0.0, TurningFrame::advance);
        let place = "advance of the frame".into();
        let part = self.add_signal(BoundSignal::constant(1.0), 0.0, 0.0, place)?;
        self.turning = Some(Turning {
            signals,
            angular,
            point,
            advance: (part, along),
        });
        Ok(())
    }

    /// Checks that gravity does not turn in a frame that turns about this axis.
    fn require_gravity_along(&self, axis: &Vector3<f64>) -> Result<()> {
        let times = match self.standstill() {
            Some(_) => 1,
            None => TIMES,
        };
        for k in 0..times {
            let gravity = self.gravity_at(self.period() * k as f64 / times as f64)?;
            let across = gravity.cross(axis).norm();
            if across > PARALLEL * gravity.norm() {
                return Err(Error::new(
                    ErrorKind::NotPeriodic,
                    format!(
                        "gravity: expected a direction along the axis of a frame that turns \
                         steadily, got ({}, {}, {}), of which {across:.3e} is across it; describe \
                         the motion in the inertial frame instead",
                        gravity.x, gravity.y, gravity.z
                    ),
                ));
            }
        }
        Ok(())
    }

    /// Twist of the frame that motions are described in, if it turns.
    pub(super) fn frame_twist(&self, signals: &[f64]) -> Option<Vector6<f64>> {
        let turning = self.turning.as_ref()?;
        let angular = turning.signals.map(|number| signals[number]);
        Some(turning.twist(&Vector3::from(angular), signals[turning.advance.0]))
    }

    /// Angular velocity of the frame that motions are described in, if it turns.
    pub fn frame_velocity(&self) -> Option<Vector3<f64>> {
        self.turning.map(|turning| turning.angular)
    }

    /// State in the inertial frame, from one in the frame that motions are described in; resolved
    /// along the same axes.
    pub fn inertial_state(&self, state: &NodeState) -> NodeState {
        match self.full_frame_twist() {
            Some(frame) => inertial(state, &frame),
            None => *state,
        }
    }

    /// The state at this motion of what is at rest in the inertial frame.
    pub fn at_inertial_rest(&self, motion: &Motion) -> NodeState {
        let mut state = NodeState::at_rest(*motion);
        if let Some(frame) = self.full_frame_twist() {
            state.twist = -(motion.inverse().adjoint() * frame);
        }
        state
    }

    /// Makes what a number varies by with the motion, velocity and acceleration of a node in the
    /// inertial frame what it varies by with these in the frame, where it is at `state`.
    pub fn vary_in_frame(&self, state: &NodeState, factors: &mut [Vector6<f64>; 3]) {
        if let Some(frame) = self.full_frame_twist() {
            vary_in_frame(state, &frame, factors);
        }
    }

    /// Twist of the frame, if it turns, under all loads.
    fn full_frame_twist(&self) -> Option<Vector6<f64>> {
        let turning = self.turning.as_ref()?;
        Some(turning.twist(&turning.angular, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::{Element, Inertia, InertialForces, Instant, rigid_body_inertia};
    use crate::motion::{Motion, rotation_from_vector};
    use nalgebra::Matrix3;

    const FRAME: [f64; 6] = [0.4, -0.3, 0.9, 0.5, 1.1, -0.7];

    fn state() -> NodeState {
        let turn = rotation_from_vector(&Vector3::new(0.4, 1.0, -0.3));
        NodeState {
            motion: Motion::new(turn, Vector3::new(1.0, 2.0, -0.5)),
            twist: Vector6::new(0.3, -0.8, 0.1, 0.6, 0.2, -0.4),
            twist_rate: Vector6::new(-0.2, 0.5, 0.7, -0.3, 0.8, 0.1),
        }
    }

    #[test]
    fn inertial_velocity_is_that_of_the_composed_motion() {
        let frame = Vector6::from(FRAME);
        let at = state();
        let found = inertial(&at, &frame);
        // F(t) M(t) with F = exp(W t), M = M₀ exp(v t + ½ v̇ t²), which has twist v and rate v̇ at
        // 0.
        let motion = |t: f64| {
            Motion::identity().increment(&(frame * t)).compose(
                &at.motion
                    .increment(&(at.twist * t + at.twist_rate * (0.5 * t * t))),
            )
        };
        let twist = |t: f64| {
            let h = 1e-3;
            let relative = |s: f64| motion(t).relative(&motion(t + s)).to_dual();
            let slope = ((relative(h) - relative(-h)) * 8.0
                - (relative(2.0 * h) - relative(-2.0 * h)))
                * (1.0 / (12.0 * h));
            slope.axial().to_twist()
        };
        // Rounding of the differences.
        assert!((found.twist - twist(0.0)).amax() < 1e-11);
        let rate = (twist(1e-4) - twist(-1e-4)) / 2e-4;
        assert!((found.twist_rate - rate).amax() < 1e-7);
    }

    #[test]
    fn tangents_are_exact() {
        let frame = Vector6::from(FRAME);
        let inertia = rigid_body_inertia(
            2.0,
            &Vector3::new(0.1, -0.2, 0.3),
            &Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5)),
        );
        let body = Inertia::rigid_body(0, &Motion::identity(), &inertia);
        let evaluate = |at: &NodeState, with_tangents: bool| {
            let mut out = Contribution::new(1, 0, with_tangents);
            let instant = Instant {
                nodes: &[inertial(at, &frame)],
                multipliers: &[],
                multiplier_rates: &[],
                resultants: &[],
                signals: &[],
                coordinates: &[],
                gravity: Vector3::new(1.0, -2.0, 0.5),
                inertial: InertialForces::FULL,
                time: 0.0,
            };
            body.evaluate(&instant, &mut out).unwrap();
            if with_tangents {
                add_variation(at, &frame, 0, &mut out);
            }
            out
        };
        let exact = evaluate(&state(), true);
        let h = 1e-3;
        for component in 0..6 {
            let mut unit = Vector6::zeros();
            unit[component] = 1.0;
            type Move<'a> = &'a dyn Fn(f64) -> NodeState;
            let moves: [(Move, &nalgebra::DMatrix<f64>); 3] = [
                (
                    &|x| NodeState {
                        motion: state().motion.increment(&(unit * x)),
                        ..state()
                    },
                    &exact.stiffness,
                ),
                (
                    &|x| NodeState {
                        twist: state().twist + unit * x,
                        ..state()
                    },
                    &exact.damping,
                ),
                (
                    &|x| NodeState {
                        twist_rate: state().twist_rate + unit * x,
                        ..state()
                    },
                    &exact.mass,
                ),
            ];
            for (moved, tangent) in moves {
                let force = |x: f64| evaluate(&moved(x), false).force;
                let slope = ((force(h) - force(-h)) * 8.0 - (force(2.0 * h) - force(-2.0 * h)))
                    / (12.0 * h);
                // Fourth-order differences: h⁴ times fifth derivatives of order 10.
                assert!((slope - tangent.column(component)).amax() < 1e-10);
            }
        }
    }
}
