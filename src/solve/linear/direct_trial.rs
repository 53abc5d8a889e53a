//! What one direct solve takes, measured at a solution.

use crate::collocation::Collocation;
use crate::error::Result;
use crate::solve::linear::assembled::Assembled;
use crate::solve::linear::cost::DirectCost;
use crate::solve::linear::iterative::missing_inertia;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::{Timings, timed};
use crate::solve::result::Solved;
use crate::workers::Workers;

/// What a direct solve with the Jacobian at a periodic solution takes.
#[derive(Debug, Clone, PartialEq)]
pub struct DirectTrial {
    /// As planned.
    pub cost: DirectCost,
    /// As measured: one assembly, one factorisation, one substitution.
    pub timings: Timings,
}

/// Assembles and factors the Jacobian at a periodic solution and solves with it, once, by so many
/// threads.
///
/// # Errors
/// If the equations cannot be evaluated, or memory does not last.
pub fn try_direct_solve(solve: &Solved, threads: usize) -> Result<DirectTrial> {
    let mut equations = Collocation::new(solve.system.clone(), solve.grid)?;
    equations.set_workers(Workers::new(threads)?);
    let mut timings = Timings::default();
    let mut direct = timed(&mut timings.analysis, || Assembled::new(&equations));
    direct.linearise(&mut equations, &solve.state, &mut timings)?;
    let mut rhs = missing_inertia(&mut equations, &solve.state)?;
    timed(&mut timings.substitution, || {
        direct.solve(&mut equations, &mut rhs, 1e-8, &mut Timings::default())
    })?;
    Ok(DirectTrial {
        cost: DirectCost::of(&solve.system, solve.grid.points()),
        timings,
    })
}
