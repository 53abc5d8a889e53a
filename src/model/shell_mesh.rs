//! Meshes of shells over surfaces that are given as functions.

use super::shell::ShellEdges;
use super::{Model, ShellDefinition, ShellPlacement};
use crate::elements::{NodeGrid, ShellSection, lobatto_points};
use crate::error::{Error, Result, require_finite};
use crate::memory;
use crate::motion::Motion;
use nalgebra::{Matrix3, Vector3};
use std::collections::HashMap;

/// How a patch is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShellMesh {
    /// Elements along each of the two directions of the patch.
    pub elements: [usize; 2],
    /// Polynomial degrees of the elements in these directions: nodes along a side, less one.
    pub degrees: [usize; 2],
    /// Whether nodes on the patch's edges at the same place as nodes of shells that are there, or
    /// on another of its own edges, are these: patches are joined, and closed.
    pub join: bool,
}

/// What a meshed patch consists of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShellPatch {
    /// First element; the others follow, those along the second direction first.
    pub first_element: usize,
    /// Elements along each direction.
    pub elements: [usize; 2],
    /// Nodes along each direction.
    pub lines: [usize; 2],
    /// The nodes, those along the second direction first.
    pub nodes: Vec<usize>,
}

/// An edge of a patch, whose coordinates `(u, v)` are from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PatchEdge {
    /// `u = 0`, along `v`.
    StartU,
    /// `u = 1`, along `v`.
    EndU,
    /// `v = 0`, along `u`.
    StartV,
    /// `v = 1`, along `u`.
    EndV,
}

impl ShellPatch {
    /// The node at these places along both directions, if it is one.
    pub fn node(&self, along: [usize; 2]) -> Option<usize> {
        let [rows, columns] = self.lines;
        let inside = along[0] < rows && along[1] < columns;
        inside.then(|| self.nodes[along[0] * columns + along[1]])
    }

    /// The nodes along an edge.
    pub fn edge(&self, edge: PatchEdge) -> Vec<usize> {
        let [rows, columns] = self.lines;
        let (start, step, count) = match edge {
            PatchEdge::StartU => (0, 1, columns),
            PatchEdge::EndU => ((rows - 1) * columns, 1, columns),
            PatchEdge::StartV => (0, columns, rows),
            PatchEdge::EndV => (columns - 1, columns, rows),
        };
        (0..count).map(|k| self.nodes[start + k * step]).collect()
    }

    /// Number of its elements.
    pub fn element_count(&self) -> usize {
        self.elements[0] * self.elements[1]
    }
}

/// Nodes closer than this part of the patch's size are at the same place.
const SAME_PLACE: f64 = 1e-8;

/// Nodes by their places.
struct Places {
    unit: f64,
    by_cell: HashMap<[i64; 3], Vec<usize>>,
}

impl Places {
    fn cell(&self, position: &Vector3<f64>) -> [i64; 3] {
        // Cells much larger than the tolerance, so that few neighbours are looked at.
        position
            .map(|x| (x / (4.0 * self.unit)).floor() as i64)
            .into()
    }

    fn add(&mut self, node: usize, position: &Vector3<f64>) {
        let cell = self.cell(position);
        self.by_cell.entry(cell).or_default().push(node);
    }

    fn find(&self, model: &Model, position: &Vector3<f64>) -> Option<usize> {
        let corners = (0..8).map(|corner| {
            let shift = Vector3::from_fn(|i, _| match corner >> i & 1 {
                0 => -self.unit,
                _ => self.unit,
            });
            self.cell(&(position + shift))
        });
        let nodes = corners.filter_map(|cell| self.by_cell.get(&cell)).flatten();
        let mut near = nodes
            .copied()
            .filter(|&node| (model.nodes[node].position - position).norm() <= self.unit);
        near.next()
    }
}

impl ShellMesh {
    fn validate(&self) -> Result<()> {
        const MOST: usize = 100_000;
        for elements in self.elements {
            if !(1..=MOST).contains(&elements) {
                return Err(Error::size("elements", format!("1 to {MOST}"), elements));
            }
        }
        for degree in self.degrees {
            if !(1..=15).contains(&degree) {
                return Err(Error::size("degrees", "1 to 15", degree));
            }
        }
        Ok(())
    }

    /// Nodes along both directions.
    ///
    /// # Errors
    /// If its numbers are out of their ranges, or there is not the memory for so many.
    pub(crate) fn lines(&self) -> Result<[usize; 2]> {
        self.validate()?;
        require_memory(self.elements[0] * self.elements[1], self.degrees)?;
        Ok([0, 1].map(|direction| self.elements[direction] * self.degrees[direction] + 1))
    }

    /// Places of the nodes along a direction, from 0 to 1.
    fn places(&self, direction: usize) -> Vec<f64> {
        let (elements, degree) = (self.elements[direction], self.degrees[direction]);
        let points = lobatto_points(degree + 1);
        let inside = (0..elements * degree).map(|k| {
            let along = 0.5 * (points[k % degree] + 1.0);
            ((k / degree) as f64 + along) / elements as f64
        });
        inside.chain([1.0]).collect()
    }
}

/// Checks that there is the memory for so many elements of such degrees with nodes of their own.
pub(super) fn require_memory(elements: usize, degrees: [usize; 2]) -> Result<()> {
    let of_element = (degrees[0] + 1) * (degrees[1] + 1);
    // Lists grow to twice their length at times.
    let bytes = size_of::<ShellDefinition>() + 3 * of_element * size_of::<Motion>();
    memory::require_items("nodes and elements of the shell", elements, 2 * bytes)
}

/// Checks positions that are given one by one.
pub(super) fn require_points(points: &[Vector3<f64>]) -> Result<()> {
    for (k, point) in points.iter().enumerate() {
        require_finite(&format!("points[{k}]"), point.as_slice())?;
    }
    Ok(())
}

/// Axes at each node of an element: along ξ, across it in the surface, and the normal; the
/// identity where there is no surface, which the element will refuse.
pub(super) fn axes_of_nodes(grid: &NodeGrid, positions: &[Vector3<f64>]) -> Vec<Matrix3<f64>> {
    let axes = |at: [f64; 2]| {
        let mut tangents = [Vector3::zeros(); 2];
        for (shape, position) in grid.shapes(at).iter().zip(positions) {
            tangents[0] += (position - positions[0]) * shape[1];
            tangents[1] += (position - positions[0]) * shape[2];
        }
        let normal = tangents[0].cross(&tangents[1]);
        match (tangents[0].try_normalize(0.0), normal.try_normalize(0.0)) {
            (Some(along), Some(normal)) => {
                Matrix3::from_columns(&[along, normal.cross(&along), normal])
            }
            _ => Matrix3::identity(),
        }
    };
    grid.places().map(axes).collect()
}

impl Model {
    /// Meshes a surface with shell elements. `surface` gives its points for `(u, v)`, each from 0
    /// to 1, such as [`rectangle`](super::rectangle), [`annulus_sector`](super::annulus_sector) and
    /// [`cylinder`](super::cylinder) make; the normal is that of the tangents along `u` and `v`, in
    /// this order. Axis 1 of each new node's frame is along `u`, axis 3 along the normal.
    ///
    /// # Errors
    /// If the surface, the numbers of the mesh or the section are not valid, or elements would
    /// overlap others; the model is then as it was.
    pub fn add_shell_patch(
        &mut self,
        surface: impl Fn([f64; 2]) -> Result<Vector3<f64>>,
        mesh: &ShellMesh,
        section: &ShellSection,
        placement: &ShellPlacement,
    ) -> Result<ShellPatch> {
        let lines = mesh.lines()?;
        let [u, v] = [0, 1].map(|direction| mesh.places(direction));
        let mut positions = Vec::with_capacity(lines[0] * lines[1]);
        for &u in &u {
            for &v in &v {
                let position = surface([u, v])?;
                let name = format!("surface at ({u}, {v})");
                require_finite(&name, position.as_slice())?;
                positions.push(position);
            }
        }
        self.add_shell_grid(&positions, mesh, section, placement)
    }

    /// The same over given positions of its nodes: those of each element at the Gauss–Lobatto
    /// points in both directions, those along the second direction first.
    ///
    /// # Errors
    /// As of [`Model::add_shell_patch`], and if there are not as many positions as nodes.
    pub fn add_shell_grid(
        &mut self,
        positions: &[Vector3<f64>],
        mesh: &ShellMesh,
        section: &ShellSection,
        placement: &ShellPlacement,
    ) -> Result<ShellPatch> {
        let lines = mesh.lines()?;
        if positions.len() != lines[0] * lines[1] {
            let expected = format!("{} × {} nodes", lines[0], lines[1]);
            return Err(Error::size("points", expected, positions.len()));
        }
        require_points(positions)?;
        section.validated()?;
        let before = self.shell_sizes();
        let patch = self.mesh_patch(positions, (mesh, lines), section, placement);
        if patch.is_err() {
            self.take_back_shells(before);
        }
        patch
    }

    /// Numbers of nodes, shell elements and inertias.
    pub(super) fn shell_sizes(&self) -> [usize; 3] {
        [self.nodes.len(), self.shells.len(), self.inertias.len()]
    }

    /// Takes back what shells have added since these numbers were told.
    pub(super) fn take_back_shells(&mut self, [nodes, shells, inertias]: [usize; 3]) {
        self.nodes.truncate(nodes);
        self.shells.truncate(shells);
        self.inertias.truncate(inertias);
    }

    fn mesh_patch(
        &mut self,
        positions: &[Vector3<f64>],
        (mesh, lines): (&ShellMesh, [usize; 2]),
        section: &ShellSection,
        placement: &ShellPlacement,
    ) -> Result<ShellPatch> {
        let first_element = self.shells.len();
        let [du, dv] = mesh.degrees;
        let grid = NodeGrid::new([du + 1, dv + 1]);
        let mut places = self.places_to_join(positions, mesh.join);
        let mut numbers = vec![None; positions.len()];
        let mut edges = ShellEdges::of(self);
        for element in 0..mesh.elements[0] * mesh.elements[1] {
            let (i, j) = (element / mesh.elements[1], element % mesh.elements[1]);
            let own: Vec<usize> = (0..=du)
                .flat_map(|a| (0..=dv).map(move |b| (a, b)))
                .map(|(a, b)| (i * du + a) * lines[1] + j * dv + b)
                .collect();
            let own_positions: Vec<_> = own.iter().map(|&at| positions[at]).collect();
            let axes = axes_of_nodes(&grid, &own_positions);
            let mut nodes = Vec::with_capacity(own.len());
            for (&at, axes) in own.iter().zip(axes) {
                let (row, column) = (at / lines[1], at % lines[1]);
                let on_edge = row % (lines[0] - 1) == 0 || column % (lines[1] - 1) == 0;
                let node = match numbers[at] {
                    Some(node) => node,
                    None => self.node_at((&positions[at], axes), on_edge, &mut places)?,
                };
                numbers[at] = Some(node);
                nodes.push(node);
            }
            let sides = grid.sides;
            self.add_shell_beside(&edges, (&nodes, sides), section, placement)
                .map_err(|error| error.within(format!("element at {i}, {j}")))?;
            edges.add(self.shells.len() - 1, &self.shells[self.shells.len() - 1]);
        }
        Ok(ShellPatch {
            first_element,
            elements: mesh.elements,
            lines,
            nodes: numbers.into_iter().flatten().collect(),
        })
    }

    /// Nodes of shells, by their places, if they are to be joined to those at `positions`.
    fn places_to_join(&self, positions: &[Vector3<f64>], join: bool) -> Option<Places> {
        let far = positions.iter().map(|p| (p - positions[0]).norm());
        let unit = SAME_PLACE * far.fold(0.0, f64::max);
        (join && unit > 0.0).then(|| {
            let by_cell = HashMap::new();
            let mut places = Places { unit, by_cell };
            let mut seen = vec![false; self.nodes.len()];
            for &node in self.shells.iter().flat_map(|shell| &shell.nodes) {
                if !std::mem::replace(&mut seen[node], true) {
                    places.add(node, &self.nodes[node].position);
                }
            }
            places
        })
    }

    /// The node at a position: one that is there, if it is on an edge, or a new one.
    fn node_at(
        &mut self,
        (position, axes): (&Vector3<f64>, Matrix3<f64>),
        on_edge: bool,
        places: &mut Option<Places>,
    ) -> Result<usize> {
        let Some(places) = places.as_mut().filter(|_| on_edge) else {
            return self.add_node(&Motion::new(axes, *position));
        };
        if let Some(node) = places.find(self, position) {
            return Ok(node);
        }
        let node = self.add_node(&Motion::new(axes, *position))?;
        places.add(node, position);
        Ok(node)
    }
}
