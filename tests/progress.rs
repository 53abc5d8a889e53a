//! Whoever watches a solve is told of it within all that lasts, and may cancel it there; and the
//! times of the report add up.

mod common;

use common::models::linkages::hinged_blade;
use common::*;
use nalgebra::Vector3;
use periodyn::elements::Coordinate;
use periodyn::model::*;
use periodyn::output::{JointQuantity, Modes, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;
use std::sync::{Arc, Mutex};

/// All that is told, at any opportunity, until the call of this number, which cancels.
fn record(last: usize) -> (Watch, Arc<Mutex<Vec<Progress>>>) {
    let told = Arc::new(Mutex::new(Vec::new()));
    let kept = told.clone();
    let watch = Watch::with_interval(0.0, move |progress| {
        let mut told = kept.lock().unwrap();
        told.push(*progress);
        told.len() != last
    });
    (watch.unwrap(), told)
}

/// Cancels a solve at its calls, some thirty of them from the first to the last, and finds that no
/// other follows.
fn cancel_everywhere(solve: impl Fn(Watch) -> Outcome) -> Vec<Progress> {
    let (watch, told) = record(usize::MAX);
    assert_eq!(solve(watch), Outcome::Converged);
    let all = told.lock().unwrap().clone();
    let within = all.iter().filter(|p| !p.iterated).count();
    assert!(within > all.len() / 2, "{within} of {}", all.len());
    assert!(all.windows(2).all(|p| p[0].elapsed <= p[1].elapsed));
    for last in (1..all.len()).step_by(all.len() / 30 + 1) {
        let (watch, told) = record(last);
        assert_eq!(solve(watch), Outcome::Cancelled, "{last} of {}", all.len());
        assert_eq!(told.lock().unwrap().len(), last);
    }
    all
}

fn periodic(model: &Model, period: f64, options: &PeriodicOptions, watch: Watch) -> Solution {
    let options = PeriodicOptions {
        watch,
        ..options.clone()
    };
    Solution::solve(model, period, &options, &mut |_, _| true).unwrap()
}

#[test]
fn a_periodic_solve_is_cancelled_within_factors_iteration_and_estimates() {
    let mechanism = FourBar::default().build();
    let methods = [
        LinearMethod::Direct,
        LinearMethod::Iterative(Some(Preconditioner::BodyCirculant)),
    ];
    for linear in methods {
        let options = PeriodicOptions {
            linear,
            ..PeriodicOptions::with_grid_points(11)
        };
        let all = cancel_everywhere(|watch| {
            periodic(&mechanism.model, mechanism.period, &options, watch).outcome()
        });
        assert_eq!(all[0].stage, Stage::InitialGuess);
        assert!(all.iter().any(|p| p.stage == Stage::Newton && !p.iterated));
        assert!(all.iter().any(|p| p.attempt == 1));
        let named = all.iter().filter(|p| p.start == Some(Start::QuasiStatic));
        assert!(named.count() > all.len() / 2);
    }
}

#[test]
fn threads_leave_the_calls_to_the_one_that_asked() {
    let mechanism = FourBar::default().build();
    let caller = std::thread::current().id();
    for linear in [LinearMethod::Direct, LinearMethod::Iterative(None)] {
        let options = PeriodicOptions {
            linear,
            threads: 2,
            watch: Watch::with_interval(0.0, move |_| {
                assert_eq!(std::thread::current().id(), caller);
                true
            })
            .unwrap(),
            ..PeriodicOptions::with_grid_points(21)
        };
        let (model, period) = (&mechanism.model, mechanism.period);
        let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(solution.outcome(), Outcome::Converged);
    }
}

#[test]
fn each_grid_and_start_is_told() {
    let mechanism = FourBar::default().build();
    let options = PeriodicOptions {
        guess: InitialGuess::By(Start::March),
        ..PeriodicOptions::with_error_tolerance(1e-5)
    };
    let (watch, told) = record(usize::MAX);
    let solution = periodic(&mechanism.model, mechanism.period, &options, watch);
    assert_eq!(solution.outcome(), Outcome::Converged);
    let told = told.lock().unwrap();
    let mut grids: Vec<usize> = told.iter().map(|p| p.points).collect();
    grids.dedup();
    let tried: Vec<usize> = grids_tried(&solution);
    assert_eq!(&grids[grids.len() - tried.len()..], tried);
    let marched = told.iter().filter(|p| p.start == Some(Start::March));
    assert!(marched.count() > told.len() / 2);
}

#[test]
fn statics_modes_marches_and_shooting_are_cancelled_within() {
    let mechanism = FourBar {
        elements: 2,
        ..FourBar::default()
    };
    let mechanism = mechanism.build();
    let (model, period) = (&mechanism.model, mechanism.period);
    let statics = |watch| {
        let mut options = StaticOptions {
            watch,
            ..StaticOptions::default()
        };
        options.standstill.period = Some(period);
        options
    };
    cancel_everywhere(|watch| {
        let options = statics(watch);
        let solution = Solution::solve_static(model, &options, &mut |_, _| true);
        solution.unwrap().outcome()
    });
    let all = cancel_everywhere(|watch| {
        let options = ModesOptions {
            equilibrium: statics(watch),
            ..ModesOptions::default()
        };
        Modes::solve(model, &options, &mut |_, _| true)
            .unwrap()
            .outcome()
    });
    assert!(all.iter().any(|p| p.stage == Stage::Modes));
    let (model, _) = oscillator();
    let all = cancel_everywhere(|watch| {
        let options = MarchOptions {
            period: Some(1.3),
            watch,
            ..MarchOptions::with_step(0.013, MarchEnd::Duration(0.13))
        };
        let solution = Solution::march(&model, &options, &mut |_, _| true);
        solution.unwrap().outcome()
    });
    assert!(all.iter().all(|p| matches!(p.stage, Stage::March { .. })));
    cancel_everywhere(|watch| {
        let options = ShootingOptions {
            steps: 20,
            watch,
            ..ShootingOptions::default()
        };
        let solution = Solution::solve_shooting(&model, 1.3, &options, &mut |_, _| true);
        solution.unwrap().outcome()
    });
}

#[test]
fn times_of_the_parts_add_up_to_that_of_the_whole() {
    let mechanism = FourBar::default().build();
    for linear in [
        LinearMethod::Direct,
        LinearMethod::Iterative(Some(Preconditioner::BodyCirculant)),
    ] {
        let options = PeriodicOptions {
            linear,
            ..PeriodicOptions::with_error_tolerance(1e-8)
        };
        let (model, period) = (&mechanism.model, mechanism.period);
        let solution = Solution::solve(model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(solution.outcome(), Outcome::Converged);
        let solve = solution.details();
        let parts = solve.guess_time + solve.timings.sum();
        assert!(parts <= solve.total_time);
        // What is left are copies and sums of vectors, and line searches without their residuals.
        let share = parts.as_secs_f64() / solve.total_time.as_secs_f64();
        assert!(share > 0.8, "{share}: {}", solution.report());
        let of_grids: usize = solve
            .periodic()
            .unwrap()
            .grids
            .iter()
            .map(|grid| grid.iterations)
            .sum();
        assert!(solve.total_iterations >= of_grids);
        let t = solve.timings;
        match linear {
            LinearMethod::Direct => {
                assert!(t.preconditioner.is_zero() && t.interface.is_zero());
                assert!(!t.factorisation.is_zero());
            }
            _ => {
                assert!(t.factorisation.is_zero());
                assert!(!t.preconditioner.is_zero() && !t.interface.is_zero());
            }
        }
        assert!(!t.substitution.is_zero() && !t.estimates.is_zero());
    }
}

#[test]
fn a_march_takes_a_hinged_blade_along_with_its_hub() {
    // A lag hinge, which a hub that leaves the blade behind would open at once.
    let omega = 20.0;
    let period = TAU / omega;
    let series = Signal::harmonics(0.4, omega, &[], &[]).unwrap();
    let function = Signal::function(Arc::new(move |t| Ok(0.4 + omega * t)));
    for (turn, known) in [(series, true), (function, false)] {
        let (model, _, [_, lag]) = hinged_blade(&turn, &Vector3::z());
        let mut options = MarchOptions::with_step(period / 50.0, MarchEnd::Duration(period));
        options.period = known.then_some(period);
        let solution = Solution::march(&model, &options, &mut |_, _| true).unwrap();
        assert_eq!(solution.outcome(), Outcome::Converged);
        let angles = solution
            .joint(
                lag,
                JointQuantity::Coordinate(Coordinate::Rotation1),
                &times(period, 20),
            )
            .unwrap();
        // The blade stays where its centrifugal force holds it. Rates are differences over a
        // thousandth of a step; Newton leaves 1e-9.
        assert!(largest(angles.iter().copied()) < 1e-8, "{angles:?}");
    }
}

#[test]
fn an_equilibrium_in_steady_rotation_starts_the_periodic_motion() {
    let omega = 20.0;
    let period = TAU / omega;
    let turn = Signal::harmonics(0.4, omega, &[], &[]).unwrap();
    let (model, _, [_, lag]) = hinged_blade(&turn, &Vector3::z());
    let mut options = StaticOptions::default();
    options.standstill.angular_velocity = Vector3::z() * omega;
    options.standstill.period = Some(period);
    let still = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(still.outcome(), Outcome::Converged, "{}", still.report());
    for adaptive in [false, true] {
        let points = if adaptive { 33 } else { 9 };
        let grid = periodyn::fourier::TimeGrid::new(points, period).unwrap();
        let mut options = PeriodicOptions::with_grid_points(points);
        if adaptive {
            options.grid_points = GridPoints::Adaptive(Adaptation::default());
        }
        options.guess = InitialGuess::State(still.prolonged(grid).unwrap());
        let solution = Solution::solve(&model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(
            solution.outcome(),
            Outcome::Converged,
            "{}",
            solution.report()
        );
        // It is the periodic motion, but for its reactions.
        assert!(solution.details().report.iterations.len() <= 3);
        let angles = solution
            .joint(
                lag,
                JointQuantity::Coordinate(Coordinate::Rotation1),
                &times(period, 20),
            )
            .unwrap();
        assert!(largest(angles.iter().copied()) < 1e-8, "{angles:?}");
    }
}
