//! Models with beams, and their periods: those of `c_examples`, and others.

use super::parts::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::JointKind;
use periodyn::model::{Model, SectionInput, Signal, Target};
use periodyn::motion::Motion;
use std::f64::consts::TAU;

/// A section with damping of torsion and bending, `seconds` times the stiffness.
fn damped_in_bending(stiffness: &[f64; 6], mass: &[f64; 4], seconds: f64) -> SectionInput {
    let mut section = SectionInput::diagonal(stiffness, mass).unwrap();
    for (i, stiffness) in stiffness.iter().enumerate().skip(3) {
        section.damping[(i, i)] = seconds * stiffness;
    }
    section
}

/// A beam of 1 m along axis 1, clamped at the origin, and the node at its tip.
pub(super) fn cantilever(section: &SectionInput, elements: usize, degree: usize) -> (Model, usize) {
    let mut model = Model::new();
    let (root, tip) = (Vector3::zeros(), Vector3::x());
    let beam = model
        .add_straight_beam(&root, &tip, &Vector3::y(), section, elements, degree)
        .unwrap();
    let frame = Motion::identity();
    model
        .add_joint(
            JointKind::Rigid,
            None,
            Some(beam.first_node),
            &frame,
            &frame,
        )
        .unwrap();
    (model, beam.last_node)
}

/// The shaken nylon rod of `c_examples/forced_cantilever.c`, and its period.
pub fn forced_cantilever(elements: usize, degree: usize) -> (Model, f64) {
    shaken_rod(12.0, elements, degree)
}

/// The same, shaken by a force of this amplitude.
pub fn shaken_rod(force: f64, elements: usize, degree: usize) -> (Model, f64) {
    let stiffness = [785e3, 250e3, 250e3, 14.0, 19.6, 19.6];
    let nylon = damped_in_bending(&stiffness, &[0.361, 18.0e-6, 9.0e-6, 9.0e-6], 5e-3);
    let (mut model, tip) = cantilever(&nylon, elements, degree);
    gravity(&mut model, [0.0, 0.0, -9.81]);
    push(&mut model, tip, 2, cosine(force));
    (model, 0.3)
}

/// The strip of `c_examples/backbone.c`, clamped at one end, without load and damping, and the
/// parameter that is a damping in proportion to mass, zero.
pub fn free_strip(elements: usize, degree: usize) -> (Model, usize) {
    let (young, shear, density) = (2.1e11, 8.1e10, 7850.0);
    let (width, height): (f64, f64) = (0.02, 0.002);
    let area = width * height;
    let (thin, wide) = (area * height.powi(2) / 12.0, area * width.powi(2) / 12.0);
    let sheared = shear * area * 5.0 / 6.0;
    let stiffness = [
        young * area,
        sheared,
        sheared,
        4.0 * shear * thin,
        young * wide,
        young * thin,
    ];
    let mass = [area, thin + wide, wide, thin].map(|x| density * x);
    let section = SectionInput::diagonal(&stiffness, &mass).unwrap();
    let (mut model, _) = cantilever(&section, elements, degree);
    let damping = model.add_parameter("damping", 0.0, 1.0).unwrap();
    let target = Target::MassDamping;
    model.move_by_parameter(damping, target, 1.0).unwrap();
    (model, damping)
}

/// A steel strip of 1 m, all of whose strains are damped by `seconds` times the stiffness, and its
/// period: the tip is pushed by 10 N and shaken by 20 N.
pub fn damped_strip(seconds: f64, axial: f64, elements: usize, degree: usize) -> (Model, f64) {
    let shear = 0.32 * axial;
    let stiffness = [axial, shear, shear, 35.0, 43.75, 43.75];
    let mut steel = SectionInput::diagonal(&stiffness, &[0.785, 8e-6, 4e-6, 4e-6]).unwrap();
    steel.damping = steel.stiffness * seconds;
    let (mut model, tip) = cantilever(&steel, elements, degree);
    let shake = Signal::harmonics(10.0, 0.0, &[20.0], &[0.0]).unwrap();
    push(&mut model, tip, 2, shake);
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
    let (origin, x) = (Vector3::zeros(), Vector3::x());
    let bearing = revolute(&mut model, None, Some(hub), &origin, &x);
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
    gravity(&mut model, [0.0, 0.0, -9.81]);
    drive(&mut model, bearing, 1.0);
    let lift = Signal::harmonics(3000.0, 0.0, &[1000.0, 0.0], &[0.0, 200.0]).unwrap();
    push(&mut model, blade.last_node, 0, lift);
    (model, 1.0)
}

/// The slider-crank with a flexible rod of `c_examples/slider_crank.c`, whose crank turns once in
/// `period`.
pub fn slider_crank(elements: usize, degree: usize, period: f64) -> Model {
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let (pin, wrist) = (at(0.15), at(0.45));
    let mut model = Model::new();
    let m = &mut model;
    let crank = Some(ball(m, 0.5, 1e-3, &at(0.0)));
    let slider = Some(ball(m, 0.04, 1e-5, &wrist));
    let steel = damped_section(
        &[5.85e6, 1.95e6, 1.95e6, 10.1, 13.2, 13.2],
        &[0.222, 1.0e-6, 0.5e-6, 0.5e-6],
        1e-4,
    );
    let rod = m
        .add_straight_beam(&pin, &wrist, &Vector3::y(), &steel, elements, degree)
        .unwrap();
    let (x, z) = (Vector3::x(), Vector3::z());
    let bearing = revolute(m, None, crank, &at(0.0), &z);
    revolute(m, crank, Some(rod.first_node), &pin, &z);
    revolute(m, Some(rod.last_node), slider, &wrist, &z);
    join(m, JointKind::Prismatic, [None, slider], &wrist, &x);
    drive(m, bearing, period);
    model
}

/// The planar four-bar with a crooked axis of section 7.3 of the paper, and its period; damping is
/// `seconds` times the stiffness.
pub fn planar_four_bar(elements: usize, degree: usize, seconds: f64) -> (Model, f64) {
    crooked_four_bar(elements, degree, seconds, 5f64.to_radians())
}

/// The same, whose third axis is turned out of its direction by an angle.
pub fn crooked_four_bar(elements: usize, degree: usize, seconds: f64, tilt: f64) -> (Model, f64) {
    let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let [a, b, c, d] = [at(0.0, 0.0), at(0.0, 0.12), at(0.24, 0.12), at(0.24, 0.0)];
    let thick = damped_section(&THICK, &THICK_MASS, seconds);
    let thin = damped_section(&THIN, &THIN_MASS, seconds);
    let mut model = Model::new();
    let m = &mut model;
    let mut bar = |from, to, across, section| {
        m.add_straight_beam(from, to, across, section, elements, degree)
            .unwrap()
    };
    let (left, up) = (-Vector3::x(), Vector3::y());
    let crank = bar(&a, &b, &left, &thick);
    let coupler = bar(&b, &c, &up, &thick);
    let rocker = bar(&c, &d, &left, &thin);
    let normal = Vector3::z();
    let crooked = Vector3::new(tilt.sin(), 0.0, tilt.cos());
    let (knee, hip) = (Some(crank.last_node), Some(coupler.last_node));
    let motor = revolute(m, None, Some(crank.first_node), &a, &normal);
    revolute(m, knee, Some(coupler.first_node), &b, &normal);
    revolute(m, hip, Some(rocker.first_node), &c, &crooked);
    revolute(m, None, Some(rocker.last_node), &d, &normal);
    m.prescribe(rotation1(motor), &steady(-0.6)).unwrap();
    (model, TAU / 0.6)
}

/// Three blades of 30 m clamped to a turning hub with a level shaft, in gravity, with harmonic
/// forces at the tips; and the period. Two-node elements.
pub fn rotor(elements: usize) -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let hub = ball(m, 100.0, 10.0, &Vector3::zeros());
    let stiffness = [1e9, 3e8, 3e8, 1e7, 1.9e7, 3.68e7];
    let section = damped_section(&stiffness, &[10.0, 0.2, 0.1, 0.1], 5e-3);
    for i in 0..3 {
        let (sine, cosine) = (TAU * i as f64 / 3.0).sin_cos();
        let along = Vector3::new(cosine, sine, 0.0);
        let (root, tip) = (along * 1.0, along * 31.0);
        let blade = m
            .add_straight_beam(&root, &tip, &Vector3::z(), &section, elements, 1)
            .unwrap();
        let held = [Some(hub), Some(blade.first_node)];
        join(m, JointKind::Rigid, held, &root, &along);
        let shake = Signal::harmonics(500.0, 0.0, &[300.0, 50.0, 20.0], &[100.0, 0.0, 10.0]);
        push(m, blade.last_node, 2, shake.unwrap());
    }
    let shaft = revolute(m, None, Some(hub), &Vector3::zeros(), &Vector3::z());
    m.prescribe(rotation1(shaft), &steady(3.0)).unwrap();
    gravity(m, [0.0, -9.81, 0.0]);
    (model, TAU / 3.0)
}
