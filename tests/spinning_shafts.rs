//! Shafts whose material spins about their axis in nodes that do not: rotary inertia, and damping
//! that rotates.

mod common;

use common::models::parts::*;
use common::*;
use nalgebra::{Complex, Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::{BushingAngles, Coordinate, JointKind};
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{ForceQuantity, Modes, NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;

type C64 = Complex<f64>;

fn values(model: &Model, count: usize) -> Vec<C64> {
    let options = ModesOptions {
        count,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(model, &options, &mut |_, _| true).unwrap();
    assert_eq!(modes.outcome(), Outcome::Converged, "{}", modes.report());
    modes.modes().iter().map(|mode| mode.eigenvalue).collect()
}

/// A round bar along x whose damping is `seconds` times its stiffness; its rotary inertia is
/// `rotary` of what it should be.
fn bar(seconds: f64, rotary: f64) -> SectionInput {
    let moment = 2e-3 * rotary;
    damped_section(
        &[8e4, 3e4, 3e4, 60.0, 80.0, 80.0],
        &[1.2, 2.0 * moment, moment, moment],
        seconds,
    )
}

const LENGTH: f64 = 1.1;

/// A clamped shaft of 3 elements.
fn cantilever(section: &SectionInput) -> (Model, BeamIds) {
    let mut model = Model::new();
    let end = Vector3::x() * LENGTH;
    let shaft = model
        .add_straight_beam(&Vector3::zeros(), &end, &Vector3::y(), section, 3, 4)
        .unwrap();
    clamp(&mut model, shaft.first_node);
    (model, shaft)
}

#[test]
fn rotating_damping_makes_a_shaft_unstable_above_the_classical_speed() {
    // Without rotary inertia each mode of the shaft is a Jeffcott rotor:
    // λ² + (a + β ω²) λ + ω² (1 − i β s) = 0 of y + i z.
    let (external, seconds) = (0.8, 4e-3);
    let (still, _) = cantilever(&bar(0.0, 0.0));
    let frequencies: Vec<f64> = values(&still, 4).iter().map(|s| s.im).collect();
    let (first, second) = (frequencies[0], frequencies[2]);
    assert!((frequencies[1] / first - 1.0).abs() < 1e-9);
    let limit = first * (1.0 + external / (seconds * first * first));
    for share in [0.0, 0.5, 0.98, 1.0, 1.02, -1.02, 3.0] {
        let spin = limit * share;
        let (mut model, shaft) = cantilever(&bar(seconds, 0.0));
        model
            .set_beam_spin(shaft.first_element, shaft.elements, spin)
            .unwrap();
        model.set_mass_damping(external).unwrap();
        let found = values(&model, 4);
        let mut growth = f64::NEG_INFINITY;
        for frequency in [first, second] {
            let square = C64::from(frequency * frequency);
            let half = 0.5 * (external + seconds * square.re);
            let root = (C64::from(half * half) - square * C64::new(1.0, -seconds * spin)).sqrt();
            for exact in [root - half, -root - half] {
                let near = found.iter().map(|s| {
                    let upwards = C64::new(exact.re, exact.im.abs());
                    (s - upwards).norm() / frequency
                });
                let off = near.fold(f64::INFINITY, f64::min);
                println!("{share}: {exact} {off:e}");
                assert!(off < 1e-9, "{off:e}");
                growth = growth.max(exact.re);
            }
        }
        let largest = found.iter().map(|s| s.re).fold(f64::NEG_INFINITY, f64::max);
        assert!((largest - growth).abs() < 1e-8 * first);
        match share.abs() {
            1.0 => assert!(largest.abs() < 1e-8 * first, "{largest}"),
            below if below < 1.0 => assert!(largest < -1e-3, "{largest}"),
            _ => assert!(largest > 1e-3, "{largest}"),
        }
    }
}

#[test]
fn modes_of_a_shaft_that_spins_are_those_of_one_seen_from_a_frame_that_turns_with_it() {
    let model = |spin: f64, in_frame: bool| {
        let mut model = Model::new();
        let section = bar(2e-3, 1.0);
        let mut thin = section;
        thin.stiffness *= 0.3;
        thin.damping *= 0.3;
        thin.mass *= 0.6;
        let stations =
            [(0.0, section), (0.4, section), (1.0, thin)].map(|(at, section)| SectionStation {
                fraction: at,
                section,
                twist: 0.0,
            });
        let end = Vector3::x() * LENGTH;
        let line = straight_line(&Vector3::zeros(), &end, &Vector3::y()).unwrap();
        let shaft = model.add_beam_along(line, &stations, 2, 4).unwrap();
        clamp(&mut model, shaft.first_node);
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.03, 0.02, 0.02));
        let disk = model.add_mass(shaft.last_node, 2.0, &(end * 1.1), &inertia);
        let place = Motion::new(Matrix3::identity(), end);
        let stiffness = Matrix6::from_diagonal(&Vector6::new(0.0, 900.0, 900.0, 0.0, 7.0, 7.0));
        model
            .add_bushing(
                [None, Some(shaft.last_node)],
                [&place, &place],
                [&stiffness, &Matrix6::zeros()],
                BushingAngles::RotationVector,
            )
            .unwrap();
        model.set_mass_damping(0.3).unwrap();
        if in_frame {
            model
                .set_turning_frame(&Vector3::x(), spin, &Vector3::zeros())
                .unwrap();
        } else {
            model
                .set_beam_spin(shaft.first_element, shaft.elements, spin)
                .unwrap();
            model.set_spin(disk.unwrap(), &Vector3::x(), spin).unwrap();
        }
        model
    };
    for spin in [5.0, -40.0, 90.0] {
        let seen = values(&model(spin, true), 30);
        let found = values(&model(spin, false), 10);
        let nearest = |s: C64| {
            let both = seen.iter().flat_map(|at| [*at, at.conj()]);
            both.map(|at| (at - s).norm()).fold(f64::INFINITY, f64::min)
        };
        // What whirls is seen to be slower, or the other way around; what stretches or twists is
        // not.
        let turned = C64::new(0.0, spin);
        let mut whirling = 0;
        for s in &found {
            let whirls = nearest(s - turned).min(nearest(s.conj() - turned));
            let off = whirls.min(nearest(*s)) / s.norm();
            whirling += usize::from(whirls / s.norm() < 1e-8);
            println!("{spin}: {s} {off:e}");
            assert!(off < 1e-8, "{off:e}");
        }
        assert!(whirling >= 6, "{whirling}");
    }
}

/// One turn.
const PERIOD: f64 = 0.09;

/// A shaft that sags between bearings and is shaken: it turns, or only its material spins.
fn sagging(turns: bool) -> (Model, BeamIds, usize) {
    let mut model = Model::new();
    let end = Vector3::x() * LENGTH;
    let shaft = model
        .add_straight_beam(
            &Vector3::zeros(),
            &end,
            &Vector3::y(),
            &bar(2e-3, 1.0),
            2,
            3,
        )
        .unwrap();
    let kind = if turns {
        JointKind::Free
    } else {
        JointKind::Rigid
    };
    let frame = Motion::identity();
    let drive = model
        .add_joint(kind, None, Some(shaft.first_node), &frame, &frame)
        .unwrap();
    // Of the bearing's frames axis 3 is along the shaft.
    let along = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    let place = Motion::new(along, end);
    let stiffness = Vector6::new(9e3, 7e3, 100.0, 30.0, 20.0, 0.0);
    let damping = Vector6::new(20.0, 30.0, 5.0, 0.2, 0.3, 0.0);
    let bearing = model
        .add_bushing(
            [None, Some(shaft.last_node)],
            [&place, &place],
            [stiffness, damping]
                .each_ref()
                .map(Matrix6::from_diagonal)
                .each_ref(),
            BushingAngles::TiltAndSpin,
        )
        .unwrap();
    if turns {
        let none = Signal::constant(0.0).unwrap();
        for coordinate in [
            Coordinate::Displacement1,
            Coordinate::Displacement2,
            Coordinate::Displacement3,
            Coordinate::Rotation2,
            Coordinate::Rotation3,
        ] {
            let at = JointCoordinate {
                joint: drive,
                coordinate,
            };
            model.prescribe(at, &none).unwrap();
        }
        model
            .prescribe(rotation1(drive), &steady(TAU / PERIOD))
            .unwrap();
    } else {
        model
            .set_beam_spin(shaft.first_element, shaft.elements, TAU / PERIOD)
            .unwrap();
    }
    gravity(&mut model, [0.0, 0.0, -9.81]);
    push(&mut model, shaft.last_node - 2, 1, cosine(15.0));
    (model, shaft, bearing)
}

#[test]
fn a_shaft_that_spins_bends_as_one_that_turns() {
    let times = times(PERIOD, 20);
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let [turns, spins] = [true, false].map(|turns| {
            let (model, shaft, bearing) = sagging(turns);
            let options = PeriodicOptions {
                linear,
                ..options(21)
            };
            let found = Solution::solve(&model, PERIOD, &options, &mut |_, _| true).unwrap();
            let found = converged(found);
            let nodes = shaft.first_node..=shaft.last_node;
            let at = |node| found.node(node, NodeQuantity::Position, &times).unwrap();
            let efforts = found.force(bearing, ForceQuantity::BushingEfforts, &times);
            (nodes.flat_map(at).collect::<Vec<f64>>(), efforts.unwrap())
        });
        let off = [
            largest_difference(&turns.0, &spins.0) / LENGTH,
            largest_difference(&turns.1, &spins.1) / largest(turns.1.iter().copied()),
        ];
        println!("{linear:?}: {off:?}");
        assert!(off.iter().all(|off| *off < 1e-10), "{off:?}");
    }
    // Aside of where it would sag: its damping lifts one side.
    let (model, shaft, _) = sagging(false);
    let mut unshaken = model.clone();
    unshaken
        .set_signal(SignalPlace::Load(0, 1), &Signal::constant(0.0).unwrap())
        .unwrap();
    let still = statics(&unshaken);
    let at = still
        .node(shaft.last_node, NodeQuantity::Position, &[0.0])
        .unwrap();
    assert!(at[2] < -1e-4 && at[1].abs() > 1e-6, "{at:?}");
}

#[test]
fn files_keep_the_spin_and_what_is_not_round_or_straight_does_not_spin() {
    let (mut model, shaft) = cantilever(&bar(1e-3, 1.0));
    let (first, count) = (shaft.first_element, shaft.elements);
    model.set_beam_spin(first, count, 7.0).unwrap();
    let parameter = model.add_parameter("speed", 3.0, 1.0).unwrap();
    let target = Target::BeamSpin(first + 1);
    model.move_by_parameter(parameter, target, 4.0).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model");
    model.save(&path).unwrap();
    let again = Model::load(&path).unwrap();
    let spins = [first, first + 1].map(|it| again.beam_definition(it).unwrap().spin);
    assert_eq!(spins, [7.0, 12.0]);
    assert_eq!(values(&again, 3), values(&model, 3));

    let refuse = |model: &mut Model, (first, count), rate, why: &str| {
        let error = model.set_beam_spin(first, count, rate).unwrap_err();
        assert!(error.to_string().contains(why), "{error}");
    };
    refuse(&mut model, (first, count), f64::NAN, "rate");
    refuse(&mut model, (first, count + 1), 1.0, "element");
    refuse(&mut model, (first, count), 1e308, "spin");
    // A section that is not round comes too late, or too early.
    for part in 0..3 {
        let mut flat = bar(1e-3, 1.0);
        match part {
            0 => flat.stiffness[(4, 4)] *= 1.001,
            1 => flat.mass[(5, 1)] += 1e-3,
            _ => flat.damping[(2, 2)] *= 1.1,
        }
        if part == 1 {
            flat.mass[(1, 5)] += 1e-3;
        }
        let error = model.set_beam_section(first, count, &flat).unwrap_err();
        assert!(
            error.to_string().contains("symmetric about axis 1"),
            "{error}"
        );
        let (mut other, shaft) = cantilever(&flat);
        refuse(
            &mut other,
            (shaft.first_element, 1),
            1.0,
            "beam element 0: expected sections that are symmetric about axis 1",
        );
    }
    let mut curved = Model::new();
    let [start, point, end] = [0.0, 0.5, 1.0].map(|x| Vector3::new(x, 0.2 * x * (1.0 - x), 0.0));
    let arc = circular_arc(&start, &point, &end, &Vector3::z()).unwrap();
    let stations = SectionStation::uniform(&bar(0.0, 1.0));
    curved.add_beam_along(arc, &stations, 1, 3).unwrap();
    refuse(&mut curved, (0, 1), 1.0, "a straight beam");
}
