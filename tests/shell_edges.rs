//! Loads on each edge of a shell element, by the reactions of nodes that are all held; beams along
//! edges.

mod common;

use common::models::shells::{RUBBER, clamp_edge, load_edge, mesh, rubber_plate};
use common::*;
use nalgebra::Vector3;
use periodyn::elements::{IsotropicShell, JointKind, LoadFrame, ShellLoadPlace};
use periodyn::model::*;
use periodyn::output::{JointQuantity, NodeQuantity, ResolvedIn, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;

#[test]
fn loads_on_edges_are_those_of_their_lengths_and_axes() {
    let size = [2.0, 3.0];
    // Along the edge, across it, along the normal.
    let load = [1.0, 2.0, 5.0];
    for edge in 0..4 {
        let (mut model, _) = rubber_plate(size, 0.3, &mesh([1, 1], [3, 2]));
        let nodes = model.node_count();
        assert_eq!(nodes, 6);
        let clamps: Vec<usize> = (0..nodes).map(|node| clamp(&mut model, node)).collect();
        let component = |i: usize| load.get(i).map(|&x| Signal::constant(x).unwrap());
        let definition = ShellLoadDefinition {
            first_element: 0,
            elements: 1,
            place: ShellLoadPlace::Edge(edge),
            frame: LoadFrame::Follower,
            components: std::array::from_fn(component),
        };
        model.add_shell_load(definition).unwrap();
        let solution =
            Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| true).unwrap();
        assert_eq!(solution.outcome(), Outcome::Converged);
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (node, clamp) in clamps.into_iter().enumerate() {
            let reaction = JointQuantity::Reaction(ResolvedIn::Space);
            let reaction = solution.joint(clamp, reaction, &[0.0]).unwrap();
            let on_node = -Vector3::from_column_slice(&reaction[..3]);
            let own = -Vector3::from_column_slice(&reaction[3..]);
            force += on_node;
            moment += model.node(node).unwrap().position.cross(&on_node) + own;
        }
        let [length, width] = size;
        let (exact, middle) = match edge {
            0 | 2 => (
                Vector3::new(load[0], load[1], load[2]) * length,
                Vector3::new(0.5 * length, if edge == 0 { 0.0 } else { width }, 0.0),
            ),
            _ => (
                Vector3::new(-load[1], load[0], load[2]) * width,
                Vector3::new(if edge == 1 { length } else { 0.0 }, 0.5 * width, 0.0),
            ),
        };
        assert!(
            (force - exact).amax() < 1e-12 * 20.0,
            "edge {edge}: {force} {exact}"
        );
        let error = (moment - middle.cross(&exact)).amax();
        assert!(error < 1e-12 * 50.0, "edge {edge}: {moment}");
    }
}

#[test]
fn beams_on_the_nodes_of_edges_stiffen_them_as_one_beam() {
    // A strip without contraction with a beam along both edges, in proportion to it, between two
    // rigid edges, bent far: a beam with the stiffness of all three, as all interpolate the same
    // motions.
    let [thickness, young, ..] = RUBBER;
    let ([length, width], part, force) = ([1.0, 0.2], 0.8, 200.0);
    let beam = |times: f64| {
        let area = times * width * thickness;
        let (bending, shear) = (
            young * area * thickness * thickness / 12.0,
            5.0 / 12.0 * young * area,
        );
        // Torsion and bending in the plane do not take part.
        let in_plane = 50.0 * bending;
        let stiffness = [young * area, shear, shear, bending, bending, in_plane];
        SectionInput::diagonal(&stiffness, &[1.0, 1e-3, 1e-3, 1e-3]).unwrap()
    };
    let pushed = |model: &mut Model, nodes: &[usize]| {
        let end = Vector3::new(length, 0.5 * width, 0.0);
        let body = ball(model, 1.0, 1.0, &end);
        model.add_rigid_joints(Some(body), nodes).unwrap();
        load_edge(model, &[body], &[1.0], [0.0, 0.0, force, 0.0, 0.0, 0.0]);
        let place = statics(model).node(body, NodeQuantity::Position, &[0.0]);
        Vector3::from_column_slice(&place.unwrap())
    };
    let (mut model, patch) = rubber_plate([length, width], 0.0, &mesh([2, 1], [4, 3]));
    for edge in [PatchEdge::StartV, PatchEdge::EndV] {
        for nodes in patch.edge(edge).windows(4).step_by(3) {
            model.add_beam_element(nodes, &beam(part)).unwrap();
        }
    }
    clamp_edge(&mut model, &patch.edge(PatchEdge::StartU));
    let stiffened = pushed(&mut model, &patch.edge(PatchEdge::EndU));
    let mut model = Model::new();
    let root = Vector3::y() * 0.5 * width;
    let end = root + Vector3::x() * length;
    let whole = beam(1.0 + 2.0 * part);
    let alone = model
        .add_straight_beam(&root, &end, &Vector3::y(), &whole, 2, 3)
        .unwrap();
    clamp(&mut model, alone.first_node);
    let alone = pushed(&mut model, &[alone.last_node]);
    let apart = (stiffened - alone).norm();
    println!("{stiffened:?} {alone:?}: {apart:e}");
    // Newton's tolerance, 1e-9, squared, and rounding.
    assert!(alone.z > 0.3 && apart < 1e-12, "{alone:?}: {apart:e}");
}

/// By how much a tube in torsion, with so many elements along it, twists too little between two
/// edges that are held rigidly, or but for turns about the normals.
fn tube(elements: usize, held: JointKind, drilling: f64) -> f64 {
    let ([radius, length, thickness], young, couple) = ([0.1, 2.0, 1e-3], 2e11, 10.0);
    let section = IsotropicShell {
        drilling,
        ..IsotropicShell::new(thickness, young, 0.3, 1.0)
    };
    let mut model = Model::new();
    let (axis, start) = (Vector3::z(), Vector3::x());
    let surface = cylinder(&Vector3::zeros(), &axis, &start, [radius, length], TAU).unwrap();
    let (section, placement) = (section.section().unwrap(), ShellPlacement::default());
    let mesh = mesh([6, elements], [5, 5]);
    let patch = model
        .add_shell_patch(surface, &mesh, &section, &placement)
        .unwrap();
    let end = ball(&mut model, 1.0, 1.0, &(axis * length));
    for (edge, body) in [(PatchEdge::StartV, None), (PatchEdge::EndV, Some(end))] {
        let mut nodes = patch.edge(edge);
        nodes.pop(); // where the circle closes
        for node in nodes {
            let at = model.node(node).unwrap().position;
            let normal = Vector3::new(at.x, at.y, 0.0);
            join(&mut model, held, [body, Some(node)], &at, &normal);
        }
    }
    load_edge(
        &mut model,
        &[end],
        &[1.0],
        [0.0, 0.0, 0.0, 0.0, 0.0, couple],
    );
    let solution = statics(&model);
    let turned = solution.node(end, NodeQuantity::RotationMatrix, &[0.0]);
    let torsion = young / 2.6 * TAU * radius.powi(3) * thickness;
    1.0 - turned.unwrap()[1] * torsion / (couple * length)
}

#[test]
fn a_tube_twists_as_it_should_if_its_edges_may_turn_about_normals() {
    let [one, two] = [1, 2].map(|elements| tube(elements, JointKind::Rigid, 1.0));
    let softer = tube(2, JointKind::Rigid, 0.1);
    let free = tube(1, JointKind::Revolute, 1.0);
    println!("{one:e} {two:e}, softer {softer:e}, free {free:e}");
    // Bounds by what was measured: 6.0e-2, 2.4e-2, 5.3e-3 and 2.1e-5.
    assert!(0.05 < one && one < 0.07 && 0.02 < two && two < 0.03);
    assert!(softer < 0.25 * two, "{softer:e}");
    assert!(free.abs() < 4e-5, "{free:e}");
}
