//! Parts that hang on drives which turn on and on: a rotor on its shaft, a blade behind a hub.
//! See docs/theory.md, section 9.3.

use super::{ElementRole, Placed, PlacedRelation, System};
use crate::elements::{Attachment, Coordinate, Element, Joint, Measure, NodeState};
use crate::error::Result;
use crate::model::{BoundSignal, JointCoordinate};
use crate::motion::Motion;
use nalgebra::{Matrix6, Vector6};
use std::f64::consts::TAU;

/// Change of a joint's constraints, relative to the size of the mechanism or in radians, that parts
/// which turn as one rigid body may leave to rounding.
const STILL_CLOSED: f64 = 1e-6;
/// Change of a drive, relative to its value, that is one of rounding.
const ROUNDING: f64 = 1e-13;
/// Parts of a turn at which that is looked at: of no common fraction.
const LOOKED_AT: [f64; 3] = [0.13, 0.41, 0.77];

/// A prescribed joint coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drive {
    pub coordinate: Coordinate,
    /// The signal that it follows.
    pub signal: usize,
}

/// An angle that signals determine: the sum of their values times factors.
#[derive(Debug, Clone)]
struct Turning {
    joint: usize,
    coordinate: Coordinate,
    /// Signals, each with its factor and its value in the reference configuration.
    signals: Vec<(usize, f64, f64)>,
    rate: f64,
}

/// What hangs on one drive, or on an angle that drives turn by relations.
#[derive(Debug, Clone)]
struct Part {
    by: Turning,
    /// Twist about the origin, resolved in space, for a unit rate.
    unit: Vector6<f64>,
    /// Which nodes hang on it.
    hangs: Vec<bool>,
}

/// Rotation of all that hangs on drives, see [`System::driven`].
#[derive(Debug, Clone)]
pub struct Driven {
    parts: Vec<Part>,
    /// Whether the joints let everything turn so for ever.
    rigid: bool,
}

impl Driven {
    /// Whether the joints let everything turn for ever as one rigid body for each drive.
    pub fn is_rigid(&self) -> bool {
        self.rigid
    }

    /// Twist of a node about the origin, resolved in space, in steady rotation; zero of what does
    /// not turn.
    pub fn twist(&self, node: usize) -> Vector6<f64> {
        let parts = self.parts.iter().filter(|part| part.hangs[node]);
        parts.map(|part| part.unit * part.by.rate).sum()
    }

    /// Twists of all nodes, times `factor`.
    pub fn twists(&self, factor: f64) -> Vec<Vector6<f64>> {
        let nodes = self.parts.first().map_or(0, |part| part.hangs.len());
        (0..nodes).map(|node| self.twist(node) * factor).collect()
    }

    /// `motion` of a node after this time of steady rotation.
    pub fn moved(&self, node: usize, motion: &Motion, time: f64) -> Motion {
        turned(motion, &(self.twist(node) * time))
    }

    /// Reference `motion` of a node carried to where the drives are, given the values of all
    /// signals.
    pub fn carried(&self, node: usize, motion: &Motion, signals: &[f64]) -> Motion {
        self.carried_by(node, motion, |by| {
            let each = by.signals.iter();
            each.map(|(s, factor, start)| factor * (signals[*s] - start))
                .sum()
        })
    }

    /// `motion` of a node carried from where the drives are with one set of values of all signals
    /// to where they are with another.
    pub fn carried_between(
        &self,
        node: usize,
        motion: &Motion,
        from: &[f64],
        to: &[f64],
    ) -> Motion {
        self.carried_by(node, motion, |by| {
            let each = by.signals.iter();
            each.map(|(s, factor, _)| factor * (to[*s] - from[*s]))
                .sum()
        })
    }

    fn carried_by(&self, node: usize, motion: &Motion, angle: impl Fn(&Turning) -> f64) -> Motion {
        let parts = self.parts.iter().filter(|part| part.hangs[node]);
        turned(motion, &parts.map(|part| part.unit * angle(&part.by)).sum())
    }
}

/// A motion after another one with this logarithm, in space.
fn turned(motion: &Motion, step: &Vector6<f64>) -> Motion {
    let step = motion.inverse().adjoint() * step;
    motion.increment(&step).renormalised()
}

impl System {
    /// What would turn if all that hangs on a drive were one rigid body; none without drives.
    ///
    /// A drive is a joint coordinate whose prescribed angle gains whole turns in a period, or grows
    /// in a march. What hangs on it is connected to it by joints and beams otherwise than through
    /// the ground. So it is with angles that drives turn by relations.
    ///
    /// # Errors
    /// Those of signals.
    pub fn driven(&self) -> Result<Option<Driven>> {
        self.driven_with(|drive| self.mean_rate(drive.signal))
    }

    /// The same with the rates that drives have at the start of a march, as differences over so
    /// short a time tell.
    ///
    /// # Errors
    /// Those of signals.
    pub fn driven_at(&self, time: f64, short: f64) -> Result<Option<Driven>> {
        let mut values =
            [0.0, 0.5, 1.0].map(|part| (time + part * short, vec![0.0; self.signals()]));
        for (time, values) in &mut values {
            self.signal_values(*time, 1.0, values)?;
        }
        let [(_, start), (_, middle), (_, end)] = values;
        self.driven_with(|drive| {
            let s = drive.signal;
            let is_known = self.regime.knows_period();
            let turns = match self.signals[s].signal {
                // Whether it goes on and on is not known.
                BoundSignal::Function(_) if !is_known => {
                    drive.coordinate.measure() == Measure::Angle
                }
                _ => self.mean_rate(s)? != 0.0,
            };
            let change = 4.0 * (middle[s] - start[s]) - (end[s] - start[s]);
            let moves = turns && change.abs() > ROUNDING * start[s].abs();
            Ok(if moves { change / short } else { 0.0 })
        })
    }

    fn driven_with(&self, rate_of: impl Fn(&Drive) -> Result<f64>) -> Result<Option<Driven>> {
        let mut driven = Driven {
            parts: Vec::new(),
            rigid: true,
        };
        let mut known = Vec::new();
        for (signal, at) in self.prescribed.iter().enumerate() {
            let drive = self.drives.iter().find(|drive| drive.signal == signal);
            known.push(Turning {
                joint: at.joint,
                coordinate: at.coordinate,
                signals: vec![(signal, 1.0, self.signals[signal].start)],
                rate: drive.map_or(Ok(0.0), &rate_of)?,
            });
        }
        self.follow_relations(&mut known);
        for by in known.into_iter().filter(|by| by.rate != 0.0) {
            self.add_part(by, &mut driven);
        }
        driven.rigid &= self.relations_allow(|node| driven.twist(node));
        Ok((!driven.parts.is_empty()).then_some(driven))
    }

    /// Adds angles that relations determine by those that are known.
    fn follow_relations(&self, known: &mut Vec<Turning>) {
        let mut open: Vec<&PlacedRelation> = self.relations.iter().collect();
        loop {
            let before = open.len();
            open.retain(|relation| match self.followed(relation, known) {
                Some(by) => {
                    known.push(by);
                    false
                }
                None => true,
            });
            if open.len() == before {
                return;
            }
        }
    }

    /// The angle of a relation that is the only one of its coordinates not to be known.
    fn followed(&self, relation: &PlacedRelation, known: &[Turning]) -> Option<Turning> {
        let of = |at: &JointCoordinate| {
            let mut all = known.iter();
            all.find(|by| by.joint == at.joint && by.coordinate == at.coordinate)
        };
        let mut unknown = relation.terms.iter().filter(|(at, _)| of(at).is_none());
        let (at, own) = unknown.next()?;
        let turns = self.joints[at.joint]
            .kind()
            .leaves_turns_open(at.coordinate);
        if !turns || unknown.next().is_some() {
            return None;
        }
        let start = self.signals[relation.signal].start;
        let mut by = Turning {
            joint: at.joint,
            coordinate: at.coordinate,
            signals: vec![(relation.signal, relation.factor / own, start)],
            rate: 0.0,
        };
        for (other, b) in &relation.terms {
            let factor = -b / own;
            let Some(turning) = of(other) else { continue };
            by.rate += factor * turning.rate;
            let signals = turning.signals.iter();
            by.signals
                .extend(signals.map(|(s, f, start)| (*s, f * factor, *start)));
        }
        Some(by)
    }

    /// Adds what hangs on an angle that turns; without it all is not rigid.
    fn add_part(&self, by: Turning, driven: &mut Driven) {
        let Some(unit) = self.unit_twist(by.joint, by.coordinate) else {
            return;
        };
        let (first, second) = self.joints[by.joint].attachments();
        let with_side = |side: Attachment, other: Attachment, sign: f64| {
            let hangs = self.hangs_on(side.node?, by.joint);
            if other.node.is_some_and(|node| hangs[node]) {
                return None;
            }
            let mut with = driven.clone();
            with.parts.push(Part {
                by: by.clone(),
                unit: unit * sign,
                hangs,
            });
            with.rigid &= self.may_turn(&with);
            Some(with)
        };
        // Of equals the second body turns.
        let sides = [
            with_side(first, second, -1.0),
            with_side(second, first, 1.0),
        ];
        let best = sides.into_iter().flatten().max_by_key(|with| with.rigid);
        match best {
            Some(best) => *driven = best,
            None => driven.rigid = false,
        }
    }

    /// Whether prescribed angles gain whole turns in a period.
    ///
    /// # Errors
    /// Those of functions of the user.
    pub fn gains_turns(&self) -> Result<bool> {
        let half_a_turn = 0.5 * TAU / self.period();
        for drive in &self.drives {
            if self.mean_rate(drive.signal)?.abs() > half_a_turn {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// What a signal gains in a unit of time, in the mean.
    pub(super) fn mean_rate(&self, signal: usize) -> Result<f64> {
        let signal = &self.signals[signal].signal;
        let is_known = self.regime.knows_period();
        Ok(match signal {
            BoundSignal::Series(series) => series.rate,
            BoundSignal::Function(_) if is_known => signal.growth()? / signal.period(),
            BoundSignal::Function(_) => 0.0,
        })
    }

    /// Twist of the second body of a driven joint relative to the first for a unit rate of its
    /// coordinate, all others at rest, in the reference configuration; about the origin, resolved
    /// in space.
    fn unit_twist(&self, joint: usize, coordinate: Coordinate) -> Option<Vector6<f64>> {
        let joint = &self.joints[joint];
        let states = self.reference_states(joint);
        let (kind, z) = (joint.kind(), joint.relative_motion(&states));
        let mut gradients = Matrix6::zeros();
        let mut rates = Vector6::zeros();
        let constraints = (0..kind.constraints()).map(|row| (kind.constraint(row, &z), 0.0));
        let coordinates = kind.coordinates().iter().map(|&which| {
            let rate = if which == coordinate { 1.0 } else { 0.0 };
            (kind.coordinate(which, &z), rate)
        });
        for (row, (function, rate)) in constraints.chain(coordinates).take(6).enumerate() {
            gradients.set_row(row, &function.gradient.transpose());
            rates[row] = rate;
        }
        let twist = gradients.try_inverse()? * rates;
        let twist = joint.second_frame(&states).adjoint() * twist;
        twist.iter().all(|x| x.is_finite()).then_some(twist)
    }

    fn reference_states(&self, joint: &Joint) -> Vec<NodeState> {
        let nodes = joint.nodes().iter();
        nodes
            .map(|&node| NodeState::at_rest(self.reference[node]))
            .collect()
    }

    /// Which nodes are connected to `start` otherwise than by the joint `without`, or through the
    /// ground.
    fn hangs_on(&self, start: usize, without: usize) -> Vec<bool> {
        let mut hangs = vec![false; self.nodes()];
        hangs[start] = true;
        let connects = |placed: &&Placed| match placed.role {
            ElementRole::Beam(_) | ElementRole::Shell(_) => true,
            ElementRole::Joint(joint) => joint != without,
            _ => false,
        };
        let connecting: Vec<&[usize]> = (self.elements.iter().filter(connects))
            .map(|placed| placed.element.nodes())
            .collect();
        let mut of_node = vec![Vec::new(); self.nodes()];
        for (index, nodes) in connecting.iter().enumerate() {
            nodes.iter().for_each(|&node| of_node[node].push(index));
        }
        let mut open = vec![start];
        while let Some(node) = open.pop() {
            for &index in &of_node[node] {
                for &next in connecting[index] {
                    if !hangs[next] {
                        hangs[next] = true;
                        open.push(next);
                    }
                }
            }
        }
        hangs
    }

    /// Whether no joint's constraints change as everything turns.
    fn may_turn(&self, driven: &Driven) -> bool {
        let rates = driven.parts.iter().map(|part| part.by.rate.abs());
        let turn = TAU / rates.fold(f64::MIN_POSITIVE, f64::max);
        self.joints.iter().all(|joint| {
            let kind = joint.kind();
            let values = |time: f64| {
                let states: Vec<NodeState> = (joint.nodes().iter())
                    .map(|&node| driven.moved(node, &self.reference[node], time))
                    .map(NodeState::at_rest)
                    .collect();
                let z = joint.relative_motion(&states);
                (0..kind.constraints()).map(move |row| (row, kind.constraint(row, &z).value))
            };
            LOOKED_AT.iter().all(|part| {
                values(0.0).zip(values(part * turn)).all(|(start, now)| {
                    let size = match kind.measure(start.0) {
                        Measure::Length => self.extent().max(f64::MIN_POSITIVE),
                        Measure::Angle => 1.0,
                    };
                    (now.1 - start.1).abs() <= STILL_CLOSED * size
                })
            })
        })
    }
}
