//! Kernels: motion derivatives on the grid, their tangents, and the beam element.

mod common;

use common::elements::{bent_beam, evaluate};
use divan::{Bencher, black_box};
use nalgebra::Vector6;
use periodyn::collocation::{KinematicsScratch, NodeKinematics};
use periodyn::elements::Contribution;
use periodyn::fourier::{CardinalWeights, Differentiation, TimeGrid};
use periodyn::motion::{Motion, polar_rotation};

fn main() {
    divan::main();
}

fn motions(grid: TimeGrid) -> Vec<Motion> {
    let at = |t: f64| {
        let phase = grid.frequency() * t;
        let turn = Vector6::new(0.0, 0.0, 0.0, 0.0, 0.3 * phase.sin(), phase);
        let shift = Vector6::new(phase.cos(), phase.sin(), 0.2, 0.0, 0.0, 0.0);
        Motion::identity().increment(&shift).increment(&turn)
    };
    grid.times().map(at).collect()
}

#[divan::bench(args = [21, 63, 65, 255, 1023])]
fn velocities_and_accelerations(bencher: Bencher, points: usize) {
    let grid = TimeGrid::new(points, 1.0).unwrap();
    let (mut operators, motions) = (Differentiation::new(grid), motions(grid));
    let mut node = NodeKinematics::default();
    let mut scratch = KinematicsScratch::default();
    bencher.bench_local(|| node.evaluate(&mut operators, black_box(&motions), &mut scratch));
}

#[divan::bench(args = [21, 63])]
fn tangent_blocks(bencher: Bencher, points: usize) {
    let grid = TimeGrid::new(points, 1.0).unwrap();
    let mut operators = Differentiation::new(grid);
    let mut node = NodeKinematics::default();
    let scratch = &mut KinematicsScratch::default();
    node.evaluate(&mut operators, &motions(grid), scratch);
    bencher.bench_local(|| {
        for l in 0..points {
            for k in 0..points {
                let weights = (operators.first(l, k), operators.second(l, k));
                black_box(node.tangent(weights, l, k));
            }
        }
    });
}

#[divan::bench(args = [21, 255])]
fn cardinal_weights(bencher: Bencher, points: usize) {
    let mut weights = CardinalWeights::new(TimeGrid::new(points, 1.0).unwrap());
    bencher.bench_local(|| weights.move_to(black_box(0.123)));
}

#[divan::bench]
fn polar_decomposition(bencher: Bencher) {
    let g = motions(TimeGrid::new(21, 1.0).unwrap())[4].rotation * 0.9
        + nalgebra::Matrix3::new(0.1, 0.0, 0.02, 0.03, -0.1, 0.0, 0.0, 0.05, 0.0);
    bencher.bench_local(|| polar_rotation(black_box(&g)));
}

#[divan::bench(args = [(2, false), (2, true), (3, true), (5, true)])]
fn beam_element(bencher: Bencher, (count, with_tangents): (usize, bool)) {
    let beam = bent_beam(count);
    let mut out = Contribution::new(count, 0, with_tangents);
    bencher.bench_local(|| evaluate(&beam, &mut out));
}
