//! Residual of the governing equations at all grid points (docs/theory.md, section 5.2).

use super::aliasing::Aliasing;
use super::division::Division;
use super::instants::Instants;
use super::kinematics::{BackwardRule, NodeKinematics, VariationScratch};
use super::oversampled::Oversampled;
use super::state::GridState;
use super::step::{AlphaStep, GivenRates};
use crate::elements::{Measure, NodeState, Unknown};
use crate::error::Result;
use crate::fourier::{Differentiation, Resampling, TimeGrid};
use crate::motion::{DualMatrix, DualVector, Motion};
use crate::system::{System, Workspace};
use crate::workers::{Workers, parts};
use nalgebra::Vector6;
use std::sync::Arc;

/// Scaled compliance of dependent constraints in the Jacobian. Newton's method loses this factor,
/// over the compliance of the mechanism, of its quadratic convergence; rounding must be well below
/// it.
const REGULARISATION: f64 = 1e-7;

/// Multiply-adds of the velocity and acceleration of a node at a grid point, about.
const KINEMATICS: usize = 300;

/// The equations of a system on a grid, scaled so that they do not depend on units.
///
/// Rows of forces are divided by the characteristic force (moments also by the length), those of
/// constrained lengths by the length. Unknown displacements are in units of the length, multipliers
/// in units of the force, or the force times the length.
#[derive(Debug, Clone)]
pub struct Collocation {
    system: Arc<System>,
    grid: TimeGrid,
    pub(super) operators: Differentiation,
    /// The same for each thread.
    operator_rooms: Vec<Differentiation>,
    pub(super) instants: Instants,
    pub(super) derivatives: Derivatives,
    pub(super) kinematics: Vec<NodeKinematics>,
    /// Scratch for each thread; one at least.
    forces_only: Vec<Workspace>,
    pub(super) with_tangents: Workspace,
    /// Scale of each row: residuals are multiplied by it.
    pub(super) row_scale: Vec<f64>,
    /// Scale of each column: scaled unknowns times it are the unknowns.
    pub(super) column_scale: Vec<f64>,
    /// Scaled compliance of all constraints in the Jacobian, for redundant ones.
    pub(super) regularisation: f64,
    workers: Workers,
    pub(super) division: Division,
    /// Where the residual is taken from instead, if not from the grid's own points.
    oversampled: Option<Box<Oversampled>>,
}

/// What velocities, accelerations and rates of internal states follow from.
#[derive(Debug, Clone)]
pub(super) enum Derivatives {
    /// The motion over the grid.
    Grid,
    /// On a grid of one point: backward differences, with past states, latest first.
    Backward(BackwardRule, Vec<GridState>),
    /// On a grid of one point: a step of the generalised-α method.
    Step(AlphaStep),
    /// On a grid of one point: nothing, they are given.
    Given(GivenRates),
    /// On a grid of one point: each node turns steadily, with this twist about the origin, resolved
    /// in space.
    Steady(Vec<Vector6<f64>>),
}

impl Collocation {
    /// Equations of `system` on `grid`, whose first point is at time zero.
    pub fn new(system: Arc<System>, grid: TimeGrid) -> Result<Self> {
        let points = grid.points();
        let scales = *system.scales();
        let (length, force) = (scales.length, scales.force);
        let mut row_scale = Vec::new();
        let mut column_scale = Vec::new();
        for _ in 0..system.nodes() * points {
            row_scale.extend([1.0 / force; 3]);
            row_scale.extend([1.0 / (force * length); 3]);
            column_scale.extend([length; 3]);
            column_scale.extend([1.0; 3]);
        }
        for placed in system.elements() {
            let count = placed.element.multipliers();
            for _ in 0..points {
                for row in 0..count {
                    let scale = |measure: Measure| match measure {
                        Measure::Length => (length, force),
                        Measure::Angle => (1.0, force * length),
                    };
                    match system.unknown(placed.first_multiplier + row) {
                        Unknown::Multiplier(measure) => {
                            let (motion, effort) = scale(measure);
                            row_scale.push(1.0 / motion);
                            column_scale.push(effort);
                        }
                        Unknown::State { measure, .. } => {
                            let (motion, effort) = scale(measure);
                            row_scale.push(1.0 / effort);
                            column_scale.push(motion);
                        }
                    }
                }
            }
        }
        let mut collocation = Collocation {
            operators: Differentiation::new(grid),
            operator_rooms: Vec::new(),
            instants: Instants {
                system: system.clone(),
                points,
                times: vec![0.0; points],
                signals: vec![0.0; system.signals() * points],
                inertia_factor: 1.0,
                states: Vec::new(),
                rates: vec![0.0; system.multipliers() * points],
                resultants: Vec::new(),
            },
            regularisation: if system.dependencies().is_empty() {
                0.0
            } else {
                REGULARISATION
            },
            derivatives: Derivatives::Grid,
            kinematics: vec![NodeKinematics::default(); system.nodes()],
            forces_only: vec![system.workspace(false)],
            with_tangents: system.workspace(true),
            row_scale,
            column_scale,
            oversampled: None,
            division: Division::new(&system, points, &Workers::default()),
            system,
            grid,
            workers: Workers::default(),
        };
        collocation.set_conditions(0.0, 1.0)?;
        Ok(collocation)
    }

    /// The system.
    pub fn system(&self) -> &Arc<System> {
        &self.system
    }

    /// Shares work among these threads.
    pub fn set_workers(&mut self, workers: Workers) {
        if let Some(oversampled) = &mut self.oversampled {
            oversampled.fine_mut().set_workers(workers.clone());
        }
        self.division = Division::new(&self.system, self.grid.points(), &workers);
        self.workers = workers;
    }

    /// The threads that share work.
    pub fn workers(&self) -> &Workers {
        &self.workers
    }

    /// The grid.
    pub fn grid(&self) -> TimeGrid {
        self.grid
    }

    /// Gives the same number of points another period.
    ///
    /// # Errors
    /// If it is none.
    pub fn set_period(&mut self, period: f64) -> Result<()> {
        self.grid = TimeGrid::new(self.grid.points(), period)?;
        self.operators = Differentiation::new(self.grid);
        self.operator_rooms.clear();
        Ok(())
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.row_scale.len()
    }

    /// Scale of each equation: equations times it are the scaled ones.
    pub fn row_scale(&self) -> &[f64] {
        &self.row_scale
    }

    /// Scale of each unknown: scaled unknowns times it are the unknowns.
    pub fn column_scale(&self) -> &[f64] {
        &self.column_scale
    }

    /// Moves the grid's first point to time `start`, with the fraction `load_factor` of all loads
    /// and prescribed motions.
    pub fn set_conditions(&mut self, start: f64, load_factor: f64) -> Result<()> {
        let count = self.system.signals();
        for k in 0..self.grid.points() {
            let values = &mut self.instants.signals[k * count..][..count];
            let time = start + self.grid.time(k);
            self.instants.times[k] = time;
            self.system.signal_values(time, load_factor, values)?;
        }
        if let Some(oversampled) = &mut self.oversampled {
            oversampled.fine_mut().set_conditions(start, load_factor)?;
        }
        Ok(())
    }

    /// Takes only this fraction of the inertial forces.
    pub fn set_inertia_factor(&mut self, factor: f64) {
        self.instants.inertia_factor = factor;
        if let Some(oversampled) = &mut self.oversampled {
            oversampled.fine_mut().set_inertia_factor(factor);
        }
    }

    /// From now on takes the residual from `factor` times as many points, projected on the
    /// harmonics of this grid. The Jacobian that is assembled remains that of the grid's own
    /// points.
    ///
    /// # Errors
    /// Those of signals.
    pub fn oversample(&mut self, factor: usize) -> Result<()> {
        let mut oversampled = Oversampled::new(&self.system, self.grid, factor)?;
        oversampled.fine_mut().set_workers(self.workers.clone());
        self.oversampled = Some(Box::new(oversampled));
        Ok(())
    }

    /// Where the residual is taken from, if not from the grid's own points.
    pub fn oversampled(&self) -> Option<&Oversampled> {
        self.oversampled.as_deref()
    }

    /// Stress resultants that follow from those of the strains at `state` in proportion to the
    /// unscaled `increment` of the unknowns, at all stations of grid point 0, then of grid point 1
    /// and so on. Kinematics become those of `state`.
    ///
    /// After an increment that turns beams much, those of the strains have little to do with
    /// equilibrium: second-order stretching, times axial stiffness. These are in equilibrium, as
    /// the linear equations were.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub(super) fn extrapolated_resultants(
        &mut self,
        state: &GridState,
        increment: &[f64],
    ) -> Result<Vec<Vector6<f64>>> {
        self.update_kinematics(state);
        let (points, stations) = (self.grid.points(), self.system.stations());
        let mut all = vec![Vector6::zeros(); points * stations];
        let changes = self.increments_with_rates(increment);
        let mut instants: Vec<&mut [Vector6<f64>]> = all.chunks_exact_mut(stations).collect();
        let (system, states) = (&self.system, &self.instants.states);
        self.workers.try_for_each(
            &mut instants,
            &mut Vec::new(),
            || (Vec::new(), Vec::new()),
            |(nodes, increments), k, out| {
                for placed in system.elements() {
                    let places = placed.element.nodes().iter().map(|node| node * points + k);
                    nodes.clear();
                    nodes.extend(places.clone().map(|at| states[at]));
                    increments.clear();
                    increments.extend(places.map(|at| changes[at]));
                    let out = &mut out[placed.stations.clone()];
                    placed
                        .element
                        .extrapolate_resultants(nodes, increments, out)?;
                }
                Ok(())
            },
        )?;
        Ok(all)
    }

    /// Increments of the nodes, and of their velocities, that an unscaled increment of all unknowns
    /// is; kinematics are those of the last evaluation.
    fn increments_with_rates(&mut self, increment: &[f64]) -> Vec<[Vector6<f64>; 2]> {
        let points = self.grid.points();
        let mut changes = vec![[Vector6::zeros(); 2]; points * self.system.nodes()];
        let mut scratch = VariationScratch::default();
        let of_nodes = increment.chunks_exact(6 * points);
        for (node, (changes, increments)) in changes.chunks_mut(points).zip(of_nodes).enumerate() {
            for (change, u) in changes.iter_mut().zip(increments.chunks_exact(6)) {
                change[0] = Vector6::from_column_slice(u);
            }
            match &self.derivatives {
                Derivatives::Grid => self.kinematics[node].variation(
                    &mut self.operators,
                    increments,
                    &mut scratch,
                    |l, velocity, _| changes[l][1] = *velocity,
                ),
                _ => {
                    let by_increment = self.kinematic_tangent(node, 0, 0).0;
                    changes[0][1] = by_increment.to_twist_matrix() * changes[0][0];
                }
            }
        }
        changes
    }

    /// Stress resultants of all stations at `state`, at the points of another grid of the same
    /// period that begins `start` periods later; none where tangents have no use for them.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn resampled_resultants(
        &mut self,
        state: &GridState,
        start: f64,
        other: TimeGrid,
    ) -> Result<Vec<Vector6<f64>>> {
        let stations = self.system.stations();
        if stations == 0 || self.oversampled.is_some() {
            return Ok(Vec::new());
        }
        let resultants = self.extrapolated_resultants(state, &vec![0.0; self.size()])?;
        let mut all = vec![Vector6::zeros(); other.points() * stations];
        let mut resampling = Resampling::new(self.grid, start, other.points());
        let mut values = vec![0.0; other.points()];
        for station in 0..stations {
            for row in 0..6 {
                let own = resultants.iter().skip(station).step_by(stations);
                resampling.read(own.map(|resultants| resultants[row]));
                resampling.write(0, 0, &mut values);
                for (k, value) in values.iter().enumerate() {
                    all[k * stations + station][row] = *value;
                }
            }
        }
        Ok(all)
    }

    /// From now on takes geometric stiffness at these stress resultants.
    pub fn set_resultants(&mut self, resultants: Vec<Vector6<f64>>) {
        self.instants.resultants = resultants;
    }

    /// The stress resultants that geometric stiffness is taken at; none if those of the strains.
    pub fn resultants(&self) -> &[Vector6<f64>] {
        &self.instants.resultants
    }

    /// Whether geometric stiffness is taken at stress resultants other than those of the strains.
    pub fn has_resultants(&self) -> bool {
        !self.instants.resultants.is_empty()
    }

    /// From now on takes geometric stiffness at the stress resultants of the strains: the tangent
    /// is exact.
    pub fn clear_resultants(&mut self) {
        self.instants.resultants.clear();
    }

    /// Makes a grid of one point a step of marching in time: derivatives are backward differences.
    pub fn set_past(&mut self, rule: BackwardRule, past: Vec<GridState>) {
        debug_assert_eq!(self.grid.points(), 1);
        self.derivatives = Derivatives::Backward(rule, past);
    }

    /// Makes a grid of one point the end of a step of the generalised-α method.
    pub fn set_step(&mut self, step: AlphaStep) {
        debug_assert_eq!(self.grid.points(), 1);
        self.derivatives = Derivatives::Step(step);
    }

    /// The step, if [`Collocation::set_step`] was called last.
    pub fn step(&self) -> Option<&AlphaStep> {
        match &self.derivatives {
            Derivatives::Step(step) => Some(step),
            _ => None,
        }
    }

    /// Makes the state of a grid of one point, with the node states of the last evaluation, the
    /// start of the next step.
    pub fn advance(&mut self, state: &GridState) {
        if let Derivatives::Step(step) = &mut self.derivatives {
            let system = &self.system;
            step.advance(state, &self.instants.states, |place| {
                matches!(system.unknown(place), Unknown::State { .. })
            });
        }
    }

    /// Takes the step out; derivatives are those of the grid again.
    pub fn take_step(&mut self) -> Option<AlphaStep> {
        match std::mem::replace(&mut self.derivatives, Derivatives::Grid) {
            Derivatives::Step(step) => Some(step),
            _ => None,
        }
    }

    /// Gives a grid of one point its velocities and accelerations. The unknowns are then
    /// accelerations.
    pub fn set_given_rates(&mut self, given: GivenRates) {
        debug_assert_eq!(self.grid.points(), 1);
        self.derivatives = Derivatives::Given(given);
    }

    /// Makes everything on a grid of one point turn steadily: `V = Ad(M⁻¹) W` with the twist `W` of
    /// each node about the origin, resolved in space, and `V̇ = 0`. Internal states are at rest.
    pub fn set_steady(&mut self, twists: Vec<Vector6<f64>>) {
        debug_assert_eq!(self.grid.points(), 1);
        self.derivatives = Derivatives::Steady(twists);
    }

    /// Values of all signals, grid point by grid point.
    pub fn signals(&self) -> &[f64] {
        &self.instants.signals
    }

    /// Sets the values of all signals, grid point by grid point.
    pub fn set_signals(&mut self, values: &[f64]) {
        self.instants.signals.copy_from_slice(values);
    }

    /// Scaled compliance of all constraints in the Jacobian: zero unless some depend on each other.
    pub fn regularisation(&self) -> f64 {
        self.regularisation
    }

    /// Writes the scaled violations of the constraints alone, at their rows of a residual.
    pub fn constraints(&mut self, state: &GridState, out: &mut [f64]) -> Result<()> {
        let points = self.grid.points();
        let first_constraint = 6 * points * self.system.nodes();
        self.update_kinematics(state);
        for placed in self.system.elements() {
            let count = placed.element.multipliers();
            if count == 0 || placed.has_states {
                continue;
            }
            for k in 0..points {
                let workspace = &mut self.forces_only[0];
                let contribution = self.instants.evaluate(placed, k, state, workspace)?;
                let first = first_constraint + placed.first_multiplier * points + count * k;
                for (row, violation) in contribution.constraint.iter().enumerate() {
                    out[first + row] = violation * self.row_scale[first + row];
                }
            }
        }
        Ok(())
    }

    /// Whether constraints may depend on each other: all have then a small compliance in the
    /// Jacobian, not in the residual, so that increments of the multipliers are those of least
    /// norm.
    pub fn is_regularised(&self) -> bool {
        self.regularisation != 0.0
    }

    /// Makes it so, as for a system that has such constraints from the start.
    pub fn regularise(&mut self) {
        self.regularisation = REGULARISATION;
        if let Some(oversampled) = &mut self.oversampled {
            oversampled.fine_mut().regularise();
        }
    }

    /// What a scaled increment of multipliers, by their compliance in the Jacobian, leaves of the
    /// constraints.
    pub fn compliance_of(&self, increment: &[f64], rest: &mut [f64]) {
        rest.fill(0.0);
        let points = self.grid.points();
        let first = 6 * points * self.system.nodes();
        for placed in self.system.elements().iter().filter(|p| !p.has_states) {
            let start = first + placed.first_multiplier * points;
            for i in start..start + placed.element.multipliers() * points {
                rest[i] = -self.regularisation * increment[i];
            }
        }
    }

    /// Largest violation of the constraints in a scaled residual.
    pub fn violation(&self, residual: &[f64]) -> f64 {
        let points = self.grid.points();
        let constraints = &residual[6 * points * self.system.nodes()..];
        let mut largest = 0.0f64;
        for placed in self.system.elements().iter().filter(|p| !p.has_states) {
            let count = placed.element.multipliers() * points;
            let part = &constraints[placed.first_multiplier * points..][..count];
            largest = part.iter().fold(largest, |m, x| m.max(x.abs()));
        }
        largest
    }

    /// Leaves marching: derivatives are those of the grid again.
    pub fn clear_past(&mut self) {
        self.derivatives = Derivatives::Grid;
    }

    /// Blocks `(ℓ, k)` of `Γ_v` and `Γ_a` of a node.
    pub(super) fn kinematic_tangent(
        &self,
        node: usize,
        l: usize,
        k: usize,
    ) -> (DualMatrix, DualMatrix) {
        let kinematics = &self.kinematics[node];
        match &self.derivatives {
            Derivatives::Grid => {
                let weights = (self.operators.first(l, k), self.operators.second(l, k));
                kinematics.tangent(weights, l, k)
            }
            Derivatives::Backward(rule, _) => {
                kinematics.tangent((rule.first[0], rule.second[0]), l, k)
            }
            Derivatives::Step(step) => step.tangent(node),
            Derivatives::Given(given) => {
                let mut identity = DualMatrix::zeros();
                identity.primal.fill_with_identity();
                (DualMatrix::zeros(), identity * given.weight)
            }
            // Δ(Ad(M⁻¹) W) = Ṽ Δu.
            Derivatives::Steady(_) => {
                let twist = &self.instants.states[node].twist;
                (DualVector::from_twist(twist).skew(), DualMatrix::zeros())
            }
        }
    }

    /// Evaluates velocities, accelerations and rates of internal states at the grid points.
    pub fn update_kinematics(&mut self, state: &GridState) {
        self.update_rates(state);
        let points = self.grid.points();
        let at_rest = NodeState::at_rest(Motion::identity());
        self.instants
            .states
            .resize(points * self.system.nodes(), at_rest);
        let states = self.instants.states.chunks_mut(points);
        let mut nodes: Vec<_> = self.kinematics.iter_mut().zip(states).collect();
        match &mut self.derivatives {
            Derivatives::Grid => {
                let size = KINEMATICS * points * self.system.nodes();
                let operators = &self.operators;
                self.workers.for_work(size).for_each(
                    &mut nodes,
                    &mut self.operator_rooms,
                    || operators.clone(),
                    |operators, node, (kinematics, states)| {
                        kinematics.evaluate(operators, state.node(node));
                        kinematics.write_states(state.node(node), states);
                    },
                );
            }
            Derivatives::Backward(rule, past) => {
                for (node, (kinematics, states)) in nodes.iter_mut().enumerate() {
                    let motions = state.node(node);
                    let past = past.iter().map(|state| &state.motions[node]);
                    kinematics.evaluate_backward(rule, &motions[0], past);
                    kinematics.write_states(motions, states);
                }
            }
            Derivatives::Step(step) => {
                for (node, (_, states)) in nodes.iter_mut().enumerate() {
                    states[0] = step.evaluate(node, &state.node(node)[0]);
                }
            }
            Derivatives::Given(given) => {
                for (node, (_, states)) in nodes.iter_mut().enumerate() {
                    states[0] = NodeState {
                        motion: state.node(node)[0],
                        twist: given.twist[node],
                        twist_rate: given.twist_rate[node],
                    };
                }
            }
            Derivatives::Steady(twists) => {
                for (node, (_, states)) in nodes.iter_mut().enumerate() {
                    let motion = state.node(node)[0];
                    states[0] = NodeState {
                        twist: motion.inverse().adjoint() * twists[node],
                        ..NodeState::at_rest(motion)
                    };
                }
            }
        }
    }

    fn update_rates(&mut self, state: &GridState) {
        let points = self.grid.points();
        let (mut samples, mut rates) = (vec![0.0; points], vec![0.0; points]);
        let mut unused = vec![0.0; points];
        for placed in self.system.elements().iter().filter(|p| p.has_states) {
            for row in 0..placed.element.multipliers() {
                let value = |state: &GridState, k: usize| state.multipliers_of(placed, k)[row];
                match &self.derivatives {
                    Derivatives::Backward(rule, past) => {
                        rates[0] = rule.first[0] * value(state, 0);
                        for (weight, past) in rule.first[1..].iter().zip(past) {
                            rates[0] += weight * value(past, 0);
                        }
                    }
                    Derivatives::Grid => {
                        let gain = state.gain(&self.system, placed, row);
                        for (k, sample) in samples.iter_mut().enumerate() {
                            *sample = value(state, k) - gain * k as f64 / points as f64;
                        }
                        self.operators.apply(&samples, &mut rates, &mut unused);
                        let steady = gain / self.grid.period();
                        rates.iter_mut().for_each(|rate| *rate += steady);
                    }
                    Derivatives::Step(step) => {
                        rates[0] = step.rate(placed.first_multiplier + row, value(state, 0));
                    }
                    Derivatives::Given(given) => {
                        rates[0] = given.rates[placed.first_multiplier + row];
                    }
                    Derivatives::Steady(_) => rates[0] = 0.0,
                }
                for (k, rate) in rates.iter().enumerate() {
                    self.instants.rates[state.first_multiplier(placed, k) + row] = *rate;
                }
            }
        }
    }

    /// Takes from the multipliers the part that has no effect, where constraints depend on each
    /// other; kinematics must be those of `state`.
    pub fn reduce_to_least_norm(&mut self, state: &mut GridState) -> Result<()> {
        if !self.is_regularised() {
            return Ok(());
        }
        let points = self.grid.points();
        for k in 0..points {
            let places: Vec<usize> = self
                .system
                .elements()
                .iter()
                .map(|placed| state.first_multiplier(placed, k))
                .collect();
            self.system.reduce_to_least_norm(
                |node| self.instants.states[node * points + k],
                |index| places[index],
                &mut state.multipliers,
                &mut self.with_tangents,
            )?;
        }
        Ok(())
    }

    /// What the grid makes of the highest harmonics of a node's increments, see [`Aliasing`].
    pub fn aliasing(&self, node: usize) -> Vec<Aliasing> {
        self.kinematics[node].aliasing(self.grid())
    }

    /// Node states over the grid, node by node, as of the last evaluation of anything.
    pub fn node_states(&self) -> &[NodeState] {
        &self.instants.states
    }

    /// Writes the scaled residual.
    pub fn residual(&mut self, state: &GridState, out: &mut [f64]) -> Result<()> {
        if let Some(oversampled) = &mut self.oversampled {
            return oversampled.residual(state, out);
        }
        self.update_kinematics(state);
        let points = self.grid.points();
        let system = &self.system;
        let (forces, constraints) = out.split_at_mut(6 * points * system.nodes());
        let counts = system
            .elements()
            .iter()
            .map(|p| points * p.element.multipliers());
        let own = self.division.deal(parts(constraints, counts));
        let forces = self.division.split(forces, 6 * points);
        let mut all: Vec<_> = forces.into_iter().zip(own).collect();
        let (instants, division) = (&self.instants, &self.division);
        division.workers.try_for_each(
            &mut all,
            &mut self.forces_only,
            || system.workspace(false),
            |workspace, i, (forces, own)| {
                let (share, workers) = (&division.shares[i], &division.workers);
                instants.forces(share, state, workspace, (forces, own), workers)
            },
        )?;
        for (value, scale) in out.iter_mut().zip(&self.row_scale) {
            *value *= scale;
        }
        Ok(())
    }
}
