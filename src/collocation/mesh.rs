//! How much the equations of beams are wrong because their elements are of too low a degree, or too
//! few. See docs/theory.md, section 10.5.

use super::problem::Collocation;
use super::state::GridState;
use crate::elements::{NodeState, Raised};
use crate::error::Result;
use crate::motion::Motion;
use crate::system::{ElementRole, Placed, System};
use nalgebra::{DVector, Vector6};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Steps of Newton's method by which bubbles are found: where a beam bends much within an element,
/// the first stretches it.
const BENDINGS: usize = 3;

/// Increments below this, of lengths beside the characteristic length and angles, have no second
/// step.
const SMALL: f64 = 1e-4;

/// The elements that stand for one beam element: itself, its inertia and the loads along it, by
/// their numbers.
#[derive(Debug, Clone, Default)]
struct Together {
    beam: usize,
    others: Vec<usize>,
}

/// What stands for each beam element.
fn together(system: &System) -> Vec<Together> {
    let mut found: Vec<Together> = Vec::new();
    let mut by_nodes = BTreeMap::new();
    let is_beam = |placed: &Placed| matches!(placed.role, ElementRole::Beam(_));
    for (index, placed) in system.elements().iter().enumerate() {
        if is_beam(placed) {
            by_nodes.insert(placed.element.nodes().to_vec(), found.len());
            found.push(Together {
                beam: index,
                others: Vec::new(),
            });
        }
    }
    for (index, placed) in system.elements().iter().enumerate() {
        let along = matches!(
            placed.role,
            ElementRole::Inertia | ElementRole::Load | ElementRole::MassDamping
        );
        if along && let Some(&beam) = by_nodes.get(placed.element.nodes()) {
            found[beam].others.push(index);
        }
    }
    found
}

/// Largest of displacements, as parts of `length`, and turns.
fn largest(increments: &DVector<f64>, length: f64) -> f64 {
    let each = increments.iter().enumerate();
    let size = each.map(|(i, x)| if i % 6 < 3 { x / length } else { *x });
    size.fold(0.0, |most: f64, x| most.max(x.abs()))
}

impl Collocation {
    /// What is left of these equations, scaled, if the beam elements are those of the `fine`
    /// system, [`Raised`] from their own: forces on their nodes.
    ///
    /// # Errors
    /// If a motion cannot be interpolated.
    pub fn left_by_mesh(
        &self,
        state: &GridState,
        fine: Arc<System>,
        between: &[Raised],
    ) -> Result<Vec<f64>> {
        let points = self.grid().points();
        let mut equations = Collocation::new(fine, self.grid())?;
        equations.set_signals(self.signals());
        let fine_state = self.raised_state(state, equations.system(), between)?;
        equations.update_kinematics(&fine_state);
        let system = self.system().clone();
        let (coarse, fine) = (together(&system), together(equations.system()));
        let fine_system = equations.system().clone();
        let mut rows = vec![0.0; self.size()];
        let mut forces_only = system.workspace(false);
        let mut fine_forces = equations.system().workspace(false);
        let mut with_tangents = equations.system().workspace(true);
        for ((coarse, fine), relation) in coarse.iter().zip(&fine).zip(between) {
            let nodes = system.elements()[coarse.beam].element.nodes();
            for k in 0..points {
                let states: Vec<NodeState> = nodes
                    .iter()
                    .map(|&node| self.node_states()[node * points + k])
                    .collect();
                let mut own = DVector::zeros(6 * nodes.len());
                for &index in coarse.others.iter().chain([&coarse.beam]) {
                    let placed = &system.elements()[index];
                    own += &self
                        .instants
                        .evaluate(placed, k, state, &mut forces_only)?
                        .force;
                }
                let elements = fine_system.elements();
                let mut forces = DVector::zeros(6 * elements[fine.beam].element.nodes().len());
                for &index in &fine.others {
                    let evaluated = equations.instants.evaluate(
                        &elements[index],
                        k,
                        &fine_state,
                        &mut fine_forces,
                    );
                    forces += &evaluated?.force;
                }
                let inner = elements[fine.beam].element.nodes();
                let mut left = DVector::zeros(0);
                for _ in 0..BENDINGS {
                    let beam = equations.instants.evaluate(
                        &elements[fine.beam],
                        k,
                        &fine_state,
                        &mut with_tangents,
                    )?;
                    let increments;
                    (increments, left) = relation.bent(beam, &(&forces + &beam.force));
                    let states = &mut equations.instants.states;
                    if largest(&increments, system.scales().length) < SMALL {
                        break;
                    }
                    for (&node, u) in inner.iter().zip(increments.as_slice().chunks_exact(6)) {
                        let motion = &mut states[node * points + k].motion;
                        *motion = motion.increment(&Vector6::from_column_slice(u));
                    }
                }
                let left = relation.on_coarse_nodes(&states, &left)? - own;
                for (node, force) in nodes.iter().zip(left.as_slice().chunks_exact(6)) {
                    let at = self.layout().motion(*node, k);
                    let scales = &self.row_scale[at.clone()];
                    for ((row, f), scale) in rows[at].iter_mut().zip(force).zip(scales) {
                        *row += f * scale;
                    }
                }
            }
        }
        Ok(rows)
    }

    /// The same state of the finer system.
    fn raised_state(
        &self,
        state: &GridState,
        fine: &Arc<System>,
        between: &[Raised],
    ) -> Result<GridState> {
        let points = self.grid().points();
        let mut raised = GridState::at_points(fine, points);
        let there = state.motions.len();
        raised.motions[..there].copy_from_slice(&state.motions);
        raised.multipliers.copy_from_slice(&state.multipliers);
        raised.coordinates.copy_from_slice(&state.coordinates);
        let coarse = together(self.system());
        for ((coarse, fine_beam), relation) in coarse.iter().zip(together(fine)).zip(between) {
            let nodes = self.system().elements()[coarse.beam].element.nodes();
            let inner = fine.elements()[fine_beam.beam].element.nodes();
            for k in 0..points {
                let motions: Vec<Motion> = nodes
                    .iter()
                    .map(|&node| state.motions[node * points + k])
                    .collect();
                let motions = relation.motions(&motions)?;
                for (&node, motion) in inner.iter().zip(motions) {
                    if node * points >= there {
                        raised.motions[node * points + k] = motion;
                    }
                }
            }
        }
        Ok(raised)
    }
}
