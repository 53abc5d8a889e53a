//! Sensitivities: derivatives of what comes out of a periodic motion by parameters, also where free
//! parameters are held by conditions. See docs/theory.md, section 13.9.
//!
//! * `dependents.rs`: what is differentiated, and its gradient by all unknowns;
//! * `explicit.rs`: what residual, conditions and dependents change with a parameter at fixed
//!   unknowns;
//! * `multipliers.rs`: the same of Floquet multipliers;
//! * `requirements.rs`: what has none is refused.

mod dependents;
mod explicit;
mod multipliers;
mod requirements;

pub use dependents::Dependent;
pub use multipliers::{MultiplierSensitivities, solve_multiplier_sensitivities};

use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result};
use crate::model::Model;
use crate::solve::conditions::{Condition, Conditioned, Free, Given};
use crate::solve::linear::bordered::{Bordered, GROUNDING};
use crate::solve::linear::dense::{dot, largest};
use crate::solve::linear::method::{Linear, LinearMethod};
use crate::solve::linear::solver::{ESTIMATE, LinearSolver, Side};
use crate::solve::newton::Newton;
use crate::solve::result::Solved;
use crate::workers::Workers;
use dependents::Found;
use explicit::Explicit;
use nalgebra::DMatrix;
use requirements::{require_parameters, require_same, require_solution};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Growth of the bordered equations that means that they are singular.
const SINGULAR: f64 = 1e13;
/// Motions, relative to the size of the mechanism and in radians, for what counts as 1 in a
/// parameter, that only folds have.
const BEYOND: f64 = 1e5;
/// Increment that Newton's method may still ask for.
const UNSOLVED: f64 = 1e-6;
/// Times that compliance of constraints is taken back: each leaves some millionths of it.
const TAKEN_BACK: usize = 2;
/// What it may leave of them, relative to the right side.
const OPEN: f64 = 1e-6;

/// How sensitivities are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SensitivityMethod {
    /// With as few linear solves as can be: the adjoint method where there are fewer dependents
    /// than parameters.
    #[default]
    Automatic,
    /// A linear solve for each parameter.
    Direct,
    /// A transposed linear solve for each dependent.
    Adjoint,
}

/// Options of sensitivities.
#[derive(Debug, Clone, Copy)]
pub struct SensitivityOptions {
    /// How they are found.
    pub method: SensitivityMethod,
    /// How linear equations are solved.
    pub linear: LinearMethod,
    /// Threads that share the work; 0 for as many as there are processors.
    pub threads: usize,
}

impl Default for SensitivityOptions {
    fn default() -> Self {
        SensitivityOptions {
            method: SensitivityMethod::Automatic,
            linear: LinearMethod::Automatic,
            threads: 1,
        }
    }
}

/// Derivatives of dependents by parameters.
#[derive(Debug, Clone)]
pub struct Sensitivities {
    /// A row for each dependent, a column for each parameter.
    pub derivatives: DMatrix<f64>,
    /// Values of the dependents.
    pub values: Vec<f64>,
    /// Direct or adjoint.
    pub method: SensitivityMethod,
    /// Linear solves, plain or transposed, with the factors of one Jacobian.
    pub solves: usize,
    /// Time that it took.
    pub time: Duration,
}

/// Differentiates what comes out of a periodic motion of `model` by parameters: all else stays,
/// but for the `free` parameters, which follow so that the conditions go on to be met.
///
/// A condition on the phase means that of this motion. A parameter that moves nothing has zeros.
///
/// # Errors
/// If the motion is none that was found periodic, or is one of another model; if a dependent is
/// none, or has no derivative ([`crate::quantity::Peak`]); if parameters are not different ones, or
/// free at the same time. [`ErrorKind::NotAvailable`] if the equations are singular, as at a fold.
pub fn solve_sensitivities(
    (model, solve): (&Model, &Solved),
    (free, conditions): (&[Free], &[Arc<dyn Condition>]),
    dependents: &[Dependent],
    parameters: &[Free],
    options: &SensitivityOptions,
) -> Result<Sensitivities> {
    let began = Instant::now();
    let prepared = Prepared::new((model, solve), (free, conditions), parameters, options)?;
    let mut found = Found::new(dependents, free, &prepared.equations, &prepared.state)?;
    let Prepared {
        equations: inner,
        state,
        mut explicit,
        moving,
        values,
    } = prepared.with_free((model, free), conditions, &mut found)?;
    let mut solver = Solver::new(inner, state, options, (dependents.len(), moving.len()))?;
    let scaled = found.rows(&solver.newton.equations, &solver.state)?;
    let mut columns = Vec::with_capacity(moving.len());
    for (i, parameter) in moving.iter().enumerate() {
        let index = free.len() + i;
        columns.push(explicit.column(model, (index, *parameter), &found)?);
    }
    let derivatives = solver.derivatives(&scaled, &columns)?;
    let result = DMatrix::from_fn(dependents.len(), parameters.len(), |i, j| {
        let place = moving.iter().position(|p| *p == parameters[j]);
        place.map_or(0.0, |j| derivatives[(i, j)])
    });
    if result.iter().any(|x| !x.is_finite()) {
        let message = "the sensitivities are too large to be numbers";
        return Err(Error::new(ErrorKind::Overflow, message));
    }
    Ok(Sensitivities {
        derivatives: result,
        values: found.values(&values),
        method: solver.method,
        solves: solver.solves,
        time: began.elapsed(),
    })
}

/// The equations of a motion, before they are linearised.
struct Prepared {
    /// With the free parameters and their conditions, in the end.
    equations: Collocation,
    state: GridState,
    /// With all parameters as unknowns, which tells what depends on them.
    explicit: Explicit,
    /// Parameters that move anything.
    moving: Vec<Free>,
    /// Values of the free ones, and then of these.
    values: Vec<f64>,
}

impl Prepared {
    /// Still without what is free.
    fn new(
        (model, solve): (&Model, &Solved),
        (free, conditions): (&[Free], &[Arc<dyn Condition>]),
        parameters: &[Free],
        options: &SensitivityOptions,
    ) -> Result<Self> {
        require_solution(solve)?;
        if conditions.len() != free.len() {
            let expected = format!("as many as there are free parameters ({})", free.len());
            return Err(Error::size("conditions", expected, conditions.len()));
        }
        require_parameters(model, free, parameters)?;
        let period = solve.grid.period();
        let moving = parameters.iter().copied().filter(|p| moves(model, *p));
        let moving: Vec<Free> = moving.collect();
        let mut equations = Collocation::new(solve.system.clone(), solve.grid)?;
        equations.set_workers(Workers::new(options.threads)?);
        let mut state = solve.state.clone();
        state.scalars.clear();
        equations.update_kinematics(&state);
        let all: Vec<Free> = free.iter().chain(&moving).copied().collect();
        let all = Conditioned::new(model, period, &all)?;
        let values = all.values(period)?;
        let mut held = conditions.to_vec();
        held.extend(
            (free.len()..values.len()).map(|free| -> Arc<dyn Condition> {
                let value = values[free];
                Arc::new(Given { free, value })
            }),
        );
        let all = all.under(&held, &equations, &state)?;
        Ok(Prepared {
            explicit: Explicit::new(equations.clone(), (free.len(), all), &state, &values)?,
            equations,
            state,
            moving,
            values,
        })
    }

    /// With the free parameters as unknowns, and what the dependents change with them.
    fn with_free(
        mut self,
        (model, free): (&Model, &[Free]),
        conditions: &[Arc<dyn Condition>],
        found: &mut Found,
    ) -> Result<Self> {
        let period = self.equations.grid().period();
        let bordered = Conditioned::new(model, period, free)?;
        let bordered = bordered.under(conditions, &self.equations, &self.state)?;
        if !free.is_empty() {
            self.state.scalars = self.values[..free.len()].to_vec();
            self.equations.set_scalars(Arc::new(bordered));
        }
        for (index, parameter) in free.iter().enumerate() {
            let column = self.explicit.of_dependents((index, *parameter), found)?;
            found.add_column(column);
        }
        require_same(&mut self.equations, &self.state, &mut self.explicit)?;
        Ok(self)
    }
}

/// Whether a parameter moves anything.
fn moves(model: &Model, parameter: Free) -> bool {
    match parameter {
        Free::Frequency => true,
        Free::Parameter(id) => {
            let parameter = model.parameters().get(id);
            parameter.is_some_and(|parameter| !parameter.targets().is_empty())
        }
    }
}

/// What a parameter changes, unknowns held: for what counts as 1 in it.
struct Column {
    /// Of the scaled residual, and of the conditions behind it.
    residual: Vec<f64>,
    /// Of the dependents.
    dependents: Vec<f64>,
    /// What counts as 1 in the parameter.
    scale: f64,
}

/// The equations linearised at the motion, with the conditions.
struct Solver {
    newton: Newton<Bordered<Linear>>,
    state: GridState,
    method: SensitivityMethod,
    /// Whether another method may be taken.
    may_change: bool,
    solves: usize,
}

impl Solver {
    /// Linearises for so many dependents and parameters.
    fn new(
        mut equations: Collocation,
        state: GridState,
        options: &SensitivityOptions,
        (dependents, parameters): (usize, usize),
    ) -> Result<Self> {
        let linear = Linear::new(&equations, options.linear);
        // By iteration one more solve tells whether motions follow at all.
        let more = usize::from(!linear.is_direct());
        let method = match options.method {
            SensitivityMethod::Automatic if dependents + more < parameters => {
                SensitivityMethod::Adjoint
            }
            SensitivityMethod::Automatic => SensitivityMethod::Direct,
            chosen => chosen,
        };
        // Where conditions alone make the equations regular, factors show it, and iteration fails.
        if !linear.is_direct() && !state.scalars.is_empty() {
            equations.ground(GROUNDING);
        }
        let bordered = Bordered::new(&equations, linear);
        let mut solver = Solver {
            newton: Newton::with(equations, bordered),
            state,
            method,
            may_change: options.method == SensitivityMethod::Automatic,
            solves: 0,
        };
        solver.linearise()?;
        // Where factors are those of few freedoms, all would be factored for transposed solves.
        if solver.may_change && !solver.newton.linear.has_compliance() {
            solver.method = SensitivityMethod::Direct;
        }
        Ok(solver)
    }

    fn linearise(&mut self) -> Result<()> {
        let (newton, state) = (&mut self.newton, &self.state);
        let mut residual = vec![0.0; newton.equations.layout().size()];
        newton.equations.residual(state, &mut residual)?;
        let regular = newton.linearise(state)? && {
            let (linear, equations) = (&mut newton.linear, &mut newton.equations);
            linear.growth(equations) <= SINGULAR || linear.is_resisted(equations)
        };
        if !regular {
            return Err(singular("is not the only one nearby"));
        }
        // Of rounding there may be no solution; by iteration no more accurate one than it matters.
        let increment = match self.newton.linear.multiplies() {
            true => {
                self.solves += 1;
                let solved = self.newton.solve_linear(&mut residual, ESTIMATE)?;
                solved.then_some(residual)
            }
            false => self.solve(residual, Side::Plain).ok(),
        };
        let Some(increment) = increment else {
            return Ok(());
        };
        let left = largest(&increment[self.newton.equations.layout().motions()]);
        if left > UNSOLVED {
            let message = format!(
                "solution: expected one of the equations of the model at its grid points, under \
                 the conditions; they ask for another increment of {left:.1e}: it is a solution of \
                 others, as of oversampled ones"
            );
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        Ok(())
    }

    /// Solves to rounding.
    fn solve(&mut self, mut rhs: Vec<f64>, side: Side) -> Result<Vec<f64>> {
        let size = largest(&rhs);
        self.solve_in_place(&mut rhs, side)?;
        if !self.newton.equations.is_regularised() || !self.newton.linear.has_compliance() {
            return Ok(rhs);
        }
        // What compliance lets constraints open is taken back.
        let (mut last, mut rest) = (rhs.clone(), vec![0.0; rhs.len()]);
        for _ in 0..TAKEN_BACK {
            self.newton.equations.compliance_of(&last, &mut rest);
            last.copy_from_slice(&rest);
            self.solve_in_place(&mut last, side)?;
            rhs.iter_mut().zip(&last).for_each(|(x, d)| *x += d);
        }
        self.newton.equations.compliance_of(&last, &mut rest);
        if largest(&rest) > OPEN * size {
            let message = "sensitivities: constraints that depend on each other cannot all follow";
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        Ok(rhs)
    }

    fn solve_in_place(&mut self, rhs: &mut [f64], side: Side) -> Result<()> {
        self.solves += 1;
        let Newton {
            equations,
            linear,
            timings,
            ..
        } = &mut self.newton;
        if linear.solve_to_rounding(equations, rhs, side, timings)? {
            return Ok(());
        }
        Err(match side {
            Side::Plain => singular("cannot be differentiated"),
            Side::Transposed => {
                let message = "sensitivities: the transposed equations could not be solved as \
                               accurately as derivatives need; take the direct method, or another \
                               solver of linear equations";
                Error::new(ErrorKind::NotAvailable, message)
            }
        })
    }

    /// Derivatives of the dependents whose gradients are these rows, for what counts as 1 in the
    /// parameters.
    fn derivatives(&mut self, rows: &[Vec<f64>], columns: &[Column]) -> Result<DMatrix<f64>> {
        let found = self.by_method(rows, columns);
        let failed = matches!(&found, Err(e) if e.kind() == ErrorKind::NotAvailable);
        if failed && self.may_change && self.method == SensitivityMethod::Adjoint {
            self.method = SensitivityMethod::Direct;
            return self.by_method(rows, columns);
        }
        found
    }

    fn by_method(&mut self, rows: &[Vec<f64>], columns: &[Column]) -> Result<DMatrix<f64>> {
        let mut result = DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
            columns[j].dependents[i] / columns[j].scale
        });
        match self.method {
            SensitivityMethod::Adjoint => {
                for (i, row) in rows.iter().enumerate() {
                    let adjoint = self.solve(row.clone(), Side::Transposed);
                    if adjoint.is_err() {
                        // There may be no solution of the equations themselves, as at a fold.
                        self.check_reach(columns)?;
                    }
                    let adjoint = adjoint?;
                    for (j, column) in columns.iter().enumerate() {
                        result[(i, j)] -= dot(&adjoint, &column.residual) / column.scale;
                    }
                }
                // That motions follow at all shows in none of the transposed solutions.
                self.check_reach(columns)?;
            }
            _ => {
                for (j, column) in columns.iter().enumerate() {
                    let follows = self.solve(column.residual.clone(), Side::Plain)?;
                    self.require_reach(&follows)?;
                    for (i, row) in rows.iter().enumerate() {
                        result[(i, j)] -= dot(row, &follows) / column.scale;
                    }
                }
            }
        }
        Ok(result)
    }

    /// Checks that motions follow the parameters all together.
    fn check_reach(&mut self, columns: &[Column]) -> Result<()> {
        let mut sum = vec![0.0; self.newton.equations.layout().size()];
        for (j, column) in columns.iter().enumerate() {
            let factor = 1.0 / (1.0 + j as f64);
            let pairs = sum.iter_mut().zip(&column.residual);
            pairs.for_each(|(sum, x)| *sum += factor * x);
        }
        if !self.newton.linear.multiplies() {
            let follows = self.solve(sum, Side::Plain)?;
            return self.require_reach(&follows);
        }
        // By iteration no more accurately than it matters.
        self.solves += 1;
        match self.newton.solve_linear(&mut sum, ESTIMATE)? {
            true => self.require_reach(&sum),
            false => Err(singular("cannot be differentiated")),
        }
    }

    fn require_reach(&self, follows: &[f64]) -> Result<()> {
        let most = largest(&follows[self.newton.equations.layout().motions()]);
        // Written so that NaN is beyond.
        let is_within = most <= BEYOND;
        match is_within {
            true => Ok(()),
            false => Err(singular(&format!(
                "would move by {most:.1e} of the size of the mechanism where a parameter moves by \
                 its scale"
            ))),
        }
    }
}

/// Says that there are no derivatives where the equations are singular.
fn singular(how: &str) -> Error {
    let message = format!(
        "sensitivities: the equations are singular, or nearly so, and the motion {how}: there are \
         no derivatives at a fold or branch point, nor of what nothing holds, such as a limit \
         cycle or a free motion without a condition on its phase"
    );
    Error::new(ErrorKind::NotAvailable, message)
}
