//! Angles of joints count whole turns: what a solution tells of them is what the forces on them act
//! by, however it was found and whatever was kept of it.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::error::ErrorKind;
use periodyn::fourier::TimeGrid;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{ForceQuantity, JointQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;

const STIFFNESS: f64 = 1.7;
const DAMPING: f64 = 4.0;
const PERIOD: f64 = 6.0;
/// Radians by which loads move the springs about their mean.
const SWING: f64 = 0.8;
const TURNS: [f64; 8] = [-3.0, -2.6, -1.3, -0.45, 0.55, 1.2, 2.5, 3.0];
const KINDS: [(JointKind, &[Coordinate]); 4] = [
    (JointKind::Revolute, &[Coordinate::Rotation1]),
    (JointKind::Cylindrical, &[Coordinate::Rotation1]),
    (JointKind::Screw { pitch: 0.3 }, &[Coordinate::Rotation1]),
    (
        JointKind::Universal,
        &[Coordinate::Rotation1, Coordinate::Rotation2],
    ),
];

/// A wheel on a joint with a spring on each of its angles, that a moment turns by `turns`; joint,
/// angles, springs.
struct Wheel {
    model: Model,
    joint: usize,
    springs: Vec<(Coordinate, usize)>,
}

fn wheel(kind: JointKind, angles: &[Coordinate], turns: f64) -> Wheel {
    let mut model = Model::new();
    let inertia = Matrix3::identity() * 0.4;
    let body = model
        .add_rigid_body(1.0, &Vector3::zeros(), &inertia)
        .unwrap();
    let frame = Model::frame_at("axis", &Vector3::zeros(), &Vector3::y()).unwrap();
    let joint = model
        .add_joint(kind, None, Some(body), &frame, &frame)
        .unwrap();
    let mut spring = |coordinate: Coordinate, stiffness: f64, damping: f64| {
        let definition = SpringDefinition {
            at: JointCoordinate { joint, coordinate },
            stiffness,
            damping,
            rest: 0.0,
        };
        model.add_spring_damper(definition).unwrap()
    };
    let mut springs = Vec::new();
    for &angle in angles {
        springs.push((angle, spring(angle, STIFFNESS, 0.0)));
        spring(angle, 0.0, DAMPING);
    }
    if kind == JointKind::Cylindrical {
        spring(Coordinate::Displacement1, 3.0, 1.0);
    }
    for &coordinate in angles {
        let moment = STIFFNESS * TAU * turns;
        let moment = Signal::harmonics(moment, 0.0, &[STIFFNESS * SWING], &[0.0]).unwrap();
        let at = JointCoordinate { joint, coordinate };
        model.add_actuator(at, &moment).unwrap();
    }
    Wheel {
        model,
        joint,
        springs,
    }
}

impl Wheel {
    /// Checks that all angles are the efforts of their springs over the stiffness, at these times;
    /// returns them.
    fn agree(&self, solution: &Solution, times: &[f64], what: &str) -> Vec<f64> {
        assert_eq!(
            solution.outcome(),
            Outcome::Converged,
            "{what}: {}",
            solution.report()
        );
        let mut all = Vec::new();
        for &(angle, spring) in &self.springs {
            let angles = JointQuantity::Coordinate(angle);
            let angles = solution.joint(self.joint, angles, times).unwrap();
            let efforts = solution
                .force(spring, ForceQuantity::Effort, times)
                .unwrap();
            for (q, effort) in angles.iter().zip(&efforts) {
                // Rounding of some turns.
                let off = (effort / STIFFNESS - q).abs();
                assert!(off < 1e-12 * TAU * 4.0, "{what}: {q} {effort}");
            }
            all.extend(angles);
        }
        all
    }
}

fn march(wheel: &Wheel, end: MarchEnd, stored_periods: usize) -> Solution {
    let options = MarchOptions {
        period: Some(PERIOD),
        stored_periods,
        ..MarchOptions::with_step(PERIOD / 240.0, end)
    };
    Solution::march(&wheel.model, &options, &mut |_, _| true).unwrap()
}

#[test]
fn angles_at_rest_are_those_of_their_springs() {
    for (kind, angles) in KINDS {
        for turns in TURNS {
            let wheel = wheel(kind, angles, turns);
            let options = StaticOptions::default();
            let solution = Solution::solve_static(&wheel.model, &options, &mut |_, _| true);
            let what = format!("{kind:?} by {turns} turns");
            // At time 0 the moment is that of the mean and the swing.
            for q in wheel.agree(&solution.unwrap(), &[0.0], &what) {
                // The square of Newton's tolerance, and rounding.
                assert!((q - TAU * turns - SWING).abs() < 1e-11, "{what}: {q}");
            }
        }
    }
}

#[test]
fn angles_over_a_period_are_those_of_their_springs() {
    let times = grid_times(15);
    for (kind, angles) in KINDS {
        for turns in TURNS {
            let wheel = wheel(kind, angles, turns);
            let what = format!("{kind:?} by {turns} turns");
            let cold = solve(&wheel.model, PERIOD, 15);
            let found = wheel.agree(&cold, &times, &what);
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            // About the mean that the constant moment gives: the swing adds harmonics of its own in
            // the universal joint.
            assert!((mean - TAU * turns).abs() < 0.2, "{what}: {mean}");
            // From this solution, on another grid.
            let options = PeriodicOptions {
                guess: InitialGuess::State(
                    cold.prolonged(TimeGrid::new(21, PERIOD).unwrap()).unwrap(),
                ),
                ..options(21)
            };
            let again = Solution::solve(&wheel.model, PERIOD, &options, &mut |_, _| true);
            wheel.agree(&again.unwrap(), &grid_times(21), &what);
        }
    }
}

fn grid_times(points: usize) -> Vec<f64> {
    (0..points)
        .map(|k| PERIOD * k as f64 / points as f64)
        .collect()
}

#[test]
fn angles_of_marches_are_those_of_their_springs_whatever_is_kept() {
    for (kind, angles) in KINDS {
        for turns in [-3.0, -1.3, 0.55, 2.5] {
            let wheel = wheel(kind, angles, turns);
            let what = format!("{kind:?} by {turns} turns");
            let all = march(&wheel, MarchEnd::Duration(8.0 * PERIOD), 0);
            wheel.agree(&all, &all.times(), &what);
            let end = MarchEnd::Periodic {
                tolerance: 1e-6,
                most_periods: 100,
            };
            for stored in [1, 2] {
                let last = march(&wheel, end, stored);
                assert!(last.times()[0] > 0.0, "nothing was forgotten");
                let angles = wheel.agree(&last, &last.times(), &what);
                let mean = angles.iter().sum::<f64>() / angles.len() as f64;
                assert!((mean - TAU * turns).abs() < 0.2, "{what}: {mean}");
                // Solves and marches that start from it.
                let grid = TimeGrid::new(15, PERIOD).unwrap();
                let options = PeriodicOptions {
                    guess: InitialGuess::State(last.prolonged(grid).unwrap()),
                    ..options(15)
                };
                let solve = Solution::solve(&wheel.model, PERIOD, &options, &mut |_, _| true);
                wheel.agree(&solve.unwrap(), &grid_times(15), &what);
                let time = last.times()[last.times().len() - 1];
                let options = MarchOptions {
                    start: MarchStart::State(last.start_state(time).unwrap()),
                    start_time: time,
                    period: Some(PERIOD),
                    ..MarchOptions::with_step(PERIOD / 240.0, MarchEnd::Duration(PERIOD))
                };
                let on = Solution::march(&wheel.model, &options, &mut |_, _| true).unwrap();
                wheel.agree(&on, &on.times(), &what);
            }
        }
    }
}

#[test]
fn springs_see_the_turns_that_a_signal_prescribes() {
    for (kind, angles) in KINDS {
        for turns in TURNS {
            let mut wheel = wheel(kind, angles, 0.0);
            let angle = JointCoordinate {
                joint: wheel.joint,
                coordinate: angles[0],
            };
            let value = TAU * turns + 0.3;
            let signal = Signal::harmonics(value, 0.0, &[0.5], &[0.0]).unwrap();
            wheel.model.prescribe(angle, &signal).unwrap();
            let options = StaticOptions::default();
            let still = Solution::solve_static(&wheel.model, &options, &mut |_, _| true).unwrap();
            let what = format!("{kind:?} by {turns} turns");
            let found = wheel.agree(&still, &[0.0], &what)[0];
            assert!((found - value - 0.5).abs() < 1e-11, "{what}: {found}");
            let moving = solve(&wheel.model, PERIOD, 15);
            let found = wheel.agree(&moving, &grid_times(15), &what)[0];
            assert!((found - value - 0.5).abs() < 1e-11, "{what}: {found}");
        }
    }
}

#[test]
fn steps_of_more_than_half_a_turn_between_bodies_are_counted_by_springs_too() {
    // Two wheels that moments drive against each other, through dampers, to 2.5 rad in a step each;
    // a spring between them, too soft to matter, tells the angle that it sees.
    let (soft, drive) = (1e-9, 2.5);
    let mut model = Model::new();
    let inertia = Matrix3::identity() * 0.4;
    let wheels = [1.0, -1.0].map(|sense| {
        let wheel = model.add_rigid_body(1.0, &Vector3::zeros(), &inertia);
        let wheel = wheel.unwrap();
        let origin = Vector3::zeros();
        let hinge = revolute(&mut model, None, Some(wheel), &origin, &Vector3::z());
        let damper = SpringDefinition {
            at: rotation1(hinge),
            stiffness: 0.0,
            damping: 1.0,
            rest: 0.0,
        };
        model.add_spring_damper(damper).unwrap();
        let moment = Signal::constant(sense * drive).unwrap();
        model.add_actuator(rotation1(hinge), &moment).unwrap();
        wheel
    });
    let frame = Motion::identity();
    let [first, second] = wheels.map(Some);
    let between = model.add_joint(JointKind::Free, first, second, &frame, &frame);
    let at = JointCoordinate {
        joint: between.unwrap(),
        coordinate: Coordinate::Rotation3,
    };
    let spring = SpringDefinition {
        at,
        stiffness: soft,
        damping: 0.0,
        rest: 0.0,
    };
    let spring = model.add_spring_damper(spring).unwrap();
    let options = MarchOptions::with_step(1.0, MarchEnd::Duration(24.0));
    let solution = Solution::march(&model, &options, &mut |_, _| true).unwrap();
    let times = solution.times();
    let angle = JointQuantity::Coordinate(at.coordinate);
    let angles = solution.joint(at.joint, angle, &times).unwrap();
    let efforts = solution.force(spring, ForceQuantity::Effort, &times);
    for (q, effort) in angles.iter().zip(&efforts.unwrap()) {
        assert!((effort / soft - q).abs() < 1e-12 * 120.0, "{q} {effort}");
    }
    // 24 s of 5 rad/s, less what it takes to get there.
    let last = *angles.last().unwrap();
    assert!((-120.0..-110.0).contains(&last), "{last}");
}

const CARDAN: [Coordinate; 3] = [
    Coordinate::Rotation1,
    Coordinate::Rotation2,
    Coordinate::Rotation3,
];

/// A body whose three Cardan angles are prescribed: one of them, and the others constant.
fn held(kind: JointKind, driven: Coordinate, signal: &Signal) -> Model {
    let mut model = Model::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.4, 0.6));
    let body = model.add_rigid_body(1.0, &Vector3::zeros(), &inertia);
    let frame = Motion::identity();
    let joint = model.add_joint(kind, None, Some(body.unwrap()), &frame, &frame);
    let joint = joint.unwrap();
    for &coordinate in kind.coordinates() {
        let constant = Signal::constant(0.1).unwrap();
        let of_it = if coordinate == driven {
            signal
        } else {
            &constant
        };
        let at = JointCoordinate { joint, coordinate };
        model.prescribe(at, of_it).unwrap();
    }
    model
}

#[test]
fn the_middle_one_of_three_angles_has_no_turns() {
    let drive = steady(TAU / PERIOD);
    for kind in [JointKind::Free, JointKind::Spherical] {
        for coordinate in CARDAN {
            let model = held(kind, coordinate, &drive);
            let found = try_solve(&model, PERIOD, 9);
            if coordinate != Coordinate::Rotation2 {
                let times = [0.0, 1.3, 5.9];
                let solution = converged(found.unwrap());
                let angles = JointQuantity::Coordinate(coordinate);
                let angles = solution.joint(0, angles, &times).unwrap();
                for (angle, time) in angles.iter().zip(times) {
                    assert!((angle - TAU * time / PERIOD).abs() < 1e-9, "{angle}");
                }
                continue;
            }
            let error = found.unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Model);
            let expected = "prescribed rotation 2 of joint 0: expected an angle within a quarter \
                            turn (1.5708), as it is the middle one of three, got ";
            assert!(error.to_string().starts_with(expected), "{error}");
        }
        // Short of a quarter turn all is well.
        let swing = |amplitude: f64| held(kind, Coordinate::Rotation2, &cosine(amplitude));
        let solution = converged(try_solve(&swing(1.5), PERIOD, 31).unwrap());
        let angle = JointQuantity::Coordinate(Coordinate::Rotation2);
        let angle = solution.joint(0, angle, &[0.0, 0.5 * PERIOD]).unwrap();
        assert!((angle[0] - 1.5).abs() < 1e-8 && (angle[1] + 1.5).abs() < 1e-8);
        assert!(try_solve(&swing(1.58), PERIOD, 31).is_err());
    }
}

#[test]
fn a_march_ends_where_a_middle_angle_does() {
    let model = held(JointKind::Free, Coordinate::Rotation2, &steady(1.0));
    let until = |end: f64| {
        let options = MarchOptions::with_step(0.02, MarchEnd::Duration(end));
        Solution::march(&model, &options, &mut |_, _| true)
    };
    let solution = converged(until(1.5).unwrap());
    let angle = JointQuantity::Coordinate(Coordinate::Rotation2);
    let angle = solution.joint(0, angle, &[1.5]).unwrap()[0];
    assert!((angle - 1.5).abs() < 1e-8, "{angle}");
    let error = until(1.7).unwrap_err().to_string();
    assert!(
        error.contains("prescribed rotation 2 of joint 0: expected"),
        "{error}"
    );
    let at = |angle: f64| {
        let signal = Signal::constant(angle).unwrap();
        let model = held(JointKind::Spherical, Coordinate::Rotation2, &signal);
        Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| true)
    };
    assert!(at(1.5).is_ok());
    assert_eq!(at(-1.6).unwrap_err().kind(), ErrorKind::Model);
}
