//! The readable report of a solve.

use super::solution::Solution;
use crate::collocation::DecayKind;
use crate::solve::{Attempt, Outcome, Start, describe_dependencies};
use std::fmt::Write;

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
        let solve = self.details();
        let mut text = String::new();
        // Writing to a string cannot fail.
        let mut line = |arguments: std::fmt::Arguments| {
            let _ = writeln!(text, "{arguments}");
        };
        let standstill = solve.system.standstill();
        let outcome = self.outcome().describe();
        match (standstill, &solve.march) {
            (None, Some(march)) if march.shooting => line(format_args!("Shooting: {outcome}")),
            (None, Some(_)) => line(format_args!("March: {outcome}")),
            (None, None) => line(format_args!("Periodic solve: {outcome}")),
            (Some(_), _) if solve.grid.points() == 1 => {
                line(format_args!("Static solve: {outcome}"));
            }
            (Some(_), _) => line(format_args!("Small motion")),
        }
        let resolves = || self.diagnostics().error_estimate <= UNRESOLVED;
        if solve.march.is_none() && self.outcome().is_solution() && !resolves() {
            line(format_args!(
                "  but {} grid points resolve nothing, as the estimated error says: more are \
                 needed, or an error tolerance \
                 instead of their number",
                solve.grid.points()
            ));
        }
        if let Some(standstill) = standstill {
            let w = standstill.angular_velocity;
            line(format_args!(
                "  at time {}, in a frame with the angular velocity ({}, {}, {})",
                standstill.time, w.x, w.y, w.z
            ));
        }
        if !solve.report.explanation.is_empty() {
            line(format_args!("  {}", solve.report.explanation));
        }
        let points = match solve.grid.points() {
            1 => String::new(),
            points => format!(
                "{points} grid points over the period {}, ",
                solve.grid.period()
            ),
        };
        line(format_args!(
            "  {points}{} nodes, {} unknowns",
            solve.system.nodes(),
            self.unknowns()
        ));
        let dependent = describe_dependencies(&solve.system);
        if !dependent.is_empty() && self.outcome().is_solution() {
            line(format_args!(
                "  {dependent}: the multipliers of least norm are given"
            ));
        }
        if let Some(shooting) = solve.march.as_ref().filter(|march| march.shooting) {
            line(format_args!(
                "  {} steps over the period {}, {} in all marches; the end differs from the start \
                 by {:.1e}",
                shooting.times.len() - 1,
                solve.grid.period(),
                shooting.steps,
                shooting.repetition
            ));
            if let Some([re, im]) = shooting.floquet.first() {
                let size = re.hypot(*im);
                line(format_args!(
                    "  largest Floquet multiplier {size:.6} in size"
                ));
            }
        } else if let Some(march) = &solve.march {
            let (first, last) = (march.times[0], march.times[march.times.len() - 1]);
            line(format_args!(
                "  {} steps to t = {last} ({} given up, {} iterations), kept from t = {first}; \
                 largest error of a step {:.1e}",
                march.steps, march.rejected, march.iterations, march.step_error
            ));
            line(format_args!(
                "  start: motions moved by {:.1e}, velocities by {:.1e} to satisfy the constraints",
                march.start_moved, march.start_corrected
            ));
            if march.periods > 0 {
                line(format_args!(
                    "  {} periods of {}; the last differs from the one before by {:.1e}",
                    march.periods,
                    solve.grid.period(),
                    march.repetition
                ));
            }
        } else if !solve.grids.is_empty() {
            line(format_args!("  grid points  iterations  estimated error"));
            for grid in &solve.grids {
                line(format_args!(
                    "  {:11} {:11} {:16.1e}",
                    grid.points, grid.iterations, grid.error_estimate
                ));
            }
        }
        let is_plain = |attempt: &Attempt| attempt.start == Start::QuasiStatic;
        if solve.attempts.len() > 1 || !solve.attempts.iter().all(is_plain) {
            for attempt in &solve.attempts {
                line(format_args!("  start: {attempt}"));
            }
        }
        if let Some(coarse) = &solve.coarse_start {
            line(format_args!(
                "  start: a solution on {} grid points, after {} iterations, with an estimated \
                 error of {:.1e}",
                coarse.points, coarse.iterations, coarse.error_estimate
            ));
        }
        if !solve.report.iterations.is_empty() {
            line(format_args!("  iteration   residual  increment   step"));
        }
        for i in &solve.report.iterations {
            line(format_args!(
                "  {:9} {:10.2e} {:10.2e} {:6.3}",
                i.number, i.residual, i.increment, i.step
            ));
        }
        if solve.march.is_none() {
            let diagnostics = self.diagnostics();
            line(format_args!(
                "  estimated error of the motions {:.1e}; between grid points: residual force \
                 {:.1e}, constraints {:.1e}",
                diagnostics.error_estimate,
                diagnostics.between.force,
                diagnostics.between.constraint
            ));
            if diagnostics.mesh_error.is_finite() && diagnostics.mesh_error > 0.0 {
                line(format_args!(
                    "  estimated error by the mesh of beams {:.1e}",
                    diagnostics.mesh_error
                ));
            }
            if diagnostics.mesh_error.is_infinite() && diagnostics.error_estimate.is_finite() {
                line(format_args!(
                    "  these are estimates of time alone; the error by the mesh of beams is \
                     estimated if asked for (estimate_mesh)"
                ));
            }
            if diagnostics.decay == DecayKind::Slow {
                line(format_args!(
                    "  harmonics fall slowly, as j^-{:.1}: a kink, or a peak too narrow for the \
                     grid, near t = {:.6}; forces may oscillate about their values",
                    diagnostics.decay_order, diagnostics.least_resolved_time
                ));
            }
        }
        if let Some(record) = &solve.iterative {
            let by = match record.preconditioner {
                Some(preconditioner) => preconditioner.name(),
                None => "given up for factors",
            };
            line(format_args!(
                "  linear equations by iteration: {by}, {} products in {} solves, {:.1} MB",
                record.products.iter().sum::<usize>(),
                record.products.len(),
                1e-6 * record.bytes as f64
            ));
        }
        let t = solve.timings;
        line(format_args!(
            "  time: {:.4} s for {} iterations on all grids and in all attempts, and {} of the \
             initial guess",
            solve.total_time.as_secs_f64(),
            solve.total_iterations,
            solve.guess_iterations
        ));
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
        line(format_args!("    of it {}", parts.join(", ")));
        text
    }

    /// Number of unknowns of the periodic problem.
    pub fn unknowns(&self) -> usize {
        let system = &self.solve.system;
        (6 * system.nodes() + system.multipliers()) * self.grid().points()
    }
}
