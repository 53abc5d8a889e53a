//! Natural modes and damped eigenvalues against closed forms.

mod common;

use common::*;
use nalgebra::{Complex, Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame, MaxwellBranch};
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::output::{BeamQuantity, JointQuantity, Modes, NodeQuantity};
use periodyn::solve::*;
use periodyn::system::Standstill;
use std::f64::consts::{PI, TAU};

fn try_modes(model: &Model, options: &ModesOptions) -> periodyn::error::Result<Modes> {
    Modes::solve(model, options, &mut |_, _| true)
}

fn modes_with(model: &Model, options: &ModesOptions) -> Modes {
    let modes = try_modes(model, options).unwrap();
    assert_eq!(modes.outcome(), Outcome::Converged, "{}", modes.report());
    for mode in modes.modes() {
        assert!(mode.residual < 1e-12, "{}", modes.report());
    }
    modes
}

fn modes(model: &Model, count: usize) -> Modes {
    modes_with(
        model,
        &ModesOptions {
            count,
            ..ModesOptions::default()
        },
    )
}

fn turning(angular_velocity: Vector3<f64>, count: usize) -> ModesOptions {
    ModesOptions {
        equilibrium: StaticOptions {
            standstill: Standstill {
                angular_velocity,
                ..Standstill::default()
            },
            ..StaticOptions::default()
        },
        count,
        near_frequency: None,
    }
}

fn values(modes: &Modes) -> Vec<Complex<f64>> {
    modes.modes().iter().map(|m| m.eigenvalue).collect()
}

fn frequencies(modes: &Modes) -> Vec<f64> {
    modes.modes().iter().map(|m| m.eigenvalue.im).collect()
}

/// A slender beam of unit length, mass and bending stiffnesses along `x`: its radius of gyration is
/// `r`, its bending stiffness about axis 3 `soft` and about axis 2 one.
struct Slender {
    r: f64,
    soft: f64,
    elements: usize,
    degree: usize,
}

impl Slender {
    fn add(&self, model: &mut Model, damping_time: f64) -> BeamIds {
        let Slender {
            r,
            soft,
            elements,
            degree,
        } = *self;
        let axial = 1.0 / (r * r);
        let shear = 0.35 * axial;
        let mut section = SectionInput::diagonal(
            &[axial, shear, shear, 0.7, 1.0, soft],
            &[1.0, 2.0 * r * r, r * r, r * r],
        )
        .unwrap();
        section.damp_proportionally(damping_time).unwrap();
        let (start, end) = (Vector3::zeros(), Vector3::x());
        model
            .add_straight_beam(&start, &end, &Vector3::y(), &section, elements, degree)
            .unwrap()
    }

    /// Clamped at its start.
    fn clamped(&self) -> (Model, BeamIds) {
        let mut model = Model::new();
        let ids = self.add(&mut model, 0.0);
        clamp(&mut model, ids.first_node);
        (model, ids)
    }
}

/// The beam, alike in both directions, on 4 elements of degree 7, clamped at its start.
fn cantilever(r: f64) -> (Model, BeamIds) {
    let beam = Slender {
        r,
        soft: 1.0,
        elements: 4,
        degree: 7,
    };
    beam.clamped()
}

/// Bending frequency of a Timoshenko cantilever near `guess`, with the section above (`soft` = 1).
///
/// `EI φ'' + kGA (w' − φ) + ω² ρI φ = 0`, `kGA (w'' − φ') + ω² m w = 0`: the determinant of the
/// free end's conditions over the two solutions from the clamped end, each integrated by the matrix
/// exponential.
fn timoshenko(r: f64, guess: f64) -> f64 {
    let shear = 0.35 / (r * r);
    let determinant = |w: f64| {
        // State (w, φ, Q = kGA (w' − φ), M = EI φ').
        let w2 = w * w;
        let a = nalgebra::Matrix4::new(
            0.0,
            1.0,
            1.0 / shear,
            0.0,
            0.0,
            0.0,
            0.0,
            1.0,
            -w2,
            0.0,
            0.0,
            0.0,
            0.0,
            -w2 * r * r,
            -1.0,
            0.0,
        );
        let end = a.exp();
        end[(2, 2)] * end[(3, 3)] - end[(2, 3)] * end[(3, 2)]
    };
    let (mut a, mut b) = (0.97 * guess, 1.01 * guess);
    let (mut fa, fb) = (determinant(a), determinant(b));
    assert!(fa * fb < 0.0, "no root between {a} and {b}");
    for _ in 0..100 {
        let middle = 0.5 * (a + b);
        let f = determinant(middle);
        if f * fa > 0.0 {
            (a, fa) = (middle, f);
        } else {
            b = middle;
        }
    }
    0.5 * (a + b)
}

/// What rounding leaves of frequencies: it grows with the ratio of stiffnesses, 1/r².
fn rounding(r: f64) -> f64 {
    2e-14 / (r * r)
}

const CANTILEVER: [f64; 3] = [1.875104068712, 4.694091132974, 7.854757438238];

#[test]
fn clamped_free_beam() {
    for r in [1e-3, 1e-4] {
        let rounding = rounding(r);
        let (model, _) = cantilever(r);
        let found = modes(&model, 6);
        for (k, w) in frequencies(&found).iter().enumerate() {
            let beta = CANTILEVER[k / 2];
            // Shear and rotary inertia lower it by about (1 + 1/0.35) (β r)² / 2.
            assert!(
                (w / (beta * beta) - 1.0).abs() < 3.0 * (beta * r).powi(2) + rounding,
                "{k}: {w}"
            );
            let exact = timoshenko(r, beta * beta);
            assert!(
                (w / exact - 1.0).abs() < rounding,
                "{k}: {:e}",
                w / exact - 1.0
            );
            assert!(found.modes()[k].eigenvalue.re.abs() < rounding * w);
        }
    }
    // A thick one: the difference to the slender limit is large.
    let r = 0.05;
    let (model, _) = cantilever(r);
    let found = frequencies(&modes(&model, 2));
    let exact = timoshenko(r, CANTILEVER[0].powi(2) * 0.985);
    assert!((exact / CANTILEVER[0].powi(2) - 1.0).abs() > 0.01);
    for w in found {
        let error = (w / exact - 1.0).abs();
        assert!(error < rounding(r), "{error:e}");
    }
}

#[test]
fn clamped_clamped_and_hinged_beams() {
    let r = 2e-3;
    let beam = Slender {
        r,
        soft: 1.0,
        elements: 4,
        degree: 7,
    };
    let mut model = Model::new();
    let ids = beam.add(&mut model, 0.0);
    clamp(&mut model, ids.first_node);
    clamp(&mut model, ids.last_node);
    for (k, w) in frequencies(&modes(&model, 4)).iter().enumerate() {
        let beta: f64 = [4.730040744863, 7.853204624096][k / 2];
        assert!(
            (w / (beta * beta) - 1.0).abs() < 5.0 * (beta * r).powi(2),
            "{k}: {w}"
        );
    }
    // Hinged about z at both ends, one of which slides: only bending about z is soft there.
    let mut model = Model::new();
    let ids = beam.add(&mut model, 0.0);
    let z = Vector3::z();
    revolute(
        &mut model,
        None,
        Some(ids.first_node),
        &Vector3::zeros(),
        &z,
    );
    revolute(&mut model, None, Some(ids.last_node), &Vector3::x(), &z);
    let all = frequencies(&modes(&model, 6));
    // Timoshenko, simply supported: with k = nπ, the lower root of
    // m ρI ω⁴ − ω² (m (kGA + EI k²) + ρI kGA k²) + EI kGA k⁴ = 0.
    for n in 1..=3 {
        let k2 = (n as f64 * PI).powi(2);
        let shear = 0.35 / (r * r);
        let b = shear + k2 + r * r * shear * k2;
        let w2 = 2.0 * shear * k2 * k2 / (b + (b * b - 4.0 * r * r * shear * k2 * k2).sqrt());
        let nearest = largest_closeness(&all, w2.sqrt());
        assert!(nearest < 1e-8, "{n}: {nearest:e}");
    }
}

/// Smallest relative distance of any of `values` to `exact`.
fn largest_closeness(values: &[f64], exact: f64) -> f64 {
    values
        .iter()
        .map(|w| (w / exact - 1.0).abs())
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn free_free_beam_has_six_free_motions() {
    let r = 2e-3;
    let mut model = Model::new();
    Slender {
        r,
        soft: 1.0,
        elements: 4,
        degree: 7,
    }
    .add(&mut model, 0.0);
    let found = modes(&model, 10);
    let all = frequencies(&found);
    for mode in &found.modes()[..6] {
        assert_eq!(mode.eigenvalue, Complex::new(0.0, 0.0));
        assert_eq!((mode.frequency(), mode.damping_ratio()), (0.0, 0.0));
    }
    for (k, w) in all[6..].iter().enumerate() {
        let beta: f64 = [4.730040744863, 7.853204624096][k / 2];
        assert!(
            (w / (beta * beta) - 1.0).abs() < 5.0 * (beta * r).powi(2),
            "{k}: {w}"
        );
    }
    // And two free bodies have twelve.
    let mut model = Model::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5));
    for x in [0.0, 1.0] {
        model
            .add_rigid_body(1.0 + x, &Vector3::new(x, 0.0, 0.0), &inertia)
            .unwrap();
    }
    let found = modes(&model, 20);
    assert_eq!(found.modes().len(), 12, "{}", found.report());
    assert!(values(&found).iter().all(|s| *s == Complex::new(0.0, 0.0)));
}

#[test]
fn turning_blade() {
    // Wright et al. 1982: hub radius zero, flap frequencies for η = Ω √(mL⁴/EI); here m = L = EI =
    // 1.
    let r = 3e-4;
    let table: [(f64, [f64; 3]); 2] = [
        (2.0, [4.13732, 22.61492, 62.27318]),
        (6.0, [7.36037, 26.80908, 66.68391]),
    ];
    for (eta, flap) in table {
        let (model, ids) = cantilever(r);
        let found = modes_with(&model, &turning(Vector3::z() * eta, 6));
        for (k, w) in frequencies(&found).iter().enumerate() {
            let flap = flap[k / 2];
            let expected: f64 = if k % 2 == 0 {
                (flap * flap - eta * eta).sqrt()
            } else {
                flap
            };
            assert!(
                (w / expected - 1.0).abs() < 1e-4,
                "{eta}, {k}: {w} {expected}"
            );
            // Lag moves in the plane, flap out of it. The squares of their frequencies differ by
            // that of the speed: rounding mixes them as it is large beside that.
            let mixed = 2.0 * rounding(r) * (flap / eta).powi(2);
            let tip = found.shape(k, ids.last_node).unwrap();
            let (lag, flap) = (tip[1].norm(), tip[2].norm());
            assert!(if k % 2 == 0 {
                flap < mixed * lag
            } else {
                lag < mixed * flap
            });
        }
    }
}

#[test]
fn whirling_shaft() {
    // A simply supported shaft that turns, seen from the frame that turns with it: backward and
    // forward whirl, m (1 + k² r²) ω² − 2 m r² k² Ω ω − EI k⁴ = 0 in space, ω − Ω in the frame.
    // Without the section's shear, which is made stiff.
    let (r, speed) = (0.05f64, 12.0);
    let mut model = Model::new();
    let section = SectionInput::diagonal(
        &[1e6, 1e6, 1e6, 1e3, 1.0, 1.0],
        &[1.0, 2.0 * r * r, r * r, r * r],
    )
    .unwrap();
    let (start, end) = (Vector3::zeros(), Vector3::x());
    let ids = model
        .add_straight_beam(&start, &end, &Vector3::y(), &section, 3, 8)
        .unwrap();
    let node = Some(ids.first_node);
    // Held against turning about its axis and moving along it at one end.
    let frame = Model::frame_at("axis", &start, &Vector3::x()).unwrap();
    model
        .add_joint(JointKind::Universal, None, node, &frame, &frame)
        .unwrap();
    let axis = Model::frame_at("axis", &end, &Vector3::x()).unwrap();
    let node = Some(ids.last_node);
    let ball = model
        .add_rigid_body(1.0, &end, &Matrix3::identity())
        .unwrap();
    model
        .add_joint(JointKind::Spherical, Some(ball), node, &axis, &axis)
        .unwrap();
    model
        .add_joint(JointKind::Prismatic, None, Some(ball), &axis, &axis)
        .unwrap();
    let found = modes_with(&model, &turning(Vector3::x() * speed, 6));
    let all = frequencies(&found);
    for n in 1..=2 {
        let k2 = (n as f64 * PI).powi(2);
        let (a, b) = (1.0 + k2 * r * r, r * r * k2 * speed);
        let root = (b * b + a * k2 * k2).sqrt();
        for whirl in [(b + root) / a, (b - root) / a] {
            let exact = (whirl - speed).abs();
            let nearest = largest_closeness(&all, exact);
            // Shear of 1e-6 EI k²/kGA.
            assert!(nearest < 3e-5, "{n}: {exact} {}", found.report());
        }
    }
}

/// Roots of a polynomial with real coefficients, highest first, by Durand and Kerner's iteration.
fn roots(coefficients: &[f64]) -> Vec<Complex<f64>> {
    let degree = coefficients.len() - 1;
    let value = |s: Complex<f64>| {
        coefficients
            .iter()
            .fold(Complex::from(0.0), |sum, c| sum * s + *c)
            / coefficients[0]
    };
    let mut roots: Vec<Complex<f64>> = (0..degree)
        .map(|k| Complex::new(0.4, 0.9).powi(k as i32) * 3.0)
        .collect();
    for _ in 0..2000 {
        for i in 0..degree {
            let others: Complex<f64> = (0..degree)
                .filter(|j| *j != i)
                .map(|j| roots[i] - roots[j])
                .product();
            let step = value(roots[i]) / others;
            roots[i] -= step;
        }
    }
    roots
}

fn assert_eigenvalues(found: &Modes, exact: &[Complex<f64>], tolerance: f64) {
    let expected: Vec<_> = exact.iter().filter(|s| s.im > -1e-12 * s.norm()).collect();
    assert_eq!(
        found.modes().len(),
        expected.len(),
        "{} {exact:?}",
        found.report()
    );
    for s in expected {
        let nearest = values(found)
            .iter()
            .map(|v| (v - s).norm())
            .fold(f64::INFINITY, f64::min);
        assert!(
            nearest < tolerance * s.norm(),
            "{s}: {nearest:e} {}",
            found.report()
        );
    }
}

#[test]
fn double_pendulum_with_dampers() {
    let (m, l, g) = (1.3, 0.7, 9.81);
    let (j1, j2) = (0.05, 0.11);
    let mut model = Model::new();
    let down = -Vector3::z();
    let y = -Vector3::y();
    let first = model
        .add_rigid_body(m, &(down * l), &(Matrix3::identity() * j1))
        .unwrap();
    let second = model
        .add_rigid_body(2.0 * m, &(down * 2.0 * l), &(Matrix3::identity() * j2))
        .unwrap();
    let top = revolute(&mut model, None, Some(first), &Vector3::zeros(), &y);
    let knee = revolute(&mut model, Some(first), Some(second), &(down * l), &y);
    gravity(&mut model, [0.0, 0.0, -g]);
    for (c1, c2) in [(0.0, 0.0), (0.8, 0.3), (30.0, 0.2)] {
        let mut model = model.clone();
        for (joint, damping) in [(top, c1), (knee, c2)] {
            spring(&mut model, rotation1(joint), 0.0, damping);
        }
        // Absolute angles: masses m at l, 2m at l and l further.
        let (m11, m12, m22) = (3.0 * m * l * l + j1, 2.0 * m * l * l, 2.0 * m * l * l + j2);
        let (k1, k2) = (3.0 * m * g * l, 2.0 * m * g * l);
        let a = [m11, c1 + c2, k1];
        let b = [m12, -c2, 0.0];
        let d = [m22, c2, k2];
        let times = |p: [f64; 3], q: [f64; 3]| {
            let mut r = [0.0; 5];
            for i in 0..3 {
                for j in 0..3 {
                    r[i + j] += p[i] * q[j];
                }
            }
            r
        };
        let (ad, bb) = (times(a, d), times(b, b));
        let polynomial: Vec<f64> = (0..5).map(|i| ad[i] - bb[i]).collect();
        let found = modes(&model, 8);
        assert_eigenvalues(&found, &roots(&polynomial), 1e-11);
        let top = &found.modes()[0];
        assert!(top.damping_ratio() <= 1.0 && top.damping_ratio() >= -1e-11);
    }
}

#[test]
fn stiffness_proportional_damping() {
    // s² + τ ω² s + ω² = 0 for each undamped ω, also for those that are overdamped.
    let beam = Slender {
        r: 0.02,
        soft: 0.6,
        elements: 2,
        degree: 7,
    };
    let build = |tau: f64| {
        let mut model = Model::new();
        let ids = beam.add(&mut model, tau);
        clamp(&mut model, ids.first_node);
        model
    };
    let undamped = frequencies(&modes(&build(0.0), 8));
    let tau = 0.01;
    let found = modes(&build(tau), 8);
    for mode in found.modes() {
        let s = mode.eigenvalue;
        // Inverted for ω: s² = −ω² (1 + τ s).
        let w2 = -s * s / (1.0 + tau * s);
        let nearest = largest_closeness(&undamped, w2.re.sqrt());
        assert!(nearest < 1e-9 && w2.im.abs() < 1e-9 * w2.re, "{s}");
    }
    let slowest = &found.modes()[0];
    assert!((slowest.damping_ratio() - 0.5 * tau * undamped[0]).abs() < 1e-10);
}

#[test]
fn slider_crank_with_a_spring() {
    // A crank in line with its link, a slider, a spring at the crank's hinge: at q = 0 the slider
    // does not move to first order, and the link turns by −q (crank)/(link).
    let (a, b) = (0.4, 1.0);
    let (mc, ml, ms) = (0.5, 0.8, 2.0);
    let (jc, jl) = (0.02, 0.07);
    let stiffness = 35.0;
    let mut model = Model::new();
    let z = Vector3::z();
    let at = |x: f64| Vector3::new(x, 0.0, 0.0);
    let crank = model
        .add_rigid_body(mc, &at(0.5 * a), &(Matrix3::identity() * jc))
        .unwrap();
    let link = model
        .add_rigid_body(ml, &at(a + 0.5 * b), &(Matrix3::identity() * jl))
        .unwrap();
    let slider = model
        .add_rigid_body(ms, &at(a + b), &(Matrix3::identity() * 0.01))
        .unwrap();
    let hinge = revolute(&mut model, None, Some(crank), &at(0.0), &z);
    revolute(&mut model, Some(crank), Some(link), &at(a), &z);
    let pin = Model::frame_at("axis", &at(a + b), &z).unwrap();
    // Three translations only: the link already turns about z.
    model
        .add_joint(JointKind::Spherical, Some(link), Some(slider), &pin, &pin)
        .unwrap();
    let guide = Model::frame_at("axis", &at(a + b), &Vector3::x()).unwrap();
    model
        .add_joint(JointKind::Prismatic, None, Some(slider), &guide, &guide)
        .unwrap();
    spring(&mut model, rotation1(hinge), stiffness, 0.0);
    let found = modes(&model, 5);
    // Velocities for q̇ = 1: crank's centre a/2, link's turn −a/b, link's centre a/2 across.
    let inertia = jc + mc * a * a / 4.0 + jl * (a / b).powi(2) + ml * a * a / 4.0;
    let expected = (stiffness / inertia).sqrt();
    assert_eq!(found.modes().len(), 1, "{}", found.report());
    assert!(
        (frequencies(&found)[0] / expected - 1.0).abs() < 1e-8,
        "{}",
        found.report()
    );
}

#[test]
fn nearest_to_a_frequency() {
    let beam = Slender {
        r: 0.02,
        soft: 0.6,
        elements: 4,
        degree: 6,
    };
    let mut model = Model::new();
    let ids = beam.add(&mut model, 1e-4);
    clamp(&mut model, ids.first_node);
    let all = modes(&model, 18);
    let wanted = 150.0;
    let options = ModesOptions {
        count: 4,
        near_frequency: Some(wanted),
        ..ModesOptions::default()
    };
    let near = modes_with(&model, &options);
    let mut expected = values(&all);
    let distance = |s: &Complex<f64>| (s - Complex::new(0.0, wanted)).norm();
    expected.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    assert!(distance(&expected[4]) < distance(values(&all).last().unwrap()));
    for (found, expected) in values(&near).iter().zip(&expected) {
        assert!(
            (found - expected).norm() < 1e-9 * expected.norm(),
            "{found} {expected}"
        );
    }
    assert_eq!(near.modes().len(), 4);
}

#[test]
fn equal_blades_have_multiple_eigenvalues() {
    // Seven equal pendulums: more than the block of the search.
    let mut model = Model::new();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    for k in 0..7 {
        let place = Vector3::new(k as f64, 0.0, 0.0);
        let arm = if k == 6 { 0.1 } else { 0.5 };
        let centre = place - Vector3::z() * arm;
        let body = model
            .add_rigid_body(1.0, &centre, &(Matrix3::identity() * 1e-3))
            .unwrap();
        revolute(&mut model, None, Some(body), &place, &Vector3::y());
    }
    let found = modes(&model, 20);
    let expected = (9.81 * 0.5 / (0.25f64 + 1e-3)).sqrt();
    assert_eq!(found.modes().len(), 7, "{}", found.report());
    for w in &frequencies(&found)[..6] {
        assert!((w / expected - 1.0).abs() < 1e-12);
    }
}

#[test]
fn motion_in_a_mode_is_a_solution() {
    let beam = Slender {
        r: 0.02,
        soft: 0.6,
        elements: 2,
        degree: 6,
    };
    let (mut model, ids) = beam.clamped();
    // Prestressed: bent by a load that stays.
    let load = [0.0, 0.4, 0.0, 0.0, 0.0, 0.0];
    add_load(
        &mut model,
        ids.last_node,
        LoadFrame::Space,
        &load,
        &[0.0; 6],
    );
    for options in [
        ModesOptions {
            count: 3,
            ..ModesOptions::default()
        },
        turning(Vector3::new(0.5, 1.0, 2.0), 3),
    ] {
        let found = modes_with(&model, &options);
        for k in 0..3 {
            let mode = &found.modes()[k];
            let residual = |amplitude: f64| {
                let motion = found.motion(k, amplitude).unwrap();
                assert!((motion.grid().period() - TAU / mode.eigenvalue.im).abs() < 1e-12);
                let force = motion.diagnostics().between.force;
                assert!(motion.diagnostics().error_estimate < 1e-12);
                let strain = motion
                    .beam(0, 0.0, BeamQuantity::Strain, &[0.0, 0.1])
                    .unwrap();
                assert_eq!(strain.len(), 12);
                force
            };
            // The equations of motion hold but for the square of the amplitude.
            let (small, large) = (residual(1e-4), residual(1e-3));
            assert!(large < 1e-3, "{k}: {large:e}");
            assert!(
                (large / small - 100.0).abs() < 10.0,
                "{k}: {small:e} {large:e}"
            );
            assert!(residual(0.0) < 1e-10);
        }
        // What the shape says is what the motion does.
        let motion = found.motion(0, 1e-3).unwrap();
        let still = found.equilibrium().unwrap();
        let node = ids.last_node;
        let at = |s: &periodyn::output::Solution, t: f64| {
            Vector3::from_vec(s.node(node, NodeQuantity::Position, &[t]).unwrap())
        };
        let moved = at(&motion, 0.0) - at(&still, 0.0);
        let shape = found.shape(0, node).unwrap();
        let rotation = still
            .node(node, NodeQuantity::RotationMatrix, &[0.0])
            .unwrap();
        let linear = Vector3::new(shape[0].re, shape[1].re, shape[2].re) * 1e-3;
        let expected = Matrix3::from_vec(rotation) * linear;
        assert!((moved - expected).norm() < 1e-2 * expected.norm());
    }
}

#[test]
fn a_motion_in_a_plane_does_not_leave_it() {
    // Softer in the plane of axes 1 and 2, in which the first mode bends it.
    let beam = Slender {
        r: 0.01,
        soft: 0.3,
        elements: 3,
        degree: 4,
    };
    let (model, _) = beam.clamped();
    let found = modes(&model, 2);
    for (mode, plane) in [(0, [0, 1, 5]), (1, [0, 2, 4])] {
        let motion = found.motion(mode, 0.1).unwrap();
        for node in 0..model.node_count() {
            let shape = found.shape(mode, node).unwrap();
            let mut out = (0..6).filter(|i| !plane.contains(i));
            assert!(out.all(|i| shape[i] == Complex::default()));
            let times = [0.1, 0.4];
            let position = motion.node(node, NodeQuantity::Position, &times).unwrap();
            assert!(position.chunks(3).all(|x| x[2 - mode] == 0.0));
        }
    }
}

#[test]
fn overdamped_and_free_motions_have_solutions() {
    let (mut model, joint) = hinged_body(
        1.0,
        &Vector3::x(),
        &(Matrix3::identity() * 0.1),
        &Vector3::z(),
    );
    let free = modes(&model, 3);
    assert_eq!(values(&free), [Complex::new(0.0, 0.0)]);
    let motion = free.motion(0, 0.1).unwrap();
    assert_eq!(motion.grid().period(), 1.0);
    let angle = JointQuantity::Coordinate(Coordinate::Rotation1);
    let values_at = motion.joint(joint, angle, &[0.0, 0.5]).unwrap();
    assert!((values_at[0] + values_at[1]).abs() < 1e-12 && values_at[0].abs() > 0.02);

    spring(&mut model, rotation1(joint), 2.2, 5.5);
    // 1.1 s² + 5.5 s + 2.2 = 0.
    let damped = modes(&model, 3);
    assert_eigenvalues(&damped, &roots(&[1.1, 5.5, 2.2]), 1e-12);
    let slow = damped.modes()[0].eigenvalue;
    assert_eq!((slow.im, damped.modes()[0].damping_ratio()), (0.0, 1.0));
    let motion = damped.motion(0, 0.1).unwrap();
    assert!((motion.grid().period() - TAU / slow.norm()).abs() < 1e-12);
    // A damper alone: free to stay anywhere, and slowed down.
    let (mut model, joint) = hinged_body(
        1.0,
        &Vector3::x(),
        &(Matrix3::identity() * 0.1),
        &Vector3::z(),
    );
    spring(&mut model, rotation1(joint), 0.0, 5.5);
    let found = values(&modes(&model, 3));
    assert_eq!(found.len(), 2);
    assert_eq!(found[0], Complex::new(0.0, 0.0));
    assert!((found[1] + 5.0).norm() < 1e-9, "{found:?}");
}

#[test]
fn unstable_equilibria_grow() {
    // Upright, held by nothing: s = ± √(m g l / J).
    let (mut model, _) = hinged_body(
        2.0,
        &Vector3::z(),
        &(Matrix3::identity() * 0.5),
        &Vector3::y(),
    );
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let found = modes(&model, 4);
    let s = (2.0 * 9.81 / 2.5f64).sqrt();
    assert_eigenvalues(&found, &[Complex::from(s), Complex::from(-s)], 1e-11);
}

#[test]
fn no_equilibrium_no_modes() {
    // A free body that falls.
    let mut model = Model::new();
    model
        .add_rigid_body(1.0, &Vector3::zeros(), &Matrix3::identity())
        .unwrap();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let found = try_modes(&model, &ModesOptions::default()).unwrap();
    assert_eq!(
        (found.modes().len(), found.outcome()),
        (0, Outcome::Singular)
    );
    assert!(
        found.report().contains("free to move"),
        "{}",
        found.report()
    );
    assert_eq!(found.mode(0).unwrap_err().kind(), ErrorKind::Identifier);
    assert_eq!(found.equilibrium().unwrap().outcome(), Outcome::Singular);
    for (options, name) in [
        (
            ModesOptions {
                count: 0,
                ..ModesOptions::default()
            },
            "options.count",
        ),
        (
            ModesOptions {
                near_frequency: Some(-1.0),
                ..ModesOptions::default()
            },
            "options.near_frequency",
        ),
        (
            ModesOptions {
                near_frequency: Some(f64::NAN),
                ..ModesOptions::default()
            },
            "options.near_frequency",
        ),
    ] {
        let error = try_modes(&model, &options).unwrap_err();
        assert!(error.to_string().starts_with(name), "{error}");
    }
}

#[test]
fn a_maxwell_branch_makes_a_cubic() {
    let (k, kb, j) = (2.2, 3.1, 1.1);
    for tau in [0.05, 0.7, 8.0] {
        let mut model = Model::new();
        let body = model
            .add_rigid_body(1.0, &Vector3::x(), &(Matrix3::identity() * (j - 1.0)))
            .unwrap();
        let z = Vector3::z();
        let joint = revolute(&mut model, None, Some(body), &Vector3::zeros(), &z);
        let branch = MaxwellBranch {
            stiffness: kb,
            relaxation_time: tau,
        };
        model
            .add_viscoelastic(rotation1(joint), k, 0.0, &[branch])
            .unwrap();
        // (J s² + K∞ + K_b) (1 + τ s) − K_b = 0.
        let found = modes(&model, 5);
        assert_eigenvalues(&found, &roots(&[j * tau, j, (k + kb) * tau, k]), 1e-12);
    }
}

#[test]
fn a_spinning_body_nutates() {
    // Held at its centre, A ≠ B: in the frame that turns with it the axis of spin turns by −Ω, and
    // the body nutates by Ω √((C − A) (C − B) / (A B)), Euler's equations; or falls over if C is
    // the middle one.
    let speed = 7.0;
    for (a, b, c) in [(1.0, 1.4, 2.1), (1.6, 1.9, 0.5), (1.0, 2.0, 1.5)] {
        let mut model = Model::new();
        let inertia = Matrix3::from_diagonal(&Vector3::new(a, b, c));
        let place = Vector3::new(0.3, 0.0, 0.2);
        let body = model.add_rigid_body(3.0, &place, &inertia).unwrap();
        let frame = *model.node(body).unwrap();
        model
            .add_joint(JointKind::Spherical, None, Some(body), &frame, &frame)
            .unwrap();
        let mut options = turning(Vector3::z() * speed, 6);
        options.equilibrium.standstill.axis_point = place;
        let found = modes_with(&model, &options);
        let square: f64 = speed * speed * (c - a) * (c - b) / (a * b);
        let mut expected = vec![Complex::from(0.0), Complex::new(0.0, speed)];
        if square > 0.0 {
            expected.push(Complex::new(0.0, square.sqrt()));
        } else {
            expected.extend([1.0, -1.0].map(|sign| Complex::from(sign * (-square).sqrt())));
        }
        assert_eq!(found.modes().len(), expected.len(), "{}", found.report());
        for s in expected {
            let nearest = values(&found)
                .iter()
                .map(|v| (v - s).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-12 * speed, "{s}: {}", found.report());
        }
    }
}

#[test]
fn redundant_and_driven_joints_leave_no_spurious_modes() {
    // A planar four-bar of revolutes: three constraints too many.
    let [a, b, c, d] =
        [(0.0, 0.0), (0.2, 1.0), (2.2, 1.4), (2.0, 0.0)].map(|(x, y)| Vector3::new(x, y, 0.0));
    let mut model = Model::new();
    let (mass, inertia, z) = (1.3, 0.15, Vector3::z());
    let bars = [(a, b), (b, c), (c, d)].map(|(p, q)| {
        let centre = 0.5 * (p + q);
        let body = model.add_rigid_body(mass, &centre, &(Matrix3::identity() * inertia));
        Some(body.unwrap())
    });
    let crank = revolute(&mut model, None, bars[0], &a, &z);
    revolute(&mut model, bars[0], bars[1], &b, &z);
    revolute(&mut model, bars[1], bars[2], &c, &z);
    revolute(&mut model, bars[2], None, &d, &z);
    let stiffness = 40.0;
    let damping = 3.0;
    spring(&mut model, rotation1(crank), stiffness, damping);
    // Velocities for a unit rate of the crank: z × (b − a) + w₂ z × (c − b) = w₃ z × (c − d).
    let solved = nalgebra::Matrix2::new(c.x - b.x, d.x - c.x, c.y - b.y, d.y - c.y)
        .lu()
        .solve(&nalgebra::Vector2::new(a.x - b.x, a.y - b.y))
        .unwrap();
    let (w2, w3) = (solved[0], solved[1]);
    let speeds = [
        (0.5 * (b - a)).norm(),
        ((b - a) + 0.5 * w2 * (c - b)).norm(),
        (0.5 * w3 * (c - d)).norm(),
    ];
    let kinetic: f64 = speeds.iter().map(|v| mass * v * v).sum();
    let effective = kinetic + inertia * (1.0 + w2 * w2 + w3 * w3);
    let found = modes(&model, 20);
    assert!(found.is_complete());
    assert_eigenvalues(&found, &roots(&[effective, damping, stiffness]), 1e-12);
    // Driven, nothing can move.
    model
        .prescribe(rotation1(crank), &Signal::constant(0.2).unwrap())
        .unwrap();
    let found = modes(&model, 20);
    assert!(found.is_complete());
    assert_eq!(found.modes().len(), 0, "{}", found.report());

    // A pendulum on a driven arm, which stands still at 90 degrees.
    let (m, l, j, g) = (0.8, 0.6, 0.02, 9.81);
    let mut model = Model::new();
    gravity(&mut model, [0.0, -g, 0.0]);
    let arm = model
        .add_rigid_body(1.0, &Vector3::x(), &Matrix3::identity())
        .unwrap();
    let bob = model
        .add_rigid_body(m, &Vector3::new(2.0, -l, 0.0), &(Matrix3::identity() * j))
        .unwrap();
    let top = revolute(&mut model, None, Some(arm), &Vector3::zeros(), &z);
    revolute(&mut model, Some(arm), Some(bob), &(2.0 * Vector3::x()), &z);
    let swing = Signal::harmonics(0.5 * PI, 0.0, &[0.0], &[0.3]).unwrap();
    model.prescribe(rotation1(top), &swing).unwrap();
    let found = modes(&model, 5);
    let expected = (m * g * l / (j + m * l * l)).sqrt();
    assert_eigenvalues(&found, &[Complex::new(0.0, expected)], 1e-11);
}

#[test]
fn many_free_motions_are_all_found() {
    // Three equal beams that nothing holds: 18 free motions, and elastic modes of multiplicity six.
    let r = 5e-3;
    let mut model = Model::new();
    for _ in 0..3 {
        Slender {
            r,
            soft: 1.0,
            elements: 2,
            degree: 7,
        }
        .add(&mut model, 0.0);
    }
    let found = modes(&model, 24);
    let zeros = values(&found).iter().filter(|s| s.norm() == 0.0).count();
    assert_eq!((zeros, found.modes().len()), (18, 24), "{}", found.report());
    let elastic = &frequencies(&found)[18..];
    for w in elastic {
        assert!((w / elastic[0] - 1.0).abs() < 1e-9, "{}", found.report());
        assert!((w / 4.730040744863f64.powi(2) - 1.0).abs() < 5.0 * (4.73 * r).powi(2));
    }
}
