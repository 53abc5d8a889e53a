//! How far the motions of a period are from rest, or from steady turns.

use super::state::GridState;
use crate::fourier::TimeGrid;
use crate::motion::{Motion, rotation_from_vector};
use crate::system::System;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

impl GridState {
    /// Largest deviation of a node from its mean or, if it makes whole turns in the period, from a
    /// steady turn: positions relative to the characteristic length, entries of rotation matrices.
    pub fn amplitude(&self, system: &System, grid: TimeGrid) -> f64 {
        let length = system.scales().length;
        let phases: Vec<f64> = grid.times().map(|time| time / grid.period()).collect();
        (0..system.nodes()).fold(0.0, |most, node| {
            most.max(deviation(self.node(node), &phases, length))
        })
    }
}

/// Of one node, at these parts of the period.
fn deviation(motions: &[Motion], phases: &[f64], length: f64) -> f64 {
    let count = motions.len() as f64;
    let mean = motions.iter().map(|m| m.position).sum::<Vector3<f64>>() / count;
    let following = motions.iter().cycle().skip(1);
    let turned: Vector3<f64> = motions
        .iter()
        .zip(following)
        .map(|(m, next)| m.relative(next).logarithm().fixed_rows::<3>(3).into_owned())
        .sum();
    let turns = (turned.norm() / TAU).round();
    // The axis of the turn, in the body and in space.
    let own = if turns > 0.0 {
        turned.normalize()
    } else {
        Vector3::zeros()
    };
    let space = motions
        .iter()
        .map(|m| m.rotation * own)
        .sum::<Vector3<f64>>();
    let space = space.try_normalize(0.0).unwrap_or_default();
    let relative: Vec<(Vector3<f64>, Matrix3<f64>)> = motions
        .iter()
        .zip(phases)
        .map(|(m, phase)| {
            let back = -TAU * turns * phase;
            (
                rotation_from_vector(&(space * back)) * (m.position - mean),
                m.rotation * rotation_from_vector(&(own * back)),
            )
        })
        .collect();
    let centre = relative.iter().map(|(x, _)| x).sum::<Vector3<f64>>() / count;
    let middle = relative.iter().map(|(_, r)| r).sum::<Matrix3<f64>>() / count;
    relative.iter().fold(0.0, |most: f64, (x, r)| {
        let off = ((x - centre).amax() / length).max((r - middle).amax());
        most.max(off)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steady_turns_are_no_response_and_a_small_whirl_is_one() {
        let axis = Vector3::new(0.3, -0.5, 0.8).normalize();
        let side = axis.cross(&Vector3::x()).normalize();
        let whirl = |size: f64| -> Vec<Motion> {
            let at = |k: usize| {
                let angle = TAU * k as f64 / 21.0;
                let turn = rotation_from_vector(&(axis * (2.0 * angle)));
                let place = Vector3::new(1.0, 2.0, 3.0) + turn * side * 0.4;
                Motion::new(turn, place + side * (size * (5.0 * angle).cos()))
            };
            (0..21).map(at).collect()
        };
        let phases: Vec<f64> = (0..21).map(|k| f64::from(k) / 21.0).collect();
        assert!(deviation(&whirl(0.0), &phases, 1.0) < 1e-14);
        // Of a component: between 1/√3 of the amplitude and all of it.
        let small = deviation(&whirl(1e-6), &phases, 2.0) / (0.5 * 1e-6);
        assert!((0.5..=1.0).contains(&small), "{small}");
    }

    #[test]
    fn steady_turns_of_any_period_are_no_response() {
        let (mut model, _) = crate::test_models::pendulums::oscillator();
        let far = Motion::new(Matrix3::identity(), Vector3::x() * 3.0);
        model.add_node(&far).unwrap();
        let period = 0.3;
        let system = System::new(&model, period).unwrap();
        let grid = TimeGrid::new(9, period).unwrap();
        let mut state = GridState::reference(&system, grid);
        for node in 0..system.nodes() {
            for k in 0..9 {
                let turn = rotation_from_vector(&(Vector3::z() * (TAU * k as f64 / 9.0)));
                let motion = &mut state.motions[node * 9 + k];
                *motion = Motion::new(turn, turn * Vector3::x());
            }
        }
        assert!(state.amplitude(&system, grid) < 1e-14);
    }
}
