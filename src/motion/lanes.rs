//! Numbers side by side in the vector registers that the processor has, found at run time.

use super::scalar::Scalar;
use faer::traits::pulp::{Arch, Simd, WithSimd};
use std::ops::{Add, Mul, Neg, Sub};

/// Work, and what the compiler makes of it for each kind of register.
struct Vectorised<F>(F);

impl<R, F: FnMut() -> R> WithSimd for Vectorised<F> {
    type Output = R;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) -> R {
        (self.0)()
    }
}

/// Does what is inlined into `work`, a closure that is to be `#[inline(always)]`, by the vector
/// registers that the processor has. As one that may be called again, as others are not inlined.
///
/// Of skew matrices, whose zeros are known, compilers make instructions that valgrind 3.19 does not
/// know: tests find out.
pub fn vectorised<R>(work: impl FnMut() -> R) -> R {
    Arch::new().dispatch(Vectorised(work))
}

/// As many numbers as a register of `S` holds.
#[derive(Debug, Clone, Copy)]
pub struct Lanes<S: Simd> {
    simd: S,
    numbers: S::f64s,
}

impl<S: Simd> Lanes<S> {
    /// The same number in all lanes.
    #[inline(always)]
    pub fn splat(simd: S, number: f64) -> Self {
        let numbers = simd.splat_f64s(number);
        Lanes { simd, numbers }
    }

    /// The first numbers of a slice; zeros behind its end.
    #[inline(always)]
    pub fn load(simd: S, from: &[f64]) -> Self {
        let numbers = match S::as_simd_f64s(from).0.first() {
            Some(numbers) => *numbers,
            None => simd.partial_load_f64s(from),
        };
        Lanes { simd, numbers }
    }

    /// Writes the first numbers of a slice, as many as it has room for.
    #[inline(always)]
    pub fn store(self, to: &mut [f64]) {
        match S::as_mut_simd_f64s(to).0.first_mut() {
            Some(to) => *to = self.numbers,
            None => self.simd.partial_store_f64s(to, self.numbers),
        }
    }

    /// Adds to the first numbers of a slice, as many as it has room for.
    #[inline(always)]
    pub fn add_to(self, to: &mut [f64]) {
        (Self::load(self.simd, to) + self).store(to);
    }
}

impl<S: Simd> Scalar for Lanes<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        let simd = self.simd;
        let numbers = simd.mul_add_e_f64s(a.numbers, b.numbers, self.numbers);
        Lanes { simd, numbers }
    }
}

macro_rules! operation {
    ($operation:ident, $name:ident, $of_numbers:ident) => {
        impl<S: Simd> $operation for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let simd = self.simd;
                let numbers = simd.$of_numbers(self.numbers, other.numbers);
                Lanes { simd, numbers }
            }
        }
    };
}
operation!(Add, add, add_f64s);
operation!(Sub, sub, sub_f64s);
operation!(Mul, mul, mul_f64s);

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let simd = self.simd;
        let numbers = simd.neg_f64s(self.numbers);
        Lanes { simd, numbers }
    }
}
