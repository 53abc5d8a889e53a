//! Frames of a shell element in those of its nodes: what it interpolates, however the nodes' own
//! frames are turned.

use super::grid::NodeGrid;
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{Motion, frame_from_axis, skew};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// How the frames are directed that a shell element interpolates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ShellFrames {
    /// The frames of all nodes of an element have their third axes along the surface's normals: one
    /// frame turned by the smallest rotation to each. Parallel where the element is flat.
    Normals,
    /// The frames of all nodes of an element are parallel. Somewhat better on curved elements of
    /// three and more nodes a side; thin warped elements of two nodes a side lock.
    Parallel,
    /// As [`ShellFrames::Normals`], with the third axes of the nodes' own frames for normals: those
    /// of a surface that is known better than its elements show it. With two nodes a side these
    /// bend much better along cylinders, and somewhat worse in doubly curved shells.
    NodeAxes,
    /// The frames of the nodes themselves, with their third axes for normals: frames that are known
    /// from elsewhere. Those of an element should turn from node to node no more than its surface
    /// does; where it is flat they should be parallel.
    NodeFrames,
}

impl ShellFrames {
    /// Whether third axes of the nodes' frames are the normals.
    fn are_of_nodes(self) -> bool {
        matches!(self, ShellFrames::NodeAxes | ShellFrames::NodeFrames)
    }
}

/// Least cosine between the third axis of a node's frame and the normal there of the element.
const ASIDE: f64 = 0.5;
/// Neighbouring normals further apart than this cosine tells are those of an element that is folded
/// over, or turns by more than its order can follow.
const FOLDED: f64 = 0.0;
/// A normal shorter than this part of the product of its tangents' lengths vanishes.
const VANISHING: f64 = 1e-6;

/// Unit normals of the surface through the nodes, at these.
///
/// # Errors
/// If one vanishes, or two neighbours are opposite.
pub fn normals(grid: &NodeGrid, positions: &[Vector3<f64>]) -> Result<Vec<Vector3<f64>>> {
    let [rows, columns] = grid.sides;
    let mut normals = Vec::with_capacity(rows * columns);
    for (node, at) in grid.places().enumerate() {
        let mut tangents = [Vector3::zeros(); 2];
        for (shape, position) in grid.shapes(at).iter().zip(positions) {
            // Relative, so that where the element is does not matter.
            let position = position - positions[0];
            tangents[0] += position * shape[1];
            tangents[1] += position * shape[2];
        }
        let normal = tangents[0].cross(&tangents[1]);
        let size = tangents[0].norm() * tangents[1].norm();
        // Written so that NaN fails too.
        if !(size > 0.0 && normal.norm() > VANISHING * size) {
            let got = format!("one that vanishes at node {node} of the element");
            let expected = "nodes in rows that span a surface, with a normal at each";
            return Err(Error::value("nodes", expected, got));
        }
        normals.push(normal.normalize());
    }
    for i in 0..rows {
        for j in 0..columns {
            let here = i * columns + j;
            let neighbours = [(i + 1 < rows, here + columns), (j + 1 < columns, here + 1)];
            for (_, there) in neighbours.into_iter().filter(|(exists, _)| *exists) {
                if normals[here].dot(&normals[there]) <= FOLDED {
                    let got = format!(
                        "normals at nodes {here} and {there} of the element that are at a right \
                         angle or more: it is inverted, folded, or turns too much"
                    );
                    let expected = "nodes in rows that span a smooth surface";
                    return Err(Error::value("nodes", expected, got));
                }
            }
        }
    }
    Ok(normals)
}

/// The smallest rotation that takes the direction `from` to `to`.
fn smallest_rotation(from: &Vector3<f64>, to: &Vector3<f64>) -> Option<Matrix3<f64>> {
    let cosine = from.dot(to);
    let v = skew(&from.cross(to));
    (cosine > -0.999).then(|| Matrix3::identity() + v + v * v / (1.0 + cosine))
}

/// Frames of the element in those of its nodes, which are at `reference`, and whose surface is at
/// `offset` from them along its normal.
///
/// # Errors
/// If normals cannot be found, or turn by half a turn from their mean.
pub fn element_frames(
    grid: &NodeGrid,
    reference: &[Motion],
    kind: ShellFrames,
    offset: f64,
) -> Result<Vec<Motion>> {
    let positions: Vec<_> = reference.iter().map(|m| m.position).collect();
    let mut normals = normals(grid, &positions)?;
    if kind.are_of_nodes() {
        for (number, (normal, node)) in normals.iter_mut().zip(reference).enumerate() {
            let axis: Vector3<f64> = node.rotation.column(2).into();
            let cosine = axis.dot(normal);
            if cosine < ASIDE {
                let expected = "nodes whose third axes are near the surface's normals";
                let got = format!("a cosine of {cosine:.2} at node {number} of the element");
                return Err(Error::value("nodes", expected, got));
            }
            *normal = axis;
        }
    }
    let mean: Vector3<f64> = normals.iter().sum();
    let parallel = if mean.norm() > VANISHING {
        frame_from_axis(&mean)
    } else {
        // Normals all around: any frame will do.
        frame_from_axis(&normals[0])
    };
    let third: Vector3<f64> = parallel.column(2).into();
    let nodes = reference.iter().zip(&normals);
    nodes
        .map(|(node, normal)| {
            let frame = match kind {
                ShellFrames::Normals | ShellFrames::NodeAxes => {
                    let turn = smallest_rotation(&third, normal).ok_or_else(|| {
                        let message = "nodes: a shell element turns by more than its order can \
                                       follow: use smaller elements";
                        Error::new(ErrorKind::Model, message)
                    })?;
                    turn * parallel
                }
                ShellFrames::Parallel => parallel,
                ShellFrames::NodeFrames => node.rotation,
            };
            let rotation = node.rotation.tr_mul(&frame);
            let position = node.rotation.tr_mul(&(normal * offset));
            Ok(Motion::new(rotation, position))
        })
        .collect()
}
