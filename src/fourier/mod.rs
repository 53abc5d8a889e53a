//! Fourier spectral interpolation and differentiation on an odd grid, equispaced in time or in
//! pseudo-time (docs/theory.md, section 2).

mod cardinal;
mod differentiation;
mod filter;
mod grid;
mod resampling;
mod series;
mod time_map;
mod transform;

pub use cardinal::CardinalWeights;
pub use differentiation::Differentiation;
pub use filter::{FilterKind, SpectralFilter};
pub use grid::TimeGrid;
pub use resampling::{Resampling, shares_of_product};
pub use series::PeriodicSeries;
pub use time_map::{SharpEvent, Slope, TimeMap};
pub use transform::{Analysis, Complex, Synthesis};
