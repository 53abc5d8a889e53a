//! What looks like a mistake in shells: elements that lock, and couples that they cannot carry.

use super::constraints::name_all;
use super::shell_overlaps::overlapping;
use super::shell_seams::unmatched;
use super::{ElementRole, System};
use crate::elements::{Attachment, Element, JointKind, LoadFrame, Measure, Shell};
use crate::model::{ForceDefinition, LoadPoint, Model, Signal};
use nalgebra::{Matrix3, Vector3};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// Warp of an element of two nodes a side, in thicknesses, beyond which it is far too stiff where
/// the frames that it interpolates are parallel, and where they follow the normals.
const WARP: [f64; 2] = [1.0, 20.0];
/// An axis is along the normal if its cosine with this is more, and across it if it is less than
/// the root of what is left.
const ALONG: f64 = 0.1;

pub(super) fn warn_of_shells(model: &Model, system: &System, warnings: &mut Vec<String>) {
    if system.shells.is_empty() {
        return;
    }
    warn_of_warp(system, warnings);
    warn_of_overlaps(system, warnings);
    warn_of_seams(model, system, warnings);
    let mut normals = HashMap::new();
    for shell in &system.shells {
        for (&node, normal) in shell.nodes().iter().zip(shell.normals()) {
            normals.entry(node).or_insert(normal);
        }
    }
    let mut single = couples_of_joints(model, &normals);
    single.extend(couples_of_beams(system, &normals));
    single.extend(couples_of_loads(model, system, &normals));
    if !single.is_empty() {
        let nodes: Vec<usize> = single.into_iter().collect();
        warnings.push(format!(
            "a couple about the normal of a shell acts on {} alone: the turn there grows without \
             bound as the mesh becomes finer; join an edge, or several nodes",
            name_all("node", &nodes)
        ));
    }
}

fn warn_of_warp(system: &System, warnings: &mut Vec<String>) {
    let is_locked = |shell: &Shell| {
        let bound = WARP[usize::from(!shell.has_parallel_frames())];
        shell.sides().contains(&2) && shell.warp() > bound * shell.thickness()
    };
    let shells = system.shells.iter().enumerate();
    let locked = shells.filter(|(_, shell)| is_locked(shell));
    let locked: Vec<usize> = locked.map(|(element, _)| element).collect();
    if !locked.is_empty() {
        warnings.push(format!(
            "{}: thin and warped, with two nodes a side, which is far too stiff: take three or \
             more nodes a side, or smaller elements, with frames along normals",
            name_all("shell element", &locked)
        ));
    }
}

fn warn_of_overlaps(system: &System, warnings: &mut Vec<String>) {
    let pairs = overlapping(&system.shells);
    let Some(&(a, b)) = pairs.first() else {
        return;
    };
    let more = more_than(pairs.len());
    warnings.push(format!(
        "shell elements {a} and {b} lie on each other{more}: mass and stiffness count twice there; \
         does a patch reach too far, or is one there twice?"
    ));
}

/// Of so many pairs the first is named.
fn more_than(pairs: usize) -> String {
    match pairs - 1 {
        0 => String::new(),
        1 => ", and another pair does".to_string(),
        more => format!(", and {more} other pairs do"),
    }
}

/// Edges that meet, but not node by node.
fn warn_of_seams(model: &Model, system: &System, warnings: &mut Vec<String>) {
    let holds = |role: &ElementRole| match *role {
        ElementRole::Joint(_) | ElementRole::Beam(_) => true,
        ElementRole::Force(index) => {
            !matches!(model.forces[index], ForceDefinition::SurfaceForces { .. })
        }
        _ => false,
    };
    let elements = system
        .elements()
        .iter()
        .filter(|placed| holds(&placed.role));
    let held: HashSet<usize> = elements
        .flat_map(|placed| placed.element.nodes().iter().copied())
        .collect();
    let pairs = unmatched(&system.shells, &held);
    let Some(&(a, b)) = pairs.first() else {
        return;
    };
    let more = more_than(pairs.len());
    warnings.push(format!(
        "shell elements {a} and {b} meet along edges{more}, with nodes between those of the other \
         that nothing joins: there they come apart; give both edges the same elements and nodes"
    ));
}

/// Axes of a frame on a node or the ground.
fn axes_of(model: &Model, end: &Attachment) -> Matrix3<f64> {
    match end.node {
        Some(node) => model.nodes[node].rotation * end.offset.rotation,
        None => end.offset.rotation,
    }
}

/// Whether a joint passes a couple about a normal on: all turns are held, or all but one about
/// axis 3, on which nothing acts.
fn joint_passes(model: &Model, number: usize, normal: &Vector3<f64>) -> bool {
    let joint = &model.joints[number];
    match joint.kind {
        JointKind::Rigid | JointKind::Prismatic => true,
        JointKind::Revolute
        | JointKind::Cylindrical
        | JointKind::Planar
        | JointKind::Screw { .. } => {
            let axes = axes_of(model, &joint.second);
            let cosine = axes.column(2).dot(normal).abs();
            1.0 - cosine * cosine > ALONG * ALONG || acts_on_angle(model, number)
        }
        _ => false,
    }
}

/// Whether an angle of a joint is prescribed or related to others, or carries an effort.
fn acts_on_angle(model: &Model, joint: usize) -> bool {
    let prescribed = model.prescribed.iter().map(|(at, _)| *at);
    let relations = model.relations.iter().flat_map(|relation| &relation.terms);
    let efforts = model.forces.iter().flat_map(|force| match force {
        ForceDefinition::Controller(controller) => controller.outputs.clone(),
        _ => force.at().into_iter().collect(),
    });
    let mut all = prescribed
        .chain(relations.map(|(at, _)| *at))
        .chain(efforts);
    all.any(|at| at.joint == joint && at.coordinate.measure() == Measure::Angle)
}

/// Whether a bushing resists a turn about a normal.
fn bushing_passes(force: &ForceDefinition, model: &Model, normal: &Vector3<f64>) -> bool {
    let ForceDefinition::Bushing(bushing) = force else {
        return false;
    };
    let about = axes_of(model, &bushing.first).tr_mul(normal);
    let resists = |matrix: &nalgebra::Matrix6<f64>| {
        let turns = matrix.fixed_view::<3, 3>(3, 3);
        about.dot(&(turns * about)).abs() > ALONG * ALONG * turns.amax()
    };
    resists(&bushing.stiffness) || resists(&bushing.damping)
}

/// Whether a couple about the normal is passed on at a node of a shell.
type Passes<'a> = Box<dyn Fn(&Vector3<f64>) -> bool + 'a>;

/// Both ends of all joints and bushings, and whether they pass couples on.
fn connections(model: &Model) -> impl Iterator<Item = ([Option<usize>; 2], Passes<'_>)> {
    let joints = model.joints.iter().enumerate();
    let joints = joints.filter(|(_, joint)| joint.kind.constraints() > 0);
    let joints = joints.map(move |(number, joint)| {
        let passes: Passes = Box::new(move |normal| joint_passes(model, number, normal));
        ([joint.first.node, joint.second.node], passes)
    });
    let bushings = model.forces.iter().filter_map(move |force| match force {
        ForceDefinition::Bushing(bushing) => {
            let passes: Passes = Box::new(move |normal| bushing_passes(force, model, normal));
            Some(([bushing.first.node, bushing.second.node], passes))
        }
        _ => None,
    });
    joints.chain(bushings)
}

/// Nodes of shells that alone are joined to the ground or to another node, so that a couple about
/// the normal is passed on.
fn couples_of_joints(model: &Model, normals: &HashMap<usize, Vector3<f64>>) -> BTreeSet<usize> {
    let mut joined: BTreeMap<Option<usize>, BTreeSet<usize>> = BTreeMap::new();
    let mut passed: BTreeMap<Option<usize>, BTreeSet<usize>> = BTreeMap::new();
    for (ends, passes) in connections(model) {
        for (node, other) in [(ends[0], ends[1]), (ends[1], ends[0])] {
            let Some((node, normal)) = node.and_then(|n| Some((n, normals.get(&n)?))) else {
                continue;
            };
            joined.entry(other).or_default().insert(node);
            if passes(normal) {
                passed.entry(other).or_default().insert(node);
            }
        }
    }
    let alone = |(other, nodes): &(Option<usize>, BTreeSet<usize>)| {
        nodes.len() == 1 && joined[other].len() == 1
    };
    passed.into_iter().filter(alone).flat_map(|x| x.1).collect()
}

/// Nodes of shells from which a beam leaves.
fn couples_of_beams(system: &System, normals: &HashMap<usize, Vector3<f64>>) -> BTreeSet<usize> {
    let shared = system.beams.iter().map(|beam| {
        let nodes = beam
            .nodes()
            .iter()
            .filter(|node| normals.contains_key(node));
        nodes.copied().collect::<Vec<usize>>()
    });
    // Two or more nodes of an element of a beam are those of an edge, or of several patches.
    shared.filter(|nodes| nodes.len() == 1).flatten().collect()
}

/// Nodes of shells that carry a moment with a part about the normal, and no other node of their
/// elements does.
fn couples_of_loads(
    model: &Model,
    system: &System,
    normals: &HashMap<usize, Vector3<f64>>,
) -> BTreeSet<usize> {
    let mut loaded = BTreeSet::new();
    for load in &model.loads {
        let LoadPoint::Node(node) = load.at else {
            continue;
        };
        let Some(normal) = normals.get(&node) else {
            continue;
        };
        let rotation = &model.nodes[node].rotation;
        let (normal, arm) = match load.frame {
            LoadFrame::Space => (*normal, rotation * load.offset),
            LoadFrame::Follower => (rotation.tr_mul(normal), load.offset),
        };
        // Moments about the normal of forces, and of moments, of one each.
        let by_forces = normal.cross(&arm);
        let along = by_forces.iter().map(|x| x.abs() > ALONG * arm.norm());
        let along = along.chain(normal.iter().map(|x| x.abs() > ALONG));
        let acts = |(component, along): (&Option<Signal>, bool)| {
            along && component.as_ref().is_some_and(|c| !c.is_zero())
        };
        if load.components.iter().zip(along).any(acts) {
            loaded.insert(node);
        }
    }
    if loaded.is_empty() {
        return loaded;
    }
    let mut alone = loaded.clone();
    for shell in &system.shells {
        let own = shell.nodes().iter().filter(|node| loaded.contains(node));
        let own: Vec<&usize> = own.collect();
        if own.len() > 1 {
            own.into_iter().for_each(|node| _ = alone.remove(node));
        }
    }
    alone
}
