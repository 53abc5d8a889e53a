//! What elements exert at one instant.

use super::{ElementRole, Placed, System, turning};
use crate::elements::{Contribution, InertialForces, Instant, NodeState, OutputVariation};
use crate::error::Result;
use nalgebra::Vector6;

/// An element's own unknowns at one instant.
#[derive(Debug, Clone, Copy)]
pub struct OwnValues<'a> {
    /// Multipliers or internal states.
    pub values: &'a [f64],
    /// Rates of internal states; zero for multipliers.
    pub rates: &'a [f64],
    /// Stress resultants for the geometric stiffness; those of the strains if empty.
    pub resultants: &'a [Vector6<f64>],
}

/// What is the same for all elements at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Conditions<'a> {
    /// Time.
    pub time: f64,
    /// Values of all signals.
    pub signals: &'a [f64],
    /// Last values of the tracked coordinates.
    pub coordinates: &'a [f64],
    /// How inertia counts.
    pub inertial: InertialForces,
}

/// What an element does.
#[derive(Debug, Clone)]
pub struct Exerted {
    /// Forces on its nodes, in their own axes.
    pub on_nodes: Vec<f64>,
    /// What is left of the equations of its own unknowns.
    pub unbalance: Vec<f64>,
    /// Its outputs.
    pub outputs: Vec<f64>,
}

/// Scratch for evaluating elements: one contribution for each size of element.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    contributions: Vec<Contribution>,
    states: Vec<NodeState>,
    changes: Vec<[Vector6<f64>; 2]>,
    resultants: Vec<Vector6<f64>>,
}

impl Workspace {
    fn set_states(&mut self, placed: &Placed, state: impl Fn(usize) -> NodeState) {
        self.states.clear();
        let states = placed.element.nodes().iter().map(|&node| state(node));
        self.states.extend(states);
    }
}

impl System {
    /// Scratch for [`System::evaluate`].
    pub fn workspace(&self, with_tangents: bool) -> Workspace {
        Workspace {
            contributions: self
                .shapes
                .iter()
                .map(|&shape| Contribution::shaped(shape, with_tangents))
                .collect(),
            states: Vec::new(),
            changes: Vec::new(),
            resultants: Vec::new(),
        }
    }

    /// The same for tangents with those of stress resultants apart.
    pub fn workspace_with_resultants_apart(&self) -> Workspace {
        let mut workspace = self.workspace(true);
        for contribution in &mut workspace.contributions {
            contribution.with_resultants_apart = true;
        }
        workspace
    }

    /// What an element sees whose nodes are at `states`.
    fn instant<'a>(
        &self,
        states: &'a [NodeState],
        conditions: &Conditions<'a>,
        own: OwnValues<'a>,
    ) -> Instant<'a> {
        Instant {
            time: self.standstill().map_or(conditions.time, |s| s.time),
            nodes: states,
            multipliers: own.values,
            multiplier_rates: own.rates,
            resultants: own.resultants,
            signals: conditions.signals,
            coordinates: conditions.coordinates,
            gravity: self.gravity(conditions.signals),
            inertial: conditions.inertial,
        }
    }

    /// Twist of the frame that motions are described in, if it turns and the element knows of it.
    fn frame_seen_by(&self, placed: &Placed, signals: &[f64]) -> Option<Vector6<f64>> {
        match placed.element.knows_inertial_frame() {
            true => self.frame_twist(signals),
            false => None,
        }
    }

    /// Evaluates one element for node states given by index, and returns its contribution.
    pub fn evaluate<'w>(
        &self,
        placed: &Placed,
        state: impl Fn(usize) -> NodeState,
        conditions: &Conditions,
        own: OwnValues,
        workspace: &'w mut Workspace,
    ) -> Result<&'w Contribution> {
        let frame = self.frame_seen_by(placed, conditions.signals);
        workspace.states.clear();
        workspace
            .states
            .extend(placed.element.nodes().iter().map(|&n| match &frame {
                Some(frame) => turning::inertial(&state(n), frame),
                None => state(n),
            }));
        let out = &mut workspace.contributions[placed.shape];
        out.clear();
        let instant = self.instant(&workspace.states, conditions, own);
        placed
            .element
            .evaluate(&instant, out)
            .map_err(|e| match placed.role {
                ElementRole::Beam(index) => e.within(format!("beam element {index}")),
                ElementRole::Shell(index) => e.within(format!("shell element {index}")),
                ElementRole::Force(index) => e.within(format!("force {index}")),
                ElementRole::Relation(index) => e.within(format!("relation {index}")),
                _ => e,
            })?;
        if let Some(frame) = &frame
            && out.with_tangents
        {
            for (b, &node) in placed.element.nodes().iter().enumerate() {
                turning::add_variation(&state(node), frame, b, out);
            }
        }
        Ok(out)
    }

    /// The same where the element's own unknowns, and tracked coordinates, are zero.
    pub(super) fn evaluate_relaxed<'w>(
        &self,
        placed: &Placed,
        state: impl Fn(usize) -> NodeState,
        signals: &[f64],
        workspace: &'w mut Workspace,
    ) -> Result<&'w Contribution> {
        let count = placed.element.own_unknowns();
        let zeros = vec![0.0; count.max(self.tracked())];
        let conditions = Conditions {
            time: 0.0,
            signals,
            coordinates: &zeros[..self.tracked()],
            inertial: InertialForces::FULL,
        };
        let own = OwnValues {
            values: &zeros[..count],
            rates: &zeros[..count],
            resultants: &[],
        };
        self.evaluate(placed, state, &conditions, own, workspace)
    }

    /// Energy of one element at motions at rest, without multipliers; none if it has none that is
    /// known.
    ///
    /// # Errors
    /// If the element is too distorted.
    pub fn potential(
        &self,
        placed: &Placed,
        state: impl Fn(usize) -> NodeState,
        conditions: &Conditions,
        workspace: &mut Workspace,
    ) -> Result<Option<f64>> {
        workspace.set_states(placed, state);
        let scratch = &mut workspace.contributions[placed.shape];
        let own = OwnValues {
            values: &[],
            rates: &[],
            resultants: &[],
        };
        let instant = self.instant(&workspace.states, conditions, own);
        placed.element.potential(&instant, scratch)
    }

    /// Writes the stress resultants of one element.
    ///
    /// # Errors
    /// If the element is too distorted.
    pub fn stress_resultants(
        &self,
        placed: &Placed,
        state: impl Fn(usize) -> NodeState,
        workspace: &mut Workspace,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        workspace.set_states(placed, state);
        let scratch = &mut workspace.contributions[placed.shape];
        let element = &placed.element;
        element.stress_resultants(&workspace.states, scratch, out)
    }

    /// The same for strains and strain rates that change in proportion to increments of the nodes
    /// and of their velocities, which are given with their states.
    ///
    /// # Errors
    /// If the element is too distorted.
    pub fn extrapolated_resultants(
        &self,
        placed: &Placed,
        state: impl Fn(usize) -> (NodeState, [Vector6<f64>; 2]),
        workspace: &mut Workspace,
        out: &mut [Vector6<f64>],
    ) -> Result<()> {
        workspace.set_states(placed, |node| state(node).0);
        let Workspace {
            contributions,
            states,
            changes,
            ..
        } = workspace;
        changes.clear();
        changes.extend(placed.element.nodes().iter().map(|&node| state(node).1));
        let scratch = &mut contributions[placed.shape];
        placed
            .element
            .extrapolate_resultants(states, changes, scratch, out)
    }

    /// Lets what stress resultants of one element, whose nodes are at `from`, are more than those
    /// `given` act on the nodes as they are at `to` instead: what that changes of the forces.
    ///
    /// # Errors
    /// If the element is too distorted.
    pub fn forces_moved<'w>(
        &self,
        placed: &Placed,
        [from, to]: [impl Fn(usize) -> NodeState; 2],
        given: &[Vector6<f64>],
        workspace: &'w mut Workspace,
    ) -> Result<&'w [f64]> {
        let mut excess = std::mem::take(&mut workspace.resultants);
        excess.resize(given.len(), Vector6::zeros());
        self.stress_resultants(placed, from, workspace, &mut excess)?;
        excess
            .iter_mut()
            .zip(given)
            .for_each(|(x, given)| *x -= given);
        let element = &placed.element;
        let out = &mut workspace.contributions[placed.shape];
        out.clear();
        element.add_forces_of_resultants(&workspace.states, &excess, out)?;
        out.force.neg_mut();
        workspace.set_states(placed, to);
        let out = &mut workspace.contributions[placed.shape];
        element.add_forces_of_resultants(&workspace.states, &excess, out)?;
        workspace.resultants = excess;
        Ok(out.force.as_slice())
    }

    /// Adds what output `index` of one element, which is the same in a frame that turns, varies by
    /// to `out`, which is zero.
    ///
    /// # Errors
    /// Those of functions of the user.
    pub fn vary_output(
        &self,
        placed: &Placed,
        states: &[NodeState],
        conditions: &Conditions,
        own: OwnValues,
        (index, out): (usize, &mut OutputVariation),
    ) -> Result<()> {
        let instant = self.instant(states, conditions, own);
        placed.element.vary_output(&instant, index, out)
    }

    /// What one element does.
    pub fn outputs(
        &self,
        placed: &Placed,
        states: &[NodeState],
        conditions: &Conditions,
        own: OwnValues,
    ) -> Result<Exerted> {
        let seen: Vec<NodeState> = match self.frame_seen_by(placed, conditions.signals) {
            Some(frame) => {
                let inertial = |state| turning::inertial(state, &frame);
                states.iter().map(inertial).collect()
            }
            None => states.to_vec(),
        };
        let instant = self.instant(&seen, conditions, own);
        let mut contribution = Contribution::of(&*placed.element, false);
        placed.element.evaluate(&instant, &mut contribution)?;
        let mut outputs = Vec::new();
        placed.element.outputs(&instant, &mut outputs)?;
        // Forces count on the left-hand side of the equations.
        let forces = contribution.force.iter();
        Ok(Exerted {
            on_nodes: forces.map(|f| -f).collect(),
            unbalance: contribution.constraint.as_slice().to_vec(),
            outputs,
        })
    }
}
