//! The solves: linear algebra, Newton's method, starts, periodic motions, equilibria, marching,
//! modes. Each uses only those named before it.

mod branches;
mod conditions;
mod equilibrium;
mod linear;
mod marching;
mod memory;
mod modes;
mod newton;
mod periodic;
mod rank_equations;
mod report;
mod result;
mod sensitivities;
mod stability;
mod start;
mod starts;
mod step_length;
#[cfg(test)]
pub(crate) mod test_models;
mod watch;

pub use branches::{
    Branch, BranchEnd, BranchOptions, BranchPoint, Event, PointStability, continue_branch,
    follow_branch, follow_locus, switch_branch,
};
pub use conditions::{
    Condition, Energy, Free, Given, JointCoordinateIs, Momentum, OutputIs, Phase, RigidMotion,
    RigidPhase,
};
pub use equilibrium::{StaticOptions, solve_static};
pub use linear::cost::DirectCost;
pub use linear::diagnosis::describe_dependencies;
pub use linear::direct::DirectSolver;
pub use linear::direct_trial::{DirectTrial, try_direct_solve};
pub use linear::iterative::{IterativeRecord, LinearTrial, Preconditioner, try_linear_solve};
pub use linear::method::LinearMethod;
pub use marching::shooting::{ShootingOptions, solve_shooting};
pub use marching::{MarchEnd, MarchOptions, MarchStart, StartState, march};
pub(crate) use memory::require_states;
pub use modes::{Mode, ModesOptions, ModesSolve, solve_modes};
pub use newton::solve_with_scalars;
pub use periodic::adaptive::Adaptation;
pub use periodic::conditioned::solve_conditioned;
pub use periodic::options::{GridPoints, PeriodicOptions, TimeMapping};
pub use periodic::solve_periodic;
pub use rank_equations::{MOTION, RankEquations, RankOptions};
pub use report::{Iteration, NewtonOptions, NewtonReport, Outcome, Timings};
pub use result::{Assessment, GridTried, Kind, MarchRecord, PeriodicRecord, Solved, Unheld};
pub use sensitivities::{
    Dependent, MultiplierSensitivities, Sensitivities, SensitivityMethod, SensitivityOptions,
    solve_multiplier_sensitivities, solve_sensitivities,
};
pub use stability::{
    Multiplier, Stability, StabilityMethod, StabilityOptions, Verdict, solve_stability,
};
pub use start::{Attempt, InitialGuess, Start};
pub use watch::{Progress, Stage, Watch};
