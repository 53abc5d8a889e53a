//! Building a model: one validated call for each thing it has.

use super::{JointCoordinate, LoadDefinition, Model, Signal};
use crate::elements::{
    Attachment, Coordinate, Element, Inertia, Joint, JointKind, LoadFrame, Section,
};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::motion::{Motion, is_rotation};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// How far `RᵀR` may be from the identity: input written with 9 digits passes, and is then cleaned.
const ROTATION_TOLERANCE: f64 = 1e-8;

/// Highest polynomial degree of a beam element.
const HIGHEST_DEGREE: usize = 24;

/// Cross-section matrices as the user gives them, to be checked.
#[derive(Debug, Clone, Copy)]
pub struct SectionInput {
    /// Stiffness, symmetric and positive definite.
    pub stiffness: Matrix6<f64>,
    /// Mass, symmetric and positive semi-definite.
    pub mass: Matrix6<f64>,
    /// Damping, whose symmetric part is positive semi-definite.
    pub damping: Matrix6<f64>,
}

fn require_symmetric(name: &str, m: &Matrix6<f64>) -> Result<()> {
    require_finite(name, m.as_slice())?;
    let asymmetry = (m - m.transpose()).amax();
    if asymmetry > 1e-9 * m.amax() {
        return Err(Error::value(
            name,
            "a symmetric matrix",
            format!("entries that differ from their mirror by up to {asymmetry:.3e}"),
        ));
    }
    Ok(())
}

/// Smallest eigenvalue after scaling to a unit diagonal, so that it does not depend on units.
fn smallest_scaled_eigenvalue(m: &Matrix6<f64>) -> f64 {
    let scale = m
        .diagonal()
        .map(|d| if d == 0.0 { 1.0 } else { 1.0 / d.abs().sqrt() });
    let scale = Matrix6::from_diagonal(&scale);
    (scale * m * scale).symmetric_eigenvalues().min()
}

pub(super) fn require_positive(
    name: &str,
    m: &Matrix6<f64>,
    definite: bool,
) -> Result<Matrix6<f64>> {
    require_symmetric(name, m)?;
    let smallest = smallest_scaled_eigenvalue(m);
    let (wrong, expected) = if definite {
        (smallest <= 1e-14, "a positive-definite matrix")
    } else {
        (smallest < -1e-9, "a positive semi-definite matrix")
    };
    if wrong {
        let got = format!("one with the scaled eigenvalue {smallest:.3e}");
        return Err(Error::value(name, expected, got));
    }
    Ok(0.5 * m + 0.5 * m.transpose()) // the sum of large entries would overflow
}

/// Checks a damping matrix, which may be unsymmetric (as stiffness times a matrix of times is for
/// coupled sections): whatever the rates, it must not add energy.
fn require_dissipating(name: &str, m: &Matrix6<f64>) -> Result<Matrix6<f64>> {
    require_finite(name, m.as_slice())?;
    let symmetric = 0.5 * (m + m.transpose());
    let smallest = smallest_scaled_eigenvalue(&symmetric);
    if smallest < -1e-9 {
        return Err(Error::value(
            name,
            "a matrix whose symmetric part is positive semi-definite, so that no motion gains \
             energy",
            format!("one whose symmetric part has the scaled eigenvalue {smallest:.3e}"),
        ));
    }
    Ok(*m)
}

impl SectionInput {
    /// A section without couplings or damping: the six stiffnesses in their order, mass per length,
    /// and moments of inertia per length about axes 1, 2, 3.
    pub fn diagonal(stiffness: &[f64; 6], mass: &[f64; 4]) -> Result<Self> {
        require_finite("stiffness", stiffness)?;
        require_finite("mass", mass)?;
        if let Some(i) = stiffness.iter().position(|&k| k <= 0.0) {
            let name = format!("stiffness[{i}]");
            return Err(Error::value(&name, "a positive number", stiffness[i]));
        }
        if let Some(i) = mass.iter().position(|&m| m < 0.0) {
            let name = format!("mass[{i}]");
            return Err(Error::value(&name, "zero or more", mass[i]));
        }
        let [m, m11, m22, m33] = *mass;
        Ok(SectionInput {
            stiffness: Matrix6::from_diagonal(&Vector6::from(*stiffness)),
            mass: Matrix6::from_diagonal(&Vector6::new(m, m, m, m11, m22, m33)),
            damping: Matrix6::zeros(),
        })
    }

    /// Makes the damping `seconds` times the stiffness, which must have been set.
    pub fn damp_proportionally(&mut self, seconds: f64) -> Result<()> {
        require_finite("seconds", &[seconds])?;
        if seconds < 0.0 {
            return Err(Error::value("seconds", "zero or more", seconds));
        }
        self.damping = require_positive("section stiffness", &self.stiffness, true)? * seconds;
        Ok(())
    }

    /// Makes the damping `diag(seconds) 𝒦`, with one time for each resultant, as BeamDyn has it;
    /// the stiffness must have been set.
    ///
    /// # Errors
    /// If times are negative, or so different that a coupled section would gain energy in some
    /// motion.
    pub fn damp_by_component(&mut self, seconds: &[f64; 6]) -> Result<()> {
        require_finite("seconds", seconds)?;
        if let Some(i) = seconds.iter().position(|&time| time < 0.0) {
            let name = format!("seconds[{i}]");
            return Err(Error::value(&name, "zero or more", seconds[i]));
        }
        let stiffness = require_positive("section stiffness", &self.stiffness, true)?;
        let times = Matrix6::from_diagonal(&Vector6::from(*seconds));
        self.damping = require_dissipating("section damping", &(times * stiffness))?;
        Ok(())
    }

    pub(super) fn validated(&self) -> Result<Section> {
        Ok(Section {
            stiffness: require_positive("section stiffness", &self.stiffness, true)?,
            mass: require_positive("section mass", &self.mass, false)?,
            damping: require_dissipating("section damping", &self.damping)?,
        })
    }
}

/// Checks a rotation matrix and removes the rounding of its input.
fn require_rotation(name: &str, r: &Matrix3<f64>) -> Result<Matrix3<f64>> {
    require_finite(name, r.as_slice())?;
    if !is_rotation(r, ROTATION_TOLERANCE) {
        let got = format!(
            "RᵀR off the identity by {:.3e}, determinant {:.6}",
            (r.transpose() * r - Matrix3::identity()).amax(),
            r.determinant()
        );
        return Err(Error::value(name, "a rotation matrix", got));
    }
    Ok(crate::motion::polar_rotation(r))
}

/// A vector of the direction of `v`, of moderate length whatever that of `v`.
pub(super) fn direction(name: &str, v: &Vector3<f64>) -> Result<Vector3<f64>> {
    require_finite(name, v.as_slice())?;
    let size = v.amax();
    if size == 0.0 {
        return Err(Error::value(
            name,
            "a vector that is not zero",
            "the zero vector",
        ));
    }
    Ok(v / size)
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

/// The inertia `matrix`, about a frame at `offset` from `node`.
fn inertia_at(node: usize, offset: &Motion, matrix: &Matrix6<f64>) -> Result<Inertia> {
    let inertia = Inertia::rigid_body(node, offset, matrix);
    require_finite("inertia about the node", inertia.mass().as_slice())?;
    Ok(inertia)
}

/// Checks a motion and removes the rounding of its rotation.
pub(super) fn require_motion(name: &str, motion: &Motion) -> Result<Motion> {
    require_finite(&format!("{name} position"), motion.position.as_slice())?;
    let rotation = require_rotation(&format!("{name} rotation"), &motion.rotation)?;
    Ok(Motion::new(rotation, motion.position))
}

/// Checks that something connects two bodies.
pub(super) fn require_two_bodies(first: Option<usize>, second: Option<usize>) -> Result<()> {
    if first != second {
        return Ok(());
    }
    let got = first.map_or("the ground twice".into(), |n| format!("node {n} twice"));
    Err(Error::value("first, second", "two different bodies", got))
}

impl Model {
    pub(crate) fn require_node(&self, name: &str, node: usize) -> Result<()> {
        if node < self.nodes.len() {
            return Ok(());
        }
        let message = format!(
            "{name}: expected a node id below {}, got {node}",
            self.nodes.len()
        );
        Err(Error::new(ErrorKind::Identifier, message))
    }

    pub(crate) fn require_joint(&self, name: &str, joint: usize) -> Result<&Joint> {
        self.joints.get(joint).ok_or_else(|| {
            let count = self.joints.len();
            let message = format!("{name}: expected a joint id below {count}, got {joint}");
            Error::new(ErrorKind::Identifier, message)
        })
    }

    /// Checks the number of nodes of a beam element.
    pub(crate) fn require_element_size(name: &str, nodes: usize) -> Result<()> {
        if (2..=HIGHEST_DEGREE + 1).contains(&nodes) {
            return Ok(());
        }
        let expected = format!("2 to {} nodes", HIGHEST_DEGREE + 1);
        Err(Error::size(name, expected, nodes))
    }

    /// Checks the numbers that a beam is meshed by.
    pub(crate) fn require_mesh(elements: usize, degree: usize) -> Result<()> {
        const MOST: usize = 1_000_000;
        if !(1..=MOST).contains(&elements) {
            return Err(Error::size("elements", format!("1 to {MOST}"), elements));
        }
        if !(1..=HIGHEST_DEGREE).contains(&degree) {
            let expected = format!("1 to {HIGHEST_DEGREE}");
            return Err(Error::size("degree", expected, degree));
        }
        Ok(())
    }

    pub(crate) fn require_coordinate(&self, at: &JointCoordinate) -> Result<()> {
        let kind = self.require_joint("joint", at.joint)?.kind();
        if kind.coordinates().contains(&at.coordinate) {
            return Ok(());
        }
        let names: Vec<String> = kind
            .coordinates()
            .iter()
            .map(Coordinate::to_string)
            .collect();
        let message = format!(
            "coordinate: expected one of a {} joint ({}), got {}",
            kind.name(),
            if names.is_empty() {
                "it has none".into()
            } else {
                names.join(", ")
            },
            at.coordinate
        );
        Err(Error::new(ErrorKind::NotAvailable, message))
    }

    /// Adds a node at a reference motion; returns its id.
    pub fn add_node(&mut self, reference: &Motion) -> Result<usize> {
        require_finite("position", reference.position.as_slice())?;
        let rotation = require_rotation("rotation", &reference.rotation)?;
        self.nodes.push(Motion::new(rotation, reference.position));
        Ok(self.nodes.len() - 1)
    }

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
        let body = inertia_at(self.nodes.len(), &Motion::identity(), &matrix)?;
        let node = self.add_node(&Motion::new(Matrix3::identity(), *centre))?;
        self.inertias.push(body);
        Ok(node)
    }

    /// Fixes a mass to `node`; `centre`, and `inertia` about it, are in the inertial frame.
    pub fn add_mass(
        &mut self,
        node: usize,
        mass: f64,
        centre: &Vector3<f64>,
        inertia: &Matrix3<f64>,
    ) -> Result<()> {
        let matrix = central_inertia(mass, inertia)?;
        require_finite("centre", centre.as_slice())?;
        let frame = Motion::new(Matrix3::identity(), *centre);
        self.add_inertia(node, Some(&frame), &matrix)
    }

    /// Gives `node` the 6×6 inertia `matrix`, about and resolved in `frame`, which is given in the
    /// inertial frame (`None`: the node's own).
    pub fn add_inertia(
        &mut self,
        node: usize,
        frame: Option<&Motion>,
        matrix: &Matrix6<f64>,
    ) -> Result<()> {
        self.require_node("node", node)?;
        let offset = match frame {
            None => Motion::identity(),
            Some(frame) => self.nodes[node].relative(&require_motion("frame", frame)?),
        };
        let matrix = require_positive("matrix", matrix, false)?;
        self.inertias.push(inertia_at(node, &offset, &matrix)?);
        Ok(())
    }

    /// Total mass and its first moment `Σ m r`, in the inertial frame.
    pub fn mass_and_moment(&self) -> (f64, Vector3<f64>) {
        let mut total = (0.0, Vector3::zeros());
        for inertia in &self.inertias {
            let motions: Vec<Motion> = inertia.nodes().iter().map(|&n| self.nodes[n]).collect();
            let (mass, moment) = inertia.mass_and_moment(&motions);
            total.0 += mass;
            total.1 += moment;
        }
        total
    }

    /// Adds a joint of `kind` between two frames, given by their reference motions in the inertial
    /// frame and fixed to `first` and `second` (`None` is the ground). Returns its id.
    pub fn add_joint(
        &mut self,
        kind: JointKind,
        first: Option<usize>,
        second: Option<usize>,
        first_frame: &Motion,
        second_frame: &Motion,
    ) -> Result<usize> {
        let attach = |name: &str, node: Option<usize>, frame: &Motion| -> Result<Attachment> {
            let frame = require_motion(&format!("{name}_frame"), frame)?;
            let offset = match node {
                None => frame,
                Some(index) => {
                    self.require_node(name, index)?;
                    self.nodes[index].relative(&frame)
                }
            };
            Ok(Attachment { node, offset })
        };
        let pair = (
            attach("first", first, first_frame)?,
            attach("second", second, second_frame)?,
        );
        require_two_bodies(first, second)?;
        if let JointKind::Screw { pitch } = kind {
            require_finite("pitch", &[pitch])?;
            if pitch == 0.0 {
                return Err(Error::value("pitch", "a number other than zero", pitch));
            }
        }
        self.joints.push(Joint::new(kind, pair.0, pair.1));
        Ok(self.joints.len() - 1)
    }

    /// Makes a joint coordinate follow a signal.
    pub fn prescribe(&mut self, at: JointCoordinate, signal: &Signal) -> Result<()> {
        self.require_coordinate(&at)?;
        if self.prescribed.iter().any(|(other, _)| *other == at) {
            let got = format!("{} of joint {} again", at.coordinate, at.joint);
            return Err(Error::value(
                "coordinate",
                "one that is not prescribed yet",
                got,
            ));
        }
        self.prescribed.push((at, signal.clone()));
        Ok(())
    }

    /// Whether a joint coordinate is prescribed; its place among the prescribed ones.
    pub(crate) fn prescribed_index(&self, at: &JointCoordinate) -> Option<usize> {
        self.prescribed.iter().position(|(other, _)| other == at)
    }

    /// Adds a force and moment on a node.
    pub fn add_load(
        &mut self,
        node: usize,
        frame: LoadFrame,
        components: [Option<Signal>; 6],
    ) -> Result<()> {
        self.require_node("node", node)?;
        self.loads.push(LoadDefinition {
            node,
            frame,
            components,
        });
        Ok(())
    }

    /// Sets the acceleration of gravity, in the inertial frame.
    pub fn set_gravity(&mut self, acceleration: [Signal; 3]) {
        self.gravity = Some(acceleration);
    }

    /// Frame of a joint at `point` with axis 3 along `axis`.
    pub fn frame_at(name: &str, point: &Vector3<f64>, axis: &Vector3<f64>) -> Result<Motion> {
        require_finite("point", point.as_slice())?;
        let rotation = crate::motion::frame_from_axis(&direction(name, axis)?);
        Ok(Motion::new(rotation, *point))
    }

    /// Frame of a universal joint at `point`: axis 1 along the arm fixed to the first body, axis 2
    /// along the arm fixed to the second.
    pub fn cross_frame(
        point: &Vector3<f64>,
        first_arm: &Vector3<f64>,
        second_arm: &Vector3<f64>,
    ) -> Result<Motion> {
        let e1 = Self::frame_at("first_arm", point, first_arm)?
            .rotation
            .column(2)
            .into_owned();
        let e2 = Self::frame_at("second_arm", point, second_arm)?
            .rotation
            .column(2)
            .into_owned();
        let cosine = e1.dot(&e2);
        if cosine.abs() > 1e-8 {
            return Err(Error::value(
                "first_arm, second_arm",
                "perpendicular arms",
                format!("arms at {:.6} degrees", cosine.acos().to_degrees()),
            ));
        }
        let e3 = e1.cross(&e2).normalize();
        Ok(Motion::new(
            Matrix3::from_columns(&[e1, e3.cross(&e1), e3]),
            *point,
        ))
    }

    /// Joint coordinate `which` of `joint` in the reference configuration.
    pub(crate) fn reference_coordinate(&self, joint: usize, which: Coordinate) -> f64 {
        use crate::elements::{Element, NodeState};
        let joint = &self.joints[joint];
        let states: Vec<NodeState> = joint
            .nodes()
            .iter()
            .map(|&n| NodeState::at_rest(self.nodes[n]))
            .collect();
        joint
            .kind()
            .coordinate(which, &joint.relative_motion(&states))
            .value
    }
}
