//! Stress resultants of a beam element whose section changes along it.
//!
//! Strains are sampled at the Gauss points, one fewer than nodes, so that nothing locks. The
//! section enters by its integrals, piece by piece from station to station of its table, in two
//! ways:
//!
//! ```text
//! strains interpolated, ε = Σ L_i ε_i:
//!     f_i = Σ_j A_ij ε_j,   A_ij = ∫ L_i L_j 𝒦 ds
//! resultants interpolated, s = Σ L_i s_i:
//!     w_i ε_i = Σ_j F_ij s_j,   F_ij = ∫ L_i L_j 𝒦⁻¹ ds,   f_i = w_i s_i
//! ```
//!
//! with the length `w_i` that Gauss point i stands for. The first is too stiff (Voigt's bound); the
//! second too soft, and where the section vanishes towards a tip it makes all of the element soft
//! against strains that alternate (Reuss's). Their mean is Hill's: with few elements it is more
//! accurate than the first, and at least half as stiff. Damping is that of `𝒟` under the strains of
//! each. A uniform section gives each point its own law again. See docs/theory.md, section 6.6.

use super::circulatory;
use crate::elements::section::Section;
use crate::elements::shape::shape_functions;
use crate::elements::{OtherStation, StressLaw};
use crate::error::{Error, ErrorKind, Result};
use nalgebra::{DMatrix, Matrix6, Vector6};

/// Resultants of all Gauss points by their strains: `f_i = Σ_j S_ij e_j + D_ij ė_j`, integrated,
/// for "velocities in ξ".
#[derive(Debug, Clone)]
pub(super) struct CoupledLaw {
    points: usize,
    /// `(S_ij, D_ij)`, row by row.
    blocks: Vec<(Matrix6<f64>, Matrix6<f64>)>,
}

/// Integrals over an element.
pub(super) struct LawIntegrals {
    /// The Gauss points, and their weights in ξ.
    rule: Vec<(f64, f64)>,
    /// `A`, and the same of the damping.
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
    /// `F`, and `∫ L_i L_j 𝒦⁻ᵀ 𝒟 𝒦⁻¹ ds`.
    flexibility: DMatrix<f64>,
    dissipation: DMatrix<f64>,
}

impl LawIntegrals {
    /// Nothing yet, for these Gauss points.
    pub fn new(rule: Vec<(f64, f64)>) -> Self {
        let zero = DMatrix::zeros(6 * rule.len(), 6 * rule.len());
        LawIntegrals {
            rule,
            stiffness: zero.clone(),
            damping: zero.clone(),
            flexibility: zero.clone(),
            dissipation: zero,
        }
    }

    /// Adds a section at `xi`, where the reference line has so much length for each unit of ξ, with
    /// this weight in ξ.
    ///
    /// # Errors
    /// If its stiffness is not positive definite, as a damaged file may have it.
    pub fn add(&mut self, xi: f64, section: &Section, stretch: f64, weight: f64) -> Result<()> {
        let flexibility = inverse(&section.stiffness)?;
        let dissipation = flexibility.transpose() * section.damping * flexibility;
        let points: Vec<f64> = self.rule.iter().map(|point| point.0).collect();
        let shapes = shape_functions(&points, xi);
        for (i, a) in shapes.iter().enumerate() {
            for (j, b) in shapes.iter().enumerate() {
                let product = a.0 * b.0 * weight;
                for (sum, section, factor) in [
                    (&mut self.stiffness, &section.stiffness, product / stretch),
                    (&mut self.damping, &section.damping, product / stretch),
                    (&mut self.flexibility, &flexibility, product * stretch),
                    (&mut self.dissipation, &dissipation, product * stretch),
                ] {
                    let mut view = sum.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                    view += section * factor;
                }
            }
        }
        Ok(())
    }

    /// The mean of both laws.
    ///
    /// # Errors
    /// As [`LawIntegrals::add`].
    pub fn law(self) -> Result<CoupledLaw> {
        let points = self.rule.len();
        // Scaled, as entries of stretching and bending differ by orders of magnitude.
        let scale = DMatrix::from_diagonal(&self.flexibility.diagonal().map(|x| 1.0 / x.sqrt()));
        let inverse = (&scale * self.flexibility * &scale).cholesky();
        let inverse = inverse.ok_or_else(not_definite)?.inverse();
        let weights = DMatrix::from_fn(6 * points, 6 * points, |i, j| match i == j {
            true => self.rule[i / 6].1,
            false => 0.0,
        });
        let to_resultants = &scale * inverse * &scale * &weights;
        let soft = weights * &to_resultants;
        let soft_damping = to_resultants.transpose() * self.dissipation * &to_resultants;
        let stiffness = (self.stiffness + soft) * 0.5;
        let damping = (self.damping + soft_damping) * 0.5;
        let pairs = (0..points).flat_map(|i| (0..points).map(move |j| (6 * i, 6 * j)));
        let block = |m: &DMatrix<f64>, at: (usize, usize)| -> Matrix6<f64> {
            m.fixed_view::<6, 6>(at.0, at.1).into_owned()
        };
        Ok(CoupledLaw {
            points,
            blocks: pairs
                .map(|at| (block(&stiffness, at), block(&damping, at)))
                .collect(),
        })
    }
}

/// The flexibility of a section.
fn inverse(stiffness: &Matrix6<f64>) -> Result<Matrix6<f64>> {
    let scale = Matrix6::from_diagonal(&stiffness.diagonal().map(|x| 1.0 / x.sqrt()));
    let scaled = (scale * stiffness * scale).cholesky();
    Ok(scale * scaled.ok_or_else(not_definite)?.inverse() * scale)
}

fn not_definite() -> Error {
    let message = "sections: expected a positive-definite stiffness all along, got one that is not";
    Error::new(ErrorKind::Value, message)
}

impl CoupledLaw {
    /// Adds what damping does where the material spins at this rate.
    pub fn add_circulatory(&mut self, rate: f64) {
        for (stiffness, damping) in &mut self.blocks {
            *stiffness += circulatory(damping, rate);
        }
    }

    /// What gives resultants at point `i`, for all points.
    pub fn row(&self, i: usize) -> &[(Matrix6<f64>, Matrix6<f64>)] {
        &self.blocks[i * self.points..][..self.points]
    }

    /// Integrated resultants at point `i`.
    pub fn resultants(
        &self,
        i: usize,
        strains: &[Vector6<f64>],
        rates: &[Vector6<f64>],
    ) -> Vector6<f64> {
        let states = strains.iter().zip(rates);
        let laws = self.row(i).iter().zip(states);
        laws.map(|((stiffness, damping), (strain, rate))| stiffness * strain + damping * rate)
            .sum()
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
