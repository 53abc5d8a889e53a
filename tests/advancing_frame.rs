//! Motions that repeat themselves but for a translation in each period: the unknown drift of what
//! crawls, and screw motions.

mod common;

use common::models::parts::*;
use common::*;
use nalgebra::Vector3;
use periodyn::collocation::{Collocation, GridState};
use periodyn::elements::{Coordinate, JointKind, LoadFrame, NodeForceLaw};
use periodyn::error::ErrorKind;
use periodyn::fourier::TimeGrid;
use periodyn::model::*;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;
use periodyn::system::System;
use std::f64::consts::TAU;
use std::sync::Arc;

const PERIOD: f64 = 0.8;
/// Masses of a crawler, how far they move apart, and their drag against the ground: linear, and
/// with the square of the speed, as fur that lies one way has it.
const MASSES: [f64; 2] = [1.3, 0.6];
const STROKE: f64 = 0.2;
const DRAG: [f64; 2] = [0.9, 0.7];
const PULL: f64 = 0.15;

/// Drag on a body along x by its speed over the ground.
fn drag(speed: f64) -> f64 {
    -DRAG[0] * speed - DRAG[1] * speed * speed
}

fn drag_on_nodes(nodes: &[usize], model: &mut Model) {
    for &node in nodes {
        let law = NodeForceLaw {
            function: Arc::new(move |state, out| {
                let speed = state.velocities[0][0];
                out.forces[0][0] = drag(speed);
                if let Some((_, by_velocity)) = &mut out.tangents {
                    by_velocity[(0, 0)] = -DRAG[0] - 2.0 * DRAG[1] * speed;
                }
                Ok(())
            }),
            gives_tangents: true,
            frame: LoadFrame::Space,
        };
        let force = model.add_node_forces(&[node], law).unwrap();
        model.declare_of_phase(force).unwrap();
    }
}

/// Two bodies on a level slide, the second driven to and fro along the first.
fn crawler() -> Model {
    let mut model = Model::new();
    let [first, second] = MASSES.map(|mass| ball(&mut model, mass, 0.1, &Vector3::zeros()));
    let origin = Vector3::zeros();
    let slide =
        |model: &mut Model, nodes| join(model, JointKind::Prismatic, nodes, &origin, &Vector3::x());
    slide(&mut model, [None, Some(first)]);
    let joint = slide(&mut model, [Some(first), Some(second)]);
    let at = JointCoordinate {
        joint,
        coordinate: Coordinate::Displacement1,
    };
    model.prescribe(at, &cosine(STROKE)).unwrap();
    push(&mut model, first, 0, Signal::constant(PULL).unwrap());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    drag_on_nodes(&[first, second], &mut model);
    model
}

/// The mean speed of the crawler, as its one equation has it: in small steps of the fourth order.
fn drift() -> f64 {
    let (steps, total) = (4000, MASSES[0] + MASSES[1]);
    let frequency = TAU / PERIOD;
    let h = PERIOD / f64::from(steps);
    let slope = |time: f64, speed: f64| {
        let phase = frequency * time;
        let rate = -STROKE * frequency * phase.sin();
        let acceleration = -STROKE * frequency * frequency * phase.cos();
        let forces = drag(speed) + drag(speed + rate) + PULL;
        (forces - MASSES[1] * acceleration) / total
    };
    let mut speed = 0.0;
    let mut mean = 0.0;
    for _ in 0..120 {
        mean = 0.0;
        for k in 0..steps {
            let time = h * f64::from(k);
            mean += speed / f64::from(steps);
            let k1 = slope(time, speed);
            let k2 = slope(time + 0.5 * h, speed + 0.5 * h * k1);
            let k3 = slope(time + 0.5 * h, speed + 0.5 * h * k2);
            let k4 = slope(time + h, speed + h * k3);
            speed += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
    }
    mean
}

#[test]
fn a_crawler_finds_its_drift() {
    let exact = drift();
    let mut model = crawler();
    let zero = Vector3::zeros();
    model.set_turning_frame(&Vector3::x(), 0.0, &zero).unwrap();
    let speed = model.add_parameter("drift", 0.0, 1.0).unwrap();
    model
        .move_by_parameter(speed, Target::FrameAdvance, 1.0)
        .unwrap();
    let along = RigidMotion::translation(&Vector3::x()).unwrap();
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let grid = TimeGrid::new(31, PERIOD).unwrap();
        let mut guess = GridState::reference(&System::new(&model, PERIOD).unwrap(), grid);
        for k in 0..31 {
            let x = STROKE * (TAU * k as f64 / 31.0).cos();
            guess.motions[31 + k] = displaced(x);
        }
        let options = PeriodicOptions {
            guess: InitialGuess::State(guess),
            linear,
            ..options(31)
        };
        let conditions: [Arc<dyn Condition>; 1] = [Arc::new(RigidPhase(along))];
        let found = solve_for(
            &model,
            PERIOD,
            &[Free::Parameter(speed)],
            &conditions,
            &options,
        );
        let value = found.model().parameters()[speed].value;
        let iterations = &found.details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("{linear:?}: {exact} {:e} {increments:?}", value - exact);
        assert!(exact.abs() > 0.01 && (value - exact).abs() < 1e-11);
        // Velocities are those over the ground.
        let times: Vec<f64> = (0..31).map(|k| PERIOD * f64::from(k) / 31.0).collect();
        let velocities = found.node(0, NodeQuantity::Velocity, &times).unwrap();
        let mean = column(&velocities, 6, 0).iter().sum::<f64>() / 31.0;
        assert!((mean - exact).abs() < 1e-11);
    }
}

#[test]
fn a_march_drifts_as_far_and_one_in_the_frame_stays() {
    let exact = drift();
    let mut moving = crawler();
    moving
        .set_turning_frame(&Vector3::x(), 0.0, &Vector3::zeros())
        .unwrap();
    moving.set_frame_advance(exact).unwrap();
    let off = [100, 200].map(|steps| {
        [crawler(), moving.clone()].map(|model| {
            let options = MarchOptions {
                period: Some(PERIOD),
                ..MarchOptions::with_step(
                    PERIOD / f64::from(steps),
                    MarchEnd::Duration(61.0 * PERIOD),
                )
            };
            let marched = Solution::march(&model, &options, &mut |_, _| true).unwrap();
            let marched = converged(marched);
            let times = [60.0 * PERIOD, 61.0 * PERIOD];
            let at = marched.node(0, NodeQuantity::Position, &times).unwrap();
            at[3] - at[0]
        })
    });
    println!("{exact} {off:?}");
    let errors = off.map(|[inertial, seen]| [inertial - exact * PERIOD, seen]);
    for (coarse, fine) in errors[0].iter().zip(errors[1]) {
        let order = (coarse / fine).log2();
        assert!(fine.abs() < 1e-3 && (order - 2.0).abs() < 0.3, "{order}");
    }
}

#[test]
fn a_screw_motion_is_at_rest_in_its_frame() {
    // A ball that turns about an axis, and goes along it: its forces, momenta and energy.
    let (rate, speed, radius) = (3.0, 0.7, 0.4);
    let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    let point = Vector3::new(0.3, 0.1, -0.5);
    let out = Vector3::new(1.0, 0.0, -1.0).normalize();
    let mut model = Model::new();
    let (mass, moment) = (1.7, 0.2);
    let body = ball(&mut model, mass, moment, &(point + out * radius));
    clamp(&mut model, body);
    model
        .set_turning_frame(&(axis * 5.0), rate, &point)
        .unwrap();
    model.set_frame_advance(speed).unwrap();
    let system = Arc::new(System::new(&model, 1.0).unwrap());
    let grid = TimeGrid::new(3, 1.0).unwrap();
    let state = GridState::reference(&system, grid);
    let mut equations = Collocation::new(system, grid).unwrap();
    equations.update_kinematics(&state);
    let square = (rate * radius).powi(2) + speed * speed;
    let energy = 0.5 * (mass * square + moment * rate * rate);
    let found = equations.mean_energy(&state).unwrap();
    assert!((found - energy).abs() < 1e-13 * energy, "{found} {energy}");
    let along = RigidMotion::translation(&axis).unwrap();
    assert!((equations.mean_momentum(&along.twist) - mass * speed).abs() < 1e-13);
    let about = RigidMotion::rotation(&axis, &point).unwrap();
    let momentum = (mass * radius * radius + moment) * rate;
    assert!((equations.mean_momentum(&about.twist) - momentum).abs() < 1e-13);
    let still = statics(&model);
    let velocity = still.node(body, NodeQuantity::Velocity, &[0.0]).unwrap();
    let exact = axis.cross(&out) * (rate * radius) + axis * speed;
    for (found, exact) in velocity
        .iter()
        .zip(exact.iter().chain((axis * rate).iter()))
    {
        assert!((found - exact).abs() < 1e-13);
    }
}

#[test]
fn frames_advance_only_where_there_is_one_and_files_keep_it() {
    let mut model = crawler();
    let error = model.set_frame_advance(1.0).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
    let parameter = model.add_parameter("drift", 0.5, 1.0).unwrap();
    let refused = model.move_by_parameter(parameter, Target::FrameAdvance, 1.0);
    assert_eq!(refused.unwrap_err().kind(), ErrorKind::Identifier);
    let zero = Vector3::zeros();
    model.set_turning_frame(&Vector3::x(), 0.0, &zero).unwrap();
    assert!(model.set_frame_advance(f64::NAN).is_err());
    model
        .move_by_parameter(parameter, Target::FrameAdvance, 3.0)
        .unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model");
    model.save(&path).unwrap();
    let again = Model::load(&path).unwrap();
    assert_eq!(again.turning_frame(), model.turning_frame());
    assert_eq!(again.turning_frame().unwrap().advance(), 1.5);
    // In a frame that turns, gravity has to be along the axis still.
    model.set_turning_frame(&Vector3::x(), 0.1, &zero).unwrap();
    let error = System::new(&model, PERIOD).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic);
}
