//! A rule in time that the library does not have, written outside it: points of the grid that are
//! closer together where the user wants them. It takes one file.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use periodyn::collocation::{Collocation, GridState, Pattern, Spectral, Tangent, TimeRule};
use periodyn::elements::{Coordinate, JointKind, NodeState};
use periodyn::fourier::TimeGrid;
use periodyn::model::{JointCoordinate, Model, Signal, SpringDefinition};
use periodyn::motion::DualMatrix;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::solve::PeriodicOptions;
use periodyn::system::System;
use periodyn::workers::Workers;
use std::f64::consts::TAU;
use std::sync::Arc;

const PERIOD: f64 = 1.3;
/// Points are so much closer together at the start of the period, relative to the mean.
const CLOSER: f64 = 0.3;

/// Times `t(s)` of points that are uniform in `s`, and `dt/ds` and `d²t/ds²` there.
fn map(s: f64) -> [f64; 3] {
    let phase = TAU * s / PERIOD;
    let amplitude = -CLOSER * PERIOD / TAU;
    [
        s + amplitude * phase.sin(),
        1.0 - CLOSER * phase.cos(),
        CLOSER * TAU / PERIOD * phase.sin(),
    ]
}

/// Derivatives in `t` by those in `s`: `q̇ = q'/t'` and `q̈ = q''/t'² − q' t''/t'³`.
#[derive(Debug, Clone)]
struct Mapped {
    uniform: Spectral,
    /// `1/t'` and `t''/t'²` at the grid points.
    slopes: Vec<[f64; 2]>,
}

impl Mapped {
    fn new(grid: TimeGrid, nodes: usize) -> Self {
        let slope = |s: f64| {
            let [_, first, second] = map(s);
            [1.0 / first, second / (first * first)]
        };
        Mapped {
            uniform: Spectral::new(grid, nodes),
            slopes: grid.times().map(slope).collect(),
        }
    }
}

impl TimeRule for Mapped {
    fn evaluate(&mut self, state: &GridState, workers: &Workers, nodes: &mut [NodeState]) {
        self.uniform.evaluate(state, workers, nodes);
        for states in nodes.chunks_mut(state.points()) {
            for (node, [slope, bend]) in states.iter_mut().zip(&self.slopes) {
                node.twist_rate = (node.twist_rate * *slope - node.twist * *bend) * *slope;
                node.twist *= *slope;
            }
        }
    }

    fn rates(&mut self, place: usize, values: &[f64], gain: f64, rates: &mut [f64]) {
        self.uniform.rates(place, values, gain, rates);
        let scaled = rates.iter_mut().zip(&self.slopes);
        scaled.for_each(|(rate, [slope, _])| *rate *= slope);
    }

    fn tangent(&self, node: usize, power: usize, l: usize, k: usize) -> [DualMatrix; 2] {
        assert_eq!(power, 0, "not asked for here");
        let [velocity, acceleration] = self.uniform.tangent(node, 0, l, k);
        let [slope, bend] = self.slopes[l];
        [
            velocity * slope,
            (acceleration * slope - velocity * bend) * slope,
        ]
    }

    fn rate_weight(&self, power: usize, l: usize, k: usize) -> f64 {
        self.uniform.rate_weight(power, l, k) * self.slopes[l][0]
    }
}

/// A pendulum on a spring, driven far to both sides, and where its body's node is.
fn pendulum() -> (Model, usize) {
    let mut model = Model::new();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.3, 0.4));
    let body = model
        .add_rigid_body(1.5, &Vector3::new(0.6, 0.0, 0.0), &inertia)
        .unwrap();
    let axis = Model::frame_at("axis", &Vector3::zeros(), &Vector3::y()).unwrap();
    let joint = model
        .add_joint(JointKind::Revolute, None, Some(body), &axis, &axis)
        .unwrap();
    let at = JointCoordinate {
        joint,
        coordinate: Coordinate::Rotation1,
    };
    model
        .add_spring_damper(SpringDefinition {
            at,
            stiffness: 30.0,
            damping: 1.2,
            rest: 0.0,
        })
        .unwrap();
    let moment = Signal::harmonics(2.0, 0.0, &[11.0, 3.0], &[4.0, -2.0]).unwrap();
    model.add_actuator(at, &moment).unwrap();
    let gravity = [0.0, 0.0, -9.81].map(|g| Signal::constant(g).unwrap());
    model.set_gravity(gravity);
    (model, body)
}

#[test]
fn a_mapped_grid_is_a_rule_of_its_own_and_converges_to_the_same_motion() {
    let (model, body) = pendulum();
    let reference = Solution::solve(
        &model,
        PERIOD,
        &PeriodicOptions::with_grid_points(75),
        &mut |_, _| true,
    )
    .unwrap();
    let mut errors = Vec::new();
    for points in [21, 51] {
        let system = Arc::new(System::new(&model, PERIOD).unwrap());
        let grid = TimeGrid::new(points, PERIOD).unwrap();
        let times: Vec<f64> = grid.times().map(|s| map(s)[0]).collect();
        let mut equations = Collocation::new(system.clone(), grid).unwrap();
        equations.set_rule(Box::new(Mapped::new(grid, system.nodes())));
        let mut signals = equations.signals().to_vec();
        for (values, &time) in signals.chunks_exact_mut(system.signals()).zip(&times) {
            system.signal_values(time, 1.0, values).unwrap();
        }
        equations.set_signals(&signals);

        // Newton's method with the assembled matrix.
        let pattern = Pattern::new(&system, points);
        let mut tangent = Tangent::new(&system, points);
        let mut state = GridState::reference(&system, grid);
        let mut increments = Vec::new();
        for _ in 0..12 {
            let mut residual = vec![0.0; equations.size()];
            equations.residual(&state, &mut residual).unwrap();
            let mut values = vec![0.0; pattern.entries()];
            equations
                .jacobian(&state, &pattern, &mut tangent, &mut values)
                .unwrap();
            let mut matrix = DMatrix::zeros(residual.len(), residual.len());
            for (column, range) in pattern.column_pointers().windows(2).enumerate() {
                for entry in range[0]..range[1] {
                    matrix[(pattern.row_indices()[entry], column)] += values[entry];
                }
            }
            let x = matrix.lu().solve(&-DVector::from_vec(residual)).unwrap();
            let scales = equations.column_scale().iter();
            let increment: Vec<f64> = x.iter().zip(scales).map(|(x, s)| x * s).collect();
            increments.push(x.rows(0, 6 * points).amax());
            state = state.incremented(&system, &increment, 1.0);
        }
        // Quadratic to the end: the tangent is exact.
        let quick =
            |pair: &[f64]| pair[0] > 0.1 || pair[1] <= (10.0 * pair[0] * pair[0]).max(1e-11);
        println!("{increments:?}");
        assert!(increments.windows(2).all(quick), "{increments:?}");
        assert!(increments.last().is_some_and(|last| *last < 1e-11));

        let expected = reference
            .node(body, NodeQuantity::RotationMatrix, &times)
            .unwrap();
        let found = state.node(body).iter();
        let found: Vec<f64> = found.flat_map(|m| m.rotation.iter().copied()).collect();
        let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
        errors.push(error.fold(0.0, f64::max));
    }
    println!("{errors:?}");
    // From percents to what 75 uniform points leave.
    assert!(
        errors[1] < 1e-9 && errors[1] < 1e-4 * errors[0],
        "{errors:?}"
    );
}
