//! What looks like a mistake in a model.

use super::constraints::name_all;
use super::partition::{Partition, parts};
use super::shell_warnings::warn_of_shells;
use super::{ElementRole, Placed, System};
use crate::elements::{Beam, Element, NodeState, Section, rigid_body_inertia};
use crate::model::{ForceDefinition, JointDefinition, Model};
use crate::motion::Motion;
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::collections::HashMap;
use std::sync::Arc;

/// Range of the ratio of a section's radius of gyration to the element's length beyond which units
/// look mixed up: millimetres for metres are a factor of 1000.
const SLENDER: std::ops::RangeInclusive<f64> = 5e-5..=5.0;
/// Ratio of stiffnesses in one model beyond which results lose most of their digits.
const SPREAD: f64 = 1e12;
/// A section's radii of gyration by mass and by stiffness are alike; their squares must not differ
/// by more.
const UNLIKE: f64 = 1e5;
/// Range of the ratio of a body's radius of gyration to the size of the model, likewise.
const BODY: std::ops::RangeInclusive<f64> = 5e-5..=30.0;
/// A joint is no farther from its nodes than this many times the size of the model without that
/// joint.
const FAR: f64 = 3.0;
/// Nodes closer than this part of the model's size are at the same place.
const SAME_PLACE: f64 = 1e-6;

/// One sentence for each, with the node that stands for the member of each node, and the parts that
/// nothing connects.
pub(super) fn warnings(
    model: &Model,
    system: &System,
    members: &[usize],
    unconnected: &[Option<usize>],
) -> Vec<String> {
    let mut warnings = Vec::new();
    warn_of_parts(unconnected, &mut warnings);
    warn_of_loose_parts(model, system, unconnected, &mut warnings);
    warn_of_missing_joints(model, system, members, &mut warnings);
    warn_of_bare_nodes(system, &mut warnings);
    warn_of_beams(system, &mut warnings);
    warn_of_shells(model, system, &mut warnings);
    warn_of_bodies(system, &mut warnings);
    warn_of_open_joints(system, &mut warnings);
    warn_of_far_joints(model, system.scales().length, &mut warnings);
    warnings
}

/// The nodes of each part but the first.
fn nodes_of_parts(parts: &[Option<usize>]) -> impl Iterator<Item = Vec<usize>> + '_ {
    let last = parts.iter().flatten().max().copied().unwrap_or(0);
    let nodes = move |part| (0..parts.len()).filter(move |&n| parts[n] == Some(part));
    (1..=last).map(move |part| nodes(part).collect())
}

fn warn_of_parts(parts: &[Option<usize>], warnings: &mut Vec<String>) {
    for nodes in nodes_of_parts(parts) {
        warnings.push(format!(
            "nothing connects {} to the rest of the model",
            name_all("node", &nodes)
        ));
    }
}

/// Whether an element constrains or resists motions of its nodes, not only their velocities.
fn holds(model: &Model, placed: &Placed) -> bool {
    match placed.role {
        ElementRole::Inertia | ElementRole::Load | ElementRole::MassDamping => false,
        ElementRole::Beam(_)
        | ElementRole::Shell(_)
        | ElementRole::Prescribed(_)
        | ElementRole::Relation(_) => true,
        ElementRole::Joint(index) => model.joints[index].kind.constraints() > 0,
        ElementRole::Force(index) => match &model.forces[index] {
            ForceDefinition::SpringDamper { stiffness, .. } => stiffness.iter().any(|&k| k != 0.0),
            ForceDefinition::Viscoelastic { stiffness, .. } => *stiffness != 0.0,
            ForceDefinition::Bushing(bushing) => bushing.stiffness.amax() > 0.0,
            ForceDefinition::Actuator { .. } | ForceDefinition::ViscousDamper { .. } => false,
            // What they do is not known.
            ForceDefinition::CoordinateLaw { .. }
            | ForceDefinition::NodeForces { .. }
            | ForceDefinition::SurfaceForces { .. }
            | ForceDefinition::Controller(_) => true,
        },
    }
}

fn warn_of_loose_parts(
    model: &Model,
    system: &System,
    unconnected: &[Option<usize>],
    warnings: &mut Vec<String>,
) {
    let loose = parts(system, |placed| holds(model, placed));
    for nodes in nodes_of_parts(&loose) {
        if nodes.iter().any(|&n| unconnected[n].is_none()) {
            warnings.push(format!(
                "nothing holds {} to the rest of the model: what connects them has neither \
                 constraints nor stiffness; is a \
                 joint or a spring missing?",
                name_all("node", &nodes)
            ));
        }
    }
}

/// Ends of beams and nodes of shells at the same place as another member, with nothing between
/// them.
fn warn_of_missing_joints(
    model: &Model,
    system: &System,
    members: &[usize],
    warnings: &mut Vec<String>,
) {
    let mut on_beam = vec![false; system.nodes()];
    for beam in &model.beams {
        beam.nodes.iter().for_each(|&node| on_beam[node] = true);
    }
    let mut on_shell = vec![false; system.nodes()];
    for shell in &model.shells {
        shell.nodes.iter().for_each(|&node| on_shell[node] = true);
    }
    let mut apart = Vec::new();
    let unit = SAME_PLACE * system.scales().length;
    let mut places: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for (node, motion) in model.nodes.iter().enumerate() {
        let place = motion.position.map(|x| (x / unit).round() as i64);
        places.entry(place.into()).or_default().push(node);
    }
    let mut groups: Vec<Vec<usize>> = places.into_values().filter(|g| g.len() > 1).collect();
    groups.sort();
    let place_of: HashMap<usize, (usize, usize)> = (groups.iter().enumerate())
        .flat_map(|(g, group)| group.iter().enumerate().map(move |(i, &n)| (n, (g, i))))
        .collect();
    let mut connected: Vec<Partition> = groups.iter().map(|g| Partition::new(g.len())).collect();
    let mut join = |a: usize, b: usize| {
        if let (Some(&(group, a)), Some(&(other, b))) = (place_of.get(&a), place_of.get(&b))
            && group == other
        {
            connected[group].join(a, b);
        }
    };
    for placed in system.elements() {
        for pair in placed.element.nodes().windows(2) {
            join(pair[0], pair[1]);
        }
    }
    for group in &groups {
        for (i, &a) in group.iter().enumerate() {
            for &b in &group[..i] {
                if members[a] == members[b] {
                    join(a, b);
                }
            }
        }
    }
    for (group, connected) in groups.iter().zip(connected) {
        let representatives = connected.representatives();
        if representatives.iter().all(|&r| r == 0) {
            continue;
        }
        if group.iter().filter(|&&n| on_shell[n]).count() > 1 {
            apart.extend(group);
        } else if group.iter().any(|&n| on_beam[n]) {
            warnings.push(format!(
                "{} are at the same place, but not all connected there: is a joint missing?",
                name_all("node", group)
            ));
        }
    }
    if !apart.is_empty() {
        warnings.push(format!(
            "{} of shells are at the same places as others, but not all connected there: are \
             patches to be joined along edges, by common nodes?",
            name_all("node", &apart)
        ));
    }
}

fn warn_of_bare_nodes(system: &System, warnings: &mut Vec<String>) {
    let mut bare = vec![true; system.nodes()];
    for placed in system.elements() {
        if matches!(
            placed.role,
            ElementRole::Inertia | ElementRole::Beam(_) | ElementRole::Shell(_)
        ) {
            for &node in placed.element.nodes() {
                bare[node] = false;
            }
        }
    }
    let bare: Vec<usize> = (0..bare.len()).filter(|&n| bare[n]).collect();
    if !bare.is_empty() {
        let verb = if bare.len() == 1 { "has" } else { "have" };
        warnings.push(format!(
            "{} {verb} neither inertia nor a beam or shell",
            name_all("node", &bare)
        ));
    }
}

/// What tells whether the section of a beam element may be meant.
struct Sizes {
    length: f64,
    axial: f64,
    shear: f64,
    /// The less stiff way.
    bending: f64,
    massless: bool,
    /// Squares of the radii of gyration by mass and by stiffness.
    radii2: [f64; 2],
}

impl Sizes {
    fn of(beam: &Arc<Beam>) -> Self {
        let Section {
            stiffness: k,
            mass: m,
            ..
        } = beam.middle_section();
        let axial = k[(0, 0)];
        Sizes {
            length: beam.length(),
            axial,
            shear: k[(1, 1)].min(k[(2, 2)]),
            bending: k[(4, 4)].min(k[(5, 5)]),
            massless: m == Matrix6::zeros(),
            radii2: [
                m[(4, 4)].max(m[(5, 5)]) / m[(0, 0)],
                k[(4, 4)].max(k[(5, 5)]) / axial,
            ],
        }
    }

    fn slenderness(&self) -> f64 {
        (self.bending / self.axial).sqrt() / self.length
    }

    fn has_odd_mass(&self) -> bool {
        let [of_mass, of_stiffness] = self.radii2;
        of_mass > 0.0 && !(1.0 / UNLIKE..=UNLIKE).contains(&(of_mass / of_stiffness))
    }

    /// Stiffness against bending, as a force for a displacement of the element's length.
    fn softness(&self) -> f64 {
        self.bending / (self.length * self.length)
    }
}

fn warn_of_beams(system: &System, warnings: &mut Vec<String>) {
    let beams: Vec<Sizes> = system.beams.iter().map(Sizes::of).collect();
    let mut warn = |is_odd: &dyn Fn(&Sizes) -> bool, what: &str| {
        let odd: Vec<usize> = (0..beams.len()).filter(|&i| is_odd(&beams[i])).collect();
        if !odd.is_empty() {
            warnings.push(format!("{}: {what}", name_all("beam element", &odd)));
        }
    };
    warn(&|beam| beam.massless, "no mass");
    warn(
        &|beam| beam.slenderness() < *SLENDER.start(),
        "very soft in bending against its axial stiffness, as if units were mixed up",
    );
    warn(
        &|beam| beam.slenderness() > *SLENDER.end(),
        "very stiff in bending for its length and axial stiffness, as if units were mixed up",
    );
    if let Some(odd) = beams.iter().rfind(|beam| beam.has_odd_mass()) {
        let [by_mass, by_stiffness] = odd.radii2.map(f64::sqrt);
        let what = format!(
            "a radius of gyration of {by_mass:.1e} by mass, but {by_stiffness:.1e} by stiffness, \
             as if units were mixed up"
        );
        warn(&Sizes::has_odd_mass, &what);
    }
    warn(
        &|beam| !(1e-4..=1e2).contains(&(beam.shear / beam.axial)),
        "shear stiffness of another order than the axial one",
    );
    let (mut stiffest, mut softest) = ((0.0, 0), (f64::INFINITY, 0));
    for (index, beam) in beams.iter().enumerate() {
        if beam.axial > stiffest.0 {
            stiffest = (beam.axial, index);
        }
        if beam.softness() < softest.0 {
            softest = (beam.softness(), index);
        }
    }
    if stiffest.0 > SPREAD * softest.0 {
        warnings.push(format!(
            "beam element {} is {:.0e} times as stiff in tension as beam element {} is in \
             bending: results lose as many digits",
            stiffest.1,
            stiffest.0 / softest.0,
            softest.1
        ));
    }
}

fn warn_of_bodies(system: &System, warnings: &mut Vec<String>) {
    let size = system.scales.length;
    let (mut impossible, mut odd) = (Vec::new(), Vec::new());
    for inertia in &system.inertias {
        let &[node] = inertia.nodes() else { continue };
        let m = &inertia.row(0)[0];
        let mass = m[(0, 0)];
        if mass <= 0.0 {
            continue;
        }
        // m = [m I, m c̃ᵀ; m c̃, J]: the moment about the centre c.
        let c = Vector3::new(m[(5, 1)], m[(3, 2)], m[(4, 0)]) / mass;
        let offset = rigid_body_inertia(mass, &c, &Matrix3::zeros());
        let central = Matrix3::from_fn(|i, j| m[(3 + i, 3 + j)] - offset[(3 + i, 3 + j)]);
        let moments = central.symmetric_eigenvalues();
        let largest = moments.max();
        if largest > 0.0 && 2.0 * largest > moments.sum() * (1.0 + 1e-9) {
            impossible.push(node);
        }
        let radius = (largest / mass).sqrt();
        if radius > 0.0 && !BODY.contains(&(radius / size)) {
            odd.push(node);
        }
    }
    if !odd.is_empty() {
        warnings.push(format!(
            "body at {}: its mass and moments of inertia are those of a body of another order of \
             size than the model, as \
             if units were mixed up",
            name_all("node", &odd)
        ));
    }
    if !impossible.is_empty() {
        warnings.push(format!(
            "body at {}: no body has these moments of inertia, as the largest exceeds the sum of \
             the others",
            name_all("node", &impossible)
        ));
    }
}

fn warn_of_open_joints(system: &System, warnings: &mut Vec<String>) {
    let length = system.scales.length;
    for (index, joint) in system.joints.iter().enumerate() {
        let states: Vec<NodeState> = joint
            .nodes()
            .iter()
            .map(|&n| NodeState::at_rest(system.reference[n]))
            .collect();
        let z: Motion = joint.relative_motion(&states);
        let kind = joint.kind();
        let mut gap = 0.0f64;
        for row in 0..kind.constraints() {
            let scale = match kind.measure(row) {
                crate::elements::Measure::Length => length,
                crate::elements::Measure::Angle => 1.0,
            };
            gap = gap.max(kind.constraint(row, &z).value.abs() / scale);
        }
        if gap > 1e-9 {
            warnings.push(format!(
                "joint {index} is open by {gap:.1e} (relative to the size of the model, or in \
                 radians) in the \
                 reference configuration; a solve closes it"
            ));
        }
    }
}

/// Joints at a place far from all else, as a coordinate in the wrong unit puts them.
fn warn_of_far_joints(model: &Model, size: f64, warnings: &mut Vec<String>) {
    if model.nodes.len() < 2 {
        return; // there is nothing that one body's joints could be compared with
    }
    let distance = |joint: &JointDefinition| {
        [joint.first, joint.second]
            .iter()
            .filter(|end| end.node.is_some())
            .map(|end| end.offset.position.norm())
            .fold(0.0, f64::max)
    };
    let distances: Vec<f64> = model.joints.iter().map(distance).collect();
    for (index, &far) in distances.iter().enumerate() {
        let others = distances.iter().enumerate().filter(|(i, _)| *i != index);
        let elsewhere = others.fold(size, |most, (_, &d)| most.max(d));
        if far > FAR * elsewhere {
            warnings.push(format!(
                "joint {index} is {far:.3e} away from a node that it joins, in a model of the \
                 size {elsewhere:.3e}: is its \
                 point right?"
            ));
        }
    }
}
