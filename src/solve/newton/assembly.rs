//! Joints that have closed the wrong way round.
//!
//! Constraints are zeros of direction cosines: they hold as well in a joint that is turned over,
//! its axes against each other. From a start far off, Newton's method may find that assembly. It is
//! none.

use crate::collocation::GridState;
use crate::elements::{Element, JointKind, Measure, NodeState, RelativeMotion};
use crate::system::System;

/// Largest cosine of a constraint of a joint that counts as closed.
const CLOSED: f64 = 1e-3;

/// Whether the angles that the joint holds are where it holds them.
fn is_closed(kind: JointKind, relative: &RelativeMotion) -> bool {
    (0..kind.constraints())
        .filter(|&index| kind.measure(index) == Measure::Angle)
        .all(|index| kind.constraint(index, relative).value.abs() < CLOSED)
}

/// Names the first joint that is closed, but turned over, at some grid point.
pub(crate) fn describe_turned_over(system: &System, state: &GridState) -> Option<String> {
    let mut states = Vec::new();
    for (index, joint) in system.joints().iter().enumerate() {
        for k in 0..state.points() {
            states.clear();
            let motions = joint.nodes().iter().map(|&n| state.node(n)[k]);
            states.extend(motions.map(NodeState::at_rest));
            let relative = joint.relative_motion(&states);
            if let Some(axis) = joint.kind().turned_over(&relative)
                && is_closed(joint.kind(), &relative)
            {
                return Some(format!(
                    "joint {index} ({}) has closed turned over: axis {} of its second frame \
                     points against that \
                     of its first, at grid point {k}. Start nearer to the assembled mechanism, or \
                     turn the frame",
                    joint.kind().name(),
                    axis + 1
                ));
            }
        }
    }
    None
}
