//! Loads on the surfaces and edges of shells.

use super::validation::require_elements;
use super::{Model, Signal};
use crate::elements::{LoadFrame, ShellLoadPlace};
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Force and moment per unit of reference area or length, on consecutive shell elements.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ShellLoadDefinition {
    /// First shell element.
    pub first_element: usize,
    /// Number of elements.
    pub elements: usize,
    /// Where on each of them.
    pub place: ShellLoadPlace,
    /// How the components are directed.
    pub frame: LoadFrame,
    /// Components `[force; moment]`, per unit of area or length.
    pub components: [Option<Signal>; 6],
}

impl ShellLoadDefinition {
    /// The elements that are loaded.
    pub(crate) fn range(&self) -> Range<usize> {
        self.first_element..self.first_element + self.elements
    }
}

impl Model {
    /// Adds a load on shell elements; returns its number among these. It acts on their reference
    /// surface, moves with it, and stays a load for a unit of *reference* area or length. A
    /// follower pressure on the surface is a force along its axis 3, the normal.
    ///
    /// # Errors
    /// If the elements or the edge do not exist.
    pub fn add_shell_load(&mut self, load: ShellLoadDefinition) -> Result<usize> {
        self.require_shell_place((load.first_element, load.elements), load.place)?;
        self.shell_loads.push(load);
        Ok(self.shell_loads.len() - 1)
    }

    /// Checks that there are so many shell elements, from the first on, with such a place.
    pub(crate) fn require_shell_place(
        &self,
        elements: (usize, usize),
        place: ShellLoadPlace,
    ) -> Result<()> {
        require_elements("shell element", self.shells.len(), elements)?;
        if let ShellLoadPlace::Edge(edge) = place
            && edge > 3
        {
            return Err(Error::value("edge", "0 to 3", edge));
        }
        Ok(())
    }
}
