//! Numbers at the end of their range: refused, or answered by numbers. What a model takes, its own
//! file holds.

mod common;

use common::*;
use nalgebra::{Matrix3, Matrix6, Vector3};
use periodyn::elements::{Coordinate, IsotropicShell, JointKind};
use periodyn::error::{Error, ErrorKind};
use periodyn::model::{
    Model, SectionInput, SectionStation, ShellMesh, ShellPlacement, Target, rectangle,
    straight_line,
};
use periodyn::motion::Motion;
use periodyn::output::{JointQuantity, Modes, NodeQuantity};
use periodyn::solve::ModesOptions;
use periodyn::system::Summary;
use std::fmt::Debug;

fn modes_of(model: &Model) -> Result<Modes, Error> {
    let options = ModesOptions {
        count: 1,
        ..ModesOptions::default()
    };
    Modes::solve(model, &options, &mut |_, _| true)
}

fn assert_refused(what: Result<impl Debug, Error>) {
    assert_eq!(what.unwrap_err().kind(), ErrorKind::NotFinite);
}

/// A model that was taken is one that its file gives back.
fn assert_saved(model: &Model) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model.pdm");
    model.save(&path).unwrap();
    Model::load(&path).unwrap();
}

#[test]
fn what_is_said_of_a_motion_beyond_all_bounds_is_a_number_or_an_overflow() {
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    spring(&mut model, at, 1.0, 0.0);
    let modes = modes_of(&model).unwrap();
    let displacement = JointQuantity::Coordinate(Coordinate::Displacement1);
    let (mut told, mut refused) = (0, 0);
    for exponent in [0, 100, 150, 160, 200, 300, 307, 308] {
        let amplitude = 10f64.powi(exponent);
        let motion = match modes.motion(0, amplitude) {
            Ok(motion) => motion,
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::Overflow, "{error}");
                refused += 1;
                continue;
            }
        };
        assert!(motion.diagnostics().harmonics.iter().all(|a| a.is_finite()));
        for quantity in [
            displacement,
            JointQuantity::Rate(Coordinate::Displacement1),
            JointQuantity::Acceleration(Coordinate::Displacement1),
        ] {
            let quantity = periodyn::output::Quantity::Joint(at.joint, quantity);
            for series in motion.series(quantity).into_iter().flatten() {
                let all = series.cosines.iter().chain(&series.sines);
                assert!(
                    all.chain([&series.mean]).all(|x| x.is_finite()),
                    "{series:?}"
                );
                told += 1;
            }
            for found in motion.extremes(quantity).into_iter().flatten() {
                assert!(
                    found.smallest.is_finite() && found.largest.is_finite(),
                    "{found:?}"
                );
            }
        }
        let _ = motion.node(0, NodeQuantity::Position, &[0.1]);
    }
    assert!(told > 3 && refused > 0, "{told} {refused}");
}

#[test]
fn modes_of_bodies_beyond_all_bounds_have_numbers_or_overflow() {
    for mass in [1e150, 1e300, 1e308] {
        let (mut model, at) = mass_on_a_slide(mass, &Vector3::x());
        spring(&mut model, at, mass, 0.0);
        let (mut turning, joint) = hinged_body(
            1.0,
            &Vector3::zeros(),
            &Matrix3::from_diagonal_element(mass),
            &Vector3::z(),
        );
        let free = turning.clone();
        spring(&mut turning, rotation1(joint), mass, 0.0);
        let mut weak = free.clone();
        spring(&mut weak, rotation1(joint), 1.0, 0.0);
        for model in [model, turning, free, weak] {
            for mode in modes_of(&model).iter().flat_map(Modes::modes) {
                let numbers = [mode.modal_mass, mode.residual, mode.frequency()];
                assert!(
                    numbers.iter().all(|x| x.is_finite()),
                    "{mass:e}: {numbers:?}"
                );
            }
        }
    }
}

/// A coupled section whose couplings have this sign, as stiff as numbers go.
fn stiffest(sign: f64) -> SectionInput {
    let mut section = SectionInput::diagonal(&[1e308; 6], &[1e308; 4]).unwrap();
    for m in [&mut section.stiffness, &mut section.mass] {
        (m[(0, 4)], m[(4, 0)]) = (sign * 9.5e307, sign * 9.5e307);
    }
    section.damping = Matrix6::zeros();
    section
}

#[test]
fn sections_between_stations_are_numbers() {
    let (start, end) = (Vector3::zeros(), Vector3::x() * 1e-3);
    let station = |fraction, sign| SectionStation {
        fraction,
        section: stiffest(sign),
        twist: 0.0,
    };
    let line = || straight_line(&start, &end, &Vector3::y()).unwrap();
    let mut model = Model::new();
    let same = [station(0.0, 1.0), station(1.0, 1.0)];
    model.add_beam_along(line(), &same, 2, 1).unwrap();
    assert_saved(&model);
    let before = (model.node_count(), model.beam_element_count());
    let opposite = [station(0.0, 1.0), station(1.0, -1.0)];
    assert_refused(model.add_beam_along(line(), &opposite, 2, 1));
    assert_eq!((model.node_count(), model.beam_element_count()), before);
    assert_saved(&model);
}

#[test]
fn inertia_of_beams_is_a_number() {
    let section = SectionInput::diagonal(&[1.0; 6], &[1e200, 1.0, 1.0, 1.0]).unwrap();
    let mut model = Model::new();
    let end = Vector3::x() * 1e150;
    let added = model.add_straight_beam(&Vector3::zeros(), &end, &Vector3::y(), &section, 1, 1);
    assert_refused(added);
    assert_eq!((model.node_count(), model.beam_element_count()), (0, 0));
}

#[test]
fn parameters_move_all_or_nothing_and_to_numbers() {
    let mut model = Model::new();
    ball(&mut model, 1.0, 1.0, &Vector3::zeros());
    ball(&mut model, 1e300, 1.0, &Vector3::x());
    let section = SectionInput::diagonal(&[1e300; 6], &[1.0; 4]).unwrap();
    let (start, end) = (Vector3::zeros(), Vector3::x());
    model
        .add_straight_beam(&start, &end, &Vector3::y(), &section, 1, 1)
        .unwrap();
    for targets in [
        [Target::Inertia(0), Target::Inertia(1)],
        [Target::BeamMass(0), Target::BeamStiffness(0)],
    ] {
        let mut model = model.clone();
        let parameter = model.add_parameter("factor", 1.0, 1.0).unwrap();
        for target in targets {
            model.move_by_parameter(parameter, target, 1.0).unwrap();
        }
        let mass = model.mass_and_moment().unwrap();
        assert_refused(model.set_parameter(parameter, 1e10));
        assert_eq!(model.mass_and_moment().unwrap(), mass);
        assert_eq!(model.parameters()[parameter].value, 1.0);
        assert_saved(&model);
        model.set_parameter(parameter, 2.0).unwrap();
        assert_saved(&model);
    }
}

#[test]
fn a_parameter_that_makes_the_inertia_of_an_element_too_large_is_refused() {
    // The masses per length and area are still numbers, not those of the elements.
    let section = SectionInput::diagonal(&[1.0; 6], &[1.0; 4]).unwrap();
    let (start, end) = (Vector3::zeros(), Vector3::x() * 1e10);
    let mut model = Model::new();
    let added = model.add_straight_beam(&start, &end, &Vector3::y(), &section, 1, 1);
    added.unwrap();
    let sheet = IsotropicShell::new(1.0, 1.0, 0.3, 1.0).section().unwrap();
    let sides = [Vector3::x() * 1e10, Vector3::y() * 1e10];
    let surface = rectangle(&(Vector3::z() * 1e9), &sides[0], &sides[1]).unwrap();
    let mesh = ShellMesh {
        elements: [1, 1],
        degrees: [1, 1],
        join: false,
    };
    let placement = ShellPlacement::default();
    let added = model.add_shell_patch(surface, &mesh, &sheet, &placement);
    added.unwrap();
    for target in [Target::BeamMass(0), Target::ShellMass(0)] {
        let mut model = model.clone();
        let parameter = model.add_parameter("density", 1.0, 1.0).unwrap();
        model.move_by_parameter(parameter, target, 1.0).unwrap();
        let mass = model.mass_and_moment().unwrap();
        assert_refused(model.set_parameter(parameter, 1e300));
        assert_eq!(model.mass_and_moment().unwrap(), mass);
        assert_saved(&model);
    }
}

#[test]
fn a_mass_that_a_parameter_makes_zero_is_none() {
    let section = SectionInput::diagonal(&[1.0; 6], &[3.0; 4]).unwrap();
    let (start, end) = (Vector3::zeros(), Vector3::x());
    let mut model = Model::new();
    let beam = |model: &mut Model| {
        let added = model.add_straight_beam(&start, &end, &Vector3::y(), &section, 1, 1);
        added.unwrap();
    };
    beam(&mut model);
    beam(&mut model);
    let parameter = model.add_parameter("density", 1.0, 1.0).unwrap();
    let moved = model.move_by_parameter(parameter, Target::BeamMass(0), 1.0);
    moved.unwrap();
    model.set_parameter(parameter, 0.0).unwrap();
    assert_eq!(model.mass_and_moment().unwrap().0, 3.0);
    assert_eq!(Summary::of(&model).unwrap().mass, 3.0);
    assert_saved(&model);
}

#[test]
fn a_centre_of_mass_beyond_numbers_is_an_overflow() {
    let mut model = Model::new();
    let node = ball(&mut model, 1e-320, 0.0, &Vector3::zeros());
    assert!(model.mass_and_moment().is_ok());
    // A first moment that is rounding beside the inertia, but has no mass.
    let mut matrix = Matrix6::identity();
    for i in 0..3 {
        matrix[(i, i)] = 0.0;
    }
    for (i, j, value) in [(1, 5, 1e-10), (2, 4, -1e-10)] {
        (matrix[(i, j)], matrix[(j, i)]) = (value, value);
    }
    model.add_inertia(node, None, &matrix).unwrap();
    let error = model.mass_and_moment().unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Overflow);
}

#[test]
fn frames_too_far_from_their_bodies_are_refused() {
    let mut model = Model::new();
    let node = ball(&mut model, 1.0, 1.0, &(Vector3::x() * 1.5e308));
    let far = Motion::new(Matrix3::identity(), Vector3::x() * -1.5e308);
    let joint = model.add_joint(JointKind::Spherical, None, Some(node), &far, &far);
    assert_refused(joint);
    let damper = model.add_viscous_damper(None, Some(node), Some(&far), &Matrix6::identity());
    assert_refused(damper);
    assert_saved(&model);
}
