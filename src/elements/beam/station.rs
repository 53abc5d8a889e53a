//! Interpolation of motions at one station of a beam element, and its first variations.

use crate::elements::NodeState;
use crate::elements::section::Section;
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{DualMatrix, DualPolar, DualVector, Motion, rotation_from_vector};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// One quadrature point, or any other station, of a beam element.
#[derive(Debug, Clone)]
pub(in crate::elements) struct Station {
    /// Shape functions and their derivatives in ξ, one pair for each node.
    pub(super) shapes: Vec<(f64, f64)>,
    /// Quadrature weight in ξ.
    pub(super) weight: f64,
    /// Reference length for each unit of ξ.
    pub(super) stretch: f64,
    /// In the axes that the element's nodes give it.
    pub(super) section: Section,
    /// Angle by which the section's own axes are turned about axis 1 from these: where twist has a
    /// corner.
    pub turn: f64,
    /// "Velocity in ξ" of the reference configuration.
    pub(super) reference: Vector6<f64>,
}

/// Kinematics of a station: polar factors, and `G'` in the section's frame.
#[derive(Debug, Clone)]
pub(in crate::elements) struct StationMotion {
    pub polar: DualPolar,
    pub(super) q: DualMatrix,
    /// "Velocity in ξ".
    pub(super) e: DualVector,
}

/// What the tangent needs of one node at one station.
#[derive(Debug, Clone, Copy)]
pub(in crate::elements) struct NodeTerms {
    pub(super) shape: (f64, f64),
    /// Motion of the node relative to the section, `X = RᵀM`.
    pub(super) x: DualMatrix,
    pub(super) x_axial: DualVector,
    /// `C = tr(X) I − Xᵀ`.
    pub(super) c: DualMatrix,
    /// Section's turn, strain, and the multipliers `μ`, `ν` for a unit increment of the node.
    pub turn: DualMatrix,
    pub(super) strain: DualMatrix,
    pub(super) mu: DualMatrix,
    pub(super) nu: DualMatrix,
    /// Strain rate, at constant nodal velocities, for a unit increment of the node.
    pub(super) rate: DualMatrix,
}

impl Station {
    /// Shape functions alone.
    pub(super) fn bare(shapes: Vec<(f64, f64)>) -> Self {
        Station {
            shapes,
            weight: 0.0,
            stretch: 0.0,
            section: Section {
                stiffness: Matrix6::zeros(),
                mass: Matrix6::zeros(),
                damping: Matrix6::zeros(),
            },
            turn: 0.0,
            reference: Vector6::zeros(),
        }
    }

    /// Strain, for the "velocity in ξ" `e`.
    pub(super) fn strain(&self, e: &DualVector) -> Vector6<f64> {
        (e.to_twist() - self.reference) / self.stretch
    }

    /// Stiffness and damping of the resultants, integrated.
    pub(super) fn own_law(&self) -> (Matrix6<f64>, Matrix6<f64>) {
        let factor = self.weight / self.stretch;
        (
            self.section.stiffness * factor,
            self.section.damping * factor,
        )
    }

    /// Kinematics, for node motions given relative to some common frame.
    pub fn motion(&self, relative: impl Fn(usize) -> Motion) -> Result<StationMotion> {
        let mut g = DualMatrix::zeros();
        let mut g_prime = DualMatrix::zeros();
        for (a, shape) in self.shapes.iter().enumerate() {
            let y = relative(a).to_dual();
            g += y * shape.0;
            g_prime += y * shape.1;
        }
        let polar = polar_factors(&g)?;
        let q = polar.rotation.tr_mul(&g_prime);
        let e = polar.spread_inverse * (q.axial() * 2.0);
        Ok(StationMotion { polar, q, e })
    }

    /// Shape functions.
    pub fn shapes(&self) -> impl Iterator<Item = f64> + '_ {
        self.shapes.iter().map(|shape| shape.0)
    }

    /// Polar factors alone, for node motions `relative` to some common frame.
    pub fn polar(&self, relative: &[DualMatrix]) -> Result<DualPolar> {
        let mut g = DualMatrix::zeros();
        for (y, shape) in relative.iter().zip(self.shapes()) {
            g += *y * shape;
        }
        polar_factors(&g)
    }

    /// First variations: section turn `A Δρ = Σ N_a C_a Δu_a` and strain
    /// `A Δe = Σ (N'_a C_a + N_a (2 e x_aᵀ − X_a ẽ)) Δu_a + ((S e)~ − tr(Q) I + Q) Δρ`.
    pub fn node_terms<'a>(
        &'a self,
        at: &'a StationMotion,
        relative: impl Fn(usize) -> Motion + 'a,
    ) -> impl Iterator<Item = NodeTerms> + 'a {
        let a_inverse = at.polar.spread_inverse;
        let turn_to_strain = at.turn_to_strain();
        let e_skew = at.e.skew();
        self.shapes.iter().enumerate().map(move |(a, &shape)| {
            let x = at.polar.rotation.tr_mul(&relative(a).to_dual());
            let x_axial = x.axial();
            let c = x.trace_minus_transpose();
            let turn = a_inverse * c * shape.0;
            let direct = c * shape.1 + (at.e.outer(&x_axial) * 2.0 - x * e_skew) * shape.0;
            NodeTerms {
                shape,
                x,
                x_axial,
                c,
                turn,
                strain: a_inverse * (direct + turn_to_strain * turn),
                mu: DualMatrix::zeros(),
                nu: DualMatrix::zeros(),
                rate: DualMatrix::zeros(),
            }
        })
    }
}

fn polar_factors(g: &DualMatrix) -> Result<DualPolar> {
    DualPolar::new(g).ok_or_else(|| {
        Error::new(
            ErrorKind::Model,
            "a beam element turns by more than its order can follow: use more or shorter elements",
        )
    })
}

impl StationMotion {
    /// `P = (S e)~ − tr(Q) I + Q`.
    pub(super) fn turn_to_strain(&self) -> DualMatrix {
        (self.polar.factor * self.e).skew() - self.q.trace_minus()
    }
}

/// `ė = Σ B_a V_a`.
pub(super) fn strain_rate(terms: &[NodeTerms], states: &[NodeState]) -> DualVector {
    let mut rate = DualVector::zeros();
    for (node, state) in terms.iter().zip(states) {
        rate += node.strain * DualVector::from_twist(&state.twist);
    }
    rate
}

/// A turn about axis 1.
pub(in crate::elements) fn about_axis(angle: f64) -> Matrix3<f64> {
    rotation_from_vector(&(Vector3::x() * angle))
}
