//! The readable report of a solve.

use super::solution::Solution;
use crate::collocation::DecayKind;
use crate::solve::{
    Attempt, Kind, MarchRecord, Outcome, PeriodicRecord, Start, describe_dependencies,
};
use std::fmt::{Result, Write};

impl Outcome {
    /// One line for people.
    pub fn describe(self) -> &'static str {
        match self {
            Outcome::Converged => "converged",
            Outcome::IterationLimit => "not converged: iteration limit reached",
            Outcome::Stalled => "not converged: Newton's method stalled",
            Outcome::Singular => "not converged: the Jacobian is singular",
            Outcome::Cancelled => "cancelled",
            Outcome::Inconsistent => "not converged: constraints contradict each other",
            Outcome::WrongAssembly => "not converged: a joint has closed turned over",
            Outcome::WorkLimit => "not converged: all work was done that is allowed",
            Outcome::ToleranceNotMet => {
                "converged on the last grid, but the error tolerance is not met"
            }
            Outcome::NoInitialGuess => "not started: no initial guess found",
        }
    }
}

/// An estimated error beyond this, relative to the size of the mechanism or in radians, is one of
/// the motion itself.
const UNRESOLVED: f64 = 0.1;

impl Solution {
    /// Outcome and why, iterations, error estimates and time spent, in readable lines.
    pub fn report(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.write_report(&mut text);
        self.model().labels().annotate(&text)
    }

    fn write_report(&self, text: &mut String) -> Result {
        let solve = self.details();
        self.write_outcome(text)?;
        self.write_sizes(text)?;
        match &solve.kind {
            Kind::Periodic(record) => write_starts(record, text)?,
            Kind::Equilibrium { .. } | Kind::SmallMotion => {}
            Kind::March(march) => write_march(march, solve.grid.period(), text)?,
            Kind::Shooting { march, floquet } => {
                write_shooting(march, floquet, solve.grid.period(), text)?;
            }
        }
        let iterations = &solve.report.iterations;
        if !iterations.is_empty() {
            writeln!(text, "  iteration   residual  increment   step")?;
        }
        for i in iterations {
            writeln!(
                text,
                "  {:9} {:10.2e} {:10.2e} {:6.3}",
                i.number, i.residual, i.increment, i.step
            )?;
        }
        if solve.march().is_none() {
            self.write_estimates(text)?;
        }
        self.write_stability(text)?;
        if let Some(record) = solve.periodic() {
            write_linear(record, text)?;
        }
        self.write_times(text)
    }

    /// What was solved, how it ended, and why.
    fn write_outcome(&self, text: &mut String) -> Result {
        let solve = self.details();
        let what = match &solve.kind {
            Kind::Periodic(_) => "Periodic solve",
            Kind::Equilibrium { .. } => "Static solve",
            Kind::SmallMotion => "Small motion",
            Kind::March(_) => "March",
            Kind::Shooting { .. } => "Shooting",
        };
        match &solve.kind {
            Kind::SmallMotion => writeln!(text, "{what}")?,
            _ => writeln!(text, "{what}: {}", self.outcome().describe())?,
        }
        let resolves = self.diagnostics().error_estimate <= UNRESOLVED;
        if solve.march().is_none() && self.outcome().is_solution() && !resolves {
            writeln!(
                text,
                "  but {} grid points resolve nothing, as the estimated error says: more are \
                 needed, or an error tolerance instead of their number",
                solve.grid.points()
            )?;
        }
        let frame = solve.system.frame_velocity();
        let time = (solve.system.standstill()).map(|s| format!("at time {}, ", s.time));
        if frame.is_some() || time.is_some() {
            let (w, time) = (frame.unwrap_or_default(), time.unwrap_or_default());
            writeln!(
                text,
                "  {time}in a frame with the angular velocity ({}, {}, {})",
                w.x, w.y, w.z
            )?;
        }
        let frame = self.model().turning_frame();
        if let Some(frame) = frame.filter(|frame| frame.advance() != 0.0) {
            writeln!(
                text,
                "  that advances by {} along its axis",
                frame.advance()
            )?;
        }
        if !solve.report.explanation.is_empty() {
            writeln!(text, "  {}", solve.report.explanation)?;
        }
        Ok(())
    }

    /// The problem's size, and constraints that depend on others.
    fn write_sizes(&self, text: &mut String) -> Result {
        let solve = self.details();
        let points = match solve.grid.points() {
            1 => String::new(),
            points => format!(
                "{points} grid points over the period {}, ",
                solve.grid.period()
            ),
        };
        writeln!(
            text,
            "  {points}{} nodes, {} unknowns",
            solve.system.nodes(),
            self.unknowns()
        )?;
        for event in solve.grid.map().events(solve.grid.period()) {
            writeln!(
                text,
                "  closer together about t = {:.6}, within {:.2e}: a share of {:.2} beside 1 for \
                 the rest",
                event.time, event.width, event.share
            )?;
        }
        let dependent = describe_dependencies(&solve.system);
        if !dependent.is_empty() && self.outcome().is_solution() {
            writeln!(
                text,
                "  {dependent}: the multipliers of least norm are given"
            )?;
        }
        Ok(())
    }

    fn write_estimates(&self, text: &mut String) -> Result {
        let diagnostics = self.diagnostics();
        writeln!(
            text,
            "  estimated error of the motions {:.1e}; between grid points: residual force {:.1e}, \
             constraints {:.1e}",
            diagnostics.error_estimate, diagnostics.between.force, diagnostics.between.constraint
        )?;
        if diagnostics.mesh_error.is_finite() && diagnostics.mesh_error > 0.0 {
            writeln!(
                text,
                "  estimated error by the mesh of beams {:.1e}",
                diagnostics.mesh_error
            )?;
        }
        if diagnostics.mesh_error.is_infinite() && diagnostics.error_estimate.is_finite() {
            let of_mesh = match self.model().shell_element_count() {
                0 => "the error by the mesh of beams is estimated if asked for (estimate_mesh)",
                _ => {
                    "the error by the mesh is not estimated, as there is no such estimate with \
                     shells: compare with a finer mesh"
                }
            };
            writeln!(text, "  these are estimates of time alone; {of_mesh}")?;
        }
        if diagnostics.decay == DecayKind::Slow {
            writeln!(
                text,
                "  harmonics fall slowly, as j^-{:.1}: a kink, or a peak too narrow for the grid, \
                 near t = {:.6}; forces may oscillate about their values",
                diagnostics.decay_order, diagnostics.least_resolved_time
            )?;
        }
        Ok(())
    }

    fn write_times(&self, text: &mut String) -> Result {
        let solve = self.details();
        let t = solve.timings;
        writeln!(
            text,
            "  time: {:.4} s for {} iterations on all grids and in all attempts, and {} of the \
             initial guess",
            solve.total_time.as_secs_f64(),
            solve.total_iterations,
            solve.guess_iterations
        )?;
        let parts = [
            ("initial guess", solve.guess_time),
            ("assembly", t.assembly),
            ("analysis", t.analysis),
            ("factorisation", t.factorisation),
            ("preconditioner", t.preconditioner),
            ("joints that turn", t.interface),
            ("substitution and iteration", t.substitution),
            ("error estimates", t.estimates),
        ];
        let parts = parts.iter().filter(|(_, time)| !time.is_zero());
        let parts: Vec<String> = parts
            .map(|(what, time)| format!("{what} {:.4} s", time.as_secs_f64()))
            .collect();
        writeln!(text, "    of it {}", parts.join(", "))
    }

    /// Number of unknowns of the periodic problem.
    pub fn unknowns(&self) -> usize {
        self.solve.system.layout(self.grid().points()).size()
    }
}

/// The grids that were tried, and where they began.
fn write_starts(record: &PeriodicRecord, text: &mut String) -> Result {
    if !record.grids.is_empty() {
        writeln!(text, "  grid points  iterations  estimated error")?;
    }
    for grid in &record.grids {
        writeln!(
            text,
            "  {:11} {:11} {:16.1e}",
            grid.points, grid.iterations, grid.error_estimate
        )?;
    }
    let is_plain = |attempt: &Attempt| attempt.start == Start::QuasiStatic;
    if record.attempts.len() > 1 || !record.attempts.iter().all(is_plain) {
        for attempt in &record.attempts {
            writeln!(text, "  start: {attempt}")?;
        }
    }
    if let Some(coarse) = &record.coarse_start {
        writeln!(
            text,
            "  start: a solution on {} grid points, after {} iterations, with an estimated error \
             of {:.1e}",
            coarse.points, coarse.iterations, coarse.error_estimate
        )?;
    }
    Ok(())
}

fn write_march(march: &MarchRecord, period: f64, text: &mut String) -> Result {
    let (first, last) = (march.times[0], march.times[march.times.len() - 1]);
    writeln!(
        text,
        "  {} steps to t = {last} ({} given up, {} iterations), kept from t = {first}; largest \
         error of a step {:.1e}",
        march.steps, march.rejected, march.iterations, march.step_error
    )?;
    writeln!(
        text,
        "  start: motions moved by {:.1e}, velocities by {:.1e} to satisfy the constraints",
        march.start_moved, march.start_corrected
    )?;
    if march.periods > 0 {
        writeln!(
            text,
            "  {} periods of {period}; the last differs from the one before by {:.1e}",
            march.periods, march.repetition
        )?;
    }
    Ok(())
}

fn write_shooting(
    march: &MarchRecord,
    floquet: &[[f64; 2]],
    period: f64,
    text: &mut String,
) -> Result {
    writeln!(
        text,
        "  {} steps over the period {period}, {} in all marches; the end differs from the start \
         by {:.1e}",
        march.times.len() - 1,
        march.steps,
        march.repetition
    )?;
    if let Some([re, im]) = floquet.first() {
        let size = re.hypot(*im);
        writeln!(text, "  largest Floquet multiplier {size:.6} in size")?;
    }
    Ok(())
}

fn write_linear(record: &PeriodicRecord, text: &mut String) -> Result {
    let Some(record) = &record.iterative else {
        return Ok(());
    };
    let by = match record.preconditioner {
        Some(preconditioner) => preconditioner.name(),
        None => "given up for factors",
    };
    writeln!(
        text,
        "  linear equations by iteration: {by}, {} products in {} solves, {:.1} MB",
        record.products.iter().sum::<usize>(),
        record.products.len(),
        1e-6 * record.bytes as f64
    )
}
