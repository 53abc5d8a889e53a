//! A shell element in its reference configuration: its surface, axes, areas and inertia.

use super::{Axes, Place, Point, Sample, Shell, VANISHING, relative_to_first};
use crate::elements::Inertia;
use crate::elements::shape::gauss_legendre;
use crate::error::{Error, Result, require_finite};
use crate::motion::{DualMatrix, Motion, turn_of_both};
use nalgebra::{Matrix3, Matrix6, Vector3};

impl Shell {
    /// The frames that are interpolated, for nodes at these motions.
    pub(super) fn carried<'a>(
        &'a self,
        motions: impl Iterator<Item = &'a Motion> + 'a,
    ) -> impl Iterator<Item = Motion> + 'a {
        motions.zip(&self.frames).map(|(m, frame)| m.compose(frame))
    }

    /// The first of the frames in the reference, and all relative to it.
    fn reference_frames(&self) -> (Motion, Vec<DualMatrix>) {
        let carried: Vec<Motion> = self.carried(self.reference.iter()).collect();
        let relative = relative_to_first(carried.iter()).collect();
        (carried[0], relative)
    }

    /// Places the samples.
    pub(super) fn find_samples(&mut self) -> Result<()> {
        let (_, relative) = self.reference_frames();
        let samples = self.sampling.places().into_iter();
        let sample = |(at, direction)| {
            let line = self.grid.station(at, direction);
            let reference = line.motion(&relative)?.e.to_twist();
            let (values, slopes) = line.shapes.iter().copied().unzip();
            Ok(Sample {
                shapes: [values, slopes],
                line,
                reference,
            })
        };
        self.samples = samples.map(sample).collect::<Result<_>>()?;
        Ok(())
    }

    /// Gauss points of the surface, with their weights.
    pub(super) fn rule(&self) -> Vec<([f64; 2], f64)> {
        let [along, across] = self.grid.sides.map(gauss_legendre);
        let pairs = along
            .iter()
            .flat_map(|a| across.iter().map(move |b| (a, b)));
        pairs.map(|(a, b)| ([a.0, b.0], a.1 * b.1)).collect()
    }

    /// Places the Gauss points.
    pub(super) fn find_points(&mut self) -> Result<()> {
        let point = |(at, weight): ([f64; 2], f64)| {
            let place = self.place(at, self.direction.as_ref())?;
            Ok(Point {
                area: weight * place.area,
                axes: place.axes,
            })
        };
        self.points = self.rule().into_iter().map(point).collect::<Result<_>>()?;
        Ok(())
    }

    /// The surface at `(ξ, η)` in the reference configuration.
    pub(super) fn place(&self, at: [f64; 2], direction: Option<&Vector3<f64>>) -> Result<Place> {
        let (first, relative) = self.reference_frames();
        let stations = [0, 1].map(|direction| self.grid.station(at, direction));
        let motions = [
            stations[0].motion(&relative)?,
            stations[1].motion(&relative)?,
        ];
        let tangents = motions.each_ref().map(|motion| motion.e.dual);
        let motion = first.compose(&motions[0].polar.motion());
        let normal = tangents[0].cross(&tangents[1]);
        let (area, size) = (normal.norm(), tangents[0].norm() * tangents[1].norm());
        // Written so that NaN fails too.
        if !(size > 0.0 && area > VANISHING * size) {
            let got = format!("one that vanishes at ξ = {}, η = {}", at[0], at[1]);
            return Err(Error::value("nodes", "a surface with a normal", got));
        }
        let normal = normal / area;
        let turn = match direction {
            None => axes_between(&tangents, &normal),
            Some(direction) => {
                let here = motion.rotation.tr_mul(direction);
                let along = here - normal * normal.dot(&here);
                // Written so that NaN is refused.
                let is_along = along.norm() > VANISHING * here.norm();
                if !is_along {
                    let expected = "a direction in the surface, all over it";
                    return Err(Error::value("direction", expected, "one along its normal"));
                }
                let along = along.normalize();
                Matrix3::from_columns(&[along, normal.cross(&along), normal])
            }
        };
        let along = |i: usize, axis: usize| tangents[i].dot(&turn.column(axis));
        let determinant = along(0, 0) * along(1, 1) - along(0, 1) * along(1, 0);
        Ok(Place {
            motion,
            area,
            axes: Axes {
                turn,
                slopes: [
                    [along(1, 1) / determinant, -along(0, 1) / determinant],
                    [-along(1, 0) / determinant, along(0, 0) / determinant],
                ],
            },
        })
    }

    /// Inertia, integrated by one point for each node. Nodal velocities are first carried to the
    /// reference frame of the surface, then interpolated, so that the matrix is constant and a
    /// rigid motion has exact inertia.
    ///
    /// # Errors
    /// If it is too large to be a number.
    pub fn inertia(&self) -> Result<Inertia> {
        let count = self.nodes.len();
        let mut mass = vec![Matrix6::zeros(); count * count];
        for ((at, _), point) in self.rule().into_iter().zip(&self.points) {
            let surface = self.place(at, None)?.motion;
            let carry: Vec<Matrix6<f64>> = self
                .reference
                .iter()
                .zip(self.grid.shapes(at))
                .map(|(node, shape)| surface.relative(node).adjoint() * shape[0])
                .collect();
            let turn = turn_of_both(&point.axes.turn);
            let own = turn * self.section.mass * turn.transpose() * point.area;
            for a in 0..count {
                let left = carry[a].transpose() * own;
                for (b, right) in carry.iter().enumerate() {
                    mass[a * count + b] += left * right;
                }
            }
        }
        for block in &mass {
            require_finite("inertia of the shell", block.as_slice())?;
        }
        let nodes = self.nodes.clone();
        Ok(Inertia::consistent(nodes, mass, &self.reference))
    }
}

/// The right-angled axes that are as close to both tangents as each other, and the normal.
fn axes_between(tangents: &[Vector3<f64>; 2], normal: &Vector3<f64>) -> Matrix3<f64> {
    let a = (tangents[0].normalize() + tangents[1].normalize()).normalize();
    let b = normal.cross(&a);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    Matrix3::from_columns(&[(a - b) * half, (a + b) * half, *normal])
}
