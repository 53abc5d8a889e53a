//! Shell elements that lie on others, with other nodes.

use crate::elements::Shell;
use nalgebra::Vector3;
use std::sync::Arc;

/// Surfaces lie on each other if they are no farther apart than this part of their thickness:
/// layers that touch are a whole one apart.
const TOGETHER: f64 = 0.25;
/// What a point may lie outside of a triangle, of its size, as it is rounded.
const ROUNDING: f64 = 1e-9;

/// Between the nodes of an element: its cells, by their corners in turn.
struct Facets {
    cells: Vec<[Vector3<f64>; 4]>,
    lowest: Vector3<f64>,
    highest: Vector3<f64>,
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
        let around = Vector3::repeat(thickness);
        let bound = |pick: fn(f64, f64) -> f64| {
            let first = places[0];
            places.iter().fold(first, |most, p| most.zip_map(p, pick))
        };
        Facets {
            cells,
            lowest: bound(f64::min) - around,
            highest: bound(f64::max) + around,
            thickness,
        }
    }

    /// Whether the middle of one of its cells lies on another one.
    fn lies_on(&self, other: &Facets) -> bool {
        let near = TOGETHER * 0.5 * (self.thickness + other.thickness);
        self.cells.iter().any(|corners| {
            let middle = corners.iter().sum::<Vector3<f64>>() / 4.0;
            let beyond = |low: f64, x: f64, high: f64| x < low || x > high;
            let outside = (0..3).any(|i| beyond(other.lowest[i], middle[i], other.highest[i]));
            !outside
                && other.cells.iter().any(|&[a, b, c, d]| {
                    [[a, b, c], [a, c, d]]
                        .iter()
                        .any(|t| is_on(&middle, t, near))
                })
        })
    }

    fn may_meet(&self, other: &Facets) -> bool {
        (0..3).all(|i| self.lowest[i] <= other.highest[i] && other.lowest[i] <= self.highest[i])
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
    // One after the other along the longest axis: only few are met at a time.
    let span = |axis: usize| {
        let low = facets.iter().map(|f| f.lowest[axis]);
        let high = facets.iter().map(|f| f.highest[axis]);
        high.fold(f64::NEG_INFINITY, f64::max) - low.fold(f64::INFINITY, f64::min)
    };
    let axis = (1..3).fold(0, |most, i| if span(i) > span(most) { i } else { most });
    let mut order: Vec<usize> = (0..facets.len()).collect();
    order.sort_by(|&a, &b| facets[a].lowest[axis].total_cmp(&facets[b].lowest[axis]));
    let mut pairs = Vec::new();
    for (at, &a) in order.iter().enumerate() {
        let end = facets[a].highest[axis];
        let next = order[at + 1..].iter();
        for &b in next.take_while(|&&b| facets[b].lowest[axis] <= end) {
            let (one, other) = (&facets[a], &facets[b]);
            if one.may_meet(other) && (one.lies_on(other) || other.lies_on(one)) {
                pairs.push((a.min(b), a.max(b)));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}
