//! A plate that flaps through large angles: its periodic motion by direct and iterative solvers,
//! against marching in time, and against a beam where it is one.

mod models;

use models::parts::damped_section;
use models::shells::*;
use nalgebra::{Complex, Vector3};
use periodyn::model::{Model, PatchEdge};
use periodyn::output::{Modes, NodeQuantity, Solution};
use periodyn::solve::*;

const SWING: f64 = 0.6;

fn solve((model, period): &(Model, f64), points: usize, linear: LinearMethod) -> Solution {
    let mut options = PeriodicOptions {
        linear,
        ..PeriodicOptions::with_grid_points(points)
    };
    options.newton.tolerance = 1e-10;
    let solution = Solution::solve(model, *period, &options, &mut |_, _| true).unwrap();
    let report = solution.report();
    println!("{report}");
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    solution
}

/// Where a periodic motion begins.
fn start_of(solution: &Solution) -> StartState {
    let solved = solution.details();
    let at_start = |node: usize| &solved.states_of(node)[0];
    let nodes = solved.system.nodes();
    StartState {
        motions: (0..nodes).map(|n| at_start(n).motion).collect(),
        twists: (0..nodes).map(|n| at_start(n).twist).collect(),
        internal: None,
    }
}

#[test]
fn newton_converges_quadratically() {
    // Near the first natural frequency, so that steps with the last matrix are not good enough.
    let plate = (flapping_plate(SWING, [2, 1], 4).0, 0.8);
    let solution = solve(&plate, 21, LinearMethod::Direct);
    let iterations = &solution.details().report.iterations;
    println!("{iterations:#?}");
    assert!(iterations.iter().all(|i| i.step == 1.0));
    // The last increments: each at most the square of the one before, but for rounding.
    let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
    assert!(increments.len() >= 2);
    for pair in increments.windows(2).rev().take(2) {
        assert!(pair[1] <= pair[0] * pair[0] + 1e-11, "{increments:?}");
    }
}

#[test]
fn direct_and_iterative_solvers_find_the_same() {
    let plate = flapping_plate(SWING, [3, 2], 4);
    let direct = solve(&plate, 15, LinearMethod::Direct);
    let length = direct.details().system.scales().length;
    for linear in [
        LinearMethod::Automatic,
        LinearMethod::Iterative(Some(Preconditioner::BodyCirculant)),
    ] {
        let found = solve(&plate, 15, linear);
        let apart = found
            .details()
            .state
            .distance(&direct.details().state, length);
        assert!(apart < 1e-9, "{apart:e}");
        if linear == LinearMethod::Automatic {
            continue;
        }
        let record = found
            .details()
            .periodic()
            .unwrap()
            .iterative
            .as_ref()
            .unwrap();
        // 17 in the mean when this was written.
        assert!(
            record.products.iter().all(|&products| products <= 40),
            "{record:?}"
        );
    }
}

#[test]
fn a_march_goes_round_to_its_error() {
    let plate = flapping_plate(SWING, [2, 1], 3);
    // Estimated error 1e-9.
    let solution = solve(&plate, 35, LinearMethod::Direct);
    let start = start_of(&solution);
    let tip = plate.0.node_count() - 2;
    // Half a period, at whose end the plate is on its other side.
    let (half, times) = (0.5 * plate.1, [0.0, 0.5 * plate.1]);
    let places = solution.node(tip, NodeQuantity::Position, &times).unwrap();
    let place = |k: usize| Vector3::from_column_slice(&places[3 * k..3 * k + 3]);
    let moved = (place(1) - place(0)).norm();
    assert!(moved > 0.5, "{moved}");
    let miss = |steps: usize| {
        let options = MarchOptions {
            start: MarchStart::State(start.clone()),
            period: Some(plate.1),
            ..MarchOptions::with_step(half / steps as f64, MarchEnd::Duration(half))
        };
        let march = Solution::march(&plate.0, &options, &mut |_, _| true).unwrap();
        assert_eq!(march.outcome(), Outcome::Converged, "{}", march.report());
        let states = march.details().states_of(tip);
        states[states.len() - 1].motion.position - place(1)
    };
    let misses = [miss(100), miss(200)];
    // The march is of second order: without its h² next to nothing is left.
    let left = (misses[1] * 4.0 - misses[0]).norm() / 3.0;
    let [coarse, fine] = misses.map(|miss| miss.norm());
    println!("{coarse:e} {fine:e}, extrapolated {left:e}");
    assert!(
        fine < 2e-3 && left < 0.05 * fine,
        "{coarse:e} {fine:e} {left:e}"
    );
}

#[test]
fn a_strip_without_contraction_is_a_beam() {
    let ([length, width], points) = ([1.0, 0.1], 21);
    let [thickness, young, density, damping_time] = RUBBER;
    let tip_of = |(model, period): (Model, f64), node: usize| {
        let solution = solve(&(model, period), points, LinearMethod::Direct);
        let times: Vec<f64> = (0..8).map(|k| period * f64::from(k) / 8.0).collect();
        solution.node(node, NodeQuantity::Position, &times).unwrap()
    };
    let strip = |poisson: f64| {
        let (model, patch) = rubber_plate([length, width], poisson, &mesh([3, 1], [4, 3]));
        // On the middle line, as the beam's tip, but for its place across.
        let tip = patch.edge(PatchEdge::EndU)[1];
        tip_of(swung(model, &patch.edge(PatchEdge::StartU), SWING), tip)
    };
    let beam = {
        let (area, moment) = (width * thickness, width * thickness.powi(3) / 12.0);
        let (bending, shear) = (young * moment, 5.0 / 12.0 * young * area);
        // Torsion and bending in the plane do not take part.
        let stiffness = [young * area, shear, shear, bending, bending, 25.0 * bending];
        let inertia = density * moment;
        let mass = [density * area, inertia, inertia, inertia];
        let section = damped_section(&stiffness, &mass, damping_time);
        let mut model = Model::new();
        let (root, tip) = (Vector3::zeros(), Vector3::x() * length);
        let beam = model
            .add_straight_beam(&root, &tip, &Vector3::y(), &section, 3, 3)
            .unwrap();
        tip_of(swung(model, &[beam.first_node], SWING), beam.last_node)
    };
    let apart = |strip: &[f64]| {
        let pairs = strip.chunks(3).zip(beam.chunks(3));
        pairs
            .map(|(a, b)| (a[0] - b[0]).hypot(a[2] - b[2]))
            .fold(0.0, f64::max)
    };
    // With Poisson's ratio 0.3 bending curves the strip across, but for where it is clamped, whose
    // influence reaches its width. Measured: 5e-16 and 1.06e-2.
    let [beam_alike, plate] = [strip(0.0), strip(0.3)].map(|strip| apart(&strip));
    println!("{beam_alike:e} {plate:e}");
    assert!(beam_alike < 1e-12, "{beam_alike:e}");
    assert!(plate > 1e-3 && plate < 3e-2, "{plate:e}");
}

#[test]
fn the_slowest_multipliers_are_those_of_shooting() {
    let plate = flapping_plate(SWING, [1, 1], 3);
    let (model, period) = &plate;
    let solution = solve(&plate, 35, LinearMethod::Direct);
    let stability = solution
        .solve_stability(&StabilityOptions::default())
        .unwrap();
    assert_eq!(stability.outcome, Outcome::Converged);
    assert_eq!(stability.verdict, Verdict::Stable);
    let exact = stability.multipliers[0].value;
    assert!(exact.norm() > 0.5 && exact.im != 0.0, "{exact}");
    let nearest = |all: Vec<Complex<f64>>| {
        let distance = |z: &Complex<f64>| (z - exact).norm();
        let nearer = |a: &Complex<f64>, b: &Complex<f64>| distance(a).total_cmp(&distance(b));
        all.into_iter().min_by(nearer).unwrap()
    };
    let shot = |steps: usize| {
        let options = ShootingOptions {
            steps,
            start: MarchStart::State(start_of(&solution)),
            ..ShootingOptions::default()
        };
        let shot = Solution::solve_shooting(model, *period, &options, &mut |_, _| true).unwrap();
        assert_eq!(shot.outcome(), Outcome::Converged, "{}", shot.report());
        let Kind::Shooting { floquet, .. } = &shot.details().kind else {
            panic!("{}", shot.report());
        };
        let floquet = floquet.iter().map(|z| Complex::new(z[0], z[1]));
        nearest(floquet.collect()) - exact
    };
    let [coarse, fine] = [200, 400].map(shot);
    // Of second order: without its h² next to nothing is left.
    let left = ((fine * 4.0 - coarse) / 3.0).norm();
    let [coarse, fine] = [coarse, fine].map(|z| z.norm());

    // The swing changes them by far more than that: at rest they are others.
    let (still, _) = flapping_plate(0.0, [1, 1], 3);
    let modes = ModesOptions {
        count: 2,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&still, &modes, &mut |_, _| true).unwrap();
    let all = modes.modes().iter().flat_map(|mode| {
        let multiplier = (mode.eigenvalue * period).exp();
        [multiplier, multiplier.conj()]
    });
    let moved = (nearest(all.collect()) - exact).norm();
    println!("{exact:.8}: {coarse:.2e} {fine:.2e}, left {left:.2e}, moved {moved:.2e}");
    assert!(
        fine < 5e-3 && left < 0.05 * fine && moved > 50.0 * left,
        "{coarse:e} {fine:e} {left:e} {moved:e}"
    );
}
