//! Error against time: Periodyn's collocation, its shooting and its marching, on one thread.
//! `benches/peers/accuracy.py` does the same with another code.
//!
//! Errors are the largest over a period relative to the range of each curve, positions, velocities,
//! forces and torques, against a converged solution of the same mesh. A march begins at the
//! reference configuration, as one must who does not know the solution, and goes on until its last
//! period is as near as wanted.

mod common;

use common::models::beams::{forced_cantilever, rotor_blade};
use common::models::four_bar::{FOUR_BAR_PERIOD, spatial_four_bar};
use common::table::{Table, directory};
use periodyn::elements::Coordinate;
use periodyn::model::Model;
use periodyn::output::{JointQuantity, NodeQuantity, ResolvedIn, Solution};
use periodyn::solve::{
    MarchEnd, MarchOptions, MarchStart, Outcome, PeriodicOptions, ShootingOptions,
};
use std::f64::consts::TAU;
use std::time::Instant;

/// Times of a period at which curves are compared. Numbers of steps are multiples of it.
const SAMPLES: usize = 50;
/// A solve is repeated until it has taken so many seconds; the shortest time counts.
const SPENT: f64 = 0.5;

/// Curves of a solution at times, and the angle that the frame of the model has turned.
type Curves = fn(&Solution, &[f64]) -> Vec<Vec<f64>>;

struct Case {
    name: &'static str,
    model: Model,
    period: f64,
    curves: Curves,
    titles: &'static [&'static str],
    grids: &'static [usize],
    /// Of the solution that counts as exact.
    finest: usize,
    steps: &'static [usize],
    shooting_steps: &'static [usize],
    /// Most periods of a march.
    periods: usize,
    spectral_radii: &'static [f64],
}

/// One component of values that come in groups.
fn component(values: &[f64], count: usize, index: usize) -> Vec<f64> {
    values.iter().skip(index).step_by(count).copied().collect()
}

fn node(solution: &Solution, node: usize, times: &[f64]) -> [Vec<Vec<f64>>; 2] {
    [(NodeQuantity::Position, 3), (NodeQuantity::Velocity, 6)].map(|(quantity, count)| {
        let values = solution.node(node, quantity, times).unwrap();
        (0..3).map(|i| component(&values, count, i)).collect()
    })
}

fn reaction(solution: &Solution, joint: usize, axes: ResolvedIn, times: &[f64]) -> Vec<Vec<f64>> {
    let values = solution
        .joint(joint, JointQuantity::Reaction(axes), times)
        .unwrap();
    (0..6).map(|i| component(&values, 6, i)).collect()
}

/// Height and its rate of the rocker's end, and the motor's torque.
fn four_bar_curves(solution: &Solution, times: &[f64]) -> Vec<Vec<f64>> {
    // The rocker is the first bar of three of the same number of nodes.
    let end = solution.model().node_count() / 3 - 1;
    let [position, velocity] = node(solution, end, times);
    let torque = JointQuantity::DrivingEffort(Coordinate::Rotation1);
    vec![
        position[2].clone(),
        velocity[2].clone(),
        solution.joint(3, torque, times).unwrap(),
    ]
}

/// The tip's position along and upwards, its rate upwards, and the bending moment at the root.
fn cantilever_curves(solution: &Solution, times: &[f64]) -> Vec<Vec<f64>> {
    let [position, velocity] = node(solution, solution.model().node_count() - 1, times);
    let root = reaction(solution, 0, ResolvedIn::Space, times);
    vec![
        position[0].clone(),
        position[2].clone(),
        velocity[2].clone(),
        root[4].clone(),
    ]
}

/// The tip's deflection in flap and lag in the turning frame, the rate of flap, and moments at the
/// root in flap and lag.
fn blade_curves(solution: &Solution, times: &[f64]) -> Vec<Vec<f64>> {
    let [position, velocity] = node(solution, solution.model().node_count() - 1, times);
    let lag = times.iter().zip(&position[1]).zip(&position[2]);
    let root = reaction(solution, 1, ResolvedIn::First, times);
    vec![
        position[0].clone(),
        lag.map(|((t, y), z)| {
            let (sine, cosine) = (TAU * t).sin_cos();
            cosine * y + sine * z
        })
        .collect(),
        velocity[0].clone(),
        root[4].iter().map(|m| -m).collect(),
        root[3].clone(),
    ]
}

fn cases() -> Vec<Case> {
    let (rod, rod_period) = forced_cantilever(4, 2);
    let (blade, blade_period) = rotor_blade(16, 1);
    vec![
        Case {
            name: "spatial four-bar",
            model: spatial_four_bar(8, 1),
            period: FOUR_BAR_PERIOD,
            curves: four_bar_curves,
            titles: &["x3 of B", "v3 of B", "torque of the motor"],
            grids: &[11, 13, 15, 17, 19, 21, 25, 29, 33, 41, 51],
            finest: 101,
            steps: &[150, 200, 300, 400, 600, 1200],
            shooting_steps: &[150, 300, 600],
            periods: 5,
            spectral_radii: &[0.5],
        },
        Case {
            name: "forced cantilever",
            model: rod,
            period: rod_period,
            curves: cantilever_curves,
            titles: &[
                "tip along",
                "tip upwards",
                "rate upwards",
                "moment at the root",
            ],
            grids: &[7, 9, 11, 13, 15, 17, 19, 25, 31, 41],
            finest: 81,
            steps: &[50, 100, 200, 400, 800],
            shooting_steps: &[50, 100, 200, 400],
            periods: 30,
            spectral_radii: &[0.5, 0.9],
        },
        Case {
            name: "rotor blade",
            model: blade,
            period: blade_period,
            curves: blade_curves,
            titles: &["flap", "lag", "rate of flap", "flap moment", "lag moment"],
            grids: &[5, 7, 9, 11, 13, 15, 19, 25, 31],
            finest: 61,
            steps: &[50, 100, 200, 400, 800],
            shooting_steps: &[50, 100, 200, 400],
            periods: 20,
            spectral_radii: &[0.5, 0.9],
        },
    ]
}

/// Largest difference relative to the range of each exact curve.
fn error(exact: &[Vec<f64>], found: &[Vec<f64>]) -> f64 {
    let one = |(exact, found): (&Vec<f64>, &Vec<f64>)| {
        let (low, high) = exact
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &x| {
                (a.min(x), b.max(x))
            });
        let largest = exact
            .iter()
            .zip(found)
            .fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
        largest / (high - low)
    };
    exact.iter().zip(found).map(one).fold(0.0, f64::max)
}

/// The shortest time of some solves, and the last solution.
fn timed(mut solve: impl FnMut() -> Solution) -> (f64, Solution) {
    let (mut shortest, mut spent) = (f64::INFINITY, 0.0);
    loop {
        let start = Instant::now();
        let solution = solve();
        let took = start.elapsed().as_secs_f64();
        shortest = shortest.min(took);
        spent += took;
        if spent > SPENT {
            return (shortest, solution);
        }
    }
}

fn main() {
    let mut table = Table::new(
        "accuracy",
        &[
            "model",
            "method",
            "parameter",
            "periods",
            "seconds",
            "error",
        ],
    );
    let observe = &mut |_, _: &_| true;
    for case in cases() {
        let times = |from: usize| -> Vec<f64> {
            (from * SAMPLES..(from + 1) * SAMPLES)
                .map(|i| case.period * i as f64 / SAMPLES as f64)
                .collect()
        };
        let first = times(0);
        let options = PeriodicOptions::with_grid_points(case.finest);
        let finest = Solution::solve(&case.model, case.period, &options, observe).unwrap();
        assert_eq!(finest.outcome(), Outcome::Converged);
        let exact = (case.curves)(&finest, &first);
        let mut reference = String::from("t,") + &case.titles.join(",");
        for (i, t) in first.iter().enumerate() {
            reference += &format!("\n{t}");
            exact
                .iter()
                .for_each(|c| reference += &format!(",{}", c[i]));
        }
        let name = format!("exact_{}.csv", case.name.replace([' ', '-'], "_"));
        std::fs::write(directory().join(name), reference + "\n").unwrap();

        let mut row =
            |method: &str, parameter: String, periods: usize, seconds: f64, error: f64| {
                table.row(cells![
                    case.name,
                    method,
                    parameter,
                    periods,
                    format!("{seconds:.6}"),
                    format!("{error:.3e}")
                ]);
            };
        for &points in case.grids {
            let options = PeriodicOptions::with_grid_points(points);
            let (seconds, solution) =
                timed(|| Solution::solve(&case.model, case.period, &options, observe).unwrap());
            if solution.outcome() == Outcome::Converged {
                let found = (case.curves)(&solution, &first);
                row(
                    "collocation",
                    format!("N = {points}"),
                    1,
                    seconds,
                    error(&exact, &found),
                );
            }
        }
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let options = PeriodicOptions::with_error_tolerance(tolerance);
            let (seconds, solution) =
                timed(|| Solution::solve(&case.model, case.period, &options, observe).unwrap());
            if solution.outcome() == Outcome::Converged {
                let found = (case.curves)(&solution, &first);
                let parameter = format!("tolerance {tolerance:e}");
                row("adaptive", parameter, 1, seconds, error(&exact, &found));
            }
        }
        for &radius in case.spectral_radii {
            for &steps in case.steps {
                let step = case.period / steps as f64;
                let mut options = MarchOptions::with_step(
                    step,
                    MarchEnd::Duration(case.periods as f64 * case.period),
                );
                options.period = Some(case.period);
                options.spectral_radius = radius;
                let start = Instant::now();
                let solution = Solution::march(&case.model, &options, observe).unwrap();
                let seconds = start.elapsed().as_secs_f64();
                if solution.outcome() != Outcome::Converged {
                    println!(
                        "march of {steps} steps: {}",
                        solution.details().report.explanation
                    );
                    continue;
                }
                for period in 1..=case.periods {
                    let found = (case.curves)(&solution, &times(period - 1));
                    let parameter = format!("{steps} steps; radius {radius}");
                    let part = period as f64 / case.periods as f64;
                    row(
                        "marching",
                        parameter,
                        period,
                        part * seconds,
                        error(&exact, &found),
                    );
                }
            }
        }
        for &steps in case.shooting_steps {
            let options = ShootingOptions {
                steps,
                start: MarchStart::Reference,
                ..ShootingOptions::default()
            };
            let start = Instant::now();
            let solution =
                Solution::solve_shooting(&case.model, case.period, &options, observe).unwrap();
            let seconds = start.elapsed().as_secs_f64();
            if solution.outcome() == Outcome::Converged {
                let found = (case.curves)(&solution, &first);
                row(
                    "shooting",
                    format!("{steps} steps"),
                    1,
                    seconds,
                    error(&exact, &found),
                );
            } else {
                println!(
                    "shooting, {steps} steps: {}",
                    solution.details().report.explanation
                );
            }
        }
    }
}
