//! The one test that every element passes: its tangents are the derivatives of its forces.

use super::*;
use crate::motion::{DualVector, Motion, rotation_from_vector, skew};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::ops::AddAssign;

/// Reproducible numbers in `[−1, 1]`.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector6<f64> {
        Vector6::from_fn(|_, _| self.next())
    }

    fn motion(&mut self) -> Motion {
        let v = self.vector() * 2.0;
        Motion::new(
            rotation_from_vector(&v.fixed_rows::<3>(3).into_owned()),
            v.fixed_rows::<3>(0).into_owned(),
        )
    }

    /// Symmetric, positive definite, and full.
    fn positive_definite(&mut self) -> Matrix6<f64> {
        let m = Matrix6::from_fn(|_, _| self.next());
        m * m.transpose() + Matrix6::identity()
    }
}

/// An element of one strain, as it would be added: a cable between the origins of two nodes.
#[derive(Debug)]
struct Cable {
    length: f64,
    stiffness: f64,
}

impl Element for Cable {
    fn nodes(&self) -> &[usize] {
        &[0, 1]
    }

    fn evaluate(&self, instant: &Instant, out: &mut Contribution) -> Result<()> {
        let motions = [instant.nodes[0].motion, instant.nodes[1].motion];
        let span = motions[1].position - motions[0].position;
        let (now, along) = (span.norm(), span.normalize());
        let strain = now / self.length - 1.0;
        let tension = along * (self.stiffness * strain);
        let across = (Matrix3::identity() - along * along.transpose()) / now;
        let tangent = along * along.transpose() * (self.stiffness / self.length)
            + across * (self.stiffness * strain);
        for (a, sign) in [(0, -1.0), (1, 1.0)] {
            let back = motions[a].rotation.transpose() * sign;
            let force = back * tension;
            out.force.fixed_rows_mut::<3>(6 * a).add_assign(force);
            for (b, sign) in [(0, -1.0), (1, 1.0)] {
                let block = back * tangent * motions[b].rotation * sign;
                let mut view = out.stiffness.fixed_view_mut::<3, 3>(6 * a, 6 * b);
                view.add_assign(block);
            }
            let mut turned = out.stiffness.fixed_view_mut::<3, 3>(6 * a, 6 * a + 3);
            turned.add_assign(skew(&force));
        }
        Ok(())
    }
}

/// An element with a state to test it in.
struct Case {
    name: String,
    element: Box<dyn Element>,
    states: Vec<NodeState>,
    coordinates: Vec<f64>,
}

/// Shells of several sides, curved and twisted in the reference and bent, with full laws, on nodes
/// that are turned and beside the surface, however.
fn shell_cases(
    random: &mut Random,
    states: &impl Fn(Vec<Motion>, &mut Random) -> Vec<NodeState>,
    cases: &mut Vec<Case>,
) {
    let law = |random: &mut Random, scale: f64| {
        let m = Matrix12::from_fn(|_, _| random.next());
        (m * m.transpose() + Matrix12::identity()) * scale
    };
    for sides in [[2, 2], [2, 3], [3, 2], [3, 3], [4, 3]] {
        let start = random.motion();
        let grid = NodeGrid::new(sides);
        let mut surface = |bend: f64| -> Vec<Motion> {
            let bends = [
                random.vector() * bend,
                random.vector() * bend,
                random.vector() * bend,
            ];
            let at = |[x, y]: [f64; 2]| {
                let flat = Vector6::new(0.7 * x, 0.6 * y, 0.0, 0.0, 0.0, 0.0);
                start.increment(&(flat + bends[0] * x + bends[1] * y + bends[2] * (x * y)))
            };
            grid.places().map(at).collect()
        };
        let (reference, deformed) = (surface(0.2), surface(0.3));
        let frames: Vec<Motion> = reference.iter().map(|_| random.motion()).collect();
        let on_nodes = |surface: Vec<Motion>| -> Vec<Motion> {
            let both = surface.iter().zip(&frames);
            both.map(|(m, frame)| m.compose(&frame.inverse())).collect()
        };
        let (reference, deformed) = (on_nodes(reference), on_nodes(deformed));
        let deformed: Vec<Motion> = deformed
            .iter()
            .map(|m| m.increment(&(random.vector() * 0.1)))
            .collect();
        let states = states(deformed, random);
        let section = ShellSection {
            stiffness: law(random, 7.0),
            damping: law(random, 0.3),
            mass: random.positive_definite(),
        };
        for damped in [true, false] {
            let damping = section.damping * f64::from(u8::from(damped));
            let section = ShellSection { damping, ..section };
            let nodes = ((0..grid.count()).collect(), sides);
            let motions = (reference.clone(), frames.clone());
            let shell = Shell::new(nodes, motions, section, None).unwrap();
            let mut add = |name: &str, element: Box<dyn Element>| {
                cases.push(Case {
                    name: format!("{name}, {sides:?} nodes, damped {damped}"),
                    element,
                    states: states.clone(),
                    coordinates: vec![],
                });
            };
            add("shell inertia", Box::new(shell.inertia().unwrap()));
            for frame in [LoadFrame::Space, LoadFrame::Follower] {
                let signals = [0, 1, 2, 3, 4, 5].map(Some);
                let surface = shell.load(ShellLoadPlace::Surface, frame, signals);
                let name = format!("shell load {frame:?}");
                add(&name, Box::new(surface.unwrap()));
            }
            for edge in 0..4 {
                let signals = [0, 1, 2, 3, 4, 5].map(Some);
                let load = shell.load(ShellLoadPlace::Edge(edge), LoadFrame::Follower, signals);
                let load = load.unwrap();
                let of_edge = load.nodes().iter().map(|&node| states[node]).collect();
                cases.push(Case {
                    name: format!("load on edge {edge}, {sides:?} nodes"),
                    element: Box::new(load),
                    states: of_edge,
                    coordinates: vec![],
                });
            }
            for (name, law) in surface_force_test::laws().into_iter().filter(|_| damped) {
                for place in [ShellLoadPlace::Surface, ShellLoadPlace::Edge(1)] {
                    let new = SurfaceForce::on_shell((0, &shell), place, law.clone(), [1.0; 2]);
                    let element = new.unwrap();
                    let of_place = element.nodes().iter().map(|&node| states[node]).collect();
                    cases.push(Case {
                        name: format!("user's forces {place:?}, {sides:?} nodes, {name}"),
                        element: Box::new(element),
                        states: of_place,
                        coordinates: vec![],
                    });
                }
            }
            cases.push(Case {
                name: format!("shell, {sides:?} nodes, damped {damped}"),
                element: Box::new(shell),
                states: states.clone(),
                coordinates: vec![],
            });
        }
    }
}

/// Relations between coordinates of joints in a chain, to the ground, and of one joint.
fn relation_cases(
    random: &mut Random,
    states: &impl Fn(Vec<Motion>, &mut Random) -> Vec<NodeState>,
    cases: &mut Vec<Case>,
) {
    use Coordinate::{Displacement1, Rotation1, Rotation2};
    let motions: Vec<Motion> = (0..3).map(|_| random.motion()).collect();
    // Open by half a unit: far from where angles are undefined.
    let mut joint = |kind, ends: [Option<usize>; 2]| {
        let frame = random.motion();
        let frames = [frame, frame.increment(&(random.vector() * 0.5))];
        let attach = |end: usize| Attachment {
            node: ends[end],
            offset: ends[end].map_or(frames[end], |n: usize| motions[n].relative(&frames[end])),
        };
        Joint::new(kind, attach(0), attach(1))
    };
    let chain = [
        (joint(JointKind::Revolute, [None, Some(0)]), Rotation1, 0.7),
        (
            joint(JointKind::Cylindrical, [Some(2), Some(0)]),
            Displacement1,
            -1.0,
        ),
        (
            joint(JointKind::Universal, [Some(1), Some(2)]),
            Rotation2,
            0.4,
        ),
        (joint(JointKind::Planar, [Some(1), None]), Rotation1, 1.3),
    ];
    let one = joint(JointKind::Cylindrical, [Some(1), Some(0)]);
    let of_one = [(one.clone(), Displacement1, 1.0), (one, Rotation1, -0.3)];
    for (name, terms) in [("chain to None", &chain[..]), ("of one joint", &of_one)] {
        let terms = terms.iter().enumerate();
        let terms = terms.map(|(place, (joint, which, b))| {
            (ActedCoordinate::new(joint, *which, place, None, 0.0), *b)
        });
        let relation = Relation::new(terms.collect(), (1, 0.8), Measure::Length);
        let of_nodes = relation.nodes().iter().map(|&node| motions[node]).collect();
        cases.push(Case {
            name: format!("relation, {name}"),
            element: Box::new(relation),
            states: states(of_nodes, random),
            coordinates: vec![7.0, -3.0, 0.0, 20.0],
        });
    }
}

fn cases() -> Vec<Case> {
    let mut random = Random(42);
    let mut cases = Vec::new();
    let states = |motions: Vec<Motion>, random: &mut Random| -> Vec<NodeState> {
        motions
            .into_iter()
            .map(|motion| NodeState {
                motion,
                twist: random.vector(),
                twist_rate: random.vector(),
            })
            .collect()
    };

    // Rigid body with a full inertia at an offset.
    let inertia = random.positive_definite();
    cases.push(Case {
        name: "rigid body".into(),
        element: Box::new(Inertia::rigid_body(0, &random.motion(), &inertia)),
        states: states(vec![random.motion()], &mut random),
        coordinates: vec![],
    });

    // One that spins about an axis through its centre, which is off the node.
    let mut own = Random(43);
    let axis = own.vector().fixed_rows::<3>(0).normalize();
    let centre = own.vector().fixed_rows::<3>(0).into_owned();
    let symmetric = Matrix3::identity() * 0.7 + axis * axis.transpose() * 0.6;
    let inertia = rigid_body_inertia(1.9, &centre, &symmetric);
    let twist = DualVector::of_turn(&(axis * 3.0), &centre).to_twist();
    let body = Inertia::rigid_body(0, &Motion::identity(), &inertia);
    cases.push(Case {
        name: "spinning body".into(),
        element: Box::new(body.spinning(&[twist])),
        states: states(vec![own.motion()], &mut own),
        coordinates: vec![],
    });

    // Beams of 2 to 7 nodes, curved in the reference, bent and twisted, with full sections.
    for count in 2..=7 {
        let start = random.motion();
        let curve = |bend: Vector6<f64>| -> Vec<Motion> {
            lobatto_points(count)
                .into_iter()
                .map(|x| {
                    let s = 0.5 * (x + 1.0);
                    let straight = Vector6::new(1.3, 0.0, 0.0, 0.0, 0.0, 0.0);
                    start.increment(&(straight * s + bend * (s * s)))
                })
                .collect()
        };
        let reference = curve(random.vector() * 0.4);
        let deformed = curve(random.vector() * 0.6);
        let section = Section {
            stiffness: random.positive_definite() * 7.0,
            mass: random.positive_definite(),
            damping: random.positive_definite() * 0.3,
        };
        // The section changes along the element, with a corner.
        let other = |random: &mut Random| Section {
            stiffness: random.positive_definite() * 5.0,
            mass: random.positive_definite(),
            damping: random.positive_definite() * 0.2,
        };
        let inside = [(-0.2, other(&mut random))];
        let sections = SectionLine::new(section, &inside, other(&mut random));
        let beam = Beam::new((0..count).collect(), reference, sections).unwrap();
        let deformed: Vec<Motion> = deformed
            .iter()
            .map(|m| m.increment(&(random.vector() * 0.1)))
            .collect();
        let states = states(deformed, &mut random);
        for (name, element) in [
            (
                "beam inertia",
                Box::new(beam.inertia().unwrap()) as Box<dyn Element>,
            ),
            ("beam", Box::new(beam.clone())),
        ] {
            cases.push(Case {
                name: format!("{name}, {count} nodes"),
                element,
                states: states.clone(),
                coordinates: vec![],
            });
        }
        // A straight shaft that tapers, or not, and spins.
        let round = |seconds: f64, thick: f64| {
            let stiffness = Vector6::new(9.0, 3.0, 3.0, 2.0, 2.5, 2.5) * thick;
            let damping = Vector6::new(4.0, 2.0, 2.0, 1.0, 3.0, 3.0) * seconds;
            Section {
                stiffness: Matrix6::from_diagonal(&stiffness),
                mass: Matrix6::from_diagonal(&Vector6::new(3.0, 3.0, 3.0, 0.4, 0.2, 0.2)),
                damping: Matrix6::from_diagonal(&damping),
            }
        };
        let straight: Vec<Motion> = lobatto_points(count)
            .into_iter()
            .map(|x| start.increment(&Vector6::new(0.65 * (x + 1.0), 0.0, 0.0, 0.0, 0.0, 0.0)))
            .collect();
        for (name, end) in [("even", round(0.4, 1.0)), ("tapered", round(0.2, 0.6))] {
            let sections = SectionLine::new(round(0.4, 1.0), &[], end);
            let shaft = Beam::new((0..count).collect(), straight.clone(), sections);
            let shaft = shaft.unwrap().spinning(1.7);
            let inertia = Box::new(shaft.inertia().unwrap()) as Box<dyn Element>;
            let at_rest = states.iter().map(|state| NodeState::at_rest(state.motion));
            cases.push(Case {
                name: format!("{name} spinning shaft at rest, {count} nodes"),
                element: Box::new(shaft.clone()),
                states: at_rest.collect(),
                coordinates: vec![],
            });
            for (element, what) in [(inertia, "inertia"), (Box::new(shaft), "shaft")] {
                cases.push(Case {
                    name: format!("{name} spinning {what}, {count} nodes"),
                    element,
                    states: states.clone(),
                    coordinates: vec![],
                });
            }
        }
        let across = random.vector().fixed_rows::<3>(3).into_owned();
        let untwisted = BeamLoadFrame::Untwisted(across);
        for frame in [BeamLoadFrame::Space, BeamLoadFrame::Follower, untwisted] {
            let signals = [0, 1, 2, 3, 4, 5].map(Some);
            let places = [(-1.0, 0.5), (0.1, -2.0), (0.1, 1.0), (1.0, 3.0)];
            let mut load = DistributedLoad::new(&beam).unwrap();
            load.add(&beam, frame, signals, &places).unwrap();
            cases.push(Case {
                name: format!("distributed load {frame:?}, {count} nodes"),
                element: Box::new(load),
                states: states.clone(),
                coordinates: vec![],
            });
        }
        for frame in [LoadFrame::Space, LoadFrame::Follower] {
            let signals = [0, 1, 2, 3, 4, 5].map(Some);
            let offset = Vector3::new(0.2, -0.5, 0.9);
            let load = DistributedLoad::at_place(&beam, 0.37, &offset, frame, signals).unwrap();
            cases.push(Case {
                name: format!("load at a place {frame:?}, {count} nodes"),
                element: Box::new(load),
                states: states.clone(),
                coordinates: vec![],
            });
        }
        let places = [ForcePlace::Line, ForcePlace::UntwistedLine(across)];
        let laws = surface_force_test::laws().into_iter();
        for ((name, law), place) in laws.flat_map(|law| places.map(|place| (law.clone(), place))) {
            let force = SurfaceForce::along_beam((0, &beam), place, law, [1.0; 2]);
            cases.push(Case {
                name: format!("user's forces along a beam {place:?}, {count} nodes, {name}"),
                element: Box::new(force.unwrap()),
                states: states.clone(),
                coordinates: vec![],
            });
        }
    }

    shell_cases(&mut Random(11), &states, &mut cases);
    relation_cases(&mut Random(17), &states, &mut cases);
    controller_cases(&mut Random(23), &states, &mut cases);
    let mut unsymmetric = Random(19);

    // Every joint, and what attaches to its coordinates, between two nodes or a node and the
    // ground.
    for kind in relative::ALL_KINDS {
        for (first, second) in [(Some(0), Some(1)), (None, Some(0)), (Some(0), None)] {
            let offsets = [random.motion(), random.motion()];
            let joint = Joint::new(
                kind,
                Attachment {
                    node: first,
                    offset: offsets[0],
                },
                Attachment {
                    node: second,
                    offset: offsets[1],
                },
            );
            let matrix = random.positive_definite();
            // The points of a strut are apart.
            let gap = match kind {
                JointKind::Strut => Vector6::x() * 2.0,
                _ => Vector6::zeros(),
            };
            let mut add = |name: &str, element: Box<dyn Element>| {
                // Open by half a unit: far from closed, but not near where angles are undefined.
                let frame = if first.is_none() {
                    offsets[0]
                } else {
                    random.motion()
                };
                let other = if second.is_none() {
                    offsets[1]
                } else {
                    frame.increment(&(random.vector() * 0.5 + gap))
                };
                let frame = if second.is_none() {
                    other.increment(&(random.vector() * 0.5 + gap))
                } else {
                    frame
                };
                let node_at = |frame: Motion, offset: &Motion| frame.compose(&offset.inverse());
                let motions = first
                    .map(|_| node_at(frame, &offsets[0]))
                    .into_iter()
                    .chain(second.map(|_| node_at(other, &offsets[1])))
                    .collect();
                cases.push(Case {
                    name: format!("{name} {} {first:?} {second:?}", kind.name()),
                    element,
                    states: states(motions, &mut random),
                    coordinates: vec![7.0],
                });
            };
            add("joint", Box::new(joint.clone()));
            let ends = [first, second].map(|node| Attachment {
                node,
                offset: offsets[usize::from(node.is_none())],
            });
            let damper = ViscousDamper::new(ends[0], ends[1], matrix);
            add("damper", Box::new(damper));
            if kind == JointKind::Free {
                // Unsymmetric.
                let matrix = |random: &mut Random| Matrix6::from_fn(|_, _| random.next());
                let (mut stiffness, damping) = (matrix(&mut unsymmetric), matrix(&mut unsymmetric));
                let ends = [0, 1].map(|end| Attachment {
                    node: [first, second][end],
                    offset: offsets[end],
                });
                let mut bushing = |name: &str, matrices, angles| {
                    let bushing = Bushing::new(ends[0], ends[1], matrices, angles);
                    add(name, Box::new(bushing));
                };
                let angles = BushingAngles::RotationVector;
                bushing("bushing", [stiffness, damping], angles);
                bushing("bushing, undamped", [stiffness, Matrix6::zeros()], angles);
                stiffness.set_column(5, &Vector6::zeros());
                bushing("bearing", [stiffness, damping], BushingAngles::TiltAndSpin);
            }
            for &coordinate in kind.coordinates() {
                add(
                    "prescribed",
                    Box::new(Prescribed::new(&joint, coordinate, 3)),
                );
                let mut force = |name: &str, law: Law| {
                    add(
                        name,
                        Box::new(CoordinateForce::new(
                            ActedCoordinate::new(&joint, coordinate, 0, None, 0.0),
                            law,
                        )),
                    );
                };
                let polynomial = |stiffness: &[f64], damping: &[f64]| Law::Polynomial {
                    stiffness: stiffness.to_vec(),
                    damping: damping.to_vec(),
                    rest: 0.2,
                };
                force("spring", polynomial(&[3.0], &[]));
                force("spring and damper", polynomial(&[3.0], &[0.7]));
                force(
                    "nonlinear spring",
                    polynomial(&[3.0, -0.2, 0.1], &[0.7, 0.3]),
                );
                force("actuator", Law::Actuator { signal: 2 });
                let law = CoordinateLaw {
                    function: std::sync::Arc::new(coordinate_law),
                    gives_derivatives: true,
                };
                let scales = [1.0, 1.0];
                force("user's law", Law::Function { law, scales });
                let branch = |stiffness, relaxation_time| MaxwellBranch {
                    stiffness,
                    relaxation_time,
                };
                let branches = vec![branch(1.3, 0.4), branch(0.6, 2.0)];
                add(
                    "viscoelastic",
                    Box::new(Viscoelastic::new(
                        ActedCoordinate::new(&joint, coordinate, 0, None, 0.0),
                        0.8,
                        0.2,
                        branches,
                    )),
                );
            }
        }
    }

    for frame in [LoadFrame::Space, LoadFrame::Follower] {
        for gives_tangents in [true, false] {
            let law = NodeForceLaw {
                function: std::sync::Arc::new(move |input, output| {
                    node_forces(frame, input, output)
                }),
                gives_tangents,
                frame,
            };
            let motions = vec![random.motion(), random.motion()];
            cases.push(Case {
                name: format!(
                    "user's forces {frame:?}{}",
                    if gives_tangents { "" } else { ", differenced" }
                ),
                element: Box::new(UserForce::new(vec![0, 1], law, 1.0, 1.0)),
                states: states(motions, &mut random),
                coordinates: vec![],
            });
        }
        for gives_tangents in [true, false] {
            let law = NodeForceLaw {
                function: std::sync::Arc::new(move |input, output| {
                    forces_of_nodes_apart(frame, input, output)
                }),
                gives_tangents,
                frame,
            };
            let motions = vec![random.motion(), random.motion(), random.motion()];
            let differenced = if gives_tangents { "" } else { ", differenced" };
            let force = UserForce::new(vec![0, 1, 2], law, 1.0, 1.0);
            cases.push(Case {
                name: format!("user's forces on nodes apart, {frame:?}{differenced}"),
                element: Box::new(force.with_nodes_apart(true)),
                states: states(motions, &mut random),
                coordinates: vec![],
            });
        }
        cases.push(Case {
            name: format!("load {frame:?}"),
            element: Box::new(NodalLoad::new(
                0,
                Vector3::new(0.4, -0.7, 1.1),
                frame,
                [0, 1, 2, 3, 4, 5].map(Some),
            )),
            states: states(vec![random.motion()], &mut random),
            coordinates: vec![],
        });
    }
    cases.push(Case {
        name: "cable".into(),
        element: Box::new(Cable {
            length: 1.7,
            stiffness: 5.0,
        }),
        states: states(vec![random.motion(), random.motion()], &mut random),
        coordinates: vec![],
    });
    cases
}

/// Controllers that read the ways of three bodies and act on two of them and on the ground.
fn controller_cases(
    random: &mut Random,
    states: &impl Fn(Vec<Motion>, &mut Random) -> Vec<NodeState>,
    cases: &mut Vec<Case>,
) {
    for (count, gives_tangents) in [(0, true), (0, false), (2, true), (2, false)] {
        let motions: Vec<Motion> = (0..3).map(|_| random.motion()).collect();
        let pairs = [(None, Some(0)), (Some(1), Some(0)), (Some(2), Some(1))];
        let mut joint = |(first, second): (Option<usize>, Option<usize>)| {
            // Open by less than what makes angles jump.
            let frame = |node: Option<usize>| node.map_or(Motion::identity(), |n| motions[n]);
            let middle = frame(second).increment(&(random.vector() * 0.2));
            let end = |node: Option<usize>, near: Motion| Attachment {
                node,
                offset: frame(node).relative(&near),
            };
            let far = middle.increment(&(random.vector() * 0.3));
            Joint::new(JointKind::Cylindrical, end(first, middle), end(second, far))
        };
        let joints = pairs.map(&mut joint);
        let at = |joint: usize, coordinate| {
            ActedCoordinate::new(&joints[joint], coordinate, 0, None, 0.0)
        };
        let (turn, slide) = (Coordinate::Rotation1, Coordinate::Displacement1);
        let inputs = vec![at(0, turn), at(1, slide), at(2, turn)];
        let outputs = vec![at(0, slide), at(1, slide)];
        let law = ControllerLaw {
            function: std::sync::Arc::new(move |input, output| {
                control(count, input, output);
                Ok(())
            }),
            gives_tangents,
        };
        let of_size = |size| ControllerState { initial: 0.0, size };
        let list = [0.4, 3.0].map(of_size)[..count].to_vec();
        let element = Controller::new(inputs, outputs, list, law, vec![[1.0; 2]; 3]);
        let differenced = if gives_tangents { "" } else { ", differenced" };
        cases.push(Case {
            name: format!("controller, {count} states{differenced} None"),
            element: Box::new(element),
            states: states(motions.clone(), random),
            coordinates: vec![7.0],
        });
    }
}

/// `e₀ = q₀ q̇₁ + x₁², e₁ = sin q₂ − x₀ q̇₀; ẋ₀ = q̇₂² x₁ − q₁ x₀, ẋ₁ = t q₀ q̇₁ − x₀`; without
/// states what is left.
fn control(states: usize, input: &ControllerInput, output: &mut ControllerOutput) {
    let (q, v) = (input.values, input.rates);
    let mut x = [0.0; 2];
    x[..states].copy_from_slice(input.states);
    output.efforts[0] = q[0] * v[1] + x[1] * x[1];
    output.efforts[1] = q[2].sin() - x[0] * v[0];
    let rates = [
        v[2] * v[2] * x[1] - q[1] * x[0],
        input.time * q[0] * v[1] - x[0],
    ];
    output.state_rates.copy_from_slice(&rates[..states]);
    let Some([by_value, by_rate, by_state]) = &mut output.tangents else {
        return;
    };
    by_value[(0, 0)] = v[1];
    by_rate[(0, 1)] = q[0];
    by_value[(1, 2)] = q[2].cos();
    by_rate[(1, 0)] = -x[0];
    if states == 0 {
        return;
    }
    by_state[(0, 1)] = 2.0 * x[1];
    by_state[(1, 0)] = -v[0];
    by_rate[(2, 2)] = 2.0 * v[2] * x[1];
    by_state[(2, 1)] = v[2] * v[2];
    by_value[(2, 1)] = -x[0];
    by_state[(2, 0)] = -q[1];
    by_value[(3, 0)] = input.time * v[1];
    by_rate[(3, 1)] = input.time * q[0];
    by_state[(3, 0)] = -1.0;
}

/// A user's law with derivatives.
fn coordinate_law(at: &CoordinateState) -> Result<Effort> {
    let CoordinateState { time, value, rate } = *at;
    Ok(Effort {
        value: (value + time).sin() * rate * rate + 0.3 * value,
        by_coordinate: (value + time).cos() * rate * rate + 0.3,
        by_rate: 2.0 * (value + time).sin() * rate,
    })
}

/// A user's forces on two nodes, of positions, axes and velocities, whatever the axes of these.
/// With `d = r₀ − r₁` and `a = R₀ e₁`: `F₀ = [d² v₁ + a × ω₀; (a·d) d]`,
/// `F₁ = [−F₀ force; v₀² ω₁]`.
fn node_forces(
    frame: LoadFrame,
    input: &NodeForceInput,
    output: &mut NodeForceOutput,
) -> Result<()> {
    let half = |v: &Vector6<f64>, first| v.fixed_rows::<3>(first).into_owned();
    let d = input.positions[0] - input.positions[1];
    let a = input.rotations[0].column(0).into_owned();
    let (v0, w0) = (half(&input.velocities[0], 0), half(&input.velocities[0], 3));
    let (v1, w1) = (half(&input.velocities[1], 0), half(&input.velocities[1], 3));
    let force = v1 * d.dot(&d) + a.cross(&w0);
    let rows = [force, d * a.dot(&d), -force, w1 * v0.dot(&v0)];
    for (i, row) in rows.iter().enumerate() {
        output.forces[i / 2]
            .fixed_rows_mut::<3>(3 * (i % 2))
            .copy_from(row);
    }
    let Some((stiffness, damping)) = &mut output.tangents else {
        return Ok(());
    };
    let mut set = |damped: bool, row: usize, column: usize, block: Matrix3<f64>| {
        let matrix = if damped {
            &mut *damping
        } else {
            &mut *stiffness
        };
        let node = input.rotations[column / 2];
        // Increments along the node's axes are those in space, turned.
        let block = match frame {
            LoadFrame::Follower if !damped => block * node,
            _ => block,
        };
        matrix
            .fixed_view_mut::<3, 3>(3 * row, 3 * column)
            .copy_from(&block);
    };
    let identity = Matrix3::identity();
    // Columns: displacement and turn of node 0, then of node 1.
    let by_d = v1 * d.transpose() * 2.0;
    let by_turn = skew(&w0) * skew(&a);
    let moment_by_d = d * a.transpose() + identity * a.dot(&d);
    for (row, sign) in [(0, 1.0), (2, -1.0)] {
        set(false, row, 0, by_d * sign);
        set(false, row, 2, -by_d * sign);
        set(false, row, 1, by_turn * sign);
        set(true, row, 1, skew(&a) * sign);
        set(true, row, 2, identity * (d.dot(&d) * sign));
    }
    set(false, 1, 0, moment_by_d);
    set(false, 1, 2, -moment_by_d);
    set(false, 1, 1, d * a.cross(&d).transpose());
    set(true, 3, 0, w1 * v0.transpose() * 2.0);
    set(true, 3, 3, identity * v0.dot(&v0));
    Ok(())
}

/// A user's forces on nodes, each of its own motion: with `a = R e₁`,
/// `F = [r² v + a × ω; (a·r) r]`.
fn forces_of_nodes_apart(
    frame: LoadFrame,
    input: &NodeForceInput,
    output: &mut NodeForceOutput,
) -> Result<()> {
    let half = |v: &Vector6<f64>, first| v.fixed_rows::<3>(first).into_owned();
    for (node, rotation) in input.rotations.iter().enumerate() {
        let (r, a) = (input.positions[node], rotation.column(0).into_owned());
        let (v, w) = (
            half(&input.velocities[node], 0),
            half(&input.velocities[node], 3),
        );
        for (i, row) in [v * r.dot(&r) + a.cross(&w), r * a.dot(&r)]
            .iter()
            .enumerate()
        {
            let mut rows = output.forces[node].fixed_rows_mut::<3>(3 * i);
            rows.copy_from(row);
        }
        let Some((stiffness, damping)) = &mut output.tangents else {
            continue;
        };
        let identity = Matrix3::identity();
        let by_motion = [
            [v * r.transpose() * 2.0, skew(&w) * skew(&a)],
            [
                r * a.transpose() + identity * a.dot(&r),
                r * a.cross(&r).transpose(),
            ],
        ];
        let axes = match frame {
            LoadFrame::Follower => *rotation,
            LoadFrame::Space => identity,
        };
        for (i, blocks) in by_motion.iter().enumerate() {
            for (j, block) in blocks.iter().enumerate() {
                let mut view = stiffness.fixed_view_mut::<3, 3>(6 * node + 3 * i, 3 * j);
                view.copy_from(&(block * axes));
            }
        }
        let by_velocity = [identity * r.dot(&r), skew(&a)];
        for (j, block) in by_velocity.iter().enumerate() {
            let mut view = damping.fixed_view_mut::<3, 3>(6 * node, 3 * j);
            view.copy_from(block);
        }
    }
    Ok(())
}

/// Changes states, or own unknowns and their rates, by a step.
type Change<'a> = dyn Fn(f64, &mut Vec<NodeState>, &mut (Vec<f64>, Vec<f64>)) + 'a;

/// All forces and constraints.
fn residual(
    case: &Case,
    states: &[NodeState],
    multipliers: &[f64],
    rates: &[f64],
    tangents: bool,
) -> Contribution {
    let mut out = Contribution::of(&*case.element, tangents);
    let instant = Instant {
        time: 0.6,
        nodes: states,
        multipliers,
        multiplier_rates: rates,
        resultants: &[],
        signals: &[0.3, -0.8, 0.5, 0.9, 0.2, -0.4],
        coordinates: &case.coordinates,
        gravity: Vector3::new(0.3, -0.5, -9.0),
        inertial: InertialForces {
            factor: 0.9,
            damping: 0.7,
        },
    };
    case.element.evaluate(&instant, &mut out).unwrap();
    out
}

#[test]
fn tangents_are_the_derivatives_of_forces() {
    for case in cases() {
        let nodes = case.states.len();
        let count = case.element.own_unknowns();
        assert_eq!(case.element.nodes().len(), nodes);
        let multipliers: Vec<f64> = (0..count).map(|m| 0.7 - 0.3 * m as f64).collect();
        let rates: Vec<f64> = (0..count).map(|m| 0.2 + 0.4 * m as f64).collect();
        let exact = residual(&case, &case.states, &multipliers, &rates, true);

        // Central differences of fourth order: the error, about h⁴ + ε/h, is near 1e-11.
        let h = 2e-3;
        let difference = |change: &Change| {
            let at = |step: f64| {
                let mut states = case.states.clone();
                let mut own = (multipliers.clone(), rates.clone());
                change(step, &mut states, &mut own);
                residual(&case, &states, &own.0, &own.1, false)
            };
            let (a, b, c, d) = (at(h), at(-h), at(2.0 * h), at(-2.0 * h));
            let slope = |f: &dyn Fn(&Contribution) -> DVector<f64>| {
                ((f(&a) - f(&b)) * 8.0 - (f(&c) - f(&d))) / (12.0 * h)
            };
            (
                slope(&|x| x.force.clone()),
                slope(&|x| x.constraint.clone()),
            )
        };
        let check = |what: &str, exact: DVector<f64>, found: &DVector<f64>, scale: f64| {
            let error = (&exact - found).amax();
            // Differences of second order leave about ε^(2/3).
            let differenced = case.name.contains("differenced");
            let tolerance = if differenced { 1e-8 } else { 1e-9 };
            assert!(
                error <= tolerance * scale.max(1.0),
                "{}: {what}: error {error:e} against {scale:e}",
                case.name
            );
        };

        for column in 0..6 * nodes {
            let (node, k) = (column / 6, column % 6);
            let unit = |step: f64| Vector6::from_fn(|i, _| if i == k { step } else { 0.0 });
            let column_of = |tangent: &DMatrix<f64>| match case.element.couples_nodes() {
                true => tangent.column(column).into_owned(),
                false => {
                    let mut own = DVector::zeros(6 * nodes);
                    let rows = tangent.fixed_view::<6, 1>(6 * node, k);
                    own.fixed_rows_mut::<6>(6 * node).copy_from(&rows);
                    own
                }
            };
            let (force, constraint) = difference(&|step, states, _| {
                states[node].motion = states[node].motion.increment(&unit(step));
            });
            let scale = exact.stiffness.amax();
            check("stiffness", column_of(&exact.stiffness), &force, scale);
            check(
                "gradient",
                exact.gradient.column(column).into_owned(),
                &constraint,
                1.0,
            );
            let (force, constraint) =
                difference(&|step, states, _| states[node].twist += unit(step));
            let by_velocity = match exact.gradient_rate.is_empty() {
                true => DVector::zeros(count),
                false => exact.gradient_rate.column(column).into_owned(),
            };
            check("gradient by velocity", by_velocity, &constraint, 1.0);
            let scale = exact.damping.amax();
            check("damping", column_of(&exact.damping), &force, scale);
            let (force, _) = difference(&|step, states, _| states[node].twist_rate += unit(step));
            check("mass", column_of(&exact.mass), &force, exact.mass.amax());
        }
        for row in 0..count {
            let (force, constraint) = difference(&|step, _, own| own.0[row] += step);
            let scale = exact.own.amax();
            check(
                "multiplier",
                exact.by_own().row(row).transpose(),
                &force,
                1.0,
            );
            check(
                "own",
                exact.own.column(row).into_owned(),
                &constraint,
                scale,
            );
            let (force, constraint) = difference(&|step, _, own| own.1[row] += step);
            let scale = exact.own_rate.amax();
            check(
                "own rate",
                exact.own_rate.column(row).into_owned(),
                &constraint,
                scale,
            );
            assert_eq!(force.amax(), 0.0, "{}", case.name);
        }
        assert!(
            case.element.has_states() || exact.own.amax() + exact.own_rate.amax() == 0.0,
            "{}",
            case.name
        );
        assert!(
            case.element.has_mass() || exact.mass.amax() == 0.0,
            "{}",
            case.name
        );
        assert!(
            case.element.has_damping() || exact.damping.amax() == 0.0,
            "{}",
            case.name
        );
    }
}

#[test]
fn extrapolated_resultants_are_tangent_to_those_of_the_strains() {
    for case in cases() {
        let still = case.states.clone();
        let (element, stations) = (&case.element, case.element.stress_laws().len());
        let mut scratch = Contribution::of(&**element, false);
        let mut random = Random(5);
        let mut increment = || random.motion().logarithm() * 0.1;
        let increments: Vec<_> = still.iter().map(|_| [increment(), increment()]).collect();
        let mut there = vec![Vector6::zeros(); stations];
        element
            .extrapolate_resultants(&still, &increments, &mut scratch, &mut there)
            .unwrap();
        let mut resultants = |states: &[NodeState]| {
            let mut out = vec![Vector6::zeros(); stations];
            let found = element.stress_resultants(states, &mut scratch, &mut out);
            found.unwrap();
            out
        };
        let mut at = |step: f64| {
            let mut moved = still.clone();
            for (state, [u, velocity]) in moved.iter_mut().zip(&increments) {
                state.motion = state.motion.increment(&(u * step));
                state.twist += velocity * step;
            }
            resultants(&moved)
        };
        // Fourth order, as above.
        let h = 2e-3;
        let differences = [at(h), at(-h), at(2.0 * h), at(-2.0 * h)];
        let here = at(0.0);
        for s in 0..stations {
            let [a, b, c, d] = differences.each_ref().map(|all| all[s]);
            let slope = ((a - b) * 8.0 - (c - d)) / (12.0 * h);
            let error = (there[s] - here[s] - slope).amax();
            assert!(error <= 1e-9 * slope.amax(), "{}: {error:e}", case.name);
        }

        // Where they are those of the strains, so is the geometric stiffness.
        let mut exact = Contribution::of(&**element, true);
        let mut found = exact.clone();
        let multipliers = vec![0.7; case.element.own_unknowns()];
        for (resultants, out) in [(&[][..], &mut exact), (&here, &mut found)] {
            let instant = Instant {
                time: 0.6,
                nodes: &still,
                multipliers: &multipliers,
                multiplier_rates: &multipliers,
                resultants,
                signals: &[0.3, -0.8, 0.5, 0.9, 0.2, -0.4],
                coordinates: &case.coordinates,
                gravity: Vector3::zeros(),
                inertial: InertialForces::FULL,
            };
            case.element.evaluate(&instant, out).unwrap();
        }
        let error = (&found.stiffness - &exact.stiffness).amax();
        assert!(
            error <= 1e-14 * exact.stiffness.amax(),
            "{}: {error:e}",
            case.name
        );
    }
}

#[test]
fn forces_do_not_depend_on_the_observer() {
    // A rigid motion of everything leaves forces in material frames and constraints as they are;
    // loads, gravity and joints to the ground do depend on it, and are left out.
    let mut random = Random(7);
    let shift = random.motion();
    for case in cases() {
        let attached = ["None", "Space", "user's forces"]
            .iter()
            .any(|word| case.name.contains(word));
        if attached || case.name.contains("inertia") || case.name.contains("body") {
            continue;
        }
        let multipliers = vec![0.4; case.element.own_unknowns()];
        let moved: Vec<NodeState> = case
            .states
            .iter()
            .map(|s| NodeState {
                motion: shift.compose(&s.motion),
                ..*s
            })
            .collect();
        let here = residual(&case, &case.states, &multipliers, &multipliers, false);
        let there = residual(&case, &moved, &multipliers, &multipliers, false);
        let scale = here.force.amax().max(1.0);
        assert!(
            (here.force - there.force).amax() < 1e-13 * scale,
            "{}",
            case.name
        );
        assert!(
            (here.constraint - there.constraint).amax() < 1e-13,
            "{}",
            case.name
        );
    }
}

#[test]
fn beams_are_unstrained_by_rigid_motions_and_their_mass_is_exact() {
    let mut random = Random(3);
    let turn = random.motion();
    let reference: Vec<Motion> = lobatto_points(4)
        .into_iter()
        .map(|x| Motion::identity().increment(&(Vector6::new(1.0, 0.0, 0.0, 0.2, 0.5, 0.1) * x)))
        .collect();
    let mut section = Section {
        stiffness: Matrix6::identity() * 1e8,
        mass: Matrix6::zeros(),
        damping: Matrix6::zeros(),
    };
    section
        .mass
        .fixed_view_mut::<3, 3>(0, 0)
        .copy_from(&(Matrix3::identity() * 2.0));
    let beam = Beam::new((0..4).collect(), reference.clone(), section).unwrap();
    let moved = reference
        .iter()
        .map(|m| NodeState::at_rest(turn.compose(m)));
    let moved: Vec<NodeState> = moved.collect();
    let (strain, _) = beam.strain_and_stress(0.3, &moved).unwrap();
    assert!(strain.amax() < 1e-14);
    // The curve is a screw of length 2, interpolated to this accuracy.
    let (mass, _) = beam.inertia().unwrap().mass_and_moment(&reference);
    assert!((mass - 4.0).abs() < 1e-5, "{mass}");
}
