//! What a solve gives.

use crate::collocation::{Decay, GridState, ResidualBetween};
use crate::elements::NodeState;
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::linear::iterative::IterativeRecord;
use crate::solve::report::{NewtonReport, Timings};
use crate::solve::start::Attempt;
use crate::system::System;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::time::Duration;

/// Result of a solve: the last state, converged or not, and how it was reached.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The system.
    pub system: Arc<System>,
    /// The grid; of one point for an equilibrium or a trajectory.
    pub grid: TimeGrid,
    /// States at the grid points or, of a trajectory, at its times.
    pub state: GridState,
    /// Motions with their velocities and accelerations at these, node by node.
    pub node_states: Vec<NodeState>,
    /// Outcome and history of the last Newton solve: of the periodic problem, the equilibrium or
    /// the period map.
    pub report: NewtonReport,
    /// Newton iterations spent on the initial guess, each at a single instant.
    pub guess_iterations: usize,
    /// Time spent on the initial guess.
    pub guess_time: Duration,
    /// Time spent on the problem itself, by kind of work, on all grids and in all attempts.
    pub timings: Timings,
    /// Time of the whole solve: that of the guess, that by kind of work, and the little that is
    /// neither.
    pub total_time: Duration,
    /// Newton iterations on all grids and in all attempts.
    pub total_iterations: usize,
    /// What it is, and what only such a solve has.
    pub kind: Kind,
}

/// What a solve gives.
#[derive(Debug, Clone)]
pub enum Kind {
    /// A motion over the period.
    Periodic(PeriodicRecord),
    /// An equilibrium at one time, at rest or in steady rotation.
    Equilibrium {
        /// Estimated error of the motions by the mesh of beams, as [`PeriodicRecord::mesh_error`].
        mesh_error: f64,
    },
    /// A small motion about an equilibrium, in a mode.
    SmallMotion,
    /// A trajectory, from its start.
    March(MarchRecord),
    /// A trajectory over one period, at whose end the motion repeats itself.
    Shooting {
        /// The last march.
        march: MarchRecord,
        /// Real and imaginary parts of the Floquet multipliers, the largest first.
        floquet: Vec<[f64; 2]>,
    },
}

/// A grid that an adaptive solve has tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GridTried {
    /// Number of its points.
    pub points: usize,
    /// Newton iterations on it.
    pub iterations: usize,
    /// Estimated error of its solution.
    pub error_estimate: f64,
}

/// What a solution on one grid tells of its error.
#[derive(Debug, Clone, PartialEq)]
pub struct Assessment {
    /// Fall of the harmonics.
    pub decay: Decay,
    /// Residuals between grid points.
    pub between: ResidualBetween,
    /// Estimated error of the motions, positions relative to the characteristic length and entries
    /// of rotation matrices.
    pub error: f64,
    /// What harmonics of loads and prescribed motions that the grid cannot hold have to do with it.
    pub unheld: Option<Unheld>,
    /// A harmonic above those of the grid that is so near a natural frequency that a finer grid
    /// alone can tell what it adds.
    pub resounding: Option<usize>,
}

/// Harmonics that a grid cannot hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Unheld {
    /// What has them.
    pub place: String,
    /// The highest of them that counts.
    pub harmonic: usize,
    /// Estimated error that they cause.
    pub error: f64,
}

/// What only the solve of a periodic problem has.
#[derive(Debug, Clone)]
pub struct PeriodicRecord {
    /// The grids that an adaptive solve has tried, coarsest first.
    pub grids: Vec<GridTried>,
    /// The coarser grid whose solution Newton's method began at, if the library chose to.
    pub coarse_start: Option<GridTried>,
    /// Where the library began, in the order in which it tried; empty where a start was given.
    pub attempts: Vec<Attempt>,
    /// What iterative solution of linear equations took on the last grid, where it was used.
    pub iterative: Option<IterativeRecord>,
    /// Threads that shared the work, 0 for as many as there are processors.
    pub threads: usize,
    /// Of a solution: what it tells of its error.
    pub assessment: Option<Assessment>,
    /// Estimated error of the motions by the mesh of beams: positions relative to the
    /// characteristic length, and angles. Infinite where none can be had.
    pub mesh_error: f64,
}

/// What is known of a march besides its states.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MarchRecord {
    /// The times of the states kept, ascending.
    pub times: Vec<f64>,
    /// Steps taken.
    pub steps: usize,
    /// Steps that were given up for shorter ones.
    pub rejected: usize,
    /// Newton iterations over all steps.
    pub iterations: usize,
    /// Whole periods marched.
    pub periods: usize,
    /// Largest difference of motions and velocities from those one period before, as in
    /// [`MarchEnd::Periodic`](crate::solve::MarchEnd::Periodic); infinite before the end of the
    /// first.
    pub repetition: f64,
    /// Largest estimated error of a motion in one step.
    pub step_error: f64,
    /// Largest move of a motion that made the start satisfy the constraints, relative to the
    /// characteristic length, or in radians.
    pub start_moved: f64,
    /// Likewise of velocities, in the unit of time.
    pub start_corrected: f64,
}

impl MarchRecord {
    /// Of a march that has not begun.
    pub(crate) fn new() -> Self {
        MarchRecord {
            repetition: f64::INFINITY,
            ..MarchRecord::default()
        }
    }
}

impl Solved {
    /// A state, where nothing is told of how it was found but the `report`.
    pub fn known(
        system: &Arc<System>,
        grid: TimeGrid,
        (state, node_states): (GridState, Vec<NodeState>),
        report: NewtonReport,
        kind: Kind,
    ) -> Self {
        Solved {
            system: system.clone(),
            grid,
            state,
            node_states,
            total_iterations: report.iterations.len(),
            report,
            guess_iterations: 0,
            guess_time: Duration::ZERO,
            timings: Timings::default(),
            total_time: Duration::ZERO,
            kind,
        }
    }

    /// The times of the states.
    pub fn times(&self) -> Vec<f64> {
        match self.march() {
            Some(record) => record.times.clone(),
            None => self.grid.times().collect(),
        }
    }

    /// Values of all signals at these, time by time.
    ///
    /// # Errors
    /// Those of functions of the user.
    pub fn signals(&self) -> Result<Vec<f64>> {
        let (times, count) = (self.times(), self.system.signals());
        let mut values = vec![0.0; times.len() * count];
        for (k, time) in times.into_iter().enumerate() {
            let here = &mut values[k * count..][..count];
            self.system.signal_values(time, 1.0, here)?;
        }
        Ok(values)
    }

    /// Motion of a node with its velocity and acceleration, at all times.
    pub fn states_of(&self, node: usize) -> &[NodeState] {
        let points = self.state.points();
        &self.node_states[node * points..][..points]
    }

    /// What only a periodic solve has.
    pub fn periodic(&self) -> Option<&PeriodicRecord> {
        match &self.kind {
            Kind::Periodic(record) => Some(record),
            _ => None,
        }
    }

    /// How the march went that a trajectory comes from.
    pub fn march(&self) -> Option<&MarchRecord> {
        match &self.kind {
            Kind::March(march) | Kind::Shooting { march, .. } => Some(march),
            Kind::Periodic(_) | Kind::Equilibrium { .. } | Kind::SmallMotion => None,
        }
    }

    /// Estimated error of the motions by the mesh of beams; infinite where none can be had.
    pub fn mesh_error(&self) -> f64 {
        match &self.kind {
            Kind::Periodic(PeriodicRecord { mesh_error, .. })
            | Kind::Equilibrium { mesh_error } => *mesh_error,
            Kind::SmallMotion | Kind::March(_) | Kind::Shooting { .. } => f64::INFINITY,
        }
    }
}
