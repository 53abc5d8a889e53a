//! Large solves by one thread and by two, direct and iterative ones: wall time of each phase, and
//! what more cores would give, counted and measured.
//!
//! What a phase takes by `p` threads is predicted from its times by one and by two: the part that
//! two share goes with `1/p`, the rest stays. For factorisations the work of fronts is counted
//! instead, with the order in which they wait for each other.

mod common;

use common::models::beams::{forced_cantilever, planar_four_bar, rotor, rotor_blade};
use common::models::four_bar::{FOUR_BAR_PERIOD, spatial_four_bar};
use common::table::Table;
use periodyn::model::Model;
use periodyn::solve::{DirectCost, LinearMethod, Outcome, PeriodicOptions, Solved, solve_periodic};
use std::env::var;
use std::time::Duration;

const ROUNDS: usize = 3;
/// Numbers of threads that are predicted.
const MORE: [usize; 3] = [2, 4, 8];

struct Case {
    name: &'static str,
    model: Model,
    period: f64,
    points: usize,
    linear: LinearMethod,
}

/// Seconds of a solve.
#[derive(Clone, Copy)]
struct Times {
    total: f64,
    phases: [f64; PHASES.len()],
}

const PHASES: [&str; 7] = [
    "guess",
    "assembly",
    "factorisation",
    "preconditioner",
    "substitution",
    "estimates",
    "other",
];
const FACTORISATION: usize = 2;

fn solve(case: &Case, threads: usize) -> (Times, Solved) {
    let options = PeriodicOptions {
        linear: case.linear,
        threads,
        work_limit: 0.0,
        ..PeriodicOptions::with_grid_points(case.points)
    };
    let solved = solve_periodic(&case.model, case.period, &options, &mut |_, _| true).unwrap();
    assert_eq!(solved.report.outcome, Outcome::Converged);
    let (timings, total) = (solved.timings, solved.total_time);
    let known = [
        solved.guess_time,
        timings.assembly,
        timings.factorisation,
        timings.preconditioner + timings.interface,
        timings.substitution,
        timings.estimates,
    ];
    let other = total.saturating_sub(known.iter().sum());
    let mut phases = known.into_iter().chain([other]).map(|t| t.as_secs_f64());
    let times = Times {
        total: Duration::as_secs_f64(&total),
        phases: std::array::from_fn(|_| phases.next().unwrap_or_default()),
    };
    (times, solved)
}

/// The shortest of several solves by one thread, and by two, in turn.
fn both(case: &Case) -> ([Times; 2], Solved) {
    let mut best: [Option<Times>; 2] = [None; 2];
    let mut last = None;
    for _ in 0..ROUNDS {
        for (best, threads) in best.iter_mut().zip([1, 2]) {
            let (times, solved) = solve(case, threads);
            if best.is_none_or(|best| times.total < best.total) {
                *best = Some(times);
            }
            last = Some(solved);
        }
    }
    (best.map(Option::unwrap), last.unwrap())
}

/// Seconds by so many threads, from those by one and by two, phase by phase.
fn predicted([one, two]: [Times; 2], factors: f64, threads: usize) -> f64 {
    let phases = (0..PHASES.len()).map(|phase| {
        let (one, two) = (one.phases[phase], two.phases[phase]);
        if phase == FACTORISATION {
            return one * factors;
        }
        let shared = (2.0 * (one - two)).clamp(0.0, one);
        one - shared + shared / threads as f64
    });
    phases.sum()
}

fn main() {
    let case = |name, (model, period), points, linear| Case {
        name,
        model,
        period,
        points,
        linear,
    };
    let (direct, automatic) = (LinearMethod::Direct, LinearMethod::Automatic);
    let four_bar = |elements| (spatial_four_bar(elements, 1), FOUR_BAR_PERIOD);
    let cases = [
        case("spatial four-bar, 8", four_bar(8), 63, direct),
        case("spatial four-bar, 32", four_bar(32), 41, direct),
        case(
            "planar four-bar, 5 × 2",
            planar_four_bar(5, 2, 1e-3),
            101,
            direct,
        ),
        case(
            "forced cantilever, 4 × 4",
            forced_cantilever(4, 4),
            81,
            direct,
        ),
        case("rotor blade, 4 × 4", rotor_blade(4, 4), 81, direct),
        case("rotor, 9", rotor(9), 63, direct),
        case("rotor, 280", rotor(280), 63, automatic),
        case("rotor, 32", rotor(32), 525, automatic),
        case(
            "planar four-bar, 5 × 2",
            planar_four_bar(5, 2, 1e-3),
            801,
            automatic,
        ),
    ];
    let only = var("CASE").ok().and_then(|place| place.parse().ok());
    let columns = [
        "model",
        "N",
        "method",
        "seconds",
        "by two",
        "faster",
        "counted, 2",
        "4",
        "8",
        "of factors, 2",
        "4",
        "8",
    ];
    let mut table = Table::new("threads", &columns);
    let mut phases = Vec::new();
    for (place, case) in cases.iter().enumerate() {
        if only.is_some_and(|only: usize| only != place) {
            continue;
        }
        let (times, solved) = both(case);
        let cost = |workers| DirectCost::shared(&solved.system, case.points, workers);
        let factors = MORE.map(|workers| cost(workers) / cost(1));
        let counted = MORE.map(|workers| {
            let place = MORE.iter().position(|&other| other == workers).unwrap_or(0);
            times[0].total / predicted(times, factors[place], workers)
        });
        let is_direct = solved.periodic().is_some_and(|p| p.iterative.is_none());
        let of_factors = factors.map(|part| match is_direct {
            true => format!("{:.2}", 1.0 / part),
            false => "-".into(),
        });
        let [one, two] = times;
        table.row(cells![
            case.name,
            case.points,
            if is_direct { "direct" } else { "iterative" },
            format!("{:.3}", one.total),
            format!("{:.3}", two.total),
            format!("{:.2}", one.total / two.total),
            format!("{:.2}", counted[0]),
            format!("{:.2}", counted[1]),
            format!("{:.2}", counted[2]),
            of_factors[0],
            of_factors[1],
            of_factors[2],
        ]);
        for (phase, name) in PHASES.iter().enumerate() {
            let [one, two] = [one, two].map(|times| 1e3 * times.phases[phase]);
            if one > 0.0 {
                let row = cells![
                    case.name,
                    case.points,
                    name,
                    format!("{one:.1}"),
                    format!("{two:.1}"),
                ];
                phases.push(row.to_vec());
            }
        }
    }
    let mut table = Table::new("thread_phases", &["model", "N", "phase", "ms", "by two"]);
    phases.iter().for_each(|row| table.row(row));
}
