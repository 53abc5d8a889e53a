//! How far Newton's method goes on grids that may not be the last (docs/theory.md, section 10.4).

use super::Periodic;
use super::adaptive::Adaptation;
use crate::collocation::GridState;
use crate::error::Result;
use crate::solve::newton::on_grid::Found;

/// Newton's method goes on to this part of the tolerance there: what its last increment leaves is
/// far less, and no harmonic that tells of errors.
const ON_THE_WAY: f64 = 0.01;

impl Periodic<'_> {
    /// Solves on ever finer grids, from a given state or the library's own start.
    pub(super) fn refine(
        &mut self,
        adaptation: &Adaptation,
        start: Option<GridState>,
    ) -> Result<Found> {
        let found = self.refine_roughly(adaptation, start);
        let tolerance = &mut self.on.means.newton.tolerance;
        let is_rough = *tolerance > self.tolerance;
        *tolerance = self.tolerance;
        let (state, report) = found?;
        match is_rough && report.outcome.is_solution() {
            true => self.complete((state, report)),
            false => Ok((state, report)),
        }
    }

    /// From now on, on the way to motions with this error. Where blades are alike all others are
    /// looked at after each solve, and it goes on to its end.
    pub(super) fn go_roughly(&mut self, error_tolerance: f64) {
        if self.on.system.symmetry().is_none() {
            let enough = ON_THE_WAY * error_tolerance;
            self.on.means.newton.tolerance = self.tolerance.max(enough);
        }
    }

    /// The solution on the last grid, as accurately as asked for.
    fn complete(&mut self, (state, report): Found) -> Result<Found> {
        let before = report.iterations.len();
        // What was found is not to be lost for the work that others took.
        self.on.newton.equations.workers().work().take_back(0.0);
        let (mut state, report) = self.on.complete((state, report))?;
        if let Some(last) = self.grids.last_mut() {
            last.iterations += report.iterations.len() - before;
        }
        let newton = &mut self.on.newton;
        if newton.equations.oversampled().is_none() {
            newton.update_kinematics(&state);
            newton.equations.reduce_to_least_norm(&mut state)?;
        }
        Ok((state, report))
    }
}
