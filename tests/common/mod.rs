//! Models that several tests build, and how the tests solve and compare.

// Each test binary uses its own part of this module.
#![allow(dead_code)]

mod random;

#[allow(unused_imports)] // not all tests need it
pub use random::Random;

use nalgebra::{Matrix3, Matrix6, Vector3};
use periodyn::elements::{Coordinate, JointKind, LoadFrame, MaxwellBranch};
use periodyn::model::*;
use periodyn::motion::Motion;
use periodyn::output::{JointQuantity, NodeQuantity, Solution};
use periodyn::solve::*;
use std::f64::consts::TAU;

/// A mass, which is node 0, on a slide from the ground, and the slide's coordinate.
pub fn mass_on_a_slide(mass: f64, axis: &Vector3<f64>) -> (Model, JointCoordinate) {
    let mut model = Model::new();
    let body = model
        .add_rigid_body(mass, &Vector3::zeros(), &Matrix3::identity())
        .unwrap();
    let frame = Model::frame_at("axis", &Vector3::zeros(), axis).unwrap();
    let joint = model
        .add_joint(JointKind::Prismatic, None, Some(body), &frame, &frame)
        .unwrap();
    let at = JointCoordinate {
        joint,
        coordinate: Coordinate::Displacement1,
    };
    (model, at)
}

/// Holds a node where it is; gives the joint.
pub fn clamp(model: &mut Model, node: usize) -> usize {
    let frame = *model.node(node).unwrap();
    let held = model.add_joint(JointKind::Rigid, None, Some(node), &frame, &frame);
    held.unwrap()
}

/// A mass on a spring and a damper along z, driven by `F cos Ωt`: `m`, `k`, `c`, `F`.
pub const OSCILLATOR: [f64; 4] = [2.0, 50.0, 1.2, 3.0];

pub fn oscillator() -> (Model, usize) {
    let [mass, stiffness, damping, force] = OSCILLATOR;
    let (mut model, at) = mass_on_a_slide(mass, &Vector3::z());
    model
        .add_spring_damper(SpringDefinition {
            at,
            stiffness,
            damping,
            rest: 0.0,
        })
        .unwrap();
    model.add_actuator(at, &cosine(force)).unwrap();
    (model, at.joint)
}

/// Two rigid bodies that swing through large angles under gravity, driven at the shoulder; and the
/// elbow's joint.
pub fn double_pendulum() -> (Model, usize) {
    let mut model = Model::new();
    let spin = Matrix3::from_diagonal(&Vector3::new(0.02, 0.03, 0.01));
    let at = |z: f64| Vector3::new(0.0, 0.0, z);
    let first = model.add_rigid_body(1.0, &at(-0.3), &spin).unwrap();
    let second = model.add_rigid_body(0.7, &at(-0.9), &spin).unwrap();
    let y = Vector3::y();
    let shoulder = revolute(&mut model, None, Some(first), &at(0.0), &y);
    let elbow = revolute(&mut model, Some(first), Some(second), &at(-0.6), &y);
    for (joint, damping) in [(shoulder, 0.5), (elbow, 0.3)] {
        model
            .add_spring_damper(SpringDefinition {
                at: rotation1(joint),
                stiffness: 0.0,
                damping,
                rest: 0.0,
            })
            .unwrap();
    }
    model
        .add_actuator(rotation1(shoulder), &cosine(3.0))
        .unwrap();
    model.set_gravity([0.0, 0.0, -9.81].map(|g| Signal::constant(g).unwrap()));
    (model, elbow)
}

/// Period of its drive.
pub const DOUBLE_PENDULUM_PERIOD: f64 = 1.7;

/// Pendulum with a Zener element: length and mass of the arm, and the element's long-term
/// stiffness, stiffness of its branch and relaxation time.
pub const ZENER_ARM: f64 = 0.7;
pub const ZENER_BOB: f64 = 1.3;
pub const ZENER: [f64; 3] = [6.0, 4.0, 0.3];

/// The pendulum, its hinge, and the element.
pub fn zener_pendulum() -> (Model, usize, usize) {
    let mut model = Model::new();
    let spin = Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.15));
    let centre = Vector3::new(0.0, 0.0, -ZENER_ARM);
    let body = model.add_rigid_body(ZENER_BOB, &centre, &spin).unwrap();
    let y = Vector3::y();
    let hinge = revolute(&mut model, None, Some(body), &Vector3::zeros(), &y);
    model.set_gravity([0.0, 0.0, -9.81].map(|g| Signal::constant(g).unwrap()));
    let branch = MaxwellBranch {
        stiffness: ZENER[1],
        relaxation_time: ZENER[2],
    };
    let force = model
        .add_viscoelastic(rotation1(hinge), ZENER[0], 0.0, &[branch])
        .unwrap();
    model.add_actuator(rotation1(hinge), &cosine(9.0)).unwrap();
    (model, hinge, force)
}

/// Options with the tolerance of all tests: the square of such an increment is below rounding, so
/// that what Newton leaves is rounding alone.
pub fn options(grid_points: usize) -> PeriodicOptions {
    PeriodicOptions {
        newton: NewtonOptions {
            tolerance: 1e-9,
            iteration_limit: 30,
        },
        ..PeriodicOptions::with_grid_points(grid_points)
    }
}

/// A solve that must converge.
pub fn solve(model: &Model, period: f64, grid_points: usize) -> Solution {
    let solution = try_solve(model, period, grid_points).unwrap();
    let report = &solution.details().report;
    assert_eq!(solution.outcome(), Outcome::Converged, "{report:#?}");
    solution
}

/// A solve from the default guess.
pub fn try_solve(
    model: &Model,
    period: f64,
    grid_points: usize,
) -> periodyn::error::Result<Solution> {
    Solution::solve(model, period, &options(grid_points), &mut |_, _| true)
}

/// Numbers of points of the grids that an adaptive solve has tried, in order.
pub fn grids_tried(solution: &Solution) -> Vec<usize> {
    let grids = &solution.details().periodic().unwrap().grids;
    grids.iter().map(|grid| grid.points).collect()
}

/// `count` uniform times from 0 to `period`, both included.
pub fn times(period: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| period * i as f64 / (count - 1) as f64)
        .collect()
}

/// Component `i` of quantities with `components` components, at all times.
pub fn column(values: &[f64], components: usize, i: usize) -> Vec<f64> {
    values.iter().skip(i).step_by(components).copied().collect()
}

pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    largest(a.iter().zip(b).map(|(x, y)| x - y))
}

/// Largest difference relative to the range of `reference`.
pub fn relative_to_range(a: &[f64], reference: &[f64]) -> f64 {
    let low = reference.iter().copied().fold(f64::INFINITY, f64::min);
    let high = reference.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    largest_difference(a, reference) / (high - low)
}

/// Slope and correlation of the straight line through points `(x, ln y)`.
pub fn exponential_fit(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let mean_y = points.iter().map(|p| p.1.ln()).sum::<f64>() / n;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (x, y) in points {
        let (dx, dy) = (x - mean_x, y.ln() - mean_y);
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    (xy / xx, xy / (xx * yy).sqrt())
}

/// A cosine of the period's first harmonic.
pub fn cosine(amplitude: f64) -> Signal {
    Signal::harmonics(0.0, 0.0, &[amplitude], &[0.0]).unwrap()
}

pub fn rotation1(joint: usize) -> JointCoordinate {
    JointCoordinate {
        joint,
        coordinate: Coordinate::Rotation1,
    }
}

/// A revolute joint at `point` about `axis`.
pub fn revolute(
    model: &mut Model,
    first: Option<usize>,
    second: Option<usize>,
    point: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> usize {
    let frame = Model::frame_at("axis", point, axis).unwrap();
    model
        .add_joint(JointKind::Revolute, first, second, &frame, &frame)
        .unwrap()
}

/// A load of constant and cosine parts, given as vectors `[force; moment]`.
pub fn add_load(
    model: &mut Model,
    node: usize,
    frame: LoadFrame,
    constant: &[f64; 6],
    cosine: &[f64; 6],
) {
    let component = |i: usize| {
        let any = constant[i] != 0.0 || cosine[i] != 0.0;
        any.then(|| Signal::harmonics(constant[i], 0.0, &[cosine[i]], &[0.0]).unwrap())
    };
    model
        .add_load(node, frame, std::array::from_fn(component))
        .unwrap();
}

/// Where the four-bar stands, and in what units it is written: factors from SI.
#[derive(Clone, Copy)]
pub struct Setting {
    pub place: Motion,
    pub mass: f64,
    pub length: f64,
    pub time: f64,
}

impl Default for Setting {
    fn default() -> Self {
        Setting {
            place: Motion::identity(),
            mass: 1.0,
            length: 1.0,
            time: 1.0,
        }
    }
}

impl Setting {
    pub fn force(&self) -> f64 {
        self.mass * self.length / (self.time * self.time)
    }

    pub fn moment(&self) -> f64 {
        self.force() * self.length
    }

    /// A point of the mechanism in this setting.
    pub fn point(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.place.rotation * p * self.length + self.place.position
    }

    /// A direction, or the components of a vector before its units are converted.
    pub fn turned(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.place.rotation * v
    }

    /// Per-length section matrices: `linear`, `mixed` and `angular` factors of their blocks.
    pub fn scaled(m: &Matrix6<f64>, linear: f64, mixed: f64, angular: f64) -> Matrix6<f64> {
        Matrix6::from_fn(|i, j| {
            m[(i, j)]
                * match (i < 3, j < 3) {
                    (true, true) => linear,
                    (false, false) => angular,
                    _ => mixed,
                }
        })
    }

    /// A section given in SI units.
    pub fn section(&self, s: &SectionInput) -> SectionInput {
        let (f, l) = (self.force(), self.length);
        let m = self.mass / l;
        SectionInput {
            stiffness: Self::scaled(&s.stiffness, f, f * l, f * l * l),
            mass: Self::scaled(&s.mass, m, m * l, m * l * l),
            damping: Self::scaled(&s.damping, f, f * l, f * l * l) * self.time,
        }
    }
}

/// The spatial four-bar mechanism of section 7.2 of the paper, and what may be changed about it.
#[derive(Clone, Copy)]
pub struct FourBar {
    /// Beam elements to a bar; none for rigid bars.
    pub elements: usize,
    /// Their polynomial degree.
    pub degree: usize,
    /// Gravity, a force on B, a follower moment on bar 2, a damper at A and damping of the bars.
    pub loaded: bool,
    pub setting: Setting,
}

impl Default for FourBar {
    fn default() -> Self {
        FourBar {
            elements: 8,
            degree: 1,
            loaded: false,
            setting: Setting::default(),
        }
    }
}

/// Angle at D: the mechanism's input. Its rate is at most about 0.2 rad/s.
pub fn four_bar_input(rate_factor: f64) -> Signal {
    Signal::harmonics(
        1.0 / 3.0 + 1.0 / 21.0,
        0.3 * rate_factor,
        &[-1.0 / 3.0, 0.0, -1.0 / 21.0],
        &[0.0, 0.1, 0.0],
    )
    .unwrap()
}

/// Points A, B, C, D in the reference configuration.
pub fn four_bar_points() -> [Vector3<f64>; 4] {
    [
        Vector3::new(-0.4, 0.0, 0.0),
        Vector3::new(-0.75, 0.0, 0.652),
        Vector3::new(0.0, 0.85, 0.2),
        Vector3::new(0.0, 0.85, 0.0),
    ]
}

pub const FOUR_BAR_PERIOD: f64 = TAU / 0.3;

const THICK: [f64; 6] = [52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0];
const THIN: [f64; 6] = [13.25e6, 4.22e6, 4.22e6, 45.84, 70.66, 70.66];

/// Sectional stiffnesses of the three bars.
pub const FOUR_BAR_STIFFNESS: [[f64; 6]; 3] = [THICK, THICK, THIN];

/// Amplitude of the cosine force on B of the loaded mechanism, in space.
pub const FOUR_BAR_FORCE: [f64; 3] = [3.0, 20.0, -7.0];
/// Amplitude of the cosine moment that follows the middle of its bar 2.
pub const FOUR_BAR_MOMENT: [f64; 3] = [0.3, -0.8, 0.5];
/// Its damper at A.
pub const FOUR_BAR_DAMPER: f64 = 2.0;
/// Damping of its bars: seconds times stiffness.
pub const FOUR_BAR_DAMPING_TIME: f64 = 1e-3;

/// A built four-bar: what the tests look at.
pub struct FourBarModel {
    pub model: Model,
    pub period: f64,
    /// Node at B, on bar 1.
    pub b: usize,
    /// Node in the middle of bar 2.
    pub middle: usize,
    /// First beam element of each bar.
    pub bars: [usize; 3],
    /// Joints at A, B, C, D.
    pub joints: [usize; 4],
}

impl FourBar {
    pub fn build(&self) -> FourBarModel {
        let set = &self.setting;
        let [a, b, c, d] = four_bar_points().map(|p| set.point(&p));
        let (i1, i2) = (set.turned(&Vector3::x()), set.turned(&Vector3::y()));
        let thick = SectionInput::diagonal(&THICK, &[1.997, 85.2e-6, 42.6e-6, 42.6e-6]);
        let thin = SectionInput::diagonal(&THIN, &[0.4992, 5.324e-6, 2.662e-6, 2.662e-6]);
        let mut model = Model::new();
        let mut add_bar = |start: &Vector3<f64>, end: &Vector3<f64>, axis_2, section| {
            let mut section: SectionInput = section;
            if self.loaded {
                section.damp_proportionally(FOUR_BAR_DAMPING_TIME).unwrap();
            }
            self.add_bar(&mut model, start, end, axis_2, &section)
        };
        let (thick, thin) = (thick.unwrap(), thin.unwrap());
        let bar1 = add_bar(&a, &b, &i2, thick);
        let bar2 = add_bar(&b, &c, &i1, thick);
        let bar3 = add_bar(&c, &d, &i1, thin);
        let middle = (bar2.first_node + bar2.last_node) / 2;
        let m = &mut model;
        let ja = revolute(m, None, Some(bar1.first_node), &a, &i2);
        let fb = Model::frame_at("axis", &b, &i2).unwrap();
        let (left, right) = (Some(bar1.last_node), Some(bar2.first_node));
        let jb = m.add_joint(JointKind::Spherical, left, right, &fb, &fb);
        let fc = Model::cross_frame(&c, &i1.cross(&(c - b)), &i1).unwrap();
        let (left, right) = (Some(bar2.last_node), Some(bar3.first_node));
        let jc = m.add_joint(JointKind::Universal, left, right, &fc, &fc);
        let jd = revolute(m, None, Some(bar3.last_node), &d, &i1);
        m.add_spring_damper(SpringDefinition {
            at: rotation1(ja),
            stiffness: 18.0 * set.moment(),
            damping: if self.loaded { FOUR_BAR_DAMPER } else { 0.0 } * set.moment() * set.time,
            rest: 0.0,
        })
        .unwrap();
        m.prescribe(rotation1(jd), &four_bar_input(1.0 / set.time))
            .unwrap();
        if self.loaded {
            self.add_loads(m, bar1.last_node, middle);
        }
        FourBarModel {
            model,
            period: FOUR_BAR_PERIOD * set.time,
            b: bar1.last_node,
            middle,
            bars: [bar1, bar2, bar3].map(|bar| bar.first_element),
            joints: [ja, jb.unwrap(), jc.unwrap(), jd],
        }
    }

    /// A bar of beams or, without elements, a rigid body with a node at its centre.
    fn add_bar(
        &self,
        model: &mut Model,
        start: &Vector3<f64>,
        end: &Vector3<f64>,
        axis_2: &Vector3<f64>,
        section: &SectionInput,
    ) -> BeamIds {
        if self.elements > 0 {
            let section = self.setting.section(section);
            return model
                .add_straight_beam(start, end, axis_2, &section, self.elements, self.degree)
                .unwrap();
        }
        let length = (end - start).norm();
        let along = (end - start) / length;
        let mass = section.mass[(0, 0)] * length;
        let slender =
            (Matrix3::identity() - along * along.transpose()) * (mass * length * length / 12.0);
        // The spin about the bar's own axis is that of its section.
        let spin = along * along.transpose() * (section.mass[(3, 3)] * length);
        let node = model
            .add_rigid_body(mass, &(0.5 * (start + end)), &(slender + spin))
            .unwrap();
        BeamIds {
            first_node: node,
            last_node: node,
            first_element: 0,
            elements: 0,
        }
    }

    fn add_loads(&self, model: &mut Model, b: usize, middle: usize) {
        let set = &self.setting;
        let gravity = set.turned(&Vector3::new(0.0, 0.0, -9.81)) * set.length / set.time.powi(2);
        model.set_gravity([gravity.x, gravity.y, gravity.z].map(|g| Signal::constant(g).unwrap()));
        let force = set.turned(&Vector3::from(FOUR_BAR_FORCE)) * set.force();
        let amplitudes = [force.x, force.y, force.z, 0.0, 0.0, 0.0];
        add_load(model, b, LoadFrame::Space, &[0.0; 6], &amplitudes);
        let [m1, m2, m3] = FOUR_BAR_MOMENT.map(|x| x * set.moment());
        let amplitudes = [0.0, 0.0, 0.0, m1, m2, m3];
        add_load(model, middle, LoadFrame::Follower, &[0.0; 6], &amplitudes);
    }
}

impl FourBarModel {
    pub fn solve(&self, grid_points: usize) -> Solution {
        solve(&self.model, self.period, grid_points)
    }

    /// Curves of figures 8 to 10: `x₃` and `v₃` of B, and the driving torque at D.
    pub fn curves(&self, solution: &Solution, times: &[f64]) -> [Vec<f64>; 3] {
        let position = solution.node(self.b, NodeQuantity::Position, times);
        let velocity = solution.node(self.b, NodeQuantity::Velocity, times);
        let effort = JointQuantity::DrivingEffort(Coordinate::Rotation1);
        [
            column(&position.unwrap(), 3, 2),
            column(&velocity.unwrap(), 6, 2),
            solution.joint(self.joints[3], effort, times).unwrap(),
        ]
    }
}
