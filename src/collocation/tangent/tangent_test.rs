//! Products, transposed products and assembled matrices of the same tangents, and the residual.

use super::*;
use crate::collocation::pattern::Pattern;
use crate::fourier::TimeGrid;
use crate::model::Model;
use crate::test_models::{elements::all_elements, small::moving_models};
use std::sync::Arc;

fn models() -> Vec<(Model, f64)> {
    let mut models = moving_models();
    models.push(all_elements());
    models
}

fn wave(i: usize) -> f64 {
    (0.37 * i as f64).sin()
}

fn equations(model: &Model, period: f64, points: usize) -> Collocation {
    let system = Arc::new(System::new(model, period).unwrap());
    Collocation::new(system, TimeGrid::even_or_odd(points, period).unwrap()).unwrap()
}

/// Unscaled unknowns.
fn unscaled(equations: &Collocation, x: impl Fn(usize) -> f64) -> Vec<f64> {
    let scales = equations.column_scale().iter().enumerate();
    scales.map(|(i, scale)| x(i) * scale).collect()
}

fn moved(equations: &Collocation) -> GridState {
    let reference = GridState::reference(equations.system(), equations.grid());
    let increment = unscaled(equations, |i| 0.05 * wave(i));
    reference.incremented(equations.system(), &increment, 1.0)
}

/// `A x` and `Aᵀ x`.
fn products(pattern: &Pattern, values: &[f64], x: &[f64]) -> [Vec<f64>; 2] {
    let mut both = [vec![0.0; x.len()], vec![0.0; x.len()]];
    for (column, range) in pattern.column_pointers().windows(2).enumerate() {
        let rows = &pattern.row_indices()[range[0]..range[1]];
        for (&row, value) in rows.iter().zip(&values[range[0]..range[1]]) {
            both[0][row] += value * x[column];
            both[1][column] += value * x[row];
        }
    }
    both
}

fn assert_close(found: &[f64], expected: &[f64], tolerance: f64) {
    let size = expected.iter().fold(0.0, |m: f64, y| m.max(y.abs()));
    assert!(size > 0.0);
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!(
            (f - e).abs() <= tolerance * size,
            "{f} {e} of {size} at {i}"
        );
    }
}

#[test]
fn products_are_those_of_the_matrix_and_of_its_transpose() {
    for (model, period) in models() {
        for points in [1, 3, 8, 9, 35] {
            let mut equations = equations(&model, period, points);
            equations.regularise();
            let system = equations.system().clone();
            let pattern = Pattern::new(&system, points);
            let state = moved(&equations);
            let mut values = vec![0.0; pattern.entries()];
            let mut whole = Tangent::new(&system, points);
            equations
                .jacobian(&state, &pattern, &mut whole, &mut values)
                .unwrap();
            let x: Vec<f64> = (0..pattern.size()).map(|i| wave(3 * i + 1)).collect();
            let [expected, transposed] = products(&pattern, &values, &x);
            let mut apart = Tangent::with_resultants_apart(&system, points);
            apart.evaluate(&mut equations, &state).unwrap();
            for tangent in [&mut whole, &mut apart] {
                let mut found = vec![0.0; x.len()];
                tangent.apply(&equations, &x, &mut found);
                assert_close(&found, &expected, 1e-12);
                tangent.apply_transposed(&equations, &x, &mut found);
                assert_close(&found, &transposed, 1e-12);
                // Assembled from either, but for the compliance.
                let mut again = vec![0.0; pattern.entries()];
                tangent
                    .assemble(&equations, &pattern, 0, &mut again)
                    .unwrap();
                equations.add_compliance(&pattern, &mut again);
                assert_close(&again, &values, 1e-12);
            }
        }
    }
}

/// `yᵀ J x` is the same from either side: of all unknowns, and of each pair of what stands before
/// and behind.
#[test]
fn transposed_products_with_stress_resultants_are_those_of_the_transpose() {
    for (model, period) in models() {
        for points in [1, 8, 9] {
            let mut equations = equations(&model, period, points);
            equations.regularise();
            let system = equations.system().clone();
            let state = moved(&equations);
            let mut tangent = Tangent::with_resultants_apart(&system, points);
            tangent.evaluate(&mut equations, &state).unwrap();
            tangent.set_resultant_scale(0.3);
            let (size, all) = (equations.size(), equations.size() + tangent.resultants());
            for of_x in [0..all, 0..size, size..all] {
                for of_y in [0..all, 0..size, size..all] {
                    let on = |range: &std::ops::Range<usize>, factor: usize| -> Vec<f64> {
                        let number = |i: usize| wave(factor * i + 1);
                        let entry = |i: usize| if range.contains(&i) { number(i) } else { 0.0 };
                        (0..all).map(entry).collect()
                    };
                    let (x, y) = (on(&of_x, 3), on(&of_y, 7));
                    let [mut product, mut transposed] = [vec![f64::NAN; all], vec![f64::NAN; all]];
                    tangent.apply(&equations, &x, &mut product);
                    tangent.apply_transposed(&equations, &y, &mut transposed);
                    let sum = |a: &[f64], b: &[f64], f: fn(f64) -> f64| -> f64 {
                        a.iter().zip(b).map(|(a, b)| f(a * b)).sum()
                    };
                    let forward = sum(&y, &product, |x| x);
                    let back = sum(&transposed, &x, |x| x);
                    // Rounding of sums of so large terms.
                    let largest = sum(&y, &product, f64::abs) + sum(&transposed, &x, f64::abs);
                    assert!(
                        (forward - back).abs() <= 1e-12 * largest,
                        "{forward} {back} of {largest}"
                    );
                }
            }
        }
    }
}

#[test]
fn places_on_the_diagonal_are_on_it() {
    for (model, period) in models() {
        for points in [1, 8, 9] {
            let system = System::new(&model, period).unwrap();
            let pattern = Pattern::new(&system, points);
            for motion in 0..6 * points * system.nodes() {
                let place = pattern.diagonal(motion);
                let column = &pattern.column_pointers()[motion..];
                assert!((column[0]..column[1]).contains(&place));
                assert_eq!(pattern.row_indices()[place], motion);
            }
        }
    }
}

#[test]
fn products_with_powers_are_those_of_their_matrices() {
    for (model, period) in models() {
        for points in [1, 3, 9, 12] {
            let mut equations = equations(&model, period, points);
            let system = equations.system().clone();
            let pattern = Pattern::new(&system, points);
            let state = moved(&equations);
            let matrices = equations.linearise(&state, &pattern).unwrap();
            let x: Vec<f64> = (0..pattern.size()).map(|i| wave(3 * i + 1)).collect();
            for mut tangent in [
                Tangent::new(&system, points),
                Tangent::with_resultants_apart(&system, points),
            ] {
                tangent.evaluate(&mut equations, &state).unwrap();
                let mut found = vec![f64::NAN; x.len()];
                for (power, matrix) in [(1, &matrices.damping), (2, &matrices.mass)] {
                    tangent.apply_power(&equations, power, &x, &mut found);
                    let [expected, _] = products(&pattern, matrix, &x);
                    match expected.iter().all(|y| *y == 0.0) {
                        true => assert!(found.iter().all(|y| *y == 0.0)),
                        false => assert_close(&found, &expected, 1e-12),
                    }
                }
                // Resultants do not depend on themselves.
                let mut all = x.clone();
                all.resize(x.len() + tangent.resultants(), 1.0);
                let mut with_them = vec![f64::NAN; all.len()];
                tangent.apply_power(&equations, 2, &all, &mut with_them);
                assert!(with_them[x.len()..].iter().all(|x| *x == 0.0));
                assert_eq!(with_them[..x.len()], found);
            }
        }
    }
}

#[test]
fn what_is_left_where_the_equations_are_linearised_is_the_residual() {
    for (model, period) in models() {
        for points in [1, 8, 9] {
            let mut equations = equations(&model, period, points);
            let (system, state) = (equations.system().clone(), moved(&equations));
            let mut expected = vec![0.0; equations.size()];
            equations.residual(&state, &mut expected).unwrap();
            let reference = GridState::reference(&system, equations.grid());
            for mut tangent in [
                Tangent::new(&system, points),
                Tangent::with_resultants_apart(&system, points),
            ] {
                // What was there before is overwritten.
                for at in [&reference, &state] {
                    tangent.evaluate(&mut equations, at).unwrap();
                }
                let mut found = vec![0.0; expected.len()];
                equations
                    .residual_where_linearised(&state, &mut found)
                    .unwrap();
                // Rounding alone.
                assert_close(&found, &expected, 1e-13);
            }
            // Not known of another state.
            equations.forget_linearised_residual();
            let mut found = vec![0.0; expected.len()];
            equations
                .residual_where_linearised(&state, &mut found)
                .unwrap();
            assert_eq!(found, expected);
        }
    }
}

#[test]
fn the_frequency_changes_what_the_elements_tangents_say() {
    for (model, period) in models() {
        let mut equations = equations(&model, period, 9);
        let (system, state) = (equations.system().clone(), moved(&equations));
        let expected = equations.by_log_frequency(&state).unwrap();
        for mut tangent in [
            Tangent::new(&system, 9),
            Tangent::with_resultants_apart(&system, 9),
        ] {
            tangent.evaluate(&mut equations, &state).unwrap();
            let mut found = vec![f64::NAN; expected.len()];
            tangent.by_log_frequency(&equations, &mut found);
            // Rounding alone.
            assert_close(&found, &expected, 1e-12);
        }
    }
}

/// With `μ = iΩ/3`, `exp(μt) Δu` repeats after three periods: there the residual itself tells what
/// it changes.
#[test]
fn modulated_increments_change_the_residual_as_the_polynomial_says() {
    const POINTS: usize = 7;
    for (model, period) in models() {
        let mut once = equations(&model, period, POINTS);
        let mut thrice = equations(&model, 3.0 * period, 3 * POINTS);
        // Harmonics of signals are those of the shorter period.
        thrice.set_signals(&once.signals().repeat(3));
        let system = once.system().clone();
        let state = moved(&once);
        let mut repeated = GridState::reference(&system, thrice.grid());
        (0..3 * POINTS).for_each(|k| repeated.copy_point(&system, k, &state, k % POINTS));

        let pattern = Pattern::new(&system, POINTS);
        let matrices = once.linearise(&state, &pattern).unwrap();
        let x: Vec<f64> = (0..once.size()).map(|i| wave(3 * i + 1)).collect();
        let nu = thrice.grid().frequency();
        let [k, c, m] = [&matrices.stiffness, &matrices.damping, &matrices.mass]
            .map(|values| products(&pattern, values, &x)[0].clone());
        // The unknown or row `i` of a grid of N points at its grid point, and the same on another.
        let place = |i: usize| {
            let nodes = 6 * system.nodes();
            let (first, count) = match i.checked_sub(nodes * POINTS) {
                None => (i / (6 * POINTS) * 6, 6),
                Some(own) => {
                    let placed = system.elements().iter().rev();
                    let placed = placed
                        .filter(|p| p.element.own_unknowns() > 0)
                        .find(|p| p.first_own * POINTS <= own)
                        .unwrap();
                    (nodes + placed.first_own, placed.element.own_unknowns())
                }
            };
            let within = i - first * POINTS;
            let (k, row) = (within / count, within % count);
            (k, move |k: usize| 3 * POINTS * first + count * k + row)
        };
        let angle = |k: usize| nu * thrice.grid().time(k);
        let mut increment = vec![0.0; thrice.size()];
        let mut expected = vec![0.0; thrice.size()];
        for i in 0..once.size() {
            let (at, places) = place(i);
            for turn in 0..3 {
                let k_all = at + turn * POINTS;
                let (sine, cosine) = angle(k_all).sin_cos();
                let to = places(k_all);
                increment[to] = cosine * x[i] * once.column_scale()[i];
                let (real, imaginary) = (k[i] - nu * nu * m[i], nu * c[i]);
                let scale = thrice.row_scale()[to] / once.row_scale()[i];
                expected[to] = (cosine * real - sine * imaginary) * scale;
            }
        }
        let mut at = |step: f64| {
            let mut out = vec![0.0; increment.len()];
            let state = repeated.incremented(&system, &increment, step);
            thrice.residual(&state, &mut out).unwrap();
            out
        };
        let h = 1e-3;
        let [a, b, c, d] = [at(h), at(-h), at(2.0 * h), at(-2.0 * h)];
        let slope = |i: usize| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
        let slopes: Vec<f64> = (0..increment.len()).map(slope).collect();
        assert_close(&slopes, &expected, 1e-8);
    }
}
