//! Numbers of several matrices side by side: one operation works on all of them.

use nalgebra::{Complex, ComplexField};

/// Matrices that are worked on together.
pub(super) const LANES: usize = 4;

/// A number that dense kernels know.
pub(super) trait Number:
    ComplexField<RealField = f64> + faer::traits::ComplexField + Copy + Default + Send + Sync
{
    /// The same in single precision.
    type Single: Copy + Send + Sync + std::fmt::Debug;

    /// Rounded.
    fn single(self) -> Self::Single;
    fn double(single: Self::Single) -> Self;

    /// `y −= a x`.
    #[inline(always)]
    fn subtract_product(y: &mut [Self], a: &[Self::Single], x: Self) {
        for (y, a) in y.iter_mut().zip(a) {
            *y -= Self::double(*a) * x;
        }
    }
}

impl Number for f64 {
    type Single = f32;

    #[inline(always)]
    fn single(self) -> f32 {
        self as f32
    }

    #[inline(always)]
    fn double(single: f32) -> f64 {
        f64::from(single)
    }
}

impl Number for Complex<f64> {
    type Single = Complex<f32>;

    #[inline(always)]
    fn single(self) -> Complex<f32> {
        Complex::new(self.re as f32, self.im as f32)
    }

    #[inline(always)]
    fn double(single: Complex<f32>) -> Complex<f64> {
        Complex::new(f64::from(single.re), f64::from(single.im))
    }
}

/// One entry of each of [`LANES`] matrices.
pub(super) trait Lanes: Copy + Send + Sync {
    /// The number itself.
    type Number: Number;

    fn zero() -> Self;
    fn one() -> Self;
    fn get(&self, lane: usize) -> Self::Number;
    fn set(&mut self, lane: usize, value: Self::Number);
    /// `self += a b`.
    fn add_product(&mut self, a: &Self, b: &Self);
    /// `self −= a b`.
    fn subtract_product(&mut self, a: &Self, b: &Self);
    /// Squares of their sizes.
    fn squares(&self) -> [f64; LANES];
    /// One over each.
    fn reciprocal(&self) -> Self;
}

/// Real ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct RealLanes([f64; LANES]);

/// Complex ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct ComplexLanes {
    re: [f64; LANES],
    im: [f64; LANES],
}

impl ComplexLanes {
    /// Adds a number to each.
    #[inline(always)]
    pub fn add(&mut self, value: impl Fn(usize) -> Complex<f64>) {
        for lane in 0..LANES {
            let value = value(lane);
            self.re[lane] += value.re;
            self.im[lane] += value.im;
        }
    }
}

impl RealLanes {
    /// Adds to one of the numbers.
    #[inline(always)]
    pub fn add_to(&mut self, lane: usize, value: f64) {
        self.0[lane] += value;
    }
}

impl Lanes for RealLanes {
    type Number = f64;

    #[inline(always)]
    fn zero() -> Self {
        RealLanes([0.0; LANES])
    }

    #[inline(always)]
    fn one() -> Self {
        RealLanes([1.0; LANES])
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, value: f64) {
        self.0[lane] = value;
    }

    #[inline(always)]
    fn add_product(&mut self, a: &Self, b: &Self) {
        for i in 0..LANES {
            self.0[i] += a.0[i] * b.0[i];
        }
    }

    #[inline(always)]
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        for i in 0..LANES {
            self.0[i] -= a.0[i] * b.0[i];
        }
    }

    #[inline(always)]
    fn squares(&self) -> [f64; LANES] {
        self.0.map(|x| x * x)
    }

    #[inline(always)]
    fn reciprocal(&self) -> Self {
        RealLanes(self.0.map(f64::recip))
    }
}

impl Lanes for ComplexLanes {
    type Number = Complex<f64>;

    #[inline(always)]
    fn zero() -> Self {
        ComplexLanes {
            re: [0.0; LANES],
            im: [0.0; LANES],
        }
    }

    #[inline(always)]
    fn one() -> Self {
        ComplexLanes {
            re: [1.0; LANES],
            im: [0.0; LANES],
        }
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Complex<f64> {
        Complex::new(self.re[lane], self.im[lane])
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, value: Complex<f64>) {
        self.re[lane] = value.re;
        self.im[lane] = value.im;
    }

    #[inline(always)]
    fn add_product(&mut self, a: &Self, b: &Self) {
        for i in 0..LANES {
            self.re[i] += a.re[i] * b.re[i] - a.im[i] * b.im[i];
            self.im[i] += a.re[i] * b.im[i] + a.im[i] * b.re[i];
        }
    }

    #[inline(always)]
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        for i in 0..LANES {
            self.re[i] -= a.re[i] * b.re[i] - a.im[i] * b.im[i];
            self.im[i] -= a.re[i] * b.im[i] + a.im[i] * b.re[i];
        }
    }

    #[inline(always)]
    fn squares(&self) -> [f64; LANES] {
        std::array::from_fn(|i| self.re[i] * self.re[i] + self.im[i] * self.im[i])
    }

    #[inline(always)]
    fn reciprocal(&self) -> Self {
        let squares = self.squares();
        ComplexLanes {
            re: std::array::from_fn(|i| self.re[i] / squares[i]),
            im: std::array::from_fn(|i| -self.im[i] / squares[i]),
        }
    }
}
