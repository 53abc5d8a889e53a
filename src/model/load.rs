//! Loads on nodes and along beams.

use super::validation::{require_ascending, require_elements};
use super::{Model, Signal};
use crate::elements::{Beam, BeamLoadFrame, DistributedLoad, LoadFrame};
use crate::error::{Error, Result, require_finite};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::ops::Range;
use std::sync::Arc;

/// Force and moment on a node.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct LoadDefinition {
    /// Node.
    pub node: usize,
    /// How the components are directed.
    pub frame: LoadFrame,
    /// Components `[force; moment]`.
    pub components: [Option<Signal>; 6],
}

/// Force and moment per unit of reference length, along consecutive beam elements.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct DistributedLoadDefinition {
    /// First beam element.
    pub first_element: usize,
    /// Number of elements.
    pub elements: usize,
    /// How the components are directed.
    pub frame: BeamLoadFrame,
    /// Components `[force; moment]`, per unit of length.
    pub components: [Option<Signal>; 6],
    /// Factors `(fraction, factor)` at ascending fractions, from 0 to 1, of the reference length of
    /// these elements; linear in between, two at the same fraction make a jump. Empty: 1 all along.
    pub factors: Vec<(f64, f64)>,
}

/// Force and moment per unit of reference length at one place along consecutive beam elements.
#[derive(Debug, Clone)]
pub struct LoadPlace {
    /// Fraction of the reference length of these elements.
    pub fraction: f64,
    /// Components `[force; moment]`, per unit of length.
    pub components: [Option<Signal>; 6],
}

impl DistributedLoadDefinition {
    /// The elements that are loaded.
    pub(crate) fn range(&self) -> Range<usize> {
        self.first_element..self.first_element + self.elements
    }

    /// Adds the load, with `signals` for its components, to those on each beam element of `beams`.
    pub(crate) fn add_to(
        &self,
        loads: &mut BTreeMap<usize, DistributedLoad>,
        beams: &[Arc<Beam>],
        signals: [Option<usize>; 6],
    ) -> Result<()> {
        if signals.iter().all(Option::is_none) {
            return Ok(());
        }
        let lengths = beams[self.range()]
            .iter()
            .map(|beam| beam.length_to(1.0))
            .collect::<Result<Vec<_>>>()?;
        let total: f64 = lengths.iter().sum();
        let mut start = 0.0;
        for (element, length) in self.range().zip(lengths) {
            let beam = &beams[element];
            let places = places_within(&self.factors, start / total, (start + length) / total)
                .into_iter()
                .map(|(share, factor)| Ok((beam.xi_at(share)?, factor)))
                .collect::<Result<Vec<_>>>()?;
            if places.iter().any(|place| place.1 != 0.0) {
                let load = match loads.entry(element) {
                    Entry::Occupied(there) => there.into_mut(),
                    Entry::Vacant(free) => free.insert(DistributedLoad::new(beam)?),
                };
                load.add(beam, self.frame, signals, &places)?;
            }
            start += length;
        }
        Ok(())
    }
}

/// The part of piecewise linear `factors` from `start` to `end`, with places given as shares of
/// that part, from 0 to 1.
fn places_within(factors: &[(f64, f64)], start: f64, end: f64) -> Vec<(f64, f64)> {
    if factors.is_empty() {
        return vec![(0.0, 1.0), (1.0, 1.0)];
    }
    let mut places = Vec::new();
    for pair in factors.windows(2) {
        let ((from, first), (to, second)) = (pair[0], pair[1]);
        let (low, high) = (from.max(start), to.min(end));
        if low < high {
            for at in [low, high] {
                let factor = first + (second - first) * (at - from) / (to - from);
                places.push(((at - start) / (end - start), factor));
            }
        }
    }
    places
}

/// The factors of what is 1 at place `i` and falls to zero at its neighbours.
fn factors_at(i: usize, fraction: impl Fn(usize) -> f64, last: usize) -> Vec<(f64, f64)> {
    let mut factors = Vec::with_capacity(5);
    if i > 0 {
        factors.extend([(0.0, 0.0), (fraction(i - 1), 0.0)]);
    }
    factors.push((fraction(i), 1.0));
    if i < last {
        factors.extend([(fraction(i + 1), 0.0), (1.0, 0.0)]);
    }
    factors
}

impl Model {
    /// Adds a force and moment on a node; returns its number among loads on nodes.
    pub fn add_load(
        &mut self,
        node: usize,
        frame: LoadFrame,
        components: [Option<Signal>; 6],
    ) -> Result<usize> {
        self.require_node("node", node)?;
        self.loads.push(LoadDefinition {
            node,
            frame,
            components,
        });
        Ok(self.loads.len() - 1)
    }

    /// Adds a load that is given at `places`, from 0 to 1 and ascending, all its components at
    /// once, and linear in between; two at the same fraction make a jump: a beam load for each of
    /// them. Returns the number of the first. See [`Model::add_distributed_load`].
    ///
    /// # Errors
    /// If the elements do not exist, or the places are fewer than two, not in order, or not from 0
    /// to 1; then nothing is added.
    pub fn add_load_at_places(
        &mut self,
        first_element: usize,
        elements: usize,
        frame: BeamLoadFrame,
        places: &[LoadPlace],
    ) -> Result<usize> {
        if places.len() < 2 {
            return Err(Error::size("places", "at least 2", places.len()));
        }
        // All are in order, before each is taken with its neighbours.
        self.require_load(&DistributedLoadDefinition {
            first_element,
            elements,
            frame,
            components: [const { None }; 6],
            factors: places.iter().map(|place| (place.fraction, 0.0)).collect(),
        })?;
        let first = self.distributed_loads.len();
        let last = places.len() - 1;
        for (i, place) in places.iter().enumerate() {
            self.distributed_loads.push(DistributedLoadDefinition {
                first_element,
                elements,
                frame,
                components: place.components.clone(),
                factors: factors_at(i, |i| places[i].fraction, last),
            });
        }
        Ok(first)
    }

    /// Adds a load along beam elements; returns its number among these.
    ///
    /// The load acts on the line of the beam and moves with its sections. It stays a load for a
    /// unit of *reference* length, however much the beam stretches.
    ///
    /// # Errors
    /// If the elements do not exist, or the factors are not finite, not in order, or not from 0 to
    /// 1; if the direction of an untwisted beam is along it somewhere.
    pub fn add_distributed_load(&mut self, load: DistributedLoadDefinition) -> Result<usize> {
        self.require_load(&load)?;
        self.distributed_loads.push(load);
        Ok(self.distributed_loads.len() - 1)
    }

    fn require_load(&self, load: &DistributedLoadDefinition) -> Result<()> {
        let elements = (load.first_element, load.elements);
        require_elements("beam element", self.beams.len(), elements)?;
        if load.factors.len() == 1 {
            return Err(Error::size("factors", "none, or at least 2", 1));
        }
        let (fractions, factors): (Vec<f64>, Vec<f64>) = load.factors.iter().copied().unzip();
        require_ascending("fractions", &fractions, true)?;
        require_finite("factors", &factors)?;
        if let BeamLoadFrame::Untwisted(direction) = load.frame {
            super::validation::direction("axis_2", &direction)?;
            for element in load.range() {
                let beam = self.beam_element(element)?;
                DistributedLoad::new(&beam)?.axes(&beam, load.frame)?;
            }
        }
        Ok(())
    }
}
