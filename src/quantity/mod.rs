//! Quantities: what can be asked of a mechanism in motion (docs/theory.md, section 14).
//!
//! Each has values at the times of a motion, a [`History`], and a first variation there, exact,
//! with respect to motions, velocities, accelerations and own unknowns. Of these are made series,
//! means, harmonics and extremes, and gradients by all unknowns of the equations. What solutions
//! show, and what conditions hold, is the same.

mod beam;
mod extremes;
mod feature;
mod force;
mod history;
mod joint;
mod measurement;
mod names;
mod node;
mod peak;
mod record;
mod samples;
mod scale;
mod shell;
mod variation;
#[cfg(test)]
mod variation_test;

pub use beam::BeamQuantity;
pub(crate) use beam::{Neighbours, require_station};
pub use extremes::Extremes;
pub use feature::Feature;
pub use force::ForceQuantity;
pub(crate) use force::{exerted, record_forces, state_gain};
pub use history::{Forces, History};
use joint::relation_effort;
pub use joint::{JointQuantity, ResolvedIn};
pub use measurement::Measurement;
pub use node::NodeQuantity;
pub(crate) use node::require_closed;
pub use peak::Peak;
pub use record::ForceRecord;
pub use samples::Samples;
pub(crate) use samples::require_numbers;
pub use shell::ShellQuantity;
pub use variation::Variation;

use crate::elements::ShellPoint;
use crate::error::{Error, Result};
use crate::system::System;
use std::fmt::Debug;

/// A quantity of one thing, with all its components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// Of a node.
    Node(usize, NodeQuantity),
    /// Of a joint.
    Joint(usize, JointQuantity),
    /// Of a beam.
    Beam {
        /// Number of its element.
        element: usize,
        /// Place along the element, from −1 to 1.
        station: f64,
        /// What is asked for there.
        quantity: BeamQuantity,
    },
    /// Of a force.
    Force(usize, ForceQuantity),
    /// Effort that a relation exerts on one of its joint coordinates, towards growth.
    RelationEffort {
        /// Number of the relation.
        relation: usize,
        /// Which of its coordinates, in their order.
        coordinate: usize,
    },
    /// Of a shell.
    Shell {
        /// Number of its element.
        element: usize,
        /// Place in the element, and axes there.
        point: ShellPoint,
        /// What is asked for there.
        quantity: ShellQuantity,
    },
}

/// All components of a quantity, or one of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection {
    /// The quantity.
    pub quantity: Quantity,
    /// The component; all if none.
    pub component: Option<usize>,
}

impl From<Quantity> for Selection {
    fn from(quantity: Quantity) -> Self {
        Selection {
            quantity,
            component: None,
        }
    }
}

impl Selection {
    /// Number of components.
    pub fn components(self) -> usize {
        self.component.map_or(self.quantity.components(), |_| 1)
    }

    /// What is selected, where each of the quantity's components has one of `all`.
    ///
    /// # Errors
    /// If it has no such component.
    pub fn of<T>(self, mut all: Vec<T>) -> Result<Vec<T>> {
        match self.component {
            None => Ok(all),
            Some(component) => {
                self.quantity.require_component(component)?;
                Ok(vec![all.swap_remove(component)])
            }
        }
    }
}

/// What a quantity depends on besides the unknowns of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dependence {
    /// Nothing.
    Nothing,
    /// The period, in which motions run through their course.
    Period,
    /// Parameters: stiffnesses, signals, and the period.
    Parameters,
}

/// A quantity found in a system: what evaluates it.
pub trait Probe: Debug + Send + Sync {
    /// What it depends on besides motions and own unknowns.
    fn dependence(&self) -> Dependence {
        Dependence::Parameters
    }

    /// Its values at all times of a motion.
    ///
    /// # Errors
    /// If it cannot be evaluated there, or is not a number.
    fn samples(&self, history: &History) -> Result<Samples>;

    /// Adds `weight` times what these `samples` vary by: a component of them at one of the times.
    ///
    /// # Errors
    /// As [`Probe::samples`].
    fn vary(
        &self,
        history: &History,
        component_and_time: (usize, usize),
        samples: &Samples,
        weight: f64,
        out: &mut Variation,
    ) -> Result<()>;
}

impl Quantity {
    /// Number of components.
    pub fn components(self) -> usize {
        match self {
            Quantity::Node(_, quantity) => quantity.components(),
            Quantity::Joint(_, quantity) => quantity.components(),
            Quantity::Beam { .. } => 6,
            Quantity::Force(_, quantity) => quantity.components(),
            Quantity::RelationEffort { .. } => 1,
            Quantity::Shell { quantity, .. } => quantity.components(),
        }
    }

    /// One of its components.
    pub fn component(self, component: usize) -> Selection {
        Selection {
            quantity: self,
            component: Some(component),
        }
    }

    /// Checks that it has a component.
    ///
    /// # Errors
    /// If it does not.
    pub(crate) fn require_component(self, component: usize) -> Result<()> {
        let count = self.components();
        if component < count {
            return Ok(());
        }
        let expected = format!("a number below {count}");
        Err(Error::value("component", expected, component))
    }

    /// Finds it in a system.
    ///
    /// # Errors
    /// If it is not there.
    pub fn probe(self, system: &System) -> Result<Box<dyn Probe>> {
        Ok(match self {
            Quantity::Node(node, quantity) => quantity.probe(system, node)?,
            Quantity::Joint(joint, quantity) => quantity.probe(system, joint)?,
            Quantity::Beam {
                element,
                station,
                quantity,
            } => {
                let neighbours = quantity.needs_neighbours().then(|| Neighbours::of(system));
                quantity.probe(system, neighbours.as_ref(), element, station)?
            }
            Quantity::Force(force, quantity) => quantity.probe(system, force)?,
            Quantity::RelationEffort {
                relation,
                coordinate,
            } => relation_effort(system, relation, coordinate)?,
            Quantity::Shell {
                element,
                point,
                quantity,
            } => quantity.probe(system, element, point)?,
        })
    }
}
