//! Collocation and harmonic balance (section 2 of the paper): with forces sampled at the grid
//! points they are one; the Galerkin method proper, whose forces are not aliased, has the same
//! limit.

mod common;

use common::*;
use nalgebra::{DMatrix, DVector, Vector3};
use periodyn::elements::Coordinate;
use periodyn::error::ErrorKind;
use periodyn::model::{Model, Signal};
use periodyn::output::{JointQuantity, Solution};
use periodyn::solve::{Outcome, PeriodicOptions};
use std::f64::consts::TAU;

const MASS: f64 = 1.3;
const DAMPING: f64 = 0.4;
const STIFFNESS: f64 = 2.0;
const CUBIC: f64 = 3.0;
const FORCE: f64 = 4.0;
const OMEGA: f64 = 0.9;
const PERIOD: f64 = TAU / OMEGA;

/// `m ü + c u̇ + k u + k₃ u³ = f cos ωt`: a mass on a slide.
fn duffing() -> Model {
    let (mut model, at) = mass_on_a_slide(MASS, &Vector3::x());
    model
        .add_polynomial_spring_damper(at, &[STIFFNESS, 0.0, CUBIC], &[DAMPING], 0.0)
        .unwrap();
    let force = Signal::harmonics(0.0, 0.0, &[FORCE], &[0.0]).unwrap();
    model.add_actuator(at, &force).unwrap();
    model
}

fn displacements(solution: &Solution, times: &[f64]) -> Vec<f64> {
    let quantity = JointQuantity::Coordinate(Coordinate::Displacement1);
    solution.joint(0, quantity, times).unwrap()
}

/// The basis `1, cos ωt, sin ωt, cos 2ωt, …` at a time, and its first two derivatives.
fn basis(harmonics: usize, t: f64) -> [DVector<f64>; 3] {
    let mut rows = [(); 3].map(|()| DVector::zeros(2 * harmonics + 1));
    rows[0][0] = 1.0;
    for j in 1..=harmonics {
        let w = j as f64 * OMEGA;
        let (sin, cos) = (w * t).sin_cos();
        let [value, first, second] = &mut rows;
        (value[2 * j - 1], value[2 * j]) = (cos, sin);
        (first[2 * j - 1], first[2 * j]) = (-w * sin, w * cos);
        (second[2 * j - 1], second[2 * j]) = (-w * w * cos, -w * w * sin);
    }
    rows
}

/// Coefficients of the solution whose residual, sampled at `samples` times, has none of the
/// harmonics.
fn balance(harmonics: usize, samples: usize, start: &DVector<f64>) -> DVector<f64> {
    let mut x = start.clone();
    for _ in 0..40 {
        let size = x.len();
        let (mut residual, mut tangent) = (DVector::zeros(size), DMatrix::zeros(size, size));
        for k in 0..samples {
            let t = PERIOD * k as f64 / samples as f64;
            let [b, db, ddb] = basis(harmonics, t);
            let u = b.dot(&x);
            let r = MASS * ddb.dot(&x) + DAMPING * db.dot(&x) + STIFFNESS * u + CUBIC * u * u * u
                - FORCE * (OMEGA * t).cos();
            residual += &b * r;
            let row = ddb * MASS + db * DAMPING + &b * (STIFFNESS + 3.0 * CUBIC * u * u);
            tangent += &b * row.transpose();
        }
        let step = tangent.lu().solve(&residual).unwrap();
        x -= &step;
        if step.amax() < 1e-13 {
            return x;
        }
    }
    panic!("no balance of {harmonics} harmonics");
}

/// Coefficients of the trigonometric polynomial through a solution's grid points.
fn coefficients(solution: &Solution, harmonics: usize) -> DVector<f64> {
    let points = 2 * harmonics + 1;
    let times: Vec<f64> = (0..points)
        .map(|k| PERIOD * k as f64 / points as f64)
        .collect();
    let values = displacements(solution, &times);
    let mut x = DVector::zeros(points);
    for (t, u) in times.iter().zip(values) {
        x += basis(harmonics, *t)[0].clone() * (u * 2.0 / points as f64);
    }
    x[0] *= 0.5;
    x
}

#[test]
fn collocation_is_harmonic_balance_sampled_at_the_grid() {
    let model = duffing();
    for harmonics in [2, 4, 7, 12] {
        let points = 2 * harmonics + 1;
        let solution = solve(&model, PERIOD, points);
        let found = coefficients(&solution, harmonics);
        let balanced = balance(harmonics, points, &found);
        // Newton's methods of both leave rounding; the balanced amplitudes are of the order of 1.
        let difference = (&found - &balanced).amax();
        println!("{harmonics} harmonics: {difference:.1e}");
        assert!(difference < 1e-12, "{harmonics}: {difference:e}");
    }
}

/// The periodic response, the equations sampled at so many times as many points.
fn oversampled(model: &Model, period: f64, points: usize, oversampling: usize) -> Solution {
    let options = PeriodicOptions {
        oversampling,
        ..options(points)
    };
    let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
    let report = &solution.details().report;
    assert_eq!(solution.outcome(), Outcome::Converged, "{report:#?}");
    solution
}

#[test]
fn oversampled_equations_are_galerkins_method() {
    let model = duffing();
    for harmonics in [2, 4, 7, 12] {
        let points = 2 * harmonics + 1;
        let found = coefficients(&oversampled(&model, PERIOD, points, 2), harmonics);
        // A cube is sampled without aliases on 2 N + 1 points; on any more the balance is the same.
        let galerkin = balance(harmonics, 10 * harmonics + 7, &found);
        let difference = (&found - &galerkin).amax();
        let collocated = coefficients(&solve(&model, PERIOD, points), harmonics);
        let moved = (&found - &collocated).amax();
        println!("{harmonics} harmonics: {difference:.1e}, from collocation {moved:.1e}");
        assert!(difference < 1e-12, "{harmonics}: {difference:e}");
        assert!(moved > 1e3 * difference, "{harmonics}: {moved:e}");
    }
}

#[test]
fn galerkins_method_has_the_same_limit() {
    let model = duffing();
    let exact = coefficients(&solve(&model, PERIOD, 101), 50);
    let mut errors = Vec::new();
    for harmonics in [3, 5, 7, 9, 11] {
        let collocated = coefficients(&solve(&model, PERIOD, 2 * harmonics + 1), harmonics);
        // A cube of H harmonics has 3 H: 4 H + 1 samples keep those above out of the first H.
        let galerkin = balance(harmonics, 4 * harmonics + 1, &collocated);
        let size = collocated.len();
        let error = |x: &DVector<f64>| (x - exact.rows(0, size)).amax();
        println!(
            "{harmonics} harmonics: collocation {:.1e}, Galerkin {:.1e}, between them {:.1e}",
            error(&collocated),
            error(&galerkin),
            (&collocated - &galerkin).amax()
        );
        errors.push([error(&collocated), error(&galerkin)]);
    }
    // Both fall exponentially: an odd response gains a digit or more with each two harmonics.
    for pair in errors.windows(2) {
        for (now, next) in pair[0].iter().zip(pair[1]) {
            assert!(next < 0.5 * now, "{errors:?}");
        }
    }
    for error in errors[4] {
        assert!(error < 1e-4, "{error:e}");
    }
}

/// Largest difference of motions from a converged solution.
fn error(solution: &Solution, exact: &Solution) -> f64 {
    let there = solution.prolonged(exact.grid()).unwrap();
    let length = exact.details().system.scales().length;
    there.distance(&exact.details().state, length)
}

#[test]
fn aliases_are_a_part_of_the_error_of_collocation() {
    let (two, period) = (double_pendulum().0, DOUBLE_PENDULUM_PERIOD);
    // Name, model, period, and what is at most left of the error on the coarsest and on any grid:
    // between grid points, the harmonics that are left out weigh as much in both.
    let cases = [
        ("Duffing's oscillator", duffing(), PERIOD, 0.1, 0.6),
        ("double pendulum", two, period, 0.8, 1.6),
        ("Zener pendulum", zener_pendulum().0, 1.7, 0.5, 0.9),
    ];
    for (name, model, period, coarsest, any) in cases {
        let exact = solve(&model, period, 91);
        for points in [11, 15, 21, 31, 45] {
            let plain = error(&solve(&model, period, points), &exact);
            let [twice, thrice] = [2, 3].map(|times| {
                let solution = oversampled(&model, period, points, times);
                let iterations = &solution.details().report.iterations;
                for pair in iterations.windows(2) {
                    // Curvature: measured up to 30. Linear solves leave at most a tenth of an
                    // increment below 1e-7.
                    let bound = 100.0 * pair[0].increment.powi(2) + 1e-12;
                    let quadratic = pair[0].increment > 1e-2 || pair[1].increment < bound;
                    assert!(quadratic, "{name}, {points}: {iterations:#?}");
                }
                error(&solution, &exact)
            });
            println!("{name}, {points} points: {plain:.1e}, {twice:.1e}, {thrice:.1e}");
            let most = if points == 11 { coarsest } else { any };
            assert!(twice < most * plain && thrice < most * plain);
        }
    }
}

#[test]
fn oversampling_is_refused_out_of_range() {
    for oversampling in [0, 17, usize::MAX] {
        let options = PeriodicOptions {
            oversampling,
            ..options(11)
        };
        let refused = Solution::solve(&duffing(), PERIOD, &options, &mut |_, _| true);
        let error = refused.unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Value);
        assert!(
            error.to_string().contains("options.oversampling"),
            "{error}"
        );
    }
}
