//! Products of large matrices that make the tangents of a shell element.
//!
//! Factors are kept transposed, a column for each direction of each term, and a row for each
//! direction of each node: the first direction of all nodes, then the second, then the third.

use crate::elements::contribution::add_block;
use crate::elements::line_station::NodeTerms;
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
    /// entries on the diagonal and above it count, and `forces` on the frames, component by
    /// component, if there are any: increments of one node do not commute, `K_aa − K_aaᵀ = f̃_a`.
    pub(super) fn add_to(
        &self,
        frames: &[DualMatrix],
        symmetric: bool,
        forces: &[f64],
        to: &mut DMatrix<f64>,
    ) {
        let count = frames.len();
        let rows = 3 * count;
        let block = |quadrant: &Factor, a: usize, b: usize| {
            let entry = |i, j| quadrant[(j * count + b) * rows + i * count + a];
            let column = |j| [entry(0, j), entry(1, j), entry(2, j)];
            Matrix3::from_array_storage(ArrayStorage([column(0), column(1), column(2)]))
        };
        // Of what is symmetric there is what is on the diagonal of the sum and above it.
        let own = |quadrant: &Factor, a: usize, b: usize| {
            let below = block(quadrant, a, b);
            if !symmetric {
                return below;
            }
            let above = block(quadrant, b, a);
            Matrix3::from_fn(|i, j| match i * count + a <= j * count + b {
                true => below[(i, j)],
                false => above[(j, i)],
            })
        };
        for (b, right) in frames.iter().enumerate() {
            let right = right.transpose();
            let above = if symmetric { b + 1 } else { count };
            for (a, left) in frames[..above].iter().enumerate() {
                let [force, moment] = match a == b && symmetric && !forces.is_empty() {
                    true => [0, 3].map(|first| below_diagonal(forces, first, count, a)),
                    false => [Matrix3::zeros(); 2],
                };
                let coupling = own(&self.coupling, a, b) + force;
                let angular = own(&self.angular, a, b) + moment;
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
                let force = by_increments(own(&self.linear, a, b), linear_angular);
                let moment = by_increments(angular_linear, angular);
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

/// The part of `ã` below its diagonal, for three components of the forces on a node.
fn below_diagonal(forces: &[f64], first: usize, count: usize, node: usize) -> Matrix3<f64> {
    let [x, y, z] = [0, 1, 2].map(|i| forces[(first + i) * count + node]);
    Matrix3::new(0.0, 0.0, 0.0, z, 0.0, 0.0, -y, x, 0.0)
}

/// The factors, in the element's frames.
#[derive(Debug, Clone, Default)]
pub(super) struct Products {
    /// Of the geometric stiffness, primal and dual: `μᵀ νᵀ Sᵀ Tᵀ X Y`.
    pub(super) geometric: [Factor; 2],
    /// Transposed variations of the samples' rates, primal and dual.
    rates: [Factor; 2],
    /// What the nodes' increments do to their own forces: entries, primal and dual, a row of the
    /// nodes for each.
    pub(super) own: Factor,
    /// `B̂ᵀ`, primal and dual; and the same of the rates.
    pub(super) strains: [[Factor; 2]; 2],
    /// `(𝓗 B̂)ᵀ`: linear and angular rows by linear columns, then by angular ones.
    pub(super) stresses: [Factor; 4],
    pub(super) stiffness: Quadrants,
    pub(super) damping: Quadrants,
}

/// Adds `A Bᵀ` to a quadrant, or of a symmetric one at least to the entries on the diagonal and
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

/// Columns of a symmetric product that are found together.
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
        self.own.resize(18 * rows / 3, 0.0);
        let all = self.strains.iter_mut().flatten().chain(&mut self.stresses);
        all.for_each(|factor| factor.resize(rows * 6 * points, 0.0));
        self.stiffness.clear(rows);
        self.damping.clear(rows);
    }

    /// Writes what the rates of a sample vary by.
    pub(super) fn write_rates(&mut self, sample: usize, terms: &[NodeTerms]) {
        let count = terms.len();
        for (a, node) in terms.iter().enumerate() {
            let parts = [&node.rate.primal, &node.rate.dual];
            for (factor, rate) in self.rates.iter_mut().zip(parts) {
                for (k, i) in (0..9).map(|entry| (entry / 3, entry % 3)) {
                    factor[((3 * sample + k) * 3 + i) * count + a] = rate[(k, i)];
                }
            }
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
        let count = rows / 3;
        let parts = [&mut sums.coupling, &mut sums.angular];
        for (to, own) in parts.into_iter().zip(self.own.chunks_exact(9 * count)) {
            for (entry, own) in own.chunks_exact(count).enumerate() {
                let (j, i) = (entry / 3, entry % 3);
                for (a, own) in own.iter().enumerate() {
                    to[(j * count + a) * rows + i * count + a] += own;
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
    Matrix3::from_fn(|i, j| factor[(column + i) * rows + j * rows / 3 + node])
}
