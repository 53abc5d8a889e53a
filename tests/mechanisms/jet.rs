//! Functions of one variable with their first and second derivatives.

use nalgebra::Vector3;
use std::ops::{Add, Mul, Neg, Sub};

/// A value with its first and second derivative.
#[derive(Debug, Clone, Copy)]
pub struct Jet(pub [f64; 3]);

impl Jet {
    pub fn variable(value: f64) -> Self {
        Jet([value, 1.0, 0.0])
    }

    pub fn constant(value: f64) -> Self {
        Jet([value, 0.0, 0.0])
    }

    /// `f(self)`, for the value and derivatives of `f` there.
    pub fn compose(self, f: [f64; 3]) -> Self {
        let [_, d, dd] = self.0;
        Jet([f[0], f[1] * d, f[2] * d * d + f[1] * dd])
    }

    pub fn sin(self) -> Self {
        let (s, c) = self.0[0].sin_cos();
        self.compose([s, c, -s])
    }

    pub fn cos(self) -> Self {
        let (s, c) = self.0[0].sin_cos();
        self.compose([c, -s, -c])
    }

    pub fn sqrt(self) -> Self {
        let root = self.0[0].sqrt();
        self.compose([root, 0.5 / root, -0.25 / (root * self.0[0])])
    }

    pub fn inverse(self) -> Self {
        let x = self.0[0];
        self.compose([1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)])
    }

    pub fn acos(self) -> Self {
        let x = self.0[0];
        let root = (1.0 - x * x).sqrt();
        self.compose([x.acos(), -1.0 / root, -x / root.powi(3)])
    }

    /// Angle of the point `(x, self)`.
    pub fn atan2(self, x: Jet) -> Self {
        let (y, [_, dy, ddy], [_, dx, ddx]) = (self.0[0], self.0, x.0);
        let x = x.0[0];
        let square = x * x + y * y;
        let first = (x * dy - y * dx) / square;
        let second = (x * ddy - y * ddx) / square - first * 2.0 * (x * dx + y * dy) / square;
        Jet([y.atan2(x), first, second])
    }
}

impl Add for Jet {
    type Output = Jet;
    fn add(self, other: Jet) -> Jet {
        Jet([0, 1, 2].map(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Jet {
    type Output = Jet;
    fn sub(self, other: Jet) -> Jet {
        self + -other
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        Jet(self.0.map(|x| -x))
    }
}

impl Mul for Jet {
    type Output = Jet;
    fn mul(self, other: Jet) -> Jet {
        let ([a, da, dda], [b, db, ddb]) = (self.0, other.0);
        Jet([a * b, da * b + a * db, dda * b + 2.0 * da * db + a * ddb])
    }
}

impl Mul<f64> for Jet {
    type Output = Jet;
    fn mul(self, factor: f64) -> Jet {
        Jet(self.0.map(|x| x * factor))
    }
}

/// A point whose coordinates depend on one variable: position and its derivatives.
#[derive(Debug, Clone, Copy)]
pub struct Point(pub [Vector3<f64>; 3]);

impl Point {
    pub fn new(x: Jet, y: Jet, z: Jet) -> Self {
        Point([0, 1, 2].map(|i| Vector3::new(x.0[i], y.0[i], z.0[i])))
    }

    /// Acceleration, for the rate and acceleration of the variable.
    pub fn acceleration(&self, rate: f64, acceleration: f64) -> Vector3<f64> {
        self.0[2] * (rate * rate) + self.0[1] * acceleration
    }
}

/// Second derivative in time of a function of a variable with this rate and acceleration.
pub fn second_rate(x: &Jet, rate: f64, acceleration: f64) -> f64 {
    x.0[2] * rate * rate + x.0[1] * acceleration
}
