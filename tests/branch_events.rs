//! Events on branches located by an equation of their own, and followed along a second parameter.

mod common;

use common::models::oscillators::*;
use common::*;
use nalgebra::{DMatrix, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::model::{JointCoordinate, Model, SignalPart, SignalPlace, Target};
use periodyn::solve::{
    Adaptation, Branch, BranchEnd, BranchOptions, BranchPoint, Event, Free, GridPoints,
    LinearMethod, Phase, StabilityOptions, follow_branch, follow_locus,
};
use std::f64::consts::TAU;
use std::sync::Arc;

fn follow(model: &Model, period: f64, free: Free, options: &BranchOptions) -> Branch {
    follow_branch(model, period, free, options, &mut |_, _| true).unwrap()
}

fn locus(branch: &Branch, index: usize, second: usize, options: &BranchOptions) -> Branch {
    let second = Free::Parameter(second);
    let locus = follow_locus(branch, index, second, options, &mut |_, _| true).unwrap();
    let ends = locus.points.iter().map(|p| p.values.clone());
    let ends: Vec<Vec<f64>> = ends.collect();
    println!(
        "{} points, {} iterations, {} rejected, {:?}, from {:?} to {:?}",
        locus.points.len(),
        locus.iterations,
        locus.rejected,
        locus.end,
        ends.first(),
        ends.last()
    );
    locus
}

/// Number of the first point with an event.
fn first(branch: &Branch, event: Event) -> usize {
    let is_one = |point: &BranchPoint| point.event == Some(event);
    branch.points.iter().position(is_one).unwrap()
}

/// Asserts that Newton's increments at least square themselves, so many times, but for rounding.
fn assert_quadratic(point: &BranchPoint, times: usize) {
    let all = &point.increments;
    println!("{:?} at {}: {all:?}", point.event, point.values[0]);
    let pairs = all.windows(2).filter(|pair| pair[0] < 0.1);
    for pair in pairs.clone() {
        assert!(pair[1] < 10.0 * pair[0] * pair[0] + 1e-11, "{all:?}");
    }
    assert!(
        pairs.count() >= times && all.last().unwrap() < &1e-10,
        "{all:?}"
    );
}

#[test]
fn folds_are_located_quadratically() {
    let options = BranchOptions {
        periodic: options(41),
        range: [0.5, 1.6],
        events: true,
        ..BranchOptions::default()
    };
    let branch = follow(&duffing(), TAU / 0.9, Free::Frequency, &options);
    let folds: Vec<&BranchPoint> = branch.points.iter().filter(|p| p.event.is_some()).collect();
    assert_eq!(folds.len(), 2);
    for (fold, exact) in folds
        .into_iter()
        .zip([1.269_601_955_546, 1.115_700_251_771])
    {
        println!("off by {:e}", fold.values[0] - exact);
        assert!(fold.event == Some(Event::Fold) && (fold.values[0] - exact).abs() < 2e-12);
        assert_quadratic(fold, 2);
    }
}

#[test]
fn a_period_doubling_is_located_quadratically() {
    let (model, load) = escape_oscillator();
    let options = BranchOptions {
        periodic: options(31),
        range: [0.0, 0.105],
        motion_scale: 0.5,
        events: true,
        stability: Some(StabilityOptions::default()),
        ..BranchOptions::default()
    };
    let branch = follow(&model, TAU / 0.85, Free::Parameter(load), &options);
    let doubling = &branch.points[first(&branch, Event::PeriodDoubling)];
    assert!((doubling.values[0] - 0.100_501_010_278).abs() < 2e-12);
    assert_quadratic(doubling, 2);
    // Unstable between the folds, and beyond the doubling.
    let outside: Vec<usize> = branch
        .points
        .iter()
        .filter(|p| p.event.is_none())
        .map(|p| p.stability.unwrap().outside)
        .collect();
    let mut runs = outside.clone();
    runs.dedup();
    assert_eq!(runs, [0, 1, 0, 1], "{outside:?}");
}

/// Van der Pol's oscillator under a load that it follows, and the parameter that is the load.
fn forced_van_der_pol() -> (Model, usize) {
    let (mut model, at) = van_der_pol(0.4);
    model.add_actuator(at, &cosine(1.0)).unwrap();
    let load = model.add_parameter("load", 3.0, 1.0).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(1), SignalPart::Amplitude);
    model.move_by_parameter(load, target, 1.0).unwrap();
    (model, load)
}

/// Mean of x² over the period, less 1.
fn excess(point: &BranchPoint) -> f64 {
    let squares = point.state.node(0).iter().map(|m| m.position.x.powi(2));
    squares.sum::<f64>() / point.state.points() as f64 - 1.0
}

#[test]
fn torus_points_are_where_the_mean_of_the_square_is_one() {
    // The product of both multipliers is the exponential of the mean divergence.
    let (model, load) = forced_van_der_pol();
    let options = BranchOptions {
        periodic: options(41),
        range: [0.5, 3.5],
        downwards: true,
        stability: Some(StabilityOptions::default()),
        ..BranchOptions::default()
    };
    let period = TAU / 1.5;
    let branch = follow(&model, period, Free::Parameter(load), &options);
    let at = first(&branch, Event::Torus);
    let torus = &branch.points[at];
    println!("mean of the square less one: {:e}", excess(torus));
    assert!(excess(torus).abs() < 1e-12);
    assert_quadratic(torus, 2);
    let frequency = torus.second_frequency.unwrap();
    assert!(frequency > 0.5 && frequency < 1.5, "{frequency}");
    let counts = [at - 1, at + 1].map(|i| branch.points[i].stability.unwrap().outside);
    assert_eq!(counts, [0, 2]);
    assert!(branch.report().contains("torus point at "));

    // And along the frequency and the load, both found.
    let mut model = model;
    let damping = model.add_parameter("unfolding", 0.0, 0.1).unwrap();
    model
        .move_by_parameter(damping, Target::MassDamping, 1.0)
        .unwrap();
    let branch = follow(&model, period, Free::Parameter(load), &options);
    let range = BranchOptions {
        range: [-0.1, 0.1],
        ..options.clone()
    };
    let locus = locus(&branch, first(&branch, Event::Torus), damping, &range);
    assert_eq!(locus.end, BranchEnd::Range, "{}", locus.explanation);
    for point in &locus.points {
        // With damping c the divergence is μ (1 − x²) − c.
        let off = excess(point) + point.values[0] / 0.4;
        assert!(off.abs() < 1e-11, "{off:e}");
    }
    assert!(
        locus
            .report()
            .contains("Locus of torus points along the parameter \"unfolding\"")
    );
}

#[test]
fn folds_of_a_duffing_oscillator_meet_at_a_cusp() {
    // The locus leads from the one fold to the other, both known from elsewhere.
    let (model, load) = duffing_with_load();
    let options = BranchOptions {
        periodic: options(41),
        range: [0.5, 1.6],
        events: true,
        ..BranchOptions::default()
    };
    let branch = follow(&model, TAU / 0.9, Free::Frequency, &options);
    let range = BranchOptions {
        range: [0.02, 0.18],
        downwards: true,
        ..options.clone()
    };
    let locus = locus(&branch, first(&branch, Event::Fold), load, &range);
    assert_eq!(locus.end, BranchEnd::Range, "{}", locus.explanation);
    let last = locus.points.last().unwrap();
    assert!((last.values[0] - 0.18).abs() < 1e-15);
    println!("off by {:e}", last.values[1] - 1.115_700_251_771);
    assert!((last.values[1] - 1.115_700_251_771).abs() < 2e-12);
    assert_eq!(locus.value_names(), ["load", "frequency"]);
    let least = locus.points.iter().map(|p| p.values[0]).fold(1.0, f64::min);
    assert!(least > 0.02 && least < 0.15, "{least}");
    // Each is a fold of the branch with its own load.
    let middle = &locus.points[locus.points.len() / 3];
    let (found, solved) = locus.solved(locus.points.len() / 3).unwrap();
    let mut across = options.clone();
    across.periodic.guess = periodyn::solve::InitialGuess::State(solved.state.clone());
    across.range = [middle.values[1] - 0.2, middle.values[1] + 0.2];
    let again = follow(
        &found,
        TAU / (middle.values[1] - 1e-3),
        Free::Frequency,
        &across,
    );
    let again = again.points.iter().filter(|p| p.event == Some(Event::Fold));
    let off = again.map(|p| (p.values[0] - middle.values[1]).abs());
    let nearest = off.fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-10, "{nearest:e}");
}

#[test]
fn a_pendulum_turns_over_where_the_torque_is_its_weight() {
    let (mut model, torque) = pendulum_under_torque();
    let weight = model.add_parameter("gravity", 9.81, 1.0).unwrap();
    let target = Target::Signal(SignalPlace::Gravity(2), SignalPart::Mean);
    model.move_by_parameter(weight, target, -1.0).unwrap();
    let options = BranchOptions {
        periodic: options(3),
        range: [-12.0, 12.0],
        ..BranchOptions::default()
    };
    let branch = follow(&model, 1.0, Free::Parameter(torque), &options);
    let range = BranchOptions {
        range: [1.0, 20.0],
        ..options
    };
    let locus = locus(&branch, first(&branch, Event::Fold), weight, &range);
    assert_eq!(locus.end, BranchEnd::Range, "{}", locus.explanation);
    for point in &locus.points {
        assert!((point.values[0] - point.values[1]).abs() < 1e-11);
    }
}

/// The number `a` of Mathieu's equation `x'' + (a − 2 q cos 2t) x = 0` with a solution of twice the
/// period: the least eigenvalue of Hill's matrix for cosines, or for sines.
fn mathieu(q: f64, sines: bool) -> f64 {
    let size = 40;
    let hill = DMatrix::from_fn(size, size, |i, j| match i.abs_diff(j) {
        0 if i == 0 => 1.0 + if sines { -q } else { q },
        0 => ((2 * i + 1) as f64).powi(2),
        1 => q,
        _ => 0.0,
    });
    hill.symmetric_eigenvalues().min()
}

#[test]
fn doublings_of_a_shaken_pendulum_follow_the_tongue_of_mathieu() {
    assert!((mathieu(1.0, false) - 1.859_108_072_514).abs() < 1e-12);
    assert!((mathieu(1.0, true) + 0.110_248_816_992).abs() < 1e-12);
    // Of length 1, on a pivot at A cos 2t, under gravity g: a = g and q = 2 A.
    let mut model = Model::new();
    let up = Vector3::z();
    let pivot = ball(&mut model, 1.0, 1.0, &Vector3::zeros());
    let bob = model.add_rigid_body(1.0, &-up, &nalgebra::Matrix3::zeros());
    let slide = join(
        &mut model,
        JointKind::Prismatic,
        [None, Some(pivot)],
        &Vector3::zeros(),
        &up,
    );
    let y = Vector3::y();
    revolute(
        &mut model,
        Some(pivot),
        Some(bob.unwrap()),
        &Vector3::zeros(),
        &y,
    );
    let at = JointCoordinate {
        joint: slide,
        coordinate: Coordinate::Displacement1,
    };
    model.prescribe(at, &cosine(1.0)).unwrap();
    gravity(&mut model, [0.0, 0.0, 0.0]);
    let weight = model.add_parameter("gravity", 1.0, 1.0).unwrap();
    let target = Target::Signal(SignalPlace::Gravity(2), SignalPart::Mean);
    model.move_by_parameter(weight, target, -1.0).unwrap();
    let shake = model.add_parameter("shake", 0.5, 1.0).unwrap();
    let target = Target::Signal(SignalPlace::Prescribed(0), SignalPart::Amplitude);
    model.move_by_parameter(shake, target, 1.0).unwrap();
    for (downwards, sines) in [(false, false), (true, true)] {
        let options = BranchOptions {
            periodic: options(21),
            range: [-0.3, 2.2],
            downwards,
            events: true,
            largest_step: 0.05,
            ..BranchOptions::default()
        };
        let branch = follow(&model, TAU / 2.0, Free::Parameter(weight), &options);
        let at = first(&branch, Event::PeriodDoubling);
        // At rest all is linear, and one increment is enough.
        assert_quadratic(&branch.points[at], 1);
        let range = BranchOptions {
            range: [0.05, 1.5],
            downwards: false,
            largest_step: 0.2,
            events: false,
            ..options
        };
        let locus = locus(&branch, at, shake, &range);
        assert_eq!(locus.end, BranchEnd::Range, "{}", locus.explanation);
        for point in &locus.points {
            let off = point.values[1] - mathieu(2.0 * point.values[0], sines);
            assert!(off.abs() < 1e-10, "{}: {off:e}", point.values[0]);
        }
    }
}

#[test]
fn loci_that_are_none_are_refused() {
    let (model, load) = duffing_with_load();
    let options = BranchOptions {
        periodic: options(21),
        range: [0.5, 1.6],
        ..BranchOptions::default()
    };
    let branch = follow(&model, TAU / 0.9, Free::Frequency, &options);
    let refused = |index: usize, second: Free, range: [f64; 2], why: &str| {
        let options = BranchOptions {
            range,
            ..options.clone()
        };
        let end = follow_locus(&branch, index, second, &options, &mut |_, _| true);
        let error = end.unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    };
    let fold = first(&branch, Event::Fold);
    let range = [0.1, 0.2];
    refused(
        0,
        Free::Parameter(load),
        range,
        "nothing happens at point 0",
    );
    refused(fold, Free::Frequency, range, "the frequency twice");
    refused(fold, Free::Parameter(7), range, "parameter");
    refused(
        fold,
        Free::Parameter(load),
        [0.2, 0.3],
        "\"load\" between 0.2 and 0.3",
    );
    refused(999, Free::Parameter(load), range, "a point below");
}

#[test]
fn the_grid_gets_finer_along_a_locus() {
    let (model, load) = duffing_with_load();
    let with = |grid_points: GridPoints| {
        let mut options = BranchOptions {
            range: [0.5, 1.6],
            ..BranchOptions::default()
        };
        options.periodic.grid_points = grid_points;
        let branch = follow(&model, TAU / 0.9, Free::Frequency, &options);
        options.range = [0.1, 4.0];
        let fold = first(&branch, Event::Fold);
        let locus = locus(&branch, fold, load, &options);
        assert_eq!(locus.end, BranchEnd::Range, "{}", locus.explanation);
        locus.points.last().unwrap().clone()
    };
    let tolerance = 1e-8;
    let found = with(GridPoints::Adaptive(Adaptation {
        error_tolerance: tolerance,
        ..Adaptation::default()
    }));
    let exact = with(GridPoints::Fixed(81));
    let off = found.values[1] - exact.values[1];
    println!("on {} points off by {off:e}", found.grid.points());
    assert!(off.abs() < tolerance);
    let first = with(GridPoints::Fixed(11));
    assert!(
        (first.values[1] - exact.values[1]).abs() > tolerance,
        "11 are enough"
    );
    assert!(found.grid.points() > 11);
}

#[test]
fn folds_of_limit_cycles_are_located_and_followed() {
    // m (x'' + c x' + x) = (r² − r⁴) x' with r² = x² + x'²: circles with m c = r² − r⁴, of which
    // those with r² = 1/2 are folds.
    let (model, damping, mass) = circles();
    let start = starting_at(options(9), (&model, 9, TAU), |t| displaced(0.94 * t.cos()));
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let mut with = BranchOptions {
            periodic: start.clone(),
            free: vec![Free::Frequency],
            conditions: vec![Arc::new(Phase)],
            range: [-0.2, 1.0],
            events: true,
            point_limit: 40,
            ..BranchOptions::default()
        };
        with.periodic.linear = linear;
        let branch = follow(&model, TAU, Free::Parameter(damping), &with);
        let at = first(&branch, Event::Fold);
        let fold = &branch.points[at];
        println!("off by {:e}", fold.values[0] - 0.25);
        assert!((fold.values[0] - 0.25).abs() < 1e-12);
        // The cubic between two points leads so near that there are but two increments.
        assert_quadratic(fold, 1);

        let range = BranchOptions {
            range: [0.5, 3.0],
            ..with.clone()
        };
        let locus = locus(&branch, at, mass, &range);
        assert_eq!(locus.end, BranchEnd::Range, "{}", locus.explanation);
        assert!(locus.points.len() > 3);
        for point in &locus.points {
            let [mass, frequency, damping] = point.values[..] else {
                panic!("{:?}", point.values);
            };
            let off = [damping - 0.25 / mass, frequency - 1.0];
            assert!(off.iter().all(|off| off.abs() < 1e-11), "{mass}: {off:?}");
        }
        assert_quadratic(locus.points.last().unwrap(), 1);
    }
}

#[test]
fn what_floats_doubles_no_period() {
    // x'' + 0.1 x' + k x + x³ = 0 at rest: where k = 0 a multiplier is 1, and none is ever −1,
    // though the grid has a half-harmonic without a derivative.
    for points in [15, 31] {
        let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
        let spring = model.add_polynomial_spring_damper(at, &[0.5, 0.0, 1.0], &[0.1], 0.0);
        let stiffness = model.add_parameter("stiffness", 0.5, 1.0).unwrap();
        let target = Target::Stiffness(spring.unwrap(), 1);
        model.move_by_parameter(stiffness, target, 1.0).unwrap();
        let with = BranchOptions {
            periodic: options(points),
            range: [-0.2, 0.5],
            downwards: true,
            events: true,
            ..BranchOptions::default()
        };
        let branch = follow(&model, TAU, Free::Parameter(stiffness), &with);
        assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
        let events = branch.points.iter().filter_map(|p| Some((p.event?, p)));
        let events: Vec<_> = events.map(|(event, p)| (event, p.values[0])).collect();
        println!("{points}: {events:?}");
        let [(event, value)] = events[..] else {
            panic!("{events:?}");
        };
        assert!(event == Event::BranchPoint && value.abs() < 1e-10);
    }
}
