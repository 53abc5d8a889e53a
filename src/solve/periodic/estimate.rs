//! How far the motions of a periodic solution are from those that any finer grid would give.
//! See docs/theory.md, section 10.3.

use super::Periodic;
use super::waves::{LeftOut, Waves};
use crate::collocation::{Decay, DecayKind, Defect, GridState, Leaders, ResidualBetween};
use crate::error::{ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::newton::Newton;
use crate::solve::report::{Iteration, NewtonReport, Outcome};
use crate::solve::result::{Assessment, Solved, Unheld};
use crate::system::System;
use crate::workers::Workers;
use std::sync::Arc;
use std::time::Instant;

/// The harmonics of a load that are named are those that leave this fraction of the error.
const MOST: f64 = 0.1;
/// So many times the error that is accepted calls for a finer grid, whatever else adds to it.
const FAR: f64 = 10.0;
/// Residuals so small are rounding.
const BALANCED: f64 = 1e-9;

/// Assesses a solution on a grid by its harmonics and constraints alone; from those of what leads,
/// if blades move alike in it.
///
/// # Errors
/// That of a callback.
pub(crate) fn assess(
    system: &System,
    grid: TimeGrid,
    (state, leaders): (&GridState, Option<&Leaders>),
    workers: &Workers,
) -> Result<(Assessment, Option<Defect>)> {
    let decay = Decay::of_leaders(system, grid, (state, leaders));
    let defect = match Defect::of(system, grid, (state, leaders), workers) {
        Ok(defect) => Some(defect),
        // What cannot be interpolated, or is distorted between points, is no failure of the call.
        Err(e) if matches!(e.kind(), ErrorKind::GridTooCoarse | ErrorKind::Model) => None,
        Err(e) => return Err(e),
    };
    let unknown = ResidualBetween::unknown();
    let between = defect.as_ref().map_or(unknown, |defect| defect.largest);
    // A static solution tells nothing of what is driven in time.
    let error = if grid.points() > 1 {
        decay.tail.max(between.constraint)
    } else if varies(system, grid)? {
        f64::INFINITY
    } else {
        0.0
    };
    let assessment = Assessment {
        unheld: None,
        resounding: None,
        decay,
        between,
        error,
    };
    Ok((assessment, defect))
}

/// How far the motions are from those by beam elements of a higher degree: positions relative to
/// the characteristic length, and angles. Zero without beams and shells; infinite where it cannot
/// be had, as with shells.
///
/// Forces by which the equations of the nodes are wrong turn into motions by the linearised
/// equations, that were solved last.
///
/// # Errors
/// That of a callback.
pub(crate) fn mesh_error<L: LinearSolver>(
    model: &Model,
    newton: &mut Newton<L>,
    state: &GridState,
) -> Result<f64> {
    if !model.shells.is_empty() {
        return Ok(f64::INFINITY);
    }
    if model.beams.is_empty() {
        return Ok(0.0);
    }
    let system = newton.equations.system().clone();
    newton.equations.update_kinematics(state);
    let left = model.raised(system.beams()).and_then(|(fine, between)| {
        let fine = System::in_regime(&fine, *system.regime())?;
        newton
            .equations
            .left_by_mesh(state, Arc::new(fine), &between)
    });
    let mut left = match left {
        Ok(left) if left.iter().all(|x| x.is_finite()) => left,
        // What cannot be interpolated, or overflows, is no failure of the call.
        Ok(_) => return Ok(f64::INFINITY),
        Err(e) if e.kind() == ErrorKind::Callback => return Err(e),
        Err(_) => return Ok(f64::INFINITY),
    };
    Ok(newton.response(&mut left)?.unwrap_or(f64::INFINITY))
}

/// What the last step of Newton's method leaves, from its last two increments.
fn left_by_newton(iterations: &[Iteration]) -> f64 {
    match iterations {
        [] => 0.0,
        [only] => only.increment,
        [.., before, last] => last.increment * (last.increment / before.increment).min(1.0),
    }
}

impl Periodic<'_> {
    /// Assesses a converged solution on the present grid, where the equations have been solved
    /// last; multipliers become those of least norm.
    ///
    /// What is left of the equations between grid points is what the grid has taken for its own
    /// harmonics, and what it has left out, which is as much. The linearised equations turn the one
    /// into motions at the grid points; the other is above the harmonics of the grid: the mechanism
    /// hardly moves during such a wave, and it is enough to look at one on its own.
    pub(super) fn assess(
        &mut self,
        state: &mut GridState,
        report: &NewtonReport,
    ) -> Result<Assessment> {
        let (began, before) = (Instant::now(), self.on.newton.timings.sum());
        self.on.newton.linear.release();
        let found = self.estimate(state, report);
        // What the solutions of linear equations have not booked.
        let booked = self.on.newton.timings.sum() - before;
        self.on.newton.timings.estimates += began.elapsed().saturating_sub(booked);
        found
    }

    fn estimate(&mut self, state: &mut GridState, report: &NewtonReport) -> Result<Assessment> {
        let sampled = self.on.newton.equations.oversampled().is_none();
        if sampled {
            self.on.newton.update_kinematics(state);
            // Between grid points, what has no effect at them may have some.
            self.on.newton.equations.reduce_to_least_norm(state)?;
        }
        let (system, workers) = (self.on.system.clone(), self.on.means.workers.clone());
        let alike = self.on.newton.alike.clone();
        let of = (&*state, alike.as_deref());
        let (mut found, defect) = assess(&system, self.on.grid, of, &workers)?;
        if let (Some(mut defect), true) = (defect, sampled && self.on.grid.points() > 1) {
            defect.carry_resultants(&mut self.on.newton.equations, alike.as_deref())?;
            let mut aliased = defect.aliased(&self.on.newton.equations);
            let aliased = self.on.newton.response(&mut aliased)?;
            let mut waves = Waves::new(&self.on.newton.equations, state)?;
            let left_out = match aliased {
                Some(error) if self.is_far(error) => Some(LeftOut::like(error)),
                Some(aliased) => waves.left_out(&defect, aliased, self.accepted)?,
                None => None,
            };
            if let (Some(mut aliased), Some(mut left_out)) = (aliased, left_out) {
                // Of loads, harmonics of pseudo-time are not known; what the grid takes for others
                // shows between its points.
                let equispaced = self.on.grid.map().is_identity();
                if equispaced && self.loads.has_above(self.on.grid.whole_harmonics()) {
                    let low = self.unheld(state)?;
                    let high = waves.unheld(&defect, &self.loads)?;
                    if let Some((low, high)) = low.zip(high) {
                        aliased = aliased.max(low);
                        left_out.error = left_out.error.max(high);
                        found.unheld = self.name_unheld(low + high);
                    }
                }
                found.error = (aliased + left_out.error).max(found.between.constraint);
                found.resounding = left_out.resounding;
            }
            // Harmonics that do not fall, but which the loads have, and the grid resolves.
            let balanced = found.between.force.max(found.between.constraint) < BALANCED;
            if balanced && found.decay.kind == DecayKind::Slow {
                found.decay.kind = DecayKind::Fast;
            }
        }
        found.error += left_by_newton(&report.iterations);
        self.assessed = Some((self.on.grid, found.clone()));
        Ok(found)
    }

    /// Whether an error calls for a finer grid, which tells more than a close look at this one, and
    /// there will be one.
    fn is_far(&self, error: f64) -> bool {
        self.on.grid.points() < self.finest && error > FAR * self.accepted
    }

    /// Motions by what the grid takes the harmonics of the loads for that it cannot hold.
    fn unheld(&mut self, state: &GridState) -> Result<Option<f64>> {
        let equations = &mut self.on.newton.equations;
        let (mut full, mut held) = (vec![0.0; equations.size()], vec![0.0; equations.size()]);
        equations.residual(state, &mut full)?;
        let signals = equations.signals().to_vec();
        let (count, harmonics) = (self.on.system.signals(), self.on.grid.whole_harmonics());
        let mut without = signals.clone();
        let mut rest = vec![0.0; count];
        for (values, time) in without.chunks_exact_mut(count).zip(self.on.grid.times()) {
            self.loads.rest(time, harmonics, &mut rest);
            values
                .iter_mut()
                .zip(&rest)
                .for_each(|(x, rest)| *x -= rest);
        }
        equations.set_signals(&without);
        let evaluated = equations.residual(state, &mut held);
        equations.set_signals(&signals);
        evaluated?;
        full.iter_mut()
            .zip(&held)
            .for_each(|(full, held)| *full -= held);
        self.on.newton.response(&mut full)
    }

    /// The signal that needs the finest grid, to get rid of most of this error.
    fn name_unheld(&self, error: f64) -> Option<Unheld> {
        let (signal, harmonic) = self.loads.needed(self.on.grid.whole_harmonics(), MOST)?;
        Some(Unheld {
            place: self.on.system.signal_place(signal).to_string(),
            harmonic,
            error,
        })
    }

    /// Which harmonics the grid cannot hold, if much of the error is theirs.
    pub(super) fn describe_unheld(&self) -> Option<String> {
        let (_, found) = self.assessed.as_ref()?;
        let unheld = found.unheld.as_ref()?;
        let counts = unheld.error > BALANCED && unheld.error > 0.1 * found.error;
        counts.then(|| {
            format!(
                "{} has harmonics up to {}, which take at least {} grid points: {} take them for \
                 lower ones, an error of about {:.1e}",
                unheld.place,
                unheld.harmonic,
                2 * unheld.harmonic + 1,
                self.on.grid.points(),
                unheld.error
            )
        })
    }
}

impl Solved {
    /// Assesses the state where the solve ended: of the best estimate that there is.
    ///
    /// # Errors
    /// That of a callback.
    pub fn assess(&self) -> Result<Assessment> {
        let record = self.periodic();
        let mut assessment = match record.and_then(|record| record.assessment.as_ref()) {
            Some(assessment) => assessment.clone(),
            None => {
                let threads = record.map_or(1, |record| record.threads);
                // Without more threads than one it takes longer: no reason to lose the solution.
                let workers = Workers::new(threads).unwrap_or_default();
                assess(&self.system, self.grid, (&self.state, None), &workers)?.0
            }
        };
        let last = record.and_then(|record| record.grids.last());
        assessment.error = match (self.report.outcome, last) {
            (Outcome::Converged | Outcome::ToleranceNotMet, Some(tried)) => tried.error_estimate,
            (Outcome::Converged, None) => assessment.error,
            _ => f64::INFINITY,
        };
        Ok(assessment)
    }
}

/// Whether anything drives the system in time.
fn varies(system: &System, grid: TimeGrid) -> Result<bool> {
    if system.calls_functions() {
        // Which may depend on time.
        return Ok(true);
    }
    const SAMPLES: usize = 8;
    let values = |k: usize| -> Result<Vec<f64>> {
        let time = grid.period() * (k as f64 / SAMPLES as f64);
        let mut values = vec![0.0; system.signals()];
        system.signal_values(time, 1.0, &mut values)?;
        Ok(values)
    };
    let start = values(0)?;
    for k in 1..SAMPLES {
        if values(k)? != start {
            return Ok(true);
        }
    }
    Ok(false)
}
