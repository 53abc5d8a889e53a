//! The periodic solve: initial guess, Newton with line search, direct linear solver, diagnostics.

mod adaptive;
mod assembled;
mod assembly;
mod blocks;
mod branch;
mod consistent;
mod dense;
mod diagnosis;
mod direct;
mod direct_trial;
mod eigen;
mod eigenvalues;
mod estimate;
mod free_motions;
mod freedoms;
mod front;
mod guess;
mod iterative;
mod krylov;
mod linear;
mod loads;
mod march;
mod method;
mod modes;
mod newton;
mod ordering;
mod partial_lu;
mod pencil;
mod periodic;
mod settle;
mod shooting;
mod slender;
mod starts;
mod statics;
#[cfg(test)]
pub(crate) mod test_models;
mod trajectory;
mod watch;
mod waves;

pub use adaptive::{Adaptation, GridTried};
pub use diagnosis::describe_dependencies;
pub use direct::DirectSolver;
pub use direct_trial::{DirectTrial, try_direct_solve};
pub use estimate::Assessment;
pub use iterative::{IterativeRecord, LinearTrial, Preconditioner, try_linear_solve};
pub use loads::Unheld;
pub use method::{DirectCost, LinearMethod};
pub use modes::{Mode, ModesOptions, ModesSolve, solve_modes};
pub use newton::{Iteration, NewtonOptions, NewtonReport, Outcome, Timings};
pub use periodic::{
    GridPoints, InitialGuess, PeriodicOptions, PeriodicSolve, Stage, solve_periodic,
};
pub use shooting::{ShootingOptions, solve_shooting};
pub use starts::{Attempt, Start};
pub use statics::{StaticOptions, solve_static};
pub use trajectory::{MarchEnd, MarchOptions, MarchRecord, MarchStart, StartState, march};
pub use watch::{Progress, Watch};
