//! Sensitivities against fourth-order differences of solves, and direct against adjoint.

mod common;

use common::models::beams::slider_crank;
use common::models::linkages::{hinged_blade, planar_linkage};
use common::models::small::whirled_beam;
use common::{
    ball, cosine, damped_section, gravity, hinged_body, join, largest, mass_on_a_slide, push,
    revolute, rotation1, spring, starting_at, steady,
};
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::error::ErrorKind;
use periodyn::model::{JointCoordinate, Model, Signal, SignalPart, SignalPlace, Target};
use periodyn::motion::Motion;
use periodyn::output::{
    BeamQuantity, ForceQuantity, JointQuantity, NodeQuantity, Quantity, ResolvedIn, Selection,
    Solution,
};
use periodyn::quantity::{Feature, Peak};
use periodyn::solve::{
    BranchOptions, Condition, Dependent, Event, Free, Given, InitialGuess, JointCoordinateIs,
    LinearMethod, Multiplier, MultiplierSensitivities, NewtonOptions, Outcome, OutputIs,
    PeriodicOptions, Phase, Sensitivities, SensitivityMethod, SensitivityOptions, Stability,
    StabilityOptions, StaticOptions, follow_branch, solve_multiplier_sensitivities,
    solve_sensitivities, solve_stability, solve_static,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Options of solves whose differences are taken: what Newton leaves of forces goes with the
/// tolerance.
fn options(points: usize) -> PeriodicOptions {
    PeriodicOptions {
        newton: NewtonOptions {
            tolerance: 1e-11,
            iteration_limit: 30,
        },
        ..PeriodicOptions::with_grid_points(points)
    }
}

/// What is held, what is asked for, and of what.
#[derive(Default)]
struct Asked {
    free: Vec<Free>,
    conditions: Vec<Arc<dyn Condition>>,
    dependents: Vec<Dependent>,
    parameters: Vec<Free>,
}

fn moved(model: &mut Model, name: &str, value: f64, targets: &[(Target, f64)]) -> Free {
    let parameter = model.add_parameter(name, value, value.abs()).unwrap();
    for &(target, factor) in targets {
        model.move_by_parameter(parameter, target, factor).unwrap();
    }
    Free::Parameter(parameter)
}

fn feature(of: impl Into<Selection>, feature: Feature) -> Dependent {
    Dependent::Feature(of.into(), feature)
}

fn coordinate(at: JointCoordinate) -> Quantity {
    Quantity::Joint(at.joint, JointQuantity::Coordinate(at.coordinate))
}

/// A motion under conditions.
fn held(model: &Model, period: f64, asked: &Asked, options: &PeriodicOptions) -> Solution {
    let lists = (&asked.free[..], &asked.conditions[..]);
    let solution = match asked.free.is_empty() {
        true => Solution::solve(model, period, options, &mut |_, _| true),
        false => Solution::solve_conditioned(model, period, lists, options, &mut |_, _| true),
    };
    let solution = solution.unwrap();
    let report = &solution.details().report;
    assert_eq!(solution.outcome(), Outcome::Converged, "{report:#?}");
    solution
}

/// The same, with a parameter moved from a solution: started there.
fn beside(solution: &Solution, asked: &Asked, parameter: Free, step: f64) -> Solution {
    let (model, period) = (solution.model(), solution.grid().period());
    let value = parameter.value(model, period).unwrap() + step;
    let mut all = Asked {
        free: asked.free.clone(),
        conditions: asked.conditions.clone(),
        ..Asked::default()
    };
    let free = all.free.len();
    all.free.push(parameter);
    all.conditions.push(Arc::new(Given { free, value }));
    let start = PeriodicOptions {
        guess: InitialGuess::State(solution.details().state.clone()),
        ..options(solution.grid().points())
    };
    held(model, period, &all, &start)
}

/// Values of dependents, by what solutions tell.
fn values(solution: &Solution, dependents: &[Dependent]) -> Vec<f64> {
    let value = |dependent: &Dependent| match *dependent {
        Dependent::Feature(of, feature) => {
            let series = solution.series(of).unwrap().remove(0);
            match feature {
                Feature::Mean => series.mean,
                Feature::Cosine(j) => series.cosines[j - 1],
                Feature::Sine(j) => series.sines[j - 1],
                Feature::At(time) => series.value(time),
            }
        }
        Dependent::Peak(of, peak) => {
            let found = solution.extremes(of).unwrap()[0];
            match peak {
                Peak::Largest => found.largest,
                Peak::Smallest => found.smallest,
            }
        }
        Dependent::Free(free) => {
            let (model, period) = (solution.model(), solution.grid().period());
            free.value(model, period).unwrap()
        }
    };
    dependents.iter().map(value).collect()
}

fn sensitivities(
    solution: &Solution,
    asked: &Asked,
    options: &SensitivityOptions,
) -> periodyn::error::Result<Sensitivities> {
    solve_sensitivities(
        (solution.model(), solution.details()),
        (&asked.free, &asked.conditions),
        &asked.dependents,
        &asked.parameters,
        options,
    )
}

fn by(method: SensitivityMethod, linear: LinearMethod) -> SensitivityOptions {
    SensitivityOptions {
        method,
        linear,
        threads: 1,
    }
}

/// Checks sensitivities against differences by steps of this part of the scales, direct against
/// adjoint, and both by factors against both by iteration.
fn check(solution: &Solution, asked: &Asked, step: f64) {
    let (model, period) = (solution.model(), solution.grid().period());
    let options = |method, linear| by(method, linear);
    use SensitivityMethod::{Adjoint, Direct};
    let direct = sensitivities(solution, asked, &options(Direct, LinearMethod::Direct)).unwrap();
    let adjoint = sensitivities(solution, asked, &options(Adjoint, LinearMethod::Direct)).unwrap();
    let [iterative, transposed] = [Direct, Adjoint].map(|method| {
        let options = options(method, LinearMethod::Iterative(None));
        let found = sensitivities(solution, asked, &options).unwrap();
        assert_eq!(found.method, method);
        found
    });
    let scales: Vec<f64> = asked
        .parameters
        .iter()
        .map(|free| match *free {
            Free::Frequency => TAU / period,
            Free::Parameter(id) => model.parameters()[id].scale,
        })
        .collect();
    let mut worst = [0.0f64; 4];
    let mut faults = Vec::new();
    let differences: Vec<Vec<f64>> = asked
        .parameters
        .iter()
        .zip(&scales)
        .map(|(&parameter, scale)| {
            let h = step * scale;
            let at = |n: f64| {
                let solution = beside(solution, asked, parameter, n * h);
                values(&solution, &asked.dependents)
            };
            let [a, b, c, d] = [at(1.0), at(-1.0), at(2.0), at(-2.0)];
            (0..a.len())
                .map(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h))
                .collect()
        })
        .collect();
    let now = values(solution, &asked.dependents);
    for (i, dependent) in asked.dependents.iter().enumerate() {
        assert!((direct.values[i] - now[i]).abs() <= 1e-9 * now[i].abs().max(1e-3));
        let row = (0..scales.len()).map(|j| direct.derivatives[(i, j)] * scales[j]);
        // What a value of rounding varies by is rounding.
        let size = largest(row).max(1e-3 * now[i].abs());
        for (j, scale) in scales.iter().enumerate() {
            let found = direct.derivatives[(i, j)];
            let errors = [
                found - differences[j][i],
                found - adjoint.derivatives[(i, j)],
                found - iterative.derivatives[(i, j)],
                found - transposed.derivatives[(i, j)],
            ]
            .map(|error| error.abs() * scale / size);
            for (worst, error) in worst.iter_mut().zip(errors) {
                *worst = worst.max(error);
            }
            if !(errors[0] < 1e-8 && errors[1] < 1e-11 && errors[2].max(errors[3]) < 1e-9) {
                let (parameter, other) = (asked.parameters[j], differences[j][i]);
                let values = format!("{found:e}, differences {other:e}");
                faults.push(format!(
                    "{dependent:?} by {parameter:?}: {values}, {errors:?}"
                ));
            }
        }
    }
    println!("differences, adjoint, both by iteration: {worst:?}");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert_eq!((direct.method, adjoint.method), (Direct, Adjoint));
}

/// `x'' + 0.1 x' + x + 0.2 x³ = 0.3 cos Ωt + 0.1 cos(2Ωt + 0.4)`.
fn oscillator() -> (Model, JointCoordinate, Vec<Free>) {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    let force = model
        .add_polynomial_spring_damper(at, &[1.0, 0.0, 0.2], &[0.1], 0.0)
        .unwrap();
    let first = model.add_actuator(at, &cosine(0.3)).unwrap();
    let second = Signal::harmonics(0.0, 0.0, &[0.0, 0.1], &[0.0, 0.0]).unwrap();
    let second = model.add_actuator(at, &second).unwrap();
    let signal = |force, part| Target::Signal(SignalPlace::Actuator(force), part);
    let m = &mut model;
    let parameters = vec![
        Free::Frequency,
        moved(m, "stiffness", 1.0, &[(Target::Stiffness(force, 1), 1.0)]),
        moved(m, "hardening", 0.2, &[(Target::Stiffness(force, 3), 1.0)]),
        moved(m, "damping", 0.1, &[(Target::Damping(force, 1), 1.0)]),
        moved(m, "rest", 0.05, &[(Target::Rest(force), 1.0)]),
        moved(m, "mass", 1.0, &[(Target::Inertia(0), 1.0)]),
        moved(
            m,
            "load",
            1.0,
            &[(signal(first, SignalPart::Amplitude), 1.0)],
        ),
        moved(m, "phase", 0.4, &[(signal(second, SignalPart::Phase), 1.0)]),
    ];
    (model, at, parameters)
}

#[test]
fn of_a_nonlinear_oscillator() {
    let (model, at, parameters) = oscillator();
    let x = coordinate(at);
    let node = |quantity| Quantity::Node(0, quantity).component(0);
    let effort = Quantity::Force(0, ForceQuantity::Effort);
    let asked = Asked {
        dependents: vec![
            feature(x, Feature::Mean),
            feature(x, Feature::Cosine(1)),
            feature(x, Feature::Sine(2)),
            feature(x, Feature::At(0.7)),
            feature(node(NodeQuantity::Velocity), Feature::Cosine(1)),
            feature(node(NodeQuantity::Acceleration), Feature::At(-1.3)),
            feature(effort, Feature::Sine(1)),
            Dependent::Peak(x.into(), Peak::Largest),
            Dependent::Peak(effort.into(), Peak::Smallest),
        ],
        parameters,
        ..Asked::default()
    };
    let solution = held(&model, TAU / 1.4, &asked, &options(31));
    check(&solution, &asked, 5e-4);
}

#[test]
fn of_a_rotor_blade_on_a_hinge() {
    // Root moments and tip of a flexible blade, by its hinge's spring and others.
    let mut model = Model::new();
    let m = &mut model;
    let [root, tip] = [0.3, 5.3].map(|x| Vector3::x() * x);
    let hub = ball(m, 20.0, 2.0, &Vector3::zeros());
    let stiffness = [4e7, 1e7, 1e7, 4e4, 9e4, 3e5];
    let section = damped_section(&stiffness, &[4.0, 0.04, 0.02, 0.02], 2e-3);
    let blade = m
        .add_straight_beam(&root, &tip, &Vector3::y(), &section, 2, 3)
        .unwrap();
    let shaft = revolute(m, None, Some(hub), &Vector3::zeros(), &Vector3::z());
    let flap = revolute(m, Some(hub), Some(blade.first_node), &root, &Vector3::y());
    m.prescribe(rotation1(shaft), &steady(8.0)).unwrap();
    gravity(m, [0.0, -9.81, 0.0]);
    let lift = Signal::harmonics(300.0, 0.0, &[100.0, 0.0], &[0.0, 30.0]).unwrap();
    push(m, blade.last_node, 2, lift);
    let (at, period) = (rotation1(flap), TAU / 8.0);
    let force = m
        .add_polynomial_spring_damper(at, &[4e3], &[60.0], 0.0)
        .unwrap();
    let load = |component, part| Target::Signal(SignalPlace::Load(0, component), part);
    let sections: Vec<_> = (0..2).map(|e| (Target::BeamStiffness(e), 1.0)).collect();
    let masses: Vec<_> = (0..2).map(|e| (Target::BeamMass(e), 1.0)).collect();
    let damping: Vec<_> = (0..2).map(|e| (Target::BeamDamping(e), 1.0)).collect();
    let gravity = Target::Signal(SignalPlace::Gravity(1), SignalPart::Mean);
    let turn = Target::Signal(SignalPlace::Prescribed(0), SignalPart::Amplitude);
    let parameters = vec![
        moved(m, "hinge", 4e3, &[(Target::Stiffness(force, 1), 1.0)]),
        moved(m, "damper", 60.0, &[(Target::Damping(force, 1), 1.0)]),
        moved(m, "sections", 1.0, &sections),
        moved(m, "masses", 1.0, &masses),
        moved(m, "damping", 1.0, &damping),
        moved(m, "gravity", -9.81, &[(gravity, 1.0)]),
        moved(m, "lift", 300.0, &[(load(2, SignalPart::Mean), 1.0)]),
        moved(m, "wave", 1.0, &[(load(2, SignalPart::Amplitude), 1.0)]),
        moved(m, "unused", 1.0, &[(turn, 1.0)]),
        Free::Frequency,
    ];
    let root = Quantity::Beam {
        element: 0,
        station: 0.0,
        quantity: BeamQuantity::Force,
    };
    let reaction = Quantity::Joint(1, JointQuantity::Reaction(ResolvedIn::First));
    let asked = Asked {
        dependents: vec![
            feature(root.component(4), Feature::Mean),
            feature(root.component(5), Feature::Cosine(1)),
            feature(root.component(4), Feature::Sine(2)),
            feature(reaction.component(2), Feature::Cosine(1)),
            feature(
                Quantity::Node(blade.last_node, NodeQuantity::Position).component(2),
                Feature::Sine(1),
            ),
            feature(coordinate(at), Feature::Cosine(1)),
            Dependent::Peak(root.component(4), Peak::Largest),
        ],
        parameters,
        ..Asked::default()
    };
    let solution = held(&model, period, &asked, &options(21));
    check(&solution, &asked, 6e-4);
}

#[test]
fn at_trim() {
    let (mut model, period) = whirled_beam();
    let m = &mut model;
    let load = |component, part| Target::Signal(SignalPlace::Load(0, component), part);
    let free: Vec<Free> = [("across", 1), ("up", 2)]
        .map(|(name, c)| {
            let parameter = m.add_parameter(name, 0.0, 1.0).unwrap();
            m.move_by_parameter(parameter, load(c, SignalPart::Mean), 1.0)
                .unwrap();
            Free::Parameter(parameter)
        })
        .to_vec();
    let elements = 0..2usize;
    let sections: Vec<_> = elements
        .clone()
        .map(|e| (Target::BeamStiffness(e), 1.0))
        .collect();
    let masses: Vec<_> = elements.map(|e| (Target::BeamMass(e), 1.0)).collect();
    let parameters = vec![
        moved(m, "sections", 1.0, &sections),
        moved(m, "masses", 1.0, &masses),
        moved(m, "wave", 1.0, &[(load(1, SignalPart::Amplitude), 1.0)]),
        Free::Frequency,
    ];
    let root = Quantity::Beam {
        element: 0,
        station: -1.0,
        quantity: BeamQuantity::Force,
    };
    let tip = Quantity::Node(m.node_count() - 1, NodeQuantity::Position);
    let is = |output: Selection, feature, value| -> Arc<dyn Condition> {
        Arc::new(OutputIs {
            output,
            feature,
            value,
            scale: None,
        })
    };
    let asked = Asked {
        conditions: vec![
            is(root.component(4), Feature::Mean, 0.3),
            is(tip.component(1), Feature::Mean, 0.004),
        ],
        dependents: vec![
            Dependent::Free(free[0]),
            Dependent::Free(free[1]),
            feature(root.component(5), Feature::Mean),
            feature(root.component(4), Feature::Sine(1)),
            feature(tip.component(2), Feature::Mean),
            feature(tip.component(0), Feature::Mean),
            Dependent::Peak(tip.component(1), Peak::Largest),
        ],
        free,
        parameters,
    };
    let solution = held(&model, period, &asked, &options(15));
    check(&solution, &asked, 2e-3);
    // What conditions hold does not change.
    let of_held = Asked {
        dependents: vec![feature(root.component(4), Feature::Mean)],
        free: asked.free.clone(),
        conditions: asked.conditions.clone(),
        parameters: asked.parameters.clone(),
    };
    let found = sensitivities(&solution, &of_held, &SensitivityOptions::default()).unwrap();
    assert_eq!(found.method, SensitivityMethod::Adjoint);
    assert!(found.derivatives.amax() < 1e-10, "{}", found.derivatives);
}

/// Rayleigh's oscillator `x'' − μ (x' − x'³/3) + x + 0.3 x³ = 0`.
fn limit_cycle() -> (Model, Solution, Asked) {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    let law = [-0.5, 0.0, 0.5 / 3.0];
    let force = model
        .add_polynomial_spring_damper(at, &[1.0, 0.0, 0.3], &law, 0.0)
        .unwrap();
    let m = &mut model;
    let damping = [
        (Target::Damping(force, 1), -1.0),
        (Target::Damping(force, 3), 1.0 / 3.0),
    ];
    let parameters = vec![
        moved(m, "mu", 0.5, &damping),
        moved(m, "stiffness", 1.0, &[(Target::Stiffness(force, 1), 1.0)]),
        moved(m, "hardening", 0.3, &[(Target::Stiffness(force, 3), 1.0)]),
        moved(m, "mass", 1.0, &[(Target::Inertia(0), 1.0)]),
    ];
    let x = coordinate(at);
    let rate = Quantity::Joint(at.joint, JointQuantity::Rate(at.coordinate));
    let asked = Asked {
        free: vec![Free::Frequency],
        conditions: vec![Arc::new(Phase)],
        dependents: vec![
            Dependent::Free(Free::Frequency),
            feature(x, Feature::Cosine(1)),
            feature(x, Feature::Sine(1)),
            feature(x, Feature::Cosine(3)),
            feature(x, Feature::At(1.0)),
            feature(rate, Feature::Cosine(1)),
            Dependent::Peak(x.into(), Peak::Largest),
            Dependent::Peak(rate.into(), Peak::Largest),
        ],
        parameters,
    };
    let displaced = |t: f64| Motion::new(Matrix3::identity(), Vector3::x() * (1.7 * t.cos()));
    let start = starting_at(options(61), (&model, 61, 4.8), displaced);
    let solution = held(&model, 4.8, &asked, &start);
    (model, solution, asked)
}

#[test]
fn along_an_unknown_period() {
    let (_, solution, asked) = limit_cycle();
    check(&solution, &asked, 7e-4);
}

#[test]
fn of_the_period_of_a_pendulum() {
    // T goes with 1/√g at each amplitude; and no damping comes with it.
    let centre = Vector3::new(0.0, 0.0, -1.0);
    let (mut model, hinge) = hinged_body(1.0, &centre, &Matrix3::zeros(), &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let unfolding = model.add_parameter("unfolding", 0.0, 1.0).unwrap();
    let target = Target::MassDamping;
    model.move_by_parameter(unfolding, target, 1.0).unwrap();
    let weight = Target::Signal(SignalPlace::Gravity(2), SignalPart::Mean);
    let g = moved(&mut model, "g", 9.81, &[(weight, -1.0)]);
    let nothing = model.add_parameter("nothing", 3.0, 1.0).unwrap();
    let at = rotation1(hinge);
    let free = vec![Free::Frequency, Free::Parameter(unfolding)];
    let asked = Asked {
        conditions: vec![
            Arc::new(Phase),
            Arc::new(JointCoordinateIs { at, value: 1.0 }),
        ],
        dependents: vec![
            Dependent::Free(free[0]),
            Dependent::Free(free[1]),
            feature(coordinate(at), Feature::Cosine(1)),
        ],
        free,
        parameters: vec![g, Free::Parameter(nothing)],
    };
    let start = starting_at(options(41), (&model, 41, 2.1), |t| {
        let turn = nalgebra::Rotation3::new(Vector3::y() * t.cos()).into_inner();
        Motion::new(turn, turn * centre)
    });
    let solution = held(&model, 2.1, &asked, &start);
    let frequency = TAU / solution.grid().period();
    for method in [SensitivityMethod::Direct, SensitivityMethod::Adjoint] {
        let found = sensitivities(&solution, &asked, &by(method, LinearMethod::Direct)).unwrap();
        let d = &found.derivatives;
        println!(
            "{:e} {:e} {:e}",
            d[(0, 0)] - frequency / 19.62,
            d[(1, 0)],
            d[(2, 0)]
        );
        assert!((d[(0, 0)] - frequency / 19.62).abs() < 1e-9);
        assert!(d[(1, 0)].abs() < 1e-9 && d[(2, 0)].abs() < 1e-9);
        // What moves nothing.
        assert!((0..3).all(|i| d[(i, 1)] == 0.0));
    }
}

#[test]
fn with_constraints_that_depend_on_each_other() {
    let (mut model, period) = planar_linkage();
    let m = &mut model;
    let amplitude = Target::Signal(SignalPlace::Gravity(1), SignalPart::Mean);
    let parameters = vec![
        moved(m, "spring", 5.0, &[(Target::Stiffness(0, 1), 1.0)]),
        moved(m, "damper", 0.3, &[(Target::Damping(0, 1), 1.0)]),
        moved(m, "rocker", 1.0, &[(Target::Inertia(2), 1.0)]),
        moved(m, "gravity", -9.81, &[(amplitude, 1.0)]),
    ];
    let torque = JointQuantity::DrivingEffort(Coordinate::Rotation1);
    let force = Quantity::Joint(1, JointQuantity::Reaction(ResolvedIn::Space));
    let asked = Asked {
        dependents: vec![
            feature(Quantity::Joint(0, torque), Feature::Cosine(1)),
            feature(Quantity::Joint(0, torque), Feature::Sine(2)),
            feature(force.component(0), Feature::Mean),
            Dependent::Peak(force.component(1), Peak::Largest),
        ],
        parameters,
        ..Asked::default()
    };
    let solution = held(&model, period, &asked, &options(41));
    check(&solution, &asked, 3e-3);
    // Across the plane the joints share what they bear as they like.
    let open = Asked {
        dependents: vec![feature(force.component(2), Feature::Mean)],
        parameters: asked.parameters.clone(),
        ..Asked::default()
    };
    let error = sensitivities(&solution, &open, &SensitivityOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
    assert!(
        error.to_string().contains("share what they bear"),
        "{error}"
    );
}

#[test]
fn of_what_is_driven() {
    // A prescribed motion that depends on a parameter, in a linkage without freedoms.
    let turn = Signal::harmonics(0.0, 3.0, &[0.2], &[0.1]).unwrap();
    let (mut model, blade, [_, hinge]) = hinged_blade(&turn, &Vector3::z());
    spring(&mut model, rotation1(hinge), 40.0, 2.0);
    let part = |part| Target::Signal(SignalPlace::Prescribed(0), part);
    let parameters = vec![
        moved(
            &mut model,
            "swing",
            1.0,
            &[(part(SignalPart::Amplitude), 1.0)],
        ),
        moved(&mut model, "ahead", 0.3, &[(part(SignalPart::Phase), 1.0)]),
        moved(
            &mut model,
            "spring",
            40.0,
            &[(Target::Stiffness(0, 1), 1.0)],
        ),
        Free::Frequency,
    ];
    let torque = JointQuantity::DrivingEffort(Coordinate::Rotation1);
    let position = Quantity::Node(blade, NodeQuantity::Position);
    let asked = Asked {
        dependents: vec![
            feature(Quantity::Joint(0, torque), Feature::Cosine(1)),
            feature(coordinate(rotation1(hinge)), Feature::Sine(1)),
            feature(position.component(0), Feature::At(0.4)),
            Dependent::Peak(Quantity::Joint(0, torque).into(), Peak::Largest),
        ],
        parameters,
        ..Asked::default()
    };
    let solution = held(&model, TAU / 3.0, &asked, &options(31));
    check(&solution, &asked, 5e-4);
}

/// Where motions do not follow, only their rounding is left, which does not contract.
#[test]
fn of_what_does_not_move() {
    let period = TAU / 60.0;
    let mut model = slider_crank(2, 3, period);
    gravity(&mut model, [0.0, -9.81, 0.0]);
    let parameters = vec![
        moved(&mut model, "crank", 1.0, &[(Target::Inertia(0), 1.0)]),
        moved(&mut model, "slider", 1.0, &[(Target::Inertia(1), 1.0)]),
    ];
    let position = |node| Quantity::Node(node, NodeQuantity::Position).component(0);
    let shaft = Quantity::Joint(0, JointQuantity::Reaction(ResolvedIn::Space));
    let asked = Asked {
        dependents: vec![
            feature(position(0), Feature::Cosine(1)),
            feature(position(1), Feature::Cosine(2)),
            feature(shaft.component(1), Feature::Mean),
        ],
        parameters,
        ..Asked::default()
    };
    let solution = held(&model, period, &asked, &options(15));
    for method in [SensitivityMethod::Direct, SensitivityMethod::Adjoint] {
        for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
            let found = sensitivities(&solution, &asked, &by(method, linear)).unwrap();
            let found = found.derivatives;
            // The crank turns as it is driven, whatever it weighs; its bearing carries that.
            let still = [found[(0, 0)], found[(0, 1)], found[(1, 0)]];
            assert!(largest(still.into_iter()) < 1e-15, "{still:?}");
            let weight = 9.81 * 0.5;
            assert!(
                (found[(2, 0)].abs() - weight).abs() < 1e-9 * weight,
                "{found}"
            );
            assert!(found[(1, 1)].abs() > 1e-8, "{found}");
        }
    }
}

#[test]
fn what_has_none_is_told() {
    let (model, solution, cycle) = limit_cycle();
    let refuse = |asked: &Asked, kind: ErrorKind, why: &str| {
        for method in [SensitivityMethod::Direct, SensitivityMethod::Adjoint] {
            let found = sensitivities(&solution, asked, &by(method, LinearMethod::Direct));
            let error = found.unwrap_err();
            assert!(
                error.kind() == kind && error.to_string().contains(why),
                "{error}"
            );
        }
    };
    let with = |change: &dyn Fn(&mut Asked)| {
        let mut asked = Asked {
            free: cycle.free.clone(),
            conditions: cycle.conditions.clone(),
            dependents: cycle.dependents.clone(),
            parameters: cycle.parameters.clone(),
        };
        change(&mut asked);
        asked
    };
    // Nothing holds the phase.
    let loose = with(&|asked| {
        asked.free.clear();
        asked.conditions.clear();
        asked.dependents.remove(0);
    });
    refuse(&loose, ErrorKind::NotAvailable, "singular");
    let unequal = with(&|asked| asked.conditions.clear());
    refuse(
        &unequal,
        ErrorKind::Size,
        "as many as there are free parameters",
    );
    let unknown = with(&|asked| asked.parameters[0] = Free::Parameter(7));
    refuse(&unknown, ErrorKind::Identifier, "below 4, got 7");
    let free = with(&|asked| asked.parameters[0] = Free::Frequency);
    refuse(&free, ErrorKind::Value, "which is free");
    let twice = with(&|asked| asked.parameters[0] = asked.parameters[1]);
    refuse(&twice, ErrorKind::Value, "there twice");
    let given = with(&|asked| asked.dependents[0] = Dependent::Free(asked.parameters[0]));
    refuse(&given, ErrorKind::Value, "a parameter that is free");
    let node = Quantity::Node(9, NodeQuantity::Position).component(0);
    let no_node = with(&|asked| asked.dependents[1] = feature(node, Feature::Mean));
    refuse(&no_node, ErrorKind::Identifier, "node id below 1");
    let all = Quantity::Node(0, NodeQuantity::Position);
    let several = with(&|asked| asked.dependents[1] = feature(all, Feature::Mean));
    refuse(
        &several,
        ErrorKind::Value,
        "a component of a quantity that has several",
    );
    let constant = all.component(1);
    let flat = with(&|asked| asked.dependents[1] = Dependent::Peak(constant, Peak::Largest));
    refuse(&flat, ErrorKind::NotAvailable, "constant");
    // A solution of oversampled equations.
    let (coarse, at, parameters) = oscillator();
    let asked = Asked {
        dependents: vec![feature(coordinate(at), Feature::Mean)],
        parameters,
        ..Asked::default()
    };
    let few = PeriodicOptions {
        oversampling: 3,
        ..options(7)
    };
    let found = sensitivities(
        &held(&coarse, TAU / 1.4, &asked, &few),
        &asked,
        &SensitivityOptions::default(),
    );
    let error = found.unwrap_err().to_string();
    assert!(error.contains("as of oversampled ones"), "{error}");

    // Another model, and an equilibrium.
    let Free::Parameter(stiffness) = cycle.parameters[1] else {
        unreachable!()
    };
    let mut other = solution.model().clone();
    other.set_parameter(stiffness, 1.3).unwrap();
    let still = solve_static(&model, &StaticOptions::default(), &mut |_, _| true).unwrap();
    let lists = (&cycle.free[..], &cycle.conditions[..]);
    for (model, solve, why) in [
        (&model, &still, "of a periodic solution"),
        (&other, solution.details(), "the one that was solved"),
    ] {
        let (of, to) = (&cycle.dependents[..], &cycle.parameters[..]);
        let default = SensitivityOptions::default();
        let found = solve_sensitivities((model, solve), lists, of, to, &default);
        let error = found.unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
}

#[test]
fn two_equal_peaks_have_no_derivative() {
    // A force of a second harmonic only, and a little of the first.
    for (first, equal) in [(0.0, true), (0.02, false)] {
        let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
        spring(&mut model, at, 3.0, 0.2);
        let signal = Signal::harmonics(0.0, 0.0, &[first, 0.5], &[0.0, 0.0]).unwrap();
        model.add_actuator(at, &signal).unwrap();
        let asked = Asked {
            dependents: vec![Dependent::Peak(coordinate(at).into(), Peak::Largest)],
            parameters: vec![Free::Frequency],
            ..Asked::default()
        };
        let solution = held(&model, TAU, &asked, &options(9));
        match sensitivities(&solution, &asked, &SensitivityOptions::default()) {
            Ok(found) => assert!(!equal && found.derivatives[(0, 0)].is_finite()),
            Err(error) => {
                assert!(equal && error.kind() == ErrorKind::NotAvailable);
                assert!(
                    error.to_string().contains("the same at the times"),
                    "{error}"
                );
            }
        }
    }
}

#[test]
fn a_fold_has_none() {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    model
        .add_polynomial_spring_damper(at, &[1.0, 0.0, 0.1], &[0.05], 0.0)
        .unwrap();
    model.add_actuator(at, &cosine(0.18)).unwrap();
    let branch = BranchOptions {
        periodic: options(31),
        range: [1.0, 1.4],
        ..BranchOptions::default()
    };
    let branch = follow_branch(&model, TAU / 1.0, Free::Frequency, &branch, &mut |_, _| {
        true
    });
    let branch = branch.unwrap();
    let points = &branch.points;
    let folds = (0..points.len()).filter(|&i| points[i].event == Some(Event::Fold));
    let fold = folds.into_iter().next().unwrap();
    for (index, is_fold) in [(0, false), (fold, true)] {
        let (model, solved) = branch.solved(index).unwrap();
        for method in [SensitivityMethod::Direct, SensitivityMethod::Adjoint] {
            let found = solve_sensitivities(
                (&model, &solved),
                (&[], &[]),
                &[feature(coordinate(at), Feature::Cosine(1))],
                &[Free::Frequency],
                &by(method, LinearMethod::Direct),
            );
            match found {
                Ok(found) => assert!(!is_fold, "{}", found.derivatives),
                Err(error) => assert!(is_fold && error.to_string().contains("a fold"), "{error}"),
            }
        }
    }
}

/// Derivatives of multipliers, and the multipliers, of which `stability` tells.
fn of_multipliers(
    solution: &Solution,
    asked: &Asked,
    stability: &Stability,
    numbers: &[usize],
) -> periodyn::error::Result<MultiplierSensitivities> {
    solve_multiplier_sensitivities(
        (solution.model(), solution.details()),
        (&asked.free, &asked.conditions),
        (stability, numbers),
        &asked.parameters,
        &SensitivityOptions::default(),
    )
}

fn analysed(solution: &Solution) -> Stability {
    let options = StabilityOptions {
        tolerance: 1e-11,
        ..StabilityOptions::default()
    };
    solve_stability(solution.details(), &options).unwrap()
}

/// Checks them against differences of multipliers that the period map gives, by steps of this part
/// of the scales.
fn check_multipliers(solution: &Solution, asked: &Asked, step: f64) {
    let stability = analysed(solution);
    let known = |m: &&Multiplier| !m.trivial && m.value.norm() > 1e-3;
    let all = stability.multipliers.iter().enumerate();
    let numbers: Vec<usize> = all.filter(|(_, m)| known(m)).map(|(i, _)| i).collect();
    assert!(!numbers.is_empty());
    let found = of_multipliers(solution, asked, &stability, &numbers).unwrap();
    let (model, period) = (solution.model(), solution.grid().period());
    for (j, &parameter) in asked.parameters.iter().enumerate() {
        let scale = match parameter {
            Free::Frequency => TAU / period,
            Free::Parameter(id) => model.parameters()[id].scale,
        };
        let h = step * scale;
        let at = [1.0, -1.0, 2.0, -2.0].map(|n| {
            let beside = analysed(&beside(solution, asked, parameter, n * h));
            numbers
                .iter()
                .zip(&found.values)
                .map(move |(_, value)| {
                    let near = |m: &&Multiplier| (m.value - value).norm();
                    let all = beside.multipliers.iter();
                    let nearest = all.min_by(|a, b| near(a).total_cmp(&near(b)));
                    nearest.unwrap().value
                })
                .collect::<Vec<_>>()
        });
        let [a, b, c, d] = at;
        for (i, &number) in numbers.iter().enumerate() {
            let difference = ((a[i] - b[i]) * 8.0 - (c[i] - d[i])) / (12.0 * h);
            let derivative = found.derivatives[(i, j)];
            let error = (derivative - difference).norm() * scale;
            println!("{number} by {parameter:?}: {derivative:.9}, off by {error:.1e}");
            let size = (derivative.norm() * scale).max(found.values[i].norm());
            assert!(error < 1e-8 * size, "{derivative} {difference}: {error:e}");
            let value = stability.multipliers[number].value;
            assert!((found.values[i] - value).norm() < 1e-9);
        }
    }
}

#[test]
fn of_multipliers_of_a_nonlinear_oscillator() {
    let (model, _, parameters) = oscillator();
    let asked = Asked {
        parameters,
        ..Asked::default()
    };
    let solution = held(&model, TAU / 1.4, &asked, &options(41));
    check_multipliers(&solution, &asked, 5e-4);
}

#[test]
fn of_the_multiplier_of_a_limit_cycle() {
    let (_, solution, asked) = limit_cycle();
    check_multipliers(&solution, &asked, 3e-3);
    // That of a shift in time is 1 whatever the parameters.
    let stability = analysed(&solution);
    let is_trivial = |m: &Multiplier| m.trivial;
    let number = stability.multipliers.iter().position(is_trivial).unwrap();
    let error = of_multipliers(&solution, &asked, &stability, &[number]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
    assert!(error.to_string().contains("time or space"), "{error}");
    let error = of_multipliers(&solution, &asked, &stability, &[9]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Identifier);
}

#[test]
fn multipliers_that_are_equal_have_none() {
    // Two oscillators that do not know of each other.
    let mut model = Model::new();
    let mut springs = Vec::new();
    for axis in [Vector3::x(), Vector3::y()] {
        let body = ball(&mut model, 1.0, 1.0, &Vector3::zeros());
        let members = [None, Some(body)];
        let slide = join(
            &mut model,
            JointKind::Prismatic,
            members,
            &Vector3::zeros(),
            &axis,
        );
        let at = JointCoordinate {
            joint: slide,
            coordinate: Coordinate::Displacement1,
        };
        let spring = model.add_polynomial_spring_damper(at, &[2.0], &[0.1], 0.0);
        springs.push(spring.unwrap());
        model.add_actuator(at, &cosine(1.0)).unwrap();
    }
    let stiffness = moved(
        &mut model,
        "stiffness",
        2.0,
        &[(Target::Stiffness(springs[0], 1), 1.0)],
    );
    let asked = Asked {
        parameters: vec![stiffness],
        ..Asked::default()
    };
    let solution = held(&model, TAU / 1.1, &asked, &options(5));
    let stability = analysed(&solution);
    let error = of_multipliers(&solution, &asked, &stability, &[0]).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
    assert!(error.to_string().contains("is as large"), "{error}");
}
