//! Controllers: laws that read other coordinates, and states of the user, against closed forms and
//! what other elements do.

mod common;

use common::*;
use nalgebra::{Complex, Vector3};
use periodyn::elements::*;
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::output::{ForceQuantity, JointQuantity, Modes, Quantity, Solution};
use periodyn::solve::*;
use periodyn::system::check_tangents;
use std::f64::consts::TAU;
use std::sync::Arc;

type C64 = Complex<f64>;

const SLIDE: JointQuantity = JointQuantity::Coordinate(Coordinate::Displacement1);
const ANGLE: JointQuantity = JointQuantity::Coordinate(Coordinate::Rotation1);
const DRIVE: JointQuantity = JointQuantity::DrivingEffort(Coordinate::Rotation1);

/// Mass, damping and stiffness of an oscillator; gains by position, integral and rate.
const PLANT: [f64; 3] = [2.0, 0.3, 5.0];
const GAINS: [f64; 3] = [1.5, 2.5, 0.8];

/// `u = −p q − i x − d q̇` with `ẋ = q`, in a unit of the state that is `unit` times as large.
fn pid(unit: f64, gives_tangents: bool) -> ControllerLaw {
    let [p, i, d] = GAINS;
    ControllerLaw {
        function: Arc::new(move |input, output| {
            let (q, v, x) = (input.values[0], input.rates[0], input.states[0]);
            output.efforts[0] = -p * q - i * unit * x - d * v;
            output.state_rates[0] = q / unit;
            if let Some([by_value, by_rate, by_state]) = &mut output.tangents {
                (by_value[(0, 0)], by_value[(1, 0)]) = (-p, 1.0 / unit);
                by_rate[(0, 0)] = -d;
                by_state[(0, 0)] = -i * unit;
            }
            Ok(())
        }),
        gives_tangents,
    }
}

fn of_size(size: f64) -> ControllerState {
    ControllerState { initial: 0.0, size }
}

/// The controlled oscillator, its slide, and the controller.
fn controlled(unit: f64, gives_tangents: bool) -> (Model, JointCoordinate, usize) {
    let [mass, damping, stiffness] = PLANT;
    let (mut model, at) = mass_on_a_slide(mass, &Vector3::z());
    spring(&mut model, at, stiffness, damping);
    let states = [of_size(0.3 / unit)];
    let law = pid(unit, gives_tangents);
    let force = model.add_controller(&[at], &[at], &states, law).unwrap();
    (model, at, force)
}

/// Coefficients of `m s³ + (c + d) s² + (k + p) s + i`, from the highest.
fn characteristic() -> [f64; 4] {
    let ([mass, damping, stiffness], [p, i, d]) = (PLANT, GAINS);
    [mass, damping + d, stiffness + p, i]
}

/// The roots, by Durand and Kerner's iteration.
fn roots() -> [C64; 3] {
    let [lead, rest @ ..] = characteristic();
    let value = |s: C64| ((s + rest[0] / lead) * s + rest[1] / lead) * s + rest[2] / lead;
    let mut all = [0, 1, 2].map(|k| C64::new(0.4, 0.9).powi(k));
    for _ in 0..200 {
        for j in 0..3 {
            let others = (0..3).filter(|&k| k != j).map(|k| all[j] - all[k]);
            all[j] -= value(all[j]) / others.product::<C64>();
        }
    }
    all
}

/// Distance of each of `wanted`, or its conjugate, from the nearest found.
fn assert_found(wanted: &[C64], found: &[C64], tolerance: f64) {
    for z in wanted {
        let distance = |x: &C64| (x - z).norm().min((x.conj() - z).norm());
        let off = found.iter().map(distance).fold(f64::INFINITY, f64::min);
        println!("{z} off by {off:.1e}");
        assert!(off < tolerance, "{z}: {found:?}");
    }
}

fn control(force: usize, quantity: ForceQuantity) -> Quantity {
    Quantity::Force(force, quantity)
}

fn assert_wave(found: &[f64], amplitude: C64, omega: f64, times: &[f64], tolerance: f64) {
    let exact = times.iter().map(|t| (amplitude * C64::cis(omega * t)).re);
    let exact: Vec<f64> = exact.collect();
    let error = largest_difference(found, &exact) / amplitude.norm();
    println!("relative error {error:.1e}");
    assert!(error < tolerance, "{error:e}");
}

#[test]
fn a_controlled_oscillator_is_one_of_third_order() {
    let (omega, amplitude) = (1.7, 0.9);
    let period = TAU / omega;
    let times = times(period, 37);
    let s = C64::new(0.0, omega);
    let [a, b, c, d] = characteristic();
    let q = s * amplitude / (((s * a + b) * s + c) * s + d);
    // Rounding; differences of a linear law leave as much as given tangents.
    for (unit, gives_tangents) in [(1.0, true), (1e4, true), (1e-3, false)] {
        let (mut model, at, force) = controlled(unit, gives_tangents);
        model.add_actuator(at, &cosine(amplitude)).unwrap();
        for linear in [
            LinearMethod::Direct,
            LinearMethod::Iterative(None),
            LinearMethod::Automatic,
        ] {
            let options = PeriodicOptions {
                linear,
                ..options(9)
            };
            let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
            let report = solution.report();
            assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
            // Linear: one step, and one that shows it.
            assert!(solution.details().report.iterations.len() <= 3, "{report}");
            let found = solution.joint(at.joint, SLIDE, &times).unwrap();
            assert_wave(&found, q, omega, &times, 1e-11);
            let state = control(force, ForceQuantity::ControlState(0));
            let found = solution.sample(state, &times).unwrap();
            assert_wave(&found, q / s / unit, omega, &times, 1e-11);
            let effort = control(force, ForceQuantity::ControlEffort(0));
            let [p, i, d] = GAINS;
            let exact = -q * (s * d + p + C64::from(i) / s);
            let found = solution.sample(effort, &times).unwrap();
            assert_wave(&found, exact, omega, &times, 1e-11);
        }
    }
}

#[test]
fn multipliers_and_modes_count_the_state() {
    let (mut model, at, _) = controlled(1.0, true);
    let exact = roots();
    let [a, .., d] = characteristic();
    assert!((exact.iter().product::<C64>() + d / a).norm() < 1e-13);
    let options = ModesOptions {
        count: 3,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    let found: Vec<C64> = modes.modes().iter().map(|mode| mode.eigenvalue).collect();
    assert_found(&exact, &found, 1e-10);

    model.add_actuator(at, &cosine(0.9)).unwrap();
    let period = TAU / 1.7;
    let solution = solve(&model, period, 21);
    let exact = exact.map(|root| (root * period).exp());
    for method in [StabilityMethod::PeriodMap, StabilityMethod::Grid] {
        let options = StabilityOptions {
            method,
            tolerance: 1e-10,
            ..StabilityOptions::default()
        };
        let stability = solution.solve_stability(&options).unwrap();
        let all = &stability.multipliers;
        assert_eq!(stability.verdict, Verdict::Stable, "{}", stability.report());
        let found: Vec<C64> = all.iter().map(|m| m.value).collect();
        // As told, two of a pair or one.
        assert!((2..=3).contains(&found.len()), "{}", stability.report());
        assert_found(&exact, &found, 1e-9);
    }

    // Of second order in the steps.
    let errors = [400, 800].map(|steps| {
        let options = ShootingOptions {
            steps,
            ..ShootingOptions::default()
        };
        let shot = Solution::solve_shooting(&model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(shot.outcome(), Outcome::Converged, "{}", shot.report());
        let Kind::Shooting { floquet, .. } = &shot.details().kind else {
            panic!("{}", shot.report());
        };
        assert_eq!(floquet.len(), 3);
        let off = |z: &[f64; 2]| {
            let all = exact.iter().map(|x| (x - C64::new(z[0], z[1])).norm());
            all.fold(f64::INFINITY, f64::min)
        };
        floquet.iter().map(off).fold(0.0, f64::max)
    });
    let order = (errors[0] / errors[1]).log2();
    println!("{errors:?}, order {order}");
    assert!((order - 2.0).abs() < 0.1 && errors[1] < 1e-4, "{errors:?}");
}

#[test]
fn an_integral_holds_the_mass_at_rest_and_marches_begin_with_its_state() {
    let (mut model, at, force) = controlled(1.0, true);
    let load = Signal::constant(3.0).unwrap();
    model.add_actuator(at, &load).unwrap();
    let statics = StaticOptions::default();
    let solution = Solution::solve_static(&model, &statics, &mut |_, _| true).unwrap();
    let report = solution.report();
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    let q = solution.joint(at.joint, SLIDE, &[0.0]).unwrap()[0];
    let state = control(force, ForceQuantity::ControlState(0));
    let x = solution.sample(state, &[0.0]).unwrap()[0];
    assert!(
        q.abs() < 1e-12 && (x - 3.0 / GAINS[1]).abs() < 1e-12,
        "{q} {x}"
    );

    // From rest with another state: the sum over the roots of residues of what Laplace's transform
    // of q is, (F − i x₀) / (m s³ + …).
    let initial = -0.4;
    let [mass, damping, stiffness] = PLANT;
    let (mut model, at) = mass_on_a_slide(mass, &Vector3::z());
    spring(&mut model, at, stiffness, damping);
    let states = [ControllerState { initial, size: 0.5 }];
    let force = model
        .add_controller(&[at], &[at], &states, pid(1.0, true))
        .unwrap();
    model.add_actuator(at, &load).unwrap();
    let jump = 3.0 - GAINS[1] * initial;
    let [a, b, c, _] = characteristic();
    let exact = |t: f64, power: i32| -> f64 {
        let residue = |s: &C64| (s * t).exp() * s.powi(power) / ((s * 3.0 * a + 2.0 * b) * s + c);
        roots().iter().map(residue).sum::<C64>().re * jump
    };
    let end = 4.0;
    let errors = [0.01, 0.005].map(|step| {
        let options = MarchOptions::with_step(step, MarchEnd::Duration(end));
        let march = Solution::march(&model, &options, &mut |_, _| true).unwrap();
        assert_eq!(march.outcome(), Outcome::Converged, "{}", march.report());
        let q = march.joint(at.joint, SLIDE, &[end]).unwrap()[0];
        let state = control(force, ForceQuantity::ControlState(0));
        let x = march.sample(state, &[0.0, end]).unwrap();
        assert_eq!(x[0], initial);
        // The integral of q, which vanishes at first.
        let integral = exact(end, -1) - exact(0.0, -1);
        [q - exact(end, 0), x[1] - initial - integral]
    });
    for i in 0..2 {
        let order = (errors[0][i] / errors[1][i]).log2();
        println!("{errors:?}, order {order}");
        assert!((order - 2.0).abs() < 0.1 && errors[1][i].abs() < 1e-4);
    }
}

#[test]
fn a_lagging_damper_is_a_maxwell_branch() {
    // u = −(K τ) y with τ ẏ + y = q̇, which reads a rate, is K α with τ α̇ + α = τ q̇.
    let (stiffness, time) = (3.0, 0.6);
    let build = |by_controller: bool| {
        let (mut model, hinge) = arm();
        let at = rotation1(hinge);
        spring(&mut model, at, 1.2, 0.1);
        gravity(&mut model, [0.0, -9.81, 0.0]);
        model.add_actuator(at, &cosine(2.0)).unwrap();
        let law = ControllerLaw {
            function: Arc::new(move |input, output| {
                output.efforts[0] = -stiffness * time * input.states[0];
                output.state_rates[0] = (input.rates[0] - input.states[0]) / time;
                Ok(())
            }),
            gives_tangents: false,
        };
        let relaxation_time = time;
        let branch = MaxwellBranch {
            stiffness,
            relaxation_time,
        };
        match by_controller {
            true => model.add_controller(&[at], &[at], &[of_size(1.0)], law),
            false => model.add_viscoelastic(at, 0.0, 0.0, &[branch]),
        }
        .unwrap();
        (model, hinge)
    };
    let period = TAU / 2.3;
    let times = times(period, 31);
    let [(branch, hinge), (controlled, _)] = [false, true].map(build);
    let angles = |solution: &Solution| solution.joint(hinge, ANGLE, &times).unwrap();
    let methods = [LinearMethod::Direct, LinearMethod::Iterative(None)];
    for linear in methods {
        let options = PeriodicOptions {
            linear,
            ..options(61)
        };
        let [a, b] = [&branch, &controlled].map(|model| {
            let solved = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
            assert_eq!(solved.outcome(), Outcome::Converged, "{}", solved.report());
            solved
        });
        let error = largest_difference(&angles(&a), &angles(&b));
        println!("{error:e}");
        // The rate of a rotation is had from the motion, not from the angles at the grid points.
        assert!(error < 1e-10, "{error:e}");
        let sizes: Vec<f64> = b
            .details()
            .report
            .iterations
            .iter()
            .map(|x| x.increment)
            .collect();
        let slow = sizes.windows(2).filter(|s| s[0] < 0.05 && s[1] > 1e-11);
        slow.for_each(|s| assert!(s[1] < 30.0 * s[0] * s[0], "{sizes:?}"));
        let [a, b] = [a, b].map(|solution| {
            let found = solution
                .solve_stability(&StabilityOptions::default())
                .unwrap();
            found
                .multipliers
                .iter()
                .map(|m| m.value)
                .collect::<Vec<_>>()
        });
        assert_eq!(a.len(), b.len());
        assert_found(&a, &b, 1e-8);
    }
    // The same scheme makes another error of the state.
    let differences = [0.01, 0.005].map(|step| {
        let mut options = MarchOptions::with_step(step, MarchEnd::Duration(period));
        options.period = Some(period);
        let [a, b] = [&branch, &controlled].map(|model| {
            let march = Solution::march(model, &options, &mut |_, _| true).unwrap();
            assert_eq!(march.outcome(), Outcome::Converged, "{}", march.report());
            march.joint(hinge, ANGLE, &[period]).unwrap()[0]
        });
        (a - b).abs()
    });
    println!("{differences:?}");
    assert!(differences[1] < 1e-5 && differences[1] < 0.3 * differences[0]);
}

/// A slider-crank whose crank turns steadily; crank's and slide's coordinate.
fn engine(rate: f64) -> (Model, [JointCoordinate; 2]) {
    let mut model = Model::new();
    let (radius, rod) = (0.3, 1.0);
    let z = Vector3::z();
    let pin = Vector3::x() * radius;
    let end = Vector3::x() * (radius + rod);
    let crank = ball(&mut model, 1.0, 0.1, &(pin * 0.5));
    let bar = ball(&mut model, 0.7, 0.05, &((pin + end) * 0.5));
    let piston = ball(&mut model, 0.5, 0.01, &end);
    let shaft = revolute(&mut model, None, Some(crank), &Vector3::zeros(), &z);
    revolute(&mut model, Some(crank), Some(bar), &pin, &z);
    // Without constraints that depend on others.
    let bodies = [Some(bar), Some(piston)];
    join(&mut model, JointKind::Spherical, bodies, &end, &z);
    let x = Vector3::x();
    let slide = join(
        &mut model,
        JointKind::Prismatic,
        [None, Some(piston)],
        &end,
        &x,
    );
    let slide = JointCoordinate {
        joint: slide,
        coordinate: Coordinate::Displacement1,
    };
    let shaft = rotation1(shaft);
    model.prescribe(shaft, &steady(rate)).unwrap();
    (model, [shaft, slide])
}

#[test]
fn gas_by_the_angle_of_the_crank_is_a_signal_where_it_turns_steadily() {
    let (rate, period) = (3.0, TAU / 3.0);
    let (mut by_angle, [shaft, slide]) = engine(rate);
    let law = ControllerLaw {
        function: Arc::new(|input, output| {
            let angle = input.values[0];
            output.efforts[0] = -8.0 - 5.0 * angle.cos() + 2.0 * (2.0 * angle).sin();
            if let Some([by_value, ..]) = &mut output.tangents {
                by_value[(0, 0)] = 5.0 * angle.sin() + 4.0 * (2.0 * angle).cos();
            }
            Ok(())
        }),
        gives_tangents: true,
    };
    let gas = by_angle
        .add_controller(&[shaft], &[slide], &[], law)
        .unwrap();
    let check = check_tangents(&by_angle, gas, period).unwrap();
    assert!(check.error < 1e-7, "{check:?}");
    let (mut by_time, _) = engine(rate);
    let signal = Signal::harmonics(-8.0, 0.0, &[-5.0, 0.0], &[0.0, 2.0]).unwrap();
    by_time.add_actuator(slide, &signal).unwrap();
    let times = times(period, 40);
    let [angle, time] = [&by_angle, &by_time].map(|model| solve(model, period, 41));
    let drives = [&angle, &time].map(|x| x.joint(shaft.joint, DRIVE, &times).unwrap());
    let error = relative_to_range(&drives[0], &drives[1]);
    assert!(error < 1e-11, "{error:e}");
    let efforts = [
        angle.sample(control(gas, ForceQuantity::ControlEffort(0)), &times),
        time.sample(Quantity::Force(0, ForceQuantity::Effort), &times),
    ];
    let [a, b] = efforts.map(Result::unwrap);
    assert!(largest_difference(&a, &b) < 1e-11);

    // What does not repeat with the turns is no periodic force, nor is a state that drifts so.
    for with_state in [false, true] {
        let (mut model, [shaft, slide]) = engine(rate);
        let law = ControllerLaw {
            function: Arc::new(move |input, output| {
                match with_state {
                    true => output.state_rates[0] = 0.1 * input.values[0] - input.states[0],
                    false => output.efforts[0] = 0.1 * input.values[0],
                }
                Ok(())
            }),
            gives_tangents: false,
        };
        let states = &[of_size(1.0)][..usize::from(with_state)];
        model
            .add_controller(&[shaft], &[slide], states, law)
            .unwrap();
        let error = try_solve(&model, period, 41).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NotPeriodic, "{error}");
        assert!(error.to_string().contains("force 0"), "{error}");
    }
}

#[test]
fn what_makes_no_controller_is_refused() {
    let (mut model, at, force) = controlled(1.0, true);
    let other = JointCoordinate {
        coordinate: Coordinate::Rotation1,
        ..at
    };
    let law = || pid(1.0, true);
    let sound = [of_size(1.0)];
    let mut refused = |inputs: &[_], outputs: &[_], states: &[_], kind, what: &str| {
        let error = model
            .add_controller(inputs, outputs, states, law())
            .unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.to_string().contains(what), "{error}");
        assert_eq!(model.force_count(), force + 1);
    };
    let value = ErrorKind::Value;
    refused(
        &[at],
        &[],
        &sound,
        ErrorKind::Size,
        "output_count: expected at least 1",
    );
    refused(
        &[at, at],
        &[at],
        &sound,
        value,
        "inputs: expected each coordinate at most once",
    );
    refused(&[at], &[at, at], &sound, value, "outputs: expected");
    refused(
        &[other],
        &[at],
        &sound,
        ErrorKind::NotAvailable,
        "input[0]: coordinate",
    );
    refused(
        &[at],
        &[other],
        &sound,
        ErrorKind::NotAvailable,
        "output[0]: coordinate",
    );
    refused(
        &[at],
        &[at],
        &[of_size(0.0)],
        value,
        "sizes[0]: expected a positive number, got 0",
    );
    let endless = ControllerState {
        initial: f64::NAN,
        size: 1.0,
    };
    refused(&[at], &[at], &[endless], ErrorKind::NotFinite, "initial[0]");

    // A function that changes in time without the period, or gives no numbers.
    for (drift, kind, what) in [
        (
            1.0,
            ErrorKind::NotPeriodic,
            "does not repeat with the period",
        ),
        (
            f64::NAN,
            ErrorKind::Callback,
            "expected a finite rate of state 0",
        ),
    ] {
        let law = ControllerLaw {
            function: Arc::new(move |input, output| {
                output.state_rates[0] = drift * input.time - input.states[0];
                Ok(())
            }),
            gives_tangents: false,
        };
        let (mut model, at, force) = controlled(1.0, true);
        model.bind_controller(force, law).unwrap();
        model.add_actuator(at, &cosine(1.0)).unwrap();
        let error = try_solve(&model, 2.0, 9).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        let message = error.to_string();
        assert!(
            message.contains("force 1") && message.contains(what),
            "{message}"
        );
    }

    let spring = model.bind_controller(0, law()).unwrap_err();
    assert_eq!(spring.to_string(), "force: 0 is no controller");
    let solution = solve(&model, 2.0, 5);
    for (quantity, what) in [
        (ForceQuantity::ControlEffort(1), "has 1, got number 1"),
        (ForceQuantity::ControlState(1), "has 1, got number 1"),
        (ForceQuantity::Effort, "it has no effort"),
        (ForceQuantity::BranchEffort(0), "has 0 Maxwell branches"),
    ] {
        let error = solution
            .sample(control(force, quantity), &[0.0])
            .unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NotAvailable);
        assert!(error.to_string().contains(what), "{error}");
    }
}

#[test]
fn wrong_tangents_are_told() {
    let (mut model, at, force) = controlled(1.0, true);
    let check = check_tangents(&model, force, 2.0).unwrap();
    assert!(check.error < 1e-8, "{check:?}");
    let right = pid(1.0, true);
    let wrong = ControllerLaw {
        function: Arc::new(move |input, output| {
            (right.function)(input, output)?;
            if let Some([_, _, by_state]) = &mut output.tangents {
                by_state[(0, 0)] *= 1.1;
            }
            Ok(())
        }),
        gives_tangents: true,
    };
    model.bind_controller(force, wrong).unwrap();
    let check = check_tangents(&model, force, 2.0).unwrap();
    assert!(
        (check.given / check.differenced - 1.1).abs() < 1e-6,
        "{check:?}"
    );
    assert!(check.error > 1e-2, "{check:?}");
    model.bind_controller(force, pid(1.0, false)).unwrap();
    let error = check_tangents(&model, force, 2.0).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotAvailable);
    assert_eq!(model.require_controller(force).unwrap().inputs, [at]);
}

#[test]
fn a_loaded_model_is_solved_again_once_its_function_is_bound() {
    let (mut model, at, force) = controlled(1.0, true);
    model.add_actuator(at, &cosine(0.9)).unwrap();
    model
        .set_label(ObjectKind::Force, force, "governor")
        .unwrap();
    let solution = solve(&model, 3.0, 9);
    let times = times(3.0, 12);
    let found = |solution: &Solution| solution.joint(at.joint, SLIDE, &times).unwrap();
    let path = std::env::temp_dir().join(format!("periodyn-controller-{}", std::process::id()));
    model.save(&path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    // Readers of the version before do not know of controllers.
    assert_eq!(bytes[8..12], 3u32.to_le_bytes());
    let mut loaded = Model::load(&path).unwrap();
    solution.save(&path).unwrap();
    let saved = Solution::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert_eq!(found(&saved), found(&solution));
    let state = control(force, ForceQuantity::ControlState(0));
    let states = [&saved, &solution].map(|x| x.sample(state, &times).unwrap());
    assert_eq!(states[0], states[1]);

    let error = try_solve(&loaded, 3.0, 9).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Callback);
    let force = loaded.find_label(ObjectKind::Force, "governor").unwrap();
    loaded.bind_controller(force, pid(1.0, true)).unwrap();
    assert_eq!(found(&solve(&loaded, 3.0, 9)), found(&solution));
}
