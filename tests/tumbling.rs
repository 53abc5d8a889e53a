//! Flexible bodies that tumble freely: periodic but for a turn about their angular momentum.

mod common;

use common::models::parts::*;
use common::*;
use nalgebra::{Matrix3, Rotation3, Vector3};
use periodyn::collocation::GridState;
use periodyn::elements::{JointKind, LoadFrame};
use periodyn::fourier::TimeGrid;
use periodyn::model::{Model, Signal, SignalPart, SignalPlace, Target};
use periodyn::motion::Motion;
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

/// A period of the wobble of a free rigid body, by small steps of the fourth order.
struct Wobble {
    period: f64,
    /// The turn about the angular momentum in a period, over the period.
    rate: f64,
    /// Its course in a frame that turns at this rate, at equal times.
    course: Vec<Matrix3<f64>>,
}

/// Angular velocity in the body and rotation, a little later.
fn stepped(inertia: &[f64; 3], at: &[Matrix3<f64>; 2], h: f64) -> [Matrix3<f64>; 2] {
    let [a, b, c] = *inertia;
    // The angular velocity is kept as a skew matrix.
    let slope = |[w, turn]: [Matrix3<f64>; 2]| {
        let [x, y, z] = [w[(2, 1)], w[(0, 2)], w[(1, 0)]];
        let change = Vector3::new(
            (b - c) / a * y * z,
            (c - a) / b * z * x,
            (a - b) / c * x * y,
        );
        [change.cross_matrix(), turn * w]
    };
    let plus = |s: &[Matrix3<f64>; 2], h: f64| [at[0] + s[0] * h, at[1] + s[1] * h];
    let first = slope(*at);
    let second = slope(plus(&first, h / 2.0));
    let third = slope(plus(&second, h / 2.0));
    let fourth = slope(plus(&third, h));
    let mean = [0, 1].map(|i| (first[i] + second[i] * 2.0 + third[i] * 2.0 + fourth[i]) / 6.0);
    plus(&mean, h)
}

/// That which starts with this angular velocity in principal axes, its second component zero.
fn eulers_wobble(inertia: &[f64; 3], start: &Vector3<f64>, points: usize) -> Wobble {
    let moments = Vector3::from(*inertia);
    let momentum = moments.component_mul(start);
    let upright = Rotation3::rotation_between(&momentum, &Vector3::z()).unwrap();
    let start = [start.cross_matrix(), upright.into_inner()];
    let after = |time: f64, steps: usize| {
        let h = time / steps as f64;
        (0..steps).fold(start, |at, _| stepped(inertia, &at, h))
    };
    let [a, b, c] = *inertia;
    // The period of small wobbles, mended by Newton's method: the second component is zero again.
    let spin = start[0][(1, 0)];
    let mut period = TAU / (spin * ((c - a) * (c - b) / (a * b)).sqrt());
    for _ in 0..20 {
        let [w, _] = after(period, 4000);
        let change = (c - a) / b * w[(1, 0)] * w[(2, 1)];
        period -= w[(0, 2)] / change;
    }
    let whole = after(period, 4000)[1] * start[1].transpose();
    let turn = f64::atan2(whole[(1, 0)], whole[(0, 0)]);
    let mean = momentum.norm() / c * period;
    let rate = (turn + TAU * ((mean - turn) / TAU).round()) / period;
    let mut at = start;
    let mut course = vec![];
    for k in 0..points {
        let seen = Rotation3::new(Vector3::z() * (-rate * period * k as f64 / points as f64));
        course.push(seen * at[1]);
        let h = period / points as f64 / 200.0;
        at = (0..200).fold(at, |at, _| stepped(inertia, &at, h));
    }
    Wobble {
        period,
        rate,
        course,
    }
}

/// What is free beside the frequency and the rate of the frame, to be found zero: what loses or
/// adds energy and momentum.
const UNFOLDED: [&str; 3] = ["damping", "moment", "force"];

/// The satellite's wobble about the axis of its largest inertia: with the angular momentum about
/// the vertical and the angular velocity of the hub about its axis x at the start of the rigid
/// satellite, which begins with this angular velocity in its principal axes. Gives the solution
/// and the wobble of that.
fn wobble(soft: f64, start: &Vector3<f64>, points: usize) -> (Solution, Wobble) {
    let (mut model, hub) = satellite(soft);
    let (centre, axes, moments) = as_rigid(&model);
    let rigid = eulers_wobble(&moments, start, points);
    let momentum = Vector3::from(moments).component_mul(start).norm();
    let origin = Vector3::zeros();
    model
        .set_turning_frame(&Vector3::z(), rigid.rate, &origin)
        .unwrap();
    for (frame, index) in [(LoadFrame::Space, 2), (LoadFrame::Follower, 5)] {
        let mut components = [const { None }; 6];
        components[index] = Some(Signal::constant(0.0).unwrap());
        model.add_load(hub, frame, components).unwrap();
    }
    let mean = |load, index| Target::Signal(SignalPlace::Load(load, index), SignalPart::Mean);
    let targets = [Target::MassDamping, mean(1, 5), mean(0, 2)];
    let mut free = vec![Free::Frequency];
    let parameters = [("rate", rigid.rate, Target::FrameRate)]
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
            value: (axes * start).x,
            scale: None,
        }),
    ];
    let grid = TimeGrid::new(points, rigid.period).unwrap();
    let system = System::new(&model, rigid.period).unwrap();
    let mut state = GridState::reference(&system, grid);
    for node in 0..model.node_count() {
        let there = model.node(node).unwrap();
        let from_centre = Motion::new(
            axes.transpose() * there.rotation,
            axes.transpose() * (there.position - centre),
        );
        for (k, rotation) in rigid.course.iter().enumerate() {
            let body = Motion::new(*rotation, Vector3::zeros());
            state.motions[node * points + k] = body.compose(&from_centre);
        }
    }
    let options = PeriodicOptions {
        guess: InitialGuess::State(state),
        ..options(points)
    };
    let found = solve_for(&model, rigid.period, &free, &conditions, &options);
    (found, rigid)
}

fn values(solution: &Solution) -> Vec<f64> {
    let parameters = solution.model().parameters().iter();
    parameters.map(|parameter| parameter.value).collect()
}

#[test]
fn a_flexible_satellite_wobbles_as_a_rigid_one_but_for_what_is_proportional_to_softness() {
    let start = Vector3::new(0.8, 0.0, 4.0);
    let softness = [1.0, 4.0, 16.0];
    let off = softness.map(|soft| {
        let (found, rigid) = wobble(soft, &start, 21);
        let values = values(&found);
        // Nothing is lost, so nothing is to be added.
        assert!(values[1..].iter().all(|x| x.abs() < 1e-11), "{values:?}");
        let iterations = &found.details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("{soft}: {increments:?}");
        let [.., before, last] = increments[..] else {
            panic!("{increments:?}");
        };
        assert!(increments.len() <= 5 && last <= before * before + 1e-11);
        [found.grid().period() - rigid.period, values[0] - rigid.rate]
    });
    println!("{off:?}");
    for i in 0..2 {
        for (soft, softer) in off[i].iter().zip(off[i + 1]) {
            // The next terms are proportional to its square.
            assert!((softer / soft / 4.0 - 1.0).abs() < 2e-4 * softness[i]);
        }
    }
}

#[test]
fn a_march_comes_back_after_a_period() {
    let (found, _) = wobble(100.0, &Vector3::new(0.8, 0.0, 4.0), 31);
    let (model, period) = (found.model(), found.grid().period());
    let tip = model.node_count() - 1;
    let off = [400, 800].map(|steps| {
        let options = MarchOptions {
            period: Some(period),
            start: MarchStart::State(found.start_state(0.0).unwrap()),
            ..MarchOptions::with_step(period / f64::from(steps), MarchEnd::Duration(period))
        };
        let marched = Solution::march(model, &options, &mut |_, _| true).unwrap();
        assert_eq!(marched.outcome(), Outcome::Converged);
        let at = |solution: &Solution, time| {
            solution.node(tip, NodeQuantity::Position, &[time]).unwrap()
        };
        largest_difference(&at(&marched, period), &at(&found, 0.0))
    });
    println!("{off:?}");
    // But for errors of the second order in the step.
    let order = (off[0] / off[1]).log2();
    assert!(off[1] < 2e-3 && (order - 2.0).abs() < 0.2, "{order}");
}
