//! What an element contributes to the equations: forces, constraints and tangents.

use super::{Element, Scratch, StrainTangent};
use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

/// What a contribution's size depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shape {
    nodes: usize,
    own_unknowns: usize,
    has_feedback: bool,
    couples_nodes: bool,
}

impl Shape {
    /// That of an element.
    pub fn of(element: &dyn Element) -> Self {
        Shape {
            nodes: element.nodes().len(),
            own_unknowns: element.own_unknowns(),
            has_feedback: element.has_feedback(),
            couples_nodes: element.couples_nodes(),
        }
    }
}

/// Forces of an element, and their tangents, with respect to material increments of its nodes.
///
/// The equations of the system are `Σ force = 0` and `constraint = 0`: forces are on the left-hand
/// side, so that applied ones count negative.
#[derive(Debug, Clone)]
pub struct Contribution {
    /// Whether tangents are wanted.
    pub with_tangents: bool,
    /// Force on each node, `[force; moment]` in the node's frame; length `6 n`.
    pub force: DVector<f64>,
    /// Constraint violations, or unbalance of internal states; length `m`.
    pub constraint: DVector<f64>,
    /// `∂force/∂u`, `6 n × 6 n`; of elements that couple no nodes `6 n × 6`, of each node by its
    /// own motion, and likewise below. See [`Contribution::place`].
    pub stiffness: DMatrix<f64>,
    /// `∂force/∂V`, `6 n × 6 n`.
    pub damping: DMatrix<f64>,
    /// `∂force/∂V̇`, `6 n × 6 n`.
    pub mass: DMatrix<f64>,
    /// `∂constraint/∂u`, `m × 6 n`; its transpose is `∂force/∂λ`, but of elements with feedback.
    pub gradient: DMatrix<f64>,
    /// `(∂force/∂λ)ᵀ`, `m × 6 n`, of elements with feedback; else empty.
    pub effect: DMatrix<f64>,
    /// `∂constraint/∂V`, `m × 6 n`, of elements with feedback; else empty.
    pub gradient_rate: DMatrix<f64>,
    /// `∂constraint/∂λ`, `m × m`, for internal states `λ`.
    pub own: DMatrix<f64>,
    /// `∂constraint/∂λ̇`, `m × m`, for internal states `λ`.
    pub own_rate: DMatrix<f64>,
    /// Whether what stress resultants contribute is wanted apart, as `strains`, not in stiffness
    /// and damping.
    pub with_resultants_apart: bool,
    /// Of each station with [`StressLaw`](super::StressLaw), for each node, if wanted apart.
    pub strains: Vec<StrainTangent>,
    pub(super) scratch: Scratch,
}

impl Contribution {
    /// Zero contribution of an element with `nodes` nodes and `multipliers` multipliers.
    pub fn new(nodes: usize, multipliers: usize, with_tangents: bool) -> Self {
        let size = 6 * nodes;
        Contribution {
            with_tangents,
            force: DVector::zeros(size),
            constraint: DVector::zeros(multipliers),
            stiffness: DMatrix::zeros(size, size),
            damping: DMatrix::zeros(size, size),
            mass: DMatrix::zeros(size, size),
            gradient: DMatrix::zeros(multipliers, size),
            effect: DMatrix::zeros(0, 0),
            gradient_rate: DMatrix::zeros(0, 0),
            own: DMatrix::zeros(multipliers, multipliers),
            own_rate: DMatrix::zeros(multipliers, multipliers),
            with_resultants_apart: false,
            strains: Vec::new(),
            scratch: Scratch::default(),
        }
    }

    /// Zero contribution of an element with feedback.
    pub fn with_feedback(nodes: usize, states: usize, with_tangents: bool) -> Self {
        Contribution {
            effect: DMatrix::zeros(states, 6 * nodes),
            gradient_rate: DMatrix::zeros(states, 6 * nodes),
            ..Self::new(nodes, states, with_tangents)
        }
    }

    /// Zero contribution of `element`.
    pub fn of(element: &dyn Element, with_tangents: bool) -> Self {
        Self::shaped(Shape::of(element), with_tangents)
    }

    /// Zero contribution of elements of this shape.
    pub fn shaped(shape: Shape, with_tangents: bool) -> Self {
        let Shape {
            nodes,
            own_unknowns,
            has_feedback,
            couples_nodes,
        } = shape;
        match (has_feedback, couples_nodes) {
            (true, _) => Self::with_feedback(nodes, own_unknowns, with_tangents),
            (false, true) => Self::new(nodes, own_unknowns, with_tangents),
            (false, false) => Self::apart(nodes, with_tangents),
        }
    }

    /// Zero contribution of an element that couples no nodes.
    pub fn apart(nodes: usize, with_tangents: bool) -> Self {
        let zeros = || DMatrix::zeros(6 * nodes, 6);
        Contribution {
            force: DVector::zeros(6 * nodes),
            stiffness: zeros(),
            damping: zeros(),
            mass: zeros(),
            gradient: DMatrix::zeros(0, 6 * nodes),
            ..Self::new(0, 0, with_tangents)
        }
    }

    /// Where the tangents of one node's force by another's motion are, if these are coupled.
    pub fn place(&self, row: usize, column: usize) -> Option<(usize, usize)> {
        match self.stiffness.ncols() == self.force.len() {
            true => Some((6 * row, 6 * column)),
            false => (row == column).then_some((6 * row, 0)),
        }
    }

    /// `(∂force/∂λ)ᵀ`, `m × 6 n`.
    pub fn by_own(&self) -> &DMatrix<f64> {
        match self.effect.is_empty() {
            true => &self.gradient,
            false => &self.effect,
        }
    }

    /// Sets everything to zero.
    pub fn clear(&mut self) {
        self.force.as_mut_slice().fill(0.0);
        self.constraint.as_mut_slice().fill(0.0);
        self.strains.clear();
        if self.with_tangents {
            for matrix in [
                &mut self.stiffness,
                &mut self.damping,
                &mut self.mass,
                &mut self.gradient,
                &mut self.effect,
                &mut self.gradient_rate,
                &mut self.own,
                &mut self.own_rate,
            ] {
                matrix.as_mut_slice().fill(0.0);
            }
        }
    }

    #[inline(always)]
    pub(super) fn add_force(&mut self, node: usize, force: &Vector6<f64>) {
        let mut rows = self.force.fixed_rows_mut::<6>(6 * node);
        rows += force;
    }

    #[inline(always)]
    pub(super) fn add_stiffness(&mut self, row: usize, column: usize, block: &Matrix6<f64>) {
        add_block(&mut self.stiffness, (row, column), block);
    }

    #[inline(always)]
    pub(super) fn add_damping(&mut self, row: usize, column: usize, block: &Matrix6<f64>) {
        add_block(&mut self.damping, (row, column), block);
    }

    #[inline(always)]
    pub(super) fn add_mass(&mut self, row: usize, column: usize, block: &Matrix6<f64>) {
        add_block(&mut self.mass, (row, column), block);
    }
}

/// Adds one 6×6 block to a matrix of such.
#[inline(always)]
pub(super) fn add_block(
    to: &mut DMatrix<f64>,
    (row, column): (usize, usize),
    block: &Matrix6<f64>,
) {
    let rows = to.nrows();
    let columns = to.as_mut_slice()[6 * column * rows..].chunks_exact_mut(rows);
    for (to, from) in columns.zip(&block.data.0) {
        let to = to[6 * row..].iter_mut();
        to.zip(from).for_each(|(to, from)| *to += from);
    }
}
