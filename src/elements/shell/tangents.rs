//! Tangents of a shell element, as few products of large matrices.
//!
//! With dual blocks of three rows for each node, geometric stiffness is
//! `K = Σ (Sᵀ μ + Tᵀ ν + X S + Y T)` over the samples (docs/theory.md, section 6.4), and material
//! stiffness `Σ B̂ᵀ 𝓗 B̂` over the Gauss points. Factors are kept transposed, a column for each
//! direction of each term, and a row for each direction of each node.

use super::forces::{Damping, Scratch};
use super::{Matrix12, Shell, ShellSection};
use crate::elements::line_station::{NodeTerms, SecondTerms, second_variations};
use crate::elements::{Contribution, StrainTangent};
use crate::motion::{DualMatrix, DualVector};
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};
use nalgebra::{DMatrix, Matrix3, Matrix6};

/// A matrix of three rows for each node, column by column.
type Factor = Vec<f64>;

/// Sums of 3×3 blocks, of the linear and angular directions of two nodes: force and moment by
/// displacement and turn.
#[derive(Debug, Clone, Default)]
struct Quadrants {
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
    fn add_to(&self, rows: usize, to: &mut DMatrix<f64>) {
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
    strains: [[Factor; 2]; 2],
    /// `(𝓗 B̂)ᵀ`: linear and angular rows by linear columns, then by angular ones.
    stresses: [Factor; 4],
    stiffness: Quadrants,
    damping: Quadrants,
}

/// Writes a block of three rows, for a node, and three columns.
fn write(factor: &mut Factor, rows: usize, (node, column): (usize, usize), block: &Matrix3<f64>) {
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
    fn clear(&mut self, rows: usize, samples: usize, points: usize) {
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
    fn write_geometric(
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
    fn add_geometric(&mut self, rows: usize) {
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
    fn add_material(&mut self, rows: usize, to_damping: bool) {
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

impl Shell {
    /// Adds all tangents, for strains that were found, with the geometric stiffness of the
    /// integrated resultants at the samples.
    pub(super) fn add_tangents(
        &self,
        damping: Damping,
        scratch: &mut Scratch,
        out: &mut Contribution,
    ) {
        let (count, samples) = (self.nodes.len(), self.samples.len());
        let rows = 3 * count;
        let mut products = std::mem::take(&mut scratch.products);
        products.clear(rows, samples, self.points.len());
        scratch.strain_tangents.iter_mut().for_each(Vec::clear);
        for sample in 0..samples {
            self.find_terms(sample, damping, scratch);
            let places = &scratch.places[sample * count..][..count];
            let stress = DualVector::from_wrench(&scratch.at_samples[0][sample]);
            let nodes = places.iter().zip(&scratch.terms);
            scratch.second.clear();
            scratch
                .second
                .extend(second_variations(&scratch.motions[sample], &stress, nodes));
            let terms = (&scratch.terms[..], &scratch.second[..]);
            products.write_geometric((sample, samples), terms, &self.dual_frames);
            for (node, frame) in scratch.terms.iter().zip(&self.dual_frames) {
                let back = frame.transpose();
                scratch.strain_tangents[0].push(node.strain * back);
                if damping.rates_vary {
                    scratch.strain_tangents[1].push(node.rate * back);
                }
            }
        }
        products.add_geometric(rows);
        if out.with_resultants_apart {
            self.put_strains_apart(damping, scratch, out);
        } else {
            self.write_strains(damping, scratch, &mut products);
            self.write_stresses(&self.section.stiffness, &mut products, damping.rates_vary);
            products.add_material(rows, false);
            if damping.damped {
                self.write_stresses(&self.section.damping, &mut products, false);
                products.add_material(rows, true);
                products.damping.add_to(rows, &mut out.damping);
            }
        }
        products.stiffness.add_to(rows, &mut out.stiffness);
        scratch.products = products;
    }

    /// `B̂` of a node at a point, or the same of the rates.
    fn at_point(&self, point: usize, node: usize, tangents: &[DualMatrix]) -> [DualMatrix; 2] {
        let count = self.nodes.len();
        let by = [0, 1].map(|direction| {
            let samples = self.sampling.of_point(direction, point);
            samples.fold(DualMatrix::zeros(), |sum, (t, weight)| {
                sum + tangents[t * count + node] * weight
            })
        });
        self.along_axes(point, by)
    }

    fn put_strains_apart(&self, damping: Damping, scratch: &Scratch, out: &mut Contribution) {
        let [strains, rates] = &scratch.strain_tangents;
        for point in 0..self.points.len() {
            for axis in [0, 1] {
                out.strains.extend((0..self.nodes.len()).map(|node| {
                    let mut tangent = StrainTangent {
                        strain: self.at_point(point, node, strains)[axis],
                        ..StrainTangent::default()
                    };
                    if damping.rates_vary {
                        tangent.rate = self.at_point(point, node, rates)[axis];
                    }
                    tangent
                }));
            }
        }
    }

    fn write_strains(&self, damping: Damping, scratch: &Scratch, products: &mut Products) {
        let rows = 3 * self.nodes.len();
        let which = if damping.rates_vary { 2 } else { 1 };
        let all = scratch.strain_tangents.iter().zip(&mut products.strains);
        for (tangents, [primal, dual]) in all.take(which) {
            for point in 0..self.points.len() {
                for node in 0..self.nodes.len() {
                    let both = self.at_point(point, node, tangents);
                    for (axis, strain) in both.iter().enumerate() {
                        let place = (node, 3 * (2 * point + axis));
                        write(primal, rows, place, &strain.primal.transpose());
                        write(dual, rows, place, &strain.dual.transpose());
                    }
                }
            }
        }
    }

    /// Writes the products of a law and the strains, and of the damping and rates if these vary.
    fn write_stresses(&self, law: &Matrix12, products: &mut Products, rates_vary: bool) {
        let rows = 3 * self.nodes.len();
        let laws = [law, &self.section.damping];
        let which = if rates_vary { 2 } else { 1 };
        let parts = laws
            .map(|law| [0, 1].map(|row| [0, 1].map(|column| ShellSection::part(law, row, column))));
        let Products {
            strains, stresses, ..
        } = products;
        for (index, point) in self.points.iter().enumerate() {
            for node in 0..self.nodes.len() {
                let mut sums = [Matrix6::zeros(); 2];
                for (parts, [primal, dual]) in parts.iter().zip(strains.iter()).take(which) {
                    for axis in [0, 1] {
                        let place = (node, 3 * (2 * index + axis));
                        let strain = DualMatrix {
                            primal: read(primal, rows, place),
                            dual: read(dual, rows, place),
                        };
                        for (sum, parts) in sums.iter_mut().zip(parts) {
                            strain.add_product_to(&parts[axis], sum);
                        }
                    }
                }
                for (axis, sum) in sums.iter().enumerate() {
                    let sum = sum.transpose() * point.area;
                    let place = (node, 3 * (2 * index + axis));
                    for (factor, (row, column)) in
                        stresses.iter_mut().zip([(0, 0), (0, 3), (3, 0), (3, 3)])
                    {
                        let block = sum.fixed_view::<3, 3>(row, column).into_owned();
                        write(factor, rows, place, &block);
                    }
                }
            }
        }
    }
}

/// The transpose of a block that was written.
fn read(factor: &Factor, rows: usize, (node, column): (usize, usize)) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| factor[(column + i) * rows + 3 * node + j])
}
