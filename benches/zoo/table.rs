//! Tables of the records: CSV, and Markdown for the documentation.

use crate::keeper::Record;
use crate::machines::FAMILIES;
use crate::machines::judge::{ROUNDING, SHARP, TRUSTED, Verdict};
use std::fmt::Write;
use std::path::PathBuf;

/// Writes `output/zoo.csv` and `output/zoo.md`, and prints the latter, which replaces the page's
/// tables if asked for.
pub fn write(seed: u64, count: usize, records: &[Record], docs: bool) {
    let directory = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("output");
    std::fs::create_dir_all(&directory).expect("a directory");
    std::fs::write(directory.join("zoo.csv"), csv(records)).expect("a file");
    let text = markdown(seed, count, records);
    std::fs::write(directory.join("zoo.md"), &text).expect("a file");
    println!("\n{text}");
    if docs {
        replace_in_docs(&text);
    }
}

/// Puts the tables between the marks of the page.
fn replace_in_docs(tables: &str) {
    const MARKS: [&str; 2] = ["<!-- tables by script/zoo -->\n", "<!-- end of tables -->"];
    let page = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/robustness.md");
    let text = std::fs::read_to_string(&page).expect("docs/robustness.md");
    let (before, rest) = text
        .split_once(MARKS[0])
        .expect("the mark before the tables");
    let (_, after) = rest
        .split_once(MARKS[1])
        .expect("the mark after the tables");
    let text = [before, MARKS[0], "\n", tables, "\n", MARKS[1], after].concat();
    std::fs::write(page, text).expect("docs/robustness.md");
}

fn csv(records: &[Record]) -> String {
    let mut text = String::from(
        "family,index,outcome,verdict,seconds,points,iterations,guess_iterations,unknowns,\
         estimate,error,from_cold,march,march_uncertainty,what,why\n",
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

/// Numbers of a family, or of all.
struct Count {
    machines: usize,
    converged: usize,
    false_: usize,
    unchecked: usize,
    not_periodic: usize,
    failed: usize,
    median: f64,
    longest: f64,
}

impl Count {
    fn of(records: &[&Record]) -> Self {
        let count = |test: &dyn Fn(&Record) -> bool| records.iter().filter(|r| test(r)).count();
        let verdict = |wanted| count(&|r| r.converged() && r.verdict() == wanted);
        let times = records.iter().map(|r| r.seconds);
        let seconds: Vec<f64> = times.filter(|s| s.is_finite()).collect();
        Count {
            machines: records.len(),
            converged: count(&Record::converged),
            false_: verdict(Verdict::False),
            unchecked: verdict(Verdict::Unchecked),
            not_periodic: count(&|r| r.grows),
            failed: count(&|r| !r.converged() && !r.grows),
            longest: seconds.iter().copied().fold(0.0, f64::max),
            median: median(seconds),
        }
    }

    fn row(&self, name: &str) -> String {
        format!(
            "| {name} | {} | {} | {} | {} | {} | {} | {:.3} | {:.1} |\n",
            self.machines,
            self.converged,
            self.false_,
            self.unchecked,
            self.not_periodic,
            self.failed,
            self.median,
            self.longest
        )
    }

    /// Per cent of the machines that have a periodic solution.
    fn rate(&self) -> f64 {
        100.0 * self.converged as f64 / (self.machines - self.not_periodic).max(1) as f64
    }
}

fn markdown(seed: u64, count: usize, records: &[Record]) -> String {
    let mut text = format!(
        "Seed {seed}, {count} machines of each family. Processor time of the solve in seconds, \
         one thread.\n\n\
         | family | machines | converged | false | unchecked | not periodic | failed | median s | \
         longest s |\n\
         |---|---|---|---|---|---|---|---|---|\n"
    );
    let mut least = f64::INFINITY;
    for (family, (name, _)) in FAMILIES.iter().enumerate() {
        let here: Vec<&Record> = records.iter().filter(|r| r.family == family).collect();
        let numbers = Count::of(&here);
        least = least.min(numbers.rate());
        text += &numbers.row(&format!("{} {name}", family + 1));
    }
    let all = Count::of(&records.iter().collect::<Vec<_>>());
    text += &all.row("all");
    text += &estimates(records);
    text += &limits(&all, least);
    text += &failures(records);
    text
}

/// What is asked of the library, and whether it does.
fn limits(all: &Count, least: f64) -> String {
    let line =
        |what: String, met: bool| format!("| {what} | {} |\n", if met { "yes" } else { "**no**" });
    [
        "\n| limit | met |\n|---|---|\n".into(),
        line(
            format!("97 % converge: {:.1} %", all.rate()),
            all.rate() >= 97.0,
        ),
        line(
            format!("90 % of each family: {least:.1} % at least"),
            least >= 90.0,
        ),
        line(format!("none falsely: {}", all.false_), all.false_ == 0),
        line(
            format!("median 0.2 s: {:.3} s", all.median),
            all.median <= 0.2,
        ),
        line(
            format!("longest 15 s: {:.1} s", all.longest),
            all.longest <= 15.0,
        ),
    ]
    .concat()
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
        "\nTrue error at most {TRUSTED} × estimate: {} of {}. Estimate at most {SHARP} × true \
         error, of those above \
         {ROUNDING:.0e}: {} of {}. Marched: {}, disproved {disproved}. Finer grids from cold that \
         found another \
         solution: {other}.\n",
        trusted.count(),
        pairs.len(),
        sharp.count(),
        above.len(),
        marched.len(),
    )
}

/// What a record has to be named for; none if all is well.
fn fault(r: &Record) -> Option<String> {
    if r.grows {
        return Some(format!("{}, not periodic", r.outcome));
    }
    if !r.converged() {
        return Some(r.outcome.clone());
    }
    let number = |x: Option<f64>| x.map_or("unknown".into(), |x| format!("{x:.1e}"));
    match r.verdict() {
        Verdict::Right => None,
        Verdict::Unchecked => Some("converged, unchecked".into()),
        Verdict::False => Some(format!(
            "**false**: estimate {:.1e}, error {}, march {}",
            r.estimate,
            number(r.checked.error),
            number(r.checked.march.map(|m| m[0]))
        )),
    }
}

fn failures(records: &[Record]) -> String {
    let faults: Vec<_> = records
        .iter()
        .filter_map(|r| Some((r, fault(r)?)))
        .collect();
    if faults.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "\n| machine | outcome | N | s | why | what it is |\n|---|---|---|---|---|---|\n",
    );
    for (r, outcome) in faults {
        let _ = writeln!(
            text,
            "| {} | {outcome} | {} | {:.1} | {} | {} |",
            r.place(),
            r.points,
            r.seconds,
            r.why.replace('|', "/"),
            r.what
        );
    }
    text
}
