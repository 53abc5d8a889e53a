//! Laws of motions, near none, near half a turn, tiny and huge.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periodyn::motion::*;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::RngSeed;
use std::f64::consts::PI;

/// Rounding of a few products of matrices.
const ROUNDING: f64 = 2e-14;

/// The same cases each time.
fn cases(seed: u64) -> ProptestConfig {
    ProptestConfig {
        cases: 20_000,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn power_of_ten(exponents: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    exponents.prop_map(|exponent| 10f64.powf(exponent))
}

/// An angle from none to half a turn, with what lies near either drawn often.
fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![
        power_of_ten(-300.0..-3.0),
        power_of_ten(-16.0..-1.0).prop_map(|left| PI - left),
        select(vec![0.0, PI, 1e-8, 1e-4]),
        0.0..PI,
    ]
}

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    let any = prop::array::uniform3(-1.0..1.0).prop_map(|x| {
        let any = Vector3::from(x);
        any.try_normalize(0.1).unwrap_or(Vector3::x())
    });
    prop_oneof![
        1 => (0..3usize).prop_map(|axis| Vector3::ith(axis, 1.0)),
        3 => any,
    ]
}

fn turn() -> impl Strategy<Value = Vector3<f64>> {
    (direction(), angle()).prop_map(|(direction, angle)| direction * angle)
}

/// An increment, and how large its translation is.
fn increment() -> impl Strategy<Value = (Vector6<f64>, f64)> {
    let parts = (direction(), turn(), power_of_ten(-150.0..150.0));
    parts.prop_map(|(direction, turn, length)| (joined(&(direction * length), &turn), length))
}

fn motion() -> impl Strategy<Value = Motion> {
    let parts = (direction(), turn());
    parts.prop_map(|(position, turn)| Motion::identity().increment(&joined(&position, &turn)))
}

fn apart(a: &Motion, b: &Motion, length: f64) -> f64 {
    let turned = (a.rotation - b.rotation).amax();
    turned.max((a.position - b.position).amax() / length)
}

proptest! {
    #![proptest_config(cases(1))]

    #[test]
    fn increments_are_motions_and_their_negatives_undo_them((step, length) in increment()) {
        let there = Motion::identity().increment(&step);
        prop_assert!(is_rotation(&there.rotation, ROUNDING));
        let back = there.increment(&-step);
        let error = apart(&back, &Motion::identity(), length);
        prop_assert!(error < ROUNDING, "{error:e}");
    }

    #[test]
    fn logarithms_are_those_increments((step, length) in increment()) {
        let there = Motion::identity().increment(&step);
        let found = there.logarithm();
        let error = apart(&Motion::identity().increment(&found), &there, length);
        prop_assert!(error < 10.0 * ROUNDING, "{error:e}");
        // Near half a turn the axis may be either way round.
        let turn = halves(&step).1.norm();
        if turn < PI - 1e-3 {
            let (linear, angular) = halves(&(found - step));
            let error = (angular.amax()).max(linear.amax() / length);
            prop_assert!(error < 1e-12 / (PI - turn), "{error:e}");
            // What is tiny is as exact, relative to itself.
            prop_assert!(angular.amax() <= 1e-12 * turn / (PI - turn), "{found}");
        }
    }

    #[test]
    fn inverse_tangents_are_how_logarithms_change(
        (axis, angle, position) in (direction(), angle(), direction()),
        length in 0.0..2.0,
        change in (direction(), direction()),
    ) {
        let step = joined(&(position * length), &(axis * angle.min(PI - 0.05)));
        let change = joined(&change.0, &change.1);
        let there = Motion::identity().increment(&step);
        let h = 1e-4;
        let at = |factor: f64| there.increment(&(change * (factor * h))).logarithm();
        let exact = inverse_tangent(&step).to_twist_matrix() * change;
        let differences = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
        let error = (exact - differences).amax() / (1.0 + exact.amax());
        prop_assert!(error < 1e-9, "{error:e}");
    }

    #[test]
    fn what_motions_do_to_twists_is_composed_as_they_are(a in motion(), b in motion()) {
        let both: Matrix6<f64> = a.adjoint() * b.adjoint();
        prop_assert!((both - a.compose(&b).adjoint()).amax() < ROUNDING);
        let undone = a.adjoint() * a.inverse().adjoint() - Matrix6::identity();
        prop_assert!(undone.amax() < ROUNDING);
        prop_assert!(apart(&a.compose(&a.relative(&b)), &b, 1.0) < ROUNDING);
        let q = quaternion_from_rotation(&a.rotation);
        let back = rotation_from_quaternion(&q).unwrap();
        prop_assert!((back - a.rotation).amax() < ROUNDING, "{q:?}");
    }

    #[test]
    fn polar_factors_are_found_whatever_the_scale(
        turn in turn(),
        axes in direction(),
        stretch in prop::array::uniform3(0.2..1.0),
        scale in power_of_ten(-100.0..100.0),
    ) {
        let rotation = rotation_from_vector(&turn);
        let axes = rotation_from_vector(&axes);
        let stretch = Matrix3::from_diagonal(&Vector3::from(stretch));
        let found = polar_rotation(&(rotation * axes * stretch * axes.transpose() * scale));
        prop_assert!((found - rotation).amax() < 1e-12, "{found}");
    }
}
