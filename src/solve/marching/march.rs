//! The march, in steps that fit its periods and its end.

use crate::error::Result;
use crate::memory;
use crate::model::Model;
use crate::solve::marching::marcher::Marcher;
use crate::solve::marching::options::{END, MarchEnd, MarchOptions};
use crate::solve::marching::repetition::{difference, distance, is_periodic};
use crate::solve::marching::start::begin;
use crate::solve::marching::trajectory::{Kept, finish, of_steps, require_steps};
use crate::solve::marching::{Stop, Tried, refused};
use crate::solve::memory::MemoryLimit;
use crate::solve::report::{Iteration, Outcome};
use crate::solve::result::Solved;
use crate::solve::step_length::StepLength;
use crate::solve::watch::Stage;
use crate::system::{Regime, System, Transient, require_reproducible_forces};
use crate::workers::Workers;
use std::sync::Arc;
use std::time::Instant;

/// Shortest step with error control, relative to the first.
const SHORTEST: f64 = 1e-6;
/// Aim at this part of the longest step that the tolerance allows.
const SAFETY: f64 = 0.9;
/// Limits of the change of a step.
const CHANGE: (f64, f64) = (0.2, 2.0);
/// A step is only lengthened if it can be by this factor.
const WORTHWHILE: f64 = 1.2;
/// What a step that does not converge is shortened to.
const RETREAT: f64 = 0.25;

/// Memory is asked for before each of so many steps.
const STEPS_AT_A_TIME: usize = 256;

/// How a march went on, and its states.
struct Run<'a> {
    marcher: Marcher,
    options: &'a MarchOptions,
    observe: &'a mut dyn FnMut(Stage, &Iteration) -> bool,
    kept: Vec<Kept>,
    /// Of the next step, before it is fitted to an end.
    length: StepLength,
}

impl Run<'_> {
    /// Marches to `end`, with steps that are given up for shorter ones if errors are controlled.
    fn march_to(&mut self, end: f64) -> Tried<()> {
        let tolerance = self.options.error_tolerance.unwrap_or(f64::INFINITY);
        loop {
            let left = end - self.marcher.now().time;
            if left <= END * self.length.get() {
                self.marcher.set_time(end);
                if let Some(last) = self.kept.last_mut() {
                    last.time = end;
                }
                return Ok(());
            }
            // No tiny step may be left over.
            let fitted = match left / self.length.get() {
                steps if steps <= 1.0 + END => left,
                steps if self.options.error_tolerance.is_some() && steps < 2.0 => 0.5 * left,
                _ => self.length.get(),
            };
            self.marcher.set_length(fitted);
            match refused(self.marcher.step(tolerance))? {
                Ok(error) => {
                    let best = SAFETY * (tolerance / error).cbrt();
                    if !(1.0..WORTHWHILE).contains(&best) {
                        self.length.grow(fitted, best.clamp(CHANGE.0, CHANGE.1));
                    }
                    self.keep()?;
                }
                Err((outcome, why)) => {
                    self.marcher.record.rejected += 1;
                    if !self.length.shrink(fitted) {
                        let time = self.marcher.now().time;
                        let why = format!("the step of {fitted:.3e} from t = {time}: {why}");
                        return Err(Stop::Refused((outcome, why)));
                    }
                }
            }
        }
    }

    /// Keeps the state after a step, and tells of it.
    fn keep(&mut self) -> Tried<()> {
        let (system, kept) = (self.marcher.newton.equations.system(), self.kept.len());
        if kept.is_multiple_of(STEPS_AT_A_TIME) {
            require_steps(system, STEPS_AT_A_TIME)?;
        }
        let limit = MemoryLimit(self.options.memory_limit);
        if of_steps(system, kept + 1) as f64 > limit.bytes() {
            let why = format!(
                "options.memory_limit ({} bytes) allows no more than {kept} steps to be kept",
                self.options.memory_limit
            );
            return Err(Stop::Refused((Outcome::WorkLimit, why)));
        }
        memory::reserve("steps of the march", &mut self.kept, 1)?;
        self.kept.push(Kept::of(self.marcher.now()));
        let last = Iteration {
            number: self.marcher.record.steps,
            ..self.marcher.last
        };
        let time = self.marcher.now().time;
        if !(self.observe)(Stage::March { time }, &last) {
            return Err(Stop::Refused((Outcome::Cancelled, String::new())));
        }
        Ok(())
    }

    /// Forgets what is older than the periods to be stored.
    fn forget(&mut self) {
        if let (count, Some(period)) = (self.options.stored_periods, self.options.period)
            && count > 0
        {
            let first = self.marcher.now().time - period * (count as f64 + END);
            let old = self.kept.partition_point(|kept| kept.time < first);
            self.kept.drain(..old);
        }
    }

    /// Whether steps of the present length end at a time; those that fit the whole duration need
    /// not fit its periods.
    fn fits(&self, time: f64) -> bool {
        if self.options.error_tolerance.is_some() {
            return true;
        }
        let (now, step) = (self.marcher.now().time, self.length.get());
        let fits = ((time - now) / step).round() * step;
        (now + fits - time).abs() <= END * step
    }

    fn run(&mut self) -> Tried<()> {
        let start = self.options.start_time;
        let Some(period) = self.options.period else {
            return match self.options.end {
                MarchEnd::Duration(duration) => self.march_to(start + duration),
                MarchEnd::Periodic { .. } => Ok(()),
            };
        };
        let (end, most) = match self.options.end {
            MarchEnd::Duration(duration) => (start + duration, (duration / period).ceil() as usize),
            MarchEnd::Periodic { most_periods, .. } => (f64::INFINITY, most_periods),
        };
        let scales = *self.marcher.newton.equations.system().scales();
        let mut before = self.marcher.now().clone();
        let mut changes = Vec::new();
        for number in 1..=most {
            let next = start + period * number as f64;
            if next > end + END * self.length.get() || (end.is_finite() && !self.fits(next)) {
                return self.march_to(end);
            }
            self.march_to(next)?;
            self.forget();
            let now = self.marcher.now();
            let change = difference(now, &before, &scales, period);
            before = now.clone();
            self.marcher.record.periods = number;
            self.marcher.record.repetition = change;
            changes.push(change);
            if let MarchEnd::Periodic { tolerance, .. } = self.options.end
                && is_periodic(&changes, tolerance)
            {
                return Ok(());
            }
        }
        if end.is_finite() {
            return Ok(());
        }
        let why = format!(
            "not periodic after {most} periods: the last differs from the one before by {:.3e}, \
             and by about {:.3e} from the periodic motion",
            self.marcher.record.repetition,
            distance(&changes)
        );
        Err(Stop::Refused((Outcome::IterationLimit, why)))
    }
}

/// Length of equal steps of at most `step` in `span`.
fn fitting_step(span: f64, step: f64) -> f64 {
    span / (span / step - 1e-9).ceil().max(1.0)
}

/// Marches `model` in time.
///
/// `observe` sees each step, with the last of its iterations, and returns `false` to cancel.
///
/// # Errors
/// If options or model are not valid. A march that does not reach its end is an outcome, not an
/// error.
pub fn march(
    model: &Model,
    options: &MarchOptions,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Solved> {
    options.validate()?;
    let length = match options.error_tolerance {
        Some(_) => options.step.min(options.span()),
        None => fitting_step(options.span(), options.step),
    };
    let began = Instant::now();
    let system = Arc::new(System::in_regime(
        model,
        Regime::March(Transient {
            period: options.period,
            duration: options.span(),
            step: length,
        }),
    )?);
    let scale = system.scales().length;
    require_reproducible_forces(model, scale, options.span(), options.start_time)?;
    if let (MarchEnd::Duration(duration), None, 0) =
        (options.end, options.error_tolerance, options.stored_periods)
    {
        let bytes = of_steps(&system, (duration / length) as usize + 1);
        MemoryLimit(options.memory_limit).require("steps of the march", bytes)?;
    }
    let time = options.start_time;
    let watching = options.watch.begin(Stage::March { time }, 1);
    let workers = Workers::default().telling(watching.pulse());
    let mut observe = watching.with(observe);
    let marcher = match begin(&system, options, length, &workers)? {
        Ok(marcher) => marcher,
        Err(refused) => return Ok(refused),
    };
    let guess_time = began.elapsed();
    let mut run = Run {
        kept: vec![Kept::of(marcher.now())],
        marcher,
        options,
        observe: &mut observe,
        length: match options.error_tolerance {
            Some(_) => StepLength::shortened(length, SHORTEST * length..=f64::INFINITY, RETREAT),
            None => StepLength::halved(length, length..=length),
        },
    };
    let refusal = match watching.unless_cancelled(refused(run.run()))? {
        Some(end) => end.err(),
        None => Some((Outcome::Cancelled, String::new())),
    };
    let Run { marcher, kept, .. } = run;
    let timings = marcher.newton.timings;
    let mut solve = finish(&system, marcher.record, kept, refusal)?;
    solve.guess_time = guess_time;
    solve.timings = timings;
    solve.total_time = began.elapsed();
    solve.report.outcome = watching.outcome(solve.report.outcome);
    Ok(solve)
}
