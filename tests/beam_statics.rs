//! Beams at rest: published results, and the equations of the rod integrated by shooting.

mod common;
#[path = "common/rod.rs"]
mod rod;

use common::*;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::LoadFrame;
use periodyn::error::Result;
use periodyn::model::*;
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{JointQuantity, NodeQuantity, ResolvedIn, Solution};
use rod::{Rod, RodState};
use std::f64::consts::{FRAC_PI_4, TAU};

fn diagonal(stiffness: [f64; 6]) -> SectionInput {
    SectionInput::diagonal(&stiffness, &[1.0, 0.1, 0.05, 0.05]).unwrap()
}

/// Equilibrium: a single point of the grid.
fn equilibrium(model: &Model) -> Solution {
    solve(model, 1.0, 1)
}

fn motion(solution: &Solution, node: usize) -> Motion {
    let at = |quantity| solution.node(node, quantity, &[0.0]).unwrap();
    Motion::new(
        Matrix3::from_column_slice(&at(NodeQuantity::RotationMatrix)),
        Vector3::from_column_slice(&at(NodeQuantity::Position)),
    )
}

fn constant(values: [f64; 6]) -> [Option<Signal>; 6] {
    values.map(|v| (v != 0.0).then(|| Signal::constant(v).unwrap()))
}

/// Reaction of a joint, `[force; moment]`, in the inertial frame.
fn reaction(solution: &Solution, joint: usize) -> Vector6<f64> {
    let quantity = JointQuantity::Reaction(ResolvedIn::Space);
    Vector6::from_column_slice(&solution.joint(joint, quantity, &[0.0]).unwrap())
}

#[test]
fn a_moment_rolls_a_cantilever_up_to_a_circle() {
    let (length, ei) = (10.0, 100.0);
    let section = diagonal([1e4, 5e3, 5e3, 80.0, ei, ei]);
    // 1.7e-7 and 5.6e-12 of a length of 10 were found by an independent program.
    for (nodes, limit) in [(12, 1e-7), (15, 1e-11)] {
        let mut model = Model::new();
        let end = Vector3::x() * length;
        let beam = model
            .add_straight_beam(
                &Vector3::zeros(),
                &end,
                &Vector3::y(),
                &section,
                1,
                nodes - 1,
            )
            .unwrap();
        clamp(&mut model, beam.first_node);
        let moment = constant([0.0, 0.0, 0.0, 0.0, 0.0, TAU * ei / length]);
        model
            .add_load(beam.last_node, LoadFrame::Follower, moment)
            .unwrap();
        let end = motion(&equilibrium(&model), beam.last_node);
        let miss = end.position.amax() / length;
        println!("{nodes} nodes: misses the closed circle by {miss:.1e} of its length");
        assert!(miss < limit, "{nodes}: {miss}");
        assert!((end.rotation - Matrix3::identity()).amax() < 100.0 * limit);
    }
}

/// A unit square of Young's modulus 1e7, without contraction.
const BEND_STIFFNESS: [f64; 6] = {
    let (youngs, shear) = (1e7, 0.5e7 * 5.0 / 6.0);
    let bending = youngs / 12.0;
    [youngs, shear, shear, bending, bending, bending]
};

/// Displacement of the tip of the 45° bend: radius 100 in the plane of axes 1 and 2, held where its
/// tangent is axis 1, loaded by 600 along axis 3.
fn bend(elements: usize, degree: usize) -> Vector3<f64> {
    let radius = 100.0;
    let section = diagonal(BEND_STIFFNESS);
    let on = |angle: f64| Vector3::new(angle.sin(), angle.cos() - 1.0, 0.0) * radius;
    let (middle, end) = (on(0.5 * FRAC_PI_4), on(FRAC_PI_4));
    let mut model = Model::new();
    let line = circular_arc(&Vector3::zeros(), &middle, &end, &Vector3::y()).unwrap();
    let beam = model
        .add_beam_along(line, &SectionStation::uniform(&section), elements, degree)
        .unwrap();
    clamp(&mut model, beam.first_node);
    let load = constant([0.0, 0.0, 600.0, 0.0, 0.0, 0.0]);
    model
        .add_load(beam.last_node, LoadFrame::Space, load)
        .unwrap();
    motion(&equilibrium(&model), beam.last_node).position - end
}

/// Of the exact arc, as elements of three different degrees agree on to all digits given.
const BEND: [f64; 3] = [-23.560581878, 13.604632402, 53.475477998];

#[test]
fn the_45_degree_bend_has_its_published_displacement() {
    let tips = [(1, 12), (2, 10), (3, 8)].map(|(elements, degree)| bend(elements, degree));
    println!(
        "45 degree bend: {:.10} {:.10} {:.10}",
        tips[0], tips[1], tips[2]
    );
    for tip in tips {
        // Bathe and Bolourchi's problem. Published displacements differ by 0.2, as coarse elements
        // do; by Crisfield the tip comes to (47.16, 15.68, 53.43), from (70.71, 29.29, 0).
        assert!(
            (tip - Vector3::new(-23.65, 13.72, 53.58)).amax() < 0.15,
            "{tip}"
        );
        assert!(
            (tip - Vector3::new(-23.55, 13.61, 53.43)).amax() < 0.05,
            "{tip}"
        );
        // Eight digits.
        assert!((tip - Vector3::from(BEND)).amax() < 2e-8, "{tip}");
    }
    let stiffness = Vector6::from(BEND_STIFFNESS);
    let rod = Rod {
        length: 100.0 * FRAC_PI_4,
        corners: &[0.0, 1.0],
        stiffness: &|_, _| Matrix6::from_diagonal(&stiffness),
        curvature: &|_, _| -Vector3::z() / 100.0,
        load: &|_, _| Vector6::zeros(),
        frame: LoadFrame::Space,
        end: Vector6::new(0.0, 0.0, 600.0, 0.0, 0.0, 0.0),
    };
    let end = Vector3::new(FRAC_PI_4.sin(), FRAC_PI_4.cos() - 1.0, 0.0) * 100.0;
    let exact = rod.equilibrium(8).position - end;
    println!("by shooting: {exact:.10}");
    assert!((exact - Vector3::from(BEND)).amax() < 1e-7, "{exact}");
}

#[test]
fn two_node_elements_are_of_second_order_and_degrees_gain_exponentially() {
    let exact = Vector3::from(BEND);
    let points: Vec<(f64, f64)> = [8usize, 16, 32, 64]
        .iter()
        .map(|&n| ((n as f64).ln(), (bend(n, 1) - exact).norm()))
        .collect();
    let (slope, correlation) = exponential_fit(&points);
    println!("two-node elements: {points:?}, order {:.3}", -slope);
    assert!(
        (-2.1..=-1.9).contains(&slope) && correlation < -0.999,
        "{slope}"
    );

    let points: Vec<(f64, f64)> = (2..=6)
        .map(|degree| (f64::from(degree), (bend(1, degree as usize) - exact).norm()))
        .collect();
    let (slope, correlation) = exponential_fit(&points);
    println!("one element of degree 2 to 6: {points:?}, slope {slope:.2}");
    // A degree more gains a factor of at least five.
    assert!(
        slope < -5f64.ln() && correlation < -0.97,
        "{slope} {correlation}"
    );
}

#[test]
fn the_princeton_beam_has_its_published_displacement() {
    let (youngs, poisson, torsion) = (71.7e9, 0.31, 3.103);
    let (length, width, thickness) = (0.508, 12.377e-3, 3.2024e-3);
    let area: f64 = width * thickness;
    let shear = youngs / (2.0 * (1.0 + poisson)) * area * 5.0 / 6.0;
    // Thin along axis 3.
    let bending = |along: f64, across: f64| youngs * across * along.powi(3) / 12.0;
    let section = diagonal([
        youngs * area,
        shear,
        shear,
        torsion,
        bending(thickness, width),
        bending(width, thickness),
    ]);
    let mut model = Model::new();
    let end = Vector3::x() * length;
    let beam = model
        .add_straight_beam(&Vector3::zeros(), &end, &Vector3::y(), &section, 2, 6)
        .unwrap();
    clamp(&mut model, beam.first_node);
    let part = 8.896 * FRAC_PI_4.cos();
    let load = constant([0.0, -part, part, 0.0, 0.0, 0.0]);
    model
        .add_load(beam.last_node, LoadFrame::Space, load)
        .unwrap();
    let tip = motion(&equilibrium(&model), beam.last_node).position - end;
    println!("Princeton beam: {tip}");
    let published = Vector3::new(-0.0143894, -0.0088890, 0.1090417);
    assert!((tip - published).amax() < 1e-5, "{tip}");
}

/// Full stiffness matrices, of sections that couple everything.
fn coupled(scale: f64) -> Matrix6<f64> {
    let diagonal = Vector6::new(900.0, 400.0, 300.0, 30.0, 50.0, 80.0) * scale;
    let root = Matrix6::from_diagonal(&diagonal.map(f64::sqrt));
    let couplings = Matrix6::from_fn(|i, j| 0.3 * ((3 * i + j) as f64).sin());
    let couplings = 0.25 * (couplings + couplings.transpose());
    root * (Matrix6::identity() + couplings) * root
}

/// A section of that stiffness.
fn section(stiffness: Matrix6<f64>) -> SectionInput {
    SectionInput {
        stiffness,
        ..diagonal([1.0; 6])
    }
}

fn compare(name: &str, found: &Motion, exact: &RodState, tolerance: f64) {
    let position = (found.position - exact.position).amax();
    let rotation = (found.rotation - exact.rotation).amax();
    println!(
        "{name}: tip {:?}, error {position:.1e}, rotation {rotation:.1e}",
        found.position
    );
    assert!(
        position < tolerance && rotation < tolerance,
        "{name}: {position:e} {rotation:e}"
    );
}

#[test]
fn a_tapered_and_twisted_beam_bends_as_the_equations_of_the_rod_say() {
    let length = 2.0;
    // Stiffness jumps at 0.4; its slope and that of the twist change there too.
    let matrices = [coupled(2.0), coupled(1.5), coupled(1.2), coupled(0.6)];
    let fractions = [0.0, 0.4, 0.4, 1.0];
    let twists = [0.2, 0.9, 0.9, 0.3];
    let stations: Vec<SectionStation> = (0..4)
        .map(|i| SectionStation {
            fraction: fractions[i],
            section: section(matrices[i]),
            twist: twists[i],
        })
        .collect();
    let end = Vector6::new(-9.0, 75.0, 90.0, 12.0, 0.0, 30.0);
    let mut model = Model::new();
    let zero = Vector3::zeros();
    let line = straight_line(&zero, &(Vector3::x() * length), &Vector3::y()).unwrap();
    let beam = model.add_beam_along(line, &stations, 3, 12).unwrap();
    assert_eq!(beam.elements, 3);
    clamp(&mut model, beam.first_node);
    model
        .add_load(beam.last_node, LoadFrame::Space, constant(end.into()))
        .unwrap();
    let solution = equilibrium(&model);

    let part = |middle: f64| if middle < 0.4 { 0 } else { 2 };
    let share = |at: f64, i: usize| (at - fractions[i]) / (fractions[i + 1] - fractions[i]);
    // In the axes of the first section.
    let first = rotation_from_vector(&(Vector3::x() * twists[0]));
    let turned = |v: Vector3<f64>| first.tr_mul(&v);
    let (force, moment) = (
        turned(end.fixed_rows::<3>(0).into_owned()),
        turned(end.fixed_rows::<3>(3).into_owned()),
    );
    let rod = Rod {
        length,
        corners: &[0.0, 0.4, 1.0],
        stiffness: &|at, middle| {
            let i = part(middle);
            matrices[i] + (matrices[i + 1] - matrices[i]) * share(at, i)
        },
        curvature: &|_, middle| {
            let i = part(middle);
            Vector3::x()
                * ((twists[i + 1] - twists[i]) / (fractions[i + 1] - fractions[i]) / length)
        },
        load: &|_, _| Vector6::zeros(),
        frame: LoadFrame::Space,
        end: Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z),
    };
    let mut exact = rod.equilibrium(8);
    exact.position = first * exact.position;
    exact.rotation = first * exact.rotation;
    assert!(exact.position.x < 0.8 * length, "a large displacement");
    compare(
        "tapered, twisted",
        &motion(&solution, beam.last_node),
        &exact,
        1e-8,
    );

    // Stress resultants, by the section of the place: less exact than displacements, most of all at
    // ends.
    let root = solution
        .beam(0, -1.0, periodyn::output::BeamQuantity::Force, &[0.0])
        .unwrap();
    let tip = motion(&solution, beam.last_node).position;
    let load = end.fixed_rows::<3>(0).into_owned();
    let about = turned(tip.cross(&load) + end.fixed_rows::<3>(3));
    let hold = turned(load);
    let held = Vector6::new(hold.x, hold.y, hold.z, about.x, about.y, about.z);
    let error = (Vector6::from_column_slice(&root) - held).amax() / held.amax();
    println!("stress resultants at the root: relative error {error:.1e}");
    assert!(error < 1e-5, "{root:?} {held}");
}

#[test]
fn distributed_loads_bend_an_arc_as_the_equations_of_the_rod_say() {
    let (radius, angle) = (2.0, 1.2);
    let length = radius * angle;
    let stiffness = coupled(1.0);
    let on = |x: f64| Vector3::new(x.sin(), 1.0 - x.cos(), 0.0) * radius;
    let given = Vector6::new(6.0, -27.0, 36.0, 4.5, -6.0, 7.5);
    let factors = [(0.0, 0.0), (0.3, 1.0), (0.6, 1.0), (0.6, 0.5), (1.0, -0.2)];
    let factor = |at: f64, middle: f64| {
        let i = factors.iter().rposition(|f| f.0 < middle).unwrap();
        let ((a, first), (b, second)) = (factors[i], factors[i + 1]);
        first + (second - first) * (at - a) / (b - a)
    };
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        let mut model = Model::new();
        let line = circular_arc(&on(0.0), &on(0.5 * angle), &on(angle), &Vector3::y()).unwrap();
        let uniform = SectionStation::uniform(&section(stiffness));
        // Boundaries at tenths: the load's corners are all among them.
        let beam = model.add_beam_along(line, &uniform, 10, 5).unwrap();
        let joint = clamp(&mut model, beam.first_node);
        model
            .add_distributed_load(DistributedLoadDefinition {
                first_element: beam.first_element,
                elements: beam.elements,
                frame: frame.into(),
                components: constant(given.into()),
                factors: factors.to_vec(),
            })
            .unwrap();
        let solution = equilibrium(&model);
        let rod = Rod {
            length,
            corners: &[0.0, 0.3, 0.6, 1.0],
            stiffness: &|_, _| stiffness,
            curvature: &|_, _| Vector3::z() / radius,
            load: &|at, middle| given * factor(at, middle),
            frame,
            end: Vector6::zeros(),
        };
        let exact = rod.equilibrium(8);
        assert!(
            (exact.position - on(angle)).norm() > 0.3 * length,
            "a large displacement"
        );
        compare(
            &format!("{frame:?} load"),
            &motion(&solution, beam.last_node),
            &exact,
            1e-8,
        );
        if frame == LoadFrame::Space {
            // The sum of a load of fixed directions is exact on any mesh: 0.15 + 0.3 + 0.06 of the
            // length.
            let sum = given.fixed_rows::<3>(0) * (0.51 * length);
            let held = reaction(&solution, joint);
            let error = (held.fixed_rows::<3>(0).abs() - sum.abs()).amax();
            assert!(error < 1e-10 * sum.amax(), "reaction off by {error:e}");
        }
    }
}

#[test]
fn a_load_has_its_whole_sum_also_where_elements_do_not_fit_its_corners() {
    let mut model = Model::new();
    let zero = Vector3::zeros();
    let soft = diagonal([900.0, 400.0, 300.0, 30.0, 50.0, 80.0]);
    let end = Vector3::x() * 3.0;
    let beam = model
        .add_straight_beam(&zero, &end, &Vector3::y(), &soft, 3, 2)
        .unwrap();
    let joint = clamp(&mut model, beam.first_node);
    model
        .add_distributed_load(DistributedLoadDefinition {
            first_element: beam.first_element + 1,
            elements: 2,
            frame: LoadFrame::Space.into(),
            components: constant([0.0, 5.0, 0.0, 0.0, 0.0, 0.0]),
            factors: vec![
                (0.0, 0.0),
                (0.17, 0.0),
                (0.17, 2.0),
                (0.63, 1.0),
                (1.0, 0.0),
            ],
        })
        .unwrap();
    let held = reaction(&equilibrium(&model), joint);
    // Trapezium and triangle, over a length of 2.
    let sum = 5.0 * 2.0 * (0.46 * 1.5 + 0.37 * 0.5);
    assert!((held[1].abs() - sum).abs() < 1e-10, "{held} {sum}");
    assert!(held[0].abs() + held[2].abs() < 1e-10);
}

/// A helix of 3/4 of a turn about axis 3.
fn helix(fraction: f64) -> Result<(Vector3<f64>, Vector3<f64>)> {
    let (sin, cos) = (0.75 * TAU * fraction).sin_cos();
    let position = Vector3::new(cos, sin, 1.2 * fraction);
    Ok((position, Vector3::new(cos, sin, 0.0)))
}

#[test]
fn the_support_of_a_curved_beam_carries_its_weight() {
    let mass = 3.0;
    let stiffness = [9e4, 4e4, 3e4, 300.0, 500.0, 800.0];
    let section = SectionInput::diagonal(&stiffness, &[mass, 0.1, 0.05, 0.05]).unwrap();
    let gravity = [2.0, -3.0, -9.81];
    let built = |weight: bool| {
        let mut model = Model::new();
        let uniform = SectionStation::uniform(&section);
        let beam = model
            .add_beam_along(smooth_curve(helix), &uniform, 3, 8)
            .unwrap();
        let joint = clamp(&mut model, beam.first_node);
        if weight {
            common::gravity(&mut model, gravity);
        } else {
            let [x, y, z] = gravity.map(|g| g * mass);
            model
                .add_distributed_load(DistributedLoadDefinition {
                    first_element: beam.first_element,
                    elements: beam.elements,
                    frame: LoadFrame::Space.into(),
                    components: constant([x, y, z, 0.0, 0.0, 0.0]),
                    factors: vec![],
                })
                .unwrap();
        }
        let solution = equilibrium(&model);
        let held = reaction(&solution, joint);
        let tip = motion(&solution, beam.last_node);
        (model.mass_and_moment().unwrap(), held, tip)
    };
    let ((total, moment), held, tip) = built(true);
    let turn: f64 = 0.75 * TAU;
    let length = turn.hypot(1.2);
    println!("mass {total:.12}, exact {:.12}", mass * length);
    assert!((total - mass * length).abs() < 1e-9 * total);
    let centre = Vector3::new(turn.sin() / turn, (1.0 - turn.cos()) / turn, 0.6);
    assert!((moment / total - centre).amax() < 1e-8);
    let weight = Vector3::from(gravity) * total;
    let force = held.fixed_rows::<3>(0).into_owned();
    let error = (force.abs() - weight.abs()).amax();
    assert!(error < 1e-11 * weight.amax(), "reaction off by {error:e}");

    // The same weight as a load along the line, whose work is done through the sections and not the
    // nodes.
    let (_, held_load, tip_load) = built(false);
    println!(
        "weight and load differ by {:.1e} at {:?}",
        (tip.position - tip_load.position).amax(),
        tip.position
    );
    assert!((tip.position - tip_load.position).amax() < 1e-8);
    assert!((held - held_load).amax() < 1e-8 * weight.amax());
}
