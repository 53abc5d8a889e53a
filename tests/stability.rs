//! Multipliers of periodic solutions: closed forms, and values of integration in minimal
//! coordinates at rounding.

mod common;

use common::models::oscillators::van_der_pol;
use common::*;
use nalgebra::{Complex, DMatrix, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame, NodeForceLaw};
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{JointQuantity, NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;
use std::sync::Arc;

type C64 = Complex<f64>;

fn analyse(solve: &Solved) -> Stability {
    analyse_to(1e-10, StabilityMethod::PeriodMap, solve)
}

fn analyse_to(tolerance: f64, method: StabilityMethod, solve: &Solved) -> Stability {
    let options = StabilityOptions {
        tolerance,
        method,
        ..StabilityOptions::default()
    };
    let stability = solve_stability(solve, &options).unwrap();
    print(&stability);
    stability
}

fn print(stability: &Stability) {
    println!(
        "{:?}, {:?} up to {:.1} in {} steps, {} of {}, {:?}",
        stability.outcome,
        stability.verdict,
        stability.frequency_limit,
        stability.steps,
        stability.multipliers.len(),
        stability.states,
        stability.time
    );
    for m in &stability.multipliers {
        println!(
            "  {:.13} {:+.13}i  size {:.9}  frequency {:.6}  error {:.1e} {}",
            m.value.re,
            m.value.im,
            m.value.norm(),
            m.frequency,
            m.error,
            if m.trivial { "trivial" } else { "" }
        );
    }
}

/// All multipliers are known and are these, to within `error`, and so their estimates say.
fn assert_multipliers(stability: &Stability, expected: &[C64], error: f64) {
    assert_eq!(stability.outcome, Outcome::Converged);
    assert_eq!(stability.frequency_limit, f64::INFINITY);
    assert_eq!(stability.states, expected.len());
    let mut left: Vec<&Multiplier> = stability.multipliers.iter().collect();
    assert_eq!(left.len(), expected.len());
    for value in expected {
        let distance = |m: &Multiplier| (m.value - value).norm();
        let nearest = (0..left.len())
            .min_by(|&a, &b| distance(left[a]).total_cmp(&distance(left[b])))
            .unwrap();
        let found = left.remove(nearest);
        println!(
            "{value}: off by {:.1e}, estimate {:.1e}",
            distance(found),
            found.error
        );
        assert!(distance(found) < error, "{value}: {}", found.value);
    }
}

fn pair(re: f64, im: f64) -> [C64; 2] {
    [C64::new(re, im), C64::new(re, -im)]
}

/// A pendulum about y that hangs down from the origin or `support`, `r` of its mass times its
/// length and `j` its moment of inertia about the hinge; and the hinge.
fn hang(model: &mut Model, support: Option<usize>, at: Vector3<f64>, r: f64, j: f64) -> [usize; 2] {
    // As a mass on a massless rod, but with half of the moment of inertia in the body.
    let (mass, length) = (2.0 * r * r / j, j / (2.0 * r));
    let centre = at - Vector3::z() * length;
    let body = ball(model, mass, j / 2.0, &centre);
    let hinge = revolute(model, support, Some(body), &at, &Vector3::y());
    [body, hinge]
}

#[test]
fn an_oscillator_has_its_closed_form() {
    let (model, _) = oscillator();
    let [m, k, c, _] = OSCILLATOR;
    let period = TAU / 3.0;
    let s = C64::new(-c / (2.0 * m), (k / m - (c / (2.0 * m)).powi(2)).sqrt());
    let stability = analyse(solve(&model, period, 5).details());
    let rho = (s * period).exp();
    assert_multipliers(&stability, &[rho, rho.conj()], 1e-12);
    assert_eq!(stability.verdict, Verdict::Stable);
    let first = &stability.multipliers[0];
    let exponent = C64::new(first.exponent.re, first.exponent.im.abs());
    assert!((exponent - s).norm() < 1e-10, "{exponent}");
    assert!((first.frequency - s.im).abs() < 1e-3);
}

#[test]
fn a_shaken_pendulum_grows_within_the_tongue() {
    let mut model = Model::new();
    let support = ball(&mut model, 1.0, 1.0, &Vector3::zeros());
    let origin = Vector3::zeros();
    let slide = [None, Some(support)];
    let joint = join(
        &mut model,
        JointKind::Prismatic,
        slide,
        &origin,
        &Vector3::z(),
    );
    let coordinate = Coordinate::Displacement1;
    let shaken = JointCoordinate { joint, coordinate };
    model.prescribe(shaken, &cosine(0.2)).unwrap();
    let [_, hinge] = hang(&mut model, Some(support), origin, 1.0, 1.0);
    spring(&mut model, rotation1(hinge), 0.0, 0.05);
    gravity(&mut model, [0.0, 0.0, -1.0]);
    let stability = analyse(solve(&model, TAU / 2.0, 15).details());
    let expected = [-1.71366905359, -0.49871706405].map(C64::from);
    assert_multipliers(&stability, &expected, 1e-11);
    assert_eq!(stability.verdict, Verdict::Unstable);
}

#[test]
fn a_double_pendulum_has_a_close_pair() {
    let mut model = Model::new();
    // Masses 1 and 0.5 on massless rods: the lower as one of 1 with a moment of inertia of its own,
    // which the upper makes up for.
    let [upper, shoulder] = hang(&mut model, None, Vector3::zeros(), 0.5, 0.5);
    let elbow = -Vector3::z();
    let [_, elbow] = hang(&mut model, Some(upper), elbow, 0.5, 0.5);
    for joint in [shoulder, elbow] {
        spring(&mut model, rotation1(joint), 0.0, 0.1);
    }
    model
        .add_actuator(rotation1(shoulder), &cosine(4.0))
        .unwrap();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let solution = solve(&model, TAU / 5.0, 41);
    let angle = JointQuantity::Coordinate(Coordinate::Rotation1);
    let at = |joint: usize, times: &[f64]| solution.joint(joint, angle, times).unwrap();
    // Of the upper rod, and of the lower one, from the vertical.
    let angles = |times: &[f64]| {
        let (upper, bend) = (at(shoulder, times), at(elbow, times));
        let lower = upper.iter().zip(&bend).map(|(a, b)| a + b).collect();
        [upper, lower]
    };
    let at_start = angles(&[0.0]).map(|angles| angles[0]);
    println!("at the start {at_start:?}");
    let expected = [-0.370253884881, 0.457259066301];
    // What the grid leaves out.
    assert!(largest_difference(&at_start, &expected) < 1e-11);
    let most = angles(&times(TAU / 5.0, 401)).map(largest);
    assert!(
        largest_difference(&most, &[0.386, 0.498]) < 6e-4,
        "{most:?}"
    );
    let stability = analyse(solution.details());
    let mut expected = pair(-0.001179792816, 0.718076889344).to_vec();
    expected.extend(pair(-0.971344211321, 0.013370958555));
    assert_multipliers(&stability, &expected, 2e-11);
    assert_eq!(stability.verdict, Verdict::Stable);
}

#[test]
fn a_pendulum_on_a_slider_crank_has_redundant_constraints_and_a_nearly_defective_pair() {
    let mut model = Model::new();
    let (y, at) = (Vector3::y(), |x: f64| Vector3::new(x, 0.0, 0.0));
    let crank = ball(&mut model, 0.4, 0.1, &at(0.15));
    let rod = ball(&mut model, 0.7, 0.1, &at(0.8));
    let slider = ball(&mut model, 0.9, 0.1, &at(1.3));
    let shaft = revolute(&mut model, None, Some(crank), &at(0.0), &y);
    revolute(&mut model, Some(crank), Some(rod), &at(0.3), &y);
    revolute(&mut model, Some(rod), Some(slider), &at(1.3), &y);
    let slide = [None, Some(slider)];
    join(
        &mut model,
        JointKind::Prismatic,
        slide,
        &at(1.3),
        &Vector3::x(),
    );
    let period = TAU / 6.0;
    drive(&mut model, shaft, period);
    let [_, hinge] = hang(&mut model, Some(slider), at(1.3), 0.4, 0.32);
    spring(&mut model, rotation1(hinge), 0.0, 0.05);
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let solution = solve(&model, period, 41);
    assert!(solution.details().system.redundant_constraints() > 0);
    let angle = JointQuantity::Coordinate(Coordinate::Rotation1);
    // About the axis that points away, from which a positive angle is one backwards.
    let at_start = solution.joint(hinge, angle, &[0.0]).unwrap()[0];
    println!("at the start {at_start}");
    assert!((at_start - 0.552415495634).abs() < 1e-11);
    let stability = analyse(solution.details());
    assert_eq!(stability.multipliers.len(), 2);
    let [a, b] = [0, 1].map(|i| stability.multipliers[i].value);
    println!("sum {:e}", (a + b).re + 1.8428518487);
    println!(
        "product {:e}",
        (a * b).re - (-0.05_f64 * period / 0.32).exp()
    );
    assert!((a + b + 1.8428518487).norm() < 1e-10);
    assert!((a * b - (-0.05_f64 * period / 0.32).exp()).norm() < 1e-11);
    assert!((a * b - 0.8490606846953).norm() < 1e-11);
}

/// A body that moves in the plane x, y without turning, with forces by its position and velocity.
fn planar(law: impl Fn(&[f64; 2], &[f64; 2]) -> [f64; 2] + Send + Sync + 'static) -> Model {
    let mut model = Model::new();
    let body = ball(&mut model, 1.0, 1.0, &Vector3::zeros());
    let plane = [None, Some(body)];
    let origin = Vector3::zeros();
    let joint = join(&mut model, JointKind::Planar, plane, &origin, &Vector3::z());
    let still = Signal::constant(0.0).unwrap();
    model.prescribe(rotation1(joint), &still).unwrap();
    let function = NodeForceLaw {
        function: Arc::new(move |state, out| {
            let (x, v) = (state.positions[0], state.velocities[0]);
            let force = law(&[x[0], x[1]], &[v[0], v[1]]);
            out.forces[0][0] = force[0];
            out.forces[0][1] = force[1];
            Ok(())
        }),
        gives_tangents: false,
        frame: LoadFrame::Space,
    };
    model.add_node_forces(&[body], function).unwrap();
    push(&mut model, body, 0, cosine(0.01));
    model
}

#[test]
fn a_rotor_with_rotating_damping_whirls_above_its_critical_speed() {
    let (c, rotating, speed) = (0.05, 0.04, 2.5);
    let model = planar(move |x, v| {
        [
            -x[0] - c * v[0] - rotating * (v[0] + speed * x[1]),
            -x[1] - c * v[1] - rotating * (v[1] - speed * x[0]),
        ]
    });
    let period = TAU / speed;
    let stability = analyse(solve(&model, period, 3).details());
    let mut expected = Vec::new();
    for [re, im] in [
        [0.00498815880722, 1.00023687995441],
        [-0.09498815880722, 1.00023687995441],
    ] {
        let rho = (C64::new(re, im) * period).exp();
        expected.extend([rho, rho.conj()]);
    }
    // The model's forces are differenced.
    assert_multipliers(&stability, &expected, 1e-9);
    assert_eq!(stability.verdict, Verdict::Unstable);
}

/// A rotor of three blades in its plane, on a hub on springs, at this speed.
fn rotor_on_springs(speed: f64, weight: f64) -> Model {
    let mut model = Model::new();
    // Blades are masses of 1 on massless rods of 2: as masses of 2 with moments of inertia, which
    // the hub makes up for.
    let hub = ball(&mut model, 3.0, 1.0, &Vector3::zeros());
    let plane = [None, Some(hub)];
    let axis = Vector3::z();
    let frame = Motion::identity();
    let joint = model
        .add_joint(JointKind::Planar, plane[0], plane[1], &frame, &frame)
        .unwrap();
    model.prescribe(rotation1(joint), &steady(speed)).unwrap();
    let coordinates = [Coordinate::Displacement1, Coordinate::Displacement2];
    for (coordinate, [stiffness, damping]) in
        coordinates.into_iter().zip([[900.0, 4.0], [1300.0, 6.0]])
    {
        spring(
            &mut model,
            JointCoordinate { joint, coordinate },
            stiffness,
            damping,
        );
    }
    for k in 0..3 {
        let angle = TAU * f64::from(k) / 3.0;
        let out = Vector3::new(angle.cos(), angle.sin(), 0.0);
        let blade = ball(&mut model, 2.0, 2.0, &(out * 1.3));
        let hinge = revolute(&mut model, Some(hub), Some(blade), &(out * 0.3), &axis);
        let lag = rotation1(hinge);
        spring(&mut model, lag, 0.0, 0.6);
        model.add_coordinate_law(lag, sine_spring(25.0)).unwrap();
    }
    gravity(&mut model, [0.0, -weight, 0.0]);
    push(&mut model, hub, 1, Signal::constant(6.0 * weight).unwrap());
    model
}

/// Exponents of the same rotor without weight, by Coleman's coordinates: hub, collective and cyclic
/// lag, with constant coefficients.
fn coleman(speed: f64) -> Vec<C64> {
    let [x, y, mean, cosine, sine] = [0, 1, 2, 3, 4];
    let (inertia, static_moment, damper) = (4.0, 2.0, 0.6);
    let stiffness = 25.0 + static_moment * 0.3 * speed * speed;
    let [mut m, mut c, mut k] = [(); 3].map(|()| DMatrix::<f64>::zeros(5, 5));
    for (i, [damping, stiffness]) in [(x, [4.0, 900.0]), (y, [6.0, 1300.0])] {
        (m[(i, i)], c[(i, i)], k[(i, i)]) = (9.0, damping, stiffness);
    }
    for i in [mean, cosine, sine] {
        (m[(i, i)], c[(i, i)], k[(i, i)]) = (inertia, damper, stiffness);
    }
    for i in [cosine, sine] {
        k[(i, i)] -= inertia * speed * speed;
    }
    (c[(cosine, sine)], c[(sine, cosine)]) = (2.0 * inertia * speed, -2.0 * inertia * speed);
    (k[(cosine, sine)], k[(sine, cosine)]) = (damper * speed, -damper * speed);
    (m[(cosine, y)], m[(sine, x)]) = (static_moment, -static_moment);
    (m[(y, cosine)], m[(x, sine)]) = (1.5 * static_moment, -1.5 * static_moment);
    let inverse = m.try_inverse().unwrap();
    let mut first_order = DMatrix::zeros(10, 10);
    first_order.view_mut((0, 5), (5, 5)).fill_diagonal(1.0);
    first_order
        .view_mut((5, 0), (5, 5))
        .copy_from(&-(&inverse * k));
    first_order
        .view_mut((5, 5), (5, 5))
        .copy_from(&-(&inverse * c));
    first_order.complex_eigenvalues().iter().copied().collect()
}

#[test]
fn ground_resonance_is_at_the_speeds_of_coleman() {
    let mut verdicts = Vec::new();
    for speed in [3.0, 6.0, 8.0, 9.0, 10.0, 12.0, 16.0] {
        let model = rotor_on_springs(speed, 0.0);
        let exponents = coleman(speed);
        let growth = exponents
            .iter()
            .map(|s| s.re)
            .fold(f64::NEG_INFINITY, f64::max);
        let period = TAU / speed;
        let expected: Vec<C64> = exponents.iter().map(|s| (s * period).exp()).collect();
        let stability = analyse(solve(&model, period, 3).details());
        assert_multipliers(&stability, &expected, 1e-9);
        let verdict = if growth > 0.0 {
            Verdict::Unstable
        } else {
            Verdict::Stable
        };
        assert_eq!(stability.verdict, verdict, "{speed}");
        verdicts.push(verdict);
    }
    assert!(verdicts.contains(&Verdict::Stable) && verdicts.contains(&Verdict::Unstable));
}

#[test]
fn a_rotor_on_springs_has_ground_resonance() {
    let speed = 9.0;
    let model = rotor_on_springs(speed, 9.81);
    let period = TAU / speed;
    let solution = solve(&model, period, 33);
    let hub = solution.node(0, NodeQuantity::Position, &[0.0]).unwrap();
    println!("hub at the start {hub:?}");
    assert!(largest_difference(&hub[..2], &[0.001588509235, -0.022461450796]) < 1e-11);
    let stability = analyse(solution.details());
    let mut expected = Vec::new();
    for [re, im] in [
        [0.1023582061, 4.4770746319],
        [-0.0550912574, 8.1769043299],
        [-0.2730539834, 4.4959992252],
        [-0.2966142735, 11.4562525875],
        [-0.3994589975, 7.6743674740],
    ] {
        let rho = (C64::new(re, im) * period).exp();
        expected.extend([rho, rho.conj()]);
    }
    assert_multipliers(&stability, &expected, 1e-9);
    assert_eq!(stability.verdict, Verdict::Unstable);
}

#[test]
fn a_trimmed_pendulum_has_its_multipliers() {
    let mut model = Model::new();
    let [_, hinge] = hang(&mut model, None, Vector3::zeros(), 1.0, 1.0);
    spring(&mut model, rotation1(hinge), 0.0, 0.2);
    let torque = Signal::harmonics(2.943, 0.0, &[3.0], &[0.0]).unwrap();
    model.add_actuator(rotation1(hinge), &torque).unwrap();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let stability = analyse(solve(&model, TAU / 4.5, 41).details());
    assert_multipliers(&stability, &pair(-0.4102855093, 0.7668210779), 1e-10);
    assert_eq!(stability.verdict, Verdict::Stable);
}

#[test]
fn a_zener_pendulum_has_three_multipliers_as_shooting_has() {
    let (model, _, _) = zener_pendulum();
    let period = TAU / 3.0;
    let stability = analyse(solve(&model, period, 61).details());
    assert_eq!(stability.multipliers.len(), 3);
    assert_eq!(stability.frequency_limit, f64::INFINITY);
    assert_shooting(&stability, &model, period, 400);
}

/// Multipliers of shooting come nearer to these with the square of its steps.
fn assert_shooting(stability: &Stability, model: &Model, period: f64, steps: usize) {
    let errors = [steps, 2 * steps].map(|steps| {
        let options = ShootingOptions {
            steps,
            ..ShootingOptions::default()
        };
        let shot = Solution::solve_shooting(model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(shot.outcome(), Outcome::Converged, "{}", shot.report());
        let Kind::Shooting { floquet, .. } = &shot.details().kind else {
            panic!("{}", shot.report());
        };
        let found = floquet.iter().map(|z| C64::new(z[0], z[1]));
        let distance = |z: C64| {
            let all = stability.multipliers.iter().map(|m| (m.value - z).norm());
            all.fold(f64::INFINITY, f64::min)
        };
        found.map(distance).fold(0.0, f64::max)
    });
    let order = (errors[0] / errors[1]).log2();
    println!(
        "shooting: {:.2e}, {:.2e}, order {order:.3}",
        errors[0], errors[1]
    );
    assert!((1.8..2.2).contains(&order));
}

/// Below the frequency that both report, and 20 times that of the period, the period map and the
/// equations on the grid give the same multipliers.
fn assert_methods_agree(solution: &Solution) -> Stability {
    let solve = solution.details();
    let by_map = analyse_to(1e-8, StabilityMethod::PeriodMap, solve);
    let on_grid = analyse_to(1e-8, StabilityMethod::Grid, solve);
    let limit = by_map.frequency_limit.min(on_grid.frequency_limit);
    let least = 20.0 * solve.grid.frequency();
    assert!(limit >= 0.999 * least, "{limit} {least}");
    // Modes whose frequencies differ a little as the two count them are left out of one only.
    let below = |s: &Stability, limit: f64| -> Vec<C64> {
        let all = s.multipliers.iter().filter(|m| m.frequency < limit);
        all.map(|m| m.value).collect()
    };
    let mut compared = 0;
    for (some, others) in [(&by_map, &on_grid), (&on_grid, &by_map)] {
        let others = below(others, 1.2 * limit.min(1e9));
        for value in below(some, 0.9 * limit.min(1.1 * least)) {
            // What dies within the period is far from all shifts.
            if value.norm() < 0.05 {
                continue;
            }
            let distances = others.iter().map(|other| (other - value).norm());
            let distance = distances.fold(f64::INFINITY, f64::min);
            println!("{value:.10} off by {distance:.1e}");
            assert!(distance < 1e-8, "{value}: {distance:e}");
            compared += 1;
        }
    }
    assert!(compared >= 4, "{compared}");
    by_map
}

#[test]
fn a_forced_cantilever_is_the_same_by_both_methods_and_shooting() {
    let (model, period) = models::beams::forced_cantilever(1, 3);
    let stability = assert_methods_agree(&solve(&model, period, 31));
    assert_eq!(stability.verdict, Verdict::Stable);
    assert_largest_of_shooting(&stability, &model, period);
}

#[test]
fn a_rotor_blade_is_the_same_by_both_methods_and_shooting() {
    let (model, period) = models::beams::rotor_blade(1, 3);
    let stability = assert_methods_agree(&solve(&model, period, 31));
    assert_eq!(stability.verdict, Verdict::Stable);
    assert_largest_of_shooting(&stability, &model, period);
}

#[test]
fn a_slider_crank_with_a_flexible_rod_is_the_same_by_both_methods_and_shooting() {
    let period = TAU / 120.0;
    let model = models::beams::slider_crank(1, 2, period);
    let stability = assert_methods_agree(&solve(&model, period, 31));
    assert_largest_of_shooting(&stability, &model, period);
}

/// The largest multiplier of shooting comes nearer to one of these with the square of its steps.
fn assert_largest_of_shooting(stability: &Stability, model: &Model, period: f64) {
    let errors = [400, 800].map(|steps| {
        let options = ShootingOptions {
            steps,
            guess_periods: 3,
            ..ShootingOptions::default()
        };
        let shot = Solution::solve_shooting(model, period, &options, &mut |_, _| true).unwrap();
        assert_eq!(shot.outcome(), Outcome::Converged, "{}", shot.report());
        let Kind::Shooting { floquet, .. } = &shot.details().kind else {
            panic!("{}", shot.report());
        };
        let largest = stability.multipliers[0].value;
        let distances = floquet
            .iter()
            .map(|z| (C64::new(z[0], z[1]) - largest).norm());
        distances.fold(f64::INFINITY, f64::min)
    });
    println!("shooting: {:.2e}, {:.2e}", errors[0], errors[1]);
    let order = (errors[0] / errors[1]).log2();
    assert!((1.8..2.2).contains(&order), "{order}");
}

#[test]
fn rigid_mechanisms_are_the_same_by_both_methods() {
    let (model, period) = (double_pendulum().0, DOUBLE_PENDULUM_PERIOD);
    let solution = solve(&model, period, 41);
    let by_map = analyse_to(1e-10, StabilityMethod::PeriodMap, solution.details());
    let on_grid = analyse_to(1e-8, StabilityMethod::Grid, solution.details());
    // Half of them die within the period, far from all shifts.
    assert_eq!(
        (by_map.multipliers.len(), on_grid.multipliers.len()),
        (4, 2)
    );
    assert_eq!(
        (by_map.verdict, on_grid.verdict),
        (Verdict::Stable, Verdict::NotKnown)
    );
    for (a, b) in by_map.multipliers.iter().zip(&on_grid.multipliers) {
        assert!((a.value - b.value).norm() < 1e-9);
    }
}

#[test]
#[ignore = "measures processor time"]
fn multipliers_of_a_blade_cost_a_few_solves() {
    for (elements, degree) in [(4, 4), (16, 1), (16, 4)] {
        let (model, period) = models::beams::rotor_blade(elements, degree);
        let solution = solve(&model, period, 31);
        println!("{}", solution.report());
        let stability = solve_stability(solution.details(), &StabilityOptions::default()).unwrap();
        println!("{}", stability.report());
    }
}

/// Van der Pol's limit cycle, on so many points.
fn limit_cycle(mu: f64, guess: f64, points: usize) -> Solution {
    let (model, _) = van_der_pol(mu);
    let at = (&model, points, guess);
    let start = starting_at(options(points), at, |t| displaced(2.0 * t.sin()));
    solve_for(
        &model,
        guess,
        &[Free::Frequency],
        &[Arc::new(Phase)],
        &start,
    )
}

#[test]
fn limit_cycles_have_a_trivial_multiplier() {
    for (mu, period, points, rho) in [
        (0.1, 6.287111272289, 31, 0.5330692592),
        (1.0, 6.663286859323, 51, 8.59695063604e-4),
    ] {
        let solved = limit_cycle(mu, 6.5, points);
        assert!((solved.grid().period() - period).abs() < 1e-11);
        let stability = analyse(solved.details());
        assert_multipliers(&stability, &[C64::from(1.0), C64::from(rho)], 1e-10);
        assert!(stability.multipliers[0].trivial && !stability.multipliers[1].trivial);
        assert_eq!(stability.verdict, Verdict::Stable);
        assert!((stability.largest() - rho).abs() < 1e-10);
    }
}

#[test]
fn undamped_motions_are_not_called_stable() {
    let (mut model, at) = mass_on_a_slide(2.0, &Vector3::x());
    spring(&mut model, at, 50.0, 0.0);
    model.add_actuator(at, &cosine(1.0)).unwrap();
    let stability = analyse(solve(&model, TAU / 3.0, 5).details());
    let rho = C64::new(0.0, 5.0 * TAU / 3.0).exp();
    assert_multipliers(&stability, &[rho, rho.conj()], 1e-11);
    assert_eq!(stability.verdict, Verdict::NotKnown);
}

#[test]
fn what_cannot_be_analysed_is_refused() {
    let (model, _) = oscillator();
    let still = Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| true);
    let error = solve_stability(still.unwrap().details(), &StabilityOptions::default());
    assert_eq!(error.unwrap_err().kind(), ErrorKind::NotAvailable);
    let solution = solve(&model, TAU / 3.0, 5);
    for wrong in [0.0, -1.0, f64::NAN] {
        let tolerance = StabilityOptions {
            tolerance: wrong,
            ..StabilityOptions::default()
        };
        let frequency = StabilityOptions {
            highest_frequency: Some(wrong),
            ..StabilityOptions::default()
        };
        for (options, name) in [(tolerance, "tolerance"), (frequency, "highest_frequency")] {
            let error = solve_stability(solution.details(), &options).unwrap_err();
            assert!(error.to_string().contains(name), "{error}");
        }
    }
    let stability = analyse(solution.details());
    assert_eq!(
        stability.shape(2, 0).unwrap_err().kind(),
        ErrorKind::Identifier
    );
    assert_eq!(
        stability.shape(0, 1).unwrap_err().kind(),
        ErrorKind::Identifier
    );
    // Cancelled as soon as it is told.
    let watch = Watch::with_interval(0.0, |_| false).unwrap();
    let options = StabilityOptions {
        watch,
        ..StabilityOptions::default()
    };
    let cancelled = solve_stability(solution.details(), &options).unwrap();
    assert_eq!(cancelled.outcome, Outcome::Cancelled);
    assert_eq!(cancelled.verdict, Verdict::NotKnown);
    assert!(cancelled.multipliers.is_empty());
}
