//! What a file holds of a solution, and whether it fits together.

use super::diagnostics::Diagnostics;
use super::solution::Solution;
use super::version::Saved;
use crate::collocation::GridState;
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::{SharpEvent, SpectralFilter, TimeGrid, TimeMap};
use crate::model::Model;
use crate::quantity::ForceRecord;
use crate::solve::{
    Attempt, GridTried, IterativeRecord, Kind, MarchRecord, NewtonReport, PeriodicRecord, Solved,
    Timings,
};
use crate::system::{Regime, Standstill, System, Transient};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

/// All that a solution is made of. What some kinds of solutions do not have is empty.
#[derive(Serialize, Deserialize)]
pub(super) struct Content<'a> {
    model: Cow<'a, Model>,
    period: f64,
    grid_points: usize,
    standstill: Option<Standstill>,
    state: Cow<'a, GridState>,
    node_states: Cow<'a, [NodeState]>,
    report: Cow<'a, NewtonReport>,
    guess_iterations: usize,
    guess_time: Duration,
    timings: Timings,
    #[serde(default)]
    total_time: Duration,
    #[serde(default)]
    total_iterations: usize,
    prescribed_start: Cow<'a, [f64]>,
    diagnostics: Cow<'a, Diagnostics>,
    forces: Cow<'a, [Result<ForceRecord>]>,
    #[serde(default)]
    grids: Cow<'a, [GridTried]>,
    #[serde(default)]
    coarse_start: Option<GridTried>,
    #[serde(default)]
    filter: Option<SpectralFilter>,
    #[serde(default)]
    iterative: Option<Cow<'a, IterativeRecord>>,
    /// Of a trajectory.
    #[serde(default)]
    march: Option<SavedMarch<'a>>,
    #[serde(default)]
    transient: Option<Transient>,
    #[serde(default)]
    attempts: Cow<'a, [Attempt]>,
    /// Of a mapped grid.
    #[serde(default)]
    sharp_events: Vec<SharpEvent>,
}

impl Saved for Content<'_> {
    fn model(&self) -> &Model {
        &self.model
    }
}

#[derive(Serialize, Deserialize)]
struct SavedMarch<'a> {
    #[serde(flatten)]
    record: Cow<'a, MarchRecord>,
    /// Whether it is that of a shooting solve.
    #[serde(default)]
    shooting: bool,
    /// Of a shooting solve.
    #[serde(default)]
    floquet: Cow<'a, [[f64; 2]]>,
}

impl<'a> SavedMarch<'a> {
    fn of(kind: &'a Kind) -> Option<Self> {
        let (record, shooting, floquet) = match kind {
            Kind::March(record) => (record, false, &[][..]),
            Kind::Shooting { march, floquet } => (march, true, &floquet[..]),
            Kind::Periodic(_) | Kind::Equilibrium { .. } | Kind::SmallMotion => return None,
        };
        Some(SavedMarch {
            record: Cow::Borrowed(record),
            shooting,
            floquet: Cow::Borrowed(floquet),
        })
    }

    fn into_kind(self) -> Result<Kind> {
        let march = self.record.into_owned();
        let ascending = march.times.windows(2).all(|pair| pair[0] < pair[1]);
        let known = march.times.iter().all(|t| t.is_finite());
        require(ascending && known && !march.times.is_empty(), "times")?;
        Ok(match self.shooting {
            true => Kind::Shooting {
                march,
                floquet: self.floquet.into_owned(),
            },
            false => Kind::March(march),
        })
    }
}

pub(super) fn require(holds: bool, what: &str) -> Result<()> {
    holds.then_some(()).ok_or_else(|| misfit(what))
}

fn misfit(what: &str) -> Error {
    let message = format!("{what}: not as many as its model and grid need");
    Error::new(ErrorKind::Format, message)
}

impl<'a> Content<'a> {
    pub fn of(solution: &'a Solution) -> Self {
        let solve = &solution.solve;
        let periodic = solve.periodic();
        Content {
            model: Cow::Borrowed(&solution.model),
            period: solve.grid.period(),
            grid_points: solve.grid.points(),
            standstill: solve.system.standstill().copied(),
            transient: match solve.system.regime() {
                Regime::March(transient) => Some(*transient),
                Regime::Periodic(_) | Regime::Standstill(_) => None,
            },
            state: Cow::Borrowed(&solve.state),
            node_states: Cow::Borrowed(&solve.node_states),
            report: Cow::Borrowed(&solve.report),
            guess_iterations: solve.guess_iterations,
            guess_time: solve.guess_time,
            timings: solve.timings,
            total_time: solve.total_time,
            total_iterations: solve.total_iterations,
            prescribed_start: Cow::Borrowed(&solution.prescribed_start),
            diagnostics: Cow::Borrowed(&solution.diagnostics),
            forces: Cow::Borrowed(&solution.forces),
            filter: solution.filter,
            grids: Cow::Borrowed(periodic.map_or(&[], |record| &record.grids)),
            coarse_start: periodic.and_then(|record| record.coarse_start),
            attempts: Cow::Borrowed(periodic.map_or(&[], |record| &record.attempts)),
            iterative: periodic.and_then(|record| record.iterative.as_ref().map(Cow::Borrowed)),
            march: SavedMarch::of(&solve.kind),
            sharp_events: solve.grid.map().events(solve.grid.period()),
        }
    }

    /// What the model was made ready for.
    fn regime(&self) -> Result<Regime> {
        Ok(match (self.standstill, self.transient) {
            (None, None) => Regime::Periodic(self.period),
            (_, Some(transient)) => {
                transient.validate()?;
                Regime::March(transient)
            }
            (Some(standstill), None) => {
                require_finite("time", &[standstill.time])?;
                require_finite("angular velocity", standstill.angular_velocity.as_slice())?;
                require_finite("axis", standstill.axis_point.as_slice())?;
                Regime::Standstill(standstill)
            }
        })
    }

    /// Takes out what only solutions of its kind have.
    fn take_kind(&mut self, regime: &Regime) -> Result<Kind> {
        let march = self.march.take();
        Ok(match (regime, march) {
            (Regime::March(_), Some(march)) => march.into_kind()?,
            (Regime::March(_), None) | (_, Some(_)) => return Err(misfit("steps")),
            (Regime::Standstill(_), None) if self.grid_points == 1 => Kind::Equilibrium {
                mesh_error: self.diagnostics.mesh_error,
            },
            (Regime::Standstill(_), None) => Kind::SmallMotion,
            (Regime::Periodic(_), None) => Kind::Periodic(PeriodicRecord {
                grids: std::mem::take(&mut self.grids).into_owned(),
                coarse_start: self.coarse_start,
                attempts: std::mem::take(&mut self.attempts).into_owned(),
                iterative: self.iterative.take().map(Cow::into_owned),
                threads: 1,
                assessment: None,
                mesh_error: self.diagnostics.mesh_error,
            }),
        })
    }

    /// The solution, if everything in it fits together.
    pub fn into_solution(mut self) -> Result<Solution> {
        let regime = self.regime()?;
        let kind = self.take_kind(&regime)?;
        let model = self.model.into_owned().checked()?;
        model.require_grid_points("grid_points", self.grid_points)?;
        let solve = Solved {
            system: Arc::new(System::of_known_solution(&model, regime)?),
            grid: TimeGrid::even_or_odd(self.grid_points, self.period)?
                .mapped(TimeMap::new(&self.sharp_events, self.period)?),
            state: self.state.into_owned(),
            node_states: self.node_states.into_owned(),
            report: self.report.into_owned(),
            guess_iterations: self.guess_iterations,
            guess_time: self.guess_time,
            timings: self.timings,
            total_time: self.total_time,
            total_iterations: self.total_iterations,
            kind,
        };
        let mut solution = Solution {
            model,
            solve,
            prescribed_start: self.prescribed_start.into_owned(),
            diagnostics: self.diagnostics.into_owned(),
            forces: self.forces.into_owned(),
            filter: self.filter,
            multipliers: OnceLock::new(),
        };
        solution.require_sizes()?;
        Ok(solution)
    }
}

impl Solution {
    /// Checks that all is as long as model and grid need.
    fn require_sizes(&mut self) -> Result<()> {
        let Solved {
            system,
            grid,
            state,
            node_states,
            kind,
            ..
        } = &mut self.solve;
        let (points, harmonics) = match kind {
            Kind::March(march) | Kind::Shooting { march, .. } => {
                require(grid.points() == 1, "grid points")?;
                (march.times.len(), 0)
            }
            Kind::Periodic(_) | Kind::Equilibrium { .. } | Kind::SmallMotion => {
                (grid.points(), grid.harmonics() + 1)
            }
        };
        let fits = |length: usize, count: usize| count.checked_mul(points) == Some(length);
        require(state.points() == points, "grid points")?;
        require(fits(state.motions.len(), system.nodes()), "motions")?;
        require(fits(node_states.len(), system.nodes()), "states of nodes")?;
        let multipliers = state.multipliers.len();
        require(fits(multipliers, system.own_unknowns()), "multipliers")?;
        // Older files have those only that forces act on.
        state.complete_tracked(system, system.acted_on());
        let coordinates = state.coordinates.len();
        require(fits(coordinates, system.tracked()), "coordinates")?;
        let starts = self.prescribed_start.len();
        require(
            starts == self.model.prescribed.len(),
            "prescribed coordinates",
        )?;
        require(self.diagnostics.harmonics.len() == harmonics, "harmonics")?;
        self.diagnostics.require_told()?;
        require(self.forces.len() == self.model.forces.len(), "forces")?;
        for record in self.forces.iter().flatten() {
            require(record.fits(points), "values of forces")?;
        }
        Ok(())
    }
}
