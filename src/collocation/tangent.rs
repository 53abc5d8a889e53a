//! The Jacobian applied without being formed (docs/theory.md, section 5.3): tangents of the
//! elements at each grid point, and `Γ_v`, `Γ_a` by FFT. `O(n N log N)` time, `O(n N)` memory.
//!
//! Stress resultants `f` of beams are kept apart: with their increments as unknowns of their own,
//! the Jacobian is the Schur complement of
//!
//! ```text
//! [A Bᵀ; L −1]
//! ```
//!
//! where `Bᵀ` takes resultants to forces and `L` motions to resultants.

use super::division::Share;
use super::instants::Instants;
use super::kinematics::{NodeKinematics, VariationScratch};
use super::problem::Collocation;
use super::state::GridState;
use crate::elements::{StrainTangent, StressLaw};
use crate::error::Result;
use crate::fourier::Differentiation;
use crate::motion::DualVector;
use crate::system::{System, Workspace};
use crate::workers::{Workers, parts};
use nalgebra::{Matrix6, Vector6};
use std::collections::BTreeMap;
use std::ops::Range;

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
    /// Its stations' strain tangents at a grid point.
    strains: Range<usize>,
}

/// A station of an element, with stress resultants.
#[derive(Debug, Clone)]
pub struct Station {
    /// Their law.
    pub law: StressLaw,
    /// Whether they depend on rates.
    pub damped: bool,
    /// Nodes of the element.
    pub nodes: Vec<usize>,
    /// Its first strain tangent at a grid point: one for each of the nodes.
    pub first: usize,
    /// Coupling of each pair of the nodes, row by row.
    pub couplings: Vec<usize>,
}

impl Station {
    /// The first strain tangent of another station of the element, so many further.
    pub fn first_of(&self, offset: isize) -> usize {
        self.first
            .saturating_add_signed(offset * self.nodes.len() as isize)
    }
}

/// Which tangents there are, for all grid points.
#[derive(Debug, Clone)]
pub struct TangentLayout {
    couplings: Vec<Coupling>,
    /// Of each coupling: the first element that has a part in it, and its part.
    first: Vec<(usize, usize)>,
    places: Vec<ElementPlace>,
    stations: Vec<Station>,
    /// Strain tangents at a grid point.
    strains: usize,
    /// Of each node: the stations whose resultants act on it, and its strain tangents there.
    acting: Vec<Vec<(usize, usize)>>,
    /// Of each coupling: the stations that it is a part of, and the strain tangents of its row and
    /// column there.
    within: Vec<Vec<(usize, usize, usize)>>,
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
        let mut strains = 0;
        let mut stations: Vec<Station> = Vec::new();
        let places: Vec<ElementPlace> = system
            .elements()
            .iter()
            .map(|placed| {
                let nodes = placed.element.nodes();
                let couplings: Vec<usize> = nodes
                    .iter()
                    .flat_map(|&row| nodes.iter().map(move |&column| (row, column)))
                    .map(|(row, column)| number(row, column))
                    .collect();
                let first = strains;
                for law in placed.element.stress_laws() {
                    stations.push(Station {
                        law,
                        damped: placed.element.has_damping(),
                        nodes: nodes.to_vec(),
                        first: strains,
                        couplings: couplings.clone(),
                    });
                    strains += nodes.len();
                }
                ElementPlace {
                    couplings,
                    strains: first..strains,
                }
            })
            .collect();
        let mut first = vec![(0, 0); couplings.len()];
        for (index, place) in places.iter().enumerate().rev() {
            for (part, &pair) in place.couplings.iter().enumerate().rev() {
                first[pair] = (index, part);
            }
        }
        let mut acting = vec![Vec::new(); system.nodes()];
        let mut within = vec![Vec::new(); couplings.len()];
        for (index, station) in stations.iter().enumerate() {
            let count = station.nodes.len();
            for (a, &node) in station.nodes.iter().enumerate() {
                acting[node].push((index, station.first + a));
                for b in 0..count {
                    let pair = (index, station.first + a, station.first + b);
                    within[station.couplings[a * count + b]].push(pair);
                }
            }
        }
        TangentLayout {
            couplings,
            first,
            places,
            stations,
            strains,
            acting,
            within,
        }
    }

    /// The pairs of coupled nodes, in the order of rows and then of columns.
    pub fn couplings(&self) -> &[Coupling] {
        &self.couplings
    }
}

/// `∂force/∂u`, `∂force/∂V` and `∂force/∂V̇` of one coupling at one grid point, stress resultants
/// held.
#[derive(Debug, Clone, Copy, Default)]
pub struct PairTangent {
    /// `K`.
    pub stiffness: Matrix6<f64>,
    /// `C`.
    pub damping: Matrix6<f64>,
    /// `M`.
    pub mass: Matrix6<f64>,
}

/// Tangents of an element's own unknowns, at one grid point after the other.
#[derive(Debug, Clone, Default)]
struct OwnTangent {
    /// `∂constraint/∂u`, column by column.
    gradients: Vec<f64>,
    /// `∂constraint/∂λ` and then `∂constraint/∂λ̇`, of internal states only.
    own: Vec<f64>,
}

/// The Jacobian at one state, as an operator.
#[derive(Debug)]
pub struct Tangent {
    layout: TangentLayout,
    points: usize,
    /// Of each coupling, at the grid points.
    pairs: Vec<Vec<PairTangent>>,
    /// Of each element.
    own: Vec<OwnTangent>,
    /// Each strain tangent, at the grid points.
    strains: Vec<Vec<StrainTangent>>,
    /// Stress resultants of station `s` at grid point `k`, at `s N + k`, that act on the nodes in a
    /// product.
    stresses: Vec<DualVector>,
    /// Size of the resultants' unknowns.
    resultant_scale: f64,
    /// Unscaled unknowns.
    x: Vec<f64>,
    /// Changes of velocity and acceleration of node `a` at grid point `k`, at `a N + k`.
    rates: Vec<[Vector6<f64>; 2]>,
    /// Of the nodes at the state: equations are evaluated elsewhere meanwhile.
    kinematics: Vec<NodeKinematics>,
    /// What changes of velocity and acceleration owe to the motion on a grid of one point.
    at_one: Vec<[Matrix6<f64>; 2]>,
    rooms: Vec<VariationRoom>,
}

/// Room of one thread.
#[derive(Debug)]
struct VariationRoom {
    operators: Differentiation,
    scratch: VariationScratch,
}

impl Tangent {
    /// Room for the Jacobian of a system on a grid of so many points.
    pub fn new(system: &System, points: usize) -> Self {
        let layout = TangentLayout::new(system);
        Tangent {
            pairs: vec![Vec::new(); layout.couplings.len()],
            own: vec![OwnTangent::default(); layout.places.len()],
            strains: vec![Vec::new(); layout.strains],
            stresses: vec![DualVector::zeros(); layout.stations.len() * points],
            resultant_scale: 1.0,
            points,
            x: Vec::new(),
            rates: vec![[Vector6::zeros(); 2]; points * system.nodes()],
            kinematics: Vec::new(),
            at_one: Vec::new(),
            rooms: Vec::new(),
            layout,
        }
    }

    /// The pairs of coupled nodes.
    pub fn couplings(&self) -> &[Coupling] {
        &self.layout.couplings
    }

    /// Tangents of the coupling `pair` at grid point `k`, stress resultants held, not scaled.
    pub fn pair(&self, pair: usize, k: usize) -> &PairTangent {
        &self.pairs[pair][k]
    }

    /// `∂force/∂u` of the coupling `pair` at grid point `k`, stress resultants included, not
    /// scaled.
    pub fn stiffness(&self, pair: usize, k: usize) -> Matrix6<f64> {
        let mut sum = self.pair(pair, k).stiffness;
        for &(station, row, column) in &self.layout.within[pair] {
            let station = &self.layout.stations[station];
            let mut stress = Matrix6::zeros();
            let mut add = |place: usize, stiffness: &Matrix6<f64>, damping: &Matrix6<f64>| {
                let column = self.strain(place, k);
                stress += stiffness * column.strain.to_twist_matrix();
                if station.damped {
                    stress += damping * column.rate.to_twist_matrix();
                }
            };
            let StressLaw {
                stiffness,
                damping,
                others,
            } = &station.law;
            add(column, stiffness, damping);
            for other in others {
                let place = station.first_of(other.offset) + column - station.first;
                add(place, &other.stiffness, &other.damping);
            }
            sum += self.strain(row, k).strain.to_twist_matrix().tr_mul(&stress);
        }
        sum
    }

    /// Stations with stress resultants, six each.
    pub fn stations(&self) -> &[Station] {
        &self.layout.stations
    }

    /// Strain tangent `index` of those of all stations at grid point `k`.
    pub fn strain(&self, index: usize, k: usize) -> &StrainTangent {
        &self.strains[index][k]
    }

    /// Number of stress resultants over the grid: unknowns in the order of stations, then of grid
    /// points.
    pub fn resultants(&self) -> usize {
        6 * self.points * self.layout.stations.len()
    }

    /// Forces and moments that count as 1 in the unknowns of stress resultants, the moments' for
    /// arms of the characteristic length.
    pub fn resultant_scales(&self, system: &System) -> Vector6<f64> {
        let (force, moment) = (
            self.resultant_scale,
            self.resultant_scale * system.scales().length,
        );
        Vector6::new(force, force, force, moment, moment, moment)
    }

    /// Sets the size of the resultants' unknowns.
    pub fn set_resultant_scale(&mut self, scale: f64) {
        self.resultant_scale = scale;
    }

    /// `∂constraint/∂u` of element `index` at grid point `k`, column by column, not scaled.
    pub fn gradient(&self, system: &System, index: usize, k: usize) -> &[f64] {
        let element = &system.elements()[index].element;
        let length = 6 * element.nodes().len() * element.multipliers();
        &self.own[index].gradients[length * k..][..length]
    }

    /// `∂constraint/∂λ` and `∂constraint/∂λ̇` of element `index`, which has internal states, at
    /// grid point `k`, column by column, not scaled.
    pub fn own(&self, system: &System, index: usize, k: usize) -> (&[f64], &[f64]) {
        let count = system.elements()[index].element.multipliers();
        self.own[index].own[2 * count * count * k..][..2 * count * count].split_at(count * count)
    }

    /// Bytes that the tangents take.
    pub fn bytes(&self) -> usize {
        let own = self
            .own
            .iter()
            .map(|own| own.gradients.len() + own.own.len());
        self.points * self.pairs.len() * size_of::<PairTangent>()
            + self.points * self.strains.len() * size_of::<StrainTangent>()
            + own.sum::<usize>() * size_of::<f64>()
            + size_of_val(&self.rates[..])
            + size_of_val(&self.stresses[..])
    }

    /// Evaluates the elements at `state`.
    pub fn evaluate(&mut self, equations: &mut Collocation, state: &GridState) -> Result<()> {
        equations.update_kinematics(state);
        self.at_one.clear();
        if self.points == 1 {
            let at_one = |node| {
                let (velocity, acceleration) = equations.kinematic_tangent(node, 0, 0);
                [velocity, acceleration].map(|matrix| matrix.to_twist_matrix())
            };
            self.at_one.extend((0..state.motions.len()).map(at_one));
        } else {
            self.kinematics.clone_from(&equations.kinematics);
        }
        let (instants, division) = (&equations.instants, &equations.division);
        let (system, layout) = (equations.system(), &self.layout);
        let counts = layout.places.iter().map(|place| place.strains.len());
        let own = parts(&mut self.strains, counts).zip(&mut self.own);
        let pairs = division.split_by(&mut self.pairs, |share| {
            layout.couplings_of(share.nodes.clone()).len()
        });
        let mut all: Vec<_> = pairs.into_iter().zip(division.deal(own)).collect();
        division.workers.try_for_each(
            &mut all,
            &mut Vec::new(),
            || system.workspace_with_resultants_apart(),
            |workspace, i, (pairs, own)| {
                layout.evaluate(
                    instants,
                    (&division.shares[i], &division.workers),
                    state,
                    workspace,
                    (pairs, own),
                )
            },
        )
    }

    /// Writes the product of the scaled Jacobian and `x`. Where `x` goes on with increments of
    /// stress resultants, so does `y` with what the equations of these ask for.
    pub fn apply(&mut self, equations: &Collocation, x: &[f64], y: &mut [f64]) {
        let (x, resultants) = x.split_at(equations.size());
        let (y, unbalance) = y.split_at_mut(equations.size());
        let system = equations.system();
        let points = self.points;
        let workers = equations.workers();
        self.x.resize(x.len(), 0.0);
        let (motions, own) = self.x.split_at_mut(6 * points * system.nodes());
        let unscale = |(to, (x, scale)): (&mut f64, (&f64, &f64))| *to = x * scale;
        let (x_motions, x_own) = x.split_at(motions.len());
        let (motion_scale, own_scale) = equations.column_scale.split_at(motions.len());
        own.iter_mut()
            .zip(x_own.iter().zip(own_scale))
            .for_each(unscale);
        let rates = self.rates.chunks_mut(points);
        let mut nodes: Vec<_> = rates.zip(motions.chunks_mut(6 * points)).collect();
        let (kinematics, at_one) = (&self.kinematics, &self.at_one);
        workers.for_each(
            &mut nodes,
            &mut self.rooms,
            || VariationRoom {
                operators: equations.operators.clone(),
                scratch: VariationScratch::default(),
            },
            |room, node, (rates, motions)| {
                let part = 6 * points * node..6 * points * (node + 1);
                let scaled = x_motions[part.clone()].iter().zip(&motion_scale[part]);
                motions.iter_mut().zip(scaled).for_each(unscale);
                if let Some(matrices) = at_one.get(node) {
                    let u = Vector6::from_column_slice(motions);
                    rates[0] = matrices.map(|matrix| matrix * u);
                    return;
                }
                kinematics[node].variation(
                    &mut room.operators,
                    motions,
                    &mut room.scratch,
                    |l, velocity, acceleration| rates[l] = [*velocity, *acceleration],
                );
            },
        );

        let (motions, own) = self.x.split_at(6 * points * system.nodes());
        let of_node = |node: usize| &motions[6 * points * node..][..6 * points];
        let (layout, pairs, rates) = (&self.layout, &self.pairs, &self.rates);
        let strains = &self.strains;
        let scales = self.resultant_scales(system);
        let mut unbalances = unbalance.chunks_mut(6 * points);
        let mut stresses: Vec<_> = self
            .stresses
            .chunks_mut(points)
            .map(|stresses| (stresses, unbalances.next()))
            .collect();
        workers.for_each(
            &mut stresses,
            &mut Vec::new(),
            || (),
            |(), index, (stresses, unbalance)| {
                layout.stations[index].stresses(points, strains, &of_node, rates, stresses);
                let Some(unbalance) = unbalance else {
                    return;
                };
                let given = resultants[6 * points * index..].chunks_exact(6);
                let unbalance = unbalance.chunks_exact_mut(6);
                for ((stress, given), unbalance) in stresses.iter_mut().zip(given).zip(unbalance) {
                    let given = Vector6::from_column_slice(given);
                    let difference = stress.to_wrench().component_div(&scales) - given;
                    unbalance.copy_from_slice(difference.as_slice());
                    *stress = DualVector::from_wrench(&given.component_mul(&scales));
                }
            },
        );

        let (forces, constraints) = y.split_at_mut(6 * points * system.nodes());
        let stresses = &self.stresses;
        let mut rows: Vec<_> = forces.chunks_mut(6 * points).collect();
        workers.for_each(
            &mut rows,
            &mut Vec::new(),
            || (),
            |(), node, forces| {
                forces.fill(0.0);
                for pair in layout.couplings_of(node..node + 1) {
                    let coupling = &layout.couplings[pair];
                    let rates = &rates[coupling.column * points..][..points];
                    let motions = of_node(coupling.column).chunks_exact(6);
                    let rows = forces.chunks_exact_mut(6);
                    for (((force, u), tangent), rates) in
                        rows.zip(motions).zip(&pairs[pair]).zip(rates)
                    {
                        let sum = tangent.force(coupling.moving, u, rates);
                        force.iter_mut().zip(&sum).for_each(|(y, f)| *y += f);
                    }
                }
                for &(station, strain) in &layout.acting[node] {
                    let stresses = &stresses[station * points..][..points];
                    let rows = forces.chunks_exact_mut(6);
                    for ((force, strain), stress) in rows.zip(&strains[strain]).zip(stresses) {
                        let sum = (strain.strain.transpose() * *stress).to_wrench();
                        force.iter_mut().zip(&sum).for_each(|(y, f)| *y += f);
                    }
                }
                let scales = &equations.row_scale[6 * points * node..];
                forces
                    .iter_mut()
                    .zip(scales)
                    .for_each(|(y, scale)| *y *= scale);
            },
        );
        constraints.fill(0.0);
        for (placed, tangents) in system.elements().iter().zip(&self.own) {
            let count = placed.element.multipliers();
            let nodes = placed.element.nodes();
            if count == 0 {
                continue;
            }
            let gradients = tangents.gradients.chunks_exact(6 * nodes.len() * count);
            for (k, gradient) in gradients.enumerate() {
                let first = placed.first_multiplier * points + count * k;
                let lambda = &own[first..first + count];
                let violation = &mut constraints[first..first + count];
                let mut columns = gradient.chunks_exact(count);
                for &node in nodes {
                    let at = 6 * (node * points + k);
                    for (component, column) in columns.by_ref().take(6).enumerate() {
                        for ((row, g), l) in violation.iter_mut().zip(column).zip(lambda) {
                            *row += g * motions[at + component];
                            forces[at + component] += g * l * equations.row_scale[at + component];
                        }
                    }
                }
            }
        }
        self.add_states(equations, constraints);
        let scales = &equations.row_scale[forces.len()..];
        constraints
            .iter_mut()
            .zip(scales)
            .for_each(|(y, scale)| *y *= scale);
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
        for (placed, tangents) in system.elements().iter().zip(&self.own) {
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
                    let blocks = &tangents.own[2 * count * count * k..][..2 * count * count];
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
    /// `K Δu + C Δv + M Δv̇`.
    #[inline]
    pub(super) fn force(&self, moving: bool, u: &[f64], rates: &[Vector6<f64>; 2]) -> Vector6<f64> {
        let mut sum = self.stiffness * Vector6::from_column_slice(u);
        if moving {
            sum += self.damping * rates[0] + self.mass * rates[1];
        }
        sum
    }
}

impl Station {
    /// Stress resultants by the motions and rates of the nodes, at all grid points.
    fn stresses<'x>(
        &self,
        points: usize,
        strains: &[Vec<StrainTangent>],
        of_node: &impl Fn(usize) -> &'x [f64],
        rates: &[[Vector6<f64>; 2]],
        stresses: &mut [DualVector],
    ) {
        let add = |first: usize, k: usize, stiffness, damping, wrench: &mut Vector6<f64>| {
            let (mut strain, mut strain_rate) = (DualVector::zeros(), DualVector::zeros());
            for (a, &node) in self.nodes.iter().enumerate() {
                let tangent = &strains[first + a][k];
                let u = Vector6::from_column_slice(&of_node(node)[6 * k..6 * k + 6]);
                let u = DualVector::from_twist(&u);
                strain += tangent.strain * u;
                if self.damped {
                    let v = DualVector::from_twist(&rates[node * points + k][0]);
                    strain_rate += tangent.strain * v + tangent.rate * u;
                }
            }
            let (stiffness, damping): (&Matrix6<f64>, &Matrix6<f64>) = (stiffness, damping);
            *wrench += stiffness * strain.to_twist();
            if self.damped {
                *wrench += damping * strain_rate.to_twist();
            }
        };
        let law = &self.law;
        for (k, stress) in stresses.iter_mut().enumerate() {
            let mut wrench = Vector6::zeros();
            add(self.first, k, &law.stiffness, &law.damping, &mut wrench);
            for other in &law.others {
                let first = self.first_of(other.offset);
                add(first, k, &other.stiffness, &other.damping, &mut wrench);
            }
            *stress = DualVector::from_wrench(&wrench);
        }
    }
}

/// What an element has of its own: strain tangents, and tangents of its own unknowns.
type OwnPart<'a> = (&'a mut [Vec<StrainTangent>], &'a mut OwnTangent);

impl TangentLayout {
    /// Couplings of the rows of some nodes.
    fn couplings_of(&self, nodes: Range<usize>) -> Range<usize> {
        let first = |node: usize| self.couplings.partition_point(|c| c.row < node);
        first(nodes.start)..first(nodes.end)
    }

    /// Sums the tangents of the couplings of a share's rows; writes those of strains and of own
    /// unknowns of the elements that have these there.
    fn evaluate(
        &self,
        instants: &Instants,
        (share, workers): (&Share, &Workers),
        state: &GridState,
        workspace: &mut Workspace,
        (pairs, own): (&mut [Vec<PairTangent>], &mut [Option<OwnPart>]),
    ) -> Result<()> {
        let first_pair = self.couplings_of(share.nodes.clone()).start;
        let points = state.points();
        for (&index, own) in share.elements.iter().zip(own) {
            workers.pulse()?;
            let placed = &instants.system().elements()[index];
            let nodes = placed.element.nodes();
            let couplings = &self.places[index].couplings;
            let moving = placed.element.has_mass() || placed.element.has_damping();
            if let Some((strains, own)) = own {
                strains.iter_mut().for_each(Vec::clear);
                own.gradients.clear();
                own.own.clear();
            }
            for k in 0..points {
                let out = instants.evaluate(placed, k, state, workspace)?;
                for (part, &coupling) in couplings.iter().enumerate() {
                    let (a, b) = (part / nodes.len(), part % nodes.len());
                    if !share.nodes.contains(&nodes[a]) {
                        continue;
                    }
                    let sums = &mut pairs[coupling - first_pair];
                    if self.first[coupling] == (index, part) {
                        if k == 0 {
                            sums.clear();
                            sums.reserve_exact(points);
                        }
                        sums.push(PairTangent::default());
                    }
                    let sum = &mut sums[k];
                    sum.stiffness += out.stiffness.fixed_view::<6, 6>(6 * a, 6 * b);
                    if moving {
                        sum.damping += out.damping.fixed_view::<6, 6>(6 * a, 6 * b);
                        sum.mass += out.mass.fixed_view::<6, 6>(6 * a, 6 * b);
                    }
                }
                let Some((strains, own)) = own else {
                    continue;
                };
                for (all, strain) in strains.iter_mut().zip(&out.strains) {
                    all.push(*strain);
                }
                own.gradients.extend_from_slice(out.gradient.as_slice());
                if placed.has_states {
                    own.own.extend_from_slice(out.own.as_slice());
                    own.own.extend_from_slice(out.own_rate.as_slice());
                }
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
