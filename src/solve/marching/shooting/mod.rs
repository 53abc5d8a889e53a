//! Periodic motions by shooting: Newton's method on the period map of the marching scheme.
//!
//! The unknowns are all that a step starts from: motions, velocities, accelerations and internal
//! states. So what is found is the periodic motion of the scheme itself, without a transient of its
//! start, and no projection is needed: what the map gives satisfies the constraints. Its derivative
//! is propagated through the linearised steps, with the factors of each. See docs/theory.md,
//! section 12.3.

mod newton;
mod period_map;
mod propagation;

use crate::collocation::MotionState;
use crate::elements::Unknown;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::solve::marching::options::{MarchEnd, MarchOptions, MarchStart};
use crate::solve::marching::repetition::difference;
use crate::solve::marching::shooting::newton::close;
use crate::solve::marching::shooting::period_map::{Orbit, PeriodMap};
use crate::solve::marching::start::begin;
use crate::solve::marching::trajectory::{Kept, finish};
use crate::solve::memory::{MemoryLimit, bytes_of_shooting};
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome};
use crate::solve::result::{Kind, Solved};
use crate::solve::watch::{Stage, Watch, Watching};
use crate::system::{Regime, System, Transient, require_periodic_forces};
use crate::workers::Workers;
use std::sync::Arc;
use std::time::Instant;

/// Options of a shooting solve.
#[derive(Debug, Clone)]
pub struct ShootingOptions {
    /// Equal steps over the period.
    pub steps: usize,
    /// Where the march starts that gives the first guess.
    pub start: MarchStart,
    /// Periods that it takes.
    pub guess_periods: usize,
    /// Spectral radius of the scheme at infinite frequency, from 0 to less than 1.
    pub spectral_radius: f64,
    /// When Newton's method stops; in each step it goes on to the square root of rounding.
    pub newton: NewtonOptions,
    /// Bytes that it may take, by an estimate; no limit if zero.
    pub memory_limit: usize,
    /// Who is told how the solve goes on, and may cancel it.
    pub watch: Watch,
}

impl Default for ShootingOptions {
    fn default() -> Self {
        ShootingOptions {
            steps: 200,
            start: MarchStart::Reference,
            guess_periods: 1,
            spectral_radius: MarchOptions::SPECTRAL_RADIUS,
            newton: NewtonOptions {
                tolerance: 1e-8,
                iteration_limit: 30,
            },
            memory_limit: 0,
            watch: Watch::default(),
        }
    }
}

/// More steps to a period are a mistake.
const MOST_STEPS: usize = 1_000_000;
impl ShootingOptions {
    fn validate(&self) -> Result<()> {
        self.newton.validate()?;
        if !(1..=MOST_STEPS).contains(&self.steps) {
            let expected = format!("from 1 to {MOST_STEPS}");
            let name = "options.steps_per_period";
            return Err(Error::value(name, expected, self.steps));
        }
        if !(0.0..1.0).contains(&self.spectral_radius) {
            let (name, expected) = ("options.spectral_radius", "a number from 0 to less than 1");
            return Err(Error::value(name, expected, self.spectral_radius));
        }
        Ok(())
    }
}

/// Finds the periodic motion of `model` with period `period` by shooting, on the equal steps of a
/// march.
///
/// The solve that is returned is a trajectory over one period. Its history is that of Newton's
/// method on the period map, and its record holds the Floquet multipliers.
///
/// `observe` sees the steps of the guess and each iteration, and returns `false` to cancel.
///
/// # Errors
/// If options or model are not valid. Not converging is an outcome, not an error.
pub fn solve_shooting(
    model: &Model,
    period: f64,
    options: &ShootingOptions,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Solved> {
    options.validate()?;
    let began = Instant::now();
    // Checks that everything repeats itself.
    let periodic = System::new(model, period)?;
    require_periodic_forces(model, periodic.scales().length, period)?;
    let length = period / options.steps as f64;
    let system = Arc::new(System::in_regime(
        model,
        Regime::March(Transient {
            period: Some(period),
            duration: period,
            step: length,
        }),
    )?);
    let bytes = bytes_of_shooting(&system, options.steps);
    MemoryLimit(options.memory_limit).require("shooting", bytes)?;
    let watching = options.watch.begin(Stage::InitialGuess, 1);
    let workers = Workers::default().telling(watching.pulse());
    let mut observe = watching.with(observe);
    let mut march = MarchOptions::with_step(length, MarchEnd::Duration(period));
    march.start = options.start.clone();
    march.spectral_radius = options.spectral_radius;
    let marcher = match begin(&system, &march, length, &workers)? {
        Ok(marcher) => marcher,
        Err(refused) => return Ok(refused.shot(Vec::new())),
    };
    let mut map = PeriodMap::new(marcher, options.steps, period);
    let mut report = NewtonReport::ended(Outcome::IterationLimit, String::new());
    let mut orbit = guess(&mut map, options, &watching, &mut report, &mut observe)?;
    let guess_time = began.elapsed();
    let mut floquet = Vec::new();
    if let (Some(orbit), Outcome::IterationLimit) = (&mut orbit, report.outcome) {
        watching.stage(Stage::Newton);
        let closed = close(&mut map, orbit, &options.newton, &mut report, &mut observe);
        match watching.unless_cancelled(closed)? {
            Some(found) => floquet = found,
            None => report.outcome = Outcome::Cancelled,
        }
    }
    let mut record = std::mem::take(&mut map.marcher.record);
    let kept = match orbit {
        Some(orbit) => {
            record.periods = 1;
            record.repetition = difference(&orbit.starts[0], &orbit.end, system.scales(), period);
            states_of(orbit, &system).iter().map(Kept::of).collect()
        }
        None => vec![Kept::of(map.marcher.now())],
    };
    let mut solve = finish(&system, record, kept, None)?.shot(floquet);
    solve.report = report;
    solve.guess_time = guess_time;
    solve.guess_iterations = options.guess_periods;
    solve.timings = map.marcher.newton.timings;
    solve.total_time = began.elapsed();
    solve.report.outcome = watching.outcome(solve.report.outcome);
    Ok(solve)
}

/// Marches the periods of the guess, then the orbit from its end: the last that was marched. What
/// ends it before is told in the report.
fn guess(
    map: &mut PeriodMap,
    options: &ShootingOptions,
    watching: &Watching,
    report: &mut NewtonReport,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Option<Orbit>> {
    let mut start = map.marcher.now().clone();
    let mut orbit = None;
    for number in 0..=options.guess_periods {
        let found = match watching.unless_cancelled(map.march(&start))? {
            Some(Ok(found)) => found,
            Some(Err(why)) => {
                *report = NewtonReport::ended(Outcome::Stalled, why);
                break;
            }
            None => {
                report.outcome = Outcome::Cancelled;
                break;
            }
        };
        start = found.end.clone();
        let miss = map.norm(&map.miss(&found));
        orbit = Some(found);
        let iteration = Iteration {
            number: number + 1,
            residual: miss,
            increment: miss,
            step: 1.0,
        };
        if number < options.guess_periods && !observe(Stage::InitialGuess, &iteration) {
            report.outcome = Outcome::Cancelled;
            break;
        }
    }
    Ok(orbit)
}

/// The states of an orbit that is closed; multipliers at the start are those at the end.
fn states_of(mut orbit: Orbit, system: &System) -> Vec<MotionState> {
    let (first, last) = (&mut orbit.starts[0].state, &orbit.end.state);
    for (place, multiplier) in last.multipliers.iter().enumerate() {
        if matches!(system.unknown(place), Unknown::Multiplier(_)) {
            first.multipliers[place] = *multiplier;
        }
    }
    orbit.starts.push(orbit.end);
    orbit.starts
}

impl Solved {
    /// The last march of a shooting solve as its result.
    fn shot(mut self, floquet: Vec<[f64; 2]>) -> Self {
        if let Kind::March(march) = self.kind {
            self.kind = Kind::Shooting { march, floquet };
        }
        self
    }
}
