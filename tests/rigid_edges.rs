//! Rigid edges of shells: what they hand on to bodies and joints, against beams and by equilibrium.

mod common;

use common::models::shells::{RUBBER, add_strip, mesh, rubber_plate};
use common::*;
use nalgebra::Vector3;
use periodyn::elements::*;
use periodyn::model::*;
use periodyn::output::{JointQuantity, NodeQuantity, ResolvedIn, Solution};
use periodyn::solve::*;

const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.1;
const PERIOD: f64 = 1.6;

/// What hangs between two ends: a shaft that turns to and fro on a revolute joint, and at the tip
/// a body with a pendulum on another; gives the coordinate of the pendulum's joint.
fn between(model: &mut Model, root: &[usize], tip: &[usize]) -> usize {
    let middle = Vector3::y() * 0.5 * WIDTH;
    let shaft = ball(model, 0.1, 1e-3, &middle);
    let hinge = revolute(model, None, Some(shaft), &middle, &Vector3::y());
    let swing = cosine(0.5);
    model.prescribe(rotation1(hinge), &swing).unwrap();
    let end = Vector3::new(LENGTH, 0.5 * WIDTH, 0.0);
    let body = ball(model, 0.05, 1e-5, &(end + Vector3::x() * 0.03));
    let weight = ball(model, 0.2, 1e-4, &(end + Vector3::new(0.1, 0.0, -0.1)));
    for (body, nodes) in [(shaft, root), (body, tip)] {
        let first = model.joint_count();
        let joints = model.add_rigid_joints(Some(body), nodes).unwrap();
        assert_eq!(joints, first..first + nodes.len());
    }
    let joint = revolute(model, Some(body), Some(weight), &end, &Vector3::y());
    spring(model, rotation1(joint), 0.05, 0.05);
    gravity(model, [0.0, 0.0, -9.81]);
    joint
}

fn periodic(model: &Model) -> Solution {
    solve(model, PERIOD, 21)
}

#[test]
fn a_strip_between_rigid_edges_is_a_beam_between_bodies() {
    let [thickness, young, density, damping_time] = RUBBER;
    let times: Vec<f64> = (0..8).map(|k| PERIOD * f64::from(k) / 8.0).collect();
    let found = |(mut model, root, tip): (Model, Vec<usize>, Vec<usize>)| {
        let joint = between(&mut model, &root, &tip);
        let solution = periodic(&model);
        let angle = solution.joint(
            joint,
            JointQuantity::Coordinate(Coordinate::Rotation1),
            &times,
        );
        let place = solution.node(tip[0], NodeQuantity::Position, &times);
        (angle.unwrap(), place.unwrap())
    };
    let (model, patch) = rubber_plate([LENGTH, WIDTH], 0.0, &mesh([2, 1], [4, 3]));
    let edges = [PatchEdge::StartU, PatchEdge::EndU].map(|edge| patch.edge(edge));
    let [root, tip] = edges;
    let strip = found((model, root, tip));
    let (area, moment) = (WIDTH * thickness, WIDTH * thickness.powi(3) / 12.0);
    let (bending, shear) = (young * moment, 5.0 / 12.0 * young * area);
    // Torsion and bending in the plane do not take part.
    let stiffness = [young * area, shear, shear, bending, bending, 25.0 * bending];
    let inertia = density * moment;
    let mass = [density * area, inertia, inertia, inertia];
    let section = damped_section(&stiffness, &mass, damping_time);
    let mut model = Model::new();
    let (start, end) = (Vector3::y() * 0.5 * WIDTH, Vector3::x() * LENGTH);
    let beam = model
        .add_straight_beam(&start, &(start + end), &Vector3::y(), &section, 2, 3)
        .unwrap();
    let beam = found((model, vec![beam.first_node], vec![beam.last_node]));
    let angle = largest_difference(&strip.0, &beam.0);
    let pairs = strip.1.chunks(3).zip(beam.1.chunks(3));
    let apart = pairs.map(|(a, b)| (a[0] - b[0]).hypot(a[2] - b[2]));
    let apart = apart.fold(0.0, f64::max);
    let (widest, deepest) = (largest(strip.0), largest(column(&strip.1, 3, 2)));
    println!("{angle:e} {apart:e}, of {widest} and {deepest}");
    // Equal but for rounding, as both interpolate the same motions; Newton leaves 1e-9 squared.
    assert!(angle < 1e-11 && apart < 1e-12, "{angle:e} {apart:e}");
    assert!(widest > 0.5 && deepest > 0.4, "{widest} {deepest}");
}

#[test]
fn reactions_of_a_rigid_edge_are_what_its_body_takes() {
    let section = IsotropicShell::new(0.02, 3e6, 0.3, 1.0).section().unwrap();
    let mut model = Model::new();
    let patch = add_strip(&mut model, [1.0, 0.5], &section, &mesh([2, 2], [4, 4]));
    let clamped = patch.edge(PatchEdge::StartU);
    let held = model.add_rigid_joints(None, &clamped).unwrap();
    let centre = Vector3::new(1.2, 0.3, 0.1);
    let body = ball(&mut model, 1.0, 1e-2, &centre);
    let edge = patch.edge(PatchEdge::EndU);
    let joints = model.add_rigid_joints(Some(body), &edge).unwrap();
    assert_eq!((held.len(), joints.len()), (7, 7));
    // The corner is held already, the rest of this edge is not.
    let side = patch.edge(PatchEdge::StartV);
    assert_eq!(
        model.clone().add_rigid_joints(None, &side).unwrap().len(),
        6
    );
    let load = [0.3, -0.2, 0.5, 0.02, 0.04, -0.03];
    add_load(&mut model, body, LoadFrame::Space, &load, &[0.0; 6]);
    let solution = Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| true);
    let solution = solution.unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    let position = |node: usize| {
        let place = solution.node(node, NodeQuantity::Position, &[0.0]).unwrap();
        Vector3::from_column_slice(&place)
    };
    let at = position(body);
    let moved = (at - centre).norm();
    let given = [&load[..3], &load[3..]].map(Vector3::from_column_slice);
    // The tip takes what acts on the body, the root its reaction.
    for (ids, nodes, sign) in [(joints, edge, 1.0), (held, clamped, -1.0)] {
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (joint, node) in ids.zip(nodes) {
            let reaction = JointQuantity::Reaction(ResolvedIn::Space);
            let reaction = solution.joint(joint, reaction, &[0.0]).unwrap();
            let on_node = Vector3::from_column_slice(&reaction[..3]) * sign;
            force += on_node;
            moment += (position(node) - at).cross(&on_node);
            moment += Vector3::from_column_slice(&reaction[3..]) * sign;
        }
        let apart = [(force - given[0]).norm(), (moment - given[1]).norm()];
        println!("{apart:?}, moved by {moved}");
        // Newton's tolerance, 1e-9 of the forces in the plate; measured: 4e-15.
        assert!(apart.iter().all(|&x| x < 1e-12), "{apart:?}");
    }
    assert!(moved > 0.05, "{moved}");
}
