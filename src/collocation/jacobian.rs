//! The Jacobian, assembled.
//! See docs/theory.md, section 5.3.

use super::division::Share;
use super::pattern::Pattern;
use super::problem::Collocation;
use super::state::GridState;
use crate::elements::Contribution;
use crate::error::Result;
use crate::motion::DualMatrix;
use crate::system::{Placed, Workspace};
use crate::workers::parts;
use nalgebra::{Matrix6, Vector6};

/// Tangents summed over the elements, for each pair of nodes and grid point.
#[derive(Debug, Clone, Default)]
pub struct TangentBlocks {
    stiffness: Vec<Matrix6<f64>>,
    damping: Vec<Matrix6<f64>>,
    mass: Vec<Matrix6<f64>>,
    /// `∂constraint/∂λ̇` of each element with internal states, column by column.
    own_rates: Vec<f64>,
    rooms: Vec<Room>,
}

/// Scratch of one thread.
#[derive(Debug, Clone)]
struct Room {
    workspace: Workspace,
    /// `Γ_v` and `Γ_a` of a node.
    gammas: Vec<[DualMatrix; 2]>,
    /// Numbers of the pairs of nodes of one element, where they are of the share.
    numbers: Vec<Option<usize>>,
}

/// What belongs to the columns of a share.
struct Part<'a> {
    share: &'a Share,
    stiffness: &'a mut [Matrix6<f64>],
    damping: &'a mut [Matrix6<f64>],
    mass: &'a mut [Matrix6<f64>],
    /// Values in the columns of the nodes.
    values: &'a mut [f64],
    /// Number of the first pair in these columns, and position of the first value.
    first_pair: usize,
    first_value: usize,
    /// Of each element with its own unknowns here: values in their columns, and tangents with
    /// respect to their rates.
    own: Vec<Option<(&'a mut [f64], &'a mut [f64])>>,
}

impl Collocation {
    /// Writes the values of the scaled Jacobian at `state`, in the order of `pattern`.
    pub fn jacobian(
        &mut self,
        state: &GridState,
        pattern: &Pattern,
        blocks: &mut TangentBlocks,
        values: &mut [f64],
    ) -> Result<()> {
        self.update_kinematics(state);
        let points = self.grid().points();
        if points == 1 {
            // Otherwise all are written that ever are; with given rates some are not.
            values.fill(0.0);
        }
        let (system, division) = (self.system(), &self.division);
        let elements = system.elements();
        let TangentBlocks {
            stiffness,
            damping,
            mass,
            own_rates,
            rooms,
        } = blocks;
        let [stiffness, damping, mass] = [stiffness, damping, mass].map(|list| {
            list.resize(pattern.pair_count() * points, Matrix6::zeros());
            division.split_by(list, |share| {
                points * pattern.pair_numbers(share.nodes.clone()).len()
            })
        });
        let rate_counts = elements.iter().map(|placed| match placed.has_states {
            true => points * placed.element.multipliers().pow(2),
            false => 0,
        });
        own_rates.resize(rate_counts.clone().sum(), 0.0);
        let (of_nodes, of_own) = values.split_at_mut(pattern.own_values_from());
        let value_counts = (0..elements.len()).map(|index| pattern.own_values(index).len());
        let own = parts(of_own, value_counts).zip(parts(own_rates, rate_counts));
        let of_nodes = division.split_by(of_nodes, |share| {
            pattern.node_values(share.nodes.clone()).len()
        });
        let mut all: Vec<Part> = division
            .shares
            .iter()
            .zip(stiffness.into_iter().zip(damping).zip(mass))
            .zip(of_nodes.into_iter().zip(division.deal(own)))
            .map(
                |((share, ((stiffness, damping), mass)), (values, own))| Part {
                    share,
                    stiffness,
                    damping,
                    mass,
                    values,
                    first_pair: pattern.pair_numbers(share.nodes.clone()).start,
                    first_value: pattern.node_values(share.nodes.clone()).start,
                    own,
                },
            )
            .collect();
        let room = || Room {
            workspace: system.workspace(true),
            gammas: Vec::new(),
            numbers: Vec::new(),
        };
        division
            .workers
            .try_for_each(&mut all, rooms, room, |room, _, part| {
                self.sum_elements(state, pattern, part, room)?;
                for node in part.share.nodes.clone() {
                    division.workers.pulse()?;
                    self.write_node_columns(node, pattern, part, &mut room.gammas);
                }
                Ok(())
            })?;
        self.add_compliance(pattern, values);
        Ok(())
    }

    /// Scales rows and columns.
    pub(super) fn scale(&self, pattern: &Pattern, values: &mut [f64]) {
        let scaled_columns = pattern.column_pointers().windows(2).zip(&self.column_scale);
        for (range, column_scale) in scaled_columns {
            let rows = &pattern.row_indices()[range[0]..range[1]];
            for (value, &row) in values[range[0]..range[1]].iter_mut().zip(rows) {
                *value *= column_scale * self.row_scale[row];
            }
        }
    }

    /// Writes the compliance of constraints that may depend on each other into a scaled matrix.
    pub(super) fn add_compliance(&self, pattern: &Pattern, values: &mut [f64]) {
        if self.regularisation != 0.0 {
            for (index, placed) in self.system().elements().iter().enumerate() {
                let count = placed.element.multipliers();
                if placed.has_states {
                    continue;
                }
                for k in 0..self.grid().points() {
                    for row in 0..count {
                        values[pattern.own_value(index, k, row, count)] = -self.regularisation;
                    }
                }
            }
        }
    }

    /// Sums tangents over the elements of a share; writes those of constraints straight into the
    /// values.
    fn sum_elements(
        &self,
        state: &GridState,
        pattern: &Pattern,
        part: &mut Part,
        room: &mut Room,
    ) -> Result<()> {
        let points = self.grid().points();
        let share = part.share;
        for list in [&mut part.stiffness, &mut part.damping, &mut part.mass] {
            list.fill(Matrix6::zeros());
        }
        for (i, &index) in share.elements.iter().enumerate() {
            self.division.workers.pulse()?;
            let placed = &self.system().elements()[index];
            let nodes = placed.element.nodes();
            let count = placed.element.multipliers();
            let has_mass = placed.element.has_mass();
            let is_elastic = self.rule.is_elastic(has_mass);
            let has_damping = placed.element.has_damping() && is_elastic;
            // Rates of internal states depend neither on accelerations nor exert forces.
            let alone = placed.has_states && self.rule.holds_states();
            room.numbers.clear();
            for row in nodes {
                for column in nodes {
                    let here = share.nodes.contains(column);
                    let number = here.then(|| pattern.pair_number(*row, *column) - part.first_pair);
                    room.numbers.push(number);
                }
            }
            for k in 0..points {
                let workspace = &mut room.workspace;
                let contribution = self.instants.evaluate(placed, k, state, workspace)?;
                for (place, number) in room.numbers.iter().enumerate() {
                    let Some(number) = number else {
                        continue;
                    };
                    let at = number * points + k;
                    let (i, j) = (6 * (place / nodes.len()), 6 * (place % nodes.len()));
                    if is_elastic {
                        part.stiffness[at] += contribution.stiffness.fixed_view::<6, 6>(i, j);
                    }
                    if has_damping {
                        part.damping[at] += contribution.damping.fixed_view::<6, 6>(i, j);
                    }
                    if has_mass {
                        part.mass[at] += contribution.mass.fixed_view::<6, 6>(i, j);
                    }
                }
                if count == 0 {
                    continue;
                }
                if !alone {
                    let at = (index, placed, k);
                    self.write_constraint(pattern, at, contribution, part);
                }
                if let Some((values, rates)) = &mut part.own[i] {
                    let at = (index, placed, k);
                    self.write_own(pattern, at, contribution, values);
                    if placed.has_states {
                        let own_rate = contribution.own_rate.as_slice();
                        rates[own_rate.len() * k..][..own_rate.len()].copy_from_slice(own_rate);
                    }
                }
            }
        }
        Ok(())
    }

    /// Scales of the rows and columns of an element's own unknowns at grid point `k`.
    fn own_scales(&self, placed: &Placed, k: usize) -> (&[f64], &[f64]) {
        let points = self.grid().points();
        let count = placed.element.multipliers();
        let first =
            6 * points * self.system().nodes() + placed.first_multiplier * points + count * k;
        (
            &self.row_scale[first..first + count],
            &self.column_scale[first..first + count],
        )
    }

    /// Writes an element's own rows at grid point `k` in the columns of a share's nodes.
    fn write_constraint(
        &self,
        pattern: &Pattern,
        (index, placed, k): (usize, &Placed, usize),
        contribution: &Contribution,
        part: &mut Part,
    ) {
        let (rows, _) = self.own_scales(placed, k);
        for (local, &node) in placed.element.nodes().iter().enumerate() {
            if !part.share.nodes.contains(&node) {
                continue;
            }
            for component in 0..6 {
                let column = contribution.gradient.column(6 * local + component);
                let first = pattern.constraint_value(index, local, node, k, component);
                let values = part.values[first - part.first_value..].iter_mut();
                for ((value, entry), row) in values.zip(column.iter()).zip(rows) {
                    *value = entry * row * self.column_scale[component];
                }
            }
        }
    }

    /// Writes the columns of an element's own unknowns at grid point `k`; of internal states, which
    /// are of one grid point and all others, their rows instead.
    fn write_own(
        &self,
        pattern: &Pattern,
        (index, placed, k): (usize, &Placed, usize),
        contribution: &Contribution,
        values: &mut [f64],
    ) {
        let points = self.grid().points();
        let first_value = pattern.own_values(index).start;
        let count = placed.element.multipliers();
        let (rows, columns) = self.own_scales(placed, k);
        let alone = placed.has_states && self.rule.holds_states();
        let coupled = if alone {
            0
        } else {
            placed.element.nodes().len()
        };
        for local in 0..coupled {
            for (row, own_scale) in columns.iter().enumerate() {
                let first = pattern.force_value(index, local, k, row, count) - first_value;
                for component in 0..6 {
                    values[first + component] = contribution.gradient[(row, 6 * local + component)]
                        * self.row_scale[component]
                        * own_scale;
                }
            }
        }
        if placed.has_states {
            // Row ℓ is that of this grid point: ∂/∂λ_k + δ_ℓk, and D_ℓk times ∂/∂λ̇_ℓ.
            for (column, own_scale) in columns.iter().enumerate() {
                for other in 0..points {
                    let d = self.rule.rate_weight(0, k, other);
                    let first =
                        pattern.own_value(index, other, column, count) - first_value + count * k;
                    for row in 0..count {
                        let mut entry = d * contribution.own_rate[(row, column)];
                        if other == k && !alone {
                            entry += contribution.own[(row, column)];
                        }
                        values[first + row] = entry * rows[row] * own_scale;
                    }
                }
            }
        }
    }

    /// Writes the columns of one node: `M Γ_a + C Γ_v`, and `K` on the diagonal in time.
    fn write_node_columns(
        &self,
        column: usize,
        pattern: &Pattern,
        part: &mut Part,
        gammas: &mut Vec<[DualMatrix; 2]>,
    ) {
        let points = self.grid().points();
        // Those of all nodes are the same.
        let scale = Matrix6::from_fn(|i, j| self.row_scale[i] * self.column_scale[j]);
        let any_dense = pattern.pairs(column).any(|(_, pair)| pair.dense);
        if any_dense {
            gammas.clear();
            for k in 0..points {
                for l in 0..points {
                    gammas.push(self.rule.tangent(column, 0, l, k));
                }
            }
        }
        for (number, pair) in pattern.pairs(column) {
            for k in 0..points {
                let at = (number - part.first_pair) * points;
                if pair.dense {
                    for l in 0..points {
                        let [gamma_v, gamma_a] = &gammas[k * points + l];
                        let mut block = Matrix6::zeros();
                        gamma_a.add_product_to(&part.mass[at + l], &mut block);
                        gamma_v.add_product_to(&part.damping[at + l], &mut block);
                        if l == k {
                            block += part.stiffness[at + l];
                        }
                        block.component_mul_assign(&scale);
                        for component in 0..6 {
                            let first = pattern.pair_value(column, pair, k, component)
                                - part.first_value
                                + 6 * l;
                            part.values[first..first + 6]
                                .copy_from_slice(block.column(component).as_slice());
                        }
                    }
                } else {
                    let block = part.stiffness[at + k].component_mul(&scale);
                    for component in 0..6 {
                        let first =
                            pattern.pair_value(column, pair, k, component) - part.first_value;
                        part.values[first..first + 6]
                            .copy_from_slice(block.column(component).as_slice());
                    }
                }
            }
        }
    }
}

impl Collocation {
    /// Writes, for a grid of one point, the scaled change of a residual with velocities and
    /// accelerations of the nodes and rates of internal states; `blocks` are those of the last
    /// Jacobian.
    pub fn rate_forces(
        &self,
        pattern: &Pattern,
        blocks: &TangentBlocks,
        nodes: &[[Vector6<f64>; 2]],
        rates: &[f64],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        for (column, [velocity, acceleration]) in nodes.iter().enumerate() {
            for (number, pair) in pattern.pairs(column) {
                if !pair.dense {
                    continue;
                }
                let force = blocks.mass[number] * acceleration + blocks.damping[number] * velocity;
                let rows = &mut out[6 * pair.row..][..6];
                rows.iter_mut().zip(&force).for_each(|(row, f)| *row += f);
            }
        }
        let first = 6 * nodes.len();
        let mut own_rates = blocks.own_rates.iter();
        for placed in self.system().elements().iter().filter(|p| p.has_states) {
            let range =
                placed.first_multiplier..placed.first_multiplier + placed.element.multipliers();
            for rate in &rates[range.clone()] {
                for (place, own_rate) in range.clone().zip(&mut own_rates) {
                    out[first + place] += own_rate * rate;
                }
            }
        }
        for (value, scale) in out.iter_mut().zip(&self.row_scale) {
            *value *= scale;
        }
    }
}
