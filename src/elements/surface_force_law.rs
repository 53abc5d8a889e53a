//! Functions of the user for forces at points of shells and beams.

use super::distributed_load::BeamLoadFrame;
use super::load::LoadFrame;
use super::shell::ShellLoadPlace;
use crate::error::Result;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// Where a user's forces act on an element.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum ForcePlace {
    /// On the surface of a shell, as [`ShellLoadPlace::Surface`].
    Surface,
    /// On an edge of a shell, as [`ShellLoadPlace::Edge`].
    Edge(usize),
    /// On the line of a beam, per unit of reference length. Axes of a follower are those of the
    /// section.
    Line,
    /// The same, but for axes: those of [`BeamLoadFrame::Untwisted`].
    UntwistedLine(Vector3<f64>),
}

impl ForcePlace {
    /// Where on a shell it is; none if it is on a beam.
    pub fn on_shell(self) -> Option<ShellLoadPlace> {
        match self {
            ForcePlace::Surface => Some(ShellLoadPlace::Surface),
            ForcePlace::Edge(edge) => Some(ShellLoadPlace::Edge(edge)),
            ForcePlace::Line | ForcePlace::UntwistedLine(_) => None,
        }
    }

    /// Axes that a follower on a beam has; those of the section where it is on a shell.
    pub fn axes_on_beam(self) -> BeamLoadFrame {
        match self {
            ForcePlace::UntwistedLine(direction) => BeamLoadFrame::Untwisted(direction),
            _ => BeamLoadFrame::Follower,
        }
    }
}

impl From<ShellLoadPlace> for ForcePlace {
    fn from(place: ShellLoadPlace) -> Self {
        match place {
            ShellLoadPlace::Surface => ForcePlace::Surface,
            ShellLoadPlace::Edge(edge) => ForcePlace::Edge(edge),
        }
    }
}

/// What a [`SurfaceForceFunction`] may depend on: time, and the motions of points of one element.
#[derive(Debug, Clone, Copy)]
pub struct SurfaceForceInput<'a> {
    /// Time.
    pub time: f64,
    /// Number of the shell element, or of the beam element.
    pub element: usize,
    /// Where on it, which tells beams from shells.
    pub place: ForcePlace,
    /// Places `(ξ, η)` of the points; of a beam `(ξ, 0)`.
    pub places: &'a [[f64; 2]],
    /// Reference areas, or lengths of an edge or beam, that the points stand for: weights of a
    /// quadrature.
    pub sizes: &'a [f64],
    /// Positions, in the inertial frame.
    pub positions: &'a [Vector3<f64>],
    /// Rotation matrices, whose columns are the axes of the section, the normal of a shell last, or
    /// of the edge.
    pub rotations: &'a [Matrix3<f64>],
    /// `[velocity; angular velocity]` relative to the inertial frame, along its or these axes. In a
    /// frame that turns steadily, positions, rotations and these are along its axes.
    pub velocities: &'a [Vector6<f64>],
}

/// Where a [`SurfaceForceFunction`] writes; everything is zero at first.
///
/// All is resolved in the same axes as the velocities, for a unit of reference area or length.
/// Increments are `[displacement; turn]` of a point; derivatives by motion are at fixed components
/// of the velocity.
#[derive(Debug)]
pub struct SurfaceForceOutput<'a> {
    /// `[force; moment]` at each point, by what happens at this point alone.
    pub forces: &'a mut [Vector6<f64>],
    /// `∂force/∂increment` and `∂force/∂velocity` of each point, if wanted.
    pub tangents: Option<[&'a mut [Matrix6<f64>]; 2]>,
}

/// A user's function for the forces at points of a shell or beam.
pub type SurfaceForceFunction =
    Arc<dyn Fn(&SurfaceForceInput, &mut SurfaceForceOutput) -> Result<()> + Send + Sync>;

/// A user's forces on shells or beams, as the model keeps them.
#[derive(Clone)]
pub struct SurfaceForceLaw {
    /// The function.
    pub function: SurfaceForceFunction,
    /// Whether it gives tangents; otherwise they are differenced.
    pub gives_tangents: bool,
    /// Axes of velocities, forces and tangents: inertial, or of the points.
    pub frame: LoadFrame,
}

impl fmt::Debug for SurfaceForceLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SurfaceForceLaw")
            .field("gives_tangents", &self.gives_tangents)
            .field("frame", &self.frame)
            .finish_non_exhaustive()
    }
}
