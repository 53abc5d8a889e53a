//! Families of free motions of slender conservative beams, that leave a linear mode.

mod common;

use common::models::beams::free_strip;
use common::options;
use periodyn::fourier::TimeGrid;
use periodyn::model::Model;
use periodyn::output::{Modes, NodeQuantity, Solution};
use periodyn::quantity::{Feature, Quantity};
use periodyn::solve::{
    BranchEnd, BranchOptions, Condition, Free, InitialGuess, LinearMethod, ModesOptions, Outcome,
    OutputIs, PeriodicOptions, Phase, follow_branch,
};
use std::f64::consts::TAU;
use std::sync::Arc;

const POINTS: usize = 17;
/// Of the tip, in the first harmonic, where families begin.
const AMPLITUDE: f64 = 0.05;

/// The frequency of the first mode of a strip, and its free motion with that amplitude.
fn free_motion(model: &Model, damping: usize) -> (f64, Solution) {
    let one = ModesOptions {
        count: 1,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(model, &one, &mut |_, _| true).unwrap();
    let tip = model.node_count() - 1;
    let shape = modes.shape(0, tip).unwrap()[1].re;
    let linear = modes.motion(0, AMPLITUDE / shape).unwrap();
    let given = OutputIs {
        output: Quantity::Node(tip, NodeQuantity::Position).component(1),
        feature: Feature::Cosine(1),
        value: AMPLITUDE,
        scale: Some(AMPLITUDE),
    };
    let conditions: [Arc<dyn Condition>; 2] = [Arc::new(Phase), Arc::new(given)];
    let free = [Free::Frequency, Free::Parameter(damping)];
    let grid = TimeGrid::new(POINTS, linear.grid().period()).unwrap();
    let options = PeriodicOptions {
        guess: InitialGuess::State(linear.prolonged(grid).unwrap()),
        ..options(POINTS)
    };
    let given = (&free[..], &conditions[..]);
    let period = grid.period();
    let found = Solution::solve_conditioned(model, period, given, &options, &mut |_, _| true);
    let found = found.unwrap();
    assert_eq!(found.outcome(), Outcome::Converged);
    (TAU / period, found)
}

/// Follows the backbone of a strip to large turns of its tip. The frequency at its beginning, of
/// an inextensible beam, is `ω² = ω₀² (1 + a² (3 E / 2 K − G / 2 M))` with
/// `K = ∫ φ''²`, `E = ∫ (φ' φ'')²`, `M = ∫ φ²`, `G = ∫ (∫ φ'²)²` of its linear mode.
fn follow(elements: usize, degree: usize, error: f64) {
    const BY_AMPLITUDE: f64 = 0.038_767;
    let (model, damping) = free_strip(elements, degree);
    let (linear, first) = free_motion(&model, damping);
    let start = TAU / first.grid().period();
    let found = ((start / linear).powi(2) - 1.0) / AMPLITUDE.powi(2);
    let off = (found / BY_AMPLITUDE - 1.0).abs();
    assert!(off < error, "{found} {BY_AMPLITUDE}");

    let options = BranchOptions {
        periodic: PeriodicOptions {
            linear: LinearMethod::Direct,
            guess: InitialGuess::State(first.details().state.clone()),
            ..options(POINTS)
        },
        free: vec![Free::Parameter(damping)],
        conditions: vec![Arc::new(Phase)],
        range: [start, 1.05 * start],
        motion_scale: 0.5,
        point_limit: 7,
        ..BranchOptions::default()
    };
    let (model, period) = (first.model(), TAU / start);
    let branch = follow_branch(model, period, Free::Frequency, &options, &mut |_, _| true);
    let branch = branch.unwrap();
    assert_eq!(branch.end, BranchEnd::PointLimit, "{}", branch.explanation);
    let tip = model.node_count() - 1;
    let mut before = 0.0;
    for point in &branch.points {
        // Energy is conserved.
        assert!(point.values[1].abs() < 1e-10, "{}", point.values[1]);
        assert!(point.values[0] > before, "{} {before}", point.values[0]);
        before = point.values[0];
    }
    let motions = branch.points.last().unwrap().state.node(tip);
    let turns = motions.iter().map(|m| m.rotation[(1, 0)].abs().asin());
    let turn = turns.fold(0.0, f64::max);
    assert!(turn > 0.7, "{turn}");
}

#[test]
fn the_backbone_of_a_strip_of_many_linear_elements() {
    follow(40, 1, 0.04);
}

#[test]
fn the_backbone_of_a_strip_of_few_elements_of_degree_four() {
    follow(10, 4, 0.005);
}
