//! The static cases of BeamDyn's regression tests, against the equations of the rod.
//!
//! **Source** of the numbers: repository OpenFAST/r-test,
//! `modules/beamdyn/bd_static_cantilever_beam`, `bd_isotropic_rollup`, `bd_curved_beam` and
//! `bd_static_twisted_with_k1` (`bd_driver.inp`, `bd_primary.inp`, `beam_props.inp`,
//! `bd_driver.out`). **Licence**: Apache-2.0 (OpenFAST). Numbers only, no text of theirs.
//!
//! BeamDyn's axes x, y, z are axes 2, 3, 1 here, with z along the beam; a positive twist of BeamDyn
//! turns about −z. Its own results are those of one element of the order 5 to 10: that of the
//! cantilever is off by some percent, as the beam bends by more than a right angle within a tenth
//! of its length; all that is asked of them is to be near.

mod common;
#[path = "common/rod.rs"]
mod rod;

use common::*;
use nalgebra::{Matrix6, Vector3, Vector6};
use periodyn::elements::LoadFrame;
use periodyn::error::Result;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::*;
use rod::Rod;

/// Displacement of the tip, in BeamDyn's axes.
fn tip_of(
    line: impl Fn(f64) -> Result<Motion>,
    stations: &[SectionStation],
    mesh: (usize, usize),
    gravity: f64,
    load: [f64; 6],
) -> Vector3<f64> {
    let mut model = Model::new();
    let beam = model
        .add_beam_along(line, stations, mesh.0, mesh.1)
        .unwrap();
    clamp(&mut model, beam.first_node);
    common::gravity(&mut model, [gravity, 0.0, 0.0]);
    add_load(
        &mut model,
        beam.last_node,
        LoadFrame::Space,
        &load,
        &[0.0; 6],
    );
    let start = model.node(beam.last_node).unwrap().position;
    let options = StaticOptions {
        least_load_steps: 4,
        ..StaticOptions::default()
    };
    let solution = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    let end = solution
        .node(beam.last_node, NodeQuantity::Position, &[0.0])
        .unwrap();
    Vector3::from_column_slice(&end) - start
}

/// A vector of BeamDyn's axes from one of the rod's.
fn beamdyn(v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.y, v.z, v.x)
}

fn straight() -> impl Fn(f64) -> Result<Motion> {
    straight_line(&Vector3::zeros(), &(Vector3::z() * 10.0), &Vector3::x()).unwrap()
}

/// Axial, shear, torsion, bending about x and y: uniform, with a mass of 1 for a unit of length,
/// turned from start to end.
fn stations(stiffness: [f64; 6], twist: f64) -> [SectionStation; 2] {
    let section = SectionInput::diagonal(&stiffness, &[1.0, 2.0, 1.0, 1.0]).unwrap();
    [(0.0, 0.0), (1.0, twist)].map(|(fraction, twist)| SectionStation {
        fraction,
        section,
        twist,
    })
}

/// Six digits of the exact displacement, and BeamDyn's within this part of it.
fn compare(name: &str, found: Vector3<f64>, exact: Vector3<f64>, theirs: [f64; 3], near: f64) {
    let baseline = Vector3::from(theirs);
    let error = (found - exact).norm() / exact.norm();
    let off = (baseline - exact).norm() / exact.norm();
    println!("{name}: {exact:?}: error {error:.1e}, BeamDyn's {off:.1e}");
    assert!(error < 1e-6, "{name}: {found} {exact}");
    assert!(off < near, "{name}: {baseline} {exact}");
}

const SOFT: [f64; 6] = [1e4, 1e4, 1e4, 200.0, 100.0, 100.0];

#[test]
fn a_cantilever_hangs_by_its_weight() {
    let gravity = 9.806;
    let found = tip_of(straight(), &stations(SOFT, 0.0), (8, 8), gravity, [0.0; 6]);
    let rod = Rod {
        length: 10.0,
        corners: &[0.0, 1.0],
        stiffness: &|_, _| Matrix6::from_diagonal(&Vector6::from(SOFT)),
        curvature: &|_, _| Vector3::zeros(),
        load: &|_, _| Vector6::new(0.0, gravity, 0.0, 0.0, 0.0, 0.0),
        frame: LoadFrame::Space,
        end: Vector6::zeros(),
    };
    let exact = rod.equilibrium(30).position - Vector3::x() * 10.0;
    let theirs = [9.06014769, 0.0, -8.52177367];
    compare("cantilever", found, beamdyn(&exact), theirs, 0.05);
}

#[test]
fn a_moment_rolls_a_beam_up() {
    let moment: f64 = 12.5664;
    let load = [0.0, 0.0, 0.0, -moment, 0.0, 0.0];
    let found = tip_of(straight(), &stations(SOFT, 0.0), (2, 6), 0.0, load);
    // The circle of the radius EI/M.
    let (radius, angle) = (100.0 / moment, moment / 10.0);
    let exact = Vector3::new(
        0.0,
        radius * (1.0 - angle.cos()),
        radius * angle.sin() - 10.0,
    );
    compare("roll-up", found, exact, exact.into(), 1e-12);
}

#[test]
fn a_force_bends_an_arc_out_of_its_plane() {
    let stiffness = [1e7, 41.6667e5, 41.6667e5, 8.333e5, 8.333e5, 8.333e5];
    let radius = 100.0;
    let on = |angle: f64| Vector3::new(1.0 - angle.cos(), 0.0, angle.sin()) * radius;
    let eighth = std::f64::consts::FRAC_PI_4;
    let line = circular_arc(&on(0.0), &on(0.5 * eighth), &on(eighth), &Vector3::x()).unwrap();
    let load = [0.0, 600.0, 0.0, 0.0, 0.0, 0.0];
    let found = tip_of(line, &stations(stiffness, 0.0), (4, 5), 0.0, load);
    let rod = Rod {
        length: radius * eighth,
        corners: &[0.0, 1.0],
        stiffness: &|_, _| Matrix6::from_diagonal(&Vector6::from(stiffness)),
        curvature: &|_, _| Vector3::z() / radius,
        load: &|_, _| Vector6::zeros(),
        frame: LoadFrame::Space,
        end: Vector6::new(0.0, 0.0, 600.0, 0.0, 0.0, 0.0),
    };
    let exact = beamdyn(&rod.equilibrium(8).position) - on(eighth);
    // Theirs is that of a cubic curve through three points, given with four digits.
    compare("arc", found, exact, [-13.46, 53.35, -23.58], 5e-3);
}

#[test]
fn a_force_bends_a_twisted_beam() {
    let stiffness = [
        2.5e10,
        8.2604167e9,
        8.2604167e9,
        0.141872656e9,
        0.520833e9,
        0.130208333e9,
    ];
    let twist = -std::f64::consts::FRAC_PI_2;
    let load = [0.0, -4e6, 0.0, 0.0, 0.0, 0.0];
    let found = tip_of(straight(), &stations(stiffness, twist), (4, 7), 0.0, load);
    let rod = Rod {
        length: 10.0,
        corners: &[0.0, 1.0],
        stiffness: &|_, _| Matrix6::from_diagonal(&Vector6::from(stiffness)),
        curvature: &|_, _| Vector3::x() * (twist / 10.0),
        load: &|_, _| Vector6::zeros(),
        frame: LoadFrame::Space,
        end: Vector6::new(0.0, 0.0, -4e6, 0.0, 0.0, 0.0),
    };
    let exact = rod.equilibrium(8).position - Vector3::x() * 10.0;
    let theirs = [1.71810805, -3.59245231, -1.14114462];
    compare("twisted", found, beamdyn(&exact), theirs, 1e-3);
}
