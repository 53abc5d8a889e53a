//! Joint coordinates whose whole turns are followed.

use super::System;
use crate::elements::{Element, NodeState};
use crate::model::JointCoordinate;
use crate::motion::Motion;

impl System {
    /// Place of a joint coordinate among those whose turns are followed.
    pub fn tracked_place(&self, at: &JointCoordinate) -> Option<usize> {
        self.tracked.iter().position(|tracked| tracked == at)
    }

    /// Adds turns that a joint coordinate gains wherever it is followed.
    pub(crate) fn add_to_tracked(&self, at: &JointCoordinate, gain: f64, coordinates: &mut [f64]) {
        let all = self.tracked.iter().zip(coordinates);
        all.filter(|(tracked, _)| *tracked == at)
            .for_each(|(_, q)| *q += gain);
    }

    /// Number of coordinates whose turns are followed.
    pub fn tracked(&self) -> usize {
        self.tracked.len()
    }

    /// Number of those that forces and relations act on: the first.
    pub fn acted_on(&self) -> usize {
        self.acted_on
    }

    /// Where a node that joints name is; none if it is not in this part of a system.
    fn place_of(&self, node: usize) -> Option<usize> {
        match &self.places {
            Some(places) => places.get(node).copied().flatten(),
            None => Some(node),
        }
    }

    /// Follows the tracked coordinates from their last values to those of the given states.
    pub fn track(&self, state: impl Fn(usize) -> NodeState, coordinates: &mut [f64]) {
        for (at, last) in self.tracked.iter().zip(coordinates) {
            let joint = &self.joints[at.joint];
            let mut states = [NodeState::at_rest(Motion::identity()); 2];
            let nodes = joint.nodes();
            if !nodes.iter().all(|&node| self.place_of(node).is_some()) {
                continue;
            }
            let places = nodes.iter().filter_map(|&node| self.place_of(node));
            for (out, node) in states.iter_mut().zip(places) {
                *out = state(node);
            }
            let z = joint.relative_motion(&states);
            let value = joint.kind().coordinate_value(at.coordinate, &z);
            *last = joint.kind().follow(at.coordinate, value, *last);
        }
    }

    /// Moves the tracked coordinates on by what velocities and accelerations at `state` make of
    /// them in `time`, so that they may then be followed through more than half a turn.
    pub fn foresee(&self, state: impl Fn(usize) -> NodeState, time: f64, coordinates: &mut [f64]) {
        for (at, last) in self.tracked.iter().zip(coordinates) {
            let joint = &self.joints[at.joint];
            let states: Vec<NodeState> = joint.nodes().iter().map(|&n| state(n)).collect();
            let [_, rate, acceleration] = joint.coordinate_derivatives(at.coordinate, &states);
            let change = time * (rate + 0.5 * time * acceleration);
            if change.is_finite() {
                *last += change;
            }
        }
    }
}
