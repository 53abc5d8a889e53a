//! Residual and Jacobian of the governing equations at all grid points, eq. (37).

use super::aliasing::Aliasing;
use super::kinematics::{BackwardRule, NodeKinematics};
use super::oversampled::Oversampled;
use super::pattern::Pattern;
use super::state::GridState;
use super::step::{AlphaStep, GivenRates};
use crate::elements::{Contribution, Measure, NodeState, Unknown};
use crate::error::Result;
use crate::fourier::{Differentiation, TimeGrid};
use crate::motion::DualMatrix;
use crate::system::{Conditions, OwnValues, Placed, System, Workspace};
use crate::workers::Workers;
use nalgebra::{Matrix6, Vector6};
use std::ops::Range;
use std::sync::Arc;

/// Scaled compliance of dependent constraints in the Jacobian. Newton's method loses this factor, over
/// the compliance of the mechanism, of its quadratic convergence; rounding must be well below it.
const REGULARISATION: f64 = 1e-7;

/// The equations of a system on a grid, scaled so that they do not depend on units.
///
/// Rows of forces are divided by the characteristic force (moments also by the length), those of
/// constrained lengths by the length. Unknown displacements are in units of the length, multipliers in
/// units of the force, or the force times the length.
#[derive(Debug, Clone)]
pub struct Collocation {
    system: Arc<System>,
    grid: TimeGrid,
    pub(super) operators: Differentiation,
    pub(super) instants: Instants,
    derivatives: Derivatives,
    pub(super) kinematics: Vec<NodeKinematics>,
    forces_only: Workspace,
    pub(super) with_tangents: Workspace,
    /// Scale of each row: residuals are multiplied by it.
    pub(super) row_scale: Vec<f64>,
    /// Scale of each column: scaled unknowns times it are the unknowns.
    pub(super) column_scale: Vec<f64>,
    /// Scaled compliance of all constraints in the Jacobian, for redundant ones.
    regularisation: f64,
    workers: Workers,
    /// Where the residual is taken from instead, if not from the grid's own points.
    oversampled: Option<Box<Oversampled>>,
}

/// What velocities, accelerations and rates of internal states follow from.
#[derive(Debug, Clone)]
enum Derivatives {
    /// The motion over the grid.
    Grid,
    /// On a grid of one point: backward differences, with past states, latest first.
    Backward(BackwardRule, Vec<GridState>),
    /// On a grid of one point: a step of the generalised-α method.
    Step(AlphaStep),
    /// On a grid of one point: nothing, they are given.
    Given(GivenRates),
}

/// The system at each grid point.
#[derive(Debug, Clone)]
pub(super) struct Instants {
    system: Arc<System>,
    points: usize,
    /// Times of the grid points.
    times: Vec<f64>,
    /// Signal `s` at grid point `k`, at `k × count + s`.
    signals: Vec<f64>,
    inertia_factor: f64,
    /// Node `a` at grid point `k`, at `a N + k`.
    states: Vec<NodeState>,
    /// Rates of internal states, in the order of the multipliers; zero for these.
    rates: Vec<f64>,
    /// Stress resultants for the geometric stiffness: those of all stations at grid point 0, then 1, and so on. Empty for
    /// those of the strains.
    resultants: Vec<Vector6<f64>>,
}

impl Instants {
    /// The system.
    pub(super) fn system(&self) -> &System {
        &self.system
    }

    /// Writes the equations at a range of grid points, not scaled, in the order of those of a grid of so many points.
    fn forces(
        &self,
        range: Range<usize>,
        state: &GridState,
        workspace: &mut Workspace,
        out: &mut [f64],
    ) -> Result<()> {
        out.fill(0.0);
        let points = range.len();
        let first_constraint = 6 * points * self.system.nodes();
        for placed in self.system.elements() {
            let count = placed.element.multipliers();
            for (at, k) in range.clone().enumerate() {
                let contribution = self.evaluate(placed, k, state, workspace)?;
                for (local, &node) in placed.element.nodes().iter().enumerate() {
                    let rows = &mut out[6 * (node * points + at)..][..6];
                    for (row, force) in rows
                        .iter_mut()
                        .zip(contribution.force.rows(6 * local, 6).iter())
                    {
                        *row += force;
                    }
                }
                let first = first_constraint + placed.first_multiplier * points + count * at;
                out[first..first + count].copy_from_slice(contribution.constraint.as_slice());
            }
        }
        Ok(())
    }

    /// Puts the equations of the grid points from `first` on in their places among all.
    fn put(&self, first: usize, part: &[f64], out: &mut [f64]) {
        let nodes = (0..self.system.nodes()).map(|node| (6 * node, 6));
        let own = self.system.elements().iter().map(|placed| {
            let first = 6 * self.system.nodes() + placed.first_multiplier;
            (first, placed.element.multipliers())
        });
        let length = part.len() * self.points / out.len();
        for (place, count) in nodes.chain(own) {
            let from = &part[place * length..][..count * length];
            out[place * self.points + count * first..][..from.len()].copy_from_slice(from);
        }
    }

    /// Evaluates an element at grid point `k`.
    pub(super) fn evaluate<'w>(
        &self,
        placed: &Placed,
        k: usize,
        state: &GridState,
        workspace: &'w mut Workspace,
    ) -> Result<&'w Contribution> {
        let signal_count = self.system.signals();
        let conditions = Conditions {
            time: self.times[k],
            signals: &self.signals[k * signal_count..][..signal_count],
            coordinates: state.tracked(&self.system, k),
            inertia_factor: self.inertia_factor,
        };
        let node_state = |node: usize| self.states[node * self.points + k];
        let first_station = k * self.system.stations();
        let stations = first_station + placed.stations.start..first_station + placed.stations.end;
        let own = OwnValues {
            values: state.multipliers_of(placed, k),
            rates: &self.rates[state.first_multiplier(placed, k)..][..placed.element.multipliers()],
            resultants: self.resultants.get(stations).unwrap_or(&[]),
        };
        self.system
            .evaluate(placed, node_state, &conditions, own, workspace)
    }
}

/// Tangents summed over the elements, for each pair of nodes and grid point.
#[derive(Debug, Clone, Default)]
pub struct TangentBlocks {
    stiffness: Vec<Matrix6<f64>>,
    damping: Vec<Matrix6<f64>>,
    mass: Vec<Matrix6<f64>>,
    gammas: Vec<(DualMatrix, DualMatrix)>,
    /// Numbers of the pairs of nodes of one element.
    numbers: Vec<usize>,
    /// `∂constraint/∂λ̇` of each element with internal states, column by column.
    own_rates: Vec<f64>,
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
            forces_only: system.workspace(false),
            with_tangents: system.workspace(true),
            row_scale,
            column_scale,
            oversampled: None,
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
        self.workers = workers;
    }

    /// The threads that share work.
    pub fn workers(&self) -> &Workers {
        &self.workers
    }

    /// The threads that may evaluate elements.
    pub(super) fn element_workers(&self) -> Workers {
        self.system.element_workers(&self.workers)
    }

    /// The grid.
    pub fn grid(&self) -> TimeGrid {
        self.grid
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

    /// Moves the grid's first point to time `start`, with the fraction `load_factor` of all loads and
    /// prescribed motions.
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

    /// From now on takes the residual from `factor` times as many points, projected on the harmonics of this grid.
    /// The Jacobian that is assembled remains that of the grid's own points.
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

    /// From now on takes geometric stiffness at the stress resultants that follow from those at `state` in proportion to
    /// the unscaled `increment` of the unknowns.
    ///
    /// After an increment that turns beams much, those of the strains have little to do with equilibrium: second-order
    /// stretching, times axial stiffness. These are in equilibrium, as the linear equations were.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn extrapolate_resultants(&mut self, state: &GridState, increment: &[f64]) -> Result<()> {
        self.update_kinematics(state);
        let (points, stations) = (self.grid.points(), self.system.stations());
        let mut all = vec![Vector6::zeros(); points * stations];
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
                    let increment =
                        |at: usize| Vector6::from_column_slice(&increment[6 * at..][..6]);
                    increments.extend(places.map(increment));
                    let out = &mut out[placed.stations.clone()];
                    placed
                        .element
                        .extrapolate_resultants(nodes, increments, out)?;
                }
                Ok(())
            },
        )?;
        self.instants.resultants = all;
        Ok(())
    }

    /// From now on takes geometric stiffness at the stress resultants of the strains: the tangent is exact.
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

    /// Makes the state of a grid of one point, with the node states of the last evaluation, the start of the
    /// next step.
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

    /// Gives a grid of one point its velocities and accelerations. The unknowns are then accelerations.
    pub fn set_given_rates(&mut self, given: GivenRates) {
        debug_assert_eq!(self.grid.points(), 1);
        self.derivatives = Derivatives::Given(given);
    }

    /// Sets the values of all signals on a grid of one point.
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
                let workspace = &mut self.forces_only;
                let contribution = self.instants.evaluate(placed, k, state, workspace)?;
                let first = first_constraint + placed.first_multiplier * points + count * k;
                for (row, violation) in contribution.constraint.iter().enumerate() {
                    out[first + row] = violation * self.row_scale[first + row];
                }
            }
        }
        Ok(())
    }

    /// Whether constraints may depend on each other: all have then a small compliance in the Jacobian, not
    /// in the residual, so that increments of the multipliers are those of least norm.
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

    /// What a scaled increment of multipliers, by their compliance in the Jacobian, leaves of the constraints.
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
    fn kinematic_tangent(&self, node: usize, l: usize, k: usize) -> (DualMatrix, DualMatrix) {
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
        }
    }

    /// Evaluates velocities, accelerations and rates of internal states at the grid points.
    pub fn update_kinematics(&mut self, state: &GridState) {
        self.update_rates(state);
        self.instants.states.clear();
        let shared = self.workers.threads() > 1 && matches!(self.derivatives, Derivatives::Grid);
        if shared {
            let operators = &self.operators;
            self.workers.for_each(
                &mut self.kinematics,
                &mut Vec::new(),
                || operators.clone(),
                |operators, node, kinematics| kinematics.evaluate(operators, state.node(node)),
            );
        }
        for (node, kinematics) in self.kinematics.iter_mut().enumerate() {
            let motions = state.node(node);
            match &mut self.derivatives {
                Derivatives::Backward(rule, past) => {
                    let past = past.iter().map(|state| &state.motions[node]);
                    kinematics.evaluate_backward(rule, &motions[0], past);
                }
                Derivatives::Grid if shared => {}
                Derivatives::Grid => kinematics.evaluate(&mut self.operators, motions),
                Derivatives::Step(step) => {
                    self.instants.states.push(step.evaluate(node, &motions[0]));
                    continue;
                }
                Derivatives::Given(given) => {
                    self.instants.states.push(NodeState {
                        motion: motions[0],
                        twist: given.twist[node],
                        twist_rate: given.twist_rate[node],
                    });
                    continue;
                }
            }
            for (k, motion) in motions.iter().enumerate() {
                self.instants.states.push(NodeState {
                    motion: *motion,
                    twist: kinematics.velocity(k).to_twist(),
                    twist_rate: kinematics.acceleration(k).to_twist(),
                });
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
                }
                for (k, rate) in rates.iter().enumerate() {
                    self.instants.rates[state.first_multiplier(placed, k) + row] = *rate;
                }
            }
        }
    }

    /// Takes from the multipliers the part that has no effect, where constraints depend on each other;
    /// kinematics must be those of `state`.
    pub fn reduce_to_least_norm(&self, state: &mut GridState) -> Result<()> {
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
        let workers = self.element_workers();
        if workers.threads() == 1 {
            let all = 0..points;
            self.instants
                .forces(all, state, &mut self.forces_only, out)?;
        } else {
            let length = points.div_ceil(workers.threads());
            let mut parts: Vec<Vec<f64>> = (0..points)
                .step_by(length)
                .map(|first| vec![0.0; out.len() / points * length.min(points - first)])
                .collect();
            let (instants, workspace) = (&self.instants, &self.forces_only);
            workers.try_for_each(
                &mut parts,
                &mut Vec::new(),
                || workspace.clone(),
                |workspace, i, part| {
                    let range = length * i..points.min(length * (i + 1));
                    instants.forces(range, state, workspace, part)
                },
            )?;
            for (i, part) in parts.iter().enumerate() {
                self.instants.put(length * i, part, out);
            }
        }
        for (value, scale) in out.iter_mut().zip(&self.row_scale) {
            *value *= scale;
        }
        Ok(())
    }

    /// Writes the values of the scaled Jacobian at `state`, in the order of `pattern`.
    pub fn jacobian(
        &mut self,
        state: &GridState,
        pattern: &Pattern,
        blocks: &mut TangentBlocks,
        values: &mut [f64],
    ) -> Result<()> {
        self.update_kinematics(state);
        if self.grid.points() == 1 {
            // Otherwise all are written that ever are; with given rates some are not.
            values.fill(0.0);
        }
        self.sum_elements(state, pattern, blocks, values)?;
        for node in 0..self.system.nodes() {
            self.write_node_columns(node, pattern, blocks, values);
        }
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
            for (index, placed) in self.system.elements().iter().enumerate() {
                let count = placed.element.multipliers();
                if placed.has_states {
                    continue;
                }
                for k in 0..self.grid.points() {
                    for row in 0..count {
                        values[pattern.own_value(index, k, row, count)] = -self.regularisation;
                    }
                }
            }
        }
    }

    /// Sums tangents over the elements; writes those of constraints straight into `values`.
    fn sum_elements(
        &mut self,
        state: &GridState,
        pattern: &Pattern,
        blocks: &mut TangentBlocks,
        values: &mut [f64],
    ) -> Result<()> {
        let points = self.grid.points();
        let block_count = pattern.pair_count() * points;
        let first_constraint = 6 * points * self.system.nodes();
        blocks.own_rates.clear();
        for list in [&mut blocks.stiffness, &mut blocks.damping, &mut blocks.mass] {
            list.clear();
            list.resize(block_count, Matrix6::zeros());
        }
        for (index, placed) in self.system.elements().iter().enumerate() {
            let nodes = placed.element.nodes();
            let count = placed.element.multipliers();
            let (has_mass, has_damping) = (placed.element.has_mass(), placed.element.has_damping());
            // Where rates are given inertia is all that matters of masses.
            let mass_alone = has_mass && matches!(self.derivatives, Derivatives::Given(_));
            blocks.numbers.clear();
            for &row in nodes {
                let numbers = nodes.iter().map(|&column| pattern.pair_number(row, column));
                blocks.numbers.extend(numbers);
            }
            for k in 0..points {
                let workspace = &mut self.with_tangents;
                let contribution = self.instants.evaluate(placed, k, state, workspace)?;
                for a in 0..nodes.len() {
                    for b in 0..nodes.len() {
                        let at = blocks.numbers[a * nodes.len() + b] * points + k;
                        let (i, j) = (6 * a, 6 * b);
                        if !mass_alone {
                            blocks.stiffness[at] += contribution.stiffness.fixed_view::<6, 6>(i, j);
                        }
                        if has_damping && !mass_alone {
                            blocks.damping[at] += contribution.damping.fixed_view::<6, 6>(i, j);
                        }
                        if has_mass {
                            blocks.mass[at] += contribution.mass.fixed_view::<6, 6>(i, j);
                        }
                    }
                }
                if count == 0 {
                    continue;
                }
                // Scales of the element's own rows and columns, and of the nodes'.
                let own = first_constraint + placed.first_multiplier * points + count * k;
                let own_row = |row: usize| self.row_scale[own + row];
                let own_column = |row: usize| self.column_scale[own + row];
                // Rates of internal states depend neither on accelerations nor exert forces.
                let alone = placed.has_states && matches!(self.derivatives, Derivatives::Given(_));
                let coupled = if alone { 0 } else { nodes.len() };
                for (local, &node) in nodes.iter().enumerate().take(coupled) {
                    for component in 0..6 {
                        let column = contribution.gradient.column(6 * local + component);
                        let first = pattern.constraint_value(index, local, node, k, component);
                        for (row, entry) in column.iter().enumerate() {
                            values[first + row] =
                                entry * own_row(row) * self.column_scale[component];
                        }
                    }
                    for row in 0..count {
                        let first = pattern.force_value(index, local, k, row, count);
                        for component in 0..6 {
                            values[first + component] = contribution.gradient
                                [(row, 6 * local + component)]
                                * self.row_scale[component]
                                * own_column(row);
                        }
                    }
                }
                if placed.has_states {
                    blocks
                        .own_rates
                        .extend_from_slice(contribution.own_rate.as_slice());
                    // Row ℓ is that of this grid point: ∂/∂λ_k + δ_ℓk, and D_ℓk times ∂/∂λ̇_ℓ.
                    for column in 0..count {
                        for other in 0..points {
                            let d = match &self.derivatives {
                                Derivatives::Backward(rule, _) => rule.first[0],
                                Derivatives::Grid => self.operators.first(k, other),
                                Derivatives::Step(step) => step.state_weight(),
                                Derivatives::Given(given) => given.weight,
                            };
                            let first = pattern.own_value(index, other, column, count) + count * k;
                            for row in 0..count {
                                let mut entry = d * contribution.own_rate[(row, column)];
                                if other == k && !alone {
                                    entry += contribution.own[(row, column)];
                                }
                                values[first + row] = entry * own_row(row) * own_column(column);
                            }
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Writes the columns of one node: `M Γ_a + C Γ_v`, and `K` on the diagonal in time.
    fn write_node_columns(
        &self,
        column: usize,
        pattern: &Pattern,
        blocks: &mut TangentBlocks,
        values: &mut [f64],
    ) {
        let points = self.grid.points();
        // Those of all nodes are the same.
        let scale = Matrix6::from_fn(|i, j| self.row_scale[i] * self.column_scale[j]);
        let given = match &self.derivatives {
            Derivatives::Given(given) => Some(given),
            _ => None,
        };
        let any_dense = pattern.pairs(column).any(|(_, pair)| pair.dense);
        if any_dense {
            blocks.gammas.clear();
            for k in 0..points {
                for l in 0..points {
                    blocks.gammas.push(self.kinematic_tangent(column, l, k));
                }
            }
        }
        for (number, pair) in pattern.pairs(column) {
            for k in 0..points {
                let at = number * points;
                if pair.dense {
                    for l in 0..points {
                        let (gamma_v, gamma_a) = &blocks.gammas[k * points + l];
                        let mut block = Matrix6::zeros();
                        add_product(&mut block, &blocks.mass[at + l], gamma_a);
                        add_product(&mut block, &blocks.damping[at + l], gamma_v);
                        if l == k && given.is_none_or(|given| given.elastic) {
                            block += blocks.stiffness[at + l];
                        }
                        if let Some(given) = given {
                            if given.elastic {
                                block += blocks.damping[at + l] * given.weight.sqrt();
                            }
                            if pair.row == column {
                                block += self.added_inertia(given);
                            }
                        }
                        block.component_mul_assign(&scale);
                        for component in 0..6 {
                            let first = pattern.pair_value(column, pair, k, component) + 6 * l;
                            values[first..first + 6]
                                .copy_from_slice(block.column(component).as_slice());
                        }
                    }
                } else {
                    let mut block = match given {
                        Some(given) if pair.row == column => self.added_inertia(given),
                        _ => Matrix6::zeros(),
                    };
                    if given.is_none_or(|given| given.elastic) {
                        block += blocks.stiffness[at + k];
                    }
                    block.component_mul_assign(&scale);
                    for component in 0..6 {
                        let first = pattern.pair_value(column, pair, k, component);
                        values[first..first + 6]
                            .copy_from_slice(block.column(component).as_slice());
                    }
                }
            }
        }
    }
}

impl Collocation {
    /// Writes, for a grid of one point, the scaled change of a residual with velocities and accelerations of
    /// the nodes and rates of internal states; `blocks` are those of the last Jacobian.
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
        for placed in self.system.elements().iter().filter(|p| p.has_states) {
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

    /// Inertia that is added to each node, with its factor.
    fn added_inertia(&self, given: &GivenRates) -> Matrix6<f64> {
        let (length, mass) = (self.system.scales().length, given.added_mass * given.weight);
        Matrix6::from_fn(|i, j| match (i == j, i < 3) {
            (true, true) => mass,
            (true, false) => mass * length * length,
            _ => 0.0,
        })
    }
}

/// Adds `m [P D; 0 P]`, sparing the zeros.
#[inline]
fn add_product(sum: &mut Matrix6<f64>, m: &Matrix6<f64>, gamma: &DualMatrix) {
    let (m, sum) = (&m.data.0, &mut sum.data.0);
    for j in 0..3 {
        for i in 0..3 {
            let (p, d) = (gamma.primal[(i, j)], gamma.dual[(i, j)]);
            for row in 0..6 {
                sum[j][row] += m[i][row] * p;
                sum[j + 3][row] += m[i][row] * d + m[i + 3][row] * p;
            }
        }
    }
}
