//! Cardinal functions and their derivatives (docs/theory.md, section 2.1).

use super::grid::TimeGrid;
use std::f64::consts::{PI, TAU};

/// Values of `I_k`, `D_k` and `T_k` at one time: `f(t) = Σ I_k f_k`, `ḟ(t) = Σ D_k f_k`,
/// `f̈(t) = Σ T_k f_k`.
#[derive(Debug, Clone)]
pub struct CardinalWeights {
    grid: TimeGrid,
    /// `I_k`.
    pub value: Vec<f64>,
    /// `D_k`, per unit of time.
    pub first: Vec<f64>,
    /// `T_k`, per unit of time squared.
    pub second: Vec<f64>,
}

impl CardinalWeights {
    /// Weights for `grid`, at time zero.
    pub fn new(grid: TimeGrid) -> Self {
        let n = grid.points();
        let mut weights = CardinalWeights {
            grid,
            value: vec![0.0; n],
            first: vec![0.0; n],
            second: vec![0.0; n],
        };
        weights.move_to(0.0);
        weights
    }

    /// Moves the weights to `time`, anywhere, also outside the first period.
    pub fn move_to(&mut self, time: f64) {
        let turns = time / self.grid.period();
        let map = self.grid.map();
        if map.is_identity() {
            return self.move_to_pseudo(turns);
        }
        let [by_time, bend, _] = map.pseudo_derivatives(turns);
        let bend = bend / self.grid.period();
        self.move_to_pseudo(map.pseudo(turns));
        for (first, second) in self.first.iter_mut().zip(&mut self.second) {
            *second = *second * by_time * by_time + *first * bend;
            *first *= by_time;
        }
    }

    /// To a pseudo-time counted in periods, with its derivatives by pseudo-time.
    fn move_to_pseudo(&mut self, turns: f64) {
        let points = self.grid.points();
        let (n, omega) = (points as f64, self.grid.frequency());
        // Measured from the nearest grid point, the phase is small where it matters.
        let steps = (turns - turns.floor()) * n;
        let nearest = steps.round();
        let offset = (steps - nearest) * PI / n;
        let nearest = nearest as usize % points;
        let (sin_y0, cos_y0) = (n * offset).sin_cos();
        let step = PI / n;
        for k in 0..points {
            // x = (τ − τ_k)/2 within (−π/2, π/2], and y = N x.
            let mut behind = nearest as i64 - k as i64;
            if 2 * behind > points as i64 {
                behind -= points as i64;
            } else if 2 * behind <= -(points as i64) {
                behind += points as i64;
            }
            let x = offset + behind as f64 * step;
            let (i, d, t) = if behind == 0 {
                by_summation(points, 2.0 * x)
            } else {
                // sin(y0 + jπ) = (−1)^j sin y0
                let sign = if behind % 2 == 0 { 1.0 } else { -1.0 };
                let odd = in_closed_form(n, x, sign * sin_y0, sign * cos_y0);
                match points.is_multiple_of(2) {
                    true => of_even(odd, x),
                    false => odd,
                }
            };
            self.value[k] = i;
            self.first[k] = omega * d;
            self.second[k] = omega * omega * t;
        }
    }
}

/// Away from the grid point, for `Ω = 1`.
fn in_closed_form(n: f64, x: f64, sin_y: f64, cos_y: f64) -> (f64, f64, f64) {
    let (sin_x, cos_x) = x.sin_cos();
    let inverse = 1.0 / sin_x;
    let (value, wave) = (sin_y * inverse / n, cos_y * inverse);
    let slope = cos_x * inverse;
    (
        value,
        0.5 * (wave - value * slope),
        value * (0.5 * inverse * inverse - 0.25) - 0.5 * wave * slope - 0.25 * n * n * value,
    )
}

/// For an even number of points, whose function is that of an odd one times `cos x`.
fn of_even((i, d, t): (f64, f64, f64), x: f64) -> (f64, f64, f64) {
    let (sin, cos) = x.sin_cos();
    (
        i * cos,
        d * cos - 0.5 * i * sin,
        t * cos - d * sin - 0.25 * i * cos,
    )
}

/// The same by the sum of harmonics, which has no cancellation at the grid point itself.
fn by_summation(points: usize, tau: f64) -> (f64, f64, f64) {
    let (mut i, mut d, mut t) = (1.0, 0.0, 0.0);
    for j in 1..=points / 2 {
        let h = j as f64;
        let both = if 2 * j == points { 1.0 } else { 2.0 };
        let (sin, cos) = (h * tau % TAU).sin_cos();
        i += both * cos;
        d -= both * h * sin;
        t -= both * h * h * cos;
    }
    let n = points as f64;
    (i / n, d / n, t / n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fourier::{SharpEvent, TimeMap};

    /// All weights by the sum of harmonics: slow, but without cancellation anywhere.
    fn reference(grid: TimeGrid, time: f64, k: usize) -> (f64, f64, f64) {
        let omega = grid.frequency();
        let (i, d, t) = by_summation(grid.points(), omega * (time - grid.time(k)));
        (i, omega * d, omega * omega * t)
    }

    #[test]
    fn weights_agree_with_the_sum_of_harmonics_everywhere() {
        for points in [1, 2, 3, 7, 8, 21, 36, 101] {
            let grid = TimeGrid::even_or_odd(points, 2.0).unwrap();
            let mut weights = CardinalWeights::new(grid);
            for time in [
                0.0,
                1e-13,
                1e-7,
                0.01,
                0.39999999,
                0.4,
                0.777,
                1.0,
                1.999999999,
                5.3,
                -0.7,
            ] {
                weights.move_to(time);
                let n = points as f64;
                for k in 0..points {
                    let (i, d, t) = reference(grid, time, k);
                    // Rounding of the phase, about 1e-16 N, times the largest slope of each.
                    let phase = 1e-15 * n * (1.0 + time.abs());
                    assert!((weights.value[k] - i).abs() < 1e-15 + phase);
                    assert!((weights.first[k] - d).abs() < 4.0 * n * (1e-15 + phase));
                    assert!((weights.second[k] - t).abs() < 10.0 * n * n * (1e-15 + phase));
                }
                // Partition of unity.
                assert!((weights.value.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn on_a_mapped_grid_derivatives_are_those_by_time() {
        let event = SharpEvent {
            time: 0.7,
            width: 0.1,
            share: 1.0,
        };
        let map = TimeMap::new(&[event], 2.0).unwrap();
        let grid = TimeGrid::new(45, 2.0).unwrap().mapped(map);
        let mut weights = CardinalWeights::new(grid);
        // What the grid resolves: harmonics of pseudo-time.
        let value = |time: f64| (TAU * 3.0 * map.pseudo(time / 2.0) + 0.4).sin();
        let samples: Vec<f64> = grid.times().map(value).collect();
        let sum =
            |weights: &[f64]| -> f64 { weights.iter().zip(&samples).map(|(w, x)| w * x).sum() };
        for time in [0.0, 0.1, 0.65, 0.7, 1.2, 5.3] {
            weights.move_to(time);
            assert!((sum(&weights.value) - value(time)).abs() < 1e-13);
            let h = 1e-3;
            let at = |i: i32| value(time + h * f64::from(i));
            let first = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
            let second =
                (16.0 * (at(1) + at(-1)) - (at(2) + at(-2)) - 30.0 * at(0)) / (12.0 * h * h);
            // Differences of fourth order, over a hundredth of the width.
            let [a, b] = [&weights.first, &weights.second].map(|w| sum(w));
            assert!((a - first).abs() < 1e-4, "{time}: {a} {first}");
            assert!((b - second).abs() < 1e-2, "{time}: {b} {second}");
        }
    }
}
