//! Chains of one to six links that hang or stand on springs, driven at their base or by loads.

use super::workshop::{Bar, FREQUENCY, Vec3, Workshop};
use nalgebra::{DMatrix, SymmetricEigen};
use periodyn::elements::{Coordinate::*, JointKind};
use std::f64::consts::PI;

/// First natural frequency squared of a planar chain of `n` slender rigid links, of mass and length
/// 1 together, with hinge springs and in gravity.
fn first_eigenvalue(n: usize, spring: f64, gravity: f64) -> f64 {
    let (m, l) = (1.0 / n as f64, 1.0 / n as f64);
    let beyond = |i: usize| (n - 1 - i) as f64;
    // Unknowns are the absolute angles of the links.
    let mass = DMatrix::from_fn(n, n, |i, j| {
        let far = beyond(i.max(j));
        m * l * l * if i == j { 1.0 / 3.0 + far } else { 0.5 + far }
    });
    let mut stiffness = DMatrix::zeros(n, n);
    for i in 0..n {
        stiffness[(i, i)] += m * gravity * l * (0.5 + beyond(i)) + spring;
        if i > 0 {
            stiffness[(i - 1, i - 1)] += spring;
            stiffness[(i, i - 1)] -= spring;
            stiffness[(i - 1, i)] -= spring;
        }
    }
    let inverse = mass.cholesky().unwrap().l().try_inverse().unwrap();
    SymmetricEigen::new(&inverse * stiffness * inverse.transpose())
        .eigenvalues
        .min()
}

pub fn build(w: &mut Workshop) {
    w.damped_by_joints();
    let n = 1 + w.random.below(6);
    // Shares of springs and gravity.
    let (springs, gravity) = w
        .random
        .pick(&[(0.0, 1.0), (1.0, 0.0), (0.5, 1.0), (3.0, 1.0)]);
    let spring_unit = springs / n as f64;
    let scale = FREQUENCY * FREQUENCY / first_eigenvalue(n, spring_unit, gravity);
    let (spring, gravity) = (spring_unit * scale, gravity * scale);
    w.note(format!(
        "{n} links, spring {spring:.2}, gravity {gravity:.2}"
    ));
    if gravity > 0.0 {
        w.gravity(&Vec3::new(0.0, 0.0, -gravity));
    }
    let (links, joints) = links(w, n, spring);
    drive(w, &links, &joints);
}

/// The links, from the top, and the joints above each.
fn links(w: &mut Workshop, n: usize, spring: f64) -> (Vec<Bar>, Vec<usize>) {
    let length = 1.0 / n as f64;
    let flexible = w.random.percent(35).then(|| {
        // Bending of a link on its two hinges, over that of the whole.
        let stiffer = w.random.decades(5.0, 40.0);
        let bending = (stiffer * FREQUENCY).powi(2) * (length / PI).powi(4);
        w.flexible(bending)
    });
    let spatial = w.random.percent(40);
    w.note(if spatial { "universals" } else { "hinges" });
    let damper = joint_damper(w, n, spring);
    let (mut bars, mut joints) = (Vec::<Bar>::new(), Vec::new());
    for i in 0..n {
        let at = |k: usize| Vec3::new(0.0, 0.0, -(k as f64) * length);
        let (top, bottom) = (at(i), at(i + 1));
        let bar = w.bar(&top, &bottom, &Vec3::x(), length, flexible.as_ref());
        let above = bars.last().map(|bar| bar.last);
        let joint = if spatial {
            let axes = [&Vec3::y(), &Vec3::x()];
            w.joint_with_axes(JointKind::Universal, above, bar.first, &top, axes)
        } else {
            w.joint(JointKind::Revolute, above, bar.first, &top, &Vec3::y())
        };
        let coordinates: &[_] = if spatial {
            &[Rotation1, Rotation2]
        } else {
            &[Rotation1]
        };
        for &coordinate in coordinates {
            w.spring_damper(joint, coordinate, spring, damper, 0.0);
        }
        bars.push(bar);
        joints.push(joint);
    }
    (bars, joints)
}

/// Hinge dampers that give the first mode about its damping ratio: those of a spring alone that
/// would.
fn joint_damper(w: &Workshop, n: usize, spring: f64) -> f64 {
    let alone = FREQUENCY * FREQUENCY / first_eigenvalue(n, 1.0, 0.0);
    w.damper(alone.max(spring))
}

fn drive(w: &mut Workshop, links: &[Bar], joints: &[usize]) {
    if links.len() > 1 && w.random.percent(30) {
        let wave = w.motion();
        let swing = w.target() / wave.base_response(w.speed, w.ratio);
        w.note(format!("base turned {swing:.1e}"));
        w.prescribe(joints[0], Rotation1, 0.0, Some((&wave, swing)));
        return;
    }
    let (wave, target) = (w.wave(), w.target());
    // Moment that turns it by a radian, over its length.
    let stiffness = FREQUENCY * FREQUENCY / 3.0;
    let size = stiffness * target / wave.response(w.speed, w.ratio);
    let across = Vec3::new(1.0, 0.3 * w.random.number(), 0.0);
    match w.random.below(3) {
        0 => {
            w.note(format!("torque {target:.1e}"));
            w.actuator(joints[0], Rotation1, 0.0, (&wave, size));
        }
        1 => {
            w.note(format!("force at the end {target:.1e}"));
            let follows = w.random.percent(20);
            let last = links[links.len() - 1].last;
            w.force(last, follows, &across, 0.0, (&wave, size));
        }
        _ => {
            w.note(format!("force in the middle {target:.1e}"));
            let middle = links[links.len() / 2].last;
            w.force(middle, false, &across, 0.0, (&wave, size));
        }
    }
}
