//! A plate of rubber that flaps through large angles, on 15 grid points: time and memory of its
//! periodic solve, by iteration and directly, against the number of its nodes.
//!
//! Each case runs in a process of its own, whose largest memory is read at its end, for the mean
//! of its Newton steps.
//!
//!     cargo bench --bench shells [-- --case METHOD ELEMENTS NODES]
//!
//! One of 1e5 unknowns a point, which takes half an hour on two threads, and 18 GiB:
//! `cargo bench --bench shells -- --case two_threads 91 3`.
//!
//! And modes of thin square plates on fine meshes of few nodes a side, beside the figures of an
//! independent program for the same meshes: `cargo bench --bench shells -- --modes`.

mod common;

use common::fits::{exponent, largest_memory};
use common::models::shells::{flapping_plate, square_plate};
use common::table::Table;
use periodyn::output::{Modes, Solution};
use periodyn::solve::{LinearMethod, ModesOptions, Outcome, PeriodicOptions};
use std::process::Command;
use std::time::{Duration, Instant};

const SWING: f64 = 0.6;
const POINTS: usize = 15;

/// Elements along the plate, half as many across it, and nodes a side of each.
type Size = (usize, usize);

const ITERATIVE: [Size; 4] = [(2, 5), (4, 5), (8, 5), (16, 5)];
const DIRECT: [Size; 3] = [(1, 5), (2, 5), (4, 5)];

/// What the process of a case tells, in this order.
const TITLES: [&str; 11] = [
    "unknowns a point",
    "seconds",
    "MiB",
    "iterations",
    "products",
    "most of a solve",
    "s a product",
    "s a linearisation",
    "preconditioners",
    "s of each",
    "s a factorisation",
];

/// Solves one case and prints its record.
fn run(method: &str, elements: usize, nodes: usize) {
    let (model, period) = flapping_plate(SWING, [elements, elements.div_ceil(2)], nodes);
    let options = PeriodicOptions {
        linear: match method {
            "direct" => LinearMethod::Direct,
            _ => LinearMethod::Iterative(None),
        },
        // However much they take.
        work_limit: 0.0,
        threads: if method == "two_threads" { 2 } else { 1 },
        ..PeriodicOptions::with_grid_points(POINTS)
    };
    let start = Instant::now();
    let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    let report = solution.report();
    eprintln!("{report}");
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    let details = solution.details();
    let (record, timings) = (details.periodic().unwrap(), &details.timings);
    let iterative = record.iterative.as_ref();
    let iterations = details.report.iterations.len();
    let products = iterative.map_or(&[][..], |record| &record.products);
    let preconditioners = iterative.map_or(0, |record| record.factorisations);
    let of = |time: Duration, times: usize| format!("{:.4}", time.as_secs_f64() / times as f64);
    let total = products.iter().sum::<usize>();
    let cells = cells![
        6 * details.system.nodes(),
        format!("{seconds:.2}"),
        format!("{:.0}", largest_memory().unwrap_or(f64::NAN)),
        iterations,
        total,
        products.iter().max().unwrap_or(&0),
        of(timings.substitution, total),
        of(timings.assembly, iterations),
        preconditioners,
        of(timings.preconditioner + timings.interface, preconditioners),
        of(timings.factorisation, iterations),
    ];
    println!("record,{}", cells.join(","));
}

/// Runs a case in a process of its own.
fn record(method: &str, (elements, nodes): Size) -> Vec<String> {
    let program = std::env::current_exe().unwrap();
    let arguments = ["--case", method, &elements.to_string(), &nodes.to_string()];
    let output = Command::new(program).args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let Some(line) = text.lines().find_map(|line| line.strip_prefix("record,")) else {
        panic!("{}", String::from_utf8_lossy(&output.stderr));
    };
    line.split(',').map(String::from).collect()
}

/// Whether a plate is clamped along an edge or free, nodes a side and elements, and its six lowest
/// frequencies `ω a² √(ρh/D)` by another program.
const FINE: [(bool, Size, [f64; 6]); 4] = [
    (
        true,
        (2, 32),
        [3.47632, 8.53416, 21.3086, 27.2423, 31.0615, 54.4958],
    ),
    (
        true,
        (3, 16),
        [3.47256, 8.51171, 21.2916, 27.2104, 30.9958, 54.2968],
    ),
    (
        false,
        (2, 32),
        [13.4673, 19.5900, 24.2589, 34.7797, 34.7797, 60.9994],
    ),
    (
        false,
        (3, 16),
        [13.4686, 19.5961, 24.2700, 34.8123, 34.8123, 61.0896],
    ),
];

/// Finds these modes.
fn modes_of_plates() {
    let titles = [
        "clamped",
        "nodes a side",
        "elements a side",
        "frequency",
        "other program",
    ];
    let mut table = Table::new("shells_modes", &titles);
    for (clamped, (nodes, elements), given) in FINE {
        let (model, unit) = square_plate(1e-3, nodes, elements, clamped);
        let rigid = if clamped { 0 } else { 6 };
        let options = ModesOptions {
            count: rigid + given.len(),
            ..ModesOptions::default()
        };
        let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
        assert_eq!(modes.outcome(), Outcome::Converged, "{}", modes.report());
        for (mode, given) in modes.modes()[rigid..].iter().zip(given) {
            let found = mode.eigenvalue.im / unit;
            let text = format!("{found:.5}");
            table.row(cells![clamped, nodes, elements, text, given]);
            // A unit of the last digit that is given.
            let digit = if given < 10.0 { 1e-5 } else { 1e-4 };
            assert!((found - given).abs() <= digit, "{found} {given}");
        }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if arguments.iter().any(|a| a == "--modes") {
        return modes_of_plates();
    }
    if let Some(at) = arguments.iter().position(|a| a == "--case") {
        let count = |i: usize| arguments[at + i].parse().unwrap();
        run(&arguments[at + 1], count(2), count(3));
        return;
    }
    let titles: Vec<&str> = ["method", "elements", "nodes a side"]
        .into_iter()
        .chain(TITLES)
        .collect();
    let mut table = Table::new("shells", &titles);
    let mut fits = Vec::new();
    for (method, sizes) in [("iterative", &ITERATIVE[..]), ("direct", &DIRECT)] {
        let mut records = Vec::new();
        for &size in sizes {
            let cells = record(method, size);
            let before = cells![method, size.0, size.1];
            table.row(&[&before[..], &cells].concat());
            records.push(cells);
        }
        // Of what the larger half of the cases took.
        let of = |column: usize| {
            let number = |cells: &[String], i: usize| cells[i].parse::<f64>().unwrap();
            let points = records[records.len() / 2 - 1..].iter();
            exponent(
                &points
                    .map(|r| (number(r, 0), number(r, column)))
                    .collect::<Vec<_>>(),
            )
        };
        let columns: &[usize] = match method {
            "iterative" => &[1, 2, 4, 6, 7, 9],
            _ => &[1, 2, 7, 10],
        };
        fits.extend(columns.iter().map(|&i| (method, TITLES[i], of(i))));
    }
    let mut table = Table::new("shells_exponents", &["method", "of", "exponent"]);
    for (method, what, exponent) in fits {
        table.row(cells![method, what, format!("{exponent:.2}")]);
    }
}
