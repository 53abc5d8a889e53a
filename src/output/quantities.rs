//! Quantities of solutions at any time, their harmonics and extremes.

use super::solution::Solution;
use super::trajectory::Between;
use crate::collocation::too_coarse;
use crate::elements::{NodeState, ShellPoint};
use crate::error::Result;
use crate::fourier::{CardinalWeights, PeriodicSeries};
use crate::memory;
use crate::motion::PeriodicMotion;
use crate::quantity::{
    BeamQuantity, Extremes, ForceQuantity, Forces, History, JointQuantity, NodeQuantity, Probe,
    Quantity, Samples, Selection, ShellQuantity, require_closed, require_numbers,
};

/// Passes series of numbers: sums over the grid may be too large where their terms are not.
fn numbered(series: Vec<PeriodicSeries>) -> Result<Vec<PeriodicSeries>> {
    for s in &series {
        require_numbers("harmonics", &[s.mean, s.rate])?;
        require_numbers("harmonics", &s.cosines)?;
        require_numbers("harmonics", &s.sines)?;
    }
    Ok(series)
}

impl Solution {
    /// The motion that quantities are taken of.
    pub(super) fn history(&self) -> History<'_> {
        let solve = &self.solve;
        History {
            system: &solve.system,
            state: &solve.state,
            nodes: &solve.node_states,
            times: solve.times(),
            grid: (!self.is_trajectory()).then_some(solve.grid),
            start: &self.prescribed_start,
            forces: Forces::Recorded(&self.forces),
        }
    }

    /// A quantity at `times`, or a component of it; components of each time together.
    ///
    /// Motions of nodes are interpolated themselves, all else is by its values at the grid points.
    ///
    /// # Errors
    /// If it is not there, or [`GridTooCoarse`](crate::error::ErrorKind::GridTooCoarse) if the
    /// motion of a node cannot be interpolated.
    pub fn sample(&self, what: impl Into<Selection>, times: &[f64]) -> Result<Vec<f64>> {
        let selection = what.into();
        let count = times.len().saturating_mul(selection.quantity.components());
        // As values, and on the way to these.
        memory::require_items("values at these times", count, 2 * size_of::<f64>())?;
        let probe = selection.quantity.probe(&self.solve.system)?;
        let values = match selection.quantity {
            Quantity::Node(node, quantity) => self.sample_node(node, quantity, times),
            _ => self.sample_probe(&*probe, times),
        }?;
        let Some(component) = selection.component else {
            return Ok(values);
        };
        selection.quantity.require_component(component)?;
        let count = selection.quantity.components();
        Ok(values.into_iter().skip(component).step_by(count).collect())
    }

    /// The same of what is by its values at the grid points.
    pub(super) fn sample_probe(&self, probe: &dyn Probe, times: &[f64]) -> Result<Vec<f64>> {
        let samples = probe.samples(&self.history())?;
        let values: Vec<f64> = if self.is_trajectory() {
            let places = self.places(times)?;
            let at = |place: &Between| match &samples.slopes {
                Some(slopes) => vec![place.hermite(&samples.columns[0], slopes)],
                None => samples.columns.iter().map(|x| place.linear(x)).collect(),
            };
            places.iter().flat_map(at).collect()
        } else {
            let series = samples.series(self.grid(), self.filter.as_ref());
            let at = |&time: &f64| series.iter().map(move |s| s.value(time));
            times.iter().flat_map(at).collect()
        };
        require_numbers("samples", &values)?;
        Ok(values)
    }

    fn sample_node(&self, node: usize, quantity: NodeQuantity, times: &[f64]) -> Result<Vec<f64>> {
        let mut out = Vec::with_capacity(times.len() * quantity.components());
        let mut last = None;
        let mut interpolation = PeriodicMotion::new(self.solve.state.node(node));
        if let Some(filter) = &self.filter {
            interpolation = interpolation.filtered(self.grid(), filter);
        }
        self.each_state_of(node, &interpolation, times, |state| {
            let state = self.solve.system.inertial_state(state);
            quantity.push(&state, &mut last, &mut out)
        })?;
        require_numbers("node", &out)?;
        Ok(out)
    }

    /// Calls `visit` with the state of `node` at each of `times`, anywhere, without any filter.
    pub(super) fn each_node_state(
        &self,
        node: usize,
        times: &[f64],
        visit: impl FnMut(&NodeState),
    ) -> Result<()> {
        let interpolation = PeriodicMotion::new(self.solve.state.node(node));
        self.each_state_of(node, &interpolation, times, visit)
    }

    fn each_state_of(
        &self,
        node: usize,
        interpolation: &PeriodicMotion,
        times: &[f64],
        mut visit: impl FnMut(&NodeState),
    ) -> Result<()> {
        if self.is_trajectory() {
            for place in self.places(times)? {
                visit(&self.state_between(node, &place));
            }
            return Ok(());
        }
        let grid = self.grid();
        let mut weights = CardinalWeights::new(grid);
        for &time in times {
            weights.move_to(time);
            let state = interpolation
                .at(&weights)
                .ok_or_else(|| too_coarse(node, time, grid.points()))?;
            visit(&state);
        }
        Ok(())
    }

    /// Fourier series of each component of a quantity, or of one, through its values at the grid
    /// points.
    ///
    /// # Errors
    /// If it is not there, of a trajectory, and of a quaternion that changes sign over the period.
    pub fn series(&self, what: impl Into<Selection>) -> Result<Vec<PeriodicSeries>> {
        let selection = what.into();
        selection.of(self.all_series(selection.quantity)?)
    }

    fn all_series(&self, quantity: Quantity) -> Result<Vec<PeriodicSeries>> {
        self.require_harmonics()?;
        let probe = quantity.probe(&self.solve.system)?;
        let (Quantity::Node(node, of_node), Some(_)) = (quantity, &self.filter) else {
            let samples = probe.samples(&self.history())?;
            return numbered(samples.series(self.grid(), self.filter.as_ref()));
        };
        // Of the filtered motion, which is not filtered once more.
        let times: Vec<f64> = self.grid().times().collect();
        let values = self.sample_node(node, of_node, &times)?;
        let count = of_node.components();
        let column = |i: usize| values.iter().skip(i).step_by(count).copied().collect();
        let samples = Samples {
            columns: (0..count).map(column).collect(),
            ..Samples::default()
        };
        if of_node == NodeQuantity::Quaternion {
            require_closed(node, &samples)?;
        }
        numbered(samples.series(self.grid(), None))
    }

    /// Smallest and largest value of each component of a quantity, or of one: of its series over a
    /// period, or among the times of a trajectory.
    ///
    /// # Errors
    /// As [`Solution::series`], but for trajectories.
    pub fn extremes(&self, what: impl Into<Selection>) -> Result<Vec<Extremes>> {
        let selection = what.into();
        if !self.is_trajectory() {
            let found: Vec<_> = self.series(selection)?.iter().map(Extremes::of).collect();
            for extremes in &found {
                require_numbers("extremes", &[extremes.smallest, extremes.largest])?;
            }
            return Ok(found);
        }
        let probe = selection.quantity.probe(&self.solve.system)?;
        let times = self.solve.times();
        let samples = probe.samples(&self.history())?;
        let of = |values: &Vec<f64>| {
            let all = times.iter().copied().zip(values.iter().copied());
            Extremes::among((times[0], values[0]), all)
        };
        selection.of(samples.columns.iter().map(of).collect())
    }

    /// A quantity of a node at `times`, see [`Solution::sample`].
    ///
    /// # Errors
    /// Those of [`Solution::sample`].
    pub fn node(&self, node: usize, quantity: NodeQuantity, times: &[f64]) -> Result<Vec<f64>> {
        self.sample(Quantity::Node(node, quantity), times)
    }

    /// A quantity of a joint at `times`, see [`Solution::sample`].
    ///
    /// # Errors
    /// Those of [`Solution::sample`].
    pub fn joint(&self, joint: usize, quantity: JointQuantity, times: &[f64]) -> Result<Vec<f64>> {
        self.sample(Quantity::Joint(joint, quantity), times)
    }

    /// A quantity at `station` in `[−1, 1]` of a beam element at `times`, see
    /// [`Solution::sample`].
    ///
    /// # Errors
    /// Those of [`Solution::sample`].
    pub fn beam(
        &self,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
        times: &[f64],
    ) -> Result<Vec<f64>> {
        let quantity = Quantity::Beam {
            element,
            station,
            quantity,
        };
        self.sample(quantity, times)
    }

    /// A quantity at a place of a shell element at `times`, see [`Solution::sample`].
    ///
    /// # Errors
    /// Those of [`Solution::sample`].
    pub fn shell(
        &self,
        element: usize,
        point: ShellPoint,
        quantity: ShellQuantity,
        times: &[f64],
    ) -> Result<Vec<f64>> {
        let quantity = Quantity::Shell {
            element,
            point,
            quantity,
        };
        self.sample(quantity, times)
    }

    /// A quantity of a force at `times`, see [`Solution::sample`].
    ///
    /// # Errors
    /// Those of [`Solution::sample`].
    pub fn force(&self, force: usize, quantity: ForceQuantity, times: &[f64]) -> Result<Vec<f64>> {
        self.sample(Quantity::Force(force, quantity), times)
    }
}
