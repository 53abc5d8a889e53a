//! The map of disturbances over the steps of a period, by Radau's method IIA in index-3 form about
//! a known motion.

use super::next_blade::NextBlade;
use super::step_map::{Common, Internal, Memory, StepMap};
use crate::collocation::{Collocation, GridState, Pattern, RadauStep, STAGES, Stages, Tangent};
use crate::elements::{Measure, NodeState, Unknown};
use crate::error::Result;
use crate::fourier::TimeGrid;
use crate::solve::linear::direct::DirectSolver;
use crate::solve::result::Solved;
use crate::workers::Workers;
use faer::{Mat, MatRef};
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

/// Disturbances that are taken through a step together.
const TOGETHER: usize = 64;
/// Most memory for factors of steps that are kept, in bytes.
const MOST_KEPT: usize = 1 << 28;

/// What the period map needs of a periodic solution, for one number of steps.
pub(super) struct PeriodMap {
    stages: Stages,
    rule: RadauStep,
    common: Common,
    state: GridState,
    tangent: Tangent,
    pattern: Pattern,
    solver: DirectSolver,
    /// Of a rotor of like blades: steps are taken over one part of the period alone.
    next: Option<Arc<NextBlade>>,
    /// Steps that were factored, and the bytes that they take.
    kept: Vec<Option<StepMap>>,
    bytes: usize,
    memory: Memory,
}

impl PeriodMap {
    /// About `solve`, in so many steps, in which blades move alike if they have a `next` one.
    ///
    /// # Errors
    /// If the motion cannot be interpolated.
    pub fn new(
        solve: &Solved,
        steps: usize,
        next: Option<Arc<NextBlade>>,
        workers: &Workers,
    ) -> Result<Self> {
        let (system, period) = (&solve.system, solve.grid.period());
        let grid = TimeGrid::even_or_odd(steps, period)?;
        let stages = Stages::new(system, solve.grid, &solve.state, grid, workers)?;
        // Elements are asked at the stages; the length of the grid is of no account.
        let mut equations = Collocation::new(system.clone(), TimeGrid::new(STAGES, period)?)?;
        equations.set_workers(workers.clone());
        let pattern = Pattern::new(system, STAGES);
        let solver = DirectSolver::new(&pattern, workers.clone());
        let (length, time) = (system.scales().length, period / TAU);
        let mut scales = Vec::new();
        for _ in 0..system.nodes() {
            for unit in [1.0, 1.0 / time] {
                scales.extend([length * unit; 3]);
                scales.extend([unit; 3]);
            }
        }
        let mut internal = Vec::new();
        let elements = system.elements().iter().enumerate();
        for (element, placed) in elements.filter(|(_, placed)| placed.has_states) {
            let first = scales.len();
            for row in 0..placed.element.own_unknowns() {
                let scale = match system.unknown(placed.first_own + row) {
                    Unknown::State {
                        measure: Measure::Length,
                        ..
                    } => length,
                    _ => 1.0,
                };
                scales.push(scale);
            }
            internal.push(Internal {
                element,
                places: first..scales.len(),
            });
        }
        let tangent = Tangent::new(system, STAGES);
        let couplings = tangent.couplings().iter().cloned().enumerate();
        let rule = stages.rule();
        Ok(PeriodMap {
            common: Common {
                equations,
                weights: rule.weights,
                scales,
                internal,
                moving: couplings.filter(|(_, coupling)| coupling.moving).collect(),
            },
            rule,
            stages,
            state: GridState::at_points(system, STAGES),
            tangent,
            pattern,
            solver,
            next: next.filter(|next| steps.is_multiple_of(next.blades)),
            kept: (0..steps).map(|_| None).collect(),
            bytes: 0,
            memory: Memory::default(),
        })
    }

    /// Entries of a disturbance: of each node its increment and that of its velocity; then internal
    /// states.
    pub fn size(&self) -> usize {
        self.common.scales.len()
    }

    /// Steps to the period.
    pub fn steps(&self) -> usize {
        self.kept.len()
    }

    /// Of a rotor of like blades, what its disturbances are at the places of the next.
    pub fn next(&self) -> Option<&Arc<NextBlade>> {
        self.next.as_ref()
    }

    /// Steps of the part of the period after which the motion is the same again, but for the places
    /// of like blades.
    pub fn part(&self) -> usize {
        self.steps() / self.next.as_ref().map_or(1, |next| next.blades)
    }

    /// The motion of a node at the end of a step.
    pub fn end(&self, step: usize, node: usize) -> &NodeState {
        self.stages.end(step, node)
    }

    /// Takes any disturbances, scaled, through so many steps to the end of a part of the period,
    /// and gives them the places of the next blades. `false` if a step's equations are singular.
    /// Factors are kept for what comes then, as far as there is memory for them.
    ///
    /// # Errors
    /// Those of elements and signals, or if work is to end.
    pub fn through(&mut self, steps: usize, columns: &mut Mat<f64>) -> Result<bool> {
        let (part, mut left) = (self.part(), steps);
        while left > 0 {
            let some = match left % part {
                0 => part,
                rest => rest,
            };
            if !self.sweep((part - some..part, true), columns, |_, _| ())? {
                return Ok(false);
            }
            left -= some;
        }
        Ok(true)
    }

    /// Takes disturbances, scaled, over the first part of the period, and gives them the places
    /// of the next blades; `after` sees them at the end of each step. `false` if a step's
    /// equations are singular.
    ///
    /// # Errors
    /// Those of elements and signals, or if work is to end.
    pub fn over_part(
        &mut self,
        columns: &mut Mat<f64>,
        after: impl FnMut(usize, MatRef<f64>),
    ) -> Result<bool> {
        self.sweep((0..self.part(), false), columns, after)
    }

    fn sweep(
        &mut self,
        (steps, keep): (Range<usize>, bool),
        columns: &mut Mat<f64>,
        mut after: impl FnMut(usize, MatRef<f64>),
    ) -> Result<bool> {
        let mut spare = None;
        for step in steps {
            let mut map = match self.kept[step].take() {
                Some(map) => {
                    self.bytes -= map.bytes();
                    map
                }
                None => {
                    let map = spare.take().unwrap_or_else(|| StepMap::new(&self.solver));
                    match self.factored(step, map)? {
                        Some(map) => map,
                        None => return Ok(false),
                    }
                }
            };
            for first in (0..columns.ncols()).step_by(TOGETHER) {
                self.common.equations.workers().pulse()?;
                let count = TOGETHER.min(columns.ncols() - first);
                let some = columns.as_mut().subcols_mut(first, count);
                if !map.propagate(&self.common, some, &mut self.memory)? {
                    return Ok(false);
                }
            }
            after(step, columns.as_ref());
            let bytes = map.bytes();
            match keep && self.bytes + bytes <= MOST_KEPT {
                true => {
                    self.bytes += bytes;
                    self.kept[step] = Some(map);
                }
                false => spare = Some(map),
            }
        }
        if let Some(next) = &self.next {
            next.carry(&self.common, columns.as_mut());
        }
        Ok(true)
    }

    /// A step, in the memory of another.
    fn factored(&mut self, step: usize, mut map: StepMap) -> Result<Option<StepMap>> {
        let equations = &mut self.common.equations;
        (self.stages).set(step, &mut self.rule, equations, &mut self.state)?;
        let (tangent, values) = (&mut self.tangent, &mut map.values);
        values.resize(self.pattern.entries(), 0.0);
        equations.jacobian(&self.state, &self.pattern, tangent, values)?;
        let regular = map.factor(&self.common, &self.tangent, &self.rule)?;
        // What it has found out the next ones are told.
        self.solver = map.solver().another();
        Ok(regular.then_some(map))
    }
}
