//! Generalised Maxwell elements on joint coordinates: closed forms and an independent integration.

mod common;
#[path = "common/shooting.rs"]
mod shooting;

use common::*;
use nalgebra::{Complex, DVector};
use periodyn::elements::{Coordinate, MaxwellBranch};
use periodyn::error::ErrorKind;
use periodyn::model::Signal;
use periodyn::output::{ForceQuantity, JointQuantity, Solution};
use shooting::shoot;
use std::f64::consts::TAU;

const ANGLE: JointQuantity = JointQuantity::Coordinate(Coordinate::Rotation1);
const DRIVE: JointQuantity = JointQuantity::DrivingEffort(Coordinate::Rotation1);

fn branch(stiffness: f64, relaxation_time: f64) -> MaxwellBranch {
    MaxwellBranch {
        stiffness,
        relaxation_time,
    }
}

fn complex_stiffness(long_term: f64, branches: &[MaxwellBranch], omega: f64) -> Complex<f64> {
    let mut k = Complex::new(long_term, 0.0);
    for b in branches {
        let i_omega_tau = Complex::new(0.0, omega * b.relaxation_time);
        k += i_omega_tau / (i_omega_tau + 1.0) * b.stiffness;
    }
    k
}

fn assert_near(found: &[f64], exact: &[f64], tolerance: f64, what: &str) {
    let error = largest_difference(found, exact) / largest(exact.iter().copied());
    println!("{what}: relative error {error:.1e}");
    assert!(error < tolerance, "{what}: {error:e}");
}

/// Torque `cosines[j] cos (j+1)Ωt` on the arm with an element: the motion is exactly linear at any
/// amplitude.
fn check_linear(long_term: f64, rest: f64, branches: &[MaxwellBranch], tolerance: f64) {
    let (omega, cosines) = (2.2, [2.0, -0.6]);
    let period = TAU / omega;
    let (mut model, hinge) = arm();
    let at = rotation1(hinge);
    let force = model
        .add_viscoelastic(at, long_term, rest, branches)
        .unwrap();
    let torque = Signal::harmonics(0.3, 0.0, &cosines, &[0.0, 0.0]).unwrap();
    let motor = model.add_actuator(at, &torque).unwrap();
    let solution = solve(&model, period, 61);
    let times = times(period, 50);

    // Each harmonic by itself; the mean is carried by the long-term spring alone.
    let sum = |mean: f64, transfer: &dyn Fn(f64) -> Complex<f64>| -> Vec<f64> {
        let at = |&t: &f64| {
            let mut value = mean;
            for (j, c) in cosines.iter().enumerate() {
                let w = omega * (j + 1) as f64;
                value += (transfer(w) * Complex::new(0.0, w * t).exp() * *c).re;
            }
            value
        };
        times.iter().map(at).collect()
    };
    let k = |w| complex_stiffness(long_term, branches, w);
    let turn = |w: f64| Complex::from(1.0) / (k(w) - INERTIA * w * w);
    let mean = rest + 0.3 / long_term;
    let angle = solution.joint(hinge, ANGLE, &times).unwrap();
    assert!(largest(angle.iter().copied()) > 0.3, "a large motion");
    assert_near(&angle, &sum(mean, &turn), tolerance, "angle");
    let of = |quantity| solution.force(force, quantity, &times).unwrap();
    let effort = sum(0.3, &|w| k(w) * turn(w));
    assert_near(&of(ForceQuantity::Effort), &effort, tolerance, "effort");
    for (b, branch) in branches.iter().enumerate() {
        let lag = |w: f64| Complex::new(1.0, w * branch.relaxation_time);
        let dashpot = sum(mean, &|w| turn(w) / lag(w));
        let found = of(ForceQuantity::BranchElongation(b));
        assert_near(&found, &dashpot, tolerance, "dashpot");
        let spring = sum(0.0, &|w| {
            turn(w) * (lag(w) - 1.0) / lag(w) * branch.stiffness
        });
        // Against the whole effort: a branch that relaxes at once carries next to nothing.
        let found = of(ForceQuantity::BranchEffort(b));
        let error = largest_difference(&found, &spring) / largest(effort.iter().copied());
        println!("branch: error {error:.1e}");
        assert!(error < tolerance, "{error:e}");
    }
    let drive = solution
        .force(motor, ForceQuantity::Effort, &times)
        .unwrap();
    let given = sum(0.3, &|_| Complex::from(1.0));
    assert_near(&drive, &given, 1e-13, "actuator");
}

#[test]
fn a_zener_element_has_the_complex_stiffness() {
    // 61 points resolve rotations by a radian to rounding.
    check_linear(5.0, 0.2, &[branch(3.0, 0.5)], 1e-10);
}

#[test]
fn several_branches_have_the_complex_stiffness() {
    let branches = [branch(3.0, 0.05), branch(2.0, 0.5), branch(1.5, 6.0)];
    check_linear(5.0, -0.1, &branches, 1e-10);
}

#[test]
fn branches_that_relax_at_once_or_never_are_nothing_or_springs() {
    let (fast, slow) = (1e-9, 1e9);
    check_linear(5.0, 0.2, &[branch(3.0, fast)], 1e-10);
    // The mean elongation of a dashpot that hardly moves is known to the rounding over its rate
    // only.
    let angle = |long_term: f64, branches: &[MaxwellBranch]| {
        let (mut model, hinge) = arm();
        let at = rotation1(hinge);
        model
            .add_viscoelastic(at, long_term, 0.0, branches)
            .unwrap();
        model.add_actuator(at, &cosine(2.0)).unwrap();
        let period = TAU / 2.2;
        let solution = solve(&model, period, 61);
        solution.joint(hinge, ANGLE, &times(period, 50)).unwrap()
    };
    // The difference is of the order of ω τ, or of 1/(ω τ).
    assert_near(
        &angle(5.0, &[branch(3.0, fast)]),
        &angle(5.0, &[]),
        2e-8,
        "fast",
    );
    assert_near(
        &angle(5.0, &[branch(3.0, slow)]),
        &angle(8.0, &[]),
        2e-8,
        "slow",
    );
}

#[test]
fn a_zener_pendulum_swings_as_its_equation_integrated() {
    let (omega, moment, g, [k, kb, tau]) = (3.0, 9.0, 9.81, ZENER);
    let period = TAU / omega;
    let (model, hinge, force) = zener_pendulum();
    let solution = solve(&model, period, 61);

    // x = (θ, θ̇, α) with the element's equations as they are usually written.
    let f = |t: f64, x: &DVector<f64>| {
        let torque = moment * (omega * t).cos()
            - ZENER_BOB * g * ZENER_ARM * x[0].sin()
            - k * x[0]
            - kb * x[2];
        DVector::from_column_slice(&[x[1], torque / INERTIA, x[1] - x[2] / tau])
    };
    let start = solution.joint(hinge, ANGLE, &[0.0]).unwrap()[0];
    // Fourth order: at 8000 steps the error is below 1e-12.
    let steps = 8000;
    let states = shoot(&f, period, steps, &[start, 0.0, 0.0]);
    let every = steps / 40;
    let times = times(period, 41);
    let pick = |i: usize| -> Vec<f64> { (0..41).map(|j| states[j * every][i]).collect() };
    let angle = solution.joint(hinge, ANGLE, &times).unwrap();
    assert!(largest(angle.iter().copied()) > 1.0, "a large swing");
    assert_near(&angle, &pick(0), 1e-9, "angle");
    let branch = ForceQuantity::BranchEffort(0);
    let found = solution.force(force, branch, &times).unwrap();
    let exact: Vec<f64> = pick(2).iter().map(|a| kb * a).collect();
    assert_near(&found, &exact, 1e-9, "branch");
    let found = solution
        .force(force, ForceQuantity::Effort, &times)
        .unwrap();
    let exact: Vec<f64> = (0..41)
        .map(|j| k * states[j * every][0] + kb * states[j * every][2])
        .collect();
    assert_near(&found, &exact, 1e-9, "effort");
}

/// An arm driven once round in a period, unevenly: `θ = Ωt + a sin Ωt`.
fn driven_round(long_term: f64) -> (periodyn::error::Result<Solution>, usize, usize) {
    let (omega, a) = (2.2, 0.4);
    let (mut model, hinge) = arm();
    let at = rotation1(hinge);
    let turn = Signal::harmonics(0.0, omega, &[0.0], &[a]).unwrap();
    model.prescribe(at, &turn).unwrap();
    let force = model
        .add_viscoelastic(at, long_term, 0.0, &[branch(3.0, 0.5)])
        .unwrap();
    (try_solve(&model, TAU / omega, 21), hinge, force)
}

#[test]
fn a_maxwell_element_may_turn_for_ever_and_a_zener_element_may_not() {
    let (omega, a, kb, tau) = (2.2, 0.4, 3.0, 0.5);
    let (solution, hinge, force) = driven_round(0.0);
    let solution = solution.unwrap();
    let times = times(2.0 * TAU / omega, 60);
    // τ α̇ + α = τ θ̇: the mean of α is τ Ω.
    let i_omega_tau = Complex::new(0.0, omega * tau);
    let filter = i_omega_tau / (i_omega_tau + 1.0) * Complex::new(0.0, -a);
    let alpha = |t: f64| tau * omega + (filter * Complex::new(0.0, omega * t).exp()).re;
    let exact: Vec<f64> = times.iter().map(|&t| kb * alpha(t)).collect();
    let of = |quantity| solution.force(force, quantity, &times).unwrap();
    assert_near(&of(ForceQuantity::Effort), &exact, 1e-11, "effort");
    let dashpot: Vec<f64> = times
        .iter()
        .map(|&t| omega * t + a * (omega * t).sin() - alpha(t))
        .collect();
    let found = of(ForceQuantity::BranchElongation(0));
    // The dashpot's turns may be counted from another turn.
    let shift = TAU * ((dashpot[0] - found[0]) / TAU).round();
    let found: Vec<f64> = found.iter().map(|x| x + shift).collect();
    assert_near(&found, &dashpot, 1e-11, "dashpot");
    let torque: Vec<f64> = times
        .iter()
        .map(|&t| kb * alpha(t) - INERTIA * a * omega * omega * (omega * t).sin())
        .collect();
    let drive = solution.joint(hinge, DRIVE, &times).unwrap();
    assert_near(&drive, &torque, 1e-11, "drive");

    let error = driven_round(1.0).0.unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic);
    let message = error.to_string();
    assert!(
        message.contains("force 0 on joint 0") && message.contains("1 turn"),
        "{message}"
    );
}

#[test]
fn what_is_no_maxwell_branch_is_refused() {
    let (mut model, hinge) = arm();
    let mut refused = |branch, name: &str, kind| {
        let error = model
            .add_viscoelastic(rotation1(hinge), 1.0, 0.0, &[branch])
            .unwrap_err();
        assert!(error.to_string().starts_with(name), "{error}");
        assert_eq!(error.kind(), kind);
    };
    refused(branch(0.0, 1.0), "branch_stiffness[0]", ErrorKind::Value);
    refused(branch(1.0, -1.0), "relaxation_times[0]", ErrorKind::Value);
    refused(
        branch(1.0, f64::NAN),
        "relaxation_times[0]",
        ErrorKind::NotFinite,
    );
    assert_eq!(model.force_count(), 0);
}
