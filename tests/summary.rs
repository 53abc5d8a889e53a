//! The model summary: counts, mobility and warnings of known mechanisms.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::model::{
    JointCoordinate, Model, SectionInput, SectionStation, Signal, SpringDefinition, straight_line,
};
use periodyn::motion::Motion;
use periodyn::system::Summary;

fn ball(model: &mut Model, at: Vector3<f64>) -> usize {
    model
        .add_rigid_body(2.0, &at, &(0.1 * Matrix3::identity()))
        .unwrap()
}

fn summary(model: &Model) -> Summary {
    let summary = Summary::of(model).unwrap();
    println!("{summary}");
    summary
}

#[test]
fn the_flexible_four_bar_has_one_freedom_if_rigid() {
    // 7.2: revolute, spherical, universal, revolute: 5 + 3 + 4 + 5 constraints on three bars, one
    // drive.
    let mechanism = FourBar {
        elements: 4,
        ..FourBar::default()
    }
    .build();
    let found = summary(&mechanism.model);
    assert_eq!(
        (found.nodes, found.beam_elements, found.joints),
        (15, 12, 4)
    );
    assert_eq!(
        (found.prescribed, found.constraints, found.redundant),
        (1, 18, 0)
    );
    assert_eq!(found.freedoms, 6 * 15 - 18);
    assert_eq!(
        (found.members, found.mobility, found.redundant_if_rigid),
        (3, 0, 0)
    );
    assert_eq!((found.parts, found.warnings.len()), (1, 0));
    // Mass of the bars: 1.997 kg/m and 0.4992 kg/m.
    let length = |v: [f64; 3]| Vector3::from(v).norm();
    let mass = 1.997 * (length([0.35, 0.0, 0.652]) + length([0.75, 0.85, 0.452])) + 0.4992 * 0.2;
    assert!(
        (found.mass - mass).abs() < 1e-12 * mass,
        "{}",
        found.mass - mass
    );
}

#[test]
fn planar_loops_of_revolutes_are_mechanisms_with_redundancy() {
    // Rigid: Grübler counts 6·3 − 20 = −2, the loop moves all the same: three constraints are
    // redundant.
    let points = [(0.0, 0.0), (0.2, 1.0), (2.2, 1.4), (2.0, 0.0)];
    let points = points.map(|(x, y)| Vector3::new(x, y, 0.0));
    let section = SectionInput::diagonal(&[1e6, 4e5, 4e5, 50.0, 80.0, 80.0], &[1.0; 4]).unwrap();
    for flexible in [false, true] {
        let mut model = Model::new();
        let mut ends = Vec::new();
        for pair in points.windows(2) {
            if flexible {
                let beam = model
                    .add_straight_beam(&pair[0], &pair[1], &Vector3::z(), &section, 2, 2)
                    .unwrap();
                ends.push((Some(beam.first_node), Some(beam.last_node)));
            } else {
                let bar = Some(ball(&mut model, 0.5 * (pair[0] + pair[1])));
                ends.push((bar, bar));
            }
        }
        let z = Vector3::z();
        revolute(&mut model, None, ends[0].0, &points[0], &z);
        revolute(&mut model, ends[0].1, ends[1].0, &points[1], &z);
        revolute(&mut model, ends[1].1, ends[2].0, &points[2], &z);
        revolute(&mut model, ends[2].1, None, &points[3], &z);
        let found = summary(&model);
        assert_eq!(found.redundant, if flexible { 0 } else { 3 });
        assert_eq!(
            (found.members, found.mobility, found.redundant_if_rigid),
            (3, 1, 3)
        );
    }
}

#[test]
fn free_bodies_and_unconnected_parts_are_named() {
    let mut model = Model::new();
    let held = ball(&mut model, Vector3::zeros());
    let (a, b) = (
        ball(&mut model, Vector3::x()),
        ball(&mut model, 2.0 * Vector3::x()),
    );
    revolute(
        &mut model,
        None,
        Some(held),
        &Vector3::zeros(),
        &Vector3::z(),
    );
    let frame = Model::frame_at("axis", &Vector3::x(), &Vector3::z()).unwrap();
    model
        .add_joint(JointKind::Spherical, Some(a), Some(b), &frame, &frame)
        .unwrap();
    let found = summary(&model);
    assert_eq!((found.parts, found.mobility), (2, 1 + 9));
    assert!(
        found.warnings[0].contains("nodes 1, 2"),
        "{:?}",
        found.warnings
    );
    // A satellite is one part, with nothing to warn of.
    let mut model = Model::new();
    ball(&mut model, Vector3::zeros());
    let found = summary(&model);
    assert_eq!(
        (found.parts, found.mobility, found.warnings.len()),
        (1, 6, 0)
    );
    assert_eq!((found.mass, found.centre), (2.0, Vector3::zeros()));
}

#[test]
fn likely_mistakes_are_warned_of() {
    let warns_of = |model: &Model, words: &[&str]| {
        let found = summary(model);
        assert_eq!(found.warnings.len(), 1, "{:?}", found.warnings);
        for word in words {
            assert!(found.warnings[0].contains(word), "{:?}", found.warnings);
        }
    };
    let beam = |stiffness: [f64; 6], mass: [f64; 4]| {
        let section = SectionInput::diagonal(&stiffness, &mass).unwrap();
        let mut model = Model::new();
        model
            .add_straight_beam(
                &Vector3::zeros(),
                &Vector3::x(),
                &Vector3::y(),
                &section,
                1,
                2,
            )
            .unwrap();
        model
    };
    let good = [1e6, 4e5, 4e5, 50.0, 80.0, 80.0];
    assert!(summary(&beam(good, [1.0; 4])).warnings.is_empty());
    warns_of(&beam(good, [0.0; 4]), &["beam element 0", "no mass"]);
    // Second moments of area in the wrong unit.
    let soft = [1e6, 4e5, 4e5, 5e-5, 8e-5, 8e-5];
    warns_of(
        &beam(soft, [1.0, 0.0, 0.0, 0.0]),
        &["beam element 0", "bending", "units"],
    );
    let no_shear = [1e6, 4.0, 4.0, 50.0, 80.0, 80.0];
    warns_of(&beam(no_shear, [1.0; 4]), &["beam element 0", "shear"]);

    let mut model = Model::new();
    let impossible = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.5));
    model
        .add_rigid_body(1.0, &Vector3::x(), &impossible)
        .unwrap();
    warns_of(&model, &["node 0", "moments of inertia"]);

    let mut model = Model::new();
    let body = ball(&mut model, Vector3::x());
    let at = |x: f64| Model::frame_at("axis", &Vector3::new(x, 0.0, 0.0), &Vector3::z()).unwrap();
    model
        .add_joint(JointKind::Revolute, None, Some(body), &at(0.0), &at(0.01))
        .unwrap();
    warns_of(&model, &["joint 0", "open"]);

    let mut model = Model::new();
    ball(&mut model, Vector3::x());
    let bare = model
        .add_node(&periodyn::motion::Motion::identity())
        .unwrap();
    let frame = at(0.5);
    model
        .add_joint(JointKind::Rigid, Some(0), Some(bare), &frame, &frame)
        .unwrap();
    warns_of(&model, &["node 1", "neither inertia nor a beam"]);
}

#[test]
fn motions_that_need_their_own_period_are_no_obstacle() {
    let mut model = Model::new();
    let body = ball(&mut model, Vector3::x());
    revolute(
        &mut model,
        None,
        Some(body),
        &Vector3::zeros(),
        &Vector3::z(),
    );
    let turn = Signal::harmonics(0.0, 17.3, &[0.1], &[0.2]).unwrap();
    model.prescribe(rotation1(0), &turn).unwrap();
    let found = summary(&model);
    assert_eq!(
        (found.mobility, found.freedoms, found.constraints),
        (0, 0, 6)
    );
}

/// Warnings of a model, each with one of these words.
fn assert_warnings(model: &Model, words: &[&str]) {
    let found = summary(model).warnings;
    assert_eq!(found.len(), words.len(), "{found:?}");
    for (warning, words) in found.iter().zip(words) {
        assert!(warning.contains(words), "{found:?}");
    }
}

/// A beam of 1 m on the ground, and what else there is, with lengths times `unit`.
fn cantilever(unit: f64, stiffness: [f64; 6], mass: [f64; 4]) -> Model {
    let section = SectionInput::diagonal(&stiffness, &mass).unwrap();
    let mut model = Model::new();
    let (start, end) = (Vector3::zeros(), unit * Vector3::x());
    let beam = model
        .add_straight_beam(&start, &end, &Vector3::y(), &section, 4, 2)
        .unwrap();
    let clamp = Model::frame_at("axis", &start, &Vector3::z()).unwrap();
    let first = Some(beam.first_node);
    model
        .add_joint(JointKind::Rigid, None, first, &clamp, &clamp)
        .unwrap();
    model
}

#[test]
fn millimetres_among_metres_are_warned_of() {
    // A steel bar of 20 mm by 10 mm, 1 m long, in metres throughout.
    let (area, i2, i3) = (2e-4, 6.7e-9, 1.7e-9);
    let stiffness = |e: f64, area: f64, i2: f64, i3: f64| {
        let g = 0.4 * e;
        [e * area, g * area, g * area, g * (i2 + i3), e * i2, e * i3]
    };
    let mass = [7850.0 * area, 6.6e-5, 5.3e-5, 1.3e-5];
    let metres = stiffness(2.1e11, area, i2, i3);
    assert_warnings(&cantilever(1.0, metres, mass), &[]);
    // Coordinates in millimetres.
    assert_warnings(&cantilever(1000.0, metres, mass), &["very soft in bending"]);
    // Areas in metres, second moments in millimetres.
    let mut mixed = metres;
    (3..6).for_each(|i| mixed[i] *= 1e12);
    assert_warnings(
        &cantilever(1.0, mixed, mass),
        &["very stiff in bending", "by mass"],
    );
    // Inertia for each length in kilograms and millimetres, and that of a body.
    let wrong = [mass[0], 1e6 * mass[1], 1e6 * mass[2], 1e6 * mass[3]];
    assert_warnings(&cantilever(1.0, metres, wrong), &["by mass"]);
    for (inertia, words) in [(1e-3, &[][..]), (1e3, &["another order of size"][..])] {
        let mut model = cantilever(1.0, metres, mass);
        let ball = Matrix3::from_diagonal_element(inertia);
        let body = model.add_rigid_body(1.0, &Vector3::x(), &ball).unwrap();
        let at = Model::frame_at("axis", &Vector3::x(), &Vector3::z()).unwrap();
        model
            .add_joint(JointKind::Rigid, Some(8), Some(body), &at, &at)
            .unwrap();
        assert_warnings(&model, words);
    }
}

#[test]
fn a_forgotten_joint_is_warned_of() {
    let good = [1e6, 4e5, 4e5, 50.0, 80.0, 80.0];
    // A hub at the beam's end that only a spring to the ground holds.
    let with_hub = |joined: bool, stiffness: f64| {
        let mut model = cantilever(1.0, good, [1.0; 4]);
        let hub = ball(&mut model, Vector3::x());
        let at = Model::frame_at("axis", &Vector3::x(), &Vector3::z()).unwrap();
        if joined {
            model
                .add_joint(JointKind::Rigid, Some(8), Some(hub), &at, &at)
                .unwrap();
        }
        let free = model
            .add_joint(JointKind::Free, None, Some(hub), &at, &at)
            .unwrap();
        let at = JointCoordinate {
            joint: free,
            coordinate: Coordinate::Displacement3,
        };
        let spring = SpringDefinition {
            at,
            stiffness,
            damping: 1.0,
            rest: 0.0,
        };
        model.add_spring_damper(spring).unwrap();
        model
    };
    assert_warnings(&with_hub(true, 0.0), &[]);
    assert_warnings(&with_hub(false, 5.0), &["nodes 8, 9 are at the same place"]);
    let words = ["nothing holds node 9", "nodes 8, 9 are at the same place"];
    assert_warnings(&with_hub(false, 0.0), &words);
}

#[test]
fn a_joint_far_from_all_else_is_warned_of() {
    for (far, words) in [(1.5, &[][..]), (10.0, &["joint 1 is 9."][..])] {
        let mut model = Model::new();
        let bars = [0.5, 1.5].map(|x| Some(ball(&mut model, x * Vector3::x())));
        let z = Vector3::z();
        revolute(&mut model, None, bars[0], &Vector3::zeros(), &z);
        revolute(&mut model, bars[0], bars[1], &(far * Vector3::x()), &z);
        assert_warnings(&model, words);
    }
}

#[test]
fn mass_centre_and_inertia_of_bodies_and_beams_are_told() {
    // A body that is turned by a third about (1, 1, 1): its axes 1, 2, 3 are the inertial 2, 3, 1.
    let mut model = Model::new();
    let turn = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    let at = Vector3::new(1.0, -2.0, 3.0);
    let body = model.add_node(&Motion::new(turn, at)).unwrap();
    let moments = Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.25));
    let offset = Motion::new(Matrix3::identity(), Vector3::new(0.5, 0.0, 0.0));
    model
        .add_mass(
            body,
            2.0,
            &(at + turn * offset.position),
            &(turn * moments * turn.transpose()),
        )
        .unwrap();
    // A uniform bar of length 3 along axis 2, whose stations are inside its elements.
    let section = SectionInput::diagonal(&[1e6; 6], &[4.0, 0.0, 0.0, 0.0]).unwrap();
    let line = straight_line(&Vector3::zeros(), &(3.0 * Vector3::y()), &Vector3::z()).unwrap();
    let stations = [0.0, 0.3, 0.7, 1.0].map(|fraction| SectionStation {
        fraction,
        section,
        twist: 0.0,
    });
    model.add_beam_along(line, &stations, 2, 3).unwrap();
    let found = summary(&model);
    assert_eq!(found.inner_stations, 2);
    let [one, bar] = &found.mass_properties[..] else {
        panic!("{:?}", found.mass_properties);
    };
    let close = |a: &[f64], b: &[f64]| {
        // Rounding of sums over the nodes.
        assert!(
            a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13 * 12.0),
            "{a:?} {b:?}"
        );
    };
    assert_eq!((&one.nodes[..], one.beam_elements), (&[0][..], 0));
    close(&[one.mass], &[2.0]);
    close(one.centre.as_slice(), &[1.0, -1.5, 3.0]);
    let turned = Matrix3::from_diagonal(&Vector3::new(0.25, 0.1, 0.2));
    close(one.inertia.as_slice(), turned.as_slice());
    assert_eq!((bar.nodes.len(), bar.beam_elements), (7, 2));
    close(&[bar.mass], &[12.0]);
    close(bar.centre.as_slice(), &[0.0, 1.5, 0.0]);
    let slender = Matrix3::from_diagonal(&Vector3::new(9.0, 0.0, 9.0));
    close(bar.inertia.as_slice(), slender.as_slice());
    let text = found.to_string();
    assert!(text.contains(
        "nodes 1 to 7, 2 beam elements: mass 12, centre (0, 1.5, 0), inertia 11 22 33 (9, 0, 9)"
    ));
    assert!(text.contains("2 stations of sections inside beam elements"));
}
