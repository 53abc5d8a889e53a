//! Second variations of strains (docs/theory.md, sections 6.4 and 6.5).

use super::{NodePlace, NodeTerms, StationMotion};
use crate::motion::{Dual, DualMatrix, DualVector, Scalar};
use nalgebra::Matrix6;

/// `2 w xᵀ − X w̃` with `x = axial(X)`: the part of `−ΔA w` that a node's own increment causes.
#[inline(always)]
pub fn spread_variation<T: Scalar>(x: &DualMatrix<T>, w: &DualVector<T>) -> DualMatrix<T> {
    w.outer(&x.axial()).double() - x.times_skew(w)
}

/// `2 w xᵀ − (X w)~`: the part of `ΔCᵀ w` that the section's turn causes; a node's own increment
/// causes minus its [`spread_variation`].
#[inline(always)]
pub fn turned<T: Scalar>(x: &DualMatrix<T>, w: &DualVector<T>) -> DualMatrix<T> {
    w.outer(&x.axial()).double() - (*x * *w).skew()
}

/// What one node contributes to the second variation of `σᵀ Δe`.
#[derive(Debug, Clone, Copy)]
pub struct SecondTerms<T = f64> {
    /// What multiplies the strains and turns that other nodes cause.
    pub by_strain: DualMatrix<T>,
    pub by_turn: DualMatrix<T>,
    /// What the node's own increment does to `A Δμ` and `A Δν`.
    pub mu: DualMatrix<T>,
    pub nu: DualMatrix<T>,
    /// What it does to its own force at constant `μ` and `ν`.
    pub own: DualMatrix<T>,
}

/// Second variation of `σᵀ Δe` at constant `σ` (docs/theory.md, section 6.4): what all nodes have
/// in common.
#[derive(Debug, Clone, Copy)]
pub struct SecondVariations<T = f64> {
    e: DualVector<T>,
    mu: DualVector<T>,
    nu: DualVector<T>,
    mu_e: Dual<T>,
    mu_s: DualMatrix<T>,
    s_mu: DualVector<T>,
    /// Part of `A Δν` that comes through the section's turn.
    nu_by_turn: DualMatrix<T>,
}

impl<T: Scalar> SecondVariations<T> {
    #[inline(always)]
    pub fn new(at: &StationMotion<T>, stress: &DualVector<T>) -> Self {
        let (s, e) = (at.polar.factor, at.e);
        let (mu, nu) = at.adjoint(stress);
        let nu_by_turn = mu.skew_times(&(s * e).skew()) + (s * nu).skew()
            - mu.outer(&at.q.axial()).double()
            - at.q.transpose().times_skew(&mu);
        SecondVariations {
            e,
            mu,
            nu,
            mu_e: mu.dot(&e),
            mu_s: mu.skew_times(&s),
            s_mu: s * mu,
            nu_by_turn,
        }
    }

    /// What a node contributes.
    #[inline(always)]
    pub fn of(&self, node: &NodePlace<T>, terms: &NodeTerms<T>) -> SecondTerms<T> {
        let (n, n_prime) = node.shape;
        let (x, x_axial) = (&node.x, &node.x_axial);
        let (mu, nu, mu_e) = (&self.mu, &self.nu, self.mu_e);
        let x_mu = x.transpose() * *mu;
        let mu_x_e = mu.skew_times(&terms.x_e);
        let (psi_mu, psi_nu) = (spread_variation(x, mu), spread_variation(x, nu));
        let turn = terms.turn.transpose();
        let theta = turned(x, mu) * n_prime
            + (turned(x, nu) - x.trace_minus() * mu_e - mu_x_e.transpose()) * n;
        let by_strain = terms.strain.transpose().times_skew(&self.s_mu);
        SecondTerms {
            by_strain: (x_axial.outer(mu).double() - x_mu.skew()) * n + turn * self.mu_s,
            by_turn: theta + turn * self.nu_by_turn + by_strain,
            mu: psi_mu * n,
            nu: (mu.outer(x_axial).double() + x_mu.skew()) * n_prime + (psi_nu - mu_x_e) * n,
            own: (node.c() * mu_e + self.e.skew().times_skew(&x_mu) - psi_nu) * n
                - psi_mu * n_prime,
        }
    }
}

/// [`SecondVariations`], node by node.
pub fn second_variations<'a>(
    at: &StationMotion,
    stress: &DualVector,
    nodes: impl Iterator<Item = (&'a NodePlace, &'a NodeTerms)> + 'a,
) -> impl Iterator<Item = SecondTerms> + 'a {
    let second = SecondVariations::new(at, stress);
    nodes.map(move |(node, terms)| second.of(node, terms))
}

/// Geometric stiffness, block by block: passed to `add(a, b, block)`.
///
/// Increments of two nodes commute, so that blocks on both sides of the diagonal are transposes of
/// each other.
pub fn geometric_stiffness(
    terms: &[NodeTerms],
    second: &[SecondTerms],
    mut add: impl FnMut(usize, usize, &Matrix6<f64>),
) {
    let nodes = || terms.iter().zip(second).enumerate();
    for (a, row) in nodes() {
        for (b, column) in nodes().skip(a) {
            let (block, by) = (geometric_block(row, column), row.1);
            if a == b {
                add(a, a, &(block + by.own).to_stiffness_matrix());
            } else {
                let block = block.to_stiffness_matrix();
                add(a, b, &block);
                add(b, a, &block.transpose());
            }
        }
    }
}

/// One block, but for what the node's own increment does on the diagonal.
fn geometric_block(
    (row, by): (&NodeTerms, &SecondTerms),
    (column, own): (&NodeTerms, &SecondTerms),
) -> DualMatrix {
    row.strain.transpose() * own.mu
        + row.turn.transpose() * own.nu
        + by.by_strain * column.strain
        + by.by_turn * column.turn
}

/// Variation of the strain rate `ė = Σ B_a V_a` at constant nodal velocities (docs/theory.md,
/// section 6.5): fills `rate`.
pub fn rate_variations(
    at: &StationMotion,
    rate: &DualVector,
    twists: impl Fn(usize) -> DualVector,
    places: &[NodePlace],
    terms: &mut [NodeTerms],
) {
    let a_inverse = at.polar.spread_inverse;
    let (s, e) = (at.polar.factor, at.e);
    let p = at.turn_to_strain();
    let mut omega = DualVector::zeros();
    for (a, node) in terms.iter().enumerate() {
        omega += node.turn * twists(a);
    }

    // Sums over the nodes of what multiplies Δρ and Δe.
    let mut omega_by_turn = (s * omega).skew();
    let mut rate_by_turn = (s * *rate).skew() + (at.q * omega).skew()
        - omega.outer(&at.q.axial()) * 2.0
        - omega.skew_times(&(s * e).skew());
    let mut rate_by_strain = -omega.skew_times(&s);
    for (a, node) in places.iter().enumerate() {
        let (n, n_prime) = node.shape;
        let v = twists(a);
        let c_by_turn = v.outer(&node.x_axial) * 2.0 + node.x.transpose().times_skew(&v);
        omega_by_turn += c_by_turn * n;
        let half = node.x.transpose().trace_minus_times(&v);
        rate_by_turn += c_by_turn * n_prime - (e.outer(&half) + (node.x * e.cross(&v)).skew()) * n;
        let xv = node.x_axial.dot(&v);
        let mut double = DualMatrix::zeros();
        double.primal.fill_diagonal(2.0 * xv.primal);
        double.dual.fill_diagonal(2.0 * xv.dual);
        rate_by_strain += (double + node.x.times_skew(&v)) * n;
    }
    for (b, (node, terms)) in places.iter().zip(terms).enumerate() {
        let (n, n_prime) = node.shape;
        let v = twists(b);
        let c_own = -(v.outer(&node.x_axial) * 2.0 + (node.x.transpose() * v).skew());
        let psi_omega = spread_variation(&node.x, &omega);
        let omega_variation = a_inverse * (omega_by_turn * terms.turn + (psi_omega + c_own) * n);
        let own_rate = e.outer(&node.x.trace_minus_times(&v)) + node.x.times_skew(&e.cross(&v));
        let direct = (c_own + psi_omega) * n_prime
            + (spread_variation(&node.x, rate) + own_rate + omega.skew_times(&terms.x_e)) * n;
        terms.rate = a_inverse
            * (direct
                + rate_by_turn * terms.turn
                + rate_by_strain * terms.strain
                + p * omega_variation);
    }
}
