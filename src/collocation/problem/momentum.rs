//! Momentum over the period, along a direction or about an axis, and its gradient.

use super::Collocation;
use crate::elements::{Element, Inertia};
use crate::motion::tilde;
use nalgebra::{DVector, Vector6};

impl Collocation {
    /// Twists of an inertia's nodes at grid point `k` in a motion of everything by `twist`, which
    /// is resolved in space, about the origin.
    fn common_twists(&self, inertia: &Inertia, k: usize, twist: &Vector6<f64>) -> DVector<f64> {
        let nodes = inertia.nodes();
        let mut twists = DVector::zeros(6 * nodes.len());
        for (a, &node) in nodes.iter().enumerate() {
            let at = &self.instants.states[node * self.grid.points() + k];
            let here = at.motion.inverse().adjoint() * twist;
            twists.fixed_rows_mut::<6>(6 * a).copy_from(&here);
        }
        twists
    }

    /// Mean over the period of the momentum in the inertial frame that belongs to a motion of
    /// everything by `twist`, resolved in space, about the origin: along a direction for a
    /// translation, about an axis for a turn.
    pub fn mean_momentum(&self, twist: &Vector6<f64>) -> f64 {
        let mut mean = 0.0;
        for (k, share) in self.grid.shares().iter().enumerate() {
            for inertia in self.system.inertias() {
                let [momenta, _] = self.momenta(inertia, k);
                mean += share * momenta.dot(&self.common_twists(inertia, k, twist));
            }
        }
        mean
    }

    /// Adds its derivatives by material increments of the motions to `row`.
    pub fn add_momentum_gradient(&self, twist: &Vector6<f64>, row: &mut [f64]) {
        self.vary_inertias(row, |inertia, k| {
            let [mut momenta, _] = self.momenta(inertia, k);
            let twists = self.common_twists(inertia, k, twist);
            let by_velocities = inertia.times_mass(&twists);
            // An increment Δu changes the twist W by W̃ Δu.
            for a in 0..inertia.nodes().len() {
                let turned = tilde(&twists.fixed_rows::<6>(6 * a).into_owned());
                let by_motion = turned.tr_mul(&momenta.fixed_rows::<6>(6 * a));
                momenta.fixed_rows_mut::<6>(6 * a).copy_from(&by_motion);
            }
            [momenta, by_velocities]
        });
    }
}
