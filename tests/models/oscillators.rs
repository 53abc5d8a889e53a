//! Oscillators of one coordinate whose responses are known from elsewhere: a mass of 1 on a slide,
//! and others as simple.

use super::parts::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{CoordinateLaw, Effort};
use periodyn::model::*;
use std::sync::Arc;

/// `x'' + 0.05 x' + x + 0.1 x³ = 0.18 cos Ωt`.
pub fn duffing() -> Model {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    model
        .add_polynomial_spring_damper(at, &[1.0, 0.0, 0.1], &[0.05], 0.0)
        .unwrap();
    model.add_actuator(at, &cosine(0.18)).unwrap();
    model
}

/// The same with a parameter that is the load's amplitude, from `0.18` on.
pub fn duffing_with_load() -> (Model, usize) {
    let mut model = duffing();
    let load = model.add_parameter("load", 0.18, 0.1).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(1), SignalPart::Amplitude);
    model.move_by_parameter(load, target, 1.0 / 0.18).unwrap();
    (model, load)
}

/// `x'' + 0.1 x' + x − x² = F cos Ωt`, and the parameter that is `F`, from 0.01 on.
pub fn escape_oscillator() -> (Model, usize) {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    model
        .add_polynomial_spring_damper(at, &[1.0, -1.0], &[0.1], 0.0)
        .unwrap();
    model.add_actuator(at, &cosine(1.0)).unwrap();
    let load = model.add_parameter("load", 0.01, 0.1).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(1), SignalPart::Amplitude);
    model.move_by_parameter(load, target, 1.0).unwrap();
    (model, load)
}

/// `x'' − μ (1 − x²) x' + x = 0`, and the slide's coordinate.
pub fn van_der_pol(mu: f64) -> (Model, JointCoordinate) {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    let law = CoordinateLaw {
        function: Arc::new(move |state| {
            let (x, v) = (state.value, state.rate);
            Ok(Effort {
                value: x - mu * (1.0 - x * x) * v,
                by_coordinate: 1.0 + 2.0 * mu * x * v,
                by_rate: -mu * (1.0 - x * x),
            })
        }),
        gives_derivatives: true,
    };
    let force = model.add_coordinate_law(at, law).unwrap();
    model.declare_of_phase(force).unwrap();
    (model, at)
}

/// A point mass of 1 on a rod of length 1 under gravity 9.81, with damping 0.5 and a constant
/// torque at its hinge, and the parameter that is the torque, from zero on: it stands still where
/// `9.81 sin θ` is the torque.
pub fn pendulum_under_torque() -> (Model, usize) {
    let bob = Vector3::new(0.0, 0.0, -1.0);
    let (mut model, hinge) = hinged_body(1.0, &bob, &Matrix3::zeros(), &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let at = rotation1(hinge);
    model
        .add_polynomial_spring_damper(at, &[0.0], &[0.5], 0.0)
        .unwrap();
    model
        .add_actuator(at, &Signal::constant(0.0).unwrap())
        .unwrap();
    let torque = model.add_parameter("torque", 0.0, 1.0).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(1), SignalPart::Mean);
    model.move_by_parameter(torque, target, 1.0).unwrap();
    (model, torque)
}

/// `m (x'' + c x' + x) = (r² − r⁴) x'` with `r² = x² + x'²`, from `m = 1` and `c = 0.1` on, and the
/// parameters that are `c` and `m`: its limit cycles are `x = r cos t` with `m c = r² − r⁴`.
pub fn circles() -> (Model, usize, usize) {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    let spring = model.add_polynomial_spring_damper(at, &[1.0], &[], 0.0);
    let law = CoordinateLaw {
        function: Arc::new(|state| {
            let (x, v) = (state.value, state.rate);
            let square = x * x + v * v;
            let (growth, slope) = (square - square * square, 1.0 - 2.0 * square);
            Ok(Effort {
                value: -growth * v,
                by_coordinate: -slope * 2.0 * x * v,
                by_rate: -growth - slope * 2.0 * v * v,
            })
        }),
        gives_derivatives: true,
    };
    let force = model.add_coordinate_law(at, law).unwrap();
    model.declare_of_phase(force).unwrap();
    let damping = model.add_parameter("damping", 0.1, 0.1).unwrap();
    model
        .move_by_parameter(damping, Target::MassDamping, 1.0)
        .unwrap();
    let mass = model.add_parameter("mass", 1.0, 1.0).unwrap();
    for target in [Target::Inertia(0), Target::Stiffness(spring.unwrap(), 1)] {
        model.move_by_parameter(mass, target, 1.0).unwrap();
    }
    (model, damping, mass)
}
