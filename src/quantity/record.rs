//! What forces did, kept as functions of the user are not called any more.

use crate::error::{Error, ErrorKind, Result};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// What a force does at the times of a motion.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ForceRecord {
    /// Its nodes.
    pub(super) nodes: Vec<usize>,
    /// Forces on the nodes, in their own axes.
    pub(super) on_nodes: Vec<Vec<f64>>,
    /// The element's outputs.
    pub(super) outputs: Vec<Vec<f64>>,
    /// What its internal states gain in a period.
    pub(super) gain: f64,
}

impl ForceRecord {
    /// Some of its values at time `k`; they may come from a file.
    ///
    /// # Errors
    /// If the file does not hold them.
    pub(super) fn part<'a>(
        &self,
        all: &'a [Vec<f64>],
        k: usize,
        places: Range<usize>,
    ) -> Result<&'a [f64]> {
        all.get(k).and_then(|row| row.get(places)).ok_or_else(|| {
            let nodes = self.nodes.len();
            let message = format!("forces: not as many values as a force on {nodes} nodes needs");
            Error::new(ErrorKind::Format, message)
        })
    }

    /// Whether its values are as many as so many times need.
    pub(crate) fn fits(&self, points: usize) -> bool {
        let outputs = self.outputs.first().map_or(0, Vec::len);
        self.on_nodes.len() == points
            && self.outputs.len() == points
            && self
                .on_nodes
                .iter()
                .all(|x| x.len() / 6 == self.nodes.len())
            && self.outputs.iter().all(|x| x.len() == outputs)
    }
}
