//! When a motion repeats itself, period by period.

use crate::collocation::MotionState;
use crate::system::Scales;
use std::f64::consts::TAU;

/// Largest difference of motions and velocities, as in [`MarchEnd::Periodic`](super::MarchEnd).
pub(super) fn difference(a: &MotionState, b: &MotionState, scales: &Scales, period: f64) -> f64 {
    let unit = period / TAU;
    let velocities = (a.twist.iter().zip(&b.twist))
        .map(|(a, b)| scales.size_of(&((a - b) * unit)))
        .fold(0.0, f64::max);
    velocities.max(a.state.distance(&b.state, scales.length))
}

/// Changes this much below the tolerance may be rounding, which does not decay.
const NEGLIGIBLE: f64 = 1e-2;

/// How far the last period is from the periodic motion, by the `changes` from each period to the
/// next: what is left of them if they go on to decay as they did in the last three.
pub(super) fn distance(changes: &[f64]) -> f64 {
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
pub(super) fn is_periodic(changes: &[f64], tolerance: f64) -> bool {
    let last = changes.last().copied().unwrap_or(f64::INFINITY);
    last <= NEGLIGIBLE * tolerance || distance(changes) <= tolerance
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::GridState;
    use crate::system::System;
    use crate::test_models::pendulums::oscillator;

    #[test]
    fn what_is_back_in_its_place_but_moves_otherwise_is_not_repeated() {
        let system = System::new(&oscillator().0, 1.0).unwrap();
        let scales = system.scales();
        let rest = MotionState::at_rest(0.0, GridState::at_points(&system, 1));
        let mut moving = rest.clone();
        moving.twist[0][0] = 0.3 * scales.length;
        let period = 2.0;
        let expected = 0.3 * period / TAU;
        let found = difference(&rest, &moving, scales, period);
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        assert_eq!(difference(&rest, &rest, scales, period), 0.0);
    }

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
