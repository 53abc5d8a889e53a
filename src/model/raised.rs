//! The same model with beam elements of a higher degree.

use super::Model;
use crate::elements::{Element, Raised};
use crate::error::Result;
use std::collections::BTreeMap;

impl Model {
    /// The same with each beam element by one of a higher degree, and what is between the two. The
    /// nodes that are there keep their numbers; those inside elements belong to beams no more.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub(crate) fn raised(&self) -> Result<(Model, Vec<Raised>)> {
        let mut fine = self.clone();
        let mut between = Vec::with_capacity(self.beams.len());
        let mut inertia = BTreeMap::new();
        for (beam, fine_beam) in self.beams.iter().zip(&mut fine.beams) {
            let nodes = beam.nodes();
            let first = fine.nodes.len();
            let inner = first..first + beam.raised_size() - 2;
            let mut raised_nodes = vec![nodes[0]];
            raised_nodes.extend(inner);
            raised_nodes.push(nodes[nodes.len() - 1]);
            let (raised, relation) = beam.raised(raised_nodes)?;
            let reference = raised.reference();
            fine.nodes
                .extend_from_slice(&reference[1..reference.len() - 1]);
            inertia.insert(nodes, raised.inertia()?);
            *fine_beam = raised;
            between.push(relation);
        }
        for there in &mut fine.inertias {
            let raised = inertia
                .remove(there.nodes())
                .filter(|_| there.nodes().len() > 1);
            if let Some(raised) = raised {
                *there = raised;
            }
        }
        Ok((fine, between))
    }
}
