//! Numbers of steps with which the multipliers stand still.

use super::judgement::{Judgement, judge};
use super::next_blade::NextBlade;
use super::period_map::PeriodMap;
use super::resolution::Resolution;
use super::spectrum::{FIRST, Rough, Spectrum, gain, spectrum, within};
use super::{Stability, StabilityOptions, state_count};
use crate::error::Result;
use crate::solve::report::Outcome;
use crate::solve::result::Solved;
use crate::solve::watch::Watching;
use crate::workers::Workers;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Steps of the first try at least,
const FEWEST_STEPS: usize = 5;
/// and where not all disturbances are followed: what few steps do not resolve they do not kill.
const FEWEST_OF_LARGE: usize = 17;
/// Error of a mode over the period that leaves it among the multipliers.
const SEEN: f64 = 1e-3;
/// Steps that accuracy is judged by, where they are enough for it, relative to those that are
/// taken.
const FEWER: [usize; 2] = [3, 4];
/// Errors with the steps of a motion nearby are taken for so many times larger than they were
/// there, where they were compared with others.
const MARGIN: f64 = 100.0;
/// So many motions in a row rely on what one has taken.
const MOST_REUSED: usize = 8;
/// More steps to a period are not tried.
const MOST_STEPS: usize = 3001;

/// Finds them with as many steps as a motion nearby has taken, or else as many as they need.
pub(super) fn find(
    solve: &Solved,
    options: &StabilityOptions,
    before: &mut Option<Experience>,
    watching: &Watching,
) -> Result<Stability> {
    let analysis = Analysis {
        solve,
        tolerance: options.tolerance,
        highest: options.highest(solve.grid.period()),
        states: state_count(solve),
        resolution: Resolution::new(),
        next: NextBlade::of(solve).map(Arc::new),
        watching,
    };
    if let Some(known) = before
        && let Some(found) = analysis.with_known_steps(known)?
    {
        known.reused += 1;
        return Ok(found);
    }
    *before = None;
    let Some(found) = analysis.with_enough_steps()? else {
        return Ok(Stability::unknown(solve, Outcome::Singular));
    };
    *before = Some(Experience {
        steps: found.steps,
        count: found.spectrum.count(),
        error: found.spectrum.worst(analysis.highest, options.tolerance),
        all: found.all,
        reused: 0,
    });
    let Found {
        judgement,
        spectrum,
        steps,
        ..
    } = found;
    Ok(judgement.stability(solve, spectrum, analysis.states, steps))
}

/// What the multipliers of a motion have taken.
#[derive(Debug, Clone)]
pub(crate) struct Experience {
    steps: usize,
    /// Number of the multipliers that were followed.
    count: usize,
    /// Largest error that counts.
    error: f64,
    /// Whether these are all that there are, and resolved.
    all: bool,
    /// How often it was relied on.
    reused: usize,
}

/// What is looked for.
struct Analysis<'a> {
    solve: &'a Solved,
    tolerance: f64,
    highest: f64,
    states: usize,
    resolution: Resolution,
    next: Option<Arc<NextBlade>>,
    watching: &'a Watching,
}

impl Analysis<'_> {
    fn map(&self, steps: usize) -> Result<PeriodMap> {
        self.watching.grid(steps);
        let workers = Workers::default().telling(self.watching.pulse());
        PeriodMap::new(self.solve, steps, self.next.clone(), &workers)
    }

    fn spectrum(&self, steps: usize, guess: usize) -> Result<Option<Spectrum>> {
        spectrum(&mut self.map(steps)?, self.states, guess, self.solve)
    }

    /// Angular frequency of modes up to which so many steps resolve them.
    fn resolved(&self, steps: usize, tolerance: f64) -> f64 {
        self.resolution.angle(steps, tolerance) / self.solve.grid.period()
    }

    /// Angular frequency of modes up to which so many steps leave out none, if not resolve it.
    fn seen(&self, steps: usize) -> f64 {
        self.resolved(steps, SEEN.max(self.tolerance))
    }

    /// At least so many steps, of which each like blade has as many; an odd number otherwise.
    fn shared(&self, steps: usize) -> usize {
        match &self.next {
            Some(next) => steps.next_multiple_of(next.blades),
            None => steps | 1,
        }
    }

    /// Angle that a mode turns by in a period.
    fn angle(&self, frequency: f64) -> f64 {
        frequency * self.solve.grid.period()
    }

    /// The result with the steps of a motion nearby, where errors like those are small enough.
    fn with_known_steps(&self, known: &Experience) -> Result<Option<Stability>> {
        let error = MARGIN * known.error;
        if known.reused >= MOST_REUSED || error > self.tolerance {
            return Ok(None);
        }
        let Some(mut now) = self.spectrum(known.steps, known.count)? else {
            return Ok(None);
        };
        now.add_error(error, self.tolerance);
        let limit = match known.all && now.count() == self.states {
            true => f64::INFINITY,
            false => self.seen(known.steps),
        };
        let judgement = judge(&now, limit, self.highest, self.tolerance);
        // What is not clear is looked at more closely.
        let is_clear = judgement.resolved && judgement.is_known();
        Ok(is_clear.then(|| judgement.stability(self.solve, now, self.states, known.steps)))
    }

    /// Takes more steps until the multipliers stand still; none if a step is singular.
    fn with_enough_steps(&self) -> Result<Option<Found>> {
        let few = self.states <= FIRST;
        let mut steps = (self.solve.grid.points() / 8).max(FEWEST_STEPS);
        if !few {
            // Those that are left out are to be above the highest frequency.
            let seen = (self.resolution).steps(self.angle(self.highest), SEEN);
            steps = steps.max(seen).clamp(FEWEST_OF_LARGE, MOST_STEPS / 2);
        }
        steps = self.shared(steps);
        let mut before: Option<(Vec<Rough>, usize)> = None;
        let mut best: Option<Found> = None;
        loop {
            let guess = before.as_ref().map_or(0, |(rough, _)| rough.len());
            let Some(mut now) = self.spectrum(steps, guess)? else {
                return Ok(None);
            };
            let rough = now.rough();
            let mut found = None;
            if let Some((rough, fewer)) = &before {
                found = Some(self.compared(&mut now, rough, (*fewer, steps)));
            }
            let is_resolved = |found: &Option<Compared>| {
                let judgement = found.as_ref().map(|found| &found.judgement);
                judgement.is_some_and(|judgement| judgement.resolved)
            };
            let fewer = self.shared(steps * FEWER[0] / FEWER[1]);
            if !few && !is_resolved(&found) && self.suffices(&now, (fewer, steps)) {
                let Some(rough) = self.again(&now, fewer)? else {
                    return Ok(None);
                };
                found = Some(self.compared(&mut now, &rough, (fewer, steps)));
            }
            let next = self.next_steps(&now, steps);
            if let Some(Compared { judgement, all }) = found {
                let (reach, error) = (judgement.reach(self.highest), now.worst(self.highest, 0.0));
                let better =
                    |best: &Found| reach > best.reach || reach == best.reach && error < best.error;
                // Rounding grows with the number of steps.
                let resolved = self.resolved(steps, self.tolerance);
                let stands = |best: &Found| {
                    reach <= best.reach && error > 0.5 * best.error && resolved >= self.highest
                };
                let is_last = judgement.resolved || best.as_ref().is_some_and(stands);
                if best.as_ref().is_none_or(better) {
                    best = Some(Found {
                        judgement,
                        spectrum: now,
                        steps,
                        reach,
                        error,
                        all,
                    });
                }
                if is_last || next > MOST_STEPS {
                    return Ok(best);
                }
            }
            before = Some((rough, steps));
            steps = next;
        }
    }

    /// Estimates errors by what came with fewer steps, and judges.
    fn compared(
        &self,
        now: &mut Spectrum,
        rough: &[Rough],
        (fewer, steps): (usize, usize),
    ) -> Compared {
        let ratio = steps as f64 / fewer as f64;
        let harmonic = TAU / self.solve.grid.period();
        let all_resolved = now.compare((rough, ratio), harmonic, self.tolerance);
        let all = all_resolved && now.count() == self.states;
        let limit = match all {
            true => f64::INFINITY,
            false => self.seen(steps),
        };
        Compared {
            judgement: judge(now, limit, self.highest, self.tolerance),
            all,
        }
    }

    /// The multipliers of the same disturbances with another number of steps; none if one is
    /// singular.
    fn again(&self, now: &Spectrum, steps: usize) -> Result<Option<Vec<Rough>>> {
        let mut map = self.map(steps)?;
        let found = within(&mut map, now.basis.clone(), self.solve)?;
        Ok(found.map(|found| found.rough()))
    }

    /// Whether fewer steps than a spectrum's resolve all modes that it has so well that they tell
    /// how accurate it is.
    fn suffices(&self, now: &Spectrum, (fewer, steps): (usize, usize)) -> bool {
        let gain = gain(steps as f64 / fewer as f64);
        let resolves = |(frequency, size): (f64, f64)| {
            frequency <= self.resolved(fewer, gain * self.tolerance_of(size))
        };
        now.modes(self.highest).all(resolves)
    }

    /// Error of the method that is allowed to a mode with a multiplier of this size, relative to
    /// it.
    fn tolerance_of(&self, size: f64) -> f64 {
        (self.tolerance / size.min(1.0)).min(SEEN.max(self.tolerance))
    }

    /// The number of steps to go on with.
    fn next_steps(&self, now: &Spectrum, steps: usize) -> usize {
        let most = self.shared(2 * steps - 1);
        if self.states <= FIRST {
            return most;
        }
        let of_mode = |(frequency, size): (f64, f64)| {
            let tolerance = self.tolerance_of(size);
            self.resolution.steps(self.angle(frequency), tolerance)
        };
        let wanted = now.modes(self.highest).map(of_mode).max().unwrap_or(0);
        let wanted = self.shared((wanted * FEWER[1]).div_ceil(FEWER[0]));
        // As many as that were not enough where these are fewer.
        match wanted > steps {
            true => wanted.clamp(self.shared(steps + steps / 4), most),
            false => most,
        }
    }
}

/// What came of a comparison with fewer steps.
struct Compared {
    judgement: Judgement,
    /// Whether these are all multipliers that there are, and resolved.
    all: bool,
}

/// What came with some number of steps.
struct Found {
    judgement: Judgement,
    spectrum: Spectrum,
    steps: usize,
    /// Frequency up to which multipliers are known, of that which was asked for.
    reach: f64,
    /// Largest error that counts.
    error: f64,
    /// Whether these are all multipliers that there are, and resolved.
    all: bool,
}
