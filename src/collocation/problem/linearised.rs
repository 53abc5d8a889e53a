//! What a linearisation finds left of the equations where it is made.

use super::Collocation;
use crate::collocation::state::GridState;
use crate::error::Result;

impl Collocation {
    /// Forgets what the last linearisation found left of the equations.
    pub(crate) fn forget_linearised_residual(&mut self) {
        self.linearised_residual.clear();
    }

    /// Writes the scaled residual at `state`, where the equations were linearised since.
    pub(crate) fn residual_where_linearised(
        &mut self,
        state: &GridState,
        out: &mut [f64],
    ) -> Result<()> {
        // Sampled elsewhere, or linearised by what does not say what is left.
        let is_known = self.linearised_residual.len() == self.size();
        if self.oversampled.is_some() || !is_known {
            return self.residual(state, out);
        }
        let known = self.linearised_residual.iter().zip(&self.row_scale);
        let rows = out.iter_mut().zip(known);
        rows.for_each(|(row, (value, scale))| *row = value * scale);
        self.scalar_residual(state, out)
    }
}
