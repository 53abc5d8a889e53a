//! Kinetic and potential energy over the period, and its gradient.

use super::Collocation;
use crate::collocation::rule::RuleWorkspace;
use crate::collocation::state::GridState;
use crate::elements::{Element, Inertia, InertialForces, NodeState};
use crate::error::{Error, ErrorKind, Result};
use crate::system::{Conditions, ElementRole, OwnValues, Placed, describe_role};
use nalgebra::{DVector, Vector6};

impl Collocation {
    /// Momenta of an inertia at its nodes at grid point `k`, and its twists there.
    pub(super) fn momenta(&self, inertia: &Inertia, k: usize) -> [DVector<f64>; 2] {
        let nodes = inertia.nodes();
        let mut twists = DVector::zeros(6 * nodes.len());
        for (a, &node) in nodes.iter().enumerate() {
            let at = &self.instants.states[node * self.grid.points() + k];
            let at = self.system.inertial_state(at);
            twists.fixed_rows_mut::<6>(6 * a).copy_from(&at.twist);
        }
        inertia.momenta(twists)
    }

    /// What an element is looked at under at grid point `k`, at rest and without multipliers.
    fn conditions_at<'a>(&'a self, state: &'a GridState, k: usize) -> Conditions<'a> {
        let count = self.system.signals();
        Conditions {
            time: self.instants.times[k],
            signals: &self.instants.signals[k * count..][..count],
            coordinates: state.tracked(&self.system, k),
            inertial: InertialForces::FULL,
        }
    }

    /// Of a node of an element: at rest in the inertial frame, if the element knows that.
    fn at_rest(&self, placed: &Placed, node: usize, k: usize) -> NodeState {
        let motion = &self.instants.states[node * self.grid.points() + k].motion;
        match placed.element.knows_inertial_frame() {
            true => self.system.at_inertial_rest(motion),
            false => NodeState::at_rest(*motion),
        }
    }

    /// Mean over the period of the kinetic and the potential energy; kinematics are those of
    /// `state`. Weights have none at the origin.
    ///
    /// # Errors
    /// [`ErrorKind::NotAvailable`], naming it, if a force has no energy that is known.
    pub fn mean_energy(&self, state: &GridState) -> Result<f64> {
        let system = &self.system;
        let mut workspace = system.workspace(false);
        let shares = self.grid.shares();
        let mut mean = 0.0;
        for (k, share) in shares.iter().enumerate() {
            let mut sum = 0.0;
            for inertia in system.inertias() {
                let [momenta, twists] = self.momenta(inertia, k);
                sum += 0.5 * momenta.dot(&twists);
            }
            let conditions = self.conditions_at(state, k);
            for placed in system.elements() {
                let at_rest = |node: usize| self.at_rest(placed, node, k);
                let found = system.potential(placed, at_rest, &conditions, &mut workspace)?;
                sum += found.ok_or_else(|| unknown(placed))?;
            }
            mean += share * sum;
        }
        Ok(mean)
    }

    /// Adds its derivatives by material increments of the motions to `row`.
    ///
    /// # Errors
    /// If a beam is too distorted.
    pub fn add_energy_gradient(&self, state: &GridState, row: &mut [f64]) -> Result<()> {
        let (points, system) = (self.grid.points(), &self.system);
        let shares = self.grid.shares();
        let mut workspace = system.workspace(false);
        // Damping has no energy, but acts on what spins in nodes at rest.
        let has_energy = |placed: &&Placed| placed.role != ElementRole::MassDamping;
        for placed in system.elements().iter().filter(has_energy) {
            let zeros = vec![0.0; placed.element.own_unknowns()];
            let own = OwnValues {
                values: &zeros,
                rates: &zeros,
                resultants: &[],
            };
            for k in 0..points {
                let conditions = self.conditions_at(state, k);
                let at_rest = |node: usize| self.at_rest(placed, node, k);
                let out = system.evaluate(placed, at_rest, &conditions, own, &mut workspace)?;
                let forces = out.force.as_slice().chunks_exact(6);
                for (force, &node) in forces.zip(placed.element.nodes()) {
                    let row = &mut row[self.layout.motion(node, k)];
                    row.iter_mut()
                        .zip(force)
                        .for_each(|(x, f)| *x += shares[k] * f);
                }
            }
        }
        self.vary_inertias(row, |inertia, k| {
            let [momenta, _] = self.momenta(inertia, k);
            [DVector::zeros(momenta.len()), momenta]
        });
        Ok(())
    }

    /// Adds the derivatives of a mean over the period by material increments of the motions to
    /// `row`, where `factors` tells for each inertia and grid point what that varies by with the
    /// motions of its nodes, and with their velocities in the inertial frame.
    pub(super) fn vary_inertias(
        &self,
        row: &mut [f64],
        factors: impl Fn(&Inertia, usize) -> [DVector<f64>; 2],
    ) {
        let (points, system) = (self.grid.points(), &self.system);
        let shares = self.grid.shares();
        let mut by_rates = vec![[Vector6::zeros(); 2]; points * system.nodes()];
        for inertia in system.inertias() {
            for (k, share) in shares.iter().enumerate() {
                let all = factors(inertia, k);
                for (a, &node) in inertia.nodes().iter().enumerate() {
                    let at = node * points + k;
                    let [motion, velocity] = [0, 1].map(|i| all[i].fixed_rows::<6>(6 * a) * *share);
                    let mut factors = [motion, velocity, Vector6::zeros()];
                    system.vary_in_frame(&self.instants.states[at], &mut factors);
                    let row = &mut row[self.layout.motion(node, k)];
                    row.iter_mut().zip(&factors[0]).for_each(|(x, d)| *x += d);
                    by_rates[at][0] += factors[1];
                }
            }
        }
        let mut workspace = RuleWorkspace::default();
        for (node, by_rates) in by_rates.chunks_exact(points).enumerate() {
            let out = &mut row[self.layout.node(node)];
            self.rule
                .vary_transposed(node, by_rates, &mut workspace, out);
        }
    }
}

fn unknown(placed: &Placed) -> Error {
    let message = format!("{} has no energy that is known", describe_role(placed.role));
    Error::new(ErrorKind::NotAvailable, message)
}
