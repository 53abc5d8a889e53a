//! What one iterative solve takes, measured at a solution.

use super::{Iterative, Preconditioner};
use crate::collocation::{Collocation, Conditions, GridState};
use crate::elements::InertialForces;
use crate::error::Result;
use crate::solve::linear::solver::LinearSolver;
use crate::solve::report::Timings;
use crate::solve::result::Solved;
use std::time::{Duration, Instant};

/// Products that are timed.
const TIMED: usize = 5;

/// Part of the inertial forces that a Newton step makes up for.
const PART: f64 = 0.1;

/// What iterative solves with the Jacobian at a periodic solution take. Numbers of products are
/// none if the preconditioner cannot be had or the tolerance not be reached.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearTrial {
    /// Unknowns.
    pub unknowns: usize,
    /// Products of a Newton step to the solution from where a tenth of the inertial forces is
    /// missing.
    pub products: Option<usize>,
    /// Products for a solution without pattern: all numbers are of the same size, so that all
    /// harmonics count alike.
    pub products_of_noise: Option<usize>,
    /// Error of the latter, relative to its norm; infinite if there is none.
    pub error_of_noise: f64,
    /// Unknowns of the system of joints that turn.
    pub interface: usize,
    /// Time that the tangents and the preconditioner took.
    pub preparation: Duration,
    /// Time of the Newton step's solve.
    pub solution: Duration,
    /// Time of one product, the shortest of several.
    pub product: Duration,
    /// Bytes of the tangents, all of which a product reads.
    pub tangent_bytes: usize,
}

/// Solves the linearised equations of a periodic solution by iteration to `tolerance`.
///
/// # Errors
/// If the equations cannot be evaluated.
pub fn try_linear_solve(
    solve: &Solved,
    preconditioner: Preconditioner,
    tolerance: f64,
) -> Result<LinearTrial> {
    let mut equations = Collocation::new(solve.system.clone(), solve.grid)?;
    let mut step = missing_inertia(&mut equations, &solve.state)?;

    let mut iterative = Iterative::new(&equations, Some(preconditioner));
    let start = Instant::now();
    let prepared = iterative.linearise(&mut equations, &solve.state, &mut Timings::default())?;
    let preparation = start.elapsed();

    let start = Instant::now();
    let products = iterative.count(&mut equations, &mut step, tolerance, prepared)?;
    let solution = start.elapsed();

    let exact: Vec<f64> = (0..equations.size())
        .map(|i| (0.7 * i as f64).sin())
        .collect();
    let mut x = vec![0.0; exact.len()];
    let mut product = Duration::MAX;
    for _ in 0..TIMED {
        let start = Instant::now();
        iterative.tangent.apply(&equations, &exact, &mut x);
        product = product.min(start.elapsed());
    }
    // A preconditioner that has failed once is given up.
    let prepared = products.is_some();
    let products_of_noise = iterative.count(&mut equations, &mut x, tolerance, prepared)?;
    let norm = |x: &mut dyn Iterator<Item = f64>| x.map(|x| x * x).sum::<f64>().sqrt();
    let error = norm(&mut x.iter().zip(&exact).map(|(x, e)| x - e));
    Ok(LinearTrial {
        unknowns: exact.len(),
        products,
        products_of_noise,
        error_of_noise: match products_of_noise {
            Some(_) => error / norm(&mut exact.iter().copied()),
            None => f64::INFINITY,
        },
        interface: iterative.record.interface,
        preparation,
        solution,
        product,
        tangent_bytes: iterative.tangent.bytes(),
    })
}

/// Right side of a Newton step to the solution `state` from where a part of the inertial forces is
/// missing.
pub(crate) fn missing_inertia(equations: &mut Collocation, state: &GridState) -> Result<Vec<f64>> {
    let mut residual = vec![0.0; equations.size()];
    equations.set_conditions(Conditions {
        inertial: InertialForces {
            factor: 1.0 - PART,
            damping: 0.0,
        },
        ..Conditions::at(0.0)
    })?;
    equations.residual(state, &mut residual)?;
    equations.set_conditions(Conditions::at(0.0))?;
    Ok(residual)
}

impl Iterative {
    /// Products of a solve; none if it fails or there is no preconditioner.
    fn count(
        &mut self,
        equations: &mut Collocation,
        rhs: &mut [f64],
        tolerance: f64,
        prepared: bool,
    ) -> Result<Option<usize>> {
        let solved = prepared && self.solve(equations, rhs, tolerance, &mut Timings::default())?;
        Ok(self.record.products.last().copied().filter(|_| solved))
    }
}
