//! Polar decomposition `G = R S` with `tr(S) I − S` positive definite (docs/theory.md, section
//! 3.1).

use super::rotation::{axial, rotation_from_vector};
use nalgebra::{Matrix3, Vector3};

/// `tr(S) I − S`: its eigenvalues are the sums of pairs of eigenvalues of `S`.
#[inline]
pub fn spread_matrix(s: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(s.trace()) - s
}

/// Rotation `R` of the polar decomposition `G = R S` that makes `tr(S) I − S` positive definite.
///
/// Also for `det G < 0`. The result is a rotation for any finite `G`; whether it is well defined is
/// for the caller to ask of [`symmetric_factor_is_admissible`].
pub fn polar_rotation(g: &Matrix3<f64>) -> Matrix3<f64> {
    let size = g.norm();
    // Well away from singular: Newton's iteration R ← ½ (R + R⁻ᵀ), quadratic.
    if g.determinant() > 1e-2 * size * size * size {
        let mut r = *g * (3f64.sqrt() / size);
        for _ in 0..30 {
            let [x, y, z] = [0, 1, 2].map(|column| Vector3::from(r.column(column)));
            // R⁻ᵀ by its cofactors.
            let cofactors = [y.cross(&z), z.cross(&x), x.cross(&y)];
            let determinant = x.dot(&cofactors[0]);
            if determinant == 0.0 {
                break;
            }
            let next = 0.5 * (r + Matrix3::from_columns(&cofactors) * (1.0 / determinant));
            let change = (next - r).amax();
            r = next;
            if change < 1e-9 {
                return r;
            }
        }
    }
    let svd = g.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else {
        return Matrix3::identity();
    };
    let mut r = u * v_t;
    if r.determinant() < 0.0 {
        // The smallest singular value is the one that changes sign.
        let mut u = u;
        let smallest = svd.singular_values.imin();
        u.column_mut(smallest).neg_mut();
        r = u * v_t;
    }
    // The decomposition's own rounding is polished by Newton on axial(RᵀG) = 0.
    for _ in 0..2 {
        let s = r.tr_mul(g);
        match spread_matrix(&s).cholesky() {
            Some(factor) => r *= rotation_from_vector(&factor.solve(&(2.0 * axial(&s)))),
            None => break,
        }
    }
    r
}

/// Whether `tr(S) I − S` is positive definite, and well enough so that `R` depends smoothly on `G`.
pub fn symmetric_factor_is_admissible(s: &Matrix3<f64>) -> bool {
    let a = spread_matrix(s);
    let size = a.amax();
    if !size.is_finite() || size <= 0.0 {
        return false;
    }
    // 1e-6: below it an error of 1e-10 in G would turn R by 1e-4.
    let d = Vector3::new(a[(0, 0)], a[(1, 1)], a[(2, 2)]).add_scalar(-1e-6 * size);
    let half = |i: usize, j: usize| 0.5 * (a[(i, j)] + a[(j, i)]);
    let (x, y, z) = (half(1, 2), half(0, 2), half(0, 1));
    // By its leading minors.
    let minor = d[0] * d[1] - z * z;
    let determinant = d[2] * minor - d[0] * x * x - d[1] * y * y + 2.0 * x * y * z;
    d[0] > 0.0 && minor > 0.0 && determinant > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotation(seed: f64) -> Matrix3<f64> {
        rotation_from_vector(&Vector3::new(seed.sin(), seed.cos(), 2.0 * seed.sin()))
    }

    #[test]
    fn recovers_rotation_and_symmetric_factor() {
        for (seed, stretches) in [
            (0.3, [1.0, 1.0, 1.0]),
            (1.3, [0.7, 1.2, 2.0]),
            (2.1, [-0.4, 1.2, 2.0]),
            (2.9, [1e-9, 1.2, 2.0]),
            (3.4, [-0.3, 0.4, 0.5]),
        ] {
            let q = rotation(seed + 10.0);
            let s = q * Matrix3::from_diagonal(&Vector3::from(stretches)) * q.transpose();
            let r = rotation(seed);
            let found = polar_rotation(&(r * s));
            assert!((found - r).amax() < 4e-15 / (stretches[0] + stretches[1]).abs());
            assert!(symmetric_factor_is_admissible(&s));
        }
    }

    #[test]
    fn refuses_factors_without_a_unique_rotation() {
        let diagonal = |a, b, c| Matrix3::from_diagonal(&Vector3::new(a, b, c));
        assert!(!symmetric_factor_is_admissible(&diagonal(0.0, 0.0, 0.0)));
        assert!(!symmetric_factor_is_admissible(&diagonal(1.0, 0.0, 0.0)));
        assert!(!symmetric_factor_is_admissible(&diagonal(-0.5, 0.5, 2.0)));
        assert!(!symmetric_factor_is_admissible(&diagonal(
            f64::NAN,
            1.0,
            1.0
        )));
    }

    #[test]
    fn is_admissible_as_the_eigenvalues_say_in_any_direction() {
        // The two smallest of the symmetric factor have a positive sum.
        for (stretches, is_admissible) in [
            ([-0.5, 0.45, 2.0], false),
            ([-0.4, 0.45, 0.5], true),
            ([-0.1, 0.101, 3.0], true),
            ([-0.1, 0.099, 3.0], false),
            ([-0.7, -0.2, 1.0], false),
            ([0.5, 1.0, 1.5], true),
        ] {
            for k in 0..200 {
                let q = rotation(0.37 * f64::from(k));
                let s = q * Matrix3::from_diagonal(&Vector3::from(stretches)) * q.transpose();
                let found = symmetric_factor_is_admissible(&s);
                assert_eq!(found, is_admissible, "{stretches:?} turned: {s}");
            }
        }
    }
}
