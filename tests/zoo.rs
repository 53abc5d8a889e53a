//! A zoo of random mechanisms: trees and loops of rigid bodies and beams, with joints, forces of
//! all kinds, drives and loads. Each, moved as a whole or written in other units, does the same.

mod common;

use common::*;
use nalgebra::{Matrix3, Vector3, Vector6};
use periodyn::elements::{
    Coordinate, CoordinateLaw, CoordinateState, Effort, JointKind, LoadFrame, MaxwellBranch,
    NodeForceInput, NodeForceLaw, NodeForceOutput,
};
use periodyn::model::*;
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{BeamQuantity, ForceQuantity, JointQuantity, NodeQuantity, ResolvedIn};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::sync::Arc;

const MODELS: u64 = 40;
const POINTS: usize = 9;
const PERIOD: f64 = 1.0;

/// Rounding: strains of 1e-16 times axial stiffnesses of 1e5 N are 1e-11 N, against forces of some
/// 10 N, and conditioning takes a few digits of that (measured 2e-11, of the beams' forces).
const TOLERANCE: f64 = 1e-9;

/// A body that others can be joined to: its first and last node, and where they are, in SI units
/// and in the mechanism's own place.
#[derive(Clone, Copy)]
struct Member {
    first: Option<usize>,
    last: Option<usize>,
    end: Vector3<f64>,
    /// First beam element and number of elements, of a beam.
    beam: Option<(usize, usize)>,
}

const GROUND: Member = Member {
    first: None,
    last: None,
    end: Vector3::new(0.0, 0.0, 0.0),
    beam: None,
};

struct Zoo {
    random: Random,
    setting: Setting,
    model: Model,
    /// Joints with their coordinates.
    joints: Vec<(usize, &'static [Coordinate])>,
    /// Efforts of forces, with their units.
    efforts: Vec<(usize, f64)>,
    /// Forces on nodes.
    on_nodes: Vec<(usize, usize)>,
    /// What there is in the model.
    kinds: BTreeSet<&'static str>,
}

/// All kinds of forces.
const FORCES: [&str; 8] = [
    "actuator",
    "polynomial spring",
    "coordinate law",
    "differenced law",
    "viscoelastic",
    "viscous damper",
    "user force",
    "strut",
];

const KINDS: [JointKind; 9] = [
    JointKind::Rigid,
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Cylindrical,
    JointKind::Screw { pitch: 0.3 },
    JointKind::Planar,
    JointKind::Universal,
    JointKind::Spherical,
    JointKind::Free,
];

fn is_rotation(coordinate: Coordinate) -> bool {
    use Coordinate::*;
    matches!(coordinate, Rotation1 | Rotation2 | Rotation3)
}

/// Coordinates of a joint; of the screw, one of the two.
fn coordinates(kind: JointKind) -> &'static [Coordinate] {
    use Coordinate::*;
    match kind {
        JointKind::Rigid => &[],
        JointKind::Revolute | JointKind::Screw { .. } => &[Rotation1],
        JointKind::Prismatic | JointKind::Strut => &[Displacement1],
        JointKind::Cylindrical => &[Displacement1, Rotation1],
        JointKind::Planar => &[Displacement1, Displacement2, Rotation1],
        JointKind::Universal => &[Rotation1, Rotation2],
        JointKind::Spherical => &[Rotation1, Rotation2, Rotation3],
        JointKind::Free => &[
            Displacement1,
            Displacement2,
            Displacement3,
            Rotation1,
            Rotation2,
            Rotation3,
        ],
    }
}

impl Zoo {
    /// Model number `seed`, in a setting: the same random numbers whatever that is.
    fn build(seed: u64, setting: Setting) -> Zoo {
        let mut zoo = Zoo {
            random: Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15)),
            setting,
            model: Model::new(),
            joints: Vec::new(),
            efforts: Vec::new(),
            on_nodes: Vec::new(),
            kinds: BTreeSet::new(),
        };
        let gravity = zoo.random.vector() * 5.0 * setting.length / setting.time.powi(2);
        let gravity = setting.turned(&gravity);
        zoo.model
            .set_gravity([gravity.x, gravity.y, gravity.z].map(|g| Signal::constant(g).unwrap()));
        if zoo.random.below(3) == 0 {
            zoo.add_loop();
        } else {
            zoo.add_tree();
        }
        zoo.add_drive();
        zoo
    }

    /// Two to four bodies, each joined to the ground or to the end of one before.
    fn add_tree(&mut self) {
        let mut members = vec![GROUND];
        for _ in 0..2 + self.random.below(3) {
            let parent = members[self.random.below(members.len())];
            let start = parent.end;
            let end = start + self.random.vector().normalize();
            let member = self.add_member(&start, &end);
            let kind = KINDS[self.random.below(KINDS.len())];
            self.add_joint(kind, parent.last, member.first, &start);
            self.add_load(member);
            self.add_force_on_joint();
            self.add_force_on_member(member, parent);
            members.push(member);
        }
    }

    /// Two bodies hinged to the ground, and one between their ends: a spatial four-bar mechanism.
    fn add_loop(&mut self) {
        let base = Vector3::new(1.5, 0.3, -0.2);
        let corner = Vector3::new(0.2, 0.1, 1.0) + 0.2 * self.random.vector();
        let other = base + Vector3::new(-0.1, 0.2, 1.2) + 0.2 * self.random.vector();
        let left = self.add_member(&GROUND.end, &corner);
        let coupler = self.add_member(&corner, &other);
        let right = self.add_member(&base, &other);
        self.add_joint(JointKind::Revolute, None, left.first, &GROUND.end);
        self.add_joint(JointKind::Spherical, left.last, coupler.first, &corner);
        self.add_joint(JointKind::Universal, coupler.last, right.last, &other);
        self.add_joint(JointKind::Revolute, right.first, None, &base);
        self.add_load(coupler);
        self.add_force_on_joint();
        self.add_force_on_member(coupler, left);
    }

    /// Units of a coordinate, and of an effort on it.
    fn units(&self, coordinate: Coordinate) -> (f64, f64) {
        if is_rotation(coordinate) {
            (1.0, self.setting.moment())
        } else {
            (self.setting.length, self.setting.force())
        }
    }

    /// A force on the last joint's first coordinate, beside its spring.
    fn add_force_on_joint(&mut self) {
        let (joint, coordinates) = self.joints[self.joints.len() - 1];
        let Some(&coordinate) = coordinates.first() else {
            return;
        };
        let at = JointCoordinate { joint, coordinate };
        let (unit, effort) = self.units(coordinate);
        let time = self.setting.time;
        let (k, c) = (effort / unit, effort / unit * time);
        let which = FORCES[self.random.below(5)];
        let model = &mut self.model;
        let force = match which {
            "actuator" => {
                let signal = Signal::harmonics(effort, 0.0, &[3.0 * effort], &[-2.0 * effort]);
                model.add_actuator(at, &signal.unwrap())
            }
            "polynomial spring" => {
                let stiffness = [50.0 * k, 20.0 * k / unit, 100.0 * k / (unit * unit)];
                let damping = [2.0 * c, 0.1 * c * time / unit];
                model.add_polynomial_spring_damper(at, &stiffness, &damping, 0.1 * unit)
            }
            "viscoelastic" => {
                let branch = |stiffness: f64, relaxation_time: f64| MaxwellBranch {
                    stiffness: stiffness * k,
                    relaxation_time: relaxation_time * time,
                };
                model.add_viscoelastic(
                    at,
                    50.0 * k,
                    0.1 * unit,
                    &[branch(80.0, 0.1), branch(40.0, 1.5)],
                )
            }
            _ => {
                let function = move |s: &CoordinateState| {
                    let q = s.value / unit;
                    let wave = (TAU * s.time / (PERIOD * time)).cos();
                    Ok(Effort {
                        value: effort * (30.0 * q.sin() + 2.0 * wave) + 1.5 * c * s.rate,
                        by_coordinate: 30.0 * k * q.cos(),
                        by_rate: 1.5 * c,
                    })
                };
                let law = CoordinateLaw {
                    function: Arc::new(function),
                    gives_derivatives: which == "coordinate law",
                };
                model.add_coordinate_law(at, law)
            }
        };
        self.efforts.push((force.unwrap(), effort));
        self.kinds.insert(which);
    }

    /// A force between the ends of two members, or of a member and the ground.
    fn add_force_on_member(&mut self, member: Member, other: Member) {
        let set = self.setting;
        let node = member.last.unwrap();
        let which = FORCES[5 + self.random.below(3)];
        self.kinds.insert(which);
        match which {
            "viscous damper" => {
                let sizes = Vector6::new(5.0, 4.0, 6.0, 0.5, 0.4, 0.6);
                let (unit, l) = (set.force() / set.length * set.time, set.length);
                let matrix = self.random.coupled(&sizes);
                let matrix = Setting::scaled(&matrix, unit, unit * l, unit * l * l);
                let axes = rotation_from_vector(&self.random.vector());
                let point = member.end + 0.2 * self.random.vector();
                let frame = Motion::new(set.place.rotation * axes, set.point(&point));
                let damper =
                    self.model
                        .add_viscous_damper(other.last, Some(node), Some(&frame), &matrix);
                self.on_nodes.push((damper.unwrap(), node));
            }
            "user force" => {
                let frame = [LoadFrame::Space, LoadFrame::Follower][self.random.below(2)];
                let both = other.last.filter(|_| frame == LoadFrame::Space);
                let nodes: Vec<usize> = both.into_iter().chain([node]).collect();
                let law = NodeForceLaw {
                    function: Arc::new(move |input, output| {
                        node_forces(&set, input, output);
                        Ok(())
                    }),
                    gives_tangents: false,
                    frame,
                };
                let force = self.model.add_node_forces(&nodes, law).unwrap();
                self.on_nodes.push((force, node));
            }
            _ => {
                let foot = member.end + self.random.vector().normalize() * 0.7;
                let (foot, end) = (set.point(&foot), set.point(&member.end));
                let strut = self.model.add_strut(None, Some(node), &foot, &end);
                let spring = SpringDefinition {
                    at: JointCoordinate {
                        joint: strut.unwrap(),
                        coordinate: Coordinate::Displacement1,
                    },
                    stiffness: 40.0 * set.force() / set.length,
                    damping: 2.0 * set.force() / set.length * set.time,
                    rest: 0.8 * set.length,
                };
                let force = self.model.add_spring_damper(spring).unwrap();
                self.efforts.push((force, set.force()));
            }
        }
    }

    /// A rigid body or a beam.
    fn add_member(&mut self, start: &Vector3<f64>, end: &Vector3<f64>) -> Member {
        let set = self.setting;
        let across = self.random.vector();
        let (from, to) = (set.point(start), set.point(end));
        let flexible = self.random.below(2) == 0;
        let (first, last, beam) = if flexible {
            let sizes = Vector6::new(1e5, 4e4, 4e4, 200.0, 300.0, 500.0);
            let stiffness = self.random.coupled(&sizes);
            let mass = Vector6::new(1.0, 1.0, 1.0, 0.02, 0.01, 0.01);
            let section = SectionInput {
                stiffness,
                mass: self.random.coupled(&mass),
                damping: stiffness * 5e-3,
            };
            let (elements, degree) = (1 + self.random.below(3), 1 + self.random.below(4));
            let (section, across) = (set.section(&section), set.turned(&across));
            let beam = self
                .model
                .add_straight_beam(&from, &to, &across, &section, elements, degree)
                .unwrap();
            let elements = (beam.first_element, beam.elements);
            (beam.first_node, beam.last_node, Some(elements))
        } else {
            let mass = self.random.between(0.5, 2.0);
            let turn = rotation_from_vector(&across);
            let moments = Vector3::from_fn(|_, _| self.random.between(0.1, 0.2));
            let inertia = turn * Matrix3::from_diagonal(&moments) * turn.transpose();
            let turned = set.place.rotation * inertia * set.place.rotation.transpose();
            let centre = set.point(&(0.5 * (start + end) + 0.1 * across));
            let inertia = turned * set.mass * set.length * set.length;
            let node = self
                .model
                .add_rigid_body(mass * set.mass, &centre, &inertia);
            let node = node.unwrap();
            (node, node, None)
        };
        Member {
            first: Some(first),
            last: Some(last),
            end: *end,
            beam,
        }
    }

    /// A joint with a spring and a damper on each coordinate.
    fn add_joint(
        &mut self,
        kind: JointKind,
        first: Option<usize>,
        second: Option<usize>,
        point: &Vector3<f64>,
    ) {
        let set = self.setting;
        let axes = rotation_from_vector(&self.random.vector());
        let frame = Motion::new(set.place.rotation * axes, set.point(point));
        let in_units = match kind {
            JointKind::Screw { pitch } => JointKind::Screw {
                pitch: pitch * set.length,
            },
            other => other,
        };
        let joint = self
            .model
            .add_joint(in_units, first, second, &frame, &frame);
        let joint = joint.unwrap();
        for &coordinate in coordinates(kind) {
            let (length, effort) = if is_rotation(coordinate) {
                (1.0, set.moment())
            } else {
                (set.length, set.force())
            };
            let spring = SpringDefinition {
                at: JointCoordinate { joint, coordinate },
                stiffness: self.random.between(300.0, 800.0) * effort / length,
                damping: self.random.between(8.0, 20.0) * effort / length * set.time,
                rest: 0.1 * self.random.number() * length,
            };
            self.model.add_spring_damper(spring).unwrap();
        }
        self.kinds.insert(kind.name());
        self.joints.push((joint, coordinates(kind)));
    }

    /// Force and moment on the last node, in space or following it.
    fn add_load(&mut self, member: Member) {
        let set = self.setting;
        let node = member.last.unwrap();
        let follows = self.random.below(2) == 0;
        let frame = [LoadFrame::Space, LoadFrame::Follower][usize::from(follows)];
        // Axes of a beam's node lie in the beam; those of a body are the global ones, which stay.
        let own_axes = self.model.node(node).unwrap().rotation.transpose() * set.place.rotation;
        let harmonics: [[Vector3<f64>; 4]; 2] =
            [(8.0, set.force()), (2.0, set.moment())].map(|(size, unit)| {
                std::array::from_fn(|_| {
                    let v = self.random.vector() * size * unit;
                    if follows {
                        own_axes * v
                    } else {
                        set.turned(&v)
                    }
                })
            });
        let component = |i: usize| {
            let [mean, cosine, sine, second] = harmonics[i / 3].map(|v| v[i % 3]);
            Some(Signal::harmonics(mean, 0.0, &[cosine, 0.3 * second], &[sine, 0.0]).unwrap())
        };
        self.model
            .add_load(node, frame, std::array::from_fn(component))
            .unwrap();
        if let Some((first_element, elements)) = member.beam {
            self.add_distributed_load(first_element, elements);
        }
    }

    /// Forces along a beam, in space, and a moment about its axis that follows its sections.
    fn add_distributed_load(&mut self, first_element: usize, elements: usize) {
        let set = self.setting;
        let force = set.turned(&self.random.vector()) * (4.0 * set.force() / set.length);
        let wave = |x: f64| Some(Signal::harmonics(0.2 * x, 0.0, &[x], &[-0.5 * x]).unwrap());
        let [x, y, z] = [force.x, force.y, force.z].map(wave);
        let torque = wave(0.8 * set.moment() / set.length);
        let shape = vec![(0.0, 0.5), (0.4, 2.0), (1.0, 1.0)];
        for (frame, components) in [
            (LoadFrame::Space, [x, y, z, None, None, None]),
            (LoadFrame::Follower, [None, None, None, torque, None, None]),
        ] {
            self.model
                .add_distributed_load(DistributedLoadDefinition {
                    first_element,
                    elements,
                    frame: frame.into(),
                    components,
                    factors: shape.clone(),
                })
                .unwrap();
        }
        self.kinds.insert("distributed load");
    }

    /// Prescribes the first coordinate of some joint, in half of the models.
    fn add_drive(&mut self) {
        let free: Vec<_> = self.joints.iter().filter(|j| !j.1.is_empty()).collect();
        if !free.is_empty() && self.random.below(2) == 0 {
            let (joint, coordinates) = *free[self.random.below(free.len())];
            let coordinate = coordinates[0];
            let unit = if is_rotation(coordinate) {
                1.0
            } else {
                self.setting.length
            };
            let (mean, amplitude) = (0.1 * self.random.number(), 0.2 * self.random.number());
            let signal =
                Signal::harmonics(mean * unit, 0.0, &[amplitude * unit], &[0.1 * unit]).unwrap();
            let at = JointCoordinate { joint, coordinate };
            self.model.prescribe(at, &signal).unwrap();
        }
    }

    /// Everything that is compared, by kind, back in SI units and in the mechanism's own place.
    fn response(&self) -> BTreeMap<String, Vec<f64>> {
        let set = self.setting;
        let solution = solve(&self.model, PERIOD * set.time, POINTS);
        let times = times(PERIOD * set.time, 7);
        let mut curves: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        let mut keep = |kind: &str, v: &[f64], turned: bool, unit: f64| {
            let v = Vector3::from_column_slice(v) / unit;
            let v = if turned {
                set.place.rotation.transpose() * v
            } else {
                v
            };
            curves.entry(kind.into()).or_default().extend(v.iter());
        };
        for node in 0..self.model.node_count() {
            let position = solution.node(node, NodeQuantity::Position, &times).unwrap();
            for p in position.chunks_exact(3) {
                let p = Vector3::from_column_slice(p) - set.place.position;
                keep("position", p.as_slice(), true, set.length);
            }
            let velocity = solution.node(node, NodeQuantity::Velocity, &times).unwrap();
            for v in velocity.chunks_exact(6) {
                keep("velocity", &v[..3], true, set.length / set.time);
                keep("angular velocity", &v[3..], true, 1.0 / set.time);
            }
        }
        for &(joint, coordinates) in &self.joints {
            let reaction = JointQuantity::Reaction(ResolvedIn::Space);
            for r in solution
                .joint(joint, reaction, &times)
                .unwrap()
                .chunks_exact(6)
            {
                keep("reaction force", &r[..3], true, set.force());
                keep("reaction moment", &r[3..], true, set.moment());
            }
            for &coordinate in coordinates {
                let quantity = JointQuantity::Coordinate(coordinate);
                for x in solution.joint(joint, quantity, &times).unwrap() {
                    if is_rotation(coordinate) {
                        keep("angle", &[x, 0.0, 0.0], false, 1.0);
                    } else {
                        keep("displacement", &[x, 0.0, 0.0], false, set.length);
                    }
                }
            }
        }
        for &(force, unit) in &self.efforts {
            for x in solution
                .force(force, ForceQuantity::Effort, &times)
                .unwrap()
            {
                keep("effort", &[x, 0.0, 0.0], false, unit);
            }
        }
        for &(force, node) in &self.on_nodes {
            let quantity = ForceQuantity::OnNode(node, LoadFrame::Space);
            for f in solution
                .force(force, quantity, &times)
                .unwrap()
                .chunks_exact(6)
            {
                keep("force on a node", &f[..3], true, set.force());
                keep("moment on a node", &f[3..], true, set.moment());
            }
        }
        for element in 0..self.model.beam_element_count() {
            let force = solution
                .beam(element, 0.3, BeamQuantity::Force, &times)
                .unwrap();
            for f in force.chunks_exact(6) {
                keep("beam force", &f[..3], false, set.force());
                keep("beam moment", &f[3..], false, set.moment());
            }
        }
        curves
    }
}

/// A spring between two nodes, or none, and what resists the velocity of the last.
fn node_forces(set: &Setting, input: &NodeForceInput, output: &mut NodeForceOutput) {
    let (force, length) = (set.force(), set.length);
    let (k, c) = (60.0 * force / length, 3.0 * force / length * set.time);
    let last = input.positions.len() - 1;
    let wave = 1.0 + 0.5 * (TAU * input.time / (PERIOD * set.time)).cos();
    let v = &input.velocities[last];
    let resistance = Vector6::from_fn(|i, _| {
        let unit = if i < 3 { 1.0 } else { 0.1 * length * length };
        -c * unit * v[i]
    });
    output.forces[last] = resistance;
    if last == 1 {
        let between = input.positions[1] - input.positions[0];
        let distance = between.norm();
        let pull = between * (k * (1.0 - 0.8 * length / distance) * wave);
        for (node, sign) in [(0, 1.0), (1, -1.0)] {
            let mut part = output.forces[node].fixed_rows_mut::<3>(0);
            part += pull * sign;
        }
    }
}

fn assert_same(other: Setting) {
    let mut kinds = BTreeSet::new();
    let mut worst: BTreeMap<String, f64> = BTreeMap::new();
    for seed in 1..=MODELS {
        let model = Zoo::build(seed, Setting::default());
        kinds.extend(model.kinds.iter().copied());
        let own = model.response();
        let moved = Zoo::build(seed, other).response();
        assert_eq!(own.len(), moved.len());
        for (kind, a) in &own {
            let difference =
                largest_difference(a, &moved[kind]) / largest(a.iter().copied()).max(1e-3);
            assert!(
                difference < TOLERANCE,
                "model {seed}, {kind}: {difference:.1e}"
            );
            let w = worst.entry(kind.clone()).or_default();
            *w = w.max(difference);
        }
    }
    println!("{worst:?}");
    for name in KINDS
        .iter()
        .map(|kind| kind.name())
        .chain(FORCES)
        .chain(["distributed load"])
    {
        assert!(kinds.contains(name), "no {name} among the models");
    }
}

#[test]
fn moved_mechanisms_do_the_same() {
    let turn = Vector3::new(0.83, -1.91, 1.27);
    assert_same(Setting {
        place: Motion::new(rotation_from_vector(&turn), Vector3::new(1.7, -0.9, 2.3)),
        ..Setting::default()
    });
}

#[test]
fn other_units_give_the_same() {
    // Pounds, inches and minutes.
    assert_same(Setting {
        mass: 1.0 / 0.453_592_37,
        length: 1.0 / 0.0254,
        time: 1.0 / 60.0,
        ..Setting::default()
    });
}
