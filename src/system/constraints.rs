//! Which constraints depend on others: closed loops of joints, and the rank of their gradient.
//!
//! Constraints of different elements can only depend on each other if they act on the same nodes
//! all around a loop. So the gradient is looked at loop by loop, densely. See docs/theory.md,
//! section 5.6.

use super::{ElementRole, Placed, System, Workspace};
use crate::elements::{Measure, NodeState, Unknown};
use crate::error::Result;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// A gradient of which no more than this is left beside those of other constraints, relative to the
/// largest, depends on them: geometry given with rounding leaves less, and no working joint comes
/// near.
const REDUNDANT: f64 = 1e-7;

/// Loops with more constraints than this are not looked at: their dense factorisation would take
/// longer than the solve.
const MOST_ROWS: usize = 1500;

impl Dependency {
    /// What takes part.
    pub fn constraints(&self) -> ConstraintNames {
        let mut names = ConstraintNames::default();
        self.roles.iter().for_each(|role| names.add(*role));
        names
    }
}

/// What constrains, by index.
#[derive(Debug, Clone, Default)]
pub struct ConstraintNames {
    /// Joints.
    pub joints: Vec<usize>,
    /// Relations between joint coordinates.
    pub relations: Vec<usize>,
    /// Prescribed coordinates.
    pub prescribed: Vec<usize>,
}

impl ConstraintNames {
    /// Adds what constrains of this role, if it does.
    pub fn add(&mut self, role: ElementRole) {
        match role {
            ElementRole::Joint(index) => self.joints.push(index),
            ElementRole::Relation(index) => self.relations.push(index),
            ElementRole::Prescribed(index) => self.prescribed.push(index),
            _ => {}
        }
    }

    /// The same without those that are prescribed, and these.
    pub fn parted(self) -> [Self; 2] {
        let prescribed = ConstraintNames {
            prescribed: self.prescribed,
            ..Self::default()
        };
        let others = ConstraintNames {
            prescribed: Vec::new(),
            ..self
        };
        [others, prescribed]
    }
}

/// "joints 0, 1, 2, relation 0 and prescribed coordinate 0".
impl fmt::Display for ConstraintNames {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all = [
            ("joint", &self.joints),
            ("relation", &self.relations),
            ("prescribed coordinate", &self.prescribed),
        ];
        let there = all.iter().filter(|(_, ids)| !ids.is_empty());
        let mut names: Vec<String> = there.map(|(noun, ids)| name_all(noun, ids)).collect();
        let last = names.pop().unwrap_or_default();
        if !names.is_empty() {
            write!(f, "{} and ", names.join(", "))?;
        }
        f.write_str(&last)
    }
}

impl fmt::Display for Dependency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = if self.count == 1 { "" } else { "s" };
        let (count, names) = (self.count, self.constraints());
        write!(f, "{count} redundant constraint{plural} among {names}")
    }
}

/// "node 3", or "nodes 3, 4, 5 and 2 more".
pub fn name_all(noun: &str, ids: &[usize]) -> String {
    const MOST: usize = 6;
    let names: Vec<String> = ids.iter().take(MOST).map(usize::to_string).collect();
    let more = match ids.len().saturating_sub(MOST) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let plural = if ids.len() == 1 { "" } else { "s" };
    format!("{noun}{plural} {}{more}", names.join(", "))
}

/// Constraints coupled through common nodes that close at least one loop, the ground included.
#[derive(Debug, Clone)]
pub struct ConstraintLoop {
    /// Elements, by index in the system.
    elements: Vec<usize>,
    /// First row of each element.
    first_rows: Vec<usize>,
    rows: usize,
    /// Nodes that represent the members, ascending.
    nodes: Vec<usize>,
}

/// Constraints of a loop that depend on each other.
#[derive(Debug, Clone)]
pub struct Dependency {
    /// Number of constraints more than there can be independent ones.
    pub count: usize,
    /// What takes part.
    pub roles: Vec<ElementRole>,
}

/// All loops of a system whose node `n` moves as one with node `members[n]`, which represents its
/// member.
fn constraint_loops(system: &System, members: &[usize]) -> Vec<ConstraintLoop> {
    // Members connected by constraints; the ground connects nothing.
    let mut group: Vec<usize> = (0..system.nodes()).collect();
    fn root(group: &mut [usize], mut n: usize) -> usize {
        while group[n] != n {
            group[n] = group[group[n]];
            n = group[n];
        }
        n
    }
    let constraining: Vec<usize> = (0..system.elements().len())
        .filter(|&e| {
            let placed = &system.elements()[e];
            placed.element.own_unknowns() > 0 && !placed.has_states
        })
        .collect();
    for &e in &constraining {
        let nodes = system.elements()[e].element.nodes();
        for pair in nodes.windows(2) {
            let (a, b) = (members[pair[0]], members[pair[1]]);
            let (a, b) = (root(&mut group, a), root(&mut group, b));
            group[a] = b;
        }
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &e in &constraining {
        if let Some(&node) = system.elements()[e].element.nodes().first() {
            let root = root(&mut group, members[node]);
            groups.entry(root).or_default().push(e);
        }
    }
    groups
        .into_values()
        .filter(|elements| closes_loop(system, members, elements))
        .map(|elements| {
            let mut rows = 0;
            let mut first_rows = Vec::new();
            let mut nodes = BTreeSet::new();
            for &e in &elements {
                first_rows.push(rows);
                rows += system.elements()[e].element.own_unknowns();
                let own = system.elements()[e].element.nodes();
                nodes.extend(own.iter().map(|&n| members[n]));
            }
            ConstraintLoop {
                elements,
                first_rows,
                rows,
                nodes: nodes.into_iter().collect(),
            }
        })
        .filter(|l| l.rows <= MOST_ROWS)
        .collect()
}

/// Whether connected constraints are more than a tree of joints, each with at most one driven
/// coordinate: relations may always close a loop.
fn closes_loop(system: &System, members: &[usize], elements: &[usize]) -> bool {
    let mut vertices = BTreeSet::new();
    let mut joined = BTreeSet::new();
    let mut driven = BTreeSet::new();
    let mut edges = 0;
    for &e in elements {
        let placed = &system.elements()[e];
        if matches!(placed.role, ElementRole::Relation(_)) {
            return true;
        }
        let nodes = placed.element.nodes();
        // The ground is a vertex too.
        let vertex = |end: usize| nodes.get(end).map_or(usize::MAX, |&n| members[n]);
        let mut ends = [vertex(0), vertex(1)];
        ends.sort_unstable();
        vertices.extend(ends);
        let repeated = match placed.role {
            ElementRole::Prescribed(_) => !driven.insert(ends),
            _ => {
                edges += 1;
                !joined.insert(ends)
            }
        };
        if repeated {
            return true;
        }
    }
    edges += driven.difference(&joined).count();
    edges + 1 > vertices.len()
}

impl ConstraintLoop {
    /// Null space of the transposed, scaled gradient at the given states: multipliers without
    /// effect.
    fn null_space(
        &self,
        system: &System,
        members: &[usize],
        state: &impl Fn(usize) -> NodeState,
        workspace: &mut Workspace,
    ) -> Result<Vec<Vec<f64>>> {
        let length = system.scales().length;
        let size = 6 * self.nodes.len();
        // Row by row.
        let mut gradient = vec![0.0; self.rows * size];
        // Neither signals nor turns change a gradient.
        let signals = vec![0.0; system.signals()];
        for (&e, &first) in self.elements.iter().zip(&self.first_rows) {
            let placed = &system.elements()[e];
            let out = system.evaluate_relaxed(placed, state, &signals, workspace)?;
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                let member = members[node];
                let column = 6 * self.nodes.partition_point(|&n| n < member);
                let mut own = out.gradient.fixed_columns::<6>(6 * local).into_owned();
                if node != member {
                    own = &own * state(node).motion.relative(&state(member).motion).adjoint();
                }
                for row in 0..placed.element.own_unknowns() {
                    let scale = match system.unknown(placed.first_own + row) {
                        Unknown::Multiplier(Measure::Length) => 1.0 / length,
                        _ => 1.0,
                    };
                    let entries = &mut gradient[(first + row) * size + column..][..6];
                    for (k, entry) in entries.iter_mut().enumerate() {
                        let unit = if k < 3 { length } else { 1.0 };
                        *entry += scale * unit * own[(row, k)];
                    }
                }
            }
        }
        let finite = gradient.iter().all(|x| x.is_finite());
        Ok(match finite {
            true => dependent_rows(&mut gradient, self.rows),
            false => Vec::new(),
        })
    }

    fn describe(&self, system: &System, null: &[Vec<f64>]) -> Dependency {
        let takes_part = |first: usize, count: usize| {
            (first..first + count).any(|row| {
                let size: f64 = null.iter().map(|direction| direction[row].powi(2)).sum();
                size > 1e-8
            })
        };
        let roles = self
            .elements
            .iter()
            .zip(&self.first_rows)
            .map(|(&e, &first)| (&system.elements()[e], first))
            .filter(|(placed, first)| takes_part(*first, placed.element.own_unknowns()))
            .map(|(placed, _)| placed.role)
            .collect();
        Dependency {
            count: null.len(),
            roles,
        }
    }
}

/// Sums in six parts side by side, as there are unknowns of a node.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut parts = [0.0; 6];
    let (a, b) = (a.chunks_exact(6), b.chunks_exact(6));
    let rest = a.remainder().iter().zip(b.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for i in 0..6 {
            parts[i] += a[i] * b[i];
        }
    }
    parts.iter().sum::<f64>() + rest
}

/// Orthonormal combinations of the `count` rows of a matrix that vanish. Takes from the rows, the
/// largest first, what they have along those before; what is left of them is none of the matrix any
/// more.
fn dependent_rows(matrix: &mut [f64], count: usize) -> Vec<Vec<f64>> {
    let size = matrix.len() / count.max(1);
    let mut rows: Vec<&mut [f64]> = matrix.chunks_exact_mut(size.max(1)).collect();
    let mut order: Vec<usize> = (0..rows.len()).collect();
    let mut largest = 0.0f64;
    // Of each direction found: what each row has along it, and that of the row that it was found
    // by.
    let mut parts: Vec<Vec<f64>> = Vec::new();
    while parts.len() < rows.len() {
        let rank = parts.len();
        let norms = rows[rank..].iter().map(|row| dot(row, row).sqrt());
        let (place, norm) =
            norms.enumerate().fold(
                (0, 0.0),
                |most, (i, norm)| {
                    if norm > most.1 { (i, norm) } else { most }
                },
            );
        largest = largest.max(norm);
        if norm <= REDUNDANT * largest {
            break;
        }
        rows.swap(rank, rank + place);
        order.swap(rank, rank + place);
        let (before, others) = rows.split_at_mut(rank + 1);
        let direction = &mut *before[rank];
        direction.iter_mut().for_each(|x| *x /= norm);
        let mut part = vec![0.0; count];
        part[order[rank]] = norm;
        for (row, &number) in others.iter_mut().zip(&order[rank + 1..]) {
            let along = dot(row, direction);
            let pairs = row.iter_mut().zip(&*direction);
            pairs.for_each(|(x, d)| *x -= along * d);
            part[number] = along;
        }
        parts.push(part);
    }
    let rank = parts.len();
    let mut null: Vec<Vec<f64>> = Vec::new();
    for &dependent in &order[rank..] {
        let mut column = vec![0.0; count];
        column[dependent] = 1.0;
        // The row less what it is of the others, whose parts along the directions are a triangle.
        for (s, part) in parts.iter().enumerate().rev() {
            let known = order[s + 1..rank].iter().map(|&i| part[i] * column[i]);
            column[order[s]] = -(part[dependent] + known.sum::<f64>()) / part[order[s]];
        }
        // Twice, for rounding.
        for other in null.iter().chain(&null) {
            let along = dot(&column, other);
            let pairs = column.iter_mut().zip(other);
            pairs.for_each(|(x, d)| *x -= along * d);
        }
        let norm = dot(&column, &column).sqrt();
        column.iter_mut().for_each(|x| *x /= norm);
        null.push(column);
    }
    null
}

impl System {
    /// Looks for constraints that depend on each other in the reference configuration.
    pub(super) fn find_dependencies(&mut self) -> Result<()> {
        let members: Vec<usize> = (0..self.nodes()).collect();
        self.loops = constraint_loops(self, &members);
        self.dependencies = self.dependencies_of(&self.loops, &members)?;
        Ok(())
    }

    fn dependencies_of(
        &self,
        loops: &[ConstraintLoop],
        members: &[usize],
    ) -> Result<Vec<Dependency>> {
        let at_rest = |node: usize| NodeState::at_rest(self.reference[node]);
        let mut found = Vec::new();
        let mut workspace = self.workspace(true);
        for l in loops {
            let null = l.null_space(self, members, &at_rest, &mut workspace)?;
            if !null.is_empty() {
                found.push(l.describe(self, &null));
            }
        }
        Ok(found)
    }

    /// Constraints that depend on each other in the reference configuration.
    pub fn dependencies(&self) -> &[Dependency] {
        &self.dependencies
    }

    /// Constraints that would depend on each other if every node `n` moved as one with
    /// `members[n]`.
    pub(super) fn dependencies_if_rigid(&self, members: &[usize]) -> Result<Vec<Dependency>> {
        self.dependencies_of(&constraint_loops(self, members), members)
    }

    /// Number of constraints that depend on others in the reference configuration.
    pub fn redundant_constraints(&self) -> usize {
        self.dependencies.iter().map(|d| d.count).sum()
    }

    /// Number of constraints.
    pub fn constraint_count(&self) -> usize {
        let constrain = self.elements.iter().filter(|p| !p.has_states);
        constrain.map(|p| p.element.own_unknowns()).sum()
    }

    /// Whether anything may move otherwise than is prescribed, in the reference configuration.
    pub fn has_freedoms(&self) -> bool {
        6 * self.nodes() + self.redundant_constraints() > self.constraint_count()
    }

    /// Takes from the multipliers of an instant the part that has no effect, so that their norm is
    /// least; moments count divided by the characteristic length. `at` is the place of the first
    /// multiplier of an element, given by index, in `multipliers`. `workspace` is one with
    /// tangents.
    pub fn reduce_to_least_norm(
        &self,
        state: impl Fn(usize) -> NodeState,
        at: impl Fn(usize) -> usize,
        multipliers: &mut [f64],
        workspace: &mut Workspace,
    ) -> Result<()> {
        let members: Vec<usize> = (0..self.nodes()).collect();
        for l in &self.loops {
            let null = l.null_space(self, &members, &state, workspace)?;
            if null.is_empty() {
                continue;
            }
            let mut values = Vec::with_capacity(l.rows);
            let unit = |placed: &Placed, row: usize| match self.unknown(placed.first_own + row) {
                Unknown::Multiplier(Measure::Length) => 1.0,
                _ => self.scales.length,
            };
            let places: Vec<(usize, f64)> = l
                .elements
                .iter()
                .flat_map(|&e| {
                    let (placed, first) = (&self.elements[e], at(e));
                    (0..placed.element.own_unknowns())
                        .map(move |row| (first + row, unit(placed, row)))
                })
                .collect();
            values.extend(places.iter().map(|&(i, unit)| multipliers[i] / unit));
            for direction in &null {
                let part: f64 = direction.iter().zip(&values).map(|(d, v)| d * v).sum();
                for (&(i, unit), d) in places.iter().zip(direction) {
                    multipliers[i] -= part * d * unit;
                }
            }
        }
        Ok(())
    }
}
