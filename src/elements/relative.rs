//! Scalar functions of the relative motion of two joint frames: constraints and joint coordinates.
//!
//! With `Z = C_i⁻¹ C_j` and its material increment `δz = [linear; angular]` (resolved in frame j), two
//! primitives have simple exact derivatives, and everything else is composed of them.

use super::Measure;
use crate::motion::{Motion, skew};
use nalgebra::{Matrix6, Vector3, Vector6};
use std::fmt;

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

impl ScalarFunction {
    /// Displacement `e_kᵀ r` along axis `k` of the first frame.
    pub fn displacement(z: &RelativeMotion, k: usize) -> Self {
        let row = z.rotation.row(k).transpose();
        let mut function = Self::constant(z.position[k]);
        function.gradient.fixed_rows_mut::<3>(0).copy_from(&row);
        function
            .hessian
            .fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&skew(&row));
        function
    }

    /// Direction cosine `e_aᵀ R e_b` between axis `a` of the first and axis `b` of the second frame.
    pub fn cosine(z: &RelativeMotion, a: usize, b: usize) -> Self {
        let row = z.rotation.row(a).transpose();
        let mut axis = Vector3::zeros();
        axis[b] = 1.0;
        let b_skew = skew(&axis);
        let mut function = Self::constant(z.rotation[(a, b)]);
        function
            .gradient
            .fixed_rows_mut::<3>(3)
            .copy_from(&(b_skew * row));
        function
            .hessian
            .fixed_view_mut::<3, 3>(3, 3)
            .copy_from(&(b_skew * skew(&row)));
        function
    }

    fn constant(value: f64) -> Self {
        ScalarFunction {
            value,
            gradient: Vector6::zeros(),
            hessian: Matrix6::zeros(),
        }
    }

    /// `α self + β other`.
    fn combine(&self, alpha: f64, other: &Self, beta: f64) -> Self {
        ScalarFunction {
            value: alpha * self.value + beta * other.value,
            gradient: self.gradient * alpha + other.gradient * beta,
            hessian: self.hessian * alpha + other.hessian * beta,
        }
    }

    /// Angle of the point `(x, y)`, in `(−π, π]`.
    fn angle(y: &Self, x: &Self) -> Self {
        let square = x.value * x.value + y.value * y.value;
        // Far from the joint's constraints the angle may be undefined; there any finite slope will do.
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

    /// `√(x² + y²)`.
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
}

/// Coordinates that a joint leaves free.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Coordinate {
    /// First (or only) relative angle.
    Rotation1,
    /// Second relative angle.
    Rotation2,
    /// Third relative angle.
    Rotation3,
}

impl Coordinate {
    /// What the coordinate measures.
    pub fn measure(self) -> Measure {
        match self {
            Coordinate::Rotation1 | Coordinate::Rotation2 | Coordinate::Rotation3 => Measure::Angle,
        }
    }
}

impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Coordinate::Rotation1 => "rotation 1",
            Coordinate::Rotation2 => "rotation 2",
            Coordinate::Rotation3 => "rotation 3",
        })
    }
}

/// Kinds of joints. Constraints and coordinates are functions of `R`, `r`: rotation and position of
/// the second joint frame, relative to and resolved in the first.
///
/// | joint | constraints | coordinates |
/// |---|---|---|
/// | rigid | `r = 0`, `axial(R) = 0` | none |
/// | revolute | `r = 0`, `e₁ᵀR e₃ = e₂ᵀR e₃ = 0` | angle about `e₃` |
/// | universal | `r = 0`, `e₁ᵀR e₂ = 0` | `R = R₁(θ₁) R₂(θ₂)` |
/// | spherical | `r = 0` | `R = R₁(θ₁) R₂(θ₂) R₃(θ₃)` |
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum JointKind {
    /// No relative motion.
    Rigid,
    /// One relative rotation, about axis 3 of the joint frames.
    Revolute,
    /// Two relative rotations: about axis 1 of the first frame, then about axis 2 of the second.
    Universal,
    /// All relative rotations; coordinates are the Cardan angles of the sequence 1-2-3.
    Spherical,
}

impl JointKind {
    /// Name, as in messages and the documentation.
    pub fn name(self) -> &'static str {
        match self {
            JointKind::Rigid => "rigid",
            JointKind::Revolute => "revolute",
            JointKind::Universal => "universal",
            JointKind::Spherical => "spherical",
        }
    }

    /// Number of constraints.
    pub fn constraints(self) -> usize {
        match self {
            JointKind::Rigid => 6,
            JointKind::Revolute => 5,
            JointKind::Universal => 4,
            JointKind::Spherical => 3,
        }
    }

    /// Coordinates left free, in order.
    pub fn coordinates(self) -> &'static [Coordinate] {
        const ALL: [Coordinate; 3] = [
            Coordinate::Rotation1,
            Coordinate::Rotation2,
            Coordinate::Rotation3,
        ];
        match self {
            JointKind::Rigid => &[],
            JointKind::Revolute => &ALL[..1],
            JointKind::Universal => &ALL[..2],
            JointKind::Spherical => &ALL,
        }
    }

    /// Constraint `index` (displacements first), which vanishes when the joint is closed.
    pub fn constraint(self, index: usize, z: &RelativeMotion) -> ScalarFunction {
        let cosine = |a, b| ScalarFunction::cosine(z, a, b);
        match (self, index) {
            (_, 0..=2) => ScalarFunction::displacement(z, index),
            (JointKind::Rigid, _) => {
                let k = index - 3;
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                cosine(j, i).combine(0.5, &cosine(i, j), -0.5)
            }
            (JointKind::Universal, _) => cosine(0, 1),
            _ => cosine(index - 3, 2),
        }
    }

    /// What constraint `index` measures.
    pub fn measure(self, index: usize) -> Measure {
        if index < 3 {
            Measure::Length
        } else {
            Measure::Angle
        }
    }

    /// Joint coordinate `which`, an angle in `(−π, π]`. The joint must have it.
    pub fn coordinate(self, which: Coordinate, z: &RelativeMotion) -> ScalarFunction {
        let cosine = |a, b| ScalarFunction::cosine(z, a, b);
        let minus = |f: ScalarFunction| f.combine(-1.0, &f, 0.0);
        match (self, which) {
            // Both columns, so that it is the best fit also where the axes do not coincide.
            (JointKind::Revolute | JointKind::Rigid, _) => ScalarFunction::angle(
                &cosine(1, 0).combine(1.0, &cosine(0, 1), -1.0),
                &cosine(0, 0).combine(1.0, &cosine(1, 1), 1.0),
            ),
            (JointKind::Universal, Coordinate::Rotation1) => {
                ScalarFunction::angle(&cosine(2, 1), &cosine(1, 1))
            }
            (JointKind::Universal, _) => ScalarFunction::angle(&cosine(0, 2), &cosine(0, 0)),
            (JointKind::Spherical, Coordinate::Rotation1) => {
                ScalarFunction::angle(&minus(cosine(1, 2)), &cosine(2, 2))
            }
            (JointKind::Spherical, Coordinate::Rotation2) => ScalarFunction::angle(
                &cosine(0, 2),
                &ScalarFunction::length(&cosine(0, 0), &cosine(0, 1)),
            ),
            (JointKind::Spherical, Coordinate::Rotation3) => {
                ScalarFunction::angle(&minus(cosine(0, 1)), &cosine(0, 0))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::rotation_from_vector;

    fn turn(axis: usize, angle: f64) -> nalgebra::Matrix3<f64> {
        let mut v = Vector3::zeros();
        v[axis] = angle;
        rotation_from_vector(&v)
    }

    #[test]
    fn coordinates_are_the_angles_of_their_definition() {
        let (a, b, c) = (0.7, -0.4, 2.5);
        let at = |rotation| Motion::new(rotation, Vector3::zeros());
        let check = |kind: JointKind, z: &Motion, angles: &[f64]| {
            for index in 0..kind.constraints() {
                assert!(kind.constraint(index, z).value.abs() < 1e-15);
            }
            for (which, angle) in kind.coordinates().iter().zip(angles) {
                assert!((kind.coordinate(*which, z).value - angle).abs() < 1e-15);
            }
        };
        check(JointKind::Revolute, &at(turn(2, c)), &[c]);
        check(JointKind::Universal, &at(turn(0, a) * turn(1, b)), &[a, b]);
        check(
            JointKind::Spherical,
            &at(turn(0, a) * turn(1, b) * turn(2, c)),
            &[a, b, c],
        );
        check(JointKind::Rigid, &Motion::identity(), &[]);
    }

    #[test]
    fn gradients_and_hessians_agree_with_differences() {
        let z = Motion::new(
            rotation_from_vector(&Vector3::new(0.4, 0.9, -0.6)),
            Vector3::new(0.3, -0.2, 0.8),
        );
        let h = 1e-5;
        let kinds = [
            JointKind::Rigid,
            JointKind::Revolute,
            JointKind::Universal,
            JointKind::Spherical,
        ];
        for kind in kinds {
            let constraints =
                (0..kind.constraints()).map(|i| -> Box<dyn Fn(&Motion) -> ScalarFunction> {
                    Box::new(move |z| kind.constraint(i, z))
                });
            let coordinates =
                kind.coordinates()
                    .iter()
                    .map(|&c| -> Box<dyn Fn(&Motion) -> ScalarFunction> {
                        Box::new(move |z| kind.coordinate(c, z))
                    });
            for function in constraints.chain(coordinates) {
                let here = function(&z);
                for k in 0..6 {
                    let mut step = Vector6::zeros();
                    step[k] = h;
                    let (up, down) = (
                        function(&z.increment(&step)),
                        function(&z.increment(&-step)),
                    );
                    let slope = (up.value - down.value) / (2.0 * h);
                    assert!((slope - here.gradient[k]).abs() < 1e-9);
                    let bend = (up.gradient - down.gradient) / (2.0 * h);
                    assert!((bend - here.hessian.column(k)).amax() < 1e-8);
                }
            }
        }
    }
}
