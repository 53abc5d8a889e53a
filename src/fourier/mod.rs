//! Fourier spectral interpolation and differentiation on an odd, equispaced grid (docs/theory.md,
//! section 2).

mod cardinal;
mod differentiation;
mod filter;
mod grid;
mod resampling;
mod series;
mod transform;

pub use cardinal::CardinalWeights;
pub use differentiation::Differentiation;
pub use filter::{FilterKind, SpectralFilter};
pub use grid::TimeGrid;
pub use resampling::Resampling;
pub use series::PeriodicSeries;
pub use transform::{Analysis, Complex, Synthesis};
