//! Stretching between grid points.
//!
//! Slender beams that bend from one grid point to the next are stretched in between, by terms of
//! second order, and what axial stiffness makes of that is much larger than all else that is left
//! of the equations there. Tiny motions along the beams undo it. At the grid points, where the
//! beams lie otherwise, the same forces would bend them; so it is stress resultants that are
//! carried there.

use super::between::{Defect, PART};
use super::like_blades::Leaders;
use super::problem::Collocation;
use crate::error::Result;
use crate::fourier::Resampling;

impl Defect {
    /// Lets what stress resultants are more than those interpolated act on the beams as they are at
    /// the grid points before, for which `equations` have the kinematics; if blades move alike in
    /// their state, from those of what leads.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn carry_resultants(
        &mut self,
        equations: &mut Collocation,
        leaders: Option<&Leaders>,
    ) -> Result<()> {
        let grid = equations.grid();
        let between = Resampling::new(grid, PART / grid.points() as f64, grid.points());
        let interpolated = equations.resampled_resultants(between, leaders)?;
        if interpolated.is_empty() {
            return Ok(());
        }
        let rows = (&mut self.rows[..], self.count);
        let at = equations.node_states().to_vec();
        let states = [&self.nodes.states[..], &at];
        equations.move_excess(&interpolated, states, rows, leaders)?;
        self.repeat_forces(leaders);
        Ok(())
    }
}
