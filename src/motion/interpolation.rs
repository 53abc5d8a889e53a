//! Interpolation of motions by dual polar decomposition (docs/theory.md, section 3).
//!
//! The same algebra serves in time, with cardinal functions, and along a beam, with shape
//! functions.

use super::dual::{DualMatrix, DualVector};
use super::polar::{polar_rotation, spread_matrix, symmetric_factor_is_admissible};
use super::product::{product, transposed_product};
use super::rigid::Motion;
use super::rotation::{axial, skew};

/// Dual polar decomposition `G = R S` of a weighted sum of motions `G = Σ w_k M_k`.
#[derive(Debug, Clone, Copy)]
pub struct DualPolar<T = f64> {
    /// Dual rotation `R`: the interpolated motion.
    pub rotation: DualMatrix<T>,
    /// Symmetric factor `S`.
    pub factor: DualMatrix<T>,
    /// `A⁻¹`, with `A = tr(S) I − S`.
    pub spread_inverse: DualMatrix<T>,
}

impl DualPolar {
    /// Decomposes `g`. `None` if `tr(S) I − S` is singular or indefinite: the samples are too far
    /// apart for this motion.
    pub fn new(g: &DualMatrix) -> Option<Self> {
        let r = polar_rotation(&g.primal);
        let s = transposed_product(&r, &g.primal);
        if !symmetric_factor_is_admissible(&s) {
            return None;
        }
        let a_inverse = spread_matrix(&s).try_inverse()?;
        // A z = 2 axial(Rᵀ G°),  R° = R z̃,  S° = Rᵀ G° − z̃ S
        let rt_g = transposed_product(&r, &g.dual);
        let z = product(&a_inverse, &(2.0 * axial(&rt_g)));
        let s_dual = rt_g - product(&skew(&z), &s);
        Some(DualPolar {
            rotation: DualMatrix {
                primal: r,
                dual: product(&r, &skew(&z)),
            },
            factor: DualMatrix {
                primal: s,
                dual: s_dual,
            },
            spread_inverse: DualMatrix {
                primal: a_inverse,
                dual: -product(&product(&a_inverse, &spread_matrix(&s_dual)), &a_inverse),
            },
        })
    }

    /// The interpolated motion.
    pub fn motion(&self) -> Motion {
        let r = self.rotation.primal;
        Motion {
            rotation: r,
            position: axial(&(self.rotation.dual * r.transpose())),
        }
    }

    /// Material velocity `A v = 2 axial(Rᵀ G')`.
    pub fn velocity(&self, g_prime: &DualMatrix) -> DualVector {
        self.spread_inverse * (self.rotation.tr_mul(g_prime).axial() * 2.0)
    }

    /// Material acceleration `A v̇ = 2 axial(Rᵀ G'' − ṽ ṽ S − 2 ṽ S')`, `S' = Rᵀ G' − ṽ S`.
    pub fn acceleration(
        &self,
        velocity: &DualVector,
        g_prime: &DualMatrix,
        g_second: &DualMatrix,
    ) -> DualVector {
        let v = velocity.skew();
        let s_prime = self.rotation.tr_mul(g_prime) - v * self.factor;
        let b = self.rotation.tr_mul(g_second) - v * (v * self.factor) - v * s_prime * 2.0;
        self.spread_inverse * (b.axial() * 2.0)
    }
}
