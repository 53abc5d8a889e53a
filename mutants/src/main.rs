//! Changes the library on purpose in a sample of places and tells which changes no test notices.
//!
//! All changes are compiled into one copy of the tree, each behind a switch that the environment
//! sets, so that a mutant costs the tests that reach it and no build.
//!
//! ```text
//! periodyn-mutants ROOT WORK [OPTION...]
//! ```
//!
//! ROOT is the tree, WORK a folder for the copy and for results: what is done is not done again.
//!
//! | option | |
//! |---|---|
//! | `--seed S` | which sample; 1 |
//! | `--count N` | how large it is; 300 |
//! | `--slowest S` | tests that take more seconds are left out; 60 |
//! | `--tests A,B` | of the integration tests these files alone |
//! | `--lib` | the library's own tests alone |
//! | `--report` | says what is known so far |

mod binaries;
mod copy;
mod find;
mod report;
mod sample;
mod schemata;
mod trial;
mod values;

use copy::Folders;
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;
use trial::Results;

/// A change that tests are known to notice; without it being caught nothing is believed.
const KNOWN: &str = "src/motion/rotation.rs: times_skew: - for + #1";
/// Seconds of tests for each mutant: all get the first share before any gets the next.
const SHARES: [f64; 4] = [5.0, 30.0, 200.0, f64::INFINITY];

struct Settings {
    folders: Folders,
    seed: u64,
    count: usize,
    slowest: u64,
    only_library: bool,
    only_report: bool,
}

fn settings() -> Option<Settings> {
    let mut arguments = std::env::args().skip(1);
    let folder = |text: String| std::path::absolute(PathBuf::from(text)).ok();
    let folders = Folders {
        root: folder(arguments.next()?)?,
        work: folder(arguments.next()?)?,
        tests: Vec::new(),
    };
    let mut settings = Settings {
        folders,
        seed: 1,
        count: 300,
        slowest: 60,
        only_library: false,
        only_report: false,
    };
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--seed" => settings.seed = arguments.next()?.parse().ok()?,
            "--count" => settings.count = arguments.next()?.parse().ok()?,
            "--slowest" => settings.slowest = arguments.next()?.parse().ok()?,
            "--tests" => {
                let names = arguments.next()?;
                settings.folders.tests = names.split(',').map(str::to_string).collect();
            }
            "--lib" => settings.only_library = true,
            "--report" => settings.only_report = true,
            _ => return None,
        }
    }
    Some(settings)
}

fn run(settings: &Settings) -> io::Result<()> {
    let folders = &settings.folders;
    std::fs::create_dir_all(&folders.work)?;
    let all = sample::all(&folders.root)?;
    println!("{} mutants in all", all.len());
    let mut mutants = sample::in_order_of(settings.seed, all);
    // The known one is the first, and not of the sample.
    let known = mutants.iter().position(|mutant| mutant.name == KNOWN);
    let known = known.ok_or_else(|| io::Error::other(format!("{KNOWN}: there is none")))?;
    let known = mutants.remove(known);
    mutants.insert(0, known);
    let numbers = copy::make(folders, &mutants, settings.count + 1)?;
    let binaries = binaries::build(folders, settings.only_library)?;
    println!("{} test programs", binaries.len());
    let tests = binaries::baseline(folders, &binaries, settings.slowest)?;
    println!("{} tests pass without a mutant", tests.len());
    let mut results = Results::open(folders)?;
    let sampled = numbers.get(1..).unwrap_or_default();
    let named = |number: usize| (number, mutants[number].name.as_str());
    if !settings.only_report {
        trial::attempt(
            folders,
            &binaries,
            &tests,
            named(0),
            SHARES[3],
            &mut results,
        )?;
        let by = results.caught.get(KNOWN);
        let by = by.ok_or_else(|| io::Error::other(format!("{KNOWN} was not caught")))?;
        println!("{KNOWN}: caught by {by}");
        for most in SHARES {
            for &number in sampled {
                if !results.caught.contains_key(&mutants[number].name) {
                    let mutant = named(number);
                    trial::attempt(folders, &binaries, &tests, mutant, most, &mut results)?;
                }
            }
            println!("{}", report::text(&mutants, sampled, &tests, &results));
        }
    }
    let text = report::text(&mutants, sampled, &tests, &results);
    std::fs::write(folders.work.join("report.txt"), &text)?;
    print!("{text}");
    Ok(())
}

fn main() -> ExitCode {
    let Some(settings) = settings() else {
        eprintln!("periodyn-mutants ROOT WORK [OPTION...]; src/main.rs tells the options");
        return ExitCode::from(2);
    };
    match run(&settings) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
