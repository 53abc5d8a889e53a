//! Edges of shell elements that meet between their nodes, where nothing joins them.

use super::extents::{Extent, meeting};
use super::shell_overlaps::TOGETHER;
use crate::elements::{Element, NodeGrid, Shell, lobatto_points, shape_functions};
use nalgebra::Vector3;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::Arc;

/// Straight pieces of an edge between neighbouring nodes.
const PIECES: usize = 8;

/// An edge of one element alone.
struct FreeEdge {
    element: usize,
    nodes: Vec<usize>,
    places: Vec<Vector3<f64>>,
    /// Points along it, nodes among them.
    line: Vec<Vector3<f64>>,
    extent: Extent,
    /// How near a point is that lies on it.
    near: f64,
}

impl FreeEdge {
    fn new(element: usize, shell: &Shell, own: &[usize]) -> Self {
        let all = shell.places();
        let places: Vec<Vector3<f64>> = own.iter().map(|&k| all[k]).collect();
        let line = line_through(&places);
        let near = TOGETHER * shell.thickness();
        FreeEdge {
            element,
            nodes: own.iter().map(|&k| shell.nodes()[k]).collect(),
            extent: Extent::around(&line, near),
            places,
            line,
            near,
        }
    }

    /// Whether a node that is not its own lies on it, away from its nodes.
    fn has_between(&self, node: usize, place: &Vector3<f64>) -> bool {
        self.extent.holds(place)
            && !self.nodes.contains(&node)
            && self.places.iter().all(|p| (place - p).norm() > self.near)
            && self.line.windows(2).any(|ends| {
                let along = ends[1] - ends[0];
                let part = (place - ends[0]).dot(&along) / along.norm_squared();
                (place - ends[0] - along * part.clamp(0.0, 1.0)).norm() <= self.near
            })
    }
}

fn line_through(places: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let points = lobatto_points(places.len());
    let mut line = vec![places[0]];
    for ends in points.windows(2) {
        for piece in 1..=PIECES {
            let at = ends[0] + (ends[1] - ends[0]) * piece as f64 / PIECES as f64;
            let shapes = shape_functions(&points, at).into_iter();
            line.push(shapes.zip(places).map(|(shape, p)| p * shape.0).sum());
        }
    }
    line
}

fn free_edges(shells: &[Arc<Shell>]) -> Vec<FreeEdge> {
    let mut shared: HashMap<Vec<usize>, usize> = HashMap::new();
    let mut all = Vec::new();
    for (element, shell) in shells.iter().enumerate() {
        for own in NodeGrid::new(shell.sides()).edges() {
            let mut nodes: Vec<usize> = own.iter().map(|&k| shell.nodes()[k]).collect();
            nodes.sort_unstable();
            *shared.entry(nodes.clone()).or_default() += 1;
            all.push((element, own, nodes));
        }
    }
    all.retain(|(_, _, nodes)| shared[nodes] == 1);
    let edges = all.iter();
    let edges = edges.map(|(element, own, _)| FreeEdge::new(*element, &shells[*element], own));
    edges.collect()
}

/// Pairs of elements, ascending, of which one has a node on an edge of the other between its nodes
/// that nothing but shells holds.
pub(super) fn unmatched(shells: &[Arc<Shell>], held: &HashSet<usize>) -> BTreeSet<(usize, usize)> {
    let edges = free_edges(shells);
    let meets = |one: &FreeEdge, other: &FreeEdge| {
        let mut nodes = other.nodes.iter().zip(&other.places);
        nodes.any(|(node, place)| !held.contains(node) && one.has_between(*node, place))
    };
    let extents: Vec<&Extent> = edges.iter().map(|edge| &edge.extent).collect();
    let of_elements = |(a, b): (usize, usize)| {
        let (one, other) = (&edges[a], &edges[b]);
        let unmatched = one.element != other.element && (meets(one, other) || meets(other, one));
        let pair = (one.element, other.element);
        unmatched.then_some((pair.0.min(pair.1), pair.0.max(pair.1)))
    };
    meeting(&extents)
        .into_iter()
        .filter_map(of_elements)
        .collect()
}
