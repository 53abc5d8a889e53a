//! Rotors of like blades, solved in whole and by what is left of one blade: processor times on one
//! thread, side by side, and bytes of the linear equations.

mod common;

use common::models::rotors::{RotorKind, bladed_rotor};
use common::timing::{median, processor_time};
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::{LinearMethod, Outcome, PeriodicOptions, Preconditioner};

const REPETITIONS: usize = 5;

fn solve(model: &Model, period: f64, options: &PeriodicOptions) -> Solution {
    let solution = Solution::solve(model, period, options, &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    solution
}

fn main() {
    println!(
        "{:24}{:>16}{:>10}{:>10}{:>8}{:>10}{:>10}",
        "blades, elements, N", "method", "all [s]", "one [s]", "ratio", "all [MB]", "one [MB]"
    );
    for (blades, elements, points, hinged) in [
        (3, 2, 33, false),
        (3, 8, 51, true),
        (5, 2, 35, true),
        (5, 4, 65, true),
        (5, 8, 65, false),
        (5, 8, 125, true),
        (7, 8, 63, false),
    ] {
        let rotor = bladed_rotor(&RotorKind::new(blades, elements, hinged));
        let models = [rotor.model.clone(), rotor.symmetric()];
        let iteration = LinearMethod::Iterative(Some(Preconditioner::BodyCirculant));
        for (name, linear) in [
            ("direct", LinearMethod::Direct),
            ("iteration", iteration),
            ("default", LinearMethod::Automatic),
        ] {
            if name == "direct" && elements * points > 300 {
                continue;
            }
            let options = PeriodicOptions {
                linear,
                ..PeriodicOptions::with_grid_points(points)
            };
            let mut times = [Vec::new(), Vec::new()];
            let mut bytes = [String::new(), String::new()];
            for _ in 0..REPETITIONS {
                for ((model, times), bytes) in models.iter().zip(&mut times).zip(&mut bytes) {
                    let (time, solution) = processor_time(|| solve(model, rotor.period, &options));
                    times.push(time);
                    let record = solution.details().periodic().unwrap().iterative.clone();
                    let size = record.map(|r| format!("{:.1}", 1e-6 * r.bytes as f64));
                    *bytes = size.unwrap_or_default();
                }
            }
            let [all, one] = times.map(|times| median(times.into_iter()).as_secs_f64());
            println!(
                "{:24}{name:>16}{all:10.3}{one:10.3}{:8.2}{:>10}{:>10}",
                format!("{blades} × {elements}, {points}"),
                all / one,
                bytes[0],
                bytes[1]
            );
        }
    }
}
