//! The spatial four-bar mechanism of section 7.2 of the paper.

use super::parts::{self, *};
use nalgebra::{Matrix3, Matrix6, Vector3};
use periodyn::elements::{JointKind, LoadFrame};
use periodyn::model::*;
use periodyn::motion::Motion;
use std::f64::consts::TAU;

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
        let thick = SectionInput::diagonal(&THICK, &THICK_MASS);
        let thin = SectionInput::diagonal(&THIN, &THIN_MASS);
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
        let pin = [Some(bar1.last_node), Some(bar2.first_node)];
        let jb = join(m, JointKind::Spherical, pin, &b, &i2);
        let fc = Model::cross_frame(&c, &i1.cross(&(c - b)), &i1).unwrap();
        let (left, right) = (Some(bar2.last_node), Some(bar3.first_node));
        let jc = m.add_joint(JointKind::Universal, left, right, &fc, &fc);
        let jd = revolute(m, None, Some(bar3.last_node), &d, &i1);
        let damping = if self.loaded { FOUR_BAR_DAMPER } else { 0.0 } * set.moment() * set.time;
        spring(m, rotation1(ja), 18.0 * set.moment(), damping);
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
            joints: [ja, jb, jc.unwrap(), jd],
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
        parts::gravity(model, gravity.into());
        let force = set.turned(&Vector3::from(FOUR_BAR_FORCE)) * set.force();
        let amplitudes = [force.x, force.y, force.z, 0.0, 0.0, 0.0];
        add_load(model, b, LoadFrame::Space, &[0.0; 6], &amplitudes);
        let [m1, m2, m3] = FOUR_BAR_MOMENT.map(|x| x * set.moment());
        let amplitudes = [0.0, 0.0, 0.0, m1, m2, m3];
        add_load(model, middle, LoadFrame::Follower, &[0.0; 6], &amplitudes);
    }
}

/// The mechanism of the paper, with `elements` elements of `degree` to a bar.
pub fn spatial_four_bar(elements: usize, degree: usize) -> Model {
    let mechanism = FourBar {
        elements,
        degree,
        ..FourBar::default()
    };
    mechanism.build().model
}
