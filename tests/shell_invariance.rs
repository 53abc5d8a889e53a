//! A shell moved as a whole, written in other units, or over nodes that are turned otherwise, does
//! the same.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::*;
use periodyn::model::*;
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{NodeQuantity, ShellQuantity, Solution};
use periodyn::solve::Outcome;
use std::f64::consts::TAU;

/// The acceptance limit, of the largest of its kind. What is left is rounding: resultants of
/// strains that are 1e-16 of 1, beside strains of 1e-3. Measured: 6e-13.
const TOLERANCE: f64 = 1e-11;
const SIDES: [usize; 2] = [4, 3];
const ELEMENTS: usize = 2;

/// A strip of rubber, bent and twisted, whose root turns to and fro, under weight, a pressure that
/// follows it and a dead force on its end; its period.
fn strip(setting: &Setting, turned: bool) -> (Model, f64) {
    let (mass, length, time) = (setting.mass, setting.length, setting.time);
    let pressure = setting.force() / (length * length);
    let section = IsotropicShell {
        damping_time: 3e-3 * time,
        ..IsotropicShell::new(
            0.02 * length,
            2e8 * pressure,
            0.3,
            1100.0 * mass / length.powi(3),
        )
    };
    let surface = |x: f64, y: f64| {
        let (sine, cosine) = (0.6 * x).sin_cos();
        Vector3::new(x, y * cosine - 0.2 * x * x, y * sine + 0.3 * x * x)
    };
    let [along, across] = SIDES.map(lobatto_points);
    let mut model = Model::new();
    let mut rows = Vec::new();
    for i in 0..=ELEMENTS * (SIDES[0] - 1) {
        let (element, k) = (i / (SIDES[0] - 1), i % (SIDES[0] - 1));
        let x = (element as f64 + 0.5 * (along[k] + 1.0)) / ELEMENTS as f64;
        for (j, y) in across.iter().enumerate() {
            let turn = if turned {
                0.7 * (3 * i + j) as f64
            } else {
                0.0
            };
            let turn = rotation_from_vector(&(Vector3::new(1.0, -0.6, 0.3) * turn));
            let place = setting.point(&surface(x, 0.2 * y));
            let node = Motion::new(setting.place.rotation * turn, place);
            rows.push(model.add_node(&node).unwrap());
        }
    }
    let (section, placement) = (section.section().unwrap(), ShellPlacement::default());
    for element in 0..ELEMENTS {
        let first = element * (SIDES[0] - 1) * SIDES[1];
        let nodes = &rows[first..first + SIDES[0] * SIDES[1]];
        model
            .add_shell_element(nodes, SIDES, &section, &placement)
            .unwrap();
    }
    let root = setting.point(&Vector3::zeros());
    let inertia = 1e-3 * mass * length * length;
    let shaft = ball(&mut model, 0.1 * mass, inertia, &root);
    model
        .add_rigid_joints(Some(shaft), &rows[..SIDES[1]])
        .unwrap();
    let axis = setting.turned(&Vector3::y());
    let hinge = revolute(&mut model, None, Some(shaft), &root, &axis);
    model.prescribe(rotation1(hinge), &cosine(0.4)).unwrap();
    let weight = setting.turned(&Vector3::new(1.0, 0.5, -9.0)) * (length / (time * time));
    gravity(&mut model, weight.into());
    let push = setting.turned(&Vector3::new(8.0, -5.0, 6.0)) * (setting.force() / length);
    let dead = std::array::from_fn(|i| push.get(i).map(|&x| Signal::constant(x).unwrap()));
    let follower = [None, None, Some(cosine(200.0 * pressure)), None, None, None];
    for (first_element, place, frame, components) in [
        (0, ShellLoadPlace::Surface, LoadFrame::Follower, follower),
        (1, ShellLoadPlace::Edge(1), LoadFrame::Space, dead),
    ] {
        let definition = ShellLoadDefinition {
            first_element,
            elements: 1,
            place,
            frame,
            components,
        };
        model.add_shell_load(definition).unwrap();
    }
    (model, 0.9 * time)
}

/// Places, resultants and stresses, and how far the place of the end moves, in SI units and as the
/// strip lies by itself.
fn response(setting: &Setting, turned: bool) -> ([Vec<f64>; 3], f64) {
    let (model, period) = strip(setting, turned);
    let solution = Solution::solve(&model, period, &options(9), &mut |_, _| true).unwrap();
    assert_eq!(
        solution.outcome(),
        Outcome::Converged,
        "{}",
        solution.report()
    );
    let times = times(period, 7);
    let mut places = Vec::new();
    for node in 0..model.node_count() {
        let found = solution.node(node, NodeQuantity::Position, &times).unwrap();
        for place in found.chunks_exact(3) {
            let place = Vector3::from_column_slice(place) - setting.place.position;
            places.extend((setting.place.rotation.transpose() * place / setting.length).iter());
        }
    }
    let of = |quantity| {
        let at = |element| solution.shell(element, ShellPoint::new([0.3, -0.6]), quantity, &times);
        (0..ELEMENTS)
            .flat_map(|element| at(element).unwrap())
            .collect::<Vec<f64>>()
    };
    let traction = setting.force() / setting.length;
    let resultants = of(ShellQuantity::Resultant).into_iter().enumerate();
    let resultants = resultants.map(|(i, x)| match i % 6 {
        // Moments beside forces by the thickness.
        3.. => x / (traction * 0.02 * setting.length),
        _ => x / traction,
    });
    let stresses = of(ShellQuantity::SurfaceStress(ShellSide::Top)).into_iter();
    let stresses = stresses.map(|x| x / (traction / setting.length)).collect();
    let end = places.chunks(3 * times.len()).nth_back(1).unwrap();
    let moved = largest_difference(&end[..3], &end[9..12]);
    ([places, resultants.collect(), stresses], moved)
}

fn assert_same(setting: &Setting, turned: bool) {
    let (own, moved) = response(&Setting::default(), false);
    let (other, _) = response(setting, turned);
    for (own, other) in own.iter().zip(&other) {
        let size = largest(own.iter().copied());
        let apart = largest_difference(own, other) / size;
        println!("{size:.2e}: {apart:.1e}");
        assert!(size > 0.5 && apart < TOLERANCE, "{size:.2e}: {apart:.1e}");
    }
    assert!(moved > 0.3, "{moved}");
}

fn elsewhere() -> Motion {
    let turn = Vector3::new(0.83, -1.91, 1.27);
    assert!((rotation_from_vector(&turn) - Matrix3::identity()).norm() > 0.1 * TAU);
    Motion::new(rotation_from_vector(&turn), Vector3::new(1.7, -0.9, 2.3))
}

#[test]
fn a_moved_shell_does_the_same() {
    let setting = Setting {
        place: elsewhere(),
        ..Setting::default()
    };
    assert_same(&setting, false);
}

#[test]
fn nodes_that_are_turned_are_the_same_shell() {
    assert_same(&Setting::default(), true);
}

#[test]
fn other_units_give_the_same_shell() {
    // Pounds, inches and minutes, moved as well.
    let setting = Setting {
        place: elsewhere(),
        mass: 1.0 / 0.453_592_37,
        length: 1.0 / 0.0254,
        time: 1.0 / 60.0,
    };
    assert_same(&setting, true);
}
