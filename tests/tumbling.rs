//! Flexible bodies that tumble freely: periodic but for a turn about their angular momentum.

mod common;

use common::models::parts::*;
use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::GridState;
use periodyn::elements::{JointKind, LoadFrame};
use periodyn::fourier::TimeGrid;
use periodyn::model::{Model, Signal, SignalPart, SignalPlace, Target};
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{NodeQuantity, Quantity, Solution};
use periodyn::quantity::Feature;
use periodyn::solve::*;
use periodyn::system::{Summary, System};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Where the arms of [`satellite`] end, and the masses there.
const ARMS: [([f64; 3], f64); 6] = [
    ([1.5, 0.0, 0.1], 0.4),
    ([-1.4, 0.1, 0.0], 0.5),
    ([0.0, 0.9, 0.0], 0.6),
    ([0.1, -1.0, -0.1], 0.5),
    ([0.05, 0.0, 0.7], 0.6),
    ([0.0, 0.1, -0.6], 0.7),
];

/// A body with six arms of beams and masses at their ends, which nothing holds, `soft` times as
/// soft as arms that hardly bend.
fn satellite(soft: f64) -> (Model, usize) {
    let mut model = Model::new();
    let hub = ball(&mut model, 3.0, 0.2, &Vector3::zeros());
    let stiffness = [2e6, 8e5, 8e5, 2e4, 3e4, 3e4].map(|k| k / soft);
    let section = damped_section(&stiffness, &[0.1, 2e-4, 1e-4, 1e-4], 0.0);
    for (end, mass) in ARMS {
        let end = Vector3::from(end);
        let root = end.normalize() * 0.2;
        let beam =
            model.add_straight_beam(&root, &end, &Vector3::new(1.0, 1.1, 1.2), &section, 1, 4);
        let beam = beam.unwrap();
        let tip = ball(&mut model, mass, 1e-3, &end);
        let ends = [
            ([Some(hub), Some(beam.first_node)], root),
            ([Some(beam.last_node), Some(tip)], end),
        ];
        for (nodes, at) in ends {
            join(&mut model, JointKind::Rigid, nodes, &at, &Vector3::z());
        }
    }
    (model, hub)
}

/// The whole satellite as one rigid body: its centre, and its principal axes and moments of
/// inertia, least first.
fn as_rigid(model: &Model) -> (Vector3<f64>, Matrix3<f64>, [f64; 3]) {
    let summary = Summary::of(model).unwrap();
    let mut whole = Matrix3::zeros();
    for part in &summary.mass_properties {
        let arm = part.centre - summary.centre;
        let steiner = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
        whole += part.inertia + steiner * part.mass;
    }
    let eigen = whole.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let mut axes = Matrix3::from_columns(&order.map(|i| eigen.eigenvectors.column(i).into_owned()));
    if axes.determinant() < 0.0 {
        axes = Matrix3::from_columns(&[
            axes.column(0).into_owned(),
            axes.column(1).into_owned(),
            -axes.column(2).into_owned(),
        ]);
    }
    (summary.centre, axes, order.map(|i| eigen.eigenvalues[i]))
}

/// What is free, as in [`wobble`]: beside the frequency and the rate of the frame, what loses or
/// adds momentum, to be found zero.
const UNFOLDED: [&str; 3] = ["damping", "moment", "force"];

/// The satellite's wobble about the axis of its largest inertia: with this angular momentum about
/// the vertical, and the hub turning about its own axis x by about this part of its spin at the
/// start. Gives the period's solution, whose model has the rate of its frame.
fn wobble(soft: f64, momentum: f64, wobbling: f64, points: usize) -> Solution {
    let (mut model, hub) = satellite(soft);
    let (centre, axes, [a, b, c]) = as_rigid(&model);
    println!("{a} {b} {c} {centre} {axes}");
    let spin = momentum / c;
    // Small wobbles: ω = (e cos, e r sin) about the axes of least and middle inertia, and the
    // momentum stays upright.
    let e = wobbling * spin;
    let r = (a * (c - a) / (b * (c - b))).sqrt();
    let ratio = ((c - a) * (c - b) / (a * b)).sqrt();
    let period = TAU / (spin * ratio);
    // The frame turns as the body does, but for one turn a period: that of the wobble.
    let rate = spin;
    let origin = Vector3::zeros();
    model
        .set_turning_frame(&Vector3::z(), rate, &origin)
        .unwrap();
    let mut components = [const { None }; 6];
    for index in [2, 5] {
        components[index] = Some(Signal::constant(0.0).unwrap());
    }
    model.add_load(hub, LoadFrame::Space, components).unwrap();
    let mean = |index| Target::Signal(SignalPlace::Load(0, index), SignalPart::Mean);
    let targets = [Target::MassDamping, mean(5), mean(2)];
    let mut free = vec![Free::Frequency];
    let parameters = [("rate", rate, Target::FrameRate)]
        .into_iter()
        .chain(UNFOLDED.into_iter().zip(targets).map(|(n, t)| (n, 0.0, t)));
    for (name, value, target) in parameters {
        let parameter = model.add_parameter(name, value, 1.0).unwrap();
        model.move_by_parameter(parameter, target, 1.0).unwrap();
        free.push(Free::Parameter(parameter));
    }
    let about = RigidMotion::rotation(&Vector3::z(), &origin).unwrap();
    let upwards = RigidMotion::translation(&Vector3::z()).unwrap();
    let conditions: [Arc<dyn Condition>; 5] = [
        Arc::new(Phase),
        Arc::new(RigidPhase(about)),
        Arc::new(RigidPhase(upwards)),
        Arc::new(Momentum {
            motion: about,
            value: momentum,
        }),
        Arc::new(OutputIs {
            output: Quantity::Node(hub, NodeQuantity::MaterialVelocity).component(3),
            feature: Feature::At(0.0),
            value: (axes * Vector3::new(e, 0.0, spin)).x,
            scale: None,
        }),
    ];
    let grid = TimeGrid::new(points, period).unwrap();
    let system = System::new(&model, period).unwrap();
    let mut state = GridState::reference(&system, grid);
    for node in 0..model.node_count() {
        let there = model.node(node).unwrap();
        let from_centre = Motion::new(
            axes.transpose() * there.rotation,
            axes.transpose() * (there.position - centre),
        );
        for k in 0..points {
            let t = TAU * k as f64 / points as f64;
            let (w1, w2) = (e * t.cos(), e * r * t.sin());
            let tilt = Vector3::new(b * w2, -a * w1, 0.0) / momentum;
            let body = Motion::new(rotation_from_vector(&tilt), Vector3::zeros());
            state.motions[node * points + k] = body.compose(&from_centre);
        }
    }
    let options = PeriodicOptions {
        guess: InitialGuess::State(state),
        linear: if std::env::var("IT").is_ok() { LinearMethod::Iterative(None) } else { LinearMethod::Automatic },
        ..options(points)
    };
    solve_for(&model, period, &free, &conditions, &options)
}

fn values(solution: &Solution) -> Vec<f64> {
    let parameters = solution.model().parameters().iter();
    parameters.map(|parameter| parameter.value).collect()
}

#[test]
fn a_flexible_satellite_wobbles_as_a_rigid_one_the_more_the_stiffer_it_is() {
    let (momentum, wobbling, points) = (12.0, 0.1, 25);
    let found = [1.0, 10.0, 100.0].map(|soft| {
        let solution = wobble(soft, momentum, wobbling, points);
        let values = values(&solution);
        println!("{soft}: {} {values:?}", solution.grid().period());
        // Nothing is lost, so nothing is to be added.
        assert!(values[1..].iter().all(|x| x.abs() < 1e-8), "{values:?}");
        [solution.grid().period(), values[0]]
    });
    for i in 0..2 {
        let differences = [found[1][i] - found[0][i], found[2][i] - found[1][i]];
        println!("{differences:?}");
    }
}
