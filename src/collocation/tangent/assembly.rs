//! The Jacobian, assembled, and the polynomial in `μ` that it is for increments `exp(μt) Δu`, which
//! is that of small motions where nothing moves.
//! See docs/theory.md, section 5.3.

use super::Tangent;
use crate::collocation::pattern::Pattern;
use crate::collocation::problem::Collocation;
use crate::collocation::state::GridState;
use crate::error::Result;
use crate::motion::DualMatrix;
use crate::system::Placed;
use crate::workers::parts;
use nalgebra::Matrix6;

/// Scratch of one thread.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    /// `Γ_v` and `Γ_a` of a node, blocks `(ℓ, k)` at `k N + ℓ`.
    gammas: Vec<[DualMatrix; 2]>,
    /// `K` and `C` of a coupling, stress resultants included.
    whole: [Vec<Matrix6<f64>>; 2],
}

/// `J(μ) = K + μ C + μ² M` for increments `exp(μt) Δu`, scaled as the Jacobian is: values in the
/// order of one pattern.
///
/// At rest on a grid of one point these are stiffness, damping and mass for small motions:
/// constraints are a part of `K`, rates of internal states of `C`.
#[derive(Debug, Clone)]
pub struct Linearisation {
    /// `K`.
    pub stiffness: Vec<f64>,
    /// `C`.
    pub damping: Vec<f64>,
    /// `M`.
    pub mass: Vec<f64>,
    /// Where constraints depend on each other, a small compliance of all of them that makes factors
    /// of `K` exist; no part of the equations.
    pub compliance: Option<Vec<f64>>,
}

impl Collocation {
    /// Writes the values of the scaled Jacobian at `state`, in the order of `pattern`.
    pub fn jacobian(
        &mut self,
        state: &GridState,
        pattern: &Pattern,
        tangent: &mut Tangent,
        values: &mut [f64],
    ) -> Result<()> {
        tangent.evaluate(self, state)?;
        tangent.assemble(self, pattern, 0, values)?;
        self.add_compliance(pattern, values);
        Ok(())
    }

    /// Linearises about `state`, for increments `exp(μt) Δu`.
    pub fn linearise(&mut self, state: &GridState, pattern: &Pattern) -> Result<Linearisation> {
        let mut tangent = Tangent::new(self.system(), self.grid().points());
        tangent.evaluate(self, state)?;
        let mut power = |power: usize| {
            let mut values = vec![0.0; pattern.entries()];
            tangent.assemble(self, pattern, power, &mut values)?;
            Ok(values)
        };
        let (stiffness, damping, mass) = (power(0)?, power(1)?, power(2)?);
        Ok(Linearisation {
            compliance: self.is_regularised().then(|| {
                let mut compliance = vec![0.0; pattern.entries()];
                self.add_compliance(pattern, &mut compliance);
                compliance
            }),
            stiffness,
            damping,
            mass,
        })
    }

    /// Writes the compliance of constraints that may depend on each other into a scaled matrix.
    pub(super) fn add_compliance(&self, pattern: &Pattern, values: &mut [f64]) {
        if !self.is_regularised() {
            return;
        }
        for (index, placed) in self.system().elements().iter().enumerate() {
            let count = placed.element.own_unknowns();
            if placed.has_states {
                continue;
            }
            for k in 0..self.grid().points() {
                for row in 0..count {
                    values[pattern.own_value(index, k, row, count)] = -self.regularisation();
                }
            }
        }
    }

    /// Scales of the rows and columns of an element's own unknowns at grid point `k`.
    fn own_scales(&self, placed: &Placed, k: usize) -> [&[f64]; 2] {
        let places = self.layout().element_at(placed, k);
        [self.row_scale(), self.column_scale()].map(|scale| &scale[places.clone()])
    }
}

/// What a matrix is assembled from.
struct Assembly<'a> {
    tangent: &'a Tangent,
    equations: &'a Collocation,
    pattern: &'a Pattern,
    power: usize,
    /// Of what does not depend on `μ`: 1 or 0.
    constant: f64,
    /// Scales of forces by motions: those of all nodes are the same.
    scale: Matrix6<f64>,
}

impl Tangent {
    /// Writes what multiplies `μ^power` in the scaled Jacobian for increments `exp(μt) Δu`, in the
    /// order of `pattern`, without the compliance of constraints. With power 0 that is the Jacobian
    /// itself.
    ///
    /// # Errors
    /// If work is to end.
    pub fn assemble(
        &mut self,
        equations: &Collocation,
        pattern: &Pattern,
        power: usize,
        values: &mut [f64],
    ) -> Result<()> {
        let mut scratch = std::mem::take(&mut self.assembly);
        let assembly = Assembly {
            tangent: self,
            equations,
            pattern,
            power,
            constant: f64::from(power == 0),
            scale: Matrix6::from_fn(|i, j| equations.row_scale[i] * equations.column_scale[j]),
        };
        let system = equations.system();
        let workers = &equations.division.workers;
        let (of_nodes, of_own) = values.split_at_mut(pattern.own_values_from());
        let counts = (0..system.nodes()).map(|node| pattern.node_values(node).len());
        let mut columns: Vec<&mut [f64]> = parts(of_nodes, counts).collect();
        let done = workers.try_for_each(
            &mut columns,
            &mut scratch,
            Scratch::default,
            |scratch, node, values| {
                assembly.write_node(node, scratch, values);
                Ok(())
            },
        );
        let counts = (0..system.elements().len()).map(|index| pattern.own_values(index).len());
        let mut own: Vec<&mut [f64]> = parts(of_own, counts).collect();
        workers.each(&mut own, |index, values| assembly.write_own(index, values));
        self.assembly = scratch;
        done
    }
}

impl Assembly<'_> {
    /// Writes the columns of a node.
    fn write_node(&self, node: usize, scratch: &mut Scratch, values: &mut [f64]) {
        let (pattern, points) = (self.pattern, self.tangent.points);
        let rule = &self.equations.rule;
        let couplings = self.tangent.couplings();
        scratch.gammas.clear();
        if pattern.pairs(node).any(|pair| couplings[pair].moving) {
            let blocks = (0..points).flat_map(|k| (0..points).map(move |l| (l, k)));
            let gammas = blocks.map(|(l, k)| rule.tangent(node, self.power, l, k));
            scratch.gammas.extend(gammas);
        }
        for pair in pattern.pairs(node) {
            match couplings[pair].moving {
                true => self.write_moving(pair, scratch, values),
                false => self.write_still(pair, values),
            }
        }
        for &(index, local) in pattern.constrained(node) {
            match self.equations.system().elements()[index].has_feedback {
                true => self.write_feedback(node, (index, local), scratch, values),
                false => self.write_constraint(node, (index, local), values),
            }
        }
    }

    /// Writes the rows of a coupling that depend on velocities and accelerations: `M Γ_a + C Γ_v`,
    /// and `K` on the diagonal in time.
    fn write_moving(&self, pair: usize, scratch: &mut Scratch, values: &mut [f64]) {
        let (tangent, points) = (self.tangent, self.tangent.points);
        let at = tangent.layout.coupling_at.of(pair);
        let Scratch { gammas, whole } = scratch;
        let [mut stiffness, mut damping, mass] =
            tangent.pairs.each_ref().map(|list| &list[at.clone()]);
        if !tangent.layout.within[pair].is_empty() {
            whole.iter_mut().for_each(Vec::clear);
            for k in 0..points {
                let blocks = tangent.whole_pair(pair, k);
                let lists = whole.iter_mut().zip(blocks);
                lists.for_each(|(list, block)| list.push(block));
            }
            (stiffness, damping) = (&whole[0], &whole[1]);
        }
        for k in 0..points {
            let (first, stride) = self.pattern.pair_place(pair, k);
            for (l, [gamma_v, gamma_a]) in gammas[k * points..][..points].iter().enumerate() {
                let rest = (l == k && self.power == 0).then(|| &stiffness[l]);
                for j in 0..3 {
                    // Few numbers at a time, which need not be stored on the way.
                    let mut columns = match rest {
                        Some(rest) => [rest.data.0[j], rest.data.0[j + 3]],
                        None => [[0.0; 6]; 2],
                    };
                    gamma_a.add_columns_of_product(&mass[l], j, &mut columns);
                    gamma_v.add_columns_of_product(&damping[l], j, &mut columns);
                    for (component, column) in [j, j + 3].into_iter().zip(&columns) {
                        let to = &mut values[first + component * stride + 6 * l..][..6];
                        let entries = column.iter().zip(&self.scale.data.0[component]);
                        let entries = to.iter_mut().zip(entries);
                        entries.for_each(|(to, (entry, scale))| *to = entry * scale);
                    }
                }
            }
        }
    }

    /// Writes the rows of a coupling that depend on motions alone: `K`.
    fn write_still(&self, pair: usize, values: &mut [f64]) {
        let scale = self.scale * self.constant;
        for k in 0..self.tangent.points {
            let block = self.tangent.pair(pair, k).stiffness.component_mul(&scale);
            let (first, stride) = self.pattern.pair_place(pair, k);
            write_block(&block, &mut values[first..], stride);
        }
    }

    /// Writes an element's own rows in the columns of its local node.
    fn write_constraint(&self, node: usize, (index, local): (usize, usize), values: &mut [f64]) {
        let (equations, first) = (self.equations, self.pattern.node_values(node).start);
        let placed = &equations.system().elements()[index];
        let count = placed.element.own_unknowns();
        for k in 0..self.tangent.points {
            let gradient = self.tangent.gradient(equations.system(), index, k);
            let [rows, _] = equations.own_scales(placed, k);
            let columns = gradient[6 * local * count..].chunks_exact(count);
            for (component, column) in columns.take(6).enumerate() {
                let at = self
                    .pattern
                    .constraint_value(index, local, node, k, component)
                    - first;
                let scale = self.constant * equations.column_scale()[component];
                let values = values[at..].iter_mut();
                for ((value, entry), row) in values.zip(column).zip(rows) {
                    // Scales first: what depends on each other exactly goes on to do so.
                    *value = entry * (row * scale);
                }
            }
        }
    }

    /// Writes the rows of an element's states with feedback in the columns of its local node: `G`
    /// on the diagonal in time, and what velocities add, times `Γ_v`.
    fn write_feedback(
        &self,
        node: usize,
        (index, local): (usize, usize),
        scratch: &Scratch,
        values: &mut [f64],
    ) {
        let (equations, first) = (self.equations, self.pattern.node_values(node).start);
        let (system, points) = (equations.system(), self.tangent.points);
        let placed = &system.elements()[index];
        let count = placed.element.own_unknowns();
        for k in 0..points {
            for (l, [gamma_v, _]) in scratch.gammas[k * points..][..points].iter().enumerate() {
                let gamma = gamma_v.to_twist_matrix();
                let own = 6 * local * count..6 * (local + 1) * count;
                let by_velocity = &self.tangent.gradient_rate(system, index, l)[own.clone()];
                let by_motion = &self.tangent.gradient(system, index, l)[own];
                let constant = self.constant * f64::from(l == k);
                let [rows, _] = equations.own_scales(placed, l);
                for component in 0..6 {
                    let place = (self.pattern).constraint_value(index, local, node, k, component)
                        + count * l
                        - first;
                    let column_scale = equations.column_scale()[component];
                    for (row, scale) in rows.iter().enumerate() {
                        let by_rate: f64 = (0..6)
                            .map(|i| by_velocity[i * count + row] * gamma[(i, component)])
                            .sum();
                        let entry = by_rate + constant * by_motion[component * count + row];
                        values[place + row] = entry * (scale * column_scale);
                    }
                }
            }
        }
    }

    /// Writes the columns of an element's own unknowns.
    fn write_own(&self, index: usize, values: &mut [f64]) {
        let (equations, pattern) = (self.equations, self.pattern);
        let placed = &equations.system().elements()[index];
        let count = placed.element.own_unknowns();
        let first = pattern.own_values(index).start;
        for k in 0..self.tangent.points {
            let [_, columns] = equations.own_scales(placed, k);
            let effect = self.tangent.effect(equations.system(), index, k);
            for local in 0..placed.element.nodes().len() {
                for (row, own_scale) in columns.iter().enumerate() {
                    let at = pattern.force_value(index, local, k, row, count) - first;
                    for component in 0..6 {
                        let scale = equations.row_scale()[component] * own_scale * self.constant;
                        let entry = effect[(6 * local + component) * count + row];
                        values[at + component] = entry * scale;
                    }
                }
            }
            match placed.has_states {
                true => self.write_states(index, k, values),
                false => (0..count)
                    .for_each(|row| values[pattern.own_value(index, k, row, count) - first] = 0.0),
            }
        }
    }

    /// Writes the rows of an element's internal states at grid point `l`: `∂/∂λ_ℓ`, and `D_ℓk`
    /// times `∂/∂λ̇_ℓ`.
    fn write_states(&self, index: usize, l: usize, values: &mut [f64]) {
        let (equations, pattern) = (self.equations, self.pattern);
        let placed = &equations.system().elements()[index];
        let count = placed.element.own_unknowns();
        let first = pattern.own_values(index).start;
        let (own, own_rate) = self.tangent.own(equations.system(), index, l);
        let [rows, columns] = equations.own_scales(placed, l);
        for k in 0..self.tangent.points {
            let d = equations.rule.rate_weight(self.power, l, k);
            let constant = self.constant * f64::from(l == k);
            for (column, own_scale) in columns.iter().enumerate() {
                let at = pattern.own_value(index, k, column, count) - first + count * l;
                for (row, scale) in rows.iter().enumerate() {
                    let place = column * count + row;
                    let entry = d * own_rate[place] + constant * own[place];
                    values[at + row] = entry * (scale * own_scale);
                }
            }
        }
    }
}

/// Writes a block whose columns are `stride` apart.
#[inline]
fn write_block(block: &Matrix6<f64>, values: &mut [f64], stride: usize) {
    // Of a length that is known: no call for so few numbers.
    for (component, column) in block.data.0.iter().enumerate() {
        values[component * stride..][..6].copy_from_slice(column);
    }
}
