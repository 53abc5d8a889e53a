//! What is found for as many nodes at once as a vector register of the processor has room for:
//! forces, and the factors of the products that make the tangents.

use super::products::Products;
use super::scratch::Scratch;
use super::{Sample, Shell};
use crate::elements::line_station::{NodePlace, SecondVariations, StationMotion};
use crate::motion::{DualMatrix, DualVector, Lanes, Scalar};
use faer::traits::pulp::{Arch, Simd, WithSimd};
use nalgebra::{ArrayStorage, Matrix3, Vector6};

impl Shell {
    /// Finds the forces on the frames of the integrated resultants at the samples.
    pub(super) fn find_forces(&self, scratch: &mut Scratch) {
        scratch.forces.clear();
        scratch.forces.resize(6 * self.nodes.len(), 0.0);
        Arch::new().dispatch(Forces {
            shell: self,
            scratch,
        });
    }

    /// Writes the factors of the geometric stiffness, and what nodes do to their own forces.
    pub(super) fn write_factors(&self, scratch: &Scratch, products: &mut Products) {
        Arch::new().dispatch(Factors {
            shell: self,
            scratch,
            products,
        });
    }

    /// Writes what strains at the Gauss points vary by, transposed, for what "velocities" at the
    /// samples do.
    pub(super) fn interpolate_factor(&self, samples: &[f64], points: &mut [f64]) {
        Arch::new().dispatch(Interpolation {
            shell: self,
            samples,
            points,
        });
    }
}

/// One sample, in all lanes, with the integrated resultants there.
#[inline(always)]
fn splat<S: Simd>(
    simd: S,
    at: &StationMotion,
    stress: &Vector6<f64>,
) -> (StationMotion<Lanes<S>>, DualVector<Lanes<S>>) {
    let stress = DualVector::from_wrench(stress);
    let of = |number| Lanes::splat(simd, number);
    (at.map(of), stress.map(of))
}

/// Nodes from `first` on, as seen from a sample.
#[inline(always)]
fn places<S: Simd>(
    simd: S,
    first: usize,
    at: &StationMotion<Lanes<S>>,
    sample: &Sample,
    relative: &[f64],
) -> NodePlace<Lanes<S>> {
    let [values, slopes] = &sample.shapes;
    let count = values.len();
    let shape = (
        Lanes::load(simd, &values[first..]),
        Lanes::load(simd, &slopes[first..]),
    );
    let mut parts = [[[shape.0; 3]; 3]; 2];
    for (entry, row) in relative.chunks_exact(count).enumerate() {
        parts[entry / 9][entry % 9 / 3][entry % 3] = Lanes::load(simd, &row[first..]);
    }
    let [primal, dual] = parts;
    let y = DualMatrix {
        primal: Matrix3::from_array_storage(ArrayStorage(primal)),
        dual: Matrix3::from_array_storage(ArrayStorage(dual)),
    };
    NodePlace::new(at, &y, shape)
}

struct Forces<'a> {
    shell: &'a Shell,
    scratch: &'a mut Scratch,
}

impl WithSimd for Forces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Scratch {
            motions,
            at_samples,
            relative_rows,
            forces,
            ..
        } = self.scratch;
        let count = self.shell.nodes.len();
        let stresses = motions.iter().zip(&at_samples[0]);
        for ((at, stress), sample) in stresses.zip(&self.shell.samples) {
            let (at, stress) = splat(simd, at, stress);
            let adjoint = at.adjoint(&stress);
            for first in (0..count).step_by(S::F64_LANES) {
                let node = places(simd, first, &at, sample, relative_rows);
                let force = at.force_on(&adjoint, &node);
                let rows = forces.chunks_exact_mut(count);
                let [force, moment] = [force.primal.data.0[0], force.dual.data.0[0]];
                for (i, row) in rows.enumerate() {
                    let component = if i < 3 { force[i] } else { moment[i - 3] };
                    component.add_to(&mut row[first..]);
                }
            }
        }
    }
}

struct Factors<'a> {
    shell: &'a Shell,
    scratch: &'a Scratch,
    products: &'a mut Products,
}

impl WithSimd for Factors<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Factors {
            shell,
            scratch,
            products,
        } = self;
        let (count, samples) = (shell.nodes.len(), shell.samples.len());
        let stresses = scratch.motions.iter().zip(&scratch.at_samples[0]);
        for (index, ((at, stress), sample)) in stresses.zip(&shell.samples).enumerate() {
            let (at, stress) = splat(simd, at, stress);
            let turn_to_strain = at.turn_to_strain();
            let second = SecondVariations::new(&at, &stress);
            for first in (0..count).step_by(S::F64_LANES) {
                let node = places(simd, first, &at, sample, &scratch.relative_rows);
                let terms = at.terms_of(&turn_to_strain, &node);
                let second = second.of(&node, &terms);
                let factors = [
                    second.mu,
                    second.nu,
                    terms.strain,
                    terms.turn,
                    second.by_strain.transpose(),
                    second.by_turn.transpose(),
                ];
                let [primal, dual] = &mut products.geometric;
                for (f, factor) in factors.iter().enumerate() {
                    let start = 9 * (f * samples + index) * count;
                    write(&factor.primal, first, count, &mut primal[start..]);
                    write(&factor.dual, first, count, &mut dual[start..]);
                }
                let own = [second.own.primal, second.own.dual];
                let rows = products.own.chunks_exact_mut(count).enumerate();
                for (entry, row) in rows {
                    let part = &own[entry / 9].data.0;
                    part[entry % 9 / 3][entry % 3].add_to(&mut row[first..]);
                }
            }
        }
    }
}

/// Writes the transpose of a block of each node from `first` on.
#[inline(always)]
fn write<S: Simd>(block: &Matrix3<Lanes<S>>, first: usize, count: usize, to: &mut [f64]) {
    for k in 0..3 {
        for i in 0..3 {
            let row = &mut to[(3 * k + i) * count..][..count];
            block.data.0[i][k].store(&mut row[first..]);
        }
    }
}

struct Interpolation<'a> {
    shell: &'a Shell,
    samples: &'a [f64],
    points: &'a mut [f64],
}

impl WithSimd for Interpolation<'_> {
    type Output = ();

    /// `Σ_i ∂ξ_i/∂s_α B_iᵀ T`, for what the velocities in ξ and η vary by at each point.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (shell, samples) = (self.shell, self.samples);
        let rows = 3 * shell.nodes.len();
        let zero = Lanes::splat(simd, 0.0);
        let points = self.points.chunks_exact_mut(6 * rows);
        for (index, (to, point)) in points.zip(&shell.points).enumerate() {
            let axes = &point.axes;
            for first in (0..rows).step_by(S::F64_LANES) {
                let mut velocities = [[zero; 3]; 2];
                for (direction, velocity) in velocities.iter_mut().enumerate() {
                    for (t, weight) in shell.sampling.of_point(direction, index) {
                        let weight = Lanes::splat(simd, weight);
                        for m in 0..3 {
                            let from = &samples[(3 * t + m) * rows..][..rows];
                            let from = Lanes::load(simd, &from[first..]);
                            velocity[m] = velocity[m].plus_product(weight, from);
                        }
                    }
                }
                let [xi, eta] = velocities;
                for (axis, [by_xi, by_eta]) in axes.slopes.into_iter().enumerate() {
                    let [by_xi, by_eta] = [Lanes::splat(simd, by_xi), Lanes::splat(simd, by_eta)];
                    let mut along = xi;
                    for (along, (xi, eta)) in along.iter_mut().zip(xi.into_iter().zip(eta)) {
                        *along = (xi * by_xi).plus_product(eta, by_eta);
                    }
                    for k in 0..3 {
                        let mut sum = zero;
                        for (m, along) in along.iter().enumerate() {
                            let turn = Lanes::splat(simd, axes.turn[(m, k)]);
                            sum = sum.plus_product(turn, *along);
                        }
                        let to = &mut to[(3 * axis + k) * rows..][..rows];
                        sum.store(&mut to[first..]);
                    }
                }
            }
        }
    }
}
