//! Modes of a thin disc that spins, clamped at its hub: against the radial eigenvalue equation of
//! a plate under the membrane stress of its rotation, at rest and at three speeds.

mod models;

use models::shells::*;
use nalgebra::{DMatrix, Vector3};
use periodyn::elements::{IsotropicShell, gauss_legendre};
use periodyn::model::*;
use periodyn::output::Modes;
use periodyn::solve::*;
use std::f64::consts::TAU;

const INNER: f64 = 0.3;
const OUTER: f64 = 1.0;
const THICKNESS: f64 = 0.004;
const YOUNG: f64 = 2e11;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 7800.0;

/// Radial and circumferential stress of the disc in rotation, in plane stress: no displacement at
/// the hub, no radial stress at the rim.
fn membrane_stress(omega: f64) -> impl Fn(f64) -> [f64; 2] {
    // u = a r + b/r − k r³ solves u'' + u'/r − u/r² + 8 k r = 0.
    let modulus = YOUNG / (1.0 - POISSON * POISSON);
    let k = DENSITY * omega * omega / (8.0 * modulus);
    let stress = move |a: f64, b: f64, r: f64| {
        let (slope, hoop) = (
            a - b / (r * r) - 3.0 * k * r * r,
            a + b / (r * r) - k * r * r,
        );
        [slope + POISSON * hoop, hoop + POISSON * slope].map(|e| modulus * e)
    };
    // a + b/R_i² = k R_i²; (1 + ν) a − (1 − ν) b/R_o² = (3 + ν) k R_o².
    let (inner, outer) = (INNER * INNER, OUTER * OUTER);
    let (plus, minus) = (1.0 + POISSON, 1.0 - POISSON);
    let b = (plus * k * inner - (3.0 + POISSON) * k * outer) / (plus / inner + minus / outer);
    let a = k * inner - b / inner;
    move |r| stress(a, b, r)
}

/// Frequencies of modes with so many nodal diameters by the weak form of
/// `D ∇⁴w − h (r σ_r w')'/r + h σ_θ n² w/r² = ρ h ω² w`, for `w(r) cos nθ`, clamped at the hub and
/// free at the rim; `w = (r − R_i)² Σ c_k x^k` over a Legendre basis of so many functions.
fn radial_frequencies(omega: f64, diameters: usize, functions: usize) -> Vec<f64> {
    let stress = membrane_stress(omega);
    let bending = YOUNG * THICKNESS.powi(3) / (12.0 * (1.0 - POISSON * POISSON));
    let n2 = (diameters * diameters) as f64;
    let mut stiffness = DMatrix::<f64>::zeros(functions, functions);
    let mut mass = DMatrix::<f64>::zeros(functions, functions);
    let half = 0.5 * (OUTER - INNER);
    for (x, weight) in gauss_legendre(functions + 12) {
        let r = INNER + half * (x + 1.0);
        let weight = weight * half * r;
        let [radial, hoop] = stress(r).map(|s| s * THICKNESS);
        // Legendre polynomials with two derivatives.
        let mut p = vec![[1.0, 0.0, 0.0], [x, 1.0, 0.0]];
        for k in 1..functions {
            let (k, [a, b, c], [d, e, f]) = (k as f64, p[k], p[k - 1]);
            let next = |now: f64, before: f64| ((2.0 * k + 1.0) * now - k * before) / (k + 1.0);
            p.push([next(x * a, d), next(x * b + a, e), next(x * c + 2.0 * b, f)]);
        }
        // (1 + x)² P_k, by r.
        let functions: Vec<[f64; 3]> = (p.iter().take(functions))
            .map(|[p, p1, p2]| {
                let (s, s1, s2) = ((1.0 + x) * (1.0 + x), 2.0 * (1.0 + x), 2.0);
                [
                    s * p,
                    (s1 * p + s * p1) / half,
                    (s2 * p + 2.0 * s1 * p1 + s * p2) / (half * half),
                ]
            })
            .collect();
        // Curvatures: radial, circumferential and twist.
        let curvatures = |[w, w1, w2]: [f64; 3]| {
            let twist = n2.sqrt() * (w1 / r - w / (r * r));
            [w2, w1 / r - n2 * w / (r * r), twist]
        };
        for (i, &u) in functions.iter().enumerate() {
            for (j, &v) in functions.iter().enumerate() {
                let ([a, b, c], [d, e, f]) = (curvatures(u), curvatures(v));
                let bent = a * d + b * e + POISSON * (a * e + b * d);
                let bent = bending * (bent + 2.0 * (1.0 - POISSON) * c * f);
                let drawn = radial * u[1] * v[1] + hoop * n2 * u[0] * v[0] / (r * r);
                stiffness[(i, j)] += weight * (bent + drawn);
                mass[(i, j)] += weight * DENSITY * THICKNESS * u[0] * v[0];
            }
        }
    }
    let factor = mass.cholesky().unwrap().l();
    let left = factor.solve_lower_triangular(&stiffness).unwrap();
    let square = factor.solve_lower_triangular(&left.transpose()).unwrap();
    let squares: Vec<f64> = square.symmetric_eigenvalues().iter().copied().collect();
    let mut found: Vec<f64> = squares.into_iter().map(f64::sqrt).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// The lowest frequencies of the plate, each as often as it occurs, to six digits.
fn plate_frequencies(omega: f64, count: usize) -> Vec<f64> {
    let mut all = Vec::new();
    for diameters in 0..8 {
        let [found, finer] = [12, 15].map(|k| radial_frequencies(omega, diameters, k));
        for (a, b) in found.iter().zip(&finer).take(2) {
            assert!((a - b).abs() < 1e-7 * b, "{diameters}: {a} {b}");
            all.extend(vec![*b; if diameters == 0 { 1 } else { 2 }]);
        }
    }
    all.sort_by(f64::total_cmp);
    all.truncate(count);
    all
}

fn shell_frequencies(omega: f64, count: usize) -> Vec<f64> {
    let section = IsotropicShell::new(THICKNESS, YOUNG, POISSON, DENSITY);
    let mut model = Model::new();
    let (centre, axis, start) = (Vector3::zeros(), Vector3::z(), Vector3::x());
    let ring = annulus_sector(&centre, &axis, &start, [INNER, OUTER], TAU).unwrap();
    let mesh = mesh([1, 6], [8, 6]);
    let placement = ShellPlacement::default();
    let section = section.section().unwrap();
    let patch = model
        .add_shell_patch(ring, &mesh, &section, &placement)
        .unwrap();
    let mut hub = patch.edge(PatchEdge::StartU);
    hub.pop(); // where the ring closes
    clamp_edge(&mut model, &hub);
    let mut options = ModesOptions {
        count,
        ..ModesOptions::default()
    };
    options.equilibrium.standstill.angular_velocity = axis * omega;
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(modes.outcome(), Outcome::Converged);
    modes
        .modes()
        .iter()
        .map(|mode| mode.eigenvalue.im)
        .collect()
}

#[test]
fn a_spinning_disc_has_the_modes_of_a_plate_under_membrane_stress() {
    let count = 7;
    let slowest = plate_frequencies(0.0, 1)[0];
    for speed in [0.0, 1.0, 2.0, 4.0] {
        let omega = speed * slowest;
        let (found, exact) = (
            shell_frequencies(omega, count),
            plate_frequencies(omega, count),
        );
        println!("speed {speed}: {found:?} {exact:?}");
        assert_eq!(found.len(), count);
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found - exact).abs() < 1e-3 * exact, "{found} {exact}");
        }
    }
}
