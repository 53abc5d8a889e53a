//! A beam element in its reference configuration: its line, the axes of its sections, lengths and
//! inertia.

use super::{Beam, Station, about_axis};
use crate::elements::Inertia;
use crate::elements::line_station::{LineStation, relative_to_first};
use crate::elements::shape::{gauss_legendre, shape_functions};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::motion::{DualMatrix, Motion};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Motions relative to the first.
fn relative(motions: &[Motion]) -> Vec<DualMatrix> {
    relative_to_first(motions.iter()).collect()
}

/// A direction with less across a line than this part of it is along that.
const ACROSS: f64 = 1e-9;

impl Beam {
    /// Quadrature points and weights, so many from each station of the section table to the next.
    pub(super) fn pieces(&self, points: usize) -> Vec<(f64, f64)> {
        let rule = gauss_legendre(points);
        let ends = self.sections.pieces();
        let piece = |ends: &[f64]| {
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            rule.iter()
                .map(move |(x, weight)| (middle + half * x, half * weight))
                .collect::<Vec<_>>()
        };
        ends.windows(2).flat_map(piece).collect()
    }

    /// Reference motions of the nodes without their twist.
    fn untwisted_nodes(&self) -> Vec<Motion> {
        let nodes = self.points.iter().zip(&self.reference);
        let untwisted = |(&xi, motion): (&f64, &Motion)| {
            let twist = about_axis(-self.sections.twist(xi));
            Motion::new(motion.rotation * twist, motion.position)
        };
        nodes.map(untwisted).collect()
    }

    /// Frame in which the section at `xi` is described, in the reference configuration, without and
    /// with its twist.
    fn reference_frames(&self, xi: f64) -> Result<(Motion, Motion)> {
        let shapes = shape_functions(&self.points, xi);
        let station = LineStation { shapes };
        let nodes = self.untwisted_nodes();
        let line = station.motion(&relative(&nodes))?;
        let line = nodes[0].compose(&line.polar.motion());
        let twist = about_axis(self.sections.twist(xi));
        let section = Motion::new(line.rotation * twist, line.position);
        Ok((line, section))
    }

    /// Axes at `xi` in the reference configuration: axis 1 along the line, axis 2 the part of
    /// `direction` that is perpendicular to it. None if it has no such part.
    pub(in crate::elements) fn axes_along_line(
        &self,
        xi: f64,
        direction: &Vector3<f64>,
    ) -> Result<Option<Matrix3<f64>>> {
        // Of moderate length, whatever it was given.
        let direction = direction / direction.amax();
        let along: Vector3<f64> = self.reference_frames(xi)?.0.rotation.column(0).into();
        let across = direction - along * along.dot(&direction);
        if across.norm() <= ACROSS * direction.norm() {
            return Ok(None);
        }
        let across = across.normalize();
        let axes = [along, across, along.cross(&across)];
        Ok(Some(Matrix3::from_columns(&axes)))
    }

    /// The station at `xi`, with this weight.
    pub(in crate::elements) fn station(&self, xi: f64, weight: f64) -> Result<Station> {
        let mut station = Station {
            weight,
            section: self.sections.at(xi),
            ..Station::bare(shape_functions(&self.points, xi))
        };
        let kinematics = station.line.motion(&relative(&self.reference))?;
        station.reference = kinematics.e.to_twist();
        station.stretch = self.stretch_at(xi)?;
        if self.sections.has_corners() {
            let own = self.reference_frames(xi)?.1.rotation;
            let given = self.reference[0].compose(&kinematics.polar.motion());
            let turn = given.rotation.tr_mul(&own);
            station.turn = (turn[(2, 1)] - turn[(1, 2)]).atan2(turn[(1, 1)] + turn[(2, 2)]);
            station.section = station.section.turned(station.turn);
        }
        let span = self
            .reference
            .iter()
            .map(|m| (m.position - self.reference[0].position).norm())
            .fold(0.0, f64::max);
        if station.stretch <= 1e-9 * span {
            return Err(Error::new(
                ErrorKind::Value,
                "nodes: a beam element needs nodes at distinct positions, in order along the beam",
            ));
        }
        Ok(station)
    }

    /// Reference length for each unit of ξ at `xi`: that of the line, whatever twist does to its
    /// interpolation.
    ///
    /// # Errors
    /// If the reference shape is too distorted there.
    pub fn stretch_at(&self, xi: f64) -> Result<f64> {
        if let Some(stretch) = self.even {
            return Ok(stretch);
        }
        let shapes = shape_functions(&self.points, xi);
        let station = LineStation { shapes };
        let line = if self.sections.is_twisted() {
            station.motion(&relative(&self.untwisted_nodes()))?
        } else {
            station.motion(&relative(&self.reference))?
        };
        Ok(line.e.to_twist().fixed_rows::<3>(0).norm())
    }

    /// Length of the reference line.
    pub fn length(&self) -> f64 {
        self.stations.iter().map(|s| s.weight * s.stretch).sum()
    }

    /// Reference length from the element's start to `xi`.
    pub fn length_to(&self, xi: f64) -> Result<f64> {
        let half = 0.5 * (xi + 1.0);
        if let Some(stretch) = self.even {
            return Ok(2.0 * half * stretch);
        }
        // A smooth integrand, exact for straight elements; two points more for curved ones.
        gauss_legendre(self.nodes.len() + 2)
            .into_iter()
            .map(|(x, weight)| Ok(weight * half * self.stretch_at(half * (x + 1.0) - 1.0)?))
            .sum()
    }

    /// Where a share, from 0 to 1, of the reference length is reached.
    pub fn xi_at(&self, share: f64) -> Result<f64> {
        if share <= 0.0 || share >= 1.0 || self.even.is_some() {
            return Ok(2.0 * share.clamp(0.0, 1.0) - 1.0);
        }
        let length = self.length_to(1.0)? * share;
        let mut xi = 2.0 * share - 1.0;
        for _ in 0..20 {
            let change = (self.length_to(xi)? - length) / self.stretch_at(xi)?;
            xi = (xi - change).clamp(-1.0, 1.0);
            if change.abs() < 1e-14 {
                break;
            }
        }
        Ok(xi)
    }

    /// The element's inertia, integrated by one quadrature point for each node from station to
    /// station of the section table.
    ///
    /// Nodal velocities are first carried to the section's reference frame, then interpolated, so
    /// that the matrix is constant and a rigid motion has exact inertia.
    pub fn inertia(&self) -> Result<Inertia> {
        let count = self.nodes.len();
        let mut mass = vec![Matrix6::zeros(); count * count];
        for (xi, weight) in self.pieces(count) {
            let station = self.station(xi, weight)?;
            let section = if self.sections.is_twisted() {
                self.reference_frames(xi)?.1
            } else {
                let section = station.line.polar(&relative(&self.reference))?;
                self.reference[0].compose(&section.motion())
            };
            let carry: Vec<Matrix6<f64>> = self
                .reference
                .iter()
                .zip(station.line.shapes())
                .map(|(node, shape)| section.relative(node).adjoint() * shape)
                .collect();
            let length = weight * station.stretch;
            let own = self.sections.at(xi).mass;
            for a in 0..count {
                let left = carry[a].transpose() * own * length;
                for (b, right) in carry.iter().enumerate() {
                    mass[a * count + b] += left * right;
                }
            }
        }
        for block in &mass {
            require_finite("inertia of the beam", block.as_slice())?;
        }
        let inertia = Inertia::consistent(self.nodes.clone(), mass, &self.reference);
        let spin = Vector6::new(0.0, 0.0, 0.0, self.spin, 0.0, 0.0);
        Ok(match self.spin == 0.0 {
            true => inertia,
            false => inertia.spinning(&vec![spin; count]),
        })
    }
}
