//! What a branch tells: the solution of a point, a report, and a diagram as CSV.

use super::write::write_file;
use super::{JointQuantity, NodeQuantity, Solution};
use crate::error::{Error, ErrorKind, Result};
use crate::model::JointCoordinate;
use crate::solve::{Branch, BranchEnd};
use std::fmt::Write as _;
use std::io;
use std::path::Path;

/// A number of the motion that a diagram shows.
#[derive(Debug, Clone, Copy)]
pub enum BranchOutput {
    /// A component, from 0, of the position of a node.
    Position {
        /// The node.
        node: usize,
        /// The component.
        component: usize,
    },
    /// A joint coordinate.
    Joint(JointCoordinate),
}

/// Times at which extremes are looked for, for each grid point.
const FINER: usize = 4;

/// Mean over the period, size of the first harmonic, least and largest value.
const OF_EACH: [&str; 4] = ["mean", "harmonic1", "min", "max"];

impl BranchOutput {
    fn name(&self) -> String {
        match self {
            BranchOutput::Position { node, component } => {
                let axis = ["x", "y", "z"].get(*component).unwrap_or(&"?");
                format!("node{node}.position.{axis}")
            }
            BranchOutput::Joint(at) => format!("joint{}.{}", at.joint, at.coordinate),
        }
    }

    fn values(&self, solution: &Solution, times: &[f64]) -> Result<Vec<f64>> {
        match *self {
            BranchOutput::Position { node, component } => {
                if component > 2 {
                    return Err(Error::value("component", "0, 1 or 2", component));
                }
                let all = solution.node(node, NodeQuantity::Position, times)?;
                Ok(all.into_iter().skip(component).step_by(3).collect())
            }
            BranchOutput::Joint(at) => {
                solution.joint(at.joint, JointQuantity::Coordinate(at.coordinate), times)
            }
        }
    }

    /// The numbers of [`OF_EACH`].
    fn of(&self, solution: &Solution) -> Result<[f64; 4]> {
        let grid = solution.grid();
        let count = FINER * grid.points();
        let times = (0..count).map(|k| grid.period() * k as f64 / count as f64);
        let values = self.values(solution, &times.collect::<Vec<_>>())?;
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
        let sum = |weight: &dyn Fn(usize) -> f64| {
            let terms = values.iter().enumerate().map(|(k, x)| x * weight(k));
            terms.sum::<f64>() / count as f64
        };
        Ok([
            sum(&|_| 1.0),
            2.0 * sum(&|k| angle(k).cos()).hypot(sum(&|k| angle(k).sin())),
            values.iter().copied().fold(f64::INFINITY, f64::min),
            values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ])
    }
}

impl BranchEnd {
    /// What it is, for people.
    pub fn describe(self) -> &'static str {
        match self {
            BranchEnd::Range => "the parameter reached an end of its range",
            BranchEnd::Closed => "it came back to its first point",
            BranchEnd::PointLimit => "there are as many points as are allowed",
            BranchEnd::SmallestStep => "the shortest step led to no solution",
            BranchEnd::Cancelled => "it was cancelled",
            BranchEnd::NoStart => "there is no first point",
        }
    }
}

impl Branch {
    /// The solution at a point.
    ///
    /// # Errors
    /// If there is no such point.
    pub fn solution(&self, index: usize) -> Result<Solution> {
        let (model, solved) = self.solved(index)?;
        Solution::of(&model, solved)
    }

    /// How it went, for people.
    pub fn report(&self) -> String {
        let mut text = format!("Branch along {}\n", self.parameter_name());
        let _ = writeln!(
            text,
            "  {} points, {} Newton iterations, {} steps taken again by half",
            self.points.len(),
            self.iterations,
            self.rejected
        );
        if let (Some(first), Some(last)) = (self.points.first(), self.points.last()) {
            let (from, to) = (first.values[0], last.values[0]);
            let _ = writeln!(text, "  from {from} to {to}");
        }
        for point in &self.points {
            if let Some(event) = point.event {
                let _ = writeln!(text, "  {} at {:.15}", event.describe(), point.values[0]);
            }
        }
        let _ = write!(text, "  It ended as {}", self.end.describe());
        match self.explanation.is_empty() {
            true => text.push_str(".\n"),
            false => {
                let _ = writeln!(text, ": {}", self.explanation);
            }
        }
        text
    }

    /// Writes the branch as a CSV file: a line for each point, with the parameter that is followed
    /// and those free beside it, how the step went, what happens there, and of each output its
    /// mean, the size of its first harmonic, and its least and largest value.
    ///
    /// # Errors
    /// If there are no points, or an output is none; [`ErrorKind::Io`]; a file that was there stays
    /// as it was.
    pub fn write_csv(&self, path: &Path, outputs: &[BranchOutput]) -> Result<()> {
        if self.points.is_empty() {
            let message = format!("branch: it has no points: {}", self.explanation);
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        let mut names = self.value_names();
        let of_points = ["period", "slope", "step", "angle", "grid_points", "event"];
        names.extend(of_points.map(String::from));
        for output in outputs {
            names.extend(OF_EACH.map(|of| format!("{}.{of}", output.name())));
        }
        let mut rows = Vec::new();
        for (index, point) in self.points.iter().enumerate() {
            let solution = self.solution(index)?;
            let mut row: Vec<String> = point.values.iter().map(|x| format!("{x:?}")).collect();
            let numbers = [point.grid.period(), point.slope, point.step, point.angle];
            row.extend(numbers.map(|x| format!("{x:?}")));
            row.push(point.grid.points().to_string());
            row.push(point.event.map_or("", |event| event.describe()).to_string());
            for output in outputs {
                row.extend(output.of(&solution)?.map(|x| format!("{x:?}")));
            }
            rows.push(row);
        }
        write_file(path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            csv.write_record(&names)?;
            for row in &rows {
                csv.write_record(row)?;
            }
            csv.flush()?;
            io::Result::Ok(())
        })
    }
}
