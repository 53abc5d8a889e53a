//! Screws, cylindrical and planar pairs, and the joint that constrains nothing, under loads.

use super::common::{add_load, column, times};
use super::*;
use periodyn::elements::Coordinate::{
    Displacement1, Displacement2, Displacement3, Rotation1, Rotation2, Rotation3,
};
use periodyn::elements::LoadFrame;
use periodyn::motion::{Motion, rotation_from_vector};
use std::f64::consts::TAU;

/// A frame in general position: axis 3 of everything here.
fn tilted() -> Motion {
    Motion::new(
        rotation_from_vector(&Vector3::new(0.4, -0.7, 0.3)),
        Vector3::new(0.2, 0.5, -0.1),
    )
}

/// A body at the tilted frame, its axes of inertia those of the frame.
fn tilted_body(model: &mut Model, mass: f64, inertia: &Matrix3<f64>) -> usize {
    let frame = tilted();
    let turned = frame.rotation * inertia * frame.rotation.transpose();
    model
        .add_rigid_body(mass, &frame.position, &turned)
        .unwrap()
}

/// Response `[a, b]` of `a cos Ωt + b sin Ωt` of a linear oscillator to `F cos Ωt`.
fn response(mass: f64, damping: f64, stiffness: f64, force: f64, omega: f64) -> [f64; 2] {
    let (k, c) = (stiffness - mass * omega * omega, damping * omega);
    let size = force / (k * k + c * c);
    [k * size, c * size]
}

fn harmonic(amplitudes: [f64; 2], omega: f64) -> impl Fn(f64) -> f64 {
    move |t| amplitudes[0] * (omega * t).cos() + amplitudes[1] * (omega * t).sin()
}

/// A spindle turned in a fixed nut, to and fro by `swing`, lifts a load.
fn check_screw_jack(pitch: f64, swing: f64, points: usize) {
    let (mass, inertia, load, omega) = (3.0, 0.02, 150.0, 4.0);
    let period = TAU / omega;
    let axis = tilted().rotation.column(2).into_owned();
    let point = tilted().position;
    let mut model = Model::new();
    let spindle = tilted_body(&mut model, mass, &diagonal(0.1, 0.1, inertia));
    let kind = JointKind::Screw { pitch };
    let thread = joint(&mut model, kind, None, Some(spindle), &point, &axis);
    let signal = Signal::harmonics(0.0, 0.0, &[0.0], &[swing]).unwrap();
    prescribe(&mut model, thread, Rotation1, &signal);
    let [x, y, z] = (axis * -load).data.0[0];
    add_load(
        &mut model,
        spindle,
        LoadFrame::Space,
        &[x, y, z, 0.0, 0.0, 0.0],
        &[0.0; 6],
    );
    let solution = solve(&model, period, points);

    let times = times(period, 67);
    let lead = pitch / TAU;
    let name = |what: &str| {
        format!(
            "screw jack, pitch {pitch}, {:.1} turns: {what}",
            swing / TAU
        )
    };
    let of = |quantity| of_joint(&solution, thread, quantity, &times);
    let angle = along(&times, |t| swing * (omega * t).sin());
    let advance: Vec<f64> = angle.iter().map(|a| lead * a).collect();
    let travel = of(JointQuantity::Coordinate(Displacement1));
    assert_near(
        &of(JointQuantity::Coordinate(Rotation1)),
        &angle,
        &name("angle"),
    );
    assert_near(&travel, &advance, &name("displacement"));
    let speed = along(&times, |t| lead * swing * omega * (omega * t).cos());
    assert_near(
        &of(JointQuantity::Rate(Displacement1)),
        &speed,
        &name("rate"),
    );
    let place = along_vectors(&times, |t| {
        point + axis * (lead * swing * (omega * t).sin())
    });
    assert_near(
        &position(&solution, spindle, &times),
        &place,
        &name("position"),
    );

    // All the work of the torque lifts the load and speeds up the spindle: no loss.
    let second = |t: f64| -swing * omega * omega * (omega * t).sin();
    let torque = along(&times, |t| {
        (inertia + mass * lead * lead) * second(t) + lead * load
    });
    let found = of(JointQuantity::DrivingEffort(Rotation1));
    assert_near(&found, &torque, &name("torque"));
    // The nut holds the spindle along the axis, and about it against what holds it along.
    let thrust = |t: f64| mass * lead * second(t) + load;
    let hold = along_vectors(&times, |t| axis * thrust(t));
    assert_near(
        &reaction(&solution, thread, 0, &times),
        &hold,
        &name("thrust"),
    );
    let moment = along_vectors(&times, |t| axis * (-lead * thrust(t)));
    assert_near(
        &reaction(&solution, thread, 3, &times),
        &moment,
        &name("moment"),
    );
}

#[test]
fn a_screw_jack_trades_torque_for_thrust_without_loss() {
    check_screw_jack(0.2, 1.2, 31);
    check_screw_jack(-0.2, 1.2, 31);
}

#[test]
fn a_screw_counts_its_turns() {
    check_screw_jack(0.3, 2.7 * TAU, 91);
    check_screw_jack(-0.01, 2.7 * TAU, 91);
}

/// A motor turns a spindle in a bearing; a nut that cannot turn travels along it.
#[test]
fn a_lead_screw_moves_its_nut() {
    let (mass, inertia, load, omega, pitch, swing) = (3.0, 0.02, 40.0, 4.0, 0.15, 1.6 * TAU);
    let period = TAU / omega;
    let frame = tilted();
    let axis = frame.rotation.column(2).into_owned();
    let mut model = Model::new();
    let m = &mut model;
    let spindle = Some(tilted_body(m, 1.0, &diagonal(0.1, 0.1, inertia)));
    let nut = tilted_body(m, mass, &diagonal(0.1, 0.1, 0.3));
    let bearing = joint(
        m,
        JointKind::Revolute,
        None,
        spindle,
        &frame.position,
        &axis,
    );
    let kind = JointKind::Screw { pitch };
    let thread = joint(m, kind, spindle, Some(nut), &frame.position, &axis);
    let stop = joint(m, JointKind::Free, None, Some(nut), &frame.position, &axis);
    let signal = Signal::harmonics(0.0, 0.0, &[swing], &[0.0]).unwrap();
    prescribe(m, bearing, Rotation1, &signal);
    prescribe(m, stop, Rotation3, &Signal::constant(0.0).unwrap());
    let [x, y, z] = (axis * -load).data.0[0];
    add_load(
        m,
        nut,
        LoadFrame::Space,
        &[x, y, z, 0.0, 0.0, 0.0],
        &[0.0; 6],
    );
    let solution = solve(&model, period, 71);

    let times = times(period, 59);
    let lead = pitch / TAU;
    // The nut turns against the spindle, relative to it.
    let travel = along(&times, |t| -lead * swing * (omega * t).cos());
    let of = |joint, quantity| of_joint(&solution, joint, quantity, &times);
    assert_near(
        &of(stop, JointQuantity::Coordinate(Displacement3)),
        &travel,
        "nut",
    );
    assert_near(
        &of(thread, JointQuantity::Coordinate(Displacement1)),
        &travel,
        "thread",
    );
    let turn = along(&times, |t| -swing * (omega * t).cos());
    assert_near(
        &of(thread, JointQuantity::Coordinate(Rotation1)),
        &turn,
        "turns",
    );
    let second = |t: f64| -omega * omega * swing * (omega * t).cos();
    let thrust = |t: f64| load - mass * lead * second(t);
    let torque = along(&times, |t| inertia * second(t) - lead * thrust(t));
    let found = of(bearing, JointQuantity::DrivingEffort(Rotation1));
    assert_near(&found, &torque, "torque of the motor");
    let held = along(&times, |t| lead * thrust(t));
    let found = of(stop, JointQuantity::DrivingEffort(Rotation3));
    assert_near(&found, &held, "torque of the stop");
    // Nothing is constrained by the free joint.
    assert_eq!(largest(reaction(&solution, stop, 0, &times)), 0.0);
}

#[test]
fn a_cylindrical_pair_responds_along_and_about_its_axis_independently() {
    let (mass, inertia, omega) = (2.0, 0.05, 7.0);
    let (along_axis, about_axis) = ((300.0, 4.0), (4.0, 0.1));
    let (force, moment) = (25.0, 2.0);
    let (weight, rest, rest_angle) = (-9.0, 0.03, 0.4);
    let period = TAU / omega;
    let axis = tilted().rotation.column(2).into_owned();
    let mut model = Model::new();
    let body = tilted_body(&mut model, mass, &diagonal(0.02, 0.3, inertia));
    let kind = JointKind::Cylindrical;
    let pair = joint(
        &mut model,
        kind,
        None,
        Some(body),
        &tilted().position,
        &axis,
    );
    spring(
        &mut model,
        pair,
        Displacement1,
        along_axis.0,
        along_axis.1,
        rest,
    );
    spring(
        &mut model,
        pair,
        Rotation1,
        about_axis.0,
        about_axis.1,
        rest_angle,
    );
    let (f, m) = (axis * force, axis * moment);
    let amplitudes = [f.x, f.y, f.z, m.x, m.y, m.z];
    add_load(&mut model, body, LoadFrame::Space, &[0.0; 6], &amplitudes);
    gravity(&mut model, &(axis * weight));
    let solution = solve(&model, period, 41);

    let times = times(period, 53);
    let of = |quantity| of_joint(&solution, pair, quantity, &times);
    let (k, c) = along_axis;
    let shift = rest + mass * weight / k;
    let wave = harmonic(response(mass, c, k, force, omega), omega);
    let exact = along(&times, |t| shift + wave(t));
    assert_near(
        &of(JointQuantity::Coordinate(Displacement1)),
        &exact,
        "displacement",
    );
    let (k, c) = about_axis;
    let swing = response(inertia, c, k, moment, omega);
    assert!(swing[0].hypot(swing[1]) > 0.7, "a large rotation");
    let wave = harmonic(swing, omega);
    let exact = along(&times, |t| rest_angle + wave(t));
    assert_near(
        &of(JointQuantity::Coordinate(Rotation1)),
        &exact,
        "rotation",
    );
    // The axis is a principal one through the centre: the pair has nothing to hold.
    let size = mass * weight.abs();
    for first in [0, 3] {
        let values = reaction(&solution, pair, first, &times);
        assert_close(&values, &vec![0.0; values.len()], size, "reaction");
    }
}

#[test]
fn a_planar_pair_responds_independently_in_its_plane_to_large_rotations() {
    let (mass, inertia, omega) = (2.0, 0.05, 7.0);
    let directions = [(300.0, 4.0, 40.0), (120.0, 6.0, -30.0), (1.5, 0.1, 4.0)];
    let push = 12.0;
    let period = TAU / omega;
    let frame = tilted();
    let mut model = Model::new();
    let body = tilted_body(&mut model, mass, &diagonal(0.02, 0.3, inertia));
    let pair = model
        .add_joint(JointKind::Planar, None, Some(body), &frame, &frame)
        .unwrap();
    let coordinates = [Displacement1, Displacement2, Rotation1];
    for (coordinate, (stiffness, damping, _)) in coordinates.into_iter().zip(directions) {
        spring(&mut model, pair, coordinate, stiffness, damping, 0.0);
    }
    let [x, y, m] = directions.map(|d| d.2);
    let (f, m) = (
        frame.rotation * Vector3::new(x, y, push),
        frame.rotation * Vector3::z() * m,
    );
    let amplitudes = [f.x, f.y, f.z, m.x, m.y, m.z];
    add_load(&mut model, body, LoadFrame::Space, &[0.0; 6], &amplitudes);
    let solution = solve(&model, period, 61);

    let times = times(period, 53);
    let sizes = [mass, mass, inertia];
    for ((coordinate, size), (k, c, load)) in coordinates.into_iter().zip(sizes).zip(directions) {
        let amplitudes = response(size, c, k, load, omega);
        let exact = along(&times, harmonic(amplitudes, omega));
        let found = of_joint(
            &solution,
            pair,
            JointQuantity::Coordinate(coordinate),
            &times,
        );
        assert_near(&found, &exact, &format!("planar pair: {coordinate}"));
        assert!(
            coordinate != Rotation1 || largest(exact) > 1.6,
            "a large rotation"
        );
    }
    // The plane bears what pushes onto it, and its moment about the point of the second body.
    let normal = frame.rotation.column(2).into_owned();
    let hold = along_vectors(&times, |t| normal * (-push * (omega * t).cos()));
    assert_near(
        &reaction(&solution, pair, 0, &times),
        &hold,
        "planar pair: reaction",
    );
}

/// A mass on springs in the axes of a table that turns in a vertical plane: in these axes its
/// weight turns backwards, and it is subject to Coriolis and centrifugal forces.
#[test]
fn a_planar_pair_on_a_turning_table_follows_the_rotating_frame() {
    let (mass, inertia, omega, g) = (1.5, 0.1, 3.0, 9.81);
    let (k1, k2) = (200.0, 90.0);
    let period = TAU / omega;
    let mut model = Model::new();
    let m = &mut model;
    let (origin, z) = (Vector3::zeros(), Vector3::z());
    let table = m.add_rigid_body(5.0, &origin, &diagonal(1.0, 1.0, 2.0));
    let table = Some(table.unwrap());
    let body = m.add_rigid_body(mass, &origin, &diagonal(inertia, inertia, inertia));
    let body = body.unwrap();
    let motor = joint(m, JointKind::Revolute, None, table, &origin, &z);
    let frame = Motion::identity();
    let pair = m
        .add_joint(JointKind::Planar, table, Some(body), &frame, &frame)
        .unwrap();
    spring(m, pair, Displacement1, k1, 0.0, 0.0);
    spring(m, pair, Displacement2, k2, 0.0, 0.0);
    spring(m, pair, Rotation1, 3.0, 0.0, 0.0);
    let turn = Signal::harmonics(0.0, omega, &[], &[]).unwrap();
    prescribe(m, motor, Rotation1, &turn);
    gravity(m, &Vector3::new(0.0, -g, 0.0));
    let solution = solve(&model, period, 15);

    // x = a sin Ωt, y = b cos Ωt in m(ẍ − 2Ωẏ − Ω²x) + k₁x = −mg sin Ωt, m(ÿ + 2Ωẋ − Ω²y) + k₂y =
    // −mg cos Ωt.
    let s = 2.0 * mass * omega * omega;
    let determinant = (k1 - s) * (k2 - s) - s * s;
    let a = -mass * g * (k2 - 2.0 * s) / determinant;
    let b = -mass * g * (k1 - 2.0 * s) / determinant;
    let times = times(period, 31);
    let of = |joint, quantity| of_joint(&solution, joint, quantity, &times);
    let x = along(&times, |t| a * (omega * t).sin());
    let y = along(&times, |t| b * (omega * t).cos());
    assert_near(
        &of(pair, JointQuantity::Coordinate(Displacement1)),
        &x,
        "displacement 1",
    );
    assert_near(
        &of(pair, JointQuantity::Coordinate(Displacement2)),
        &y,
        "displacement 2",
    );
    // The torque balances the springs' forces on the table, at the place of the mass.
    let torque = along(&times, |t| {
        let (s, c) = (omega * t).sin_cos();
        (k1 - k2) * a * s * b * c
    });
    let found = of(motor, JointQuantity::DrivingEffort(Rotation1));
    assert_near(&found, &torque, "torque on the table");
}

/// Springs between two bodies in general motion, by a joint that constrains nothing: base moved in
/// all six coordinates, and a suspended body that must move with it in the end.
#[test]
fn a_free_joint_prescribes_and_measures_any_motion() {
    let (omega, stiff) = (2.0, 1.1e3);
    let period = TAU / omega;
    let mut model = Model::new();
    let frame = tilted();
    let base = tilted_body(&mut model, 2.0, &diagonal(0.3, 0.4, 0.5));
    let drive = model
        .add_joint(JointKind::Free, None, Some(base), &frame, &frame)
        .unwrap();
    let coordinates = JointKind::Free.coordinates();
    let signal = |i: usize| -> [f64; 3] {
        let size = [0.3, -0.2, 0.5, 1.1, 0.6, -0.9][i];
        [0.1 * size, size, -0.5 * size]
    };
    for (i, &coordinate) in coordinates.iter().enumerate() {
        let [mean, cosine, sine] = signal(i);
        let signal = Signal::harmonics(mean, 0.0, &[cosine], &[sine]).unwrap();
        prescribe(&mut model, drive, coordinate, &signal);
    }
    // A particle hangs on three equal springs at a point of the base: they pull as one spring,
    // whatever their axes do.
    let place = frame.position + Vector3::new(0.4, 0.0, 0.2);
    let bob = particle(&mut model, 1.5, &place);
    let ties = Motion::new(Matrix3::identity(), place);
    let hang = model
        .add_joint(JointKind::Free, Some(base), Some(bob), &ties, &ties)
        .unwrap();
    for coordinate in [Displacement1, Displacement2, Displacement3] {
        spring(&mut model, hang, coordinate, stiff, 0.0, 0.0);
    }
    // A particle's own turning is held.
    for coordinate in [Rotation1, Rotation2, Rotation3] {
        spring(&mut model, hang, coordinate, 1.0, 0.0, 0.0);
    }
    let solution = solve(&model, period, 61);

    let times = times(period, 43);
    for (i, &coordinate) in coordinates.iter().enumerate() {
        let [mean, cosine, sine] = signal(i);
        let exact = along(&times, |t| {
            mean + cosine * (omega * t).cos() + sine * (omega * t).sin()
        });
        let found = of_joint(
            &solution,
            drive,
            JointQuantity::Coordinate(coordinate),
            &times,
        );
        assert_near(&found, &exact, &format!("free joint: {coordinate}"));
    }
    // m r̈ = k (p − r) in space, for the point p of the base: harmonic by harmonic.
    let point = |t: f64| {
        let wave = |i: usize| {
            let [mean, cosine, sine] = signal(i);
            mean + cosine * (omega * t).cos() + sine * (omega * t).sin()
        };
        let turn = |axis: usize, angle: f64| {
            let mut v = Vector3::zeros();
            v[axis] = angle;
            rotation_from_vector(&v)
        };
        let rotation = turn(0, wave(3)) * turn(1, wave(4)) * turn(2, wave(5));
        let shift = Vector3::new(wave(0), wave(1), wave(2));
        let arm = frame.rotation.transpose() * (place - frame.position);
        frame.position + frame.rotation * (shift + rotation * arm)
    };
    const SAMPLES: usize = 128;
    let exact = along_vectors(&times, |t| {
        let mut sum = Vector3::zeros();
        for k in 0..SAMPLES {
            let at = period * k as f64 / SAMPLES as f64;
            // Sum over harmonics of the static and dynamic response to the sample at this time.
            let mut kernel = 1.0;
            for j in 1..SAMPLES / 2 {
                let stretch = 1.0 / (1.0 - 1.5 * (j as f64 * omega).powi(2) / stiff);
                kernel += 2.0 * stretch * (j as f64 * omega * (t - at)).cos();
            }
            sum += point(at) * (kernel / SAMPLES as f64);
        }
        sum
    });
    assert_near(
        &position(&solution, bob, &times),
        &exact,
        "free joint: suspended particle",
    );
    let x = column(&position(&solution, bob, &times), 3, 0);
    assert!(
        largest(
            x.iter()
                .zip(along(&times, |t| point(t).x))
                .map(|(a, b)| a - b)
        ) > 1e-4
    );
}
