//! Geometrically exact plate and shell of any order, with six freedoms a node (docs/theory.md,
//! section 6.14).
//!
//! Over the surface motions are interpolated exactly as along beams: `G(ξ, η) = Σ N_a M_a`, polar
//! decomposition `G = R S`, and the strains are the "velocities" of `R` in ξ and in η. They are
//! sampled where they are most accurate in their own direction, so that nothing locks: each sample
//! is a station of a line, and what is constant between samples and resultants is the shell's.

mod factors;
mod forces;
mod frames;
mod grid;
mod load;
mod products;
mod reference;
mod results;
mod scratch;
mod section;
mod tangents;

pub use frames::{ShellFrames, element_frames};
pub use grid::NodeGrid;
pub use load::ShellLoadPlace;
pub use results::{ShellPoint, ShellSide, surface_stress};
pub(super) use scratch::Scratch;
pub use section::{IsotropicShell, Matrix12, ShellSection, Vector12};

use super::line_station::{LineStation, relative_to_first};
use crate::error::{Error, Result};
use crate::motion::{DualMatrix, Motion};
use grid::Sampling;
use nalgebra::{Matrix3, Vector3, Vector6};

/// Elastic and damping forces of one shell element.
#[derive(Debug, Clone)]
pub struct Shell {
    nodes: Vec<usize>,
    grid: NodeGrid,
    /// Reference motions of the nodes, and frames of the element in them.
    reference: Vec<Motion>,
    frames: Vec<Motion>,
    dual_frames: Vec<DualMatrix>,
    section: ShellSection,
    /// Whose part in the surface is axis 1, if it was given.
    direction: Option<Vector3<f64>>,
    /// Resultants where nothing is strained.
    prestress: Vector12,
    damped: bool,
    sampling: Sampling,
    samples: Vec<Sample>,
    points: Vec<Point>,
}

/// Where a strain is sampled.
#[derive(Debug, Clone)]
struct Sample {
    line: LineStation,
    /// Its shape functions, and then their derivatives.
    shapes: [Vec<f64>; 2],
    /// "Velocity" of the reference configuration.
    reference: Vector6<f64>,
}

/// A Gauss point, where the constitutive law acts.
#[derive(Debug, Clone)]
struct Point {
    /// Reference area that it stands for.
    area: f64,
    axes: Axes,
}

/// Axes of a place in the surface.
#[derive(Debug, Clone)]
struct Axes {
    /// Axes 1 and 2 and the normal, in the frame that the nodes give it.
    turn: Matrix3<f64>,
    /// `∂ξ_i/∂s_α`: of each axis, the slopes of ξ and η.
    slopes: [[f64; 2]; 2],
}

/// A place of the surface in the reference configuration.
struct Place {
    /// Of the frame that the nodes give it, in the inertial frame.
    motion: Motion,
    /// Area for a unit of ξ and η.
    area: f64,
    axes: Axes,
}

/// A normal shorter than this part of the product of its tangents' lengths vanishes.
const VANISHING: f64 = 1e-6;

impl Shell {
    /// A shell over a grid of `sides` nodes along ξ and η (2 or more each; node `i n_η + j` at the
    /// Gauss–Lobatto points `(ξ_i, η_j)`), whose reference shape interpolates the frames that the
    /// nodes, at `reference`, carry at `frames` relative to their own.
    ///
    /// Axes 1 and 2 of the section are as close to the directions of ξ and η as they can be at a
    /// right angle or, if it is given, axis 1 is the part of `direction` in the surface.
    ///
    /// # Errors
    /// If numbers do not fit each other, or the reference shape has no normal somewhere, or is too
    /// distorted to interpolate.
    pub fn new(
        (nodes, sides): (Vec<usize>, [usize; 2]),
        (reference, frames): (Vec<Motion>, Vec<Motion>),
        section: ShellSection,
        direction: Option<Vector3<f64>>,
    ) -> Result<Self> {
        let count = sides[0] * sides[1];
        if sides.iter().any(|&side| side < 2) || nodes.len() != count {
            let expected = "at least 2 × 2 nodes for a shell, as many as its sides say";
            return Err(Error::size("nodes", expected, nodes.len()));
        }
        if reference.len() != count || frames.len() != count {
            return Err(Error::size("frames", count, frames.len()));
        }
        let mut shell = Shell {
            nodes,
            grid: NodeGrid::new(sides),
            dual_frames: frames.iter().map(Motion::to_dual).collect(),
            reference,
            frames,
            damped: section.damping != Matrix12::zeros(),
            section,
            direction,
            prestress: Vector12::zeros(),
            sampling: Sampling::new(sides),
            samples: Vec::new(),
            points: Vec::new(),
        };
        shell.find_samples()?;
        shell.find_points()?;
        Ok(shell)
    }

    /// The same with resultants where nothing is strained, along the section's axes.
    pub fn with_prestress(mut self, resultants: &Vector12) -> Self {
        self.prestress = *resultants;
        self
    }

    /// Nodes along ξ and η.
    pub fn sides(&self) -> [usize; 2] {
        self.grid.sides
    }

    /// Its section.
    pub fn section(&self) -> &ShellSection {
        &self.section
    }

    /// Reference area.
    pub fn area(&self) -> f64 {
        self.points.iter().map(|point| point.area).sum()
    }

    /// Whether it has mass.
    pub fn has_mass(&self) -> bool {
        self.section.mass != nalgebra::Matrix6::zeros()
    }
}
