//! Branches that come back to their first point, and what multipliers say along them.

mod common;

use common::models::oscillators::*;
use common::*;
use nalgebra::Vector3;
use periodyn::collocation::GridState;
use periodyn::fourier::TimeGrid;
use periodyn::model::Model;
use periodyn::solve::{
    Branch, BranchEnd, BranchOptions, Event, Free, InitialGuess, StabilityOptions, Verdict,
    follow_branch,
};
use periodyn::system::System;
use std::f64::consts::{PI, TAU};

fn follow(model: &Model, period: f64, free: Free, options: &BranchOptions) -> Branch {
    follow_branch(model, period, free, options, &mut |_, _| true).unwrap()
}

/// Values of the parameter at the points with an event.
fn events(branch: &Branch) -> Vec<(Event, f64)> {
    let points = branch.points.iter();
    let found = points.filter_map(|p| p.event.map(|event| (event, p.values[0])));
    found.collect()
}

#[test]
fn a_pendulum_that_a_torque_turns_over_comes_back() {
    let (model, torque) = pendulum_under_torque();
    let options = BranchOptions {
        periodic: options(3),
        range: [-12.0, 12.0],
        stability: Some(StabilityOptions::default()),
        ..BranchOptions::default()
    };
    let period = 0.7;
    let branch = follow(&model, period, Free::Parameter(torque), &options);
    assert_eq!(branch.end, BranchEnd::Closed, "{}", branch.explanation);
    let found = events(&branch);
    println!("{} points, {found:?}", branch.points.len());
    assert_eq!(found.len(), 2);
    for ((event, value), exact) in found.into_iter().zip([9.81, -9.81]) {
        assert!(
            event == Event::Fold && (value - exact).abs() < 1e-11,
            "{value}"
        );
    }
    // The last point is the first one.
    let [first, last] = [0, branch.points.len() - 1].map(|i| &branch.points[i]);
    assert!((first.values[0] - last.values[0]).abs() < 1e-6);
    assert!(first.state.distance(&last.state, 1.0) < 1e-6);
    // Once around, in one direction.
    let mut turned = 0.0;
    let angle = |state: &GridState| {
        let at = state.node(0)[0].position;
        f64::atan2(-at.x, -at.z)
    };
    for pair in branch.points.windows(2) {
        let step = angle(&pair[1].state) - angle(&pair[0].state);
        let step = (step + PI).rem_euclid(TAU) - PI;
        assert!(step >= 0.0, "{step}");
        turned += step;
    }
    assert!((turned - TAU).abs() < 1e-6, "{turned}");
    // Exponents are roots of s² + 0.5 s + 9.81 cos θ.
    for point in branch.points.iter().filter(|p| p.event.is_none()) {
        let stiffness = 9.81 * angle(&point.state).cos();
        let root = 0.0625 - stiffness;
        let exponent = if root > 0.0 { root.sqrt() } else { 0.0 } - 0.25;
        let found = point.stability.unwrap();
        let off = found.largest - (exponent * period).exp();
        assert!(off.abs() < 1e-8, "{stiffness}: {off:e}");
        let stable = stiffness > 0.0;
        let verdict = match stable {
            true => Verdict::Stable,
            false => Verdict::Unstable,
        };
        let outside = usize::from(!stable);
        assert_eq!((found.verdict, found.outside), (verdict, outside));
    }
}

#[test]
fn what_multipliers_say_is_reported_and_written() {
    let (model, torque) = pendulum_under_torque();
    let options = BranchOptions {
        periodic: options(3),
        range: [-12.0, 12.0],
        stability: Some(StabilityOptions::default()),
        ..BranchOptions::default()
    };
    let branch = follow(&model, 0.7, Free::Parameter(torque), &options);
    let path = std::env::temp_dir().join(format!("pdn_closed_{}.csv", std::process::id()));
    branch.write_csv(&path, &[]).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let lines: Vec<Vec<&str>> = text.lines().map(|l| l.split(',').collect()).collect();
    let names = "torque,period,slope,step,angle,grid_points,event,stability,outside,\
                 largest_multiplier";
    assert_eq!(lines[0], names.split(',').collect::<Vec<_>>());
    for (line, point) in lines[1..].iter().zip(&branch.points) {
        let found = point.stability.unwrap();
        assert_eq!(line[7], found.verdict.describe());
        assert_eq!(line[8], found.outside.to_string());
        assert_eq!(line[9].parse::<f64>().unwrap(), found.largest);
    }
    let count = |verdict: &str| lines.iter().filter(|line| line[7] == verdict).count();
    let told = format!(
        "points: {} stable, {} unstable",
        count("stable"),
        count("unstable")
    );
    assert!(branch.report().contains(&told), "{}", branch.report());
}

/// Damping of the oscillator with an isolated response, and its load.
const DAMPING: f64 = 0.1;
const LOAD: f64 = 0.03;

/// `0.1 (A − 1.2 A³ + 0.45 A⁵)` with `A = Ω a`: what damping takes of the load at the amplitude
/// `a`, by the first harmonic.
fn damping(speed: f64) -> f64 {
    DAMPING * (speed - 1.2 * speed.powi(3) + 0.45 * speed.powi(5))
}

/// An oscillator that is damped less at some velocities than at lower and higher ones: near its
/// resonance there are three responses, of which two are on a curve of their own.
fn isolated() -> Model {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    let rates = [DAMPING, 0.0, -1.6 * DAMPING, 0.0, 0.72 * DAMPING];
    model
        .add_polynomial_spring_damper(at, &[1.0], &rates, 0.0)
        .unwrap();
    model.add_actuator(at, &cosine(LOAD)).unwrap();
    model
}

#[test]
fn an_isolated_response_curve_is_followed_once_around() {
    let model = isolated();
    let points = 21;
    let mut options = BranchOptions {
        periodic: options(points),
        range: [0.5, 1.5],
        motion_scale: 0.5,
        stability: Some(StabilityOptions::default()),
        ..BranchOptions::default()
    };
    // The branch from rest knows nothing of it.
    let low = follow(&model, TAU / 0.5, Free::Frequency, &options);
    assert_eq!(low.end, BranchEnd::Range);
    assert!(events(&low).is_empty());
    // At resonance, where load and velocity are in phase.
    let grid = TimeGrid::new(points, TAU).unwrap();
    let mut state = GridState::reference(&System::new(&model, TAU).unwrap(), grid);
    let speed = (0..60).fold([1.1145, 2.0], |[low, high], _| {
        let middle = 0.5 * (low + high);
        match damping(middle) < LOAD {
            true => [middle, high],
            false => [low, middle],
        }
    })[0];
    for (k, motion) in state.motions.iter_mut().enumerate() {
        motion.position.x = speed * (TAU * k as f64 / points as f64).sin();
    }
    options.periodic.guess = InitialGuess::State(state);
    let branch = follow(&model, TAU, Free::Frequency, &options);
    assert_eq!(branch.end, BranchEnd::Closed, "{}", branch.explanation);
    let found = events(&branch);
    println!("{} points, {found:?}", branch.points.len());
    assert_eq!(found.len(), 2);
    assert!(found[0].1 > 1.0 && found[1].1 < 1.0);
    // With one harmonic the curve ends where load is all that damping and detuning leave.
    let reach = |sign: f64| {
        let inside = |frequency: f64| {
            (0..2000).any(|i| {
                let amplitude = (0.6 + i as f64 * 5e-4) / frequency;
                let detuned = (1.0 - frequency * frequency) * amplitude;
                detuned.hypot(damping(frequency * amplitude)) < LOAD
            })
        };
        let mut beside = 0.0;
        while inside(1.0 + sign * (beside + 1e-6)) {
            beside += 1e-6;
        }
        1.0 + sign * beside
    };
    for ((event, value), sign) in found.into_iter().zip([1.0, -1.0]) {
        println!("fold {value}, with one harmonic {}", reach(sign));
        assert!(event == Event::Fold && (value - reach(sign)).abs() < 2e-4);
    }
    // Its upper part is stable and its lower one is not.
    for point in branch.points.iter().filter(|p| p.slope.abs() > 0.05) {
        let largest = point.state.node(0).iter().map(|m| m.position.x);
        let amplitude = largest.fold(0.0, f64::max);
        if (amplitude - 1.1145).abs() > 0.05 && (point.values[0] - 1.0).abs() < 0.01 {
            let upper = amplitude > 1.1145;
            let outside = point.stability.unwrap().outside;
            assert_eq!(outside, usize::from(!upper), "{amplitude}");
        }
    }
}
