//! Families of free motions of conservative beams, that leave a linear mode.

mod common;

use common::models::beams::*;
use common::*;
use periodyn::fourier::TimeGrid;
use periodyn::model::Model;
use periodyn::output::{Modes, NodeQuantity, Solution};
use periodyn::quantity::{Feature, Quantity};
use periodyn::solve::*;
use std::f64::consts::TAU;
use std::sync::Arc;

fn free_motion(strip: (&Model, usize), points: usize, amplitude: f64) -> (f64, Solution) {
    let (model, damping) = strip;
    let modes_options = ModesOptions {
        count: 1,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(model, &modes_options, &mut |_, _| true).unwrap();
    let tip = model.node_count() - 1;
    let shape = modes.shape(0, tip).unwrap()[1].re;
    let linear = modes.motion(0, amplitude / shape).unwrap();
    let moves = Quantity::Node(tip, NodeQuantity::Position).component(1);
    let given = OutputIs {
        output: moves,
        feature: Feature::Cosine(1),
        value: amplitude,
        scale: Some(amplitude),
    };
    let conditions: [Arc<dyn Condition>; 2] = [Arc::new(Phase), Arc::new(given)];
    let grid = TimeGrid::new(points, linear.grid().period()).unwrap();
    let options = PeriodicOptions {
        guess: InitialGuess::State(linear.prolonged(grid).unwrap()),
        ..options(points)
    };
    let free = [Free::Frequency, Free::Parameter(damping)];
    let given = (&free[..], &conditions[..]);
    let t = std::time::Instant::now();
    let found =
        Solution::solve_conditioned(model, grid.period(), given, &options, &mut |_, _| true)
            .unwrap();
    println!("first: {:?} {:?}", t.elapsed(), found.details().report);
    println!("{:?}", found.details().timings);
    (TAU / linear.grid().period(), found)
}

#[test]
fn probe() {
    let env = |n: &str, d: f64| {
        std::env::var(n)
            .ok()
            .and_then(|x| x.parse().ok())
            .unwrap_or(d)
    };
    let (elements, degree) = (env("EL", 40.0) as usize, env("DEG", 1.0) as usize);
    let (model, damping) = free_strip(elements, degree);
    let linear = match env("LIN", 0.0) as i32 {
        1 => LinearMethod::Direct,
        2 => LinearMethod::Iterative(None),
        _ => LinearMethod::Automatic,
    };
    let (omega, first) = free_motion((&model, damping), env("N", 17.0) as usize, env("AMP", 0.05));
    let tip = model.node_count() - 1;
    let start = TAU / first.grid().period();
    println!("linear {omega} first {start} ratio {}", start / omega);
    let opts = BranchOptions {
        periodic: PeriodicOptions {
            linear,
            guess: InitialGuess::State(first.details().state.clone()),
            ..options(env("N", 17.0) as usize)
        },
        free: vec![Free::Parameter(damping)],
        conditions: vec![Arc::new(Phase)],
        range: [start, env("TO", 1.05) * start],
        motion_scale: env("SCALE", 0.5),
        point_limit: env("LIMIT", 100.0) as usize,
        ..BranchOptions::default()
    };
    let t = std::time::Instant::now();
    let mut count = 0;
    let branch = follow_branch(
        first.model(),
        TAU / start,
        Free::Frequency,
        &opts,
        &mut |_: usize, p: &BranchPoint| {
            count += 1;
            let angle = p
                .state
                .node(tip)
                .iter()
                .map(|m| {
                    let r = m.rotation;
                    f64::atan2(r[(1, 0)], r[(0, 0)]).abs()
                })
                .fold(0.0, f64::max);
            println!(
                "{count} w/w0 {:.6} damp {:.1e} step {:.2e} angle {:.3} its {} tip {:.4} t {:?}",
                p.values[0] / omega,
                p.values[1],
                p.step,
                p.angle,
                p.iterations,
                angle,
                t.elapsed()
            );
            true
        },
    )
    .unwrap();
    println!(
        "{:?} {} points, rejected {}, its {} {}",
        branch.end,
        branch.points.len(),
        branch.rejected,
        branch.iterations,
        branch.explanation
    );
    println!(
        "ms/point {:.1}",
        1e3 * t.elapsed().as_secs_f64() / branch.points.len() as f64
    );
}
