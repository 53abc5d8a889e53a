//! What a model holds, for those who have not built it themselves.

use super::target::no_such_signal;
use super::{
    BeamDefinition, DistributedLoadDefinition, ForceDefinition, InertiaDefinition, JointCoordinate,
    JointDefinition, LoadDefinition, Model, ShellLoadDefinition, Signal, SignalPlace,
};
use crate::elements::{Attachment, Section};
use crate::error::{Error, Result, require_finite, require_id, require_positive_number};
use crate::motion::Motion;
use nalgebra::Matrix6;

impl Model {
    /// The joint of this id.
    ///
    /// # Errors
    /// [`ErrorKind::Identifier`](crate::error::ErrorKind::Identifier).
    pub fn joint(&self, joint: usize) -> Result<&JointDefinition> {
        self.require_joint("joint", joint)
    }

    /// The force of this id.
    ///
    /// # Errors
    /// [`ErrorKind::Identifier`](crate::error::ErrorKind::Identifier).
    pub fn force(&self, force: usize) -> Result<&ForceDefinition> {
        self.require_force("force", force)
    }

    /// The beam element of this id.
    ///
    /// # Errors
    /// [`ErrorKind::Identifier`](crate::error::ErrorKind::Identifier).
    pub fn beam_definition(&self, element: usize) -> Result<&BeamDefinition> {
        require_id("element", "beam element", self.beams.len(), element)?;
        Ok(&self.beams[element])
    }

    /// Cross-section of a beam element, with the factors of parameters, at a place from −1 to 1,
    /// and the angle by which its axes are turned from those between the nodes.
    ///
    /// # Errors
    /// If there is no such element or place.
    pub fn beam_section(&self, element: usize, station: f64) -> Result<(Section, f64)> {
        let beam = self.beam_definition(element)?;
        require_finite("station", &[station])?;
        if !(-1.0..=1.0).contains(&station) {
            return Err(Error::value("station", "a number from -1 to 1", station));
        }
        let sections = beam.sections.scaled(&beam.factors);
        Ok((sections.at(station), sections.twist(station)))
    }

    /// Where a frame that is fixed to a body is in the reference configuration.
    pub fn reference_frame(&self, end: &Attachment) -> Motion {
        match end.node.and_then(|node| self.nodes.get(node)) {
            Some(node) => node.compose(&end.offset),
            None => end.offset,
        }
    }

    /// Nodes of bodies, masses and inertias, in the order in which these were given, with their
    /// inertia about the node, along its axes, times the factors of parameters.
    pub fn inertias(&self) -> impl Iterator<Item = (usize, Matrix6<f64>)> {
        let of_body = |inertia: &InertiaDefinition| match inertia {
            InertiaDefinition::Body { node, .. } => Some((*node, inertia.of_body()?)),
            InertiaDefinition::Beam | InertiaDefinition::Shell => None,
        };
        self.inertias.iter().filter_map(of_body)
    }

    /// Prescribed coordinates with their signals, in the order in which they were prescribed.
    pub fn prescribed(&self) -> &[(JointCoordinate, Signal)] {
        &self.prescribed
    }

    /// Loads at points, in the order in which they were added.
    pub fn loads(&self) -> &[LoadDefinition] {
        &self.loads
    }

    /// Loads along beam elements, likewise.
    pub fn beam_loads(&self) -> &[DistributedLoadDefinition] {
        &self.distributed_loads
    }

    /// Loads on shell elements, likewise.
    pub fn shell_loads(&self) -> &[ShellLoadDefinition] {
        &self.shell_loads
    }

    /// Values of a signal of the model in motions of a period.
    ///
    /// # Errors
    /// If there is no such signal; those of functions of the user.
    pub fn sample_signal(
        &self,
        place: SignalPlace,
        period: f64,
        times: &[f64],
    ) -> Result<Vec<f64>> {
        require_positive_number("period", period)?;
        require_finite("times", times)?;
        let signal = self.signal(place).ok_or_else(|| no_such_signal(place))?;
        let bound = signal.bind(period);
        times.iter().map(|&time| bound.value(time)).collect()
    }
}

/// Numbers of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceNumber {
    /// Coefficients of the powers of the growth, from the first; of a viscoelastic element the
    /// long-term stiffness, then that of each branch; of a bushing its matrix, column by column.
    Stiffness,
    /// Coefficients of the powers of the rate, from the first; the matrix of a viscous damper or
    /// bushing, column by column.
    Damping,
    /// Relaxation times of the branches of a viscoelastic element.
    RelaxationTime,
    /// The coordinate at which a spring or viscoelastic element is free of effort.
    Rest,
}

impl ForceDefinition {
    /// Its numbers of a sort, with the factors of parameters; none if it has none.
    pub fn numbers(&self, which: ForceNumber) -> Vec<f64> {
        use ForceNumber::{Damping, RelaxationTime, Rest, Stiffness};
        match (self, which) {
            (
                ForceDefinition::SpringDamper { rest, .. }
                | ForceDefinition::Viscoelastic { rest, .. },
                Rest,
            ) => vec![*rest],
            (ForceDefinition::SpringDamper { stiffness, .. }, Stiffness) => stiffness.clone(),
            (ForceDefinition::SpringDamper { damping, .. }, Damping) => damping.clone(),
            (
                ForceDefinition::Viscoelastic {
                    stiffness,
                    branches,
                    ..
                },
                Stiffness,
            ) => {
                let of_branches = branches.iter().map(|branch| branch.stiffness);
                std::iter::once(*stiffness).chain(of_branches).collect()
            }
            (ForceDefinition::Viscoelastic { branches, .. }, RelaxationTime) => branches
                .iter()
                .map(|branch| branch.relaxation_time)
                .collect(),
            (ForceDefinition::ViscousDamper { matrix, .. }, Damping) => matrix.as_slice().to_vec(),
            (ForceDefinition::Bushing(bushing), Stiffness) => {
                bushing.scaled()[0].as_slice().to_vec()
            }
            (ForceDefinition::Bushing(bushing), Damping) => bushing.scaled()[1].as_slice().to_vec(),
            _ => Vec::new(),
        }
    }

    /// The frames that it stands between, if it does.
    pub fn ends(&self) -> Option<[Attachment; 2]> {
        match self {
            ForceDefinition::ViscousDamper { first, second, .. } => Some([*first, *second]),
            ForceDefinition::Bushing(bushing) => Some([bushing.first, bushing.second]),
            _ => None,
        }
    }

    /// The nodes of a user's force.
    pub fn user_nodes(&self) -> &[usize] {
        match self {
            ForceDefinition::NodeForces { nodes, .. } => nodes,
            _ => &[],
        }
    }
}
