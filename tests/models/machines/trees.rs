//! Trees of masses on springs of all directions, linear or hardening.

use super::workshop::{FREQUENCY, Vec3, Workshop};
use nalgebra::Matrix3;
use periodyn::elements::{Coordinate, Coordinate::*, JointKind};

const KINDS: [JointKind; 7] = [
    JointKind::Prismatic,
    JointKind::Revolute,
    JointKind::Cylindrical,
    JointKind::Planar,
    JointKind::Universal,
    JointKind::Spherical,
    JointKind::Free,
];

struct Mass {
    node: usize,
    at: Vec3,
    parent: Option<usize>,
    depth: usize,
    /// Of the mass and all that hangs on it.
    carried: f64,
}

pub fn build(w: &mut Workshop) {
    let count = 1 + w.random.below(8);
    let masses = masses(w, count);
    let linear = w.random.percent(50);
    let hard = if linear {
        0.0
    } else {
        w.random.decades(0.1, 30.0)
    };
    w.note(format!("{count} masses, hardening {hard:.1}"));
    let deepest = masses.iter().map(|mass| mass.depth).max().unwrap_or(0) as f64;
    let moved = w.random.percent(30);
    let wave = if moved { w.motion() } else { w.wave() };
    let target = w.target();
    let base = w.node(&Vec3::zeros());
    if moved {
        let axis = w.random.vector();
        let slide = w.joint(JointKind::Prismatic, None, base, &Vec3::zeros(), &axis);
        let size = target / wave.base_response(w.speed, w.ratio);
        w.note(format!("base moved {size:.1e}"));
        w.prescribe(slide, Displacement1, 0.0, Some((&wave, size)));
    } else {
        w.clamp(None, base, &Vec3::zeros());
    }
    for mass in &masses {
        let (from, foot) = match mass.parent {
            None => (base, Vec3::zeros()),
            Some(parent) => (masses[parent].node, masses[parent].at),
        };
        // As soft as masses in a row are together.
        let stiffness = mass.carried * FREQUENCY * FREQUENCY * deepest;
        hang(w, from, mass, &foot, stiffness, hard);
    }
    if w.random.percent(50) {
        let sag = w.random.decades(1e-4, 0.05);
        w.gravity(&Vec3::new(0.0, 0.0, -sag * FREQUENCY * FREQUENCY));
    }
    if !moved {
        let last = &masses[w.random.below(masses.len())];
        let total: f64 = masses
            .iter()
            .filter(|m| m.depth == 1)
            .map(|m| m.carried)
            .sum();
        let size = total * FREQUENCY * FREQUENCY * target / wave.response(w.speed, w.ratio);
        w.note(format!("force {target:.1e}"));
        let (node, direction) = (last.node, w.random.vector());
        w.force(node, false, &direction, 0.0, (&wave, size / count as f64));
    }
}

fn masses(w: &mut Workshop, count: usize) -> Vec<Mass> {
    let mut masses: Vec<Mass> = Vec::new();
    for i in 0..count {
        let parent = w.random.below(i + 1).checked_sub(1);
        let (start, depth) = match parent {
            None => (Vec3::zeros(), 0),
            Some(parent) => (masses[parent].at, masses[parent].depth),
        };
        let away = w.random.vector().normalize() * w.random.between(0.3, 0.6);
        let at = start + away;
        let mass = w.random.decades(0.2, 2.0);
        let moments = Vec3::from_fn(|_, _| w.random.between(0.5, 0.9));
        let inertia = Matrix3::from_diagonal(&(moments * (0.02 * mass)));
        let node = w.body(mass, &at, &inertia);
        masses.push(Mass {
            node,
            at,
            parent,
            depth: depth + 1,
            carried: mass,
        });
    }
    for i in (0..count).rev() {
        if let Some(parent) = masses[i].parent {
            let carried = masses[i].carried;
            masses[parent].carried += carried;
        }
    }
    masses
}

/// Joins a mass to the one before, half-way, with a spring on each coordinate.
fn hang(w: &mut Workshop, from: usize, mass: &Mass, foot: &Vec3, stiffness: f64, hard: f64) {
    let kind = w.random.pick(&KINDS);
    let (one, two) = (w.random.vector(), w.random.vector());
    let arm = mass.at - foot;
    let point = foot + 0.5 * arm;
    let joint = w.joint_with_axes(kind, Some(from), mass.node, &point, [&one, &two]);
    for &coordinate in kind.coordinates() {
        let turns = is_turn(coordinate);
        // What is carried is half the arm and more away from the joint.
        let unit = if turns { arm.norm_squared() } else { 1.0 };
        let stiffness = stiffness * unit * w.random.between(1.0, 3.0);
        if hard == 0.0 {
            w.spring(joint, coordinate, stiffness, 0.0);
        } else {
            w.cubic_spring(joint, coordinate, stiffness, stiffness * hard);
        }
    }
}

fn is_turn(coordinate: Coordinate) -> bool {
    matches!(coordinate, Rotation1 | Rotation2 | Rotation3)
}
