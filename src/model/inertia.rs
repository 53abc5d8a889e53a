//! Rigid bodies and masses.

use super::validation::{require_motion, require_positive};
use super::{Model, Spin};
use crate::elements::{Beam, Element, Inertia, Shell};
use crate::error::{Error, ErrorKind, Result, require_finite, require_id};
use crate::motion::Motion;
use nalgebra::{Matrix3, Matrix6, Vector3};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::sync::Arc;

/// What has mass.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub enum InertiaDefinition {
    /// The next beam element whose sections have mass.
    Beam,
    /// The next shell element with mass.
    Shell,
    /// A rigid body on a node.
    Body {
        /// The node.
        node: usize,
        /// 6×6 inertia about the node, along its axes.
        matrix: Box<Matrix6<f64>>,
        /// Factor of the whole.
        #[serde(default = "one")]
        factor: f64,
        /// How it spins relative to the node, if it does.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        spin: Option<Spin>,
    },
}

fn one() -> f64 {
    1.0
}

impl InertiaDefinition {
    /// The inertia of a body, with its factor.
    pub(super) fn of_body(&self) -> Option<Matrix6<f64>> {
        match self {
            InertiaDefinition::Beam | InertiaDefinition::Shell => None,
            InertiaDefinition::Body { matrix, factor, .. } => Some(**matrix * *factor),
        }
    }

    /// Whether it spins relative to its node.
    pub(super) fn spins(&self) -> bool {
        matches!(self, InertiaDefinition::Body { spin: Some(_), .. })
    }

    /// Checks one from a file.
    pub(super) fn require_clean(&self) -> Result<()> {
        if let InertiaDefinition::Body { factor, spin, .. } = self {
            require_finite("inertia", &[*factor])?;
            spin.map_or(Ok(()), |spin| spin.require_clean())?;
        }
        if let Some(matrix) = self.of_body() {
            require_finite("inertia", matrix.as_slice())?;
        }
        self.require_spin()
    }

    /// Checks that it can spin as it is said to.
    pub(super) fn require_spin(&self) -> Result<()> {
        match self {
            InertiaDefinition::Body {
                matrix,
                factor,
                spin: Some(spin),
                ..
            } => spin.require_fits(matrix, *factor),
            _ => Ok(()),
        }
    }
}

/// As a file has it. In the first version of the format that of beams was written out, too.
#[derive(Deserialize)]
#[serde(untagged)]
enum SavedInertia {
    Definition(InertiaDefinition),
    Version1 { nodes: Vec<usize>, mass: Vec<f64> },
}

/// Reads inertias as any version of the format has them.
pub(super) fn saved<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> std::result::Result<Vec<InertiaDefinition>, D::Error> {
    let saved = Vec::<SavedInertia>::deserialize(deserializer)?;
    let definition = |saved| match saved {
        SavedInertia::Definition(definition) => Ok(definition),
        SavedInertia::Version1 { nodes, mass } => match (&nodes[..], mass.len()) {
            (&[node], 36) => Ok(InertiaDefinition::Body {
                node,
                matrix: Box::new(Matrix6::from_column_slice(&mass)),
                factor: 1.0,
                spin: None,
            }),
            (&[_, _, ..], _) => Ok(InertiaDefinition::Beam),
            _ => Err(D::Error::custom(
                "an inertia of another size than its nodes",
            )),
        },
    };
    saved.into_iter().map(definition).collect()
}

/// Inertia of a rigid body about its centre, in the axes of the arguments.
fn central_inertia(mass: f64, inertia: &Matrix3<f64>) -> Result<Matrix6<f64>> {
    require_finite("mass", &[mass])?;
    require_finite("inertia", inertia.as_slice())?;
    if mass < 0.0 {
        return Err(Error::value("mass", "zero or more", mass));
    }
    let mut matrix = Matrix6::zeros();
    let mut block = matrix.fixed_view_mut::<3, 3>(3, 3);
    block.copy_from(inertia);
    matrix = require_positive("inertia", &matrix, false)?;
    matrix.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(mass);
    Ok(matrix)
}

impl Model {
    /// Adds a rigid body: a node at its centre of mass, with axes parallel to the inertial ones.
    /// `inertia` is about the centre, in the inertial frame. Returns the node's id.
    pub fn add_rigid_body(
        &mut self,
        mass: f64,
        centre: &Vector3<f64>,
        inertia: &Matrix3<f64>,
    ) -> Result<usize> {
        let matrix = central_inertia(mass, inertia)?;
        if mass == 0.0 {
            return Err(Error::value("mass", "a positive number", mass));
        }
        require_finite("centre", centre.as_slice())?;
        let node = self.add_node(&Motion::new(Matrix3::identity(), *centre))?;
        self.push_body(node, matrix);
        Ok(node)
    }

    /// Fixes a mass to `node`; `centre`, and `inertia` about it, are in the inertial frame. Returns
    /// its number among bodies, masses and inertias.
    pub fn add_mass(
        &mut self,
        node: usize,
        mass: f64,
        centre: &Vector3<f64>,
        inertia: &Matrix3<f64>,
    ) -> Result<usize> {
        let matrix = central_inertia(mass, inertia)?;
        require_finite("centre", centre.as_slice())?;
        let frame = Motion::new(Matrix3::identity(), *centre);
        self.add_inertia(node, Some(&frame), &matrix)
    }

    /// Gives `node` the 6×6 inertia `matrix`, about and resolved in `frame`, which is given in the
    /// inertial frame (`None`: the node's own). Returns its number among bodies, masses and
    /// inertias.
    pub fn add_inertia(
        &mut self,
        node: usize,
        frame: Option<&Motion>,
        matrix: &Matrix6<f64>,
    ) -> Result<usize> {
        self.require_node("node", node)?;
        let offset = match frame {
            None => Motion::identity(),
            Some(frame) => self.nodes[node].relative(&require_motion("frame", frame)?),
        };
        let matrix = require_positive("matrix", matrix, false)?;
        let carry = offset.inverse().adjoint();
        let matrix = carry.transpose() * matrix * carry;
        require_finite("inertia about the node", matrix.as_slice())?;
        Ok(self.push_body(node, matrix))
    }

    /// Lets a body, mass or inertia spin at a constant `rate` relative to its node, about the axis
    /// through its centre of mass along `axis`, which is fixed in the node and given along its
    /// axes; in place of any spin set before. The node is then a frame that does not spin along,
    /// and what keeps the rate acts between it and the body.
    ///
    /// # Errors
    /// If there is no such inertia, it is not symmetric about the axis, an argument has no finite
    /// values, or `axis` has no direction.
    pub fn set_spin(&mut self, inertia: usize, axis: &Vector3<f64>, rate: f64) -> Result<()> {
        require_id("inertia", "inertia", self.inertia_count(), inertia)?;
        let given = Spin::new(axis, rate)?;
        if let Some(InertiaDefinition::Body {
            matrix,
            factor,
            spin,
            ..
        }) = self.body_mut(inertia)
        {
            given.require_fits(matrix, *factor)?;
            *spin = Some(given);
        }
        Ok(())
    }

    /// How a body, mass or inertia spins relative to its node, if it does.
    pub fn spin(&self, inertia: usize) -> Option<Spin> {
        let mut bodies = self.inertias.iter().filter_map(|it| match it {
            InertiaDefinition::Body { spin, .. } => Some(*spin),
            InertiaDefinition::Beam | InertiaDefinition::Shell => None,
        });
        bodies.nth(inertia).flatten()
    }

    /// Number of bodies, masses and inertias.
    pub(super) fn inertia_count(&self) -> usize {
        let is_body = |it: &&InertiaDefinition| matches!(it, InertiaDefinition::Body { .. });
        self.inertias.iter().filter(is_body).count()
    }

    /// A body, mass or inertia.
    pub(super) fn body_mut(&mut self, number: usize) -> Option<&mut InertiaDefinition> {
        let is_body = |it: &&mut InertiaDefinition| matches!(it, InertiaDefinition::Body { .. });
        self.inertias.iter_mut().filter(is_body).nth(number)
    }

    fn push_body(&mut self, node: usize, matrix: Matrix6<f64>) -> usize {
        let number = self.inertia_count();
        self.inertias.push(InertiaDefinition::Body {
            node,
            matrix: Box::new(matrix),
            factor: 1.0,
            spin: None,
        });
        number
    }

    /// The inertias of bodies and of beam and shell elements, with the elements of these.
    ///
    /// # Errors
    /// If a beam is too distorted, or there is one with mass too few.
    pub(crate) fn inertia_elements(
        &self,
        beams: &[Arc<Beam>],
        shells: &[Arc<Shell>],
    ) -> Result<Vec<Inertia>> {
        // By their sections: a parameter may have made the factor of a mass zero.
        let mut massive = of_those(beams, &self.beams, |beam| beam.sections.has(|s| &s.mass));
        let mut massive_shells = of_those(shells, &self.shells, |shell| {
            shell.section.mass != Matrix6::zeros()
        });
        let too_many = || Error::size("inertias", "as many as beams and shells with mass", "more");
        let element = |inertia: &InertiaDefinition| match inertia {
            InertiaDefinition::Beam => match massive.next() {
                Some(beam) => beam.inertia(),
                None => Err(too_many()),
            },
            InertiaDefinition::Shell => match massive_shells.next() {
                Some(shell) => shell.inertia(),
                None => Err(too_many()),
            },
            InertiaDefinition::Body {
                node,
                matrix,
                factor,
                spin,
            } => {
                let body = **matrix * *factor;
                let body = Inertia::rigid_body(*node, &Motion::identity(), &body);
                Ok(match spin {
                    Some(spin) => body.spinning(&[spin.twist(matrix)]),
                    None => body,
                })
            }
        };
        self.inertias.iter().map(element).collect()
    }

    /// Total mass and its first moment `Σ m r`, in the inertial frame.
    ///
    /// # Errors
    /// If a beam is too distorted, or [`ErrorKind::Overflow`].
    pub fn mass_and_moment(&self) -> Result<(f64, Vector3<f64>)> {
        let inertias = self.inertia_elements(&self.beam_elements()?, &self.shell_elements()?)?;
        let mut total = (0.0, Vector3::zeros());
        for inertia in inertias {
            let motions: Vec<Motion> = inertia.nodes().iter().map(|&n| self.nodes[n]).collect();
            let (mass, moment) = inertia.mass_and_moment(&motions);
            total.0 += mass;
            total.1 += moment;
        }
        if !(total.0.is_finite() && total.1.iter().all(|x| x.is_finite())) {
            let message = "mass, or mass times distance, is too large to be a number in total";
            return Err(Error::new(ErrorKind::Overflow, message));
        }
        if total.0 > 0.0 && !(total.1 / total.0).iter().all(|x| x.is_finite()) {
            let message = "the centre of mass is too far away to be a number";
            return Err(Error::new(ErrorKind::Overflow, message));
        }
        Ok(total)
    }
}

/// The elements whose definitions are such.
fn of_those<'a, E, D>(
    elements: &'a [Arc<E>],
    definitions: &'a [D],
    are_such: impl Fn(&D) -> bool + 'a,
) -> impl Iterator<Item = &'a Arc<E>> {
    let all = elements.iter().zip(definitions);
    all.filter(move |(_, definition)| are_such(definition))
        .map(|(element, _)| element)
}
