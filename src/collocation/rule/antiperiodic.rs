//! Increments that change sign after a period, about a periodic motion (docs/theory.md, section
//! 13.5).

use super::{NodeKinematics, Spectral, TimeRule};
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::fourier::TimeGrid;
use crate::motion::DualMatrix;
use crate::workers::Workers;
use std::f64::consts::PI;

/// The motion is differentiated as a Fourier series, its increments as one of odd multiples of half
/// the frequency: where their equations are singular the period doubles.
#[derive(Debug, Clone)]
pub struct Antiperiodic {
    motion: Spectral,
    /// `D_ℓk` and `T_ℓk` for `ℓ − k` from 0 on.
    first: Vec<f64>,
    second: Vec<f64>,
}

impl Antiperiodic {
    /// On `grid`, for so many nodes.
    ///
    /// The highest multiple, N/2 of an odd number, has no first derivative on N points, but a
    /// second one: without that all that resists its rate alone would be singular.
    pub fn new(grid: TimeGrid, nodes: usize) -> Self {
        let (count, frequency) = (grid.points(), grid.frequency());
        let size = count as f64;
        let sum = |difference: usize, of: &dyn Fn(f64, f64) -> f64| {
            let angle = 2.0 * PI * difference as f64 / size;
            let below = (0..count / 2).map(|j| j as f64 + 0.5);
            below.map(|q| of(q, q * angle)).sum::<f64>() / size
        };
        let first = |m| -frequency * sum(m, &|q, angle| 2.0 * q * angle.sin());
        let second = |m: usize| {
            let below = sum(m, &|q, angle| 2.0 * q * q * angle.cos());
            let sign = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
            let highest = if count % 2 == 1 {
                0.25 * size * sign
            } else {
                0.0
            };
            -frequency * frequency * (below + highest)
        };
        Antiperiodic {
            motion: Spectral::new(grid, nodes),
            first: (0..count).map(first).collect(),
            second: (0..count).map(second).collect(),
        }
    }

    /// `D_ℓk` and `T_ℓk`.
    fn weights(&self, l: usize, k: usize) -> (f64, f64) {
        let m = l.abs_diff(k);
        let sign = if l < k { -1.0 } else { 1.0 };
        (sign * self.first[m], self.second[m])
    }

    fn node(&self, node: usize) -> &NodeKinematics {
        self.motion.node(node)
    }
}

/// Weights of the values at `count` grid points in a function that changes sign after a period, so
/// many periods after the first point.
pub fn antiperiodic_at(count: usize, periods: f64) -> Vec<f64> {
    let weight = |k: usize| {
        let angle = 2.0 * PI * (periods - k as f64 / count as f64);
        let below = (0..count / 2).map(|j| 2.0 * ((j as f64 + 0.5) * angle).cos());
        let highest = match count % 2 {
            1 => (0.5 * count as f64 * angle).cos(),
            _ => 0.0,
        };
        (below.sum::<f64>() + highest) / count as f64
    };
    (0..count).map(weight).collect()
}

impl TimeRule for Antiperiodic {
    fn evaluate(&mut self, state: &GridState, workers: &Workers, nodes: &mut [NodeState]) {
        self.motion.evaluate(state, workers, nodes);
    }

    fn rates(&mut self, place: usize, values: &[f64], gain: f64, rates: &mut [f64]) {
        self.motion.rates(place, values, gain, rates);
    }

    fn tangent(&self, node: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2] {
        let (d, t) = self.weights(l, k);
        let one = f64::from(l == k);
        match power {
            0 => self.node(node).tangent((d, t), l, k),
            1 => self.node(node).carried((one, 2.0 * d), l, k),
            _ => self.node(node).carried((0.0, one), l, k),
        }
    }

    fn rate_weight(&self, power: usize, l: usize, k: usize) -> f64 {
        match power {
            0 => self.weights(l, k).0,
            1 => f64::from(l == k),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;
    use std::f64::consts::TAU;

    #[test]
    fn half_harmonics_are_differentiated_exactly_but_the_highest_once() {
        for count in [1, 3, 8, 9, 15] {
            let grid = TimeGrid::even_or_odd(count, 1.7).unwrap();
            let rule = Antiperiodic::new(grid, 1);
            for j in 0..count.div_ceil(2) {
                let q = j as f64 + 0.5;
                let rate = q * grid.frequency();
                let wave = |k: usize| (q * TAU * k as f64 / count as f64 + 0.3).sin();
                let slope = |k: usize| rate * (q * TAU * k as f64 / count as f64 + 0.3).cos();
                let is_highest = 2 * j + 1 == count;
                let weights = antiperiodic_at(count, 1.4).into_iter().enumerate();
                let value: f64 = weights.map(|(k, w)| w * wave(k)).sum();
                let exact = (q * TAU * 1.4 + 0.3).sin();
                assert!(
                    is_highest || (value - exact).abs() < 1e-13,
                    "{value} {exact}"
                );
                for l in 0..count {
                    let (mut d, mut t) = (0.0, 0.0);
                    for k in 0..count {
                        let weights = rule.weights(l, k);
                        d += weights.0 * wave(k);
                        t += weights.1 * wave(k);
                    }
                    let exact = if is_highest { 0.0 } else { slope(l) };
                    assert!((d - exact).abs() < 1e-11 * rate, "{count} {j}: {d} {exact}");
                    let exact = -rate * rate * wave(l);
                    assert!(
                        (t - exact).abs() < 1e-11 * rate * rate,
                        "{count} {j}: {t} {exact}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_damped_mass_that_nothing_holds_is_regular() {
        // x'' + c x' on functions that change sign: no multiplier is −1.
        let (count, damping) = (15, 0.1);
        let grid = TimeGrid::new(count, TAU).unwrap();
        let rule = Antiperiodic::new(grid, 1);
        let matrix = DMatrix::from_fn(count, count, |l, k| {
            let (d, t) = rule.weights(l, k);
            t + damping * d
        });
        let below = (0..count / 2).map(|j| j as f64 + 0.5);
        let pairs: f64 = below.map(|q| q * q * (q * q + damping * damping)).product();
        let exact = -0.25 * (count * count) as f64 * pairs;
        let found = matrix.determinant();
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
    }
}
