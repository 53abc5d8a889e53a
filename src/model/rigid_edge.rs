//! Nodes that move as one body: edges of shells that are welded to bodies, beams and the ground.

use super::Model;
use super::joint::JointDefinition;
use crate::elements::JointKind;
use crate::error::{Error, Result};
use crate::motion::Motion;
use nalgebra::Matrix3;
use std::collections::HashSet;
use std::ops::Range;

impl Model {
    /// Joins nodes rigidly to `body`, one of the nodes or any other (`None` is the ground), by a
    /// rigid joint each: such as the nodes along an edge of a shell, which then is a rigid edge
    /// that bodies, ends of beams and joints can be on. Returns the ids of the joints, which follow
    /// each other in the order of the nodes; the body comes first in each, and frames are at the
    /// nodes, with axes parallel to the inertial ones.
    ///
    /// `body` itself, and what a rigid joint joins to it already, is left out, so that edges with a
    /// common corner may be joined to one body.
    ///
    /// # Errors
    /// If a node does not exist or is named twice, or if none is left to be joined.
    pub fn add_rigid_joints(
        &mut self,
        body: Option<usize>,
        nodes: &[usize],
    ) -> Result<Range<usize>> {
        if let Some(body) = body {
            self.require_node("body", body)?;
        }
        self.require_distinct_nodes(nodes)?;
        let there = self
            .joints
            .iter()
            .filter_map(|joint| joined_to(joint, body));
        let there: HashSet<Option<usize>> = there.chain([body]).collect();
        let new = nodes.iter().filter(|&&node| !there.contains(&Some(node)));
        let new: Vec<usize> = new.copied().collect();
        if new.is_empty() {
            let expected = "at least one that is not joined to the body yet";
            return Err(Error::value("nodes", expected, "none"));
        }
        let first = self.joints.len();
        for node in new {
            let frame = Motion::new(Matrix3::identity(), self.nodes[node].position);
            self.add_joint(JointKind::Rigid, body, Some(node), &frame, &frame)?;
        }
        Ok(first..self.joints.len())
    }
}

/// The other side of a rigid joint on a body.
fn joined_to(joint: &JointDefinition, body: Option<usize>) -> Option<Option<usize>> {
    let (first, second) = (joint.first.node, joint.second.node);
    match joint.kind {
        JointKind::Rigid if first == body => Some(second),
        JointKind::Rigid if second == body => Some(first),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use nalgebra::Vector3;

    fn nodes(count: usize) -> Model {
        let mut model = Model::new();
        for k in 0..count {
            let place = Vector3::new(k as f64, 0.0, 0.0);
            let node = Motion::new(Matrix3::identity(), place);
            model.add_node(&node).unwrap();
        }
        model
    }

    #[test]
    fn what_is_joined_already_is_left_out() {
        let mut model = nodes(6);
        assert_eq!(model.add_rigid_joints(Some(0), &[2, 0, 3]).unwrap(), 0..2);
        assert_eq!(model.add_rigid_joints(Some(0), &[3, 4]).unwrap(), 2..3);
        // Node 5 first, the body second.
        let frame = Motion::identity();
        let rigid = JointKind::Rigid;
        model
            .add_joint(rigid, Some(5), Some(0), &frame, &frame)
            .unwrap();
        assert_eq!(model.add_rigid_joints(Some(0), &[5, 1]).unwrap(), 4..5);
        let sides = |joint: &JointDefinition| [joint.first.node, joint.second.node];
        let found: Vec<_> = model.joints.iter().map(sides).collect();
        let expected = [[0, 2], [0, 3], [0, 4], [5, 0], [0, 1]];
        assert_eq!(found, expected.map(|sides| sides.map(Some)));
        // Each frame is where the node is.
        let at = model.nodes[0].compose(&model.joints[2].first.offset);
        assert_eq!(at.position, Vector3::new(4.0, 0.0, 0.0));
    }

    #[test]
    fn refused_nodes_change_nothing() {
        let mut model = nodes(3);
        for (body, nodes, kind, message) in [
            (Some(3), vec![0], ErrorKind::Identifier, "body: "),
            (None, vec![0, 3], ErrorKind::Identifier, "nodes"),
            (None, vec![1, 1], ErrorKind::Value, "nodes"),
            (
                Some(1),
                vec![1],
                ErrorKind::Value,
                "nodes: expected at least one",
            ),
            (None, vec![], ErrorKind::Size, "nodes"),
        ] {
            let error = model.add_rigid_joints(body, &nodes).unwrap_err();
            assert_eq!(error.kind(), kind, "{error}");
            assert!(error.to_string().starts_with(message), "{error}");
            assert_eq!(model.joint_count(), 0);
        }
    }
}
