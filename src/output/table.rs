//! Tables of sampled quantities, written as CSV.

use super::Solution;
use super::write::write_file;
use crate::error::{Error, Result, require_finite};
use crate::quantity::Selection;
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

    /// Appends the components of a quantity, named after `label` (by default the quantity) and the
    /// component; or one of them, named `label`.
    ///
    /// # Errors
    /// As [`Solution::sample`], or a column of that name is there already.
    pub fn add(
        &mut self,
        solution: &Solution,
        what: impl Into<Selection>,
        label: Option<&str>,
    ) -> Result<()> {
        let Selection {
            quantity,
            component,
        } = what.into();
        let values = solution.sample(
            Selection {
                quantity,
                component,
            },
            &self.times,
        )?;
        let (default, components) = match component {
            None => (quantity.to_string(), quantity.component_names()),
            Some(component) => (quantity.describe(component), &[""][..]),
        };
        self.add_components(label.unwrap_or(&default), components, &values)
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
        self.add_components(label, &[""], values)
    }

    /// Appends columns `label.component`; `values` has the components of each time together.
    fn add_components(&mut self, label: &str, components: &[&str], values: &[f64]) -> Result<()> {
        if label.is_empty() {
            return Err(Error::value("label", "a name", "an empty text"));
        }
        let name = |component: &str| match component {
            "" => label.to_owned(),
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
