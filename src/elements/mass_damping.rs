//! Damping in proportion to mass. See docs/theory.md, section 6.13.

use super::{Contribution, Element, Inertia, Instant};
use crate::error::Result;
use std::sync::Arc;

/// Forces `factor · M V` against the motion of what has this inertia, relative to the inertial
/// frame.
#[derive(Debug, Clone)]
pub struct MassDamping {
    inertia: Arc<Inertia>,
    factor: f64,
}

impl MassDamping {
    /// Of an inertia.
    pub fn new(inertia: Arc<Inertia>, factor: f64) -> Self {
        MassDamping { inertia, factor }
    }
}

impl Element for MassDamping {
    fn nodes(&self) -> &[usize] {
        self.inertia.nodes()
    }

    fn has_damping(&self) -> bool {
        true
    }

    fn knows_inertial_frame(&self) -> bool {
        true
    }

    fn potential(&self, _: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        Ok(Some(0.0))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        for a in 0..instant.nodes.len() {
            let mut force = self.inertia.momentum_of_spin(a) * self.factor;
            for (b, (other, mass)) in instant.nodes.iter().zip(self.inertia.row(a)).enumerate() {
                let block = mass * self.factor;
                force += block * other.twist;
                if out.with_tangents {
                    out.add_damping(a, b, &block);
                }
            }
            out.add_force(a, &force);
        }
        Ok(())
    }
}
