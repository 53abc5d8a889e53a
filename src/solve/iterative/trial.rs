//! What one iterative solve takes, measured at a solution.

use super::{Iterative, Preconditioner};
use crate::collocation::Collocation;
use crate::error::Result;
use crate::solve::linear::LinearSolver;
use crate::solve::newton::Timings;
use crate::solve::periodic::PeriodicSolve;
use std::time::{Duration, Instant};

/// Products that are timed.
const TIMED: usize = 5;

/// What an iterative solve with the Jacobian at a periodic solution takes.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearTrial {
    /// Unknowns.
    pub unknowns: usize,
    /// Products of the solve; none if the preconditioner cannot be had, or the tolerance not be reached.
    pub products: Option<usize>,
    /// Error of the solution, relative to its norm; infinite if there is none.
    pub error: f64,
    /// Unknowns of the dense system of joints that turn.
    pub interface: usize,
    /// Time that the tangents and the preconditioner took.
    pub preparation: Duration,
    /// Time of the solve.
    pub solution: Duration,
    /// Time of one product, the shortest of several.
    pub product: Duration,
    /// Bytes of the tangents, all of which a product reads.
    pub tangent_bytes: usize,
}

/// Solves the linearised equations of a periodic solution by iteration to `tolerance`, for a solution that is known: all
/// numbers are of the same size and without pattern.
///
/// # Errors
/// If the equations cannot be evaluated.
pub fn try_linear_solve(
    solve: &PeriodicSolve,
    preconditioner: Preconditioner,
    tolerance: f64,
) -> Result<LinearTrial> {
    let mut equations = Collocation::new(solve.system.clone(), solve.grid)?;
    let mut iterative = Iterative::new(&equations, Some(preconditioner));
    let start = Instant::now();
    let prepared = iterative.linearise(&mut equations, &solve.state, &mut Timings::default())?;
    let preparation = start.elapsed();

    let exact: Vec<f64> = (0..equations.size())
        .map(|i| (0.7 * i as f64).sin())
        .collect();
    let mut x = vec![0.0; exact.len()];
    let mut product = Duration::MAX;
    for _ in 0..TIMED {
        let start = Instant::now();
        iterative.tangent.apply(&mut equations, &exact, &mut x);
        product = product.min(start.elapsed());
    }

    let start = Instant::now();
    let solved = prepared && iterative.solve(&mut equations, &mut x, tolerance)?;
    let norm = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>().sqrt();
    let error = norm(&mut x.iter().zip(&exact).map(|(x, e)| x - e));
    Ok(LinearTrial {
        unknowns: exact.len(),
        products: iterative
            .record
            .products
            .first()
            .copied()
            .filter(|_| solved),
        error: if solved {
            error / norm(&mut exact.iter().copied())
        } else {
            f64::INFINITY
        },
        interface: iterative.record.interface,
        preparation,
        solution: start.elapsed(),
        product,
        tangent_bytes: iterative.tangent.bytes(),
    })
}
