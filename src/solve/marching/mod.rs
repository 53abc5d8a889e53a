//! Marching in time by the generalised-α method, from consistent initial values, for a given time
//! or until the motion repeats itself; and periodic motions of the same scheme by shooting. See
//! docs/theory.md, section 12.
//!
//! * `options`: when a march starts and ends, how long its steps are, what is kept.
//! * `start`: where it starts, in the reference configuration or from given states.
//! * `consistent`: moves that onto the constraints, and finds accelerations, multipliers and rates
//!   of internal states (docs/theory.md, section 12.2). In it `matrix`, which all these follow
//!   from, and `rates`, what constraints ask of velocities and accelerations.
//! * `marcher`: one step after the other, each a Newton solve of an instant with the rule of
//!   `collocation/rule/alpha` (docs/theory.md, section 12.1), and its estimated error.
//! * `march`: [`march`] itself: steps of a length that is constant or follows the error, over
//!   periods, to the end.
//! * `repetition`: when a motion is periodic, by how its changes from period to period decay.
//! * `trajectory`: the states that are kept, put together to what a solve gives.
//! * `shooting`: [`solve_shooting`](shooting::solve_shooting), Newton's method on the map of one
//!   period (docs/theory.md, section 12.3). In it `period_map`, the map and its derivative, whose
//!   eigenvalues are the Floquet multipliers.
//!
//! A start that marches with Houbolt's rule to find a guess is none of this: it is in
//! `starts/dissipative_march`.

mod consistent;
mod march;
mod marcher;
mod options;
mod repetition;
pub(crate) mod shooting;
mod start;
mod trajectory;

pub use march::march;
pub use options::{MarchEnd, MarchOptions, MarchStart, StartState};

use crate::error::{Error, Result};
use crate::solve::report::Outcome;

/// Why a march, or its start, does not go on.
type Refusal = (Outcome, String);

/// What ends a computation within a march.
enum Stop {
    /// It cannot be done.
    Refused(Refusal),
    /// What the caller gave, or has, fails.
    Failed(Error),
}

/// What comes of it, unless it ends.
type Tried<T> = std::result::Result<T, Stop>;

/// Parts refusals from errors.
fn refused<T>(tried: Tried<T>) -> Result<std::result::Result<T, Refusal>> {
    match tried {
        Ok(value) => Ok(Ok(value)),
        Err(Stop::Refused(refusal)) => Ok(Err(refusal)),
        Err(Stop::Failed(error)) => Err(error),
    }
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Stop::Failed(error)
    }
}
