//! Rotors of like blades: solved by what is left of one blade, they move as in whole.

mod common;

use common::models::rotors::*;
use common::*;
use nalgebra::{Complex, Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::{Coordinate, JointKind};
use periodyn::error::ErrorKind;
use periodyn::model::{JointCoordinate, Model, Signal, SignalPart, SignalPlace, Target};
use periodyn::motion::Motion;
use periodyn::output::{NodeQuantity, Quantity, Solution};
use periodyn::quantity::Feature;
use periodyn::solve::*;
use std::sync::Arc;

/// Size of the rotors.
const LENGTH: f64 = 3.0;
/// Rounding of two ways of elimination, and what the last increment leaves.
const ROUNDING: f64 = 1e-10;

/// By factors on a given grid.
fn by_factors(points: usize) -> PeriodicOptions {
    PeriodicOptions {
        linear: LinearMethod::Direct,
        ..options(points)
    }
}

/// By iteration on a given grid.
fn by_iteration(points: usize) -> PeriodicOptions {
    PeriodicOptions {
        linear: LinearMethod::Iterative(Some(Preconditioner::BodyCirculant)),
        ..options(points)
    }
}

fn solve_by(model: &Model, period: f64, options: &PeriodicOptions) -> Solution {
    let solution = Solution::solve(model, period, options, &mut |_, _| true).unwrap();
    let report = solution.report();
    assert_eq!(solution.outcome(), Outcome::Converged, "{report}");
    solution
}

/// Largest difference of two motions.
fn difference(one: &Solution, other: &Solution) -> f64 {
    let (one, other) = (&one.details().state, &other.details().state);
    one.distance(other, LENGTH)
}

#[test]
fn rotors_made_at_random_move_as_in_whole() {
    let mut r = Random::of(&[20, 3]);
    for case in 0..8 {
        let kind = RotorKind {
            speed: r.between(2.0, 7.0),
            blade: r.decades(0.3, 10.0),
            tower: [r.decades(0.3, 10.0), r.decades(0.2, 1.0)],
            wind: r.between(-2.0, 2.0),
            ..RotorKind::new(r.pick(&[3, 5, 7]), 1, r.percent(50))
        };
        let rotor = bladed_rotor(&kind);
        let points = kind.blades * ((30 / kind.blades) | 1);
        let whole = solve_by(&rotor.model, rotor.period, &by_factors(points));
        let reduced = solve_by(&rotor.symmetric(), rotor.period, &by_factors(points));
        let iterated = solve_by(&rotor.symmetric(), rotor.period, &by_iteration(points));
        let products = &iterated.details().periodic().unwrap().iterative;
        let products = products.as_ref().unwrap().products.iter().max().unwrap();
        let off = [&reduced, &iterated].map(|one| difference(&whole, one));
        println!("{case}: {kind:?}: {off:?}, {products} products");
        assert!(off.iter().all(|off| *off < ROUNDING), "{case}: {off:?}");
        // A solve that fails takes hundreds.
        assert!(*products < 30, "{case}: {products}");
        // Constraint forces, too: those of other blades are carried to frames of their own.
        let forces = |solution: &Solution| {
            let state = &solution.details().state;
            let largest = state.multipliers.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            (state.multipliers.clone(), largest)
        };
        let ((whole, largest), (reduced, _)) = (forces(&whole), forces(&reduced));
        for (a, b) in whole.iter().zip(&reduced) {
            assert!((a - b).abs() < 1e-8 * largest, "{case}: {a} {b}");
        }
    }
}

#[test]
fn even_numbers_of_blades_move_as_in_whole() {
    let mut r = Random::of(&[20, 4]);
    for (case, blades) in [2, 4, 6, 4, 2, 4].into_iter().enumerate() {
        let kind = RotorKind {
            speed: r.between(2.0, 7.0),
            blade: r.decades(0.3, 10.0),
            tower: [r.decades(0.3, 10.0), r.decades(0.2, 1.0)],
            wind: r.between(-2.0, 2.0),
            ..RotorKind::new(blades, 1, r.percent(50))
        };
        let rotor = bladed_rotor(&kind);
        // As many harmonics as leave rounding.
        let points = 60;
        let whole = solve_by(&rotor.model, rotor.period, &by_factors(points + 1));
        let reduced = solve_by(&rotor.symmetric(), rotor.period, &by_factors(points));
        let iterated = solve_by(&rotor.symmetric(), rotor.period, &by_iteration(points));
        let products = &iterated.details().periodic().unwrap().iterative;
        let products = products.as_ref().unwrap().products.iter().max().unwrap();
        let off = difference(&reduced, &iterated);
        // At times that are no points of either grid.
        let tip = *rotor.blades[1].last().unwrap();
        let series = [&whole, &reduced].map(|solution| {
            let position = Quantity::Node(tip, NodeQuantity::Position);
            [0, 1, 2].map(|i| solution.series(position.component(i)).unwrap()[0].clone())
        });
        let apart = (0..7).map(|i| {
            let time = rotor.period * (0.013 + f64::from(i) / 7.0);
            let [a, b] = series
                .each_ref()
                .map(|all| all.each_ref().map(|x| x.value(time)));
            (Vector3::from(a) - Vector3::from(b)).norm() / LENGTH
        });
        let apart = apart.fold(0.0, f64::max);
        // Two blades alone shake their tower so that harmonics fall slowly.
        let errors = [&whole, &reduced].map(|s| s.diagnostics().error_estimate);
        let allowed = ROUNDING + errors[0] + errors[1];
        println!("{case}: {kind:?}: {apart:e} of {allowed:e}, {off:e}, {products} products");
        assert!(off < ROUNDING && apart < allowed, "{case}");
        assert!(*products < 30, "{case}: {products}");
    }
}

#[test]
fn convergence_is_quadratic() {
    let kind = RotorKind {
        wind: 3.0,
        blade: 0.3,
        ..RotorKind::new(3, 2, true)
    };
    let rotor = bladed_rotor(&kind);
    // From far off: blades without their bending.
    let at_rest = PeriodicOptions {
        guess: InitialGuess::By(Start::RigidRotation),
        ..by_factors(21)
    };
    let solution = solve_by(&rotor.symmetric(), rotor.period, &at_rest);
    let iterations = &solution.details().report.iterations;
    let increments: Vec<f64> = iterations.iter().map(|i| i.increment).collect();
    println!("{increments:?}");
    let quadratic = increments.windows(2).filter(|pair| {
        let [before, after] = [pair[0], pair[1]];
        before < 0.1 && after < 10.0 * before * before
    });
    assert!(quadratic.count() >= 2, "{increments:?}");
}

#[test]
fn six_blades_are_three_pairs_and_two_triples() {
    let rotor = bladed_rotor(&RotorKind {
        wind: 2.0,
        ..RotorKind::new(6, 1, true)
    });
    let in_groups = |count: usize| {
        let mut model = rotor.model.clone();
        let groups = rotor.blades.chunks(count).map(<[Vec<usize>]>::concat);
        let groups: Vec<Vec<usize>> = groups.collect();
        model
            .set_rotor_symmetry(&AXIS, &CENTRE, &[rotor.hub], &groups)
            .unwrap();
        model
    };
    let whole = solve_by(&rotor.model, rotor.period, &by_factors(21));
    for options in [by_factors(21), by_iteration(21)] {
        let reduced = solve_by(&in_groups(2), rotor.period, &options);
        assert!(difference(&whole, &reduced) < ROUNDING);
    }
    // Few points, of which all three say the same.
    let alone = solve_by(&in_groups(1), rotor.period, &by_factors(18));
    for count in [1, 2, 3] {
        for options in [by_factors(18), by_iteration(18)] {
            let other = solve_by(&in_groups(count), rotor.period, &options);
            assert!(difference(&alone, &other) < ROUNDING, "{count}");
        }
    }
}

#[test]
fn blades_may_act_on_each_other() {
    let mut rotor = bladed_rotor(&RotorKind::new(3, 1, true));
    let tips: Vec<usize> = rotor.blades.iter().map(|b| *b.last().unwrap()).collect();
    // Dampers from tip to tip, which iteration on one blade leaves to iteration on all.
    let matrix = Matrix6::from_diagonal(&Vector6::new(4.0, 4.0, 4.0, 0.1, 0.1, 0.1));
    for j in 0..3 {
        let (first, second) = (Some(tips[j]), Some(tips[(j + 1) % 3]));
        let frame = Motion::new(Matrix3::identity(), CENTRE);
        let damper = (rotor.model).add_viscous_damper(first, second, Some(&frame), &matrix);
        damper.unwrap();
    }
    let whole = solve_by(&rotor.model, rotor.period, &by_factors(21));
    for options in [by_factors(21), by_iteration(21)] {
        let other = solve_by(&rotor.symmetric(), rotor.period, &options);
        assert!(difference(&whole, &other) < ROUNDING);
    }
}

#[test]
fn blades_that_flap_much_are_iterated_on_as_one() {
    // Slow, light and in a strong wind: hinges turn by more than constraints may to be averaged.
    let kind = RotorKind {
        speed: 2.5,
        wind: -1.86,
        blade: 2.5,
        tower: [3.9, 0.24],
        length: 0.87,
        mass: 0.72,
        ..RotorKind::new(3, 2, true)
    };
    let rotor = bladed_rotor(&kind);
    let models = [rotor.model.clone(), rotor.symmetric()];
    let [whole, reduced] = models.map(|m| solve_by(&m, rotor.period, &by_iteration(33)));
    let state = &whole.details().state;
    let (hub, root) = (state.node(rotor.hub), state.node(rotor.blades[0][0]));
    let turn = |k: usize| hub[k].relative(&root[k]).rotation;
    let flap = (0..33).map(|k| (turn(0).transpose() * turn(k) - Matrix3::identity()).amax());
    let flap = flap.fold(0.0, f64::max);
    assert!(flap > 0.1, "{flap}");
    assert!(difference(&whole, &reduced) < ROUNDING);
    let [all, one] = [&whole, &reduced].map(|solution| {
        let record = &solution.details().periodic().unwrap().iterative;
        record.as_ref().unwrap().bytes as f64
    });
    println!("flap {flap}, bytes {all:e} {one:e}");
    // Three blades and what they stand on, against one and that.
    assert!(one < 0.6 * all, "{one} {all}");
}

#[test]
fn what_the_check_of_the_model_does_not_see_is_seen_in_the_solution() {
    // A force on one blade that vanishes at the nine times at which loads are compared.
    for options in [by_factors(33), by_iteration(33)] {
        let mut rotor = bladed_rotor(&RotorKind::new(3, 1, false));
        let even = solve_by(&rotor.symmetric(), rotor.period, &options);
        let mut sines = [0.0; 9];
        sines[8] = 20.0;
        let wave = Signal::harmonics(0.0, 0.0, &[0.0; 9], &sines).unwrap();
        let tip = *rotor.blades[1].last().unwrap();
        push(&mut rotor.model, tip, 0, wave);
        let whole = solve_by(&rotor.model, rotor.period, &options);
        let found = solve_by(&rotor.symmetric(), rotor.period, &options);
        let moved = difference(&even, &whole);
        println!("{moved:e} {:e}", difference(&whole, &found));
        assert!(moved > 1e-6, "{moved}");
        assert!(difference(&whole, &found) < ROUNDING);
    }
}

#[test]
fn adaptive_grids_are_multiples_of_the_blades() {
    for blades in [4, 5] {
        on_adaptive_grids(blades);
    }
}

fn on_adaptive_grids(blades: usize) {
    let rotor = bladed_rotor(&RotorKind::new(blades, 1, false));
    let adaptive = PeriodicOptions {
        linear: LinearMethod::Direct,
        ..PeriodicOptions::default()
    };
    let reduced = solve_by(&rotor.symmetric(), rotor.period, &adaptive);
    let tried = grids_tried(&reduced);
    println!("{tried:?}");
    assert!(tried.iter().all(|points| points % blades == 0), "{tried:?}");
    let points = reduced.grid().points();
    if points % 2 == 1 {
        let whole = solve_by(&rotor.model, rotor.period, &by_factors(points));
        assert!(difference(&whole, &reduced) < ROUNDING);
    }
    // By default, whatever solves.
    let default = solve_by(
        &rotor.symmetric(),
        rotor.period,
        &PeriodicOptions::default(),
    );
    assert!(difference(&default, &reduced) < ROUNDING);
}

#[test]
fn multipliers_are_those_of_the_whole() {
    let options = StabilityOptions {
        highest_frequency: Some(12.0),
        tolerance: 1e-9,
        ..StabilityOptions::default()
    };
    for (blades, hinged) in [
        (3, true),
        (5, true),
        (4, true),
        (4, false),
        (2, true),
        (3, false),
    ] {
        let rotor = bladed_rotor(&RotorKind::new(blades, 1, hinged));
        // Two blades alone shake their tower.
        let points = if blades == 2 { 60 } else { 12 * blades };
        let whole = solve_by(&rotor.model, rotor.period, &by_factors(points | 1));
        let points = points + blades % 2 * blades;
        let reduced = solve_by(&rotor.symmetric(), rotor.period, &by_factors(points));
        let [all, one] = [&whole, &reduced].map(|s| s.solve_stability(&options).unwrap());
        assert!(!all.multipliers.is_empty());
        assert_eq!(all.verdict, one.verdict);
        assert_eq!(one.steps % blades, 0, "{}", one.steps);
        let (mut most, mut count) = (0.0f64, 0);
        let slow = all.multipliers.iter().enumerate();
        for (i, mode) in slow.filter(|(_, m)| m.frequency < 12.0) {
            let others = one.multipliers.iter().enumerate();
            let distance = |other: &Multiplier| (other.value - mode.value).norm();
            let near = others.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
            let (j, other) = near.unwrap();
            most = most.max(distance(other));
            assert!((other.frequency - mode.frequency).abs() < 1e-3 * mode.frequency.max(1.0));
            // Where no other is near the mode is the same at the end of the period, too.
            let is_alone = |(k, m): (usize, &Multiplier)| {
                k == i || (m.value - mode.value).norm() > 1e-3 * mode.value.norm()
            };
            if !all.multipliers.iter().enumerate().all(is_alone) || mode.value.norm() < 1e-4 {
                continue;
            }
            let (mut product, mut sizes) = (Complex::<f64>::default(), [0.0; 2]);
            for node in 0..all.nodes() {
                let ends = [(&all, i), (&one, j)]
                    .map(|(stability, mode)| *stability.shape(mode, node).unwrap().last().unwrap());
                for (a, b) in ends[0].iter().zip(&ends[1]) {
                    product += a.conj() * b;
                    sizes[0] += a.norm_sqr();
                    sizes[1] += b.norm_sqr();
                }
            }
            let alike = product.norm() / (sizes[0] * sizes[1]).sqrt();
            assert!(alike > 1.0 - 1e-6, "{} {alike}", mode.value);
            count += 1;
        }
        println!(
            "{blades} {hinged}: {most:e}, {count} modes, {:?} {:?}",
            (all.time, all.steps),
            (one.time, one.steps)
        );
        assert!(most < 1e-9, "{most:e}");
        assert!(count > 2, "{count}");
    }
}

#[test]
fn multipliers_with_one_damper_out_are_those_of_the_whole() {
    // A rotor in its plane that nothing loads: it turns alike whatever its dampers are.
    let speed = 3.0;
    let mut model = Model::new();
    let hub = ball(&mut model, 3.0, 1.0, &Vector3::zeros());
    let frame = Motion::identity();
    let held = model.add_joint(JointKind::Planar, None, Some(hub), &frame, &frame);
    let held = held.unwrap();
    model.prescribe(rotation1(held), &steady(speed)).unwrap();
    for coordinate in [Coordinate::Displacement1, Coordinate::Displacement2] {
        let joint = held;
        spring(
            &mut model,
            JointCoordinate { joint, coordinate },
            900.0,
            4.0,
        );
    }
    let blades = [0, 1, 2].map(|k| {
        let angle = std::f64::consts::TAU * f64::from(k) / 3.0;
        let out = Vector3::new(angle.cos(), angle.sin(), 0.0);
        let blade = ball(&mut model, 2.0, 2.0, &(out * 1.3));
        let ends = [Some(hub), Some(blade)];
        let hinge = revolute(&mut model, ends[0], ends[1], &(out * 0.3), &Vector3::z());
        spring(&mut model, rotation1(hinge), 25.0, 0.6);
        vec![blade]
    });
    // The damper of the first blade.
    let damper = model.add_parameter("damper", 0.6, 0.6).unwrap();
    let target = Target::Damping(2, 1);
    model.move_by_parameter(damper, target, 1.0).unwrap();
    let mut symmetric = model.clone();
    symmetric
        .set_rotor_symmetry(&Vector3::z(), &Vector3::zeros(), &[hub], &blades)
        .unwrap();
    let options = BranchOptions {
        periodic: by_factors(15),
        range: [0.1, 0.6],
        downwards: true,
        stability: Some(StabilityOptions::default()),
        ..BranchOptions::default()
    };
    let period = std::f64::consts::TAU / speed;
    let ends = [&model, &symmetric].map(|model| {
        let free = Free::Parameter(damper);
        let branch = follow_branch(model, period, free, &options, &mut |_, _| true).unwrap();
        let last = branch.points.last().unwrap().clone();
        assert!((last.values[0] - 0.1).abs() < 1e-9, "{:?}", last.values);
        last.stability.unwrap()
    });
    println!("{ends:?}");
    assert!((ends[0].largest - ends[1].largest).abs() < 1e-8, "{ends:?}");
}

#[test]
fn what_parameters_tell_apart_is_solved_in_whole() {
    let rotor = bladed_rotor(&RotorKind::new(3, 1, false));
    let tip = *rotor.blades[0].last().unwrap();
    // A force on the tip of one blade, which begins at zero, and forces on all of them.
    let methods = [by_factors(21), by_iteration(21)];
    for (options, (force, blades)) in methods
        .iter()
        .flat_map(|o| [(25.0, 1), (-40.0, 3)].map(|case| (o, case)))
    {
        let (mut model, mut loaded) = (rotor.symmetric(), rotor.model.clone());
        let parameter = model.add_parameter("force", 0.0, 10.0).unwrap();
        for (j, blade) in rotor.blades[..blades].iter().enumerate() {
            let at = *blade.last().unwrap();
            push(&mut model, at, 0, Signal::constant(0.0).unwrap());
            push(&mut loaded, at, 0, Signal::constant(force).unwrap());
            // After the one that each blade has.
            let place = SignalPlace::Load(rotor.blades.len() + j, 0);
            let target = Target::Signal(place, SignalPart::Mean);
            model.move_by_parameter(parameter, target, 1.0).unwrap();
        }
        let whole = solve_by(&loaded, rotor.period, &by_factors(21));
        let output = Quantity::Node(tip, NodeQuantity::Position).component(0);
        let wanted = whole.series(output).unwrap()[0].mean;
        let condition: Arc<dyn Condition> = Arc::new(OutputIs {
            output,
            feature: Feature::Mean,
            value: wanted,
            scale: None,
        });
        let free = [Free::Parameter(parameter)];
        let found = solve_for(&model, rotor.period, &free, &[condition], options);
        let value = found.model().parameters()[parameter].value;
        println!("{force}: {value}, {:e}", difference(&whole, &found));
        assert!(
            (value - force).abs() < 1e-7 * force.abs(),
            "{value} of {force}"
        );
        assert!(difference(&whole, &found) < ROUNDING);
    }
}

#[test]
fn what_is_not_alike_is_refused() {
    let rotor = || bladed_rotor(&RotorKind::new(3, 1, false));
    let refuse = |model: &Model, period: f64, expected: &str| {
        let options = by_factors(21);
        let error = Solution::solve(model, period, &options, &mut |_, _| true);
        let error = error.err().unwrap();
        println!("{error}");
        assert_eq!(error.kind(), ErrorKind::Model, "{error}");
        assert!(error.to_string().contains(expected), "{error}");
    };
    let at_tip = |rotor: &BladedRotor, blade: usize| *rotor.blades[blade].last().unwrap();

    // A mass on one tip, a load on one, a spring between two.
    let mut one = rotor();
    let (node, inertia) = (at_tip(&one, 1), Matrix3::identity() * 1e-4);
    one.model
        .add_mass(node, 0.01, &Vector3::zeros(), &inertia)
        .unwrap();
    refuse(&one.symmetric(), one.period, "inertia");
    let mut one = rotor();
    let node = at_tip(&one, 2);
    push(&mut one.model, node, 1, Signal::constant(1e-3).unwrap());
    refuse(&one.symmetric(), one.period, "load");
    let mut one = rotor();
    let ends = [Some(at_tip(&one, 0)), Some(at_tip(&one, 1))];
    join(
        &mut one.model,
        JointKind::Spherical,
        ends,
        &Vector3::zeros(),
        &AXIS,
    );
    refuse(&one.symmetric(), one.period, "no like");
    // A hub that is heavier to one side; what is said to turn, and does not.
    let mut one = rotor();
    let unlike = Matrix3::from_diagonal(&Vector3::new(0.0, 0.1, 0.0));
    one.model
        .add_mass(one.hub, 0.0, &Vector3::zeros(), &unlike)
        .unwrap();
    refuse(&one.symmetric(), one.period, "inertia");
    // Blades the other way round, or the axis.
    let mut one = rotor();
    one.blades.swap(1, 2);
    refuse(&one.symmetric(), one.period, "follow each other");
    let one = rotor();
    let mut model = one.model.clone();
    let blades: Vec<_> = [0, 2, 1].map(|j| one.blades[j].clone()).to_vec();
    model
        .set_rotor_symmetry(&-AXIS, &CENTRE, &[one.hub], &blades)
        .unwrap();
    refuse(&model, one.period, "turns about the axis");
    // Blades without their hub.
    let mut model = one.model.clone();
    model
        .set_rotor_symmetry(&AXIS, &CENTRE, &[], &one.blades)
        .unwrap();
    refuse(&model, one.period, "joint");
}
