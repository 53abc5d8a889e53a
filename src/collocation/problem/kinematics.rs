//! Velocities and accelerations of the nodes, and rates of internal states, at the grid points.

use super::Collocation;
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::Motion;

impl Collocation {
    /// Evaluates velocities, accelerations and rates of internal states at the grid points.
    pub fn update_kinematics(&mut self, state: &GridState) {
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
                leaders.repeat_states(states);
            }
            None => rule.evaluate(state, &self.workers, states),
        }
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
