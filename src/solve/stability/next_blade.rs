//! What disturbances of a rotor of like blades are, seen from the places of the next blades
//! (docs/theory.md, section 12.4).

use super::step_map::Common;
use crate::collocation::{LikeBlades, require_like_blades, scaled_adjoint};
use crate::motion::Motion;
use crate::solve::result::Solved;
use faer::MatMut;
use nalgebra::{Complex, DMatrix, Matrix6, Vector6};

/// Relative differences of motions of blades that are alike.
const ALIKE: f64 = 1e-9;

/// Disturbances a `B`-th of the period later, with each blade at the place of the next, are
/// disturbances of the same motion: `Δu_σ(a)(t) = Ad(C_a⁻¹) Δu_a(t + T/B)`.
#[derive(Debug, Clone)]
pub(super) struct NextBlade {
    /// Number of blades.
    pub blades: usize,
    /// The image of each node, and `Ad(C⁻¹)` and `Ad(C)` of scaled increments.
    nodes: Vec<(usize, [Matrix6<f64>; 2])>,
    /// The image of each element, and what carries its scaled own unknowns there, if anything.
    elements: Vec<(usize, Option<DMatrix<f64>>)>,
}

impl NextBlade {
    /// Of a periodic motion in which all blades move alike; none of another one.
    pub fn of(solve: &Solved) -> Option<Self> {
        let system = &solve.system;
        // Motions may be alike where what acts on them is not: parameters change it.
        require_like_blades(system).ok()?;
        let left = LikeBlades::on(system, solve.grid)?;
        let symmetry = system.symmetry()?;
        let carries = symmetry.carries_of_own.get()?.as_ref()?;
        let length = system.scales().length;
        let is_alike = left.apart(&solve.state, length) <= ALIKE;
        let node = |(&image, carry): (&usize, &Motion)| {
            let both = [carry.inverse(), *carry];
            (image, both.map(|motion| scaled_adjoint(&motion, length)))
        };
        is_alike.then(|| NextBlade {
            blades: symmetry.blades,
            nodes: symmetry
                .nodes
                .iter()
                .zip(&symmetry.carries)
                .map(node)
                .collect(),
            elements: symmetry
                .elements
                .iter()
                .copied()
                .zip(carries.clone())
                .collect(),
        })
    }

    /// Gives disturbances at the end of a `B`-th of the period the places of the next blades.
    pub fn carry(&self, common: &Common, mut columns: MatMut<f64>) {
        let nodes = 12 * self.nodes.len();
        let (scales, layout) = (common.equations.column_scale(), common.equations.layout());
        let elements = common.equations.system().elements();
        let place = |element: usize| {
            let internal = common.internal.iter().find(|i| i.element == element);
            internal.map(|internal| internal.places.clone())
        };
        for j in 0..columns.ncols() {
            let Some(column) = columns.as_mut().col_mut(j).try_as_col_major_mut() else {
                continue;
            };
            let column = column.as_slice_mut();
            let before = column.to_vec();
            for (entries, (image, [forth, _])) in before[..nodes].chunks_exact(12).zip(&self.nodes)
            {
                for (part, to) in column[12 * image..][..12].chunks_exact_mut(6).enumerate() {
                    let from = Vector6::from_column_slice(&entries[6 * part..][..6]);
                    to.copy_from_slice((forth * from).as_slice());
                }
            }
            for internal in &common.internal {
                let (image, carry) = &self.elements[internal.element];
                let (from, Some(to)) = (internal.places.clone(), place(*image)) else {
                    continue;
                };
                let scaled = |element: usize, place: usize, k: usize| {
                    common.scales[place] / scales[layout.element(&elements[element]).start + k]
                };
                let values = from
                    .enumerate()
                    .map(|(k, at)| before[at] * scaled(internal.element, at, k));
                let values: Vec<f64> = values.collect();
                for (k, at) in to.enumerate() {
                    let value = match carry {
                        Some(carry) => carry.row(k).iter().zip(&values).map(|(c, x)| c * x).sum(),
                        None => values[k],
                    };
                    column[at] = value / scaled(*image, at, k);
                }
            }
        }
    }

    /// What increments of all nodes, which are `factor` times as large a `B`-th of the period later
    /// at the places of the next blades, are so many of these parts later; scaled.
    pub fn later(&self, parts: usize, factor: Complex<f64>, all: &mut [Complex<f64>]) {
        for _ in 0..parts {
            let before = all.to_vec();
            for (to, (image, [_, back])) in all.chunks_exact_mut(6).zip(&self.nodes) {
                let from = &before[6 * image..][..6];
                for (i, to) in to.iter_mut().enumerate() {
                    let terms = (0..6).map(|j| from[j] * back[(i, j)]);
                    *to = factor * terms.sum::<Complex<f64>>();
                }
            }
        }
    }
}
