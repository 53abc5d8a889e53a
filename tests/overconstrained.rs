//! Mechanisms with redundant constraints: tolerated, with multipliers of least norm, or named as
//! locked.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::JointKind;
use periodyn::model::{Model, Signal};
use periodyn::output::{JointQuantity, NodeQuantity, ResolvedIn, Solution};
use periodyn::solve::{Outcome, PeriodicOptions};

/// A rigid bar between two points: its node is at the centre.
fn bar(model: &mut Model, start: &Vector3<f64>, end: &Vector3<f64>) -> usize {
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.1, 0.12, 0.15));
    model
        .add_rigid_body(1.0, &(0.5 * (start + end)), &inertia)
        .unwrap()
}

fn reaction(solution: &Solution, joint: usize, time: f64) -> Vec<f64> {
    let quantity = JointQuantity::Reaction(ResolvedIn::Space);
    solution.joint(joint, quantity, &[time]).unwrap()
}

/// A planar four-bar with its first crank driven: all joints revolute, which is three constraints
/// too many, or with a universal and a spherical joint instead.
fn four_bar(redundant: bool, cycles: f64) -> Model {
    let [a, b, c, d] =
        [(0.0, 0.0), (0.2, 1.0), (2.2, 1.4), (2.0, 0.0)].map(|(x, y)| Vector3::new(x, y, 0.0));
    let mut model = Model::new();
    let bars = [(a, b), (b, c), (c, d)].map(|(p, q)| Some(bar(&mut model, &p, &q)));
    let z = Vector3::z();
    revolute(&mut model, None, bars[0], &a, &z);
    if redundant {
        revolute(&mut model, bars[0], bars[1], &b, &z);
        revolute(&mut model, bars[1], bars[2], &c, &z);
    } else {
        let cross = Model::cross_frame(&b, &z, &Vector3::y()).unwrap();
        let frame = Model::frame_at("axis", &c, &z).unwrap();
        let (universal, spherical) = (JointKind::Universal, JointKind::Spherical);
        model
            .add_joint(universal, bars[0], bars[1], &cross, &cross)
            .unwrap();
        model
            .add_joint(spherical, bars[1], bars[2], &frame, &frame)
            .unwrap();
    }
    revolute(&mut model, bars[2], None, &d, &z);
    let drive = Signal::harmonics(0.1, 0.0, &[0.2 * cycles], &[0.3]).unwrap();
    model.prescribe(rotation1(0), &drive).unwrap();
    gravity(&mut model, [0.0, -9.81, 0.0]);
    model
}

#[test]
fn a_planar_four_bar_of_revolutes_has_the_reactions_of_one_without_redundancy() {
    for points in [1, 31] {
        let period = 2.0;
        let redundant = solve(&four_bar(true, 1.0), period, points);
        let exact = solve(&four_bar(false, 1.0), period, points);
        let report = &redundant.details().report;
        println!("{}", redundant.report());
        assert!(
            redundant
                .report()
                .contains("3 redundant constraints among joints 0, 1, 2, 3:"),
        );
        // Newton is quadratic but for the compliance of the constraints.
        let last = report.iterations.last().unwrap();
        assert!(last.increment < 1e-9 && report.iterations.len() <= 6);
        for time in [0.0, 0.37, 1.2] {
            for node in 0..3 {
                let at = |s: &Solution| s.node(node, NodeQuantity::Position, &[time]).unwrap();
                for (x, y) in at(&redundant).iter().zip(at(&exact)) {
                    assert!((x - y).abs() < 1e-12, "{x} {y}");
                }
            }
            // In the plane there is no redundancy; out of it nothing acts, so that the least norm
            // is zero.
            for joint in 0..4 {
                let (found, exact) = (
                    reaction(&redundant, joint, time),
                    reaction(&exact, joint, time),
                );
                for k in [0, 1] {
                    assert!(
                        (found[k] - exact[k]).abs() < 1e-9 * exact[0].hypot(exact[1]).max(10.0)
                    );
                }
                for k in [2, 3, 4] {
                    assert!(found[k].abs() < 1e-9, "joint {joint}: {found:?}");
                }
            }
            let torque = JointQuantity::DrivingEffort(periodyn::elements::Coordinate::Rotation1);
            let torque = |s: &Solution| s.joint(0, torque, &[time]).unwrap()[0];
            assert!((torque(&redundant) - torque(&exact)).abs() < 1e-9 * torque(&exact).abs());
        }
    }
}

#[test]
fn oversampled_equations_have_the_same_motion_and_reactions() {
    let period = 2.0;
    let exact = solve(&four_bar(false, 1.0), period, 61);
    // Measured, errors of positions and of reactions: 4e-9 and 1.1e-5, 2e-16 and 4e-7.
    for (points, most) in [(15, [2e-8, 5e-5]), (31, [1e-12, 2e-6])] {
        let options = PeriodicOptions {
            oversampling: 2,
            ..options(points)
        };
        let model = four_bar(true, 1.0);
        let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
        let report = &solution.details().report;
        let increments: Vec<f64> = report.iterations.iter().map(|i| i.increment).collect();
        assert_eq!(solution.outcome(), Outcome::Converged, "{report:#?}");
        let mut errors = [0.0f64; 2];
        for time in [0.0, 0.37, 1.2] {
            for node in 0..3 {
                let at = |s: &Solution| s.node(node, NodeQuantity::Position, &[time]).unwrap();
                errors[0] = errors[0].max(largest_difference(&at(&solution), &at(&exact)));
            }
            for joint in 0..4 {
                let at = |s: &Solution| reaction(s, joint, time);
                errors[1] = errors[1].max(largest_difference(&at(&solution), &at(&exact)));
            }
        }
        println!("{points} points: {errors:?}, increments {increments:?}");
        assert!(errors[0] < most[0] && errors[1] < most[1], "{errors:?}");
    }
}

#[test]
fn two_hinges_of_a_door_share_its_weight_by_least_norm() {
    let mut model = Model::new();
    let (distance, width, weight) = (1.6, 0.4, 9.81);
    let centre = Vector3::new(width, 0.0, 0.0);
    let door = model
        .add_rigid_body(1.0, &centre, &Matrix3::identity())
        .unwrap();
    // A second node far away sets a characteristic length.
    let far = model
        .add_rigid_body(1.0, &Vector3::new(width, 0.0, 2.0), &Matrix3::identity())
        .unwrap();
    let up = Vector3::z();
    let low = Vector3::new(0.0, 0.0, -0.5 * distance);
    revolute(&mut model, None, Some(door), &low, &up);
    revolute(&mut model, None, Some(door), &-low, &up);
    let frame = Model::frame_at("axis", &Vector3::x(), &up).unwrap();
    model
        .add_joint(JointKind::Rigid, None, Some(far), &frame, &frame)
        .unwrap();
    let swing = Signal::constant(0.0).unwrap();
    model.prescribe(rotation1(0), &swing).unwrap();
    gravity(&mut model, [0.0, 0.0, -weight]);
    let solution = solve(&model, 1.0, 1);
    assert!(
        solution
            .report()
            .contains("5 redundant constraints among joints 0, 1:")
    );
    // Weight W at x = w: each hinge bears W/2, and the moment W w about y is borne by a couple F
    // over the distance d and by moments m at each hinge: F d + 2 m = W w, with 2 F² + 2 m²/L²
    // least.
    let length = solution.details().system.scales().length;
    let multiplier = weight * width / (0.25 * distance * distance + length * length);
    let (force, moment) = (
        0.25 * multiplier * distance,
        0.5 * multiplier * length * length,
    );
    for (joint, sign) in [(0, 1.0), (1, -1.0)] {
        let found = reaction(&solution, joint, 0.0);
        let exact = [sign * force, 0.0, 0.5 * weight, 0.0, -moment, 0.0];
        println!("{found:?} {exact:?}");
        for (x, y) in found.iter().zip(exact) {
            assert!((x - y).abs() < 1e-10 * weight, "{found:?} {exact:?}");
        }
    }
}

#[test]
fn loops_that_cannot_move_as_prescribed_are_locked() {
    // Revolutes whose axes are not parallel: a structure, not a mechanism.
    let [a, b, c, d] =
        [(0.0, 0.0), (0.2, 1.0), (2.2, 1.4), (2.0, 0.0)].map(|(x, y)| Vector3::new(x, y, 0.0));
    let build = |drive: &Signal| {
        let mut model = Model::new();
        let bars = [(a, b), (b, c), (c, d)].map(|(p, q)| Some(bar(&mut model, &p, &q)));
        let z = Vector3::z();
        revolute(&mut model, None, bars[0], &a, &z);
        revolute(&mut model, bars[0], bars[1], &b, &z);
        revolute(
            &mut model,
            bars[1],
            bars[2],
            &c,
            &Vector3::new(0.3, 0.1, 1.0),
        );
        revolute(&mut model, bars[2], None, &d, &z);
        model.prescribe(rotation1(0), drive).unwrap();
        model
    };
    let solution = try_solve(&build(&cosine(0.2)), 1.0, 5).unwrap();
    let report = &solution.details().report;
    println!("{}", report.explanation);
    assert_eq!(report.outcome, Outcome::Inconsistent);
    for name in ["locked", "prescribed coordinate 0", "joints 0, 1, 2, 3"] {
        assert!(report.explanation.contains(name), "{}", report.explanation);
    }
    // Held where it is, it is a structure that stands.
    solve(&build(&Signal::constant(0.0).unwrap()), 1.0, 5);
}

#[test]
fn redundant_constraints_that_do_not_close_are_inconsistent() {
    // The axis of the last hinge is 1 mm off.
    let [a, b, c, d] =
        [(0.0, 0.0), (0.2, 1.0), (2.2, 1.4), (2.0, 0.0)].map(|(x, y)| Vector3::new(x, y, 0.0));
    let mut model = Model::new();
    let bars = [(a, b), (b, c), (c, d)].map(|(p, q)| Some(bar(&mut model, &p, &q)));
    let z = Vector3::z();
    revolute(&mut model, None, bars[0], &a, &z);
    revolute(&mut model, bars[0], bars[1], &b, &z);
    revolute(&mut model, bars[1], bars[2], &c, &z);
    let at = |point: Vector3<f64>| Model::frame_at("axis", &point, &z).unwrap();
    model
        .add_joint(
            JointKind::Revolute,
            bars[2],
            None,
            &at(d),
            &at(d + 1e-3 * z),
        )
        .unwrap();
    gravity(&mut model, [0.0, -9.81, 0.0]);
    model.prescribe(rotation1(0), &cosine(0.2)).unwrap();
    let solution = try_solve(&model, 1.0, 5).unwrap();
    let report = &solution.details().report;
    println!("{}", report.explanation);
    assert_eq!(report.outcome, Outcome::Inconsistent);
    for name in ["contradict", "joints 0, 1, 2, 3", "stays open"] {
        assert!(report.explanation.contains(name), "{}", report.explanation);
    }
}
