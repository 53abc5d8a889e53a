//! Strongly dissipative marching by backward differences (Houbolt's rule, spectral radius zero at
//! infinity). It serves as an initial guess only.
//! See docs/theory.md, section 9.6.

use crate::collocation::{Backward, BackwardWeights, Conditions, GridState};
use crate::error::{ErrorKind, Result};
use crate::fourier::TimeGrid;
use crate::solve::newton::Newton;
use crate::solve::report::{Iteration, NewtonOptions, Outcome};
use crate::solve::step_length::StepLength;
use crate::system::System;
use crate::workers::Workers;
use std::collections::VecDeque;
use std::sync::Arc;

/// Steps over a period at least.
const LEAST_STEPS: usize = 96;
/// Shortest steps relative to the first.
const SHORTEST: f64 = 1.0 / 8.0;
/// Motions before the present one that the rule takes.
const PAST: usize = 3;

const NEWTON: NewtonOptions = NewtonOptions {
    tolerance: 1e-6,
    iteration_limit: 20,
};

/// Houbolt's weights for steps of `h`: cubic through four motions.
fn houbolt(h: f64) -> BackwardWeights {
    let scaled = |weights: [f64; 4], by: f64| weights.map(|w| w / by);
    BackwardWeights {
        first: scaled([11.0 / 6.0, -3.0, 1.5, -1.0 / 3.0], h),
        second: scaled([2.0, -5.0, 4.0, -1.0], h * h),
    }
}

/// States over the last period, or why there are none.
pub(crate) type March = std::result::Result<GridState, (Outcome, String)>;

/// A march on its way, in steps that are finer than the grid's where they must be.
pub(crate) struct DissipativeMarch {
    system: Arc<System>,
    grid: TimeGrid,
    /// Where it starts: states over a period that lead to the first point, or everything at rest.
    start: Option<GridState>,
    newton: Newton,
    /// Relative to the first.
    step: StepLength,
    past: VecDeque<GridState>,
    /// The last period.
    before: Option<GridState>,
    /// Change of the last period from the one before.
    change: f64,
}

impl DissipativeMarch {
    /// From the first point of `start`, with the velocity that leads there, or from rest in the
    /// reference configuration.
    pub fn new(
        system: &Arc<System>,
        grid: TimeGrid,
        start: Option<&GridState>,
        workers: &Workers,
    ) -> Result<Self> {
        let mut march = DissipativeMarch {
            system: system.clone(),
            grid,
            start: start.cloned(),
            // Instants are too small to be shared.
            newton: Newton::at_instant(system, &workers.alone())?,
            step: StepLength::halved(1.0, SHORTEST..=1.0),
            past: VecDeque::new(),
            before: None,
            change: f64::INFINITY,
        };
        march.begin();
        Ok(march)
    }

    /// Steps of a grid interval.
    fn parts(&self) -> usize {
        let first = LEAST_STEPS.div_ceil(self.grid.points());
        (first as f64 / self.step.get()) as usize
    }

    /// States before the first step, latest first.
    fn begin(&mut self) {
        let (system, parts) = (&self.system, self.parts());
        let now = GridState::at_points(system, 1);
        let states = (1..=PAST).map(|steps| {
            let mut past = now.clone();
            if let Some(start) = &self.start {
                past.copy_point(system, 0, start, 0);
                let part = -(steps as f64) / parts as f64;
                for (node, motion) in past.motions.iter_mut().enumerate() {
                    let over = start.node(node);
                    let step = over[over.len() - 1].relative(&over[0]).logarithm();
                    *motion = motion.increment(&(step * part)).renormalised();
                }
                past.track(system);
            }
            past
        });
        self.past = states.collect();
        self.before = None;
        self.change = f64::INFINITY;
    }

    /// Change of the last period from the one before: motions relative to the characteristic
    /// length, or in radians.
    pub fn change(&self) -> f64 {
        self.change
    }

    /// Marches one more period; from the start again, in shorter steps, where these fail.
    pub fn go_on(&mut self, observe: &mut dyn FnMut(&Iteration) -> bool) -> Result<March> {
        loop {
            match self.period(observe)? {
                Ok(state) => {
                    if let Some(before) = &self.before {
                        self.change = before.distance(&state, self.system.scales().length);
                    }
                    self.before = Some(state.clone());
                    return Ok(Ok(state));
                }
                Err((Outcome::Stalled | Outcome::IterationLimit | Outcome::WrongAssembly, _))
                    if self.step.shrink(self.step.get()) =>
                {
                    self.begin();
                }
                Err(failure) => return Ok(Err(failure)),
            }
        }
    }

    /// Marches one period.
    fn period(&mut self, observe: &mut dyn FnMut(&Iteration) -> bool) -> Result<March> {
        let (grid, parts) = (self.grid, self.parts());
        let step = grid.period() / (grid.points() * parts) as f64;
        let weights = houbolt(step);
        let mut state = GridState::reference(&self.system, grid);
        for k in 0..grid.points() {
            for part in 0..parts {
                let equations = &mut self.newton.equations;
                equations.set_conditions(Conditions::at(grid.time(k) + step * part as f64))?;
                let past = self.past.iter().cloned().collect();
                equations.set_rule(Box::new(Backward::new(weights, past)));
                let mut next = {
                    let before = (&self.past[1], 1.0);
                    self.past[0].extrapolated(&self.system, before, None, 1.0)
                };
                let report = match self.newton.solve(&mut next, &NEWTON, observe) {
                    Ok(report) => report,
                    Err(error) if error.kind() == ErrorKind::Callback => return Err(error),
                    Err(error) => return Ok(Err((Outcome::Stalled, error.to_string()))),
                };
                if report.outcome != Outcome::Converged {
                    return Ok(Err((report.outcome, report.explanation)));
                }
                self.past.pop_back();
                self.past.push_front(next);
                if part == 0 {
                    state.copy_point(&self.system, k, &self.past[0], 0);
                }
            }
        }
        Ok(Ok(state))
    }
}
