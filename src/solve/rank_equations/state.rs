//! Steps of the motions; motions and own unknowns of a rank in and out, and the solution of all.

use super::{MOTION, RankEquations, places};
use crate::collocation::{Collocation, GridState, Item};
use crate::error::{Error, Result, require_finite};
use crate::model::Model;
use crate::motion::{is_rotation, polar_rotation};
use crate::solve::linear::iterative::{motion_of, numbers_of};
use crate::solve::newton::norms::{largest_scaled, relative_change};
use crate::solve::{Iteration, Kind, NewtonReport, Outcome, PeriodicRecord, Solved};
use std::ops::Range;

/// How far entries of `Rᵀ R` of what is taken for a rotation may be from those of the identity.
const ROTATION: f64 = 1e-6;

impl RankEquations {
    /// Writes what a scaled increment leaves of constraints by their compliance in the Jacobian,
    /// and gives whether they have any; it is then to be solved for, and added. By this rank alone.
    ///
    /// # Errors
    /// If sizes do not fit.
    pub fn compliance(&mut self, increment: &[f64], out: &mut [f64]) -> Result<bool> {
        self.require("increment", increment)?;
        self.require_length("out", out.len())?;
        out.fill(0.0);
        if !self.equations.is_regularised() {
            return Ok(false);
        }
        self.put(increment);
        let size = self.equations.size();
        self.y.fill(0.0);
        self.equations
            .compliance_of(&self.x[..size], &mut self.y[..size]);
        Self::take(&self.owned, &self.y, out);
        Ok(true)
    }

    /// Moves the state where the equations were linearised last by the fraction `step` of a scaled
    /// increment: that is the state then. By all ranks.
    ///
    /// # Errors
    /// If sizes do not fit, or numbers cannot be told.
    pub fn update(&mut self, increment: &[f64], step: f64) -> Result<()> {
        let found = self.require_linear();
        let found = found.and_then(|()| self.require("increment", increment));
        let found = found.and_then(|()| require_finite("step", &[step]));
        self.ranks.clone().agreed(found)?;
        self.put(increment);
        self.halo.fill(&*self.ranks, &mut self.x)?;
        let unscaled = self.equations.unscaled(&self.x, 1.0);
        self.state = self.base.incremented(&self.part.system, &unscaled, step);
        Ok(())
    }

    /// Largest motion in a scaled increment (lengths relative to the characteristic length,
    /// angles), and largest own unknown, relative to the largest of their values. By all ranks.
    ///
    /// # Errors
    /// If sizes do not fit, or numbers cannot be told.
    pub fn norms(&self, increment: &[f64]) -> Result<[f64; 2]> {
        self.ranks
            .agreed(self.require_length("increment", increment.len()))?;
        let layout = self.equations.layout();
        let own = self
            .owned
            .iter()
            .filter(|range| layout.own().contains(&range.start));
        let motions = layout.of_node() * self.part.own_nodes.len();
        let own_count: usize = own.clone().map(Range::len).sum();
        let largest = |x: &[f64]| {
            x.iter().fold(
                0.0f64,
                |m, x| if x.is_nan() { f64::NAN } else { m.max(x.abs()) },
            )
        };
        let scales = self.equations.column_scale();
        let first = layout.own().start;
        let largest_of = |range: &Range<usize>| {
            let values = &self.base.multipliers[range.start - first..range.end - first];
            largest_scaled(values, &scales[range.clone()])
        };
        let value = own.map(largest_of).fold(0.0, f64::max);
        let change = largest(&increment[motions..motions + own_count]);
        let all = [largest(&increment[..motions]), change, value];
        let [motion, change, value] = self.ranks.largest(all)?;
        Ok([motion, relative_change(change, value)])
    }

    /// Motions of the rank's nodes, [`MOTION`] numbers at each grid point, node by node.
    pub fn motions(&self) -> Vec<f64> {
        let points = self.equations.grid().points();
        let nodes = self.part.own_nodes.iter();
        let motions = nodes.flat_map(|&local| &self.state.motions[local * points..][..points]);
        motions.flat_map(numbers_of).collect()
    }

    /// Own unknowns of the rank's elements, not scaled, in the order of vectors.
    pub fn own_unknowns(&self) -> Vec<f64> {
        let points = self.equations.grid().points();
        let own = self.own_elements();
        let values = own.flat_map(|(local, _)| {
            let over = self.part.system.elements()[local].own_over(points);
            self.state.multipliers[over].iter().copied()
        });
        values.collect()
    }

    /// Sets motions and own unknowns as [`RankEquations::motions`] and
    /// [`RankEquations::own_unknowns`] give them; angles are followed from what they were. By all
    /// ranks.
    ///
    /// # Errors
    /// If sizes do not fit, or what is to be a rotation is none; or numbers cannot be told.
    pub fn set_state(&mut self, motions: &[f64], own: &[f64]) -> Result<()> {
        let ranks = self.ranks.clone();
        let checked = self.checked_state(motions, own);
        let mut state = ranks.agreed(checked)?;
        let (part, equations, points) = (&self.part, &self.equations, self.state.points());
        let mut numbers: Vec<f64> = state.motions.iter().flat_map(numbers_of).collect();
        let first = numbers.len();
        numbers.extend_from_slice(&state.multipliers);
        let mut halo = self
            .partition
            .halo(&self.whole, ranks.rank(), |item| match item {
                Item::Node(node) => {
                    let local = part.nodes.partition_point(|n| *n < node);
                    let range = MOTION * points * local..MOTION * points * (local + 1);
                    vec![range]
                }
                Item::Element(_) => {
                    let range = &places(part, equations, false, item)[0];
                    let start = equations.layout().own().start;
                    let own = first + range.start - start..first + range.end - start;
                    vec![own]
                }
            });
        halo.fill(&*ranks, &mut numbers)?;
        let motions = numbers[..first].chunks_exact(MOTION);
        state.motions = motions.map(motion_of).collect();
        state.multipliers.copy_from_slice(&numbers[first..]);
        state.track(&self.part.system);
        self.state = state;
        Ok(())
    }

    fn checked_state(&self, motions: &[f64], own: &[f64]) -> Result<GridState> {
        let (points, mut state) = (self.state.points(), self.state.clone());
        let expected = MOTION * points * self.part.own_nodes.len();
        if motions.len() != expected {
            return Err(Error::size("motions", expected, motions.len()));
        }
        require_finite("motions", motions)?;
        require_finite("own_unknowns", own)?;
        let places = self.part.own_nodes.iter();
        let places = places.flat_map(|&local| points * local..points * (local + 1));
        for (i, (place, numbers)) in places.zip(motions.chunks_exact(MOTION)).enumerate() {
            let mut motion = motion_of(numbers);
            if !is_rotation(&motion.rotation, ROTATION) {
                let name = format!("motions[{}]", MOTION * i + 3);
                return Err(Error::value(&name, "a rotation matrix", "none"));
            }
            motion.rotation = polar_rotation(&motion.rotation);
            state.motions[place] = motion;
        }
        let mut rest = own;
        let expected: usize = self.own_unknowns().len();
        if own.len() != expected {
            return Err(Error::size("own_unknowns", expected, own.len()));
        }
        for (local, _) in self.own_elements() {
            let over = self.part.system.elements()[local].own_over(points);
            let (values, next) = rest.split_at(over.len());
            state.multipliers[over].copy_from_slice(values);
            rest = next;
        }
        Ok(state)
    }

    /// The present state of the whole as a solution, on rank `root`, or on all where none is named;
    /// none on the others. By all ranks.
    ///
    /// # Errors
    /// If numbers cannot be told, or functions of the user fail: on all ranks.
    pub fn solution(
        &self,
        root: Option<usize>,
        (outcome, iterations): (Outcome, Vec<Iteration>),
    ) -> Result<Option<(Model, Solved)>> {
        let (ranks, points) = (&self.ranks, self.state.points());
        let (count, rank) = (ranks.count(), ranks.rank());
        if root.is_some_and(|root| root >= count) {
            let expected = format!("a rank below {count}");
            let got = root.unwrap_or_default();
            return Err(Error::value("root", expected, got));
        }
        let mut own = self.motions();
        own.extend(self.own_unknowns());
        let mut counts = vec![0; count];
        for &owner in self.partition.owners() {
            counts[owner] += MOTION * points;
        }
        for placed in self.whole.elements() {
            counts[self.partition.of_element(placed)] += points * placed.element.own_unknowns();
        }
        let gets = |to: usize| root.is_none_or(|root| root == to);
        let sent: Vec<f64> = (0..count)
            .filter(|&to| gets(to))
            .flat_map(|_| own.clone())
            .collect();
        let send_counts: Vec<usize> = (0..count)
            .map(|to| if gets(to) { own.len() } else { 0 })
            .collect();
        let counts = if gets(rank) { counts } else { vec![0; count] };
        let mut all = vec![0.0; counts.iter().sum()];
        ranks.exchange(&sent, &send_counts, &mut all, &counts)?;
        let made = match gets(rank) {
            true => self
                .whole_solution(&all, &counts, (outcome, iterations))
                .map(Some),
            false => Ok(None),
        };
        ranks.agreed(made)
    }

    fn whole_solution(
        &self,
        all: &[f64],
        counts: &[usize],
        (outcome, iterations): (Outcome, Vec<Iteration>),
    ) -> Result<(Model, Solved)> {
        let (whole, grid, points) = (&self.whole, self.equations.grid(), self.state.points());
        let mut rest: Vec<&[f64]> = Vec::new();
        let mut behind = all;
        for &count in counts {
            let (part, next) = behind.split_at(count);
            rest.push(part);
            behind = next;
        }
        let mut take = |rank: usize, count: usize| {
            let (part, next) = rest[rank].split_at(count);
            rest[rank] = next;
            part
        };
        let mut state = GridState::at_points(whole, points);
        let owners = self.partition.owners();
        for (motions, &owner) in state.motions.chunks_exact_mut(points).zip(owners) {
            let numbers = take(owner, MOTION * points).chunks_exact(MOTION);
            motions
                .iter_mut()
                .zip(numbers)
                .for_each(|(m, x)| *m = motion_of(x));
        }
        for placed in whole.elements() {
            let over = placed.own_over(points);
            let values = take(self.partition.of_element(placed), over.len());
            state.multipliers[over].copy_from_slice(values);
        }
        state.coordinates.clone_from(&self.coordinates);
        state.track(whole);
        let mut equations = Collocation::new(whole.clone(), grid)?;
        equations.update_kinematics(&state);
        equations.reduce_to_least_norm(&mut state)?;
        let node_states = equations.node_states().to_vec();
        let explanation = format!("solved on {} ranks", counts.len());
        let report = NewtonReport {
            iterations,
            ..NewtonReport::ended(outcome, explanation)
        };
        let kind = Kind::Periodic(PeriodicRecord {
            grids: Vec::new(),
            coarse_start: None,
            attempts: Vec::new(),
            iterative: None,
            threads: 1,
            assessment: None,
            mesh_error: f64::INFINITY,
        });
        let solved = Solved::known(whole, grid, (state, node_states), report, kind);
        Ok((self.model.clone(), solved))
    }
}
