//! Joints, and their coordinates that follow signals.

use super::validation::{direction, require_motion, require_two_bodies};
use super::{Model, Signal};
use crate::elements::{Attachment, Coordinate, Element, Joint, JointKind, NodeState};
use crate::error::{Error, Result, require_finite, require_id};
use crate::motion::{Motion, frame_from_axis};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// A joint coordinate of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct JointCoordinate {
    /// Index of the joint.
    pub joint: usize,
    /// Which of its coordinates.
    pub coordinate: Coordinate,
}

/// A joint between two frames.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct JointDefinition {
    /// Kind of the joint.
    pub kind: JointKind,
    /// The frame on the first body.
    pub first: Attachment,
    /// The frame on the second.
    pub second: Attachment,
}

impl JointDefinition {
    /// The element.
    pub(crate) fn element(&self) -> Joint {
        Joint::new(self.kind, self.first, self.second)
    }
}

impl Model {
    pub(crate) fn require_joint(&self, name: &str, joint: usize) -> Result<&JointDefinition> {
        require_id(name, "joint", self.joints.len(), joint)?;
        Ok(&self.joints[joint])
    }

    pub(crate) fn require_coordinate(&self, at: &JointCoordinate) -> Result<()> {
        let kind = self.require_joint("joint", at.joint)?.kind;
        kind.require_coordinate(at.coordinate)
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
            self.attachment(name, node, frame)
        };
        self.place_joint(JointDefinition {
            kind,
            first: attach("first", first, first_frame)?,
            second: attach("second", second, second_frame)?,
        })
    }

    /// A frame fixed to a body (`None` is the ground), from where it is in the reference
    /// configuration.
    pub(super) fn attachment(
        &self,
        name: &str,
        node: Option<usize>,
        frame: Motion,
    ) -> Result<Attachment> {
        let offset = match node {
            None => frame,
            Some(index) => {
                self.require_node(name, index)?;
                let offset = self.nodes[index].relative(&frame);
                // Both positions are numbers; how far they are apart need not be one.
                let distance = offset.position.as_slice();
                require_finite(&format!("{name}_frame's distance from its node"), distance)?;
                offset
            }
        };
        Ok(Attachment { node, offset })
    }

    /// Adds a joint whose frames are valid.
    pub(super) fn place_joint(&mut self, joint: JointDefinition) -> Result<usize> {
        require_two_bodies(joint.first.node, joint.second.node)?;
        if let JointKind::Screw { pitch } = joint.kind {
            require_finite("pitch", &[pitch])?;
            if pitch == 0.0 {
                return Err(Error::value("pitch", "a number other than zero", pitch));
            }
        }
        self.joints.push(joint);
        Ok(self.joints.len() - 1)
    }

    /// Makes a joint coordinate follow a signal; returns its number among those that do.
    pub fn prescribe(&mut self, at: JointCoordinate, signal: &Signal) -> Result<usize> {
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
        Ok(self.prescribed.len() - 1)
    }

    /// Whether a joint coordinate is prescribed; its place among the prescribed ones.
    pub(crate) fn prescribed_index(&self, at: &JointCoordinate) -> Option<usize> {
        self.prescribed.iter().position(|(other, _)| other == at)
    }

    /// Frame of a joint at `point` with axis 3 along `axis`.
    pub fn frame_at(name: &str, point: &Vector3<f64>, axis: &Vector3<f64>) -> Result<Motion> {
        require_finite("point", point.as_slice())?;
        let rotation = frame_from_axis(&direction(name, axis)?);
        Ok(Motion::new(rotation, *point))
    }

    /// Frame at `point`: axis 3 along `axis_3`, axis 1 along the part of `axis_1` across it.
    ///
    /// # Errors
    /// If a direction is zero, or both are along one line.
    pub fn frame_with_axes(
        point: &Vector3<f64>,
        axis_3: &Vector3<f64>,
        axis_1: &Vector3<f64>,
    ) -> Result<Motion> {
        let e3 = Self::frame_at("axis_3", point, axis_3)?
            .rotation
            .column(2)
            .into_owned();
        let given = direction("axis_1", axis_1)?;
        let across = given - e3 * e3.dot(&given);
        if across.norm() <= 1e-8 * given.norm() {
            let expected = "a direction away from axis_3";
            return Err(Error::value("axis_1", expected, "one along it"));
        }
        let e1 = across.normalize();
        Ok(Motion::new(
            Matrix3::from_columns(&[e1, e3.cross(&e1), e3]),
            *point,
        ))
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

    /// A joint coordinate in the reference configuration.
    pub(crate) fn reference_coordinate(&self, at: &JointCoordinate) -> f64 {
        let joint = self.joints[at.joint].element();
        let states = joint.nodes().iter();
        let states: Vec<NodeState> = states.map(|&n| NodeState::at_rest(self.nodes[n])).collect();
        let z = joint.relative_motion(&states);
        joint.kind().coordinate_value(at.coordinate, &z)
    }
}
