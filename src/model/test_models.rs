//! Models that tests share.

use super::*;
use crate::elements::{BeamLoadFrame, JointKind, MaxwellBranch, NodeForceLaw};
use crate::elements::{Coordinate, LoadFrame};
use crate::motion::rotation_from_vector;
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::f64::consts::TAU;
use std::sync::Arc;

fn at(joint: usize) -> JointCoordinate {
    JointCoordinate {
        joint,
        coordinate: Coordinate::Rotation1,
    }
}

/// A flexible crank and rocker with a flexible coupler, in a plane, and its period.
pub(crate) fn four_bar(elements: usize, degree: usize, frequency: f64) -> (Model, f64) {
    let mut model = Model::new();
    let point = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let [a, b, c, d] = [
        point(0.0, 0.0),
        point(0.0, 0.3),
        point(1.0, 0.8),
        point(1.0, 0.0),
    ];
    let section = SectionInput::diagonal(
        &[4e6, 1.4e6, 1.4e6, 60.0, 80.0, 80.0],
        &[0.3, 1e-5, 5e-6, 5e-6],
    );
    let section = section.unwrap();
    let bars = [(&a, &b), (&b, &c), (&c, &d)].map(|(from, to)| {
        model
            .add_straight_beam(from, to, &Vector3::z(), &section, elements, degree)
            .unwrap()
    });
    let mut hinge = |first, second, place: &Vector3<f64>, kind| {
        let frame = Model::frame_at("axis", place, &Vector3::z()).unwrap();
        model
            .add_joint(kind, first, second, &frame, &frame)
            .unwrap()
    };
    let motor = hinge(None, Some(bars[0].first_node), &a, JointKind::Revolute);
    hinge(
        Some(bars[0].last_node),
        Some(bars[1].first_node),
        &b,
        JointKind::Spherical,
    );
    let knee = hinge(
        Some(bars[1].last_node),
        Some(bars[2].first_node),
        &c,
        JointKind::Revolute,
    );
    hinge(None, Some(bars[2].last_node), &d, JointKind::Revolute);
    let turn = Signal::harmonics(0.0, frequency, &[0.0], &[0.2]).unwrap();
    model.prescribe(at(motor), &turn).unwrap();
    let knee = at(knee);
    let branches = vec![MaxwellBranch {
        stiffness: 2.0,
        relaxation_time: 0.5 / frequency,
    }];
    model.add_viscoelastic(knee, 1.0, 0.0, &branches).unwrap();
    (model, TAU / frequency)
}

/// A hub that turns at 1, with a clamped flexible blade, in gravity.
pub(crate) fn rotor(elements: usize) -> (Model, f64) {
    let mut model = Model::new();
    let (root, tip) = (Vector3::new(0.2, 0.0, 0.0), Vector3::new(10.2, 0.0, 0.0));
    let ball = Matrix3::identity();
    let hub = model.add_rigid_body(2.0, &Vector3::zeros(), &ball).unwrap();
    let section = SectionInput::diagonal(
        &[1e6, 3e5, 3e5, 800.0, 2600.0, 5100.0],
        &[1.0, 0.02, 0.01, 0.01],
    );
    let blade = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &section.unwrap(), elements, 2)
        .unwrap();
    let axis = Model::frame_at("axis", &Vector3::zeros(), &Vector3::z()).unwrap();
    let shaft = model
        .add_joint(JointKind::Revolute, None, Some(hub), &axis, &axis)
        .unwrap();
    let frame = Model::frame_at("axis", &root, &Vector3::x()).unwrap();
    model
        .add_joint(
            JointKind::Rigid,
            Some(hub),
            Some(blade.first_node),
            &frame,
            &frame,
        )
        .unwrap();
    let turn = Signal::harmonics(0.0, 1.0, &[], &[]).unwrap();
    model.prescribe(at(shaft), &turn).unwrap();
    model.set_gravity([0.0, -0.5, 0.0].map(|g| Signal::constant(g).unwrap()));
    (model, TAU)
}

/// A clamped beam under a turning force at its tip, and the period.
pub(crate) fn hingeless() -> (Model, f64) {
    let mut model = Model::new();
    let (root, tip) = (Vector3::zeros(), Vector3::new(1.0, 0.0, 0.0));
    let section = SectionInput::diagonal(
        &[4e6, 1.4e6, 1.4e6, 60.0, 80.0, 80.0],
        &[0.3, 1e-5, 5e-6, 5e-6],
    );
    let beam = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &section.unwrap(), 2, 2)
        .unwrap();
    let frame = Model::frame_at("axis", &root, &Vector3::z()).unwrap();
    model
        .add_joint(
            JointKind::Rigid,
            None,
            Some(beam.first_node),
            &frame,
            &frame,
        )
        .unwrap();
    let mut force: [Option<Signal>; 6] = Default::default();
    force[1] = Some(Signal::harmonics(0.0, 0.0, &[1.0], &[0.0]).unwrap());
    force[2] = Some(Signal::harmonics(0.0, 0.0, &[0.0], &[1.0]).unwrap());
    model
        .add_load(beam.last_node, LoadFrame::Space, force)
        .unwrap();
    (model, TAU / 20.0)
}

/// Elements of each kind, which need not be able to move: bodies on all joints, a damped beam whose
/// section changes, springs, dampers, internal states, a user's force and loads.
pub(crate) fn all_elements() -> (Model, f64) {
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
        let (stiffness, mass) = (
            [4e3, 1.4e3, 1.4e3, 60.0, 80.0, 90.0],
            [0.3, 1e-3, 5e-4, 5e-4],
        );
        let mut section = SectionInput::diagonal(&stiffness.map(|x| x * size), &mass).unwrap();
        section.damp_proportionally(1e-2).unwrap();
        section
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
    model.add_actuator(at(5), &wave).unwrap();
    model.prescribe(at(0), &wave).unwrap();
    let branches = [3.0, 5.0].map(|stiffness| MaxwellBranch {
        stiffness,
        relaxation_time: 0.1 * stiffness,
    });
    model.add_viscoelastic(at(2), 1.0, 0.0, &branches).unwrap();
    let matrix = Matrix6::from_fn(|i, j| if i == j { 2.0 } else { 0.2 });
    model
        .add_viscous_damper(Some(bodies[4]), Some(bodies[7]), None, &matrix)
        .unwrap();
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
    model.set_gravity([0.0, -0.5, 0.2].map(|g| Signal::constant(g).unwrap()));
    (model, 1.3)
}

/// One model of each kind, with periods.
pub(crate) fn moving_models() -> Vec<(Model, f64)> {
    vec![four_bar(2, 2, 3.0), rotor(2)]
}
