//! Free parameters under conditions: unknown periods, families of conservative systems, trim.

mod common;

use common::models::oscillators::*;
use common::models::small::one_blade;
use common::*;
use nalgebra::{Matrix3, Vector3};
use periodyn::collocation::{Collocation, GridState};
use periodyn::elements::{CoordinateLaw, Effort};
use periodyn::error::Result;
use periodyn::fourier::TimeGrid;
use periodyn::model::{JointCoordinate, Model, Signal, SignalPart, SignalPlace, Target};
use periodyn::motion::Motion;
use periodyn::output::{NodeQuantity, Solution};
use periodyn::quantity::{Feature, Quantity};
use periodyn::solve::{
    Condition, Energy, Free, InitialGuess, JointCoordinateIs, LinearMethod, OutputIs,
    PeriodicOptions, Phase, solve_conditioned,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Largest increments of the iterations with a matrix of their own.
fn increments(solution: &Solution) -> Vec<f64> {
    let iterations = &solution.details().report.iterations;
    iterations.iter().map(|i| i.increment).collect()
}

#[test]
fn limit_cycles_have_their_periods() {
    // By shooting with steps at rounding.
    for (mu, points, exact, error) in [
        (0.1, 31, 6.287_111_272_289, 2e-12),
        (1.0, 51, 6.663_286_859_323, 2e-12),
        (5.0, 301, 11.612_230_667_720, 5e-11),
    ] {
        let (model, _) = van_der_pol(mu);
        let mut last = None;
        for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
            if mu == 5.0 && linear != LinearMethod::Direct {
                continue;
            }
            let coarse = starting_at(
                options(points.min(61)),
                (&model, points.min(61), exact * 1.05),
                |t| displaced(2.0 * t.cos()),
            );
            let coarse = PeriodicOptions { linear, ..coarse };
            let phase: [Arc<dyn Condition>; 1] = [Arc::new(Phase)];
            let free = [Free::Frequency];
            let mut found = solve_for(&model, exact * 1.05, &free, &phase, &coarse);
            if points > 61 {
                let period = found.grid().period();
                let grid = TimeGrid::new(points, period).unwrap();
                let options = PeriodicOptions {
                    guess: InitialGuess::State(found.prolonged(grid).unwrap()),
                    linear,
                    ..options(points)
                };
                found = solve_for(&model, period, &free, &phase, &options);
            }
            let off = found.grid().period() - exact;
            println!(
                "mu {mu} {linear:?}: period off by {off:e}, {:?}",
                increments(&found)
            );
            assert!(off.abs() < error, "{off:e}");
            let state = found.details().state.clone();
            if let Some(last) = last.replace(state.clone()) {
                let distance = GridState::distance(&state, &last, 1.0);
                assert!(distance < 1e-10, "{distance:e}");
            }
        }
    }
}

#[test]
fn newton_is_quadratic_at_a_limit_cycle() {
    let (model, _) = van_der_pol(1.0);
    let options = starting_at(options(51), (&model, 51, 6.5), |t| displaced(2.0 * t.cos()));
    let found = solve_for(
        &model,
        6.5,
        &[Free::Frequency],
        &[Arc::new(Phase)],
        &options,
    );
    let all = increments(&found);
    println!("{all:?}");
    assert!(all.len() <= 6);
    for pair in all.windows(2).filter(|pair| pair[0] < 0.1) {
        assert!(pair[1] <= 3.0 * pair[0] * pair[0] + 1e-12, "{all:?}");
    }
}

/// A point mass on a rod of length 1, hanging from a hinge about y.
fn pendulum() -> (Model, JointCoordinate) {
    let centre = Vector3::new(0.0, 0.0, -1.0);
    let (mut model, hinge) = hinged_body(1.0, &centre, &Matrix3::zeros(), &Vector3::y());
    gravity(&mut model, [0.0, 0.0, -9.81]);
    (model, rotation1(hinge))
}

/// With a parameter that damps in proportion to mass, which free motions need none of.
fn unfolded_pendulum() -> (Model, JointCoordinate, usize) {
    let (mut model, at) = pendulum();
    let unfolding = model.add_parameter("unfolding", 0.0, 1.0).unwrap();
    model
        .move_by_parameter(unfolding, Target::MassDamping, 1.0)
        .unwrap();
    (model, at, unfolding)
}

fn swung(angle: f64) -> Motion {
    let turn = nalgebra::Rotation3::new(Vector3::y() * angle).into_inner();
    Motion::new(turn, turn * Vector3::new(0.0, 0.0, -1.0))
}

#[test]
fn a_pendulum_has_the_periods_of_its_amplitudes() {
    let (model, at, unfolding) = unfolded_pendulum();
    let free = [Free::Frequency, Free::Parameter(unfolding)];
    let mut before: Option<(Solution, f64)> = None;
    for (degrees, points, exact) in [
        (30.0, 41, 2.040_989_889_519),
        (60.0, 41, 2.152_874_666_881),
        (90.0, 81, 2.367_841_947_576),
        (120.0, 81, 2.754_089_828_888),
        (150.0, 161, 3.535_098_186_382),
    ] {
        let amplitude = f64::to_radians(degrees);
        let conditions: [Arc<dyn Condition>; 2] = [
            Arc::new(Phase),
            Arc::new(JointCoordinateIs {
                at,
                value: amplitude,
            }),
        ];
        let (period, options) = match &before {
            None => (
                2.0,
                starting_at(options(points), (&model, points, 2.0), |t| {
                    swung(amplitude * t.cos())
                }),
            ),
            Some((found, _)) => {
                let period = found.grid().period();
                let grid = TimeGrid::new(points, period).unwrap();
                let guess = InitialGuess::State(found.prolonged(grid).unwrap());
                (
                    period,
                    PeriodicOptions {
                        guess,
                        ..options(points)
                    },
                )
            }
        };
        let found = solve_for(&model, period, &free, &conditions, &options);
        let off = found.grid().period() - exact;
        let unfolding = found.model().parameters()[unfolding].value;
        println!(
            "{degrees}: {off:e}, unfolding {unfolding:e}, {:?}",
            increments(&found)
        );
        assert!(off.abs() < 2e-11 && unfolding.abs() < 1e-11);
        before = Some((found, amplitude));
    }
}

/// The pendulum where it also turns about the vertical, with this angular momentum about it: its
/// azimuth is eliminated, so that motions which repeat themselves but for a turn are periodic.
fn nutating_pendulum(momentum: f64) -> (Model, JointCoordinate, usize) {
    let (mut model, at, unfolding) = unfolded_pendulum();
    let square = momentum * momentum;
    let law = CoordinateLaw {
        function: Arc::new(move |state| {
            let (sine, cosine) = state.value.sin_cos();
            // Where it hangs, and is looked at before the solve, there is no such motion.
            if sine == 0.0 {
                return Ok(Effort::default());
            }
            let by_coordinate = square * (1.0 + 2.0 * cosine * cosine) / sine.powi(4);
            Ok(Effort {
                value: -square * cosine / sine.powi(3),
                by_coordinate,
                by_rate: 0.0,
            })
        }),
        gives_derivatives: true,
    };
    let force = model.add_coordinate_law(at, law).unwrap();
    model.declare_of_phase(force).unwrap();
    (model, at, unfolding)
}

#[test]
fn a_spherical_pendulum_has_the_period_of_its_nutation_and_its_net_rotation() {
    // Released at 45° with a horizontal speed of 1.5.
    let value = f64::to_radians(45.0);
    let momentum = 1.5 * value.sin();
    let (model, at, unfolding) = nutating_pendulum(momentum);
    let free = [Free::Frequency, Free::Parameter(unfolding)];
    let conditions: [Arc<dyn Condition>; 2] =
        [Arc::new(Phase), Arc::new(JointCoordinateIs { at, value })];
    let options = starting_at(options(61), (&model, 61, 1.05), |t| {
        swung(0.614 + (value - 0.614) * t.cos())
    });
    let found = solve_for(&model, 1.05, &free, &conditions, &options);
    let period = found.grid().period();
    // The azimuth turns with the momentum over the square of the distance from the vertical.
    let motions = found.details().state.node(0);
    let rates = motions.iter().map(|m| {
        let square = m.position.x.powi(2) + m.position.y.powi(2);
        momentum / square
    });
    let turn = rates.sum::<f64>() / motions.len() as f64 * period;
    let off = [period - 1.051_258_111_496_7, turn - 3.592_857_262_010_5];
    println!("period and net rotation off by {off:?}");
    assert!(off.iter().all(|off| off.abs() < 2e-12), "{off:?}");
    assert!(found.model().parameters()[unfolding].value.abs() < 1e-11);
}

#[test]
fn a_family_of_free_motions_is_the_same_by_iteration() {
    let (model, at, unfolding) = unfolded_pendulum();
    let free = [Free::Frequency, Free::Parameter(unfolding)];
    let value = f64::to_radians(60.0);
    let conditions: [Arc<dyn Condition>; 2] =
        [Arc::new(Phase), Arc::new(JointCoordinateIs { at, value })];
    let [direct, iterative] = [LinearMethod::Direct, LinearMethod::Iterative(None)].map(|linear| {
        let options = PeriodicOptions {
            linear,
            ..options(41)
        };
        let options = starting_at(options, (&model, 41, 2.1), |t| swung(value * t.cos()));
        solve_for(&model, 2.1, &free, &conditions, &options)
    });
    // Of a system that conserves energy J is singular twice.
    let distance = (direct.details().state).distance(&iterative.details().state, 1.0);
    let periods = [&direct, &iterative].map(|found| found.grid().period());
    println!("{distance:e}, {periods:?}");
    assert!(distance < 1e-8 && (periods[0] - periods[1]).abs() < 1e-8);
}

#[test]
fn it_has_them_at_given_energies_too() {
    let (mut model, at, unfolding) = unfolded_pendulum();
    let free = [Free::Frequency, Free::Parameter(unfolding)];
    for (degrees, exact) in [(30.0, 2.040_989_889_519), (60.0, 2.152_874_666_881)] {
        let amplitude = f64::to_radians(degrees);
        let value = -9.81 * amplitude.cos();
        let conditions: [Arc<dyn Condition>; 2] = [Arc::new(Phase), Arc::new(Energy { value })];
        let options = starting_at(options(41), (&model, 41, 2.0), |t| {
            swung(0.9 * amplitude * t.cos())
        });
        let found = solve_for(&model, 2.0, &free, &conditions, &options);
        let off = found.grid().period() - exact;
        let increments = increments(&found);
        println!("{degrees}: {off:e}, {increments:?}");
        assert!(off.abs() < 2e-11);
        for pair in increments.windows(2) {
            assert!(pair[1] <= pair[0] * pair[0] + 1e-11, "{increments:?}");
        }
    }
    // Of a user's law it is not known.
    let law = CoordinateLaw {
        function: Arc::new(|_| Ok(Effort::default())),
        gives_derivatives: true,
    };
    let force = model.add_coordinate_law(at, law).unwrap();
    model.declare_of_phase(force).unwrap();
    let conditions: [Arc<dyn Condition>; 2] = [Arc::new(Phase), Arc::new(Energy { value: -9.0 })];
    let options = starting_at(options(11), (&model, 11, 2.0), |t| swung(0.4 * t.cos()));
    let end = solve_conditioned(&model, 2.0, (&free, &conditions), &options, &mut |_, _| {
        true
    });
    let error = end.unwrap_err().to_string();
    assert!(
        error.contains("the energy: force 0 has no energy"),
        "{error}"
    );
}

/// The mean of the position of node 0 along x: a condition of the user.
#[derive(Debug)]
struct MeanIs(f64);

impl Condition for MeanIs {
    fn name(&self) -> String {
        "the mean of x".into()
    }

    fn scale(&self, _: &Collocation) -> f64 {
        1.0
    }

    fn value(&self, _: &Collocation, state: &GridState) -> Result<f64> {
        let sum: f64 = state.node(0).iter().map(|m| m.position.x).sum();
        Ok(sum / state.points() as f64 - self.0)
    }

    fn gradient(&self, equations: &Collocation, state: &GridState, row: &mut [f64]) -> Result<()> {
        for (k, motion) in state.node(0).iter().enumerate() {
            let place = equations.layout().motion(0, k).start;
            for i in 0..3 {
                row[place + i] += motion.rotation[(0, i)] / state.points() as f64;
            }
        }
        Ok(())
    }
}

/// With damping 0.2 and a torque `3 cos Ωt` and of an unknown mean.
fn trimmed_pendulum() -> (Model, usize) {
    let (mut model, at) = pendulum();
    spring(&mut model, at, 0.0, 0.2);
    // Towards growth of x.
    let torque = Signal::harmonics(0.0, 0.0, &[-3.0], &[0.0]).unwrap();
    let force = model.add_actuator(at, &torque).unwrap();
    let mean = model.add_parameter("torque", 0.0, 3.0).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(force), SignalPart::Mean);
    model.move_by_parameter(mean, target, -1.0).unwrap();
    (model, mean)
}

#[test]
fn a_pendulum_is_trimmed_to_a_mean() {
    let (model, torque) = trimmed_pendulum();
    let free = [Free::Parameter(torque)];
    let mut last: Option<f64> = None;
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let options = PeriodicOptions {
            linear,
            ..options(41)
        };
        let found = solve_for(&model, TAU / 4.5, &free, &[Arc::new(MeanIs(0.3))], &options);
        let value = found.model().parameters()[torque].value;
        println!(
            "{linear:?}: torque off by {:e}, {:?}",
            value - 2.943,
            increments(&found)
        );
        assert!((value - 2.943).abs() < 1e-11, "{value}");
        assert!(last.is_none_or(|last| (value - last).abs() < 1e-10));
        last = Some(value);
    }
}

#[test]
fn what_cannot_be_determined_is_named() {
    let try_it = |model: &Model, free: &[Free], conditions: &[Arc<dyn Condition>]| {
        let options = options(21);
        solve_conditioned(
            model,
            TAU / 4.5,
            (free, conditions),
            &options,
            &mut |_, _| true,
        )
    };
    let (mut model, torque) = trimmed_pendulum();
    let mean = || -> Arc<dyn Condition> { Arc::new(MeanIs(0.3)) };
    let refused = |model: &Model, free: &[Free], conditions: &[Arc<dyn Condition>], why: &str| {
        let error = try_it(model, free, conditions).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    };
    let one = Free::Parameter(torque);
    refused(&model, &[one], &[], "conditions: expected as many");
    refused(
        &model,
        &[one, one],
        &[mean(), mean()],
        "the parameter \"torque\" twice",
    );
    let idle = model.add_parameter("idle", 0.0, 1.0).unwrap();
    let idle = Free::Parameter(idle);
    refused(
        &model,
        &[idle],
        &[mean()],
        "the parameter \"idle\" moves nothing",
    );
    refused(&model, &[Free::Parameter(7)], &[mean()], "parameter id");

    // What moves something without effect, and the same condition twice.
    let other = model.add_parameter("amplitude", 1.0, 1.0).unwrap();
    let unloaded = Signal::constant(0.0).unwrap();
    let at = JointCoordinate {
        joint: 0,
        ..rotation1(0)
    };
    let force = model.add_actuator(at, &unloaded).unwrap();
    let target = Target::Signal(SignalPlace::Actuator(force), SignalPart::Amplitude);
    model.move_by_parameter(other, target, 1.0).unwrap();
    let other = Free::Parameter(other);
    let named = |free: &[Free], conditions: &[Arc<dyn Condition>], names: &[&str]| {
        let (_, solved) = try_it(&model, free, conditions).unwrap();
        let report = &solved.report;
        println!("{}", report.explanation);
        assert!(!report.outcome.is_solution());
        assert!(
            names.iter().all(|name| report.explanation.contains(name)),
            "{report:?}"
        );
    };
    named(&[other], &[mean()], &["\"amplitude\"", "the mean of x"]);
    named(
        &[one, other],
        &[mean(), mean()],
        &["\"amplitude\"", "the mean of x"],
    );
    // Beyond the length of the rod.
    named(
        &[one],
        &[Arc::new(MeanIs(1.3))],
        &["the mean of x is off by"],
    );
}

/// A hub that is driven is where it is, however stiff its blade.
#[test]
fn what_nothing_free_moves_is_named() {
    let (mut model, period) = one_blade(2);
    let stiffness = model.add_parameter("stiffness", 1.0, 1.0).unwrap();
    let target = Target::BeamStiffness(0);
    model.move_by_parameter(stiffness, target, 1.0).unwrap();
    let tip = model.node_count() - 1;
    let free = Solution::solve(&model, period, &options(15), &mut |_, _| true).unwrap();
    let position = Quantity::Node(tip, NodeQuantity::Position).component(1);
    let natural = 1.001 * free.series(position).unwrap()[0].mean;
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let at = |node: usize, value: f64| {
            let position = Quantity::Node(node, NodeQuantity::Position);
            let given = OutputIs {
                output: position.component(1),
                feature: Feature::Mean,
                value,
                scale: Some(1.0),
            };
            let options = PeriodicOptions {
                linear,
                ..options(15)
            };
            let given: [Arc<dyn Condition>; 1] = [Arc::new(given)];
            let lists = (&[Free::Parameter(stiffness)][..], &given[..]);
            let (_, solved) =
                solve_conditioned(&model, period, lists, &options, &mut |_, _| true).unwrap();
            solved.report
        };
        let why = at(0, 0.1).explanation;
        assert!(
            why.contains("the mean of node0.position.y does not respond"),
            "{why}"
        );
        assert!(why.contains("the parameter \"stiffness\""), "{why}");
        let moved = at(tip, natural);
        assert!(moved.outcome.is_solution(), "{}", moved.explanation);
    }
}

#[test]
fn what_has_a_frequency_of_its_own_is_refused_where_the_period_is_free() {
    let phase: [Arc<dyn Condition>; 1] = [Arc::new(Phase)];
    let free = [Free::Frequency];
    let refused = |model: &Model, why: &str| {
        let options = starting_at(options(11), (model, 11, TAU), |t| displaced(t.cos()));
        let given = (&free[..], &phase[..]);
        let end = solve_conditioned(model, TAU, given, &options, &mut |_, _| true);
        let error = end.unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    };
    let (mut model, at) = mass_on_a_slide(1.0, &Vector3::x());
    let still = PeriodicOptions::with_grid_points(11);
    let given = (&free[..], &phase[..]);
    spring(&mut model, at, 1.5, 0.1);
    let end = solve_conditioned(&model, TAU, given, &still, &mut |_, _| true);
    let error = end.unwrap_err().to_string();
    assert!(error.contains("stands still"), "{error}");

    let wave = Signal::function(Arc::new(|t: f64| Ok(t.cos())));
    let mut timed = model.clone();
    push(&mut timed, 0, 0, wave);
    refused(&timed, "the function of load 0 has a frequency of its own");
    let law = CoordinateLaw {
        function: Arc::new(|state| {
            Ok(Effort {
                value: state.value.powi(3),
                ..Effort::default()
            })
        }),
        gives_derivatives: false,
    };
    let mut timed = model.clone();
    timed.add_coordinate_law(at, law).unwrap();
    refused(&timed, "the function of force 1 has a frequency of its own");
}

#[test]
fn parameters_and_functions_of_the_phase_are_saved() {
    let (model, torque) = trimmed_pendulum();
    let free = [Free::Parameter(torque)];
    let found = solve_for(
        &model,
        TAU / 4.5,
        &free,
        &[Arc::new(MeanIs(0.3))],
        &options(21),
    );
    let path = std::env::temp_dir().join(format!("pdn_parameters_{}.pdn", std::process::id()));
    found.save(&path).unwrap();
    let loaded = Solution::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert_eq!(loaded.model().parameters(), found.model().parameters());
    // Its model has the torque that was found.
    let again = solve(loaded.model(), TAU / 4.5, 21);
    let distance = again.details().state.distance(&found.details().state, 1.0);
    assert!(distance < 1e-10, "{distance:e}");
}
