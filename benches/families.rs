//! Families of solutions by the solves that they cost: points of branches with their stability,
//! multipliers, sensitivities. With arguments only the tables whose names contain one of them.

mod common;

use common::models::beams::{forced_cantilever, free_strip, rotor_blade, shaken_rod};
use common::table::Table;
use common::timing::{median, processor_time};
use periodyn::model::{Model, Target};
use periodyn::output::{Modes, Solution};
use periodyn::quantity::{Feature, NodeQuantity, Quantity};
use periodyn::solve::{
    BranchOptions, Condition, Dependent, Free, InitialGuess, ModesOptions, Outcome, OutputIs,
    PeriodicOptions, Phase, SensitivityOptions, Solved, StabilityOptions, follow_branch,
    solve_periodic, solve_sensitivities, solve_stability,
};
use std::f64::consts::TAU;
use std::sync::Arc;
use std::time::Duration;

const REPETITIONS: usize = 3;

fn main() {
    let asked: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    for (name, measure) in [
        ("multipliers", multipliers as fn()),
        ("branches", branches),
        ("sensitivities", sensitivities),
        ("backbone", backbone),
    ] {
        if asked.is_empty() || asked.iter().any(|a| name.contains(&a[..])) {
            measure();
        }
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1}", 1e3 * time.as_secs_f64())
}

/// A cold solve and its processor time, in the middle of several.
fn cold(model: &Model, period: f64, points: usize) -> (Duration, Solved) {
    let options = PeriodicOptions::with_grid_points(points);
    let solve = || {
        let solve = solve_periodic(model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(solve.report.outcome, Outcome::Converged);
        solve
    };
    let time = median((0..REPETITIONS).map(|_| processor_time(solve).0));
    (time, solve())
}

fn multipliers() {
    let titles = [
        "model",
        "N",
        "solve ms",
        "multipliers ms",
        "number",
        "steps",
        "solves",
    ];
    let mut table = Table::new("multipliers", &titles);
    for (name, (model, period), points) in [
        ("rotor blade, 16 × 1", rotor_blade(16, 1), 31),
        ("rotor blade, 16 × 4", rotor_blade(16, 4), 31),
        ("forced cantilever, 4 × 2", forced_cantilever(4, 2), 31),
        ("forced cantilever, 4 × 4", forced_cantilever(4, 4), 41),
    ] {
        let (solve_time, solve) = cold(&model, period, points);
        let analyse = || solve_stability(&solve, &StabilityOptions::default()).unwrap();
        let time = median((0..REPETITIONS).map(|_| processor_time(analyse).0));
        let found = analyse();
        assert_eq!(found.outcome, Outcome::Converged);
        table.row(cells![
            name,
            points,
            milliseconds(solve_time),
            milliseconds(time),
            found.multipliers.len(),
            found.steps,
            format!("{:.2}", time.as_secs_f64() / solve_time.as_secs_f64()),
        ]);
    }
}

fn branches() {
    let titles = [
        "model",
        "N",
        "points",
        "solve ms",
        "point ms",
        "with stability ms",
        "solves",
    ];
    let mut table = Table::new("branches", &titles);
    for (name, (model, period), points) in [
        ("forced cantilever, 4 × 2", forced_cantilever(4, 2), 31),
        ("forced cantilever, 4 × 4", forced_cantilever(4, 4), 41),
        ("the same, 3 N", shaken_rod(3.0, 4, 4), 41),
    ] {
        let (solve_time, _) = cold(&model, period, points);
        let each = |stability: Option<StabilityOptions>| {
            let options = BranchOptions {
                periodic: PeriodicOptions::with_grid_points(points),
                range: [TAU / period, 1.2 * TAU / period],
                stability,
                ..BranchOptions::default()
            };
            let follow = || {
                follow_branch(&model, period, Free::Frequency, &options, &mut |_, _| true).unwrap()
            };
            let count = follow().points.len();
            let times = (0..REPETITIONS).map(|_| processor_time(follow).0);
            (count, median(times) / count as u32)
        };
        let (_, without) = each(None);
        let (count, with) = each(Some(StabilityOptions::default()));
        table.row(cells![
            name,
            points,
            count,
            milliseconds(solve_time),
            milliseconds(without),
            milliseconds(with),
            format!("{:.2}", with.as_secs_f64() / solve_time.as_secs_f64()),
        ]);
    }
}

fn sensitivities() {
    let titles = ["model", "N", "solve ms", "parameters", "all ms", "solves"];
    let mut table = Table::new("sensitivities", &titles);
    for (name, (mut model, period), points) in [
        ("rotor blade, 16 × 1", rotor_blade(16, 1), 31),
        ("forced cantilever, 4 × 4", forced_cantilever(4, 4), 41),
    ] {
        let mut parameters = vec![Free::Frequency];
        for element in 0..4 {
            for target in [Target::BeamStiffness(element), Target::BeamMass(element)] {
                let number = model
                    .add_parameter(&format!("{target:?}"), 1.0, 1.0)
                    .unwrap();
                model.move_by_parameter(number, target, 1.0).unwrap();
                parameters.push(Free::Parameter(number));
            }
        }
        let (solve_time, solve) = cold(&model, period, points);
        let tip = Quantity::Node(model.node_count() - 1, NodeQuantity::Position);
        let features = [Feature::Mean, Feature::Cosine(1), Feature::Sine(1)];
        let features: Vec<Feature> = features.into_iter().chain([Feature::Cosine(2)]).collect();
        let of = |feature| Dependent::Feature(tip.component(2), feature);
        let dependents: Vec<Dependent> = features.into_iter().map(of).collect();
        for count in [1, parameters.len()] {
            let options = SensitivityOptions::default();
            let asked = &parameters[..count];
            let find = || {
                let nothing = (&[][..], &[][..]);
                solve_sensitivities((&model, &solve), nothing, &dependents, asked, &options)
            };
            find().unwrap();
            let time = median((0..REPETITIONS).map(|_| processor_time(find).0));
            table.row(cells![
                name,
                points,
                milliseconds(solve_time),
                count,
                milliseconds(time),
                format!("{:.2}", time.as_secs_f64() / solve_time.as_secs_f64()),
            ]);
        }
    }
}

/// The free motion of a strip in its first mode with this amplitude of the tip.
fn free_motion(strip: (&Model, usize), points: usize, amplitude: f64) -> Solution {
    let (model, damping) = strip;
    let options = ModesOptions {
        count: 1,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(model, &options, &mut |_, _| true).unwrap();
    let tip = model.node_count() - 1;
    let shape = modes.shape(0, tip).unwrap()[1].re;
    let linear = modes.motion(0, amplitude / shape).unwrap();
    let free = [Free::Frequency, Free::Parameter(damping)];
    let moves = Quantity::Node(tip, NodeQuantity::Position).component(1);
    let given = OutputIs {
        output: moves,
        feature: Feature::Cosine(1),
        value: amplitude,
        scale: Some(amplitude),
    };
    let conditions: [Arc<dyn Condition>; 2] = [Arc::new(Phase), Arc::new(given)];
    let grid = periodyn::fourier::TimeGrid::new(points, linear.grid().period()).unwrap();
    let options = PeriodicOptions {
        guess: InitialGuess::State(linear.prolonged(grid).unwrap()),
        ..PeriodicOptions::with_grid_points(points)
    };
    let given = (&free[..], &conditions[..]);
    let found =
        Solution::solve_conditioned(model, grid.period(), given, &options, &mut |_, _| true);
    let found = found.unwrap();
    assert_eq!(found.outcome(), Outcome::Converged);
    found
}

fn backbone() {
    let titles = [
        "model",
        "N",
        "points",
        "range",
        "largest angle",
        "damping found",
        "iterations",
        "point ms",
    ];
    let mut table = Table::new("backbone", &titles);
    for (name, (model, damping), points, to) in [
        ("strip, 40 × 1", free_strip(40, 1), 17, 1.05),
        ("strip, 10 × 4", free_strip(10, 4), 17, 1.05),
    ] {
        let first = free_motion((&model, damping), points, 0.05);
        let start = TAU / first.grid().period();
        let options = BranchOptions {
            periodic: PeriodicOptions {
                guess: InitialGuess::State(first.details().state.clone()),
                ..PeriodicOptions::with_grid_points(points)
            },
            free: vec![Free::Parameter(damping)],
            conditions: vec![Arc::new(Phase)],
            range: [start, to * start],
            motion_scale: 0.5,
            ..BranchOptions::default()
        };
        let follow = || {
            let mut observe = |_: usize, _: &_| true;
            follow_branch(
                first.model(),
                TAU / start,
                Free::Frequency,
                &options,
                &mut observe,
            )
            .unwrap()
        };
        let branch = follow();
        let times = (0..REPETITIONS).map(|_| processor_time(follow).0);
        let count = branch.points.len();
        let most = |of: &dyn Fn(&periodyn::solve::BranchPoint) -> f64| {
            branch.points.iter().map(of).fold(0.0, f64::max)
        };
        table.row(cells![
            name,
            points,
            count,
            format!(
                "{:?}, to {:.4}",
                branch.end,
                branch.points[count - 1].values[0] / start
            ),
            format!("{:.3}", most(&|point| point.angle)),
            format!("{:.1e}", most(&|point| point.values[1].abs())),
            branch.iterations,
            milliseconds(median(times) / count as u32),
        ]);
    }
}
