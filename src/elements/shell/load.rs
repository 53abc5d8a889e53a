//! Loads on the surface of a shell element, and on its edges.

use super::Shell;
use crate::elements::LoadFrame;
use crate::elements::distributed_load::{DistributedLoad, LoadPoints};
use crate::elements::line_station::LineStation;
use crate::elements::shape::{gauss_legendre, lobatto_points, shape_functions};
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
        let points = self.load_points(place)?;
        let in_space = frame == LoadFrame::Space;
        Ok(DistributedLoad::at_points(points, in_space, signals))
    }

    /// The points at which a load acts.
    ///
    /// # Errors
    /// If there is no such edge, or the reference shape is too distorted.
    pub(in crate::elements) fn load_points(&self, place: ShellLoadPlace) -> Result<LoadPoints> {
        match place {
            ShellLoadPlace::Surface => Ok(self.points_of_surface()),
            ShellLoadPlace::Edge(edge) => self.points_of_edge(edge),
        }
    }

    fn points_of_surface(&self) -> LoadPoints {
        let places: Vec<_> = self.rule().into_iter().map(|(at, _)| at).collect();
        let stations = places.iter().map(|&at| self.grid.station(at, 0));
        LoadPoints {
            nodes: self.nodes.clone(),
            frames: self.frames.clone(),
            stations: stations.collect(),
            axes: self.points.iter().map(|point| point.axes.turn).collect(),
            sizes: self.points.iter().map(|point| point.area).collect(),
            places,
        }
    }

    fn points_of_edge(&self, edge: usize) -> Result<LoadPoints> {
        let edges = self.grid.edges();
        let Some(local) = edges.get(edge) else {
            return Err(Error::value("edge", "0 to 3", edge));
        };
        let points = lobatto_points(local.len());
        let mut found = LoadPoints {
            nodes: local.iter().map(|&a| self.nodes[a]).collect(),
            frames: local.iter().map(|&a| self.frames[a]).collect(),
            stations: Vec::new(),
            axes: Vec::new(),
            sizes: Vec::new(),
            places: Vec::new(),
        };
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
            let axes = Matrix3::from_columns(&[along, normal.cross(&along), normal]);
            found.axes.push(axes);
            let across = (first * first + second * second).sqrt();
            found.sizes.push(weight * place.area * across);
            let shapes = shape_functions(&points, x);
            found.stations.push(LineStation { shapes });
            found.places.push(at);
        }
        Ok(found)
    }
}
