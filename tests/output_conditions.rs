//! Conditions on what comes out: trim, resonance, amplitudes.

mod common;

use common::models::small::whirled_beam;
use common::*;
use nalgebra::Vector3;
use periodyn::elements::Coordinate;
use periodyn::model::{SignalPart, SignalPlace, Target};
use periodyn::output::{BeamQuantity, JointQuantity, NodeQuantity, Quantity, Selection, Solution};
use periodyn::quantity::Feature;
use periodyn::solve::{Condition, Free, LinearMethod, OutputIs, PeriodicOptions};
use std::f64::consts::TAU;
use std::sync::Arc;

fn is(output: impl Into<Selection>, feature: Feature, value: f64) -> Arc<dyn Condition> {
    Arc::new(OutputIs {
        output: output.into(),
        feature,
        value,
        scale: None,
    })
}

/// Increments shrink quadratically: the last is rounding after at most so many.
fn assert_quadratic(solution: &Solution, most: usize) {
    let iterations = &solution.details().report.iterations;
    let all: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
    println!("{all:?}");
    assert!(all.len() <= most, "{all:?}");
}

#[test]
fn resonance_is_where_velocity_and_force_are_in_phase() {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    spring(&mut model, at, 4.0, 0.1);
    model.add_actuator(at, &cosine(0.3)).unwrap();
    // x' = F/c cos t there: nothing with the sine, whichever output tells it.
    let joint = at.joint;
    let outputs: [Selection; 3] = [
        Quantity::Node(0, NodeQuantity::Velocity).component(0),
        Quantity::Node(0, NodeQuantity::MaterialVelocity).component(0),
        Quantity::Joint(joint, JointQuantity::Rate(Coordinate::Displacement1)).into(),
    ];
    for output in outputs {
        let conditions = [is(output, Feature::Sine(1), 0.0)];
        let period = TAU / 1.98;
        let solution = solve_for(&model, period, &[Free::Frequency], &conditions, &options(9));
        assert_quadratic(&solution, 8);
        let frequency = TAU / solution.grid().period();
        assert!((frequency - 2.0).abs() < 1e-12, "{output:?}: {frequency}");
        let rate = &solution.series(output).unwrap()[0];
        assert!((rate.cosines[0] - 3.0).abs() < 1e-11, "{:?}", rate.cosines);
    }
}

#[test]
fn loads_are_found_that_give_section_moments() {
    let (mut model, period) = whirled_beam();
    let mut free = Vec::new();
    for (name, component) in [("across", 1), ("up", 2)] {
        let parameter = model.add_parameter(name, 0.0, 1.0).unwrap();
        let place = SignalPlace::Load(0, component);
        let target = Target::Signal(place, SignalPart::Mean);
        model.move_by_parameter(parameter, target, 1.0).unwrap();
        free.push(Free::Parameter(parameter));
    }
    let root = Quantity::Beam {
        element: 0,
        station: -1.0,
        quantity: BeamQuantity::Force,
    };
    let held = common::solve(&model, period, 15);
    let free_mean = |c: usize| held.series(root.component(c)).unwrap()[0].mean;
    let largest = held.extremes(root.component(5)).unwrap()[0].largest;
    let targets = [free_mean(4) + 0.1 * largest, free_mean(5) - 0.2 * largest];
    let conditions = [4, 5].map(|c| is(root.component(c), Feature::Mean, targets[c - 4]));
    let mut found: Vec<Vec<f64>> = Vec::new();
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let options = PeriodicOptions {
            linear,
            ..options(15)
        };
        let solution = solve_for(&model, period, &free, &conditions, &options);
        assert_quadratic(&solution, 8);
        for (c, target) in [4, 5].into_iter().zip(targets) {
            let mean = solution.series(root.component(c)).unwrap()[0].mean;
            assert!((mean - target).abs() < 1e-9 * largest, "{mean} {target}");
        }
        let parameters = solution.model().parameters();
        found.push(parameters.iter().map(|p| p.value).collect());
        // Given these loads, the moments come out without any condition.
        let given = common::solve(solution.model(), period, 15);
        let mean = given.series(root.component(5)).unwrap()[0].mean;
        assert!((mean - targets[1]).abs() < 1e-8 * largest);
    }
    let size = found[0].iter().fold(0.0f64, |m, x| m.max(x.abs()));
    for (a, b) in found[0].iter().zip(&found[1]) {
        assert!((a - b).abs() < 1e-8 * size, "{found:?}");
    }
}

#[test]
fn what_an_output_does_not_have_is_refused() {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    spring(&mut model, at, 4.0, 0.1);
    model.add_actuator(at, &cosine(0.3)).unwrap();
    let position = Quantity::Node(0, NodeQuantity::Position);
    for (condition, why) in [
        (is(position.component(0), Feature::Sine(5), 0.0), "1 to 4"),
        (is(position.component(3), Feature::Mean, 0.0), "below 3"),
        (is(position, Feature::Mean, 0.0), "component"),
        (
            is(
                Quantity::Node(7, NodeQuantity::Position).component(0),
                Feature::Mean,
                0.0,
            ),
            "node id below 1",
        ),
    ] {
        let (free, conditions) = ([Free::Frequency], [condition]);
        let lists = (&free[..], &conditions[..]);
        let found = Solution::solve_conditioned(&model, TAU, lists, &options(9), &mut |_, _| true);
        let error = found.unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
}
