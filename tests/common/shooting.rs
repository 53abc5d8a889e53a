//! Periodic solutions of ordinary differential equations by shooting: an independent way to the
//! same motions.

// Each test binary uses its own part of this module.
#![allow(dead_code)]

use nalgebra::{DMatrix, DVector};

/// `ẋ = f(t, x)`.
pub type Equations<'a> = dyn Fn(f64, &DVector<f64>) -> DVector<f64> + 'a;

/// States at `steps + 1` uniform times of a period, by the classical Runge-Kutta method.
pub fn integrate(
    f: &Equations,
    period: f64,
    steps: usize,
    start: &DVector<f64>,
) -> Vec<DVector<f64>> {
    let h = period / steps as f64;
    let mut states = vec![start.clone()];
    for k in 0..steps {
        let (t, x) = (h * k as f64, states[k].clone());
        let k1 = f(t, &x);
        let k2 = f(t + 0.5 * h, &(&x + &k1 * (0.5 * h)));
        let k3 = f(t + 0.5 * h, &(&x + &k2 * (0.5 * h)));
        let k4 = f(t + h, &(&x + &k3 * h));
        states.push(x + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0));
    }
    states
}

/// The periodic solution near `guess`, at `steps + 1` uniform times: Newton's method on the map
/// over a period.
pub fn shoot(f: &Equations, period: f64, steps: usize, guess: &[f64]) -> Vec<DVector<f64>> {
    let mut start = DVector::from_column_slice(guess);
    let n = start.len();
    for _ in 0..30 {
        let states = integrate(f, period, steps, &start);
        let miss = &states[steps] - &start;
        let mut map = -DMatrix::<f64>::identity(n, n);
        for i in 0..n {
            let h = 1e-6;
            let end = |step: f64| {
                let mut from = start.clone();
                from[i] += step;
                integrate(f, period, steps, &from)[steps].clone()
            };
            let slope = (end(h) - end(-h)) / (2.0 * h);
            let mut column = map.column_mut(i);
            column += slope;
        }
        let correction = map.lu().solve(&miss).unwrap();
        start -= &correction;
        if correction.amax() < 1e-12 {
            return integrate(f, period, steps, &start);
        }
    }
    panic!("shooting did not converge");
}
