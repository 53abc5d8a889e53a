//! Mechanisms of rigid bodies, and their periods.

use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::model::{JointCoordinate, Model, Signal, SpringDefinition};
use std::f64::consts::TAU;

/// A bar of this mass between two points, as thick as a tenth of its length.
fn bar(model: &mut Model, mass: f64, from: &Vector3<f64>, to: &Vector3<f64>) -> Option<usize> {
    let along = to - from;
    let square = along.norm_squared();
    let inertia =
        (Matrix3::identity() * (1.01 * square) - along * along.transpose()) * (mass / 12.0);
    Some(
        model
            .add_rigid_body(mass, &((from + to) / 2.0), &inertia)
            .unwrap(),
    )
}

fn join(
    model: &mut Model,
    kind: JointKind,
    bodies: [Option<usize>; 2],
    point: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> usize {
    let frame = Model::frame_at("axis", point, axis).unwrap();
    model
        .add_joint(kind, bodies[0], bodies[1], &frame, &frame)
        .unwrap()
}

fn rotation(joint: usize) -> JointCoordinate {
    JointCoordinate {
        joint,
        coordinate: Coordinate::Rotation1,
    }
}

/// Turns a joint once a period.
fn drive(model: &mut Model, joint: usize, period: f64) {
    let turn = Signal::harmonics(0.0, TAU / period, &[], &[]).unwrap();
    model.prescribe(rotation(joint), &turn).unwrap();
}

fn spring(model: &mut Model, joint: usize, stiffness: f64, damping: f64) {
    let spring = SpringDefinition {
        at: rotation(joint),
        stiffness,
        damping,
        rest: 0.0,
    };
    model.add_spring_damper(spring).unwrap();
}

fn gravity(model: &mut Model) {
    let acceleration = [0.0, -9.81, 0.0].map(|x| Signal::constant(x).unwrap());
    model.set_gravity(acceleration);
}

/// A driven slider-crank, whose prismatic joint has a constraint too many.
pub fn slider_crank() -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let [shaft, pin, wrist] = [0.0, 0.15, 0.45].map(|x| Vector3::new(x, 0.0, 0.0));
    let crank = m
        .add_rigid_body(0.5, &shaft, &(Matrix3::identity() * 1e-3))
        .unwrap();
    let rod = bar(m, 0.0666, &pin, &wrist);
    let slider = m
        .add_rigid_body(0.04, &wrist, &(Matrix3::identity() * 1e-5))
        .unwrap();
    let (crank, slider, z) = (Some(crank), Some(slider), Vector3::z());
    let motor = join(m, JointKind::Revolute, [None, crank], &shaft, &z);
    join(m, JointKind::Revolute, [crank, rod], &pin, &z);
    join(m, JointKind::Spherical, [rod, slider], &wrist, &z);
    join(
        m,
        JointKind::Prismatic,
        [None, slider],
        &wrist,
        &Vector3::x(),
    );
    drive(m, motor, 0.5);
    (model, 0.5)
}

/// A double pendulum with springs and dampers, shaken by a torque.
pub fn double_pendulum() -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let (period, z) = (2.0, Vector3::z());
    let [top, middle, bottom] = [0.0, -1.0, -1.8].map(|y| Vector3::new(0.0, y, 0.0));
    let upper = bar(m, 1.0, &top, &middle);
    let lower = bar(m, 0.7, &middle, &bottom);
    let shoulder = join(m, JointKind::Revolute, [None, upper], &top, &z);
    let elbow = join(m, JointKind::Revolute, [upper, lower], &middle, &z);
    spring(m, shoulder, 4.0, 1.5);
    spring(m, elbow, 2.0, 0.8);
    gravity(m);
    let torque = Signal::harmonics(0.0, 0.0, &[3.0], &[1.0]).unwrap();
    m.add_actuator(rotation(shoulder), &torque).unwrap();
    (model, period)
}

/// A crank and rocker of revolutes in a plane, three constraints of which depend on others.
pub fn planar_linkage() -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let (period, z) = (0.6, Vector3::z());
    let corners = [(0.0, 0.0), (0.0, 0.12), (0.24, 0.24), (0.24, 0.0)];
    let [a, b, c, d] = corners.map(|(x, y)| Vector3::new(x, y, 0.0));
    let [crank, coupler, rocker] =
        [(0.3, a, b), (0.6, b, c), (0.5, c, d)].map(|(mass, from, to)| bar(m, mass, &from, &to));
    let motor = join(m, JointKind::Revolute, [None, crank], &a, &z);
    join(m, JointKind::Revolute, [crank, coupler], &b, &z);
    join(m, JointKind::Revolute, [coupler, rocker], &c, &z);
    let pivot = join(m, JointKind::Revolute, [None, rocker], &d, &z);
    spring(m, pivot, 5.0, 0.3);
    gravity(m);
    drive(m, motor, period);
    (model, period)
}

/// A crank that rocks a lever across it by a coupler with a ball and a cross.
pub fn spatial_linkage() -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let period = 0.8;
    let corners = [(0.0, 0.0), (0.1, 0.0), (0.35, 0.3), (0.35, 0.0)];
    let [a, b, c, d] = corners.map(|(x, z)| Vector3::new(x, 0.0, z));
    let [crank, coupler, lever] =
        [(0.3, a, b), (0.6, b, c), (0.5, c, d)].map(|(mass, from, to)| bar(m, mass, &from, &to));
    let (y, z) = (Vector3::y(), Vector3::z());
    let motor = join(m, JointKind::Revolute, [None, crank], &a, &z);
    join(m, JointKind::Spherical, [crank, coupler], &b, &z);
    let across = Vector3::new(-0.3, 0.0, 0.25);
    let cross = Model::cross_frame(&c, &y, &across).unwrap();
    m.add_joint(JointKind::Universal, coupler, lever, &cross, &cross)
        .unwrap();
    join(m, JointKind::Revolute, [None, lever], &d, &y);
    drive(m, motor, period);
    (model, period)
}
