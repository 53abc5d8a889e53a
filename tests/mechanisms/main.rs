//! Mechanisms of rigid bodies in all kinds of joints, against their closed forms.

#[path = "../common/mod.rs"]
mod common;

mod assembly;
mod closed_chains;
mod jet;
mod lower_pairs;
mod planar_mechanisms;
mod spatial_mechanisms;

use common::{largest, largest_difference};
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::model::{JointCoordinate, Model, Signal, SpringDefinition};
use periodyn::output::{JointQuantity, NodeQuantity, ResolvedIn, Solution};
use periodyn::solve::Outcome;

/// Relative tolerance of everything: the acceptance limit. What is reached, 5e-12, is printed.
const TOLERANCE: f64 = 1e-9;

const SPACE_REACTION: JointQuantity = JointQuantity::Reaction(ResolvedIn::Space);

/// A joint whose frames coincide in the reference configuration, with axis 3 along `axis`.
fn joint(
    model: &mut Model,
    kind: JointKind,
    first: Option<usize>,
    second: Option<usize>,
    point: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> usize {
    let frame = Model::frame_at("axis", point, axis).unwrap();
    model
        .add_joint(kind, first, second, &frame, &frame)
        .unwrap()
}

fn universal(
    model: &mut Model,
    first: Option<usize>,
    second: Option<usize>,
    point: &Vector3<f64>,
    arms: [&Vector3<f64>; 2],
) -> usize {
    let frame = Model::cross_frame(point, arms[0], arms[1]).unwrap();
    model
        .add_joint(JointKind::Universal, first, second, &frame, &frame)
        .unwrap()
}

/// A solve that must converge, to rounding also of second derivatives, which amplify errors by some
/// 10³.
fn solve(model: &Model, period: f64, grid_points: usize) -> Solution {
    let mut options = common::options(grid_points);
    options.newton.tolerance = 1e-12;
    let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
    let report = &solution.details().report;
    assert_eq!(solution.outcome(), Outcome::Converged, "{report:#?}");
    solution
}

fn at(joint: usize, coordinate: Coordinate) -> JointCoordinate {
    JointCoordinate { joint, coordinate }
}

fn prescribe(model: &mut Model, joint: usize, coordinate: Coordinate, signal: &Signal) {
    model.prescribe(at(joint, coordinate), signal).unwrap();
}

fn spring(
    model: &mut Model,
    joint: usize,
    coordinate: Coordinate,
    stiffness: f64,
    damping: f64,
    rest: f64,
) {
    model
        .add_spring_damper(SpringDefinition {
            at: at(joint, coordinate),
            stiffness,
            damping,
            rest,
        })
        .unwrap();
}

/// Constant gravity.
fn gravity(model: &mut Model, acceleration: &Vector3<f64>) {
    let constant = |x: f64| Signal::constant(x).unwrap();
    let a = acceleration;
    model.set_gravity([constant(a.x), constant(a.y), constant(a.z)]);
}

/// A point mass.
fn particle(model: &mut Model, mass: f64, at: &Vector3<f64>) -> usize {
    model.add_rigid_body(mass, at, &Matrix3::zeros()).unwrap()
}

fn diagonal(a: f64, b: f64, c: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(a, b, c))
}

/// Function values at all times.
fn along(times: &[f64], f: impl Fn(f64) -> f64) -> Vec<f64> {
    times.iter().map(|&t| f(t)).collect()
}

/// Components of a vector function at all times.
fn along_vectors(times: &[f64], f: impl Fn(f64) -> Vector3<f64>) -> Vec<f64> {
    times.iter().flat_map(|&t| f(t).data.0[0]).collect()
}

fn of_joint(solution: &Solution, joint: usize, quantity: JointQuantity, times: &[f64]) -> Vec<f64> {
    solution.joint(joint, quantity, times).unwrap()
}

/// The force (`first = 0`) or moment (`first = 3`) of a joint's reaction on its second body.
fn reaction(solution: &Solution, joint: usize, first: usize, times: &[f64]) -> Vec<f64> {
    let values = of_joint(solution, joint, SPACE_REACTION, times);
    let halves = values.chunks_exact(6).flat_map(|v| &v[first..first + 3]);
    halves.copied().collect()
}

fn position(solution: &Solution, node: usize, times: &[f64]) -> Vec<f64> {
    solution.node(node, NodeQuantity::Position, times).unwrap()
}

fn assert_near(found: &[f64], exact: &[f64], what: &str) {
    assert_close(found, exact, largest(exact.iter().copied()), what);
}

/// Compares relative to `size`, where what is compared vanishes.
fn assert_close(found: &[f64], exact: &[f64], size: f64, what: &str) {
    let error = largest_difference(found, exact) / size;
    println!("{what}: relative error {error:.1e}");
    assert!(error < TOLERANCE, "{what}: {error}");
}

/// An angle `offset + Ω t + swing sin Ω t`, with its rate and acceleration.
#[derive(Clone, Copy)]
struct Turning {
    offset: f64,
    omega: f64,
    swing: f64,
}

impl Turning {
    fn at(&self, t: f64) -> [f64; 3] {
        let (s, c) = (self.omega * t).sin_cos();
        [
            self.offset + self.omega * t + self.swing * s,
            self.omega * (1.0 + self.swing * c),
            -self.omega * self.omega * self.swing * s,
        ]
    }

    /// The same, counted from the reference configuration.
    fn signal(&self, reference: f64) -> Signal {
        Signal::harmonics(self.offset - reference, self.omega, &[0.0], &[self.swing]).unwrap()
    }

    fn period(&self) -> f64 {
        std::f64::consts::TAU / self.omega
    }
}
