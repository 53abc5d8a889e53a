//! A periodic motion at the stages of equal steps over its period.

use super::problem::Collocation;
use super::resampled::{ResampledNodes, ResampledOwn};
use super::rule::{PLACES, RadauStep, RadauWeights, STAGES};
use super::state::GridState;
use crate::elements::NodeState;
use crate::error::Result;
use crate::fourier::{Resampling, TimeGrid};
use crate::motion::Motion;
use crate::system::System;
use crate::workers::Workers;
use std::sync::Arc;

/// A periodic motion at stage `i` of each of so many steps.
struct Stage {
    nodes: ResampledNodes,
    state: GridState,
    own: ResampledOwn,
}

/// A periodic motion at the stages of all steps, interpolated over the period.
pub struct Stages {
    system: Arc<System>,
    steps: TimeGrid,
    all: Vec<Stage>,
}

impl Stages {
    /// The motion `state` on `grid`, in as many steps to the period as `steps` has points.
    ///
    /// # Errors
    /// If a motion cannot be interpolated.
    pub fn new(
        system: &Arc<System>,
        grid: TimeGrid,
        state: &GridState,
        steps: TimeGrid,
        workers: &Workers,
    ) -> Result<Self> {
        let count = steps.points();
        let stage = |place: f64| {
            let start = place / count as f64;
            let resampling = Resampling::between(grid, start, steps);
            let nodes = ResampledNodes::new(system, &resampling, (state, None), workers)?;
            let own = state.resampled_own(system, &resampling);
            Ok(Stage {
                state: state.made_of(system, &resampling, (&nodes, &own), steps),
                nodes,
                own,
            })
        };
        Ok(Stages {
            system: system.clone(),
            steps,
            all: PLACES.into_iter().map(stage).collect::<Result<_>>()?,
        })
    }

    /// Length of a step.
    pub fn length(&self) -> f64 {
        self.steps.period() / self.steps.points() as f64
    }

    /// The motion of a node at the end of a step.
    pub fn end(&self, step: usize, node: usize) -> &NodeState {
        &self.all[STAGES - 1].nodes.states[node * self.steps.points() + step]
    }

    /// A rule for the step, with room for the motion at its stages.
    pub fn rule(&self) -> RadauStep {
        let at_rest = NodeState::at_rest(Motion::identity());
        RadauStep {
            weights: RadauWeights::new(self.length()),
            nodes: vec![at_rest; STAGES * self.system.nodes()],
            rates: vec![0.0; STAGES * self.system.own_unknowns()],
        }
    }

    /// Sets `equations`, which have as many points as a step has stages, and `state` to a step.
    ///
    /// # Errors
    /// Those of signals.
    pub fn set(
        &self,
        step: usize,
        rule: &mut RadauStep,
        equations: &mut Collocation,
        state: &mut GridState,
    ) -> Result<()> {
        let count = self.steps.points();
        let mut times = [0.0; STAGES];
        for (k, stage) in self.all.iter().enumerate() {
            times[k] = (step as f64 + PLACES[k]) * self.length();
            state.copy_point(&self.system, k, &stage.state, step);
            for node in 0..self.system.nodes() {
                rule.nodes[node * STAGES + k] = stage.nodes.states[node * count + step];
            }
            for place in 0..self.system.own_unknowns() {
                rule.rates[place * STAGES + k] = stage.own.rates[place * count + step];
            }
        }
        equations.set_times(&times)?;
        equations.set_rule(Box::new(rule.clone()));
        Ok(())
    }
}
