//! Variations of a marched motion, taken through a linearised step, all at a time.

use crate::collocation::{Collocation, StepVariation, VariationScales};
use crate::error::Result;
use crate::solve::linear::assembled::Assembled;
use crate::solve::linear::direct::Columns;
use crate::workers::Workers;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use nalgebra::Vector6;

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
        // As if the end did not move; then what its moving adds.
        let nodes = 24 * equations.system().nodes();
        let workers = equations.workers();
        each(&mut self.columns, workers, |_, column| {
            let (nodes, states) = column.split_at_mut(nodes);
            let of_nodes = nodes.chunks_exact_mut(24).enumerate();
            of_nodes.for_each(|(node, entries)| step.hold(node, entries));
            let states = states.chunks_exact_mut(3);
            states.for_each(|entries| step.hold_state(entries));
        })?;
        self.write_rates(equations, linear, scales);
        if !linear.substitute_columns(self.rhs.as_mut(), &mut self.memory)? {
            return Ok(false);
        }
        let (layout, units) = (equations.layout(), equations.column_scale());
        let (own, moved) = (layout.own().start, self.rhs.as_ref());
        each(&mut self.columns, workers, |j, column| {
            let x = moved.col(j);
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
        })?;
        Ok(true)
    }

    /// Writes what the rates at the end leave of the scaled equations.
    fn write_rates(
        &mut self,
        equations: &Collocation,
        linear: &Assembled,
        scales: &VariationScales,
    ) {
        let (count, tangent) = (self.columns.ncols(), &linear.tangent);
        if (self.rhs.nrows(), self.rhs.ncols()) != (equations.size(), count) {
            self.rhs = Mat::zeros(equations.size(), count);
        }
        self.rhs.as_mut().fill(0.0);
        let (layout, units) = (equations.layout(), equations.row_scale());
        let subtract = |to: MatMut<f64>, by: MatRef<f64>, from: MatRef<f64>| {
            matmul(to, Accum::Add, by, from, -1.0, Par::Seq);
        };
        let mut by_rates = Mat::zeros(6, 12);
        for (pair, coupling) in tangent.couplings().iter().enumerate() {
            if !coupling.moving {
                continue;
            }
            let (at, rows) = (tangent.pair(pair, 0), layout.motion(coupling.row, 0));
            for i in 0..6 {
                let unit = units[rows.start + i];
                for j in 0..6 {
                    by_rates[(i, j)] = unit * at.damping[(i, j)];
                    by_rates[(i, 6 + j)] = unit * at.mass[(i, j)];
                }
            }
            let rates = self.columns.as_ref().subrows(24 * coupling.column + 6, 12);
            let to = self.rhs.as_mut().subrows_mut(rows.start, 6);
            subtract(to, by_rates.as_ref(), rates);
        }
        let system = equations.system();
        let states: Vec<usize> = scales.states().collect();
        let first = 24 * system.nodes();
        for (index, placed) in system.elements().iter().enumerate() {
            if !placed.has_states {
                continue;
            }
            let rows = layout.element_at(placed, 0);
            let (_, by_rate) = tangent.own(system, index, 0);
            for (column, unknown) in rows.clone().enumerate() {
                let Ok(state) = states.binary_search(&(unknown - layout.own().start)) else {
                    continue;
                };
                let of_state = &by_rate[column * rows.len()..][..rows.len()];
                let by_rate = Mat::from_fn(rows.len(), 1, |row, _| {
                    units[rows.start + row] * of_state[row]
                });
                let rates = self.columns.as_ref().subrows(first + 3 * state + 1, 1);
                let to = self.rhs.as_mut().subrows_mut(rows.start, rows.len());
                subtract(to, by_rate.as_ref(), rates);
            }
        }
    }
}

/// Works on each column.
///
/// # Errors
/// If work is to end.
fn each(
    columns: &mut Mat<f64>,
    workers: &Workers,
    mut work: impl FnMut(usize, &mut [f64]),
) -> Result<()> {
    for j in 0..columns.ncols() {
        workers.pulse()?;
        work(j, columns.col_as_slice_mut(j));
    }
    Ok(())
}
