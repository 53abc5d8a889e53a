//! Whether scalar equations determine scalar unknowns, as factors of all of them tell
//! (docs/theory.md, section 8.8).

use super::Bordered;
use crate::collocation::{Collocation, GridState};
use crate::error::Result;
use crate::solve::linear::borders::NO_PIVOT;
use crate::solve::linear::dense::largest;
use crate::solve::linear::solver::{LinearSolver, Side};
use crate::solve::report::Timings;

/// What is added to a scalar equation of its unknown, relative to both, to find what is
/// undetermined, and the part of an equation that this then is.
const LITTLE: f64 = 1e-10;
const ALL: f64 = 1e-2;

impl<L: LinearSolver> Bordered<L> {
    /// Whether each of the scalar equations feels something of the unknowns, as factors with
    /// borders tell: what meets one alone is then no small difference of large terms.
    pub(super) fn are_felt(&mut self, equations: &Collocation) -> bool {
        let motions = equations.layout().motions().end;
        let (size, timings) = (equations.size(), &mut Timings::default());
        let largest_of = |x: &[f64]| [0..motions, motions..size].map(|part| largest(&x[part]));
        let (inner, borders) = (&mut self.inner, &self.borders);
        borders.rows.iter().enumerate().all(|(i, row)| {
            let mut found = vec![0.0; row.len()];
            found[size + i] = 1.0;
            let solved = inner.substitute_bordered(&mut found, Side::Plain, timings);
            let (felt, moved) = (largest_of(row), largest_of(&found));
            let own = row[size..].iter().zip(&found[size..]);
            let own: f64 = own.map(|(d, p)| (d * p).abs()).sum();
            let most = felt[0] * moved[0] + felt[1] * moved[1] + own;
            // Written so that NaN is not felt.
            solved == Some(true) && most * NO_PIVOT <= 1.0
        })
    }

    /// The scalar equation and the scalar unknown that the whole leaves undetermined, if there are
    /// any: with a little of each unknown added to the equation of its number, they are those of
    /// which that little makes all there is.
    pub(super) fn undetermined(
        &mut self,
        equations: &mut Collocation,
        state: &GridState,
    ) -> Result<Option<[usize; 2]>> {
        let (size, timings) = (equations.size(), &mut Timings::default());
        let mut softened = self.borders.clone();
        let count = softened.count();
        let little: Vec<f64> = (0..count).map(|i| LITTLE * softened.size_of(i)).collect();
        for (i, row) in softened.rows.iter_mut().enumerate() {
            row[size + i] += little[i];
        }
        let inner = &mut self.inner;
        let factored = inner.linearise_bordered(equations, state, &mut softened, timings)?;
        if factored != Some(true) {
            return Ok(None);
        }
        let mut most = (ALL, None);
        for equation in 0..count {
            let mut found = vec![0.0; size + count];
            found[size + equation] = 1.0;
            inner.substitute_bordered(&mut found, Side::Plain, timings);
            for unknown in 0..count {
                let part = (little[unknown] * found[size + unknown]).abs();
                if part >= most.0 {
                    most = (part, Some([equation, unknown]));
                }
            }
        }
        Ok(most.1)
    }
}
