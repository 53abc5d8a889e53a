//! Section forces of beams at the ends of elements, where joints and welds are, against equilibrium.

use nalgebra::Vector3;
use periodyn::elements::{JointKind, LoadFrame};
use periodyn::model::*;
use periodyn::output::{BeamQuantity, Solution};
use periodyn::solve::*;

const LENGTH: f64 = 60.0;
const LOAD: f64 = 10.0;

/// A cantilever under a uniform load, uniform or tapered to a twentieth of its stiffness.
fn cantilever(taper: f64, elements: usize, degree: usize) -> (Solution, BeamIds) {
    let mut model = Model::new();
    let stiffness = [9e9, 2e9, 2e9, 2e9, 18e9, 18e9];
    let mass = [600.0, 200.0, 100.0, 100.0];
    let root = SectionInput::diagonal(&stiffness, &mass).unwrap();
    let tip = SectionInput::diagonal(&stiffness.map(|k| k * taper), &mass).unwrap();
    let station = |fraction: f64, section: SectionInput| SectionStation {
        fraction,
        section,
        twist: 0.0,
    };
    let end = Vector3::x() * LENGTH;
    let line = straight_line(&Vector3::zeros(), &end, &Vector3::y()).unwrap();
    let stations = [station(0.0, root), station(1.0, tip)];
    let ids = model
        .add_beam_along(line, &stations, elements, degree)
        .unwrap();
    let frame = *model.node(ids.first_node).unwrap();
    model
        .add_joint(JointKind::Rigid, None, Some(ids.first_node), &frame, &frame)
        .unwrap();
    let mut components = [const { None }; 6];
    components[1] = Some(Signal::constant(LOAD).unwrap());
    let load = DistributedLoadDefinition {
        first_element: ids.first_element,
        elements,
        frame: LoadFrame::Space.into(),
        components,
        factors: vec![],
    };
    model.add_distributed_load(load).unwrap();
    let solution =
        Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    (solution, ids)
}

/// Largest errors of shear and moment at all ends of elements, as parts of those at the root.
fn errors(taper: f64, elements: usize, degree: usize) -> [f64; 2] {
    let (solution, ids) = cantilever(taper, elements, degree);
    let mut worst = [0.0f64; 2];
    for element in 0..elements {
        for (end, station) in [(0.0, -1.0), (1.0, 1.0)] {
            let left = 1.0 - (element as f64 + end) / elements as f64;
            let id = ids.first_element + element;
            let force = solution
                .beam(id, station, BeamQuantity::Force, &[0.0])
                .unwrap();
            let (shear, moment) = (LOAD * LENGTH, 0.5 * LOAD * LENGTH * LENGTH);
            // Small displacements: 1e-7 of the length.
            worst[0] = worst[0].max((force[1] / shear - left).abs());
            worst[1] = worst[1].max((force[5] / moment - left * left).abs());
        }
    }
    worst
}

#[test]
fn four_cubic_elements_have_them_within_two_percent_at_all_ends() {
    for taper in [1.0, 0.05] {
        let [shear, moment] = errors(taper, 4, 3);
        println!("{taper}: {shear:.2e} {moment:.2e}");
        assert!(shear < 0.02 && moment < 0.02, "{taper}: {shear} {moment}");
    }
}

#[test]
fn they_converge_with_the_degree_as_their_order() {
    for taper in [1.0, 0.05] {
        for degree in 1..=4 {
            let all = [4, 8, 16].map(|elements| errors(taper, elements, degree));
            println!("{taper} {degree}: {all:?}");
            for quantity in [0, 1] {
                for pair in all.windows(2) {
                    let (coarse, fine) = (pair[0][quantity], pair[1][quantity]);
                    // The order, less a quarter while it sets in; or exact, up to the displacements' part of the length.
                    let order = (coarse / fine).log2();
                    assert!(
                        order > degree as f64 - 0.25 || fine < 1e-6,
                        "{taper} {degree}: {coarse:e} {fine:e}"
                    );
                }
            }
        }
    }
}
