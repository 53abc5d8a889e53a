//! A solution on one mesh of the beams is a start on another.

mod common;

use common::converged;
use nalgebra::{Matrix3, Matrix6, Vector3};
use periodyn::elements::{Coordinate, JointKind, MaxwellBranch};
use periodyn::error::{ErrorKind, Result};
use periodyn::fourier::TimeGrid;
use periodyn::model::*;
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{JointQuantity, Solution};
use periodyn::solve::{Adaptation, GridPoints, InitialGuess, PeriodicOptions, StaticOptions};
use std::f64::consts::TAU;

const SPEED: f64 = 6.0;
const PERIOD: f64 = TAU / SPEED;
const POINTS: usize = 21;
const LENGTH: f64 = 3.0;

/// A blade, bent in its plane of rotation as built, on a driven hub by a flap hinge, where it
/// shares the place of the hub's node, and with a body at its tip; in gravity across the axis.
fn rotor(elements: usize, degree: usize) -> Model {
    let mut model = Model::new();
    let hub = model
        .add_rigid_body(5.0, &Vector3::zeros(), &Matrix3::identity())
        .unwrap();
    let stiffness = [4e6, 1.5e6, 1.5e6, 3e3, 2e3, 2e4];
    let section = SectionInput::diagonal(&stiffness, &[2.5, 0.02, 0.004, 0.016]).unwrap();
    let bend = 0.2;
    let line = |fraction: f64| -> Result<Motion> {
        let angle = bend * fraction;
        let radius = LENGTH / bend;
        let place = Vector3::new(radius * angle.sin(), radius * (1.0 - angle.cos()), 0.0);
        Ok(Motion::new(
            rotation_from_vector(&(Vector3::z() * angle)),
            place,
        ))
    };
    let stations = SectionStation::uniform(&section);
    let blade = model
        .add_beam_along(line, &stations, elements, degree)
        .unwrap();
    let tip = model
        .add_rigid_body(
            0.3,
            &line(1.0).unwrap().position,
            &(Matrix3::identity() * 1e-3),
        )
        .unwrap();
    let at = |name: &str, place: &Vector3<f64>, axis: Vector3<f64>| {
        Model::frame_at(name, place, &axis).unwrap()
    };
    let axis = at("axis", &Vector3::zeros(), Vector3::z());
    let drive = model
        .add_joint(JointKind::Revolute, None, Some(hub), &axis, &axis)
        .unwrap();
    let hinge = at("hinge", &Vector3::zeros(), Vector3::y());
    model
        .add_joint(
            JointKind::Revolute,
            Some(hub),
            Some(blade.first_node),
            &hinge,
            &hinge,
        )
        .unwrap();
    let end = at("tip", &line(1.0).unwrap().position, Vector3::z());
    model
        .add_joint(
            JointKind::Rigid,
            Some(blade.last_node),
            Some(tip),
            &end,
            &end,
        )
        .unwrap();
    let coordinate = Coordinate::Rotation1;
    let turning = Signal::harmonics(0.0, SPEED, &[], &[]).unwrap();
    model
        .prescribe(
            JointCoordinate {
                joint: drive,
                coordinate,
            },
            &turning,
        )
        .unwrap();
    let gravity = [0.0, -9.81, -2.0].map(|g| Signal::constant(g).unwrap());
    model.set_gravity(gravity);
    model
}

fn solve(model: &Model, guess: InitialGuess, points: GridPoints) -> Solution {
    let options = PeriodicOptions {
        grid_points: points,
        guess,
        ..PeriodicOptions::default()
    };
    let solution = Solution::solve(model, PERIOD, &options, &mut |_, _| true).unwrap();
    converged(solution)
}

#[test]
fn a_solution_on_a_coarse_mesh_starts_one_on_a_fine_mesh_and_the_other_way_round() {
    let (coarse, fine) = (rotor(2, 3), rotor(5, 4));
    let grid = TimeGrid::new(POINTS, PERIOD).unwrap();
    let fixed = GridPoints::Fixed(POINTS);
    for (from, to) in [(&coarse, &fine), (&fine, &coarse)] {
        let first = solve(from, InitialGuess::Default, fixed);
        let start = InitialGuess::State(first.prolonged_to(to, grid).unwrap());
        let near = solve(to, start, fixed);
        let cold = solve(to, InitialGuess::Default, fixed);
        let increments = |solution: &Solution| {
            let iterations = &solution.details().report.iterations;
            iterations.iter().map(|i| i.increment).collect::<Vec<_>>()
        };
        println!("{:?} {:?}", increments(&near), increments(&cold));
        // The meshes' own errors and no more: the blade moves by some tenths.
        assert!(increments(&near)[0] < 5e-3, "{:?}", increments(&near));
        let distance = near.details().state.distance(&cold.details().state, LENGTH);
        assert!(distance < 1e-9, "{distance:e}");
        // On adaptive grids, too, from the grid of the solution.
        let start = InitialGuess::State(first.prolonged_to(to, grid).unwrap());
        let adapted = solve(to, start, GridPoints::Adaptive(Adaptation::default()));
        assert!(adapted.grid().points() >= POINTS);
        assert_eq!(adapted.details().guess_iterations, 0);
    }
}

#[test]
fn equilibria_are_carried_and_an_undeformed_state_stays_one() {
    let (coarse, fine) = (rotor(2, 3), rotor(5, 4));
    let options = StaticOptions::default();
    let grid = TimeGrid::new(POINTS, PERIOD).unwrap();
    // At rest the blade hangs down along the axis, and turns so, too.
    let flap = |from: &Model| {
        let still = Solution::solve_static(from, &options, &mut |_, _| true).unwrap();
        let start = InitialGuess::State(still.prolonged_to(&fine, grid).unwrap());
        let found = solve(&fine, start, GridPoints::Fixed(POINTS));
        let angle = JointQuantity::Coordinate(Coordinate::Rotation1);
        found.joint(1, angle, &[0.0]).unwrap()[0]
    };
    let (from_coarse, from_fine) = (flap(&coarse), flap(&fine));
    assert!(
        (from_coarse - from_fine).abs() < 1e-9,
        "{from_coarse} {from_fine}"
    );

    // Without gravity and at the reference all stays there.
    let mut free = rotor(2, 3);
    free.set_gravity([0.0, 0.0, 0.0].map(|g| Signal::constant(g).unwrap()));
    let still = Solution::solve_static(&free, &options, &mut |_, _| true).unwrap();
    let one = TimeGrid::new(1, PERIOD).unwrap();
    let state = still.prolonged_to(&fine, one).unwrap();
    for node in 0..fine.node_count() {
        let (at, reference) = (state.node(node)[0], fine.node(node).unwrap());
        let error =
            (at.position - reference.position).norm() + (at.rotation - reference.rotation).norm();
        assert!(error < 1e-12, "node {node}: {error:e}");
    }
}

#[test]
fn other_mechanisms_are_refused() {
    let solution = solve(&rotor(2, 3), InitialGuess::Default, GridPoints::Fixed(9));
    let grid = TimeGrid::new(9, PERIOD).unwrap();
    let mut longer = rotor(3, 3);
    let section = SectionInput::diagonal(&[1e6; 6], &[1.0, 0.2, 0.1, 0.1]).unwrap();
    let stations = SectionStation::uniform(&section);
    let line = straight_line(&Vector3::x(), &Vector3::new(2.0, 1.0, 0.0), &Vector3::z()).unwrap();
    longer.add_beam_along(line, &stations, 2, 2).unwrap();
    let mut more = rotor(3, 3);
    more.add_rigid_body(1.0, &Vector3::x(), &Matrix3::identity())
        .unwrap();
    let mut joined = rotor(3, 3);
    let frame = Model::frame_at("frame", &Vector3::zeros(), &Vector3::x()).unwrap();
    joined
        .add_joint(JointKind::Spherical, None, Some(0), &frame, &frame)
        .unwrap();
    for (model, told) in [
        (&longer, "one with 1 beams, for a model with 2"),
        (&more, "one with fewer nodes beside its beams"),
        (&joined, "one with 3 joints"),
    ] {
        let error = solution.prolonged_to(model, grid).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Value);
        assert!(error.to_string().contains(told), "{error}");
    }
}

#[test]
fn as_many_forces_with_other_unknowns_are_refused() {
    let at = JointCoordinate {
        joint: 1,
        coordinate: Coordinate::Rotation1,
    };
    let branch = MaxwellBranch {
        stiffness: 1.0,
        relaxation_time: 1.0,
    };
    let with_branches = |count: usize| {
        let mut model = rotor(2, 3);
        let branches = vec![branch; count];
        model.add_viscoelastic(at, 1.0, 0.0, &branches).unwrap();
        model
    };
    let mut damped = rotor(2, 3);
    let damper = damped.add_viscous_damper(None, Some(0), None, &Matrix6::identity());
    damper.unwrap();
    let grid = TimeGrid::new(9, PERIOD).unwrap();
    let points = GridPoints::Fixed(9);
    let solution = solve(&with_branches(1), InitialGuess::Default, points);
    assert!(solution.prolonged_to(&with_branches(1), grid).is_ok());
    for model in [with_branches(2), damped] {
        let error = solution.prolonged_to(&model, grid).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Value);
        assert!(
            error.to_string().contains("on the same coordinates"),
            "{error}"
        );
    }
}
