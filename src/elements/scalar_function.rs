//! Scalar functions of the relative motion of two frames, with their exact derivatives, and what
//! they are composed of. See docs/theory.md, section 6.8.

use crate::motion::{Motion, skew};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Motion of the second joint frame relative to the first.
pub type RelativeMotion = Motion;

/// Value, gradient and the variation of the gradient of a scalar function of the relative motion.
#[derive(Debug, Clone, Copy)]
pub struct ScalarFunction {
    /// Value.
    pub value: f64,
    /// Derivative with respect to the material increment `δz`.
    pub gradient: Vector6<f64>,
    /// `Δ gradient = hessian Δz`; not symmetric, since increments do not commute.
    pub hessian: Matrix6<f64>,
}

/// What scalar functions are composed of: values alone, or with their derivatives.
pub(super) trait Composed: Copy {
    /// Displacement `e_kᵀ r` along axis `k` of the first frame.
    fn displacement(z: &RelativeMotion, k: usize) -> Self;
    /// Direction cosine `e_aᵀ R e_b` between axis `a` of the first and axis `b` of the second
    /// frame.
    fn cosine(z: &RelativeMotion, a: usize, b: usize) -> Self;
    /// Distance `|r|` between the origins.
    fn distance(z: &RelativeMotion) -> Self;
    /// `α self + β other`.
    fn combine(&self, alpha: f64, other: &Self, beta: f64) -> Self;
    /// Angle of the point `(x, y)`, in `(−π, π]`.
    fn angle(y: &Self, x: &Self) -> Self;
    /// `√(x² + y²)`.
    fn length(x: &Self, y: &Self) -> Self;
    /// Its value.
    fn value(&mut self) -> &mut f64;
}

impl Composed for f64 {
    fn displacement(z: &RelativeMotion, k: usize) -> Self {
        z.position[k]
    }

    fn cosine(z: &RelativeMotion, a: usize, b: usize) -> Self {
        z.rotation[(a, b)]
    }

    fn distance(z: &RelativeMotion) -> Self {
        z.position.norm()
    }

    fn combine(&self, alpha: f64, other: &Self, beta: f64) -> Self {
        alpha * self + beta * other
    }

    fn angle(y: &Self, x: &Self) -> Self {
        y.atan2(*x)
    }

    fn length(x: &Self, y: &Self) -> Self {
        x.hypot(*y).max(f64::MIN_POSITIVE.sqrt())
    }

    fn value(&mut self) -> &mut f64 {
        self
    }
}

impl ScalarFunction {
    fn constant(value: f64) -> Self {
        ScalarFunction {
            value,
            gradient: Vector6::zeros(),
            hessian: Matrix6::zeros(),
        }
    }

    /// Product of two functions.
    pub(super) fn times(&self, other: &Self) -> Self {
        ScalarFunction {
            value: self.value * other.value,
            gradient: self.gradient * other.value + other.gradient * self.value,
            hessian: self.hessian * other.value
                + other.hessian * self.value
                + self.gradient * other.gradient.transpose()
                + other.gradient * self.gradient.transpose(),
        }
    }

    /// A function of this one, by its value and its first and second derivative.
    pub(super) fn mapped(&self, [value, slope, bend]: [f64; 3]) -> Self {
        ScalarFunction {
            value,
            gradient: self.gradient * slope,
            hessian: self.hessian * slope + self.gradient * self.gradient.transpose() * bend,
        }
    }
}

impl Composed for ScalarFunction {
    fn displacement(z: &RelativeMotion, k: usize) -> Self {
        let row = z.rotation.row(k).transpose();
        let mut function = Self::constant(z.position[k]);
        function.gradient.fixed_rows_mut::<3>(0).copy_from(&row);
        function
            .hessian
            .fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&skew(&row));
        function
    }

    fn cosine(z: &RelativeMotion, a: usize, b: usize) -> Self {
        let row: Vector3<f64> = z.rotation.row(a).transpose();
        let mut function = Self::constant(z.rotation[(a, b)]);
        // ẽ_b row, and ẽ_b row~ = row e_bᵀ − (e_bᵀ row) I.
        let (c, d) = ((b + 1) % 3, (b + 2) % 3);
        function.gradient[3 + c] = -row[d];
        function.gradient[3 + d] = row[c];
        let hessian = &mut function.hessian;
        hessian[(3 + c, 3 + b)] = row[c];
        hessian[(3 + d, 3 + b)] = row[d];
        hessian[(3 + c, 3 + c)] = -row[b];
        hessian[(3 + d, 3 + d)] = -row[b];
        function
    }

    fn distance(z: &RelativeMotion) -> Self {
        let mut function = Self::constant(z.position.norm());
        // Where the origins coincide it has no direction, and gets no gradient.
        let length = function.value.max(f64::MIN_POSITIVE.sqrt());
        let along = z.rotation.tr_mul(&z.position) / length;
        let across = Matrix3::identity() - along * along.transpose();
        function.gradient.fixed_rows_mut::<3>(0).copy_from(&along);
        let mut linear = function.hessian.fixed_view_mut::<3, 3>(0, 0);
        linear.copy_from(&(across / length));
        let mut angular = function.hessian.fixed_view_mut::<3, 3>(0, 3);
        angular.copy_from(&skew(&along));
        function
    }

    fn combine(&self, alpha: f64, other: &Self, beta: f64) -> Self {
        ScalarFunction {
            value: alpha * self.value + beta * other.value,
            gradient: self.gradient * alpha + other.gradient * beta,
            hessian: self.hessian * alpha + other.hessian * beta,
        }
    }

    fn angle(y: &Self, x: &Self) -> Self {
        let square = x.value * x.value + y.value * y.value;
        // Far from the joint's constraints the angle may be undefined; there any finite slope will
        // do.
        let square = if square > 0.0 {
            square
        } else {
            f64::MIN_POSITIVE.sqrt()
        };
        let gradient = (y.gradient * x.value - x.gradient * y.value) / square;
        let radial = (x.gradient * x.value + y.gradient * y.value) * 2.0;
        ScalarFunction {
            value: y.value.atan2(x.value),
            gradient,
            hessian: (y.hessian * x.value - x.hessian * y.value
                + y.gradient * x.gradient.transpose()
                - x.gradient * y.gradient.transpose()
                - gradient * radial.transpose())
                / square,
        }
    }

    fn length(x: &Self, y: &Self) -> Self {
        let value = x.value.hypot(y.value).max(f64::MIN_POSITIVE.sqrt());
        let gradient = (x.gradient * x.value + y.gradient * y.value) / value;
        ScalarFunction {
            value,
            gradient,
            hessian: (x.hessian * x.value
                + y.hessian * y.value
                + x.gradient * x.gradient.transpose()
                + y.gradient * y.gradient.transpose()
                - gradient * gradient.transpose())
                / value,
        }
    }

    fn value(&mut self) -> &mut f64 {
        &mut self.value
    }
}
