//! Bodies that spin about an axis of symmetry relative to their nodes: gyroscopic disks on shafts
//! that do not turn, and tops.

mod common;

use common::models::parts::*;
use common::*;
use nalgebra::{Matrix3, Matrix4, Matrix6, Rotation3, Vector3, Vector6};
use periodyn::collocation::{Collocation, GridState};
use periodyn::elements::{BushingAngles, Coordinate, JointKind, LoadFrame};
use periodyn::error::ErrorKind;
use periodyn::fourier::TimeGrid;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{ForceQuantity, JointQuantity, Modes, NodeQuantity, Quantity, Solution};
use periodyn::quantity::Feature;
use periodyn::solve::*;
use periodyn::system::System;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Gravity, and how far the centre of a [`Top`] is from where it stands.
const G: f64 = 9.81;
const HEIGHT: f64 = 0.4;
/// Mass of a top, its inertia about the point where it stands across its axis, and about its axis.
const MASS: f64 = 1.3;
const ACROSS: f64 = 0.3;
const ALONG: f64 = 0.11;

/// A top that leans by `lean` about y, on a joint with the ground at the origin; the body is node
/// 0, its centre on its axis z.
fn top(kind: JointKind, lean: f64) -> (Model, usize) {
    let mut model = Model::new();
    let leaning = Rotation3::new(Vector3::y() * lean).into_inner();
    let centre = leaning * Vector3::z() * HEIGHT;
    let node = model.add_node(&Motion::new(leaning, centre)).unwrap();
    let across = ACROSS - MASS * HEIGHT * HEIGHT;
    let inertia = Matrix3::from_diagonal(&Vector3::new(across, across, ALONG));
    let inertia = leaning * inertia * leaning.transpose();
    model.add_mass(node, MASS, &centre, &inertia).unwrap();
    let stand = [None, Some(node)];
    let joint = join(&mut model, kind, stand, &Vector3::zeros(), &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -G]);
    (model, joint)
}

#[test]
fn a_heavy_top_precesses_steadily_at_the_angle_where_its_moments_balance() {
    let lean = 0.8f64;
    for rate in [0.7, 2.5, -1.3, 6.0, 40.0] {
        // J₃ ω₃ Ω − J₁ Ω² cos θ = m g l, with ω₃ = s + Ω cos θ.
        let weight = MASS * G * HEIGHT;
        let along = (weight + ACROSS * rate * rate * lean.cos()) / (ALONG * rate);
        let spin = along - rate * lean.cos();
        // It begins a bit off.
        let (mut model, joint) = top(JointKind::Revolute, lean + 0.03);
        model.set_spin(0, &(Vector3::z() * 7.0), spin).unwrap();
        model
            .set_turning_frame(&Vector3::z(), rate, &Vector3::zeros())
            .unwrap();
        // Few lean so far that they fall.
        spring(&mut model, rotation1(joint), 30.0, 0.0);
        let found = statics(&model);
        let with_spring = found
            .joint(
                joint,
                JointQuantity::Coordinate(Coordinate::Rotation1),
                &[0.0],
            )
            .unwrap()[0];
        let angle = lean + 0.03 + with_spring;
        // The moment of the spring about y holds what the others leave.
        let (s, c) = angle.sin_cos();
        let left = s * (ALONG * (spin + rate * c) * rate - ACROSS * rate * rate * c - weight);
        println!("{rate}: {with_spring} {:e}", left + 30.0 * with_spring);
        let size = 30.0 + (ALONG * spin * rate).abs();
        assert!((left + 30.0 * with_spring).abs() < 1e-10 * size);
        assert!(with_spring.abs() < 0.03 + 1e-12);
    }
}

/// Euler's and Lagrange's heavy top by quadrature: its period, what it precesses and what it spins
/// in one.
struct Nutation {
    period: f64,
    precession: f64,
    spin: f64,
    /// Angles between which it nutates.
    angles: [f64; 2],
    /// Momentum about the vertical.
    momentum: f64,
}

/// That which begins at this lean with this rate of precession, and turns at `along` about its
/// axis.
fn nutation(lean: f64, rate: f64, along: f64) -> Nutation {
    let (weight, own) = (MASS * G * HEIGHT, ALONG * along);
    let first = lean.cos();
    let square = 1.0 - first * first;
    let momentum = own * first + ACROSS * square * rate;
    let energy = 0.5 * ACROSS * square * rate * rate + weight * first;
    // u̇² = β (u − u₁) (u − u₂) (u − u₃) for u = cos θ.
    let beta = 2.0 * weight / ACROSS;
    let sum = (2.0 * energy / ACROSS + (own / ACROSS).powi(2)) / beta - first;
    let product = ((momentum / ACROSS).powi(2) - 2.0 * energy / ACROSS) / (beta * first);
    let root = (0.25 * sum * sum - product).sqrt();
    let (second, third) = (0.5 * sum - root, 0.5 * sum + root);
    assert!(second.abs() < 1.0 && third > 1.0);
    // u = mean + half sin x makes it periodic in x: the sum over equal parts is exact.
    let (mean, half) = (0.5 * (first + second), 0.5 * (first - second));
    let parts = 400;
    let [mut period, mut precession, mut turned] = [0.0; 3];
    for k in 0..parts {
        let x = TAU * f64::from(k) / f64::from(parts);
        let u = mean + half * x.sin();
        let time = TAU / f64::from(parts) / (beta * (third - u)).sqrt();
        let rate = (momentum - own * u) / (ACROSS * (1.0 - u * u));
        period += time;
        precession += rate * time;
        turned += (along - rate * u) * time;
    }
    Nutation {
        period,
        precession,
        spin: turned,
        angles: [first.acos(), second.acos()],
        momentum,
    }
}

#[test]
fn a_nutating_top_finds_its_precession_and_its_spin() {
    let points = 41;
    let exact = nutation(0.7, 0.4, 22.0);
    let [least, most] = exact.angles;
    let (mut model, _) = top(JointKind::Spherical, 0.0);
    let (rate, spin) = (
        1.03 * exact.precession / exact.period,
        0.98 * exact.spin / exact.period,
    );
    model.set_spin(0, &Vector3::z(), spin).unwrap();
    let origin = Vector3::zeros();
    model
        .set_turning_frame(&Vector3::z(), rate, &origin)
        .unwrap();
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        let mut components = [const { None }; 6];
        components[5] = Some(Signal::constant(0.0).unwrap());
        model.add_load(0, frame, components).unwrap();
    }
    let mean = |load| Target::Signal(SignalPlace::Load(load, 5), SignalPart::Mean);
    let mut free = vec![Free::Frequency];
    for (name, value, target) in [
        ("rate", rate, Target::FrameRate),
        ("spin", spin, Target::Spin(0)),
        ("damping", 0.0, Target::MassDamping),
        ("moment", 0.0, mean(0)),
        ("own moment", 0.0, mean(1)),
    ] {
        let parameter = model.add_parameter(name, value, 1.0).unwrap();
        model.move_by_parameter(parameter, target, 1.0).unwrap();
        free.push(Free::Parameter(parameter));
    }
    let at_start = |quantity, component, value| OutputIs {
        output: Quantity::Node(0, quantity).component(component),
        feature: Feature::At(0.0),
        value,
        scale: None,
    };
    let about = RigidMotion::rotation(&Vector3::z(), &origin).unwrap();
    let conditions: [Arc<dyn Condition>; 6] = [
        Arc::new(Phase),
        Arc::new(RigidPhase(about)),
        Arc::new(at_start(NodeQuantity::RotationMatrix, 5, 0.0)),
        Arc::new(at_start(NodeQuantity::Position, 2, HEIGHT * least.cos())),
        Arc::new(Momentum {
            motion: about,
            value: exact.momentum,
        }),
        Arc::new(at_start(
            NodeQuantity::Velocity,
            1,
            0.4 * least.sin() * HEIGHT,
        )),
    ];
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let options = PeriodicOptions {
            linear,
            ..options(points)
        };
        let options = starting_at(options, (&model, points, 1.01 * exact.period), |t| {
            let lean = 0.5 * (least + most) - 0.45 * (most - least) * t.cos();
            let turn = Rotation3::new(Vector3::z() * (-0.5 * (most - least) * t.sin()))
                * Rotation3::new(Vector3::y() * lean)
                * Rotation3::new(Vector3::z() * (0.3 * (most - least) * t.sin()));
            let turn = turn.into_inner();
            Motion::new(turn, turn * Vector3::z() * HEIGHT)
        });
        let found = solve_for(&model, exact.period * 1.01, &free, &conditions, &options);
        let period = found.grid().period();
        let values: Vec<f64> = (found.model().parameters().iter())
            .map(|parameter| parameter.value)
            .collect();
        let off = [
            period / exact.period - 1.0,
            values[0] * period - exact.precession,
            values[1] * period - exact.spin,
        ];
        let iterations = &found.details().report.iterations;
        let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
        println!("{linear:?}: {off:?} {values:?} {increments:?}");
        assert!(off.iter().all(|off| off.abs() < 1e-10), "{off:?}");
        // Nothing is lost, so nothing is to be added.
        assert!(values[2..].iter().all(|x| x.abs() < 1e-9), "{values:?}");
    }
}

/// Bending stiffness and length of a shaft.
const BENDING: f64 = 40.0;
const LENGTH: f64 = 0.5;

#[test]
fn whirl_frequencies_of_an_overhung_disk_are_those_of_the_closed_form() {
    let (mass, tilt, polar) = (2.0, 0.05, 0.09);
    let k = [
        12.0 * BENDING / LENGTH.powi(3),
        6.0 * BENDING / LENGTH.powi(2),
        4.0 * BENDING / LENGTH,
    ];
    let mut stiffness = Matrix6::from_diagonal(&Vector6::new(1e5, k[0], k[0], 3e5, k[2], k[2]));
    for (i, j, sign) in [(1, 5, -1.0), (2, 4, 1.0)] {
        stiffness[(i, j)] = sign * k[1];
        stiffness[(j, i)] = sign * k[1];
    }
    for spin in [0.0, 3.0, 30.0, -120.0, 1e3, 2e4] {
        let mut model = Model::new();
        let inertia = Matrix3::from_diagonal(&Vector3::new(polar, tilt, tilt));
        let disk = model.add_rigid_body(mass, &Vector3::zeros(), &inertia);
        let frame = Motion::identity();
        model
            .add_bushing(
                [None, Some(disk.unwrap())],
                [&frame, &frame],
                [&stiffness, &Matrix6::zeros()],
                BushingAngles::RotationVector,
            )
            .unwrap();
        model.set_spin(0, &Vector3::x(), spin).unwrap();
        let options = ModesOptions {
            count: 6,
            ..ModesOptions::default()
        };
        let found = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
        assert_eq!(found.outcome(), Outcome::Converged, "{}", found.report());
        // (k₁₁ − m ω²) (k₂₂ − J ω² + J_p s ω) = k₁₂² of y + i z = a exp(iωt).
        let (unit, gyroscopic) = (mass * tilt, polar * spin);
        let a = [
            (k[0] * k[2] - k[1] * k[1]) / unit,
            k[0] * gyroscopic / unit,
            -(k[0] * tilt + k[2] * mass) / unit,
            -gyroscopic / tilt,
        ];
        #[rustfmt::skip]
        let companion = Matrix4::new(
            0.0, 0.0, 0.0, -a[0],
            1.0, 0.0, 0.0, -a[1],
            0.0, 1.0, 0.0, -a[2],
            0.0, 0.0, 1.0, -a[3],
        );
        let exact = companion.complex_eigenvalues();
        let mut off = 0.0f64;
        for root in &exact {
            assert!(root.im.abs() < 1e-6 * root.re.abs());
            let nearest = found.modes().iter().map(|mode| {
                assert!(mode.eigenvalue.re.abs() < 1e-8 * mode.eigenvalue.im);
                (mode.eigenvalue.im / root.re.abs() - 1.0).abs()
            });
            off = off.max(nearest.fold(f64::INFINITY, f64::min));
        }
        println!("{spin}: {exact:?} {off:e}");
        // The closed form's own eigenvalues are of this accuracy where they are far apart.
        assert!(off < 1e-8, "{off:e}");
    }
}

/// Period and spin of [`line`].
const PERIOD: f64 = 0.21;
const SPIN: f64 = 5.0 * TAU / PERIOD;

/// What a disk does in [`line`].
#[derive(Clone, Copy, PartialEq)]
enum Disk {
    Spins,
    Turns,
    Rests,
}

/// A shaft on two bearings with a disk that overhangs, its centre off the node that bears it and
/// off the axis of the shaft, and a force that shakes the other end. Gives the nodes of the shaft
/// and the bearings.
fn line(disk: Disk) -> (Model, std::ops::RangeInclusive<usize>, [usize; 2]) {
    let mut model = Model::new();
    let section = damped_section(
        &[4e6, 2e6, 2e6, 700.0, 600.0, 900.0],
        &[0.5, 4e-4, 2e-4, 2e-4],
        1e-3,
    );
    let (start, end) = (Vector3::zeros(), Vector3::new(0.9, 0.0, 0.1));
    let shaft = model
        .add_straight_beam(&start, &end, &Vector3::y(), &section, 3, 3)
        .unwrap();
    let [first, last] = [shaft.first_node, shaft.last_node];
    let damping = Matrix6::from_diagonal(&Vector6::new(90.0, 90.0, 90.0, 0.5, 0.1, 0.1));
    let bearings = [(first, 2e4), (last - 3, 3e4)].map(|(node, k)| {
        let stiffness = Vector6::new(k, 1.3 * k, 0.8 * k, 400.0, 20.0, 30.0);
        let place = Motion::new(Matrix3::identity(), model.node(node).unwrap().position);
        let bearing = model.add_bushing(
            [None, Some(node)],
            [&place, &place],
            [&Matrix6::from_diagonal(&stiffness), &damping],
            BushingAngles::RotationVector,
        );
        bearing.unwrap()
    });
    let centre = end + Vector3::new(0.12, 0.05, -0.03);
    let axis = Vector3::new(0.8, 0.1, -0.4).normalize();
    let inertia = Matrix3::identity() * 0.02 + axis * axis.transpose() * 0.015;
    if disk == Disk::Turns {
        let node = model.add_rigid_body(3.0, &centre, &inertia).unwrap();
        let joint = revolute(&mut model, Some(last), Some(node), &centre, &axis);
        model.prescribe(rotation1(joint), &steady(SPIN)).unwrap();
    } else {
        let number = model.add_mass(last, 3.0, &centre, &inertia).unwrap();
        if disk == Disk::Spins {
            let axis = model.node(last).unwrap().rotation.transpose() * axis;
            model.set_spin(number, &axis, SPIN).unwrap();
        }
    }
    gravity(&mut model, [0.3, -9.81, 0.0]);
    model.set_mass_damping(0.7).unwrap();
    push(&mut model, first, 1, cosine(30.0));
    push(&mut model, last - 4, 2, cosine(40.0));
    (model, first..=last, bearings)
}

#[test]
fn a_disk_that_spins_does_to_its_shaft_what_one_does_that_turns_on_it() {
    let points = 41;
    let times = times(PERIOD, 30);
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let [turns, spins, rests] = [Disk::Turns, Disk::Spins, Disk::Rests].map(|disk| {
            let (model, nodes, bearings) = line(disk);
            let options = PeriodicOptions {
                linear,
                ..options(points)
            };
            let found = Solution::solve(&model, PERIOD, &options, &mut |_, _| true).unwrap();
            let found = converged(found);
            let mut at = Vec::new();
            for node in nodes {
                for quantity in [NodeQuantity::Position, NodeQuantity::RotationMatrix] {
                    at.extend(found.node(node, quantity, &times).unwrap());
                }
            }
            let efforts = bearings.map(|bearing| {
                let quantity = ForceQuantity::BushingEfforts;
                found.force(bearing, quantity, &times).unwrap()
            });
            (at, efforts.concat())
        });
        let off = [
            largest_difference(&turns.0, &spins.0),
            largest_difference(&turns.1, &spins.1) / largest(turns.1.iter().copied()),
        ];
        let matters = [
            largest_difference(&rests.0, &spins.0),
            largest_difference(&rests.1, &spins.1) / largest(turns.1.iter().copied()),
        ];
        println!("{linear:?}: {off:?} of {matters:?}");
        assert!(off.iter().all(|off| *off < 1e-10), "{off:?}");
        assert!(matters.iter().all(|it| *it > 1e-3), "{matters:?}");
    }
}

#[test]
fn marches_of_both_meet_with_the_square_of_the_step() {
    let ends = [400, 800].map(|steps| {
        let found = [Disk::Turns, Disk::Spins].map(|disk| {
            let (model, nodes, _) = line(disk);
            let end = MarchEnd::Duration(0.25 * PERIOD);
            let options = MarchOptions {
                period: Some(PERIOD),
                ..MarchOptions::with_step(PERIOD / f64::from(steps), end)
            };
            let marched = Solution::march(&model, &options, &mut |_, _| true).unwrap();
            let marched = converged(marched);
            let time = [0.25 * PERIOD];
            let at = |node| marched.node(node, NodeQuantity::Position, &time).unwrap();
            nodes.flat_map(at).collect::<Vec<f64>>()
        });
        largest_difference(&found[0], &found[1])
    });
    let order = (ends[0] / ends[1]).log2();
    println!("{ends:?} {order}");
    assert!(ends[1] < 1e-4 && (order - 2.0).abs() < 0.3, "{order}");
}

#[test]
fn disturbances_of_both_decay_alike() {
    let found = [Disk::Turns, Disk::Spins].map(|disk| {
        let (model, ..) = line(disk);
        let solution = solve(&model, PERIOD, 25);
        let stability = solution.solve_stability(&StabilityOptions::default());
        let stability = stability.unwrap();
        assert_eq!(stability.outcome, Outcome::Converged);
        stability
    });
    let [a, b] = found.each_ref().map(|it| &it.multipliers);
    assert!(a.len().min(b.len()) >= 6);
    for (a, b) in a.iter().zip(b).take(6) {
        let off = (a.value - b.value).norm();
        println!("{} {off:e}", a.value);
        assert!(off < 1e-7, "{off:e}");
    }
}

#[test]
fn a_march_of_a_top_keeps_its_momentum_and_energy_to_its_order() {
    let (mut model, _) = top(JointKind::Spherical, 0.7);
    let spin = 30.0;
    model.set_spin(0, &Vector3::z(), spin).unwrap();
    // Of the body: about the vertical, about its own axis, and the energy.
    let kept = |solution: &Solution, time: f64| {
        let at = |quantity| solution.node(0, quantity, &[time]).unwrap();
        let turn = Matrix3::from_column_slice(&at(NodeQuantity::RotationMatrix));
        let twist = at(NodeQuantity::MaterialVelocity);
        let w = Vector3::new(twist[3], twist[4], twist[5] + spin);
        let momentum = Vector3::new(ACROSS * w.x, ACROSS * w.y, ALONG * w.z);
        let height = at(NodeQuantity::Position)[2];
        let energy = 0.5 * w.dot(&momentum) + MASS * G * height;
        Vector3::new((turn * momentum).z, momentum.z, energy)
    };
    let off = [500, 1000].map(|steps| {
        let options = MarchOptions::with_step(1.0 / f64::from(steps), MarchEnd::Duration(1.0));
        let marched = Solution::march(&model, &options, &mut |_, _| true).unwrap();
        let marched = converged(marched);
        let height = marched
            .node(0, NodeQuantity::Position, &[0.0, 1.0])
            .unwrap();
        assert!((height[5] - height[2]).abs() > 1e-4, "it nutates");
        let start = kept(&marched, 0.0);
        times(1.0, 50)
            .into_iter()
            .map(|time| (kept(&marched, time) - start).component_div(&start).amax())
            .fold(0.0, f64::max)
    });
    let order = (off[0] / off[1]).log2();
    println!("{off:?} {order}");
    assert!(off[1] < 1e-5 && order > 1.7, "{off:?}");
}

#[test]
fn energy_and_momentum_are_those_of_the_body() {
    let lean = 0.7f64;
    let (mut model, _) = top(JointKind::Revolute, lean);
    model.set_spin(0, &Vector3::z(), 30.0).unwrap();
    let grid = TimeGrid::new(3, 1.0).unwrap();
    let system = Arc::new(System::new(&model, 1.0).unwrap());
    let state = GridState::reference(&system, grid);
    let mut equations = Collocation::new(system, grid).unwrap();
    equations.update_kinematics(&state);
    let weight = MASS * G * HEIGHT * lean.cos();
    let energy = equations.mean_energy(&state).unwrap() - weight;
    assert!((energy - 450.0 * ALONG).abs() < 1e-12 * energy, "{energy}");
    for (axis, share) in [(Vector3::z(), lean.cos()), (Vector3::x(), lean.sin())] {
        let about = RigidMotion::rotation(&axis, &Vector3::zeros()).unwrap();
        let momentum = equations.mean_momentum(&about.twist);
        assert!((momentum - 30.0 * ALONG * share).abs() < 1e-13);
    }
}

#[test]
fn files_and_copies_keep_the_spin_and_a_parameter_moves_it() {
    let (mut model, ..) = line(Disk::Spins);
    let spin = model.spin(0).unwrap();
    assert!((spin.rate() - SPIN).abs() < 1e-12 && (spin.axis().norm() - 1.0).abs() < 1e-15);
    let parameter = model.add_parameter("speed", 3.0, 1.0).unwrap();
    model
        .move_by_parameter(parameter, Target::Spin(0), 2.0)
        .unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("model");
    model.save(&path).unwrap();
    let mut again = Model::load(&path).unwrap();
    assert_eq!(again.spin(0), model.spin(0));
    assert_eq!(again.spin(0).unwrap().rate(), 6.0);
    again.set_parameter(parameter, 0.5 * SPIN).unwrap();
    assert_eq!(again.spin(0), Some(spin));
    let ends = [&line(Disk::Spins).0, &again].map(|model| {
        let found = solve(model, PERIOD, 9);
        found.node(3, NodeQuantity::Position, &[0.1]).unwrap()
    });
    assert_eq!(ends[0], ends[1]);
    assert!(again.spin(1).is_none());
    let refused = again.move_by_parameter(parameter, Target::Spin(1), 1.0);
    assert_eq!(refused.unwrap_err().kind(), ErrorKind::Identifier);
}

#[test]
fn what_is_not_symmetric_about_the_axis_does_not_spin() {
    let mut model = Model::new();
    let at = |x: f64| Vector3::new(x, -0.2 * x, 0.5 * x);
    let inertia = Matrix3::from_diagonal(&Vector3::new(10.0, 20.0, 20.0));
    model.add_rigid_body(3.0, &at(1.0), &inertia).unwrap();
    let refuse = |model: &mut Model, inertia, axis: Vector3<f64>, rate, why: &str| {
        let before = model.spin(0);
        let error = model.set_spin(inertia, &axis, rate).unwrap_err();
        assert!(error.to_string().contains(why), "{error}");
        assert_eq!(model.spin(0), before);
    };
    let [x, y] = [Vector3::x(), Vector3::y()];
    refuse(
        &mut model,
        0,
        y,
        1.0,
        "symmetric about the axis through its",
    );
    refuse(&mut model, 0, x + y * 1e-6, 1.0, "symmetric about the axis");
    refuse(&mut model, 0, Vector3::zeros(), 1.0, "axis: ");
    refuse(&mut model, 0, x * f64::NAN, 1.0, "axis");
    refuse(&mut model, 0, x, f64::INFINITY, "rate");
    refuse(&mut model, 0, x, 1e308, "inertia times rate");
    refuse(&mut model, 1, x, 1.0, "inertia: expected a");
    // As numbers with 9 digits.
    model.set_spin(0, &(x + y * 1e-9), 2.0).unwrap();
    // A body that spins stays symmetric.
    let node = model.inertias().next().unwrap().1;
    let mut other = node;
    other[(4, 4)] *= 1.5;
    let error = model.set_inertia(0, &other).unwrap_err();
    assert!(error.to_string().contains("symmetric about"), "{error}");
    model.set_inertia(0, &(node * 2.0)).unwrap();
    // A point off the node's axes is symmetric about any axis through it, as is a sphere.
    for moment in [0.0, 0.3] {
        for far in [0.0, 1e-3, 1.0, 30.0] {
            let inertia = Matrix3::identity() * moment;
            let number = model.add_mass(0, 0.7, &at(1.0 + far), &inertia).unwrap();
            let axis = Vector3::new(0.3, 0.4, -0.9);
            model.set_spin(number, &axis, 5.0).unwrap();
        }
    }
    // What has no mass across any axis spins about one through its node.
    let mut matrix = Matrix6::zeros();
    matrix[(4, 4)] = 2.0;
    let number = model.add_inertia(0, None, &matrix).unwrap();
    model.set_spin(number, &y, 5.0).unwrap();
    refuse(&mut model, number, x, 5.0, "symmetric about the axis");
}
