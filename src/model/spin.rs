//! What spins about an axis of its own in the frame of its node.

use super::validation::direction;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::motion::{DualVector, Motion, tilde};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use serde::{Deserialize, Serialize};

/// How far an inertia may be from one that is symmetric: components written with 9 digits pass.
const SYMMETRIC: f64 = 1e-8;
/// Rounding of an inertia that is carried to its centre.
const ROUNDING: f64 = 1e-14;

/// A spin at a constant rate relative to a node.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spin {
    /// Direction of the axis, of length 1, along the axes of the node.
    axis: Vector3<f64>,
    /// Angle in a unit of time.
    pub(super) rate: f64,
}

impl Spin {
    /// About an axis in this direction.
    ///
    /// # Errors
    /// If an argument has no finite values, or `axis` has no direction.
    pub(super) fn new(axis: &Vector3<f64>, rate: f64) -> Result<Self> {
        let axis = direction("axis", axis)?.normalize();
        require_finite("rate", &[rate])?;
        Ok(Spin { axis, rate })
    }

    /// Direction of the axis, of length 1, along the axes of the node.
    pub fn axis(&self) -> Vector3<f64> {
        self.axis
    }

    /// Angle in a unit of time.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// The twist of what has this inertia about the node, relative to that.
    pub(super) fn twist(&self, inertia: &Matrix6<f64>) -> Vector6<f64> {
        let point = point_of_axis(inertia, &self.axis);
        DualVector::of_turn(&(self.axis * self.rate), &point).to_twist()
    }

    /// Checks one from a file, where an axis has the length 1 but for rounding.
    pub(super) fn require_clean(&self) -> Result<()> {
        require_finite("axis", self.axis.as_slice())?;
        require_finite("rate", &[self.rate])?;
        match (self.axis.norm() - 1.0).abs() < SYMMETRIC {
            true => Ok(()),
            false => Err(Error::value("axis", "length 1", self.axis.norm())),
        }
    }

    /// Checks that it leaves this inertia about the node as it is, and that what is `factor` times
    /// that has a momentum which is a number.
    pub(super) fn require_fits(&self, inertia: &Matrix6<f64>, factor: f64) -> Result<()> {
        let off = asymmetry(&central(inertia, &self.axis), &self.axis, inertia);
        if !is_symmetric(off) {
            let message = format!(
                "inertia: expected one that is symmetric about the axis through its centre of \
                 mass along ({}, {}, {}) that it spins about, got one of which {off:.3e} is not",
                self.axis.x, self.axis.y, self.axis.z
            );
            return Err(Error::new(ErrorKind::Value, message));
        }
        let momentum = inertia * self.twist(inertia) * factor;
        require_finite("inertia times rate", momentum.as_slice())
    }
}

/// The point nearest the node of the axis in this direction through the centre of mass.
fn point_of_axis(inertia: &Matrix6<f64>, axis: &Vector3<f64>) -> Vector3<f64> {
    let masses: Matrix3<f64> = inertia.fixed_view::<3, 3>(0, 0).into();
    let moments: Matrix3<f64> = inertia.fixed_view::<3, 3>(3, 0).into();
    // That across the axis.
    let mass = 0.5 * (masses.trace() - axis.dot(&(masses * axis)));
    match mass != 0.0 {
        true => moments.tr_mul(axis).cross(axis) / mass,
        false => Vector3::zeros(),
    }
}

/// Inertia about that point.
fn central(inertia: &Matrix6<f64>, axis: &Vector3<f64>) -> Matrix6<f64> {
    let centre = Motion::new(Matrix3::identity(), point_of_axis(inertia, axis));
    let carry = centre.adjoint();
    carry.tr_mul(&(inertia * carry))
}

/// Whether so large a share counts as none; not if it is not a number.
pub(super) fn is_symmetric(share: f64) -> bool {
    share <= SYMMETRIC
}

/// The largest share that a turn about an axis through the origin changes of the parts of a matrix
/// that acts on twists or strains, which has rounding errors as those of `rounded`.
pub(super) fn asymmetry(matrix: &Matrix6<f64>, axis: &Vector3<f64>, rounded: &Matrix6<f64>) -> f64 {
    let turn = tilde(&DualVector::of_turn(axis, &Vector3::zeros()).to_twist());
    let change = matrix * turn + turn.tr_mul(matrix);
    let size = |m: &Matrix6<f64>, i, j| m.fixed_view::<3, 3>(i, j).amax();
    let share = |(i, j): (usize, usize)| {
        let changed = size(&change, i, j);
        // What is about a node may be much larger than what is about the centre.
        match changed <= ROUNDING * size(rounded, i, j) {
            true => 0.0,
            false => changed / (size(matrix, i, i) * size(matrix, j, j)).sqrt(),
        }
    };
    let shares = [(0, 0), (0, 3), (3, 0), (3, 3)].map(share);
    // The largest of numbers would leave out what is none.
    match shares.iter().any(|share| share.is_nan()) {
        true => f64::NAN,
        false => shares.into_iter().fold(0.0, f64::max),
    }
}
