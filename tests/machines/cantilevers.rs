//! Cantilevers with base motion or tip loads.

use super::workshop::{FREQUENCY, Vec3, Workshop};
use periodyn::elements::{Coordinate::*, JointKind};

/// Bending stiffness of a cantilever of mass and length 1 with a tip mass, so that its first frequency is
/// [`FREQUENCY`] (Rayleigh).
fn bending(tip_mass: f64) -> f64 {
    FREQUENCY * FREQUENCY * (tip_mass + 33.0 / 140.0) / 3.0
}

pub fn build(w: &mut Workshop) {
    let tip_mass = if w.random.percent(40) {
        w.random.decades(0.1, 5.0)
    } else {
        0.0
    };
    let bending = bending(tip_mass);
    let mut flexible = w.flexible(bending);
    flexible.other = w.random.decades(1.0, 30.0);
    let direction = w
        .random
        .pick(&[Vec3::x(), Vec3::z(), Vec3::new(0.6, 0.0, 0.8)]);
    let (root, tip) = (Vec3::zeros(), direction);
    let bar = w.bar(&root, &tip, &Vec3::y(), 1.0, Some(&flexible));
    if tip_mass > 0.0 {
        w.note(format!("tip mass {tip_mass:.2}"));
        let inertia = nalgebra::Matrix3::identity() * (tip_mass * 1e-3);
        w.mass(bar.last, tip_mass, &tip, &inertia);
    }
    if w.random.percent(60) {
        // Weight of all at the tip bends it by so much of its length.
        let sag = w.random.decades(1e-4, 0.1);
        w.note(format!("sag {sag:.1e}"));
        w.gravity(&Vec3::new(
            0.0,
            0.0,
            -3.0 * bending * sag / (tip_mass + 1.0),
        ));
    }
    let (wave, target) = (w.wave(), w.target());
    let soft = Vec3::y().cross(&direction);
    let moving = target / wave.base_response(w.speed, w.ratio);
    match w.random.below(4) {
        0 => {
            w.note(format!("base moved {moving:.1e}"));
            let slide = w.joint(JointKind::Prismatic, None, bar.first, &root, &soft);
            w.prescribe(slide, Displacement1, 0.0, Some((&wave, moving)));
        }
        1 => {
            w.note(format!("base turned {moving:.1e}"));
            let hinge = w.joint(JointKind::Revolute, None, bar.first, &root, &Vec3::y());
            w.prescribe(hinge, Rotation1, 0.0, Some((&wave, moving)));
        }
        which => {
            w.note(format!("tip force {target:.1e}"));
            w.clamp(None, bar.first, &root);
            let size = 3.0 * bending * target / wave.response(w.speed, w.ratio);
            let across = if w.random.percent(30) {
                soft + 0.3 * Vec3::y()
            } else {
                soft
            };
            let mean = if w.random.percent(30) {
                0.3 * size
            } else {
                0.0
            };
            w.force(bar.last, which == 3, &across, mean, (&wave, size));
        }
    }
}
