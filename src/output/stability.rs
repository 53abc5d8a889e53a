//! The readable report of an analysis of stability.

use crate::solve::{Outcome, Stability, Verdict};
use std::fmt::{Result, Write};

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
