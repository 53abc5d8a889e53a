//! Periodic motions by shooting: Newton's method on the period map of the marching scheme.
//!
//! The unknowns are all that a step starts from: motions, velocities, accelerations and internal
//! states. So what is found is the periodic motion of the scheme itself, without a transient of its
//! start, and no projection is needed: what the map gives satisfies the constraints. Its derivative
//! is propagated through the linearised steps, with the factors of each. See docs/theory.md,
//! section 12.3.

use super::eigenvalues::eigenvectors;
use super::newton::{Iteration, NewtonOptions, NewtonReport, Outcome};
use super::periodic::Stage;
use super::result::{Kind, Solved};
use super::trajectory::{
    Kept, MarchEnd, MarchOptions, MarchRecord, MarchStart, Marcher, difference, finish,
};
use super::watch::Watch;
use crate::collocation::{
    AlphaStep, Conditions, GridState, MotionState, StepVariation, Variation, VariationScales,
};
use crate::elements::{Measure, Unknown};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::system::{Regime, System, Transient, require_periodic_forces};
use crate::workers::Workers;
use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};
use nalgebra::Complex;
use std::f64::consts::TAU;
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
            watch: Watch::default(),
        }
    }
}

/// More steps to a period are a mistake.
const MOST_STEPS: usize = 1_000_000;
/// Shortest step of the line search.
const SHORTEST_STEP: f64 = 1.0 / 64.0;
/// Larger increments are taken in part: displacements relative to the characteristic length,
/// radians.
const LARGEST_INCREMENT: f64 = 1.0;

impl ShootingOptions {
    fn validate(&self) -> Result<()> {
        self.newton.validate()?;
        if !(1..=MOST_STEPS).contains(&self.steps) {
            let expected = format!("from 1 to {MOST_STEPS}");
            return Err(Error::value(
                "options.steps_per_period",
                expected,
                self.steps,
            ));
        }
        if !(0.0..1.0).contains(&self.spectral_radius) {
            let expected = "a number from 0 to less than 1";
            return Err(Error::value(
                "options.spectral_radius",
                expected,
                self.spectral_radius,
            ));
        }
        Ok(())
    }
}

/// One period: where each step starts, and where it ends.
struct Orbit {
    starts: Vec<MotionState>,
    ends: Vec<GridState>,
    end: MotionState,
}

/// A shooting solve on its way.
struct Shooting {
    marcher: Marcher,
    scales: VariationScales,
    steps: usize,
    period: f64,
}

impl Shooting {
    /// Marches a period from `start`; why not, if a step does not converge.
    fn march(&mut self, start: &MotionState) -> Result<std::result::Result<Orbit, String>> {
        let mut orbit = Orbit {
            starts: Vec::with_capacity(self.steps),
            ends: Vec::with_capacity(self.steps),
            end: start.clone(),
        };
        let mut start = start.clone();
        start.time = 0.0;
        self.marcher.restart(start);
        for k in 1..=self.steps {
            orbit.starts.push(self.marcher.now().clone());
            self.marcher.newton.equations.workers().pulse()?;
            if let Err(refusal) = self.marcher.step(|_| true)? {
                let time = self.marcher.now().time;
                let why = refusal.map_or(String::new(), |(_, why)| why);
                return Ok(Err(format!("the step from t = {time}: {why}")));
            }
            // No drift of the time by rounding.
            self.marcher
                .set_time(self.period * k as f64 / self.steps as f64);
            orbit.ends.push(self.marcher.now().state.clone());
        }
        orbit.end = self.marcher.now().clone();
        Ok(Ok(orbit))
    }

    /// Whole turns that internal states gain over an orbit.
    fn gains(&self, orbit: &Orbit) -> Vec<f64> {
        let system = self.marcher.newton.equations.system();
        let (first, last) = (&orbit.starts[0].state, &orbit.end.state);
        let gain = |place: usize| match system.unknown(place) {
            Unknown::State {
                measure: Measure::Angle,
                tracked,
            } => {
                let change = last.coordinates[tracked] - first.coordinates[tracked];
                TAU * (change / TAU).round()
            }
            _ => 0.0,
        };
        (0..system.own_unknowns()).map(gain).collect()
    }

    /// What the end differs by from the start, scaled.
    fn miss(&self, orbit: &Orbit) -> Vec<f64> {
        let miss = orbit.starts[0].difference(&orbit.end, &self.gains(orbit));
        let mut entries = vec![0.0; self.scales.size()];
        self.scales.pack(&miss, &mut entries);
        entries
    }

    /// Derivative of the end of an orbit with respect to its start, scaled.
    fn monodromy(&mut self, orbit: &Orbit) -> Result<Option<Mat<f64>>> {
        let size = self.scales.size();
        let mut unit = vec![0.0; size];
        let mut columns: Vec<Variation> = (0..size)
            .map(|j| {
                unit[j] = 1.0;
                let column = self.scales.unpack(&unit);
                unit[j] = 0.0;
                column
            })
            .collect();
        let (method, length) = (self.marcher.method, self.period / self.steps as f64);
        let newton = &mut self.marcher.newton;
        for (k, (start, end)) in orbit.starts.iter().zip(&orbit.ends).enumerate() {
            let time = self.period * (k + 1) as f64 / self.steps as f64;
            newton.equations.set_conditions(Conditions::at(time))?;
            let step = AlphaStep::new(method, length, start.clone());
            newton.equations.set_rule(Box::new(step.clone()));
            newton.linear.assemble(&mut newton.equations, end)?;
            if !newton.linear.factor_all(&newton.equations)? {
                return Ok(None);
            }
            let mut linear = StepVariation::new(&step, &end.motions, newton.equations.size());
            for column in &mut columns {
                newton.equations.workers().pulse()?;
                let propagated = linear.propagate(
                    &newton.equations,
                    &step,
                    &newton.linear.tangent,
                    column,
                    |rhs| newton.linear.substitute(rhs),
                );
                if !propagated {
                    return Ok(None);
                }
            }
        }
        let mut monodromy = Mat::zeros(size, size);
        for (j, column) in columns.iter().enumerate() {
            self.scales.pack(column, monodromy.col_as_slice_mut(j));
        }
        Ok(Some(monodromy))
    }

    /// Largest increment of motions and velocities.
    fn norm(&self, entries: &[f64]) -> f64 {
        let nodes = 24 * self.marcher.newton.equations.system().nodes();
        entries[..nodes]
            .chunks_exact(24)
            .flat_map(|node| &node[..12])
            .fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    /// `∂(end − start)/∂start`, from the derivative of the end, at the miss of the motions:
    /// increments of the end are taken to those of the logarithm of the motion from the start.
    fn tangent(&self, orbit: &Orbit, monodromy: &Mat<f64>) -> Mat<f64> {
        let size = self.scales.size();
        let mut tangent = Mat::zeros(size, size);
        let step = AlphaStep::new(self.marcher.method, 1.0, orbit.starts[0].clone());
        let ends = StepVariation::new(&step, &orbit.end.state.motions, 0);
        let mut unit = vec![0.0; size];
        for j in 0..size {
            let mut column = self.scales.unpack(monodromy.col_as_slice(j));
            unit[j] = 1.0;
            let start = self.scales.unpack(&unit);
            unit[j] = 0.0;
            ends.subtract(&start, &mut column);
            self.scales.pack(&column, tangent.col_as_slice_mut(j));
        }
        tangent
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
    let watching = options.watch.begin(Stage::InitialGuess, 1);
    let workers = Workers::default().telling(watching.pulse());
    let mut observe = |stage: Stage, iteration: &Iteration| {
        let goes_on = watching.iteration(stage, iteration);
        observe(stage, iteration) && goes_on
    };
    let mut march = MarchOptions::with_step(length, MarchEnd::Duration(period));
    march.start = options.start.clone();
    march.spectral_radius = options.spectral_radius;
    let marcher = match Marcher::new(&system, &march, length, &workers)? {
        Ok(marcher) => marcher,
        Err((refusal, at)) => {
            let kept = vec![Kept::of(&at)];
            let solve = finish(&system, MarchRecord::default(), kept, Some(refusal))?;
            return Ok(solve.shot(Vec::new()));
        }
    };
    let mut shooting = Shooting {
        scales: VariationScales::new(&marcher.newton.equations, period / TAU),
        marcher,
        steps: options.steps,
        period,
    };
    let mut report = NewtonReport {
        outcome: Outcome::IterationLimit,
        iterations: Vec::new(),
        explanation: String::new(),
    };
    let mut start = shooting.marcher.now().clone();
    let mut orbit = None;
    // The guess; then the orbit from its end.
    for number in 0..=options.guess_periods {
        let marched = match shooting.march(&start) {
            Err(error) if watching.cancels(&error) => {
                report.outcome = Outcome::Cancelled;
                break;
            }
            marched => marched?,
        };
        match marched {
            Ok(found) => {
                start = found.end.clone();
                let miss = shooting.norm(&shooting.miss(&found));
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
            Err(why) => {
                report.outcome = Outcome::Stalled;
                report.explanation = why;
                break;
            }
        }
    }
    let guess_time = began.elapsed();
    let mut floquet = Vec::new();
    if let (Some(orbit), Outcome::IterationLimit) = (&mut orbit, report.outcome) {
        watching.stage(Stage::Newton);
        floquet = match iterate(&mut shooting, orbit, options, &mut report, &mut observe) {
            Err(error) if watching.cancels(&error) => {
                report.outcome = Outcome::Cancelled;
                Vec::new()
            }
            found => found?,
        };
    }
    let mut record = std::mem::take(&mut shooting.marcher.record);
    let kept = match orbit {
        Some(mut orbit) => {
            record.periods = 1;
            record.repetition = difference(&orbit.starts[0], &orbit.end, system.scales(), period);
            // Multipliers at the start are those at the end.
            let last = orbit.end.state.clone();
            let first = &mut orbit.starts[0];
            for place in 0..last.multipliers.len() {
                if matches!(system.unknown(place), Unknown::Multiplier(_)) {
                    first.state.multipliers[place] = last.multipliers[place];
                }
            }
            orbit.starts.push(orbit.end);
            orbit.starts.iter().map(Kept::of).collect()
        }
        None => vec![Kept::of(shooting.marcher.now())],
    };
    let mut solve = finish(&system, record, kept, None)?.shot(floquet);
    solve.report = report;
    solve.guess_time = guess_time;
    solve.guess_iterations = options.guess_periods;
    solve.timings = shooting.marcher.newton.timings;
    solve.total_time = began.elapsed();
    solve.report.outcome = watching.outcome(solve.report.outcome);
    Ok(solve)
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

/// Newton's method from an orbit that is not closed yet. Returns the Floquet multipliers.
fn iterate(
    shooting: &mut Shooting,
    orbit: &mut Orbit,
    options: &ShootingOptions,
    report: &mut NewtonReport,
    observe: &mut dyn FnMut(Stage, &Iteration) -> bool,
) -> Result<Vec<[f64; 2]>> {
    for number in 1..=options.newton.iteration_limit {
        let miss = shooting.miss(orbit);
        let Some(monodromy) = shooting.monodromy(orbit)? else {
            report.outcome = Outcome::Singular;
            return Ok(Vec::new());
        };
        let factors = shooting.tangent(orbit, &monodromy).partial_piv_lu();
        let increment = solve(&factors, &miss);
        // Where the motion is not determined there may be nothing to correct.
        let probe: Vec<f64> = (0..miss.len()).map(|i| (1.0 + i as f64).sin()).collect();
        let response = solve(&factors, &probe);
        let bounded = response.iter().all(|x| x.abs() < SINGULAR);
        let size = shooting.norm(&increment);
        if !bounded || !increment.iter().all(|x| x.is_finite()) || size > SINGULAR {
            report.outcome = Outcome::Singular;
            report.explanation =
                "the motion is free to shift: the derivative of the period map has the eigenvalue \
                 1"
                .into();
            return Ok(multipliers(shooting, &monodromy));
        }
        let converged = size <= options.newton.tolerance;
        let largest = size.max(LARGEST_INCREMENT);
        let mut step = LARGEST_INCREMENT / largest;
        let variation = shooting.scales.unpack(&increment);
        let accepted = loop {
            let start = orbit.starts[0].varied(&variation, step);
            if let Ok(next) = shooting.march(&start)? {
                let simplified = solve(&factors, &shooting.miss(&next));
                let bound = ((1.0 - 0.25 * step) * size).max(options.newton.tolerance);
                if converged || shooting.norm(&simplified) <= bound {
                    break Some(next);
                }
            }
            step *= 0.5;
            if step < SHORTEST_STEP {
                break None;
            }
        };
        let iteration = Iteration {
            number,
            residual: shooting.norm(&miss),
            increment: size,
            step: if accepted.is_some() { step } else { 0.0 },
        };
        report.iterations.push(iteration);
        let keep_going = observe(Stage::Newton, &iteration);
        let Some(next) = accepted else {
            report.outcome = Outcome::Stalled;
            report.explanation = format!(
                "no step along the Newton direction brings progress; the last increment is \
                 {size:.3e}"
            );
            return Ok(multipliers(shooting, &monodromy));
        };
        *orbit = next;
        if converged {
            report.outcome = Outcome::Converged;
            return Ok(multipliers(shooting, &monodromy));
        }
        if !keep_going {
            report.outcome = Outcome::Cancelled;
            return Ok(multipliers(shooting, &monodromy));
        }
    }
    report.explanation = format!(
        "not converged after {} iterations",
        options.newton.iteration_limit
    );
    Ok(Vec::new())
}

/// An increment larger than this, in characteristic lengths or radians, is that of a singular
/// matrix.
const SINGULAR: f64 = 1e8;

/// Solves for the increment that makes up for a miss.
fn solve(factors: &PartialPivLu<f64>, miss: &[f64]) -> Vec<f64> {
    let rhs = Mat::from_fn(miss.len(), 1, |i, _| -miss[i]);
    factors.solve(&rhs).col_as_slice(0).to_vec()
}

/// Floquet multipliers, the largest first: as many as the system has states. Those of the scheme
/// itself, which are of the order of `ρ∞` to the number of steps, are left out.
fn multipliers(shooting: &Shooting, monodromy: &Mat<f64>) -> Vec<[f64; 2]> {
    let system = shooting.marcher.newton.equations.system();
    let independent = system.constraint_count() - system.redundant_constraints();
    let freedoms = (6 * system.nodes()).saturating_sub(independent);
    let count = 2 * freedoms + shooting.scales.states().count();
    let Some((values, _)) = eigenvectors(monodromy) else {
        return Vec::new();
    };
    let mut values: Vec<Complex<f64>> = values.iter().map(|z| Complex::new(z.re, z.im)).collect();
    // Of a pair, that with the positive imaginary part first.
    values.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
    values.truncate(count);
    values.iter().map(|z| [z.re, z.im]).collect()
}
