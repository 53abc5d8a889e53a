//! Visits all machines, each in a process of its own, and keeps the records.

use crate::machines::FAMILIES;
use crate::machines::judge::{Checked, Verdict};
use std::process::Command;

/// What is known of a machine.
#[derive(Debug, Clone, Default)]
pub struct Record {
    pub family: usize,
    pub index: usize,
    pub what: String,
    pub outcome: String,
    pub why: String,
    pub seconds: f64,
    pub points: usize,
    pub iterations: usize,
    pub guess_iterations: usize,
    pub unknowns: usize,
    pub estimate: f64,
    pub checked: Checked,
    /// There is no periodic solution near.
    pub grows: bool,
}

impl Record {
    pub fn converged(&self) -> bool {
        self.outcome == "Converged"
    }

    pub fn verdict(&self) -> Verdict {
        self.checked.verdict(self.estimate)
    }

    /// Family, from 1, and index.
    pub fn place(&self) -> String {
        format!("{}:{}", self.family + 1, self.index)
    }

    fn read(&mut self, line: &str) -> Option<()> {
        let (key, rest) = line.split_once(' ').unwrap_or((line, ""));
        let mut words = rest.split(' ');
        let mut number = || words.next()?.parse::<f64>().ok();
        match key {
            "what" => self.what = rest.into(),
            "why" => self.why = rest.into(),
            "error" => self.checked.error = Some(number()?),
            "cold" => self.checked.from_cold = Some(number()?),
            "march" => self.checked.march = Some([number()?, number()?]),
            "grows" => self.grows = true,
            "solved" => {
                let (outcome, rest) = rest.split_once(' ')?;
                let numbers: Vec<f64> = rest.split(' ').filter_map(|x| x.parse().ok()).collect();
                let [seconds, points, iterations, guess, estimate, unknowns] = *numbers.as_slice()
                else {
                    return None;
                };
                self.outcome = outcome.into();
                (self.seconds, self.estimate) = (seconds, estimate);
                (self.points, self.iterations) = (points as usize, iterations as usize);
                (self.guess_iterations, self.unknowns) = (guess as usize, unknowns as usize);
            }
            _ => {}
        }
        Some(())
    }
}

fn visit(seed: u64, family: usize, index: usize, limit: u64) -> Record {
    let program = std::env::current_exe().expect("this program");
    let only = format!("{}:{index}", family + 1);
    let output = Command::new(program)
        .args(["--seed", &seed.to_string(), "--only", &only])
        .args(["--limit", &limit.to_string()])
        .output()
        .expect("this program runs");
    let mut record = Record {
        family,
        index,
        ..Record::default()
    };
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        record.read(line);
    }
    if record.outcome.is_empty() {
        use std::os::unix::process::ExitStatusExt;
        const PROCESSOR_TIME: i32 = 24;
        let text = String::from_utf8_lossy(&output.stderr);
        let message = text
            .lines()
            .find(|line| !line.trim().is_empty())
            .unwrap_or("");
        (record.outcome, record.why) = match output.status.signal() {
            Some(PROCESSOR_TIME) => ("TimeLimit".into(), format!("more than {limit} s")),
            _ => ("Crash".into(), format!("{}: {message}", output.status)),
        };
        record.seconds = if record.outcome == "TimeLimit" {
            60.0
        } else {
            f64::NAN
        };
        record.estimate = f64::INFINITY;
    }
    record
}

/// All machines of all families.
pub fn visit_all(seed: u64, count: usize, limit: u64) -> Vec<Record> {
    let mut records = Vec::new();
    for index in 0..count {
        for family in 0..FAMILIES.len() {
            let record = visit(seed, family, index, limit);
            let (place, verdict) = (record.place(), record.verdict());
            if !record.converged() || verdict != Verdict::Right {
                println!("{place} {}: {verdict:?} {}", record.outcome, record.why);
            }
            records.push(record);
        }
        let converged = records.iter().filter(|r| r.converged()).count();
        let seconds: f64 = records.iter().map(|r| r.seconds).sum();
        println!("{converged} of {} converged, {seconds:.1} s", records.len());
    }
    records.sort_by_key(|record| (record.family, record.index));
    records
}
