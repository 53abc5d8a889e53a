//! Stress resultants that geometric stiffness is taken at (docs/theory.md, section 7.3).

use super::Collocation;
use crate::collocation::rule::RuleWorkspace;
use crate::collocation::state::GridState;
use crate::error::Result;
use crate::fourier::{Resampling, TimeGrid};
use nalgebra::Vector6;

impl Collocation {
    /// Stress resultants of all stations, at one grid point after the other, that follow from those
    /// at `state` in proportion to the unscaled `increment` of the unknowns.
    ///
    /// After an increment that turns beams much, those of the strains have little to do with
    /// equilibrium: second-order stretching, times axial stiffness. These are in equilibrium, as
    /// the linear equations were.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn extrapolated_resultants(
        &mut self,
        state: &GridState,
        increment: &[f64],
    ) -> Result<Vec<Vector6<f64>>> {
        self.update_kinematics(state);
        let (points, stations) = (self.grid.points(), self.system.stations());
        let mut all = vec![Vector6::zeros(); points * stations];
        let changes = self.increments_with_rates(increment);
        let mut instants: Vec<&mut [Vector6<f64>]> = all.chunks_exact_mut(stations).collect();
        let (system, states) = (&self.system, &self.instants.states);
        self.workers.try_for_each(
            &mut instants,
            &mut Vec::new(),
            || (Vec::new(), Vec::new()),
            |(nodes, increments), k, out| {
                for placed in system.elements() {
                    let places = placed.element.nodes().iter().map(|node| node * points + k);
                    nodes.clear();
                    nodes.extend(places.clone().map(|at| states[at]));
                    increments.clear();
                    increments.extend(places.map(|at| changes[at]));
                    let out = &mut out[placed.stations.clone()];
                    placed
                        .element
                        .extrapolate_resultants(nodes, increments, out)?;
                }
                Ok(())
            },
        )?;
        Ok(all)
    }

    /// Increments of the nodes, and of their velocities, that an unscaled increment of all unknowns
    /// is; kinematics are those of the last evaluation.
    fn increments_with_rates(&self, increment: &[f64]) -> Vec<[Vector6<f64>; 2]> {
        let points = self.grid.points();
        let mut changes = vec![[Vector6::zeros(); 2]; points * self.system.nodes()];
        let mut rates = vec![[Vector6::zeros(); 2]; points];
        let mut workspace = RuleWorkspace::default();
        let of_nodes = increment.chunks_exact(self.layout.of_node());
        for (node, (changes, increments)) in changes.chunks_mut(points).zip(of_nodes).enumerate() {
            self.rule.vary(node, increments, &mut workspace, &mut rates);
            let increments = increments.chunks_exact(6).zip(&rates);
            for (change, (u, [velocity, _])) in changes.iter_mut().zip(increments) {
                *change = [Vector6::from_column_slice(u), *velocity];
            }
        }
        changes
    }

    /// Stress resultants of all stations at `state`, at the points of another grid of the same
    /// period that begins `start` periods later; none where tangents have no use for them.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn resampled_resultants(
        &mut self,
        state: &GridState,
        start: f64,
        other: TimeGrid,
    ) -> Result<Vec<Vector6<f64>>> {
        let stations = self.system.stations();
        if stations == 0 || self.oversampled.is_some() {
            return Ok(Vec::new());
        }
        let resultants = self.extrapolated_resultants(state, &vec![0.0; self.size()])?;
        let mut all = vec![Vector6::zeros(); other.points() * stations];
        let mut resampling = Resampling::new(self.grid, start, other.points());
        let mut values = vec![0.0; other.points()];
        for station in 0..stations {
            for row in 0..6 {
                let own = resultants.iter().skip(station).step_by(stations);
                resampling.read(own.map(|resultants| resultants[row]));
                resampling.write(0, 0, &mut values);
                for (k, value) in values.iter().enumerate() {
                    all[k * stations + station][row] = *value;
                }
            }
        }
        Ok(all)
    }

    /// From now on takes geometric stiffness at these stress resultants; if there are none, at
    /// those of the strains: the tangent is then exact.
    pub fn set_resultants(&mut self, resultants: Vec<Vector6<f64>>) {
        self.instants.resultants = resultants;
    }

    /// The stress resultants that geometric stiffness is taken at; none if those of the strains.
    pub fn resultants(&self) -> &[Vector6<f64>] {
        &self.instants.resultants
    }

    /// Whether geometric stiffness is taken at stress resultants other than those of the strains.
    pub fn has_resultants(&self) -> bool {
        !self.instants.resultants.is_empty()
    }
}
