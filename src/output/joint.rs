//! Joint coordinates, their rates, driving efforts and reactions.

use super::solution::{Samples, Solution};
use crate::elements::{Coordinate, Element, Joint, NodeState, nearest_turn};
use crate::error::{Error, ErrorKind, Result};
use crate::fourier::{CardinalWeights, PeriodicSeries};
use crate::model::JointCoordinate;
use crate::motion::{PeriodicMotion, turned};
use crate::system::{ElementRole, Placed};
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
}

/// Steps in which an angle is followed from one grid point to the next.
const FOLLOWING_STEPS: usize = 4;

impl Solution {
    /// A quantity of a joint at `times`; components of each time together.
    ///
    /// # Errors
    /// An unknown joint, or a quantity that it does not have.
    pub fn joint(&self, joint: usize, quantity: JointQuantity, times: &[f64]) -> Result<Vec<f64>> {
        let order = match quantity {
            JointQuantity::Rate(_) => 1,
            JointQuantity::Acceleration(_) => 2,
            _ => 0,
        };
        let values = match quantity {
            JointQuantity::Coordinate(c)
            | JointQuantity::Rate(c)
            | JointQuantity::Acceleration(c) => {
                let definition = self.require_coordinate(joint, c)?;
                if self.is_trajectory() {
                    let at = JointCoordinate {
                        joint,
                        coordinate: c,
                    };
                    self.coordinate_along(definition, &at, order, times)?
                } else {
                    let series = self.coordinate(joint, c)?;
                    times.iter().map(|&t| series.derivative(t, order)).collect()
                }
            }
            JointQuantity::DrivingEffort(c) => {
                self.sample(&self.driving_efforts(joint, c)?, times)?
            }
            JointQuantity::Reaction(axes) => self.sample(&self.reactions(joint, axes)?, times)?,
        };
        Self::finite("joint", values)
    }

    fn require_coordinate(&self, joint: usize, coordinate: Coordinate) -> Result<&Joint> {
        self.model
            .require_coordinate(&JointCoordinate { joint, coordinate })?;
        Ok(&self.solve.system.joints()[joint])
    }

    /// What tells the whole turns of a coordinate at the first grid point or step: the signal that
    /// prescribes it or, without one, how the solve came there.
    pub(super) fn start_of(&self, at: &JointCoordinate) -> f64 {
        if let Some(index) = self.model.prescribed_index(at) {
            return self.prescribed_start[index];
        }
        let system = &self.solve.system;
        let place = system.tracked_place(at);
        place.map_or(0.0, |place| self.solve.state.tracked(system, 0)[place])
    }

    /// Fourier series of each component of a quantity of a joint.
    ///
    /// # Errors
    /// An unknown joint, or a quantity that it does not have.
    pub fn joint_series(
        &self,
        joint: usize,
        quantity: JointQuantity,
    ) -> Result<Vec<PeriodicSeries>> {
        match quantity {
            JointQuantity::Coordinate(which) => Ok(vec![self.coordinate(joint, which)?]),
            JointQuantity::Rate(which) => Ok(vec![self.coordinate(joint, which)?.differentiated()]),
            JointQuantity::Acceleration(which) => Ok(vec![
                self.coordinate(joint, which)?
                    .differentiated()
                    .differentiated(),
            ]),
            JointQuantity::DrivingEffort(which) => {
                self.series(&self.driving_efforts(joint, which)?)
            }
            JointQuantity::Reaction(axes) => self.series(&self.reactions(joint, axes)?),
        }
    }

    /// Efforts that drive a prescribed coordinate, at the grid points or steps.
    fn driving_efforts(&self, joint: usize, coordinate: Coordinate) -> Result<Samples> {
        self.require_coordinate(joint, coordinate)?;
        let at = JointCoordinate { joint, coordinate };
        let index = self.model.prescribed_index(&at).ok_or_else(|| {
            let message = format!("coordinate: {coordinate} of joint {joint} is not prescribed");
            Error::new(ErrorKind::NotAvailable, message)
        })?;
        let placed = self.placed(ElementRole::Prescribed(index))?;
        // The multiplier is the effort on the left-hand side: that of the drive is opposite.
        self.samples_of(1, |k| Ok(vec![-self.solve.state.own_of(placed, k)[0]]))
    }

    /// Reactions at the grid points or steps.
    fn reactions(&self, joint: usize, axes: ResolvedIn) -> Result<Samples> {
        self.model.require_joint("joint", joint)?;
        let definition = &self.solve.system.joints()[joint];
        let placed = self.placed(ElementRole::Joint(joint))?;
        self.samples_of(6, |k| {
            let states = self.states_of(definition, k);
            let multipliers = self.solve.state.own_of(placed, k);
            let wrench = definition.reaction(&states, multipliers);
            let turn = match axes {
                ResolvedIn::Second => nalgebra::Matrix3::identity(),
                ResolvedIn::First => definition.relative_motion(&states).rotation,
                ResolvedIn::Space => definition.second_frame(&states).rotation,
            };
            Ok(turned(&turn, &wrench).as_slice().to_vec())
        })
    }

    fn placed(&self, role: ElementRole) -> Result<&Placed> {
        self.solve
            .system
            .elements()
            .iter()
            .find(|p| p.role == role)
            .ok_or_else(|| Error::new(ErrorKind::NotAvailable, "the solution has no such joint"))
    }

    /// A joint coordinate as a series: whole turns gained in a period are its rate.
    pub(super) fn coordinate(&self, joint: usize, which: Coordinate) -> Result<PeriodicSeries> {
        self.require_harmonics()?;
        let definition = self.require_coordinate(joint, which)?;
        let grid = self.grid();
        let points = grid.points();
        let kind = definition.kind();
        let value = |states: &[NodeState]| {
            kind.coordinate(which, &definition.relative_motion(states))
                .value
        };

        if !kind.leaves_turns_open(which) {
            let values: Vec<f64> = (0..points)
                .map(|k| value(&self.states_of(definition, k)))
                .collect();
            return Ok(self.interpolate(&values, 0.0));
        }
        let at = JointCoordinate {
            joint,
            coordinate: which,
        };
        let mut angle = nearest_turn(value(&self.states_of(definition, 0)), self.start_of(&at));
        let mut values = vec![angle];
        // In small steps where motions can be interpolated, so that no turn is missed.
        let of_node = |&node: &usize| PeriodicMotion::new(self.solve.state.node(node));
        let motions: Vec<PeriodicMotion> = definition.nodes().iter().map(of_node).collect();
        let mut weights = CardinalWeights::new(grid);
        for k in 1..=points {
            for step in 1..FOLLOWING_STEPS {
                let fraction = step as f64 / FOLLOWING_STEPS as f64;
                weights.move_to(grid.period() * ((k - 1) as f64 + fraction) / points as f64);
                let at_rest = |motion: &PeriodicMotion| {
                    let motion = motion.motion_at(&weights);
                    motion.map(NodeState::at_rest)
                };
                let states: Option<Vec<NodeState>> = motions.iter().map(at_rest).collect();
                if let Some(states) = states {
                    angle = nearest_turn(value(&states), angle);
                }
            }
            angle = nearest_turn(value(&self.states_of(definition, k % points)), angle);
            if k < points {
                values.push(angle);
            }
        }
        let turns = ((angle - values[0]) / TAU).round();
        let rate = TAU * turns / grid.period();
        Ok(self.interpolate(&values, rate))
    }
}
