//! Labels of a model, in messages, reports and files; and what a model that was loaded holds.

mod common;

use common::models::elements::all_elements;
use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{BeamLoadFrame, JointKind, LoadFrame};
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::output::{Modes, Solution};
use periodyn::solve::*;
use periodyn::system::Summary;

/// The same model, saved and loaded.
fn through_a_file(model: &Model, name: &str) -> Model {
    let path = std::env::temp_dir().join(format!("{name}_{}.pdm", std::process::id()));
    model.save(&path).unwrap();
    let loaded = Model::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    loaded
}

#[test]
fn labels_are_unique_in_their_kind_and_survive_files() {
    let (mut model, _) = all_elements();
    let all = [
        (ObjectKind::Node, 2, "crank, centre of mass"),
        (ObjectKind::Joint, 0, "Kurbelzapfen ⌀ 12"),
        (ObjectKind::BeamElement, 1, "blade"),
        (ObjectKind::Force, 3, "blade"),
        (ObjectKind::Relation, 0, "gear"),
        (ObjectKind::Load, 0, "thrust"),
        (ObjectKind::BeamLoad, 0, "lift"),
        (ObjectKind::Inertia, 0, "flywheel"),
        (ObjectKind::Prescribed, 0, "drive"),
    ];
    for (kind, id, label) in all {
        model.set_label(kind, id, label).unwrap();
    }
    for model in [&model.clone(), &through_a_file(&model, "labels")] {
        for (kind, id, label) in all {
            assert_eq!(model.label(kind, id), Some(label));
            assert_eq!(model.find_label(kind, label), Some(id));
        }
        assert_eq!(model.label(ObjectKind::Joint, 1), None);
        assert_eq!(model.find_label(ObjectKind::Joint, "gear"), None);
        let text = model
            .labels()
            .annotate("load 0 on node 0, beam load 0, inertias 0, 1");
        let named = "load 0 \"thrust\" on node 0, beam load 0 \"lift\", inertias 0 \"flywheel\", 1";
        assert_eq!(text, named);
    }
    // The same again, another one, and none.
    model.set_label(ObjectKind::Force, 3, "blade").unwrap();
    model.set_label(ObjectKind::Force, 3, "damper").unwrap();
    assert_eq!(model.find_label(ObjectKind::Force, "blade"), None);
    model.set_label(ObjectKind::Force, 2, "blade").unwrap();
    model.set_label(ObjectKind::Force, 2, "").unwrap();
    assert_eq!(model.label(ObjectKind::Force, 2), None);

    let long = "x".repeat(LONGEST_LABEL);
    model.set_label(ObjectKind::Node, 0, &long).unwrap();
    let longer = format!("{long}x");
    for (kind, id, label, error) in [
        (ObjectKind::ShellElement, 0, "a", ErrorKind::Identifier),
        (ObjectKind::Joint, 99, "a", ErrorKind::Identifier),
        (ObjectKind::Node, 1, &longer, ErrorKind::Value),
        (ObjectKind::Node, 1, "two\nlines", ErrorKind::Value),
        (ObjectKind::Node, 1, "a \"b\"", ErrorKind::Value),
        (ObjectKind::Node, 1, &long, ErrorKind::Value),
    ] {
        let found = model.set_label(kind, id, label).unwrap_err();
        assert_eq!(found.kind(), error, "{found}");
    }
    let twice = model.set_label(ObjectKind::Node, 1, &long).unwrap_err();
    let expected = "expected one that no other node has, got that of node 0";
    assert!(twice.to_string().contains(expected), "{twice}");
    assert_eq!(model.label(ObjectKind::Node, 1), None);
}

#[test]
fn reports_and_summaries_name_what_has_a_label() {
    let (mut model, _) = all_elements();
    model.set_label(ObjectKind::Joint, 0, "crank pin").unwrap();
    let text = Summary::of(&model).unwrap().to_string();
    println!("{text}");

    // Two hinges on one axis: redundant, and named as they are called.
    let mut model = Model::new();
    let body = ball(&mut model, 1.0, 0.3, &Vector3::zeros());
    for z in [0.0, 1.0] {
        let point = Vector3::z() * z;
        revolute(&mut model, None, Some(body), &point, &Vector3::z());
    }
    for (id, label) in [(0, "front bearing"), (1, "rear bearing")] {
        model.set_label(ObjectKind::Joint, id, label).unwrap();
    }
    let summary = Summary::of(&model).unwrap();
    let expected = "5 redundant constraints among joints 0 \"front bearing\", 1 \"rear bearing\"";
    assert!(summary.to_string().contains(expected), "{summary}");
    model.add_actuator(rotation1(0), &cosine(1.0)).unwrap();
    spring(&mut model, rotation1(0), 2.0, 0.1);
    let solution = solve(&model, 3.0, 9);
    assert!(
        solution.report().contains("joints 0 \"front bearing\""),
        "{}",
        solution.report()
    );

    // A body that nothing holds.
    let mut model = Model::new();
    ball(&mut model, 1.0, 0.3, &Vector3::zeros());
    model.set_label(ObjectKind::Node, 0, "satellite").unwrap();
    push(&mut model, 0, 0, cosine(1.0));
    let options = StaticOptions::default();
    let solution = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap();
    assert!(
        solution.report().contains("node 0 \"satellite\""),
        "{}",
        solution.report()
    );
    let options = ModesOptions {
        count: 1,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    println!("{}", modes.report());
}

#[test]
fn what_is_added_is_numbered_in_its_kind() {
    let (mut model, _) = all_elements();
    let constant = Signal::constant(1.0).unwrap();
    let components = || [const { None }; 6];
    let load = model.add_load(0, LoadFrame::Space, components()).unwrap();
    let place = |fraction| LoadPlace {
        fraction,
        components: components(),
    };
    let before = model.beam_loads().len();
    // Those without any component are numbered, too.
    let places = [place(0.0), place(0.5), place(1.0)];
    let frame = BeamLoadFrame::Space;
    let first = model.add_load_at_places(0, 1, frame, &places).unwrap();
    assert_eq!((load, first), (model.loads().len() - 1, before));
    assert_eq!(model.beam_loads().len(), before + 3);
    assert_eq!(model.beam_loads()[before + 1].factors[2], (0.5, 1.0));
    let inertias = model.inertias().count();
    let body = model
        .add_rigid_body(1.0, &Vector3::zeros(), &Matrix3::identity())
        .unwrap();
    let mass = model.add_mass(body, 2.0, &Vector3::x(), &Matrix3::zeros());
    assert_eq!(mass.unwrap(), inertias + 1);
    assert_eq!(model.inertias().nth(inertias + 1).unwrap().1[(0, 0)], 2.0);
    let joint = revolute(
        &mut model,
        None,
        Some(body),
        &Vector3::zeros(),
        &Vector3::z(),
    );
    let prescribed = model.prescribe(rotation1(joint), &constant).unwrap();
    assert_eq!(prescribed, model.prescribed().len() - 1);
}

#[test]
fn a_loaded_model_tells_what_it_holds() {
    let (model, period) = all_elements();
    let loaded = through_a_file(&model, "contents");
    for id in 0..model.joint_count() {
        let (was, is) = (model.joint(id).unwrap(), loaded.joint(id).unwrap());
        assert_eq!(was.kind, is.kind);
        for (was, is) in [(was.first, is.first), (was.second, is.second)] {
            assert_eq!(was.node, is.node);
            assert_eq!(model.reference_frame(&was), loaded.reference_frame(&is));
        }
        if was.kind == JointKind::Strut {
            continue;
        }
        // Both frames were given at the same place.
        let [a, b] = [was.first, was.second].map(|end| model.reference_frame(&end));
        assert!((a.position - b.position).amax() < 1e-14);
        assert!((a.rotation - b.rotation).amax() < 1e-14);
    }
    assert!(model.joint(model.joint_count()).is_err());
    use ForceNumber::{Damping, RelaxationTime, Stiffness};
    let expected: [(usize, ForceNumber, &[f64]); 8] = [
        (0, Stiffness, &[30.0]),
        (0, Damping, &[2.0]),
        (0, RelaxationTime, &[]),
        (1, Stiffness, &[]),
        (2, Stiffness, &[1.0, 3.0, 5.0]),
        (2, RelaxationTime, &[0.1 * 3.0, 0.1 * 5.0]),
        (3, Stiffness, &[]),
        (5, Stiffness, &[]),
    ];
    for model in [&model, &loaded] {
        for (force, which, numbers) in expected {
            assert_eq!(model.force(force).unwrap().numbers(which), numbers);
        }
        let matrix = model.force(4).unwrap().numbers(Stiffness);
        assert_eq!((matrix.len(), matrix[0]), (36, 3.0));
        // Column by column: row 3 of column 0.
        assert_eq!(matrix[3], 0.1 * 3.0);
        assert_eq!(model.force(3).unwrap().numbers(Damping)[1], 0.2);
        assert_eq!(model.force(0).unwrap().numbers(ForceNumber::Rest), [0.7]);
        assert_eq!(model.force(5).unwrap().user_nodes().len(), 2);
        assert!(model.force(4).unwrap().ends().is_some());
        assert!(model.force(8).is_err());
        let first = model.inertias().next().unwrap();
        assert_eq!((first.0, first.1[(0, 0)]), (0, 1.5));
        assert_eq!(model.prescribed()[0].0, rotation1(0));
        assert_eq!(model.loads().len(), 1);
        for kind in ObjectKind::ALL {
            let counts = [model, &loaded].map(|model| model.object_count(kind));
            assert_eq!(counts[0], counts[1], "{kind}");
        }
        assert_eq!(
            model.object_count(ObjectKind::Inertia),
            model.inertias().count()
        );
        assert_eq!(
            model.object_count(ObjectKind::BeamLoad),
            model.beam_loads().len()
        );
        assert_eq!(
            model.object_count(ObjectKind::ShellLoad),
            model.shell_loads().len()
        );
        let (section, twist) = model.beam_section(0, -1.0).unwrap();
        assert!((section.stiffness[(0, 0)] / 4e3 - 1.0).abs() < 1e-14);
        assert_eq!(twist, 0.0);
        assert_eq!(model.beam_definition(1).unwrap().nodes.len(), 3);
        assert!(model.beam_section(0, 1.1).is_err());
        assert!(model.beam_section(2, 0.0).is_err());
        let times = [0.0, 0.25 * period];
        let values = model.sample_signal(SignalPlace::Prescribed(0), period, &times);
        let values = values.unwrap();
        assert!((values[0] - 0.4).abs() < 1e-15);
        assert!((values[1] - 0.3).abs() < 1e-15);
        let none = model.sample_signal(SignalPlace::Prescribed(1), period, &times);
        assert_eq!(none.unwrap_err().kind(), ErrorKind::NotAvailable);
        assert!(
            model
                .sample_signal(SignalPlace::Gravity(0), 0.0, &times)
                .is_err()
        );
    }
}
