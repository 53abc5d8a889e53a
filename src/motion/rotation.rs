//! Rotations, skew matrices and quaternions.

use super::product::product;
use nalgebra::{ArrayStorage, Matrix3, Rotation3, UnitQuaternion, Vector3};

/// Skew matrix `ã`, with `ã b = a × b`.
#[inline]
pub fn skew(a: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

/// `A b̃`.
#[inline(always)]
pub fn times_skew(a: &Matrix3<f64>, b: &Vector3<f64>) -> Matrix3<f64> {
    let [x, y, z] = a.data.0.map(Vector3::from);
    let columns = [y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x];
    Matrix3::from_columns(&columns)
}

/// `ã B`.
#[inline(always)]
pub fn skew_times(a: &Vector3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    let cross = |b: [f64; 3]| {
        [
            a.y * b[2] - a.z * b[1],
            a.z * b[0] - a.x * b[2],
            a.x * b[1] - a.y * b[0],
        ]
    };
    Matrix3::from_array_storage(ArrayStorage(b.data.0.map(cross)))
}

/// Axial vector `½ (A32 − A23, A13 − A31, A21 − A12)`; `axial(ã) = a`.
#[inline]
pub fn axial(m: &Matrix3<f64>) -> Vector3<f64> {
    0.5 * Vector3::new(
        m[(2, 1)] - m[(1, 2)],
        m[(0, 2)] - m[(2, 0)],
        m[(1, 0)] - m[(0, 1)],
    )
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
