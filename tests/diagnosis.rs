//! Models and options that cannot be solved: what the user is told.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{JointKind, LoadFrame};
use periodyn::error::{Error, ErrorKind};
use periodyn::model::{Model, Signal, SpringDefinition};
use periodyn::motion::Motion;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::{Outcome, PeriodicOptions};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A rigid bar between two points: its node is at the centre.
fn bar(model: &mut Model, start: &Vector3<f64>, end: &Vector3<f64>) -> usize {
    let inertia = Matrix3::identity() * 0.1;
    model
        .add_rigid_body(1.0, &(0.5 * (start + end)), &inertia)
        .unwrap()
}

fn outcome_and_explanation(solution: &Solution) -> (Outcome, String) {
    let report = &solution.details().report;
    println!("{:?}: {}", report.outcome, report.explanation);
    (report.outcome, report.explanation.clone())
}

fn singular(model: &Model, period: f64, points: usize) -> String {
    let solution = try_solve(model, period, points).unwrap();
    let (outcome, explanation) = outcome_and_explanation(&solution);
    assert_eq!(outcome, Outcome::Singular, "{explanation}");
    explanation
}

/// The error of a solve that must fail, of this kind and naming all `names`.
fn assert_error(error: Result<Solution, Error>, kind: ErrorKind, names: &[&str]) {
    let error = error.expect_err("an error was expected");
    println!("{:?}: {error}", error.kind());
    assert_eq!(error.kind(), kind, "{error}");
    for name in names {
        assert!(error.to_string().contains(name), "no {name} in: {error}");
    }
}

#[test]
fn a_free_body_is_named_with_its_direction() {
    let mut model = Model::new();
    let (start, end) = (Vector3::zeros(), Vector3::x());
    let held = bar(&mut model, &start, &end);
    let free = bar(&mut model, &end, &(2.0 * end));
    revolute(&mut model, None, Some(held), &start, &Vector3::z());
    model.prescribe(rotation1(0), &cosine(0.1)).unwrap();
    let force = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    add_load(&mut model, free, LoadFrame::Space, &[0.0; 6], &force);
    let solution = try_solve(&model, 1.0, 5).unwrap();
    let (outcome, explanation) = outcome_and_explanation(&solution);
    assert_eq!(outcome, Outcome::Singular, "{explanation}");
    // It is as free from any other start.
    let attempts = &solution.details().periodic().unwrap().attempts;
    assert_eq!(attempts.len(), 1, "{attempts:?}");
    assert!(
        explanation.contains(&format!("node {free}")),
        "{explanation}"
    );
    assert!(
        !explanation.contains(&format!("node {held}")),
        "{explanation}"
    );
    assert!(
        explanation.contains("move along") || explanation.contains("turn about"),
        "{explanation}"
    );
}

#[test]
fn a_mean_that_nothing_holds_is_a_freedom() {
    // A damper resists turning, but not the angle about which the arm swings.
    let mut model = Model::new();
    let arm = bar(&mut model, &Vector3::zeros(), &Vector3::x());
    let origin = Vector3::zeros();
    let hinge = revolute(&mut model, None, Some(arm), &origin, &Vector3::z());
    let damper = SpringDefinition {
        at: rotation1(hinge),
        stiffness: 0.0,
        damping: 0.3,
        rest: 0.0,
    };
    model.add_spring_damper(damper).unwrap();
    let moment = [0.0, 0.0, 0.0, 0.0, 0.0, 0.05];
    add_load(&mut model, arm, LoadFrame::Space, &[0.0; 6], &moment);
    for points in [5, 41] {
        let explanation = singular(&model, 3.0, points);
        assert!(
            explanation.contains("turn about") || explanation.contains("move along"),
            "{explanation}"
        );
        assert!(explanation.contains("node 0"), "{explanation}");
    }
}

#[test]
fn a_node_without_anything_is_named() {
    let mut model = driven_arm(&cosine(0.1));
    let at = Motion::new(Matrix3::identity(), Vector3::new(0.3, 0.2, 0.1));
    let bare = model.add_node(&at).unwrap();
    let explanation = singular(&model, 1.0, 5);
    assert!(
        explanation.contains(&format!("node {bare}")),
        "{explanation}"
    );
}

#[test]
fn the_axis_of_a_free_turn_is_named() {
    let mut model = Model::new();
    let ball = model
        .add_rigid_body(1.0, &Vector3::zeros(), &Matrix3::identity())
        .unwrap();
    let axis = Vector3::new(0.0, 0.6, 0.8);
    revolute(&mut model, None, Some(ball), &Vector3::zeros(), &axis);
    let explanation = singular(&model, 1.0, 3);
    assert!(explanation.contains("turn about"), "{explanation}");
    assert!(explanation.contains("0.600, 0.800)") || explanation.contains("-0.600, -0.800)"));
}

#[test]
fn a_coordinate_prescribed_against_a_closed_loop_is_a_lock() {
    // The four-bar of the paper with rigid bars has one freedom; both its cranks are driven.
    let mut mechanism = FourBar {
        elements: 0,
        ..FourBar::default()
    }
    .build();
    let at_a = rotation1(mechanism.joints[0]);
    mechanism.model.prescribe(at_a, &cosine(0.1)).unwrap();
    let solution = try_solve(&mechanism.model, mechanism.period, 3).unwrap();
    let (outcome, explanation) = outcome_and_explanation(&solution);
    assert_eq!(outcome, Outcome::Inconsistent);
    for name in ["locked", "prescribed coordinates 0, 1"] {
        assert!(explanation.contains(name), "{explanation}");
    }
}

#[test]
fn joints_that_cannot_close_leave_no_solution() {
    // Two links of length 1 between pivots that are 3 apart.
    let mut model = Model::new();
    let (a, b, c) = (Vector3::zeros(), Vector3::x(), Vector3::new(1.6, 0.8, 0.0));
    let links = [(a, b), (b, c)].map(|(p, q)| Some(bar(&mut model, &p, &q)));
    revolute(&mut model, None, links[0], &a, &Vector3::z());
    let across = Vector3::z().cross(&(c - b));
    let cross = Model::cross_frame(&b, &Vector3::z(), &across).unwrap();
    let universal = JointKind::Universal;
    model
        .add_joint(universal, links[0], links[1], &cross, &cross)
        .unwrap();
    let at_c = Model::frame_at("axis", &c, &Vector3::z()).unwrap();
    let far = Model::frame_at("axis", &(3.0 * b), &Vector3::z()).unwrap();
    let spherical = JointKind::Spherical;
    model
        .add_joint(spherical, None, links[1], &far, &at_c)
        .unwrap();
    let solution = try_solve(&model, 1.0, 3).unwrap();
    let (outcome, explanation) = outcome_and_explanation(&solution);
    assert!(matches!(
        outcome,
        Outcome::NoInitialGuess | Outcome::Singular
    ));
    assert!(!explanation.is_empty());
    assert_eq!(solution.diagnostics().error_estimate, f64::INFINITY);
}

/// An arm driven about its axis by `signal`.
fn driven_arm(signal: &Signal) -> Model {
    let mut model = Model::new();
    let arm = bar(&mut model, &Vector3::zeros(), &Vector3::x());
    revolute(
        &mut model,
        None,
        Some(arm),
        &Vector3::zeros(),
        &Vector3::z(),
    );
    model.prescribe(rotation1(0), signal).unwrap();
    model
}

#[test]
fn a_spring_that_winds_up_is_not_periodic() {
    let period = 2.0;
    let mut model = driven_arm(&steady(TAU / period));
    let spring = |stiffness| SpringDefinition {
        at: rotation1(0),
        stiffness,
        damping: 0.1,
        rest: 0.0,
    };
    // A damper alone may turn for ever.
    model.add_spring_damper(spring(0.0)).unwrap();
    solve(&model, period, 5);
    model.add_spring_damper(spring(3.0)).unwrap();
    let result = try_solve(&model, period, 5);
    assert_error(
        result,
        ErrorKind::NotPeriodic,
        &["force 1 on joint 0", "1 turn"],
    );
}

#[test]
fn what_does_not_repeat_is_refused_by_name() {
    let (period, kind) = (2.0, ErrorKind::NotPeriodic);
    // A third of a turn in a period.
    let model = driven_arm(&steady(TAU / 6.0));
    let names = ["of joint 0", "whole number of turns"];
    assert_error(try_solve(&model, period, 5), kind, &names);

    let growing = Signal::function(Arc::new(|t| Ok(0.1 * t)));
    assert_error(
        try_solve(&driven_arm(&growing), period, 5),
        kind,
        &["joint 0"],
    );

    let mut model = driven_arm(&cosine(0.1));
    let mut load: [Option<Signal>; 6] = Default::default();
    load[1] = Some(steady(1.0));
    model.add_load(0, LoadFrame::Space, load).unwrap();
    assert_error(try_solve(&model, period, 5), kind, &["load 0 on node 0"]);

    let mut model = driven_arm(&cosine(0.1));
    model.set_gravity([0.0, 0.0, 1.0].map(steady));
    assert_error(try_solve(&model, period, 5), kind, &["gravity"]);
}

#[test]
fn failing_signals_are_callback_errors() {
    let kind = ErrorKind::Callback;
    let nan = Signal::function(Arc::new(|t| Ok(if t > 0.3 { f64::NAN } else { 0.0 })));
    assert_error(
        try_solve(&driven_arm(&nan), 1.0, 5),
        kind,
        &["finite", "NaN"],
    );
    let failing = Signal::function(Arc::new(|t| {
        if t > 0.7 && t < 0.9 {
            return Err(Error::new(ErrorKind::Callback, "the table ends at 0.7"));
        }
        Ok(0.0)
    }));
    assert_error(
        try_solve(&driven_arm(&failing), 1.0, 5),
        kind,
        &["the table ends at 0.7"],
    );
}

#[test]
fn signals_are_functions_that_the_calling_thread_alone_calls() {
    let caller = std::thread::current().id();
    let angle = Signal::function(Arc::new(move |t: f64| {
        if std::thread::current().id() != caller {
            return Err(Error::new(ErrorKind::Callback, "called by another thread"));
        }
        Ok(0.1 * (TAU * t).cos())
    }));
    let options = PeriodicOptions {
        threads: 2,
        ..PeriodicOptions::with_grid_points(15)
    };
    let solution = Solution::solve(&driven_arm(&angle), 1.0, &options, &mut |_, _| true).unwrap();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
}

#[test]
fn a_grid_too_coarse_to_interpolate_a_motion_says_so() {
    // Angles 0, α, −α at three points: half-way between the latter, the weights 2/3, 2/3, −1/3 of
    // the interpolation sum to (4 cos α − 1) / 3, which is zero for this α: no rotation is nearest.
    let alpha = 0.25f64.acos();
    let amplitude = alpha / (TAU / 3.0).sin();
    let model = driven_arm(&Signal::harmonics(0.0, 0.0, &[0.0], &[amplitude]).unwrap());
    let period = 1.0;
    let solution = solve(&model, period, 3);
    let position = |time| solution.node(0, NodeQuantity::Position, &[time]);
    let error = position(0.5 * period).expect_err("the motion cannot be interpolated");
    println!("{error}");
    assert_eq!(error.kind(), ErrorKind::GridTooCoarse);
    for name in ["grid of 3 points", "node 0", "t = 0.5"] {
        assert!(error.to_string().contains(name), "no {name} in: {error}");
    }
    assert!(position(0.3 * period).is_ok());
    // The solve itself had told.
    assert!(solution.diagnostics().error_estimate > 0.1);

    // More points resolve it.
    let fine = solve(&model, period, 41);
    assert!(fine.diagnostics().between.constraint < 1e-9);
}

#[test]
fn aliasing_shows_in_the_diagnostics() {
    // Few points follow a fast drive exactly where they are, and nowhere else.
    let drive = Signal::harmonics(0.0, 0.0, &[1.3, 0.0, 0.9], &[0.0, 2.2, 0.0]).unwrap();
    let model = driven_arm(&drive);
    for points in [1, 3, 5] {
        let diagnostics = solve(&model, 1.0, points).diagnostics().clone();
        println!("N = {points}: {diagnostics:?}");
        // Errors of order one, in radians and relative to forces.
        assert!(diagnostics.error_estimate > 1.0 && diagnostics.between.constraint > 1.0);
    }
    let diagnostics = solve(&model, 1.0, 151).diagnostics().clone();
    println!(
        "N = 151: {:?} {}",
        diagnostics.between, diagnostics.error_estimate
    );
    assert!(diagnostics.error_estimate < 1e-6 && diagnostics.between.constraint < 1e-6);
}

#[test]
fn grids_periods_and_options_are_checked_by_name() {
    let model = driven_arm(&cosine(0.1));
    let (size, value) = (ErrorKind::Size, ErrorKind::Value);
    for points in [0, 2, 20] {
        assert_error(
            try_solve(&model, 1.0, points),
            size,
            &["grid_points", "odd"],
        );
    }
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_error(try_solve(&model, period, 5), value, &["period", "positive"]);
    }
    let solve = |options: &_| Solution::solve(&model, 1.0, options, &mut |_, _| true);
    for tolerance in [0.0, -1e-9, f64::NAN, f64::INFINITY] {
        let mut options = options(5);
        options.newton.tolerance = tolerance;
        assert_error(solve(&options), value, &["options.tolerance"]);
    }
    let mut options = options(5);
    options.newton.iteration_limit = 0;
    assert_error(solve(&options), value, &["options.iteration_limit"]);
    let empty = try_solve(&Model::new(), 1.0, 5);
    assert_error(empty, ErrorKind::Model, &["at least one node"]);
}

#[test]
fn resonance_without_damping_is_not_called_a_freedom() {
    // ω = 2 is once, twice or thrice the frequency of the period.
    for (times, said) in [(1.0, "once"), (2.0, "2 times"), (3.0, "3 times")] {
        let (mut model, slide) = mass_on_a_slide(1.0, &Vector3::z());
        let spring = SpringDefinition {
            at: slide,
            stiffness: 4.0,
            damping: 0.0,
            rest: 0.0,
        };
        model.add_spring_damper(spring).unwrap();
        let force = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        add_load(&mut model, 0, LoadFrame::Space, &[0.0; 6], &force);
        let solution = try_solve(&model, 0.5 * TAU * times, 11).unwrap();
        let (outcome, explanation) = outcome_and_explanation(&solution);
        assert!(!outcome.is_solution());
        let expected = format!("resonance without damping: node 0 may vibrate {said} in a period");
        assert!(explanation.contains(&expected), "{explanation}");
        assert!(!explanation.contains("free to move"), "{explanation}");
    }
}

#[test]
fn a_grid_that_resolves_nothing_is_told_at_once() {
    let model = driven_arm(&cosine(1.5));
    let report = solve(&model, 1.0, 3).report();
    let second = report.lines().nth(1).unwrap();
    assert!(
        second.contains("but 3 grid points resolve nothing"),
        "{report}"
    );
    let report = solve(&model, 1.0, 41).report();
    assert!(!report.contains("resolve nothing"), "{report}");
}
