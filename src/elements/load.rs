//! Forces and moments at a point of a body or node, each component a signal.
//! See docs/theory.md, section 6.11.

use super::{Contribution, Element, Instant};
use crate::error::Result;
use crate::motion::{joined, skew};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// How a load's components are directed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum LoadFrame {
    /// Along the inertial axes.
    Space,
    /// Along the node's own axes: the load follows it.
    Follower,
}

/// Force and moment at a point that a node carries.
#[derive(Debug, Clone)]
pub struct NodalLoad {
    nodes: [usize; 1],
    /// The point, in the node's axes.
    offset: Vector3<f64>,
    frame: LoadFrame,
    /// Signal numbers of `[force; moment]`; `None` is zero.
    signals: [Option<usize>; 6],
}

impl NodalLoad {
    /// Load on `node`, at `offset` from its origin along its axes, with components along the axes
    /// of `frame`.
    pub fn new(
        node: usize,
        offset: Vector3<f64>,
        frame: LoadFrame,
        signals: [Option<usize>; 6],
    ) -> Self {
        NodalLoad {
            nodes: [node],
            offset,
            frame,
            signals,
        }
    }
}

impl Element for NodalLoad {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let component = |i: usize| self.signals[i].map_or(0.0, |s| instant.signals[s]);
        let force = Vector3::new(component(0), component(1), component(2));
        let moment = Vector3::new(component(3), component(4), component(5));
        let (force, moment) = match self.frame {
            LoadFrame::Follower => (force, moment),
            LoadFrame::Space => {
                let r = &instant.nodes[0].motion.rotation;
                (r.tr_mul(&force), r.tr_mul(&moment))
            }
        };
        let about_node = moment + self.offset.cross(&force);
        out.add_force(0, &-joined(&force, &about_node));
        if out.with_tangents && self.frame == LoadFrame::Space {
            let mut rows = out.stiffness.fixed_view_mut::<3, 3>(0, 3);
            rows -= skew(&force);
            let mut rows = out.stiffness.fixed_view_mut::<3, 3>(3, 3);
            rows -= skew(&moment) + skew(&self.offset) * skew(&force);
        }
        Ok(())
    }
}
