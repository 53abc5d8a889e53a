//! Marching in time: order, constraints, energy, independent solutions, trajectories and what
//! starts from them.

mod common;
#[path = "common/shooting.rs"]
mod shooting;

use common::*;
use nalgebra::{DVector, Matrix3, Vector3, Vector6};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::*;
use periodyn::solve::*;
use std::f64::consts::TAU;

fn march(model: &Model, options: &MarchOptions) -> Solution {
    let solution = Solution::march(model, options, &mut |_, _| true).unwrap();
    converged(solution)
}

fn for_time(duration: f64, steps: usize) -> MarchOptions {
    let mut options =
        MarchOptions::with_step(duration / steps as f64, MarchEnd::Duration(duration));
    options.newton.tolerance = 1e-10;
    options
}

/// Slope of `ln error` against `ln step`.
fn order(errors: &[(f64, f64)]) -> f64 {
    let points: Vec<(f64, f64)> = errors.iter().map(|(h, e)| (h.ln(), *e)).collect();
    exponential_fit(&points).0
}

// The heavy top of the literature on integrators for Lie groups: 15 kg at 1 m from the fixed point.
const MASS: f64 = 15.0;
const CENTRE: f64 = 1.0;
const INERTIA: [f64; 3] = [0.234375, 0.46875, 0.234375];
const SPIN: f64 = 150.0;
const PRECESSION: f64 = -4.61538;
const GRAVITY: f64 = 9.81;

/// The top stands along y of its body frame and is let go along the space's y axis.
fn heavy_top() -> (Model, usize) {
    let mut model = Model::new();
    let centre = Vector3::new(0.0, CENTRE, 0.0);
    let body = model
        .add_rigid_body(MASS, &centre, &Matrix3::from_diagonal(&INERTIA.into()))
        .unwrap();
    let frame = Model::frame_at("axis", &Vector3::zeros(), &Vector3::z()).unwrap();
    model
        .add_joint(JointKind::Spherical, None, Some(body), &frame, &frame)
        .unwrap();
    gravity(&mut model, [0.0, 0.0, -GRAVITY]);
    (model, body)
}

/// Velocity of the body's node, its centre, with the angular velocity.
fn spinning(angular: Vector3<f64>, centre: &Vector3<f64>) -> Vector6<f64> {
    let linear = angular.cross(centre);
    Vector6::new(
        linear.x, linear.y, linear.z, angular.x, angular.y, angular.z,
    )
}

fn top_start() -> MarchStart {
    MarchStart::State(StartState {
        motions: vec![Motion::new(
            Matrix3::identity(),
            Vector3::new(0.0, CENTRE, 0.0),
        )],
        twists: vec![spinning(
            Vector3::new(0.0, SPIN, PRECESSION),
            &Vector3::new(0.0, CENTRE, 0.0),
        )],
        internal: None,
    })
}

/// Euler's equations about the fixed point, by the classical Runge-Kutta method with its own steps:
/// rotation and angular velocity at the end.
fn euler_top(duration: f64, steps: usize) -> (Matrix3<f64>, Vector3<f64>) {
    let offset = Vector3::new(0.0, CENTRE, 0.0);
    let j = Matrix3::from_diagonal(&INERTIA.into())
        + (Matrix3::identity() - offset * offset.transpose() / CENTRE.powi(2))
            * (MASS * CENTRE * CENTRE);
    let inverse = j.try_inverse().unwrap();
    let rates = |r: &Matrix3<f64>, w: &Vector3<f64>| {
        let weight = r.transpose() * Vector3::new(0.0, 0.0, -MASS * GRAVITY);
        let moment = offset.cross(&weight) - w.cross(&(j * w));
        (r * w.cross_matrix(), inverse * moment)
    };
    let (mut r, mut w) = (Matrix3::identity(), Vector3::new(0.0, SPIN, PRECESSION));
    let h = duration / steps as f64;
    for _ in 0..steps {
        let k1 = rates(&r, &w);
        let k2 = rates(&(r + k1.0 * (0.5 * h)), &(w + k1.1 * (0.5 * h)));
        let k3 = rates(&(r + k2.0 * (0.5 * h)), &(w + k2.1 * (0.5 * h)));
        let k4 = rates(&(r + k3.0 * h), &(w + k3.1 * h));
        r += (k1.0 + (k2.0 + k3.0) * 2.0 + k4.0) * (h / 6.0);
        w += (k1.1 + (k2.1 + k3.1) * 2.0 + k4.1) * (h / 6.0);
    }
    (r, w)
}

#[test]
fn a_heavy_top_converges_with_the_second_order() {
    let (model, body) = heavy_top();
    let duration = 0.2;
    let (r, w) = euler_top(duration, 40_000);
    // Runge-Kutta is of fourth order: half the steps say how far it can be trusted.
    let (r2, _) = euler_top(duration, 20_000);
    assert!((r - r2).amax() < 1e-10, "{:e}", (r - r2).amax());
    for rho in [0.0, 0.5, 0.9] {
        let mut errors: [Vec<(f64, f64)>; 3] = Default::default();
        for steps in [400, 800, 1600] {
            let mut options = for_time(duration, steps);
            options.start = top_start();
            options.spectral_radius = rho;
            let solution = march(&model, &options);
            let h = duration / steps as f64;
            let at = |q| solution.node(body, q, &[duration]).unwrap();
            let rotation = Matrix3::from_column_slice(&at(NodeQuantity::RotationMatrix));
            let omega = at(NodeQuantity::MaterialVelocity);
            errors[0].push((h, (rotation - r).amax()));
            errors[1].push((h, (Vector3::new(omega[3], omega[4], omega[5]) - w).amax()));
            // The reaction from the acceleration of the centre.
            let centre = r * Vector3::new(0.0, CENTRE, 0.0);
            let spin = r * w;
            let j = Matrix3::from_diagonal(&INERTIA.into());
            let offset = Vector3::new(0.0, CENTRE, 0.0);
            let about = j + (Matrix3::identity() - offset * offset.transpose()) * MASS;
            let weight = Vector3::new(0.0, 0.0, -MASS * GRAVITY);
            let moment = offset.cross(&(r.transpose() * weight)) - w.cross(&(about * w));
            let alpha = r * (about.try_inverse().unwrap() * moment);
            let acceleration = alpha.cross(&centre) + spin.cross(&spin.cross(&centre));
            let exact = acceleration * MASS - weight;
            let found = solution
                .joint(0, JointQuantity::Reaction(ResolvedIn::Space), &[duration])
                .unwrap();
            errors[2].push((h, (Vector3::from_column_slice(&found[..3]) - exact).amax()));
            // Constraint: the fixed point does not move.
            let times = solution.times();
            let positions = solution.node(body, NodeQuantity::Position, &times).unwrap();
            let turns = solution
                .node(body, NodeQuantity::RotationMatrix, &times)
                .unwrap();
            for (p, r) in positions.chunks(3).zip(turns.chunks(9)) {
                let fixed = Vector3::from_column_slice(p)
                    - Matrix3::from_column_slice(r) * Vector3::new(0.0, CENTRE, 0.0);
                assert!(fixed.amax() < 1e-10, "{:e}", fixed.amax());
            }
        }
        for (what, errors) in ["rotation", "velocity", "reaction"].iter().zip(&errors) {
            let slope = order(errors);
            println!("ρ∞ = {rho}, {what}: order {slope:.3}, errors {errors:?}");
            assert!((1.9..2.1).contains(&slope), "{what}: {slope}");
        }
    }
}

#[test]
fn accelerations_and_reactions_at_the_start_are_those_of_eulers_equations() {
    let (model, body) = heavy_top();
    let mut options = for_time(1e-3, 1);
    options.start = top_start();
    let solution = march(&model, &options);
    let found = solution
        .node(body, NodeQuantity::Acceleration, &[0.0])
        .unwrap();
    let centre = Vector3::new(0.0, CENTRE, 0.0);
    let spin = Vector3::new(0.0, SPIN, PRECESSION);
    let about = Matrix3::from_diagonal(&INERTIA.into())
        + (Matrix3::identity() - centre * centre.transpose()) * MASS;
    let moment =
        centre.cross(&Vector3::new(0.0, 0.0, -MASS * GRAVITY)) - spin.cross(&(about * spin));
    let alpha = about.try_inverse().unwrap() * moment;
    let exact = alpha.cross(&centre) + spin.cross(&spin.cross(&centre));
    let scale = spin.norm_squared();
    // Stencils of sixth order along turns of 0.02: 1e-12 of the squared speed.
    let linear = (Vector3::from_column_slice(&found[..3]) - exact).amax();
    let angular = (Vector3::from_column_slice(&found[3..]) - alpha).amax();
    println!(
        "relative errors {:.1e}, {:.1e}",
        linear / scale,
        angular / scale
    );
    assert!(linear.max(angular) < 1e-11 * scale);
    let reaction = solution
        .joint(0, JointQuantity::Reaction(ResolvedIn::Space), &[0.0])
        .unwrap();
    let force = exact * MASS + Vector3::new(0.0, 0.0, MASS * GRAVITY);
    assert!((Vector3::from_column_slice(&reaction[..3]) - force).amax() < 1e-10 * MASS * scale);
}

#[test]
fn a_flexible_four_bar_keeps_to_its_periodic_motion_to_the_second_order() {
    let four_bar = FourBar {
        elements: 2,
        degree: 1,
        loaded: true,
        setting: Setting::default(),
    }
    .build();
    let periodic = four_bar.solve(61);
    let duration = 0.25 * four_bar.period;
    let exact = four_bar.curves(&periodic, &[duration]);
    let mut errors: [Vec<(f64, f64)>; 3] = Default::default();
    for steps in [50, 100, 200] {
        let mut options = for_time(duration, steps);
        options.period = Some(four_bar.period);
        options.start = MarchStart::State(periodic.start_state(0.0).unwrap());
        let solution = march(&four_bar.model, &options);
        // Closed to 1e-10 of the size at the end of every step.
        for (joint, kind) in four_bar.joints.iter().zip(0..) {
            let times = solution.times();
            if kind == 1 {
                let tip = solution
                    .node(four_bar.b, NodeQuantity::Position, &times)
                    .unwrap();
                let next = solution
                    .node(four_bar.b + 1, NodeQuantity::Position, &times)
                    .unwrap();
                assert!(largest_difference(&tip, &next) < 1e-10, "joint {joint}");
            }
        }
        assert!(solution.details().march().unwrap().start_moved < 1e-9);
        let found = four_bar.curves(&solution, &[duration]);
        for (errors, (found, exact)) in errors.iter_mut().zip(found.iter().zip(&exact)) {
            errors.push((duration / steps as f64, (found[0] - exact[0]).abs()));
        }
    }
    for (what, errors) in ["position", "velocity", "torque"].iter().zip(&errors) {
        let slope = order(errors);
        println!("{what}: order {slope:.3}, errors {errors:?}");
        assert!((1.9..2.1).contains(&slope), "{what}: {slope}");
    }
}

/// A body on six springs: nothing is lost. The energy of a state.
fn on_springs() -> (Model, usize) {
    let mut model = Model::new();
    let spin = Matrix3::from_diagonal(&Vector3::new(0.3, 0.2, 0.4));
    let body = model.add_rigid_body(2.0, &Vector3::zeros(), &spin).unwrap();
    let frame = Model::frame_at("axis", &Vector3::zeros(), &Vector3::z()).unwrap();
    let joint = model
        .add_joint(JointKind::Free, None, Some(body), &frame, &frame)
        .unwrap();
    for (coordinate, stiffness) in SPRINGS {
        let at = JointCoordinate { joint, coordinate };
        spring(&mut model, at, stiffness, 0.0);
    }
    (model, body)
}

const SPRINGS: [(Coordinate, f64); 6] = [
    (Coordinate::Displacement1, 20.0),
    (Coordinate::Displacement2, 30.0),
    (Coordinate::Displacement3, 25.0),
    (Coordinate::Rotation1, 4.0),
    (Coordinate::Rotation2, 5.0),
    (Coordinate::Rotation3, 6.0),
];

fn energies(solution: &Solution, body: usize) -> Vec<f64> {
    let times = solution.times();
    let v = solution
        .node(body, NodeQuantity::MaterialVelocity, &times)
        .unwrap();
    let mut energy: Vec<f64> = v
        .chunks(6)
        .map(|v| {
            let linear = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
            linear + 0.5 * (0.3 * v[3] * v[3] + 0.2 * v[4] * v[4] + 0.4 * v[5] * v[5])
        })
        .collect();
    for (coordinate, stiffness) in SPRINGS {
        let q = solution
            .joint(0, JointQuantity::Coordinate(coordinate), &times)
            .unwrap();
        for (energy, q) in energy.iter_mut().zip(q) {
            *energy += 0.5 * stiffness * q * q;
        }
    }
    energy
}

#[test]
fn energy_is_kept_or_lost_as_the_parameter_says() {
    let (model, body) = on_springs();
    let mut start = StartState {
        motions: vec![Motion::identity()],
        twists: vec![Vector6::new(0.8, -0.5, 0.6, 1.0, -1.4, 0.9)],
        internal: None,
    };
    start.motions[0].position = Vector3::new(0.1, 0.2, -0.1);
    let drifts = |rho: f64, steps: usize| {
        let mut options = for_time(40.0, steps);
        options.start = MarchStart::State(start.clone());
        options.spectral_radius = rho;
        let energy = energies(&march(&model, &options), body);
        let half = energy.len() / 2;
        let drift = |part: &[f64]| largest(part.iter().map(|e| e / energy[0] - 1.0));
        (
            drift(&energy[..half]),
            drift(&energy[half..]),
            energy[energy.len() - 1] / energy[0] - 1.0,
        )
    };
    let mut bounded = Vec::new();
    for steps in [800, 1600, 3200] {
        let (first, second, last) = drifts(1.0, steps);
        println!("ρ∞ = 1, {steps} steps: drift {first:.2e}, {second:.2e}, end {last:.2e}");
        // Bounded: hardly more in the second half than in the first.
        assert!(second < 2.0 * first);
        bounded.push((40.0 / steps as f64, second.max(first)));
    }
    let slope = order(&bounded);
    println!("order {slope:.3}");
    assert!((1.9..2.1).contains(&slope), "{slope}");
    let mut lost = Vec::new();
    for rho in [0.8, 0.5, 0.0] {
        let (_, _, last) = drifts(rho, 1600);
        println!("ρ∞ = {rho}: {last:.3e} at the end");
        lost.push(last);
    }
    assert!(0.0 > lost[0] && lost[0] > lost[1] && lost[1] > lost[2]);
}

const SLIDE: JointQuantity = JointQuantity::Coordinate(Coordinate::Displacement1);

/// From rest at zero.
fn oscillator_exact(omega: f64, t: f64) -> f64 {
    let [m, k, c, f] = OSCILLATOR;
    let (real, imaginary) = (k - m * omega * omega, c * omega);
    let size = real * real + imaginary * imaginary;
    let (a, b) = (f * real / size, f * imaginary / size);
    let sigma = c / (2.0 * m);
    let damped = (k / m - sigma * sigma).sqrt();
    // x = a cos Ωt + b sin Ωt + e^{−σt} (p cos ω_d t + q sin ω_d t)
    let (p, q) = (-a, -(b * omega + a * sigma) / damped);
    a * (omega * t).cos()
        + b * (omega * t).sin()
        + (-sigma * t).exp() * (p * (damped * t).cos() + q * (damped * t).sin())
}

#[test]
fn an_oscillator_follows_its_closed_form_also_between_steps() {
    let (model, joint) = oscillator();
    let omega = 3.0;
    let mut errors = Vec::new();
    for steps in [200, 400, 800] {
        let mut options = for_time(6.0, steps);
        options.period = Some(TAU / omega);
        let solution = march(&model, &options);
        // No step ends at these times.
        let times: Vec<f64> = (0..97).map(|i| 0.061_8 * i as f64).collect();
        let exact: Vec<f64> = times.iter().map(|t| oscillator_exact(omega, *t)).collect();
        let found = solution.joint(joint, SLIDE, &times).unwrap();
        errors.push((6.0 / steps as f64, largest_difference(&found, &exact)));
        // The body's position is that coordinate.
        let position = column(
            &solution.node(0, NodeQuantity::Position, &times).unwrap(),
            3,
            2,
        );
        assert!(largest_difference(&position, &found) < 1e-12);
    }
    let slope = order(&errors);
    println!("order {slope:.3}, {errors:?}");
    assert!((1.9..2.1).contains(&slope), "{slope}");
}

#[test]
fn controlled_steps_keep_to_the_tolerance() {
    let (model, joint) = oscillator();
    let omega = 3.0;
    let mut global = Vec::new();
    for tolerance in [1e-5, 1e-6, 1e-7] {
        let mut options = for_time(6.0, 60);
        options.period = Some(TAU / omega);
        options.error_tolerance = Some(tolerance);
        let solution = march(&model, &options);
        let record = solution.details().march().unwrap();
        let times = solution.times();
        let exact: Vec<f64> = times.iter().map(|t| oscillator_exact(omega, *t)).collect();
        let found = solution.joint(joint, SLIDE, &times).unwrap();
        let error = largest_difference(&found, &exact);
        println!(
            "tolerance {tolerance:.0e}: {} steps, {} rejected, step error {:.1e}, error \
             {error:.2e}",
            record.steps, record.rejected, record.step_error
        );
        assert!(record.step_error <= tolerance);
        assert!((times[times.len() - 1] - 6.0).abs() < 1e-14);
        // Steps must have changed for this to be a test.
        let lengths: Vec<f64> = times.windows(2).map(|t| t[1] - t[0]).collect();
        let longest = largest(lengths.iter().copied());
        let shortest = lengths.iter().fold(f64::INFINITY, |m: f64, x| m.min(*x));
        assert!(longest > 1.5 * shortest);
        global.push((tolerance, error));
    }
    // Errors of a step are of the third, errors in the end of the second order.
    let slope = exponential_fit(&global.iter().map(|(t, e)| (t.ln(), *e)).collect::<Vec<_>>()).0;
    println!("error against tolerance: exponent {slope:.2}");
    assert!((0.55..0.8).contains(&slope), "{slope}");
}

#[test]
fn marching_until_periodic_takes_as_long_as_the_damping_says() {
    let (model, joint) = oscillator();
    let period = TAU / 3.0;
    let tolerance = 1e-6;
    let end = MarchEnd::Periodic {
        tolerance,
        most_periods: 100,
    };
    let mut options = MarchOptions::with_step(period / 400.0, end);
    options.period = Some(period);
    options.stored_periods = 1;
    let mut seen = 0;
    let solution = Solution::march(&model, &options, &mut |stage, _| {
        assert!(matches!(stage, Stage::March { .. }));
        seen += 1;
        true
    })
    .unwrap();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    let record = solution.details().march().unwrap();
    assert_eq!(seen, record.steps);
    assert_eq!(record.steps, 400 * record.periods);
    assert_eq!(record.times.len(), 401, "the last period and its start");
    assert!(record.repetition <= tolerance);
    // e^{−σT} a period, from about the amplitude 0.1 of the length √(J/m).
    let [m, _, c, _] = OSCILLATOR;
    let decay = (-c / (2.0 * m) * period).exp();
    let expected = (tolerance / 0.1).ln() / decay.ln();
    println!("{} periods, {expected:.1} expected", record.periods);
    assert!((record.periods as f64 - expected).abs() < 4.0);
    // The last period is the periodic solution, but for the error of the steps and what has not
    // decayed.
    let periodic = solve(&model, period, 31);
    let (first, last) = (record.times[0], record.times[400]);
    let times: Vec<f64> = (0..50)
        .map(|i| first + (last - first) * i as f64 / 49.0)
        .collect();
    let marched = solution.joint(joint, SLIDE, &times).unwrap();
    let exact = periodic.joint(joint, SLIDE, &times).unwrap();
    let error = largest_difference(&marched, &exact);
    println!("against the periodic solution {error:.1e}");
    assert!(error < 1e-5);

    // Too few periods are an outcome, and leave what was reached.
    options.end = MarchEnd::Periodic {
        tolerance,
        most_periods: 2,
    };
    let short = Solution::march(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(short.outcome(), Outcome::IterationLimit);
    assert!(short.report().contains("not periodic after 2 periods"));
    // So is being cancelled.
    let mut left = 10;
    let stopped = Solution::march(&model, &options, &mut |_, _| {
        left -= 1;
        left > 0
    })
    .unwrap();
    assert_eq!(stopped.outcome(), Outcome::Cancelled);
    assert_eq!(stopped.times().len(), 11);
}

const ANGLE: JointQuantity = JointQuantity::Coordinate(Coordinate::Rotation1);
const RATE: JointQuantity = JointQuantity::Rate(Coordinate::Rotation1);

#[test]
fn a_zener_pendulum_follows_its_equation_integrated() {
    let (model, hinge, force) = zener_pendulum();
    let omega = 3.0;
    let inertia = 0.2 + ZENER_BOB * ZENER_ARM * ZENER_ARM;
    let f = |t: f64, x: &DVector<f64>| {
        let torque = 9.0 * (omega * t).cos()
            - ZENER_BOB * GRAVITY * ZENER_ARM * x[0].sin()
            - ZENER[0] * x[0]
            - ZENER[1] * x[2];
        DVector::from_column_slice(&[x[1], torque / inertia, x[1] - x[2] / ZENER[2]])
    };
    let duration = 4.0;
    let states = shooting::integrate(&f, duration, 8000, &DVector::zeros(3));
    let end = &states[8000];
    let exact = [end[0], end[1], ZENER[1] * end[2]];
    for rho in [0.0, 0.5, 1.0] {
        let mut errors: [Vec<(f64, f64)>; 3] = Default::default();
        for steps in [400, 800, 1600] {
            let mut options = for_time(duration, steps);
            options.period = Some(TAU / omega);
            options.spectral_radius = rho;
            let solution = march(&model, &options);
            let found = [
                solution.joint(hinge, ANGLE, &[duration]).unwrap()[0],
                solution.joint(hinge, RATE, &[duration]).unwrap()[0],
                solution
                    .force(force, ForceQuantity::BranchEffort(0), &[duration])
                    .unwrap()[0],
            ];
            for (errors, (found, exact)) in errors.iter_mut().zip(found.iter().zip(exact)) {
                errors.push((duration / steps as f64, (found - exact).abs()));
            }
        }
        for (what, errors) in ["angle", "rate", "branch"].iter().zip(&errors) {
            let slope = order(errors);
            println!("ρ∞ = {rho}, {what}: order {slope:.3}, errors {errors:?}");
            assert!((1.9..2.1).contains(&slope), "{what}: {slope}");
        }
    }
}

#[test]
fn what_is_prescribed_starts_at_its_rate_and_velocities_are_projected() {
    // A pendulum whose hinge is driven, and a second one on it that is free.
    let mut model = Model::new();
    let spin = Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.15));
    let first = model
        .add_rigid_body(1.0, &Vector3::new(0.5, 0.0, 0.0), &spin)
        .unwrap();
    let second = model
        .add_rigid_body(1.0, &Vector3::new(1.5, 0.0, 0.0), &spin)
        .unwrap();
    let driven = revolute(
        &mut model,
        None,
        Some(first),
        &Vector3::zeros(),
        &Vector3::z(),
    );
    revolute(
        &mut model,
        Some(first),
        Some(second),
        &Vector3::x(),
        &Vector3::z(),
    );
    let drive = Signal::harmonics(0.3, 0.0, &[0.2, 0.0], &[0.4, -0.1]).unwrap();
    model.prescribe(rotation1(driven), &drive).unwrap();
    let period = 2.0;
    let w = TAU / period;
    let mut options = for_time(period, 400);
    options.period = Some(period);
    // 0.3 + 0.2: the reference configuration must be moved, too.
    let solution = march(&model, &options);
    let at = |q, t: f64| solution.joint(driven, q, &[t]).unwrap()[0];
    assert!((at(ANGLE, 0.0) - 0.5).abs() < 1e-12);
    assert!((at(RATE, 0.0) - w * (0.4 - 0.2)).abs() < 1e-10);
    let acceleration = at(JointQuantity::Acceleration(Coordinate::Rotation1), 0.0);
    assert!((acceleration + w * w * 0.2).abs() < 1e-9);
    let moved = solution.details().march().unwrap().start_moved;
    assert!(moved > 0.1 && moved < 1.0, "{moved}");
    // Velocities that pull a hinge apart: what is left is that of the least change of kinetic
    // energy.
    let (model, body) = heavy_top();
    let mut options = for_time(1e-3, 1);
    let centre = Vector3::new(0.0, CENTRE, 0.0);
    let MarchStart::State(mut start) = top_start() else {
        unreachable!()
    };
    start.twists[0][2] += 5.0;
    options.start = MarchStart::State(start);
    let solution = march(&model, &options);
    let v = solution.node(body, NodeQuantity::Velocity, &[0.0]).unwrap();
    let angular = Vector3::new(v[3], v[4], v[5]);
    let linear = Vector3::new(v[0], v[1], v[2]);
    assert!((linear - angular.cross(&centre)).amax() < 1e-9);
    // An impulse at the fixed point: it changes no momentum about it.
    let given = Vector3::new(0.0, SPIN, PRECESSION);
    let momentum = |angular: &Vector3<f64>, linear: &Vector3<f64>| {
        Matrix3::from_diagonal(&INERTIA.into()) * angular + centre.cross(linear) * MASS
    };
    let before = momentum(
        &given,
        &(given.cross(&centre) + Vector3::new(0.0, 0.0, 5.0)),
    );
    assert!((momentum(&angular, &linear) - before).amax() < 1e-9);
    assert!(solution.details().march().unwrap().start_corrected > 1.0);
}

#[test]
fn the_last_period_of_a_march_is_a_guess_of_a_periodic_solve() {
    let (model, hinge, _) = zener_pendulum();
    let period = TAU / 3.0;
    let mut options = for_time(6.25 * period, 625);
    options.period = Some(period);
    let marched = march(&model, &options);
    let grid = periodyn::fourier::TimeGrid::new(61, period).unwrap();
    let from = PeriodicOptions {
        guess: InitialGuess::State(marched.prolonged(grid).unwrap()),
        ..common::options(61)
    };
    let solution = Solution::solve(&model, period, &from, &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    let from_default = solve(&model, period, 61);
    let times = times(period, 33);
    let found = solution.joint(hinge, ANGLE, &times).unwrap();
    let other = from_default.joint(hinge, ANGLE, &times).unwrap();
    assert!(largest_difference(&found, &other) < 1e-10);
    let iterations = solution.details().report.iterations.len();
    println!("{iterations} iterations");
    assert!(iterations <= 6);

    // Less than a period is none.
    let short = march(&model, &{
        let mut options = for_time(0.5 * period, 50);
        options.period = Some(period);
        options
    });
    let error = short.prolonged(grid).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Value);
    assert!(error.to_string().contains("at least one period"));
}

#[test]
fn a_march_goes_on_where_another_ended() {
    let (model, hinge, force) = zener_pendulum();
    let period = TAU / 3.0;
    let mut options = for_time(1.0, 1000);
    options.period = Some(period);
    let whole = march(&model, &options);
    options.end = MarchEnd::Duration(0.5);
    let first = march(&model, &options);
    options.start_time = 0.5;
    options.start = MarchStart::State(first.start_state(0.5).unwrap());
    let second = march(&model, &options);
    assert_eq!(second.times()[0], 0.5);
    for (quantity, tolerance) in [(ANGLE, 2e-7), (RATE, 2e-6)] {
        let a = whole.joint(hinge, quantity, &[1.0]).unwrap()[0];
        let b = second.joint(hinge, quantity, &[1.0]).unwrap()[0];
        // Begun anew, accelerations have errors of the order of the steps.
        assert!((a - b).abs() < tolerance, "{:e}", a - b);
    }
    let dashpot = |s: &Solution| {
        s.force(force, ForceQuantity::BranchElongation(0), &[0.5])
            .unwrap()[0]
    };
    assert!((dashpot(&first) - dashpot(&second)).abs() < 1e-12);
    assert!(dashpot(&first).abs() > 0.01);
}

#[test]
fn an_over_constrained_mechanism_is_marched() {
    // A parallelogram of revolutes, driven: kinematics are exact.
    let points = [(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)];
    let [a, b, c, d] = points.map(|(x, y)| Vector3::new(x, y, 0.0));
    let mut model = Model::new();
    let spin = Matrix3::from_diagonal(&Vector3::new(0.1, 0.12, 0.15));
    let mut bar = |p: &Vector3<f64>, q: &Vector3<f64>| {
        Some(model.add_rigid_body(1.0, &(0.5 * (p + q)), &spin).unwrap())
    };
    let bars = [bar(&a, &b), bar(&b, &c), bar(&c, &d)];
    let z = Vector3::z();
    let drive = revolute(&mut model, None, bars[0], &a, &z);
    revolute(&mut model, bars[0], bars[1], &b, &z);
    revolute(&mut model, bars[1], bars[2], &c, &z);
    revolute(&mut model, bars[2], None, &d, &z);
    let signal = Signal::harmonics(0.0, 0.0, &[0.3], &[0.4]).unwrap();
    model.prescribe(rotation1(drive), &signal).unwrap();
    gravity(&mut model, [0.0, -GRAVITY, 0.0]);
    let period = 2.0;
    let mut options = for_time(period, 400);
    options.period = Some(period);
    let solution = march(&model, &options);
    let times = solution.times();
    let periodic = solve(&model, period, 31);
    let positions = |s: &Solution| {
        s.node(bars[1].unwrap(), NodeQuantity::Position, &times)
            .unwrap()
    };
    let error = largest_difference(&positions(&solution), &positions(&periodic));
    println!("positions {error:.1e}");
    assert!(error < 1e-9);
    let torque = JointQuantity::DrivingEffort(Coordinate::Rotation1);
    let torques = |s: &Solution| s.joint(drive, torque, &times).unwrap();
    let error = relative_to_range(&torques(&solution), &torques(&periodic));
    println!("torque {error:.1e}");
    // Second order: (2π/400)² of the range, times a factor of order one.
    assert!(error < 2e-3);
}

#[test]
fn times_harmonics_and_options_that_make_no_sense_are_refused() {
    let (model, joint) = oscillator();
    let mut options = for_time(1.0, 100);
    let refused = |options: &MarchOptions, what: &str| {
        let error = Solution::march(&model, options, &mut |_, _| true).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Value, "{error}");
        assert!(error.to_string().contains(what), "{error}");
    };
    refused(&options, "options.period");
    options.period = Some(TAU / 3.0);
    let solution = march(&model, &options);
    for time in [-0.01, 1.01] {
        let error = solution.joint(joint, SLIDE, &[time]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Value);
        assert!(error.to_string().contains("from 0 to 1"), "{error}");
    }
    let error = solution.series(Quantity::Joint(joint, SLIDE)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
    let with = |change: &dyn Fn(&mut MarchOptions)| {
        let mut changed = options.clone();
        change(&mut changed);
        changed
    };
    refused(&with(&|o| o.step = 0.0), "options.step");
    refused(&with(&|o| o.step = f64::NAN), "options.step");
    refused(&with(&|o| o.step = 1e-12), "options.step");
    refused(
        &with(&|o| o.spectral_radius = 1.1),
        "options.spectral_radius",
    );
    refused(
        &with(&|o| o.spectral_radius = f64::NAN),
        "options.spectral_radius",
    );
    refused(
        &with(&|o| o.end = MarchEnd::Duration(-1.0)),
        "options.duration",
    );
    refused(
        &with(&|o| o.error_tolerance = Some(0.0)),
        "options.error_tolerance",
    );
    refused(&with(&|o| o.period = Some(-1.0)), "options.period");
    // Steps of 0.01 would skip such periods, or be none at all; with error control these are too
    // many.
    for period in [0.0099, 1e-7, 1e-9, 1e-300] {
        let skipped = "options.period: expected at least 1.000e-2";
        refused(&with(&|o| o.period = Some(period)), skipped);
    }
    let controlled = with(&|o| {
        o.period = Some(1e-9);
        o.error_tolerance = Some(1e-3);
    });
    refused(&controlled, "options.period: expected at least 1.000e-8");
    // There the next number is farther than a step.
    refused(&with(&|o| o.start_time = -1e17), "options.start_time");
    let periodic = |tolerance, most_periods| {
        with(&|o| {
            o.end = MarchEnd::Periodic {
                tolerance,
                most_periods,
            }
        })
    };
    refused(&periodic(0.0, 3), "options.periodic_tolerance");
    refused(&periodic(1e-3, 0), "options.most_periods");
}
