//! Periodic solves on grids whose points are closer together where the motion is sharp.

mod common;

use common::models::small::moving_models;
use common::*;
use periodyn::elements::Coordinate;
use periodyn::error::ErrorKind;
use periodyn::fourier::{SharpEvent, TimeGrid, TimeMap};
use periodyn::model::*;
use periodyn::output::{JointQuantity, NodeQuantity, Quantity, Solution};
use periodyn::quantity::{Feature, Peak};
use periodyn::solve::*;
use std::sync::{Arc, Mutex};

/// Events at a third of the period and at its end, mild ones.
fn events(period: f64) -> Vec<SharpEvent> {
    let event = |time: f64, width: f64, share: f64| SharpEvent {
        time: time * period,
        width: width * period,
        share,
    };
    vec![event(0.3, 0.06, 0.8), event(0.97, 0.1, 0.5)]
}

fn mapped(points: usize, period: f64) -> PeriodicOptions {
    PeriodicOptions {
        newton: NewtonOptions {
            tolerance: 1e-11,
            iteration_limit: 30,
        },
        time_map: TimeMapping::Events(events(period)),
        // By iteration it takes many products to so little.
        linear: LinearMethod::Direct,
        work_limit: 0.0,
        ..PeriodicOptions::with_grid_points(points)
    }
}

fn solved(model: &Model, period: f64, options: &PeriodicOptions) -> Solution {
    let solution = Solution::solve(model, period, options, &mut |_, _| true).unwrap();
    let report = solution.report();
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    solution
}

/// Largest difference of two lists, relative to the largest number.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let both = a.iter().zip(b);
    both.fold(0.0, |m: f64, (x, y)| m.max((x - y).abs())) / size
}

fn models() -> Vec<(Model, f64)> {
    let mut all = moving_models();
    all.push((double_pendulum().0, DOUBLE_PENDULUM_PERIOD));
    all.push((zener_pendulum().0, 1.7));
    all
}

#[test]
fn motions_velocities_and_accelerations_are_those_of_equispaced_grids() {
    for (i, (model, period)) in models().iter().enumerate() {
        let exact = solve(model, *period, 121);
        let times: Vec<f64> = (0..9).map(|k| 0.137 * period * f64::from(k)).collect();
        let mut errors = Vec::new();
        for points in [41, 75, 151] {
            let found = solved(model, *period, &mapped(points, *period));
            assert!(found.grid().times().zip(found.times()).all(|(a, b)| a == b));
            let of = |quantity: NodeQuantity| {
                (0..model.node_count()).fold(0.0, |most: f64, node| {
                    let [found, exact] =
                        [&found, &exact].map(|s| s.node(node, quantity, &times).unwrap());
                    let size = exact.iter().fold(1e-3, |m: f64, x| m.max(x.abs()));
                    let both = found.iter().zip(&exact);
                    most.max(both.fold(0.0, |m: f64, (x, y)| m.max((x - y).abs())) / size)
                })
            };
            errors.push([
                of(NodeQuantity::Position),
                of(NodeQuantity::RotationMatrix),
                of(NodeQuantity::Velocity),
                of(NodeQuantity::Acceleration),
            ]);
            let estimate = found.diagnostics().error_estimate;
            let error = errors[errors.len() - 1][0].max(errors[errors.len() - 1][1]);
            println!(
                "{i} {points}: {:?} estimate {estimate:.1e}",
                errors[errors.len() - 1]
            );
            // As on equispaced grids: an estimate, not a bound.
            assert!(
                error < 10.0 * estimate + 1e-10,
                "{i} {points}: {error:e} {estimate:e}"
            );
            assert!(estimate < 1e-2, "{estimate:e}");
        }
        // Both grids leave about rounding: 1e-14 times the squares of some hundred harmonics.
        let [position, rotation, velocity, acceleration] = errors[2];
        assert!(position < 1e-8 && rotation < 1e-8, "{i}: {:?}", errors[2]);
        assert!(
            velocity < 1e-7 && acceleration < 1e-5,
            "{i}: {:?}",
            errors[2]
        );
        // Spectral: the number of digits grows with that of points.
        assert!(errors[1][1] < 0.1 * errors[0][1] + 1e-9, "{i}: {errors:?}");
    }
}

#[test]
fn quantities_of_joints_harmonics_means_and_extremes_are_the_same() {
    let (model, elbow) = double_pendulum();
    let period = DOUBLE_PENDULUM_PERIOD;
    let exact = solve(&model, period, 151);
    let found = solved(&model, period, &mapped(151, period));
    let angle = Coordinate::Rotation1;
    let quantities = [
        JointQuantity::Coordinate(angle),
        JointQuantity::Rate(angle),
        JointQuantity::Acceleration(angle),
    ];
    let times: Vec<f64> = (0..17).map(|k| 0.113 * f64::from(k)).collect();
    for (order, of) in quantities.into_iter().enumerate() {
        let quantity = Quantity::Joint(elbow, of);
        let [a, b] = [&found, &exact].map(|s| s.sample(quantity, &times).unwrap());
        assert!(apart(&a, &b) < 1e-7, "{order}: {:e}", apart(&a, &b));
        let [a, b] = [&found, &exact].map(|s| s.series(quantity).unwrap().remove(0));
        for j in 0..20 {
            let size = 1e-8 * (j as f64 + 1.0).powi(order as i32) * 4f64.powi(order as i32);
            assert!(
                (a.cosines[j] - b.cosines[j]).abs() < size,
                "{order} cosine {j}"
            );
            assert!((a.sines[j] - b.sines[j]).abs() < size, "{order} sine {j}");
        }
        assert!((a.mean - b.mean).abs() < 1e-8);
        let [a, b] = [&found, &exact].map(|s| s.extremes(quantity).unwrap()[0]);
        let size = a.largest.abs().max(a.smallest.abs());
        assert!((a.largest - b.largest).abs() < 1e-7 * size, "{a:?} {b:?}");
        assert!((a.smallest - b.smallest).abs() < 1e-7 * size, "{a:?} {b:?}");
        assert!((a.time_of_largest - b.time_of_largest).abs() < 1e-5);
    }
    let report = found.report();
    assert!(
        report.contains("closer together about t = 0.51"),
        "{report}"
    );
}

#[test]
fn oversampled_equations_have_the_weight_of_time() {
    let (model, period) = (double_pendulum().0, DOUBLE_PENDULUM_PERIOD);
    let exact = solve(&model, period, 151);
    let times: Vec<f64> = (0..9).map(|k| 0.137 * period * f64::from(k)).collect();
    let node = model.node_count() - 1;
    let mut errors = Vec::new();
    for points in [41, 75] {
        let options = PeriodicOptions {
            oversampling: 2,
            ..mapped(points, period)
        };
        let found = solved(&model, period, &options);
        let [a, b] =
            [&found, &exact].map(|s| s.node(node, NodeQuantity::Position, &times).unwrap());
        errors.push(apart(&a, &b));
    }
    println!("{errors:?}");
    assert!(
        errors[1] < 1e-5 && errors[1] < 0.2 * errors[0],
        "{errors:?}"
    );
}

#[test]
fn all_solvers_of_linear_equations_find_the_same() {
    for (model, period) in moving_models() {
        let direct = solved(&model, period, &mapped(51, period));
        let methods = [
            LinearMethod::Direct,
            LinearMethod::Iterative(Some(Preconditioner::BodyCirculant)),
            LinearMethod::Iterative(Some(Preconditioner::TimeLocal)),
        ];
        for linear in methods {
            let options = PeriodicOptions {
                linear,
                work_limit: 0.0,
                ..mapped(51, period)
            };
            let found = solved(&model, period, &options);
            let states = [&direct, &found].map(|s| &s.details().state);
            assert!(states[0].distance(states[1], 1.0) < 1e-9, "{linear:?}");
        }
    }
}

#[test]
fn functions_are_called_at_the_times_of_the_points() {
    let (mut model, at) = mass_on_a_slide(1.0, &nalgebra::Vector3::x());
    spring(&mut model, at, 40.0, 1.0);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let times = seen.clone();
    let push = Signal::function(Arc::new(move |time: f64| {
        times.lock().unwrap().push(time);
        Ok((3.0 * time).sin().exp())
    }));
    model.add_actuator(at, &push).unwrap();
    let period = std::f64::consts::TAU / 3.0;
    let found = solved(&model, period, &mapped(31, period));
    let seen = seen.lock().unwrap();
    for time in found.times() {
        assert!(seen.contains(&time), "{time}");
    }
    assert!(seen.iter().all(|t| (0.0..=period).contains(t)));
}

#[test]
fn saved_solutions_keep_their_map_and_start_others_on_any_grid() {
    let (model, period) = moving_models().remove(0);
    let found = solved(&model, period, &mapped(75, period));
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("mapped.pdn");
    found.save(&path).unwrap();
    let again = Solution::load(&path).unwrap();
    let (a, b) = (again.grid().map().events(period), events(period));
    for (a, b) in a.iter().zip(&b) {
        assert!((a.time - b.time).abs() + (a.width - b.width).abs() < 1e-14);
        assert_eq!(a.share, b.share);
    }
    let times = [0.123, 0.4, 1.9];
    let node = model.node_count() - 1;
    let [a, b] = [&found, &again].map(|s| s.node(node, NodeQuantity::Velocity, &times).unwrap());
    assert!(apart(&a, &b) < 1e-12);
    // From this grid to an equispaced one and back: near solutions are a step away.
    let other = TimeMap::new(&events(period)[..1], period).unwrap();
    let uniform = TimeGrid::new(75, period).unwrap();
    let cases = [
        (uniform, TimeMapping::Equispaced),
        (
            uniform.mapped(other),
            TimeMapping::Events(events(period)[..1].to_vec()),
        ),
    ];
    for (grid, time_map) in cases {
        let options = PeriodicOptions {
            guess: InitialGuess::State(again.prolonged(grid).unwrap()),
            time_map,
            ..mapped(75, period)
        };
        let next = solved(&model, period, &options);
        assert_eq!(next.grid(), grid);
        assert!(
            next.details().report.iterations.len() <= 3,
            "{}",
            next.report()
        );
        let [a, b] = [&found, &next].map(|s| s.node(node, NodeQuantity::Position, &times).unwrap());
        // What 75 points leave.
        assert!(apart(&a, &b) < 1e-5, "{:e}", apart(&a, &b));
    }
}

#[test]
fn sensitivities_are_those_of_differences_and_multipliers_those_of_other_grids() {
    let (mut model, elbow) = double_pendulum();
    let period = DOUBLE_PENDULUM_PERIOD;
    let drive = model.add_parameter("drive", 3.0, 3.0).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(2), SignalPart::Amplitude);
    model.move_by_parameter(drive, target, 1.0).unwrap();
    let angle = Quantity::Joint(elbow, JointQuantity::Coordinate(Coordinate::Rotation1));
    let rate = Quantity::Joint(elbow, JointQuantity::Rate(Coordinate::Rotation1));
    let dependents = [
        Dependent::Feature(angle.into(), Feature::Cosine(1)),
        Dependent::Feature(rate.into(), Feature::Sine(2)),
        Dependent::Feature(angle.into(), Feature::At(0.4)),
        Dependent::Feature(rate.component(0), Feature::Mean),
        Dependent::Peak(angle.into(), Peak::Largest),
    ];
    let options = mapped(75, period);
    let solution = solved(&model, period, &options);
    let parameters = [Free::Parameter(drive), Free::Frequency];
    let found = solve_sensitivities(
        (&model, solution.details()),
        (&[], &[]),
        &dependents,
        &parameters,
        &SensitivityOptions::default(),
    )
    .unwrap();
    let value = |solution: &Solution, dependent: &Dependent| match dependent {
        Dependent::Feature(of, feature) => feature.of(&solution.series(*of).unwrap()[0]),
        Dependent::Peak(of, _) => solution.extremes(*of).unwrap()[0].largest,
        Dependent::Free(_) => panic!("not asked for"),
    };
    for (j, parameter) in parameters.iter().enumerate() {
        let h = 1e-3;
        let at = |step: f64| {
            let (mut model, mut period) = (model.clone(), period);
            match parameter {
                Free::Parameter(id) => model.set_parameter(*id, 3.0 + step).unwrap(),
                Free::Frequency => {
                    // Harmonics are those of any period.
                    period = 1.0 / (1.0 / period + step / std::f64::consts::TAU);
                }
            }
            // The same phases.
            let solution = solved(&model, period, &mapped(75, period));
            let all: Vec<f64> = dependents.iter().map(|d| value(&solution, d)).collect();
            all
        };
        let [a, b, c, d] = [at(h), at(-h), at(2.0 * h), at(-2.0 * h)];
        for i in 0..dependents.len() {
            let slope = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
            let error = (found.derivatives[(i, j)] - slope).abs();
            // Fourth-order differences.
            assert!(
                error < 1e-6 * (1.0 + slope.abs()),
                "{i} {j}: {slope} {error:e}"
            );
        }
    }

    let solution = solved(&model, period, &mapped(151, period));
    let equispaced = solve(&model, period, 151);
    let [a, b] = [&solution, &equispaced].map(|solution| {
        let options = StabilityOptions::default();
        solve_stability(solution.details(), &options).unwrap()
    });
    assert_eq!(a.multipliers.len(), b.multipliers.len());
    for (a, b) in a.multipliers.iter().zip(&b.multipliers) {
        assert!((a.value - b.value).norm() < 1e-6, "{} {}", a.value, b.value);
    }
    // Derivatives of the multipliers, too.
    let [a, b] = [(&solution, &a), (&equispaced, &b)].map(|(solution, stability)| {
        solve_multiplier_sensitivities(
            (&model, solution.details()),
            (&[], &[]),
            (stability, &[0]),
            &parameters,
            &SensitivityOptions::default(),
        )
        .unwrap()
    });
    for (a, b) in a.derivatives.iter().zip(b.derivatives.iter()) {
        // The period map of either takes steps of its own, which leave some 1e-5.
        assert!((a - b).norm() < 1e-4 * (1.0 + b.norm()), "{a} {b}");
    }
    // What takes an equispaced grid says so.
    let options = StabilityOptions {
        method: StabilityMethod::Grid,
        ..StabilityOptions::default()
    };
    let refused = solve_stability(solution.details(), &options).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::NotAvailable);
    assert!(refused.to_string().contains("equispaced"), "{refused}");
}

#[test]
fn motions_under_conditions_are_found_on_mapped_grids() {
    let (mut model, elbow) = double_pendulum();
    let period = DOUBLE_PENDULUM_PERIOD;
    let drive = model.add_parameter("drive", 3.0, 3.0).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(2), SignalPart::Amplitude);
    model.move_by_parameter(drive, target, 1.0).unwrap();
    let angle = Quantity::Joint(elbow, JointQuantity::Coordinate(Coordinate::Rotation1));
    let wanted = solve(&model, period, 151).series(angle).unwrap()[0].cosines[0] * 1.1;
    let condition = OutputIs {
        output: angle.into(),
        feature: Feature::Cosine(1),
        value: wanted,
        scale: None,
    };
    let conditions: [Arc<dyn Condition>; 1] = [Arc::new(condition)];
    let free = [Free::Parameter(drive)];
    let values = [mapped(151, period), options(151)].map(|options| {
        let found = solve_for(&model, period, &free, &conditions, &options);
        let reached = found.series(angle).unwrap()[0].cosines[0];
        assert!((reached - wanted).abs() < 1e-8, "{reached} {wanted}");
        found.model().parameters()[drive].value
    });
    // What 151 points leave of a wilder swing; 75 leave 4e-3.
    assert!((values[0] - values[1]).abs() < 1e-4, "{values:?}");
    assert!((values[0] - 3.0).abs() > 0.1);
}

#[test]
fn events_that_are_none_are_refused_by_name() {
    let (model, _) = double_pendulum();
    let mut bad = events(1.7);
    bad[1].width = -0.1;
    let options = PeriodicOptions {
        time_map: TimeMapping::Events(bad),
        ..options(21)
    };
    let refused = Solution::solve(&model, 1.7, &options, &mut |_, _| true).unwrap_err();
    assert!(refused.to_string().contains("events[1].width"), "{refused}");
    let parameter = Free::Frequency;
    let options = BranchOptions {
        periodic: mapped(21, 1.7),
        range: [3.0, 4.0],
        ..BranchOptions::default()
    };
    let refused = follow_branch(&model, 1.7, parameter, &options, &mut |_, _| true).unwrap_err();
    assert!(refused.to_string().contains("equispaced"), "{refused}");
}
