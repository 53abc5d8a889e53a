//! How far to trust a solution: decay of its harmonics, and the equations between grid points.

use crate::collocation::{GridState, ResidualBetween, residual_between};
use crate::error::{ErrorKind, Result};
use crate::fourier::{PeriodicSeries, TimeGrid};
use crate::motion::Motion;
use crate::solve::{Outcome, PeriodicSolve};
use serde::{Deserialize, Serialize};

/// Error estimates of a solution. Those that cannot be had are infinite; of a march none can.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Diagnostics {
    /// Largest amplitude of each harmonic, from 0, over all nodes: positions relative to the
    /// characteristic length, entries of rotation matrices.
    pub harmonics: Vec<f64>,
    /// Estimated error of the motions, from the decay of `harmonics`.
    pub error_estimate: f64,
    /// Residuals half-way between grid points.
    pub between: ResidualBetween,
}

impl Diagnostics {
    /// Diagnostics of a solve.
    pub(super) fn of(solve: &PeriodicSolve) -> Result<Self> {
        let infinite = ResidualBetween {
            force: f64::INFINITY,
            constraint: f64::INFINITY,
        };
        if solve.march.is_some() {
            return Ok(Diagnostics {
                harmonics: Vec::new(),
                error_estimate: f64::INFINITY,
                between: infinite,
            });
        }
        if solve.report.outcome == Outcome::NoInitialGuess {
            return Ok(Diagnostics {
                harmonics: vec![0.0; solve.grid.harmonics() + 1],
                error_estimate: f64::INFINITY,
                between: infinite,
            });
        }
        let length = solve.system.scales().length;
        let harmonics = largest_harmonics(&solve.state, solve.grid, solve.system.nodes(), length);
        let between = match residual_between(&solve.system, solve.grid, &solve.state) {
            Ok(between) => between,
            // What cannot be interpolated, or is distorted between points, is no failure of the call.
            Err(e) if matches!(e.kind(), ErrorKind::GridTooCoarse | ErrorKind::Model) => infinite,
            Err(e) => return Err(e),
        };
        // A static solution tells nothing of what is driven in time.
        let unknown = solve.report.outcome != Outcome::Converged
            || (solve.grid.points() == 1 && varies(solve)?);
        let error_estimate = if unknown {
            f64::INFINITY
        } else {
            tail(&harmonics)
        };
        Ok(Diagnostics {
            error_estimate,
            harmonics,
            between,
        })
    }
}

/// Whether anything drives the system in time.
fn varies(solve: &PeriodicSolve) -> Result<bool> {
    if solve.system.calls_functions() {
        // Which may depend on time.
        return Ok(true);
    }
    const SAMPLES: usize = 8;
    let values = |k: usize| -> Result<Vec<f64>> {
        let time = solve.grid.period() * k as f64 / SAMPLES as f64;
        let mut values = vec![0.0; solve.system.signals()];
        solve.system.signal_values(time, 1.0, &mut values)?;
        Ok(values)
    };
    let start = values(0)?;
    for k in 1..SAMPLES {
        if values(k)? != start {
            return Ok(true);
        }
    }
    Ok(false)
}

fn largest_harmonics(state: &GridState, grid: TimeGrid, nodes: usize, length: f64) -> Vec<f64> {
    let mut largest = vec![0.0f64; grid.harmonics() + 1];
    let mut add = |motions: &[Motion], value: &dyn Fn(&Motion) -> f64| {
        let samples: Vec<f64> = motions.iter().map(value).collect();
        let series = PeriodicSeries::from_samples(grid.period(), &samples, 0.0);
        largest[0] = largest[0].max(series.mean.abs());
        for (j, (c, s)) in series.cosines.iter().zip(&series.sines).enumerate() {
            largest[j + 1] = largest[j + 1].max(c.hypot(*s));
        }
    };
    for node in 0..nodes {
        let motions = state.node(node);
        for i in 0..3 {
            add(motions, &|m| m.position[i] / length);
        }
        for i in 0..9 {
            add(motions, &|m| m.rotation[i]);
        }
    }
    largest
}

/// Estimates the sum of the harmonics beyond the last: geometric decay, fitted to the upper half.
///
/// Twice that sum is the interpolation error: what is missing, and what it aliases onto.
fn tail(harmonics: &[f64]) -> f64 {
    let last = harmonics.len() - 1;
    if last == 0 {
        // A single point: nothing is known of any harmonic. A constant solution is exact.
        return 0.0;
    }
    // Upper envelope, so that harmonics that vanish by symmetry do not feign decay.
    let mut envelope = harmonics.to_vec();
    for j in (0..last).rev() {
        envelope[j] = envelope[j].max(envelope[j + 1]);
    }
    let first = last / 2;
    let end = envelope[last.saturating_sub(1).max(first)];
    let span = (last.saturating_sub(1).max(first) - first) as f64;
    let ratio = if span > 0.0 && envelope[first] > 0.0 {
        (end / envelope[first]).powf(1.0 / span).min(0.95)
    } else {
        0.5
    };
    // Rounding of the samples is the least there is.
    (2.0 * end * ratio / (1.0 - ratio)).max(f64::EPSILON * harmonics[0])
}

#[cfg(test)]
mod tests {
    use super::tail;

    #[test]
    fn geometric_decay_is_summed() {
        for ratio in [0.1f64, 0.5, 0.8] {
            let harmonics: Vec<f64> = (0..=12).map(|j| ratio.powi(j)).collect();
            let exact = 2.0 * ratio.powi(13) / (1.0 - ratio);
            let estimate = tail(&harmonics);
            assert!(
                estimate >= 0.99 * exact && estimate < 12.0 * exact,
                "{ratio}"
            );
        }
        // Vanishing odd harmonics do not matter.
        let even: Vec<f64> = (0..=12)
            .map(|j| if j % 2 == 0 { 0.5f64.powi(j) } else { 0.0 })
            .collect();
        assert!(tail(&even) > 0.5f64.powi(14));
    }
}
