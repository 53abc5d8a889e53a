//! Stability of solutions, and the readable report of its analysis.

use super::Solution;
use crate::error::{Error, ErrorKind};
use crate::solve::{Kind, Outcome, Stability, StabilityOptions, Verdict, solve_stability};
use std::fmt::{Result, Write};

impl Solution {
    /// Finds the multipliers of a periodic solution, see [`solve_stability`]. From then on its
    /// report has a line on them.
    ///
    /// # Errors
    /// As [`solve_stability`].
    pub fn solve_stability(&self, options: &StabilityOptions) -> crate::error::Result<Stability> {
        let found = solve_stability(self.details(), options)?;
        if !matches!(found.outcome, Outcome::Cancelled | Outcome::Singular) {
            // The first stays.
            let _ = self.multipliers.set(found.without_shapes());
        }
        Ok(found)
    }

    /// Real and imaginary parts of the Floquet multipliers, the largest first: those that shooting
    /// has found, or of a periodic solution those that were asked for first, or else by default
    /// options. A march has none.
    ///
    /// # Errors
    /// [`ErrorKind::NotAvailable`] of other solutions, and where multipliers cannot be found; as
    /// [`solve_stability`].
    pub fn floquet(&self) -> crate::error::Result<Vec<[f64; 2]>> {
        match &self.details().kind {
            Kind::Shooting { floquet, .. } => return Ok(floquet.clone()),
            Kind::March(_) => return Ok(Vec::new()),
            Kind::Periodic(_) | Kind::Equilibrium { .. } | Kind::SmallMotion => {}
        }
        if self.multipliers.get().is_none() {
            self.solve_stability(&StabilityOptions::default())?;
        }
        let Some(found) = self.multipliers.get() else {
            let message = "solution: the equations of small disturbances are singular";
            return Err(Error::new(ErrorKind::NotAvailable, message));
        };
        let parts = found.multipliers.iter().map(|m| [m.value.re, m.value.im]);
        Ok(parts.collect())
    }

    /// The line of the report on multipliers that were asked for.
    pub(super) fn write_stability(&self, text: &mut String) -> Result {
        let Some(found) = self.multipliers.get() else {
            return Ok(());
        };
        write!(text, "  {}: ", found.verdict.describe())?;
        let known = found.multipliers.len();
        let outside = found.outside();
        write!(
            text,
            "{outside} of {known} multipliers outside the unit circle, the largest {:.6} in size",
            found.largest()
        )?;
        match found.frequency_limit.is_infinite() {
            true => writeln!(text),
            false => writeln!(text, "; frequencies up to {:.6}", found.frequency_limit),
        }
    }
}

impl Verdict {
    /// A few words for people.
    pub fn describe(self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::Unstable => "unstable",
            Verdict::NotKnown => "not known to be stable",
        }
    }
}

impl Stability {
    /// The verdict, how far it holds, and a table of the multipliers.
    pub fn report(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = self.write_report(&mut text);
        text
    }

    fn write_report(&self, text: &mut String) -> Result {
        write!(text, "Stability: {}", self.verdict.describe())?;
        match self.outcome {
            Outcome::Cancelled => write!(text, "; cancelled")?,
            Outcome::Singular => write!(text, "; the equations of a step are singular")?,
            _ if self.frequency_limit.is_infinite() => {}
            _ => write!(
                text,
                ", for frequencies up to {:.6} ({:.1} of the period)",
                self.frequency_limit,
                self.frequency_limit * self.period / std::f64::consts::TAU
            )?,
        }
        writeln!(
            text,
            "\n  {} of {} multipliers, largest {:.6} in size; {} steps to the period, {:.4} s",
            self.multipliers.len(),
            self.states,
            self.largest(),
            self.steps,
            self.time.as_secs_f64()
        )?;
        if !self.multipliers.is_empty() {
            writeln!(
                text,
                "  mode            |rho|           Re rho           Im rho            Re mu\
                 \u{20}           Im mu  frequency    error"
            )?;
        }
        for (number, m) in self.multipliers.iter().enumerate() {
            writeln!(
                text,
                "  {number:4} {:16.9e} {:16.9e} {:16.9e} {:16.9e} {:16.9e} {:10.4} {:8.1e}{}",
                m.value.norm(),
                m.value.re,
                m.value.im,
                m.exponent.re,
                m.exponent.im,
                m.frequency,
                m.error,
                if m.trivial { "  (a shift)" } else { "" }
            )?;
        }
        Ok(())
    }
}
