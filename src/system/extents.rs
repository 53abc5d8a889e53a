//! Boxes along the axes, and which of them meet.

use nalgebra::Vector3;

/// A box.
pub(super) struct Extent {
    lowest: Vector3<f64>,
    highest: Vector3<f64>,
}

impl Extent {
    /// Around points, of which there is one, with so much to spare.
    pub fn around(points: &[Vector3<f64>], margin: f64) -> Self {
        let margin = Vector3::repeat(margin);
        let bound = |pick: fn(f64, f64) -> f64| {
            let first = points[0];
            points.iter().fold(first, |most, p| most.zip_map(p, pick))
        };
        Extent {
            lowest: bound(f64::min) - margin,
            highest: bound(f64::max) + margin,
        }
    }

    /// Whether a point is in it.
    pub fn holds(&self, point: &Vector3<f64>) -> bool {
        let beyond = |i: usize| point[i] < self.lowest[i] || point[i] > self.highest[i];
        !(0..3).any(beyond)
    }

    fn meets(&self, other: &Extent) -> bool {
        (0..3).all(|i| self.lowest[i] <= other.highest[i] && other.lowest[i] <= self.highest[i])
    }
}

/// Pairs of boxes that meet.
pub(super) fn meeting(extents: &[&Extent]) -> Vec<(usize, usize)> {
    // One after the other along the longest axis: only few are met at a time.
    let span = |axis: usize| {
        let low = extents.iter().map(|e| e.lowest[axis]);
        let high = extents.iter().map(|e| e.highest[axis]);
        high.fold(f64::NEG_INFINITY, f64::max) - low.fold(f64::INFINITY, f64::min)
    };
    let axis = (1..3).fold(0, |most, i| if span(i) > span(most) { i } else { most });
    let mut order: Vec<usize> = (0..extents.len()).collect();
    order.sort_by(|&a, &b| extents[a].lowest[axis].total_cmp(&extents[b].lowest[axis]));
    let mut pairs = Vec::new();
    for (at, &a) in order.iter().enumerate() {
        let end = extents[a].highest[axis];
        let next = order[at + 1..].iter();
        let next = next.take_while(|&&b| extents[b].lowest[axis] <= end);
        pairs.extend(next.filter_map(|&b| extents[a].meets(extents[b]).then_some((a, b))));
    }
    pairs
}
