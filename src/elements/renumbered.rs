//! An element as a part of a mechanism has it: its nodes have other numbers there, and it may count
//! for a share only.

use super::{
    Contribution, Controller, Element, Instant, Measure, NodeState, OutputVariation, StressLaw,
    Unknown,
};
use crate::error::Result;
use nalgebra::Vector6;
use std::sync::Arc;

/// The same element on nodes with other numbers.
#[derive(Debug, Clone)]
pub struct Renumbered {
    element: Arc<dyn Element>,
    nodes: Vec<usize>,
    /// Part of its forces, and of the equations of internal states, that counts. Constraints are
    /// what they are, and their multipliers those of the whole.
    share: f64,
}

impl Renumbered {
    /// `element` on these nodes, in its own order.
    pub fn new(element: Arc<dyn Element>, nodes: Vec<usize>) -> Self {
        Renumbered {
            element,
            nodes,
            share: 1.0,
        }
    }

    /// The same, for a share only.
    pub fn with_share(self, share: f64) -> Self {
        Renumbered { share, ..self }
    }
}

impl Element for Renumbered {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn own_unknowns(&self) -> usize {
        self.element.own_unknowns()
    }

    fn unknown(&self, index: usize) -> Unknown {
        self.element.unknown(index)
    }

    fn has_states(&self) -> bool {
        self.element.has_states()
    }

    fn has_feedback(&self) -> bool {
        self.element.has_feedback()
    }

    fn couples_nodes(&self) -> bool {
        self.element.couples_nodes()
    }

    fn initial_state(&self, index: usize) -> f64 {
        self.element.initial_state(index)
    }

    fn as_controller(&self) -> Option<&Controller> {
        self.element.as_controller()
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        self.element.evaluate(instant, out)?;
        if self.share != 1.0 {
            out.force *= self.share;
            out.stiffness *= self.share;
            out.damping *= self.share;
            out.mass *= self.share;
            if self.has_states() {
                out.constraint *= self.share;
                out.gradient *= self.share;
                out.own *= self.share;
                out.own_rate *= self.share;
            }
        }
        Ok(())
    }

    fn potential(&self, instant: &Instant, scratch: &mut Contribution) -> Result<Option<f64>> {
        self.element.potential(instant, scratch)
    }

    fn outputs(&self, instant: &Instant, out: &mut Vec<f64>) -> Result<()> {
        self.element.outputs(instant, out)
    }

    fn acted_measure(&self) -> Option<Measure> {
        self.element.acted_measure()
    }

    fn is_bushing(&self) -> bool {
        self.element.is_bushing()
    }

    fn vary_output(
        &self,
        instant: &Instant,
        index: usize,
        out: &mut OutputVariation,
    ) -> Result<()> {
        self.element.vary_output(instant, index, out)
    }

    fn stress_laws(&self) -> Vec<StressLaw> {
        let mut laws = self.element.stress_laws();
        for law in &mut laws {
            law.stiffness *= self.share;
            law.damping *= self.share;
            for other in &mut law.others {
                other.stiffness *= self.share;
                other.damping *= self.share;
            }
        }
        laws
    }

    fn stress_resultants(
        &self,
        nodes: &[NodeState],
        scratch: &mut Contribution,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        self.element.stress_resultants(nodes, scratch, out)
    }

    fn extrapolate_resultants(
        &self,
        nodes: &[NodeState],
        increments: &[[Vector6<f64>; 2]],
        scratch: &mut Contribution,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        self.element
            .extrapolate_resultants(nodes, increments, scratch, out)
    }

    fn add_forces_of_resultants(
        &self,
        nodes: &[NodeState],
        resultants: &[Vector6<f64>],
        out: &mut Contribution,
    ) -> Result<()> {
        self.element
            .add_forces_of_resultants(nodes, resultants, out)
    }

    fn has_mass(&self) -> bool {
        self.element.has_mass()
    }

    fn knows_inertial_frame(&self) -> bool {
        self.element.knows_inertial_frame()
    }

    fn has_damping(&self) -> bool {
        self.element.has_damping()
    }
}
