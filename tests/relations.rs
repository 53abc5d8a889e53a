//! Linear relations between joint coordinates, against closed forms.

mod common;

use common::*;
use nalgebra::{Complex, Vector3, Vector6};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::output::{JointQuantity, Modes, NodeQuantity, Quantity, Solution};
use periodyn::solve::*;
use periodyn::system::{Summary, System};
use std::f64::consts::TAU;

const ANGLE: JointQuantity = JointQuantity::Coordinate(Coordinate::Rotation1);
const DRIVE: JointQuantity = JointQuantity::DrivingEffort(Coordinate::Rotation1);

/// A wheel on a revolute joint from the ground about z at `(x, 0, 0)`; the joint.
fn wheel(model: &mut Model, x: f64, inertia: f64) -> usize {
    let centre = Vector3::x() * x;
    let body = ball(model, 1.0, inertia, &centre);
    revolute(model, None, Some(body), &centre, &Vector3::z())
}

fn effort(relation: usize, coordinate: usize) -> Quantity {
    Quantity::RelationEffort {
        relation,
        coordinate,
    }
}

fn assert_all_near(found: &[f64], exact: impl Fn(f64) -> f64, times: &[f64], tolerance: f64) {
    let exact: Vec<f64> = times.iter().map(|&t| exact(t)).collect();
    let error = largest_difference(found, &exact) / largest(exact.iter().copied()).max(1e-3);
    println!("relative error {error:.1e}");
    assert!(error < tolerance, "{error:e}");
}

const INERTIAS: [f64; 2] = [0.4, 0.15];
const STIFFNESS: f64 = 3.0;
/// Turns of the second wheel for one of the first.
const RATIO: f64 = -2.5;

/// Two geared wheels, the first on a spring, and its joint and the second's.
fn geared() -> (Model, [usize; 2]) {
    let mut model = Model::new();
    let joints = [
        wheel(&mut model, 0.0, INERTIAS[0]),
        wheel(&mut model, 1.0, INERTIAS[1]),
    ];
    spring(&mut model, rotation1(joints[0]), STIFFNESS, 0.0);
    // In any unit: only the ratio counts.
    let terms = [
        (rotation1(joints[0]), 40.0 * RATIO),
        (rotation1(joints[1]), -40.0),
    ];
    model.add_relation(&terms, None).unwrap();
    (model, joints)
}

fn joined_inertia() -> f64 {
    INERTIAS[0] + RATIO * RATIO * INERTIAS[1]
}

#[test]
fn geared_wheels_move_as_one_inertia() {
    let (mut model, joints) = geared();
    let (omega, moment) = (2.2, 1.7);
    let first = rotation1(joints[0]);
    model.add_actuator(first, &cosine(moment)).unwrap();
    let amplitude = moment / (STIFFNESS - omega * omega * joined_inertia());
    assert!(amplitude.abs() > 0.3, "turns of {amplitude} are large");
    let period = TAU / omega;
    let times = times(period, 40);
    let methods = [
        LinearMethod::Direct,
        LinearMethod::Iterative(None),
        LinearMethod::Automatic,
    ];
    for linear in methods {
        let options = PeriodicOptions {
            linear,
            ..options(41)
        };
        let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(
            solution.outcome(),
            Outcome::Converged,
            "{}",
            solution.report()
        );
        let wave = |size: f64| move |t: f64| size * (omega * t).cos();
        let angle = |joint| solution.joint(joint, ANGLE, &times).unwrap();
        // 41 points resolve rotations by some two radians to rounding.
        assert_all_near(&angle(joints[0]), wave(amplitude), &times, 1e-10);
        assert_all_near(&angle(joints[1]), wave(RATIO * amplitude), &times, 1e-10);
        let second = -omega * omega * INERTIAS[1] * RATIO * amplitude;
        let efforts = |coordinate| solution.sample(effort(0, coordinate), &times).unwrap();
        assert_all_near(&efforts(1), wave(second), &times, 1e-9);
        // The work of both is none.
        assert_all_near(&efforts(0), wave(-RATIO * second), &times, 1e-9);
    }
}

#[test]
fn newton_takes_relations_quadratically() {
    let (mut model, joints) = geared();
    let first = rotation1(joints[0]);
    let stiff = [0.0, 0.0, 1.5];
    model
        .add_polynomial_spring_damper(first, &stiff, &[0.4], 0.0)
        .unwrap();
    model.add_actuator(first, &cosine(1.7)).unwrap();
    let solution = solve(&model, TAU / 2.2, 31);
    let history = &solution.details().report.iterations;
    let sizes: Vec<f64> = history.iter().map(|step| step.increment).collect();
    println!("{sizes:?}");
    let quadratic = sizes
        .windows(2)
        .filter(|pair| pair[0] < 0.1 && pair[1] > 1e-13);
    for pair in quadratic {
        assert!(pair[1] < 30.0 * pair[0] * pair[0], "{sizes:?}");
    }
}

#[test]
fn modes_statics_and_marches_keep_relations() {
    let (mut model, joints) = geared();
    let options = ModesOptions {
        count: 1,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    let found = modes.modes()[0].eigenvalue.im;
    let exact = (STIFFNESS / joined_inertia()).sqrt();
    assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");

    // More than two turns of the second wheel.
    let moment = 2.1 * STIFFNESS * TAU / RATIO.abs();
    let constant = Signal::constant(moment).unwrap();
    model.add_actuator(rotation1(joints[0]), &constant).unwrap();
    let statics = StaticOptions::default();
    let solution = Solution::solve_static(&model, &statics, &mut |_, _| true).unwrap();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    let angle = |joint| solution.joint(joint, ANGLE, &[0.0]).unwrap()[0];
    assert!((angle(joints[0]) - moment / STIFFNESS).abs() < 1e-11);
    assert!((angle(joints[1]) - RATIO * moment / STIFFNESS).abs() < 1e-11);
    let on_second = solution.sample(effort(0, 1), &[0.0]).unwrap()[0];
    assert!(on_second.abs() < 1e-11, "nothing holds the second wheel");

    // From rest under the same moment: q = (M / k) (1 − cos ωt).
    let period = TAU / exact;
    let end = MarchEnd::Duration(0.75 * period);
    let options = MarchOptions::with_step(period / 2000.0, end);
    let march = Solution::march(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(march.outcome(), Outcome::Converged, "{}", march.report());
    let last = [0.75 * period];
    for (joint, ratio) in joints.into_iter().zip([1.0, RATIO]) {
        let found = march.joint(joint, ANGLE, &last).unwrap()[0];
        let exact = ratio * moment / STIFFNESS;
        // The error of second-order steps: some (ω h)² of it.
        assert!(
            (found - exact).abs() < 3e-5 * exact.abs(),
            "{found} {exact}"
        );
    }
}

/// A driven wheel, and one with its mass off its axis that turns `ratio` times as fast; joints.
fn driven(ratio: f64, rate: f64) -> (Model, [usize; 2]) {
    let mut model = Model::new();
    let first = wheel(&mut model, 0.0, 0.4);
    let off = Vector3::new(1.2, 0.0, 0.0);
    let body = ball(&mut model, 1.5, 0.2, &off);
    let second = revolute(&mut model, None, Some(body), &Vector3::x(), &Vector3::z());
    model.prescribe(rotation1(first), &steady(rate)).unwrap();
    let terms = [(rotation1(first), ratio), (rotation1(second), -1.0)];
    model.add_relation(&terms, None).unwrap();
    gravity(&mut model, [0.0, -9.81, 0.0]);
    (model, [first, second])
}

#[test]
fn geared_wheels_turn_on_and_on() {
    for (ratio, points) in [(2.0, 21), (-1.0, 11), (3.0, 31), (-7.0, 71)] {
        let (rate, period) = (1.3, TAU / 1.3);
        let (model, joints) = driven(ratio, rate);
        let solution = solve(&model, period, points);
        let times = times(period, 30);
        let angle = solution.joint(joints[1], ANGLE, &times).unwrap();
        assert_all_near(&angle, |t| ratio * rate * t, &times, 1e-11);
        // The weight's moment about the second axis, at the gear's ratio.
        let weight = 1.5 * 9.81 * 0.2;
        let moment = |t: f64| ratio * weight * (ratio * rate * t).cos();
        let drive = solution.joint(joints[0], DRIVE, &times).unwrap();
        assert_all_near(&drive, moment, &times, 1e-9);
        let on_first = solution.sample(effort(0, 0), &times).unwrap();
        assert_all_near(&on_first, |t| -moment(t), &times, 1e-9);
    }
}

/// A flexible blade on a hub that turns at `2 · rate`, driven itself or by a gear; its tip.
fn blade(rate: f64, geared: bool) -> (Model, usize) {
    let mut model = Model::new();
    let first = wheel(&mut model, 0.0, 0.4);
    let hub = wheel(&mut model, 3.0, 0.4);
    let mut section =
        SectionInput::diagonal(&[1e4, 4e3, 4e3, 1.0, 1.0, 1.5], &[1.0, 2e-4, 1e-4, 1e-4]).unwrap();
    section.damp_proportionally(3e-3).unwrap();
    let root = Vector3::x() * 3.1;
    let ends = (root, Vector3::x() * 4.1);
    let beam = model.add_straight_beam(&ends.0, &ends.1, &Vector3::y(), &section, 2, 4);
    let beam = beam.unwrap();
    let clamp = [Some(1), Some(beam.first_node)];
    join(&mut model, JointKind::Rigid, clamp, &root, &Vector3::x());
    if geared {
        model.prescribe(rotation1(first), &steady(rate)).unwrap();
        let terms = [(rotation1(first), 2.0), (rotation1(hub), -1.0)];
        model.add_relation(&terms, None).unwrap();
    } else {
        model
            .prescribe(rotation1(hub), &steady(2.0 * rate))
            .unwrap();
        let still = Signal::constant(0.0).unwrap();
        model.prescribe(rotation1(first), &still).unwrap();
    }
    gravity(&mut model, [0.0, -3.0, 0.0]);
    (model, beam.last_node)
}

#[test]
fn what_is_geared_to_a_drive_starts_in_steady_rotation() {
    let (rate, period) = (5.0, TAU / 5.0);
    let times = times(period, 11);
    let [driven, geared] = [false, true].map(|geared| {
        let (model, tip) = blade(rate, geared);
        let system = System::new(&model, period).unwrap();
        let driven = system.driven().unwrap().unwrap();
        assert!(driven.is_rigid());
        // About an axis at x = 3: the origin moves along −y.
        let twist = [0.0, -3.0, 0.0, 0.0, 0.0, 1.0].map(|x| 2.0 * rate * x);
        let error = (driven.twist(tip) - Vector6::from(twist)).amax();
        assert!(error < 1e-13, "{error:e}");
        let solution = solve(&model, period, 29);
        solution.node(tip, NodeQuantity::Position, &times).unwrap()
    });
    let bend = largest(driven.iter().map(|x| x.abs()));
    // The tolerance of Newton's method, squared, and rounding of stiff beams.
    let error = largest_difference(&driven, &geared) / bend;
    assert!(error < 1e-9, "{error:e}");
}

#[test]
fn turns_that_are_not_whole_are_refused_with_a_period_that_is_right() {
    let (rate, period) = (1.3, TAU / 1.3);
    let (model, joints) = driven(2.0 / 3.0, rate);
    let error = try_solve(&model, period, 11).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic);
    let message = error.to_string();
    let expected = "gains 0.666666667 turns in a period, not a whole number; a period 3 times";
    assert!(message.contains(expected), "{message}");
    assert!(
        message.contains(&format!("rotation 1 of joint {}", joints[1])),
        "{message}"
    );
    // That period is right, and the drive makes three turns in it.
    let solution = solve(&model, 3.0 * period, 21);
    let angle = solution.joint(joints[1], ANGLE, &[3.0 * period]).unwrap()[0];
    assert!((angle - 2.0 * TAU).abs() < 1e-10);

    // Two drives that contradict each other.
    let (mut model, joints) = driven(2.0, rate);
    model
        .prescribe(rotation1(joints[1]), &steady(rate))
        .unwrap();
    let error = try_solve(&model, period, 11).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic);
    let message = error.to_string();
    assert!(message.contains("relation 0: the turns"), "{message}");
    assert!(
        message.contains("add up to 1.000000000, not to zero"),
        "{message}"
    );
}

#[test]
fn a_differential_shares_the_moment_of_its_carrier() {
    let mut model = Model::new();
    let (inertia, damping, stiffness) = (0.3, 0.2, 0.8);
    let (rate, moment) = (2.0, 1.1);
    let carrier = wheel(&mut model, 0.0, 0.1);
    let sides = [1.0, 2.0].map(|x| wheel(&mut model, x, inertia));
    // What couples both sides, without constraints, about z.
    let frame = |x: f64| Model::frame_at("axis", &(Vector3::x() * x), &Vector3::z()).unwrap();
    let between = model.add_joint(JointKind::Free, Some(1), Some(2), &frame(1.0), &frame(2.0));
    let between = JointCoordinate {
        joint: between.unwrap(),
        coordinate: Coordinate::Rotation3,
    };
    spring(&mut model, between, stiffness, 0.0);
    for side in sides {
        spring(&mut model, rotation1(side), 0.0, damping);
    }
    model.prescribe(rotation1(carrier), &steady(rate)).unwrap();
    let at = rotation1(sides[0]);
    model.add_actuator(at, &cosine(moment)).unwrap();
    let terms = [(sides[0], 1.0), (sides[1], 1.0), (carrier, -2.0)];
    let terms = terms.map(|(joint, a)| (rotation1(joint), a));
    model.add_relation(&terms, None).unwrap();
    let period = TAU / rate;
    let solution = solve(&model, period, 31);
    let times = times(period, 30);
    // Sides turn by c ± x with 2 J x″ + 2 d x′ + 4 k x = M cos ωt.
    let stiffness = Complex::new(
        4.0 * stiffness - 2.0 * inertia * rate * rate,
        2.0 * damping * rate,
    );
    let x = |t: f64| (Complex::new(0.0, rate * t).exp() * moment / stiffness).re;
    for (side, sign) in sides.into_iter().zip([1.0, -1.0]) {
        let found = solution.joint(side, ANGLE, &times).unwrap();
        assert_all_near(&found, |t| rate * t + sign * x(t), &times, 1e-10);
    }
    let drive = solution.joint(carrier, DRIVE, &times).unwrap();
    let exact = |t: f64| 2.0 * damping * rate - moment * (rate * t).cos();
    assert_all_near(&drive, exact, &times, 1e-9);
}

#[test]
fn a_rack_moves_with_its_pinion_and_a_signal_shifts_them() {
    let (mut model, slide) = mass_on_a_slide(2.0, &Vector3::x());
    let pinion = wheel(&mut model, 1.0, 0.3);
    let radius = 0.7;
    spring(&mut model, slide, 20.0, 0.0);
    model.add_actuator(slide, &cosine(5.0)).unwrap();
    // x − r θ = 0.1 sin ωt: a backlash that is forced.
    let terms = [(slide, 1.0), (rotation1(pinion), -radius)];
    let shift = Signal::harmonics(0.0, 0.0, &[0.0], &[0.1]).unwrap();
    let relation = model.add_relation(&terms, Some(&shift)).unwrap();
    let omega: f64 = 1.9;
    let period = TAU / omega;
    let solution = solve(&model, period, 25);
    // With θ = (x − s) / r: (m + J / r²) x″ + k x = F cos ωt + J / r² s″.
    let added = 0.3 / (radius * radius);
    let stiffness = 20.0 - (2.0 + added) * omega * omega;
    let [c, s] = [5.0 / stiffness, -added * omega * omega * 0.1 / stiffness];
    let times = times(period, 30);
    let found = solution
        .joint(
            slide.joint,
            JointQuantity::Coordinate(slide.coordinate),
            &times,
        )
        .unwrap();
    let x = |t: f64| c * (omega * t).cos() + s * (omega * t).sin();
    assert_all_near(&found, x, &times, 1e-11);
    let theta = |t: f64| (x(t) - 0.1 * (omega * t).sin()) / radius;
    let found = solution.joint(pinion, ANGLE, &times).unwrap();
    assert_all_near(&found, theta, &times, 1e-11);
    let found = solution.sample(effort(relation, 1), &times).unwrap();
    assert_all_near(&found, |t| -0.3 * omega * omega * theta(t), &times, 1e-10);
    // The shift grows with a parameter.
    let amplitude = Target::Signal(SignalPlace::Relation(relation), SignalPart::Amplitude);
    let parameter = model.add_parameter("shift", 0.0, 1.0).unwrap();
    model.move_by_parameter(parameter, amplitude, 1.0).unwrap();
    let solution = solve(&model, period, 25);
    let none = solution.joint(pinion, ANGLE, &times).unwrap();
    let straight = 5.0 / stiffness / radius;
    assert_all_near(&none, |t| straight * (omega * t).cos(), &times, 1e-11);
}

#[test]
fn relations_that_depend_on_each_other_are_named() {
    let (mut model, joints) = geared();
    let terms = [(rotation1(joints[0]), RATIO), (rotation1(joints[1]), -1.0)];
    model.add_relation(&terms, None).unwrap();
    let summary = Summary::of(&model).unwrap();
    assert_eq!(summary.redundant, 1);
    assert_eq!(summary.mobility, 1);
    let text = summary.to_string();
    let expected = "1 redundant constraint among relations 0, 1";
    assert!(text.contains(expected), "{text}");
    // They share what they have to exert.
    let moment = model.add_actuator(rotation1(joints[0]), &cosine(1.0));
    moment.unwrap();
    let omega = 1.0;
    let solution = solve(&model, TAU / omega, 21);
    let amplitude = 1.0 / (STIFFNESS - joined_inertia());
    let on_second = [0, 1].map(|relation| {
        let found = solution.sample(effort(relation, 1), &[0.0]);
        found.unwrap()[0]
    });
    let exact = -INERTIAS[1] * RATIO * amplitude;
    assert!((on_second[0] + on_second[1] - exact).abs() < 1e-9);
    assert!((on_second[0] - on_second[1]).abs() < 1e-9, "{on_second:?}");
    // One that cannot hold as well.
    model.prescribe(rotation1(joints[0]), &cosine(0.2)).unwrap();
    model.prescribe(rotation1(joints[1]), &cosine(0.2)).unwrap();
    let solution = try_solve(&model, TAU / omega, 21).unwrap();
    assert_ne!(solution.outcome(), Outcome::Converged);
    let report = solution.report();
    assert!(report.contains("relations 0, 1"), "{report}");
}

#[test]
fn a_relation_survives_a_file_and_wrong_ones_are_refused() {
    let (mut model, joints) = geared();
    let path = std::env::temp_dir().join(format!("relation_{}.pdm", std::process::id()));
    model.save(&path).unwrap();
    let loaded = Model::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert_eq!(loaded.relation_count(), 1);
    let kept = loaded.relation(0).unwrap();
    assert_eq!(kept.terms, model.relation(0).unwrap().terms);
    assert!(loaded.relation(1).is_err());

    let slide = JointCoordinate {
        joint: joints[0],
        coordinate: Coordinate::Displacement1,
    };
    let [a, b] = joints.map(rotation1);
    let missing = rotation1(7);
    type Terms = [(JointCoordinate, f64)];
    let wrong: [(&Terms, ErrorKind, &str); 7] = [
        (&[], ErrorKind::Size, "at least 2 coordinates, got 0"),
        (
            &[(a, 1.0)],
            ErrorKind::Size,
            "at least 2 coordinates, got 1",
        ),
        (&[(a, 1.0), (a, 2.0)], ErrorKind::Value, "each at most once"),
        (&[(a, 1.0), (b, 0.0)], ErrorKind::Value, "coefficients[1]"),
        (
            &[(a, 1.0), (b, f64::NAN)],
            ErrorKind::NotFinite,
            "coefficients[1]",
        ),
        (&[(a, 1.0), (slide, 1.0)], ErrorKind::NotAvailable, "term 1"),
        (&[(missing, 1.0), (b, 1.0)], ErrorKind::Identifier, "term 0"),
    ];
    for (terms, kind, what) in wrong {
        let error = model.add_relation(terms, None).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.to_string().contains(what), "{error}");
    }
    let apart = [(a, 1e-300), (b, 1e300)];
    assert!(model.add_relation(&apart, None).is_err());
    assert_eq!(model.relation_count(), 1);
}
