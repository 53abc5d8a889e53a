//! The Jacobian of eq. (37) applied without being formed: tangents of the elements at each grid point, and
//! `Γ_v`, `Γ_a` by FFT. `O(n N log N)` time, `O(n N)` memory.

use super::kinematics::VariationScratch;
use super::problem::Collocation;
use super::state::GridState;
use crate::error::Result;
use crate::system::System;
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

/// All tangents at one grid point.
#[derive(Debug, Clone)]
struct PointTangent {
    pairs: Vec<PairTangent>,
    /// `∂constraint/∂u` of each element with own unknowns, column by column.
    gradients: Vec<f64>,
    /// `∂constraint/∂λ` and then `∂constraint/∂λ̇` of each element with internal states.
    own: Vec<f64>,
}

/// The Jacobian at one state, as an operator.
#[derive(Debug)]
pub struct Tangent {
    layout: TangentLayout,
    points: Vec<PointTangent>,
    scratch: Scratch,
}

/// Room for products.
#[derive(Debug, Default)]
struct Scratch {
    /// Unscaled unknowns.
    x: Vec<f64>,
    /// Changes of velocity and acceleration of node `a` at grid point `k`, at `a N + k`.
    rates: Vec<[Vector6<f64>; 2]>,
    variation: VariationScratch,
    series: [Vec<f64>; 3],
}

impl Tangent {
    /// Room for the Jacobian of a system on a grid of so many points.
    pub fn new(system: &System, points: usize) -> Self {
        let layout = TangentLayout::new(system);
        let point = PointTangent {
            pairs: vec![PairTangent::default(); layout.couplings.len()],
            gradients: vec![0.0; layout.gradients],
            own: vec![0.0; layout.own],
        };
        Tangent {
            points: vec![point; points],
            layout,
            scratch: Scratch::default(),
        }
    }

    /// The pairs of coupled nodes.
    pub fn couplings(&self) -> &[Coupling] {
        &self.layout.couplings
    }

    /// Tangents of the coupling `pair` at grid point `k`, not scaled.
    pub fn pair(&self, pair: usize, k: usize) -> &PairTangent {
        &self.points[k].pairs[pair]
    }

    /// `∂constraint/∂u` of element `index` at grid point `k`, column by column, not scaled.
    pub fn gradient(&self, system: &System, index: usize, k: usize) -> &[f64] {
        let element = &system.elements()[index].element;
        let length = 6 * element.nodes().len() * element.multipliers();
        &self.points[k].gradients[self.layout.places[index].gradient..][..length]
    }

    /// `∂constraint/∂λ` and `∂constraint/∂λ̇` of element `index`, which has internal states, at grid point
    /// `k`, column by column, not scaled.
    pub fn own(&self, system: &System, index: usize, k: usize) -> (&[f64], &[f64]) {
        let count = system.elements()[index].element.multipliers();
        self.points[k].own[self.layout.places[index].own..][..2 * count * count]
            .split_at(count * count)
    }

    /// Bytes that the tangents take.
    pub fn bytes(&self) -> usize {
        let pairs = size_of::<PairTangent>() * self.layout.couplings.len();
        let numbers = size_of::<f64>() * (self.layout.gradients + self.layout.own);
        self.points.len() * (pairs + numbers)
    }

    /// Evaluates the elements at `state`; `equations` keep their kinematics at this state until the last
    /// product.
    pub fn evaluate(&mut self, equations: &mut Collocation, state: &GridState) -> Result<()> {
        equations.update_kinematics(state);
        let system = equations.system().clone();
        for (k, point) in self.points.iter_mut().enumerate() {
            point.pairs.fill(PairTangent::default());
            for (placed, place) in system.elements().iter().zip(&self.layout.places) {
                let workspace = &mut equations.with_tangents;
                let out = equations.instants.evaluate(placed, k, state, workspace)?;
                let nodes = placed.element.nodes().len();
                let (mass, damping) = (placed.element.has_mass(), placed.element.has_damping());
                for a in 0..nodes {
                    for b in 0..nodes {
                        let pair = &mut point.pairs[place.couplings[a * nodes + b]];
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
                point.gradients[place.gradient..][..gradient.len()].copy_from_slice(gradient);
                if placed.has_states {
                    let count = out.own.len();
                    let own = &mut point.own[place.own..][..2 * count];
                    own[..count].copy_from_slice(out.own.as_slice());
                    own[count..].copy_from_slice(out.own_rate.as_slice());
                }
            }
        }
        Ok(())
    }

    /// Writes the product of the scaled Jacobian and `x`.
    pub fn apply(&mut self, equations: &mut Collocation, x: &[f64], y: &mut [f64]) {
        let system = equations.system().clone();
        let points = self.points.len();
        let Scratch {
            x: unscaled,
            rates,
            variation,
            series,
        } = &mut self.scratch;
        unscaled.clear();
        unscaled.extend(x.iter().zip(&equations.column_scale).map(|(x, s)| x * s));
        let (motions, own) = unscaled.split_at(6 * points * system.nodes());
        rates.resize(points * system.nodes(), [Vector6::zeros(); 2]);
        for (node, kinematics) in equations.kinematics.iter().enumerate() {
            let rates = &mut rates[node * points..][..points];
            kinematics.variation(
                &mut equations.operators,
                &motions[6 * points * node..][..6 * points],
                variation,
                |l, velocity, acceleration| rates[l] = [*velocity, *acceleration],
            );
        }

        y.fill(0.0);
        let (forces, constraints) = y.split_at_mut(6 * points * system.nodes());
        for (k, point) in self.points.iter().enumerate() {
            for (coupling, pair) in self.layout.couplings.iter().zip(&point.pairs) {
                let at = coupling.column * points + k;
                let u = Vector6::from_column_slice(&motions[6 * at..][..6]);
                let mut force = pair.stiffness * u;
                if coupling.moving {
                    let [velocity, acceleration] = &rates[at];
                    force += pair.damping * velocity + pair.mass * acceleration;
                }
                let rows = &mut forces[6 * (coupling.row * points + k)..][..6];
                rows.iter_mut().zip(&force).for_each(|(y, f)| *y += f);
            }
            for (placed, place) in system.elements().iter().zip(&self.layout.places) {
                let count = placed.element.multipliers();
                let first = placed.first_multiplier * points + count * k;
                let lambda = &own[first..first + count];
                let violation = &mut constraints[first..first + count];
                let mut columns = point.gradients[place.gradient..].chunks_exact(count.max(1));
                for &node in placed.element.nodes().iter().filter(|_| count > 0) {
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
        for (placed, place) in system.elements().iter().zip(&self.layout.places) {
            if !placed.has_states {
                continue;
            }
            let count = placed.element.multipliers();
            let [samples, d_samples, t_samples] = series;
            for column in 0..count {
                let at = |k: usize| placed.first_multiplier * points + count * k;
                samples.clear();
                samples.extend((0..points).map(|k| own[at(k) + column]));
                d_samples.resize(points, 0.0);
                t_samples.resize(points, 0.0);
                equations.operators.apply(samples, d_samples, t_samples);
                for k in 0..points {
                    let blocks = &self.points[k].own[place.own..][..2 * count * count];
                    for row in 0..count {
                        constraints[at(k) + row] += blocks[column * count + row] * samples[k]
                            + blocks[(count + column) * count + row] * d_samples[k];
                    }
                }
            }
        }
        for (y, scale) in y.iter_mut().zip(&equations.row_scale) {
            *y *= scale;
        }
        if equations.is_regularised() {
            let mut compliance = std::mem::take(&mut self.scratch.x);
            equations.compliance_of(x, &mut compliance);
            y.iter_mut().zip(&compliance).for_each(|(y, c)| *y += c);
            self.scratch.x = compliance;
        }
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
                tangent.apply(&mut equations, &x, &mut found);
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
