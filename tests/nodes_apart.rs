//! Forces of a user's function on nodes, each of its own motion: the same motions as where nothing
//! is said of it, with fewer entries and calls.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::Pattern;
use periodyn::elements::*;
use periodyn::error::{ErrorKind, Result};
use periodyn::model::*;
use periodyn::motion::{Motion, skew};
use periodyn::output::NodeQuantity;
use periodyn::system::{System, check_tangents};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const PERIOD: f64 = 2.0;
const POINTS: usize = 15;
const AIR: [f64; 3] = [0.4, 2.5, 0.03];

/// A clamped rod of 13 nodes that a load shakes.
fn rod() -> (Model, Vec<usize>) {
    let stiffness = [8e3, 3e3, 3e3, 14.0, 9.0, 25.0];
    let section = SectionInput::diagonal(&stiffness, &[0.3, 0.02, 0.01, 0.01]).unwrap();
    let mut model = Model::new();
    let (start, end) = (Vector3::zeros(), Vector3::x());
    let rod = model.add_straight_beam(&start, &end, &Vector3::y(), &section, 4, 3);
    let rod = rod.unwrap();
    clamp(&mut model, rod.first_node);
    push(&mut model, rod.last_node, 2, cosine(4.0));
    push(&mut model, rod.last_node, 1, Signal::constant(3.0).unwrap());
    (model, (rod.first_node..=rod.last_node).collect())
}

/// A force `−c v − k (a·v) a` with `a = R e₃` and a moment against turning, with tangents in one
/// block a node, or in those on the diagonal.
fn air(input: &NodeForceInput, output: &mut NodeForceOutput) -> Result<()> {
    let [c, k, turning] = AIR;
    for (node, velocity) in input.velocities.iter().enumerate() {
        let a = input.rotations[node].column(2).into_owned();
        let v = velocity.fixed_rows::<3>(0).into_owned();
        let w = velocity.fixed_rows::<3>(3).into_owned();
        let force = -v * c - a * (k * a.dot(&v));
        let rows = &mut output.forces[node];
        rows.fixed_rows_mut::<3>(0).copy_from(&force);
        rows.fixed_rows_mut::<3>(3).copy_from(&(w * -turning));
        let Some((by_motion, by_velocity)) = &mut output.tangents else {
            continue;
        };
        let column = if input.columns == 1 { 0 } else { 6 * node };
        let by_turn = a * a.cross(&v).transpose() - skew(&a) * a.dot(&v);
        let mut set = |turn: bool, block: Matrix3<f64>| {
            let (matrix, at) = match turn {
                true => (&mut *by_motion, (6 * node, column + 3)),
                false => (&mut *by_velocity, (6 * node, column)),
            };
            matrix.fixed_view_mut::<3, 3>(at.0, at.1).copy_from(&block);
        };
        set(true, by_turn * -k);
        set(false, Matrix3::identity() * -c - a * a.transpose() * k);
        let mut view = by_velocity.fixed_view_mut::<3, 3>(6 * node + 3, column + 3);
        view.fill_diagonal(-turning);
    }
    Ok(())
}

/// The rod in air, and how often the function was called.
fn in_air(gives_tangents: bool, apart: bool) -> (Model, Arc<AtomicUsize>) {
    let (mut model, nodes) = rod();
    let calls = Arc::new(AtomicUsize::new(0));
    let counted = calls.clone();
    let law = NodeForceLaw {
        function: Arc::new(move |input, output| {
            counted.fetch_add(1, Ordering::Relaxed);
            air(input, output)
        }),
        gives_tangents,
        frame: LoadFrame::Space,
    };
    let force = model.add_node_forces(&nodes, law).unwrap();
    if apart {
        model.declare_nodes_apart(force).unwrap();
    }
    (model, calls)
}

fn entries(model: &Model) -> usize {
    Pattern::new(&System::new(model, PERIOD).unwrap(), POINTS).entries()
}

#[test]
fn motions_are_the_same_with_fewer_entries_and_calls() {
    let times = times(PERIOD, 5);
    let solved = |gives_tangents: bool, apart: bool| {
        let (model, calls) = in_air(gives_tangents, apart);
        let solution = solve(&model, PERIOD, POINTS);
        let of = |node| solution.node(node, NodeQuantity::Position, &times).unwrap();
        let tip = of(model.node_count() - 1);
        (tip, calls.load(Ordering::Relaxed), entries(&model))
    };
    let (expected, _, coupled) = solved(true, false);
    let free = entries(&rod().0);
    for given in [true, false] {
        let (together, many, _) = solved(given, false);
        let (apart, calls, entries) = solved(given, true);
        let error = largest_difference(&apart, &expected) / largest(expected.iter().copied());
        println!("given {given}: {error:.1e}, {calls} of {many} calls, {entries} of {coupled}");
        // What Newton's method leaves of increments of 1e-9.
        assert!(error < 1e-12, "{error:e}");
        assert!(largest_difference(&together, &expected) < 1e-12);
        // The rod's own nodes were coupled dense in time already: by their inertia.
        assert_eq!(entries, free);
        assert!(2 * entries < coupled, "{entries} {coupled}");
        if !given {
            // 24 calls for each evaluation with tangents instead of 24 for each of 13 nodes.
            assert!(8 * calls < many, "{calls} {many}");
        }
    }
}

#[test]
fn tangents_are_checked_by_node() {
    let (model, _) = in_air(true, true);
    let check = check_tangents(&model, 0, PERIOD).unwrap();
    assert!(check.error < 1e-7, "{check:?}");
    let (mut model, nodes) = rod();
    let law = NodeForceLaw {
        function: Arc::new(|input, output| {
            air(input, output)?;
            if let Some((_, by_velocity)) = &mut output.tangents {
                // Of node 5 by its angular velocity about axis 2.
                by_velocity[(6 * 5 + 4, 4)] *= 30.0;
            }
            Ok(())
        }),
        gives_tangents: true,
        frame: LoadFrame::Space,
    };
    let force = model.add_node_forces(&nodes, law).unwrap();
    model.declare_nodes_apart(force).unwrap();
    let check = check_tangents(&model, force, PERIOD).unwrap();
    assert!(check.error > 0.01);
    assert_eq!((check.row, check.column), (Some((5, 4)), Some((5, 4))));
    assert_eq!(check.tangent, Tangent::Damping);
}

#[test]
fn forces_that_depend_on_others_are_refused() {
    let solved = |first: usize, second: usize| {
        let (mut model, nodes) = rod();
        let law = NodeForceLaw {
            function: Arc::new(move |input, output| {
                let pull = input.positions[second] - input.positions[first];
                output.forces[first].fixed_rows_mut::<3>(0).copy_from(&pull);
                Ok(())
            }),
            gives_tangents: false,
            frame: LoadFrame::Space,
        };
        let force = model.add_node_forces(&nodes, law).unwrap();
        assert!(try_solve(&model, PERIOD, POINTS).is_ok());
        model.declare_nodes_apart(force).unwrap();
        let error = try_solve(&model, PERIOD, POINTS).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Model);
        error.to_string()
    };
    for (first, second) in [(0, 5), (3, 0), (7, 8)] {
        let expected = format!(
            "force 0: its nodes were declared apart, but the force on node {first} changes with \
             the motions of others"
        );
        assert_eq!(solved(first, second), expected);
    }
}

#[test]
fn what_was_declared_is_saved_and_of_forces_on_nodes_only() {
    let (model, _) = in_air(false, true);
    let path = std::env::temp_dir().join(format!("nodes_apart_{}.pdm", std::process::id()));
    model.save(&path).unwrap();
    let mut loaded = Model::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let law = NodeForceLaw {
        function: Arc::new(air),
        gives_tangents: false,
        frame: LoadFrame::Space,
    };
    loaded.bind_node_forces(0, law).unwrap();
    assert_eq!(entries(&loaded), entries(&model));
    let spring = loaded.add_joint(
        JointKind::Free,
        None,
        Some(0),
        &Motion::identity(),
        &Motion::identity(),
    );
    let at = rotation1(spring.unwrap());
    let actuator = loaded.add_actuator(at, &cosine(1.0)).unwrap();
    let error = loaded.declare_nodes_apart(actuator).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
    assert!(loaded.declare_nodes_apart(7).is_err());
}
