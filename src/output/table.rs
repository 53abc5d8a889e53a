//! Tables of sampled quantities, written as CSV.

use super::write::write_file;
use super::{BeamQuantity, ForceQuantity, JointQuantity, NodeQuantity, ResolvedIn, Solution};
use crate::elements::LoadFrame;
use crate::error::{Error, Result, require_finite};
use std::io;
use std::path::Path;

/// Name of the first column.
const TIME: &str = "t";

/// Columns of numbers over the same times: quantities of one solution or of several, or the user's
/// own.
#[derive(Debug, Clone)]
pub struct Table {
    times: Vec<f64>,
    columns: Vec<(String, Vec<f64>)>,
}

impl Table {
    /// A table whose only column, `t`, are these times.
    ///
    /// # Errors
    /// No times, or times that are not finite.
    pub fn new(times: &[f64]) -> Result<Self> {
        require_finite("times", times)?;
        if times.is_empty() {
            return Err(Error::size("count", "at least one time", 0));
        }
        Ok(Table {
            times: times.to_vec(),
            columns: Vec::new(),
        })
    }

    /// Appends the components of a quantity of a node, named after `label` (by default `node` and
    /// its id, and the quantity) and the component.
    ///
    /// # Errors
    /// As [`Solution::node`], or a column of that name is there already.
    pub fn add_node(
        &mut self,
        solution: &Solution,
        node: usize,
        quantity: NodeQuantity,
        label: Option<&str>,
    ) -> Result<()> {
        let values = solution.node(node, quantity, &self.times)?;
        let (name, components): (_, &[&str]) = match quantity {
            NodeQuantity::Position => ("position", &["x", "y", "z"]),
            NodeQuantity::RotationMatrix => (
                "rotation",
                &["11", "21", "31", "12", "22", "32", "13", "23", "33"],
            ),
            NodeQuantity::Quaternion => ("quaternion", &["w", "x", "y", "z"]),
            NodeQuantity::Velocity => ("velocity", &SPACE_RATES),
            NodeQuantity::Acceleration => ("acceleration", &SPACE_RATES),
            NodeQuantity::MaterialVelocity => ("material_velocity", &MATERIAL_RATES),
            NodeQuantity::MaterialAcceleration => ("material_acceleration", &MATERIAL_RATES),
        };
        let default = || format!("node{node}.{name}");
        self.add_components(label, default, components, &values)
    }

    /// Appends the components of a quantity of a joint, as [`Table::add_node`].
    ///
    /// # Errors
    /// As [`Solution::joint`], or a column of that name is there already.
    pub fn add_joint(
        &mut self,
        solution: &Solution,
        joint: usize,
        quantity: JointQuantity,
        label: Option<&str>,
    ) -> Result<()> {
        let values = solution.joint(joint, quantity, &self.times)?;
        let single: &[&str] = &[""];
        let (name, components) = match quantity {
            JointQuantity::Coordinate(c) => (c.to_string(), single),
            JointQuantity::Rate(c) => (format!("{c}.rate"), single),
            JointQuantity::Acceleration(c) => (format!("{c}.acceleration"), single),
            JointQuantity::DrivingEffort(c) => (format!("{c}.driving_effort"), single),
            JointQuantity::Reaction(ResolvedIn::Space) => ("reaction".into(), &SPACE_WRENCH[..]),
            JointQuantity::Reaction(ResolvedIn::First) => {
                ("reaction.first".into(), &MATERIAL_WRENCH[..])
            }
            JointQuantity::Reaction(ResolvedIn::Second) => {
                ("reaction.second".into(), &MATERIAL_WRENCH[..])
            }
        };
        let default = || format!("joint{joint}.{}", name.replace(' ', "_"));
        self.add_components(label, default, components, &values)
    }

    /// Appends the six components of a quantity of a beam element at a station, as
    /// [`Table::add_node`].
    ///
    /// # Errors
    /// As [`Solution::beam`], or a column of that name is there already.
    pub fn add_beam(
        &mut self,
        solution: &Solution,
        element: usize,
        station: f64,
        quantity: BeamQuantity,
        label: Option<&str>,
    ) -> Result<()> {
        let values = solution.beam(element, station, quantity, &self.times)?;
        let (name, components) = match quantity {
            BeamQuantity::Strain => (
                "strain",
                [
                    "axial",
                    "shear_2",
                    "shear_3",
                    "twist",
                    "curvature_2",
                    "curvature_3",
                ],
            ),
            BeamQuantity::Force | BeamQuantity::MeanForce | BeamQuantity::ForceJump => (
                match quantity {
                    BeamQuantity::MeanForce => "force_mean",
                    BeamQuantity::ForceJump => "force_jump",
                    _ => "force",
                },
                [
                    "axial",
                    "shear_2",
                    "shear_3",
                    "torque",
                    "bending_2",
                    "bending_3",
                ],
            ),
        };
        let default = || format!("beam{element}({station}).{name}");
        self.add_components(label, default, &components, &values)
    }

    /// Appends the components of a quantity of a force, as [`Table::add_node`].
    ///
    /// # Errors
    /// As [`Solution::force`], or a column of that name is there already.
    pub fn add_force(
        &mut self,
        solution: &Solution,
        force: usize,
        quantity: ForceQuantity,
        label: Option<&str>,
    ) -> Result<()> {
        let values = solution.force(force, quantity, &self.times)?;
        let single: &[&str] = &[""];
        let (name, components) = match quantity {
            ForceQuantity::Effort => ("effort".into(), single),
            ForceQuantity::BranchEffort(b) => (format!("branch{b}.effort"), single),
            ForceQuantity::BranchElongation(b) => (format!("branch{b}.elongation"), single),
            ForceQuantity::OnNode(n, LoadFrame::Space) => {
                (format!("on_node{n}"), &SPACE_WRENCH[..])
            }
            ForceQuantity::OnNode(n, LoadFrame::Follower) => {
                (format!("on_node{n}"), &MATERIAL_WRENCH[..])
            }
        };
        let default = || format!("force{force}.{name}");
        self.add_components(label, default, components, &values)
    }

    /// Appends a column of the user's own values, one for each time.
    ///
    /// # Errors
    /// Values that are not as many as the times, or not finite, or a column of that name is there
    /// already.
    pub fn add_values(&mut self, label: &str, values: &[f64]) -> Result<()> {
        require_finite("values", values)?;
        if values.len() != self.times.len() {
            let expected = format!("one for each of the {} times", self.times.len());
            return Err(Error::size("count", expected, values.len()));
        }
        self.add_components(Some(label), String::new, &[""], values)
    }

    /// Appends columns `label.component`; `values` has the components of each time together.
    fn add_components(
        &mut self,
        label: Option<&str>,
        default: impl FnOnce() -> String,
        components: &[&str],
        values: &[f64],
    ) -> Result<()> {
        let label = label.map_or_else(default, str::to_owned);
        if label.is_empty() {
            return Err(Error::value("label", "a name", "an empty text"));
        }
        let name = |component: &str| match component {
            "" => label.clone(),
            _ => format!("{label}.{component}"),
        };
        for component in components {
            let name = name(component);
            if name == TIME || self.columns.iter().any(|(other, _)| *other == name) {
                let got = format!("\"{name}\" again");
                return Err(Error::value("label", "names that no column has", got));
            }
        }
        for (i, component) in components.iter().enumerate() {
            let column = values.iter().skip(i).step_by(components.len()).copied();
            self.columns.push((name(component), column.collect()));
        }
        Ok(())
    }

    /// Writes the table as a CSV file: a line of names, then one line for each time. Numbers have
    /// as many digits as tell them apart from all others, so that they are read back exactly.
    ///
    /// # Errors
    /// [`ErrorKind::Io`](crate::error::ErrorKind::Io); a file that was there stays as it was.
    pub fn write_csv(&self, path: &Path) -> Result<()> {
        write_file(path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            let names = self.columns.iter().map(|(name, _)| name.as_str());
            csv.write_record(std::iter::once(TIME).chain(names))?;
            for (k, time) in self.times.iter().enumerate() {
                let values = self.columns.iter().map(|(_, values)| values[k]);
                let row = std::iter::once(*time).chain(values);
                csv.write_record(row.map(|x| format!("{x:?}")))?;
            }
            csv.flush()?;
            io::Result::Ok(())
        })
    }
}

const SPACE_RATES: [&str; 6] = ["x", "y", "z", "angular_x", "angular_y", "angular_z"];
const MATERIAL_RATES: [&str; 6] = ["1", "2", "3", "angular_1", "angular_2", "angular_3"];
const SPACE_WRENCH: [&str; 6] = [
    "force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z",
];
const MATERIAL_WRENCH: [&str; 6] = [
    "force_1", "force_2", "force_3", "moment_1", "moment_2", "moment_3",
];
