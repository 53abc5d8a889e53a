//! How the end of a step varies with its start: exact linearisation of the generalised-α method.
//! See docs/theory.md, section 12.3.

use super::{AlphaStep, MotionState};
use crate::collocation::problem::Collocation;
use crate::collocation::tangent::{Increment, Tangent};
use crate::elements::{Measure, Unknown};
use crate::motion::inverse_tangent;
use nalgebra::{Matrix6, Vector6};

/// A variation of a [`MotionState`]: material increments of motions, and changes of all else.
#[derive(Debug, Clone)]
pub struct Variation {
    /// Of each node: `δu`, `δv`, `δv̇`, `δa`.
    pub nodes: Vec<[Vector6<f64>; 4]>,
    /// Of each own unknown of the elements that is an internal state: `δx`, `δẋ` and that of the
    /// like of `a`; zero for multipliers.
    pub states: Vec<[f64; 3]>,
}

/// Scales of the entries of a [`Variation`], so that they do not depend on units.
#[derive(Debug, Clone)]
pub struct VariationScales {
    /// Characteristic length.
    pub length: f64,
    /// Characteristic time.
    pub time: f64,
    /// Places of the internal states among the own unknowns, and what measures them.
    states: Vec<(usize, f64)>,
    nodes: usize,
    own: usize,
}

impl VariationScales {
    /// Scales of a system's states in a motion that takes of the order of `time`.
    pub fn new(equations: &Collocation, time: f64) -> Self {
        let system = equations.system();
        let length = system.scales().length;
        let states = (0..system.own_unknowns())
            .filter_map(|place| match system.unknown(place) {
                Unknown::State { measure, .. } => Some(match measure {
                    Measure::Length => (place, length),
                    Measure::Angle => (place, 1.0),
                }),
                Unknown::Multiplier(_) => None,
            })
            .collect();
        VariationScales {
            length,
            time,
            states,
            nodes: system.nodes(),
            own: system.own_unknowns(),
        }
    }

    /// Number of entries: of each node four times six, of each internal state three.
    pub fn size(&self) -> usize {
        24 * self.nodes + 3 * self.states.len()
    }

    /// Internal states.
    pub fn states(&self) -> impl Iterator<Item = usize> {
        self.states.iter().map(|s| s.0)
    }

    /// What an entry of part `part` (`u`, `v`, `v̇`, `a`) is measured in.
    fn node_scale(&self, part: usize, component: usize) -> f64 {
        let unit = if component < 3 { self.length } else { 1.0 };
        unit / [1.0, self.time, self.time * self.time, self.time * self.time][part]
    }

    fn state_scale(&self, unit: f64, part: usize) -> f64 {
        unit / [1.0, self.time, self.time][part]
    }

    /// The variation with these scaled entries.
    pub fn unpack(&self, entries: &[f64]) -> Variation {
        let nodes = entries[..24 * self.nodes].chunks_exact(24).map(|entries| {
            std::array::from_fn(|part| {
                Vector6::from_fn(|i, _| entries[6 * part + i] * self.node_scale(part, i))
            })
        });
        let mut states = vec![[0.0; 3]; self.own];
        let rest = entries[24 * self.nodes..].chunks_exact(3);
        for (&(place, unit), entries) in self.states.iter().zip(rest) {
            states[place] = std::array::from_fn(|p| entries[p] * self.state_scale(unit, p));
        }
        Variation {
            nodes: nodes.collect(),
            states,
        }
    }

    /// The scaled entries of a variation.
    pub fn pack(&self, variation: &Variation, entries: &mut [f64]) {
        let (nodes, states) = entries.split_at_mut(24 * self.nodes);
        for (entries, node) in nodes.chunks_exact_mut(24).zip(&variation.nodes) {
            for (part, vector) in node.iter().enumerate() {
                for i in 0..6 {
                    entries[6 * part + i] = vector[i] / self.node_scale(part, i);
                }
            }
        }
        for (entries, &(place, unit)) in states.chunks_exact_mut(3).zip(&self.states) {
            for (p, entry) in entries.iter_mut().enumerate() {
                *entry = variation.states[place][p] / self.state_scale(unit, p);
            }
        }
    }
}

impl MotionState {
    /// The state after a variation, of which the fraction `part` is taken.
    pub fn varied(&self, variation: &Variation, part: f64) -> Self {
        let mut next = self.clone();
        for (node, [u, v, rate, a]) in variation.nodes.iter().enumerate() {
            let motion = &mut next.state.motions[node];
            *motion = motion.increment(&(u * part)).renormalised();
            next.twist[node] += v * part;
            next.twist_rate[node] += rate * part;
            next.averaged[node] += a * part;
        }
        for (place, [x, rate, a]) in variation.states.iter().enumerate() {
            next.state.multipliers[place] += x * part;
            next.rates[place] += rate * part;
            next.averaged_rates[place] += a * part;
        }
        next
    }

    /// The variation that leads from here to `other`, whose internal states are first reduced by
    /// `gains`.
    pub fn difference(&self, other: &MotionState, gains: &[f64]) -> Variation {
        let node = |n: usize| {
            [
                self.state.motions[n]
                    .relative(&other.state.motions[n])
                    .logarithm(),
                other.twist[n] - self.twist[n],
                other.twist_rate[n] - self.twist_rate[n],
                other.averaged[n] - self.averaged[n],
            ]
        };
        let state = |i: usize| {
            [
                other.state.multipliers[i] - gains[i] - self.state.multipliers[i],
                other.rates[i] - self.rates[i],
                other.averaged_rates[i] - self.averaged_rates[i],
            ]
        };
        Variation {
            nodes: (0..self.twist.len()).map(node).collect(),
            states: (0..self.rates.len()).map(state).collect(),
        }
    }
}

/// A step's linearisation at its end.
#[derive(Debug)]
pub struct StepVariation {
    /// `T⁻¹(Ψ)` and `T⁻¹(Ψ) Ad(exp(−Ψ))` of each node.
    tangents: Vec<[Matrix6<f64>; 2]>,
    /// What follows from the start alone: `δv₁`, `δv̇₁`, and rates of internal states.
    free: Increment,
    rhs: Vec<f64>,
}

impl StepVariation {
    /// Of the step of `equations` to `end`.
    pub fn new(step: &AlphaStep, end: &[crate::motion::Motion], size: usize) -> Self {
        let tangents = step
            .start
            .state
            .motions
            .iter()
            .zip(end)
            .map(|(start, end)| {
                let relative = start.relative(end);
                let inverse = inverse_tangent(&relative.logarithm()).to_twist_matrix();
                [inverse, inverse * relative.inverse().adjoint()]
            });
        StepVariation {
            tangents: tangents.collect(),
            free: Increment {
                x: vec![0.0; size],
                rates: vec![[Vector6::zeros(); 2]; end.len()],
                own_rates: Vec::new(),
            },
            rhs: vec![0.0; size],
        }
    }

    /// Takes from a variation at the end what the start's contributes to their difference:
    /// increments of motions become those of `Ψ`.
    pub fn subtract(&self, start: &Variation, end: &mut Variation) {
        for ((end, start), [inverse, turned]) in
            end.nodes.iter_mut().zip(&start.nodes).zip(&self.tangents)
        {
            end[0] = inverse * end[0] - turned * start[0];
            for part in 1..4 {
                end[part] -= start[part];
            }
        }
        for (end, start) in end.states.iter_mut().zip(&start.states) {
            end.iter_mut()
                .zip(start)
                .for_each(|(end, start)| *end -= start);
        }
    }

    /// Makes the variation of the start that of the end. `solve` solves with the factored Jacobian
    /// of the end, whose tangents are given.
    pub fn propagate(
        &mut self,
        equations: &Collocation,
        step: &AlphaStep,
        tangent: &Tangent,
        variation: &mut Variation,
        solve: impl FnOnce(&mut [f64]) -> bool,
    ) -> bool {
        // As if the end did not move; then what its moving adds.
        let of_nodes = variation.nodes.iter_mut().zip(&self.tangents);
        for ((node, [_, turned]), free) in of_nodes.zip(&mut self.free.rates) {
            let [u, v, rate, a] = &*node;
            let [v1, rate1, a1] = step.end(&-(turned * u), [v, rate, a]);
            *free = [v1, rate1];
            *node = [Vector6::zeros(), v1, rate1, a1];
        }
        for state in &mut variation.states {
            let [x, rate, a] = *state;
            let [rate1, a1] = step.end_of_state(-x, [rate, a]);
            *state = [0.0, rate1, a1];
        }
        self.free.own_rates.clear();
        let rates = variation.states.iter().map(|s| s[1]);
        self.free.own_rates.extend(rates);
        tangent.forces(equations, &self.free, &mut self.rhs);
        self.rhs.iter_mut().for_each(|x| *x = -*x);
        if !solve(&mut self.rhs) {
            return false;
        }
        let scales = equations.column_scale();
        let (first, second) = step.weights();
        for (n, (node, [inverse, _])) in variation.nodes.iter_mut().zip(&self.tangents).enumerate()
        {
            let at = equations.layout().motion(n, 0);
            let scale = Vector6::from_column_slice(&scales[at.clone()]);
            let u = Vector6::from_column_slice(&self.rhs[at]).component_mul(&scale);
            let psi = inverse * u;
            node[0] = u;
            node[1] += psi * first;
            node[2] += psi * second;
            node[3] += psi / (step.method.beta * step.length * step.length);
        }
        let weight = step.state_weight();
        let system = equations.system();
        let own = equations.layout().own();
        for ((place, state), at) in variation.states.iter_mut().enumerate().zip(own) {
            if matches!(system.unknown(place), Unknown::State { .. }) {
                let x = self.rhs[at] * scales[at];
                state[0] = x;
                state[1] += weight * x;
                state[2] += x / (step.method.state_gamma * step.length);
            }
        }
        true
    }
}
