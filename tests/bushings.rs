//! Bushings and bearings with full matrices of stiffness and damping, against closed forms.

mod common;

use common::*;
use nalgebra::{Complex, Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::{BushingAngles, Coordinate, JointKind, LoadFrame};
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{ForceQuantity, JointQuantity, Modes, NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;

type C64 = Complex<f64>;

const MASS: f64 = 2.0;
const STIFFNESS: f64 = 50.0;
const DAMPING: f64 = 3.0;
const TILT: f64 = 40.0;

/// A rigid rotor on a journal bearing about z, driven at `spin`, with its mass `offset` off the
/// axis; the film turns at half its speed, so that it has the cross-coupled stiffness
/// `½ spin DAMPING`. The joint that tells the motion of the shaft, and the bearing.
struct Rotor {
    model: Model,
    shaft: usize,
    bearing: usize,
}

impl Rotor {
    fn new(spin: f64, offset: f64) -> Self {
        let mut model = Model::new();
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.3, 0.5));
        let body = model
            .add_rigid_body(MASS, &(Vector3::x() * offset), &inertia)
            .unwrap();
        let origin = Motion::identity();
        let cross = 0.5 * spin * DAMPING;
        let mut stiffness = Matrix6::zeros();
        stiffness[(0, 0)] = STIFFNESS;
        stiffness[(1, 1)] = STIFFNESS;
        stiffness[(0, 1)] = cross;
        stiffness[(1, 0)] = -cross;
        let mut damping =
            Matrix6::from_diagonal(&Vector6::new(DAMPING, DAMPING, 0.0, 9.0, 9.0, 0.0));
        damping[(5, 5)] = 0.7;
        stiffness[(3, 3)] = TILT;
        stiffness[(4, 4)] = TILT;
        let ends = [None, Some(body)];
        let bearing = model
            .add_bushing(
                ends,
                [&origin, &origin],
                [&stiffness, &damping],
                BushingAngles::TiltAndSpin,
            )
            .unwrap();
        let shaft = model
            .add_joint(JointKind::Free, None, Some(body), &origin, &origin)
            .unwrap();
        let at = |coordinate| JointCoordinate {
            joint: shaft,
            coordinate,
        };
        let none = Signal::constant(0.0).unwrap();
        model
            .prescribe(at(Coordinate::Displacement3), &none)
            .unwrap();
        let turning = steady(spin);
        model
            .prescribe(at(Coordinate::Rotation3), &turning)
            .unwrap();
        Rotor {
            model,
            shaft,
            bearing,
        }
    }

    /// Displacement of the shaft, as a complex number, at these times.
    fn orbit(&self, solution: &Solution, times: &[f64]) -> Vec<C64> {
        let of = |c| {
            let quantity = JointQuantity::Coordinate(c);
            solution.joint(self.shaft, quantity, times).unwrap()
        };
        let (x, y) = (of(Coordinate::Displacement1), of(Coordinate::Displacement2));
        x.iter().zip(&y).map(|(x, y)| C64::new(*x, *y)).collect()
    }
}

#[test]
fn a_rotor_out_of_balance_whirls_as_it_should() {
    let (spin, offset) = (6.3, 0.04);
    let rotor = Rotor::new(spin, offset);
    let period = TAU / spin;
    let solution = solve(&rotor.model, period, 9);
    // m (r + e)'' + c r' + (k − i q) r = 0 for r = R exp(i Ω t).
    let cross = 0.5 * spin * DAMPING;
    let inertia = MASS * spin * spin;
    let stiffness = C64::new(STIFFNESS - inertia, DAMPING * spin - cross);
    let exact = C64::from(inertia * offset) / stiffness;
    let times = times(period, 12);
    for (found, t) in rotor.orbit(&solution, &times).iter().zip(&times) {
        let exact = exact * C64::new(0.0, spin * t).exp();
        assert!(
            (found - exact).norm() < 1e-12 * exact.norm(),
            "{found} {exact}"
        );
    }
    // What the bearing exerts against the displacement and its rate.
    let efforts = solution
        .force(rotor.bearing, ForceQuantity::BushingEfforts, &[0.0])
        .unwrap();
    let force = exact * C64::new(STIFFNESS, DAMPING * spin - cross);
    assert!((efforts[0] - force.re).abs() < 1e-11 * force.norm());
    assert!((efforts[1] - force.im).abs() < 1e-11 * force.norm());
    // Friction of the film: the drive's moment, less that of the bearing's force about the mass.
    assert!((efforts[5] - 0.7 * spin).abs() < 1e-12);
    let on_rotor = ForceQuantity::OnNode(0, LoadFrame::Space);
    let on_rotor = solution.force(rotor.bearing, on_rotor, &[0.0]).unwrap();
    assert!((on_rotor[0] + force.re).abs() < 1e-11 * force.norm());
    assert!((on_rotor[1] + force.im).abs() < 1e-11 * force.norm());
    let drive = JointQuantity::DrivingEffort(Coordinate::Rotation3);
    let drive = solution.joint(rotor.shaft, drive, &[0.0]).unwrap()[0];
    // About the shaft the mass takes a moment e × m a, and the film 0.7 Ω.
    let acceleration = -(exact + offset) * spin * spin;
    let moment = 0.7 * spin + MASS * offset * acceleration.im;
    assert!((drive - moment).abs() < 1e-10, "{drive} {moment}");
}

#[test]
fn a_rotor_whirls_by_itself_from_twice_its_critical_speed_on() {
    let critical = (STIFFNESS / MASS).sqrt();
    for (part, verdict) in [
        (1.2, Verdict::Stable),
        (1.98, Verdict::Stable),
        (2.02, Verdict::Unstable),
        (3.0, Verdict::Unstable),
    ] {
        let spin = part * critical;
        let rotor = Rotor::new(spin, 0.0);
        let period = TAU / spin;
        let solution = solve(&rotor.model, period, 5);
        let options = StabilityOptions {
            tolerance: 1e-10,
            ..StabilityOptions::default()
        };
        let stability = solution.solve_stability(&options).unwrap();
        assert_eq!(stability.verdict, verdict, "{}", stability.report());
        // m s² + c s + k ∓ i q = 0 of both whirls.
        let cross = 0.5 * spin * DAMPING;
        let root = |sign: f64| {
            let disc = C64::new(
                DAMPING * DAMPING - 4.0 * MASS * STIFFNESS,
                4.0 * MASS * cross,
            );
            (disc.sqrt() * sign - DAMPING) / (2.0 * MASS)
        };
        for sign in [1.0, -1.0] {
            let multiplier = (root(sign) * period).exp();
            let found = stability.multipliers.iter();
            // Of a pair either is told, or both.
            let off = found
                .map(|m| {
                    (m.value - multiplier)
                        .norm()
                        .min((m.value.conj() - multiplier).norm())
                })
                .fold(f64::INFINITY, f64::min);
            println!("{part}: {multiplier} off by {off:.1e}");
            assert!(off < 1e-9, "{multiplier}: {}", stability.report());
        }
    }
}

#[test]
fn modes_of_an_unsymmetric_bushing_are_those_of_its_matrices() {
    // Displacements along x and y alone, by stiffness and damping without any symmetry.
    let mut model = Model::new();
    let body = ball(&mut model, MASS, 1.0, &Vector3::zeros());
    let origin = Motion::identity();
    let mut stiffness = Matrix6::identity() * 500.0;
    let mut damping = Matrix6::zeros();
    let (k, c) = ([[40.0, 12.0], [-7.0, 25.0]], [[1.0, 0.4], [-0.9, 2.0]]);
    for i in 0..2 {
        for j in 0..2 {
            stiffness[(i, j)] = k[i][j];
            damping[(i, j)] = c[i][j];
        }
    }
    let ends = [None, Some(body)];
    let matrices = [&stiffness, &damping];
    let angles = BushingAngles::RotationVector;
    let bushing = model
        .add_bushing(ends, [&origin, &origin], matrices, angles)
        .unwrap();
    for factor in [1.0, 2.0] {
        let options = ModesOptions {
            count: 2,
            ..ModesOptions::default()
        };
        let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
        for mode in modes.modes() {
            let s = mode.eigenvalue;
            let entry = |i: usize, j: usize| s * c[i][j] * factor + k[i][j] * factor;
            let own = s * s * MASS;
            let determinant = (own + entry(0, 0)) * (own + entry(1, 1)) - entry(0, 1) * entry(1, 0);
            let size = (own + entry(0, 0)).norm() * 100.0;
            assert!(determinant.norm() < 1e-11 * size, "{s}: {determinant}");
        }
        // Twice as stiff, and damped, by parameters.
        if factor == 1.0 {
            for target in [Target::Stiffness(bushing, 1), Target::Damping(bushing, 1)] {
                let parameter = model.add_parameter(&format!("{target:?}"), 2.0, 1.0);
                model
                    .move_by_parameter(parameter.unwrap(), target, 1.0)
                    .unwrap();
            }
        }
    }
}

#[test]
fn a_bushing_turns_far_about_the_axis_of_its_moment() {
    for angle in [0.1, 2.0, 3.0] {
        let mut model = Model::new();
        let body = ball(&mut model, 1.0, 1.0, &Vector3::new(0.3, 0.1, -0.2));
        let frame = Motion::identity();
        let stiffness = Matrix6::from_diagonal(&Vector6::new(9.0, 9.0, 9.0, 4.0, 4.0, 4.0));
        let ends = [None, Some(body)];
        let matrices = [&stiffness, &Matrix6::zeros()];
        let angles = BushingAngles::RotationVector;
        model
            .add_bushing(ends, [&frame, &frame], matrices, angles)
            .unwrap();
        let axis = Vector3::new(0.48, -0.6, 0.64);
        for (k, x) in axis.iter().enumerate() {
            push(
                &mut model,
                body,
                3 + k,
                Signal::constant(4.0 * angle * x).unwrap(),
            );
        }
        let options = StaticOptions::default();
        let solution = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap();
        assert_eq!(
            solution.outcome(),
            Outcome::Converged,
            "{}",
            solution.report()
        );
        let rotation = solution
            .node(body, NodeQuantity::RotationMatrix, &[0.0])
            .unwrap();
        let turn = Motion::new(Matrix3::from_column_slice(&rotation), Vector3::zeros());
        let expected = periodyn::motion::rotation_from_vector(&(axis * angle));
        assert!((turn.rotation - expected).amax() < 1e-10, "{angle}");
    }
}

#[test]
fn a_bushing_survives_a_file_and_wrong_ones_are_refused() {
    let rotor = Rotor::new(5.0, 0.02);
    let path = std::env::temp_dir().join(format!("bushing_{}.pdm", std::process::id()));
    rotor.model.save(&path).unwrap();
    let loaded = Model::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let period = TAU / 5.0;
    let solutions = [&rotor.model, &loaded].map(|model| solve(model, period, 9));
    let [kept, again] = solutions.map(|s| rotor.orbit(&s, &[0.3])[0]);
    assert_eq!(kept, again);

    let mut model = rotor.model;
    let mut add =
        |ends: [Option<usize>; 2], stiffness: f64, angles, kind: ErrorKind, what: &str| {
            let matrix = Matrix6::identity() * stiffness;
            let frame = Motion::identity();
            let matrices = [&matrix, &Matrix6::identity()];
            let error = model.add_bushing(ends, [&frame, &frame], matrices, angles);
            let error = error.unwrap_err();
            assert_eq!(error.kind(), kind, "{error}");
            assert!(error.to_string().contains(what), "{error}");
        };
    let (vector, tilt) = (BushingAngles::RotationVector, BushingAngles::TiltAndSpin);
    add([Some(0), Some(0)], 1.0, vector, ErrorKind::Value, "second");
    add(
        [None, Some(9)],
        1.0,
        vector,
        ErrorKind::Identifier,
        "second",
    );
    add(
        [None, Some(0)],
        f64::NAN,
        vector,
        ErrorKind::NotFinite,
        "stiffness",
    );
    add([None, Some(0)], 1.0, tilt, ErrorKind::Value, "last column");
    assert_eq!(model.force_count(), 1);
}
