//! A mechanism moved as a whole, or written in other units, does the same.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::Coordinate;
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{BeamQuantity, JointQuantity, NodeQuantity, ResolvedIn};
use std::collections::BTreeMap;

const POINTS: usize = 21;

/// The acceptance limit. What is left is rounding: strains of 1e-16 times axial stiffnesses of 5e7
/// N make 1e-8 N, against forces of some 10 N.
const TOLERANCE: f64 = 1e-8;

/// Everything that is compared, by kind, back in SI units and in the mechanism's own place.
fn response(setting: Setting) -> BTreeMap<String, Vec<f64>> {
    let mechanism = FourBar {
        elements: 4,
        loaded: true,
        setting,
        ..FourBar::default()
    }
    .build();
    let solution = mechanism.solve(POINTS);
    let (force, moment) = (setting.force(), setting.moment());
    let times = times(mechanism.period, 50);
    let back = |v: &[f64], unit: f64| -> Vec<f64> {
        let turned = setting.place.rotation.transpose() * Vector3::from_column_slice(v) / unit;
        turned.iter().copied().collect()
    };
    let mut curves: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut keep = |kind: String, values: Vec<f64>| curves.entry(kind).or_default().extend(values);
    for node in (0..mechanism.model.node_count()).step_by(3) {
        let position = solution.node(node, NodeQuantity::Position, &times).unwrap();
        let place: Vec<f64> = position
            .chunks_exact(3)
            .flat_map(|p| {
                let p = Vector3::from_column_slice(p) - setting.place.position;
                back(p.as_slice(), setting.length)
            })
            .collect();
        keep("position".into(), place);
        let per_time = [(NodeQuantity::Velocity, 1), (NodeQuantity::Acceleration, 2)];
        for (quantity, order) in per_time {
            let values = solution.node(node, quantity, &times).unwrap();
            let (linear, angular): (Vec<_>, Vec<_>) = values
                .chunks_exact(6)
                .map(|v| {
                    let rate = setting.time.powi(-order);
                    (back(&v[..3], setting.length * rate), back(&v[3..], rate))
                })
                .unzip();
            keep(format!("{quantity:?}"), linear.concat());
            keep(format!("angular {quantity:?}"), angular.concat());
        }
    }
    for joint in mechanism.joints {
        let reaction = JointQuantity::Reaction(ResolvedIn::Space);
        let values = solution.joint(joint, reaction, &times).unwrap();
        let (forces, moments): (Vec<_>, Vec<_>) = values
            .chunks_exact(6)
            .map(|r| (back(&r[..3], force), back(&r[3..], moment)))
            .unzip();
        keep("reaction force".into(), forces.concat());
        keep("reaction moment".into(), moments.concat());
    }
    let torque = JointQuantity::DrivingEffort(Coordinate::Rotation1);
    let torque = solution.joint(mechanism.joints[3], torque, &times);
    keep(
        "torque".into(),
        torque.unwrap().iter().map(|m| m / moment).collect(),
    );
    for first in mechanism.bars {
        let values = solution.beam(first + 1, 0.3, BeamQuantity::Force, &times);
        let (forces, moments): (Vec<_>, Vec<_>) = values
            .unwrap()
            .chunks_exact(6)
            .map(|f| {
                let half = |f: &[f64], unit: f64| f.iter().map(|x| x / unit).collect::<Vec<_>>();
                (half(&f[..3], force), half(&f[3..], moment))
            })
            .unzip();
        keep("beam force".into(), forces.concat());
        keep("beam moment".into(), moments.concat());
    }
    curves
}

fn assert_same(other: Setting) {
    let (own, other) = (response(Setting::default()), response(other));
    for (kind, a) in &own {
        let size = largest(a.iter().copied());
        let difference = largest_difference(a, &other[kind]) / size;
        println!("{kind}: size {size:.2e}, relative difference {difference:.1e}");
        assert!(size > 0.0 && difference < TOLERANCE, "{kind}: {difference}");
    }
}

fn elsewhere() -> Motion {
    let turn = Vector3::new(0.83, -1.91, 1.27);
    Motion::new(rotation_from_vector(&turn), Vector3::new(1.7, -0.9, 2.3))
}

#[test]
fn a_moved_mechanism_does_the_same() {
    assert!((elsewhere().rotation - Matrix3::identity()).amax() > 0.5);
    assert_same(Setting {
        place: elsewhere(),
        ..Setting::default()
    });
}

#[test]
fn other_units_give_the_same() {
    // kg → g, m → mm, s → ms.
    assert_same(Setting {
        mass: 1e3,
        length: 1e3,
        time: 1e3,
        ..Setting::default()
    });
}

#[test]
fn uneven_units_give_the_same() {
    // Pounds, inches and minutes, moved as well.
    assert_same(Setting {
        place: elsewhere(),
        mass: 1.0 / 0.453_592_37,
        length: 1.0 / 0.0254,
        time: 1.0 / 60.0,
    });
}
