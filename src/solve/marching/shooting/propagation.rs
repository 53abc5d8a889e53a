//! Variations of a marched motion, taken through a linearised step, all at a time.

use crate::collocation::{Collocation, StepVariation, VariationScales};
use crate::error::Result;
use crate::solve::linear::assembled::Assembled;
use crate::solve::linear::direct::Columns;
use faer::Mat;
use nalgebra::{Matrix6, Vector6};
use std::ops::Range;

/// Variations that are taken through a step together: so many fit the cache.
const TOGETHER: usize = 64;

/// Variations of a motion at one time, one to a column, in the order of [`VariationScales`] but not
/// scaled.
pub(super) struct Variations {
    columns: Mat<f64>,
    /// What the equations of a step ask for.
    rhs: Mat<f64>,
    memory: Columns,
}

impl Variations {
    /// Each scaled entry by itself.
    pub fn of_all(scales: &VariationScales) -> Self {
        let mut columns = Mat::zeros(scales.size(), scales.size());
        for (i, unit) in scales.units().enumerate() {
            columns[(i, i)] = unit;
        }
        Variations {
            columns,
            rhs: Mat::new(),
            memory: Columns::default(),
        }
    }

    /// Scaled.
    pub fn scaled(mut self, scales: &VariationScales) -> Mat<f64> {
        for (i, unit) in scales.units().enumerate() {
            (0..self.columns.ncols()).for_each(|j| self.columns[(i, j)] /= unit);
        }
        self.columns
    }

    /// Takes those at the start of a step to its end, whose equations are assembled and factored.
    /// `false` if that gives none.
    ///
    /// # Errors
    /// If work is to end.
    pub fn propagate(
        &mut self,
        equations: &Collocation,
        linear: &Assembled,
        step: &StepVariation,
        scales: &VariationScales,
    ) -> Result<bool> {
        for first in (0..self.columns.ncols()).step_by(TOGETHER) {
            equations.workers().pulse()?;
            let some = first..self.columns.ncols().min(first + TOGETHER);
            if !self.propagate_some(some, equations, linear, (step, scales))? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The same of some columns.
    fn propagate_some(
        &mut self,
        some: Range<usize>,
        equations: &Collocation,
        linear: &Assembled,
        (step, scales): (&StepVariation, &VariationScales),
    ) -> Result<bool> {
        // As if the end did not move; then what its moving adds.
        let nodes = 24 * equations.system().nodes();
        for j in some.clone() {
            let (nodes, states) = self.columns.col_as_slice_mut(j).split_at_mut(nodes);
            let of_nodes = nodes.chunks_exact_mut(24).enumerate();
            of_nodes.for_each(|(node, entries)| step.hold(node, entries));
            let states = states.chunks_exact_mut(3);
            states.for_each(|entries| step.hold_state(entries));
        }
        self.write_rates(some.clone(), equations, linear, scales);
        if !linear.substitute_columns(self.rhs.as_mut(), &mut self.memory)? {
            return Ok(false);
        }
        let (layout, units) = (equations.layout(), equations.column_scale());
        let own = layout.own().start;
        for (moved, j) in some.enumerate() {
            let (x, column) = (self.rhs.col(moved), self.columns.col_as_slice_mut(j));
            let (nodes, states) = column.split_at_mut(nodes);
            for (node, entries) in nodes.chunks_exact_mut(24).enumerate() {
                let at = layout.motion(node, 0).start;
                let u = Vector6::from_fn(|i, _| x[at + i] * units[at + i]);
                step.carry(node, &u, entries);
            }
            for (place, entries) in scales.states().zip(states.chunks_exact_mut(3)) {
                let at = own + place;
                step.carry_state(x[at] * units[at], entries);
            }
        }
        Ok(true)
    }

    /// Takes from the right sides what velocities at the end leave of the equations of the states
    /// with feedback of an element.
    fn write_feedback(
        &mut self,
        some: Range<usize>,
        equations: &Collocation,
        linear: &Assembled,
        index: usize,
    ) {
        let system = equations.system();
        let placed = &system.elements()[index];
        let rows = equations.layout().element_at(placed, 0);
        let units = &equations.row_scale()[rows.clone()];
        let by_velocity = linear.tangent.gradient_rate(system, index, 0);
        let count = rows.len();
        for (moved, j) in some.enumerate() {
            let column = self.columns.col_as_slice(j);
            let to = &mut self.rhs.col_as_slice_mut(moved)[rows.clone()];
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                let velocity = &column[24 * node + 6..][..6];
                for (i, v) in velocity.iter().enumerate() {
                    let of_component = &by_velocity[(6 * local + i) * count..][..count];
                    for ((to, unit), by) in to.iter_mut().zip(units).zip(of_component) {
                        *to -= unit * by * v;
                    }
                }
            }
        }
    }

    /// Writes what the rates of some columns at the end leave of the scaled equations.
    fn write_rates(
        &mut self,
        some: Range<usize>,
        equations: &Collocation,
        linear: &Assembled,
        scales: &VariationScales,
    ) {
        let (count, tangent) = (some.len(), &linear.tangent);
        if (self.rhs.nrows(), self.rhs.ncols()) != (equations.size(), count) {
            self.rhs = Mat::zeros(equations.size(), count);
        }
        self.rhs.as_mut().fill(0.0);
        let (layout, units) = (equations.layout(), equations.row_scale());
        for (pair, coupling) in tangent.couplings().iter().enumerate() {
            if !coupling.moving {
                continue;
            }
            let (at, rows) = (tangent.pair(pair, 0), layout.motion(coupling.row, 0));
            let units = Vector6::from_column_slice(&units[rows.clone()]);
            let scaled = |by: &Matrix6<f64>| Matrix6::from_fn(|i, j| units[i] * by[(i, j)]);
            let (damping, mass) = (scaled(at.damping), scaled(at.mass));
            let rates = 24 * coupling.column + 6;
            for (moved, j) in some.clone().enumerate() {
                let rates = &self.columns.col_as_slice(j)[rates..][..12];
                let (velocity, acceleration) = rates.split_at(6);
                let left = damping * Vector6::from_column_slice(velocity)
                    + mass * Vector6::from_column_slice(acceleration);
                let to = &mut self.rhs.col_as_slice_mut(moved)[rows.clone()];
                to.iter_mut().zip(&left).for_each(|(to, left)| *to -= left);
            }
        }
        let system = equations.system();
        let states: Vec<usize> = scales.states().collect();
        let first = 24 * system.nodes();
        for (index, placed) in system.elements().iter().enumerate() {
            if !placed.has_states {
                continue;
            }
            let rows = layout.element_at(placed, 0);
            if placed.has_feedback {
                self.write_feedback(some.clone(), equations, linear, index);
            }
            let (_, by_rate) = tangent.own(system, index, 0);
            for (column, unknown) in rows.clone().enumerate() {
                let Ok(state) = states.binary_search(&(unknown - layout.own().start)) else {
                    continue;
                };
                let of_state = &by_rate[column * rows.len()..][..rows.len()];
                let units = &units[rows.clone()];
                for (moved, j) in some.clone().enumerate() {
                    let rate = self.columns.col_as_slice(j)[first + 3 * state + 1];
                    let to = &mut self.rhs.col_as_slice_mut(moved)[rows.clone()];
                    for ((to, unit), by) in to.iter_mut().zip(units).zip(of_state) {
                        *to -= unit * by * rate;
                    }
                }
            }
        }
    }
}
