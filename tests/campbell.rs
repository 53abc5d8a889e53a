//! Charts of exponents along a branch, and what moves in them.

mod common;

use common::*;
use nalgebra::{Complex, DMatrix, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::error::ErrorKind;
use periodyn::model::{JointCoordinate, Model};
use periodyn::motion::Motion;
use periodyn::solve::{Branch, BranchOptions, Free, StabilityOptions, follow_branch};
use std::f64::consts::TAU;

type C64 = Complex<f64>;

/// Of the hub on its springs, of the blades' lag.
const HUB: [f64; 2] = [900.0, 4.0];
const LAG: [f64; 2] = [25.0, 0.6];

/// A level rotor of three blades in its plane, on a hub on springs alike in all directions, which
/// turns so many times a period; and the blades, one after the other around it.
fn rotor(speed: f64, turns: f64) -> (Model, [usize; 3]) {
    let mut model = Model::new();
    let hub = ball(&mut model, 3.0, 1.0, &Vector3::zeros());
    let frame = Motion::identity();
    let joint = model
        .add_joint(JointKind::Planar, None, Some(hub), &frame, &frame)
        .unwrap();
    let turn = steady(speed * turns);
    model.prescribe(rotation1(joint), &turn).unwrap();
    for coordinate in [Coordinate::Displacement1, Coordinate::Displacement2] {
        let at = JointCoordinate { joint, coordinate };
        model
            .add_polynomial_spring_damper(at, &[HUB[0]], &[HUB[1]], 0.0)
            .unwrap();
    }
    let blades = [0, 1, 2].map(|k| {
        let angle = TAU * f64::from(k) / 3.0;
        let out = Vector3::new(angle.cos(), angle.sin(), 0.0);
        let blade = ball(&mut model, 2.0, 2.0, &(out * 1.3));
        let hinge = revolute(
            &mut model,
            Some(hub),
            Some(blade),
            &(out * 0.3),
            &Vector3::z(),
        );
        model
            .add_polynomial_spring_damper(rotation1(hinge), &[LAG[0]], &[LAG[1]], 0.0)
            .unwrap();
        blade
    });
    (model, blades)
}

/// An exponent of the same rotor by Coleman's coordinates, seen from the ground, and how the
/// pattern of the blades goes around, seen from them: collective is 0, with the rotation 1, against
/// it −1.
fn coleman(speed: f64) -> Vec<(C64, i32)> {
    let [x, y, mean, cosine, sine] = [0, 1, 2, 3, 4];
    let (inertia, static_moment) = (4.0, 2.0);
    let stiffness = LAG[0] + static_moment * 0.3 * speed * speed;
    let [mut m, mut c, mut k] = [(); 3].map(|()| DMatrix::<f64>::zeros(5, 5));
    for i in [x, y] {
        (m[(i, i)], c[(i, i)], k[(i, i)]) = (9.0, HUB[1], HUB[0]);
    }
    for i in [mean, cosine, sine] {
        (m[(i, i)], c[(i, i)], k[(i, i)]) = (inertia, LAG[1], stiffness);
    }
    for i in [cosine, sine] {
        k[(i, i)] -= inertia * speed * speed;
    }
    (c[(cosine, sine)], c[(sine, cosine)]) = (2.0 * inertia * speed, -2.0 * inertia * speed);
    (k[(cosine, sine)], k[(sine, cosine)]) = (LAG[1] * speed, -LAG[1] * speed);
    (m[(cosine, y)], m[(sine, x)]) = (static_moment, -static_moment);
    (m[(y, cosine)], m[(x, sine)]) = (1.5 * static_moment, -1.5 * static_moment);
    let inverse = m.clone().try_inverse().unwrap();
    let mut first_order = DMatrix::zeros(10, 10);
    first_order.view_mut((0, 5), (5, 5)).fill_diagonal(1.0);
    let (by_place, by_rate) = (-(&inverse * &k), -(&inverse * &c));
    first_order.view_mut((5, 0), (5, 5)).copy_from(&by_place);
    first_order.view_mut((5, 5), (5, 5)).copy_from(&by_rate);
    let all = first_order.complex_eigenvalues();
    let positive = all.iter().copied().filter(|s| s.im > 0.0);
    let with_pattern = positive.map(|s| {
        let complex = |m: &DMatrix<f64>| m.map(C64::from);
        let matrix = complex(&m) * (s * s) + complex(&c) * s + complex(&k);
        let svd = matrix.svd(false, true);
        let null = svd.v_t.unwrap().row(4).map(|x| x.conj());
        if null[mean].norm() > 0.9 {
            return (s, 0);
        }
        // a cos ψ + b sin ψ = (a + i b) e^{−iψ} / 2 + ...: of e^{i(ωt − ψ)} that goes forwards.
        let forwards = (null[cosine] + C64::i() * null[sine]).norm();
        let backwards = (null[cosine] - C64::i() * null[sine]).norm();
        assert!(forwards.min(backwards) < 1e-8 * forwards.max(backwards));
        let seen_from_blades = match forwards > backwards {
            true => s.im - speed,
            false => -s.im - speed,
        };
        (s, seen_from_blades.signum() as i32)
    });
    with_pattern.collect()
}

fn follow(model: &Model, speed: f64) -> Branch {
    let options = BranchOptions {
        periodic: options(3),
        range: [speed, 2.0 * speed],
        largest_step: 0.25,
        ..BranchOptions::default()
    };
    let branch = follow_branch(
        model,
        TAU / speed,
        Free::Frequency,
        &options,
        &mut |_, _| true,
    );
    branch.unwrap()
}

/// Lines of a chart, without that of names.
fn chart(branch: &Branch, blades: &[usize]) -> (String, Vec<Vec<String>>) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("chart.csv");
    let options = StabilityOptions::default();
    branch.write_campbell(&path, &options, blades).unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(String::from);
    let names = lines.next().unwrap();
    let split = |line: String| line.split(',').map(String::from).collect();
    (names, lines.map(split).collect())
}

#[test]
fn patterns_of_a_rotor_are_those_of_coleman() {
    // In the order of the blades and against it, which changes no pattern.
    for (turns, start) in [(1.0, 3.0), (-1.0, 3.0), (1.0, 8.0)] {
        let (model, blades) = rotor(start, turns);
        let branch = follow(&model, start);
        assert!(branch.points.len() > 4);
        let (names, lines) = chart(&branch, &blades);
        assert_eq!(
            names,
            "frequency,period,growth,mode_frequency,frequency_from_ground,multiplier,error,share,\
             content"
        );
        assert_eq!(lines.len(), 5 * branch.points.len());
        for (point, lines) in branch.points.iter().zip(lines.chunks(5)) {
            let speed = point.values[0];
            let mut expected = coleman(speed);
            for line in lines {
                let numbers: Vec<f64> = line[..8].iter().map(|x| x.parse().unwrap()).collect();
                let found = C64::new(numbers[2], numbers[4]);
                let off = |s: &C64| (s - found).norm();
                let near = |a: &&(C64, i32), b: &&(C64, i32)| off(&a.0).total_cmp(&off(&b.0));
                let nearest = *expected.iter().min_by(near).unwrap();
                expected.retain(|other| other.0 != nearest.0);
                println!("{speed}: {found} {} for {nearest:?}", line[8]);
                assert!((numbers[0] - speed).abs() < 1e-12);
                // Multipliers to 1e-8, and exponents to that over the period.
                assert!(off(&nearest.0) < 1e-7, "{found} for {}", nearest.0);
                let name = match nearest.1 {
                    0 => "collective",
                    1 => "diameter 1 progressive",
                    _ => "diameter 1 regressive",
                };
                assert_eq!(line[8], name);
                // One pattern alone, as the rotor and its springs are alike in all directions.
                assert!((numbers[7] - 1.0).abs() < 1e-6, "{}", numbers[7]);
            }
        }
    }
}

#[test]
fn without_blades_it_is_the_node_that_moves_most() {
    let (mut model, _) = rotor(3.0, 1.0);
    model
        .set_label(periodyn::model::ObjectKind::Node, 1, "first blade")
        .unwrap();
    let branch = follow(&model, 3.0);
    let (_, lines) = chart(&branch, &[]);
    // Names with labels, which have quotes, are in quotes of the table.
    let name = |line: &Vec<String>| line[8].trim_start_matches('"').to_string();
    assert!(lines.iter().all(|line| name(line).starts_with("node ")));
    assert!(lines.iter().any(|line| line[8].contains("first blade")));
}

#[test]
fn what_is_no_chart_is_refused() {
    let (model, [first, second, third]) = rotor(3.0, 1.0);
    let branch = follow(&model, 3.0);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("chart.csv");
    let options = StabilityOptions::default();
    for (blades, kind, why) in [
        (vec![first], ErrorKind::Size, "two nodes at least"),
        (vec![first, second, first], ErrorKind::Value, "twice"),
        (vec![first, second, 99], ErrorKind::Identifier, "node"),
        (vec![first, second, third, 0], ErrorKind::Value, "on it"),
    ] {
        let error = branch.write_campbell(&path, &options, &blades).unwrap_err();
        assert!(
            error.kind() == kind && error.to_string().contains(why),
            "{error}"
        );
        assert!(!path.exists());
    }
}
