//! The report of a solve as JSON, for programs.

use super::solution::Solution;
use crate::collocation::DecayKind;
use crate::solve::{Attempt, GridTried, IterativeRecord, Kind, Timings};
use serde_json::{Value, json};

/// The name of a variant, as `ToleranceNotMet`, in the form `tolerance_not_met`.
fn snake_case(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !text.is_empty() {
            text.push('_');
        }
        text.extend(c.to_lowercase());
    }
    text
}

impl Solution {
    /// What [`Solution::report`] says, as JSON in UTF-8: an object with `kind`, `outcome` and
    /// `explanation`, sizes, `grids` and `attempts`, the Newton `iterations`, `estimates`, `linear`
    /// equations, `seconds`, and the `report` itself. What is not known, or does not apply, is
    /// null. Numbers have the names and units of `pdn_diagnostics`.
    pub fn report_json(&self) -> String {
        let solve = self.details();
        let periodic = solve.periodic();
        let kind = match &solve.kind {
            Kind::Periodic(_) => "periodic",
            Kind::Equilibrium { .. } => "static",
            Kind::SmallMotion => "small_motion",
            Kind::March(_) => "march",
            Kind::Shooting { .. } => "shooting",
        };
        let outcome = snake_case(&format!("{:?}", self.outcome()));
        let iterations = solve.report.iterations.iter().map(|i| {
            json!({
                "number": i.number,
                "residual": i.residual,
                "increment": i.increment,
                "step": i.step,
            })
        });
        json!({
            "kind": kind,
            "outcome": outcome,
            "is_solution": self.outcome().is_solution(),
            "explanation": self.model().labels().annotate(&solve.report.explanation),
            "period": solve.grid.period(),
            "grid_points": solve.state.points(),
            "nodes": solve.system.nodes(),
            "unknowns": self.unknowns(),
            "redundant_constraints": solve.system.redundant_constraints(),
            "grids": periodic.map(|record| record.grids.iter().map(of_grid).collect::<Value>()),
            "attempts": periodic.map(|p| p.attempts.iter().map(of_attempt).collect::<Value>()),
            "guess_iterations": solve.guess_iterations,
            "total_iterations": solve.total_iterations,
            "iterations": iterations.collect::<Value>(),
            "estimates": self.estimates(),
            "linear": periodic.and_then(|p| p.iterative.as_ref()).map(of_linear),
            "seconds": {
                "guess": solve.guess_time.as_secs_f64(),
                "parts": of_times(&solve.timings),
                "total": solve.total_time.as_secs_f64(),
            },
            "report": self.report(),
        })
        .to_string()
    }

    fn estimates(&self) -> Value {
        let told = self.diagnostics();
        json!({
            "error_estimate": told.error_estimate,
            "mesh_error": told.mesh_error,
            "force_residual_between": told.between.force,
            "constraint_residual_between": told.between.constraint,
            "decay": match told.decay {
                DecayKind::Unknown => None,
                kind => Some(snake_case(&format!("{kind:?}"))),
            },
            "decay_order": told.decay_order,
            "least_resolved_time": told.least_resolved_time,
            "harmonics": told.harmonics,
        })
    }
}

fn of_grid(grid: &GridTried) -> Value {
    json!({
        "grid_points": grid.points,
        "iterations": grid.iterations,
        "error_estimate": grid.error_estimate,
    })
}

fn of_attempt(attempt: &Attempt) -> Value {
    json!({
        "start": snake_case(&format!("{:?}", attempt.start)),
        "grid_points": attempt.points,
        "guess_iterations": attempt.guess_iterations,
        "iterations": attempt.iterations,
        "seconds": attempt.time.as_secs_f64(),
        "outcome": snake_case(&format!("{:?}", attempt.outcome)),
        "explanation": attempt.explanation,
    })
}

fn of_linear(record: &IterativeRecord) -> Value {
    json!({
        "preconditioner": record.preconditioner.map(|p| p.name()),
        "products": record.products,
        "factorisations": record.factorisations,
        "bytes": record.bytes,
    })
}

fn of_times(times: &Timings) -> Value {
    json!({
        "assembly": times.assembly.as_secs_f64(),
        "analysis": times.analysis.as_secs_f64(),
        "factorisation": times.factorisation.as_secs_f64(),
        "preconditioner": times.preconditioner.as_secs_f64(),
        "interface": times.interface.as_secs_f64(),
        "substitution": times.substitution.as_secs_f64(),
        "estimates": times.estimates.as_secs_f64(),
    })
}

#[cfg(test)]
mod tests {
    use super::snake_case;

    #[test]
    fn names_are_in_snake_case() {
        assert_eq!(snake_case("ToleranceNotMet"), "tolerance_not_met");
        assert_eq!(snake_case("Fast"), "fast");
    }
}
