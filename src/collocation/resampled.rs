//! The unknowns at the points of another grid of the same period.

use super::state::GridState;
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{Resampling, TimeGrid};
use crate::motion::{DualMatrix, Motion, PeriodicMotion};
use crate::system::System;
use crate::workers::Workers;

/// Motions, velocities and accelerations of all nodes, interpolated over the period
/// (docs/theory.md, section 3) at equispaced times.
#[derive(Debug, Clone)]
pub struct ResampledNodes {
    /// Node `a` at time `k` of `n`, at `a n + k`.
    pub states: Vec<NodeState>,
}

/// Own unknowns of elements at equispaced times, and their rates.
pub(super) struct ResampledOwn {
    /// Unknown `i` of the system at time `k` of `n`, at `i n + k`.
    pub values: Vec<f64>,
    pub rates: Vec<f64>,
}

/// Resamples one node at a time.
struct NodeResampling {
    resampling: Resampling,
    grid: TimeGrid,
    start: f64,
    column: Vec<f64>,
    /// Of the motions and their first and second derivatives, at each time.
    sums: Vec<[DualMatrix; 3]>,
    motion: PeriodicMotion,
}

impl NodeResampling {
    fn new(grid: TimeGrid, start: f64, points: usize) -> Self {
        NodeResampling {
            resampling: Resampling::new(grid, start, points),
            grid,
            start,
            column: vec![0.0; points],
            sums: vec![[DualMatrix::zeros(); 3]; points],
            motion: PeriodicMotion::default(),
        }
    }

    /// Writes the states of one node.
    fn resample(&mut self, state: &GridState, node: usize, out: &mut [NodeState]) -> Result<()> {
        let points = out.len();
        self.motion.set(state.node(node));
        self.motion
            .resample(&mut self.resampling, &mut self.column, &mut self.sums);
        for (k, (out, sums)) in out.iter_mut().zip(&self.sums).enumerate() {
            *out = self.motion.state(sums).ok_or_else(|| {
                let time = self.grid.period() * (self.start + k as f64 / points as f64);
                too_coarse(node, time, self.grid.points())
            })?;
        }
        Ok(())
    }
}

impl ResampledNodes {
    /// The nodes of `state` on `grid` at `points` (odd) times of a period, the first of them
    /// `start` periods after its first point.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::GridTooCoarse`] if a motion cannot be interpolated.
    pub fn new(
        system: &System,
        grid: TimeGrid,
        state: &GridState,
        start: f64,
        points: usize,
        workers: &Workers,
    ) -> Result<Self> {
        let mut states = vec![NodeState::at_rest(Motion::identity()); system.nodes() * points];
        let mut nodes: Vec<&mut [NodeState]> = states.chunks_exact_mut(points).collect();
        workers.try_for_each(
            &mut nodes,
            &mut Vec::new(),
            || NodeResampling::new(grid, start, points),
            |resampling, node, out| resampling.resample(state, node, out),
        )?;
        Ok(ResampledNodes { states })
    }
}

impl GridState {
    /// This state, on `grid`, at the points of `other`, whose period is taken for the same; its
    /// first point is `start` periods after that of `grid`.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::GridTooCoarse`] if a motion cannot be interpolated.
    pub fn resampled(
        &self,
        system: &System,
        grid: TimeGrid,
        start: f64,
        other: TimeGrid,
        workers: &Workers,
    ) -> Result<GridState> {
        let points = other.points();
        let nodes = ResampledNodes::new(system, grid, self, start, points, workers)?;
        let mut result = GridState::reference(system, other);
        result.scalars.clone_from(&self.scalars);
        for (motion, state) in result.motions.iter_mut().zip(&nodes.states) {
            *motion = state.motion;
        }
        let own = self.resampled_own(system, grid, start, points);
        for placed in system.elements() {
            for k in 0..points {
                let values = result.own_of_mut(placed, k);
                for (row, value) in values.iter_mut().enumerate() {
                    *value = own.values[(placed.first_own + row) * points + k];
                }
            }
        }
        // The turns of tracked angles are those of the old grid point before.
        let count = system.tracked();
        for k in 0..points {
            let turns = start + k as f64 / points as f64;
            // Written so that rounding does not go a point back.
            let place = (turns - turns.floor()) * grid.points() as f64 * (1.0 + 1e-12);
            let before = (place as usize).min(grid.points() - 1);
            result.coordinates[k * count..][..count].copy_from_slice(self.tracked(system, before));
        }
        result.track(system);
        Ok(result)
    }

    /// Own unknowns of elements at `points` (odd) times of a period, from `start` periods on.
    pub(super) fn resampled_own(
        &self,
        system: &System,
        grid: TimeGrid,
        start: f64,
        points: usize,
    ) -> ResampledOwn {
        let mut own = ResampledOwn {
            values: vec![0.0; system.own_unknowns() * points],
            rates: vec![0.0; system.own_unknowns() * points],
        };
        let mut resampling = Resampling::new(grid, start, points);
        for placed in system.elements() {
            for row in 0..placed.element.own_unknowns() {
                let gain = self.gain(system, placed, row);
                resampling.read((0..grid.points()).map(|l| {
                    let steady = gain * l as f64 / grid.points() as f64;
                    self.own_of(placed, l)[row] - steady
                }));
                let place = (placed.first_own + row) * points;
                let (values, rates) = (
                    &mut own.values[place..][..points],
                    &mut own.rates[place..][..points],
                );
                resampling.write(0, 0, values);
                resampling.write(1, 0, rates);
                for (k, (value, rate)) in values.iter_mut().zip(rates).enumerate() {
                    // Within one period, as tracked angles are.
                    let turns = start + k as f64 / points as f64;
                    *value += gain * (turns - turns.floor());
                    *rate += gain / grid.period();
                }
            }
        }
        own
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
