//! Linear spring-damper on a joint coordinate.

use super::joint::{FramePair, Joint};
use super::relative::{Coordinate, JointKind};
use super::{Contribution, Element, Instant};
use crate::error::Result;

/// Effort `k (q − q₀) + c q̇` on a joint coordinate `q`, against its growth.
#[derive(Debug, Clone)]
pub struct SpringDamper {
    pair: FramePair,
    kind: JointKind,
    coordinate: Coordinate,
    /// Place among the tracked coordinates.
    tracked: usize,
    stiffness: f64,
    damping: f64,
    rest: f64,
}

impl SpringDamper {
    /// On `coordinate` of `joint`, which is tracked coordinate number `tracked`.
    pub fn new(
        joint: &Joint,
        coordinate: Coordinate,
        tracked: usize,
        stiffness: f64,
        damping: f64,
        rest: f64,
    ) -> Self {
        SpringDamper {
            pair: joint.pair.clone(),
            kind: joint.kind(),
            coordinate,
            tracked,
            stiffness,
            damping,
            rest,
        }
    }
}

impl Element for SpringDamper {
    fn nodes(&self) -> &[usize] {
        self.pair.nodes()
    }

    fn has_damping(&self) -> bool {
        self.damping != 0.0
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let state = self.pair.state(instant.nodes);
        let q = self.kind.coordinate(self.coordinate, &state.z);
        let last = instant.coordinates[self.tracked];
        let value = self.kind.follow(self.coordinate, q.value, last);
        let rate = q.gradient.dot(&state.rate);
        let effort = self.stiffness * (value - self.rest) + self.damping * rate;
        let rate_variation =
            q.gradient.transpose() * state.rate_variation() + state.rate.transpose() * q.hessian;
        let variation = q.hessian * effort
            + q.gradient
                * (q.gradient.transpose() * self.stiffness + rate_variation * self.damping);
        let damping = q.gradient * q.gradient.transpose() * self.damping;
        state.add_wrench(&(q.gradient * effort), &variation, Some(&damping), out);
        Ok(())
    }
}
