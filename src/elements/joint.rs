//! Joints between two frames, and joint coordinates prescribed by a signal (docs/theory.md, section
//! 6.9).

use super::relative::{Coordinate, JointKind};
use super::scalar_function::{RelativeMotion, ScalarFunction};
use super::{Contribution, Element, Instant, NodeState, Unknown};
use crate::error::Result;
use crate::motion::{DualVector, Motion, product, transposed_product};
use nalgebra::{Matrix6, Vector6};
use serde::{Deserialize, Serialize};

/// A joint frame fixed to a node or, without one, to the ground.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Attachment {
    /// Index of the node; `None` for the ground.
    pub node: Option<usize>,
    /// Motion of the joint frame relative to the node, or to the inertial frame.
    pub offset: Motion,
}

/// The two frames of a joint, and the relative kinematics that everything attached to it shares.
#[derive(Debug, Clone)]
pub(super) struct FramePair {
    first: Attachment,
    second: Attachment,
    nodes: Vec<usize>,
    /// Where the nodes of both are among those of the element, if they have any.
    places: [usize; 2],
}

/// Relative motion at one instant, and its derivatives.
#[derive(Debug, Clone)]
pub(super) struct RelativeState {
    /// `Z = C_i⁻¹ C_j`.
    pub z: RelativeMotion,
    /// `ż`: twist of the second frame relative to the first, resolved in the second.
    pub rate: Vector6<f64>,
    /// `Ad(Z⁻¹) V_i`, the first frame's twist seen from the second.
    carried: Vector6<f64>,
    /// `δz = Σ J_a δu_a` over the element's nodes.
    jacobians: [Option<Matrix6<f64>>; 2],
    /// Places of these nodes in the element.
    places: [usize; 2],
    first_carry: Option<Matrix6<f64>>,
}

impl FramePair {
    pub fn new(first: Attachment, second: Attachment) -> Self {
        FramePair {
            first,
            second,
            nodes: first.node.into_iter().chain(second.node).collect(),
            places: [0, usize::from(first.node.is_some())],
        }
    }

    /// The same pair in an element on these nodes, which its own are among.
    pub fn among(mut self, nodes: &[usize]) -> Self {
        let place = |end: &Attachment| nodes.iter().position(|&node| Some(node) == end.node);
        self.places = [&self.first, &self.second].map(|end| place(end).unwrap_or(0));
        self
    }

    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// Length that positions of the frames are rounded relative to.
    pub fn extent(&self, states: &[NodeState]) -> f64 {
        let nodes = states.iter().map(|state| state.motion.position.norm());
        let offsets = [&self.first, &self.second].map(|a| a.offset.position.norm());
        nodes.chain(offsets).fold(0.0, f64::max)
    }

    fn frames(&self, states: &[NodeState]) -> (Motion, Motion) {
        let frame = |end: &Attachment, place: usize| match (end.node, states.get(place)) {
            (Some(_), Some(state)) => state.motion.compose(&end.offset),
            _ => end.offset,
        };
        let [first, second] = self.places;
        (frame(&self.first, first), frame(&self.second, second))
    }

    pub fn relative_motion(&self, states: &[NodeState]) -> RelativeMotion {
        let (first, second) = self.frames(states);
        first.relative(&second)
    }

    pub fn second_frame(&self, states: &[NodeState]) -> Motion {
        self.frames(states).1
    }

    pub fn state(&self, states: &[NodeState]) -> RelativeState {
        let z = self.relative_motion(states);
        let z_inverse = z.inverse();
        let at = |end: &Attachment, place: usize| {
            end.node
                .map(|_| (end.offset.inverse(), states[place].twist))
        };
        let [first, second] = self.places;
        let (first, second) = (at(&self.first, first), at(&self.second, second));
        let carries = first.map(|(carry, v)| (z_inverse.compose(&carry).adjoint(), v));
        let own = second.map(|(carry, v)| (carry.adjoint(), v));
        let twist = |side: &Option<(Matrix6<f64>, Vector6<f64>)>| {
            side.as_ref().map_or(Vector6::zeros(), |(j, v)| j * v)
        };
        let (carried, rate) = (twist(&carries), twist(&own));
        let jacobians = [carries.map(|(j, _)| -j), own.map(|(j, _)| j)];
        RelativeState {
            z,
            rate: rate - carried,
            carried,
            jacobians,
            places: self.places,
            first_carry: first.map(|(carry, _)| carry.adjoint()),
        }
    }
}

impl RelativeState {
    /// Jacobians of the element's nodes, by local index.
    pub fn local_jacobians(&self) -> impl Iterator<Item = (usize, &Matrix6<f64>)> {
        let both = self.places.into_iter().zip(&self.jacobians);
        both.filter_map(|(place, jacobian)| Some((place, jacobian.as_ref()?)))
    }

    /// Variation of `ż` with the relative motion: `Δż = −(Ad(Z⁻¹) V_i)~ Δz`.
    pub fn rate_variation(&self) -> Matrix6<f64> {
        -DualVector::from_twist(&self.carried)
            .skew()
            .to_twist_matrix()
    }

    /// Adds the nodal forces of a wrench conjugate to `δz`; with its variations `∂w/∂z` and
    /// `∂w/∂ż` also their tangents.
    pub fn add_wrench(
        &self,
        wrench: &Vector6<f64>,
        variation: &Matrix6<f64>,
        damping: Option<&Matrix6<f64>>,
        out: &mut Contribution,
    ) {
        for (a, jacobian) in self.local_jacobians() {
            out.add_force(a, &transposed_product(jacobian, wrench));
        }
        let is_none = wrench.iter().chain(variation).all(|x| *x == 0.0) && damping.is_none();
        if !out.with_tangents || is_none {
            return;
        }
        for (a, left) in self.local_jacobians() {
            let left = left.transpose();
            let mut rows = product(&left, variation);
            if let Some(carry) = self.first_carry.as_ref().filter(|_| a == self.places[0]) {
                // The first frame's lever arm turns with Z: −Δ(Z w) = Z w̃ Δz.
                let turn = self.z.to_dual() * DualVector::from_wrench(wrench).skew();
                rows += transposed_product(carry, &turn.to_stiffness_matrix());
            }
            for (b, right) in self.local_jacobians() {
                out.add_stiffness(a, b, &product(&rows, right));
                if let Some(damping) = damping {
                    out.add_damping(a, b, &product(&product(&left, damping), right));
                }
            }
        }
    }

    /// Adds the gradient of own equation `row`, which is also that of the forces by own unknown
    /// `row`.
    pub fn add_gradient(&self, row: usize, gradient: &Vector6<f64>, out: &mut Contribution) {
        for (a, jacobian) in self.local_jacobians() {
            let mut columns = out.gradient.fixed_view_mut::<1, 6>(row, 6 * a);
            columns += transposed_product(jacobian, gradient).transpose();
        }
    }

    /// Adds constraints, row by row with their multipliers: violations, gradients, and the forces
    /// of the multipliers.
    pub fn add_constraints(
        &self,
        functions: impl Iterator<Item = ScalarFunction>,
        multipliers: &[f64],
        out: &mut Contribution,
    ) {
        // Forces are linear in the wrench: one transformation for all.
        let mut wrench = Vector6::zeros();
        let mut variation = Matrix6::zeros();
        for (row, (function, multiplier)) in functions.zip(multipliers).enumerate() {
            out.constraint[row] += function.value;
            wrench += function.gradient * *multiplier;
            if out.with_tangents {
                self.add_gradient(row, &function.gradient, out);
                variation += function.hessian * *multiplier;
            }
        }
        self.add_wrench(&wrench, &variation, None, out);
    }
}

/// A joint: its kind and two frames.
#[derive(Debug, Clone)]
pub struct Joint {
    pub(super) pair: FramePair,
    kind: JointKind,
}

impl Joint {
    /// A joint of `kind` between two frames.
    pub fn new(kind: JointKind, first: Attachment, second: Attachment) -> Self {
        Joint {
            pair: FramePair::new(first, second),
            kind,
        }
    }

    /// Its two frames.
    pub fn attachments(&self) -> (Attachment, Attachment) {
        (self.pair.first, self.pair.second)
    }

    /// Kind of the joint.
    pub fn kind(&self) -> JointKind {
        self.kind
    }

    /// Motion of the second frame relative to the first, for the element's nodes at `states`.
    pub fn relative_motion(&self, states: &[NodeState]) -> RelativeMotion {
        self.pair.relative_motion(states)
    }

    /// A coordinate, without its whole turns, and its first and second derivative in time.
    pub fn coordinate_derivatives(&self, which: Coordinate, states: &[NodeState]) -> [f64; 3] {
        let state = self.pair.state(states);
        let q = self.kind.coordinate(which, &state.z);
        // ż = J_j V_j + J_i V_i, and the carried velocity of the first frame changes with Z.
        let own: Vector6<f64> = state
            .local_jacobians()
            .map(|(local, jacobian)| jacobian * states[local].twist_rate)
            .sum();
        let acceleration = own + state.rate_variation() * state.rate;
        [
            q.value,
            q.gradient.dot(&state.rate),
            q.gradient.dot(&acceleration) + (q.hessian * state.rate).dot(&state.rate),
        ]
    }

    /// Gives what a coordinate varies by with the increment of each of the element's nodes.
    pub fn vary_coordinate(
        &self,
        which: Coordinate,
        states: &[NodeState],
        mut add: impl FnMut(usize, Vector6<f64>),
    ) {
        let state = self.pair.state(states);
        let gradient = self.kind.coordinate(which, &state.z).gradient;
        for (local, jacobian) in state.local_jacobians() {
            add(local, transposed_product(jacobian, &gradient));
        }
    }

    /// Motion of the second joint frame.
    pub fn second_frame(&self, states: &[NodeState]) -> Motion {
        self.pair.second_frame(states)
    }

    /// Constraint wrench on the second body at its joint frame, resolved in that frame.
    pub fn reaction(&self, states: &[NodeState], multipliers: &[f64]) -> Vector6<f64> {
        let z = self.relative_motion(states);
        multipliers
            .iter()
            .enumerate()
            .map(|(row, multiplier)| self.kind.constraint(row, &z).gradient * -multiplier)
            .sum()
    }

    /// Gives what `by_wrench` times the reaction, `relative` times the increment of the relative
    /// motion, and `second` times that of the second frame, add up to: the factors of the
    /// increments of the element's nodes, and of its multipliers.
    pub fn vary_reaction(
        &self,
        states: &[NodeState],
        (multipliers, by_own): (&[f64], &mut [f64]),
        by_wrench: &Vector6<f64>,
        [relative, second]: [&Vector6<f64>; 2],
        mut add: impl FnMut(usize, Vector6<f64>),
    ) {
        let state = self.pair.state(states);
        let mut by_motion = *relative;
        for (row, (multiplier, by_own)) in multipliers.iter().zip(by_own).enumerate() {
            let function = self.kind.constraint(row, &state.z);
            *by_own = -function.gradient.dot(by_wrench);
            by_motion -= function.hessian.tr_mul(by_wrench) * *multiplier;
        }
        let last = self.pair.nodes().len().wrapping_sub(1);
        for (local, jacobian) in state.local_jacobians() {
            let mut row = transposed_product(jacobian, &by_motion);
            if local == last && state.jacobians[1].is_some() {
                row += transposed_product(jacobian, second);
            }
            add(local, row);
        }
    }
}

impl Element for Joint {
    fn nodes(&self) -> &[usize] {
        self.pair.nodes()
    }

    fn own_unknowns(&self) -> usize {
        self.kind.constraints()
    }

    fn unknown(&self, index: usize) -> Unknown {
        Unknown::Multiplier(self.kind.measure(index))
    }

    fn potential(&self, _: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        Ok(Some(0.0))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let state = self.pair.state(instant.nodes);
        let functions = (0..self.own_unknowns()).map(|row| self.kind.constraint(row, &state.z));
        state.add_constraints(functions, instant.multipliers, out);
        Ok(())
    }
}

/// A joint coordinate that follows a signal; minus its multiplier is the driving effort.
#[derive(Debug, Clone)]
pub struct Prescribed {
    pair: FramePair,
    kind: JointKind,
    coordinate: Coordinate,
    signal: usize,
}

impl Prescribed {
    /// Prescribes `coordinate` of `joint` by signal number `signal`.
    pub fn new(joint: &Joint, coordinate: Coordinate, signal: usize) -> Self {
        Prescribed {
            pair: joint.pair.clone(),
            kind: joint.kind,
            coordinate,
            signal,
        }
    }
}

impl Element for Prescribed {
    fn nodes(&self) -> &[usize] {
        self.pair.nodes()
    }

    fn own_unknowns(&self) -> usize {
        1
    }

    fn unknown(&self, _index: usize) -> Unknown {
        Unknown::Multiplier(self.coordinate.measure())
    }

    fn potential(&self, _: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        Ok(Some(0.0))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let state = self.pair.state(instant.nodes);
        let mut function = self.kind.coordinate(self.coordinate, &state.z);
        let target = instant.signals[self.signal];
        function.value = self.kind.follow(self.coordinate, function.value, target) - target;
        state.add_constraints(std::iter::once(function), instant.multipliers, out);
        Ok(())
    }
}
