//! Newton's method for points where an event happens (docs/theory.md, section 13.7).

use super::event_equation::EventEquation;
use super::walk::{Place, Walk};
use crate::collocation::GridState;
use crate::error::Result;
use crate::solve::conditions::{ArcLength, Condition};
use crate::solve::modes::pencil::C64;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Most iterations.
const MOST: usize = 10;
/// Length of an increment that is none.
const NONE: f64 = 1e-11;
/// Increments that become no shorter than by this factor, once they are short, are rounding.
const STANDS: f64 = 0.2;
/// What is short.
const SHORT: f64 = 1e-7;
/// Accuracy of linear solves: of increments, which may be rounding, and of tangents.
const ACCURACY: [f64; 2] = [1e-6, 1e-9];

/// A point where an event happens.
pub(super) struct Located {
    pub state: GridState,
    /// Directions of all solutions there, without the event's equation; of length 1.
    pub tangents: Vec<Vec<f64>>,
    /// Lengths of Newton's increments.
    pub increments: Vec<f64>,
}

/// What is linear there.
struct Linearised {
    /// The increment to a solution, and its length.
    correction: Vec<f64>,
    tangents: Vec<Vec<f64>>,
}

impl Walk<'_> {
    /// Solves from `state` with the equation of an event; `along` are directions that the solutions
    /// have there, one for each unknown beyond those of the conditions, and `last` the equation
    /// that is left if they are two. None where that fails.
    pub fn locate_from(
        &mut self,
        mut state: GridState,
        own: &mut EventEquation,
        mut along: Vec<Vec<f64>>,
        last: Option<Arc<dyn Condition>>,
    ) -> Result<Option<Located>> {
        let mut increments: Vec<f64> = Vec::new();
        for _ in 0..MOST {
            let Some(linear) = self.linearised(&state, &along)? else {
                return Ok(None);
            };
            along = linear.tangents;
            let Some(value) = own.value(self, &state, &along)? else {
                return Ok(None);
            };
            let size = self.length(&linear.correction);
            let to_solution = own.along(self, &state, (&linear.correction, size))?;
            let Some(to_solution) = to_solution else {
                return Ok(None);
            };
            let rest = self.rest_of(last.as_deref(), &state, &linear.correction, &along)?;
            let mut by = Vec::with_capacity(along.len());
            for tangent in &along {
                let Some(change) = own.along(self, &state, (tangent, 1.0))? else {
                    return Ok(None);
                };
                by.push(change);
            }
            let found = solved(own.by_frequency(), value + to_solution, &by, rest);
            let Some((shares, turn)) = found else {
                return Ok(None);
            };
            let mut increment = linear.correction;
            for (share, tangent) in shares.iter().zip(&along) {
                let pairs = increment.iter_mut().zip(tangent);
                pairs.for_each(|(x, t)| *x += share * t);
            }
            let grid = self.newton.equations.grid();
            let size = self.length(&increment).hypot(turn * grid.period() / TAU);
            if !size.is_finite() {
                return Ok(None);
            }
            let system = self.newton.equations.system().clone();
            state = state.incremented(&system, &increment, 1.0);
            own.set_frequency(own.frequency() + turn);
            let before = increments.last().copied().unwrap_or(f64::INFINITY);
            increments.push(size);
            if size <= NONE || before < SHORT && size > STANDS * before {
                let Some(linear) = self.linearised(&state, &along)? else {
                    return Ok(None);
                };
                let tangents = linear.tangents;
                return Ok(Some(Located {
                    state,
                    tangents,
                    increments,
                }));
            }
            // Further away each time.
            if increments.len() > 3 && size > before {
                return Ok(None);
            }
        }
        Ok(None)
    }

    /// The increment to a solution that leaves the parts along some directions as they are, and the
    /// directions in which solutions go on, each with a part along one of these alone.
    fn linearised(&mut self, state: &GridState, along: &[Vec<f64>]) -> Result<Option<Linearised>> {
        let lasts = along.iter().map(|tangent| {
            let still: Arc<dyn Condition> = Arc::new(self.arc(state, tangent, 0.0));
            still
        });
        self.set_conditions(lasts.collect(), state)?;
        let layout = self.newton.equations.layout();
        let mut residual = vec![0.0; layout.size()];
        self.newton.equations.residual(state, &mut residual)?;
        let [rough, accurate] = ACCURACY;
        if !self.newton.linearise(state)? || !self.newton.solve_linear(&mut residual, rough)? {
            return Ok(None);
        }
        let correction = self.newton.equations.unscaled(&residual, -1.0);
        let mut tangents: Vec<Vec<f64>> = Vec::new();
        for row in layout.size() - along.len()..layout.size() {
            let mut unit = vec![0.0; layout.size()];
            unit[row] = 1.0;
            if !self.newton.solve_linear(&mut unit, accurate)? {
                return Ok(None);
            }
            let mut tangent = self.newton.equations.unscaled(&unit, 1.0);
            for other in &tangents {
                let part = self.inner(&tangent, other);
                let pairs = tangent.iter_mut().zip(other);
                pairs.for_each(|(x, t)| *x -= part * t);
            }
            let size = self.length(&tangent);
            tangent.iter_mut().for_each(|x| *x /= size);
            tangents.push(tangent);
        }
        let finite = |x: &Vec<f64>| x.iter().all(|x| x.is_finite());
        let known = finite(&correction) && tangents.iter().all(finite);
        Ok(known.then_some(Linearised {
            correction,
            tangents,
        }))
    }

    /// What is left of a condition after the correction, and its derivatives along the tangents.
    fn rest_of(
        &self,
        last: Option<&dyn Condition>,
        state: &GridState,
        correction: &[f64],
        along: &[Vec<f64>],
    ) -> Result<Option<(f64, Vec<f64>)>> {
        let Some(last) = last else {
            return Ok(None);
        };
        let equations = &self.newton.equations;
        let mut row = vec![0.0; equations.layout().size()];
        last.gradient(equations, state, &mut row)?;
        let dot = |x: &[f64]| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
        let scale = last.scale(equations);
        let value = last.value(equations, state)? + dot(correction);
        let by = along.iter().map(|tangent| dot(tangent) / scale);
        Ok(Some((value / scale, by.collect())))
    }

    /// Length of an increment.
    pub fn length(&self, increment: &[f64]) -> f64 {
        self.inner(increment, increment).sqrt()
    }

    /// A length along a tangent from a state, as a condition.
    pub fn arc(&self, from: &GridState, tangent: &[f64], length: f64) -> ArcLength {
        ArcLength {
            from: from.clone(),
            tangent: tangent.to_vec(),
            product: self.product,
            scales: self.scales.clone(),
            length,
        }
    }

    /// The direction in which points with the event go on, with a part along the one `before`; none
    /// if it is not determined.
    pub fn locus_tangent(
        &mut self,
        located: &Located,
        own: &mut EventEquation,
        before: Option<&[f64]>,
    ) -> Result<Option<Place>> {
        let state = &located.state;
        if own.value(self, state, &located.tangents)?.is_none() {
            return Ok(None);
        }
        let mut by = Vec::new();
        for tangent in &located.tangents {
            let Some(change) = own.along(self, state, (tangent, 1.0))? else {
                return Ok(None);
            };
            by.push(change);
        }
        let &[first, second] = &by[..] else {
            return Ok(None);
        };
        // Of two unknowns, or three with a complex equation, those that leave σ as it is.
        let shares = match own.by_frequency() {
            None => [-second.re, first.re],
            Some(turn) => {
                let across = |x: C64, y: C64| x.re * y.im - x.im * y.re;
                [across(second, turn), across(turn, first)]
            }
        };
        let mut tangent = vec![0.0; located.tangents[0].len()];
        for (share, one) in shares.iter().zip(&located.tangents) {
            let pairs = tangent.iter_mut().zip(one);
            pairs.for_each(|(x, t)| *x += share * t);
        }
        let mut length = self.length(&tangent);
        if before.is_some_and(|before| self.inner(&tangent, before) < 0.0) {
            length = -length;
        }
        tangent.iter_mut().for_each(|x| *x /= length);
        let known = tangent.iter().all(|x| x.is_finite());
        Ok(known.then(|| Place::new(state.clone(), tangent)))
    }
}

/// Shares of the tangents, and the change of the frequency, that make all zero to the first order.
fn solved(
    by_frequency: Option<C64>,
    value: C64,
    by: &[C64],
    rest: Option<(f64, Vec<f64>)>,
) -> Option<(Vec<f64>, f64)> {
    let mut rows = vec![(value.re, by.iter().map(|x| x.re).collect::<Vec<_>>())];
    if let Some(turn) = by_frequency {
        rows[0].1.push(turn.re);
        let imaginary = by.iter().map(|x| x.im).chain([turn.im]);
        rows.push((value.im, imaginary.collect()));
    }
    if let Some((value, mut by)) = rest {
        by.resize(rows[0].1.len(), 0.0);
        rows.push((value, by));
    }
    let count = rows.len();
    if rows.iter().any(|(_, by)| by.len() != count) {
        return None;
    }
    let matrix = DMatrix::from_fn(count, count, |i, j| rows[i].1[j]);
    let right = DVector::from_fn(count, |i, _| -rows[i].0);
    let found = matrix.lu().solve(&right)?;
    let mut shares: Vec<f64> = found.iter().copied().collect();
    let turn = match by_frequency {
        Some(_) => shares.pop()?,
        None => 0.0,
    };
    shares
        .iter()
        .all(|x| x.is_finite())
        .then_some((shares, turn))
}
