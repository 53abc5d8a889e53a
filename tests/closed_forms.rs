//! Problems whose answers are known in closed form.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame};
use periodyn::model::{BeamIds, Model, SectionInput, Signal};
use periodyn::output::{BeamQuantity, JointQuantity, NodeQuantity, Quantity, ResolvedIn, Solution};
use periodyn::solve::Outcome;
use std::f64::consts::TAU;
use std::sync::Arc;

const ANGLE: JointQuantity = JointQuantity::Coordinate(Coordinate::Rotation1);
const DRIVE: JointQuantity = JointQuantity::DrivingEffort(Coordinate::Rotation1);
const REACTION: JointQuantity = JointQuantity::Reaction(ResolvedIn::Space);

/// Tolerance relative to the size of what is compared, for problems with band-limited answers of
/// well-conditioned equations: rounding of second derivatives over some ten points.
const ROUNDING: f64 = 1e-11;

fn assert_near(found: &[f64], exact: &[f64], tolerance: f64, what: &str) {
    let size = largest(exact.iter().copied());
    let error = largest_difference(found, exact) / size;
    println!("{what}: relative error {error:.1e}");
    assert!(error < tolerance, "{what}: {error}");
}

fn diagonal(a: f64, b: f64, c: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(a, b, c))
}

/// Flattens a vector function of time.
fn along(times: &[f64], f: impl Fn(f64) -> Vector3<f64>) -> Vec<f64> {
    times.iter().flat_map(|&t| f(t).data.0[0]).collect()
}

/// The force or moment of quantities with six components.
fn half(values: &[f64], first: usize) -> Vec<f64> {
    let halves = values.chunks_exact(6).flat_map(|v| &v[first..first + 3]);
    halves.copied().collect()
}

/// Offset mass on a vertical axis, with torsional spring and damper, driven by a moment: exactly
/// linear, `I θ̈ + c θ̇ + k θ = M`, whatever the amplitude.
struct Oscillator {
    mass: f64,
    arm: f64,
    inertia: f64,
    stiffness: f64,
    damping: f64,
}

const OSCILLATOR: Oscillator = Oscillator {
    mass: 1.3,
    arm: 0.7,
    inertia: 0.2,
    stiffness: 5.0,
    damping: 0.8,
};

impl Oscillator {
    fn solve(&self, moment: &Signal, period: f64, points: usize) -> (usize, Solution) {
        let mut model = Model::new();
        let centre = Vector3::new(self.arm, 0.0, 0.0);
        let spin = diagonal(0.1, 0.15, self.inertia);
        let body = model.add_rigid_body(self.mass, &centre, &spin).unwrap();
        let origin = Vector3::zeros();
        let hinge = revolute(&mut model, None, Some(body), &origin, &Vector3::z());
        spring(&mut model, rotation1(hinge), self.stiffness, self.damping);
        let mut load: [Option<Signal>; 6] = Default::default();
        load[5] = Some(moment.clone());
        model.add_load(body, LoadFrame::Space, load).unwrap();
        (hinge, solve(&model, period, points))
    }

    /// Response to `M cos Ωt`: `θ`, `θ̇`, `θ̈` at `t`.
    fn exact(&self, moment: f64, omega: f64, t: f64) -> [f64; 3] {
        let inertia = self.inertia + self.mass * self.arm * self.arm;
        let (a, b) = (
            self.stiffness - inertia * omega * omega,
            self.damping * omega,
        );
        let amplitude = moment / a.hypot(b);
        let phase = omega * t - b.atan2(a);
        [
            amplitude * phase.cos(),
            -amplitude * omega * phase.sin(),
            -amplitude * omega * omega * phase.cos(),
        ]
    }
}

#[test]
fn a_driven_oscillator_has_the_exact_amplitude_phase_and_reactions() {
    let (moment, omega) = (2.0, 2.2);
    let period = TAU / omega;
    let (hinge, solution) = OSCILLATOR.solve(&cosine(moment), period, 41);
    let times = times(period, 60);
    let exact = |i: usize| -> Vec<f64> {
        let at = |&t: &f64| OSCILLATOR.exact(moment, omega, t)[i];
        times.iter().map(at).collect()
    };
    assert!(largest(exact(0)) > 0.9, "a large motion");
    let joint = |quantity| solution.joint(hinge, quantity, &times).unwrap();
    // 41 points resolve the rotation (not band-limited) to rounding; derivatives amplify that.
    assert_near(&joint(ANGLE), &exact(0), 1e-10, "angle");
    let rate = JointQuantity::Rate(Coordinate::Rotation1);
    assert_near(&joint(rate), &exact(1), 1e-10, "rate");
    let acceleration = JointQuantity::Acceleration(Coordinate::Rotation1);
    assert_near(&joint(acceleration), &exact(2), 1e-10, "acceleration");

    // The axis holds the offset mass on its circle.
    let hold = along(&times, |t| {
        let [angle, rate, acceleration] = OSCILLATOR.exact(moment, omega, t);
        let radial = Vector3::new(angle.cos(), angle.sin(), 0.0);
        let tangential = Vector3::new(-angle.sin(), angle.cos(), 0.0);
        (tangential * acceleration - radial * rate * rate) * (OSCILLATOR.mass * OSCILLATOR.arm)
    });
    let reaction = joint(REACTION);
    assert_near(&half(&reaction, 0), &hold, 1e-10, "reaction");
    assert!(
        largest(half(&reaction, 3)) < 1e-10,
        "the centre is in the plane of the joint"
    );
}

#[test]
fn signals_by_samples_and_by_function_are_those_by_harmonics() {
    let period = 3.0;
    let (cosines, sines) = ([1.0, 0.0, -0.2], [0.3, 0.4, 0.0]);
    let harmonics = Signal::harmonics(0.5, 0.0, &cosines, &sines).unwrap();
    let bound = harmonics.bind(period);
    // Seven samples carry three harmonics.
    let samples: Vec<f64> = (0..7)
        .map(|k| bound.value(period * f64::from(k) / 7.0).unwrap())
        .collect();
    let samples = Signal::samples(0.0, &samples).unwrap();
    let function = Signal::function(Arc::new(move |t| bound.value(t)));
    let times = times(period, 60);
    let angle = |signal: &Signal| {
        let (hinge, solution) = OSCILLATOR.solve(signal, period, 21);
        solution.joint(hinge, ANGLE, &times).unwrap()
    };
    let expected = angle(&harmonics);
    assert_near(&angle(&samples), &expected, ROUNDING, "samples");
    assert_near(&angle(&function), &expected, ROUNDING, "function");
}

#[test]
fn a_shaft_at_constant_speed_carries_weight_and_centripetal_force() {
    let (mass, arm, g) = (2.5, 0.4, 9.81);
    for turns in [1.0, -2.0] {
        let period = 0.8;
        let speed = turns * TAU / period;
        let mut model = Model::new();
        let centre = Vector3::new(arm, 0.0, 0.0);
        let spin = diagonal(0.1, 0.2, 0.3);
        let body = model.add_rigid_body(mass, &centre, &spin).unwrap();
        let shaft = revolute(
            &mut model,
            None,
            Some(body),
            &Vector3::zeros(),
            &Vector3::y(),
        );
        let signal = Signal::harmonics(0.3, speed, &[], &[]).unwrap();
        model.prescribe(rotation1(shaft), &signal).unwrap();
        gravity(&mut model, [0.0, 0.0, -g]);
        let solution = solve(&model, period, 9);

        let times = times(period, 41);
        let joint = |quantity, times: &[f64]| solution.joint(shaft, quantity, times).unwrap();
        let angle = |t: f64| 0.3 + speed * t;
        let exact: Vec<f64> = times.iter().map(|&t| angle(t)).collect();
        assert_near(&joint(ANGLE, &times), &exact, ROUNDING, "angle");
        // Also beyond the period, where it goes on turning.
        let later = joint(ANGLE, &[0.1 + 3.0 * period])[0] - joint(ANGLE, &[0.1])[0];
        assert!((later - 3.0 * turns * TAU).abs() < 1e-11 * later.abs());

        let torque: Vec<f64> = times
            .iter()
            .map(|&t| -mass * g * arm * angle(t).cos())
            .collect();
        assert_near(&joint(DRIVE, &times), &torque, ROUNDING, "torque");
        let hold = along(&times, |t| {
            let radial = Vector3::new(angle(t).cos(), 0.0, -angle(t).sin());
            radial * (-mass * arm * speed * speed) + Vector3::z() * mass * g
        });
        let reaction = joint(REACTION, &times);
        assert_near(&half(&reaction, 0), &hold, ROUNDING, "reaction");
        // In the shaft's own axes the centripetal part stands still, and the weight turns.
        let own = joint(JointQuantity::Reaction(ResolvedIn::Second), &times);
        let sizes = |r: &[f64]| -> Vec<f64> {
            r.chunks_exact(6)
                .map(|r| Vector3::new(r[0], r[1], r[2]).norm())
                .collect()
        };
        assert_near(&sizes(&own), &sizes(&reaction), ROUNDING, "its size");
    }
}

/// A symmetric rotor, its centre at the arm's end, spins about the arm, which precesses about z:
/// the moment on it is `J_axial s Ω` across both axes, and nothing drives either.
#[test]
fn a_precessing_rotor_needs_the_gyroscopic_moment() {
    let (axial, lateral, mass, arm) = (0.7, 0.5, 3.0, 0.6);
    let period = 2.0;
    let precession = TAU / period;
    let spin = 5.0 * precession;
    let times = times(period, 40);
    let radial = |t: f64| Vector3::new((precession * t).cos(), (precession * t).sin(), 0.0);
    let across = |t: f64| Vector3::z().cross(&radial(t));
    let gyroscopic = along(&times, |t| across(t) * (axial * spin * precession));
    let centripetal = along(&times, |t| {
        radial(t) * (-mass * arm * precession * precession)
    });

    // In two revolute joints with a yoke between them.
    let mut model = Model::new();
    let yoke = model.add_rigid_body(1.0, &Vector3::zeros(), &Matrix3::identity());
    let centre = Vector3::new(arm, 0.0, 0.0);
    let inertia = diagonal(axial, lateral, lateral);
    let rotor = model.add_rigid_body(mass, &centre, &inertia).unwrap();
    let yoke = Some(yoke.unwrap());
    let column = revolute(&mut model, None, yoke, &Vector3::zeros(), &Vector3::z());
    let bearing = revolute(&mut model, yoke, Some(rotor), &centre, &Vector3::x());
    model
        .prescribe(rotation1(column), &steady(precession))
        .unwrap();
    model.prescribe(rotation1(bearing), &steady(spin)).unwrap();
    let solution = solve(&model, period, 15);
    let reaction = solution.joint(bearing, REACTION, &times).unwrap();
    assert_near(
        &half(&reaction, 3),
        &gyroscopic,
        ROUNDING,
        "moment of the bearing",
    );
    assert_near(
        &half(&reaction, 0),
        &centripetal,
        ROUNDING,
        "force of the bearing",
    );
    for joint in [column, bearing] {
        let drive = solution.joint(joint, DRIVE, &times).unwrap();
        assert!(largest(drive) < 1e-11 * largest(gyroscopic.iter().copied()));
    }

    // In one universal joint at its centre: its constraint carries the moment.
    let mut model = Model::new();
    let rotor = model
        .add_rigid_body(mass, &Vector3::zeros(), &inertia)
        .unwrap();
    let cross = Model::cross_frame(&Vector3::zeros(), &Vector3::z(), &Vector3::x()).unwrap();
    let joint = model
        .add_joint(JointKind::Universal, None, Some(rotor), &cross, &cross)
        .unwrap();
    let mut second = rotation1(joint);
    second.coordinate = Coordinate::Rotation2;
    model
        .prescribe(rotation1(joint), &steady(precession))
        .unwrap();
    model.prescribe(second, &steady(spin)).unwrap();
    let solution = solve(&model, period, 15);
    let reaction = solution.joint(joint, REACTION, &times).unwrap();
    assert_near(
        &half(&reaction, 3),
        &gyroscopic,
        ROUNDING,
        "moment of the cross",
    );
    assert!(largest(half(&reaction, 0)) < 1e-11);
}

/// A cantilever along x, held at the origin.
fn cantilever(
    length: f64,
    section: &SectionInput,
    elements: usize,
    degree: usize,
) -> (Model, BeamIds) {
    let mut model = Model::new();
    let origin = Vector3::zeros();
    let end = Vector3::x() * length;
    let beam = model
        .add_straight_beam(&origin, &end, &Vector3::y(), section, elements, degree)
        .unwrap();
    clamp(&mut model, beam.first_node);
    (model, beam)
}

#[test]
fn a_slowly_loaded_cantilever_bends_as_timoshenko_says() {
    // Different stiffnesses in every direction, and shear that matters.
    let (ea, ga2, ga3, gj, ei2, ei3) = (9e4, 3e3, 2e3, 40.0, 300.0, 500.0);
    let section = SectionInput::diagonal(&[ea, ga2, ga3, gj, ei2, ei3], &[1.0, 0.01, 0.01, 0.01]);
    let length = 2.0;
    // One element of degree 3 holds the exact cubic.
    let (mut model, beam) = cantilever(length, &section.unwrap(), 1, 3);
    // Small: the twist is 2e-6, the slopes 2e-7, and terms of second order that much smaller.
    let load = [2e-5, 1e-5, 3e-5, 4e-5, 0.0, 0.0];
    add_load(
        &mut model,
        beam.last_node,
        LoadFrame::Space,
        &[0.0; 6],
        &load,
    );
    // A period of a million seconds against a tenth: inertia is nothing.
    let period = 1e6;
    let solution = solve(&model, period, 3);
    let at = |quantity| solution.node(beam.last_node, quantity, &[0.0]).unwrap();
    let bending = length.powi(3) / 3.0;
    let moved = at(NodeQuantity::Position);
    let exact = [
        load[0] * length / ea,
        load[1] * (bending / ei3 + length / ga2),
        load[2] * (bending / ei2 + length / ga3),
    ];
    for i in 0..3 {
        let found = moved[i] - if i == 0 { length } else { 0.0 };
        println!("deflection {i}: {found:e}, exact {:e}", exact[i]);
        // The extension of 4e-10 loses half the square of the slope, 6e-5 of itself.
        assert!((found - exact[i]).abs() < 1e-4 * exact[i]);
    }
    let turn = at(NodeQuantity::RotationMatrix);
    let twist = load[3] * length / gj;
    assert!((turn[5] - twist).abs() < 1e-6 * twist, "twist {}", turn[5]);
    let forces = solution
        .beam(beam.first_element, -1.0, BeamQuantity::Force, &[0.0])
        .unwrap();
    let root = [
        load[0],
        load[1],
        load[2],
        load[3],
        -load[2] * length,
        load[1] * length,
    ];
    // Those of a straight cantilever; strains of 1e-8 have 1e-16 / 1e-8 of rounding, and twist
    // turns them.
    assert_near(&forces, &root, 1e-5, "forces at the root");
}

#[test]
fn a_bar_vibrates_along_its_axis_as_the_wave_equation_says() {
    let (ea, mass, length, force) = (50.0, 2.0, 1.5, 0.4);
    let section = SectionInput::diagonal(&[ea, 20.0, 20.0, 1.0, 1.0, 1.0], &[mass, 0.1, 0.1, 0.1]);
    let section = section.unwrap();
    // Below and above the first resonance, at π / 2.
    for wave in [1.2, 2.0f64] {
        let omega = wave / length * (ea / mass).sqrt();
        let period = TAU / omega;
        let exact = force * wave.tan() / (ea * wave / length);
        let mut last = f64::INFINITY;
        for degree in [2, 4, 6, 8] {
            let (mut model, beam) = cantilever(length, &section, 1, degree);
            let load = [force, 0.0, 0.0, 0.0, 0.0, 0.0];
            add_load(
                &mut model,
                beam.last_node,
                LoadFrame::Space,
                &[0.0; 6],
                &load,
            );
            let solution = solve(&model, period, 3);
            let tip = solution.node(beam.last_node, NodeQuantity::Position, &[0.0]);
            let error = ((tip.unwrap()[0] - length) / exact - 1.0).abs();
            println!("kL = {wave}, degree {degree}: relative error {error:.1e}");
            // Two degrees more gain more than a digit, down to rounding.
            assert!(error < (0.1 * last).max(1e-12), "{error} {last}");
            last = error;
            if degree == 8 {
                let middle = solution.beam(beam.first_element, 0.0, BeamQuantity::Force, &[0.0]);
                let inside = force * (0.5 * wave).cos() / wave.cos();
                // Stress is one order less exact than displacement.
                assert!((middle.unwrap()[0] / inside - 1.0).abs() < 1e-6);
            }
        }
        assert!(last < 1e-9);
    }
}

/// Mean power that the drive and the loads put into the loaded four-bar, and that its damper and
/// its sections dissipate.
fn mean_powers(mechanism: &FourBarModel, elements: usize, points: usize) -> [f64; 4] {
    let solution = mechanism.solve(points);
    let times: Vec<f64> = solution.grid().times().collect();
    // Sums over the grid are exact means of products of two trigonometric polynomials.
    let mean = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>() / points as f64
    };
    let joint = |joint, quantity| solution.joint(joint, quantity, &times).unwrap();
    let rate = |at| joint(at, JointQuantity::Rate(Coordinate::Rotation1));
    let [at_a, .., at_d] = mechanism.joints;
    let drive = mean(&joint(at_d, DRIVE), &rate(at_d));

    let cosine = |t: &f64| (TAU * t / mechanism.period).cos();
    let load: Vec<f64> = times.iter().map(cosine).collect();
    let node = |node, quantity| solution.node(node, quantity, &times).unwrap();
    let velocity = node(mechanism.b, NodeQuantity::Velocity);
    let turning = node(mechanism.middle, NodeQuantity::MaterialVelocity);
    let loads = (0..3).map(|i| {
        FOUR_BAR_FORCE[i] * mean(&load, &column(&velocity, 6, i))
            + FOUR_BAR_MOMENT[i] * mean(&load, &column(&turning, 6, 3 + i))
    });

    let damper = FOUR_BAR_DAMPER * mean(&rate(at_a), &rate(at_a));
    let [a, b, c, d] = four_bar_points();
    let lengths = [(b - a).norm(), (c - b).norm(), (d - c).norm()];
    let mut sections = 0.0;
    for bar in 0..3 {
        let weight = FOUR_BAR_DAMPING_TIME * lengths[bar] / elements as f64;
        for element in 0..elements {
            // The one quadrature point of a two-node element.
            let element = mechanism.bars[bar] + element;
            let strain = Quantity::Beam {
                element,
                station: 0.0,
                quantity: BeamQuantity::Strain,
            };
            let strains = solution.series(strain);
            for (strain, stiffness) in strains.unwrap().iter().zip(FOUR_BAR_STIFFNESS[bar]) {
                let rate = strain.differentiated();
                let rates: Vec<f64> = times.iter().map(|&t| rate.value(t)).collect();
                sections += weight * stiffness * mean(&rates, &rates);
            }
        }
    }
    [drive, loads.sum(), damper, sections]
}

fn imbalance([drive, loads, damper, sections]: [f64; 4]) -> f64 {
    println!(
        "drive {drive:.6e} W, loads {loads:.6e} W, damper {damper:.6e} W, sections {sections:.3e} W"
    );
    ((drive + loads) / (damper + sections) - 1.0).abs()
}

/// Over a period the drive and the loads put in what damper and sections dissipate, and gravity
/// nothing: an identity that no term of the equations can be missing from.
#[test]
fn power_put_in_is_dissipated() {
    let mechanism = FourBar {
        elements: 4,
        loaded: true,
        ..FourBar::default()
    }
    .build();
    let [coarse, fine] = [21, 41].map(|n| imbalance(mean_powers(&mechanism, 4, n)));
    println!("imbalance {coarse:.1e} at N = 21, {fine:.1e} at N = 41");
    // Converged: N = 41 leaves 1e-8 of curves, of which the mean of the power sees the square.
    assert!(fine < 1e-10 && fine < 1e-3 * coarse, "{coarse} {fine}");
}

/// A cantilever that sags by a third of its length hangs on its root by its whole weight, on any
/// mesh.
#[test]
fn the_weight_of_a_bent_beam_is_exact() {
    let section =
        SectionInput::diagonal(&[1e5, 5e4, 5e4, 80.0, 50.0, 50.0], &[3.0, 0.1, 0.1, 0.1]).unwrap();
    for (elements, degree) in [(4, 1), (1, 2), (2, 3)] {
        let (mut model, beam) = cantilever(2.0, &section, elements, degree);
        gravity(&mut model, [0.0, 0.0, -9.81]);
        let solution = solve(&model, 1.0, 1);
        let tip = solution
            .node(beam.last_node, NodeQuantity::Position, &[0.0])
            .unwrap();
        assert!(tip[2] < -0.6, "it hardly bends: {}", tip[2]);
        let reaction = JointQuantity::Reaction(ResolvedIn::Space);
        let force = solution.joint(0, reaction, &[0.0]).unwrap();
        let weight = 3.0 * 2.0 * 9.81;
        // Rounding of strains times the axial stiffness.
        assert!(
            (force[2] - weight).abs() < 1e-9 * weight,
            "{} {weight}",
            force[2]
        );
        assert!(force[0].abs() < 1e-9 * weight);
    }
}

#[test]
fn statics_of_a_single_point_has_no_error_estimate_to_speak_of() {
    let section = SectionInput::diagonal(&[1e4, 5e3, 5e3, 80.0, 50.0, 50.0], &[1.0, 0.0, 0.0, 0.0]);
    let (mut model, beam) = cantilever(1.0, &section.unwrap(), 2, 2);
    add_load(
        &mut model,
        beam.last_node,
        LoadFrame::Space,
        &[0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
        &[0.0; 6],
    );
    let solution = solve(&model, 1.0, 1);
    assert_eq!(solution.outcome(), Outcome::Converged);
    // What the last increment leaves, which is rounding.
    assert!(solution.diagnostics().error_estimate < 1e-15);
}
