//! Periodic response of flexible multibody systems by Fourier spectral collocation on SE(3), after
//! S. Han and O. A. Bauchau, *Nonlinear Dynamics* 92(4), 1599–1618, 2018.
//!
//! A [`model::Model`] describes the mechanism in its reference configuration;
//! [`output::Solution::solve`] finds its periodic response and gives access to it; [`capi`] is the
//! same for C. Any consistent set of units will do. `ARCHITECTURE.md` tells how the modules build
//! on each other.
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use periodyn::elements::{Coordinate, JointKind};
//! use periodyn::model::{JointCoordinate, Model, Signal};
//! use periodyn::output::{JointQuantity, Solution};
//! use periodyn::solve::PeriodicOptions;
//!
//! // An arm turns steadily about a horizontal axis, in gravity: what torque does it take?
//! let mut model = Model::new();
//! let arm = model.add_rigid_body(2.0, &Vector3::new(0.5, 0.0, 0.0), &Matrix3::identity())?;
//! let axis = Model::frame_at("axis", &Vector3::zeros(), &-Vector3::y())?;
//! let joint = model.add_joint(JointKind::Revolute, None, Some(arm), &axis, &axis)?;
//! let coordinate = Coordinate::Rotation1;
//! let turning = Signal::harmonics(0.0, 3.0, &[], &[])?;
//! model.prescribe(JointCoordinate { joint, coordinate }, &turning)?;
//! let constant = |g| Signal::constant(g);
//! model.set_gravity([constant(0.0)?, constant(0.0)?, constant(-9.81)?]);
//!
//! let options = PeriodicOptions::with_grid_points(9);
//! let period = std::f64::consts::TAU / 3.0;
//! let solution = Solution::solve(&model, period, &options, &mut |_, _| true)?;
//! let torque = solution.joint(joint, JointQuantity::DrivingEffort(coordinate), &[0.0])?[0];
//! assert!((torque - 2.0 * 9.81 * 0.5).abs() < 1e-9);
//! # Ok::<(), periodyn::error::Error>(())
//! ```

#![deny(unsafe_code)]

pub mod capi;
pub mod collocation;
pub mod elements;
pub mod error;
pub mod fourier;
pub(crate) mod memory;
pub mod model;
pub mod motion;
pub(crate) mod numbers;
pub mod output;
pub(crate) mod pages;
pub mod quantity;
pub mod ranks;
pub mod solve;
pub mod system;
mod work;
pub mod workers;

// The models of the tests name the crate as its users do.
#[cfg(test)]
extern crate self as periodyn;
#[cfg(test)]
#[path = "../tests/models/mod.rs"]
mod test_models;
