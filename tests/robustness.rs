//! Random models, many of them absurd: whatever the user describes, nothing panics, nothing hangs,
//! and no number that is not finite is ever given as a result.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use periodyn::elements::{Coordinate, JointKind, LoadFrame};
use periodyn::error::{ErrorKind, Result};
use periodyn::model::{JointCoordinate, Model, SectionInput, Signal, SpringDefinition};
use periodyn::motion::{Motion, rotation_from_vector};
use periodyn::output::{BeamQuantity, JointQuantity, NodeQuantity, ResolvedIn, Solution};
use periodyn::solve::PeriodicOptions;

struct Random {
    state: u64,
    /// One number in so many is extreme.
    oddity: usize,
}

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.state = self
            .state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((self.state >> 33) as usize) % n
    }

    /// Mostly ordinary numbers, some of them extreme.
    fn number(&mut self) -> f64 {
        const ODD: [f64; 10] = [
            0.0,
            -1.0,
            1e-300,
            1e300,
            -1e300,
            1e-12,
            1e12,
            f64::MAX,
            1e-160,
            1e160,
        ];
        if self.below(self.oddity) == 0 {
            ODD[self.below(ODD.len())]
        } else {
            self.below(4001) as f64 / 1000.0 - 2.0
        }
    }

    fn positive(&mut self) -> f64 {
        self.number().abs() * [1.0, 1e3, 1e6][self.below(3)] + 1e-3
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.number())
    }

    fn motion(&mut self) -> Motion {
        Motion::new(rotation_from_vector(&self.vector()), self.vector())
    }

    fn signal(&mut self) -> Result<Signal> {
        let count = self.below(3);
        let mut several = || (0..count).map(|_| self.number()).collect::<Vec<f64>>();
        let (cosines, sines) = (several(), several());
        let rate = if self.below(3) == 0 {
            self.number()
        } else {
            0.0
        };
        match self.below(3) {
            0 => Signal::samples(rate, &[self.number(), self.number(), self.number()]),
            _ => Signal::harmonics(self.number(), rate, &cosines, &sines),
        }
    }

    fn body(&mut self, nodes: usize) -> Option<usize> {
        match self.below(nodes + 1) {
            0 => None,
            n => Some(n - 1),
        }
    }
}

/// A beam held at its first node: something that can be solved.
fn add_cantilever(model: &mut Model, random: &mut Random) -> Result<()> {
    let section = SectionInput::diagonal(&[1e6, 4e5, 4e5, 1e3, 2e3, 2e3], &[1.0, 0.1, 0.1, 0.1])?;
    let (start, across) = (random.vector(), random.vector());
    let end = start + random.vector();
    let beam = model.add_straight_beam(&start, &end, &across, &section, 2, 2)?;
    let frame = Model::frame_at("axis", &start, &across)?;
    model.add_joint(
        JointKind::Rigid,
        None,
        Some(beam.first_node),
        &frame,
        &frame,
    )?;
    Ok(())
}

/// Adds one thing; what the model refuses is left out.
fn add_something(model: &mut Model, random: &mut Random) -> Result<()> {
    const KINDS: [JointKind; 4] = [
        JointKind::Rigid,
        JointKind::Revolute,
        JointKind::Universal,
        JointKind::Spherical,
    ];
    const COORDINATES: [Coordinate; 3] = [
        Coordinate::Rotation1,
        Coordinate::Rotation2,
        Coordinate::Rotation3,
    ];
    let at = |random: &mut Random, joints: usize| JointCoordinate {
        joint: random.below(joints + 1),
        coordinate: COORDINATES[random.below(3) * random.below(2)],
    };
    let nodes = model.node_count();
    match random.below(9) {
        0 => {
            let inertia = Matrix3::from_diagonal(&Vector3::from_fn(|_, _| random.positive()));
            model.add_rigid_body(random.positive(), &random.vector(), &inertia)?;
        }
        1 => {
            let mut section = SectionInput {
                stiffness: Matrix6::from_diagonal(&Vector6::from_fn(|_, _| random.positive())),
                mass: Matrix6::identity() * random.number().abs(),
                damping: Matrix6::zeros(),
            };
            if random.below(2) == 0 {
                section.damping = section.stiffness * 0.01;
            }
            let (start, end, across) = (random.vector(), random.vector(), random.vector());
            let (elements, degree) = (1 + random.below(3), 1 + random.below(3));
            model.add_straight_beam(&start, &end, &across, &section, elements, degree)?;
        }
        2 => drop(model.add_node(&random.motion())?),
        3 | 4 => {
            let kind = KINDS[random.below(4)];
            let frame = random.motion();
            let other = if random.below(3) == 0 {
                random.motion()
            } else {
                frame
            };
            let (first, second) = (random.body(nodes), random.body(nodes));
            model.add_joint(kind, first, second, &frame, &other)?;
        }
        5 => {
            model.add_spring_damper(SpringDefinition {
                at: at(random, model.joint_count()),
                stiffness: random.number(),
                damping: random.number(),
                rest: random.number(),
            })?;
        }
        6 => drop(model.prescribe(at(random, model.joint_count()), &random.signal()?)?),
        7 => {
            let mut components: [Option<Signal>; 6] = Default::default();
            components[random.below(6)] = Some(random.signal()?);
            let frame = [LoadFrame::Space, LoadFrame::Follower][random.below(2)];
            model.add_load(random.below(nodes + 1), frame, components)?;
        }
        _ => {
            let component = |random: &mut Random| Signal::constant(random.number());
            model.set_gravity([component(random)?, component(random)?, component(random)?]);
        }
    }
    Ok(())
}

fn require_finite(what: &str, values: Result<Vec<f64>>) {
    if let Ok(values) = values {
        assert!(values.iter().all(|x| x.is_finite()), "{what}: {values:?}");
    }
}

#[test]
fn whatever_is_described_is_answered() {
    let mut random = Random {
        state: 20181,
        oddity: 1,
    };
    let mut outcomes = std::collections::BTreeMap::new();
    for _ in 0..600 {
        let mut model = Model::new();
        random.oddity = [12, 60, 1000][random.below(3)];
        if random.below(2) == 0 {
            let _ = add_cantilever(&mut model, &mut random);
        }
        for _ in 0..1 + random.below(8) {
            let _ = add_something(&mut model, &mut random);
        }
        let mut options = PeriodicOptions::with_grid_points(1 + 2 * random.below(3));
        options.newton.iteration_limit = 8;
        let period = random.positive();
        let mut left = 300;
        let mut observe = |_, _: &_| {
            left -= 1;
            left > 0
        };
        let solution = match Solution::solve(&model, period, &options, &mut observe) {
            Ok(solution) => solution,
            Err(error) => {
                *outcomes.entry(format!("{:?}", error.kind())).or_insert(0) += 1;
                continue;
            }
        };
        *outcomes
            .entry(format!("{:?}", solution.outcome()))
            .or_insert(0) += 1;
        assert!(!solution.report().contains("NaN"), "{}", solution.report());
        let times = [0.0, 0.3 * period, -1.7 * period];
        for node in 0..model.node_count() {
            for quantity in [
                NodeQuantity::Position,
                NodeQuantity::RotationMatrix,
                NodeQuantity::Quaternion,
                NodeQuantity::Velocity,
                NodeQuantity::Acceleration,
            ] {
                require_finite("node", solution.node(node, quantity, &times));
            }
        }
        for joint in 0..model.joint_count() {
            for quantity in [
                JointQuantity::Coordinate(Coordinate::Rotation1),
                JointQuantity::Acceleration(Coordinate::Rotation1),
                JointQuantity::DrivingEffort(Coordinate::Rotation1),
                JointQuantity::Reaction(ResolvedIn::First),
            ] {
                require_finite("joint", solution.joint(joint, quantity, &times));
            }
        }
        for element in 0..model.beam_element_count() {
            require_finite(
                "beam",
                solution.beam(element, 0.2, BeamQuantity::Force, &times),
            );
        }
    }
    println!("{outcomes:?}");
    // The models are not so absurd that nothing is ever solved.
    assert!(
        outcomes.get("Converged").is_some_and(|n| *n >= 10),
        "{outcomes:?}"
    );
}

#[test]
fn bodies_as_heavy_as_numbers_go_are_taken_or_refused_but_not_by_half() {
    let mut model = Model::new();
    for inertia in [1.0, 1e200, 1e308, f64::MAX, f64::INFINITY] {
        let before = model.node_count();
        let tensor = Matrix3::from_diagonal_element(inertia);
        let added = model.add_rigid_body(1e10, &Vector3::x(), &tensor);
        assert_eq!(added.is_ok(), inertia.is_finite(), "{inertia}: {added:?}");
        assert_eq!(model.node_count() - before, usize::from(added.is_ok()));
    }
    // Its moment of inertia about the node is no number.
    let point = Matrix3::zeros();
    let refused = model.add_mass(0, 1.0, &Vector3::new(1e160, 0.0, 0.0), &point);
    assert_eq!(refused.unwrap_err().kind(), ErrorKind::NotFinite);
    assert_eq!(model.mass_and_moment().unwrap().0, 4e10);
}
