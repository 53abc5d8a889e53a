//! Rotors of like blades, drawn from a seed, solved in whole and by what is left of one blade:
//! processor times on one thread, side by side, and bytes of the linear equations.

#[path = "../tests/common/random.rs"]
mod random;

mod common;

use common::models::rotors::{BladedRotor, RotorKind, bladed_rotor};
use common::timing::{median, processor_time};
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::{Outcome, PeriodicOptions};
use random::Random;
use std::time::Duration;

/// Rotors of each number of blades.
const ROTORS: u64 = 8;
const REPETITIONS: usize = 3;
const SEED: u64 = 20;

/// What a solve took.
struct Cost {
    time: Duration,
    solution: Solution,
}

fn solve(model: &Model, period: f64, options: &PeriodicOptions) -> Option<Cost> {
    let (time, solution) =
        processor_time(|| Solution::solve(model, period, options, &mut |_, _| true).unwrap());
    (solution.outcome() == Outcome::Converged).then_some(Cost { time, solution })
}

fn drawn(blades: usize, number: u64) -> (RotorKind, BladedRotor) {
    let mut r = Random::of(&[SEED, blades as u64, number]);
    let kind = RotorKind {
        speed: r.between(2.0, 7.0),
        blade: r.decades(0.3, 10.0),
        tower: [r.decades(0.3, 10.0), r.decades(0.2, 1.0)],
        wind: r.between(-2.0, 2.0),
        length: r.between(0.5, 1.1),
        mass: r.decades(0.5, 2.0),
        ..RotorKind::new(blades, r.pick(&[2, 3, 4, 6, 8]), r.percent(50))
    };
    (kind, bladed_rotor(&kind))
}

fn milliseconds(time: Duration) -> f64 {
    1e3 * time.as_secs_f64()
}

/// Parts of the time: start, analysis, assembly, factors of all kinds, substitution, estimates.
fn parts(cost: &Cost) -> [f64; 6] {
    let details = cost.solution.details();
    let t = &details.timings;
    [
        details.guess_time,
        t.analysis,
        t.assembly,
        t.factorisation + t.preconditioner + t.interface,
        t.substitution,
        t.estimates,
    ]
    .map(milliseconds)
}

fn compare(blades: usize, number: u64, adaptive: bool, details: bool) -> Option<f64> {
    let (kind, rotor) = drawn(blades, number);
    let points = blades * ((45 / blades) | 1);
    let options = match adaptive {
        true => PeriodicOptions::default(),
        false => PeriodicOptions::with_grid_points(points),
    };
    let models = [rotor.model.clone(), rotor.symmetric()];
    let mut costs: [Vec<Cost>; 2] = [Vec::new(), Vec::new()];
    for _ in 0..REPETITIONS {
        for (model, costs) in models.iter().zip(&mut costs) {
            costs.push(solve(model, rotor.period, &options)?);
        }
    }
    let [all, one] = costs.each_ref().map(|costs| {
        let times = costs.iter().map(|cost| cost.time);
        median(times)
    });
    let ratio = all.as_secs_f64() / one.as_secs_f64();
    let grids = costs.each_ref().map(|c| c[0].solution.grid().points());
    let (off, length) = (
        match grids[0] == grids[1] {
            true => {
                let [all, one] = costs.each_ref().map(|c| &c[0].solution.details().state);
                all.distance(one, 3.0)
            }
            false => f64::NAN,
        },
        kind.elements,
    );
    println!(
        "{blades} × {length}, {}, N = {grids:?}: {:8.1} {:8.1} ms, {ratio:5.2} times, off {off:.1e}",
        if kind.hinged { "hinged " } else { "clamped" },
        milliseconds(all),
        milliseconds(one)
    );
    if details {
        for costs in &costs {
            let cost = &costs[0];
            let d = cost.solution.details();
            let record = d.periodic().and_then(|p| p.iterative.as_ref());
            println!(
                "    start {:.1} analysis {:.1} assembly {:.1} factors {:.1} substitution {:.1} estimates {:.1} of {:.1}",
                parts(cost)[0],
                parts(cost)[1],
                parts(cost)[2],
                parts(cost)[3],
                parts(cost)[4],
                parts(cost)[5],
                milliseconds(d.total_time),
            );
            println!(
                "    start iterations {}, iterations {}, products {:?}, bytes {:?}, grids {:?}",
                d.guess_iterations,
                d.total_iterations,
                record.map(|r| r.products.clone()),
                record.map(|r| r.bytes),
                d.periodic().map(|p| p
                    .grids
                    .iter()
                    .map(|g| (g.points, g.iterations))
                    .collect::<Vec<_>>()),
            );
        }
    }
    Some(ratio)
}

/// Solves one rotor many times, for a profiler.
fn profile(of: &str) {
    let numbers: Vec<u64> = of.split(',').map(|x| x.parse().unwrap()).collect();
    let (_, rotor) = drawn(numbers[0] as usize, numbers[1]);
    let blades = numbers[0] as usize;
    let options = PeriodicOptions::with_grid_points(blades * ((45 / blades) | 1));
    let model = match numbers[2] {
        0 => rotor.model.clone(),
        _ => rotor.symmetric(),
    };
    for _ in 0..20 {
        solve(&model, rotor.period, &options);
    }
}

fn main() {
    if let Ok(of) = std::env::var("PROFILE") {
        return profile(&of);
    }
    let details = std::env::var("DETAILS").is_ok();
    for adaptive in [false, true] {
        for blades in [5, 3] {
            let ratios = (0..ROTORS).filter_map(|i| compare(blades, i, adaptive, details));
            let mut ratios: Vec<f64> = ratios.collect();
            ratios.sort_by(f64::total_cmp);
            println!("{blades} blades, adaptive {adaptive}: {ratios:.2?}");
        }
    }
}
