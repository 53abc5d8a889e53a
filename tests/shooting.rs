//! Shooting: agrees with collocation to the error of its steps, converges quadratically, Floquet
//! multipliers.

mod common;

use common::*;
use nalgebra::{Complex, Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::output::{JointQuantity, NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::{PI, TAU};

fn shoot(model: &Model, period: f64, steps: usize) -> Solution {
    shoot_from(MarchStart::Reference, model, period, steps)
}

fn shoot_from(start: MarchStart, model: &Model, period: f64, steps: usize) -> Solution {
    let options = ShootingOptions {
        steps,
        start,
        ..ShootingOptions::default()
    };
    let solution = Solution::solve_shooting(model, period, &options, &mut |_, _| true).unwrap();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    // It repeats itself: what Newton's method leaves is the square of its last increment.
    let record = solution.details().march().unwrap();
    assert!(record.repetition < 1e-9, "{:e}", record.repetition);
    assert_eq!(record.times.len(), steps + 1);
    let iterations = &solution.details().report.iterations;
    for pair in iterations.windows(2) {
        println!(
            "increment {:.1e} -> {:.1e}",
            pair[0].increment, pair[1].increment
        );
    }
    solution
}

fn floquet(solution: &Solution) -> Vec<Complex<f64>> {
    let Kind::Shooting { floquet, .. } = &solution.details().kind else {
        panic!("{}", solution.report());
    };
    floquet.iter().map(|z| Complex::new(z[0], z[1])).collect()
}

/// Errors of a quantity against a reference fall with the square of the step: `errors` at steps and
/// twice as many.
fn assert_second_order(errors: [f64; 2], what: &str) {
    let order = (errors[0] / errors[1]).log2();
    println!(
        "{what}: errors {:.2e}, {:.2e}, order {order:.3}",
        errors[0], errors[1]
    );
    assert!((1.9..2.1).contains(&order), "{what}: {order}");
}

/// Compares a joint's coordinate with that of collocation.
fn compare(
    model: &Model,
    period: f64,
    joint: usize,
    coordinate: Coordinate,
    points: usize,
    steps: usize,
) {
    let exact = solve(model, period, points);
    let times = times(period, 41);
    let quantity = JointQuantity::Coordinate(coordinate);
    let exact = exact.joint(joint, quantity, &times).unwrap();
    let error = |steps: usize| {
        let solution = shoot(model, period, steps);
        relative_to_range(&solution.joint(joint, quantity, &times).unwrap(), &exact)
    };
    assert_second_order([error(steps), error(2 * steps)], "coordinate");
}

#[test]
fn an_oscillator_has_its_closed_form_and_floquet_multipliers() {
    let (model, joint) = oscillator();
    let omega = 3.0;
    let period = TAU / omega;
    let [m, k, c, f] = OSCILLATOR;
    let gain = Complex::from(f) / Complex::new(k - m * omega * omega, c * omega);
    let s = Complex::new(-c / (2.0 * m), (k / m - (c / (2.0 * m)).powi(2)).sqrt());
    let exact = (s * period).exp();
    let times = times(period, 41);
    let (mut errors, mut multipliers) = ([0.0; 2], [0.0; 2]);
    for (i, steps) in [200, 400].into_iter().enumerate() {
        let solution = shoot(&model, period, steps);
        // Linear: one step, and one that finds it was enough.
        assert!(solution.details().report.iterations.len() <= 2);
        let quantity = JointQuantity::Coordinate(Coordinate::Displacement1);
        let found = solution.joint(joint, quantity, &times).unwrap();
        let closed: Vec<f64> = times
            .iter()
            .map(|t| (gain * Complex::new(0.0, omega * t).exp()).re)
            .collect();
        errors[i] = largest_difference(&found, &closed);
        let report = solution.report();
        assert!(report.starts_with("Shooting: converged\n"), "{report}");
        assert!(report.contains(&format!("  {steps} steps over the period")));
        assert!(report.contains("largest Floquet multiplier 0."), "{report}");
        assert!(report.contains("iteration   residual"), "{report}");
        let found = floquet(&solution);
        assert_eq!(found.len(), 2);
        println!("multipliers {found:?}, exact {exact}");
        let conjugate = if found[0].im * exact.im > 0.0 {
            exact
        } else {
            exact.conj()
        };
        multipliers[i] = (found[0] - conjugate).norm();
        assert!((found[0] - found[1].conj()).norm() < 1e-10);
    }
    assert_second_order(errors, "closed form");
    assert_second_order(multipliers, "Floquet multipliers");
}

#[test]
fn a_double_pendulum_agrees_with_collocation() {
    let (model, elbow) = double_pendulum();
    let coordinate = Coordinate::Rotation1;
    compare(&model, DOUBLE_PENDULUM_PERIOD, elbow, coordinate, 61, 200);
}

#[test]
fn a_flexible_four_bar_agrees_with_collocation() {
    let four_bar = FourBar {
        elements: 1,
        degree: 1,
        loaded: true,
        setting: Setting::default(),
    }
    .build();
    // Far from the periodic motion such long steps do not get over the shock of the start.
    let periodic = solve(&four_bar.model, four_bar.period, 61);
    let times = times(four_bar.period, 41);
    let exact = four_bar.curves(&periodic, &times);
    let mut errors = [[0.0; 2]; 3];
    for (i, steps) in [200, 400].into_iter().enumerate() {
        let start = MarchStart::State(periodic.start_state(0.0).unwrap());
        let solution = shoot_from(start, &four_bar.model, four_bar.period, steps);
        let found = four_bar.curves(&solution, &times);
        for (curve, (found, exact)) in found.iter().zip(&exact).enumerate() {
            errors[curve][i] = relative_to_range(found, exact);
        }
    }
    for (errors, what) in errors.into_iter().zip(["position", "velocity", "torque"]) {
        assert_second_order(errors, what);
    }
}

#[test]
fn a_zener_pendulum_agrees_with_collocation() {
    let (model, hinge, _) = zener_pendulum();
    compare(&model, TAU / 3.0, hinge, Coordinate::Rotation1, 61, 200);
    let solution = shoot(&model, TAU / 3.0, 200);
    assert_eq!(floquet(&solution).len(), 3);
    let iterations = &solution.details().report.iterations;
    // Quadratic: each increment is at most a multiple of the square of the one before.
    for pair in iterations.windows(2) {
        let (before, after) = (pair[0].increment, pair[1].increment);
        if before < 0.1 {
            assert!(
                after < 5.0 * before * before + 1e-11,
                "{before:e} -> {after:e}"
            );
        }
    }
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let (model, _) = oscillator();
    let refused = |options: ShootingOptions, what: &str| {
        let error = Solution::solve_shooting(&model, 2.0, &options, &mut |_, _| true).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Value, "{error}");
        assert!(error.to_string().contains(what), "{error}");
    };
    let defaults = ShootingOptions::default;
    refused(
        ShootingOptions {
            steps: 0,
            ..defaults()
        },
        "options.steps_per_period",
    );
    refused(
        ShootingOptions {
            spectral_radius: 1.0,
            ..defaults()
        },
        "options.spectral_radius",
    );
}

/// A mast of 3 m with a mass on its tip, on a body that rolls and starts turned from the reference
/// configuration; gusts at the tip. Its fastest vibrations are far shorter than a step.
fn rolling_mast() -> (Model, f64, usize) {
    let mut model = Model::new();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let foot = Vector3::z() * -0.5;
    let ball = Matrix3::identity();
    let body = model.add_rigid_body(900.0, &foot, &(ball * 400.0)).unwrap();
    let roll = revolute(&mut model, None, Some(body), &foot, &Vector3::x());
    let signal = Signal::harmonics(0.0, 0.0, &[0.15, 0.03], &[0.0, 0.02]).unwrap();
    model.prescribe(rotation1(roll), &signal).unwrap();
    // A round bar of aluminium, 25 mm.
    let (d, modulus, density) = (0.025f64, 7e10, 2700.0);
    let (area, second) = (0.25 * PI * d * d, PI * d.powi(4) / 64.0);
    let shear = 0.9 * modulus / 2.6 * area;
    let stiffness = [
        modulus * area,
        shear,
        shear,
        modulus / 2.6 * 2.0 * second,
        modulus * second,
        modulus * second,
    ];
    let mass = [
        density * area,
        2.0 * density * second,
        density * second,
        density * second,
    ];
    let section = damped_section(&stiffness, &mass, 1e-3);
    let top = Vector3::z() * 3.0;
    let mast = model
        .add_straight_beam(&Vector3::zeros(), &top, &Vector3::y(), &section, 4, 2)
        .unwrap();
    let origin = Vector3::zeros();
    let weld = [Some(body), Some(mast.first_node)];
    join(&mut model, JointKind::Rigid, weld, &origin, &Vector3::x());
    let tip = model.add_rigid_body(0.6, &top, &(ball * 2e-3)).unwrap();
    let weld = [Some(mast.last_node), Some(tip)];
    join(&mut model, JointKind::Rigid, weld, &top, &Vector3::x());
    let gusts = Signal::harmonics(8.0, 0.0, &[5.0, 2.0], &[0.0, 1.0]).unwrap();
    push(&mut model, mast.last_node, 1, gusts);
    (model, 1.0 / 0.6, mast.last_node)
}

#[test]
fn a_start_that_turns_a_flexible_part_does_not_kink_it() {
    let (model, period, tip) = rolling_mast();
    let times = times(period, 41);
    let exact = solve(&model, period, 41);
    let position =
        |solution: &Solution| solution.node(tip, NodeQuantity::Position, &times).unwrap();
    let exact = position(&exact);
    let errors = [60, 120].map(|steps| {
        let found = shoot(&model, period, steps);
        relative_to_range(&position(&found), &exact)
    });
    assert_second_order(errors, "tip");
}
