//! What a matrix is given as: unknowns in groups, and the dense panels between them.

use crate::collocation::{Panel, Pattern};
use std::ops::Range;

/// Unknowns in groups, and the entries between them.
#[derive(Debug)]
pub(crate) struct Structure {
    /// The unknowns of each group, those of one instant after the other.
    pub groups: Vec<Range<usize>>,
    /// How many of the groups, the first, are nodes.
    pub nodes: usize,
    /// All entries.
    pub panels: Vec<Panel>,
    /// Places of those in the rows of each group.
    pub rows: Vec<Vec<usize>>,
    /// Instants at each of which a group has as many unknowns; one if that is not known.
    pub instants: usize,
    /// Whether the last group is one of borders, which may act on all others.
    pub is_bordered: bool,
}

impl Structure {
    /// Of unknowns in groups, of which the first are nodes, with these entries.
    pub fn new(groups: Vec<Range<usize>>, nodes: usize, panels: Vec<Panel>) -> Self {
        let mut structure = Structure {
            rows: vec![Vec::new(); groups.len()],
            groups,
            nodes,
            panels: Vec::new(),
            instants: 1,
            is_bordered: false,
        };
        structure.add(panels);
        structure
    }

    /// That of the Jacobian.
    pub fn of(pattern: &Pattern) -> Self {
        Structure {
            instants: pattern.points(),
            ..Self::new(pattern.groups(), pattern.node_groups(), pattern.panels())
        }
    }

    /// The same with a group more, which these entries `between` couple with all others.
    pub fn bordered(mut self, last: Range<usize>, between: Vec<Panel>) -> Self {
        self.groups.push(last);
        self.rows.push(Vec::new());
        self.is_bordered = true;
        self.add(between);
        self
    }

    fn add(&mut self, panels: Vec<Panel>) {
        for panel in panels {
            self.rows[panel.row.0].push(self.panels.len());
            self.panels.push(panel);
        }
    }

    /// Unknowns of a group at an instant.
    pub fn components(&self, group: usize) -> usize {
        match self.is_border(group) {
            true => 1,
            false => self.groups[group].len() / self.instants,
        }
    }

    /// Whether a group is that of borders.
    pub fn is_border(&self, group: usize) -> bool {
        self.is_bordered && group + 1 == self.groups.len()
    }
}
