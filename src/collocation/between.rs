//! The equations between grid points: where aliasing shows, since collocation does not look there.
//!
//! A force of the harmonic `a + pN` counts on the grid as one of the harmonic `a`. The part `θ` of
//! an interval after each grid point, it is off by the factor `exp(2πi pθ) − 1`: half-way between
//! them nothing shows where `p` is even. With the golden section, `pθ` is as far from whole numbers
//! as can be, for all `p`. See docs/theory.md, section 10.2.

use super::like_blades::Leaders;
use super::problem::Collocation;
use super::resampled::ResampledNodes;
use super::state::GridState;
use crate::elements::{InertialForces, Measure, NodeState, Unknown};
use crate::error::Result;
use crate::fourier::{Analysis, Resampling, TimeGrid};
use crate::system::{Conditions, OwnValues, System, Workspace};
use crate::workers::Workers;
use nalgebra::Vector6;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Where between two grid points the equations are looked at: the golden section of the interval.
pub(super) const PART: f64 = 0.381_966_011_250_105_1;

/// Largest residuals between grid points, at their golden section.
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

/// The equations between grid points, an equal part of an interval after each.
#[derive(Debug, Clone)]
pub struct Defect {
    /// Largest of them.
    pub largest: ResidualBetween,
    /// All of them, not scaled, time by time: the forces on each node, then the own equations of
    /// the elements.
    pub(super) rows: Vec<f64>,
    pub(super) count: usize,
    /// The nodes then.
    pub(super) nodes: ResampledNodes,
    /// Grid points after which like blades are where others were; all of them else.
    part: usize,
}

/// What is left of the equations at one time.
#[derive(Debug, Clone, Default)]
struct Unbalance {
    /// All of it, of the nodes and then of the elements.
    rows: Vec<f64>,
    /// Of forces.
    force: f64,
    /// Largest force that an element exerts.
    level: f64,
    /// Of constraints.
    constraint: f64,
    /// Whether anything is beyond any number.
    overflow: bool,
}

impl Unbalance {
    /// Of what is asked of own unknowns of an element, from the first on.
    fn add_own(&mut self, system: &System, (first, asked): (usize, &[f64])) {
        let length = system.scales().length;
        for (row, violation) in asked.iter().enumerate() {
            match system.unknown(first + row) {
                Unknown::Multiplier(Measure::Length) => {
                    self.constraint = self.constraint.max(violation.abs() / length);
                }
                Unknown::Multiplier(Measure::Angle) => {
                    self.constraint = self.constraint.max(violation.abs())
                }
                // Internal states are balanced by forces and moments.
                Unknown::State { measure, .. } => {
                    let scale = match measure {
                        Measure::Length => 1.0,
                        Measure::Angle => length,
                    };
                    self.force = self.force.max(violation.abs() / scale);
                }
                // Of the size of a state in the time of a radian.
                Unknown::UserState => {
                    let part = violation.abs() * system.period() / TAU;
                    self.force = self.force.max(part * system.scales().force);
                }
            }
        }
    }
}

/// Scratch of one thread.
struct Scratch {
    workspace: Workspace,
    multipliers: Vec<f64>,
    rates: Vec<f64>,
    sums: Vec<Vector6<f64>>,
}

impl Scratch {
    fn new(system: &System) -> Self {
        Scratch {
            workspace: system.workspace(false),
            multipliers: vec![0.0; system.own_unknowns()],
            rates: vec![0.0; system.own_unknowns()],
            sums: vec![Vector6::zeros(); system.nodes()],
        }
    }

    /// Of the equations under these conditions, after grid point `k`, or of those of what leads;
    /// own unknowns and their rates are given by their places.
    fn unbalance(
        &mut self,
        system: &System,
        conditions: &Conditions,
        node_state: impl Fn(usize) -> NodeState,
        own: impl Fn(usize) -> (f64, f64),
        (k, leaders): (usize, Option<&Leaders>),
    ) -> Result<Unbalance> {
        let length = system.scales().length;
        // Force components, and moments over the characteristic length.
        let size = |f: &Vector6<f64>| {
            f.fixed_rows::<3>(0)
                .amax()
                .max(f.fixed_rows::<3>(3).amax() / length)
        };
        for placed in system.elements() {
            for row in 0..placed.element.own_unknowns() {
                let place = placed.first_own + row;
                let (value, rate) = own(place);
                self.multipliers[place] = value;
                if placed.has_states {
                    self.rates[place] = rate;
                }
            }
        }
        let mut found = Unbalance {
            rows: vec![0.0; system.layout(1).size()],
            ..Unbalance::default()
        };
        self.sums.fill(Vector6::zeros());
        let wanted = leaders.map_or(&[][..], Leaders::of_elements);
        for (index, placed) in system.elements().iter().enumerate() {
            if wanted.get(index).is_some_and(|points| k >= *points) {
                continue;
            }
            let range = placed.own_at(1, 0);
            let own = OwnValues {
                values: &self.multipliers[range.clone()],
                rates: &self.rates[range],
                resultants: &[],
            };
            let workspace = &mut self.workspace;
            let out = system.evaluate(placed, &node_state, conditions, own, workspace)?;
            found.overflow |= !out
                .force
                .iter()
                .chain(&out.constraint)
                .all(|x| x.is_finite());
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                let force = out.force.fixed_rows::<6>(6 * local).into_owned();
                found.level = found.level.max(size(&force));
                self.sums[node] += force;
            }
            let own = system.layout(1).element(placed);
            found.rows[own].copy_from_slice(out.constraint.as_slice());
            found.add_own(system, (placed.first_own, out.constraint.as_slice()));
        }
        let looked_at = |node: usize| leaders.is_none_or(|leaders| leaders.leads_at(node, k));
        let sums = self.sums.iter().enumerate();
        let sums = sums.filter(|(node, _)| looked_at(*node));
        found.force = sums.fold(found.force, |r, (_, f)| r.max(size(f)));
        for (rows, sum) in found.rows.chunks_exact_mut(6).zip(&self.sums) {
            rows.copy_from_slice(sum.as_slice());
        }
        Ok(found)
    }
}

impl Defect {
    /// Of a state on a grid; if blades move alike in it, from that of what leads.
    ///
    /// # Errors
    /// [`crate::error::ErrorKind::GridTooCoarse`] if a motion cannot be interpolated, or a failing
    /// callback.
    pub fn of(
        system: &System,
        grid: TimeGrid,
        (state, leaders): (&GridState, Option<&Leaders>),
        workers: &Workers,
    ) -> Result<Self> {
        let points = grid.points();
        let resampling = Resampling::new(grid, PART / points as f64, points);
        let nodes = ResampledNodes::new(system, &resampling, (state, leaders), workers)?;
        let unknowns = state.resampled_own(system, &resampling);
        let times: Vec<f64> = (0..points).map(|k| grid.at(resampling.pseudo(k))).collect();
        let time = |k: usize| times[k];
        // Functions of the user are called here, not by other threads.
        let count = system.signals();
        let mut signals = vec![0.0; points * count];
        for k in 0..points {
            system.signal_values(time(k), 1.0, &mut signals[k * count..][..count])?;
        }
        let workers = system.element_workers(workers);
        let mut found = vec![Unbalance::default(); points];
        workers.try_for_each(
            &mut found,
            &mut Vec::new(),
            || Scratch::new(system),
            |scratch, k, found| {
                let conditions = Conditions {
                    time: time(k),
                    signals: &signals[k * count..][..count],
                    coordinates: state.tracked(system, k),
                    inertial: InertialForces::FULL,
                };
                let node_state = |node: usize| nodes.states[node * points + k];
                let own = |place: usize| {
                    let at = place * points + k;
                    (unknowns.values[at], unknowns.rates[at])
                };
                let of = (k, leaders);
                *found = scratch.unbalance(system, &conditions, node_state, own, of)?;
                Ok(())
            },
        )?;
        let mut defect = Defect {
            largest: ResidualBetween::of(&found, time),
            rows: found.iter().flat_map(|here| &here.rows).copied().collect(),
            count: system.layout(1).size(),
            part: leaders.map_or(points, Leaders::part),
            nodes,
        };
        defect.repeat_forces(leaders);
        if let Some(leaders) = leaders {
            let (count, elements, layout) = (defect.count, system.elements(), system.layout(1));
            let place = |e: usize, k: usize| k * count + layout.element(&elements[e]).start;
            leaders.repeat_own(place, &mut defect.rows);
        }
        Ok(defect)
    }

    /// Writes forces on all nodes from those on what leads.
    pub(super) fn repeat_forces(&mut self, leaders: Option<&Leaders>) {
        if let Some(leaders) = leaders {
            let count = self.count;
            leaders.repeat_forces(|node, k| k * count + 6 * node, &mut self.rows);
        }
    }

    /// What the grid has taken for its own harmonics, scaled and ordered as the rows of
    /// `equations`, but for its phase and a part of an interval: as if all of it came from the
    /// harmonics next above those of the grid (`p = ±1`).
    ///
    /// Forces stay together that belong to one time, in the axes of the nodes then: stresses hold
    /// each other.
    pub fn aliased(&self, equations: &Collocation) -> Vec<f64> {
        let (system, points) = (equations.system(), equations.grid().points());
        let mut all = vec![0.0; equations.size()];
        for (row, places) in places(system, points) {
            for k in 0..points {
                let scale = equations.row_scale()[places(k)];
                all[places(k)] = self.rows[k * self.count + row] * scale / Self::SHOWN;
            }
        }
        all
    }

    /// `|exp(2πi θ) − 1|`: what an alias of a harmonic next above those of the grid leaves between
    /// its points, relative to it.
    const SHOWN: f64 = 1.864_064_8;

    /// What the grid leaves out at its point `k`, scaled and ordered as the rows of `equations`,
    /// which are those of a wave: a cosine.
    pub fn left_out(&self, equations: &Collocation, k: usize) -> Vec<f64> {
        let system = equations.system();
        let here = &self.rows[k * self.count..][..self.count];
        let mut all = vec![0.0; equations.size()];
        for (row, places) in places(system, equations.grid().points()) {
            let place = places(0);
            all[place] = here[row] * equations.row_scale()[place] / Self::SHOWN;
        }
        all
    }

    /// Largest amplitudes of what is left of the equations by the harmonics from `H + 1` to `2 H`,
    /// scaled as those of `equations`, which are those of a wave.
    ///
    /// Of the harmonic `N − a` a grid of `N` points makes `−a`: that is what is left at the same
    /// part of all intervals, but for a factor that all rows share.
    pub fn high_harmonics(&self, equations: &Collocation) -> Vec<f64> {
        let points = self.rows.len() / self.count;
        let mut analysis = Analysis::new(points);
        // Below the highest of an even number of points, which is its own alias.
        let highest = points.div_ceil(2);
        let mut largest = vec![0.0f64; highest - 1];
        for (row, places) in places(equations.system(), equations.grid().points()) {
            analysis.read(self.rows[row..].iter().step_by(self.count).copied());
            let scale = 2.0 * equations.row_scale()[places(0)] / (points as f64 * Self::SHOWN);
            for (largest, c) in largest
                .iter_mut()
                .zip(analysis.spectrum[1..highest].iter().rev())
            {
                *largest = largest.max(scale * c.norm());
            }
        }
        largest
    }

    /// The grid points after which most is left of the equations of forces, and of those of the
    /// elements, all scaled as those of `equations`, which are those of a wave.
    pub fn worst(&self, equations: &Collocation) -> [usize; 2] {
        let nodes = equations.system().layout(1).motions().end;
        let scales = equations.row_scale();
        let scales: Vec<f64> = places(equations.system(), equations.grid().points())
            .map(|(_, places)| scales[places(0)])
            .collect();
        let (mut worst, mut most) = ([0; 2], [0.0f64; 2]);
        for (k, rows) in self.rows.chunks_exact(self.count).enumerate() {
            for (i, (x, scale)) in rows.iter().zip(&scales).enumerate() {
                let part = usize::from(i >= nodes);
                if x.abs() * scale > most[part] {
                    (worst[part], most[part]) = (k % self.part, x.abs() * scale);
                }
            }
        }
        worst
    }
}

/// Each equation of an instant, and its places at the points of a grid among those of the whole
/// period.
fn places(
    system: &System,
    points: usize,
) -> impl Iterator<Item = (usize, impl Fn(usize) -> usize)> + '_ {
    let (instant, all) = (system.layout(1), system.layout(points));
    let of_nodes =
        (0..system.nodes()).map(move |node| (instant.motion(node, 0), all.motion(node, 0)));
    let own = system.elements().iter();
    let own = own.map(move |placed| (instant.element(placed), all.element_at(placed, 0)));
    of_nodes.chain(own).flat_map(|(rows, places)| {
        let step = rows.len();
        let places = rows.zip(places);
        places.map(move |(row, first)| (row, move |k: usize| first + step * k))
    })
}

impl ResidualBetween {
    fn of(found: &[Unbalance], time: impl Fn(usize) -> f64) -> Self {
        let (mut residual, mut worst, mut level, mut constraint) = (0.0f64, 0.0, 0.0f64, 0.0f64);
        let mut overflow = false;
        for (k, here) in found.iter().enumerate() {
            if here.force > residual {
                residual = here.force;
                worst = time(k);
            }
            level = level.max(here.level);
            constraint = constraint.max(here.constraint);
            overflow |= here.overflow;
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
        ResidualBetween {
            force: known(relative),
            constraint: known(constraint),
            time: worst,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_any_number_at_one_time_is_so_of_all() {
        for beyond in 0..3 {
            let found: Vec<Unbalance> = (0..3)
                .map(|k| Unbalance {
                    force: 1.0,
                    level: 4.0,
                    overflow: k == beyond,
                    ..Unbalance::default()
                })
                .collect();
            let largest = ResidualBetween::of(&found, |k| k as f64);
            assert_eq!((largest.force, largest.time), (f64::INFINITY, 0.0));
        }
    }
}
