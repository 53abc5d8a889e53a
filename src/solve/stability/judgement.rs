//! What multipliers and their errors say.

use crate::solve::report::Outcome;
use crate::solve::result::Solved;
use crate::solve::stability::hill::Exponents;
use crate::solve::stability::spectrum::Spectrum;
use crate::solve::stability::{Multiplier, Shapes, Stability, Verdict, state_count};
use nalgebra::Complex;
use std::cmp::Ordering;
use std::f64::consts::TAU;
use std::time::Duration;

/// What multipliers say.
pub(super) struct Judgement {
    verdict: Verdict,
    /// Frequency up to which it holds.
    limit: f64,
    /// Whether that is as far as was asked for.
    pub resolved: bool,
}

/// Judges multipliers, of which those above `limit` may be missing.
pub(super) fn judge(spectrum: &Spectrum, limit: f64, highest: f64, tolerance: f64) -> Judgement {
    let mut limit = limit;
    for j in 0..spectrum.count() {
        let size = spectrum.values[j].norm();
        // Written so that NaN fails too.
        let known = spectrum.errors[j] <= tolerance * size.max(1.0);
        if !known && spectrum.counts(j) {
            limit = limit.min(spectrum.frequencies[j].abs());
        }
    }
    let resolved = limit >= highest;
    let others = || (0..spectrum.count()).filter(|&j| !spectrum.shifts[j]);
    let grows = |j: usize| spectrum.values[j].norm() - spectrum.errors[j] > 1.0;
    let dies = |j: usize| spectrum.values[j].norm() + spectrum.errors[j] < 1.0;
    let within = |j: usize| spectrum.frequencies[j].abs() < limit;
    let verdict = if others().any(|j| within(j) && grows(j)) {
        Verdict::Unstable
    } else if resolved && others().all(|j| !within(j) || dies(j)) {
        Verdict::Stable
    } else {
        Verdict::NotKnown
    };
    Judgement {
        verdict,
        limit,
        resolved,
    }
}

impl Judgement {
    /// Frequency up to which multipliers are known, of those up to `highest`.
    pub fn reach(&self, highest: f64) -> f64 {
        self.limit.min(highest)
    }

    /// Whether there is a verdict.
    pub fn is_known(&self) -> bool {
        self.verdict != Verdict::NotKnown
    }

    /// The result.
    pub fn stability(
        self,
        solve: &Solved,
        spectrum: Spectrum,
        states: usize,
        steps: usize,
    ) -> Stability {
        let period = solve.grid.period();
        let mut order: Vec<usize> = (0..spectrum.count()).collect();
        order.sort_by(|&a, &b| larger_first(spectrum.values[a], spectrum.values[b]));
        let multiplier = |&j: &usize| {
            let (value, frequency) = (spectrum.values[j], spectrum.frequencies[j]);
            let turn = value.arg();
            let turns = ((frequency * period - turn) / TAU).round();
            Multiplier {
                value,
                exponent: Complex::new(value.norm().ln(), turn + TAU * turns) / period,
                frequency: frequency.abs(),
                error: spectrum.errors[j],
                trivial: spectrum.shifts[j],
            }
        };
        Stability {
            outcome: match self.resolved {
                true => Outcome::Converged,
                false => Outcome::ToleranceNotMet,
            },
            verdict: self.verdict,
            frequency_limit: self.limit,
            multipliers: order.iter().map(multiplier).collect(),
            states,
            period,
            steps,
            time: Duration::ZERO,
            shapes: Shapes { spectrum, order },
        }
    }
}

/// The order of multipliers: of a pair that with the positive imaginary part first.
fn larger_first(a: Complex<f64>, b: Complex<f64>) -> Ordering {
    b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im))
}

/// What exponents say that were found on the grid, which may not be all.
pub(super) fn judge_exponents(
    solve: &Solved,
    exponents: Exponents,
    highest: f64,
    tolerance: f64,
) -> Stability {
    let (grid, states) = (solve.grid, state_count(solve));
    let mut multipliers = Vec::new();
    for exponent in &exponents.found {
        let mut add = |exponent: Complex<f64>, frequency: f64, error: f64| {
            multipliers.push(Multiplier {
                value: (exponent * grid.period()).exp(),
                exponent,
                frequency,
                error,
                trivial: false,
            });
        };
        add(exponent.value, exponent.frequency, exponent.error);
        if exponent.is_paired(grid) {
            add(exponent.value.conj(), exponent.frequency, exponent.error);
        }
    }
    multipliers.sort_by(|a, b| larger_first(a.value, b.value));
    let known = |m: &&Multiplier| m.error <= tolerance * m.value.norm().max(1.0);
    let unknown = multipliers.iter().filter(|m| !known(m));
    let all = exponents.complete && multipliers.len() == states;
    let most = if all { f64::INFINITY } else { highest };
    let limit = unknown.fold(most, |limit, m| limit.min(m.frequency));
    let grows = |m: &Multiplier| m.value.norm() - m.error > 1.0;
    let dies = |m: &Multiplier| m.value.norm() + m.error < 1.0;
    Stability {
        outcome: match exponents.complete && limit >= highest {
            true => Outcome::Converged,
            false => Outcome::ToleranceNotMet,
        },
        verdict: if multipliers.iter().filter(known).any(grows) {
            Verdict::Unstable
        } else if all && multipliers.iter().all(dies) {
            Verdict::Stable
        } else {
            Verdict::NotKnown
        },
        frequency_limit: limit,
        multipliers,
        states,
        period: grid.period(),
        steps: 0,
        time: Duration::ZERO,
        shapes: Shapes::default(),
    }
}
