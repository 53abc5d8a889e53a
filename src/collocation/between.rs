//! The equations between grid points: where aliasing shows, since collocation does not look there.

use super::resampled::{ResampledNodes, dual, primal};
use super::state::GridState;
use crate::elements::{Measure, NodeState, Unknown};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{CardinalWeights, Resampling, SpectralFilter, TimeGrid};
use crate::motion::{DualMatrix, DualPolar, Motion};
use crate::system::{Conditions, OwnValues, System};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A node's motions over the grid, ready to be interpolated (section 4).
#[derive(Debug, Clone)]
pub struct NodeInterpolation {
    /// `M_k`, with the mean position taken out.
    motions: Vec<DualMatrix>,
    mean: Vector3<f64>,
}

impl NodeInterpolation {
    /// Interpolation of `motions` at the grid points.
    pub fn new(motions: &[Motion]) -> Self {
        let mean = motions.iter().map(|m| m.position).sum::<Vector3<f64>>() / motions.len() as f64;
        NodeInterpolation {
            motions: motions
                .iter()
                .map(|m| Motion::new(m.rotation, m.position - mean).to_dual())
                .collect(),
            mean,
        }
    }

    /// The same with harmonics weakened by a filter; motions remain motions of rigid bodies.
    pub fn filtered(motions: &[Motion], grid: TimeGrid, filter: &SpectralFilter) -> Self {
        let mut interpolation = Self::new(motions);
        let mut resampling = Resampling::new(grid, 0.0, grid.points());
        let mut samples = vec![0.0; grid.points()];
        for entry in 0..9 {
            for part in [primal, dual] {
                let motions = &mut interpolation.motions;
                resampling.read(motions.iter_mut().map(|m| part(m)[entry]));
                resampling.filter(filter);
                resampling.write(0, 0, &mut samples);
                for (m, sample) in motions.iter_mut().zip(&samples) {
                    part(m)[entry] = *sample;
                }
            }
        }
        interpolation
    }

    /// Motion, velocity and acceleration at the time of `weights`; `None` if the grid is too coarse.
    pub fn at(&self, weights: &CardinalWeights) -> Option<NodeState> {
        let mut sums = [DualMatrix::zeros(); 3];
        for (k, m) in self.motions.iter().enumerate() {
            sums[0] += *m * weights.value[k];
            sums[1] += *m * weights.first[k];
            sums[2] += *m * weights.second[k];
        }
        let polar = DualPolar::new(&sums[0])?;
        let velocity = polar.velocity(&sums[1]);
        let acceleration = polar.acceleration(&velocity, &sums[1], &sums[2]);
        let mut motion = polar.motion();
        motion.position += self.mean;
        Some(NodeState {
            motion,
            twist: velocity.to_twist(),
            twist_rate: acceleration.to_twist(),
        })
    }
}

/// The error of a grid too coarse for the motion of `node` at `time`.
pub fn too_coarse(node: usize, time: f64, points: usize) -> Error {
    Error::new(
        ErrorKind::GridTooCoarse,
        format!(
            "the grid of {points} points is too coarse to interpolate the motion of node {node} at \
             t = {time}; use more grid points"
        ),
    )
}

/// Largest residuals half-way between grid points.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ResidualBetween {
    /// Of forces (moments divided by the characteristic length), relative to the largest force that
    /// any element exerts on a node.
    pub force: f64,
    /// Of constraints: lengths relative to the characteristic length, angles in radians.
    pub constraint: f64,
    /// Time at which the residual of forces is largest.
    #[serde(default)]
    pub time: f64,
}

impl ResidualBetween {
    /// Nothing is known of it.
    pub fn unknown() -> Self {
        ResidualBetween {
            force: f64::INFINITY,
            constraint: f64::INFINITY,
            time: 0.0,
        }
    }
}

/// Evaluates the governing equations at the points that a twice finer grid adds.
///
/// # Errors
/// [`ErrorKind::GridTooCoarse`] if a motion cannot be interpolated, or a failing callback.
pub fn residual_between(
    system: &System,
    grid: TimeGrid,
    state: &GridState,
) -> Result<ResidualBetween> {
    let points = grid.points();
    let half = 0.5 / points as f64;
    let nodes = ResampledNodes::new(system, grid, state, half, points)?;
    let mut workspace = system.workspace(false);
    let mut signals = vec![0.0; system.signals()];
    let mut multipliers = vec![0.0; system.multipliers()];
    let mut rates = vec![0.0; system.multipliers()];
    let unknowns = state.resampled_own(system, grid, half, points);
    let mut sums = vec![nalgebra::Vector6::<f64>::zeros(); system.nodes()];
    let length = system.scales().length;
    // Force components, and moments over the characteristic length.
    let size = |f: &nalgebra::Vector6<f64>| {
        f.fixed_rows::<3>(0)
            .amax()
            .max(f.fixed_rows::<3>(3).amax() / length)
    };
    let (mut residual, mut level, mut constraint) = (0.0f64, 0.0f64, 0.0f64);
    let mut worst = 0.0;
    let mut overflow = false;
    for k in 0..points {
        let time = grid.time(k) + 0.5 * grid.period() / points as f64;
        system.signal_values(time, 1.0, &mut signals)?;
        for placed in system.elements() {
            for row in 0..placed.element.multipliers() {
                let place = placed.first_multiplier + row;
                multipliers[place] = unknowns.values[place * points + k];
                if placed.has_states {
                    rates[place] = unknowns.rates[place * points + k];
                }
            }
        }
        let mut here = 0.0f64;
        sums.fill(nalgebra::Vector6::zeros());
        let conditions = Conditions {
            time,
            signals: &signals,
            coordinates: state.tracked(system, k),
            inertia_factor: 1.0,
        };
        for placed in system.elements() {
            let range =
                placed.first_multiplier..placed.first_multiplier + placed.element.multipliers();
            let own = OwnValues {
                values: &multipliers[range.clone()],
                rates: &rates[range],
                resultants: &[],
            };
            let out = system.evaluate(
                placed,
                |n| nodes.states[n * points + k],
                &conditions,
                own,
                &mut workspace,
            )?;
            overflow |= !out
                .force
                .iter()
                .chain(&out.constraint)
                .all(|x| x.is_finite());
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                let force = out.force.fixed_rows::<6>(6 * local).into_owned();
                level = level.max(size(&force));
                sums[node] += force;
            }
            for (row, violation) in out.constraint.iter().enumerate() {
                match system.unknown(placed.first_multiplier + row) {
                    Unknown::Multiplier(Measure::Length) => {
                        constraint = constraint.max(violation.abs() / length);
                    }
                    Unknown::Multiplier(Measure::Angle) => {
                        constraint = constraint.max(violation.abs())
                    }
                    // Internal states are balanced by forces and moments.
                    Unknown::State { measure, .. } => {
                        let scale = match measure {
                            Measure::Length => 1.0,
                            Measure::Angle => length,
                        };
                        here = here.max(violation.abs() / scale);
                    }
                }
            }
        }
        here = sums.iter().fold(here, |r, f| r.max(size(f)));
        if here > residual {
            (residual, worst) = (here, time);
        }
    }
    let relative = if level > 0.0 { residual / level } else { 0.0 };
    // Forces beyond any number say nothing, and say so.
    let known = |x: f64| {
        if overflow || !x.is_finite() {
            f64::INFINITY
        } else {
            x
        }
    };
    Ok(ResidualBetween {
        force: known(relative),
        constraint: known(constraint),
        time: worst,
    })
}
