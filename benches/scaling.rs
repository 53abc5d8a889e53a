//! Time and memory of large solves against the number of unknowns: a rotor of three blades with
//! more elements or more grid points, and the planar four-bar on fine grids.
//!
//! Each case runs in a process of its own, whose largest memory is read at its end.

mod common;

use common::fits::{exponent, largest_memory};
use common::models::beams::{planar_four_bar, rotor};
use common::table::Table;
use periodyn::output::{BeamQuantity, Solution};
use periodyn::solve::{Outcome, PeriodicOptions, Preconditioner};
use std::process::Command;
use std::time::Instant;

/// Stiffness-proportional damping of the planar four-bar, in seconds.
const DAMPING: f64 = 1e-3;
/// A solve that takes less is repeated; the shortest time counts.
const SHORT: f64 = 2.0;
/// Rounds of a case with one thread and with two, unless a round takes more seconds than this.
const ROUNDS: usize = 3;
const LONG: f64 = 60.0;

struct Case {
    series: &'static str,
    model: &'static str,
    elements: usize,
    points: usize,
    threads: usize,
}

/// What the process of a case reports.
struct Record {
    unknowns: f64,
    seconds: f64,
    mebibytes: f64,
    rest: Vec<String>,
}

fn method(solution: &Solution) -> &'static str {
    let record = solution.details().periodic();
    let record = record.and_then(|record| record.iterative.as_ref());
    match record.and_then(|record| record.preconditioner) {
        None => "direct",
        Some(Preconditioner::BodyCirculant) => "body-circulant",
        Some(Preconditioner::TimeLocal) => "time-local",
        Some(Preconditioner::Circulant) => "circulant",
    }
}

/// Solves one case and prints its record.
fn run(model: &str, elements: usize, points: usize, threads: usize) {
    let (definition, period) = match model {
        "rotor" => rotor(elements),
        _ => planar_four_bar(elements, 2, DAMPING),
    };
    let options = PeriodicOptions {
        threads,
        // However much they take.
        work_limit: 0.0,
        ..PeriodicOptions::with_grid_points(points)
    };
    let (mut seconds, mut spent) = (f64::INFINITY, 0.0);
    let solution = loop {
        let start = Instant::now();
        let solution = Solution::solve(&definition, period, &options, &mut |_, _| true).unwrap();
        let took = start.elapsed().as_secs_f64();
        seconds = seconds.min(took);
        spent += took;
        if spent > SHORT {
            break solution;
        }
    };
    let details = solution.details();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    let products = details
        .periodic()
        .and_then(|record| record.iterative.as_ref())
        .map_or(0, |r| r.products.iter().sum());
    // Axial force in the middle of the crank, at the two narrow peaks.
    let peaks = match model {
        "rotor" => [f64::NAN; 2],
        _ => [0.25, 0.75].map(|at| {
            let near: Vec<f64> = (-200..=200)
                .map(|i| period * (at + 0.05 * f64::from(i) / 200.0))
                .collect();
            let force = solution
                .beam(elements / 2, 0.0, BeamQuantity::Force, &near)
                .unwrap();
            force.iter().step_by(6).copied().fold(0.0, f64::min)
        }),
    };
    println!(
        "record,{},{seconds},{},{},{},{products},{:.1},{:.1}",
        6 * details.system.nodes() * points,
        largest_memory().unwrap_or(f64::NAN),
        method(&solution),
        details.report.iterations.len(),
        peaks[0],
        peaks[1],
    );
}

/// Runs a case in a process of its own.
fn record(case: &Case) -> Record {
    let program = std::env::current_exe().unwrap();
    let arguments = [
        "--case",
        case.model,
        &case.elements.to_string(),
        &case.points.to_string(),
        &case.threads.to_string(),
    ];
    let output = Command::new(program).args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let Some(line) = text.lines().find_map(|line| line.strip_prefix("record,")) else {
        panic!("{}", String::from_utf8_lossy(&output.stderr));
    };
    let cells: Vec<String> = line.split(',').map(String::from).collect();
    let number = |i: usize| cells[i].parse().unwrap();
    Record {
        unknowns: number(0),
        seconds: number(1),
        mebibytes: number(2),
        rest: cells[3..].to_vec(),
    }
}

/// Runs the cases one after the other, and again if that does not take long; of each the shortest
/// run counts.
fn shortest(cases: &[Case]) -> Vec<Record> {
    let mut found: Vec<Record> = cases.iter().map(record).collect();
    for _ in 1..ROUNDS {
        if found.iter().map(|record| record.seconds).sum::<f64>() > LONG {
            break;
        }
        for (case, best) in cases.iter().zip(&mut found) {
            let again = record(case);
            if again.seconds < best.seconds {
                *best = again;
            }
        }
    }
    found
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(at) = arguments.iter().position(|a| a == "--case") {
        let count = |i: usize| arguments[at + i].parse().unwrap();
        run(&arguments[at + 1], count(2), count(3), count(4));
        return;
    }
    // From 1e4 to 1e6 unknowns; the two largest with one thread and with two, side by side.
    let grids = [101, 201, 401, 801, 1023, 2047].map(|points| (5, points));
    let all = [
        (
            "rotor: elements",
            "rotor",
            &[(9, 63), (28, 63), (88, 63), (280, 63), (890, 63)][..],
        ),
        (
            "rotor: grid points",
            "rotor",
            &[(32, 17), (32, 55), (32, 175), (32, 525), (32, 1701)],
        ),
        ("planar four-bar: grid points", "planar four-bar", &grids),
    ];
    let series = all.map(|(series, model, sizes)| {
        let is_large = |place: usize| place + 2 >= sizes.len();
        let of_size = |(place, &(elements, points)): (usize, &(usize, usize))| {
            let counts = 1..if is_large(place) { 3 } else { 2 };
            let case = |threads| Case {
                series,
                model,
                elements,
                points,
                threads,
            };
            counts.map(case).collect()
        };
        let cases = sizes.iter().enumerate().map(of_size);
        cases.collect::<Vec<Vec<Case>>>()
    });

    let mut table = Table::new(
        "scaling",
        &[
            "series",
            "elements",
            "N",
            "threads",
            "unknowns",
            "seconds",
            "MiB",
            "method",
            "iterations",
            "products",
            "peak at T/4",
            "peak at 3T/4",
        ],
    );
    let mut fits = Vec::new();
    for sizes in &series {
        let (mut times, mut memory) = (Vec::new(), Vec::new());
        for (case, record) in sizes
            .iter()
            .flat_map(|cases| cases.iter().zip(shortest(cases)))
        {
            let mut row: Vec<String> = cells![
                case.series,
                case.elements,
                case.points,
                case.threads,
                record.unknowns,
                format!("{:.4}", record.seconds),
                format!("{:.0}", record.mebibytes),
            ]
            .to_vec();
            row.extend(record.rest);
            table.row(&row);
            if case.threads == 1 {
                times.push((record.unknowns, record.seconds));
                memory.push((record.unknowns, record.mebibytes));
            }
        }
        fits.push((sizes[0][0].series, exponent(&times), exponent(&memory)));
    }
    let mut table = Table::new("exponents", &["series", "threads", "time", "memory"]);
    for (series, time, memory) in fits {
        table.row(cells![
            series,
            1,
            format!("{time:.2}"),
            format!("{memory:.2}")
        ]);
    }
}
