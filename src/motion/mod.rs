//! Rigid-body motions: dual algebra, SO(3), SE(3), polar decomposition and motion interpolation.
//!
//! 6-vectors are ordered `[linear; angular]` = `[dual; primal]` for twists and increments, and
//! `[force; moment]` for wrenches, all resolved in the material frame unless said otherwise.

mod dual;
mod halves;
mod interpolation;
mod lanes;
mod logarithm;
mod periodic;
mod polar;
mod product;
mod rigid;
mod rotation;
mod scalar;

pub use dual::{Dual, DualMatrix, DualVector, tilde};
pub use halves::{halves, joined, turn_of_both, turned};
pub use interpolation::DualPolar;
pub use lanes::{Lanes, vectorised};
pub use logarithm::inverse_tangent;
pub use periodic::{PeriodicMotion, append_centred, mean_position};
pub use polar::{polar_rotation, spread_matrix, symmetric_factor_is_admissible};
pub use product::{product, transpose, transposed_product};
pub use rigid::{Motion, NodeState};
pub use rotation::{
    axial, frame_from_axis, is_rotation, quaternion_from_rotation, rotation_from_quaternion,
    rotation_from_vector, skew,
};
pub use scalar::Scalar;
