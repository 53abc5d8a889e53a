//! The Jacobian of eq. (37) applied without being formed: tangents of the elements at each grid point, and
//! `Γ_v`, `Γ_a` by FFT. `O(n N log N)` time, `O(n N)` memory.

use super::kinematics::VariationScratch;
use super::problem::{Collocation, Instants};
use super::state::GridState;
use crate::error::Result;
use crate::fourier::Differentiation;
use crate::system::{System, Workspace};
use nalgebra::{Matrix6, Vector6};
use std::collections::BTreeMap;

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

/// Where an element's tangents go.
#[derive(Debug, Clone)]
struct ElementPlace {
    /// Coupling of each pair of its nodes, row by row.
    couplings: Vec<usize>,
    /// First number of its gradient at a grid point.
    gradient: usize,
    /// First number of its own tangents at a grid point.
    own: usize,
}

/// Which tangents there are, for all grid points.
#[derive(Debug, Clone)]
pub struct TangentLayout {
    couplings: Vec<Coupling>,
    places: Vec<ElementPlace>,
    gradients: usize,
    own: usize,
}

impl TangentLayout {
    /// That of a system.
    pub fn new(system: &System) -> Self {
        let mut numbers: BTreeMap<(usize, usize), bool> = BTreeMap::new();
        for placed in system.elements() {
            let element = &placed.element;
            let moving = element.has_mass() || element.has_damping();
            for &row in element.nodes() {
                for &column in element.nodes() {
                    *numbers.entry((row, column)).or_insert(false) |= moving;
                }
            }
        }
        let couplings: Vec<Coupling> = numbers
            .into_iter()
            .map(|((row, column), moving)| Coupling {
                row,
                column,
                moving,
            })
            .collect();
        let number = |row: usize, column: usize| {
            couplings.partition_point(|c| (c.row, c.column) < (row, column))
        };
        let (mut gradients, mut own) = (0, 0);
        let places = system
            .elements()
            .iter()
            .map(|placed| {
                let nodes = placed.element.nodes();
                let count = placed.element.multipliers();
                let place = ElementPlace {
                    couplings: nodes
                        .iter()
                        .flat_map(|&row| nodes.iter().map(move |&column| (row, column)))
                        .map(|(row, column)| number(row, column))
                        .collect(),
                    gradient: gradients,
                    own,
                };
                gradients += 6 * nodes.len() * count;
                own += if placed.has_states {
                    2 * count * count
                } else {
                    0
                };
                place
            })
            .collect();
        TangentLayout {
            couplings,
            places,
            gradients,
            own,
        }
    }

    /// The pairs of coupled nodes, in the order of rows and then of columns.
    pub fn couplings(&self) -> &[Coupling] {
        &self.couplings
    }
}

/// `∂force/∂u`, `∂force/∂V` and `∂force/∂V̇` of one coupling at one grid point.
#[derive(Debug, Clone, Copy, Default)]
pub struct PairTangent {
    /// `K`.
    pub stiffness: Matrix6<f64>,
    /// `C`.
    pub damping: Matrix6<f64>,
    /// `M`.
    pub mass: Matrix6<f64>,
}

/// Tangents of own unknowns at one grid point.
#[derive(Debug, Clone)]
struct OwnTangent {
    /// `∂constraint/∂u` of each element with own unknowns, column by column.
    gradients: Vec<f64>,
    /// `∂constraint/∂λ` and then `∂constraint/∂λ̇` of each element with internal states.
    own: Vec<f64>,
}

/// The Jacobian at one state, as an operator.
#[derive(Debug)]
pub struct Tangent {
    layout: TangentLayout,
    points: usize,
    /// Coupling `p` at grid point `k`, at `p N + k`.
    pairs: Vec<PairTangent>,
    own: Vec<OwnTangent>,
    /// Unscaled unknowns.
    x: Vec<f64>,
    /// Changes of velocity and acceleration of node `a` at grid point `k`, at `a N + k`.
    rates: Vec<[Vector6<f64>; 2]>,
    rooms: Vec<VariationRoom>,
}

/// Room of one thread.
#[derive(Debug)]
struct VariationRoom {
    operators: Differentiation,
    scratch: VariationScratch,
}

/// Grid points that each thread evaluates before their tangents are put in place.
const STAGE: usize = 16;

impl Tangent {
    /// Room for the Jacobian of a system on a grid of so many points.
    pub fn new(system: &System, points: usize) -> Self {
        let layout = TangentLayout::new(system);
        let own = OwnTangent {
            gradients: vec![0.0; layout.gradients],
            own: vec![0.0; layout.own],
        };
        Tangent {
            pairs: vec![PairTangent::default(); layout.couplings.len() * points],
            own: vec![own; points],
            points,
            x: Vec::new(),
            rates: vec![[Vector6::zeros(); 2]; points * system.nodes()],
            rooms: Vec::new(),
            layout,
        }
    }

    /// The pairs of coupled nodes.
    pub fn couplings(&self) -> &[Coupling] {
        &self.layout.couplings
    }

    /// Tangents of the coupling `pair` at grid point `k`, not scaled.
    pub fn pair(&self, pair: usize, k: usize) -> &PairTangent {
        &self.pairs[pair * self.points + k]
    }

    /// `∂constraint/∂u` of element `index` at grid point `k`, column by column, not scaled.
    pub fn gradient(&self, system: &System, index: usize, k: usize) -> &[f64] {
        let element = &system.elements()[index].element;
        let length = 6 * element.nodes().len() * element.multipliers();
        &self.own[k].gradients[self.layout.places[index].gradient..][..length]
    }

    /// `∂constraint/∂λ` and `∂constraint/∂λ̇` of element `index`, which has internal states, at grid point
    /// `k`, column by column, not scaled.
    pub fn own(&self, system: &System, index: usize, k: usize) -> (&[f64], &[f64]) {
        let count = system.elements()[index].element.multipliers();
        self.own[k].own[self.layout.places[index].own..][..2 * count * count]
            .split_at(count * count)
    }

    /// Bytes that the tangents take.
    pub fn bytes(&self) -> usize {
        let own = size_of::<f64>() * (self.layout.gradients + self.layout.own);
        size_of_val(&self.pairs[..]) + size_of_val(&self.rates[..]) + self.points * own
    }

    /// Evaluates the elements at `state`; `equations` keep their kinematics at this state until the last
    /// product.
    pub fn evaluate(&mut self, equations: &mut Collocation, state: &GridState) -> Result<()> {
        equations.update_kinematics(state);
        let points = self.points;
        let workers = equations.element_workers();
        let stage = (STAGE * workers.threads()).min(points);
        let mut staged = vec![vec![PairTangent::default(); self.layout.couplings.len()]; stage];
        let instants = &equations.instants;
        let workspace = &equations.with_tangents;
        let mut rooms = Vec::new();
        for first in (0..points).step_by(stage) {
            let count = stage.min(points - first);
            let layout = &self.layout;
            let own = self.own[first..first + count].iter_mut();
            let mut items: Vec<_> = staged.iter_mut().zip(own).collect();
            workers.try_for_each(
                &mut items,
                &mut rooms,
                || workspace.clone(),
                |workspace, i, (pairs, own)| {
                    layout.evaluate(instants, state, first + i, workspace, pairs, own)
                },
            )?;
            let mut rows: Vec<_> = self.pairs.chunks_mut(points).collect();
            equations.workers().for_each(
                &mut rows,
                &mut Vec::new(),
                || (),
                |(), pair, row| {
                    for (to, from) in row[first..first + count].iter_mut().zip(&staged) {
                        *to = from[pair];
                    }
                },
            );
        }
        Ok(())
    }

    /// Writes the product of the scaled Jacobian and `x`.
    pub fn apply(&mut self, equations: &Collocation, x: &[f64], y: &mut [f64]) {
        let system = equations.system();
        let points = self.points;
        let workers = equations.workers();
        self.x.clear();
        self.x
            .extend(x.iter().zip(&equations.column_scale).map(|(x, s)| x * s));
        let (motions, own) = self.x.split_at(6 * points * system.nodes());
        let of_node = |node: usize| &motions[6 * points * node..][..6 * points];

        let mut rates: Vec<_> = self.rates.chunks_mut(points).collect();
        workers.for_each(
            &mut rates,
            &mut self.rooms,
            || VariationRoom {
                operators: equations.operators.clone(),
                scratch: VariationScratch::default(),
            },
            |room, node, rates| {
                equations.kinematics[node].variation(
                    &mut room.operators,
                    of_node(node),
                    &mut room.scratch,
                    |l, velocity, acceleration| rates[l] = [*velocity, *acceleration],
                );
            },
        );

        let (forces, constraints) = y.split_at_mut(6 * points * system.nodes());
        let (layout, pairs, rates) = (&self.layout, &self.pairs, &self.rates);
        let mut rows: Vec<_> = forces.chunks_mut(6 * points).collect();
        workers.for_each(
            &mut rows,
            &mut Vec::new(),
            || (),
            |(), node, forces| {
                forces.fill(0.0);
                for pair in layout.couplings_of(node) {
                    let coupling = &layout.couplings[pair];
                    let rates = &rates[coupling.column * points..][..points];
                    let pairs = &pairs[pair * points..][..points];
                    let motions = of_node(coupling.column).chunks_exact(6);
                    let rows = forces.chunks_exact_mut(6);
                    for (((force, u), tangent), rates) in rows.zip(motions).zip(pairs).zip(rates) {
                        tangent.add_force(coupling.moving, u, rates, force);
                    }
                }
            },
        );
        constraints.fill(0.0);
        for (k, tangents) in self.own.iter().enumerate() {
            for (placed, place) in system.elements().iter().zip(&layout.places) {
                let count = placed.element.multipliers();
                if count == 0 {
                    continue;
                }
                let first = placed.first_multiplier * points + count * k;
                let lambda = &own[first..first + count];
                let violation = &mut constraints[first..first + count];
                let mut columns = tangents.gradients[place.gradient..].chunks_exact(count);
                for &node in placed.element.nodes() {
                    let at = 6 * (node * points + k);
                    for (component, column) in columns.by_ref().take(6).enumerate() {
                        for ((row, g), l) in violation.iter_mut().zip(column).zip(lambda) {
                            *row += g * motions[at + component];
                            forces[at + component] += g * l;
                        }
                    }
                }
            }
        }
        self.add_states(equations, constraints);
        for (y, scale) in y.iter_mut().zip(&equations.row_scale) {
            *y *= scale;
        }
        if equations.is_regularised() {
            let mut compliance = std::mem::take(&mut self.x);
            equations.compliance_of(x, &mut compliance);
            y.iter_mut().zip(&compliance).for_each(|(y, c)| *y += c);
            self.x = compliance;
        }
    }

    /// Adds what internal states and their rates change in their own equations.
    fn add_states(&self, equations: &Collocation, constraints: &mut [f64]) {
        let points = self.points;
        let system = equations.system();
        let own = &self.x[6 * points * system.nodes()..];
        let mut operators = None;
        for (placed, place) in system.elements().iter().zip(&self.layout.places) {
            if !placed.has_states {
                continue;
            }
            let operators = operators.get_or_insert_with(|| equations.operators.clone());
            let count = placed.element.multipliers();
            let mut series = [(); 3].map(|()| vec![0.0; points]);
            let [samples, d_samples, t_samples] = &mut series;
            for column in 0..count {
                let at = |k: usize| placed.first_multiplier * points + count * k;
                (0..points).for_each(|k| samples[k] = own[at(k) + column]);
                operators.apply(samples, d_samples, t_samples);
                for k in 0..points {
                    let blocks = &self.own[k].own[place.own..][..2 * count * count];
                    for row in 0..count {
                        constraints[at(k) + row] += blocks[column * count + row] * samples[k]
                            + blocks[(count + column) * count + row] * d_samples[k];
                    }
                }
            }
        }
    }
}

impl PairTangent {
    /// Adds `K Δu + C Δv + M Δv̇`.
    #[inline]
    fn add_force(&self, moving: bool, u: &[f64], rates: &[Vector6<f64>; 2], force: &mut [f64]) {
        let mut sum = self.stiffness * Vector6::from_column_slice(u);
        if moving {
            sum += self.damping * rates[0] + self.mass * rates[1];
        }
        force.iter_mut().zip(&sum).for_each(|(y, f)| *y += f);
    }
}

impl TangentLayout {
    /// Couplings of the rows of a node.
    fn couplings_of(&self, node: usize) -> std::ops::Range<usize> {
        self.couplings.partition_point(|c| c.row < node)
            ..self.couplings.partition_point(|c| c.row <= node)
    }

    /// Sums the tangents of all elements at grid point `k`.
    fn evaluate(
        &self,
        instants: &Instants,
        state: &GridState,
        k: usize,
        workspace: &mut Workspace,
        pairs: &mut [PairTangent],
        own: &mut OwnTangent,
    ) -> Result<()> {
        pairs.fill(PairTangent::default());
        for (placed, place) in instants.system().elements().iter().zip(&self.places) {
            let out = instants.evaluate(placed, k, state, workspace)?;
            let nodes = placed.element.nodes().len();
            let (mass, damping) = (placed.element.has_mass(), placed.element.has_damping());
            for a in 0..nodes {
                for b in 0..nodes {
                    let pair = &mut pairs[place.couplings[a * nodes + b]];
                    let (i, j) = (6 * a, 6 * b);
                    pair.stiffness += out.stiffness.fixed_view::<6, 6>(i, j);
                    if damping {
                        pair.damping += out.damping.fixed_view::<6, 6>(i, j);
                    }
                    if mass {
                        pair.mass += out.mass.fixed_view::<6, 6>(i, j);
                    }
                }
            }
            let gradient = out.gradient.as_slice();
            own.gradients[place.gradient..][..gradient.len()].copy_from_slice(gradient);
            if placed.has_states {
                let count = out.own.len();
                let own = &mut own.own[place.own..][..2 * count];
                own[..count].copy_from_slice(out.own.as_slice());
                own[count..].copy_from_slice(out.own_rate.as_slice());
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::{Pattern, TangentBlocks};
    use crate::fourier::TimeGrid;
    use crate::solve::test_models::moving_models;
    use std::sync::Arc;

    #[test]
    fn products_are_those_of_the_matrix() {
        for (model, period) in moving_models() {
            for points in [3, 9, 35] {
                let system = Arc::new(System::new(&model, period).unwrap());
                let grid = TimeGrid::new(points, period).unwrap();
                let mut equations = Collocation::new(system.clone(), grid).unwrap();
                let pattern = Pattern::new(&system, points);
                let wave = |i: usize| (0.37 * i as f64).sin();
                let increment: Vec<f64> = (0..equations.size())
                    .map(|i| 0.05 * wave(i) * equations.column_scale()[i])
                    .collect();
                let state =
                    GridState::reference(&system, grid).incremented(&system, &increment, 1.0);
                let mut values = vec![0.0; pattern.entries()];
                let mut blocks = TangentBlocks::default();
                equations
                    .jacobian(&state, &pattern, &mut blocks, &mut values)
                    .unwrap();
                let x: Vec<f64> = (0..pattern.size()).map(|i| wave(3 * i + 1)).collect();
                let mut expected = vec![0.0; x.len()];
                for (range, x) in pattern.column_pointers().windows(2).zip(&x) {
                    for at in range[0]..range[1] {
                        expected[pattern.row_indices()[at]] += values[at] * x;
                    }
                }
                let mut tangent = Tangent::new(&system, points);
                tangent.evaluate(&mut equations, &state).unwrap();
                let mut found = vec![0.0; x.len()];
                tangent.apply(&equations, &x, &mut found);
                let size = expected.iter().fold(0.0, |m: f64, y| m.max(y.abs()));
                for (i, (f, e)) in found.iter().zip(&expected).enumerate() {
                    let place = (i, 6 * points * system.nodes(), points);
                    assert!(
                        (f - e).abs() < 1e-12 * size,
                        "{f} {e} of {size} at {place:?}"
                    );
                }
            }
        }
    }
}
