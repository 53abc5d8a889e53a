//! Loads at points that bodies and beams carry: the same as loads on nodes that are there.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3, Vector6};
use periodyn::elements::*;
use periodyn::error::ErrorKind;
use periodyn::model::*;
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{BeamQuantity, NodeQuantity, Solution};
use periodyn::solve::*;

const OFFSET: [f64; 3] = [0.1, -0.2, 0.3];

fn components(values: [f64; 6]) -> [Option<Signal>; 6] {
    values.map(|x| (x != 0.0).then(|| Signal::constant(x).unwrap()))
}

/// Position and rotation of a node at some times.
fn motions(solution: &Solution, node: usize, times: &[f64]) -> Vec<f64> {
    [NodeQuantity::Position, NodeQuantity::RotationMatrix]
        .map(|quantity| solution.node(node, quantity, times).unwrap())
        .concat()
}

/// A node at `offset` from `node`, along its axes, that is rigidly fixed to it.
fn fixed_to(model: &mut Model, node: usize, offset: &Vector3<f64>) -> usize {
    let at = *model.node(node).unwrap();
    let there = Motion::new(at.rotation, at.position + at.rotation * offset);
    let other = model.add_node(&there).unwrap();
    model
        .add_joint(JointKind::Rigid, Some(node), Some(other), &there, &there)
        .unwrap();
    other
}

/// A body, turned in the reference, on springs and dampers about all three axes of a hinge.
fn body_on_springs() -> (Model, usize) {
    let mut model = Model::new();
    let turn = rotation_from_vector(&Vector3::new(0.3, -0.4, 0.7));
    let node = model.add_node(&Motion::new(turn, Vector3::new(0.5, 0.2, -0.1)));
    let node = node.unwrap();
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.3, 0.4, 0.5));
    model
        .add_mass(node, 2.0, &Vector3::zeros(), &inertia)
        .unwrap();
    let frame = Motion::identity();
    let joint = model.add_joint(JointKind::Spherical, None, Some(node), &frame, &frame);
    let joint = joint.unwrap();
    for coordinate in [
        Coordinate::Rotation1,
        Coordinate::Rotation2,
        Coordinate::Rotation3,
    ] {
        spring(&mut model, JointCoordinate { joint, coordinate }, 20.0, 2.0);
    }
    (model, node)
}

#[test]
fn a_load_off_a_body_is_that_on_a_node_fixed_there() {
    let offset = Vector3::from(OFFSET);
    let period = 2.0;
    let times = times(period, 7);
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        let signals = || {
            let sizes = [4.0, -3.0, 5.0, 1.0, 2.0, -1.5];
            sizes.map(|x| Some(Signal::harmonics(x, 0.0, &[0.5 * x], &[x]).unwrap()))
        };
        let (mut model, body) = body_on_springs();
        let at = LoadPoint::Node(body);
        let load = LoadDefinition {
            at,
            offset,
            frame,
            components: signals(),
        };
        assert_eq!(model.add_point_load(load).unwrap(), 0);
        let found = motions(&solve(&model, period, 31), body, &times);

        let (mut model, body) = body_on_springs();
        let there = fixed_to(&mut model, body, &offset);
        model.add_load(there, frame, signals()).unwrap();
        let expected = motions(&solve(&model, period, 31), body, &times);
        let (mut model, body) = body_on_springs();
        model.add_load(body, frame, signals()).unwrap();
        let without = motions(&solve(&model, period, 31), body, &times);

        let apart = largest_difference(&found, &expected);
        let by_offset = largest_difference(&without, &expected);
        println!("{frame:?}: {apart:e}, without offset {by_offset}");
        // The tolerance of Newton's method.
        assert!(apart < 1e-10 && by_offset > 0.02);
    }
}

/// A body that swings under gravity, described at its hinge.
fn pendulum() -> (Model, Vector3<f64>, f64) {
    let mut model = Model::new();
    let node = model.add_node(&Motion::identity()).unwrap();
    let (mass, centre) = (3.0, Vector3::new(0.4, 0.1, -0.6));
    let inertia = Matrix3::from_diagonal(&Vector3::new(0.05, 0.04, 0.06));
    model.add_mass(node, mass, &centre, &inertia).unwrap();
    let frame = Motion::identity();
    model
        .add_joint(JointKind::Spherical, None, Some(node), &frame, &frame)
        .unwrap();
    (model, centre, mass)
}

fn march(model: &Model, duration: f64, steps: usize) -> Solution {
    let end = MarchEnd::Duration(duration);
    let mut options = MarchOptions::with_step(duration / steps as f64, end);
    options.newton.tolerance = 1e-11;
    options.period = Some(0.2);
    let twists = vec![Vector6::zeros(); model.node_count()];
    options.start = MarchStart::State(StartState {
        motions: model.reference_motions().to_vec(),
        twists,
        internal: None,
    });
    converged(Solution::march(model, &options, &mut |_, _| true).unwrap())
}

#[test]
fn a_weight_is_a_load_at_the_centre_of_mass() {
    let times = [0.3, 0.9, 1.6, 2.0];
    let (mut model, ..) = pendulum();
    gravity(&mut model, [0.0, 0.0, -9.81]);
    let expected = motions(&march(&model, 2.0, 200), 0, &times);
    let (mut model, offset, mass) = pendulum();
    let load = LoadDefinition {
        at: LoadPoint::Node(0),
        offset,
        frame: LoadFrame::Space,
        components: components([0.0, 0.0, -9.81 * mass, 0.0, 0.0, 0.0]),
    };
    model.add_point_load(load).unwrap();
    let found = motions(&march(&model, 2.0, 200), 0, &times);
    let apart = largest_difference(&found, &expected);
    println!("{apart:e}");
    // Of 200 steps, each to 1e-11.
    assert!(apart < 1e-9);
}

/// A twisted rod of 1 m, clamped, with element boundaries there.
fn rod(boundaries: &[f64], degree: usize) -> (Model, BeamIds) {
    let stiffness = [8e3, 3e3, 3e3, 14.0, 9.0, 25.0];
    let section = SectionInput::diagonal(&stiffness, &[0.3, 0.02, 0.01, 0.01]).unwrap();
    let stations = [(0.0, 0.2), (1.0, 1.1)].map(|(fraction, twist)| SectionStation {
        fraction,
        section,
        twist,
    });
    let line = |t: f64| {
        let turn = rotation_from_vector(&(Vector3::z() * (0.8 * t)));
        let place = Vector3::new((0.8 * t).sin(), 1.0 - (0.8 * t).cos(), 0.0) / 0.8;
        Ok(Motion::new(turn, place))
    };
    let mut model = Model::new();
    let rod = model
        .add_beam_between(line, &stations, boundaries, degree)
        .unwrap();
    clamp(&mut model, rod.first_node);
    (model, rod)
}

fn even(elements: usize) -> Vec<f64> {
    let at = |i| f64::from(i) / elements as f64;
    (0..=elements as i32).map(at).collect()
}

const LOAD: [f64; 6] = [3.0, -8.0, 11.0, 1.0, -2.0, 1.5];

fn on_rod(rod: &BeamIds, fraction: f64, frame: LoadFrame) -> LoadDefinition {
    LoadDefinition {
        at: LoadPoint::Beam {
            first_element: rod.first_element,
            elements: rod.elements,
            fraction,
        },
        offset: OFFSET.into(),
        frame,
        components: components(LOAD),
    }
}

/// The end of a rod of so many elements under a load at a third of it.
fn end_of_rod(elements: usize, frame: LoadFrame) -> Vec<f64> {
    let (mut model, rod) = rod(&even(elements), 3);
    model
        .add_point_load(on_rod(&rod, 1.0 / 3.0, frame))
        .unwrap();
    motions(&statics(&model), rod.last_node, &[0.0])
}

#[test]
fn a_load_on_a_beam_is_that_on_a_node_fixed_to_a_section() {
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        let (mut model, beam) = rod(&[0.0, 1.0 / 6.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], 7);
        let there = fixed_to(&mut model, beam.first_node + 14, &OFFSET.into());
        model.add_load(there, frame, components(LOAD)).unwrap();
        let expected = motions(&statics(&model), beam.last_node, &[0.0]);
        let free = motions(&statics(&rod(&even(4), 7).0), beam.last_node, &[0.0]);
        let moved = largest_difference(&expected, &free);
        // Where a boundary is there, and where the load is at one or two thirds of an element.
        let errors: Vec<f64> = [3, 4, 8, 16, 32]
            .iter()
            .map(|&n| largest_difference(&end_of_rod(n, frame), &expected) / moved)
            .collect();
        println!("{frame:?}: {moved} {errors:?}");
        assert!(moved > 0.1);
        // Where a node is there, what elements of the third degree leave.
        assert!(errors[0] < 3e-5, "{}", errors[0]);
        // Within an element forces and moments jump: an error of first order, compared where the
        // load is at the same part of an element.
        for pair in errors[1..].windows(3) {
            let ratio = pair[2] / pair[0];
            assert!((0.2..0.3).contains(&ratio), "{errors:?}");
        }
        assert!(errors[4] < 3e-4);
    }
}

#[test]
fn a_load_at_a_boundary_is_that_on_the_node() {
    let (boundaries, frame) = (even(3), LoadFrame::Follower);
    for (place, fraction) in [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].into_iter().enumerate() {
        let (mut model, beam) = rod(&boundaries, 2);
        let mut load = on_rod(&beam, fraction, frame);
        model.add_point_load(load.clone()).unwrap();
        let solution = statics(&model);
        let (mut model, _) = rod(&boundaries, 2);
        load.at = LoadPoint::Node(beam.first_node + 2 * place);
        model.add_point_load(load).unwrap();
        let expected = statics(&model);
        let ends = [&solution, &expected].map(|s| motions(s, beam.last_node, &[0.0]));
        let apart = largest_difference(&ends[0], &ends[1]);
        assert!(apart < 1e-13, "{fraction}: {apart:e}");
        // What the load makes forces jump by is not taken for an error of the mesh.
        for element in 0..3 {
            for station in [-1.0, 1.0] {
                let jump = |s: &Solution| {
                    s.beam(element, station, BeamQuantity::ForceJump, &[0.0])
                        .unwrap()
                };
                let apart = largest_difference(&jump(&solution), &jump(&expected));
                assert!(apart < 1e-10, "{apart:e}");
            }
        }
    }
}

/// Work of the nodes' forces on an increment is that of the load on what it moves.
#[test]
fn loads_do_the_work_of_their_point() {
    let reference = |xi: f64| {
        let turn = rotation_from_vector(&(Vector3::new(0.3, 0.1, -0.2) * xi));
        Motion::new(turn, Vector3::new(0.6 * xi, 0.1 * xi * xi, 0.0))
    };
    let points = lobatto_points(4);
    let nodes: Vec<Motion> = points.iter().map(|&xi| reference(xi)).collect();
    let input = SectionInput::diagonal(&[8e3, 3e3, 3e3, 14.0, 9.0, 25.0], &[0.0; 4]).unwrap();
    let section = Section {
        stiffness: input.stiffness,
        mass: input.mass,
        damping: input.damping,
    };
    // The sections turn by a corner of their twist.
    let line = SectionLine::new(section, &[(0.1, section)], section).twisted(vec![0.0, 0.4, 0.1]);
    let beam = Beam::new(vec![0, 1, 2, 3], nodes.clone(), line).unwrap();
    let (xi, offset) = (-0.3, Vector3::from(OFFSET));
    let at = |shift: f64| -> Motion {
        let moved: Vec<Motion> = (nodes.iter().enumerate())
            .map(|(a, node)| {
                let a = a as f64;
                let bent = Vector6::new(0.1 * a, -0.2, 0.05 * a * a, 0.3, -0.1 * a, 0.2);
                let by = Vector6::new(1.0 - a, 0.7, a, -0.5 * a, 0.9, 0.3 * a - 1.0);
                node.increment(&bent).increment(&(by * shift))
            })
            .collect();
        beam.section_motion(xi, &moved).unwrap()
    };
    let here = at(0.0);
    let signals: Vec<f64> = LOAD.to_vec();
    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        let numbers = std::array::from_fn(Some);
        let load = DistributedLoad::at_place(&beam, xi, &offset, frame, numbers).unwrap();
        let states: Vec<NodeState> = (nodes.iter().enumerate())
            .map(|(a, node)| {
                let a = a as f64;
                let bent = Vector6::new(0.1 * a, -0.2, 0.05 * a * a, 0.3, -0.1 * a, 0.2);
                NodeState {
                    motion: node.increment(&bent),
                    twist: Vector6::zeros(),
                    twist_rate: Vector6::zeros(),
                }
            })
            .collect();
        let mut out = Contribution::of(&load, false);
        let instant = Instant {
            time: 0.0,
            nodes: &states,
            multipliers: &[],
            multiplier_rates: &[],
            resultants: &[],
            signals: &signals,
            coordinates: &[],
            gravity: Vector3::zeros(),
            inertial: InertialForces::FULL,
        };
        load.evaluate(&instant, &mut out).unwrap();
        let work: f64 = (0..4)
            .map(|a| {
                let a_ = a as f64;
                let by = Vector6::new(1.0 - a_, 0.7, a_, -0.5 * a_, 0.9, 0.3 * a_ - 1.0);
                -out.force.fixed_rows::<6>(6 * a).dot(&by)
            })
            .sum();
        let (force, moment) = (
            Vector3::new(LOAD[0], LOAD[1], LOAD[2]),
            Vector3::new(LOAD[3], LOAD[4], LOAD[5]),
        );
        let (force, moment) = match frame {
            LoadFrame::Space => (force, moment),
            LoadFrame::Follower => (here.rotation * force, here.rotation * moment),
        };
        let step = 1e-5;
        let [up, down] = [at(step), at(-step)];
        let point = |m: &Motion| m.position + m.rotation * offset;
        let displaced = (point(&up) - point(&down)) / (2.0 * step);
        let turn = (up.rotation - down.rotation) * here.rotation.transpose() / (2.0 * step);
        let turned = Vector3::new(turn[(2, 1)], turn[(0, 2)], turn[(1, 0)]);
        let expected = force.dot(&displaced) + moment.dot(&turned);
        println!("{frame:?}: {work} {expected}");
        // Differences of second order with a step of 1e-5.
        assert!((work - expected).abs() < 1e-8 * expected.abs(), "{frame:?}");
        assert!(expected.abs() > 1.0);
    }
}

#[test]
fn a_march_under_a_load_on_a_beam_is_of_second_order() {
    let (mut model, beam) = rod(&even(2), 2);
    let mut load = on_rod(&beam, 0.8, LoadFrame::Space);
    // Growing smoothly from zero, so that it does not make what steps do not resolve ring.
    let growing = |x: f64| Signal::harmonics(0.1 * x, 0.0, &[-0.1 * x], &[0.0]).unwrap();
    load.components = LOAD.map(|x| Some(growing(x)));
    model.add_point_load(load).unwrap();
    let duration = 0.1;
    let end = |steps: usize| {
        let solution = march(&model, duration, steps);
        motions(&solution, beam.last_node, &[duration])
    };
    let ends = [400, 800, 1600, 3200].map(end);
    let [coarse, middle, fine] = [0, 1, 2].map(|i| largest_difference(&ends[i], &ends[i + 1]));
    println!("{coarse:e} {middle:e} {fine:e}");
    for ratio in [coarse / middle, middle / fine] {
        assert!((3.7..4.3).contains(&ratio), "{ratio}");
    }
}

#[test]
fn they_are_saved_moved_by_parameters_and_given_other_signals() {
    let (mut model, beam) = rod(&even(2), 2);
    let id = model.add_point_load(on_rod(&beam, 0.6, LoadFrame::Space));
    let id = id.unwrap();
    let path = std::env::temp_dir().join(format!("point_loads_{}.pdm", std::process::id()));
    model.save(&path).unwrap();
    let loaded = Model::load(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let (was, is) = (&model.loads()[id], &loaded.loads()[id]);
    assert_eq!((was.at, was.offset), (is.at, is.offset));
    let end = |model: &Model| motions(&statics(model), beam.last_node, &[0.0]);
    assert_eq!(end(&model), end(&loaded));

    let place = SignalPlace::Load(id, 1);
    let target = Target::Signal(place, SignalPart::Mean);
    let parameter = model.add_parameter("push", 9.0, 1.0).unwrap();
    model.move_by_parameter(parameter, target, 1.0).unwrap();
    let mut changed = loaded.clone();
    let signal = Signal::constant(9.0).unwrap();
    changed.set_signal(place, &signal).unwrap();
    assert_eq!(end(&model), end(&changed));
    assert_ne!(end(&model), end(&loaded));
}

#[test]
fn places_that_are_none_are_refused() {
    let (mut model, beam) = rod(&even(2), 2);
    let good = on_rod(&beam, 0.5, LoadFrame::Space);
    let at = |first_element, elements, fraction| LoadPoint::Beam {
        first_element,
        elements,
        fraction,
    };
    for (at, offset, kind, name) in [
        (LoadPoint::Node(99), 0.0, ErrorKind::Identifier, "node"),
        (at(7, 1, 0.5), 0.0, ErrorKind::Identifier, "first_element"),
        (at(0, 3, 0.5), 0.0, ErrorKind::Size, "elements"),
        (at(0, 2, 1.1), 0.0, ErrorKind::Value, "fraction"),
        (at(0, 2, f64::NAN), 0.0, ErrorKind::NotFinite, "fraction"),
        (at(0, 2, 0.5), f64::INFINITY, ErrorKind::NotFinite, "offset"),
    ] {
        let load = LoadDefinition {
            at,
            offset: Vector3::x() * offset,
            ..good.clone()
        };
        let error = model.add_point_load(load).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.to_string().starts_with(name), "{error}");
    }
    assert!(model.loads().is_empty());
}
