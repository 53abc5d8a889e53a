//! What the Jacobian has of the increments at one time in the equations of all times, by the vector
//! registers that the processor has.

use crate::motion::{DualMatrix, Lanes, Scalar};
use faer::traits::pulp::{Arch, Simd, WithSimd};
use nalgebra::Matrix6;
use std::array::from_fn;

/// Columns of a coupling by the increment of a node at one grid point `k`.
pub(super) struct BetweenTimes<'a> {
    /// `C` and `M` at each grid point `ℓ`.
    pub tangents: [&'a [Matrix6<f64>]; 2],
    /// `Γ_v` and `Γ_a` there, of the increment at `k`.
    pub gammas: &'a [[DualMatrix; 2]],
    /// `k`, and `K` there, if that counts.
    pub rest: Option<(usize, &'a Matrix6<f64>)>,
    /// Of all entries.
    pub scale: &'a Matrix6<f64>,
    /// Where the six columns lie, so far from each other.
    pub values: &'a mut [f64],
    pub stride: usize,
}

impl BetweenTimes<'_> {
    /// Writes `M Γ_a + C Γ_v`, and `K` at `ℓ = k`.
    pub fn write(self) {
        Arch::new().dispatch(self);
    }
}

impl WithSimd for BetweenTimes<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match S::F64_LANES {
            1 => write::<S, 6>(simd, self),
            2 => write::<S, 3>(simd, self),
            4 => write::<S, 2>(simd, self),
            _ => write::<S, 1>(simd, self),
        }
    }
}

/// A column of six numbers in `P` registers, of which the last begins where it ends with them.
type Column<S, const P: usize> = [Lanes<S>; P];

/// Where part `p` of a column begins.
#[inline(always)]
fn begins<S: Simd>(p: usize) -> usize {
    (p * S::F64_LANES).min(6usize.saturating_sub(S::F64_LANES))
}

#[inline(always)]
fn load<S: Simd, const P: usize>(simd: S, column: &[f64; 6]) -> Column<S, P> {
    from_fn(|p| Lanes::load(simd, &column[begins::<S>(p)..]))
}

#[inline(always)]
fn add<S: Simd, const P: usize>(sum: &mut Column<S, P>, column: &Column<S, P>, factor: Lanes<S>) {
    for (sum, part) in sum.iter_mut().zip(column) {
        *sum = sum.plus_product(*part, factor);
    }
}

#[inline(always)]
fn write<S: Simd, const P: usize>(simd: S, of: BetweenTimes) {
    let BetweenTimes {
        tangents: [damping, mass],
        gammas,
        rest,
        scale,
        values,
        stride,
    } = of;
    let times = damping.iter().zip(mass).zip(gammas);
    for (l, ((damping, mass), [gamma_v, gamma_a])) in times.enumerate() {
        let rest = rest.filter(|(k, _)| *k == l).map(|(_, rest)| &rest.data.0);
        let start = |column: usize| match rest {
            Some(rest) => load::<S, P>(simd, &rest[column]),
            None => [Lanes::splat(simd, 0.0); P],
        };
        // A dual matrix is [A B; 0 A].
        for j in 0..3 {
            let (mut left, mut right) = (start(j), start(j + 3));
            for (matrix, gamma) in [(mass, gamma_a), (damping, gamma_v)] {
                for i in 0..3 {
                    let primal = Lanes::splat(simd, gamma.primal[(i, j)]);
                    let dual = Lanes::splat(simd, gamma.dual[(i, j)]);
                    let [first, second] = [i, i + 3].map(|i| load::<S, P>(simd, &matrix.data.0[i]));
                    add(&mut left, &first, primal);
                    add(&mut right, &first, dual);
                    add(&mut right, &second, primal);
                }
            }
            for (component, column) in [(j, left), (j + 3, right)] {
                let to = &mut values[component * stride + 6 * l..][..6];
                let scale = load::<S, P>(simd, &scale.data.0[component]);
                for (p, (part, scale)) in column.into_iter().zip(scale).enumerate() {
                    (part * scale).store(&mut to[begins::<S>(p)..]);
                }
            }
        }
    }
}
