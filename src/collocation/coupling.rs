//! Which nodes are coupled by an element.

use crate::system::System;
use std::collections::BTreeMap;
use std::ops::Range;

/// Rows of one node that depend on another one's motion.
#[derive(Debug, Clone)]
pub struct Coupling {
    /// Node of the rows.
    pub row: usize,
    /// Node whose motion they depend on.
    pub column: usize,
    /// Whether on its velocity and acceleration too.
    pub moving: bool,
}

/// All of them, in the order of columns and then of rows. Each node is coupled with itself, and if
/// one is with another one, that is with it.
#[derive(Debug, Clone)]
pub(super) struct Couplings {
    all: Vec<Coupling>,
    /// First of each column, and how many there are.
    columns: Vec<usize>,
    /// Of each: that with row and column exchanged.
    transposed: Vec<usize>,
}

impl Couplings {
    /// Those of a system.
    pub fn new(system: &System) -> Self {
        let nodes = system.nodes();
        let mut found: BTreeMap<(usize, usize), bool> =
            (0..nodes).map(|node| ((node, node), false)).collect();
        for placed in system.elements() {
            let element = &placed.element;
            let moving = element.has_mass() || element.has_damping();
            for &row in element.nodes() {
                for &column in element.nodes() {
                    if row == column || element.couples_nodes() {
                        *found.entry((column, row)).or_insert(false) |= moving;
                    }
                }
            }
        }
        let all: Vec<Coupling> = found
            .into_iter()
            .map(|((column, row), moving)| Coupling {
                row,
                column,
                moving,
            })
            .collect();
        let first = |node: usize| all.partition_point(|c| c.column < node);
        let mut couplings = Couplings {
            columns: (0..=nodes).map(first).collect(),
            transposed: Vec::new(),
            all,
        };
        let all = couplings.all.iter();
        couplings.transposed = all.map(|c| couplings.number(c.column, c.row)).collect();
        couplings
    }

    /// All of them.
    pub fn all(&self) -> &[Coupling] {
        &self.all
    }

    /// Numbers of those in the columns of some nodes.
    pub fn of_columns(&self, nodes: Range<usize>) -> Range<usize> {
        self.columns[nodes.start]..self.columns[nodes.end]
    }

    /// Numbers of those in the columns of a node.
    pub fn of_column(&self, node: usize) -> Range<usize> {
        self.of_columns(node..node + 1)
    }

    /// Numbers of those in the rows of a node, in the order of columns.
    pub fn of_row(&self, node: usize) -> &[usize] {
        &self.transposed[self.of_column(node)]
    }

    /// Number of that of two nodes, which must be coupled.
    pub fn number(&self, row: usize, column: usize) -> usize {
        let range = self.of_column(column);
        range.start + self.all[range].partition_point(|c| c.row < row)
    }
}
