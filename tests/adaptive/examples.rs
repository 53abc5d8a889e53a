//! Models with smooth periodic responses of all kinds: flexible and rigid, forced, driven and
//! turning.

use crate::common::models::beams;
use crate::common::models::linkages::hinged_blade;
use crate::common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{JointKind, LoadFrame};
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

fn example(name: &'static str, (model, period): (Model, f64)) -> Example {
    Example {
        name,
        model,
        period,
    }
}

pub fn four_bar(loaded: bool) -> Example {
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

pub fn forced_cantilever() -> Example {
    example("forced cantilever", beams::forced_cantilever(2, 4))
}

pub fn flexible_slider_crank() -> Example {
    let period = TAU / 120.0;
    let model = beams::slider_crank(2, 3, period);
    example("flexible slider-crank", (model, period))
}

/// Crank and slider with a rigid rod.
pub fn rigid_slider_crank(omega: f64) -> Example {
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let (shaft, pin, wrist) = (at(0.0), at(0.15), at(0.45));
    let (x, z) = (Vector3::x(), Vector3::z());
    let mut model = Model::new();
    let m = &mut model;
    let crank = Some(ball(m, 0.5, 1e-3, &shaft));
    let slider = Some(ball(m, 0.04, 1e-5, &wrist));
    let spin = diagonal(3e-7, 5e-4, 5e-4);
    let rod = Some(m.add_rigid_body(0.222 * 0.3, &at(0.3), &spin).unwrap());
    let bearing = revolute(m, None, crank, &shaft, &z);
    revolute(m, crank, rod, &pin, &z);
    revolute(m, rod, slider, &wrist, &z);
    join(m, JointKind::Prismatic, [None, slider], &wrist, &x);
    m.prescribe(rotation1(bearing), &steady(omega)).unwrap();
    example("rigid slider-crank", (model, TAU / omega))
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
    m.prescribe(rotation1(motor), &steady(omega)).unwrap();
    example("damped mechanism", (model, TAU / omega))
}

/// A rigid blade, hinged to a turning hub and held by its rotation alone, lifted far up.
pub fn flapping_blade() -> Example {
    let omega = 20.0;
    let (mut model, blade, [_, flap]) = hinged_blade(&steady(omega), &-Vector3::y());
    spring(&mut model, rotation1(flap), 0.0, 60.0);
    let lift = [0.0, 0.0, 200.0, 0.0, 0.0, 0.0];
    add_load(&mut model, blade, LoadFrame::Follower, &lift, &lift);
    example("flapping blade", (model, TAU / omega))
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
    join(m, JointKind::Cylindrical, [crank, block], &pin, &z);
    join(m, JointKind::Cylindrical, [yoke, block], &pin, &y);
    join(m, JointKind::Cylindrical, [None, yoke], &beside, &x);
    let turn = Signal::harmonics(0.0, omega, &[0.0], &[0.2]).unwrap();
    m.prescribe(rotation1(motor), &turn).unwrap();
    example("Scotch yoke", (model, TAU / omega))
}

/// `m ü + c u̇ + k u + k₃ u³ = f cos ωt`, strongly nonlinear.
pub fn duffing() -> Example {
    let (mut model, at) = mass_on_a_slide(1.3, &Vector3::x());
    model
        .add_polynomial_spring_damper(at, &[2.0, 0.0, 3.0], &[0.4], 0.0)
        .unwrap();
    model.add_actuator(at, &cosine(4.0)).unwrap();
    example("Duffing's oscillator", (model, TAU / 0.9))
}

/// A linear oscillator whose only load is the fifteenth harmonic: coarse grids take it for another.
pub fn high_harmonic() -> Example {
    let (mut model, at) = mass_on_a_slide(2.0, &Vector3::z());
    spring(&mut model, at, 50.0, 1.2);
    let load = SignalFunctionOf(|t: f64| 3.0 * (15.0 * TAU * t / 8.0).cos()).signal();
    model.add_actuator(at, &load).unwrap();
    example("fifteenth harmonic", (model, 8.0))
}

struct SignalFunctionOf<F>(F);

impl<F: Fn(f64) -> f64 + Send + Sync + 'static> SignalFunctionOf<F> {
    fn signal(self) -> Signal {
        Signal::function(std::sync::Arc::new(move |t| Ok((self.0)(t))))
    }
}

pub fn swinging() -> Example {
    example(
        "double pendulum",
        (double_pendulum().0, DOUBLE_PENDULUM_PERIOD),
    )
}

/// Narrow peaks of forces where all bars lie in a line.
pub fn planar_four_bar() -> Example {
    example("planar four-bar", beams::planar_four_bar(5, 1, 0.0))
}

/// All whose response is smooth.
pub fn smooth() -> Vec<Example> {
    vec![
        forced_cantilever(),
        example("rotor blade", beams::rotor_blade(2, 4)),
        four_bar(false),
        four_bar(true),
        rigid_slider_crank(120.0),
        flexible_slider_crank(),
        damped_mechanism(),
        flapping_blade(),
        scotch_yoke(),
        duffing(),
        high_harmonic(),
        swinging(),
    ]
}
