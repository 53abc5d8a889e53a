//! Blades that are alike: each moves as the one behind it does later.

use super::Model;
use super::validation::direction;
use crate::error::{Error, Result, require_finite};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A rotor of `B` like blades, which turns once in a period: each blade is where the one before it
/// gets a `B`-th of the period later.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RotorSymmetry {
    /// Direction of the axis, of length 1: the rotor turns about it in the positive sense.
    axis: Vector3<f64>,
    /// A point of the axis.
    point: Vector3<f64>,
    /// Nodes that turn with the blades and belong to all of them.
    hub: Vec<usize>,
    /// Nodes of each blade, in the same order.
    blades: Vec<Vec<usize>>,
}

impl RotorSymmetry {
    /// Direction of the axis, of length 1.
    pub fn axis(&self) -> Vector3<f64> {
        self.axis
    }

    /// A point of the axis.
    pub fn point(&self) -> Vector3<f64> {
        self.point
    }

    /// Nodes that turn with the blades and belong to all of them.
    pub fn hub(&self) -> &[usize] {
        &self.hub
    }

    /// Nodes of each blade, in the same order.
    pub fn blades(&self) -> &[Vec<usize>] {
        &self.blades
    }
}

impl Model {
    /// Says that blades are alike, in place of what was said before: in the reference
    /// configuration blade `j + 1` is blade `j`, turned by `2π/B` about the axis through `point`,
    /// and in the motion it is where that one gets a `B`-th of the period later. The nodes of the
    /// `hub` turn with the blades; all others do not, and their motions repeat themselves after a
    /// `B`-th of the period. The axis is directed so that the rotor turns about it in the positive
    /// sense, once in a period.
    ///
    /// # Errors
    /// If an argument has no finite values, `axis` has no direction, there are less than two
    /// blades, they have no nodes, or not equally many; if a node does not exist or is named twice.
    pub fn set_rotor_symmetry(
        &mut self,
        axis: &Vector3<f64>,
        point: &Vector3<f64>,
        hub: &[usize],
        blades: &[Vec<usize>],
    ) -> Result<()> {
        let axis = direction("axis", axis)?.normalize();
        require_finite("point", point.as_slice())?;
        if blades.len() < 2 {
            return Err(Error::size("blades", "at least 2", blades.len()));
        }
        let count = blades[0].len();
        if count == 0 {
            return Err(Error::size("nodes_of_blade", "at least 1", 0));
        }
        for (j, blade) in blades.iter().enumerate() {
            if blade.len() != count {
                let expected = format!("{count} nodes, as blade 0 has");
                let name = format!("blades[{j}]");
                return Err(Error::size(&name, expected, blade.len()));
            }
        }
        let all: Vec<usize> = blades.iter().flatten().chain(hub).copied().collect();
        self.require_distinct_nodes(&all)?;
        self.rotor_symmetry = Some(RotorSymmetry {
            axis,
            point: *point,
            hub: hub.to_vec(),
            blades: blades.to_vec(),
        });
        Ok(())
    }

    /// Checks that a grid may have so many points: an odd number, or what like blades share.
    ///
    /// # Errors
    /// If it may not.
    pub fn require_grid_points(&self, name: &str, points: usize) -> Result<()> {
        let shared = self.rotor_symmetry.as_ref().map_or(1, |r| r.blades.len());
        if points % 2 == 1 || points > 0 && shared > 1 && points.is_multiple_of(shared) {
            return Ok(());
        }
        let mut expected = String::from("an odd number");
        if shared > 1 {
            expected += &format!(", or a multiple of the number of like blades, {shared}");
        }
        Err(Error::size(name, expected, points))
    }

    /// Which blades are alike, if that was said.
    pub fn rotor_symmetry(&self) -> Option<&RotorSymmetry> {
        self.rotor_symmetry.as_ref()
    }
}
