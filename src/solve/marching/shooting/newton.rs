//! Newton's method on the map of one period.

use crate::error::Result;
use crate::solve::marching::shooting::period_map::{Orbit, PeriodMap};
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome};
use crate::solve::step_length::StepLength;
use crate::solve::watch::Stage;
use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};

/// Shortest step of the line search.
const SHORTEST_STEP: f64 = 1.0 / 64.0;
/// Larger increments are taken in part: displacements relative to the characteristic length,
/// radians.
const LARGEST_INCREMENT: f64 = 1.0;

/// An increment larger than this, in characteristic lengths or radians, is that of a singular
/// matrix.
const SINGULAR: f64 = 1e8;

/// Newton's method from an orbit that is not closed yet. Returns the Floquet multipliers.
pub(super) fn close(
    map: &mut PeriodMap,
    orbit: &mut Orbit,
    options: &NewtonOptions,
    report: &mut NewtonReport,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Vec<[f64; 2]>> {
    for number in 1..=options.iteration_limit {
        let miss = map.miss(orbit);
        let Some(monodromy) = map.monodromy(orbit)? else {
            report.outcome = Outcome::Singular;
            return Ok(Vec::new());
        };
        let factors = map.tangent(orbit, &monodromy).partial_piv_lu();
        let increment = solve(&factors, &miss);
        // Where the motion is not determined there may be nothing to correct.
        let probe: Vec<f64> = (0..miss.len()).map(|i| (1.0 + i as f64).sin()).collect();
        let response = solve(&factors, &probe);
        let bounded = response.iter().all(|x| x.abs() < SINGULAR);
        let size = map.norm(&increment);
        if !bounded || !increment.iter().all(|x| x.is_finite()) || size > SINGULAR {
            report.outcome = Outcome::Singular;
            report.explanation =
                "the motion is free to shift: the derivative of the period map has the eigenvalue \
                 1"
                .into();
            return Ok(map.multipliers(&monodromy));
        }
        let converged = size <= options.tolerance;
        let largest = size.max(LARGEST_INCREMENT);
        let mut step = StepLength::halved(LARGEST_INCREMENT / largest, SHORTEST_STEP..=1.0);
        let variation = map.scales.unpack(&increment);
        let accepted = loop {
            let start = orbit.starts[0].varied(&variation, step.get());
            if let Ok(next) = map.march(&start)? {
                let simplified = solve(&factors, &map.miss(&next));
                let bound = ((1.0 - 0.25 * step.get()) * size).max(options.tolerance);
                if converged || map.norm(&simplified) <= bound {
                    break Some(next);
                }
            }
            if !step.shrink(step.get()) {
                break None;
            }
        };
        let iteration = Iteration {
            number,
            residual: map.norm(&miss),
            increment: size,
            step: accepted.as_ref().map_or(0.0, |_| step.get()),
        };
        report.iterations.push(iteration);
        let keep_going = observe(Stage::Newton, &iteration);
        let Some(next) = accepted else {
            report.outcome = Outcome::Stalled;
            report.explanation = format!(
                "no step along the Newton direction brings progress; the last increment is \
                 {size:.3e}"
            );
            return Ok(map.multipliers(&monodromy));
        };
        *orbit = next;
        if converged {
            report.outcome = Outcome::Converged;
            return Ok(map.multipliers(&monodromy));
        }
        if !keep_going {
            report.outcome = Outcome::Cancelled;
            return Ok(map.multipliers(&monodromy));
        }
    }
    report.explanation = format!("not converged after {} iterations", options.iteration_limit);
    Ok(Vec::new())
}

/// Solves for the increment that makes up for a miss.
fn solve(factors: &PartialPivLu<f64>, miss: &[f64]) -> Vec<f64> {
    let rhs = Mat::from_fn(miss.len(), 1, |i, _| -miss[i]);
    factors.solve(&rhs).col_as_slice(0).to_vec()
}
