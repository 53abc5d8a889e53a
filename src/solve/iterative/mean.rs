//! The Jacobian averaged over time in the frames of the bodies, harmonic by harmonic.

use super::block_lu::BlockLanes;
use super::constraints::Class;
use super::lanes::{ComplexLanes, LANES, Lanes};
use super::layout::{Layout, own_first};
use crate::collocation::{Collocation, Tangent};
use nalgebra::{Complex, Matrix3, Matrix6, Vector3, Vector6};

/// Means over time of what multiplies the increments of a coupling, their first and second derivatives.
struct MeanTangent {
    orders: [Matrix6<f64>; 3],
}

impl MeanTangent {
    /// With `ΔV = Δu̇ + Ṽ Δu` and `ΔV̇ = Δü + Ṽ Δu̇ + Ṽ̇ Δu`.
    fn new(equations: &Collocation, tangent: &Tangent, pair: usize) -> Self {
        let points = equations.grid().points();
        let coupling = &tangent.couplings()[pair];
        let mut orders = [Matrix6::zeros(); 3];
        for k in 0..points {
            let t = tangent.pair(pair, k);
            orders[0] += t.stiffness;
            if coupling.moving {
                let state = &equations.node_states()[coupling.column * points + k];
                let v = twist_skew(&state.twist);
                orders[0] += t.damping * v + t.mass * twist_skew(&state.twist_rate);
                orders[1] += t.damping + t.mass * v;
                orders[2] += t.mass;
            }
        }
        MeanTangent {
            orders: orders.map(|m| m / points as f64),
        }
    }
}

/// `Ṽ = [ω̃ ṽ; 0 ω̃]`.
fn twist_skew(twist: &Vector6<f64>) -> Matrix6<f64> {
    let skew = |first: usize| -> Matrix3<f64> {
        Vector3::new(twist[first], twist[first + 1], twist[first + 2]).cross_matrix()
    };
    let (v, w) = (skew(0), skew(3));
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).copy_from(&w);
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(&v);
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(&w);
    m
}

/// Everything that the averaged matrices are made of.
pub(super) struct Averages<'a> {
    pub equations: &'a Collocation,
    pub tangent: &'a Tangent,
    pub layout: &'a Layout,
    pub classes: &'a [Class],
}

impl Averages<'_> {
    /// Factors of all harmonics; none if one is singular.
    pub fn factor(&self) -> Option<Vec<BlockLanes<ComplexLanes>>> {
        let points = self.equations.grid().points();
        let frequency = self.equations.grid().frequency();
        let means: Vec<MeanTangent> = (0..self.tangent.couplings().len())
            .map(|pair| self.scaled_mean(pair))
            .collect();
        let chunks = (points / 2 + 1).div_ceil(LANES);
        let mut all: Vec<Option<BlockLanes<ComplexLanes>>> = vec![None; chunks];
        let nothing = &mut Vec::new();
        self.equations.workers().for_each(
            &mut all,
            nothing,
            || (),
            |(), chunk, place| {
                let mut lanes = BlockLanes::<ComplexLanes>::new(&self.layout.structure);
                for lane in 0..LANES {
                    let j = (LANES * chunk + lane).min(points / 2);
                    self.fill(&mut lanes, lane, j as f64 * frequency, &means);
                }
                if lanes.factor(&self.layout.structure) {
                    *place = Some(lanes);
                }
            },
        );
        all.into_iter().collect()
    }

    /// Mean tangent, scaled.
    fn scaled_mean(&self, pair: usize) -> MeanTangent {
        let points = self.equations.grid().points();
        let coupling = &self.tangent.couplings()[pair];
        let row_scale = &self.equations.row_scale()[6 * points * coupling.row..][..6];
        let column_scale = &self.equations.column_scale()[6 * points * coupling.column..][..6];
        let mean = MeanTangent::new(self.equations, self.tangent, pair);
        MeanTangent {
            orders: mean
                .orders
                .map(|m| m.map_with_location(|i, j, x| x * row_scale[i] * column_scale[j])),
        }
    }

    /// Writes the matrix of one harmonic, of circular frequency `rate`.
    fn fill(
        &self,
        lanes: &mut BlockLanes<ComplexLanes>,
        lane: usize,
        rate: f64,
        means: &[MeanTangent],
    ) {
        let mut add = |at: ((usize, usize), (usize, usize)), (i, j), value: Complex<f64>| {
            let ((row, first_row), (column, first_column)) = at;
            let place = self
                .layout
                .structure
                .entry((row, column), (first_row + i, first_column + j));
            let entry = lanes.at(place);
            entry.set(lane, entry.get(lane) + value);
        };
        for (mean, coupling) in means.iter().zip(self.tangent.couplings()) {
            let at = (
                self.layout.node_at[coupling.row],
                self.layout.node_at[coupling.column],
            );
            let [stiffness, damping, mass] = &mean.orders;
            for i in 0..6 {
                for j in 0..6 {
                    let re = stiffness[(i, j)] - rate * rate * mass[(i, j)];
                    add(at, (i, j), Complex::new(re, rate * damping[(i, j)]));
                }
            }
        }
        let system = self.equations.system();
        for (index, (class, placed)) in self.classes.iter().zip(system.elements()).enumerate() {
            let Class::Averaged(average) = class else {
                continue;
            };
            let own = self.layout.own_at[index];
            let count = placed.element.multipliers();
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                for row in 0..count {
                    for component in 0..6 {
                        let g = Complex::from(average.gradient[(row, 6 * local + component)]);
                        add((own, self.layout.node_at[node]), (row, component), g);
                        add((self.layout.node_at[node], own), (component, row), g);
                    }
                }
            }
            if placed.has_states {
                let (stiffness, damping) = self.own_means(index);
                for row in 0..count {
                    for column in 0..count {
                        let at = column * count + row;
                        let value = Complex::new(stiffness[at], rate * damping[at]);
                        add((own, own), (row, column), value);
                    }
                }
            } else {
                let compliant = Complex::from(-self.equations.regularisation());
                (0..count).for_each(|i| add((own, own), (i, i), compliant));
            }
        }
    }

    /// Means of the scaled own tangents of an element with internal states.
    fn own_means(&self, index: usize) -> (Vec<f64>, Vec<f64>) {
        let system = self.equations.system();
        let points = self.equations.grid().points();
        let placed = &system.elements()[index];
        let count = placed.element.multipliers();
        let first = own_first(self.equations, index);
        let mut means = [vec![0.0; count * count], vec![0.0; count * count]];
        for k in 0..points {
            let (own, own_rate) = self.tangent.own(system, index, k);
            for (mean, values) in means.iter_mut().zip([own, own_rate]) {
                mean.iter_mut()
                    .zip(values)
                    .for_each(|(m, v)| *m += v / points as f64);
            }
        }
        for mean in &mut means {
            for column in 0..count {
                for row in 0..count {
                    mean[column * count + row] *= self.equations.row_scale()[first + row]
                        * self.equations.column_scale()[first + column];
                }
            }
        }
        let [own, own_rate] = means;
        (own, own_rate)
    }
}
