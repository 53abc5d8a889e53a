//! First variations over a motion, and gradients by all unknowns.

use crate::collocation::{Collocation, RuleWorkspace};
use crate::system::{Placed, System, Workspace};
use nalgebra::Vector6;

/// What a number that depends on a motion at all its times varies by.
#[derive(Debug)]
pub struct Variation {
    points: usize,
    /// Of each node that matters, the factors of the increments of its motion, its velocity and its
    /// acceleration at each time.
    nodes: Vec<Option<Vec<[Vector6<f64>; 3]>>>,
    /// Factors of the increments of own unknowns, as these are ordered over the grid.
    own: Vec<f64>,
    /// For the tangents of elements.
    pub(super) workspace: Workspace,
}

impl Variation {
    /// Nothing yet.
    pub fn new(system: &System, points: usize) -> Self {
        Variation {
            points,
            nodes: vec![None; system.nodes()],
            own: vec![0.0; system.own_unknowns() * points],
            workspace: system.workspace(true),
        }
    }

    /// Adds factors of the increments of motion, velocity and acceleration of a node at time `k`.
    pub fn add(&mut self, node: usize, k: usize, factors: &[Vector6<f64>; 3]) {
        let points = self.points;
        let rows = self.nodes[node].get_or_insert_with(|| vec![[Vector6::zeros(); 3]; points]);
        rows[k]
            .iter_mut()
            .zip(factors)
            .for_each(|(row, x)| *row += x);
    }

    /// Adds the factor of an own unknown of an element at time `k`.
    pub fn add_own(&mut self, placed: &Placed, index: usize, k: usize, factor: f64) {
        self.own[placed.own_at(self.points, k).start + index] += factor;
    }

    /// Adds, to the row of an equation, what the number varies by with each of the unknowns of the
    /// grid, which are not scaled; the motion is the one that `equations` were evaluated at last.
    pub fn add_to_row(&self, equations: &Collocation, row: &mut [f64]) {
        let layout = equations.layout();
        let mut workspace = RuleWorkspace::default();
        let mut by_motion = vec![0.0; layout.of_node()];
        for (node, factors) in self.nodes.iter().enumerate() {
            let Some(factors) = factors else {
                continue;
            };
            for (sum, [motion, ..]) in by_motion.chunks_exact_mut(6).zip(factors) {
                sum.copy_from_slice(motion.as_slice());
            }
            let rates: Vec<_> = factors.iter().map(|[_, v, a]| [*v, *a]).collect();
            if rates.iter().flatten().any(|x| *x != Vector6::zeros()) {
                let rule = equations.rule();
                rule.vary_transposed(node, &rates, &mut workspace, &mut by_motion);
            }
            for (place, x) in layout.node(node).zip(&by_motion) {
                row[place] += x;
            }
        }
        for (place, x) in layout.own().zip(&self.own) {
            row[place] += x;
        }
    }
}
