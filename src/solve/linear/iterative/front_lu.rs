//! Factors of a front, kept in single precision: they are a preconditioner's, whose rounding
//! iteration mends, and memory and its traffic are what large meshes are short of. Solutions are
//! sums in double precision, so that the operator is as linear as any.

use super::lanes::Number;
use faer::{ColRef, MatRef};

/// `P F₁₁ = L U` with `U₁₂` and `L₂₁`, where so many unknowns of a front are eliminated.
#[derive(Debug, Clone)]
pub(super) struct FrontLu<N: Number> {
    /// Which row of the front stands where.
    permutation: Vec<usize>,
    /// Of `U`.
    inverse_pivots: Vec<N>,
    /// Below the pivots, column by column: of `L`, and of `L₂₁`.
    lower: Vec<N::Single>,
    /// Above the pivots, column by column: of `U`, and then `U₁₂`.
    upper: Vec<N::Single>,
}

impl<N: Number> FrontLu<N> {
    /// Of `U` and the strict part of `L` beside `U₁₂`, and of `L₂₁`. None if single precision does
    /// not reach as far.
    pub fn new(
        permutation: Vec<usize>,
        upper: MatRef<'_, N>,
        lower: MatRef<'_, N>,
    ) -> Option<Self> {
        let own = upper.nrows();
        let mut below = Vec::with_capacity(own * (own.max(1) - 1) / 2 + own * lower.nrows());
        let mut above =
            Vec::with_capacity(own * (own.max(1) - 1) / 2 + own * (upper.ncols() - own));
        let keep = |kept: &mut Vec<N::Single>, numbers: ColRef<'_, N>| {
            kept.extend(numbers.iter().map(|number| number.single()));
        };
        for j in 0..own {
            keep(&mut below, upper.col(j).subrows(j + 1, own - j - 1));
            keep(&mut below, lower.col(j));
        }
        for j in 0..upper.ncols() {
            keep(&mut above, upper.col(j).subrows(0, j.min(own)));
        }
        let all = below.iter().chain(&above);
        let inverse_pivots = (0..own).map(|j| N::from_real(1.0) / upper[(j, j)]);
        { all }
            .all(|&number| N::double(number).is_finite())
            .then(|| FrontLu {
                permutation,
                inverse_pivots: inverse_pivots.collect(),
                lower: below,
                upper: above,
            })
    }

    /// Bytes that they take.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.lower[..])
            + size_of_val(&self.upper[..])
            + size_of_val(&self.inverse_pivots[..])
    }

    /// How many unknowns are eliminated.
    fn own(&self) -> usize {
        self.inverse_pivots.len()
    }

    /// Solves with `L` for what is eliminated, and subtracts from what follows in `x`, the front's
    /// boundary, what it is coupled with. `own` is memory.
    pub fn forward(&self, x: &mut [N], own: &mut Vec<N>) {
        own.clear();
        own.extend(self.permutation.iter().map(|&row| x[row]));
        x[..self.own()].copy_from_slice(own);
        let mut rest = &self.lower[..];
        for j in 0..self.own() {
            let (&mut known, others) = split_at(x, j);
            let column;
            (column, rest) = rest.split_at(others.len());
            N::subtract_product(others, column, known);
        }
    }

    /// Solves with `U` for what is eliminated, where what follows in `x` is known.
    pub fn backward(&self, x: &mut [N]) {
        let (own, known) = x.split_at_mut(self.own());
        let triangle = own.len() * (own.len().max(1) - 1) / 2;
        let (mut rest, beyond) = self.upper.split_at(triangle);
        for (&known, column) in known.iter().zip(beyond.chunks_exact(own.len().max(1))) {
            N::subtract_product(own, column, known);
        }
        for (j, inverse) in self.inverse_pivots.iter().enumerate().rev() {
            own[j] *= *inverse;
            let column;
            (rest, column) = rest.split_at(rest.len() - j);
            let known = own[j];
            N::subtract_product(&mut own[..j], column, known);
        }
    }
}

/// An entry, and those behind it.
fn split_at<N>(x: &mut [N], j: usize) -> (&mut N, &mut [N]) {
    let (entry, others) = x[j..].split_at_mut(1);
    (&mut entry[0], others)
}
