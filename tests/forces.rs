//! Forces on joint coordinates and nodes: closed forms, independent integrations, and forces of the
//! user.

mod common;
#[path = "common/shooting.rs"]
mod shooting;

use common::*;
use nalgebra::{DVector, Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::*;
use periodyn::error::{Error, ErrorKind};
use periodyn::model::{Model, Signal, SpringDefinition};
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{ForceQuantity, JointQuantity, NodeQuantity, Solution};
use periodyn::solve::StaticOptions;
use periodyn::system::check_tangents;
use shooting::shoot;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const ANGLE: JointQuantity = JointQuantity::Coordinate(Coordinate::Rotation1);
const RATE: JointQuantity = JointQuantity::Rate(Coordinate::Rotation1);
const DRIVE: JointQuantity = JointQuantity::DrivingEffort(Coordinate::Rotation1);

const OMEGA: f64 = 2.2;
const PERIOD: f64 = TAU / OMEGA;

fn assert_near(found: &[f64], exact: &[f64], tolerance: f64, what: &str) {
    let error = largest_difference(found, exact) / largest(exact.iter().copied());
    println!("{what}: relative error {error:.1e}");
    assert!(error < tolerance, "{what}: {error:e}");
}

fn spring(stiffness: f64, damping: f64) -> SpringDefinition {
    SpringDefinition {
        at: rotation1(0),
        stiffness,
        damping,
        rest: 0.0,
    }
}

fn law(
    gives_derivatives: bool,
    function: impl Fn(&CoordinateState) -> Effort + Send + Sync + 'static,
) -> CoordinateLaw {
    CoordinateLaw {
        function: Arc::new(move |at| Ok(function(at))),
        gives_derivatives,
    }
}

/// Checks the arm's angle, and the effort of force 0, against `I θ̈ = M cos Ωt − effort(θ, θ̇)`
/// integrated.
fn check_arm(
    model: &mut Model,
    moment: f64,
    points: usize,
    tolerance: f64,
    effort: impl Fn(f64, f64) -> f64,
) -> Solution {
    let motor = model.add_actuator(rotation1(0), &cosine(moment)).unwrap();
    let solution = solve(model, PERIOD, points);
    let joint = |quantity, times: &[f64]| solution.joint(0, quantity, times).unwrap();
    let f = |t: f64, x: &DVector<f64>| {
        let torque = moment * (OMEGA * t).cos() - effort(x[0], x[1]);
        DVector::from_column_slice(&[x[1], torque / INERTIA])
    };
    let start = [joint(ANGLE, &[0.0])[0], joint(RATE, &[0.0])[0]];
    // Of fourth order: the error is below 1e-12.
    let states = shoot(&f, PERIOD, 8000, &start);
    let times = times(PERIOD, 41);
    let each = |value: &dyn Fn(&DVector<f64>) -> f64| -> Vec<f64> {
        states.iter().step_by(200).map(value).collect()
    };
    let angle = joint(ANGLE, &times);
    assert!(largest(angle.iter().copied()) > 0.5, "a large motion");
    assert_near(&angle, &each(&|x| x[0]), tolerance, "angle");
    assert_near(
        &joint(RATE, &times),
        &each(&|x| x[1]),
        10.0 * tolerance,
        "rate",
    );
    let found = solution.force(0, ForceQuantity::Effort, &times).unwrap();
    let exact = each(&|x| effort(x[0], x[1]));
    assert_near(&found, &exact, 10.0 * tolerance, "effort");
    let drive = solution
        .force(motor, ForceQuantity::Effort, &times)
        .unwrap();
    let exact: Vec<f64> = times.iter().map(|t| moment * (OMEGA * t).cos()).collect();
    assert_near(&drive, &exact, 1e-13, "actuator");
    solution
}

#[test]
fn an_actuator_is_a_moment_between_the_bodies_of_its_joint() {
    let (mut model, _) = arm();
    model.add_spring_damper(spring(5.0, 0.8)).unwrap();
    let solution = check_arm(&mut model, 2.0, 41, 1e-10, |q, v| 5.0 * q + 0.8 * v);
    // The response is known: the amplitude of I θ̈ + c θ̇ + k θ = M cos Ωt.
    let amplitude = 2.0 / (5.0 - INERTIA * OMEGA * OMEGA).hypot(0.8 * OMEGA);
    let angle = solution.joint(0, ANGLE, &times(PERIOD, 2001)).unwrap();
    assert!((largest(angle) - amplitude).abs() < 1e-5 * amplitude);
    // A pure moment about the hinge is the same on the node, wherever that is.
    let times = times(PERIOD, 20);
    let on = ForceQuantity::OnNode(0, LoadFrame::Space);
    let wrench = solution.force(1, on, &times).unwrap();
    let exact: Vec<f64> = times.iter().map(|t| 2.0 * (OMEGA * t).cos()).collect();
    assert_near(&column(&wrench, 6, 5), &exact, 1e-12, "moment on the node");
    for i in 0..5 {
        assert!(largest(column(&wrench, 6, i)) < 1e-12);
    }
}

#[test]
fn a_cubic_spring_with_quadratic_damping_is_duffings_oscillator() {
    let (mut model, _) = arm();
    let (stiffness, damping) = ([1.0, 0.0, 4.0], [0.6, 0.0, 0.3]);
    model
        .add_polynomial_spring_damper(rotation1(0), &stiffness, &damping, 0.1)
        .unwrap();
    check_arm(&mut model, 3.0, 61, 1e-9, |q, v| {
        let u = q - 0.1;
        u + 4.0 * u * u * u + 0.6 * v + 0.3 * v * v * v
    });
}

/// Quadratic drag, smooth at rest: `c q̇ √(q̇² + v²)`, and its derivative.
fn drag(rate: f64) -> (f64, f64) {
    let (c, v) = (0.5, 1.0);
    let root = rate.hypot(v);
    (c * rate * root, c * (root + rate * rate / root))
}

#[test]
fn a_users_drag_is_what_its_equation_integrated_gives_with_and_without_derivatives() {
    let mut steps = Vec::new();
    for gives_derivatives in [true, false] {
        let (mut model, _) = arm();
        let law = law(gives_derivatives, |at| {
            let (value, by_rate) = drag(at.rate);
            Effort {
                value: value + 3.0 * at.value,
                by_coordinate: 3.0,
                by_rate,
            }
        });
        model.add_coordinate_law(rotation1(0), law).unwrap();
        let solution = check_arm(&mut model, 3.0, 121, 1e-9, |q, v| 3.0 * q + drag(v).0);
        let iterations = &solution.details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("increments, derivatives {gives_derivatives}: {increments:?}");
        steps.push(increments.len());
    }
    assert_eq!(steps[0], steps[1], "differences cost no iteration");
}

#[test]
fn a_law_may_depend_on_time_and_on_an_angle_that_turns_if_it_repeats() {
    // Driven round, with a torque that depends on the angle by twenty teeth, and on time.
    let torque = |time: f64, q: f64| 2.0 * (20.0 * q).sin() * (OMEGA * time).cos();
    let turning = |law: CoordinateLaw| {
        let (mut model, _) = arm();
        let turn = Signal::harmonics(0.2, OMEGA, &[], &[]).unwrap();
        model.prescribe(rotation1(0), &turn).unwrap();
        model.add_coordinate_law(rotation1(0), law).unwrap();
        try_solve(&model, PERIOD, 61)
    };
    let teeth = law(false, move |at| Effort {
        value: torque(at.time, at.value),
        ..Effort::default()
    });
    let solution = turning(teeth).unwrap();
    let times = times(PERIOD, 100);
    let exact: Vec<f64> = times.iter().map(|&t| torque(t, 0.2 + OMEGA * t)).collect();
    let drive = solution.joint(0, DRIVE, &times).unwrap();
    assert_near(&drive, &exact, 1e-11, "drive");

    let winding = law(false, |at| Effort {
        value: at.value,
        ..Effort::default()
    });
    let error = turning(winding).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic);
    assert!(error.to_string().contains("force 0 on joint 0"), "{error}");
}

#[test]
fn failing_laws_end_the_solve_with_what_they_say() {
    let fails = |law: CoordinateLaw, expected: &[&str]| {
        let (mut model, _) = arm();
        model.add_coordinate_law(rotation1(0), law).unwrap();
        model.add_actuator(rotation1(0), &cosine(3.0)).unwrap();
        let error = try_solve(&model, PERIOD, 21).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Callback);
        for text in expected {
            assert!(error.to_string().contains(text), "{error}");
        }
    };
    let stiff = |at: &CoordinateState| Effort {
        value: if at.value > 0.3 {
            f64::NAN
        } else {
            5.0 * at.value
        },
        by_coordinate: 5.0,
        by_rate: 0.0,
    };
    fails(
        law(true, stiff),
        &["force 0", "finite effort at t = ", "got NaN"],
    );
    let slope = |at: &CoordinateState| Effort {
        value: 5.0 * at.value,
        by_coordinate: f64::INFINITY,
        by_rate: 0.0,
    };
    fails(
        law(true, slope),
        &["force 0", "derivative by the coordinate", "got inf"],
    );
    let said = CoordinateLaw {
        function: Arc::new(|_| Err(Error::new(ErrorKind::Callback, "the table ends"))),
        gives_derivatives: false,
    };
    fails(said, &["force 0", "the table ends"]);
}

/// Refused as random or not periodic, with messages that contain `expected`.
fn assert_refused(model: &Model, period: f64, expected: &[&str]) {
    let error = try_solve(model, period, 21).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic, "{error}");
    for text in expected {
        assert!(error.to_string().contains(text), "{error}");
    }
}

#[test]
fn laws_and_forces_that_are_random_or_not_periodic_are_refused_by_name() {
    let with_law = |function: fn(&CoordinateState, usize) -> f64| {
        let (mut model, _) = arm();
        model.add_spring_damper(spring(5.0, 0.4)).unwrap();
        let calls = AtomicUsize::new(0);
        let counted = law(false, move |at| Effort {
            value: function(at, calls.fetch_add(1, Ordering::Relaxed)),
            ..Effort::default()
        });
        model.add_coordinate_law(rotation1(0), counted).unwrap();
        model
    };
    let with_force = |function: fn(f64, usize) -> f64| {
        let (mut model, _) = arm();
        model.add_spring_damper(spring(5.0, 0.4)).unwrap();
        let calls = AtomicUsize::new(0);
        let law = NodeForceLaw {
            function: Arc::new(move |state, out| {
                let call = calls.fetch_add(1, Ordering::Relaxed);
                out.forces[0][5] = function(state.time, call);
                Ok(())
            }),
            gives_tangents: false,
            frame: LoadFrame::Space,
        };
        model.add_node_forces(&[0], law).unwrap();
        model
    };
    // As a generator of random numbers has it: another one in each call.
    let random = ["force 1", "different values at the same time and motion"];
    assert_refused(
        &with_law(|at, call| at.value * (call as f64).sin()),
        PERIOD,
        &random,
    );
    assert_refused(&with_force(|_, call| (call as f64).sin()), PERIOD, &random);
    let error = Solution::solve_static(
        &with_force(|_, call| (call as f64).sin()),
        &StaticOptions::default(),
        &mut |_, _| true,
    )
    .unwrap_err();
    assert!(error.to_string().contains(random[1]), "{error}");

    let other = ["force 1", "does not repeat with the period"];
    assert_refused(
        &with_law(|at, _| (OMEGA * at.time).cos()),
        0.9 * PERIOD,
        &other,
    );
    assert_refused(
        &with_force(|time, _| (OMEGA * time).cos()),
        0.9 * PERIOD,
        &other,
    );
    assert_refused(&with_force(|time, _| time), PERIOD, &other);

    // What repeats is solved for; so it is with a period of six digits, and with a function that
    // is written for one period alone.
    try_solve(&with_law(|at, _| (OMEGA * at.time).cos()), PERIOD, 21).unwrap();
    try_solve(
        &with_force(|time, _| (2.0 * OMEGA * time).cos()),
        PERIOD,
        21,
    )
    .unwrap();
    let six_digits = (PERIOD * 1e6).round() * 1e-6;
    let slow = with_force(|time, _| (OMEGA * time).cos());
    try_solve(&slow, six_digits, 21).unwrap();
    let hat = with_force(|time, _| (1.0 - (2.0 * time / PERIOD - 1.0).abs()).max(0.0));
    try_solve(&hat, PERIOD, 21).unwrap();
}

/// A torsional spring and damper on the arm: `−k θ − c ω` about z, from rotation matrix and
/// velocity.
fn torsion(frame: LoadFrame, gives_tangents: bool) -> NodeForceLaw {
    let (k, c) = (5.0, 0.8);
    NodeForceLaw {
        function: Arc::new(move |state, out| {
            let r = &state.rotations[0];
            let angle = r[(1, 0)].atan2(r[(0, 0)]);
            // About z the velocity's third component is the same along the axes of space and body.
            out.forces[0][5] = -k * angle - c * state.velocities[0][5];
            if let Some((by_motion, by_velocity)) = &mut out.tangents {
                // Of the angle by turns about the axes of space, or of the body.
                let (x, y) = (r[(0, 0)], r[(1, 0)]);
                let square = x * x + y * y;
                let slope = |dx: f64, dy: f64| (dy * x - dx * y) / square;
                for i in 0..3 {
                    let mut axis = Vector3::zeros();
                    axis[i] = 1.0;
                    if frame == LoadFrame::Follower {
                        axis = r * axis;
                    }
                    let change = axis.cross(&r.column(0));
                    by_motion[(5, 3 + i)] = -k * slope(change.x, change.y);
                }
                by_velocity[(5, 5)] = -c;
            }
            Ok(())
        }),
        gives_tangents,
        frame,
    }
}

#[test]
fn a_users_torsion_spring_is_the_linear_oscillator_in_every_frame_and_way() {
    let amplitude = 2.0 / (5.0 - INERTIA * OMEGA * OMEGA).hypot(0.8 * OMEGA);
    let phase = (0.8 * OMEGA).atan2(5.0 - INERTIA * OMEGA * OMEGA);
    let times = times(PERIOD, 40);
    let exact: Vec<f64> = times
        .iter()
        .map(|t| amplitude * (OMEGA * t - phase).cos())
        .collect();
    assert!(amplitude > 0.9, "a large motion");
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        for gives_tangents in [true, false] {
            let (mut model, _) = arm();
            let force = model
                .add_node_forces(&[0], torsion(frame, gives_tangents))
                .unwrap();
            model.add_actuator(rotation1(0), &cosine(2.0)).unwrap();
            if gives_tangents {
                let check = check_tangents(&model, force, PERIOD).unwrap();
                println!("{frame:?}: tangents {check:?}");
                assert!(check.error < 1e-8, "{check:?}");
            }
            let solution = solve(&model, PERIOD, 41);
            let angle = solution.joint(0, ANGLE, &times).unwrap();
            assert_near(&angle, &exact, 1e-10, "angle");
            let on = ForceQuantity::OnNode(0, frame);
            let moment = column(&solution.force(force, on, &times).unwrap(), 6, 5);
            let rate = solution.joint(0, RATE, &times).unwrap();
            let expected: Vec<f64> = angle
                .iter()
                .zip(&rate)
                .map(|(q, v)| -5.0 * q - 0.8 * v)
                .collect();
            assert_near(&moment, &expected, 1e-11, "moment");
        }
    }
}

/// Two bodies, on a ball and a universal joint, swing in a user's field: drag on each, and an
/// attraction between them that goes with the inverse of a distance.
fn field(frame: LoadFrame, gives_tangents: bool) -> NodeForceLaw {
    let turned = move |r: &Matrix3<f64>, v: Vector3<f64>| match frame {
        LoadFrame::Space => v,
        LoadFrame::Follower => r.transpose() * v,
    };
    NodeForceLaw {
        function: Arc::new(move |state, out| {
            let d = state.positions[1] - state.positions[0];
            let square = d.norm_squared() + 0.5;
            for (i, sign) in [(0, 1.0), (1, -1.0)] {
                let v = state.velocities[i].fixed_rows::<3>(0).into_owned();
                let pull = turned(&state.rotations[i], d * (sign * 3.0 / square));
                let force = pull - v * (0.6 * (v.norm_squared() + 0.1).sqrt());
                out.forces[i].fixed_rows_mut::<3>(0).copy_from(&force);
                let spin = state.velocities[i].fixed_rows::<3>(3) * -0.1;
                out.forces[i].fixed_rows_mut::<3>(3).copy_from(&spin);
            }
            let Some((by_motion, by_velocity)) = &mut out.tangents else {
                return Ok(());
            };
            for (i, sign) in [(0, 1.0), (1, -1.0)] {
                let v = state.velocities[i].fixed_rows::<3>(0).into_owned();
                let root = (v.norm_squared() + 0.1).sqrt();
                let slope = (Matrix3::identity() * root + v * v.transpose() / root) * -0.6;
                by_velocity
                    .fixed_view_mut::<3, 3>(6 * i, 6 * i)
                    .copy_from(&slope);
                let slope = Matrix3::identity() * -0.1;
                by_velocity
                    .fixed_view_mut::<3, 3>(6 * i + 3, 6 * i + 3)
                    .copy_from(&slope);
                let by_d = (Matrix3::identity() - d * d.transpose() * (2.0 / square))
                    * (sign * 3.0 / square);
                let r = &state.rotations[i];
                for (j, sign) in [(0, -1.0), (1, 1.0)] {
                    let block = match frame {
                        LoadFrame::Space => by_d * sign,
                        LoadFrame::Follower => r.transpose() * by_d * state.rotations[j] * sign,
                    };
                    by_motion
                        .fixed_view_mut::<3, 3>(6 * i, 6 * j)
                        .copy_from(&block);
                }
                if frame == LoadFrame::Follower {
                    // The axes that the pull is resolved in turn with the body.
                    let pull = turned(r, d * (sign * 3.0 / square));
                    by_motion
                        .fixed_view_mut::<3, 3>(6 * i, 6 * i + 3)
                        .copy_from(&pull.cross_matrix());
                }
            }
            Ok(())
        }),
        gives_tangents,
        frame,
    }
}

fn two_swinging_bodies(law: NodeForceLaw) -> Model {
    let mut model = Model::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.1, 0.15, 0.2));
    let centres = [Vector3::new(0.0, 0.0, -0.8), Vector3::new(1.0, 0.3, -0.7)];
    for (i, centre) in centres.iter().enumerate() {
        let body = model
            .add_rigid_body(1.0 + 0.5 * i as f64, centre, &inertia)
            .unwrap();
        let at = Motion::new(Matrix3::identity(), Vector3::new(centre.x, centre.y, 0.0));
        model
            .add_joint(JointKind::Spherical, None, Some(body), &at, &at)
            .unwrap();
    }
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let push = [6.0, 4.0, 0.0, 0.0, 0.0, 0.3];
    add_load(&mut model, 0, LoadFrame::Space, &[0.0; 6], &push);
    model.add_node_forces(&[0, 1], law).unwrap();
    model
}

#[test]
fn users_forces_converge_quadratically_to_the_same_motion_in_every_frame_and_way() {
    let times = times(2.0, 30);
    let mut first: Option<Vec<f64>> = None;
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        for gives_tangents in [true, false] {
            let model = two_swinging_bodies(field(frame, gives_tangents));
            if gives_tangents {
                let check = check_tangents(&model, 0, 2.0).unwrap();
                println!("{frame:?}: tangents {:.1e}", check.error);
                assert!(check.error < 1e-8, "{check:?}");
            }
            let solution = solve(&model, 2.0, 41);
            let iterations = &solution.details().report.iterations;
            let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
            println!("{frame:?}, tangents {gives_tangents}: increments {increments:?}");
            // Once below 0.03 each increment is of the order of the square of the one before;
            // differenced tangents leave 1e-9 of it, and rounding what it leaves.
            for pair in increments.windows(2).filter(|pair| pair[0] < 0.03) {
                let left = if gives_tangents { 0.0 } else { 1e-8 * pair[0] };
                assert!(
                    pair[1] < 30.0 * pair[0] * pair[0] + left + 1e-12,
                    "{increments:?}"
                );
            }
            let position = solution.node(1, NodeQuantity::Position, &times).unwrap();
            match &first {
                None => first = Some(position),
                Some(first) => {
                    // Tangents only lead there.
                    let difference = largest_difference(&position, first);
                    println!("difference {difference:.1e}");
                    assert!(difference < 1e-11);
                }
            }
        }
    }
}

#[test]
fn wrong_tangents_are_named() {
    let wrong = |row: usize, column: usize, damped: bool| {
        let right = field(LoadFrame::Space, true);
        let law = NodeForceLaw {
            function: Arc::new(move |state, out| {
                (right.function)(state, out)?;
                if let Some((by_motion, by_velocity)) = &mut out.tangents {
                    let m = if damped { by_velocity } else { by_motion };
                    m[(row, column)] += 2.0;
                }
                Ok(())
            }),
            ..field(LoadFrame::Space, true)
        };
        check_tangents(&two_swinging_bodies(law), 0, 2.0).unwrap()
    };
    let check = wrong(7, 2, false);
    assert!(check.error > 0.1);
    assert_eq!((check.row, check.column), (Some((1, 1)), Some((0, 2))));
    assert_eq!(check.tangent, Tangent::Stiffness);
    assert!((check.given - check.differenced - 2.0).abs() < 1e-6);
    let check = wrong(5, 9, true);
    assert!(check.error > 0.01);
    assert_eq!((check.row, check.column), (Some((0, 5)), Some((1, 3))));
    assert_eq!(check.tangent, Tangent::Damping);

    let (mut model, _) = arm();
    let law_of = |by_rate: f64| {
        law(true, move |at| Effort {
            value: at.value.sin() + at.rate * at.rate,
            by_coordinate: at.value.cos(),
            by_rate: by_rate * at.rate,
        })
    };
    let right = model.add_coordinate_law(rotation1(0), law_of(2.0)).unwrap();
    let wrong = model.add_coordinate_law(rotation1(0), law_of(1.0)).unwrap();
    let linear = model.add_spring_damper(spring(1.0, 1.0)).unwrap();
    let check = check_tangents(&model, right, PERIOD).unwrap();
    assert!(check.error < 1e-8, "{check:?}");
    let check = check_tangents(&model, wrong, PERIOD).unwrap();
    assert!(check.error > 0.1 && check.tangent == Tangent::Damping && check.row.is_none());
    let error = check_tangents(&model, linear, PERIOD).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
}

#[test]
fn a_users_force_that_is_no_number_is_named() {
    let right = field(LoadFrame::Space, false);
    let law = NodeForceLaw {
        function: Arc::new(move |state, out| {
            (right.function)(state, out)?;
            if state.time > 1.0 {
                out.forces[1][4] = f64::NAN;
            }
            Ok(())
        }),
        ..field(LoadFrame::Space, false)
    };
    let error = try_solve(&two_swinging_bodies(law), 2.0, 11).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Callback);
    let message = error.to_string();
    let expected = "force 0: callback: expected a finite moment 2 on node 1 at t = 1.0";
    assert!(message.starts_with(expected), "{message}");
}

/// Full, symmetric and positive definite.
fn coefficients() -> Matrix6<f64> {
    let m = Matrix6::from_fn(|i, j| ((7 * i + 3 * j) as f64 * 0.618).fract() - 0.4);
    m * m.transpose() + Matrix6::identity() * 0.2
}

#[test]
fn a_viscous_damper_resists_a_driven_arm_with_the_matrix_seen_along_its_motion() {
    let matrix = coefficients();
    let place = Motion::new(
        rotation_from_vector(&Vector3::new(0.4, -0.7, 0.3)),
        Vector3::new(0.5, -0.2, 0.9),
    );
    let (mut model, _) = arm();
    model.prescribe(rotation1(0), &cosine(1.2)).unwrap();
    let damper = model
        .add_viscous_damper(None, Some(0), Some(&place), &matrix)
        .unwrap();
    let solution = solve(&model, PERIOD, 61);
    // A unit rate of the angle moves the frame, in its own axes, by a twist that never changes.
    let along = place.rotation.transpose() * Vector3::z().cross(&place.position);
    let about = place.rotation.transpose() * Vector3::z();
    let twist = Vector6::new(along.x, along.y, along.z, about.x, about.y, about.z);
    let resistance = twist.dot(&(matrix * twist));
    let times = times(PERIOD, 40);
    let rate = |t: f64| -1.2 * OMEGA * (OMEGA * t).sin();
    let exact: Vec<f64> = times
        .iter()
        .map(|&t| -INERTIA * 1.2 * OMEGA * OMEGA * (OMEGA * t).cos() + resistance * rate(t))
        .collect();
    let drive = solution.joint(0, DRIVE, &times).unwrap();
    assert_near(&drive, &exact, 1e-11, "drive");
    // What it exerts on the node, moved to its own frame.
    let on = ForceQuantity::OnNode(0, LoadFrame::Follower);
    let wrench = solution.force(damper, on, &times).unwrap();
    let own = matrix * twist;
    let own_force = place.rotation * own.fixed_rows::<3>(0);
    let own_moment = place.rotation * own.fixed_rows::<3>(3)
        + (place.position - Vector3::new(ARM, 0.0, 0.0)).cross(&own_force);
    for i in 0..3 {
        let force: Vec<f64> = times.iter().map(|&t| -own_force[i] * rate(t)).collect();
        let moment: Vec<f64> = times.iter().map(|&t| -own_moment[i] * rate(t)).collect();
        assert_near(&column(&wrench, 6, i), &force, 1e-11, "force");
        assert_near(&column(&wrench, 6, 3 + i), &moment, 1e-11, "moment");
    }
}

#[test]
fn a_viscous_damper_between_moving_bodies_takes_up_what_the_drive_gives() {
    // The arm is driven; a second body on a ball at its tip is damped relative to it.
    let (mut model, _) = arm();
    model.prescribe(rotation1(0), &cosine(0.9)).unwrap();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.1, 0.15, 0.2));
    let centre = Vector3::new(1.5, 0.1, -0.2);
    let body = model.add_rigid_body(0.8, &centre, &inertia).unwrap();
    let tip = Motion::new(Matrix3::identity(), Vector3::new(1.2, 0.0, 0.0));
    model
        .add_joint(JointKind::Spherical, Some(0), Some(body), &tip, &tip)
        .unwrap();
    gravity(&mut model, [9.81, 0.0, 0.0]);
    let damper = model
        .add_viscous_damper(Some(0), Some(body), None, &(coefficients() * 0.3))
        .unwrap();
    let solution = solve(&model, PERIOD, 81);
    // Means over the period, by as many points as the grid resolves.
    let count = 320;
    let times: Vec<f64> = (0..count)
        .map(|i| PERIOD * i as f64 / count as f64)
        .collect();
    let product =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>() / count as f64;
    let rate = solution.joint(0, RATE, &times).unwrap();
    let given = product(&solution.joint(0, DRIVE, &times).unwrap(), &rate);
    let taken: f64 = [0, body]
        .iter()
        .map(|&node| {
            let on = ForceQuantity::OnNode(node, LoadFrame::Space);
            let force = solution.force(damper, on, &times).unwrap();
            let velocity = solution.node(node, NodeQuantity::Velocity, &times).unwrap();
            product(&force, &velocity)
        })
        .sum();
    println!("power given {given}, taken {taken}");
    assert!(given > 0.01);
    assert!((given + taken).abs() < 1e-9 * given);
    // Action and reaction: together they exert no force, and no moment about the origin.
    let at = |node: usize, quantity| solution.node(node, quantity, &times).unwrap();
    let positions = [0, body].map(|n| at(n, NodeQuantity::Position));
    let forces = [0, body].map(|n| {
        let on = ForceQuantity::OnNode(n, LoadFrame::Space);
        solution.force(damper, on, &times).unwrap()
    });
    let vector = |values: &[f64], i: usize| Vector3::new(values[i], values[i + 1], values[i + 2]);
    for i in 0..count {
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (r, f) in positions.iter().zip(&forces) {
            force += vector(f, 6 * i);
            moment += vector(f, 6 * i + 3) + vector(r, 3 * i).cross(&vector(f, 6 * i));
        }
        // Forces are interpolated by themselves: between grid points they balance to the error of
        // that.
        assert!(
            force.norm() < 1e-9 && moment.norm() < 1e-9,
            "{force} {moment}"
        );
    }
}

#[test]
fn what_is_no_damper_or_user_force_is_refused() {
    let (mut model, _) = arm();
    let mut matrix = Matrix6::identity();
    matrix[(0, 0)] = -1.0;
    let error = model
        .add_viscous_damper(None, Some(0), None, &matrix)
        .unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("matrix: expected a positive semi-definite"),
        "{error}"
    );
    matrix[(0, 0)] = 1.0;
    let error = model
        .add_viscous_damper(Some(0), Some(0), None, &matrix)
        .unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("first, second: expected two different"),
        "{error}"
    );
    for nodes in [&[][..], &[0, 0], &[1]] {
        let law = torsion(LoadFrame::Space, false);
        assert!(model.add_node_forces(nodes, law).is_err());
    }
    assert_eq!(model.force_count(), 0);

    // What can be read depends on the kind of force.
    model.prescribe(rotation1(0), &cosine(1.2)).unwrap();
    let damper = model
        .add_viscous_damper(None, Some(0), None, &matrix)
        .unwrap();
    let solution = solve(&model, PERIOD, 9);
    let refused = |force, quantity, kind| {
        let error = solution.force(force, quantity, &[0.0]).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
    };
    refused(damper, ForceQuantity::Effort, ErrorKind::NotAvailable);
    refused(
        damper,
        ForceQuantity::BranchEffort(0),
        ErrorKind::NotAvailable,
    );
    refused(
        damper,
        ForceQuantity::OnNode(1, LoadFrame::Space),
        ErrorKind::Identifier,
    );
    refused(7, ForceQuantity::Effort, ErrorKind::Identifier);
}

/// A body that slides along x, held by struts from points off the line.
fn slider(points: &[Vector3<f64>]) -> (Model, Vec<usize>) {
    let mut model = Model::new();
    let start = Vector3::new(0.3, 0.0, 0.0);
    let body = model
        .add_rigid_body(MASS, &start, &Matrix3::identity())
        .unwrap();
    let frame = Model::frame_at("axis", &start, &Vector3::x()).unwrap();
    model
        .add_joint(JointKind::Prismatic, None, Some(body), &frame, &frame)
        .unwrap();
    let struts = points
        .iter()
        .map(|point| model.add_strut(None, Some(body), point, &start).unwrap())
        .collect();
    (model, struts)
}

fn along(joint: usize) -> periodyn::model::JointCoordinate {
    periodyn::model::JointCoordinate {
        joint,
        coordinate: Coordinate::Displacement1,
    }
}

#[test]
fn a_strut_has_the_tension_of_its_length_and_rate() {
    // Driven along x = 0.3 + s, from a point above: length ℓ = √(x² + h²), tension T = k (ℓ − ℓ₀) +
    // c ℓ̇.
    let (k, c, free, h, a) = (40.0, 3.0, 0.6, 0.5, 0.4);
    let (mut model, struts) = slider(&[Vector3::new(0.0, 0.0, h)]);
    model.prescribe(along(0), &cosine(a)).unwrap();
    let definition = SpringDefinition {
        at: along(struts[0]),
        stiffness: k,
        damping: c,
        rest: free,
    };
    let force = model.add_spring_damper(definition).unwrap();
    let solution = solve(&model, PERIOD, 101);
    let times = times(PERIOD, 50);
    let length = |t: f64| (0.3 + a * (OMEGA * t).cos()).hypot(h);
    let stretch =
        |t: f64| -(0.3 + a * (OMEGA * t).cos()) * a * OMEGA * (OMEGA * t).sin() / length(t);
    let tension = |t: f64| k * (length(t) - free) + c * stretch(t);
    let each = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { times.iter().map(|&t| f(t)).collect() };
    let displacement = Coordinate::Displacement1;
    let of = |joint, quantity| solution.joint(joint, quantity, &times).unwrap();
    // The length is not band-limited: 101 points resolve it to some 1e-12.
    let found = of(struts[0], JointQuantity::Coordinate(displacement));
    assert_near(&found, &each(&length), 1e-10, "length");
    let found = of(struts[0], JointQuantity::Rate(displacement));
    assert_near(&found, &each(&stretch), 1e-9, "rate");
    let found = solution
        .force(force, ForceQuantity::Effort, &times)
        .unwrap();
    assert_near(&found, &each(&tension), 1e-9, "tension");
    let drive = |t: f64| {
        let x = 0.3 + a * (OMEGA * t).cos();
        -MASS * a * OMEGA * OMEGA * (OMEGA * t).cos() + tension(t) * x / length(t)
    };
    let found = of(0, JointQuantity::DrivingEffort(displacement));
    assert_near(&found, &each(&drive), 1e-9, "drive");
}

#[test]
fn a_rod_of_prescribed_length_moves_the_slider_by_pythagoras() {
    let h = 0.5;
    let (mut model, struts) = slider(&[Vector3::new(0.0, 0.0, h)]);
    let start = 0.3f64.hypot(h);
    let length = Signal::harmonics(start + 0.2, 0.0, &[0.0], &[0.15]).unwrap();
    model.prescribe(along(struts[0]), &length).unwrap();
    let solution = solve(&model, PERIOD, 81);
    let times = times(PERIOD, 50);
    let exact: Vec<f64> = times
        .iter()
        .map(|t| {
            let length = start + 0.2 + 0.15 * (OMEGA * t).sin();
            (length * length - h * h).sqrt() - 0.3
        })
        .collect();
    let quantity = JointQuantity::Coordinate(Coordinate::Displacement1);
    let found = solution.joint(0, quantity, &times).unwrap();
    assert_near(&found, &exact, 1e-10, "position");
}

#[test]
fn struts_need_points_apart() {
    let (mut model, struts) = slider(&[Vector3::new(0.0, 0.0, 0.0)]);
    let point = Vector3::new(0.3, 0.0, 0.0);
    let error = model.add_strut(None, Some(0), &point, &point).unwrap_err();
    assert!(error.to_string().starts_with("second_point: "), "{error}");
    // The slider starts at 0.3, and its drive takes it through the strut's fixed point at once.
    let signal = Signal::harmonics(-0.3, 0.0, &[0.0], &[0.0]).unwrap();
    model.prescribe(along(0), &signal).unwrap();
    let definition = SpringDefinition {
        at: along(struts[0]),
        stiffness: 1.0,
        damping: 0.0,
        rest: 0.1,
    };
    model.add_spring_damper(definition).unwrap();
    match try_solve(&model, PERIOD, 5) {
        Ok(solution) => assert_ne!(solution.outcome(), periodyn::solve::Outcome::Converged),
        Err(error) => assert!(error.to_string().contains("coincide"), "{error}"),
    }
}
