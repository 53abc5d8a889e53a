//! Rotors of like blades, drawn from a seed, solved in whole and by what is left of one blade:
//! processor times on one thread, side by side, and bytes of the linear equations.
//!
//! `ROTORS` says how many of each number of blades (8), `BLADES` which number alone, `NUMBER` which
//! of those drawn alone, `SEED` another seed than 20, `ADAPTIVE` that grids are not given, `PHASES`
//! that the milliseconds of each phase are printed, too.

mod common;

use common::Random;
use common::models::rotors::{RotorKind, bladed_rotor};
use common::timing::{median, processor_time};
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::{Outcome, PeriodicOptions};
use std::env::var;
use std::time::Duration;

const REPETITIONS: usize = 3;
/// Unless another one is asked for.
const SEED: u64 = 20;
/// Of each number of blades.
const ROTORS: u64 = 8;
/// Grid points, about.
const POINTS: usize = 45;

/// A number that is asked for.
fn asked(name: &str) -> Option<u64> {
    var(name).ok().and_then(|number| number.parse().ok())
}

fn drawn(blades: usize, number: u64) -> RotorKind {
    let seed = asked("SEED").unwrap_or(SEED);
    let mut r = Random::of(&[seed, blades as u64, number]);
    RotorKind {
        speed: r.between(2.0, 7.0),
        blade: r.decades(0.3, 10.0),
        tower: [r.decades(0.3, 10.0), r.decades(0.2, 1.0)],
        wind: r.between(-2.0, 2.0),
        length: r.between(0.5, 1.1),
        mass: r.decades(0.5, 2.0),
        ..RotorKind::new(blades, r.pick(&[2, 3, 4, 6, 8]), r.percent(50))
    }
}

fn solve(model: &Model, period: f64, options: &PeriodicOptions) -> (Duration, Solution) {
    let watch = &mut |_, _: &_| true;
    let solved = processor_time(|| Solution::solve(model, period, options, watch).unwrap());
    assert_eq!(solved.1.outcome(), Outcome::Converged);
    solved
}

/// Times faster by one blade, and times smaller.
fn compare(kind: &RotorKind, options: &[PeriodicOptions; 2]) -> [f64; 2] {
    let rotor = bladed_rotor(kind);
    let models = [rotor.model.clone(), rotor.symmetric()];
    let mut times = [Vec::new(), Vec::new()];
    let mut solutions = [None, None];
    for _ in 0..REPETITIONS {
        let both = models.iter().zip(options).zip(&mut times);
        for (((model, options), times), last) in both.zip(&mut solutions) {
            let (time, solution) = solve(model, rotor.period, options);
            times.push(time);
            *last = Some(solution);
        }
    }
    let [all, one] = times.map(|times| median(times.into_iter()).as_secs_f64());
    let [whole, reduced] = solutions.map(Option::unwrap);
    let [points, reduced_points] = [&whole, &reduced].map(|s| s.grid().points());
    let off = match points == reduced_points {
        true => whole
            .details()
            .state
            .distance(&reduced.details().state, 3.0),
        false => f64::NAN,
    };
    let [bytes, reduced_bytes] = [&whole, &reduced].map(|solution| {
        let record = &solution.details().periodic().unwrap().iterative;
        record
            .as_ref()
            .map_or(0.0, |record| 1e-6 * record.bytes as f64)
    });
    let ratio = all / one;
    let hinged = if kind.hinged { "hinged" } else { "clamped" };
    println!(
        "{} × {} {hinged:8}{points:4}{reduced_points:4}{:9.1}{:9.1}{ratio:7.2}\
         {bytes:8.2}{reduced_bytes:8.2}{off:10.1e}",
        kind.blades,
        kind.elements,
        1e3 * all,
        1e3 * one
    );
    if var("PHASES").is_ok() {
        for solution in [&whole, &reduced] {
            print_phases(solution);
        }
    }
    [ratio, bytes / reduced_bytes]
}

/// Milliseconds of each phase of a solve.
fn print_phases(solution: &Solution) {
    let solve = solution.details();
    let t = solve.timings;
    let known = [
        ("guess", solve.guess_time),
        ("analysis", t.analysis),
        ("assembly", t.assembly),
        ("factors", t.factorisation),
        ("preconditioner", t.preconditioner),
        ("interface", t.interface),
        ("substitution", t.substitution),
        ("estimates", t.estimates),
    ];
    let other = solve.total_time - known.iter().map(|(_, time)| *time).sum::<Duration>();
    for (name, time) in known.into_iter().chain([("other", other)]) {
        print!("  {name}{:6.2}", 1e3 * time.as_secs_f64());
    }
    println!();
}

fn main() {
    let rotors = asked("ROTORS").unwrap_or(ROTORS);
    let numbers = match asked("NUMBER") {
        Some(number) => number..number + 1,
        None => 0..rotors,
    };
    println!(
        "blades × elements, N all one, all [ms] one [ms] ratio, all [MB] one [MB], difference"
    );
    let only = asked("BLADES");
    for blades in [5, 4, 3] {
        if only.is_some_and(|only| only != blades as u64) {
            continue;
        }
        let options = match var("ADAPTIVE").is_ok() {
            true => [(); 2].map(|()| PeriodicOptions::default()),
            false => {
                let shared = blades * ((POINTS / blades) | (blades % 2));
                // The whole takes an odd number.
                [shared | 1, shared].map(PeriodicOptions::with_grid_points)
            }
        };
        let ratios = numbers.clone();
        let ratios = ratios.map(|i| compare(&drawn(blades, i), &options));
        let ratios: Vec<[f64; 2]> = ratios.collect();
        for (i, what) in ["faster", "smaller"].iter().enumerate() {
            let mut times: Vec<f64> = ratios.iter().map(|ratio| ratio[i]).collect();
            times.sort_by(f64::total_cmp);
            println!("{blades} blades, times {what}: {times:.2?}");
        }
    }
}
