//! Rotations, skew matrices and quaternions.

use super::product::product;
use super::scalar::Scalar;
use nalgebra::{ArrayStorage, Matrix3, Rotation3, UnitQuaternion, Vector3};

/// Skew matrix `ã`, with `ã b = a × b`.
#[inline(always)]
pub fn skew<T: Scalar>(a: &Vector3<T>) -> Matrix3<T> {
    let [[x, y, z]] = a.data.0;
    let zero = x.constant(0.0);
    let columns = [[zero, z, -y], [-z, zero, x], [y, -x, zero]];
    Matrix3::from_array_storage(ArrayStorage(columns))
}

/// `a × b`.
#[inline(always)]
pub fn cross<T: Scalar>([ax, ay, az]: [T; 3], [bx, by, bz]: [T; 3]) -> [T; 3] {
    [
        (ay * bz).minus_product(az, by),
        (az * bx).minus_product(ax, bz),
        (ax * by).minus_product(ay, bx),
    ]
}

/// `A b̃`.
#[inline(always)]
pub fn times_skew<T: Scalar>(a: &Matrix3<T>, b: &Vector3<T>) -> Matrix3<T> {
    let ([x, y, z], [[bx, by, bz]]) = (a.data.0, b.data.0);
    let mut product = *a;
    for i in 0..3 {
        let [p, q, r] = &mut product.data.0;
        p[i] = (y[i] * bz).minus_product(z[i], by);
        q[i] = (z[i] * bx).minus_product(x[i], bz);
        r[i] = (x[i] * by).minus_product(y[i], bx);
    }
    product
}

/// `ã B`.
#[inline(always)]
pub fn skew_times<T: Scalar>(a: &Vector3<T>, b: &Matrix3<T>) -> Matrix3<T> {
    let ([a], [x, y, z]) = (a.data.0, b.data.0);
    let columns = [cross(a, x), cross(a, y), cross(a, z)];
    Matrix3::from_array_storage(ArrayStorage(columns))
}

/// Axial vector `½ (A32 − A23, A13 − A31, A21 − A12)`; `axial(ã) = a`.
#[inline(always)]
pub fn axial<T: Scalar>(m: &Matrix3<T>) -> Vector3<T> {
    let [x, y, z] = m.data.0;
    let half = x[0].constant(0.5);
    let entries = [
        half * (y[2] - z[1]),
        half * (z[0] - x[2]),
        half * (x[1] - y[0]),
    ];
    Vector3::from_array_storage(ArrayStorage([entries]))
}

/// Rotation by the angle `|v|` about `v` (exponential map).
#[inline]
pub fn rotation_from_vector(v: &Vector3<f64>) -> Matrix3<f64> {
    let angle2 = v.norm_squared();
    let angle = angle2.sqrt();
    // sin(x)/x and (1 − cos x)/x², by series where the quotients would cancel.
    let (a, b) = if angle < 1e-4 {
        (1.0 - angle2 / 6.0, 0.5 - angle2 / 24.0)
    } else {
        let half = (0.5 * angle).sin() / (0.5 * angle);
        (angle.sin() / angle, 0.5 * half * half)
    };
    let s = skew(v);
    Matrix3::identity() + s * a + product(&s, &s) * b
}

/// Unit quaternion `(w, x, y, z)` of a rotation, with `w ≥ 0`.
pub fn quaternion_from_rotation(r: &Matrix3<f64>) -> [f64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*r));
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    [sign * q.w, sign * q.i, sign * q.j, sign * q.k]
}

/// Rotation of the quaternion `(w, x, y, z)`, which need not be normalised; `None` if it is zero.
pub fn rotation_from_quaternion(q: &[f64; 4]) -> Option<Matrix3<f64>> {
    let q = nalgebra::Quaternion::new(q[0], q[1], q[2], q[3]);
    UnitQuaternion::try_new(q, f64::MIN_POSITIVE).map(|u| u.to_rotation_matrix().into_inner())
}

/// Whether `r` is a proper rotation to within `tolerance` in each entry of `RᵀR − I`.
pub fn is_rotation(r: &Matrix3<f64>, tolerance: f64) -> bool {
    (r.transpose() * r - Matrix3::identity()).amax() <= tolerance && r.determinant() > 0.0
}

/// A rotation whose third column is `axis` (which must not be zero).
///
/// The first column is the projection of the global axis least aligned with `axis`, so that the
/// choice is the same for parallel axes.
pub fn frame_from_axis(axis: &Vector3<f64>) -> Matrix3<f64> {
    let e3 = axis.normalize();
    let mut helper = Vector3::zeros();
    helper[e3.iamin()] = 1.0;
    let e1 = (helper - e3 * e3.dot(&helper)).normalize();
    Matrix3::from_columns(&[e1, e3.cross(&e1), e3])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_is_a_rotation_and_smooth_at_zero() {
        for scale in [0.0, 1e-9, 0.9e-4, 1.1e-4, 0.3, 3.0, 7.0] {
            let v = Vector3::new(0.3, -0.8, 0.52).normalize() * scale;
            let r = rotation_from_vector(&v);
            assert!(is_rotation(&r, 1e-15));
            let reference = Rotation3::new(v).into_inner();
            assert!((r - reference).amax() < 1e-15);
        }
    }

    #[test]
    fn quaternion_and_rotation_agree() {
        let r = rotation_from_vector(&Vector3::new(1.0, 2.0, -0.5));
        let back = rotation_from_quaternion(&quaternion_from_rotation(&r)).unwrap();
        assert!((r - back).amax() < 1e-15);
        assert!(rotation_from_quaternion(&[0.0; 4]).is_none());
    }
}
