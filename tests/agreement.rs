//! Collocation, shooting and marching, three ways to the same periodic motion, agree to the errors
//! that each of them estimates of itself: collocation from the decay of its harmonics, the others
//! from steps of half the length.

mod common;

use common::*;
use periodyn::model::*;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;

/// What the difference of two methods may be, in units of the sum of their estimates: both are of
/// the leading term of the error.
const SAFETY: f64 = 1.2;

/// Largest difference of motions, in the measure of the estimate of collocation; each at its own
/// times.
fn distance((a, a_times): (&Solution, &[f64]), (b, b_times): (&Solution, &[f64])) -> f64 {
    let length = a.details().system.scales().length;
    largest((0..a.model().node_count()).flat_map(|node| {
        let difference = |quantity| {
            let at = |s: &Solution, times: &[f64]| s.node(node, quantity, times).unwrap();
            largest_difference(&at(a, a_times), &at(b, b_times))
        };
        [
            difference(NodeQuantity::Position) / length,
            difference(NodeQuantity::RotationMatrix),
        ]
    }))
}

fn agree(name: &str, model: &Model, period: f64, steps: usize) {
    let observe = &mut |_: Stage, _: &Iteration| true;
    let options = PeriodicOptions::with_error_tolerance(1e-8);
    let collocation = Solution::solve(model, period, &options, observe).unwrap();
    assert_eq!(collocation.outcome(), Outcome::Converged);
    let own = collocation.diagnostics().error_estimate;
    let start = || MarchStart::State(collocation.start_state(0.0).unwrap());
    // At steps of both lengths, so that nothing is interpolated.
    let times: Vec<f64> = (0..=40).map(|i| period * i as f64 / 40.0).collect();

    let shot = |steps: usize| {
        let options = ShootingOptions {
            steps,
            start: start(),
            ..ShootingOptions::default()
        };
        Solution::solve_shooting(model, period, &options, &mut |_, _| true).unwrap()
    };
    let marched = |steps: usize| {
        let mut options =
            MarchOptions::with_step(period / steps as f64, MarchEnd::Duration(2.0 * period));
        options.period = Some(period);
        options.start = start();
        Solution::march(model, &options, &mut |_, _| true).unwrap()
    };
    // The start of a march sets what is stiff and light vibrating, by no more than rounding of the
    // start: the second period is looked at.
    let later: Vec<f64> = times.iter().map(|t| t + period).collect();
    let mut fine = Vec::new();
    for (method, solutions, at) in [
        ("shooting", [steps, 2 * steps].map(shot), &times),
        ("marching", [steps, 2 * steps].map(marched), &later),
    ] {
        let [coarse, halved] = solutions;
        for solution in [&coarse, &halved] {
            assert_eq!(
                solution.outcome(),
                Outcome::Converged,
                "{}",
                solution.report()
            );
        }
        // Of the second order: a third of what halving the steps changes is left.
        let estimate = distance((&coarse, at), (&halved, at)) / 3.0;
        let difference = distance((&halved, at), (&collocation, &times));
        println!(
            "{name}: {method} {difference:.2e} from collocation; estimates {estimate:.2e} and \
             {own:.1e}"
        );
        assert!(
            estimate < 1e-2,
            "{name}: {method} is no solution: {estimate}"
        );
        let allowed = SAFETY * (estimate + own);
        assert!(
            difference < allowed,
            "{name}: {method} {difference:e}, {allowed:e}"
        );
        // An estimate far too large would allow anything.
        assert!(difference > 0.3 * estimate - own, "{name}: {method}");
        fine.push((halved, estimate));
    }
    let [(shooting, first), (march, second)] = &fine[..] else {
        unreachable!()
    };
    let difference = distance((shooting, &times), (march, &later));
    let allowed = SAFETY * (first + second);
    println!("{name}: shooting {difference:.2e} from marching; allowed {allowed:.2e}");
    assert!(difference < allowed, "{name}");
}

#[test]
fn on_an_oscillator() {
    let (model, _) = oscillator();
    agree("oscillator", &model, TAU / 3.0, 200);
}

#[test]
fn on_a_double_pendulum() {
    let (model, _) = double_pendulum();
    agree("double pendulum", &model, DOUBLE_PENDULUM_PERIOD, 200);
}

#[test]
fn on_a_flexible_four_bar() {
    let four_bar = FourBar {
        elements: 1,
        degree: 1,
        loaded: true,
        setting: Setting::default(),
    }
    .build();
    agree("flexible four-bar", &four_bar.model, four_bar.period, 200);
}

#[test]
fn on_a_zener_pendulum() {
    let (model, _, _) = zener_pendulum();
    agree("Zener pendulum", &model, TAU / 3.0, 200);
}
