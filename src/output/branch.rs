//! What a branch tells: the solution of a point, a report, and a diagram as CSV.

use super::Solution;
use super::write::write_file;
use crate::error::{Error, ErrorKind, Result};
use crate::quantity::Selection;
use crate::solve::{Branch, BranchEnd, Verdict};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

/// Times at which extremes are looked for, for each grid point.
const FINER: usize = 4;

/// How the step to a point went, and what happens there.
const OF_POINTS: [&str; 6] = ["period", "slope", "step", "angle", "grid_points", "event"];
/// What multipliers say.
const OF_STABILITY: [&str; 3] = ["stability", "outside", "largest_multiplier"];
/// Mean over the period, size of the first harmonic, least and largest value.
const OF_EACH: [&str; 4] = ["mean", "harmonic1", "min", "max"];

/// Of one component of a quantity, the numbers of [`OF_EACH`].
fn numbers_of(values: &[f64], angles: &[f64]) -> [f64; 4] {
    let sum = |weight: &dyn Fn(f64) -> f64| {
        let terms = values.iter().zip(angles).map(|(x, &a)| x * weight(a));
        terms.sum::<f64>() / values.len() as f64
    };
    [
        sum(&|_| 1.0),
        2.0 * sum(&f64::cos).hypot(sum(&f64::sin)),
        values.iter().copied().fold(f64::INFINITY, f64::min),
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// Names of what is selected.
fn names_of(output: &Selection) -> Vec<String> {
    let components = match output.component {
        Some(component) => component..component + 1,
        None => 0..output.quantity.components(),
    };
    components.map(|i| output.quantity.describe(i)).collect()
}

/// All numbers of outputs of a solution, in the order of their names.
fn numbers(solution: &Solution, outputs: &[Selection]) -> Result<Vec<f64>> {
    let grid = solution.grid();
    let count = FINER * grid.points();
    let share = |k: usize| k as f64 / count as f64;
    let times: Vec<f64> = (0..count).map(|k| grid.period() * share(k)).collect();
    let angles: Vec<f64> = (0..count).map(|k| TAU * share(k)).collect();
    let mut all = Vec::new();
    for output in outputs {
        let values = solution.sample(*output, &times)?;
        let components = output.components();
        for i in 0..components {
            let of_one = values.iter().skip(i).step_by(components).copied();
            all.extend(numbers_of(&of_one.collect::<Vec<_>>(), &angles));
        }
    }
    Ok(all)
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
            BranchEnd::Failed => "an error occurred",
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
        let what = match self.locus {
            Some(event) => format!("Locus of {}s", event.describe()),
            None => "Branch".to_string(),
        };
        let mut text = format!("{what} along {}\n", self.parameter_name());
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
        self.write_stability(&mut text);
        let _ = write!(text, "  It ended as {}", self.end.describe());
        match self.explanation.is_empty() {
            true => text.push_str(".\n"),
            false => {
                let _ = writeln!(text, ": {}", self.explanation);
            }
        }
        text
    }

    /// How many points are stable, if that is known.
    fn write_stability(&self, text: &mut String) {
        let count = |verdict: Verdict| {
            let all = self.points.iter().filter_map(|point| point.stability);
            all.filter(|found| found.verdict == verdict).count()
        };
        let all = [Verdict::Stable, Verdict::Unstable, Verdict::NotKnown];
        let found = all.map(|verdict| (verdict, count(verdict)));
        let told = found.iter().filter(|(_, count)| *count > 0);
        let told: Vec<String> = told
            .map(|(verdict, count)| format!("{count} {}", verdict.describe()))
            .collect();
        if !told.is_empty() {
            let _ = writeln!(text, "  points: {}", told.join(", "));
        }
    }

    /// Writes the branch as a CSV file: a line for each point, with the parameter that is followed
    /// and those free beside it, how the step went, what happens there, what multipliers say if
    /// they were wanted, and of each component of the outputs its mean, the size of its first
    /// harmonic, and its least and largest value.
    ///
    /// # Errors
    /// If there are no points, or an output is none; [`ErrorKind::Io`]; a file that was there stays
    /// as it was.
    pub fn write_csv(&self, path: &Path, outputs: &[Selection]) -> Result<()> {
        if self.points.is_empty() {
            let message = format!("branch: it has no points: {}", self.explanation);
            return Err(Error::new(ErrorKind::NotAvailable, message));
        }
        let has_stability = self.points.iter().any(|point| point.stability.is_some());
        let mut names = self.value_names();
        names.extend(OF_POINTS.map(String::from));
        if has_stability {
            names.extend(OF_STABILITY.map(String::from));
        }
        for name in outputs.iter().flat_map(names_of) {
            names.extend(OF_EACH.map(|of| format!("{name}.{of}")));
        }
        let mut rows = Vec::new();
        for (index, point) in self.points.iter().enumerate() {
            let mut row: Vec<String> = point.values.iter().map(|x| format!("{x:?}")).collect();
            let numbers_of_step = [point.grid.period(), point.slope, point.step, point.angle];
            row.extend(numbers_of_step.map(|x| format!("{x:?}")));
            row.push(point.grid.points().to_string());
            row.push(point.event.map_or("", |event| event.describe()).to_string());
            if has_stability {
                row.extend(match &point.stability {
                    Some(found) => [
                        found.verdict.describe().to_string(),
                        found.outside.to_string(),
                        format!("{:?}", found.largest),
                    ],
                    None => [
                        Verdict::NotKnown.describe().to_string(),
                        "".into(),
                        "".into(),
                    ],
                });
            }
            if !outputs.is_empty() {
                let found = numbers(&self.solution(index)?, outputs)?;
                row.extend(found.iter().map(|x| format!("{x:?}")));
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
