//! Second variations of a beam's strains (docs/theory.md, sections 6.4 and 6.5).

use super::station::{NodeTerms, StationMotion};
use crate::motion::{DualMatrix, DualVector};
use nalgebra::Matrix6;

/// `2 w xᵀ − X w̃` with `x = axial(X)`: the part of `−ΔA w` that a node's own increment causes.
pub(in crate::elements) fn spread_variation(x: &DualMatrix, w: &DualVector) -> DualMatrix {
    w.outer(&x.axial()) * 2.0 - *x * w.skew()
}

/// `2 w xᵀ − (X w)~`: the part of `ΔCᵀ w` that the section's turn causes; a node's own increment
/// causes minus its [`spread_variation`].
pub(in crate::elements) fn turned(x: &DualMatrix, w: &DualVector) -> DualMatrix {
    w.outer(&x.axial()) * 2.0 - (*x * *w).skew()
}

/// Second variation of `σᵀ Δe` at constant `σ` (docs/theory.md, section 6.4): fills `mu` and `nu`
/// of every node and returns `(μ, ν)`.
///
/// With `μ = A⁻¹ σ` and `ν = A⁻¹ Pᵀ μ`, a node's force is
/// `N' Cᵀ μ + N (Cᵀ ν + 2 (μᵀe) x + ẽ Xᵀ μ)`; its variation needs those of `μ`, `ν`, `e` and `ρ`.
pub(super) fn adjoint_variations(
    at: &StationMotion,
    stress: &DualVector,
    nodes: &mut [NodeTerms],
) -> (DualVector, DualVector) {
    let a_inverse = at.polar.spread_inverse;
    let s = at.polar.factor;
    let p_transposed = at.turn_to_strain().transpose();
    let mu = a_inverse * *stress;
    let nu = a_inverse * (p_transposed * mu);
    let (mu_skew, e_skew) = (mu.skew(), at.e.skew());
    let s_mu = (s * mu).skew();
    // Part of A Δν that comes through the section's turn.
    let nu_by_turn = mu_skew * (s * at.e).skew() + (s * nu).skew()
        - mu.outer(&at.q.axial()) * 2.0
        - at.q.transpose() * mu_skew;
    let mu_s = mu_skew * s;
    for node in nodes {
        let (n, n_prime) = node.shape;
        node.mu = a_inverse * (s_mu * node.turn + spread_variation(&node.x, &mu) * n);
        let x_mu = (node.x.transpose() * mu).skew();
        let direct = (mu.outer(&node.x_axial) * 2.0 + x_mu) * n_prime
            + (spread_variation(&node.x, &nu) - mu_skew * (node.x * e_skew)) * n;
        node.nu = a_inverse
            * (nu_by_turn * node.turn + direct + mu_s * node.strain + p_transposed * node.mu);
    }
    (mu, nu)
}

/// Geometric stiffness, block by block: passed to `add(a, b, block)`.
///
/// Increments of two nodes commute, so that blocks on both sides of the diagonal are transposes of
/// each other.
pub(super) fn geometric_stiffness(
    at: &StationMotion,
    (mu, nu): (&DualVector, &DualVector),
    nodes: &[NodeTerms],
    mut add: impl FnMut(usize, usize, &Matrix6<f64>),
) {
    let e_skew = at.e.skew();
    let mu_e = mu.dot(&at.e);
    let mu_skew = mu.skew();
    for (a, node) in nodes.iter().enumerate() {
        let (n, n_prime) = node.shape;
        let c_transposed = node.c.transpose();
        let x_transposed = node.x.transpose();
        let x_mu = (x_transposed * *mu).skew();
        let by_mu =
            c_transposed * n_prime + (node.x_axial.outer(&at.e) * 2.0 + e_skew * x_transposed) * n;
        let by_nu = c_transposed * n;
        let by_strain = (node.x_axial.outer(mu) * 2.0 - x_mu) * n;
        let by_turn = turned(&node.x, mu) * n_prime
            + (turned(&node.x, nu)
                - node.x.trace_minus() * mu_e
                - e_skew * (x_transposed * mu_skew))
                * n;
        for (b, other) in nodes.iter().enumerate().skip(a) {
            let block = by_mu * other.mu
                + by_nu * other.nu
                + by_strain * other.strain
                + by_turn * other.turn;
            if a == b {
                let own = (node.c * mu_e + e_skew * x_mu - spread_variation(&node.x, nu)) * n
                    - spread_variation(&node.x, mu) * n_prime;
                add(a, a, &(block + own).to_stiffness_matrix());
            } else {
                let block = block.to_stiffness_matrix();
                add(a, b, &block);
                add(b, a, &block.transpose());
            }
        }
    }
}

/// Variation of the strain rate `ė = Σ B_a V_a` at constant nodal velocities (docs/theory.md,
/// section 6.5): fills `rate`.
pub(super) fn rate_variations(
    at: &StationMotion,
    rate: &DualVector,
    twists: impl Fn(usize) -> DualVector,
    nodes: &mut [NodeTerms],
) {
    let a_inverse = at.polar.spread_inverse;
    let (s, e) = (at.polar.factor, at.e);
    let p = at.turn_to_strain();
    let e_skew = e.skew();
    let mut omega = DualVector::zeros();
    for (a, node) in nodes.iter().enumerate() {
        omega += node.turn * twists(a);
    }
    let omega_skew = omega.skew();

    // Sums over the nodes of what multiplies Δρ and Δe.
    let mut omega_by_turn = (s * omega).skew();
    let mut rate_by_turn = (s * *rate).skew() + (at.q * omega).skew()
        - omega.outer(&at.q.axial()) * 2.0
        - omega_skew * (s * e).skew();
    let mut rate_by_strain = -(omega_skew * s);
    for (a, node) in nodes.iter().enumerate() {
        let (n, n_prime) = node.shape;
        let v = twists(a);
        let c_by_turn = v.outer(&node.x_axial) * 2.0 + node.x.transpose() * v.skew();
        omega_by_turn += c_by_turn * n;
        let ev = e_skew * v;
        let half = node.x.trace_minus().transpose() * v;
        rate_by_turn += c_by_turn * n_prime - (e.outer(&half) + (node.x * ev).skew()) * n;
        let xv = node.x_axial.dot(&v);
        let mut double = DualMatrix::zeros();
        double.primal.fill_diagonal(2.0 * xv.primal);
        double.dual.fill_diagonal(2.0 * xv.dual);
        rate_by_strain += (double + node.x * v.skew()) * n;
    }
    for (b, node) in nodes.iter_mut().enumerate() {
        let (n, n_prime) = node.shape;
        let v = twists(b);
        let c_own = -(v.outer(&node.x_axial) * 2.0 + (node.x.transpose() * v).skew());
        let omega_variation = a_inverse
            * (omega_by_turn * node.turn + (spread_variation(&node.x, &omega) + c_own) * n);
        let own_rate = e.outer(&(node.c.transpose() * v)) + node.x * (e_skew * v).skew();
        let direct = (c_own + spread_variation(&node.x, &omega)) * n_prime
            + (spread_variation(&node.x, rate) + own_rate + omega_skew * node.x * e_skew) * n;
        node.rate = a_inverse
            * (direct
                + rate_by_turn * node.turn
                + rate_by_strain * node.strain
                + p * omega_variation);
    }
}
