//! Parts that hang on drives which turn on and on: a rotor on its shaft, a blade behind a hub.
//! See docs/theory.md, section 9.3.

use super::{ElementRole, Placed, System};
use crate::elements::{Attachment, Coordinate, Element, Joint, Measure, NodeState};
use crate::error::Result;
use crate::model::BoundSignal;
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
    pub joint: usize,
    pub coordinate: Coordinate,
    /// The signal that it follows.
    pub signal: usize,
}

/// What hangs on one drive.
#[derive(Debug, Clone)]
struct Part {
    drive: Drive,
    /// Angle of the drive in the reference configuration.
    start: f64,
    /// Rate of the drive.
    rate: f64,
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
        parts.map(|part| part.unit * part.rate).sum()
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
        self.carried_by(node, motion, |part| signals[part.drive.signal] - part.start)
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
        self.carried_by(node, motion, |part| {
            to[part.drive.signal] - from[part.drive.signal]
        })
    }

    fn carried_by(&self, node: usize, motion: &Motion, angle: impl Fn(&Part) -> f64) -> Motion {
        let parts = self.parts.iter().filter(|part| part.hangs[node]);
        turned(motion, &parts.map(|part| part.unit * angle(part)).sum())
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
    /// the ground.
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
        for drive in &self.drives {
            let rate = rate_of(drive)?;
            let Some(unit) = self.unit_twist(drive).filter(|_| rate != 0.0) else {
                continue;
            };
            let (first, second) = self.joints[drive.joint].attachments();
            let with_side = |side: Attachment, other: Attachment, sign: f64| {
                let hangs = self.hangs_on(side.node?, drive.joint);
                if other.node.is_some_and(|node| hangs[node]) {
                    return None;
                }
                let mut with = driven.clone();
                with.parts.push(Part {
                    drive: *drive,
                    start: self.signals[drive.signal].start,
                    rate,
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
                Some(best) => driven = best,
                None => driven.rigid = false,
            }
        }
        Ok((!driven.parts.is_empty()).then_some(driven))
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
    fn unit_twist(&self, drive: &Drive) -> Option<Vector6<f64>> {
        let joint = &self.joints[drive.joint];
        let states = self.reference_states(joint);
        let (kind, z) = (joint.kind(), joint.relative_motion(&states));
        let mut gradients = Matrix6::zeros();
        let mut rates = Vector6::zeros();
        let constraints = (0..kind.constraints()).map(|row| (kind.constraint(row, &z), 0.0));
        let coordinates = kind.coordinates().iter().map(|&which| {
            let rate = if which == drive.coordinate { 1.0 } else { 0.0 };
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

    /// Whether neither joints' constraints nor relations change as everything turns.
    fn may_turn(&self, driven: &Driven) -> bool {
        let rates = driven.parts.iter().map(|part| part.rate.abs());
        let turn = TAU / rates.fold(f64::MIN_POSITIVE, f64::max);
        if !self.relations_allow(|node| driven.twist(node)) {
            return false;
        }
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
