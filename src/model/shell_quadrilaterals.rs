//! Shells over meshes of quadrilaterals, as other programs make them.

use super::shell::ShellEdges;
use super::shell_mesh::{axes_of_nodes, require_memory, require_points};
use super::{Model, ShellPlacement};
use crate::elements::{NodeGrid, ShellSection, lobatto_points, shape_functions};
use crate::error::{Error, ErrorKind, Result};
use crate::motion::Motion;
use nalgebra::Vector3;
use std::collections::HashMap;

/// A mesh of quadrilaterals: corners, or corners, midsides and centre.
#[derive(Debug, Clone, Copy)]
pub struct QuadrilateralMesh<'a> {
    /// Positions of its points, in the inertial frame.
    pub points: &'a [Vector3<f64>],
    /// Numbers of the points of each cell, one cell after the other: four corners in a row around
    /// it, seen from the side that the normal points to; with nine, then the middles of the sides
    /// from the first corner to the second and so on, then the centre.
    pub cells: &'a [usize],
    /// Points of a cell: 4 or 9.
    pub points_of_cell: usize,
    /// Polynomial degree of the elements, in both directions.
    pub degree: usize,
}

/// Of each number of points of a cell: those along a side, and which is where in rows.
fn rows_of(points_of_cell: usize) -> Result<(usize, &'static [usize])> {
    match points_of_cell {
        4 => Ok((2, &[0, 3, 1, 2])),
        9 => Ok((3, &[0, 7, 3, 4, 8, 6, 1, 5, 2])),
        other => Err(Error::size("points_of_cell", "4 or 9", other)),
    }
}

/// What identifies a place of the mesh: points that several cells may have, and which it is of the
/// nodes along a side.
#[derive(PartialEq, Eq, Hash)]
enum Place {
    Corner(usize),
    /// Ends, the smaller first, the point between them, and how many nodes on from the first.
    Side([usize; 2], Option<usize>, usize),
    Inside(usize, usize),
}

impl QuadrilateralMesh<'_> {
    /// Number of cells.
    ///
    /// # Errors
    /// If numbers are out of their ranges.
    pub(crate) fn count(&self) -> Result<usize> {
        rows_of(self.points_of_cell)?;
        if !(1..=15).contains(&self.degree) {
            return Err(Error::size("degree", "1 to 15", self.degree));
        }
        if self.cells.is_empty() || !self.cells.len().is_multiple_of(self.points_of_cell) {
            let expected = format!("one or more times {}", self.points_of_cell);
            return Err(Error::size("cells", expected, self.cells.len()));
        }
        Ok(self.cells.len() / self.points_of_cell)
    }

    fn validate(&self) -> Result<()> {
        let count = self.count()?;
        require_points(self.points)?;
        for (k, &point) in self.cells.iter().enumerate() {
            if point >= self.points.len() {
                let below = self.points.len();
                let message =
                    format!("cells[{k}]: expected a number of a point below {below}, got {point}");
                return Err(Error::new(ErrorKind::Identifier, message));
            }
        }
        require_memory(count, [self.degree; 2])
    }

    /// The place of node `(i, j)` of a cell.
    fn place(&self, number: usize, cell: &[usize], [i, j]: [usize; 2]) -> Place {
        let p = self.degree;
        let side = |a: usize, b: usize, middle: usize, along: usize| {
            let (from, to) = (cell[a], cell[b]);
            let between = cell.get(middle).copied();
            match from < to {
                true => Place::Side([from, to], between, along),
                false => Place::Side([to, from], between, p - along),
            }
        };
        match (i, j) {
            (0, 0) => Place::Corner(cell[0]),
            (i, 0) if i == p => Place::Corner(cell[1]),
            (i, j) if i == p && j == p => Place::Corner(cell[2]),
            (0, j) if j == p => Place::Corner(cell[3]),
            (i, 0) => side(0, 1, 4, i),
            (i, j) if i == p => side(1, 2, 5, j),
            (i, j) if j == p => side(3, 2, 6, i),
            (0, j) => side(0, 3, 7, j),
            _ => Place::Inside(number, i * (p + 1) + j),
        }
    }

    /// Positions of the nodes of a cell.
    fn positions(&self, cell: &[usize]) -> Result<Vec<Vector3<f64>>> {
        let (side, rows) = rows_of(self.points_of_cell)?;
        let own = lobatto_points(side);
        let shapes: Vec<_> = lobatto_points(self.degree + 1)
            .into_iter()
            .map(|x| shape_functions(&own, x))
            .collect();
        let position = |along: &[(f64, f64)], across: &[(f64, f64)]| {
            let mut position = Vector3::zeros();
            for (k, &point) in rows.iter().enumerate() {
                let shape = along[k / side].0 * across[k % side].0;
                position += self.points[cell[point]] * shape;
            }
            position
        };
        let pairs = shapes
            .iter()
            .flat_map(|a| shapes.iter().map(move |b| (a, b)));
        Ok(pairs.map(|(a, b)| position(a, b)).collect())
    }
}

impl Model {
    /// Makes a shell element of each cell of a mesh of quadrilaterals: flat or warped with four
    /// points, curved with nine. Cells that share a side have the same nodes there. ξ is from the
    /// first corner of a cell to the second, η from there to the third. Points that belong to no
    /// cell are left out. Returns the first of the elements, which follow in the order of the
    /// cells.
    ///
    /// # Errors
    /// If the mesh or the section is not valid, or cells overlap; the model is then as it was.
    pub fn add_shell_quadrilaterals(
        &mut self,
        mesh: &QuadrilateralMesh<'_>,
        section: &ShellSection,
        placement: &ShellPlacement,
    ) -> Result<usize> {
        mesh.validate()?;
        section.validated()?;
        let before = self.shell_sizes();
        let added = self.mesh_quadrilaterals(mesh, section, placement);
        if added.is_err() {
            self.take_back_shells(before);
        }
        added
    }

    fn mesh_quadrilaterals(
        &mut self,
        mesh: &QuadrilateralMesh<'_>,
        section: &ShellSection,
        placement: &ShellPlacement,
    ) -> Result<usize> {
        let first = self.shells.len();
        let side = mesh.degree + 1;
        let grid = NodeGrid::new([side, side]);
        let mut numbers: HashMap<Place, usize> = HashMap::new();
        let mut edges = ShellEdges::of(self);
        let cells = mesh.cells.chunks_exact(mesh.points_of_cell);
        for (number, cell) in cells.enumerate() {
            let positions = mesh.positions(cell)?;
            let axes = axes_of_nodes(&grid, &positions);
            let mut nodes = Vec::with_capacity(side * side);
            for (k, (position, axes)) in positions.iter().zip(axes).enumerate() {
                let place = mesh.place(number, cell, [k / side, k % side]);
                let node = match numbers.get(&place) {
                    Some(&node) => node,
                    None => self.add_node(&Motion::new(axes, *position))?,
                };
                numbers.insert(place, node);
                nodes.push(node);
            }
            let sides = [side, side];
            self.add_shell_beside(&edges, (&nodes, sides), section, placement)
                .map_err(|error| error.within(format!("cell {number}")))?;
            edges.add(self.shells.len() - 1, &self.shells[self.shells.len() - 1]);
        }
        Ok(first)
    }
}
