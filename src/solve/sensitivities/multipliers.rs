//! Sensitivities of Floquet multipliers (docs/theory.md, section 13.10).

use super::dependents::Found;
use super::{Column, Prepared, SensitivityMethod, SensitivityOptions, Solver};
use crate::collocation::{Collocation, GridState};
use crate::error::{Error, ErrorKind, Result};
use crate::model::Model;
use crate::solve::branches::singular::Singular;
use crate::solve::conditions::{Condition, Free};
use crate::solve::linear::dense::largest;
use crate::solve::linear::solver::Side;
use crate::solve::result::Solved;
use crate::solve::stability::Stability;
use nalgebra::{Complex, DMatrix};
use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::{Duration, Instant};

type C64 = Complex<f64>;

/// Most Newton iterations for an exponent.
const MOST: usize = 8;
/// Change of an exponent times the period that is none.
const NONE: f64 = 1e-11;
/// Difference of multipliers, relative to the larger of them and 1, that are taken for one.
const CLUSTER: f64 = 1e-6;
/// Difference of a multiplier from that of the equations on the grid, beside the estimate of its
/// error, that means that the grid does not resolve its mode.
const UNRESOLVED: f64 = 1e-6;

/// Derivatives of Floquet multipliers by parameters.
#[derive(Debug, Clone)]
pub struct MultiplierSensitivities {
    /// The multipliers, of the equations on the grid.
    pub values: Vec<C64>,
    /// A row for each multiplier, a column for each parameter.
    pub derivatives: DMatrix<C64>,
    /// Time that it took.
    pub time: Duration,
}

/// Differentiates multipliers of a periodic motion of `model`, of these `numbers` in its
/// `stability`, by parameters: the motion follows these, and so do `free` parameters, so that the
/// conditions go on to be met.
///
/// Exponents are first found once more, from the equations on the grid; all derivatives are those
/// of these equations.
///
/// # Errors
/// As [`solve_sensitivities`](super::solve_sensitivities). [`ErrorKind::NotAvailable`] if a
/// multiplier is not the only one of its value, is 1 because it shifts the motion, or is one of a
/// mode that the grid does not resolve; [`ErrorKind::Identifier`] if there is none of a number.
pub fn solve_multiplier_sensitivities(
    (model, solve): (&Model, &Solved),
    (free, conditions): (&[Free], &[Arc<dyn Condition>]),
    (stability, numbers): (&Stability, &[usize]),
    parameters: &[Free],
    options: &SensitivityOptions,
) -> Result<MultiplierSensitivities> {
    let began = Instant::now();
    require_simple(solve, stability, numbers)?;
    let prepared = Prepared::new((model, solve), (free, conditions), parameters, options)?;
    let mut found = Found::new(&[], free, &prepared.equations, &prepared.state)?;
    let Prepared {
        equations,
        state,
        mut explicit,
        moving,
        ..
    } = prepared.with_free((model, free), conditions, &mut found)?;
    let direct = SensitivityOptions {
        method: SensitivityMethod::Direct,
        ..*options
    };
    let mut solver = Solver::new(equations, state, &direct, (0, moving.len()))?;
    let mut directions = Vec::with_capacity(moving.len());
    for (i, parameter) in moving.iter().enumerate() {
        let index = free.len() + i;
        let column = explicit.column(model, (index, *parameter), &found)?;
        directions.push(solver.direction(index, &column)?);
    }
    let (equations, state) = explicit.at();
    let of_frequency = (free.iter().chain(&moving)).position(|p| *p == Free::Frequency);
    let of_frequency = of_frequency.map(|place| equations.layout().scalars().start + place);
    let period = solve.grid.period();
    let mut values = Vec::with_capacity(numbers.len());
    let mut derivatives = DMatrix::zeros(numbers.len(), parameters.len());
    for (row, &number) in numbers.iter().enumerate() {
        let mut mode = Mode::of((stability, number), equations, state)?;
        let exponent = mode.0.exponent();
        let value = (exponent * period).exp();
        values.push(value);
        for (parameter, along) in moving.iter().zip(&directions) {
            let by_motion = mode.along(state, along)?;
            // Of T = 2π / Ω.
            let turn = of_frequency.and_then(|place| along.direction.get(place));
            let turn = turn.copied().unwrap_or(0.0);
            let by_period = exponent * (-turn * period * period / TAU);
            let derivative = value * (by_motion * period + by_period) / along.scale;
            for (j, _) in parameters.iter().enumerate().filter(|p| p.1 == parameter) {
                derivatives[(row, j)] = derivative;
            }
        }
    }
    let finite = |x: &C64| x.re.is_finite() && x.im.is_finite();
    if !derivatives.iter().all(finite) {
        let message = "the sensitivities are too large to be numbers";
        return Err(Error::new(ErrorKind::Overflow, message));
    }
    Ok(MultiplierSensitivities {
        values,
        derivatives,
        time: began.elapsed(),
    })
}

/// Checks that multipliers have derivatives.
fn require_simple(solve: &Solved, stability: &Stability, numbers: &[usize]) -> Result<()> {
    let period = solve.grid.period();
    if (stability.period - period).abs() > 1e-12 * period {
        let message = format!(
            "stability: expected that of this motion, with its period of {period}, got one of a \
             motion with a period of {}",
            stability.period
        );
        return Err(Error::new(ErrorKind::Value, message));
    }
    let all = &stability.multipliers;
    for &number in numbers {
        let Some(multiplier) = all.get(number) else {
            let message = format!(
                "multipliers: expected numbers below {}, got {number}",
                all.len()
            );
            return Err(Error::new(ErrorKind::Identifier, message));
        };
        let none = |why: String| {
            let message = format!("multipliers: number {number} has no derivatives: {why}");
            Err(Error::new(ErrorKind::NotAvailable, message))
        };
        if multiplier.trivial {
            return none("it is 1 because its mode moves the motion in time or space".into());
        }
        let others = all.iter().enumerate().filter(|(other, _)| *other != number);
        for (other, near) in others {
            let size = multiplier.value.norm().max(near.value.norm()).max(1.0);
            let distance = (multiplier.value - near.value).norm();
            if distance <= CLUSTER * size + multiplier.error + near.error {
                return none(format!("number {other} is as large, or nearly so"));
            }
        }
    }
    Ok(())
}

/// A change of all unknowns, and of the parameters.
struct Direction {
    /// Not scaled, for what counts as 1 in a parameter.
    direction: Vec<f64>,
    /// Of motions, relative to what counts as 1 in them; at least 1, which is the parameter's.
    size: f64,
    /// What counts as 1 in the parameter.
    scale: f64,
}

impl Solver {
    /// What follows parameter `index`, and itself.
    fn direction(&mut self, index: usize, column: &Column) -> Result<Direction> {
        let follows = self.solve(column.residual.clone(), Side::Plain)?;
        self.require_reach(&follows)?;
        let equations = &self.newton.equations;
        let mut direction = self.newton.equations.unscaled(&follows, -1.0);
        let first = equations.layout().scalars().start;
        direction.resize(first + index, 0.0);
        direction.push(column.scale);
        Ok(Direction {
            direction,
            size: largest(&follows[equations.layout().motions()]).max(1.0),
            scale: column.scale,
        })
    }
}

/// A mode of disturbances.
struct Mode(Singular);

impl Mode {
    /// Of a multiplier, found once more from the equations on the grid.
    fn of(
        (stability, number): (&Stability, usize),
        equations: &Collocation,
        state: &GridState,
    ) -> Result<Self> {
        let (multiplier, period) = (&stability.multipliers[number], stability.period);
        let none = || {
            let message = format!(
                "multipliers: number {number} has no derivatives: the grid of the solution does \
                 not resolve its mode; more points may"
            );
            Error::new(ErrorKind::NotAvailable, message)
        };
        let singular = Singular::of_exponent(multiplier.exponent, equations, state)?;
        let mut singular = singular.ok_or_else(none)?;
        for _ in 0..MOST {
            let value = singular.value(state)?.ok_or_else(none)?;
            let change = -value / singular.by_exponent();
            singular.growth += change.re;
            singular.frequency += change.im;
            if !change.re.is_finite() || !change.im.is_finite() {
                break;
            }
            if change.norm() * period <= NONE {
                let found = (singular.exponent() * period).exp();
                let away = (found - multiplier.value).norm();
                let slack = UNRESOLVED * found.norm().max(1.0) + 10.0 * multiplier.error;
                return match away <= slack {
                    true => Ok(Mode(singular)),
                    false => Err(none()),
                };
            }
        }
        Err(none())
    }

    /// Derivative of the exponent along a direction, for what counts as 1 in the parameter.
    fn along(&mut self, state: &GridState, along: &Direction) -> Result<C64> {
        let mut direction = along.direction.clone();
        direction.resize(self.0.unknowns(), 0.0);
        let change = self.0.along(state, &direction, along.size)?;
        Ok(-change / self.0.by_exponent())
    }
}
