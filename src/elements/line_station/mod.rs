//! Motions interpolated along a line, at one station of an element, and their first variations.
//!
//! A station knows pairs `(N_a, N'_a)` of the nodes: of beams shape functions and their derivatives
//! along the beam, of shells those in one of the two directions of the surface. The "velocity" in
//! that direction is the strain. See docs/theory.md, sections 6.2 to 6.5.

mod variations;

pub(super) use variations::{
    SecondTerms, SecondVariations, geometric_stiffness, rate_variations, second_variations,
    spread_variation, turned,
};

use crate::error::{Error, ErrorKind, Result};
use crate::motion::{DualMatrix, DualPolar, DualVector, Motion, Scalar};

/// Shape functions at one place of an element and their derivatives in one direction, a pair for
/// each node.
#[derive(Debug, Clone)]
pub(super) struct LineStation {
    pub shapes: Vec<(f64, f64)>,
}

/// Kinematics of a station: polar factors, and `G'` in the section's frame.
#[derive(Debug, Clone)]
pub(super) struct StationMotion<T = f64> {
    pub polar: DualPolar<T>,
    pub q: DualMatrix<T>,
    /// "Velocity in ξ".
    pub e: DualVector<T>,
}

/// Where one node is, seen from one station.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodePlace<T = f64> {
    /// The node's shape function there, and its derivative in ξ.
    pub shape: (T, T),
    /// Motion of the node relative to the section, `X = RᵀM`.
    pub x: DualMatrix<T>,
    pub x_axial: DualVector<T>,
}

/// What the tangent needs of one node at one station.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeTerms<T = f64> {
    /// `X ẽ`.
    pub x_e: DualMatrix<T>,
    /// Section's turn and strain for a unit increment of the node.
    pub turn: DualMatrix<T>,
    pub strain: DualMatrix<T>,
    /// Strain rate, at constant nodal velocities, for a unit increment of the node.
    pub rate: DualMatrix<T>,
}

impl<T: Scalar> NodePlace<T> {
    /// A node at `y` in the frame that the station's motion is relative to.
    #[inline(always)]
    pub fn new(at: &StationMotion<T>, y: &DualMatrix<T>, shape: (T, T)) -> Self {
        let x = at.polar.rotation.tr_mul(y);
        let x_axial = x.axial();
        NodePlace { shape, x, x_axial }
    }

    /// `C = tr(X) I − Xᵀ`.
    #[inline(always)]
    pub fn c(&self) -> DualMatrix<T> {
        self.x.trace_minus_transpose()
    }
}

impl LineStation {
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
        nodes.map(|(y, &shape)| NodePlace::new(at, y, shape))
    }
}

/// Motions of nodes relative to the first.
pub(super) fn relative_to_first<'a>(
    motions: impl Iterator<Item = &'a Motion> + Clone + 'a,
) -> impl Iterator<Item = DualMatrix> + 'a {
    let first = motions.clone().next();
    let relative = move |motion: &Motion| first.unwrap_or(motion).relative(motion).to_dual();
    motions.map(relative)
}

fn polar_factors(g: &DualMatrix) -> Result<DualPolar> {
    DualPolar::new(g).ok_or_else(turns_too_far)
}

/// That nodes of one element are turned so far relative to each other that nothing lies between.
pub(super) fn turns_too_far() -> Error {
    Error::new(
        ErrorKind::Model,
        "an element turns by more than its order can follow: use more or smaller elements",
    )
}

impl<T: Scalar> StationMotion<T> {
    /// `P = (S e)~ − tr(Q) I + Q`.
    #[inline(always)]
    pub fn turn_to_strain(&self) -> DualMatrix<T> {
        (self.polar.factor * self.e).skew() - self.q.trace_minus()
    }

    /// First variations: section turn `A Δρ = Σ N_a C_a Δu_a` and strain
    /// `A Δe = Σ (N'_a C_a + N_a (2 e x_aᵀ − X_a ẽ)) Δu_a + P Δρ`, of one node.
    #[inline(always)]
    pub fn terms_of(&self, turn_to_strain: &DualMatrix<T>, node: &NodePlace<T>) -> NodeTerms<T> {
        let a_inverse = self.polar.spread_inverse;
        let (n, n_prime) = node.shape;
        let (c, x_e) = (node.c(), node.x.times_skew(&self.e));
        let turn = a_inverse * c * n;
        let direct = c * n_prime + (self.e.outer(&node.x_axial).double() - x_e) * n;
        NodeTerms {
            x_e,
            turn,
            strain: a_inverse * (direct + *turn_to_strain * turn),
            rate: node.x.map(|number| number.constant(0.0)),
        }
    }

    /// Force `N' Cᵀ μ + N (Cᵀ ν + 2 (μᵀe) x + ẽ Xᵀ μ)` of a stress resultant on a node: what does
    /// work on the first variation of the strain.
    #[inline(always)]
    pub fn force_on(
        &self,
        (mu, nu): &(DualVector<T>, DualVector<T>),
        node: &NodePlace<T>,
    ) -> DualVector<T> {
        let (n, n_prime) = node.shape;
        let (x, e) = (&node.x, &self.e);
        let by_e = (node.x_axial * mu.dot(e)).double();
        let by_shape = x.trace_minus_times(nu) + by_e + e.cross(&(x.transpose() * *mu));
        x.trace_minus_times(mu) * n_prime + by_shape * n
    }

    /// `μ = A⁻¹ σ` and `ν = A⁻¹ Pᵀ μ` of a stress resultant.
    #[inline(always)]
    pub fn adjoint(&self, stress: &DualVector<T>) -> (DualVector<T>, DualVector<T>) {
        let a_inverse = self.polar.spread_inverse;
        let mu = a_inverse * *stress;
        (mu, a_inverse * (self.turn_to_strain().transpose() * mu))
    }

    /// Number by number.
    #[inline(always)]
    pub fn map<U: Copy>(&self, f: impl Fn(T) -> U) -> StationMotion<U> {
        StationMotion {
            polar: DualPolar {
                rotation: self.polar.rotation.map(&f),
                factor: self.polar.factor.map(&f),
                spread_inverse: self.polar.spread_inverse.map(&f),
            },
            q: self.q.map(&f),
            e: self.e.map(&f),
        }
    }
}

impl StationMotion {
    /// First variations, node by node.
    pub fn node_terms<'a>(
        &'a self,
        places: impl Iterator<Item = NodePlace> + 'a,
    ) -> impl Iterator<Item = NodeTerms> + 'a {
        let turn_to_strain = self.turn_to_strain();
        places.map(move |node| self.terms_of(&turn_to_strain, &node))
    }

    /// `ė`: the first variation for the nodes' velocities.
    pub fn strain_rate(
        &self,
        places: &[NodePlace],
        twists: impl Fn(usize) -> DualVector,
    ) -> DualVector {
        let (mut turn, mut direct) = (DualVector::zeros(), DualVector::zeros());
        for (a, node) in places.iter().enumerate() {
            let (n, n_prime) = node.shape;
            let v = twists(a);
            let c_v = v * node.x.trace() - node.x.transpose() * v;
            turn += c_v * n;
            let by_shape = self.e * (node.x_axial.dot(&v) * 2.0) - node.x * self.e.cross(&v);
            direct += c_v * n_prime + by_shape * n;
        }
        let a_inverse = self.polar.spread_inverse;
        a_inverse * (direct + self.turn_to_strain() * (a_inverse * turn))
    }

    /// Forces of a stress resultant, node by node.
    pub fn node_forces<'a>(
        &'a self,
        stress: &DualVector,
        places: impl Iterator<Item = &'a NodePlace> + 'a,
    ) -> impl Iterator<Item = DualVector> + 'a {
        let adjoint = self.adjoint(stress);
        places.map(move |node| self.force_on(&adjoint, node))
    }
}
