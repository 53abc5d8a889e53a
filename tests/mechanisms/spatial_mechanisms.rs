//! Hooke's joint and spatial four-bars.

use super::common::{add_load, times};
use super::jet::{Jet, Point, second_rate};
use super::*;
use periodyn::elements::Coordinate::Rotation1;
use periodyn::elements::LoadFrame;
use periodyn::motion::Motion;

/// Two shafts that meet at an angle, the first turned by a motor, the second with a flywheel and a
/// load.
fn check_hooke(bend: f64) {
    let (inertia, load) = (0.3, 2.0);
    let turning = Turning {
        offset: 0.3,
        omega: 4.0,
        swing: 0.25,
    };
    let mut model = Model::new();
    let m = &mut model;
    let origin = Vector3::zeros();
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let axis = Vector3::new(bend.cos(), 0.0, bend.sin());
    let slight = diagonal(0.05, 0.04, 0.04);
    let first = Some(m.add_rigid_body(1.0, &(x * -0.5), &slight).unwrap());
    let polar = axis * axis.transpose();
    let spin = polar * inertia + (Matrix3::identity() - polar) * 0.2;
    let second = m.add_rigid_body(1.0, &(axis * 0.7), &spin).unwrap();
    // The first shaft is held at its end and at the cross, the second in a sleeve: no constraint
    // too many.
    let end = Motion::new(Matrix3::identity(), x * -1.0);
    let motor = m.add_joint(JointKind::Spherical, None, first, &end, &end);
    let motor = motor.unwrap();
    let cross = universal(m, first, Some(second), &origin, [&z, &y]);
    let sleeve = joint(
        m,
        JointKind::Cylindrical,
        None,
        Some(second),
        &(axis * 0.7),
        &axis,
    );
    prescribe(m, motor, Rotation1, &turning.signal(0.0));
    let moment = axis * -load;
    let constant = [0.0, 0.0, 0.0, moment.x, moment.y, moment.z];
    add_load(m, second, LoadFrame::Space, &constant, &[0.0; 6]);
    let solution = solve(&model, turning.period(), 121);

    // The Jacobian's blocks of this model are close to singular; yet each increment is exact
    // enough.
    let iterations = &solution.details().report.iterations;
    assert!(iterations.iter().all(|i| i.step == 1.0), "{iterations:?}");
    // tan θ₂ = tan θ₁ / cos β, and so on.
    let times = times(turning.period(), 73);
    let output = |t: f64| {
        let [angle, rate, acceleration] = turning.at(t);
        let angle = Jet::variable(angle);
        let turned = angle.sin().atan2(angle.cos() * bend.cos());
        let ratio = bend.cos() / (1.0 - (bend.sin() * angle.0[0].cos()).powi(2));
        let speed = turned.0[1] * rate;
        assert!((ratio * rate - speed).abs() < 1e-13 * speed.abs());
        (ratio, speed, second_rate(&turned, rate, acceleration))
    };
    let name = |what: &str| format!("Hooke's joint at {bend} rad: {what}");
    let of = |joint, quantity| of_joint(&solution, joint, quantity, &times);
    let speed = along(&times, |t| output(t).1);
    let found = of(sleeve, JointQuantity::Rate(Rotation1));
    assert_near(&found, &speed, &name("speed"));
    let acceleration = along(&times, |t| output(t).2);
    let found = of(sleeve, JointQuantity::Acceleration(Rotation1));
    assert_near(&found, &acceleration, &name("acceleration"));
    // Of the moment along the arms' normal, the first shaft feels the ratio.
    let passed = |t: f64| load + inertia * output(t).2;
    let torque = along(&times, |t| {
        0.05 * turning.at(t)[2] + output(t).0 * passed(t)
    });
    let found = of(motor, JointQuantity::DrivingEffort(Rotation1));
    assert_near(&found, &torque, &name("torque"));
    let found: Vec<f64> = reaction(&solution, cross, 3, &times)
        .chunks_exact(3)
        .map(|v| Vector3::from_column_slice(v).dot(&axis))
        .collect();
    let passed = along(&times, passed);
    assert_near(&found, &passed, &name("moment about the second shaft"));
}

#[test]
fn a_cardan_shaft_turns_by_hookes_ratio() {
    check_hooke(0.5);
    check_hooke(-0.9);
}

/// Crank and rocker with axes in space, and a coupler with balls at both ends (RSSR).
struct Rssr {
    crank: f64,
    rocker: f64,
    coupler: f64,
    /// A point of the rocker's axis, and two directions across it.
    foot: Vector3<f64>,
    directions: [Vector3<f64>; 2],
}

impl Rssr {
    /// Angle of the rocker as a function of that of the crank: of `P cos φ + Q sin φ = S`, the
    /// branch that goes on.
    fn output(&self, angle: f64) -> Jet {
        let a = self.pin(angle);
        let dot = |v: &Vector3<f64>| a[0] * v.x + a[1] * v.y - Jet::constant(self.foot.dot(v));
        let [e, f] = self.directions;
        let (p, q) = (dot(&e), dot(&f));
        let square = (a[0] - Jet::constant(self.foot.x)) * (a[0] - Jet::constant(self.foot.x))
            + (a[1] - Jet::constant(self.foot.y)) * (a[1] - Jet::constant(self.foot.y))
            + Jet::constant(self.foot.z * self.foot.z);
        let known = Jet::constant(self.rocker * self.rocker - self.coupler * self.coupler);
        let s = (square + known) * (0.5 / self.rocker);
        let size = (p * p + q * q).sqrt();
        q.atan2(p) + (s * size.inverse()).acos()
    }

    fn pin(&self, angle: f64) -> [Jet; 2] {
        let theta = Jet::variable(angle);
        [theta.cos() * self.crank, theta.sin() * self.crank]
    }

    /// Crank pin and rocker pin.
    fn pins(&self, angle: f64) -> (Point, Point) {
        let [x, y] = self.pin(angle);
        let turned = self.output(angle);
        let (c, s) = (turned.cos() * self.rocker, turned.sin() * self.rocker);
        let [e, f] = self.directions;
        let at = |i: usize| Jet::constant(self.foot[i]) + c * e[i] + s * f[i];
        (
            Point::new(x, y, Jet::constant(0.0)),
            Point::new(at(0), at(1), at(2)),
        )
    }
}

#[test]
fn a_spatial_four_bar_with_two_balls_has_its_closed_form() {
    let tilt = 0.6f64;
    let mechanism = Rssr {
        crank: 0.2,
        rocker: 0.6,
        coupler: 0.9,
        foot: Vector3::new(0.8, 0.1, 0.3),
        directions: [Vector3::y(), Vector3::new(tilt.sin(), 0.0, tilt.cos())],
    };
    let turning = Turning {
        offset: 0.0,
        omega: 3.0,
        swing: 0.2,
    };
    let (masses, inertias) = ([1.0, 0.8], [0.05, 0.2]);
    let reference = 0.5;
    let (pin, ball) = mechanism.pins(reference);
    let (pin, ball) = (pin.0[0], ball.0[0]);
    let closed = (pin - ball).norm() - mechanism.coupler;
    assert!(closed.abs() < 1e-15, "the test's own solution: {closed}");
    let [e, f] = mechanism.directions;
    let axis = e.cross(&f);

    let mut model = Model::new();
    let m = &mut model;
    let spin = Matrix3::identity() * inertias[0];
    let crank = Some(m.add_rigid_body(1.0, &Vector3::zeros(), &spin).unwrap());
    let mass = particle(m, masses[0], &((pin + ball) * 0.5));
    let coupler = Some(mass);
    let spin = Matrix3::identity() * inertias[1];
    let rocker = Some(m.add_rigid_body(masses[1], &mechanism.foot, &spin).unwrap());
    let motor = joint(
        m,
        JointKind::Revolute,
        None,
        crank,
        &Vector3::zeros(),
        &Vector3::z(),
    );
    // A cross in place of one ball keeps the coupler from spinning, and leaves its ends where they
    // are.
    let along_coupler = (ball - pin).normalize();
    let across = along_coupler.cross(&axis).normalize();
    let third = along_coupler.cross(&across);
    let upper = universal(m, crank, coupler, &pin, [&across, &third]);
    let lower = joint(m, JointKind::Spherical, coupler, rocker, &ball, &axis);
    let pivot = joint(m, JointKind::Revolute, None, rocker, &mechanism.foot, &axis);
    prescribe(m, motor, Rotation1, &turning.signal(reference));
    let solution = solve(&model, turning.period(), 121);

    let times = times(turning.period(), 71);
    let start = mechanism.output(reference).0[0];
    let output = |t: f64| {
        let [angle, rate, acceleration] = turning.at(t);
        let turned = mechanism.output(angle);
        [
            turned.0[0] - start,
            turned.0[1] * rate,
            second_rate(&turned, rate, acceleration),
        ]
    };
    let of = |joint, quantity| of_joint(&solution, joint, quantity, &times);
    let quantities = [
        JointQuantity::Coordinate(Rotation1),
        JointQuantity::Rate(Rotation1),
        JointQuantity::Acceleration(Rotation1),
    ];
    for (i, quantity) in quantities.into_iter().enumerate() {
        let exact = along(&times, |t| output(t)[i]);
        assert_near(&of(pivot, quantity), &exact, &format!("RSSR: {quantity:?}"));
    }
    let middle = |t: f64| {
        let [angle, rate, acceleration] = turning.at(t);
        let (a, b) = mechanism.pins(angle);
        let half = Point([0, 1, 2].map(|i| (a.0[i] + b.0[i]) * 0.5));
        (half.0[0], half.acceleration(rate, acceleration), half.0[1])
    };
    let exact = along_vectors(&times, |t| middle(t).0);
    let found = position(&solution, mass, &times);
    assert_near(&found, &exact, "RSSR: coupler");
    let torque = along(&times, |t| {
        let ratio = output(t)[1] / turning.at(t)[1];
        let (_, inertial, shift) = middle(t);
        inertias[0] * turning.at(t)[2]
            + inertias[1] * output(t)[2] * ratio
            + masses[0] * inertial.dot(&shift)
    });
    let found = of(motor, JointQuantity::DrivingEffort(Rotation1));
    assert_near(&found, &torque, "RSSR: torque");
    // The ends of the coupler together carry its inertia, and turn the rocker.
    let forces: Vec<f64> = reaction(&solution, upper, 0, &times)
        .iter()
        .zip(reaction(&solution, lower, 0, &times))
        .map(|(a, b)| a - b)
        .collect();
    let inertial = along_vectors(&times, |t| middle(t).1 * masses[0]);
    assert_near(&forces, &inertial, "RSSR: forces on the coupler");
}
