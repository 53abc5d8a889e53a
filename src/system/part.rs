//! A part of a system: some of its nodes, and the elements that act on those.
//!
//! A part is a system itself, with the signals and characteristic scales of the whole. At the nodes
//! whose elements are all there, its equations are those of the whole.

use super::System;
use crate::elements::Renumbered;
use std::sync::Arc;

impl System {
    /// The part of these nodes and elements, both in ascending order; all nodes of the elements
    /// must be among the nodes.
    ///
    /// Numbers of nodes and elements of the part are their places in the lists. Numbers of signals,
    /// joints and tracked coordinates are those of the whole; coordinates of joints whose nodes are
    /// not all there keep their values.
    pub(crate) fn part(&self, nodes: &[usize], elements: &[usize]) -> System {
        self.part_of_shares(nodes, elements, |_| 1.0)
    }

    /// The same where elements count for a share of them.
    pub(crate) fn part_of_shares(
        &self,
        nodes: &[usize],
        elements: &[usize],
        share: impl Fn(usize) -> f64,
    ) -> System {
        let place = |node: usize| nodes.binary_search(&node).ok();
        let mut part = System {
            regime: self.regime,
            reference: nodes.iter().map(|&node| self.reference[node]).collect(),
            elements: Vec::with_capacity(elements.len()),
            shapes: Vec::new(),
            own_unknowns: Vec::new(),
            signals: self.signals.clone(),
            gravity: self.gravity,
            inertias: Vec::new(),
            beams: Vec::new(),
            shells: Vec::new(),
            joints: self.joints.clone(),
            counted_turns: self.counted_turns.clone(),
            turning: self.turning,
            symmetry: None,
            prescribed: self.prescribed.clone(),
            relations: self.relations.clone(),
            drives: self.drives.clone(),
            tracked: self.tracked.clone(),
            acted_on: self.acted_on,
            loops: Vec::new(),
            dependencies: Vec::new(),
            calls_functions: self.calls_functions,
            lacks_functions: self.lacks_functions,
            scales: self.scales,
            places: Some((0..self.nodes()).map(place).collect()),
        };
        for &index in elements {
            let placed = &self.elements[index];
            let nodes = placed.element.nodes().iter();
            let nodes = nodes.filter_map(|&node| place(node)).collect();
            let element = Renumbered::new(placed.element.clone(), nodes).with_share(share(index));
            part.place(Arc::new(element), placed.role);
        }
        part
    }
}
