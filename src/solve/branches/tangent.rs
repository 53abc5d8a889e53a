//! In which direction a branch goes on from a point (docs/theory.md, section 13.3).

use super::walk::{Place, Walk};
use crate::collocation::GridState;
use crate::error::Result;

/// Accuracy of tangents, and of those by factors of a state nearby, of which nothing is better
/// than was asked for.
const TANGENT: [f64; 2] = [1e-9, 1e-12];
/// Accuracy of a tangent that is guessed, once enough is added to it, and how often that is done at
/// most.
const ENOUGH: f64 = 1e-8;
const MOST_ADDED: usize = 3;
/// Accuracy of what is added: enough of as much as was added to the last tangent, within bounds.
const ADDED: [f64; 2] = [1e-8, 1e-2];

impl Walk<'_> {
    /// The first tangent, at a solution where the parameter was given; none if the branch does not
    /// go on along the parameter there.
    pub fn first_tangent(&mut self, state: GridState) -> Result<Option<Place>> {
        let found = self.tangent(&state, None, None)?;
        let Some(mut tangent) = found else {
            return Ok(None);
        };
        let last = tangent.len() - 1;
        let wanted = if self.options.downwards { -1.0 } else { 1.0 };
        if tangent[last] * wanted < 0.0 {
            tangent.iter_mut().for_each(|x| *x = -*x);
        }
        Ok(Some(Place::new(state, tangent)))
    }

    /// The scaled direction at a solution that only the last condition is not met along; by factors
    /// of a state nearby, if there are some, and from a guess.
    fn direction(
        &mut self,
        state: &GridState,
        nearby: bool,
        guess: Option<&[f64]>,
    ) -> Result<Option<Vec<f64>>> {
        let newton = &mut self.newton;
        let regular = match nearby {
            true => {
                let (equations, timings) = (&mut newton.equations, &mut newton.timings);
                newton.linear.move_to(equations, state, timings)?
            }
            false => newton.linearise(state)?,
        };
        if !regular {
            return Ok(None);
        }
        if let Some(guess) = guess.filter(|_| newton.linear.multiplies())
            && let Some(rows) = self.corrected(guess)?
        {
            return Ok(Some(rows));
        }
        let newton = &mut self.newton;
        let mut rows = vec![0.0; newton.equations.layout().size()];
        if let Some(last) = rows.last_mut() {
            *last = 1.0;
        }
        let solved = newton.solve_linear(&mut rows, TANGENT[usize::from(nearby)])?;
        Ok(solved.then_some(rows))
    }

    /// The same where the equations are linearised, by iteration from a guess; none if that does
    /// not lead there.
    fn corrected(&mut self, guess: &[f64]) -> Result<Option<Vec<f64>>> {
        let newton = &mut self.newton;
        let scales = newton.equations.column_scale();
        let scaled = guess.iter().zip(scales).map(|(x, scale)| x / scale);
        let mut rows: Vec<f64> = scaled.collect();
        let mut rest = vec![0.0; rows.len()];
        let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut expected = self.added;
        for _ in 0..MOST_ADDED {
            newton.linear.product(&newton.equations, &rows, &mut rest);
            rest.iter_mut().for_each(|x| *x = -*x);
            // Any length serves.
            if let Some(last) = rest.last_mut() {
                *last = 0.0;
            }
            let accuracy = (ENOUGH / expected).clamp(ADDED[0], ADDED[1]);
            if !newton.solve_linear(&mut rest, accuracy)? {
                return Ok(None);
            }
            rows.iter_mut().zip(&rest).for_each(|(x, add)| *x += add);
            // Written so that NaN is not enough.
            let added = size(&rest) / size(&rows);
            if expected == self.added {
                self.added = added;
            }
            expected = accuracy * added;
            if expected <= ENOUGH {
                return Ok(Some(rows));
            }
            if added.is_nan() {
                return Ok(None);
            }
        }
        Ok(None)
    }

    /// The tangent at a solution, along the one `before` if there is one, from a guess; none if the
    /// equations are singular.
    pub fn tangent(
        &mut self,
        state: &GridState,
        before: Option<&[f64]>,
        guess: Option<&[f64]>,
    ) -> Result<Option<Vec<f64>>> {
        let near = std::mem::take(&mut self.near);
        let with_present_factors = match near {
            true => self.direction(state, true, guess)?,
            false => None,
        };
        let found = match with_present_factors {
            Some(rows) => Some(rows),
            None => self.direction(state, false, guess)?,
        };
        let Some(rows) = found else {
            return Ok(None);
        };
        let mut tangent = self.newton.equations.unscaled(&rows, 1.0);
        let mut length = self.inner(&tangent, &tangent).sqrt();
        if before.is_some_and(|before| self.inner(&tangent, before) < 0.0) {
            length = -length;
        }
        tangent.iter_mut().for_each(|x| *x /= length);
        Ok(tangent.iter().all(|x| x.is_finite()).then_some(tangent))
    }
}
