//! Edges of shell elements that meet between their nodes, where nothing joins them.

use crate::elements::{Element, NodeGrid, Shell, lobatto_points, shape_functions};
use nalgebra::Vector3;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::sync::Arc;

/// Edges meet if they are no farther apart than this part of the thickness, as surfaces do that
/// lie on each other.
const TOGETHER: f64 = 0.25;
/// Straight pieces of an edge between neighbouring nodes.
const PIECES: usize = 8;

/// An edge of one element alone.
struct FreeEdge {
    element: usize,
    nodes: Vec<usize>,
    places: Vec<Vector3<f64>>,
    /// Points along it, nodes among them.
    line: Vec<Vector3<f64>>,
    lowest: Vector3<f64>,
    highest: Vector3<f64>,
    near: f64,
}

impl FreeEdge {
    fn new(element: usize, shell: &Shell, own: &[usize]) -> Self {
        let all = shell.places();
        let places: Vec<Vector3<f64>> = own.iter().map(|&k| all[k]).collect();
        let line = line_through(&places);
        let near = TOGETHER * shell.thickness();
        let bound =
            |pick: fn(f64, f64) -> f64| line.iter().fold(line[0], |most, p| most.zip_map(p, pick));
        FreeEdge {
            element,
            nodes: own.iter().map(|&k| shell.nodes()[k]).collect(),
            lowest: bound(f64::min) - Vector3::repeat(near),
            highest: bound(f64::max) + Vector3::repeat(near),
            places,
            line,
            near,
        }
    }

    /// Whether a node that is not its own lies on it, away from its nodes.
    fn has_between(&self, node: usize, place: &Vector3<f64>) -> bool {
        let outside = (0..3).any(|i| place[i] < self.lowest[i] || place[i] > self.highest[i]);
        !outside
            && !self.nodes.contains(&node)
            && self.places.iter().all(|p| (place - p).norm() > self.near)
            && self.line.windows(2).any(|ends| {
                let along = ends[1] - ends[0];
                let part = (place - ends[0]).dot(&along) / along.norm_squared();
                (place - ends[0] - along * part.clamp(0.0, 1.0)).norm() <= self.near
            })
    }

    fn may_meet(&self, other: &FreeEdge) -> bool {
        (0..3).all(|i| self.lowest[i] <= other.highest[i] && other.lowest[i] <= self.highest[i])
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
    let mut order: Vec<usize> = (0..edges.len()).collect();
    order.sort_by(|&a, &b| edges[a].lowest.x.total_cmp(&edges[b].lowest.x));
    let mut pairs = BTreeSet::new();
    let meets = |one: &FreeEdge, other: &FreeEdge| {
        let mut nodes = other.nodes.iter().zip(&other.places);
        nodes.any(|(node, place)| !held.contains(node) && one.has_between(*node, place))
    };
    for (at, &a) in order.iter().enumerate() {
        let (one, next) = (&edges[a], order[at + 1..].iter().map(|&b| &edges[b]));
        for other in next.take_while(|other| other.lowest.x <= one.highest.x) {
            let apart = one.element != other.element && one.may_meet(other);
            if apart && (meets(one, other) || meets(other, one)) {
                pairs.insert((
                    one.element.min(other.element),
                    one.element.max(other.element),
                ));
            }
        }
    }
    pairs
}
