//! The estimated error by the mesh of beams, against the error by a much finer mesh.

use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame, lobatto_points};
use periodyn::error::Result;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::Solution;
use periodyn::solve::*;
use std::f64::consts::TAU;

/// A beam and what it does, on any mesh.
struct Case {
    name: &'static str,
    /// Whether elements turn much from end to end.
    much: bool,
    solve: Box<dyn Fn(usize, usize) -> (Solution, BeamIds)>,
}

type Line = Box<dyn Fn(f64) -> Result<Motion>>;

fn straight(length: f64) -> Line {
    let end = Vector3::x() * length;
    Box::new(straight_line(&Vector3::zeros(), &end, &Vector3::y()).unwrap())
}

fn arc(radius: f64, angle: f64) -> Line {
    let on = |x: f64| Vector3::new(x.sin(), 1.0 - x.cos(), 0.0) * radius;
    Box::new(circular_arc(&on(0.0), &on(0.5 * angle), &on(angle), &Vector3::y()).unwrap())
}

/// Of so much of the stiffness and the mass, with a twist.
fn station(fraction: f64, share: f64, twist: f64) -> SectionStation {
    let stiffness = [9e6, 2e6, 2e6, 8e3, 9e3, 3e4].map(|k| k * share);
    let mass = [8.0, 0.02, 0.01, 0.01].map(|m| m * share);
    let mut section = SectionInput::diagonal(&stiffness, &mass).unwrap();
    section.damp_proportionally(2e-3).unwrap();
    SectionStation {
        fraction,
        section,
        twist,
    }
}

fn constant(values: [f64; 6]) -> [Option<Signal>; 6] {
    values.map(|x| Some(Signal::constant(x).unwrap()))
}

/// A meshed beam whose start is held by this joint, with axis 3 for its axis; gives the joint too.
fn held(
    line: &Line,
    stations: &[SectionStation],
    mesh: (usize, usize),
    kind: JointKind,
) -> (Model, BeamIds, usize) {
    let mut model = Model::new();
    let ids = model
        .add_beam_along(line, stations, mesh.0, mesh.1)
        .unwrap();
    let root = *model.node(ids.first_node).unwrap();
    let axes = Motion::new(Matrix3::identity(), root.position);
    let joint = model.add_joint(kind, None, Some(ids.first_node), &axes, &axes);
    (model, ids, joint.unwrap())
}

fn equilibrium(model: &Model) -> Solution {
    let options = StaticOptions {
        least_load_steps: 4,
        ..StaticOptions::default()
    };
    let solution = Solution::solve_static(model, &options, &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    solution
}

fn periodic(model: &Model, period: f64, points: usize) -> Solution {
    let options = PeriodicOptions {
        estimate_mesh: true,
        ..PeriodicOptions::with_grid_points(points)
    };
    let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    solution
}

/// A cantilever with this load at its tip, and for a unit of length.
fn bent(line: Line, stations: Vec<SectionStation>, tip: [f64; 6], along: [f64; 6]) -> Case {
    Case {
        name: "",
        much: false,
        solve: Box::new(move |elements, degree| {
            let mesh = (elements, degree);
            let (mut model, ids, _) = held(&line, &stations, mesh, JointKind::Rigid);
            let load = model.add_load(ids.last_node, LoadFrame::Space, constant(tip));
            load.unwrap();
            model
                .add_distributed_load(DistributedLoadDefinition {
                    first_element: ids.first_element,
                    elements: ids.elements,
                    frame: LoadFrame::Space.into(),
                    components: constant(along),
                    factors: vec![(0.0, 0.3), (1.0, 1.0)],
                })
                .unwrap();
            (equilibrium(&model), ids)
        }),
    }
}

/// A blade that turns steadily about axis 3, in gravity across that, whose drive may be uneven.
fn rotating(stations: Vec<SectionStation>, omega: f64, points: usize) -> Case {
    Case {
        name: "",
        much: false,
        solve: Box::new(move |elements, degree| {
            let mesh = (elements, degree);
            let (mut model, ids, joint) =
                held(&straight(4.0), &stations, mesh, JointKind::Revolute);
            let at = JointCoordinate {
                joint,
                coordinate: Coordinate::Rotation1,
            };
            let drive = Signal::harmonics(0.0, omega, &[0.0], &[0.05]).unwrap();
            model.prescribe(at, &drive).unwrap();
            model.set_gravity([0.0, -9.81, -3.0].map(|g| Signal::constant(g).unwrap()));
            (periodic(&model, TAU / omega, points), ids)
        }),
    }
}

/// Cantilever shaken at its tip.
fn shaken(line: Line, stations: Vec<SectionStation>, omega: f64, push: f64) -> Case {
    Case {
        name: "",
        much: false,
        solve: Box::new(move |elements, degree| {
            let mesh = (elements, degree);
            let (mut model, ids, _) = held(&line, &stations, mesh, JointKind::Rigid);
            let mut force = [const { None }; 6];
            force[1] = Some(Signal::harmonics(0.0, 0.0, &[push], &[0.0]).unwrap());
            force[2] = Some(Signal::harmonics(0.0, 0.0, &[0.0], &[0.3 * push]).unwrap());
            let load = model.add_load(ids.last_node, LoadFrame::Space, force);
            load.unwrap();
            (periodic(&model, TAU / omega, 9), ids)
        }),
    }
}

const ZERO: [f64; 6] = [0.0; 6];
const ALONG: [f64; 6] = [0.0, 60.0, 20.0, 0.0, 0.0, 0.0];
const TIP: [f64; 6] = [0.0, 900.0, 300.0, 200.0, 0.0, 0.0];

fn uniform() -> Vec<SectionStation> {
    vec![station(0.0, 1.0, 0.0)]
}

fn tapered() -> Vec<SectionStation> {
    vec![station(0.0, 1.0, 0.0), station(1.0, 0.1, 0.0)]
}

fn twisted() -> Vec<SectionStation> {
    vec![station(0.0, 1.0, 0.0), station(1.0, 0.3, 1.2)]
}

fn little(name: &'static str, case: Case) -> Case {
    Case { name, ..case }
}

fn much(name: &'static str, case: Case) -> Case {
    let much = true;
    Case { name, much, ..case }
}

fn equilibria() -> Vec<Case> {
    let line = || straight(4.0);
    let bow = || arc(2.0, 1.8);
    vec![
        little("little bent", bent(line(), uniform(), ZERO, ALONG)),
        little("tapered", bent(line(), tapered(), ZERO, ALONG)),
        little(
            "tapered arc",
            bent(bow(), tapered(), TIP.map(|f| 0.3 * f), ALONG),
        ),
        much(
            "much bent",
            bent(line(), uniform(), TIP.map(|f| 3.0 * f), ZERO),
        ),
        much("twisted", bent(line(), twisted(), TIP, ALONG)),
        much("arc", bent(bow(), uniform(), TIP, ZERO)),
    ]
}

fn motions() -> Vec<Case> {
    vec![
        little("rotating", rotating(uniform(), 12.0, 9)),
        // Away from its frequencies as it turns, 16 and 19 rad/s: in resonance it swings by
        // most of its length.
        little("rotating, twisted", rotating(twisted(), 12.0, 9)),
        // Between them, 22 and 34 rad/s.
        little("rotating fast, twisted", rotating(twisted(), 30.0, 15)),
        little("shaken", shaken(straight(4.0), uniform(), 30.0, 300.0)),
        little("shaken arc", shaken(arc(2.0, 1.8), tapered(), 25.0, 60.0)),
    ]
}

/// Largest difference of the motions at the nodes of the coarse solution: parts of the
/// characteristic length, and angles.
fn difference(coarse: &(Solution, BeamIds), fine: &(Solution, BeamIds), degree: usize) -> f64 {
    let points = lobatto_points(degree + 1);
    let times: Vec<f64> = coarse.0.grid().times().collect();
    let length = coarse.0.details().system.scales().length;
    let mut worst = 0.0f64;
    for element in 0..coarse.1.elements {
        for &xi in &points {
            let id = coarse.1.first_element + element;
            let here = coarse.0.beam_frames(id, &[xi], &times).unwrap();
            let at = (element as f64 + 0.5 * (1.0 + xi)) / coarse.1.elements as f64;
            let at = at * fine.1.elements as f64;
            let other = (at.floor() as usize).min(fine.1.elements - 1);
            let station = (2.0 * (at - other as f64) - 1.0).clamp(-1.0, 1.0);
            let id = fine.1.first_element + other;
            let there = fine.0.beam_frames(id, &[station], &times).unwrap();
            for (a, b) in here.iter().zip(&there) {
                let moved = a.rotation.tr_mul(&(b.position - a.position)).amax() / length;
                let turn = a.rotation.tr_mul(&b.rotation);
                let turn = Vector3::new(
                    turn[(2, 1)] - turn[(1, 2)],
                    turn[(0, 2)] - turn[(2, 0)],
                    turn[(1, 0)] - turn[(0, 1)],
                );
                worst = worst.max(moved).max(0.5 * turn.amax());
            }
        }
    }
    worst
}

/// Least and largest ratio of estimate and error over meshes of so many elements and such a degree.
fn ratios(case: &Case, fine: (usize, usize), meshes: &[(usize, usize)]) -> (f64, f64) {
    let fine = (case.solve)(fine.0, fine.1);
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    for &(elements, degree) in meshes {
        let coarse = (case.solve)(elements, degree);
        let error = difference(&coarse, &fine, degree);
        let estimate = coarse.0.diagnostics().mesh_error;
        let ratio = estimate / error;
        println!(
            "{:30} {elements:2} of degree {degree}: {error:.1e}, estimated {estimate:.1e}, ratio \
             {ratio:.2}",
            case.name,
        );
        // The fine mesh has an error of its own.
        assert!(
            fine.0.diagnostics().mesh_error < 0.05 * error,
            "{}",
            case.name
        );
        (least, most) = (least.min(ratio), most.max(ratio));
    }
    (least, most)
}

fn assert_within_a_factor(cases: &[Case], fine: (usize, usize), meshes: &[(usize, usize)]) {
    for case in cases {
        let (least, most) = ratios(case, fine, meshes);
        // As measured and documented: where elements turn much from end to end it errs to the safe
        // side.
        let largest = if case.much { 30.0 } else { 5.0 };
        assert!(
            least > 0.15 && most < largest,
            "{}: {least} {most}",
            case.name
        );
    }
}

#[test]
fn it_is_the_error_of_equilibria_within_a_factor() {
    let meshes = [(2, 2), (2, 3), (4, 2), (4, 3), (2, 4)];
    assert_within_a_factor(&equilibria(), (6, 6), &meshes);
}

#[test]
fn it_is_the_error_of_periodic_motions_within_a_factor() {
    assert_within_a_factor(&motions(), (4, 6), &[(2, 2), (2, 3), (4, 2)]);
}

#[test]
fn it_is_zero_without_beams_and_in_the_report_with_them() {
    let mut model = Model::new();
    let body = model.add_node(&Motion::identity()).unwrap();
    model
        .add_joint(
            JointKind::Rigid,
            None,
            Some(body),
            &Motion::identity(),
            &Motion::identity(),
        )
        .unwrap();
    assert_eq!(equilibrium(&model).diagnostics().mesh_error, 0.0);
    let case = &equilibria()[0];
    let (solution, _) = (case.solve)(2, 2);
    assert!(
        solution
            .report()
            .contains("estimated error by the mesh of beams")
    );
}
