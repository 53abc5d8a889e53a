//! Static equilibria and steady rotation against closed forms.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::GridState;
use periodyn::elements::{Coordinate, LoadFrame, NodeForceLaw};
use periodyn::error::ErrorKind;
use periodyn::fourier::TimeGrid;
use periodyn::model::*;
use periodyn::output::{
    BeamQuantity, ForceQuantity, JointQuantity, NodeQuantity, ResolvedIn, Solution,
};
use periodyn::solve::*;
use periodyn::system::{Regime, Standstill, System};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

fn try_statics(model: &Model, options: &StaticOptions) -> periodyn::error::Result<Solution> {
    Solution::solve_static(model, options, &mut |_, _| true)
}

fn statics(model: &Model, options: &StaticOptions) -> Solution {
    let solution = try_statics(model, options).unwrap();
    converged(solution)
}

fn at(time: f64, period: Option<f64>) -> StaticOptions {
    StaticOptions {
        standstill: Standstill {
            time,
            period,
            ..Standstill::default()
        },
        ..StaticOptions::default()
    }
}

fn turning(angular_velocity: Vector3<f64>, axis_point: Vector3<f64>) -> StaticOptions {
    StaticOptions {
        standstill: Standstill {
            angular_velocity,
            axis_point,
            ..Standstill::default()
        },
        ..StaticOptions::default()
    }
}

const MASS: f64 = 1.7;
const ARM: f64 = 0.8;

/// A pendulum on a hinge at the origin about `y`, `angle` away from hanging, towards `x`.
fn pendulum(angle: f64) -> (Model, usize, usize) {
    let mut model = Model::new();
    let centre = Vector3::new(angle.sin(), 0.0, -angle.cos()) * ARM;
    let body = model
        .add_rigid_body(MASS, &centre, &(Matrix3::identity() * 0.2))
        .unwrap();
    let joint = revolute(
        &mut model,
        None,
        Some(body),
        &Vector3::zeros(),
        &-Vector3::y(),
    );
    gravity(&mut model, [0.0, 0.0, -9.81]);
    (model, body, joint)
}

fn position(solution: &Solution, node: usize) -> Vector3<f64> {
    let values = solution.node(node, NodeQuantity::Position, &[0.0]).unwrap();
    Vector3::from_column_slice(&values)
}

#[test]
fn pendulum_aligns_with_the_resultant() {
    // From nearly any start, also horizontal and nearly upright, where no load step helps.
    for angle in [0.0, 0.9, PI / 2.0, 3.1, -2.0] {
        let (mut model, body, joint) = pendulum(angle);
        let side = 6.0;
        add_load(
            &mut model,
            body,
            LoadFrame::Space,
            &[side, 0.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0; 6],
        );
        let solution = statics(&model, &StaticOptions::default());
        let resultant = Vector3::new(side, 0.0, -MASS * 9.81);
        let expected = resultant.normalize() * ARM;
        let found = position(&solution, body);
        // Newton's tolerance is 1e-9: what is left is its square, that is, rounding. From upright,
        // the other equilibrium is as good a solution.
        let off = (found - expected).norm().min((found + expected).norm());
        assert!(off < 1e-13, "{angle}: {off:e}");
        if angle.abs() < 2.5 {
            assert!(
                (found - expected).norm() < 1e-13,
                "{angle}: {found} {expected} {}",
                solution.report()
            );
        }
        let reaction = JointQuantity::Reaction(ResolvedIn::Space);
        let reaction = solution.joint(joint, reaction, &[0.3]).unwrap();
        for i in 0..3 {
            assert!((reaction[i] + resultant[i]).abs() < 1e-12 * resultant.norm());
        }
        assert!(largest(reaction[3..].to_vec()) < 1e-12);
    }
}

#[test]
fn preloaded_spring_against_gravity() {
    let (mut model, _, joint) = pendulum(0.4);
    let (stiffness, rest) = (20.0, 0.7);
    model
        .add_spring_damper(SpringDefinition {
            at: rotation1(joint),
            stiffness,
            damping: 0.5,
            rest,
        })
        .unwrap();
    let solution = statics(&model, &StaticOptions::default());
    let coordinate = JointQuantity::Coordinate(Coordinate::Rotation1);
    let found = solution.joint(joint, coordinate, &[0.0]).unwrap()[0];
    // k (q − q₀) + m g l sin(0.4 + q) = 0.
    let mut q = 0.0f64;
    for _ in 0..50 {
        let weight = MASS * 9.81 * ARM;
        let f = stiffness * (q - rest) + weight * (0.4 + q).sin();
        q -= f / (stiffness + weight * (0.4 + q).cos());
    }
    assert!((found - q).abs() < 1e-13, "{found} {q}");
}

/// A cantilever of two-node elements along `x`, rolled up by a moment about `z` at its end.
fn roll_up(elements: usize, moment: f64) -> (Model, BeamIds) {
    let mut model = Model::new();
    let section = SectionInput::diagonal(&[1e4, 5e3, 5e3, 80.0, 100.0, 100.0], &[1.0; 4]).unwrap();
    let end = Vector3::new(10.0, 0.0, 0.0);
    let ids = model
        .add_straight_beam(
            &Vector3::zeros(),
            &end,
            &Vector3::y(),
            &section,
            elements,
            1,
        )
        .unwrap();
    let frame = periodyn::motion::Motion::identity();
    model
        .add_joint(
            periodyn::elements::JointKind::Rigid,
            None,
            Some(ids.first_node),
            &frame,
            &frame,
        )
        .unwrap();
    let load = [0.0, 0.0, 0.0, 0.0, 0.0, moment];
    add_load(
        &mut model,
        ids.last_node,
        LoadFrame::Follower,
        &load,
        &[0.0; 6],
    );
    (model, ids)
}

#[test]
fn load_steps_roll_a_beam_up() {
    let (elements, length, stiffness) = (16, 10.0, 100.0);
    let moment = 2.0 * TAU * stiffness / length;
    let (model, ids) = roll_up(elements, moment);
    // Each element turns by θ with the curvature 2 tan(θ/2)/h in its middle, so that its energy has
    // the derivative EI κ / cos²(θ/2) = EI κ (1 + (κ h/2)²) with respect to θ.
    let h = length / elements as f64;
    let mut curvature = moment / stiffness;
    for _ in 0..50 {
        let half2 = (0.5 * curvature * h).powi(2);
        let excess = curvature * (1.0 + half2) - moment / stiffness;
        curvature -= excess / (1.0 + 3.0 * half2);
    }
    let total = 2.0 * (0.5 * curvature * h).atan() * elements as f64;
    assert!(total > 1.6 * TAU);
    for least_load_steps in [1, 7, 40] {
        let options = StaticOptions {
            least_load_steps,
            ..StaticOptions::default()
        };
        let solution = statics(&model, &options);
        let rotation = solution
            .node(ids.last_node, NodeQuantity::RotationMatrix, &[0.0])
            .unwrap();
        assert!(
            (rotation[0] - total.cos()).abs() < 1e-11,
            "{} {} {}",
            rotation[0],
            total,
            solution.report()
        );
        assert!((rotation[1] - total.sin()).abs() < 1e-11);
        let force = solution.beam(3, 0.0, BeamQuantity::Force, &[0.0]).unwrap();
        assert!((force[5] - stiffness * curvature).abs() < 1e-10 * moment);
        let reaction = JointQuantity::Reaction(ResolvedIn::Space);
        let reaction = solution.joint(0, reaction, &[0.0]).unwrap();
        assert!((reaction[5] + moment).abs() < 1e-10 * moment);
        assert!(solution.details().guess_iterations >= least_load_steps);
    }
    // From the straight beam Newton's method gets there at once, too: its line search does not take
    // the stretching by large turns for distance.
    let straight = roll_up(elements, 0.0).0;
    let start = statics(&straight, &StaticOptions::default());
    let grid = TimeGrid::new(1, 1.0).unwrap();
    let options = StaticOptions {
        guess: InitialGuess::State(start.prolonged(grid).unwrap()),
        ..StaticOptions::default()
    };
    let direct = statics(&model, &options);
    assert_eq!(direct.details().guess_iterations, 0);
    let rotation = direct
        .node(ids.last_node, NodeQuantity::RotationMatrix, &[0.0])
        .unwrap();
    assert!((rotation[0] - total.cos()).abs() < 1e-11);
    // From a solution close by it takes few iterations, and no steps.
    let near = statics(
        &roll_up(elements, 0.97 * moment).0,
        &StaticOptions::default(),
    );
    let options = StaticOptions {
        guess: InitialGuess::State(near.prolonged(grid).unwrap()),
        ..StaticOptions::default()
    };
    let next = statics(&model, &options);
    assert!(next.details().guess_iterations == 0 && next.details().report.iterations.len() < 12);
}

#[test]
fn what_cannot_be_reached_is_an_outcome() {
    // A link longer than the gap: the crank cannot turn through.
    let mut model = Model::new();
    let ball = Matrix3::identity() * 0.01;
    let points = [0.0, 1.0, 1.5].map(|x| Vector3::new(x, 0.0, 0.0));
    let tip = Vector3::new(1.0, 0.8, 0.0);
    let crank = model
        .add_rigid_body(1.0, &(points[1] * 0.5), &ball)
        .unwrap();
    let link = model
        .add_rigid_body(1.0, &((points[1] + tip) * 0.5), &ball)
        .unwrap();
    let z = Vector3::z();
    let motor = revolute(&mut model, None, Some(crank), &points[0], &z);
    revolute(&mut model, Some(crank), Some(link), &points[1], &z);
    let frame = Model::frame_at("axis", &tip, &z).unwrap();
    model
        .add_joint(
            periodyn::elements::JointKind::Spherical,
            None,
            Some(link),
            &frame,
            &frame,
        )
        .unwrap();
    model
        .prescribe(rotation1(motor), &Signal::constant(-1.2).unwrap())
        .unwrap();
    let failed = try_statics(&model, &StaticOptions::default()).unwrap();
    assert_ne!(failed.outcome(), Outcome::Converged);
    let report = failed.report();
    assert!(
        report.starts_with("Static solve: not converged"),
        "{report}"
    );
    assert!(
        report.contains("load steps ended at the fraction 0."),
        "{report}"
    );

    let (mut model, body, _) = pendulum(0.3);
    add_load(
        &mut model,
        body,
        LoadFrame::Space,
        &[3.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        &[0.0; 6],
    );
    let options = StaticOptions {
        newton: NewtonOptions {
            tolerance: 1e-12,
            iteration_limit: 1,
        },
        guess: InitialGuess::State(
            statics(&pendulum(0.3).0, &StaticOptions::default())
                .prolonged(TimeGrid::new(1, 1.0).unwrap())
                .unwrap(),
        ),
        ..StaticOptions::default()
    };
    let limited = try_statics(&model, &options).unwrap();
    assert_eq!(limited.outcome(), Outcome::IterationLimit);

    let mut calls = 0;
    let cancelled = Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| {
        calls += 1;
        false
    });
    assert_eq!(cancelled.unwrap().outcome(), Outcome::Cancelled);
    assert_eq!(calls, 1);
}

#[test]
fn a_free_body_is_named() {
    let mut model = Model::new();
    let ball = Matrix3::identity();
    for x in [0.0, 1.0] {
        model
            .add_rigid_body(1.0, &Vector3::new(x, 0.0, 0.0), &ball)
            .unwrap();
    }
    let origin = periodyn::motion::Motion::identity();
    let weld = periodyn::elements::JointKind::Rigid;
    model
        .add_joint(weld, None, Some(0), &origin, &origin)
        .unwrap();
    for loaded in [false, true] {
        if loaded {
            gravity(&mut model, [0.0, 0.0, -9.81]);
        }
        let solution = try_statics(&model, &StaticOptions::default()).unwrap();
        assert_eq!(solution.outcome(), Outcome::Singular);
        assert!(
            solution.report().contains("node 1 is free to move"),
            "{}",
            solution.report()
        );
    }
}

#[test]
fn loads_are_those_of_the_time() {
    let (mut model, body, joint) = pendulum(0.0);
    model
        .add_load(
            body,
            LoadFrame::Space,
            [
                Some(Signal::harmonics(1.0, 0.0, &[2.0], &[5.0]).unwrap()),
                None,
                None,
                None,
                None,
                None,
            ],
        )
        .unwrap();
    let coordinate = JointQuantity::Coordinate(Coordinate::Rotation1);
    for (time, period) in [
        (0.0, None),
        (0.7, Some(4.0)),
        (-11.3, Some(4.0)),
        (0.0, Some(9.0)),
    ] {
        let solution = statics(&model, &at(time, period));
        let phase = TAU * time / period.unwrap_or(1.0);
        let force = 1.0 + 2.0 * phase.cos() + 5.0 * phase.sin();
        let angle = (force / (MASS * 9.81)).atan();
        for t in [0.0, 0.37, 5.0] {
            let found = solution.joint(joint, coordinate, &[t]).unwrap()[0];
            assert!((found - angle).abs() < 1e-13, "{found} {angle}");
        }
        let still = solution
            .node(body, NodeQuantity::Velocity, &[0.0, 0.4])
            .unwrap();
        assert_eq!(largest(still), 0.0);
        assert_eq!(solution.grid().points(), 1);
        let between = solution.diagnostics().between;
        assert!(between.force < 1e-12 && between.constraint < 1e-12);
    }
    let error = try_statics(&model, &at(0.7, None)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Value);
    assert!(
        error
            .to_string()
            .starts_with("options.period: expected the period"),
        "{error}"
    );
    // A motion that is not periodic in any period may be looked at, too.
    model
        .prescribe(
            rotation1(joint),
            &Signal::harmonics(0.1, 0.3, &[], &[]).unwrap(),
        )
        .unwrap();
    let solution = statics(&model, &at(2.0, Some(4.0)));
    let found = solution.joint(joint, coordinate, &[0.0]).unwrap()[0];
    assert!((found - 0.7).abs() < 1e-13);
    let phase = TAU * 2.0 / 4.0;
    let force = 1.0 + 2.0 * phase.cos() + 5.0 * phase.sin();
    let torque = ARM * (MASS * 9.81 * 0.7f64.sin() - force * 0.7f64.cos());
    let effort = JointQuantity::DrivingEffort(Coordinate::Rotation1);
    let found = solution.joint(joint, effort, &[0.0]).unwrap()[0];
    assert!((found - torque).abs() < 1e-12 * torque.abs());
}

#[test]
fn a_turning_rod_stretches() {
    let (length, stiffness, mass): (f64, f64, f64) = (2.0, 5e4, 3.0);
    let speed = 40.0;
    // EA X'' + m Ω² X = 0, X(0) = 0, X'(L) = 1.
    let k = speed * (mass / stiffness).sqrt();
    assert!(k * length > 0.6);
    let place = Vector3::new(0.3, -2.0, 0.7);
    let axis = Vector3::new(0.0, 0.6, 0.8);
    let along = Vector3::x();
    let mut model = Model::new();
    let section = SectionInput::diagonal(
        &[stiffness, 2e4, 2e4, 300.0, 400.0, 400.0],
        &[mass, 0.02, 0.01, 0.01],
    );
    let ids = model
        .add_straight_beam(
            &place,
            &(place + along * length),
            &Vector3::y(),
            &section.unwrap(),
            2,
            7,
        )
        .unwrap();
    let frame = periodyn::motion::Motion::new(Matrix3::identity(), place);
    let weld = periodyn::elements::JointKind::Rigid;
    let root = model
        .add_joint(weld, None, Some(ids.first_node), &frame, &frame)
        .unwrap();
    // Gravity along the axis bends it a little; here none.
    let solution = statics(&model, &turning(axis * speed, place + axis * 3.0));
    let tip = length_of(k, length);
    let found = position(&solution, ids.last_node) - place;
    // The products of inertia of the section vanish, so that the rod stays straight. Degree 7
    // leaves (k h)^8 / 8! of it, about 1e-9.
    assert!(
        (found - along * tip).amax() < 1e-9 * length,
        "{found} {tip}"
    );
    let velocity = solution
        .node(ids.last_node, NodeQuantity::Velocity, &[0.1])
        .unwrap();
    let expected = (axis * speed).cross(&found);
    for i in 0..3 {
        assert!((velocity[i] - expected[i]).abs() < 1e-12 * expected.norm());
        assert!((velocity[3 + i] - axis[i] * speed).abs() < 1e-12 * speed);
    }
    let acceleration = solution
        .node(ids.last_node, NodeQuantity::Acceleration, &[0.1])
        .unwrap();
    let expected = (axis * speed).cross(&expected);
    for i in 0..3 {
        assert!((acceleration[i] - expected[i]).abs() < 1e-12 * expected.norm());
        assert!(acceleration[3 + i].abs() < 1e-9);
    }
    let reaction = JointQuantity::Reaction(ResolvedIn::Space);
    let reaction = solution.joint(root, reaction, &[0.0]).unwrap();
    let tension = stiffness * (1.0 / (k * length).cos() - 1.0);
    assert!(
        (reaction[0] + tension).abs() < 1e-7 * tension,
        "{} {tension}",
        reaction[0]
    );
    assert!(solution.diagnostics().between.force < 1e-12);
}

fn length_of(k: f64, length: f64) -> f64 {
    (k * length).tan() / k
}

#[test]
fn conical_pendulum() {
    // Far from the origin, with its damper turning along, and no stiffness at all.
    let place = Vector3::new(5.0, -3.0, 2.0);
    let (speed, g) = (6.0, 9.81);
    let mut model = Model::new();
    let start = 0.5f64;
    let centre = place + Vector3::new(start.sin(), 0.0, -start.cos()) * ARM;
    // A point mass, but for a ball that is not felt: its inertia is the same about all axes.
    let body = model
        .add_rigid_body(MASS, &centre, &(Matrix3::identity() * 1e-3))
        .unwrap();
    let joint = revolute(&mut model, None, Some(body), &place, &-Vector3::y());
    spring(&mut model, rotation1(joint), 0.0, 3.0);
    gravity(&mut model, [0.0, 0.0, -g]);
    let solution = statics(&model, &turning(Vector3::z() * speed, place));
    let angle = (g / (speed * speed * ARM)).acos();
    let expected = place + Vector3::new(angle.sin(), 0.0, -angle.cos()) * ARM;
    let found = position(&solution, body);
    assert!((found - expected).norm() < 1e-13, "{found} {expected}");
    let rate = solution
        .joint(joint, JointQuantity::Rate(Coordinate::Rotation1), &[0.0])
        .unwrap();
    assert_eq!(rate, [0.0]);

    // Gravity off the axis would turn against everything else.
    let tilted = Vector3::new(0.1, 0.0, 1.0) * speed;
    let error = try_statics(&model, &turning(tilted, place)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotPeriodic);
    assert!(
        error
            .to_string()
            .starts_with("gravity: expected a direction along the axis")
    );
}

#[test]
fn a_space_fixed_load_turns_with_the_frame() {
    let place = Vector3::zeros();
    let (mut model, body, _) = pendulum(0.2);
    gravity(&mut model, [0.0; 3]);
    let speed = 4.0;
    add_load(
        &mut model,
        body,
        LoadFrame::Space,
        &[0.0, 0.0, -9.81 * MASS, 0.0, 0.0, 0.0],
        &[0.0; 6],
    );
    let solution = statics(&model, &turning(Vector3::z() * speed, place));
    // The inertia of the pendulum's ball is the same about all axes; below the critical speed it
    // hangs.
    assert!(speed * speed * ARM > 9.81);
    let angle = (9.81 / (speed * speed * ARM)).acos();
    let found = position(&solution, body);
    assert!((found.x - ARM * angle.sin()).abs() < 1e-13, "{found}");
}

/// A force along x of `−c v₂²`, with its tangents, along the axes of `frame`.
fn outward_drag(c: f64, frame: LoadFrame, gives_tangents: bool) -> NodeForceLaw {
    NodeForceLaw {
        function: Arc::new(move |input, output| {
            let v = input.velocities[0][1];
            output.forces[0][0] = -c * v * v;
            if let Some((_, by_velocity)) = &mut output.tangents {
                by_velocity[(0, 1)] = -2.0 * c * v;
            }
            Ok(())
        }),
        gives_tangents,
        frame,
    }
}

#[test]
fn forces_of_the_user_see_the_velocities_of_a_steady_rotation() {
    // A mass on a radial slide with a spring: k x = m ω² (r + x) − c (ω (r + x))².
    let (mass, stiffness, radius, speed, c) = (1.4f64, 900.0, 5.0, 4.0, 0.7);
    let square = speed * speed;
    let linear = mass * square - 2.0 * c * square * radius - stiffness;
    let constant = mass * square * radius - c * square * radius * radius;
    let quadratic = -c * square;
    let root = (linear * linear - 4.0 * quadratic * constant).sqrt();
    let exact = (-linear - root) / (2.0 * quadratic);
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        for gives_tangents in [true, false] {
            let (mut model, at) = mass_on_a_slide(mass, &Vector3::x());
            let spring = SpringDefinition {
                at,
                stiffness,
                damping: 20.0,
                rest: 0.0,
            };
            model.add_spring_damper(spring).unwrap();
            let law = outward_drag(c, frame, gives_tangents);
            let force = model.add_node_forces(&[0], law).unwrap();
            let options = turning(Vector3::z() * speed, Vector3::new(-radius, 0.0, 0.0));
            let solution = statics(&model, &options);
            let x = position(&solution, 0).x;
            assert!((x - exact).abs() < 1e-12 * radius, "{x} {exact}");
            let quantity = ForceQuantity::OnNode(0, LoadFrame::Space);
            let found = solution.force(force, quantity, &[0.0]).unwrap();
            let velocity = solution.node(0, NodeQuantity::Velocity, &[0.0]).unwrap();
            assert!((velocity[1] - speed * (radius + x)).abs() < 1e-12 * speed * radius);
            assert!((found[0] + c * velocity[1] * velocity[1]).abs() < 1e-10);
            // From load 0 to 1 at once, in full steps; the square of an increment is left, or what
            // differences leave.
            let start = InitialGuess::State(GridState::at_points(
                &System::in_regime(&model, Regime::Standstill(options.standstill)).unwrap(),
                1,
            ));
            let cold = statics(
                &model,
                &StaticOptions {
                    guess: start,
                    ..options
                },
            );
            let iterations = &cold.details().report.iterations;
            for pair in iterations.windows(2) {
                let (before, after) = (pair[0].increment, pair[1].increment);
                assert!(
                    after <= (before * before).max(1e-9 * before),
                    "{iterations:?}"
                );
            }
            assert!(iterations[0].increment > 0.01 && iterations.len() <= 5);
        }
    }
}
