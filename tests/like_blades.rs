//! Rotors of like blades: solved by what is left of one blade, they move as in whole.

mod common;

use common::models::rotors::*;
use periodyn::model::Model;
use periodyn::output::Solution;
use periodyn::solve::*;

fn solve(model: &Model, period: f64, points: usize, linear: LinearMethod) -> Solution {
    let options = PeriodicOptions {
        grid_points: GridPoints::Fixed(points),
        linear,
        ..PeriodicOptions::default()
    };
    let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    solution
}

#[test]
fn reduced_and_whole_solutions_agree() {
    for linear in [LinearMethod::Direct, LinearMethod::Automatic] {
        for (count, elements, points, hinged) in [
            (3, 2, 33, false),
            (5, 2, 35, true),
            (5, 4, 65, true),
            (5, 8, 35, true),
        ] {
            let rotor = bladed_rotor(count, elements, hinged);
            let start = std::time::Instant::now();
            let whole = solve(&rotor.model, rotor.period, points, linear);
            let middle = start.elapsed();
            let reduced = solve(&rotor.symmetric(), rotor.period, points, linear);
            let end = start.elapsed() - middle;
            let (a, b) = (&whole.details().state, &reduced.details().state);
            println!(
                "{count} {hinged}: {:e} {middle:?} {end:?}",
                a.distance(b, 3.0)
            );
            println!("{}", whole.report());
            println!("{}", reduced.report());
        }
    }
}
