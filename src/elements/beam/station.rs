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

/// Where one node is, seen from one station.
#[derive(Debug, Clone, Copy)]
pub(in crate::elements) struct NodePlace {
    /// The node's shape function there, and its derivative in ξ.
    pub(super) shape: (f64, f64),
    /// Motion of the node relative to the section, `X = RᵀM`.
    pub(super) x: DualMatrix,
    pub(super) x_axial: DualVector,
}

/// What the tangent needs of one node at one station.
#[derive(Debug, Clone, Copy)]
pub(in crate::elements) struct NodeTerms {
    /// `X ẽ`.
    pub(super) x_e: DualMatrix,
    /// Section's turn and strain for a unit increment of the node.
    pub turn: DualMatrix,
    pub(super) strain: DualMatrix,
    /// Strain rate, at constant nodal velocities, for a unit increment of the node.
    pub(super) rate: DualMatrix,
}

impl NodePlace {
    /// `C = tr(X) I − Xᵀ`.
    pub(super) fn c(&self) -> DualMatrix {
        self.x.trace_minus_transpose()
    }
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

    /// Kinematics, for node motions `relative` to some common frame.
    pub fn motion(&self, relative: &[DualMatrix]) -> Result<StationMotion> {
        let mut g = DualMatrix::zeros();
        let mut g_prime = DualMatrix::zeros();
        for (y, shape) in relative.iter().zip(&self.shapes) {
            g += *y * shape.0;
            g_prime += *y * shape.1;
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

    /// The nodes as seen from here.
    pub fn places<'a>(
        &'a self,
        at: &'a StationMotion,
        relative: &'a [DualMatrix],
    ) -> impl Iterator<Item = NodePlace> + 'a {
        let nodes = relative.iter().zip(&self.shapes);
        nodes.map(|(y, &shape)| {
            let x = at.polar.rotation.tr_mul(y);
            let x_axial = x.axial();
            NodePlace { shape, x, x_axial }
        })
    }
}

/// Motions of nodes relative to the first.
pub(in crate::elements) fn relative_to_first<'a>(
    motions: impl Iterator<Item = &'a Motion> + Clone + 'a,
) -> impl Iterator<Item = DualMatrix> + 'a {
    let first = motions.clone().next();
    let relative = move |motion: &Motion| first.unwrap_or(motion).relative(motion).to_dual();
    motions.map(relative)
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

    /// First variations: section turn `A Δρ = Σ N_a C_a Δu_a` and strain
    /// `A Δe = Σ (N'_a C_a + N_a (2 e x_aᵀ − X_a ẽ)) Δu_a + P Δρ`.
    pub fn node_terms<'a>(
        &'a self,
        places: impl Iterator<Item = NodePlace> + 'a,
    ) -> impl Iterator<Item = NodeTerms> + 'a {
        let a_inverse = self.polar.spread_inverse;
        let turn_to_strain = self.turn_to_strain();
        places.map(move |node| {
            let (n, n_prime) = node.shape;
            let (c, x_e) = (node.c(), node.x.times_skew(&self.e));
            let turn = a_inverse * c * n;
            let direct = c * n_prime + (self.e.outer(&node.x_axial) * 2.0 - x_e) * n;
            NodeTerms {
                x_e,
                turn,
                strain: a_inverse * (direct + turn_to_strain * turn),
                rate: DualMatrix::zeros(),
            }
        })
    }

    /// `ė`: the first variation for the nodes' velocities.
    pub(super) fn strain_rate(&self, places: &[NodePlace], states: &[NodeState]) -> DualVector {
        let (mut turn, mut direct) = (DualVector::zeros(), DualVector::zeros());
        for (node, state) in places.iter().zip(states) {
            let (n, n_prime) = node.shape;
            let v = DualVector::from_twist(&state.twist);
            let c_v = v * node.x.trace() - node.x.transpose() * v;
            turn += c_v * n;
            let by_shape = self.e * (node.x_axial.dot(&v) * 2.0) - node.x * self.e.cross(&v);
            direct += c_v * n_prime + by_shape * n;
        }
        let a_inverse = self.polar.spread_inverse;
        a_inverse * (direct + self.turn_to_strain() * (a_inverse * turn))
    }

    /// Force `N' Cᵀ μ + N (Cᵀ ν + 2 (μᵀe) x + ẽ Xᵀ μ)` of a stress resultant on each node: what
    /// does work on the first variation of the strain.
    pub(super) fn node_forces<'a>(
        &'a self,
        stress: &DualVector,
        places: impl Iterator<Item = &'a NodePlace> + 'a,
    ) -> impl Iterator<Item = DualVector> + 'a {
        let (mu, nu) = self.adjoint(stress);
        let mu_e = mu.dot(&self.e) * 2.0;
        places.map(move |node| {
            let (n, n_prime) = node.shape;
            let (x, e) = (&node.x, &self.e);
            let by_shape =
                x.trace_minus_times(&nu) + node.x_axial * mu_e + e.cross(&(x.transpose() * mu));
            x.trace_minus_times(&mu) * n_prime + by_shape * n
        })
    }

    /// `μ = A⁻¹ σ` and `ν = A⁻¹ Pᵀ μ` of a stress resultant.
    pub(super) fn adjoint(&self, stress: &DualVector) -> (DualVector, DualVector) {
        let a_inverse = self.polar.spread_inverse;
        let mu = a_inverse * *stress;
        (mu, a_inverse * (self.turn_to_strain().transpose() * mu))
    }
}

/// A turn about axis 1.
pub(in crate::elements) fn about_axis(angle: f64) -> Matrix3<f64> {
    rotation_from_vector(&(Vector3::x() * angle))
}
