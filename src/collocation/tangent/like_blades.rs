//! The Jacobian of the unknowns that are left of a rotor of like blades, `Eᵀ J E / B`: rows of
//! leaders, whose columns are those of all that follow the same leader, carried there.
//! See docs/theory.md, section 8.10.

use super::like_blades_pattern::{Entry, LikeBladesPattern};
use super::{PairTangent, Tangent};
use crate::collocation::like_blades::LikeBlades;
use crate::collocation::problem::Collocation;
use crate::error::Result;
use crate::motion::DualMatrix;
use crate::workers::parts;
use nalgebra::Matrix6;

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
