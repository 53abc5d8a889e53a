//! Kernels: motion derivatives on the grid, their tangents, and the beam element.

use divan::{Bencher, black_box};
use nalgebra::{Matrix6, Vector3, Vector6};
use periodyn::collocation::{KinematicsScratch, NodeKinematics};
use periodyn::elements::{
    Beam, Contribution, Element, Instant, IsotropicShell, NodeState, Section, Shell, lobatto_points,
};
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
    let place = |a: usize| {
        let s = a as f64 / (count - 1) as f64;
        Motion::identity().increment(&Vector6::new(s, 0.0, 0.0, 0.0, 0.0, 0.1 * s * s))
    };
    let section = Section {
        stiffness: Matrix6::identity() * 1e5,
        mass: Matrix6::identity(),
        damping: Matrix6::zeros(),
    };
    let reference: Vec<Motion> = (0..count).map(place).collect();
    let beam = Beam::new((0..count).collect(), reference.clone(), section).unwrap();
    let bend = Vector6::new(0.0, 0.01, 0.0, 0.0, 0.0, 0.05);
    let states: Vec<NodeState> = reference
        .iter()
        .map(|m| NodeState::at_rest(m.increment(&bend)))
        .collect();
    bench_element(bencher, &beam, &states, with_tangents);
}

fn bench_element(
    bencher: Bencher,
    element: &dyn Element,
    states: &[NodeState],
    with_tangents: bool,
) {
    let mut out = Contribution::new(states.len(), 0, with_tangents);
    bencher.bench_local(|| {
        out.clear();
        let instant = Instant {
            nodes: black_box(states),
            multipliers: &[],
            multiplier_rates: &[],
            resultants: &[],
            signals: &[],
            coordinates: &[],
            gravity: Vector3::zeros(),
            inertial: periodyn::elements::InertialForces::FULL,
            time: 0.0,
        };
        element.evaluate(&instant, &mut out).unwrap();
    });
}

/// Tangents of a bent shell element with so many nodes a side.
#[divan::bench(args = [2, 3, 4, 5, 6])]
fn shell_element(bencher: Bencher, side: usize) {
    let points = lobatto_points(side);
    let place = |i: usize| {
        let (x, y) = (points[i / side], points[i % side]);
        Motion::identity().increment(&Vector6::new(x, y, 0.0, 0.0, 0.0, 0.0))
    };
    let reference: Vec<Motion> = (0..side * side).map(place).collect();
    let frames = vec![Motion::identity(); side * side];
    let section = IsotropicShell::new(0.1, 1e6, 0.3, 1.0).section().unwrap();
    let nodes = (0..side * side).collect();
    let shell = Shell::new(
        (nodes, [side; 2]),
        (reference.clone(), frames),
        section,
        None,
    );
    let bend = |m: &Motion| {
        let turn = 0.1 * m.position.x;
        NodeState::at_rest(m.increment(&Vector6::new(0.0, 0.0, 0.01, 0.0, -turn, 0.0)))
    };
    let states: Vec<NodeState> = reference.iter().map(bend).collect();
    bench_element(bencher, &shell.unwrap(), &states, true);
}

/// The products of matrices that these tangents are made of, alone: for the geometric stiffness
/// three, for the material stiffness six.
#[divan::bench(args = [2, 3, 4, 5, 6])]
fn products_of_shell_element(bencher: Bencher, side: usize) {
    let rows = 3 * side * side;
    let geometric = (12 * 2 * side * (side - 1), 3);
    let material = (6 * side * side, 6);
    let factors = [geometric, material].map(|(columns, times)| {
        let factor = faer::Mat::from_fn(rows, columns, |i, j| (i + 3 * j) as f64 * 1e-3);
        (factor, times)
    });
    let mut sum = faer::Mat::<f64>::zeros(rows, rows);
    bencher.bench_local(|| {
        for (factor, times) in black_box(&factors) {
            for _ in 0..*times {
                let (accumulate, sequential) = (faer::Accum::Add, faer::Par::Seq);
                let (left, right) = (factor.as_ref(), factor.transpose());
                faer::linalg::matmul::matmul(&mut sum, accumulate, left, right, 1.0, sequential);
            }
        }
    });
}
