//! Strains and internal forces of beams.

use super::solution::{Samples, Solution};
use crate::elements::{Beam, Element};
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::PeriodicSeries;
use crate::system::ElementRole;
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

/// An element and the next along the beam, where nothing else is at the node between them.
pub(super) struct Neighbours {
    /// Of each element, those before and after it.
    pairs: Vec<[Option<usize>; 2]>,
}

impl Neighbours {
    pub fn of(solution: &Solution) -> Self {
        let system = &solution.solve.system;
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
                ElementRole::Inertia | ElementRole::Load | ElementRole::MassDamping => {
                    nodes.len() > 1
                }
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

impl Solution {
    pub(super) fn beam_definition(&self, element: usize, station: f64) -> Result<&Beam> {
        require_finite("station", &[station])?;
        if !(-1.0..=1.0).contains(&station) {
            return Err(Error::value("station", "a number from −1 to 1", station));
        }
        let beams = self.solve.system.beams();
        let beam = beams.get(element).ok_or_else(|| {
            let count = beams.len();
            let message =
                format!("element: expected a beam element id below {count}, got {element}");
            Error::new(ErrorKind::Identifier, message)
        })?;
        Ok(beam)
    }

    /// A quantity at `station` in `[−1, 1]` of a beam element, at `times`; six components of each
    /// time together.
    ///
    /// # Errors
    /// An unknown element, or a station outside it.
    pub fn beam(
        &self,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
        times: &[f64],
    ) -> Result<Vec<f64>> {
        let neighbours = self.neighbours_for(quantity);
        self.beam_beside(&neighbours, element, station, quantity, times)
    }

    /// The same, where it is known which elements follow each other.
    pub(super) fn beam_beside(
        &self,
        neighbours: &Option<Neighbours>,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
        times: &[f64],
    ) -> Result<Vec<f64>> {
        let samples = self.beam_samples(neighbours, element, station, quantity)?;
        Self::finite("beam", self.sample(&samples, times)?)
    }

    fn neighbours_for(&self, quantity: BeamQuantity) -> Option<Neighbours> {
        let wanted = matches!(quantity, BeamQuantity::MeanForce | BeamQuantity::ForceJump);
        wanted.then(|| Neighbours::of(self))
    }

    /// Fourier series of the six components of a quantity at a station of a beam element.
    ///
    /// # Errors
    /// An unknown element, or a station outside it.
    pub fn beam_series(
        &self,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
    ) -> Result<Vec<PeriodicSeries>> {
        let neighbours = self.neighbours_for(quantity);
        self.series(&self.beam_samples(&neighbours, element, station, quantity)?)
    }

    fn beam_samples(
        &self,
        neighbours: &Option<Neighbours>,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
    ) -> Result<Samples> {
        let beam = self.beam_definition(element, station)?;
        let at = |beam: &Beam, station: f64, k: usize| {
            let states = self.states_of(beam, k);
            let motions: Vec<_> = states.iter().map(|s| s.motion).collect();
            let twists: Vec<_> = states.iter().map(|s| s.twist).collect();
            beam.strain_and_stress(station, &motions, &twists)
        };
        let beyond = neighbours.as_ref().and_then(|n| n.beyond(element, station));
        let other = beyond.map(|(other, after)| (&self.solve.system.beams()[other], after));
        self.samples_of(6, |k| {
            let (strain, force) = at(beam, station, k)?;
            let other = match other {
                Some((beam, after)) => Some((at(beam, -station, k)?.1, after)),
                None => None,
            };
            let found = match (quantity, other) {
                (BeamQuantity::Strain, _) => strain,
                (BeamQuantity::MeanForce, Some((other, _))) => (force + other) * 0.5,
                (BeamQuantity::ForceJump, Some((other, true))) => other - force,
                (BeamQuantity::ForceJump, Some((other, false))) => force - other,
                (BeamQuantity::ForceJump, None) => Vector6::zeros(),
                (BeamQuantity::Force | BeamQuantity::MeanForce, _) => force,
            };
            Ok(found.as_slice().to_vec())
        })
    }
}
