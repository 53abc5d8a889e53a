//! Slider-cranks: rigid or with a flexible rod, in line or offset, with gas forces, driven stiffly
//! or through a shaft.

use super::workshop::{FREQUENCY, Vec3, Workshop};
use nalgebra::Matrix3;
use periodyn::elements::{Coordinate::*, JointKind};
use std::f64::consts::PI;

pub fn build(w: &mut Workshop) {
    // Lengths over that of the rod; the crank turns as crank and offset together are shorter than
    // it.
    let crank = w.random.between(0.15, 0.4);
    let offset = if w.random.percent(40) {
        w.random.between(-0.3, 0.3)
    } else {
        0.0
    };
    let slider_mass = w.random.decades(0.1, 3.0);
    let flexible = w.random.percent(60);
    // Forces in the rod stay below 0.4 of what buckles it.
    let stiffness = FREQUENCY * FREQUENCY / PI.powi(4);
    let buckling = PI * PI * stiffness;
    if flexible {
        let slowing = (slider_mass + 0.5) * crank * 1.3;
        let most = (0.25 * buckling / slowing).sqrt() / FREQUENCY;
        w.speed = w.random.decades(0.02, most.max(0.04));
    }
    w.note(format!(
        "crank {crank:.2}, offset {offset:.2}, slider {slider_mass:.2}, {}",
        if flexible { "flexible rod" } else { "rigid" }
    ));
    let pin = Vec3::new(crank, 0.0, 0.0);
    let wrist = pin + Vec3::new((1.0 - offset * offset).sqrt(), 0.0, offset);
    let disc = Matrix3::from_diagonal(&Vec3::new(0.5, 1.0, 0.5)) * (crank * crank);
    let shaft = w.body(2.0, &Vec3::zeros(), &disc);
    let flexible = flexible.then(|| w.flexible(stiffness));
    let rod = w.bar(&pin, &wrist, &Vec3::y(), 1.0, flexible.as_ref());
    let slider = w.ball(slider_mass, &wrist, 0.1);
    let axis = -Vec3::y();
    let bearing = w.joint(JointKind::Revolute, None, shaft, &Vec3::zeros(), &axis);
    w.joint(JointKind::Revolute, Some(shaft), rod.first, &pin, &axis);
    let at_wrist = w.random.pick(&[JointKind::Revolute, JointKind::Spherical]);
    w.joint(at_wrist, Some(rod.last), slider, &wrist, &axis);
    let slide = w.joint(JointKind::Prismatic, None, slider, &wrist, &Vec3::x());
    turn(w, shaft, bearing, slider_mass, crank, &axis);
    if w.random.percent(50) {
        w.gravity(&Vec3::new(0.0, 0.0, -0.02 * w.rate().powi(2)));
    }
    if w.random.percent(60) {
        // Gas: pushes the slider towards the crank.
        let wave = w.wave();
        let most = if flexible.is_some() {
            0.15 * buckling
        } else {
            slider_mass * crank * w.rate().powi(2)
        };
        let size = w.random.decades(1e-2, 1.0) * most;
        w.note(format!("gas {size:.2e}"));
        w.actuator(slide, Displacement1, 0.0, (&wave, -size));
    }
    if w.random.percent(30) {
        let stiffness = w.random.decades(0.01, 1.0) * slider_mass * w.rate().powi(2);
        let stiffness = if flexible.is_some() {
            stiffness.min(0.1 * buckling)
        } else {
            stiffness
        };
        w.spring_damper(slide, Displacement1, stiffness, w.damper(stiffness), 0.0);
    }
}

/// Turns the crank, steadily or nearly so, or a wheel that it hangs on by a torsional spring.
fn turn(w: &mut Workshop, shaft: usize, bearing: usize, slider: f64, crank: f64, axis: &Vec3) {
    let rate = w.rate();
    if w.random.percent(30) {
        w.note("through a torsional spring");
        let wheel = w.ball(1.0, &Vec3::zeros(), 0.2);
        let drive = w.joint(JointKind::Revolute, None, wheel, &Vec3::zeros(), axis);
        w.prescribe(drive, Rotation1, rate, None);
        let spring = w.joint(
            JointKind::Revolute,
            Some(wheel),
            shaft,
            &Vec3::zeros(),
            axis,
        );
        // The slider shakes it twice a turn: it is stiff against that.
        let inertia = (2.0 + slider + 0.5) * crank * crank;
        let stiffness = w.random.decades(20.0, 1000.0) * inertia * rate * rate;
        let damping = 2.0 * w.ratio.max(0.01) * (stiffness * inertia).sqrt();
        w.spring_damper(spring, Rotation1, stiffness, damping, 0.0);
    } else if w.random.percent(30) {
        let wave = super::waves::Wave::harmonics(&mut w.random, 1);
        let swing = w.random.between(0.02, 0.2);
        w.note("uneven");
        w.prescribe(bearing, Rotation1, rate, Some((&wave, swing)));
    } else {
        w.prescribe(bearing, Rotation1, rate, None);
    }
}
