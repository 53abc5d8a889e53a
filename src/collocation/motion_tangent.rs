//! Forces that motions cause, linearised, where no stress resultants and no internal states are
//! involved: as an operator, and between motions that are given at each grid point by itself,
//! without the matrix of all motions.

use super::problem::Collocation;
use super::rule::{KinematicsScratch, NodeKinematics};
use super::state::GridState;
use super::tangent::Tangent;
use crate::error::Result;
use crate::fourier::{Differentiation, Slope};
use crate::motion::{DualMatrix, DualVector};
use crate::system::System;
use nalgebra::Vector6;

/// Forces at a grid point by motions at others are bilinear: in these numbers of each.
const BILINEAR: usize = 18;

/// The Jacobian's part of forces and motions at one state, whatever the equations are evaluated at
/// since.
#[derive(Debug)]
pub struct MotionTangent {
    tangent: Tangent,
    points: usize,
    operators: Differentiation,
    kinematics: Vec<NodeKinematics>,
    /// Of derivatives by time; none if these are those of the operators.
    slopes: Vec<Slope>,
    /// Couplings of each node's motions, and the nodes whose forces they are.
    columns: Vec<Vec<(usize, usize)>>,
    /// Scales of forces and of motions; those of all nodes are the same.
    forces: Vector6<f64>,
    motions: Vector6<f64>,
    scratch: KinematicsScratch,
    unscaled: Vec<f64>,
    rates: Vec<[Vector6<f64>; 2]>,
    workspace: Workspace,
}

/// Motions that are given at each grid point.
struct Basis<B> {
    count: usize,
    basis: B,
}

impl<'z, B: Fn(usize) -> &'z [f64]> Basis<B> {
    /// Motion `i` of a node at grid point `k`, times the scales of motions or of forces.
    fn along(&self, k: usize, node: usize, i: usize, scale: &Vector6<f64>) -> Vector6<f64> {
        let rows = &(self.basis)(k)[6 * node * self.count..];
        Vector6::from_fn(|component, _| scale[component] * rows[component * self.count + i])
    }
}

/// Scratch for one node.
#[derive(Debug, Default)]
struct Workspace {
    /// What forces along the given motions change by with its motion and the derivatives of that by
    /// pseudo-time, as velocity and acceleration.
    along: Vec<[Vector6<f64>; 3]>,
    /// Factors of the second and first derivatives in time.
    second: Vec<[f64; BILINEAR]>,
    first: Vec<[f64; BILINEAR]>,
    moved: Vec<[f64; BILINEAR]>,
    /// Rows that are not zero, for few of many freedoms move a node; and their grid points.
    rows: Vec<(usize, usize)>,
}

/// The numbers of a dual matrix, those that go with primal parts first.
fn numbers(a: &DualMatrix, dual_first: bool) -> [f64; BILINEAR] {
    let (first, second) = match dual_first {
        true => (&a.dual, &a.primal),
        false => (&a.primal, &a.dual),
    };
    let mut all = [0.0; BILINEAR];
    all[..9].copy_from_slice(first.as_slice());
    all[9..].copy_from_slice(second.as_slice());
    all
}

fn product(a: &[f64; BILINEAR], b: &[f64; BILINEAR]) -> f64 {
    // Two sums at a time, which do not wait for each other.
    let mut sums = [0.0; 6];
    for (a, b) in a.chunks_exact(6).zip(b.chunks_exact(6)) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}

impl MotionTangent {
    /// For `equations` on their grid; none where there is more than motions, or one point, whose
    /// velocities may be given.
    pub fn new(equations: &Collocation) -> Option<Self> {
        let (system, points) = (equations.system(), equations.grid().points());
        let serves = points > 1
            && equations.oversampled().is_none()
            && system.stations() == 0
            && !system.elements().iter().any(|placed| placed.has_states);
        if !serves {
            return None;
        }
        let tangent = Tangent::new(system, points);
        let mut columns = vec![Vec::new(); system.nodes()];
        for (pair, coupling) in tangent.couplings().iter().enumerate() {
            columns[coupling.column].push((pair, coupling.row));
        }
        Some(MotionTangent {
            points,
            operators: equations.rule.over_grid()?.operators.clone(),
            kinematics: Vec::new(),
            slopes: Vec::new(),
            columns,
            forces: Vector6::from_column_slice(&equations.row_scale[..6]),
            motions: Vector6::from_column_slice(&equations.column_scale[..6]),
            scratch: KinematicsScratch::default(),
            unscaled: vec![0.0; 6 * points],
            rates: vec![[Vector6::zeros(); 2]; points],
            workspace: Workspace::default(),
            tangent,
        })
    }

    /// Linearises at `state`.
    pub fn evaluate(&mut self, equations: &mut Collocation, state: &GridState) -> Result<()> {
        self.tangent.evaluate(equations, state)?;
        if let Some(over) = equations.rule.over_grid() {
            over.kinematics.clone_into(&mut self.kinematics);
            // The period may be another.
            self.operators.clone_from(over.operators);
            over.slopes.clone_into(&mut self.slopes);
        }
        Ok(())
    }

    /// Gradient of the constraints of element `index` at grid point `k`, column by column, not
    /// scaled.
    pub fn gradient(&self, system: &System, index: usize, k: usize) -> &[f64] {
        self.tangent.gradient(system, index, k)
    }

    /// About the largest entry of the scaled Jacobian.
    pub fn largest(&self) -> f64 {
        let scales = self.forces * self.motions.transpose();
        let (first, second) = (0..self.points).fold((0.0f64, 0.0f64), |(first, second), k| {
            let (d, t) = (self.operators.first(k, 0), self.operators.second(k, 0));
            (first.max(d.abs()), second.max(t.abs()))
        });
        let pairs = 0..self.tangent.couplings().len();
        let tangents = pairs.flat_map(|pair| (0..self.points).map(move |k| (pair, k)));
        tangents.fold(0.0f64, |largest, (pair, k)| {
            let tangent = self.tangent.pair(pair, k);
            let rate = self.slopes.get(k).map_or(1.0, |slope| slope.rate);
            let (first, second) = (first * rate, second * rate * rate);
            let size = |matrix: &nalgebra::Matrix6<f64>| matrix.component_mul(&scales).amax();
            largest
                .max(size(tangent.stiffness))
                .max(first * size(tangent.damping))
                .max(second * size(tangent.mass))
        })
    }

    /// `rest −= K u` for scaled motions, in the order of the unknowns.
    pub fn subtract_forces(&mut self, motions: &[f64], rest: &mut [f64]) {
        let size = 6 * self.points;
        let couplings = self.tangent.couplings();
        for (node, pairs) in self.columns.iter().enumerate() {
            let scaled = motions[size * node..][..size].chunks_exact(6);
            for (to, from) in self.unscaled.chunks_exact_mut(6).zip(scaled) {
                for ((to, from), scale) in to.iter_mut().zip(from).zip(&self.motions) {
                    *to = from * scale;
                }
            }
            if pairs.iter().any(|(pair, _)| couplings[*pair].moving) {
                self.kinematics[node].variation(
                    &mut self.operators,
                    &self.unscaled,
                    &mut self.scratch,
                    &mut self.rates,
                );
                for (rates, slope) in self.rates.iter_mut().zip(&self.slopes) {
                    *rates = slope.by_time(rates[0], rates[1]);
                }
            }
            for &(pair, row) in pairs {
                let moving = couplings[pair].moving;
                let rows = rest[size * row..][..size].chunks_exact_mut(6);
                for (k, (rest, u)) in rows.zip(self.unscaled.chunks_exact(6)).enumerate() {
                    let force = self.tangent.pair(pair, k).force(moving, u, &self.rates[k]);
                    for ((rest, force), scale) in rest.iter_mut().zip(&force).zip(&self.forces) {
                        *rest -= scale * force;
                    }
                }
            }
        }
    }

    /// Writes `Zᵀ K Z`, column by column, for `count` scaled motions at each grid point `k`:
    /// `basis(k)` has a row for each component of each node.
    pub fn between<'z>(
        &mut self,
        count: usize,
        basis: impl Fn(usize) -> &'z [f64],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let basis = Basis { count, basis };
        let mut workspace = std::mem::take(&mut self.workspace);
        for node in 0..self.columns.len() {
            self.find_along(node, &basis, &mut workspace);
            self.add_at_points(node, &basis, &workspace, out);
            if self.is_moving(node) {
                self.find_factors(node, &basis, &mut workspace);
                self.add_between_points(count, &workspace, out);
            }
        }
        self.workspace = workspace;
    }

    /// Whether anything depends on a node's velocity or acceleration.
    fn is_moving(&self, node: usize) -> bool {
        let couplings = self.tangent.couplings();
        self.columns[node]
            .iter()
            .any(|(pair, _)| couplings[*pair].moving)
    }

    /// Finds what forces along the given motions change by with the motion of a node.
    fn find_along<'z>(
        &self,
        node: usize,
        basis: &Basis<impl Fn(usize) -> &'z [f64]>,
        workspace: &mut Workspace,
    ) {
        let couplings = self.tangent.couplings();
        workspace.along.clear();
        for k in 0..self.points {
            for i in 0..basis.count {
                let mut sums = [Vector6::zeros(); 3];
                for &(pair, row) in &self.columns[node] {
                    let z = basis.along(k, row, i, &self.forces);
                    if z.iter().all(|x| *x == 0.0) {
                        continue;
                    }
                    let tangent = self.tangent.pair(pair, k);
                    sums[0] += tangent.stiffness.tr_mul(&z);
                    if couplings[pair].moving {
                        sums[1] += tangent.damping.tr_mul(&z);
                        sums[2] += tangent.mass.tr_mul(&z);
                    }
                }
                if let Some(slope) = self.slopes.get(k) {
                    [sums[1], sums[2]] = slope.transposed(sums[1], sums[2]);
                }
                workspace.along.push(sums);
            }
        }
    }

    /// Adds the forces at each grid point by a node's motion there.
    fn add_at_points<'z>(
        &self,
        node: usize,
        basis: &Basis<impl Fn(usize) -> &'z [f64]>,
        workspace: &Workspace,
        out: &mut [f64],
    ) {
        let (count, size) = (basis.count, basis.count * self.points);
        let moving = self.is_moving(node);
        for k in 0..self.points {
            let weights = (self.operators.first(k, k), self.operators.second(k, k));
            let gammas = moving.then(|| self.kinematics[node].tangent(weights, k, k));
            for j in 0..count {
                let z = basis.along(k, node, j, &self.motions);
                let rates = gammas.map(|gammas| {
                    let z = DualVector::from_twist(&z);
                    gammas.map(|gamma| (gamma * z).to_twist())
                });
                let column = &mut out[(k * count + j) * size + k * count..][..count];
                for (entry, along) in column.iter_mut().zip(&workspace.along[k * count..]) {
                    *entry += along[0].dot(&z);
                    if let Some([velocity, acceleration]) = &rates {
                        *entry += along[1].dot(velocity) + along[2].dot(acceleration);
                    }
                }
            }
        }
    }

    /// Finds the factors of the forces at each grid point by a node's motion at others.
    ///
    /// `ΔM = M z̃`, `Δv_ℓ = D_ℓk axial(R)` and `Δv̇_ℓ = T_ℓk axial(R) − D_ℓk ((tr(A) I − A)
    /// axial(R) + 2 axial(ṽ R))`, with `R = M_ℓᵀ ΔM_k`; `w · axial(R)` is half the product of all
    /// entries of `M_ℓ w̃` and `ΔM_k`.
    fn find_factors<'z>(
        &self,
        node: usize,
        basis: &Basis<impl Fn(usize) -> &'z [f64]>,
        workspace: &mut Workspace,
    ) {
        let kinematics = &self.kinematics[node];
        let Workspace {
            along,
            second,
            first,
            moved,
            rows,
        } = workspace;
        for list in [&mut *second, &mut *first, &mut *moved] {
            list.clear();
        }
        rows.clear();
        for k in 0..self.points {
            let (m, v) = (kinematics.motion(k), kinematics.velocity(k));
            let spread = kinematics.first(k).trace_minus().transpose();
            for i in 0..basis.count {
                let at = k * basis.count + i;
                let [_, by_velocity, by_acceleration] = &along[at];
                let by_acceleration = DualVector::from_wrench(by_acceleration);
                let by_velocity = DualVector::from_wrench(by_velocity);
                let skew = by_acceleration.skew();
                let by_first = (by_velocity - spread * by_acceleration).skew();
                let by_first = by_first + v.skew() * skew * 2.0;
                second.push(numbers(&(m * skew * 0.5), true));
                first.push(numbers(&(m * by_first * 0.5), true));
                let z = DualVector::from_twist(&basis.along(k, node, i, &self.motions));
                moved.push(numbers(&(m * z.skew()), false));
                if [&second[at], &first[at]]
                    .into_iter()
                    .flatten()
                    .any(|x| *x != 0.0)
                {
                    rows.push((at, k));
                }
            }
        }
    }

    /// Adds the forces at each grid point by a node's motion at others.
    fn add_between_points(&self, count: usize, workspace: &Workspace, out: &mut [f64]) {
        let size = count * self.points;
        for k in 0..self.points {
            let moved = &workspace.moved[k * count..][..count];
            for &(i, l) in workspace.rows.iter().filter(|(_, l)| *l != k) {
                let (d, t) = (self.operators.first(l, k), self.operators.second(l, k));
                let (second, first) = (&workspace.second[i], &workspace.first[i]);
                let both = std::array::from_fn(|n| t * second[n] + d * first[n]);
                for (moved, j) in moved.iter().zip(k * count..) {
                    out[j * size + i] += product(&both, moved);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::pattern::Pattern;
    use crate::fourier::{SharpEvent, TimeGrid, TimeMap};
    use crate::model::Model;
    use crate::test_models::parts::{ball, gravity};
    use nalgebra::{Matrix6, Vector3};
    use std::sync::Arc;

    /// Of the mass alone, of damping alone and of stiffness, on grid points apart and close.
    #[test]
    fn the_largest_entry_is_about_that_of_the_matrix() {
        let event = SharpEvent {
            time: 0.9,
            width: 0.02,
            share: 1.0,
        };
        for damping in [0.0, 1e-3, 1e3] {
            for map in [TimeMap::default(), TimeMap::new(&[event], 2.0).unwrap()] {
                let mut model = Model::new();
                let body = ball(&mut model, 1.0, 1.0, &Vector3::zeros());
                gravity(&mut model, [0.0, 0.0, -9.81]);
                if damping > 0.0 {
                    let matrix = Matrix6::identity() * damping;
                    let damper = model.add_viscous_damper(None, Some(body), None, &matrix);
                    damper.unwrap();
                }
                let system = Arc::new(System::new(&model, 2.0).unwrap());
                let grid = TimeGrid::new(31, 2.0).unwrap().mapped(map);
                let mut equations = Collocation::new(system.clone(), grid).unwrap();
                let state = GridState::reference(&system, grid);
                let mut motions = MotionTangent::new(&equations).unwrap();
                motions.evaluate(&mut equations, &state).unwrap();
                let pattern = Pattern::new(&system, 31);
                let mut values = vec![0.0; pattern.entries()];
                let mut tangent = Tangent::new(&system, 31);
                equations
                    .jacobian(&state, &pattern, &mut tangent, &mut values)
                    .unwrap();
                let exact = values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                let found = motions.largest();
                assert!(
                    (0.5..2.0).contains(&(found / exact)),
                    "damping {damping}: {found} for {exact}"
                );
            }
        }
    }
}
