//! Viscous damper between two bodies, with a full matrix of coefficients.
//! See docs/theory.md, section 6.10.

use super::joint::{Attachment, FramePair};
use super::{Contribution, Element, Instant};
use crate::error::Result;
use nalgebra::Matrix6;

/// Wrench `−C ż` on the second of two frames, and its reaction on the first: `ż` is the twist of
/// the second frame relative to the first, both wrench and twist are resolved in the second.
#[derive(Debug, Clone)]
pub struct ViscousDamper {
    pair: FramePair,
    matrix: Matrix6<f64>,
}

impl ViscousDamper {
    /// Between the bodies of two frames; where the first is on its body does not matter.
    pub fn new(first: Attachment, second: Attachment, matrix: Matrix6<f64>) -> Self {
        ViscousDamper {
            pair: FramePair::new(first, second),
            matrix,
        }
    }
}

impl Element for ViscousDamper {
    fn nodes(&self) -> &[usize] {
        self.pair.nodes()
    }

    fn has_damping(&self) -> bool {
        true
    }

    fn potential(&self, _: &Instant, _: &mut Contribution) -> Result<Option<f64>> {
        Ok(Some(0.0))
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let state = self.pair.state(instant.nodes);
        let c = &self.matrix;
        let wrench = c * state.rate;
        state.add_wrench(&wrench, &(c * state.rate_variation()), Some(c), out);
        Ok(())
    }
}
