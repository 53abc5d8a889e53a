//! Loads on the surface of a shell element, and on its edges.

use super::Shell;
use crate::elements::line_station::LineStation;
use crate::elements::shape::{gauss_legendre, lobatto_points, shape_functions};
use crate::elements::{DistributedLoad, LoadFrame};
use crate::error::{Error, Result};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// Where a load acts on a shell element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ShellLoadPlace {
    /// On its surface, per unit of reference area. Axes of a follower are those of the section: a
    /// pressure is component 3, along the normal.
    Surface,
    /// On an edge, per unit of reference length: 0 to 3 are `η = −1`, `ξ = 1`, `η = 1` and
    /// `ξ = −1`. Axes of a follower: 1 along the edge, in the direction of ξ or η, 3 along the
    /// normal, 2 across the edge in the surface.
    Edge(usize),
}

impl Shell {
    /// A load with the signals of `[force; moment]` (`None` is zero), along the inertial axes or
    /// following those of the place.
    ///
    /// # Errors
    /// If there is no such edge, or the reference shape is too distorted.
    pub fn load(
        &self,
        place: ShellLoadPlace,
        frame: LoadFrame,
        signals: [Option<usize>; 6],
    ) -> Result<DistributedLoad> {
        match place {
            ShellLoadPlace::Surface => self.surface_load(frame, signals),
            ShellLoadPlace::Edge(edge) => self.edge_load(edge, frame, signals),
        }
    }

    fn surface_load(
        &self,
        frame: LoadFrame,
        signals: [Option<usize>; 6],
    ) -> Result<DistributedLoad> {
        let in_space = frame == LoadFrame::Space;
        let axes = |point: &super::Point| match in_space {
            true => Matrix3::identity(),
            false => point.axes.turn,
        };
        let axes: Vec<_> = self.points.iter().map(axes).collect();
        let areas: Vec<_> = self.points.iter().map(|point| point.area).collect();
        let stations = self
            .rule()
            .into_iter()
            .map(|(at, _)| self.grid.station(at, 0));
        Ok(DistributedLoad::between(
            (self.nodes.clone(), self.frames.clone()),
            stations.collect(),
            (in_space, &axes),
            &areas,
            signals,
        ))
    }

    fn edge_load(
        &self,
        edge: usize,
        frame: LoadFrame,
        signals: [Option<usize>; 6],
    ) -> Result<DistributedLoad> {
        let edges = self.grid.edges();
        let Some(local) = edges.get(edge) else {
            return Err(Error::value("edge", "0 to 3", edge));
        };
        let in_space = frame == LoadFrame::Space;
        let points = lobatto_points(local.len());
        let (mut stations, mut axes, mut lengths) = (Vec::new(), Vec::new(), Vec::new());
        for (x, weight) in gauss_legendre(local.len()) {
            let at = match edge {
                0 => [x, -1.0],
                1 => [1.0, x],
                2 => [x, 1.0],
                _ => [-1.0, x],
            };
            let place = self.place(at, None)?;
            // Along the edge, as the section's axes and the slopes of the other coordinate tell.
            let [first, second] = place
                .axes
                .slopes
                .map(|slopes| slopes[usize::from(edge.is_multiple_of(2))]);
            let along = place.axes.turn * Vector3::new(second, -first, 0.0);
            let sign = if edge.is_multiple_of(2) { 1.0 } else { -1.0 };
            let along = along.normalize() * sign;
            let normal: Vector3<f64> = place.axes.turn.column(2).into();
            axes.push(match in_space {
                true => Matrix3::identity(),
                false => Matrix3::from_columns(&[along, normal.cross(&along), normal]),
            });
            let across = (first * first + second * second).sqrt();
            lengths.push(weight * place.area * across);
            let shapes = shape_functions(&points, x);
            stations.push(LineStation { shapes });
        }
        let numbers = local.iter().map(|&a| self.nodes[a]).collect();
        let frames = local.iter().map(|&a| self.frames[a]).collect();
        Ok(DistributedLoad::between(
            (numbers, frames),
            stations,
            (in_space, &axes),
            &lengths,
            signals,
        ))
    }
}
