//! Forces and moments per unit of a beam's reference length.
//!
//! They act on the sections between the nodes, whose motion the beam interpolates: the work is done
//! through the section's turn `A Δρ = Σ N_a C_a Δu_a` (see `beam`), so that a node's share of the load `w`
//! is `N_a C_aᵀ μ` with `μ = A⁻¹ w`.

use super::beam::{Beam, Station, spread_variation, turned};
use super::shape::gauss_legendre;
use super::{Contribution, Element, Instant, LoadFrame};
use crate::error::Result;
use crate::motion::{DualVector, skew};
use nalgebra::{Matrix6, Vector3, Vector6};

/// Load along one beam element.
#[derive(Debug, Clone)]
pub struct DistributedLoad {
    nodes: Vec<usize>,
    frame: LoadFrame,
    /// Signal numbers of `[force; moment]`; `None` is zero.
    signals: [Option<usize>; 6],
    /// Quadrature points, each with the length of reference line that it stands for times the factor of
    /// the load there.
    stations: Vec<(Station, f64)>,
}

impl DistributedLoad {
    /// Load on `beam` of the signals times a factor that is linear between the given places
    /// `(ξ, factor)`, which ascend from −1 to 1; two at the same ξ make a jump.
    ///
    /// Between places it is integrated by one point for each node.
    ///
    /// # Errors
    /// If the beam cannot be evaluated at its quadrature points.
    pub fn new(
        beam: &Beam,
        frame: LoadFrame,
        signals: [Option<usize>; 6],
        places: &[(f64, f64)],
    ) -> Result<Self> {
        let rule = gauss_legendre(beam.nodes().len());
        let mut stations = Vec::new();
        for pair in places.windows(2) {
            let ((start, first), (end, second)) = (pair[0], pair[1]);
            let half = 0.5 * (end - start);
            if half <= 0.0 || (first == 0.0 && second == 0.0) {
                continue;
            }
            for (point, weight) in &rule {
                let t = 0.5 * (point + 1.0);
                let station = beam.station(start + half * (point + 1.0), weight * half)?;
                let factor = first + t * (second - first);
                let length = station.weight * station.stretch;
                stations.push((station, factor * length));
            }
        }
        Ok(DistributedLoad {
            nodes: beam.nodes().to_vec(),
            frame,
            signals,
            stations,
        })
    }
}

/// Force and moment of a wrench.
fn halves(w: &Vector6<f64>) -> (Vector3<f64>, Vector3<f64>) {
    (
        w.fixed_rows::<3>(0).into_owned(),
        w.fixed_rows::<3>(3).into_owned(),
    )
}

fn joined(force: &Vector3<f64>, moment: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

impl Element for DistributedLoad {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let states = instant.nodes;
        let given = Vector6::from_fn(|i, _| self.signals[i].map_or(0.0, |s| instant.signals[s]));
        let (force, moment) = halves(&given);
        let mut terms = std::mem::take(&mut out.beam.terms);
        for (station, length) in &self.stations {
            let relative = |a: usize| states[0].motion.relative(&states[a].motion);
            let at = station.motion(relative)?;
            terms.clear();
            terms.extend(station.node_terms(&at, relative));

            // The load in the section's axes, and what it gains for an increment of the section.
            let mut variation = Matrix6::zeros();
            let load = match self.frame {
                LoadFrame::Follower => given,
                LoadFrame::Space => {
                    let section = states[0].motion.rotation * at.polar.rotation.primal;
                    let (force, moment) = (section.tr_mul(&force), section.tr_mul(&moment));
                    let mut columns = variation.fixed_view_mut::<3, 3>(0, 3);
                    columns.copy_from(&(skew(&force) * *length));
                    let mut columns = variation.fixed_view_mut::<3, 3>(3, 3);
                    columns.copy_from(&(skew(&moment) * *length));
                    joined(&force, &moment)
                }
            };
            let load = DualVector::from_wrench(&(load * *length));
            let mu = at.polar.spread_inverse * load;
            for (a, node) in terms.iter().enumerate() {
                out.add_force(a, &-(node.turn.transpose() * load).to_wrench());
            }
            if !out.with_tangents {
                continue;
            }

            // Δμ = A⁻¹ (Δw − ΔA μ); the part by ΔA is dual, that by Δw is not.
            let s_mu = (at.polar.factor * mu).skew();
            for node in &mut terms {
                node.mu = at.polar.spread_inverse
                    * (s_mu * node.turn + spread_variation(node, &mu) * node.shape.0);
            }
            for (a, node) in terms.iter().enumerate() {
                let n = node.shape.0;
                let by_turn = turned(node, &mu) * n;
                let by_mu = node.c.transpose() * n;
                let own = spread_variation(node, &mu) * n;
                let turn_transposed = node.turn.to_twist_matrix().transpose();
                for (b, other) in terms.iter().enumerate() {
                    let mut block = by_turn * other.turn + by_mu * other.mu;
                    if a == b {
                        block = block - own;
                    }
                    let mut k = block.to_stiffness_matrix();
                    if self.frame == LoadFrame::Space {
                        k += turn_transposed * variation * other.turn.to_twist_matrix();
                    }
                    out.add_stiffness(a, b, &-k);
                }
            }
        }
        out.beam.terms = terms;
        Ok(())
    }
}
