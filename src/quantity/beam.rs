//! Strains and internal forces of beams.

use super::history::History;
use super::samples::Samples;
use super::variation::Variation;
use super::{Dependence, Probe};
use crate::elements::{Beam, Element};
use crate::error::{Error, Result, require_finite, require_id};
use crate::system::{ElementRole, System};
use nalgebra::Vector6;

/// What can be asked of a beam element at a station; components along the section's axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamQuantity {
    /// `[axial, shear 2, shear 3]` strains and `[torsion, bending 2, bending 3]` curvatures.
    Strain,
    /// `[axial, shear 2, shear 3]` forces and `[torsion, bending 2, bending 3]` moments: the
    /// element's own.
    Force,
    /// The same, but at a node between two elements the mean of those of both.
    MeanForce,
    /// At a node between two elements, forces and moments of the one beyond it less those of the
    /// one before it, which a finer mesh makes smaller; zero elsewhere.
    ///
    /// Two elements have a node between them if one ends and the other starts there, and nothing
    /// else is at the node: no other element, no body, joint, load or force, whose own jump this
    /// would hide.
    ForceJump,
}

impl BeamQuantity {
    /// Whether it is one of two elements.
    pub(crate) fn needs_neighbours(self) -> bool {
        matches!(self, BeamQuantity::MeanForce | BeamQuantity::ForceJump)
    }

    /// Finds it, where it is known which elements follow each other, if that matters.
    pub(crate) fn probe(
        self,
        system: &System,
        neighbours: Option<&Neighbours>,
        element: usize,
        station: f64,
    ) -> Result<Box<dyn Probe>> {
        require_station(system, element, station)?;
        let quantity = if self == BeamQuantity::Strain {
            Resultant::Strain
        } else {
            Resultant::Force
        };
        let own = |factor| Part {
            element,
            station,
            factor,
        };
        let beyond = neighbours.and_then(|n| n.beyond(element, station));
        let parts = match (self, beyond) {
            (BeamQuantity::Strain | BeamQuantity::Force, _) | (BeamQuantity::MeanForce, None) => {
                vec![own(1.0)]
            }
            (BeamQuantity::MeanForce, Some((other, _))) => {
                vec![own(0.5), other_side(other, station, 0.5)]
            }
            (BeamQuantity::ForceJump, None) => Vec::new(),
            (BeamQuantity::ForceJump, Some((other, after))) => {
                let factor = if after { 1.0 } else { -1.0 };
                vec![own(-factor), other_side(other, station, factor)]
            }
        };
        Ok(Box::new(BeamProbe { quantity, parts }))
    }
}

/// The same node as the end of the other element.
fn other_side(element: usize, station: f64, factor: f64) -> Part {
    Part {
        element,
        station: -station,
        factor,
    }
}

/// A beam element, and that it has such a station.
///
/// # Errors
/// If there is no such element, or the station is outside it.
pub(crate) fn require_station(system: &System, element: usize, station: f64) -> Result<&Beam> {
    require_finite("station", &[station])?;
    if !(-1.0..=1.0).contains(&station) {
        return Err(Error::value("station", "a number from −1 to 1", station));
    }
    let beams = system.beams();
    require_id("element", "beam element", beams.len(), element)?;
    Ok(&beams[element])
}

/// An element and the next along the beam, where nothing else is at the node between them.
pub(crate) struct Neighbours {
    /// Of each element, those before and after it.
    pairs: Vec<[Option<usize>; 2]>,
}

impl Neighbours {
    pub fn of(system: &System) -> Self {
        let beams = system.beams();
        // Elements that start at, and that end at a node; or that and more.
        let mut ends = vec![[End::Free; 2]; system.nodes()];
        for (element, beam) in beams.iter().enumerate() {
            let nodes = beam.nodes();
            for (side, node) in [(0, nodes.first()), (1, nodes.last())] {
                if let Some(&node) = node {
                    ends[node][side].add(element);
                }
            }
        }
        for placed in system.elements() {
            let nodes = placed.element.nodes();
            let along_beam = match placed.role {
                ElementRole::Beam(_) => true,
                ElementRole::Inertia
                | ElementRole::Shell(_)
                | ElementRole::Load
                | ElementRole::MassDamping => nodes.len() > 1,
                _ => false,
            };
            if !along_beam {
                nodes.iter().for_each(|&node| ends[node] = [End::Shared; 2]);
            }
        }
        let mut pairs = vec![[None; 2]; beams.len()];
        for end in ends {
            if let [End::Of(after), End::Of(before)] = end {
                pairs[after][0] = Some(before);
                pairs[before][1] = Some(after);
            }
        }
        Neighbours { pairs }
    }

    /// The element that goes on at a station of this one, and whether it is the one beyond.
    fn beyond(&self, element: usize, station: f64) -> Option<(usize, bool)> {
        let [before, after] = *self.pairs.get(element)?;
        match station {
            -1.0 => before.map(|other| (other, false)),
            1.0 => after.map(|other| (other, true)),
            _ => None,
        }
    }
}

/// What starts or ends at a node.
#[derive(Clone, Copy)]
enum End {
    Free,
    Of(usize),
    Shared,
}

impl End {
    fn add(&mut self, element: usize) {
        *self = match self {
            End::Free => End::Of(element),
            _ => End::Shared,
        };
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Resultant {
    Strain,
    Force,
}

/// A station of an element, and what counts of it.
#[derive(Debug)]
struct Part {
    element: usize,
    station: f64,
    factor: f64,
}

/// A sum over one station, or those of two elements at a node.
#[derive(Debug)]
struct BeamProbe {
    quantity: Resultant,
    parts: Vec<Part>,
}

impl Probe for BeamProbe {
    fn dependence(&self) -> Dependence {
        match self.quantity {
            Resultant::Strain => Dependence::Nothing,
            Resultant::Force => Dependence::Parameters,
        }
    }

    fn samples(&self, history: &History) -> Result<Samples> {
        Samples::at_each(history, 6, |k, row| {
            let mut sum = Vector6::zeros();
            for part in &self.parts {
                let beam = &history.system.beams()[part.element];
                let states = history.nodes_of(&**beam, k);
                let (strain, force) = beam.strain_and_stress(part.station, &states)?;
                sum += match self.quantity {
                    Resultant::Strain => strain,
                    Resultant::Force => force,
                } * part.factor;
            }
            row.extend(sum.iter());
            Ok(())
        })
    }

    fn vary(
        &self,
        history: &History,
        (component, k): (usize, usize),
        _: &Samples,
        weight: f64,
        out: &mut Variation,
    ) -> Result<()> {
        for part in &self.parts {
            let beam = &history.system.beams()[part.element];
            let states = history.nodes_of(&**beam, k);
            let unit = Vector6::ith(component, weight * part.factor);
            let by = match self.quantity {
                Resultant::Strain => [unit, Vector6::zeros()],
                Resultant::Force => [Vector6::zeros(), unit],
            };
            beam.vary_strain_and_stress(part.station, &states, &by, |local, rows| {
                let [motion, velocity] = rows;
                out.add(
                    beam.nodes()[local],
                    k,
                    &[motion, velocity, Vector6::zeros()],
                );
            })?;
        }
        Ok(())
    }
}
