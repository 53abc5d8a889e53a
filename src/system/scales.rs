//! Characteristic scales, so that nothing in the solution depends on the user's units.
//! See docs/theory.md, section 5.4.

use super::System;
use crate::elements::{Coordinate, Measure, NodeState, StressLaw, Unknown};
use crate::error::Result;
use nalgebra::Vector6;
use std::f64::consts::TAU;

/// Characteristic length, mass and force of a system in its reference configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Diagonal of the box around all nodes or, for a single body, its radius of gyration.
    pub length: f64,
    /// Total mass.
    pub mass: f64,
    /// The largest force that a displacement of `length` or an acceleration of `length Ω²` can
    /// cause, in a march `length / h²` for steps of `h`, so that the matrices of small steps stay
    /// well scaled; at a standstill, the largest force that such a displacement or the loads can
    /// cause.
    pub force: f64,
}

impl Default for Scales {
    fn default() -> Self {
        Scales {
            length: 1.0,
            mass: 1.0,
            force: 1.0,
        }
    }
}

impl Scales {
    /// Size of an increment, or of a velocity or acceleration, `[linear; angular]`: its largest
    /// component, linear ones relative to the characteristic length.
    pub fn size_of(&self, v: &Vector6<f64>) -> f64 {
        let linear = v.fixed_rows::<3>(0).amax() / self.length;
        linear.max(v.fixed_rows::<3>(3).amax())
    }

    /// Scales of `system`. Of `blades` that are said to be alike, given by their nodes, the first
    /// tells.
    pub(super) fn of(system: &System, blades: &[Vec<usize>]) -> Result<Self> {
        let mut blade_of = vec![None; system.nodes()];
        for (j, nodes) in blades.iter().enumerate() {
            nodes.iter().for_each(|&node| blade_of[node] = Some(j));
        }
        let mut signals = vec![0.0; system.signals()];
        if system.standstill().is_some() {
            system.signal_values(0.0, 1.0, &mut signals)?;
        }
        let at_rest = |node: usize| NodeState::at_rest(system.reference[node]);
        let mut workspace = system.workspace(true);
        let (mut mass, mut gyration2) = (0.0, 0.0f64);
        let (mut linear, mut angular) = (0.0f64, 0.0f64);
        let (mut load_force, mut load_moment) = (0.0f64, 0.0f64);
        for placed in system.elements() {
            let nodes = placed.element.nodes().iter();
            let stands_for = match nodes.filter_map(|&node| blade_of[node]).max() {
                None => 1.0,
                Some(0) => blades.len() as f64,
                Some(_) => continue,
            };
            let out = system.evaluate_relaxed(placed, at_rest, &signals, &mut workspace)?;
            let nodes = placed.element.nodes().len();
            for a in 0..nodes {
                // A node is coupled with itself.
                let Some((_, column)) = out.place(a, a) else {
                    continue;
                };
                for k in 0..3 {
                    load_force = load_force.max(out.force[6 * a + k].abs());
                    load_moment = load_moment.max(out.force[6 * a + 3 + k].abs());
                    linear = linear.max(out.stiffness[(6 * a + k, column + k)].abs());
                    angular = angular.max(out.stiffness[(6 * a + 3 + k, column + 3 + k)].abs());
                    let m = out.mass[(6 * a + k, column + k)];
                    if m > 0.0 {
                        gyration2 = gyration2.max(out.mass[(6 * a + 3 + k, column + 3 + k)] / m);
                    }
                    mass += (0..nodes)
                        .filter_map(|b| out.place(a, b))
                        .map(|(row, column)| out.mass[(row + k, column + k)])
                        .sum::<f64>()
                        * (stands_for / 3.0);
                }
            }
        }
        let mut length = system.extent();
        if length <= 0.0 {
            length = gyration2.sqrt();
        }
        if length <= 0.0 {
            length = 1.0;
        }
        // At a standstill no time is characteristic, but the loads are known.
        let other = if system.standstill().is_some() {
            load_force.max(load_moment / length)
        } else {
            let rate = system.regime.characteristic_frequency();
            mass * length * rate * rate
        };
        let mut force = (linear * length).max(angular / length).max(other);
        if force <= 0.0 {
            force = 1.0;
        }
        Ok(Scales {
            length,
            mass,
            force,
        })
    }
}

impl System {
    /// Scales of the equation and of the unknown of an own unknown of an element: equations times
    /// the first, and unknowns over the second, have no units.
    pub fn own_scales(&self, place: usize) -> [f64; 2] {
        let (length, force) = (self.scales().length, self.scales().force);
        let scale = |measure: Measure| match measure {
            Measure::Length => (length, force),
            Measure::Angle => (1.0, force * length),
        };
        match self.unknown(place) {
            Unknown::Multiplier(measure) => {
                let (motion, effort) = scale(measure);
                [1.0 / motion, effort]
            }
            Unknown::State { measure, .. } => {
                let (motion, effort) = scale(measure);
                [1.0 / effort, motion]
            }
            Unknown::UserState => [self.period() / TAU, 1.0],
        }
    }

    /// Axial or shear stiffness of beams relative to that in bending or torsion, for curvatures
    /// over the characteristic length: the largest of all stations, zero without beams.
    pub fn slenderness(&self) -> f64 {
        let laws = self
            .elements
            .iter()
            .flat_map(|placed| placed.element.stress_laws());
        let of = |law: StressLaw| {
            let diagonal = law.stiffness.diagonal();
            diagonal.fixed_rows::<3>(0).max() / diagonal.fixed_rows::<3>(3).min()
        };
        laws.map(of).fold(0.0, f64::max) * self.scales.length * self.scales.length
    }

    /// Diagonal of the box around all nodes.
    pub(super) fn extent(&self) -> f64 {
        let first = self.reference[0].position;
        let (low, high) = self
            .reference
            .iter()
            .fold((first, first), |(low, high), m| {
                (low.inf(&m.position), high.sup(&m.position))
            });
        (high - low).norm()
    }
}

/// What a joint coordinate and its rate are of the order of, in a mechanism of this length and
/// circular frequency.
pub(super) fn coordinate_scales(coordinate: Coordinate, length: f64, frequency: f64) -> [f64; 2] {
    let size = match coordinate.measure() {
        Measure::Angle => 1.0,
        Measure::Length => length,
    };
    [size, size * frequency]
}
