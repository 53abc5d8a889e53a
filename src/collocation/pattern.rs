//! Sparsity of the Jacobian: dense in time within and between nodes coupled by inertia or damping,
//! within internal states, and where these depend on velocities; diagonal in time everywhere else.

use super::coupling::Couplings;
use crate::elements::Element;
use crate::system::System;
use std::ops::Range;
use std::sync::OnceLock;

/// A dense part of one block of the matrix.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Group of the rows, and the first one within it.
    pub row: (usize, usize),
    /// Group of the columns, and the first one within it.
    pub column: (usize, usize),
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Position of the first value.
    pub value: usize,
    /// Values from one column to the next.
    pub stride: usize,
}

/// What is dense in time of an element's own unknowns.
#[derive(Debug, Clone, Copy)]
struct InTime {
    /// How they depend on each other: as internal states.
    states: bool,
    /// How their equations depend on motions: by velocities.
    feedback: bool,
}

/// Node or multipliers a group of columns belongs to.
#[derive(Debug, Clone)]
struct ColumnGroup {
    /// Position of the group's first value.
    first_value: usize,
    /// Number of values in each column.
    length: usize,
    /// The columns.
    columns: Range<usize>,
}

/// Compressed-column structure of the Jacobian for a system and a number of grid points.
#[derive(Debug, Clone)]
pub struct Pattern {
    points: usize,
    nodes: Vec<ColumnGroup>,
    couplings: Couplings,
    /// Place, within a column, of the first row of each coupling.
    offsets: Vec<usize>,
    /// Elements with own unknowns of each node, and its number among their nodes.
    constrained: Vec<Vec<(usize, usize)>>,
    multipliers: Vec<ColumnGroup>,
    /// Place, within a column of `(element, local node)`, of the element's constraint rows.
    constraint_offsets: Vec<Vec<usize>>,
    /// Place, within a column of the element's multipliers, of each local node's rows.
    force_offsets: Vec<Vec<usize>>,
    /// Place, within a column of the element's multipliers, of its own rows.
    own_offsets: Vec<usize>,
    /// Nodes of each element, and what is dense in time of its own unknowns.
    elements: Vec<(Vec<usize>, InTime)>,
    column_pointers: Vec<usize>,
    row_indices: OnceLock<Vec<usize>>,
}

impl Pattern {
    /// Structure for `points` grid points.
    pub fn new(system: &System, points: usize) -> Self {
        let couplings = Couplings::new(system);
        let mut constrained: Vec<Vec<(usize, usize)>> = vec![Vec::new(); system.nodes()];
        for (index, placed) in system.elements().iter().enumerate() {
            if placed.element.own_unknowns() > 0 {
                for (local, &node) in placed.element.nodes().iter().enumerate() {
                    constrained[node].push((index, local));
                }
            }
        }
        let mut pattern = Pattern {
            points,
            nodes: Vec::new(),
            offsets: vec![0; couplings.all().len()],
            couplings,
            constrained,
            multipliers: Vec::new(),
            constraint_offsets: system
                .elements()
                .iter()
                .map(|p| vec![0; p.element.nodes().len()])
                .collect(),
            force_offsets: Vec::new(),
            own_offsets: Vec::new(),
            elements: Vec::new(),
            column_pointers: vec![0],
            row_indices: OnceLock::new(),
        };
        for node in 0..system.nodes() {
            let mut length = 0;
            for pair in pattern.pairs(node) {
                pattern.offsets[pair] = length;
                let moving = pattern.couplings.all()[pair].moving;
                length += if moving { 6 * points } else { 6 };
            }
            for &(index, local) in &pattern.constrained[node] {
                pattern.constraint_offsets[index][local] = length;
                let placed = &system.elements()[index];
                let times = if placed.has_feedback { points } else { 1 };
                length += times * placed.element.own_unknowns();
            }
            let group = pattern.next_group(length, 6 * points);
            pattern.nodes.push(group);
        }
        for placed in system.elements() {
            let in_time = InTime {
                states: placed.has_states,
                feedback: placed.has_feedback,
            };
            pattern.add_multiplier_columns(placed.element.as_ref(), in_time);
        }
        pattern
    }

    /// The next group of `columns` columns with `length` values each.
    fn next_group(&mut self, length: usize, columns: usize) -> ColumnGroup {
        let (first, first_value) = (self.size(), self.entries());
        let pointers = (1..=columns).map(|column| first_value + column * length);
        self.column_pointers.extend(pointers);
        ColumnGroup {
            first_value,
            length,
            columns: first..first + columns,
        }
    }

    fn add_multiplier_columns(&mut self, element: &dyn Element, in_time: InTime) {
        // Rows ascend with the node's index, whatever the element's own order.
        let mut order: Vec<usize> = (0..element.nodes().len()).collect();
        order.sort_by_key(|&local| element.nodes()[local]);
        let mut offsets = vec![0; order.len()];
        for (place, &local) in order.iter().enumerate() {
            offsets[local] = 6 * place;
        }
        self.force_offsets.push(offsets);
        // Internal states couple with themselves at all times, a multiplier's own entry regularises
        // it.
        let count = self.points * element.own_unknowns();
        let own_rows = if in_time.states { count } else { 1 };
        let group = self.next_group(6 * order.len() + own_rows, count);
        self.own_offsets.push(6 * order.len());
        self.multipliers.push(group);
        self.elements.push((element.nodes().to_vec(), in_time));
    }

    /// All entries, by dense panels; groups are those of [`Pattern::groups`].
    pub fn panels(&self) -> Vec<Panel> {
        let points = self.points;
        let mut panels = Vec::new();
        for (coupling, offset) in self.couplings.all().iter().zip(&self.offsets) {
            let group = &self.nodes[coupling.column];
            // One of all grid points, or one for each.
            let (parts, size) = match coupling.moving {
                true => (1, 6 * points),
                false => (points, 6),
            };
            panels.extend((0..parts).map(|k| Panel {
                row: (coupling.row, 6 * k),
                column: (coupling.column, 6 * k),
                rows: size,
                columns: size,
                value: group.first_value + 6 * k * group.length + offset,
                stride: group.length,
            }));
        }
        let mut own_group = self.nodes.len();
        for (index, (group, (nodes, in_time))) in
            self.multipliers.iter().zip(&self.elements).enumerate()
        {
            let all = group.columns.len();
            if all == 0 {
                continue;
            }
            let count = all / points;
            for (local, &node) in nodes.iter().enumerate() {
                // One of all grid points, or one for each.
                let (parts, times) = match in_time.feedback {
                    true => (1, points),
                    false => (points, 1),
                };
                panels.extend((0..parts).map(|k| Panel {
                    row: (own_group, count * k),
                    column: (node, 6 * k),
                    rows: count * times,
                    columns: 6 * times,
                    value: self.constraint_value(index, local, node, k, 0),
                    stride: self.nodes[node].length,
                }));
                for k in 0..points {
                    let forces = Panel {
                        row: (node, 6 * k),
                        column: (own_group, count * k),
                        rows: 6,
                        columns: count,
                        value: self.force_value(index, local, k, 0, count),
                        stride: group.length,
                    };
                    panels.push(forces);
                }
            }
            let (parts, size) = if in_time.states { (1, all) } else { (all, 1) };
            panels.extend((0..parts).map(|i| Panel {
                row: (own_group, i),
                column: (own_group, i),
                rows: size,
                columns: size,
                value: self.own_value(index, 0, 0, count) + i * group.length,
                stride: group.length,
            }));
            own_group += 1;
        }
        panels
    }

    /// Unknowns of each node, then those of each element's multipliers: what the direct solver
    /// keeps together.
    pub fn groups(&self) -> Vec<Range<usize>> {
        self.nodes
            .iter()
            .chain(&self.multipliers)
            .map(|group| group.columns.clone())
            .filter(|columns| !columns.is_empty())
            .collect()
    }

    /// Number of grid points, at each of which a group has as many unknowns.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Number of groups that are nodes.
    pub fn node_groups(&self) -> usize {
        self.nodes.len()
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.column_pointers.len() - 1
    }

    /// Number of stored entries.
    pub fn entries(&self) -> usize {
        self.column_pointers.last().map_or(0, |end| *end)
    }

    /// Positions of the values in the columns of a node.
    pub fn node_values(&self, node: usize) -> Range<usize> {
        let group = &self.nodes[node];
        group.first_value..group.first_value + group.length * group.columns.len()
    }

    /// Position of the first value behind those in columns of nodes.
    pub fn own_values_from(&self) -> usize {
        let last = self.nodes.len().checked_sub(1);
        last.map_or(0, |node| self.node_values(node).end)
    }

    /// Positions of the values in the columns of an element's own unknowns.
    pub fn own_values(&self, element: usize) -> Range<usize> {
        let group = &self.multipliers[element];
        group.first_value..group.first_value + group.length * group.columns.len()
    }

    /// Column pointers, one more than columns.
    pub fn column_pointers(&self) -> &[usize] {
        &self.column_pointers
    }

    /// Row index of each stored entry, ascending within a column.
    pub fn row_indices(&self) -> &[usize] {
        self.row_indices.get_or_init(|| {
            let groups = self.groups();
            let mut rows = vec![0; self.entries()];
            for panel in self.panels() {
                let first = groups[panel.row.0].start + panel.row.1;
                for column in 0..panel.columns {
                    let entries = &mut rows[panel.value + column * panel.stride..][..panel.rows];
                    let places = entries.iter_mut().zip(first..);
                    places.for_each(|(entry, row)| *entry = row);
                }
            }
            rows
        })
    }

    /// Numbers of the couplings in the columns of a node.
    pub fn pairs(&self, node: usize) -> Range<usize> {
        self.couplings.of_column(node)
    }

    /// Elements with own unknowns that a node is one of, and its number among their nodes.
    pub fn constrained(&self, node: usize) -> &[(usize, usize)] {
        &self.constrained[node]
    }

    /// Position of the first value of a coupling at grid point `k` among those of its column's
    /// node, and values from one column to the next.
    pub fn pair_place(&self, pair: usize, k: usize) -> (usize, usize) {
        let length = self.nodes[self.couplings.all()[pair].column].length;
        (6 * k * length + self.offsets[pair], length)
    }

    /// Position of the value on the diagonal of an unknown motion.
    pub fn diagonal(&self, motion: usize) -> usize {
        let (node, within) = (motion / (6 * self.points), motion % (6 * self.points));
        let pair = self.couplings.number(node, node);
        let row = match self.couplings.all()[pair].moving {
            true => within,
            false => within % 6,
        };
        let (first, stride) = self.pair_place(pair, within / 6);
        self.node_values(node).start + first + (within % 6) * stride + row
    }

    /// Position of an element's first constraint row in column `component` of its local node at
    /// `k`: of those at `k`, or of those at all grid points if it has feedback.
    pub fn constraint_value(
        &self,
        element: usize,
        local: usize,
        node: usize,
        k: usize,
        component: usize,
    ) -> usize {
        let group = &self.nodes[node];
        group.first_value
            + (6 * k + component) * group.length
            + self.constraint_offsets[element][local]
    }

    /// Position of an element's first own row in the column of its own unknown `row` of `count` at
    /// `k`: all of them for internal states, that on the diagonal for multipliers.
    pub fn own_value(&self, element: usize, k: usize, row: usize, count: usize) -> usize {
        let group = &self.multipliers[element];
        group.first_value + (count * k + row) * group.length + self.own_offsets[element]
    }

    /// Position of a local node's first row in the column of an element's multiplier `row` of
    /// `count`.
    pub fn force_value(
        &self,
        element: usize,
        local: usize,
        k: usize,
        row: usize,
        count: usize,
    ) -> usize {
        let group = &self.multipliers[element];
        group.first_value + (count * k + row) * group.length + self.force_offsets[element][local]
    }
}
