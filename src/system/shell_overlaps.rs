//! Shell elements that lie on others, with other nodes.

use super::extents::{Extent, meeting};
use crate::elements::Shell;
use nalgebra::Vector3;
use std::sync::Arc;

/// Surfaces lie on each other if they are no farther apart than this part of their thickness:
/// layers that touch are a whole one apart.
pub(super) const TOGETHER: f64 = 0.25;
/// What a point may lie outside of a triangle, of its size, as it is rounded.
const ROUNDING: f64 = 1e-9;

/// Between the nodes of an element: its cells, by their corners in turn.
struct Facets {
    cells: Vec<[Vector3<f64>; 4]>,
    extent: Extent,
    thickness: f64,
}

impl Facets {
    fn of(shell: &Shell) -> Self {
        let [rows, columns] = shell.sides();
        let places = shell.places();
        let mut cells = Vec::with_capacity((rows - 1) * (columns - 1));
        for i in 1..rows {
            for j in 1..columns {
                let corner = |i: usize, j: usize| places[i * columns + j];
                cells.push([
                    corner(i - 1, j - 1),
                    corner(i, j - 1),
                    corner(i, j),
                    corner(i - 1, j),
                ]);
            }
        }
        let thickness = shell.thickness();
        Facets {
            cells,
            extent: Extent::around(&places, thickness),
            thickness,
        }
    }

    /// Whether the middle of one of its cells lies on another one.
    fn lies_on(&self, other: &Facets) -> bool {
        let near = TOGETHER * 0.5 * (self.thickness + other.thickness);
        self.cells.iter().any(|corners| {
            let middle = corners.iter().sum::<Vector3<f64>>() / 4.0;
            other.extent.holds(&middle)
                && other.cells.iter().any(|&[a, b, c, d]| {
                    [[a, b, c], [a, c, d]]
                        .iter()
                        .any(|t| is_on(&middle, t, near))
                })
        })
    }
}

/// Whether a point is no farther than so much from a triangle, at right angles to it.
fn is_on(point: &Vector3<f64>, [a, b, c]: &[Vector3<f64>; 3], near: f64) -> bool {
    let across = (b - a).cross(&(c - a));
    let twice = across.norm();
    if twice == 0.0 || (point - a).dot(&across).abs() > near * twice {
        return false;
    }
    let side = |from: &Vector3<f64>, to: &Vector3<f64>| {
        (to - from).cross(&(point - from)).dot(&across) >= -ROUNDING * twice * twice
    };
    side(a, b) && side(b, c) && side(c, a)
}

/// Pairs of elements that lie on each other, ascending.
pub(super) fn overlapping(shells: &[Arc<Shell>]) -> Vec<(usize, usize)> {
    let facets: Vec<Facets> = shells.iter().map(|shell| Facets::of(shell)).collect();
    let extents: Vec<&Extent> = facets.iter().map(|f| &f.extent).collect();
    let lie_on_each_other =
        |&(a, b): &(usize, usize)| facets[a].lies_on(&facets[b]) || facets[b].lies_on(&facets[a]);
    let pairs = meeting(&extents).into_iter().filter(lie_on_each_other);
    let mut pairs: Vec<_> = pairs.map(|(a, b)| (a.min(b), a.max(b))).collect();
    pairs.sort_unstable();
    pairs
}
