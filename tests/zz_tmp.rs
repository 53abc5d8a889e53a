mod common;
use common::models::rotors::*;
use common::*;
use periodyn::output::Solution;
use periodyn::solve::*;
#[test]
fn timing() {
    for (count, elements, points, hinged) in [
        (3, 2, 33, false),
        (5, 2, 35, true),
        (5, 4, 65, true),
        (5, 8, 35, true),
        (3, 8, 51, false),
        (5, 8, 125, false),
    ] {
        let rotor = bladed_rotor(&RotorKind::new(count, elements, hinged));
        for linear in [
            LinearMethod::Iterative(Some(Preconditioner::BodyCirculant)),
            LinearMethod::Automatic,
        ] {
            let options = PeriodicOptions {
                linear,
                ..options(points)
            };
            let mut all = Vec::new();
            for model in [&rotor.model, &rotor.symmetric()] {
                let start = std::time::Instant::now();
                let solution =
                    Solution::solve(model, rotor.period, &options, &mut |_, _| true).unwrap();
                let time = start.elapsed();
                assert_eq!(
                    solution.outcome(),
                    Outcome::Converged,
                    "{}",
                    solution.report()
                );
                println!("  {time:?}");
                for line in solution.report().lines().filter(|l| {
                    l.contains("time:") || l.contains("of it") || l.contains("products")
                }) {
                    println!("   {line}");
                }
                all.push((solution, time));
            }
            let off = all[0]
                .0
                .details()
                .state
                .distance(&all[1].0.details().state, 3.0);
            println!(
                "{count} {elements} {points} {hinged} {linear:?}: {off:.1e} ratio {:.2}",
                all[0].1.as_secs_f64() / all[1].1.as_secs_f64()
            );
        }
    }
}
