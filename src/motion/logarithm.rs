//! Logarithm of motions, and how it varies: the inverse of the exponential map of SE(3).
//! See docs/theory.md, section 1.4.

use super::dual::{Dual, DualMatrix, DualVector};
use super::rigid::Motion;
use super::rotation::{quaternion_from_rotation, skew};
use nalgebra::{Vector3, Vector6};

/// `d(x) = (1 − (θ/2) cot(θ/2)) / θ²` with `x = θ²`, for a dual `x`: that its dual part is
/// multiplied by is the derivative.
fn quadratic_factor(x: Dual) -> Dual {
    let (value, slope) = if x.primal < 0.25 {
        // |B₂ₙ| / (2n)!, the Taylor series, where the quotients would cancel.
        const TERMS: [f64; 8] = [
            1.0 / 12.0,
            1.0 / 720.0,
            1.0 / 30_240.0,
            1.0 / 1_209_600.0,
            1.0 / 47_900_160.0,
            691.0 / 1_307_674_368_000.0,
            1.0 / 74_724_249_600.0,
            3617.0 / 10_670_622_842_880_000.0,
        ];
        let (mut value, mut slope) = (0.0, 0.0);
        for term in TERMS.iter().rev() {
            slope = slope * x.primal + value;
            value = value * x.primal + term;
        }
        (value, slope)
    } else {
        let angle = x.primal.sqrt();
        let (sin, cos) = (0.5 * angle).sin_cos();
        let cot = cos / sin;
        let numerator = 1.0 - 0.5 * angle * cot;
        // With respect to x: dθ/dx = 1/(2θ).
        let numerator_slope = (0.25 * angle / (sin * sin) - 0.5 * cot) / (2.0 * angle);
        (
            numerator / x.primal,
            (numerator_slope - numerator / x.primal) / x.primal,
        )
    };
    Dual {
        primal: value,
        dual: slope * x.dual,
    }
}

/// `T⁻¹(Ψ)`: if `exp(Ψ)` is followed by the small material increment `Δu`, its logarithm grows by
/// `T⁻¹ Δu`.
///
/// For rotations it is `I + ½ ψ̃ + d ψ̃²`, and the same in dual numbers for motions.
pub fn inverse_tangent(increment: &Vector6<f64>) -> DualMatrix {
    let psi = DualVector::from_twist(increment);
    let skew = psi.skew();
    let mut identity = DualMatrix::zeros();
    identity.primal.fill_with_identity();
    identity + skew * 0.5 + skew * skew * quadratic_factor(psi.dot(&psi))
}

impl Motion {
    /// The increment `[linear; angular]` whose exponential is this motion; its turn is at most π.
    pub fn logarithm(&self) -> Vector6<f64> {
        let [w, x, y, z] = quaternion_from_rotation(&self.rotation);
        let half = Vector3::new(x, y, z);
        let sine = half.norm();
        // The angle over the sine of its half.
        let factor = if sine < 1e-8 {
            2.0
        } else {
            2.0 * sine.atan2(w) / sine
        };
        let angular = half * factor;
        let turn = skew(&angular);
        let d = quadratic_factor(Dual {
            primal: angular.norm_squared(),
            dual: 0.0,
        });
        let turned = turn * self.position;
        let linear = self.position - turned * 0.5 + turn * turned * d.primal;
        let mut increment = Vector6::zeros();
        increment.fixed_rows_mut::<3>(0).copy_from(&linear);
        increment.fixed_rows_mut::<3>(3).copy_from(&angular);
        increment
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_inverts_the_exponential() {
        let direction = Vector6::new(0.3, -0.2, 0.5, 0.9, -0.4, 1.2);
        for scale in [0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.32, 0.33, 1.0, 1.9] {
            let increment = direction * scale;
            let found = Motion::identity().increment(&increment).logarithm();
            // Entries of the rotation are rounded to 1e-16 of one.
            assert!(
                (found - increment).amax() < 1e-15 + 1e-14 * scale,
                "{scale}"
            );
        }
    }

    #[test]
    fn inverse_tangent_is_the_derivative_of_the_logarithm() {
        let direction = Vector6::new(0.3, -0.2, 0.5, 0.9, -0.4, 1.2);
        for scale in [0.0, 1e-3, 0.1, 0.32, 0.33, 1.0, 1.8] {
            let increment = direction * scale;
            let motion = Motion::identity().increment(&increment);
            let exact = inverse_tangent(&increment).to_twist_matrix();
            let h = 1e-3;
            for component in 0..6 {
                let mut unit = Vector6::zeros();
                unit[component] = 1.0;
                let at = |step: f64| motion.increment(&(unit * step)).logarithm();
                let slope = ((at(h) - at(-h)) * 8.0 - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
                // Fourth-order differences: h⁴ times the fifth derivative, and rounding over h.
                assert!((slope - exact.column(component)).amax() < 2e-11, "{scale}");
            }
        }
    }
}
