//! Tangents of a shell element, as few products of large matrices.
//!
//! With dual blocks of three rows for each node, geometric stiffness is
//! `K = Σ (Sᵀ μ + Tᵀ ν + X S + Y T)` over the samples (docs/theory.md, section 6.4), and material
//! stiffness `Σ B̂ᵀ 𝓗 B̂` over the Gauss points.

use super::products::{Products, read};
use super::scratch::{Damping, Scratch};
use super::{Matrix12, Shell};
use crate::elements::{Contribution, StrainTangent};
use crate::motion::DualMatrix;

impl Shell {
    /// Adds all tangents, for strains that were found, with the geometric stiffness of the
    /// integrated resultants at the samples, whose forces were found, too.
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
        self.write_factors(scratch, &mut products);
        if damping.rates_vary {
            for sample in 0..samples {
                self.find_terms(sample, damping, scratch);
                products.write_rates(sample, &scratch.terms);
            }
        }
        let is_symmetric = |law: &Matrix12| *law == law.transpose();
        let symmetric = !damping.rates_vary && is_symmetric(&self.section.stiffness);
        products.add_geometric(rows, symmetric);
        self.write_strains(damping, &mut products);
        if out.with_resultants_apart {
            self.put_strains_apart(damping, &products, out);
        } else {
            self.write_stresses(&self.section.stiffness, &mut products, damping.rates_vary);
            products.add_material(rows, symmetric, false);
            if damping.damped {
                let law = &self.section.damping;
                let symmetric = is_symmetric(law);
                self.write_stresses(law, &mut products, false);
                products.add_material(rows, symmetric, true);
                let sums = &products.damping;
                sums.add_to(&self.dual_frames, symmetric, &[], &mut out.damping);
            }
        }
        let sums = &products.stiffness;
        let forces = &scratch.forces;
        sums.add_to(&self.dual_frames, symmetric, forces, &mut out.stiffness);
        scratch.products = products;
    }

    /// Puts `B̂`, and the same of the rates, aside, in the frames of the nodes.
    fn put_strains_apart(&self, damping: Damping, products: &Products, out: &mut Contribution) {
        let rows = 3 * self.nodes.len();
        for column in 0..2 * self.points.len() {
            for (node, frame) in self.dual_frames.iter().enumerate() {
                let back = frame.transpose();
                let [strain, rate] = products.strains.each_ref().map(|[primal, dual]| {
                    let place = (node, 3 * column);
                    DualMatrix {
                        primal: read(primal, rows, place),
                        dual: read(dual, rows, place),
                    }
                });
                out.strains.push(StrainTangent {
                    strain: strain * back,
                    rate: if damping.rates_vary {
                        rate * back
                    } else {
                        DualMatrix::zeros()
                    },
                });
            }
        }
    }

    /// Writes `B̂ᵀ` at the Gauss points by what samples vary by, and the same of the rates if these
    /// vary.
    fn write_strains(&self, damping: Damping, products: &mut Products) {
        let which = if damping.rates_vary { 2 } else { 1 };
        for (samples, points) in products.of_samples_and_points().into_iter().take(which) {
            for (from, to) in samples.into_iter().zip(points) {
                self.interpolate_factor(from, to);
            }
        }
    }

    /// Writes the products of a law and the strains, and of the damping and rates if these vary.
    fn write_stresses(&self, law: &Matrix12, products: &mut Products, rates_vary: bool) {
        let rows = 3 * self.nodes.len();
        let laws = [law, &self.section.damping];
        let which = if rates_vary { 2 } else { 1 };
        let Products {
            strains, stresses, ..
        } = products;
        for (index, point) in self.points.iter().enumerate() {
            let here = 6 * rows * index..6 * rows * (index + 1);
            // Resultants of this quadrant's rows by linear directions of the nodes, that is by
            // primal parts of linear strains; by angular ones, dual parts of linear strains and
            // primal ones of angular strains.
            for (quadrant, stresses) in stresses.iter_mut().enumerate() {
                let stresses = &mut stresses[here.clone()];
                let (row, is_angular) = (3 * (quadrant % 2), quadrant >= 2);
                for (column, to) in stresses.chunks_exact_mut(rows).enumerate() {
                    let row = 6 * (column / 3) + row + column % 3;
                    to.fill(0.0);
                    for (law, [primal, dual]) in laws.iter().zip(strains.iter()).take(which) {
                        for (m, (primal, dual)) in primal[here.clone()]
                            .chunks_exact(rows)
                            .zip(dual[here.clone()].chunks_exact(rows))
                            .enumerate()
                        {
                            let strain = 6 * (m / 3) + m % 3;
                            let linear = law[(row, strain)] * point.area;
                            if is_angular {
                                add_multiple(to, linear, dual);
                                add_multiple(to, law[(row, strain + 3)] * point.area, primal);
                            } else {
                                add_multiple(to, linear, primal);
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Adds a multiple of a column.
fn add_multiple(to: &mut [f64], factor: f64, from: &[f64]) {
    if factor != 0.0 {
        let both = to.iter_mut().zip(from);
        both.for_each(|(to, from)| *to += factor * from);
    }
}
