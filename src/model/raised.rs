//! The same model with beam elements of a higher degree.

use super::Model;
use crate::elements::{Beam, Element, Raised};
use crate::error::Result;
use std::sync::Arc;

impl Model {
    /// The same with each beam element, of which these are the elements, by one of a higher degree,
    /// and what is between the two. The nodes that are there keep their numbers; those inside
    /// elements belong to beams no more.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub(crate) fn raised(&self, beams: &[Arc<Beam>]) -> Result<(Model, Vec<Raised>)> {
        let mut fine = self.clone();
        let mut between = Vec::with_capacity(beams.len());
        for (beam, definition) in beams.iter().zip(&mut fine.beams) {
            let raised = beam.raised()?;
            let reference = raised.motions(beam.reference())?;
            let inner = &reference[1..reference.len() - 1];
            let nodes = beam.nodes();
            let first = fine.nodes.len();
            definition.nodes = vec![nodes[0]];
            definition.nodes.extend(first..first + inner.len());
            definition.nodes.push(nodes[nodes.len() - 1]);
            fine.nodes.extend_from_slice(inner);
            between.push(raised);
        }
        Ok((fine, between))
    }
}
