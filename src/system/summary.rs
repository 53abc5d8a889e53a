//! What a model consists of, how it can move, and what looks like a mistake.

use super::constraints::{Dependency, name_all};
use super::{ElementRole, Standstill, System};
use crate::elements::{Element, NodeState, rigid_body_inertia};
use crate::error::Result;
use crate::model::Model;
use crate::motion::Motion;
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::fmt;

/// Counts, mass, mobility and warnings of a model in its reference configuration.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of beam elements.
    pub beam_elements: usize,
    /// Number of joints, those without constraints too.
    pub joints: usize,
    /// Number of prescribed joint coordinates.
    pub prescribed: usize,
    /// Number of constraints: those of joints, and one for each prescribed coordinate.
    pub constraints: usize,
    /// Number of these that depend on others.
    pub redundant: usize,
    /// Degrees of freedom: six for each node, less the independent constraints.
    pub freedoms: usize,
    /// Rigid members: bodies, and beams each taken as one rigid body.
    pub members: usize,
    /// Freedoms that are left if all members are rigid.
    pub mobility: usize,
    /// Constraints that would depend on others if all members were rigid.
    pub redundant_if_rigid: usize,
    /// Parts that nothing connects to each other or to the ground.
    pub parts: usize,
    /// Total mass.
    pub mass: f64,
    /// Centre of mass, in the inertial frame; zero without mass.
    pub centre: Vector3<f64>,
    /// What looks like a mistake, one sentence each.
    pub warnings: Vec<String>,
    /// Constraints that depend on each other.
    dependencies: Vec<Dependency>,
}

/// Ratio of a section's radius of gyration to the beam's length below which units look mixed up.
const SLENDER: f64 = 1e-5;
/// Ratio of stiffnesses in one model beyond which results lose most of their digits.
const SPREAD: f64 = 1e12;

impl Summary {
    /// Looks at `model` in its reference configuration.
    ///
    /// # Errors
    /// If the model has no nodes, or a signal's function fails.
    pub fn of(model: &Model) -> Result<Self> {
        let system = System::at_standstill(model, &Standstill::default())?;
        let bodies = rigid_members(&system);
        let members = (0..bodies.len()).filter(|&n| bodies[n] == n).count();
        let constraints = system.constraint_count();
        let redundant = system.redundant_constraints();
        let rigid = system.dependencies_if_rigid(&bodies)?;
        let redundant_if_rigid: usize = rigid.iter().map(|d| d.count).sum();
        let parts = parts(&system);
        let (mass, moment) = model.mass_and_moment();
        let mut warnings = Vec::new();
        warn_of_parts(&parts, &mut warnings);
        warn_of_bare_nodes(&system, &mut warnings);
        warn_of_beams(model, &mut warnings);
        warn_of_bodies(model, &mut warnings);
        warn_of_open_joints(model, system.scales().length, &mut warnings);
        Ok(Summary {
            nodes: system.nodes(),
            beam_elements: model.beams.len(),
            joints: model.joints.len(),
            prescribed: model.prescribed.len(),
            constraints,
            redundant,
            freedoms: (6 * system.nodes() + redundant).saturating_sub(constraints),
            members,
            mobility: (6 * members + redundant_if_rigid).saturating_sub(constraints),
            redundant_if_rigid,
            parts: parts.iter().flatten().max().map_or(1, |last| last + 1),
            mass,
            centre: if mass > 0.0 {
                moment / mass
            } else {
                Vector3::zeros()
            },
            warnings,
            dependencies: system.dependencies().to_vec(),
        })
    }
}

/// A number with seven digits, without zeros at the end.
fn readable(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = 6 - x.abs().log10().floor() as i32;
    if !(0..=10).contains(&digits) {
        return format!("{x:.6e}");
    }
    let text = format!("{x:.*}", digits as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Model:")?;
        writeln!(
            f,
            "  {} nodes, {} beam elements, {} joints, {} prescribed coordinates",
            self.nodes, self.beam_elements, self.joints, self.prescribed
        )?;
        writeln!(
            f,
            "  {} degrees of freedom: six a node, less {} constraints, of which {} redundant",
            self.freedoms, self.constraints, self.redundant
        )?;
        for dependency in &self.dependencies {
            writeln!(f, "    {dependency}")?;
        }
        writeln!(
            f,
            "  mobility {} if all {} members were rigid, with {} redundant constraints",
            self.mobility, self.members, self.redundant_if_rigid
        )?;
        writeln!(
            f,
            "  mass {}, centre ({}, {}, {})",
            readable(self.mass),
            readable(self.centre.x),
            readable(self.centre.y),
            readable(self.centre.z)
        )?;
        for warning in &self.warnings {
            writeln!(f, "  warning: {warning}")?;
        }
        Ok(())
    }
}

/// Representative of each element of a partition, found by following links.
struct Partition(Vec<usize>);

impl Partition {
    fn new(count: usize) -> Self {
        Partition((0..count).collect())
    }

    fn find(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        // The least one represents all.
        self.0[a.max(b)] = a.min(b);
    }

    fn representatives(mut self) -> Vec<usize> {
        (0..self.0.len()).map(|i| self.find(i)).collect()
    }
}

/// For each node, the node that represents its member: beams are taken as rigid.
fn rigid_members(system: &System) -> Vec<usize> {
    let mut members = Partition::new(system.nodes());
    for placed in system.elements() {
        if matches!(placed.role, ElementRole::Beam(_)) {
            for pair in placed.element.nodes().windows(2) {
                members.join(pair[0], pair[1]);
            }
        }
    }
    members.representatives()
}

/// For each node the number of its part, if it is not connected to the ground or, where nothing is, to the
/// first node: parts count from 1 then, and none stands for the first part.
fn parts(system: &System) -> Vec<Option<usize>> {
    let ground = system.nodes();
    let mut connected = Partition::new(ground + 1);
    let mut grounded = false;
    for placed in system.elements() {
        let nodes = placed.element.nodes();
        for pair in nodes.windows(2) {
            connected.join(pair[0], pair[1]);
        }
        if let (ElementRole::Joint(_), [node]) = (placed.role, nodes) {
            connected.join(*node, ground);
            grounded = true;
        }
    }
    let representatives = connected.representatives();
    let main = representatives[if grounded { ground } else { 0 }];
    let mut others: Vec<usize> = Vec::new();
    representatives[..ground]
        .iter()
        .map(|&r| {
            if r == main {
                return None;
            }
            let place = others.iter().position(|&o| o == r).unwrap_or_else(|| {
                others.push(r);
                others.len() - 1
            });
            Some(place + 1)
        })
        .collect()
}

fn warn_of_parts(parts: &[Option<usize>], warnings: &mut Vec<String>) {
    let last = parts.iter().flatten().max().copied().unwrap_or(0);
    for part in 1..=last {
        let nodes: Vec<usize> = (0..parts.len())
            .filter(|&n| parts[n] == Some(part))
            .collect();
        warnings.push(format!(
            "nothing connects {} to the rest of the model",
            name_all("node", &nodes)
        ));
    }
}

fn warn_of_bare_nodes(system: &System, warnings: &mut Vec<String>) {
    let mut bare = vec![true; system.nodes()];
    for placed in system.elements() {
        if matches!(placed.role, ElementRole::Inertia | ElementRole::Beam(_)) {
            for &node in placed.element.nodes() {
                bare[node] = false;
            }
        }
    }
    let bare: Vec<usize> = (0..bare.len()).filter(|&n| bare[n]).collect();
    if !bare.is_empty() {
        let verb = if bare.len() == 1 { "has" } else { "have" };
        warnings.push(format!(
            "{} {verb} neither inertia nor a beam",
            name_all("node", &bare)
        ));
    }
}

fn warn_of_beams(model: &Model, warnings: &mut Vec<String>) {
    let mut massless = Vec::new();
    let (mut slender, mut odd_shear) = (Vec::new(), Vec::new());
    // Stiffness against stretching and bending, as forces for a displacement of the element's length.
    let (mut stiffest, mut softest) = ((0.0, 0), (f64::INFINITY, 0));
    for (index, beam) in model.beams.iter().enumerate() {
        let section = beam.middle_section();
        let length = beam.length();
        let (axial, shear) = (
            section.stiffness[(0, 0)],
            section.stiffness[(1, 1)].min(section.stiffness[(2, 2)]),
        );
        let bending = section.stiffness[(4, 4)].min(section.stiffness[(5, 5)]);
        if section.mass == Matrix6::zeros() {
            massless.push(index);
        }
        if (bending / axial).sqrt() < SLENDER * length {
            slender.push(index);
        }
        if !(1e-4..=1e2).contains(&(shear / axial)) {
            odd_shear.push(index);
        }
        let soft = bending / (length * length);
        if axial > stiffest.0 {
            stiffest = (axial, index);
        }
        if soft < softest.0 {
            softest = (soft, index);
        }
    }
    if !massless.is_empty() {
        warnings.push(format!("{}: no mass", name_all("beam element", &massless)));
    }
    if !slender.is_empty() {
        warnings.push(format!(
            "{}: very soft in bending against its axial stiffness, as if units were mixed up",
            name_all("beam element", &slender)
        ));
    }
    if !odd_shear.is_empty() {
        warnings.push(format!(
            "{}: shear stiffness of another order than the axial one",
            name_all("beam element", &odd_shear)
        ));
    }
    if stiffest.0 > SPREAD * softest.0 {
        warnings.push(format!(
            "beam element {} is {:.0e} times as stiff in tension as beam element {} is in bending: results lose as \
             many digits",
            stiffest.1,
            stiffest.0 / softest.0,
            softest.1
        ));
    }
}

fn warn_of_bodies(model: &Model, warnings: &mut Vec<String>) {
    let mut impossible = Vec::new();
    for inertia in &model.inertias {
        let &[node] = inertia.nodes() else { continue };
        let m = inertia.mass();
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
    }
    if !impossible.is_empty() {
        warnings.push(format!(
            "body at {}: no body has these moments of inertia, as the largest exceeds the sum of the others",
            name_all("node", &impossible)
        ));
    }
}

fn warn_of_open_joints(model: &Model, length: f64, warnings: &mut Vec<String>) {
    for (index, joint) in model.joints.iter().enumerate() {
        let states: Vec<NodeState> = joint
            .nodes()
            .iter()
            .map(|&n| NodeState::at_rest(model.nodes[n]))
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
                "joint {index} is open by {gap:.1e} (relative to the size of the model, or in radians) in the \
                 reference configuration; a solve closes it"
            ));
        }
    }
}
