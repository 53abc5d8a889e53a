//! Periodic response of flexible multibody systems by Fourier spectral collocation on SE(3).

#![deny(unsafe_code)]

pub mod capi;
pub mod collocation;
pub mod elements;
pub mod error;
pub mod fourier;
pub mod model;
pub mod motion;
pub mod output;
pub mod solve;
pub mod system;
