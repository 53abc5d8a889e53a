//! Forces on nodes that a function of the user computes.
//! See docs/theory.md, section 6.12.

use super::coordinate_force::difference_step;
use super::load::LoadFrame;
use super::{Contribution, Element, Instant, NodeState};
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{Motion, rotation_from_vector, skew, turn_of_both, turned};
use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// What a [`NodeForceFunction`] may depend on: time, and motions of its nodes, in their order.
#[derive(Debug, Clone, Copy)]
pub struct NodeForceInput<'a> {
    /// Time.
    pub time: f64,
    /// Positions, in the inertial frame.
    pub positions: &'a [Vector3<f64>],
    /// Rotation matrices; their columns are the nodes' axes in the inertial frame.
    pub rotations: &'a [Matrix3<f64>],
    /// `[velocity; angular velocity]` relative to the inertial frame, along its or the nodes' own
    /// axes. In a frame that turns steadily, positions, rotations and these are along its axes.
    pub velocities: &'a [Vector6<f64>],
    /// Nodes whose motions tangents are by: all, or the own one of each force if nodes are apart.
    pub columns: usize,
}

/// Where a [`NodeForceFunction`] writes; everything is zero at first.
///
/// All is resolved in the same axes as the velocities. Increments are `[displacement; turn]` of
/// each node; derivatives by motion are at fixed components of the velocities.
#[derive(Debug)]
pub struct NodeForceOutput<'a> {
    /// `[force; moment]` on each node.
    pub forces: &'a mut [Vector6<f64>],
    /// `∂force/∂increment` and `∂force/∂velocity`, `6 n × 6 n`, if wanted; `6 n × 6`, of each node
    /// by its own motion, if nodes are apart.
    pub tangents: Option<(&'a mut DMatrix<f64>, &'a mut DMatrix<f64>)>,
}

/// A user's function for the forces on some nodes.
pub type NodeForceFunction =
    Arc<dyn Fn(&NodeForceInput, &mut NodeForceOutput) -> Result<()> + Send + Sync>;

/// A user's forces on nodes, as the model keeps them.
#[derive(Clone)]
pub struct NodeForceLaw {
    /// The function.
    pub function: NodeForceFunction,
    /// Whether it gives tangents; otherwise they are differenced.
    pub gives_tangents: bool,
    /// Axes of velocities, forces and tangents: inertial, or of the nodes.
    pub frame: LoadFrame,
}

impl fmt::Debug for NodeForceLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("NodeForceLaw")
            .field("gives_tangents", &self.gives_tangents)
            .field("frame", &self.frame)
            .finish_non_exhaustive()
    }
}

/// Forces of a user on nodes.
#[derive(Debug, Clone)]
pub struct UserForce {
    nodes: Vec<usize>,
    law: NodeForceLaw,
    /// What positions and velocities are of the order of: length, and length and turn for a unit of
    /// time.
    length: f64,
    frequency: f64,
    /// Whether the force on each node depends on its own motion alone.
    apart: bool,
}

/// Arguments and results of the user's function; kept between evaluations.
#[derive(Debug, Clone, Default)]
pub(super) struct Scratch {
    positions: Vec<Vector3<f64>>,
    rotations: Vec<Matrix3<f64>>,
    velocities: Vec<Vector6<f64>>,
    forces: Vec<Vector6<f64>>,
    /// What is moved for differences, as it was.
    kept: Vec<(Motion, Vector6<f64>)>,
    /// Forces to either side, for differences.
    sides: [Vec<Vector6<f64>>; 2],
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
}

/// Which of two tangents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tangent {
    /// By motion.
    Stiffness,
    /// By velocity.
    Damping,
}

/// Given and differenced tangents, by motion and by velocity.
pub struct TangentPairs {
    /// What the user's function gives.
    pub given: [DMatrix<f64>; 2],
    /// What differences of its forces give.
    pub differenced: [DMatrix<f64>; 2],
}

pub(super) const COMPONENTS: [&str; 6] = [
    "force 1", "force 2", "force 3", "moment 1", "moment 2", "moment 3",
];

impl Scratch {
    /// `columns`: of tangents, none if these are not wanted.
    fn load(&mut self, frame: LoadFrame, states: &[NodeState], columns: usize) {
        let n = states.len();
        self.positions.clear();
        self.rotations.clear();
        self.velocities.clear();
        for state in states {
            let r = state.motion.rotation;
            self.positions.push(state.motion.position);
            self.rotations.push(r);
            self.velocities.push(match frame {
                LoadFrame::Space => turned(&r, &state.twist),
                LoadFrame::Follower => state.twist,
            });
        }
        self.forces.resize(n, Vector6::zeros());
        for side in &mut self.sides {
            side.resize(n, Vector6::zeros());
        }
        if columns > 0 && self.stiffness.shape() != (6 * n, columns) {
            self.stiffness = DMatrix::zeros(6 * n, columns);
            self.damping = DMatrix::zeros(6 * n, columns);
        }
    }

    /// Keeps the motions and velocities of some nodes.
    fn keep(&mut self, nodes: Range<usize>) {
        self.kept.clear();
        for node in nodes {
            let motion = Motion::new(self.rotations[node], self.positions[node]);
            self.kept.push((motion, self.velocities[node]));
        }
    }

    /// Brings them back.
    fn restore(&mut self, nodes: Range<usize>) {
        for (node, (motion, velocity)) in nodes.zip(&self.kept) {
            self.rotations[node] = motion.rotation;
            self.positions[node] = motion.position;
            self.velocities[node] = *velocity;
        }
    }

    /// Moves node `node` by `step` along component `component`.
    fn displace(&mut self, frame: LoadFrame, node: usize, component: usize, step: f64) {
        let mut u = Vector6::zeros();
        u[component] = step;
        let motion = Motion::new(self.rotations[node], self.positions[node]);
        let moved = moved(frame, &motion, &u);
        self.rotations[node] = moved.rotation;
        self.positions[node] = moved.position;
    }
}

/// A motion after an increment along its own or the inertial axes.
pub(super) fn moved(frame: LoadFrame, motion: &Motion, u: &Vector6<f64>) -> Motion {
    match frame {
        LoadFrame::Follower => motion.increment(u),
        LoadFrame::Space => Motion::new(
            rotation_from_vector(&u.fixed_rows::<3>(3).into_owned()) * motion.rotation,
            motion.position + u.fixed_rows::<3>(0),
        ),
    }
}

/// `[0 ã; 0 b̃]` of a 6-vector `[a; b]`: what turning the axes by `ψ` does is `−` this times
/// `[·; ψ]`, reversed.
pub(super) fn skews(v: &Vector6<f64>) -> Matrix6<f64> {
    let mut m = Matrix6::zeros();
    for half in [0, 3] {
        let block = skew(&v.fixed_rows::<3>(half).into_owned());
        m.fixed_view_mut::<3, 3>(half, 3).copy_from(&block);
    }
    m
}

impl UserForce {
    /// On `nodes`; their motions are of the order of `length`, at the circular frequency
    /// `frequency`.
    pub fn new(nodes: Vec<usize>, law: NodeForceLaw, length: f64, frequency: f64) -> Self {
        UserForce {
            nodes,
            law,
            length,
            frequency,
            apart: false,
        }
    }

    /// The same, whose nodes are apart or not.
    pub fn with_nodes_apart(self, apart: bool) -> Self {
        UserForce { apart, ..self }
    }

    /// Columns of tangents.
    fn columns(&self) -> usize {
        match self.apart {
            true => 6,
            false => 6 * self.nodes.len(),
        }
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
            stiffness.fill(0.0);
            damping.fill(0.0);
        }
        let input = NodeForceInput {
            time,
            positions,
            rotations,
            velocities,
            columns: self.columns() / 6,
        };
        let mut output = NodeForceOutput {
            forces,
            tangents: with_tangents.then_some((stiffness, damping)),
        };
        (self.law.function)(&input, &mut output)?;
        for (local, force) in output.forces.iter().enumerate() {
            if let Some(i) = force.iter().position(|x| !x.is_finite()) {
                let what = format!("{} on node {}", COMPONENTS[i], self.nodes[local]);
                return Err(not_finite(&what, time, force[i]));
            }
        }
        if let Some((stiffness, damping)) = output.tangents {
            for (m, kind) in [(stiffness, "motion"), (damping, "velocity")] {
                if let Some(at) = m.iter().position(|x| !x.is_finite()) {
                    let (row, column) = (at % m.nrows(), at / m.nrows());
                    let by = if self.apart { row / 6 } else { column / 6 };
                    let what = format!(
                        "derivative of {} on node {} by component {} of the {kind} of node {}",
                        COMPONENTS[row % 6],
                        self.nodes[row / 6],
                        column % 6 + 1,
                        self.nodes[by]
                    );
                    return Err(not_finite(&what, time, m[at]));
                }
            }
        }
        Ok(())
    }

    /// Writes differences of the forces, of second order, to `scratch.stiffness` and
    /// `scratch.damping`: of all nodes at once where these are apart.
    fn difference(&self, time: f64, scratch: &mut Scratch) -> Result<()> {
        let turn_rate = self.frequency;
        for column in 0..self.columns() {
            let component = column % 6;
            let moving = match self.apart {
                true => 0..self.nodes.len(),
                false => column / 6..column / 6 + 1,
            };
            let size = if component < 3 { self.length } else { 1.0 };
            scratch.keep(moving.clone());
            let h = difference_step(size);
            for (side, step) in [h, -h].into_iter().enumerate() {
                for node in moving.clone() {
                    scratch.displace(self.law.frame, node, component, step);
                }
                self.call(time, scratch, Some(side), false)?;
                scratch.restore(moving.clone());
            }
            write_slope(&scratch.sides, 2.0 * h, &mut scratch.stiffness, column);

            let fastest = |most: f64, v: &Vector6<f64>| most.max(v[component].abs());
            let fastest = scratch.velocities[moving.clone()].iter().fold(0.0, fastest);
            let h = difference_step((size * turn_rate).max(fastest));
            for (side, step) in [h, -h].into_iter().enumerate() {
                let velocities = &mut scratch.velocities[moving.clone()];
                velocities.iter_mut().for_each(|v| v[component] += step);
                self.call(time, scratch, Some(side), false)?;
                scratch.restore(moving.clone());
            }
            write_slope(&scratch.sides, 2.0 * h, &mut scratch.damping, column);
        }
        Ok(())
    }

    /// The user's forces, in the user's axes.
    pub fn forces(&self, time: f64, states: &[NodeState]) -> Result<Vec<Vector6<f64>>> {
        let mut scratch = Scratch::default();
        scratch.load(self.law.frame, states, 0);
        self.call(time, &mut scratch, None, false)?;
        Ok(scratch.forces)
    }

    /// The user's tangents next to differences, in the user's axes.
    pub fn tangent_pairs(&self, time: f64, states: &[NodeState]) -> Result<TangentPairs> {
        let mut scratch = Scratch::default();
        scratch.load(self.law.frame, states, self.columns());
        self.call(time, &mut scratch, None, true)?;
        let given = [scratch.stiffness.clone(), scratch.damping.clone()];
        self.difference(time, &mut scratch)?;
        Ok(TangentPairs {
            given,
            differenced: [scratch.stiffness, scratch.damping],
        })
    }
}

pub(super) fn not_finite(what: &str, time: f64, got: f64) -> Error {
    Error::new(
        ErrorKind::Callback,
        format!("callback: expected a finite {what} at t = {time}, got {got}"),
    )
}

fn write_slope(
    sides: &[Vec<Vector6<f64>>; 2],
    width: f64,
    matrix: &mut DMatrix<f64>,
    column: usize,
) {
    for (local, (up, down)) in sides[0].iter().zip(&sides[1]).enumerate() {
        let slope = (up - down) / width;
        matrix
            .fixed_view_mut::<6, 1>(6 * local, column)
            .copy_from(&slope);
    }
}

impl Element for UserForce {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn couples_nodes(&self) -> bool {
        !self.apart
    }

    fn has_damping(&self) -> bool {
        true
    }

    fn knows_inertial_frame(&self) -> bool {
        true
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        // Taken out while `out` is written to.
        let mut scratch = std::mem::take(&mut out.scratch.user_force);
        let result = self.add_forces(instant, &mut scratch, out);
        out.scratch.user_force = scratch;
        result
    }
}

impl UserForce {
    fn add_forces(
        &self,
        instant: &Instant,
        scratch: &mut Scratch,
        out: &mut Contribution,
    ) -> Result<()> {
        let tangents = out.with_tangents;
        let columns = if tangents { self.columns() } else { 0 };
        scratch.load(self.law.frame, instant.nodes, columns);
        self.call(
            instant.time,
            scratch,
            None,
            tangents && self.law.gives_tangents,
        )?;
        if tangents && !self.law.gives_tangents {
            self.difference(instant.time, scratch)?;
        }
        for (a, state) in instant.nodes.iter().enumerate() {
            let (force, back) = match self.law.frame {
                LoadFrame::Follower => (scratch.forces[a], None),
                LoadFrame::Space => {
                    let back = state.motion.rotation.transpose();
                    (turned(&back, &scratch.forces[a]), Some(turn_of_both(&back)))
                }
            };
            // Applied forces count negative.
            out.add_force(a, &-force);
            if !tangents {
                continue;
            }
            for (b, other) in instant.nodes.iter().enumerate() {
                let Some((row, column)) = out.place(a, b) else {
                    continue;
                };
                let block = |m: &DMatrix<f64>| m.fixed_view::<6, 6>(row, column).into_owned();
                let (mut k, mut c) = (block(&scratch.stiffness), block(&scratch.damping));
                if let Some(back) = &back {
                    // Increments and velocities in space are R times the material ones, and Δ(R V)
                    // = R ΔV − R Ṽ ψ.
                    let ahead = turn_of_both(&other.motion.rotation);
                    k = back * k * ahead;
                    c = back * c * ahead;
                    k -= c * skews(&other.twist);
                    if a == b {
                        // Δ(Rᵀ F) = Rᵀ ΔF + (Rᵀ F)~ ψ.
                        k += skews(&force);
                    }
                }
                out.add_stiffness(a, column / 6, &-k);
                out.add_damping(a, column / 6, &-c);
            }
        }
        Ok(())
    }
}
