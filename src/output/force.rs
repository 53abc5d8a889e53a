//! Forces of periodic solutions must repeat themselves.

use super::solution::Solution;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::PeriodicSeries;
use crate::model::JointCoordinate;
use crate::quantity::{JointQuantity, Quantity, exerted, state_gain};
use crate::system::ElementRole;

impl Solution {
    /// A spring on an angle that gains turns would pull ever harder; what depends on such an angle
    /// must repeat with its turns.
    pub(super) fn require_periodic_forces(&self) -> Result<()> {
        if !self.outcome().is_solution() {
            return Ok(());
        }
        let (system, history) = (&self.solve.system, self.history());
        // Of each coordinate that forces are at.
        let mut known: Vec<(JointCoordinate, PeriodicSeries)> = Vec::new();
        for placed in system.elements() {
            let ElementRole::Force(index) = placed.role else {
                continue;
            };
            let Some(at) = self.model.forces[index].at() else {
                continue;
            };
            let place = match known.iter().position(|(other, _)| *other == at) {
                Some(place) => place,
                None => {
                    let coordinate = JointQuantity::Coordinate(at.coordinate);
                    let series = self.series(Quantity::Joint(at.joint, coordinate))?;
                    known.extend(series.into_iter().map(|series| (at, series)));
                    known.len() - 1
                }
            };
            let series = &known[place].1;
            if series.rate == 0.0 {
                continue;
            }
            let signals = self.solve.signals()?;
            let gain = series.rate * series.period();
            let state_gain = state_gain(&history, placed);
            let (mut change, mut size) = (0.0f64, 0.0f64);
            let count = system.signals();
            for k in 0..history.points() {
                let signals = &signals[k * count..][..count];
                let own = history.own_of(placed, k);
                let here = history.state.tracked(system, k);
                let later: Vec<f64> = here.iter().map(|q| q + gain).collect();
                let mut signals_later = signals.to_vec();
                if let Some(prescribed) = self.model.prescribed_index(&at) {
                    signals_later[prescribed] += gain;
                }
                let own_later: Vec<f64> = own.iter().map(|x| x + state_gain).collect();
                let exerted = |coordinates: &[f64], signals: &[f64], values: &[f64]| {
                    exerted(&history, placed, k, coordinates, signals, values)
                };
                let now = exerted(here, signals, own)?.0;
                let then = exerted(&later, &signals_later, &own_later)?.0;
                for (now, then) in now.iter().zip(&then) {
                    size = size.max(now.abs());
                    change = change.max((then - now).abs());
                }
            }
            if change > 1e-9 * size {
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
}
