//! 6-vectors by their halves: linear and angular, or force and moment.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Both halves.
#[inline]
pub fn halves(v: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (
        Vector3::new(v[0], v[1], v[2]),
        Vector3::new(v[3], v[4], v[5]),
    )
}

/// Of these halves.
#[inline]
pub fn joined(a: &Vector3<f64>, b: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

/// Both halves turned.
#[inline]
pub fn turned(r: &Matrix3<f64>, v: &Vector6<f64>) -> Vector6<f64> {
    let (a, b) = halves(v);
    joined(&(r * a), &(r * b))
}

/// `diag(r, r)`, which turns both halves.
#[inline]
pub fn turn_of_both(r: &Matrix3<f64>) -> Matrix6<f64> {
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).copy_from(r);
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(r);
    m
}
