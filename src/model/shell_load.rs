//! Loads on the surfaces and edges of shells.

use super::{Model, Signal};
use crate::elements::{LoadFrame, ShellLoadPlace};
use crate::error::{Error, Result, require_id};
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
    /// Adds a load on shell elements. It acts on their reference surface, moves with it, and stays
    /// a load for a unit of *reference* area or length. A follower pressure on the surface is a
    /// force along its axis 3, the normal.
    ///
    /// # Errors
    /// If the elements or the edge do not exist.
    pub fn add_shell_load(&mut self, load: ShellLoadDefinition) -> Result<()> {
        let count = self.shells.len();
        require_id("first_element", "shell element", count, load.first_element)?;
        let most = count - load.first_element;
        if !(1..=most).contains(&load.elements) {
            let expected = format!("1 to {most} from element {} on", load.first_element);
            return Err(Error::size("elements", expected, load.elements));
        }
        if let ShellLoadPlace::Edge(edge) = load.place
            && edge > 3
        {
            return Err(Error::value("edge", "0 to 3", edge));
        }
        self.shell_loads.push(load);
        Ok(())
    }
}
