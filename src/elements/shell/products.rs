//! Products of large matrices that make the tangents of a shell element.
//!
//! Factors are kept transposed, a column for each direction of each term, and a row for each
//! direction of each node.

use crate::elements::add_block;
use crate::elements::line_station::{NodeTerms, SecondTerms};
use crate::motion::{DualMatrix, transpose};
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::{ArrayStorage, DMatrix, Matrix3, Matrix6};

/// A matrix of three rows for each node, column by column.
pub(super) type Factor = Vec<f64>;

/// Sums of 3×3 blocks, of the linear and angular directions of two nodes: force and moment by
/// displacement and turn, in the element's frames.
#[derive(Debug, Clone, Default)]
pub(super) struct Quadrants {
    linear: Factor,
    linear_angular: Factor,
    /// Left out where all is symmetric.
    angular_linear: Factor,
    angular: Factor,
    /// What is added to both of linear and angular directions; symmetric.
    coupling: Factor,
}

impl Quadrants {
    fn clear(&mut self, rows: usize) {
        for quadrant in [
            &mut self.linear,
            &mut self.linear_angular,
            &mut self.angular_linear,
            &mut self.angular,
            &mut self.coupling,
        ] {
            quadrant.clear();
            quadrant.resize(rows * rows, 0.0);
        }
    }

    /// Adds all to a matrix of 6×6 blocks, in the frames of the nodes; of what is symmetric the
    /// blocks on the diagonal and above it count.
    pub(super) fn add_to(&self, frames: &[DualMatrix], symmetric: bool, to: &mut DMatrix<f64>) {
        let rows = 3 * frames.len();
        let block = |quadrant: &Factor, a: usize, b: usize| {
            let column = |j| {
                let from = &quadrant[(3 * b + j) * rows + 3 * a..][..3];
                [from[0], from[1], from[2]]
            };
            Matrix3::from_array_storage(ArrayStorage([0, 1, 2].map(column)))
        };
        for (b, right) in frames.iter().enumerate() {
            let right = right.transpose();
            let count = if symmetric { b + 1 } else { frames.len() };
            for (a, left) in frames[..count].iter().enumerate() {
                let coupling = block(&self.coupling, a, b);
                let linear_angular = coupling + block(&self.linear_angular, a, b);
                let angular_linear = coupling
                    + if symmetric {
                        transpose(&block(&self.linear_angular, b, a))
                    } else {
                        block(&self.angular_linear, a, b)
                    };
                // Forces and moments each are a dual matrix that acts on increments.
                let by_increments = |linear: Matrix3<f64>, angular: Matrix3<f64>| {
                    let both = DualMatrix {
                        primal: linear,
                        dual: angular,
                    };
                    both * right
                };
                let force = by_increments(block(&self.linear, a, b), linear_angular);
                let moment = by_increments(angular_linear, block(&self.angular, a, b));
                let columns = |force: &Matrix3<f64>, moment: &Matrix3<f64>| {
                    let both = DualMatrix {
                        primal: *force,
                        dual: *moment,
                    };
                    *left * both
                };
                let by_displacement = columns(&force.primal, &moment.primal);
                let by_turn = columns(&force.dual, &moment.dual);
                let mut sum = Matrix6::zeros();
                for j in 0..3 {
                    for i in 0..3 {
                        let out = &mut sum.data.0;
                        out[j][i] = by_displacement.primal.data.0[j][i];
                        out[j][i + 3] = by_displacement.dual.data.0[j][i];
                        out[j + 3][i] = by_turn.primal.data.0[j][i];
                        out[j + 3][i + 3] = by_turn.dual.data.0[j][i];
                    }
                }
                add_block(to, (a, b), &sum);
                if symmetric && a < b {
                    add_block(to, (b, a), &transpose(&sum));
                }
            }
        }
    }
}

/// The factors, in the element's frames.
#[derive(Debug, Clone, Default)]
pub(super) struct Products {
    /// Of the geometric stiffness, primal and dual: `μᵀ νᵀ Sᵀ Tᵀ X Y`.
    geometric: [Factor; 2],
    /// Transposed variations of the samples' rates, primal and dual.
    rates: [Factor; 2],
    /// What the nodes' increments do to their own forces.
    own: Vec<DualMatrix>,
    /// `B̂ᵀ`, primal and dual; and the same of the rates.
    pub(super) strains: [[Factor; 2]; 2],
    /// `(𝓗 B̂)ᵀ`: linear and angular rows by linear columns, then by angular ones.
    pub(super) stresses: [Factor; 4],
    /// What velocities in ξ and η vary by at one point, transposed.
    pub(super) of_point: Factor,
    pub(super) stiffness: Quadrants,
    pub(super) damping: Quadrants,
}

/// Writes the transpose of a block in three rows, for a node, and three columns.
fn write(factor: &mut Factor, rows: usize, (node, column): (usize, usize), block: &Matrix3<f64>) {
    for (k, from) in transpose(block).data.0.iter().enumerate() {
        factor[(column + k) * rows + 3 * node..][..3].copy_from_slice(from);
    }
}

/// Adds `A Bᵀ` to a quadrant, or of a symmetric one at least to the blocks on the diagonal and
/// above it.
fn add_product(to: &mut Factor, rows: usize, symmetric: bool, a: &[f64], b: &[f64]) {
    let columns = a.len() / rows;
    let a = MatRef::from_column_major_slice(a, rows, columns);
    let b = MatRef::from_column_major_slice(b, rows, columns);
    let mut to = MatMut::from_column_major_slice_mut(to, rows, rows);
    let tile = if symmetric { TILE.min(rows) } else { rows };
    for first in (0..rows).step_by(tile) {
        let width = tile.min(rows - first);
        let height = if symmetric { first + width } else { rows };
        matmul(
            to.as_mut().submatrix_mut(0, first, height, width),
            Accum::Add,
            a.subrows(0, height),
            b.subrows(first, width).transpose(),
            1.0,
            Par::Seq,
        );
    }
}

/// Columns of a symmetric product that are found together: whole blocks.
const TILE: usize = 24;

/// Directions of the six factors of the geometric stiffness.
const FACTORS: usize = 6;

impl Products {
    pub(super) fn clear(&mut self, rows: usize, samples: usize, points: usize) {
        for factor in &mut self.geometric {
            factor.resize(rows * 3 * FACTORS * samples, 0.0);
        }
        for factor in &mut self.rates {
            factor.resize(rows * 3 * samples, 0.0);
        }
        self.own.clear();
        self.own.resize(rows / 3, DualMatrix::zeros());
        let all = self.strains.iter_mut().flatten().chain(&mut self.stresses);
        all.for_each(|factor| factor.resize(rows * 6 * points, 0.0));
        self.stiffness.clear(rows);
        self.damping.clear(rows);
    }

    /// Writes the factors of a sample.
    pub(super) fn write_sample(
        &mut self,
        (sample, samples): (usize, usize),
        terms: &[NodeTerms],
        second: impl Iterator<Item = SecondTerms>,
        rates_vary: bool,
    ) {
        let rows = 3 * terms.len();
        for (a, (node, second)) in terms.iter().zip(second).enumerate() {
            let factors = [
                &second.mu,
                &second.nu,
                &node.strain,
                &node.turn,
                &second.by_strain.transpose(),
                &second.by_turn.transpose(),
            ];
            for (f, factor) in factors.iter().enumerate() {
                let place = (a, 3 * (f * samples + sample));
                write(&mut self.geometric[0], rows, place, &factor.primal);
                write(&mut self.geometric[1], rows, place, &factor.dual);
            }
            if rates_vary {
                write(&mut self.rates[0], rows, (a, 3 * sample), &node.rate.primal);
                write(&mut self.rates[1], rows, (a, 3 * sample), &node.rate.dual);
            }
            self.own[a] += second.own;
        }
    }

    /// Transposed variations of the samples' strains and of their rates, each primal and dual, and
    /// those of the Gauss points, to be written.
    pub(super) fn of_samples_and_points(&mut self) -> [([&[f64]; 2], &mut [Factor; 2]); 2] {
        let third = self.geometric[0].len() / FACTORS;
        let [primal, dual] = &self.geometric;
        let strains = [primal, dual].map(|factor| &factor[2 * third..3 * third]);
        let rates = [&self.rates[0][..], &self.rates[1][..]];
        let [at_points, rates_at_points] = &mut self.strains;
        [(strains, at_points), (rates, rates_at_points)]
    }

    /// Adds the geometric stiffness.
    pub(super) fn add_geometric(&mut self, rows: usize, symmetric: bool) {
        let third = self.geometric[0].len() / FACTORS;
        let [primal, dual] = &self.geometric;
        let (right, right_dual) = (&primal[..4 * third], &dual[..4 * third]);
        let (left, left_dual) = (&primal[2 * third..], &dual[2 * third..]);
        let sums = &mut self.stiffness;
        add_product(&mut sums.coupling, rows, symmetric, left, right);
        add_product(&mut sums.angular, rows, symmetric, left, right_dual);
        add_product(&mut sums.angular, rows, symmetric, left_dual, right);
        for (a, own) in self.own.iter().enumerate() {
            for i in 0..3 {
                for j in 0..3 {
                    let at = (3 * a + j) * rows + 3 * a + i;
                    sums.coupling[at] += own.primal[(i, j)];
                    sums.angular[at] += own.dual[(i, j)];
                }
            }
        }
    }

    /// Adds `Σ B̂ᵀ (𝓗 B̂)` to a sum.
    pub(super) fn add_material(&mut self, rows: usize, symmetric: bool, to_damping: bool) {
        let sums = match to_damping {
            true => &mut self.damping,
            false => &mut self.stiffness,
        };
        let [[strain, strain_dual], _] = &self.strains;
        let [linear, angular_linear, linear_angular, angular] = &self.stresses;
        add_product(&mut sums.linear, rows, symmetric, strain, linear);
        add_product(
            &mut sums.linear_angular,
            rows,
            false,
            strain,
            linear_angular,
        );
        if !symmetric {
            add_product(&mut sums.angular_linear, rows, false, strain_dual, linear);
            add_product(
                &mut sums.angular_linear,
                rows,
                false,
                strain,
                angular_linear,
            );
        }
        add_product(
            &mut sums.angular,
            rows,
            symmetric,
            strain_dual,
            linear_angular,
        );
        add_product(&mut sums.angular, rows, symmetric, strain, angular);
    }
}

/// A block that was written.
pub(super) fn read(factor: &Factor, rows: usize, (node, column): (usize, usize)) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| factor[(column + i) * rows + 3 * node + j])
}
