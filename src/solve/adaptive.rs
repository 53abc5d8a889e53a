//! Grids made finer until the estimated error meets a tolerance.

use super::estimate::{Assessment, assess};
use super::newton::{NewtonReport, Outcome};
use super::periodic::{Attempts, is_final};
use crate::collocation::{DecayKind, GridState};
use crate::error::{Error, Result};
use crate::fourier::{Resampling, TimeGrid};
use crate::system::System;
use serde::{Deserialize, Serialize};

/// A grid that an adaptive solve has tried.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GridTried {
    /// Number of its points.
    pub points: usize,
    /// Newton iterations on it.
    pub iterations: usize,
    /// Estimated error of its solution.
    pub error_estimate: f64,
}

/// When to stop making grids finer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptation {
    /// Largest estimated error of the motions that is accepted: positions relative to the characteristic
    /// length, entries of rotation matrices.
    pub error_tolerance: f64,
    /// Largest number of grid points.
    pub largest: usize,
}

impl Default for Adaptation {
    /// Errors of a millionth of the size of the mechanism, at 255 points: forces and accelerations, which are
    /// second derivatives, keep three or four digits, and the direct solver's time stays within minutes.
    fn default() -> Self {
        Adaptation {
            error_tolerance: 1e-6,
            largest: 255,
        }
    }
}

/// Points of the first grid. A prime, so that harmonics that a symmetry leaves out appear by aliasing.
const FIRST: usize = 11;
/// Points of the initial guess to one of a first grid that small: quasi-static steps are as many anyway.
const GUESS_FACTOR: usize = 3;
/// Points at which signals are probed for harmonics.
const PROBE: usize = 255;
/// Harmonics of a signal below this fraction of its largest are not looked at.
const PROBED: f64 = 1e-3;
/// Least and largest factor from one grid to the next; of an unresolved response, whose decay tells little.
const GROWTH: [f64; 3] = [1.3, 4.0, 2.0];
/// The next grid aims at this fraction of the tolerance.
const AIM: f64 = 0.1;
/// A measured error this many times its estimate shows that the decay deceives.
const DECEIVED: f64 = 10.0;
/// A difference of solutions that is larger is none of rounding.
const ROUNDING: f64 = 1e-10;
/// From this number of points on they are chosen for quick Fourier transforms.
const LARGE: usize = 64;

impl Adaptation {
    pub(super) fn validate(&self) -> Result<()> {
        if !(self.error_tolerance.is_finite() && self.error_tolerance > 0.0) {
            let expected = "a positive, finite number";
            let name = "options.error_tolerance";
            return Err(Error::value(name, expected, self.error_tolerance));
        }
        if self.largest < 3 {
            let name = "options.largest_grid_points";
            return Err(Error::size(name, "at least 3", self.largest));
        }
        Ok(())
    }

    /// The largest odd number of points.
    fn largest_odd(&self) -> usize {
        self.largest.saturating_sub((self.largest + 1) % 2)
    }

    /// Points of the first grid: enough for the harmonics of the signals and as many again, if allowed.
    pub(super) fn first(&self, system: &System, period: f64) -> Result<usize> {
        let harmonics = highest_harmonic(system, period)?;
        Ok((4 * harmonics + 1).max(FIRST).min(self.largest_odd()))
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
    pub(super) fn guess(&self, first: usize) -> usize {
        if first == FIRST && GUESS_FACTOR * FIRST <= self.largest {
            GUESS_FACTOR * FIRST
        } else {
            first
        }
    }

    /// Points of the grid after one of `points` with this estimate.
    fn next(&self, points: usize, found: &Assessment) -> usize {
        let [least, largest, unresolved] = GROWTH;
        let most = match found.decay.kind {
            DecayKind::Fast if found.error.is_finite() => largest,
            _ => unresolved,
        };
        let reduction = (AIM * self.error_tolerance / found.error).ln();
        // Each harmonic takes two points.
        let wanted = points as f64 + 2.0 * reduction / found.decay.ratio.ln();
        let wanted = if wanted.is_finite() { wanted } else { f64::MAX };
        let (least, most) = (least * points as f64, most * points as f64);
        let next = wanted.clamp(least, most).ceil() as usize;
        quick(next).min(self.largest_odd())
    }
}

/// An odd number of at least `points` that has quick Fourier transforms.
fn quick(points: usize) -> usize {
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

/// Highest harmonic of the signals that counts, of those below half of [`PROBE`].
fn highest_harmonic(system: &System, period: f64) -> Result<usize> {
    let grid = TimeGrid::new(PROBE, period)?;
    let count = system.signals();
    let values = |time: f64| -> Result<Vec<f64>> {
        let mut values = vec![0.0; count];
        system.signal_values(time, 1.0, &mut values)?;
        Ok(values)
    };
    let samples = grid.times().map(values).collect::<Result<Vec<_>>>()?;
    let end = values(period)?;
    let mut resampling = Resampling::new(grid, 0.0, 1);
    let mut highest = 0;
    for signal in 0..count {
        let growth = end[signal] - samples[0][signal];
        resampling.read((0..PROBE).map(|k| samples[k][signal] - growth * k as f64 / PROBE as f64));
        let amplitudes: Vec<f64> = resampling.amplitudes().skip(1).collect();
        let largest = amplitudes.iter().fold(0.0f64, |most, x| most.max(*x));
        let size = samples
            .iter()
            .fold(0.0f64, |most, x| most.max(x[signal].abs()));
        // A constant has harmonics of rounding only.
        let least = (PROBED * largest).max(1e-12 * size);
        let last = amplitudes.iter().rposition(|x| *x > least);
        highest = highest.max(last.map_or(0, |j| j + 1));
    }
    Ok(highest)
}

impl Attempts<'_> {
    /// Solves on ever finer grids, from a given state or the library's own start.
    pub(super) fn refine(
        &mut self,
        adaptation: &Adaptation,
        start: Option<GridState>,
    ) -> Result<(GridState, NewtonReport)> {
        // What a user's force does in time is not known beforehand: one grid alone may miss it.
        let mut deceivable = start.is_none() && self.system.calls_functions();
        let (mut state, mut report) = match start {
            Some(state) => self.newton(state)?,
            None => self.on_first_grid()?,
        };
        let length = self.system.scales().length;
        // Estimate of the grid before by its own harmonics and constraints, and its state at these points.
        let mut before: Option<(f64, GridState)> = None;
        loop {
            if report.outcome != Outcome::Converged {
                return Ok((state, report));
            }
            let mut found = assess(&self.system, self.grid, &state, &self.workers)?;
            let own = found.error;
            if let Some((estimate, coarse)) = &before {
                // The error of the grid before, as measured, shows how far to trust estimates.
                let measured = coarse.distance(&state, length);
                let trust = measured / estimate;
                found.error = if trust > DECEIVED {
                    found.error.max(measured)
                } else {
                    found.error * trust.max(1.0)
                };
            }
            let points = self.grid.points();
            self.grids.push(GridTried {
                points,
                iterations: report.iterations.len(),
                error_estimate: found.error,
            });
            let next = adaptation.next(points, &found);
            let accepted = found.error <= adaptation.error_tolerance;
            if accepted && (!deceivable || next <= points) {
                return Ok((state, report));
            }
            deceivable = false;
            let mut missed = |why: &str| {
                report.outcome = Outcome::ToleranceNotMet;
                report.explanation = format!(
                    "the estimated error of the motions is {:.1e} on {points} grid points, and the tolerance {:.1e}: {why}",
                    found.error, adaptation.error_tolerance
                );
            };
            // Unless it is that of a motion which the harmonics do not show.
            let is_rounding = found.decay.kind == DecayKind::Rounding && found.error < ROUNDING;
            if is_rounding && !accepted {
                missed("rounding allows no less, as the harmonics no longer fall");
                return Ok((state, report));
            }
            if next <= points {
                missed(&format!(
                    "no more than {} grid points are allowed{}",
                    adaptation.largest,
                    match found.decay.kind {
                        DecayKind::Slow => format!(
                            "; harmonics fall slowly, as with a kink or a narrow peak near t = {:.4}",
                            found.decay.least_resolved
                        ),
                        _ => String::new(),
                    }
                ));
                return Ok((state, report));
            }
            let coarse = self.grid;
            let start = self.carry_to(TimeGrid::new(next, coarse.period())?, &state)?;
            let (fine, fine_report) = match &start {
                Some(start) => self.newton(start.clone())?,
                None => self.find()?,
            };
            match fine_report.outcome {
                Outcome::Converged => {
                    before = start.map(|start| (own, start));
                    (state, report) = (fine, fine_report);
                }
                // That constraints contradict each other may show between the points of a coarse grid only.
                Outcome::Cancelled | Outcome::Inconsistent => return Ok((fine, fine_report)),
                outcome => {
                    missed(&format!(
                        "no solution was found on {next} points ({})",
                        outcome.describe()
                    ));
                    self.move_to(coarse)?;
                    return Ok((state, report));
                }
            }
        }
    }

    /// A solution on the first grid; where it is too coarse for that, on that of the initial guess.
    fn on_first_grid(&mut self) -> Result<(GridState, NewtonReport)> {
        if self.grid == self.guess_grid {
            return self.find();
        }
        let (state, report) = self.find_at_once()?;
        if is_final(report.outcome) {
            return Ok((state, report));
        }
        self.move_to(self.guess_grid)?;
        self.find()
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
