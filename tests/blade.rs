//! A real blade, whose 49 stations lie anywhere between the nodes.

#[path = "common/blade.rs"]
mod blade;
mod common;

use common::*;
use nalgebra::Vector3;
use periodyn::elements::{BeamLoadFrame, JointKind};
use periodyn::model::*;
use periodyn::output::{JointQuantity, Modes, NodeQuantity, Quantity, ResolvedIn, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;

/// Mass and centre of sections that are linear between stations, exactly.
fn exact_mass(stations: &[SectionStation]) -> (f64, f64) {
    let (mut mass, mut moment) = (0.0, 0.0);
    for pair in stations.windows(2) {
        let (a, b) = (pair[0].fraction, pair[1].fraction);
        let (p, q) = (pair[0].section.mass[(0, 0)], pair[1].section.mass[(0, 0)]);
        let length = (b - a) * blade::LENGTH;
        mass += 0.5 * (p + q) * length;
        let arm = (a * (2.0 * p + q) + b * (p + 2.0 * q)) / 6.0 * blade::LENGTH;
        moment += arm * length;
    }
    (mass, moment / mass)
}

/// The first frequencies at rest, and the model.
fn frequencies(elements: usize, degree: usize) -> Vec<f64> {
    let mut model = Model::new();
    let ids = blade::add(&mut model, &blade::stations(true), elements, degree);
    clamp(&mut model, ids.first_node);
    let options = ModesOptions {
        count: 8,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    modes
        .modes()
        .iter()
        .map(|m| m.eigenvalue.im / TAU)
        .collect()
}

#[test]
fn its_mass_is_exact_on_any_mesh() {
    let stations = blade::stations(true);
    let (mass, centre) = exact_mass(&stations);
    for (elements, degree) in [(1, 5), (2, 5), (4, 4), (48, 3)] {
        let mut model = Model::new();
        blade::add(&mut model, &stations, elements, degree);
        let (found, moment) = model.mass_and_moment().unwrap();
        assert!(
            (found / mass - 1.0).abs() < 1e-12,
            "{elements} {degree}: {found} {mass}"
        );
        let off = (moment.z / found - centre).abs();
        assert!(off < 1e-12 * blade::LENGTH, "{elements} {degree}: {off:e}");
        assert!(moment.xy().norm() < 1e-9 * moment.z);
    }
}

#[test]
fn its_frequencies_on_four_elements_of_degree_four_are_those_of_a_fine_mesh() {
    // First flapwise and edgewise, second flapwise: of 48 elements of degree 3, whose sections were
    // those of their Gauss points.
    let fine = frequencies(48, 3);
    let coarse = frequencies(4, 4);
    println!("{fine:?}\n{coarse:?}");
    for (i, hertz) in [(0, 0.68576), (1, 1.08051), (2, 1.94643), (5, 5.572)] {
        assert!((fine[i] / hertz - 1.0).abs() < 1e-3, "{fine:?}");
        assert!((coarse[i] / hertz - 1.0).abs() < 3e-3, "{coarse:?}");
    }
    // No mode comes between that the fine mesh has not.
    for (fine, coarse) in fine.iter().zip(&coarse).take(7) {
        assert!((coarse / fine - 1.0).abs() < 1e-2, "{fine} {coarse}");
    }
    for (elements, degree) in [(1, 5), (2, 5), (6, 3), (8, 2)] {
        println!("{elements} {degree} {:?}", frequencies(elements, degree));
    }
}

/// The blade turning at 12.1 rpm in gravity, and the joint at its root; `places` of load for a unit
/// of length along its axes.
fn rotor(places: usize) -> (Model, BeamIds, usize) {
    let mut model = Model::new();
    let mut stations = blade::stations(true);
    for station in &mut stations {
        station.section.damp_by_component(&blade::DAMPING).unwrap();
    }
    let ids = blade::add(&mut model, &stations, 4, 4);
    let origin = Vector3::zeros();
    let hub = revolute(
        &mut model,
        None,
        Some(ids.first_node),
        &origin,
        &Vector3::x(),
    );
    let speed = steady(OMEGA);
    model.prescribe(rotation1(hub), &speed).unwrap();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    if places > 0 {
        // All components with a harmonic of the rotation at each place.
        let signal = || Signal::harmonics(200.0, 0.0, &[40.0], &[10.0]).unwrap();
        let loads: Vec<_> = (0..places)
            .map(|place| LoadPlace {
                fraction: place as f64 / (places - 1) as f64,
                components: std::array::from_fn(|_| Some(signal())),
            })
            .collect();
        let frame = BeamLoadFrame::Untwisted(Vector3::x());
        let loaded = model.add_load_at_places(ids.first_element, ids.elements, frame, &loads);
        loaded.unwrap();
    }
    (model, ids, hub)
}

const OMEGA: f64 = 12.1 * TAU / 60.0;

#[test]
fn its_root_bears_its_weight_as_it_turns() {
    let (model, ids, hub) = rotor(0);
    let solution = solve(&model, TAU / OMEGA, 11);
    let stations = blade::stations(true);
    let (mass, _) = exact_mass(&stations);
    let times = times(TAU / OMEGA, 9);
    let reaction = JointQuantity::Reaction(ResolvedIn::Space);
    let reaction = solution.joint(hub, reaction, &times).unwrap();
    let velocity = solution
        .node(ids.last_node, NodeQuantity::Velocity, &times)
        .unwrap();
    // The mean of the reaction is the weight: no motion of the mass has a mean acceleration.
    let series = solution
        .series(Quantity::Joint(
            hub,
            JointQuantity::Reaction(ResolvedIn::Space),
        ))
        .unwrap();
    assert!((series[2].mean / (mass * 9.81) - 1.0).abs() < 1e-9);
    assert!(series[0].mean.abs() < 1e-6 * mass && series[1].mean.abs() < 1e-6 * mass);
    assert!(reaction.len() == 54 && velocity.len() == 54);
}

/// A section that couples bending and torsion.
fn coupled() -> SectionInput {
    let stiffness = [9e6, 2e6, 2e6, 5e4, 8e4, 9e4];
    let mut section = SectionInput::diagonal(&stiffness, &[3.0, 0.02, 0.01, 0.01]).unwrap();
    for (i, j) in [(3, 4), (4, 3)] {
        section.stiffness[(i, j)] = 2.5e4;
    }
    section
}

#[test]
fn damping_by_component_is_taken_where_it_dissipates() {
    let mut section = coupled();
    let times = [1e-5, 1e-5, 1e-5, 2e-5, 1.4e-5, 2.2e-5];
    section.damp_by_component(&times).unwrap();
    assert!(section.damping[(3, 4)] != section.damping[(4, 3)]);
    assert_eq!(section.damping[(3, 4)], 2e-5 * 2.5e4);
    let mut model = Model::new();
    let end = Vector3::x() * 4.0;
    let beam = model
        .add_straight_beam(&Vector3::zeros(), &end, &Vector3::y(), &section, 3, 3)
        .unwrap();
    clamp(&mut model, beam.first_node);
    let options = ModesOptions {
        count: 6,
        ..ModesOptions::default()
    };
    let modes = Modes::solve(&model, &options, &mut |_, _| true).unwrap();
    for mode in modes.modes() {
        // Between the least and the largest time, halved, as all modes oscillate.
        let ratio = -mode.eigenvalue.re / mode.eigenvalue.norm_sqr();
        assert!((0.499e-5..1.101e-5).contains(&ratio), "{ratio:e}");
    }

    let mut section = coupled();
    // Torsion has no damping of its own, but is driven by that of bending.
    let error = section.damp_by_component(&[1e-3, 1e-3, 1e-3, 0.0, 1e-3, 1e-3]);
    let message = error.unwrap_err().to_string();
    assert!(message.contains("symmetric part"), "{message}");
    assert!(section.damp_by_component(&[-1e-3; 6]).is_err());
}

/// Force and moment on the root of a curved, twisted cantilever with this load.
fn borne(load: impl FnOnce(&mut Model, &BeamIds)) -> Vec<f64> {
    let mut model = Model::new();
    let on = |x: f64| Vector3::new(x.sin(), 0.0, 1.0 - x.cos()) * 4.0;
    let line = circular_arc(&on(0.0), &on(0.4), &on(0.8), &Vector3::y()).unwrap();
    let stations = [(0.0, 0.3), (0.5, -0.2), (1.0, 1.1)].map(|(fraction, twist)| SectionStation {
        fraction,
        section: SectionInput::diagonal(&[1e9; 6], &[1.0; 4]).unwrap(),
        twist,
    });
    let ids = model.add_beam_along(line, &stations, 2, 8).unwrap();
    let root = *model.node(ids.first_node).unwrap();
    let hold = model.add_joint(JointKind::Rigid, None, Some(ids.first_node), &root, &root);
    let hold = hold.unwrap();
    load(&mut model, &ids);
    let options = StaticOptions::default();
    let solution = Solution::solve_static(&model, &options, &mut |_, _| true).unwrap();
    assert_eq!(solution.outcome(), Outcome::Converged);
    let reaction = JointQuantity::Reaction(ResolvedIn::Space);
    solution.joint(hold, reaction, &[0.0]).unwrap()
}

#[test]
fn a_load_at_places_follows_the_untwisted_line() {
    // In the plane of the arc, along it and across it, and a moment about its axis; jumps at a
    // half.
    let given = [
        (0.0, [2.0, 0.0]),
        (0.5, [2.0, 8.0]),
        (0.5, [0.0, 4.0]),
        (1.0, [1.0, 6.0]),
    ];
    let places = given.map(|(fraction, [along, across])| {
        let mut components = [const { None }; 6];
        components[0] = Some(Signal::constant(along).unwrap());
        components[1] = Some(Signal::constant(across).unwrap());
        LoadPlace {
            fraction,
            components,
        }
    });
    // Neither of a length of one nor across the arc.
    let frame = BeamLoadFrame::Untwisted(Vector3::new(1.0, 0.0, 30.0));
    let found = borne(|model, ids| {
        let loaded = model.add_load_at_places(ids.first_element, ids.elements, frame, &places);
        loaded.unwrap();
    });
    // Of the undeformed arc, by the midpoint rule, whose error is 1e-8.
    let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
    let steps = 20000;
    for i in 0..steps {
        let at = (f64::from(i) + 0.5) / f64::from(steps);
        let pair = if at < 0.5 { &given[..2] } else { &given[2..] };
        let t = (at - pair[0].0) / (pair[1].0 - pair[0].0);
        let [along, across] = [0, 1].map(|k| pair[0].1[k] + (pair[1].1[k] - pair[0].1[k]) * t);
        let (sin, cos) = (0.8 * at).sin_cos();
        let tangent = Vector3::new(cos, 0.0, sin);
        let upward = Vector3::new(-sin, 0.0, cos);
        let here = (tangent * along + upward * across) * (0.8 * 4.0 / f64::from(steps));
        force += here;
        moment += (Vector3::new(sin, 0.0, 1.0 - cos) * 4.0).cross(&here);
    }
    for k in 0..3 {
        // Of the root, about which moments are; displacements are of 1e-7.
        assert!(
            (found[k].abs() - force[k].abs()).abs() < 1e-5,
            "{found:?} {force}"
        );
        assert!(
            (found[3 + k].abs() - moment[k].abs()).abs() < 1e-5,
            "{found:?} {moment}"
        );
    }
}

#[test]
fn a_load_at_places_is_the_sum_of_its_components() {
    let fractions = [0.0, 0.2, 0.7, 1.0];
    let value = |i: usize, k: usize| (1.0 + 3.0 * i as f64 - (k * k) as f64).sin() * 100.0;
    let signal = |x: f64| Some(Signal::constant(x).unwrap());
    for frame in [BeamLoadFrame::Space, BeamLoadFrame::Follower] {
        let at_once = borne(|model, ids| {
            let places = [0, 1, 2, 3].map(|i| LoadPlace {
                fraction: fractions[i],
                components: std::array::from_fn(|k| signal(value(i, k))),
            });
            let loaded = model.add_load_at_places(ids.first_element, ids.elements, frame, &places);
            loaded.unwrap();
        });
        let one_by_one = borne(|model, ids| {
            for k in 0..6 {
                let mut components = [const { None }; 6];
                components[k] = signal(1.0);
                let load = DistributedLoadDefinition {
                    first_element: ids.first_element,
                    elements: ids.elements,
                    frame,
                    components,
                    factors: (0..4).map(|i| (fractions[i], value(i, k))).collect(),
                };
                model.add_distributed_load(load).unwrap();
            }
        });
        for (a, b) in at_once.iter().zip(&one_by_one) {
            // Rounding of forces of some hundred.
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
    }
}

#[test]
fn loads_at_places_that_are_wrong_add_nothing() {
    let place = |fraction| LoadPlace {
        fraction,
        components: std::array::from_fn(|_| Some(Signal::constant(1.0).unwrap())),
    };
    let zero = Vector3::zeros();
    borne(|model, ids| {
        let count = ids.elements;
        let mut refused = |frame, fractions: &[f64], start: &str| {
            let places: Vec<_> = fractions.iter().map(|&f| place(f)).collect();
            let error = model.add_load_at_places(ids.first_element, count, frame, &places);
            let message = error.unwrap_err().to_string();
            assert!(message.starts_with(start), "{message}");
        };
        let space = BeamLoadFrame::Space;
        refused(space, &[0.0], "places: expected at least 2");
        refused(
            space,
            &[0.0, 0.6, 0.5, 1.0],
            "fractions[2]: expected at least 0.6",
        );
        refused(space, &[0.0, 0.9], "fractions[1]: expected 1 at the end");
        let untwisted = BeamLoadFrame::Untwisted;
        refused(
            untwisted(zero),
            &[0.0, 1.0],
            "axis_2: expected a vector that is not zero",
        );
        refused(
            untwisted(Vector3::repeat(f64::NAN)),
            &[0.0, 1.0],
            "axis_2[0]",
        );
    })
    .iter()
    .for_each(|x| assert!(x.abs() < 1e-12));
}

/// Processor time of this process.
fn processor_seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = text
        .rsplit(')')
        .next()
        .unwrap()
        .split_whitespace()
        .collect();
    let ticks = |i: usize| fields.get(i).and_then(|x| x.parse::<f64>().ok());
    (ticks(11).unwrap_or(0.0) + ticks(12).unwrap_or(0.0)) / 100.0
}

#[test]
#[ignore = "measures, asserts nothing"]
fn time_of_its_periodic_motion() {
    for places in [0, 42, 0, 42] {
        let (model, ..) = rotor(places);
        let start = processor_seconds();
        for _ in 0..10 {
            solve(&model, TAU / OMEGA, 11);
        }
        println!("{places}: {} s", (processor_seconds() - start) / 10.0);
    }
}
