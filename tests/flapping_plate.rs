//! A plate that flaps through large angles: its periodic motion by direct and iterative solvers,
//! against marching in time.

mod models;

use models::shells::flapping_plate;
use periodyn::output::Solution;
use periodyn::solve::*;

const POINTS: usize = 21;

fn solve(linear: LinearMethod) -> (Solution, Vec<Iteration>) {
    let (model, period) = flapping_plate(0.6, [2, 1], 4);
    let mut options = PeriodicOptions {
        linear,
        ..PeriodicOptions::with_grid_points(POINTS)
    };
    options.newton.tolerance = 1e-10;
    let mut iterations = Vec::new();
    let solution = Solution::solve(&model, period, &options, &mut |stage, iteration| {
        if stage == Stage::Newton {
            iterations.push(*iteration);
        }
        true
    })
    .unwrap();
    let report = solution.report();
    println!("{report}");
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    (solution, iterations)
}

#[test]
fn a_flapping_plate_moves_as_a_march_from_its_state_does() {
    let (solution, iterations) = solve(LinearMethod::Direct);
    println!("{iterations:#?}");
    let solved = solution.details();
    let (system, period) = (&solved.system, solved.grid.period());
    let length = system.scales().length;

    let (iterative, _) = solve(LinearMethod::Automatic);
    let apart = iterative.details().state.distance(&solved.state, length);
    assert!(apart < 1e-9, "{apart:e}");
    let preconditioner = Preconditioner::BodyCirculant;
    let (iterative, _) = solve(LinearMethod::Iterative(Some(preconditioner)));
    let apart = iterative.details().state.distance(&solved.state, length);
    assert!(apart < 1e-9, "{apart:e}");

    // A march of one period comes back to where it began, to its error, which goes with h².
    let at_start = |node: usize| &solved.states_of(node)[0];
    let start = StartState {
        motions: (0..system.nodes()).map(|n| at_start(n).motion).collect(),
        twists: (0..system.nodes()).map(|n| at_start(n).twist).collect(),
        internal: None,
    };
    let miss = |steps: usize| {
        let options = MarchOptions {
            start: MarchStart::State(start.clone()),
            period: Some(period),
            ..MarchOptions::with_step(period / steps as f64, MarchEnd::Duration(period))
        };
        let march = Solution::march(solution.model(), &options, &mut |_, _| true).unwrap();
        assert_eq!(march.outcome(), Outcome::Converged, "{}", march.report());
        let solved = march.details();
        let tip = system.nodes() - 2;
        let states = solved.states_of(tip);
        let end = states[states.len() - 1].motion;
        (end.position - start.motions[tip].position).norm()
    };
    let misses = [miss(100), miss(200)];
    println!("{misses:?}");
    assert!(
        misses[1] < 2e-3 && misses[1] < 0.35 * misses[0],
        "{misses:?}"
    );
}
