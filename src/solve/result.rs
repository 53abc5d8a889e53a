//! What a solve gives.

use super::adaptive::GridTried;
use super::estimate::Assessment;
use super::iterative::IterativeRecord;
use super::newton::{NewtonReport, Timings};
use super::starts::Attempt;
use super::trajectory::MarchRecord;
use crate::collocation::GridState;
use crate::elements::NodeState;
use crate::fourier::TimeGrid;
use crate::system::System;
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
