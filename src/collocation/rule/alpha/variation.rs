//! How the end of a step varies with its start: exact linearisation of the generalised-α method.
//! See docs/theory.md, section 12.3.

use super::{AlphaStep, MotionState};
use crate::collocation::problem::Collocation;
use crate::elements::{Measure, Unknown};
use crate::motion::{Motion, inverse_tangent, product};
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
                Unknown::UserState => Some((place, 1.0)),
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

    /// Places of the internal states among the own unknowns.
    pub fn states(&self) -> impl Iterator<Item = usize> {
        self.states.iter().map(|s| s.0)
    }

    /// What each entry is measured in.
    pub fn units(&self) -> impl Iterator<Item = f64> {
        let of_node = |i: usize| self.node_scale(i % 24 / 6, i % 6);
        let of_state = |&(_, unit): &(usize, f64)| [0, 1, 2].map(|p| self.state_scale(unit, p));
        let nodes = (0..24 * self.nodes).map(of_node);
        nodes.chain(self.states.iter().flat_map(of_state))
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
pub struct StepVariation<'a> {
    step: &'a AlphaStep,
    /// `T⁻¹(Ψ)` and `T⁻¹(Ψ) Ad(exp(−Ψ))` of each node.
    tangents: Vec<[Matrix6<f64>; 2]>,
}

impl<'a> StepVariation<'a> {
    /// Of the step whose nodes end at `end`.
    pub fn new(step: &'a AlphaStep, end: &[Motion]) -> Self {
        let nodes = step.start.state.motions.iter().zip(end);
        let tangents = nodes.map(|(start, end)| {
            let relative = start.relative(end);
            let inverse = inverse_tangent(&relative.logarithm()).to_twist_matrix();
            [inverse, inverse * relative.inverse().adjoint()]
        });
        StepVariation {
            step,
            tangents: tangents.collect(),
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

    /// Makes a node's variation at the start, `δu`, `δv`, `δv̇` and `δa`, that of an end that does
    /// not move.
    pub fn hold(&self, node: usize, entries: &mut [f64]) {
        let part = |p: usize| Vector6::from_column_slice(&entries[6 * p..][..6]);
        let [u, v, rate, a] = [0, 1, 2, 3].map(part);
        let psi = -product(&self.tangents[node][1], &u);
        entries[..6].fill(0.0);
        let held = self.step.end(&psi, [&v, &rate, &a]);
        for (entries, held) in entries[6..].chunks_exact_mut(6).zip(&held) {
            entries.copy_from_slice(held.as_slice());
        }
    }

    /// Adds to a node's variation what its end's moving by `u` does.
    pub fn carry(&self, node: usize, u: &Vector6<f64>, entries: &mut [f64]) {
        let step = self.step;
        let psi = product(&self.tangents[node][0], u);
        let (first, second) = step.weights();
        let averaged = 1.0 / (step.method.beta * step.length * step.length);
        entries[..6].copy_from_slice(u.as_slice());
        let parts = entries[6..].chunks_exact_mut(6);
        for (entries, weight) in parts.zip([first, second, averaged]) {
            entries
                .iter_mut()
                .zip(&psi)
                .for_each(|(x, psi)| *x += psi * weight);
        }
    }

    /// [`StepVariation::hold`] of an internal state: `δx`, `δẋ` and the like of `δa`.
    pub fn hold_state(&self, entries: &mut [f64]) {
        let [rate, a] = self
            .step
            .end_of_state(-entries[0], [entries[1], entries[2]]);
        entries.copy_from_slice(&[0.0, rate, a]);
    }

    /// [`StepVariation::carry`] of an internal state.
    pub fn carry_state(&self, x: f64, entries: &mut [f64]) {
        let step = self.step;
        entries[0] = x;
        entries[1] += step.state_weight() * x;
        entries[2] += x / (step.method.state_gamma * step.length);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn displacements_have_the_unit_of_length_and_turns_have_none() {
        let scales = VariationScales {
            length: 3.0,
            time: 0.5,
            states: Vec::new(),
            nodes: 1,
            own: 0,
        };
        let units: Vec<f64> = scales.units().collect();
        for (part, power) in [0, 1, 2, 2].into_iter().enumerate() {
            let rate = 2.0f64.powi(power);
            let exact = [3.0 * rate, 3.0 * rate, 3.0 * rate, rate, rate, rate];
            assert_eq!(units[6 * part..][..6], exact);
        }
    }
}
