//! The unknowns at the points of another grid of the same period.

use super::like_blades::Leaders;
use super::state::GridState;
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{Resampling, Slope, TimeGrid};
use crate::motion::{DualMatrix, Motion, PeriodicMotion};
use crate::system::System;
use crate::workers::Workers;

/// Motions, velocities and accelerations of all nodes, interpolated over the period
/// (docs/theory.md, section 3).
#[derive(Debug, Clone)]
pub struct ResampledNodes {
    /// Node `a` at time `k` of `n`, at `a n + k`.
    pub states: Vec<NodeState>,
}

/// Own unknowns of elements, and their rates.
pub(super) struct ResampledOwn {
    /// Unknown `i` of the system at time `k` of `n`, at `i n + k`.
    pub values: Vec<f64>,
    pub rates: Vec<f64>,
}

/// Resamples one node at a time.
struct NodeResampling<'a> {
    resampling: Resampling,
    slopes: &'a [Slope],
    column: Vec<f64>,
    /// Of the motions and their first and second derivatives, at each time.
    sums: Vec<[DualMatrix; 3]>,
    motion: PeriodicMotion,
}

impl<'a> NodeResampling<'a> {
    fn new(resampling: &Resampling, slopes: &'a [Slope]) -> Self {
        let points = resampling.points();
        NodeResampling {
            resampling: resampling.clone(),
            slopes,
            column: vec![0.0; points],
            sums: vec![[DualMatrix::zeros(); 3]; points],
            motion: PeriodicMotion::default(),
        }
    }

    /// Writes the states of one node, at so many times as there is room for, from the first on.
    fn resample(&mut self, state: &GridState, node: usize, out: &mut [NodeState]) -> Result<()> {
        self.motion.set(state.node(node));
        self.motion
            .resample(&mut self.resampling, &mut self.column, &mut self.sums);
        for ([_, first, second], slope) in self.sums.iter_mut().zip(self.slopes) {
            [*first, *second] = slope.by_time(*first, *second);
        }
        for (k, (out, sums)) in out.iter_mut().zip(&self.sums).enumerate() {
            *out = self.motion.state(sums).ok_or_else(|| {
                let grid = self.resampling.grid();
                too_coarse(node, grid.at(self.resampling.pseudo(k)), grid.points())
            })?;
        }
        Ok(())
    }
}

/// How derivatives by time follow at the points of a resampling; none if time is pseudo-time.
fn slopes(resampling: &Resampling) -> Vec<Slope> {
    let grid = resampling.grid();
    if grid.map().is_identity() {
        return Vec::new();
    }
    let places = 0..resampling.points();
    places.map(|k| grid.slope(resampling.pseudo(k))).collect()
}

impl ResampledNodes {
    /// The nodes of `state` where `resampling` goes from its grid; if blades move alike, at as many
    /// times equally far from each other, from the nodes that lead.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::GridTooCoarse`] if a motion cannot be interpolated.
    pub(super) fn new(
        system: &System,
        resampling: &Resampling,
        (state, leaders): (&GridState, Option<&Leaders>),
        workers: &Workers,
    ) -> Result<Self> {
        let (points, slopes) = (resampling.points(), slopes(resampling));
        let mut states = vec![NodeState::at_rest(Motion::identity()); system.nodes() * points];
        let mut nodes: Vec<&mut [NodeState]> = states.chunks_exact_mut(points).collect();
        workers.try_for_each(
            &mut nodes,
            &mut Vec::new(),
            || NodeResampling::new(resampling, &slopes),
            |resampling, node, out| match leaders {
                Some(leaders) if !leaders.leads(node) => Ok(()),
                Some(leaders) => {
                    let told = leaders.points_of(node, points);
                    resampling.resample(state, node, &mut out[..told])
                }
                None => resampling.resample(state, node, out),
            },
        )?;
        if let Some(leaders) = leaders {
            leaders.repeat_states(&mut states);
        }
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
        let resampling = Resampling::between(grid, start, other);
        self.resampled_alike(system, &resampling, (other, None), workers)
    }

    /// The same where `resampling` goes from its grid; if blades move alike, from what leads on the
    /// other grid, the first points of both being the same.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn resampled_alike(
        &self,
        system: &System,
        resampling: &Resampling,
        (other, leaders): (TimeGrid, Option<&Leaders>),
        workers: &Workers,
    ) -> Result<GridState> {
        let nodes = ResampledNodes::new(system, resampling, (self, leaders), workers)?;
        let own = self.resampled_own(system, resampling);
        Ok(self.made_of(system, resampling, (&nodes, &own), other))
    }

    /// The same, of what was resampled.
    pub(super) fn made_of(
        &self,
        system: &System,
        resampling: &Resampling,
        (nodes, own): (&ResampledNodes, &ResampledOwn),
        other: TimeGrid,
    ) -> GridState {
        let (points, before) = (other.points(), resampling.grid().points());
        let mut result = GridState::reference(system, other);
        result.scalars.clone_from(&self.scalars);
        for (motion, state) in result.motions.iter_mut().zip(&nodes.states) {
            *motion = state.motion;
        }
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
            let turns = resampling.pseudo(k);
            // Written so that rounding does not go a point back.
            let place = (turns - turns.floor()) * before as f64 * (1.0 + 1e-12);
            let last = (place as usize).min(before - 1);
            result.coordinates[k * count..][..count].copy_from_slice(self.tracked(system, last));
        }
        result.track(system);
        result
    }

    /// Own unknowns of elements where `resampling` goes from its grid.
    pub(super) fn resampled_own(&self, system: &System, resampling: &Resampling) -> ResampledOwn {
        let (grid, points) = (resampling.grid(), resampling.points());
        let slopes = slopes(resampling);
        let mut own = ResampledOwn {
            values: vec![0.0; system.own_unknowns() * points],
            rates: vec![0.0; system.own_unknowns() * points],
        };
        let mut resampling = resampling.clone();
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
                    let turns = resampling.pseudo(k);
                    *value += gain * (turns - turns.floor());
                    *rate += gain / grid.period();
                    *rate *= slopes.get(k).map_or(1.0, |slope| slope.rate);
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
