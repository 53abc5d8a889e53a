//! What forces do: efforts, and what they exert on nodes.

use super::force_record::{ForceRecord, exerted, gain_of, signals_of};
use super::solution::{Samples, Solution};
use crate::elements::LoadFrame;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::PeriodicSeries;
use crate::model::JointCoordinate;
use crate::motion::turned;
use crate::system::ElementRole;
use nalgebra::Vector6;

/// What can be asked of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForceQuantity {
    /// Effort on its joint coordinate: of an actuator towards growth, of all others against it.
    Effort,
    /// Effort of a branch of a generalised Maxwell model, against the growth of its coordinate.
    BranchEffort(usize),
    /// Elongation (or turn) of the dashpot of such a branch.
    BranchElongation(usize),
    /// Force and moment that it exerts on one of its nodes, along the inertial axes or those of the
    /// node.
    OnNode(usize, LoadFrame),
}

impl ForceQuantity {
    /// Number of components.
    pub fn components(self) -> usize {
        match self {
            ForceQuantity::OnNode(..) => 6,
            _ => 1,
        }
    }
}

impl Solution {
    /// A quantity of a force at `times`; components of each time together.
    ///
    /// # Errors
    /// An unknown force, or a quantity that it does not have.
    pub fn force(&self, force: usize, quantity: ForceQuantity, times: &[f64]) -> Result<Vec<f64>> {
        let samples = self.force_samples(force, quantity)?;
        Self::finite("force", self.sample(&samples, times)?)
    }

    /// Fourier series of each component of a quantity of a force, through its values on the grid.
    ///
    /// # Errors
    /// An unknown force, or a quantity that it does not have.
    pub fn force_series(
        &self,
        force: usize,
        quantity: ForceQuantity,
    ) -> Result<Vec<PeriodicSeries>> {
        self.series(&self.force_samples(force, quantity)?)
    }

    fn force_samples(&self, force: usize, quantity: ForceQuantity) -> Result<Samples> {
        self.model.require_force("force", force)?;
        let record = self.forces[force].as_ref().map_err(Error::clone)?;
        match quantity {
            ForceQuantity::Effort => {
                if record.outputs.iter().any(Vec::is_empty) {
                    let message =
                        format!("force {force} is not on a joint coordinate: it has no effort");
                    return Err(Error::new(ErrorKind::NotAvailable, message));
                }
                self.samples_of(1, |k| Ok(vec![record.outputs[k][0]]))
            }
            ForceQuantity::BranchEffort(branch) => {
                let place = self.branch_output(force, record, branch)?;
                self.samples_of(1, |k| Ok(vec![record.outputs[k][place]]))
            }
            ForceQuantity::BranchElongation(branch) => {
                let place = self.branch_output(force, record, branch)? + 1;
                let values = self.samples_of(1, |k| Ok(vec![record.outputs[k][place]]))?;
                // A dashpot on an angle that gains turns gains them too.
                Ok(Samples {
                    rate: record.gain / self.grid().period(),
                    ..values
                })
            }
            ForceQuantity::OnNode(node, frame) => {
                self.model.require_node("node", node)?;
                let local = record.nodes.iter().position(|&n| n == node);
                let local = local.ok_or_else(|| {
                    let message = format!("force {force} does not act on node {node}");
                    Error::new(ErrorKind::NotAvailable, message)
                })?;
                let states = self.solve.states_of(node);
                self.samples_of(6, |k| {
                    let own = Vector6::from_column_slice(&record.on_nodes[k][6 * local..][..6]);
                    let turn = match frame {
                        LoadFrame::Space => states[k].motion.rotation,
                        LoadFrame::Follower => nalgebra::Matrix3::identity(),
                    };
                    Ok(turned(&turn, &own).as_slice().to_vec())
                })
            }
        }
    }

    /// Place of a Maxwell branch's effort among the outputs.
    fn branch_output(&self, force: usize, record: &ForceRecord, branch: usize) -> Result<usize> {
        let count = record.outputs.first().map_or(0, |row| row.len() / 2);
        if branch < count {
            return Ok(1 + 2 * branch);
        }
        let message = format!("branch: force {force} has {count} Maxwell branches, got {branch}");
        Err(Error::new(ErrorKind::NotAvailable, message))
    }

    /// A spring on an angle that gains turns would pull ever harder; what depends on such an angle
    /// must repeat with its turns.
    pub(super) fn require_periodic_forces(&self) -> Result<()> {
        if !self.outcome().is_solution() {
            return Ok(());
        }
        let system = &self.solve.system;
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
                    known.push((at, self.coordinate(at.joint, at.coordinate)?));
                    known.len() - 1
                }
            };
            let series = &known[place].1;
            if series.rate == 0.0 {
                continue;
            }
            let signals = signals_of(&self.solve)?;
            let gain = series.rate * series.period();
            let state_gain = gain_of(&self.solve, placed);
            let (mut change, mut size) = (0.0f64, 0.0f64);
            for (k, time) in self.solve.times().into_iter().enumerate() {
                let own = self.solve.state.own_of(placed, k);
                let here = self.solve.state.tracked(system, k);
                let later: Vec<f64> = here.iter().map(|q| q + gain).collect();
                let mut signals_later = signals[k].clone();
                if let Some(prescribed) = self.model.prescribed_index(&at) {
                    signals_later[prescribed] += gain;
                }
                let own_later: Vec<f64> = own.iter().map(|x| x + state_gain).collect();
                let exerted = |coordinates: &[f64], signals: &[f64], values: &[f64]| {
                    exerted(&self.solve, placed, (k, time), coordinates, signals, values)
                };
                let now = exerted(here, &signals[k], own)?.0;
                let then = exerted(&later, &signals_later, &own_later)?.0;
                size = size.max(now.amax());
                change = change.max((then - now).amax());
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
