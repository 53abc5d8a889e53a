//! The whole period: grid state, residual and Jacobian (docs/theory.md, section 5).
//!
//! With a grid of one point, velocities and accelerations vanish and the same equations are those
//! of static equilibrium at the grid's start time.

mod aliasing;
mod amplitude;
mod between;
mod decay;
mod division;
mod instants;
mod jacobian;
mod kinematics;
mod linearisation;
mod mesh;
mod mixed;
mod motion_tangent;
mod oversampled;
mod pattern;
mod problem;
mod resampled;
mod sensitivity;
mod state;
mod step;
mod stretching;
mod tangent;

pub use aliasing::Aliasing;
pub use between::{Defect, NodeInterpolation, ResidualBetween, too_coarse};
pub use decay::{Decay, DecayKind};
pub use jacobian::TangentBlocks;
pub use kinematics::{BackwardRule, NodeKinematics};
pub use linearisation::Linearisation;
pub use mixed::ResultantPath;
pub use motion_tangent::MotionTangent;
pub use oversampled::{Oversampled, OversampledTangent};
pub use pattern::{Panel, Pattern};
pub use problem::Collocation;
pub use resampled::ResampledNodes;
pub use sensitivity::{StepVariation, Variation, VariationScales};
pub use state::GridState;
pub use step::{AlphaStep, GeneralizedAlpha, GivenRates, MotionState};
pub use tangent::{Coupling, PairTangent, Station, Tangent, TangentLayout};
