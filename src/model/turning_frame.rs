//! A frame that turns steadily, and may advance along its axis, in which a model and its motions
//! are described.

use super::Model;
use super::validation::direction;
use crate::error::{Error, ErrorKind, Result, require_finite};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A frame that turns about a fixed axis at a constant rate. At time zero its axes are the inertial
/// ones.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TurningFrame {
    /// Direction of the axis, of length 1.
    axis: Vector3<f64>,
    /// Angle in a unit of time.
    pub(super) rate: f64,
    /// A point of the axis.
    point: Vector3<f64>,
    /// Speed along the axis.
    #[serde(default)]
    pub(super) advance: f64,
}

impl TurningFrame {
    /// Direction of the axis, of length 1.
    pub fn axis(&self) -> Vector3<f64> {
        self.axis
    }

    /// Angle in a unit of time.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// A point of the axis.
    pub fn point(&self) -> Vector3<f64> {
        self.point
    }

    /// Speed along the axis.
    pub fn advance(&self) -> f64 {
        self.advance
    }

    /// The angular velocity.
    pub fn angular_velocity(&self) -> Vector3<f64> {
        self.axis * self.rate
    }

    /// Checks that the velocity of what is at the origin is a number.
    pub(super) fn require_finite(&self) -> Result<()> {
        let velocity = self.point.cross(&self.angular_velocity());
        require_finite("rate times point", velocity.as_slice())
    }
}

impl Model {
    /// Describes everything in a frame that turns about an axis through `point` at a constant
    /// `rate`, in place of any set before: positions, directions, prescribed motions, and the
    /// ground, which is at rest in it. Inertial forces are those of the motion in the inertial
    /// frame. What repeats itself but for a turn in each period, `M(t + T) = exp(ω̃ T) M(t)`, is
    /// periodic there.
    ///
    /// # Errors
    /// If an argument has no finite values, or `axis` has no direction.
    pub fn set_turning_frame(
        &mut self,
        axis: &Vector3<f64>,
        rate: f64,
        point: &Vector3<f64>,
    ) -> Result<()> {
        let axis = direction("axis", axis)?.normalize();
        require_finite("rate", &[rate])?;
        require_finite("point", point.as_slice())?;
        let frame = TurningFrame {
            axis,
            rate,
            point: *point,
            advance: 0.0,
        };
        frame.require_finite()?;
        self.turning_frame = Some(frame);
        Ok(())
    }

    /// Lets the frame that everything is described in advance along its axis at a constant `speed`,
    /// too. What repeats itself but for a translation in each period, or a screw motion, is
    /// periodic there.
    ///
    /// # Errors
    /// If there is no such frame, or `speed` is not finite.
    pub fn set_frame_advance(&mut self, speed: f64) -> Result<()> {
        require_finite("speed", &[speed])?;
        let frame = self.turning_frame.as_mut().ok_or_else(|| {
            let message = "model: expected one that is described in a turning frame, which may \
                           have the rate zero";
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        frame.advance = speed;
        Ok(())
    }

    /// The frame that everything is described in, if it turns.
    pub fn turning_frame(&self) -> Option<&TurningFrame> {
        self.turning_frame.as_ref()
    }
}
