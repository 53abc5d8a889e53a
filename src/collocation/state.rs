//! The unknowns at all grid points.

use crate::elements::{Measure, NodeState, Unknown, nearest_turn};
use crate::fourier::TimeGrid;
use crate::motion::Motion;
use crate::system::{Placed, System};
use crate::workers::Workers;
use serde::{Deserialize, Serialize};

/// Multiply-adds of a motion's increment, about.
const INCREMENT: usize = 200;

/// Angles are followed through larger turns of a node in parts: between them none moves half a
/// turn.
const SAFE_TURN: f64 = 1.0;
/// Parts at most: what turns further in a Newton increment is far from any solution.
const MOST_PARTS: f64 = 100.0;

/// Motions of all nodes and multipliers of all joints over the grid, or at the times of a march.
///
/// For `n` nodes and `N` grid points the unknowns are, in order: for each node and grid point the
/// six increments of its motion, then, for each element with `m` multipliers and each grid point,
/// those.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GridState {
    points: usize,
    /// Motion of node `a` at grid point `k`, at `a N + k`.
    pub motions: Vec<Motion>,
    /// Multipliers, in the order of the unknowns.
    pub multipliers: Vec<f64>,
    /// Tracked coordinate `c` at grid point `k`, at `k × count + c`.
    pub coordinates: Vec<f64>,
    /// Unknowns that belong to no grid point; not saved.
    #[serde(skip)]
    pub scalars: Vec<f64>,
}

impl GridState {
    /// All nodes at rest in their reference motions.
    pub fn reference(system: &System, grid: TimeGrid) -> Self {
        Self::at_points(system, grid.points())
    }

    /// The same at any number of times.
    pub fn at_points(system: &System, points: usize) -> Self {
        let mut state = GridState {
            points,
            motions: system
                .reference()
                .iter()
                .flat_map(|m| std::iter::repeat_n(*m, points))
                .collect(),
            multipliers: vec![0.0; system.own_unknowns() * points],
            coordinates: vec![0.0; system.tracked() * points],
            scalars: Vec::new(),
        };
        for placed in system.elements().iter().filter(|p| p.has_feedback) {
            for k in 0..points {
                let own = state.own_of_mut(placed, k).iter_mut().enumerate();
                own.for_each(|(i, x)| *x = placed.element.initial_state(i));
            }
        }
        state.track(system);
        state
    }

    /// Number of grid points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Motions of one node over the grid.
    pub fn node(&self, node: usize) -> &[Motion] {
        &self.motions[node * self.points..][..self.points]
    }

    /// Tracked coordinates at grid point `k`.
    pub fn tracked(&self, system: &System, k: usize) -> &[f64] {
        let count = system.tracked();
        &self.coordinates[k * count..][..count]
    }

    /// Own unknowns of an element at grid point `k`.
    pub fn own_of(&self, placed: &Placed, k: usize) -> &[f64] {
        &self.multipliers[placed.own_at(self.points, k)]
    }

    /// Own unknowns of an element at grid point `k`, to be changed.
    pub fn own_of_mut(&mut self, placed: &Placed, k: usize) -> &mut [f64] {
        &mut self.multipliers[placed.own_at(self.points, k)]
    }

    /// Place of an element's first own unknown at grid point `k` among those of all elements.
    pub fn first_own(&self, placed: &Placed, k: usize) -> usize {
        placed.own_at(self.points, k).start
    }

    /// What an element's own unknown `row` gains in a period: whole turns, for the internal state
    /// of an angle that does.
    pub fn gain(&self, system: &System, placed: &Placed, row: usize) -> f64 {
        match system.unknown(placed.first_own + row) {
            Unknown::State {
                measure: Measure::Angle,
                tracked,
            } => {
                let first = self.tracked(system, 0)[tracked];
                let last = self.tracked(system, self.points - 1)[tracked];
                nearest_turn(first, last) - first
            }
            _ => 0.0,
        }
    }

    /// Writes all unknowns of grid point `k` from another state's grid point `from`.
    pub fn copy_point(&mut self, system: &System, k: usize, other: &GridState, from: usize) {
        for node in 0..system.nodes() {
            self.motions[node * self.points + k] = other.motions[node * other.points + from];
        }
        for placed in system.elements() {
            self.own_of_mut(placed, k)
                .copy_from_slice(other.own_of(placed, from));
        }
        let count = system.tracked();
        self.coordinates[k * count..][..count].copy_from_slice(other.tracked(system, from));
    }

    /// Largest difference of motions: positions relative to `length`, entries of rotation matrices.
    pub fn distance(&self, other: &GridState, length: f64) -> f64 {
        self.motions
            .iter()
            .zip(&other.motions)
            .fold(0.0, |largest: f64, (a, b)| {
                largest
                    .max((a.position - b.position).amax() / length)
                    .max((a.rotation - b.rotation).amax())
            })
    }

    /// Follows the tracked coordinates to the present motions.
    pub fn track(&mut self, system: &System) {
        for k in 0..self.points {
            self.track_point(system, k);
        }
    }

    fn track_point(&mut self, system: &System, k: usize) {
        let (motions, points, count) = (&self.motions, self.points, system.tracked());
        system.track(
            |node| NodeState::at_rest(motions[node * points + k]),
            &mut self.coordinates[k * count..][..count],
        );
    }

    /// Adds tracked coordinates to a state that was kept with the first `old` of them only.
    pub fn complete_tracked(&mut self, system: &System, old: usize) {
        let count = system.tracked();
        if count == old || self.coordinates.len() != old * self.points {
            return;
        }
        let mut all = vec![0.0; count * self.points];
        for k in 0..self.points {
            all[k * count..][..old].copy_from_slice(&self.coordinates[k * old..][..old]);
        }
        self.coordinates = all;
        for k in 0..self.points {
            if k > 0 {
                self.coordinates
                    .copy_within((k - 1) * count + old..k * count, k * count + old);
            }
            self.track_point(system, k);
        }
    }

    /// Follows the tracked coordinates as [`track`](Self::track) does, through increments that may
    /// turn nodes far: `increment` of the motions before, in parts.
    fn track_along(&mut self, system: &System, before: &Self, increment: &[f64], step: f64) {
        let turns = increment.chunks_exact(6).map(|u| {
            let turn = u[3] * u[3] + u[4] * u[4] + u[5] * u[5];
            (step * turn.sqrt()).abs()
        });
        let largest = turns.fold(0.0, f64::max);
        let parts = (largest / SAFE_TURN).ceil().clamp(1.0, MOST_PARTS) as usize;
        let count = system.tracked();
        if count == 0 {
            return;
        }
        for part in 1..parts {
            let fraction = step * part as f64 / parts as f64;
            for k in 0..self.points {
                let motion = |node: usize| {
                    let at = node * before.points + k;
                    let u = nalgebra::Vector6::from_column_slice(&increment[6 * at..][..6]);
                    before.motions[at].increment(&(u * fraction))
                };
                system.track(
                    |node| NodeState::at_rest(motion(node)),
                    &mut self.coordinates[k * count..][..count],
                );
            }
        }
        self.track(system);
    }

    /// Follows the tracked coordinates from each point to the next: nothing else tells their whole
    /// turns.
    pub fn track_through(&mut self, system: &System) {
        let count = system.tracked();
        for k in 0..self.points {
            if k > 0 {
                self.coordinates
                    .copy_within((k - 1) * count..k * count, k * count);
            }
            self.track_point(system, k);
        }
    }

    /// The state after the fraction `step` of a Newton increment of all unknowns.
    pub fn incremented(&self, system: &System, increment: &[f64], step: f64) -> Self {
        let (all, alone) = (|_| self.points, Workers::default());
        self.incremented_some((system, &alone), (increment, step), &all, |_| ())
    }

    /// The same where motions of each node are incremented at so many grid points, from the first
    /// on; all others follow by `complete`.
    pub(super) fn incremented_some(
        &self,
        (system, workers): (&System, &Workers),
        (increment, step): (&[f64], f64),
        points_of: &(impl Fn(usize) -> usize + Sync),
        complete: impl FnOnce(&mut [Motion]),
    ) -> Self {
        let mut next = self.clone();
        let layout = system.layout(self.points).with_scalars(self.scalars.len());
        let motions = &increment[layout.motions()];
        let workers = workers.for_work(INCREMENT * next.motions.len());
        let mut nodes: Vec<_> = next.motions.chunks_exact_mut(self.points).collect();
        workers.each(&mut nodes, |node, of_node| {
            let increments = motions[layout.node(node)].chunks_exact(6);
            let some = of_node.iter_mut().take(points_of(node));
            for (motion, u) in some.zip(increments) {
                let u = nalgebra::Vector6::from_column_slice(u) * step;
                *motion = motion.increment(&u).renormalised();
            }
        });
        complete(&mut next.motions);
        next.track_along(system, self, motions, step);
        let add = |(value, change): (&mut f64, &f64)| *value += step * change;
        let own = &increment[layout.own()];
        next.multipliers.iter_mut().zip(own).for_each(add);
        let scalars = &increment[layout.scalars()];
        next.scalars.iter_mut().zip(scalars).for_each(add);
        next
    }

    /// The state after the time `passed`, where one follows `before` and this one: each with the
    /// time to the state after it. Linear in the steps; of second degree with one more, `earlier`.
    pub fn extrapolated(
        &self,
        system: &System,
        (before, last): (&Self, f64),
        earlier: Option<(&Self, f64)>,
        passed: f64,
    ) -> Self {
        let ratio = passed / last;
        let (weight, weight_of_first) = earlier.map_or((ratio, 0.0), |(_, first)| {
            let more = (last + passed) / (last + first);
            (ratio * (1.0 + more), -passed / first * more)
        });
        let first = earlier.map_or(before, |(earlier, _)| earlier);
        let mut next = self.clone();
        let past = before.motions.iter().zip(&first.motions);
        for (motion, (before, first)) in next.motions.iter_mut().zip(past) {
            let mut step = before.relative(motion).logarithm() * weight;
            if earlier.is_some() {
                step += first.relative(before).logarithm() * weight_of_first;
            }
            *motion = motion.increment(&step).renormalised();
        }
        let past = before.multipliers.iter().zip(&first.multipliers);
        for (value, (before, first)) in next.multipliers.iter_mut().zip(past) {
            *value += weight * (*value - before) + weight_of_first * (before - first);
        }
        next.track(system);
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_models::pendulums::oscillator;
    use nalgebra::Vector3;

    #[test]
    fn distances_are_relative_to_the_length() {
        let (model, _) = oscillator();
        let system = System::new(&model, 1.0).unwrap();
        let state = GridState::at_points(&system, 1);
        let mut moved = state.clone();
        moved.motions[0].position += Vector3::y() * 0.3;
        assert!((state.distance(&moved, 2.0) - 0.15).abs() < 1e-15);
        assert!((state.distance(&moved, 0.5) - 0.6).abs() < 1e-15);
    }
}
