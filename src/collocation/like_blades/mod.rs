//! Unknowns that are left of a rotor of like blades (docs/theory.md, section 8.10): those of one
//! blade over the period, and of hub and supports over the `B`-th part of it.

mod alike;
mod check;
mod leaders;
mod one;

pub use alike::AlikeMotions;
pub use check::require_like_blades;
pub use leaders::Leaders;
pub use one::OneBlade;

use super::problem::Collocation;
use super::state::GridState;
use crate::fourier::TimeGrid;
use crate::motion::Motion;
use crate::system::{Layout, Placed, Symmetry, System};
use nalgebra::{DMatrix, Matrix6, Vector6};

/// What carries differs from nothing by rounding only.
const SAME: f64 = 1e-13;

/// Where the unknowns of a node, or of an element, are among those that are left, for one part of
/// the period after the other.
#[derive(Debug, Clone)]
pub struct Follower<T> {
    /// The node, or element, that it follows; it may be itself.
    pub leader: usize,
    /// For each of its `B` parts of the period: the leader's part, and what carries that there;
    /// none where it is the same.
    pub parts: Vec<(usize, Option<T>)>,
}

/// What carries increments of a node's motion, and the motion itself.
#[derive(Debug, Clone)]
pub struct Carry {
    /// `M = M_leader Z`.
    pub motion: Motion,
    /// Of scaled increments: `Ad(Z⁻¹)`.
    pub increment: Matrix6<f64>,
}

/// `Ad(C)` for scaled increments.
pub(crate) fn scaled_adjoint(motion: &Motion, length: f64) -> Matrix6<f64> {
    let scale = |i: usize| if i < 3 { length } else { 1.0 };
    let adjoint = motion.adjoint();
    Matrix6::from_fn(|i, j| adjoint[(i, j)] * scale(j) / scale(i))
}

/// The unknowns that are left, in order: for each leading node the increments of its motion at one
/// grid point of its parts after the other, then the own unknowns of each leading element.
///
/// With `E` that carries them to all unknowns, the equations that are left are `Eᵀ J E / B`: rows
/// of leaders alone, as all their followers have the same.
#[derive(Debug, Clone)]
pub struct LikeBlades {
    /// Number of blades.
    pub blades: usize,
    /// Grid points of a part of the period.
    pub part: usize,
    /// Each node.
    pub nodes: Vec<Follower<Carry>>,
    /// Each element.
    pub elements: Vec<Follower<DMatrix<f64>>>,
    /// First unknown of each leading node and element, and how many parts of the period it has.
    pub node_places: Vec<Option<(usize, usize)>>,
    /// Likewise.
    pub element_places: Vec<Option<(usize, usize)>>,
    motions: usize,
    size: usize,
}

impl LikeBlades {
    /// On a grid of so many points, a multiple of the number of blades. `carries` are those of the
    /// own unknowns of each element to its image, scaled; none where they are the same.
    fn new(
        system: &System,
        symmetry: &Symmetry,
        points: usize,
        carries: &[Option<DMatrix<f64>>],
    ) -> Self {
        let blades = symmetry.blades;
        let nodes = followers(&symmetry.nodes, blades, |chain, back| {
            let forth = chain.iter().map(|&node| symmetry.carries[node]);
            let forth = forth.fold(Motion::identity(), |sum, c| sum.compose(&c));
            let once = symmetry.carries[chain.first().copied().unwrap_or(back.0)].inverse();
            let motion = (0..back.1).fold(Motion::identity(), |sum, _| sum.compose(&once));
            let motion = motion.compose(&forth);
            let increment = scaled_adjoint(&motion.inverse(), system.scales().length);
            let is_same = (increment - Matrix6::identity()).amax() < SAME;
            (!is_same).then_some(Carry { motion, increment })
        });
        let elements = followers(&symmetry.elements, blades, |chain, (leader, turns)| {
            let count = system.elements()[leader].element.own_unknowns();
            if count == 0 {
                return None;
            }
            let identity = DMatrix::<f64>::identity(count, count);
            let carry =
                |element: usize| carries[element].clone().unwrap_or_else(|| identity.clone());
            let forth = chain
                .iter()
                .fold(identity.clone(), |sum, &e| carry(e) * sum);
            let once = carry(leader)
                .try_inverse()
                .unwrap_or_else(|| identity.clone());
            let carry = (0..turns).fold(forth, |sum, _| sum * &once);
            let is_same = (&carry - &identity).amax() < SAME;
            (!is_same).then_some(carry)
        });
        let part = points / blades;
        let mut size = 0;
        let mut place = |index: usize, leader: usize, own_image: bool, count: usize| {
            (index == leader).then(|| {
                let (first, parts) = (size, if own_image { 1 } else { blades });
                size += count * parts * part;
                (first, parts)
            })
        };
        let node_places = (nodes.iter().enumerate())
            .map(|(i, node)| place(i, node.leader, symmetry.nodes[i] == i, 6))
            .collect();
        let motions = (nodes.iter().enumerate())
            .filter(|(i, node)| node.leader == *i)
            .map(|(i, _)| if symmetry.nodes[i] == i { 1 } else { blades })
            .sum::<usize>()
            * 6
            * part;
        let element_places = (elements.iter().enumerate())
            .map(|(i, element)| {
                let count = system.elements()[i].element.own_unknowns();
                place(i, element.leader, symmetry.elements[i] == i, count)
            })
            .collect();
        LikeBlades {
            blades,
            part,
            nodes,
            elements,
            node_places,
            element_places,
            motions,
            size,
        }
    }

    /// The blade of a node, from that which leads on; none of hub and supports.
    pub fn blade(&self, node: usize) -> Option<usize> {
        match &self.nodes[node].parts[..] {
            [(first, _), (second, _), ..] if first != second => Some(*first),
            _ => None,
        }
    }

    /// Those of equations that are sampled on an even grid of as many points for each blade; none
    /// of others, or if blades are not alike.
    pub fn of(equations: &Collocation) -> Option<Self> {
        let is_even = equations.rule().over_grid()?.slopes.is_empty();
        let fits = is_even && equations.oversampled().is_none();
        let left = Self::on(equations.system(), equations.grid());
        left.filter(|_| fits)
    }

    /// Those on a grid, likewise.
    pub fn on(system: &System, grid: TimeGrid) -> Option<Self> {
        let symmetry = system.symmetry()?;
        let points = grid.points();
        let fits = points > 1 && points.is_multiple_of(symmetry.blades);
        if !fits || !grid.map().is_identity() {
            return None;
        }
        let carries = symmetry.carries_of_own.get()?.as_ref()?;
        Some(Self::new(system, symmetry, points, carries))
    }

    /// Number of those that are motions: the first.
    pub fn motions(&self) -> usize {
        self.motions
    }

    /// Number of unknowns that are left.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Where the increments of a node at grid point `k` of the whole period are: the first of those
    /// that are left, and what carries them there.
    pub fn node_at(&self, node: usize, k: usize) -> (usize, Option<&Matrix6<f64>>) {
        let follower = &self.nodes[node];
        let (part, carry) = &follower.parts[k / self.part];
        let (first, _) = self.node_places[follower.leader].unwrap_or_default();
        let point = part * self.part + k % self.part;
        (first + 6 * point, carry.as_ref().map(|c| &c.increment))
    }

    /// The same of an element's own unknowns, `count` of them.
    pub fn element_at(
        &self,
        element: usize,
        count: usize,
        k: usize,
    ) -> (usize, Option<&DMatrix<f64>>) {
        let follower = &self.elements[element];
        let (part, carry) = &follower.parts[k / self.part];
        let (first, _) = self.element_places[follower.leader].unwrap_or_default();
        let point = part * self.part + k % self.part;
        (first + count * point, carry.as_ref())
    }

    /// The mean of what the followers of each leader have for its equations, and what tells these
    /// apart: zero where there is nothing.
    pub(crate) fn gathered(&self, system: &System, layout: Layout, all: &[f64]) -> [Vec<f64>; 2] {
        let points = layout.points();
        let weights = self.weights();
        let mut sums = [vec![0.0; self.size], vec![0.0; self.size]];
        let mut add = |at: usize, part: usize, row: f64| {
            sums[0][at] += row / self.blades as f64;
            sums[1][at] += row * weights[part];
        };
        for node in 0..self.nodes.len() {
            for k in 0..points {
                let (first, carry) = self.node_at(node, k);
                let rows = Vector6::from_column_slice(&all[layout.motion(node, k)]);
                let rows = carry.map_or(rows, |carry| carry.tr_mul(&rows));
                let rows = rows.iter().enumerate();
                rows.for_each(|(i, row)| add(first + i, k / self.part, *row));
            }
        }
        for (index, placed) in system.elements().iter().enumerate() {
            let count = placed.element.own_unknowns();
            for k in 0..if count > 0 { points } else { 0 } {
                let (first, carry) = self.element_at(index, count, k);
                let rows = &all[layout.element_at(placed, k)];
                for i in 0..count {
                    let row = match carry {
                        Some(carry) => carry.column(i).iter().zip(rows).map(|(c, x)| c * x).sum(),
                        None => rows[i],
                    };
                    add(first + i, k / self.part, row);
                }
            }
        }
        sums
    }

    /// Weights of the parts of the period whose sum is zero, without structure: what differs from
    /// part to part in an orderly way does not cancel.
    fn weights(&self) -> Vec<f64> {
        let spread = |q: usize| (0.618_033_988_75 * (q + 1) as f64).fract();
        let mean = (0..self.blades).map(spread).sum::<f64>() / self.blades as f64;
        (0..self.blades).map(|q| spread(q) - mean).collect()
    }

    /// `E`: writes all unknowns from those that are left.
    pub fn scatter(&self, system: &System, layout: Layout, left: &[f64], all: &mut [f64]) {
        let points = layout.points();
        for node in 0..self.nodes.len() {
            for k in 0..points {
                let (first, carry) = self.node_at(node, k);
                let x = Vector6::from_column_slice(&left[first..][..6]);
                let x = carry.map_or(x, |carry| carry * x);
                all[layout.motion(node, k)].copy_from_slice(x.as_slice());
            }
        }
        for (index, placed) in system.elements().iter().enumerate() {
            let count = placed.element.own_unknowns();
            for k in 0..if count > 0 { points } else { 0 } {
                let (first, carry) = self.element_at(index, count, k);
                let x = &left[first..][..count];
                let out = &mut all[layout.element_at(placed, k)];
                match carry {
                    Some(carry) => {
                        for (i, out) in out.iter_mut().enumerate() {
                            *out = carry.row(i).iter().zip(x).map(|(c, x)| c * x).sum();
                        }
                    }
                    None => out.copy_from_slice(x),
                }
            }
        }
    }

    /// Grid points, from the first on, at which each element matters to what is left.
    pub fn wanted(&self, system: &System) -> Vec<usize> {
        let of_element = |(index, placed): (usize, &Placed)| {
            let of_nodes = placed.element.nodes().iter();
            let places = of_nodes.map(|&node| self.node_places[node]);
            // Those without own unknowns have no equations of their own.
            let own = self.element_places[index].filter(|_| placed.element.own_unknowns() > 0);
            let places = places.chain([own]).flatten();
            let parts = places.map(|(_, parts)| parts).max();
            parts.unwrap_or(0) * self.part
        };
        system
            .elements()
            .iter()
            .enumerate()
            .map(of_element)
            .collect()
    }

    /// Completes a state of which the first part of the period is known.
    pub fn complete(&self, system: &System, column_scale: &[f64], state: &mut GridState) {
        let points = state.points();
        let first = state.clone();
        for (node, follower) in self.nodes.iter().enumerate() {
            let (part, carry) = &follower.parts[0];
            let back = carry.as_ref().map(|carry| carry.motion.inverse());
            for k in 0..self.part {
                let there = first.node(node)[k];
                let of_leader = back.map_or(there, |back| there.compose(&back));
                state.motions[follower.leader * points + part * self.part + k] = of_leader;
            }
        }
        let layout = system.layout(points);
        for (follower, placed) in self.elements.iter().zip(system.elements()) {
            if placed.element.own_unknowns() == 0 {
                continue;
            }
            let (part, carry) = &follower.parts[0];
            let leader = &system.elements()[follower.leader];
            let back = carry.as_ref().and_then(|carry| carry.clone().try_inverse());
            for k in 0..self.part {
                let to = part * self.part + k;
                let here = &column_scale[layout.element_at(placed, k)];
                let there = &column_scale[layout.element_at(leader, to)];
                let own = state.own_of_mut(leader, to);
                carried(back.as_ref(), (first.own_of(placed, k), here), (own, there));
            }
        }
        self.make_alike(system, column_scale, state);
        state.track_through(system);
    }

    /// Lets all follow their leaders in a state, but for internal states that gain in a period.
    pub fn make_alike(&self, system: &System, column_scale: &[f64], state: &mut GridState) {
        let points = state.points();
        let layout = system.layout(points);
        let leaders = state.clone();
        self.make_motions_alike(&leaders, &mut state.motions);
        for (index, placed) in system.elements().iter().enumerate() {
            let count = placed.element.own_unknowns();
            if count == 0 || (0..count).any(|row| leaders.gain(system, placed, row) != 0.0) {
                continue;
            }
            let follower = &self.elements[index];
            let leader = &system.elements()[follower.leader];
            for k in 0..points {
                let (part, carry) = &follower.parts[k / self.part];
                let from = part * self.part + k % self.part;
                let here = &column_scale[layout.element_at(placed, k)];
                let there = &column_scale[layout.element_at(leader, from)];
                let own = state.own_of_mut(placed, k);
                carried(
                    carry.as_ref(),
                    (leaders.own_of(leader, from), there),
                    (own, here),
                );
            }
        }
        state.track(system);
    }

    /// Whether an element leads.
    pub fn leads(&self, element: usize) -> bool {
        self.elements[element].leader == element
    }

    /// How far blades are from moving alike in a state, turns or relative to this length.
    pub fn apart(&self, state: &GridState, length: f64) -> f64 {
        let mut alike = state.clone();
        self.make_motions_alike(state, &mut alike.motions);
        state.distance(&alike, length)
    }

    /// Writes motions that follow those of the leaders in a state.
    fn make_motions_alike(&self, leaders: &GridState, motions: &mut [Motion]) {
        let points = leaders.points();
        for (node, follower) in self.nodes.iter().enumerate() {
            let motions = &mut motions[node * points..][..points];
            for (k, motion) in motions.iter_mut().enumerate() {
                let (part, carry) = &follower.parts[k / self.part];
                let there = leaders.node(follower.leader)[part * self.part + k % self.part];
                *motion = match carry {
                    Some(carry) => there.compose(&carry.motion),
                    None => there,
                };
            }
        }
    }
}

/// Writes own unknowns from others, both with their scales.
fn carried(
    carry: Option<&DMatrix<f64>>,
    (from, of_from): (&[f64], &[f64]),
    (to, of_to): (&mut [f64], &[f64]),
) {
    let Some(carry) = carry else {
        to.copy_from_slice(from);
        return;
    };
    for (i, (to, scale)) in to.iter_mut().zip(of_to).enumerate() {
        let scaled = from.iter().zip(of_from).map(|(x, s)| x / s);
        let sum: f64 = carry.row(i).iter().zip(scaled).map(|(c, x)| c * x).sum();
        *to = sum * scale;
    }
}

/// What follows what, from the image of each, `blades` times in a period. `carry` is asked for what
/// carries the unknowns of a leader along a chain of images, after they were carried back so many
/// times from its own image.
fn followers<T: Clone>(
    images: &[usize],
    blades: usize,
    carry: impl Fn(&[usize], (usize, usize)) -> Option<T>,
) -> Vec<Follower<T>> {
    let mut found: Vec<Option<Follower<T>>> = images.iter().map(|_| None).collect();
    for leader in 0..images.len() {
        if found[leader].is_some() {
            continue;
        }
        let mut chain = Vec::new();
        let mut at = leader;
        for shift in 0..blades {
            if shift > 0 && at == leader {
                break;
            }
            let parts = match images[leader] == leader {
                // Its own image: all parts are the first one, carried back.
                true => (0..blades).map(|q| (0, carry(&[], (leader, q)))).collect(),
                false => {
                    let carried = carry(&chain, (leader, 0));
                    let part = |q: usize| ((q + shift) % blades, carried.clone());
                    (0..blades).map(part).collect()
                }
            };
            found[at] = Some(Follower { leader, parts });
            chain.push(at);
            at = images[at];
        }
    }
    found.into_iter().flatten().collect()
}
