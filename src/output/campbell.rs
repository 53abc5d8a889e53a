//! A chart of exponents along a branch, as of Campbell: frequencies and rates of growth of
//! disturbances, and what moves in them.

use super::nodal_content::Blades;
use super::write::write_file;
use crate::error::{Error, ErrorKind, Result};
use crate::solve::{Branch, Outcome, Stability, StabilityOptions};
use std::io;
use std::path::Path;

/// What follows the parameter in each line.
const COLUMNS: [&str; 8] = [
    "period",
    "growth",
    "mode_frequency",
    "frequency_from_ground",
    "multiplier",
    "error",
    "share",
    "content",
];

impl Branch {
    /// Writes a chart of the exponents of small disturbances along the branch as a CSV file: of
    /// each point that is no event a line for each multiplier, but for conjugates and for those
    /// that only move the motion in time or space.
    ///
    /// A line has the parameter, the period, the rate of growth `Re μ`, the angular frequency of
    /// the mode over the period in its nodes' own axes and from the ground, the size of the
    /// multiplier and its estimated error, and what moves: of a rotor with equal parts the pattern
    /// of nodal diameters ([`super::NodalContent`]) and its share, where `blades` are a node of
    /// each part, one after the other around it; without blades, or where these hardly move, the
    /// node that moves most.
    ///
    /// # Errors
    /// If there are no points, or `blades` are not as [`super::Solution::nodal_content`] takes
    /// them; those of [`crate::solve::solve_stability`]; [`ErrorKind::NotAvailable`] if it was
    /// cancelled, or the disturbances' equations are singular; [`ErrorKind::Io`]. A file that was
    /// there stays as it was.
    pub fn write_campbell(
        &self,
        path: &Path,
        options: &StabilityOptions,
        blades: &[usize],
    ) -> Result<()> {
        if self.points.is_empty() {
            let message = format!("branch: it has no points: {}", self.explanation);
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        let mut rows = Vec::new();
        for (index, point) in self.points.iter().enumerate() {
            if point.event.is_none() {
                self.add_exponents(index, (options, blades), &mut rows)?;
            }
        }
        write_file(path, |file| {
            let mut csv = csv::Writer::from_writer(file);
            let parameter = self.value_names().first().cloned().unwrap_or_default();
            let names = std::iter::once(parameter.as_str()).chain(COLUMNS);
            csv.write_record(names)?;
            for row in &rows {
                csv.write_record(row)?;
            }
            csv.flush()?;
            io::Result::Ok(())
        })
    }

    /// Adds the lines of a point.
    fn add_exponents(
        &self,
        index: usize,
        (options, blades): (&StabilityOptions, &[usize]),
        rows: &mut Vec<Vec<String>>,
    ) -> Result<()> {
        let solution = self.solution(index)?;
        let stability = solution.solve_stability(options)?;
        let why = match stability.outcome {
            Outcome::Cancelled => Some("it was cancelled"),
            Outcome::Singular => Some("the equations of a step are singular"),
            _ => None,
        };
        if let Some(why) = why {
            let message = format!("branch: no multipliers at point {index}: {why}");
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        let blades = match blades {
            [] => None,
            nodes => Some(Blades::new(&solution, nodes, &stability.times())?),
        };
        for (number, multiplier) in stability.multipliers.iter().enumerate() {
            if multiplier.trivial || multiplier.exponent.im < 0.0 {
                continue;
            }
            let content = match &blades {
                Some(blades) => blades.content(&stability, number)?,
                None => None,
            };
            let [frequency, from_ground, share] = match &content {
                Some(found) => [found.frequency, found.frequency_from_ground, found.share],
                None => [multiplier.frequency, multiplier.frequency, 1.0],
            };
            let name = match content {
                Some(found) => found.name(),
                None => format!("node {}", most_moved(&stability, number)?),
            };
            let numbers = [
                self.points[index].values[0],
                solution.grid().period(),
                multiplier.exponent.re,
                frequency,
                from_ground,
                multiplier.value.norm(),
                multiplier.error,
                share,
            ];
            let mut row: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
            row.push(self.model().labels().annotate(&name));
            rows.push(row);
        }
        Ok(())
    }
}

/// The node that moves most in a mode.
fn most_moved(stability: &Stability, number: usize) -> Result<usize> {
    let mut most = (0, -1.0);
    for node in 0..stability.nodes() {
        let shape = stability.shape(number, node)?;
        let all = shape.iter().flatten();
        let largest = all.fold(0.0f64, |largest, x| largest.max(x.norm()));
        if largest > most.1 {
            most = (node, largest);
        }
    }
    Ok(most.0)
}
