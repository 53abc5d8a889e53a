//! Where the unknowns over a grid stand in their vectors.

use super::{Placed, System};
use std::ops::Range;

/// Components of a motion.
const MOTION: usize = 6;

/// Places of all unknowns over a grid, and of the equations: `motions | own | scalars`.
///
/// For each node the six components of its motion at one grid point after the other; then, for each
/// element, its own unknowns, multipliers or internal states, at one grid point after the other;
/// then unknowns that are not of a grid point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    nodes: usize,
    points: usize,
    /// Own unknowns of all elements at a grid point.
    own: usize,
    scalars: usize,
}

impl System {
    /// Places of the unknowns at so many grid points.
    pub fn layout(&self, points: usize) -> Layout {
        Layout {
            nodes: self.nodes(),
            points,
            own: self.own_unknowns(),
            scalars: 0,
        }
    }
}

impl Placed {
    /// Its own unknowns at grid point `k` among those of all elements at all `points`.
    #[inline]
    pub fn own_at(&self, points: usize, k: usize) -> Range<usize> {
        let count = self.element.own_unknowns();
        let first = self.first_own * points + count * k;
        first..first + count
    }

    /// The same at all grid points.
    #[inline]
    pub fn own_over(&self, points: usize) -> Range<usize> {
        let first = self.first_own * points;
        first..first + self.element.own_unknowns() * points
    }
}

impl Layout {
    /// The same with so many scalars.
    pub fn with_scalars(self, scalars: usize) -> Self {
        Layout { scalars, ..self }
    }

    /// Number of all unknowns.
    pub fn size(&self) -> usize {
        self.scalars().end
    }

    /// Number of grid points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Numbers of a node's motions at all grid points.
    #[inline]
    pub fn of_node(&self) -> usize {
        MOTION * self.points
    }

    /// Motions of all nodes.
    #[inline]
    pub fn motions(&self) -> Range<usize> {
        0..self.of_node() * self.nodes
    }

    /// Motions of a node at all grid points.
    #[inline]
    pub fn node(&self, node: usize) -> Range<usize> {
        self.of_node() * node..self.of_node() * (node + 1)
    }

    /// Motion of a node at grid point `k`.
    #[inline]
    pub fn motion(&self, node: usize, k: usize) -> Range<usize> {
        let first = MOTION * (node * self.points + k);
        first..first + MOTION
    }

    /// Own unknowns of all elements.
    #[inline]
    pub fn own(&self) -> Range<usize> {
        let first = self.motions().end;
        first..first + self.own * self.points
    }

    /// Own unknowns of an element at all grid points.
    #[inline]
    pub fn element(&self, placed: &Placed) -> Range<usize> {
        self.behind_motions(placed.own_over(self.points))
    }

    /// Own unknowns of an element at grid point `k`.
    #[inline]
    pub fn element_at(&self, placed: &Placed, k: usize) -> Range<usize> {
        self.behind_motions(placed.own_at(self.points, k))
    }

    /// Unknowns that are not of a grid point.
    pub fn scalars(&self) -> Range<usize> {
        let first = self.own().end;
        first..first + self.scalars
    }

    #[inline]
    fn behind_motions(&self, own: Range<usize>) -> Range<usize> {
        let first = self.motions().end;
        first + own.start..first + own.end
    }
}

#[cfg(test)]
mod tests {
    use crate::system::System;
    use crate::test_models::small::crank_rocker;

    #[test]
    fn all_unknowns_have_one_place_each_and_in_order() {
        let (model, period) = crank_rocker(1, 2, 3.0);
        let system = System::new(&model, period).unwrap();
        let points = 5;
        let layout = system.layout(points).with_scalars(2);
        let mut next = 0;
        let mut follow = |range: std::ops::Range<usize>| {
            assert_eq!(range.start, next);
            next = range.end;
        };
        for node in 0..system.nodes() {
            assert_eq!(layout.node(node).start, layout.motion(node, 0).start);
            (0..points).for_each(|k| follow(layout.motion(node, k)));
            assert_eq!(layout.node(node).end, layout.motion(node, points - 1).end);
        }
        for placed in system.elements() {
            assert_eq!(layout.element(placed).len(), placed.own_over(points).len());
            (0..points).for_each(|k| follow(layout.element_at(placed, k)));
        }
        follow(layout.scalars());
        assert_eq!(layout.size(), next);
        assert_eq!(layout.own().end - layout.motions().end, layout.own().len());
    }
}
