//! Bases of subspaces that change over a period, turned so that they change as little as they can:
//! what is arbitrary in a basis at one time would make its harmonics fall slowly. See
//! docs/theory.md, section 8.5.

use nalgebra::{DMatrix, DVector};
use std::f64::consts::PI;

/// Sines below this are of no turn, or of half a turn.
const NO_TURN: f64 = 1e-8;

/// Turns orthonormal `bases` of subspaces of one dimension, at the points of a grid, within their
/// subspaces: each is as near to the one before as can be, and what is left after a period is
/// spread over it.
pub(super) fn transport(bases: &mut [DMatrix<f64>]) {
    if bases.first().is_none_or(|basis| basis.ncols() == 0) {
        return;
    }
    for k in 1..bases.len() {
        let (before, rest) = bases.split_at_mut(k);
        let turn = nearest_rotation(rest[0].tr_mul(&before[k - 1]));
        rest[0] = &rest[0] * turn;
    }
    let (Some(first), Some(last)) = (bases.first(), bases.last()) else {
        return;
    };
    let around = nearest_rotation(first.tr_mul(last));
    let (directions, angles) = planes(around);
    let count = bases.len() as f64;
    for (k, basis) in bases.iter_mut().enumerate() {
        *basis = &*basis * &directions;
        for &(i, j, angle) in &angles {
            turn_back(basis, (i, j), angle * k as f64 / count);
        }
    }
}

/// The orthogonal matrix nearest to `m`.
fn nearest_rotation(m: DMatrix<f64>) -> DMatrix<f64> {
    let size = m.nrows();
    let svd = m.svd(true, true);
    match (svd.u, svd.v_t) {
        (Some(u), Some(v)) => u * v,
        _ => DMatrix::identity(size, size),
    }
}

/// Columns `i` and `j` turned by `-angle`.
fn turn_back(basis: &mut DMatrix<f64>, (i, j): (usize, usize), angle: f64) {
    let (sine, cosine) = angle.sin_cos();
    for row in 0..basis.nrows() {
        let (a, b) = (basis[(row, i)], basis[(row, j)]);
        basis[(row, i)] = cosine * a - sine * b;
        basis[(row, j)] = sine * a + cosine * b;
    }
}

/// Orthonormal columns, and those pairs of them in whose planes an orthogonal matrix turns, with
/// the angles. A direction that it reverses alone is left out.
fn planes(orthogonal: DMatrix<f64>) -> (DMatrix<f64>, Vec<(usize, usize, f64)>) {
    let size = orthogonal.nrows();
    // Its planes are those of its symmetric part, in pairs of directions.
    let symmetric = (&orthogonal + orthogonal.transpose()) * 0.5;
    let mut left = symmetric.symmetric_eigen().eigenvectors;
    let mut found: Vec<DVector<f64>> = Vec::with_capacity(size);
    let (mut angles, mut reversed) = (Vec::new(), None);
    while found.len() < size {
        let longest = (0..size).max_by(|&a, &b| {
            let square = |i: usize| left.column(i).norm_squared();
            square(a).total_cmp(&square(b))
        });
        let v = left.column(longest.unwrap_or(0)).normalize();
        let turned = &orthogonal * &v;
        let cosine = v.dot(&turned);
        let mut w = turned - &v * cosine;
        found.iter().for_each(|u| w -= u * u.dot(&w));
        let (at, sine) = (found.len(), w.norm());
        found.push(v);
        if sine > NO_TURN && found.len() < size {
            angles.push((at, at + 1, sine.atan2(cosine)));
            found.push(w / sine);
        } else if cosine < 0.0 {
            match reversed.take() {
                Some(other) => angles.push((other, at, PI)),
                None => reversed = Some(at),
            }
        }
        for u in &found[at..] {
            let along = u.tr_mul(&left);
            left -= u * along;
        }
    }
    (DMatrix::from_columns(&found), angles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix3;
    use std::f64::consts::TAU;

    const POINTS: usize = 41;

    /// Orthonormal directions of a frame that turns by `turns` beside one that rests: motions of
    /// two bodies that a hinge leaves, in their own frames, with bases that are any at each time.
    fn hinge(turns: impl Fn(f64) -> f64) -> Vec<DMatrix<f64>> {
        let basis = |k: usize| {
            let (sine, cosine) = turns(k as f64 / POINTS as f64).sin_cos();
            let turn = Matrix3::new(cosine, sine, 0.0, -sine, cosine, 0.0, 0.0, 0.0, 1.0);
            let mut basis = DMatrix::zeros(6, 3);
            basis.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            basis.fixed_view_mut::<3, 3>(3, 0).copy_from(&turn);
            let any = DMatrix::from_fn(3, 3, |i, j| (1.0 + (7 * k + 3 * i + 5 * j) as f64).sin());
            basis * any.qr().q() / 2.0f64.sqrt()
        };
        (0..POINTS).map(basis).collect()
    }

    /// Largest step from one basis to the next, and whether all span what they did.
    fn check(before: &[DMatrix<f64>], after: &[DMatrix<f64>], step: f64) {
        for (k, (old, new)) in before.iter().zip(after).enumerate() {
            let lost = new - old * old.tr_mul(new);
            assert!(lost.norm() < 1e-12, "{k}: {:e}", lost.norm());
            let gram = new.tr_mul(new) - DMatrix::identity(new.ncols(), new.ncols());
            assert!(gram.norm() < 1e-12, "{k}: {:e}", gram.norm());
            let change = (new - &after[(k + 1) % after.len()]).norm();
            assert!(change < step, "{k}: {change}");
        }
    }

    #[test]
    fn bases_change_as_little_as_they_can() {
        // At rest, swinging, and by whole turns: half of each is left to the bases, which come
        // back as they were or reversed. Bounds: the turn of a step, of both directions across.
        let swing = |t: f64| 0.5 * (TAU * t).sin();
        let step = TAU / POINTS as f64;
        let cases: [(&dyn Fn(f64) -> f64, f64); 4] = [
            (&|_| 0.3, 1e-12),
            (&swing, 0.5 * step),
            (&|t| TAU * t + swing(t), 1.6 * step),
            (&|t| 2.0 * TAU * t, 2.1 * step),
        ];
        for (turns, bound) in cases {
            let before = hinge(turns);
            let mut after = before.clone();
            transport(&mut after);
            check(&before, &after, bound);
        }
    }

    #[test]
    fn a_direction_that_comes_back_reversed_alone_is_kept() {
        // A Moebius strip.
        let strip = |k: usize| {
            let angle = TAU / 2.0 * k as f64 / POINTS as f64;
            DMatrix::from_column_slice(2, 1, &[angle.cos(), angle.sin()])
        };
        let mut bases: Vec<_> = (0..POINTS).map(strip).collect();
        transport(&mut bases);
        for (k, basis) in bases.iter().enumerate() {
            assert!(
                (basis.tr_mul(&strip(k))[0].abs() - 1.0).abs() < 1e-12,
                "{k}"
            );
        }
    }
}
