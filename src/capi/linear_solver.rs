//! How linear equations are solved.

use crate::error::{Error, Result};
use crate::solve::{IterativeRecord, LinearMethod, Preconditioner};

/// Linear equations: solved directly where that is quick, by iteration otherwise.
pub const PDN_LINEAR_AUTOMATIC: i32 = 3500;
/// Linear equations: solved by factors of the whole Jacobian. Time grows with the third power of
/// the number of grid points, memory with the second.
pub const PDN_LINEAR_DIRECT: i32 = 3501;
/// Linear equations: solved by iteration, with the preconditioner that suits; time and memory grow
/// in proportion to nodes and grid points, or little more.
pub const PDN_LINEAR_ITERATIVE: i32 = 3502;
/// Linear equations: solved by iteration; bodies are averaged over time for the preconditioner,
/// joints are not.
pub const PDN_LINEAR_BODY_CIRCULANT: i32 = 3503;
/// Linear equations: solved by iteration; the preconditioner is equilibrium at each grid point,
/// without inertia.
pub const PDN_LINEAR_TIME_LOCAL: i32 = 3504;
/// Linear equations: solved by iteration; everything is averaged over time for the preconditioner.
pub const PDN_LINEAR_CIRCULANT: i32 = 3505;

pub(super) fn read_linear_solver(value: i32) -> Result<LinearMethod> {
    Ok(match value {
        PDN_LINEAR_AUTOMATIC => LinearMethod::Automatic,
        PDN_LINEAR_DIRECT => LinearMethod::Direct,
        PDN_LINEAR_ITERATIVE => LinearMethod::Iterative(None),
        PDN_LINEAR_BODY_CIRCULANT => LinearMethod::Iterative(Some(Preconditioner::BodyCirculant)),
        PDN_LINEAR_TIME_LOCAL => LinearMethod::Iterative(Some(Preconditioner::TimeLocal)),
        PDN_LINEAR_CIRCULANT => LinearMethod::Iterative(Some(Preconditioner::Circulant)),
        _ => {
            let expected = "a constant PDN_LINEAR_...";
            return Err(Error::value("options.linear_solver", expected, value));
        }
    })
}

pub(super) fn linear_solver_code(record: Option<&IterativeRecord>) -> i32 {
    let found = record.and_then(|record| record.preconditioner);
    found.map_or(PDN_LINEAR_DIRECT, preconditioner_code)
}

pub(super) fn preconditioner_code(preconditioner: Preconditioner) -> i32 {
    match preconditioner {
        Preconditioner::BodyCirculant => PDN_LINEAR_BODY_CIRCULANT,
        Preconditioner::TimeLocal => PDN_LINEAR_TIME_LOCAL,
        Preconditioner::Circulant => PDN_LINEAR_CIRCULANT,
    }
}
