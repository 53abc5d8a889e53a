//! A model with elements of each kind.

use super::parts::*;
use nalgebra::{Matrix3, Matrix6, Vector3};
use periodyn::elements::{
    BeamLoadFrame, BushingAngles, ControllerInput, ControllerLaw, ControllerOutput,
    ControllerState, Coordinate, JointKind, LoadFrame, MaxwellBranch, NodeForceLaw,
};
use periodyn::model::*;
use periodyn::motion::{Motion, rotation_from_vector};
use std::sync::Arc;

/// A controller of three coordinates on two, with none or two states; its tangents are exact.
fn observer(count: usize) -> ControllerLaw {
    let function = move |input: &ControllerInput, output: &mut ControllerOutput| {
        let (q, v, mut x) = (input.values, input.rates, [0.0; 2]);
        x[..count].copy_from_slice(input.states);
        output.efforts[0] = 0.7 * q[0] - 0.3 * v[2] + 0.2 * q[1] * v[0] + x[0];
        output.efforts[1] = -0.4 * q[2] * q[2] + 0.1 * v[1] - 0.5 * x[1] * q[0];
        let rates = [
            q[1] - 2.0 * x[0] + 0.3 * v[0],
            0.6 * v[2] * v[1] - x[1] + 0.2 * x[0],
        ];
        output.state_rates.copy_from_slice(&rates[..count]);
        if let Some([by_value, by_rate, by_state]) = &mut output.tangents {
            for (row, column, entry) in [
                (0, 0, 0.7),
                (0, 1, 0.2 * v[0]),
                (1, 2, -0.8 * q[2]),
                (1, 0, -0.5 * x[1]),
            ] {
                by_value[(row, column)] = entry;
            }
            by_rate[(0, 2)] = -0.3;
            by_rate[(0, 0)] = 0.2 * q[1];
            by_rate[(1, 1)] = 0.1;
            if count > 0 {
                by_state[(0, 0)] = 1.0;
                by_state[(1, 1)] = -0.5 * q[0];
                by_value[(2, 1)] = 1.0;
                by_state[(2, 0)] = -2.0;
                by_rate[(2, 0)] = 0.3;
                by_rate[(3, 2)] = 0.6 * v[1];
                by_rate[(3, 1)] = 0.6 * v[2];
                by_state[(3, 1)] = -1.0;
                by_state[(3, 0)] = 0.2;
            }
        }
        Ok(())
    };
    ControllerLaw {
        function: Arc::new(function),
        gives_tangents: true,
    }
}

/// Elements of each kind, which need not be able to move: bodies on all joints, a damped beam whose
/// section changes, springs, dampers, internal states, a bushing, a relation between coordinates, a
/// user's force, controllers and loads.
pub fn all_elements() -> (Model, f64) {
    let mut model = Model::new();
    let frame = |x: f64| {
        let turn = rotation_from_vector(&Vector3::new(0.3 * x, 0.2, -0.1 * x));
        Motion::new(turn, Vector3::new(x, 0.4 * x * x, 0.1))
    };
    let kinds = [
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Cylindrical,
        JointKind::Screw { pitch: 5.0 },
        JointKind::Planar,
        JointKind::Universal,
        JointKind::Spherical,
        JointKind::Free,
        JointKind::Rigid,
    ];
    let mut bodies = Vec::new();
    for (i, kind) in kinds.into_iter().enumerate() {
        let here = frame(0.3 * (i + 1) as f64);
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.25));
        let body = model.add_rigid_body(1.5, &here.position, &inertia).unwrap();
        let joint = model.add_joint(kind, bodies.last().copied(), Some(body), &here, &here);
        assert_eq!(joint.unwrap(), i);
        bodies.push(body);
    }
    let section = |size: f64| {
        let stiffness = [4e3, 1.4e3, 1.4e3, 60.0, 80.0, 90.0].map(|x| x * size);
        damped_section(&stiffness, &[0.3, 1e-3, 5e-4, 5e-4], 1e-2)
    };
    let stations = [(0.0, 1.0), (0.4, 0.7), (1.0, 0.2)].map(|(fraction, size)| SectionStation {
        fraction,
        section: section(size),
        twist: 0.3 * fraction,
    });
    let (from, to) = (Vector3::zeros(), Vector3::new(0.2, 1.0, 0.1));
    let line = straight_line(&from, &to, &Vector3::z()).unwrap();
    let beam = model.add_beam_along(line, &stations, 2, 2).unwrap();
    let strut = model
        .add_strut(Some(bodies[2]), Some(beam.last_node), &Vector3::x(), &to)
        .unwrap();
    let along = JointCoordinate {
        joint: strut,
        coordinate: Coordinate::Displacement1,
    };
    let wave = Signal::harmonics(0.1, 0.0, &[0.3], &[0.2]).unwrap();
    let spring = SpringDefinition {
        at: along,
        stiffness: 30.0,
        damping: 2.0,
        rest: 0.7,
    };
    model.add_spring_damper(spring).unwrap();
    model.add_actuator(rotation1(5), &wave).unwrap();
    model.prescribe(rotation1(0), &wave).unwrap();
    let branches = [3.0, 5.0].map(|stiffness| MaxwellBranch {
        stiffness,
        relaxation_time: 0.1 * stiffness,
    });
    model
        .add_viscoelastic(rotation1(2), 1.0, 0.0, &branches)
        .unwrap();
    let matrix = Matrix6::from_fn(|i, j| if i == j { 2.0 } else { 0.2 });
    model
        .add_viscous_damper(Some(bodies[4]), Some(bodies[7]), None, &matrix)
        .unwrap();
    let unsymmetric = Matrix6::from_fn(|i, j| if i == j { 3.0 } else { 0.1 * i as f64 });
    let (ends, frames) = (
        [3, 7].map(|i: usize| Some(bodies[i])),
        [frame(1.6), frame(1.5)],
    );
    let frames = [&frames[0], &frames[1]];
    let angles = BushingAngles::RotationVector;
    model
        .add_bushing(ends, frames, [&unsymmetric, &matrix], angles)
        .unwrap();
    let slide = JointCoordinate {
        joint: 1,
        coordinate: Coordinate::Displacement1,
    };
    let terms = [(rotation1(2), 0.3), (slide, 1.0), (rotation1(4), -0.2)];
    model.add_relation(&terms, Some(&wave)).unwrap();
    let law = NodeForceLaw {
        function: Arc::new(|input, output| {
            for (force, velocity) in output.forces.iter_mut().zip(input.velocities) {
                // Its differences are exact.
                *force = velocity * -0.3;
            }
            Ok(())
        }),
        gives_tangents: false,
        frame: LoadFrame::Follower,
    };
    model.add_node_forces(&bodies[6..8], law).unwrap();
    let read = [rotation1(4), along, rotation1(2)];
    let act = [along, rotation1(2)];
    let state = |size| ControllerState { initial: 0.1, size };
    model.add_controller(&read, &act, &[], observer(0)).unwrap();
    let states = [state(0.5), state(2.0)];
    model
        .add_controller(&read, &act, &states, observer(2))
        .unwrap();
    let components = || [0; 6].map(|_| Some(wave.clone()));
    model
        .add_load(bodies[8], LoadFrame::Follower, components())
        .unwrap();
    let load = DistributedLoadDefinition {
        first_element: 0,
        elements: 2,
        frame: BeamLoadFrame::Follower,
        components: components(),
        factors: Vec::new(),
    };
    model.add_distributed_load(load).unwrap();
    gravity(&mut model, [0.0, -0.5, 0.2]);
    (model, 1.3)
}
