//! Products of large matrices that make the tangents of a shell element.
//!
//! Factors are kept transposed, a column for each direction of each term, and a row for each
//! direction of each node.

use crate::elements::line_station::{NodeTerms, SecondTerms};
use crate::motion::DualMatrix;
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::{DMatrix, Matrix3};

/// A matrix of three rows for each node, column by column.
pub(super) type Factor = Vec<f64>;

/// Sums of 3×3 blocks, of the linear and angular directions of two nodes: force and moment by
/// displacement and turn.
#[derive(Debug, Clone, Default)]
pub(super) struct Quadrants {
    linear: Factor,
    linear_angular: Factor,
    angular_linear: Factor,
    angular: Factor,
}

impl Quadrants {
    fn clear(&mut self, rows: usize) {
        for quadrant in [
            &mut self.linear,
            &mut self.linear_angular,
            &mut self.angular_linear,
            &mut self.angular,
        ] {
            quadrant.clear();
            quadrant.resize(rows * rows, 0.0);
        }
    }

    /// Adds all to a matrix of 6×6 blocks.
    pub(super) fn add_to(&self, rows: usize, to: &mut DMatrix<f64>) {
        let size = 2 * rows;
        let to = to.as_mut_slice();
        let place = |i: usize| 6 * (i / 3) + i % 3;
        for (quadrant, row, column) in [
            (&self.linear, 0, 0),
            (&self.linear_angular, 0, 3),
            (&self.angular_linear, 3, 0),
            (&self.angular, 3, 3),
        ] {
            for (j, from) in quadrant.chunks_exact(rows).enumerate() {
                let to = &mut to[(place(j) + column) * size..][..size];
                let blocks = to.chunks_exact_mut(6).zip(from.chunks_exact(3));
                for (to, from) in blocks {
                    let to = &mut to[row..row + 3];
                    to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
                }
            }
        }
    }
}

/// The factors.
#[derive(Debug, Clone, Default)]
pub(super) struct Products {
    /// Of the geometric stiffness, primal and dual: `μᵀ νᵀ Sᵀ Tᵀ X Y`.
    geometric: [Factor; 2],
    /// What the nodes' increments do to their own forces.
    own: Vec<DualMatrix>,
    /// `B̂ᵀ`, primal and dual; and the same of the rates.
    pub(super) strains: [[Factor; 2]; 2],
    /// `(𝓗 B̂)ᵀ`: linear and angular rows by linear columns, then by angular ones.
    pub(super) stresses: [Factor; 4],
    pub(super) stiffness: Quadrants,
    pub(super) damping: Quadrants,
}

/// Writes a block of three rows, for a node, and three columns.
pub(super) fn write(
    factor: &mut Factor,
    rows: usize,
    (node, column): (usize, usize),
    block: &Matrix3<f64>,
) {
    for (k, from) in block.data.0.iter().enumerate() {
        factor[(column + k) * rows + 3 * node..][..3].copy_from_slice(from);
    }
}

/// Adds `A Bᵀ` to a quadrant.
fn add_product(to: &mut Factor, rows: usize, a: &[f64], b: &[f64]) {
    let columns = a.len() / rows;
    matmul(
        MatMut::from_column_major_slice_mut(to, rows, rows),
        Accum::Add,
        MatRef::from_column_major_slice(a, rows, columns),
        MatRef::from_column_major_slice(b, rows, columns).transpose(),
        1.0,
        Par::Seq,
    );
}

/// Directions of the six factors of the geometric stiffness.
const FACTORS: usize = 6;

impl Products {
    pub(super) fn clear(&mut self, rows: usize, samples: usize, points: usize) {
        for factor in &mut self.geometric {
            factor.resize(rows * 3 * FACTORS * samples, 0.0);
        }
        self.own.clear();
        self.own.resize(rows / 3, DualMatrix::zeros());
        let all = self.strains.iter_mut().flatten().chain(&mut self.stresses);
        all.for_each(|factor| factor.resize(rows * 6 * points, 0.0));
        self.stiffness.clear(rows);
        self.damping.clear(rows);
    }

    /// Writes the factors of a sample's geometric stiffness, in the frames of the nodes.
    pub(super) fn write_geometric(
        &mut self,
        (sample, samples): (usize, usize),
        (terms, second): (&[NodeTerms], &[SecondTerms]),
        frames: &[DualMatrix],
    ) {
        let rows = 3 * frames.len();
        for (a, ((node, second), frame)) in terms.iter().zip(second).zip(frames).enumerate() {
            let factors = [
                *frame * second.mu.transpose(),
                *frame * second.nu.transpose(),
                *frame * node.strain.transpose(),
                *frame * node.turn.transpose(),
                *frame * second.by_strain,
                *frame * second.by_turn,
            ];
            for (f, factor) in factors.iter().enumerate() {
                let place = (a, 3 * (f * samples + sample));
                write(&mut self.geometric[0], rows, place, &factor.primal);
                write(&mut self.geometric[1], rows, place, &factor.dual);
            }
            self.own[a] += *frame * second.own * frame.transpose();
        }
    }

    /// Adds the geometric stiffness.
    pub(super) fn add_geometric(&mut self, rows: usize) {
        let third = self.geometric[0].len() / FACTORS;
        let [primal, dual] = &self.geometric;
        let (right, right_dual) = (&primal[..4 * third], &dual[..4 * third]);
        let (left, left_dual) = (&primal[2 * third..], &dual[2 * third..]);
        let sums = &mut self.stiffness;
        add_product(&mut sums.linear_angular, rows, left, right);
        add_product(&mut sums.angular, rows, left, right_dual);
        add_product(&mut sums.angular, rows, left_dual, right);
        for (a, own) in self.own.iter().enumerate() {
            for i in 0..3 {
                for j in 0..3 {
                    let at = (3 * a + j) * rows + 3 * a + i;
                    sums.linear_angular[at] += own.primal[(i, j)];
                    sums.angular[at] += own.dual[(i, j)];
                }
            }
        }
        let both = sums.linear_angular.iter();
        sums.angular_linear
            .iter_mut()
            .zip(both)
            .for_each(|(to, from)| *to += from);
    }

    /// Adds `Σ B̂ᵀ (𝓗 B̂)` to a sum.
    pub(super) fn add_material(&mut self, rows: usize, to_damping: bool) {
        let sums = match to_damping {
            true => &mut self.damping,
            false => &mut self.stiffness,
        };
        let [[strain, strain_dual], _] = &self.strains;
        let [linear, angular_linear, linear_angular, angular] = &self.stresses;
        add_product(&mut sums.linear, rows, strain, linear);
        add_product(&mut sums.linear_angular, rows, strain, linear_angular);
        add_product(&mut sums.angular_linear, rows, strain_dual, linear);
        add_product(&mut sums.angular_linear, rows, strain, angular_linear);
        add_product(&mut sums.angular, rows, strain_dual, linear_angular);
        add_product(&mut sums.angular, rows, strain, angular);
    }
}

/// The transpose of a block that was written.
pub(super) fn read(factor: &Factor, rows: usize, (node, column): (usize, usize)) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| factor[(column + i) * rows + 3 * node + j])
}
