//! Branches of periodic motions along a parameter.

mod common;

use common::models::oscillators::*;
use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::GridState;
use periodyn::elements::{Coordinate, CoordinateLaw, Effort, JointKind};
use periodyn::error::{Error, ErrorKind};
use periodyn::fourier::TimeGrid;
use periodyn::model::{JointCoordinate, Model, SignalPart, SignalPlace, Target};
use periodyn::motion::Motion;
use periodyn::output::{ForceQuantity, NodeQuantity, Quantity, Solution};
use periodyn::solve::{
    Adaptation, Branch, BranchEnd, BranchOptions, BranchPoint, Event, Free, GridPoints,
    InitialGuess, LinearMethod, Outcome, Phase, StabilityOptions, follow_branch, solve_stability,
    switch_branch,
};
use periodyn::system::System;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Folds of `duffing`, and the size of the first harmonic there, by a prototype in reduced
/// coordinates.
const FOLDS: [[f64; 2]; 2] = [
    [1.269_601_955_546, 2.825_016_712_9],
    [1.115_700_251_771, 1.081_870_323_4],
];

fn response(points: usize) -> BranchOptions {
    BranchOptions {
        periodic: options(points),
        range: [0.5, 1.6],
        ..BranchOptions::default()
    }
}

fn follow(model: &Model, start: f64, options: &BranchOptions) -> Branch {
    let frequency = Free::Frequency;
    follow_branch(model, TAU / start, frequency, options, &mut |_, _| true).unwrap()
}

/// Size of the first harmonic of the position of node 0 along x.
fn first_harmonic(branch: &Branch, index: usize) -> f64 {
    let state = &branch.points[index].state;
    let count = state.points() as f64;
    let sum = |f: &dyn Fn(f64) -> f64| {
        let all = state.node(0).iter().enumerate();
        let terms = all.map(|(k, m)| m.position.x * f(TAU * k as f64 / count));
        2.0 / count * terms.sum::<f64>()
    };
    sum(&f64::cos).hypot(sum(&f64::sin))
}

#[test]
fn a_duffing_oscillator_is_followed_through_both_folds() {
    let model = duffing();
    for scale in [0.1, 1.0, 10.0] {
        let options = BranchOptions {
            motion_scale: scale,
            ..response(41)
        };
        let branch = follow(&model, 0.5, &options);
        let angles = branch.points.iter().map(|p| p.angle);
        let largest_angle = angles.fold(0.0, f64::max);
        println!(
            "{scale}: {} points, {} iterations, {} rejected, largest angle {largest_angle:.2}",
            branch.points.len(),
            branch.iterations,
            branch.rejected
        );
        assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
        assert!(largest_angle <= 0.4);
        let last = branch.points.last().unwrap();
        assert!((last.values[0] - 1.6).abs() < 1e-15);
        // No jump: neighbours are as near as the step is long.
        for pair in branch.points.windows(2) {
            let moved = pair[1].state.distance(&pair[0].state, 1.0);
            let away = if pair[0].event.is_some() {
                pair[1].step
            } else {
                pair[1].step.max(pair[0].step)
            };
            assert!(moved < 3.0 * away * scale, "{moved} {away}");
        }
        let folds: Vec<usize> = (0..branch.points.len())
            .filter(|&i| branch.points[i].event == Some(Event::Fold))
            .collect();
        assert_eq!(folds.len(), 2);
        for (i, [frequency, size]) in folds.into_iter().zip(FOLDS) {
            let off = branch.points[i].values[0] - frequency;
            let off_size = first_harmonic(&branch, i) - size;
            println!("fold off by {off:e}, harmonic by {off_size:e}");
            assert!(off.abs() < 2e-12 && off_size.abs() < 1e-9);
        }
    }
}

#[test]
fn points_of_a_branch_are_solutions_by_either_linear_solver() {
    let model = duffing();
    let direct = follow(&model, 0.5, &response(31));
    let mut options = response(31);
    options.periodic.linear = LinearMethod::Iterative(None);
    let iterative = follow(&model, 0.5, &options);
    // Where the parameter determines the motion well, by the other solver from there.
    let well = iterative.points.iter().enumerate();
    for (index, point) in well.filter(|(_, point)| point.slope.abs() > 0.1) {
        let (found, solved) = iterative.solved(index).unwrap();
        let mut options = common::options(31);
        options.guess = InitialGuess::State(solved.state.clone());
        options.linear = LinearMethod::Direct;
        let period = solved.grid.period();
        let again = Solution::solve(&found, period, &options, &mut |_, _| true).unwrap();
        let distance = again.details().state.distance(&point.state, 1.0);
        assert!(distance < 1e-10, "{index}: {distance:e}");
    }
    let folds = |branch: &Branch| -> Vec<f64> {
        let folds = branch.points.iter().filter(|p| p.event.is_some());
        folds.map(|p| p.values[0]).collect()
    };
    for (a, b) in folds(&direct).into_iter().zip(folds(&iterative)) {
        assert!((a - b).abs() < 1e-11, "{a} {b}");
    }
    // On the upper part, from the solution there; elsewhere from the library's own start.
    for (index, own) in [(3, true), (12, false)] {
        let (found, solved) = direct.solved(index).unwrap();
        assert_eq!(solved.report.outcome, Outcome::Converged);
        let period = solved.grid.period();
        assert!((TAU / period - direct.points[index].values[0]).abs() < 1e-14);
        let mut options = common::options(31);
        if !own {
            options.guess = InitialGuess::State(solved.state.clone());
        }
        let again = Solution::solve(&found, period, &options, &mut |_, _| true);
        let again = again.unwrap();
        let distance = again.details().state.distance(&solved.state, 1.0);
        assert!(distance < 1e-10, "{index}: {distance:e}");
        assert!(own || again.details().report.iterations.len() == 1);
    }
}

#[test]
fn a_load_is_followed_through_folds_too() {
    // At Ω = 1.2 the amplitude of the load goes up, down, and up again.
    let (mut model, amplitude) = duffing_with_load();
    model.set_parameter(amplitude, 0.05).unwrap();
    let options = BranchOptions {
        range: [0.05, 0.6],
        ..response(31)
    };
    let free = Free::Parameter(amplitude);
    let branch = follow_branch(&model, TAU / 1.2, free, &options, &mut |_, _| true).unwrap();
    assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
    let folds: Vec<f64> = branch
        .points
        .iter()
        .filter(|p| p.event.is_some())
        .map(|p| p.values[0])
        .collect();
    println!("{} points, folds at {folds:?}", branch.points.len());
    assert!(folds.len() == 2 && folds[0] > 0.18 && folds[1] < 0.18);
    // The model of a point has that load.
    let (found, _) = branch.solved(5).unwrap();
    assert_eq!(
        found.parameters()[amplitude].value,
        branch.points[5].values[0]
    );
}

#[test]
fn the_grid_grows_and_shrinks_along_a_branch() {
    let model = duffing();
    let mut options = response(7);
    options.periodic.grid_points = GridPoints::Adaptive(Adaptation {
        error_tolerance: 1e-7,
        ..Adaptation::default()
    });
    let branch = follow(&model, 0.9, &options);
    assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
    let counts: Vec<usize> = branch.points.iter().map(|p| p.grid.points()).collect();
    println!("{counts:?}");
    // It grows towards the resonance, and gets coarser beyond it.
    let most = *counts.iter().max().unwrap();
    assert!(most > counts[0] && *counts.last().unwrap() <= most * 3 / 4);
    let changes = counts.windows(2).filter(|pair| pair[1] < pair[0]).count();
    assert!(changes <= 2, "it flutters");
    let fold = branch.points.iter().find(|p| p.event.is_some()).unwrap();
    assert!((fold.values[0] - FOLDS[0][0]).abs() < 1e-7);
}

#[test]
fn a_branch_that_ends_early_keeps_its_points() {
    let model = duffing();
    let limited = BranchOptions {
        point_limit: 4,
        ..response(21)
    };
    let branch = follow(&model, 0.5, &limited);
    assert_eq!(
        (branch.end, branch.points.len()),
        (BranchEnd::PointLimit, 4)
    );
    // It goes downwards at once.
    let downwards = BranchOptions {
        downwards: true,
        ..response(21)
    };
    let branch = follow(&model, 0.7, &downwards);
    assert_eq!(branch.end, BranchEnd::Range);
    assert_eq!(branch.points.last().unwrap().values[0], 0.5);
    let cancelled = follow_branch(
        &model,
        TAU / 0.5,
        Free::Frequency,
        &response(21),
        &mut |n, _| n < 3,
    );
    let cancelled = cancelled.unwrap();
    assert_eq!(
        (cancelled.end, cancelled.points.len()),
        (BranchEnd::Cancelled, 3)
    );
    // Steps that are never short enough.
    let coarse = BranchOptions {
        angle: 1e-4,
        smallest_step: 0.01,
        ..response(21)
    };
    let branch = follow(&model, 0.5, &coarse);
    assert_eq!(branch.end, BranchEnd::SmallestStep);
    assert!(
        !branch.points.is_empty() && branch.explanation.contains("1.0e-2"),
        "{}",
        branch.explanation
    );
    // No solution to start from.
    let mut hopeless = response(21);
    hopeless.periodic.newton.iteration_limit = 1;
    let branch = follow(&model, 1.25, &hopeless);
    assert_eq!((branch.end, branch.points.len()), (BranchEnd::NoStart, 0));
    assert!(branch.solved(0).is_err());
}

#[test]
fn an_error_on_the_way_leaves_the_points_before() {
    // The user's law is none beyond some amplitude.
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    let law = CoordinateLaw {
        function: Arc::new(|state| match state.value.abs() < 1.0 {
            true => Ok(Effort {
                value: state.value + 0.05 * state.rate,
                by_coordinate: 1.0,
                by_rate: 0.05,
            }),
            false => Err(Error::new(ErrorKind::Callback, "too far")),
        }),
        gives_derivatives: true,
    };
    let force = model.add_coordinate_law(at, law).unwrap();
    model.declare_of_phase(force).unwrap();
    model.add_actuator(at, &cosine(0.18)).unwrap();
    let branch = follow(&model, 0.5, &response(11));
    assert_eq!(branch.end, BranchEnd::Failed);
    assert!(branch.points.len() > 3 && branch.explanation.contains("too far"));
    let last = branch.points.last().unwrap();
    assert!(
        last.values[0] > 0.8 && last.values[0] < 0.91,
        "{}",
        last.values[0]
    );
    // Before the first point there is nothing to keep.
    let none = follow_branch(
        &model,
        TAU / 0.95,
        Free::Frequency,
        &response(11),
        &mut |_, _| true,
    );
    assert_eq!(none.unwrap_err().kind(), ErrorKind::Callback);
}

/// The events of a branch.
fn events(branch: &Branch) -> Vec<(Event, f64)> {
    let points = branch.points.iter();
    let found = points.filter_map(|p| p.event.map(|event| (event, p.values[0])));
    found.collect()
}

#[test]
fn an_escape_oscillator_folds_and_doubles_its_period() {
    let (model, load) = escape_oscillator();
    let options = BranchOptions {
        range: [0.0, 0.105],
        motion_scale: 0.5,
        events: true,
        ..response(31)
    };
    let free = Free::Parameter(load);
    let branch = follow_branch(&model, TAU / 0.85, free, &options, &mut |_, _| true).unwrap();
    let found = events(&branch);
    println!(
        "{} points, {found:?}, {:?}",
        branch.points.len(),
        branch.end
    );
    let kinds: Vec<Event> = found.iter().map(|event| event.0).collect();
    assert_eq!(kinds, [Event::Fold, Event::Fold, Event::PeriodDoubling]);
    assert!((found[0].1 - 0.069).abs() < 1e-3 && (found[1].1 - 0.048).abs() < 1e-3);
    let off = found[2].1 - 0.100_501_010_278;
    println!("period doubling off by {off:e}");
    assert!(off.abs() < 2e-12);
    let doubles = |p: &BranchPoint| p.event == Some(Event::PeriodDoubling);
    let at = branch.points.iter().position(doubles).unwrap();
    let options = StabilityOptions {
        tolerance: 1e-11,
        ..StabilityOptions::default()
    };
    let stability = solve_stability(&branch.solved(at).unwrap().1, &options).unwrap();
    let [one, other] = &stability.multipliers[..] else {
        panic!("{stability:?}");
    };
    println!("multipliers {}, {}", one.value, other.value);
    assert!((one.value + 1.0).norm() < 1e-10);
    assert!((other.value + 0.4774965847545).norm() < 1e-10);
}

#[test]
fn a_doubled_branch_is_followed_from_where_it_begins() {
    let (model, load) = escape_oscillator();
    let options = BranchOptions {
        range: [0.0, 0.105],
        motion_scale: 0.5,
        events: true,
        ..response(31)
    };
    let (free, period) = (Free::Parameter(load), TAU / 0.85);
    let branch = follow_branch(&model, period, free, &options, &mut |_, _| true).unwrap();
    let is_doubling = |p: &BranchPoint| p.event == Some(Event::PeriodDoubling);
    let at = branch.points.iter().position(is_doubling).unwrap();
    let begins = branch.points[at].values[0];
    let away = [0.02, 0.04].map(|amplitude| {
        let limited = BranchOptions {
            point_limit: 5,
            events: false,
            ..options.clone()
        };
        let other = switch_branch(&branch, at, amplitude, &limited, &mut |_, _| true).unwrap();
        assert_eq!(other.end, BranchEnd::PointLimit, "{}", other.explanation);
        // Of twice the period, and towards larger loads.
        assert!((other.points[0].grid.period() / period - 2.0).abs() < 1e-12);
        assert_eq!(other.points[0].grid.points(), 61);
        assert!(other.points[4].values[0] > other.points[0].values[0]);
        // A solution on its own.
        let (found, solved) = other.solved(4).unwrap();
        let mut options = common::options(61);
        options.guess = InitialGuess::State(solved.state.clone());
        let again = Solution::solve(&found, 2.0 * period, &options, &mut |_, _| true).unwrap();
        assert!(again.details().state.distance(&solved.state, 1.0) < 1e-10);
        let x = |k: f64| {
            again
                .node(0, NodeQuantity::Position, &[k * period])
                .unwrap()[0]
        };
        assert!((x(0.0) - x(1.0)).abs() > 0.01 && (x(0.0) - x(2.0)).abs() < 1e-9);
        other.points[0].values[0] - begins
    });
    println!("{away:?}");
    assert!(away[0] > 0.0 && (away[1] / away[0] - 4.0).abs() < 0.1);
    // Nothing begins elsewhere.
    let end = switch_branch(&branch, 0, 0.02, &options, &mut |_, _| true);
    assert!(
        end.unwrap_err()
            .to_string()
            .contains("no other branch begins")
    );
}

#[test]
fn a_shaken_pendulum_loses_its_rest_where_mathieu_says() {
    // Of length 1 on a pivot at 0.5 cos 2t, under gravity g: a = g and q = 1.
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
    model.prescribe(at, &cosine(0.5)).unwrap();
    gravity(&mut model, [0.0, 0.0, 0.0]);
    let strength = model.add_parameter("gravity", 1.0, 1.0).unwrap();
    let target = Target::Signal(SignalPlace::Gravity(2), SignalPart::Mean);
    model.move_by_parameter(strength, target, -1.0).unwrap();
    let exact = [
        (Event::BranchPoint, -0.455_138_604_107),
        (Event::PeriodDoubling, -0.110_248_816_992),
        (Event::PeriodDoubling, 1.859_108_072_514),
    ];
    let mut found = Vec::new();
    for downwards in [true, false] {
        let options = BranchOptions {
            range: [-0.6, 2.2],
            downwards,
            events: true,
            largest_step: 0.05,
            ..response(15)
        };
        let free = Free::Parameter(strength);
        let branch = follow_branch(&model, TAU / 2.0, free, &options, &mut |_, _| true).unwrap();
        assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
        found.extend(events(&branch));
    }
    println!("{found:?}");
    found.sort_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(found.len(), exact.len());
    for ((event, value), (expected, exact)) in found.into_iter().zip(exact) {
        println!("{event:?} off by {:e}", value - exact);
        assert!(event == expected && (value - exact).abs() < 2e-12);
    }
}

#[test]
fn a_free_pendulum_is_followed_over_its_frequency() {
    // A point mass on a rod of length 1; periods by the arithmetic-geometric mean.
    let bob = Vector3::new(0.0, 0.0, -1.0);
    let inertia = nalgebra::Matrix3::zeros();
    let (mut model, _) = hinged_body(1.0, &bob, &inertia, &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let unfolding = model.add_parameter("unfolding", 0.0, 1.0).unwrap();
    model
        .move_by_parameter(unfolding, Target::MassDamping, 1.0)
        .unwrap();
    let (points, small) = (81, 0.5);
    let start = 9.81_f64.sqrt() * (1.0 - small * small / 16.0);
    let grid = TimeGrid::new(points, TAU / start).unwrap();
    let mut state = GridState::reference(&System::new(&model, TAU / start).unwrap(), grid);
    for (k, motion) in state.motions.iter_mut().enumerate() {
        let angle = small * (TAU * k as f64 / points as f64).cos();
        let turn = nalgebra::Rotation3::new(Vector3::y() * angle).into_inner();
        *motion = Motion::new(turn, turn * bob);
    }
    let mut options = BranchOptions {
        free: vec![Free::Parameter(unfolding)],
        conditions: vec![Arc::new(Phase)],
        range: [2.2, 3.1],
        downwards: true,
        ..response(points)
    };
    options.periodic.guess = InitialGuess::State(state);
    let branch = follow_branch(
        &model,
        TAU / start,
        Free::Frequency,
        &options,
        &mut |_, _| true,
    );
    let branch = branch.unwrap();
    assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
    assert!(branch.points.len() > 5);
    for point in &branch.points {
        assert!(point.values[1].abs() < 1e-10, "{:e}", point.values[1]);
        let lowest = point.state.node(0)[0].position;
        let amplitude = f64::atan2(lowest.x.hypot(lowest.y), -lowest.z);
        let (mut a, mut b) = (1.0, (amplitude / 2.0).cos());
        for _ in 0..8 {
            (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
        }
        let exact = 9.81_f64.sqrt() * a;
        println!("{amplitude:.3}: {:e}", point.values[0] - exact);
        assert!((point.values[0] - exact).abs() < 1e-9);
    }
}

#[test]
fn options_that_make_no_sense_are_refused() {
    let model = duffing();
    let refused = |start: f64, options: BranchOptions, why: &str| {
        let end = follow_branch(
            &model,
            TAU / start,
            Free::Frequency,
            &options,
            &mut |_, _| true,
        );
        let error = end.unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    };
    refused(0.4, response(21), "the frequency between 0.5 and 1.6");
    let with = |change: &dyn Fn(&mut BranchOptions)| {
        let mut options = response(21);
        change(&mut options);
        options
    };
    refused(1.0, with(&|o| o.range = [1.0, 0.5]), "options.range");
    refused(1.0, with(&|o| o.range[1] = f64::INFINITY), "options.range");
    refused(1.0, with(&|o| o.angle = 0.0), "options.angle");
    refused(1.0, with(&|o| o.first_step = 2.0), "options.first_step");
    refused(
        1.0,
        with(&|o| o.free = vec![Free::Parameter(0)]),
        "options.conditions",
    );
    refused(1.0, with(&|o| o.point_limit = 0), "options.point_limit");
}

#[test]
fn a_branch_that_comes_back_to_where_it_began_says_so() {
    // A pendulum becomes slower the farther it swings: from low frequencies it folds below that of
    // small swings, and comes back as a large one.
    let centre = Vector3::new(0.0, 0.0, -1.0);
    let (mut model, hinge) = hinged_body(1.0, &centre, &Matrix3::zeros(), &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let at = rotation1(hinge);
    spring(&mut model, at, 0.0, 0.3);
    model.add_actuator(at, &cosine(2.0)).unwrap();
    let natural = 9.81f64.sqrt();
    let options = BranchOptions {
        periodic: options(31),
        range: [0.8 * natural, 1.2 * natural],
        ..BranchOptions::default()
    };
    let branch = follow(&model, 0.8 * natural, &options);
    assert_eq!(branch.end, BranchEnd::Range);
    let values = || branch.points.iter().map(|point| point.values[0] / natural);
    assert!((values().next_back().unwrap() - 0.8).abs() < 1e-9);
    let most = values().fold(0.0, f64::max);
    assert!(most < 0.85, "{most}");
    let report = branch.report();
    assert!(
        report.contains("end of its range: it turned back at 2.6") && report.contains("3.758"),
        "{report}"
    );
    // Whatever it meets on its way to the other end.
    let other = follow(&duffing(), 0.5, &response(31)).report();
    assert!(other.contains("end of its range.\n"), "{other}");
}

#[test]
fn a_branch_is_reported_and_written() {
    let branch = follow(&duffing(), 0.9, &response(21));
    let report = branch.report();
    assert!(
        report.contains("along the frequency") && report.contains("fold at 1.269"),
        "{report}"
    );
    let path = std::env::temp_dir().join(format!("pdn_branch_{}.csv", std::process::id()));
    let position = Quantity::Node(0, NodeQuantity::Position);
    let effort = Quantity::Force(0, ForceQuantity::Effort);
    let outputs = [position.component(0), effort.into()];
    branch.write_csv(&path, &outputs).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let lines: Vec<Vec<&str>> = text.lines().map(|l| l.split(',').collect()).collect();
    assert_eq!(lines.len(), branch.points.len() + 1);
    let names = "frequency,period,slope,step,angle,grid_points,event,node0.position.x.mean,\
                 node0.position.x.harmonic1,node0.position.x.min,node0.position.x.max,\
                 force0.effort.mean,force0.effort.harmonic1,force0.effort.min,force0.effort.max";
    assert_eq!(lines[0], names.split(',').collect::<Vec<_>>());
    let fold = branch
        .points
        .iter()
        .position(|p| p.event.is_some())
        .unwrap();
    let row = &lines[fold + 1];
    assert_eq!(row[6], "fold");
    let size: f64 = row[8].parse().unwrap();
    assert!((size - first_harmonic(&branch, fold)).abs() < 1e-12);
    // Of the spring and the damper, not of the load.
    let [most, position] = [14, 10].map(|i| row[i].parse::<f64>().unwrap());
    let spring = position + 0.1 * position.powi(3);
    assert!((most / spring - 1.0).abs() < 1e-3, "{most} {spring}");
    let none = Quantity::Node(7, NodeQuantity::Position);
    assert!(branch.write_csv(&path, &[none.into()]).is_err());
    assert!(!path.exists());
}
