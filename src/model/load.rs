//! Loads along beams.

use super::{Model, Signal};
use crate::elements::{Beam, DistributedLoad, LoadFrame};
use crate::error::{Error, ErrorKind, Result, require_finite};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::ops::Range;

/// Force and moment per unit of reference length, along consecutive beam elements.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct DistributedLoadDefinition {
    /// First beam element.
    pub first_element: usize,
    /// Number of elements.
    pub elements: usize,
    /// How the components are directed: along the inertial axes, or along those of the section.
    pub frame: LoadFrame,
    /// Components `[force; moment]`, per unit of length.
    pub components: [Option<Signal>; 6],
    /// Factors `(fraction, factor)` at ascending fractions, from 0 to 1, of the reference length of these
    /// elements; linear in between, two at the same fraction make a jump. Empty: 1 all along.
    pub factors: Vec<(f64, f64)>,
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
        beams: &[Beam],
        signals: [Option<usize>; 6],
    ) -> Result<()> {
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

/// The part of piecewise linear `factors` from `start` to `end`, with places given as shares of that
/// part, from 0 to 1.
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

impl Model {
    /// Adds a load along beam elements.
    ///
    /// The load acts on the line of the beam and moves with its sections. It stays a load for a unit of
    /// *reference* length, however much the beam stretches.
    ///
    /// # Errors
    /// If the elements do not exist, or the factors are not finite, not in order, or not from 0 to 1.
    pub fn add_distributed_load(&mut self, load: DistributedLoadDefinition) -> Result<()> {
        let count = self.beams.len();
        if load.first_element >= count {
            let message = format!(
                "first_element: expected a beam element id below {count}, got {}",
                load.first_element
            );
            return Err(Error::new(ErrorKind::Identifier, message));
        }
        let most = count - load.first_element;
        if !(1..=most).contains(&load.elements) {
            let expected = format!("1 to {most} from element {} on", load.first_element);
            return Err(Error::size("elements", expected, load.elements));
        }
        let last = load.factors.len().saturating_sub(1);
        if load.factors.len() == 1 {
            return Err(Error::size("factors", "none, or at least 2", 1));
        }
        for (i, &(fraction, factor)) in load.factors.iter().enumerate() {
            let name = format!("fractions[{i}]");
            require_finite(&name, &[fraction])?;
            require_finite(&format!("factors[{i}]"), &[factor])?;
            let expected = match i {
                0 if fraction != 0.0 => "0 at the start".into(),
                _ if i == last && fraction != 1.0 => "1 at the end".into(),
                _ if i > 0 && fraction < load.factors[i - 1].0 => {
                    format!("at least {}, the one before", load.factors[i - 1].0)
                }
                _ => continue,
            };
            return Err(Error::value(&name, expected, fraction));
        }
        self.distributed_loads.push(load);
        Ok(())
    }
}
