//! Determinants at points of a branch (docs/theory.md, section 13.5).

use super::BranchOptions;
use crate::collocation::{Collocation, GridState, TimeRule};
use crate::error::Result;
use crate::solve::linear::assembled::Assembled;

/// Determinants at points of a branch.
pub(super) struct Determinants {
    equations: Collocation,
    linear: Assembled,
}

impl Determinants {
    /// Of equations like these, if they are wanted.
    pub fn wanted(options: &BranchOptions, equations: &Collocation) -> Option<Self> {
        options.events.then(|| Determinants {
            linear: Assembled::new(equations),
            equations: equations.clone(),
        })
    }

    /// The equations.
    pub fn equations(&mut self) -> &mut Collocation {
        &mut self.equations
    }

    /// Sign, and logarithm of the size, of the determinant with increments that follow a rule; none
    /// if it is singular.
    pub fn with(
        &mut self,
        rule: Box<dyn TimeRule>,
        state: &GridState,
    ) -> Result<Option<(f64, f64)>> {
        self.equations.set_rule(rule);
        self.linear.assemble(&mut self.equations, state)?;
        // Of the whole: its sign is to mean the same at all points.
        let regular = self.linear.factor_all(&self.equations)?;
        Ok(regular.then(|| self.linear.determinant()))
    }
}
