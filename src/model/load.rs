//! Loads at points, and along beams.

use super::validation::{require_ascending, require_elements};
use super::{Model, Signal};
use crate::elements::{Beam, BeamLoadFrame, DistributedLoad, Element, LoadFrame, NodalLoad};
use crate::error::{Error, Result, require_finite};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::ops::Range;
use std::sync::Arc;

/// What carries a load at a point.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum LoadPoint {
    /// A node.
    Node(usize),
    /// A section along consecutive beam elements.
    Beam {
        /// First beam element.
        first_element: usize,
        /// Number of elements.
        elements: usize,
        /// Fraction of the reference length of these elements.
        fraction: f64,
    },
}

/// Force and moment at a point.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct LoadDefinition {
    /// What carries it.
    #[serde(rename = "node")]
    pub at: LoadPoint,
    /// The point, from there, along the axes of the node or section.
    #[serde(default)]
    pub offset: Vector3<f64>,
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

/// Places that are as near to the end of an element are there: rounding.
const AT_END: f64 = 1e-12;

impl LoadDefinition {
    /// Whether it is one of a kind that came later: not at the origin of a node.
    pub(super) fn is_newer(&self) -> bool {
        !matches!(self.at, LoadPoint::Node(_)) || self.offset != Vector3::zeros()
    }

    /// The load, with `signals` for its components.
    pub(crate) fn element(
        &self,
        beams: &[Arc<Beam>],
        signals: [Option<usize>; 6],
    ) -> Result<Arc<dyn Element>> {
        let (first_element, elements, fraction) = match self.at {
            LoadPoint::Node(node) => {
                return Ok(Arc::new(NodalLoad::new(
                    node,
                    self.offset,
                    self.frame,
                    signals,
                )));
            }
            LoadPoint::Beam {
                first_element,
                elements,
                fraction,
            } => (first_element, elements, fraction),
        };
        let beams = &beams[first_element..first_element + elements];
        let (beam, xi) = place_along(beams, fraction)?;
        let nodes = beam.nodes();
        // The section at a node is the node's, and what is there is no load along the element.
        let end = match xi {
            _ if xi + 1.0 < AT_END => nodes.first(),
            _ if 1.0 - xi < AT_END => nodes.last(),
            _ => None,
        };
        Ok(match end {
            Some(&node) => Arc::new(NodalLoad::new(node, self.offset, self.frame, signals)),
            None => Arc::new(DistributedLoad::at_place(
                beam,
                xi,
                &self.offset,
                self.frame,
                signals,
            )?),
        })
    }
}

/// The element, and the place in it from −1 to 1, at a fraction of the reference length of all.
fn place_along(beams: &[Arc<Beam>], fraction: f64) -> Result<(&Beam, f64)> {
    let lengths = lengths(beams)?;
    let total: f64 = lengths.iter().sum();
    let mut left = fraction * total;
    let last = beams.len() - 1;
    for (beam, length) in beams[..last].iter().zip(lengths) {
        if left <= length {
            return Ok((beam, beam.xi_at(left / length)?));
        }
        left -= length;
    }
    let length = beams[last].length_to(1.0)?;
    Ok((&beams[last], beams[last].xi_at(left / length)?))
}

fn lengths(beams: &[Arc<Beam>]) -> Result<Vec<f64>> {
    beams.iter().map(|beam| beam.length_to(1.0)).collect()
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
        let lengths = lengths(&beams[self.range()])?;
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
    /// Adds a force and moment at the origin of a node; returns its number among loads at points.
    pub fn add_load(
        &mut self,
        node: usize,
        frame: LoadFrame,
        components: [Option<Signal>; 6],
    ) -> Result<usize> {
        self.add_point_load(LoadDefinition {
            at: LoadPoint::Node(node),
            offset: Vector3::zeros(),
            frame,
            components,
        })
    }

    /// Adds a force and moment at a point; returns its number among these.
    ///
    /// The point moves with the node or section that carries it. Along a beam internal forces jump
    /// there, which the polynomials of an element make smooth, unless a node is there.
    ///
    /// # Errors
    /// If there is no such node or element, or a fraction or the offset is out of range.
    pub fn add_point_load(&mut self, load: LoadDefinition) -> Result<usize> {
        match load.at {
            LoadPoint::Node(node) => self.require_node("node", node)?,
            LoadPoint::Beam {
                first_element,
                elements,
                fraction,
            } => {
                let count = self.beams.len();
                require_elements("beam element", count, (first_element, elements))?;
                require_finite("fraction", &[fraction])?;
                if !(0.0..=1.0).contains(&fraction) {
                    return Err(Error::value("fraction", "a number from 0 to 1", fraction));
                }
            }
        }
        require_finite("offset", load.offset.as_slice())?;
        self.loads.push(load);
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

    pub(super) fn require_load(&self, load: &DistributedLoadDefinition) -> Result<()> {
        self.require_beam_axes((load.first_element, load.elements), load.frame)?;
        if load.factors.len() == 1 {
            return Err(Error::size("factors", "none, or at least 2", 1));
        }
        let (fractions, factors): (Vec<f64>, Vec<f64>) = load.factors.iter().copied().unzip();
        require_ascending("fractions", &fractions, true)?;
        require_finite("factors", &factors)
    }

    /// Checks that there are so many beam elements, from the first on, with such axes.
    pub(super) fn require_beam_axes(
        &self,
        (first, elements): (usize, usize),
        frame: BeamLoadFrame,
    ) -> Result<()> {
        require_elements("beam element", self.beams.len(), (first, elements))?;
        if let BeamLoadFrame::Untwisted(direction) = frame {
            super::validation::direction("axis_2", &direction)?;
            for element in first..first + elements {
                let beam = self.beam_element(element)?;
                DistributedLoad::new(&beam)?.axes(&beam, frame)?;
            }
        }
        Ok(())
    }
}
