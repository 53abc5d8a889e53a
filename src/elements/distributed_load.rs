//! Forces and moments per unit of a beam's reference length.
//!
//! They act on the sections between the nodes, whose motion the beam interpolates: the work is done
//! through the section's turn `A Δρ = Σ N_a C_a Δu_a` (see `beam`), so that a node's share of the load `w`
//! is `N_a C_aᵀ μ` with `μ = A⁻¹ w`.
//! See docs/theory.md, section 6.11.

use super::beam::{Beam, Station, about_axis, spread_variation, turned};
use super::shape::{gauss_legendre, shape_functions};
use super::{Contribution, Element, Instant, LoadFrame};
use crate::error::{Error, Result};
use crate::motion::{DualVector, skew};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use serde::{Deserialize, Serialize};

/// How the components of a load along a beam are directed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum BeamLoadFrame {
    /// Along the inertial axes.
    Space,
    /// Along the axes of the sections: the load follows them.
    Follower,
    /// As of an untwisted beam: axis 1 along the reference line, axis 2 the part of this direction that is perpendicular to
    /// it in the reference configuration; each section takes these axes with it.
    Untwisted(Vector3<f64>),
}

impl From<LoadFrame> for BeamLoadFrame {
    fn from(frame: LoadFrame) -> Self {
        match frame {
            LoadFrame::Space => BeamLoadFrame::Space,
            LoadFrame::Follower => BeamLoadFrame::Follower,
        }
    }
}

/// Loads along one beam element, taken together.
///
/// Each acts at one quadrature point for each node, with its integral times the point's Lagrange polynomial, so that however many
/// components and places there are, the beam is interpolated there only.
#[derive(Debug, Clone)]
pub struct DistributedLoad {
    nodes: Vec<usize>,
    stations: Vec<Station>,
    parts: Vec<LoadPart>,
}

/// One component of a load.
#[derive(Debug, Clone)]
struct LoadPart {
    /// Along the inertial axes, not those of the section.
    in_space: bool,
    /// Number of the signal.
    signal: usize,
    /// Force and moment at each station for a signal of 1.
    loads: Vec<Vector6<f64>>,
}

impl DistributedLoad {
    /// No load on `beam` yet.
    ///
    /// # Errors
    /// If the beam cannot be evaluated at its quadrature points.
    pub fn new(beam: &Beam) -> Result<Self> {
        let stations = gauss_legendre(beam.nodes().len());
        Ok(DistributedLoad {
            nodes: beam.nodes().to_vec(),
            stations: stations
                .into_iter()
                .map(|(xi, weight)| beam.station(xi, weight))
                .collect::<Result<_>>()?,
            parts: Vec::new(),
        })
    }

    /// Whether there is no load.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Adds a load of the signals of `[force; moment]` (`None` is zero) times a factor that is linear between the given
    /// places `(ξ, factor)`, which ascend from −1 to 1; two at the same ξ make a jump.
    ///
    /// # Errors
    /// As [`DistributedLoad::new`].
    pub fn add(
        &mut self,
        beam: &Beam,
        frame: BeamLoadFrame,
        signals: [Option<usize>; 6],
        places: &[(f64, f64)],
    ) -> Result<()> {
        let axes = self.axes(beam, frame)?;
        let rule = gauss_legendre(self.nodes.len() + 1);
        let points: Vec<f64> = gauss_legendre(self.nodes.len())
            .iter()
            .map(|point| point.0)
            .collect();
        let mut lengths = vec![0.0; points.len()];
        for pair in places.windows(2) {
            let ((start, first), (end, second)) = (pair[0], pair[1]);
            let half = 0.5 * (end - start);
            if half <= 0.0 || (first == 0.0 && second == 0.0) {
                continue;
            }
            for (point, weight) in &rule {
                let t = 0.5 * (point + 1.0);
                let xi = start + half * (point + 1.0);
                let factor = first + t * (second - first);
                let length = beam.stretch_at(xi)? * weight * half * factor;
                let shapes = shape_functions(&points, xi);
                for (sum, shape) in lengths.iter_mut().zip(shapes) {
                    *sum += shape.0 * length;
                }
            }
        }
        for (component, signal) in signals.into_iter().enumerate() {
            if let Some(signal) = signal {
                let unit = Vector6::ith(component, 1.0);
                let (force, moment) = halves(&unit);
                let loads = axes.iter().zip(&lengths);
                self.parts.push(LoadPart {
                    in_space: frame == BeamLoadFrame::Space,
                    signal,
                    loads: loads
                        .map(|(axes, length)| joined(&(axes * force), &(axes * moment)) * *length)
                        .collect(),
                });
            }
        }
        Ok(())
    }

    /// Axes of a load at each station, in those of the section; in the inertial frame if they are fixed there.
    ///
    /// # Errors
    /// If the direction of an untwisted beam is along its line.
    pub fn axes(&self, beam: &Beam, frame: BeamLoadFrame) -> Result<Vec<Matrix3<f64>>> {
        let points = gauss_legendre(self.nodes.len());
        let axes = self.stations.iter().zip(points);
        axes.map(|(station, (xi, _))| match frame {
            BeamLoadFrame::Space => Ok(Matrix3::identity()),
            BeamLoadFrame::Follower => Ok(about_axis(station.turn)),
            BeamLoadFrame::Untwisted(direction) => {
                let line = beam.axes_along_line(xi, &direction)?.ok_or_else(|| {
                    let expected = "a direction across the beam, all along it";
                    Error::value("axis_2", expected, "one along it")
                })?;
                let section = beam.section_motion(xi, beam.reference())?.rotation;
                Ok(about_axis(station.turn) * section.tr_mul(&line))
            }
        })
        .collect()
    }

    /// Loads of all parts at a station, along the inertial axes and along those that the nodes give the section.
    fn at(&self, station: usize, signals: &[f64]) -> [Vector6<f64>; 2] {
        let (mut space, mut follower) = (Vector6::zeros(), Vector6::zeros());
        for part in &self.parts {
            let sum = match part.in_space {
                true => &mut space,
                false => &mut follower,
            };
            *sum += part.loads[station] * signals[part.signal];
        }
        [space, follower]
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
        let mut terms = std::mem::take(&mut out.beam.terms);
        for (place, station) in self.stations.iter().enumerate() {
            let relative = |a: usize| states[0].motion.relative(&states[a].motion);
            let at = station.motion(relative)?;
            terms.clear();
            terms.extend(station.node_terms(&at, relative));

            // The load in the section's axes, and what it gains for an increment of the section.
            let [space, follower] = self.at(place, instant.signals);
            let (force, moment) = halves(&space);
            let section = states[0].motion.rotation * at.polar.rotation.primal;
            let (force, moment) = (section.tr_mul(&force), section.tr_mul(&moment));
            let mut variation = Matrix6::zeros();
            let mut columns = variation.fixed_view_mut::<3, 3>(0, 3);
            columns.copy_from(&skew(&force));
            let mut columns = variation.fixed_view_mut::<3, 3>(3, 3);
            columns.copy_from(&skew(&moment));
            let turns = space != Vector6::zeros();
            let load = DualVector::from_wrench(&(joined(&force, &moment) + follower));
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
                    if turns {
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
