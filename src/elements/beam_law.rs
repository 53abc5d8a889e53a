//! Stress resultants of a beam element whose section changes along it.
//!
//! Strains are sampled at the Gauss points, one fewer than nodes, and resultants `s = Σ L_i s_i` interpolated from there, so
//! that neither locks. The section enters through its flexibility, integrated piece by piece:
//!
//! ```text
//! Σ_j F_ij s_j = w_i ε_i,   F_ij = ∫ L_i L_j 𝒦⁻¹ ds
//! ```
//!
//! with the length `w_i` that Gauss point i stands for. Resultants are smooth where sections are not: that is why few elements
//! suffice. With the strain that belongs to them, `𝒦⁻¹ s`, and its rate, sectional damping `𝒟` dissipates
//! `∫ ṡᵀ 𝒦⁻ᵀ 𝒟 𝒦⁻¹ ṡ ds`. A uniform section gives each point its own law again.

use super::beam::Station;
use super::section::Section;
use super::shape::shape_functions;
use super::{OtherStation, StressLaw};
use crate::error::{Error, ErrorKind, Result};
use nalgebra::{DMatrix, Matrix6, Vector6};

/// Resultants of all Gauss points by their strains: `f_i = Σ_j S_ij e_j + D_ij ė_j`, integrated, for "velocities in ξ".
#[derive(Debug, Clone)]
pub(super) struct CoupledLaw {
    points: usize,
    /// `(S_ij, D_ij)`, row by row.
    blocks: Vec<(Matrix6<f64>, Matrix6<f64>)>,
}

/// Sums over the pieces of an element.
pub(super) struct Flexibility {
    /// The Gauss points.
    points: Vec<f64>,
    flexibility: DMatrix<f64>,
    damping: DMatrix<f64>,
}

impl Flexibility {
    /// Nothing yet; resultants are interpolated from `points`.
    pub fn new(points: Vec<f64>) -> Self {
        let size = 6 * points.len();
        Flexibility {
            points,
            flexibility: DMatrix::zeros(size, size),
            damping: DMatrix::zeros(size, size),
        }
    }

    /// Adds a section at `xi` that stands for so much length.
    ///
    /// # Errors
    /// If its stiffness is not positive definite, as a damaged file may have it.
    pub fn add(&mut self, xi: f64, section: &Section, length: f64) -> Result<()> {
        let flexibility = inverse(&section.stiffness)?;
        let damping = flexibility.transpose() * section.damping * flexibility;
        let shapes = shape_functions(&self.points, xi);
        for (i, a) in shapes.iter().enumerate() {
            for (j, b) in shapes.iter().enumerate() {
                let factor = a.0 * b.0 * length;
                let at = (6 * i, 6 * j);
                let mut view = self.flexibility.fixed_view_mut::<6, 6>(at.0, at.1);
                view += flexibility * factor;
                let mut view = self.damping.fixed_view_mut::<6, 6>(at.0, at.1);
                view += damping * factor;
            }
        }
        Ok(())
    }

    /// The law of these Gauss points.
    ///
    /// # Errors
    /// As [`Flexibility::add`].
    pub fn law(self, stations: &[Station]) -> Result<CoupledLaw> {
        let size = self.flexibility.nrows();
        // Scaled, as entries of stretching and bending differ by orders of magnitude.
        let scale = DMatrix::from_diagonal(&self.flexibility.diagonal().map(|x| 1.0 / x.sqrt()));
        let inverse = (&scale * self.flexibility * &scale).cholesky();
        let inverse = inverse.ok_or_else(not_definite)?.inverse();
        let weights = DMatrix::from_fn(size, size, |i, j| match i == j {
            true => stations[i / 6].weight,
            false => 0.0,
        });
        let to_resultants = &scale * inverse * &scale * &weights;
        let stiffness = weights * &to_resultants;
        let damping = to_resultants.transpose() * self.damping * &to_resultants;
        let points = stations.len();
        let block = |m: &DMatrix<f64>, i: usize, j: usize| -> Matrix6<f64> {
            m.fixed_view::<6, 6>(6 * i, 6 * j).into_owned()
        };
        let pairs = (0..points).flat_map(|i| (0..points).map(move |j| (i, j)));
        Ok(CoupledLaw {
            points,
            blocks: pairs
                .map(|(i, j)| (block(&stiffness, i, j), block(&damping, i, j)))
                .collect(),
        })
    }
}

impl CoupledLaw {
    /// What gives resultants at point `i`, for all points.
    pub fn row(&self, i: usize) -> &[(Matrix6<f64>, Matrix6<f64>)] {
        &self.blocks[i * self.points..][..self.points]
    }

    /// Integrated resultants at point `i`, elastic and viscous.
    pub fn resultants(
        &self,
        i: usize,
        strains: &[Vector6<f64>],
        rates: &[Vector6<f64>],
    ) -> (Vector6<f64>, Vector6<f64>) {
        let mut sums = (Vector6::zeros(), Vector6::zeros());
        for ((stiffness, damping), (strain, rate)) in
            self.row(i).iter().zip(strains.iter().zip(rates))
        {
            sums.0 += stiffness * strain;
            sums.1 += damping * rate;
        }
        sums
    }

    /// The same as [`StressLaw`]s.
    pub fn stress_laws(&self) -> Vec<StressLaw> {
        (0..self.points)
            .map(|i| {
                let (stiffness, damping) = self.row(i)[i];
                let others = (0..self.points).filter(|&j| j != i).map(|j| {
                    let (stiffness, damping) = self.row(i)[j];
                    OtherStation {
                        offset: j as isize - i as isize,
                        stiffness,
                        damping,
                    }
                });
                StressLaw {
                    stiffness,
                    damping,
                    others: others.collect(),
                }
            })
            .collect()
    }
}

/// The flexibility of a section.
pub(super) fn inverse(stiffness: &Matrix6<f64>) -> Result<Matrix6<f64>> {
    let scale = Matrix6::from_diagonal(&stiffness.diagonal().map(|x| 1.0 / x.sqrt()));
    let scaled = (scale * stiffness * scale).cholesky();
    Ok(scale * scaled.ok_or_else(not_definite)?.inverse() * scale)
}

fn not_definite() -> Error {
    let message = "sections: expected a positive-definite stiffness all along, got one that is not";
    Error::new(ErrorKind::Value, message)
}
