//! The motion over the grid, differentiated as a Fourier series (docs/theory.md, section 4.1).

use super::aliasing::Aliasing;
use super::kinematics::{KinematicsScratch, NodeKinematics};
use super::{OverGrid, RuleWorkspace, TimeRule};
use crate::collocation::state::GridState;
use crate::elements::NodeState;
use crate::fourier::{Differentiation, TimeGrid};
use crate::motion::DualMatrix;
use crate::workers::Workers;
use nalgebra::Vector6;

/// Multiply-adds of the velocity and acceleration of a node at a grid point, about.
const WORK: usize = 300;

/// Spectral differentiation on a grid, by pseudo-time where that is mapped.
#[derive(Debug, Clone)]
pub struct Spectral {
    operators: Differentiation,
    nodes: Vec<NodeKinematics>,
    /// Operators and scratch for each thread.
    of_threads: Vec<(Differentiation, KinematicsScratch)>,
    unused: Vec<f64>,
}

impl Spectral {
    /// On `grid`, for so many nodes.
    pub fn new(grid: TimeGrid, nodes: usize) -> Self {
        Spectral {
            operators: Differentiation::new(grid),
            nodes: vec![NodeKinematics::default(); nodes],
            of_threads: Vec::new(),
            unused: vec![0.0; grid.points()],
        }
    }
}

impl Spectral {
    /// The motion of a node over the grid.
    pub(super) fn node(&self, node: usize) -> &NodeKinematics {
        &self.nodes[node]
    }
}

impl RuleWorkspace {
    /// Operators of its own, like these, and scratch.
    fn of(
        &mut self,
        like: &Differentiation,
    ) -> (&mut Differentiation, &mut KinematicsScratch, &mut Vec<f64>) {
        let own = self.operators.take();
        let own = own.filter(|own| own.grid() == like.grid());
        let operators = self.operators.insert(own.unwrap_or_else(|| like.clone()));
        (operators, &mut self.variation, &mut self.samples)
    }

    /// The same for so many of their points, the period of what repeats itself after these.
    fn of_part(
        &mut self,
        like: &Differentiation,
        points: usize,
    ) -> (&mut Differentiation, &mut KinematicsScratch) {
        let grid = like.grid().part(points);
        let own = self.of_part.take().filter(|own| own.grid() == grid);
        let operators = (self.of_part).insert(own.unwrap_or_else(|| Differentiation::new(grid)));
        (operators, &mut self.variation)
    }
}

impl TimeRule for Spectral {
    fn evaluate(&mut self, state: &GridState, workers: &Workers, nodes: &mut [NodeState]) {
        self.evaluate_some(state, &|_| true, workers, nodes);
    }

    fn evaluate_some(
        &mut self,
        state: &GridState,
        of: &(dyn Fn(usize) -> bool + Sync),
        workers: &Workers,
        nodes: &mut [NodeState],
    ) {
        let points = state.points();
        let operators = &self.operators;
        let all = self.nodes.iter_mut().zip(nodes.chunks_mut(points));
        let some = all.enumerate().filter(|(node, _)| of(*node));
        let mut all: Vec<_> = some.collect();
        workers.for_work(WORK * points * all.len()).for_each(
            &mut all,
            &mut self.of_threads,
            || (operators.clone(), KinematicsScratch::default()),
            |(operators, scratch), _, (node, (kinematics, states))| {
                kinematics.evaluate(operators, state.node(*node), scratch);
                kinematics.write_states(state.node(*node), states);
            },
        );
    }

    fn rates(&mut self, _: usize, values: &[f64], gain: f64, rates: &mut [f64]) {
        let grid = self.operators.grid();
        let steady = |(k, value)| value - gain * k as f64 / grid.points() as f64;
        let samples: Vec<f64> = values.iter().enumerate().map(steady).collect();
        self.operators.apply(&samples, rates, &mut self.unused);
        let steady = gain / grid.period();
        rates.iter_mut().for_each(|rate| *rate += steady);
    }

    fn tangent(&self, node: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2] {
        let (kinematics, operators) = (&self.nodes[node], &self.operators);
        let (d, t) = (operators.first(l, k), operators.second(l, k));
        let one = f64::from(l == k);
        // D + μ, and T + 2 μ D + μ².
        match power {
            0 => kinematics.tangent((d, t), l, k),
            1 => kinematics.carried((one, 2.0 * d), l, k),
            _ => kinematics.carried((0.0, one), l, k),
        }
    }

    fn rate_weight(&self, power: usize, l: usize, k: usize) -> f64 {
        match power {
            0 => self.operators.first(l, k),
            1 => f64::from(l == k),
            _ => 0.0,
        }
    }

    fn vary(
        &self,
        node: usize,
        increments: &[f64],
        workspace: &mut RuleWorkspace,
        rates: &mut [[Vector6<f64>; 2]],
    ) {
        let (operators, variation) = match rates.len() == self.operators.grid().points() {
            true => {
                let (operators, variation, _) = workspace.of(&self.operators);
                (operators, variation)
            }
            false => workspace.of_part(&self.operators, rates.len()),
        };
        self.nodes[node].variation(operators, increments, variation, rates);
    }

    fn vary_rates(&self, values: &[f64], workspace: &mut RuleWorkspace, rates: &mut [f64]) {
        let (operators, _, unused) = workspace.of(&self.operators);
        unused.resize(values.len(), 0.0);
        operators.apply(values, rates, unused);
    }

    fn vary_transposed(
        &self,
        node: usize,
        by_rates: &[[Vector6<f64>; 2]],
        workspace: &mut RuleWorkspace,
        out: &mut [f64],
    ) {
        let (operators, variation, _) = workspace.of(&self.operators);
        self.nodes[node].add_transposed_variation(operators, by_rates, variation, out);
    }

    /// `Dᵀ = −D`.
    fn vary_rates_transposed(
        &self,
        by_rates: &[f64],
        workspace: &mut RuleWorkspace,
        out: &mut [f64],
    ) {
        self.vary_rates(by_rates, workspace, out);
        out.iter_mut().for_each(|x| *x = -*x);
    }

    fn aliasing(&self, node: usize) -> Vec<Aliasing> {
        self.nodes[node].aliasing(self.operators.grid())
    }

    fn over_grid(&self) -> Option<OverGrid<'_>> {
        Some(OverGrid {
            kinematics: &self.nodes,
            operators: &self.operators,
            slopes: &[],
        })
    }
}
