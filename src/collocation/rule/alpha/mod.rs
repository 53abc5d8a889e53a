//! A step in time by the generalised-α method on SE(3), and the state of motion it starts from.
//!
//! After Arnold and Brüls (Multibody System Dynamics 18, 2007) and Brüls, Cardona and Arnold
//! (Mechanism and Machine Theory 48, 2012), for the equations of index 3: with steps of `h`,
//!
//! ```text
//! M₁ = M₀ exp(Ψ),  Ψ = h v₀ + h² ((½ − β) a₀ + β a₁),  v₁ = v₀ + h ((1 − γ) a₀ + γ a₁),
//! (1 − α_m) a₁ + α_m a₀ = (1 − α_f) v̇₁ + α_f v̇₀,
//! ```
//!
//! and equilibrium, constraints and multipliers at the end of the step. As `v₁` and `v̇₁` are
//! affine in `Ψ = log(M₀⁻¹ M₁)`, a step is collocation on a grid of one point with another rule for
//! the derivatives.
//!
//! Internal states follow the first-order method of the same kind (Jansen, Whiting and Hulbert,
//! Computer Methods in Applied Mechanics and Engineering 190, 2000). See docs/theory.md, section
//! 12.1.

mod variation;

pub use variation::{StepVariation, Variation, VariationScales};

use super::TimeRule;
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::motion::{DualMatrix, Motion, inverse_tangent};
use crate::workers::Workers;
use nalgebra::Vector6;

/// Parameters of the method, all from the spectral radius at infinite frequency `ρ∞`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GeneralizedAlpha {
    /// `α_m = (2ρ∞ − 1)/(ρ∞ + 1)`.
    pub alpha_m: f64,
    /// `α_f = ρ∞/(ρ∞ + 1)`.
    pub alpha_f: f64,
    /// `β = ¼ (½ + γ)²`.
    pub beta: f64,
    /// `γ = ½ + α_f − α_m`.
    pub gamma: f64,
    /// `α_m` of internal states, `½ (3ρ∞ − 1)/(ρ∞ + 1)`.
    pub state_alpha_m: f64,
    /// `γ` of internal states, `1/(ρ∞ + 1)`.
    pub state_gamma: f64,
}

impl GeneralizedAlpha {
    /// Of least low-frequency dissipation for this `ρ∞`, from 0 to 1 (Chung and Hulbert 1993).
    pub fn new(spectral_radius: f64) -> Self {
        let rho = spectral_radius;
        let alpha_m = (2.0 * rho - 1.0) / (rho + 1.0);
        let alpha_f = rho / (rho + 1.0);
        let gamma = 0.5 + alpha_f - alpha_m;
        GeneralizedAlpha {
            alpha_m,
            alpha_f,
            beta: 0.25 * (0.5 + gamma) * (0.5 + gamma),
            gamma,
            state_alpha_m: 0.5 * (3.0 * rho - 1.0) / (rho + 1.0),
            state_gamma: 1.0 / (rho + 1.0),
        }
    }

    /// `a` stands for `v̇` this part of a step later (a negative one).
    pub fn shift(&self) -> f64 {
        self.alpha_m - self.alpha_f
    }

    /// Error of a position after one step, relative to `h³ v̈`.
    pub fn error_constant(&self) -> f64 {
        0.5 * self.shift() + self.beta - 1.0 / 6.0
    }
}

/// Motions, velocities, accelerations and internal states at one time: all that a step starts from.
#[derive(Debug, Clone)]
pub struct MotionState {
    /// The time.
    pub time: f64,
    /// Motions, multipliers and internal states, on a grid of one point.
    pub state: GridState,
    /// `v` of each node.
    pub twist: Vec<Vector6<f64>>,
    /// `v̇` of each node.
    pub twist_rate: Vec<Vector6<f64>>,
    /// `a` of each node.
    pub averaged: Vec<Vector6<f64>>,
    /// Rates of internal states, in the order of the multipliers.
    pub rates: Vec<f64>,
    /// The like of `a` for internal states.
    pub averaged_rates: Vec<f64>,
}

impl MotionState {
    /// At rest.
    pub fn at_rest(time: f64, state: GridState) -> Self {
        let (nodes, own) = (state.motions.len(), state.multipliers.len());
        MotionState {
            time,
            twist: vec![Vector6::zeros(); nodes],
            twist_rate: vec![Vector6::zeros(); nodes],
            averaged: vec![Vector6::zeros(); nodes],
            rates: vec![0.0; own],
            averaged_rates: vec![0.0; own],
            state,
        }
    }

    /// State of one node.
    pub fn node(&self, node: usize) -> NodeState {
        NodeState {
            motion: self.state.motions[node],
            twist: self.twist[node],
            twist_rate: self.twist_rate[node],
        }
    }

    /// Makes it the start of steps of another length: `a` is `v̇` a part of a step earlier.
    pub fn change_step(&mut self, ratio: f64) {
        for (a, rate) in self.averaged.iter_mut().zip(&self.twist_rate) {
            *a = rate + (*a - rate) * ratio;
        }
        for (a, rate) in self.averaged_rates.iter_mut().zip(&self.rates) {
            *a = rate + (*a - rate) * ratio;
        }
    }
}

/// One step.
#[derive(Debug, Clone)]
pub struct AlphaStep {
    /// The method.
    pub method: GeneralizedAlpha,
    /// Length `h` of the step.
    pub length: f64,
    /// What it starts from.
    pub start: MotionState,
    /// `T⁻¹(Ψ)` of each node, as of the last evaluation.
    inverse_tangents: Vec<DualMatrix>,
}

impl AlphaStep {
    /// A step of `length` from `start`.
    pub fn new(method: GeneralizedAlpha, length: f64, start: MotionState) -> Self {
        AlphaStep {
            inverse_tangents: vec![DualMatrix::zeros(); start.twist.len()],
            method,
            length,
            start,
        }
    }

    /// `∂v₁/∂Ψ` and `∂v̇₁/∂Ψ`, both multiples of the identity.
    pub fn weights(&self) -> (f64, f64) {
        let GeneralizedAlpha {
            alpha_m,
            alpha_f,
            beta,
            gamma,
            ..
        } = self.method;
        let h = self.length;
        (
            gamma / (beta * h),
            (1.0 - alpha_m) / ((1.0 - alpha_f) * beta * h * h),
        )
    }

    /// `∂ẋ₁/∂x₁` of internal states.
    pub fn state_weight(&self) -> f64 {
        let method = &self.method;
        (1.0 - method.state_alpha_m) / ((1.0 - method.alpha_f) * method.state_gamma * self.length)
    }

    /// `v₁`, `v̇₁` and `a₁` with the increment `Ψ`, from `v₀`, `v̇₀` and `a₀`.
    fn end(&self, psi: &Vector6<f64>, [v, rate, a]: [&Vector6<f64>; 3]) -> [Vector6<f64>; 3] {
        let (method, h) = (&self.method, self.length);
        let (per_step, per_beta) = (1.0 / h, 1.0 / (method.beta * h));
        let a1 = (psi * per_step - v - a * ((0.5 - method.beta) * h)) * per_beta;
        let v1 = v + (a * (1.0 - method.gamma) + a1 * method.gamma) * h;
        let rate1 = (a1 * (1.0 - method.alpha_m) + a * method.alpha_m - rate * method.alpha_f)
            * (1.0 / (1.0 - method.alpha_f));
        [v1, rate1, a1]
    }

    /// The same for a node that moves to `motion`, and `Ψ`.
    fn end_of_node(&self, node: usize, motion: &Motion) -> (Vector6<f64>, [Vector6<f64>; 3]) {
        let start = &self.start;
        let psi = start.state.motions[node].relative(motion).logarithm();
        let at = [&start.twist, &start.twist_rate, &start.averaged].map(|all| &all[node]);
        (psi, self.end(&psi, at))
    }

    /// `ẋ₁` of an internal state that changes by `change`, and the like of `a₁`, from those at the
    /// start.
    fn end_of_state(&self, change: f64, [rate, a]: [f64; 2]) -> [f64; 2] {
        let GeneralizedAlpha {
            alpha_f,
            state_alpha_m: alpha_m,
            state_gamma: gamma,
            ..
        } = self.method;
        let a1 = (change / self.length - (1.0 - gamma) * a) / gamma;
        let rate1 = ((1.0 - alpha_m) * a1 + alpha_m * a - alpha_f * rate) / (1.0 - alpha_f);
        [rate1, a1]
    }

    /// The same of that at `place`, whose value becomes `value`.
    fn end_of(&self, place: usize, value: f64) -> [f64; 2] {
        let start = &self.start;
        let at = [start.rates[place], start.averaged_rates[place]];
        self.end_of_state(value - start.state.multipliers[place], at)
    }

    /// Where a first guess of the end is: at unchanged accelerations.
    pub fn predict(&self, out: &mut GridState) {
        let (start, h) = (&self.start, self.length);
        for (node, motion) in out.motions.iter_mut().enumerate() {
            let increment = start.twist[node] * h + start.averaged[node] * (0.5 * h * h);
            *motion = start.state.motions[node]
                .increment(&increment)
                .renormalised();
        }
        for (place, value) in out.multipliers.iter_mut().enumerate() {
            *value = start.state.multipliers[place] + h * start.averaged_rates[place];
        }
    }

    /// Makes `end`, with the node states that belong to it, the start of the next step, which is as
    /// long; `is_state` tells internal states from multipliers.
    pub fn advance(
        &mut self,
        end: &GridState,
        node_states: &[NodeState],
        is_state: impl Fn(usize) -> bool,
    ) {
        for (node, at) in node_states.iter().enumerate() {
            let (_, [.., averaged]) = self.end_of_node(node, &at.motion);
            self.start.averaged[node] = averaged;
            self.start.twist[node] = at.twist;
            self.start.twist_rate[node] = at.twist_rate;
        }
        for (place, &value) in end.multipliers.iter().enumerate() {
            if is_state(place) {
                let [rate, averaged] = self.end_of(place, value);
                self.start.rates[place] = rate;
                self.start.averaged_rates[place] = averaged;
            }
        }
        self.start.state.clone_from(end);
        self.start.time += self.length;
    }
}

impl TimeRule for AlphaStep {
    fn evaluate(&mut self, state: &GridState, _: &Workers, nodes: &mut [NodeState]) {
        for (node, (out, motion)) in nodes.iter_mut().zip(&state.motions).enumerate() {
            let (psi, [twist, twist_rate, _]) = self.end_of_node(node, motion);
            self.inverse_tangents[node] = inverse_tangent(&psi);
            *out = NodeState {
                motion: *motion,
                twist,
                twist_rate,
            };
        }
    }

    fn rates(&mut self, place: usize, values: &[f64], _: f64, rates: &mut [f64]) {
        [rates[0], _] = self.end_of(place, values[0]);
    }

    /// `Δv₁ = Γ_v Δu` and `Δv̇₁ = Γ_a Δu`.
    fn tangent(&self, node: usize, power: usize, _: usize, _: usize) -> [DualMatrix; 2] {
        let (first, second) = self.weights();
        let tangent = &self.inverse_tangents[node];
        match power {
            0 => [*tangent * first, *tangent * second],
            _ => [DualMatrix::zeros(); 2],
        }
    }

    fn rate_weight(&self, power: usize, _: usize, _: usize) -> f64 {
        match power {
            0 => self.state_weight(),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::System;
    use crate::test_models::pendulums::oscillator;

    /// A node that moves with `v̇ = rate + jerk t`, and the step's `a` that belongs to it.
    fn with_jerk(method: &GeneralizedAlpha, h: f64, rate: f64, jerk: f64) -> MotionState {
        let system = System::new(&oscillator().0, 1.0).unwrap();
        let mut start = MotionState::at_rest(0.0, GridState::at_points(&system, 1));
        start.twist[0][0] = 0.4;
        start.twist_rate[0][0] = rate;
        start.averaged[0][0] = rate + method.shift() * h * jerk;
        start
    }

    #[test]
    fn a_step_errs_by_its_constant() {
        let (h, rate, jerk) = (0.3, 0.7, -1.9);
        for radius in [0.0, 0.5, 0.8, 1.0] {
            let method = GeneralizedAlpha::new(radius);
            let start = with_jerk(&method, h, rate, jerk);
            let exact = 0.4 * h + rate * h * h / 2.0 + jerk * h.powi(3) / 6.0;
            let psi = exact + method.error_constant() * jerk * h.powi(3);
            let step = AlphaStep::new(method, h, start);
            let at = &step.start;
            let all = [&at.twist[0], &at.twist_rate[0], &at.averaged[0]];
            let [_, end, _] = step.end(&(Vector6::x() * psi), all);
            // With this increment, acceleration at the end is that of the motion.
            assert!(
                (end[0] - (rate + jerk * h)).abs() < 1e-12,
                "{radius}: {end}"
            );
        }
    }

    #[test]
    fn steps_of_another_length_start_from_what_belongs_to_them() {
        let method = GeneralizedAlpha::new(0.5);
        let mut start = with_jerk(&method, 0.3, 0.7, -1.9);
        start.change_step(1.7);
        let expected = with_jerk(&method, 0.3 * 1.7, 0.7, -1.9);
        assert!((start.averaged[0] - expected.averaged[0]).amax() < 1e-15);
    }
}
