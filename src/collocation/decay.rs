//! How fast the harmonics of the motions decay: what a grid leaves out, and where in the period.
//! See docs/theory.md, section 10.1.

use super::like_blades::Leaders;
use super::state::GridState;
use crate::fourier::{Resampling, TimeGrid};
use crate::motion::Motion;
use crate::system::System;
use serde::{Deserialize, Serialize};

/// How the upper half of the harmonics of a solution falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum DecayKind {
    /// There are too few harmonics to tell, or the solve has not converged.
    #[default]
    Unknown,
    /// Fast, as the harmonics of a smooth response that the grid resolves.
    Fast,
    /// No faster than a power of their number: the response has a kink, or a peak too narrow for
    /// the grid.
    Slow,
    /// They are rounding: more harmonics tell nothing more.
    Rounding,
}

/// Harmonics of the motions of a solution, and how they fall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Decay {
    /// Largest amplitude of each harmonic, from 0, over all nodes: positions relative to the
    /// characteristic length, entries of rotation matrices.
    pub amplitudes: Vec<f64>,
    /// How their upper half falls.
    pub kind: DecayKind,
    /// The exponent `p`, if it falls as `j⁻ᵖ`: 2 where velocities jump, 3 where accelerations do,
    /// ever larger with more harmonics of a smooth response. Zero if it is not known.
    pub order: f64,
    /// Time at which the upper half of the harmonics adds up to most.
    pub least_resolved: f64,
    /// What is left out and what it aliases onto, estimated from the fall.
    pub tail: f64,
    /// Factor from one harmonic to the next.
    pub ratio: f64,
}

/// A fall no faster than with this power of the number of harmonics is slow.
const SLOW_ORDER: f64 = 4.0;
/// Harmonics that are as small as this and do not fall are rounding.
const LARGEST_ROUNDING: f64 = 1e-10;
/// A harmonic this much larger than rounding is not followed by one of rounding, unless by
/// symmetry.
const SYMMETRIC: f64 = 100.0;
/// Rounding of a sum over the grid.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Decay {
    /// Harmonics of the motions in `state`.
    pub fn of(system: &System, grid: TimeGrid, state: &GridState) -> Self {
        Self::of_leaders(system, grid, (state, None))
    }

    /// The same; if blades move alike, of the nodes that differ from others by more than by what
    /// time it is.
    pub(crate) fn of_leaders(
        system: &System,
        grid: TimeGrid,
        (state, leaders): (&GridState, Option<&Leaders>),
    ) -> Self {
        let length = system.scales().length;
        let last = grid.harmonics();
        let mut resampling = Resampling::new(grid, 0.0, grid.points());
        let mut amplitudes = vec![0.0f64; last + 1];
        let mut upper = vec![0.0; grid.points()];
        let mut largest = vec![0.0f64; grid.points()];
        let mut add = |motions: &[Motion], value: &dyn Fn(&Motion) -> f64| {
            resampling.read(motions.iter().map(value));
            for (amplitude, here) in amplitudes.iter_mut().zip(resampling.amplitudes()) {
                *amplitude = amplitude.max(here);
            }
            if last > 0 {
                resampling.write(0, last / 2 + 1, &mut upper);
                for (most, here) in largest.iter_mut().zip(&upper) {
                    *most = most.max(here.abs());
                }
            }
        };
        for node in 0..system.nodes() {
            if leaders.is_some_and(|leaders| leaders.is_copied(node)) {
                continue;
            }
            let motions = state.node(node);
            for i in 0..3 {
                add(motions, &|m| m.position[i] / length);
            }
            for i in 0..9 {
                add(motions, &|m| m.rotation[i]);
            }
        }
        // Others are there a part of the period later.
        let part = leaders.map_or(grid.points(), Leaders::part);
        for k in part..grid.points() {
            largest[k % part] = largest[k % part].max(largest[k]);
        }
        let most = (0..part).fold(0, |k, l| if largest[l] > largest[k] { l } else { k });
        Decay {
            least_resolved: grid.time(most),
            ..Decay::from_amplitudes(amplitudes)
        }
    }

    /// Of these amplitudes: fits geometric decay to the upper half, by least squares of logarithms.
    pub fn from_amplitudes(amplitudes: Vec<f64>) -> Self {
        let mut last = amplitudes.len() - 1;
        // One that vanishes by symmetry tells nothing of those that are left out.
        let vanishing = ROUNDING * amplitudes.iter().fold(0.0f64, |most, a| most.max(*a));
        if last > 3 && amplitudes[last] <= vanishing && amplitudes[last - 1] > SYMMETRIC * vanishing
        {
            last -= 1;
        }
        // Upper envelope, so that harmonics that vanish by symmetry do not feign decay.
        let mut envelope = amplitudes[..=last].to_vec();
        for j in (0..last).rev() {
            envelope[j] = envelope[j].max(envelope[j + 1]);
        }
        let rounding = ROUNDING * envelope[0];
        let mut decay = Decay {
            amplitudes,
            kind: DecayKind::Unknown,
            order: 0.0,
            least_resolved: 0.0,
            tail: 0.0,
            ratio: 0.0,
        };
        if last == 0 {
            // A single point: nothing is known of any harmonic. A constant solution is exact.
            return decay;
        }
        let first = (last / 2).max(1);
        let mut end = envelope[last];
        // Of a single harmonic nothing can be fitted.
        decay.ratio = 0.5;
        if last > first && end > 0.0 {
            let logarithms: Vec<f64> = envelope[first..].iter().map(|e| e.ln()).collect();
            let middle = 0.5 * (last - first) as f64;
            let mean = logarithms.iter().sum::<f64>() / logarithms.len() as f64;
            let (mut xx, mut xy) = (0.0, 0.0);
            for (i, y) in logarithms.iter().enumerate() {
                let x = i as f64 - middle;
                xx += x * x;
                xy += x * (y - mean);
            }
            let slope = xy / xx;
            end = end.max((mean + slope * middle).exp());
            decay.ratio = slope.exp().min(0.999);
            decay.order =
                (envelope[first] / envelope[last]).ln() / (last as f64 / first as f64).ln();
            let left_out = 2.0 * end * decay.ratio / (1.0 - decay.ratio);
            let is_flat = envelope[first] < LARGEST_ROUNDING && decay.order < SLOW_ORDER;
            decay.kind = if is_flat || left_out < rounding {
                DecayKind::Rounding
            } else if decay.order < SLOW_ORDER {
                DecayKind::Slow
            } else {
                DecayKind::Fast
            };
        } else if end == 0.0 {
            decay.kind = DecayKind::Rounding;
        }
        // Rounding does not add up as harmonics in phase do.
        decay.tail = match decay.kind {
            DecayKind::Rounding => 4.0 * end,
            _ => 2.0 * end * decay.ratio / (1.0 - decay.ratio),
        }
        .max(rounding);
        decay
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn geometric_decay_is_summed() {
        for ratio in [0.1f64, 0.5, 0.8] {
            let decay = Decay::from_amplitudes((0..=12).map(|j| ratio.powi(j)).collect());
            let exact = 2.0 * ratio.powi(13) / (1.0 - ratio);
            assert!((decay.tail / exact - 1.0).abs() < 1e-9, "{ratio}");
            assert!((decay.ratio - ratio).abs() < 1e-12);
        }
        // Vanishing odd harmonics do not matter.
        let even = |j: i32| if j % 2 == 0 { 0.5f64.powi(j) } else { 0.0 };
        let decay = Decay::from_amplitudes((0..=12).map(even).collect());
        let exact = 2.0 * 0.25f64.powi(7) / 0.75;
        assert!(decay.tail > exact && decay.tail < 5.0 * exact);
    }

    #[test]
    fn a_last_harmonic_that_vanishes_by_symmetry_tells_nothing() {
        let even = |j: i32| if j % 2 == 0 { 0.5f64.powi(j) } else { 0.0 };
        let of = |last: i32| Decay::from_amplitudes((0..=last).map(even).collect());
        let (with, without) = (of(13), of(12));
        assert_eq!(with.amplitudes.len(), 14);
        assert_eq!((with.tail, with.ratio), (without.tail, without.ratio));
        assert_eq!((with.kind, with.order), (without.kind, without.order));
    }

    #[test]
    fn smooth_responses_kinks_and_rounding_are_told_apart() {
        let of = |amplitude: &dyn Fn(f64) -> f64, last: i32| {
            Decay::from_amplitudes((0..=last).map(|j| amplitude(j as f64)).collect())
        };
        let smooth = of(&|j| 0.6f64.powf(j), 20);
        assert_eq!(smooth.kind, DecayKind::Fast);
        for order in [1.0, 2.0, 3.0] {
            let kink = of(&|j| (j + 1e-3).powf(-order), 60);
            assert_eq!(kink.kind, DecayKind::Slow);
            assert!((kink.order - order).abs() < 1e-3, "{}", kink.order);
        }
        let rounding = of(&|j| 0.1f64.powf(j).max(1e-15 * (1.0 + j.sin())), 60);
        assert_eq!(rounding.kind, DecayKind::Rounding);
        assert!(rounding.tail < 1e-14);
        // A rigid motion: one harmonic, and no other.
        assert_eq!(
            of(&|j| if j < 2.0 { 1.0 } else { 0.0 }, 5).kind,
            DecayKind::Rounding
        );
    }

    #[test]
    fn what_decays_below_rounding_is_known_to_rounding() {
        let decay = Decay::from_amplitudes((0..=12).map(|j| 0.01f64.powi(j)).collect());
        assert_eq!(decay.kind, DecayKind::Rounding);
        assert!(decay.tail < 1e-14, "{:e}", decay.tail);
    }
}
