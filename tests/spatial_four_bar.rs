//! The spatial four-bar mechanism of section 7.2 of the paper: convergence, accuracy, and what its
//! error is.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::fourier::TimeGrid;
use periodyn::output::{BeamQuantity, NodeQuantity, Solution};
use periodyn::solve::{InitialGuess, Outcome, Stage};
use std::collections::BTreeMap;
use std::sync::LazyLock;

const REFERENCE: usize = 61;

/// Solutions from the default guess, solved once for all tests.
static SOLUTIONS: LazyLock<BTreeMap<usize, Solution>> = LazyLock::new(|| {
    let mechanism = FourBar::default().build();
    [3, 5, 7, 11, 15, 21, 31, 41, REFERENCE]
        .map(|n| (n, mechanism.solve(n)))
        .into()
});

/// The 401 times of figures 8 to 10.
fn figure_times() -> Vec<f64> {
    times(FOUR_BAR_PERIOD, 401)
}

/// Errors of the three curves relative to their ranges, for each number of grid points.
fn curve_errors() -> Vec<(usize, [f64; 3])> {
    let mechanism = FourBar::default().build();
    let times = figure_times();
    let reference = mechanism.curves(&SOLUTIONS[&REFERENCE], &times);
    let coarser = SOLUTIONS.iter().filter(|(n, _)| **n < REFERENCE);
    coarser
        .map(|(&n, solution)| {
            let curves = mechanism.curves(solution, &times);
            let error = |i: usize| relative_to_range(&curves[i], &reference[i]);
            (n, std::array::from_fn(error))
        })
        .collect()
}

#[test]
fn newton_converges_quadratically_in_at_most_four_iterations() {
    for n in [3, 5, 7, 11, 21, 41] {
        let iterations = &SOLUTIONS[&n].details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("N = {n}: increments {increments:?}");
        assert!((2..=4).contains(&iterations.len()), "N = {n}");
        for pair in iterations.windows(2) {
            // 10: the curvature of the equations in their own scales, of order one (measured 0.4 to
            // 1.7). 1e-13: rounding of increments, some hundred units in the last place.
            let bound = 10.0 * pair[0].increment.powi(2) + 1e-13;
            assert!(pair[1].increment <= bound, "N = {n}: {pair:?}");
            assert_eq!(pair[1].step, 1.0);
        }
    }
}

#[test]
fn curves_converge_exponentially() {
    let errors = curve_errors();
    for (n, curves) in &errors {
        let [x3, v3, torque] = curves;
        println!("N = {n}: errors of x3 {x3:.2e}, v3 {v3:.2e}, torque {torque:.2e} of the range");
        // The acceptance limits of the paper's figures.
        let limit = match n {
            21 => 1e-3,
            41 => 1e-5,
            _ => continue,
        };
        assert!(largest(*curves) < limit, "N = {n}: {curves:?}");
    }
    for (i, name) in ["x3 of B", "v3 of B", "torque at D"].iter().enumerate() {
        let points: Vec<(f64, f64)> = errors
            .iter()
            .filter(|(n, _)| *n >= 11)
            .map(|(n, curves)| (*n as f64, curves[i]))
            .collect();
        let (slope, correlation) = exponential_fit(&points);
        println!("{name}: error falls as exp({slope:.3} N), correlation {correlation:.4}");
        // A decade for each 8 points at least; an algebraic law N^-p would bend away from the line.
        assert!(
            slope < -0.28 && correlation < -0.99,
            "{name}: {slope} {correlation}"
        );
    }
}

#[test]
fn residual_between_grid_points_falls_exponentially() {
    let between = |n: usize| SOLUTIONS[&n].diagnostics().between;
    let fit = |value: &dyn Fn(usize) -> f64| {
        exponential_fit(&[15, 21, 31, 41, 61].map(|n| (n as f64, value(n))))
    };
    let force = fit(&|n| between(n).force);
    let constraint = fit(&|n| between(n).constraint);
    println!("force: slope and correlation {force:?}, constraint: {constraint:?}");
    for (slope, correlation) in [force, constraint] {
        assert!(
            slope < -0.28 && correlation < -0.99,
            "{slope} {correlation}"
        );
    }
    // Nothing hidden at the finest: rounding of strains times 5e7 N is far below this.
    assert!(between(REFERENCE).force < 1e-7 && between(REFERENCE).constraint < 1e-9);
}

#[test]
fn error_estimate_is_not_optimistic() {
    let reference = &SOLUTIONS[&REFERENCE];
    let times = figure_times();
    let length = reference.details().system.scales().length;
    let mut ratios = Vec::new();
    for (&n, solution) in SOLUTIONS.iter().filter(|(n, _)| **n < REFERENCE) {
        let difference = |node: usize, quantity: NodeQuantity| {
            let at = |s: &Solution| s.node(node, quantity, &times).unwrap();
            largest_difference(&at(solution), &at(reference))
        };
        // In the measure of the estimate: positions by the length, entries of rotations.
        let error = largest((0..solution.model().node_count()).flat_map(|node| {
            let position = difference(node, NodeQuantity::Position) / length;
            [position, difference(node, NodeQuantity::RotationMatrix)]
        }));
        ratios.push((n, solution.diagnostics().error_estimate / error, error));
    }
    for (n, ratio, error) in ratios {
        println!("N = {n}: estimate {ratio:.2} times the true error {error:.2e}");
        // Below a tenth it would deceive; beyond a hundred it would be of no use.
        assert!(ratio > 0.1 && ratio < 100.0, "N = {n}: {ratio}");
    }
}

#[test]
fn reports_say_where_nothing_is_resolved() {
    let warned = |n: usize| {
        SOLUTIONS[&n]
            .report()
            .contains("grid points resolve nothing")
    };
    assert!(warned(3));
    assert!(!warned(11));
}

/// The position loop: B on a circle about A in the plane y = 0, at the distance |BC| from C, which
/// is on a circle about D. `deflections` of B on bar 1 and of C on bar 3 are added, each in the
/// axes of its bar at its fixed end. Returns B at each of `times`, followed from the reference
/// configuration.
fn position_loop(
    times: &[f64],
    deflections: impl Fn(usize) -> [Vector3<f64>; 2],
) -> Vec<Vector3<f64>> {
    let [a, b0, c0, d] = four_bar_points();
    let (crank, rod) = (b0 - a, (c0 - b0).norm());
    let mut angle = crank.z.atan2(crank.x);
    let input = four_bar_input(1.0).bind(FOUR_BAR_PERIOD);
    let mut at = |time: f64, [on_1, on_3]: [Vector3<f64>; 2]| {
        let (sin, cos) = input.value(time).unwrap().sin_cos();
        // Axes of bar 3, from C to D; it turns about x.
        let along = Vector3::new(0.0, sin, -cos);
        let axes = Matrix3::from_columns(&[along, Vector3::x(), along.cross(&Vector3::x())]);
        let c = d - (c0 - d).norm() * along + axes * on_3;
        loop {
            let (sin, cos) = angle.sin_cos();
            let (along, across) = (Vector3::new(cos, 0.0, sin), Vector3::new(-sin, 0.0, cos));
            let axes = Matrix3::from_columns(&[along, Vector3::y(), across]);
            let arm = axes * (on_1 + Vector3::x() * crank.norm());
            let b = a + arm;
            let slope = (b - c).dot(&arm.cross(&Vector3::y()));
            let change = -0.5 * ((b - c).norm_squared() - rod * rod) / slope;
            angle += change;
            if change.abs() < 1e-14 {
                return b;
            }
        }
    };
    let mut last = 0.0;
    times
        .iter()
        .enumerate()
        .map(|(k, &time)| {
            // In small steps, so as to stay on the branch.
            for i in 1..=50 {
                at(last + (time - last) * f64::from(i) / 50.0, deflections(k));
            }
            last = time;
            at(time, deflections(k))
        })
        .collect()
}

fn rigid(_: usize) -> [Vector3<f64>; 2] {
    [Vector3::zeros(); 2]
}

#[test]
fn rigid_bars_follow_the_position_loop() {
    let mechanism = FourBar {
        elements: 0,
        ..FourBar::default()
    }
    .build();
    for n in [11, 41] {
        let solution = mechanism.solve(n);
        let times: Vec<f64> = solution.grid().times().collect();
        let b = position_loop(&times, rigid);
        // The node of bar 1 is at its centre: B is as far again from A.
        let x3 = &mechanism.curves(&solution, &times)[0];
        let error = largest(x3.iter().zip(&b).map(|(z, b)| 2.0 * z - b.z));
        println!("N = {n}: x3 of B off the loop by {error:.1e} m");
        // The acceptance limit; collocation is exact at its points, so only rounding is left.
        assert!(error < 1e-9, "N = {n}: {error}");
    }
}

#[test]
fn elastic_deflection_explains_the_difference_from_rigid_bars() {
    let mechanism = FourBar::default().build();
    let solution = &SOLUTIONS[&41];
    let times: Vec<f64> = solution.grid().times().collect();
    let [a, b, c, d] = four_bar_points();
    // Elementary beam theory, `∫ s M / EI ds` with `s` from the end that moves: linear statics.
    let deflections = |bar: usize, length: f64, stiffness: f64| -> Vec<Vector3<f64>> {
        let h = length / 8.0;
        let mut sum = vec![Vector3::zeros(); times.len()];
        for e in 0..8 {
            let s = (e as f64 + 0.5) * h;
            let arm = if bar == 0 { length - s } else { s };
            let element = mechanism.bars[bar] + e;
            let forces = solution.beam(element, 0.0, BeamQuantity::Force, &times);
            for (sum, f) in sum.iter_mut().zip(forces.unwrap().chunks_exact(6)) {
                *sum += Vector3::new(0.0, f[5], -f[4]) * (arm * h / stiffness);
            }
        }
        sum
    };
    let bar_1 = deflections(0, (b - a).norm(), FOUR_BAR_STIFFNESS[0][5]);
    let bar_3 = deflections(2, (d - c).norm(), FOUR_BAR_STIFFNESS[2][5]);

    let x3 = &mechanism.curves(solution, &times)[0];
    let stiff: Vec<f64> = position_loop(&times, rigid).iter().map(|b| b.z).collect();
    let bent: Vec<f64> = position_loop(&times, |k| [bar_1[k], bar_3[k]])
        .iter()
        .map(|b| b.z)
        .collect();
    let difference = largest_difference(x3, &stiff);
    let explained = largest_difference(&bent, &stiff);
    let left = largest_difference(x3, &bent);
    println!(
        "x3 of B, flexible against rigid: {difference:.3e} m; explained by elastic deflection: \
         {explained:.3e} m; not explained: {left:.1e} m"
    );
    // Linear theory leaves out terms of second order: deflections are about 1 % of the lengths.
    assert!(left < 0.01 * difference, "{left} {difference}");
}

#[test]
fn higher_orders_converge_to_the_same_curves() {
    let times = figure_times();
    let curves = |elements, degree| {
        let mechanism = FourBar {
            elements,
            degree,
            ..FourBar::default()
        }
        .build();
        mechanism.curves(&mechanism.solve(11), &times)
    };
    let reference = curves(3, 6);
    let error = |found: &[Vec<f64>; 3]| {
        largest((0..3).map(|i| relative_to_range(&found[i], &reference[i])))
    };
    let (coarse, fine) = (curves(16, 1), curves(32, 1));
    let ratio = error(&coarse) / error(&fine);
    println!(
        "two-node elements, 32 to a bar: error {:.2e}, ratio {ratio:.3}",
        error(&fine)
    );
    // Second order: a quarter for half the length.
    assert!((ratio - 4.0).abs() < 0.1);

    // By Richardson, the fine mesh is off by a third of its difference from the coarse one.
    let mesh_error: [f64; 3] =
        std::array::from_fn(|i| relative_to_range(&fine[i], &coarse[i]) / 3.0);
    let mut last = error(&fine);
    for degree in 2..=4 {
        let found = curves(2, degree);
        for i in 0..3 {
            // 1e-6: the error of two elements of degree 2 itself.
            let off = relative_to_range(&found[i], &fine[i]);
            assert!(off < 1.1 * mesh_error[i] + 1e-6, "degree {degree}: {off}");
        }
        let now = error(&found);
        println!("2 elements of degree {degree} to a bar: error {now:.2e}");
        // Two elements are short enough for each degree to gain more than a digit.
        assert!(now < 0.1 * last, "degree {degree}: {now} {last}");
        last = now;
    }
}

#[test]
fn a_coarse_solution_is_a_good_start_for_a_fine_one() {
    let mechanism = FourBar::default().build();
    let fine = TimeGrid::new(31, mechanism.period).unwrap();
    let mut options = options(31);
    options.guess = InitialGuess::State(SOLUTIONS[&11].prolonged(fine).unwrap());
    let solution = Solution::solve(
        &mechanism.model,
        mechanism.period,
        &options,
        &mut |stage, _| {
            assert_eq!(stage, Stage::Newton);
            true
        },
    )
    .unwrap();
    let report = &solution.details().report;
    assert_eq!(report.outcome, Outcome::Converged);
    assert!(report.iterations.len() <= 3, "{report:?}");
    let times = figure_times();
    let (found, scratch) = (
        mechanism.curves(&solution, &times),
        mechanism.curves(&SOLUTIONS[&31], &times),
    );
    for (a, b) in found.iter().zip(&scratch) {
        let difference = relative_to_range(a, b);
        // Rounding: strains of 1e-16 times 5e7 N, against forces of 10 N.
        assert!(difference < 1e-8, "{difference}");
    }
}

#[test]
fn a_solve_can_be_cancelled_and_limited() {
    let mechanism = FourBar::default().build();
    let solve = |options: &_, observe: &mut dyn FnMut(Stage) -> bool| {
        Solution::solve(
            &mechanism.model,
            mechanism.period,
            options,
            &mut |stage, _| observe(stage),
        )
        .unwrap()
        .outcome()
    };
    let mut seen = Vec::new();
    for stop in [Stage::InitialGuess, Stage::Newton] {
        let outcome = solve(&options(11), &mut |stage| {
            seen.push(stage);
            stage != stop
        });
        assert_eq!(outcome, Outcome::Cancelled);
        assert_eq!(seen.pop(), Some(stop), "nothing is done after cancelling");
    }
    let mut limited = options(11);
    limited.newton.iteration_limit = 1;
    assert_eq!(solve(&limited, &mut |_| true), Outcome::IterationLimit);
}
