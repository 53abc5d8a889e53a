//! Motions, the elements of SE(3).
//! See docs/theory.md, section 1.2.

use super::dual::{DualMatrix, DualVector};
use super::product::{product, transposed_product};
use super::rotation::{rotation_from_vector, skew_times};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use serde::{Deserialize, Serialize};

/// A motion: rotation and position of a frame, `R` and `r`, both with respect to the inertial
/// frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Rotation matrix; its columns are the frame's axes.
    pub rotation: Matrix3<f64>,
    /// Position of the frame's origin.
    pub position: Vector3<f64>,
}

impl Motion {
    /// The reference frame itself.
    pub fn identity() -> Self {
        Motion {
            rotation: Matrix3::identity(),
            position: Vector3::zeros(),
        }
    }

    /// From rotation and position.
    #[inline]
    pub fn new(rotation: Matrix3<f64>, position: Vector3<f64>) -> Self {
        Motion { rotation, position }
    }

    /// Composition: `other` is described in this frame.
    #[inline]
    pub fn compose(&self, other: &Motion) -> Motion {
        Motion {
            rotation: product(&self.rotation, &other.rotation),
            position: self.position + product(&self.rotation, &other.position),
        }
    }

    /// The same after a translation.
    #[inline]
    pub fn translated(&self, by: &Vector3<f64>) -> Motion {
        Motion::new(self.rotation, self.position + by)
    }

    /// Inverse motion.
    #[inline]
    pub fn inverse(&self) -> Motion {
        Motion {
            rotation: self.rotation.transpose(),
            position: -transposed_product(&self.rotation, &self.position),
        }
    }

    /// Motion of `other` relative to this frame, `C⁻¹ C_other`.
    #[inline]
    pub fn relative(&self, other: &Motion) -> Motion {
        Motion {
            rotation: transposed_product(&self.rotation, &other.rotation),
            position: transposed_product(&self.rotation, &(other.position - self.position)),
        }
    }

    /// Dual matrix `R + ε r̃ R`.
    #[inline]
    pub fn to_dual(&self) -> DualMatrix {
        DualMatrix {
            primal: self.rotation,
            dual: skew_times(&self.position, &self.rotation),
        }
    }

    /// 6×6 matrix that takes a twist in this frame to the frame it is described in.
    #[inline]
    pub fn adjoint(&self) -> Matrix6<f64> {
        self.to_dual().to_twist_matrix()
    }

    /// The motion after a material increment `[linear; angular]`, by the exponential map of SE(3).
    pub fn increment(&self, step: &Vector6<f64>) -> Motion {
        let step = DualVector::from_twist(step);
        let (angular, linear) = (step.primal, step.dual);
        let angle2 = angular.norm_squared();
        // (1 − cos x)/x² and (x − sin x)/x³, by series where the quotients would cancel.
        let (b, c) = if angle2 < 1e-4 {
            (
                0.5 - angle2 / 24.0 + angle2 * angle2 / 720.0,
                1.0 / 6.0 - angle2 / 120.0 + angle2 * angle2 / 5040.0,
            )
        } else {
            let angle = angle2.sqrt();
            let half = (0.5 * angle).sin() / (0.5 * angle);
            (0.5 * half * half, (angle - angle.sin()) / (angle2 * angle))
        };
        let turn = angular.cross(&linear);
        let translation = linear + turn * b + angular.cross(&turn) * c;
        Motion {
            rotation: product(&self.rotation, &rotation_from_vector(&angular)),
            position: self.position + product(&self.rotation, &translation),
        }
    }

    /// The same motion with its rotation made orthonormal again.
    ///
    /// Products of many rotations drift by rounding; one step of the polar iteration removes that.
    pub fn renormalised(&self) -> Motion {
        let r = self.rotation;
        Motion {
            rotation: product(
                &r,
                &(Matrix3::from_diagonal_element(1.5) - 0.5 * transposed_product(&r, &r)),
            ),
            position: self.position,
        }
    }
}

/// State of one node at one instant.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct NodeState {
    /// Motion from the inertial frame.
    pub motion: Motion,
    /// Material velocity `[linear; angular]`.
    pub twist: Vector6<f64>,
    /// Time derivative of the material velocity.
    pub twist_rate: Vector6<f64>,
}

impl NodeState {
    /// A node at rest.
    pub fn at_rest(motion: Motion) -> Self {
        NodeState {
            motion,
            twist: Vector6::zeros(),
            twist_rate: Vector6::zeros(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn increment_follows_a_screw_exactly() {
        let start = Motion::new(
            rotation_from_vector(&Vector3::new(0.4, 1.0, -0.3)),
            Vector3::new(1.0, 2.0, 3.0),
        );
        let step = Vector6::new(0.3, -0.2, 0.5, 0.9, -0.4, 1.2);
        let whole = start.increment(&step);
        let mut parts = start;
        for _ in 0..64 {
            parts = parts.increment(&(step / 64.0));
        }
        assert!((whole.rotation - parts.rotation).amax() < 1e-14);
        assert!((whole.position - parts.position).amax() < 1e-14);
    }

    #[test]
    fn adjoint_is_the_group_action_on_twists() {
        let a = Motion::identity().increment(&Vector6::new(0.1, 0.4, -0.3, 1.0, 0.2, 0.7));
        let step = Vector6::new(0.3, -0.2, 0.5, 0.9, -0.4, 1.2);
        // a exp(step) a⁻¹ = exp(Ad_a step)
        let left = Motion::identity().increment(&(a.adjoint() * step));
        let right = a
            .compose(&Motion::identity().increment(&step))
            .compose(&a.inverse());
        assert!((left.rotation - right.rotation).amax() < 1e-14);
        assert!((left.position - right.position).amax() < 1e-14);
        assert!((a.adjoint() * a.inverse().adjoint() - Matrix6::identity()).amax() < 1e-14);
    }
}
