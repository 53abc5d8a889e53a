//! Grids made finer until the estimated error meets a tolerance.
//! See docs/theory.md, section 10.4.

use super::Periodic;
use crate::collocation::{Decay, DecayKind, GridState};
use crate::error::{Error, ErrorKind, Result, require_positive_number};
use crate::fourier::TimeGrid;
use crate::solve::newton::on_grid::Found;
use crate::solve::periodic::loads::Loads;
use crate::solve::report::Outcome;
use crate::solve::result::{Assessment, GridTried};
use crate::solve::starts::{PATIENCE, affords_more};
use crate::system::System;

/// When to stop making grids finer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptation {
    /// Largest estimated error of the motions that is accepted: positions relative to the
    /// characteristic length, entries of rotation matrices.
    pub error_tolerance: f64,
    /// If not zero, also the largest that is accepted relative to the amplitude of the response:
    /// the largest deviation of a node from its mean, or from its steady turn.
    pub response_tolerance: f64,
    /// Largest number of grid points.
    pub largest: usize,
}

impl Default for Adaptation {
    /// Errors of a millionth of the size of the mechanism, which leaves three or four digits to
    /// forces and accelerations, second derivatives, on at most 511 points: pulses of a fortieth of
    /// the period need more than half as many.
    fn default() -> Self {
        Adaptation {
            error_tolerance: 1e-6,
            response_tolerance: 0.0,
            largest: 511,
        }
    }
}

/// Points of the first grid. A prime, so that harmonics that a symmetry leaves out appear by
/// aliasing.
const FIRST: usize = 11;
/// Points of the initial guess to one of a first grid that small: quasi-static steps are as many
/// anyway.
const GUESS_FACTOR: usize = 3;
/// Least and largest factor from one grid to the next; of an unresolved response, whose decay tells
/// little.
const GROWTH: [f64; 3] = [1.15, 4.0, 2.0];
/// The next grid aims at this fraction of the tolerance.
const AIM: f64 = 0.2;
/// And at this one of what harmonics of loads cause, which are known.
const AIM_OF_LOADS: f64 = 0.3;
/// Harmonics of a quasi-static motion that may be what its Newton iterations leave.
pub(super) const LEFT_BY_GUESS: f64 = 1e-5;
/// Inertial displacement, in scaled unknowns, of a quasi-static motion whose harmonics are those of
/// the response: the slow motion of a mechanism.
const SLOW: f64 = 0.001;
/// A larger error is that of a grid which is far too coarse.
pub(super) const UNRESOLVED: f64 = 0.01;
/// Iterations within which a solution on a mapped grid is found from the quasi-static motion, or
/// not at all: four to six mostly.
const NEAR_REST: usize = 12;
/// A measured error this many times its estimate shows that the decay deceives.
const DECEIVED: f64 = 10.0;
/// A difference of solutions that is larger is none of rounding.
const ROUNDING: f64 = 1e-10;
/// A deviation from rest or from a steady turn that is none.
const AT_REST: f64 = 1e-13;
/// From this number of points on they are chosen for quick Fourier transforms.
const LARGE: usize = 64;

impl Adaptation {
    pub(crate) fn validate(&self) -> Result<()> {
        require_positive_number("options.error_tolerance", self.error_tolerance)?;
        if !(self.response_tolerance.is_finite() && self.response_tolerance >= 0.0) {
            let expected = "zero or a positive, finite number";
            let name = "options.response_tolerance";
            return Err(Error::value(name, expected, self.response_tolerance));
        }
        if self.largest < 3 {
            let name = "options.largest_grid_points";
            return Err(Error::size(name, "at least 3", self.largest));
        }
        Ok(())
    }

    /// The same for a response as in `state`: with the tolerance that its amplitude leaves.
    fn of_response(&self, system: &System, grid: TimeGrid, state: &GridState) -> Self {
        let wanted = self.response_tolerance * state.amplitude(system, grid);
        // Nothing but rounding moves.
        let moves = wanted > self.response_tolerance * AT_REST;
        Adaptation {
            error_tolerance: if moves {
                self.error_tolerance.min(wanted)
            } else {
                self.error_tolerance
            },
            ..*self
        }
    }

    /// The largest odd number of points.
    pub(super) fn largest_odd(&self) -> usize {
        self.largest.saturating_sub((self.largest + 1) % 2)
    }

    /// Points of the first grid: enough for the harmonics of the signals that motions owe most to,
    /// if allowed.
    pub(crate) fn first(&self, loads: &Loads) -> usize {
        let most = (self.largest_odd() - 1) / 2;
        let points = 2 * loads.essential(most) + 1;
        points.max(FIRST).min(self.largest_odd())
    }

    /// Points of the first grid from a solution on `points`, or from a march, which has none.
    pub fn start_from(&self, points: usize) -> usize {
        let first = if points > 1 {
            points
        } else {
            GUESS_FACTOR * FIRST
        };
        first.min(self.largest_odd())
    }

    /// Points at which the initial guess is found.
    pub(crate) fn guess(&self, first: usize) -> usize {
        if first == FIRST && GUESS_FACTOR * FIRST <= self.largest {
            GUESS_FACTOR * FIRST
        } else {
            first
        }
    }

    /// Points of the grid after one of `points` on which harmonics fall like this.
    pub(crate) fn next_by_decay(&self, points: usize, decay: &Decay) -> usize {
        let [least, _, most] = GROWTH;
        let reduction = (AIM * self.error_tolerance / decay.tail).ln();
        let wanted = points as f64 + 2.0 * reduction / decay.ratio.ln();
        let wanted = if wanted.is_finite() { wanted } else { f64::MAX };
        let next = wanted.clamp(least * points as f64, most * points as f64);
        quick(next.ceil() as usize).min(self.largest_odd())
    }

    /// Points that hold all harmonics but those whose sum is far below the tolerance.
    pub(crate) fn enough(&self, decay: &Decay) -> usize {
        let mut left_out = 0.0;
        let is_left_out = |amplitude: &&f64| {
            left_out += 2.0 * **amplitude;
            left_out <= AIM * self.error_tolerance
        };
        let without = decay.amplitudes.iter().rev().take_while(is_left_out);
        let kept = decay.amplitudes.len() - without.count();
        quick((2 * kept).saturating_sub(1)).min(self.largest_odd())
    }

    /// Points of the grid after one of `points` with this estimate.
    pub(crate) fn next(&self, points: usize, found: &Assessment, loads: &Loads) -> usize {
        let [least, largest, unresolved] = GROWTH;
        let most = match found.decay.kind {
            DecayKind::Fast if found.error.is_finite() => largest,
            _ => unresolved,
        };
        let reduction = (AIM * self.error_tolerance / found.error).ln();
        // Each harmonic takes two points.
        let wanted = points as f64 + 2.0 * reduction / found.decay.ratio.ln();
        let wanted = if wanted.is_finite() { wanted } else { f64::MAX };
        let (least, mut most) = (least * points as f64, most * points as f64);
        let mut wanted = wanted;
        // Far from resolved, what resounds is not known.
        if let Some(harmonic) = found.resounding
            && found.error <= self.error_tolerance
        {
            wanted = wanted.max((2 * harmonic + 1) as f64);
        }
        // What loads need is known.
        if let Some(unheld) = &found.unheld {
            let fraction = AIM_OF_LOADS * self.error_tolerance / unheld.error;
            let needed = loads.needed((points - 1) / 2, fraction);
            let needed = needed.map_or(0.0, |(_, harmonic)| (2 * harmonic + 1) as f64);
            if unheld.error > 0.5 * found.error {
                wanted = needed;
                most = most.max(needed);
            } else {
                wanted = wanted.max(needed);
            }
        }
        let next = wanted.clamp(least, most).ceil() as usize;
        quick(next).min(self.largest_odd())
    }
}

/// An odd number of at least `points` that has quick Fourier transforms.
pub(super) fn quick(points: usize) -> usize {
    let mut candidate = points | 1;
    if candidate < LARGE {
        return candidate;
    }
    let is_quick = |mut n: usize| {
        for prime in [3, 5, 7, 11, 13] {
            while n.is_multiple_of(prime) {
                n /= prime;
            }
        }
        n == 1
    };
    while !is_quick(candidate) {
        candidate += 2;
    }
    candidate
}

/// Estimate of the solution on the grid before, by its own harmonics and constraints, and that
/// solution at the points of the present one.
struct Before {
    estimate: f64,
    state: GridState,
}

impl Before {
    /// The estimated error of the present solution, given one by its own harmonics: the error of
    /// the grid before, as measured, shows how far to trust estimates.
    fn corrected(&self, state: &GridState, length: f64, error: f64) -> f64 {
        let measured = self.state.distance(state, length);
        let trust = measured / self.estimate;
        if trust > DECEIVED {
            error.max(measured)
        } else {
            error * trust.max(1.0)
        }
    }
}

/// What to do after a solution was assessed.
enum Next {
    /// It is accurate enough.
    Accept,
    /// The tolerance is missed, and why nothing can be done about it.
    Miss(String),
    /// The same, as no more points are allowed.
    Exhausted(String),
    /// Go on with so many points.
    Refine(usize),
}

impl Next {
    /// Points that would be wanted after so many.
    fn wanted(&self, points: usize) -> Option<f64> {
        match self {
            Next::Accept | Next::Miss(_) => None,
            Next::Exhausted(_) => Some(GROWTH[2] * points as f64),
            Next::Refine(next) => Some(*next as f64),
        }
    }
}

/// That the tolerance is missed on so many points, and why nothing is done about it.
fn describe_missed(
    found: &Assessment,
    points: usize,
    adaptation: &Adaptation,
    why: &str,
) -> String {
    let doubt = found.resounding.map_or(String::new(), |harmonic| {
        format!(" (but harmonic {harmonic}, which they do not have, is near a natural frequency)")
    });
    format!(
        "the estimated error of the motions is {:.1e} on {points} grid points{doubt}, and the \
         tolerance {:.1e}: {why}",
        found.error, adaptation.error_tolerance
    )
}

impl Periodic<'_> {
    /// Solves on ever finer grids, from a given state or the library's own start; after the first,
    /// as accurately as grids on the way ask for.
    pub(super) fn refine_roughly(
        &mut self,
        adaptation: &Adaptation,
        start: Option<GridState>,
    ) -> Result<Found> {
        // What a user's force does in time is not known beforehand: one grid alone may miss it.
        let mut deceivable = start.is_none() && self.on.system.calls_functions();
        let (mut state, mut report) = match start {
            Some(state) => self.on.solve(state)?,
            None => self.on_first_grid(adaptation)?,
        };
        let length = self.on.system.scales().length;
        let mut before: Option<Before> = None;
        while report.outcome == Outcome::Converged {
            let adaptation = adaptation.of_response(&self.on.system, self.on.grid, &state);
            let mut found = self.assess(&mut state, &report)?;
            let estimate = found.error;
            if let Some(before) = &before {
                found.error = before.corrected(&state, length, found.error);
            }
            let (coarse, points) = (self.on.grid, self.on.grid.points());
            self.grids.push(GridTried {
                points,
                iterations: report.iterations.len(),
                error_estimate: found.error,
            });
            self.keep_if_best(&state, found.error);
            let missed = |why: &str| describe_missed(&found, points, &adaptation, why);
            let next = self.after(&adaptation, &found, deceivable);
            let wanted = next.wanted(points);
            let sharper = self.sharper_grid(&adaptation, &found, wanted, &state)?;
            let fine = match (next, sharper) {
                (Next::Accept, _) => break,
                (_, Some(grid)) => grid,
                (Next::Refine(next), None) => {
                    let system = &self.on.system;
                    coarse.with_points(system.shared_points(next, adaptation.largest))?
                }
                (Next::Miss(why) | Next::Exhausted(why), None) => {
                    report.outcome = Outcome::ToleranceNotMet;
                    report.explanation = missed(&why);
                    break;
                }
            };
            deceivable = false;
            self.go_roughly(adaptation.error_tolerance);
            let start = match self.on.carry_to(fine, &state) {
                Err(error) if error.kind() == ErrorKind::OutOfMemory => {
                    report.outcome = Outcome::ToleranceNotMet;
                    report.explanation = missed(&error.to_string());
                    break;
                }
                start => start?,
            };
            let worked = self.on.newton.equations.workers().work().done();
            let (fine, fine_report) = self.find_on_finer(start.as_ref(), found.error)?;
            // That constraints contradict each other may show between the points of a coarse grid
            // only.
            let is_spent = fine_report.outcome == Outcome::WorkLimit;
            let newly_mapped = coarse.map() != self.on.grid.map();
            if newly_mapped && (is_spent || !fine_report.outcome.is_final()) {
                self.maps.led_nowhere();
                self.on.newton.equations.workers().work().take_back(worked);
                self.grids.pop();
                self.on.move_to(coarse)?;
                continue;
            }
            if is_spent || !fine_report.outcome.is_final() {
                let (tried, how) = (self.on.grid.points(), fine_report.outcome.describe());
                report.outcome = Outcome::ToleranceNotMet;
                report.explanation =
                    missed(&format!("no solution was found on {tried} points ({how})"));
                self.on.move_to(coarse)?;
                break;
            }
            before = start.map(|state| Before { estimate, state });
            (state, report) = (fine, fine_report);
        }
        self.best_of((state, report))
    }

    /// What to do after a solution with this assessment.
    fn after(&self, adaptation: &Adaptation, found: &Assessment, deceivable: bool) -> Next {
        let points = self.on.grid.points();
        let next = adaptation.next(points, found, &self.loads);
        let accepted = found.error <= adaptation.error_tolerance;
        let doubtful = deceivable || found.resounding.is_some();
        if accepted && (!doubtful || next <= points) {
            return Next::Accept;
        }
        // Unless it is that of a motion which the harmonics do not show.
        let is_rounding = found.decay.kind == DecayKind::Rounding && found.error < ROUNDING;
        if is_rounding && !accepted {
            return Next::Miss("rounding allows no less, as the harmonics no longer fall".into());
        }
        if next > points {
            return Next::Refine(next);
        }
        let why = match (self.describe_unheld(), found.decay.kind) {
            (Some(unheld), _) => format!("; {unheld}"),
            (None, DecayKind::Slow) => format!(
                "; harmonics fall slowly, as with a kink or a narrow peak near t = {:.4}",
                found.decay.least_resolved
            ),
            _ => String::new(),
        };
        let most = adaptation.largest;
        Next::Exhausted(format!("no more than {most} grid points are allowed{why}"))
    }

    /// A solution on a finer grid, which that on the one before is carried to.
    fn find_on_finer(&mut self, carried: Option<&GridState>, error: f64) -> Result<Found> {
        if let Some(rest) = self.near_rest(error)? {
            let most = self.on.means.newton.iteration_limit;
            self.on.means.newton.iteration_limit = most.min(NEAR_REST);
            let found = self.solve_with_patience(rest);
            self.on.means.newton.iteration_limit = most;
            let found = found?;
            if self.on.is_final(found.1.outcome) {
                return Ok(found);
            }
            self.on.begin_again()?;
        }
        match carried {
            Some(carried) => self.find_from_carried(carried.clone(), error),
            None => self.starts.solve(&mut self.on),
        }
    }

    /// From the solution on a coarser grid, of this error. There may be none near, where that
    /// resolves nothing or solves the coarse equations alone: then from the library's own starts,
    /// if that is not long work.
    fn find_from_carried(&mut self, start: GridState, error: f64) -> Result<Found> {
        let found = match error <= UNRESOLVED {
            true => self.on.solve(start)?,
            false => self.solve_with_patience(start)?,
        };
        if self.on.is_final(found.1.outcome) || !affords_more(&self.on) {
            return Ok(found);
        }
        self.on.begin_again()?;
        self.starts.solve_at_once(&mut self.on)
    }

    /// From a start that may be far: given up after a few short steps.
    fn solve_with_patience(&mut self, start: GridState) -> Result<Found> {
        self.on.newton.patience = Some(PATIENCE);
        let found = self.on.solve(start);
        self.on.newton.patience = None;
        found
    }

    /// A solution on the first grid; where it is too coarse for that, on that of the initial guess.
    fn on_first_grid(&mut self, adaptation: &Adaptation) -> Result<Found> {
        if self.on.grid == self.starts.grid {
            return self.starts.solve(&mut self.on);
        }
        if let Some(points) = self.points_of_guess(adaptation)? {
            self.on.move_to(self.on.grid.with_points(points)?)?;
        }
        let (state, report) = self.starts.solve_at_once(&mut self.on)?;
        if self.on.is_final(report.outcome) {
            return Ok((state, report));
        }
        self.on.move_to(self.starts.grid)?;
        self.starts.solve(&mut self.on)
    }

    /// Points that the quasi-static motion takes where it is the response, all motions being
    /// prescribed, or so near it that inertia hardly displaces it.
    fn points_of_guess(&mut self, adaptation: &Adaptation) -> Result<Option<usize>> {
        let (from, system) = (self.starts.grid, self.on.system.clone());
        let Some(state) = self.starts.first_where_found(&mut self.on)? else {
            return Ok(None);
        };
        let mut amplitudes = Decay::of(&system, from, state).amplitudes;
        let Some(last) = amplitudes.iter().rposition(|a| *a > LEFT_BY_GUESS) else {
            return Ok(None);
        };
        amplitudes.truncate(last + 1);
        let decay = Decay::from_amplitudes(amplitudes);
        let (first, tolerance) = (self.on.grid.harmonics() as f64, adaptation.error_tolerance);
        let on_first = decay.tail * decay.ratio.powf(first - last as f64);
        let further = (AIM * tolerance / decay.tail).ln() / decay.ratio.ln();
        let wanted = 2.0 * (last as f64 + further) + 1.0;
        if decay.kind != DecayKind::Fast || !wanted.is_finite() || on_first <= tolerance {
            return Ok(None);
        }
        if system.has_freedoms() && self.starts.inertial_displacement(&mut self.on)? > SLOW {
            return Ok(None);
        }
        let most = GROWTH[1] * self.on.grid.points() as f64;
        let points = quick(wanted.min(most).ceil() as usize);
        let points = points.min(adaptation.largest_odd());
        Ok(Some(system.shared_points(points, adaptation.largest)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_grids_have_small_primes() {
        assert_eq!([4, 11, 17].map(quick), [5, 11, 17]);
        assert_eq!([64, 67, 254, 1000].map(quick), [65, 75, 273, 1001]);
    }
}
