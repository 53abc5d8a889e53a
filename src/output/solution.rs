//! A periodic solution: the state at the grid points and what is needed to evaluate it anywhere.

use super::diagnostics::Diagnostics;
use crate::collocation::GridState;
use crate::error::{Error, Result};
use crate::fourier::{SpectralFilter, TimeGrid};
use crate::model::Model;
use crate::quantity::{ForceRecord, record_forces};
use crate::solve::{
    Condition, Free, Iteration, Kind, Outcome, PeriodicOptions, Solved, Stability, Stage,
    StaticOptions, solve_conditioned, solve_periodic, solve_static,
};
use crate::system::{Driven, Regime, System};
use crate::workers::Workers;
use std::sync::{Arc, OnceLock};

/// Result of a periodic or static solve or of a march, converged or not; otherwise it holds the
/// last iterate, or the march as far as it came.
///
/// A march is a trajectory: the same can be asked of it, at times of its own. Between its steps,
/// motions, velocities and joint coordinates are interpolated by cubic polynomials with the right
/// rates, all else linearly. It has no harmonics. That of a static solve has a grid of one point,
/// and the same values at any time. If the frame turns, positions and directions are those in it,
/// velocities and accelerations those in the inertial frame, resolved along its axes.
#[derive(Debug, Clone)]
pub struct Solution {
    pub(super) model: Model,
    pub(super) solve: Solved,
    /// Value of each prescribed coordinate at time zero: a signal's function is not called any
    /// more.
    pub(super) prescribed_start: Vec<f64>,
    pub(super) diagnostics: Diagnostics,
    /// Applied to what is sampled.
    pub(super) filter: Option<SpectralFilter>,
    /// What each force did: a user's function is not called any more.
    pub(super) forces: Vec<Result<ForceRecord>>,
    /// Multipliers of a periodic motion, once they were asked for.
    pub(super) multipliers: OnceLock<Stability>,
}

impl Solution {
    /// Finds the periodic response of `model`, see [`solve_periodic`].
    pub fn solve(
        model: &Model,
        period: f64,
        options: &PeriodicOptions,
        observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
    ) -> Result<Self> {
        let solution = Self::of(model, solve_periodic(model, period, options, observe)?)?;
        solution.require_periodic_forces()?;
        Ok(solution)
    }

    /// Finds a periodic response under conditions, see [`solve_conditioned`].
    pub fn solve_conditioned(
        model: &Model,
        period: f64,
        conditions: (&[Free], &[Arc<dyn Condition>]),
        options: &PeriodicOptions,
        observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
    ) -> Result<Self> {
        let (found, solve) = solve_conditioned(model, period, conditions, options, observe)?;
        let solution = Self::of(&found, solve)?;
        solution.require_periodic_forces()?;
        Ok(solution)
    }

    /// Finds an equilibrium of `model`, see [`solve_static`].
    pub fn solve_static(
        model: &Model,
        options: &StaticOptions,
        observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
    ) -> Result<Self> {
        Self::of(model, solve_static(model, options, observe)?)
    }

    /// Of what a solve gives.
    ///
    /// # Errors
    /// Those of functions of the user.
    pub(crate) fn of(model: &Model, solve: Solved) -> Result<Self> {
        let diagnostics = Diagnostics::of(&solve)?;
        let start = match solve.system.regime() {
            Regime::Periodic(_) => 0.0,
            Regime::Standstill(standstill) => standstill.time,
            Regime::March(_) => solve.times()[0],
        };
        let starts = model
            .prescribed
            .iter()
            .map(|(_, signal)| signal.bind(solve.grid.period()).value(start));
        let mut solution = Solution {
            prescribed_start: starts.collect::<Result<_>>()?,
            model: model.clone(),
            forces: Vec::new(),
            solve,
            diagnostics,
            filter: None,
            multipliers: OnceLock::new(),
        };
        let signals = solution.solve.signals()?;
        solution.forces = record_forces(&solution.history(), &signals);
        Ok(solution)
    }

    /// How the solve ended.
    pub fn outcome(&self) -> Outcome {
        self.solve.report.outcome
    }

    /// The solve: history, explanation, timings.
    pub fn details(&self) -> &Solved {
        &self.solve
    }

    /// Error estimates.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    /// The grid; of one point for an equilibrium or a trajectory.
    pub fn grid(&self) -> TimeGrid {
        self.solve.grid
    }

    /// A copy whose quantities are seen through a filter: harmonics of motions (of whose entries
    /// velocities and joint coordinates follow), of forces and of strains are weakened towards the
    /// grid's limit, in values at any time, harmonics, tables and animations. What oscillates about
    /// its value because of a kink or a narrow peak then does so near that only; the peak itself
    /// gets lower and wider.
    ///
    /// The solution itself, its diagnostics, and what starts from it, are the same. A filter that
    /// was there before is replaced.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::NotAvailable`] of a trajectory, which has no harmonics.
    pub fn filtered(&self, filter: SpectralFilter) -> Result<Self> {
        self.require_harmonics()?;
        Ok(Solution {
            filter: Some(filter),
            ..self.clone()
        })
    }

    /// The model as it was when it was solved.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Checks that `model` has the nodes and joints that this solution has.
    pub fn require_same_shape(&self, model: &Model) -> Result<()> {
        if self.model.nodes.len() == model.nodes.len() && self.is_of_mechanism(model) {
            return Ok(());
        }
        Err(Error::value(
            "options.initial",
            "a solution of a model with the same nodes, joints, forces and prescribed coordinates",
            format!(
                "one with {} nodes and {} joints, for a model with {} and {}",
                self.model.nodes.len(),
                self.model.joints.len(),
                model.nodes.len(),
                model.joints.len()
            ),
        ))
    }

    /// Whether `model` has the joints, forces, prescribed coordinates and relations that this
    /// solution has: what coordinates are followed, and what unknowns there are, follows from them.
    pub(super) fn is_of_mechanism(&self, model: &Model) -> bool {
        let mechanism = |m: &Model| {
            let kinds: Vec<_> = m.joints.iter().map(|j| j.kind).collect();
            let prescribed: Vec<_> = m.prescribed.iter().map(|(at, _)| *at).collect();
            let forces = m.forces.iter().map(|f| (f.coordinates(), f.states()));
            let forces: Vec<_> = forces.collect();
            (kinds, prescribed, forces, m.relations.len())
        };
        mechanism(&self.model) == mechanism(model)
    }

    /// This solution at the points of another grid of the same period: where a solve may start. On
    /// a grid of one point that is the start of the period. Of a trajectory it is the last period.
    /// Of an equilibrium, in steady rotation or not, what hangs on drives that turn is carried with
    /// them, if the joints let it turn as one rigid body.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::GridTooCoarse`] if a motion cannot be interpolated.
    pub fn prolonged(&self, grid: TimeGrid) -> Result<GridState> {
        match &self.solve.kind {
            Kind::March(_) | Kind::Shooting { .. } => self.last_period(grid),
            Kind::Periodic(_) | Kind::SmallMotion => self.prolonged_from(0.0, grid),
            Kind::Equilibrium { .. } => {
                let state = self.prolonged_from(0.0, grid)?;
                match (grid.points(), self.solve.system.standstill()) {
                    (1, _) | (_, None) => Ok(state),
                    (_, Some(at)) => self.carried_with_drives(at.time, state, grid),
                }
            }
        }
    }

    /// An equilibrium found with the drives as they are at this time, carried with them.
    fn carried_with_drives(
        &self,
        time: f64,
        mut state: GridState,
        grid: TimeGrid,
    ) -> Result<GridState> {
        let system = System::new(&self.model, grid.period())?;
        let Some(driven) = system.driven()?.filter(Driven::is_rigid) else {
            return Ok(state);
        };
        let (mut still, mut now) = (vec![0.0; system.signals()], vec![0.0; system.signals()]);
        system.signal_values(time, 1.0, &mut still)?;
        let points = grid.points();
        for k in 0..points {
            system.signal_values(grid.time(k), 1.0, &mut now)?;
            for node in 0..system.nodes() {
                let motion = &mut state.motions[node * points + k];
                *motion = driven.carried_between(node, motion, &still, &now);
            }
        }
        state.track_through(&system);
        Ok(state)
    }

    /// The same for a grid whose first point is at the time `start` of this solution; of a
    /// trajectory for a grid of one point only.
    pub fn prolonged_from(&self, start: f64, grid: TimeGrid) -> Result<GridState> {
        if self.is_trajectory() && grid.points() == 1 {
            return self.between_steps(start);
        }
        self.require_harmonics()?;
        let old = self.solve.grid;
        let state = &self.solve.state;
        state.resampled(
            &self.solve.system,
            old,
            start / old.period(),
            grid,
            &Workers::default(),
        )
    }
}
