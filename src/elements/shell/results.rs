//! Strains, resultants and surface stresses of a shell element at any of its places.

use super::scratch::Scratch;
use super::{Place, Shell, ShellSection, Vector12};
use crate::elements::NodeState;
use crate::error::{Error, Result, require_finite};
use crate::motion::{DualVector, Motion, turned};
use nalgebra::{Matrix3, Vector3, Vector6};

/// A place of an element and axes there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShellPoint {
    /// `(ξ, η)`, each from −1 to 1.
    pub at: [f64; 2],
    /// Direction in the reference configuration, along the inertial axes, whose part in the surface
    /// is axis 1; if none is given, axes are those of the section. Axis 3 is the normal, and all
    /// move with the shell.
    pub axis: Option<Vector3<f64>>,
}

impl ShellPoint {
    /// A place, with the section's axes.
    pub fn new(at: [f64; 2]) -> Self {
        ShellPoint { at, axis: None }
    }

    /// Checks the numbers.
    pub(crate) fn validate(&self) -> Result<()> {
        require_finite("at", &self.at)?;
        for coordinate in self.at {
            if !(-1.0..=1.0).contains(&coordinate) {
                return Err(Error::value("at", "numbers from −1 to 1", coordinate));
            }
        }
        match &self.axis {
            Some(axis) => require_finite("axis", axis.as_slice()),
            None => Ok(()),
        }
    }
}

/// Which surface of a shell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShellSide {
    /// The one that the normal points out of.
    Top,
    /// The other.
    Bottom,
}

/// What strains at a place are: sums over samples, along axes.
struct Field {
    /// The section's axes there.
    place: Place,
    /// Those axes in the ones asked for: `T'ᵀ T`.
    turn: Matrix3<f64>,
    /// Samples that count, with their weights, of velocities in ξ and in η.
    samples: [Vec<(usize, f64)>; 2],
}

impl Field {
    /// Strains along axes 1 and 2 of the section by those of the samples.
    fn along_section(&self, samples: &[Vector6<f64>]) -> Vector12 {
        let [xi, eta] = [0, 1].map(|direction: usize| -> Vector6<f64> {
            let weights = self.samples[direction].iter();
            weights.map(|&(t, weight)| samples[t] * weight).sum()
        });
        let [first, second] = self.place.axes.strains(&[xi, eta]);
        joined(&first, &second)
    }

    /// The transposed: adds what factors of the strains make of those of the samples.
    fn spread(&self, by: &Vector12, samples: &mut [Vector6<f64>]) {
        let sums = self.place.axes.spread(&halves(by));
        for (sum, weights) in sums.iter().zip(&self.samples) {
            for &(t, weight) in weights {
                samples[t] += sum * weight;
            }
        }
    }

    /// Strains or resultants along the section's axes, along those asked for.
    fn asked(&self, along_section: &Vector12) -> Vector12 {
        turned_both(&self.turn, along_section)
    }

    /// The inverse, and transposed.
    fn back(&self, asked: &Vector12) -> Vector12 {
        turned_both(&self.turn.transpose(), asked)
    }
}

fn joined(first: &Vector6<f64>, second: &Vector6<f64>) -> Vector12 {
    Vector12::from_iterator(first.iter().chain(second.iter()).copied())
}

fn halves(both: &Vector12) -> [Vector6<f64>; 2] {
    [0, 6].map(|first| both.fixed_rows::<6>(first).into_owned())
}

/// Turns both indices: the axis along which it is, and the components.
fn turned_both(turn: &Matrix3<f64>, both: &Vector12) -> Vector12 {
    let [first, second] = halves(both).map(|half| turned(turn, &half));
    let along = |row: usize| first * turn[(row, 0)] + second * turn[(row, 1)];
    joined(&along(0), &along(1))
}

impl Shell {
    /// Motion of the surface at `(ξ, η)`, axes 1, 2 and the normal as those of the section in the
    /// reference configuration, for the element's nodes at `motions`.
    ///
    /// # Errors
    /// If it cannot be interpolated.
    pub fn section_motion(&self, at: [f64; 2], motions: &[Motion]) -> Result<Motion> {
        let carried: Vec<Motion> = self.carried(motions.iter()).collect();
        let relative: Vec<_> = super::relative_to_first(carried.iter()).collect();
        let polar = self.grid.station(at, 0).polar(&relative)?;
        let motion = carried[0].compose(&polar.motion());
        let axes = self.place(at, self.direction.as_ref())?.axes.turn;
        Ok(Motion::new(motion.rotation * axes, motion.position))
    }

    /// Reference motions of the nodes.
    pub fn reference(&self) -> &[Motion] {
        &self.reference
    }

    /// Unit normals at the nodes: third axes of the frames that are interpolated.
    pub(crate) fn normals(&self) -> impl Iterator<Item = Vector3<f64>> + '_ {
        let frames = self.carried(self.reference.iter());
        frames.map(|frame| frame.rotation.column(2).into())
    }

    /// Whether the frames that it interpolates are parallel.
    pub(crate) fn has_parallel_frames(&self) -> bool {
        const SAME: f64 = 1e-12;
        let first = self.normals().next().unwrap_or_else(Vector3::z);
        self.normals().all(|normal| (normal - first).norm() < SAME)
    }

    /// Thickness of an isotropic shell that is as stiff in bending against stretching.
    pub(crate) fn thickness(&self) -> f64 {
        let k = &self.section.stiffness;
        let ratio = |bending: usize, stretching: usize| {
            12.0 * k[(bending, bending)] / k[(stretching, stretching)]
        };
        ratio(4, 0).max(ratio(9, 7)).sqrt()
    }

    /// Where its nodes are in the reference configuration.
    pub(crate) fn places(&self) -> Vec<Vector3<f64>> {
        self.reference
            .iter()
            .map(|motion| motion.position)
            .collect()
    }

    /// How far the corners are from a plane: half of the distance between the diagonals.
    pub(crate) fn warp(&self) -> f64 {
        let [rows, columns] = self.grid.sides;
        let last = rows * columns - 1;
        let corners = [0, columns - 1, last, last + 1 - columns];
        let [a, b, c, d] = corners.map(|corner| self.reference[corner].position);
        let across = (c - a).cross(&(d - b));
        let length = across.norm();
        if length > 0.0 {
            0.5 * ((b - a).dot(&across) / length).abs()
        } else {
            0.0
        }
    }

    fn field(&self, point: &ShellPoint) -> Result<Field> {
        let place = self.place(point.at, self.direction.as_ref())?;
        let turn = match &point.axis {
            None => Matrix3::identity(),
            Some(axis) => {
                let axes = self.place(point.at, Some(axis)).map_err(|_| {
                    let expected = "a direction that is not along the normal";
                    Error::value("axis", expected, format!("{:?}", axis.as_slice()))
                })?;
                axes.axes.turn.tr_mul(&place.axes.turn)
            }
        };
        Ok(Field {
            samples: [0, 1].map(|direction| self.sampling.of_place(direction, point.at)),
            place,
            turn,
        })
    }

    /// Strains and resultants at a place, along its axes, for the element's nodes at `states`.
    ///
    /// Strains are the polynomials through those at the samples, where they are most accurate;
    /// resultants follow from these by the section's law.
    ///
    /// # Errors
    /// If the place is outside of the element, its axis is along the normal, or nodes are too far
    /// apart.
    pub fn strain_and_stress(
        &self,
        point: &ShellPoint,
        states: &[NodeState],
    ) -> Result<[Vector12; 2]> {
        point.validate()?;
        let field = self.field(point)?;
        let mut scratch = Scratch::default();
        self.find_strains(states, &mut scratch)?;
        let [strain, rate] = [0, 1].map(|i| field.along_section(&scratch.at_samples[i]));
        let elastic = self.section.stiffness * strain + self.prestress;
        let stress = elastic + self.section.damping * rate;
        Ok([strain, stress].map(|both| field.asked(&both)))
    }

    /// Gives what factors of the strains and resultants at a place add up to: those of the
    /// increments of the motion and the velocity of each node.
    ///
    /// # Errors
    /// As [`Shell::strain_and_stress`].
    pub fn vary_strain_and_stress(
        &self,
        point: &ShellPoint,
        states: &[NodeState],
        [by_strain, by_stress]: &[Vector12; 2],
        mut add: impl FnMut(usize, [Vector6<f64>; 2]),
    ) -> Result<()> {
        let field = self.field(point)?;
        let [by_strain, by_stress] = [by_strain, by_stress].map(|by| field.back(by));
        let ShellSection {
            stiffness, damping, ..
        } = &self.section;
        let all = [
            by_strain + stiffness.tr_mul(&by_stress),
            damping.tr_mul(&by_stress),
        ];
        let spread = all.map(|by| {
            let mut samples = vec![Vector6::zeros(); self.samples.len()];
            field.spread(&by, &mut samples);
            samples
        });
        let mut scratch = Scratch::default();
        self.find_strains(states, &mut scratch)?;
        let kind = self.damping(states);
        for (sample, by) in spread[0].iter().zip(&spread[1]).enumerate() {
            self.find_terms(sample, kind, &mut scratch);
            let [by_strain, by_rate] = [by.0, by.1].map(DualVector::from_wrench);
            let nodes = scratch.terms.iter().zip(&self.dual_frames).enumerate();
            for (local, (node, frame)) in nodes {
                let transposed = node.strain.transpose();
                let by_motion = transposed * by_strain + node.rate.transpose() * by_rate;
                let both = [by_motion, transposed * by_rate];
                add(local, both.map(|by| (*frame * by).to_wrench()));
            }
        }
        Ok(())
    }
}

/// Stresses `[σ11 σ22 σ12]` at a surface of an isotropic shell of this thickness, by resultants;
/// as rows of a matrix.
pub fn surface_stress(thickness: f64, side: ShellSide) -> [Vector12; 3] {
    let membrane = 1.0 / thickness;
    let bending = 6.0 / (thickness * thickness);
    let sign = match side {
        ShellSide::Top => bending,
        ShellSide::Bottom => -bending,
    };
    // [N11 N12 Q1 | M11 M12 M1n | N21 N22 Q2 | M21 M22 M2n].
    let row = |entries: [(usize, f64); 2]| {
        let mut row = Vector12::zeros();
        entries.into_iter().for_each(|(i, value)| row[i] = value);
        row
    };
    let mut shear = row([(1, 0.5 * membrane), (6, 0.5 * membrane)]);
    shear += row([(3, -0.5 * sign), (10, 0.5 * sign)]);
    [
        row([(0, membrane), (4, sign)]),
        row([(7, membrane), (9, -sign)]),
        shear,
    ]
}

impl ShellSection {
    /// Thickness of the isotropic shell that this is the section of, if it is one.
    pub fn isotropic_thickness(&self) -> Option<f64> {
        /// Largest relative difference that rounding makes.
        const SAME: f64 = 1e-9;
        let k = &self.stiffness;
        let (stretching, bending) = (k[(0, 0)], k[(4, 4)]);
        let thickness = (12.0 * bending / stretching).sqrt();
        let poisson = k[(0, 7)] / stretching;
        let shear = 0.5 * (1.0 - poisson) * stretching;
        let mut expected = super::Matrix12::zeros();
        let entries = [
            (0, 0, stretching),
            (7, 7, stretching),
            (0, 7, poisson * stretching),
            (4, 4, bending),
            (9, 9, bending),
            (4, 9, -poisson * bending),
            (3, 3, bending * (1.0 - poisson)),
            (10, 10, bending * (1.0 - poisson)),
            (1, 1, k[(1, 1)]),
            (6, 6, k[(1, 1)]),
            (1, 6, 2.0 * shear - k[(1, 1)]),
            // Whatever these are.
            (2, 2, k[(2, 2)]),
            (8, 8, k[(2, 2)]),
            (5, 5, k[(5, 5)]),
            (11, 11, k[(5, 5)]),
        ];
        for (i, j, value) in entries {
            expected[(i, j)] = value;
            expected[(j, i)] = value;
        }
        // Written so that NaN is refused.
        let same = |i: usize, j: usize| {
            let size = (k[(i, i)] * k[(j, j)]).sqrt();
            (k[(i, j)] - expected[(i, j)]).abs() <= SAME * size
        };
        let all = (0..12).all(|i| (0..12).all(|j| same(i, j)));
        (all && thickness.is_finite()).then_some(thickness)
    }
}
