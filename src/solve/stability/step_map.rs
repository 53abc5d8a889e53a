//! What disturbances become in one step.

use crate::collocation::{Collocation, Coupling, RadauStep, RadauWeights, STAGES, Tangent};
use crate::error::Result;
use crate::motion::DualVector;
use crate::solve::linear::dense::largest;
use crate::solve::linear::direct::{Columns, DirectSolver};
use faer::{Accum, Mat, MatMut, Par, linalg::matmul::matmul};
use nalgebra::Vector6;
use std::ops::Range;

/// Most corrections by which the compliance of dependent constraints is taken back.
const CORRECTIONS: usize = 12;
/// A correction smaller than this, relative to the solution, is the last.
const CORRECTED: f64 = 1e-13;
/// Accuracy that is asked of linear solves.
const ACCURACY: f64 = 1e-12;
/// Change of a solution by refinement that makes the next ones do without.
const UNREFINED: f64 = 1e-11;

/// Internal states of an element.
#[derive(Debug, Clone)]
pub(super) struct Internal {
    /// The element.
    pub element: usize,
    /// Their places in a disturbance.
    pub places: Range<usize>,
}

/// What all steps have in common.
pub(super) struct Common {
    pub equations: Collocation,
    pub weights: RadauWeights,
    /// What the entries of a disturbance are measured in.
    pub scales: Vec<f64>,
    pub internal: Vec<Internal>,
    /// Couplings by velocities and accelerations: their numbers.
    pub moving: Vec<(usize, Coupling)>,
}

/// Memory for steps.
#[derive(Debug)]
pub(super) struct Memory {
    rhs: Mat<f64>,
    correction: Mat<f64>,
    rest: Mat<f64>,
    columns: Columns,
}

impl Default for Memory {
    fn default() -> Self {
        Memory {
            rhs: Mat::new(),
            correction: Mat::new(),
            rest: Mat::new(),
            columns: Columns::default(),
        }
    }
}

/// The linearised equations of one step, factored.
#[derive(Debug)]
pub(super) struct StepMap {
    solver: DirectSolver,
    /// Of the matrix.
    pub values: Vec<f64>,
    /// Of each moving coupling: what the start of the step gives the equations of its row at the
    /// stages, by increment and change of velocity, as if the stages did not move.
    starts: Vec<Mat<f64>>,
    /// The same of internal states.
    internal: Vec<Mat<f64>>,
    /// The same of the internal states of an element and one of its nodes, by velocities.
    feedback: Vec<(usize, usize, Mat<f64>)>,
    /// Velocities of the nodes at the end.
    twists: Vec<Vector6<f64>>,
}

impl StepMap {
    /// With room for the factors of `solver`'s pattern.
    pub fn new(solver: &DirectSolver) -> Self {
        StepMap {
            solver: solver.another(),
            values: Vec::new(),
            starts: Vec::new(),
            internal: Vec::new(),
            feedback: Vec::new(),
            twists: Vec::new(),
        }
    }

    /// What has factored it.
    pub fn solver(&self) -> &DirectSolver {
        &self.solver
    }

    /// Factors the matrix of `values`, at the state of `tangent`. `false` if it is singular.
    ///
    /// # Errors
    /// If memory runs out, or work is to end.
    pub fn factor(&mut self, common: &Common, tangent: &Tangent, rule: &RadauStep) -> Result<bool> {
        let (rows, weights) = (common.equations.row_scale(), &common.weights);
        let layout = common.equations.layout();
        self.starts
            .resize_with(common.moving.len(), || Mat::zeros(6 * STAGES, 12));
        for ((pair, coupling), start) in common.moving.iter().zip(&mut self.starts) {
            let rows = &rows[layout.node(coupling.row)];
            let scales = &common.scales[12 * coupling.column..][..12];
            for k in 0..STAGES {
                let at = tangent.pair(*pair, k);
                let by_velocity = at.mass * weights.start[k];
                let by_motion = at.damping * weights.start[k] + at.mass * weights.second_start[k];
                for (i, row) in rows[6 * k..][..6].iter().enumerate() {
                    for j in 0..6 {
                        start[(6 * k + i, j)] = -row * by_motion[(i, j)] * scales[j];
                        start[(6 * k + i, 6 + j)] = -row * by_velocity[(i, j)] * scales[6 + j];
                    }
                }
            }
        }
        let system = common.equations.system();
        self.internal.clear();
        for Internal { element, places } in &common.internal {
            let count = places.len();
            let rows = &rows[layout.element(&system.elements()[*element])];
            let scales = &common.scales[places.clone()];
            self.internal
                .push(Mat::from_fn(STAGES * count, count, |i, j| {
                    let (k, row) = (i / count, i % count);
                    let (_, by_rate) = tangent.own(system, *element, k);
                    -rows[i] * by_rate[j * count + row] * weights.start[k] * scales[j]
                }));
        }
        self.feedback.clear();
        for Internal { element, .. } in &common.internal {
            let placed = &system.elements()[*element];
            if !placed.has_feedback {
                continue;
            }
            let count = placed.element.own_unknowns();
            let rows = &rows[layout.element(placed)];
            for (local, &node) in placed.element.nodes().iter().enumerate() {
                let scales = &common.scales[12 * node..][..6];
                let start = Mat::from_fn(STAGES * count, 6, |i, j| {
                    let (k, row) = (i / count, i % count);
                    let by_velocity = tangent.gradient_rate(system, *element, k);
                    let entry = by_velocity[(6 * local + j) * count + row];
                    -rows[i] * entry * weights.start[k] * scales[j]
                });
                self.feedback.push((*element, node, start));
            }
        }
        let ends = (0..system.nodes()).map(|node| rule.nodes[(node + 1) * STAGES - 1].twist);
        self.twists.clear();
        self.twists.extend(ends);
        self.solver.factor(&self.values)
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        let starts: usize = self.starts.iter().map(|m| m.nrows() * m.ncols()).sum();
        size_of::<f64>() * (self.solver.size_of_factors() + self.values.len() + starts)
    }

    /// Takes disturbances to the end of the step. `false` if there is none.
    ///
    /// # Errors
    /// If work is to end.
    pub fn propagate(
        &mut self,
        common: &Common,
        mut columns: MatMut<f64>,
        memory: &mut Memory,
    ) -> Result<bool> {
        let (equations, count) = (&common.equations, columns.ncols());
        let (system, layout) = (equations.system(), equations.layout());
        if (memory.rhs.nrows(), memory.rhs.ncols()) != (equations.size(), count) {
            memory.rhs = Mat::zeros(equations.size(), count);
        }
        memory.rhs.as_mut().fill(0.0);
        let rhs = &mut memory.rhs;
        let add = |start: &Mat<f64>, row: usize, from: MatMut<f64>, rhs: &mut Mat<f64>| {
            let rows = rhs.as_mut().subrows_mut(row, start.nrows());
            matmul(rows, Accum::Add, start, from.as_ref(), 1.0, Par::Seq);
        };
        for ((_, coupling), start) in common.moving.iter().zip(&self.starts) {
            let from = columns.as_mut().subrows_mut(12 * coupling.column, 12);
            add(start, layout.node(coupling.row).start, from, rhs);
        }
        for (internal, start) in common.internal.iter().zip(&self.internal) {
            let places = internal.places.clone();
            let from = columns.as_mut().subrows_mut(places.start, places.len());
            let row = layout.element(&system.elements()[internal.element]).start;
            add(start, row, from, rhs);
        }
        for (element, node, start) in &self.feedback {
            let from = columns.as_mut().subrows_mut(12 * node, 6);
            let row = layout.element(&system.elements()[*element]).start;
            add(start, row, from, rhs);
        }
        if !self.solve(equations, memory)? {
            return Ok(false);
        }
        for (x, mut column) in memory.rhs.col_iter().zip(columns.col_iter_mut()) {
            let (Some(x), Some(column)) = (
                x.try_as_col_major().map(|x| x.as_slice()),
                column
                    .as_mut()
                    .try_as_col_major_mut()
                    .map(|x| x.as_slice_mut()),
            ) else {
                return Ok(false);
            };
            self.end(common, x, column);
        }
        Ok(true)
    }

    /// Makes of a disturbance at the start that at the end.
    fn end(&self, common: &Common, x: &[f64], column: &mut [f64]) {
        let (scales, layout) = (common.equations.column_scale(), common.equations.layout());
        let nodes = common.equations.system().nodes();
        let weights = &common.weights;
        let (states, internal) = column.split_at_mut(12 * nodes);
        for (node, entries) in states.chunks_exact_mut(12).enumerate() {
            let units = &common.scales[12 * node..][..12];
            let start = Vector6::from_fn(|i, _| entries[i] * units[i]);
            let (mut end, mut rate) = (Vector6::zeros(), start * weights.start[STAGES - 1]);
            for k in 0..STAGES {
                let at = layout.motion(node, k);
                let scale = Vector6::from_column_slice(&scales[at.clone()]);
                end = Vector6::from_column_slice(&x[at]).component_mul(&scale);
                rate += end * weights.first[STAGES - 1][k];
            }
            let skew = DualVector::from_twist(&self.twists[node]).skew();
            rate += (skew * DualVector::from_twist(&end)).to_twist();
            for i in 0..6 {
                entries[i] = end[i] / units[i];
                entries[6 + i] = rate[i] / units[6 + i];
            }
        }
        let elements = common.equations.system().elements();
        for Internal { element, places } in &common.internal {
            let last = layout.element_at(&elements[*element], STAGES - 1);
            for (place, at) in places.clone().zip(last) {
                internal[place - 12 * nodes] = x[at] * scales[at] / common.scales[place];
            }
        }
    }

    /// Solves for all right sides, without the compliance that the factors have where constraints
    /// depend on each other.
    fn solve(&mut self, equations: &Collocation, memory: &mut Memory) -> Result<bool> {
        let motions = equations.layout().motions().end;
        let Memory {
            rhs,
            correction,
            rest,
            columns,
        } = memory;
        let enough = match equations.is_regularised() {
            true => 0.0,
            false => UNREFINED,
        };
        if !self.solve_each(rhs, (motions, enough), columns)? {
            return Ok(false);
        }
        if !equations.is_regularised() {
            return Ok(true);
        }
        correction.clone_from(rhs);
        rest.clone_from(rhs);
        for _ in 0..CORRECTIONS {
            for j in 0..rhs.ncols() {
                equations.compliance_of(correction.col_as_slice(j), rest.col_as_slice_mut(j));
            }
            if !self.solve_each(rest, (motions, enough), columns)? {
                return Ok(false);
            }
            std::mem::swap(correction, rest);
            let mut corrected = true;
            for j in 0..rhs.ncols() {
                let (x, by) = (rhs.col_as_slice_mut(j), correction.col_as_slice(j));
                x.iter_mut().zip(by).for_each(|(x, by)| *x += by);
                corrected &= largest(&by[..motions]) <= CORRECTED * largest(&x[..motions]);
            }
            if corrected {
                break;
            }
        }
        Ok(true)
    }

    /// Solves for all right sides: refines the first unless an earlier one has shown that there is
    /// nothing to refine by more than `enough`, and then the others.
    fn solve_each(
        &mut self,
        rhs: &mut Mat<f64>,
        (motions, enough): (usize, f64),
        columns: &mut Columns,
    ) -> Result<bool> {
        let mut first = 0;
        while first < rhs.ncols() && self.solver.error() > enough {
            let asked = (motions, ACCURACY);
            let column = rhs.col_as_slice_mut(first);
            if !self.solver.solve_refined(&self.values, column, asked)? {
                return Ok(false);
            }
            first += 1;
        }
        let (_, rest) = rhs.as_mut().split_at_col_mut(first);
        self.solver.solve_columns(rest, columns)
    }
}
