//! What changes of the source once did without any test noticing; CONTRIBUTING.md lists them.

mod common;

use common::*;
use nalgebra::{Complex, Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, MaxwellBranch};
use periodyn::model::*;
use periodyn::output::{JointQuantity, Modes, Solution};
use periodyn::solve::*;
use periodyn::system::Standstill;
use std::f64::consts::TAU;

#[test]
fn a_short_strut_has_a_direction() {
    // A slide whose strut is a ten-thousandth of the mechanism's size, pushed with a known force.
    let mut model = Model::new();
    let body = ball(&mut model, 1.0, 1.0, &Vector3::new(1.0, 0.0, 0.0));
    let slide = [None, Some(body)];
    join(
        &mut model,
        JointKind::Prismatic,
        slide,
        &Vector3::zeros(),
        &Vector3::x(),
    );
    let (start, end) = (Vector3::zeros(), Vector3::x() * 1e-4);
    let strut = model.add_strut(None, Some(body), &start, &end).unwrap();
    let at = JointCoordinate {
        joint: strut,
        coordinate: Coordinate::Displacement1,
    };
    let spring = SpringDefinition {
        at,
        stiffness: 1e4,
        damping: 0.0,
        rest: 1e-4,
    };
    model.add_spring_damper(spring).unwrap();
    push(&mut model, body, 0, Signal::constant(0.5).unwrap());
    let solution = Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| true);
    let solution = solution.unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    let length = JointQuantity::Coordinate(Coordinate::Displacement1);
    let found = solution.joint(strut, length, &[0.0]).unwrap()[0];
    assert!((found - 1.5e-4).abs() < 1e-12, "{found}");
}

/// A body on a hinge through its centre, with a stiffening spring, shaken by a moment of two
/// harmonics: no force ever acts on it.
fn shaken_by_moments() -> (Model, usize) {
    let inertia = Matrix3::from_diagonal_element(0.7);
    let (mut model, hinge) = hinged_body(2.0, &Vector3::zeros(), &inertia, &Vector3::y());
    let at = rotation1(hinge);
    model
        .add_polynomial_spring_damper(at, &[3.0, 0.0, 80.0], &[0.4], 0.0)
        .unwrap();
    let moment = Signal::harmonics(0.0, 0.0, &[0.25, 0.075], &[0.0, 0.0]).unwrap();
    model.add_actuator(at, &moment).unwrap();
    (model, hinge)
}

#[test]
fn moments_that_are_not_balanced_between_grid_points_show() {
    let (model, hinge) = shaken_by_moments();
    let (period, points) = (TAU / 1.6, 5);
    let solution = solve(&model, period, points);
    let between = solution.diagnostics().between;
    // What is left of the equation of motion the golden section after each grid point, relative to
    // the largest moment. The coordinate is interpolated, not the rotation: equal to the third
    // order of the angle.
    let golden = (3.0 - 5f64.sqrt()) / 2.0;
    let times: Vec<f64> = (0..points)
        .map(|k| period * (k as f64 + golden) / points as f64)
        .collect();
    let of = |quantity| solution.joint(hinge, quantity, &times).unwrap();
    let angle = of(JointQuantity::Coordinate(Coordinate::Rotation1));
    let rate = of(JointQuantity::Rate(Coordinate::Rotation1));
    let acceleration = of(JointQuantity::Acceleration(Coordinate::Rotation1));
    let (mut left, mut level) = (0.0f64, 0.0f64);
    for k in 0..points {
        let inertia = 0.7 * acceleration[k];
        let spring = 3.0 * angle[k] + 80.0 * angle[k].powi(3) + 0.4 * rate[k];
        let phase = TAU * times[k] / period;
        let moment = 0.25 * phase.cos() + 0.075 * (2.0 * phase).cos();
        left = left.max((inertia + spring - moment).abs());
        level = [inertia, spring, moment]
            .iter()
            .fold(level, |m, x| m.max(x.abs()));
    }
    let expected = left / level;
    println!("{} {expected}", between.force);
    assert!(expected > 1e-3);
    assert!(
        (between.force / expected - 1.0).abs() < 0.1,
        "{} {expected}",
        between.force
    );
}

/// A pendulum with a relaxing spring, all lengths in units that are so many times smaller.
fn relaxing(unit: f64) -> Model {
    let (length, moment) = (unit, unit * unit);
    let inertia = Matrix3::from_diagonal_element(0.2 * moment);
    let centre = Vector3::new(0.0, 0.0, -0.7 * length);
    let (mut model, hinge) = hinged_body(1.3, &centre, &inertia, &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81 * length]);
    let branch = MaxwellBranch {
        stiffness: 400.0 * moment,
        relaxation_time: 0.02,
    };
    let at = rotation1(hinge);
    model
        .add_viscoelastic(at, 6.0 * moment, 0.0, &[branch])
        .unwrap();
    model.add_actuator(at, &cosine(30.0 * moment)).unwrap();
    model
}

#[test]
fn what_is_left_between_grid_points_does_not_depend_on_units() {
    let period = 1.1;
    let of = |unit: f64| {
        let solution = solve(&relaxing(unit), period, 7);
        let iterations = solution.details().report.iterations.len();
        (solution.diagnostics().between.force, iterations)
    };
    let (metres, millimetres) = (of(1.0), of(1e3));
    assert!(metres.0 > 1e-6);
    assert!(
        (millimetres.0 / metres.0 - 1.0).abs() < 1e-6,
        "{metres:?} {millimetres:?}"
    );
    assert_eq!(millimetres.1, metres.1);
}

#[test]
fn modal_masses_of_complex_shapes_are_those_of_their_sizes() {
    // A body held at its centre, seen from a frame that turns with it: nutation is complex.
    let (a, b, c) = (1.0, 1.4, 2.1);
    let mut model = Model::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(a, b, c));
    let body = model
        .add_rigid_body(3.0, &Vector3::zeros(), &inertia)
        .unwrap();
    let frame = *model.node(body).unwrap();
    model
        .add_joint(JointKind::Spherical, None, Some(body), &frame, &frame)
        .unwrap();
    let options = ModesOptions {
        equilibrium: StaticOptions {
            standstill: Standstill {
                angular_velocity: Vector3::z() * 7.0,
                ..Standstill::default()
            },
            ..StaticOptions::default()
        },
        count: 6,
        near_frequency: None,
    };
    let found = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    let mass = [3.0, 3.0, 3.0, a, b, c];
    let mut complex = 0;
    for mode in found.modes() {
        let shape = mode.shape[0];
        let sum = |of: fn(Complex<f64>) -> Complex<f64>| -> Complex<f64> {
            shape.iter().zip(mass).map(|(x, m)| of(*x) * m).sum()
        };
        let sizes = sum(|x| x.conj() * x).re;
        assert!(
            (mode.modal_mass / sizes - 1.0).abs() < 1e-12,
            "{} {sizes}",
            mode.modal_mass
        );
        complex += usize::from((sum(|x| x * x).re / sizes - 1.0).abs() > 0.1);
    }
    assert!(complex > 0);
}
