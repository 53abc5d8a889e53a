//! What is told of periodic motions with shells besides these: multipliers against small motions,
//! sensitivities against differences, folds of a branch against those of a beam.

mod common;

use common::models::shells::*;
use common::{clamp, cosine, damped_section, options};
use nalgebra::Vector3;
use periodyn::collocation::GridState;
use periodyn::elements::{IsotropicShell, LoadFrame, ShellLoadPlace, ShellPoint, ShellSide};
use periodyn::model::*;
use periodyn::output::{Modes, NodeQuantity, Quantity, Solution};
use periodyn::quantity::{Feature, ShellQuantity};
use periodyn::solve::*;
use std::f64::consts::TAU;

const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.1;
/// Nodes along the strip, which is one element, and across it. Two across would sag between them.
const NODES: usize = 5;
const ACROSS: usize = 3;
/// Time of damping: half a percent of the first natural frequency's critical damping.
const DAMPING: f64 = 2e-4;

/// Rubber without contraction, damped less.
fn strip_section() -> IsotropicShell {
    let [thickness, young, density, _] = RUBBER;
    IsotropicShell {
        damping_time: DAMPING,
        ..IsotropicShell::new(thickness, young, 0.0, density)
    }
}

/// A strip that is clamped at both ends.
fn clamped_strip() -> Model {
    let mut model = Model::new();
    let mesh = mesh([1, 1], [NODES, ACROSS]);
    let section = strip_section().section().unwrap();
    let patch = add_strip(&mut model, [LENGTH, WIDTH], &section, &mesh);
    for edge in [PatchEdge::StartU, PatchEdge::EndU] {
        clamp_edge(&mut model, &patch.edge(edge));
    }
    model
}

/// Shakes all across the strip.
fn shake(model: &mut Model, acceleration: f64) {
    let constant = |g| Signal::constant(g).unwrap();
    model.set_gravity([constant(0.0), constant(0.0), cosine(acceleration)]);
}

/// The same strip shaken, and a node in its middle.
fn shaken_strip(acceleration: f64) -> (Model, usize) {
    let mut model = clamped_strip();
    shake(&mut model, acceleration);
    (model, ACROSS * (NODES / 2))
}

/// The same as a beam.
fn shaken_beam(acceleration: f64) -> (Model, usize) {
    let [thickness, young, density, _] = RUBBER;
    let (area, moment) = (WIDTH * thickness, WIDTH * thickness.powi(3) / 12.0);
    let (bending, shear) = (young * moment, 5.0 / 12.0 * young * area);
    let stiffness = [young * area, shear, shear, bending, bending, 25.0 * bending];
    let inertia = density * moment;
    let mass = [density * area, inertia, inertia, inertia];
    let section = damped_section(&stiffness, &mass, DAMPING);
    let mut model = Model::new();
    let (root, tip) = (Vector3::zeros(), Vector3::x() * LENGTH);
    let beam = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &section, 1, NODES - 1)
        .unwrap();
    clamp(&mut model, beam.first_node);
    clamp(&mut model, beam.last_node);
    shake(&mut model, acceleration);
    let middle = beam.first_node + NODES / 2;
    (model, middle)
}

/// Size of the first harmonic of a node's height.
fn first_harmonic(state: &GridState, node: usize) -> f64 {
    let count = state.points() as f64;
    let sum = |f: fn(f64) -> f64| {
        let all = state.node(node).iter().enumerate();
        let terms = all.map(|(k, m)| m.position.z * f(TAU * k as f64 / count));
        2.0 / count * terms.sum::<f64>()
    };
    sum(f64::cos).hypot(sum(f64::sin))
}

#[test]
fn a_stretched_strip_folds_where_the_beam_does() {
    let folds = |(model, middle): (Model, usize)| -> Vec<[f64; 2]> {
        let options = BranchOptions {
            periodic: options(7),
            range: [53.0, 60.0],
            motion_scale: 0.1,
            ..BranchOptions::default()
        };
        let frequency = Free::Frequency;
        let branch = follow_branch(
            &model,
            TAU / options.range[0],
            frequency,
            &options,
            &mut |_, _| true,
        )
        .unwrap();
        assert_eq!(branch.end, BranchEnd::Range, "{}", branch.explanation);
        let points = branch.points.iter();
        let folds = points.filter(|point| point.event == Some(Event::Fold));
        folds
            .map(|point| [point.values[0], first_harmonic(&point.state, middle)])
            .collect()
    };
    let (strip, beam) = (folds(shaken_strip(0.3)), folds(shaken_beam(0.3)));
    println!("{strip:?} {beam:?}");
    assert_eq!(strip.len(), 2);
    assert_eq!(beam.len(), 2);
    for (strip, beam) in strip.iter().zip(&beam) {
        // Both are located to rounding.
        for (a, b) in strip.iter().zip(beam) {
            assert!((a - b).abs() < 1e-8 * b, "{a} {b}");
        }
    }
}

#[test]
fn multipliers_at_rest_are_those_of_small_motions() {
    let period = TAU / 40.0;
    let analysed = |model: &Model, points: usize| {
        let solution = Solution::solve(model, period, &options(points), &mut |_, _| true).unwrap();
        assert_eq!(
            solution.outcome(),
            Outcome::Converged,
            "{}",
            solution.report()
        );
        let options = StabilityOptions {
            highest_frequency: Some(400.0),
            ..StabilityOptions::default()
        };
        let stability = solution.solve_stability(&options).unwrap();
        assert_eq!(stability.outcome, Outcome::Converged);
        assert_eq!(stability.verdict, Verdict::Stable);
        stability
    };
    // At rest: `ρ = exp(sT)` of the modes.
    let model = clamped_strip();
    let stability = analysed(&model, 3);
    let modes = ModesOptions {
        count: 4,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &modes, &mut |_, _| true).unwrap();
    assert_eq!(modes.outcome(), Outcome::Converged);
    for mode in modes.modes() {
        let expected = (mode.eigenvalue * period).exp();
        let expected = if expected.im < 0.0 {
            expected.conj()
        } else {
            expected
        };
        let all = stability.multipliers.iter();
        let off = all
            .map(|m| (m.value - expected).norm())
            .fold(f64::INFINITY, f64::min);
        println!("{}: off by {off:e}", mode.eigenvalue);
        // The tolerance of the stability analysis.
        assert!(off < 1e-7, "{}: {off:e}", mode.eigenvalue);
    }
}

/// A plate that flaps, with a pressure that follows it, and what parameters move in it.
fn plate_with_parameters() -> (Model, f64, Vec<usize>, usize) {
    let (mut model, period) = flapping_plate(0.4, [2, 1], 3);
    model
        .add_shell_load(ShellLoadDefinition {
            first_element: 0,
            elements: 2,
            place: ShellLoadPlace::Surface,
            frame: LoadFrame::Follower,
            components: [None, None, Some(cosine(3.0)), None, None, None],
        })
        .unwrap();
    let both = |target: fn(usize) -> Target| vec![target(0), target(1)];
    let amplitude = |place| vec![Target::Signal(place, SignalPart::Amplitude)];
    let moved = [
        ("modulus", 1.0, both(Target::ShellStiffness)),
        ("density", 1.0, both(Target::ShellMass)),
        ("damping", 1.0, both(Target::ShellDamping)),
        ("thickness", 1.0, both(Target::ShellThickness)),
        ("pressure", 1.0, amplitude(SignalPlace::ShellLoad(0, 2))),
        ("swing", 1.0, amplitude(SignalPlace::Prescribed(0))),
    ];
    let mut parameters = Vec::new();
    for (name, value, targets) in moved {
        let parameter = model.add_parameter(name, value, value).unwrap();
        for target in targets {
            model.move_by_parameter(parameter, target, 1.0).unwrap();
        }
        parameters.push(parameter);
    }
    let tip = model.node_count() - 2;
    (model, period, parameters, tip)
}

#[test]
fn sensitivities_to_shells_and_their_loads_are_differences_of_solves() {
    let (model, period, parameters, tip) = plate_with_parameters();
    let solved = |model: &Model| {
        let mut options = options(13);
        options.newton.tolerance = 1e-11;
        let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
        let report = solution.report();
        assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
        solution
    };
    let solution = solved(&model);
    let height = Quantity::Node(tip, NodeQuantity::Position).component(2);
    let dependents = [
        Dependent::Feature(height, Feature::Mean),
        Dependent::Feature(height, Feature::Cosine(1)),
        Dependent::Feature(height, Feature::Sine(1)),
    ];
    let values = |solution: &Solution| {
        let series = solution.series(height).unwrap().remove(0);
        [series.mean, series.cosines[0], series.sines[0]]
    };
    let all: Vec<Free> = parameters.iter().map(|&p| Free::Parameter(p)).collect();
    let of = |method| {
        let options = SensitivityOptions {
            method,
            ..SensitivityOptions::default()
        };
        let solve = (&model, solution.details());
        solve_sensitivities(solve, (&[], &[]), &dependents, &all, &options).unwrap()
    };
    let direct = of(SensitivityMethod::Direct);
    let adjoint = of(SensitivityMethod::Adjoint);
    for (j, &parameter) in parameters.iter().enumerate() {
        let step = 5e-3;
        let at = |n: f64| {
            let mut beside = model.clone();
            let value = beside.parameters()[parameter].value + n * step;
            beside.set_parameter(parameter, value).unwrap();
            values(&solved(&beside))
        };
        let [a, b, c, d] = [at(1.0), at(-1.0), at(2.0), at(-2.0)];
        let column: Vec<f64> = (0..3).map(|i| direct.derivatives[(i, j)]).collect();
        let size = column.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        assert!(size > 1e-4, "parameter {parameter} moves nothing: {size:e}");
        for i in 0..3 {
            let difference = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * step);
            let off = (column[i] - difference).abs() / size;
            let apart = (column[i] - adjoint.derivatives[(i, j)]).abs() / size;
            println!(
                "{i} by {parameter}: {:e}, off {off:e}, {apart:e}",
                column[i]
            );
            // Fourth-order differences leave the fourth power of the step, about.
            assert!(
                off < 1e-6 && apart < 1e-9,
                "{i} by {parameter}: {off:e} {apart:e}"
            );
        }
    }
}

#[test]
fn sensitivities_to_thickness_are_differences_of_solves() {
    let (mut model, period) = flapping_plate(0.4, [2, 1], 3);
    let thickness = model.add_parameter("thickness", 1.1, 1.0).unwrap();
    for element in 0..2 {
        let target = Target::ShellThickness(element);
        model.move_by_parameter(thickness, target, 1.0).unwrap();
    }
    let solved = |model: &Model| {
        let mut options = options(11);
        options.newton.tolerance = 1e-12;
        let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
        let report = solution.report();
        assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
        solution
    };
    let point = ShellPoint::new([-0.5, 0.2]);
    let height = Quantity::Node(model.node_count() - 2, NodeQuantity::Position).component(2);
    let of_shell = |quantity: ShellQuantity| Quantity::Shell {
        element: 0,
        point,
        quantity,
    };
    let bending = of_shell(ShellQuantity::Resultant).component(4);
    // It depends on the thickness by itself, too.
    let stress = of_shell(ShellQuantity::SurfaceStress(ShellSide::Top)).component(0);
    let all = [height, bending, stress];
    let dependents = all.map(|of| Dependent::Feature(of, Feature::Cosine(1)));
    let values =
        |solution: &Solution| all.map(|of| solution.series(of).unwrap().remove(0).cosines[0]);
    let solution = solved(&model);
    let step = 1e-3;
    let at = |n: f64| {
        let mut beside = model.clone();
        beside.set_parameter(thickness, 1.1 + n * step).unwrap();
        values(&solved(&beside))
    };
    let [a, b, c, d] = [at(1.0), at(-1.0), at(2.0), at(-2.0)];
    let free = [Free::Parameter(thickness)];
    for method in [SensitivityMethod::Direct, SensitivityMethod::Adjoint] {
        let options = SensitivityOptions {
            method,
            ..SensitivityOptions::default()
        };
        let solve = (&model, solution.details());
        let found = solve_sensitivities(solve, (&[], &[]), &dependents, &free, &options).unwrap();
        for i in 0..all.len() {
            let difference = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * step);
            let slope = found.derivatives[(i, 0)];
            let off = (slope / difference - 1.0).abs();
            println!("{i}, {method:?}: {slope:e}, off {off:e}");
            // The fourth power of the step, and what Newton leaves over the step.
            assert!(off < 1e-8, "{i}, {method:?}: {slope:e} {difference:e}");
        }
    }
}

#[test]
fn a_thickness_is_that_of_a_plate_made_so() {
    let factor = 1.3;
    let solved = |thickness: f64, moved: Option<f64>| {
        let section = IsotropicShell::new(thickness, 2e8, 0.3, 1100.0);
        let section = section.section().unwrap();
        let mut model = Model::new();
        let patch = add_strip(&mut model, [1.0, 0.5], &section, &mesh([2, 1], [4, 3]));
        clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
        if let Some(value) = moved {
            let parameter = model.add_parameter("thickness", value, 1.0).unwrap();
            for element in 0..2 {
                let target = Target::ShellThickness(element);
                model.move_by_parameter(parameter, target, 1.0).unwrap();
            }
            // No thickness is left as it is.
            for wrong in [0.0, -1.0] {
                let error = model.set_parameter(parameter, wrong).unwrap_err();
                assert!(
                    error.to_string().contains("factor of the thickness"),
                    "{error}"
                );
            }
        }
        let modes = ModesOptions {
            count: 4,
            ..ModesOptions::default()
        };
        let modes = Modes::solve(&model, &modes, &mut |_, _| true).unwrap();
        assert_eq!(modes.outcome(), Outcome::Converged);
        let modes = modes.modes().iter();
        modes.map(|mode| mode.eigenvalue.im).collect::<Vec<f64>>()
    };
    let (made, moved) = (solved(0.02 * factor, None), solved(0.02, Some(factor)));
    for (made, moved) in made.iter().zip(&moved) {
        assert!((made / moved - 1.0).abs() < 1e-10, "{made} {moved}");
    }
    assert!(moved[0] > 1.25 * solved(0.02, None)[0]);
}
