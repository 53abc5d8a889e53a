//! Marching in time by the generalised-α method, from consistent initial values, for a given time
//! or until the motion repeats itself. See docs/theory.md, section 12.1.

mod consistent;
pub(crate) mod shooting;

use crate::collocation::{
    AlphaStep, Collocation, Conditions, GeneralizedAlpha, GridState, MotionState,
};
use crate::elements::{NodeState, Unknown};
use crate::error::{Error, ErrorKind, Result, require_finite, require_positive_number};
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::motion::Motion;
use crate::solve::marching::consistent::{Initial, Refusal};
use crate::solve::newton::Newton;
use crate::solve::report::{Iteration, NewtonOptions, NewtonReport, Outcome};
use crate::solve::result::{Kind, MarchRecord, Solved};
use crate::solve::watch::{Stage, Watch};
use crate::system::{Regime, Scales, System, Transient, require_reproducible_forces};
use crate::workers::Workers;
use nalgebra::Vector6;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Instant;

/// Motions and velocities that a march starts from; what the constraints do not allow is projected
/// out.
#[derive(Debug, Clone)]
pub struct StartState {
    /// Motion of each node.
    pub motions: Vec<Motion>,
    /// Material velocity of each node; at rest if there are none.
    pub twists: Vec<Vector6<f64>>,
    /// Internal states of all elements, at the places of the own unknowns of an instant, and the
    /// last values of the tracked coordinates. Without them internal states are relaxed.
    pub internal: Option<(Vec<f64>, Vec<f64>)>,
}

/// Where a march starts.
#[derive(Debug, Clone, Default)]
pub enum MarchStart {
    /// The reference configuration, at rest but for what is prescribed and what hangs on drives
    /// that turn, which turns with them if the joints let it.
    #[default]
    Reference,
    /// These motions and velocities.
    State(StartState),
}

/// When a march ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MarchEnd {
    /// After this time.
    Duration(f64),
    /// When motions and velocities are those of the periodic motion.
    Periodic {
        /// Largest difference from it, by how the differences between neighbouring periods decay:
        /// displacements relative to the characteristic length, rotation matrices entry by entry,
        /// velocities likewise in units of a radian of the period.
        tolerance: f64,
        /// Periods after which it is given up.
        most_periods: usize,
    },
}

/// Options of a march.
#[derive(Debug, Clone)]
pub struct MarchOptions {
    /// Where it starts.
    pub start: MarchStart,
    /// When it starts.
    pub start_time: f64,
    /// When it ends.
    pub end: MarchEnd,
    /// Period that harmonics of signals refer to, and that the motion may repeat itself with.
    pub period: Option<f64>,
    /// Length of the steps, the first at least. Steps are shortened so that a whole number of them
    /// fits the period (marching until periodic) or the duration.
    pub step: f64,
    /// If given, steps are chosen so that each has at most this estimated error of a motion:
    /// displacements relative to the characteristic length, turns in radians.
    pub error_tolerance: Option<f64>,
    /// Spectral radius at infinite frequency, from 0 to 1: 1 keeps all vibrations, 0 removes at
    /// once what the steps do not resolve.
    pub spectral_radius: f64,
    /// When Newton's method stops in each step.
    pub newton: NewtonOptions,
    /// Keep only this number of the last periods; all if zero.
    pub stored_periods: usize,
    /// Who is told how the march goes on, and may cancel it.
    pub watch: Watch,
}

impl MarchOptions {
    /// Default numerical dissipation. What steps of a mechanism do not resolve, in the constraints
    /// above all, must decay (1 is unstable for index 3); half in a step does, and costs a resolved
    /// vibration of 20 steps no more than some 0.4 % of its amplitude in a cycle.
    pub const SPECTRAL_RADIUS: f64 = 0.5;

    /// The defaults, with steps of this length.
    pub fn with_step(step: f64, end: MarchEnd) -> Self {
        MarchOptions {
            start: MarchStart::Reference,
            start_time: 0.0,
            end,
            period: None,
            step,
            error_tolerance: None,
            spectral_radius: Self::SPECTRAL_RADIUS,
            newton: NewtonOptions {
                tolerance: 1e-9,
                iteration_limit: 20,
            },
            stored_periods: 0,
            watch: Watch::default(),
        }
    }

    pub(crate) fn validate(&self) -> Result<()> {
        self.newton.validate()?;
        require_finite("options.start_time", &[self.start_time])?;
        if let Some(period) = self.period {
            require_positive_number("options.period", period)?;
        }
        require_positive_number("options.step", self.step)?;
        if let Some(tolerance) = self.error_tolerance {
            require_positive_number("options.error_tolerance", tolerance)?;
        }
        if !(0.0..=1.0).contains(&self.spectral_radius) {
            let expected = "a number from 0 to 1";
            return Err(Error::value(
                "options.spectral_radius",
                expected,
                self.spectral_radius,
            ));
        }
        match self.end {
            MarchEnd::Duration(duration) => require_positive_number("options.duration", duration)?,
            MarchEnd::Periodic {
                tolerance,
                most_periods,
            } => {
                require_positive_number("options.periodic_tolerance", tolerance)?;
                if self.period.is_none() {
                    let expected = "the period that the motion repeats itself with";
                    return Err(Error::value("options.period", expected, "none"));
                }
                if most_periods == 0 {
                    return Err(Error::value("options.most_periods", "at least 1", 0));
                }
            }
        }
        if self.stored_periods > 0 && self.period.is_none() {
            let expected = "the period, to store the last of them";
            return Err(Error::value("options.period", expected, "none"));
        }
        self.validate_times()
    }

    /// Steps must be neither too many nor lost in the rounding of time, and must not skip periods.
    fn validate_times(&self) -> Result<()> {
        if self.span() / self.step > MOST_STEPS {
            return Err(Error::value(
                "options.step",
                format!(
                    "at least {:.3e}, a part of {MOST_STEPS:e} of the march's or period's length",
                    self.span() / MOST_STEPS
                ),
                self.step,
            ));
        }
        let latest = MOST_STEPS_AWAY * self.step;
        if self.start_time.abs() > latest {
            let expected = format!("at most {latest:.3e} in size, to tell its steps apart");
            return Err(Error::value(
                "options.start_time",
                expected,
                self.start_time,
            ));
        }
        if let (Some(period), MarchEnd::Duration(duration)) = (self.period, self.end) {
            let (least, why) = match self.error_tolerance {
                None => (self.step.min(duration), "steps must not skip periods"),
                Some(_) => (duration / MOST_STEPS, "the duration has too many of them"),
            };
            if period < (1.0 - END) * least {
                let expected = format!("at least {least:.3e}, as {why}");
                return Err(Error::value("options.period", expected, period));
            }
        }
        Ok(())
    }

    /// Length of time that a whole number of steps fits.
    fn span(&self) -> f64 {
        match (self.end, self.period) {
            (MarchEnd::Duration(duration), _) => duration,
            (MarchEnd::Periodic { .. }, period) => period.unwrap_or(self.step),
        }
    }
}

/// More steps to a duration or period than this are a mistake.
const MOST_STEPS: f64 = 1e8;
/// Farther from time zero steps drown in the rounding of time, by more than [`END`].
const MOST_STEPS_AWAY: f64 = 1e10;
/// Steps of constant length that end within this part of one are ends.
const END: f64 = 1e-6;
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

/// One time's states.
#[derive(Debug, Clone)]
pub(crate) struct Kept {
    time: f64,
    state: GridState,
    node_states: Vec<NodeState>,
}

impl Kept {
    pub fn of(at: &MotionState) -> Self {
        Kept {
            time: at.time,
            node_states: (0..at.twist.len()).map(|node| at.node(node)).collect(),
            state: at.state.clone(),
        }
    }
}

/// Largest difference of motions and velocities, as in [`MarchEnd::Periodic`].
pub(crate) fn difference(a: &MotionState, b: &MotionState, scales: &Scales, period: f64) -> f64 {
    let unit = period / TAU;
    let velocities = (a.twist.iter().zip(&b.twist))
        .map(|(a, b)| scales.size_of(&((a - b) * unit)))
        .fold(0.0, f64::max);
    velocities.max(a.state.distance(&b.state, scales.length))
}

/// Part of a step over which rates of drives are differenced.
const SHORT: f64 = 1e-3;

/// The reference configuration at rest, but for what hangs on drives that turn, if the joints let
/// it turn with them as one rigid body: that is where they are, and has their velocity.
fn rigid_rotation(
    system: &System,
    time: f64,
    short: f64,
    reference: GridState,
) -> Result<MotionState> {
    let driven = system.driven_at(time, short)?;
    let Some(driven) = driven.filter(|driven| driven.is_rigid()) else {
        return Ok(MotionState::at_rest(time, reference));
    };
    let mut signals = vec![0.0; system.signals()];
    system.signal_values(time, 1.0, &mut signals)?;
    let mut state = reference;
    for (node, motion) in state.motions.iter_mut().enumerate() {
        *motion = driven.carried(node, motion, &signals);
    }
    state.track(system);
    let mut at = MotionState::at_rest(time, state);
    for (node, twist) in at.twist.iter_mut().enumerate() {
        *twist = at.state.motions[node].inverse().adjoint() * driven.twist(node);
    }
    Ok(at)
}

/// A march on its way.
pub(crate) struct Marcher {
    pub newton: Newton,
    pub method: GeneralizedAlpha,
    newton_options: NewtonOptions,
    /// The present state, and the length of the next step.
    step: AlphaStep,
    next: GridState,
    pub record: MarchRecord,
    /// The last iteration of the last step.
    last: Iteration,
}

impl Marcher {
    pub fn new(
        system: &Arc<System>,
        options: &MarchOptions,
        step: f64,
        workers: &Workers,
    ) -> Result<std::result::Result<Self, (Refusal, MotionState)>> {
        let instant = TimeGrid::new(1, system.period())?;
        let mut equations = Collocation::new(system.clone(), instant)?;
        equations.set_workers(workers.clone());
        let mut newton = Newton::new(equations);
        let reference = GridState::reference(system, instant);
        let method = GeneralizedAlpha::new(options.spectral_radius);
        let (mut start, states_given) = match &options.start {
            MarchStart::Reference => {
                let short = SHORT * step;
                let at = rigid_rotation(system, options.start_time, short, reference)?;
                (at, false)
            }
            MarchStart::State(given) => {
                let mut state = reference;
                state.motions.copy_from_slice(&given.motions);
                if let Some((own, tracked)) = &given.internal {
                    state.multipliers.copy_from_slice(own);
                    state.coordinates.copy_from_slice(tracked);
                }
                state.track(system);
                let mut at = MotionState::at_rest(options.start_time, state);
                if !given.twists.is_empty() {
                    at.twist.copy_from_slice(&given.twists);
                }
                (at, given.internal.is_some())
            }
        };
        let mut record = MarchRecord {
            repetition: f64::INFINITY,
            ..MarchRecord::default()
        };
        let mut initial = Initial::new(&mut newton, step);
        match initial.make_consistent(&mut start, states_given, &method) {
            Err(_) if workers.is_stopped() => {
                return Ok(Err(((Outcome::Cancelled, String::new()), start)));
            }
            found => match found? {
                Ok((moved, corrected)) => {
                    record.start_moved = moved;
                    record.start_corrected = corrected;
                }
                Err(refusal) => return Ok(Err((refusal, start))),
            },
        }
        Ok(Ok(Marcher {
            newton,
            method,
            newton_options: options.newton,
            next: start.state.clone(),
            step: AlphaStep::new(method, step, start),
            record,
            last: Iteration::none(),
        }))
    }

    /// The present state.
    pub fn now(&self) -> &MotionState {
        &self.step.start
    }

    /// Goes on from another state.
    pub fn restart(&mut self, start: MotionState) {
        self.step.start = start;
    }

    /// Corrects the present time by its rounding.
    pub fn set_time(&mut self, time: f64) {
        self.step.start.time = time;
    }

    /// Goes on with steps of this length.
    fn set_length(&mut self, length: f64) {
        let ratio = length / self.step.length;
        if ratio != 1.0 {
            self.step.start.change_step(ratio);
            self.step.length = length;
        }
    }

    /// Tries one step; the present state is then its end. Otherwise says why not, and nothing has
    /// changed. `accept` is asked with the estimated error.
    pub fn step(
        &mut self,
        accept: impl Fn(f64) -> bool,
    ) -> Result<std::result::Result<f64, Option<Refusal>>> {
        let time = self.step.start.time + self.step.length;
        let system = self.newton.equations.system().clone();
        self.newton.equations.set_conditions(Conditions::at(time))?;
        self.step.predict(&mut self.next);
        self.next
            .coordinates
            .copy_from_slice(&self.step.start.state.coordinates);
        let start = &self.step.start;
        let length = self.step.length;
        system.foresee(|n| start.node(n), length, &mut self.next.coordinates);
        self.next.track(&system);
        self.newton.equations.set_rule(Box::new(self.step.clone()));
        let report = self
            .newton
            .solve(&mut self.next, &self.newton_options, &mut |_| true);
        let report = match report {
            Ok(report) => report,
            Err(error) if error.kind() == ErrorKind::Callback => return Err(error),
            // Too distorted: shorter steps may not be.
            Err(error) => return Ok(Err(Some((Outcome::Stalled, error.to_string())))),
        };
        self.record.iterations += report.iterations.len();
        if let Some(last) = report.iterations.last() {
            self.last = *last;
        }
        if report.outcome == Outcome::Cancelled {
            // Shorter steps are no way out.
            self.newton.equations.workers().pulse()?;
        }
        if report.outcome != Outcome::Converged {
            return Ok(Err(Some((report.outcome, report.explanation))));
        }
        let equations = &mut self.newton.equations;
        equations.update_kinematics(&self.next);
        equations.reduce_to_least_norm(&mut self.next)?;
        let error = self.step_error(system.scales());
        if !accept(error) {
            return Ok(Err(None));
        }
        let node_states = self.newton.equations.node_states();
        self.step.advance(&self.next, node_states, |place| {
            matches!(system.unknown(place), Unknown::State { .. })
        });
        self.step.start.time = time;
        self.record.steps += 1;
        self.record.step_error = self.record.step_error.max(error);
        Ok(Ok(error))
    }

    /// Estimated error of a motion in the step just made: `C h³ v̈`.
    fn step_error(&self, scales: &Scales) -> f64 {
        let h = self.step.length;
        let factor = self.method.error_constant() * h * h;
        let states = self.newton.equations.node_states();
        let rates = states.iter().zip(&self.step.start.twist_rate);
        rates
            .map(|(end, start)| scales.size_of(&((end.twist_rate - start) * factor)))
            .fold(0.0, f64::max)
    }
}

/// How a march went on, and its states.
struct Run<'a> {
    marcher: Marcher,
    options: &'a MarchOptions,
    observe: &'a mut dyn FnMut(Stage, &Iteration) -> bool,
    kept: Vec<Kept>,
    /// Length of the next step, before it is fitted to an end.
    length: f64,
    shortest: f64,
}

impl Run<'_> {
    /// Marches to `end`, with steps that are given up for shorter ones if errors are controlled.
    fn march_to(&mut self, end: f64) -> Result<Option<Refusal>> {
        loop {
            let left = end - self.marcher.now().time;
            if left <= END * self.length {
                self.marcher.step.start.time = end;
                if let Some(last) = self.kept.last_mut() {
                    last.time = end;
                }
                return Ok(None);
            }
            // No tiny step may be left over.
            let fitted = match left / self.length {
                steps if steps <= 1.0 + END => left,
                steps if self.options.error_tolerance.is_some() && steps < 2.0 => 0.5 * left,
                _ => self.length,
            };
            self.marcher.set_length(fitted);
            let tolerance = self.options.error_tolerance;
            let accept = |error: f64| tolerance.is_none_or(|tolerance| error <= tolerance);
            match self.marcher.step(accept)? {
                Ok(error) => {
                    if let Some(tolerance) = tolerance {
                        let best = SAFETY * (tolerance / error).cbrt();
                        if !(1.0..WORTHWHILE).contains(&best) {
                            self.length = fitted * best.clamp(CHANGE.0, CHANGE.1);
                        }
                    }
                    self.kept.push(Kept::of(self.marcher.now()));
                    let last = Iteration {
                        number: self.marcher.record.steps,
                        ..self.marcher.last
                    };
                    let time = self.marcher.now().time;
                    if !(self.observe)(Stage::March { time }, &last) {
                        return Ok(Some((Outcome::Cancelled, String::new())));
                    }
                }
                Err(refusal) => {
                    self.marcher.record.rejected += 1;
                    let shorter = RETREAT * fitted;
                    if tolerance.is_none() || shorter < self.shortest {
                        let (outcome, why) = refusal.unwrap_or((
                            Outcome::Stalled,
                            "the error stays above the tolerance".into(),
                        ));
                        let time = self.marcher.now().time;
                        let why = format!("the step of {fitted:.3e} from t = {time}: {why}");
                        return Ok(Some((outcome, why)));
                    }
                    self.length = shorter;
                }
            }
        }
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

    fn run(&mut self) -> Result<Option<Refusal>> {
        let start = self.options.start_time;
        let system = self.marcher.newton.equations.system().clone();
        let Some(period) = self.options.period else {
            return match self.options.end {
                MarchEnd::Duration(duration) => self.march_to(start + duration),
                MarchEnd::Periodic { .. } => Ok(None),
            };
        };
        let (end, most) = match self.options.end {
            MarchEnd::Duration(duration) => (start + duration, (duration / period).ceil() as usize),
            MarchEnd::Periodic { most_periods, .. } => (f64::INFINITY, most_periods),
        };
        let mut before = self.marcher.now().clone();
        let mut changes = Vec::new();
        for number in 1..=most {
            let next = start + period * number as f64;
            let constant = self.options.error_tolerance.is_none();
            if next > end + END * self.length {
                return self.march_to(end);
            }
            // Steps that fit the whole duration need not fit its periods.
            if constant && matches!(self.options.end, MarchEnd::Duration(_)) {
                let fits = ((next - self.marcher.now().time) / self.length).round() * self.length;
                if (self.marcher.now().time + fits - next).abs() > END * self.length {
                    return self.march_to(end);
                }
            }
            if let Some(refusal) = self.march_to(next)? {
                return Ok(Some(refusal));
            }
            self.forget();
            let now = self.marcher.now();
            let change = difference(now, &before, system.scales(), period);
            before = now.clone();
            self.marcher.record.periods = number;
            self.marcher.record.repetition = change;
            changes.push(change);
            if let MarchEnd::Periodic { tolerance, .. } = self.options.end
                && is_periodic(&changes, tolerance)
            {
                return Ok(None);
            }
        }
        Ok(match self.options.end {
            MarchEnd::Duration(_) => None,
            MarchEnd::Periodic { .. } => Some((
                Outcome::IterationLimit,
                format!(
                    "not periodic after {most} periods: the last differs from the one before by \
                     {:.3e}, and by about {:.3e} \
                     from the periodic motion",
                    self.marcher.record.repetition,
                    distance(&changes)
                ),
            )),
        })
    }
}

/// Changes this much below the tolerance may be rounding, which does not decay.
const NEGLIGIBLE: f64 = 1e-2;

/// How far the last period is from the periodic motion, by the `changes` from each period to the
/// next: what is left of them if they go on to decay as they did in the last three.
fn distance(changes: &[f64]) -> f64 {
    let Some(&last) = changes.last() else {
        return f64::INFINITY;
    };
    let recent = &changes[changes.len().saturating_sub(3)..];
    let decay = recent.windows(2).map(|pair| pair[1] / pair[0]);
    let slowest = decay.fold(0.0, f64::max);
    match slowest < 1.0 {
        true => last * (slowest / (1.0 - slowest)).max(1.0),
        false => f64::INFINITY,
    }
}

/// Whether these changes tell that the motion is periodic.
fn is_periodic(changes: &[f64], tolerance: f64) -> bool {
    let last = changes.last().copied().unwrap_or(f64::INFINITY);
    last <= NEGLIGIBLE * tolerance || distance(changes) <= tolerance
}

/// Length of equal steps of at most `step` in `span`.
pub(crate) fn fitting_step(span: f64, step: f64) -> f64 {
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
    let watching = options.watch.begin(
        Stage::March {
            time: options.start_time,
        },
        1,
    );
    let workers = Workers::default().telling(watching.pulse());
    let mut observe = |stage: Stage, iteration: &Iteration| {
        let goes_on = watching.iteration(stage, iteration);
        observe(stage, iteration) && goes_on
    };
    let marcher = match Marcher::new(&system, options, length, &workers)? {
        Ok(marcher) => marcher,
        Err((refusal, at)) => {
            let record = MarchRecord {
                repetition: f64::INFINITY,
                ..MarchRecord::default()
            };
            let kept = vec![Kept::of(&at)];
            return finish(&system, record, kept, Some(refusal));
        }
    };
    let guess_time = began.elapsed();
    let mut run = Run {
        kept: vec![Kept::of(marcher.now())],
        marcher,
        options,
        observe: &mut observe,
        length,
        shortest: SHORTEST * length,
    };
    let refusal = match run.run() {
        Err(error) if watching.cancels(&error) => Some((Outcome::Cancelled, String::new())),
        end => end?,
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

/// Puts the states of all times together.
pub(crate) fn finish(
    system: &Arc<System>,
    mut record: MarchRecord,
    kept: Vec<Kept>,
    refusal: Option<Refusal>,
) -> Result<Solved> {
    let points = kept.len();
    let mut state = GridState::at_points(system, points);
    let mut node_states = vec![NodeState::at_rest(Motion::identity()); points * system.nodes()];
    for (k, kept) in kept.iter().enumerate() {
        state.copy_point(system, k, &kept.state, 0);
        for (node, at) in kept.node_states.iter().enumerate() {
            node_states[node * points + k] = *at;
        }
    }
    record.times = kept.iter().map(|kept| kept.time).collect();
    let (outcome, explanation) = refusal.unwrap_or((Outcome::Converged, String::new()));
    let report = NewtonReport {
        outcome,
        iterations: Vec::new(),
        explanation,
    };
    Ok(Solved {
        total_iterations: record.iterations,
        ..Solved::known(
            system,
            TimeGrid::new(1, system.period())?,
            (state, node_states),
            report,
            Kind::March(record),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_decay_is_told_from_being_there() {
        // A change of 8.6e-5 a period that decays by half a percent: 200 times as far away.
        let slow: Vec<f64> = (0..9).map(|k| 8.6e-5 * 0.995f64.powi(k - 8)).collect();
        assert!((distance(&slow) / (8.6e-5 * 199.0) - 1.0).abs() < 1e-9);
        assert!(!is_periodic(&slow, 1e-4) && is_periodic(&slow, 2e-2));
        // Fast decay: the next change is less than the last.
        assert!((distance(&[1e-1, 1e-3, 1e-5]) / 1e-5 - 1.0).abs() < 1e-12);
        // Growth is none, rounding may be.
        assert!(!is_periodic(&[1e-5, 2e-5], 1e-4) && is_periodic(&[1e-15, 2e-15], 1e-4));
        assert!(is_periodic(&[1e-9], 1e-8) && !is_periodic(&[], 1.0));
    }
}
