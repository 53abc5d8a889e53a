//! A real blade, whose 49 stations lie anywhere between the nodes.

#[path = "common/blade.rs"]
mod blade;
mod common;

use common::*;
use periodyn::elements::JointKind;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::Modes;
use periodyn::solve::*;
use std::f64::consts::TAU;

/// Mass and centre of sections that are linear between stations, exactly.
fn exact_mass(stations: &[SectionStation]) -> (f64, f64) {
    let (mut mass, mut moment) = (0.0, 0.0);
    for pair in stations.windows(2) {
        let (a, b) = (pair[0].fraction, pair[1].fraction);
        let (p, q) = (pair[0].section.mass[(0, 0)], pair[1].section.mass[(0, 0)]);
        let length = (b - a) * blade::LENGTH;
        mass += 0.5 * (p + q) * length;
        let arm = (a * (2.0 * p + q) + b * (p + 2.0 * q)) / 6.0 * blade::LENGTH;
        moment += arm * length;
    }
    (mass, moment / mass)
}

/// The first frequencies at rest, and the model.
fn frequencies(elements: usize, degree: usize) -> Vec<f64> {
    let mut model = Model::new();
    let ids = blade::add(&mut model, &blade::stations(true), elements, degree);
    let root = *model.node(ids.first_node).unwrap();
    model
        .add_joint(JointKind::Rigid, None, Some(ids.first_node), &root, &root)
        .unwrap();
    let options = ModesOptions {
        count: 8,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    modes
        .modes()
        .iter()
        .map(|m| m.eigenvalue.im / TAU)
        .collect()
}

#[test]
fn its_mass_is_exact_on_any_mesh() {
    let stations = blade::stations(true);
    let (mass, centre) = exact_mass(&stations);
    for (elements, degree) in [(1, 5), (2, 5), (4, 4), (48, 3)] {
        let mut model = Model::new();
        blade::add(&mut model, &stations, elements, degree);
        let (found, moment) = model.mass_and_moment();
        assert!(
            (found / mass - 1.0).abs() < 1e-12,
            "{elements} {degree}: {found} {mass}"
        );
        let off = (moment.z / found - centre).abs();
        assert!(off < 1e-12 * blade::LENGTH, "{elements} {degree}: {off:e}");
        assert!(moment.xy().norm() < 1e-9 * moment.z);
    }
}

#[test]
fn its_frequencies_on_four_elements_of_degree_four_are_those_of_a_fine_mesh() {
    for (elements, degree) in [(48, 3), (4, 4), (2, 5), (1, 5), (6, 3), (8, 2)] {
        println!("{elements} {degree} {:?}", frequencies(elements, degree));
    }
}
