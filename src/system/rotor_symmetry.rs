//! Which nodes and elements follow which, in a rotor of blades that are alike (docs/theory.md,
//! section 8.10).

use super::{ElementRole, System};
use crate::error::{Error, ErrorKind, Result};
use crate::model::RotorSymmetry;
use crate::motion::{Motion, rotation_from_vector};
use nalgebra::{DMatrix, Vector3};
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// How far a node may be from where the blade before it puts it, relative to the size of the model.
const SAME_PLACE: f64 = 1e-8;

/// What a `B`-th of the period makes of a rotor of `B` blades: the motion of node `a` at the time
/// `t + T/B`, carried by `C_a`, is that of its image at `t`,
///
/// ```text
/// M_σ(a)(t) = M_a(t + T/B) C_a
/// ```
///
/// where `C_a` is what the reference configuration says: `X_a⁻¹ R⁻¹ X_σ(a)` with the turn `R` by
/// `2π/B` of blades and hub, and the identity of all else, which is its own image.
#[derive(Debug, Clone)]
pub struct Symmetry {
    /// Number of blades.
    pub blades: usize,
    /// The image of each node.
    pub nodes: Vec<usize>,
    /// What carries the motion of each node to its image.
    pub carries: Vec<Motion>,
    /// The image of each element that has own unknowns.
    pub elements: Vec<usize>,
    /// Direction and a point of the axis.
    axis: [Vector3<f64>; 2],
    /// What carries the own unknowns of each element to its image, scaled, none where they are the
    /// same; once the elements were seen to be alike, and if all of them are understood.
    pub(crate) carries_of_own: OnceLock<Option<Vec<Option<DMatrix<f64>>>>>,
}

impl Symmetry {
    /// That of a system whose nodes and elements are all there.
    ///
    /// # Errors
    /// If the next blade is somewhere else, or what has own unknowns is not there at each blade.
    pub(super) fn new(system: &System, rotor: &RotorSymmetry) -> Result<Self> {
        if system.turning.is_some() {
            return Err(refused(
                "it is described in a frame that turns, in which blades do not pass each other's \
                 places",
            ));
        }
        let blades = rotor.blades().len();
        let axis = [rotor.axis(), rotor.point()];
        let turn = turn(axis, 1.0 / blades as f64);
        let mut nodes: Vec<usize> = (0..system.nodes()).collect();
        let mut carries = vec![Motion::identity(); system.nodes()];
        let mut carry = |node: usize, image: usize| {
            nodes[node] = image;
            let there = turn.compose(&system.reference[node]);
            carries[node] = there.relative(&system.reference[image]);
            (there.position - system.reference[image].position).amax()
        };
        let length = system.scales.length;
        rotor.hub().iter().for_each(|&node| {
            carry(node, node);
        });
        for (j, blade) in rotor.blades().iter().enumerate() {
            let next = &rotor.blades()[(j + 1) % blades];
            for (&node, &image) in blade.iter().zip(next) {
                let off = carry(node, image);
                if off > SAME_PLACE * length {
                    return Err(refused(&format!(
                        "node {image} of blade {} is {off:.3e} from where node {node} of blade \
                         {j} gets to by a turn of 1/{blades} about the axis; blades have to \
                         follow each other in the sense of the turn",
                        (j + 1) % blades
                    )));
                }
            }
        }
        let elements = images(system, &nodes)?;
        Ok(Symmetry {
            blades,
            nodes,
            carries,
            elements,
            axis,
            carries_of_own: OnceLock::new(),
        })
    }

    /// Where a node that is at `reference` is a part `fraction` of the period later, if hub and
    /// blades turn steadily as one body and nothing else moves.
    pub fn turned(&self, node: usize, reference: &Motion, fraction: f64) -> Motion {
        let is_still = self.nodes[node] == node && self.carries[node] == Motion::identity();
        if is_still {
            return *reference;
        }
        turn(self.axis, fraction).compose(reference)
    }
}

/// A part of a whole turn about an axis of this direction through a point.
fn turn([axis, point]: [Vector3<f64>; 2], fraction: f64) -> Motion {
    let rotation = rotation_from_vector(&(axis * (TAU * fraction)));
    Motion::new(rotation, point - rotation * point)
}

impl System {
    /// The least number of at least so many points that like blades can share, or `points` itself
    /// if that is more than `largest`, or there are none. It is odd if the number of blades is.
    pub fn shared_points(&self, points: usize, largest: usize) -> usize {
        let Some(symmetry) = &self.symmetry else {
            return points;
        };
        let least = points.div_ceil(symmetry.blades);
        let parts = least | (symmetry.blades % 2);
        let shared = parts * symmetry.blades;
        if shared <= largest { shared } else { points }
    }

    /// The most of no more than so many points that like blades can share, but `least` at least;
    /// `points` itself if there are none.
    pub fn fewer_shared_points(&self, points: usize, least: usize) -> usize {
        let Some(symmetry) = &self.symmetry else {
            return points;
        };
        let most = points / symmetry.blades;
        let parts = match symmetry.blades % 2 {
            0 => most,
            _ => most.saturating_sub(1 - most % 2),
        };
        least.max(parts * symmetry.blades)
    }
}

/// The image of each element: that of the same kind on the images of its nodes, where there are
/// several in the order in which they were described. Those without own unknowns need none.
fn images(system: &System, nodes: &[usize]) -> Result<Vec<usize>> {
    let mut places: HashMap<_, Vec<usize>> = HashMap::new();
    let key = |index: usize, nodes: Vec<usize>| {
        let placed = &system.elements[index];
        let role = std::mem::discriminant(&placed.role);
        (role, nodes, placed.element.own_unknowns())
    };
    let mut ordinals = Vec::with_capacity(system.elements.len());
    for (index, placed) in system.elements.iter().enumerate() {
        let alike = places
            .entry(key(index, placed.element.nodes().to_vec()))
            .or_default();
        ordinals.push(alike.len());
        alike.push(index);
    }
    let image = |(index, &ordinal): (usize, &usize)| {
        let placed = &system.elements[index];
        if placed.element.own_unknowns() == 0 {
            return Ok(index);
        }
        let at = placed.element.nodes().iter().map(|&node| nodes[node]);
        let alike = places.get(&key(index, at.collect()));
        alike
            .and_then(|alike| alike.get(ordinal).copied())
            .ok_or_else(|| {
                refused(&format!(
                    "{} has no like at the next blade, on the nodes that follow its own in the \
                     same order",
                    describe(placed.role)
                ))
            })
    };
    ordinals.iter().enumerate().map(image).collect()
}

/// What an element stands for.
pub(crate) fn describe(role: ElementRole) -> String {
    match role {
        ElementRole::Inertia => "an inertia".into(),
        ElementRole::Beam(index) => format!("beam element {index}"),
        ElementRole::Shell(index) => format!("shell element {index}"),
        ElementRole::Joint(index) => format!("joint {index}"),
        ElementRole::Prescribed(index) => format!("prescribed coordinate {index}"),
        ElementRole::Force(index) => format!("force {index}"),
        ElementRole::Relation(index) => format!("relation {index}"),
        ElementRole::Load => "a load".into(),
        ElementRole::MassDamping => "mass damping".into(),
    }
}

/// That the model is none of like blades, and why.
pub(crate) fn refused(why: &str) -> Error {
    let message = format!("model: its blades are said to be alike (rotor symmetry), but {why}");
    Error::new(ErrorKind::Model, message)
}
