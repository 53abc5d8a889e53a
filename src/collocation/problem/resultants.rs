//! Stress resultants that geometric stiffness is taken at (docs/theory.md, section 7.3).

use super::Collocation;
use crate::collocation::like_blades::Leaders;
use crate::collocation::rule::RuleWorkspace;
use crate::elements::NodeState;
use crate::error::Result;
use crate::fourier::Resampling;
use crate::system::{Placed, Workspace};
use nalgebra::Vector6;

/// Those at the stations of an element.
type Resultants = [Vector6<f64>];

/// Whether what an element does matters to what leads, if blades are alike.
fn matters(leaders: Option<&Leaders>, element: usize) -> bool {
    leaders.is_none_or(|leaders| leaders.of_elements()[element] > 0)
}

impl Collocation {
    /// Stress resultants of all stations by their strains, at one grid point after the other; of
    /// states that are taken for alike those of what leads.
    ///
    /// Kinematics must be those of the state that is meant.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn resultants_of_strains(&mut self) -> Result<Vec<Vector6<f64>>> {
        let leaders = self.leaders.clone();
        self.resultants_of_leaders(leaders.as_deref())
    }

    /// The same, of what leads alone if blades move alike in the state; zero elsewhere.
    fn resultants_of_leaders(&mut self, leaders: Option<&Leaders>) -> Result<Vec<Vector6<f64>>> {
        let (system, points) = (self.system.clone(), self.grid.points());
        self.at_stations(leaders, |placed, states, k, workspace, out| {
            let state = |node: usize| states[node * points + k];
            system.stress_resultants(placed, state, workspace, out)
        })
    }

    /// Those that follow from these in proportion to the unscaled `increment` of the unknowns.
    ///
    /// After an increment that turns beams much, those of the strains have little to do with
    /// equilibrium: second-order stretching, times axial stiffness. These are in equilibrium, as
    /// the linear equations were.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn extrapolated_resultants(&mut self, increment: &[f64]) -> Result<Vec<Vector6<f64>>> {
        let (system, points) = (self.system.clone(), self.grid.points());
        let changes = self.increments_with_rates(increment);
        let leaders = self.leaders.clone();
        self.at_stations(leaders.as_deref(), |placed, states, k, workspace, out| {
            let state = |node: usize| (states[node * points + k], changes[node * points + k]);
            system.extrapolated_resultants(placed, state, workspace, out)
        })
    }

    /// Finds something at the stations of each element, at all grid points.
    fn at_stations(
        &mut self,
        leaders: Option<&Leaders>,
        find: impl Fn(&Placed, &[NodeState], usize, &mut Workspace, &mut Resultants) -> Result<()>
        + Sync,
    ) -> Result<Vec<Vector6<f64>>> {
        let (system, states) = (&self.system, &self.instants.states);
        let mut all = vec![Vector6::zeros(); self.grid.points() * system.stations()];
        let mut instants: Vec<_> = all.chunks_exact_mut(system.stations()).collect();
        self.workers.try_for_each(
            &mut instants,
            &mut self.forces_only,
            || system.workspace(false),
            |workspace, k, out| {
                let elements = system.elements().iter().enumerate();
                let mut wanted = elements.filter(|(index, _)| matters(leaders, *index));
                wanted.try_for_each(|(_, placed)| {
                    let out = &mut out[placed.stations.clone()];
                    find(placed, states, k, workspace, out)
                })
            },
        )?;
        Ok(all)
    }

    /// Lets what stress resultants of the nodes `from` are more than those `given` act on the nodes
    /// as they are at `to` instead: adds what that changes of the forces to `rows`, `count` of them
    /// for each grid point, of which those of the nodes come first.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub(in crate::collocation) fn move_excess(
        &mut self,
        given: &[Vector6<f64>],
        [from, to]: [&[NodeState]; 2],
        (rows, count): (&mut [f64], usize),
        leaders: Option<&Leaders>,
    ) -> Result<()> {
        let (system, points) = (&self.system, self.grid.points());
        let given = given.chunks_exact(system.stations());
        let mut instants: Vec<_> = rows.chunks_exact_mut(count).zip(given).collect();
        self.workers.try_for_each(
            &mut instants,
            &mut self.forces_only,
            || system.workspace(false),
            |workspace, k, (rows, given)| {
                for (index, placed) in system.elements().iter().enumerate() {
                    if !matters(leaders, index) {
                        continue;
                    }
                    let given = &given[placed.stations.clone()];
                    if given.is_empty() {
                        continue;
                    }
                    let at = |node: usize| node * points + k;
                    let nodes = [from, to].map(|states| move |node: usize| states[at(node)]);
                    let forces = system
                        .forces_moved(placed, nodes, given, workspace)?
                        .chunks_exact(6);
                    for (&node, force) in placed.element.nodes().iter().zip(forces) {
                        let rows = rows[6 * node..][..6].iter_mut();
                        rows.zip(force).for_each(|(row, f)| *row += f);
                    }
                }
                Ok(())
            },
        )
    }

    /// Increments of the nodes, and of their velocities, that an unscaled increment of all unknowns
    /// is; kinematics are those of the last evaluation.
    fn increments_with_rates(&self, increment: &[f64]) -> Vec<[Vector6<f64>; 2]> {
        let points = self.grid.points();
        let mut changes = vec![[Vector6::zeros(); 2]; points * self.system.nodes()];
        let mut rates = vec![[Vector6::zeros(); 2]; points];
        let mut workspace = RuleWorkspace::default();
        let of_nodes = increment.chunks_exact(self.layout.of_node());
        let leaders = self.leaders.as_deref();
        for (node, (changes, increments)) in changes.chunks_mut(points).zip(of_nodes).enumerate() {
            if leaders.is_some_and(|leaders| !leaders.leads(node)) {
                continue;
            }
            self.rule.vary(node, increments, &mut workspace, &mut rates);
            let increments = increments.chunks_exact(6).zip(&rates);
            for (change, (u, [velocity, _])) in changes.iter_mut().zip(increments) {
                *change = [Vector6::from_column_slice(u), *velocity];
            }
        }
        if let Some(leaders) = leaders {
            leaders.repeat_changes(&mut changes);
        }
        changes
    }

    /// Stress resultants of all stations by their strains, where `resampling` goes from this grid;
    /// none where tangents have no use for them; if blades move alike, those of what leads alone.
    ///
    /// Kinematics must be those of the state that is meant.
    ///
    /// # Errors
    /// If an element is too distorted.
    pub fn resampled_resultants(
        &mut self,
        mut resampling: Resampling,
        leaders: Option<&Leaders>,
    ) -> Result<Vec<Vector6<f64>>> {
        let (stations, points) = (self.system.stations(), resampling.points());
        if stations == 0 || self.oversampled.is_some() {
            return Ok(Vec::new());
        }
        let resultants = self.resultants_of_leaders(leaders)?;
        let mut all = vec![Vector6::zeros(); points * stations];
        let mut values = vec![0.0; points];
        // Those of a station lie far apart: they are fetched and put back once for all six.
        let mut there = vec![Vector6::zeros(); points];
        let elements = self.system.elements().iter().enumerate();
        let wanted = elements.filter(|(index, _)| matters(leaders, *index));
        for station in wanted.flat_map(|(_, placed)| placed.stations.clone()) {
            let here = resultants.iter().skip(station).step_by(stations);
            let here: Vec<Vector6<f64>> = here.copied().collect();
            for row in 0..6 {
                resampling.read(here.iter().map(|resultants| resultants[row]));
                resampling.write(0, 0, &mut values);
                let components = there.iter_mut().map(|there| &mut there[row]);
                components.zip(&values).for_each(|(x, value)| *x = *value);
            }
            let places = all.iter_mut().skip(station).step_by(stations);
            places.zip(&there).for_each(|(all, there)| *all = *there);
        }
        Ok(all)
    }

    /// From now on takes geometric stiffness at these stress resultants; if there are none, at
    /// those of the strains: the tangent is then exact.
    pub fn set_resultants(&mut self, resultants: Vec<Vector6<f64>>) {
        self.instants.resultants = resultants;
    }

    /// Gives the stress resultants that geometric stiffness was taken at, from now on those of the
    /// strains.
    pub fn take_resultants(&mut self) -> Vec<Vector6<f64>> {
        std::mem::take(&mut self.instants.resultants)
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
