//! Motions of everything as one rigid body: about an axis, or in a direction.

use crate::error::{Result, require_finite};
use crate::model::direction;
use crate::motion::DualVector;
use nalgebra::{Vector3, Vector6};

/// A turn about an axis, or a translation in a direction.
#[derive(Debug, Clone, Copy)]
pub struct RigidMotion {
    /// Whether it is a translation.
    pub is_translation: bool,
    /// Its twist about the origin, resolved in space, of unit size.
    pub twist: Vector6<f64>,
}

impl RigidMotion {
    /// A turn about the axis through `point`.
    ///
    /// # Errors
    /// If an argument has no finite values, or `axis` has no direction.
    pub fn rotation(axis: &Vector3<f64>, point: &Vector3<f64>) -> Result<Self> {
        require_finite("point", point.as_slice())?;
        let twist = DualVector::of_turn(&direction("axis", axis)?.normalize(), point);
        Ok(RigidMotion {
            is_translation: false,
            twist: twist.to_twist(),
        })
    }

    /// A translation in this direction.
    ///
    /// # Errors
    /// If it has no finite values, or no direction.
    pub fn translation(along: &Vector3<f64>) -> Result<Self> {
        let twist = DualVector {
            primal: Vector3::zeros(),
            dual: direction("direction", along)?.normalize(),
        };
        Ok(RigidMotion {
            is_translation: true,
            twist: twist.to_twist(),
        })
    }
}
