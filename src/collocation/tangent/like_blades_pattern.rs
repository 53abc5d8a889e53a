//! Where the entries of the Jacobian stand that is left of a rotor of like blades (docs/theory.md,
//! section 8.10).

use super::Tangent;
use crate::collocation::like_blades::LikeBlades;
use crate::collocation::pattern::Panel;
use crate::system::System;
use std::collections::BTreeMap;
use std::ops::Range;

/// What is written into the columns of a group, from where on among its values.
#[derive(Debug, Clone, Copy)]
pub(super) enum Entry {
    /// A coupling, dense in time or as a part of one that is, with so many rows.
    Dense {
        pair: usize,
        first: usize,
        rows: usize,
    },
    /// A coupling that depends on motions alone, grid point by grid point.
    Still { pair: usize, first: usize },
    /// An element's own rows in the columns of its local node.
    Constraint {
        element: usize,
        local: usize,
        first: usize,
    },
    /// What an element's own unknowns do to its local node.
    Force {
        element: usize,
        local: usize,
        first: usize,
    },
    /// An element's own rows in its own columns.
    Own { element: usize, first: usize },
}

/// Places of the values, by groups: motions of each leading node, then own unknowns of each leading
/// element.
#[derive(Debug, Clone)]
pub struct LikeBladesPattern {
    pub(super) groups: Vec<Range<usize>>,
    node_groups: usize,
    panels: Vec<Panel>,
    /// Of each group: how many values, and what they are.
    pub(super) columns: Vec<(usize, Vec<Entry>)>,
}

impl LikeBladesPattern {
    /// Unknowns that the direct solver keeps together.
    pub fn groups(&self) -> &[Range<usize>] {
        &self.groups
    }

    /// How many of these are nodes.
    pub fn node_groups(&self) -> usize {
        self.node_groups
    }

    /// All entries, by dense panels; handed out once.
    pub fn take_panels(&mut self) -> Vec<Panel> {
        std::mem::take(&mut self.panels)
    }

    /// Number of values.
    pub fn entries(&self) -> usize {
        self.columns.iter().map(|(count, _)| count).sum()
    }

    /// Of the equations linearised in `tangent`.
    pub fn new(system: &System, tangent: &Tangent, left: &LikeBlades) -> Self {
        let leaders: Vec<usize> = (0..left.nodes.len())
            .filter(|&node| left.nodes[node].leader == node)
            .collect();
        let own_leaders: Vec<usize> = (0..left.elements.len())
            .filter(|&e| left.elements[e].leader == e)
            .filter(|&e| system.elements()[e].element.own_unknowns() > 0)
            .collect();
        let mut making = Making {
            system,
            left,
            group_of_node: vec![0; left.nodes.len()],
            group_of_element: vec![0; left.elements.len()],
            pattern: LikeBladesPattern {
                groups: Vec::new(),
                node_groups: leaders.len(),
                panels: Vec::new(),
                columns: Vec::new(),
            },
            first_value: 0,
        };
        for (group, &node) in leaders.iter().enumerate() {
            making.group_of_node[node] = group;
            let (first, parts) = left.node_places[node].unwrap_or_default();
            let count = 6 * parts * left.part;
            making.pattern.groups.push(first..first + count);
        }
        for (group, &element) in own_leaders.iter().enumerate() {
            making.group_of_element[element] = leaders.len() + group;
            let (first, parts) = left.element_places[element].unwrap_or_default();
            let own = system.elements()[element].element.own_unknowns();
            making
                .pattern
                .groups
                .push(first..first + own * parts * left.part);
        }
        let mut couplings: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        for &row in &leaders {
            for &pair in tangent.layout.couplings.of_row(row) {
                let column = left.nodes[tangent.couplings()[pair].column].leader;
                couplings.entry((column, row)).or_default().push(pair);
            }
        }
        let mut constrained: BTreeMap<usize, Vec<(usize, usize)>> = BTreeMap::new();
        for &element in &own_leaders {
            for (local, &node) in system.elements()[element]
                .element
                .nodes()
                .iter()
                .enumerate()
            {
                let column = left.nodes[node].leader;
                constrained
                    .entry(column)
                    .or_default()
                    .push((element, local));
            }
        }
        for &column in &leaders {
            making.pattern.columns.push((0, Vec::new()));
            for (&(_, row), pairs) in couplings.range((column, 0)..(column + 1, 0)) {
                making.add_couplings(tangent, column, row, pairs);
            }
            for &(element, local) in constrained.get(&column).into_iter().flatten() {
                making.add_constraints(element, local);
            }
            making.end_columns();
        }
        for &leader in &own_leaders {
            making.pattern.columns.push((0, Vec::new()));
            for (element, follower) in left.elements.iter().enumerate() {
                if follower.leader == leader {
                    making.add_forces(element);
                }
            }
            making.add_own(leader);
            making.end_columns();
        }
        making.pattern
    }
}

/// A pattern on its way.
struct Making<'a> {
    system: &'a System,
    left: &'a LikeBlades,
    group_of_node: Vec<usize>,
    group_of_element: Vec<usize>,
    pattern: LikeBladesPattern,
    /// First value of the present columns.
    first_value: usize,
}

impl Making<'_> {
    fn end_columns(&mut self) {
        self.first_value += self.pattern.columns.last().map_or(0, |(count, _)| *count);
    }

    /// Takes so many values for the present columns; gives the first among these.
    fn take(&mut self, count: usize) -> usize {
        let Some((values, _)) = self.pattern.columns.last_mut() else {
            return 0;
        };
        *values += count;
        *values - count
    }

    fn push(&mut self, entry: Entry) {
        if let Some((_, entries)) = self.pattern.columns.last_mut() {
            entries.push(entry);
        }
    }

    /// Grid points of a leading node.
    fn points(&self, node: usize) -> usize {
        let (_, parts) = self.left.node_places[node].unwrap_or_default();
        parts * self.left.part
    }

    /// Places within their groups.
    fn node_within(&self, node: usize, k: usize) -> (usize, usize) {
        let group = self.group_of_node[self.left.nodes[node].leader];
        let (first, _) = self.left.node_at(node, k);
        (group, first - self.pattern.groups[group].start)
    }

    fn element_within(&self, element: usize, count: usize, k: usize) -> (usize, usize) {
        let group = self.group_of_element[self.left.elements[element].leader];
        let (first, _) = self.left.element_at(element, count, k);
        (group, first - self.pattern.groups[group].start)
    }

    fn add_couplings(&mut self, tangent: &Tangent, column: usize, row: usize, pairs: &[usize]) {
        let (rows, columns) = (6 * self.points(row), 6 * self.points(column));
        if pairs.iter().any(|&pair| tangent.couplings()[pair].moving) {
            let first = self.take(rows * columns);
            for &pair in pairs {
                self.push(Entry::Dense { pair, first, rows });
            }
            self.pattern.panels.push(Panel {
                row: (self.group_of_node[row], 0),
                column: (self.group_of_node[column], 0),
                rows,
                columns,
                value: self.first_value + first,
                stride: rows,
            });
            return;
        }
        for &pair in pairs {
            let first = self.take(6 * rows);
            self.push(Entry::Still { pair, first });
            for l in 0..self.points(row) {
                let panel = Panel {
                    row: (self.group_of_node[row], 6 * l),
                    column: self.node_within(tangent.couplings()[pair].column, l),
                    rows: 6,
                    columns: 6,
                    value: self.first_value + first + 36 * l,
                    stride: 6,
                };
                self.pattern.panels.push(panel);
            }
        }
    }

    fn add_constraints(&mut self, element: usize, local: usize) {
        let placed = &self.system.elements()[element];
        let (count, node) = (placed.element.own_unknowns(), placed.element.nodes()[local]);
        let (_, parts) = self.left.element_places[element].unwrap_or_default();
        let points = parts * self.left.part;
        let first = self.take(6 * count * points);
        self.push(Entry::Constraint {
            element,
            local,
            first,
        });
        for l in 0..points {
            let panel = Panel {
                row: (self.group_of_element[element], count * l),
                column: self.node_within(node, l),
                rows: count,
                columns: 6,
                value: self.first_value + first + 6 * count * l,
                stride: count,
            };
            self.pattern.panels.push(panel);
        }
    }

    fn add_forces(&mut self, element: usize) {
        let placed = &self.system.elements()[element];
        let count = placed.element.own_unknowns();
        for (local, &node) in placed.element.nodes().iter().enumerate() {
            if self.left.nodes[node].leader != node {
                continue;
            }
            let points = self.points(node);
            let first = self.take(6 * count * points);
            self.push(Entry::Force {
                element,
                local,
                first,
            });
            for l in 0..points {
                let panel = Panel {
                    row: (self.group_of_node[node], 6 * l),
                    column: self.element_within(element, count, l),
                    rows: 6,
                    columns: count,
                    value: self.first_value + first + 6 * count * l,
                    stride: 6,
                };
                self.pattern.panels.push(panel);
            }
        }
    }

    fn add_own(&mut self, element: usize) {
        let placed = &self.system.elements()[element];
        let group = self.group_of_element[element];
        let size = self.pattern.groups[group].len();
        let (blocks, side) = if placed.has_states {
            (1, size)
        } else {
            (size, 1)
        };
        let first = self.take(blocks * side * side);
        self.push(Entry::Own { element, first });
        self.pattern.panels.extend((0..blocks).map(|i| Panel {
            row: (group, i),
            column: (group, i),
            rows: side,
            columns: side,
            value: self.first_value + first + i,
            stride: side,
        }));
    }
}
