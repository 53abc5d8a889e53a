//! Laws of motions, near none, near half a turn, tiny and huge.

mod common;

use common::Random;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periodyn::motion::*;
use std::f64::consts::PI;

const CASES: usize = 20_000;
/// Rounding of a few products of matrices.
const ROUNDING: f64 = 2e-14;

/// An angle from none to half a turn, with what lies near either drawn often.
fn angle(random: &mut Random) -> f64 {
    match random.below(4) {
        0 => 10f64.powf(random.between(-300.0, -3.0)),
        1 => PI - 10f64.powf(random.between(-16.0, -1.0)),
        2 => [0.0, PI, 1e-8, 1e-4][random.below(4)],
        _ => random.between(0.0, PI),
    }
}

fn direction(random: &mut Random) -> Vector3<f64> {
    let any = Vector3::from_fn(|_, _| random.between(-1.0, 1.0));
    match random.below(4) {
        0 => Vector3::ith(random.below(3), 1.0),
        _ => any.try_normalize(0.1).unwrap_or(Vector3::x()),
    }
}

/// An increment, and how large its translation is.
fn increment(random: &mut Random) -> (Vector6<f64>, f64) {
    let length = 10f64.powf(random.between(-150.0, 150.0));
    let turn = direction(random) * angle(random);
    (joined(&(direction(random) * length), &turn), length)
}

fn apart(a: &Motion, b: &Motion, length: f64) -> f64 {
    let turned = (a.rotation - b.rotation).amax();
    turned.max((a.position - b.position).amax() / length)
}

fn each(seed: u64, mut law: impl FnMut(&mut Random)) {
    let mut random = Random::of(&[seed]);
    (0..CASES).for_each(|_| law(&mut random));
}

#[test]
fn increments_are_motions_and_their_negatives_undo_them() {
    each(1, |random| {
        let (step, length) = increment(random);
        let there = Motion::identity().increment(&step);
        assert!(is_rotation(&there.rotation, ROUNDING), "{step}");
        let back = there.increment(&-step);
        let error = apart(&back, &Motion::identity(), length);
        assert!(error < ROUNDING, "{error:e}: {step}");
    });
}

#[test]
fn logarithms_are_those_increments() {
    each(2, |random| {
        let (step, length) = increment(random);
        let there = Motion::identity().increment(&step);
        let found = there.logarithm();
        let error = apart(&Motion::identity().increment(&found), &there, length);
        assert!(error < 10.0 * ROUNDING, "{error:e}: {step}");
        // Near half a turn the axis may be either way round.
        let turn = halves(&step).1.norm();
        if turn < PI - 1e-3 {
            let (linear, angular) = halves(&(found - step));
            let error = (angular.amax()).max(linear.amax() / length);
            assert!(error < 1e-12 / (PI - turn), "{error:e}: {step}");
            // What is tiny is as exact, relative to itself.
            assert!(
                angular.amax() <= 1e-12 * turn / (PI - turn),
                "{step} {found}"
            );
        }
    });
}

#[test]
fn inverse_tangents_are_how_logarithms_change() {
    each(3, |random| {
        let turn = direction(random) * angle(random).min(PI - 0.05);
        let step = joined(&(direction(random) * random.between(0.0, 2.0)), &turn);
        let change = joined(&direction(random), &direction(random));
        let there = Motion::identity().increment(&step);
        let h = 1e-4;
        let at = |factor: f64| there.increment(&(change * (factor * h))).logarithm();
        let exact = inverse_tangent(&step).to_twist_matrix() * change;
        let differences = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
        let error = (exact - differences).amax() / (1.0 + exact.amax());
        assert!(error < 1e-9, "{error:e}: {step}");
    });
}

#[test]
fn what_motions_do_to_twists_is_composed_as_they_are() {
    each(4, |random| {
        let motion = |random: &mut Random| {
            let turn = direction(random) * angle(random);
            Motion::identity().increment(&joined(&direction(random), &turn))
        };
        let (a, b) = (motion(random), motion(random));
        let both: Matrix6<f64> = a.adjoint() * b.adjoint();
        assert!((both - a.compose(&b).adjoint()).amax() < ROUNDING);
        assert!((a.adjoint() * a.inverse().adjoint() - Matrix6::identity()).amax() < ROUNDING);
        assert!(apart(&a.compose(&a.relative(&b)), &b, 1.0) < ROUNDING);
        let q = quaternion_from_rotation(&a.rotation);
        let back = rotation_from_quaternion(&q).unwrap();
        assert!((back - a.rotation).amax() < ROUNDING, "{q:?}");
    });
}

#[test]
fn polar_factors_are_found_whatever_the_scale() {
    each(5, |random| {
        let rotation = rotation_from_vector(&(direction(random) * angle(random)));
        let scale = 10f64.powf(random.between(-100.0, 100.0));
        let axes = rotation_from_vector(&direction(random));
        let stretch = Vector3::from_fn(|_, _| random.between(0.2, 1.0));
        let symmetric = axes * Matrix3::from_diagonal(&stretch) * axes.transpose();
        let found = polar_rotation(&(rotation * symmetric * scale));
        assert!(
            (found - rotation).amax() < 1e-12,
            "{scale:e} {stretch} {found}"
        );
    });
}
