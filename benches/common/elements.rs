//! Bent elements, whose forces and tangents are timed.

use nalgebra::{Matrix6, Vector3, Vector6};
use periodyn::elements::{
    Beam, Contribution, Element, InertialForces, Instant, IsotropicShell, NodeState, Section,
    Shell, lobatto_points,
};
use periodyn::motion::Motion;
use std::hint::black_box;

/// An element and the states of its nodes.
pub type Bent = (Box<dyn Element>, Vec<NodeState>);

/// A square shell element with so many nodes a side.
pub fn bent_shell(side: usize) -> Bent {
    let points = lobatto_points(side);
    let place = |i: usize| {
        let (x, y) = (points[i / side], points[i % side]);
        Motion::identity().increment(&Vector6::new(x, y, 0.0, 0.0, 0.0, 0.0))
    };
    let reference: Vec<Motion> = (0..side * side).map(place).collect();
    let bend = |m: &Motion| {
        let turn = 0.1 * m.position.x;
        NodeState::at_rest(m.increment(&Vector6::new(0.0, 0.0, 0.01, 0.0, -turn, 0.0)))
    };
    let states = reference.iter().map(bend).collect();
    let frames = vec![Motion::identity(); side * side];
    let section = IsotropicShell::new(0.1, 1e6, 0.3, 1.0).section().unwrap();
    let nodes = (0..side * side).collect();
    let shell = Shell::new((nodes, [side; 2]), (reference, frames), section, None);
    (Box::new(shell.unwrap()), states)
}

/// A curved beam element with so many nodes.
pub fn bent_beam(count: usize) -> Bent {
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
    let bend = Vector6::new(0.0, 0.01, 0.0, 0.0, 0.0, 0.05);
    let state = |m: &Motion| NodeState::at_rest(m.increment(&bend));
    let states = reference.iter().map(state).collect();
    let beam = Beam::new((0..count).collect(), reference, section).unwrap();
    (Box::new(beam), states)
}

/// Its forces, and tangents if these are wanted.
pub fn evaluate((element, states): &Bent, out: &mut Contribution) {
    out.clear();
    let instant = Instant {
        nodes: black_box(states),
        multipliers: &[],
        multiplier_rates: &[],
        resultants: &[],
        signals: &[],
        coordinates: &[],
        gravity: Vector3::zeros(),
        inertial: InertialForces::FULL,
        time: 0.0,
    };
    element.evaluate(&instant, out).unwrap();
}
