//! Folds under conditions, as a scalar equation (docs/theory.md, section 13.7): the equations of
//! the grid are singular all along such a branch, those with its conditions at folds alone.
//!
//! ```text
//! σ = det [t₁ₚ t₂ₚ; t₁ᵩ t₂ᵩ]
//! ```
//!
//! with the parts along the parameter of the branch, and along the second one, of the directions in
//! which solutions go on; of one direction, its part along the parameter.

use super::singular::STEP;
use super::walk::Walk;
use crate::collocation::{Collocation, GridState, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;

/// Accuracy of linear solves.
const ACCURACY: f64 = 1e-9;

/// `σ` where the equations were linearised last, and what its derivatives are made of.
pub(super) struct Turning {
    /// With the conditions.
    equations: Collocation,
    /// For products at other states.
    tangent: Tangent,
    /// Directions of all solutions there.
    directions: Vec<Vec<f64>>,
}

impl Turning {
    pub fn new(equations: &Collocation) -> Self {
        Turning {
            tangent: Tangent::new(equations.system(), equations.grid().points()),
            equations: equations.clone(),
            directions: Vec::new(),
        }
    }

    /// `σ` of these directions, along which the equations of `walk` are linearised.
    pub fn value(&mut self, walk: &Walk, directions: &[Vec<f64>]) -> f64 {
        self.equations = walk.newton.equations.clone();
        self.equations.ground(0.0);
        self.directions = directions.to_vec();
        determinant(walk, directions)
    }

    /// Derivative of `σ` in a direction of all unknowns, not scaled and of the length `size`.
    ///
    /// ```text
    /// G' t = 0   ⇒   G' δt = −(δG') t
    /// ```
    ///
    /// None if that cannot be solved.
    pub fn along(
        &mut self,
        walk: &mut Walk,
        state: &GridState,
        (direction, size): (&[f64], f64),
    ) -> Result<Option<f64>> {
        if size == 0.0 {
            return Ok(Some(0.0));
        }
        let step = STEP / size;
        let system = self.equations.system().clone();
        let mut rests = vec![vec![0.0; direction.len()]; self.directions.len()];
        for sign in [1.0, -1.0] {
            let beside = state.incremented(&system, direction, sign * step);
            self.add_products(&beside, sign / (2.0 * step), &mut rests)?;
        }
        let mut change = 0.0;
        for (i, mut rest) in rests.into_iter().enumerate() {
            // Parts along the directions themselves stay.
            let conditions = rest.len() - self.directions.len();
            rest[conditions..].fill(0.0);
            if !walk.newton.solve_linear(&mut rest, ACCURACY)? {
                return Ok(None);
            }
            let mut changed = self.directions.clone();
            changed[i] = walk.newton.equations.unscaled(&rest, -1.0);
            change += determinant(walk, &changed);
        }
        Ok(Some(change))
    }

    /// Adds multiples of the products of the equations linearised at another state, with their
    /// conditions, and the directions.
    fn add_products(
        &mut self,
        state: &GridState,
        factor: f64,
        sums: &mut [Vec<f64>],
    ) -> Result<()> {
        let equations = &mut self.equations;
        let mut borders = Borders::at(equations, state)?;
        self.tangent.evaluate(equations, state)?;
        borders.complete(equations, state, &mut self.tangent);
        let (size, all) = (equations.size(), equations.layout().size());
        let mut product = vec![0.0; all];
        for (direction, sum) in self.directions.iter().zip(sums) {
            let scales = equations.column_scale().iter();
            let scaled: Vec<f64> = direction.iter().zip(scales).map(|(x, s)| x / s).collect();
            let of_grid = &mut product[..size];
            self.tangent.apply(equations, &scaled[..size], of_grid);
            borders.product(&scaled, &mut product);
            let pairs = sum.iter_mut().zip(&product);
            pairs.for_each(|(sum, x)| *sum += factor * x);
        }
        Ok(())
    }
}

/// Of parts along the last parameters, over their scales; as many as there are directions.
fn determinant(walk: &Walk, directions: &[Vec<f64>]) -> f64 {
    let part = |direction: &[f64], back: usize| {
        let (unknown, scalar) = (direction.len() - back, walk.scales.len() - back);
        direction[unknown] / walk.scales[scalar]
    };
    match directions {
        [one] => part(one, 1),
        [first, second] => part(first, 2) * part(second, 1) - part(first, 1) * part(second, 2),
        _ => f64::NAN,
    }
}
