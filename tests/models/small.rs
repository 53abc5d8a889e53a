//! Small models with beams, and their periods.

use super::parts::*;
use nalgebra::Vector3;
use periodyn::elements::{JointKind, LoadFrame, MaxwellBranch};
use periodyn::model::*;
use std::f64::consts::TAU;

fn light_section() -> SectionInput {
    let stiffness = [4e6, 1.4e6, 1.4e6, 60.0, 80.0, 80.0];
    SectionInput::diagonal(&stiffness, &[0.3, 1e-5, 5e-6, 5e-6]).unwrap()
}

/// A flexible crank and rocker with a flexible coupler, in a plane, with a viscoelastic knee, and
/// its period.
pub fn crank_rocker(elements: usize, degree: usize, frequency: f64) -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let corners = [(0.0, 0.0), (0.0, 0.3), (1.0, 0.8), (1.0, 0.0)];
    let [a, b, c, d] = corners.map(|(x, y)| Vector3::new(x, y, 0.0));
    let (section, z) = (light_section(), Vector3::z());
    let [crank, coupler, rocker] = [(&a, &b), (&b, &c), (&c, &d)].map(|(from, to)| {
        m.add_straight_beam(from, to, &z, &section, elements, degree)
            .unwrap()
    });
    let motor = revolute(m, None, Some(crank.first_node), &a, &z);
    let pin = [Some(crank.last_node), Some(coupler.first_node)];
    join(m, JointKind::Spherical, pin, &b, &z);
    let (hip, shin) = (Some(coupler.last_node), Some(rocker.first_node));
    let knee = revolute(m, hip, shin, &c, &z);
    revolute(m, None, Some(rocker.last_node), &d, &z);
    let turn = Signal::harmonics(0.0, frequency, &[0.0], &[0.2]).unwrap();
    m.prescribe(rotation1(motor), &turn).unwrap();
    let branches = [MaxwellBranch {
        stiffness: 2.0,
        relaxation_time: 0.5 / frequency,
    }];
    m.add_viscoelastic(rotation1(knee), 1.0, 0.0, &branches)
        .unwrap();
    (model, TAU / frequency)
}

/// A hub that turns at 1, with a clamped flexible blade, in gravity.
pub fn one_blade(elements: usize) -> (Model, f64) {
    let mut model = Model::new();
    let m = &mut model;
    let (root, tip) = (Vector3::new(0.2, 0.0, 0.0), Vector3::new(10.2, 0.0, 0.0));
    let hub = Some(ball(m, 2.0, 1.0, &Vector3::zeros()));
    let stiffness = [1e6, 3e5, 3e5, 800.0, 2600.0, 5100.0];
    let section = SectionInput::diagonal(&stiffness, &[1.0, 0.02, 0.01, 0.01]).unwrap();
    let blade = m
        .add_straight_beam(&root, &tip, &Vector3::y(), &section, elements, 2)
        .unwrap();
    let shaft = revolute(m, None, hub, &Vector3::zeros(), &Vector3::z());
    let held = [hub, Some(blade.first_node)];
    join(m, JointKind::Rigid, held, &root, &Vector3::x());
    m.prescribe(rotation1(shaft), &steady(1.0)).unwrap();
    gravity(m, [0.0, -0.5, 0.0]);
    (model, TAU)
}

/// A clamped beam under a turning force at its tip, and the period.
pub fn whirled_beam() -> (Model, f64) {
    let mut model = Model::new();
    let (root, tip) = (Vector3::zeros(), Vector3::x());
    let beam = model
        .add_straight_beam(&root, &tip, &Vector3::y(), &light_section(), 2, 2)
        .unwrap();
    let held = [None, Some(beam.first_node)];
    join(&mut model, JointKind::Rigid, held, &root, &Vector3::z());
    let mut force: [Option<Signal>; 6] = Default::default();
    force[1] = Some(cosine(1.0));
    force[2] = Some(Signal::harmonics(0.0, 0.0, &[0.0], &[1.0]).unwrap());
    model
        .add_load(beam.last_node, LoadFrame::Space, force)
        .unwrap();
    (model, TAU / 20.0)
}

/// One model of each kind, with periods.
pub fn moving_models() -> Vec<(Model, f64)> {
    vec![crank_rocker(2, 2, 3.0), one_blade(2)]
}
