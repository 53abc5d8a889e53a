//! Factors of the Jacobians of very slender beams, and what rounding has left out of them.
//!
//! Axial stiffness that is more than some 1e8 times that in bending leaves, in a sum of both, few
//! digits to bending. Products with the Jacobian as an operator, which keeps strains apart, have
//! them all: errors along strains stay what they are. So factors of the sum serve as the
//! preconditioner of an iteration, which takes a few products. See docs/theory.md, section 8.1.

use crate::collocation::{Collocation, GridState, Tangent};
use crate::error::Result;
use crate::solve::linear::borders::Borders;
use crate::solve::linear::dense::{largest, probe};
use crate::solve::linear::iterative::{GmresOptions, GmresWorkspace, Parts, Preconditioned, gmres};

/// Axial over bending stiffness from which on rounding matters.
pub(crate) const SLENDER: f64 = 1e7;
/// Most products of a solve.
const MOST: usize = 20;
/// What a regular Jacobian's product and its factors may leave of a vector at most, and a singular
/// one at least.
const UNLIKE: f64 = 0.5;

/// The Jacobian as an operator.
pub(crate) struct Slender {
    tangent: Tangent,
    workspace: GmresWorkspace,
}

struct Operator<'a, S> {
    equations: &'a Collocation,
    tangent: &'a mut Tangent,
    borders: Option<&'a Borders>,
    substitute: S,
}

impl<S: FnMut(&mut [f64]) -> bool> Preconditioned for Operator<'_, S> {
    fn product(&mut self, x: &[f64], y: &mut [f64]) {
        apply((self.equations, self.borders), self.tangent, x, y);
    }

    fn precondition(&mut self, y: &mut [f64]) {
        if !(self.substitute)(y) {
            y.fill(f64::NAN);
        }
    }
}

/// Writes the product of the equations, between borders if there are any, and `x`.
fn apply(
    (equations, borders): (&Collocation, Option<&Borders>),
    tangent: &mut Tangent,
    x: &[f64],
    y: &mut [f64],
) {
    let size = equations.size();
    tangent.apply(equations, &x[..size], &mut y[..size]);
    if let Some(borders) = borders {
        borders.product(x, y);
    }
}

impl Slender {
    /// For `equations`, if they have beams so slender.
    pub fn new(equations: &Collocation) -> Option<Self> {
        let (system, points) = (equations.system(), equations.grid().points());
        // In steps of marches, rates of internal states are not the operator's.
        let has_states = system.elements().iter().any(|placed| placed.has_states);
        let fits = system.slenderness() > SLENDER && !(points == 1 && has_states);
        fits.then(|| Slender {
            tangent: Tangent::with_resultants_apart(system, points),
            workspace: GmresWorkspace::default(),
        })
    }

    /// Evaluates the operator at `state`.
    pub fn linearise(&mut self, equations: &mut Collocation, state: &GridState) -> Result<()> {
        self.tangent.evaluate(equations, state)
    }

    /// Solves in place to the accuracy that is asked for, with the factors by which `substitute`
    /// does, of the equations, between borders if there are any; `false` if that cannot be done.
    pub fn solve(
        &mut self,
        (equations, borders): (&Collocation, Option<&Borders>),
        rhs: &mut [f64],
        accuracy: f64,
        substitute: impl FnMut(&mut [f64]) -> bool,
    ) -> bool {
        let options = GmresOptions {
            tolerance: accuracy,
            leading: equations.layout().motions().end,
            essential: rhs.len(),
            parts: Parts::AsTheyAre,
            iteration_limit: MOST,
            restart: MOST,
            is_verified: true,
        };
        let mut operator = Operator {
            equations,
            tangent: &mut self.tangent,
            borders,
            substitute,
        };
        let workers = equations.workers();
        let end = gmres(&mut operator, rhs, &options, workers, &mut self.workspace);
        // Written so that NaN fails too. Without memory for it, refinement does.
        end.is_ok_and(|end| end.error <= accuracy)
    }

    /// Whether the Jacobian resists the motion that its factors, by which `substitute` solves, find
    /// the softest.
    pub fn is_resisted(
        &mut self,
        (equations, borders): (&Collocation, Option<&Borders>),
        mut substitute: impl FnMut(&mut [f64]) -> bool,
    ) -> bool {
        let count = borders.map_or(0, Borders::count);
        let mut softest = probe(equations.size() + count);
        let mut found = vec![0.0; softest.len()];
        if !substitute(&mut softest) {
            return false;
        }
        let whole = (equations, borders);
        apply(whole, &mut self.tangent, &softest, &mut found);
        if !substitute(&mut found) {
            return false;
        }
        found.iter_mut().zip(&softest).for_each(|(f, s)| *f -= s);
        largest(&found) <= UNLIKE * largest(&softest)
    }
}
