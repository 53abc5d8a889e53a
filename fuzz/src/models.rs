//! Small models made up from bytes: what is told to be a solution is one, from wherever and however
//! it is looked for.

use super::bytes::Bytes;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::model::{JointCoordinate, Model, SectionInput, Signal, SpringDefinition};
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::{InitialGuess, LinearMethod, Outcome, PeriodicOptions};

/// Iterations after which a solve is left alone.
const PATIENCE: usize = 2000;
/// Motions that two solves with Newton's tolerance may be apart by, relative to the size of the
/// mechanism, where nothing is nearly singular.
const APART: f64 = 1e-5;

/// Joints, each with a coordinate that is sprung or driven.
const JOINTS: [(JointKind, Coordinate); 4] = [
    (JointKind::Revolute, Coordinate::Rotation1),
    (JointKind::Prismatic, Coordinate::Displacement1),
    (JointKind::Cylindrical, Coordinate::Rotation1),
    (JointKind::Universal, Coordinate::Rotation1),
];

/// A number from -1 to 1.
fn moderate(bytes: &mut Bytes) -> f64 {
    let x = bytes.number();
    if x.is_nan() { 0.5 } else { x.clamp(-1.0, 1.0) }
}

fn signal(bytes: &mut Bytes, size: f64) -> Signal {
    let [mean, a, b, c] = [(); 4].map(|()| size * moderate(bytes));
    Signal::harmonics(mean, 0.0, &[a, c], &[b, 0.0]).expect("finite numbers")
}

/// A chain or a tree of bodies and beams, with a spring and a damper at each joint, or a drive.
fn model(bytes: &mut Bytes) -> periodyn::error::Result<Model> {
    let mut model = Model::new();
    let mut ends: Vec<(Option<usize>, Vector3<f64>)> = vec![(None, Vector3::zeros())];
    for _ in 0..=bytes.below(3) {
        let (from, place) = ends[bytes.below(ends.len())];
        let along = Vector3::from([(); 3].map(|()| moderate(bytes)));
        let along = along + Vector3::x() * 0.1;
        let axis = match bytes.below(4) {
            0 => Vector3::z(),
            1 => Vector3::y(),
            2 => Vector3::x(),
            _ => Vector3::from(bytes.axis()),
        };
        let (start, end) = match bytes.rarely(4) {
            true => {
                let stiffness = [1e4, 1e4, 1e4, 20.0, 30.0, 30.0];
                let mut section = SectionInput::diagonal(&stiffness, &[1.0, 2e-3, 1e-3, 1e-3])?;
                section.damp_proportionally(0.01 * bytes.positive().min(1.0))?;
                let side = along.cross(&Vector3::new(0.3, 0.5, 0.8));
                let beam = model.add_straight_beam(
                    &place,
                    &(place + along),
                    &side,
                    &section,
                    1 + bytes.below(2),
                    1 + bytes.below(3),
                )?;
                (beam.first_node, beam.last_node)
            }
            false => {
                let mass = bytes.positive().clamp(0.1, 10.0);
                let inertia = Matrix3::identity() * (0.1 * mass);
                let body = model.add_rigid_body(mass, &(place + along * 0.5), &inertia)?;
                (body, body)
            }
        };
        let (kind, coordinate) = JOINTS[bytes.below(JOINTS.len())];
        let frame = Model::frame_at("axis", &place, &axis)?;
        let joint = model.add_joint(kind, from, Some(start), &frame, &frame)?;
        let at = JointCoordinate { joint, coordinate };
        match bytes.rarely(5) {
            true => drop(model.prescribe(at, &signal(bytes, 0.5))?),
            false => {
                let stiffness = 200.0 * bytes.positive().min(10.0);
                let damping = 5.0 * bytes.positive().clamp(0.05, 10.0);
                let rest = 0.0;
                model.add_spring_damper(SpringDefinition {
                    at,
                    stiffness,
                    damping,
                    rest,
                })?;
                model.add_actuator(at, &signal(bytes, 20.0))?;
            }
        }
        // Their other coordinates are held, too.
        let others: &[Coordinate] = match kind {
            JointKind::Cylindrical => &[Coordinate::Displacement1],
            JointKind::Universal => &[Coordinate::Rotation2],
            _ => &[],
        };
        for &coordinate in others {
            model.add_spring_damper(SpringDefinition {
                at: JointCoordinate { joint, coordinate },
                stiffness: 100.0,
                damping: 2.0,
                rest: 0.0,
            })?;
        }
        ends.push((Some(end), place + along));
    }
    if bytes.below(2) == 0 {
        model.set_gravity([0.0, 0.0, -9.81].map(|g| Signal::constant(g).expect("finite")));
    }
    Ok(model)
}

/// Solves; none where that takes too long.
fn solve(model: &Model, period: f64, options: &PeriodicOptions) -> Option<Solution> {
    let mut left = PATIENCE;
    let mut observe = |_, _: &_| {
        left = left.saturating_sub(1);
        left > 0
    };
    Solution::solve(model, period, options, &mut observe).ok()
}

fn positions(solution: &Solution, nodes: usize, times: &[f64]) -> Vec<f64> {
    let of = |node| {
        let values = solution.node(node, NodeQuantity::Position, times);
        values.expect("positions of a solution")
    };
    (0..nodes).flat_map(of).collect()
}

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let points = 5 + 2 * bytes.below(5);
    let period = 0.2 + 2.0 * bytes.positive().min(4.0);
    let Ok(model) = model(&mut bytes) else {
        return;
    };
    let adaptive = PeriodicOptions::default();
    let given = PeriodicOptions::with_grid_points(points);
    let is_given = bytes.below(4) != 0;
    let options = if is_given { given } else { adaptive };
    let Some(found) = solve(&model, period, &options) else {
        return;
    };
    if found.outcome() != Outcome::Converged {
        return;
    }
    let report = found.report();
    let (grid, nodes) = (found.grid(), model.node_count());
    let times: Vec<f64> = (0..grid.points()).map(|k| grid.time(k)).collect();
    let motion = positions(&found, nodes, &times);
    assert!(motion.iter().all(|x| x.is_finite()), "numbers: {report}");
    let length = found.details().system.scales().length;
    // From there, and by each kind of solver, it is the solution still.
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let start = found.prolonged(grid).expect("on its own grid");
        let options = PeriodicOptions {
            guess: InitialGuess::State(start),
            linear,
            ..PeriodicOptions::with_grid_points(grid.points())
        };
        let Some(again) = solve(&model, period, &options) else {
            continue;
        };
        if again.outcome() != Outcome::Converged {
            assert_eq!(linear, LinearMethod::Iterative(None), "{}", again.report());
            continue;
        }
        let other = positions(&again, nodes, &times);
        let pairs = motion.iter().zip(&other);
        let apart = pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) / length;
        assert!(
            apart <= APART,
            "{linear:?} is {apart:e} away: {report}{}",
            again.report()
        );
    }
}
