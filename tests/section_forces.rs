//! Section forces of beams at the ends of elements, where joints and welds are, against equilibrium
//! and closed forms.

#[path = "common/vtk.rs"]
mod vtk;

mod common;

use common::clamp;
use nalgebra::{Matrix2, Matrix4, Vector2, Vector3};
use periodyn::elements::LoadFrame;
use periodyn::model::*;
use periodyn::output::{BeamQuantity, Quantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;
use vtk::Piece;

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
    clamp(&mut model, ids.first_node);
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
                    // The order, less a quarter while it sets in; or exact, up to the
                    // displacements' part of the length.
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

const STIFFNESS: [f64; 6] = [9e5, 4e5, 4e5, 9e4, 8e4, 8e4];
const MASS: [f64; 4] = [12.0, 0.4, 0.2, 0.2];
const SPAN: f64 = 3.0;
const PUSH: f64 = 1e-3;
/// Between the first and the second frequency of bending.
const OMEGA: f64 = 60.0;

/// A cantilever with a force `PUSH cos OMEGA t` along axis 2 at its tip.
fn shaken(elements: usize, degree: usize) -> (Solution, BeamIds) {
    let mut model = Model::new();
    let section = SectionInput::diagonal(&STIFFNESS, &MASS).unwrap();
    let end = Vector3::x() * SPAN;
    let ids = model
        .add_straight_beam(
            &Vector3::zeros(),
            &end,
            &Vector3::y(),
            &section,
            elements,
            degree,
        )
        .unwrap();
    clamp(&mut model, ids.first_node);
    let mut force = [const { None }; 6];
    force[1] = Some(Signal::harmonics(0.0, 0.0, &[PUSH], &[0.0]).unwrap());
    model
        .add_load(ids.last_node, LoadFrame::Space, force)
        .unwrap();
    let options = PeriodicOptions::with_grid_points(5);
    let solution = Solution::solve(&model, TAU / OMEGA, &options, &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    (solution, ids)
}

/// `[w, ψ, Q, M]` along the beam, by that at its root: Timoshenko's beam with rotary inertia at one
/// frequency, `w' = ψ + Q / GA`, `ψ' = M / EI`, `Q' = −ρA ω² w`, `M' = −Q − ρI ω² ψ`.
fn carried(along: f64) -> Matrix4<f64> {
    let square = OMEGA * OMEGA;
    #[rustfmt::skip]
    let slope = Matrix4::new(
        0.0, 1.0, 1.0 / STIFFNESS[1], 0.0,
        0.0, 0.0, 0.0, 1.0 / STIFFNESS[5],
        -MASS[0] * square, 0.0, 0.0, 0.0,
        0.0, -MASS[3] * square, -1.0, 0.0,
    );
    (slope * along).exp()
}

/// Amplitudes of shear and moment at a place, exactly: nothing moves at the root, the push is all
/// at the tip.
fn exact(along: f64) -> Vector2<f64> {
    let tip = carried(SPAN);
    let by_root = Matrix2::from_fn(|i, j| tip[(2 + i, 2 + j)]);
    let root = by_root.lu().solve(&Vector2::new(PUSH, 0.0)).unwrap();
    let here = carried(along);
    Vector2::from_fn(|i, _| here[(2 + i, 2)] * root[0] + here[(2 + i, 3)] * root[1])
}

/// Largest errors at ends of elements of shear and moment as parts of the largest there are: of
/// each element's own, and of means of two elements.
fn errors_when_shaken(elements: usize, degree: usize) -> [[f64; 2]; 2] {
    let (solution, ids) = shaken(elements, degree);
    let largest = (0..=30)
        .map(|i| exact(SPAN * f64::from(i) / 30.0).abs())
        .fold(Vector2::zeros(), |a: Vector2<f64>, b| a.sup(&b));
    let mut worst = [[0.0f64; 2]; 2];
    for element in 0..elements {
        for station in [-1.0, 1.0] {
            let at = (element as f64 + 0.5 * (1.0 + station)) / elements as f64;
            let expected = exact(SPAN * at);
            let inside = at > 1e-9 && at < 1.0 - 1e-9;
            for (kind, quantity) in [BeamQuantity::Force, BeamQuantity::MeanForce]
                .into_iter()
                .enumerate()
            {
                let force = solution
                    .beam(ids.first_element + element, station, quantity, &[0.0])
                    .unwrap();
                if kind == 0 || inside {
                    for (i, part) in [force[1], force[5]].into_iter().enumerate() {
                        worst[kind][i] =
                            worst[kind][i].max((part - expected[i]).abs() / largest[i]);
                    }
                }
            }
        }
    }
    worst
}

#[test]
fn those_of_a_shaken_cantilever_converge_as_documented() {
    for degree in 1..=4 {
        let all = [8, 16, 32].map(|elements| errors_when_shaken(elements, degree));
        println!("{degree}: {all:?}");
        for pair in all.windows(2) {
            for (kind, quantity) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let (coarse, fine) = (pair[0][kind][quantity], pair[1][kind][quantity]);
                let gained = f64::from(u8::from(kind == 1 && degree % 2 == 1));
                // The order, less a little while it sets in; or the part of stretching, of second
                // order in displacements.
                let order = (coarse / fine).log2();
                assert!(
                    order > degree as f64 + gained - 0.3 || fine < 1e-7,
                    "{degree} {kind} {quantity}: {coarse:e} {fine:e}"
                );
            }
        }
    }
}

#[test]
fn four_cubic_elements_have_those_at_a_shaken_root_within_two_percent() {
    let (solution, ids) = shaken(4, 3);
    let root = solution
        .beam(ids.first_element, -1.0, BeamQuantity::Force, &[0.0])
        .unwrap();
    let expected = exact(0.0);
    println!("{root:?} {expected}");
    assert!((root[1] / expected[0] - 1.0).abs() < 0.02);
    assert!((root[5] / expected[1] - 1.0).abs() < 0.02);
}

#[test]
fn a_jump_is_what_two_elements_differ_by() {
    let (solution, ids) = shaken(3, 2);
    let at = |element: usize, station: f64, quantity| {
        let times = [0.0, 0.01];
        solution
            .beam(ids.first_element + element, station, quantity, &times)
            .unwrap()
    };
    use BeamQuantity::{Force, ForceJump, MeanForce};
    let (before, after) = (at(0, 1.0, Force), at(1, -1.0, Force));
    assert!(before != after);
    // But for the rounding of series.
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * PUSH * SPAN, "{a} {b}");
    for (element, station) in [(0, 1.0), (1, -1.0)] {
        for i in 0..12 {
            near(at(element, station, ForceJump)[i], after[i] - before[i]);
            near(
                at(element, station, MeanForce)[i],
                (before[i] + after[i]) * 0.5,
            );
        }
    }
    // Within an element, at the free end and at the joint there is nothing to jump to.
    for (element, station) in [(1, 0.4), (2, 1.0), (0, -1.0)] {
        assert_eq!(at(element, station, ForceJump), [0.0; 12]);
        assert_eq!(at(element, station, MeanForce), at(element, station, Force));
    }
    let jump = Quantity::Beam {
        element: ids.first_element,
        station: 1.0,
        quantity: ForceJump,
    };
    let series = solution.series(jump).unwrap();
    assert!((series[5].value(0.01) - at(0, 1.0, ForceJump)[11]).abs() < 1e-15);
}

#[test]
fn a_node_with_a_load_keeps_its_jump() {
    let mut model = Model::new();
    let section = SectionInput::diagonal(&STIFFNESS, &MASS).unwrap();
    let end = Vector3::x() * SPAN;
    let ids = model
        .add_straight_beam(&Vector3::zeros(), &end, &Vector3::y(), &section, 2, 3)
        .unwrap();
    clamp(&mut model, ids.first_node);
    let mut force = [const { None }; 6];
    force[1] = Some(Signal::constant(PUSH).unwrap());
    let middle = ids.first_node + 3;
    model.add_load(middle, LoadFrame::Space, force).unwrap();
    let options = StaticOptions::default();
    let solution = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap();
    for (element, shear) in [(0, PUSH), (1, 0.0)] {
        let station = if element == 0 { 1.0 } else { -1.0 };
        let mean = solution.beam(element, station, BeamQuantity::MeanForce, &[0.0]);
        // Bent by 1e-8 of its length.
        assert!((mean.unwrap()[1] - shear).abs() < 1e-6 * PUSH);
        let jump = solution.beam(element, station, BeamQuantity::ForceJump, &[0.0]);
        assert_eq!(jump.unwrap(), [0.0; 6]);
    }
}

#[test]
fn an_animation_has_those_at_ends_of_elements() {
    const ELEMENTS: usize = 8;
    const POINTS: usize = 3;
    let (solution, _) = shaken(ELEMENTS, 3);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("shaken.pvd");
    solution.write_vtk(&[0.0], POINTS, &path).unwrap();
    let file = directory.path().join("shaken/beams_000000.vtp");
    let piece = Piece::read(&file);
    let names = [
        "force",
        "force_mean",
        "force_jump",
        "moment",
        "moment_mean",
        "moment_jump",
    ];
    let [
        force,
        force_mean,
        force_jump,
        moment,
        moment_mean,
        moment_jump,
    ] = names.map(|name| piece.at_points(name));
    let largest = exact(0.0).abs();
    // But for the rounding of series.
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * PUSH * SPAN, "{a} {b}");
    for element in 0..ELEMENTS {
        for i in 0..POINTS {
            let at = (element as f64 + i as f64 / (POINTS - 1) as f64) / ELEMENTS as f64;
            let expected = exact(SPAN * at);
            let first = 3 * (element * POINTS + i);
            // As each element's own errors above, 8 elements of degree 3; means are nearer.
            assert!((force[first + 1] - expected[0]).abs() < 2e-3 * largest[0]);
            assert!((moment[first + 2] - expected[1]).abs() < 2e-3 * largest[1]);
            assert!((force_mean[first + 1] - expected[0]).abs() < 2e-3 * largest[0]);
            assert!((moment_mean[first + 2] - expected[1]).abs() < 2e-3 * largest[1]);
            if i + 1 == POINTS && element + 1 < ELEMENTS {
                let next = first + 3;
                for k in 0..3 {
                    near(force_jump[first + k], force[next + k] - force[first + k]);
                    near(moment_jump[next + k], moment[next + k] - moment[first + k]);
                    near(force_mean[first + k], force_mean[next + k]);
                    let mean = (moment[first + k] + moment[next + k]) * 0.5;
                    near(moment_mean[next + k], mean);
                }
            }
        }
    }
}
