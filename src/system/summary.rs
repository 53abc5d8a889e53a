//! What a model consists of, how it can move, and what looks like a mistake.

use super::constraints::Dependency;
use super::mass_properties::{MassProperties, readable, readable_all};
use super::partition::{Partition, parts};
use super::warnings::warnings;
use super::{ElementRole, Regime, Standstill, System};
use crate::error::Result;
use crate::model::{Labels, Model};
use nalgebra::Vector3;
use std::fmt::{self, Write};

/// Counts, mass, mobility and warnings of a model in its reference configuration.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of beam elements.
    pub beam_elements: usize,
    /// Number of shell elements.
    pub shell_elements: usize,
    /// Number of joints, those without constraints too.
    pub joints: usize,
    /// Number of prescribed joint coordinates.
    pub prescribed: usize,
    /// Number of constraints: those of joints, and one for each prescribed coordinate and each
    /// relation between coordinates.
    pub constraints: usize,
    /// Number of these that depend on others.
    pub redundant: usize,
    /// Degrees of freedom: six for each node, less the independent constraints.
    pub freedoms: usize,
    /// Rigid members: bodies, and beams and shells each taken as one rigid body.
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
    /// Mass, centre and inertia of each body, beam and shell that has mass.
    pub mass_properties: Vec<MassProperties>,
    /// Stations of sections inside beam elements: these are integrated from each to the next, but
    /// what bends or twists more from one on is smooth in the element.
    pub inner_stations: usize,
    /// What looks like a mistake, one sentence each.
    pub warnings: Vec<String>,
    /// Constraints that depend on each other.
    dependencies: Vec<Dependency>,
    /// What the user calls parts of the model.
    labels: Labels,
}

impl Summary {
    /// Looks at `model` in its reference configuration.
    ///
    /// # Errors
    /// If the model has no nodes, or a signal's function fails.
    pub fn of(model: &Model) -> Result<Self> {
        let system = System::in_regime(model, Regime::Standstill(Standstill::default()))?;
        let bodies = rigid_members(&system);
        let members = (0..bodies.len()).filter(|&n| bodies[n] == n).count();
        let constraints = system.constraint_count();
        let redundant = system.redundant_constraints();
        let rigid = system.dependencies_if_rigid(&bodies)?;
        let redundant_if_rigid: usize = rigid.iter().map(|d| d.count).sum();
        let parts = parts(&system, |_| true);
        let (mass, moment) = model.mass_and_moment()?;
        let labels = model.labels();
        let warnings = warnings(model, &system, &bodies, &parts);
        let warnings = warnings.iter().map(|text| labels.annotate(text)).collect();
        Ok(Summary {
            nodes: system.nodes(),
            beam_elements: model.beams.len(),
            shell_elements: model.shells.len(),
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
            mass_properties: MassProperties::of_members(&system, &bodies),
            inner_stations: model
                .beams
                .iter()
                .map(|beam| beam.sections.inner_places())
                .sum(),
            warnings,
            dependencies: system.dependencies().to_vec(),
            labels: labels.clone(),
        })
    }
}

/// Members that are written out, at most.
const WRITTEN: usize = 40;

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::new();
        self.write_plain(&mut text)?;
        f.write_str(&self.labels.annotate(&text))
    }
}

impl Summary {
    /// Without labels, but those that warnings have.
    fn write_plain(&self, f: &mut String) -> fmt::Result {
        let shells = match self.shell_elements {
            0 => String::new(),
            count => format!(" {count} shell elements,"),
        };
        writeln!(f, "Model:")?;
        writeln!(
            f,
            "  {} nodes, {} beam elements,{} {} joints, {} prescribed coordinates",
            self.nodes, self.beam_elements, shells, self.joints, self.prescribed
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
            "  mass {}, centre {}",
            readable(self.mass),
            readable_all(self.centre.into(), self.centre.amax())
        )?;
        for member in self.mass_properties.iter().take(WRITTEN) {
            writeln!(f, "    {member}")?;
        }
        if let Some(more) = self.mass_properties.len().checked_sub(WRITTEN + 1) {
            writeln!(f, "    and {} more", more + 1)?;
        }
        if self.inner_stations > 0 {
            writeln!(
                f,
                "  {} stations of sections inside beam elements: with boundaries there, higher \
                 degrees gain more",
                self.inner_stations
            )?;
        }
        for warning in &self.warnings {
            writeln!(f, "  warning: {warning}")?;
        }
        Ok(())
    }
}

/// For each node, the node that represents its member: beams and shells are taken as rigid.
fn rigid_members(system: &System) -> Vec<usize> {
    let mut members = Partition::new(system.nodes());
    for placed in system.elements() {
        if matches!(placed.role, ElementRole::Beam(_) | ElementRole::Shell(_)) {
            for pair in placed.element.nodes().windows(2) {
                members.join(pair[0], pair[1]);
            }
        }
    }
    members.representatives()
}
