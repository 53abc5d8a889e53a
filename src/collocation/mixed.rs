//! Stress resultants as unknowns of their own along a step of Newton's method
//! (docs/theory.md, section 7.3).

use super::problem::Collocation;
use super::state::GridState;
use crate::elements::NodeState;
use crate::error::Result;
use nalgebra::Vector6;

/// Stress resultants that go linearly along an increment of the motions, as its linearised
/// equations have them.
#[derive(Debug)]
pub struct ResultantPath {
    /// At its start, at all stations of grid point 0, then of grid point 1 and so on.
    start: Vec<Vector6<f64>>,
    end: Vec<Vector6<f64>>,
    /// The nodes at its start.
    nodes: Vec<NodeState>,
}

impl ResultantPath {
    /// At this part of the increment.
    pub fn at(&self, part: f64) -> Vec<Vector6<f64>> {
        let ends = self.start.iter().zip(&self.end);
        ends.map(|(start, end)| start + (end - start) * part)
            .collect()
    }
}

/// Stress resultants as unknowns of their own in steps with the same matrix.
#[derive(Debug)]
pub struct CarriedResultants {
    /// The nodes where the equations were linearised.
    nodes: Vec<NodeState>,
    /// The increments since then, not scaled, and what follows from them linearly there.
    increment: Vec<f64>,
    linear: Vec<Vector6<f64>>,
    /// The unknowns.
    resultants: Vec<Vector6<f64>>,
    /// Those of the strains.
    strained: Vec<Vector6<f64>>,
}

impl CarriedResultants {
    /// The unknowns.
    pub fn resultants(&self) -> &[Vector6<f64>] {
        &self.resultants
    }
}

impl Collocation {
    /// Whether stress resultants of beams may be unknowns of their own.
    pub fn has_stations(&self) -> bool {
        self.system().stations() > 0 && self.oversampled().is_none()
    }

    /// Stress resultants along an unscaled increment from `state`, that begin with those of the
    /// geometric stiffness there.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn resultants_along(
        &mut self,
        state: &GridState,
        increment: &[f64],
    ) -> Result<ResultantPath> {
        self.update_kinematics(state);
        let end = self.extrapolated_resultants(increment)?;
        let start = match self.has_resultants() {
            true => self.instants.resultants.clone(),
            false => self.resultants_of_strains()?,
        };
        Ok(ResultantPath {
            start,
            end,
            nodes: self.node_states().to_vec(),
        })
    }

    /// Makes of the scaled residual at `trial`, after this part of the increment, the one with
    /// stress resultants as unknowns of their own, without what their equations leave:
    /// with strains `e` that miss the resultants `σ` by `K e - σ`, forces `B₁ᵀ K e` become
    /// `B₁ᵀ σ + B₀ᵀ (K e - σ)`, where `B₀` is of the start and `B₁` of the trial. The path is that
    /// from the start by the increment, and found at the first call.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn part_resultants(
        &mut self,
        path: &mut Option<ResultantPath>,
        (start, increment): (&GridState, &[f64]),
        (trial, part): (&GridState, f64),
        residual: &mut [f64],
    ) -> Result<()> {
        let path = match path {
            Some(path) => path,
            None => path.insert(self.resultants_along(start, increment)?),
        };
        self.update_kinematics(trial);
        self.part(&path.at(part), &path.nodes, residual)
    }

    /// The same at the present nodes, with these resultants, where those `at_start` are those of
    /// the matrix.
    fn part(
        &mut self,
        resultants: &[Vector6<f64>],
        at_start: &[NodeState],
        residual: &mut [f64],
    ) -> Result<()> {
        let (points, count) = (self.grid().points(), 6 * self.system().nodes());
        let mut rows = vec![0.0; points * count];
        // Taken out while they are read.
        let nodes = std::mem::take(&mut self.instants.states);
        let leaders = self.leaders().cloned();
        let leaders = leaders.as_deref();
        let states = [&nodes[..], at_start];
        let moved = self.move_excess(resultants, states, (&mut rows, count), leaders);
        self.instants.states = nodes;
        moved?;
        if let Some(leaders) = leaders {
            leaders.repeat_forces(|node, k| k * count + 6 * node, &mut rows);
        }
        for (k, rows) in rows.chunks_exact(count).enumerate() {
            for (node, forces) in rows.chunks_exact(6).enumerate() {
                let rows = self.layout().motion(node, k);
                let scales = &self.row_scale[rows.clone()];
                let rows = residual[rows].iter_mut().zip(scales).zip(forces);
                rows.for_each(|((row, scale), f)| *row += scale * f);
            }
        }
        Ok(())
    }

    /// Stress resultants as unknowns of their own after a full step from `start`, where the
    /// equations were linearised, by an increment that is not scaled, to `end`, where velocities
    /// are those at present and stay so; `path` is that along it, if it was looked at.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn carry_resultants(
        &mut self,
        path: Option<ResultantPath>,
        (start, increment, end): (&GridState, Vec<f64>, &GridState),
    ) -> Result<CarriedResultants> {
        let (nodes, linear) = match path {
            Some(path) => (path.nodes, path.end),
            None => {
                self.update_kinematics(start);
                let linear = self.extrapolated_resultants(&increment)?;
                let nodes = self.node_states().to_vec();
                self.update_kinematics(end);
                (nodes, linear)
            }
        };
        Ok(CarriedResultants {
            nodes,
            increment,
            resultants: linear.clone(),
            linear,
            strained: Vec::new(),
        })
    }

    /// Makes of the scaled residual, where it was evaluated last, the one with these resultants as
    /// unknowns of their own, as [`Collocation::part_resultants`] does.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn part_carried(
        &mut self,
        carried: &mut CarriedResultants,
        residual: &mut [f64],
    ) -> Result<()> {
        carried.strained = self.resultants_of_strains()?;
        self.part(&carried.resultants, &carried.nodes, residual)
    }

    /// Takes them along a further increment from there, not scaled:
    /// `σ ← K e + K B₀ Δu`.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn step_carried(&mut self, carried: &mut CarriedResultants, more: &[f64]) -> Result<()> {
        let sum = carried.increment.iter_mut().zip(more);
        sum.for_each(|(sum, x)| *sum += x);
        let now = std::mem::replace(
            &mut self.instants.states,
            std::mem::take(&mut carried.nodes),
        );
        let linear = self.extrapolated_resultants(&carried.increment);
        carried.nodes = std::mem::replace(&mut self.instants.states, now);
        let linear = linear?;
        let of_strains = carried.strained.iter();
        let changes = linear
            .iter()
            .zip(&carried.linear)
            .map(|(x, before)| x - before);
        carried.resultants = of_strains
            .zip(changes)
            .map(|(e, change)| e + change)
            .collect();
        carried.linear = linear;
        Ok(())
    }
}
