//! Rules in time: what velocities, accelerations and rates of internal states follow from
//! (docs/theory.md, section 4).

mod aliasing;
mod alpha;
mod antiperiodic;
mod backward;
mod given;
mod kinematics;
mod mapped;
mod radau;
mod spectral;
mod steady;
#[cfg(test)]
mod tangent_test;
mod wave;

pub use aliasing::Aliasing;
pub use alpha::{
    AlphaStep, GeneralizedAlpha, MotionState, StepVariation, Variation, VariationScales,
};
pub use antiperiodic::{Antiperiodic, antiperiodic_at};
pub use backward::Backward;
pub use given::GivenRates;
pub use kinematics::{BackwardWeights, KinematicsScratch, NodeKinematics};
pub use mapped::Mapped;
pub use radau::{PLACES, RadauStep, RadauWeights, STAGES};
pub use spectral::Spectral;
pub use steady::Steady;
pub use wave::Wave;

use super::state::GridState;
use crate::elements::NodeState;
use crate::fourier::{Differentiation, Slope, TimeGrid};
use crate::motion::{DualMatrix, DualVector};
use crate::workers::Workers;
use nalgebra::Vector6;
use std::fmt::Debug;

/// A rule on a grid of `N` points.
///
/// Tangents are those for increments `exp(μt) Δu`, polynomials in `μ`: what is asked for is the
/// factor of one of its powers, from 0 to 2. Where increments are not functions of time those of 1
/// and 2 vanish.
pub trait TimeRule: CloneRule + Debug + Send + Sync {
    /// Writes what node `a` does at grid point `k`, at `a N + k`. Tangents are then those at this
    /// state.
    fn evaluate(&mut self, state: &GridState, workers: &Workers, nodes: &mut [NodeState]);

    /// The same of some nodes; others may be left as they are.
    fn evaluate_some(
        &mut self,
        state: &GridState,
        _: &(dyn Fn(usize) -> bool + Sync),
        workers: &Workers,
        nodes: &mut [NodeState],
    ) {
        self.evaluate(state, workers, nodes);
    }

    /// Writes the rates of the internal state at `place` among the own unknowns, which has these
    /// `values` at the grid points and gains `gain` in a period.
    fn rates(&mut self, place: usize, values: &[f64], gain: f64, rates: &mut [f64]);

    /// Blocks `(ℓ, k)` of `Γ_v` and `Γ_a` of a node (docs/theory.md, section 4.2).
    fn tangent(&self, node: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2];

    /// How the rate of an internal state at grid point `l` depends on its value at `k`.
    fn rate_weight(&self, power: usize, l: usize, k: usize) -> f64;

    /// Whether stiffness and damping of elements with or without mass count. Where rates are given
    /// they need not.
    fn is_elastic(&self, with_mass: bool) -> bool {
        let _ = with_mass;
        true
    }

    /// Whether internal states are held, and their rates the unknowns.
    fn holds_states(&self) -> bool {
        false
    }

    /// Writes `Γ_v Δu` and `Γ_a Δu` of a node, for increments of six numbers at each grid point; on
    /// a grid that is even, at those of a part of the period after which all repeats itself.
    fn vary(
        &self,
        node: usize,
        increments: &[f64],
        _: &mut RuleWorkspace,
        rates: &mut [[Vector6<f64>; 2]],
    ) {
        for (l, rates) in rates.iter_mut().enumerate() {
            *rates = [Vector6::zeros(); 2];
            for (k, u) in increments.chunks_exact(6).enumerate() {
                let u = DualVector::from_twist(&Vector6::from_column_slice(u));
                for (rate, gamma) in rates.iter_mut().zip(self.tangent(node, 0, l, k)) {
                    *rate += (gamma * u).to_twist();
                }
            }
        }
    }

    /// Writes the rates that values of an internal state have, but for what it gains.
    fn vary_rates(&self, values: &[f64], _: &mut RuleWorkspace, rates: &mut [f64]) {
        for (l, rate) in rates.iter_mut().enumerate() {
            let terms = values.iter().enumerate();
            *rate = terms.map(|(k, x)| self.rate_weight(0, l, k) * x).sum();
        }
    }

    /// Adds the transposes of `Γ_v` and `Γ_a` times what a node's velocity and acceleration are
    /// multiplied by.
    fn vary_transposed(
        &self,
        node: usize,
        by_rates: &[[Vector6<f64>; 2]],
        _: &mut RuleWorkspace,
        out: &mut [f64],
    ) {
        for (k, out) in out.chunks_exact_mut(6).enumerate() {
            for (l, by_rates) in by_rates.iter().enumerate() {
                for (by_rate, gamma) in by_rates.iter().zip(self.tangent(node, 0, l, k)) {
                    let by_rate = DualVector::from_wrench(by_rate);
                    let sum = (gamma.transpose() * by_rate).to_wrench();
                    out.iter_mut().zip(&sum).for_each(|(out, x)| *out += x);
                }
            }
        }
    }

    /// The transpose of [`TimeRule::vary_rates`].
    fn vary_rates_transposed(&self, by_rates: &[f64], _: &mut RuleWorkspace, out: &mut [f64]) {
        for (k, out) in out.iter_mut().enumerate() {
            let terms = by_rates.iter().enumerate();
            *out = terms.map(|(l, x)| self.rate_weight(0, l, k) * x).sum();
        }
    }

    /// What the grid makes of the highest harmonics of a node's increments, see [`Aliasing`].
    fn aliasing(&self, node: usize) -> Vec<Aliasing> {
        let _ = node;
        Vec::new()
    }

    /// Where derivatives are those of functions over the grid: what they are.
    fn over_grid(&self) -> Option<OverGrid<'_>> {
        None
    }
}

/// Derivatives of functions over a grid.
#[derive(Debug, Clone, Copy)]
pub struct OverGrid<'a> {
    /// Motions of the nodes, with their derivatives by pseudo-time.
    pub kinematics: &'a [NodeKinematics],
    /// Derivatives by pseudo-time.
    pub operators: &'a Differentiation,
    /// How those by time follow at each point; none if time is pseudo-time.
    pub slopes: &'a [Slope],
}

/// The rule for functions over a grid.
pub fn over(grid: TimeGrid, nodes: usize) -> Box<dyn TimeRule> {
    match grid.map().is_identity() {
        true => Box::new(Spectral::new(grid, nodes)),
        false => Box::new(Mapped::new(grid, nodes)),
    }
}

/// Scratch for variations, for each thread.
#[derive(Debug, Default)]
pub struct RuleWorkspace {
    operators: Option<Differentiation>,
    /// Of a part of the period.
    of_part: Option<Differentiation>,
    variation: KinematicsScratch,
    samples: Vec<f64>,
    by_rates: Vec<[Vector6<f64>; 2]>,
    scaled: Vec<f64>,
}

/// Rules as values.
pub trait CloneRule {
    /// A copy.
    fn boxed(&self) -> Box<dyn TimeRule>;
}

impl<R: TimeRule + Clone + 'static> CloneRule for R {
    fn boxed(&self) -> Box<dyn TimeRule> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn TimeRule> {
    fn clone(&self) -> Self {
        (**self).boxed()
    }
}
