//! Adaptive grids: the tolerance is met without naming a grid, and the estimate is honest.

#[path = "../common/mod.rs"]
mod common;
mod examples;

use common::*;
use examples::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::DecayKind;
use periodyn::elements::{Coordinate, CoordinateLaw, Effort, JointKind};
use periodyn::fourier::{FilterKind, SpectralFilter};
use periodyn::model::{JointCoordinate, Model};
use periodyn::output::{BeamQuantity, JointQuantity, NodeQuantity, Quantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Points of the reference, whose own error is below 5e-12 on all smooth examples.
const REFERENCE: usize = 81;

fn adaptive(example: &Example, error_tolerance: f64, largest: usize) -> Solution {
    let options = PeriodicOptions {
        grid_points: GridPoints::Adaptive(Adaptation {
            error_tolerance,
            largest,
            ..Adaptation::default()
        }),
        ..PeriodicOptions::default()
    };
    Solution::solve(&example.model, example.period, &options, &mut |_, _| true).unwrap()
}

/// Error of the motions at all points of the grid of `exact`, in the measure of the estimate.
fn true_error(solution: &Solution, exact: &Solution) -> f64 {
    let system = &exact.details().system;
    let there = solution.prolonged(exact.grid()).unwrap();
    there.distance(&exact.details().state, system.scales().length)
}

/// Errors of velocities, accelerations and multipliers of constraints, each relative to the largest
/// of its kind: the estimate does not cover these derivatives, and the table shows how much larger
/// they are.
fn derived_errors(solution: &Solution, exact: &Solution) -> [f64; 3] {
    let times: Vec<f64> = exact.grid().times().collect();
    let nodes = exact.model().node_count();
    let relative = |quantity: NodeQuantity| {
        let (mut difference, mut size) = (0.0f64, 0.0f64);
        for node in 0..nodes {
            let at = |s: &Solution| s.node(node, quantity, &times).unwrap();
            let reference = at(exact);
            difference = difference.max(largest_difference(&at(solution), &reference));
            size = size.max(largest(reference));
        }
        difference / size
    };
    let there = solution.prolonged(exact.grid()).unwrap().multipliers;
    let reference = &exact.details().state.multipliers;
    [
        relative(NodeQuantity::Velocity),
        relative(NodeQuantity::Acceleration),
        largest_difference(&there, reference)
            / largest(reference.iter().copied()).max(f64::MIN_POSITIVE),
    ]
}

/// A plane crank and rocker of rigid bars, driven once a period of a second.
fn crank_and_rocker() -> Model {
    let mut model = Model::new();
    let z = Vector3::z();
    let corners = [(0.0, 0.0), (0.0, 0.12), (0.3, 0.24), (0.3, 0.0)];
    let corners = corners.map(|(x, y)| Vector3::new(x, y, 0.0));
    let mut bodies = vec![None];
    for pair in corners.windows(2) {
        let (middle, ball) = ((pair[0] + pair[1]) / 2.0, Matrix3::identity() * 2e-3);
        bodies.push(Some(model.add_rigid_body(0.4, &middle, &ball).unwrap()));
    }
    bodies.push(None);
    let mut joints = Vec::new();
    for (corner, pair) in corners.iter().zip(bodies.windows(2)) {
        let frame = Model::frame_at("axis", corner, &z).unwrap();
        let joint = model.add_joint(JointKind::Revolute, pair[0], pair[1], &frame, &frame);
        joints.push(joint.unwrap());
    }
    let at = JointCoordinate {
        joint: joints[0],
        coordinate: Coordinate::Rotation1,
    };
    let turn = steady(TAU);
    model.prescribe(at, &turn).unwrap();
    model
}

#[test]
fn motions_that_are_prescribed_take_one_grid_which_the_start_tells() {
    let model = crank_and_rocker();
    for tolerance in [1e-4, 1e-6, 1e-7] {
        let options = PeriodicOptions::with_error_tolerance(tolerance);
        let found = Solution::solve(&model, 1.0, &options, &mut |_, _| true).unwrap();
        assert_eq!(found.outcome(), Outcome::Converged);
        let grids = &found.details().periodic().unwrap().grids;
        let exact = solve(&model, 1.0, 121);
        let error = true_error(&found, &exact);
        println!("{tolerance:e}: {error:e} {grids:?}");
        assert!(error < tolerance, "{error:e}");
        assert_eq!(grids.len(), 1, "{grids:?}");
        // Not by a grid that is much too fine.
        assert!(grids[0].error_estimate > 1e-3 * tolerance, "{grids:?}");
    }
}

#[test]
fn the_tolerance_is_met_and_the_estimate_honest_on_all_smooth_examples() {
    let tolerance = 1e-8;
    println!(
        "{:24} {:>5} {:>9} {:>9} {:>7}",
        "", "N", "estimate", "error", "ratio"
    );
    let mut failures = Vec::new();
    for example in smooth() {
        let exact = solve(&example.model, example.period, REFERENCE);
        let found = adaptive(&example, tolerance, 255);
        assert_eq!(found.outcome(), Outcome::Converged, "{}", found.report());
        let grids = &found.details().periodic().unwrap().grids;
        // Each grid alone, and as one of the sequence.
        for tried in grids {
            let alone = solve(&example.model, example.period, tried.points);
            let error = true_error(&alone, &exact);
            let own = alone.diagnostics().error_estimate;
            let [velocity, acceleration, force] = derived_errors(&alone, &exact);
            let [ratio, ratio_alone] = [tried.error_estimate, own].map(|x| x / error);
            println!(
                "{:24} {:5} {:9.1e} {error:9.1e} {ratio:7.2} {ratio_alone:7.2} {:3}   \
                 {velocity:9.1e} {acceleration:9.1e} {force:9.1e}",
                example.name, tried.points, tried.error_estimate, tried.iterations
            );
            // On grids that leave beams unresolved, stresses of stretching that relieve themselves
            // count as loads: 39 measured.
            let most = if error > 1e-5 { 50.0 } else { 10.0 };
            // The ratio of two roundings, a thousand times those of numbers, tells nothing.
            let is_rounding = error.max(own).max(tried.error_estimate) < 1e3 * f64::EPSILON;
            let is_honest = |ratio: f64| is_rounding || (0.3..most).contains(&ratio);
            if !is_honest(ratio) || !is_honest(ratio_alone) {
                failures.push(format!("{} N = {}", example.name, tried.points));
            }
        }
        let error = true_error(&found, &exact);
        if error > tolerance {
            failures.push(format!("{}: {error:e}", example.name));
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn what_a_users_force_hides_between_points_is_found() {
    // On the first grid, of 11 points, this harmonic is a constant.
    let (mass, stiffness, damping, period, harmonic) = (2.0, 5e3, 3.0, 2.0, 44.0);
    let omega = harmonic * TAU / period;
    let (mut model, at) = mass_on_a_slide(mass, &Vector3::z());
    spring(&mut model, at, stiffness, damping);
    let law = CoordinateLaw {
        function: Arc::new(move |at| {
            Ok(Effort {
                value: -1e4 * (omega * at.time).cos(),
                ..Effort::default()
            })
        }),
        gives_derivatives: false,
    };
    model.add_coordinate_law(at, law).unwrap();
    let example = Example {
        name: "hidden",
        model,
        period,
    };
    let found = adaptive(&example, 1e-8, 255);
    println!("{}", found.report());
    assert_eq!(found.outcome(), Outcome::Converged);
    // (k − m ω² + i c ω) u = F
    let (real, imaginary) = (stiffness - mass * omega * omega, damping * omega);
    let exact = 1e4 * real / (real * real + imaginary * imaginary);
    let slide = JointQuantity::Coordinate(Coordinate::Displacement1);
    let start = found.joint(0, slide, &[0.0]).unwrap()[0];
    assert!(
        exact.abs() > 1e-2 && (start - exact).abs() < 1e-8,
        "{start} {exact}"
    );
}

#[test]
fn rounding_ends_the_adaptation() {
    for example in [
        rigid_slider_crank(120.0),
        scotch_yoke(),
        forced_cantilever(),
    ] {
        let found = adaptive(&example, 1e-17, 2001);
        println!("{}", found.report());
        assert_eq!(found.outcome(), Outcome::ToleranceNotMet);
        assert_eq!(found.diagnostics().decay, DecayKind::Rounding);
        assert!(found.grid().points() < 150);
        assert!(found.diagnostics().error_estimate < 1e-13);
        let explanation = &found.details().report.explanation;
        assert!(explanation.contains("rounding"), "{explanation}");
    }
}

#[test]
fn narrow_peaks_end_at_the_largest_grid_and_are_named() {
    let example = planar_four_bar();
    let found = adaptive(&example, 1e-6, 81);
    println!("{}", found.report());
    assert_eq!(found.outcome(), Outcome::ToleranceNotMet);
    assert_eq!(found.grid().points(), 81);
    let explanation = &found.details().report.explanation;
    for words in ["81 grid points", "1.0e-6", "no more than 81", "narrow peak"] {
        assert!(explanation.contains(words), "no {words} in: {explanation}");
    }
    let diagnostics = found.diagnostics();
    assert_eq!(diagnostics.decay, DecayKind::Slow);
    // All bars lie in a line at T/4 and 3T/4.
    let turn = diagnostics.least_resolved_time / example.period;
    assert!((turn % 0.5 - 0.25).abs() < 0.02, "{turn}");
    assert!(diagnostics.error_estimate > 1e-4 && diagnostics.error_estimate < 0.3);
}

/// How much a curve oscillates as the highest harmonics do, away from the two peaks: a smooth curve
/// by about the square of that wave's length.
fn ringing(force: &[f64], wave: usize) -> f64 {
    let count = force.len();
    largest((0..count).filter_map(|i| {
        let turn = i as f64 / count as f64;
        let away = (turn - 0.25).abs() > 0.08 && (turn - 0.75).abs() > 0.08;
        let [before, after] = [i + count - wave / 2, i + wave / 2].map(|k| force[k % count]);
        away.then(|| 0.5 * (force[i] - 0.5 * (before + after)))
    }))
}

#[test]
fn a_filter_takes_the_ringing_of_a_peak_away() {
    let example = planar_four_bar();
    let solution = solve(&example.model, example.period, 101);
    let count = 2000;
    let times: Vec<f64> = (0..count)
        .map(|i| example.period * i as f64 / count as f64)
        .collect();
    let force = |s: &Solution| column(&s.beam(2, 0.0, BeamQuantity::Force, &times).unwrap(), 6, 0);
    let plain = force(&solution);
    let (peak, rings) = (largest(plain.iter().copied()), ringing(&plain, count / 50));
    println!("unfiltered: peak {peak:.0} N, oscillation away from it {rings:.1} N");
    for (kind, order, reduction) in [
        (FilterKind::Lanczos, 1, 20.0),
        (FilterKind::Lanczos, 3, 200.0),
        (FilterKind::Exponential, 2, 30.0),
        (FilterKind::Exponential, 4, 30.0),
        (FilterKind::Exponential, 8, 8.0),
    ] {
        let filter = SpectralFilter::new(kind, order).unwrap();
        let filtered = force(&solution.filtered(filter).unwrap());
        let (low, left) = (
            largest(filtered.iter().copied()),
            ringing(&filtered, count / 50),
        );
        println!("{kind:?} {order}: peak {low:.0} N, oscillation {left:.2} N");
        assert!(left < rings / reduction, "{kind:?} {order}");
    }
}

#[test]
fn filtered_motions_are_motions_and_resolved_ones_stay() {
    let example = swinging();
    let solution = solve(&example.model, example.period, 81);
    let filter = SpectralFilter::new(FilterKind::Lanczos, 2).unwrap();
    let filtered = solution.filtered(filter).unwrap();
    let h = 1e-5;
    for time in [0.1, 0.77, 1.3] {
        let times = [time - h, time, time + h];
        let get = |quantity| filtered.node(1, quantity, &times).unwrap();
        let rotations = get(NodeQuantity::RotationMatrix);
        let rotation = Matrix3::from_column_slice(&rotations[9..18]);
        assert!((rotation.tr_mul(&rotation) - Matrix3::identity()).amax() < 1e-14);
        let (positions, velocities) = (get(NodeQuantity::Position), get(NodeQuantity::Velocity));
        for i in 0..3 {
            let slope = (positions[6 + i] - positions[i]) / (2.0 * h);
            assert!((slope - velocities[6 + i]).abs() < 1e-7);
        }
    }
    // Harmonics are those of what is sampled: the motion is resolved well before the last.
    let grid: Vec<f64> = solution.grid().times().collect();
    let velocity = filtered
        .series(Quantity::Node(1, NodeQuantity::Velocity))
        .unwrap();
    let sampled = filtered.node(1, NodeQuantity::Velocity, &grid).unwrap();
    for (k, time) in grid.iter().enumerate() {
        assert!((velocity[0].value(*time) - sampled[6 * k]).abs() < 1e-11);
    }
    // An exponential filter of high order spares the low harmonics; Lanczos' does not.
    let times = times(example.period, 101);
    let position = |s: &Solution| s.node(1, NodeQuantity::Position, &times).unwrap();
    let high = SpectralFilter::new(FilterKind::Exponential, 16).unwrap();
    let exact = position(&solution);
    let kept = largest_difference(&position(&solution.filtered(high).unwrap()), &exact);
    let smoothed = largest_difference(&position(&filtered), &exact);
    println!("moved by the exponential filter {kept:.1e}, by that of Lanczos {smoothed:.1e}");
    assert!(kept < 1e-9 && smoothed > 1e-4);
    // Neither estimates nor what starts from it are touched; a file keeps the filter.
    assert_eq!(filtered.diagnostics(), solution.diagnostics());
    assert_eq!(
        filtered.prolonged(solution.grid()).unwrap(),
        solution.prolonged(solution.grid()).unwrap()
    );
    let file = std::env::temp_dir().join(format!("periodyn-filtered-{}.pdn", std::process::id()));
    filtered.save(&file).unwrap();
    let loaded = Solution::load(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    assert_eq!(position(&loaded), position(&filtered));
}

#[test]
fn oversampled_equations_meet_the_tolerance_too() {
    for example in [
        swinging(),
        four_bar(false),
        duffing(),
        flexible_slider_crank(),
    ] {
        let exact = solve(&example.model, example.period, REFERENCE);
        let options = PeriodicOptions {
            oversampling: 2,
            ..PeriodicOptions::with_error_tolerance(1e-6)
        };
        let solution =
            Solution::solve(&example.model, example.period, &options, &mut |_, _| true).unwrap();
        let estimate = solution.diagnostics().error_estimate;
        let error = true_error(&solution, &exact);
        let grids: Vec<usize> = grids_tried(&solution);
        println!(
            "{}: {grids:?}, error {error:.1e}, estimate {estimate:.1e}",
            example.name
        );
        assert_eq!(solution.outcome(), Outcome::Converged, "{}", example.name);
        assert!(error < 1e-6 && error < 10.0 * estimate, "{}", example.name);
    }
}
