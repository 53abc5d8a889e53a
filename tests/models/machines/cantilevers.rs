//! Cantilevers with base motion or tip loads.

use super::workshop::{FREQUENCY, Vec3, Workshop};
use periodyn::elements::{Coordinate::*, JointKind};

/// Bending stiffness of a cantilever of mass and length 1 with a tip mass, so that its first
/// frequency is [`FREQUENCY`] (Rayleigh).
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
    let soft = Vec3::y().cross(&direction);
    if w.random.percent(50) {
        let (wave, target) = (w.motion(), w.target());
        let size = target / wave.base_response(w.speed, w.ratio);
        w.note(format!("base moved {size:.1e}"));
        let (joint, coordinate) = if w.random.percent(50) {
            let slide = w.joint(JointKind::Prismatic, None, bar.first, &root, &soft);
            (slide, Displacement1)
        } else {
            let hinge = w.joint(JointKind::Revolute, None, bar.first, &root, &Vec3::y());
            (hinge, Rotation1)
        };
        w.prescribe(joint, coordinate, 0.0, Some((&wave, size)));
        return;
    }
    let (wave, target) = (w.wave(), w.target());
    w.note(format!("tip force {target:.1e}"));
    w.clamp(None, bar.first, &root);
    let size = 3.0 * bending * target / wave.response(w.speed, w.ratio);
    let oblique = w.random.percent(30);
    let across = soft
        + if oblique {
            0.3 * Vec3::y()
        } else {
            Vec3::zeros()
        };
    let mean = if w.random.percent(30) {
        0.3 * size
    } else {
        0.0
    };
    let follows = w.random.percent(30);
    w.force(bar.last, follows, &across, mean, (&wave, size));
}
