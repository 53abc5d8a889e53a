//! How hub and supports of a rotor of like blades may move (docs/theory.md, section 8.10).

use crate::system::Layout;
use nalgebra::{Complex, Matrix6, Vector6};
use std::f64::consts::TAU;

/// Motions that are alike: `u(t) = T u(t + T/B)`, scaled, of the nodes of hub and supports; none of
/// those of the blade, which are any.
#[derive(Debug, Clone)]
pub struct AlikeMotions {
    blades: usize,
    nodes: Vec<Option<Matrix6<f64>>>,
}

impl AlikeMotions {
    /// Of so many blades, with `T` of each node of hub and supports.
    pub(super) fn new(blades: usize, nodes: Vec<Option<Matrix6<f64>>>) -> Self {
        AlikeMotions { blades, nodes }
    }

    /// The number of blades.
    pub fn blades(&self) -> usize {
        self.blades
    }

    /// `T` of a node of hub and supports.
    pub fn of_node(&self, node: usize) -> Option<&Matrix6<f64>> {
        self.nodes[node].as_ref()
    }

    /// What a harmonic of a node's motions may be: the projection on it; none if it may be any.
    pub fn projection(&self, node: usize, harmonic: usize) -> Option<Matrix6<Complex<f64>>> {
        let step = self.nodes[node]?.map(Complex::from);
        let turn = Complex::from_polar(1.0, TAU * harmonic as f64 / self.blades as f64);
        let mut power = Matrix6::identity();
        let mut sum = Matrix6::zeros();
        for _ in 0..self.blades {
            sum += power;
            power = power * step * turn;
        }
        Some(sum / Complex::from(self.blades as f64))
    }

    /// Takes from forces on the nodes what does no work on motions that are alike.
    pub fn average(&self, layout: Layout, forces: &mut [f64]) {
        let part = layout.points() / self.blades;
        for (node, step) in self.nodes.iter().enumerate() {
            let Some(step) = step else {
                continue;
            };
            let Some(back) = step.try_inverse() else {
                continue;
            };
            for k in 0..part {
                let at = |q: usize| layout.motion(node, k + q * part);
                // f(t) = T⁻ᵀ f(t + T/B)
                let mut sum = Vector6::zeros();
                for q in (0..self.blades).rev() {
                    sum = back.tr_mul(&sum) + Vector6::from_column_slice(&forces[at(q)]);
                }
                sum /= self.blades as f64;
                for q in 0..self.blades {
                    forces[at(q)].copy_from_slice(sum.as_slice());
                    sum = step.tr_mul(&sum);
                }
            }
        }
    }
}
