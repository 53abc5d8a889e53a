//! Residual of the governing equations at all grid points (docs/theory.md, section 5.2).

mod alike;
mod energy;
mod ground;
mod kinematics;
mod linearised;
mod momentum;
mod oversampled;
mod resultants;
mod scalars;

pub use oversampled::{Oversampled, OversampledTangent};
pub use scalars::ScalarEquations;

use super::division::Division;
use super::instants::{Instants, Wanted};
use super::like_blades::{AlikeMotions, Leaders};
use super::rule::{TimeRule, over};
use super::state::GridState;
use crate::elements::{InertialForces, NodeState};
use crate::error::Result;
use crate::fourier::{Slope, TimeGrid};
use crate::system::{Layout, System, Workspace};
use crate::workers::{Workers, parts};
use std::sync::Arc;

/// Scaled compliance of dependent constraints in the Jacobian. Newton's method loses this factor,
/// over the compliance of the mechanism, of its quadratic convergence; rounding must be well below
/// it.
const REGULARISATION: f64 = 1e-7;

/// The equations of a system on a grid, scaled so that they do not depend on units.
///
/// Rows of forces are divided by the characteristic force (moments also by the length), those of
/// constrained lengths by the length. Unknown displacements are in units of the length, multipliers
/// in units of the force, or the force times the length.
#[derive(Debug, Clone)]
pub struct Collocation {
    system: Arc<System>,
    grid: TimeGrid,
    pub(super) instants: Instants,
    pub(super) rule: Box<dyn TimeRule>,
    /// Scratch for each thread; one at least.
    forces_only: Vec<Workspace>,
    pub(super) with_tangents: Workspace,
    /// Scale of each row: residuals are multiplied by it.
    pub(super) row_scale: Vec<f64>,
    /// Scale of each column: scaled unknowns times it are the unknowns.
    pub(super) column_scale: Vec<f64>,
    /// Scaled compliance of all constraints in the Jacobian, for redundant ones.
    pub(super) regularisation: f64,
    /// Stiffness of all nodes against the ground in the scaled Jacobian.
    grounding: f64,
    /// Of one blade of several: how the rest has to move.
    alike: Option<AlikeMotions>,
    /// Where states are alike at all blades: what is evaluated of them.
    leaders: Option<Arc<Leaders>>,
    workers: Workers,
    layout: Layout,
    scalars: Option<Arc<dyn ScalarEquations>>,
    /// Values of the scalar unknowns that all else has now.
    applied: Vec<f64>,
    pub(super) division: Division,
    /// What the last linearisation found left of the equations of the grid's own points, not
    /// scaled.
    pub(super) linearised_residual: Vec<f64>,
    /// Where the residual is taken from instead, if not from the grid's own points.
    oversampled: Option<Box<Oversampled>>,
}

/// What the equations are evaluated under.
#[derive(Debug, Clone, Copy)]
pub struct Conditions {
    /// Time of the grid's first point.
    pub start: f64,
    /// Fraction of all loads and prescribed motions.
    pub load_factor: f64,
    /// How inertia counts.
    pub inertial: InertialForces,
}

impl Conditions {
    /// All loads and inertial forces, with the grid's first point at this time.
    pub fn at(start: f64) -> Self {
        Conditions {
            start,
            load_factor: 1.0,
            inertial: InertialForces::FULL,
        }
    }
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
            let count = placed.element.own_unknowns();
            for _ in 0..points {
                for row in 0..count {
                    let [row_factor, column_factor] = system.own_scales(placed.first_own + row);
                    row_scale.push(row_factor);
                    column_scale.push(column_factor);
                }
            }
        }
        let mut collocation = Collocation {
            instants: Instants {
                system: system.clone(),
                points,
                times: vec![0.0; points],
                signals: vec![0.0; system.signals() * points],
                inertial: InertialForces::FULL,
                states: Vec::new(),
                rates: vec![0.0; system.own_unknowns() * points],
                resultants: Vec::new(),
            },
            regularisation: if system.dependencies().is_empty() {
                0.0
            } else {
                REGULARISATION
            },
            rule: over(grid, system.nodes()),
            forces_only: vec![system.workspace(false)],
            with_tangents: system.workspace(true),
            row_scale,
            column_scale,
            oversampled: None,
            division: Division::new(&system, points, &Workers::default()),
            layout: system.layout(points),
            linearised_residual: Vec::new(),
            scalars: None,
            applied: Vec::new(),
            grounding: 0.0,
            alike: None,
            leaders: None,
            system,
            grid,
            workers: Workers::default(),
        };
        collocation.set_conditions(Conditions::at(0.0))?;
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

    /// Gives the same number of points another period, over which motions are differentiated.
    ///
    /// # Errors
    /// If it is none.
    pub fn set_period(&mut self, period: f64) -> Result<()> {
        self.grid = self.grid.with_period(period)?;
        self.rule = over(self.grid, self.system.nodes());
        Ok(())
    }

    /// Takes the elements and signals of another system, which has the same nodes and elements, as
    /// that of the same model with other values of its parameters.
    ///
    /// # Errors
    /// Those of signals.
    pub fn set_system(&mut self, system: Arc<System>) -> Result<()> {
        self.instants.system = system.clone();
        self.system = system;
        self.set_conditions(Conditions::at(0.0))
    }

    /// Places of the unknowns and of the equations.
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// Number of unknowns over the grid, without scalars.
    pub fn size(&self) -> usize {
        self.layout.scalars().start
    }

    /// Scale of each equation: equations times it are the scaled ones.
    pub fn row_scale(&self) -> &[f64] {
        &self.row_scale
    }

    /// Scale of each unknown: scaled unknowns times it are the unknowns.
    pub fn column_scale(&self) -> &[f64] {
        &self.column_scale
    }

    /// A multiple of a scaled increment, not scaled.
    pub fn unscaled(&self, scaled: &[f64], factor: f64) -> Vec<f64> {
        let pairs = scaled.iter().zip(&self.column_scale);
        pairs.map(|(x, s)| factor * x * s).collect()
    }

    /// Sets what the equations are evaluated under.
    ///
    /// # Errors
    /// Those of signals.
    pub fn set_conditions(&mut self, conditions: Conditions) -> Result<()> {
        let count = self.system.signals();
        self.instants.inertial = conditions.inertial;
        // Of another period signals are the same functions of the phase.
        let stretch = self.system.period() / self.grid.period();
        for k in 0..self.grid.points() {
            let values = &mut self.instants.signals[k * count..][..count];
            let time = conditions.start + self.grid.time(k) * stretch;
            self.instants.times[k] = time;
            self.system
                .signal_values(time, conditions.load_factor, values)?;
        }
        match &mut self.oversampled {
            Some(oversampled) => oversampled.fine_mut().set_conditions(conditions),
            None => Ok(()),
        }
    }

    /// Evaluates the equations at these times instead of those of the grid's points, with all loads
    /// and inertial forces.
    ///
    /// # Errors
    /// Those of signals.
    pub fn set_times(&mut self, times: &[f64]) -> Result<()> {
        let count = self.system.signals();
        self.instants.inertial = InertialForces::FULL;
        self.instants.times.copy_from_slice(times);
        for (k, &time) in times.iter().enumerate() {
            let values = &mut self.instants.signals[k * count..][..count];
            self.system.signal_values(time, 1.0, values)?;
        }
        Ok(())
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

    /// Lets velocities, accelerations and rates of internal states follow by another rule for this
    /// grid, and gives the former one.
    pub fn set_rule(&mut self, rule: Box<dyn TimeRule>) -> Box<dyn TimeRule> {
        std::mem::replace(&mut self.rule, rule)
    }

    /// The rule that they follow by.
    pub fn rule(&self) -> &dyn TimeRule {
        &*self.rule
    }

    /// How derivatives by time follow from those by pseudo-time at the grid points; none if these
    /// are the same.
    pub fn slopes(&self) -> &[Slope] {
        self.rule.over_grid().map_or(&[], |over| over.slopes)
    }

    /// Times of the grid points.
    pub fn times(&self) -> &[f64] {
        &self.instants.times
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
        self.update_kinematics(state);
        for placed in self.system.elements() {
            if placed.element.own_unknowns() == 0 || placed.has_states {
                continue;
            }
            for k in 0..points {
                let workspace = &mut self.forces_only[0];
                let contribution = self.instants.evaluate(placed, k, state, workspace)?;
                let violations = contribution.constraint.iter();
                for (row, violation) in self.layout.element_at(placed, k).zip(violations) {
                    out[row] = violation * self.row_scale[row];
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
        for placed in self.system.elements().iter().filter(|p| !p.has_states) {
            for i in self.layout.element(placed) {
                rest[i] = -self.regularisation * increment[i];
            }
        }
    }

    /// Largest violation of the constraints in a scaled residual.
    pub fn violation(&self, residual: &[f64]) -> f64 {
        let mut largest = 0.0f64;
        for placed in self.system.elements().iter().filter(|p| !p.has_states) {
            let part = &residual[self.layout.element(placed)];
            largest = part.iter().fold(largest, |m, x| m.max(x.abs()));
        }
        largest
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
                .map(|placed| state.first_own(placed, k))
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

    /// Node states over the grid, node by node, as of the last evaluation of anything.
    pub fn node_states(&self) -> &[NodeState] {
        &self.instants.states
    }

    /// Rates of internal states as of the last evaluation, in the order of the own unknowns; zero
    /// for multipliers.
    pub fn own_rates(&self) -> &[f64] {
        &self.instants.rates
    }

    /// Writes the scaled residual.
    pub fn residual(&mut self, state: &GridState, out: &mut [f64]) -> Result<()> {
        self.apply_scalars(state)?;
        let size = self.size();
        self.residual_of_grid(state, &mut out[..size])?;
        self.scalar_residual(state, out)
    }

    fn residual_of_grid(&mut self, state: &GridState, out: &mut [f64]) -> Result<()> {
        if let Some(oversampled) = &mut self.oversampled {
            return oversampled.residual(state, out);
        }
        self.update_kinematics_acted_on(state);
        match self.leaders.clone() {
            None => self.forces_where(state, out, &|_, _| true)?,
            Some(leaders) => {
                let of_elements = leaders.of_elements();
                self.forces_where(state, out, &|element, k| k < of_elements[element])?;
                let (layout, elements) = (self.layout, self.system.elements());
                leaders.repeat_forces(|node, k| layout.motion(node, k).start, out);
                leaders.repeat_own(|e, k| layout.element_at(&elements[e], k).start, out);
            }
        }
        for (value, scale) in out.iter_mut().zip(&self.row_scale) {
            *value *= scale;
        }
        Ok(())
    }

    /// Writes the equations at the present kinematics, not scaled, of elements where they are
    /// wanted.
    fn forces_where(&mut self, state: &GridState, out: &mut [f64], wanted: &Wanted) -> Result<()> {
        let points = self.grid.points();
        let system = &self.system;
        let (forces, constraints) = out.split_at_mut(self.layout.motions().end);
        let counts = system
            .elements()
            .iter()
            .map(|p| points * p.element.own_unknowns());
        let own = self.division.deal(parts(constraints, counts));
        let forces = self.division.split(forces, self.layout.of_node());
        let mut all: Vec<_> = forces.into_iter().zip(own).collect();
        let (instants, division) = (&self.instants, &self.division);
        division.workers.try_for_each(
            &mut all,
            &mut self.forces_only,
            || system.workspace(false),
            |workspace, i, (forces, own)| {
                let (share, workers) = (&division.shares[i], &division.workers);
                let asked = (wanted, workers);
                instants.forces(share, state, workspace, (forces, own), asked)
            },
        )
    }
}
