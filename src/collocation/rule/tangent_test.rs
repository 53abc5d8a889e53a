//! Every rule whose unknowns are motions against differences, and its transpose against itself.

use super::*;
use crate::fourier::{SharpEvent, TimeGrid, TimeMap};
use crate::system::System;
use crate::test_models::small::whirled_beam;

const PERIOD: f64 = 1.3;

fn wave(i: usize) -> f64 {
    (0.37 * i as f64).sin()
}

fn six(first: usize) -> Vector6<f64> {
    Vector6::from_fn(|i, _| wave(6 * first + i))
}

/// A state of all nodes that turn by about a radian.
fn state(system: &System, points: usize, phase: usize) -> GridState {
    let mut state = GridState::at_points(system, points);
    for (i, motion) in state.motions.iter_mut().enumerate() {
        *motion = motion.increment(&(six(i + phase) * 0.6));
    }
    state
}

fn rules(system: &System) -> Vec<(Box<dyn TimeRule>, usize)> {
    let nodes = system.nodes();
    let spectral = |points: usize| -> (Box<dyn TimeRule>, usize) {
        let grid = TimeGrid::even_or_odd(points, PERIOD).unwrap();
        (Box::new(Spectral::new(grid, nodes)), points)
    };
    let mapped = |points: usize| -> (Box<dyn TimeRule>, usize) {
        let event = |time: f64, width: f64, share: f64| SharpEvent { time, width, share };
        let events = [event(0.3, 0.1, 1.0), event(1.25, 0.2, 0.5)];
        let map = TimeMap::new(&events, PERIOD).unwrap();
        let grid = TimeGrid::new(points, PERIOD).unwrap();
        (over(grid.mapped(map), nodes), points)
    };
    let weights = BackwardWeights {
        first: [11.0, -18.0, 9.0, -2.0],
        second: [20.0, -50.0, 40.0, -10.0],
    };
    let past = (1..4).map(|step| state(system, 1, 5 * step)).collect();
    let mut start = MotionState::at_rest(0.0, state(system, 1, 7));
    for (node, twist) in start.twist.iter_mut().enumerate() {
        *twist = six(node + 11);
        start.twist_rate[node] = six(node + 31);
        start.averaged[node] = six(node + 47);
    }
    let step = AlphaStep::new(GeneralizedAlpha::new(0.7), 0.2, start);
    vec![
        spectral(1),
        spectral(5),
        spectral(11),
        spectral(12),
        mapped(5),
        mapped(11),
        (Box::new(Backward::new(weights, past)), 1),
        (Box::new(step), 1),
        (Box::new(Steady::new((0..nodes).map(six).collect())), 1),
    ]
}

#[test]
fn tangents_are_exact() {
    let (model, period) = whirled_beam();
    let system = System::new(&model, period).unwrap();
    let h = 1e-3;
    for (mut rule, points) in rules(&system) {
        let here = state(&system, points, 0);
        let places = system.nodes() * points;
        let mut rates = |state: &GridState| {
            let mut nodes = vec![NodeState::at_rest(state.motions[0]); places];
            rule.evaluate(state, &Workers::default(), &mut nodes);
            nodes
        };
        let node = 1;
        let mut slopes = Vec::new();
        for k in 0..points {
            for component in 0..6 {
                let mut at = |step: f64| {
                    let mut moved = here.clone();
                    let motion = &mut moved.motions[node * points + k];
                    let mut increment = Vector6::zeros();
                    increment[component] = step;
                    *motion = motion.increment(&increment);
                    rates(&moved)
                };
                let [a, b, c, d] = [at(h), at(-h), at(2.0 * h), at(-2.0 * h)];
                for i in node * points..(node + 1) * points {
                    let slope = |of: &dyn Fn(&NodeState) -> Vector6<f64>| {
                        ((of(&a[i]) - of(&b[i])) * 8.0 - (of(&c[i]) - of(&d[i]))) / (12.0 * h)
                    };
                    slopes.push([slope(&|node| node.twist), slope(&|node| node.twist_rate)]);
                }
            }
        }
        rates(&here);
        let mut slopes = slopes.iter();
        for k in 0..points {
            for component in 0..6 {
                for l in 0..points {
                    let found = rule.tangent(node, 0, l, k);
                    for (found, slope) in found.iter().zip(slopes.next().unwrap()) {
                        let found = found.to_twist_matrix().column(component).into_owned();
                        let size = 1.0 + slope.amax();
                        assert!((found - slope).amax() < 1e-8 * size, "{rule:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn variations_and_their_transposes_are_sums_of_tangents() {
    let (model, period) = whirled_beam();
    let system = System::new(&model, period).unwrap();
    for (mut rule, points) in rules(&system) {
        let here = state(&system, points, 0);
        let mut nodes = vec![NodeState::at_rest(here.motions[0]); system.nodes() * points];
        rule.evaluate(&here, &Workers::default(), &mut nodes);
        let node = 2;
        let increments: Vec<f64> = (0..6 * points).map(|i| wave(5 * i + 1)).collect();
        let by_rates: Vec<[Vector6<f64>; 2]> = (0..points)
            .map(|l| [six(3 * l + 1), six(3 * l + 2)])
            .collect();
        let workspace = &mut RuleWorkspace::default();
        let mut rates = vec![[Vector6::zeros(); 2]; points];
        rule.vary(node, &increments, workspace, &mut rates);
        let mut transposed = vec![0.0; 6 * points];
        rule.vary_transposed(node, &by_rates, workspace, &mut transposed);
        for (l, rates) in rates.iter().enumerate() {
            for (order, rate) in rates.iter().enumerate() {
                let mut sum = Vector6::zeros();
                for (k, u) in increments.chunks_exact(6).enumerate() {
                    let gamma = rule.tangent(node, 0, l, k)[order].to_twist_matrix();
                    sum += gamma * Vector6::from_column_slice(u);
                }
                assert!((sum - rate).amax() < 1e-11 * (1.0 + sum.amax()), "{rule:?}");
            }
        }
        let product =
            |a: &[Vector6<f64>; 2], b: &[Vector6<f64>; 2]| a[0].dot(&b[0]) + a[1].dot(&b[1]);
        let forwards: f64 = rates
            .iter()
            .zip(&by_rates)
            .map(|(a, b)| product(a, b))
            .sum();
        let backwards: f64 = transposed.iter().zip(&increments).map(|(a, b)| a * b).sum();
        let size = rates
            .iter()
            .flatten()
            .fold(1.0, |m: f64, rate| m.max(rate.amax()));
        assert!(
            (forwards - backwards).abs() < 1e-11 * size * points as f64,
            "{rule:?}"
        );

        let values: Vec<f64> = (0..points).map(|k| wave(7 * k)).collect();
        let (mut forwards, mut backwards) = (vec![0.0; points], vec![0.0; points]);
        rule.vary_rates(&values, workspace, &mut forwards);
        rule.vary_rates_transposed(&values, workspace, &mut backwards);
        for l in 0..points {
            let sum = |weight: &dyn Fn(usize) -> f64| -> f64 {
                values.iter().enumerate().map(|(k, x)| weight(k) * x).sum()
            };
            let expected = [
                sum(&|k| rule.rate_weight(0, l, k)),
                sum(&|k| rule.rate_weight(0, k, l)),
            ];
            assert!((forwards[l] - expected[0]).abs() < 1e-11 * (1.0 + expected[0].abs()));
            assert!((backwards[l] - expected[1]).abs() < 1e-11 * (1.0 + expected[1].abs()));
        }
    }
}
