//! Models with smooth periodic responses of all kinds: flexible and rigid, forced, driven and
//! turning.

use crate::common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame};
use periodyn::model::*;
use std::f64::consts::TAU;

pub struct Example {
    pub name: &'static str,
    pub model: Model,
    pub period: f64,
}

fn diagonal(a: f64, b: f64, c: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(a, b, c))
}

fn joint(
    model: &mut Model,
    kind: JointKind,
    ends: [Option<usize>; 2],
    point: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> usize {
    let frame = Model::frame_at("axis", point, axis).unwrap();
    model
        .add_joint(kind, ends[0], ends[1], &frame, &frame)
        .unwrap()
}

fn gravity(model: &mut Model, along: [f64; 3]) {
    model.set_gravity(along.map(|g| Signal::constant(g).unwrap()));
}

/// A section whose torsion and bending are damped.
fn damped(stiffness: &[f64; 6], mass: &[f64; 4], time: f64) -> SectionInput {
    let mut section = SectionInput::diagonal(stiffness, mass).unwrap();
    for (i, k) in stiffness.iter().enumerate().skip(3) {
        section.damping[(i, i)] = time * k;
    }
    section
}

/// A nylon rod, clamped at one end, shaken at the other: vibrations as large as half its length.
pub fn forced_cantilever() -> Example {
    let stiffness = [785e3, 250e3, 250e3, 14.0, 19.6, 19.6];
    let nylon = damped(&stiffness, &[0.361, 18.0e-6, 9.0e-6, 9.0e-6], 5e-3);
    let (root, y) = (Vector3::zeros(), Vector3::y());
    let mut model = Model::new();
    let rod = model
        .add_straight_beam(&root, &Vector3::x(), &y, &nylon, 2, 4)
        .unwrap();
    let clamp = [None, Some(rod.first_node)];
    joint(&mut model, JointKind::Rigid, clamp, &root, &y);
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let shake = [0.0, 0.0, 12.0, 0.0, 0.0, 0.0];
    add_load(
        &mut model,
        rod.last_node,
        LoadFrame::Space,
        &[0.0; 6],
        &shake,
    );
    Example {
        name: "forced cantilever",
        model,
        period: 0.3,
    }
}

/// A blade, clamped to a hub that turns about a horizontal shaft, loaded by its weight and at its
/// tip.
pub fn rotor_blade() -> Example {
    let pitch = 8f64.to_radians();
    let stiffness = [500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6];
    let profile = damped(&stiffness, &[20.0, 0.20, 0.15, 0.05], 0.01);
    let (root, tip) = (Vector3::new(0.0, 0.0, 0.5), Vector3::new(0.0, 0.0, 10.5));
    let flapwise = Vector3::new(pitch.cos(), pitch.sin(), 0.0);
    let mut model = Model::new();
    let ball = Matrix3::identity();
    let m = &mut model;
    let hub = Some(m.add_rigid_body(1.0, &Vector3::zeros(), &ball).unwrap());
    let blade = m
        .add_straight_beam(&root, &tip, &flapwise, &profile, 2, 4)
        .unwrap();
    let x = Vector3::x();
    let bearing = revolute(m, None, hub, &Vector3::zeros(), &x);
    joint(
        m,
        JointKind::Rigid,
        [hub, Some(blade.first_node)],
        &root,
        &x,
    );
    gravity(m, [0.0, 0.0, -9.81]);
    let turn = Signal::harmonics(0.0, TAU, &[], &[]).unwrap();
    m.prescribe(rotation1(bearing), &turn).unwrap();
    let lift = Signal::harmonics(3000.0, 0.0, &[1000.0, 0.0], &[0.0, 200.0]).unwrap();
    let components = [Some(lift), None, None, None, None, None];
    m.add_load(blade.last_node, LoadFrame::Space, components)
        .unwrap();
    Example {
        name: "rotor blade",
        model,
        period: 1.0,
    }
}

pub fn spatial_four_bar(loaded: bool) -> Example {
    let four_bar = FourBar {
        elements: 2,
        loaded,
        ..FourBar::default()
    }
    .build();
    Example {
        name: if loaded {
            "loaded spatial four-bar"
        } else {
            "spatial four-bar"
        },
        model: four_bar.model,
        period: four_bar.period,
    }
}

/// Crank and slider, with a flexible rod of 6 mm steel or a rigid one.
pub fn slider_crank(flexible: bool, omega: f64) -> Example {
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let (shaft, pin, wrist) = (at(0.0), at(0.15), at(0.45));
    let z = Vector3::z();
    let mut model = Model::new();
    let m = &mut model;
    let crank = m
        .add_rigid_body(0.5, &shaft, &diagonal(1e-3, 1e-3, 1e-3))
        .unwrap();
    let slider = m
        .add_rigid_body(0.04, &wrist, &diagonal(1e-5, 1e-5, 1e-5))
        .unwrap();
    let (first, last) = if flexible {
        let stiffness = [5.85e6, 1.95e6, 1.95e6, 10.1, 13.2, 13.2];
        let mut steel =
            SectionInput::diagonal(&stiffness, &[0.222, 1.0e-6, 0.5e-6, 0.5e-6]).unwrap();
        steel.damp_proportionally(1e-4).unwrap();
        let rod = m
            .add_straight_beam(&pin, &wrist, &Vector3::y(), &steel, 2, 3)
            .unwrap();
        (rod.first_node, rod.last_node)
    } else {
        let rod = m
            .add_rigid_body(0.222 * 0.3, &at(0.3), &diagonal(3e-7, 5e-4, 5e-4))
            .unwrap();
        (rod, rod)
    };
    let bearing = revolute(m, None, Some(crank), &shaft, &z);
    revolute(m, Some(crank), Some(first), &pin, &z);
    revolute(m, Some(last), Some(slider), &wrist, &z);
    let guide = [None, Some(slider)];
    joint(m, JointKind::Prismatic, guide, &wrist, &Vector3::x());
    let turn = Signal::harmonics(0.0, omega, &[], &[]).unwrap();
    m.prescribe(rotation1(bearing), &turn).unwrap();
    Example {
        name: if flexible {
            "flexible slider-crank"
        } else {
            "rigid slider-crank"
        },
        model,
        period: TAU / omega,
    }
}

/// Section 7.1 of the paper: a bar on a turning one, with a spring and a damper between them, at
/// rest in the turning frame.
pub fn damped_mechanism() -> Example {
    let omega = 10.0;
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let z = Vector3::z();
    let mut model = Model::new();
    let m = &mut model;
    let bar = |m: &mut Model, x: f64| {
        m.add_rigid_body(1.0, &at(x), &diagonal(1e-3, 0.03, 0.03))
            .unwrap()
    };
    let (first, second) = (bar(m, 0.3), bar(m, 0.9));
    let motor = revolute(m, None, Some(first), &at(0.0), &z);
    let hinge = revolute(m, Some(first), Some(second), &at(0.6), &z);
    m.add_spring_damper(SpringDefinition {
        at: rotation1(hinge),
        stiffness: 5.0,
        damping: 0.2,
        rest: 0.3,
    })
    .unwrap();
    let turn = Signal::harmonics(0.0, omega, &[], &[]).unwrap();
    m.prescribe(rotation1(motor), &turn).unwrap();
    Example {
        name: "damped mechanism",
        model,
        period: TAU / omega,
    }
}

/// A rigid blade, hinged to a turning hub and held by its rotation alone, lifted far up.
pub fn flapping_blade() -> Example {
    let (omega, hinge, length, mass) = (20.0, 0.3, 2.0, 3.0);
    let mut model = Model::new();
    let m = &mut model;
    let ball = Matrix3::identity();
    let hub = m.add_rigid_body(1.0, &Vector3::zeros(), &ball).unwrap();
    let middle = Vector3::new(hinge + 0.5 * length, 0.0, 0.0);
    let rod = diagonal(0.0, 1.0, 1.0) * (mass * length * length / 12.0);
    let blade = m.add_rigid_body(mass, &middle, &rod).unwrap();
    let shaft = revolute(m, None, Some(hub), &Vector3::zeros(), &Vector3::z());
    let flap = Vector3::new(hinge, 0.0, 0.0);
    let flap = revolute(m, Some(hub), Some(blade), &flap, &-Vector3::y());
    m.add_spring_damper(SpringDefinition {
        at: rotation1(flap),
        stiffness: 0.0,
        damping: 60.0,
        rest: 0.0,
    })
    .unwrap();
    let turn = Signal::harmonics(0.0, omega, &[], &[]).unwrap();
    m.prescribe(rotation1(shaft), &turn).unwrap();
    let lift = [0.0, 0.0, 200.0, 0.0, 0.0, 0.0];
    add_load(m, blade, LoadFrame::Follower, &lift, &lift);
    Example {
        name: "flapping blade",
        model,
        period: TAU / omega,
    }
}

/// A Scotch yoke of rigid bodies, whose crank does not turn evenly.
pub fn scotch_yoke() -> Example {
    let (radius, omega) = (0.4, 6.0);
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let spin = diagonal(0.02, 0.025, 0.03);
    let mut model = Model::new();
    let m = &mut model;
    let pin = x * radius;
    let beside = Vector3::new(0.9, 0.0, 0.0);
    let crank = Some(m.add_rigid_body(1.0, &Vector3::zeros(), &spin).unwrap());
    let block = Some(m.add_rigid_body(0.5, &pin, &spin).unwrap());
    let yoke = Some(m.add_rigid_body(2.0, &beside, &spin).unwrap());
    let motor = revolute(m, None, crank, &Vector3::zeros(), &z);
    joint(m, JointKind::Cylindrical, [crank, block], &pin, &z);
    joint(m, JointKind::Cylindrical, [yoke, block], &pin, &y);
    joint(m, JointKind::Cylindrical, [None, yoke], &beside, &x);
    let turn = Signal::harmonics(0.0, omega, &[0.0], &[0.2]).unwrap();
    m.prescribe(rotation1(motor), &turn).unwrap();
    Example {
        name: "Scotch yoke",
        model,
        period: TAU / omega,
    }
}

/// `m ü + c u̇ + k u + k₃ u³ = f cos ωt`, strongly nonlinear.
pub fn duffing() -> Example {
    let (mut model, at) = mass_on_a_slide(1.3, &Vector3::x());
    model
        .add_polynomial_spring_damper(at, &[2.0, 0.0, 3.0], &[0.4], 0.0)
        .unwrap();
    model.add_actuator(at, &cosine(4.0)).unwrap();
    Example {
        name: "Duffing's oscillator",
        model,
        period: TAU / 0.9,
    }
}

/// A linear oscillator whose only load is the fifteenth harmonic: coarse grids take it for another.
pub fn high_harmonic() -> Example {
    let (mut model, at) = mass_on_a_slide(2.0, &Vector3::z());
    model
        .add_spring_damper(SpringDefinition {
            at,
            stiffness: 50.0,
            damping: 1.2,
            rest: 0.0,
        })
        .unwrap();
    let load = SignalFunctionOf(|t: f64| 3.0 * (15.0 * TAU * t / 8.0).cos()).signal();
    model.add_actuator(at, &load).unwrap();
    Example {
        name: "fifteenth harmonic",
        model,
        period: 8.0,
    }
}

struct SignalFunctionOf<F>(F);

impl<F: Fn(f64) -> f64 + Send + Sync + 'static> SignalFunctionOf<F> {
    fn signal(self) -> Signal {
        Signal::function(std::sync::Arc::new(move |t| Ok((self.0)(t))))
    }
}

pub fn swinging() -> Example {
    Example {
        name: "double pendulum",
        model: double_pendulum().0,
        period: DOUBLE_PENDULUM_PERIOD,
    }
}

/// The planar four-bar mechanism with a crooked axis of section 7.3 of the paper: narrow peaks of
/// forces where all bars lie in a line.
pub fn planar_four_bar() -> Example {
    let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let [a, b, c, d] = [at(0.0, 0.0), at(0.0, 0.12), at(0.24, 0.12), at(0.24, 0.0)];
    let (y, z, back) = (Vector3::y(), Vector3::z(), -Vector3::x());
    let crooked = 5f64.to_radians();
    let axis_c = Vector3::new(crooked.sin(), 0.0, crooked.cos());
    let steel16 = SectionInput::diagonal(
        &[52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0],
        &[1.997, 85.20e-6, 42.60e-6, 42.60e-6],
    )
    .unwrap();
    let steel8 = SectionInput::diagonal(
        &[13.25e6, 4.220e6, 4.220e6, 45.84, 70.66, 70.66],
        &[0.4992, 5.324e-6, 2.662e-6, 2.662e-6],
    )
    .unwrap();
    let mut model = Model::new();
    let m = &mut model;
    let crank = m.add_straight_beam(&a, &b, &back, &steel16, 5, 1).unwrap();
    let coupler = m.add_straight_beam(&b, &c, &y, &steel16, 5, 1).unwrap();
    let rocker = m.add_straight_beam(&c, &d, &back, &steel8, 5, 1).unwrap();
    let motor = revolute(m, None, Some(crank.first_node), &a, &z);
    let (left, right) = (Some(crank.last_node), Some(coupler.first_node));
    revolute(m, left, right, &b, &z);
    let (left, right) = (Some(coupler.last_node), Some(rocker.first_node));
    revolute(m, left, right, &c, &axis_c);
    revolute(m, None, Some(rocker.last_node), &d, &z);
    let turn = Signal::harmonics(0.0, -0.6, &[], &[]).unwrap();
    let at = JointCoordinate {
        joint: motor,
        coordinate: Coordinate::Rotation1,
    };
    m.prescribe(at, &turn).unwrap();
    Example {
        name: "planar four-bar",
        model,
        period: TAU / 0.6,
    }
}

/// All whose response is smooth.
pub fn smooth() -> Vec<Example> {
    vec![
        forced_cantilever(),
        rotor_blade(),
        spatial_four_bar(false),
        spatial_four_bar(true),
        slider_crank(false, 120.0),
        slider_crank(true, 120.0),
        damped_mechanism(),
        flapping_blade(),
        scotch_yoke(),
        duffing(),
        high_harmonic(),
        swinging(),
    ]
}
