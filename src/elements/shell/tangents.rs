//! Tangents of a shell element, as few products of large matrices.
//!
//! With dual blocks of three rows for each node, geometric stiffness is
//! `K = Σ (Sᵀ μ + Tᵀ ν + X S + Y T)` over the samples (docs/theory.md, section 6.4), and material
//! stiffness `Σ B̂ᵀ 𝓗 B̂` over the Gauss points.

use super::products::{Products, read, write};
use super::scratch::{Damping, Scratch};
use super::{Matrix12, Shell, ShellSection};
use crate::elements::line_station::second_variations;
use crate::elements::{Contribution, StrainTangent};
use crate::motion::{DualMatrix, DualVector};
use nalgebra::Matrix6;

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
