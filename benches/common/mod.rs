//! Models that the benchmarks share.

#![allow(dead_code)] // no benchmark needs all of it

pub mod mechanisms;
pub mod table;
pub mod timing;

use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame};
use periodyn::model::{JointCoordinate, Model, SectionInput, Signal, SpringDefinition};
use periodyn::motion::Motion;
use std::f64::consts::TAU;

/// Period of the spatial four-bar's motion, in seconds.
pub const PERIOD: f64 = TAU / 0.3;

/// The spatial four-bar of section 7.2 of the paper, with `elements` elements of `degree` to a bar.
pub fn spatial_four_bar(elements: usize, degree: usize) -> Model {
    let a = Vector3::new(-0.4, 0.0, 0.0);
    let b = Vector3::new(-0.75, 0.0, 0.652);
    let c = Vector3::new(0.0, 0.85, 0.2);
    let d = Vector3::new(0.0, 0.85, 0.0);
    let (i1, i2) = (Vector3::x(), Vector3::y());
    let thick = SectionInput::diagonal(
        &[52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0],
        &[1.997, 85.2e-6, 42.6e-6, 42.6e-6],
    )
    .unwrap();
    let thin = SectionInput::diagonal(
        &[13.25e6, 4.22e6, 4.22e6, 45.84, 70.66, 70.66],
        &[0.4992, 5.324e-6, 2.662e-6, 2.662e-6],
    )
    .unwrap();
    let mut model = Model::new();
    let mut bar = |from, to, across, section| {
        model
            .add_straight_beam(from, to, across, section, elements, degree)
            .unwrap()
    };
    let rocker = bar(&a, &b, &i2, &thick);
    let coupler = bar(&b, &c, &i1, &thick);
    let crank = bar(&c, &d, &i1, &thin);
    let mut join = |kind, first, second, frame| {
        model
            .add_joint(kind, first, Some(second), &frame, &frame)
            .unwrap()
    };
    let about = |point, axis| Model::frame_at("axis", point, axis).unwrap();
    let hinge = join(JointKind::Revolute, None, rocker.first_node, about(&a, &i2));
    let coupling = (Some(rocker.last_node), coupler.first_node);
    join(JointKind::Spherical, coupling.0, coupling.1, about(&b, &i2));
    let cross = Model::cross_frame(&c, &i1.cross(&(c - b)), &i1).unwrap();
    join(
        JointKind::Universal,
        Some(coupler.last_node),
        crank.first_node,
        cross,
    );
    let motor = join(JointKind::Revolute, None, crank.last_node, about(&d, &i1));

    let coordinate = Coordinate::Rotation1;
    model
        .add_spring_damper(SpringDefinition {
            at: JointCoordinate {
                joint: hinge,
                coordinate,
            },
            stiffness: 18.0,
            damping: 0.0,
            rest: 0.0,
        })
        .unwrap();
    let mean = 1.0 / 3.0 + 1.0 / 21.0;
    let turn = Signal::harmonics(mean, 0.3, &[-1.0 / 3.0, 0.0, -1.0 / 21.0], &[0.0, 0.1, 0.0]);
    let at = JointCoordinate {
        joint: motor,
        coordinate,
    };
    model.prescribe(at, &turn.unwrap()).unwrap();
    model
}

/// Gravity against axis 3.
fn fall(model: &mut Model) {
    let constant = |value| Signal::constant(value).unwrap();
    model.set_gravity([constant(0.0), constant(0.0), constant(-9.81)]);
}

/// A section with damping of torsion and bending, `seconds` times the stiffness.
fn damped_in_bending(stiffness: &[f64; 6], mass: &[f64; 4], seconds: f64) -> SectionInput {
    let mut section = SectionInput::diagonal(stiffness, mass).unwrap();
    for (i, stiffness) in stiffness.iter().enumerate().skip(3) {
        section.damping[(i, i)] = seconds * stiffness;
    }
    section
}

/// A force on `node` along axis `component` of space.
fn push(model: &mut Model, node: usize, component: usize, force: Signal) {
    let mut components = [(); 6].map(|()| None);
    components[component] = Some(force);
    model.add_load(node, LoadFrame::Space, components).unwrap();
}

/// The shaken nylon rod of `c_examples/forced_cantilever.c`, and its period.
pub fn forced_cantilever(elements: usize, degree: usize) -> (Model, f64) {
    shaken_rod(12.0, elements, degree)
}

/// The same, shaken by a force of this amplitude.
pub fn shaken_rod(force: f64, elements: usize, degree: usize) -> (Model, f64) {
    let (root, tip) = (Vector3::zeros(), Vector3::x());
    let stiffness = [785e3, 250e3, 250e3, 14.0, 19.6, 19.6];
    let nylon = damped_in_bending(&stiffness, &[0.361, 18.0e-6, 9.0e-6, 9.0e-6], 5e-3);
    let mut model = Model::new();
    let rod = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &nylon, elements, degree)
        .unwrap();
    let clamp = Motion::identity();
    model
        .add_joint(JointKind::Rigid, None, Some(rod.first_node), &clamp, &clamp)
        .unwrap();
    fall(&mut model);
    let shake = Signal::harmonics(0.0, 0.0, &[force], &[0.0]).unwrap();
    push(&mut model, rod.last_node, 2, shake);
    (model, 0.3)
}

/// A steel strip of 1 m, all of whose strains are damped by `seconds` times the stiffness, and its
/// period: the tip is pushed by 10 N and shaken by 20 N.
pub fn damped_strip(seconds: f64, axial: f64, elements: usize, degree: usize) -> (Model, f64) {
    let (root, tip) = (Vector3::zeros(), Vector3::x());
    let shear = 0.32 * axial;
    let stiffness = [axial, shear, shear, 35.0, 43.75, 43.75];
    let mut steel = SectionInput::diagonal(&stiffness, &[0.785, 8e-6, 4e-6, 4e-6]).unwrap();
    steel.damping = steel.stiffness * seconds;
    let mut model = Model::new();
    let strip = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &steel, elements, degree)
        .unwrap();
    let clamp = Motion::identity();
    model
        .add_joint(
            JointKind::Rigid,
            None,
            Some(strip.first_node),
            &clamp,
            &clamp,
        )
        .unwrap();
    let shake = Signal::harmonics(10.0, 0.0, &[20.0], &[0.0]).unwrap();
    push(&mut model, strip.last_node, 2, shake);
    (model, TAU / 20.0)
}

/// The blade on a turning hub of `c_examples/rotor_blade.c`, and its period.
pub fn rotor_blade(elements: usize, degree: usize) -> (Model, f64) {
    let (root, tip) = (Vector3::new(0.0, 0.0, 0.5), Vector3::new(0.0, 0.0, 10.5));
    let pitch = 8f64.to_radians();
    let flapwise = Vector3::new(pitch.cos(), pitch.sin(), 0.0);
    let stiffness = [500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6];
    let profile = damped_in_bending(&stiffness, &[20.0, 0.20, 0.15, 0.05], 0.01);
    let mut model = Model::new();
    let hub = model.add_node(&Motion::identity()).unwrap();
    let blade = model
        .add_straight_beam(&root, &tip, &flapwise, &profile, elements, degree)
        .unwrap();
    let shaft = Model::frame_at("shaft", &Vector3::zeros(), &Vector3::x()).unwrap();
    let bearing = model
        .add_joint(JointKind::Revolute, None, Some(hub), &shaft, &shaft)
        .unwrap();
    let clamp = Motion::new(Matrix3::identity(), root);
    model
        .add_joint(
            JointKind::Rigid,
            Some(hub),
            Some(blade.first_node),
            &clamp,
            &clamp,
        )
        .unwrap();
    fall(&mut model);
    let turn = Signal::harmonics(0.0, TAU, &[], &[]).unwrap();
    let at = JointCoordinate {
        joint: bearing,
        coordinate: Coordinate::Rotation1,
    };
    model.prescribe(at, &turn).unwrap();
    let lift = Signal::harmonics(3000.0, 0.0, &[1000.0, 0.0], &[0.0, 200.0]).unwrap();
    push(&mut model, blade.last_node, 0, lift);
    (model, 1.0)
}

/// The slider-crank with a flexible rod of `c_examples/slider_crank.c`, whose crank turns once in
/// `period`.
pub fn slider_crank(elements: usize, degree: usize, period: f64) -> Model {
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let (pin, wrist) = (at(0.15), at(0.45));
    let ball = |inertia: f64| Matrix3::identity() * inertia;
    let mut model = Model::new();
    let crank = model.add_rigid_body(0.5, &at(0.0), &ball(1e-3)).unwrap();
    let slider = model.add_rigid_body(0.04, &wrist, &ball(1e-5)).unwrap();
    let mut steel = SectionInput::diagonal(
        &[5.85e6, 1.95e6, 1.95e6, 10.1, 13.2, 13.2],
        &[0.222, 1.0e-6, 0.5e-6, 0.5e-6],
    )
    .unwrap();
    steel.damp_proportionally(1e-4).unwrap();
    let rod = model
        .add_straight_beam(&pin, &wrist, &Vector3::y(), &steel, elements, degree)
        .unwrap();
    let mut join = |kind, first, second, point: &Vector3<f64>, axis: &Vector3<f64>| {
        let frame = Model::frame_at("axis", point, axis).unwrap();
        model
            .add_joint(kind, first, second, &frame, &frame)
            .unwrap()
    };
    let (turning, axis) = (JointKind::Revolute, Vector3::z());
    let bearing = join(turning, None, Some(crank), &at(0.0), &axis);
    join(turning, Some(crank), Some(rod.first_node), &pin, &axis);
    join(turning, Some(rod.last_node), Some(slider), &wrist, &axis);
    join(
        JointKind::Prismatic,
        None,
        Some(slider),
        &wrist,
        &Vector3::x(),
    );
    let turn = Signal::harmonics(0.0, TAU / period, &[], &[]).unwrap();
    let at = JointCoordinate {
        joint: bearing,
        coordinate: Coordinate::Rotation1,
    };
    model.prescribe(at, &turn).unwrap();
    model
}

/// The planar four-bar with a crooked axis of section 7.3 of the paper, and its period; damping is
/// `seconds` times the stiffness.
pub fn planar_four_bar(elements: usize, degree: usize, seconds: f64) -> (Model, f64) {
    let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let [a, b, c, d] = [at(0.0, 0.0), at(0.0, 0.12), at(0.24, 0.12), at(0.24, 0.0)];
    let steel = |stiffness: &[f64; 6], mass: &[f64; 4]| {
        let mut section = SectionInput::diagonal(stiffness, mass).unwrap();
        section.damp_proportionally(seconds).unwrap();
        section
    };
    let thick = steel(
        &[52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0],
        &[1.997, 85.2e-6, 42.6e-6, 42.6e-6],
    );
    let thin = steel(
        &[13.25e6, 4.22e6, 4.22e6, 45.84, 70.66, 70.66],
        &[0.4992, 5.324e-6, 2.662e-6, 2.662e-6],
    );
    let mut model = Model::new();
    let mut bar = |from, to, across, section| {
        model
            .add_straight_beam(from, to, across, section, elements, degree)
            .unwrap()
    };
    let (left, up) = (-Vector3::x(), Vector3::y());
    let crank = bar(&a, &b, &left, &thick);
    let coupler = bar(&b, &c, &up, &thick);
    let rocker = bar(&c, &d, &left, &thin);
    let mut hinge = |first, second, point, axis| {
        let frame = Model::frame_at("axis", point, axis).unwrap();
        model
            .add_joint(JointKind::Revolute, first, Some(second), &frame, &frame)
            .unwrap()
    };
    let normal = Vector3::z();
    let tilt = 5f64.to_radians();
    let crooked = Vector3::new(tilt.sin(), 0.0, tilt.cos());
    let motor = hinge(None, crank.first_node, &a, &normal);
    hinge(Some(crank.last_node), coupler.first_node, &b, &normal);
    hinge(Some(coupler.last_node), rocker.first_node, &c, &crooked);
    hinge(None, rocker.last_node, &d, &normal);
    let turn = Signal::harmonics(0.0, -0.6, &[], &[]).unwrap();
    let at = JointCoordinate {
        joint: motor,
        coordinate: Coordinate::Rotation1,
    };
    model.prescribe(at, &turn).unwrap();
    (model, TAU / 0.6)
}

/// Three blades of 30 m clamped to a turning hub with a level shaft, in gravity, with harmonic
/// forces at the tips; and the period. Two-node elements.
pub fn rotor(elements: usize) -> (Model, f64) {
    let mut model = Model::new();
    let hub = model
        .add_rigid_body(100.0, &Vector3::zeros(), &(Matrix3::identity() * 10.0))
        .unwrap();
    let mut section =
        SectionInput::diagonal(&[1e9, 3e8, 3e8, 1e7, 1.9e7, 3.68e7], &[10.0, 0.2, 0.1, 0.1])
            .unwrap();
    section.damp_proportionally(5e-3).unwrap();
    for i in 0..3 {
        let (sine, cosine) = (TAU * i as f64 / 3.0).sin_cos();
        let along = Vector3::new(cosine, sine, 0.0);
        let (root, tip) = (along * 1.0, along * 31.0);
        let blade = model
            .add_straight_beam(&root, &tip, &Vector3::z(), &section, elements, 1)
            .unwrap();
        let frame = Model::frame_at("axis", &root, &along).unwrap();
        model
            .add_joint(
                JointKind::Rigid,
                Some(hub),
                Some(blade.first_node),
                &frame,
                &frame,
            )
            .unwrap();
        let shake = Signal::harmonics(500.0, 0.0, &[300.0, 50.0, 20.0], &[100.0, 0.0, 10.0]);
        push(&mut model, blade.last_node, 2, shake.unwrap());
    }
    let frame = Model::frame_at("axis", &Vector3::zeros(), &Vector3::z()).unwrap();
    let shaft = model
        .add_joint(JointKind::Revolute, None, Some(hub), &frame, &frame)
        .unwrap();
    let turn = Signal::harmonics(0.0, 3.0, &[], &[]).unwrap();
    let at = JointCoordinate {
        joint: shaft,
        coordinate: Coordinate::Rotation1,
    };
    model.prescribe(at, &turn).unwrap();
    let constant = |value| Signal::constant(value).unwrap();
    model.set_gravity([constant(0.0), constant(-9.81), constant(0.0)]);
    (model, TAU / 3.0)
}
