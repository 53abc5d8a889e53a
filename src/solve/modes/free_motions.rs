//! Free motions, which nothing resists: eigenvalues that are exactly zero.
//! See docs/theory.md, section 11.4.

use crate::error::Result;
use crate::solve::modes::eigen::{EigenPair, Search};
use crate::solve::modes::krylov::{Random, Space, complex, norm, overflow};
use crate::solve::modes::pencil::{C64, Inverse};

/// Eigenvalues this small, relative to the highest, may be those of free motions.
const SLOW: f64 = 1e-5;
/// Largest share of a vector outside the free motions for one that is a combination of them.
const OUTSIDE: f64 = 1e-3;

/// Relative resistance `K x` below which `x` is free to move.
const FREE: f64 = 1e-13;
/// Steps that leave nothing but free motions.
const FREE_STEPS: usize = 40;

/// Replaces the eigenvalues that rounding makes of zero by zeros, one for each free motion.
///
/// A free motion is a double eigenvalue with one vector, or a simple one if something damps it: in
/// the first case rounding splits it into two of the order of its square root.
pub(crate) fn without_free_motions(
    search: &Search,
    pairs: Vec<EigenPair>,
) -> Result<Vec<EigenPair>> {
    if pairs
        .iter()
        .all(|pair| pair.value.norm() > SLOW * search.highest())
    {
        return Ok(pairs);
    }
    let free = free_motions(search)?;
    let rounding = FREE.sqrt() * search.highest();
    let mut kept: Vec<EigenPair> = pairs
        .into_iter()
        .filter(|pair| pair.value.norm() > rounding || share_outside(&free, &pair.vector) > OUTSIDE)
        .collect();
    kept.extend(free.iter().map(|vector| EigenPair {
        value: C64::default(),
        vector: complex(vector),
    }));
    Ok(kept)
}

/// Share of `vector` that is no combination of the orthonormal vectors of `basis`.
fn share_outside(basis: &[Vec<f64>], vector: &[C64]) -> f64 {
    let mut rest = vector.to_vec();
    for v in basis {
        let part: C64 = rest.iter().zip(v).map(|(x, v)| x * *v).sum();
        rest.iter_mut().zip(v).for_each(|(x, v)| *x -= part * *v);
    }
    let square = |x: &[C64]| x.iter().map(|x| x.norm_sqr()).sum::<f64>();
    let whole = square(vector);
    if whole > 0.0 {
        (square(&rest) / whole).sqrt()
    } else {
        0.0
    }
}

/// Orthonormal vectors of the null space of `K`.
///
/// `Q(σ)⁻¹ (σ C + σ² M)` keeps them, and shrinks all others.
fn free_motions(search: &Search) -> Result<Vec<Vec<f64>>> {
    // Well below all others, so that these shrink fast.
    let shift = 0.1 * search.shift_for_smallest()?;
    let (mut free, mut random) = (Space::empty(), Random::new(1));
    let Some(inverse) = Inverse::new(search.pencil, C64::from(shift))? else {
        return Ok(Vec::new());
    };
    let (matrices, size) = (&search.pencil.matrices, search.pencil.size());
    while free.basis.len() < search.motions() {
        let mut w: Vec<f64> = (0..size).map(|_| random.next()).collect();
        for _ in 0..FREE_STEPS {
            let old = complex(&w);
            let mut b = vec![C64::default(); size];
            let (first, second) = (C64::from(shift), C64::from(shift * shift));
            search
                .pencil
                .add_product(&matrices.damping, first, &old, &mut b);
            search
                .pencil
                .add_product(&matrices.mass, second, &old, &mut b);
            let next = inverse.solve(search.pencil, &b).ok_or_else(overflow)?;
            w = next.iter().map(|x| x.re).collect();
            free.project_out(&mut w);
            let length = norm(&w);
            if length == 0.0 {
                return Ok(free.basis);
            }
            w.iter_mut().for_each(|w| *w /= length);
            if search.pencil.resistance(&complex(&w)) <= 1e-2 * FREE {
                break;
            }
        }
        if search.pencil.resistance(&complex(&w)) > FREE {
            break;
        }
        free.basis.push(w);
    }
    Ok(free.basis)
}
