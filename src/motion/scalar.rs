//! What the algebra of motions is written for: a real number, or several side by side.

use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

/// A real number, or several that undergo the same operations.
pub trait Scalar:
    Copy
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// A number, of the same kind as `self`.
    fn constant(self, value: f64) -> Self;

    /// `self + a b`, rounded once where that is faster.
    fn plus_product(self, a: Self, b: Self) -> Self;

    /// `self − a b`.
    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        self.plus_product(-a, b)
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn plus_product(self, a: f64, b: f64) -> f64 {
        self + a * b
    }
}
