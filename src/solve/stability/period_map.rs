//! The map of disturbances over the steps of a period, by Radau's method IIA in index-3 form about
//! a known motion.

use crate::collocation::{
    Collocation, GridState, Increment, Pattern, RadauStep, STAGES, Stages, Tangent,
};
use crate::elements::{Measure, NodeState, Unknown};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::motion::DualVector;
use crate::solve::linear::dense::largest;
use crate::solve::linear::direct::DirectSolver;
use crate::solve::result::Solved;
use crate::workers::Workers;
use nalgebra::Vector6;
use std::f64::consts::TAU;
use std::ops::Range;

/// Most corrections by which the compliance of dependent constraints is taken back.
const CORRECTIONS: usize = 12;
/// A correction smaller than this, relative to the solution, is the last.
const CORRECTED: f64 = 1e-13;
/// Accuracy that is asked of linear solves.
const ACCURACY: f64 = 1e-12;
/// Change of a solution by refinement that makes the next ones do without.
const UNREFINED: f64 = 1e-11;

/// What the period map needs of a periodic solution, for one number of steps.
pub(super) struct PeriodMap {
    stages: Stages,
    rule: RadauStep,
    equations: Collocation,
    state: GridState,
    tangent: Tangent,
    pattern: Pattern,
    values: Vec<f64>,
    solver: DirectSolver,
    steps: usize,
    /// What the entries of a disturbance are measured in.
    scales: Vec<f64>,
    /// Places of the internal states at the last stage among all own unknowns, and how far apart
    /// those of two stages are.
    internal: Vec<[usize; 2]>,
    increment: Increment,
    rhs: Vec<f64>,
}

impl PeriodMap {
    /// About `solve`, in so many steps (odd).
    ///
    /// # Errors
    /// If the motion cannot be interpolated.
    pub fn new(solve: &Solved, steps: usize, workers: &Workers) -> Result<Self> {
        let (system, period) = (&solve.system, solve.grid.period());
        let grid = TimeGrid::new(steps, period)?;
        let stages = Stages::new(system, solve.grid, &solve.state, grid, workers)?;
        // Elements are asked at the stages; the length of the grid is of no account.
        let mut equations = Collocation::new(system.clone(), TimeGrid::new(STAGES, period)?)?;
        equations.set_workers(workers.clone());
        let pattern = Pattern::new(system, STAGES);
        let mut solver = DirectSolver::new(&pattern);
        solver.set_workers(workers.clone());
        let (length, time) = (system.scales().length, period / TAU);
        let mut scales = Vec::new();
        for _ in 0..system.nodes() {
            for unit in [1.0, 1.0 / time] {
                scales.extend([length * unit; 3]);
                scales.extend([unit; 3]);
            }
        }
        let mut internal = Vec::new();
        for placed in system.elements().iter().filter(|p| p.has_states) {
            for row in 0..placed.element.own_unknowns() {
                let place = placed.first_own + row;
                if let Unknown::State { measure, .. } = system.unknown(place) {
                    let last = placed.own_at(STAGES, STAGES - 1);
                    internal.push([last.start + row, last.len()]);
                    scales.push(match measure {
                        Measure::Length => length,
                        Measure::Angle => 1.0,
                    });
                }
            }
        }
        let size = equations.size();
        Ok(PeriodMap {
            rule: stages.rule(),
            stages,
            state: GridState::at_points(system, STAGES),
            tangent: Tangent::new(system, STAGES),
            values: vec![0.0; pattern.entries()],
            pattern,
            solver,
            steps,
            scales,
            internal,
            increment: Increment {
                x: vec![0.0; size],
                rates: vec![[Vector6::zeros(); 2]; STAGES * system.nodes()],
                own_rates: vec![0.0; STAGES * system.own_unknowns()],
            },
            rhs: vec![0.0; size],
            equations,
        })
    }

    /// Entries of a disturbance: of each node its increment and that of its velocity; then internal
    /// states.
    pub fn size(&self) -> usize {
        self.scales.len()
    }

    /// Steps to the period.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// The motion of a node at the end of a step.
    pub fn end(&self, step: usize, node: usize) -> &NodeState {
        self.stages.end(step, node)
    }

    /// Takes disturbances, scaled, from the start of the first of some steps to the end of the
    /// last; `after` sees them at the end of each. `false` if a step's equations are singular.
    ///
    /// # Errors
    /// Those of elements and signals, or if work is to end.
    pub fn sweep(
        &mut self,
        steps: Range<usize>,
        columns: &mut [Vec<f64>],
        mut after: impl FnMut(usize, &[Vec<f64>]),
    ) -> Result<bool> {
        for step in steps {
            let equations = &mut self.equations;
            (self.stages).set(step, &mut self.rule, equations, &mut self.state)?;
            let (tangent, values) = (&mut self.tangent, &mut self.values);
            equations.jacobian(&self.state, &self.pattern, tangent, values)?;
            if !self.solver.factor(&self.values)? {
                return Ok(false);
            }
            for column in columns.iter_mut() {
                self.equations.workers().pulse()?;
                if !self.propagate(column)? {
                    return Ok(false);
                }
            }
            after(step, columns);
        }
        Ok(true)
    }

    /// Takes one disturbance to the end of the step that was factored.
    fn propagate(&mut self, column: &mut [f64]) -> Result<bool> {
        column
            .iter_mut()
            .zip(&self.scales)
            .for_each(|(x, s)| *x *= s);
        let nodes = self.equations.system().nodes();
        let weights = &self.rule.weights;
        // What the start gives the stages, as if these did not move.
        for (node, entries) in column[..12 * nodes].chunks_exact(12).enumerate() {
            let u = Vector6::from_column_slice(&entries[..6]);
            let v = Vector6::from_column_slice(&entries[6..]);
            for k in 0..STAGES {
                self.increment.rates[node * STAGES + k] = [
                    u * weights.start[k],
                    u * weights.second_start[k] + v * weights.start[k],
                ];
            }
        }
        let count = self.internal.len();
        let states = column.len() - count;
        for (x, [last, stride]) in column[states..].iter().zip(&self.internal) {
            for k in 0..STAGES {
                let at = last - (STAGES - 1 - k) * stride;
                self.increment.own_rates[at] = x * weights.start[k];
            }
        }
        self.tangent
            .forces(&self.equations, &self.increment, &mut self.rhs);
        self.rhs.iter_mut().for_each(|x| *x = -*x);
        if !self.solve()? {
            return Ok(false);
        }
        let (scales, layout) = (self.equations.column_scale(), self.equations.layout());
        let weights = &self.rule.weights;
        for (node, entries) in column[..12 * nodes].chunks_exact_mut(12).enumerate() {
            let start = Vector6::from_column_slice(&entries[..6]);
            let (mut end, mut rate) = (Vector6::zeros(), start * weights.start[STAGES - 1]);
            for k in 0..STAGES {
                let at = layout.motion(node, k);
                let scale = Vector6::from_column_slice(&scales[at.clone()]);
                end = Vector6::from_column_slice(&self.rhs[at]).component_mul(&scale);
                rate += end * weights.first[STAGES - 1][k];
            }
            let twist = &self.rule.nodes[node * STAGES + STAGES - 1].twist;
            let skew = DualVector::from_twist(twist).skew();
            rate += (skew * DualVector::from_twist(&end)).to_twist();
            entries[..6].copy_from_slice(end.as_slice());
            entries[6..].copy_from_slice(rate.as_slice());
        }
        for (x, [last, _]) in column[states..].iter_mut().zip(&self.internal) {
            let at = layout.own().start + last;
            *x = self.rhs[at] * scales[at];
        }
        column
            .iter_mut()
            .zip(&self.scales)
            .for_each(|(x, s)| *x /= s);
        Ok(true)
    }

    /// Solves with the factors of the step, without the compliance that these have where
    /// constraints depend on each other.
    fn solve(&mut self) -> Result<bool> {
        let motions = self.equations.layout().motions().end;
        let asked = (motions, ACCURACY);
        if !self.equations.is_regularised() && self.solver.is_accurate_to(UNREFINED) {
            return Ok(self.solver.solve(&mut self.rhs));
        }
        if !(self.solver).solve_refined(&self.values, &mut self.rhs, asked)? {
            return Ok(false);
        }
        if !self.equations.is_regularised() {
            return Ok(true);
        }
        let mut correction = self.rhs.clone();
        let mut rest = vec![0.0; self.rhs.len()];
        for _ in 0..CORRECTIONS {
            self.equations.compliance_of(&correction, &mut rest);
            if !(self.solver).solve_refined(&self.values, &mut rest, asked)? {
                return Ok(false);
            }
            std::mem::swap(&mut correction, &mut rest);
            let sum = self.rhs.iter_mut().zip(&correction);
            sum.for_each(|(x, d)| *x += d);
            if largest(&correction[..motions]) <= CORRECTED * largest(&self.rhs[..motions]) {
                break;
            }
        }
        Ok(true)
    }
}
