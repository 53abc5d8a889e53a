//! Sparsity of the Jacobian: dense in time within and between nodes coupled by inertia or damping,
//! and within internal states; diagonal in time everywhere else.

use crate::elements::Element;
use crate::system::System;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::OnceLock;

/// Coupling of one node's rows with another node's columns.
#[derive(Debug, Clone)]
pub struct NodePair {
    /// Node of the rows.
    pub row: usize,
    /// Whether all grid points couple (otherwise each only with itself).
    pub dense: bool,
    /// Place of the first row within a column.
    pub offset: usize,
}

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
    /// Coupled nodes of each column node, in ascending order, numbered consecutively over all
    /// nodes.
    pairs: Vec<Vec<NodePair>>,
    first_pair: Vec<usize>,
    multipliers: Vec<ColumnGroup>,
    /// Place, within a column of `(element, local node)`, of the element's constraint rows.
    constraint_offsets: Vec<Vec<usize>>,
    /// Place, within a column of the element's multipliers, of each local node's rows.
    force_offsets: Vec<Vec<usize>>,
    /// Place, within a column of the element's multipliers, of its own rows.
    own_offsets: Vec<usize>,
    /// Nodes of each element, and whether its own unknowns are internal states.
    elements: Vec<(Vec<usize>, bool)>,
    column_pointers: Vec<usize>,
    row_indices: OnceLock<Vec<usize>>,
}

impl Pattern {
    /// Structure for `points` grid points.
    pub fn new(system: &System, points: usize) -> Self {
        let node_count = system.nodes();
        let mut coupled: Vec<BTreeMap<usize, bool>> = vec![BTreeMap::new(); node_count];
        let mut constrained: Vec<Vec<(usize, usize)>> = vec![Vec::new(); node_count];
        for (node, neighbours) in coupled.iter_mut().enumerate() {
            neighbours.insert(node, false);
        }
        for (index, placed) in system.elements().iter().enumerate() {
            let element = &placed.element;
            let dense = element.has_mass() || element.has_damping();
            for (local, &b) in element.nodes().iter().enumerate() {
                for &a in element.nodes() {
                    *coupled[b].entry(a).or_insert(false) |= dense;
                }
                if element.multipliers() > 0 {
                    constrained[b].push((index, local));
                }
            }
        }

        let mut pattern = Pattern {
            points,
            nodes: Vec::new(),
            pairs: Vec::new(),
            first_pair: Vec::new(),
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
        let mut pair_count = 0;
        for b in 0..node_count {
            let mut pairs = Vec::new();
            let mut length = 0;
            for (&row, &dense) in &coupled[b] {
                pairs.push(NodePair {
                    row,
                    dense,
                    offset: length,
                });
                length += if dense { 6 * points } else { 6 };
            }
            for &(index, local) in &constrained[b] {
                pattern.constraint_offsets[index][local] = length;
                length += system.elements()[index].element.multipliers();
            }
            let group = pattern.next_group(length, 6 * points);
            pattern.nodes.push(group);
            pattern.first_pair.push(pair_count);
            pair_count += pairs.len();
            pattern.pairs.push(pairs);
        }
        for placed in system.elements() {
            pattern.add_multiplier_columns(placed.element.as_ref(), placed.has_states);
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

    fn add_multiplier_columns(&mut self, element: &dyn Element, has_states: bool) {
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
        let count = self.points * element.multipliers();
        let own_rows = if has_states { count } else { 1 };
        let group = self.next_group(6 * order.len() + own_rows, count);
        self.own_offsets.push(6 * order.len());
        self.multipliers.push(group);
        self.elements.push((element.nodes().to_vec(), has_states));
    }

    /// All entries, by dense panels; groups are those of [`Pattern::groups`].
    pub fn panels(&self) -> Vec<Panel> {
        let points = self.points;
        let mut panels = Vec::new();
        for (node, (group, pairs)) in self.nodes.iter().zip(&self.pairs).enumerate() {
            for pair in pairs {
                // One of all grid points, or one for each.
                let (parts, size) = match pair.dense {
                    true => (1, 6 * points),
                    false => (points, 6),
                };
                panels.extend((0..parts).map(|k| Panel {
                    row: (pair.row, 6 * k),
                    column: (node, 6 * k),
                    rows: size,
                    columns: size,
                    value: group.first_value + 6 * k * group.length + pair.offset,
                    stride: group.length,
                }));
            }
        }
        let mut own_group = self.nodes.len();
        for (index, (group, (nodes, has_states))) in
            self.multipliers.iter().zip(&self.elements).enumerate()
        {
            let all = group.columns.len();
            if all == 0 {
                continue;
            }
            let count = all / points;
            for (local, &node) in nodes.iter().enumerate() {
                for k in 0..points {
                    let constraints = Panel {
                        row: (own_group, count * k),
                        column: (node, 6 * k),
                        rows: count,
                        columns: 6,
                        value: self.constraint_value(index, local, node, k, 0),
                        stride: self.nodes[node].length,
                    };
                    let forces = Panel {
                        row: (node, 6 * k),
                        column: (own_group, count * k),
                        rows: 6,
                        columns: count,
                        value: self.force_value(index, local, k, 0, count),
                        stride: group.length,
                    };
                    panels.extend([constraints, forces]);
                }
            }
            let (parts, size) = if *has_states { (1, all) } else { (all, 1) };
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

    /// Positions of the values in the columns of some nodes.
    pub fn node_values(&self, nodes: Range<usize>) -> Range<usize> {
        let end = |node: usize| match self.nodes.get(node) {
            Some(group) => group.first_value,
            None => self.own_values_from(),
        };
        end(nodes.start)..end(nodes.end)
    }

    /// Position of the first value behind those in columns of nodes.
    pub fn own_values_from(&self) -> usize {
        let group = self.nodes.last();
        group.map_or(0, |group| {
            group.first_value + group.length * group.columns.len()
        })
    }

    /// Positions of the values in the columns of an element's own unknowns.
    pub fn own_values(&self, element: usize) -> Range<usize> {
        let group = &self.multipliers[element];
        group.first_value..group.first_value + group.length * group.columns.len()
    }

    /// Numbers of the pairs in the columns of some nodes.
    pub fn pair_numbers(&self, columns: Range<usize>) -> Range<usize> {
        let first = |node: usize| match self.first_pair.get(node) {
            Some(first) => *first,
            None => self.pair_count(),
        };
        first(columns.start)..first(columns.end)
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

    /// Number of coupled pairs of nodes.
    pub fn pair_count(&self) -> usize {
        self.first_pair
            .last()
            .map_or(0, |f| f + self.pairs.last().map_or(0, Vec::len))
    }

    /// Pairs in the columns of node `column`, with their numbers.
    pub fn pairs(&self, column: usize) -> impl Iterator<Item = (usize, &NodePair)> {
        self.pairs[column]
            .iter()
            .enumerate()
            .map(move |(i, p)| (self.first_pair[column] + i, p))
    }

    /// Number of the pair of nodes `(row, column)`, which must be coupled.
    pub fn pair_number(&self, row: usize, column: usize) -> usize {
        let place = self.pairs[column].partition_point(|p| p.row < row);
        self.first_pair[column] + place
    }

    /// The pair of nodes `(row, column)`, which must be coupled.
    pub fn pair(&self, row: usize, column: usize) -> &NodePair {
        let place = self.pairs[column].partition_point(|p| p.row < row);
        &self.pairs[column][place]
    }

    /// Position of the first value of `pair` in column `component` of node `column` at point `k`.
    pub fn pair_value(&self, column: usize, pair: &NodePair, k: usize, component: usize) -> usize {
        let group = &self.nodes[column];
        group.first_value + (6 * k + component) * group.length + pair.offset
    }

    /// Position of the value on the diagonal of an unknown motion.
    pub fn diagonal(&self, motion: usize) -> usize {
        let (node, within) = (motion / (6 * self.points), motion % (6 * self.points));
        let pair = self.pair(node, node);
        let row = if pair.dense { within } else { within % 6 };
        self.pair_value(node, pair, within / 6, within % 6) + row
    }

    /// Position of an element's first constraint row in column `component` of its local node at
    /// `k`.
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
