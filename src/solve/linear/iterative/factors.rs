//! Preconditioners, factored.

use super::body_circulant::BodyCirculant;
use super::constraints::Joints;
use super::interface::Bounds;
use super::time_local::TimeLocal;
use super::{Iterative, Preconditioner};
use crate::collocation::{Collocation, Tangent};
use crate::error::Result;

/// Size of the unknowns of stress resultants relative to the others: what matters are these.
const RESULTANT_SHARE: f64 = 0.03;
/// Multiply-adds of the system of the joints, for each unknown, that are little beside the products
/// of a solve.
const CHEAP: f64 = 2000.0;

/// What the Jacobian is approximated by, factored.
pub(super) enum Factors {
    Body(Box<BodyCirculant>),
    Local(Box<TimeLocal>),
}

impl Factors {
    /// Those of a kind, for the Jacobian or its transpose; none if they cannot be had.
    ///
    /// # Errors
    /// If memory runs out.
    pub fn new(
        equations: &Collocation,
        tangent: &Tangent,
        preconditioner: Preconditioner,
        (bounds, transposed): (Bounds, bool),
    ) -> Result<Option<Self>> {
        let circulant = |joints: Joints| -> Result<Option<Self>> {
            let factors = BodyCirculant::new(equations, tangent, joints, (bounds, transposed))?;
            Ok(factors.map(|f| Factors::Body(Box::new(f))))
        };
        match preconditioner {
            Preconditioner::BodyCirculant => circulant(Joints::Exact),
            Preconditioner::Circulant => circulant(Joints::Averaged),
            Preconditioner::TimeLocal => {
                let Some(mut factors) = TimeLocal::new(equations, tangent, transposed) else {
                    return Ok(None);
                };
                let mapped = !equations.grid().map().is_identity();
                if mapped && !transposed {
                    factors = factors.with_soft_motions(equations, tangent)?;
                }
                Ok(Some(Factors::Local(Box::new(factors))))
            }
        }
    }

    /// `x = P⁻¹ x`, for the first `size` of the unknowns, and for stress resultants behind them.
    pub fn apply(&mut self, x: &mut [f64], size: usize) {
        let (x, resultants) = x.split_at_mut(size);
        match self {
            Factors::Body(factors) => factors.apply(x, resultants),
            Factors::Local(factors) => factors.apply(x),
        }
    }

    /// Whether new ones take little beside a solve.
    pub fn are_cheap(&self, unknowns: usize) -> bool {
        match self {
            Factors::Body(factors) => factors.interface_work() < CHEAP * unknowns as f64,
            Factors::Local(_) => false,
        }
    }

    /// Gives unknowns of stress resultants a size that goes with that of the others, for a right
    /// side of `size` entries and zeros behind them.
    pub fn scale_resultants(&mut self, tangent: &mut Tangent, rhs: &[f64], size: usize) {
        let Factors::Body(factors) = self else {
            return;
        };
        let mut first = rhs.to_vec();
        let (x, resultants) = first.split_at_mut(size);
        factors.apply(x, resultants);
        let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let scale = norm(resultants) / (RESULTANT_SHARE * norm(x));
        if scale.is_finite() && scale > 0.0 {
            factors.resultants.scale = scale;
            tangent.set_resultant_scale(scale);
        }
    }

    /// The same where it is known.
    pub fn set_resultant_scale(&mut self, scale: f64) {
        if let Factors::Body(factors) = self {
            factors.resultants.scale = scale;
        }
    }

    pub fn bytes(&self) -> usize {
        match self {
            Factors::Body(factors) => factors.bytes(),
            Factors::Local(factors) => factors.bytes(),
        }
    }
}

impl Iterative {
    /// About what the equations respond to a right side: that of the preconditioner, in place.
    /// `false` if there is none.
    pub fn respond(&mut self, size: usize, rhs: &mut [f64]) -> bool {
        match &mut self.factors {
            Some(factors) => {
                factors.apply(rhs, size);
                true
            }
            None => false,
        }
    }
}
