//! Scalar functions of the relative motion of two joint frames: constraints and joint coordinates.
//!
//! With `Z = C_i⁻¹ C_j` and its material increment `δz = [linear; angular]` (resolved in frame j),
//! two primitives have simple exact derivatives, and everything else is composed of them. See
//! docs/theory.md, section 6.8.

use super::Measure;
use super::scalar_function::{Composed, RelativeMotion, ScalarFunction};
use crate::error::{Error, ErrorKind, Result};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::fmt;

/// Coordinates that a joint leaves free; "1" is the first or only one of its sort.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Coordinate {
    /// First (or only) relative displacement.
    Displacement1,
    /// Second relative displacement.
    Displacement2,
    /// Third relative displacement.
    Displacement3,
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
            Coordinate::Displacement1 | Coordinate::Displacement2 | Coordinate::Displacement3 => {
                Measure::Length
            }
            Coordinate::Rotation1 | Coordinate::Rotation2 | Coordinate::Rotation3 => Measure::Angle,
        }
    }
}

impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Coordinate::Displacement1 => "displacement 1",
            Coordinate::Displacement2 => "displacement 2",
            Coordinate::Displacement3 => "displacement 3",
            Coordinate::Rotation1 => "rotation 1",
            Coordinate::Rotation2 => "rotation 2",
            Coordinate::Rotation3 => "rotation 3",
        })
    }
}

/// The angle that differs from `angle` by whole turns and lies within half a turn of `near`.
pub(crate) fn nearest_turn(angle: f64, near: f64) -> f64 {
    angle + TAU * ((near - angle) / TAU).round()
}

/// Kinds of joints. Constraints and coordinates are functions of `R`, `r`: rotation and position of
/// the second joint frame, relative to and resolved in the first; `e_k` is axis `k`.
///
/// | joint | constraints | coordinates |
/// |---|---|---|
/// | rigid | `r = 0`, `axial(R) = 0` | none |
/// | revolute | `r = 0`, `e₁ᵀR e₃ = e₂ᵀR e₃ = 0` | angle about `e₃` |
/// | prismatic | `e₁ᵀr = e₂ᵀr = 0`, `axial(R) = 0` | displacement `e₃ᵀr` |
/// | cylindrical | `e₁ᵀr = e₂ᵀr = 0`, `e₁ᵀR e₃ = e₂ᵀR e₃ = 0` | `e₃ᵀr`, angle `θ` about `e₃` |
/// | screw | those of the cylindrical joint, `e₃ᵀr = p θ/2π` | `e₃ᵀr`, `θ` |
/// | planar | `e₃ᵀr = 0`, `e₁ᵀR e₃ = e₂ᵀR e₃ = 0` | `e₁ᵀr`, `e₂ᵀr`, angle about `e₃` |
/// | universal | `r = 0`, `e₁ᵀR e₂ = 0` | `R = R₁(θ₁) R₂(θ₂)` |
/// | spherical | `r = 0` | `R = R₁(θ₁) R₂(θ₂) R₃(θ₃)` |
/// | free | none | displacements `r`, `R = R₁(θ₁) R₂(θ₂) R₃(θ₃)` |
/// | strut | none | distance `\|r\|`, displacement 1 |
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum JointKind {
    /// No relative motion.
    Rigid,
    /// One relative rotation, about axis 3 of the joint frames.
    Revolute,
    /// One relative displacement, along axis 3 of the joint frames.
    Prismatic,
    /// A displacement along axis 3 of the joint frames and a rotation about it.
    Cylindrical,
    /// A displacement along axis 3 of the joint frames, in proportion to the rotation about it.
    Screw {
        /// Advance for one turn: positive for a right-handed thread, negative for a left-handed
        /// one.
        pitch: f64,
    },
    /// Displacements along axes 1 and 2 of the first frame, and a rotation about axis 3.
    Planar,
    /// Two relative rotations: about axis 1 of the first frame, then about axis 2 of the second.
    Universal,
    /// All relative rotations; coordinates are the Cardan angles of the sequence 1-2-3.
    Spherical,
    /// All relative motions: nothing is constrained. Coordinates are the displacements along the
    /// axes of the first frame and the Cardan angles of the sequence 1-2-3.
    Free,
    /// The line between two points, which constrains nothing; its coordinate is their distance.
    Strut,
}

/// What a constraint sets to zero.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Constraint {
    /// Displacement along this axis of the first frame.
    Displacement(usize),
    /// Cosine between these axes of the first and the second frame.
    Cosine(usize, usize),
    /// This component of `axial(R)`.
    Axial(usize),
    /// Displacement along axis 3, less the advance of the thread.
    Thread,
}

impl JointKind {
    /// Name, as in messages and the documentation.
    pub fn name(self) -> &'static str {
        match self {
            JointKind::Rigid => "rigid",
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
            JointKind::Cylindrical => "cylindrical",
            JointKind::Screw { .. } => "screw",
            JointKind::Planar => "planar",
            JointKind::Universal => "universal",
            JointKind::Spherical => "spherical",
            JointKind::Free => "free",
            JointKind::Strut => "strut",
        }
    }

    /// The table of constraints.
    fn table(self) -> &'static [Constraint] {
        use Constraint::{Axial, Cosine, Displacement, Thread};
        const R: [Constraint; 3] = [Displacement(0), Displacement(1), Displacement(2)];
        const AXES: [Constraint; 2] = [Cosine(0, 2), Cosine(1, 2)];
        match self {
            JointKind::Rigid => &[R[0], R[1], R[2], Axial(0), Axial(1), Axial(2)],
            JointKind::Revolute => &[R[0], R[1], R[2], AXES[0], AXES[1]],
            JointKind::Prismatic => &[R[0], R[1], Axial(0), Axial(1), Axial(2)],
            JointKind::Cylindrical => &[R[0], R[1], AXES[0], AXES[1]],
            JointKind::Screw { .. } => &[R[0], R[1], AXES[0], AXES[1], Thread],
            JointKind::Planar => &[R[2], AXES[0], AXES[1]],
            JointKind::Universal => &[R[0], R[1], R[2], Cosine(0, 1)],
            JointKind::Spherical => &R,
            JointKind::Free | JointKind::Strut => &[],
        }
    }

    /// Coordinates left free, in order.
    pub fn coordinates(self) -> &'static [Coordinate] {
        use Coordinate::{
            Displacement1, Displacement2, Displacement3, Rotation1, Rotation2, Rotation3,
        };
        match self {
            JointKind::Rigid => &[],
            JointKind::Revolute => &[Rotation1],
            JointKind::Prismatic | JointKind::Strut => &[Displacement1],
            JointKind::Cylindrical | JointKind::Screw { .. } => &[Displacement1, Rotation1],
            JointKind::Planar => &[Displacement1, Displacement2, Rotation1],
            JointKind::Universal => &[Rotation1, Rotation2],
            JointKind::Spherical => &[Rotation1, Rotation2, Rotation3],
            JointKind::Free => &[
                Displacement1,
                Displacement2,
                Displacement3,
                Rotation1,
                Rotation2,
                Rotation3,
            ],
        }
    }

    /// Number of constraints.
    pub fn constraints(self) -> usize {
        self.table().len()
    }

    /// Constraint `index`, which vanishes when the joint is closed.
    pub fn constraint(self, index: usize, z: &RelativeMotion) -> ScalarFunction {
        match self.table()[index] {
            Constraint::Displacement(k) => ScalarFunction::displacement(z, k),
            Constraint::Cosine(a, b) => ScalarFunction::cosine(z, a, b),
            Constraint::Axial(k) => {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let (ij, ji) = (
                    ScalarFunction::cosine(z, i, j),
                    ScalarFunction::cosine(z, j, i),
                );
                ji.combine(0.5, &ij, -0.5)
            }
            Constraint::Thread => {
                let advance = self.pitch() / TAU;
                let angle = self.coordinate(Coordinate::Rotation1, z);
                ScalarFunction::displacement(z, 2).combine(1.0, &angle, -advance)
            }
        }
    }

    /// What constraint `index` measures.
    pub fn measure(self, index: usize) -> Measure {
        match self.table()[index] {
            Constraint::Displacement(_) | Constraint::Thread => Measure::Length,
            Constraint::Cosine(..) | Constraint::Axial(_) => Measure::Angle,
        }
    }

    /// Checks that it leaves a coordinate free.
    ///
    /// # Errors
    /// [`ErrorKind::NotAvailable`].
    pub(crate) fn require_coordinate(self, coordinate: Coordinate) -> Result<()> {
        if self.coordinates().contains(&coordinate) {
            return Ok(());
        }
        let names: Vec<String> = self
            .coordinates()
            .iter()
            .map(Coordinate::to_string)
            .collect();
        let message = format!(
            "coordinate: expected one of a {} joint ({}), got {coordinate}",
            self.name(),
            if names.is_empty() {
                "it has none".into()
            } else {
                names.join(", ")
            },
        );
        Err(Error::new(ErrorKind::NotAvailable, message))
    }

    fn pitch(self) -> f64 {
        match self {
            JointKind::Screw { pitch } => pitch,
            _ => 0.0,
        }
    }

    /// Joint coordinate `which`, which the joint must have. Angles are in `(−π, π]`, save that of a
    /// screw, whose whole turns its displacement tells.
    pub fn coordinate(self, which: Coordinate, z: &RelativeMotion) -> ScalarFunction {
        self.composed_coordinate(which, z)
    }

    /// Its value alone.
    pub fn coordinate_value(self, which: Coordinate, z: &RelativeMotion) -> f64 {
        self.composed_coordinate(which, z)
    }

    fn composed_coordinate<S: Composed>(self, which: Coordinate, z: &RelativeMotion) -> S {
        let cosine = |a, b| S::cosine(z, a, b);
        let minus = |f: S| f.combine(-1.0, &f, 0.0);
        match (self, which) {
            (JointKind::Strut, _) => S::distance(z),
            (
                JointKind::Prismatic | JointKind::Cylindrical | JointKind::Screw { .. },
                Coordinate::Displacement1,
            )
            | (_, Coordinate::Displacement3) => S::displacement(z, 2),
            (_, Coordinate::Displacement1) => S::displacement(z, 0),
            (_, Coordinate::Displacement2) => S::displacement(z, 1),
            (JointKind::Universal, Coordinate::Rotation1) => S::angle(&cosine(2, 1), &cosine(1, 1)),
            (JointKind::Universal, _) => S::angle(&cosine(0, 2), &cosine(0, 0)),
            (JointKind::Spherical | JointKind::Free, Coordinate::Rotation1) => {
                S::angle(&minus(cosine(1, 2)), &cosine(2, 2))
            }
            (JointKind::Spherical | JointKind::Free, Coordinate::Rotation2) => {
                S::angle(&cosine(0, 2), &S::length(&cosine(0, 0), &cosine(0, 1)))
            }
            (JointKind::Spherical | JointKind::Free, Coordinate::Rotation3) => {
                S::angle(&minus(cosine(0, 1)), &cosine(0, 0))
            }
            // Both columns, so that it is the best fit also where the axes do not coincide.
            (_, Coordinate::Rotation1 | Coordinate::Rotation2 | Coordinate::Rotation3) => {
                let mut angle = S::angle(
                    &cosine(1, 0).combine(1.0, &cosine(0, 1), -1.0),
                    &cosine(0, 0).combine(1.0, &cosine(1, 1), 1.0),
                );
                if let JointKind::Screw { pitch } = self {
                    let value = angle.value();
                    *value = nearest_turn(*value, TAU * z.position[2] / pitch);
                }
                angle
            }
        }
    }

    /// Whether coordinate `which` is the middle one of three Cardan angles. It stays within a
    /// quarter turn of zero: there the others, about one axis then, are undefined.
    pub fn is_middle_angle(self, which: Coordinate) -> bool {
        let has_three = matches!(self, JointKind::Spherical | JointKind::Free);
        has_three && which == Coordinate::Rotation2
    }

    /// Whether [`JointKind::coordinate`] gives coordinate `which` without its whole turns.
    pub fn leaves_turns_open(self, which: Coordinate) -> bool {
        let counted = matches!(self, JointKind::Screw { .. }) || self.is_middle_angle(which);
        which.measure() == Measure::Angle && !counted
    }

    /// The value of coordinate `which` that fits `value` and, if its whole turns are open, is
    /// nearest to `near`.
    pub(crate) fn follow(self, which: Coordinate, value: f64, near: f64) -> f64 {
        if self.leaves_turns_open(which) {
            nearest_turn(value, near)
        } else {
            value
        }
    }

    /// The axis of the joint frames that points the wrong way in a joint that is closed: its
    /// constraints hold too if it is turned over.
    pub fn turned_over(self, z: &RelativeMotion) -> Option<usize> {
        let aligned: &[usize] = match self {
            JointKind::Rigid | JointKind::Prismatic => &[0, 1, 2],
            JointKind::Revolute
            | JointKind::Cylindrical
            | JointKind::Screw { .. }
            | JointKind::Planar => &[2],
            JointKind::Universal | JointKind::Spherical | JointKind::Free | JointKind::Strut => &[],
        };
        let against = |&&k: &&usize| z.rotation[(k, k)] < 0.0;
        aligned.iter().find(against).copied()
    }
}

/// One joint of each kind, for tests.
#[cfg(test)]
pub(super) const ALL_KINDS: [JointKind; 10] = [
    JointKind::Rigid,
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Cylindrical,
    // Coarse, so that an open joint is far from where its angle jumps by a turn.
    JointKind::Screw { pitch: -4.7 },
    JointKind::Planar,
    JointKind::Universal,
    JointKind::Spherical,
    JointKind::Free,
    JointKind::Strut,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Motion;
    use crate::motion::rotation_from_vector;
    use nalgebra::{Vector3, Vector6};

    fn turn(axis: usize, angle: f64) -> nalgebra::Matrix3<f64> {
        let mut v = Vector3::zeros();
        v[axis] = angle;
        rotation_from_vector(&v)
    }

    #[test]
    fn coordinates_are_those_of_their_definition() {
        let (a, b, c) = (0.7, -0.4, 2.5);
        let (x, y, s) = (1.3, -0.2, 0.9);
        let at = |rotation, x, y, s| Motion::new(rotation, Vector3::new(x, y, s));
        let check = |kind: JointKind, z: &Motion, values: &[f64]| {
            for index in 0..kind.constraints() {
                assert!(kind.constraint(index, z).value.abs() < 1e-15);
            }
            assert_eq!(kind.coordinates().len(), values.len());
            assert_eq!(
                kind.constraints() + values.len() - usize::from(kind.pitch() != 0.0),
                6
            );
            for (which, value) in kind.coordinates().iter().zip(values) {
                assert!((kind.coordinate(*which, z).value - value).abs() < 1e-14);
            }
            assert_eq!(kind.turned_over(z), None);
        };
        let spin = turn(2, c);
        let cardan = turn(0, a) * turn(1, b) * spin;
        check(JointKind::Rigid, &Motion::identity(), &[]);
        check(JointKind::Revolute, &at(spin, 0.0, 0.0, 0.0), &[c]);
        check(JointKind::Prismatic, &at(turn(2, 0.0), 0.0, 0.0, s), &[s]);
        check(JointKind::Cylindrical, &at(spin, 0.0, 0.0, s), &[s, c]);
        check(JointKind::Planar, &at(spin, x, y, 0.0), &[x, y, c]);
        let cross = turn(0, a) * turn(1, b);
        check(JointKind::Universal, &at(cross, 0.0, 0.0, 0.0), &[a, b]);
        check(JointKind::Spherical, &at(cardan, 0.0, 0.0, 0.0), &[a, b, c]);
        check(JointKind::Free, &at(cardan, x, y, s), &[x, y, s, a, b, c]);
        for (pitch, turns) in [(0.3, 0.0), (-0.3, 0.0), (0.3, -4.0), (0.02, 7.0)] {
            let angle = c + TAU * turns;
            let advance = pitch * angle / TAU;
            check(
                JointKind::Screw { pitch },
                &at(spin, 0.0, 0.0, advance),
                &[advance, angle],
            );
        }
    }

    #[test]
    fn joints_that_are_closed_but_turned_over_are_recognised() {
        let half = std::f64::consts::PI;
        let over = Motion::new(turn(0, half), Vector3::zeros());
        let about = Motion::new(turn(2, half), Vector3::zeros());
        for kind in ALL_KINDS {
            let closed = |z: &Motion| {
                (0..kind.constraints()).all(|i| kind.constraint(i, z).value.abs() < 1e-15)
            };
            assert!(matches!(kind, JointKind::Screw { .. }) || closed(&over));
            let expected = match kind {
                JointKind::Rigid | JointKind::Prismatic => (Some(1), Some(0)),
                JointKind::Universal
                | JointKind::Spherical
                | JointKind::Free
                | JointKind::Strut => (None, None),
                _ => (Some(2), None),
            };
            let found = (kind.turned_over(&over), kind.turned_over(&about));
            assert_eq!(found, expected, "{kind:?}");
        }
    }

    #[test]
    fn gradients_and_hessians_agree_with_differences() {
        let z = Motion::new(
            rotation_from_vector(&Vector3::new(0.4, 0.9, -0.6)),
            Vector3::new(0.3, -0.2, 0.8),
        );
        let h = 1e-5;
        for kind in ALL_KINDS {
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

    #[test]
    fn values_alone_are_those_of_the_functions_and_names_differ() {
        let z = Motion::new(
            turn(0, 0.3) * turn(1, -0.2) * turn(2, 0.9),
            Vector3::new(1.3, -0.2, 0.7),
        );
        for kind in ALL_KINDS {
            for &which in kind.coordinates() {
                let alone = kind.coordinate_value(which, &z);
                assert!((alone - kind.coordinate(which, &z).value).abs() < 1e-15);
                assert!(alone != 0.0);
            }
            let alike = ALL_KINDS.iter().filter(|other| other.name() == kind.name());
            assert_eq!(alike.count(), 1);
            assert!(!kind.name().is_empty());
        }
    }
}
