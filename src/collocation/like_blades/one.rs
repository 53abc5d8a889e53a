//! One blade with its share of hub and supports, for solvers that iterate: a system of its own over
//! the whole period, whose hub and supports may only move alike (docs/theory.md, section 8.10).

use super::alike::{AlikeMotions, Step};
use super::{LikeBlades, scaled_adjoint};
use crate::collocation::problem::Collocation;
use crate::collocation::state::GridState;
use crate::error::Result;
use crate::system::{Symmetry, System};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The system of one blade.
#[derive(Debug)]
pub struct OneBlade {
    /// Its equations.
    pub equations: Collocation,
    /// Leading nodes and elements, in the order of the system.
    nodes: Vec<usize>,
    elements: Vec<usize>,
    /// Of each element, whether it acts on hub and supports alone.
    is_shared: Vec<bool>,
    /// Of each element and part of the period: what carries its own unknowns back to its leader's;
    /// none where they are the same.
    back: Vec<Vec<Option<DMatrix<f64>>>>,
}

impl OneBlade {
    /// Of equations of a whole rotor; none if an element acts on two blades.
    ///
    /// # Errors
    /// Those of signals.
    pub fn of(whole: &Collocation, symmetry: &Symmetry, left: &LikeBlades) -> Result<Option<Self>> {
        let system = whole.system();
        let leads = |node: usize| left.nodes[node].leader == node;
        let is_shared = |node: usize| symmetry.nodes[node] == node;
        let nodes: Vec<usize> = (0..system.nodes()).filter(|&n| leads(n)).collect();
        let mut elements = Vec::new();
        for (index, placed) in system.elements().iter().enumerate() {
            let all = placed.element.nodes();
            if all.iter().all(|&node| leads(node)) {
                let is_leader = left.elements[index].leader == index;
                if placed.element.own_unknowns() > 0 && !is_leader {
                    return Ok(None);
                }
                elements.push(index);
            } else if all.iter().any(|&node| leads(node) && !is_shared(node)) {
                return Ok(None);
            }
        }
        let shared = |index: &usize| {
            let nodes = system.elements()[*index].element.nodes();
            nodes.iter().all(|&node| is_shared(node))
        };
        let is_shared_element: Vec<bool> = elements.iter().map(shared).collect();
        let own_leaders = (0..system.elements().len())
            .filter(|&e| left.elements[e].leader == e)
            .filter(|&e| system.elements()[e].element.own_unknowns() > 0);
        // Those of another blade lead where its elements were described first.
        if own_leaders.into_iter().any(|e| !elements.contains(&e)) {
            return Ok(None);
        }
        let share = |index: usize| match shared(&index) {
            true => 1.0 / symmetry.blades as f64,
            false => 1.0,
        };
        let part = system.part_of_shares(&nodes, &elements, share);
        let mut equations = Collocation::new(Arc::new(part), whole.grid())?;
        equations.set_workers(whole.workers().clone());
        let length = system.scales().length;
        let step = |&node: &usize| {
            let carry = &symmetry.carries[node];
            is_shared(node).then(|| Step {
                forth: scaled_adjoint(&carry.inverse(), length),
                back: scaled_adjoint(carry, length),
            })
        };
        let steps = nodes.iter().map(step).collect();
        let placed = equations.system().clone();
        let carries = symmetry.carries_of_own.get().and_then(Option::as_ref);
        let own = |&index: &usize| {
            shared(&index).then(|| {
                let forth = carries.and_then(|carries| carries[index].clone())?;
                let back = forth.clone().try_inverse()?;
                Some([forth, back])
            })
        };
        let own = elements.iter().map(own).collect();
        let alike = AlikeMotions::new(symmetry.blades, steps, own, placed.elements());
        equations.set_alike(alike);
        let back = |&index: &usize| {
            let parts = left.elements[index].parts.iter();
            let inverse = |carry: &DMatrix<f64>| carry.clone().try_inverse();
            parts
                .map(|(_, carry)| carry.as_ref().and_then(inverse))
                .collect()
        };
        let back = elements.iter().map(back).collect();
        Ok(Some(OneBlade {
            equations,
            nodes,
            elements,
            is_shared: is_shared_element,
            back,
        }))
    }

    /// Takes the period and what equations are evaluated under from those of the whole, of the same
    /// system.
    ///
    /// # Errors
    /// If the period is none.
    pub fn follow(&mut self, whole: &Collocation) -> Result<()> {
        if self.equations.grid() != whole.grid() {
            self.equations.set_period(whole.grid().period())?;
        }
        let (there, stations) = (&whole.instants, whole.system().stations());
        let here = &mut self.equations.instants;
        here.times.clone_from(&there.times);
        here.signals.clone_from(&there.signals);
        here.inertial = there.inertial;
        here.resultants.clear();
        if !there.resultants.is_empty() {
            for k in 0..here.points {
                for &index in &self.elements {
                    let own = whole.system().elements()[index].stations.clone();
                    let of_point = &there.resultants[k * stations..][..stations];
                    here.resultants.extend_from_slice(&of_point[own]);
                }
            }
        }
        Ok(())
    }

    /// Its part of a state.
    pub fn state(&self, whole: &System, state: &GridState) -> GridState {
        let part = self.equations.system();
        let points = state.points();
        let mut own = GridState::at_points(part, points);
        for (i, &node) in self.nodes.iter().enumerate() {
            own.motions[i * points..][..points].copy_from_slice(state.node(node));
        }
        for (placed, &index) in part.elements().iter().zip(&self.elements) {
            let there = &whole.elements()[index];
            for k in 0..points {
                own.own_of_mut(placed, k)
                    .copy_from_slice(state.own_of(there, k));
            }
        }
        own.coordinates.copy_from_slice(&state.coordinates);
        own
    }

    /// Tells the equations of the whole what its last linearisation found left of them.
    pub fn tell_residual(&self, whole: &mut Collocation) {
        let (here, layout) = (&self.equations, self.equations.layout());
        let mut rows = here.linearised_residual.clone();
        let (system, of_whole) = (whole.system().clone(), whole.layout());
        whole.linearised_residual.clear();
        let (Some(alike), true) = (here.alike(), rows.len() == here.size()) else {
            return;
        };
        // Forces of all blades on hub and supports are so many times their mean.
        let blades = alike.blades() as f64;
        let motions = layout.motions();
        let scaled = rows[motions.clone()].iter_mut().zip(here.row_scale());
        scaled.for_each(|(row, scale)| *row *= scale);
        alike.average(layout, &mut rows);
        let unscaled = rows[motions].iter_mut().zip(here.row_scale());
        unscaled.for_each(|(row, scale)| *row /= scale);
        let mut all = vec![0.0; whole.size()];
        for (i, &node) in self.nodes.iter().enumerate() {
            let factor = alike.of_node(i).map_or(1.0, |_| blades);
            let to = all[of_whole.node(node)].iter_mut();
            let from = &rows[layout.node(i)];
            to.zip(from).for_each(|(to, x)| *to = factor * x);
        }
        let placed = here.system().elements().iter();
        for ((i, placed), &index) in placed.enumerate().zip(&self.elements) {
            let factor = match self.is_shared[i] && placed.has_states {
                true => blades,
                false => 1.0,
            };
            let to = all[of_whole.element(&system.elements()[index])].iter_mut();
            let from = &rows[layout.element(placed)];
            to.zip(from).for_each(|(to, x)| *to = factor * x);
        }
        whole.linearised_residual = all;
        whole.complete_linearised_residual();
    }

    /// Right sides of its equations, from those that are left.
    pub fn rows(&self, left: &LikeBlades, rows: &[f64]) -> Vec<f64> {
        let (system, layout) = (self.equations.system(), self.equations.layout());
        let share = 1.0 / left.blades as f64;
        let mut all = vec![0.0; self.equations.size()];
        let alike = self.equations.alike();
        for (i, &node) in self.nodes.iter().enumerate() {
            let factor = match alike.and_then(|alike| alike.of_node(i)) {
                Some(_) => share,
                None => 1.0,
            };
            let (first, parts) = left.node_places[node].unwrap_or_default();
            for k in 0..parts * left.part {
                let from = rows[first + 6 * k..][..6].iter();
                let to = all[layout.motion(i, k)].iter_mut();
                to.zip(from).for_each(|(to, x)| *to = factor * x);
            }
        }
        if let Some(alike) = alike {
            alike.repeat(layout, &mut all);
        }
        for (i, (placed, &index)) in system.elements().iter().zip(&self.elements).enumerate() {
            let count = placed.element.own_unknowns();
            let factor = match self.is_shared[i] && placed.has_states {
                true => share,
                false => 1.0,
            };
            for k in 0..if count > 0 { layout.points() } else { 0 } {
                let (first, _) = left.element_at(index, count, k);
                let x = DVector::from_column_slice(&rows[first..][..count]) * factor;
                let x = match &self.back[i][k / left.part] {
                    Some(back) => back.tr_mul(&x),
                    None => x,
                };
                all[layout.element_at(placed, k)].copy_from_slice(x.as_slice());
            }
        }
        all
    }

    /// The unknowns that are left, from its own.
    pub fn unknowns(&self, left: &LikeBlades, x: &[f64], out: &mut [f64]) {
        let (system, layout) = (self.equations.system(), self.equations.layout());
        for (i, &node) in self.nodes.iter().enumerate() {
            let (first, parts) = left.node_places[node].unwrap_or_default();
            for k in 0..parts * left.part {
                out[first + 6 * k..][..6].copy_from_slice(&x[layout.motion(i, k)]);
            }
        }
        for (i, (placed, &index)) in system.elements().iter().zip(&self.elements).enumerate() {
            let count = placed.element.own_unknowns();
            let (first, parts) = left.element_places[index].unwrap_or_default();
            let factor = match self.is_shared[i] && !placed.has_states {
                true => left.blades as f64,
                false => 1.0,
            };
            for k in 0..if count > 0 { parts * left.part } else { 0 } {
                let from = &x[layout.element_at(placed, k)];
                let to = out[first + count * k..][..count].iter_mut();
                to.zip(from).for_each(|(to, x)| *to = factor * x);
            }
        }
    }
}
