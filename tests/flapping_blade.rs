//! A hinged blade has no static equilibrium: only its rotation holds it. The default initial guess
//! must march in time, and the answer is known for small flapping.

mod models;

use models::linkages::hinged_blade;
use models::parts::{push, steady};
use nalgebra::Vector3;
use periodyn::elements::Coordinate;
use periodyn::model::Signal;
use periodyn::output::{JointQuantity, Quantity, Solution};
use periodyn::solve::{NewtonOptions, Outcome, PeriodicOptions};
use std::f64::consts::TAU;

#[test]
fn a_blade_held_by_its_rotation_alone_flaps_as_linear_theory_says() {
    let (omega, hinge, length, mass) = (20.0, 0.3, 2.0, 3.0);
    let force = 1e-4;
    // Flapping up, towards z, is a turn about −y.
    let (mut model, blade, [shaft, flap]) = hinged_blade(&steady(omega), &-Vector3::y());
    let lift = Signal::harmonics(0.5 * force, 0.0, &[force], &[0.0]).unwrap();
    push(&mut model, blade, 2, lift);

    let options = PeriodicOptions {
        newton: NewtonOptions {
            tolerance: 1e-10,
            iteration_limit: 20,
        },
        ..PeriodicOptions::with_grid_points(9)
    };
    let solution = Solution::solve(&model, TAU / omega, &options, &mut |_, _| true).unwrap();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );

    // I (β̈ + ν² Ω² β) = F l/2, with ν² = 1 + 3 e / (2 l) for a uniform slender blade.
    let about_hinge = mass * length * length / 3.0;
    let nu2 = 1.0 + 1.5 * hinge / length;
    let moment = 0.5 * force * length;
    let mean = 0.5 * moment / (about_hinge * nu2 * omega * omega);
    let cosine = moment / (about_hinge * (nu2 - 1.0) * omega * omega);
    let angle = JointQuantity::Coordinate(Coordinate::Rotation1);
    let series = solution.series(Quantity::Joint(flap, angle)).unwrap();
    // Flapping of 1e-6 rad: what linear theory leaves out is relatively its square.
    assert!(
        (series[0].mean - mean).abs() < 1e-9 * cosine,
        "{} {mean}",
        series[0].mean
    );
    assert!((series[0].cosines[0] - cosine).abs() < 1e-9 * cosine);
    assert!(series[0].sines[0].abs() < 1e-9 * cosine);
    let shaft = solution.series(Quantity::Joint(shaft, angle)).unwrap();
    assert!((shaft[0].rate - omega).abs() < 1e-12 * omega);
}
