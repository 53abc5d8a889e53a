//! Forces of periodic solutions must repeat themselves.

use super::solution::Solution;
use crate::collocation::LikeBlades;
use crate::error::{Error, ErrorKind, Result};
use crate::model::JointCoordinate;
use crate::quantity::{JointQuantity, Quantity, exerted, state_gain};
use crate::system::ElementRole;

/// Differences of motions of blades, relative to the size of the system, that are alike.
const ALIKE: f64 = 1e-9;

impl Solution {
    /// A spring on an angle that gains turns would pull ever harder; what depends on such an angle
    /// must repeat with its turns.
    pub(super) fn require_periodic_forces(&self) -> Result<()> {
        if !self.outcome().is_solution() {
            return Ok(());
        }
        let (system, history) = (&self.solve.system, self.history());
        let left = self.blades_that_move_alike();
        let leads = |element| left.as_ref().is_none_or(|left| left.leads(element));
        // Of each coordinate that forces are at.
        let mut known = Vec::new();
        for (element, placed) in system.elements().iter().enumerate() {
            let ElementRole::Force(index) = placed.role else {
                continue;
            };
            if !leads(element) {
                continue;
            }
            let gains = self.gains(self.model.forces[index].coordinates(), &mut known)?;
            let Some(&(at, gain)) = gains.first() else {
                continue;
            };
            let signals = self.solve.signals()?;
            let state_gain = state_gain(&history, placed);
            // Of all forces together, then of the rates of each state of the user.
            let states = match placed.has_feedback {
                true => placed.element.own_unknowns(),
                false => 0,
            };
            let mut changes = vec![[0.0f64; 2]; 1 + states];
            let count = system.signals();
            for k in 0..history.points() {
                let signals = &signals[k * count..][..count];
                let own = history.own_of(placed, k);
                let here = history.state.tracked(system, k);
                let mut later = here.to_vec();
                let mut signals_later = signals.to_vec();
                for (at, gain) in &gains {
                    system.add_to_tracked(at, *gain, &mut later);
                    if let Some(prescribed) = self.model.prescribed_index(at) {
                        signals_later[prescribed] += gain;
                    }
                }
                let own_later: Vec<f64> = own.iter().map(|x| x + state_gain).collect();
                let exerted = |coordinates: &[f64], signals: &[f64], values: &[f64]| {
                    exerted(&history, placed, k, coordinates, signals, values)
                };
                let now = exerted(here, signals, own)?;
                let then = exerted(&later, &signals_later, &own_later)?;
                let forces = now
                    .on_nodes
                    .iter()
                    .zip(&then.on_nodes)
                    .map(|pair| (0, pair));
                let rates = now.unbalance.iter().zip(&then.unbalance).take(states);
                let rates = rates.enumerate().map(|(state, pair)| (1 + state, pair));
                for (place, (now, then)) in forces.chain(rates) {
                    let [change, size] = &mut changes[place];
                    *size = size.max(now.abs());
                    *change = change.max((then - now).abs());
                }
            }
            if changes.iter().any(|[change, size]| *change > 1e-9 * size) {
                let turns = gain / std::f64::consts::TAU;
                let plural = if turns.abs() < 1.5 { "" } else { "s" };
                return Err(Error::new(
                    ErrorKind::NotPeriodic,
                    format!(
                        "force {index} on joint {}: its angle gains {turns:.0} turn{plural} in \
                         one period, so that \
                         its moment is not periodic; use stiffness 0 or another joint",
                        at.joint
                    ),
                ));
            }
        }
        Ok(())
    }

    /// What is left of like blades that move alike, if forces act on others than that which leads:
    /// what they do is what it does there.
    fn blades_that_move_alike(&self) -> Option<LikeBlades> {
        let system = &self.solve.system;
        let left = LikeBlades::on(system, self.grid())?;
        let follows = |(element, role): (usize, ElementRole)| {
            matches!(role, ElementRole::Force(_)) && !left.leads(element)
        };
        let roles = system.elements().iter().map(|placed| placed.role);
        let is_alike = roles.enumerate().any(follows)
            && left.apart(&self.solve.state, system.scales().length) <= ALIKE;
        is_alike.then_some(left)
    }

    /// What joint coordinates gain in a period, of those that gain something; `known` are those
    /// that were asked for.
    fn gains(
        &self,
        coordinates: Vec<JointCoordinate>,
        known: &mut Vec<(JointCoordinate, f64)>,
    ) -> Result<Vec<(JointCoordinate, f64)>> {
        let mut gains = Vec::new();
        for at in coordinates {
            let gain = match known.iter().find(|(other, _)| *other == at) {
                Some(&(_, gain)) => gain,
                None => {
                    let coordinate = JointQuantity::Coordinate(at.coordinate);
                    let series = self.series(Quantity::Joint(at.joint, coordinate))?;
                    let gain = series.first().map_or(0.0, |x| x.rate * x.period());
                    known.push((at, gain));
                    gain
                }
            };
            if gain != 0.0 {
                gains.push((at, gain));
            }
        }
        Ok(gains)
    }
}
