//! Drivelines with universal joints, and machines with laws of the user: clutches, fans, friction,
//! hardening springs.

use super::workshop::{FREQUENCY, Vec3, Workshop};
use periodyn::elements::{Coordinate::*, JointKind};

pub fn build(w: &mut Workshop) {
    if w.random.percent(50) {
        driveline(w);
    } else {
        oscillator(w);
    }
}

/// A motor, a cardan shaft at an angle, an output shaft, and a wheel on it behind a torsional
/// spring.
fn driveline(w: &mut Workshop) {
    let bend = w.random.between(0.05, 0.45);
    let parallel = w.random.percent(70);
    let single = w.random.percent(25);
    let rate = w.rate();
    let x = Vec3::x();
    let slant = Vec3::new(bend.cos(), 0.0, bend.sin());
    let out = match (single, parallel) {
        (true, _) => slant,
        (_, true) => x,
        _ => Vec3::new((2.0 * bend).cos(), 0.0, (2.0 * bend).sin()),
    };
    w.note(format!(
        "driveline bent by {bend:.2}, {}",
        if single { "one joint" } else { "two joints" }
    ));
    let motor = w.ball(1.0, &(-0.2 * x), 0.2);
    let bearing = w.joint(JointKind::Revolute, None, motor, &(-0.2 * x), &x);
    if w.random.percent(30) {
        let (wave, part) = (
            super::waves::Wave::harmonics(&mut w.random, 2),
            w.random.between(0.01, 0.1),
        );
        w.note("uneven");
        w.prescribe(bearing, Rotation1, rate, Some((&wave, part)));
    } else {
        w.prescribe(bearing, Rotation1, rate, None);
    }
    let (end, from) = if single {
        (Vec3::zeros(), motor)
    } else {
        let flexible = w.random.percent(50).then(|| {
            let bending = w.random.decades(3.0, 100.0) * FREQUENCY * FREQUENCY / 97.0;
            let mut flexible = w.flexible(bending);
            flexible.slenderness = flexible.slenderness.max(1e3);
            flexible
        });
        let shaft = w.bar(&Vec3::zeros(), &slant, &Vec3::y(), 1.0, flexible.as_ref());
        let axes = [&Vec3::y(), &Vec3::y().cross(&slant)];
        w.joint_with_axes(
            JointKind::Universal,
            Some(motor),
            shaft.first,
            &Vec3::zeros(),
            axes,
        );
        (slant, shaft.last)
    };
    // The second joint's fork lies in the plane of the first's, as it should.
    let output = w.ball(0.3, &(end + 0.2 * out), 0.1);
    let axes = if single {
        [Vec3::y(), Vec3::y().cross(&out)]
    } else {
        [Vec3::y().cross(&slant), Vec3::y()]
    };
    w.joint_with_axes(
        JointKind::Universal,
        Some(from),
        output,
        &end,
        [&axes[0], &axes[1]],
    );
    let tail = end + 0.4 * out;
    w.joint(JointKind::Cylindrical, None, output, &tail, &out);
    wheel(w, output, &tail, &out);
}

/// The wheel, its spring, and what it drives.
fn wheel(w: &mut Workshop, output: usize, at: &Vec3, axis: &Vec3) {
    let rate = w.rate();
    let radius: f64 = 0.5;
    let inertia = 0.4 * radius * radius;
    let wheel = w.ball(1.0, at, radius);
    let clutch = w.joint(JointKind::Revolute, Some(output), wheel, at, axis);
    let stiffness = inertia * FREQUENCY * FREQUENCY;
    let damping = w.damper(stiffness).max(2e-3 * inertia * FREQUENCY);
    match w.random.below(4) {
        0 => w.spring_damper(clutch, Rotation1, stiffness, damping, 0.0),
        1 => {
            w.note("hardening clutch");
            let hard = w.random.decades(0.1, 30.0);
            w.law(clutch, Rotation1, true, move |q, v| {
                let value = stiffness * (q + hard * q * q * q) + damping * v;
                [value, stiffness * (1.0 + 3.0 * hard * q * q), damping]
            });
        }
        2 => {
            w.note("two-stage clutch");
            // Soft near the middle, by smooth transitions.
            let (gap, sharp) = (w.random.between(0.02, 0.2), w.random.between(5.0, 20.0));
            w.law(clutch, Rotation1, true, move |q, v| {
                let u = q / gap;
                let soft = (sharp * (u.abs() - 1.0)).exp().ln_1p() / sharp;
                let slope = 1.0 / (1.0 + (-sharp * (u.abs() - 1.0)).exp());
                let force = |s: f64| stiffness * (0.2 * q + 0.8 * gap * u.signum() * s);
                let stage = force(soft - (-sharp).exp().ln_1p() / sharp);
                [
                    stage + damping * v,
                    stiffness * (0.2 + 0.8 * slope),
                    damping,
                ]
            });
        }
        _ => {
            w.note("dry clutch");
            let friction = w.random.decades(1e-2, 0.3) * stiffness;
            let slip = w.random.between(0.05, 0.5) * rate;
            w.spring_damper(clutch, Rotation1, stiffness, damping, 0.0);
            w.law(clutch, Rotation1, false, move |_, v| {
                let t = (v / slip).tanh();
                [friction * t, 0.0, friction * (1.0 - t * t) / slip]
            });
        }
    }
    // Its coordinate is the wheel's turn; it holds nothing.
    let axes = [axis, &Vec3::y()];
    let foundation = w.joint_with_axes(JointKind::Free, None, wheel, at, axes);
    load(w, foundation, stiffness, rate);
}

/// A fan, a brake, or a machine that asks for torque by harmonics or pulses.
fn load(w: &mut Workshop, wheel: usize, stiffness: f64, rate: f64) {
    let mean = w.random.between(0.0, 0.3) * stiffness;
    if w.random.percent(50) {
        w.note("fan");
        w.law(wheel, Rotation1, true, move |_, v| {
            let u = v / rate;
            [mean * u * u.abs(), 0.0, 2.0 * mean * u.abs() / rate]
        });
    }
    if w.random.percent(60) {
        let (wave, target) = (w.wave(), w.random.decades(1e-3, 0.3));
        let size = target * stiffness / wave.response(w.speed, w.ratio.max(1e-3));
        w.note(format!("torque {target:.1e}"));
        w.actuator(wheel, Rotation1, -mean, (&wave, size));
    }
}

/// A mass on a slide or an arm on a hinge with a law of the user, one or two of them.
fn oscillator(w: &mut Workshop) {
    let count = 1 + w.random.below(2);
    let turning = w.random.percent(40);
    let mut before = None;
    let stiffness = if turning { 1.0 / 3.0 } else { 1.0 } * FREQUENCY * FREQUENCY * count as f64;
    let mut joints = Vec::new();
    for i in 0..count {
        let at = Vec3::x() * i as f64;
        let (node, joint) = if turning {
            let node = w.bar(&at, &(at + Vec3::x()), &Vec3::y(), 1.0, None).first;
            (
                node,
                w.joint(JointKind::Revolute, before, node, &at, &Vec3::y()),
            )
        } else {
            let node = w.ball(1.0, &at, 0.2);
            (
                node,
                w.joint(JointKind::Prismatic, before, node, &at, &Vec3::x()),
            )
        };
        let coordinate = if turning { Rotation1 } else { Displacement1 };
        user_law(w, joint, coordinate, stiffness);
        before = Some(node);
        joints.push((joint, coordinate));
    }
    w.note(format!(
        "{count} {}",
        if turning { "arms" } else { "masses" }
    ));
    let (wave, target) = (w.wave(), w.target());
    let size = target * stiffness / wave.response(w.speed, w.ratio);
    w.note(format!("effort {target:.1e}"));
    let (joint, coordinate) = joints[count - 1];
    w.actuator(joint, coordinate, 0.0, (&wave, size));
}

fn user_law(w: &mut Workshop, joint: usize, coordinate: periodyn::elements::Coordinate, k: f64) {
    let damping = w.damper(k);
    let given = w.random.percent(60);
    match w.random.below(5) {
        0 => {
            let hard = w.random.decades(0.1, 30.0);
            w.note(format!("hardening {hard:.1}"));
            w.law(joint, coordinate, given, move |q, v| {
                [
                    k * (q + hard * q * q * q) + damping * v,
                    k * (1.0 + 3.0 * hard * q * q),
                    damping,
                ]
            });
        }
        1 => {
            w.note("softening");
            w.law(joint, coordinate, given, move |q, v| {
                let t = (0.8 * q).tanh() / 0.8;
                [k * t + damping * v, k * (1.0 - 0.64 * t * t), damping]
            });
        }
        2 => {
            let share = w.random.decades(1e-3, 0.1);
            let slip = w.random.between(0.02, 0.2) * FREQUENCY;
            w.note(format!("friction {share:.1e}"));
            w.law(joint, coordinate, given, move |q, v| {
                let t = (v / slip).tanh();
                [
                    k * (q + share * t) + damping * v,
                    k,
                    k * share * (1.0 - t * t) / slip + damping,
                ]
            });
        }
        3 => {
            let drag = w.random.decades(0.05, 2.0) * k / (FREQUENCY * FREQUENCY);
            w.note("drag");
            w.law(joint, coordinate, given, move |q, v| {
                [
                    k * q + damping * v + drag * v * v.abs(),
                    k,
                    damping + 2.0 * drag * v.abs(),
                ]
            });
        }
        _ => {
            let stiffer = w.random.decades(2.0, 30.0);
            let (gap, width) = (w.random.between(0.02, 0.3), w.random.between(0.02, 0.1));
            w.note(format!(
                "buffer {stiffer:.1} times as stiff beyond {gap:.2}"
            ));
            w.law(joint, coordinate, given, move |q, v| {
                let u = (q - gap) / width;
                let ramp = if u > 30.0 { u } else { u.exp().ln_1p() } * width;
                let slope = 1.0 / (1.0 + (-u).exp());
                let more = (stiffer - 1.0) * k;
                [k * q + more * ramp + damping * v, k + more * slope, damping]
            });
        }
    }
}
