//! Bushings and bearings: full matrices of stiffness and damping between two frames.
//! See docs/theory.md, section 6.10.

use super::joint::{Attachment, FramePair, RelativeState};
use super::scalar_function::{Composed, RelativeMotion, ScalarFunction};
use super::{Contribution, Element, Instant, OutputVariation};
use crate::error::{Error, ErrorKind, Result};
use crate::motion::transposed_product;
use nalgebra::{Matrix6, Vector6};
use serde::{Deserialize, Serialize};

/// A relative turn is closer than about 1e-5 to half a turn where `1 + cos` is below this.
const HALF_TURN: f64 = 1e-10;

/// How a bushing measures the rotation `R` of its second frame relative to its first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BushingAngles {
    /// By its rotation vector, whose angle is below half a turn.
    RotationVector,
    /// By the tilt of axis 3, whose spin does not matter: components 1 and 2 of the rotation vector
    /// that takes axis 3 of the first frame to that of the second. The third is the spin about
    /// axis 3, of which only the rate counts.
    TiltAndSpin,
}

/// Efforts `K e + C ė` against the deformation `e` between two frames, any matrices.
///
/// `e` has the displacement of the second frame's origin, along the axes of the first, and angles.
/// Efforts are conjugate to it: they are forces along the axes of the first frame, on the second
/// body at the origin of its frame and on the first at the same point, and moments that do the work
/// of the angles.
#[derive(Debug, Clone)]
pub struct Bushing {
    pair: FramePair,
    stiffness: Matrix6<f64>,
    damping: Matrix6<f64>,
    angles: BushingAngles,
}

/// The deformation at one instant.
struct Deformed {
    relative: RelativeState,
    e: [ScalarFunction; 6],
    /// The gradients, column by column.
    gradients: Matrix6<f64>,
    /// `ė`.
    rate: Vector6<f64>,
}

impl Deformed {
    /// What `ė` varies by with the relative motion.
    fn rate_by_motion(&self) -> Matrix6<f64> {
        let mut by_motion = self.gradients.transpose() * self.relative.rate_variation();
        for (i, function) in self.e.iter().enumerate() {
            let mut row = by_motion.row_mut(i);
            row += self.relative.rate.transpose() * function.hessian;
        }
        by_motion
    }
}

impl Bushing {
    /// Between two frames.
    pub fn new(
        first: Attachment,
        second: Attachment,
        [stiffness, damping]: [Matrix6<f64>; 2],
        angles: BushingAngles,
    ) -> Self {
        Bushing {
            pair: FramePair::new(first, second),
            stiffness,
            damping,
            angles,
        }
    }

    fn deformed(&self, instant: &Instant) -> Result<Deformed> {
        let relative = self.pair.state(instant.nodes);
        let e = deformation(&relative.z, self.angles)?;
        let gradients = Matrix6::from_columns(&e.map(|function| function.gradient));
        Ok(Deformed {
            rate: gradients.tr_mul(&relative.rate),
            relative,
            e,
            gradients,
        })
    }

    fn efforts(&self, at: &Deformed) -> Vector6<f64> {
        let e = Vector6::from(at.e.map(|function| function.value));
        self.stiffness * e + self.damping * at.rate
    }

    /// What the efforts vary by with the relative motion.
    fn by_motion(&self, at: &Deformed) -> Matrix6<f64> {
        self.stiffness * at.gradients.transpose() + self.damping * at.rate_by_motion()
    }
}

/// The displacement and the angles, of a relative motion.
fn deformation(z: &RelativeMotion, angles: BushingAngles) -> Result<[ScalarFunction; 6]> {
    let cosine = |a, b| ScalarFunction::cosine(z, a, b);
    let half_difference = |a, b| cosine(a, b).combine(0.5, &cosine(b, a), -0.5);
    let [x, y, s] = [0, 1, 2].map(|k| ScalarFunction::displacement(z, k));
    let (turn, axial) = match angles {
        BushingAngles::RotationVector => {
            let trace = cosine(0, 0).combine(0.5, &cosine(1, 1), 0.5);
            let mut turn = trace.combine(1.0, &cosine(2, 2), 0.5);
            turn.value -= 0.5;
            let axial = [
                half_difference(2, 1),
                half_difference(0, 2),
                half_difference(1, 0),
            ];
            (turn, axial)
        }
        BushingAngles::TiltAndSpin => {
            let (c, zero) = (cosine(1, 2), cosine(0, 2));
            let sum = cosine(0, 0).combine(1.0, &cosine(1, 1), 1.0);
            let spin = ScalarFunction::angle(&cosine(1, 0).combine(1.0, &cosine(0, 1), -1.0), &sum);
            (cosine(2, 2), [c.combine(-1.0, &c, 0.0), zero, spin])
        }
    };
    if 1.0 + turn.value < HALF_TURN {
        let message = "its frames are turned by half a turn: the angles between them have no \
                       direction";
        return Err(Error::new(ErrorKind::Model, message));
    }
    let ratio = turn.mapped(angle_by_sine(turn.value));
    let [a, b, c] = axial;
    let third = match angles {
        BushingAngles::RotationVector => c.times(&ratio),
        BushingAngles::TiltAndSpin => c,
    };
    Ok([x, y, s, a.times(&ratio), b.times(&ratio), third])
}

/// `θ / sin θ` as a function of `cos θ`, and its first and second derivative.
fn angle_by_sine(cosine: f64) -> [f64; 3] {
    let u = 1.0 - cosine;
    if u < 0.5 {
        // Σ dₙ uⁿ with dₙ = dₙ₋₁ n / (2 n + 1), from arcsin; derivatives are by −u.
        let (mut d, mut power) = (1.0, [1.0, 0.0, 0.0]);
        let mut sum = [1.0, 0.0, 0.0];
        for n in 1..40 {
            let n = f64::from(n);
            d *= n / (2.0 * n + 1.0);
            power = [
                power[0] * u,
                power[1] * u + power[0],
                power[2] * u + 2.0 * power[1],
            ];
            (0..3).for_each(|k| sum[k] += d * power[k]);
        }
        return [sum[0], -sum[1], sum[2]];
    }
    let square = 1.0 - cosine * cosine;
    let value = cosine.clamp(-1.0, 1.0).acos() / square.sqrt();
    // From (1 − c²) g' = c g − 1 and its derivative.
    let slope = (cosine * value - 1.0) / square;
    [value, slope, (value + 3.0 * cosine * slope) / square]
}

impl Element for Bushing {
    fn nodes(&self) -> &[usize] {
        self.pair.nodes()
    }

    fn has_damping(&self) -> bool {
        self.damping != Matrix6::zeros()
    }

    /// If its stiffness is symmetric.
    fn potential(&self, instant: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        if self.stiffness != self.stiffness.transpose() {
            return Ok(None);
        }
        let e = deformation(&self.pair.relative_motion(instant.nodes), self.angles)?;
        let e = Vector6::from(e.map(|function| function.value));
        Ok(Some(0.5 * e.dot(&(self.stiffness * e))))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let at = self.deformed(instant)?;
        let efforts = self.efforts(&at);
        let wrench = at.gradients * efforts;
        if !out.with_tangents {
            let none = Matrix6::zeros();
            at.relative.add_wrench(&wrench, &none, None, out);
            return Ok(());
        }
        let mut variation = at.gradients * self.by_motion(&at);
        for (function, effort) in at.e.iter().zip(efforts.iter()) {
            variation += function.hessian * *effort;
        }
        let damping = at.gradients * self.damping * at.gradients.transpose();
        let damping = self.has_damping().then_some(&damping);
        at.relative.add_wrench(&wrench, &variation, damping, out);
        Ok(())
    }

    /// The six efforts.
    fn outputs(&self, instant: &Instant, out: &mut Vec<f64>) -> Result<()> {
        let at = self.deformed(instant)?;
        out.extend(self.efforts(&at).iter());
        Ok(())
    }

    fn is_bushing(&self) -> bool {
        true
    }

    fn vary_output(
        &self,
        instant: &Instant,
        index: usize,
        out: &mut OutputVariation,
    ) -> Result<()> {
        let at = self.deformed(instant)?;
        let by_motion = self.by_motion(&at).row(index).transpose();
        let by_velocity = at.gradients * self.damping.row(index).transpose();
        for (local, jacobian) in at.relative.local_jacobians() {
            let [motion, velocity] = &mut out.nodes[local];
            *motion += transposed_product(jacobian, &by_motion);
            *velocity += transposed_product(jacobian, &by_velocity);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Motion, rotation_from_vector};
    use nalgebra::Vector3;

    #[test]
    fn angles_are_the_rotation_vector_and_its_part_without_spin() {
        for size in [0.0, 1e-9, 1e-4, 0.3, 1.0, 1.06, 2.0, 3.1] {
            let vector = Vector3::new(0.48, -0.6, 0.64) * size;
            let at = |v: &Vector3<f64>| {
                let z = Motion::new(rotation_from_vector(v), Vector3::new(1.0, 2.0, -3.0));
                deformation(&z, BushingAngles::RotationVector).unwrap()
            };
            let found = at(&vector);
            let values = found.map(|function| function.value);
            assert_eq!(&values[..3], [1.0, 2.0, -3.0]);
            // Rounding of the cosine, which the angle near half a turn is of the order of its root.
            let error = (Vector3::new(values[3], values[4], values[5]) - vector).amax();
            assert!(error < 1e-14 + 1e-13 * size.powi(4), "{size}: {error}");
        }
        for (tilt, spin) in [(0.4, 7.0), (1.5, -2.0), (1e-8, 1.0)] {
            let swing = Vector3::new(0.8, -0.6, 0.0) * tilt;
            let turn =
                rotation_from_vector(&swing) * rotation_from_vector(&Vector3::new(0.0, 0.0, spin));
            let z = Motion::new(turn, Vector3::zeros());
            let found = deformation(&z, BushingAngles::TiltAndSpin).unwrap();
            assert!((found[3].value - swing.x).abs() < 1e-14);
            assert!((found[4].value - swing.y).abs() < 1e-14);
            assert!((found[5].value - spin).sin().abs() < 1e-14);
        }
        let half = rotation_from_vector(&Vector3::new(std::f64::consts::PI, 0.0, 0.0));
        for angles in [BushingAngles::RotationVector, BushingAngles::TiltAndSpin] {
            let z = Motion::new(half, Vector3::zeros());
            assert!(deformation(&z, angles).is_err());
        }
    }

    #[test]
    fn the_ratio_of_angle_and_sine_is_smooth_where_its_formula_changes() {
        let (below, above) = (angle_by_sine(0.5 + 1e-12), angle_by_sine(0.5 - 1e-12));
        for (a, b) in below.iter().zip(above) {
            // The largest derivative there is some 3.
            assert!((a - b).abs() < 1e-11, "{a} {b}");
        }
    }
}
