//! A solution as the start for a model whose beams have other meshes.
//! See docs/theory.md, section 9.10.

use super::solution::Solution;
use crate::collocation::GridState;
use crate::elements::{Beam, Element, lobatto_points};
use crate::error::{Error, Result};
use crate::fourier::TimeGrid;
use crate::model::{Model, ShellDefinition};
use crate::motion::Motion;
use crate::system::{ElementRole, Placed, System};
use std::ops::Range;
use std::sync::Arc;

/// Parts of a beam element whose lengths are taken for those of chords.
const PARTS: usize = 16;
/// Ends of beams farther apart than this fraction of the model's size are those of other beams.
const SAME_PLACE: f64 = 1e-6;

/// Elements one after the other, each from the node where the one before it ends.
struct Chain {
    elements: Range<usize>,
    /// Length of the reference line up to each part of each element.
    lengths: Vec<f64>,
}

impl Chain {
    /// The chains of a model, in the order in which their elements were described.
    fn all(beams: &[Arc<Beam>]) -> Result<Vec<Chain>> {
        let follows = |i: usize| beams[i - 1].nodes().last() == beams[i].nodes().first();
        let mut starts: Vec<usize> = (0..beams.len())
            .filter(|&i| i == 0 || !follows(i))
            .collect();
        starts.push(beams.len());
        let ranges = starts.windows(2).map(|pair| pair[0]..pair[1]);
        ranges.map(|elements| Chain::new(beams, elements)).collect()
    }

    fn new(beams: &[Arc<Beam>], elements: Range<usize>) -> Result<Self> {
        let (mut lengths, mut length) = (vec![0.0], 0.0);
        for beam in &beams[elements.clone()] {
            let mut last = beam.section_motion(-1.0, beam.reference())?.position;
            for part in 1..=PARTS {
                let xi = 2.0 * part as f64 / PARTS as f64 - 1.0;
                let next = beam.section_motion(xi, beam.reference())?.position;
                length += (next - last).norm();
                lengths.push(length);
                last = next;
            }
        }
        Ok(Chain { elements, lengths })
    }

    /// Fraction of the chain's length at a place of one of its elements.
    fn fraction(&self, element: usize, xi: f64) -> f64 {
        let parts = 0.5 * (xi + 1.0) * PARTS as f64;
        let part = (parts.floor() as usize).min(PARTS - 1);
        let at = (element - self.elements.start) * PARTS + part;
        let (before, after) = (self.lengths[at], self.lengths[at + 1]);
        let length = before + (parts - part as f64) * (after - before);
        length / self.lengths[self.lengths.len() - 1]
    }

    /// The element, and the place there, at a fraction of the chain's length.
    fn place(&self, fraction: f64) -> (usize, f64) {
        let length = fraction * self.lengths[self.lengths.len() - 1];
        let after = self.lengths.partition_point(|&l| l < length);
        let at = after.clamp(1, self.lengths.len() - 1) - 1;
        let (start, end) = (self.lengths[at], self.lengths[at + 1]);
        let part = (at % PARTS) as f64 + (length - start) / (end - start);
        let xi = (2.0 * part / PARTS as f64 - 1.0).clamp(-1.0, 1.0);
        (self.elements.start + at / PARTS, xi)
    }

    /// Where it begins and ends.
    fn ends(&self, beams: &[Arc<Beam>]) -> [Motion; 2] {
        let first = &beams[self.elements.start];
        let last = &beams[self.elements.end - 1];
        [
            first.reference()[0],
            last.reference()[last.nodes().len() - 1],
        ]
    }
}

/// Where a node of the other model is in this one.
enum Place {
    Node(usize),
    Beam { element: usize, xi: f64 },
}

impl Solution {
    /// This solution at the points of another grid, see [`Solution::prolonged`], as a start for
    /// `model`: the same mechanism, whose beams may have other meshes. Nodes of beams are moved as
    /// the beams are at the same fraction of their length.
    ///
    /// # Errors
    /// If the other model has other joints, forces, prescribed coordinates, beams, or nodes beside
    /// these; [`crate::error::ErrorKind::GridTooCoarse`] if a motion cannot be interpolated.
    pub fn prolonged_to(&self, model: &Model, grid: TimeGrid) -> Result<GridState> {
        self.require_same_mechanism(model)?;
        let state = self.prolonged(grid)?;
        if !self.has_shells_of(model) {
            let expected = "a solution of a model with the same shell elements on the same nodes: \
                            motions are carried between meshes of beams, not of shells";
            return Err(Error::value("options.initial", expected, "one with others"));
        }
        let meshes = |m: &Model| m.beams.iter().map(|b| b.nodes.clone()).collect::<Vec<_>>();
        if self.model.nodes.len() == model.nodes.len() && meshes(&self.model) == meshes(model) {
            return Ok(state);
        }
        let (old, new) = (&self.solve.system, System::new(model, grid.period())?);
        let places = self.places_of(&new)?;
        let points = state.points();
        let mut carried = GridState::at_points(&new, points);
        for (node, (place, reference)) in places.iter().zip(new.reference()).enumerate() {
            for k in 0..points {
                let (was, is) = match *place {
                    Place::Node(node) => (old.reference()[node], state.node(node)[k]),
                    Place::Beam { element, xi } => {
                        let beam = &old.beams()[element];
                        let nodes = beam.nodes().iter();
                        let motions: Vec<Motion> = nodes.map(|&n| state.node(n)[k]).collect();
                        let was = beam.section_motion(xi, beam.reference())?;
                        (was, beam.section_motion(xi, &motions)?)
                    }
                };
                carried.motions[node * points + k] = is.compose(&was.relative(reference));
            }
        }
        // Their whole turns are those of the joints, which are the same.
        carried.coordinates.copy_from_slice(&state.coordinates);
        carried.track(&new);
        for placed in new.elements() {
            let is_same = |other: &&Placed| {
                other.role == placed.role
                    && other.element.own_unknowns() == placed.element.own_unknowns()
            };
            let kept = !matches!(
                placed.role,
                ElementRole::Beam(_)
                    | ElementRole::Shell(_)
                    | ElementRole::Inertia
                    | ElementRole::MassDamping
            );
            if let Some(other) = old.elements().iter().find(is_same).filter(|_| kept) {
                for k in 0..points {
                    let values = state.own_of(other, k);
                    carried.own_of_mut(placed, k).copy_from_slice(values);
                }
            }
        }
        Ok(carried)
    }

    /// Whether the shells of a model have the same elements, with nodes at the same places.
    fn has_shells_of(&self, model: &Model) -> bool {
        let unit = SAME_PLACE * self.solve.system.scales().length;
        let here = |m: &Model, node: usize| m.nodes[node].position;
        let same = |(a, b): (&ShellDefinition, &ShellDefinition)| {
            let mut nodes = a.nodes.iter().zip(&b.nodes);
            let apart =
                |(&a, &b): (&usize, &usize)| (here(&self.model, a) - here(model, b)).norm() > unit;
            a.sides == b.sides && !nodes.any(apart)
        };
        let count = model.shells.len();
        self.model.shells.len() == count && self.model.shells.iter().zip(&model.shells).all(same)
    }

    fn require_same_mechanism(&self, model: &Model) -> Result<()> {
        if self.is_of_mechanism(model) {
            return Ok(());
        }
        let counts = |m: &Model| {
            let [joints, forces] = [m.joints.len(), m.forces.len()];
            let [prescribed, relations] = [m.prescribed.len(), m.relations.len()];
            format!(
                "{joints} joints, {forces} forces, {prescribed} prescribed coordinates and \
                 {relations} relations"
            )
        };
        let expected = "a solution of a model with the same joints, forces, prescribed \
                        coordinates and relations, on the same coordinates";
        let got = format!(
            "one with {}, for a model with {}",
            counts(&self.model),
            counts(model)
        );
        Err(Error::value("options.initial", expected, got))
    }

    /// Where the nodes of a system with other meshes are in this model.
    fn places_of(&self, new: &System) -> Result<Vec<Place>> {
        let old = &self.solve.system;
        let (from, to) = (Chain::all(old.beams())?, Chain::all(new.beams())?);
        let size = old.scales().length;
        let differ = |what: String| {
            let expected =
                "a solution of a model with the same bodies and beams, if in other meshes";
            Err(Error::value("options.initial", expected, what))
        };
        if from.len() != to.len() {
            let got = format!(
                "one with {} beams, for a model with {}",
                from.len(),
                to.len()
            );
            return differ(got);
        }
        let mut places: Vec<Option<Place>> = (0..new.nodes()).map(|_| None).collect();
        for (number, (a, b)) in from.iter().zip(&to).enumerate() {
            let ends = a.ends(old.beams()).into_iter().zip(b.ends(new.beams()));
            for (old_end, new_end) in ends {
                if (old_end.position - new_end.position).norm() > SAME_PLACE * size {
                    return differ(format!("beam {number} from or to another place"));
                }
            }
            for element in b.elements.clone() {
                let beam = &new.beams()[element];
                let points = lobatto_points(beam.nodes().len());
                for (&node, xi) in beam.nodes().iter().zip(points) {
                    let (element, xi) = a.place(b.fraction(element, xi));
                    places[node] = Some(Place::Beam { element, xi });
                }
            }
        }
        let mut on_beam = vec![false; old.nodes()];
        old.beams()
            .iter()
            .flat_map(|beam| beam.nodes())
            .for_each(|&n| on_beam[n] = true);
        let mut others = (0..old.nodes()).filter(|&n| !on_beam[n]);
        let missing = places.iter_mut().filter(|place| place.is_none());
        for place in missing {
            let Some(node) = others.next() else {
                return differ("one with fewer nodes beside its beams".into());
            };
            *place = Some(Place::Node(node));
        }
        if others.next().is_some() {
            return differ("one with more nodes beside its beams".into());
        }
        Ok(places.into_iter().flatten().collect())
    }
}
