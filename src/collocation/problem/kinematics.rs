//! Velocities and accelerations of the nodes, and rates of internal states, at the grid points.

use super::Collocation;
use crate::collocation::like_blades::Leaders;
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::Motion;
use std::sync::Arc;

impl Collocation {
    /// Evaluates velocities, accelerations and rates of internal states at the grid points.
    pub fn update_kinematics(&mut self, state: &GridState) {
        self.update_kinematics_where(state, false);
    }

    /// The same where it matters to the equations: where states are alike, not of all nodes of
    /// other blades than that which leads.
    pub(super) fn update_kinematics_acted_on(&mut self, state: &GridState) {
        self.update_kinematics_where(state, true);
    }

    fn update_kinematics_where(&mut self, state: &GridState, acted_on: bool) {
        self.update_rates(state);
        let points = self.grid.points();
        let at_rest = NodeState::at_rest(Motion::identity());
        self.instants
            .states
            .resize(points * self.system.nodes(), at_rest);
        let (rule, states) = (&mut self.rule, &mut self.instants.states);
        match &self.leaders {
            Some(leaders) => {
                rule.evaluate_some(state, &|node| leaders.leads(node), &self.workers, states);
                match acted_on {
                    true => leaders.repeat_states_acted_on(states),
                    false => leaders.repeat_states(states),
                }
            }
            None => rule.evaluate(state, &self.workers, states),
        }
    }

    /// Evaluates velocities and accelerations at a state, of all nodes from these leaders, if any;
    /// but not once more where that was done last, by the same rule in time.
    pub(crate) fn ensure_kinematics(&mut self, leaders: Option<Arc<Leaders>>, state: &GridState) {
        let points = state.points();
        let count = |node: usize| (leaders.as_ref()).map_or(points, |l| l.points_of(node, points));
        let states = &self.instants.states;
        let is_there = states.len() == state.motions.len()
            && self.applied == state.scalars
            && (states.chunks_exact(points).enumerate()).all(|(node, states)| {
                let motions = states.iter().map(|node| &node.motion);
                motions
                    .take(count(node))
                    .eq(state.node(node).iter().take(count(node)))
            });
        match (is_there, &leaders) {
            (false, _) => self.update_kinematics_by(leaders, state),
            (true, Some(leaders)) => leaders.repeat_states(&mut self.instants.states),
            (true, None) => {}
        }
        self.update_rates(state);
    }

    fn update_rates(&mut self, state: &GridState) {
        let points = self.grid.points();
        let (mut values, mut rates) = (vec![0.0; points], vec![0.0; points]);
        for placed in self.system.elements().iter().filter(|p| p.has_states) {
            for row in 0..placed.element.own_unknowns() {
                for (k, value) in values.iter_mut().enumerate() {
                    *value = state.own_of(placed, k)[row];
                }
                let gain = state.gain(&self.system, placed, row);
                let place = placed.first_own + row;
                self.rule.rates(place, &values, gain, &mut rates);
                for (k, rate) in rates.iter().enumerate() {
                    self.instants.rates[state.first_own(placed, k) + row] = *rate;
                }
            }
        }
    }
}
