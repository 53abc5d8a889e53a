//! Nodes of a shell element: a grid of Gauss–Lobatto points, row by row.

use crate::elements::line_station::LineStation;
use crate::elements::shape::{gauss_legendre, lobatto_points, shape_functions};

/// A grid of nodes in `ξ` and `η`: node `i n_η + j` is at `(ξ_i, η_j)`.
#[derive(Debug, Clone)]
pub struct NodeGrid {
    /// Nodes along ξ and along η.
    pub sides: [usize; 2],
    points: [Vec<f64>; 2],
}

impl NodeGrid {
    /// Of so many nodes a side, two or more.
    pub fn new(sides: [usize; 2]) -> Self {
        NodeGrid {
            sides,
            points: sides.map(lobatto_points),
        }
    }

    /// Number of nodes.
    pub fn count(&self) -> usize {
        self.sides[0] * self.sides[1]
    }

    /// Places of the nodes.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let [xi, eta] = &self.points;
        xi.iter()
            .flat_map(move |&x| eta.iter().map(move |&y| [x, y]))
    }

    /// Shape functions at a place, each with its derivatives in ξ and η.
    pub fn shapes(&self, at: [f64; 2]) -> Vec<[f64; 3]> {
        let along = shape_functions(&self.points[0], at[0]);
        let across = shape_functions(&self.points[1], at[1]);
        let pairs = along
            .iter()
            .flat_map(|a| across.iter().map(move |b| (a, b)));
        pairs
            .map(|(a, b)| [a.0 * b.0, a.1 * b.0, a.0 * b.1])
            .collect()
    }

    /// A station at a place, for velocities in ξ (0) or η (1).
    pub(in crate::elements) fn station(&self, at: [f64; 2], direction: usize) -> LineStation {
        let shapes = self.shapes(at);
        LineStation {
            shapes: shapes.iter().map(|s| (s[0], s[1 + direction])).collect(),
        }
    }

    /// Nodes of the four edges, each in the direction of ξ or η: `η = −1`, `ξ = 1`, `η = 1`,
    /// `ξ = −1`.
    pub fn edges(&self) -> [Vec<usize>; 4] {
        let [rows, columns] = self.sides;
        [
            (0..rows).map(|i| i * columns).collect(),
            (0..columns).map(|j| (rows - 1) * columns + j).collect(),
            (0..rows).map(|i| i * columns + columns - 1).collect(),
            (0..columns).collect(),
        ]
    }
}

/// Where strains are sampled and where they are needed: an edge-element field.
///
/// Velocities in ξ are sampled at `(n_ξ − 1) × n_η` Gauss points, those in η at `n_ξ × (n_η − 1)`;
/// all are interpolated to `n_ξ × n_η` Gauss points. In the other direction points are the same.
#[derive(Debug, Clone)]
pub(super) struct Sampling {
    sides: [usize; 2],
    /// Of each direction: values at each point along it of the Lagrange polynomials through the
    /// samples along it, point by point.
    weights: [Vec<f64>; 2],
}

impl Sampling {
    pub fn new(sides: [usize; 2]) -> Self {
        let weights = sides.map(|side| {
            let samples: Vec<f64> = gauss_legendre(side - 1).iter().map(|p| p.0).collect();
            let points = gauss_legendre(side);
            let values = points.iter().flat_map(|p| shape_functions(&samples, p.0));
            values.map(|value| value.0).collect()
        });
        Sampling { sides, weights }
    }

    /// Places and directions of all samples.
    pub fn places(&self) -> Vec<([f64; 2], usize)> {
        let places = |direction: usize| {
            let rule = |d: usize| gauss_legendre(self.sides[d] - usize::from(d == direction));
            let (along, across) = (rule(0), rule(1));
            let mut places = Vec::new();
            for (x, _) in &along {
                places.extend(across.iter().map(|(y, _)| ([*x, *y], direction)));
            }
            places
        };
        [places(0), places(1)].concat()
    }

    /// Samples of a direction that matter at a point, by their numbers, with their weights.
    #[inline]
    pub fn of_point(
        &self,
        direction: usize,
        point: usize,
    ) -> impl Iterator<Item = (usize, f64)> + '_ {
        let [rows, columns] = self.sides;
        let (i, j) = (point / columns, point % columns);
        let (first, step, along, count) = match direction {
            0 => (j, columns, i, rows - 1),
            _ => ((rows - 1) * columns + i * (columns - 1), 1, j, columns - 1),
        };
        let weights = &self.weights[direction][along * count..][..count];
        weights
            .iter()
            .enumerate()
            .map(move |(k, &weight)| (first + k * step, weight))
    }

    /// Samples of a direction, by their numbers, with their weights at any place.
    pub fn of_place(&self, direction: usize, at: [f64; 2]) -> Vec<(usize, f64)> {
        let [along, across] = [0, 1].map(|d| {
            let rule = gauss_legendre(self.sides[d] - usize::from(d == direction));
            let points: Vec<f64> = rule.iter().map(|p| p.0).collect();
            shape_functions(&points, at[d])
        });
        let first = direction * (self.sides[0] - 1) * self.sides[1];
        let pairs = along
            .iter()
            .flat_map(|a| across.iter().map(move |b| a.0 * b.0));
        pairs
            .enumerate()
            .map(|(k, weight)| (first + k, weight))
            .collect()
    }
}
