//! Joint coordinates, their rates, driving efforts and reactions.

use super::history::History;
use super::samples::Samples;
use super::variation::Variation;
use super::{Dependence, Probe};
use crate::elements::{Coordinate, Element, Joint, NodeState, nearest_turn};
use crate::error::{Error, ErrorKind, Result, require_id};
use crate::fourier::{CardinalWeights, TimeGrid};
use crate::model::JointCoordinate;
use crate::motion::{PeriodicMotion, halves, joined, turned};
use crate::system::{ElementRole, System};
use nalgebra::{Matrix3, Vector3, Vector6};
use std::f64::consts::TAU;

/// Axes that a reaction is resolved in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResolvedIn {
    /// Inertial axes.
    Space,
    /// Axes of the joint frame on the first body.
    First,
    /// Axes of the joint frame on the second body.
    Second,
}

/// What can be asked of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointQuantity {
    /// Relative displacement, or angle, followed continuously through whole turns.
    Coordinate(Coordinate),
    /// Its first derivative in time.
    Rate(Coordinate),
    /// Its second derivative in time.
    Acceleration(Coordinate),
    /// Force or torque that drives a prescribed coordinate, positive towards its growth.
    DrivingEffort(Coordinate),
    /// Force and moment of the joint's constraints on the second body, about its joint frame.
    Reaction(ResolvedIn),
}

impl JointQuantity {
    /// Number of components.
    pub fn components(self) -> usize {
        match self {
            JointQuantity::Reaction(_) => 6,
            _ => 1,
        }
    }

    pub(super) fn probe(self, system: &System, joint: usize) -> Result<Box<dyn Probe>> {
        require_id("joint", "joint", system.joints().len(), joint)?;
        let kind = system.joints()[joint].kind();
        let at = |coordinate| -> Result<JointCoordinate> {
            kind.require_coordinate(coordinate)?;
            Ok(JointCoordinate { joint, coordinate })
        };
        let of_coordinate = |coordinate, order| -> Result<Box<dyn Probe>> {
            let at = at(coordinate)?;
            Ok(Box::new(CoordinateProbe {
                at,
                order,
                prescribed: system.prescribed_place(&at),
                tracked: system.tracked_place(&at),
            }))
        };
        match self {
            JointQuantity::Coordinate(coordinate) => of_coordinate(coordinate, 0),
            JointQuantity::Rate(coordinate) => of_coordinate(coordinate, 1),
            JointQuantity::Acceleration(coordinate) => of_coordinate(coordinate, 2),
            JointQuantity::DrivingEffort(coordinate) => {
                let index = system.prescribed_place(&at(coordinate)?).ok_or_else(|| {
                    let message =
                        format!("coordinate: {coordinate} of joint {joint} is not prescribed");
                    Error::new(ErrorKind::NotAvailable, message)
                })?;
                let element = place_of(system, ElementRole::Prescribed(index))?;
                Ok(Box::new(MultiplierEffort {
                    element,
                    factor: -1.0,
                }))
            }
            JointQuantity::Reaction(axes) => {
                let element = place_of(system, ElementRole::Joint(joint))?;
                Ok(Box::new(Reaction {
                    joint,
                    element,
                    axes,
                }))
            }
        }
    }
}

/// Number of an element.
fn place_of(system: &System, role: ElementRole) -> Result<usize> {
    let place = system.elements().iter().position(|p| p.role == role);
    place.ok_or_else(|| {
        Error::new(
            ErrorKind::NotAvailable,
            "the solution has no such constraint",
        )
    })
}

/// Steps in which an angle is followed from one grid point to the next, where it may turn between
/// them: where it changes by more than so much from any to its next.
const FOLLOWING_STEPS: usize = 4;
const LITTLE_TURN: f64 = 0.5;

/// A joint coordinate, or its derivative in time of some order.
#[derive(Debug)]
struct CoordinateProbe {
    at: JointCoordinate,
    order: u32,
    /// Its number among the prescribed coordinates.
    prescribed: Option<usize>,
    /// Its place among those whose turns are followed.
    tracked: Option<usize>,
}

impl CoordinateProbe {
    /// What tells its whole turns at the first time: what prescribes it or, without that, how the
    /// solve came there.
    fn start(&self, history: &History) -> f64 {
        match (self.prescribed, self.tracked) {
            (Some(index), _) => history.start[index],
            (None, Some(place)) => history.state.tracked(history.system, 0)[place],
            (None, None) => 0.0,
        }
    }

    fn joint<'a>(&self, history: &History<'a>) -> &'a Joint {
        &history.system.joints()[self.at.joint]
    }

    fn value(&self, joint: &Joint, states: &[NodeState]) -> f64 {
        let z = joint.relative_motion(states);
        joint.kind().coordinate(self.at.coordinate, &z).value
    }

    /// Values at the grid points, and growth in a unit of time: whole turns gained in a period.
    fn over_grid(&self, history: &History, grid: TimeGrid) -> (Vec<f64>, f64) {
        let joint = self.joint(history);
        let points = grid.points();
        let value = |k: usize| self.value(joint, &history.nodes_of(joint, k));
        let found: Vec<f64> = (0..points).map(value).collect();
        if !joint.kind().leaves_turns_open(self.at.coordinate) {
            return (found, 0.0);
        }
        let mut angle = nearest_turn(found[0], self.start(history));
        let mut values = vec![angle];
        let next = found.iter().cycle().skip(1);
        let changes = found
            .iter()
            .zip(next)
            .map(|(x, y)| nearest_turn(*y, *x) - x);
        let steps = match changes.map(f64::abs).all(|change| change <= LITTLE_TURN) {
            true => 1,
            false => FOLLOWING_STEPS,
        };
        // In small steps where motions can be interpolated, so that no turn is missed.
        let of_node = |&node: &usize| PeriodicMotion::new(history.state.node(node));
        let motions: Vec<PeriodicMotion> = joint.nodes().iter().map(of_node).collect();
        let mut weights = CardinalWeights::new(grid);
        for k in 1..=points {
            for step in 1..steps {
                let fraction = step as f64 / steps as f64;
                weights.move_to(grid.at(((k - 1) as f64 + fraction) / points as f64));
                let at_rest = |motion: &PeriodicMotion| {
                    let motion = motion.motion_at(&weights);
                    motion.map(NodeState::at_rest)
                };
                let states: Option<Vec<NodeState>> = motions.iter().map(at_rest).collect();
                if let Some(states) = states {
                    angle = nearest_turn(self.value(joint, &states), angle);
                }
            }
            angle = nearest_turn(found[k % points], angle);
            if k < points {
                values.push(angle);
            }
        }
        let turns = ((angle - values[0]) / TAU).round();
        (values, TAU * turns / grid.period())
    }

    /// Values, rates and accelerations at the steps of a trajectory.
    fn over_steps(&self, history: &History) -> [Vec<f64>; 3] {
        let joint = self.joint(history);
        let (which, times) = (self.at.coordinate, &history.times);
        let mut columns: [Vec<f64>; 3] = Default::default();
        for k in 0..history.points() {
            let states = history.nodes_of(joint, k);
            let [mut value, rate, acceleration] = joint.coordinate_derivatives(which, &states);
            if joint.kind().leaves_turns_open(which) {
                let expected = match k {
                    0 => self.start(history),
                    // Half a step of either rate.
                    _ => {
                        let half = 0.5 * (times[k] - times[k - 1]);
                        columns[0][k - 1] + half * (columns[1][k - 1] + rate)
                    }
                };
                value = nearest_turn(value, expected);
            }
            let values = columns.iter_mut().zip([value, rate, acceleration]);
            values.for_each(|(column, x)| column.push(x));
        }
        columns
    }
}

impl Probe for CoordinateProbe {
    fn dependence(&self) -> Dependence {
        match self.order {
            0 => Dependence::Nothing,
            _ => Dependence::Period,
        }
    }

    fn samples(&self, history: &History) -> Result<Samples> {
        let Some(grid) = history.grid else {
            let mut columns = self
                .over_steps(history)
                .into_iter()
                .skip(self.order as usize);
            let values = columns.next().unwrap_or_default();
            return Ok(Samples {
                slopes: columns.next(),
                ..Samples::of_one(values)
            });
        };
        let (values, rate) = self.over_grid(history, grid);
        Ok(Samples {
            rate,
            order: self.order,
            ..Samples::of_one(values)
        })
    }

    fn vary(
        &self,
        history: &History,
        (_, k): (usize, usize),
        _: &Samples,
        weight: f64,
        out: &mut Variation,
    ) -> Result<()> {
        let joint = self.joint(history);
        let states = history.nodes_of(joint, k);
        joint.vary_coordinate(self.at.coordinate, &states, |local, row| {
            let rows = [row * weight, Vector6::zeros(), Vector6::zeros()];
            out.add(joint.nodes()[local], k, &rows);
        });
        Ok(())
    }
}

/// What a relation exerts on one of its joint coordinates, towards growth.
pub(super) fn relation_effort(
    system: &System,
    relation: usize,
    coordinate: usize,
) -> Result<Box<dyn Probe>> {
    let relations = system.relations();
    require_id("relation", "relation", relations.len(), relation)?;
    let terms = &relations[relation].terms;
    let Some((_, coefficient)) = terms.get(coordinate) else {
        let expected = format!("a number below {}", terms.len());
        return Err(Error::value("component", expected, coordinate));
    };
    let element = place_of(system, ElementRole::Relation(relation))?;
    Ok(Box::new(MultiplierEffort {
        element,
        factor: -coefficient,
    }))
}

/// A multiple of a multiplier: what drives a coordinate. Multipliers are efforts on the left-hand
/// side.
#[derive(Debug)]
struct MultiplierEffort {
    element: usize,
    factor: f64,
}

impl Probe for MultiplierEffort {
    fn dependence(&self) -> Dependence {
        Dependence::Nothing
    }

    fn samples(&self, history: &History) -> Result<Samples> {
        let placed = &history.system.elements()[self.element];
        Samples::at_each(history, 1, |k, row| {
            row.push(self.factor * history.own_of(placed, k)[0]);
            Ok(())
        })
    }

    fn vary(
        &self,
        history: &History,
        (_, k): (usize, usize),
        _: &Samples,
        weight: f64,
        out: &mut Variation,
    ) -> Result<()> {
        let placed = &history.system.elements()[self.element];
        out.add_own(placed, 0, k, self.factor * weight);
        Ok(())
    }
}

/// What a joint exerts on its second body.
#[derive(Debug)]
struct Reaction {
    joint: usize,
    element: usize,
    axes: ResolvedIn,
}

impl Reaction {
    /// From the second joint frame to the axes.
    fn turn(&self, joint: &Joint, states: &[NodeState]) -> Matrix3<f64> {
        match self.axes {
            ResolvedIn::Second => Matrix3::identity(),
            ResolvedIn::First => joint.relative_motion(states).rotation,
            ResolvedIn::Space => joint.second_frame(states).rotation,
        }
    }
}

impl Probe for Reaction {
    fn dependence(&self) -> Dependence {
        Dependence::Nothing
    }

    fn samples(&self, history: &History) -> Result<Samples> {
        let joint = &history.system.joints()[self.joint];
        let placed = &history.system.elements()[self.element];
        Samples::at_each(history, 6, |k, row| {
            let states = history.nodes_of(joint, k);
            let wrench = joint.reaction(&states, history.own_of(placed, k));
            row.extend(turned(&self.turn(joint, &states), &wrench).iter());
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
        let joint = &history.system.joints()[self.joint];
        let placed = &history.system.elements()[self.element];
        let states = history.nodes_of(joint, k);
        let multipliers = history.own_of(placed, k);
        // Of `eᵀ R w`: by `w`, and by the turn ψ of the axes, as Δ(R w) = R (Δw + ψ × w).
        let turn = self.turn(joint, &states);
        let unit = Vector6::ith(component, weight);
        let by_wrench = turned(&turn.transpose(), &unit);
        let wrench = joint.reaction(&states, multipliers);
        let (force, moment) = halves(&wrench);
        let (by_force, by_moment) = halves(&by_wrench);
        let by_turn = joined(
            &Vector3::zeros(),
            &(force.cross(&by_force) + moment.cross(&by_moment)),
        );
        let none = Vector6::zeros();
        let [relative, second] = match self.axes {
            ResolvedIn::Second => [none, none],
            ResolvedIn::First => [by_turn, none],
            ResolvedIn::Space => [none, by_turn],
        };
        let mut by_own = vec![0.0; multipliers.len()];
        joint.vary_reaction(
            &states,
            (multipliers, &mut by_own),
            &by_wrench,
            [&relative, &second],
            |local, row| out.add(joint.nodes()[local], k, &[row, none, none]),
        );
        for (index, factor) in by_own.iter().enumerate() {
            out.add_own(placed, index, k, *factor);
        }
        Ok(())
    }
}
