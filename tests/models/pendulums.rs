//! An oscillator and pendulums.

use super::parts::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::MaxwellBranch;
use periodyn::model::*;

/// A mass on a spring and a damper along z, driven by `F cos Ωt`: `m`, `k`, `c`, `F`.
pub const OSCILLATOR: [f64; 4] = [2.0, 50.0, 1.2, 3.0];

/// The oscillator and its slide.
pub fn oscillator() -> (Model, usize) {
    let [mass, stiffness, damping, force] = OSCILLATOR;
    let (mut model, at) = mass_on_a_slide(mass, &Vector3::z());
    spring(&mut model, at, stiffness, damping);
    model.add_actuator(at, &cosine(force)).unwrap();
    (model, at.joint)
}

/// Two rigid bodies that swing through large angles under gravity, driven at the shoulder; and the
/// elbow's joint.
pub fn double_pendulum() -> (Model, usize) {
    let mut model = Model::new();
    let spin = Matrix3::from_diagonal(&Vector3::new(0.02, 0.03, 0.01));
    let at = |z: f64| Vector3::new(0.0, 0.0, z);
    let first = model.add_rigid_body(1.0, &at(-0.3), &spin).unwrap();
    let second = model.add_rigid_body(0.7, &at(-0.9), &spin).unwrap();
    let y = Vector3::y();
    let shoulder = revolute(&mut model, None, Some(first), &at(0.0), &y);
    let elbow = revolute(&mut model, Some(first), Some(second), &at(-0.6), &y);
    spring(&mut model, rotation1(shoulder), 0.0, 0.5);
    spring(&mut model, rotation1(elbow), 0.0, 0.3);
    model
        .add_actuator(rotation1(shoulder), &cosine(3.0))
        .unwrap();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    (model, elbow)
}

/// Period of its drive.
pub const DOUBLE_PENDULUM_PERIOD: f64 = 1.7;

/// An arm that turns about z: its mass, its length, and its inertia about the hinge.
pub const MASS: f64 = 1.3;
pub const ARM: f64 = 0.7;
pub const INERTIA: f64 = 0.2 + MASS * ARM * ARM;

/// The arm, along x, and its hinge.
pub fn arm() -> (Model, usize) {
    let spin = Matrix3::from_diagonal(&Vector3::new(0.1, 0.15, 0.2));
    hinged_body(MASS, &(Vector3::x() * ARM), &spin, &Vector3::z())
}

/// Pendulum with a Zener element: length and mass of the arm, and the element's long-term
/// stiffness, stiffness of its branch and relaxation time.
pub const ZENER_ARM: f64 = 0.7;
pub const ZENER_BOB: f64 = 1.3;
pub const ZENER: [f64; 3] = [6.0, 4.0, 0.3];

/// The pendulum, its hinge, and the element.
pub fn zener_pendulum() -> (Model, usize, usize) {
    let spin = Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.15));
    let centre = Vector3::new(0.0, 0.0, -ZENER_ARM);
    let (mut model, hinge) = hinged_body(ZENER_BOB, &centre, &spin, &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let branch = MaxwellBranch {
        stiffness: ZENER[1],
        relaxation_time: ZENER[2],
    };
    let force = model
        .add_viscoelastic(rotation1(hinge), ZENER[0], 0.0, &[branch])
        .unwrap();
    model.add_actuator(rotation1(hinge), &cosine(9.0)).unwrap();
    (model, hinge, force)
}
