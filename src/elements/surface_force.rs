//! Forces on the surface or an edge of a shell, or along a beam, that a function of the user
//! computes, point by point. See docs/theory.md, section 6.12.

use super::beam::Beam;
use super::coordinate_force::difference_step;
use super::distributed_load::{self, LoadPoints, PointTerms};
use super::load::LoadFrame;
use super::shell::{Shell, ShellLoadPlace};
use super::surface_force_law::{
    ForcePlace, SurfaceForceInput, SurfaceForceLaw, SurfaceForceOutput,
};
use super::user_force::{COMPONENTS, moved, not_finite, skews};
use super::{Contribution, Element, Instant, NodeState};
use crate::error::Result;
use crate::motion::{DualMatrix, DualPolar, DualVector, Motion, turn_of_both, turned};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Forces of a user on one shell or beam element.
#[derive(Debug, Clone)]
pub struct SurfaceForce {
    element: usize,
    place: ForcePlace,
    points: LoadPoints,
    /// Take twists of nodes to those of the frames that the element interpolates.
    adjoints: Vec<Matrix6<f64>>,
    law: SurfaceForceLaw,
    /// What positions and velocities are of the order of: length, and length and turn for a unit of
    /// time.
    length: f64,
    frequency: f64,
}

/// What the points do, restored after differences.
#[derive(Debug, Clone, Default)]
struct Kept {
    positions: Vec<Vector3<f64>>,
    rotations: Vec<Matrix3<f64>>,
    velocities: Vec<Vector6<f64>>,
}

/// What is found at each evaluation; kept between these.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    /// Motions of the interpolated frames relative to the first, and their twists.
    relative: Vec<DualMatrix>,
    twists: Vec<DualVector>,
    /// Of each point.
    polars: Vec<DualPolar>,
    /// Velocities in the frames that are interpolated, and in the points' own axes.
    spins: Vec<DualVector>,
    own_twists: Vec<Vector6<f64>>,
    positions: Vec<Vector3<f64>>,
    rotations: Vec<Matrix3<f64>>,
    velocities: Vec<Vector6<f64>>,
    forces: Vec<Vector6<f64>>,
    /// Forces to either side, for differences, and what is restored after these.
    sides: [Vec<Vector6<f64>>; 2],
    kept: Kept,
    stiffness: Vec<Matrix6<f64>>,
    damping: Vec<Matrix6<f64>>,
    /// Of the nodes, at one point: what its motion, and its velocity by the motion, vary by.
    by_motion: Vec<Matrix6<f64>>,
    rates: Vec<Matrix6<f64>>,
    load: distributed_load::Scratch,
}

/// Given and differenced tangents of the points, by motion and by velocity.
pub struct PointTangents {
    /// What the user's function gives.
    pub given: [Vec<Matrix6<f64>>; 2],
    /// What differences of its forces give.
    pub differenced: [Vec<Matrix6<f64>>; 2],
}

impl Scratch {
    /// Moves all points by `step` along component `component`.
    fn displace(&mut self, frame: LoadFrame, component: usize, step: f64) {
        let mut u = Vector6::zeros();
        u[component] = step;
        for (position, rotation) in self.positions.iter_mut().zip(&mut self.rotations) {
            let there = moved(frame, &Motion::new(*rotation, *position), &u);
            (*position, *rotation) = (there.position, there.rotation);
        }
    }

    /// Keeps motions and velocities.
    fn keep(&mut self) {
        self.kept.positions.clone_from(&self.positions);
        self.kept.rotations.clone_from(&self.rotations);
        self.kept.velocities.clone_from(&self.velocities);
    }

    /// Takes them back.
    fn restore(&mut self) {
        self.positions.clone_from(&self.kept.positions);
        self.rotations.clone_from(&self.kept.rotations);
        self.velocities.clone_from(&self.kept.velocities);
    }
}

impl SurfaceForce {
    /// On a shell, which is the element of this number; motions are of the order of `length`, at
    /// the circular frequency `frequency`.
    ///
    /// # Errors
    /// If there is no such edge, or the reference shape is too distorted.
    pub fn on_shell(
        (element, shell): (usize, &Shell),
        place: ShellLoadPlace,
        law: SurfaceForceLaw,
        sizes: [f64; 2],
    ) -> Result<Self> {
        let points = shell.load_points(place)?;
        Ok(Self::at((element, place.into()), points, law, sizes))
    }

    /// Along the line of a beam, likewise; a place on a shell counts as [`ForcePlace::Line`].
    ///
    /// # Errors
    /// If the beam cannot be evaluated at the points, or the direction of an untwisted one is along
    /// it.
    pub fn along_beam(
        (element, beam): (usize, &Beam),
        place: ForcePlace,
        law: SurfaceForceLaw,
        sizes: [f64; 2],
    ) -> Result<Self> {
        let points = LoadPoints::along(beam, place.axes_on_beam())?;
        Ok(Self::at((element, place), points, law, sizes))
    }

    fn at(
        (element, place): (usize, ForcePlace),
        points: LoadPoints,
        law: SurfaceForceLaw,
        [length, frequency]: [f64; 2],
    ) -> Self {
        let adjoint = |frame: &Motion| frame.inverse().adjoint();
        SurfaceForce {
            element,
            place,
            adjoints: points.frames.iter().map(adjoint).collect(),
            points,
            law,
            length,
            frequency,
        }
    }

    /// Finds the motions and velocities of the points, and those that the function is told.
    fn find(&self, states: &[NodeState], scratch: &mut Scratch) -> Result<()> {
        let LoadPoints {
            frames,
            stations,
            axes,
            ..
        } = &self.points;
        let first = states[0].motion.compose(&frames[0]);
        scratch.relative.clear();
        scratch.twists.clear();
        for ((state, frame), adjoint) in states.iter().zip(frames).zip(&self.adjoints) {
            let carried = state.motion.compose(frame);
            scratch.relative.push(first.relative(&carried).to_dual());
            let twist = adjoint * state.twist;
            scratch.twists.push(DualVector::from_twist(&twist));
        }
        scratch.polars.clear();
        scratch.spins.clear();
        scratch.own_twists.clear();
        scratch.positions.clear();
        scratch.rotations.clear();
        scratch.velocities.clear();
        for (station, axes) in stations.iter().zip(axes) {
            let polar = station.polar(&scratch.relative)?;
            let mut spin = DualVector::zeros();
            let nodes = scratch.relative.iter().zip(&scratch.twists);
            for ((y, twist), shape) in nodes.zip(station.shapes()) {
                let x = polar.rotation.tr_mul(y);
                spin += x.trace_minus_transpose() * *twist * shape;
            }
            let spin = polar.spread_inverse * spin;
            let here = first.compose(&polar.motion());
            let rotation = here.rotation * axes;
            let own = turned(&axes.transpose(), &spin.to_twist());
            scratch.velocities.push(match self.law.frame {
                LoadFrame::Space => turned(&rotation, &own),
                LoadFrame::Follower => own,
            });
            scratch.positions.push(here.position);
            scratch.rotations.push(rotation);
            scratch.own_twists.push(own);
            scratch.spins.push(spin);
            scratch.polars.push(polar);
        }
        let count = stations.len();
        scratch.forces.resize(count, Vector6::zeros());
        for side in &mut scratch.sides {
            side.resize(count, Vector6::zeros());
        }
        scratch.stiffness.resize(count, Matrix6::zeros());
        scratch.damping.resize(count, Matrix6::zeros());
        Ok(())
    }

    /// Calls the function; `side` is where the forces go, if not to `scratch.forces` with tangents.
    fn call(
        &self,
        time: f64,
        scratch: &mut Scratch,
        side: Option<usize>,
        with_tangents: bool,
    ) -> Result<()> {
        let Scratch {
            positions,
            rotations,
            velocities,
            forces,
            sides,
            stiffness,
            damping,
            ..
        } = scratch;
        let forces = match side {
            None => forces,
            Some(side) => &mut sides[side],
        };
        forces.fill(Vector6::zeros());
        if with_tangents {
            stiffness.fill(Matrix6::zeros());
            damping.fill(Matrix6::zeros());
        }
        let input = SurfaceForceInput {
            time,
            element: self.element,
            place: self.place,
            places: &self.points.places,
            sizes: &self.points.sizes,
            positions,
            rotations,
            velocities,
        };
        let mut output = SurfaceForceOutput {
            forces,
            tangents: with_tangents.then_some([stiffness, damping]),
        };
        (self.law.function)(&input, &mut output)?;
        for (k, force) in output.forces.iter().enumerate() {
            if let Some(i) = force.iter().position(|x| !x.is_finite()) {
                let what = format!("{} {}", COMPONENTS[i], self.name(k));
                return Err(not_finite(&what, time, force[i]));
            }
        }
        if let Some([stiffness, damping]) = output.tangents {
            for (tangents, kind) in [(stiffness, "motion"), (damping, "velocity")] {
                for (k, tangent) in tangents.iter().enumerate() {
                    if let Some(at) = tangent.iter().position(|x| !x.is_finite()) {
                        let what = format!(
                            "derivative of {} {} by component {} of its {kind}",
                            COMPONENTS[at % 6],
                            self.name(k),
                            at / 6 + 1,
                        );
                        return Err(not_finite(&what, time, tangent[at]));
                    }
                }
            }
        }
        Ok(())
    }

    /// Where a point is, for messages.
    fn name(&self, point: usize) -> String {
        let [xi, eta] = self.points.places[point];
        match self.place.on_shell() {
            None => format!("on beam element {} at {xi}", self.element),
            Some(_) => format!("on shell element {} at ({xi}, {eta})", self.element),
        }
    }

    /// Writes differences of the forces, of second order, to `scratch.stiffness` and
    /// `scratch.damping`: all points at once, as none depends on another.
    fn difference(&self, time: f64, scratch: &mut Scratch) -> Result<()> {
        let frame = self.law.frame;
        scratch.keep();
        for component in 0..6 {
            let size = if component < 3 { self.length } else { 1.0 };
            let h = difference_step(size);
            for (side, step) in [h, -h].into_iter().enumerate() {
                scratch.displace(frame, component, step);
                self.call(time, scratch, Some(side), false)?;
                scratch.restore();
            }
            let [up, down] = &scratch.sides;
            for ((k, up), down) in scratch.stiffness.iter_mut().zip(up).zip(down) {
                k.set_column(component, &((up - down) / (2.0 * h)));
            }

            let fastest = |m: f64, v: &Vector6<f64>| m.max(v[component].abs());
            let fastest = scratch.velocities.iter().fold(0.0, fastest);
            let h = difference_step((size * self.frequency).max(fastest));
            for (side, step) in [h, -h].into_iter().enumerate() {
                let all = scratch.velocities.iter_mut();
                all.for_each(|v| v[component] += step);
                self.call(time, scratch, Some(side), false)?;
                scratch.restore();
            }
            let [up, down] = &scratch.sides;
            for ((c, up), down) in scratch.damping.iter_mut().zip(up).zip(down) {
                c.set_column(component, &((up - down) / (2.0 * h)));
            }
        }
        Ok(())
    }

    /// The user's forces at the points, in the user's axes.
    ///
    /// # Errors
    /// What the function fails with, or if the nodes are too far apart.
    pub fn forces(&self, time: f64, states: &[NodeState]) -> Result<Vec<Vector6<f64>>> {
        let mut scratch = Scratch::default();
        self.find(states, &mut scratch)?;
        self.call(time, &mut scratch, None, false)?;
        Ok(scratch.forces)
    }

    /// The user's tangents next to differences, in the user's axes.
    ///
    /// # Errors
    /// As of [`SurfaceForce::forces`].
    pub fn tangent_pairs(&self, time: f64, states: &[NodeState]) -> Result<PointTangents> {
        let mut scratch = Scratch::default();
        self.find(states, &mut scratch)?;
        self.call(time, &mut scratch, None, true)?;
        let given = [scratch.stiffness.clone(), scratch.damping.clone()];
        self.difference(time, &mut scratch)?;
        Ok(PointTangents {
            given,
            differenced: [scratch.stiffness, scratch.damping],
        })
    }
}

impl Element for SurfaceForce {
    fn nodes(&self) -> &[usize] {
        &self.points.nodes
    }

    fn has_damping(&self) -> bool {
        true
    }

    fn knows_inertial_frame(&self) -> bool {
        true
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        // Taken out while `out` is written to.
        let mut scratch = std::mem::take(&mut out.scratch.surface_force);
        let result = self.add_forces(instant, &mut scratch, out);
        out.scratch.surface_force = scratch;
        result
    }
}

impl SurfaceForce {
    fn add_forces(
        &self,
        instant: &Instant,
        scratch: &mut Scratch,
        out: &mut Contribution,
    ) -> Result<()> {
        let tangents = out.with_tangents;
        self.find(instant.nodes, scratch)?;
        let given = tangents && self.law.gives_tangents;
        self.call(instant.time, scratch, None, given)?;
        if tangents && !given {
            self.difference(instant.time, scratch)?;
        }
        if tangents {
            scratch.load.clear_blocks(instant.nodes.len());
        }
        for point in 0..self.points.stations.len() {
            self.add_point(point, scratch, out);
        }
        if tangents {
            scratch
                .load
                .add_blocks(&self.points.frames, instant.nodes.len(), out);
        }
        Ok(())
    }

    /// Adds what acts at one point.
    fn add_point(&self, point: usize, scratch: &mut Scratch, out: &mut Contribution) {
        let station = &self.points.stations[point];
        let (axes, size) = (&self.points.axes[point], self.points.sizes[point]);
        let polar = scratch.polars[point];
        // Applied forces count negative.
        let (force, back) = match self.law.frame {
            LoadFrame::Follower => (scratch.forces[point] * size, None),
            LoadFrame::Space => {
                let back = scratch.rotations[point].transpose();
                (turned(&back, &scratch.forces[point]) * size, Some(back))
            }
        };
        let wrench = DualVector::from_wrench(&turned(axes, &force));
        let mu = polar.spread_inverse * wrench;
        scratch.by_motion.clear();
        scratch.load.terms.clear();
        let to_axes = turn_of_both(&axes.transpose());
        let nodes = scratch.relative.iter().zip(&self.adjoints);
        for (a, ((y, adjoint), shape)) in nodes.zip(station.shapes()).enumerate() {
            let x = polar.rotation.tr_mul(y);
            let turn = polar.spread_inverse * x.trace_minus_transpose() * shape;
            let by_motion = to_axes * turn.to_twist_matrix() * adjoint;
            out.add_force(a, &-by_motion.tr_mul(&force));
            scratch.by_motion.push(by_motion);
            scratch.load.terms.push(PointTerms::new(shape, x, turn));
        }
        if !out.with_tangents {
            return;
        }
        scratch.load.add_tangents(&polar, &mu, &DualMatrix::zeros());
        self.find_rates(point, (&polar, &to_axes), scratch);
        let (mut k, mut c) = (
            scratch.stiffness[point] * size,
            scratch.damping[point] * size,
        );
        if let Some(back) = back {
            // As of forces on nodes, see `UserForce`.
            let (back, ahead) = (turn_of_both(&back), turn_of_both(&back.transpose()));
            k = back * k * ahead;
            c = back * c * ahead;
            k += skews(&force) - c * skews(&scratch.own_twists[point]);
        }
        for (b, (by_motion, rate)) in scratch.by_motion.iter().zip(&scratch.rates).enumerate() {
            let (by_b, by_velocity) = (k * by_motion + c * rate, c * by_motion);
            for (a, row) in scratch.by_motion.iter().enumerate() {
                out.add_stiffness(a, b, &-row.tr_mul(&by_b));
                out.add_damping(a, b, &-row.tr_mul(&by_velocity));
            }
        }
    }

    /// What the velocity of a point varies by with the motion, at constant twists of the nodes.
    ///
    /// As `δV = (δρ)˙ + V × δρ` for the point and for each node alike, and `δρ = Σ T_b Δu_b`, that
    /// is `Ṫ_b − T_b Ṽ_b + Ṽ T_b`, with `Ṫ_b = A⁻¹ (N_b Ċ_b − Ȧ T_b)`.
    fn find_rates(
        &self,
        point: usize,
        (polar, to_axes): (&DualPolar, &Matrix6<f64>),
        scratch: &mut Scratch,
    ) {
        let spin = scratch.spins[point];
        let mut s_rate = DualMatrix::zeros();
        let x_rate = |x: &DualMatrix, twist: &DualVector| x.times_skew(twist) - spin.skew_times(x);
        for (node, twist) in scratch.load.terms.iter().zip(&scratch.twists) {
            s_rate += x_rate(&node.x, twist) * node.shape;
        }
        let a_rate = s_rate.trace_minus();
        scratch.rates.clear();
        let nodes = scratch.load.terms.iter().zip(&scratch.twists);
        for ((node, twist), adjoint) in nodes.zip(&self.adjoints) {
            let c_rate = x_rate(&node.x, twist).trace_minus_transpose();
            let turn_rate = polar.spread_inverse * (c_rate * node.shape - a_rate * node.turn);
            let rate = turn_rate - node.turn.times_skew(twist) + spin.skew_times(&node.turn);
            let rate = to_axes * rate.to_twist_matrix() * adjoint;
            scratch.rates.push(rate);
        }
    }
}
