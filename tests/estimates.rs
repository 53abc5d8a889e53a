//! Error estimates of random mechanisms under loads of many harmonics, against much finer grids.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame};
use periodyn::model::*;
use periodyn::output::Solution;
use periodyn::solve::*;
use std::f64::consts::TAU;

struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        let next = self.0.wrapping_mul(6364136223846793005);
        self.0 = next.wrapping_add(1442695040888963407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.number()
    }

    /// Evenly in its logarithm.
    fn scale(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.number() * n as f64) as usize
    }

    /// A load of 1 to 20 harmonics that fall, of a single high one beside a low one, or a sampled pulse.
    fn signal(&mut self, size: f64) -> Signal {
        let mut cosines = vec![0.0; 41];
        let mut sines = vec![0.0; 41];
        match self.below(3) {
            0 => {
                let fall = self.between(0.0, 2.0);
                for j in 0..1 + self.below(20) {
                    let a = size / (1.0 + j as f64).powf(fall);
                    cosines[j] = self.between(-a, a);
                    sines[j] = self.between(-a, a);
                }
            }
            1 => {
                cosines[0] = size;
                let high = self.below(40) + 1;
                sines[high] = size * self.scale(1e-3, 1.0);
            }
            _ => {
                let width = self.between(0.02, 0.3);
                let count = 36 + self.below(100);
                let at = self.number();
                let sample = |k: usize| {
                    let x = k as f64 / count as f64 - at;
                    let x = (x - x.round()) / width;
                    if x.abs() < 0.5 {
                        0.5 * size * (1.0 + (TAU * x).cos())
                    } else {
                        0.0
                    }
                };
                let samples: Vec<f64> = (0..count).map(sample).collect();
                return Signal::samples(0.0, &samples).unwrap();
            }
        }
        Signal::harmonics(0.0, 0.0, &cosines, &sines).unwrap()
    }
}

struct Case {
    name: &'static str,
    model: Model,
    period: f64,
}

fn ball(size: f64) -> Matrix3<f64> {
    Matrix3::identity() * size
}

fn joint(
    m: &mut Model,
    kind: JointKind,
    ends: [Option<usize>; 2],
    point: Vector3<f64>,
    axis: Vector3<f64>,
) -> usize {
    let frame = Model::frame_at("axis", &point, &axis).unwrap();
    m.add_joint(kind, ends[0], ends[1], &frame, &frame).unwrap()
}

fn spring(m: &mut Model, at: JointCoordinate, stiffness: f64, damping: f64) {
    m.add_spring_damper(SpringDefinition {
        at,
        stiffness,
        damping,
        rest: 0.0,
    })
    .unwrap();
}

/// Masses on springs, in a row along a slide.
fn masses(r: &mut Random) -> Case {
    let mut m = Model::new();
    let mut before = None;
    let ratio = r.scale(0.02, 3.0);
    for _ in 0..1 + r.below(3) {
        let body = Some(
            m.add_rigid_body(r.scale(0.5, 2.0), &Vector3::zeros(), &ball(1.0))
                .unwrap(),
        );
        let slide = joint(
            &mut m,
            JointKind::Prismatic,
            [before, body],
            Vector3::zeros(),
            Vector3::x(),
        );
        let at = JointCoordinate {
            joint: slide,
            coordinate: Coordinate::Displacement1,
        };
        let stiffness = (TAU / ratio).powi(2);
        let damping = 2.0 * r.scale(1e-3, 0.1) * TAU / ratio;
        if r.below(2) == 0 {
            let cubic = stiffness * r.scale(0.1, 10.0);
            m.add_polynomial_spring_damper(at, &[stiffness, 0.0, cubic], &[damping], 0.0)
                .unwrap();
        } else {
            spring(&mut m, at, stiffness, damping);
        }
        let force = stiffness * r.scale(0.01, 0.5);
        let load = r.signal(force);
        m.add_actuator(at, &load).unwrap();
        before = body;
    }
    Case {
        name: "masses",
        model: m,
        period: 1.0,
    }
}

/// A crank, a rod that is rigid or flexible, and a loaded slider.
fn slider_crank(r: &mut Random) -> Case {
    let (radius, length) = (0.1, 0.1 * r.between(1.5, 5.0));
    let z = Vector3::z();
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let mut model = Model::new();
    let m = &mut model;
    let crank = m.add_rigid_body(0.5, &at(0.0), &ball(1e-3)).unwrap();
    let slider = m
        .add_rigid_body(0.1, &at(radius + length), &ball(1e-5))
        .unwrap();
    let period = r.scale(0.02, 1.0);
    let (first, last) = if r.below(2) == 0 {
        let rod = m
            .add_rigid_body(0.05, &at(radius + 0.5 * length), &ball(1e-4))
            .unwrap();
        (rod, rod)
    } else {
        let stiffness = [5.85e6, 1.95e6, 1.95e6, 10.1, 13.2, 13.2];
        let mut steel =
            SectionInput::diagonal(&stiffness, &[0.222, 1.0e-6, 0.5e-6, 0.5e-6]).unwrap();
        steel.damp_proportionally(r.scale(1e-5, 1e-3)).unwrap();
        let rod = m
            .add_straight_beam(
                &at(radius),
                &at(radius + length),
                &Vector3::y(),
                &steel,
                1,
                3,
            )
            .unwrap();
        (rod.first_node, rod.last_node)
    };
    let bearing = revolute(m, None, Some(crank), &at(0.0), &z);
    revolute(m, Some(crank), Some(first), &at(radius), &z);
    revolute(m, Some(last), Some(slider), &at(radius + length), &z);
    joint(
        m,
        JointKind::Prismatic,
        [None, Some(slider)],
        at(radius + length),
        Vector3::x(),
    );
    let ripple = r.between(-0.3, 0.3) / 2.0;
    let turn = Signal::harmonics(0.0, TAU / period, &[0.0, ripple], &[ripple, 0.0]).unwrap();
    m.prescribe(rotation1(bearing), &turn).unwrap();
    let mut gas: [Option<Signal>; 6] = [const { None }; 6];
    gas[0] = Some(r.signal(100.0));
    m.add_load(slider, LoadFrame::Space, gas).unwrap();
    Case {
        name: "slider-crank",
        model,
        period,
    }
}

/// A planar four-bar of rigid bars on a flexible or rigid coupler, with a load on it.
fn four_bar(r: &mut Random) -> Case {
    let mut model = Model::new();
    let m = &mut model;
    let z = Vector3::z();
    let at = |x: f64, y: f64| Vector3::new(x, y, 0.0);
    let (a, d) = (at(0.0, 0.0), at(1.0, 0.0));
    let b = at(0.0, r.between(0.15, 0.35));
    let c = at(r.between(0.9, 1.2), r.between(0.6, 0.9));
    let crank = m.add_rigid_body(1.0, &a, &ball(1e-2)).unwrap();
    let rocker = m
        .add_rigid_body(1.0, &(0.5 * (c + d)), &ball(5e-2))
        .unwrap();
    let period = r.scale(0.2, 3.0);
    let (first, last) = if r.below(2) == 0 {
        let coupler = m
            .add_rigid_body(1.0, &(0.5 * (b + c)), &ball(8e-2))
            .unwrap();
        (coupler, coupler)
    } else {
        let stiffness = [2e6, 8e5, 8e5, 200.0, 300.0, 300.0];
        let mut steel = SectionInput::diagonal(&stiffness, &[1.0, 4e-5, 2e-5, 2e-5]).unwrap();
        steel.damp_proportionally(r.scale(1e-4, 1e-2)).unwrap();
        let bar = m.add_straight_beam(&b, &c, &z, &steel, 2, 3).unwrap();
        (bar.first_node, bar.last_node)
    };
    let bearing = revolute(m, None, Some(crank), &a, &z);
    revolute(m, Some(crank), Some(first), &b, &z);
    revolute(m, Some(last), Some(rocker), &c, &z);
    revolute(m, Some(rocker), None, &d, &z);
    let turn = Signal::harmonics(0.0, TAU / period, &[], &[]).unwrap();
    m.prescribe(rotation1(bearing), &turn).unwrap();
    let mut load: [Option<Signal>; 6] = [const { None }; 6];
    load[1] = Some(r.signal(20.0));
    m.add_load(last, LoadFrame::Space, load).unwrap();
    Case {
        name: "four-bar",
        model,
        period,
    }
}

/// A blade, clamped to the ground or to a hub that turns, loaded at its tip.
fn blade(r: &mut Random) -> Case {
    let mut model = Model::new();
    let m = &mut model;
    let stiffness = [1e7, 4e6, 4e6, 60.0, 80.0, 120.0];
    let mut section = SectionInput::diagonal(&stiffness, &[1.0, 4e-4, 2e-4, 2e-4]).unwrap();
    section.damp_proportionally(r.scale(1e-4, 1e-2)).unwrap();
    let root = Vector3::new(0.1, 0.0, 0.0);
    let beam = m
        .add_straight_beam(
            &root,
            &Vector3::new(1.1, 0.0, 0.0),
            &Vector3::y(),
            &section,
            2,
            3,
        )
        .unwrap();
    let clamp = revolute(m, None, Some(beam.first_node), &root, &Vector3::z());
    let first = 3.516 * 80f64.sqrt();
    let period = TAU / (first * r.scale(0.05, 1.0));
    let turn = if r.below(2) == 0 {
        Signal::harmonics(0.0, TAU / period, &[], &[]).unwrap()
    } else {
        Signal::constant(0.0).unwrap()
    };
    m.prescribe(rotation1(clamp), &turn).unwrap();
    let mut load: [Option<Signal>; 6] = [const { None }; 6];
    let size = r_size(r);
    load[2] = Some(r.signal(size));
    m.add_load(beam.last_node, LoadFrame::Space, load).unwrap();
    Case {
        name: "blade",
        model,
        period,
    }
}

fn r_size(r: &mut Random) -> f64 {
    r.scale(1.0, 40.0)
}

/// A pendulum that a torque swings through large angles.
fn pendulum(r: &mut Random) -> Case {
    let mut model = Model::new();
    let m = &mut model;
    let body = m
        .add_rigid_body(1.0, &Vector3::new(0.0, 0.0, -0.5), &ball(0.02))
        .unwrap();
    let hinge = revolute(m, None, Some(body), &Vector3::zeros(), &Vector3::y());
    spring(m, rotation1(hinge), 0.0, r.scale(0.1, 1.0));
    m.set_gravity([0.0, 0.0, -9.81].map(|g| Signal::constant(g).unwrap()));
    let size = r_size(r) / 8.0;
    let torque = r.signal(size);
    m.add_actuator(rotation1(hinge), &torque).unwrap();
    Case {
        name: "pendulum",
        model,
        period: r.scale(0.3, 5.0),
    }
}

fn case(seed: u64) -> Case {
    let mut r = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    for _ in 0..4 {
        r.number();
    }
    let kinds = [masses, slider_crank, four_bar, blade, pendulum];
    kinds[seed as usize % kinds.len()](&mut r)
}

fn true_error(solution: &Solution, exact: &Solution) -> f64 {
    let system = &exact.details().system;
    let there = solution.prolonged(exact.grid()).unwrap();
    there.distance(&exact.details().state, system.scales().length)
}

#[test]
fn measure() {
    let (mut low, mut high, mut old_low, mut old_high, mut all) = (0, 0, 0, 0, 0);
    let from: u64 = std::env::var("FROM").map_or(0, |s| s.parse().unwrap());
    let count: u64 = std::env::var("COUNT").map_or(20, |s| s.parse().unwrap());
    let step: usize = std::env::var("STEP").map_or(1, |s| s.parse().unwrap());
    for seed in (from..from + count).step_by(step) {
        let case = case(seed);
        let Ok(exact) = try_solve(&case.model, case.period, 221) else {
            println!("{seed} {} error", case.name);
            continue;
        };
        if exact.outcome() != Outcome::Converged
            || exact.details().assessment.as_ref().unwrap().parts[1..3]
                .iter()
                .sum::<f64>()
                > 1e-10
        {
            println!(
                "{seed} {} {:?} {:?}",
                case.name,
                exact.outcome(),
                exact.details().assessment.as_ref().map(|a| a.parts)
            );
            if exact.outcome() != Outcome::Converged {
                continue;
            }
        }
        for points in [11, 17, 27, 43, 69, 101] {
            let Ok(solution) = try_solve(&case.model, case.period, points) else {
                continue;
            };
            if solution.outcome() != Outcome::Converged {
                println!("{seed} {} {points} {:?}", case.name, solution.outcome());
                continue;
            }
            let Ok(there) = solution.prolonged(exact.grid()) else {
                println!(
                    "{seed} {} {points} too coarse est {:?}",
                    case.name,
                    solution.diagnostics().error_estimate
                );
                continue;
            };
            let error = there.distance(
                &exact.details().state,
                exact.details().system.scales().length,
            );
            let estimate = solution.diagnostics().error_estimate;
            let p = solution.details().assessment.as_ref().unwrap().parts;
            let old = p[0].max(p[3]);
            println!(
                "{seed:3} {:12} {points:3} error {error:.1e} estimate {estimate:.1e} ratio {:8.2} old {:8.2}  alias {:.1e} left {:.1e} constr {:.1e} decay {:.1e}",
                case.name,
                estimate / error,
                old / error,
                p[1],
                p[2],
                p[3],
                p[0]
            );
            if error > 1e-9 && error < 0.3 {
                all += 1;
                low += usize::from(estimate < error / 3.0);
                high += usize::from(estimate > error * 10.0);
                old_low += usize::from(old < error / 3.0);
                old_high += usize::from(old > error * 10.0);
            }
        }
    }
    println!(
        "of {all}: below a third {low} (old {old_low}), above ten times {high} (old {old_high})"
    );
}

#[test]
fn debug_blade() {
    let case = case(13);
    for points in [101, 151, 301] {
        let solution = try_solve(&case.model, case.period, points).unwrap();
        let a = solution.details().assessment.as_ref().unwrap();
        println!("{points} {:?} {:?}", a.parts, a.between);
        let h = &a.decay.amplitudes;
        println!(
            "{:?}",
            h.iter()
                .enumerate()
                .filter(|(_, x)| **x > 1e-9)
                .map(|(j, x)| format!("{j}:{x:.1e}"))
                .collect::<Vec<_>>()
        );
    }
}
