//! A step along a branch.

use super::{Condition, InnerProduct};
use crate::collocation::{Collocation, GridState};
use crate::error::Result;

/// The solution is this far along a tangent: `⟨t, x − x₀⟩ = σ`.
#[derive(Debug)]
pub(crate) struct ArcLength {
    /// Where the step begins.
    pub from: GridState,
    /// Not scaled: of motions, own unknowns, which do not count, and free parameters.
    pub tangent: Vec<f64>,
    pub product: InnerProduct,
    /// What counts as 1 in each of the free parameters.
    pub scales: Vec<f64>,
    /// `σ`.
    pub length: f64,
}

impl Condition for ArcLength {
    fn name(&self) -> String {
        "the arc length".into()
    }

    fn scale(&self, _: &Collocation) -> f64 {
        1.0
    }

    fn value(&self, equations: &Collocation, state: &GridState) -> Result<f64> {
        let layout = equations.layout();
        let (from, tangent) = (&self.from, &self.tangent);
        let motions = self.product.along(layout, tangent, from, state);
        let moved = state.scalars.iter().zip(&from.scalars);
        let weighted = tangent[layout.scalars()].iter().zip(&self.scales);
        let parameters = moved
            .zip(weighted)
            .map(|((now, then), (t, scale))| t * (now - then) / (scale * scale));
        Ok(motions + parameters.sum::<f64>() - self.length)
    }

    fn gradient(&self, equations: &Collocation, state: &GridState, row: &mut [f64]) -> Result<()> {
        let layout = equations.layout();
        let states = (&self.from, state);
        let (motions, _) = row.split_at_mut(layout.motions().end);
        self.product
            .add_gradient(layout, &self.tangent, states, motions);
        let scalars = layout.scalars();
        let weighted = self.tangent[scalars.clone()].iter().zip(&self.scales);
        for (x, (t, scale)) in row[scalars].iter_mut().zip(weighted) {
            *x += t / (scale * scale);
        }
        Ok(())
    }
}
