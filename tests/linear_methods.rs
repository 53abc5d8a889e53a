//! However linear equations are solved, and by however many threads, the solution is the same: with
//! the same number of threads, bit by bit.

mod common;

use common::converged;
use common::models::beams::{forced_cantilever, planar_four_bar, rotor, rotor_blade, slider_crank};
use common::models::four_bar::{FOUR_BAR_PERIOD, spatial_four_bar};
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::{LinearMethod, PeriodicOptions, Preconditioner};

/// Of motions relative to the size of the mechanism, and of joint forces relative to the largest.
const TOLERANCE: f64 = 1e-12;

fn solve(
    (model, period): &(Model, f64),
    points: usize,
    linear: LinearMethod,
    threads: usize,
    oversampling: usize,
) -> Solution {
    let mut options = PeriodicOptions {
        linear,
        threads,
        oversampling,
        ..PeriodicOptions::with_grid_points(points)
    };
    options.newton.tolerance = 1e-12;
    let solution = Solution::solve(model, *period, &options, &mut |_, _| true).unwrap();
    converged(solution)
}

/// Largest difference of motions, and of multipliers.
fn difference(a: &Solution, b: &Solution) -> [f64; 2] {
    let (a, b) = (a.details(), b.details());
    let motions = a.state.distance(&b.state, a.system.scales().length);
    let size = |x: &[f64]| x.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let pairs = a.state.multipliers.iter().zip(&b.state.multipliers);
    let change: Vec<f64> = pairs.map(|(a, b)| a - b).collect();
    [motions, size(&change) / size(&a.state.multipliers)]
}

fn check(name: &str, model: (Model, f64), points: usize, methods: &[LinearMethod]) {
    check_oversampled(name, model, points, methods, 1);
}

fn check_oversampled(
    name: &str,
    model: (Model, f64),
    points: usize,
    methods: &[LinearMethod],
    oversampling: usize,
) {
    let exact = solve(&model, points, LinearMethod::Direct, 1, oversampling);
    for &method in methods {
        for threads in [1, 2] {
            let found = solve(&model, points, method, threads, oversampling);
            let differences = difference(&exact, &found);
            println!("{name}, {method:?}, {threads} threads: {differences:?}");
            assert!(
                differences.iter().all(|d| *d < TOLERANCE),
                "{name}, {method:?}, {threads} threads: {differences:?}"
            );
            let again = solve(&model, points, method, threads, oversampling);
            let bits = |solution: &Solution| -> Vec<u64> {
                let state = &solution.details().state;
                let motions = state.motions.iter().flat_map(|m| {
                    let numbers = m.position.iter().chain(m.rotation.iter());
                    numbers.copied().collect::<Vec<f64>>()
                });
                let all = motions.chain(state.multipliers.iter().copied());
                all.map(f64::to_bits).collect()
            };
            assert!(
                bits(&found) == bits(&again),
                "{name}, {method:?}, {threads}"
            );
        }
    }
}

const BODY: LinearMethod = LinearMethod::Iterative(Some(Preconditioner::BodyCirculant));
const LOCAL: LinearMethod = LinearMethod::Iterative(Some(Preconditioner::TimeLocal));

#[test]
fn rotors() {
    check("rotor", rotor(8), 21, &[LinearMethod::Direct, BODY]);
    check("rotor blade", rotor_blade(8, 1), 21, &[BODY]);
    check("cantilever", forced_cantilever(4, 2), 41, &[BODY]);
}

#[test]
fn slow_mechanisms() {
    let spatial = (spatial_four_bar(8, 1), FOUR_BAR_PERIOD);
    let all = [LinearMethod::Direct, BODY, LOCAL];
    check("spatial four-bar", spatial, 21, &all);
    check("planar four-bar", planar_four_bar(5, 2, 1e-3), 31, &all);
    // From a solution on fewer points, and from the quasi-static motion.
    let spatial = (spatial_four_bar(2, 1), FOUR_BAR_PERIOD);
    check("spatial four-bar", spatial, 99, &[LOCAL]);
    check("planar four-bar", planar_four_bar(2, 2, 1e-3), 99, &[LOCAL]);
}

#[test]
fn a_fast_mechanism() {
    let period = std::f64::consts::TAU / 120.0;
    let crank = (slider_crank(8, 1, period), period);
    check("slider-crank", crank, 31, &[LinearMethod::Direct, BODY]);
}

#[test]
fn oversampled_equations() {
    let spatial = (spatial_four_bar(2, 1), FOUR_BAR_PERIOD);
    let methods = [LinearMethod::Direct, BODY];
    check_oversampled("spatial four-bar", spatial, 15, &methods, 2);
}
