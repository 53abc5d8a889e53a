//! Tables of the records: CSV, and Markdown for the documentation.

use crate::keeper::Record;
use crate::machines::FAMILIES;
use crate::machines::judge::{ROUNDING, SHARP, TRUSTED, Verdict};
use std::fmt::Write;
use std::path::PathBuf;

/// Writes `output/zoo.csv` and `output/zoo.md`, and prints the latter.
pub fn write(seed: u64, count: usize, records: &[Record]) {
    let directory = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("output");
    std::fs::create_dir_all(&directory).expect("a directory");
    std::fs::write(directory.join("zoo.csv"), csv(records)).expect("a file");
    let text = markdown(seed, count, records);
    std::fs::write(directory.join("zoo.md"), &text).expect("a file");
    println!("\n{text}");
}

fn csv(records: &[Record]) -> String {
    let mut text = String::from(
        "family,index,outcome,verdict,seconds,points,iterations,guess_iterations,unknowns,estimate,error,\
         from_cold,march,march_uncertainty,what,why\n",
    );
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:e}"));
    for r in records {
        let march = r.checked.march;
        let _ = writeln!(
            text,
            "{},{},{},{:?},{:.6},{},{},{},{},{:e},{},{},{},{},\"{}\",\"{}\"",
            FAMILIES[r.family].0,
            r.index,
            r.outcome,
            r.verdict(),
            r.seconds,
            r.points,
            r.iterations,
            r.guess_iterations,
            r.unknowns,
            r.estimate,
            number(r.checked.error),
            number(r.checked.from_cold),
            number(march.map(|m| m[0])),
            number(march.map(|m| m[1])),
            r.what,
            r.why.replace('"', "'"),
        );
    }
    text
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn row(name: &str, records: &[&Record]) -> String {
    let count = |test: &dyn Fn(&Record) -> bool| records.iter().filter(|r| test(r)).count();
    let converged = count(&Record::converged);
    let seconds: Vec<f64> = records
        .iter()
        .map(|r| r.seconds)
        .filter(|s| s.is_finite())
        .collect();
    let longest = seconds.iter().copied().fold(0.0, f64::max);
    format!(
        "| {name} | {} | {converged} | {} | {} | {} | {:.3} | {longest:.1} |\n",
        records.len(),
        count(&|r| r.converged() && r.verdict() == Verdict::False),
        count(&|r| r.converged() && r.verdict() == Verdict::Unchecked),
        records.len() - converged,
        median(seconds),
    )
}

fn markdown(seed: u64, count: usize, records: &[Record]) -> String {
    let mut text = format!(
        "Seed {seed}, {count} machines of each family. Processor time in seconds, one thread.\n\n\
         | family | machines | converged | false | unchecked | failed | median | longest |\n\
         |---|---|---|---|---|---|---|---|\n"
    );
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        let here: Vec<&Record> = records.iter().filter(|r| r.family == family).collect();
        text += &row(name, &here);
    }
    let all: Vec<&Record> = records.iter().collect();
    text += &row("**all**", &all);
    text += &estimates(records);
    text += &failures(records);
    text
}

/// How good the estimates of converged solutions are.
fn estimates(records: &[Record]) -> String {
    let pairs: Vec<(f64, f64)> = records
        .iter()
        .filter(|r| r.converged())
        .filter_map(|r| Some((r.checked.error?, r.estimate)))
        .collect();
    let trusted = pairs
        .iter()
        .filter(|(error, estimate)| *error <= TRUSTED * estimate + ROUNDING);
    let above: Vec<_> = pairs
        .iter()
        .filter(|(_, estimate)| *estimate > ROUNDING)
        .collect();
    let sharp = above
        .iter()
        .filter(|(error, estimate)| *estimate <= SHARP * error);
    let other = records
        .iter()
        .filter(|r| r.checked.from_cold.is_some_and(|x| x > 1e-3))
        .count();
    let marched: Vec<_> = records
        .iter()
        .filter(|r| r.checked.march.is_some())
        .collect();
    let disproved = marched
        .iter()
        .filter(|r| r.verdict() == Verdict::False)
        .count();
    format!(
        "\nTrue error at most {TRUSTED} × estimate: {} of {}. Estimate at most {SHARP} × true error, of those above \
         {ROUNDING:.0e}: {} of {}. Marched: {}, disproved {disproved}. Finer grids from cold that found another \
         solution: {other}.\n",
        trusted.count(),
        pairs.len(),
        sharp.count(),
        above.len(),
        marched.len(),
    )
}

fn failures(records: &[Record]) -> String {
    let mut text = String::new();
    let wrong = |r: &&Record| !r.converged() || r.verdict() != Verdict::Right;
    if records.iter().any(|r| wrong(&r)) {
        text += "\n| machine | outcome | N | s | why | what |\n|---|---|---|---|---|---|\n";
    }
    for r in records.iter().filter(wrong) {
        let outcome = match (r.converged(), r.verdict()) {
            (true, verdict) => format!(
                "{:?}: error {:?}, estimate {:.1e}, march {:?}",
                verdict, r.checked.error, r.estimate, r.checked.march
            ),
            _ => r.outcome.clone(),
        };
        let why = r.why.replace('|', "/");
        let _ = writeln!(
            text,
            "| {} | {outcome} | {} | {:.1} | {why} | {} |",
            r.place(),
            r.points,
            r.seconds,
            r.what
        );
    }
    text
}
