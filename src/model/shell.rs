//! Plates and shells: elements over nodes.

use super::validation::{direction, require_positive};
use super::{InertiaDefinition, Model};
use crate::elements::{NodeGrid, Shell, ShellFrames, ShellSection, Vector12, element_frames};
use crate::error::{Error, Result, require_finite, require_id, require_positive_number};
use crate::motion::Motion;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::sync::Arc;

/// Fewest and most nodes along a side of a shell element.
const SIDES: std::ops::RangeInclusive<usize> = 2..=16;

/// A shell element over nodes.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ShellDefinition {
    /// The nodes: number `i n_η + j` is at the Gauss–Lobatto points `(ξ_i, η_j)`.
    pub nodes: Vec<usize>,
    /// Nodes along ξ and along η.
    pub sides: [usize; 2],
    /// Frames of the element in those of its nodes.
    pub frames: Vec<Motion>,
    /// Stiffness, damping and mass per unit of reference area.
    pub section: ShellSection,
    /// Direction whose part in the surface is axis 1 of the section; if none is given, axes 1 and 2
    /// are as close to ξ and η as they can be.
    pub direction: Option<Vector3<f64>>,
    /// Factors of stiffness, mass and damping.
    pub factors: [f64; 3],
    /// Factor of the thickness, see [`ShellSection::thickened`].
    #[serde(default = "one")]
    pub thickness: f64,
    /// Resultants where nothing is strained.
    #[serde(default = "Vector12::zeros")]
    pub prestress: Vector12,
}

/// The factor of what is as it was given.
fn one() -> f64 {
    1.0
}

impl ShellDefinition {
    /// The section with its factors.
    fn scaled(&self) -> ShellSection {
        let section = match self.thickness {
            1.0 => self.section,
            factor => self.section.thickened(factor),
        };
        section.scaled(&self.factors)
    }

    /// Checks that the section times its factors is of numbers, and the thickness more than zero.
    pub(super) fn require_finite(&self) -> Result<()> {
        require_positive_number("factor of the thickness", self.thickness)?;
        let section = self.scaled();
        require_finite("shell stiffness", section.stiffness.as_slice())?;
        require_finite("shell damping", section.damping.as_slice())?;
        require_finite("shell mass", section.mass.as_slice())
    }
}

/// How a shell lies on its nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShellPlacement {
    /// Frames that its elements interpolate.
    pub frames: ShellFrames,
    /// Distance of the reference surface, to which the section belongs, from the nodes, along the
    /// normal.
    pub offset: f64,
    /// Direction whose part in the surface is axis 1 of the section, in the inertial frame; if none
    /// is given, axes 1 and 2 are as close to ξ and η as they can be.
    pub direction: Option<Vector3<f64>>,
}

impl Default for ShellPlacement {
    fn default() -> Self {
        ShellPlacement {
            frames: ShellFrames::Normals,
            offset: 0.0,
            direction: None,
        }
    }
}

/// Elements whose inner directions at an edge are closer than this, relatively, lie on each other.
const SAME_DIRECTION: f64 = 1e-6;

/// Edges of the shell elements that are there, by their end nodes.
#[derive(Debug, Default)]
pub(super) struct ShellEdges {
    /// Of each pair of ends: elements, and the numbers of their edges there.
    by_ends: HashMap<[usize; 2], Vec<(usize, usize)>>,
    /// Of each node inside an element: that.
    inside: HashMap<usize, usize>,
}

fn ends(edge: &[usize]) -> [usize; 2] {
    let (a, b) = (edge[0], edge[edge.len() - 1]);
    [a.min(b), a.max(b)]
}

/// The edges of an element, by their nodes.
fn edges_of(shell: &ShellDefinition) -> [Vec<usize>; 4] {
    let nodes = |edge: Vec<usize>| edge.into_iter().map(|local| shell.nodes[local]).collect();
    NodeGrid::new(shell.sides).edges().map(nodes)
}

impl ShellEdges {
    /// Of the elements of a model.
    pub fn of(model: &Model) -> Self {
        let mut edges = ShellEdges::default();
        for (element, shell) in model.shells.iter().enumerate() {
            edges.add(element, shell);
        }
        edges
    }

    /// Adds an element.
    pub fn add(&mut self, element: usize, shell: &ShellDefinition) {
        for (number, edge) in edges_of(shell).iter().enumerate() {
            let there = self.by_ends.entry(ends(edge)).or_default();
            there.push((element, number));
        }
        let [rows, columns] = shell.sides;
        for i in 1..rows - 1 {
            for j in 1..columns - 1 {
                self.inside.insert(shell.nodes[i * columns + j], element);
            }
        }
    }

    /// Checks that a new element shares with each other no more than whole edges or nodes on them,
    /// and does not lie on it.
    fn require_apart(&self, model: &Model, new: &ShellDefinition) -> Result<()> {
        let number = model.shells.len();
        let refuse = |element: usize, how: String| {
            let got = format!("{how}: elements {element} and {number} would overlap");
            let expected = "nodes that share no more than edges with other shell elements";
            Err(Error::value("nodes", expected, got))
        };
        for node in &new.nodes {
            if let Some(&element) = self.inside.get(node) {
                return refuse(
                    element,
                    format!("node {node}, inside shell element {element}"),
                );
            }
        }
        for (side, edge) in edges_of(new).iter().enumerate() {
            let there = self.by_ends.get(&ends(edge));
            for &(element, other_side) in there.into_iter().flatten() {
                let other = &model.shells[element];
                let other_edge = &edges_of(other)[other_side];
                let (from, to) = (edge[0], edge[edge.len() - 1]);
                let mut shared = other_edge.clone();
                if other_edge[0] != from {
                    shared.reverse();
                }
                if shared != *edge {
                    if edge.len() > 2 && shared[1..].iter().all(|n| *n == to || !edge.contains(n)) {
                        // Another line between the same nodes.
                        continue;
                    }
                    let expected = "the same nodes along the whole of an edge that is shared";
                    let got = format!(
                        "others between nodes {from} and {to} than shell element {element} has"
                    );
                    return Err(Error::value("nodes", expected, got));
                }
                let own = inwards(&model.nodes, new, side);
                if (own - inwards(&model.nodes, other, other_side)).norm() < SAME_DIRECTION {
                    let how = format!(
                        "an edge between nodes {from} and {to}, on the same side of which shell \
                         element {element} lies"
                    );
                    return refuse(element, how);
                }
            }
        }
        Ok(())
    }
}

/// Unit vector across an edge, half-way along it, into the element.
fn inwards(nodes: &[Motion], shell: &ShellDefinition, edge: usize) -> Vector3<f64> {
    let (at, across, sign) = match edge {
        0 => ([0.0, -1.0], 2, 1.0),
        1 => ([1.0, 0.0], 1, -1.0),
        2 => ([0.0, 1.0], 2, -1.0),
        _ => ([-1.0, 0.0], 1, 1.0),
    };
    let along = 3 - across;
    let mut tangents = [Vector3::zeros(); 3];
    for (shape, &node) in NodeGrid::new(shell.sides)
        .shapes(at)
        .iter()
        .zip(&shell.nodes)
    {
        let position = nodes[node].position - nodes[shell.nodes[0]].position;
        for direction in [1, 2] {
            tangents[direction] += position * shape[direction];
        }
    }
    let along = tangents[along].normalize();
    let inwards = tangents[across] * sign;
    (inwards - along * along.dot(&inwards)).normalize()
}

impl ShellSection {
    /// Makes the damping `seconds` times the stiffness, which must have been set.
    ///
    /// # Errors
    /// If the time is negative, or there is no stiffness.
    pub fn damp_proportionally(&mut self, seconds: f64) -> Result<()> {
        require_finite("seconds", &[seconds])?;
        if seconds < 0.0 {
            return Err(Error::value("seconds", "zero or more", seconds));
        }
        self.damping = require_positive("shell stiffness", &self.stiffness, true)? * seconds;
        Ok(())
    }

    /// Checks the matrices.
    ///
    /// # Errors
    /// If stiffness is not symmetric and positive definite, or mass and damping not symmetric and
    /// positive semi-definite.
    pub fn validated(&self) -> Result<ShellSection> {
        Ok(ShellSection {
            stiffness: require_positive("shell stiffness", &self.stiffness, true)?,
            damping: require_positive("shell damping", &self.damping, false)?,
            mass: require_positive("shell mass", &self.mass, false)?,
        })
    }
}

impl Model {
    /// Checks the numbers of nodes along the sides of a shell element.
    pub(crate) fn require_shell_sides(sides: [usize; 2]) -> Result<()> {
        for side in sides {
            if !SIDES.contains(&side) {
                let expected = format!("{} to {} nodes a side", SIDES.start(), SIDES.end());
                return Err(Error::size("sides", expected, side));
            }
        }
        Ok(())
    }

    /// Adds one shell element over a grid of existing nodes, `sides` along ξ and η: node
    /// `i n_η + j` of the element at its Gauss–Lobatto points `(ξ_i, η_j)`. How the frames of the
    /// nodes are turned does not matter. The normal is that of the tangents along ξ and η, in this
    /// order. Returns its id.
    ///
    /// Elements may share whole edges, with the same nodes along them, and single nodes.
    ///
    /// # Errors
    /// If nodes do not exist, or do not span a surface with a normal everywhere; if the element
    /// would overlap another; if the section is not valid.
    pub fn add_shell_element(
        &mut self,
        nodes: &[usize],
        sides: [usize; 2],
        section: &ShellSection,
        placement: &ShellPlacement,
    ) -> Result<usize> {
        let edges = ShellEdges::of(self);
        self.add_shell_beside(&edges, (nodes, sides), section, placement)
    }

    /// The same beside elements with these edges.
    pub(super) fn add_shell_beside(
        &mut self,
        edges: &ShellEdges,
        (nodes, sides): (&[usize], [usize; 2]),
        section: &ShellSection,
        placement: &ShellPlacement,
    ) -> Result<usize> {
        Self::require_shell_sides(sides)?;
        if nodes.len() != sides[0] * sides[1] {
            let expected = format!("{} × {} nodes", sides[0], sides[1]);
            return Err(Error::size("nodes", expected, nodes.len()));
        }
        self.require_distinct_nodes(nodes)?;
        let section = section.validated()?;
        require_finite("offset", &[placement.offset])?;
        let direction = placement.direction.map(|d| direction("direction", &d));
        let reference: Vec<Motion> = nodes.iter().map(|&node| self.nodes[node]).collect();
        let grid = NodeGrid::new(sides);
        let frames = element_frames(&grid, &reference, placement.frames, placement.offset)?;
        let definition = ShellDefinition {
            nodes: nodes.to_vec(),
            sides,
            frames,
            section,
            direction: direction.transpose()?,
            factors: [1.0; 3],
            thickness: 1.0,
            prestress: Vector12::zeros(),
        };
        edges.require_apart(self, &definition)?;
        let shell = self.shell_of(&definition)?;
        if shell.has_mass() {
            shell.inertia()?;
            self.inertias.push(InertiaDefinition::Shell);
        }
        self.shells.push(definition);
        Ok(self.shells.len() - 1)
    }

    /// Gives an element resultants where nothing is strained, `[N11 N12 Q1 | M11 M12 M1n | N21 N22
    /// Q2 | M21 M22 M2n]` per unit of reference length along the section's axes: initial stress, by
    /// which it is stiffer or softer, and which moves it unless it is in equilibrium.
    ///
    /// # Errors
    /// If there is no such element, or a number is not finite.
    pub fn set_shell_prestress(&mut self, element: usize, resultants: &Vector12) -> Result<()> {
        require_finite("resultants", resultants.as_slice())?;
        require_id("element", "shell element", self.shells.len(), element)?;
        self.shells[element].prestress = *resultants;
        Ok(())
    }

    /// The element of a shell.
    pub(super) fn shell_of(&self, shell: &ShellDefinition) -> Result<Shell> {
        let reference = shell.nodes.iter().map(|&n| self.nodes[n]).collect();
        let element = Shell::new(
            (shell.nodes.clone(), shell.sides),
            (reference, shell.frames.clone()),
            shell.scaled(),
            shell.direction,
        )?;
        Ok(element.with_prestress(&shell.prestress))
    }

    /// All shell elements.
    ///
    /// # Errors
    /// If one is too distorted.
    pub(crate) fn shell_elements(&self) -> Result<Vec<Arc<Shell>>> {
        let elements = self.shells.iter();
        elements
            .map(|shell| Ok(Arc::new(self.shell_of(shell)?)))
            .collect()
    }

    /// Number of shell elements.
    pub fn shell_element_count(&self) -> usize {
        self.shells.len()
    }

    /// Checks a shell from a file, which may be anything.
    pub(super) fn take_shell(&mut self, shell: ShellDefinition) -> Result<()> {
        Self::require_shell_sides(shell.sides)?;
        self.require_distinct_nodes(&shell.nodes)?;
        let count = shell.sides[0] * shell.sides[1];
        if shell.nodes.len() != count {
            return Err(Error::size("nodes", count, shell.nodes.len()));
        }
        for frame in &shell.frames {
            super::loaded::require_clean_motion("frames", frame)?;
        }
        if let Some(direction) = &shell.direction {
            require_finite("direction", direction.as_slice())?;
        }
        require_finite("factors", &shell.factors)?;
        require_finite("thickness", &[shell.thickness])?;
        require_finite("prestress", shell.prestress.as_slice())?;
        shell.section.validated()?;
        shell.require_finite()?;
        self.shell_of(&shell)?;
        self.shells.push(shell);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::IsotropicShell;
    use crate::test_models::shells::{RUBBER, add_strip, mesh};

    #[test]
    fn only_shells_with_mass_have_inertia() {
        let [thickness, young, density, _] = RUBBER;
        for (density, expected) in [(density, 2), (0.0, 0)] {
            let section = IsotropicShell::new(thickness, young, 0.3, density);
            let mut model = Model::new();
            let section = section.section().unwrap();
            add_strip(&mut model, [2.0, 1.0], &section, &mesh([2, 1], [2, 2]));
            assert_eq!(model.shell_element_count(), 2);
            assert_eq!(model.inertias.len(), expected);
        }
    }
}
