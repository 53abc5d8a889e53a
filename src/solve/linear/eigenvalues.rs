//! Eigenvalues of dense real matrices.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, EvdParams, evd_real, evd_scratch};
use faer::{Auto, Mat, Par, Spec, c64};

/// Eigenvalues, and a vector of each; `None` if they are not found.
///
/// By the plain QR iteration: faer's blocked one, which would take over for larger matrices, may
/// exchange blocks of equal eigenvalues for ever.
pub(crate) fn eigenvectors(matrix: &Mat<f64>) -> Option<(Vec<c64>, Mat<c64>)> {
    let size = matrix.nrows();
    let mut params = <EvdParams as Auto<f64>>::auto();
    params.schur.blocking_threshold = usize::MAX;
    let params = Spec::new(params);
    let (none, all) = (ComputeEigenvectors::No, ComputeEigenvectors::Yes);
    let mut memory = MemBuffer::new(evd_scratch::<f64>(size, none, all, Par::Seq, params));
    let (mut re, mut im) = (Diag::zeros(size), Diag::zeros(size));
    let mut parts = Mat::zeros(size, size);
    evd_real(
        matrix.as_ref(),
        re.as_mut(),
        im.as_mut(),
        None,
        Some(parts.as_mut()),
        Par::Seq,
        MemStack::new(&mut memory),
        params,
    )
    .ok()?;
    let values = re.column_vector().iter().zip(im.column_vector().iter());
    let values: Vec<c64> = values.map(|(re, im)| c64::new(*re, *im)).collect();
    // Of a conjugate pair, the first column is the real part and the second the imaginary part of
    // the first vector.
    let vectors = Mat::from_fn(size, size, |i, j| {
        let im = values[j].im;
        if im > 0.0 && j + 1 < size {
            c64::new(parts[(i, j)], parts[(i, j + 1)])
        } else if im < 0.0 && j > 0 {
            c64::new(parts[(i, j - 1)], -parts[(i, j)])
        } else {
            c64::new(parts[(i, j)], 0.0)
        }
    });
    Some((values, vectors))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation of each plane `2i, 2i + 1` by an angle that is one of three, in a basis that
    /// mixes the planes.
    fn rotations(planes: usize) -> (Mat<f64>, Vec<f64>) {
        let size = 2 * planes;
        let angles: Vec<f64> = (0..planes).map(|i| 0.4 + 0.7 * (i % 3) as f64).collect();
        let plain = Mat::from_fn(size, size, |i, j| {
            let (sine, cosine) = angles[i / 2].sin_cos();
            match (i / 2 == j / 2, i, j) {
                (false, ..) => 0.0,
                (_, i, j) if i == j => cosine,
                (_, i, j) if i < j => -sine,
                _ => sine,
            }
        });
        // A reflection, which is its own inverse.
        let w = Mat::from_fn(size, 1, |i, _| (0.3 + i as f64).sin());
        let factor = 2.0 / w.squared_norm_l2();
        let mirror = Mat::<f64>::identity(size, size) - &w * w.transpose() * factor;
        (&mirror * plain * &mirror, angles)
    }

    #[test]
    fn equal_eigenvalues_are_all_found_with_their_vectors() {
        for planes in [1, 6, 60, 120] {
            let (matrix, angles) = rotations(planes);
            let (values, vectors) = eigenvectors(&matrix).unwrap();
            let mut found: Vec<f64> = values.iter().map(|s| s.im.atan2(s.re)).collect();
            let mut expected: Vec<f64> = angles.iter().flat_map(|a| [*a, -a]).collect();
            found.sort_by(f64::total_cmp);
            expected.sort_by(f64::total_cmp);
            for (a, b) in found.iter().zip(&expected) {
                assert!((a - b).abs() < 1e-12, "{planes}: {a} {b}");
            }
            let product = Mat::from_fn(matrix.nrows(), matrix.nrows(), |i, j| {
                let row = (0..matrix.nrows()).map(|k| vectors[(k, j)] * matrix[(i, k)]);
                row.sum::<c64>() - values[j] * vectors[(i, j)]
            });
            let size = |m: &Mat<c64>| m.norm_max();
            assert!(size(&product) < 1e-12 * size(&vectors), "{planes}");
        }
        assert!(eigenvectors(&Mat::zeros(0, 0)).unwrap().0.is_empty());
    }
}
