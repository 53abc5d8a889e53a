//! The elements at each grid point.

use super::division::Share;
use super::state::GridState;
use crate::elements::{Contribution, InertialForces, NodeState};
use crate::error::Result;
use crate::system::{Conditions, OwnValues, Placed, System, Workspace};
use crate::workers::Workers;
use nalgebra::Vector6;
use std::sync::Arc;

/// The system at each grid point.
#[derive(Debug, Clone)]
pub(super) struct Instants {
    pub(super) system: Arc<System>,
    pub(super) points: usize,
    /// Times of the grid points.
    pub(super) times: Vec<f64>,
    /// Signal `s` at grid point `k`, at `k × count + s`.
    pub(super) signals: Vec<f64>,
    pub(super) inertial: InertialForces,
    /// Node `a` at grid point `k`, at `a N + k`.
    pub(super) states: Vec<NodeState>,
    /// Rates of internal states, in the order of the multipliers; zero for these.
    pub(super) rates: Vec<f64>,
    /// Stress resultants for the geometric stiffness: those of all stations at grid point 0, then
    /// 1, and so on. Empty for those of the strains.
    pub(super) resultants: Vec<Vector6<f64>>,
}

/// Whether an element is to be evaluated at a grid point.
pub(super) type Wanted<'a> = dyn Fn(usize, usize) -> bool + Sync + 'a;

impl Instants {
    /// Whether gravity is the same at all grid points.
    pub(super) fn is_gravity_constant(&self) -> bool {
        let count = self.system.signals();
        let at = |k: usize| self.system.gravity(&self.signals[k * count..][..count]);
        (1..self.points).all(|k| at(k) == at(0))
    }

    /// The system.
    pub(super) fn system(&self) -> &System {
        &self.system
    }

    /// Writes the equations of a share, not scaled: forces on its nodes, and what the elements ask
    /// of their own unknowns. Elements are evaluated at the grid points where they are `wanted`.
    pub(super) fn forces(
        &self,
        share: &Share,
        state: &GridState,
        workspace: &mut Workspace,
        (forces, own): (&mut [f64], &mut [Option<&mut [f64]>]),
        (wanted, workers): (&Wanted, &Workers),
    ) -> Result<()> {
        forces.fill(0.0);
        for (&index, own) in share.elements.iter().zip(own) {
            workers.pulse()?;
            let placed = &self.system.elements()[index];
            let nodes = placed.element.nodes();
            let count = placed.element.own_unknowns();
            for k in (0..self.points).filter(|&k| wanted(index, k)) {
                let contribution = self.evaluate(placed, k, state, workspace)?;
                share.add_forces(contribution, nodes, (k, self.points), forces);
                if let Some(own) = own {
                    own[count * k..][..count].copy_from_slice(contribution.constraint.as_slice());
                }
            }
        }
        Ok(())
    }

    /// Evaluates an element at grid point `k`.
    pub(super) fn evaluate<'w>(
        &self,
        placed: &Placed,
        k: usize,
        state: &GridState,
        workspace: &'w mut Workspace,
    ) -> Result<&'w Contribution> {
        let signal_count = self.system.signals();
        let conditions = Conditions {
            time: self.times[k],
            signals: &self.signals[k * signal_count..][..signal_count],
            coordinates: state.tracked(&self.system, k),
            inertial: self.inertial,
        };
        let node_state = |node: usize| self.states[node * self.points + k];
        let first_station = k * self.system.stations();
        let stations = first_station + placed.stations.start..first_station + placed.stations.end;
        let own = OwnValues {
            values: state.own_of(placed, k),
            rates: &self.rates[placed.own_at(state.points(), k)],
            resultants: self.resultants.get(stations).unwrap_or(&[]),
        };
        self.system
            .evaluate(placed, node_state, &conditions, own, workspace)
    }
}
