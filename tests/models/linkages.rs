//! Mechanisms of rigid bodies, and their periods.

use super::parts::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::JointKind::{Prismatic, Revolute, Spherical, Universal};
use periodyn::model::{Model, Signal};

/// A bar of this mass between two points, as thick as a tenth of its length.
fn bar(model: &mut Model, mass: f64, from: &Vector3<f64>, to: &Vector3<f64>) -> Option<usize> {
    let along = to - from;
    let square = along.norm_squared();
    let inertia =
        (Matrix3::identity() * (1.01 * square) - along * along.transpose()) * (mass / 12.0);
    let centre = (from + to) / 2.0;
    Some(model.add_rigid_body(mass, &centre, &inertia).unwrap())
}

/// A driven slider-crank, whose prismatic joint has a constraint too many.
pub fn rigid_slider_crank() -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let [shaft, pin, wrist] = [0.0, 0.15, 0.45].map(|x| Vector3::new(x, 0.0, 0.0));
    let crank = Some(ball(m, 0.5, 1e-3, &shaft));
    let rod = bar(m, 0.0666, &pin, &wrist);
    let slider = Some(ball(m, 0.04, 1e-5, &wrist));
    let (x, z) = (Vector3::x(), Vector3::z());
    let motor = join(m, Revolute, [None, crank], &shaft, &z);
    join(m, Revolute, [crank, rod], &pin, &z);
    join(m, Spherical, [rod, slider], &wrist, &z);
    join(m, Prismatic, [None, slider], &wrist, &x);
    drive(m, motor, 0.5);
    (model, 0.5)
}

/// A double pendulum of bars with springs and dampers, shaken by a torque.
pub fn sprung_double_pendulum() -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let z = Vector3::z();
    let [top, middle, bottom] = [0.0, -1.0, -1.8].map(|y| Vector3::new(0.0, y, 0.0));
    let upper = bar(m, 1.0, &top, &middle);
    let lower = bar(m, 0.7, &middle, &bottom);
    let shoulder = rotation1(join(m, Revolute, [None, upper], &top, &z));
    let elbow = rotation1(join(m, Revolute, [upper, lower], &middle, &z));
    spring(m, shoulder, 4.0, 1.5);
    spring(m, elbow, 2.0, 0.8);
    gravity(m, [0.0, -9.81, 0.0]);
    let torque = Signal::harmonics(0.0, 0.0, &[3.0], &[1.0]).unwrap();
    m.add_actuator(shoulder, &torque).unwrap();
    (model, 2.0)
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
    let motor = join(m, Revolute, [None, crank], &a, &z);
    join(m, Revolute, [crank, coupler], &b, &z);
    join(m, Revolute, [coupler, rocker], &c, &z);
    let pivot = join(m, Revolute, [None, rocker], &d, &z);
    spring(m, rotation1(pivot), 5.0, 0.3);
    gravity(m, [0.0, -9.81, 0.0]);
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
    let motor = join(m, Revolute, [None, crank], &a, &z);
    join(m, Spherical, [crank, coupler], &b, &z);
    let across = Vector3::new(-0.3, 0.0, 0.25);
    let cross = Model::cross_frame(&c, &y, &across).unwrap();
    m.add_joint(Universal, coupler, lever, &cross, &cross)
        .unwrap();
    join(m, Revolute, [None, lever], &d, &y);
    drive(m, motor, period);
    (model, period)
}

/// A hub that a shaft along z turns by `turn`, and a rigid blade of 2 m along x, on a hinge about
/// `axis`; the blade's node, and the joints of shaft and hinge.
pub fn hinged_blade(turn: &Signal, axis: &Vector3<f64>) -> (Model, usize, [usize; 2]) {
    let (at, length, mass) = (0.3, 2.0, 3.0);
    let mut model = Model::new();
    let hub = ball(&mut model, 1.0, 1.0, &Vector3::zeros());
    let middle = Vector3::x() * (at + 0.5 * length);
    let rod = Vector3::new(0.0, 1.0, 1.0) * (mass * length * length / 12.0);
    let rod = Matrix3::from_diagonal(&rod);
    let blade = model.add_rigid_body(mass, &middle, &rod).unwrap();
    let (origin, z) = (Vector3::zeros(), Vector3::z());
    let shaft = revolute(&mut model, None, Some(hub), &origin, &z);
    let place = Vector3::x() * at;
    let hinge = revolute(&mut model, Some(hub), Some(blade), &place, axis);
    model.prescribe(rotation1(shaft), turn).unwrap();
    (model, blade, [shaft, hinge])
}
