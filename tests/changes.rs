//! Models that are changed are those that were built so; functions come back to those from files.

mod common;

use common::*;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::*;
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{NodeQuantity, Solution};
use std::sync::Arc;

const PERIOD: f64 = 2.0;

/// What a machine is made of, all in proportion to one number.
fn section(size: f64, twist: bool) -> SectionInput {
    let stiffness = [9e3, 4e3, 4e3, 30.0, 50.0, 60.0].map(|x| size * x);
    let mut section = SectionInput::diagonal(&stiffness, &[2.0, 0.01, 0.01, 0.01]).unwrap();
    if twist {
        section.damping *= size;
    }
    section
}

/// A strip at the end of which a mass moves, with one of each force, load and drive.
fn machine(size: f64) -> Model {
    let mut model = Model::new();
    let (start, end) = (Vector3::zeros(), Vector3::x());
    let strip = model
        .add_straight_beam(&start, &end, &Vector3::y(), &section(size, false), 2, 1)
        .unwrap();
    let root = [None, Some(strip.first_node)];
    let slide = join(
        &mut model,
        JointKind::Prismatic,
        root,
        &start,
        &Vector3::z(),
    );
    let at = JointCoordinate {
        joint: slide,
        coordinate: Coordinate::Displacement1,
    };
    model.prescribe(at, &cosine(0.02 * size)).unwrap();
    let body = ball(&mut model, 0.5, 0.01, &end);
    let tip = [Some(strip.last_node), Some(body)];
    let hinge = rotation1(join(
        &mut model,
        JointKind::Revolute,
        tip,
        &end,
        &Vector3::y(),
    ));
    model
        .add_polynomial_spring_damper(hinge, &[3.0 * size, 0.0, size], &[0.1 * size], 0.0)
        .unwrap();
    let branches = [MaxwellBranch {
        stiffness: 2.0 * size,
        relaxation_time: 0.3 * size,
    }];
    model.add_viscoelastic(hinge, size, 0.0, &branches).unwrap();
    model.add_actuator(hinge, &cosine(0.4 * size)).unwrap();
    let damping = Matrix6::from_diagonal(&Vector6::repeat(0.2 * size));
    model
        .add_viscous_damper(None, Some(body), None, &damping)
        .unwrap();
    let stiffness = Matrix6::from_diagonal(&Vector6::repeat(7.0 * size));
    let there = Motion::new(nalgebra::Matrix3::identity(), end);
    let (ends, frames) = ([None, Some(body)], [&there, &there]);
    let angles = BushingAngles::RotationVector;
    model
        .add_bushing(ends, frames, [&stiffness, &damping], angles)
        .unwrap();
    let mut components = [const { None }; 6];
    components[2] = Some(cosine(size));
    model.add_load(body, LoadFrame::Space, components).unwrap();
    gravity(&mut model, [0.0, 0.0, -9.0 * size]);
    model
}

/// Makes of a machine of any size one of this.
fn change(model: &mut Model, size: f64) {
    use ForceNumber::{Damping, RelaxationTime, Stiffness};
    let matrix = |number: f64| Matrix6::from_diagonal(&Vector6::repeat(number));
    let (stiffness, damping) = (matrix(7.0 * size), matrix(0.2 * size));
    for (force, which, values) in [
        (0, Stiffness, &[3.0 * size, 0.0, size][..]),
        (0, Damping, &[0.1 * size]),
        (1, Stiffness, &[size, 2.0 * size]),
        (1, RelaxationTime, &[0.3 * size]),
        (3, Damping, damping.as_slice()),
        (4, Stiffness, stiffness.as_slice()),
        (4, Damping, damping.as_slice()),
    ] {
        model.set_force_numbers(force, which, values).unwrap();
    }
    let weight = Signal::constant(-9.0 * size).unwrap();
    for (place, signal) in [
        (SignalPlace::Prescribed(0), cosine(0.02 * size)),
        (SignalPlace::Actuator(2), cosine(0.4 * size)),
        (SignalPlace::Load(0, 2), cosine(size)),
        (SignalPlace::Gravity(2), weight),
    ] {
        model.set_signal(place, &signal).unwrap();
    }
    model.set_beam_section(0, 2, &section(size, false)).unwrap();
}

/// All that a file has of a model.
fn file(model: &Model, name: &str) -> Vec<u8> {
    let name = format!("periodyn-changes-{name}-{}", std::process::id());
    let path = std::env::temp_dir().join(name);
    model.save(&path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    bytes
}

fn motions(solution: &Solution) -> Vec<f64> {
    let node = solution.model().node_count() - 1;
    let times = times(PERIOD, 7);
    solution.node(node, NodeQuantity::Position, &times).unwrap()
}

#[test]
fn what_is_changed_is_what_was_built_so() {
    let mut changed = machine(1.0);
    let begun = file(&changed, "begun");
    change(&mut changed, 1.3);
    let built = machine(1.3);
    assert_ne!(file(&changed, "changed"), begun);
    assert_eq!(file(&changed, "changed"), file(&built, "built"));
    let found = [&changed, &built].map(|model| motions(&solve(model, PERIOD, 15)));
    assert_eq!(found[0], found[1]);
    change(&mut changed, 1.0);
    assert_eq!(file(&changed, "back"), begun);
}

#[test]
fn parameters_go_on_to_move_what_they_move() {
    let mut model = machine(1.0);
    let load = model.add_parameter("load", 5.0, 1.0).unwrap();
    let place = SignalPlace::Load(0, 2);
    let amplitude = Target::Signal(place, SignalPart::Amplitude);
    model.move_by_parameter(load, amplitude, 2.0).unwrap();
    let at = |model: &Model| model.sample_signal(place, PERIOD, &[0.0]).unwrap()[0];
    assert!((at(&model) - 10.0).abs() < 1e-14);
    model.set_signal(place, &cosine(0.5)).unwrap();
    // The signal, times the amplitude that the parameter gives.
    assert!((at(&model) - 5.0).abs() < 1e-14);
    model.set_parameter(load, 1.0).unwrap();
    assert!((at(&model) - 1.0).abs() < 1e-14);

    model
        .move_by_parameter(load, Target::Stiffness(0, 1), 3.0)
        .unwrap();
    let before = file(&model, "before");
    let values = [1.0, 0.0, 1.0];
    let refused = model.set_force_numbers(0, ForceNumber::Stiffness, &values);
    assert!(refused.unwrap_err().to_string().contains("\"load\""));
    assert_eq!(file(&model, "after"), before);
    let damping = model.set_force_numbers(0, ForceNumber::Damping, &[0.2]);
    damping.unwrap();
}

#[test]
fn twist_and_what_elements_have_of_mass_stay() {
    let twisted = |size: f64| {
        let mut model = Model::new();
        let station = |fraction, twist| SectionStation {
            fraction,
            section: section(size, true),
            twist,
        };
        let stations = [station(0.0, 0.0), station(0.4, 0.3), station(1.0, 0.5)];
        let line = straight_line(&Vector3::zeros(), &Vector3::x(), &Vector3::y()).unwrap();
        model.add_beam_along(line, &stations, 3, 2).unwrap();
        model
    };
    let mut model = twisted(1.0);
    model.set_beam_section(0, 3, &section(2.0, true)).unwrap();
    assert_eq!(
        file(&model, "twisted"),
        file(&twisted(2.0), "built-twisted")
    );

    let before = file(&model, "mass");
    let massless = SectionInput::diagonal(&[1.0; 6], &[0.0; 4]).unwrap();
    let error = model.set_beam_section(1, 2, &massless).unwrap_err();
    assert!(error.to_string().contains("with mass"), "{error}");
    let error = model
        .set_beam_section(1, 3, &section(1.0, true))
        .unwrap_err();
    assert!(error.to_string().contains("1 to 2"), "{error}");
    assert_eq!(file(&model, "mass"), before);
}

#[test]
fn numbers_that_cannot_be_are_refused() {
    use ForceNumber::{Damping, RelaxationTime, Stiffness};
    let mut model = machine(1.0);
    let before = file(&model, "whole");
    let mut indefinite = Matrix6::identity();
    indefinite[(0, 0)] = -1.0;
    for (force, which, values, name) in [
        (0, Stiffness, &[1.0][..], "count"),
        (0, RelaxationTime, &[], "count"),
        (0, Damping, &[f64::NAN], "damping"),
        (1, RelaxationTime, &[0.0], "relaxation_times[0]"),
        (2, Stiffness, &[1.0], "count"),
        (3, Damping, indefinite.as_slice(), "values"),
        (9, Damping, &[1.0], "force"),
    ] {
        let error = model.set_force_numbers(force, which, values).unwrap_err();
        assert!(error.to_string().contains(name), "{error}");
    }
    for place in [SignalPlace::Load(0, 1), SignalPlace::Actuator(0)] {
        let error = model.set_signal(place, &cosine(1.0)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NotAvailable);
    }
    assert_eq!(file(&model, "whole"), before);
}

fn drag(size: f64) -> NodeForceLaw {
    NodeForceLaw {
        function: Arc::new(move |input, output| {
            output.forces[0] = input.velocities[0] * -size;
            Ok(())
        }),
        gives_tangents: false,
        frame: LoadFrame::Space,
    }
}

fn push(size: f64) -> Signal {
    Signal::function(Arc::new(move |time| {
        Ok(size * (std::f64::consts::TAU * time / PERIOD).cos())
    }))
}

#[test]
fn functions_come_back_to_a_model_from_a_file() {
    let (mut model, hinge) = pendulum_on_a_hinge();
    let law = model.add_coordinate_law(hinge, sine_spring(4.0)).unwrap();
    let force = model.add_node_forces(&[0], drag(0.5)).unwrap();
    let actuator = model.add_actuator(hinge, &push(0.3)).unwrap();
    for (id, label) in [(law, "spring"), (force, "drag"), (actuator, "push")] {
        model.set_label(ObjectKind::Force, id, label).unwrap();
    }
    let wanted = motions(&solve(&model, PERIOD, 15));

    let name = format!("periodyn-changes-functions-{}", std::process::id());
    let path = std::env::temp_dir().join(name);
    model.save(&path).unwrap();
    let mut loaded = Model::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let error = try_solve(&loaded, PERIOD, 15).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Callback);
    assert!(error.to_string().contains("bind it again"), "{error}");
    let find = |label: &str| loaded.find_label(ObjectKind::Force, label).unwrap();
    let [law, force, actuator] = ["spring", "drag", "push"].map(find);
    loaded.bind_coordinate_law(law, sine_spring(4.0)).unwrap();
    loaded.bind_node_forces(force, drag(0.5)).unwrap();
    loaded
        .set_signal(SignalPlace::Actuator(actuator), &push(0.3))
        .unwrap();
    assert_eq!(motions(&solve(&loaded, PERIOD, 15)), wanted);

    // Another function gives another motion; what is no such force is refused.
    loaded.bind_coordinate_law(law, sine_spring(6.0)).unwrap();
    assert!(largest_difference(&motions(&solve(&loaded, PERIOD, 15)), &wanted) > 1e-3);
    let refused = loaded.bind_node_forces(law, drag(0.5)).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::NotAvailable);
}

fn pendulum_on_a_hinge() -> (Model, JointCoordinate) {
    let mut model = Model::new();
    let body = ball(&mut model, 1.0, 0.1, &Vector3::x());
    let ends = [None, Some(body)];
    let joint = join(
        &mut model,
        JointKind::Revolute,
        ends,
        &Vector3::zeros(),
        &Vector3::y(),
    );
    (model, rotation1(joint))
}

/// A plate with a body at a corner.
fn plate(thickness: f64, mass: f64) -> Model {
    let mut model = Model::new();
    let mesh = ShellMesh {
        elements: [2, 1],
        degrees: [2, 2],
        join: true,
    };
    let surface = |[u, v]: [f64; 2]| Ok(Vector3::new(u, 0.5 * v, 0.0));
    let section = IsotropicShell::new(thickness, 1e6, 0.3, 1e3);
    let section = section.section().unwrap();
    let placement = ShellPlacement::default();
    let patch = model.add_shell_patch(surface, &mesh, &section, &placement);
    let corner = *patch.unwrap().nodes.last().unwrap();
    let at = model.node(corner).unwrap().position;
    let inertia = Matrix3::identity() * (0.01 * mass);
    model.add_mass(corner, mass, &at, &inertia).unwrap();
    model
}

#[test]
fn shells_and_inertias_are_changed() {
    let mut model = plate(0.01, 1.0);
    let section = IsotropicShell::new(0.02, 1e6, 0.3, 1e3).section().unwrap();
    model.set_shell_section(0, 2, &section).unwrap();
    let inertia = Vector6::new(3.0, 3.0, 3.0, 0.03, 0.03, 0.03);
    let inertia = Matrix6::from_diagonal(&inertia);
    model.set_inertia(0, &inertia).unwrap();
    assert_eq!(
        file(&model, "plate"),
        file(&plate(0.02, 3.0), "built-plate")
    );

    let before = file(&model, "plate");
    let mut massless = section;
    massless.mass = Matrix6::zeros();
    for (refused, why) in [
        (model.set_shell_section(0, 1, &massless), "with mass"),
        (model.set_shell_section(1, 2, &section), "1 to 1"),
        (model.set_inertia(1, &inertia), "inertia"),
        (model.set_inertia(0, &-inertia), "matrix"),
    ] {
        let error = refused.unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
    assert_eq!(file(&model, "plate"), before);
}
