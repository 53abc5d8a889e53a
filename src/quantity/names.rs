//! What quantities and their components are called, in tables and messages.

use super::{
    BeamQuantity, ForceQuantity, JointQuantity, NodeQuantity, Quantity, ResolvedIn, ShellQuantity,
};
use crate::elements::{LoadFrame, ShellSide};
use std::fmt;

const POSITION: [&str; 3] = ["x", "y", "z"];
const MATRIX: [&str; 9] = ["11", "21", "31", "12", "22", "32", "13", "23", "33"];
const QUATERNION: [&str; 4] = ["w", "x", "y", "z"];
const SPACE_RATES: [&str; 6] = ["x", "y", "z", "angular_x", "angular_y", "angular_z"];
const MATERIAL_RATES: [&str; 6] = ["1", "2", "3", "angular_1", "angular_2", "angular_3"];
const SPACE_WRENCH: [&str; 6] = [
    "force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z",
];
const MATERIAL_WRENCH: [&str; 6] = [
    "force_1", "force_2", "force_3", "moment_1", "moment_2", "moment_3",
];
const STRAIN: [&str; 6] = [
    "axial",
    "shear_2",
    "shear_3",
    "twist",
    "curvature_2",
    "curvature_3",
];
const RESULTANT: [&str; 6] = [
    "axial",
    "shear_2",
    "shear_3",
    "torque",
    "bending_2",
    "bending_3",
];
const SHELL_STRAIN: [&str; 12] = [
    "strain_11",
    "strain_12",
    "shear_1",
    "curvature_11",
    "curvature_12",
    "curvature_1n",
    "strain_21",
    "strain_22",
    "shear_2",
    "curvature_21",
    "curvature_22",
    "curvature_2n",
];
const SHELL_RESULTANT: [&str; 12] = [
    "force_11",
    "force_12",
    "shear_1",
    "moment_11",
    "moment_12",
    "moment_1n",
    "force_21",
    "force_22",
    "shear_2",
    "moment_21",
    "moment_22",
    "moment_2n",
];
const STRESS: [&str; 4] = ["11", "22", "12", "von_mises"];

impl Quantity {
    /// Names of its components; an empty one if there is only one.
    pub fn component_names(self) -> &'static [&'static str] {
        match self {
            Quantity::Node(_, quantity) => match quantity {
                NodeQuantity::Position => &POSITION,
                NodeQuantity::RotationMatrix => &MATRIX,
                NodeQuantity::Quaternion => &QUATERNION,
                NodeQuantity::Velocity | NodeQuantity::Acceleration => &SPACE_RATES,
                NodeQuantity::MaterialVelocity | NodeQuantity::MaterialAcceleration => {
                    &MATERIAL_RATES
                }
            },
            Quantity::Joint(_, JointQuantity::Reaction(ResolvedIn::Space))
            | Quantity::Force(_, ForceQuantity::OnNode(_, LoadFrame::Space)) => &SPACE_WRENCH,
            Quantity::Joint(_, JointQuantity::Reaction(_))
            | Quantity::Force(_, ForceQuantity::OnNode(_, LoadFrame::Follower)) => &MATERIAL_WRENCH,
            Quantity::Beam { quantity, .. } => match quantity {
                BeamQuantity::Strain => &STRAIN,
                _ => &RESULTANT,
            },
            Quantity::Shell { quantity, .. } => match quantity {
                ShellQuantity::Strain => &SHELL_STRAIN,
                ShellQuantity::Resultant => &SHELL_RESULTANT,
                ShellQuantity::SurfaceStress(_) => &STRESS,
            },
            Quantity::Force(_, ForceQuantity::BushingEfforts) => &MATERIAL_WRENCH,
            Quantity::Joint(..) | Quantity::Force(..) | Quantity::RelationEffort { .. } => &[""],
        }
    }

    /// What a component is called: `node3.position.x`.
    pub fn describe(self, component: usize) -> String {
        match self.component_names().get(component).copied() {
            None | Some("") => self.to_string(),
            Some(name) => format!("{self}.{name}"),
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Quantity::Node(node, quantity) => write!(f, "node{node}.{}", of_node(quantity)),
            Quantity::Joint(joint, quantity) => {
                write!(f, "joint{joint}.{}", of_joint(quantity).replace(' ', "_"))
            }
            Quantity::Beam {
                element,
                station,
                quantity,
            } => write!(f, "beam{element}({station}).{}", of_beam(quantity)),
            Quantity::Shell {
                element,
                point,
                quantity,
            } => {
                let ([xi, eta], of) = (point.at, of_shell(quantity));
                write!(f, "shell{element}({xi},{eta}).{of}")
            }
            Quantity::Force(force, quantity) => match quantity {
                ForceQuantity::Effort => write!(f, "force{force}.effort"),
                ForceQuantity::BranchEffort(b) => write!(f, "force{force}.branch{b}.effort"),
                ForceQuantity::BranchElongation(b) => {
                    write!(f, "force{force}.branch{b}.elongation")
                }
                ForceQuantity::OnNode(node, _) => write!(f, "force{force}.on_node{node}"),
                ForceQuantity::ControlEffort(output) => {
                    write!(f, "force{force}.output{output}.effort")
                }
                ForceQuantity::ControlState(state) => write!(f, "force{force}.state{state}"),
                ForceQuantity::BushingEfforts => write!(f, "force{force}.efforts"),
            },
            Quantity::RelationEffort {
                relation,
                coordinate,
            } => write!(f, "relation{relation}.coordinate{coordinate}.effort"),
        }
    }
}

fn of_node(quantity: NodeQuantity) -> &'static str {
    match quantity {
        NodeQuantity::Position => "position",
        NodeQuantity::RotationMatrix => "rotation",
        NodeQuantity::Quaternion => "quaternion",
        NodeQuantity::Velocity => "velocity",
        NodeQuantity::Acceleration => "acceleration",
        NodeQuantity::MaterialVelocity => "material_velocity",
        NodeQuantity::MaterialAcceleration => "material_acceleration",
    }
}

fn of_joint(quantity: JointQuantity) -> String {
    match quantity {
        JointQuantity::Coordinate(c) => c.to_string(),
        JointQuantity::Rate(c) => format!("{c}.rate"),
        JointQuantity::Acceleration(c) => format!("{c}.acceleration"),
        JointQuantity::DrivingEffort(c) => format!("{c}.driving_effort"),
        JointQuantity::Reaction(ResolvedIn::Space) => "reaction".into(),
        JointQuantity::Reaction(ResolvedIn::First) => "reaction.first".into(),
        JointQuantity::Reaction(ResolvedIn::Second) => "reaction.second".into(),
    }
}

fn of_beam(quantity: BeamQuantity) -> &'static str {
    match quantity {
        BeamQuantity::Strain => "strain",
        BeamQuantity::Force => "force",
        BeamQuantity::MeanForce => "force_mean",
        BeamQuantity::ForceJump => "force_jump",
    }
}

fn of_shell(quantity: ShellQuantity) -> &'static str {
    match quantity {
        ShellQuantity::Strain => "strain",
        ShellQuantity::Resultant => "resultant",
        ShellQuantity::SurfaceStress(ShellSide::Top) => "stress_top",
        ShellQuantity::SurfaceStress(ShellSide::Bottom) => "stress_bottom",
    }
}
