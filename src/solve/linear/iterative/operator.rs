//! The linearised equations as what GMRES multiplies with, between borders if there are any
//! (docs/theory.md, section 8.8).

use super::ROUGH;
use super::factors::Factors;
use super::first_part::FirstPart;
use super::gmres::{GmresEnd, Preconditioned};
use super::learnt::Learnt;
use crate::collocation::{Collocation, Tangent};
use crate::solve::linear::borders::Borders;
use crate::work::PRODUCT;
use nalgebra::DMatrix;

/// What is enough beside multipliers that have no effect, of which rounding leaves more than
/// [`ROUGH`].
const ROUGH_BESIDE_MULTIPLIERS: f64 = 0.1;

/// What GMRES multiplies with, and its preconditioner.
pub(super) struct Operator<'a> {
    pub equations: &'a Collocation,
    pub tangent: &'a mut Tangent,
    pub factors: &'a mut Factors,
    /// What vectors have of one blade of several.
    pub first_part: Option<&'a mut FirstPart>,
    /// With these, and what the factors make of them.
    pub borders: Option<(&'a Borders, &'a Eliminated)>,
    /// What solves before have found of this.
    pub learnt: Option<&'a Learnt>,
}

impl Operator<'_> {
    /// `P⁻¹ y`.
    fn precondition_alone(&mut self, y: &mut [f64]) {
        let size = self.equations.size();
        if let Some(first_part) = &mut self.first_part {
            let (equations, factors) = (self.equations, &mut *self.factors);
            first_part.precondition(equations, y, |all| {
                factors.apply(all, size);
                equations.project(all);
            });
            return;
        }
        let Some((borders, eliminated)) = self.borders else {
            self.factors.apply(y, size);
            return;
        };
        let end = y.len() - borders.count();
        self.factors.apply(&mut y[..end], size);
        borders.substitute_with(&eliminated.columns, &eliminated.inverse, y);
    }
}

impl Preconditioned for Operator<'_> {
    fn product(&mut self, x: &[f64], y: &mut [f64]) {
        let numbers = self.equations.layout().motions().len() as f64;
        self.equations.workers().work().spend(PRODUCT * numbers);
        if let Some(first_part) = &mut self.first_part {
            let (equations, tangent) = (self.equations, &mut *self.tangent);
            first_part.product(equations, x, y, |x, y| {
                tangent.apply(equations, x, y);
                equations.average(y);
            });
            return;
        }
        let Some((borders, _)) = self.borders else {
            self.tangent.apply(self.equations, x, y);
            return;
        };
        let end = x.len() - borders.count();
        self.tangent.apply(self.equations, &x[..end], &mut y[..end]);
        // What only makes factors exist is no part of the whole.
        self.equations.subtract_ground(x, y);
        borders.product(x, y);
    }

    fn precondition(&mut self, y: &mut [f64]) {
        self.precondition_alone(y);
        if let Some(learnt) = self.learnt {
            learnt.apply(y, self.equations.workers());
        }
    }
}

/// What factors make of borders.
pub(super) struct Eliminated {
    /// `P⁻¹ B`, with stress resultants.
    columns: Vec<Vec<f64>>,
    /// `(D − C P⁻¹ B)⁻¹`.
    inverse: DMatrix<f64>,
}

impl Eliminated {
    /// For vectors with so many unknowns that are no scalars; none if that is singular.
    pub fn new(borders: &Borders, factors: &mut Factors, unknowns: usize) -> Option<Self> {
        let mut columns = borders.columns.clone();
        for column in &mut columns {
            let size = column.len();
            column.resize(unknowns, 0.0);
            factors.apply(column, size);
        }
        let inverse = borders.complement(&columns).try_inverse()?;
        let finite = inverse.iter().all(|x| x.is_finite());
        finite.then_some(Eliminated { columns, inverse })
    }
}

/// Whether an iteration has ended with a solution to this accuracy, or one that is good enough for
/// Newton's method to go on where rounding allows no more: of a right side that is rounding, or
/// beside multipliers that have no effect.
pub(super) fn is_solved(end: &GmresEnd, accuracy: f64, equations: &Collocation) -> bool {
    let enough = match equations.is_regularised() {
        true => ROUGH_BESIDE_MULTIPLIERS,
        false => ROUGH,
    };
    end.error <= accuracy || end.stagnated && end.error <= enough
}
