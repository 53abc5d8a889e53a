//! What quantities are of the order of.

use super::{BeamQuantity, ForceQuantity, JointQuantity, NodeQuantity, Quantity, ShellQuantity};
use crate::elements::{Coordinate, Measure};
use crate::system::{ElementRole, System};
use std::f64::consts::TAU;

impl Quantity {
    /// What counts as 1 in a component: a product of powers of the characteristic length and force,
    /// and of the time of a radian.
    pub fn scale(self, component: usize, system: &System) -> f64 {
        let scales = system.scales();
        let (length, force, time) = (scales.length, scales.force, system.period() / TAU);
        let motion = |measure: Measure| match measure {
            Measure::Length => length,
            Measure::Angle => 1.0,
        };
        let effort = |measure: Measure| force * length / motion(measure);
        // Of vectors with a linear and an angular half.
        let half = match component < 3 {
            true => Measure::Length,
            false => Measure::Angle,
        };
        let of = |coordinate: Coordinate| motion(coordinate.measure());
        match self {
            Quantity::Node(_, quantity) => match quantity {
                NodeQuantity::Position => length,
                NodeQuantity::RotationMatrix | NodeQuantity::Quaternion => 1.0,
                NodeQuantity::Velocity | NodeQuantity::MaterialVelocity => motion(half) / time,
                NodeQuantity::Acceleration | NodeQuantity::MaterialAcceleration => {
                    motion(half) / (time * time)
                }
            },
            Quantity::Joint(_, quantity) => match quantity {
                JointQuantity::Coordinate(c) => of(c),
                JointQuantity::Rate(c) => of(c) / time,
                JointQuantity::Acceleration(c) => of(c) / (time * time),
                JointQuantity::DrivingEffort(c) => effort(c.measure()),
                JointQuantity::Reaction(_) => effort(half),
            },
            Quantity::Beam { quantity, .. } => match quantity {
                BeamQuantity::Strain => motion(half) / length,
                _ => effort(half),
            },
            Quantity::Shell { quantity, .. } => match quantity {
                // Per unit of length; of six components, three are linear.
                ShellQuantity::Strain if component % 6 < 3 => 1.0,
                ShellQuantity::Strain => 1.0 / length,
                ShellQuantity::Resultant if component % 6 < 3 => force / length,
                ShellQuantity::Resultant => force,
                ShellQuantity::SurfaceStress(_) => force / (length * length),
            },
            Quantity::Force(number, quantity) => {
                let role = ElementRole::Force(number);
                let placed = system.elements().iter().find(|placed| placed.role == role);
                let measure = placed.and_then(|placed| placed.element.acted_measure());
                let measure = measure.unwrap_or(Measure::Length);
                let controller = placed.and_then(|placed| placed.element.as_controller());
                match quantity {
                    ForceQuantity::ControlEffort(output) => {
                        let measure = controller.and_then(|of| of.outputs().nth(output));
                        effort(measure.unwrap_or(Measure::Length))
                    }
                    ForceQuantity::ControlState(state) => {
                        let state = controller.and_then(|of| of.states().get(state));
                        state.map_or(1.0, |state| state.size)
                    }
                    ForceQuantity::Effort | ForceQuantity::BranchEffort(_) => effort(measure),
                    ForceQuantity::BranchElongation(_) => motion(measure),
                    ForceQuantity::OnNode(..) | ForceQuantity::BushingEfforts => effort(half),
                }
            }
            Quantity::RelationEffort {
                relation,
                coordinate,
            } => {
                let relation = system.relations().get(relation);
                let term = relation.and_then(|it| it.terms.get(coordinate));
                effort(term.map_or(Measure::Length, |(at, _)| at.coordinate.measure()))
            }
        }
    }
}
