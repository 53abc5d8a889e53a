//! Sizes of scaled increments.

use crate::solve::linear::dense::largest;
use crate::system::Layout;
use std::f64::consts::TAU;

/// Largest increment of a motion or a scalar.
pub(super) fn norm(layout: Layout, increment: &[f64]) -> f64 {
    largest(&increment[layout.motions()]).max(largest(&increment[layout.scalars()]))
}

/// Largest increment of an own unknown, relative to the largest of their `values`, which are not
/// scaled.
pub(super) fn change_of_own(
    layout: Layout,
    increment: &[f64],
    scales: &[f64],
    values: &[f64],
) -> f64 {
    let change = largest(&increment[layout.own()]);
    relative_change(change, largest_scaled(values, &scales[layout.own()]))
}

/// Largest of own unknowns that are not scaled, in these scales.
pub(crate) fn largest_scaled(values: &[f64], scales: &[f64]) -> f64 {
    let values = values.iter().zip(scales);
    values.fold(0.0, |m: f64, (x, s)| m.max((x / s).abs()))
}

/// The largest change of own unknowns, relative to the largest of them as it becomes.
pub(crate) fn relative_change(change: f64, largest: f64) -> f64 {
    match change == 0.0 {
        true => 0.0,
        false => change / largest.max(change),
    }
}

/// Largest turn of a node about one of its axes.
pub(super) fn largest_turn(layout: Layout, increment: &[f64]) -> f64 {
    let motions = increment[layout.motions()].chunks_exact(6);
    let turns = motions.flat_map(|u| &u[3..]);
    turns.fold(0.0, |m: f64, x| m.max(x.abs()))
}

/// Largest motion at thirds of the period of a wave, of which these are cosines and sines.
pub(super) fn norm_of_wave(layout: Layout, parts: &[f64]) -> f64 {
    let thirds = [0.0, 1.0, 2.0].map(|third| (TAU * third / 3.0).sin_cos());
    let mut most = 0.0f64;
    for node in parts[layout.motions()].chunks_exact(layout.of_node()) {
        let (cosines, sines) = node.split_at(6);
        for (c, s) in cosines.iter().zip(sines) {
            for (sine, cosine) in thirds {
                most = most.max((c * cosine + s * sine).abs());
            }
        }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::System;
    use crate::test_models::small::crank_rocker;

    #[test]
    fn motions_own_unknowns_and_scalars_are_measured_apart() {
        let (model, period) = crank_rocker(1, 1, 3.0);
        let system = System::new(&model, period).unwrap();
        let layout = system.layout(3).with_scalars(1);
        let mut x = vec![0.0; layout.size()];
        let scales = vec![2.0; layout.size()];
        let mut values = vec![0.0; layout.own().len()];
        x[layout.motion(1, 2)].copy_from_slice(&[0.0, -3.0, 0.0, 0.0, 0.5, -0.7]);
        assert_eq!(norm(layout, &x), 3.0);
        assert_eq!(largest_turn(layout, &x), 0.7);
        assert_eq!(change_of_own(layout, &x, &scales, &values), 0.0);
        x[layout.own().start] = -5.0;
        x[layout.scalars().start] = -4.0;
        assert_eq!(norm(layout, &x), 4.0);
        // Nothing is larger than itself.
        assert_eq!(change_of_own(layout, &x, &scales, &values), 1.0);
        values[3] = -100.0;
        assert_eq!(change_of_own(layout, &x, &scales, &values), 0.1);
        let layout = system.layout(2);
        let mut wave = vec![0.0; layout.size()];
        wave[layout.motion(1, 1)][2] = 2.0;
        assert!((norm_of_wave(layout, &wave) - 3.0f64.sqrt()).abs() < 1e-15);
        wave[layout.motion(2, 0)][4] = -4.0;
        assert_eq!(norm_of_wave(layout, &wave), 4.0);
    }
}
