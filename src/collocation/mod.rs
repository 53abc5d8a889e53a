//! The whole period: grid state, residual and Jacobian (docs/theory.md, section 5).
//!
//! With a grid of one point, velocities and accelerations vanish and the same equations are those
//! of static equilibrium at the grid's start time.

mod amplitude;
mod between;
mod coupling;
mod decay;
mod division;
mod instants;
mod like_blades;
mod mesh;
mod mixed;
mod motion_tangent;
mod partition;
mod pattern;
mod problem;
mod resampled;
mod rule;
mod stages;
mod state;
mod stretching;
mod tangent;

pub use between::{Defect, ResidualBetween};
pub use decay::{Decay, DecayKind};
pub(crate) use like_blades::scaled_adjoint;
pub use like_blades::{AlikeMotions, Leaders, LikeBlades, OneBlade, require_like_blades};
pub use mixed::{CarriedResultants, ResultantPath};
pub use motion_tangent::MotionTangent;
pub use partition::{Halo, Item, Partition, RankPart};
pub use pattern::{Panel, Pattern};
pub use problem::{Collocation, Conditions, Oversampled, OversampledTangent, ScalarEquations};
pub use resampled::{ResampledNodes, too_coarse};
pub use rule::{
    Aliasing, AlphaStep, Antiperiodic, Backward, BackwardWeights, GeneralizedAlpha, GivenRates,
    KinematicsScratch, Mapped, MotionState, NodeKinematics, OverGrid, RadauStep, RadauWeights,
    RuleWorkspace, STAGES, Spectral, Steady, StepVariation, TimeRule, Variation, VariationScales,
    Wave, antiperiodic_at, over,
};
pub use stages::Stages;
pub use state::GridState;
pub use tangent::{Coupling, LikeBladesPattern, Linearisation, PairTangent, Station, Tangent};
