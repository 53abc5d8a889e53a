//! What the material of a beam element adds to its tangents (docs/theory.md, section 6.5).

use crate::elements::{Contribution, StrainTangent};
use nalgebra::Matrix6;

/// Whether strain rates matter, whether they vary with the motion, and whether the stiffness is
/// symmetric all the same.
#[derive(Debug, Clone, Copy)]
pub(super) struct Damping {
    pub damped: bool,
    pub rates_vary: bool,
    pub symmetric: bool,
}

/// Adds `K_ab = B_aᵀ Σ (S B_b + D R_b)` and `C_ab = B_aᵀ Σ D B_b`, sums over the stations that the
/// `laws` of this one are of, whose `columns` follow each other; or puts `B` and `R` aside, if they
/// are wanted apart.
#[inline(always)]
pub(super) fn add_material_stiffness(
    rows: &[StrainTangent],
    laws: &[(Matrix6<f64>, Matrix6<f64>)],
    columns: &[StrainTangent],
    Damping {
        damped,
        rates_vary,
        symmetric,
    }: Damping,
    out: &mut Contribution,
) {
    if out.with_resultants_apart {
        out.strains.extend_from_slice(rows);
        return;
    }
    let count = rows.len();
    // All transposed.
    for b in 0..count {
        let (mut by_motion, mut by_velocity) = (Matrix6::zeros(), Matrix6::zeros());
        for ((stiffness, damping), columns) in laws.iter().zip(columns.chunks_exact(count)) {
            let column = &columns[b];
            column.strain.add_product_to(stiffness, &mut by_motion);
            if rates_vary {
                column.rate.add_product_to(damping, &mut by_motion);
            }
            if damped {
                column.strain.add_product_to(damping, &mut by_velocity);
            }
        }
        let (by_motion, by_velocity) = (by_motion.transpose(), by_velocity.transpose());
        for (a, row) in rows.iter().enumerate() {
            // It is the sum over all stations that is symmetric.
            if !symmetric || a <= b {
                let mut k = Matrix6::zeros();
                row.strain.add_product_to(&by_motion, &mut k);
                out.add_stiffness(a, b, &k.transpose());
                if symmetric && a < b {
                    out.add_stiffness(b, a, &k);
                }
            }
            if damped {
                let mut c = Matrix6::zeros();
                row.strain.add_product_to(&by_velocity, &mut c);
                out.add_damping(a, b, &c.transpose());
            }
        }
    }
}
