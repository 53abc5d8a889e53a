//! Motions in a frame that turns steadily: periodic there, in the inertial frame but for a turn.

mod common;

use common::models::parts::*;
use common::*;
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};
use periodyn::collocation::{Collocation, GridState};
use periodyn::elements::{JointKind, LoadFrame};
use periodyn::error::ErrorKind;
use periodyn::fourier::TimeGrid;
use periodyn::model::{Model, Signal, SignalPart, SignalPlace, Target};
use periodyn::motion::Motion;
use periodyn::output::{NodeQuantity, Quantity, Selection, Solution};
use periodyn::quantity::Feature;
use periodyn::solve::*;
use periodyn::system::System;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A point of the axis of [`arm`].
const PIVOT: Vector3<f64> = Vector3::new(0.3, -0.2, 0.1);

/// A hub that turns once in a period with a flexible arm, which a force that follows it shakes: by
/// a prescribed angle, or in a frame that turns. Gives the node at the tip.
fn arm(in_frame: bool) -> (Model, f64, usize) {
    let (mut model, period, tip) = unloaded_arm(in_frame);
    let force = Signal::harmonics(0.5, 0.0, &[2.0], &[1.0]).unwrap();
    let mut components = [const { None }; 6];
    components[1] = Some(force.clone());
    components[2] = Some(force);
    let loaded = model.add_load(tip, LoadFrame::Follower, components);
    loaded.unwrap();
    (model, period, tip)
}

fn unloaded_arm(in_frame: bool) -> (Model, f64, usize) {
    let period = 1.3;
    let mut model = Model::new();
    let hub = ball(&mut model, 2.0, 0.1, &PIVOT);
    let section = damped_section(
        &[4e3, 2e3, 2e3, 20.0, 30.0, 50.0],
        &[0.5, 4e-4, 2e-4, 2e-4],
        2e-3,
    );
    let (root, tip) = (
        PIVOT + Vector3::x() * 0.2,
        PIVOT + Vector3::new(1.2, 0.0, 0.1),
    );
    let beam = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &section, 2, 3)
        .unwrap();
    let [first, last] = [beam.first_node, beam.last_node];
    join(
        &mut model,
        JointKind::Rigid,
        [Some(hub), Some(first)],
        &root,
        &Vector3::z(),
    );
    gravity(&mut model, [0.0, 0.0, -9.81]);
    if in_frame {
        let axis = Vector3::z() * 3.0;
        model
            .set_turning_frame(&axis, TAU / period, &PIVOT)
            .unwrap();
        clamp(&mut model, hub);
    } else {
        let hinge = revolute(&mut model, None, Some(hub), &PIVOT, &Vector3::z());
        drive(&mut model, hinge, period);
    }
    (model, period, last)
}

/// What the frame of [`arm`] turns in so much of a period.
fn turned(fraction: f64, motion: &Motion) -> Motion {
    let turn = Rotation3::new(Vector3::z() * (TAU * fraction)).into_inner();
    Motion::new(
        turn * motion.rotation,
        PIVOT + turn * (motion.position - PIVOT),
    )
}

fn distance(a: &Motion, b: &Motion) -> f64 {
    let turn = (a.rotation - b.rotation).amax();
    turn.max((a.position - b.position).amax())
}

#[test]
fn a_driven_arm_moves_as_it_does_in_a_frame_that_turns_with_it() {
    let points = 25;
    let (inertial, period, tip) = arm(false);
    let (in_frame, ..) = arm(true);
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let options = PeriodicOptions {
            linear,
            ..options(points)
        };
        let [driven, seen] = [&inertial, &in_frame].map(|model| {
            let found = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
            assert_eq!(found.outcome(), Outcome::Converged, "{}", found.report());
            found
        });
        let mut largest = 0.0f64;
        for node in 0..inertial.node_count() {
            let pairs = driven.details().state.node(node).iter();
            for (k, (a, b)) in pairs.zip(seen.details().state.node(node)).enumerate() {
                largest = largest.max(distance(a, &turned(k as f64 / points as f64, b)));
            }
        }
        // Material velocities and accelerations are those in the inertial frame in both. Between
        // grid points a turn is interpolated otherwise.
        let times: Vec<f64> = (0..points)
            .map(|k| period * k as f64 / points as f64)
            .collect();
        let [velocities, accelerations] = [
            NodeQuantity::MaterialVelocity,
            NodeQuantity::MaterialAcceleration,
        ]
        .map(|quantity| {
            let [a, b] = [&driven, &seen].map(|it| it.node(tip, quantity, &times).unwrap());
            largest_difference(&a, &b)
        });
        println!("{linear:?}: {largest:e}, {velocities:e}, {accelerations:e}");
        // Harmonics that the grid does not resolve differ between the two.
        assert!(largest < 1e-9 && velocities < 1e-8 && accelerations < 1e-6);
        assert!(
            seen.report()
                .contains("in a frame with the angular velocity (0, 0, 4.83")
        );
    }
}

#[test]
fn disturbances_are_the_same_too() {
    let found = [false, true].map(|in_frame| {
        let (model, period, _) = arm(in_frame);
        let solution = solve(&model, period, 25);
        let stability = solution
            .solve_stability(&StabilityOptions::default())
            .unwrap();
        assert_eq!(stability.outcome, Outcome::Converged);
        assert_eq!(stability.verdict, Verdict::Stable);
        stability
    });
    let [a, b] = found.each_ref().map(|it| &it.multipliers);
    let count = a.len().min(b.len());
    assert!(count >= 6, "{count}");
    for (a, b) in a.iter().zip(b).take(6) {
        let off = (a.value - b.value).norm();
        println!("{} {off:e}", a.value);
        assert!(off < 1e-7, "{off:e}");
    }
}

#[test]
fn a_march_in_the_frame_ends_where_one_in_the_inertial_frame_does() {
    let ends = [200, 400].map(|steps| {
        let [a, b] = [false, true].map(|in_frame| {
            let (model, period, tip) = arm(in_frame);
            let periodic = solve(&model, period, 41);
            let end = MarchEnd::Duration(period);
            let options = MarchOptions {
                period: Some(period),
                start: MarchStart::State(periodic.start_state(0.0).unwrap()),
                ..MarchOptions::with_step(period / f64::from(steps), end)
            };
            let marched = Solution::march(&model, &options, &mut |_, _| true).unwrap();
            assert_eq!(
                marched.outcome(),
                Outcome::Converged,
                "{}",
                marched.report()
            );
            let at = |solution: &Solution, time| {
                solution.node(tip, NodeQuantity::Position, &[time]).unwrap()
            };
            largest_difference(&at(&marched, period), &at(&periodic, 0.0))
        });
        println!("{steps}: {a:e} {b:e}");
        [a, b]
    });
    // Both come back, but for errors of the second order in the step.
    for (coarse, fine) in ends[0].iter().zip(ends[1]) {
        let order = (coarse / fine).log2();
        assert!(fine < 1e-3 && (order - 2.0).abs() < 0.3, "{order}");
    }
}

fn is_at_start(output: Selection, value: f64) -> OutputIs {
    OutputIs {
        output,
        feature: Feature::At(0.0),
        value,
        scale: None,
    }
}

/// A point mass on a rod of length 1 that swings in all directions: a hinge about the vertical, and
/// one about y that turns with it. With what leaves nothing open where nothing is lost: damping in
/// proportion to mass, and a constant moment about the vertical, both to be found zero; and the
/// unknown rate of a frame.
fn spherical_pendulum(rate: f64) -> (Model, usize, [Free; 4]) {
    let mut model = Model::new();
    let cross = model.add_node(&Motion::identity()).unwrap();
    let bob = Vector3::new(0.0, 0.0, -1.0);
    let bob = model.add_rigid_body(1.0, &bob, &Matrix3::zeros()).unwrap();
    let origin = Vector3::zeros();
    let upright = revolute(&mut model, None, Some(cross), &origin, &Vector3::z());
    let level = revolute(&mut model, Some(cross), Some(bob), &origin, &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let none = Signal::constant(0.0).unwrap();
    let moment = model.add_actuator(rotation1(upright), &none).unwrap();
    model
        .set_turning_frame(&Vector3::z(), rate, &origin)
        .unwrap();
    let moment = Target::Signal(SignalPlace::Actuator(moment), SignalPart::Mean);
    let mut free = vec![Free::Frequency];
    for (name, value, target) in [
        ("rate", rate, Target::FrameRate),
        ("damping", 0.0, Target::MassDamping),
        ("moment", 0.0, moment),
    ] {
        let parameter = model.add_parameter(name, value, 1.0).unwrap();
        model.move_by_parameter(parameter, target, 1.0).unwrap();
        free.push(Free::Parameter(parameter));
    }
    (model, level, free.try_into().unwrap())
}

#[test]
fn a_spherical_pendulum_finds_its_net_rotation() {
    let (points, period, rate) = (41, 1.05, 3.3);
    let (model, level, free) = spherical_pendulum(rate);
    // Released at 45° with a horizontal speed of 1.5, across the plane that it begins in.
    let value = f64::to_radians(45.0);
    let at = rotation1(level);
    let bob = model.node_count() - 1;
    let speed = Quantity::Node(bob, NodeQuantity::Velocity).component(1);
    let conditions: [Arc<dyn Condition>; 4] = [
        Arc::new(Phase),
        Arc::new(RigidPhase(
            RigidMotion::rotation(&Vector3::z(), &Vector3::zeros()).unwrap(),
        )),
        Arc::new(JointCoordinateIs { at, value }),
        Arc::new(is_at_start(speed, -1.5)),
    ];
    let grid = TimeGrid::new(points, period).unwrap();
    let mut guess = GridState::reference(&System::new(&model, period).unwrap(), grid);
    for k in 0..points {
        let phase = TAU * k as f64 / points as f64;
        // The lower, the slower about the vertical.
        let about = Rotation3::new(Vector3::z() * (-0.28 * phase.sin())).into_inner();
        let swung = Rotation3::new(Vector3::y() * (0.61 + 0.17 * phase.cos())).into_inner();
        let position = about * swung * Vector3::new(0.0, 0.0, -1.0);
        guess.motions[k] = Motion::new(about, Vector3::zeros());
        guess.motions[points + k] = Motion::new(about * swung, position);
    }
    let mut last: Option<Solution> = None;
    for linear in [LinearMethod::Iterative(None), LinearMethod::Direct] {
        let options = PeriodicOptions {
            guess: InitialGuess::State(guess.clone()),
            linear,
            ..options(points)
        };
        let found = solve_for(&model, period, &free, &conditions, &options);
        let values: Vec<f64> = (found.model().parameters().iter())
            .map(|parameter| parameter.value)
            .collect();
        let period = found.grid().period();
        // By quadrature, as of the pendulum whose azimuth is eliminated.
        let off = [
            period - 1.051_258_111_496_7,
            values[0] * period - 3.592_857_262_010_5,
        ];
        let iterations = &found.details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("{linear:?}: {off:?}, {values:?}, {increments:?}");
        assert!(off.iter().all(|off| off.abs() < 2e-11), "{off:?}");
        assert!(values[1].abs() < 1e-10 && values[2].abs() < 1e-10);
        if linear == LinearMethod::Direct {
            for pair in increments.windows(2).filter(|pair| pair[0] < 0.05) {
                assert!(
                    pair[1] <= 20.0 * pair[0] * pair[0] + 1e-11,
                    "{increments:?}"
                );
            }
        }
        if let Some(last) = &last {
            let states = [last, &found].map(|it| &it.details().state);
            assert!(states[0].distance(states[1], 1.0) < 1e-8);
        }
        last = Some(found);
    }
}

/// Complete elliptic integral of the first kind, by the arithmetic-geometric mean.
fn elliptic(modulus_squared: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - modulus_squared).sqrt());
    while f64::abs(a - b) > 1e-15 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    TAU / 4.0 / a
}

/// A body without forces on it that turns about its axis of largest inertia, and wobbles: Euler's
/// solution. Its period, what it turns about its angular momentum in a period, beyond one turn
/// about its own axis, and the mean of its angular velocity about its axis 3.
struct Top {
    period: f64,
    turn: f64,
    spin: f64,
}

fn top(inertia: [f64; 3], energy: f64, momentum: f64) -> Top {
    let [a, b, c] = inertia;
    let (twice, square) = (2.0 * energy, momentum * momentum);
    let rate = ((c - b) * (square - twice * a) / (a * b * c)).sqrt();
    let modulus_squared = (b - a) * (twice * c - square) / ((c - b) * (square - twice * a));
    let quarter = elliptic(modulus_squared);
    let (first, second) = (
        (twice * c - square) / (a * (c - a)),
        (twice * c - square) / (b * (c - b)),
    );
    // The rate of the precession, averaged over equal parts of the period of sn²: descending
    // Landen transformations would give sn; here its differential equation does, by steps of the
    // fourth order.
    let steps = 4000;
    let h = 2.0 * quarter / f64::from(steps);
    let slope = |[s, c, d]: [f64; 3]| [c * d, -s * d, -modulus_squared * s * c];
    let (mut at, mut sum) = ([0.0, 1.0, 1.0], 0.0);
    for _ in 0..steps {
        let [w1, w2] = [first * at[1] * at[1], second * at[0] * at[0]];
        sum += (a * w1 + b * w2) / (a * a * w1 + b * b * w2);
        let along = |k: [f64; 3], h: f64| std::array::from_fn(|i| at[i] + h * k[i]);
        let k1 = slope(at);
        let k2 = slope(along(k1, 0.5 * h));
        let k3 = slope(along(k2, 0.5 * h));
        let k4 = slope(along(k3, h));
        at = std::array::from_fn(|i| at[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    let period = 4.0 * quarter / rate;
    let along_axis = ((square - twice * a) / (c * (c - a))).sqrt();
    Top {
        period,
        turn: momentum * sum / f64::from(steps) * period,
        spin: along_axis * TAU / 4.0 / quarter,
    }
}

#[test]
fn a_free_body_that_wobbles_is_eulers() {
    let (inertia, points) = ([1.0, 1.4, 2.0], 41);
    let momentum = 2.0 * 3.0;
    // Energy at rest about axis 3 is 9; a bit more makes it wobble.
    let energy = 9.4;
    let exact = top(inertia, energy, momentum);
    // One turn about its own axis less.
    let rate = (exact.turn - TAU) / exact.period;
    println!("{} {} {}", exact.period, exact.turn, exact.spin);
    let mut model = Model::new();
    let matrix = Matrix3::from_diagonal(&Vector3::from(inertia));
    let body = model
        .add_rigid_body(1.0, &Vector3::zeros(), &matrix)
        .unwrap();
    let origin = Vector3::zeros();
    join(
        &mut model,
        JointKind::Spherical,
        [None, Some(body)],
        &origin,
        &Vector3::z(),
    );
    let mut components = [const { None }; 6];
    components[5] = Some(Signal::constant(0.0).unwrap());
    model.add_load(body, LoadFrame::Space, components).unwrap();
    let start = 1.02 * rate;
    model
        .set_turning_frame(&Vector3::z(), start, &origin)
        .unwrap();
    let moment = Target::Signal(SignalPlace::Load(0, 5), SignalPart::Mean);
    let mut free = vec![Free::Frequency];
    for (name, value, target) in [
        ("rate", start, Target::FrameRate),
        ("damping", 0.0, Target::MassDamping),
        ("moment", 0.0, moment),
    ] {
        let parameter = model.add_parameter(name, value, 1.0).unwrap();
        model.move_by_parameter(parameter, target, 1.0).unwrap();
        free.push(Free::Parameter(parameter));
    }
    let velocity = Quantity::Node(body, NodeQuantity::MaterialVelocity);
    let spin = OutputIs {
        feature: Feature::Mean,
        ..is_at_start(velocity.component(5), exact.spin)
    };
    let [a, b, c] = inertia;
    let amplitude = ((2.0 * energy * c - momentum * momentum) / (a * (c - a))).sqrt();
    let conditions: [Arc<dyn Condition>; 4] = [
        Arc::new(Phase),
        Arc::new(RigidPhase(
            RigidMotion::rotation(&Vector3::z(), &origin).unwrap(),
        )),
        Arc::new(is_at_start(velocity.component(3), amplitude)),
        Arc::new(spin),
    ];
    let ratio = (a * (c - a) / (b * (c - b))).sqrt();
    let options = starting_at(options(points), (&model, points, exact.period), |t| {
        let (w1, w2) = (amplitude * t.cos(), amplitude * ratio * t.sin());
        let tilt = Vector3::new(b * w2, -a * w1, 0.0) / momentum;
        Motion::new(Rotation3::new(tilt).into_inner(), Vector3::zeros())
    });
    let found = solve_for(&model, exact.period * 1.01, &free, &conditions, &options);
    let period = found.grid().period();
    let values: Vec<f64> = (found.model().parameters().iter())
        .map(|parameter| parameter.value)
        .collect();
    let off = [period - exact.period, values[0] - rate];
    println!("{off:?} {values:?}");
    assert!(off.iter().all(|off| off.abs() < 1e-9), "{off:?}");
    assert!(values[1].abs() < 1e-10 && values[2].abs() < 1e-9);
}

#[test]
fn energy_is_that_of_the_motion_in_the_inertial_frame() {
    let (points, period) = (9, unloaded_arm(true).1);
    let mut energies = [false, true].map(|in_frame| {
        let (model, period, _) = unloaded_arm(in_frame);
        let found = solve(&model, period, points);
        let system = Arc::new(System::new(&model, period).unwrap());
        let mut equations = Collocation::new(system, found.grid()).unwrap();
        let state = &found.details().state;
        equations.update_kinematics(state);
        equations.mean_energy(state).unwrap()
    });
    println!("{energies:?}");
    energies[0] -= energies[1];
    assert!(energies[0].abs() < 1e-9 * energies[1].abs(), "{energies:?}");
    // The gradient at a motion that is no solution, by differences of the fourth order.
    let (model, ..) = unloaded_arm(true);
    let system = Arc::new(System::new(&model, period).unwrap());
    let grid = TimeGrid::new(points, period).unwrap();
    let mut equations = Collocation::new(system.clone(), grid).unwrap();
    let mut state = GridState::reference(&system, grid);
    let mut random = Random::of(&[41]);
    for motion in &mut state.motions {
        let increment = Vector6::from_fn(|_, _| 0.02 * random.between(-1.0, 1.0));
        *motion = motion.increment(&increment);
    }
    let mut row = vec![0.0; equations.size()];
    equations.update_kinematics(&state);
    equations.add_energy_gradient(&state, &mut row).unwrap();
    let layout = equations.layout();
    for (node, k, c) in [
        (0, 1, 0),
        (2, 3, 1),
        (4, 0, 2),
        (5, 8, 3),
        (6, 4, 4),
        (3, 2, 5),
    ] {
        let place = layout.motion(node, k).start + c;
        let mut at = |x: f64| {
            let mut beside = state.clone();
            let mut increment = Vector6::zeros();
            increment[c] = x;
            let motion = &mut beside.motions[node * points + k];
            *motion = motion.increment(&increment);
            equations.update_kinematics(&beside);
            equations.mean_energy(&beside).unwrap()
        };
        let h = 1e-3;
        let slope = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let off = (slope - row[place]).abs();
        println!("{slope:e} {off:e}");
        assert!(off < 1e-8 * slope.abs().max(1.0), "{slope:e} {off:e}");
    }
}

#[test]
fn gravity_across_the_axis_and_two_frames_are_refused() {
    let (mut model, period, _) = arm(true);
    gravity(&mut model, [0.0, 1.0, -9.81]);
    let error = try_solve(&model, period, 5).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic);
    assert!(
        error.to_string().contains("gravity: expected a direction"),
        "{error}"
    );
    let (model, ..) = arm(true);
    let mut options = StaticOptions::default();
    options.standstill.angular_velocity = Vector3::z();
    let error = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap_err();
    assert!(error.to_string().contains("angular_velocity"), "{error}");
    let mut model = Model::new();
    let zero = Vector3::zeros();
    assert!(model.set_turning_frame(&zero, 1.0, &zero).is_err());
    assert!(
        model
            .set_turning_frame(&Vector3::x(), f64::NAN, &zero)
            .is_err()
    );
    let far = Vector3::y() * 1e300;
    assert!(model.set_turning_frame(&Vector3::x(), 1e300, &far).is_err());
    assert!(model.turning_frame().is_none());
}
