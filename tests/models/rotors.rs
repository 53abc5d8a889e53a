//! Rotors of like blades.

use super::parts::*;
use nalgebra::{Matrix3, Rotation3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame};
use periodyn::model::*;
use std::f64::consts::TAU;

/// A rotor on a tower, and its nodes.
pub struct BladedRotor {
    /// The model, in which nothing is said of symmetry.
    pub model: Model,
    /// A turn of the rotor.
    pub period: f64,
    /// The node of the hub.
    pub hub: usize,
    /// Nodes of each blade, from root to tip.
    pub blades: Vec<Vec<usize>>,
}

/// Direction of the rotor's axis, and a point of it.
pub const AXIS: Vector3<f64> = Vector3::new(1.0, 0.0, 0.0);
pub const CENTRE: Vector3<f64> = Vector3::new(0.6, 0.0, 4.0);

impl BladedRotor {
    /// Says that the blades are alike.
    pub fn symmetric(&self) -> Model {
        let mut model = self.model.clone();
        let said = model.set_rotor_symmetry(&AXIS, &CENTRE, &[self.hub], &self.blades);
        said.unwrap();
        model
    }
}

/// What rotors differ by.
#[derive(Debug, Clone, Copy)]
pub struct RotorKind {
    pub blades: usize,
    /// Beam elements of each blade.
    pub elements: usize,
    /// Whether blades flap on hinges with springs, or are fixed to the hub.
    pub hinged: bool,
    /// Angular velocity.
    pub speed: f64,
    /// Factor of the stiffness of blades.
    pub blade: f64,
    /// The same of the tower, and once more in its second direction.
    pub tower: [f64; 2],
    /// Factor of the loads on the tips.
    pub wind: f64,
    /// Factors of the length of blades, and of their mass.
    pub length: f64,
    pub mass: f64,
}

impl RotorKind {
    /// One like those of small turbines.
    pub fn new(blades: usize, elements: usize, hinged: bool) -> Self {
        RotorKind {
            blades,
            elements,
            hinged,
            speed: 4.0,
            blade: 1.0,
            tower: [1.0, 0.5],
            wind: 1.0,
            length: 1.0,
            mass: 1.0,
        }
    }
}

/// Flexible blades on a driven hub, on a nacelle that yaws against a spring on a tower that is
/// stiffer one way than the other, in gravity, with loads on the tips that change with their
/// height.
pub fn bladed_rotor(kind: &RotorKind) -> BladedRotor {
    let count = kind.blades;
    let period = TAU / kind.speed;
    let mut model = Model::new();
    let [stiff, other] = kind.tower;
    let stiffness = [4e6, 2e6, 2e6, 2e4, 6e4, 6e4 * other].map(|s| s * stiff);
    let section = damped_section(&stiffness, &[6.0, 0.05, 0.03, 0.02], 2e-3);
    let top = Vector3::z() * 4.0;
    let tower = model
        .add_straight_beam(&Vector3::zeros(), &top, &Vector3::x(), &section, 1, 4)
        .unwrap();
    clamp(&mut model, tower.first_node);
    let nacelle = ball(&mut model, 20.0, 1.0, &(top + Vector3::x() * 0.1));
    let yaw = revolute(
        &mut model,
        Some(tower.last_node),
        Some(nacelle),
        &top,
        &Vector3::z(),
    );
    spring(&mut model, rotation1(yaw), 2e3, 20.0);
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.2, 0.2));
    let hub = model.add_rigid_body(5.0, &CENTRE, &inertia).unwrap();
    let shaft = revolute(&mut model, Some(nacelle), Some(hub), &CENTRE, &AXIS);
    drive(&mut model, shaft, period);
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let stiffness = [2e6, 8e5, 8e5, 2e3, 1.5e3, 8e3].map(|s| s * kind.blade);
    let inertia = [1.2, 2e-3, 5e-4, 1.5e-3].map(|m| m * kind.mass);
    let blade_section = damped_section(&stiffness, &inertia, 5e-3);
    let mut blades = Vec::new();
    for j in 0..count {
        let phase = TAU * j as f64 / count as f64;
        let turn = Rotation3::new(AXIS * phase);
        let along = turn * Vector3::z();
        let (root, tip) = (CENTRE + along * 0.3, CENTRE + along * (3.0 * kind.length));
        let beam = model
            .add_straight_beam(&root, &tip, &AXIS, &blade_section, kind.elements, 3)
            .unwrap();
        let ends = [Some(hub), Some(beam.first_node)];
        match kind.hinged {
            false => {
                join(&mut model, JointKind::Rigid, ends, &root, &AXIS);
            }
            true => {
                let flap = turn * Vector3::y();
                let hinge = join(&mut model, JointKind::Revolute, ends, &root, &flap);
                let coordinate = Coordinate::Rotation1;
                let at = JointCoordinate {
                    joint: hinge,
                    coordinate,
                };
                spring(&mut model, at, 400.0, 3.0);
            }
        }
        // What blade 0 has at the time t + j T / count.
        let wave = |mean: f64, size: f64| {
            let (sine, cosine) = phase.sin_cos();
            Signal::harmonics(mean, 0.0, &[size * cosine], &[-size * sine]).unwrap()
        };
        let mut components = [(); 6].map(|()| None);
        components[0] = Some(wave(30.0 * kind.wind, 8.0 * kind.wind));
        components[2] = Some(wave(0.0, 3.0 * kind.wind));
        model
            .add_load(beam.last_node, LoadFrame::Space, components)
            .unwrap();
        blades.push((beam.first_node..=beam.last_node).collect());
    }
    BladedRotor {
        model,
        period,
        hub,
        blades,
    }
}
