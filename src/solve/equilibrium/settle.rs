//! Looking for an equilibrium downhill, where Newton's method and load steps find none.
//! See docs/theory.md, section 11.1.

use crate::collocation::{Backward, BackwardWeights, Conditions, Spectral};
use crate::error::Result;
use crate::solve::report::{NewtonOptions, Outcome};
use crate::solve::starts::tracker::Tracker;
use crate::solve::step_length::StepLength;
use crate::system::System;

/// Steps at most.
const MOST_STEPS: usize = 400;
/// Largest increment of the last step.
const SETTLED: f64 = 1e-7;
/// A step that needs at most so many iterations is doubled.
const EASY_ITERATIONS: usize = 5;
/// Shortest step relative to the first.
const SHORTEST: f64 = 2.5e-7;
/// What a step that fails is shortened to.
const RETREAT: f64 = 0.25;
/// Factor between the first step, of the order of the fastest motion, and the smallest that may
/// end.
const LONG: f64 = 10.0;

const NEWTON: NewtonOptions = NewtonOptions {
    tolerance: 1e-6,
    iteration_limit: 12,
};

impl Tracker<'_> {
    /// Whether something holds the reference configuration when no loads act.
    pub(crate) fn is_held(&mut self) -> Result<bool> {
        self.newton.equations.set_conditions(Conditions {
            load_factor: 0.0,
            ..Conditions::at(0.0)
        })?;
        let mut state = self.state.clone();
        let report = self.newton.solve(&mut state, &NEWTON, self.observe)?;
        if report.outcome == Outcome::Cancelled {
            self.failure = Some((report.outcome, report.explanation));
        }
        Ok(report.outcome != Outcome::Singular)
    }

    /// Lets the masses creep under the full loads: each step of `h` is an equilibrium with the
    /// resistance `M Δu / h²`, so that energy is lost in each; steps grow as long as they are easy.
    ///
    /// `false`, with the state unchanged, if nothing settles: without inertia, under loads that
    /// nothing resists, or when cancelled, which is then the failure.
    pub(crate) fn settle(&mut self, system: &System) -> Result<bool> {
        let scales = system.scales();
        if scales.mass <= 0.0 || self.was_cancelled() {
            return Ok(false);
        }
        self.newton.equations.set_conditions(Conditions::at(0.0))?;
        let first_step = (scales.mass * scales.length / scales.force).sqrt();
        let range = SHORTEST * first_step..=f64::INFINITY;
        let mut step = StepLength::shortened(first_step, range, RETREAT);
        let mut state = self.state.clone();
        let mut settled = false;
        for _ in 0..MOST_STEPS {
            let weight = 1.0 / (step.get() * step.get());
            let weights = BackwardWeights {
                first: [0.0; 4],
                second: [weight, -weight, 0.0, 0.0],
            };
            let rule = Backward::new(weights, vec![state.clone()]);
            self.newton.equations.set_rule(Box::new(rule));
            let mut next = state.clone();
            match self.newton.solve(&mut next, &NEWTON, self.observe) {
                Ok(report) if report.outcome == Outcome::Converged => {
                    let moved = next.distance(&state, scales.length);
                    state = next;
                    if moved < SETTLED && step.get() >= LONG * first_step {
                        settled = true;
                        break;
                    }
                    if report.iterations.len() <= EASY_ITERATIONS {
                        step.grow(step.get(), 2.0);
                    }
                }
                Ok(report) if report.outcome == Outcome::Cancelled => {
                    self.failure = Some((report.outcome, report.explanation));
                    break;
                }
                _ if step.shrink(step.get()) => {}
                _ => break,
            }
        }
        let equations = &mut self.newton.equations;
        equations.set_rule(Box::new(Spectral::new(equations.grid(), system.nodes())));
        if settled {
            self.state = state;
        }
        Ok(settled)
    }

    pub(crate) fn was_cancelled(&self) -> bool {
        (self.failure.as_ref()).is_some_and(|(outcome, _)| outcome.is_stopped())
    }
}
