//! The Jacobian of the unknowns that are left of a rotor of like blades, `Eᵀ J E / B`: rows of
//! leaders, whose columns are those of all that follow the same leader, carried there.
//! See docs/theory.md, section 9.6.

use super::{PairTangent, Tangent};
use crate::collocation::like_blades::LikeBlades;
use crate::collocation::pattern::Panel;
use crate::collocation::problem::Collocation;
use crate::error::Result;
use crate::motion::DualMatrix;
use crate::system::System;
use crate::workers::parts;
use nalgebra::Matrix6;
use std::collections::BTreeMap;
use std::ops::Range;

/// What is written into the columns of a group, from where on among its values.
#[derive(Debug, Clone, Copy)]
enum Entry {
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
    groups: Vec<Range<usize>>,
    node_groups: usize,
    panels: Vec<Panel>,
    /// Of each group: how many values, and what they are.
    columns: Vec<(usize, Vec<Entry>)>,
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

    /// All entries, by dense panels.
    pub fn panels(&self) -> &[Panel] {
        &self.panels
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

/// Scratch of one thread: `Γ_v` and `Γ_a` of a node, blocks `(ℓ, k)` at `k L + ℓ`.
#[derive(Debug, Default)]
struct Scratch {
    node: Option<usize>,
    gammas: Vec<[DualMatrix; 2]>,
}

/// What the values are assembled from.
struct Assembly<'a> {
    tangent: &'a Tangent,
    equations: &'a Collocation,
    left: &'a LikeBlades,
    /// Scales of forces by motions: those of all nodes are the same.
    scale: Matrix6<f64>,
}

impl Tangent {
    /// Writes the values of the scaled Jacobian of the unknowns that are left, in the order of
    /// `pattern`, with the compliance of constraints.
    ///
    /// # Errors
    /// If work is to end.
    pub fn assemble_like_blades(
        &self,
        equations: &Collocation,
        left: &LikeBlades,
        pattern: &LikeBladesPattern,
        values: &mut [f64],
    ) -> Result<()> {
        let assembly = Assembly {
            tangent: self,
            equations,
            left,
            scale: Matrix6::from_fn(|i, j| equations.row_scale[i] * equations.column_scale[j]),
        };
        let counts = pattern.columns.iter().map(|(count, _)| *count);
        let mut columns: Vec<&mut [f64]> = parts(values, counts).collect();
        let workers = &equations.division.workers;
        workers.try_for_each(
            &mut columns,
            &mut Vec::new(),
            Scratch::default,
            |scratch, group, values| {
                values.fill(0.0);
                let first = pattern.groups[group].start;
                for &entry in &pattern.columns[group].1 {
                    assembly.write(entry, first, scratch, values);
                }
                Ok(())
            },
        )
    }
}

impl Assembly<'_> {
    /// Writes an entry of the columns from `group` on.
    fn write(&self, entry: Entry, group: usize, scratch: &mut Scratch, values: &mut [f64]) {
        match entry {
            Entry::Dense { pair, first, rows } => {
                let values = &mut values[first..];
                if self.tangent.couplings()[pair].moving {
                    self.write_moving(pair, (group, rows), scratch, values);
                } else {
                    for l in 0..rows / 6 {
                        let (block, column) = self.still(pair, l);
                        let at = (column - group) * rows + 6 * l;
                        add_block(&block, &mut values[at..], rows);
                    }
                }
            }
            Entry::Still { pair, first } => {
                let row = self.tangent.couplings()[pair].row;
                let (_, parts) = self.left.node_places[row].unwrap_or_default();
                for l in 0..parts * self.left.part {
                    let (block, _) = self.still(pair, l);
                    add_block(&block, &mut values[first + 36 * l..], 6);
                }
            }
            Entry::Constraint {
                element,
                local,
                first,
            } => {
                self.write_constraints((element, local), &mut values[first..]);
            }
            Entry::Force {
                element,
                local,
                first,
            } => {
                self.write_forces((element, local), &mut values[first..]);
            }
            Entry::Own { element, first } => self.write_own(element, group, &mut values[first..]),
        }
    }

    /// A coupling without rates at grid point `l`, and its first column.
    fn still(&self, pair: usize, l: usize) -> (Matrix6<f64>, usize) {
        let node = self.tangent.couplings()[pair].column;
        let block = self
            .tangent
            .pair(pair, l)
            .stiffness
            .component_mul(&self.scale);
        let (column, carry) = self.left.node_at(node, l);
        (carry.map_or(block, |carry| block * carry), column)
    }

    /// Adds the rows of a coupling that depend on velocities and accelerations: `M Γ_a + C Γ_v`,
    /// and `K` on the diagonal in time.
    fn write_moving(
        &self,
        pair: usize,
        (group, rows): (usize, usize),
        scratch: &mut Scratch,
        values: &mut [f64],
    ) {
        let (tangent, points) = (self.tangent, self.tangent.points);
        let node = tangent.couplings()[pair].column;
        // Of leaders that have the whole period, and of those that have a part of it.
        let of_rows = rows / 6;
        if scratch.node != Some(node) || scratch.gammas.len() < points * of_rows {
            let blocks = (0..points).flat_map(|k| (0..of_rows).map(move |l| (l, k)));
            let gammas = blocks.map(|(l, k)| self.equations.rule.tangent(node, 0, l, k));
            scratch.gammas.clear();
            scratch.gammas.extend(gammas);
            scratch.node = Some(node);
        }
        let stride = scratch.gammas.len() / points;
        for k in 0..points {
            let (column, carry) = self.left.node_at(node, k);
            let first = (column - group) * rows;
            for l in 0..of_rows {
                let [gamma_v, gamma_a] = &scratch.gammas[k * stride + l];
                let PairTangent {
                    stiffness,
                    damping,
                    mass,
                } = tangent.pair(pair, l);
                let mut block = Matrix6::zeros();
                gamma_a.add_product_to(mass, &mut block);
                gamma_v.add_product_to(damping, &mut block);
                if l == k {
                    block += stiffness;
                }
                block.component_mul_assign(&self.scale);
                if let Some(carry) = carry {
                    block *= carry;
                }
                add_block(&block, &mut values[first + 6 * l..], rows);
            }
        }
    }

    /// Writes an element's own rows in the columns of its local node.
    fn write_constraints(&self, (index, local): (usize, usize), values: &mut [f64]) {
        let (equations, left) = (self.equations, self.left);
        let placed = &equations.system().elements()[index];
        let (count, node) = (placed.element.own_unknowns(), placed.element.nodes()[local]);
        let (_, parts) = left.element_places[index].unwrap_or_default();
        for l in 0..parts * left.part {
            let gradient = self.tangent.gradient(equations.system(), index, l);
            let rows = &equations.row_scale()[equations.layout().element_at(placed, l)];
            let entry = |row: usize, j: usize| {
                let scale = rows[row] * equations.column_scale()[j];
                gradient[(6 * local + j) * count + row] * scale
            };
            let (_, carry) = left.node_at(node, l);
            for (i, value) in values[6 * count * l..][..6 * count].iter_mut().enumerate() {
                let (row, column) = (i % count, i / count);
                *value = match carry {
                    Some(carry) => (0..6).map(|j| entry(row, j) * carry[(j, column)]).sum(),
                    None => entry(row, column),
                };
            }
        }
    }

    /// Writes what an element's own unknowns do to its local node, which leads.
    fn write_forces(&self, (index, local): (usize, usize), values: &mut [f64]) {
        let (equations, left) = (self.equations, self.left);
        let placed = &equations.system().elements()[index];
        let (count, node) = (placed.element.own_unknowns(), placed.element.nodes()[local]);
        let (_, parts) = left.node_places[node].unwrap_or_default();
        for l in 0..parts * left.part {
            let effect = self.tangent.effect(equations.system(), index, l);
            let columns = &equations.column_scale()[equations.layout().element_at(placed, l)];
            let entry = |component: usize, own: usize| {
                let scale = equations.row_scale()[component] * columns[own];
                effect[(6 * local + component) * count + own] * scale
            };
            let (_, carry) = left.element_at(index, count, l);
            for (i, value) in values[6 * count * l..][..6 * count].iter_mut().enumerate() {
                let (component, column) = (i % 6, i / 6);
                *value = match carry {
                    Some(carry) => (0..count)
                        .map(|own| entry(component, own) * carry[(own, column)])
                        .sum(),
                    None => entry(component, column),
                };
            }
        }
    }

    /// Writes an element's own rows in its own columns, which begin at `group`: of internal states
    /// `∂/∂λ_ℓ`, and `D_ℓk` times `∂/∂λ̇_ℓ`; of multipliers their compliance.
    fn write_own(&self, index: usize, group: usize, values: &mut [f64]) {
        let (equations, left) = (self.equations, self.left);
        let placed = &equations.system().elements()[index];
        let count = placed.element.own_unknowns();
        let (_, parts) = left.element_places[index].unwrap_or_default();
        let size = count * parts * left.part;
        if !placed.has_states {
            values[..size].fill(-equations.regularisation());
            return;
        }
        let layout = equations.layout();
        for l in 0..parts * left.part {
            let (own, own_rate) = self.tangent.own(equations.system(), index, l);
            let rows = &equations.row_scale()[layout.element_at(placed, l)];
            let columns = &equations.column_scale()[layout.element_at(placed, l)];
            for k in 0..self.tangent.points {
                let d = equations.rule.rate_weight(0, l, k);
                let constant = f64::from(l == k);
                // Internal states are those of the leader itself.
                let (first, _) = left.element_at(index, count, k);
                for (column, own_scale) in columns.iter().enumerate() {
                    let at = (first - group + column) * size + count * l;
                    for (row, scale) in rows.iter().enumerate() {
                        let place = column * count + row;
                        let entry = d * own_rate[place] + constant * own[place];
                        values[at + row] += entry * (scale * own_scale);
                    }
                }
            }
        }
    }
}

/// Adds a block to values whose columns are `stride` apart.
#[inline]
fn add_block(block: &Matrix6<f64>, values: &mut [f64], stride: usize) {
    for component in 0..6 {
        let column = values[component * stride..][..6].iter_mut();
        column
            .zip(&block.column(component))
            .for_each(|(value, x)| *value += x);
    }
}
