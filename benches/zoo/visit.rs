//! One machine, in a process of its own: what comes out is printed line by line, so that what was
//! known before a crash or a limit is not lost.

use crate::machines::{FAMILIES, Machine, judge, machine};
use periodyn::output::Solution;
use periodyn::solve::Outcome;
use rustix::process::{Resource, Rlimit, setrlimit};
use rustix::time::{ClockId, clock_gettime};

/// Most memory, in bytes.
const MEMORY: u64 = 6 << 30;
/// Solves from cold on finer grids, for comparison, where that is likely to take no longer than
/// seconds.
const CHEAP: f64 = 0.3;
const FEW: usize = 64;
/// What a solve is doing is shown after so many seconds, if asked for.
const TELL: f64 = 0.5;
/// Of so many models one is marched.
const MARCHED: usize = 10;

/// Processor time of this process.
fn processor_time() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

/// The system ends this process after that much more processor time.
fn limit(seconds: u64) {
    let current = Some(processor_time().ceil() as u64 + seconds);
    let limit = Rlimit {
        current,
        maximum: None,
    };
    setrlimit(Resource::Cpu, limit).expect("a limit of processor time");
}

fn tell(line: &str) {
    use std::io::Write;
    println!("{line}");
    std::io::stdout().flush().expect("a place to write to");
}

/// Solves and judges a machine.
///
/// A solve and each check of it end after `most` seconds of processor time.
pub fn visit(seed: u64, family: usize, index: usize, most: u64, verbose: bool) {
    let memory = Rlimit {
        current: Some(MEMORY),
        maximum: None,
    };
    setrlimit(Resource::As, memory).expect("a limit of memory");
    let machine = machine(seed, family, index);
    tell(&format!("what {}: {}", FAMILIES[family].0, machine.what));
    limit(most);
    let start = processor_time();
    let mut told = 0.0;
    let solved = judge::solve_watched(&machine, &mut |stage, iteration| {
        let now = processor_time() - start;
        if verbose && now > told + TELL {
            told = now;
            println!("{now:6.1} s: {stage:?} {iteration:?}");
        }
        true
    });
    let seconds = processor_time() - start;
    let solution = match solved {
        Ok(solution) => solution,
        Err(error) => {
            tell(&format!("solved Error {seconds} 0 0 0 inf 0"));
            tell(&format!("why {error}"));
            return;
        }
    };
    let details = solution.details();
    tell(&format!(
        "solved {:?} {seconds} {} {} {} {:e} {}",
        solution.outcome(),
        solution.grid().points(),
        details.report.iterations.len(),
        details.guess_iterations,
        solution.diagnostics().error_estimate,
        solution.unknowns(),
    ));
    if verbose {
        println!("{}", solution.report());
    }
    if !details.report.explanation.is_empty() {
        tell(&format!(
            "why {}",
            details.report.explanation.replace('\n', " ")
        ));
    }
    if solution.outcome() == Outcome::Converged {
        let marched = index % MARCHED == 3 || verbose;
        check(&machine, &solution, seconds, most, marched);
    } else {
        limit(most);
        if judge::grows(&machine) {
            tell("grows");
        }
    }
}

fn check(machine: &Machine, solution: &Solution, seconds: f64, most: u64, marched: bool) {
    limit(most);
    let error = judge::check(machine, solution);
    if let Some(error) = error {
        tell(&format!("error {error:e}"));
    }
    if seconds < CHEAP && solution.grid().points() < FEW {
        limit(most);
        if let Some(difference) = judge::check_from_cold(machine, solution) {
            tell(&format!("cold {difference:e}"));
        }
    }
    let estimate = solution.diagnostics().error_estimate;
    let checked = judge::Checked {
        error,
        ..judge::Checked::default()
    };
    // What the finer grid leaves in doubt is marched in any case.
    if marched || checked.verdict(estimate) != judge::Verdict::Right {
        limit(most);
        if let Some([away, unsure]) = judge::march(machine, solution) {
            tell(&format!("march {away:e} {unsure:e}"));
        }
    }
}
