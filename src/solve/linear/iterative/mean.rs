//! The Jacobian averaged over time in the frames of the bodies, harmonic by harmonic.

use super::block_lu::{BlockLanes, BlockPlace, BlockStructure};
use super::chunks::Chunks;
use super::constraints::Class;
use super::lanes::{ComplexLanes, LANES, Lanes};
use super::layout::Layout;
use crate::collocation::{Aliasing, AlikeMotions, Collocation, Coupling, Station, Tangent};
use crate::elements::StressLaw;
use crate::fourier::TimeGrid;
use crate::system::{Placed, System};
use crate::workers::Workers;
use nalgebra::{Complex, Matrix3, Matrix6, Vector3, Vector6};

/// Means over time of what multiplies the increments of a coupling, their first and second
/// derivatives.
#[derive(Debug, Clone, Default)]
pub(super) struct MeanTangent {
    orders: [Matrix6<f64>; 3],
    /// Of what multiplies changes of velocity.
    velocity: Matrix6<f64>,
}

impl MeanTangent {
    /// How many numbers it is.
    pub const NUMBERS: usize = 4 * 36;

    /// Its numbers.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let matrices = self.orders.iter().chain([&self.velocity]);
        matrices.flat_map(|m| m.iter().copied())
    }

    /// Of its numbers.
    pub fn of_numbers(numbers: &[f64]) -> Self {
        let matrix = |i: usize| Matrix6::from_column_slice(&numbers[36 * i..][..36]);
        MeanTangent {
            orders: [0, 1, 2].map(matrix),
            velocity: matrix(3),
        }
    }

    /// With `ΔV = Δu̇ + Ṽ Δu` and `ΔV̇ = Δü + Ṽ Δu̇ + Ṽ̇ Δu`; on a mapped grid increments are
    /// differentiated by pseudo-time.
    fn new(equations: &Collocation, tangent: &Tangent, pair: usize) -> Self {
        let points = equations.grid().points();
        let coupling = &tangent.couplings()[pair];
        let (told, _) = equations.told(&[coupling.row, coupling.column]);
        let mut orders = [Matrix6::zeros(); 3];
        let mut velocity = Matrix6::zeros();
        let slopes = equations.slopes();
        for k in 0..told {
            let t = tangent.pair(pair, k);
            orders[0] += t.stiffness;
            if coupling.moving {
                let state = &equations.node_states()[coupling.column * points + k];
                let v = twist_skew(&state.twist);
                orders[0] += t.damping * v + t.mass * twist_skew(&state.twist_rate);
                let by_pseudo = |first: Matrix6<f64>| match slopes.get(k) {
                    Some(slope) => slope.transposed(first, *t.mass),
                    None => [first, *t.mass],
                };
                let [first, second] = by_pseudo(t.damping + t.mass * v);
                orders[1] += first;
                orders[2] += second;
                velocity += by_pseudo(*t.damping)[0];
            }
        }
        MeanTangent {
            orders: orders.map(|m| m / told as f64),
            velocity: velocity / told as f64,
        }
    }
}

/// Means over time of what ties a node to the stress resultants of a station. Averaged apart, they
/// let a bent beam bend on without stretching, which the mean of their product would not.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeanStrain {
    /// `B̄`: of its transpose, forces by resultants.
    pub strain: Matrix6<f64>,
    /// Resultants by increments of the node, and by their first derivatives.
    pub orders: [Matrix6<f64>; 2],
}

impl MeanStrain {
    /// Of all strain tangents, not scaled.
    pub fn all(equations: &Collocation, tangent: &Tangent) -> Vec<Self> {
        let stations = tangent.stations();
        let mut means: Vec<Vec<MeanStrain>> = vec![Vec::new(); stations.len()];
        equations.workers().each(&mut means, |index, means| {
            let nodes = stations[index].nodes.iter().enumerate();
            means.extend(
                nodes.map(|(a, &node)| {
                    MeanStrain::new(equations, tangent, &stations[index], a, node)
                }),
            );
        });
        means.concat()
    }

    /// With `Δe = B Δu` and `Δė = B (Δu̇ + Ṽ Δu) + R Δu`.
    fn new(
        equations: &Collocation,
        tangent: &Tangent,
        station: &Station,
        local: usize,
        node: usize,
    ) -> Self {
        let points = equations.grid().points();
        let (told, _) = equations.told(&station.nodes);
        let slopes = equations.slopes();
        let mean = |first: usize| {
            let mut means = [Matrix6::zeros(); 3];
            let [strain, rate, by_pseudo] = &mut means;
            for k in 0..told {
                let t = tangent.strain(first + local, k);
                let b = t.strain.to_twist_matrix();
                *strain += b;
                *by_pseudo += b * slopes.get(k).map_or(1.0, |slope| slope.rate);
                if station.damped {
                    let state = &equations.node_states()[node * points + k];
                    *rate += b * twist_skew(&state.twist) + t.rate.to_twist_matrix();
                }
            }
            means.map(|mean| mean / told as f64)
        };
        let StressLaw {
            stiffness,
            damping,
            others,
        } = &station.law;
        let [strain, rate, by_pseudo] = mean(station.first);
        let mut orders = [stiffness * strain + damping * rate, damping * by_pseudo];
        for other in others {
            let [strain, rate, by_pseudo] = mean(station.first_of(other.offset));
            orders[0] += other.stiffness * strain + other.damping * rate;
            orders[1] += other.damping * by_pseudo;
        }
        MeanStrain { strain, orders }
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

/// Mean tangents of all couplings, scaled; where not all elements are there that act on its row, of
/// those that are.
pub(super) fn scaled_means(
    equations: &Collocation,
    tangent: &Tangent,
    strains: &[MeanStrain],
) -> Vec<MeanTangent> {
    let couplings = tangent.couplings();
    let mut means = vec![MeanTangent::default(); couplings.len()];
    equations.workers().each(&mut means, |pair, mean| {
        *mean = MeanTangent::new(equations, tangent, pair)
    });
    for station in tangent.stations() {
        let count = station.nodes.len();
        let strains = &strains[station.first..][..count];
        for (a, row) in strains.iter().enumerate() {
            for (b, column) in strains.iter().enumerate() {
                let mean = &mut means[station.couplings[a * count + b]];
                for (order, resultant) in mean.orders.iter_mut().zip(&column.orders) {
                    *order += row.strain.tr_mul(resultant);
                }
                mean.velocity += row.strain.tr_mul(&column.orders[1]);
            }
        }
    }
    for (mean, coupling) in means.iter_mut().zip(couplings) {
        let row_scale = &equations.row_scale()[equations.layout().motion(coupling.row, 0)];
        let column_scale = &equations.column_scale()[equations.layout().motion(coupling.column, 0)];
        for order in mean.orders.iter_mut().chain([&mut mean.velocity]) {
            *order = order.map_with_location(|i, j, x| x * row_scale[i] * column_scale[j]);
        }
    }
    means
}

/// Means of the scaled own tangents of each element, and of those of rates, column by column; none
/// of elements without internal states.
pub(super) fn own_means(equations: &Collocation, tangent: &Tangent) -> Vec<[Vec<f64>; 2]> {
    let system = equations.system();
    let points = equations.grid().points();
    let of_element = |(index, placed): (usize, &Placed)| {
        if !placed.has_states {
            return [Vec::new(), Vec::new()];
        }
        let count = placed.element.own_unknowns();
        let first = equations.layout().element(placed).start;
        let mut means = [vec![0.0; count * count], vec![0.0; count * count]];
        let slopes = equations.slopes();
        for k in 0..points {
            let (own, own_rate) = tangent.own(system, index, k);
            let by_pseudo = slopes.get(k).map_or(1.0, |slope| slope.rate);
            for (mean, (values, factor)) in
                means.iter_mut().zip([(own, 1.0), (own_rate, by_pseudo)])
            {
                let pairs = mean.iter_mut().zip(values);
                pairs.for_each(|(m, v)| *m += v * factor / points as f64);
            }
        }
        for mean in &mut means {
            for column in 0..count {
                for row in 0..count {
                    mean[column * count + row] *= equations.row_scale()[first + row]
                        * equations.column_scale()[first + column];
                }
            }
        }
        means
    };
    system
        .elements()
        .iter()
        .enumerate()
        .map(of_element)
        .collect()
}

/// Everything that the averaged matrices are made of.
pub(super) struct Averages<'a> {
    pub system: &'a System,
    pub grid: TimeGrid,
    pub couplings: &'a [Coupling],
    pub layout: &'a Layout,
    pub classes: &'a [Class],
    /// Of each coupling, scaled.
    pub means: &'a [MeanTangent],
    /// Of the own tangents of each element, see [`own_means`].
    pub own: &'a [[Vec<f64>; 2]],
    /// Of each node, scaled.
    pub aliasing: &'a [Vec<Aliasing>],
    /// Scaled compliance of constraints.
    pub compliance: f64,
    /// How hub and supports have to move, if these are averages of one blade.
    pub alike: Option<&'a AlikeMotions>,
    /// Whether the matrices are to be those of the transposed equations, which are the conjugate
    /// transposes: transposition turns time back.
    pub transposed: bool,
    pub workers: &'a Workers,
}

impl Averages<'_> {
    /// Factors of these harmonics; none if one is singular.
    pub fn factor(&self, harmonics: &Chunks) -> Option<Vec<BlockLanes<ComplexLanes>>> {
        let highest_of_grid = self.grid.harmonics();
        let frequency = self.grid.frequency();
        let mut all: Vec<Option<BlockLanes<ComplexLanes>>> = vec![None; harmonics.count()];
        // Harmonics that are aliased, of any node.
        let highest = self.aliasing.iter().map(Vec::len).max().unwrap_or(0);
        let projections = self.projections();
        self.workers.each(&mut all, |chunk, place| {
            let structure = self.layout.structure_of(harmonics.is_whole(chunk));
            let mut lanes = BlockLanes::new(structure, harmonics.used(chunk));
            let harmonic = |lane: usize| harmonics.harmonic(chunk, lane);
            let rates = std::array::from_fn(|lane| harmonic(lane) as f64 * frequency);
            self.fill((structure, &mut lanes), &rates);
            for lane in 0..LANES {
                let below = highest_of_grid - harmonic(lane);
                if below < highest {
                    self.add_aliasing((structure, &mut lanes), lane, below);
                }
            }
            if let Some(projections) = &projections {
                let harmonics = std::array::from_fn(harmonic);
                self.project(projections, (structure, &mut lanes), &harmonics);
            }
            if lanes.factor(structure, self.workers) {
                *place = Some(lanes);
            }
        });
        all.into_iter().collect()
    }

    /// Where a coupling stands in the matrices, if it does.
    pub(super) fn place(
        &self,
        structure: &BlockStructure,
        coupling: &Coupling,
    ) -> Option<BlockPlace> {
        let at = |node: usize| self.layout.node_at[node];
        match self.transposed {
            false => structure.find(at(coupling.row), at(coupling.column)),
            true => structure.find(at(coupling.column), at(coupling.row)),
        }
    }

    /// Where an entry of what is not transposed stands in a block.
    fn entry(&self, place: BlockPlace, i: usize, j: usize) -> usize {
        match self.transposed {
            false => place.entry(i, j),
            true => place.entry(j, i),
        }
    }

    /// What stands there.
    fn value(&self, x: Complex<f64>) -> Complex<f64> {
        if self.transposed { x.conj() } else { x }
    }

    /// Writes the matrices of harmonics with these circular frequencies.
    fn fill(
        &self,
        (structure, lanes): (&BlockStructure, &mut BlockLanes<ComplexLanes>),
        rates: &[f64; LANES],
    ) {
        let node_at = &self.layout.node_at;
        for (mean, coupling) in self.means.iter().zip(self.couplings) {
            let Some(place) = self.place(structure, coupling) else {
                continue;
            };
            let [stiffness, damping, mass] = &mean.orders;
            for i in 0..6 {
                for j in 0..6 {
                    let (k, c, m) = (stiffness[(i, j)], damping[(i, j)], mass[(i, j)]);
                    lanes.at(self.entry(place, i, j)).add(|lane| {
                        let rate = rates[lane];
                        self.value(Complex::new(k - rate * rate * m, rate * c))
                    });
                }
            }
        }
        for (index, (class, placed)) in self.classes.iter().zip(self.system.elements()).enumerate()
        {
            let Class::Averaged(average) = class else {
                continue;
            };
            let count = placed.element.own_unknowns();
            let own = self.layout.own_at[index];
            if count == 0 || structure.leaves_out(own.0) {
                continue;
            }
            let own_place = structure.block_at(own, own);
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                let places = structure.find(own, node_at[node]);
                let places = places.zip(structure.find(node_at[node], own));
                let Some((below, beside)) = places else {
                    continue;
                };
                for row in 0..count {
                    for component in 0..6 {
                        let at = (row, 6 * local + component);
                        let g = Complex::from(average.gradient[at]);
                        let (by_rate, effect) = match &average.feedback {
                            None => (0.0, g),
                            Some(of) => (of.velocity[at], Complex::from(of.effect[at])),
                        };
                        let entry = lanes.at(below.entry(row, component));
                        entry.add(|lane| g + Complex::new(0.0, rates[lane] * by_rate));
                        lanes.at(beside.entry(component, row)).add(|_| effect);
                    }
                }
            }
            if placed.has_states {
                let [stiffness, damping] = &self.own[index];
                for row in 0..count {
                    for column in 0..count {
                        let at = column * count + row;
                        lanes.at(self.entry(own_place, row, column)).add(|lane| {
                            self.value(Complex::new(stiffness[at], rates[lane] * damping[at]))
                        });
                    }
                }
            } else {
                let compliant = Complex::from(-self.compliance);
                (0..count).for_each(|i| lanes.at(own_place.entry(i, i)).add(|_| compliant));
            }
        }
    }

    /// Adds what the grid makes of the harmonic so many below the highest.
    fn add_aliasing(
        &self,
        (structure, lanes): (&BlockStructure, &mut BlockLanes<ComplexLanes>),
        lane: usize,
        below: usize,
    ) {
        for (mean, coupling) in self.means.iter().zip(self.couplings) {
            let aliasing = self.aliasing[coupling.column].get(below);
            let Some((aliasing, place)) = aliasing.zip(self.place(structure, coupling)) else {
                continue;
            };
            let complex = |m: &Matrix6<f64>| m.map(Complex::from);
            let change = complex(&mean.velocity) * aliasing.velocity
                + complex(&mean.orders[2]) * aliasing.acceleration;
            for i in 0..6 {
                for j in 0..6 {
                    let entry = lanes.at(self.entry(place, i, j));
                    entry.set(lane, entry.get(lane) + self.value(change[(i, j)]));
                }
            }
        }
    }
}
